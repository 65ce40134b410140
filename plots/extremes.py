#!/usr/bin/env python3
"""Draw what `faststrip-lab bench extremes` measured.

Maps show a relative error by colour; a field is grey where there is no number, and the line above
the map tells why. The files for rounding modes and for single precision are drawn if given.
"""

import os
import sys
from collections import namedtuple

import numpy as np
from matplotlib.colors import LogNorm

from faststrip_plots import command, picture, style
from faststrip_plots.results import revision
from faststrip_plots.tables import InputError, read_table

NAMES = ("chapter", "case", "method", "x_name", "x", "y_name", "y", "quantity", "value",
         "reference", "status")
FIGURES = {"penetration": "approach", "pmax": "maximum pressure", "area": "area", "Fx": "$F_x$",
           "Fy": "$F_y$", "Mz": "$M_z$"}
COLOURS = ("#0b3c78", "#f08519", "#4b8f3c", "#a8326e", "#5f4ba8", "#8a8a8a")
LINES = ("-", (0, (5, 1.8)), (0, (1.2, 1.2)), (0, (6, 1.6, 1.2, 1.6)), (0, (3, 1, 1, 1, 1, 1)),
         (0, (8, 2)))
MARKS = ("o", "s", "^", "D", "v", "P")
LOOKS = [{"color": colour, "linestyle": line, "marker": mark}
         for colour, line, mark in zip(COLOURS, LINES, MARKS)]
EMPTY = "#e9e9e9"
MANY = 50  # from so many fields on a map has no lines between them
LEAST = 1e-17  # what is below is drawn as this
EPSILON = 2.0**-52

Rows = namedtuple("Rows", "words x y value")
Panel = namedtuple("Panel", "heading rows limits")


def main(arguments=None):
    options = command.options(__doc__, arguments, {
        "extremes": ("out/extremes/extremes.csv", "what `faststrip-lab bench extremes` wrote"),
        "rounding": (None, "the part `rounding` of a program without vector functions"),
        "single": (None, "what tools/building/single_precision.py wrote")},
        folder=("out/extremes", "folder for the pictures"))
    table = read_table(options.extremes, NAMES)
    rows = read_rows(table)
    scalar = read_rows(read_table(options.rounding, NAMES)) if options.rounding else None
    single = read_rows(read_table(options.single, NAMES)) if options.single else None
    # By the chapter that each needs; the first gives the name.
    pictures = {
        ("influence", "influence"): lambda: draw_influence(rows),
        ("normal", "ellipses"): lambda: draw_normal(rows),
        ("tangential", "tangential"): lambda: draw_tangential(rows),
        ("steadiness", "noise"): lambda: draw_steadiness(rows, scalar),
    }
    drawn = {name: draw for (name, chapter), draw in pictures.items()
             if chapter in rows.words["chapter"]}
    if single is not None:
        drawn["single"] = lambda: draw_single(single)
    if not drawn:
        chapters = ", ".join(chapter for _, chapter in pictures)
        raise InputError(f"none of the chapters {chapters}: {options.extremes}")
    for name, draw in drawn.items():
        figure, note = draw()
        picture.save(figure, os.path.join(options.folder, f"extremes_{name}.png"),
                     [revision(table)], note)


def read_rows(table):
    """The table by columns: words as arrays of text, numbers with holes."""
    words = {name: np.array(table.words(name)) for name in
             ("chapter", "case", "method", "x_name", "y_name", "quantity", "status")}
    return Rows(words, table.numbers("x"), table.numbers("y"),
                np.abs(table.numbers("value", missing=True)))


def select(rows, **wanted):
    """The rows whose words are those wanted; a value may be a set."""
    keep = np.ones(rows.x.size, dtype=bool)
    for name, word in wanted.items():
        words = word if isinstance(word, (set, tuple, list)) else (word,)
        keep &= np.isin(rows.words[name], list(words))
    return Rows({name: column[keep] for name, column in rows.words.items()}, rows.x[keep],
                rows.y[keep], rows.value[keep])


# -------------------------------------------------------------------------------------- maps


def draw_map(axes, panel, x_label, y_label):
    """Colours of the largest value at each place; statuses without one are counted above."""
    rows = panel.rows
    if not rows.x.size:
        axes.set_visible(False)
        return None
    across, up = np.unique(rows.x), np.unique(rows.y)
    grid = np.full((up.size, across.size), np.nan)
    absent = {}
    for x, y, value, status in zip(rows.x, rows.y, rows.value, rows.words["status"]):
        at = np.searchsorted(up, y), np.searchsorted(across, x)
        if np.isnan(value):
            absent[status] = absent.get(status, 0) + 1
        else:
            grid[at] = np.nanmax([grid[at], value])
    image = axes.pcolormesh(np.arange(across.size + 1) - 0.5, np.arange(up.size + 1) - 0.5,
                            np.maximum(grid, LEAST), cmap=style.MAP, norm=LogNorm(*panel.limits),
                            edgecolors="white", linewidth=0.3 if across.size < MANY else 0.0)
    axes.set_facecolor(EMPTY)
    axes.grid(False)
    ticks(axes.xaxis, across)
    ticks(axes.yaxis, up)
    axes.set(xlabel=x_label, ylabel=y_label)
    axes.set_title(panel.heading, loc="left", fontweight="bold", pad=17.0)
    text = "no result" if np.isnan(grid).all() else f"largest {short(np.nanmax(grid))}"
    for status, number in absent.items():
        text += f"; {number} × {status.replace('_', ' ')}"
    axes.annotate(text, (0.0, 1.0), (0.0, 4.0), xycoords="axes fraction",
                  textcoords="offset points", fontsize=style.SMALL, color=style.GREY)
    return image


def ticks(axis, values):
    """Numbers at the middles of the fields, no more than fit."""
    if values.size < MANY or values[0] <= 0.0:
        chosen = np.arange(0, values.size, max(1, int(np.ceil(values.size / 9))))
        axis.set_ticks(chosen, [short(values[k]) for k in chosen])
        return
    # where the powers of ten lie between the fields
    logs = np.log10(values)
    powers = np.arange(3 * np.ceil(logs[0] / 3), logs[-1] + 0.5, 3)
    axis.set_ticks(np.interp(powers, logs, np.arange(values.size)),
                   [f"$10^{{{power:.0f}}}$" for power in powers])


def short(value):
    """A number of few digits: powers of ten as such, what is close to one by its distance."""
    if value == 0.0:
        return "0"
    if 0.0 < abs(value - 1.0) < 1e-4:
        return f"$1{'+' if value > 1.0 else '-'}${short(abs(value - 1.0))}"
    power = int(np.floor(np.log10(abs(value)) + 1e-12))
    digits = value / 10.0**power
    if -3 <= power < 4:
        return style.number(float(f"{value:.2g}"))
    if abs(digits - round(digits)) < 0.06 and round(digits) in (1, 10):
        return f"$10^{{{power + (round(digits) == 10)}}}$"
    return f"${digits:.1f}\\cdot 10^{{{power}}}$"


def colour_bar(figure, image, axes, label=""):
    """A narrow bar beside a map, if there is a map."""
    if image is not None:
        bar = figure.colorbar(image, ax=axes, pad=0.02, fraction=0.05)
        bar.set_label(label, fontsize=style.SMALL)


def draw_maps(panels, labels):
    """Several maps with their colour bars."""
    figure = style.new_figure(15.5, 7.6)
    axes = figure.subplots(2, 3)
    for place, panel, label in zip(axes.flat, panels, labels):
        image = draw_map(place, panel, *label)
        colour_bar(figure, image, place, "relative error")
    return figure


def draw_influence(rows):
    """Errors of the influence integral by each method."""
    own = select(rows, chapter="influence")
    centre = select(own, case="centre")
    beside = select(own, case=[case for case in np.unique(own.words["case"]) if case != "centre"])
    limits = (LEAST, 1e-11)
    panels = [
        Panel("Closed form, centre line", select(centre, method="closed"), limits),
        Panel("GSL, centre line", select(centre, method="gsl"), limits),
        Panel("Published polynomial", select(centre, method="published"), (1e-7, 1.0)),
        Panel("Off the centre line", select(beside, method="closed"), limits),
        Panel("The same by GSL", select(beside, method="gsl"), limits),
        Panel("Fresh fit, degree 16", select(centre, method="refit"), (1e-7, 1.0)),
    ]
    width, distance, place = "width over length $b$", "strip distance $n$", "place $X$"
    labels = [(width, place if heading in ("Off the centre line", "The same by GSL") else distance)
              for heading, _, _ in panels]
    return draw_maps(panels, labels), (
        "reference: quadrature in quadruple precision, its uncertainty added; off the centre line"
        " the largest of n = 0, 1, 10, 1000000")


def draw_normal(rows):
    """Errors of the strip solver against Hertz, and the condition of its matrix."""
    figure = style.new_figure(15.5, 7.6)
    axes = figure.subplots(2, 3)
    own = select(rows, chapter="strips")
    for place, quantity, heading in ((axes[0, 0], "penetration_err", "Error of the approach"),
                                     (axes[1, 0], "condition", "Condition number")):
        each = select(own, quantity=quantity)
        for k, ratio in enumerate(np.unique(each.x)):
            of_ratio = each.x == ratio
            place.loglog(each.y[of_ratio], each.value[of_ratio], **LOOKS[k % 6], markersize=4,
                         label=f"$a/b$ = {short(ratio)}")
        place.set(xlabel="number of strips $N$", title=heading)
    axes[0, 0].set_ylabel("relative error")
    axes[1, 0].set_ylabel("of the strip matrix, 1-norm")
    axes[1, 0].legend(fontsize=style.SMALL)
    limits = (1e-5, 1e-1)
    maps = (
        (axes[0, 1], "ellipses", "penetration_err", "Approach, 15 strips"),
        (axes[0, 2], "ellipses", "pmax_err", "Maximum pressure, 15 strips"),
        (axes[1, 1], "flat_gaps", "penetration_err", "Approach, flat gaps"),
        (axes[1, 2], "flat_gaps", "pmax_err", "Maximum pressure, flat gaps"),
    )
    names = {"ellipses": ("axes of the ellipse $a/b$", "load, N"),
             "flat_gaps": ("lateral relative curvature, 1/mm", "points of the gap")}
    for place, chapter, quantity, heading in maps:
        image = draw_map(place, Panel(heading, select(rows, chapter=chapter, quantity=quantity),
                                      limits), *names[chapter])
        colour_bar(figure, image, place, "relative error")
    return figure, "reference: Hertz's exact solution"


def draw_tangential(rows):
    """The size of the force of every method, and how far the rules are kept."""
    own = select(rows, chapter="tangential")
    methods = list(dict.fromkeys(own.words["method"]))
    columns = min(len(methods), 3)
    lines = -(-len(methods) // columns)
    figure = style.new_figure(max(9.0, 4.4 * columns), 3.2 * lines + 3.4)
    parts = figure.subfigures(2, 1, height_ratios=[lines, 0.9])
    axes = parts[0].subplots(lines, columns, squeeze=False)
    for place, method in zip(axes.flat, methods):
        force = select(own, method=method, quantity="force")
        image = draw_map(place, Panel(method, force, (1e-6, 1.0)), "creepage, spin in rad/mm",
                         "friction $\\mu$")
        colour_bar(parts[0], image, place, "of $\\mu\\cdot N$")
    for place in axes.flat[len(methods):]:
        place.set_visible(False)
    bars = parts[1].subplots()
    quantities = {"excess": "force above $\\mu\\cdot N$",
                  "step": "change by $10^{-6}$ more creepage",
                  "oddness": "left by opposite creepages",
                  "negative_power": "friction power below zero"}
    top = 10.0
    for k, (quantity, label) in enumerate(quantities.items()):
        heights = []
        for method in methods:
            name = "force" if quantity == "excess" else quantity
            value = select(own, method=method, quantity=name).value
            most = largest(value)
            heights.append(max(most - 1.0, 0.0) if quantity == "excess" else most)
        top = max(top, 10.0 * largest(np.array(heights)))
        bars.plot(np.arange(len(methods)) + 0.12 * (k - 1.5), np.maximum(heights, LEAST),
                  linestyle="none", marker=MARKS[k], markersize=7, color=COLOURS[k], label=label)
    bars.set(yscale="log", ylim=(LEAST / 3.0, top))
    bars.set_xticks(np.arange(len(methods)), methods)
    bars.set(xlim=(-0.5, len(methods) - 0.5), ylabel="largest, of $\\mu\\cdot N$",
             title=f"Rules kept? (zero is drawn at {short(LEAST)})")
    bars.legend(fontsize=style.SMALL, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return figure, ("maps: size of the force over $\\mu\\cdot N$ (over $N$ without friction),"
                    " largest of all directions and Poisson's ratios")


# --------------------------------------------------------------------------------- steadiness


def draw_steadiness(rows, scalar):
    """Noise, load steps and rounding modes."""
    figure = style.new_figure(14.5, 5.2)
    noise, steps, digits = figure.subplots(1, 3)
    own = select(rows, chapter="noise")
    levels = np.unique(own.x)
    noise.loglog(levels, levels, color=style.GREY, linewidth=1.0, label="change = noise")
    for k, (name, label) in enumerate(FIGURES.items()):
        each = select(own, quantity=name)
        worst = [largest(each.value[each.x == level]) for level in levels]
        noise.loglog(levels, worst, **LOOKS[k], markersize=4.5, label=label)
    noise.set(xlabel="noise of heights and curvatures, relative", ylabel="largest change, relative",
              title="Noise in the gap")
    noise.legend(fontsize=style.SMALL)
    own = select(rows, chapter="load_steps")
    for k, (name, label) in enumerate(FIGURES.items()):
        each = np.sort(select(own, quantity=name).value)
        each = np.maximum(each[np.isfinite(each)], LEAST)
        if each.size:
            steps.plot(np.arange(1, each.size + 1) / each.size, each, **LOOKS[k], markersize=3.5,
                       label=label)
    steps.set(yscale="log", ylim=(1e-10, None), xlabel="share of the contacts",
              ylabel="largest jump, relative", title="Jumps while the load grows")
    draw_digits(digits, rows, scalar)
    return figure, ("forces relative to $\\mu\\cdot N$, moment to"
                    " $\\mu\\cdot N\\sqrt{area/\\pi}$")


def draw_digits(axes, rows, scalar):
    """Digits that all four rounding modes share, the fewest of all contacts."""
    names = ["influence", *FIGURES]
    bars = [("whole library", rows, "strip+faststrip"),
            ("solvers alone, vector functions", rows, ("closed", "solvers alone"))]
    if scalar is not None:
        bars.append(("solvers alone, no vector functions", scalar, ("closed", "solvers alone")))
    height = 0.8 / len(bars)
    for k, (label, source, methods) in enumerate(bars):
        own = select(source, chapter="rounding", method=methods)
        worst = np.array([largest(select(own, quantity=name).value) for name in names])
        digits = -np.log10(np.maximum(worst, EPSILON / 2.0))
        axes.barh(np.arange(len(names)) + height * (k - 0.5 * (len(bars) - 1)), digits,
                  height=0.94 * height, color=COLOURS[k], label=label)
    axes.set_yticks(np.arange(len(names)), ["influence", *FIGURES.values()])
    axes.invert_yaxis()
    axes.set(xlim=(0.0, 16.5), xlabel="digits that agree", title="Four rounding modes")
    axes.legend(fontsize=style.SMALL, loc="upper center", bbox_to_anchor=(0.5, -0.12))


def largest(values):
    """The largest number, NaN if there is none."""
    known = values[np.isfinite(values)]
    return known.max() if known.size else np.nan


# ----------------------------------------------------------------------------- single precision


def draw_single(rows):
    """Errors of the kernels built in single precision."""
    influence = {"strip_influence", "strip_influence_at", "gradient", "column_gradient"}
    limits = (1e-8, 1e-2)
    panels = [Panel("Influence, value", select(rows, method=("strip_influence",
                                                             "strip_influence_at")), limits),
              Panel("Influence, derivatives", select(rows, method="gradient"), limits),
              Panel("Influence, columns", select(rows, method="column_gradient"), limits)]
    labels = [("width over length $b$", "place $X$")] * 3
    others = select(rows, method=[name for name in np.unique(rows.words["method"])
                                  if name not in influence])
    for heading, wanted in (
        ("Hertz", dict(method="hertz")),
        ("Strips: approach, pressure, area", dict(method="strips")),
        ("Strips: forces", dict(method="faststrip")),
    ):
        panels.append(Panel(heading, select(others, **wanted), limits))
        labels.append(("curvatures $A/B$", "load, N"))
    return draw_maps(panels, labels), (
        "single against double precision, the largest difference at each place")


if __name__ == "__main__":
    sys.exit(command.run(main))
