"""Derivatives of forces over position, velocity and creepages, by the interfaces for hosts."""

import math

import numpy as np

from installed import HostTest

COORDINATES = ("y", "z", "roll", "yaw", "y_rate", "z_rate", "roll_rate", "yaw_rate", "pitch_rate")
STATE = {"y": 1.0, "yaw": 2e-3, "speed": 2e4, "y_rate": 30.0, "yaw_rate": -4e-3}


# Steps of differences, and how far apart they may be from derivatives, of the largest of a column:
# kinks of sliding elements are within these steps.
STEPS = (1e-4, 1e-4, 1e-7, 1e-6, 1e-2, 1e-1, 1e-5, 1e-5, 1e-5)
APART = (4e-3, 2e-4, 3e-4, 1e-4, 5e-6, 1e-6, 1e-5, 3e-6, 3e-6)


class Derivatives(HostTest):
    def test_columns_and_rows_are_where_they_should_be(self):
        package = self.import_package()
        wheelset = package.Wheelset(estimate=False)
        rest = wheelset.solve(axle_load=1.2e5, **STATE)
        state = {**STATE, "z": rest.z[0], "roll": rest.roll, "z_rate": 0.0, "roll_rate": 0.0,
                 "pitch_rate": rest.pitch_rate}
        found = wheelset.solve(derivatives=True, **state).derivatives
        self.assertEqual(found.shape, (2, 6, 9))
        for k, (name, step, apart) in enumerate(zip(COORDINATES, STEPS, APART)):
            up, down = (wheelset.solve(**{**state, name: state[name] + way * step})
                        for way in (1, -1))
            slope = np.hstack([up.force - down.force, up.moment - down.moment]) / (2.0 * step)
            for side in range(2):
                for rows in (slice(0, 3), slice(3, 6)):
                    size = abs(slope[side, rows]).max()
                    self.assertLess(abs(found[side, rows, k] - slope[side, rows]).max(),
                                    apart * size, (name, side))

    def test_rails_on_springs_follow(self):
        package = self.import_package()
        for stiffness in (2e4, 6e4), (0.0, 6e4), (2e4, 0.0):
            wheelset = package.Wheelset(estimate=False, rail_stiffness=stiffness)
            rest = wheelset.solve(axle_load=1.2e5, **STATE)
            state = {**STATE, "z": rest.z[0], "roll": rest.roll, "z_rate": 0.0, "roll_rate": 0.0,
                     "pitch_rate": rest.pitch_rate}
            found = wheelset.solve(derivatives=True, **state).derivatives
            # A hard contact over a soft spring.
            if stiffness[1] > 0.0:
                self.assertLess(found[:, 2, 1].max(), stiffness[1])
            for k, (name, step) in enumerate(zip(COORDINATES, STEPS)):
                up, down = (wheelset.solve(**{**state, name: state[name] + way * 10.0 * step})
                            for way in (1, -1))
                slope = np.hstack([up.force - down.force, up.moment - down.moment]) / (20.0 * step)
                for side in range(2):
                    for rows in (slice(0, 3), slice(3, 6)):
                        size = abs(slope[side, rows]).max()
                        self.assertLess(abs(found[side, rows, k] - slope[side, rows]).max(),
                                        0.02 * size, (name, side, stiffness))

    def test_what_a_contact_gives_over_penetration_and_creepages(self):
        package = self.import_package()
        y = np.linspace(-12.0, 12.0, 241)
        contact = package.Contact(estimate=False)
        contact.set_gap(y, 2e-3 * y**2, np.full(y.shape, 1.1e-3))
        asked = {"penetration": 0.07, "creepage": (8e-4, -5e-4, 1e-4)}
        found = contact.solve(derivatives=True, **asked)
        self.assertIsNone(contact.solve(**asked).derivatives)
        self.assertEqual(found, contact.solve(**asked))
        self.assertNotIn("derivatives", found.to_pandas())
        slopes = found.derivatives
        self.assertAlmostEqual(slopes[0, 0] * 0.07 / found.load, 1.5, delta=1e-5)
        self.assertEqual(slopes[0, 1:].tolist(), [0.0] * 3)
        for j, step in enumerate((1e-6, 1e-6, 1e-7), 1):
            ends = []
            for way in (1, -1):
                creepage = list(asked["creepage"])
                creepage[j - 1] += way * step
                one = contact.solve(penetration=0.07, creepage=creepage)
                ends.append(np.array([one.fx, one.fy, one.mz]))
            slope = (ends[0] - ends[1]) / (2.0 * step)
            self.assertLess(abs(slopes[1:, j] - slope).max(), 2e-3 * abs(slope).max())

    def test_they_do_not_change_what_comes_after(self):
        package = self.import_package()
        with package.Wheelset() as asked, package.Wheelset() as silent:
            for i in range(5):
                state = {**STATE, "y": 1.0 + 0.01 * i, "axle_load": 1.2e5, "warm_start": True}
                first = asked.solve(derivatives=True, **state)
                second = silent.solve(**state)
                self.assertLess(abs(first.force - second.force).max(), 3e-6)
                self.assertEqual(first.word, second.word)

    def test_friction_that_falls_with_slip(self):
        package = self.import_package()
        friction = package.Friction("linear", kinetic_share=0.5, half_slip_speed=300.0)
        wheelset = package.Wheelset(friction=friction, estimate=False)
        rest = wheelset.solve(axle_load=1.2e5, **STATE)
        state = {**STATE, "z": rest.z[0], "roll": rest.roll}
        found = wheelset.solve(derivatives=True, **state).derivatives
        plain = package.Wheelset(estimate=False).solve(derivatives=True, **state).derivatives
        self.assertGreater(abs(found[:, 1, 4] / plain[:, 1, 4] - 1.0).min(), 1e-3)
        for k, name in ((4, "y_rate"), (7, "yaw_rate")):
            up, down = (wheelset.solve(**{**state, name: state[name] + way * STEPS[k]})
                        for way in (1, -1))
            slope = (up.force - down.force) / (2.0 * STEPS[k])
            for side in range(2):
                self.assertLess(abs(found[side, :3, k] - slope[side]).max(),
                                1e-5 * abs(slope[side]).max())

    def test_what_has_none_is_refused(self):
        package = self.import_package()
        with self.assertRaisesRegex(package.FaststripError, "methods that stay the same"):
            package.Wheelset(normal="auto").solve(axle_load=1.2e5, derivatives=True)
        contact = package.Contact(normal="auto")
        y = np.linspace(-10.0, 10.0, 101)
        contact.set_gap(y, 2e-3 * y**2, np.full(y.shape, 1e-3))
        with self.assertRaisesRegex(package.FaststripError, "methods that stay the same"):
            contact.solve(load=5e4, derivatives=True)
        with self.assertRaisesRegex(package.FaststripError, "derivatives"):
            package.Wheelset().solve(axle_load=1.2e5, derivatives=2.0)

    def test_other_methods_have_them_too(self):
        package = self.import_package()
        for normal, tangential in (("hertz", "polach"), ("strip", "fastsim"), ("hertz", "fastsim"),
                                   ("equal_area", "fastsim"), ("kpec", "faststrip"),
                                   ("strip", "none")):
            wheelset = package.Wheelset(normal=normal, tangential=tangential, estimate=False)
            rest = wheelset.solve(axle_load=1.2e5, **STATE)
            state = {**STATE, "z": rest.z[0], "roll": rest.roll}
            found = wheelset.solve(derivatives=True, **state).derivatives
            self.assertFalse(np.isnan(found).any(), (normal, tangential))
            up, down = (wheelset.solve(**{**state, "z": state["z"] + step})
                        for step in (2e-4, -2e-4))
            for side in range(2):
                slope = (up.force[side, 2] - down.force[side, 2]) / 4e-4
                self.assertTrue(math.isclose(found[side, 2, 1], slope, rel_tol=3e-4),
                                (normal, tangential, found[side, 2, 1], slope))
