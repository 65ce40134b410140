"""Both wheels of a wheelset on their track, and its contact functions."""

from __future__ import annotations

import dataclasses
from typing import Any, Dict, NamedTuple, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from .._geometry import Conicity, ContactFunctions, conicity, contact_functions
from .._library import FaststripError
from .._results import Strips
from .._wear import Wear
from .._wheelset import Wheelset, WheelsetResult
from .case import RADIUS, Case
from .solving import ROLLING_SPEED, Kept

Array = npt.NDArray[np.float64]
SIDES = "left", "right"  # as they stand in the picture
DISPLACEMENTS = np.linspace(-12.0, 12.0, 97)  # mm
AMPLITUDES = np.linspace(0.5, 10.0, 39)  # mm


class Functions(NamedTuple):
    """What depends on the profiles alone."""

    of_y: ContactFunctions
    conicity: Conicity


class Rests(NamedTuple):
    """How one wheel bears on its rail; the vertical force down, the lateral one to the field side,
    the longitudinal one ahead, N."""

    vertical: float
    lateral: float
    longitudinal: float

    @property
    def ratio(self) -> float:
        """Y/Q."""
        return self.lateral / self.vertical


@dataclasses.dataclass
class WheelsetOutcome:
    """Everything that the wheelset's view shows of a case, but for its functions."""

    case: Case
    result: Optional[WheelsetResult] = None
    strips: Tuple[Strips, ...] = ()
    wear: Tuple[Wear, ...] = ()
    error: str = ""
    profiles: Any = None
    times: Dict[str, float] = dataclasses.field(default_factory=dict)

    def rests(self, side: str) -> Rests:
        """The forces of one wheel on its rail."""
        assert self.result is not None
        x, y, z = self.result.force[0 if side == "right" else 1].tolist()
        return Rests(z, y if side == "right" else -y, x)


class WheelsetSolver(Kept):
    """A wheelset that is kept from one change to the next; of one thread."""

    def solve(self, case: Case) -> WheelsetOutcome:
        """Both wheels by strips and FASTSTRIP, rolling freely."""
        outcome = WheelsetOutcome(case)
        if not case.is_vertical:
            outcome.error = "a wheelset must have a vertical load, got a normal force"
            return outcome
        try:
            outcome.profiles = self._profiles(case)
            wheelset = self._once("a new wheelset", (case.pair, case.mu), lambda: Wheelset(
                case.wheel.profile, case.rail.profile, radius=RADIUS,
                inclination=case.inclination, roller_radius=case.roller_radius,
                curved=case.is_curved, mu=case.mu))
            key = (case.pair, case.mu, case.shift, case.yaw, case.load, case.transfer,
                   case.curvature, case.yield_shear)
            outcome.result, outcome.strips, outcome.wear = self._once(
                "both wheels", key, lambda: solved(wheelset, case))
        except FaststripError as problem:
            outcome.error = str(problem)
        outcome.times = dict(self.times)
        return outcome

    def functions(self, case: Case) -> Union[Functions, str]:
        """Contact functions and conicity, or why there are none."""
        return self._once("functions", case.pair, lambda: find_functions(case))


def solved(wheelset: Wheelset, case: Case) -> Any:
    """The result, strips and wear of each contact."""
    result = wheelset.solve(
        y=case.shift, yaw=case.yaw, speed=ROLLING_SPEED, curvature=case.curvature,
        load=(case.load * (1.0 + case.transfer), case.load * (1.0 - case.transfer)))
    return (result, tuple(wheelset.strips(k) for k in range(len(result.contacts))),
            wheelset.wear(yield_shear=case.yield_shear))


def find_functions(case: Case) -> Union[Functions, str]:
    try:
        of_y = contact_functions(case.wheel.profile, case.rail.profile, DISPLACEMENTS,
                                 radius=RADIUS, inclination=case.inclination)
        return Functions(of_y, conicity(of_y.y, of_y.delta_r, AMPLITUDES))
    except FaststripError as problem:
        return str(problem)
