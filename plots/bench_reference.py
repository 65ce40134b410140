#!/usr/bin/env python3
"""Draw the time of Kalker's variational method against the number of elements, with slopes.

One panel for NORM and one for TANG. Lines are cold starts, from a coarser grid, from strips and
from the previous step; iterations are those of all grids, of NORM to 1e-9 (filled dots) and to 1e-4
of the approach (rings), of TANG (squares) those inside Newton's steps.
"""

import math
import sys

import numpy as np

from faststrip_plots import bench, command, scales, style
from faststrip_plots.tables import read_table

STARTS = {
    "cold": style.Look("cold", "#0b3c78", "-", 2.0),
    "coarse": style.Look("coarser grid", "#2e7d32", "-", 1.8),
    "strips": style.Look("15 strips", "#b03a2e", (0, (5, 1.8)), 1.8),
    "warm_load": style.Look("previous step, load ±5 %", "#f08519", (0, (1.5, 1.5)), 1.8),
    "warm_creepage": style.Look("previous step, creepage ±5 %", "#a8326e", (0, (3, 1, 1, 1)), 1.8),
    "new_plans": style.Look("cold, new plans", "#8a8a8a", (0, (1.2, 1.2)), 1.6),
}
METHODS = {"norm": "NORM: pressures", "tang": "TANG: tractions in rolling"}
MARKERS = {"norm": "o", "tang": "s"}
GOALS = {"norm": (3700, 5.0), "tang": (3700, 100.0)}  # elements and milliseconds
CONTACT = {"norm": "cpu_norm_s", "tang": "cpu_tang_s"}  # its times, grid of 0.1 mm
SLOPE_PART = 8.0  # slopes are measured over this factor in elements, at both ends
CLASS = 2.0 ** 0.5  # elements within this factor belong together


@bench.command(
    __doc__, "reference", ("method", "start", "tolerance", "elements", "us", "iterations"),
    more={"contact": dict(
        metavar="CSV", help="what CONTACT took, as reference/contact/s1002_uic60_B.csv")})
def main(table, contact):
    values = {name: table.positive(name) for name in ("tolerance", "elements", "us")}
    values["iterations"] = table.numbers("iterations")
    runs = [(*key, medians(rows, values)) for key, rows in
            scales.groups(table.one_of("method", METHODS), table.one_of("start", STARTS),
                          values["tolerance"])]

    contact = read_table(contact, ("n_contact", *CONTACT.values())) if contact else None
    methods = [method for method in METHODS if any(run[0] == method for run in runs)]
    figure = style.new_figure(4.2 * len(methods) + 4.4, 5.2)
    *times, iterations = figure.subplots(1, len(methods) + 1, sharex=True)
    for axes, method in zip(times, methods):
        draw_times(axes, [run for run in runs if run[0] == method])
        if contact is not None:
            axes.plot(contact.numbers("n_contact"), 1e3 * contact.numbers(CONTACT[method]),
                      zorder=4, **style.CONTACT)
        axes.set_title(METHODS[method])
    times[0].set_ylabel("time of one contact, ms")
    draw_iterations(iterations, runs)
    for axes in (*times, iterations):
        axes.set(xscale="log", xlabel="elements in contact")
        axes.xaxis.set_major_formatter("{x:,.0f}")
    style.legend_above(figure, *times, columns=lambda names: math.ceil(names / 2))
    return figure, "medians, one core; large ring: goal at 3700 elements"


def finest(runs):
    """The smallest tolerance of the runs."""
    return min(tolerance for _, _, tolerance, _ in runs)


def draw_times(axes, runs):
    """Time of one method against elements to the smallest tolerance, with slopes and the goal."""
    axes.set_yscale("log")
    for method, start, tolerance, run in runs:
        if tolerance != finest(runs):
            continue
        look = STARTS[start]
        bench.draw_line(axes, run["elements"], 1e-3 * run["us"], look, marker=MARKERS[method])
        if start == "cold":
            bench.draw_slopes(axes, run["elements"], 1e-3 * run["us"], look, SLOPE_PART,
                              (-12.0, 12.0), digits=2)
            bench.draw_goal(axes, *GOALS[method], look)
    axes.yaxis.set_major_formatter("{x:.12g}")


def draw_iterations(axes, runs):
    """Iterations against elements, filled for the smallest tolerance of a method."""
    for method, start, tolerance, run in runs:
        if start == "new_plans":
            continue
        look = STARTS[start]
        filled = tolerance == finest([other for other in runs if other[0] == method])
        bench.draw_line(axes, run["elements"], run["iterations"], look, label=None,
                        marker=MARKERS[method], markersize=4.0,
                        markerfacecolor=look.colour if filled else "white")
    # iterations of TANG are many times those of NORM
    axes.set_yscale("log")
    axes.yaxis.set_major_formatter("{x:,.0f}")
    axes.set_title("Iterations: ● NORM, all grids; ■ TANG")


def medians(rows, values):
    """Each column's median over rows with nearly as many elements, ascending."""
    order = rows[np.argsort(values["elements"][rows], kind="stable")]
    classes = []
    for row in order:
        if classes and values["elements"][row] <= CLASS * values["elements"][classes[-1][0]]:
            classes[-1].append(row)
        else:
            classes.append([row])
    return {name: np.array([np.median(values[name][own]) for own in classes])
            for name in ("elements", "us", "iterations")}


if __name__ == "__main__":
    sys.exit(command.run(main))
