#!/usr/bin/env python3
"""Draw what `faststrip conicity` wrote: delta r and contact angles over the lateral shift,
equivalent conicity over the amplitude."""

import os
import sys

from faststrip_plots import command, style
from faststrip_plots.results import revision
from faststrip_plots.tables import read_table

EDITION = "EN 15302:2008+A1:2010"
FUNCTIONS = ("y_mm", "delta_r_mm", "gamma_right_rad", "gamma_left_rad", "roll_rad")
CONICITY = ("amplitude_mm", "tan_gamma_e", "regression", "method")
RIGHT, LEFT = style.NORMAL["strip"], style.NORMAL["hertz"]


def main(arguments=None):
    parser = command.parser(__doc__)
    parser.add_argument("--functions", default="out/functions.csv", metavar="CSV",
                        help="what `faststrip conicity --functions` wrote")
    parser.add_argument("--conicity", default="out/conicity.csv", metavar="CSV",
                        help="what `faststrip conicity -o` wrote")
    parser.add_argument("--folder", default="out", metavar="DIR", help="where conicity.png goes")
    options = parser.parse_args(arguments)
    functions = read_table(options.functions, FUNCTIONS)
    conicity = read_table(options.conicity, CONICITY)
    path = os.path.join(options.folder, "conicity.png")
    draw(path, functions, conicity)
    print(path)


def draw(path, functions, conicity):
    """Three panels, one above the other; without functions the last one alone."""
    if functions is None:
        figure = style.new_figure(6.4, 3.4)
        values = figure.subplots()
        legends = (values,)
    else:
        figure = style.new_figure(6.4, 9.0)
        radii, angles, values = figure.subplots(3, 1)
        draw_functions(radii, angles, functions)
        legends = (angles, values)
    amplitude = conicity.numbers("amplitude_mm")
    values.plot(amplitude, conicity.numbers("tan_gamma_e", missing=True), color=RIGHT.colour,
                linewidth=RIGHT.width, label=method_name(conicity.words("method")[:1]))
    if "regression" not in conicity.words("method")[:1]:
        values.plot(amplitude, conicity.numbers("regression", missing=True), color=LEFT.colour,
                    linestyle=LEFT.line, linewidth=LEFT.width, label="linear regression")
    values.set_xlabel("amplitude in mm")
    values.set_ylabel("$\\tan \\gamma_e$")
    values.set_ylim(bottom=0.0)
    style.title(values, f"equivalent conicity, {EDITION}")
    for axes in legends:
        axes.legend()
    style.save(figure, path, [functions and revision(functions), revision(conicity)])


def draw_functions(radii, angles, functions):
    """Rolling radius difference and contact angles over the shift."""
    shift = functions.numbers("y_mm")
    radii.plot(shift, functions.numbers("delta_r_mm"), color=RIGHT.colour, linewidth=RIGHT.width)
    radii.set_ylabel("$\\Delta r$ in mm")
    style.title(radii, "rolling radius difference, right less left")
    for side, look in (("right", RIGHT), ("left", LEFT)):
        angles.plot(shift, functions.numbers(f"gamma_{side}_rad"), color=look.colour,
                    linestyle=look.line, linewidth=look.width, label=f"{side} wheel")
    roll = functions.numbers("roll_rad")
    if any(roll):
        angles.plot(shift, roll, color=style.GREY, label="roll")
    angles.set_ylabel("angle in rad")
    style.title(angles, "contact angles, each in the frame of its side")
    for axes in (radii, angles):
        axes.set_xlabel("lateral shift $y$ in mm, to the right")


def method_name(first):
    """What the first row says, in words."""
    return {"klingel": "Klingel's equation", "regression": "linear regression"}.get(
        first[0] if len(first) else "", "conicity")


if __name__ == "__main__":
    sys.exit(command.run(main))
