"""The kernels can be built in single precision from the sources as they are."""

import csv
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from harness import ROOT

SCRIPT = ROOT / "tools/building/single_precision.py"


class SinglePrecision(unittest.TestCase):
    def test_built_compared_and_as_accurate_as_seven_digits_allow(self):
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "single.csv"
            outcome = subprocess.run([sys.executable, SCRIPT, "-o", out, "--folder", folder,
                                      "--flags=-O0"], check=False, stderr=subprocess.PIPE)
            self.assertEqual((0, b""), (outcome.returncode, outcome.stderr))
            rows = list(csv.DictReader(out.read_text(encoding="ascii").splitlines()))
        self.assertEqual(list(rows[0]), "chapter,case,method,x_name,x,y_name,y,quantity,value,"
                                        "reference,status".split(","))
        centre = [float(row["value"]) for row in rows if row["method"] == "strip_influence"]
        # Neither as good as double precision nor worse than a few units in the last place.
        self.assertTrue(1e-9 < max(centre) < 1e-6, max(centre))
        for row in rows:
            if row["value"] == "":
                self.assertNotEqual(row["status"], "ok", row)
            elif row["method"] == "hertz":
                self.assertLess(float(row["value"]), 1e-5, row)
            elif row["method"] in ("strips", "faststrip"):
                self.assertLess(float(row["value"]), 1e-2, row)
