"""Curves of the influence integral and of the published polynomials, by strip distance."""

from __future__ import annotations

import matplotlib
import numpy as np

from . import scales, style
from .results import revision
from .tables import InputError, read_table

COLUMNS = ("n", "L", "b", "exact", "published", "rel_err")
RANGE = (-2.0, 1.0)  # of L, where the published polynomials hold
GROUPS = ((0, 0), (1, 4), (5, 20))  # of strip distances n, as the paper's figures have them
NEAR = {0: "#4a86c8", 1: "#4a86c8", 2: "#a8326e", 3: "#f08519", 4: "#4b8f3c"}
ABSCISSA = r"$L = \log_{10} b$"


class Curve:
    """One strip distance: columns by ascending L."""

    def __init__(self, n, values):
        order = np.argsort(values["L"], kind="stable")
        self.n = n
        for name in COLUMNS[1:]:
            setattr(self, name, values[name][order])
        self.inside = (self.L >= RANGE[0] - 1e-9) & (self.L <= RANGE[1] + 1e-9)


def read_curves(path):
    """The curves by ascending strip distance, and the revision."""
    table = read_table(path, COLUMNS)
    values = {name: (table.positive if name in ("b", "exact") else table.numbers)(name)
              for name in COLUMNS[:4]}
    values.update({name: table.numbers(name, missing=True) for name in COLUMNS[4:]})
    n = values["n"]
    for row in np.flatnonzero((n != np.round(n)) | (n < 0) | (n > 20)):
        raise InputError(
            f"n must be one of 0 to 20, got {n[row]:g} ({path}:{table.lines[row]})"
        )
    curves = [
        Curve(int(n), {name: column[rows] for name, column in values.items()})
        for n, rows in scales.groups(values["n"])
    ]
    for curve in curves:
        if not curve.inside.any():
            raise InputError(
                f"L must have values from {RANGE[0]:g} to {RANGE[1]:g} for n = {curve.n}: {path}"
            )
    return sorted(curves, key=lambda curve: curve.n), revision(table)


def colour_of(n):
    """Own colours for near strips, a colour map from the fifth on."""
    if n in NEAR:
        return NEAR[n]
    return matplotlib.colors.to_hex(matplotlib.colormaps[style.MAP](0.18 + 0.82 * (n - 5) / 15.0))
