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

    def test_each_strip_has_the_friction_of_its_place(self):
        half = "&friction\n  mu_y_mm = 0.0, 1.0e-6\n  mu_table = 0.1, 0.4\n/\n"
        for method in ("faststrip", "faststrip-plain", "fastsim", "tang"):
            row = self.forces(half, moving(0.2), method)
            self.assertAlmostEqual(-float(row["Fx_N"]) / 0.25e5, 1.0, delta=0.01, msg=method)
            # What slides right of the middle pulls to the left of it: about z from x to y.
            self.assertGreater(float(row["Mz_Nmm"]), 0.1e5, msg=method)
        # What has one coefficient takes the mean.
        mean = self.forces("", moving(0.2), "polach")
        row = self.forces(half, moving(0.2), "polach")
        self.assertAlmostEqual(float(row["Fx_N"]) / float(mean["Fx_N"]), 0.25 / 0.3, delta=1e-6)

    def test_a_table_of_a_row_is_that_of_a_case(self):
        table = "&friction\n  mu_y_mm = -1.0, 1.5\n  mu_table = 0.1, 0.4\n/\n"
        of_case = self.forces(table, moving(0.002))
        names = "case,gap_file,E_MPa,nu,mu,N_N,cksi,ceta,cphi_rad_per_mm,mu_y_mm,mu_table"
        row = "gap.csv,209920,0.28,0.3,1e5,0.002,0,0"
        self.write("rows.csv", f'{names}\na,{row},"-1.0, 1.5","0.1, 0.4"\n'
                   f'b,{row},"1, 0","1, 1"\n')
        done = self.run_program("batch", "rows.csv", "--normal", "hertz")
        rows = rows_of(done.stdout)
        self.assertEqual(rows[0]["Fx_N"], of_case["Fx_N"])
        self.assertEqual(rows[1]["status"], "bad_argument")
        self.assertIn("mu_y_mm must increase", done.stderr)

    def test_a_table_needs_no_coefficient_besides(self):
        table = "&friction\n  mu_y_mm = -1.0, 1.5\n  mu_table = 0.1, 0.4\n/\n"
        case = gap_case(motion=moving(0.002))
        bare = case.replace("mu = 0.3", "nu_rail = 0.28")
        self.assertNotEqual(bare, case)
        rows = [self.forces(table, case=one) for one in (case, bare)]
        for name in ("status", "Fx_N", "Fy_N", "Mz_Nmm"):
            self.assertEqual(rows[0][name], rows[1][name])
        self.write("bare.nml", bare)
        self.refused(1, "contact", "bare.nml",
                     says=["&material mu must be given, or &friction mu_table"])
        self.write("hot.nml", bare + table.replace("/", "  mu_hot = 0.1\n/"))
        self.refused(1, "contact", "hot.nml",
                     says=["&friction mu_hot must not be given without &material mu"])

    def test_what_is_no_table_is_refused(self):
        for table, words in (
                ("mu_table = 0.3", "&friction mu_y_mm must be given with mu_table"),
                ("mu_y_mm = 1.0", "&friction mu_table must be given with places of it"),
                ("mu_y_mm = 1.0\n  mu_table = 0.3, 0.2",
                 "&friction mu_y_mm must have as many numbers as mu_table, 2"),
                ("mu_y_mm = 1.0, 1.0\n  mu_table = 0.3, 0.2", "&friction mu_y_mm must increase"),
                ("mu_y_mm = 1.0, nan\n  mu_table = 0.3, 0.2",
                 "&friction mu_y_mm must be a finite number"),
                ("mu_y_mm = 1.0, 2.0\n  mu_table = 0.3, -0.2",
                 "&friction mu_table must be at most 16 finite numbers from 0 on"),
                ("mu_angle_rad = 0.1\n  mu_table = 0.3",
                 "&friction mu_angle_rad must not be given with a gap file")):
            self.refused_friction(f"&friction\n  {table}\n/\n", words)
        both = "&friction\n  mu_y_mm = 0.1\n  mu_angle_rad = 0.1\n  mu_table = 0.3\n/\n"
        self.write("both.nml", profile_case() + both)
        self.refused(1, "contact", "both.nml",
                     says=["&friction mu_y_mm must not be given with mu_angle_rad"])
        flange = ("&friction\n  mu_y_mm = 0.1\n  mu_table = 0.3\n  mu_flange = 0.1\n"
                  "  tread_angle_rad = 0.1\n  flange_angle_rad = 0.2\n/\n")
        self.write("flange.nml", profile_case() + flange)
        self.refused(1, "contact", "flange.nml",
                     says=["&friction mu_table must not be given with mu_flange"])
