"""Measured figures: one file holds them, and the documents are filled from it."""

import contextlib
import io
import re
import shutil
import tempfile
import unittest
from pathlib import Path

import measured
import validation
from faststrip_plots.tables import InputError

ROOT = Path(__file__).resolve().parents[2]

STAMP = "# faststrip 0.1.0 rev 0123abc\n# compiler GCC, -O3\n"
# Words of measured figures outside of marked places: errors, times.
FIGURE = re.compile(r"\d\s?(?:%|[mµun]s\b)")


def run(*words):
    """Exit code and stderr of the tool."""
    stderr, stdout = io.StringIO(), io.StringIO()
    with contextlib.redirect_stderr(stderr), contextlib.redirect_stdout(stdout):
        code = validation.main([str(word) for word in words])
    return code, stderr.getvalue()


class OfTheProject(unittest.TestCase):
    def test_documents_are_as_the_tool_writes_them(self):
        self.assertEqual(run("--check"), (0, ""))

    def test_figures_are_shown_in_the_readme_and_the_method(self):
        for name, least in (("README.md", 1), ("docs/choosing.md", 2), ("docs/method.md", 4),
                            ("docs/usage.md", 1)):
            text = (ROOT / name).read_text(encoding="utf-8")
            self.assertGreaterEqual(len(validation.PLACE.findall(text)), least, name)

    def test_no_figure_is_typed_by_hand(self):
        for name in ("README.md", "docs/choosing.md", "docs/usage.md", "docs/embedding.md",
                     "docs/architecture.md", "docs/formats.md"):
            text = (ROOT / name).read_text(encoding="utf-8")
            for line in validation.PLACE.sub("", text).splitlines():
                self.assertNotRegex(line, FIGURE, name)

    def test_every_comparison_is_in_the_page(self):
        page = (ROOT / validation.PAGE).read_text(encoding="utf-8")
        figures = validation.Figures(ROOT)
        ids = [row["id"] for row in figures.manifest]
        self.assertGreater(len(ids), 40)
        self.assertEqual([name for name in ids if f"| `{name}` |" not in page], [])

    def test_comparisons_and_the_table_of_the_same_contacts_agree(self):
        figures = validation.Figures(ROOT)
        rows = [row for row in figures.manifest if row["value_file"] == "sweep.csv"]
        self.assertEqual(len(rows), 12)
        for row in rows:
            _, name, which = row["id"].split("-")
            of_table = figures.measured.number("contacts", "strip + faststrip", f"{name}_{which}")
            judged = 100.0 * figures.measured.number("verdicts", row["id"], "value")
            # c is of CONTACT's patch here and of the strips' there: areas differ by 0.6 % at most.
            self.assertAlmostEqual(judged / of_table, 1.0, delta=4e-3, msg=row["id"])

    def test_every_table_of_the_file_is_shown(self):
        shown = set()

        class Watched(measured.Measured):
            def word(self, table, row, column):
                shown.add(table)
                return super().word(table, row, column)

        figures = validation.Figures(ROOT)
        figures.measured = Watched(ROOT / validation.MEASURED)
        for table in validation.TABLES.values():
            table(figures)
        tables = {table for table, _, _ in figures.measured.cells}
        self.assertEqual(tables - shown, {"audit"})  # in docs/method.md


class InACopy(unittest.TestCase):
    """The documents of the project, changed."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        for name in ("README.md", "CONTRIBUTING.md", validation.MEASURED, validation.MANIFEST,
                     validation.CLAIMS, validation.ESTIMATED, validation.SPEED,
                     validation.PAINTED, validation.SCALE):
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, self.root / name)
        shutil.copytree(ROOT / "docs", self.root / "docs")

    def change(self, name, old, new):
        path = self.root / name
        text = path.read_text(encoding="utf-8")
        self.assertIn(old, text)
        path.write_text(text.replace(old, new, 1), encoding="utf-8")

    def check(self):
        return run("--check", "--root", self.root)

    def test_a_figure_changed_by_hand_is_named_and_mended(self):
        good = (self.root / "README.md").read_text(encoding="utf-8")
        for name, old, new in (("README.md", "| Hertz + FASTSIM | ", "| Hertz + FASTSIM | 9"),
                               (validation.PAGE, "| holds |", "| does not hold |"),
                               ("docs/method.md", "times |", "Times |")):
            self.change(name, old, new)
            code, words = self.check()
            self.assertEqual(code, 1)
            self.assertEqual(words.count("\n"), 1)
            self.assertIn(f"not as measured: {name}", words)
            self.assertEqual(run("--root", self.root)[0], 0)
            self.assertEqual(self.check(), (0, ""))
        self.assertEqual((self.root / "README.md").read_text(encoding="utf-8"), good)

    def test_a_new_measurement_reaches_every_place(self):
        path = self.root / validation.MEASURED
        text = path.read_text(encoding="utf-8")
        path.write_text(re.sub(r"(?m)^(contacts,hertz \+ fastsim,Fx_max,).*$", r"\g<1>77.7", text),
                        encoding="utf-8")
        words = self.check()[1]
        self.assertIn("README.md", words)
        self.assertIn(validation.PAGE, words)
        run("--root", self.root)
        for name in ("README.md", validation.PAGE):
            self.assertIn("/ 78 |", (self.root / name).read_text(encoding="utf-8"))

    def test_new_times_reach_both_pages(self):
        path = self.root / validation.SPEED
        lines = path.read_text(encoding="utf-8").splitlines()
        place = next(k for k, line in enumerate(lines) if line.startswith("normal,strips 15,"))
        names = next(line for line in lines if line.startswith("group,")).split(",")
        cells = lines[place].split(",")
        cells[names.index("us_worst")], cells[names.index("worst_case")] = "98765", "shift_77"
        lines[place] = ",".join(cells)
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")
        self.assertIn("docs/choosing.md", self.check()[1])
        run("--root", self.root)
        for name in ("docs/choosing.md", validation.PAGE):
            self.assertIn("/ 98765 | shift_77 |",
                          (self.root / name).read_text(encoding="utf-8"))
        self.assertEqual(self.check(), (0, ""))

    def test_a_tolerance_is_judged_anew_and_a_new_row_is_not_measured(self):
        self.change(validation.MANIFEST, "mean_rel,0.0005,", "mean_rel,0.0001,")
        path = self.root / validation.MANIFEST
        rows = path.read_text(encoding="utf-8")
        last = rows.splitlines()[-1]
        path.write_text(rows + "new-one," + last.split(",", 1)[1] + "\n", encoding="utf-8")
        run("--root", self.root)
        page = (self.root / validation.PAGE).read_text(encoding="utf-8")
        self.assertRegex(page, r"`strips-penetration-mean` .*\| ≤ 0.01 % \| does not hold \|")
        self.assertRegex(page, r"`new-one` \| – \| – .*\| not measured yet \|")

    def test_places_that_cannot_be_filled_are_refused(self):
        readme = self.root / "README.md"
        good = readme.read_text(encoding="utf-8")
        for place, words in (
            ("<!-- measured: contacts -->", "every marked place must end: README.md"),
            ("<!-- measured: no/such/figure -->1<!-- end -->", "no such figure: no/such/figure"),
            ("<!-- measured: nothing -->1<!-- end -->",
             "must be a table or TABLE/ROW/COLUMN, got nothing"),
        ):
            readme.write_text(f"{good}\n{place}\n", encoding="utf-8")
            with self.assertRaisesRegex(InputError, words):
                self.check()
        readme.write_text(f"{good}\n```\n<!-- measured: nothing -->\n```\n", encoding="utf-8")
        self.assertEqual(self.check(), (0, ""))


class Condensing(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def csv(self, name, *lines, stamp=STAMP):
        path = self.folder / name
        path.write_text(stamp + "\n".join(lines) + "\n", encoding="utf-8")
        return str(path)

    def test_numbers_as_people_read_them(self):
        for value, words in ((0.0, "0"), (3.87e-16, "3.9e-16"), (0.00396, "0.0040"),
                             (0.0999, "0.10"), (0.951, "0.95"), (1.0, "1.0"), (9.94, "9.9"),
                             (9.96, "10"), (48.7, "49"), (1234.5, "1234"), (-0.5, "-0.50"),
                             (0.996, "1.0"), (0.000123, "0.00012")):
            self.assertEqual(validation.digits(value), words)

    def test_shares_that_are_bounded(self):
        """A truth in doubt does not count; neither does its estimate."""
        rows = measured.estimates_rows(self.csv(
            "c.csv", "family,estimator,quantity,true_err,est_err,covered",
            "noise,residuals,pmax,0.1,0.3,1", "worn,residuals,pmax,0.2,0.1,0",
            "worn,residuals,pmax,0.2,0.8,1", "worn,residuals,pmax,0.0,9.0,",
            "ellipses,residuals,pmax,0.1,0.2,1"))
        found = {(row, column): value for _, row, column, value in rows}
        self.assertEqual(found["residuals, random families", "pmax_cases"], "3")
        self.assertAlmostEqual(found["residuals, random families", "pmax_bounded"], 2 / 3)
        self.assertAlmostEqual(found["residuals, random families", "pmax_ratio"], 3.0)
        self.assertEqual(found["residuals, ellipses", "pmax_cases"], "1")

    def test_the_worst_force_counts_and_times_are_of_the_same_contacts(self):
        rows = measured.trade_rows(self.csv(
            "t.csv", "stage,method,us,err_Fx,err_Fy,err_Mz",
            "both,a,1000,0.01,-0.03,0.02", "both,a,3000,0.05,0.0,0.0", "both,a,9000,,,",
            "normal,a,1,0.9,0.9,0.9"))
        found = {column: value for _, _, column, value in rows}
        self.assertEqual(found["contacts"], "2")
        self.assertAlmostEqual(found["error_mean"], 4.0)
        self.assertAlmostEqual(found["error_max"], 5.0)
        self.assertEqual(found["ms_worst"], 3.0)

    def test_files_of_different_runs_are_refused(self):
        line = ("method,loop,ns,rel_err,cpu", "closed,row,1,1e-16,a cpu")
        self.csv("bench_integral.csv", *line)
        lines = measured.stamp_lines(self.folder)
        self.assertEqual(lines, [*STAMP.splitlines(), "# processor a cpu"])
        self.csv("other.csv", "a", "1", stamp=STAMP.replace("0123abc", "4567def"))
        with self.assertRaisesRegex(InputError, "stamps must be of one run, got "):
            measured.stamp_lines(self.folder)

    def test_what_is_written_is_read(self):
        text = measured.measured_csv(STAMP.splitlines(),
                                     [("t", "a, b", "c", 1 / 3), ("t", "a, b", "d", "12")])
        path = self.folder / "m.csv"
        path.write_text(text, encoding="utf-8")
        table = measured.Measured(path)
        self.assertEqual(table.rows("t"), ["a, b"])
        self.assertEqual(table.number("t", "a, b", "c"), 0.333333)
        self.assertEqual(table.word("t", "a, b", "d"), "12")
        path.write_text(text + 't,"a, b",d,13\n', encoding="utf-8")
        with self.assertRaisesRegex(InputError,
                                    "each figure must be given once, got t/a, b/d twice"):
            measured.Measured(path)
