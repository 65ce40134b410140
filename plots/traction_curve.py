#!/usr/bin/env python3
"""Draw traction curves: force over creepage by three methods beside CONTACT's, with constant
friction and with friction that falls with slip."""

import sys

import numpy as np

from faststrip_plots import command, picture, style
from faststrip_plots.tables import InputError

RESULT = ("case", "series", "cksi", "N_N", "mu", "Fx_N")
REFERENCE = ("series", "cksi", "Fx_N")
PANELS = (("constant", "Constant friction"),
          ("falling", "Friction that falls with slip: CONTACT with a soft\nlayer between"
           " the bodies, the others with one factor"))
# Name, and whose look it has.
METHODS = (("tang", "TANG", style.METHOD["norm", "tang"]),
           ("fastsim", "FASTSIM", style.METHOD["hertz", "fastsim"]),
           ("faststrip", "FASTSTRIP", style.METHOD["strip", "faststrip"]))
LEAST_CREEPAGE = 3e-4  # where the axis begins: it is logarithmic, and force as creepage there


def curve(table, series):
    """Creepages on the axis and sizes of the force of one series, in the order of creepage."""
    creepage, force = table.numbers("cksi"), table.numbers("Fx_N", missing=True)
    chosen = (np.array(table.words("series")) == series) & (creepage >= LEAST_CREEPAGE)
    creepage, force = creepage[chosen], force[chosen]
    if not np.any(np.isfinite(force)):
        raise InputError(f"no force of the series {series}: {table.path}")
    order = np.argsort(creepage)
    return creepage[order], np.abs(force[order])


@picture.command(
    __doc__, "out/traction_curve.png",
    **{name: (f"out/traction_{name}.csv", f"what `faststrip batch` wrote by {label}", RESULT)
       for name, label, _ in METHODS},
    reference=("reference/contact/traction_curve.csv", "the same curves by full CONTACT",
               REFERENCE))
def main(*tables):
    """A panel a series, with one axis of the force."""
    figure = style.new_figure(9.2, 4.6)
    panels = figure.subplots(1, len(PANELS), sharey=True)
    for axes, (series, title) in zip(panels, PANELS):
        looks = [look.line_style | {"label": label} for _, label, look in METHODS]
        for table, look in zip(tables, [*looks, style.CONTACT]):
            creepage, force = curve(table, series)
            axes.plot(100.0 * creepage, force / 1e3, **look)
        axes.set(xscale="log", xlim=(100.0 * LEAST_CREEPAGE, None))
        style.plain_numbers(axes.xaxis)
        axes.set(xlabel="longitudinal creepage, %", ylim=(0.0, None), title=title)
    panels[0].set_ylabel("$|F_x|$ on the rail, kN")
    style.legend_above(figure, *panels)
    return figure, ""


if __name__ == "__main__":
    sys.exit(command.run(main))
