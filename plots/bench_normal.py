#!/usr/bin/env python3
"""Draw the time of the strip solver against the number of strips, cold and warm, with slopes.

Warm is from the previous step: with the load changed by 5 %, or the wheelset moved by 0.05 mm.
"""

import sys

import numpy as np
from matplotlib.ticker import FuncFormatter

from faststrip_plots import command, scales, style
from faststrip_plots.results import revision
from faststrip_plots.tables import InputError, read_table

BENCH = "out/bench_normal.csv"
STARTS = {
    "cold": style.Look("cold start", "#0b3c78", "-", 2.0),
    "warm_load": style.Look("warm start, load ±5 %", "#f08519", (0, (5, 1.8)), 1.8),
    "warm_shift": style.Look("warm start, shift 0.05 mm", "#b03a2e", (0, (1.5, 1.5)), 1.8),
}
GOALS = {"cold": (15, 500.0), "warm_load": (15, 100.0)}  # strips and microseconds
SLOPE_PART = 4.0  # slopes are measured over this factor in strips, at both ends


def main(arguments=None):
    parser = command.parser(__doc__)
    parser.add_argument("--bench", default=BENCH, metavar="CSV",
                        help="what `faststrip-lab bench normal` wrote")
    parser.add_argument("-o", "--output", default="out/bench_normal.png", metavar="PNG",
                        help="picture to write")
    options = parser.parse_args(arguments)
    table = read_table(options.bench, ("start", "strips", "us", "iterations", "ns_per_entry",
                                       "fastsim_us"))
    values = {name: table.numbers(name) for name in ("strips", "us")}
    values.update({name: table.numbers(name, missing=True)
                   for name in ("iterations", "ns_per_entry", "fastsim_us")})
    for name in ("strips", "us"):
        for row in np.flatnonzero(values[name] <= 0.0):
            raise InputError(
                f"{name} must be above zero, got {values[name][row]:g}"
                f" ({options.bench}:{table.lines[row]})"
            )
    for start, line in zip(table.words("start"), table.lines):
        if start not in STARTS:
            raise InputError(
                f"start must be one of {', '.join(STARTS)}, got {start} ({options.bench}:{line})"
            )
    runs = [(start, medians(rows, values)) for start, rows in scales.groups(table.words("start"))]

    figure = style.new_figure(10.4, 5.8)
    grid = figure.add_gridspec(2, 2, width_ratios=[1.75, 1.0])
    time = figure.add_subplot(grid[:, 0])
    small = [figure.add_subplot(grid[row, 1], sharex=time) for row in (0, 1)]
    draw_times(time, runs, values["fastsim_us"])
    for axes, name, heading in zip(small, ("iterations", "ns_per_entry"),
                                   ("Iterations", "Time of one influence entry, ns")):
        for start, run in runs:
            draw_line(axes, run["strips"], run[name], STARTS[start])
        axes.set_ylim(bottom=0.0)
        style.title(axes, heading)
    strips = np.unique(values["strips"])
    time.set_xlim(strips[0] / 1.25, strips[-1] * 1.25)
    time.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    for axes in (time, small[1]):
        axes.set_xlabel("number of strips $N$")
    small[0].tick_params(labelbottom=False)
    style.legend_above(figure, time)
    style.save(figure, options.output, [revision(table)],
               "medians; rings: goals at 15 strips")
    print(options.output)


def draw_times(axes, runs, fastsim):
    """Time against strips on logarithmic axes, with slopes at both ends and goals."""
    axes.set_xscale("log")
    axes.set_yscale("log")
    for start, run in runs:
        look = STARTS[start]
        draw_line(axes, run["strips"], run["us"], look)
        if start in GOALS:
            strips, goal = GOALS[start]
            axes.plot(strips, goal, linestyle="none", marker="o", markersize=10, zorder=5,
                      markerfacecolor="none", markeredgecolor=look.colour, markeredgewidth=1.6)
        else:
            continue  # the two warm lines lie close together: one tells the slopes
        for part in scales.ends(run["strips"], SLOPE_PART):
            slope = scales.power(run["strips"][part], run["us"][part])
            if np.isfinite(slope):
                middle = part[len(part) // 2]
                up = start == "cold"
                axes.annotate(f"∝ $N^{{{slope:.1f}}}$",
                              (run["strips"][middle], run["us"][middle]),
                              (-8.0, 8.0) if up else (8.0, -8.0), textcoords="offset points",
                              ha="right" if up else "left", va="bottom" if up else "top",
                              color=look.colour)
    known = fastsim[fastsim > 0.0]
    if known.size:
        axes.axhline(np.median(known), color=style.GREY, linewidth=1.4, linestyle=(0, (1.2, 1.2)),
                     zorder=2)
        axes.annotate(f"FASTSIM, 50 × 50: {np.median(known):.3g} µs", (0.99, np.median(known)),
                      (0.0, -3.0), xycoords=("axes fraction", "data"), va="top", ha="right",
                      textcoords="offset points", color=style.GREY, fontsize=style.SMALL)
    axes.set_ylabel("time of one contact, µs")
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.12g}"))
    style.title(axes, "Normal contact: time against strips")


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


def draw_line(axes, x, y, look):
    axes.plot(x, y, color=look.colour, linestyle=look.line, linewidth=look.width, marker="o",
              markersize=3.6, label=look.label, zorder=3)


if __name__ == "__main__":
    sys.exit(command.run(main))
