#!/usr/bin/env python3
"""Draw claims of auto against the reference, estimates against errors, and errors against time."""

import os
import sys

import numpy as np
from matplotlib.ticker import NullLocator

from faststrip_plots import command, picture, style
from faststrip_plots.claims import (
    TARGETS,
    UPPER,
    Judged,
    claim_rows,
    front,
    largest_gap,
    promised,
    target_error,
    target_time,
    upper,
)
from faststrip_plots.document import announce
from faststrip_plots.results import revision

# Beginnings of methods' names: colour and marker.
FAMILIES = {
    "Hertz": ("Hertz ellipse", "#f08519", "s"),
    "strips + FASTSIM": ("strips + FASTSIM", "#a8326e", "^"),
    "strips + FASTSTRIP": ("strips + FASTSTRIP", "#0b3c78", "o"),
    "strips + plain": ("the same, not corrected", "#7fa6dc", "D"),
    "strips + TANG": ("strips + TANG", "#86b98a", "<"),
    "NORM": ("NORM + TANG", "#2f7d32", "v"),
}
KEPT, BROKEN, NONE = "#0b3c78", "#d22f27", "#9a9a9a"
AUTO = "#d22f27"
HEADINGS = {
    "forces": "Forces and moment: the worst of $F_x$, $F_y$, $M_z$",
    "pmax": "Maximum pressure",
    "penetration": "Penetration",
    "area": "Contact area",
    "power": "Friction power",
}
ESTIMATES = (("Fx", "$F_x$", "$\\mu\\cdot N$"), ("Fy", "$F_y$", "$\\mu\\cdot N$"),
             ("Mz", "$M_z$", "$\\mu\\cdot N c$"))
# Of each family one resolution, if they are there: dots of all hide each other.
SHOWN = ("strips 15 + FASTSIM 50x50", "strips 15 + plain 15", "strips 15 + FASTSTRIP 15",
         "NORM + TANG 18")
LEAST, MOST = 1e-3, 300.0  # % between which errors are drawn
FRONT_LEAST, FRONT_MOST = 0.02, 100.0  # the same on the front
WIDTH = 0.36  # of a column of contacts, of the distance of tolerances


def main(arguments=None):
    options = command.options(__doc__, arguments, {
        "results": ("out/claims.csv", "what `faststrip-lab claims` wrote"),
        "references": ("reference/claims/references.csv", "what `faststrip-lab references` wrote"),
        "methods": ("reference/claims/methods.csv", "the methods that were asked for")},
        folder=("out/claims", "pictures go there"))
    judged = Judged(options.results, options.references, options.methods)
    stamps = [revision(judged.table)]
    count = f"{len(judged)} contacts of kinds that nothing was fitted to"
    pictures = [
        (claims_figure(judged), "claims.png", "Claims and the reference",
         "Each point is a contact solved by auto for one target and tolerance. Status ok claims"
         " an error below the tolerance, the stair; target_missed claims nothing."),
        (estimates_figure(judged), "estimates.png", "Estimates and errors",
         "Estimated against true errors of the forces, contact by contact. Points below the"
         " diagonal are bounded."),
        (front_figure(judged), "front.png", "Errors of the forces against time",
         "The worst of Fx and Fy over mu N and Mz over mu N c, and the median time of a contact,"
         " normal problem included. The line joins what nothing else beats in both."),
    ]
    rows = []
    for figure, name, heading, caption in pictures:
        if figure is None:
            continue
        picture.save(figure, os.path.join(options.folder, name), stamps, count)
        rows.append((name, heading, caption, "auto"))
    announce(options.folder, "figures.csv", rows)


def claims_figure(judged):
    """Errors contact by contact at each tolerance, one panel a target."""
    targets = [target for target in TARGETS if judged.auto(target)]
    if not targets:
        return None
    figure = style.new_figure(12.0, 4.1 * ((len(targets) + 1) // 2))
    panels = figure.subplots((len(targets) + 1) // 2, 2, sharey=True, squeeze=False).ravel()
    shares = {(row["target"], row["tolerance"]): row for row in claim_rows(judged)}
    for axes, target in zip(panels, targets):
        draw_claims(axes, judged.auto(target), target, shares)
    for axes in panels[len(targets):]:
        axes.set_visible(False)
    for axes in panels[::2]:
        axes.set_ylabel("true error, %")
    style.legend_above(figure, *panels[:len(targets)])
    for handle in figure.legends[0].legend_handles[:3]:
        handle.set_sizes([24.0])
    return figure


def draw_claims(axes, solved, target, shares):
    """One panel: a column of contacts for each tolerance, in the order of their errors."""
    for place, each in enumerate(solved):
        tolerance = each.method.tolerance
        error = np.clip(100.0 * target_error(each, target), LEAST, MOST)
        word = promised(each)
        good = error <= 100.0 * tolerance
        for rows, colour, size, label in (
                (~word & each.has_result, NONE, 8.0, "nothing promised"),
                (word & good, KEPT, 5.0, "claim kept"),
                (word & ~good, BROKEN, 14.0, "claim broken")):
            values = np.sort(error[rows])
            x = place + np.linspace(-WIDTH, WIDTH, len(values)) if len(values) > 1 else \
                np.full(len(values), float(place))
            axes.scatter(x, values, s=size, color=colour, linewidths=0.0, label=label, zorder=3)
        axes.plot([place - 0.5, place + 0.5], [100.0 * tolerance] * 2, color="#111111",
                  linewidth=1.6, label="tolerance" if place == 0 else None, zorder=4)
        row = shares[target, tolerance]
        axes.annotate(f"{row['kept']} of {row['promised']}", (place, MOST), ha="center", va="top",
                      fontsize=style.SMALL, color="#111111")
    axes.set(yscale="log", ylim=(LEAST, 1.2 * MOST), xlim=(-0.6, len(solved) - 0.4))
    axes.set_xticks(range(len(solved)),
                    [f"{100.0 * each.method.tolerance:g} %" for each in solved])
    axes.xaxis.set_minor_locator(NullLocator())
    axes.set_xlabel("tolerance; above: claims kept of those given")
    axes.yaxis.set_major_formatter("{x:g}")
    axes.set_title(HEADINGS[target])


def estimates_figure(judged):
    """Estimates against errors of the forces, one panel a force."""
    known = [each for each in judged.fixed() if not np.isnan(each.estimate["Fx"]).all()]
    known = [each for each in known if each.method.name in SHOWN] or known
    if not known:
        return None
    figure = style.new_figure(12.0, 4.9)
    panels = figure.subplots(1, 3, sharex=True, sharey=True)
    for axes, (name, symbol, unit) in zip(panels, ESTIMATES):
        for each in known:
            label, colour, marker = family(each.method.name)
            error, estimate = each.error[name], each.estimate[name]
            axes.scatter(np.clip(100.0 * estimate, LEAST, MOST),
                         np.clip(100.0 * error, LEAST, MOST), s=5.0, color=colour, marker=marker,
                         linewidths=0.0, alpha=0.6, label=label, zorder=3)
        axes.plot([LEAST, MOST], [LEAST, MOST], color="#111111", linewidth=1.4, zorder=4,
                  label="estimate = error")
        axes.plot([LEAST, MOST], [0.2 * LEAST, 0.2 * MOST], color="#111111", linewidth=1.0,
                  linestyle=(0, (4, 2)), zorder=4, label="five times the error")
        style.log_axes(axes)
        axes.set(xlim=(LEAST, MOST), ylim=(LEAST, MOST), xlabel=f"estimated error, % of {unit}",
                 title=symbol)
    panels[0].set_ylabel("true error, %")
    style.legend_above(figure, panels[0])
    for handle in figure.legends[0].legend_handles[:-2]:
        handle.set_sizes([24.0])
    return figure


def front_figure(judged):
    """Mean and 95 % quantile of the errors of the forces against the median time."""
    figure = style.new_figure(12.0, 5.8)
    panels = figure.subplots(1, 2, sharex=True, sharey=True)
    reduced = (("Mean error", lambda values: float(values.mean())),
               ("95 % quantile of the errors", lambda values: upper(values, UPPER)))
    for axes, (heading, reduce) in zip(panels, reduced):
        points = []
        for each in judged.fixed():
            label, colour, marker = family(each.method.name)
            point = time_and_error(each, reduce)
            axes.plot(*point, linestyle="none", marker=marker, color=colour, markersize=7,
                      label=label, zorder=4)
            points.append(point)
        own = judged.auto("forces")
        if own:
            line = [time_and_error(each, reduce) for each in own]
            axes.plot(*zip(*line), color=AUTO, marker="*", markersize=11, linewidth=1.6,
                      label="auto, at its tolerances", zorder=5)
            for each, point in zip(own, line):
                axes.annotate(f"{100.0 * each.method.tolerance:g} %", point, (5.0, 5.0),
                              textcoords="offset points", fontsize=style.SMALL, color=AUTO)
            points += line
        best = front(points)
        axes.step(*zip(*best), where="post", color=style.GREY, linewidth=1.0, zorder=2,
                  label="nothing is better in both")
        style.log_axes(axes)
        axes.set(xlabel="median time of a contact, µs",
                 title=f"{heading}; no step of time above {largest_gap(points):.1f}")
    panels[0].set(ylim=(FRONT_LEAST, FRONT_MOST), ylabel="error of forces and moment, %")
    style.legend_above(figure, panels[0])
    return figure


def time_and_error(solved, reduce):
    """Median time and an error of the forces, %."""
    known = solved.has_result
    return (upper(target_time(solved, "forces")[known], 0.5),
            min(100.0 * reduce(target_error(solved, "forces")[known]), FRONT_MOST))


def family(name):
    """Label, colour and marker of a method."""
    words = [word for word in name.split() if not word.replace("x", "").isdigit()]
    for begin, look in FAMILIES.items():
        if " ".join(words).startswith(begin):
            return look
    return name, style.GREY, "x"


if __name__ == "__main__":
    sys.exit(command.run(main))
