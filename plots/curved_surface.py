#!/usr/bin/env python3
"""Draw a contact on its curved surface: a section through wheel and rail with the force of each
strip, and what pressures and tractions give across."""

import sys

import numpy as np

from faststrip_plots import command, picture, style
from faststrip_plots.tables import InputError

GAP = ("y_mm", "h_mm", "inclination_rad")
STRIPS = ("y_left_mm", "y_right_mm", "load_N", "Fy_N")
PARTS = {"pressures": style.NORMAL["strip"], "tractions": style.NORMAL["hertz"],
         "together": style.NORMAL["norm"]}
MARGIN = 0.35  # of the contact's width, drawn beside it
LONGEST = 0.3  # arrow, over the contact's width


def surface(table):
    """Places of the middle surface, gap and inclination, in the frame of the contact."""
    y, gap, turn = (table.numbers(name) for name in GAP)
    if not np.all(np.isfinite(turn)):
        raise InputError(f"no inclination of the surfaces in {table.path}")
    slope = np.tan(turn)
    z = np.concatenate(([0.0], np.cumsum(0.5 * (slope[1:] + slope[:-1]) * np.diff(y))))
    return y, z - np.interp(0.0, y, z), gap, turn


def draw_section(axes, around, places, normal, force):
    """Both surfaces, and the strips' forces on the rail, z down."""
    y, z, height, turn = around
    for half, body, line in ((0.5, "rail", "-"), (-0.5, "wheel", "--")):
        axes.plot(y - half * height * np.sin(turn), z + half * height * np.cos(turn),
                  color="black", linestyle=line, label=body)
    axes.plot(*(np.stack([place, place + part]) for place, part in zip(places, normal)),
              color=PARTS["pressures"].colour, linewidth=0.8)
    axes.quiver(*places, *force, angles="xy", scale_units="xy", scale=1.0, width=2.5e-3,
                color=PARTS["together"].colour)
    axes.set(ylabel="$z$ into the rail, mm", aspect="equal")
    axes.invert_yaxis()


@picture.command(
    __doc__, "out/curved_surface.png",
    strips=("out/strips.csv", "what `faststrip contact --curved --strips` wrote", STRIPS),
    gap=("out/gap.csv", "what it wrote with --gap", GAP))
def main(strips, gap):
    y, z, height, turn = surface(gap)
    left, right, load, pull = (strips.numbers(name) for name in STRIPS)
    if not len(left) or not np.all(np.isfinite(pull)):
        raise InputError(f"no strips with forces of their own in {strips.path}")
    width = right.max() - left.min()
    middle = 0.5 * (left + right)
    places = middle, np.interp(middle, y, z)
    angle = np.interp(middle, y, turn)
    near = (y > left.min() - MARGIN * width) & (y < right.max() + MARGIN * width)
    around = y[near], z[near], height[near], turn[near]
    pressures = -np.sin(angle) * load, np.cos(angle) * load
    tractions = np.cos(angle) * pull, np.sin(angle) * pull
    together = [one + other for one, other in zip(pressures, tractions)]
    strip_width = right - left
    scale = LONGEST * width / np.max(np.hypot(*together) / strip_width)
    figure = style.new_figure(9.2, 6.4)
    section, across = figure.subplots(2, 1, sharex=True)
    draw_section(section, around, places, [scale * one / strip_width for one in pressures],
                 [scale * one / strip_width for one in together])
    section.set_title("Force of each strip on the rail; thin: of its pressures")
    for values, (name, look) in zip((pressures, tractions, together), PARTS.items()):
        across.plot(middle, 1e-3 * values[0] / strip_width,
                    **(look.line_style | {"marker": ".", "label": name}))
    across.set(xlabel="$y$ across, mm", ylabel="lateral force, kN per mm")
    style.legend_above(figure, section, across)
    return figure, ""


if __name__ == "__main__":
    sys.exit(command.run(main))
