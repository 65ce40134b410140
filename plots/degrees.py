#!/usr/bin/env python3
"""Draw error against polynomial degree for both bases, and the condition of their fits."""

import sys

import numpy as np
from matplotlib.ticker import LogLocator, NullFormatter

from faststrip_plots import command, picture, scales, style
from faststrip_plots.tables import InputError

BASES = {
    "monomial": style.Look("monomials $L^k$", "#f08519", (0, (5, 1.8)), 1.8),
    "chebyshev": style.Look("Chebyshev polynomials $T_k$", "#0b3c78", "-", 2.0),
}
FITS = {
    "lsq": "least squares",
    "minimax": "minimax",
    "author": "the author's procedure",
}
COLUMNS = ("basis", "fit", "n", "degree", "max_rel_err", "rms_rel_err", "condition")
PUBLISHED = 6  # degree of the published polynomials
RED = "#c03010"  # where monomials break down
MORE = 1.25  # times the error in Chebyshev polynomials of the same degree: broken down


class Decay:
    """One basis and fit by ascending degree; NaN where a fit was refused."""

    def __init__(self, table, rows):
        degree = table.numbers("degree")
        error = table.numbers("max_rel_err", missing=True)
        rms = table.numbers("rms_rel_err", missing=True)
        condition = table.numbers("condition", missing=True)
        self.degree = np.unique(degree[rows])
        each = [rows[degree[rows] == d] for d in self.degree]
        self.low, self.high, self.rms, self.condition = (
            np.array([pick(column[own]) for own in each])
            for pick, column in ((least, error), (largest, error), (largest, rms),
                                 (largest, condition))
        )


@picture.command(__doc__, "out/degrees.png", degrees=(
    "out/degrees.csv", f"columns {','.join(COLUMNS)}", COLUMNS))
def main(table):
    table.numbers("n")
    for basis, line in zip(table.words("basis"), table.lines):
        if basis not in BASES:
            raise InputError(
                f"basis must be monomial or chebyshev, got {basis} ({table.path}:{line})"
            )
    decays = {key: Decay(table, rows)
              for key, rows in scales.groups(table.words("fit"), table.words("basis"))}
    if not any((decay.high > 0.0).any() for decay in decays.values()):
        raise InputError(f"max_rel_err must have an error above zero, got none: {table.path}")
    fits = list(dict.fromkeys(fit for fit, _ in decays))

    figure = style.new_figure(5.6 * max(len(fits), 1.3), 7.6)
    grid = figure.subplots(2, len(fits), squeeze=False, sharex=True, sharey="row",
                           height_ratios=[1.5, 1.0])
    for fit, (upper, lower) in zip(fits, grid.T):
        own = {basis: decays[fit, basis] for basis in BASES if (fit, basis) in decays}
        draw_fit(upper, lower, own)
        upper.set_title(f"Relative error, {FITS.get(fit, fit)}")
        lower.set(title="Condition of the matrix", xlabel="degree")
    grid[0, 0].set_ylabel("largest |relative error|")
    grid[1, 0].set_ylabel("condition number")
    figure.align_ylabels(grid[:, 0])
    style.legend_above(figure, *grid[0])
    distances = len(set(table.words("n")))
    return figure, f"line: worst of {distances} strip distances; band: least to worst; dots: rms"


def draw_fit(upper, lower, decays):
    """Both bases: error and, below, condition."""
    for axes in (upper, lower):
        axes.set_yscale("log")
        axes.axvline(PUBLISHED, color="#bbbbbb", linewidth=1.2, zorder=1)
        axes.yaxis.set_major_locator(LogLocator(numticks=10))
        axes.yaxis.set_minor_formatter(NullFormatter())
    upper.annotate(f"degree {PUBLISHED}: published", (PUBLISHED, 0.02), (3.0, 0.0), rotation=90,
                   va="bottom", color=style.GREY, xycoords=("data", "axes fraction"),
                   textcoords="offset points", fontsize=style.SMALL)
    for basis in reversed(decays):
        decay, look = decays[basis], BASES[basis]
        front = 4 if basis == "monomial" else 3
        line = look.line_style | dict(zorder=front)
        upper.fill_between(decay.degree, scales.positive(decay.low), scales.positive(decay.high),
                           color=look.colour, alpha=0.14, linewidth=0.0, zorder=2)
        upper.plot(decay.degree, scales.positive(decay.high), **line)
        upper.plot(decay.degree, scales.positive(decay.rms), color=look.colour, linestyle="none",
                   marker=".", markersize=3.2, zorder=front)
        lower.plot(decay.degree, scales.positive(decay.condition), **line)
    if "monomial" in decays:
        mark_breakdown(upper, lower, decays["monomial"], decays.get("chebyshev"))


def mark_breakdown(upper, lower, monomial, chebyshev):
    """A line at the first degree that monomials do not carry."""
    degree, why = breakdown(monomial, chebyshev)
    if degree is None:
        return
    for axes in (upper, lower):
        axes.axvline(degree, color=RED, linewidth=1.3, linestyle=(0, (2, 1.5)), zorder=2)
    condition = monomial.condition[monomial.degree == degree]
    if condition.size and condition[0] > 0.0:
        why += f"\ncondition {power_text(condition[0])}"
    right = degree > 0.55 * monomial.degree[-1]
    upper.annotate(f"monomials {why}", (degree, 0.93), (-5.0 if right else 5.0, 0.0), va="top",
                   xycoords=("data", "axes fraction"), textcoords="offset points", color=RED,
                   ha="right" if right else "left", fontsize=style.SMALL)


def breakdown(monomial, chebyshev):
    """First degree that monomials do not carry and in what way, None if they carry all."""
    expected = {} if chebyshev is None else dict(zip(chebyshev.degree, chebyshev.high))
    for degree, error in zip(monomial.degree, monomial.high):
        if np.isnan(error):
            return degree, f"refused from degree {degree:g} on"
        if error > MORE * expected.get(degree, np.inf):
            return degree, f"break down at degree {degree:g}\n(error > {MORE:g} × Chebyshev's)"
    missing = [degree for degree in expected if degree > monomial.degree[-1]]
    if missing:
        return min(missing), f"refused from degree {min(missing):g} on"
    return None, ""


def power_text(value):
    digits, exponent = f"{value:.0e}".split("e")
    return rf"${digits} \cdot 10^{{{int(exponent)}}}$"


def least(values):
    known = values[~np.isnan(values)]
    return known.min() if known.size else np.nan


def largest(values):
    known = values[~np.isnan(values)]
    return known.max() if known.size else np.nan


if __name__ == "__main__":
    sys.exit(command.run(main))
