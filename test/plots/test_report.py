"""plots/report.py: what the manifest means, what is refused, and the two documents."""

import csv
import math
import os
import tempfile
import unittest
from pathlib import Path

from faststrip_plots.document import Document
from faststrip_plots.tables import InputError
from faststrip_plots.verdicts import (
    COLUMNS,
    judge,
    read_manifest,
    shown,
    shown_tolerance,
)

ROOT = Path(__file__).resolve().parents[2]

VALUES = ("case,method,q,N_N,area_mm2\n1,a,1.0,10,3.141592653589793\n"
          "2,a,2.2,10,12.566370614359172\n3,b,,10,1\n")
REFERENCE = "case,r\n1.0,1.1\n2,2\n"


class Verdicts(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "v.csv").write_text(VALUES, encoding="utf-8")
        (self.folder / "t.csv").write_text(REFERENCE, encoding="utf-8")

    def judged(self, **change):
        return judge(self.row(**change), str(self.folder))

    def row(self, **change):
        row = dict.fromkeys(COLUMNS, "") | {
            "id": "x", "chapter": "verification", "method": "method=a", "quantity": "q",
            "value_file": "v.csv", "reference_file": f"{self.folder}/t.csv#r@case",
            "metric": "max_rel", "tolerance": "0.11",
        } | change
        path = self.folder / "m.csv"
        with path.open("w", encoding="utf-8", newline="") as stream:
            writer = csv.DictWriter(stream, list(row))
            writer.writeheader()
            writer.writerow(row)
        return read_manifest(str(path))[0]

    def test_metrics(self):
        for metric, wanted in (
            ("max_rel", 0.1), ("mean_rel", (0.1 / 1.1 + 0.1) / 2), ("max_abs", 0.2),
            ("min_abs", 0.1), ("rms_abs", math.sqrt((0.01 + 0.04) / 2)), ("mean_value", 1.6),
            ("median_value", 1.6), ("max_of:0.5*N_N", 0.04), ("max_of:N_N*c", 0.01),
        ):
            self.assertAlmostEqual(self.judged(metric=metric).value, wanted, 12, metric)

    def test_verdicts(self):
        self.assertEqual(self.judged().word, "pass")
        self.assertEqual(self.judged(tolerance="0.09").word, "FAIL")
        self.assertEqual(self.judged(tolerance=">0.09").word, "pass")
        self.assertEqual(self.judged(tolerance=">0.11").word, "FAIL")
        self.assertEqual(self.judged(value_file="no.csv").word, "missing")
        self.assertEqual(self.judged(method="method=c").word, "missing")
        self.assertEqual(self.judged(method="method=b").word, "FAIL")
        self.assertEqual(self.judged(case="case=1.0").rows, 1)
        self.assertEqual(self.judged(reference_file="2.2", metric="min_abs").value, 0.0)
        self.assertEqual(self.judged(reference_file="", metric="max_abs").value, 2.2)

    def test_refusals(self):
        for change, says in (
            ({"id": ""}, "id must be given, each once, got ''"),
            ({"chapter": "x"}, "chapter must be verification or validation, got x"),
            ({"metric": "top_rel"}, "_rel or _of:, got top_rel"),
            ({"metric": "max_"}, "_rel or _of:, got max_"),
            ({"tolerance": "small"}, "tolerance must be a number, got small"),
            ({"case": "1"}, "case must be column=value, got 1"),
            ({"quantity": "z"}, "missing column: z"),
            ({"reference_file": "t.csv"}, "FILE#COLUMN@KEY, got t.csv"),
            ({"reference_file": f"{self.folder}/t.csv#r@case", "method": ""}, None),
        ):
            if says is None:
                self.assertEqual(self.judged(**change).word, "FAIL")
                continue
            with self.assertRaisesRegex(InputError, says):
                self.judged(**change)

    def test_values_and_tolerances_have_units(self):
        for change, tolerance, value in (
            ({}, "≤ 11 %", "10 %"),
            ({"unit": "% of CONTACT's"}, "≤ 11 % of CONTACT's", "10 % of CONTACT's"),
            ({"metric": "max_of:0.5*N_N", "unit": "% of mu N"}, "≤ 11 % of mu N", "4 % of mu N"),
            ({"metric": "max_abs", "unit": "relative", "tolerance": ">1e-15"},
             "≥ 1e-15 relative", "0.2 relative"),
            ({"metric": "max_abs", "quantity": "area_mm2", "reference_file": ""}, "≤ 0.11 mm2",
             "12.6 mm2"),
            ({"metric": "max_abs", "unit": ""}, "≤ 0.11", "0.2"),
        ):
            row = self.row(**change)
            self.assertEqual(shown_tolerance(row), tolerance)
            self.assertEqual(shown(row, self.judged(**change).value), value)
        with self.assertRaisesRegex(InputError, "a unit of max_rel must begin with %, got mm"):
            self.row(unit="mm")

    def test_every_tolerance_of_the_project_has_a_unit(self):
        for row in read_manifest(str(ROOT / "reference" / "comparisons.csv")):
            self.assertRegex(shown_tolerance(row), r"^[≤≥] [-+.e0-9]+ [%a-z]", row["id"])
            if row["quantity"][:2].lower() in ("fx", "fy", "mz"):
                self.assertIn("% of mu N", shown_tolerance(row), row["id"])

    def test_a_reference_row_has_to_be_there_once(self):
        (self.folder / "t.csv").write_text("case,r\n1,1\n1,1\n2,2\n", encoding="utf-8")
        with self.assertRaisesRegex(InputError, "must have one row with case 1, got 2"):
            self.judged()
        (self.folder / "t.csv").write_text("case,r\n1,0\n2,2\n", encoding="utf-8")
        with self.assertRaisesRegex(InputError, "the base of max_rel must not be zero"):
            self.judged()

    def test_the_manifest_of_the_project_is_sound(self):
        rows = read_manifest(str(ROOT / "reference" / "comparisons.csv"))
        self.assertGreater(len(rows), 10)
        for row in rows:
            path = row["reference_file"].partition("#")[0]
            if "#" in row["reference_file"]:
                self.assertTrue((ROOT / path).exists(), row["id"])


class Documents(unittest.TestCase):
    def test_both_forms_hold_everything(self):
        with tempfile.TemporaryDirectory() as folder:
            picture = os.path.join(folder, "figures", "a b.png")
            os.makedirs(os.path.dirname(picture))
            Path(picture).write_bytes(b"\x89PNG")
            text = Document("Title & more")
            text.heading("First")
            text.paragraph("1 < 2")
            text.table(("a", "b"), [("x|y", "1"), ("z", "2")], bad=[1])
            text.figure(picture, "Fig", "what it shows")
            markdown, page = text.markdown(folder), text.page()
        self.assertIn("# Title & more\n\n## First\n\n1 < 2\n", markdown)
        self.assertIn("x\\|y", markdown)
        self.assertIn("![Fig](<figures/a b.png>)\n\n*Fig.* what it shows", markdown)
        self.assertIn("<h1>Title &amp; more</h1>", page)
        self.assertIn('<a href="#first">First</a>', page)
        self.assertIn("1 &lt; 2", page)
        self.assertIn('<tr class="bad"><td>z</td><td>2</td></tr>', page)
        self.assertIn("data:image/png;base64,iVBORw==", page)

    def test_tables_scroll_in_a_box_of_their_own_and_fit_the_paper(self):
        text = Document("T")
        text.table(("name", "value"), [("normal=strip;tangential=faststrip", "1.2e-05 relative")])
        text.table([f"column_{k}_with_a_long_name" for k in range(20)], [["0.12345"] * 20])
        page = text.page()
        self.assertEqual(page.count('<div class="table" tabindex="0"><table'), 2)
        self.assertEqual(page.count("</table></div>"), 2)
        self.assertIn("normal=<wbr>strip;<wbr>tangential=<wbr>faststrip", page)
        self.assertIn("<td>1.2e-05 relative</td>", page)
        self.assertEqual(page.count('<table class="many">'), 1)
        self.assertIn("div.table { overflow-x: auto", page)
        paper = page[page.index("@media print"):]
        for rule in ("div.table { overflow: visible; }", "table { width: 100%",
                     "overflow-wrap: anywhere"):
            self.assertIn(rule, paper)

    def test_no_letters_that_read_as_micronewton(self):
        for path in [*(ROOT / "plots").rglob("*.py"), *(ROOT / "app").rglob("*.f90"),
                     *(ROOT / "reference").glob("*.csv"), ROOT / "README.md",
                     ROOT / "reference" / "README.md"]:
            for line in path.read_text(encoding="utf-8").splitlines():
                self.assertNotRegex(line, "[\u00b5\u03bc] ?N|\\buN\\b|\\\\mu *N", path.name)


class Runs(unittest.TestCase):
    def setUp(self):
        with open(ROOT / "reference" / "report_runs.csv", encoding="utf-8") as stream:
            self.rows = list(csv.DictReader(line for line in stream if not line.startswith("#")))

    def test_every_file_is_made_before_it_is_read(self):
        for mode in ("full", "quick"):
            made = set()
            for row in self.rows:
                if row["when"] not in ("always", mode):
                    continue
                words = row["words"].split()
                outputs = {words[k + 1] for k, word in enumerate(words)
                           if word in ("-o", "--strips") and row["program"] != "python"
                           or word in ("-o", "--curves") and words[0] in ("table", "tools/single")}
                for word in words:
                    if word.startswith("{data}/") and word not in outputs and "*" not in word:
                        if row["id"] != "single":
                            self.assertIn(word, made, row["id"])
                made |= outputs | ({words[-1]} if row["id"] == "single" else set())

    def test_the_papers_own_methods_are_run_for_its_statements(self):
        for run in ("paper_statements", "paper_figures"):
            words = next(row["words"] for row in self.rows if row["id"] == run)
            for method in ("faststrip-paper", "faststrip-corrected"):
                files = [row["words"].split()[-1] for row in self.rows
                         if f"--tangential {method} " in row["words"]]
                self.assertEqual(len(files), 3)
                used = files if run == "paper_statements" else [f for f in files if "_A_" in f]
                for file in used:
                    self.assertIn(file, words)
