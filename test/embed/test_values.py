"""Every figure of Python against the program's, by every method: dissimilar bodies, an unsymmetric
gap, all three creepages, friction and numbers of points that are no defaults. The other interfaces
have the bits of Python (test_figures)."""

import csv
import importlib
import re
import subprocess

import methods
from installed import HostTest

POINTS = 401
GAP = [(y, 2e-3 * (y - 1.0) ** 2 + 4e-5 * (y - 1.0) ** 3 + 0.25, (1.0 + 0.01 * y) / 920.0)
       for y in (-15.0 + 0.075 * i for i in range(POINTS))]
# Dissimilar bodies whose pressures cause next to no slip.
E_WHEEL, E_RAIL, NU_WHEEL, NU_RAIL = 2.1e5, 1.686115e5, 0.28, 0.33
MU, LOAD, CREEPAGE = 0.27, 9.0e4, (1.1e-3, -7.0e-4, 2.3e-4)
CASE = f"""\
&contact
  name = 'values'
  gap_file = 'gap.csv'
  load_N = {LOAD}
/
&material
  mu = {MU}
  E_wheel_MPa = {E_WHEEL}
  E_rail_MPa = {E_RAIL}
  nu_wheel = {NU_WHEEL}
  nu_rail = {NU_RAIL}
/
&motion
  cksi = {CREEPAGE[0]}
  ceta = {CREEPAGE[1]}
  cphi_rad_per_mm = {CREEPAGE[2]}
/
"""
COLUMNS = ("N_N", "penetration_mm", "area_mm2", "pmax_MPa", "ymin_mm", "ymax_mm", "xmax_mm", "Fx_N",
           "Fy_N", "Mz_Nmm", "friction_power_N", "stick_fraction")
NAMES = ("load", "penetration", "area", "pmax", "y_min", "y_max", "x_max", "fx", "fy", "mz",
         "friction_power", "stick_fraction")
TANGENTIAL = methods.listed("tangential")
WAYS = (*(("strip", name, 11, 13, (12, 21)) for name in TANGENTIAL),
        *((name, "faststrip", 9, 15, (50, 50)) for name in methods.listed("normal")
          if name not in ("strip", "auto")),
        ("hertz", "fastsim-weighted", 15, 15, (31, 8)))


class Values(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.faststrip, cls.numpy = cls.import_package(), importlib.import_module("numpy")
        cls.write("gap.csv", "y_mm,h_mm,inv2R_per_mm\n"
                  + "".join(f"{y!r},{h!r},{a!r}\n" for y, h, a in GAP))
        cls.write("case.nml", CASE)

    def table(self, name):
        text = (self.folder / name).read_text(encoding="utf-8")
        return list(csv.DictReader(line for line in text.splitlines() if line[0] != "#"))

    def program(self, way):
        """Figures, strips and elements by the command line, which calls Fortran alone."""
        normal, tangential, strips, points, (nx, ny) = way
        words = [str(self.installed.prefix / "bin" / "faststrip"), "contact", "case.nml",
                 "--normal", normal, "--tangential", tangential,
                 "--strips-per-patch", str(strips), "--points-per-strip", str(points),
                 "--fastsim-nx", str(nx), "--fastsim-ny", str(ny),
                 "-o", "row.csv", "--strips", "strips.csv"]
        if TANGENTIAL[tangential].gives_elements:
            words += ["--fields", "fields.csv"]
        subprocess.run(words, cwd=self.folder, check=True, stdin=subprocess.DEVNULL)
        return self.table("row.csv")[0], self.table("strips.csv")

    def close(self, found, wanted, what):
        self.assertLessEqual(abs(float(found) - float(wanted)), 1e-9 * abs(float(wanted)) + 1e-12,
                             (what, found, wanted))

    def test_a_contact(self):
        y, h, a = (self.numpy.array(column) for column in zip(*GAP))
        material = self.faststrip.Material(E_WHEEL, E_RAIL, NU_WHEEL, NU_RAIL)
        for way in WAYS:
            with self.subTest(way):
                row, strips = self.program(way)
                normal, tangential, n, points, grid = way
                elements = TANGENTIAL[tangential].gives_elements
                contact = self.faststrip.Contact(
                    normal=normal, tangential=tangential, strips_per_patch=n,
                    points_per_strip=points, fastsim_grid=grid, with_elements=elements)
                contact.set_gap(y, h, a)
                result = contact.solve(load=LOAD, creepage=CREEPAGE, mu=MU, material=material)
                for name, column in zip(NAMES, COLUMNS):
                    if row[column]:
                        self.close(getattr(result, name), row[column], name)
                self.assertEqual(result.n_patches, int(row["n_patches"]))
                self.assertEqual(result.n_strips, len(strips))
                ours = contact.strips()
                for name, column in (("y_left", "y_left_mm"), ("y_right", "y_right_mm"),
                                     ("half_length", "half_length_mm"), ("p0", "p0_MPa"),
                                     ("patch", "patch")):
                    for found, line in zip(getattr(ours, name), strips, strict=True):
                        self.close(found, line[column], name)
                if elements:
                    self.check_elements(contact.elements(), self.table("fields.csv"))

    def test_auto_takes_the_steps_of_the_program(self):
        y, h, a = (self.numpy.array(column) for column in zip(*GAP))
        contact = self.faststrip.Contact(normal="auto")
        contact.set_gap(y, h, a)
        counts = set()
        for target, tolerance in (("forces", 0.02), ("pmax", 3e-3), ("area", 5e-3),
                                  ("power", 0.05)):
            with self.subTest(target):
                subprocess.run([str(self.installed.prefix / "bin" / "faststrip"), "contact",
                                "case.nml", "--normal", "auto", "--target", target, "--tolerance",
                                str(tolerance), "-o", "row.csv"],
                               cwd=self.folder, check=True, stdin=subprocess.DEVNULL)
                row, = self.table("row.csv")
                result = contact.solve(
                    load=LOAD, creepage=CREEPAGE, mu=MU, target=target, tolerance=tolerance,
                    material=self.faststrip.Material(E_WHEEL, E_RAIL, NU_WHEEL, NU_RAIL))
                for name, column in zip(NAMES, COLUMNS):
                    self.close(getattr(result, name), row[column], name)
                self.assertTrue(result.target_is_met)
                told = [re.match(r"(\w+) (\d+)(?: \+ ([\w-]+) (\d+))?: (\S+) in", words)
                        for words in row["choice"].split("; ")]
                self.assertEqual(len(told), len(result.steps))
                counts.add(len(told))
                for words, step in zip(told, result.steps):
                    normal, strips, tangential, points, estimate = words.groups()
                    self.assertEqual((normal, int(strips), tangential or "none"),
                                     (step.normal, step.strips, step.tangential))
                    if points:
                        self.assertEqual(int(points), step.points_per_strip)
                    self.assertAlmostEqual(float(estimate) / step.estimate, 1.0, delta=0.06)
        self.assertEqual(counts, {2, 3})

    def check_elements(self, ours, lines):
        self.assertEqual(len(ours.x), len(lines))
        for name, column in (("x", "x_mm"), ("y", "y_mm"), ("area", "area_mm2"), ("pn", "pn_MPa"),
                             ("px", "px_MPa"), ("py", "py_MPa"), ("sx", "sx"), ("sy", "sy"),
                             ("state", "state")):
            for found, line in zip(getattr(ours, name), lines, strict=True):
                self.close(found, line[column], name)

    def test_a_copy_keeps_the_capacity_of_its_source(self):
        y, h, a = (self.numpy.array(column) for column in zip(*GAP))
        large, small = self.faststrip.Contact(max_points=500), self.faststrip.Contact(max_points=20)
        small.set_gap(y[180:200], h[180:200], a[180:200])
        large.copy_from(small)
        large.set_gap(y, h, a)
        other = self.faststrip.Contact()
        other.set_gap(y, h, a)
        self.assertEqual(large.solve(load=LOAD), other.solve(load=LOAD))
