"""Creep forces of one wheel on one rail over creepages."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, Dict, Mapping, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt

from .._arguments import number, numbers
from .._library import bad_argument
from .._many import ManyResult, solve_many
from .._record import Shown, described
from .._tables import about
from .bodies import Body, Options, Pair, demand_of, row

if TYPE_CHECKING:
    from .bodies import Unpack

Array = npt.NDArray[np.float64]
NAMES = {"longitudinal": "cksi", "lateral": "ceta", "spin": "cphi"}


@dataclass(frozen=True)
class Placed(Shown):
    """Where the contact is, and its creepages."""

    y: float
    contact_angle: float
    radius: float
    axes: Tuple[str, ...]
    cksi: Array
    ceta: Array
    cphi: Array


# Of a `ManyResult`, what `Placed` has not got.
FIGURES = [one.name for one in fields(ManyResult)
           if one.name not in {other.name for other in fields(Placed)}]


@described
@dataclass(frozen=True, repr=False)
class CreepMap(ManyResult, Placed):
    """Creep forces over one, two or three creepages; all arrays are of their shape.

    Attributes
    ----------
    y : float
        Lateral displacement of the wheelset to the right, mm.
    contact_angle : float
        Contact angle, rad.
    radius : float
        Rolling radius, mm.
    axes : tuple of str
        What each dimension of the arrays is over: of cksi, ceta and cphi.
    <figures>
    status : ndarray of int32
        As of a `ManyResult`, as are the others.
    limitations : ndarray of int32
        All of them as a set.
    target_is_met : ndarray of bool
        Is it within the tolerance?
    first_error : str
        Which contact is the first without a result, and why.
    """

    def values(self, axis: str) -> Array:
        """The creepages along a dimension of the arrays.

        Parameters
        ----------
        axis : str
            One of `axes`.

        Returns
        -------
        ndarray of float
            -, -, or rad/mm.
        """
        if axis not in self.axes:
            raise bad_argument(f"axis must be one of {', '.join(self.axes)}, got {axis!r}")
        found: Array = np.moveaxis(getattr(self, axis), self.axes.index(axis), 0)
        return found.reshape(len(found), -1)[:, 0].copy()

    def _columns(self) -> Dict[str, Any]:
        return {**{name: getattr(self, name) for name in NAMES.values()}, **super()._columns()}

    def to_xarray(self, dims: Optional[Sequence[str]] = None,
                  coords: Optional[Mapping[str, Any]] = None) -> Any:
        """The figures as a dataset of xarray.

        Parameters
        ----------
        dims : sequence of str, optional
            Names of the dimensions: `axes`, with the creepages, unless others are given.
        coords : mapping, optional
            Coordinates, for xarray.

        Returns
        -------
        xarray.Dataset
            The arrays, with ``units`` and ``long_name``.
        """
        if dims is None:
            dims = self.axes
            coords = {**{axis: (axis, self.values(axis), about(axis)) for axis in self.axes},
                      **(coords or {})}
        return super().to_xarray(dims, coords)

    def plot(self, figure: Any = None) -> Any:
        """Draw longitudinal and lateral force on the rail, over one creepage as lines, over two as
        maps; white where there is no result.

        Parameters
        ----------
        figure : matplotlib.figure.Figure
            To draw on; a new one unless given.

        Returns
        -------
        matplotlib.figure.Figure
        """
        from .pictures import plot_creep_map

        return plot_creep_map(self, figure)


def creep_map(wheel: Body, rail: Body, y: float = 0.0, *,
              longitudinal: Optional[npt.ArrayLike] = None,
              lateral: Optional[npt.ArrayLike] = None, spin: Optional[npt.ArrayLike] = None,
              vertical_load: Optional[float] = None, load: Optional[float] = None,
              penetration: Optional[float] = None, mu: float = 0.3,
              inclination: Optional[float] = None, wheel_radius: float = 460.0,
              threads: Optional[int] = None, **options: Unpack[Options]) -> CreepMap:
    """Creep forces of one contact over creepages, by several threads.

    The gap is made once. Each contact starts from the one before it along the last axis, so that
    pressures are not solved again; the last digits depend on it.

    Parameters
    ----------
    wheel, rail, vertical_load, load, penetration, mu, inclination, wheel_radius, **options
        As of `contact`.
    y : float
        Lateral displacement of the wheelset to the right, mm.
    longitudinal, lateral, spin : float or array_like, shape (n,)
        Creepages, the spin in rad/mm: an array is a dimension of the map, in this order. What is
        not given is that of steady rolling without yaw, as of `contact`.
    threads : int
        At most so many; by default as many as there are cores.

    Returns
    -------
    CreepMap

    Raises
    ------
    FaststripError
        Where the profiles do not touch, or an argument is wrong.

    Examples
    --------
    >>> found = creep_map("s1002", "60e1", y=3.0, vertical_load=80e3,
    ...                   longitudinal=[-1e-3, 0.0, 1e-3], lateral=[0.0, 2e-3])
    >>> found.axes, (found.fx / 1e3).round(1).tolist()
    (('cksi', 'ceta'), [[9.6, 7.6], [0.1, -0.0], [-9.7, -7.7]])
    """
    pair = Pair("creep_map", wheel, rail, inclination, wheel_radius, options)
    demand = demand_of(vertical_load, load, penetration)
    given = {"longitudinal": longitudinal, "lateral": lateral, "spin": spin}
    rows = {name: row(name, value) for name, value in given.items()
            if value is not None and np.ndim(value) != 0}
    if not rows:
        raise bad_argument("one of longitudinal, lateral and spin must be an array, got none")
    y, value = numbers(("y", demand.name), (y, demand.value))
    gap = pair.gap(y)
    rolling = ((0.0, 0.0, 0.0) if all(one is not None for one in given.values()) else
               pair.rolling(gap, pair.gap(-y).radius if longitudinal is None else gap.radius, 0.0))
    meshes = iter(np.meshgrid(*rows.values(), indexing="ij"))
    shape = tuple(one.size for one in rows.values())
    creepages = [next(meshes) if name in rows
                 else np.full(shape, rolled if one is None else number(name, one))
                 for (name, one), rolled in zip(given.items(), rolling)]
    pair.solving[demand.of_solver] = demand.at(value, gap.angle)
    many = solve_many(gap, creepage=tuple(creepages), mu=number("mu", mu),
                      contact_angle=gap.angle, rail_y=gap.y_rail, warm_start=True, threads=threads,
                      **pair.solving)
    found: Tuple[Any, ...] = (y, gap.angle, gap.radius, tuple(NAMES[name] for name in rows),
                              *creepages, *(getattr(many, name) for name in FIGURES))
    return CreepMap(*found)
