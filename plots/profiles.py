#!/usr/bin/env python3
"""Draw wheel and rail in contact at one lateral shift, and the distance between them."""

import sys

import numpy as np

from faststrip_plots import command, panels, picture, style
from faststrip_plots.results import read_gap, read_profiles, read_strips
from faststrip_plots.tables import InputError

RED = "#c03010"  # the contact point


def main(arguments=None):
    options = command.options(
        __doc__, arguments, {
            "profiles": (None, "columns body,y_mm,z_mm (default: out/profiles_shift_MM.csv)"),
            "gap": (None, "also draw the gap in the frame of the contact: columns y_mm,h_mm"),
            "strips": (None, "also mark how wide the patches are: strips of the contact")},
        (None, "PNG", "picture to write (default: out/profiles_shift_MM.png)"),
        more={**command.shift("lateral shift of the wheel, for the title and the default files"),
              "top": dict(type=float, default=1.0, metavar="MM", help="largest distance shown")})
    path = options.profiles or command.shift_file("profiles", options.shift)
    profiles = read_profiles(path)
    gap = read_gap(options.gap) if options.gap else None
    strips = read_strips(options.strips) if options.strips else None

    y, distance = panels.distance(profiles)
    if y[0] >= y[-1]:
        raise InputError(f"wheel and rail do not overlap in y_mm: {path}")
    contact = y[np.argmin(distance)]

    figure = style.new_figure(8.0, 6.4)
    upper, lower = figure.subplots(2, 1, height_ratios=[1.0, 1.0])
    panels.draw_profiles(upper, profiles)
    wheel = profiles.wheel[np.argsort(profiles.wheel[:, 0], kind="stable")]
    point = contact, float(np.interp(contact, wheel[:, 0], wheel[:, 1]))
    upper.plot(*point, marker="o", markersize=9, markerfacecolor="none", markeredgecolor=RED,
               markeredgewidth=1.8, linestyle="none", zorder=5)
    upper.set_title(f"Profiles in contact, lateral shift {style.number(options.shift)} mm"
                " (ring: contact point)")

    lower.axvline(0.0, color=RED, linewidth=1.2, zorder=1)
    lower.plot(y - contact, distance, color="#0b3c78", linewidth=2.0, zorder=3,
               label="vertical, from the profiles")
    near = y[distance <= options.top] - contact
    if gap is not None:
        lower.plot(gap.y, gap.h, color="#f08519", linewidth=1.8, linestyle=(0, (5, 1.8)),
                   zorder=4, label="along the contact normal")
        near = np.concatenate([near, gap.y[gap.h <= options.top]])
    for patch in strips.patches if strips else ():
        style.mark_width(lower, patch.y_left[0], patch.y_right[-1])
    if gap is not None or strips is not None:
        style.legend_above(figure, lower)
    lower.set(xlim=(near.min() - 1.0, near.max() + 1.0), ylim=(0.0, options.top),
              xlabel="lateral distance from the contact point, mm",
              ylabel="undeformed distance, mm", title="Distance wheel to rail")
    output = options.output or command.shift_file("profiles", options.shift)[:-3] + "png"
    picture.save(figure, output, [profiles.stamp, gap and gap.stamp, strips and strips.stamp])


if __name__ == "__main__":
    sys.exit(command.run(main))
