"""Profiles from hosts: files and points through Python, C and fixed-form Fortran."""

import csv
import ctypes
import dataclasses
import math
import os
import pathlib
import random
import struct
import subprocess
from unittest import mock

import numpy as np

from installed import HostTest
from mutated_profiles import good_files, mutated

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


# Reads with room for N points and for all, and says what came.
READ_C = r"""
#include <faststrip.h>
#include <stdio.h>
#include <stdlib.h>
int main(int count, char **words)
{
    static double y[5000], z[5000];
    char text[FASTSTRIP_TEXT];
    faststrip_reading reading;
    faststrip_profile_about about;
    int n = -1, status, sizes = faststrip_default_reading(&reading, sizeof reading - 8);
    sizes += faststrip_default_reading(NULL, sizeof reading);
    printf("%d %d\n", sizes, faststrip_default_reading(&reading, sizeof reading));
    status = faststrip_read_profile(words[1], NULL, 3, &n, y, z, NULL, NULL, 0);
    printf("%d %d\n", status, n);
    status = faststrip_read_profile(words[1], NULL, 5000, &n, y, z, &about, text, sizeof text);
    printf("%d %d %.17g %.17g [%s] %d %s %d %.17g\n", status, n, y[0], z[n - 1], text, about.kind,
           about.format, about.has_flange, about.sd);
    reading.section = -1;
    status = faststrip_read_profile(words[1], &reading, 5000, &n, y, z, &about, text, sizeof text);
    printf("%d %s\n", status, text);
    reading.section = 0, reading.unit = 1000.0, reading.shift[1] = 2.0;
    status = faststrip_read_profile(words[1], &reading, 5000, &n, y, z, &about, text, sizeof text);
    printf("%d %s\n", status, text);
    status = faststrip_read_profile("none.txt", &reading, 9, &n, y, z, NULL, text, sizeof text);
    printf("%d %s\n", status, text);
    reading.size = 8;
    printf("%d %d %d %d\n", faststrip_read_profile(words[1], &reading, 9, &n, y, z, NULL, NULL, 0),
           faststrip_read_profile(NULL, NULL, 9, &n, y, z, NULL, NULL, 0),
           faststrip_read_profile(words[1], NULL, 9, &n, y, NULL, NULL, NULL, 0),
           faststrip_read_profile(words[1], NULL, -1, &n, y, z, NULL, NULL, 0));
    return count - 2;
}
"""

WHEEL = ("header.begin\ntype = 1\nheader.end\nspline.begin\npoint.begin\n"
         + "".join(f"{y / 4} {-(y / 4) ** 2 / 2000}\n" for y in range(-160, 161))
         + "point.end\nspline.end\n")

READ_F77 = """\
      PROGRAM READ
      INTEGER N, INFO
      DOUBLE PRECISION Y(2000), Z(2000)
      CHARACTER*72 TEXT
      CALL FSRDPR('w.prw', 0, 2000, N, Y, Z, TEXT, INFO)
      WRITE (*, '(2I5, 2F12.6, 1X, A)') INFO, N, Y(1), Z(N), TEXT
      CALL FSRDPR('w.prw', 2, 2000, N, Y, Z, TEXT, INFO)
      WRITE (*, '(2I5, 1X, A)') INFO, N, TEXT
      CALL FSRDPR('w.prw   ', 1, 3, N, Y, Z, TEXT, INFO)
      WRITE (*, '(2I5, 1X, A)') INFO, N, TEXT
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

    def test_fixed_form_fortran_reads_files(self):
        self.write("w.prw", WHEEL)
        rows = [line.rstrip().split(None, 2) for line in self.compiled_f77(READ_F77).splitlines()]
        self.assertEqual(rows[0][:2], ["0", "321"])
        self.assertEqual([float(word) for word in rows[0][2].split()], [-40.0, -0.8])
        self.assertEqual(rows[1], ["121", "0", "the profile must be that of a rail, the file is "
                                   "that of a wheel (w.prw)"])
        self.assertEqual(rows[2], ["110", "321",
                                   "the profile has more points than the arrays: 321"])

    def compiled_f77(self, text):
        self.write("try.f", text)
        return self.shell("gfortran -std=legacy try.f -o try $(pkg-config --libs faststrip)\n./try")


class Files(HostTest):
    """The readers of the library are those of the program."""

    def setUp(self):
        # No program is there.
        patch = mock.patch.dict(os.environ, {"FASTSTRIP_LIBRARY": str(self.installed.library)})
        patch.start()
        self.addCleanup(patch.stop)
        self.package = self.import_package()

    def by_program(self, *words):
        program = self.installed.prefix / "bin" / "faststrip"
        return subprocess.run([program, "profile", *words], cwd=self.folder, encoding="utf-8",
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, check=False)

    def agree(self, row, name, **options):
        """Does the library say of a file what a row of the program does?"""
        try:
            profile = self.package.Profile.read(self.folder / name, **options)
        except self.package.FaststripError as problem:
            self.assertEqual(problem.word, row["status"])
            words = problem.message.replace(f"{self.folder}/", "")
            # What does not fit is cut.
            if len(problem.message) < 250:
                self.assertEqual(words, row["message"])
            return None
        self.assertEqual((row["status"], row["message"]), ("ok", profile.message))
        found = (profile.format, profile.kind, len(profile.y), profile.y.min(), profile.z.max(),
                 profile.sd, profile.sh, profile.qr)
        self.assertEqual(found, (row["format"], row["kind"], int(row["points"]), *(
            float(row[name]) if row[name] else None
            for name in ("y_min_mm", "z_max_mm", "Sd_mm", "Sh_mm", "qR_mm"))))
        return profile

    def rows(self, done):
        return list(csv.DictReader(line for line in done.stdout.splitlines()
                                   if not line.startswith("#")))

    def test_every_format_and_option_gives_the_points_of_the_program(self):
        ways = [{}, {"kind": "rail", "y_positive_to": "gauge", "z_positive_to": "up"},
                {"unit": "in", "section": 2, "side": "left"}, {"tape_circle": 1.5, "rotate": 2.5},
                {"any_count": True, "ignore_smoothing": True, "keep": (-30.0, 25.0), "cant": 0.025},
                {"drop_double": 0.1, "drop_folds": True, "mirror": True, "shift_y": 2.0,
                 "shift_z": -0.3}, {"smooth_wavelength": 3.0, "kink_angle": 10.0},
                {"smooth_noise": 12.0, "round_kinks": True}, {"resample": 0.4}]
        formats, good = set(), [0] * len(ways)
        for name, lines in good_files(None):
            self.write(name, "\n".join(lines) + "\n")
            for k, options in enumerate(ways):
                words = []
                for option, value in options.items():
                    words.append("--" + option.replace("_", "-"))
                    if value is not True:
                        words.append(",".join(map(str, value)) if isinstance(value, tuple)
                                     else str(value))
                with self.subTest(name, **options):
                    done = self.by_program(*words, "-o", "points.csv", name)
                    profile = self.agree(*self.rows(done), name, **options)
                    if profile is None:
                        continue
                    good[k] += 1
                    formats.add(profile.format)
                    written = np.loadtxt((line for line in open(self.folder / "points.csv")
                                          if not line.startswith(("#", "y"))), delimiter=",")
                    self.assertEqual(np.column_stack((profile.y, profile.z)).tolist(),
                                     written.tolist())
        self.assertEqual(formats, {"simpack", "miniprof", "miniprof mpt", "vampire", "gensys",
                                   "text"})
        self.assertGreater(min(good), 0)

    def test_what_is_wrong_with_files_is_told_in_the_words_of_the_program(self):
        rng, files, names = random.Random(7), good_files(None), []
        for i in range(150):
            name, data = mutated(rng, files)
            names.append(f"{i}{name}")
            (self.folder / names[-1]).write_bytes(data)
        rows = self.rows(self.by_program(*names))
        for name, row in zip(names, rows, strict=True):
            with self.subTest(name):
                self.agree(row, name)
        self.assertGreater(len({row["message"] for row in rows}), 50)

    def test_options_that_cannot_be_are_refused(self):
        self.write("w.prw", WHEEL)
        read = self.package.Profile.read
        for options, text in (
                ({"kind": "track"}, "kind must be one of wheel, rail, got 'track'"),
                ({"side": None}, "side must be one of right, left"),
                ({"unit": ["m"]}, "unit must be one of mm, m, in"),
                ({"section": 0}, "section must be a whole number from 1"),
                ({"keep": (3.0,)}, "keep must be from and to"),
                ({"keep": (3.0, 2.0)}, "must end above its beginning, got 3.0"),
                ({"shift_y": math.nan}, "shift_y must be finite"),
                ({"resample": math.inf}, "must be finite"),
                ({"tape_circle": "70"}, "tape_circle must be a number"),
                ({"any_count": "yes"}, "any_count must be True or False"),
                ({"smooth_noise": -1.0}, "smooth_noise must be a number above 0"),
                ({"smooth_noise": 1.0, "smooth_wavelength": 1.0}, "not by both")):
            with self.subTest(**options):
                with self.assertRaisesRegex(self.package.FaststripError, text):
                    read(self.folder / "w.prw", **options)
        with self.assertRaisesRegex(self.package.FaststripError, "path must be the name of a file"):
            read("a\0b")
        with self.assertRaises(TypeError):
            read(self.folder / "w.prw", nominal="s1002")

    def test_long_files_and_names_of_any_letters(self):
        n = 9000
        self.write("r\xe4il.txt", "".join(f"{60 * (i / n - 0.5)} {(i / n - 0.5) ** 2}\n"
                                          for i in range(n)))
        profile = self.package.Profile.read(self.folder / "r\xe4il.txt", kind="rail")
        self.assertEqual((len(profile.y), pathlib.Path(profile.path).name), (n, "r\xe4il.txt"))
        with self.assertRaisesRegex(self.package.FaststripError, "no such file: \xe4"):
            self.package.Profile.read("\xe4")

    def test_c_reads_files(self):
        self.write("w.prw", WHEEL)
        self.write("read.c", READ_C)
        self.shell("gcc -Wall -Werror read.c $(pkg-config --cflags --libs faststrip) -o read")
        lines = self.shell("./read w.prw").splitlines()
        profile = self.package.Profile.read(self.folder / "w.prw")
        self.assertEqual(lines[:2], ["200 0", "110 321"])
        self.assertEqual(lines[2].split(), ["0", "321", "-40", f"{profile.z[-1]:.17g}", "[]", "1",
                                            "simpack", "0", "0"])
        self.assertEqual(lines[3], "100 the section must be from 1 on, got -1")
        self.assertRegex(lines[4], r"^0 shifted by 0\.\d*, 2\.0+ mm|^12\d ")
        self.assertEqual(lines[5:], ["120 no such file: none.txt", "100 100 100 100"])

    def test_reading_leaves_floating_point_as_it_was(self):
        self.write("w.prw", WHEEL)
        libc = ctypes.CDLL("libm.so.6")
        upward = 0x800
        self.assertEqual(libc.fesetround(upward), 0)
        try:
            profile = self.package.Profile.read(self.folder / "w.prw", smooth_wavelength=3.0)
            self.assertEqual(libc.fegetround(), upward)
        finally:
            libc.fesetround(0)
        again = self.package.Profile.read(self.folder / "w.prw", smooth_wavelength=3.0)
        self.assertEqual(struct.pack(f"{len(again.z)}d", *profile.z),
                         struct.pack(f"{len(again.z)}d", *again.z))


class Python(HostTest):
    def setUp(self):
        os.environ["FASTSTRIP_PREFIX"] = str(self.installed.prefix)
        self.addCleanup(os.environ.pop, "FASTSTRIP_PREFIX", None)
        self.write("r.txt", "".join(
            f"{36 * math.sin(a / 100)} {36 - 36 * math.cos(a / 100)}\n" for a in range(-150, 151)))
        self.write("w.prw", WHEEL)

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
        result = contact.solve(load=1e5, creepage=(0, 0, 0), mu=0.3)
        self.assertGreater(result.pmax, 1000.0)
        for whole in (gap, gap[:4]):
            contact.set_gap(gap.y, 2.0 * gap.h, 1e-3)
            contact.set_gap(whole)
            self.assertEqual(contact.solve(load=1e5, creepage=(0, 0, 0), mu=0.3), result)
        turned = dataclasses.replace(gap, inclination=0.1 * gap.y)
        for whole in (turned, turned[:4]):
            contact.set_gap(whole)
            self.assertEqual(contact.solve(load=1e5).word, "conformal")
        contact.set_gap(gap[:3])
        self.assertEqual(contact.solve(load=1e5).word, "ok")
        for call, text in (
                (lambda: faststrip.Profile.read("none.txt"), "no such file: none.txt"),
                (lambda: faststrip.profile_gap(rail, wheel), "wheel must be a Profile of a wheel"),
                (lambda: faststrip.profile_gap(wheel, rail, inclination=0, radius=-1.0),
                 "bad_argument"),
                (lambda: contact.set_gap(gap, gap.h), "a Gap must be given alone"),
                (lambda: contact.set_gap(gap[:2]), "a gap must be a tuple"),
                (lambda: contact.set_gap(gap.y), "h must be an array"),
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

    def test_names_are_found_without_regard_to_case(self):
        faststrip = self.import_package()
        for wheel, rail in (("S1002", "Uic60"), ("Cone20", "60E1"), ("CONE40", "54e1")):
            one = faststrip.profile_gap(wheel, rail)
            other = faststrip.profile_gap(wheel.lower(), rail.lower())
            self.assertEqual([list(row) for row in one[:4]], [list(row) for row in other[:4]])
            self.assertEqual(one.angle, other.angle)
        self.assertEqual(len(faststrip.Wheelset("S1002", "UIC60").solve(axle_load=1e5).contacts), 2)
        case = "&contact load_N = 9e4 /\n&wheel profile = '%s' /\n&rail profile = '%s' /\n" \
            "&material mu = 0.3 /\n&motion creepage = 'given' /\n"
        for name, names in (("small", ("s1002", "60e1")), ("large", ("S1002", "60E1"))):
            self.write(f"{name}.nml", case % names)
            self.shell(f"'{self.installed.prefix}/bin/faststrip' contact {name}.nml -o r.csv "
                       f"--gap {name}.csv")
        large, small = ((self.folder / f"{name}.csv").read_text("utf-8").replace(name, "")
                        for name in ("large", "small"))
        self.assertEqual(large, small)

    def test_a_path_in_the_place_of_a_name_is_told(self):
        faststrip = self.import_package()
        self.write("mine", "0 0\n")
        for path in ("w.prw", "none.txt", "folder/none", self.folder / "w.prw",
                     str(self.folder / "mine")):
            for call in (lambda: faststrip.Wheelset(path), lambda: faststrip.Wheelset(rail=path),
                         lambda: faststrip.profile_gap("s1002", path),
                         lambda: faststrip.draw_profile(path, "wheel"),
                         lambda: faststrip.plot_profiles(path, "60e1"),
                         lambda: faststrip.contact_functions(path, "60e1", [0.0])):
                with self.assertRaisesRegex(faststrip.FaststripError, r"Profile\.read\(path\)"):
                    call()
        with self.assertRaisesRegex(faststrip.FaststripError, "must be s1002, cone20 or cone40"):
            faststrip.Wheelset("mine_which_is_not_there")

    def test_arrays_are_told_shortly(self):
        faststrip = self.import_package()
        gap = faststrip.profile_gap("s1002", "60e1")
        contact = faststrip.Contact(with_elements=True)
        contact.set_gap(gap)
        contact.solve(load=1e5)
        y, z = faststrip.draw_profile("60e1", "rail")
        wheelset = faststrip.Wheelset()
        results = (gap, contact.strips(), contact.elements(), faststrip.Profile(y, z),
                   faststrip.solve_many(gap, load=np.linspace(1e4, 1e5, 50)),
                   faststrip.contact_functions("s1002", "60e1", np.linspace(-3.0, 3.0, 31)))
        for result in results:
            text = repr(result)
            self.assertEqual(text.count("\n"), 0)
            self.assertRegex(text, r"=<\d+ from \S+ to \S+>")
        self.assertIn("force=[[", repr(wheelset.solve(axle_load=1e5)))
        self.assertNotIn("\n", repr(wheelset.solve(axle_load=1e5)))
        self.assertEqual(repr(faststrip.Profile([0.0, 1.0], [0.0, float("nan")]))[:35],
                         "Profile(y=[0, 1], z=[0, nan], kind=")

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
                self.assertAlmostEqual(one / other, 1.0, delta=2e-5)
            self.assertAlmostEqual(result.y_min, expected.y_min, delta=1e-4)
            self.assertAlmostEqual(result.y_max, expected.y_max, delta=1e-4)
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
