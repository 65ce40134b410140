"""Wheelsets are the same in every face: every figure of every contact, bit for bit."""

import math
import struct
import unittest

from installed import HOSTS, HostTest


class Faces(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.shell(f"gfortran -O1 '{HOSTS}/wheelset.f90' $(pkg-config --cflags --libs faststrip)"
                  " -o by_fortran")
        cls.lines = cls.shell("./by_fortran").splitlines()

    def rows(self, word):
        return [list(map(int, line.split()[1:])) for line in self.lines if line.startswith(word)]

    def test_what_is_compared(self):
        self.assertEqual(len(self.rows("solved")), 24)
        self.assertGreater(sum(status < 100 for status, _ in self.rows("solved")), 20)
        self.assertGreater(sum(n == 0 for _, n, _ in self.rows("wheel")), 1)
        sides = [row[0] for row in self.rows("contact")]
        self.assertGreater(min(sides.count(1), sides.count(2)), 12)
        self.assertGreater(len(set(self.lines)), 200)

    def test_c_has_the_bits_of_fortran(self):
        self.shell(f"gcc -O1 -Wall -Wextra -Werror '{HOSTS}/wheelset.c'"
                   " $(pkg-config --cflags --libs faststrip) -o by_c")
        self.assertEqual(self.shell("./by_c").splitlines(), self.lines)

    def test_fixed_form_fortran_has_them(self):
        self.shell(f"gfortran -std=legacy -Wall -O1 '{HOSTS}/wheelset.f'"
                   " $(pkg-config --libs faststrip) -o by_f77")
        self.assertEqual(self.shell("./by_f77").splitlines(), self.lines)

    def test_python_has_them(self):
        package = self.import_package()
        lines = []
        for of_points in (False, True):
            wheelset, z, roll = make(package, of_points), 0.0, 0.0
            for i in range(1, 13):
                status, contacts = 100, ()
                wanted = ask(i, z, roll)
                try:
                    result = wheelset.solve(**wanted)
                    status, contacts = result.status, result.contacts
                except package.FaststripError as problem:
                    status = problem.status
                lines.append(f"solved {status} {len(contacts)}")
                for side, name in enumerate(("right", "left")):
                    if status >= 100 or wanted["wheels"] not in ("both", name):
                        continue
                    mine = [one for one in contacts if one.side == name]
                    z, roll = result.z[side], result.roll
                    lines.append((len(mine), result.n_solutions[side]))
                    lines.append(bits(z, roll, *result.force[side], *result.force_wheelset[side],
                                      *result.moment[side]))
                    lines += [row for one in mine for row in rows_of(one)]
        wanted = [line for line in self.lines if not line.startswith("contact")]
        wanted = [tuple(map(int, line.split()[2:])) if line.startswith("wheel") else line
                  for line in wanted]
        self.assertEqual(lines, wanted)

    def test_python_refuses_by_name(self):
        package = self.import_package()
        wheelset = package.Wheelset(strips_per_patch=5)
        for call, text in (
                (lambda: wheelset.solve(), "one of z, load and axle_load must be given"),
                (lambda: wheelset.solve(load=1e4, axle_load=1e4), "one of z, load and axle_load"),
                (lambda: wheelset.solve(load=(1e4, 2e4, 3e4)), "load must be right and left"),
                (lambda: wheelset.solve(load=-1.0), "the vertical force must be above 0"),
                (lambda: wheelset.solve(load=1e4, y=math.nan), "y must be finite"),
                (lambda: wheelset.solve(load=1e4, wheels="none"), "wheels must be one of both"),
                (lambda: wheelset.solve(load=1e4, y=500.0), "no_contact"),
                (lambda: package.Wheelset("round"), "must be s1002, cone20 or cone40, got round"),
                (lambda: package.Wheelset(rail=3), "rail must be a Profile of a rail or a name"),
                (lambda: package.Wheelset(normal="auto"), "must not be auto"),
                (lambda: package.Wheelset(radius=-1.0), "nominal radius")):
            with self.assertRaises(package.FaststripError) as caught:
                call()
            self.assertIn(text, str(caught.exception))
        with wheelset:
            self.assertEqual(wheelset.solve(z=-5.0).contacts, ())
        with self.assertRaisesRegex(package.FaststripError, "closed"):
            wheelset.solve(load=1e4)


def bits(*numbers):
    return " ".join(struct.pack(">d", number).hex().upper() for number in numbers)


def rows_of(one):
    """The rows of the other languages' programs, zero where nothing is estimated."""
    estimates = [0.0 if value is None else value for value in one[-6:]]
    return (bits(*one.place, one.contact_angle, *one.rail, *one.wheel),
            bits(one.radius, one.speed, one.cksi, one.ceta, one.cphi),
            bits(one.load, one.penetration, one.area), bits(one.pmax, one.y_min, one.y_max),
            bits(one.x_max, one.fx, one.fy), bits(one.mz, one.friction_power),
            bits(one.stick_fraction, *one.force, *one.force_wheelset), bits(*one.moment),
            bits(*estimates[:2]), bits(*estimates[2:4]), bits(*estimates[4:]))


def make(package, of_points):
    wheel, rail, more = "s1002", "60e1", {}
    if of_points:
        y = [float(k - 30) for k in range(61)]
        wheel = package.Profile(y, [-k * k / 2000.0 - k / 20.0 for k in y])
        rail = package.Profile(y, [k * k / 600.0 for k in y])
        more = {"rail_distance": 1500.0, "wheel_left": "cone40"}
    return package.Wheelset(wheel, rail, radius_left=460.25, cant=0.05, mu=0.35,
                            strips_per_patch=9, **more)


def ask(i, z, roll):
    wanted = {"y": 0.5 * i - 3.0, "yaw": 0.001 * i, "speed": 20000.0, "y_rate": 10.0 * i,
              "z_rate": 1.0, "roll_rate": 0.001, "yaw_rate": 0.01 * i,
              "pitch_rate": -20000.0 / 460.0, "curvature": 1e-6, "roll_moment": 1e6,
              "warm_start": i % 2 == 1, "wheels": "both"}
    wanted.update([{"z": z}, {"load": (6e4, 5e4)}, {"axle_load": 1.2e5}][i % 3])
    if i % 3 == 0 or i >= 7:
        wanted["roll"] = roll
    if i % 3 < 2 and i >= 9:
        wanted["wheels"] = "right" if i % 2 else "left"
    return wanted


if __name__ == "__main__":
    unittest.main()
