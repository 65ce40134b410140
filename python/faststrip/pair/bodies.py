"""A wheel on a rail: their profiles, their gap at a lateral displacement, load and creepages."""

from __future__ import annotations

import concurrent.futures
import math
import os
from typing import TYPE_CHECKING, Any, Dict, List, NamedTuple, Optional, Tuple, TypedDict, Union

import numpy as np
import numpy.typing as npt

from .._arguments import above_zero, array, number, refused, whole
from .._contact import Material
from .._library import FaststripError, bad_argument
from .._many import MOST_THREADS, cores
from .._profile import NAMES, Gap, Path, Profile, is_path, profile_gap
from .._wear import Friction

if TYPE_CHECKING:
    from typing_extensions import Unpack as Unpack

Array = npt.NDArray[np.float64]
Body = Union[Path, Profile]
Creepages = Tuple[float, float, float]


class Options(TypedDict, total=False):
    """What the functions of a pair take besides, by the names of `profile_gap` and `Contact`."""

    back_spacing: float
    tread_line: float
    gauge: float
    gauge_depth: float
    step: float
    height: float
    roller_radius: float
    material: Material
    friction: Friction
    speed: float
    normal: str
    tangential: str
    strips_per_patch: Union[int, str]
    points_per_strip: int
    fastsim_grid: Tuple[int, int]
    estimate: bool
    resolution_limit: float
    force_limit: float
    curved: bool
    target: str
    tolerance: float
    budget_us: float


OF_GAP = "back_spacing", "tread_line", "gauge", "gauge_depth", "step", "height", "roller_radius"


class Demand(NamedTuple):
    """A load or a penetration, one of the three that a caller may give."""

    name: str
    value: Any

    @property
    def of_solver(self) -> str:
        """Its name for a solver, which takes normal loads."""
        return "load" if self.name == "vertical_load" else self.name

    def at(self, value: float, angle: float) -> float:
        """What a solver takes of a value at a contact angle."""
        return value / math.cos(angle) if self.name == "vertical_load" else value


def demand_of(vertical_load: Any, load: Any, penetration: Any) -> Demand:
    """The one of three that is given."""
    given = [Demand(name, value) for name, value in (
        ("vertical_load", vertical_load), ("load", load), ("penetration", penetration))
        if value is not None]
    if len(given) != 1:
        raise bad_argument("one of vertical_load, load and penetration must be given, got "
                           + (" and ".join(one.name for one in given) or "none"))
    return given[0]


def check_yaw(creepage: Any, yaw: Any) -> None:
    """Yaw counts where the motion gives the creepages."""
    if creepage is not None and np.any(yaw):
        raise refused("yaw", "0 where creepage is given, which has all of the motion", yaw)


def row(name: str, value: Any) -> Array:
    """A row of finite numbers, one at least."""
    found = array(name, value)
    if found.ndim != 1 or found.size == 0:
        raise refused(name, "a row of numbers", value)
    for i in np.flatnonzero(~np.isfinite(found))[:1]:
        number(f"{name}[{i}]", float(found[i]))
    return found


def _profile_of(value: Any, kind: str) -> Any:
    """A profile, read if it is the path of a file; names stay, for the library."""
    is_name = isinstance(value, str) and value.lower() in NAMES[kind]
    if isinstance(value, (str, os.PathLike)) and not is_name and is_path(value):
        return Profile.read(value, kind=kind)
    return value


class Pair:
    """A right wheel on the right rail, with the options of a call."""

    def __init__(self, caller: str, wheel: Any, rail: Any, inclination: Any, wheel_radius: Any,
                 options: Any) -> None:
        for name in options:
            if name not in Options.__annotations__:
                raise TypeError(f"{caller}() got an unexpected keyword argument {name!r}")
        self._bodies = _profile_of(wheel, "wheel"), _profile_of(rail, "rail")
        self.radius = above_zero("wheel_radius", wheel_radius)
        self._setup: Dict[str, Any] = {"inclination": inclination, "radius": self.radius}
        self.solving: Dict[str, Any] = {}  # what the solvers take
        for name, value in options.items():
            (self._setup if name in OF_GAP else self.solving)[name] = value

    def gap(self, y: float) -> Gap:
        """The gap at a displacement."""
        return profile_gap(*self._bodies, shift=y, **self._setup)

    def gaps(self, places: List[float], threads: Optional[int]) -> Dict[float, Any]:
        """The gap at each displacement, or the error in its place."""
        def one(y: float) -> Any:
            try:
                return self.gap(y)
            except FaststripError as problem:
                return problem

        most = cores() if threads is None else whole("threads", threads, 1, MOST_THREADS)
        wanted = sorted(set(places))
        pool = concurrent.futures.ThreadPoolExecutor(min(most, len(wanted)))
        try:
            return dict(zip(wanted, pool.map(one, wanted)))
        finally:
            pool.shutdown(cancel_futures=True)

    def rolling(self, gap: Gap, left_radius: float, yaw: float) -> Creepages:
        """Creepages of the right wheel of a wheelset that rolls steadily on rigid axles: where it
        stands the left one has another rolling radius. On rollers they are the rig's own."""
        if self._setup.get("roller_radius", 0.0):
            raise bad_argument("all creepages must be given with a roller_radius")
        return ((gap.radius - left_radius) / (2.0 * self.radius),
                math.sin(yaw) / math.cos(gap.angle), -math.sin(gap.angle) / self.radius)


def track_forces(fy: Any, load: Any, angle: Any) -> Tuple[Any, Any]:
    """Lateral and vertical force on the rail of one in the contact plane and one normal to it."""
    return fy * np.cos(angle) - load * np.sin(angle), fy * np.sin(angle) + load * np.cos(angle)
