"""The panels the figures are made of; each draws on axes given to it."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize

from . import style
from .results import (
    NORMAL_QUANTITIES,
    QUANTITIES,
    compare,
    grid_step,
    percent_errors,
)
from .tables import InputError

SHIFT_LABEL = "lateral shift of the wheel, mm"
NEAR_ZERO = 0.05  # of mu N (or mu N c): below it a ratio to the reference says nothing
# what errors of forces and moments are a part of, in pictures: plain letters read as micronewton
BASES = {"mu N": r"$\mu\cdot N$", "mu N c": r"$\mu\cdot N c$"}
NORMAL_RATIOS = (0.4, 1.6)
FORCE_RATIOS = (0.0, 2.0)
PALE = style.PALE


# ---------------------------------------------------------------- sweep over lateral shifts


def sweep_lines(sweep, name):
    """Pairs of results and look to draw for a quantity: per normal method or per combination."""
    if name in NORMAL_QUANTITIES:
        return [(method, style.normal_look(method.normal)) for method in sweep.normals()]
    return [(method, style.method_look(*method.key)) for method in sweep.methods]


def draw_value(axes, sweep, reference, name):
    """A quantity against the shift: methods as lines, CONTACT as symbols."""
    quantity = QUANTITIES[name]
    for method, look in sweep_lines(sweep, name):
        _line(axes, sweep, method.yw, method.values[quantity.column] * quantity.scale, look)
    if reference is not None:
        axes.plot(reference.yw, reference.values[name] * quantity.scale, zorder=4, **style.CONTACT)
    if name in NORMAL_QUANTITIES:
        axes.set_ylim(bottom=0.0)
    else:
        axes.axhline(0.0, color="#444444", linewidth=0.8, zorder=1)
    axes.set(ylabel=f"{quantity.symbol}, {quantity.unit}", title=quantity.title)


def draw_ratio(axes, sweep, reference, name, mu, least=NEAR_ZERO):
    """A quantity over CONTACT's; forces and moments only where the reference is not near zero.

    Near zero is below `least`, as a part of mu N or mu N c. Returns whether some ratio lies beyond
    the axis, where a triangle stands for it.
    """
    quantity = QUANTITIES[name]
    base = reference.base(name, mu)
    low, high = NORMAL_RATIOS if name in NORMAL_QUANTITIES else FORCE_RATIOS
    outside = False
    for method, look in sweep_lines(sweep, name):
        pairs = compare(sweep, method, reference)
        expected = reference.values[name][pairs.reference_rows]
        ratio = np.full(len(method.yw), np.nan)
        enough = np.abs(expected) >= least * base[pairs.reference_rows]
        rows = pairs.rows[enough]
        ratio[rows] = method.values[quantity.column][rows] / expected[enough]
        _line(axes, sweep, method.yw, ratio, look)
        for limit, marker, beyond in ((high, "^", ratio > high), (low, "v", ratio < low)):
            if beyond.any():
                axes.plot(
                    method.yw[beyond], np.full(beyond.sum(), limit), linestyle="none",
                    marker=marker, markersize=7, color=look.colour, clip_on=False, zorder=5,
                )
                outside = True
    axes.axhline(1.0, color="#444444", linewidth=0.8, zorder=1)
    axes.set(ylim=(low, high), ylabel=f"{quantity.symbol} over CONTACT's {quantity.symbol}",
             title=quantity.name.capitalize() + ": ratio")
    return outside


def draw_difference(axes, sweep, reference, name, mu):
    """A quantity less CONTACT's, in percent of mu N or mu N c."""
    for method, look in sweep_lines(sweep, name):
        pairs = compare(sweep, method, reference)
        error = np.full(len(method.yw), np.nan)
        error[pairs.rows] = percent_errors(pairs, reference, name, mu)
        _line(axes, sweep, method.yw, error, look)
    axes.axhline(0.0, color="#444444", linewidth=0.8, zorder=1)
    base = QUANTITIES[name].base
    unit = f"% of {BASES[base]}" if base in BASES else "%"
    axes.set(ylabel=f"{QUANTITIES[name].symbol} less CONTACT's, {unit}",
             title=QUANTITIES[name].title + ": difference")


def jump_note(sweep) -> str:
    """What a picture of a sweep says of its lines."""
    return "lines end where the contact point jumps" if sweep.jumps() else ""


def _line(axes, sweep, x, y, look):
    jumped = [any(low < there < high for there in sweep.jumps()) for low, high in zip(x, x[1:])]
    axes.plot(
        *style.broken(jumped, x, y), **look.line_style,
        marker="o", markersize=2.6, zorder=2.8 if look.width > 3.0 else 3,
    )


# ------------------------------------------------------------------------ patch and pressure


def draw_outlines(axes, strips=None, ellipse=None, contact=None):
    """Outlines of the contact: strips as bars and curve, Hertz ellipse, CONTACT's border."""
    if strips is not None:
        look = style.normal_look("strip")
        for patch in strips.patches:
            bars = [
                ((left, -half), (right, -half), (right, half), (left, half))
                for left, right, half in zip(patch.y_left, patch.y_right, patch.half_length)
            ]
            axes.add_collection(
                PolyCollection(bars, facecolor=PALE, edgecolor="white", linewidth=1.0, zorder=1)
            )
            y, half = patch.smooth(patch.half_length)
            axes.plot(
                np.concatenate([y, y[::-1]]), np.concatenate([half, -half[::-1]]),
                **look.line_style, zorder=3,
            )
    if ellipse is not None:
        look = style.normal_look("hertz")
        angle = np.linspace(0.0, 2.0 * math.pi, 241)
        axes.plot(
            ellipse.middle + ellipse.b * np.cos(angle), ellipse.a * np.sin(angle),
            **look.line_style,
            zorder=2,
        )
    if contact is not None:
        y, x = border(contact)
        axes.plot(y, x, zorder=4, **style.CONTACT)
    axes.set_aspect("equal")
    axes.margins(0.04)
    axes.autoscale_view()
    patch_axes(axes)


def patch_axes(axes):
    """Labels of a plane of contact: y to the right, x (rolling) up."""
    axes.set(xlabel="lateral $y$, mm", ylabel="rolling direction $x$, mm")


def share_limits(*several):
    """Give several planes of contact the same window."""
    x = [end for axes in several for end in axes.get_xlim()]
    y = [end for axes in several for end in axes.get_ylim()]
    for axes in several:
        axes.set(xlim=(min(x), max(x)), ylim=(min(y), max(y)))


def border(field, spacing=4.0):
    """Points on the border of a regular grid's elements in contact, `spacing` elements apart."""
    step = grid_step(field)
    runs = [
        (y, x[0] - 0.5 * step, x[-1] + 0.5 * step)
        for y, row in zip(field.y, field.x)
        for x in np.split(row, np.flatnonzero(np.diff(row) > 1.5 * step) + 1)
    ]
    points = [(y, end) for y, low, high in runs for end in (low, high)]
    for x in np.unique(np.concatenate(field.x)):
        column = np.array([y for y, low, high in runs if low < x < high])
        for part in np.split(column, np.flatnonzero(np.diff(column) > 1.5 * step) + 1):
            points += [(part[0] - 0.5 * step, x), (part[-1] + 0.5 * step, x)]
    kept = []
    for point in points:
        if all(math.hypot(point[0] - p[0], point[1] - p[1]) >= spacing * step for p in kept):
            kept.append(point)
    return np.array([p[0] for p in kept]), np.array([p[1] for p in kept])


def draw_strip_pressure(axes, strips, field, top):
    """Pressure of the strips' elements, each a tile; returns the mappable."""
    tiles, values = [], []
    for patch in strips.patches:
        for left, right, y, half in zip(patch.y_left, patch.y_right, patch.y, patch.half_length):
            row = field.nearest_row(y)
            if not left < field.y[row] < right:
                raise InputError(f"no field points in the strip at y_mm = {y:g}: {field.path}")
            x = field.x[row]
            edges = np.concatenate([[-half], 0.5 * (x[1:] + x[:-1]), [half]])
            for low, high, p in zip(edges, edges[1:], field.pressure[row]):
                tiles.append(((left, low), (right, low), (right, high), (left, high)))
                values.append(p)
    return _tiles(axes, tiles, values, top)


def draw_grid_pressure(axes, field, top):
    """Pressure on a regular grid, each element a tile; returns the mappable."""
    half = 0.5 * grid_step(field)
    tiles, values = [], []
    for y, row, pressures in zip(field.y, field.x, field.pressure):
        for x, p in zip(row, pressures):
            low, high, left, right = x - half, x + half, y - half, y + half
            tiles.append(((left, low), (right, low), (right, high), (left, high)))
            values.append(p)
    return _tiles(axes, tiles, values, top)


def _tiles(axes, tiles, values, top):
    collection = PolyCollection(
        tiles, array=np.array(values), cmap=style.MAP, norm=Normalize(0.0, top),
        edgecolor="face", linewidth=0.2,
    )
    axes.add_collection(collection)
    axes.set_aspect("equal")
    axes.margins(0.04)
    axes.autoscale_view()
    axes.grid(False)
    patch_axes(axes)
    return collection


def draw_cut_along_y(axes, strips, ellipse=None, contact=None, norm=None):
    """Pressure on the centre line x = 0."""
    look = style.normal_look("strip")
    for patch in strips.patches:
        y, p = patch.smooth(patch.p0)
        axes.plot(y, p, **look.line_style, zorder=3)
        axes.plot(patch.y, patch.p0, color=look.colour, linestyle="none", marker="o",
                  markersize=3.2, zorder=3)
    if ellipse is not None:
        _half_ellipse(axes, ellipse.middle, ellipse.b, ellipse.pmax)
    if norm is not None:
        _norm_line(axes, *_beside_the_centre_line(norm))
    if contact is not None:
        _symbols(axes, *_beside_the_centre_line(contact), 34)
    axes.set(ylim=(0.0, None), xlabel="lateral $y$, mm", ylabel="pressure, MPa")


def _beside_the_centre_line(field):
    """y and pressure of the elements of a grid that are nearest to x = 0."""
    x = np.array([float(np.abs(row).min()) for row in field.x])
    p = np.array([float(p[np.argmin(np.abs(row))]) for row, p in zip(field.x, field.pressure)])
    keep = x < grid_step(field)
    return field.y[keep], p[keep]


def draw_cut_along_x(axes, strips, field, ellipse=None, contact=None, norm=None):
    """Pressure along the strip with the maximum pressure."""
    patch, k = strips.strongest()
    y = patch.y[k]
    look = style.normal_look("strip")
    row = field.nearest_row(y)
    half = patch.half_length[k]
    axes.plot(
        np.concatenate([[-half], field.x[row], [half]]),
        np.concatenate([[0.0], field.pressure[row], [0.0]]),
        **look.line_style, marker="o",
        markersize=3.2, zorder=3,
    )
    if ellipse is not None:
        rest = 1.0 - ((y - ellipse.middle) / ellipse.b) ** 2
        if rest > 0.0:
            _half_ellipse(axes, 0.0, ellipse.a * math.sqrt(rest), ellipse.pmax * math.sqrt(rest))
    if norm is not None:
        row = norm.nearest_row(y)
        _norm_line(axes, norm.x[row], norm.pressure[row])
    if contact is not None:
        row = contact.nearest_row(y)
        _symbols(axes, contact.x[row], contact.pressure[row], 24)
    axes.set(ylim=(0.0, None), xlabel="rolling direction $x$, mm", ylabel="pressure, MPa")
    return y


def _norm_line(axes, x, y):
    """Pressures of NORM along a cut, apart where there is no contact between them."""
    look = style.normal_look("norm")
    gaps = np.flatnonzero(np.diff(x) > 1.5 * np.diff(x).min()) if len(x) > 1 else []
    parts = zip(np.split(x, np.add(gaps, 1).astype(int)), np.split(y, np.add(gaps, 1).astype(int)))
    for along, pressure in parts:
        axes.plot(along, pressure, **look.line_style, zorder=2.8)


def _symbols(axes, x, y, number):
    """About `number` of CONTACT's points, the highest among them."""
    if len(x):
        every = max(1, round(len(x) / number))
        first = int(np.argmax(y)) % every
        axes.plot(x[first::every], y[first::every], zorder=4, **style.CONTACT)


def _half_ellipse(axes, middle, half, top):
    look = style.normal_look("hertz")
    angle = np.linspace(0.0, math.pi, 181)
    axes.plot(middle + half * np.cos(angle), top * np.sin(angle), **look.line_style, zorder=2)


class Ellipse:
    """The Hertz ellipse of a row of the sweep: middle in y, half-axes a along x and b along y."""

    def __init__(self, method, row):
        low, high = method.values["ymin_mm"][row], method.values["ymax_mm"][row]
        self.middle = 0.5 * (low + high)
        self.b = 0.5 * (high - low)
        self.a = method.values["xmax_mm"][row]
        self.pmax = method.values["pmax_MPa"][row]


def hertz_ellipse(sweep, shift):
    """The Hertz ellipse of a shift, none where there is no Hertz result."""
    found = sweep.find("hertz", shift)
    return None if found is None else Ellipse(*found)


# --------------------------------------------------------------------------------- profiles


def distance(profiles):
    """Lateral y and the distance rail less wheel along z where both are, mm."""
    wheel, rail = _ascending(profiles.wheel), _ascending(profiles.rail)
    low, high = max(wheel[0, 0], rail[0, 0]), min(wheel[-1, 0], rail[-1, 0])
    y = np.linspace(low, high, 4001)
    return y, np.interp(y, rail[:, 0], rail[:, 1]) - np.interp(y, wheel[:, 0], wheel[:, 1])


def _ascending(points):
    return points[np.argsort(points[:, 0], kind="stable")]


def draw_profiles(axes, profiles):
    """Wheel above rail, z down, equal scales."""
    wheel, rail = profiles.wheel, profiles.rail
    axes.fill_between(rail[:, 0], rail[:, 1], rail[:, 1].max(), color="#dcdcdc", linewidth=0,
                      zorder=1)
    axes.fill_between(wheel[:, 0], wheel[:, 1], wheel[:, 1].min(), color=PALE, linewidth=0,
                      zorder=1)
    axes.plot(wheel[:, 0], wheel[:, 1], color="#0b3c78", linewidth=2.0, zorder=3)
    axes.plot(rail[:, 0], rail[:, 1], color="#444444", linewidth=2.0, zorder=3)
    axes.set_aspect("equal")
    axes.invert_yaxis()
    axes.set(xlabel="lateral $y$, mm", ylabel="$z$ (down), mm")
    for name, points, side in (("wheel", wheel, np.min), ("rail", rail, np.max)):
        # the word stands halfway between the surface and the flat end of the body drawn
        middle = 0.5 * (points[:, 0].min() + points[:, 0].max()) if name == "rail" else points[
            np.argmax(points[:, 1]), 0]
        surface = points[np.argmin(np.abs(points[:, 0] - middle)), 1]
        axes.text(middle, 0.5 * (surface + side(points[:, 1])), name, ha="center", va="center",
                  fontsize=style.FONT + 1)
