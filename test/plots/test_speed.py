"""The picture of what things cost: drawn beside its file's name, bad files refused in one line."""

import unittest

import matplotlib.image

from plot_samples import Folder

FILE = "out/speed.csv"
HEADER = "group,what,us_median,us_p95,us_worst,contact,contact_us_median\n"
ROWS = ("normal,Hertz,3,4,5,,\n", "normal,strips 15,200,300,900,KPEC+FASTSIM 0.2,120\n",
        "tangential,FASTSIM 50x50,30,31,40,,\n", "batch,row,400,400,400,,\n")


def text(*rows):
    return "# faststrip 0.1.0 rev abc\n" + HEADER + "".join(rows)


class Speed(unittest.TestCase):
    def run_on(self, content):
        with Folder({FILE: content}) as folder:
            status, out, err = folder.run("speed")
            path = folder.path / "out/speed.png"
            return status, out, err, matplotlib.image.imread(path) if path.exists() else None

    def test_drawn(self):
        for rows in (ROWS, ROWS[:1]):
            status, out, err, pixels = self.run_on(text(*rows))
            self.assertEqual((status, out, err), (0, "out/speed.png\n", ""))
            self.assertGreater(min(pixels.shape[:2]), 200)
            self.assertGreater(pixels.std(), 0.05, "nothing is drawn")

    def test_refused(self):
        for old, new, says in (("3,4,5", "0,4,5", "us_median"), ("3,4,5", "3,2,5", "us_p95"),
                               ("3,4,5", "3,5,4", "us_worst"), ("3,4,5", "x,4,5", "us_median"),
                               ("us_p95", "us_p90", "us_p95")):
            status, out, err, pixels = self.run_on(text(*ROWS).replace(old, new))
            self.assertEqual((status, out, pixels), (1, "", None))
            self.assertEqual(err.count("\n"), 1, err)
            self.assertIn(says, err)
            self.assertIn(FILE, err)
