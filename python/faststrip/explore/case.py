"""What is on the page, as numbers with units: a right wheel on its rail, and its wheelset."""

from __future__ import annotations

import dataclasses
import functools
import math
import pathlib
import tempfile
from typing import NamedTuple, Optional, Tuple, Union

from .._library import FaststripError
from .._profile import NAMES, Profile

RADIUS = 460.0
STANDARD_INCLINATION = 0.025
ENDINGS = ".prw .prr .whl .ban .mpt .whe .rai .wheel .csv .txt .dat"


class CaseError(Exception):
    """What is wrong with what was given, in one line."""


@dataclasses.dataclass(frozen=True, eq=False)
class Shape:
    """A profile: a name that the library knows, or a file."""

    label: str
    profile: Union[str, Profile]
    content: bytes = b""

    @property
    def is_file(self) -> bool:
        return isinstance(self.profile, Profile)


STANDARD = {kind: {name: Shape(name, name) for name in names} for kind, names in NAMES.items()}


@dataclasses.dataclass(frozen=True)
class Case:
    """One contact and its wheelset; mm, N, MPa, rad."""

    wheel: Shape = STANDARD["wheel"]["s1002"]
    rail: Shape = STANDARD["rail"]["uic60"]
    shift: float = 0.0
    yaw: float = 0.0
    load: float = 1.0e5
    cksi: float = 1.0e-3
    ceta: float = 5.0e-4
    cphi: float = 5.0e-5
    mu: float = 0.3
    transfer: float = 0.0
    """what the right wheel bears more than the mean of both, and the left one less, as a part"""
    curvature: float = 0.0
    yield_shear: float = 300.0
    roller_radius: float = 0.0
    """of a roller in the rail's place; 0: a rail"""
    is_curved: bool = False
    """has each strip a plane of its own?"""
    is_vertical: bool = True
    """is the load the vertical one, and not the normal force?"""
    given_inclination: Optional[float] = None
    """the rail inclination, its tangent; None: nothing was said"""

    @property
    def is_as_it_lies(self) -> bool:
        """Is it a rail of a file of which nothing was said? The page says that it took 0."""
        return self.given_inclination is None and self.rail.is_file

    @property
    def inclination(self) -> float:
        if self.given_inclination is not None:
            return self.given_inclination
        return 0.0 if self.rail.is_file else STANDARD_INCLINATION

    @property
    def pair(self) -> Tuple[Shape, Shape, float, float, bool]:
        """What all of a wheelset is of: its profiles, and how they bear on each other."""
        return self.wheel, self.rail, self.inclination, self.roller_radius, self.is_curved

    @property
    def creepage(self) -> Tuple[float, float, float]:
        return self.cksi, self.ceta, self.cphi


class Control(NamedTuple):
    """A slider: the number of a case that it moves, and its own unit."""

    name: str
    title: str
    unit: str
    scale: float
    """what one unit is in the case"""
    low: float
    high: float
    step: float
    view: str = ""
    """which view has it; empty: both"""
    least: float = -math.inf
    """of numbers other than 0"""
    refusal: str = ""
    """how the library names it where it refuses it"""

    @property
    def label(self) -> str:
        """Title with the unit."""
        return self.title + ("" if self.unit == "-" else f", {self.unit}")

    @property
    def range(self) -> str:
        """What it can be, in words."""
        zero = "" if math.isinf(self.least) else "0 or "
        return f"{zero}a number from {max(self.low, self.least):g} to {self.high:g}"

    def takes(self, value: float) -> bool:
        """Can it be this, in its own unit?"""
        return max(self.low, self.least) <= value <= self.high or value == 0.0 >= self.low


CONTROLS = (
    Control("shift", "lateral displacement y", "mm", 1.0, -10.0, 10.0, 0.1),
    Control("yaw", "yaw angle", "mrad", 1e-3, -20.0, 20.0, 0.5),
    Control("load", "wheel load Q", "kN", 1e3, 1.0, 250.0, 1.0),
    Control("transfer", "load transfer to the right", "%", 1e-2, -90.0, 90.0, 1.0,
            "wheelset"),
    Control("curvature", "track curvature", "1/km", 1e-6, -10.0, 10.0, 0.1,
            "wheelset", refusal="curvature of a wheelset"),
    Control("cksi", "longitudinal creepage cksi", "%", 1e-2, -2.0, 2.0, 0.01, "contact"),
    Control("ceta", "lateral creepage ceta", "%", 1e-2, -2.0, 2.0, 0.01, "contact"),
    Control("cphi", "spin cphi", "rad/m", 1e-3, -1.0, 1.0, 0.005, "contact"),
    Control("mu", "coefficient of friction", "-", 1.0, 0.01, 0.8, 0.01),
    Control("yield_shear", "yield stress in shear k", "MPa", 1.0, 50.0, 800.0, 5.0),
    Control("roller_radius", "roller radius (0: rail)", "mm", 1.0, 0.0, 2500.0, 100.0,
            least=100.0, refusal="radius of the rollers"),
    Control("smoothing", "smoothing of files", "mm", 1.0, 0.0, 30.0, 0.5),
)
CONTROL = {control.name: control for control in CONTROLS}
DIGITS = 12


def to_case(control: Control, value: float) -> float:
    """A slider's value in the unit of a case, without the noise of the step's last digits."""
    return float(f"{value * control.scale:.{DIGITS}g}")


def to_slider(control: Control, value: float) -> float:
    """A case's number in the unit of the slider."""
    return float(f"{value / control.scale:.{DIGITS}g}")


def checked(case: Case) -> Case:
    """A case whose numbers the sliders can show; else CaseError."""
    for control in CONTROLS:
        value = to_slider(control, getattr(case, control.name, 0.0))
        if not control.takes(value):
            unit = "" if control.unit == "-" else f" {control.unit}"
            raise CaseError(f"{control.title} must be {control.range}{unit} on the page, got "
                            f"{value:g}")
    return case


def read_shape(kind: str, name: str, content: bytes, **options: float) -> Shape:
    """A profile from the content of a file, through the library's readers, with its options."""
    label = pathlib.PurePath(name.replace("\\", "/")).name
    if not label or label in (".", ".."):
        raise CaseError(f"the file must have a name, got {name!r}")
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, label)
        try:
            path.write_bytes(content)
        except (OSError, ValueError) as problem:
            raise CaseError(f"cannot keep a file of this name: {label!r} ({problem})") from None
        try:
            profile = Profile.read(path, kind=kind, **options)  # type: ignore[arg-type]
        except FaststripError as problem:
            raise CaseError(problem.message.replace(f"{folder}/", "")) from None
    return Shape(label, dataclasses.replace(profile, path=label), content)


@functools.lru_cache(maxsize=32)
def smoothed(kind: str, shape: Shape, wavelength: float) -> Shape:
    """A profile of a file without waves shorter than this, mm; as it is for 0 and of a name."""
    if not wavelength or not shape.is_file:
        return shape
    made = read_shape(kind, shape.label, shape.content, smooth_wavelength=wavelength)
    assert isinstance(made.profile, Profile)
    points = "".join(f"{y!r} {z!r}\n" for y, z in zip(made.profile.y.tolist(),
                                                     made.profile.z.tolist()))
    return Shape(f"{pathlib.PurePath(shape.label).stem}_smooth{wavelength:g}.txt", made.profile,
                 points.encode("ascii"))


def find_shape(kind: str, name: str) -> Shape:
    """A profile by name, or from a file of this machine."""
    if name.lower() in STANDARD[kind]:
        return STANDARD[kind][name.lower()]
    try:
        content = pathlib.Path(name).read_bytes()
    except OSError as problem:
        names = ", ".join(STANDARD[kind])
        raise CaseError(f"the {kind} must be {names} or a file, got {name} "
                        f"({problem.strerror})") from None
    return read_shape(kind, name, content)
