#!/usr/bin/env python3
"""Draw what `./run scale` has measured: rates, efficiency, memory against contacts, formats."""

import sys

import numpy as np

from faststrip_plots import command, picture, style
from faststrip_plots.tables import InputError

COLOUR = "#0b3c78"
NUMBERS = ("contacts", "processes", "threads", "contacts_per_core_s", "efficiency", "peak_MB",
           "bytes_per_contact")


@picture.command(__doc__, "out/scale.png", scale=(
    "out/scale.csv", "what `./run scale` wrote", ("group", "what", *NUMBERS)))
def main(table):
    numbers = {name: table.positive(name, missing=True) for name in NUMBERS}

    def rows(*groups, name):
        found = [row for row, group in enumerate(table.words("group"))
                 if group in groups and not np.isnan(numbers[name][row])]
        if not found:
            raise InputError(f"no {name} of {' or '.join(groups)} ({table.path})")
        return found

    what = table.words("what")
    figure = style.new_figure(10.4, 7.0)
    (rate, share), (memory, size) = figure.subplots(2, 2)
    bars(rate, numbers["contacts_per_core_s"], rows("method", name="contacts_per_core_s"), what)
    rate.set(xscale="log", xlabel="contacts per second and core")
    found = rows("threads", "parts", name="efficiency")
    ways = {row: f"{what[row]}, {way(numbers['processes'][row], numbers['threads'][row])}"
            for row in found}
    bars(share, 100.0 * numbers["efficiency"], found, ways)
    share.axvline(100.0, color=style.GREY, linewidth=1.2, linestyle=(0, (1.2, 1.2)), zorder=1)
    share.set_xlabel("efficiency, % of the cores there are")
    found = rows("memory", name="peak_MB")
    memory.plot(numbers["contacts"][found], numbers["peak_MB"][found], color=COLOUR,
                marker="o", zorder=3)
    memory.set(xscale="log", ylim=(0.0, 1.25 * numbers["peak_MB"][found].max()), xlabel="contacts",
               ylabel="peak memory, MB")
    bars(size, numbers["bytes_per_contact"], rows("format", name="bytes_per_contact"), what)
    size.set_xlabel("bytes per contact")
    return figure, "rates by processor time"


def way(processes, threads):
    """Who solves: processes of one thread each, or threads of one process."""
    if processes > 1:
        return f"{processes:.0f} processes"
    return "1 thread" if threads == 1 else f"{threads:.0f} threads"


def bars(axes, values, rows, names):
    """A bar with its number for each row, the first on top."""
    places = range(len(rows))
    axes.barh(places, values[rows], height=0.62, zorder=3, color=COLOUR)
    for place, row in zip(places, rows):
        axes.annotate(f"{values[row]:.0f}", (values[row], place), (4.0, 0.0),
                      textcoords="offset points", va="center", fontsize=style.SMALL)
    axes.set_yticks(places, [names[row] for row in rows])
    axes.set_ylim(len(rows) - 0.4, -0.6)
    axes.margins(x=0.15)
    axes.grid(axis="y", visible=False)


if __name__ == "__main__":
    sys.exit(command.run(main))
