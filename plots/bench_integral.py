#!/usr/bin/env python3
"""Draw error against time of the ways to evaluate an influence integral, one dot per method."""

import sys

import numpy as np
from matplotlib.ticker import FixedLocator, NullFormatter

from faststrip_plots import bench, command, scales, style
from faststrip_plots.tables import InputError

FLOOR = 1e-17  # where an error of zero is drawn
METHODS = {
    "polynomial": "published polynomial",
    "refit": "refitted polynomial",
    "closed": "closed evaluation",
    "gsl_1d": "GSL quadrature, 1-D",
    "gsl_2d": "GSL quadrature, 2-D",
}
LOOPS = {
    "scalar": dict(label="scalar", color="#0b3c78", marker="o", markersize=8.5),
    "row": dict(label="row loop", color="#f08519", marker="D", markersize=7.5),
}
RUN = ("flags", "compiler", "cpu")


@bench.command(__doc__, "integral", ("method", "n", "b", "loop", "ns", "rel_err", *RUN))
def main(table):
    table.numbers("b")
    ns = table.positive("ns")
    loops = table.one_of("loop", LOOPS)
    error = np.maximum(np.abs(table.numbers("rel_err")), FLOOR)
    for name in RUN:
        if len(set(table.words(name))) > 1:
            raise InputError(f"{name} must be that of one run, got several: {table.path}")

    figure = style.new_figure(9.0, 5.8)
    axes = figure.subplots()
    dots = [
        (method, loop, spread(ns[rows]), spread(error[rows]))
        for (method, loop), rows in scales.groups(table.words("method"), loops)
    ]
    obstacles = draw_dots(axes, dots)
    axes.set(xscale="log", yscale="log")
    fit_limits(axes, dots)
    axes.set(xlabel="time of one evaluation, ns", ylabel="relative error",
             title="Influence integral: error against time")
    style.legend_above(figure, axes)
    flags, compiler, cpu = (table.words(name)[0] for name in RUN)
    flags = " ".join(word for word in flags.split() if word.startswith(("-O", "-m")))
    axes.set_title("; ".join(word for word in (compiler, flags, cpu) if word), loc="right",
                   color=style.GREY, fontsize=style.SMALL - 1, fontweight="normal")
    figure.draw_without_rendering()
    label(axes, dots, obstacles)
    return figure, f"medians over n and b, bars from least to largest; error 0 drawn at {FLOOR:g}"


def draw_dots(axes, dots):
    """Dots with bars, those of one method joined; returns what labels must not cover."""
    obstacles, named = [], set()
    for _, loop, x, y in dots:
        look = dict(LOOPS[loop])
        if loop in named:
            look["label"] = None
        named.add(loop)
        axes.plot(x[[0, 2]], y[[1, 1]], color=look["color"], linewidth=1.4, alpha=0.55, zorder=3)
        axes.plot(x[[1, 1]], y[[0, 2]], color=look["color"], linewidth=1.4, alpha=0.55, zorder=3)
        axes.plot(x[1], y[1], linestyle="none", markeredgecolor="white", zorder=4, **look)
        obstacles += [(x[0], y[1], x[2], y[1]), (x[1], y[0], x[1], y[2])]
    for _, pair in by_method(dots):
        if len(pair) == 2:
            x, y = zip(*((x[1], y[1]) for _, _, x, y in pair))
            axes.plot(x, y, color="#999999", linewidth=1.0, zorder=2)
            # a slanting line as a chain of small boxes
            steps = np.linspace(0.0, 1.0, 9)
            chain = np.exp(np.outer(1.0 - steps, np.log([x[0], y[0]]))
                           + np.outer(steps, np.log([x[1], y[1]])))
            obstacles += [(*point, *point) for point in chain]
    return obstacles


def fit_limits(axes, dots):
    """Decades around everything, room for labels on both sides."""
    low = min(x[0] for _, _, x, _ in dots)
    high = max(x[2] for _, _, x, _ in dots)
    axes.set_xlim(low / 4.0, high * 4.0)
    bottom = min(y[0] for _, _, _, y in dots)
    top = max(y[2] for _, _, _, y in dots)
    axes.set_ylim(bottom / 5.0, top * 12.0)
    decades = range(int(np.floor(np.log10(bottom))) - 1, int(np.ceil(np.log10(top))) + 2)
    axes.yaxis.set_major_locator(FixedLocator([10.0 ** k for k in decades if k % 2 == 0]))
    axes.yaxis.set_minor_locator(FixedLocator([10.0 ** k for k in decades]))
    axes.yaxis.set_minor_formatter(NullFormatter())


def label(axes, dots, obstacles):
    """One text per method: its name and its times."""
    labels = []
    for method, pair in by_method(dots):
        times = ", ".join(f"{duration(x[1])} {'row' if loop == 'row' else 'scalar'}"
                          for _, loop, x, _ in pair)
        _, _, x, y = pair[0]
        labels.append((x[1], y[1], f"{METHODS.get(method, method.replace('_', ' '))}\n{times}",
                       "#222222"))
    return scales.place_labels(axes, labels, obstacles)


def by_method(dots):
    return [(method, [dots[k] for k in rows])
            for method, rows in scales.groups([dot[0] for dot in dots])]


def spread(values):
    """Least, median and largest."""
    return np.array([values.min(), np.median(values), values.max()])


def duration(ns):
    """A time with its unit, two or three digits."""
    for unit, size in (("ms", 1e6), ("µs", 1e3), ("ns", 1.0)):
        if ns >= size or unit == "ns":
            value = ns / size
            return f"{value:.1f} {unit}" if value < 9.95 else f"{value:.0f} {unit}"


if __name__ == "__main__":
    sys.exit(command.run(main))
