"""`faststrip table`: the tables it makes, as files other programs read, and its audit."""

import json
import math
import subprocess

from cli_program import PATIENCE, ROOT, ProgramTest, rows_of

PUBLISHED = ROOT / "reference" / "paper" / "table1.csv"

# Every strip distance at these b; the program that evaluates a table prints them in this order.
PLACES = [0.01, 0.04, 0.3, 1.0, 2.5, 10.0]

FORTRAN = """\
      program evaluate
      implicit none
      include 'table.inc'
      double precision b(6), e, t, l
      integer i, j, k
      data b / 0.01d0, 0.04d0, 0.3d0, 1.0d0, 2.5d0, 10.0d0 /
      do i = 1, strip_table_rows
        do j = 1, 6
          l = log10(b(j))
          e = 0.0d0
          do k = strip_table_degree, 0, -1
            e = e*l + strip_table(k, i)
          end do
          t = 2.0d0*10.0d0**e
          print '(i6, 4es25.16)', strip_table_n(i), b(j), t,
     & strip_table_max(i), strip_table_range(2)
        end do
      end do
      end program evaluate
"""

C = """\
#include <math.h>
#include <stdio.h>
#include "table.h"
int main(void)
{
    const double b[6] = { 0.01, 0.04, 0.3, 1.0, 2.5, 10.0 };
    for (int i = 0; i < strip_table_rows; i++)
        for (int j = 0; j < 6; j++) {
            double l = log10(b[j]), e = 0.0;
            for (int k = strip_table_degree; k >= 0; k--)
                e = e * l + strip_table[i][k];
            printf("%d %.17e %.17e %.17e\\n", strip_table_n[i], b[j], 2.0 * pow(10.0, e),
                   strip_table_range[0]);
        }
    return 0;
}
"""


class TableTest(ProgramTest):
    def table(self, *options):
        return self.run_program("table", *options)

    def make(self, *options):
        """The rows of a table."""
        return self.good("table", *options)

    def exact(self, n, b):
        """The integral by the program's closed form."""
        return float(self.good("integral", "--n", n, "--b", repr(b))[0]["value"])


class Made(TableTest):
    def test_csv_has_the_columns_and_17_digits(self):
        rows = self.make("--degree", 3, "--n", "0:2,7")
        self.assertEqual(
            list(rows[0]),
            "n L_min L_max quantity basis degree c0 c1 c2 c3 max_rel_err rms_rel_err".split(),
        )
        self.assertEqual([row["n"] for row in rows], ["0", "1", "2", "7"])
        self.assertRegex(rows[0]["c0"], r"^-?\d\.\d{16}E[+-]\d{3}$")

    def test_the_stated_error_is_the_error(self):
        for options in ([], ["--quantity", "full"], ["--fit", "minimax"]):
            (row,) = self.make("--n", 2, *options)
            worst = 0.0
            for j in range(-20, 11):
                level = j / 10
                e = sum(float(row[f"c{k}"]) * level**k for k in range(7))
                value = 10**e * (2 if row["quantity"] == "half" else 1)
                worst = max(worst, abs(value / self.exact(2, 10**level) - 1))
            self.assertLessEqual(worst, float(row["max_rel_err"]) * (1 + 1e-9))
            self.assertGreater(worst, 0.8 * float(row["max_rel_err"]))

    def test_the_widest_ranges_are_carried(self):
        rows = self.make("--range", "-8:8", "--degree", 40, "--basis", "chebyshev", "--n",
                         "0,10000")
        self.assertEqual(len(rows), 2)
        rows = self.make("--degree", 0, "--n", 10000, "--range", "0:1", "--fit", "minimax")
        self.assertLess(float(rows[0]["max_rel_err"]), 1e-7)


class Compiled(TableTest):
    def built(self, *words):
        """Run a compiler, or what it made; its output."""
        done = subprocess.run([str(word) for word in words], cwd=self.folder, encoding="utf-8",
                              stdin=subprocess.DEVNULL, capture_output=True, timeout=PATIENCE,
                              check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def check(self, text, rows):
        lines = [line.split() for line in text.splitlines()]
        self.assertEqual(len(lines), len(rows) * len(PLACES))
        for i, row in enumerate(rows):
            for j, b in enumerate(PLACES):
                n, place, value = lines[i * len(PLACES) + j][:3]
                self.assertEqual(int(n), int(row["n"]))
                self.assertEqual(float(place), b)
                level = math.log10(b)
                e = 0.0
                for k in range(int(row["degree"]), -1, -1):
                    e = e * level + float(row[f"c{k}"])
                self.assertAlmostEqual(float(value) / (2 * 10**e), 1.0, delta=1e-13)
                error = abs(float(value) / self.exact(int(n), b) - 1)
                self.assertLessEqual(error, float(row["max_rel_err"]) * (1 + 1e-6))

    def test_fortran_in_free_and_in_fixed_form(self):
        options = ["--degree", 8, "--n", "0:2,20", "--fit", "minimax"]
        rows = self.make(*options)
        self.make(*options, "--format", "fortran", "-o", "table.inc")
        include = (self.folder / "table.inc").read_text()
        for row in rows:
            self.assertIn(f"{float(row['max_rel_err']):.3E}", include)
        for line in include.splitlines():
            if not line.startswith("!"):
                self.assertRegex(line, r"^     [ &].{1,66}&?$")
        free = FORTRAN.replace("t,\n     & strip", "t, strip")
        flags = ["-std=f2018", "-pedantic", "-Wall", "-Werror"]
        for name, source in (("fixed.f", FORTRAN), ("free.f90", free)):
            self.write(name, source)
            self.built("gfortran", *flags, "-o", "evaluate", name)
            text = self.built("./evaluate")
            self.check(text, rows)
            last = text.splitlines()[-1].split()
            self.assertEqual(float(last[3]), float(rows[-1]["max_rel_err"]))
            self.assertEqual(float(last[4]), 1.0)

    def test_c(self):
        options = ["--degree", 5, "--n", "0,3", "--fit", "lsq"]
        rows = self.make(*options)
        self.make(*options, "--format", "c", "-o", "table.h")
        self.write("evaluate.c", C)
        flags = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror"]
        self.built("gcc", *flags, "-o", "evaluate", "evaluate.c", "-lm")
        self.check(self.built("./evaluate"), rows)

    def test_json(self):
        options = ["--degree", 14, "--n", "0:3", "--basis", "chebyshev", "--quantity", "full"]
        rows = self.make(*options)
        made = json.loads(self.table(*options, "--format", "json").stdout)
        self.assertEqual(made["basis"], "chebyshev")
        self.assertEqual(made["quantity"], "full")
        self.assertEqual((made["degree"], made["L_min"], made["L_max"]), (14, -2.0, 1.0))
        for row, other in zip(rows, made["rows"], strict=True):
            self.assertEqual(int(row["n"]), other["n"])
            self.assertEqual([float(row[f"c{k}"]) for k in range(15)], other["c"])
            self.assertEqual(float(row["max_rel_err"]), other["max_rel_err"])
            self.assertEqual(float(row["rms_rel_err"]), other["rms_rel_err"])

    def test_many_rows_stay_within_the_continuation_lines(self):
        self.make("--format", "fortran", "--n", "0:499", "--degree", 1, "-o", "table.inc")
        self.write("a.f90", "implicit none\ninclude 'table.inc'\nprint *, strip_table_n(500)\n"
                            "end\n")
        self.built("gfortran", "-std=f2018", "-pedantic", "-Wall", "-Werror", "a.f90")
        self.refused(2, "table", "--format", "fortran", "--n", "0:500", "--degree", 1, says=["501"])


class Audited(TableTest):
    def setUp(self):
        super().setUp()
        self.path = self.folder / "table.csv"

    def audit(self, *options):
        result = self.table("--audit", *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return rows_of(result.stdout), result.stderr

    def test_the_published_table(self):
        rows, summary = self.audit()
        self.assertEqual(len(rows), 21)
        errors = [float(row["max_rel_err"]) for row in rows]
        self.assertEqual(errors.index(max(errors)), 2)
        self.assertAlmostEqual(max(errors), 2.16e-2, delta=1e-4)
        self.assertGreater(min(errors), 5.0e-3 * 0.9)
        self.assertTrue(all(row["misprint"] == "no" for row in rows))
        self.assertIn("no misprint is demonstrable", summary)
        self.assertAlmostEqual(float(rows[1]["rel_err_below"]), -0.60, delta=0.01)
        self.assertAlmostEqual(float(rows[1]["rel_err_above"]), -0.80, delta=0.01)
        from_file, _ = self.audit(PUBLISHED)
        self.assertEqual(from_file, rows)

    def test_summary_on_stdout_when_the_csv_goes_to_a_file(self):
        result = self.table("--audit", "-o", self.path)
        self.assertEqual(result.returncode, 0)
        # A slow machine may see a line of progress.
        self.assertEqual(result.stderr, "")
        self.assertIn("no misprint is demonstrable", result.stdout)
        self.assertEqual(len(rows_of(self.path.read_text())), 21)

    def test_a_fresh_table_has_no_residual(self):
        for options in (["--degree", 9], ["--basis", "chebyshev", "--quantity", "full"]):
            self.make("--n", "0:4", *options, "-o", self.path)
            rows, _ = self.audit(self.path)
            for row in rows:
                self.assertLess(float(row["residual_max"]), 1e-12)
                self.assertEqual(row["suspect"], "")
                self.assertEqual(row["misprint"], "no")

    def test_a_planted_misprint_is_found(self):
        self.make("--n", "0:5", "-o", self.path)
        lines = self.path.read_text().splitlines()
        at = next(i for i, line in enumerate(lines) if line.startswith("3,"))
        cells = lines[at].split(",")
        right = float(cells[6 + 4])
        cells[6 + 4] = repr(right * 1.1)
        lines[at] = ",".join(cells)
        self.path.write_text("\n".join(lines) + "\n")
        rows, summary = self.audit(self.path)
        self.assertEqual([row["misprint"] for row in rows], ["no"] * 3 + ["yes"] + ["no"] * 2)
        found = rows[3]
        self.assertEqual(found["suspect"], "c4")
        self.assertAlmostEqual(float(found["change"]) / (0.1 * right), 1.0, delta=1e-9)
        self.assertAlmostEqual(float(found["share"]), 1.0, delta=1e-9)
        self.assertLess(float(found["corrected_max"]), float(found["max_rel_err"]))
        self.assertIn("MISPRINT", summary)
        self.assertIn("misprints demonstrable: 1", summary)

    def test_swapped_digits_in_the_published_table_are_found(self):
        text = PUBLISHED.read_text()
        self.assertIn("0.068803", text)
        self.path.write_text(text.replace("0.068803", "0.086803"))
        rows, _ = self.audit(self.path)
        self.assertEqual(rows[2]["suspect"], "c3")
        self.assertAlmostEqual(float(rows[2]["change"]), 0.018, delta=1e-5)
        self.assertEqual([row["misprint"] for row in rows].index("yes"), 2)
        self.assertEqual(sum(row["misprint"] == "yes" for row in rows), 1)

    def test_what_is_wrong_in_a_file_is_named_with_its_line(self):
        header = "n,L_min,L_max,quantity,basis,degree,c0,c1\n"
        cases = [
            (header + "1,-2,1,half,monomial,1,0.1,x\n", ["c1", "'x'", ":2)"]),
            (header + "1,-2,1,half,monomial,1,0.1,nan\n", ["c1", "'nan'", ":2)"]),
            (header + "1,-2,1,half,monomial,1,0.1,1e101\n", ["1e100", ":2)"]),
            (header + "1,-2,1,both,monomial,1,0.1,1\n", ["'both'", ":2)"]),
            (header + "1,-2,1,half,bessel,1,0.1,1\n", ["'bessel'", ":2)"]),
            (header + "#\n1,-2,1,half,monomial,41,0.1,1\n", ["41", ":3)"]),
            (header + "1,-2,1,half,monomial,2,0.1,1\n", ["c2"]),
            (header + "-1,-2,1,half,monomial,1,0.1,1\n", ["-1", ":2)"]),
            (header + "10001,-2,1,half,monomial,1,0.1,1\n", ["10001", ":2)"]),
            (header + "1,1,1,half,monomial,1,0.1,1\n", ["1.00000:1.00000", ":2)"]),
            (header + "1,-9,1,half,monomial,1,0.1,1\n", ["-9", ":2)"]),
            ("index,a1,a0\n3,0,0\n", ["got 3", ":2)"]),
            ("index,a1,a0\n2,0,\n", ["a0", ":2)"]),
            ("n,c0\n1,0\n", ["L_min"]),
            (header, ["no rows"]),
            ("", ["column names must be given"]),
        ]
        for text, words in cases:
            with self.subTest(text=text):
                self.path.write_text(text)
                self.refused(1, "table", "--audit", "table.csv", says=[*words, "table.csv"])
        self.refused(1, "table", "--audit", "none.csv", says=["none.csv"])

class Pictured(TableTest):
    def test_curves(self):
        rows = self.make("--curves", "-", "--n", "2,21")
        self.assertEqual(list(rows[0]), ["n", "L", "b", "exact", "published", "rel_err"])
        self.assertEqual(len(rows), 2 * 701)
        self.assertEqual((float(rows[0]["L"]), float(rows[700]["L"])), (-4.0, 3.0))
        inside = [float(row["rel_err"]) for row in rows[:701] if -2 <= float(row["L"]) <= 1]
        self.assertAlmostEqual(max(map(abs, inside)), 2.16e-2, delta=1e-4)
        for row in rows[100:700:200]:
            ratio = float(row["published"]) / float(row["exact"]) - 1
            self.assertAlmostEqual(ratio, float(row["rel_err"]), delta=1e-12 * (2 + abs(ratio)))
            self.assert_close(float(row["exact"]), self.exact(2, float(row["b"])), 1e-15)
        self.assertTrue(all(row["published"] == "" for row in rows[701:]))

    def test_degrees(self):
        rows = self.make("--degrees", "-", "--n", "1")
        self.assertEqual(
            list(rows[0]),
            ["basis", "fit", "n", "degree", "max_rel_err", "rms_rel_err", "condition"],
        )
        self.assertEqual(len(rows), 2 * 2 * 41)
        error = {(r["basis"], r["fit"], int(r["degree"])): r for r in rows}
        for degree in range(23):
            a = float(error["monomial", "lsq", degree]["max_rel_err"])
            b = float(error["chebyshev", "lsq", degree]["max_rel_err"])
            self.assertAlmostEqual(a / b, 1.0, delta=2e-3)
        for fit in ("lsq", "minimax"):
            worst = float(error["monomial", fit, 40]["max_rel_err"])
            self.assertGreater(worst, 1e2 * float(error["chebyshev", fit, 40]["max_rel_err"]))
        self.assertLess(float(error["chebyshev", "minimax", 40]["max_rel_err"]), 4e-12)
        self.assertLess(float(error["chebyshev", "lsq", 40]["condition"]), 10)

    def test_degrees_needed(self):
        rows = self.make("--degrees", "-", "--n", "0:20")
        error = {
            (int(row["n"]), int(row["degree"])): float(row["max_rel_err"])
            for row in rows
            if row["basis"] == "chebyshev" and row["fit"] == "minimax"
        }
        for wanted, least, most in ((1e-3, 7, 9), (1e-4, 9, 12), (1e-6, 16, 21), (1e-9, 27, 33)):
            needed = [
                next(degree for degree in range(41) if error[n, degree] <= wanted)
                for n in range(21)
            ]
            self.assertEqual((min(needed), max(needed)), (least, most), wanted)


class Refused(TableTest):
    def all_refused(self, *rows):
        """Rows of a code, words that are said, and options."""
        for code, says, *options in rows:
            with self.subTest(options):
                self.refused(code, "table", *options, says=says)

    def test_monomials_double_precision_does_not_carry(self):
        self.make("--degree", 22, "--n", 1)
        self.all_refused(
            (1, ["0.148909E+13", "--basis chebyshev"], "--degree", 23),
            (1, ["--basis chebyshev"], "--degree", 23, "--fit", "minimax"),
            (1, ["--basis chebyshev"], "--degree", 15, "--range", "-8:8"),
            (1, ["--fit lsq"], "--degree", 40, "--fit", "author", "--basis", "chebyshev"))

    def test_bad_values(self):
        self.all_refused(
            (1, ["41"], "--degree", 41), (1, ["-1"], "--degree", -1),
            (2, ["six"], "--degree", "six"), (1, ["-9", "8"], "--range", "-9:1"),
            (1, ["1.00000:-2.00000"], "--range", "1:-2"), (2, ["-2,1"], "--range", "-2,1"),
            (2, [":1"], "--range", ":1"), (1, ["-2:1"], "--range", "-1:1", "--fit", "author"),
            *((2, ["--n must be", f"'{text}'"], "--n", text) for text in (
                "", "a", "1:", "5:3", "1,1", "3,2", "0:10001", "-1", "1,,2", "1:2:3", "0,")),
            (2, ["spline"], "--basis", "spline"), (2, ["lasso"], "--fit", "lasso"),
            (2, ["double"], "--quantity", "double"), (2, ["xml"], "--format", "xml"))

    def test_options_that_do_not_go_together(self):
        self.all_refused(
            (2, ["table1.csv"], PUBLISHED), (2, ["--degree"], "--audit", "--degree", 3),
            (2, ["b.csv"], "--audit", "a.csv", "b.csv"),
            (2, ["--curves"], "--audit", "--curves", "-"),
            (2, ["-o"], "--curves", "-", "-o", "x.csv"))
