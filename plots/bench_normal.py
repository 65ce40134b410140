#!/usr/bin/env python3
"""Draw the time of the strip solver against the number of strips, cold and warm, with slopes.

Warm is from the previous step: with the load changed by 5 %, or the wheelset moved by 0.05 mm.
"""

import sys

import numpy as np

from faststrip_plots import bench, command, scales, style

STARTS = {
    "cold": style.Look("cold start", "#0b3c78", "-", 2.0),
    "warm_load": style.Look("warm start, load ±5 %", "#f08519", (0, (5, 1.8)), 1.8),
    "warm_shift": style.Look("warm start, shift 0.05 mm", "#b03a2e", (0, (1.5, 1.5)), 1.8),
}
GOALS = {"cold": (15, 500.0), "warm_load": (15, 100.0)}  # strips and microseconds
MAYBE = ("iterations", "ns_per_entry", "fastsim_us")
SLOPE_PART = 4.0  # slopes are measured over this factor in strips, at both ends


@bench.command(__doc__, "normal", ("start", "strips", "us", *MAYBE))
def main(table):
    values = {name: table.positive(name) for name in ("strips", "us")}
    values |= {name: table.numbers(name, missing=True) for name in MAYBE}
    runs = [(start, medians(rows, values))
            for start, rows in scales.groups(table.one_of("start", STARTS))]

    figure = style.new_figure(10.4, 5.8)
    grid = figure.add_gridspec(2, 2, width_ratios=[1.75, 1.0])
    time = figure.add_subplot(grid[:, 0])
    small = [figure.add_subplot(grid[row, 1], sharex=time) for row in (0, 1)]
    draw_times(time, runs, values["fastsim_us"])
    for axes, name, heading in zip(small, ("iterations", "ns_per_entry"),
                                   ("Iterations", "Time of one influence entry, ns")):
        for start, run in runs:
            bench.draw_line(axes, run["strips"], run[name], STARTS[start])
        axes.set(ylim=(0.0, None), title=heading)
    strips = np.unique(values["strips"])
    time.set_xlim(strips[0] / 1.25, strips[-1] * 1.25)
    time.xaxis.set_major_formatter("{x:g}")
    for axes in (time, small[1]):
        axes.set_xlabel("number of strips $N$")
    small[0].tick_params(labelbottom=False)
    style.legend_above(figure, time)
    return figure, "medians; rings: goals at 15 strips"


def draw_times(axes, runs, fastsim):
    """Time against strips on logarithmic axes, with slopes at both ends and goals."""
    axes.set(xscale="log", yscale="log")
    for start, run in runs:
        look = STARTS[start]
        bench.draw_line(axes, run["strips"], run["us"], look)
        if start not in GOALS:
            continue  # the two warm lines lie close together: one tells the slopes
        bench.draw_goal(axes, *GOALS[start], look)
        bench.draw_slopes(axes, run["strips"], run["us"], look, SLOPE_PART,
                          (-8.0, 8.0) if start == "cold" else (8.0, -8.0))
    known = fastsim[fastsim > 0.0]
    if known.size:
        axes.axhline(np.median(known), color=style.GREY, linewidth=1.4, linestyle=(0, (1.2, 1.2)),
                     zorder=2)
        axes.annotate(f"FASTSIM, 50 × 50: {np.median(known):.3g} µs", (0.99, np.median(known)),
                      (0.0, -3.0), xycoords=("axes fraction", "data"), va="top", ha="right",
                      textcoords="offset points", color=style.GREY, fontsize=style.SMALL)
    axes.set_ylabel("time of one contact, µs")
    axes.yaxis.set_major_formatter("{x:.12g}")
    axes.set_title("Normal contact: time against strips")


def medians(rows, values):
    """Each column's median per number of strips, ascending."""
    strips = np.unique(values["strips"][rows])
    run = {"strips": strips}
    for name in ("us", "iterations", "ns_per_entry"):
        column = []
        for number in strips:
            own = values[name][rows[values["strips"][rows] == number]]
            own = own[~np.isnan(own)]
            column.append(np.median(own) if own.size else np.nan)
        run[name] = np.array(column)
    return run


if __name__ == "__main__":
    sys.exit(command.run(main))
