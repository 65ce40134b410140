"""Forces given in place of creepages: `&motion Fx_N, Fy_N`, `given_Fx_N, given_Fy_N` of a batch."""

from cli_program import (
    BATCH_COLUMNS,
    ProgramTest,
    gap_case,
    gap_text,
    parabola,
    profile_case,
    rows_of,
)

SPIN = "cphi_rad_per_mm = 2.0e-4"
# TANG is the slowest: large elements will do.
COARSE = ("--element-dx", "0.8", "--element-dy", "0.8")


class GivenForces(ProgramTest):

    def setUp(self):
        super().setUp()
        self.write("gap.csv", gap_text(parabola))

    def row(self, motion, *options):
        self.write("case.nml", gap_case(motion=motion))
        return rows_of(self.run_program("contact", "case.nml", *options).stdout)[0]

    def refused_motion(self, motion, words, *options):
        self.write("case.nml", gap_case(motion=motion))
        self.refused(1, "contact", "case.nml", *options, says=[words])

    def near(self, one, other, share, *names):
        for name in names:
            self.assertAlmostEqual(float(one[name]) / float(other[name]), 1.0, delta=share,
                                   msg=name)

    def test_forces_give_their_creepages_back(self):
        motion = f"cksi = -8.0e-4\n  ceta = 3.0e-4\n  {SPIN}"
        for method in ("faststrip", "fastsim", "faststrip-corrected", "polach", "tang"):
            options = ("--tangential", method, *COARSE)
            there = self.row(motion, *options)
            forces = f"Fx_N = {there['Fx_N']}\n  Fy_N = {there['Fy_N']}\n  {SPIN}"
            back = self.row(forces, *options)
            self.near(back, there, 2e-4, "cksi", "ceta", "cphi_rad_per_mm", "friction_power_N")
            self.assertEqual(back["status"], there["status"])
            # One force and the other creepage.
            back = self.row(f"Fx_N = {there['Fx_N']}\n  ceta = 3.0e-4\n  {SPIN}", *options)
            self.near(back, there, 2e-4, "cksi", "ceta", "Fy_N")

    def test_estimates_are_of_what_was_found(self):
        row = self.row(f"Fx_N = 1.0e4\n  {SPIN}")
        self.assertGreater(float(row["est_err_cksi"]), 0.0)
        self.assertEqual(float(row["est_err_ceta"]), 0.0)

    def test_auto_finds_them_too(self):
        row = self.row(f"Fx_N = 1.0e4\n  Fy_N = -5.0e3\n  {SPIN}", "--normal", "auto")
        self.near(row, {"Fx_N": 1.0e4, "Fy_N": -5.0e3}, 1e-4, "Fx_N", "Fy_N")
        self.assertEqual(row["status"], "ok")

    def test_what_cannot_be_is_refused(self):
        self.refused_motion("Fx_N = 2.9e4\n  Fy_N = 1.0e4",
                            "a given force must not be above mu N, 30000.0 N, got 30675.7 N")
        self.refused_motion("Fx_N = 1.0e4\n  cksi = 0.0",
                            "&motion Fx_N must not be given with cksi")
        self.refused_motion("Fy_N = 1.0e4\n  ceta = 0.001",
                            "&motion Fy_N must not be given with ceta")
        self.refused_motion("Fx_N = NaN", "&motion Fx_N")
        self.refused_motion("Fx_N = 1.0e4", "none gives none", "--tangential", "none")
        self.refused_motion("Fx_N = 2.95e4\n  speed_mm_s = 1.0e4\n/\n&friction\n"
                            "  kind = 'exponential'\n  mu_kinetic = 0.1\n"
                            "  half_slip_speed_mm_s = 100.0",
                            "N at most here, got a given one of 29500.0 N")

    def test_more_slip_carries_the_same_force(self):
        row = self.row("Fx_N = 1.5e4\n  speed_mm_s = 1.0e4\n/\n&friction\n"
                       "  kind = 'exponential'\n  mu_kinetic = 0.1\n"
                       "  half_slip_speed_mm_s = 100.0")
        self.assertIn("not_unique", row["limitations"].split())
        self.assertLess(abs(float(row["cksi"])), 3e-3)

    def test_the_formula_leaves_the_creepage_that_is_found(self):
        self.write("case.nml", profile_case(motion="creepage = 'formula'\n  Fx_N = 5.0e3"))
        found = rows_of(self.run_program("contact", "case.nml", "--shift", "3").stdout)[0]
        self.write("case.nml", profile_case(motion="creepage = 'formula'"))
        rolling = rows_of(self.run_program("contact", "case.nml", "--shift", "3").stdout)[0]
        self.near(found, {"Fx_N": 5.0e3}, 1e-4, "Fx_N")
        for name in ("ceta", "cphi_rad_per_mm"):
            self.assertEqual(found[name], rolling[name])
        self.assertNotEqual(found["cksi"], rolling["cksi"])

    def test_rows_of_a_batch_fill_their_creepages_in(self):
        self.write("in.csv", f"{BATCH_COLUMNS},given_Fx_N,given_Fy_N\n"
                   "a,gap.csv,209920,0.28,0.3,1e5,,,2e-4,10000,-5000\n"
                   "b,gap.csv,209920,0.28,0.3,1e5,,3e-4,2e-4,11000,\n"
                   "c,gap.csv,209920,0.28,0.3,1e5,1e-3,3e-4,2e-4,,\n"
                   "d,gap.csv,209920,0.28,0.3,1e5,1e-3,,2e-4,1000,\n"
                   "e,gap.csv,209920,0.28,0.3,1e5,,,2e-4,40000,0\n")
        run = self.run_program("batch", "in.csv")
        rows = rows_of(run.stdout)
        self.assertEqual([row["status"] for row in rows],
                         ["ok", "ok", "ok", "bad_argument", "beyond_adhesion"])
        self.near(rows[0], {"Fx_N": 1.0e4, "Fy_N": -5.0e3}, 1e-4, "Fx_N", "Fy_N")
        self.near(rows[1], {"Fx_N": 1.1e4, "ceta": 3.0e-4}, 1e-4, "Fx_N", "ceta")
        self.assertLess(float(rows[0]["cksi"]), 0.0)
        self.assertEqual(rows[4]["cksi"], "")
        self.assertIn("cksi must be empty with given_Fx_N, got 1e-3", run.stderr)
        # Alone, from nothing, the same within the search's tolerance.
        alone = self.row(f"Fx_N = 1.1e4\n  ceta = 3.0e-4\n  {SPIN}")
        self.near(rows[1], alone, 1e-3, "cksi")
