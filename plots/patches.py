#!/usr/bin/env python3
"""Draw one contact: outlines by strips, Hertz and CONTACT; pressure map and its cuts."""

import sys

from faststrip_plots import command, panels, picture, references, style
from faststrip_plots.results import read_field, read_strips, read_sweep


def main(arguments=None):
    options = command.options(
        __doc__, arguments, {
            **command.STRIPS, **command.FIELDS, **references.FIELD,
            "sweep": (command.SWEEP["sweep"][0], "sweep with the Hertz result of the shift"),
            "norm": (None, "fields of the contact by NORM, for the cuts")},
        more={**command.shift(
                  "lateral shift of the wheel, for titles, row of the sweep and files"),
              "no-contact": dict(action="store_true", help="draw without CONTACT"),
              "outlines": dict(metavar="PNG", help="picture of the outlines (default:"
                               " out/patch_shift_MM.png)"),
              "pressure": dict(metavar="PNG", help="picture of the pressures (default:"
                               " out/pressure_shift_MM.png)")})
    strips = read_strips(options.strips or command.shift_file("strips", options.shift))
    field = read_field(options.fields or command.shift_file("fields", options.shift))
    sweep = read_sweep(options.sweep)
    contact = references.contact_file(options.contact, options.shift)
    contact = read_field(contact) if contact and not options.no_contact else None
    norm = read_field(options.norm) if options.norm else None
    ellipse = panels.hertz_ellipse(sweep, options.shift)
    if ellipse is None:
        print(f"no Hertz result at shift {options.shift:g}: drawn without ({options.sweep})")
    # both are drawn before either is written: bad input leaves no picture behind
    pictures = {
        options.outlines or command.shift_file("patch", options.shift)[:-3] + "png":
            outline_figure(options.shift, strips, ellipse, contact),
        options.pressure or command.shift_file("pressure", options.shift)[:-3] + "png":
            pressure_figure(options.shift, strips, field, ellipse, contact, norm),
    }
    for path, figure in pictures.items():
        picture.save(figure, path, [strips.stamp, field.stamp, sweep.stamp])


def outline_figure(shift, strips, ellipse, contact):
    """The outlines, one panel."""
    figure = style.new_figure(8.0, 5.4)
    axes = figure.subplots()
    panels.draw_outlines(axes, strips, ellipse, contact)
    axes.set_title(f"Contact patch, lateral shift {style.number(shift)} mm")
    style.fit_panel(figure, axes, 7.4, 5.4)
    style.legend_above(figure, axes)
    return figure


def pressure_figure(shift, strips, field, ellipse, contact, norm=None):
    """Maps above, cuts below."""
    top = max(p.max() for source in (field, contact) if source for p in source.pressure)
    figure = style.new_figure(11.0, 7.4)
    (left, right), (along_y, along_x) = figure.subplots(2, 2)
    mappable = panels.draw_strip_pressure(left, strips, field, top)
    left.set_title(f"Strips: pressure, lateral shift {style.number(shift)} mm")
    if contact is None:
        panels.draw_outlines(right, strips, ellipse)
        right.set_title("Outlines")
    else:
        panels.draw_grid_pressure(right, contact, top)
        right.set_title("CONTACT: pressure")
    panels.share_limits(left, right)
    figure.colorbar(mappable, ax=[left, right], label="pressure, MPa", shrink=0.9, pad=0.015,
                    panchor=False)
    panels.draw_cut_along_y(along_y, strips, ellipse, contact, norm)
    along_y.set_title("Cut along $y$ at $x$ = 0")
    y = panels.draw_cut_along_x(along_x, strips, field, ellipse, contact, norm)
    where = style.number(round(y, 2))
    along_x.set_title(f"Cut along $x$ at $y$ = {where} mm, the strongest strip")
    style.legend_above(figure, along_y, along_x)
    return figure


if __name__ == "__main__":
    sys.exit(command.run(main))
