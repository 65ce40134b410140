"""`--normal auto`: the choice is told, keeps its promise on examples, computes what is asked."""

import math

from cli_program import ROOT, ProgramTest, gap_case, gap_text, rows_of

CASES = ROOT / "example" / "cases"


class Auto(ProgramTest):
    def contact(self, example, *words):
        return self.solved("contact", CASES / f"{example}.nml", *words)

    def test_forces_within_the_tolerance(self):
        for example in ("freight_25t", "tread_straight", "near_conformal", "worn_wheel"):
            fine = self.contact(example, "--normal", "norm", "--tangential", "tang",
                                "--element-dx", "0.3", "--element-dy", "0.3")
            chosen = self.contact(example, "--normal", "auto", "--tolerance", "0.05")
            error = math.hypot(*(float(chosen[name]) - float(fine[name])
                                 for name in ("Fx_N", "Fy_N")))
            self.assertLess(error, 0.05 * 0.3 * float(fine["N_N"]), example)
            self.assertIn("expected within", chosen["choice"])
            self.assertEqual(fine["choice"], "")

    def test_a_smaller_tolerance_takes_more(self):
        coarse = self.contact("tread_straight", "--normal", "auto", "--tolerance", "0.1")
        fine = self.contact("tread_straight", "--normal", "auto", "--tolerance", "0.001")
        self.assertIn("norm + tang: nothing cheaper is expected to be within 0.100 %",
                      fine["choice"])
        self.assertRegex(coarse["choice"], r"^(hertz|strip)")

    def test_only_what_the_target_needs(self):
        for target in ("pmax", "penetration"):
            row = self.contact("freight_25t", "--normal", "auto", "--target", target,
                               "--tolerance", "0.03")
            self.assertEqual((row["Fx_N"], row["friction_power_N"], row["stick_fraction"]),
                             ("", "", ""))
            self.assertGreater(float(row[f"{target}_{'MPa' if target == 'pmax' else 'mm'}"]), 0.0)
        row = self.contact("freight_25t", "--tangential", "none")
        self.assertEqual(row["Fx_N"], "")

    def test_strips_beside_change_no_forces(self):
        for tolerance in ("0.001", "0.3"):
            words = ("--normal", "auto", "--tolerance", tolerance)
            plain = self.contact("tread_straight", *words)
            row = self.contact("tread_straight", *words, "--strips", "strips.csv")
            for name in ("Fx_N", "Fy_N", "Mz_Nmm", "stick_fraction"):
                self.assertEqual(row[name], plain[name], (tolerance, name))

    def test_unlike_materials_get_the_best_there_is(self):
        done = self.run_program("contact", CASES / "polymer_roller.nml", "--normal", "auto",
                                "--tolerance", "0.0001")
        self.assertEqual(done.returncode, 0, done.stderr)
        row = rows_of(done.stdout)[0]
        self.assertEqual(row["status"], "target_missed")
        self.assertIn("the best there is for unlike materials", row["choice"])
        self.assertLess(float(row["Fx_N"]), 0.0)

    def test_fields_need_elements(self):
        self.contact("tram_small_wheel", "--normal", "auto", "--tolerance", "0.3", "--fields",
                     "field.csv")
        self.assertGreater(len(self.read("field.csv")), 20)

    def test_case_file_and_refusals(self):
        case = (CASES / "freight_25t.nml").read_text(encoding="utf-8")
        numerics = "&numerics\n normal = 'auto'\n tolerance = 0.04\n target = 'pmax'\n/\n"
        self.write("case.nml", case + numerics)
        row = self.good("contact", "case.nml")[0]
        self.assertIn("expected within", row["choice"])
        self.write("case.nml", case + numerics.replace("pmax", "wear"))
        self.refused(1, "contact", "case.nml", says=("target", "wear"))
        self.refused(2, "contact", CASES / "freight_25t.nml", "--tolerance", "-1",
                     says=("tolerance", "-1"))

    def test_kalkers_grid_is_thirty_elements_across_either_way(self):
        """What auto leaves to Kalker's methods is what they give on that grid."""
        self.write("gap.csv", gap_text(lambda y: 6e-3 * y * y))
        self.write("case.nml", gap_case(motion="cksi = 4e-4"))
        ellipse = self.good("contact", "case.nml", "--normal", "hertz", "--tangential", "none")[0]
        a = float(ellipse["xmax_mm"])
        b = 0.5 * (float(ellipse["ymax_mm"]) - float(ellipse["ymin_mm"]))
        self.assertGreater(a / b, 2.0)
        chosen = self.good("contact", "case.nml", "--normal", "auto", "--tolerance", "1e-5")[0]
        self.assertIn("norm + tang", chosen["choice"])
        row = self.good("contact", "case.nml", "--normal", "norm", "--tangential", "tang",
                        "--element-dx", a / 15.0, "--element-dy", b / 15.0)[0]
        for name in ("penetration_mm", "area_mm2", "pmax_MPa", "Fx_N", "stick_fraction"):
            self.assert_close(float(chosen[name]), float(row[name]), relative=1e-6, what=name)

    def test_the_error_target_of_norm_is_the_tolerance(self):
        self.write("gap.csv", gap_text(lambda y: 2e-3 * y * y))
        self.write("case.nml", gap_case())
        words = ("contact", "case.nml", "--normal", "auto", "--target", "penetration")
        chosen = self.good(*words, "--tolerance", "2e-4")[0]
        self.assertIn("norm", chosen["choice"])
        norm = ("contact", "case.nml", "--normal", "norm", "--tangential", "none")
        self.assertEqual(chosen["penetration_mm"],
                         self.good(*norm, "--error-target", "2e-4")[0]["penetration_mm"])
        self.assertNotEqual(chosen["penetration_mm"],
                            self.good(*norm, "--error-target", "2e-2")[0]["penetration_mm"])
        self.assertLess(float(chosen["est_err_penetration"]), 2e-4)

    def test_smaller_tolerances_of_the_pressure_take_more_strips(self):
        self.write("gap.csv", gap_text(lambda y: 2e-3 * y * y + 5e-5 * y**3))
        self.write("case.nml", gap_case())
        strips = []
        for tolerance in ("0.1", "0.0055", "0.0045", "0.0029"):
            row = self.good("contact", "case.nml", "--normal", "auto", "--target", "pmax",
                            "--tolerance", tolerance, "--strips", "strips.csv")[0]
            strips.append(len(self.read("strips.csv")))
            self.assertTrue(row["choice"].startswith(f"strip {strips[-1]}:"), row["choice"])
        self.assertEqual(strips, sorted(set(strips)))

    def test_a_law_gives_way_where_elements_are_wanted_and_nothing_else_does(self):
        self.write("gap.csv", gap_text(lambda y: 2e-3 * y * y))
        for spin, wide, without, with_field in (("1e-6", "0.1", "(linear|she|polach)", "fastsim"),
                                                ("6e-4", "0.05", "faststrip", "faststrip")):
            self.write("case.nml", gap_case(motion=f"cksi = 1e-5, cphi_rad_per_mm = {spin}"))
            words = ("contact", "case.nml", "--normal", "auto", "--tolerance", wide)
            self.assertRegex(self.good(*words)[0]["choice"], rf" \+ {without}")
            row = self.good(*words, "--fields", "field.csv")[0]
            self.assertIn(f" + {with_field} ", row["choice"])
            self.assertGreater(len(self.read("field.csv")), 20)
