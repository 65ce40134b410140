"""The figures of Lack and Gerlici (2014) redone with our lines and the references as symbols."""

from __future__ import annotations

import re
from dataclasses import dataclass

import matplotlib
import numpy as np

from . import panels, scales, style
from .curves import ABSCISSA, GROUPS, RANGE, colour_of
from .results import QUANTITIES, error_sizes
from .tables import InputError, read_table

CHAPTER = "paper"  # of the report
WIDTH = 9.0  # inches: text of 10 points is still read at the width of a page
PUBLISHED = dict(linestyle="none", marker="D", markersize=4.4, markerfacecolor="white",
                 markeredgecolor="black", markeredgewidth=1.0, zorder=4, clip_on=False,
                 label="polynomial of Table 1")
ERROR_LINES = {2: (0, (5, 1.8)), 3: (0, (6, 1.6, 1.2, 1.6)), 4: (0, (1.2, 1.2))}  # by n
EVERY = 0.25  # of L, from one symbol to the next
INTEGRAL_FIGURES = ((5, 6), (7, 8), (9, 10))  # of the paper, one pair for each of GROUPS
FORCE_FIGURES = {"Fx": (21, 25), "Fy": (22, 26), "Mz": (23, 24)}
PAPER_SYMBOLS = {"Fx": "$T_x$", "Fy": "$T_y$", "Mz": "$M_z$"}
JUMP = 0.25  # of the larger value: from here on two neighbours are not joined
LEAST = 0.01  # of mu N (c): ratios to CONTACT's values from here on
RATIO_SPANS = (0.1, 0.25, 0.5, 1.0)  # about 1, of the axis of ratios
CREEPAGES = ("cksi", "ceta", "cphi_rad_per_mm")
CREEPAGE_TOLERANCE = 1e-3  # relative


@dataclass
class Picture:
    """A picture ready to be written, and what a report says about it."""

    stem: str  # of the file's name
    title: str
    caption: str
    figure: object
    stamps: list
    note: str = ""


# ------------------------------------------------------------------- Figs 5 to 10: integrals


def integral_pictures(curves, stamp):
    """Figs 5 to 10: one picture for each pair of figures whose strip distances are there."""
    for (left, right), (first, last) in zip(INTEGRAL_FIGURES, GROUPS):
        own = [curve for curve in curves if first <= curve.n <= last]
        if own:
            yield _integral_picture(left, right, own, stamp)


def _integral_picture(left, right, curves, stamp):
    figure = style.new_figure(WIDTH, 6.6)
    grid = figure.add_gridspec(2, 2, height_ratios=[1.75, 1.0])
    value, power = (figure.add_subplot(grid[0, k]) for k in (0, 1))
    error = figure.add_subplot(grid[1, :])
    error.axhline(0.0, color="#444444", linewidth=0.8, zorder=1)
    many = len(curves) > 4
    for curve in curves:
        inside, colour = curve.inside, colour_of(curve.n)
        L = curve.L[inside]
        symbols = np.abs(L / EVERY - np.round(L / EVERY)) < 1e-6
        for axes, change in ((value, np.array), (power, np.log10)):
            # the paper draws one half of the integral over the strip
            axes.plot(L, change(0.5 * curve.exact[inside]), color=colour, zorder=3,
                      linewidth=1.5 if many else 2.0, label="closed evaluation")
            axes.plot(L[symbols], change(0.5 * curve.published[inside][symbols]),
                      **{**PUBLISHED, "markersize": 2.8 if many else 4.4})
        error.plot(L, 100.0 * curve.rel_err[inside], color=colour, linewidth=1.2 if many else 1.8,
                   linestyle=ERROR_LINES.get(curve.n, "-"), zorder=3, label=f"{2 * curve.n}")
    for axes in (value, power, error):
        axes.set(xlim=RANGE, xlabel=ABSCISSA + ",  $b = y_d / x_d$")
    value.set(ylim=(0.0, None), ylabel="$i$ (half the integral)")
    power.set_ylabel(r"$E = \log_{10} i$")
    error.set_ylabel("polynomial less exact, %")
    value.set_title(f"Fig. {left} redone: $i$")
    power.set_title(f"Fig. {right} redone: $E$")
    error.set_title("Error of the published polynomial")
    style.legend_above(figure, value)
    matplotlib.artist.setp(figure.legends[0].legend_handles[0], color="#444444")
    figure.draw_without_rendering()
    if len(curves) > 1:
        order = [curves[0], curves[-1], *curves[1:-1]]
        for axes, change in ((value, np.array), (power, np.log10)):
            scales.label_ends(axes, RANGE[1] + 0.03, [
                (change(0.5 * _last(c.exact, c)), f"{2 * c.n}", colour_of(c.n)) for c in order
            ])
        error.legend(loc="upper right", ncols=8 if many else 4, fontsize=style.SMALL,
                     handlelength=1.4 if many else 3.0, columnspacing=1.0, labelspacing=0.2,
                     borderaxespad=0.2)
        error.set_ylim(top=1.25 * error.get_ylim()[1])
    worst = max(curves, key=_largest)
    columns = _columns(curves)
    caption = (
        f"One half of the influence integral of a strip ({columns} of Table 1, which is twice the"
        f" distance in strips) against the strip's half-width over its half-length, its logarithm,"
        f" and below the relative error of the published polynomial of degree 6:"
        f" {_percent(_largest(worst))} at most, for |s-k| = {2 * worst.n}."
    )
    note = "" if len(curves) == 1 else "numbers: |s−k| of Table 1"
    return Picture(f"fig{left:02d}_{right:02d}",
                   f"Figs {left} and {right}: influence integral, {columns}", caption, figure,
                   [stamp], note)


def _last(values, curve):
    return values[curve.inside][-1]


def _largest(curve):
    return 100.0 * float(np.max(np.nan_to_num(np.abs(curve.rel_err[curve.inside]))))


def _columns(curves):
    first, last = 2 * curves[0].n, 2 * curves[-1].n
    return f"|s-k| = {first}" if first == last else f"|s-k| = {first} to {last}"


# ----------------------------------------------- Figs 11 to 14: fine steps, normal figures


def shift_pictures(fine, reference):
    """Figs 11 and 12, maximum pressure, and 13 and 14, area, in fine steps of the shift."""
    for name, left, right in (("pmax", 11, 12), ("area", 13, 14)):
        quantity = QUANTITIES[name]
        figure = style.new_figure(WIDTH, 4.2)
        grid = figure.subplots(1, 2, sharey=True)
        for axes, side, number, words in zip(
            grid, (-1.0, 1.0), (left, right), ("away from the flange", "towards the flange")
        ):
            for method in fine.normals():
                use = side * method.yw >= -1e-9
                look = style.normal_look(method.normal)
                values = method.values[quantity.column][use] * quantity.scale
                axes.plot(*broken(method.yw[use], values), **look.line_style, zorder=3)
            use = side * reference.yw >= -1e-9
            axes.plot(reference.yw[use], reference.values[name][use] * quantity.scale, zorder=4,
                      **style.CONTACT)
            axes.set(xlabel=panels.SHIFT_LABEL, title=f"Fig. {number} redone: {words}")
        grid[0].set(ylim=(0.0, None), ylabel=f"{quantity.symbol}, {quantity.unit}")
        style.legend_above(figure, *grid)
        steps = [np.median(np.diff(method.yw)) for method in fine.methods if method.yw.size > 1]
        caption = (
            f"{quantity.name.capitalize()} against the lateral shift, the wheel moving away from"
            f" its flange (left) and towards it (right): lines in steps of"
            f" {min(steps, default=0.0):.2g} mm, broken where the point of contact jumps; CONTACT's"
            " normal solution at the shifts of Table 2."
        )
        yield Picture(f"fig{left}_{right}",
                      f"Figs {left} and {right}: {quantity.name} against shift", caption, figure,
                      [fine.stamp])


def broken(x, y):
    """A line with a hole wherever it jumps by more than a part of its height from step to step."""
    at = 1 + np.flatnonzero(np.abs(np.diff(y)) > JUMP * np.maximum(np.abs(y[1:]), np.abs(y[:-1])))
    return np.insert(x, at, np.nan), np.insert(y, at, np.nan)


# --------------------------------------------- Figs 17 to 26: the 20 contacts of Table 2


def normal_picture(sweep, reference, mu):
    """Figs 17 to 20: approach, area and maximum pressure, and the last over CONTACT's."""
    figure = style.new_figure(WIDTH, 7.0)
    grid = figure.subplots(2, 2, sharex=True)
    for axes, number, name in zip(grid.flat, (17, 18, 19), ("penetration", "area", "pmax")):
        panels.draw_value(axes, sweep, reference, name)
        words = "approach (“shift”)" if name == "penetration" else QUANTITIES[name].name
        axes.set_title(f"Fig. {number} redone: {words}")
    beyond = panels.draw_ratio(grid[1, 1], sweep, reference, "pmax", mu)
    grid[1, 1].set_title("Fig. 20 redone: $p_\\mathrm{max}$ over CONTACT's")
    for axes in grid[1]:
        axes.set_xlabel(panels.SHIFT_LABEL)
    figure.align_ylabels(grid)
    style.legend_above(figure, *grid.flat)
    caption = (
        "The 20 contacts of Table 2: approach of the bodies, contact area and maximum pressure, and"
        f" its ratio to CONTACT's. {_normal_errors(sweep, reference, mu)}"
    )
    return Picture("fig17_20", "Figs 17 to 20: normal contact against CONTACT", caption, figure,
                   [sweep.stamp], "▲▼: beyond the axis" if beyond else "")


def _normal_errors(sweep, reference, mu):
    parts = []
    for method in sweep.normals():
        errors = [error_sizes(sweep, method, reference, name, mu)
                  for name in ("penetration", "area", "pmax")]
        if errors[0].size:
            parts.append(f"{style.normal_look(method.normal).label} "
                         + ", ".join(_percent(error.mean()) for error in errors))
    return "Mean errors of approach, area and pressure: " + "; ".join(parts) + "."


def force_pictures(sweep, reference, mu, sign_set):
    """Figs 21 to 26: each force or moment, and its ratio to CONTACT's."""
    for name, (left, right) in FORCE_FIGURES.items():
        quantity = QUANTITIES[name]
        figure = style.new_figure(WIDTH, 4.4)
        value, ratio = figure.subplots(1, 2)
        panels.draw_value(value, sweep, reference, name)
        beyond = panels.draw_ratio(ratio, sweep, reference, name, mu, LEAST)
        symbol = PAPER_SYMBOLS[name]
        value.set_title(f"Fig. {left} redone: {symbol}")
        ratio.set_title(f"Fig. {right} redone: {symbol} over CONTACT's")
        for axes in (value, ratio):
            axes.set_xlabel(panels.SHIFT_LABEL)
        ratio.set_xlim(value.get_xlim())
        fit_ratios(ratio)
        value.set_ylabel(f"{symbol}, {quantity.unit}")
        ratio.set_ylabel(f"{symbol} over CONTACT's {symbol}")
        # in as many rows as a narrow figure needs
        style.legend_above(figure, value, length=2.8, spacing=1.6,
                           columns=lambda names: names if names <= 4 else 3)
        least = f"{100.0 * LEAST:g} %"
        base = panels.BASES[quantity.base]
        notes = [f"ratios where CONTACT's value is at least {least} of {base}"]
        if beyond:
            notes.append("▲▼: beyond the axis")
        turned = " The paper's moment (44) has the opposite sign." if name == "Mz" else ""
        words = quantity.name.capitalize()
        caption = (
            f"{words} on the rail at the 20 contacts of Table 2, sign set {sign_set}, and its ratio"
            f" to CONTACT's.{turned} {_force_errors(sweep, reference, name, mu)}"
        )
        yield Picture(f"fig{left}_{right}", f"Figs {left} and {right}: {quantity.name}", caption,
                      figure, [sweep.stamp], "; ".join(notes))


def fit_ratios(axes):
    """The narrowest of some spans about 1 that holds all that is drawn."""
    drawn = np.concatenate([np.asarray(line.get_ydata(), dtype=float) for line in axes.lines])
    off = np.nanmax(np.abs(drawn - 1.0))
    for span in RATIO_SPANS:
        if off <= span:
            axes.set_ylim(1.0 - span, 1.0 + span)
            break


def _force_errors(sweep, reference, name, mu):
    base = QUANTITIES[name].base
    parts = []
    for method in sweep.methods:
        error = error_sizes(sweep, method, reference, name, mu)
        if error.size:
            parts.append(f"{style.method_look(*method.key).label} {_percent(error.mean())}")
    return f"Mean errors in percent of {base}: " + "; ".join(parts) + "."


def _percent(value):
    return f"{value:.2g} %"


# ------------------------------------------------------------------- the same cases, or not


def check_creepages(sweep_path, reference_path):
    """Refuse a sweep whose creepages are not the reference's; return the reference's sign set."""
    ours = read_table(sweep_path, ("yw_mm",) + CREEPAGES)
    theirs = read_table(reference_path, ("yw_mm",) + CREEPAGES)
    shift = theirs.numbers("yw_mm")
    for name in CREEPAGES:
        expected, got = theirs.numbers(name), ours.numbers(name)
        allowed = CREEPAGE_TOLERANCE * np.abs(expected).max()
        for yw, value, line in zip(ours.numbers("yw_mm"), got, ours.lines):
            near = np.flatnonzero(np.abs(shift - yw) < 1e-6)
            if near.size and abs(value - expected[near[0]]) > allowed:
                raise InputError(
                    f"{name} at shift {yw:g} must be the reference's, {expected[near[0]]:g}, got"
                    f" {value:g} ({sweep_path}:{line}, {reference_path})"
                )
    return sign_set(theirs)


def sign_set(table):
    """The letter of the sign set a reference names in its first lines, or `not named`."""
    for comment in table.comments:
        found = re.search(r"\bsign set (\w+)", comment)
        if found:
            return found.group(1)
    return "not named"
