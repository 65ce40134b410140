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
        more={"no-reference": dict(action="store_true", help="draw the sweep alone, without"
                                   " differences"),
              **command.friction("coefficient of friction, for differences in percent of mu N")})
    sweep = read_sweep(options.sweep)
    reference = None if options.no_reference else read_reference(options.reference)
    command.report_failures(sweep)

    for name, quantities in (
        ("sweep_normal.png", NORMAL_QUANTITIES), ("sweep_tangential.png", TANGENTIAL_QUANTITIES),
    ):
        draw(os.path.join(options.folder, name), sweep, reference, options.mu, quantities)


def draw(path, sweep, reference, mu, quantities):
    """One row of panels per quantity: values, and differences from a reference if there is one."""
    columns = 1 if reference is None else 2
    figure = style.new_figure(5.4 * max(columns, 1.4), 9.0)
    grid = figure.subplots(len(quantities), columns, squeeze=False, sharex=True)
    for row, name in zip(grid, quantities):
        panels.draw_value(row[0], sweep, reference, name)
        if reference is not None:
            panels.draw_difference(row[1], sweep, reference, name, mu)
    for axes in grid[-1]:
        axes.set_xlabel(panels.SHIFT_LABEL)
    figure.align_ylabels(grid)
    style.legend_above(figure, *grid.flat)
    picture.save(figure, path, [sweep.stamp], panels.jump_note(sweep))


if __name__ == "__main__":
    sys.exit(command.run(main))
