"""What the commands share: styles, curves through strips, borders of grids, sweeps."""

import math
import unittest

import numpy as np
import PIL.Image

# First: it finds the plots' package.
from plot_samples import (
    Folder,
    failed_row,
    fields_text,
    grid_text,
    hertz_row,
    profiles_text,
    reference_text,
    strips_text,
    sweep_row,
    sweep_text,
)

# isort: split
from faststrip_plots import panels, results, scales, style
from faststrip_plots.tables import InputError, read_table


class Styles(unittest.TestCase):
    def test_methods_differ_in_grey_and_in_line(self):
        looks = list(style.METHOD.values())
        for k, look in enumerate(looks):
            for other in looks[k + 1:]:
                distance = abs(style.luminance(look.colour) - style.luminance(other.colour))
                self.assertGreater(distance, 0.12, (look.label, other.label))
                self.assertNotEqual(look.line, other.line)
                self.assertNotEqual(look.label, other.label)

    def test_a_method_looks_like_its_normal_part(self):
        for normal, tangential in (("strip", "faststrip"), ("hertz", "fastsim"),
                                   ("norm", "tang")):
            self.assertEqual(style.normal_look(normal).colour,
                             style.method_look(normal, tangential).colour)

    def test_unknown_methods_get_their_own_names(self):
        self.assertEqual(style.method_look("best", "guess").label, "best + guess")
        self.assertEqual(style.normal_look("best").label, "best")

    def test_numbers_in_titles(self):
        self.assertEqual(style.number(-5.0), "\u22125")
        self.assertEqual(style.number(-0.0), "0")
        self.assertEqual(style.number(0.25), "0.25")

    def test_the_picture_carries_every_revision_once(self):
        figure = style.new_figure(4.0, 3.0)
        figure.subplots()
        with Folder({}) as folder:
            style.save(figure, str(folder.path / "a.png"), ["faststrip 1", None, "faststrip 2",
                                                            "faststrip 1"])
        self.assertEqual(figure.get_supxlabel(), "faststrip 1; faststrip 2")

    def test_the_few_colours_of_a_picture_are_those_drawn(self):
        figure = style.new_figure(4.0, 3.0)
        figure.subplots().imshow(np.arange(400.0).reshape(20, 20), cmap=style.MAP)
        with Folder({}) as folder:
            style.save(figure, str(folder.path / "a.png"), [])
            with PIL.Image.open(folder.path / "a.png") as picture:
                self.assertEqual((picture.mode, picture.size), ("P", (600, 450)))
                pixels = np.asarray(picture.convert("RGB"), int)
        figure.set_dpi(style.DPI)
        figure.canvas.draw()
        drawn = np.asarray(figure.canvas.buffer_rgba())[..., :3].astype(int)
        self.assertGreater(len(np.unique(drawn.reshape(-1, 3), axis=0)), 300)
        self.assertLess(np.abs(pixels - drawn).max(), 16)


class Scales(unittest.TestCase):
    def test_what_has_no_logarithm_leaves_a_hole(self):
        found = scales.positive(np.array([2.0, 0.0, -3.0, math.nan, 1e-300]))
        self.assertEqual(list(np.isnan(found)), [False, True, True, True, False])
        self.assertEqual((found[0], found[4]), (2.0, 1e-300))

    def test_the_exponent_of_a_power_with_a_factor(self):
        x = np.array([1.0, 2.0, 5.0, -1.0, 0.0])
        self.assertAlmostEqual(scales.power(x, 7.0 * np.abs(x) ** -1.5 * np.sign(x + 0.5)), -1.5)
        self.assertTrue(math.isnan(scales.power(x[:1], x[:1])))

    def test_groups_in_the_order_of_their_first_rows(self):
        found = scales.groups(["b", "a", "b"], [1, 1, 1])
        self.assertEqual([(key, list(rows)) for key, rows in found],
                         [(("b", 1), [0, 2]), (("a", 1), [1])])


class Tables(unittest.TestCase):
    def read(self, text, *names):
        with Folder({"a.csv": text}) as folder:
            return read_table(str(folder.path / "a.csv"), names)

    def test_metadata_blanks_quotes_and_line_numbers(self):
        table = self.read('# one\n\n#two\n a , b\n1.5e3, "x, y"\n\n# within\n-2,z\n', "a", "b")
        self.assertEqual(table.comments, ["one", "two", "within"])
        self.assertEqual(list(table.numbers("a")), [1500.0, -2.0])
        self.assertEqual(table.words("b"), ["x, y", "z"])
        self.assertEqual((table.header_line, table.lines), (4, [5, 8]))

    def test_doubles_round_trip(self):
        values = [0.1, 1.0 / 3.0, 1e-300, -2.5e300, math.pi]
        table = self.read("a\n" + "\n".join(f"{value:.16E}" for value in values) + "\n")
        self.assertEqual(list(table.numbers("a")), values)

    def test_empty_cells(self):
        table = self.read("a,b\n,1\n2,\n")
        self.assertTrue(math.isnan(table.numbers("a", missing=True)[0]))
        with self.assertRaisesRegex(InputError,
                                    r"b must be a number, got an empty cell \(.*a.csv:3\)"):
            table.numbers("b")


class Sweeps(unittest.TestCase):
    def read(self, *rows):
        with Folder({"s.csv": sweep_text(*rows)}) as folder:
            return results.read_sweep(str(folder.path / "s.csv"))

    def test_rows_are_sorted_and_failures_are_holes(self):
        sweep = self.read(hertz_row(2, pmax_MPa=7), failed_row(1), sweep_row(0), hertz_row(-1))
        hertz, strip = sweep.methods
        self.assertEqual(list(hertz.yw), [-1, 1, 2])
        self.assertEqual(list(hertz.ok), [True, False, True])
        self.assertEqual(hertz.failures, {"no_hertz_ellipse": 1})
        self.assertEqual(hertz.values["pmax_MPa"][2], 7)
        self.assertTrue(np.isnan(hertz.values["pmax_MPa"][1]))
        self.assertEqual(strip.key, ("strip", "faststrip"))
        self.assertEqual(sweep.stamp, "faststrip 0.1.0 rev abc1234")

    def test_figures_of_a_failed_row_are_not_used(self):
        method = self.read(sweep_row(0, status="no_convergence")).methods[0]
        self.assertTrue(np.isnan(method.values["Fx_N"][0]))
        self.assertIsNone(method.row_at(0.0))

    def test_normal_figures_come_once_per_normal_method(self):
        sweep = self.read(failed_row(0, normal="strip"), sweep_row(0), hertz_row(0))
        self.assertEqual([m.key for m in sweep.normals()],
                         [("strip", "faststrip"), ("hertz", "fastsim")])

    def test_hertz_ellipse_of_a_shift(self):
        sweep = self.read(hertz_row(1, ymin_mm=-4, ymax_mm=2, xmax_mm=5), failed_row(2))
        ellipse = panels.hertz_ellipse(sweep, 1.0)
        self.assertEqual((ellipse.middle, ellipse.b, ellipse.a), (-1.0, 3.0, 5.0))
        self.assertIsNone(panels.hertz_ellipse(sweep, 2.0))
        self.assertIsNone(panels.hertz_ellipse(sweep, 3.0))

    def test_ratios_only_where_the_reference_is_not_near_zero(self):
        # mu N = 3000 N: 5 % of it is 150 N
        for force, shown in ((149.0, False), (-149.0, False), (151.0, True), (-151.0, True)):
            with self.subTest(force), Folder(
                {"r.csv": reference_text(0, Fx_extrap_N=force)}
            ) as folder:
                reference = results.read_reference(str(folder.path / "r.csv"))
                figure = style.new_figure(4.0, 3.0)
                axes = figure.subplots()
                beyond = panels.draw_ratio(axes, self.read(sweep_row(0, Fx_N=1.5 * force)),
                                           reference, "Fx", 0.3)
                ratio = axes.lines[0].get_ydata()[0]
                self.assertFalse(beyond)
                if shown:
                    self.assertAlmostEqual(ratio, 1.5, places=14)
                else:
                    self.assertTrue(np.isnan(ratio))

    def test_normal_figures_have_ratios_everywhere(self):
        with Folder({"r.csv": reference_text(0, 1)}) as folder:
            reference = results.read_reference(str(folder.path / "r.csv"))
        for name, column, value in (("penetration", "penetration_mm", 0.06),
                                    ("pmax", "pmax_MPa", 1200.0)):
            axes = style.new_figure(4.0, 3.0).subplots()
            sweep = self.read(sweep_row(0, **{column: value}), sweep_row(1))
            self.assertFalse(panels.draw_ratio(axes, sweep, reference, name, 0.3))
            np.testing.assert_allclose(axes.lines[0].get_ydata(), [1.2, 1.0], rtol=1e-14)

    def test_differences_are_percentages_of_friction(self):
        with Folder({"r.csv": reference_text(0)}) as folder:
            reference = results.read_reference(str(folder.path / "r.csv"))
        # 60 of mu N = 3000 N, -120 of mu N c = 6000 N mm
        for name, column, value, expected in (("Fy", "Fy_N", -440.0, 2.0),
                                              ("Mz", "Mz_Nmm", 480.0, -2.0)):
            axes = style.new_figure(4.0, 3.0).subplots()
            panels.draw_difference(axes, self.read(sweep_row(0, **{column: value})), reference,
                                   name, 0.3)
            self.assertAlmostEqual(axes.lines[0].get_ydata()[0], expected, places=12)

    def test_ratios_beyond_the_axis_are_marked(self):
        for factor, end in ((3.0, 2.0), (-1.0, 0.0)):
            with self.subTest(factor), Folder({"r.csv": reference_text(0)}) as folder:
                reference = results.read_reference(str(folder.path / "r.csv"))
                axes = style.new_figure(4.0, 3.0).subplots()
                sweep = self.read(sweep_row(0, Fx_N=factor * 1000.0))
                self.assertTrue(panels.draw_ratio(axes, sweep, reference, "Fx", 0.3))
                self.assertEqual(list(axes.lines[1].get_ydata()), [end])


class Patches(unittest.TestCase):
    def read(self, function, text):
        with Folder({"a.csv": text}) as folder:
            return function(str(folder.path / "a.csv"))

    def test_the_curve_through_strips_of_an_ellipse_is_the_ellipse(self):
        patch = self.read(results.read_strips, strips_text()).patches[0]
        y, half = patch.smooth(patch.half_length)
        self.assertAlmostEqual(y[0], -3.0, places=12)
        self.assertAlmostEqual(y[-1], 2.0, places=12)
        exact = 1.5 * np.sqrt(np.maximum(0.0, 1.0 - ((y + 0.5) / 2.5) ** 2))
        self.assertLess(np.abs(half - exact).max(), 1e-7)

    def test_the_curve_passes_through_the_strips(self):
        patch = self.read(results.read_strips, strips_text()).patches[0]
        values = np.array([1.0, 3.0, 2.0, 4.0, 1.5])
        y, curve = patch.smooth(values, points=20001)
        self.assertLess(np.abs(np.interp(patch.y, y, curve) - values).max(), 1e-5)

    def test_the_curve_does_not_pinch_a_patch_between_its_strips(self):
        patch = self.read(results.read_strips, strips_text()).patches[0]
        y, curve = patch.smooth(np.array([9.0, 0.3, 0.3, 9.0, 0.2]))
        self.assertGreater(curve[(y > patch.y[0]) & (y < patch.y[-1])].min(), 0.1)

    def test_patches_are_kept_apart(self):
        strips = self.read(results.read_strips, strips_text(2))
        self.assertEqual([len(patch.y) for patch in strips.patches], [5, 5])
        self.assertEqual(strips.patches[1].y_left[0], 5.0)

    def test_border_of_a_grid(self):
        field = self.read(results.read_field, grid_text(0.25))
        self.assertEqual(results.grid_step(field), 0.25)
        y, x = panels.border(field, spacing=2.0)
        # on the ellipse within an element
        inside = (np.abs(x) - 0.25, np.abs(y + 0.5) - 0.25)
        outside = (np.abs(x) + 0.25, np.abs(y + 0.5) + 0.25)
        level = [(np.maximum(a, 0.0) / 1.5) ** 2 + (np.maximum(b, 0.0) / 2.5) ** 2
                 for a, b in (inside, outside)]
        self.assertTrue((level[0] <= 1.0).all())
        self.assertTrue((level[1] >= 1.0).all())
        # all the way round, never far from the next point
        angle = np.sort(np.arctan2(x / 1.5, (y + 0.5) / 2.5))
        self.assertLess(np.diff(np.append(angle, angle[0] + 2.0 * math.pi)).max(), 0.8)

    def test_tiles_fill_the_strips(self):
        strips = self.read(results.read_strips, strips_text(2))
        field = self.read(results.read_field, fields_text(2))
        axes = style.new_figure(4.0, 3.0).subplots()
        tiles = panels.draw_strip_pressure(axes, strips, field, 1000.0)
        self.assertEqual(len(tiles.get_array()), 2 * 5 * 4)
        area = sum(np.ptp(path.vertices[:, 0]) * np.ptp(path.vertices[:, 1])
                   for path in tiles.get_paths())
        expected = sum((2.0 * p.half_length * (p.y_right - p.y_left)).sum() for p in strips.patches)
        self.assertAlmostEqual(area, expected, places=10)

    def test_distance_between_profiles(self):
        profiles = self.read(results.read_profiles, profiles_text())
        y, distance = panels.distance(profiles)
        self.assertEqual((y[0], y[-1]), (720.0, 780.0))
        at = np.argmin(distance)
        self.assertAlmostEqual(y[at], 750.0, delta=0.02)
        self.assertAlmostEqual(distance[0], 900.0 * (1 / 500 + 1 / 600), places=10)
