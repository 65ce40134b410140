"""Variable friction, T gamma, wear by a law, fatigue, temperatures."""

from __future__ import annotations

import ctypes
from ctypes import c_double, c_int, c_void_p
from dataclasses import dataclass
from typing import Any, ClassVar, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._arguments import above_zero, array, number, numbers, refused, several
from ._catalogue import Case
from ._record import Row, Table, described

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
    ``exponential``. With the temperature of the surfaces there, in the same march, it becomes
    hot_share times that, linearly between both temperatures. Methods but ``faststrip``,
    ``faststrip-plain`` and ``fastsim`` with its variants refuse what falls.

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
        Places across the rail, increasing, up to 16, and the coefficient there, in place of the
        argument mu: linear between, constant beyond. Methods without strips, rows or elements of
        their own take the mean by load.
    over : str
        What the places are: ``contact``, its y, ``rail``, y on its profile, mm, or ``angle``,
        contact angles of either sign, rad.
    hot_share : float
        Hot over cold friction, 1e-6 to 1.
    cold_temperature, hot_temperature : float
        Temperature up to which friction is cold, and from which it is hot, C.
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
    hot_share: float = 1.0
    cold_temperature: float = 0.0
    hot_temperature: float = 0.0


CONSTANT = Friction()
NAMES = ("kinetic_share", "half_slip_speed", "slope_factor", "flange_share", "tread_angle",
         "flange_angle", "hot_share", "cold_temperature", "hot_temperature")


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


@dataclass(frozen=True)
class Thermal:
    """How wheel and rail take up heat, and how warm they are; steel by default.

    Each is a number of both, or two, of wheel and rail.

    Parameters
    ----------
    conductivity : float or two floats
        Thermal conductivity, W/(m K).
    heat_capacity : float or two floats
        J/(kg K).
    density : float or two floats
        kg/m^3.
    temperature : float or two floats
        Away from the contact, C.
    """

    conductivity: Union[float, Tuple[float, float]] = 50.0
    heat_capacity: Union[float, Tuple[float, float]] = 450.0
    density: Union[float, Tuple[float, float]] = 7850.0
    temperature: Union[float, Tuple[float, float]] = 20.0


THERMAL = "conductivity", "heat_capacity", "density", "temperature"


def take_thermal(case: Case, thermal: Any) -> None:
    """Put bodies into a case that asks for temperatures, or None for none."""
    case.with_temperatures = thermal is not None
    if thermal is None:
        return
    if not isinstance(thermal, Thermal):
        raise refused("thermal", "a faststrip.Thermal", thermal)
    if not case.with_elements:
        raise refused("thermal", "None unless made with_elements", thermal)
    for name in THERMAL:
        value = getattr(thermal, name)
        if isinstance(value, (tuple, list, np.ndarray)):
            both = several(f"thermal.{name}", value, "wheel and rail", (2,))
        else:
            both = value, value
        for body, one in zip(("wheel", "rail"), both):
            setattr(case, f"{name}_{body}", number(f"thermal.{name}", one))


@described
@dataclass(frozen=True)
class Flash(Row):
    """Temperatures of one contact.

    Attributes
    ----------
    <figures>
    """

    flash_temperature: float
    temperature_max: float
    temperature_x: float
    temperature_y: float


def take_flash(call: Any, function: Any, *first: int) -> Flash:
    """The largest rise and temperature."""
    figures = (c_double * len(Flash.__dataclass_fields__))()
    call(function, *first, figures)
    return Flash(*figures)


def temperatures(call: Any, function: Any, x: npt.ArrayLike, y: npt.ArrayLike,
                 *first: int) -> Tuple[Array, Array]:
    """Of wheel and rail at places."""
    x, y = array("x", x), array("y", y)
    try:
        places = [np.array(one, order="C") for one in np.broadcast_arrays(x, y)]
    except ValueError:
        raise refused("y", f"a number or numbers that go with x, of shape {x.shape}", y) from None
    found = [np.empty_like(one) for one in places]
    call(function, *first, found[0].size, *(c_void_p(one.ctypes.data)
                                            for one in (*places, *found)))
    return found[0], found[1]


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
