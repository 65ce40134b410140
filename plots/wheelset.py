#!/usr/bin/env python3
"""Draw what `faststrip wheelset` wrote: both wheels on the track with their contacts in one state,
and forces and contact places over the lateral displacement."""

import os
import sys

import numpy as np

from faststrip_plots import command, panels, picture, style
from faststrip_plots.results import revision
from faststrip_plots.tables import InputError, read_table

RESULT = ("case", "side", "contact", "status")
PROFILES = ("case", "body", "side", "y_mm", "z_mm")
LOOKS = {"right": style.NORMAL["strip"], "left": style.NORMAL["hertz"]}
MARKERS = {"right": "o", "left": "s"}
RED = "#c03010"  # contacts and their forces
SMALLEST_VIEW = 12.0  # mm: half the width of a contact's own view
PANELS = (("N_N", "$N$ on the rail, kN", 1e-3), ("Fx_N", "$F_x$ on the rail, kN", 1e-3),
          ("Fs_N", "$F_s$ on the rail, kN", 1e-3),
          ("contact_angle_rad", "contact angle, degrees", np.degrees(1.0)),
          ("y_wheel_mm", "place on the wheel\n$y$, mm", 1.0),
          ("y_rail_mm", "place on the rail\n$y$, mm", 1.0))


def main(arguments=None):
    options = command.options(__doc__, arguments, {
        "result": ("out/wheelset.csv", "what `faststrip wheelset -o` wrote"),
        "profiles": ("out/wheelset_profiles.csv", "what `faststrip wheelset --profiles` wrote"),
        "states": (None, "the states, for y_mm: draws the sweep too")},
        folder=("out", "where wheelset.png and wheelset_sweep.png go"))
    # Solutions beside a state are not drawn.
    result = read_table(options.result, RESULT).where("solution", ("", "1"))
    profiles = read_table(options.profiles, PROFILES)
    figure, note = draw_track(result, profiles)
    picture.save(figure, os.path.join(options.folder, "wheelset.png"),
                 [revision(result), revision(profiles)], note)
    if options.states:
        states = read_table(options.states, ("case", "y_mm"))
        picture.save(draw_sweep(result, states), os.path.join(options.folder, "wheelset_sweep.png"),
                     [revision(result), revision(states)],
                     "lines end where a contact jumps")


def draw_track(result, profiles):
    """The whole track on top, a view of each contact below."""
    name = profiles.words("case")[0]
    outlines = read_outlines(profiles)
    rows = [row for row, case in enumerate(result.words("case"))
            if case == name and result.words("contact")[row] != "0"]
    if not rows:
        raise InputError(f"no contact of the state of the profiles, {name}: {result.path}")
    numbers = {key: result.numbers(key, missing=True) for key in (
        "y_track_mm", "z_track_mm", "contact_angle_rad", "N_N", "Fs_N", "Fx_N", "radius_mm",
        "Fy_track_N", "Fz_track_N", "ymin_mm", "ymax_mm")}
    rows.sort(key=lambda row: numbers["y_track_mm"][row])
    largest = max(numbers["N_N"][row] for row in rows)

    figure = style.new_figure(9.6, 8.0)
    grid = figure.add_gridspec(2, len(rows), height_ratios=(1.0, 1.15))
    whole = figure.add_subplot(grid[0, :])
    draw_wheelset(whole, outlines, rows, numbers)
    for row in rows:
        arrow(whole, numbers, row, 240.0 / largest)
    whole.set_aspect("equal")
    whole.invert_yaxis()
    whole.margins(0.03, 0.06)
    whole.set_title(f"Wheelset on its track, state {name}; forces on the rails")
    for column, row in enumerate(rows):
        axes = figure.add_subplot(grid[1, column])
        draw_contact(axes, result, outlines, row, numbers, largest)
    whole.set(xlabel="$y$ in the track to the right, mm", ylabel="$z$ down, mm")
    return figure, f"arrows: forces on the rails; the largest $N$ is {largest * 1e-3:.1f} kN"


def read_outlines(profiles):
    """Points by side and body, from the centre line outwards."""
    body, side = np.array(profiles.words("body")), np.array(profiles.words("side"))
    points = np.column_stack([profiles.numbers("y_mm"), profiles.numbers("z_mm")])
    return {(s, b): points[(side == s) & (body == b)]
            for s in ("left", "right") for b in ("wheel", "rail")
            if np.any((side == s) & (body == b))}


def draw_wheelset(axes, outlines, rows, numbers):
    """Wheels down from the axle, rails, the axle itself."""
    ends = []
    for side, sign in (("left", -1.0), ("right", 1.0)):
        if (side, "wheel") not in outlines:
            continue
        wheel, rail = outlines[side, "wheel"], outlines[side, "rail"]
        own = [row for row in rows if sign * numbers["y_track_mm"][row] > 0]
        if own:
            height = np.mean([numbers["z_track_mm"][row] - numbers["radius_mm"][row]
                              for row in own])
            ends.append((np.mean(wheel[:, 0]), height))
            axes.fill_between(wheel[:, 0], wheel[:, 1], height, color=panels.PALE, linewidth=0)
        axes.plot(*wheel.T, color="#222222", linewidth=1.4)
        axes.fill_between(rail[:, 0], rail[:, 1], rail[:, 1].max(), color="#d9d9d9", linewidth=0)
        axes.plot(*rail.T, color=style.GREY, linewidth=1.2)
    if len(ends) > 1:
        axes.plot(*np.transpose(ends), color="#222222", linewidth=1.0, linestyle=(0, (8, 3, 2, 3)))


def draw_contact(axes, result, outlines, row, numbers, largest):
    """One contact from near: both outlines, the point, its normal and its force."""
    side = result.words("side")[row]
    y, z = numbers["y_track_mm"][row], numbers["z_track_mm"][row]
    half = SMALLEST_VIEW
    wheel, rail = outlines[side, "wheel"], outlines[side, "rail"]
    axes.fill(*closed(wheel, -1e3).T, color=panels.PALE, linewidth=0)
    axes.fill(*closed(rail, 1e3).T, color="#d9d9d9", linewidth=0)
    axes.plot(*wheel.T, color="#222222", linewidth=1.6, label="wheel")
    axes.plot(*rail.T, color=style.GREY, linewidth=1.6, label="rail")
    turn = numbers["contact_angle_rad"][row]
    normal = 0.55 * half * np.array([np.sin(turn), -np.cos(turn)])
    axes.plot([y - normal[0], y + normal[0]], [z - normal[1], z + normal[1]], color=style.GREY,
              linewidth=1.0, linestyle=(0, (6, 2, 1.5, 2)), label="normal")
    ends = np.array([numbers["ymin_mm"][row], numbers["ymax_mm"][row]])
    axes.plot(y + ends * np.cos(turn), z + ends * np.sin(turn), color=style.PATCH, linewidth=5.0,
              solid_capstyle="butt", zorder=4)
    arrow(axes, numbers, row, 0.75 * half / largest)
    axes.plot(y, z, marker="o", markersize=6, markerfacecolor="white", markeredgecolor=RED,
              markeredgewidth=1.6, zorder=6)
    axes.set(xlim=(y - half, y + half), ylim=(z + half, z - half), aspect="equal",
             xlabel="$y$, mm", ylabel="$z$, mm",
             title=f"{side}, contact {result.words('contact')[row]}")
    told = ["on the rail:"]
    told += [f"${symbol}$ {numbers[name][row] * 1e-3:.1f} kN"
            for symbol, name in (("N", "N_N"), ("F_x", "Fx_N"), ("F_s", "Fs_N"))]
    told += [f"angle {np.degrees(turn):.1f}°", f"patch {np.ptp(ends):.1f} mm wide"]
    # In the body of the wheel, away from its flange's outline.
    where, align = (0.97, "right") if side == "left" else (0.03, "left")
    axes.text(where, 0.98, "\n".join(told).replace("-", "\N{MINUS SIGN}"), ha=align, va="top",
              transform=axes.transAxes, fontsize=style.SMALL)


def closed(line, height):
    """An outline with a far edge, to be filled."""
    return np.vstack([line, [[line[-1, 0], height], [line[0, 0], height]]])


def arrow(axes, numbers, row, scale):
    """The force on the rail in the (y, z) plane, from its point."""
    start = numbers["y_track_mm"][row], numbers["z_track_mm"][row]
    end = (start[0] + scale * numbers["Fy_track_N"][row],
           start[1] + scale * numbers["Fz_track_N"][row])
    axes.annotate("", end, start, zorder=5, arrowprops={
        "arrowstyle": "-|>", "color": RED, "linewidth": 1.8, "shrinkA": 0, "shrinkB": 0})
    axes.update_datalim([end])


def draw_sweep(result, states):
    """Forces and places over y; a gap where there is no contact, and where it jumps."""
    shifts = dict(zip(states.words("case"), states.numbers("y_mm", missing=True)))
    unknown = set(result.words("case")) - set(shifts)
    if unknown:
        raise InputError(f"no such state: {sorted(unknown)[0]} ({states.path})")
    order = sorted(set(shifts.values()))
    y = np.array([shifts[case] for case in result.words("case")])
    side, contact = np.array(result.words("side")), np.array(result.words("contact"))
    limited = np.array(result.words("status")) != "ok"
    ends = np.array([result.numbers("y_wheel_mm", missing=True)
                     + result.numbers(name, missing=True) for name in ("ymin_mm", "ymax_mm")])
    figure = style.new_figure(9.6, 8.4)
    grid = figure.subplots(3, 2, sharex=True)
    for axes, (name, label, scale) in zip(grid.T.flat, PANELS):
        values = scale * result.numbers(name, missing=True)
        axes.axhline(0.0, color="#aaaaaa", linewidth=0.8)
        for which, look in LOOKS.items():
            for number in sorted(set(contact[side == which]) - {"0"}):
                chosen = (side == which) & (contact == number)
                known = dict(zip(y[chosen], zip(values[chosen], *ends[:, chosen])))
                line, *patch = np.transpose([known.get(at, [np.nan] * 3) for at in order])
                axes.plot(*style.broken(apart(*patch), order, line), color=look.colour,
                          marker=MARKERS[which], markersize=3.6, linewidth=1.4,
                          linestyle="-" if number == "1" else ":",
                          markerfacecolor=look.colour if number == "1" else "white",
                          label=f"{which}" if number == "1" else f"{which}, contact {number}")
        marked = limited & np.isfinite(values)
        if np.any(marked):
            axes.plot(y[marked], values[marked], linestyle="none", marker="o", markersize=9,
                      markerfacecolor="none", markeredgecolor=RED, label="status other than ok")
        axes.set_ylabel(label)
    failed = sorted(set(y[(contact == "0") & limited]))
    for axes in grid.flat:
        for at in failed:
            axes.axvline(at, color=RED, linewidth=0.8, linestyle=":", label="no result")
    for axes in grid[-1]:
        axes.set_xlabel("lateral displacement $y$ to the right, mm")
    figure.align_ylabels(grid)
    style.legend_above(figure, *grid.flat)
    return figure


def apart(low, high):
    """Has a patch no place on the wheel in common with the one of the state before? Then the
    contact has jumped."""
    return (low[1:] > high[:-1]) | (high[1:] < low[:-1])


if __name__ == "__main__":
    sys.exit(command.run(main))
