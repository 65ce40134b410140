#!/usr/bin/env python3
"""Draw the errors of the strip solver against the number of strips, beside second order."""

import sys

import numpy as np
from matplotlib.ticker import FixedLocator, NullLocator

from faststrip_plots import command, picture, scales, style
from faststrip_plots.results import RESULTS
from faststrip_plots.tables import InputError

QUANTITIES = {
    "penetration_err": "Approach",
    "pmax_err": "Maximum pressure",
    "area_err": "Contact area",
}
ORDER = -2.0
COLOUR = style.NORMAL["strip"].colour
ACCENT = style.NORMAL["hertz"].colour


@picture.command(__doc__, "out/convergence.png", convergence=(
    "out/convergence.csv", "columns case,strips,status,penetration_err,pmax_err,area_err",
    ("case", "strips", "status", *QUANTITIES)))
def main(table):
    strips = table.numbers("strips")
    for row in np.flatnonzero(strips < 1.0):
        raise InputError(
            f"strips must be at least 1, got {strips[row]:g} ({table.path}:{table.lines[row]})"
        )
    ok = np.array([status in RESULTS for status in table.words("status")])
    errors = {name: 100.0 * np.abs(table.numbers(name, missing=True)) for name in QUANTITIES}
    for name, values in errors.items():
        values[~ok] = np.nan
        if not (values > 0.0).any():
            raise InputError(f"{name} must have an error above zero, got none: {table.path}")
    failed = [status for status in table.words("status") if status not in RESULTS]
    if failed:
        why = ", ".join(f"{failed.count(status)} {status}" for status in dict.fromkeys(failed))
        print(f"{len(failed)} of {len(table)} rows without a result skipped ({why})")

    figure = style.new_figure(11.0, 4.6)
    panels = figure.subplots(1, len(QUANTITIES), sharex=True, sharey=True)
    for axes, (name, heading) in zip(panels, QUANTITIES.items()):
        draw(axes, strips, errors[name])
        axes.set(title=heading, xlabel="number of strips $N$")
    set_axes(panels[0], strips, np.concatenate(list(errors.values())))
    panels[0].set_ylabel("|relative error|, %")
    style.legend_above(figure, panels[0])
    cases = len(set(table.words("case")))
    return figure, f"{cases} case{'s' if cases > 1 else ''}; p: measured order of the median"


def draw(axes, strips, error):
    """Each case a dot, median and largest as lines, a triangle of second order."""
    axes.set(xscale="log", yscale="log")
    known = error > 0.0
    axes.plot(strips[known], error[known], linestyle="none", marker="o", markersize=3.0,
              color="#9db4d0", markeredgewidth=0.0, zorder=2, label="one case")
    number, median, most = summary(strips, error)
    axes.plot(number, scales.positive(most), color=ACCENT, linewidth=1.8, linestyle=(0, (5, 1.8)),
              marker="s", markersize=3.6, zorder=4, label="largest")
    axes.plot(number, scales.positive(median), color=COLOUR, linewidth=2.0, marker="o",
              markersize=4.2, zorder=4, label="median")
    order = -scales.power(number, median)
    if np.isfinite(order):
        axes.annotate(f"$p$ = {style.number(round(order, 2))}", (0.03, 0.04), color=COLOUR,
                      xycoords="axes fraction", fontweight="bold")
    if number.size > 1 and (most > 0.0).any():
        # above all errors, in the free upper right corner
        high = number[-1]
        low = max(number[0], np.sqrt(number[0] * high))
        beyond = (number >= low) & (most > 0.0)
        if beyond.any():
            top = 3.0 * (most[beyond] * (number[beyond] / high) ** -ORDER).max()
            scales.draw_order(axes, low, high, top, ORDER)


def summary(strips, error):
    """Numbers of strips ascending, median and largest error of the cases with a result."""
    number = np.unique(strips[~np.isnan(error)])
    of_each = [error[(strips == n) & ~np.isnan(error)] for n in number]
    return (number, np.array([np.median(values) for values in of_each]),
            np.array([values.max() for values in of_each]))


def set_axes(axes, strips, errors):
    """Ticks at numbers of strips that are there, as many as fit."""
    number = np.unique(strips)
    axes.set_xlim(number[0] / 1.2, number[-1] * 1.35)
    ticks = []
    for value in number:
        if not ticks or value / ticks[-1] >= (number[-1] / number[0]) ** 0.11:
            ticks.append(value)
    axes.xaxis.set_major_locator(FixedLocator(ticks))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter("{x:g}")
    style.plain_numbers(axes.yaxis)


if __name__ == "__main__":
    sys.exit(command.run(main))
