#!/usr/bin/env python3
"""Draw how good a lookup table is: its forces along lines of creepage beside direct solutions, and
how often its errors on fresh contacts are how large."""

import sys

import numpy as np

from faststrip_plots import command, picture, style

STATE = ("a_mm", "b_mm", "N_N", "mu", "cksi", "cphi_rad_per_mm")
DIRECT = ("Fx_N", "Fy_N", "Mz_Nmm")
LINEAR = ("Fx_linear_N", "Fy_linear_N", "Mz_linear_Nmm")
CUBIC = ("Fx_cubic_N", "Fy_cubic_N", "Mz_cubic_Nmm")
COLUMNS = (*STATE, *DIRECT, *LINEAR, *CUBIC)
NAMES = ("$F_x/(\\mu\\cdot N)$", "$F_y/(\\mu\\cdot N)$", "$M_z/(\\mu\\cdot N c)$")
LOOKS = tuple(style.METHOD[key] for key in (("strip", "faststrip"), ("hertz", "fastsim"),
                                            ("norm", "tang")))


def forces(table, names):
    """Three forces over mu N and mu N c."""
    bound = table.numbers("mu") * table.numbers("N_N")
    size = np.sqrt(table.numbers("a_mm") * table.numbers("b_mm"))
    return [table.numbers(name) / bound / (size if name.startswith("Mz") else 1.0)
            for name in names]


@picture.command(
    __doc__, "lookup.png", folder="out/lookup",
    lines=("out/lookup/lines.csv", "what `faststrip lookup test --states --contacts` wrote",
           COLUMNS),
    contacts=("out/lookup/contacts.csv", "what `faststrip lookup test --contacts` wrote", COLUMNS))
def main(lines, contacts):
    """Three panels of forces, one of errors."""
    figure = style.new_figure(9.6, 7.6)
    panels = figure.subplots(2, 2)
    ratio = np.round(lines.numbers("a_mm") / lines.numbers("b_mm"), 6)
    for axes, name, direct, linear in zip(panels.flat, NAMES, forces(lines, DIRECT),
                                          forces(lines, LINEAR)):
        for one, look in zip(np.unique(ratio), LOOKS):
            here = ratio == one
            creepage = 1e3 * lines.numbers("cksi")[here]
            axes.plot(creepage, linear[here], color=look.colour, linewidth=1.6,
                      label=f"$a/b$ = {one:g}")
            axes.plot(creepage[::4], direct[here][::4], linestyle="none", marker="o",
                      markersize=3.6, markerfacecolor="none", markeredgecolor=look.colour)
        axes.set(xlabel="longitudinal creepage in 0.1 %", ylabel=name)
    panels.flat[0].set_title("lines: looked up linearly; circles: solved")
    panels.flat[0].legend()
    axes = panels.flat[3]
    share = 100.0 * (1.0 - np.arange(contacts.numbers("mu").size) / contacts.numbers("mu").size)
    for found, line in ((forces(contacts, LINEAR), "-"), (forces(contacts, CUBIC), ":")):
        for one, other, name, look in zip(found, forces(contacts, DIRECT), NAMES, LOOKS):
            axes.loglog(100.0 * np.sort(np.maximum(abs(one - other), 1e-9)), share,
                        color=look.colour, linestyle=line,
                        label=f"{name}, {'linear' if line == '-' else 'cubic'}")
    axes.axhline(1.0, color=style.GREY, linewidth=0.8)
    axes.set(xlim=(1e-3, None), xlabel="error in %", ylabel="fresh contacts with a larger one, %",
             title=f"{share.size} fresh contacts")
    axes.legend(fontsize=style.SMALL)
    return figure, ""


if __name__ == "__main__":
    sys.exit(command.run(main))
