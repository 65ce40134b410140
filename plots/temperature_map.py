#!/usr/bin/env python3
"""Draw the temperature of the surfaces in a contact, from what `faststrip contact --fields` wrote
of a case with &thermal: a map, and along x the row where it is hottest."""

import sys

import numpy as np

from faststrip_plots import command, picture, style
from faststrip_plots.tables import InputError
from tractions import COLUMNS, Field, rectangles

SURFACES = ("surface_wheel_C", "surface_rail_C")


@picture.command(
    __doc__, "out/temperature_map.png",
    fields=("out/fields.csv", "what `faststrip contact --fields` wrote", COLUMNS + SURFACES))
def main(fields):
    """The map on the left, the hottest row on the right."""
    pressure = fields.numbers("pn_MPa")
    hot = fields.numbers(SURFACES[0], missing=True)[pressure > 0.0]
    if not np.isfinite(hot).all():
        raise InputError(f"elements have no temperatures, without &thermal: {fields.path}")
    field = Field(fields)
    figure = style.new_figure(10.4, 4.8)
    flat, along = figure.subplots(1, 2, sharey=True)
    mesh = rectangles(flat, field, hot, cmap=style.MAP, vmin=hot.min(), vmax=hot.max())
    flat.set(aspect="equal", xlabel="$y$, mm", ylabel="$x$ (rolling), mm",
             title="temperature of both surfaces")
    figure.colorbar(mesh, ax=flat, label="°C")
    row = field.y == field.y[hot.argmax()]
    order = np.argsort(field.x[row])
    along.plot(hot[row][order], field.x[row][order], color="#222222")
    along.set(xlabel=f"temperature at $y$ = {field.y[hot.argmax()]:.1f} mm, °C",
              title="the hottest row")
    return figure, f"hottest: {hot.max():.0f} °C"


if __name__ == "__main__":
    sys.exit(command.run(main))
