#!/usr/bin/env python3
"""Draw traction curves: force over creepage by three methods beside CONTACT's, with constant
friction and with friction that falls with slip."""

import sys

import numpy as np

from faststrip_plots import command, style
from faststrip_plots.results import revision
from faststrip_plots.tables import InputError, read_table

RESULT = ("case", "series", "cksi", "N_N", "mu", "Fx_N")
REFERENCE = ("series", "cksi", "Fx_N")
PANELS = (("constant", "constant friction"), ("falling", "friction that falls with slip"))
# Name, and whose look it has.
METHODS = (("tang", "TANG", style.METHOD["norm", "tang"]),
           ("fastsim", "FASTSIM", style.METHOD["hertz", "fastsim"]),
           ("faststrip", "FASTSTRIP", style.METHOD["strip", "faststrip"]))
LEAST_CREEPAGE = 3e-4  # where the axis begins: it is logarithmic, and force as creepage there


def main(arguments=None):
    parser = command.parser(__doc__)
    for name, label, _ in METHODS:
        parser.add_argument(f"--{name}", default=f"out/traction_{name}.csv", metavar="CSV",
                            help=f"what `faststrip batch` wrote by {label}")
    parser.add_argument("--reference", default="reference/contact/traction_curve.csv",
                        metavar="CSV", help="the same curves by full CONTACT")
    parser.add_argument("-o", "--output", default="out/traction_curve.png", metavar="PNG",
                        help="picture to write")
    options = parser.parse_args(arguments)
    tables = [read_table(getattr(options, name), RESULT) for name, _, _ in METHODS]
    draw(options.output, tables, read_table(options.reference, REFERENCE))
    print(options.output)


def curve(table, series):
    """Creepages on the axis and sizes of the force of one series, in the order of creepage."""
    creepage, force = table.numbers("cksi"), table.numbers("Fx_N", missing=True)
    chosen = (np.array(table.words("series")) == series) & (creepage >= LEAST_CREEPAGE)
    creepage, force = creepage[chosen], force[chosen]
    if not np.any(np.isfinite(force)):
        raise InputError(f"no force of the series {series}: {table.path}")
    order = np.argsort(creepage)
    return creepage[order], np.abs(force[order])


def draw(path, tables, reference):
    """A panel a series, with one axis of the force."""
    figure = style.new_figure(9.2, 4.6)
    panels = figure.subplots(1, len(PANELS), sharey=True)
    for axes, (series, title) in zip(panels, PANELS):
        for table, (_, label, look) in zip(tables, METHODS):
            creepage, force = curve(table, series)
            axes.plot(100.0 * creepage, force / 1e3, color=look.colour, linestyle=look.line,
                      linewidth=look.width, label=label)
        creepage, force = curve(reference, series)
        axes.plot(100.0 * creepage, force / 1e3, **style.CONTACT)
        axes.set_xscale("log")
        axes.set_xlim(left=100.0 * LEAST_CREEPAGE)
        axes.xaxis.set_major_formatter("{x:g}")
        axes.set_xlabel("longitudinal creepage in %")
        axes.set_ylim(bottom=0.0)
        style.title(axes, title)
    panels[0].set_ylabel("$|F_x|$ in kN")
    style.legend_above(figure, *panels)
    style.save(figure, path, [revision(table) for table in tables],
               "where friction falls: CONTACT with a soft layer, the others with one factor")


if __name__ == "__main__":
    sys.exit(command.run(main))
