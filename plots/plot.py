#!/usr/bin/env python3
"""Draw one result of the program, for its option --plot."""

import os
import sys

import conicity
import wheelset
from faststrip_plots import command, panels, style
from faststrip_plots.results import (
    NORMAL_QUANTITIES,
    TANGENTIAL_QUANTITIES,
    read_gap,
    read_strips,
    read_sweep,
    revision,
)
from faststrip_plots.tables import InputError, read_table


def main(arguments=None):
    made = command.parser(__doc__)
    made.add_argument("command", choices=PICTURES, help="what wrote the result")
    made.add_argument("folder", help="of what it wrote to be drawn from")
    made.add_argument("file", help="picture, .png, .svg or .pdf; it is whole or as it was")
    told = made.parse_args(arguments)
    name, folder, path = told.command, told.folder, told.file
    ending = os.path.splitext(path)[1].lower()
    unfinished = f"{os.path.splitext(path)[0]}.unfinished_{os.getpid()}{ending}"
    try:
        figure, stamps, note = PICTURES[name](lambda file: os.path.join(folder, file))
        style.save(figure, unfinished, stamps, note)
        os.replace(unfinished, path)
    except OSError as error:
        raise InputError(f"cannot write: {path} ({os.strerror(error.errno)})") from None
    finally:
        if os.path.exists(unfinished):
            os.remove(unfinished)


def draw_contact(file):
    """The gap, the patch, and the pressure across it."""
    table = read_table(file("result.csv"), ("status", "pmax_MPa", "penetration_mm"))
    gap, strips = read_gap(file("gap.csv")), read_strips(file("strips.csv"))
    figure = style.new_figure(7.4, 10.0)
    space, patch, pressure = figure.subplots(3, 1)
    penetration = table.numbers("penetration_mm")[0]
    least = gap.h.min()
    near = gap.y[gap.h <= least + 4.0 * max(penetration, 1e-3)]
    space.plot(gap.y, gap.h, color="#0b3c78", linewidth=2.0, label="undeformed distance")
    space.axhline(penetration, color=style.GREY, linewidth=1.2, label="penetration")
    space.set(xlim=(near.min(), near.max()),
              ylim=(min(least, 0.0), least + 4.0 * max(penetration, 1e-3)),
              xlabel="lateral $y$, mm", ylabel="distance, mm")
    for each in strips.patches:
        style.mark_width(space, each.y_left[0], each.y_right[-1])
    style.legend_above(figure, space)
    space.set_title(words_of(table))
    if strips.patches:
        panels.draw_outlines(patch, strips)
        panels.draw_cut_along_y(pressure, strips)
        for axes in (patch, pressure):
            axes.set_xlim(space.get_xlim())
    patch.set_title("Contact patch")
    pressure.set_title("Pressure on its centre line")
    return figure, [strips.stamp], ""


def words_of(table):
    """What the result is, in one line."""
    figures = []
    for column, symbol, unit in (("N_N", "N", "N"), ("pmax_MPa", "p_\\mathrm{max}", "MPa"),
                                 ("Fx_N", "F_x", "N"), ("Fy_N", "F_y", "N")):
        value = table.numbers(column, missing=True)[0]
        if value == value:
            figures.append(f"${symbol}$ = {style.number(round(value))} {unit}")
    told = f"{table.words('status')[0]}: {', '.join(figures)}"
    return told + " on the rail" if "F_x" in told else told


def draw_sweep(file):
    """All figures over the shift."""
    quantities = NORMAL_QUANTITIES + TANGENTIAL_QUANTITIES
    result = read_sweep(file("result.csv"))
    figure = style.new_figure(9.2, 9.0)
    grid = figure.subplots(3, 2, sharex=True)
    for axes, name in zip(grid.T.flat, quantities):
        panels.draw_value(axes, result, None, name)
    for axes in grid[-1]:
        axes.set_xlabel(panels.SHIFT_LABEL)
    style.legend_above(figure, *grid.flat)
    return figure, [result.stamp], ""


def draw_wheelset(file):
    """Both wheels on the track in one state."""
    result = read_table(file("result.csv"), wheelset.RESULT).where("solution", ("", "1"))
    profiles = read_table(file("profiles.csv"), wheelset.PROFILES)
    figure, note = wheelset.draw_track(result, profiles)
    return figure, [revision(result), revision(profiles)], note


def draw_conicity(file):
    """Geometry over the shift, if there is any, and conicity over the amplitude."""
    functions = None
    if os.path.exists(file("functions.csv")):
        functions = read_table(file("functions.csv"), conicity.FUNCTIONS)
    table = read_table(file("result.csv"), conicity.CONICITY)
    figure, note = conicity.draw(functions, table)
    return figure, [functions and revision(functions), revision(table)], note


PICTURES = {"contact": draw_contact, "sweep": draw_sweep, "wheelset": draw_wheelset,
            "conicity": draw_conicity}


if __name__ == "__main__":
    sys.exit(command.run(main))
