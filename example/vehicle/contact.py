"""Forces of a wheelset's contacts on it, by faststrip.Wheelset or a table behind it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import faststrip
import numpy as np
from bogie import PITCH, RADIUS, ROLL, TREAD, YAW, Array, N, Y, Z

MU = 0.3
# What is computed how; beyond the ends of the table strips answer.
METHODS: dict[str, dict[str, Any]] = {
    "strips": {"estimate": False},
    "hertz": {"normal": "hertz", "tangential": "polach", "estimate": False},
    "table": {"estimate": False},
}


@dataclass
class Motion:
    """Of a wheelset: coordinates and rates as bogie.COORDINATES, pitch_rate of them all of it, and
    its rails as Bogie.track_forces has them."""

    q: Array
    v: Array
    speed: float
    rails: Array


class ByWheelset:
    """Contacts solved by a Wheelset, which starts from its last solution.

    Parameters
    ----------
    method : str
        One of METHODS.
    table
        File that `faststrip lookup wheel` made, for a table.
    """

    def __init__(self, method: str, table: Any = None) -> None:
        self.wheelset = faststrip.Wheelset("s1002", "60e1", radius=RADIUS, mu=MU, **METHODS[method])
        if table is not None:
            self.wheelset.use_lookup(faststrip.WheelLookup(table))
        self.calls = 0

    def height(self, axle_load: float) -> float:
        """z at rest, mm."""
        return self.wheelset.solve(axle_load=axle_load, at_rest=True).z[0]

    def solve(self, motion: Motion, **more: Any) -> faststrip.WheelsetResult:
        """The call itself. Rails lie along the track: beside its place a rail has no velocity,
        since the yaw of the wheelset is handed over against the track, not against the rail. It
        has one along z: the library knows no slope of a rail, and a wheelset that climbs it would
        slide down flanges."""
        q, v = motion.q, motion.v
        curvature, right_y, right_z, left_y, left_z, right_rate, left_rate = motion.rails
        # Rails roll with their sleepers.
        roll, roll_rate = (right_z - left_z) / (2 * TREAD), (right_rate - left_rate) / (2 * TREAD)
        self.calls += 1
        return self.wheelset.solve(
            y=q[Y], z=q[Z], roll=q[ROLL], yaw=q[YAW], y_rate=v[Y], z_rate=v[Z], roll_rate=v[ROLL],
            yaw_rate=v[YAW], pitch_rate=v[PITCH], speed=motion.speed, curvature=curvature,
            right_rail=faststrip.RailState(right_y, right_z, roll, z_rate=right_rate,
                                           roll_rate=roll_rate),
            left_rail=faststrip.RailState(left_y, left_z, roll, z_rate=left_rate,
                                          roll_rate=roll_rate), warm_start=True, **more)

    def forces(self, motion: Motion) -> Array:
        """On right and left wheel: Fx, Fy, Fz, N, and moments about the centre, N mm; in the
        track."""
        result = self.solve(motion)
        return -np.hstack([result.force, result.moment])

    def derivatives(self, motion: Motion) -> Array | None:
        """Of the forces on both wheels together over coordinates and rates: (6, 2, N). None where
        contacts come or go at this very state."""
        slopes = np.zeros((6, 2, N))
        wheels = -self.solve(motion, derivatives=True).derivatives
        if not np.isfinite(wheels).all():
            return None
        places = [Y, Z, ROLL, YAW]
        slopes[:, 0, places] = wheels[:, :, :4].sum(0)
        slopes[:, 1, places + [PITCH]] = wheels[:, :, 4:].sum(0)
        return slopes
