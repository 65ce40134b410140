#!/usr/bin/env python3
"""Draw the influence integrals and the published polynomials: Figs 5 to 10 redone, and errors."""

import os
import sys

import matplotlib
import numpy as np

from faststrip_plots import command, picture, scales, style
from faststrip_plots.curves import ABSCISSA, GROUPS, RANGE, colour_of, read_curves

ERROR_AXIS = (1e-5, 1e3)  # relative errors shown outside the range
SHADE = "#e8eef6"
PUBLISHED = dict(color="black", linewidth=1.0, linestyle=(0, (4, 2.4)), zorder=4)


def main(arguments=None):
    options = command.options(
        __doc__, arguments, {"curves": ("out/curves.csv", "what `faststrip table --curves` wrote")},
        folder=("out", "where integrals.png and integral_errors.png go"))
    curves, stamp = read_curves(options.curves)
    parts = [
        (first, last, [curve for curve in curves if first <= curve.n <= last])
        for first, last in GROUPS
    ]
    parts = [part for part in parts if part[2]]
    # both are drawn before either is written: bad input leaves no picture behind
    pictures = {"integrals.png": value_figure(parts), "integral_errors.png": error_figure(parts)}
    for name, (figure, note) in pictures.items():
        picture.save(figure, os.path.join(options.folder, name), [stamp], note)


def value_figure(parts):
    """Integrals above, their logarithms below."""
    figure = style.new_figure(4.3 * max(len(parts), 2), 8.2)
    grid = figure.subplots(2, len(parts), squeeze=False, sharex=True)
    for (first, last, curves), (upper, lower) in zip(parts, grid.T):
        for curve in curves:
            colour = colour_of(curve.n)
            for axes, change in ((upper, np.array), (lower, np.log10)):
                axes.plot(curve.L, change(curve.exact), color=colour, linewidth=2.0, zorder=3,
                          label="exact")
                known = curve.inside & (curve.published > 0.0)
                axes.plot(curve.L[known], change(curve.published[known]), **PUBLISHED,
                          label=r"published polynomial, $-2 \leq L \leq 1$")
        upper.set(title=group_title(first, last), ylim=(0.0, None))
        for axes in (upper, lower):
            axes.set_xlim(*abscissae(curves))
        lower.set_xlabel(ABSCISSA)
    grid[0, 0].set_ylabel("$i_n(b)$")
    grid[1, 0].set_ylabel(r"$E = \log_{10}\, i_n(b)$")
    figure.align_ylabels(grid)
    style.legend_above(figure, grid[0, 0])
    matplotlib.artist.setp(figure.legends[0].legend_handles[0], color="#444444")
    figure.draw_without_rendering()
    for (_, _, curves), column in zip(parts, grid.T):
        if len(curves) > 1:
            named = [curves[0], curves[-1], *curves[1:-1]]
            for axes, change in zip(column, (np.array, np.log10)):
                scales.label_ends(axes, axes.get_xlim()[1], [
                    (change(c.exact[-1]), f"$n$ = {c.n}", colour_of(c.n)) for c in named
                ])
    return figure, "full integrals; the table's 10^E is half of them, its |s−k| is 2n"


def error_figure(parts):
    """Relative error inside the range above, its size far outside below."""
    figure = style.new_figure(4.3 * max(len(parts), 2), 7.4)
    grid = figure.subplots(2, len(parts), squeeze=False)
    worst = max((curve for _, _, curves in parts for curve in curves), key=largest_inside)
    beyond = False
    for (first, last, curves), (upper, lower) in zip(parts, grid.T):
        upper.axhline(0.0, color="#444444", linewidth=0.8, zorder=1)
        lower.axvspan(*RANGE, color=SHADE, zorder=0)
        for curve in curves:
            look = dict(color=colour_of(curve.n), linewidth=1.8 if last <= 4 else 1.3, zorder=3,
                        label=f"$n$ = {curve.n}, $|s-k|$ = {2 * curve.n}")
            upper.plot(curve.L[curve.inside], 100.0 * curve.rel_err[curve.inside], **look)
            size = np.abs(curve.rel_err)
            lower.plot(curve.L, np.where(size > 0.0, size, np.nan), **look)
            beyond |= bool((size > ERROR_AXIS[1]).any())
        upper.set(title=group_title(first, last), xlim=RANGE)
        lower.set(xlim=abscissae(curves), yscale="log", ylim=ERROR_AXIS)
        lower.axhline(1.0, color="#444444", linewidth=0.8, zorder=1)
        lower.annotate("range of the table", (0.5 * sum(RANGE), ERROR_AXIS[1]), (0.0, -4.0),
                       textcoords="offset points", ha="center", va="top", fontsize=style.SMALL,
                       color=style.GREY)
        lower.set_xlabel(ABSCISSA)
        if first <= worst.n <= last and largest_inside(worst) > 0.0:
            mark_worst(upper, worst)
    span = 1.3 * 100.0 * largest_inside(worst) or 1.0
    for axes in grid[0]:
        axes.set_ylim(-span, span)
    for (_, last, curves), column in zip(parts, grid.T):
        if last > 4:
            colours = matplotlib.colors.ListedColormap([colour_of(n) for n in range(5, last + 1)])
            norm = matplotlib.colors.BoundaryNorm(np.arange(4.5, last + 1.0), colours.N)
            bar = figure.colorbar(matplotlib.cm.ScalarMappable(norm, colours), ax=list(column),
                                  ticks=[5, 8, 11, 14, 17, 20], aspect=40, pad=0.02)
            bar.ax.set_title("$n$", fontsize=style.SMALL, fontweight="normal", loc="center")
            bar.ax.minorticks_off()
        elif len(curves) > 1:
            column[0].legend(loc="upper right", fontsize=style.SMALL, handlelength=1.8,
                             borderaxespad=0.3, labelspacing=0.3)
    grid[0, 0].set_ylabel("published / exact − 1, %")
    grid[1, 0].set_ylabel("|published / exact − 1|")
    figure.align_ylabels(grid[:, 0])
    notes = ["above: inside the range of the table; below: far outside"]
    if beyond:
        notes.append(f"errors above {ERROR_AXIS[1]:g} not shown")
    return figure, "; ".join(notes)


def mark_worst(axes, curve):
    """Ring and figure at the largest error inside the range."""
    where = np.flatnonzero(curve.inside)
    at = where[np.nanargmax(np.abs(curve.rel_err[where]))]
    x, y = curve.L[at], 100.0 * curve.rel_err[at]
    axes.plot(x, y, marker="o", markersize=8, markerfacecolor="none", clip_on=False,
              markeredgecolor=colour_of(curve.n), markeredgewidth=1.5, linestyle="none", zorder=5)
    left = x > 0.5 * sum(RANGE)
    axes.annotate(f"worst, $n$ = {curve.n}: {style.number(round(y, 2))} %"
                  f" at $L$ = {style.number(round(x, 2))}",
                  (x, y), (-9.0 if left else 9.0, 0.0), textcoords="offset points",
                  ha="right" if left else "left", va="center", fontsize=style.SMALL,
                  color=colour_of(curve.n))


def largest_inside(curve):
    """Largest relative error inside the range, zero where none is known."""
    return float(np.max(np.nan_to_num(np.abs(curve.rel_err[curve.inside]))))


def abscissae(curves):
    """From the least to the largest L of some curves, the range of the table at least."""
    return (min(RANGE[0], *(curve.L[0] for curve in curves)),
            max(RANGE[1], *(curve.L[-1] for curve in curves)))


def group_title(first, last):
    if first == last:
        return f"$n$ = {first} ($|s-k|$ = {2 * first} in the table)"
    return f"$n$ = {first} to {last} ($|s-k|$ = {2 * first} to {2 * last})"


if __name__ == "__main__":
    sys.exit(command.run(main))
