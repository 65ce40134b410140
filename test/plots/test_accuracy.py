"""The accuracy table: figures worked out by hand, skipped rows, bad input."""

import os
import unittest

from plot_samples import (
    FAST_COLUMNS,
    Folder,
    csv_text,
    failed_row,
    hertz_row,
    reference_text,
    sweep_row,
    sweep_text,
)


def cells(text, name):
    """Cells of the table line that begins with a name."""
    for line in text.splitlines():
        parts = [part.strip() for part in line.strip("|").split("|")]
        if parts[0] == name:
            return parts[1:]
    raise AssertionError(f"no line {name!r} in\n{text}")


def fast_text(*rows):
    base = dict(method="KPEC+FASTSIM", dx_mm=0.2, cpu_norm_s=5e-5, cpu_tang_s=2e-4, err_pen_pct=-1,
                err_area_pct=2, err_pmax_pct=3, err_Fx_pct_of_muN=-4, err_Fy_pct_of_muN=5,
                err_Mz_Nmm=-300)
    return csv_text(FAST_COLUMNS, [dict(base, **row) for row in rows], "# fast modes\n")


class Figures(unittest.TestCase):
    def test_mean_and_largest_error_of_each_quantity(self):
        # reference: 0.05 mm, 4 pi mm2, 1000 MPa, 1000 N, -500 N, 600 N mm; mu N = 3000 N and
        # mu N c = 6000 N mm. First shift +2 %, +10 MPa, +30 N, -60 N, +120 N mm; second the
        # penetration -4 %, all else exact.
        files = {
            "out/sweep.csv": sweep_text(
                sweep_row(0, penetration_mm=0.051, pmax_MPa=1010, Fx_N=1030, Fy_N=-560, Mz_Nmm=720,
                          normal_us=80, tangential_us=9),
                sweep_row(1, penetration_mm=0.048, normal_us=100, tangential_us=12),
            ),
            "reference.csv": reference_text(1, 0, 2),
        }
        with Folder(files) as folder:
            status, out, err = folder.run("accuracy", "--reference", "reference.csv",
                                          "--no-fast-modes")
            self.assertEqual((status, err), (0, ""))
            self.assertEqual((folder.path / "out/accuracy.md").read_text(encoding="utf-8"), out)
        self.assertEqual(
            cells(out, "strips + FASTSTRIP"),
            ["2 / 2", "3.00 / 4.00", "0.00 / 0.00", "0.50 / 1.00", "0.50 / 1.00", "1.00 / 2.00",
             "1.00 / 2.00", "90.0", "10.5"],
        )
        self.assertIn("faststrip 0.1.0 rev abc1234", out)

    def test_friction_scales_the_forces(self):
        files = {"out/sweep.csv": sweep_text(sweep_row(0, Fx_N=1030)), "r.csv": reference_text(0)}
        with Folder(files) as folder:
            _, out, _ = folder.run("accuracy", "--reference", "r.csv", "--no-fast-modes", "--mu",
                                   "0.1")
        self.assertEqual(cells(out, "strips + FASTSTRIP")[4], "3.00 / 3.00")

    def test_area_is_judged_by_the_reference_area(self):
        files = {
            "out/sweep.csv": sweep_text(sweep_row(0, area_mm2=110), sweep_row(1, area_mm2=97)),
            "r.csv": reference_text(0, 1, area_extrap_mm2=100.0),
        }
        with Folder(files) as folder:
            _, out, _ = folder.run("accuracy", "--reference", "r.csv", "--no-fast-modes")
        self.assertEqual(cells(out, "strips + FASTSTRIP")[2], "6.50 / 10.0")

    def test_rows_without_a_result_are_skipped_and_counted(self):
        files = {
            "out/sweep.csv": sweep_text(
                hertz_row(0, pmax_MPa=1100), failed_row(1), failed_row(2, status="no_convergence"),
                hertz_row(3, pmax_MPa=5000, status="no_convergence"), hertz_row(4, Fx_N=""),
                hertz_row(5, pmax_MPa=1200, status="edge_of_data"),
            ),
            "r.csv": reference_text(0, 1, 2, 3, 4, 5),
        }
        with Folder(files) as folder:
            status, out, _ = folder.run("accuracy", "--reference", "r.csv", "--no-fast-modes")
        self.assertEqual(status, 0)
        line = cells(out, "Hertz + FASTSIM")
        self.assertEqual((line[0], line[3]), ("2 / 6", "15.0 / 20.0"))
        self.assertIn("- Hertz + FASTSIM: 1 of 6 shifts without a result (no_hertz_ellipse)", out)
        self.assertIn("- Hertz + FASTSIM: 2 of 6 shifts without a result (no_convergence)", out)
        self.assertIn("- Hertz + FASTSIM: 1 of 6 shifts without a result (incomplete)", out)
        self.assertIn("- Hertz + FASTSIM: 1 of 6 shifts with a limited result (edge_of_data)", out)

    def test_a_method_without_any_result_has_dashes(self):
        files = {"out/sweep.csv": sweep_text(sweep_row(0), failed_row(0)),
                 "r.csv": reference_text(0)}
        with Folder(files) as folder:
            status, out, _ = folder.run("accuracy", "--reference", "r.csv", "--no-fast-modes")
        self.assertEqual(status, 0)
        self.assertEqual(cells(out, "Hertz + FASTSIM"), ["0 / 1"] + ["–"] * 8)

    def test_times_are_medians_and_missing_ones_left_out(self):
        times = ("", 70, 80, 900)
        files = {
            "out/sweep.csv": sweep_text(*[sweep_row(k, normal_us=t) for k, t in enumerate(times)]),
            "r.csv": reference_text(0),
        }
        with Folder(files) as folder:
            _, out, _ = folder.run("accuracy", "--reference", "r.csv", "--no-fast-modes")
        self.assertEqual(cells(out, "strips + FASTSTRIP")[7:], ["80.0", "10.0"])

    def test_fast_modes(self):
        # moment: -300 and 600 of mu N c = 6000 N mm; shift 7 is not in the reference
        files = {
            "out/sweep.csv": sweep_text(sweep_row(0)),
            "r.csv": reference_text(0, 1),
            "f.csv": fast_text(
                dict(yw_mm=0), dict(yw_mm=1, err_Mz_Nmm=600, err_Fx_pct_of_muN=6, cpu_norm_s=7e-5),
                dict(yw_mm=7, err_pen_pct=90), dict(yw_mm=0, dx_mm=0.5, err_pen_pct=""),
            ),
        }
        with Folder(files) as folder:
            status, out, _ = folder.run("accuracy", "--reference", "r.csv", "--fast-modes", "f.csv",
                                        "-o", "deep/er/table.md")
            self.assertTrue((folder.path / "deep/er/table.md").exists())
        self.assertEqual(status, 0)
        self.assertEqual(
            cells(out, "KPEC+FASTSIM, 0.2 mm"),
            ["2 / 3", "1.00 / 1.00", "2.00 / 2.00", "3.00 / 3.00", "5.00 / 6.00", "5.00 / 5.00",
             "7.50 / 10.0", "60.0", "200"],
        )
        self.assertEqual(cells(out, "KPEC+FASTSIM, 0.5 mm"), ["0 / 1"] + ["–"] * 8)

    def test_columns_line_up(self):
        files = {"out/sweep.csv": sweep_text(sweep_row(0), hertz_row(0)),
                 "r.csv": reference_text(0)}
        with Folder(files) as folder:
            _, out, _ = folder.run("accuracy", "--reference", "r.csv", "--no-fast-modes")
        lines = [line for line in out.splitlines() if line.startswith("|")]
        self.assertEqual(len(lines), 4)
        self.assertEqual(len({len(line) for line in lines}), 1)


class BadInput(unittest.TestCase):
    def refused(self, files, words, *arguments):
        with Folder(files) as folder:
            folder.refused(self, words, "accuracy", "--reference", "r.csv", "--fast-modes",
                           "f.csv", *arguments)

    def setUp(self):
        self.files = {
            "out/sweep.csv": sweep_text(sweep_row(0)),
            "r.csv": reference_text(0),
            "f.csv": fast_text(dict(yw_mm=0)),
        }

    def test_good_files_are_accepted(self):
        with Folder(self.files) as folder:
            status, _, err = folder.run("accuracy", "--reference", "r.csv", "--fast-modes", "f.csv")
        self.assertEqual((status, err), (0, ""))

    def test_missing_files(self):
        for name in list(self.files):
            with self.subTest(name):
                left = {key: text for key, text in self.files.items() if key != name}
                self.refused(left, f"no such file: {name}")

    def test_missing_columns(self):
        for name, column in (("out/sweep.csv", "area_mm2"), ("r.csv", "Fx_extrap_N"),
                             ("f.csv", "err_Mz_Nmm")):
            with self.subTest(name):
                text = self.files[name].replace(column, "other")
                self.refused({**self.files, name: text}, f"missing column: {column} ({name}:")

    def test_not_a_number(self):
        for value in ("abc", "NaN", "inf", "1_000", "1.0 mm"):
            with self.subTest(value):
                text = sweep_text(sweep_row(1), sweep_row(0, pmax_MPa=value))
                self.refused({**self.files, "out/sweep.csv": text},
                             f"pmax_MPa must be a finite number, got {value} (out/sweep.csv:5)")

    def test_not_a_number_in_a_failed_row(self):
        text = sweep_text(failed_row(0, Fx_N="?"))
        self.refused({**self.files, "out/sweep.csv": text},
                     "Fx_N must be a finite number, got ? (out/sweep.csv:4)")

    def test_empty_cell_of_the_reference(self):
        text = reference_text(0, Fy_extrap_N="")
        self.refused({**self.files, "r.csv": text},
                     "Fy_extrap_N must be a number, got an empty cell (r.csv:3)")

    def test_empty_files(self):
        for text, words in (("", "the file is empty"), ("# only metadata\n", "the file is empty"),
                            (sweep_text(), "no row of data")):
            with self.subTest(words):
                self.refused({**self.files, "out/sweep.csv": text}, words)

    def test_ragged_row(self):
        text = self.files["out/sweep.csv"] + "1,2,3\n"
        self.refused({**self.files, "out/sweep.csv": text},
                     "a row must have 24 cells as the header, got 3 (out/sweep.csv:5)")

    def test_column_given_twice(self):
        text = self.files["r.csv"].replace("pmax_MPa", "area_extrap_mm2")
        self.refused({**self.files, "r.csv": text},
                     "column names must differ, got area_extrap_mm2 twice (r.csv:2)")

    def test_shift_given_twice(self):
        text = sweep_text(sweep_row(0), sweep_row(0))
        self.refused({**self.files, "out/sweep.csv": text},
                     "each shift must be given once for strip with faststrip, got 0"
                     " twice (out/sweep.csv:5)")

    def test_another_load_than_the_reference(self):
        text = sweep_text(sweep_row(0, N_N=20000))
        self.refused({**self.files, "out/sweep.csv": text}, "must be the load of the reference, ")

    def test_reference_not_positive(self):
        self.refused({**self.files, "r.csv": reference_text(0, pmax_MPa=0)},
                     "pmax_MPa must be above zero, got 0 (r.csv:3)")

    def test_output_that_cannot_be_written(self):
        with Folder(self.files) as folder:
            os.mkdir(folder.path / "taken")
            status, out, err = folder.run("accuracy", "--reference", "r.csv", "--fast-modes",
                                          "f.csv", "-o", "taken")
        self.assertEqual((status, out), (1, ""))
        self.assertIn("cannot write: taken", err)

    def test_friction_out_of_range_is_a_usage_error(self):
        for value in ("0", "-1", "abc", "nan"):
            with self.subTest(value), Folder(self.files) as folder:
                status, _, err = folder.run("accuracy", f"--mu={value}")
                self.assertEqual(status, 2)
                self.assertIn("--mu", err)
