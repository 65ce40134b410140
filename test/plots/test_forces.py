"""plots/forces.py and plots/tractions.py: drawn from what the program writes, bad input refused."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

import matplotlib.image
import numpy

import forces
import tractions
from faststrip_plots import command
from faststrip_plots.tables import read_table

ROOT = Path(__file__).resolve().parents[2]

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

    def test_curves_show_each_contact_and_its_error(self):
        table = read_table(str(CONTACTS / "hertz_creep.csv"), ("case",))
        groups = table.words("case")
        lines = ["set,group,case,method,Fx_err,Fy_err,force_err,Mz_err"]
        lines += [f"hertz,{group},{k + 1},{method},{0.1 * k},{0.2 * k},0.0,{0.3 * k}"
                  for method in forces.METHODS for k, group in enumerate(groups)]
        (self.folder / "forces.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
        errors = forces.Errors(read_table(self.path("forces.csv"), ("set",)))
        figure = forces.curves_figure(errors, str(CONTACTS))
        names = ("a_mm", "b_mm", "a_over_b", "u", "mu", "N", "Fx_extrap", "Fy_extrap", "Mz_extrap")
        value = {name: table.numbers(name) for name in names}
        bound = value["mu"] * value["N"]
        c = numpy.sqrt(value["a_mm"] * value["b_mm"])
        number = numpy.arange(len(groups))
        rows = (("long", value["Fx_extrap"] / bound, 1e-3),
                ("spin", value["Fy_extrap"] / bound, 2e-3),
                ("spin", value["Mz_extrap"] / (bound * c), 3e-3))
        for row, (group, force, error) in enumerate(rows):
            for column, ratio in enumerate(forces.RATIOS):
                chosen = numpy.flatnonzero((numpy.array(groups) == group)
                                           & numpy.isclose(value["a_over_b"], ratio))
                chosen = chosen[numpy.argsort(value["u"][chosen])]
                drawn = figure.axes[3 * row + column].get_lines()
                self.assertEqual(len(drawn), len(forces.METHODS) + 1)
                for line in drawn:
                    off = 0.0 if line.get_marker() == "o" else error * number[chosen]
                    numpy.testing.assert_allclose(line.get_xdata(), value["u"][chosen])
                    numpy.testing.assert_allclose(line.get_ydata(), -(force[chosen] + off),
                                                  rtol=1e-6, atol=1e-9)

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
