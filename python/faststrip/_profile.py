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
from typing import Any, Iterator, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._arguments import refused
from ._library import TOO_SMALL, FaststripError, check, library, word_of

Array = npt.NDArray[np.float64]
Path = Union[str, "os.PathLike[str]"]
FILE_FORMAT = 121
KINDS = {"wheel", "rail"}
FIRST_CAPACITY = 4000


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
            import matplotlib.pyplot as plt

            axes = plt.subplots()[1]
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


def profile_gap(wheel: Profile, rail: Profile, *, shift: float = 0.0, cant: float = 0.0,
                radius: float = 460.0, back_spacing: float = 1360.0, tread_line: float = 70.0,
                gauge: float = 1435.0, gauge_depth: float = 14.0, step: float = 0.05,
                height: float = 0.6) -> Gap:
    """The gap of a right wheel on the right rail, shifted to the right; lengths in mm.

    ``cant`` is the tangent by which the rail is turned: 0 where it was measured in the track.
    """
    for name, profile in (("wheel", wheel), ("rail", rail)):
        if not isinstance(profile, Profile) or profile.kind not in (name, "unknown"):
            raise refused(name, f"a Profile of a {name}", profile)
    setup = np.array([back_spacing, tread_line, radius, gauge, gauge_depth, cant, shift, step,
                      height], dtype=float)
    n, capacity = ctypes.c_int(), FIRST_CAPACITY
    contact = np.zeros(6)
    while True:
        arrays = np.zeros((4, capacity))
        status = library.faststrip_profile_gap(
            len(wheel.y), wheel.y.ctypes.data, wheel.z.ctypes.data, len(rail.y),
            rail.y.ctypes.data, rail.z.ctypes.data, setup.ctypes.data, capacity, ctypes.byref(n),
            *(row.ctypes.data for row in arrays), contact.ctypes.data)
        if status != TOO_SMALL or n.value <= capacity:
            break
        capacity = n.value
    check(status, wheel=wheel.path, rail=rail.path, shift=shift)
    return Gap(*(row[:n.value].copy() for row in arrays), *map(float, contact[:4]),
               (int(contact[4]), int(contact[5])))
