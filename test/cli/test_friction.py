"""`&friction` of a case file: what falls, what is refused."""

from cli_program import ProgramTest, gap_case, gap_text, numbers, parabola, profile_case, rows_of

FALLING = """&friction
  kind = 'exponential'
  mu_kinetic = 0.1
  half_slip_speed_mm_s = 100.0
/
"""


def moving(cksi=0.05, speed="speed_mm_s = 1.0e4"):
    return f"cksi = {cksi!r}\n  {speed}"


SLIDING = moving()


class Friction(ProgramTest):

    def forces(self, friction="", motion=SLIDING, method="faststrip", case=None):
        self.write("gap.csv", gap_text(parabola))
        self.write("case.nml", (case or gap_case(motion=motion)) + friction)
        return rows_of(self.run_program("contact", "case.nml", "--normal", "hertz",
                                        "--tangential", method).stdout)[0]

    def refused_friction(self, friction, words, motion=SLIDING, method="faststrip"):
        self.write("gap.csv", gap_text(parabola))
        self.write("case.nml", gap_case(motion=motion) + friction)
        self.refused(1, "contact", "case.nml", "--tangential", method, says=[words])

    def test_what_slides_has_the_friction_of_its_slip(self):
        # 500 mm/s is five half-values.
        expected = (0.1 + 0.2 / 32.0) * 1.0e5
        for method in ("faststrip", "faststrip-plain", "fastsim", "fastsim-elliptic",
                       "fastsim-weighted", "tang"):
            row = self.forces(FALLING, method=method)
            self.assertAlmostEqual(-float(row["Fx_N"]) / expected, 1.0, delta=0.01, msg=method)
            # Nothing is estimated, and so nothing is called ok.
            self.assertEqual(row["status"], "under_resolved")
            self.assertEqual(row["est_err_Fx"], "")

    def test_constant_friction_is_what_it_was(self):
        without = self.forces()
        row = self.forces("&friction\n  kind = 'constant'\n  initial_slope_factor = 1.0\n/\n")
        for name in ("Fx_N", "Fy_N", "Mz_Nmm", "status", "est_err_Fx"):
            self.assertEqual(row[name], without[name])

    def test_a_factor_of_the_slope_takes_every_method(self):
        factor = "&friction\n  initial_slope_factor = 0.25\n/\n"
        for method in ("faststrip", "faststrip-paper", "fastsim", "linear", "she", "polach",
                       "tang"):
            row = self.forces(factor, moving(0.004), method)
            small = self.forces("", moving(0.001), method)
            self.assertAlmostEqual(float(row["Fx_N"]) / float(small["Fx_N"]), 1.0, places=8,
                                   msg=method)
            self.assertEqual(row["status"], small["status"])

    def test_other_methods_refuse_falling_friction_by_name(self):
        for method in ("faststrip-paper", "faststrip-corrected", "linear", "she", "polach"):
            self.refused_friction(FALLING, f"{method} takes no friction that falls with slip",
                                  method=method)

    def test_what_is_no_friction_is_refused(self):
        for old, new, words in (
                ("'exponential'", "'stribeck'", "&friction kind must be one of constant, linear"),
                ("0.1", "0.4", "&friction mu_kinetic must be at most &material mu"),
                ("0.1", "0.0", "&friction mu_kinetic must be above 0"),
                ("100.0", "-1.0", "&friction half_slip_speed_mm_s must be above 0"),
                ("'exponential'", "'constant'", "mu_kinetic must not be given with kind constant"),
                ("mu_kinetic = 0.1", "", "&friction mu_kinetic must be given"),
                ("mu_kinetic", "mu_dynamic", "unknown name: mu_dynamic"),
                ("/", "  initial_slope_factor = 1.5\n/", "initial_slope_factor must be at most 1"),
                ("/", "  mu_flange = 0.1\n/", "mu_flange must not be given with a gap file"),
                ("/", "  tread_angle_rad = 0.1\n/", "must not be given without mu_flange")):
            self.refused_friction(FALLING.replace(old, new), words)
        self.refused_friction(FALLING, "kind must be constant without &motion speed_mm_s",
                              motion=moving(speed=""))
        self.refused_friction(FALLING, "&motion speed_mm_s must be above 0",
                              motion=moving(speed="speed_mm_s = 0.0"))

    def test_the_flange_has_friction_of_its_own(self):
        flange = ("&friction\n  mu_flange = 0.15\n  tread_angle_rad = 0.0\n"
                  "  flange_angle_rad = {}\n/\n")
        case = profile_case(motion="cksi = 0.1\n  speed_mm_s = 1.0e4")
        whole = self.forces(case=case)
        gamma = abs(float(whole["gamma_rad"]))
        self.assertGreater(gamma, 0.0)
        for angle, share in ((gamma, 0.5), (2.0 * gamma, 0.75), (1.0e6 * gamma, 1.0)):
            row = self.forces(flange.format(repr(angle)), case=case)
            self.assertAlmostEqual(numbers([row], "Fx_N")[0] / numbers([whole], "Fx_N")[0], share,
                                   places=4)
