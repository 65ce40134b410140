"""Contact geometry functions and equivalent conicity are the same in every interface, and those of
the program; what cannot be is refused."""

import csv
import math
import subprocess

from installed import HOSTS, HostTest, bits

CASE = """\
&contact
  name = 'conicity'
  load_N = 1e5
/
&wheel
  profile = 's1002'
  profile_left = 'cone20'
  radius_mm = 460
  radius_left_mm = 460.25
/
&rail
  profile = '60e1'
  profile_left = '54e1'
/
"""
COLUMNS = ("y_mm", "delta_r_mm", "radius_right_mm", "radius_left_mm", "gamma_right_rad",
           "gamma_left_rad", "roll_rad", "y_wheel_right_mm", "y_rail_right_mm",
           "y_wheel_left_mm", "y_rail_left_mm")
SHIFTS = [0.5 * (i - 80) for i in range(161)]
AMPLITUDES = [0.5 * i * i for i in range(1, 13)]


class Interfaces(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.package = cls.import_package()
        cls.shell(f"gcc -O1 -Wall -Wextra -Werror '{HOSTS}/conicity.c'"
                  " $(pkg-config --cflags --libs faststrip) -o by_c")
        cls.lines = cls.shell("./by_c").splitlines()
        cls.write("case.nml", CASE)

    def functions(self, roll, shifts):
        return self.package.contact_functions(
            "s1002", "60e1", shifts, wheel_left="cone20", rail_left="54e1", radius_left=460.25,
            roll=roll)

    def test_fixed_form_fortran_has_the_bits_of_c(self):
        self.shell("gfortran -std=legacy -Wall -O1 -ffpe-trap=invalid,zero,overflow"
                   f" '{HOSTS}/conicity.f' $(pkg-config --libs faststrip) -o by_f77")
        self.assertEqual(self.shell("./by_f77").splitlines(), self.lines)
        told = [line for line in self.lines if line[0] in "sa"]
        self.assertGreater(told.count("shift 0"), 250)
        self.assertGreater(told.count("shift 106"), 40)
        self.assertGreater(told.count("amplitude 0 1"), 8)
        self.assertGreater(told.count("amplitude 0 0"), 1)
        self.assertGreater(told.count("amplitude 109 0"), 0)

    def test_python_has_them(self):
        lines = [line for line in self.lines if line[:5] != "shift"]
        zeros = bits(*[0.0] * 10)
        for roll in (False, True):
            functions = self.functions(roll, SHIFTS)
            for row in zip(*functions[1:]):
                while lines[0] == zeros:
                    del lines[0]
                self.assertEqual(bits(*row), lines.pop(0))
            while lines[0] == zeros:
                del lines[0]
            found = self.package.conicity(functions.y, functions.delta_r, AMPLITUDES)
            self.assertEqual(bits(found.y_equilibrium, found.largest_amplitude), lines.pop(0))
            for word, *row in zip(found.words, *found[1:7]):
                _, status, known = lines.pop(0).split()
                self.assertEqual((word == "ok", not math.isnan(row[4])),
                                 (status == "0", known == "1"))
                self.assertEqual(bits(*(0.0 if math.isnan(one) else one for one in row)),
                                 lines.pop(0))
        self.assertEqual(lines, [])

    def test_the_program_prints_them(self):
        for roll in (False, True):
            subprocess.run([str(self.installed.prefix / "bin" / "faststrip"), "conicity",
                            "case.nml", *["--roll"] * roll, "--y-max", "12", "--y-step", "0.5",
                            "--functions", "functions.csv", "--amplitudes", "1.5,3,4.5",
                            "-o", "conicity.csv"],
                           cwd=self.folder, check=True, stdin=subprocess.DEVNULL)
            rows = self.table("functions.csv")
            functions = self.functions(roll, [0.5 * i for i in range(-24, 25)])
            self.assertEqual(len(rows), len(functions.y))
            for column, values in zip(COLUMNS, functions):
                for row, value in zip(rows, values):
                    self.assertAlmostEqual(float(row[column]), value, delta=1e-9, msg=column)
            found = self.package.conicity(functions.y, functions.delta_r, [1.5, 3.0, 4.5])
            for column, values in (("tan_gamma_e", found.tan_gamma_e), ("y_min_mm", found.y_min),
                                   ("y_max_mm", found.y_max), ("regression", found.regression),
                                   ("nonlinearity_per_mm", found.nonlinearity)):
                for row, value in zip(self.table("conicity.csv"), values, strict=True):
                    self.assertAlmostEqual(float(row[column]), value, delta=1e-9, msg=column)

    def table(self, name):
        with open(self.folder / name, encoding="utf-8") as file:
            return list(csv.DictReader(line for line in file if line[0] != "#"))

    def test_points_are_those_of_the_name(self):
        """Straight lines by points are the cone of 1:20 by name, and conicity is 0.05."""
        cone = self.package.Profile(range(-30, 51, 10), [-0.05 * y for y in range(-30, 51, 10)],
                                    kind="wheel")
        for wheel in ("cone20", cone):
            functions = self.package.contact_functions(wheel, "60e1", [-3.0, 0.0, 3.0])
            found = self.package.conicity(functions.y, functions.delta_r, [2.5])
            self.assertAlmostEqual(found.tan_gamma_e[0], 0.05, delta=1e-6)
            self.assertAlmostEqual(found.regression[0], 0.05, delta=1e-6)
            self.assertTrue(math.isnan(found.nonlinearity[0]))

    def test_what_cannot_be_is_refused_by_name(self):
        functions, conicity = self.package.contact_functions, self.package.conicity
        self.all_refused(
                ("no_contact", lambda: functions("s1002", "60e1", [500.0])),
                ("shifts must be finite", lambda: functions("s1002", "60e1", [math.nan])),
                ("must be s1002, cone20", lambda: functions("round", "60e1", [0.0])),
                ("y must be a row of numbers", lambda: functions("s1002", "60e1", 3.0)),
                ("radius must be finite", lambda: functions("s1002", "60e1", [0.0],
                                                            radius=math.inf)),
                ("delta r must rise through 0", lambda: conicity([0, 1], [1, 2], [1.0])),
                ("must have at least 2 points", lambda: conicity([0.0], [0.0], [1.0])),
                ("y must rise", lambda: conicity([1, 0], [-1, 1], [1.0])),
                ("y and delta r must be finite", lambda: conicity([0, 1], [-1, math.nan], [1.0])),
                ("delta_r must be as long as y", lambda: conicity([0, 1], [1, 2, 3], [1.0])))
        found = conicity([-2.0, 2.0], [-1.0, 1.0], [-1.0, 1.0, 3.0, math.nan])
        self.assertEqual(found.words, ("bad_argument", "ok", "out_of_range", "bad_argument"))
        self.assertEqual([math.isnan(one) for one in found.tan_gamma_e],
                         [True, False, True, True])
        self.assertEqual(found.largest_amplitude, 2.0)
