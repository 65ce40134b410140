"""`faststrip-lab bench kalker`: Kalker's coefficients from TANG, extrapolated in size."""

from cli_program import ROOT, LabTest

CONTACTS = ROOT / "reference" / "contact"
NAMES = ("C11", "C22", "C23", "C32", "C33")


class Kalker(LabTest):
    def test_within_one_percent_of_the_table_and_contact(self):
        rows = self.written("bench", "kalker", "--quick", "--contacts", CONTACTS)
        self.assertEqual([row["coefficient"] for row in rows], list(NAMES) * 9)
        by_key = {}
        for row in rows:
            key = row["coefficient"], float(row["a_over_b"]), float(row["nu"])
            by_key[key] = float(row["value"])
            self.assertLess(abs(float(row["to_table_pct"])), 0.7, key)
            self.assertLess(abs(float(row["to_contact_pct"])), 0.6, key)
            self.assertLess(float(row["scatter_pct"]), 0.2, key)
            self.assert_close(float(row["to_table_pct"]),
                              100.0 * (float(row["value"]) / float(row["table"]) - 1.0), 1e-9)
            # C32 = -C23; without coupling of x and y, C11 = C22.
            if row["coefficient"] == "C32":
                self.assert_close(by_key["C32", *key[1:]], -by_key["C23", *key[1:]], 3e-3)
            if row["coefficient"] == "C22" and key[2] == 0.0:
                self.assert_close(by_key["C22", *key[1:]], by_key["C11", *key[1:]], 1e-5)

    def test_refused(self):
        self.refused(2, "bench", "kalker", "--seconds", "1", says=["--seconds", "kalker"])
        self.refused_and_untouched("bench", "kalker", "--contacts", "nowhere", says=["nowhere"])
