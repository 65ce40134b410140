"""From strips and elements to what is drawn of them: rectangles, borders, arrows."""

from __future__ import annotations

import math
from typing import Dict, Tuple

import numpy as np
import numpy.typing as npt

from .._results import Elements, Result, Strips

Array = npt.NDArray[np.float64]
Columns = Dict[str, Array]
ADHESION = 1
ELLIPSE_POINTS = 121
EMPTY = np.empty(0)


def runs(elements: Elements) -> Columns:
    """Elements of one state that follow each other along x, as rectangles: ``left``, ``right`` in
    y, ``bottom``, ``top`` in x, mm; ``state``."""
    if len(elements.x) == 0:
        return {name: EMPTY for name in ("left", "right", "bottom", "top", "state")}
    order = np.lexsort((elements.x, elements.y))
    x, y, area, state = (getattr(elements, name)[order] for name in ("x", "y", "area", "state"))
    dx = _spacing(x, y, area)
    dy = area / dx
    ends = (np.diff(y) != 0.0) | (np.diff(state) != 0) | (np.diff(x) > 1.5 * dx[:-1])
    first = np.concatenate([[0], np.flatnonzero(ends) + 1])
    last = np.concatenate([first[1:], [len(x)]]) - 1
    return {"left": y[first] - 0.5 * dy[first], "right": y[first] + 0.5 * dy[first],
            "bottom": x[first] - 0.5 * dx[first], "top": x[last] + 0.5 * dx[last],
            "state": state[first].astype(float)}


def _spacing(x: Array, y: Array, area: Array) -> Array:
    """How far the elements of a row are from each other; they come row by row."""
    row = np.concatenate([[0], np.cumsum(np.diff(y) != 0.0)])
    steps = np.where(np.diff(row) == 0, np.diff(x), np.inf)
    least = np.full(row[-1] + 1, np.inf)
    np.minimum.at(least, row[:-1], steps)
    return np.where(np.isfinite(least[row]), least[row], np.sqrt(area))


def borders(rectangles: Columns) -> Columns:
    """Where adhesion and slip meet in a row: ``x0``, ``x1`` in y and ``y0``, ``y1`` in x, mm."""
    left, right, bottom, top, state = (rectangles[name] for name in (
        "left", "right", "bottom", "top", "state"))
    tie = 1e-6 * (1.0 + np.abs(top[:-1]))
    meet = ((left[1:] == left[:-1]) & (state[1:] != state[:-1])
            & (np.abs(bottom[1:] - top[:-1]) < tie))
    at = 0.5 * (bottom[1:] + top[:-1])[meet]
    return {"x0": left[:-1][meet], "x1": right[:-1][meet], "y0": at, "y1": at}


def arrows(elements: Elements, longest: float, length: float,
           pixel: Tuple[float, float]) -> Columns:
    """Tractions as arrows: a traction of ``longest`` (MPa) is ``length`` pixels long, a pixel being
    so wide and high (mm). Shafts ``x0``, ``x1`` in y and ``y0``, ``y1`` in x; ``angle`` of the
    head, rad."""
    names = "x0", "x1", "y0", "y1", "angle"
    if len(elements.x) == 0 or not longest > 0.0:
        return {name: EMPTY for name in names}
    keep = _thinned(elements, 0.6 * length * pixel[0], 0.6 * length * pixel[1])
    x, y, px, py = (getattr(elements, name)[keep] for name in ("x", "y", "px", "py"))
    there = np.hypot(px, py) > 0.02 * longest
    x, y, px, py = (values[there] for values in (x, y, px, py))
    wide, high = (0.5 * length / longest * side for side in pixel)
    return {"x0": y - wide * py, "x1": y + wide * py, "y0": x - high * px, "y1": x + high * px,
            "angle": np.arctan2(px, py) - 0.5 * math.pi}


def _thinned(elements: Elements, across: float, along: float) -> npt.NDArray[np.bool_]:
    """Of many rows and columns some, about so far from each other."""
    order = np.lexsort((elements.x, elements.y))
    x, y, area = (getattr(elements, name)[order] for name in ("x", "y", "area"))
    starts = np.concatenate([[True], np.diff(y) != 0.0])
    row = np.cumsum(starts) - 1
    column = np.arange(len(y)) - np.flatnonzero(starts)[row]
    dx = _spacing(x, y, area)
    rows = max(1, round(across / float(np.median((area / dx)[starts]))))
    columns = np.maximum(1, np.round(along / dx).astype(int))
    keep = np.zeros(len(y), dtype=bool)
    keep[order] = (row % rows == rows // 2) & (column % columns == columns // 2)
    return keep


def bars(strips: Strips) -> Columns:
    """The strips: ``left``, ``right`` in y, ``bottom``, ``top`` in x, mm; ``p0``, MPa; ``y``."""
    return {"left": strips.y_left, "right": strips.y_right, "bottom": -strips.half_length,
            "top": strips.half_length, "p0": strips.p0,
            "y": 0.5 * (strips.y_left + strips.y_right)}


def ellipse(result: Result) -> Tuple[Columns, Columns]:
    """Outline of the Hertz ellipse, ``y`` and ``x``, mm, and its pressure, ``y`` and ``p``, MPa."""
    angle = np.linspace(0.0, 2.0 * math.pi, ELLIPSE_POINTS)
    middle, half = 0.5 * (result.y_min + result.y_max), 0.5 * (result.y_max - result.y_min)
    upper = angle[:ELLIPSE_POINTS // 2 + 1]
    return ({"y": middle + half * np.cos(angle), "x": result.x_max * np.sin(angle)},
            {"y": middle + half * np.cos(upper), "p": result.pmax * np.sin(upper)})


def pressure_line(strips: Strips) -> Columns:
    """Pressure of the strips over y, with nothing between patches: ``y``, mm, ``p``, MPa."""
    y, p = [], []
    for patch in np.unique(strips.patch):
        of = strips.patch == patch
        y += [strips.y_left[of][:1], 0.5 * (strips.y_left[of] + strips.y_right[of]),
              strips.y_right[of][-1:], [math.nan]]
        p += [[0.0], strips.p0[of], [0.0], [math.nan]]
    return {"y": np.concatenate(y), "p": np.concatenate(p)}
