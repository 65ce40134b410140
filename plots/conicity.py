#!/usr/bin/env python3
"""Draw what `faststrip conicity` wrote: delta r and contact angles over the lateral shift,
equivalent conicity over the amplitude."""

import sys

from faststrip_plots import command, picture, style

EDITION = "EN 15302:2008+A1:2010"
FUNCTIONS = ("y_mm", "delta_r_mm", "gamma_right_rad", "gamma_left_rad", "roll_rad")
CONICITY = ("amplitude_mm", "tan_gamma_e", "regression", "method")
RIGHT, LEFT = style.NORMAL["strip"], style.NORMAL["hertz"]


def draw(functions, conicity):
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
    values.plot(amplitude, conicity.numbers("tan_gamma_e", missing=True),
                **(RIGHT.line_style | {"label": method_name(conicity.words("method")[:1])}))
    if "regression" not in conicity.words("method")[:1]:
        values.plot(amplitude, conicity.numbers("regression", missing=True),
                    **(LEFT.line_style | {"label": "linear regression"}))
    values.set(xlabel="amplitude in mm", ylabel="$\\tan \\gamma_e$", ylim=(0.0, None),
               title=f"equivalent conicity, {EDITION}")
    for axes in legends:
        axes.legend()
    return figure, ""


def draw_functions(radii, angles, functions):
    """Rolling radius difference and contact angles over the shift."""
    shift = functions.numbers("y_mm")
    radii.plot(shift, functions.numbers("delta_r_mm"), color=RIGHT.colour, linewidth=RIGHT.width)
    radii.set(ylabel="$\\Delta r$ in mm", title="rolling radius difference, right less left")
    for side, look in (("right", RIGHT), ("left", LEFT)):
        angles.plot(shift, functions.numbers(f"gamma_{side}_rad"),
                    **(look.line_style | {"label": f"{side} wheel"}))
    roll = functions.numbers("roll_rad")
    if any(roll):
        angles.plot(shift, roll, color=style.GREY, label="roll")
    angles.set(ylabel="angle in rad", title="contact angles, each in the frame of its side")
    for axes in (radii, angles):
        axes.set_xlabel("lateral shift $y$ in mm, to the right")


def method_name(first):
    """What the first row says, in words."""
    return {"klingel": "Klingel's equation", "regression": "linear regression"}.get(
        first[0] if len(first) else "", "conicity")


main = picture.command(
    __doc__, "conicity.png", folder="out",
    functions=("out/functions.csv", "what `faststrip conicity --functions` wrote", FUNCTIONS),
    conicity=("out/conicity.csv", "what `faststrip conicity -o` wrote", CONICITY))(draw)


if __name__ == "__main__":
    sys.exit(command.run(main))
