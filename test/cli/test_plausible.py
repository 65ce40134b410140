"""What no contact can be: mistakes of units are named with their likely cause, by the program; what
is unusual, but done, is not mentioned. No figure depends on it."""

import re
import unittest

from cli_program import BATCH_COLUMNS, ROOT, ProgramTest, gap_case, gap_text, parabola, profile_case

# Name, contact, wheel, rail, material, motion, rest of the case file; what the line must say.
MISTAKES = (
    ("friction in percent", {"material": "mu = 35"}, ("mu ", "percent?")),
    ("friction of the flange in percent",
     {"extra": "&friction mu_flange = 10, tread_angle_rad = 0.1, flange_angle_rad = 0.5 /\n"},
     ("mu_flange", "percent?")),
    ("Poisson's ratio in percent", {"material": "mu = 0.3, nu_wheel = 28"},
     ("nu_wheel", "percent?")),
    ("E in GPa", {"material": "mu = 0.3, E_wheel_MPa = 210, E_rail_MPa = 210"},
     ("E_wheel_MPa", "GPa?")),
    ("E of one body in GPa", {"material": "mu = 0.3, E_rail_MPa = 210"}, ("E_rail_MPa", "GPa?")),
    ("E in Pa", {"material": "mu = 0.3, E_wheel_MPa = 2.1e11, E_rail_MPa = 2.1e11"},
     ("E_wheel_MPa", "Pa or kPa?")),
    ("radius in metres", {"wheel": "profile = 's1002', radius_mm = 0.46"},
     ("radius_mm", "metres or inches?")),
    ("radius in inches", {"wheel": "profile = 's1002', radius_mm = 18.1"},
     ("the width of s1002", "radius in inches?")),
    ("diameter for radius", {"wheel": "profile = 's1002', radius_mm = 920"},
     ("radius_mm", "the diameter?")),
    ("load in kN", {"contact": "load_N = 80"}, ("load_N", "kN or tonnes?")),
    ("load in tonnes", {"contact": "load_N = 8"}, ("load_N", "kN or tonnes?")),
    ("spin in 1/m", {"motion": "cphi_rad_per_mm = 0.17"}, ("cphi_rad_per_mm", "1/m?")),
    ("creepage in percent", {"motion": "cksi = 0.5"}, ("cksi", "percent?")),
    ("lateral creepage in percent", {"motion": "ceta = -1.5"}, ("ceta", "percent?")),
    ("inclination in degrees", {"rail": "profile = 'uic60', cant = 1.43"}, ("cant", "degrees")),
    ("inclination in degrees, by its name", {"rail": "profile = 'uic60', inclination = 1.43"},
     ("inclination should", "degrees")),
    ("inclination as 1:40", {"rail": "profile = 'uic60', cant = 40"}, ("cant", "40 for 1:40?")),
    ("gauge in metres", {"rail": "profile = 'uic60', gauge_mm = 1.435"},
     ("gauge_mm", "metres or inches?")),
    ("speed in km/h",
     {"motion": "speed_mm_s = 100",
      "extra": "&friction kind = 'rational', mu_kinetic = 0.1, half_slip_speed_mm_s = 1500 /\n"},
     ("speed_mm_s", "m/s or km/h?")),
    ("slip speed in m/s",
     {"motion": "speed_mm_s = 20000",
      "extra": "&friction kind = 'rational', mu_kinetic = 0.1, half_slip_speed_mm_s = 1.5 /\n"},
     ("half_slip_speed_mm_s", "m/s?")),
    ("angle of the flange in degrees",
     {"extra": "&friction mu_flange = 0.1, tread_angle_rad = 0.1, flange_angle_rad = 70 /\n"},
     ("flange_angle_rad", "degrees?")),
    ("shift in micrometres", {"contact": "load_N = 1e5, shift_mm = 2000"},
     ("shift_mm", "micrometres?")),
    ("yield stress in GPa", {"extra": "&numerics yield_MPa = 0.9 /\n"}, ("yield_MPa", "GPa?")),
    ("noise in mm", {"extra": "&numerics smoothing_um = 0.0005 /\n"}, ("smoothing_um", "mm?")),
)

# The same with a gap file: how it is scaled, the case, what the line must say.
GAP_MISTAKES = (
    ("radius in metres", {"inv2r": 1.0 / 0.92}, {}, ("1/(2 inv2R_per_mm)", "1/m")),
    ("diameter for radius", {"inv2r": 1.0 / 1840.0}, {}, ("1/(2 inv2R_per_mm)", "diameter?")),
    ("radius for 1/(2 R)", {"inv2r": 460.0}, {}, ("1/(2 inv2R_per_mm)", "the radius itself?")),
    ("y in metres", {"half_width": 0.015}, {}, ("the width of y_mm", "metres or inches?")),
    ("h in micrometres", {"h": 1.0e3}, {}, ("h_mm", "micrometres?")),
    ("h in metres", {"h": 1.0e-3}, {}, ("h_mm", "metres?")),
    ("penetration in micrometres", {}, {"penetration_mm": 90}, ("penetration_mm", "micrometres?")),
    ("penetration in metres", {}, {"penetration_mm": 9e-5}, ("penetration_mm", "metres?")),
    ("load in kN", {}, {"load": "80"}, ("load_N", "kN or tonnes?")),
)

# States of a wheelset: what differs, what the line must say.
STATES = (
    ({"yaw_rad": "4.0"}, ("yaw_rad should", "degrees or mrad?")),
    ({"yaw_rad": "2.0"}, ("yaw of the wheelset must", "degrees or mrad?")),
    ({"yaw_rad": "0.23"}, ("yaw_rad", "degrees or mrad?")),
    ({"roll_rad": "0.3", "side": "right", "Fz_N": "80000"}, ("roll_rad", "degrees or mrad?")),
    ({"speed_mm_s": "100"}, ("speed_mm_s", "m/s or km/h?")),
    ({"Fz_N": "160"}, ("Fz_N", "kN or tonnes?")),
    ({"curve_radius_mm": "400"}, ("curve_radius_mm", "metres?")),
    ({"pitch_rate_rad_s": "-415"}, ("pitch_rate_rad_s", "turns a minute?")),
    ({"y_mm": "2000"}, ("y_mm", "micrometres?")),
)

# Legitimate, and unusual: radius, load, E, nu, mu, creepages, lateral radius, half width.
STEEL = (2.1e5, 0.28)
UNUSUAL = (
    ("roller rig, 1:3", 150.0, 5.0e3, *STEEL, 0.3, (1e-3, 0, 1e-4), 100.0, 8.0),
    ("crane wheel", 200.0, 3.0e5, *STEEL, 0.15, (0, 2e-3, 0), 600.0, 30.0),
    ("crane wheel, large", 500.0, 6.0e5, *STEEL, 0.15, (0, 2e-3, 0), 600.0, 30.0),
    ("tram", 300.0, 4.0e4, *STEEL, 0.3, (2e-3, 5e-3, 4e-4), 300.0, 15.0),
    ("light test rig", 460.0, 1.0e3, *STEEL, 0.3, (1e-3, 0, 0), 300.0, 15.0),
    ("2 discs, 20 mm", 10.0, 1.0e3, *STEEL, 0.3, (0.01, 0, 0), 40.0, 5.0),
    ("2 discs, 50 mm", 25.0, 4.0e3, *STEEL, 0.3, (0.02, 0, 0), 100.0, 6.0),
    ("2 discs, 47 mm", 11.75, 1.5e3, *STEEL, 0.3, (0.03, 0, 0), 50.0, 5.0),
    ("ball on disc", 9.5, 30.0, *STEEL, 0.1, (0.1, 0, 0), 19.0, 2.0),
    ("model 1:10", 46.0, 60.0, *STEEL, 0.3, (1e-3, 0, 1e-3), 30.0, 4.0),
    ("model 1:5", 92.0, 700.0, *STEEL, 0.3, (1e-3, 0, 1e-3), 60.0, 6.0),
    ("model 1:20", 23.0, 10.0, *STEEL, 0.3, (1e-3, 0, 0), 15.0, 2.0),
    ("oil on the rail", 460.0, 8.0e4, *STEEL, 0.01, (1e-3, 0, 0), 300.0, 15.0),
    ("sand on the rail", 460.0, 8.0e4, *STEEL, 0.8, (1e-2, 0, 0), 300.0, 15.0),
    ("without friction", 460.0, 8.0e4, *STEEL, 0.0, (0, 0, 0), 300.0, 15.0),
    ("adhesion test", 460.0, 8.0e4, *STEEL, 0.4, (0.15, 0, 0), 300.0, 15.0),
    ("braked, sliding", 460.0, 8.0e4, *STEEL, 0.2, (0.2, 0, 0), 300.0, 15.0),
    ("mine, 40 t an axle", 460.0, 2.0e5, *STEEL, 0.35, (1e-3, 1e-3, 2e-4), 300.0, 18.0),
    ("aluminium", 300.0, 2.0e4, 7.0e4, 0.33, 0.3, (1e-3, 0, 0), 300.0, 15.0),
    ("cast iron", 400.0, 8.0e4, 1.0e5, 0.26, 0.3, (1e-3, 0, 0), 300.0, 15.0),
    ("hard metal", 100.0, 5.0e3, 6.0e5, 0.22, 0.3, (1e-3, 0, 0), 100.0, 8.0),
    ("polyurethane", 150.0, 2.0e3, 50.0, 0.47, 0.6, (5e-3, 0, 0), 300.0, 60.0),
    ("polyamide", 125.0, 5.0e3, 3.0e3, 0.4, 0.2, (5e-3, 0, 0), 300.0, 40.0),
    ("locomotive, 1250 mm", 625.0, 1.1e5, *STEEL, 0.35, (2e-3, 0, 0), 300.0, 15.0),
    ("smallest wheel, 330 mm", 165.0, 3.0e4, *STEEL, 0.35, (2e-3, 0, 3e-4), 300.0, 15.0),
    ("flange, 70 degrees", 460.0 / 0.34, 6.0e4, *STEEL, 0.3, (3e-3, 1e-2, 2e-3), 30.0, 6.0),
    ("flange of a tram", 300.0 / 0.26, 3.0e4, *STEEL, 0.3, (3e-3, 1e-2, 3e-3), 30.0, 6.0),
    ("unloaded wheel", 460.0, 1.0e3, *STEEL, 0.3, (1e-3, 5e-3, 2e-4), 300.0, 15.0),
    ("impact, 400 kN", 460.0, 4.0e5, *STEEL, 0.3, (1e-3, 0, 0), 300.0, 25.0),
    ("worn, nearly conformal", 460.0, 1.0e5, *STEEL, 0.3, (1e-3, 0, 2e-4), 3000.0, 35.0),
    ("narrow tread", 460.0, 1.0e4, *STEEL, 0.3, (1e-3, 0, 0), 30.0, 3.0),
    ("conveyor of a mine", 175.0, 1.2e4, *STEEL, 0.25, (2e-3, 2e-3, 5e-4), 200.0, 15.0),
)
FLANGES = ("flange, 70 degrees", "flange of a tram")


def gap_of(h=1.0, **how):
    return gap_text(lambda y: h * parabola(y), **how)


def documented_ranges():
    """The rows of the page that has to have the ranges of the source."""
    text = (ROOT / "src/faststrip/base/plausible.f90").read_text(encoding="utf-8")
    text = text[text.index("quantities(*) = ["):text.index("\ncontains")]
    text = re.sub(r"&\s*\n\s*", "", text)
    for row in re.findall(r"quantity_t\((.*?)\)(?=,\s*quantity_t|\])", text):
        name, unit, _, _, least, most, below, above = (
            part.strip().strip("'\"")
            for part in re.findall(r"'[^']*'|\"[^\"]*\"|[^,\s][^,]*", row))
        yield " | ".join((f"| {name}", unit, shown(least), shown(most), below, f"{above} |"))


def shown(bound):
    value = 0.0 if bound == "any_size" else float(bound.removesuffix("_wp"))
    return "" if value == 0.0 else f"{value:g}" if value < 1e4 else f"{value:,.0f}"


class TestDocument(unittest.TestCase):

    def test_the_page_has_the_ranges_of_the_source(self):
        page = (ROOT / "docs/errors.md").read_text(encoding="utf-8").splitlines()
        rows = list(documented_ranges())
        self.assertGreater(len(rows), 20)
        for row in rows:
            self.assertIn(row, page)


class TestMistakes(ProgramTest):

    def named(self, says, *words):
        """One line says all of it, with a result or with the error that ends the run."""
        done = self.run_program(*words)
        self.assertIn(done.returncode, (0, 1, 3), words)
        said = [line for line in done.stderr.splitlines() if all(text in line for text in says)]
        self.assertEqual(len(said), 1, (words, says, done.stderr))
        if done.returncode == 0 and done.stdout:
            comments = [line for line in done.stdout.splitlines() if line.startswith("#")]
            self.assertTrue(any(all(text in line for text in says) for line in comments),
                            (says, comments))
        return done

    def test_profiles(self):
        for name, groups, says in MISTAKES:
            with self.subTest(name):
                self.write("case.nml", profile_case(**groups))
                self.named(says, "contact", "case.nml")

    def test_gaps(self):
        for name, gap, how, says in GAP_MISTAKES:
            with self.subTest(name):
                self.write("gap.csv", gap_of(**gap))
                case = gap_case(load=how.get("load", "1e5"))
                if "penetration_mm" in how:
                    case = case.replace("load_N = 1e5", f"penetration_mm = {how['penetration_mm']}")
                self.write("case.nml", case)
                self.named(says, "contact", "case.nml", "--tangential", "none")

    def test_states(self):
        given = {"case": "a", "side": "both", "y_mm": "1.0", "roll_rad": "", "yaw_rad": "0.001",
                 "speed_mm_s": "20000", "pitch_rate_rad_s": "", "Fz_N": "160000"}
        self.write("case.nml", profile_case())
        for change, says in STATES:
            with self.subTest(says):
                row = given | change
                self.write("states.csv", ",".join(row) + "\n" + ",".join(row.values()) + "\n")
                self.named(says, "wheelset", "case.nml", "--states", "states.csv")

    def test_profiles_of_other_units(self):
        inches = "\n".join(f"{y / 25.4} {(y * y / 600.0) / 25.4}" for y in range(-36, 37))
        self.write("rail.txt", inches)
        self.write("case.nml", profile_case(rail="profile = 'rail.txt', y_positive_to = 'field',"
                                                 " z_positive_to = 'down'"))
        self.named(("rail.txt", "--unit", "2.84143 mm"), "contact", "case.nml")

    def test_rows_have_one_line_a_kind(self):
        self.write("gap.csv", gap_of())
        rows = [f"{i},gap.csv,210000,0.28,{30 if i > 4 else 0.3},1e5,0.001,0,0"
                for i in range(1, 41)]
        self.write("cases.csv", "\n".join([BATCH_COLUMNS, *rows]) + "\n")
        done = self.succeed("batch", "cases.csv", "-o", "out.csv")
        self.assertEqual(done.stderr, "faststrip: mu should be at most 1.00000, got 30.0000:"
                                      " percent? (cases.csv:6, the first of 36)\n")

    def test_pressure_that_no_steel_carries(self):
        self.write("gap.csv", gap_of())
        for load, is_named in (("1e5", False), ("8e7", True)):
            self.write("case.nml", gap_case(load=load))
            done = self.run_program("contact", "case.nml")
            self.assertEqual("pmax_MPa should be at most 4200.00" in done.stderr, is_named,
                             done.stderr)
            self.assertEqual("# pmax_MPa should be" in done.stdout, is_named)

    def test_no_figure_changes(self):
        self.write("gap.csv", gap_of())
        self.write("case.nml", gap_case(motion="cksi = 1e-3"))
        usual = self.run_program("contact", "case.nml").stdout
        self.write("case.nml", gap_case(motion="cksi = 1e-3",
                                        extra="&numerics yield_MPa = 1e5 /\n"))
        doubtful = self.run_program("contact", "case.nml").stdout

        def cells(text):
            row = [line for line in text.splitlines() if not line.startswith("#")][1].split(",")
            return row[:22] + row[24:]  # without times

        self.assertEqual(cells(usual), cells(doubtful))


class TestUnusual(ProgramTest):

    def test_unusual_contacts_are_not_mentioned(self):
        rows = [BATCH_COLUMNS]
        for i, case in enumerate(UNUSUAL):
            _, _, load, e, nu, mu, creepage, _, _ = case
            self.write(f"gap{i}.csv", self.gap(case))
            rows.append(",".join(map(str, (i, f"gap{i}.csv", e, nu, mu, load, *creepage))))
        self.assertGreaterEqual(len(UNUSUAL), 30)
        self.write("cases.csv", "\n".join(rows) + "\n")
        done = self.succeed("batch", "cases.csv", "-o", "out.csv")
        self.assertNotIn("should", done.stderr)

    @staticmethod
    def gap(case):
        name, radius, _, _, _, _, _, lateral, half_width = case

        def height(y):
            return y * y / (2.0 * lateral)

        text = gap_text(height, half_width=half_width, inv2r=0.5 / radius)
        if name not in FLANGES:
            return text
        # Under a contact angle the longitudinal curvature changes from point to point.
        lines = text.splitlines()
        turned = [lines[0]]
        for line in lines[1:]:
            y, h, a = map(float, line.split(","))
            turned.append(f"{y!r},{h!r},{a * (1.0 - 0.02 * y)!r}")
        return "\n".join(turned) + "\n"

    def test_unusual_case_files_are_not_mentioned(self):
        for groups in (
            {"wheel": "profile = 's1002', radius_mm = 330"},
            {"rail": "profile = 'uic60', cant = 0.05"},
            {"rail": "profile = 'uic60', cant = 0.0"},
            {"contact": "load_N = 1e3"},
            {"contact": "load_N = 2e5, shift_mm = -2"},
            {"contact": "penetration_mm = 0.01"},
            {"material": "mu = 0.05"},
            {"rail": "profile = 'uic60', rail_distance_mm = 1592"},
        ):
            with self.subTest(groups):
                self.write("case.nml", profile_case(**groups))
                done = self.succeed("contact", "case.nml")
                self.assertNotIn("should", done.stderr)
