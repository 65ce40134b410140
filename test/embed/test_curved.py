"""Contacts on a curved surface: CONTACT's cases, in every interface; what cannot be is refused."""

import csv
import math
import subprocess

import numpy as np

from installed import ROOT, HostTest

REFERENCE = ROOT / "reference" / "contact" / "conformal.csv"
Y = [0.1 * (i - 120) for i in range(241)]
GAP = [2e-3 * y * y + 1e-4 * y**3 for y in Y]
TURN = [math.asin(y / 25.0) for y in Y]
CREEPAGE, LOAD, MU = (1e-3, 2e-3, 2e-4), 6e4, 0.3

C_CALLER = """\
#include <stdio.h>
#include "faststrip.h"
int main(void)
{
    double gap[4][241];
    faststrip_case c;
    faststrip_result result;
    faststrip_workspace *workspace;
    FILE *file = fopen("gap.txt", "r");
    for (int i = 0; i < 964; i++)
        if (fscanf(file, "%%lf", &gap[i / 241][i %% 241]) != 1) return 2;
    faststrip_default_case(&c, sizeof c);
    printf("%%d\\n", c.curved);
    c.curved = 1;
    c.load = %r; c.mu = %r; c.cksi = %r; c.ceta = %r; c.cphi = %r;
    if (faststrip_new(&c, 241, &workspace) != 0) return 3;
    faststrip_set_gap(workspace, 241, gap[0], gap[1], gap[2], gap[3]);
    faststrip_solve(workspace, &c, &result);
    printf("%%.17g %%.17g %%.17g %%.17g\\n", result.load, result.fx, result.fy, result.mz);
    faststrip_set_gap(workspace, 241, gap[0], gap[1], gap[2], NULL);
    printf("%%d\\n", faststrip_solve(workspace, &c, &result));
    faststrip_free(&workspace);
    return 0;
}
"""

DECLARED = f"""\
      INTEGER IW(8), IW2(8), IOPT(9), INFO
      DOUBLE PRECISION PAR(9), RES(14), YG(241), HG(241), AG(241), TG(241)
      DATA IW2 /8*0/
      OPEN (9, FILE='gap.txt')
      READ (9, *) YG, HG, AG, TG
      CALL FSDFLT(IOPT, PAR)
      PAR(5) = {MU}D0
      PAR(6) = {LOAD}D0
      PAR(7) = {CREEPAGE[0]}D0
      PAR(8) = {CREEPAGE[1]}D0
      PAR(9) = {CREEPAGE[2]}D0
      CALL FSINIT(IOPT, 241, IW, 8, INFO)
"""


def reference(**wanted):
    """Figures of a case of CONTACT."""
    with open(REFERENCE, encoding="utf-8") as file:
        row, = (row for row in csv.DictReader(line for line in file if line[0] != "#")
                if all(row[name] == value for name, value in wanted.items()))
    return {name: float(value) for name, value in row.items()
            if value and name not in ("case", "gap", "influence")}


class Curved(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.package = cls.import_package()
        cls.write("gap.txt", "\n".join(map(repr, [*Y, *GAP, *[1e-3] * len(Y), *TURN])) + "\n")
        with cls.package.Contact(curved=True) as contact:
            contact.set_gap((Y, GAP, 1e-3, TURN))
            found = contact.solve(load=LOAD, creepage=CREEPAGE, mu=MU)
        cls.forces = [found.load, found.fx, found.fy, found.mz]

    def solve(self, gap, curved, shear=82000.0, **what):
        steel = self.package.Material(*[2.56 * shear] * 2, 0.28, 0.28)
        with self.package.Contact(strips_per_patch=41, points_per_strip=40,
                                  curved=curved) as contact:
            contact.set_gap(gap)
            return contact.solve(material=steel, **what)

    def test_grooves_by_contact(self):
        # Strips in the plane, with the load of the curved surface: pmax by corrected influence.
        for radius in ("10.25", "10.10", "10.05", "10.02"):
            rail = float(radius)
            y = np.linspace(-9.2, 9.2, 737)
            wheel_z, rail_z = (np.sqrt(r * r - y * y) - r for r in (10.0, rail))
            turn = -0.5 * (np.arcsin(y / 10.0) + np.arcsin(y / rail))
            gap = y, rail_z - wheel_z, 0.5 / (420.0 + wheel_z), turn
            found = self.solve(gap, True, shear=8e4, load=1e4)
            wanted = reference(rail_mm=radius, influence="blanco")
            with self.subTest(radius):
                self.assertAlmostEqual(found.load, 1e4, delta=0.02)
                self.assertAlmostEqual(found.pmax / wanted["pmax_MPa"], 1.0, delta=6e-3)
                for name, column in (("pmax", "pmax_MPa"), ("area", "area_mm2"),
                                     ("penetration", "penetration_mm")):
                    estimate = getattr(found, f"est_err_{name}")
                    self.assertLess(abs(getattr(found, name) / wanted[column] - 1.0), estimate)
                    self.assertLess(estimate, 0.25)
                self.assertEqual(found.word, "conformal")

    @staticmethod
    def corner():
        """A rail corner of 10 mm in a wheel of 10.2 mm, and the middle surface's inclination."""
        y = np.linspace(-8.0, 8.0, 641)
        rail, wheel = (r - np.sqrt(r * r - y * y) for r in (10.0, 10.2))
        return y, rail - wheel, 0.5 * (np.arcsin(y / 10.0) + np.arcsin(y / 10.2))

    def test_a_corner_by_contact(self):
        # The gap along the curve, with the half-space of its arc, has CONTACT's figures: what the
        # study of the method's page says.
        y, h, turn = self.corner()
        depth, motion = 0.09089, (0.004, 0.0098995, 0.0015372)
        cosine = np.cos(turn)
        gap = 10.1 * turn, h * cosine + depth * (1.0 - cosine), 0.00076859, turn
        found = self.solve(gap, False, penetration=depth, creepage=motion)
        wanted = reference(case="flange", gap="curve", influence="half-space")
        for value, column, share in ((found.load, "load_N", 2e-3), (found.pmax, "pmax_MPa", 2e-3),
                                     (found.fx, "Fx_N", 6e-3), (found.fy, "Fy_N", 3e-3)):
            self.assertAlmostEqual(value / wanted[column], 1.0, delta=share, msg=column)
        # In the plane: the estimates have what is missing against finite elements.
        found = self.solve((y, h, 0.00076859, turn), True, penetration=depth, creepage=motion)
        wanted = reference(influence="numerical")
        self.assertLess(abs(found.pmax / wanted["pmax_MPa"] - 1.0), found.est_err_pmax)
        self.assertLess(abs(found.area / wanted["area_mm2"] - 1.0), found.est_err_area)

    def test_c(self):
        self.write("curved.c", C_CALLER % (LOAD, MU, *CREEPAGE))
        self.shell("gcc -O1 -Wall -Wextra -Werror curved.c"
                   " $(pkg-config --cflags --libs faststrip) -o curved")
        lines = [list(map(float, line.split())) for line in self.shell("./curved").splitlines()]
        self.assertEqual(lines, [[0.0], self.forces, [100.0]])

    def test_fixed_form_fortran(self):
        same = " + ".join(f"ABS(RES({i}) - ({float(force)!r}D0))"
                          for i, force in zip((1, 8, 9, 10), self.forces))
        self.check_calls(DECLARED, (
            ("nowhere", 100, "CALL FSCURV(IW2, 1, INFO)"),
            ("points", 100, "CALL FSGAPT(IW, -1, YG, HG, AG, TG, INFO)"),
            ("curved", 0, "CALL FSCURV(IW, 1, INFO)"),
            ("flat", 0, "CALL FSGAP(IW, 241, YG, HG, AG, INFO)"),
            ("refused", 100, "CALL FSSOLV(IW, IOPT, PAR, RES, INFO)"),
            ("turn", 0, "CALL FSGAPT(IW, 241, YG, HG, AG, TG, INFO)"),
            ("solved", 6, "CALL FSSOLV(IW, IOPT, PAR, RES, INFO)"),
            ("forces", 0, f"INFO = NINT(1D6*({same}))")))

    def test_python(self):
        self.assertAlmostEqual(self.forces[0], LOAD, delta=1e-6 * LOAD)
        with self.package.Contact() as contact:
            contact.set_gap((Y, GAP, 1e-3, TURN))
            plane = contact.solve(load=LOAD, creepage=CREEPAGE, mu=MU)
        self.assertGreater(abs(self.forces[2] - plane.fy), 0.02 * MU * LOAD)
        many = self.package.solve_many((Y, GAP, 1e-3, TURN), load=LOAD, creepage=CREEPAGE, mu=MU,
                                       curved=True)
        self.assertEqual([float(many.load), float(many.fx), float(many.fy), float(many.mz)],
                         self.forces)

    def test_a_lateral_force_is_that_of_the_frame(self):
        with self.package.Contact(curved=True) as contact:
            contact.set_gap((Y, GAP, 1e-3, TURN))
            found = contact.solve(load=LOAD, creepage=(0.0, 0.0, CREEPAGE[2]), mu=MU,
                                  forces=tuple(self.forces[1:3]))
        self.assertAlmostEqual(found.load, LOAD, delta=1e-6 * LOAD)
        self.assertAlmostEqual(found.fx, self.forces[1], delta=2e-5 * MU * LOAD)
        self.assertAlmostEqual(found.fy, self.forces[2], delta=2e-5 * MU * LOAD)
        for got, wanted in zip((found.cksi, found.ceta), CREEPAGE):
            self.assertAlmostEqual(got / wanted, 1.0, delta=5e-3)

    def test_the_program_and_pairs(self):
        self.write("case.nml", "&contact load_N = 9e4\nshift_mm = 6.3\n/\n&wheel\n"
                   "profile = 's1002'\n/\n&rail profile = '60e1'\n/\n&material mu = 0.3\n/\n"
                   "&motion\n"
                   "creepage = 'formula'\n/\n&numerics curved = .true.\n/\n")
        done = subprocess.run([ROOT / "bin" / "faststrip", "contact", "case.nml"], check=True,
                              cwd=self.folder, stdout=subprocess.PIPE, encoding="utf-8")
        row, = csv.DictReader(line for line in done.stdout.splitlines() if line[0] != "#")
        pair = self.package.contact("s1002", "60e1", y=6.3, load=9e4, curved=True)
        for name, value in (("N_N", pair.load), ("Fx_N", pair.fx), ("Fy_N", pair.fy)):
            self.assertAlmostEqual(float(row[name]), value, delta=3e-6 * abs(value))
        plane = self.package.contact("s1002", "60e1", y=6.3, load=9e4)
        self.assertGreater(abs(pair.fy - plane.fy), 0.04 * 0.3 * 9e4)

    def test_elements_are_conformal_where_strips_are(self):
        for load, wanted in (("1.6e5", "conformal"), ("2e4", "")):
            self.write("turned.nml", f"&contact load_N = {load}\nshift_mm = 6.3\n/\n&wheel\n"
                       "profile = 's1002'\n/\n&rail profile = '60e1'\n/\n&material mu = 0.3\n/\n"
                       "&motion\ncreepage = 'formula'\n/\n")
            for method in ("strip", "norm"):
                done = subprocess.run(
                    [ROOT / "bin" / "faststrip", "contact", "turned.nml", "--normal", method,
                     "--tangential", "none"], check=True, cwd=self.folder, stdout=subprocess.PIPE,
                    stderr=subprocess.DEVNULL, encoding="utf-8")
                row, = csv.DictReader(line for line in done.stdout.splitlines() if line[0] != "#")
                self.assertEqual("conformal" in row["limitations"].split(), wanted != "", method)

    def test_gap_files_tell_their_inclination(self):
        # A gap file with the column serves contacts and rows of a batch; the program writes it.
        rows = [",".join(map(repr, row)) for row in zip(Y, GAP, [1e-3] * len(Y), TURN)]
        head = "y_mm,h_mm,inv2R_per_mm"
        self.write("turned.csv", "\n".join([head + ",inclination_rad", *rows]) + "\n")
        self.write("flat.csv", "\n".join([head, *(row.rsplit(",", 1)[0] for row in rows)]) + "\n")
        motion = "".join(f",{value!r}" for value in CREEPAGE)
        self.write("batch.csv", "case,gap_file,E_MPa,nu,mu,N_N,cksi,ceta,cphi_rad_per_mm,curved\n"
                   + "".join(f"{word or 'empty'},{gap}.csv,209920,0.28,{MU},{LOAD}{motion},{word}\n"
                             for gap, word in (("turned", ".true."), ("turned", ""),
                                               ("turned", ".false."), ("flat", ".true."),
                                               ("turned", "so"))))

        def run(*arguments, code=0):
            done = subprocess.run([ROOT / "bin" / "faststrip", *arguments], cwd=self.folder,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8",
                                  check=False)
            self.assertEqual(done.returncode, code, done.stderr)
            return done

        def forces(row):
            return [float(row[name]) for name in ("N_N", "Fx_N", "Fy_N", "Mz_Nmm")]

        with self.package.Contact() as contact:
            contact.set_gap((Y, GAP, 1e-3, TURN))
            plane = contact.solve(load=LOAD, creepage=CREEPAGE, mu=MU)
        plane = [plane.load, plane.fx, plane.fy, plane.mz]
        for option, empty in (((), plane), (("--curved",), self.forces)):
            done = run("batch", "batch.csv", *option, code=1)
            found = list(csv.DictReader(line for line in done.stdout.splitlines()
                                        if line[0] != "#"))
            for row, wanted in zip(found, (self.forces, empty, plane)):
                for value, number in zip(forces(row), wanted):
                    self.assertAlmostEqual(value, number, delta=1e-7 * abs(number))
            self.assertEqual([row["status"] for row in found[3:]],
                             ["bad_argument", "file_format"])
            self.assertIn("inclination", done.stderr)
            self.assertIn("curved must be .true. or .false., got 'so'", done.stderr)
        self.write("gap.nml", f"&contact gap_file = 'turned.csv'\nload_N = {LOAD}\n/\n"
                   f"&material mu = {MU}\n/\n&motion cksi = {CREEPAGE[0]}\nceta = {CREEPAGE[1]}\n"
                   f"cphi_rad_per_mm = {CREEPAGE[2]}\n/\n")
        row, = csv.DictReader(
            line for line in run("contact", "gap.nml", "--curved", "--gap",
                                 "again.csv").stdout.splitlines() if line[0] != "#")
        for value, number in zip(forces(row), self.forces):
            self.assertAlmostEqual(value, number, delta=1e-7 * abs(number))
        lines = (self.folder / "again.csv").read_text(encoding="utf-8").splitlines()
        again = list(csv.DictReader(line for line in lines if line[0] != "#"))
        self.assertEqual([float(row["inclination_rad"]) for row in again], TURN)

    def test_wheelsets_balance_with_it(self):
        # Left is right in a mirror, back is ahead; the force in the track is the contacts' own.
        found = []
        for y, yaw, speed in ((6.3, 5e-3, 2e4), (-6.3, -5e-3, 2e4), (6.3, -5e-3, -2e4)):
            with self.package.Wheelset(curved=True) as wheelset:
                result = wheelset.solve(y=y, yaw=yaw, speed=speed, pitch_rate=-speed / 460.0,
                                        load=6e4, roll=0.0)
            side = "right" if y > 0.0 else "left"
            one = max((one for one in result.contacts if one.side == side),
                      key=lambda one: one.load)
            self.assertAlmostEqual(sum(each.force[2] for each in result.contacts
                                       if each.side == side), 6e4, delta=1e-4)
            found.append([one.load, abs(one.fx), abs(one.fy), abs(one.mz), *map(abs, one.force),
                          *map(abs, one.moment)])
        for other in found[1:]:
            for one, two in zip(found[0], other, strict=True):
                self.assertAlmostEqual(one, two, delta=1e-6 * abs(one) + 1e-3)
        with self.package.Wheelset() as wheelset:
            plane = wheelset.solve(y=6.3, yaw=5e-3, speed=2e4, pitch_rate=-2e4 / 460.0, load=6e4,
                                   roll=0.0)
        one = max((one for one in plane.contacts if one.side == "right"), key=lambda one: one.load)
        self.assertGreater(abs(one.force[1] - math.copysign(found[0][5], one.force[1])), 200.0)

    def test_what_cannot_be_is_refused(self):
        package = self.package
        contact = package.Contact(curved=True)
        contact.set_gap((Y, GAP, 1e-3))
        turned = package.Contact(curved=True)
        turned.set_gap((Y, GAP, 1e-3, TURN))
        self.all_refused(
            ("inclination", lambda: contact.solve(load=LOAD)),
            ("curved surface", lambda: turned.solve(load=LOAD, forces=(None, 3e4))),
            ("curved", lambda: package.Contact(curved="yes")))
