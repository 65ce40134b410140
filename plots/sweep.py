#!/usr/bin/env python3
"""Draw the sweep over lateral shifts: normal and tangential figures beside CONTACT's."""

import os
import sys

from faststrip_plots import command, panels, picture, references, style
from faststrip_plots.results import (
    NORMAL_QUANTITIES,
    TANGENTIAL_QUANTITIES,
    read_reference,
    read_sweep,
)


def main(arguments=None):
    options = command.options(
        __doc__, arguments, {**command.SWEEP, **references.SWEEP},
        folder=("out", "where sweep_normal.png and sweep_tangential.png go"),
        more={"no-reference": dict(action="store_true", help="draw the sweep alone, without ratios"
                                   " and differences"),
              **command.friction("coefficient of friction, for differences in percent of mu N")})
    sweep = read_sweep(options.sweep)
    reference = None if options.no_reference else read_reference(options.reference)
    command.report_failures(sweep)

    alone = reference is None
    for name, quantities, kinds in (
        ("sweep_normal.png", NORMAL_QUANTITIES, ("value", "ratio")),
        ("sweep_tangential.png", TANGENTIAL_QUANTITIES, ("value", "ratio", "difference")),
    ):
        draw(os.path.join(options.folder, name), sweep, reference, options.mu, quantities,
             kinds[:1] if alone else kinds)


def draw(path, sweep, reference, mu, quantities, kinds):
    """One row of panels per quantity, one column per kind."""
    figure = style.new_figure(4.6 * max(len(kinds), 1.6), 9.0)
    beyond = False
    grid = figure.subplots(len(quantities), len(kinds), squeeze=False, sharex=True)
    for row, name in zip(grid, quantities):
        for axes, kind in zip(row, kinds):
            if kind == "value":
                panels.draw_value(axes, sweep, reference, name)
            elif kind == "ratio":
                beyond |= panels.draw_ratio(axes, sweep, reference, name, mu)
            else:
                panels.draw_difference(axes, sweep, reference, name, mu)
    for axes in grid[-1]:
        axes.set_xlabel(panels.SHIFT_LABEL)
    figure.align_ylabels(grid)
    style.legend_above(figure, *grid.flat)
    notes = []
    if "difference" in kinds:
        least = f"{panels.NEAR_ZERO:.0%}"
        notes.append(f"ratios where CONTACT's value is at least {least} of $\\mu\\cdot N$ or"
                     " $\\mu\\cdot N c$")
    if beyond:
        notes.append("▲▼: beyond the axis")
    picture.save(figure, path, [sweep.stamp], "; ".join(notes))


if __name__ == "__main__":
    sys.exit(command.run(main))
