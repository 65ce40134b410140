#!/usr/bin/env python3
"""Draw the overview for the README: outlines, pressure map, maximum pressure and force."""

import sys

from faststrip_plots import command, panels, picture, references, style
from faststrip_plots.results import read_field, read_reference, read_strips, read_sweep


def main(arguments=None):
    options = command.options(
        __doc__, arguments, {**command.STRIPS, **command.FIELDS, **references.FIELD,
                             **command.SWEEP, **references.SWEEP},
        command.png("out/overview.png"), more=command.shift("lateral shift of the upper panels"))
    strips = read_strips(options.strips or command.shift_file("strips", options.shift))
    field = read_field(options.fields or command.shift_file("fields", options.shift))
    contact = references.contact_file(options.contact, options.shift)
    contact = read_field(contact) if contact else None
    sweep = read_sweep(options.sweep)
    reference = read_reference(options.reference)
    command.report_failures(sweep)

    figure = style.new_figure(11.0, 6.8)
    (outlines, pressure), (pmax, force) = figure.subplots(2, 2, height_ratios=[0.72, 1.0])
    panels.draw_outlines(outlines, strips, panels.hertz_ellipse(sweep, options.shift), contact)
    outlines.set_title(f"Contact patch, lateral shift {style.number(options.shift)} mm")
    mappable = panels.draw_strip_pressure(
        pressure, strips, field, max(p.max() for p in field.pressure)
    )
    panels.share_limits(outlines, pressure)
    pressure.set_title("Pressure by strips")
    figure.colorbar(mappable, ax=pressure, label="MPa", shrink=0.8, pad=0.02, panchor=False)
    panels.draw_value(pmax, sweep, reference, "pmax")
    panels.draw_value(force, sweep, reference, "Fx")
    for axes in (pmax, force):
        axes.set_xlabel(panels.SHIFT_LABEL)
    style.legend_above(figure, force)
    picture.save(figure, options.output, [strips.stamp, field.stamp, sweep.stamp])


if __name__ == "__main__":
    sys.exit(command.run(main))
