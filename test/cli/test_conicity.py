"""`faststrip conicity` against exact cases and the tables of EN 15302:2008+A1:2010."""

import csv
import unittest

from cli_program import ROOT, ProgramTest

# Tables of the standard that are no part of the project; where they are not, tests are skipped.
STANDARD = ROOT.parent / "shared" / "data" / "en15302"


def table_of(points):
    return "y_mm,delta_r_mm\n" + "".join(f"{y},{radius}\n" for y, radius in points)


def standard(name):
    with open(STANDARD / name, encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


class Conicity(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("cone.csv", table_of([(-6, -0.7), (1, 0), (8, 0.7)]))

    def test_a_cone_by_both_methods(self):
        for method in ("klingel", "regression"):
            rows = self.good("conicity", "--delta-r", "cone.csv", "--method", method)
            self.assertEqual(list(rows[0]), ["amplitude_mm", "tan_gamma_e", "y_min_mm", "y_max_mm",
                                             "method", "status"])
            self.assertEqual([round(float(row["amplitude_mm"]), 12) for row in rows],
                             [i / 10 for i in range(10, 71)])
            for row in rows:
                self.assertEqual((row["method"], row["status"]), (method, "ok"))
                self.assert_close(float(row["tan_gamma_e"]), 0.05, 1e-12, what=row)
                self.assert_close(float(row["y_min_mm"]), 1 - float(row["amplitude_mm"]),
                                  absolute=1e-9)

    def test_amplitudes_by_list_and_by_steps(self):
        words = ("conicity", "--delta-r", "cone.csv")
        for more, wanted in ((["--amplitudes", "3, 0.5,7"], [3, 0.5, 7]),
                             (["--from", "2", "--to", "3", "--step", ".25"],
                              [2, 2.25, 2.5, 2.75, 3]), (["--from", "6.95"], [6.95])):
            rows = self.good(*words, *more)
            self.assertEqual([float(row["amplitude_mm"]) for row in rows], wanted)

    def test_the_edition_is_said(self):
        text = self.run_program("conicity", "--delta-r", "cone.csv").stdout
        self.assertIn("\n# equivalent conicity, EN 15302:2008+A1:2010\n", text)

    def test_amplitudes_without_a_motion_leave_the_others(self):
        self.write("hill.csv", table_of([(-4, -1), (-1, -1), (1, 1), (2, -1), (3, 4), (5, 6)]))
        rows = self.good("conicity", "--delta-r", "hill.csv", "--amplitudes", "1,1.6,2.2")
        self.assertEqual([row["status"] for row in rows], ["ok", "out_of_range", "ok"])
        self.assertEqual([row["tan_gamma_e"] == "" for row in rows], [False, True, False])

    def test_bad_words(self):
        cone = ("conicity", "--delta-r", "cone.csv")
        for words, says in (
            (["conicity"], "--delta-r"),
            ([*cone, "--amplitudes", "1,,2"], "''"),
            ([*cone, "--amplitudes", "1,-2"], "'-2'"),
            ([*cone, "--amplitudes", "1", "--to", "2"], "--to"),
            ([*cone, "--from", "3", "--to", "2"], "3.0"),
            ([*cone, "--step", "0"], "'0'"),
            ([*cone, "--step", "1e-9"], "0.1"),
            ([*cone, "--method", "guess"], "guess"),
            ([*cone, "case.nml"], "case.nml"),
        ):
            with self.subTest(words):
                self.refused(2, *words, says=[says])

    def test_bad_tables(self):
        for text, says in (
            (table_of([(-1, -1), (1, 1), (1, 2)]), ["(in.csv:4)", "1", "y_mm"]),
            (table_of([(-1, -1), (1, 1), (0.5, 2)]), ["(in.csv:4)", "0.5", "y_mm"]),
            (table_of([(-1, -1), (1, "NaN")]), ["(in.csv:3)", "'NaN'", "delta_r_mm"]),
            (table_of([(-9, 1), (9, -1)]), ["(in.csv)", "rise"]),
            (table_of([(0, 1)]), ["(in.csv)", "1"]),
            ("y_mm,dr\n0,1\n", ["(in.csv)", "delta_r_mm"]),
            (table_of([(-9, -1), (1, 1)]), ["(in.csv)", "5.1", "5.0"]),
        ):
            with self.subTest(text):
                self.write("in.csv", text)
                self.refused_and_untouched("conicity", "--delta-r", "in.csv", "--amplitudes",
                                           "5.1", says=says)
        self.refused_and_untouched("conicity", "--delta-r", "none.csv", says=["none.csv"])

    def check_annex_e(self, radii, case, tolerance):
        self.write("case.csv", table_of(radii))
        wanted = {round(float(row["amplitude_mm"]), 3): float(row["tan_gamma_e"])
                  for row in standard("conicity.csv") if row["case"] == case}
        rows = self.good("conicity", "--delta-r", "case.csv")
        self.assertGreaterEqual(len(rows), 40)
        for row in rows:
            self.assertEqual(row["status"], "ok")
            self.assert_close(float(row["tan_gamma_e"]),
                              wanted[round(float(row["amplitude_mm"]), 3)],
                              absolute=tolerance, what=(case, row))

    @unittest.skipUnless(STANDARD.exists(), "the tables of EN 15302 are not here")
    def test_annex_e_of_the_standard(self):
        radii = {}
        for row in standard("delta_r.csv"):
            radii.setdefault(row["case"], []).append((float(row["y_mm"]),
                                                      float(row["delta_r_mm"])))
        self.assertEqual(len(radii), 9)
        for case, points in radii.items():
            self.check_annex_e(points, case, 0.007 if case == "E5" else 0.001)
        # E5 is E1 with radii 1 mm apart. That, and not the table printed for it, is what Annex E
        # has its conicity from.
        self.check_annex_e([(y, radius + 1.0) for y, radius in radii["E1"]], "E5", 0.001)


if __name__ == "__main__":
    unittest.main()
