"""Pictures of sweeps and of creep maps."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, Tuple

import numpy as np
import numpy.typing as npt

from .. import _style as style
from .._library import bad_argument
from .._plot import new_figure, plot_lines, styled

if TYPE_CHECKING:
    from .creep_map import CreepMap
    from .sweep import SweepResult

Array = npt.NDArray[np.float64]
KN = 1e3
PER_CENT = 100.0
DIVERGING = "RdBu_r"
# Of a creepage: what stands at its axis, and how many of that it has.
CREEPAGES: Dict[str, Tuple[str, float]] = {
    "cksi": (r"longitudinal creepage, %", PER_CENT),
    "ceta": (r"lateral creepage, %", PER_CENT),
    "cphi": (r"spin creepage, rad/mm", 1.0)}


def plot_sweep(found: SweepResult, figure: Any) -> Any:
    """Forces, contact angle, maximum pressure and the patch, over the displacement."""
    low = found.rail_y + found.y_min * np.cos(found.contact_angle)
    high = found.rail_y + found.y_max * np.cos(found.contact_angle)
    jumps = np.array(style.jumps(found.y, found.rail_y))
    apart = np.maximum(low[:-1], low[1:]) > np.minimum(high[:-1], high[1:])

    def broken(values: Array) -> Array:
        return _broken(values, jumps, np.nan)

    y = _broken(found.y, jumps)
    label = "lateral displacement $y$, mm"
    with styled():
        if figure is None:
            figure = new_figure(9.6, 6.4)
        forces, angle, pressure, patch = figure.subplots(2, 2, sharex=True).flat
        plot_lines(forces, y, {name: broken(values / KN) for name, values in (
            ("normal", found.load), ("longitudinal", found.fx), ("lateral", found.fy))},
            "", "force on the rail, kN")
        plot_lines(angle, y, {"": broken(np.degrees(found.contact_angle))}, "",
                   "contact angle, degrees")
        plot_lines(pressure, y, {"": broken(found.pmax)}, label, "maximum pressure, MPa")
        patch.fill_between(_broken(found.y, apart), _broken(low, apart, np.nan),
                           _broken(high, apart, np.nan), color=style.STICK, linewidth=0,
                           label="patch")
        plot_lines(patch, y, {"place of contact": broken(found.rail_y)}, label,
                   "on the rail, $y$ to the field side, mm")
        for axes in (forces, angle, pressure, patch):
            # Places that stand alone are seen too.
            for line in axes.lines:
                line.set(marker="o", markersize=2.2)
    return figure


def _broken(values: Array, where: npt.NDArray[np.bool_], by: Any = None) -> Array:
    """Values with another one in front of those behind a break: the same unless given."""
    behind = 1 + np.flatnonzero(where)
    return np.insert(values, behind, values[behind] if by is None else by)


def plot_creep_map(found: CreepMap, figure: Any) -> Any:
    """Forces over one or two creepages."""
    if len(found.axes) > 2:
        raise bad_argument("a creep map over three creepages cannot be drawn: select from "
                           "to_xarray()")
    with styled():
        if figure is None:
            figure = new_figure(5.6 if len(found.axes) == 1 else 9.6, 3.9)
        if len(found.axes) == 1:
            label, scale = CREEPAGES[found.axes[0]]
            plot_lines(figure.subplots(), scale * found.values(found.axes[0]),
                       {"longitudinal": found.fx / KN, "lateral": found.fy / KN}, label,
                       "force on the rail, kN")
            return figure
        for axes, forces, name in zip(figure.subplots(1, 2, sharey=True), (found.fx, found.fy),
                                      ("longitudinal", "lateral")):
            _draw_map(axes, found, forces / KN, f"{name} force on the rail, kN")
    return figure


def _draw_map(axes: Any, found: CreepMap, forces: Array, label: str) -> None:
    (x_label, x_scale), (y_label, y_scale) = (CREEPAGES[axis] for axis in found.axes)
    x, y = (found.values(axis) for axis in found.axes)
    rows, columns = np.argsort(x), np.argsort(y)
    largest = np.nanmax(np.abs(forces), initial=0.0)
    colours = axes.pcolormesh(x_scale * x[rows], y_scale * y[columns],
                              forces[np.ix_(rows, columns)].T, shading="nearest", cmap=DIVERGING,
                              vmin=-largest, vmax=largest, rasterized=True)
    axes.figure.colorbar(colours, ax=axes, label=label)
    axes.grid(False)
    axes.set(xlabel=x_label, ylabel=y_label)
    axes.label_outer()
