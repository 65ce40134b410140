"""`faststrip-lab errata`: literal and right readings side by side."""

from cli_program import PROGRAM, LabTest, rows_of

COLUMNS = ["equation", "what", "literal", "right", "unit", "deviation", "note"]


class Errata(LabTest):
    def test_every_erratum_has_its_figures(self):
        rows = self.good("errata")
        self.assertEqual(list(rows[0]), COLUMNS)
        text = " ".join(row["equation"] for row in rows)
        for equation in ("(6)", "(9)", "(12)", "Table 1", "(22)-(24)", "(30)", "(31)", "(32)",
                         "(34)", "(41)", "(44)", "(46)-(48)"):
            self.assertIn(equation, text)
        for row in rows:
            if row["literal"]:
                ratio = float(row["literal"]) / float(row["right"])
                self.assertAlmostEqual(float(row["deviation"]) + 1.0, ratio,
                                       delta=1e-9 * abs(ratio) + 1e-15)

    def test_the_figures_are_those_of_the_theory(self):
        rows = {(row["equation"], row["what"]): row for row in self.good("errata")}

        def deviation(equation, start):
            found = [float(row["deviation"]) for key, row in rows.items()
                     if key[0] == equation and key[1].startswith(start)]
            self.assertEqual(len(found), 1, msg=(equation, start))
            return found[0]

        self.assertAlmostEqual(deviation("(34)", "C11"), 0.178, delta=0.003)
        self.assertAlmostEqual(deviation("(41)", "C11") + 1.0, 16.5, delta=0.1)
        self.assertAlmostEqual(deviation("(22)-(24)", "i for n = 0, b = 0.01"), -0.401, delta=0.001)
        self.assertAlmostEqual(deviation("(9)", "QAGS: i for n = 1000, b = 1.0"), 1.3e-3,
                               delta=1e-4)

    def test_a_file_leaves_lines_to_read(self):
        done = self.succeed("errata", "-o", "errata.csv")
        self.assertIn("literal", done.stdout)
        self.assertEqual(list(rows_of((self.folder / "errata.csv").read_text())[0]), COLUMNS)

    def test_other_options_are_refused(self):
        for words in (("--degree", "3"), ("--audit",), ("file.csv",)):
            self.refused(2, "errata", *words)

    def test_the_installed_program_says_where_it_is_now(self):
        self.program = PROGRAM
        for words in ((), ("-o", "errata.csv"), ("--degree", "3")):
            self.refused(2, "table", "--errata", *words, says=["faststrip-lab errata"])
        self.assertFalse((self.folder / "errata.csv").exists())
