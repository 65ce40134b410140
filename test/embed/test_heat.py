"""Temperatures and hot friction are the same in every interface; what cannot be is refused."""

import csv
import math
import subprocess

from installed import ROOT, HostTest

# Conductivity, heat capacity, density and temperature of wheel and rail; hot over cold friction and
# its temperatures; rolling speed.
BODIES = (60.0, 40.0, 470.0, 430.0, 7700.0, 7900.0, 90.0, 10.0)
HOT = (0.4, 60.0, 250.0)
SPEED = 2.5e4
PLACES = ((0.0, 0.0), (-3.0, 1.0), (-9.0, 0.0), (8.0, 0.0), (0.0, 20.0))
CREEPAGE, LOAD, MU = (0.03, -4e-3, 2e-4), 8e4, 0.35
Y = [0.1 * (i - 150) for i in range(301)]
GAP = [2e-3 * y * y + 3e-5 * y**3 for y in Y]

DECLARED = f"""\
      INTEGER IW(8), IW2(8), IOPT(9), INFO
      DOUBLE PRECISION PAR(9), FRIC(8), HEAT(11), F(4), RES(14), X(5), Y(5), TW(5), TR(5)
      DOUBLE PRECISION YG(301), HG(301), AG(301)
      DATA FRIC /1D0, 0D0, {SPEED}D0, 1D0, 1D0, 0D0, 0D0, 0D0/, IW2 /8*0/
      DATA HEAT /{", ".join(f"{one}D0" for one in BODIES + HOT)}/
      DATA X /{", ".join(f"{one[0]}D0" for one in PLACES)}/
      DATA Y /{", ".join(f"{one[1]}D0" for one in PLACES)}/
      OPEN (9, FILE='gap.txt')
      READ (9, *) YG, HG, AG
      CALL FSDFLT(IOPT, PAR)
      PAR(5) = {MU}D0
      PAR(6) = {LOAD}D0
      PAR(7) = {CREEPAGE[0]}D0
      PAR(8) = {CREEPAGE[1]}D0
      PAR(9) = {CREEPAGE[2]}D0
      IOPT(9) = 1
      CALL FSINIT(IOPT, 301, IW, 8, INFO)
"""

C_CALLER = """\
#include <stdio.h>
#include "faststrip.h"
int main(void)
{
    const double x[] = {%s}, y[] = {%s};
    double gap[3][301], figures[4], wheel[5], rail[5];
    faststrip_case c;
    faststrip_result result;
    faststrip_workspace *workspace;
    FILE *file = fopen("gap.txt", "r");
    for (int i = 0; i < 903; i++)
        if (fscanf(file, "%%lf", &gap[i / 301][i %% 301]) != 1) return 2;
    faststrip_default_case(&c, sizeof c);
    c.with_temperatures = 1;
    if (faststrip_new(&c, 301, &workspace) != 0) return 3;
    printf("%%d\\n", faststrip_get_flash(workspace, figures));
    faststrip_set_gap(workspace, 301, gap[0], gap[1], gap[2], NULL);
    c.load = %r; c.mu = %r; c.cksi = %r; c.ceta = %r; c.cphi = %r; c.speed = %r;
    c.conductivity_wheel = %r; c.conductivity_rail = %r;
    c.heat_capacity_wheel = %r; c.heat_capacity_rail = %r;
    c.density_wheel = %r; c.density_rail = %r;
    c.temperature_wheel = %r; c.temperature_rail = %r;
    c.hot_share = %r; c.cold_temperature = %r; c.hot_temperature = %r;
    printf("%%d\\n", faststrip_solve(workspace, &c, &result));
    printf("%%d\\n", faststrip_get_flash(workspace, figures));
    printf("%%d\\n", faststrip_get_temperatures(workspace, 5, x, y, wheel, rail));
    printf("%%.17g %%.17g %%.17g %%.17g %%.17g\\n", result.fx, figures[0], figures[1], figures[2],
           figures[3]);
    for (int i = 0; i < 5; i++) printf("%%.17g %%.17g\\n", wheel[i], rail[i]);
    printf("%%d\\n", faststrip_get_temperatures(workspace, -1, x, y, wheel, rail));
    printf("%%d\\n", faststrip_get_flash(workspace, NULL));
    c.density_rail = 0.0;
    printf("%%d\\n", faststrip_solve(workspace, &c, &result));
    faststrip_free(&workspace);
    return 0;
}
"""


class Heat(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.package = cls.import_package()
        cls.write("gap.txt", "\n".join(map(repr, [*Y, *GAP, *[1.0 / 920.0] * len(Y)])) + "\n")
        cls.thermal = cls.package.Thermal(*zip(BODIES[::2], BODIES[1::2]))
        cls.friction = cls.package.Friction(hot_share=HOT[0], cold_temperature=HOT[1],
                                            hot_temperature=HOT[2])
        contact = cls.contact(with_elements=True)
        cls.force = contact.solve(**cls.case()).fx
        cls.flash = contact.flash()
        cls.surfaces = contact.temperatures(*zip(*PLACES))

    @classmethod
    def contact(cls, **options):
        contact = cls.package.Contact(**options)
        contact.set_gap(Y, GAP, 1.0 / 920.0)
        return contact

    @classmethod
    def case(cls, **others):
        return {**dict(load=LOAD, creepage=CREEPAGE, mu=MU, friction=cls.friction, speed=SPEED,
                       thermal=cls.thermal), **others}

    def test_python(self):
        rise, largest, *_ = self.flash
        effusivity = [math.sqrt(BODIES[i] * BODIES[i + 2] * BODIES[i + 4]) for i in (0, 1)]
        shared = (90.0 * effusivity[0] + 10.0 * effusivity[1]) / sum(effusivity)
        self.assertAlmostEqual(largest - rise, shared, places=9)
        wheel, rail = self.surfaces
        self.assertEqual(wheel[:2].tolist(), rail[:2].tolist())
        # Behind they part; ahead and beside they are as they were.
        self.assertGreater(wheel[2], rail[2] + 10.0)
        self.assertEqual((wheel[3:].tolist(), rail[3:].tolist()), ([90.0] * 2, [10.0] * 2))
        with self.contact(with_elements=True) as contact:
            cold = contact.solve(**self.case(friction=self.package.Friction()))
            self.assertGreater(abs(cold.fx), 1.1 * abs(self.force))
            self.assertGreater(contact.flash().flash_temperature, 1.1 * rise)
            elements = contact.elements()
            hottest = contact.temperatures(elements.x, elements.y)[0].max()
            self.assertAlmostEqual(hottest, contact.flash().temperature_max, places=9)

    def test_many(self):
        many = self.package.solve_many(
            (Y, GAP, 1.0 / 920.0), **self.case(load=[LOAD, 0.5 * LOAD, -1.0], threads=2))
        self.assertEqual(many.fx[0], self.force)
        for name, wanted in zip(("flash_temperature", "temperature_max", "temperature_x",
                                 "temperature_y"), self.flash):
            found = getattr(many, name)
            self.assertEqual(found[0], wanted)
            self.assertTrue(math.isnan(found[2]))
        self.assertLess(many.flash_temperature[1], many.flash_temperature[0])
        cold = self.package.solve_many((Y, GAP, 1.0 / 920.0), load=LOAD)
        self.assertTrue(math.isnan(cold.temperature_max))

    def test_c(self):
        x, y = (", ".join(map(repr, one)) for one in zip(*PLACES))
        self.write("heat.c", C_CALLER % (x, y, LOAD, MU, *CREEPAGE, SPEED, *BODIES, *HOT))
        self.shell("gcc -O1 -Wall -Wextra -Werror heat.c $(pkg-config --cflags --libs faststrip)"
                   " -o heat")
        lines = [list(map(float, line.split())) for line in self.shell("./heat").splitlines()]
        self.assertEqual(lines[:4], [[100.0], [8.0], [0.0], [0.0]])
        self.assertEqual(lines[4], [self.force, *self.flash])
        self.assertEqual(lines[5:10], [list(one) for one in zip(*self.surfaces)])
        self.assertEqual(lines[10:], [[100.0]] * 3)

    def test_fixed_form_fortran(self):
        near = "ABS(TW({0}) - {1!r}D0) + ABS(TR({0}) - {2!r}D0)"
        surfaces = " + ".join(near.format(i, float(wheel), float(rail)) for i, (wheel, rail)
                              in enumerate(zip(*self.surfaces), 1))
        self.check_calls(DECLARED, (
            ("nowhere", 100, "CALL FSHEAT(IW2, 1, HEAT, INFO)"),
            ("unsolved", 100, "CALL FSFLSH(IW, 1, F, INFO)"),
            ("friction", 0, "CALL FSFRIC(IW, 0, FRIC, INFO)"),
            ("heat", 0, "CALL FSHEAT(IW, 1, HEAT, INFO)"),
            ("solved", 8, "CALL FSCONT(IW, 301, YG, HG, AG, IOPT, PAR, RES, INFO)"),
            ("force", 0, f"INFO = NINT(1D6*(RES(8) - ({float(self.force)!r}D0)))"),
            ("flash", 0, "CALL FSFLSH(IW, 1, F, INFO)"),
            ("largest", 0, f"INFO = NINT(1D6*(F(2) - {float(self.flash[1])!r}D0))"),
            ("places", 0, "CALL FSTEMP(IW, 1, 5, X, Y, TW, TR, INFO)"),
            ("surfaces", 0, f"INFO = NINT(1D6*({surfaces}))"),
            ("bad", 100, "HEAT(5) = 0D0; CALL FSHEAT(IW, 1, HEAT, INFO); "
             "CALL FSSOLV(IW, IOPT, PAR, RES, INFO)")))

    def test_the_program(self):
        rows = "".join(f"{y!r},{h!r},{1.0 / 920.0!r}\n" for y, h in zip(Y, GAP))
        self.write("gap.csv", "y_mm,h_mm,inv2R_per_mm\n" + rows)
        names = ("conductivity_{}_W_per_mK", "heat_capacity_{}_J_per_kgK", "density_{}_kg_per_m3",
                 "temperature_{}_C")
        values = [f"{name.format(body)} = {BODIES[2 * i + j]!r}" for i, name in enumerate(names)
                  for j, body in enumerate(("wheel", "rail"))]
        self.write("case.nml", f"&contact gap_file = 'gap.csv'\nload_N = {LOAD!r}\n/\n"
                   f"&material mu = {MU!r}\n/\n&motion cksi = {CREEPAGE[0]!r}\n"
                   f"ceta = {CREEPAGE[1]!r}\ncphi_rad_per_mm = {CREEPAGE[2]!r}\n"
                   f"speed_mm_s = {SPEED!r}\n/\n&friction mu_hot = {HOT[0] * MU!r}\n"
                   f"cold_temperature_C = {HOT[1]!r}\nhot_temperature_C = {HOT[2]!r}\n/\n"
                   "&thermal " + "\n".join(values) + "\n/\n")
        done = subprocess.run([ROOT / "bin" / "faststrip", "contact", "case.nml"],
                              cwd=self.folder, check=True, stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL, encoding="utf-8")
        row, = csv.DictReader(line for line in done.stdout.splitlines() if line[0] != "#")
        found = [float(row[name]) for name in ("Fx_N", "flash_temperature_K", "temperature_max_C",
                                               "temperature_x_mm", "temperature_y_mm")]
        for one, other in zip(found, (self.force, *self.flash), strict=True):
            self.assertAlmostEqual(one, other, delta=1e-9 * abs(other))

    def test_wheelsets_have_them_on_both_sides(self):
        # The same wheel on both sides, in a mirror, and rolling back.
        found = []
        for y, speed, place in ((4.0, 2e4, 0), (-4.0, 2e4, 1), (4.0, -2e4, 0)):
            wheelset = self.package.Wheelset(with_elements=True, thermal=self.thermal)
            result = wheelset.solve(y=y, yaw=0.0, speed=speed, pitch_rate=-1.03 * speed / 460.0,
                                    load=6e4, roll=0.0)
            sides = [one.side for one in result.contacts]
            i = sides.index(("right", "left")[place])
            flash = wheelset.flash()[i]
            x, across = flash[2:]
            hottest = float(wheelset.temperatures(i, x, across)[0])
            self.assertAlmostEqual(hottest, flash[1], places=6)
            found.append((flash[0], flash[1], math.copysign(x, -1.0), abs(across)))
            self.assertEqual(x > 0.0, speed < 0.0)
        for other in found[1:]:
            for one, two in zip(found[0], other):
                self.assertAlmostEqual(one, two, delta=1e-3 * abs(one) + 1e-6)

    def test_what_cannot_be_is_refused(self):
        package = self.package
        plain, kept = self.contact(), self.contact(with_elements=True)
        law = self.contact(tangential="polach", with_elements=False)
        self.all_refused(
            ("with_elements", lambda: plain.solve(**self.case())),
            ("a faststrip.Thermal", lambda: kept.solve(**self.case(thermal=20.0))),
            ("wheel and rail", lambda: kept.solve(**self.case(
                thermal=package.Thermal(density=(1.0, 2.0, 3.0))))),
            ("thermal.temperature", lambda: kept.solve(**self.case(
                thermal=package.Thermal(temperature=math.nan)))),
            ("density must be above 0", lambda: kept.solve(**self.case(
                thermal=package.Thermal(density=-1.0)))),
            ("rolling speed", lambda: kept.solve(**self.case(friction=package.Friction(),
                                                             speed=0.0))),
            ("hot friction over cold", lambda: kept.solve(**self.case(
                friction=package.Friction(hot_share=1.2)))),
            ("polach takes no friction that falls with temperature",
             lambda: law.solve(**self.case(thermal=None))),
            ("there are no temperatures", kept.flash),
            ("that go with x", lambda: kept.temperatures([1.0, 2.0], [1.0, 2.0, 3.0])),
            ("there are no temperatures", lambda: kept.temperatures(0.0, 0.0)))
