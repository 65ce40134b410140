"""Profiles: read from files, drawn, and made into gaps by the library."""

from __future__ import annotations

import ctypes
import dataclasses
import math
import os
import pathlib
from ctypes import c_double, c_int
from typing import Any, Callable, ClassVar, Dict, Optional, Tuple, TypeVar, Union

import numpy as np
import numpy.typing as npt

from ._arguments import above_zero, flag, from_zero, number, numbers, refused, several, whole
from ._catalogue import members
from ._library import TOO_SMALL, FaststripError, check, library, told
from ._record import Shown, Table

Array = npt.NDArray[np.float64]
Path = Union[str, "os.PathLike[str]"]
FIRST_CAPACITY = 4000
MOST_POINTS = 1000000
# What the library takes for an inclination of which nothing is said: 1:40 of a name, an error of
# points.
UNSET_INCLINATION = 999.0
# Profiles that the library knows by name.
NAMES = {"wheel": ("s1002", "cone20", "cone40"), "rail": ("uic60", "60e1", "54e1")}
KINDS = "unknown", "wheel", "rail"
UM = 1e-3  # mm
MOST_SECTIONS = 2**31 - 1
Choice = TypeVar("Choice", int, float)


class Points(ctypes.Structure):
    """``faststrip_profile`` of the header."""

    _fields_ = [("name", ctypes.c_char_p), ("y", ctypes.c_void_p), ("z", ctypes.c_void_p),
                ("n", ctypes.c_int)]


class Reading(ctypes.Structure):
    """``faststrip_reading`` of the header."""

    _fields_ = [
        ("size", ctypes.c_size_t),
        *members(c_int, "kind", "section", "side", "y_sense", "z_sense", "any_count",
                 "ignore_smoothing", "has_tape_circle", "keeps", "drops_folds", "mirrors",
                 "rounds_kinks"),
        *members(c_double, "unit", "tape_circle"), ("keep", c_double * 2),
        ("drop_double", c_double), ("shift", c_double * 2),
        *members(c_double, "turn", "smooth_wavelength", "smooth_noise", "resample", "kink_angle"),
    ]


class About(ctypes.Structure):
    """``faststrip_profile_about`` of the header."""

    _fields_ = [*members(c_int, "kind", "has_flange"), *members(c_double, "sd", "sh", "qr"),
                ("format", ctypes.c_char * 16)]


@dataclasses.dataclass(frozen=True)
class Gap(Table):
    """The gap of two profiles about their contact, for ``Contact.set_gap(*gap[:4])``.

    Attributes
    ----------
    y : ndarray of float, shape (n,)
        Lateral coordinate from the contact, mm.
    h : ndarray of float, shape (n,)
        Gap on the line x = 0, mm.
    inv2r : ndarray of float, shape (n,)
        1/(2 R) with the local radius R along x, 1/mm.
    inclination : ndarray of float, shape (n,)
        How far the surfaces have turned from the tangent plane at y = 0, rad.
    angle : float
        Contact angle, rad.
    radius : float
        Rolling radius at the contact, mm.
    y_wheel, y_rail : float
        Place of the contact on the wheel and on the rail, mm.
    n_clipped : two ints
        Points left out of the wheel and of the rail.
    """

    y: Array
    h: Array
    inv2r: Array
    inclination: Array
    angle: float
    radius: float
    y_wheel: float
    y_rail: float
    n_clipped: Tuple[int, int]
    _rows: ClassVar[str] = "y"

    def _columns(self) -> Dict[str, Any]:
        return {"y": self.y, "h": self.h, "inv2r": self.inv2r, "inclination": self.inclination}

    def plot(self, axes: Any = None) -> Any:
        """Draw the gap on the line x = 0.

        Parameters
        ----------
        axes : matplotlib.axes.Axes
            To draw on; new ones unless given.

        Returns
        -------
        matplotlib.axes.Axes
        """
        from ._plot import plot_lines

        return plot_lines(axes, self.y, {"": self.h}, "lateral $y$ from the contact, mm",
                          "gap at $x$ = 0, mm")


@dataclasses.dataclass
class Profile(Shown):
    """A profile: points along its curve.

    Parameters
    ----------
    y, z : array_like, shape (n,)
        To the field side, of a wheel from its nominal rolling circle, and down, mm.
    kind : str
        ``wheel``, ``rail`` or ``unknown``.
    path, format : str
        The file that they were read from, and what it is.
    message : str
        What was left out or mended when it was read; empty if nothing.
    sd, sh, qr : float, optional
        Thickness, height and steepness of a wheel's flange, mm, measured on the points: what a
        file's header says of them is not taken over.
    """

    y: Array
    z: Array
    kind: str = "unknown"
    path: str = ""
    format: str = ""
    message: str = ""
    sd: Optional[float] = None
    sh: Optional[float] = None
    qr: Optional[float] = None

    def __post_init__(self) -> None:
        self.y = np.ascontiguousarray(self.y, dtype=float)
        self.z = np.ascontiguousarray(self.z, dtype=float)
        if self.y.ndim != 1 or self.y.shape != self.z.shape:
            raise refused("y and z", "two arrays of one length", (self.y.shape, self.z.shape))

    @classmethod
    def read(cls, path: Path, *, kind: Optional[str] = None, section: Optional[int] = None,
             side: str = "right", y_positive_to: Optional[str] = None,
             z_positive_to: Optional[str] = None, unit: Optional[str] = None,
             any_count: bool = False, ignore_smoothing: bool = False,
             tape_circle: Optional[float] = None, keep: Optional[Tuple[float, float]] = None,
             drop_double: Optional[float] = None, drop_folds: bool = False, mirror: bool = False,
             shift_y: float = 0.0, shift_z: float = 0.0, rotate: float = 0.0, cant: float = 0.0,
             smooth_wavelength: Optional[float] = None, smooth_noise: Optional[float] = None,
             resample: Optional[float] = None, kink_angle: Optional[float] = None,
             round_kinks: bool = False) -> "Profile":
        """Read a file of any format that ``faststrip profile`` knows.

        Nothing is repaired unasked; what is asked for is done in the order of the options.

        Parameters
        ----------
        path : str or path
            The file.
        kind : str
            ``wheel`` or ``rail``, where the file does not say.
        section : int
            Which one, of a file with several.
        side : str
            ``right`` or ``left``, of a file with both.
        y_positive_to : str
            ``field`` or ``gauge``: the sense of y in the file.
        z_positive_to : str
            ``down`` or ``up``: the sense of z in the file.
        unit : str
            ``mm``, ``m`` or ``in``: the unit of the file.
        any_count : bool
            Take a number of points that the header denies?
        ignore_smoothing : bool
            Pass over the smoothing that a file asks for?
        tape_circle : float
            Where the nominal rolling circle of a wheel is, in y of the file, mm.
        keep : two floats
            Range of y of the points that are kept, mm.
        drop_double : float
            Drop points no farther from the one before, mm; 0: those in one place.
        drop_folds : bool
            Drop points in which the profile turns back?
        mirror : bool
            Mirror y?
        shift_y, shift_z : float
            Shift along y and z, mm.
        rotate : float
            Turn about the origin, from y to z, degrees.
        cant : float
            Tangent by which a rail is turned so that its top leans to the gauge side.
        smooth_wavelength : float
            Halve waves of this length, remove shorter ones, mm.
        smooth_noise : float
            Smooth for this standard deviation of the points, um.
        resample : float
            Points at this distance along the profile, mm.
        kink_angle : float
            What turns by more in one point is a kink, degrees; 20 by default.
        round_kinks : bool
            Smooth and resample over kinks?

        Returns
        -------
        Profile

        Raises
        ------
        FaststripError
            ``file_missing``, ``file_format``, ``too_few_points`` and others, with the file, the
            line and the value.
        """
        reading = Reading()
        check(library.faststrip_default_reading(ctypes.byref(reading), ctypes.sizeof(Reading)))
        reading.kind = _choice("kind", kind, {None: 0, "wheel": 1, "rail": 2})
        reading.section = 0 if section is None else whole("section", section, 1, MOST_SECTIONS)
        reading.side = _choice("side", side, {"right": 1, "left": -1})
        reading.y_sense = _choice("y_positive_to", y_positive_to, {None: 0, "field": 1,
                                                                   "gauge": -1})
        reading.z_sense = _choice("z_positive_to", z_positive_to, {None: 0, "down": 1, "up": -1})
        reading.unit = _choice("unit", unit, {None: 0.0, "mm": 1.0, "m": 1000.0, "in": 25.4})
        reading.any_count = flag("any_count", any_count)
        reading.ignore_smoothing = flag("ignore_smoothing", ignore_smoothing)
        if tape_circle is not None:
            reading.has_tape_circle = True
            reading.tape_circle = number("tape_circle", tape_circle)
        if keep is not None:
            reading.keeps = True
            reading.keep[:] = numbers(("keep[0]", "keep[1]"),
                                      several("keep", keep, "from and to", (2,)))
        if drop_double is not None:
            reading.drop_double = from_zero("drop_double", drop_double)
        reading.drops_folds = flag("drop_folds", drop_folds)
        reading.mirrors = flag("mirror", mirror)
        reading.shift[:] = numbers(("shift_y", "shift_z"), (shift_y, shift_z))
        reading.turn = math.radians(number("rotate", rotate)) - math.atan(number("cant", cant))
        for name, value, scale in (("smooth_wavelength", smooth_wavelength, 1.0),
                                   ("smooth_noise", smooth_noise, UM),
                                   ("resample", resample, 1.0),
                                   ("kink_angle", kink_angle, math.pi / 180.0)):
            if value is not None:
                setattr(reading, name, above_zero(name, value) * scale)
        reading.rounds_kinks = flag("round_kinks", round_kinks)
        return cls._read(os.fspath(path), reading)

    @classmethod
    def _read(cls, path: Any, reading: Reading) -> "Profile":
        name = os.fsencode(path)
        if b"\0" in name:
            raise refused("path", "the name of a file", path)
        about = About()
        (y, z), words = grown(2, lambda *room: told(
            library.faststrip_read_profile, name, ctypes.byref(reading), *room,
            ctypes.byref(about)))
        flange = (about.sd, about.sh, about.qr) if about.has_flange else (None, None, None)
        return cls(y, z, KINDS[about.kind], os.fsdecode(name), about.format.decode("ascii"), words,
                   *flange)

    def plot(self, axes: Any = None, **style: Any) -> Any:
        """Draw the points, z down.

        Parameters
        ----------
        axes : matplotlib.axes.Axes
            To draw on; new ones unless given.
        **style
            For ``axes.plot``.

        Returns
        -------
        matplotlib.axes.Axes
        """
        from ._plot import plot_profile

        return plot_profile(self, axes, style)


def _choice(name: str, value: Any, choices: Dict[Any, Choice]) -> Choice:
    """What one of some words stands for."""
    if value is not None and not isinstance(value, str) or value not in choices:
        raise refused(name, "one of " + ", ".join(word for word in choices if word), value)
    return choices[value]


def is_path(profile: Any) -> bool:
    """Is that the path of a file: by its form, or because there is one?"""
    return not isinstance(profile, str) or bool(
        pathlib.PurePath(profile).suffix or {"/", os.sep} & {*profile}
        or os.path.exists(profile))


def points_of(name: str, profile: Any, kind: str) -> Points:
    """A profile as the library takes it: a name, or points that have to be kept."""
    if isinstance(profile, (str, os.PathLike)):
        if str(profile).lower() not in NAMES[kind] and is_path(profile):
            raise refused(name, f"a Profile of a {kind} or a name ({', '.join(NAMES[kind])}); "
                          "Profile.read(path) reads one from a file", profile)
        return Points(str(profile).encode("ascii", "replace"))
    if not isinstance(profile, Profile) or profile.kind not in (kind, "unknown"):
        raise refused(name, f"a Profile of a {kind} or a name", profile)
    return Points(None, profile.y.ctypes.data, profile.z.ctypes.data, len(profile.y))


def inclination_of(inclination: Optional[float], cant: Optional[float]) -> float:
    """The rail inclination as the library takes it; cant is its older name."""
    if inclination is None and cant is None:
        return UNSET_INCLINATION
    if inclination is not None and cant is not None:
        raise refused("cant", "None where inclination, its name, is given", cant)
    name, value = ("inclination", inclination) if cant is None else ("cant", cant)
    said = number(name, value)
    if abs(said) > 1.0:
        raise refused(name, "a tangent, -1 to 1", value)
    return said


def spacing_of(back_spacing: Optional[float]) -> float:
    """The distance of the flange backs as the library takes it; 0 follows the gauge."""
    return 0.0 if back_spacing is None else above_zero("back_spacing", back_spacing)


def grown(rows: int, call: Callable[..., Any]) -> Tuple[Array, Any]:
    """Rows of as many numbers as a call has, and what it gives; it takes capacity, their number and
    the rows, and raises what is an error."""
    n, capacity = c_int(), FIRST_CAPACITY
    while True:
        arrays = np.zeros((rows, capacity))
        try:
            answer = call(capacity, ctypes.byref(n), *(row.ctypes.data for row in arrays))
            return arrays[:, :n.value].copy(), answer
        except FaststripError as problem:
            if problem.status != TOO_SMALL or n.value <= capacity:
                raise
            capacity = n.value


def profile_gap(wheel: Union[str, Profile], rail: Union[str, Profile], *, shift: float = 0.0,
                inclination: Optional[float] = None, cant: Optional[float] = None,
                radius: float = 460.0, back_spacing: Optional[float] = None,
                tread_line: float = 70.0, gauge: float = 1435.0, gauge_depth: float = 14.0,
                step: float = 0.05, height: float = 0.6, roller_radius: float = 0.0) -> Gap:
    """The gap of a right wheel on the right rail about their contact.

    Parameters
    ----------
    wheel, rail : str or Profile
        A name or a profile, as of a `Wheelset`.
    shift : float
        Of the wheelset to the right, mm.
    inclination : float, optional
        Rail inclination: the tangent by which the rail leans to the track's centre. Unless said
        0.025 (1:40) for a name; a Profile must have one: 0 where its points lie as in the track.
    cant : float, optional
        The same, by its older name.
    radius : float
        Rolling radius at the nominal rolling circle, mm.
    back_spacing : float, optional
        Distance of the flange backs, mm; unless said that which belongs to the gauge: 1360 to 1435,
        1440 to 1520.
    tread_line : float
        From the flange back to the nominal rolling circle, mm.
    gauge, gauge_depth : float
        Gauge, and how far below the crown it is measured, mm.
    step : float
        Between points of the gap, mm.
    height : float
        Up to which the gap is given, mm.
    roller_radius : float
        Of a roller in the rail's place, mm, at the crown; 0: a rail. The spin of a contact is
        larger on it, by the rolling radius over the roller's.

    Returns
    -------
    Gap

    Raises
    ------
    FaststripError
        Where they do not touch, or a profile is none.
    """
    sources = points_of("wheel", wheel, "wheel"), points_of("rail", rail, "rail")
    setup = np.array(numbers(
        ("back_spacing", "tread_line", "radius", "gauge", "gauge_depth", "inclination", "shift",
         "step", "height"),
        (spacing_of(back_spacing), tread_line, radius, gauge, gauge_depth,
         inclination_of(inclination, cant), shift, step, height)))
    contact = np.zeros(6)
    (y, h, inv2r, turned), _ = grown(4, lambda *room: told(
        library.faststrip_roller_gap, *map(ctypes.byref, sources), setup.ctypes.data,
        number("roller_radius", roller_radius), *room, contact.ctypes.data))
    angle, rolling_radius, y_wheel, y_rail, *clipped = contact.tolist()
    return Gap(y, h, inv2r, turned, angle, rolling_radius, y_wheel, y_rail,
               (int(clipped[0]), int(clipped[1])))


def draw_profile(profile: Union[str, Profile], kind: str, *, inclination: Optional[float] = None,
                 cant: Optional[float] = None, n: int = 401) -> Tuple[Array, Array]:
    """Points of what can be touched of a profile, at equal distances of y.

    Parameters
    ----------
    profile : str or Profile
        A name or a profile, as of a `Wheelset`.
    kind : str
        ``wheel`` or ``rail``.
    inclination, cant : float, optional
        Of a rail, as of `profile_gap`.
    n : int
        How many points, from 2 on.

    Returns
    -------
    y, z : ndarray of float, shape (n,)
        To the field side and down, mm.

    Examples
    --------
    >>> y, z = draw_profile("60e1", "rail", inclination=0.0, n=3)
    >>> y.round(3).tolist()
    [-37.15, 0.0, 37.15]
    """
    if kind not in ("wheel", "rail"):
        raise refused("kind", "wheel or rail", kind)
    source = points_of("profile", profile, kind)
    arrays = np.zeros((2, whole("n", n, 2, MOST_POINTS)))
    told(library.faststrip_draw_profile, ctypes.byref(source), kind == "rail",
         inclination_of(inclination, cant), n, *(row.ctypes.data for row in arrays))
    return arrays[0], arrays[1]
