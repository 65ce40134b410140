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
from typing import Any, Dict, Iterator, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._arguments import number, numbers, refused, whole
from ._library import FIRST_ERROR, TEXT, TOO_SMALL, FaststripError, library, word_of
from ._tables import dataset, extra, frame

Array = npt.NDArray[np.float64]
Path = Union[str, "os.PathLike[str]"]
FILE_FORMAT = 121
FIRST_CAPACITY = 4000
MOST_POINTS = 1000000
# Of drawn rails, which stand upright; measured ones are taken as they stand.
STANDARD_CANT = 0.025


class Points(ctypes.Structure):
    """``faststrip_profile`` of the header."""

    _fields_ = [("name", ctypes.c_char_p), ("y", ctypes.c_void_p), ("z", ctypes.c_void_p),
                ("n", ctypes.c_int)]


class ProgramNotFound(ImportError):
    """There is no program faststrip where it was looked for; it reads the files."""


class Gap(NamedTuple):
    """The gap of two profiles about their contact, for ``Contact.set_gap(*gap[:4])``."""

    y: Array  #: mm
    h: Array  #: mm
    inv2r: Array  #: 1/mm
    inclination: Array  #: rad
    angle: float  #: contact angle, rad
    radius: float  #: rolling radius at the contact, mm
    y_wheel: float  #: place of the contact on the wheel, mm
    y_rail: float  #: place of the contact on the rail, mm
    n_clipped: Tuple[int, int]  #: points left out of the wheel and of the rail

    def to_pandas(self) -> Any:
        """A pandas DataFrame, a row for each point; ``attrs["units"]`` has the units."""
        return frame(self._columns())

    def to_xarray(self) -> Any:
        """An xarray Dataset over ``y``, with ``units`` and ``long_name``."""
        return dataset(self._columns(), ("y",))

    def _columns(self) -> Dict[str, Array]:
        return {"y": self.y, "h": self.h, "inv2r": self.inv2r, "inclination": self.inclination}


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
    """A profile: points along the curve, y to the field side, z down, mm.

    A wheel's y is counted from its tape circle. What a file's header says of a flange is not
    taken over; ``sd``, ``sh`` and ``qr`` are measured on the points.
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
        """Read a file of any format that ``faststrip profile`` knows.

        The options are those of the command line with underscores: ``kind="wheel"``,
        ``section=2``, ``unit="m"``, ``tape_circle=73``, ``any_count=True``,
        ``smooth_wavelength=2``, ``keep=(-30, 40)``...
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
        """Draw the points with matplotlib, z down; the axes are given back."""
        if axes is None:
            axes = extra("matplotlib.pyplot", "plot").subplots()[1]
        style.setdefault("label", pathlib.Path(self.path).name or self.kind)
        axes.plot(self.y, self.z, **style)
        axes.set_aspect("equal", adjustable="datalim")
        if not axes.yaxis_inverted():
            axes.invert_yaxis()
        axes.set_xlabel("y to the field side, mm")
        axes.set_ylabel("z (down), mm")
        return axes


def _data_lines(lines: Sequence[str]) -> List[str]:
    return [line for line in lines if not line.startswith("#")]


def points_of(name: str, profile: Any, kind: str) -> Points:
    """A profile as the library takes it: a name, or points that have to be kept."""
    if isinstance(profile, str):
        return Points(profile.encode("ascii", "replace"))
    if not isinstance(profile, Profile) or profile.kind not in (kind, "unknown"):
        raise refused(name, f"a Profile of a {kind} or a name", profile)
    return Points(None, profile.y.ctypes.data, profile.z.ctypes.data, len(profile.y))


def cant_of(rail: Union[str, Profile], cant: Optional[float]) -> float:
    """The cant of a rail where none was told: 1:40 of a drawn one, none of a measured one."""
    if cant is None:
        return STANDARD_CANT if isinstance(rail, str) else 0.0
    return number("cant", cant)


def _raise(status: int, text: Any) -> None:
    if status >= FIRST_ERROR:
        raise FaststripError(status, word_of(status), text.value.decode("ascii", "replace"))


def profile_gap(wheel: Union[str, Profile], rail: Union[str, Profile], *, shift: float = 0.0,
                cant: Optional[float] = None, radius: float = 460.0, back_spacing: float = 1360.0,
                tread_line: float = 70.0, gauge: float = 1435.0, gauge_depth: float = 14.0,
                step: float = 0.05, height: float = 0.6) -> Gap:
    """The gap of a right wheel on the right rail, shifted to the right; lengths in mm.

    wheel and rail are a `Profile` or a name, as of a `Wheelset`. ``cant`` is the tangent by which
    the rail is turned: unless told otherwise 0.025 (1:40) for a name, and 0 for a Profile, which is
    taken as it was measured in the track.
    """
    sources = points_of("wheel", wheel, "wheel"), points_of("rail", rail, "rail")
    setup = np.array(numbers(
        ("back_spacing", "tread_line", "radius", "gauge", "gauge_depth", "cant", "shift", "step",
         "height"), (back_spacing, tread_line, radius, gauge, gauge_depth, cant_of(rail, cant),
                     shift, step, height)))
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
    return Gap._make((*(row[:n.value].copy() for row in arrays), *map(float, contact[:4]),
                      (int(contact[4]), int(contact[5]))))


def draw_profile(profile: Union[str, Profile], kind: str, *, cant: Optional[float] = None,
                 n: int = 401) -> Tuple[Array, Array]:
    """y and z, mm, of n points of what can be touched of a profile, a `Profile` or a name, at equal
    distances of y. kind is ``wheel`` or ``rail``; cant turns a rail, as in `profile_gap`.

    >>> y, z = draw_profile("60e1", "rail", cant=0.0, n=3)
    >>> y.round(3).tolist()
    [-37.15, 0.0, 37.15]
    """
    if kind not in ("wheel", "rail"):
        raise refused("kind", "wheel or rail", kind)
    source = points_of("profile", profile, kind)
    arrays = np.zeros((2, whole("n", n, 2, MOST_POINTS)))
    text = ctypes.create_string_buffer(TEXT)
    status = library.faststrip_draw_profile(
        ctypes.byref(source), kind == "rail", cant_of(profile, cant), n,
        *(row.ctypes.data for row in arrays), text, TEXT)
    _raise(status, text)
    return arrays[0], arrays[1]
