"""T gamma, wear and fatigue: the columns, the strips, and what is refused."""

import math

from cli_program import ProgramTest, gap_case, gap_text, numbers, parabola, profile_case

NOTES = "# source: a book, page 3\n# body: {body}\n# density_kg_per_m3: 8000\n"
NAMES = "from_N_per_mm2,to_N_per_mm2,constant_ug_per_m_mm2,slope_ug_per_m_N\n"
MOTION = "cksi = 0.004, ceta = -0.001, cphi_rad_per_mm = 2e-4"
BATCH = "case,gap_file,E_MPa,nu,mu,N_N,cksi,ceta,cphi_rad_per_mm\n"


def law(rows="0,1000,0,4\n", body="wheel"):
    return NOTES.format(body=body) + NAMES + rows


class Wear(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("gap.csv", gap_text(parabola))
        self.write("case.nml", gap_case(motion=MOTION))
        self.write("law.csv", law())

    def test_without_forces_there_is_no_t_gamma(self):
        row = self.good("contact", "case.nml", "--tangential", "none", "--yield-shear-MPa",
                        "300")[0]
        for name in ("t_gamma_N", "t_gamma_spin_N", "t_gamma_per_area_N_per_mm2", "fatigue_index"):
            self.assertEqual(row[name], "", name)
        # Without a law and a yield stress in shear neither wear nor fatigue is known.
        row = self.good("contact", "case.nml", "--tangential", "linear")[0]
        self.assertNotEqual(row["t_gamma_N"], "")
        for name in ("fatigue_index", "wear_ug_per_m", "wear_mm3_per_m"):
            self.assertEqual(row[name], "", name)

    def test_strips_add_up_to_the_contact(self):
        row = self.good("contact", "case.nml", "--wear", "law.csv", "--strips", "s.csv")[0]
        strips = self.read("s.csv")
        mass = numbers(strips, "wear_ug_per_m")
        self.assert_close(float(row["wear_ug_per_m"]), 4.0 * float(row["friction_power_N"]), 1e-9)
        self.assert_close(float(row["wear_ug_per_m"]), math.fsum(mass), 1e-12)
        self.assert_close(float(row["wear_mm3_per_m"]), math.fsum(mass) / 8000.0, 1e-12)
        for strip, lost in zip(strips, mass):
            left, right, half, power, density, depth = (
                float(strip[name]) for name in (
                    "y_left_mm", "y_right_mm", "half_length_mm", "friction_power_N",
                    "t_gamma_per_area_N_per_mm2", "wear_depth_mm_per_pass"))
            self.assert_close(density, power / (2.0 * half * (right - left)), 1e-9)
            self.assert_close(lost, 4.0 * power, 1e-9)
            # 1 ug over 8000 kg/m3 is 1/8000 mm3 in each metre rolled.
            self.assert_close(depth, lost / 8000.0 / 1000.0 / (right - left), 1e-9)
            # A gap does not tell the wheel's radius.
            self.assertEqual(strip["wear_depth_mm_per_km"], "")
        head = (self.folder / "s.csv").read_text(encoding="utf-8")
        self.assertIn("# wear of the wheel by law.csv\n# its source: a book, page 3\n", head)

    def test_depth_of_a_wheel_per_kilometre(self):
        self.write("p.nml", profile_case(contact="load_N = 1e5, shift_mm = 3", motion=MOTION))
        turns = 1e6 / (2.0 * math.pi * 460.0)
        self.solved("contact", "p.nml", "--wear", "law.csv", "--strips", "s.csv")
        for strip in self.read("s.csv"):
            depth = float(strip["wear_depth_mm_per_pass"])
            # The rolling radius is a little larger than that of the nominal rolling circle.
            self.assert_close(float(strip["wear_depth_mm_per_km"]), turns * depth, 2e-3)
            self.assertLess(float(strip["wear_depth_mm_per_km"]), turns * depth)
        self.write("rail.csv", law(body="rail"))
        self.solved("contact", "p.nml", "--wear", "rail.csv", "--strips", "s.csv")
        strips = self.read("s.csv")
        self.assertEqual({strip["wear_depth_mm_per_km"] for strip in strips}, {""})
        self.assertGreater(min(numbers(strips, "wear_depth_mm_per_pass")), 0.0)

    def test_methods_without_sums_of_strips_have_no_wear(self):
        row = self.good("contact", "case.nml", "--wear", "law.csv", "--tangential", "fastsim",
                        "--strips", "s.csv")[0]
        self.assertEqual(row["wear_ug_per_m"], "")
        for strip in self.read("s.csv"):
            for name in ("t_gamma_per_area_N_per_mm2", "wear_ug_per_m", "wear_depth_mm_per_pass"):
                self.assertEqual(strip[name], "", name)

    def test_batch_and_sweep_and_auto(self):
        row = self.good("contact", "case.nml", "--wear", "law.csv")[0]
        self.write("b.csv", BATCH + "one,gap.csv,210000,0.28,0.3,1e5,0.004,-0.001,2e-4\n")
        several = self.good("batch", "b.csv", "--wear", "law.csv")
        self.assertEqual(len(several), 1)
        self.assert_close(float(several[0]["wear_ug_per_m"]),
                          4.0 * float(several[0]["friction_power_N"]), 1e-9)
        auto = self.good("contact", "case.nml", "--wear", "law.csv", "--normal", "auto")[0]
        self.assert_close(float(auto["wear_ug_per_m"]), float(row["wear_ug_per_m"]), 0.05)
        # A case names its file as it stands beside it.
        self.write("sub/law.csv", law())
        self.write("sub/s.nml", profile_case(
            motion=MOTION, extra="&numerics\n wear_file = 'law.csv'\n/\n"
                                 "&sweep\n shifts_mm = 0.0, 3.0\n/\n"))
        self.run_program("sweep", "sub/s.nml", "-o", "s.csv")
        rows = self.read("s.csv")
        self.assertEqual(len(rows), 6)
        for row in rows:
            if row["tangential"] == "faststrip":
                self.assert_close(float(row["wear_ug_per_m"]), 4 * float(row["friction_power_N"]),
                                  1e-9)
            elif row["tangential"] == "fastsim":
                self.assertEqual(row["wear_ug_per_m"], "")

    def test_a_law_that_ends_below(self):
        self.write("short.csv", law("0,0.001,0,4\n"))
        done = self.succeed("contact", "case.nml", "--wear", "short.csv", "--strips", "s.csv")
        self.assertRegex(done.stderr, r"\Afaststrip: no wear: the wear law ends at a T gamma/A of"
                                      r" 0\.10*E-2 N/mm2, got [^\n]+\n\Z")
        self.assertIn(",,\n", done.stdout)
        for strip in self.read("s.csv"):
            self.assertGreater(float(strip["t_gamma_per_area_N_per_mm2"]), 0.0)
            self.assertEqual(strip["wear_ug_per_m"], "")
        # The row is named, and one without a result is not named again.
        self.write("b.csv", BATCH + "one,gap.csv,210000,0.28,0.3,1e5,0.004,0,0\n"
                                    "two,gap.csv,210000,0.28,0.3,-1,0.004,0,0\n")
        done = self.run_program("batch", "b.csv", "--wear", "short.csv")
        self.assertEqual(done.stderr.count("no wear"), 1)
        self.assertIn("faststrip: row 1: no wear: ", done.stderr)

    def test_bad_laws_are_refused(self):
        for name, text in (("bad.csv", law("0,10,0,4\n11,20,1,0\n")),
                           ("no_source.csv", law().replace("# source", "# words")),
                           ("bad.nml", gap_case(extra="&numerics\n wear_file = 'none.csv'\n/\n")),
                           ("yield.nml", gap_case(extra="&numerics\n yield_shear_MPa = -1\n/\n"))):
            self.write(name, text)
        for code, says, words in (
                (1, ["11", "bad.csv:6"], ("contact", "case.nml", "--wear", "bad.csv")),
                (1, ["source"], ("batch", "b.csv", "--wear", "no_source.csv")),
                (1, ["missing.csv"], ("contact", "case.nml", "--wear", "missing.csv")),
                (1, ["none.csv"], ("contact", "bad.nml")),
                (1, ["yield_shear_MPa", "-1"], ("contact", "yield.nml")),
                (2, ["law.csv"], ("contact", "case.nml", "--wear", "law.csv", "-o", "law.csv"))):
            with self.subTest(words):
                self.refused(code, *words, says=says)
