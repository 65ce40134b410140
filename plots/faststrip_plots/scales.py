"""Logarithmic axes: groups of rows, slopes, and labels that keep clear of each other."""

from __future__ import annotations

import math

import numpy as np

from . import style

LABEL_GAP = 3.0  # points between a label and what it belongs to
NEAR = 9.0  # points from a dot to its label where nothing is in the way


def groups(*columns):
    """Pairs of key and indices of its rows, keys in the order of their first appearance."""
    found = {}
    for row, key in enumerate(zip(*columns)):
        found.setdefault(key if len(columns) > 1 else key[0], []).append(row)
    return [(key, np.array(rows)) for key, rows in found.items()]


def positive(values):
    """The values, with holes where they have no logarithm."""
    return np.where(values > 0.0, values, np.nan)


def power(x, y) -> float:
    """Exponent p of y ~ x**p by least squares in logarithms; NaN where two points lack."""
    use = (x > 0.0) & (y > 0.0)
    x, y = np.log(x[use]), np.log(y[use])
    if x.size < 2 or np.ptp(x) == 0.0:
        return math.nan
    return float(np.polyfit(x - x.mean(), y, 1)[0])


def draw_order(axes, low: float, high: float, end: float, order: float) -> None:
    """A triangle above a falling line of slope `order` from `low` to the point `high, end`."""
    start = end * (low / high) ** order
    axes.fill([low, high, high], [start, start, end], facecolor="#ececec", edgecolor=style.GREY,
              linewidth=1.0, zorder=1.5)
    look = dict(textcoords="offset points", color=style.GREY, fontsize=style.SMALL)
    axes.annotate("1", (math.sqrt(low * high), start), (0.0, LABEL_GAP), ha="center", va="bottom",
                  **look)
    axes.annotate(style.number(-order), (high, math.sqrt(start * end)), (LABEL_GAP, 0.0),
                  ha="left", va="center", **look)


def ends(counts, factor: float):
    """Indices within a factor of the first and of the last of ascending counts, one set where they
    are all."""
    few = np.flatnonzero(counts <= factor * counts[0])
    many = np.flatnonzero(counts >= counts[-1] / factor)
    if np.intersect1d(few, many).size > 1:
        return [np.arange(counts.size)]
    return [few, many]


def label_ends(axes, x: float, labels) -> None:
    """Texts right of the points `x, y`; those too close to one placed before are left out.

    `labels` holds tuples (y, text, colour), the most important first. Limits must be set.
    """
    taken = []
    height = 1.15 * style.SMALL * axes.figure.dpi / 72.0
    for y, text, colour in labels:
        place = axes.transData.transform((x, y))[1]
        if all(abs(place - other) >= height for other in taken):
            taken.append(place)
            axes.annotate(text, (x, y), (LABEL_GAP, 0.0), textcoords="offset points", va="center",
                          color=colour, fontsize=style.SMALL, annotation_clip=False)


def place_labels(axes, labels, obstacles):
    """Texts beside their points where they cover neither each other nor an obstacle.

    `labels` holds tuples (x, y, text, colour); `obstacles` boxes (x0, y0, x1, y1), all in data.
    A text that stands farther off is tied to its point by a thin line. Limits must be set and
    the layout done. Returns the texts.
    """
    renderer = axes.figure.canvas.get_renderer()
    unit = axes.figure.dpi / 72.0
    taken = [_box(axes, *each, 4.0 * unit) for each in obstacles]
    frame = axes.get_window_extent(renderer)
    written, texts = [], []
    for x, y, text, colour in labels:
        drawn = axes.text(x, y, text, color=colour, fontsize=style.SMALL, zorder=6,
                          linespacing=1.15)
        point = axes.transData.transform((x, y))
        best = None
        for order, (across, up, far) in enumerate(_places()):
            drawn.set_horizontalalignment(("right", "center", "left")[across + 1])
            drawn.set_verticalalignment(("top", "center", "bottom")[up + 1])
            at = point + far * unit * np.array([across, up])
            drawn.set_position(axes.transData.inverted().transform(at))
            box = drawn.get_window_extent(renderer)
            box = np.array([box.x0, box.y0, box.x1, box.y1])
            tie = np.linspace(point, np.clip(point, box[:2], box[2:]), 20)
            hidden = sum(_common(box, other) for other in taken + written)
            crossed = sum(_common((*(q - unit), *(q + unit)), other)
                          for q in tie for other in written)
            inside = _common(box, (frame.x0, frame.y0, frame.x1, frame.y1))
            cost = hidden + 10.0 * (crossed + _area(box) - inside) + 1e-3 * order
            if best is None or cost < best[0]:
                best = (cost, drawn.get_position(), drawn.get_ha(), drawn.get_va(), box, tie, far)
        _, position, across, up, box, tie, far = best
        drawn.set(position=position, horizontalalignment=across, verticalalignment=up)
        written.append(box)
        if far > NEAR:
            axes.plot(*axes.transData.inverted().transform(tie[[0, -1]]).T, color="#555555",
                      linewidth=0.7, zorder=3.5)
            taken += [np.array([*(q - unit), *(q + unit)]) for q in tie]
        texts.append(drawn)
    return texts


def _places():
    """Directions (across, up) and distances in points tried for a label, the best first."""
    directions = ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1))
    for far in (NEAR, 16.0, 26.0, 40.0, 60.0):
        for across, up in directions:
            yield across, up, far


def _box(axes, x0, y0, x1, y1, margin):
    corners = axes.transData.transform([(x0, y0), (x1, y1)])
    return np.concatenate([corners.min(axis=0) - margin, corners.max(axis=0) + margin])


def _area(box):
    return (box[2] - box[0]) * (box[3] - box[1])


def _common(a, b):
    width = min(a[2], b[2]) - max(a[0], b[0])
    height = min(a[3], b[3]) - max(a[1], b[1])
    return max(width, 0.0) * max(height, 0.0)
