#!/usr/bin/env python3
"""Draw creep forces of all tangential methods beside CONTACT's, and their errors against time."""

import sys

import numpy as np

from faststrip_plots import command, picture, style
from faststrip_plots.results import revision
from faststrip_plots.tables import InputError, read_table

METHODS = {
    "faststrip": style.Look("FASTSTRIP", "#0b3c78", "-", 2.2),
    "faststrip-plain": style.Look("FASTSTRIP, plain", "#5b8bd0", (0, (3, 1.2)), 1.7),
    "faststrip-paper": style.Look("FASTSTRIP as printed", "#111111", (0, (1.2, 1.2)), 1.5),
    "faststrip-corrected": style.Look(
        "FASTSTRIP corrected", "#57c7a8", (0, (3, 1, 1, 1, 1, 1)), 1.8
    ),
    "fastsim": style.Look("FASTSIM", "#a8326e", (0, (6, 1.6, 1.2, 1.6)), 1.6),
    "fastsim-elliptic": style.Look("FASTSIM elliptic", "#d98bb5", (0, (4, 1.5)), 1.4),
    "fastsim-weighted": style.Look("FASTSIM weighted", "#8a6fc0", (0, (2, 1)), 1.4),
    "she": style.Look("Shen-Hedrick-Elkins", "#f08519", (0, (5, 1.8)), 1.5),
    "polach": style.Look("Polach", "#4b8f3c", (0, (1, 1)), 1.5),
    "linear": style.Look("linear", "#8a8a8a", (0, (8, 2)), 1.1),
}
MARKERS = dict(zip(METHODS, "o*sD^v<>Px"))
ERRORS = ("Fx_err", "Fy_err", "force_err", "Mz_err")
RATIOS = (0.2, 1.0, 5.0)  # a/b of the panels
STRIPS = 15  # of the times
LEGEND = {"length": 3.0, "spacing": 1.6}
TOP = 1.12  # forces over mu N beyond which a panel ends


def main(arguments=None):
    pictures = {"curves": ("creep_forces", "the creep force curves"),
                "shifts": ("shift_forces", "the forces over the lateral shift"),
                "trade": ("error_time", "error against time")}
    options = command.options(
        __doc__, arguments, {
            "forces": ("out/forces/forces.csv", "what `faststrip-lab bench forces` wrote"),
            "times": ("out/forces/bench_tangential.csv",
                      "what `faststrip-lab bench tangential` wrote")},
        more={"contacts": dict(default="reference/contact", metavar="FOLDER",
                               help="CONTACT's results"),
              **{name: dict(default=f"out/forces/{file}.png", metavar="PNG",
                            help=f"picture of {words} to write")
                 for name, (file, words) in pictures.items()}})
    table = read_table(options.forces, ("set", "group", "case", "method", *ERRORS))
    errors = Errors(table)
    stamp = [revision(table)]
    for path, figure, note in (
        (options.curves, curves_figure(errors, options.contacts),
         "Hertz contacts, 124 elements across by CONTACT"),
        (options.shifts, shifts_figure(errors, options.contacts), "creepages of sign set B"),
        (options.trade, trade_figure(errors, options.times),
         "processor time with 15 by 15 elements; FASTSIM's errors with 50 by 50"),
    ):
        picture.save(figure, path, stamp, note)


class Errors:
    """Errors by set, group, case and method."""

    def __init__(self, table):
        self.path = table.path
        self.keys = list(zip(table.words("set"), table.words("group"), table.words("method")))
        self.case = table.numbers("case").astype(int)
        self.values = {name: table.numbers(name) for name in ERRORS}
        unknown = sorted({method for _, _, method in self.keys} - set(METHODS))
        if unknown:
            raise InputError(f"unknown method: {unknown[0]} ({self.path})")

    def select(self, name, method, group=None):
        """Rows of a set and a method, as case numbers and errors."""
        rows = [i for i, key in enumerate(self.keys)
                if key[0] == name and key[2] == method and group in (None, key[1])]
        if not rows:
            raise InputError(f"no rows of {name} by {method} ({self.path})")
        return self.case[rows], {key: column[rows] for key, column in self.values.items()}


def curves_figure(errors, folder):
    """Forces against creepage on ellipses: slip along x above, spin below."""
    names = ("case", "a_over_b", "u", "mu", "N", "Fx_extrap", "Fy_extrap", "Mz_extrap", "cksi",
             "cphi")
    table = read_table(f"{folder}/hertz_creep.csv", names)
    kind = np.array(table.words("case"))
    value = {name: table.numbers(name) for name in names[1:]}
    bound = value["mu"] * value["N"]
    figure = style.new_figure(11.0, 9.4)
    panels = figure.subplots(3, 3, sharex=True)
    rows = (("long", "Fx", "$-F_x/(\\mu\\cdot N)$", 1.0),
            ("spin", "Fy", "$-F_y/(\\mu\\cdot N)$", 1.0),
            ("spin", "Mz", "$-M_z/(\\mu\\cdot N c)$", 6.0))
    for line, (group, quantity, label, arm) in zip(panels, rows):
        for axes, ratio in zip(line, RATIOS):
            chosen = np.flatnonzero((kind == group) & np.isclose(value["a_over_b"], ratio))
            if chosen.size == 0:
                raise InputError(f"no {group} cases with a/b = {ratio:g} ({table.path})")
            chosen = chosen[np.argsort(value["u"][chosen])]
            u = value["u"][chosen]
            exact = value[f"{quantity}_extrap"][chosen] / (bound[chosen] * arm)
            for method, look in METHODS.items():
                case, error = errors.select("hertz", method, group)
                place = {number - 1: i for i, number in enumerate(case)}
                off = np.array([error[f"{quantity}_err"][place[i]] for i in chosen]) / 100.0
                axes.plot(u, -(exact + off), **look.line_style, zorder=3)
            axes.plot(u, -exact, zorder=6, **style.CONTACT)
            axes.set(title=f"{'slip along x' if group == 'long' else 'spin'},"
                           f" $a/b$ = {ratio:g}", xlim=(0.0, 3.1),
                     ylim=(0.0, TOP if quantity != "Mz" else 1.25 * max(-exact[u <= 3.0])))
        line[0].set_ylabel(label)
    panels[-1][1].set_xlabel("creepage over that of saturation by the linear theory")
    style.legend_above(figure, panels[0][0], **LEGEND)
    return figure


def shifts_figure(errors, folder):
    """Errors over the lateral shift on the paper's contacts."""
    table = read_table(f"{folder}/s1002_uic60_B.csv", ("yw_mm",))
    shift = table.numbers("yw_mm")
    order = np.argsort(shift)
    figure = style.new_figure(9.6, 8.4)
    panels = figure.subplots(3, 1, sharex=True)
    for axes, name, label in zip(panels, ("Fx_err", "Fy_err", "Mz_err"),
                                 ("$F_x$, % of $\\mu\\cdot N$", "$F_y$, % of $\\mu\\cdot N$",
                                  "$M_z$, % of $\\mu\\cdot N c$")):
        for method, look in METHODS.items():
            case, error = errors.select("s1002_uic60_B", method)
            if len(case) != len(shift):
                raise InputError(f"{len(case)} cases by {method}, not {len(shift)} ({errors.path})")
            axes.plot(shift[order], error[name][order], **look.line_style,
                      marker="." if look.width > 2 else None)
        axes.set(ylim=(-14.0, 14.0), ylabel=label,
                 title=f"Error of {label.split(',')[0]} against CONTACT")
    panels[-1].set_xlabel("lateral shift of the wheel, mm")
    style.legend_above(figure, panels[0], **LEGEND)
    return figure


def trade_figure(errors, path):
    """Mean error of the force vector against time, one panel a set."""
    table = read_table(path, ("method", "strips", "us", "elements"))
    methods = np.array(table.words("method"))
    strips = table.numbers("strips")
    time = table.numbers("us")
    sets = (("s1002_uic60_B", "20 contacts of S1002 on UIC60"), ("hertz", "161 ellipses"),
            ("scenes", "240 contacts of many kinds"))
    figure = style.new_figure(11.6, 4.6)
    for axes, (name, heading) in zip(figure.subplots(1, 3, sharey=True), sets):
        for method, look in METHODS.items():
            chosen = (methods == method) & (strips == STRIPS)
            if not chosen.any():
                raise InputError(f"no time of {method} with {STRIPS} strips ({path})")
            _, error = errors.select(name, method)
            mean = np.mean(error["force_err"])
            axes.plot(np.median(time[chosen]), mean, linestyle="none", color=look.colour,
                      marker=MARKERS[method], markersize=9 if method == "faststrip" else 7,
                      label=look.label)
        style.log_axes(axes)
        axes.set_xticks((0.5, 1.0, 2.0, 5.0, 10.0))
        axes.set(xlim=(0.5, 10.0), title=heading, xlabel="forces of one contact, µs")
    figure.axes[0].set_ylabel("mean error of the force, % of $\\mu\\cdot N$")
    style.legend_above(figure, figure.axes[0], **LEGEND)
    return figure


if __name__ == "__main__":
    sys.exit(command.run(main))
