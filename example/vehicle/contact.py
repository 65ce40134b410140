"""Forces of a wheelset's contacts on it, by faststrip.Wheelset or by a table of its wheel."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import faststrip
import numpy as np
from bogie import PITCH, RADIUS, ROLL, TREAD, YAW, Array, N, Y, Z

MU = 0.3
# What is computed how; the table is made by `faststrip lookup wheel`.
METHODS: dict[str, dict[str, Any]] = {
    "strips": {"estimate": False},
    "hertz": {"normal": "hertz", "tangential": "polach", "estimate": False},
    "table": {},
}
# Of differences, in y, z, roll, pitch, yaw and their rates.
STEPS = (1e-4, 1e-5, 1e-8, 1e-4, 1e-6), (1e-1, 1e-2, 1e-5, 1e-3, 1e-4)


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
        One of METHODS, no table.
    """

    def __init__(self, method: str) -> None:
        self.wheelset = faststrip.Wheelset("s1002", "60e1", radius=RADIUS, mu=MU, **METHODS[method])
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
        self.calls += 1
        return self.wheelset.solve(
            y=q[Y], z=q[Z], roll=q[ROLL], yaw=q[YAW], y_rate=v[Y], z_rate=v[Z], roll_rate=v[ROLL],
            yaw_rate=v[YAW], pitch_rate=v[PITCH], speed=motion.speed, curvature=curvature,
            right_rail=faststrip.RailState(right_y, right_z, z_rate=right_rate),
            left_rail=faststrip.RailState(left_y, left_z, z_rate=left_rate), warm_start=True,
            **more)

    def forces(self, motion: Motion) -> Array:
        """On right and left wheel: Fx, Fy, Fz, N, and moments about the centre, N mm; in the
        track."""
        result = self.solve(motion)
        return -np.hstack([result.force, result.moment])

    def derivatives(self, motion: Motion) -> Array | None:
        """Of the forces on both wheels together over coordinates and rates: (6, 2, N). None where
        contacts come or go at this very state."""
        wheels = -self.solve(motion, derivatives=True).derivatives
        if not np.isfinite(wheels).all():
            return None
        slopes = np.zeros((6, 2, N))
        places = [Y, Z, ROLL, YAW]
        slopes[:, 0, places] = wheels[:, :, :4].sum(0)
        slopes[:, 1, places] = wheels[:, :, 4:].sum(0)
        # The library gives none over the pitch rate. A wheel's rim slides ahead with it as with a
        # yaw rate, by other arms: r against -y. What differs is spin, which Newton's method bears.
        slopes[:, 1, PITCH] = (wheels[1, :, 7] - wheels[0, :, 7]) * RADIUS / TREAD
        return slopes


class ByTable:
    """Contacts looked up in a table of one wheel, its roll and yaw 0.

    Beyond the loads of the table forces go on in proportion to the load, down to none.

    Parameters
    ----------
    path
        Its file.
    """

    def __init__(self, path: Any) -> None:
        self.table = faststrip.WheelLookup(path)
        self.calls = 0
        self._loads = np.full(2, np.mean(self.table.load))

    def height(self, axle_load: float) -> float:
        """z at rest, mm."""
        return float(self._heights(np.zeros(2), np.full(2, axle_load / 2))[0][0])

    def _heights(self, y: Array, load: Array) -> tuple[Array, Array, Array, Array]:
        """z of the wheelset's centre, its slope over the load, how far out the contact is that
        carries most, and the contacts' numbers."""
        found = self.table.contacts(y, 0.0, load, order="cubic", slopes=True)
        first = found.numbers[..., 0].argmax(-1)
        both = np.arange(len(y))
        lowest = found.numbers[both, first]
        return lowest[:, 7], found.slopes[both, first, 7, 2], TREAD + lowest[:, 5], found.numbers

    def forces(self, motion: Motion) -> Array:
        """As of ByWheelset. The left wheel is solved as its mirror image."""
        self.calls += 1
        side = np.array([1.0, -1.0])
        q, v, speed = motion.q, motion.v, motion.speed
        curvature = motion.rails[0] * side
        rail_y, rail_z, rail_rate = motion.rails[[1, 3]], motion.rails[[2, 4]], motion.rails[5:]
        roll, yaw, roll_rate, yaw_rate = (one * side for one in (q[ROLL], q[YAW], v[ROLL], v[YAW]))
        y = side * (q[Y] - rail_y) - roll * RADIUS
        load = self._loads
        for _ in range(20):
            known = np.clip(load, *self.table.load)
            found, slope, out, numbers = self._heights(y, known)
            z = q[Z] + roll * out - rail_z
            # The approach goes with the load to 2/3: so does the step, and so beyond the table.
            power = known ** (2 / 3) + (z - found) / slope * 2 / 3 * known ** (-1 / 3)
            last, load = load, np.clip(power, 0.0, None) ** 1.5
            if (np.abs(load - last) <= 1e-6 * known).all():
                break
        self._loads = load
        share = (load / known)[:, None]
        normal, angle, _, _, x, y_wheel, radius = np.moveaxis(numbers[..., :7], -1, 0)
        # Creepages are those of the surface before it is deformed, the radius is that after. By
        # Hertz between them lies 3/2 of the load times its compliance.
        radius = radius + 1.5 * (known * slope)[:, None]
        normal = normal * share
        cos, sin = np.cos(angle), np.sin(angle)
        out, spin = TREAD + y_wheel, v[PITCH]
        roll, yaw, roll_rate, yaw_rate, curvature = (
            one[:, None] for one in (roll, yaw, roll_rate, yaw_rate, curvature))
        across = v[Y] * side[:, None] + spin * (roll * x + yaw * radius) + yaw_rate * x \
            - roll_rate * radius
        sinking = v[Z] - rail_rate[:, None] - spin * (yaw * out + x) + roll_rate * out
        ahead = speed * (1 - curvature * out) + spin * radius - yaw_rate * out
        turn = -spin * sin + (yaw_rate + speed * curvature + spin * roll) * cos
        creepage = -ahead / speed, -(across * cos + sinking * sin) / speed, -turn / speed
        slots = np.arange(1, self.table.slots + 1)
        creep = self.table(slots, y[:, None], 0.0, known[:, None], MU, creepage, order="cubic")
        along, lateral, mz = np.moveaxis(creep.forces * share[..., None], -1, 0)
        beside, below = lateral * cos - normal * sin, lateral * sin + normal * cos
        right, down = out - roll * radius, radius + roll * out
        wheels = np.stack([along, beside, below, right * below - down * beside,
                           down * along - x * below - mz * sin,
                           x * beside - right * along + mz * cos], -1).sum(1)
        wheels[1] *= [1, -1, 1, -1, 1, -1]
        return -wheels

    def derivatives(self, motion: Motion) -> Array | None:
        """As of ByWheelset, by differences: a look-up is cheap."""
        slopes = np.zeros((6, 2, N))
        here = self.forces(motion).sum(0)
        for k, name in enumerate(("q", "v")):
            for c, step in enumerate(STEPS[k]):
                moved = getattr(motion, name).copy()
                moved[c] += step
                there = self.forces(replace(motion, **{name: moved})).sum(0)
                slopes[:, k, c] = (there - here) / step
        return slopes
