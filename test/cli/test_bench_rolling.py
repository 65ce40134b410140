"""`faststrip-lab bench rolling`: the rows that the report's manifest judges are there."""


from cli_program import GAPS, ROOT, LabTest
from faststrip_plots.verdicts import judge, read_manifest

CONTACTS = ROOT / "reference" / "contact"


class Rolling(LabTest):
    def test_every_comparison_of_the_manifest_finds_its_rows(self):
        for name, keeps in (("s1002_uic60_A", lambda cells: cells[0] == "2"),
                            ("s1002_uic60_B", lambda cells: cells[0] == "2"),
                            ("hertz_creep", lambda cells: cells[0] == "long" and
                             (float(cells[1]), cells[19]) == (6.0, "0.1"))):
            lines = (CONTACTS / f"{name}.csv").read_text(encoding="utf-8").splitlines()
            rows = [line for line in lines if not line.startswith("#")]
            kept = rows[:1] + [row for row in rows[1:] if keeps(row.split(","))]
            self.assertEqual(len(kept), 2, name)
            self.write(f"contacts/{name}.csv", "\n".join(kept) + "\n")
        self.write("contacts/gaps/shift_2.csv", (GAPS / "shift_2.csv").read_text(encoding="utf-8"))
        self.succeed("bench", "rolling", "--contacts", "contacts", "-o", "rolling.csv")
        rows = [row for row in read_manifest(str(ROOT / "reference" / "comparisons.csv"))
                if row["value_file"] == "rolling.csv"]
        self.assertGreaterEqual(len(rows), 6)
        for row in rows:
            verdict = judge(row, str(self.folder))
            self.assertEqual((verdict.word, verdict.rows), ("pass", 1), row["id"])
