"""Friction and wear are the same in every interface, bit for bit; what cannot be is refused."""

import csv
import math
import subprocess

import methods
from installed import HOSTS, HostTest, bits

REGIMES = ((0.0, 1.5, 0.2, 0.7), (1.5, 4.0, 2.0, 0.0), (4.0, 400.0, 1.0, 0.25))
DENSITY, YIELD = 7850.0, 310.0
NORMAL, TANGENTIAL = methods.listed("normal"), methods.listed("tangential")
KINDS = {"constant": 0, "linear": 2, "rational": 3, "exponential": 4}
NAMES = ("kinetic_share", "half_slip_speed", "slope_factor", "flange_share", "tread_angle",
         "flange_angle")
# Methods, kind, mu; kinetic share, half-value slip speed, slope factor, flange; speed, angle.
WAYS = (
    ("strip", "faststrip", "constant", 0.3, 1.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0),
    ("strip", "faststrip", "exponential", 0.35, 0.45, 30.0, 0.7, 0.5, 0.1, 0.9, 9e3, -0.4),
    ("hertz", "fastsim", "linear", 0.32, 0.6, 50.0, 1.0, 1.0, 0.0, 0.0, 8e3, 0.2),
    ("strip", "faststrip", "rational", 0.28, 0.5, 40.0, 1.0, 1.6, 0.2, 0.7, 1.1e4, 0.3),
    ("hertz", "polach", "constant", 0.4, 1.0, 0.0, 0.8, 0.6, 0.05, 0.6, 0.0, 0.31),
    # None that polach takes, none at all.
    ("hertz", "polach", "linear", 0.4, 0.5, 40.0, 1.0, 1.0, 0.0, 0.0, 1e4, 0.0),
    ("strip", "faststrip", "constant", 0.4, 1.0, 0.0, 1.5, 1.0, 0.0, 0.0, 0.0, 0.0))


def input_text():
    lines = [f"{len(WAYS)} {len(REGIMES)} {DENSITY} {YIELD}"]
    lines += [" ".join(map(repr, regime)) for regime in REGIMES]
    for normal, tangential, kind, mu, share, half, slope, *flange, speed, angle in WAYS:
        lines.append(" ".join(map(str, (NORMAL[normal].number, TANGENTIAL[tangential].number,
                                        KINDS[kind], mu, share, half, speed, slope, *flange,
                                        angle))))
    return "\n".join(lines) + "\n"


# As in test_legacy.
DECLARED = """\
      INTEGER IW(8), IW2(8), IOPT(9), N, INFO
      DOUBLE PRECISION PAR(9), FRIC(8), REGIM(4, 33), W(6), X(9), Y(5), H(5), A(5), RES(14)
      DATA FRIC /0.5D0, 40D0, 1D4, 1D0, 1D0, 0D0, 0D0, 0D0/, IW2 /8*0/, A /5*1D-3/
      DATA REGIM /0D0, 1D9, 1D0, 129*1D0/, Y /-10D0, -5D0, 0D0, 5D0, 10D0/
      DATA H /0.2D0, 0.05D0, 0D0, 0.05D0, 0.2D0/
      CALL FSDFLT(IOPT, PAR)
      PAR(6) = 1D4
      PAR(7) = 1D-3
      CALL FSINIT(IOPT, 5, IW, 8, INFO)
"""
ROWS = (
    ("nowhere", 100, "CALL FSFRIC(IW2, 2, FRIC, INFO)"),
    ("none", 100, "CALL FSWEAR(IW2, 1, 0, REGIM, 1D0, 0D0, W, INFO)"),
    ("strips", 100, "CALL FSSTWR(IW2, 0, REGIM, 1D0, 9, N, X, X, X, X, X, X, INFO)", "INFO + N"),
    ("unsolved", 100, "CALL FSWEAR(IW, 1, 0, REGIM, 1D0, 0D0, W, INFO)"),
    ("solved", 0, "CALL FSCONT(IW, 5, Y, H, A, IOPT, PAR, RES, INFO)"),
    ("few", 110, "CALL FSSTWR(IW, 1, REGIM, 1D0, 9, N, X, X, X, X, X, X, INFO)",
     "INFO + N - NINT(RES(14))"),
    ("many", 100, "CALL FSWEAR(IW, 1, 33, REGIM, 1D0, 0D0, W, INFO)"),
    ("set", 0, "CALL FSFRIC(IW, 2, FRIC, INFO)"),
    ("forgotten", 100, "CALL FSWEAR(IW, 1, 0, REGIM, 1D0, 0D0, W, INFO)"),
    ("falling", 8, "CALL FSSOLV(IW, IOPT, PAR, RES, INFO)"),
    ("unknown", 100, "CALL FSFRIC(IW, 1, FRIC, INFO); CALL FSSOLV(IW, IOPT, PAR, RES, INFO)"),
)


class Interfaces(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.write("ways.txt", input_text())
        cls.shell(f"gfortran -O1 '{HOSTS}/wear.f90' $(pkg-config --cflags --libs faststrip)"
                  " -o by_fortran")
        cls.lines = cls.shell("./by_fortran <ways.txt").splitlines()
        cls.package = cls.import_package()

    def test_what_is_compared(self):
        told = [line for line in self.lines if line[0] in "cw"]
        self.assertEqual(len(told), 2 * len(WAYS))
        self.assertEqual(told[-4:], ["contact 100", "wheelset 100"] * 2)
        # Falling friction leaves no estimate, 8, but the friction of a tread does.
        self.assertEqual(told[:6:2], ["contact 0", "contact 8", "contact 8"])
        self.assertGreater(len(set(self.lines)), 60)

    def test_c_has_the_bits_of_fortran(self):
        self.shell(f"gcc -O1 -Wall -Wextra -Werror '{HOSTS}/wear.c'"
                   " $(pkg-config --cflags --libs faststrip) -o by_c")
        self.assertEqual(self.shell("./by_c <ways.txt").splitlines(), self.lines)

    def test_fixed_form_fortran_has_them(self):
        self.shell("gfortran -std=legacy -Wall -O1 -ffpe-trap=invalid,zero,overflow"
                   f" '{HOSTS}/wear.f' $(pkg-config --libs faststrip) -o by_f77")
        self.assertEqual(self.shell("./by_f77 <ways.txt").splitlines(), self.lines)

    def test_every_subroutine_says_what_is_wrong(self):
        self.check_calls(DECLARED, ROWS)

    def test_python_has_them(self):
        lines = []
        for normal, tangential, kind, mu, *values, speed, angle in WAYS:
            friction = self.package.Friction(kind, **dict(zip(NAMES, values)))
            law = (self.package.WearLaw(REGIMES, DENSITY) if tangential == "faststrip" else None)
            with self.contact(normal=normal, tangential=tangential) as contact:
                try:
                    result = contact.solve(load=8e4, creepage=(4e-3, -2e-3, 2e-4), mu=mu,
                                           friction=friction, speed=speed, contact_angle=angle)
                    lines.append(f"contact {result.status}")
                    lines.append(bits(result.fx, result.fy, result.mz))
                    lines += rows_of(contact.wear(law, yield_shear=YIELD))
                    if law:
                        lines += [bits(*row) for row in zip(*contact.strip_wear(law))]
                except self.package.FaststripError as problem:
                    lines.append(f"contact {problem.status}")
            wheelset = self.package.Wheelset(normal=normal, tangential=tangential, mu=mu,
                                             friction=friction)
            try:
                result = wheelset.solve(y=6.2, yaw=1e-3, speed=1e4, pitch_rate=-1e4 / 460.0,
                                        load=6e4, roll=0.0)
                lines.append(f"wheelset {result.status}")
                for one, worn in zip(result.contacts, wheelset.wear(law, yield_shear=YIELD),
                                     strict=True):
                    lines += [bits(one.fx, one.fy, one.mz), *rows_of(worn)]
            except self.package.FaststripError as problem:
                lines.append(f"wheelset {problem.status}")
        self.assertEqual(lines, self.lines)

    def contact(self, **options):
        y = [0.1 * (i - 150) for i in range(301)]
        contact = self.package.Contact(**options)
        contact.set_gap(y, [2e-3 * one * one + 3e-5 * one * one * one for one in y], 1.0 / 920.0)
        return contact

    def test_without_a_law_there_is_no_wear(self):
        contact = self.contact()
        contact.solve(load=8e4, creepage=(4e-3, -2e-3, 2e-4))
        self.assertEqual(contact.strip_wear()[4:], (None, None))
        self.assertEqual(contact.wear()[3:], (None, None, None))

    def test_the_program_prints_them(self):
        """The row of the CSV, by a case file with &friction and a file of the law."""
        rows = "".join(f"{one},{two},{three},{four}\n" for one, two, three, four in REGIMES)
        self.write("law.csv", "# source: made up for a test\n# density_kg_per_m3: 7850\n"
                              "# body: wheel\nfrom_N_per_mm2,to_N_per_mm2,constant_ug_per_m_mm2,"
                              "slope_ug_per_m_N\n" + rows)
        self.write("gap.csv", "y_mm,h_mm,inv2R_per_mm\n" + "".join(
            f"{0.1 * i!r},{2e-3 * (0.1 * i)**2!r},{1.0 / 920.0!r}\n" for i in range(-150, 151)))
        self.write("case.nml", "&contact\n name = 'x'\n gap_file = 'gap.csv'\n load_N = 8e4\n/\n"
                               "&material\n mu = 0.35\n/\n&motion\n cksi = 4e-3\n ceta = -2e-3\n"
                               " cphi_rad_per_mm = 2e-4\n speed_mm_s = 9e3\n/\n&friction\n"
                               " kind = 'exponential'\n mu_kinetic = 0.14\n"
                               " half_slip_speed_mm_s = 30\n initial_slope_factor = 0.7\n/\n")
        subprocess.run([str(self.installed.prefix / "bin" / "faststrip"), "contact", "case.nml",
                        "--wear", "law.csv", "--yield-shear-MPa", "310", "-o", "row.csv"],
                       cwd=self.folder, check=True, stdin=subprocess.DEVNULL)
        with open(self.folder / "row.csv", encoding="utf-8") as file:
            row, = csv.DictReader(line for line in file if line[0] != "#")
        y = [0.1 * i for i in range(-150, 151)]
        contact = self.package.Contact()
        contact.set_gap(y, [2e-3 * one**2 for one in y], 1.0 / 920.0)
        result = contact.solve(load=8e4, creepage=(4e-3, -2e-3, 2e-4), mu=0.35, speed=9e3,
                               friction=self.package.Friction("exponential", 0.14 / 0.35, 30.0,
                                                              0.7))
        worn = contact.wear(self.package.WearLaw(REGIMES, DENSITY), yield_shear=YIELD)
        for found, column in ((result.fx, "Fx_N"), *zip(worn, (
                "t_gamma_N", "t_gamma_spin_N", "t_gamma_per_area_N_per_mm2", "fatigue_index",
                "wear_ug_per_m", "wear_mm3_per_m"))):
            self.assertAlmostEqual(found, float(row[column]), delta=1e-9 * abs(found), msg=column)

    def test_friction_is_refused_by_name(self):
        friction, contact = self.package.Friction, self.contact(tangential="she", normal="hertz")
        for says, given, more in (
                ("she takes no friction that falls", friction("linear", 0.5, 30.0), {"speed": 1e4}),
                ("kinetic friction over static friction must be", friction("linear", 0.0), {}),
                ("needs a rolling speed", friction("linear", 0.5, 30.0), {}),
                ("beyond 1e-12 to 1e12", friction("linear", 0.5, 1e13), {"speed": 1e4}),
                ("factor of the initial slope", friction(slope_factor=0.0), {}),
                ("must not be negative, got -0.5", friction(flange_share=-0.5), {}),
                ("the angle of the flange", friction(flange_share=0.5), {}),
                ("friction.kind must be one of constant, linear", friction("square"), {}),
                ("friction.slope_factor must be finite", friction(slope_factor=math.inf), {}),
                ("contact_angle must be finite", friction(), {"contact_angle": math.nan}),
                ("speed must be a number", friction(), {"speed": "fast"}),
                ("friction must be a faststrip.Friction", 0.3, {})):
            self.all_refused((says, lambda: contact.solve(load=8e4, friction=given, **more)))
            # What was refused stays out of the next call.
            self.assertEqual(contact.solve(load=8e4).word, "ok", says)
        with self.assertRaisesRegex(self.package.FaststripError, "polach takes no friction"):
            self.package.Wheelset(tangential="polach", friction=friction("linear", 0.5, 30.0)
                                  ).solve(load=6e4, speed=1e4, pitch_rate=-1e4 / 460.0)

    def test_a_contact_without_an_angle_is_on_the_tread(self):
        both = self.package.Friction(flange_share=0.5, tread_angle=0.1, flange_angle=0.5)
        contact = self.contact()
        ask = {"load": 8e4, "creepage": (4e-3, 0.0, 0.0)}
        forces = [contact.solve(**ask, **more).fx for more in (
            {}, {"friction": both}, {"friction": both, "contact_angle": -0.3}, {"mu": 0.225},
            {"friction": both, "contact_angle": 1.0}, {"mu": 0.15})]
        self.assertEqual(forces[0], forces[1])
        self.assertAlmostEqual(forces[2], forces[3], delta=1e-6)
        self.assertAlmostEqual(forces[4], forces[5], delta=1e-6)

    def test_wear_is_refused_by_name(self):
        law = self.package.WearLaw
        solved, other = self.contact(), self.contact(tangential="fastsim")
        auto = self.contact(normal="auto", tangential="fastsim")
        for contact in (solved, other, auto):
            contact.solve(load=8e4, creepage=(4e-3, -2e-3, 2e-4))
        good = law(REGIMES, DENSITY)
        without = self.contact(tangential="none")
        without.solve(load=8e4)
        wheelset = self.package.Wheelset(tangential="fastsim")
        self.assertEqual(wheelset.wear(), ())
        wheelset.solve(load=6e4)
        self.all_refused(
                ("no contact that was solved", self.contact().wear),
                ("the tangential method is none", without.wear),
                ("faststrip or faststrip-plain, got fastsim", lambda: other.wear(good)),
                ("faststrip or faststrip-plain, got fastsim", other.strip_wear),
                ("faststrip or faststrip-plain, got fastsim", lambda: wheelset.wear(good)),
                ("rows of four numbers, got []", lambda: solved.wear(law([], 1.0))),
                ("1 to 32 regimes, got 33", lambda: solved.wear(law([(0, 1, 1, 0)] * 33, 1.0))),
                ("the density must be above 0", lambda: solved.wear(law(REGIMES, 0.0))),
                ("a regime must begin where", lambda: solved.wear(law(REGIMES[1:], 1.0))),
                ("a regime must end above", lambda: solved.wear(law([(0, 0, 1, 0)], 1.0))),
                ("a wear rate must not be", lambda: solved.wear(law([(0, 1, -1, 0)], 1.0))),
                ("out_of_range: the wear law ends", lambda: solved.wear(law([(0, 0.1, 1, 0)], 1))),
                ("the wear law ends", lambda: solved.strip_wear(law([(0, 0.1, 1, 0)], 1.0))),
                ("rows of four numbers", lambda: solved.wear(law([(0, 1, 1)], 1.0))),
                ("law must be a faststrip.WearLaw", lambda: solved.wear(3)),
                ("yield_shear must be a number above 0", lambda: solved.wear(yield_shear=0.0)),
                ("the yield stress in shear must not be", lambda: solved.wear(
                    yield_shear=math.inf)))
        # By auto the forces are FASTSTRIP's, whatever was asked for.
        self.assertGreater(auto.wear(good).mass, 0.0)


def rows_of(worn):
    rows = [bits(*worn[:4])]
    return rows if worn.mass is None else [*rows, bits(*worn[4:])]
