#!/usr/bin/env python3
"""Draw contacts of a yawed wheelset on rollers and on rails: place along x, spin, forces."""

import sys

from faststrip_plots import command, picture, style
from faststrip_plots.tables import InputError

COLUMNS = ("case", "side", "contact", "x_track_mm", "cphi_rad_per_mm", "Fx_track_N",
           "Fy_track_N")
PANELS = (("x_track_mm", "contact ahead of the axle, mm", 1.0),
          ("cphi_rad_per_mm", "spin, 1/m", 1e3),
          ("Fx_track_N", "$F_x$ on the rail along the track, kN", 1e-3),
          ("Fy_track_N", "$F_y$ on the rail across the track, kN", 1e-3))
LOOKS = {"right": style.NORMAL["strip"], "left": style.NORMAL["hertz"]}
BODIES = (("rollers", "-"), ("rails", ":"))


def curve(table, yaws, side, column):
    """Yaws in mrad and a column of the first contact of one wheel."""
    sides, contacts, cases = (table.words(name) for name in ("side", "contact", "case"))
    rows = [k for k in range(len(cases)) if (sides[k], contacts[k]) == (side, "1")]
    if not rows:
        raise InputError(f"no contact of the {side} wheel: {table.path}")
    return [1e3 * yaws[cases[k]] for k in rows], table.numbers(column)[rows]


@picture.command(
    __doc__, "out/roller_rig.png",
    rollers=("out/roller_rig.csv", "what `faststrip wheelset` wrote on rollers", COLUMNS),
    rails=("out/roller_rig_rails.csv", "the same states on rails", COLUMNS),
    states=("example/roller_rig_states.csv", "the states", ("case", "yaw_rad")))
def main(rollers, rails, states):
    yaws = dict(zip(states.words("case"), states.numbers("yaw_rad")))
    figure = style.new_figure(9.2, 6.4)
    panels = figure.subplots(2, 2, sharex=True)
    for axes, (column, name, scale) in zip(panels.flat, PANELS):
        for table, (body, line) in zip((rollers, rails), BODIES):
            for side, look in LOOKS.items():
                yaw, values = curve(table, yaws, side, column)
                axes.plot(yaw, scale * values, **(look.line_style | {
                    "linestyle": line, "marker": "", "label": f"{side} wheel, {body}"}))
        axes.set_ylabel(name)
    for axes in panels[1]:
        axes.set_xlabel("yaw, mrad")
    style.legend_above(figure, *panels.flat)
    return figure, ""


if __name__ == "__main__":
    sys.exit(command.run(main))
