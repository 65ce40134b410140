"""Spence's integral equations: the stored figures, and the closed form for Hertz's pressures."""

import csv
import importlib.util
import math
import unittest

from harness import ROOT

TOOL = ROOT / "tools/generate/spence_reference.py"
spec = importlib.util.spec_from_file_location("spence_reference", TOOL)
spence_reference = importlib.util.module_from_spec(spec)
spec.loader.exec_module(spence_reference)


class SpenceReference(unittest.TestCase):
    def setUp(self):
        with spence_reference.FILE.open(encoding="utf-8") as stream:
            self.rows = list(csv.DictReader(stream))

    def test_stored_figures_are_made_by_the_tool(self):
        # One of them; --check is for all.
        self.assertEqual(len(self.rows), len(spence_reference.CASES))
        case = spence_reference.CASES[4]
        for name, value in zip(spence_reference.COLUMNS, (*case, *spence_reference.extrapolated(
                *case)), strict=True):
            self.assertAlmostEqual(float(self.rows[4][name]), value, delta=1e-5, msg=name)

    def test_with_pressures_of_hertz_friction_is_that_of_the_closed_form(self):
        rows = [row for row in self.rows if row["ways"] == "1"]
        self.assertEqual(len(rows), 3)
        for row in rows:
            c = float(row["stick"])
            wanted = (float(row["beta"]) * math.log((1 + c) / (1 - c)) / (2 * c)
                      / float(spence_reference.elliptic(c)))
            self.assertAlmostEqual(float(row["mu"]), wanted, delta=2e-5)
            self.assertEqual({row["load"], row["penetration"], row["pmax"]}, {"1.00000"})

    def test_principal_values(self):
        t = spence_reference.make_nodes(0.5, 400)
        at = 0.3
        found = spence_reference.cauchy(t, t[:1] + at) @ (1 - t**2)
        # int (1 - s^2)/(s - a) ds over 0 to 1
        wanted = (1 - at**2) * math.log((1 - at) / at) - at - 0.5
        self.assertAlmostEqual(float(found[0]), wanted, delta=1e-5)
