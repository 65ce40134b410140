"""The bogie on its track, over time: what solve_ivp is given, and what comes out."""

from __future__ import annotations

import time
from dataclasses import dataclass, field

import faststrip
import numpy as np
from bogie import FREE, PITCH, WHEELSETS, Array, Bogie, N
from contact import ByWheelset, Motion
from scipy.integrate import solve_ivp

# Of a step: relative, and of coordinates (mm, rad) and rates.
RELATIVE = 1e-4
ABSOLUTE = {"y": (1e-4, 1e-1), "z": (1e-5, 1e-1), "roll": (1e-7, 1e-4), "pitch": (1e-4, 1e-4),
            "yaw": (1e-7, 1e-4)}


@dataclass
class Run:
    """What a run found and what it cost.

    Attributes
    ----------
    t, y : ndarray
        Times, s, and states, one a column.
    spent : float
        Processor time, s; a loaded machine does not change it.
    calls, jacobians, failed : int
        Calls of contacts of a wheelset, those of Jacobians among them; Jacobians; calls that
        failed, after which the integrator halves its step.
    factor : float
        Real-time factor: processor time over the time of the motion.
    """

    t: Array
    y: Array
    spent: float = 0.0
    calls: int = 0
    jacobians: int = 0
    failed: int = 0
    factor: float = field(init=False)

    def __post_init__(self) -> None:
        self.factor = self.spent / (self.t[-1] - self.t[0])


class Motions:
    """First-order equations: the state has coordinates, then rates.

    Parameters
    ----------
    bogie : Bogie
    contacts : two of ByWheelset
        Of the front and the rear wheelset.
    """

    def __init__(self, bogie: Bogie, contacts: list[ByWheelset]) -> None:
        self.bogie, self.contacts = bogie, contacts
        self.failed = 0
        self.size = len(FREE)
        masses = bogie.masses[:, None]
        # Of everything but the contacts; it does not change.
        self.fixed = np.block([
            [np.zeros((self.size, self.size)), np.eye(self.size)],
            [-bogie.stiffness / masses, (bogie.gyroscope - bogie.damping) / masses]])
        self.last: Array = np.zeros((2, 6, 2, N))

    def start(self, y: float = 0.0) -> Array:
        """At rest in the straight, but for a displacement of the front wheelset, mm."""
        state = np.zeros(2 * self.size)
        state[:self.size] = self.bogie.at_rest(self.contacts[0].height(self.bogie.axle_load))
        state[0] = y
        return state

    def motion(self, state: Array, w: int, rails: Array) -> Motion:
        """Of a wheelset, as its contacts have to know it."""
        own = slice(N * w, N * w + N)
        v = state[self.size:][own].copy()
        v[PITCH] += self.bogie.rolling
        return Motion(state[:self.size][own], v, self.bogie.speed, rails)

    def wheel_forces(self, t: float, state: Array) -> Array:
        """On each wheelset and wheel: (2, 2, 6), N and N mm."""
        _, rails = self.bogie.track_forces(self.bogie.speed * t)
        return np.array([self.contacts[w].forces(self.motion(state, w, rails[w]))
                         for w in WHEELSETS])

    def __call__(self, t: float, state: Array) -> Array:
        """Rates of the state."""
        forces, rails = self.bogie.track_forces(self.bogie.speed * t)
        rates = self.fixed @ state
        for w in WHEELSETS:
            motion = self.motion(state, w, rails[w])
            try:
                found = self.contacts[w].forces(motion).sum(0)
            except faststrip.FaststripError:
                self.failed += 1
                return np.full_like(state, np.nan)
            forces[N * w:N * w + N] += self.on_coordinates(found, motion)
        rates[self.size:] += forces / self.bogie.masses
        return rates

    @staticmethod
    def on_coordinates(force: Array, motion: Motion) -> Array:
        """Of forces and moments the parts that drive y, z, roll, pitch, yaw. The axle turns about
        its own axis."""
        _, fy, fz, mx, my, mz = force
        return np.array([fy, fz, mx, my - motion.q[4] * mx + motion.q[2] * mz, mz])

    def jacobian(self, t: float, state: Array) -> Array:
        """Derivatives of the rates, from those of the contacts."""
        _, rails = self.bogie.track_forces(self.bogie.speed * t)
        matrix = self.fixed.copy()
        for w in WHEELSETS:
            motion = self.motion(state, w, rails[w])
            slopes = self.contacts[w].derivatives(motion)
            if slopes is not None:
                self.last[w] = slopes
            own = np.arange(N * w, N * w + N)
            for k in (0, self.size):
                part = np.array([self.on_coordinates(one, motion)
                                 for one in self.last[w, :, k // self.size].T]).T
                matrix[np.ix_(self.size + own, k + own)] += part / self.bogie.masses[own, None]
        return matrix

    def tolerance(self) -> Array:
        """Of each number of the state."""
        both = np.array([ABSOLUTE[c] for c in ("y", "z", "roll", "pitch", "yaw")])
        return np.tile(both, (4, 1))[FREE].T.ravel()

    def run(self, end: float, start: Array, times: Array, *, differences: bool = False) -> Run:
        """Motion up to a time, s, by scipy's Radau, with the Jacobian or its own differences."""
        began, calls = time.process_time(), sum(one.calls for one in self.contacts)
        self.failed = 0
        found = solve_ivp(self, (0.0, end), start, method="Radau", t_eval=times,
                          jac=None if differences else self.jacobian, rtol=RELATIVE,
                          atol=self.tolerance())
        if not found.success:
            raise RuntimeError(found.message)
        return Run(found.t, found.y, time.process_time() - began,
                   sum(one.calls for one in self.contacts) - calls, found.njev, self.failed)
