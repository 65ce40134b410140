"""plots/forces.py and plots/tractions.py: drawn from what the program writes, bad input refused."""

import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path

import matplotlib.image

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "plots"))

import forces  # noqa: E402
import tractions  # noqa: E402
from faststrip_plots import command  # noqa: E402
from faststrip_plots.tables import read_table  # noqa: E402

CONTACTS = ROOT / "reference" / "contact"


class Forces(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def path(self, name):
        return str(self.folder / name)

    def write_forces(self, methods):
        groups = read_table(str(CONTACTS / "hertz_creep.csv"), ("case",)).words("case")
        lines = ["set,group,case,method,Fx_err,Fy_err,force_err,Mz_err"]
        for method in methods:
            for name, cases in (("hertz", groups), ("s1002_uic60_B", ["all"] * 20),
                                ("scenes", ["odd", "even"])):
                lines += [f"{name},{group},{number + 1},{method},1.0,-0.5,1.1,2.0"
                          for number, group in enumerate(cases)]
        (self.folder / "forces.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
        lines = ["method,strips,us,elements"]
        lines += [f"{method},15,{3.0 + i},225" for i, method in enumerate(methods)]
        (self.folder / "times.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")

    def draw(self):
        said, refused = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(refused):
            code = command.run(forces.main, [
                "--forces", self.path("forces.csv"), "--times", self.path("times.csv"),
                "--contacts", str(CONTACTS), "--curves", self.path("curves.png"),
                "--shifts", self.path("shifts.png"), "--trade", self.path("trade.png")])
        return code, said.getvalue(), refused.getvalue()

    def test_three_pictures(self):
        self.write_forces(forces.METHODS)
        code, said, refused = self.draw()
        self.assertEqual((code, refused), (0, ""))
        for name in ("curves.png", "shifts.png", "trade.png"):
            self.assertIn(self.path(name), said)
            self.assertGreater(matplotlib.image.imread(self.path(name)).std(), 0.02)

    def test_bad_input(self):
        self.write_forces([*forces.METHODS, "guess"])
        code, _, refused = self.draw()
        self.assertEqual(code, 1)
        self.assertIn("guess", refused)
        self.write_forces(list(forces.METHODS)[1:])
        code, _, refused = self.draw()
        self.assertEqual(code, 1)
        self.assertIn("faststrip", refused)

    def test_tractions(self):
        picture = self.path("tractions.png")
        field = str(CONTACTS / "fields" / "shift_0_B.csv")
        with contextlib.redirect_stdout(io.StringIO()) as said:
            code = command.run(tractions.main, ["--fields", field, "--contact", field,
                                                "-o", picture])
        self.assertEqual(code, 0)
        self.assertIn(picture, said.getvalue())
        # The same field twice: both halves of the picture alike, but for the colour bar.
        self.assertGreater(matplotlib.image.imread(picture).std(), 0.05)
        with contextlib.redirect_stderr(io.StringIO()) as refused:
            code = command.run(tractions.main, ["--fields", field, "--shift", "17", "-o", picture])
        self.assertEqual(code, 1)
        self.assertIn("17", refused.getvalue())


if __name__ == "__main__":
    unittest.main()
