#!/usr/bin/env python3
"""Draw wheel and rail in contact at one lateral shift, and the distance between them."""

import sys

import numpy as np

from faststrip_plots import command, panels, style
from faststrip_plots.results import read_gap, read_profiles
from faststrip_plots.tables import InputError

RED = "#c03010"  # the contact point


def main(arguments=None):
    parser = command.parser(__doc__)
    parser.add_argument("--shift", type=float, default=0.0, metavar="MM",
                        help="lateral shift of the wheel, for the title and the default files")
    parser.add_argument("--profiles", metavar="CSV", help="columns body,y_mm,z_mm"
                        " (default: out/profiles_shift_MM.csv)")
    parser.add_argument("--gap", metavar="CSV",
                        help="also draw the gap in the frame of the contact: columns y_mm,h_mm")
    parser.add_argument("--top", type=float, default=1.0, metavar="MM",
                        help="largest distance shown")
    parser.add_argument("-o", "--output", metavar="PNG",
                        help="picture to write (default: out/profiles_shift_MM.png)")
    options = parser.parse_args(arguments)
    path = options.profiles or command.shift_file("profiles", options.shift)
    profiles = read_profiles(path)
    gap = read_gap(options.gap) if options.gap else None

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
    style.title(upper, f"Profiles in contact, lateral shift {style.number(options.shift)} mm"
                " (ring: contact point)")

    lower.axvline(0.0, color=RED, linewidth=1.2, zorder=1)
    lower.plot(y - contact, distance, color="#0b3c78", linewidth=2.0, zorder=3,
               label="vertical, from the profiles")
    near = y[distance <= options.top] - contact
    if gap is not None:
        lower.plot(gap.y, gap.h, color="#f08519", linewidth=1.8, linestyle=(0, (5, 1.8)),
                   zorder=4, label="along the contact normal")
        near = np.concatenate([near, gap.y[gap.h <= options.top]])
        lower.legend(loc="lower right", bbox_to_anchor=(1.0, 0.99), ncols=2, borderaxespad=0.2,
                     handlelength=2.6, columnspacing=1.6)
    lower.set_xlim(near.min() - 1.0, near.max() + 1.0)
    lower.set_ylim(0.0, options.top)
    lower.set_xlabel("lateral distance from the contact point, mm")
    lower.set_ylabel("undeformed distance, mm")
    style.title(lower, "Distance wheel to rail")
    output = options.output or command.shift_file("profiles", options.shift)[:-3] + "png"
    style.save(figure, output, [profiles.stamp, gap and gap.stamp])
    print(output)


if __name__ == "__main__":
    sys.exit(command.run(main))
