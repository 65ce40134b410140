"""What all pictures keep to: degrees, holes at jumps, equal scales, widths of patches, colours that
the colour blind tell apart, numbers of one kind on an axis."""

import itertools
import pathlib
import re
import unittest
from unittest import mock

import numpy as np

from plot_samples import (
    PLOTS,
    Folder,
    hertz_row,
    load,
    profiles_text,
    reference_text,
    strips_text,
    sweep_row,
    sweep_text,
)
from test_pictures import FILES

# isort: split
from faststrip_plots import picture, style

# From linear red, green and blue to what those without green or red cones see (Machado, Oliveira
# and Fernandes 2009, severity 1).
BLIND = {"seen by all": np.eye(3),
         "without green": ((0.367322, 0.860646, -0.227968), (0.280085, 0.672501, 0.047413),
                           (-0.011820, 0.042940, 0.968881)),
         "without red": ((0.152286, 1.052583, -0.204868), (0.114503, 0.786281, 0.099216),
                         (-0.003882, -0.048116, 1.051998))}
LAB = np.array([[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750],
                [0.0193339, 0.1191920, 0.9503041]])
LEAST_APART = 15.0  # CIE76 between two lines of one picture


def seen(colour, kind):
    """Lightness and both opponents (CIE L*a*b*) of a colour as someone sees it."""
    values = np.array([int(colour[k:k + 2], 16) / 255.0 for k in (1, 3, 5)])
    linear = np.where(values > 0.04045, ((values + 0.055) / 1.055)**2.4, values / 12.92)
    tristimulus = LAB @ np.clip(np.array(BLIND[kind]) @ linear, 0.0, 1.0)
    x, y, z = np.cbrt(tristimulus / LAB.sum(axis=1))
    return np.array([116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)])


def figures(command, *arguments, files=FILES):
    """The figures a command saves, by the names of their files; that they can be drawn is tested
    in test_pictures.py."""
    found = {}

    def save(figure, path, *_):
        found[pathlib.Path(path).name] = figure

    with mock.patch.object(picture, "save", save), Folder(files) as folder:
        status, _, err = folder.run(command, *arguments)
    assert status == 0, err
    return found


def titled(figure, words):
    """The one panel whose title or label of y holds some words."""
    panel, = [axes for axes in figure.axes
              if words in axes.get_title(loc="left") + axes.get_ylabel()]
    return panel


class Rules(unittest.TestCase):
    def test_angles_are_in_degrees(self):
        shown = titled(figures("wheelset", "--states", "states.csv")["wheelset_sweep.png"],
                       "contact angle, degrees")
        values = np.concatenate([line.get_ydata() for line in shown.lines])
        self.assertAlmostEqual(np.nanmin(values), -63.0254, places=3)
        angles = titled(figures("conicity")["conicity.png"], "Contact angles")
        self.assertEqual(angles.get_ylabel(), "angle, degrees")
        self.assertAlmostEqual(np.nanmin([line.get_ydata()[0] for line in angles.lines]),
                               -4.0107, places=3)
        for path in PLOTS.rglob("*.py"):
            for label in re.findall(r'[xy]label="[^"]*"', path.read_text(encoding="utf-8")):
                self.assertNotRegex(label, r"\brad\b", path.name)

    def test_no_line_across_a_jump(self):
        self.assertEqual(style.jumps([0.0, 0.2, 0.4, 1.4], [0.0, 3.0, 7.0, 13.0], [9.0] * 4),
                         [False, True, False])
        x, y = style.broken([False, True], [1, 2, 3], [4, 5, 6])
        np.testing.assert_array_equal(x, [1, 2, np.nan, 3])
        np.testing.assert_array_equal(y, [4, 5, np.nan, 6])
        right, left = titled(figures("conicity")["conicity.png"], "Contact angles").lines[:2]
        self.assertEqual([np.isnan(line.get_ydata()).sum() for line in (right, left)], [1, 0])
        # The right contact goes from tread to flange, the left one stays.
        files = FILES | {"out/wheelset.csv": FILES["out/wheelset.csv"].replace(
            "-6,-4,-5,6\n", "-38,-32,-1,1\n")}
        for where, holes in ((FILES, 0), (files, 1)):
            shown = titled(figures("wheelset", "--states", "states.csv", files=where)[
                "wheelset_sweep.png"], "$N$ on the rail")
            # Beside the state without a contact.
            count = {line.get_label(): np.isnan(line.get_ydata()).sum() - 1
                     for line in shown.lines if line.get_label() in ("left", "right")}
            self.assertEqual(count, {"left": 0, "right": holes})

    def test_a_sweep_has_a_hole_where_the_contact_point_jumps(self):
        for far, holes in ((10.0, 1), (0.0, 0)):
            moved = {"ymin_mm": -3.0 + far, "ymax_mm": 2.0 + far}
            rows = [sweep_row(0), sweep_row(1, **moved), hertz_row(0), hertz_row(1)]
            drawn = figures("sweep", files={
                "out/sweep.csv": sweep_text(*rows),
                "reference/contact/s1002_uic60_B.csv": reference_text(0, 1)})
            for line in drawn["sweep_normal.png"].axes[0].lines[:2]:
                self.assertEqual(np.isnan(line.get_ydata()).sum(), holes)

    def test_no_ratios_beside_values(self):
        for figure in figures("sweep").values():
            self.assertEqual(len(figure.axes), 6)
            for axes in figure.axes:
                self.assertNotIn("ratio", axes.get_title(loc="left"))
                self.assertRegex(axes.get_ylabel(), r", (kN|N m|mm²?|MPa|%.*)$")

    def test_profiles_have_equal_scales(self):
        drawn = {"profiles": figures("profiles")["profiles_shift_0.png"].axes[:1],
                 "wear": figures("wear")["wear.png"].axes[:2],
                 "wheelset": figures("wheelset")["wheelset.png"].axes}
        for name, panels in drawn.items():
            for axes in panels:
                self.assertEqual(axes.get_aspect(), 1.0, name)

    def test_the_width_of_the_patch_is_marked(self):
        axes = figures("profiles", "--strips", "s.csv", files={
            "out/profiles_shift_0.csv": profiles_text(), "s.csv": strips_text(2)})[
                "profiles_shift_0.png"].axes[1]
        self.assertEqual([text.get_text() for text in axes.texts], ["5.0 mm", "5.0 mm"])
        widths = [np.ptp(axes.transData.inverted().transform(band.get_extents())[:, 0])
                  for band in axes.patches]
        np.testing.assert_allclose(widths, [5.0, 5.0])
        for view in figures("wheelset")["wheelset.png"].axes[1:]:
            self.assertRegex(view.texts[-1].get_text(), "on the rail:(.|\n)*patch .* mm wide")

    def test_forces_say_what_they_act_on(self):
        for axes in figures("sweep")["sweep_tangential.png"].axes:
            self.assertIn("on the rail", axes.get_title(loc="left"))
        self.assertIn("on the rail", figures("traction_curve")["traction_curve.png"].axes[0]
                      .get_ylabel())

    def test_unlike_models_are_named(self):
        falling = figures("traction_curve")["traction_curve.png"].axes[1].get_title(loc="left")
        self.assertRegex(falling, "(?s)CONTACT with a soft.*the others with one factor")

    def test_the_colour_blind_tell_lines_apart(self):
        for looks in (style.METHOD, style.NORMAL, load("forces").METHODS):
            for kind in BLIND:
                for one, other in itertools.combinations(looks.values(), 2):
                    apart = np.linalg.norm(seen(one.colour, kind) - seen(other.colour, kind))
                    self.assertTrue(apart > LEAST_APART or one.line != other.line,
                                    (kind, one.label, other.label))
                for one, other in itertools.pairwise(looks.values()):
                    apart = np.linalg.norm(seen(one.colour, kind) - seen(other.colour, kind))
                    self.assertGreater(apart, LEAST_APART, (kind, one.label, other.label))

    def test_numbers_of_an_axis_are_of_one_kind(self):
        axes = style.new_figure(4.0, 3.0).subplots()
        style.log_axes(axes)
        axes.set(xlim=(1e-6, 1e6), ylim=(1e-6, 1e6))
        form = axes.xaxis.get_major_formatter()
        self.assertEqual([form(x) for x in (1e-5, 0.02, 1.0, 1e5)], ["0.00001", "0.02", "1",
                                                                      "100000"])
