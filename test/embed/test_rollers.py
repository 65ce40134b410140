"""Wheels on rollers: CONTACT's examples, and the same in the program, C, F77 and Python."""

import csv
import ctypes
import math

import numpy as np

from installed import ROOT, HostTest

Y = np.linspace(-50.0, 50.0, 1001)
PROFILES = {"flat": 0.0 * Y, "round": 100.0 - np.sqrt(100.0**2 - Y**2), "conical": Y * np.tan(0.2)}
# What a millimetre stands for where CONTACT's case has the wheel on the axis of yaw.
NEARLY_0 = 1e-3


class Rollers(HostTest):
    def pair_of(self, package, row):
        return (package.Profile(Y, -PROFILES[row["wheel"]], "wheel"),
                package.Profile(Y, PROFILES[row["roller"]], "rail"))

    def test_rollers_of_contact(self):
        package = self.import_package()
        text = (ROOT / "reference" / "wheelset" / "rollers.csv").read_text(encoding="utf-8")
        rows = list(csv.DictReader(line for line in text.splitlines() if line[0] != "#"))
        self.assertEqual(len(rows), 5)
        for row in rows:
            name = row["case"]
            wanted = {key: float(one) for key, one in row.items()
                      if key not in ("case", "wheel", "roller")}
            wheel, rail = self.pair_of(package, row)
            line = max(wanted["y_line_mm"], NEARLY_0)
            with package.Wheelset(wheel, rail, inclination=0.0, radius=133.33333,
                                  back_spacing=line, tread_line=0.5 * line, roller_radius=400.0,
                                  rail_distance=2.0 * line, estimate=False) as wheelset:
                found = wheelset.solve(
                    y=0.0, z=wanted["z_mm"], roll=wanted["roll_rad"], yaw=wanted["yaw_rad"],
                    speed=wanted["speed_mm_s"], y_rate=wanted["y_rate_mm_s"],
                    pitch_rate=wanted["pitch_rate_rad_s"], wheels="right").contacts[0]
            # To the printed digits, and what the distance of 0.001 mm turns into.
            for value, column, near in (
                    (found.place[1], "y_track_mm", 1e-3), (found.place[2], "z_track_mm", 1e-4),
                    (found.contact_angle, "contact_angle_rad", 1e-6),
                    (found.cksi, "cksi", 4e-7), (found.ceta, "ceta", 1e-9),
                    (found.cphi, "cphi_rad_per_mm", 6e-7),
                    (found.speed, "rolling_speed_mm_s", 6e-3),
                    (found.penetration, "penetration_mm", 4e-5)):
                self.assertAlmostEqual(value, wanted[column], delta=near, msg=f"{name} {column}")
            yawed = wanted["yaw_rad"] != 0.0
            self.assertAlmostEqual(found.load / wanted["N_N"], 1.0, msg=name,
                                   delta=5e-3 if yawed else 1e-3)
            self.assertAlmostEqual(found.pmax / wanted["pmax_MPa"], 1.0, msg=name,
                                   delta=1.2e-2 if yawed else 1e-3)
            most = 0.3 * wanted["N_N"]
            for value, column in ((found.fx, "Fx_N"), (found.fy, "Fs_N")):
                self.assertAlmostEqual(value, wanted[column], delta=2e-3 * most, msg=name)
            self.assertAlmostEqual(found.force[2] / wanted["Fz_track_N"], 1.0, msg=name,
                                   delta=5e-3 if yawed else 1e-3)

    def test_every_interface_has_the_bits_of_the_program(self):
        package = self.import_package()
        run = f"'{self.installed.prefix}/bin/faststrip' wheelset"
        self.shell(f"{run} '{ROOT}/example/roller_rig.nml' --states"
                   f" '{ROOT}/example/roller_rig_states.csv' -o rig.csv")
        lines = (self.folder / "rig.csv").read_text(encoding="utf-8").splitlines()
        rows = {row["side"]: row for row in csv.DictReader(line for line in lines
                                                           if line[0] != "#")
                if row["case"] == "20"}
        state = {"y": 3.0, "yaw": 0.005, "speed": 2e4, "axle_load": 1.6e5}
        wheelset = package.Wheelset(roller_radius=500.0)
        result = wheelset.solve(**state)
        for one in result.contacts:
            for column, value in (("N_N", one.load), ("Fx_track_N", one.force[0]),
                                  ("x_track_mm", one.place[0]), ("Mz_Nmm", one.mz),
                                  ("cphi_rad_per_mm", one.cphi)):
                self.assertEqual(float(rows[one.side][column]), value, (one.side, column))
        on_rails = package.Wheelset().solve(**state)
        for rolled, plain in zip(result.contacts, on_rails.contacts):
            # First order: on a rail ahead by as much more as both radii are than the roller's.
            self.assertAlmostEqual(rolled.place[0] / plain.place[0], 500.0 / 960.0, delta=0.02)
            self.assertAlmostEqual(rolled.cphi / plain.cphi, 1.0 + 460.0 / 500.0, delta=0.05)
        self.check_fixed_form(result, wheelset.solve(axle_moment=-1e7, **state))

    def check_fixed_form(self, result, driven):
        """FSROLL puts on rollers what FSWNEW made; FSAXLE drives it."""
        library = ctypes.CDLL(str(self.installed.library))
        i, d = ctypes.c_int, ctypes.c_double
        iopt, par, setup = (i * 9)(), (d * 9)(), (d * 9)()
        library.fsdflt_(iopt, par)
        library.fswdft_(setup)
        setup[8] = 0.0
        profiles, iwork, info = (i * 4)(-1, 0, -2, 0), (i * 8)(), i()
        library.fswnew_(iopt, par, setup, profiles, (d * 1)(), (d * 1)(), iwork,
                        ctypes.byref(i(8)), ctypes.byref(info))
        self.assertEqual(info.value, 0)
        for radius, wanted in ((-500.0, 103), (math.nan, 103), (20.0, 103), (500.0, 0)):
            library.fsroll_(iwork, ctypes.byref(d(radius)), ctypes.byref(info))
            self.assertEqual(info.value != 0, wanted != 0, radius)
        n, wres, cont = i(), (d * 27)(), (d * (48 * 8))()
        state = (d * 11)(3.0, 0.0, 0.0, 0.005, 2e4)
        pitch_rate = d()
        for is_given, wanted in ((0, result), (1, driven)):
            library.fsaxle_(iwork, ctypes.byref(i(is_given)), ctypes.byref(d(-1e7)),
                            ctypes.byref(info))
            library.fswslv_(iwork, state, (i * 4)(2, 0, 1, 0), (d * 4)(0.0, 0.0, 1.6e5, 0.0),
                            ctypes.byref(i(8)), ctypes.byref(n), cont, wres, ctypes.byref(info))
            self.assertEqual((info.value, n.value), (0, 2))
            self.assertEqual(list(wres[3:6]), list(wanted.force[0]))
            library.fsprat_(iwork, ctypes.byref(pitch_rate), ctypes.byref(info))
            self.assertEqual(pitch_rate.value, wanted.pitch_rate)
        library.fswfre_(iwork, ctypes.byref(info))

    def test_the_gap_on_a_roller_is_that_of_the_program(self):
        package = self.import_package()
        (self.folder / "gap.nml").write_text(
            "&contact\n  load_N = 8e4\n  shift_mm = 3\n/\n&wheel\n  profile = 's1002'\n/\n&rail\n"
            "  profile = '60e1'\n  roller_radius_mm = 500\n/\n&material\n  mu = 0.3\n/\n"
            "&motion\n  creepage = 'formula'\n/\n", encoding="utf-8")
        program = f"'{self.installed.prefix}/bin/faststrip' contact"
        self.shell(f"{program} gap.nml -o gap.csv --gap on_roller.csv")
        inv2r = np.loadtxt(self.folder / "on_roller.csv", delimiter=",", skiprows=3)[:, 2]
        gap = package.profile_gap("s1002", "60e1", shift=3.0, roller_radius=500.0)
        self.assertEqual(inv2r.tolist(), gap.inv2r.tolist())
        plain = package.profile_gap("s1002", "60e1", shift=3.0)
        self.assertEqual(gap.h.tolist(), plain.h.tolist())
        middle = np.argmin(abs(gap.y))
        self.assertAlmostEqual(gap.inv2r[middle] - plain.inv2r[middle],
                               0.5 * math.cos(gap.angle) / 500.0, delta=3e-6)
        for wrong in (-1.0, math.inf, 5.0):
            with self.assertRaises((package.FaststripError, ValueError)):
                package.profile_gap("s1002", "60e1", roller_radius=wrong)
            with self.assertRaises((package.FaststripError, ValueError)):
                package.Wheelset(roller_radius=wrong)
