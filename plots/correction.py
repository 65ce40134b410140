#!/usr/bin/env python3
"""Draw what the march misses of the forces of ellipses, and what the correction leaves of it."""

import sys

import numpy as np

from faststrip_plots import command, picture, style
from faststrip_plots.tables import InputError

# The panels: creepage, force and its name.
PANELS = (("longitudinal", "Fx", "$F_x$, longitudinal creepage"),
          ("lateral", "Fy", "$F_y$, lateral creepage"),
          ("lateral", "Mz", "$M_z$, lateral creepage"),
          ("spin", "Fy", "$F_y$, spin"),
          ("all", "Fx", "$F_x$, all three"),
          ("all", "Mz", "$M_z$, all three"))
COLUMNS = ("direction", "a_over_b", "u", *(f"{force}{kind}" for kind in ("_plain", "", "_tang")
                                           for force in ("Fx", "Fy", "Mz")))


def grid_of(table, direction, force):
    """Axes, and in percent what is missing before and after, on all of them."""
    rows = [k for k, word in enumerate(table.words("direction")) if word == direction]
    x, y = (table.numbers(name)[rows] for name in ("a_over_b", "u"))
    across, up = np.unique(x), np.unique(y)
    if len(rows) != len(across) * len(up):
        raise InputError(f"every a_over_b of {direction} must have every u, got {len(rows)} rows")
    order = np.lexsort((y, x))
    before, after = (100 * (table.numbers(f"{force}_tang") - table.numbers(name))[rows][order]
                     .reshape(len(across), len(up)).T for name in (f"{force}_plain", force))
    return across, up, before, after


@picture.command(__doc__, "out/correction.png", correction=(
    "out/correction.csv", "what `faststrip-lab bench correction` wrote", COLUMNS))
def main(table):
    figure = style.new_figure(14.0, 5.6)
    axes = figure.subplots(2, len(PANELS), sharex=True, sharey=True)
    for k, (direction, force, name) in enumerate(PANELS):
        across, up, before, after = grid_of(table, direction, force)
        limit = max(float(np.abs(before).max()), 0.1)
        for row, (values, what) in enumerate(((before, "missing"), (after, "left"))):
            panel = axes[row, k]
            colours = panel.pcolormesh(across, up, values, cmap="RdBu_r", vmin=-limit, vmax=limit,
                                       shading="gouraud")
            worst = f"{np.abs(values).max():.1f}"
            panel.set(xscale="log", yscale="log",
                      title=("" if row else f"{name}\n") + f"{what}, at most {worst} %")
        figure.colorbar(colours, ax=axes[:, k], location="bottom", shrink=0.9, pad=0.02,
                        label=r"% of $\mu\cdot N$" + (r"$\sqrt{ab}$" if force == "Mz" else ""))
        axes[1, k].set_xlabel("$a/b$")
    for panel in axes[:, 0]:
        panel.set_ylabel(r"linear force over $\mu\cdot N$")
    return figure, ""


if __name__ == "__main__":
    sys.exit(command.run(main))
