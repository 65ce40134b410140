#!/usr/bin/env python3
"""Draw what things cost: median, 95th percentile and worst of each, on a logarithmic axis."""

import sys

import numpy as np

from faststrip_plots import command, picture, style
from faststrip_plots.tables import InputError

COLOURS = ("#0b3c78", "#a0306a", "#4d9748", "#f08519", "#5f4ba8", "#6b6b6b", "#b03a2e", "#111111",
           "#4b8f3c")


@picture.command(__doc__, "out/speed.png", speed=(
    "out/speed.csv", "what `./run speed` wrote",
    ("group", "what", "us_median", "us_p95", "us_worst", "contact", "contact_us_median")))
def main(table):
    times = [table.numbers(f"us_{word}") for word in ("median", "p95", "worst")]
    peers = table.numbers("contact_us_median", missing=True)
    for name, values in (("us_median", times[0]), ("us_p95", times[1] - times[0]),
                         ("us_worst", times[2] - times[1])):
        least = np.nextafter(0.0, 1.0) if name == "us_median" else 0.0
        for row in np.flatnonzero(values < least):
            raise InputError(f"{name} must not be less than what stands before it, or not above"
                             f" zero ({table.path}:{table.lines[row]})")
    groups = list(dict.fromkeys(table.words("group")))
    colours = {group: COLOURS[k % len(COLOURS)] for k, group in enumerate(groups)}
    places, names, at = [], [], 0.0
    for row, group in enumerate(table.words("group")):
        # Groups stand apart.
        at += 1.0 if row == 0 or group == table.words("group")[row - 1] else 1.7
        places.append(at)
        names.append(f"{group}: {table.words('what')[row]}")

    figure = style.new_figure(10.4, 1.4 + 0.235 * at)
    axes = figure.add_subplot()
    axes.set_xscale("log")
    for row, group in enumerate(table.words("group")):
        median, p95, worst = (values[row] for values in times)
        look = dict(color=colours[group], zorder=3, solid_capstyle="butt")
        axes.plot([median, p95], [places[row]] * 2, linewidth=5.0, alpha=0.45, **look)
        axes.plot([p95, worst], [places[row]] * 2, linewidth=1.4, **look)
        axes.plot(median, places[row], marker="o", markersize=6.0, linestyle="none",
                  label="median" if row == 0 else None, color=colours[group], zorder=4)
        axes.plot(worst, places[row], marker="|", markersize=8.0, linestyle="none",
                  label="worst; thick: to 95 %" if row == 0 else None,
                  color=colours[group], zorder=4)
    known = np.flatnonzero(~np.isnan(peers))
    if known.size:
        axes.plot(peers[known], np.array(places)[known],
                  **(style.CONTACT | dict(label="CONTACT, recorded")), zorder=2)
        for row in known:
            # Right of all that stands in the row.
            axes.annotate(table.words("contact")[row],
                          (max(peers[row], times[2][row]), places[row]), (7.0, 0.0),
                          textcoords="offset points", va="center", fontsize=7,
                          color=style.GREY)
    fastsim = [row for row, what in enumerate(table.words("what")) if what == "FASTSIM 50x50"]
    for row in fastsim:
        axes.axvline(times[0][row], color=style.GREY, linewidth=1.2, linestyle=(0, (1.2, 1.2)),
                     label="FASTSIM, 50 × 50", zorder=1)
    axes.set_yticks(places, names)
    axes.set_ylim(at + 0.8, places[0] - 0.8)
    axes.xaxis.set_major_formatter("{x:.12g}")
    axes.set_xlabel("processor time, µs")
    axes.grid(axis="y", visible=False)
    style.legend_above(figure, axes)
    return figure, "medians, 95th percentiles, worst; CONTACT's are of another machine"


if __name__ == "__main__":
    sys.exit(command.run(main))
