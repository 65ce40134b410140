"""The picture of batch on many contacts: drawn beside its file's name, bad files refused."""

import unittest

import matplotlib.image

from plot_samples import Folder

FILE = "out/scale.csv"
HEADER = ("group,what,contacts,processes,threads,contacts_per_core_s,efficiency,peak_MB,"
          "bytes_per_contact\n")
ROWS = ("method,a + b,100,1,1,4000,,20,\n", "threads,a + b,100,1,2,4000,0.9,20,\n",
        "parts,a + b,100,4,1,4000,0.8,20,\n", "memory,a + b,1000,1,1,4000,,21,\n",
        "memory,a + b,100000,1,1,4000,,22,\n", "format,CSV,100,,,,,,600\n",
        "on paper,a + b,1000000000,,,4000,,,\n")


class Scale(unittest.TestCase):
    def run_on(self, *rows):
        text = "# faststrip 0.1.0 rev abc\n" + HEADER + "".join(rows)
        with Folder({FILE: text}) as folder:
            status, out, err = folder.run("scale")
            path = folder.path / "out/scale.png"
            return status, out, err, matplotlib.image.imread(path) if path.exists() else None

    def test_drawn(self):
        status, out, err, pixels = self.run_on(*ROWS)
        self.assertEqual((status, out, err), (0, "out/scale.png\n", ""))
        self.assertGreater(min(pixels.shape[:2]), 200)
        self.assertGreater(pixels.std(), 0.05, "nothing is drawn")

    def test_refused(self):
        for old, new, says in ((",0.9,", ",0,", "efficiency"), (",22,", ",-22,", "peak_MB"),
                               (",600", ",x", "bytes_per_contact"),
                               ("method,", "other,", "no contacts_per_core_s of method"),
                               (",600", ",", "no bytes_per_contact of format")):
            status, out, err, pixels = self.run_on(*(row.replace(old, new) for row in ROWS))
            self.assertEqual((status, out, err.count("\n"), pixels), (1, "", 1, None), err)
            self.assertIn(says, err)
            self.assertIn(FILE, err)
