#!/usr/bin/env python3
"""Draw sections through the stresses below a contact: along the rolling direction and across it,
through the point that bears most."""

import sys

import numpy as np

from faststrip_plots import command, picture, style
from faststrip_plots.tables import InputError

COLUMNS = ("x_mm", "y_mm", "z_mm", "von_mises_MPa")
LINES = 9  # of equal stress


def section(x, z, values, path):
    """A grid of the points of one section, which has a value at each."""
    across, depths = np.unique(x), np.unique(z)
    if min(len(across), len(depths)) < 2 or len(values) != len(across) * len(depths):
        raise InputError(f"a section needs a grid of points, got {len(across)} by {len(depths)}"
                         f" places with {len(values)} values: {path}")
    return across, depths, values[np.lexsort((x, z))].reshape(len(depths), len(across))


def rounded(value):
    """A number for people."""
    return style.number(float(f"{value:.3g}"))


def draw(axes, grid, levels, peak):
    """One section, depth downwards, with lines of equal stress and the largest."""
    drawn = axes.contourf(*grid, levels=levels, cmap=style.MAP)
    axes.contour(*grid, levels=levels, colors="white", linewidths=0.4)
    axes.plot(*peak, marker="+", color="black", markersize=10, clip_on=False)
    axes.set_aspect("equal")
    return drawn


@picture.command(
    __doc__, "out/subsurface.png",
    below=("out/below.csv", "what `faststrip contact --below` wrote", COLUMNS))
def main(table):
    """A panel a section, on one scale."""
    x, y, z, stress = (table.numbers(name) for name in COLUMNS)
    at = np.argmax(stress)
    levels = np.linspace(0.0, stress[at], LINES + 1)
    if not stress[at] > 0.0:
        raise InputError(f"no stress in {table.path}")
    figure = style.new_figure(9.2, 4.4)
    panels = figure.subplots(1, 2, sharey=True, width_ratios=(np.ptp(x), np.ptp(y)))
    for axes, (along, other, name) in zip(panels, ((x, y, "x (rolling)"), (y, x, "y"))):
        inside = other == other[at]
        drawn = draw(axes, section(along[inside], z[inside], stress[inside], table.path), levels,
                     (along[at], z[at]))
        fixed = "y" if along is x else "x"
        axes.set(xlabel=f"${name[0]}${name[1:]}, mm",
                 title=f"Section at ${fixed}$ = {rounded(other[at])} mm")
    panels[0].set_ylabel("depth $z$, mm")
    panels[0].invert_yaxis()
    figure.colorbar(drawn, ax=panels, label="von Mises stress, MPa", shrink=0.7, format="%.0f")
    return figure, f"largest {rounded(stress[at])} MPa at depth {rounded(z[at])} mm"


if __name__ == "__main__":
    sys.exit(command.run(main))
