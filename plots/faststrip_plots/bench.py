"""Pictures of benches: their options, lines with their slopes, goals as rings."""

from __future__ import annotations

import math

from . import picture, scales

# Goals are rings around the point, in the colour of the line they belong to.
RING = dict(linestyle="none", marker="o", markersize=10, zorder=5, markerfacecolor="none",
            markeredgewidth=1.6)


def command(description, name, columns, more=None):
    """Makes a command of a function that draws what `faststrip-lab bench NAME` wrote."""
    return picture.command(description, f"out/bench_{name}.png", more=more, bench=(
        f"out/bench_{name}.csv", f"what `faststrip-lab bench {name}` wrote", columns))


def draw_line(axes, x, y, look, **more):
    """A line of a look with its points."""
    axes.plot(x, y, **(look.line_style | dict(marker="o", markersize=3.6, zorder=3) | more))


def draw_goal(axes, x, y, look):
    """A ring."""
    axes.plot(x, y, markeredgecolor=look.colour, **RING)


def draw_slopes(axes, x, y, look, factor, offset, digits=1):
    """The exponents of N at both ends of a line, each measured over a factor in x, beside it by
    an offset in points."""
    for part in scales.ends(x, factor):
        slope = scales.power(x[part], y[part])
        if math.isfinite(slope):
            middle = part[len(part) // 2]
            axes.annotate(f"∝ $N^{{{slope:.{digits}f}}}$", (x[middle], y[middle]), offset,
                          textcoords="offset points", color=look.colour,
                          ha="right" if offset[0] < 0.0 else "left",
                          va="bottom" if offset[1] > 0.0 else "top")
