"""The vehicle and its track: masses, springs and dampers, a curve, irregularities.

mm, N, s, rad, and so tonnes. Axes as faststrip has them: x ahead, y to the right, z down, of each
body in a track frame of its own, which travels along the track beside it, turned by heading and
cant. Nothing here knows of contacts.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt
from scipy.interpolate import CubicSpline

Array = npt.NDArray[np.float64]

GRAVITY = 9810.0  # mm/s2
RADIUS = 460.0  # of the wheels, mm
TREAD = 750.0  # from the centre to the running circles, mm
# Bodies, and what each of them does; a wheelset's pitch is that beside rolling with the train.
BODIES = "front", "rear", "frame", "body"
COORDINATES = "y", "z", "roll", "pitch", "yaw"
Y, Z, ROLL, PITCH, YAW = range(len(COORDINATES))
N = len(COORDINATES)
# The body is half of a car body: it follows the track in pitch and yaw, its other bogie does.
FREE = [N * b + c for b in range(len(BODIES)) for c in range(N) if b < 3 or c < PITCH]
WHEELSETS = range(2)

# Vehicle 1 of the Manchester benchmarks (Iwnicki, Vehicle System Dynamics 30 (1998) 295-313), half
# of it. Of it are left out bump stops, traction rods, and springs in series with dampers.
MASS = {"front": 1.813, "rear": 1.813, "frame": 2.615, "body": 16.0}  # t
# About x, y, z, t mm2; of half a body only the first counts.
INERTIA = {"front": (1.12e6, 0.112e6, 1.12e6), "rear": (1.12e6, 0.112e6, 1.12e6),
           "frame": (1.722e6, 1.476e6, 3.067e6), "body": (28.4e6, 1.0, 1.0)}
HALF_BASE = 1280.0  # from the bogie's centre to a wheelset, mm
HALF_DISTANCE = 9500.0  # from the body's centre to a bogie's, mm
# Heights of the frame's and the body's centre above the axles, and of the secondary springs, mm.
FRAME_UP, SPRINGS_UP, BODY_UP = 140.0, 367.5, 1340.0
SPRINGS_OUT = 1000.0  # of both suspensions, mm
PRIMARY = np.array([31391.0, 3884.0, 1220.0]), np.array([15.0, 2.0, 4.0])  # N/mm, N s/mm; x, y, z
SECONDARY = np.array([160.0, 160.0, 430.0]), np.array([0.0, 32.0, 20.0])
ROUGH_AFTER = 3.0e4  # irregularities grow along so much of the track, mm
ROLL_BAR = 961.0e6  # anti-roll bar and bending of the springs, N mm/rad


def moved(body: int, arm: tuple[float, float, float]) -> Array:
    """How a point of a body moves in x, y, z with all coordinates: 3 rows."""
    x, y, z = arm
    rows = np.zeros((3, N * len(BODIES)))
    rows[:, N * body:N * (body + 1)] = [[0, 0, 0, z, -y], [1, 0, -z, 0, x], [0, 1, y, -x, 0]]
    return rows


def suspension() -> tuple[Array, Array]:
    """Stiffness and damping over all coordinates."""
    stiffness = np.zeros((N * len(BODIES), N * len(BODIES)))
    damping = np.zeros_like(stiffness)
    for out in (-SPRINGS_OUT, SPRINGS_OUT):
        links = [(moved(w, (0, out, 0)), moved(2, (ahead, out, FRAME_UP)), PRIMARY)
                 for w, ahead in zip(WHEELSETS, (HALF_BASE, -HALF_BASE), strict=True)]
        links.append((moved(2, (0, out, FRAME_UP - SPRINGS_UP)),
                      moved(3, (0, out, BODY_UP - SPRINGS_UP)), SECONDARY))
        for one, other, (k, c) in links:
            stretch = one - other
            stiffness += stretch.T @ np.diag(k) @ stretch
            damping += stretch.T @ np.diag(c) @ stretch
    bar = np.zeros(N * len(BODIES))
    bar[[2 * N + ROLL, 3 * N + ROLL]] = 1, -1
    return stiffness + ROLL_BAR * np.outer(bar, bar), damping


def smooth(t: Array) -> Array:
    """From 0 to 1 as t does, with no corner."""
    t = np.clip(t, 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


@dataclass
class Track:
    """A straight, a transition, a curve to the right, and back; rough all along.

    Attributes
    ----------
    radius : float
        Of the curve, mm; inf: straight.
    cant : float
        Height of the outer rail over the inner one in the curve, mm.
    straight, transition, curve : float
        Lengths, mm.
    rough : float
        1 for the spectra of ERRI B176, low level; 0 for an even track.
    seed : int
        Of the phases.
    """

    radius: float = 1.0e6
    cant: float = 120.0
    straight: float = 1.0e5
    transition: float = 1.0e5
    curve: float = 3.0e5
    rough: float = 1.0
    seed: int = 1
    _spline: CubicSpline = field(init=False, repr=False)

    def __post_init__(self) -> None:
        """Sample everything over the place of the bogie's centre; between samples is a spline."""
        length = 2 * (self.straight + self.transition) + self.curve
        s = np.arange(-1.0e4, length + 2.0e4, 100.0)
        self._spline = CubicSpline(s, np.column_stack([
            *(part for ahead in (HALF_BASE, -HALF_BASE) for part in self._wheelset(s, ahead)),
            self.curvature(s), self.roll(s)]))

    def share(self, s: Array) -> Array:
        """Of the curve, 0 to 1, along smooth transitions."""
        end = self.straight + 2 * self.transition + self.curve
        return (smooth((s - self.straight) / self.transition)
                * smooth((end - s) / self.transition))

    def curvature(self, s: Array) -> Array:
        """1/mm, positive to the right."""
        return self.share(s) / self.radius

    def roll(self, s: Array) -> Array:
        """The cant, right side down, rad."""
        return self.share(s) * self.cant / (2 * TREAD)

    def irregularity(self, s: Array) -> Array:
        """y and z of the right rail, y and z of the left rail, mm: four rows.

        Spectra over the wave number w, m2/(rad/m), of alignment, level, cross level (an angle)
        and gauge; waves of 3 to 80 m.
        """
        w, step = np.linspace(2 * np.pi / 80, 2 * np.pi / 3, 200, retstep=True)
        wc, wr, ws, half = 0.8246, 0.0206, 0.438, 0.75
        common = wc**2 / ((w**2 + wr**2) * (w**2 + wc**2))
        cross = w**2 / (w**2 + ws**2)
        spectra = np.array([2.119e-7 * common, 4.032e-7 * common,
                            4.032e-7 / half**2 * common * cross, 0.532e-7 * common * cross])
        phase = np.random.default_rng(self.seed).uniform(0, 2 * np.pi, spectra.shape)
        waves = np.cos(np.multiply.outer(s / 1e3, w) + phase[:, None])
        y, z, angle, gauge = self.rough * 1e3 * np.einsum(
            "qsw,qw->qs", waves, np.sqrt(2 * spectra * step))
        return (np.array([y + gauge / 2, z + angle * half, y - gauge / 2, z - angle * half])
                * smooth(s / ROUGH_AFTER - 0.1))

    def _wheelset(self, s: Array, ahead: float) -> tuple[Array, ...]:
        """Of a wheelset: its track frame in that of the bogie (y, roll, yaw), its curvature, its
        cant, its rails."""
        turn = self.roll(s + ahead) - self.roll(s)
        return (self.curvature(s + ahead / 3) * ahead**2 / 2 + RADIUS * turn, turn,
                self.curvature(s + ahead / 2) * ahead, self.curvature(s + ahead),
                self.roll(s + ahead), *self.irregularity(s + ahead))

    def at(self, s: float) -> tuple[Array, Array]:
        """What lies under the bogie, and its change per mm: 9 numbers of each wheelset (y, roll and
        yaw of its track frame in that of the bogie, curvature, cant, y and z of the right rail, of
        the left), curvature and cant under the centre."""
        return self._spline(s), self._spline(s, 1)


class Bogie:
    """Equations of motion, M q'' = forces, of FREE coordinates q; contacts come from outside.

    Parameters
    ----------
    track : Track
    speed : float
        mm/s.
    """

    def __init__(self, track: Track, speed: float) -> None:
        self.track, self.speed = track, speed
        stiffness, damping = suspension()
        self.stiffness, self.damping = (one[FREE][:, FREE] for one in (stiffness, damping))
        # What the offsets of track frames do.
        self._by_offset, self._by_rate = stiffness[FREE], damping[FREE]
        self.masses = np.concatenate(
            [[MASS[b], MASS[b], *INERTIA[b]] for b in BODIES])[FREE]
        self.rolling = -speed / RADIUS
        # Wheels that roll hold their axle: the moment of a gyroscope, by rates.
        self.gyroscope = np.zeros_like(self.damping)
        for w in WHEELSETS:
            spin = INERTIA[BODIES[w]][1] * self.rolling
            self.gyroscope[N * w + ROLL, N * w + YAW] = spin
            self.gyroscope[N * w + YAW, N * w + ROLL] = -spin

    @property
    def axle_load(self) -> float:
        """At rest, N."""
        return GRAVITY * sum(MASS.values()) / 2

    def at_rest(self, height: float) -> Array:
        """Coordinates where the wheelsets stand at a height, mm, on straight track."""
        q = np.zeros(len(FREE))
        q[[N * w + Z for w in WHEELSETS]] = height
        weights, _ = self.track_forces(0.0)
        upper = np.arange(2 * N, len(FREE))
        q[upper] = np.linalg.solve(self.stiffness[np.ix_(upper, upper)],
                                   (weights - self.stiffness @ q)[upper])
        return q

    def track_forces(self, s: float) -> tuple[Array, list[Array]]:
        """Weight, centrifugal forces and what the offsets of the track frames do to the springs;
        and of each wheelset what the contact has to know: curvature, y, z and z's rate of the right
        and the left rail."""
        here, slope = self.track.at(s)
        slope = slope * self.speed
        offset, rate = np.zeros((2, N * len(BODIES)))
        curvature, roll = np.full((2, len(BODIES)), here[-2:, None])
        contacts = []
        for w in WHEELSETS:
            (y, turn, yaw, curvature[w], roll[w]), rails = np.split(here[9 * w:9 * w + 9], [5])
            offset[[N * w + c for c in (Y, ROLL, YAW)]] = y, turn, yaw
            rate[[N * w + c for c in (Y, ROLL, YAW)]] = slope[9 * w:9 * w + 3]
            contacts.append(np.array([curvature[w], *rails, slope[9 * w + 6], slope[9 * w + 8]]))
        # The body's heading is that of the track at its centre.
        offset[3 * N + YAW] = -curvature[3] * HALF_DISTANCE
        mass = np.array([MASS[b] for b in BODIES])
        outward = self.speed**2 * curvature
        forces = np.zeros((len(BODIES), N))
        forces[:, Y] = mass * (GRAVITY * np.sin(roll) - outward * np.cos(roll))
        forces[:, Z] = mass * (GRAVITY * np.cos(roll) + outward * np.sin(roll))
        for w in WHEELSETS:
            forces[w, ROLL] = INERTIA[BODIES[w]][1] * self.rolling * self.speed * curvature[w]
        return (forces.ravel()[FREE] - self._by_offset @ offset - self._by_rate @ rate, contacts)
