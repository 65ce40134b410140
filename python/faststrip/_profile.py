"""Profiles: read from files by the program, drawn, and made into gaps by the library."""

from __future__ import annotations

import csv
import ctypes
import dataclasses
import os
import pathlib
import shutil
import subprocess
import tempfile
from typing import Any, ClassVar, Dict, Iterator, List, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._arguments import above_zero, number, numbers, refused, whole
from ._library import FIRST_ERROR, TEXT, TOO_SMALL, FaststripError, library, word_of
from ._record import Table

Array = npt.NDArray[np.float64]
Path = Union[str, "os.PathLike[str]"]
FILE_FORMAT = 121
FIRST_CAPACITY = 4000
MOST_POINTS = 1000000
# What the library takes for an inclination of which nothing is said: 1:40 of a name, an error of
# points.
UNSET_INCLINATION = 999.0


class Points(ctypes.Structure):
    """``faststrip_profile`` of the header."""

    _fields_ = [("name", ctypes.c_char_p), ("y", ctypes.c_void_p), ("z", ctypes.c_void_p),
                ("n", ctypes.c_int)]


class ProgramNotFound(ImportError):
    """There is no program faststrip where it was looked for; it reads the files."""


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


def _candidates() -> Iterator[str]:
    if "FASTSTRIP_PROGRAM" in os.environ:
        yield os.environ["FASTSTRIP_PROGRAM"]
        return
    if "FASTSTRIP_PREFIX" in os.environ:
        yield str(pathlib.Path(os.environ["FASTSTRIP_PREFIX"]) / "bin" / "faststrip")
        return
    yield str(pathlib.Path(library._name).parent.parent / "bin" / "faststrip")
    yield shutil.which("faststrip") or ""


def _program() -> str:
    tried = [name for name in _candidates() if name]
    for name in tried:
        if os.access(name, os.X_OK) and os.path.isfile(name):
            return name
    raise ProgramNotFound("no program faststrip: install it with ./run install --prefix FOLDER and "
                          "set FASTSTRIP_PREFIX to that folder, or FASTSTRIP_PROGRAM to the file; "
                          "tried " + (", ".join(tried) or "PATH"))


def _words(options: "dict[str, Any]") -> List[str]:
    """Options of the command line from keywords: ``tape_circle=73`` is ``--tape-circle 73``."""
    words = []
    for name, value in options.items():
        if value is None or value is False:
            continue
        words.append("--" + name.replace("_", "-"))
        if value is not True:
            words.append(",".join(map(repr, value)) if isinstance(value, (tuple, list))
                         else str(value))
    return words


@dataclasses.dataclass
class Profile:
    """A profile: points along its curve.

    Parameters
    ----------
    y, z : array_like, shape (n,)
        To the field side, of a wheel from its tape circle, and down, mm.
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
    def read(cls, path: Path, **options: Any) -> "Profile":
        """Read a file of any format that ``faststrip profile`` knows, by the program.

        Parameters
        ----------
        path : str or path
            The file.
        **options
            Those of the command line with underscores: ``kind="wheel"``, ``section=2``,
            ``unit="m"``, ``tape_circle=73``, ``any_count=True``, ``smooth_wavelength=2``,
            ``keep=(-30, 40)``...

        Returns
        -------
        Profile

        Raises
        ------
        FaststripError
            With the program's words for what is wrong with the file.
        ProgramNotFound
            Where there is no program.
        """
        with tempfile.TemporaryDirectory() as folder:
            points = pathlib.Path(folder) / "points.csv"
            done = subprocess.run([_program(), "profile", *_words(options), "-o", str(points),
                                   "--", os.fspath(path)], stdin=subprocess.DEVNULL,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                  encoding="utf-8", errors="replace", check=False)
            if done.returncode != 0:
                words = (done.stderr.strip().splitlines() or ["no words"])[-1]
                raise FaststripError(FILE_FORMAT, word_of(FILE_FORMAT),
                                     words[words.find(": ") + 2:])
            y, z = np.loadtxt(_data_lines(points.read_text(encoding="utf-8").splitlines()),
                              delimiter=",", unpack=True, ndmin=2, skiprows=1)
        row = next(csv.DictReader(_data_lines(done.stdout.splitlines())))
        measures = [float(row[name]) if row[name] else None
                    for name in ("Sd_mm", "Sh_mm", "qR_mm")]
        return cls(y, z, row["kind"], os.fspath(path), row["format"], row["message"], *measures)

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


def _data_lines(lines: Sequence[str]) -> List[str]:
    return [line for line in lines if not line.startswith("#")]


def points_of(name: str, profile: Any, kind: str) -> Points:
    """A profile as the library takes it: a name, or points that have to be kept."""
    if isinstance(profile, str):
        return Points(profile.encode("ascii", "replace"))
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


def _raise(status: int, text: Any) -> None:
    if status >= FIRST_ERROR:
        raise FaststripError(status, word_of(status), text.value.decode("ascii", "replace"))


def profile_gap(wheel: Union[str, Profile], rail: Union[str, Profile], *, shift: float = 0.0,
                inclination: Optional[float] = None, cant: Optional[float] = None,
                radius: float = 460.0, back_spacing: Optional[float] = None,
                tread_line: float = 70.0, gauge: float = 1435.0, gauge_depth: float = 14.0,
                step: float = 0.05, height: float = 0.6) -> Gap:
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
        Rolling radius at the tape circle, mm.
    back_spacing : float, optional
        Distance of the flange backs, mm; unless said that which belongs to the gauge: 1360 to 1435,
        1440 to 1520.
    tread_line : float
        From the flange back to the tape circle, mm.
    gauge, gauge_depth : float
        Gauge, and how far below the crown it is measured, mm.
    step : float
        Between points of the gap, mm.
    height : float
        Up to which the gap is given, mm.

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
    n, capacity, text = ctypes.c_int(), FIRST_CAPACITY, ctypes.create_string_buffer(TEXT)
    contact = np.zeros(6)
    while True:
        arrays = np.zeros((4, capacity))
        status = library.faststrip_pair_gap(
            *map(ctypes.byref, sources), setup.ctypes.data, capacity, ctypes.byref(n),
            *(row.ctypes.data for row in arrays), contact.ctypes.data, text, TEXT)
        if status != TOO_SMALL or n.value <= capacity:
            break
        capacity = n.value
    _raise(status, text)
    y, h, inv2r, inclination = arrays[:, :n.value].copy()
    angle, rolling_radius, y_wheel, y_rail, *clipped = contact.tolist()
    return Gap(y, h, inv2r, inclination, angle, rolling_radius, y_wheel, y_rail,
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
    text = ctypes.create_string_buffer(TEXT)
    status = library.faststrip_draw_profile(
        ctypes.byref(source), kind == "rail", inclination_of(inclination, cant), n,
        *(row.ctypes.data for row in arrays), text, TEXT)
    _raise(status, text)
    return arrays[0], arrays[1]
