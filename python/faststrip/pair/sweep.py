"""Contacts of a wheel on a rail over the lateral displacement."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, Optional, Sequence

import numpy as np
import numpy.typing as npt

from .._arguments import as_long_as, refused
from .._library import FIRST_ERROR, FaststripError
from .._many import ManyResult, solve_many
from .._record import Shown, described
from .bodies import Body, Options, Pair, check_yaw, demand_of, row, track_forces

if TYPE_CHECKING:
    from .bodies import Unpack

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Placed(Shown):
    """Where contacts are, and how they move."""

    y: Array
    contact_angle: Array
    radius: Array
    rail_y: Array
    wheel_y: Array
    cksi: Array
    ceta: Array
    cphi: Array
    force_y: Array
    force_z: Array


PLACED = {one.name for one in fields(Placed)}


@described
@dataclass(frozen=True, repr=False)
class SweepResult(ManyResult, Placed):
    """Contacts of a right wheel on the right rail over the lateral displacement.

    Numbers are nan where there is no contact, and `status` says why.

    Attributes
    ----------
    y : ndarray of float, shape (n,)
        Lateral displacements of the wheelset to the right, mm.
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

    def _columns(self) -> Dict[str, Any]:
        placed = {one.name: getattr(self, one.name) for one in fields(Placed)}
        return {**placed, **super()._columns()}

    def to_xarray(self, dims: Optional[Sequence[str]] = None,
                  coords: Optional[Mapping[str, Any]] = None) -> Any:
        """The figures as a dataset of xarray.

        Parameters
        ----------
        dims : sequence of str, optional
            Name of the dimension: ``y``, which has the displacements, unless another is given.
        coords : mapping, optional
            Coordinates, for xarray.

        Returns
        -------
        xarray.Dataset
            The arrays, with ``units`` and ``long_name``.
        """
        return super().to_xarray(("y",) if dims is None else dims, coords)

    def plot(self, figure: Any = None) -> Any:
        """Draw forces, contact angle, maximum pressure and the patch on the rail over the
        displacement.

        Lines end where there is no contact, and break where the place of contact jumps; the patch
        breaks where those of neighbours have no place of the rail in common.

        Parameters
        ----------
        figure : matplotlib.figure.Figure
            To draw on; a new one unless given.

        Returns
        -------
        matplotlib.figure.Figure
        """
        from .pictures import plot_sweep

        return plot_sweep(self, figure)


def sweep(wheel: Body, rail: Body, y: npt.ArrayLike, *,
          vertical_load: Optional[npt.ArrayLike] = None, load: Optional[npt.ArrayLike] = None,
          penetration: Optional[npt.ArrayLike] = None, creepage: Any = None,
          yaw: npt.ArrayLike = 0.0, mu: npt.ArrayLike = 0.3, inclination: Optional[float] = None,
          wheel_radius: float = 460.0, threads: Optional[int] = None,
          **options: Unpack[Options]) -> SweepResult:
    """Contacts over the lateral displacement, by several threads.

    Each has the bits that `contact` gives for that displacement alone.

    Parameters
    ----------
    wheel, rail, inclination, wheel_radius, **options
        As of `contact`.
    y : array_like, shape (n,)
        Lateral displacements of the wheelset to the right, mm.
    vertical_load, load, penetration : array_like, shape (n,) or ()
        Vertical wheel load or normal force, N, or penetration, mm; one of the three.
    creepage : three array_like, shape (n,) or (), optional
        Longitudinal, lateral and spin (rad/mm) creepage; those of steady rolling unless given.
    yaw, mu : array_like, shape (n,) or ()
        Yaw of the wheelset, rad, and coefficient of friction.
    threads : int
        At most so many; by default as many as there are cores.

    Returns
    -------
    SweepResult

    Raises
    ------
    FaststripError
        Where there is no contact at any displacement, or an argument is wrong.

    Examples
    --------
    >>> found = sweep("s1002", "60e1", y=[-3.0, 0.0, 3.0, 300.0], vertical_load=80e3)
    >>> (found.fx / 1e3).round(2).tolist(), found.counts
    ([11.46, -2.31, -9.85, nan], {'ok': 3, 'no_contact': 1})
    """
    pair = Pair("sweep", wheel, rail, inclination, wheel_radius, options)
    demand = demand_of(vertical_load, load, penetration)
    check_yaw(creepage, yaw)
    places = row("y", y)
    values, yaws, mus = (as_long_as(places, name, value) for name, value in (
        (demand.name, demand.value), ("yaw", yaw), ("mu", mu)))
    given = None if creepage is None else _three(places, creepage)
    both = places.tolist() if given is not None else [*places.tolist(), *(-places).tolist()]
    gaps = pair.gaps(both, threads)
    problems = _problems(places, gaps, given is None)
    there = np.flatnonzero([problem is None for problem in problems])
    if there.size == 0:
        raise problems[0]  # type: ignore[misc]
    placed = np.full((len(fields(Placed)), places.size), np.nan)
    placed[0] = places
    demanded, found_gaps = [], []
    for i in there.tolist():
        gap, y_i = gaps[places[i]], float(places[i])
        motion = (given[:, i].tolist() if given is not None
                  else pair.rolling(gap, gaps[-y_i].radius, float(yaws[i])))
        placed[1:-2, i] = gap.angle, gap.radius, gap.y_rail, gap.y_wheel, *motion
        demanded.append(demand.at(float(values[i]), gap.angle))
        found_gaps.append(gap)
    pair.solving[demand.of_solver] = demanded
    angle, creepages = placed[1, there], placed[5:8, there]
    many = solve_many(found_gaps, creepage=tuple(creepages), mu=mus[there], contact_angle=angle,
                      rail_y=placed[3, there], threads=threads, **pair.solving)
    placed[-2:, there] = track_forces(many.fy, many.load, angle)
    return SweepResult(*placed, **_spread(many, there, problems))


def _three(places: Array, creepage: Any) -> Array:
    try:
        parts = tuple(creepage)
    except TypeError:
        parts = ()
    if len(parts) != 3 or isinstance(creepage, str):
        raise refused("creepage", "longitudinal, lateral and spin, numbers or as long as y",
                      creepage)
    return np.stack([as_long_as(places, f"creepage[{k}]", part) for k, part in enumerate(parts)])


def _problems(places: Array, gaps: Dict[float, Any],
              both_roll: bool) -> List[Optional[FaststripError]]:
    """Why there is no contact at each displacement, of this wheel or of the left one that rolls
    with it; None where there is."""
    found: List[Optional[FaststripError]] = []
    for y in places.tolist():
        either = [gaps[y], gaps[-y]] if both_roll else [gaps[y]]
        found.append(next((one for one in either if isinstance(one, FaststripError)), None))
    return found


def _spread(many: ManyResult, there: npt.NDArray[np.intp],
            problems: List[Optional[FaststripError]]) -> Dict[str, Any]:
    """Figures of the contacts that were solved, among those without a gap."""
    spread: Dict[str, Any] = {}
    for one in fields(ManyResult)[:-1]:
        if one.name in PLACED:
            continue
        values = getattr(many, one.name)
        nothing = np.nan if values.dtype == np.float64 else 0
        spread[one.name] = np.full(len(problems), nothing, dtype=values.dtype)
        spread[one.name][there] = values
    words = ""
    for i, problem in enumerate(problems):
        if problem is not None:
            spread["status"][i] = problem.status
    failed = np.flatnonzero(spread["status"] >= FIRST_ERROR)
    if failed.size:
        first = problems[failed[0]]
        words = (f"contact {failed[0]}: {first.message}" if first is not None
                 else f"contact {failed[0]}: {many.first_error.partition(': ')[2]}")
    return {**spread, "first_error": words}
