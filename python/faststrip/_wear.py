"""Friction that is not one number, T gamma, wear by a law, fatigue."""

from __future__ import annotations

import ctypes
from ctypes import c_double, c_int, c_void_p
from dataclasses import dataclass
from typing import Any, Dict, NamedTuple, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt

from ._arguments import above_zero, array, number, numbers, refused
from ._library import Case
from ._tables import dataset, frame

Array = npt.NDArray[np.float64]
KINDS = {"constant": 0, "linear": 2, "rational": 3, "exponential": 4}
N_REGIME = 4
N_FIGURES = 6


@dataclass(frozen=True)
class Friction:
    """What friction does besides ``mu``, which is the static coefficient on the tread.

    With the slip speed s it becomes ``mu (k + (1 - k) f)``: k is kinetic_share, h half_slip_speed;
    f is 1 - s/(2 h), not below 0, by ``linear``, 1/(1 + s/h) by ``rational``, 2**(-s/h) by
    ``exponential``. Methods but ``faststrip``, ``faststrip-plain`` and ``fastsim`` with its
    variants refuse it.
    """

    kind: str = "constant"  #: how it falls with slip
    kinetic_share: float = 1.0  #: kinetic over static friction, 1e-6 to 1
    half_slip_speed: float = 0.0  #: slip speed of half of the fall, mm/s
    slope_factor: float = 1.0  #: of the initial slope, above 0 to 1
    flange_share: float = 1.0  #: mu on the flange over that on the tread
    tread_angle: float = 0.0  #: contact angle up to which the tread's mu counts, rad
    flange_angle: float = 0.0  #: from which the flange's counts, rad


CONSTANT = Friction()
NAMES = ("kinetic_share", "half_slip_speed", "slope_factor", "flange_share", "tread_angle",
         "flange_angle")


def take_friction(case: Case, friction: Any) -> None:
    """Put friction into a case, but for the speed and the contact angle."""
    if not isinstance(friction, Friction):
        raise refused("friction", "a faststrip.Friction", friction)
    if not isinstance(friction.kind, str) or friction.kind not in KINDS:
        raise refused("friction.kind", f"one of {', '.join(KINDS)}", friction.kind)
    values = numbers([f"friction.{name}" for name in NAMES],
                     [getattr(friction, name) for name in NAMES])
    case.friction = KINDS[friction.kind]
    for name, value in zip(NAMES, values):
        setattr(case, name, value)


class _Law(ctypes.Structure):
    """``faststrip_wear_law`` of the header."""

    _fields_ = [("n", c_int), ("regimes", c_void_p), ("density", c_double)]


@dataclass(frozen=True)
class WearLaw:
    """Wear by coefficients. Each regime is where its T gamma/A begins, as the one before ends, the
    first at 0, and where it ends, N/mm^2, then constant, ug/(m mm^2), and slope, ug/(m N), of its
    wear rate; density in kg/m^3."""

    regimes: Sequence[Tuple[float, float, float, float]]
    density: float


class Wear(NamedTuple):
    """T gamma, wear and fatigue of one contact."""

    t_gamma: float  #: |fx cksi| + |fy ceta|, N
    t_gamma_spin: float  #: the same and |mz cphi|, N
    t_gamma_per_area: float  #: without spin, N/mm^2
    fatigue_index: Optional[float]  #: of the surface; None without a yield stress
    mass: Optional[float]  #: ug per metre rolled; None without a law
    volume: Optional[float]  #: mm^3 per metre rolled; None without a law


class StripWear(NamedTuple):
    """Forces and wear of the strips of a contact, in the order of ``Contact.strips``."""

    fx: Array  #: on the rail, N
    fy: Array  #: N
    friction_power: Array  #: over rolling speed, N
    t_gamma_per_area: Array  #: friction power over the strip's area, N/mm^2
    mass: Optional[Array]  #: ug per metre rolled; None without a law
    pass_depth: Optional[Array]  #: depth when rolled over once, mm; None without a law

    def to_pandas(self) -> Any:
        """A pandas DataFrame, a row for each strip; ``attrs["units"]`` has the units."""
        return frame(self._columns())

    def to_xarray(self) -> Any:
        """An xarray Dataset over ``strip``, with ``units`` and ``long_name``."""
        return dataset(self._columns(), ("strip",))

    def _columns(self) -> Dict[str, Array]:
        return {name: values for name, values in self._asdict().items() if values is not None}


class WearQuestion:
    """A law and a yield stress as the library takes them; ``law`` is null without one."""

    def __init__(self, law: Optional[WearLaw], yield_shear: Optional[float]) -> None:
        self.law: Any = None
        self.has_law = law is not None
        self.has_yield = yield_shear is not None
        self.yield_shear = 0.0 if yield_shear is None else above_zero("yield_shear", yield_shear)
        self.figures = (c_double * N_FIGURES)()
        if law is None:
            return
        if not isinstance(law, WearLaw):
            raise refused("law", "a faststrip.WearLaw", law)
        self._regimes = array("law.regimes", law.regimes)
        if self._regimes.ndim != 2 or self._regimes.shape[1] != N_REGIME:
            raise refused("law.regimes", "rows of four numbers", law.regimes)
        self.law = ctypes.byref(_Law(len(self._regimes), self._regimes.ctypes.data,
                                     number("law.density", law.density)))

    def answer(self) -> Wear:
        """What the library found."""
        t_gamma, with_spin, per_area, fatigue, mass, volume = self.figures
        return Wear(t_gamma, with_spin, per_area, fatigue if self.has_yield else None,
                    mass if self.has_law else None, volume if self.has_law else None)
