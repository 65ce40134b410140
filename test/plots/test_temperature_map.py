"""plots/temperature_map.py: drawn from elements with temperatures, refused without them."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

import matplotlib.image

import temperature_map
from faststrip_plots import command

HEAD = "case,x_mm,y_mm,area_mm2,state,pn_MPa,px_MPa,py_MPa,sx,sy,power_MPa," \
       "surface_wheel_C,surface_rail_C\n"


class TemperatureMap(unittest.TestCase):
    def draw(self, hot):
        with tempfile.TemporaryDirectory() as folder:
            path, picture = Path(folder) / "fields.csv", Path(folder) / "map.png"
            rows = [f"c,{x},{y},1,2,500,150,0,-0.01,0,1.5," + (f"{t},{t}" if hot else ",")
                    for y in (-1.5, -0.5, 0.5, 1.5) for x, t in ((1, 60), (0, 140), (-1, 210))]
            path.write_text(HEAD + "\n".join(rows) + "\n", encoding="utf-8")
            with contextlib.redirect_stdout(io.StringIO()), \
                    contextlib.redirect_stderr(io.StringIO()) as refused:
                code = command.run(temperature_map.main, ["--fields", str(path), "-o",
                                                          str(picture)])
            return code, refused.getvalue(), matplotlib.image.imread(picture) if code == 0 else None

    def test_a_map(self):
        code, _, picture = self.draw(True)
        self.assertEqual(code, 0)
        self.assertGreater(picture.std(), 0.05)

    def test_without_temperatures(self):
        code, refused, _ = self.draw(False)
        self.assertEqual(code, 1)
        self.assertIn("&thermal", refused)
