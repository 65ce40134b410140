"""Contacts with numpy arrays in and out."""

from __future__ import annotations

import ctypes
from ctypes import c_double, c_int, c_void_p
from dataclasses import dataclass
from typing import Any, Dict, NamedTuple, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._library import TEXT, Case, FaststripError, Figures, check, library, word_of

Array = npt.NDArray[np.float64]

NORMAL = {"strip": 1, "hertz": 2, "equal_area": 3, "equal_moments": 4}
TANGENTIAL = {
    "none": 0, "faststrip": 1, "fastsim": 2, "faststrip-paper": 3, "faststrip-corrected": 4,
    "fastsim-elliptic": 5, "fastsim-weighted": 6, "linear": 7, "she": 8, "polach": 9,
}
BAD_ARGUMENT = 100


@dataclass(frozen=True)
class Material:
    """Elastic constants, MPa; steel on steel unless told otherwise."""

    e_wheel: float = 209920.0
    e_rail: float = 209920.0
    nu_wheel: float = 0.28
    nu_rail: float = 0.28

    @property
    def shear_modulus(self) -> float:
        """The combined shear modulus, MPa."""
        wheel = self.e_wheel / (2.0 * (1.0 + self.nu_wheel))
        rail = self.e_rail / (2.0 * (1.0 + self.nu_rail))
        return 2.0 / (1.0 / wheel + 1.0 / rail)


@dataclass(frozen=True)
class Result:
    """Figures of one contact; lengths in mm, forces on the rail in N."""

    status: int
    """0, or the number of a named limitation"""
    word: str
    """``ok``, or the name of the limitation: ``fallback_used``, ``edge_of_data``, ``fewer_strips``,
    ``overlap_left``, ``flat_along_x``, ``conformal``, ``under_resolved``, ``more_strips``"""
    load: float
    penetration: float
    area: float
    pmax: float
    """largest pressure, MPa"""
    y_min: float
    y_max: float
    x_max: float
    """largest half-length along x"""
    fx: float
    fy: float
    mz: float
    """moment about the reference point, N mm"""
    friction_power: float
    """heat over rolling speed, N"""
    stick_fraction: float
    n_patches: int
    n_strips: int
    n_elements: int
    iterations: int


class Strips(NamedTuple):
    """The strips of a contact: edges and half-lengths in mm, pressure in MPa, patch number."""

    y_left: Array
    y_right: Array
    half_length: Array
    p0: Array
    patch: npt.NDArray[np.int32]


class Elements(NamedTuple):
    """The elements of a contact: middle in mm, area in mm^2, pressure and traction on the rail in
    MPa, slip over rolling speed, state (1 adhesion, 2 slip)."""

    x: Array
    y: Array
    area: Array
    pn: Array
    px: Array
    py: Array
    sx: Array
    sy: Array
    state: npt.NDArray[np.int32]


def _number_of(names: Dict[str, int], name: str, what: str) -> int:
    if name not in names:
        raise FaststripError(BAD_ARGUMENT, word_of(BAD_ARGUMENT),
                             f"no {what} method {name!r}; there are {', '.join(names)}")
    return names[name]


def _arrays(n: int, doubles: int) -> list:
    return [*(np.empty(n) for _ in range(doubles)), np.empty(n, dtype=np.int32)]


def _addresses(arrays: list) -> list:
    return [c_void_p(array.ctypes.data) for array in arrays]


class Contact:
    """One wheel on one rail: methods, the room they need, the gap, the last solution.

    normal: ``strip`` (any patch), ``hertz``, ``equal_area`` or ``equal_moments``;
    tangential: ``faststrip``, ``fastsim``, ``none``; to compare with, ``faststrip-paper``,
    ``faststrip-corrected``, ``fastsim-elliptic``, ``fastsim-weighted`` and, for forces alone,
    ``linear``, ``she``, ``polach``. strips_per_patch is 1 to 1000, or ``auto``. Use one Contact per
    thread; calls release Python's lock while they compute.
    """

    def __init__(self, *, normal: str = "strip", tangential: str = "faststrip",
                 strips_per_patch: Union[int, str] = 15, points_per_strip: int = 15,
                 fastsim_grid: Tuple[int, int] = (50, 50), with_elements: bool = False,
                 max_points: int = 1000) -> None:
        self._workspace = c_void_p()
        self._case = Case()
        check(library.faststrip_default_case(ctypes.byref(self._case), ctypes.sizeof(Case)))
        self._case.normal = _number_of(NORMAL, normal, "normal")
        self._case.tangential = _number_of(TANGENTIAL, tangential, "tangential")
        self._case.strips_per_patch = 0 if strips_per_patch == "auto" else int(strips_per_patch)
        self._case.points_per_strip = points_per_strip
        self._case.fastsim_nx, self._case.fastsim_ny = fastsim_grid
        self._case.with_elements = with_elements
        self._make_room(max_points)

    def _make_room(self, max_points: int) -> None:
        self.close()
        check(library.faststrip_new(ctypes.byref(self._case), max_points,
                                    ctypes.byref(self._workspace)))
        self._max_points = max_points

    def close(self) -> None:
        """Give the memory back; the contact cannot be used afterwards."""
        library.faststrip_free(ctypes.byref(self._workspace))

    def __enter__(self) -> "Contact":
        return self

    def __exit__(self, *problem: Any) -> None:
        self.close()

    def __del__(self) -> None:
        if hasattr(self, "_workspace"):
            self.close()

    def set_gap(self, y: npt.ArrayLike, h: npt.ArrayLike, inv2r: npt.ArrayLike,
                turn: Optional[npt.ArrayLike] = None) -> None:
        """The gap of the undeformed bodies, ``h(x, y) = h(y) + x**2 inv2r(y)``: y strictly
        increasing, mm; h in mm; inv2r in 1/mm, also one number for all y. turn says how far the
        surfaces have turned from the tangent plane at y = 0, rad, by which conformal contacts are
        told. The numbers are copied.
        """
        points = np.ascontiguousarray(y, dtype=np.float64)
        if points.ndim != 1:
            raise FaststripError(BAD_ARGUMENT, word_of(BAD_ARGUMENT), "y is not one-dimensional")
        try:
            others = [
                np.ascontiguousarray(np.broadcast_to(np.asarray(values, np.float64), points.shape))
                for values in (h, inv2r, turn) if values is not None]
        except ValueError as problem:
            raise FaststripError(BAD_ARGUMENT, word_of(BAD_ARGUMENT),
                                 "y, h, inv2r or turn differ in length") from problem
        if points.size > self._max_points:
            self._make_room(points.size)
        addresses = _addresses([points, *others])
        check(library.faststrip_set_gap(self._workspace, points.size, *addresses[:3],
                                        addresses[3] if turn is not None else None),
              self._workspace)

    def solve(self, *, load: Optional[float] = None, penetration: Optional[float] = None,
              creepage: Tuple[float, float, float] = (0.0, 0.0, 0.0), mu: float = 0.3,
              material: Material = Material(), warm_start: bool = False) -> Result:
        """Solve for a load (N) or a penetration (mm): one of the two.

        creepage is longitudinal, lateral and spin (rad/mm) about y = 0. warm_start begins with the
        last solution, if there is one. Raises FaststripError where there is no result.
        """
        if (load is None) == (penetration is None):
            raise FaststripError(BAD_ARGUMENT, word_of(BAD_ARGUMENT),
                                 "one of load and penetration is needed")
        case = self._case
        case.by_load = load is not None
        case.load = 0.0 if load is None else load
        case.penetration = 0.0 if penetration is None else penetration
        case.cksi, case.ceta, case.cphi = creepage
        case.mu = mu
        case.e_wheel, case.e_rail = material.e_wheel, material.e_rail
        case.nu_wheel, case.nu_rail = material.nu_wheel, material.nu_rail
        case.warm_start = warm_start
        figures = Figures()
        status = check(library.faststrip_solve(self._workspace, ctypes.byref(case),
                                               ctypes.byref(figures)), self._workspace)
        return Result(status, word_of(status),
                      *(getattr(figures, name) for name, _ in Figures._fields_[1:]))

    def strips(self) -> Strips:
        """The strips of the last contact."""
        return Strips(*self._fetch(library.faststrip_get_strips, 4))

    def elements(self) -> Elements:
        """The elements of the last contact; none unless the Contact was made with_elements."""
        return Elements(*self._fetch(library.faststrip_get_elements, 8))

    def _fetch(self, function: Any, doubles: int) -> list:
        n = c_int()
        arrays = _arrays(0, doubles)
        function(self._workspace, 0, ctypes.byref(n), *_addresses(arrays))
        arrays = _arrays(n.value, doubles)
        check(function(self._workspace, n.value, ctypes.byref(n), *_addresses(arrays)),
              self._workspace)
        return arrays

    def copy_from(self, other: "Contact") -> None:
        """Take over gap, solution and room of another contact, for a step that is taken back."""
        check(library.faststrip_copy(other._workspace, self._workspace))
        self._max_points = other._max_points


def fastsim(a: float, b: float, coefficients: Tuple[float, float, float],
            creepage: Tuple[float, float, float], mu: float, load: float, *,
            shear_modulus: float = Material().shear_modulus,
            grid: Tuple[int, int] = (50, 50)) -> Tuple[float, float, float]:
    """FASTSIM on an ellipse with semi-axes a along x and b along y (mm) and Kalker's C11, C22, C23:
    Fx, Fy (N) and Mz (N mm) on the rail."""
    forces = (c_double * 3)()
    check(library.faststrip_fastsim(a, b, shear_modulus, *coefficients[:3], *creepage, mu, load,
                                    *grid, forces))
    return tuple(forces)


def hertz(inv2r_x: float, inv2r_y: float, load: float,
          material: Material = Material()) -> Tuple[float, float, float, float]:
    """Hertz's contact of the gap ``inv2r_x x**2 + inv2r_y y**2``: semi-axes a along x, b along y,
    penetration (mm), largest pressure (MPa)."""
    figures = (c_double * 4)()
    check(library.faststrip_hertz(material.e_wheel, material.e_rail, material.nu_wheel,
                                  material.nu_rail, inv2r_x, inv2r_y, load, figures))
    return tuple(figures)


def kalker(a_over_b: float, nu: float = 0.28) -> Tuple[float, float, float, float]:
    """Kalker's creepage coefficients C11, C22, C23, C33 for any a/b."""
    coefficients = (c_double * 4)()
    check(library.faststrip_kalker(a_over_b, nu, coefficients))
    return tuple(coefficients)


def library_version() -> str:
    """The version of the library, which is that of this package or a compatible one."""
    text = ctypes.create_string_buffer(TEXT)
    library.faststrip_version(text, TEXT)
    return text.value.decode("ascii")
