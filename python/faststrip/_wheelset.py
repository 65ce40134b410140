"""Wheelsets on a track: from position and velocity to the forces of every contact."""

from __future__ import annotations

import ctypes
import operator
from ctypes import c_double, c_int, c_size_t
from dataclasses import dataclass, field, fields
from typing import Any, ClassVar, Dict, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._arguments import above_zero, flag, number, numbers, refused, several, whole
from ._catalogue import Row, members
from ._contact import (
    MOST_STRIPS,
    Material,
    fetch,
    new_case,
    number_of,
    slopes,
    strip_wear,
    take_material,
    want,
)
from ._library import (
    FIRST_ERROR,
    TOO_SMALL,
    FaststripError,
    Handle,
    bad_argument,
    library,
    limitation_words,
    said,
    told,
    warn_of_doubts,
    word_of,
)
from ._lookup import order_number
from ._lookup_wheel import WheelLookup
from ._profile import Points, Profile, grown, inclination_of, points_of, spacing_of
from ._record import Record, Table, described
from ._results import Elements, Strips
from ._wear import (
    CONSTANT,
    Flash,
    Friction,
    StripWear,
    Thermal,
    Wear,
    WearLaw,
    WearQuestion,
    take_flash,
    take_friction,
    take_thermal,
    temperatures,
)

Array = npt.NDArray[np.float64]
WHEELS = {"both": 0, "right": 1, "left": 2}
SIDES = "right", "left"
# Components of what a contact has several numbers of.
AXES = {"place": "xyz", "rail": "yz", "wheel": "xyz", "force": "xyz", "force_wheelset": "xyz",
        "moment": "xyz"}
MOST_CONTACTS = 16
STEEL = Material()
BY_POSITION, BY_LOADS, BY_AXLE_LOAD, AT_REST = 0, 1, 2, 3

# FASTSTRIP_LOCKED_WHEELS of the header.
LOCKED_WHEELS = 1e300


class Setup(ctypes.Structure):
    """``faststrip_wheelset_setup`` of the header."""

    _fields_ = [("size", c_size_t), *members(
        c_double, "radius_right", "radius_left", "back_spacing", "tread_line", "gauge",
        "gauge_depth", "rail_distance", "inclination", "roller_radius", "damping",
        "speed_floor", "rail_stiffness_y", "rail_stiffness_z")]


class Rail(ctypes.Structure):
    """``faststrip_rail_state`` of the header."""

    _fields_ = members(c_double, "y", "z", "roll", "y_rate", "z_rate", "roll_rate")


class State(ctypes.Structure):
    """``faststrip_wheelset_state`` of the header."""

    _fields_ = [*members(c_double, "y", "z", "roll", "yaw", "speed", "y_rate", "z_rate",
                         "roll_rate", "yaw_rate", "pitch_rate", "curvature"),
                *members(Rail, "right_rail", "left_rail"),
                ("pitch_rate_difference", c_double)]


class Demand(ctypes.Structure):
    """``faststrip_wheelset_demand`` of the header."""

    _fields_ = [*members(c_int, "kind", "wheels", "roll_is_free", "warm_start"),
                *members(c_double, "load_right", "load_left", "axle_load", "roll_moment",
                         "axle_moment"),
                ("axle_moment_is_given", c_int)]


FIGURES = ("load", "penetration", "area", "pmax", "y_min", "y_max", "x_max", "fx", "fy", "mz",
           "friction_power", "stick_fraction")


class Totals(ctypes.Structure):
    """``faststrip_wheelset_result`` of the header."""

    _fields_ = [*members(c_int * 2, "status", "n_contacts", "n_solutions"),
                ("z", c_double * 2), ("roll", c_double),
                *members(c_double * 3 * 2, "force", "force_wheelset", "moment"),
                ("pitch_rate", c_double)]


@dataclass(frozen=True)
class RailState:
    """How a rail lies and moves beside its place, as irregularities of the track have it.

    Attributes
    ----------
    y, z : float
        To the right and down, mm.
    roll : float
        Right side down, about the origin of its profile, rad.
    y_rate, z_rate : float
        mm/s.
    roll_rate : float
        rad/s.
    """

    y: float = 0.0
    z: float = 0.0
    roll: float = 0.0
    y_rate: float = 0.0
    z_rate: float = 0.0
    roll_rate: float = 0.0


IN_PLACE = RailState()


def rail_of(name: str, rail: Any) -> Rail:
    """A rail's state as the library takes it."""
    if not isinstance(rail, RailState):
        raise bad_argument(f"{name} must be a RailState")
    names = [field.name for field in fields(RailState)]
    return Rail(*numbers([f"{name}.{one}" for one in names],
                          [getattr(rail, one) for one in names]))


@described
@dataclass(frozen=True)
class WheelContact(Record):
    """One contact of a wheel; forces and moments act on the rail.

    Estimated errors are None where they are not known, as of a `Result`.

    Attributes
    ----------
    side : str
        ``right`` or ``left``.
    word : str
        ``ok``, or the name of a limitation.
    place : three floats
        x, y, z of the reference point in the track, mm.
    rail : two floats
        y, z of it on the rail's profile, mm.
    wheel : three floats
        x, y, z of it in the frame of the wheel's profile, mm.
    <figures>
    force : three floats
        In the track, N.
    force_wheelset : three floats
        The same in the wheelset's frame, N.
    moment : three floats
        About the wheelset's centre, in the track, N mm.
    limitations : tuple of str
        All of them, of which `word` is the first.
    """

    side: str
    word: str
    n_patches: int
    strips_across: int
    place: Tuple[float, ...]
    contact_angle: float
    rail: Tuple[float, ...]
    wheel: Tuple[float, ...]
    radius: float
    speed: float
    cksi: float
    ceta: float
    cphi: float
    # BEGIN figures, written by tools/generate/columns.py
    load: float
    penetration: float
    area: float
    pmax: float
    y_min: float
    y_max: float
    x_max: float
    fx: float
    fy: float
    mz: float
    friction_power: float
    stick_fraction: float
    # END figures
    force: Tuple[float, ...]
    force_wheelset: Tuple[float, ...]
    moment: Tuple[float, ...]
    # BEGIN errors, written by tools/generate/columns.py
    est_err_penetration: Optional[float]
    est_err_pmax: Optional[float]
    est_err_area: Optional[float]
    est_err_fx: Optional[float]
    est_err_fy: Optional[float]
    est_err_mz: Optional[float]
    # END errors
    est_err_load: float
    limitations: Tuple[str, ...]


_MOTION = operator.attrgetter("radius", "speed", "cksi", "ceta", "cphi", *FIGURES)
_ESTIMATES = operator.attrgetter("est_err_penetration", "est_err_pmax", "est_err_area")
_FORCE_ERRORS = operator.attrgetter("est_err_fx", "est_err_fy", "est_err_mz")
_NONE = (None,) * 3


def _contact_of(row: Row) -> WheelContact:
    figures: Tuple[Any, ...] = (
        SIDES[row.side - 1], word_of(row.status), row.n_patches, row.strips_across,
        tuple(row.place), row.angle, tuple(row.rail), tuple(row.wheel), *_MOTION(row),
        tuple(row.force), tuple(row.force_wheelset), tuple(row.moment),
        *(_ESTIMATES(row) if row.is_estimated else _NONE),
        *(_FORCE_ERRORS(row) if row.forces_are_estimated else _NONE), row.est_err_load,
        limitation_words(row.limitations))
    return WheelContact(*figures)


def pitch_rate_number(rate: Optional[float]) -> float:
    """What the header's state has for a pitch rate: 0 for one that is not given."""
    return 0.0 if rate is None else number("pitch_rate", rate) or LOCKED_WHEELS


def setup_of(wheel: Any, rail: Any, wheel_left: Any, rail_left: Any, radius: Any, radius_left: Any,
             back_spacing: Any, tread_line: Any, gauge: Any, gauge_depth: Any, rail_distance: Any,
             inclination: Any, cant: Any) -> Tuple[Setup, Any, Any]:
    """Dimensions and profiles as the library takes them."""
    left = radius if radius_left is None else radius_left
    distance = 0.0 if rail_distance is None else above_zero("rail_distance", rail_distance)
    setup = Setup(ctypes.sizeof(Setup), *numbers(
        ("radius", "radius_left", "back_spacing", "tread_line", "gauge", "gauge_depth",
         "rail_distance", "inclination"),
        (radius, left, spacing_of(back_spacing), tread_line, gauge, gauge_depth, distance,
         inclination_of(inclination, cant))))
    wheels = (Points * 2)(points_of("wheel", wheel, "wheel"), Points() if wheel_left is None
                          else points_of("wheel_left", wheel_left, "wheel"))
    rails = (Points * 2)(points_of("rail", rail, "rail"), Points() if rail_left is None
                         else points_of("rail_left", rail_left, "rail"))
    return setup, wheels, rails


@dataclass(frozen=True)
class WheelsetResult(Table):
    """What came of both wheels, right and left; zero for one that was not asked for.

    Attributes
    ----------
    status : int
        0, or the number of a named limitation.
    word : str
        ``ok``, or the name of the limitation.
    contacts : tuple of WheelContact
        Those of the right wheel first.
    z : two floats
        Height of the wheelset's centre, down, mm, as each wheel has it.
    roll : float
        Right wheel down, rad.
    force : ndarray of float, shape (2, 3)
        Of each wheel on its rail, in the track, N.
    force_wheelset : ndarray of float, shape (2, 3)
        The same in the wheelset's frame, N.
    moment : ndarray of float, shape (2, 3)
        About the wheelset's centre, in the track, N mm.
    n_solutions : two ints
        Contact problems that were solved for each wheel.
    pitch_rate : float
        As given, of pure rolling, or found, rad/s.
    derivatives : ndarray of float, shape (2, 6, 9), or None
        Where they were asked for: of force and moment, x, y, z each, over y, z, roll, yaw and
        y_rate, z_rate, roll_rate, yaw_rate, pitch_rate, in N, N mm over mm, rad and per s; all
        other things stay. Zeros in the air, and over the rates at rest; nan of a wheel where
        its contacts or patches come or go.
    """

    status: int
    word: str
    contacts: Tuple[WheelContact, ...]
    z: Tuple[float, ...]
    roll: float
    force: Array
    force_wheelset: Array
    moment: Array
    n_solutions: Tuple[int, ...]
    pitch_rate: float
    derivatives: Optional[Array] = field(default=None, compare=False, repr=False)
    _rows: ClassVar[str] = "contact"

    def _columns(self) -> Dict[str, Any]:
        """Those of the contacts; vectors have one for each component, ``force_x`` and so on."""
        columns: Dict[str, Any] = {}
        for name in (one.name for one in fields(WheelContact)):
            values = [getattr(contact, name) for contact in self.contacts]
            axes = AXES.get(name)
            if axes is not None:
                for k, axis in enumerate(axes):
                    columns[f"{name}_{axis}"] = [value[k] for value in values]
            elif name.startswith("est_err"):
                columns[name] = [float("nan") if value is None else value for value in values]
            elif name == "limitations":
                columns[name] = [" ".join(words) for words in values]
            else:
                columns[name] = values
        return columns


def _counted(contact: Any) -> int:
    return whole("contact", contact, 0, MOST_CONTACTS)


def _made_again(made_of: Dict[str, Any], data: bytes) -> Wheelset:
    """A Wheelset of its arguments and its memory."""
    wheelset = Wheelset(**made_of)
    wheelset.restore(data)
    return wheelset


class Wheelset:
    """A wheelset on its track: profiles, dimensions, methods, the last solution.

    Use one Wheelset per thread.

    Parameters
    ----------
    wheel, rail : str or Profile
        A `Profile` or a name (``s1002``, ``cone20``, ``cone40``; ``uic60``, ``60e1``, ``54e1``),
        for both sides as one of the right side.
    wheel_left, rail_left : str or Profile, optional
        Of the left side; alike by default.
    radius, radius_left : float
        Rolling radii at the nominal rolling circle, mm; alike by default.
    back_spacing : float, optional
        Distance of the flange backs, mm; unless said that which belongs to the gauge: 1360 to 1435,
        1440 to 1520.
    tread_line : float
        From the flange back to the nominal rolling circle, mm.
    gauge, gauge_depth : float
        Gauge, and how far below the crown it is measured, mm.
    rail_distance : float, optional
        Of the origins of the rails' profiles, mm, in the gauge's place.
    inclination : float, optional
        Rail inclination: the tangent by which both rails lean to the track's centre. Unless said
        0.025 (1:40) for names; a Profile must have one: 0 where its points lie as in the track.
    cant : float, optional
        The same, by its older name.
    roller_radius : float
        Of rollers in the rails' place, on one axis along y, mm: at z = 0 of the track, the crown
        where the gauge counts. The speed of a state is that of their surface there. 0: rails.
    damping : float
        Of contacts, s/mm: forces grow by this share of the approach rate, never below 0; that of
        Hunt and Crossley, 3/2 alpha.
    speed_floor : float
        Of rolling speeds, mm/s: well below it friction grows with the slip velocities, so that it
        vanishes at rest.
    rail_stiffness : two floats
        Of springs below each rail, along y and z, N/mm; 0 is rigid. Such a rail has no mass: it is
        displaced, beside where ``solve`` has it, by the force over the stiffness.
    mu : float
        Coefficient of friction.
    friction, material, normal, tangential, strips_per_patch, points_per_strip, fastsim_grid, \
with_elements, estimate, resolution_limit, force_limit, curved, target, tolerance, budget_us, \
thermal
        As of `Contact` and `Contact.solve`.

    Examples
    --------
    >>> result = Wheelset(mu=0.4).solve(y=3.0, yaw=2e-3, speed=2e4, pitch_rate=-2e4 / 460.0,
    ...                                 axle_load=1.2e5)
    >>> [contact.side for contact in result.contacts], round(result.force[:, 2].sum())
    (['right', 'left'], 120000)
    """

    def __init__(self, wheel: Union[str, Profile] = "s1002", rail: Union[str, Profile] = "60e1", *,
                 wheel_left: Union[None, str, Profile] = None,
                 rail_left: Union[None, str, Profile] = None, radius: float = 460.0,
                 radius_left: Optional[float] = None, back_spacing: Optional[float] = None,
                 tread_line: float = 70.0, gauge: float = 1435.0, gauge_depth: float = 14.0,
                 rail_distance: Optional[float] = None, inclination: Optional[float] = None,
                 cant: Optional[float] = None, roller_radius: float = 0.0, damping: float = 0.0,
                 speed_floor: float = 0.0,
                 rail_stiffness: Tuple[float, float] = (0.0, 0.0), mu: float = 0.3,
                 friction: Friction = CONSTANT, material: Material = STEEL, normal: str = "strip",
                 tangential: str = "faststrip", strips_per_patch: int = 15,
                 points_per_strip: int = 15, fastsim_grid: Tuple[int, int] = (50, 50),
                 with_elements: bool = False, estimate: bool = True, resolution_limit: float = 0.1,
                 force_limit: float = 0.1, curved: bool = False, target: Optional[str] = None,
                 tolerance: Optional[float] = None, budget_us: Optional[float] = None,
                 thermal: Optional[Thermal] = None) -> None:
        self._made_of = {name: value for name, value in locals().items() if name != "self"}
        self._handle: Optional[Handle] = None
        self._lookup: Optional[Handle] = None
        self._n_contacts = 0
        case = new_case(normal, tangential, whole("strips_per_patch", strips_per_patch, 1,
                                                  MOST_STRIPS), points_per_strip, fastsim_grid,
                        estimate, resolution_limit, force_limit, curved)
        case.with_elements = flag("with_elements", with_elements)
        case.mu = number("mu", mu)
        take_friction(case, friction)
        take_thermal(case, thermal)
        take_material(case, material)
        want(case, target, tolerance, budget_us)
        setup, wheels, rails = setup_of(wheel, rail, wheel_left, rail_left, radius, radius_left,
                                        back_spacing, tread_line, gauge, gauge_depth,
                                        rail_distance, inclination, cant)
        setup.roller_radius = number("roller_radius", roller_radius)
        setup.damping = number("damping", damping)
        setup.speed_floor = number("speed_floor", speed_floor)
        setup.rail_stiffness_y, setup.rail_stiffness_z = numbers(
            ("rail_stiffness[0]", "rail_stiffness[1]"),
            several("rail_stiffness", rail_stiffness, "along y and z", (2,)))
        handle = Handle(library.faststrip_wheelset_free)
        told(library.faststrip_wheelset_new, ctypes.byref(setup), wheels, rails,
             ctypes.byref(case), ctypes.byref(handle.handle))
        self._handle = handle

    def close(self) -> None:
        """Give the memory back; the wheelset cannot be used afterwards."""
        self._handle = None

    def __enter__(self) -> Wheelset:
        return self

    def __exit__(self, *problem: object) -> None:
        self.close()

    def __reduce__(self) -> Any:
        if self._lookup is not None:
            raise TypeError("a Wheelset with a lookup table cannot be copied or pickled: take the "
                            "table out before")
        return _made_again, (self._made_of, self.save())

    def save(self) -> bytes:
        """What the next solution with ``warm_start`` depends on, as bytes that can be stored.

        `pickle` and `copy` keep it, too.

        Returns
        -------
        bytes
        """
        n = c_size_t()
        try:
            self._call(library.faststrip_wheelset_save, 0, ctypes.byref(n), None)
        except FaststripError as problem:
            if problem.status != TOO_SMALL:
                raise
        room = ctypes.create_string_buffer(n.value)
        self._call(library.faststrip_wheelset_save, n, ctypes.byref(n), room)
        return room.raw

    def restore(self, data: bytes) -> None:
        """Take over what was saved: the next solution has the bits of the one after `save`.

        Of the last solution nothing can be asked afterwards: no strips, wear or derivatives.

        Parameters
        ----------
        data : bytes
            Of `save`, of a Wheelset that was made alike, in this process or before.

        Raises
        ------
        FaststripError
            Where they are cut, damaged, of another version or of another wheelset.
        """
        if not isinstance(data, bytes):
            raise refused("data", "bytes", data)
        self._call(library.faststrip_wheelset_restore, len(data), data)
        self._n_contacts = 0

    def use_lookup(self, table: Optional[WheelLookup], *, order: str = "cubic") -> None:
        """Let a table answer where it reaches; strips do beyond its ends.

        A wheel that rolls by more than 5e-4 rad over its rail is beyond, too. Before an end both
        share the forces, so that none jumps. A wheel that it alone answers for has an
        ``n_solutions`` of 0, and contacts without ends, strips and estimates.

        Parameters
        ----------
        table : WheelLookup, optional
            Of the wheel and rail, which three of its nodes are solved for; None: strips alone.
        order : str
            ``cubic`` or ``linear``.

        Raises
        ------
        FaststripError
            If it is another wheel's, or both wheels are not alike.
        """
        if not isinstance(table, (WheelLookup, type(None))):
            raise refused("table", "a WheelLookup or None", table)
        held = None if table is None else table._table
        self._call(library.faststrip_wheelset_use_lookup,
                   None if held is None else held.handle, order_number(order))
        # It stays open as long as it is asked.
        self._lookup = held

    def solve(self, *, y: float = 0.0, z: Optional[float] = None, roll: Optional[float] = None,
              yaw: float = 0.0, speed: float = 0.0, y_rate: float = 0.0, z_rate: float = 0.0,
              roll_rate: float = 0.0, yaw_rate: float = 0.0,
              pitch_rate: Optional[float] = None, pitch_rate_difference: float = 0.0,
              curvature: float = 0.0, load: Union[None, float, Tuple[float, float]] = None,
              axle_load: Optional[float] = None, roll_moment: float = 0.0,
              axle_moment: Optional[float] = None, wheels: str = "both",
              at_rest: bool = False, warm_start: bool = False, right_rail: RailState = IN_PLACE,
              left_rail: RailState = IN_PLACE, derivatives: bool = False) -> WheelsetResult:
        """Solve for a position z, a load of each wheel or an axle_load: one of the three.

        Parameters
        ----------
        y : float
            To the right, mm.
        z : float
            Height of the wheelset's centre, down, mm; 0 where the rolling circles are as high as
            the crowns, which is not where it rests: ``at_rest`` gives that.
        roll : float
            Right wheel down, rad. Not given it is found, of both wheels and their loads; else it
            is 0.
        yaw : float
            Nose to the right, rad.
        speed : float
            mm/s; below 0 the wheelset rolls backwards.
        y_rate, z_rate : float
            mm/s.
        roll_rate, yaw_rate, pitch_rate : float
            rad/s; pitch_rate is negative for rolling ahead, not given it is that of pure rolling
            at the mean nominal radius, 0 is that of locked wheels.
        pitch_rate_difference : float
            Of wheels that rotate independently: left less right, rad/s; pitch_rate is the mean.
        curvature : float
            Of the track, positive to the right, 1/mm.
        load : float, or two floats
            Of each wheel, or of the right and of the left one, N.
        axle_load : float
            N.
        roll_moment : float
            What the frame exerts about the wheelset's centre, N mm.
        axle_moment : float
            Traction torque or braking moment about the axle on the wheelset, which the wheels asked
            for carry together, N mm: negative drives ahead. Not with a pitch_rate, which is found.
        wheels : str
            ``both``, ``right`` or ``left``.
        at_rest : bool
            With an axle_load: static equilibrium, z and roll are found. Speed and rates do not
            count, and there are no friction forces.
        warm_start : bool
            Begin with the last solution, if there is one.
        right_rail, left_rail : RailState
            Where the rails lie beside their places, and how they move.
        derivatives : bool
            Are those over position and velocity wanted, too? Not of ``auto`` and references.

        Returns
        -------
        WheelsetResult

        Notes
        -----
        Where nothing rolls but something slides, all of the contact slides; where nothing moves
        there are no friction forces.

        Raises
        ------
        FaststripError
            Where there is no result.
        """
        if sum(value is not None for value in (z, load, axle_load)) != 1:
            raise bad_argument("one of z, load and axle_load must be given")
        demand = Demand(wheels=number_of(WHEELS, wheels, "wheels"),
                        warm_start=flag("warm_start", warm_start),
                        roll_moment=number("roll_moment", roll_moment))
        if flag("at_rest", at_rest) and (axle_load is None or roll is not None):
            raise bad_argument("at_rest is for an axle_load, with a roll that is found")
        if axle_moment is not None:
            demand.axle_moment_is_given = 1
            demand.axle_moment = number("axle_moment", axle_moment)
        if axle_load is not None:
            demand.kind = AT_REST if at_rest else BY_AXLE_LOAD
            demand.axle_load = number("axle_load", axle_load)
        elif load is not None:
            loads = (load, load) if np.ndim(load) == 0 else several("load", load,
                                                                    "right and left", (2,))
            demand.kind = BY_LOADS
            demand.load_right, demand.load_left = numbers(("load[0]", "load[1]"), loads)
        demand.roll_is_free = roll is None and z is None and demand.wheels == 0
        given = (y, z or 0.0, roll or 0.0, yaw, speed, y_rate, z_rate, roll_rate, yaw_rate,
                 pitch_rate_number(pitch_rate), curvature)
        state = State(*numbers([field[0] for field in State._fields_[:len(given)]], given),
                      rail_of("right_rail", right_rail), rail_of("left_rail", left_rail),
                      number("pitch_rate_difference", pitch_rate_difference))
        rows, totals, n = (Row * MOST_CONTACTS)(), Totals(), c_int()
        self._n_contacts = 0
        try:
            status = self._call(library.faststrip_wheelset_solve, ctypes.byref(state),
                                ctypes.byref(demand), MOST_CONTACTS, ctypes.byref(n), rows,
                                ctypes.byref(totals))
        finally:
            if self._handle is not None:
                warn_of_doubts(self._handle.handle)
        self._n_contacts = n.value
        return WheelsetResult(
            status, word_of(status), tuple(map(_contact_of, rows[:n.value])), tuple(totals.z),
            totals.roll, np.array(totals.force), np.array(totals.force_wheelset),
            np.array(totals.moment), tuple(totals.n_solutions), totals.pitch_rate,
            slopes(self._call, library.faststrip_wheelset_get_derivatives, (2, 6, 9))
            if flag("derivatives", derivatives) else None)

    def wear(self, law: Optional[WearLaw] = None, *,
             yield_shear: Optional[float] = None) -> Tuple[Wear, ...]:
        """T gamma, wear and fatigue of the contacts of the last solution.

        Parameters
        ----------
        law, yield_shear
            As of `Contact.wear`.

        Returns
        -------
        tuple of Wear
            In the order of the contacts.
        """
        found = []
        for i in range(self._n_contacts):
            question = WearQuestion(law, yield_shear)
            self._call(library.faststrip_wheelset_get_wear, i, question.law, question.yield_shear,
                       question.figures)
            found.append(question.answer())
        return tuple(found)

    def strips(self, contact: int) -> Strips:
        """The strips of a contact of the last solution, y from its place.

        Parameters
        ----------
        contact : int
            Counted from 0, those of the right wheel first.

        Returns
        -------
        Strips
        """
        return Strips(*fetch(self._call, library.faststrip_wheelset_get_strips, 4,
                             _counted(contact)))

    def elements(self, contact: int) -> Elements:
        """The elements of a contact of the last solution, x and y from its place.

        Parameters
        ----------
        contact : int
            Counted from 0, those of the right wheel first.

        Returns
        -------
        Elements
            Empty unless the Wheelset was made with_elements.
        """
        return Elements(*fetch(self._call, library.faststrip_wheelset_get_elements, 8,
                               _counted(contact)))

    def flash(self) -> Tuple[Flash, ...]:
        """Largest rises and temperatures of the contacts of the last solution, with a thermal.

        Returns
        -------
        tuple of Flash
            In the order of the contacts.
        """
        return tuple(take_flash(self._call, library.faststrip_wheelset_get_flash, i)
                     for i in range(self._n_contacts))

    def temperatures(self, contact: int, x: npt.ArrayLike,
                     y: npt.ArrayLike) -> Tuple[Array, Array]:
        """Temperatures of both surfaces of a contact of the last solution.

        Parameters
        ----------
        contact : int
            Counted from 0, those of the right wheel first.
        x, y : array_like
            Places, mm, in the frame of `elements`.

        Returns
        -------
        wheel, rail : ndarray of float
            As of `Contact.temperatures`.
        """
        return temperatures(self._call, library.faststrip_wheelset_get_temperatures, x, y,
                            _counted(contact))

    def strip_wear(self, contact: int, law: Optional[WearLaw] = None) -> StripWear:
        """Forces and wear of the strips of a contact of the last solution.

        Parameters
        ----------
        contact : int
            Counted from 0, those of the right wheel first.
        law : WearLaw, optional
            Without one there are forces alone.

        Returns
        -------
        StripWear
            In the order of `strips`.

        Raises
        ------
        FaststripError
            Where tangential is not ``faststrip`` or ``faststrip-plain``.
        """
        return strip_wear(self._call, library.faststrip_wheelset_get_strip_wear,
                          len(self.strips(contact).p0), law, _counted(contact))

    def gap(self, contact: int) -> Tuple[Array, Array, Array, Array]:
        """The gap of a contact of the last solution about its place, for `Contact.set_gap`.

        Parameters
        ----------
        contact : int
            Counted from 0, those of the right wheel first.

        Returns
        -------
        y, h, inv2r, inclination : ndarray of float, shape (n,)
            mm, mm, 1/mm, rad.
        """
        (y, h, inv2r, inclination), _ = grown(4, lambda *room: self._call(
            library.faststrip_wheelset_get_gap, _counted(contact), *room))
        return y, h, inv2r, inclination

    def copy_from(self, other: "Wheelset") -> None:
        """Become another wheelset with its last solution, for a step taken back.

        Parameters
        ----------
        other : Wheelset
            It stays as it is.
        """
        if not isinstance(other, Wheelset):
            raise refused("other", "a Wheelset", other)
        if other is self:
            return
        if self._handle is None:
            raise bad_argument("the wheelset is closed")
        other._call(library.faststrip_wheelset_copy, self._handle.handle)
        self._n_contacts = other._n_contacts
        self._lookup = other._lookup

    def _call(self, function: Any, *arguments: Any) -> int:
        handle = self._handle
        if handle is None:
            raise bad_argument("the wheelset is closed")
        if not handle.in_use.acquire(False):
            raise bad_argument("the wheelset is in use by another thread")
        try:
            status = function(handle.handle, *arguments)
            if status >= FIRST_ERROR:
                words = said(library.faststrip_wheelset_last_message, handle.handle)[1]
                raise FaststripError(status, word_of(status), words)
            return status
        finally:
            handle.in_use.release()
