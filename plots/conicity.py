#!/usr/bin/env python3
"""Draw what `faststrip conicity` wrote: delta r and contact angles over the lateral shift,
equivalent conicity over the amplitude."""

import sys

import numpy as np

from faststrip_plots import command, picture, style

EDITION = "EN 15302:2008+A1:2010"
FUNCTIONS = ("y_mm", "delta_r_mm", "gamma_right_rad", "gamma_left_rad", "roll_rad",
             "y_wheel_right_mm", "y_wheel_left_mm")
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
    values.set(xlabel="amplitude, mm", ylabel="$\\tan \\gamma_e$", ylim=(0.0, None),
               title=f"Equivalent conicity, {EDITION}")
    for axes in legends:
        axes.legend()
    return figure, "" if functions is None else "lines end where a contact jumps"


def draw_functions(radii, angles, functions):
    """Rolling radius difference and contact angles over the shift, broken where a contact jumps."""
    shift = functions.numbers("y_mm")
    jumped = {side: style.jumps(shift, functions.numbers(f"y_wheel_{side}_mm"))
              for side in ("right", "left")}
    either = [any(both) for both in zip(*jumped.values())]
    radii.plot(*style.broken(either, shift, functions.numbers("delta_r_mm")), color=RIGHT.colour,
               linewidth=RIGHT.width)
    radii.set(ylabel="$\\Delta r$, mm", title="Rolling radius difference, right less left")
    for side, look in (("right", RIGHT), ("left", LEFT)):
        gamma = np.degrees(functions.numbers(f"gamma_{side}_rad"))
        angles.plot(*style.broken(jumped[side], shift, gamma),
                    **(look.line_style | {"label": f"{side} wheel"}))
    roll = np.degrees(functions.numbers("roll_rad"))
    if any(roll):
        angles.plot(*style.broken(either, shift, roll), color=style.GREY, label="roll")
    angles.set(ylabel="angle, degrees", title="Contact angles, each in the frame of its side")
    for axes in (radii, angles):
        axes.set_xlabel("lateral shift $y$ to the right, mm")


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
