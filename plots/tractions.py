#!/usr/bin/env python3
"""Draw tractions of one contact with the boundary of stick and slip, beside CONTACT's."""

import sys

import numpy as np
from matplotlib.colors import ListedColormap

from faststrip_plots import command, picture, references, style
from faststrip_plots.results import revision
from faststrip_plots.tables import InputError, read_table

COLUMNS = ("x_mm", "y_mm", "state", "pn_MPa", "px_MPa", "py_MPa")
STICK = 1
ARROWS = 26  # across the longer side


def main(arguments=None):
    options = command.options(
        __doc__, arguments, {**command.FIELDS, **references.FIELD},
        (None, "PNG", "picture to write (default: out/tractions_shift_MM.png)"),
        more=command.shift("lateral shift of the wheel, for titles and files"))
    own = read_table(options.fields or command.shift_file("fields", options.shift), COLUMNS)
    path = references.contact_file(options.contact, options.shift)
    if path is None:
        raise InputError(f"no field by CONTACT for the shift {options.shift:g} mm")
    exact = read_table(path, COLUMNS)
    output = options.output or f"out/tractions_shift_{options.shift:g}.png"
    figure = style.new_figure(11.2, 6.6)
    panels = figure.subplots(2, 2, sharex=True, sharey=True)
    fields = [Field(own), Field(exact)]
    largest = max(field.size.max() for field in fields)
    for column, (field, name) in enumerate(zip(fields, ("strips + FASTSTRIP", "CONTACT"))):
        mesh = draw_traction(panels[0][column], field, largest)
        draw_state(panels[1][column], field)
        panels[0][column].set_title(f"{name}: traction on the rail")
        panels[1][column].set_title(f"{name}: stick dark, slip light")
    for axes in panels[1]:
        axes.set_xlabel("$y$, mm")
    for axes in panels[:, 0]:
        axes.set_ylabel("$x$ (rolling), mm")
    for axes in panels.flat:
        axes.set_aspect("equal")
    figure.colorbar(mesh, ax=panels, label="size of the traction, MPa", shrink=0.6)
    picture.save(figure, output, [revision(own)],
                 f"lateral shift {style.number(options.shift)} mm")


class Field:
    """Elements of a contact, row by row."""

    def __init__(self, table):
        self.x, self.y, self.state, self.pn, self.px, self.py = (
            table.numbers(name) for name in COLUMNS
        )
        keep = self.pn > 0.0
        if not keep.any():
            raise InputError(f"no element under pressure ({table.path})")
        for name in ("x", "y", "state", "pn", "px", "py"):
            setattr(self, name, getattr(self, name)[keep])
        self.size = np.hypot(self.px, self.py)

    def cells(self):
        """Corners of the elements: half way between their middles, in each row of its own."""
        for y in np.unique(self.y):
            row = np.flatnonzero(self.y == y)
            yield y, row[np.argsort(self.x[row])]


def rectangles(axes, field, values, **look):
    """Draw every element as the rectangle it stands for."""
    rows = list(field.cells())
    middles = np.array([y for y, _ in rows])
    between = 0.5 * (middles[1:] + middles[:-1])
    edges = np.concatenate(([1.5 * middles[0] - 0.5 * middles[1]], between,
                            [1.5 * middles[-1] - 0.5 * middles[-2]]))
    mesh = None
    for (_, row), low, high in zip(rows, edges[:-1], edges[1:]):
        x = field.x[row]
        step = x[1] - x[0] if len(x) > 1 else high - low
        corners = np.concatenate((x - 0.5 * step, [x[-1] + 0.5 * step]))
        mesh = axes.pcolormesh([low, high], corners, values[row][:, None], rasterized=True, **look)
    return mesh


def draw_traction(axes, field, largest):
    mesh = rectangles(axes, field, field.size, cmap=style.MAP, vmin=0.0, vmax=largest)
    extent = max(np.ptp(field.x), np.ptp(field.y)) / ARROWS
    seen = set()
    chosen = []
    for i in np.lexsort((field.x, field.y)):
        place = (round(field.x[i] / extent), round(field.y[i] / extent))
        if place not in seen and field.size[i] > 0.0:
            seen.add(place)
            chosen.append(i)
    size = np.maximum(field.size[chosen], 1e-30)
    axes.quiver(field.y[chosen], field.x[chosen], field.py[chosen] / size, field.px[chosen] / size,
                angles="xy", scale_units="xy", scale=1.2 / extent, width=0.0022, color="black",
                pivot="mid")
    return mesh


def draw_state(axes, field):
    rectangles(axes, field, (field.state == STICK).astype(float), vmin=0.0, vmax=1.0,
               cmap=ListedColormap(["#f3c98b", "#0b3c78"]))


if __name__ == "__main__":
    sys.exit(command.run(main))
