"""Variable friction, T gamma, wear by a law, fatigue."""

from __future__ import annotations

import ctypes
from ctypes import c_double, c_int, c_void_p
from dataclasses import dataclass
from typing import Any, ClassVar, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt

from ._arguments import above_zero, array, number, numbers, refused
from ._catalogue import Case
from ._record import Row, Table

Array = npt.NDArray[np.float64]
PLACES = {"contact": 0, "rail": 1, "angle": 2}
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

    Parameters
    ----------
    kind : str
        How it falls with slip: ``constant``, ``linear``, ``rational``, ``exponential``.
    kinetic_share : float
        Kinetic over static friction, 1e-6 to 1.
    half_slip_speed : float
        Slip speed of half of the fall, mm/s.
    slope_factor : float
        Of the initial slope, above 0 to 1.
    flange_share : float
        mu on the flange over that on the tread.
    tread_angle, flange_angle : float
        Contact angle up to which the tread's mu counts, and from which the flange's counts, rad.
    at, mu : sequence of floats
        Places across the rail, increasing, up to 32, and the coefficient there, in place of the
        argument mu: linear between, constant beyond. Methods without strips, rows or elements of
        their own take the mean by load.
    over : str
        What the places are: ``contact``, its y, ``rail``, y on its profile, mm, or ``angle``,
        contact angles of either sign, rad.
    """

    kind: str = "constant"
    kinetic_share: float = 1.0
    half_slip_speed: float = 0.0
    slope_factor: float = 1.0
    flange_share: float = 1.0
    tread_angle: float = 0.0
    flange_angle: float = 0.0
    at: Sequence[float] = ()
    mu: Sequence[float] = ()
    over: str = "rail"


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
    if not isinstance(friction.over, str) or friction.over not in PLACES:
        raise refused("friction.over", f"one of {', '.join(PLACES)}", friction.over)
    table = array("friction.at", friction.at), array("friction.mu", friction.mu)
    if table[0].ndim != 1 or table[0].shape != table[1].shape:
        raise refused("friction.at and friction.mu", "as many numbers", (friction.at, friction.mu))
    case.friction = KINDS[friction.kind]
    for name, value in zip(NAMES, values):
        setattr(case, name, value)
    case.n_mu, case.mu_over = table[0].size, PLACES[friction.over]
    case.mu_at, case.mu_table = (values.ctypes.data for values in table)
    case.table = table  # lives as long as the case


class _Law(ctypes.Structure):
    """``faststrip_wear_law`` of the header."""

    _fields_ = [("n", c_int), ("regimes", c_void_p), ("density", c_double)]


@dataclass(frozen=True)
class WearLaw:
    """Wear by coefficients.

    Parameters
    ----------
    regimes : sequence of four floats each
        Where T gamma/A begins, as the regime before ends, the first at 0, and where it ends,
        N/mm^2, of the last one ``math.inf`` for nowhere; then constant, ug/(m mm^2), and slope,
        ug/(m N), of its wear rate.
    density : float
        kg/m^3.
    """

    regimes: Sequence[Tuple[float, float, float, float]]
    density: float


@dataclass(frozen=True)
class Wear(Row):
    """T gamma, wear and fatigue of one contact.

    Attributes
    ----------
    t_gamma : float
        ``|fx cksi| + |fy ceta|``, N.
    t_gamma_spin : float
        The same and ``|mz cphi|``, N.
    t_gamma_per_area : float
        Without spin, N/mm^2.
    fatigue_index : float or None
        Of the surface; None without a yield stress.
    mass : float or None
        Worn off, ug per metre rolled; None without a law.
    volume : float or None
        The same in mm^3 per metre rolled; None without a law.
    """

    t_gamma: float
    t_gamma_spin: float
    t_gamma_per_area: float
    fatigue_index: Optional[float]
    mass: Optional[float]
    volume: Optional[float]


@dataclass(frozen=True)
class StripWear(Table):
    """Forces and wear of the strips of a contact, in the order of ``Contact.strips``.

    Attributes
    ----------
    fx, fy : ndarray of float, shape (n,)
        Longitudinal and lateral force on the rail, N.
    friction_power : ndarray of float, shape (n,)
        Frictional work per distance rolled, N.
    t_gamma_per_area : ndarray of float, shape (n,)
        That over the strip's area, N/mm^2.
    mass : ndarray of float, shape (n,), or None
        Worn off, ug per metre rolled; None without a law.
    pass_depth : ndarray of float, shape (n,), or None
        Depth when rolled over once, mm; None without a law.
    """

    fx: Array
    fy: Array
    friction_power: Array
    t_gamma_per_area: Array
    mass: Optional[Array]
    pass_depth: Optional[Array]
    _rows: ClassVar[str] = "strip"


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
