#!/usr/bin/env python3
"""Draw and tabulate how far each method is from Kalker's on the cases of example/cases."""

import math
import os
import sys

import numpy as np

from faststrip_plots import command, style
from faststrip_plots.document import announce, write_dicts, write_rows
from faststrip_plots.results import RESULTS, revision
from faststrip_plots.tables import InputError, read_table

REFERENCE = "Kalker"
COLOURS = ("#c9a227", "#f08519", "#0b3c78", "#2f7d32", "#a8326e")
MARKERS = ("x", "s", "o", "D", "^")
PANELS = (("pmax", "maximum pressure"), ("forces", "forces, over $\\mu\\cdot N$"))
LEAST = 1e-3  # %, what is drawn for less


def main(arguments=None):
    options = command.options(__doc__, arguments, {
        "examples": ("out/examples.csv", "what `faststrip-lab bench examples` wrote")},
        folder=("out/examples", "picture and tables go there"))
    table = read_table(options.examples, ("example", "method", "status", "N_N", "mu", "pmax_MPa",
                                          "Fx_N", "Fy_N", "normal_us", "tangential_us", "choice"))
    rows = errors(table)
    draw(rows, os.path.join(options.folder, "examples.png"), revision(table))
    write_dicts(os.path.join(options.folder, "examples_table.csv"), rows)
    choices = [(s, c) for s, m, c in zip(*(table.words(n) for n in ("example", "method", "choice")))
               if m.startswith("auto")]
    write_rows(os.path.join(options.folder, "examples_choice.csv"), ("example", "choice"), choices)
    announce(options.folder, "figures.csv", [
        ("examples.png", "Examples", "Distance of each method from Kalker's on ten cases; what is"
         " left out has no result.", "examples")])
    announce(options.folder, "tables.csv", [
        ("examples_table.csv", "Examples by method", "Errors in % of Kalker's maximum pressure and"
         " of mu N; times in microseconds.", "examples"),
        ("examples_choice.csv", "What is chosen for 2 % of mu N", "", "auto")])


def errors(table):
    """One row an example and method, the reference's first."""
    names = ("pmax_MPa", "Fx_N", "Fy_N", "N_N", "mu", "normal_us", "tangential_us")
    number = {name: table.numbers(name, missing=True) for name in names}
    example, method, status = (table.words(name) for name in ("example", "method", "status"))
    reference = {s: k for k, (s, m) in enumerate(zip(example, method)) if m == REFERENCE}
    rows = []
    for k, (s, m) in enumerate(zip(example, method)):
        if s not in reference:
            raise InputError(f"no row {REFERENCE} for {s}: {table.path}")
        r = reference[s]
        row = {"example": s, "method": m, "status": status[k], "us": "", "pmax": "", "forces": ""}
        if status[k] in RESULTS:
            row["us"] = float(np.nansum([number["normal_us"][k], number["tangential_us"][k]]))
        # where Kalker's methods refuse the materials, there is nothing to judge by
        judged = status[r] in RESULTS and status[r] != "target_missed"
        if m != REFERENCE and judged and status[k] in RESULTS:
            row["pmax"] = 100 * abs(number["pmax_MPa"][k] / number["pmax_MPa"][r] - 1)
            force = math.hypot(number["Fx_N"][k] - number["Fx_N"][r],
                               number["Fy_N"][k] - number["Fy_N"][r])
            if not math.isnan(force):
                row["forces"] = 100 * force / (number["mu"][r] * number["N_N"][r])
        rows.append(row)
    return rows


def draw(rows, path, stamp):
    examples = list(dict.fromkeys(row["example"] for row in rows))
    methods = [m for m in dict.fromkeys(row["method"] for row in rows) if m != REFERENCE]
    figure = style.new_figure(11.5, 5.2)
    panels = figure.subplots(1, 2, sharey=True)
    for axes, (figure_name, words) in zip(panels, PANELS):
        for k, method in enumerate(methods):
            own = [(row[figure_name], examples.index(row["example"])) for row in rows
                   if row["method"] == method and row[figure_name] != ""]
            axes.plot([max(value, LEAST) for value, _ in own],
                      [place + 0.14 * (k - 0.5 * (len(methods) - 1)) for _, place in own],
                      linestyle="none", marker=MARKERS[k % 5], color=COLOURS[k % 5],
                      markersize=6.5, label=method)
        axes.set(xscale="log", xlabel="error in %")
        axes.set_yticks(range(len(examples)), [name.replace("_", " ") for name in examples])
        axes.set_ylim(len(examples) - 0.5, -0.5)
        axes.axvline(2.0, color="#888888", linewidth=0.9, linestyle=(0, (4, 3)))
        axes.set_title(words)
    style.legend_above(figure, *panels)
    style.save(figure, path, [stamp], "dashed: 2 %, what auto was asked for the forces")


if __name__ == "__main__":
    sys.exit(command.run(main))
