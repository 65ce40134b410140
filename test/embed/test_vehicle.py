"""The vehicle of example/vehicle: it rolls, balances in a curve, and is the same in Fortran."""

import importlib.util
import sys
import unittest

import numpy as np

from installed import ROOT, HostTest

VEHICLE = ROOT / "example" / "vehicle"
NO_SCIPY = "" if importlib.util.find_spec("scipy") else "no scipy: tools/requirements-vehicle.txt"


@unittest.skipIf(NO_SCIPY, NO_SCIPY)
class Vehicle(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.import_package()
        sys.path.insert(0, str(VEHICLE))
        cls.addClassCleanup(sys.path.remove, str(VEHICLE))
        import bogie
        import contact
        import simulate
        import vehicle

        cls.bogie, cls.contact, cls.simulate = bogie, contact, simulate
        cls.vehicle = vehicle

    def motions(self, track, speed=35e3):
        return self.simulate.Motions(self.bogie.Bogie(track, speed),
                                     [self.contact.ByWheelset("strips") for _ in range(2)])

    def test_forces_balance_in_a_steady_curve(self):
        # All of it a curve: after a while only what curve and cant ask for is left.
        track = self.bogie.Track(straight=1.0, transition=2.0e4, curve=1.0e6, rough=0.0)
        motions = self.motions(track)
        run = motions.run(9.0, motions.start(), np.array([0.0, 8.5, 9.0]))
        self.assertEqual(run.failed, 0)
        moved = np.abs(run.y[:, 2] - run.y[:, 1])[:18]
        moved[[3, 8]] = 0.0  # wheelsets turn on
        self.assertLess(moved.max(), 2e-2)
        forces = motions.wheel_forces(9.0, run.y[:, 2]).sum((0, 1))
        mass = sum(self.bogie.MASS.values())
        outward = mass * 35e3**2 / track.radius
        weight = mass * self.bogie.GRAVITY
        cant = track.cant / (2 * self.bogie.TREAD)
        wanted = [outward * np.cos(cant) - weight * np.sin(cant),
                  -weight * np.cos(cant) - outward * np.sin(cant)]
        np.testing.assert_allclose(forces[1:3], wanted, rtol=1e-3)
        # The front wheelset goes outwards, to the left, and its outer wheel carries more.
        self.assertLess(run.y[0, 2], -1.0)
        self.assertLess(np.diff(motions.wheel_forces(9.0, run.y[:, 2])[0, :, 2])[0], -1e3)

    def test_the_jacobian_is_that_of_differences(self):
        motions = self.motions(self.bogie.Track())
        state = motions.start(0.7)
        state[[5, 18, 19, 22]] = 0.3, 11.0, 2.0, 1e-3
        jacobian = motions.jacobian(1.0, state)
        for k, step in ((0, 1e-6), (1, 1e-7), (2, 1e-9), (4, 1e-8), (18, 1e-2), (21, 1e-4),
                        (22, 1e-5), (12, 1e-6)):
            both = []
            for sign in (step, -step):
                there = state.copy()
                there[k] += sign
                both.append(motions(1.0, there))
            slope = (both[0] - both[1]) / (2 * step)
            # Of the pitch rate the derivatives are those of the yaw rate, turned.
            np.testing.assert_allclose(jacobian[:, k], slope, atol=5e-3 * np.abs(slope).max())

    def test_rates_of_rails_are_those_of_a_sloping_track(self):
        contact = self.contact.ByWheelset("strips")
        slope, speed = 2e-3, 35e3
        q, v = np.zeros((2, 5))
        q[1], v[3] = contact.height(1.09e5), -speed / self.contact.RADIUS

        def forces(across, down):
            """A wheelset that runs along a track with these slopes."""
            along_q, along_v = q.copy(), v.copy()
            along_q[4] = across
            along_v[:2] = speed * across, speed * down
            rails = np.array([0, 0, 0, 0, 0, speed * down, speed * down])
            return contact.forces(self.contact.Motion(along_q, along_v, speed, rails))

        straight = forces(0.0, 0.0)
        np.testing.assert_allclose(forces(0.0, slope), straight, atol=1.0, rtol=1e-5)
        self.assertLess(np.abs(forces(slope, 0.0) - straight)[:, :3].max(), 100.0)

    def test_a_table_has_the_forces_of_strips(self):
        self.write("wheel.nml", "&wheel profile = 's1002' /\n&rail profile = '60e1' /\n"
                   "&material mu = 0.3 /\n")
        self.shell(f"'{self.installed.prefix}/bin/faststrip' lookup wheel wheel.nml -o wheel.fslt"
                   " --error 0.1 --y 0:1 --yaw -2e-3:2e-3 --load 50000:130000 --tests 299 2>&1")
        motions = self.motions(self.bogie.Track())
        table = self.contact.ByWheelset("table", self.folder / "wheel.fslt")
        state = motions.start()
        state[[0, 2, 4, 18, 20, 22]] = 0.2, -6e-5, 5e-4, 15.0, 1e-4, 0.01
        # In its mirror the left wheel is where the right one is on the other side.
        rails = np.array([1e-6, -0.5, -0.02, 0.5, 0.02, 3.0, 3.0])
        motion = motions.motion(state, 0, rails)
        exact, found = motions.contacts[0].forces(motion), table.forces(motion)
        apart = np.abs(found - exact) / (0.3 * 54.5e3)
        self.assertLess(apart[:, :3].max(), 0.1)
        self.assertGreater(np.abs(exact[:, 0]).min(), 0.3 * 0.3 * 54.5e3)
        self.assertEqual(table.solve(motion).n_solutions, (0, 0))
        exact, found = (one.derivatives(motion) for one in (motions.contacts[0], table))
        for k, c in ((0, 1), (0, 2), (0, 4), (1, 0), (1, 2), (1, 3)):
            apart = np.abs(found - exact)[:3, k, c].max()
            self.assertLess(apart, 0.1 * np.abs(exact[:3, k, c]).max(), (k, c))

    def test_pictures_are_drawn_of_runs(self):
        _, run = self.vehicle.through_curve("strips", self.folder, True, 0.05)
        self.assertEqual((len(run.t), run.failed), (6, 0))
        self.assertGreater(run.calls, 2 * run.jacobians)
        forces = self.vehicle.wheel_forces("strips", self.folder, True, run)
        # On the rails, down: the weight.
        weight = self.bogie.GRAVITY * sum(self.bogie.MASS.values())
        np.testing.assert_allclose(forces[..., 2].sum((1, 2)), weight, rtol=0.02)
        methods = self.contact.METHODS
        self.vehicle.draw_curve(self.folder / "curve.png", dict.fromkeys(methods, run), True)
        self.vehicle.draw_forces(self.folder / "forces.png", run.t, dict.fromkeys(methods, forces),
                                 dict.fromkeys(methods, forces))
        self.vehicle.draw_limit_cycles(self.folder / "cycle.png", {"strips": [(60, 1), (70, 5)]})
        for name in ("curve", "forces", "cycle"):
            self.assertGreater((self.folder / f"{name}.png").stat().st_size, 1e4)

    def test_fortran_has_the_same_rates_and_jacobian(self):
        self.shell(f"gfortran -O1 -Wall -Wno-compare-reals '{VEHICLE}/vehicle.f90' $(pkg-config"
                   " --cflags --libs faststrip) $(pkg-config --libs lapack || echo -llapack)"
                   " -o vehicle")
        motions = self.motions(self.bogie.Track(straight=1.0e3, transition=1.0e4))
        n, steps, step = motions.size, 4, 0.002
        state = motions.start(1.0)
        times = 0.3 + step * np.arange(steps)
        numbers = [n, steps, step, motions.bogie.speed, motions.bogie.rolling,
                   *motions.bogie.masses, *motions.fixed.T.ravel(), *state]
        for t in times:
            forces, rails = motions.bogie.track_forces(motions.bogie.speed * t)
            numbers += [*forces, *rails[0], *rails[1]]
        self.write("numbers", "\n".join(f"{one!r}" for one in map(float, numbers)).replace(
            f"{float(n)!r}\n{float(steps)!r}", f"{n} {steps}", 1))
        rows = self.shell("./vehicle <numbers").splitlines()
        self.assertEqual(len(rows), 3 * steps)
        for k, t in enumerate(times):
            state, rates, jacobian = (np.fromstring(row, sep=" ") for row in rows[3 * k:3 * k + 3])
            exact = motions(t, state)
            np.testing.assert_allclose(rates, exact, atol=1e-6 * np.abs(exact).max())
            exact = motions.jacobian(t, state)
            apart = np.abs(jacobian.reshape(2 * n, 2 * n).T - exact)
            self.assertTrue((apart <= 1e-4 * np.abs(exact).max(0)).all())
        self.assertGreater(np.abs(state[:n] - motions.start(1.0)[:n]).max(), 1e-3)
