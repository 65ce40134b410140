#!/usr/bin/env python3
"""Draw wear beneath both profiles: what `faststrip wheelset --strips` wrote with a wear law, over
the lateral place on the body it wears; without a law T gamma over the area."""

import sys

import matplotlib
import numpy as np

from faststrip_plots import command, picture, style
from faststrip_plots.tables import InputError

STRIPS = ("case", "side", "contact", "y_left_mm", "y_right_mm", "y_rail_mm", "y_wheel_mm",
          "t_gamma_per_area_N_per_mm2", "wear_depth_mm_per_pass", "wear_depth_mm_per_km")
PROFILES = ("body", "side", "y_mm", "z_mm", "y_profile_mm", "z_profile_mm")
# Column, label, factor to its unit; the first that is there is drawn.
QUANTITIES = (("wear_depth_mm_per_km", "wear depth, µm per km", 1e3),
              ("wear_depth_mm_per_pass", "wear depth, nm per pass", 1e6),
              ("t_gamma_per_area_N_per_mm2", "$T\\gamma/A$, N/mm²", 1.0))
MOST_NAMES = 6  # states told apart by a legend


def worn_body(strips):
    """The body the comments name."""
    return "rail" if any(line.startswith("wear of the rail") for line in strips.comments) \
        else "wheel"


def quantity(strips):
    """The first quantity that any strip has."""
    for name, label, factor in QUANTITIES:
        values = factor * strips.numbers(name, missing=True)
        if np.any(np.isfinite(values)):
            return values, label
    raise InputError(f"no strip has wear or T gamma: {strips.path}")


@picture.command(
    __doc__, "out/wear.png",
    strips=("out/wheelset_strips.csv", "what `faststrip wheelset --strips` wrote", STRIPS),
    profiles=("out/wheelset_profiles.csv", "what `faststrip wheelset --profiles` wrote", PROFILES),
    more={"body": dict(choices=("wheel", "rail"), help="over whose profile (default: the one the"
                       " law wears, or the wheel)")})
def main(strips, profiles, body):
    """A column for each side: profiles above, wear beneath."""
    body = body or worn_body(strips)
    values, label = quantity(strips)
    case, side = np.array(strips.words("case")), np.array(strips.words("side"))
    contact = np.array(strips.words("contact"))
    place = strips.numbers(f"y_{body}_mm")
    width = strips.numbers("y_right_mm") - strips.numbers("y_left_mm")
    sides = [name for name in ("left", "right") if name in profiles.words("side")]
    cases = list(dict.fromkeys(case))
    colours = matplotlib.colormaps[style.MAP](np.linspace(0.15, 1.0, len(cases)))
    figure = style.new_figure(max(6.4, 5.0 * len(sides)), 6.8)
    grid = figure.subplots(2, len(sides), squeeze=False, sharex="col", sharey="row")
    for axes in grid[0]:
        axes.set_aspect("equal")
    for column, name in enumerate(sides):
        upper, lower = grid[:, column]
        draw_profiles(upper, profiles, name, body)
        upper.set_title(f"{name} wheel and rail")
        for colour, state in zip(colours, cases):
            for number in sorted(set(contact[(case == state) & (side == name)])):
                own = (case == state) & (side == name) & (contact == number)
                lower.stairs(*steps(place[own], width[own], values[own]), color=colour,
                             linewidth=1.5, label=f"state {state}")
        near = place[side == name]
        if len(near):
            middle, half = 0.5 * (near.min() + near.max()), 0.5 * np.ptp(near) + 8.0
            lower.set_xlim(middle - half, middle + half)
        lower.set_xlabel(f"$y$ on the profile of the {body}, mm")
    low, high = shown_heights(grid[0])
    grid[0, 0].set(ylim=(high, low), ylabel="$z$ down, mm")
    grid[1, 0].set(ylabel=label, ylim=(0.0, None))
    grid[1, 0].invert_yaxis()
    grid[0, -1].legend(loc="best")
    if 1 < len(cases) <= MOST_NAMES:
        style.legend_above(figure, *grid[1])
    return figure, ("" if len(cases) <= MOST_NAMES else
                    f"states from {cases[0]}, light, to {cases[-1]}, dark")


def draw_profiles(axes, profiles, side, body):
    """Both outlines, turned with the track so that the body's profile is as it was given."""
    bodies, sides = np.array(profiles.words("body")), np.array(profiles.words("side"))
    track = profiles.numbers("y_mm") + 1j * profiles.numbers("z_mm")
    given = profiles.numbers("y_profile_mm") + 1j * profiles.numbers("z_profile_mm")
    own = (bodies == body) & (sides == side)
    turn, shift = np.polyfit(track[own], given[own], 1)
    for name, colour in (("wheel", "#222222"), ("rail", style.GREY)):
        chosen = (bodies == name) & (sides == side)
        line = given[chosen] if name == body else turn * track[chosen] + shift
        axes.plot(line.real, line.imag, color=colour, linewidth=1.6, label=name)


def shown_heights(row):
    """Heights of the outlines within the limits along y, with room."""
    heights = [z for axes in row for line in axes.lines
               for y, z in zip(*line.get_data()) if axes.get_xlim()[0] <= y <= axes.get_xlim()[1]]
    room = 0.06 * (max(heights) - min(heights)) + 1.0
    return min(heights) - room, max(heights) + room


def steps(place, width, values):
    """Values and edges of steps about places: between two strips the edge is between them."""
    order = np.argsort(place)
    place, width, values = place[order], width[order], values[order]
    inner = 0.5 * (place[1:] + place[:-1])
    edges = np.concatenate([[place[0] - 0.5 * width[0]], inner, [place[-1] + 0.5 * width[-1]]])
    return values, edges


if __name__ == "__main__":
    sys.exit(command.run(main))
