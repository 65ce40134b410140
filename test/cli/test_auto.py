"""`--normal auto`: it keeps its word, tells its steps, computes what is asked and nothing else."""

import math
import re

from cli_program import ROOT, ProgramTest, gap_case, gap_text, rows_of

CASES = ROOT / "example" / "cases"
STEP = re.compile(r"(hertz|strip|norm) (\d+)(?: \+ ([a-z-]+)(?: (\d+))?)?: ([\d.e-]+) in (\d+) us")


def steps_of(row):
    """The steps that a row tells: normal method, how many, tangential, points, estimate, us."""
    found = [STEP.fullmatch(text) for text in row["choice"].split("; ")]
    if None in found:
        raise AssertionError(row["choice"])
    return [(step[1], int(step[2]), step[3], step[4], float(step[5]), int(step[6]))
            for step in found]


class Auto(ProgramTest):
    def auto(self, case, *words):
        """The row of a case, which met its tolerance."""
        return self.good("contact", case, "--normal", "auto", *words)[0]

    def missed(self, case, *words):
        """The row of a case, which did not."""
        done = self.succeed("contact", case, "--normal", "auto", *words)
        row = rows_of(done.stdout)[0]
        self.assertEqual(row["status"], "target_missed")
        self.assertRegex(done.stderr, r"^faststrip: the estimated error of the target, ")
        return row

    def smooth_case(self, motion="cksi = 4e-4, ceta = -2e-4, cphi_rad_per_mm = 1e-4", extra=""):
        """A contact with unlike sides, without kinks, and no ellipse."""
        self.write("gap.csv", gap_text(lambda y: 1e-3 * y * y + 4e-5 * y**3 + 3e-5 * y**4))
        self.write("case.nml", gap_case(motion=motion, extra=extra))
        return "case.nml"

    def test_figures_are_within_the_tolerance(self):
        for example in ("freight_25t", "tread_straight", "near_conformal", "worn_wheel"):
            case = CASES / f"{example}.nml"
            fine = self.solved("contact", case, "--normal", "norm", "--tangential", "tang",
                               "--element-dx", "0.25", "--element-dy", "0.25")
            self.assertEqual(fine["choice"], "")
            bound = float(fine["mu"]) if "mu" in fine else 0.3
            bound *= float(fine["N_N"])
            arm = math.sqrt(float(fine["area_mm2"]) / math.pi)
            chosen = self.auto(case, "--tolerance", "0.08")
            for name, unit in (("Fx_N", bound), ("Fy_N", bound), ("Mz_Nmm", bound * arm)):
                self.assertLess(abs(float(chosen[name]) - float(fine[name])), 0.08 * unit,
                                (example, name))
            for target, name in (("pmax", "pmax_MPa"), ("penetration", "penetration_mm"),
                                 ("area", "area_mm2"), ("power", "friction_power_N")):
                chosen = self.auto(case, "--target", target, "--tolerance", "0.1")
                self.assert_close(float(chosen[name]), float(fine[name]), relative=0.12,
                                  what=(example, target))

    def test_smaller_tolerances_take_more_strips(self):
        case, strips = self.smooth_case(), []
        for tolerance in ("0.1", "0.01", "0.004", "0.002"):
            row = self.auto(case, "--target", "pmax", "--tolerance", tolerance, "--strips",
                            "strips.csv")
            strips.append(len(self.read("strips.csv")))
            if steps_of(row)[-1][0] == "strip":
                self.assertEqual(steps_of(row)[-1][1], strips[-1])
        self.assertEqual(strips, sorted(set(strips)))

    def test_times_count_every_step(self):
        row = self.auto(self.smooth_case(), "--target", "pmax", "--tolerance", "0.002")
        steps = steps_of(row)
        self.assertGreater(len(steps), 1)
        told = sum(step[5] for step in steps)
        self.assertGreater(float(row["normal_us"]) + float(row["tangential_us"]),
                           told - len(steps))

    def test_forces_are_by_the_tangential_method_where_the_target_needs_none(self):
        case = self.smooth_case()
        words = ("--target", "penetration", "--tolerance", "0.003")
        row = self.auto(case, *words, "--tangential", "none")
        self.assertEqual((row["Fx_N"], row["friction_power_N"], row["stick_fraction"]),
                         ("", "", ""))
        self.assertRegex(row["choice"], r"strip \d+: \S+ in \d+ us$")
        for method in ("faststrip", "fastsim", "tang"):
            row = self.auto(case, *words, "--tangential", method, "--element-dx", "0.4",
                            "--element-dy", "0.4")
            strips = steps_of(row)[-1][1]
            plain = self.solved("contact", case, "--strips-per-patch", strips, "--tangential",
                                method, "--element-dx", "0.4", "--element-dy", "0.4")
            for name in ("Fx_N", "Fy_N", "Mz_Nmm", "stick_fraction"):
                self.assert_close(float(row[name]), float(plain[name]), relative=1e-3, what=name)

    def test_strips_and_fields_beside_change_nothing(self):
        case = self.smooth_case()
        for target in ("forces", "pmax"):
            words = ("--target", target, "--tolerance", "0.02")
            plain = self.auto(case, *words)
            row = self.auto(case, *words, "--strips", "strips.csv", "--fields", "field.csv")
            for name in ("pmax_MPa", "Fx_N", "Fy_N", "Mz_Nmm", "stick_fraction"):
                self.assertEqual(row[name], plain[name], (target, name))
            forces = [float(strip["Fx_N"]) for strip in self.read("strips.csv")]
            self.assert_close(sum(forces), float(row["Fx_N"]), 1e-9, what=target)
            field = self.read("field.csv")
            load = sum(float(element["pn_MPa"]) * float(element["area_mm2"]) for element in field)
            self.assert_close(load, 1e5, 0.01, what=target)

    def test_dissimilar_materials_get_the_best_there_is(self):
        row = self.auto(CASES / "polymer_roller.nml", "--tolerance", "0.02")
        self.assertEqual(steps_of(row)[-1][0], "norm", row["choice"])
        self.assertLess(float(row["Fx_N"]), 0.0)
        # The pressures are no matter of that.
        row = self.auto(CASES / "polymer_roller.nml", "--target", "pmax", "--tolerance", "0.002")
        self.assertGreater(float(row["pmax_MPa"]), 0.0)

    def test_kalkers_methods_follow_where_strips_cannot_do(self):
        case = self.smooth_case()
        row = self.auto(case, "--target", "pmax", "--tolerance", "0.0002")
        self.assertEqual(steps_of(row)[-1][0], "norm")
        self.assertLess(float(row["est_err_pmax"]), 0.0002)
        fine = self.good("contact", case, "--normal", "norm", "--error-target", "2e-4")[0]
        self.assert_close(float(row["pmax_MPa"]), float(fine["pmax_MPa"]), 4e-4, what="pmax")
        # The forces are FASTSTRIP's on NORM's rows, as `--normal norm` has them.
        self.assert_close(float(row["Fx_N"]), float(fine["Fx_N"]), 0.01, what="Fx")

    def test_kalkers_grid_is_as_it_is_told(self):
        """So many elements along and across the patch of the strips before."""
        case = self.smooth_case()
        for tolerance in ("4e-4", "1e-4"):
            row = self.auto(case, "--target", "penetration", "--tolerance", tolerance)
            steps = steps_of(row)
            self.assertEqual(steps[-1][0], "norm", row["choice"])
            strips = [step[1] for step in steps if step[0] == "strip"][-1]
            patch = self.solved("contact", case, "--strips-per-patch", strips)
            sides = [2.0 * float(patch["xmax_mm"]) / steps[-1][1],
                     (float(patch["ymax_mm"]) - float(patch["ymin_mm"])) / steps[-1][1]]
            self.assertGreater(abs(math.log(sides[0] / sides[1])), 0.2)
            plain = self.solved("contact", case, "--normal", "norm", "--element-dx", sides[0],
                                "--element-dy", sides[1])
            for name, relative in (("penetration_mm", 1e-5), ("pmax_MPa", 1e-5),
                                   # Sides differ in the last digits: an element more or less.
                                   ("area_mm2", 1e-3), ("est_err_penetration", 0.05)):
                self.assert_close(float(row[name]), float(plain[name]), relative, what=name)

    def test_forces_that_no_strips_can_meet_are_tangs(self):
        case = self.smooth_case()
        row = self.auto(case, "--tolerance", "0.002")
        self.assertEqual(steps_of(row)[-1][2], "tang", row["choice"])
        fine = self.solved("contact", case, "--normal", "norm", "--tangential", "tang",
                           "--element-dx", "0.15", "--element-dy", "0.15")
        bound = 0.3 * 1e5
        for name, unit in (("Fx_N", bound), ("Fy_N", bound),
                           ("Mz_Nmm", bound * math.sqrt(float(fine["area_mm2"]) / math.pi))):
            self.assertLess(abs(float(row[name]) - float(fine[name])), 0.002 * unit, name)

    def test_a_grid_that_may_not_be_larger_is_not(self):
        row = self.missed(self.smooth_case(), "--target", "pmax", "--tolerance", "1e-5",
                          "--max-elements", "900")
        for step in steps_of(row):
            if step[0] == "norm":
                self.assertLessEqual(step[1], 30, row["choice"])
        self.assertIn("norm", row["choice"])

    def test_what_no_grid_meets_is_told_soon(self):
        row = self.missed(self.smooth_case(), "--tolerance", "1e-9")
        across = [step[1] for step in steps_of(row) if step[0] == "norm"]
        self.assertEqual(across, [30], row["choice"])
        # What the estimate leaves within reach is tried.
        row = self.auto(self.smooth_case(), "--tolerance", "1e-3")
        self.assertGreater(steps_of(row)[-1][1], 30, row["choice"])

    def test_a_budget_is_another_way_to_ask(self):
        case = self.smooth_case()
        done = self.run_program("contact", case, "--normal", "auto", "--budget-us", "1",
                                "--force-limit", "0.01")
        row = rows_of(done.stdout)[0]
        self.assertEqual((done.returncode, row["status"]), (0, "under_resolved"))
        self.assertEqual(len(steps_of(row)), 1)
        row = self.auto(case, "--budget-us", "1", "--force-limit", "1")
        self.assertEqual(row["status"], "ok")
        # Of bytes, which time decides, the result claims nothing.
        self.assertIn("# within a budget of time, which another run may spend otherwise: its bytes "
                      "may differ\n", done.stdout)
        self.assertNotIn("budget", self.run_program("contact", case, "--normal", "auto").stdout)
        # How good it gets is a matter of the machine.
        first = self.auto(case, "--budget-us", "1", "--target", "pmax", "--resolution-limit", "1")
        best = self.auto(case, "--budget-us", "1e6", "--target", "pmax")
        self.assertLess(float(best["est_err_pmax"]), 0.5 * float(first["est_err_pmax"]))
        self.assertGreater(len(steps_of(best)), len(steps_of(first)))
        both = self.auto(case, "--budget-us", "1e5", "--target", "pmax", "--tolerance", "0.5")
        self.assertEqual(steps_of(both)[-1][:2], ("strip", 7))
        self.missed(case, "--budget-us", "1", "--tolerance", "0.001")
        # The default tolerance is none that was given.
        self.write("case.nml", (self.folder / "case.nml").read_text(encoding="utf-8")
                   + "&numerics\n normal = 'auto'\n budget_us = 1.0\n force_limit = 1.0\n/\n")
        self.assertEqual(self.good("contact", "case.nml")[0]["status"], "ok")
        self.refused(2, "contact", case, "--budget-us", "0", says=("budget", "0"))

    def test_case_file_and_refusals(self):
        numerics = "&numerics\n normal = 'auto'\n tolerance = 0.006\n target = 'pmax'\n/\n"
        case = self.smooth_case(extra=numerics)
        row = self.good("contact", case)[0]
        self.assertLess(float(row["est_err_pmax"]), 0.006)
        self.assertGreater(len(steps_of(row)), 1)
        self.write("case.nml", gap_case(extra=numerics.replace("pmax", "wear")))
        self.refused(1, "contact", "case.nml", says=("area", "wear"))
        none = (CASES / "freight_25t.nml", "--tangential", "none")
        self.refused(1, "contact", *none, "--normal", "auto", "--target", "forces",
                     says=("forces", "none"))
        self.write("case.nml", gap_case(extra="&numerics\n normal = 'auto'\n target = 'forces'\n"
                                              " tangential = 'none'\n/\n"))
        self.refused(1, "contact", "case.nml", says=("forces", "none"))
        # Nobody asked for forces.
        row = self.auto(*none)
        figures = [name for name in row if not name.endswith("_us") and name != "choice"]
        pmax = self.auto(*none, "--target", "pmax")
        self.assertEqual([row[name] for name in figures], [pmax[name] for name in figures])
        self.assertLess(float(row["est_err_pmax"]), 0.02)
        self.assertEqual(row["Fx_N"], "")
        self.assertIn("faststrip", self.auto(none[0])["choice"].split(";")[0])

    def test_contacts_of_a_batch_do_not_know_of_each_other(self):
        self.write("gap.csv", gap_text(lambda y: 2e-3 * y * y))
        self.write("steep.csv", gap_text(lambda y: 4e-3 * abs(y) ** 1.7))
        head = "case,gap_file,E_MPa,nu,mu,N_N,cksi,ceta,cphi_rad_per_mm\n"
        rows = ["a,gap.csv,210000,0.28,0.3,1e5,5e-4,0,1e-4\n",
                "b,steep.csv,210000,0.28,0.3,5e4,5e-4,0,1e-4\n"]
        words = ("--normal", "auto", "--target", "pmax", "--tolerance", "0.004")
        self.write("both.csv", head + "".join(rows) + rows[0])
        together = self.good("batch", "both.csv", *words)
        self.write("one.csv", head + rows[1])
        alone = self.good("batch", "one.csv", *words)
        for first, second in ((together[0], together[2]), (together[1], alone[0])):
            for name in ("pmax_MPa", "Fx_N", "Mz_Nmm", "est_err_pmax"):
                self.assertEqual(first[name], second[name], name)
