"""plots/report.py: what the manifest means, what is refused, and the two documents."""

import csv
import math
import os
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "plots"))

from faststrip_plots.document import Document  # noqa: E402
from faststrip_plots.tables import InputError  # noqa: E402
from faststrip_plots.verdicts import COLUMNS, judge, read_manifest  # noqa: E402

VALUES = "case,method,q,N_N,area_mm2\n1,a,1.0,10,3.141592653589793\n2,a,2.2,10,12.566370614359172\n3,b,,10,1\n"
TRUTH = "case,r\n1.0,1.1\n2,2\n"


class Verdicts(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "v.csv").write_text(VALUES, encoding="utf-8")
        (self.folder / "t.csv").write_text(TRUTH, encoding="utf-8")

    def judged(self, **change):
        row = dict.fromkeys(COLUMNS, "") | {
            "id": "x", "chapter": "verification", "method": "method=a", "quantity": "q",
            "value_file": "v.csv", "reference_file": f"{self.folder}/t.csv#r@case",
            "metric": "max_rel", "tolerance": "0.11",
        } | change
        path = self.folder / "m.csv"
        with path.open("w", encoding="utf-8", newline="") as stream:
            writer = csv.DictWriter(stream, COLUMNS)
            writer.writeheader()
            writer.writerow(row)
        return judge(read_manifest(str(path))[0], str(self.folder))

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
            ({"id": ""}, "id missing"), ({"chapter": "x"}, "neither verification"),
            ({"metric": "top_rel"}, "not a metric: top_rel"), ({"metric": "max_"}, "not a metric"),
            ({"tolerance": "small"}, "not a tolerance: small"),
            ({"case": "1"}, "not column=value: 1"), ({"quantity": "z"}, "missing column: z"),
            ({"reference_file": "t.csv"}, "not FILE#COLUMN@KEY"),
            ({"reference_file": f"{self.folder}/t.csv#r@case", "method": ""}, None),
        ):
            if says is None:
                self.assertEqual(self.judged(**change).word, "FAIL")
                continue
            with self.assertRaisesRegex(InputError, says):
                self.judged(**change)

    def test_a_reference_row_has_to_be_there_once(self):
        (self.folder / "t.csv").write_text("case,r\n1,1\n1,1\n2,2\n", encoding="utf-8")
        with self.assertRaisesRegex(InputError, "2 rows with case 1"):
            self.judged()
        (self.folder / "t.csv").write_text("case,r\n1,0\n2,2\n", encoding="utf-8")
        with self.assertRaisesRegex(InputError, "relative to zero"):
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
