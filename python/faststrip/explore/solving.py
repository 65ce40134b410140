"""From a case to the figures of all methods; what has not changed is not solved again."""

from __future__ import annotations

import contextlib
import dataclasses
import functools
import math
import time
from typing import Any, Callable, Dict, Iterator, List, NamedTuple, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from .._contact import Contact
from .._library import FIRST_ERROR, FaststripError
from .._many import solve_many
from .._profile import draw_profile, profile_gap
from .._results import Elements, Result, Strips
from .._style import jumps
from .._wear import Wear
from .._wheelset import Wheelset
from .case import RADIUS, Case

Array = npt.NDArray[np.float64]
# Points of a creep curve, and of a drawn profile.
CURVE_POINTS = 31
PROFILE_POINTS = 501
ROLLING_SPEED = 2.0e4  # mm/s; only ratios of speeds count
AXES = {"cksi": 0, "ceta": 1, "cphi": 2}
# Displacements of a sweep, mm, and creepages of a map along each side.
SWEEP = np.linspace(-10.0, 10.0, 41)
MAP_POINTS = 17
# Half the width of a creep curve: the first that holds the creepage.
WIDTHS = {"cksi": (0.005, 0.01, 0.02), "ceta": (0.005, 0.01, 0.02), "cphi": (0.0004, 0.001)}


class Place(NamedTuple):
    """Where the wheel bears on the rail."""

    y_rail: float
    y_wheel: float
    angle: float
    load: float


class Geometry(NamedTuple):
    """The gap of the contact that is solved, and where the others are."""

    gap: Tuple[Array, Array, Array, Array]
    load: float  #: normal force, N
    place: Place
    places: Tuple[Place, ...]
    radius: float  #: rolling radius, mm


class Answer(NamedTuple):
    """What one method made of the contact."""

    result: Optional[Result]
    strips: Optional[Strips]
    elements: Optional[Elements]
    error: str = ""
    wear: Optional[Wear] = None


class Curve(NamedTuple):
    """Forces over one creepage, over mu N."""

    creepage: Array
    fx: Dict[str, Array]
    fy: Dict[str, Array]


class Survey(NamedTuple):
    """What takes longer than one contact; None where it is not known yet."""

    curve: Optional[Curve] = None
    pressure: Optional[Dict[str, Array]] = None
    """maximum pressures at each of SWEEP, MPa; nan before a jump and where nothing touches"""
    half: Tuple[float, float] = (0.0, 0.0)  #: of the creepages of the map
    part: Optional[Array] = None
    """force over mu N; rows of lateral, columns of longitudinal creepages"""
    keys: Tuple[Any, Any, Any] = (None, None, None)  #: what curve, sweep and map are of

    def still(self, case: Case, axis: str) -> Survey:
        """What of it is of this case, too."""
        curve, sweep, part = (a == b for a, b in zip(self.keys, survey_keys(case, axis)))
        return self._replace(curve=self.curve if curve else None,
                             pressure=self.pressure if sweep else None,
                             part=self.part if part else None)


def survey_keys(case: Case, axis: str) -> Tuple[Any, Any, Any]:
    """What curve, sweep and map depend on."""
    sweep = *case.pair, case.is_vertical, case.yaw, case.load
    here = *sweep, case.shift, case.mu
    others = tuple(value for k, value in enumerate(case.creepage) if k != AXES[axis])
    return ((*here, axis, half_width(axis, getattr(case, axis)), others), sweep,
            (*here, case.cphi, half_width("cksi", case.cksi), half_width("ceta", case.ceta)))


@dataclasses.dataclass
class Outcome:
    """Everything that the page shows of a case."""

    case: Case
    geometry: Optional[Geometry] = None
    error: str = ""
    answers: Dict[str, Answer] = dataclasses.field(default_factory=dict)
    axis: str = "cksi"
    where: Any = None  #: what gap and pressures are of
    motion: Any = None  #: what forces are of
    profiles: Tuple[Any, Any] = (None, None)
    rows: Optional[Any] = None  #: of elements, of NORM + TANG
    times: Dict[str, float] = dataclasses.field(default_factory=dict)

    def result(self, name: str) -> Optional[Result]:
        """The figures of a method, if it has some."""
        answer = self.answers.get(name)
        return None if answer is None else answer.result

    def strips(self, name: str) -> Optional[Strips]:
        """The strips of a method, if it has some."""
        answer = self.answers.get(name)
        return None if answer is None else answer.strips


METHODS = {"strips": ("strip", "faststrip"), "hertz": ("hertz", "fastsim")}


def contacts(**options: Any) -> Dict[Tuple[str, bool], Contact]:
    """One of each method, of strips in one plane and in a plane each."""
    return {(name, curved): Contact(normal=normal, tangential=tangential, curved=curved, **options)
            for name, (normal, tangential) in METHODS.items() for curved in (False, True)}


class Kept:
    """Solutions that are kept, with what they took."""

    def __init__(self) -> None:
        self._kept: Dict[str, Tuple[Any, Any]] = {}
        self.times: Dict[str, float] = {}

    def _once(self, name: str, key: Any, make: Callable[[], Any]) -> Any:
        """What was made of the same key, or is made now, and timed."""
        known = self._kept.get(name)
        if known is not None and known[0] == key:
            return known[1]
        start = time.thread_time()
        made = make()
        self.times[name] = time.thread_time() - start
        self._kept[name] = key, made
        return made

    def _profiles(self, case: Case) -> Any:
        """Points of wheel and rail, to be drawn."""
        return self._once("profiles", case.pair, lambda: (
            draw_profile(case.wheel.profile, "wheel", n=PROFILE_POINTS),
            draw_profile(case.rail.profile, "rail", inclination=case.inclination,
                         n=PROFILE_POINTS)))


class Solver(Kept):
    """Contacts and wheelsets that are kept from one change to the next; of one thread."""

    def __init__(self) -> None:
        super().__init__()
        self._contacts = contacts(with_elements=True)
        self._curves = contacts(estimate=False)
        self._wheelset: Tuple[Any, Optional[Wheelset]] = None, None

    def solve(self, case: Case, axis: str = "cksi") -> Outcome:
        """Everything of a case; errors of a method stand in its place."""
        outcome = Outcome(case, axis=axis)
        outcome.profiles = self._profiles(case)
        outcome.where = where = (*case.pair, case.is_vertical, case.shift, case.yaw, case.load)
        outcome.motion = motion = (*where, *case.creepage, case.mu)
        geometry = self.geometry(case)
        if isinstance(geometry, str):
            outcome.error = geometry
        else:
            outcome.geometry = geometry
            for name in METHODS:
                make = functools.partial(self._answer, name, geometry, case)
                outcome.answers[name] = self._once(name, (motion, case.yield_shear), make)
        outcome.times = dict(self.times)
        return outcome

    def _find_geometry(self, case: Case) -> Union[Geometry, str]:
        """The gap, or what is wrong in one line."""
        if case.yaw and not case.is_vertical:
            return "a yawed wheel must have a vertical load, got a normal one in the case file"
        try:
            return self._yawed(case) if case.yaw else straight(case)
        except FaststripError as problem:
            return str(problem)

    def _yawed(self, case: Case) -> Geometry:
        """Of the contact of a yawed wheel that carries most; its gap is the wheelset's."""
        wheelset = self._wheelset_of(case)
        found = wheelset.solve(y=case.shift, yaw=case.yaw, roll=0.0, load=case.load,
                               wheels="right")
        places = tuple(Place(c.rail[0], c.wheel[1], c.contact_angle, c.load)
                       for c in found.contacts)
        most = max(range(len(places)), key=lambda i: places[i].load)
        contact = found.contacts[most]
        return Geometry(wheelset.gap(most), contact.load, places[most], places, contact.radius)

    def _wheelset_of(self, case: Case) -> Wheelset:
        key = case.pair
        if self._wheelset[0] != key or self._wheelset[1] is None:
            self._wheelset = key, Wheelset(case.wheel.profile, case.rail.profile, radius=RADIUS,
                                           inclination=case.inclination, tangential="none",
                                           roller_radius=case.roller_radius,
                                           curved=case.is_curved, estimate=False)
        return self._wheelset[1]  # type: ignore[return-value]

    def prepare(self, case: Case) -> None:
        """Make the wheelset of a case, so that the first yaw takes no longer than others."""
        with contextlib.suppress(FaststripError):
            self._wheelset_of(case)

    def _answer(self, name: str, geometry: Geometry, case: Case) -> Answer:
        contact = self._contacts[name, case.is_curved]
        try:
            contact.set_gap(*geometry.gap)
            result = contact.solve(load=geometry.load, creepage=case.creepage, mu=case.mu)
            return Answer(result, contact.strips(), contact.elements(),
                          wear=contact.wear(yield_shear=case.yield_shear))
        except FaststripError as problem:
            return Answer(None, None, None, str(problem))

    def _find_curve(self, geometry: Geometry, case: Case, axis: str, half: float) -> Curve:
        # Closer to each other where the force rises.
        part = np.linspace(-1.0, 1.0, CURVE_POINTS)
        values = half * np.sign(part) * np.abs(part) ** 1.5
        fx, fy = {}, {}
        bound = case.mu * geometry.load
        for name in METHODS:
            contact = self._curves[name, case.is_curved]
            rows: List[Tuple[float, float]] = []
            try:
                contact.set_gap(*geometry.gap)
                for value in values.tolist():
                    cksi, ceta, cphi = (value if k == AXES[axis] else one
                                        for k, one in enumerate(case.creepage))
                    result = contact.solve(load=geometry.load, creepage=(cksi, ceta, cphi),
                                           mu=case.mu, warm_start=bool(rows))
                    rows.append((result.fx / bound, result.fy / bound))
            except FaststripError:
                rows = [(math.nan, math.nan)] * len(values)
            fx[name], fy[name] = np.array(rows).T
        return Curve(values, fx, fy)

    def survey(self, case: Case, axis: str) -> Iterator[Survey]:
        """Creep curve, sweep and map of a case, as soon as each is known."""
        keys = curve, sweep, part = survey_keys(case, axis)
        geometry = self.geometry(case)
        found = Survey(keys=keys)
        if not isinstance(geometry, str):
            found = found._replace(curve=self._once("curve", curve, lambda: self._find_curve(
                geometry, case, axis, half_width(axis, getattr(case, axis)))))
            yield found
        found = found._replace(pressure=self._once("sweep", sweep, lambda: self._sweep(case)))
        yield found
        if not isinstance(geometry, str):
            half = half_width("cksi", case.cksi), half_width("ceta", case.ceta)
            yield found._replace(half=half, part=self._once("map", part, lambda: map_of(
                geometry, case, half)))

    def geometry(self, case: Case) -> Union[Geometry, str]:
        """The gap with its normal force, or what is wrong in one line."""
        key = *case.pair, case.is_vertical, case.shift, case.yaw
        found = self._once("gap", (*key, case.load) if case.yaw else key,
                           lambda: self._find_geometry(case))
        return found if case.yaw or isinstance(found, str) else loaded(found, case)

    def _sweep(self, case: Case) -> Dict[str, Array]:
        found = [self._find_geometry(dataclasses.replace(case, shift=y)) for y in SWEEP.tolist()]
        bodies = {k: one if case.yaw else loaded(one, case) for k, one in enumerate(found)
                  if not isinstance(one, str)}
        there = list(bodies)
        pressure = {name: np.full(len(SWEEP), math.nan) for name in METHODS}
        if there:
            for name, (normal, _) in METHODS.items():
                many = solve_many([one.gap for one in bodies.values()],
                                  load=[one.load for one in bodies.values()], normal=normal,
                                  tangential="none", estimate=False, curved=case.is_curved,
                                  threads=1)
                pressure[name][there] = np.where(many.status < FIRST_ERROR, many.pmax, math.nan)
        places = np.array([math.nan if isinstance(one, str) else one.place.y_wheel
                           for one in found])
        for values in pressure.values():
            values[:-1][jumps(SWEEP, places)] = math.nan
        return pressure

    def free_rolling(self, case: Case) -> Tuple[float, float, float]:
        """The creepages of a wheelset that rolls freely where the case has it."""
        wheelset = self._wheelset_of(case)
        found = wheelset.solve(y=case.shift, yaw=case.yaw, roll=0.0, load=case.load,
                               wheels="right", speed=ROLLING_SPEED,
                               pitch_rate=-ROLLING_SPEED / RADIUS)
        contact = max(found.contacts, key=lambda contact: contact.load)
        return contact.cksi, contact.ceta, contact.cphi


def map_of(geometry: Geometry, case: Case, half: Tuple[float, float]) -> Array:
    """Forces over mu N over both creepages; nan where there are none."""
    cksi, ceta = (np.linspace(-one, one, MAP_POINTS) for one in half)
    found = solve_many(geometry.gap, load=geometry.load, mu=case.mu, estimate=False,
                       curved=case.is_curved, creepage=(cksi, ceta[:, None], case.cphi), threads=1)
    part = np.hypot(found.fx, found.fy) / (case.mu * geometry.load)
    return np.where(found.status < FIRST_ERROR, part, math.nan)


def straight(case: Case) -> Geometry:
    """Of a wheel without yaw: the gap about the rigid contact, as the program has it; no load."""
    gap = profile_gap(case.wheel.profile, case.rail.profile, shift=case.shift, radius=RADIUS,
                      inclination=case.inclination, roller_radius=case.roller_radius)
    place = Place(gap.y_rail, gap.y_wheel, gap.angle, 0.0)
    return Geometry((gap.y, gap.h, gap.inv2r, gap.inclination), 0.0, place, (place,), gap.radius)


def loaded(geometry: Geometry, case: Case) -> Geometry:
    """The same with the normal force of the case."""
    load = case.load / math.cos(geometry.place.angle) if case.is_vertical else case.load
    place = geometry.place._replace(load=load)
    return geometry._replace(load=load, place=place, places=(place,))


def half_width(axis: str, value: float) -> float:
    """Half the width of a creep curve that holds a creepage."""
    widths = WIDTHS[axis]
    return next((width for width in widths if abs(value) <= 0.8 * width), 1.25 * widths[-1])
