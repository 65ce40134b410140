"""Profiles from hosts: files through Python, points through C and fixed-form Fortran."""

import ctypes
import math
import os
import unittest

from installed import HostTest

F77 = """\
      PROGRAM TRY
      INTEGER NW, NR, NGAP, INFO, I
      PARAMETER (NW = 161, NR = 121)
      DOUBLE PRECISION YW(NW), ZW(NW), YR(NR), ZR(NR), SETUP(9), A
      DOUBLE PRECISION Y(2000), H(2000), AX(2000), TURN(2000), CONT(6)
      DATA SETUP /1360D0,70D0,460D0,1435D0,14D0,0D0,0D0,.05D0,.6D0/
      DO 10 I = 1, NW
         YW(I) = -40D0 + .5D0*(I - 1)
   10    ZW(I) = -YW(I)**2/2000D0
      DO 20 I = 1, NR
         A = 1.5D0*(I - 61)/60D0
         YR(I) = 36D0*SIN(A)
   20    ZR(I) = 36D0 - 36D0*COS(A)
      CALL FSPROF(NW, YW, ZW, NR, YR, ZR, SETUP, 2000, NGAP, Y, H, AX,
     &            TURN, CONT, INFO)
      PRINT *, INFO, NGAP, CONT(2), CONT(4)
      CALL FSPROF(NW, YW, ZW, NR, YR, ZR, SETUP, 3, NGAP, Y, H, AX,
     &            TURN, CONT, INFO)
      PRINT *, INFO, NGAP
      SETUP(3) = -1D0
      CALL FSPROF(NW, YW, ZW, NR, YR, ZR, SETUP, 2000, NGAP, Y, H, AX,
     &            TURN, CONT, INFO)
      PRINT *, INFO
      END
"""


class Points(HostTest):
    def test_fixed_form_fortran_takes_points(self):
        done = self.compiled_f77(F77)
        rows = [line.split() for line in done.splitlines()]
        self.assertEqual(rows[0][0], "0")
        self.assertAlmostEqual(float(rows[0][2]), 460.0, delta=0.5)
        self.assertEqual(rows[1], ["110", rows[0][1]])
        self.assertEqual(rows[2], ["100"])

    def compiled_f77(self, text):
        self.write("try.f", text)
        return self.shell("gfortran -std=legacy try.f -o try $(pkg-config --libs faststrip)\n./try")


class Python(HostTest):
    def setUp(self):
        os.environ["FASTSTRIP_PREFIX"] = str(self.installed.prefix)
        self.addCleanup(os.environ.pop, "FASTSTRIP_PREFIX", None)
        self.write("r.txt", "".join(
            f"{36 * math.sin(a / 100)} {36 - 36 * math.cos(a / 100)}\n" for a in range(-150, 151)))
        self.write("w.prw", "header.begin\ntype = 1\nheader.end\nspline.begin\npoint.begin\n"
                   + "".join(f"{y / 4} {-(y / 4) ** 2 / 2000}\n" for y in range(-160, 161))
                   + "point.end\nspline.end\n")

    def test_files_become_profiles_and_gaps(self):
        faststrip = self.import_package()
        os.environ["FASTSTRIP_PREFIX"] = str(self.installed.prefix)
        wheel = faststrip.Profile.read(self.folder / "w.prw")
        rail = faststrip.Profile.read(self.folder / "r.txt", kind="rail", shift_z=1)
        self.assertEqual((wheel.kind, wheel.format, rail.kind), ("wheel", "simpack", "rail"))
        self.assertAlmostEqual(rail.z.min(), 1.0, delta=1e-12)
        self.assertIsNone(wheel.sd)
        gap = faststrip.profile_gap(wheel, rail, shift=1.0, inclination=0.0)
        finer = faststrip.profile_gap(wheel, rail, shift=1.0, inclination=0.0, step=0.001)
        self.assertAlmostEqual(gap.y_rail, finer.y_rail, delta=1e-12)
        self.assertGreater(len(finer.y), 4000)
        contact = faststrip.Contact()
        contact.set_gap(*gap[:3], gap.inclination)
        self.assertGreater(contact.solve(load=1e5, creepage=(0, 0, 0), mu=0.3).pmax, 1000.0)
        for call, text in (
                (lambda: faststrip.Profile.read("none.txt"), "no such file: none.txt"),
                (lambda: faststrip.profile_gap(rail, wheel), "wheel must be a Profile of a wheel"),
                (lambda: faststrip.profile_gap(wheel, rail, inclination=0, radius=-1.0),
                 "bad_argument"),
                (lambda: faststrip.Profile([1.0, 2.0], [1.0]), "y and z must be two arrays")):
            with self.assertRaises(faststrip.FaststripError) as caught:
                call()
            self.assertIn(text, str(caught.exception))

    def test_gaps_of_names_are_those_of_the_program(self):
        faststrip = self.import_package()
        self.write("case.nml", "&contact load_N = 9e4, shift_mm = 1.5 /\n&wheel profile = 's1002' "
                   "/\n&rail profile = '60e1' /\n&material mu = 0.3 /\n&motion creepage = 'given' "
                   "/\n")
        self.shell("faststrip='%s'; $faststrip contact case.nml --gap gap.csv -o result.csv"
                   % (self.installed.prefix / "bin" / "faststrip"))
        lines = (self.folder / "gap.csv").read_text(encoding="utf-8").splitlines()
        rows = [[float(cell) for cell in line.split(",")] for line in lines
                if not line.startswith(("#", "y_mm"))]
        gap = faststrip.profile_gap("s1002", "60e1", shift=1.5)
        self.assertEqual([list(row) for row in zip(*gap[:3])], rows)
        self.assertEqual(gap.n_clipped, (0, 0))
        self.assertNotEqual(faststrip.profile_gap("s1002", "60e1", shift=1.5, cant=0.05).angle,
                            gap.angle)
        with self.assertRaisesRegex(faststrip.FaststripError, "must be s1002, .* got s1003"):
            faststrip.profile_gap("s1003", "60e1")
        with self.assertRaisesRegex(faststrip.FaststripError, "do not overlap at the shift 500"):
            faststrip.profile_gap("s1002", "60e1", shift=500.0)

    def test_profiles_are_drawn(self):
        faststrip = self.import_package()
        y, z = faststrip.draw_profile("60e1", "rail", cant=0.0, n=5)
        self.assertEqual((y + y[::-1]).round(9).tolist(), [0.0] * 5)
        self.assertEqual((z - z[::-1]).round(9).tolist(), [0.0] * 5)
        self.assertEqual((round(z[2], 9), z[0] > z[1] > 0.0), (0.0, True))
        canted = faststrip.draw_profile("60e1", "rail", n=5)
        self.assertNotEqual(list(canted[1]), list(z))
        points = faststrip.Profile([-40.0, -20.0, 0.0, 20.0, 40.0], [2.0, 1.0, 0.0, -1.0, -2.0])
        y, z = faststrip.draw_profile(points, "wheel", cant=0.1, n=3)
        self.assertEqual((list(y), [round(value, 12) for value in z]),
                         ([-40.0, 0.0, 40.0], [2.0, 0.0, -2.0]))
        for words, text in ((("60e1", "wheel"), "must be s1002"), (("60e1", "track"), "kind"),
                            (("60e1", "rail", 1), "n must be a whole number from 2")):
            with self.assertRaisesRegex(faststrip.FaststripError, text):
                faststrip.draw_profile(*words[:2], n=words[-1] if len(words) == 3 else 9)

    def test_gaps_of_a_wheelset_are_what_it_solved(self):
        faststrip = self.import_package()
        wheelset = faststrip.Wheelset(tangential="none", estimate=False)
        with self.assertRaisesRegex(faststrip.FaststripError, "no such contact: 0"):
            wheelset.gap(0)
        found = wheelset.solve(y=2.0, yaw=5e-3, load=9e4)
        contact = faststrip.Contact(tangential="none", estimate=False)
        for i, expected in enumerate(found.contacts):
            contact.set_gap(*wheelset.gap(i))
            result = contact.solve(load=expected.load)
            for one, other in ((result.pmax, expected.pmax), (result.area, expected.area),
                               (result.penetration, expected.penetration)):
                self.assertAlmostEqual(one / other, 1.0, delta=1e-6)
            self.assertAlmostEqual(result.y_min, expected.y_min, delta=1e-5)
            self.assertAlmostEqual(result.y_max, expected.y_max, delta=1e-5)
        self.assertEqual({one.side for one in found.contacts}, {"right", "left"})
        with self.assertRaisesRegex(faststrip.FaststripError, "no such contact: 2"):
            wheelset.gap(len(found.contacts))

    def test_missing_arrays_are_told(self):
        faststrip = self.import_package()
        library = faststrip._library.library
        text = ctypes.create_string_buffer(257)
        numbers = (ctypes.c_double * 9)()
        n = ctypes.c_int()
        for call in (
                lambda: library.faststrip_pair_gap(None, None, None, 0, n, *[None] * 5, text, 257),
                lambda: library.faststrip_pair_gap(None, None, numbers, 9, n, *[numbers] * 5, text,
                                                   257),
                lambda: library.faststrip_draw_profile(None, 1, 0.0, 9, numbers, numbers, text,
                                                       257),
                lambda: library.faststrip_draw_profile(None, 1, 0.0, 9, None, numbers, None, 0),
                lambda: library.faststrip_draw_profile(None, 1, 0.0, -1, numbers, numbers, None,
                                                       0)):
            self.assertEqual(call(), 100)
        self.assertEqual(text.value, b"the rail profile is missing")

    def test_the_program_is_said_to_be_missing(self):
        faststrip = self.import_package()
        os.environ["FASTSTRIP_PREFIX"] = str(self.folder)
        with self.assertRaisesRegex(faststrip.ProgramNotFound, "FASTSTRIP_PROGRAM"):
            faststrip.Profile.read(self.folder / "w.prw")


if __name__ == "__main__":
    unittest.main()
