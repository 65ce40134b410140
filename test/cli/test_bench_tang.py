"""`faststrip-lab bench tang`: Newton's steps, iterations and times of TANG."""

from cli_program import ROOT, LabTest

CONTACTS = ROOT / "reference" / "contact"
MU = 0.3


class Tang(LabTest):
    def test_counts_and_forces_of_all_creepages(self):
        rows = self.written("bench", "tang", "--quick", "--rounds", "1", "--most-elements", "4000",
                            "--contacts", CONTACTS)
        self.assertEqual([row["creepages"] for row in rows], ["own", "no_spin", "spin"] * 4)
        for row in rows:
            key = row["case"], row["creepages"]
            steps, iterations = int(row["steps"]), int(row["iterations"])
            self.assertLess(abs(int(row["elements"]) - 3700), 60, key)
            # Each step also applies the influence for its right-hand side and for its slip.
            self.assertGreaterEqual(int(row["products"]), iterations + 2 * steps, key)
            self.assertLess(steps, 15, key)
            self.assertLess(iterations, 130, key)
            self.assertGreater(iterations, steps, key)
            self.assertLess(0.0, float(row["stick_fraction"]), key)
            self.assertLess(float(row["stick_fraction"]), 0.95, key)
            force = (float(row["Fx_N"])**2 + float(row["Fy_N"])**2)**0.5
            self.assertTrue(0.1 < force / (MU * 1.0e5) < 1.01, key)
            if row["creepages"] == "no_spin":
                self.assertLess(float(row["Fx_N"]), 0.0, key)
                self.assertLess(float(row["Fy_N"]), 0.0, key)

    def test_refused(self):
        self.refused(2, "bench", "tang", "--seconds", "1", says=["--seconds", "tang"])
        self.refused_and_untouched("bench", "tang", "--contacts", "nowhere", says=["nowhere"])
