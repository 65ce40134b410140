"""One rule for the rail's inclination, and for the flange backs of a gauge, in every interface."""

import ctypes
import pathlib
import subprocess
import sys

from installed import ROOT, HostTest

# 60E1 by name, and the same curve by points, on S1002 at 2 mm: contact angles, rad.
BY_NAME = -0.0779
UPRIGHT = -0.0955

FORTRAN = """\
program try
    use faststrip
    implicit none
    integer, parameter :: n = {n}
    real(wp), parameter :: said(3) = [0.0_wp, 0.025_wp, unset_inclination]
    real(wp) :: yw({m}), zw({m}), y(n), z(n)
    type(side_t) :: side
    type(contact_functions_t) :: functions
    type(touchable_t) :: part
    type(status_t) :: status
    integer :: i, unit

    open (newunit=unit, file='wheel.txt')
    read (unit, *) (yw(i), zw(i), i=1, size(yw))
    close (unit)
    open (newunit=unit, file='rail.txt')
    read (unit, *) (y(i), z(i), i=1, n)
    close (unit)
    call make_curve_profile(yw, zw, body_wheel, 0.0_wp, standard_kink_angle, side%wheel, part, &
                            status)
    do i = 1, 4
        if (i < 4) call make_curve_profile(y, z, body_rail, said(i), standard_kink_angle, &
                                           side%rail, part, status)
        if (i == 4) call make_rail_profile('60e1', unset_inclination, side%rail, status)
        if (.not. is_error(status)) call find_contact_functions(side, side, wheelset_t(), &
            track_t(), 2.0_wp, .false., functions, status)
        print '(i0, 1x, es24.16)', status%code, merge(functions%right%gamma, 0.0_wp, &
                                                      .not. is_error(status))
    end do
end program try
"""

C = """\
#include <faststrip.h>
#include <stdio.h>
#include <string.h>

int main(void)
{{
    const double said[3] = {{0.0, 0.025, FASTSTRIP_INCLINATION_UNSET}}, shift = 2.0;
    static double yw[{m}], zw[{m}], y[{n}], z[{n}], rows[4][4000];
    double functions[10], contact[6];
    double setup[9] = {{1360.0, 70.0, 460.0, 1435.0, 14.0, 0.0, 2.0, 0.05, 0.6}};
    faststrip_wheelset_setup dimensions;
    faststrip_profile wheels[2], rails[2];
    FILE *file = fopen("wheel.txt", "r");
    int i, state, status, count;

    memset(wheels, 0, sizeof wheels);
    memset(rails, 0, sizeof rails);
    for (i = 0; i < {m}; i++)
        if (fscanf(file, "%lf %lf", yw + i, zw + i) != 2)
            return 1;
    fclose(file);
    file = fopen("rail.txt", "r");
    for (i = 0; i < {n}; i++)
        if (fscanf(file, "%lf %lf", y + i, z + i) != 2)
            return 1;
    fclose(file);
    wheels[0].y = yw;
    wheels[0].z = zw;
    wheels[0].n = {m};
    rails[0].y = y;
    rails[0].z = z;
    rails[0].n = {n};
    faststrip_default_wheelset(&dimensions, sizeof dimensions);
    for (i = 0; i < 4; i++) {{
        if (i < 3)
            dimensions.inclination = said[i];
        else
            rails[0].name = "60e1";
        status = faststrip_contact_functions(&dimensions, wheels, rails, 0, 1, &shift, functions,
                                             &state, NULL, 0);
        printf("%d %.17g\\n", status, functions[3]);
        setup[5] = dimensions.inclination;
        status = faststrip_pair_gap(wheels, rails, setup, 4000, &count, rows[0], rows[1], rows[2],
                                    rows[3], contact, NULL, 0);
        printf("%d %.17g\\n", status, contact[0]);
    }}
    return 0;
}}
"""

F77 = """\
      PROGRAM TRY
      INTEGER M, N, I, NGAP, INFO, NPROF(4), ISTAT(1)
      PARAMETER (M = {m}, N = {n})
      DOUBLE PRECISION YP(M + N), ZP(M + N), SETUP(9), GSET(9), CONT(6)
      DOUBLE PRECISION Y(4000), H(4000), AX(4000), TURN(4000), SAID(4)
      DOUBLE PRECISION SHIFT(1), FUNC(10, 1)
      DATA GSET /1360D0,70D0,460D0,1435D0,14D0,0D0,2D0,.05D0,.6D0/
      DATA SAID /0D0, .025D0, 999D0, 999D0/, SHIFT /2D0/
      DATA NPROF /M, 0, N, 0/
      OPEN (11, FILE='wheel.txt')
      READ (11, *) (YP(I), ZP(I), I = 1, M)
      CLOSE (11)
      OPEN (11, FILE='rail.txt')
      READ (11, *) (YP(M + I), ZP(M + I), I = 1, N)
      CALL FSWDFT(SETUP)
      DO 10 I = 1, 4
      SETUP(8) = SAID(I)
      GSET(6) = SAID(I)
      IF (I .EQ. 4) NPROF(3) = -2
      CALL FSCFUN(SETUP, NPROF, YP, ZP, 0, 1, SHIFT, FUNC, ISTAT, INFO)
      PRINT '(I0, 1X, ES24.16)', INFO, FUNC(4, 1)
      IF (I .EQ. 4) GO TO 10
      CALL FSPROF(M, YP, ZP, N, YP(M + 1), ZP(M + 1), GSET, 4000, NGAP,
     &            Y, H, AX, TURN, CONT, INFO)
      PRINT '(I0, 1X, ES24.16)', INFO, CONT(1)
   10 CONTINUE
      END
"""


class Inclination(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.package = cls.import_package()
        cls.points = [cls.package.draw_profile(name, kind, inclination=0.0, n=n)
                      for name, kind, n in (("s1002", "wheel", 1301), ("60e1", "rail", 741))]
        for name, (y, z) in zip(("wheel", "rail"), cls.points):
            cls.write(f"{name}.txt", "".join(f"{a!r} {b!r}\n"
                                             for a, b in zip(y.tolist(), z.tolist())))
        cls.sizes = {"m": len(cls.points[0][0]), "n": len(cls.points[1][0])}

    def by_program(self, rail):
        """Status and angle of the program; what it says where it refuses."""
        self.write("case.nml", "&wheel profile = 'wheel.txt', y_positive_to = 'field', "
                   "z_positive_to = 'down' /\n&rail " + rail + " /\n")
        program = self.installed.prefix / "bin" / "faststrip"
        done = subprocess.run([program, "conicity", "case.nml", "--y-max", "4", "--y-step", "2",
                               "--amplitudes", "1", "--functions", "functions.csv",
                               "-o", "out.csv"],
                              cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True,
                              encoding="utf-8", check=False)
        if done.returncode:
            return done.returncode, done.stderr
        lines = [line.split(",") for line in pathlib.Path(self.folder, "functions.csv").read_text(
            encoding="utf-8").splitlines() if line[0] != "#"]
        row = dict(zip(lines[0], next(line for line in lines[1:] if float(line[0]) == 2.0)))
        return 0, float(row["gamma_right_rad"])

    def test_every_interface_has_the_same_angle_and_the_same_rule(self):
        package = self.package
        wheel, rail = (package.Profile(*points, kind=kind)
                       for points, kind in zip(self.points, ("wheel", "rail")))
        found = {name: [] for name in ("as it lies", "1:40", "not said", "by name")}
        names = list(found)

        senses = "profile = 'rail.txt', y_positive_to = 'field', z_positive_to = 'down'"
        for name, words in (("as it lies", senses + ", inclination = 0"),
                            ("1:40", senses + ", inclination = 0.025"),
                            ("1:40", senses + ", cant = 0.025"), ("not said", senses),
                            ("by name", "profile = '60e1'")):
            found[name].append(self.by_program(words))
        self.assertIn("&rail inclination must be given", found["not said"][0][1])
        found["not said"] = [(100, 0.0)]

        self.write("try.f90", FORTRAN.format(**self.sizes))
        self.write("try.c", C.format(**self.sizes))
        self.write("try.f", F77.format(**self.sizes))
        self.shell("gfortran try.f90 $(pkg-config --cflags --libs faststrip) -o by_fortran\n"
                   "gcc -Wall -Wextra -Werror try.c $(pkg-config --cflags --libs faststrip)"
                   " -o by_c\n"
                   "gfortran -std=legacy try.f $(pkg-config --libs faststrip) -o by_f77")
        for program, each in (("by_fortran", 1), ("by_c", 2), ("by_f77", 2)):
            for i, line in enumerate(self.shell(f"./{program}").splitlines()):
                status, angle = line.split()
                found[names[i // each]].append((int(status), float(angle)))

        for name, one, said in (("as it lies", rail, {"inclination": 0.0}),
                                ("1:40", rail, {"inclination": 0.025}),
                                ("1:40", rail, {"cant": 0.025}), ("not said", rail, {}),
                                ("by name", "60e1", {})):
            for call in (lambda: package.profile_gap(wheel, one, shift=2.0, **said).angle,
                         lambda: float(package.contact_functions(wheel, one, [2.0],
                                                                 **said).angle_right[0]),
                         lambda: package.Wheelset(wheel, one, **said) and None):
                try:
                    answer = call()
                except package.FaststripError as problem:
                    self.assertIn("inclination must be given", str(problem))
                    found[name].append((problem.status, 0.0))
                else:
                    if answer is not None:
                        found[name].append((0, answer))

        self.assertEqual(set(found["not said"]), {(100, 0.0)})
        self.assertEqual(len(found["not said"]), 9)
        for name, wanted in (("as it lies", UPRIGHT), ("1:40", BY_NAME), ("by name", BY_NAME)):
            self.assertGreaterEqual(len(found[name]), 7)
            for status, angle in found[name]:
                self.assertEqual(status, 0)
                self.assertAlmostEqual(angle, wanted, delta=1e-4, msg=name)
                self.assertAlmostEqual(angle, found[name][0][1], delta=1e-12, msg=name)
        self.assertAlmostEqual(found["1:40"][0][1], found["by name"][0][1], delta=1e-5)

    def test_the_older_name_is_not_given_beside_the_new_one(self):
        self.assertIn("&rail cant must not be given with inclination", self.by_program(
            "profile = '60e1', cant = 0.025, inclination = 0.025")[1])
        for call in (lambda **said: self.package.profile_gap("s1002", "60e1", **said),
                     lambda **said: self.package.draw_profile("60e1", "rail", **said),
                     lambda **said: self.package.contact_functions("s1002", "60e1", [0.0], **said),
                     lambda **said: self.package.Wheelset(**said)):
            with self.assertRaisesRegex(self.package.FaststripError, "cant must be None"):
                call(cant=0.025, inclination=0.025)
            with self.assertRaisesRegex(self.package.FaststripError, "inclination must be a tang"):
                call(inclination=999.0)

    def test_flange_backs_follow_the_gauge_or_must_be_said(self):
        functions = self.package.contact_functions
        for gauge, back in ((1435.0, 1360.0), (1440.0, 1360.0), (1520.0, 1440.0)):
            wide, said = (functions("s1002", "60e1", [3.0], gauge=gauge, **more)
                          for more in ({}, {"back_spacing": back}))
            self.assertEqual(wide.delta_r[0], said.delta_r[0])
            gaps = [self.package.profile_gap("s1002", "60e1", shift=3.0, gauge=gauge, **more)
                    for more in ({}, {"back_spacing": back})]
            self.assertEqual(gaps[0].angle, gaps[1].angle)
            self.assertEqual(gaps[0].angle, wide.angle_right[0])
        makers = (lambda **more: functions("s1002", "60e1", [0.0], **more),
                  lambda **more: self.package.profile_gap("s1002", "60e1", **more),
                  lambda **more: self.package.Wheelset("s1002", "60e1", **more))
        for make in makers:
            for more, says in (({"gauge": 1668.0}, "flange backs must be given.*1668"),
                               ({"back_spacing": 1440.0}, "1435.*1440.*play of -70"),
                               ({"gauge": 1520.0, "back_spacing": 1360.0},
                                "1520.*1360.*1440.* belong"),
                               ({"gauge": 1000.0, "back_spacing": 1360.0}, "1000.*1360"),
                               ({"back_spacing": 0.0}, "back_spacing must be a number above 0")):
                with self.assertRaisesRegex(self.package.FaststripError, says):
                    make(**more)

    def test_a_setup_of_c_with_another_gauge_is_refused_or_follows(self):
        wheelset = sys.modules["faststrip._wheelset"]
        library = wheelset.library
        setup = wheelset.Setup()
        library.faststrip_default_wheelset(ctypes.byref(setup), ctypes.sizeof(setup))
        self.assertEqual((setup.back_spacing, setup.gauge, setup.inclination),
                         (1360.0, 1435.0, 999.0))
        wheels, rails = ((wheelset.Points * 2)(wheelset.Points(name), wheelset.Points())
                         for name in (b"s1002", b"60e1"))
        shift, state, text = (ctypes.c_double * 1)(3.0), (ctypes.c_int * 1)(), \
            ctypes.create_string_buffer(300)
        numbers = (ctypes.c_double * 10)()
        setup.gauge = 1520.0
        for back, status in ((1360.0, 100), (0.0, 0)):
            setup.back_spacing = back
            self.assertEqual(library.faststrip_contact_functions(
                ctypes.byref(setup), wheels, rails, 0, 1, shift, numbers, state, text, 300), status)
        self.assertEqual(numbers[0], self.package.contact_functions(
            "s1002", "60e1", [3.0], gauge=1520.0).delta_r[0])

    def test_the_header_says_what_stands_for_nothing(self):
        header = (ROOT / "include" / "faststrip.h").read_text(encoding="utf-8")
        source = (ROOT / "src/faststrip/geometry/profile.f90").read_text(encoding="utf-8")
        unset = sys.modules["faststrip._profile"].UNSET_INCLINATION
        self.assertIn(f"FASTSTRIP_INCLINATION_UNSET {unset}", header)
        self.assertIn(f"unset_inclination = {unset}_wp", source)
