"""`faststrip contact`: what it writes belongs together and agrees with the analytic profiles."""

import math
import subprocess

from cli_program import (
    FIGURES,
    GAPS,
    PROGRAM,
    RESULT_COLUMNS,
    ProgramTest,
    gap_case,
    gap_text,
    numbers,
    parabola,
    profile_case,
    rows_of,
    without_doubts,
)


def bumpy(y):
    """Two hollows: the middle would be pulled if strips could pull."""
    return 3e-5 * (y * y - 25.0) ** 2


# Of the cases here: MPa, friction, N.
SHEAR, FRICTION, LOAD = 82000.0, 0.3, 1.0e5


def fastsim_force(a, b, c, creepage, elliptic=False, weighted=False, n=120):
    """Kalker (1982): flexibilities of C11, C22, C23, a bound that is a parabola."""
    cksi, ceta, cphi = creepage
    l1, l2 = 8.0 * a / (3.0 * c[0] * SHEAR), 8.0 * a / (3.0 * c[1] * SHEAR)
    l3 = math.pi * a * math.sqrt(a / b) / (4.0 * c[2] * SHEAR)
    if weighted:
        parts = abs(cksi), abs(ceta), math.sqrt(a * b) * abs(cphi)
        l1 = l2 = l3 = (parts[0] * l1 + parts[1] * l2 + parts[2] * l3) / math.hypot(*parts)
    largest_bound = FRICTION * LOAD / (math.pi * a * b) * (1.5 if elliptic else 2.0)
    fx = fy = 0.0
    for i in range(n):
        y = b * (2 * i + 1 - n) / n
        end = a * math.sqrt(1.0 - (y / b) ** 2)
        h = 2.0 * end / n
        px = py = 0.0
        for j in range(n):
            x = end - (j + 0.5) * h
            step = 0.5 * h if j == 0 else h
            px -= step * (cksi / l1 - y * cphi / l3)
            py -= step * (ceta / l2 + (x + 0.5 * step) * cphi / l3)
            capacity = max(1.0 - (x / a) ** 2 - (y / b) ** 2, 0.0)
            bound = largest_bound * (math.sqrt(capacity) if elliptic else capacity)
            size = math.hypot(px, py)
            if size > bound:
                px, py = px * bound / size, py * bound / size
            fx += px * h * 2.0 * b / n
            fy += py * h * 2.0 * b / n
    return fx, fy


class GapFile(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("gap.csv", gap_text(parabola))

    def contact(self, *words, **case):
        self.write("case.nml", gap_case(**case))
        return self.good("contact", "case.nml", *words)[0]

    def same(self, result, other, relative=0.0):
        for name in FIGURES:
            self.assert_close(float(result[name]), float(other[name]), relative, 1e-9, name)

    def test_row(self):
        row = self.contact(motion="cksi = 0.001")
        self.assert_columns(row, RESULT_COLUMNS)
        self.assertEqual((row["status"], row["case"], row["gamma_rad"]), ("ok", "gap", ""))
        for name in FIGURES:
            self.assertTrue(math.isfinite(float(row[name])), name)
        # A paraboloid: Hertz's own numbers.
        hertz = self.contact("--normal", "hertz", motion="cksi = 0.001")
        for name, relative in (("penetration_mm", 3e-3), ("area_mm2", 1e-2), ("pmax_MPa", 1e-2)):
            self.assert_close(float(row[name]), float(hertz[name]), relative, what=name)

    def test_gap_file_is_beside_the_case_file(self):
        row = self.contact()
        self.write("deep/gap.csv", gap_text(parabola))
        self.write("deep/case.nml", gap_case())
        self.same(self.good("contact", "deep/case.nml")[0], row)
        self.write("case.nml", gap_case(gap_file=str(self.folder / "gap.csv")))
        self.same(self.good("contact", "case.nml")[0], row)

    def test_line_ends_and_spelling_do_not_count(self):
        text = gap_case(motion="cksi = 0.001")
        row = self.contact(motion="cksi = 0.001")
        for other in (text.replace("\n", "\r\n"), text.upper().replace("GAP.CSV", "gap.csv"),
                      text.replace("\n", "  ! a comment with / and 'quotes\n"),
                      "\ufeff" + text, text.rstrip("\n"), text.replace("  ", "\t")):
            self.write("case.nml", other)
            self.same(self.good("contact", "case.nml")[0], row)

    def test_sums_of_strips_and_fields(self):
        motion = "cksi = 0.0008, ceta = 0.0004, cphi_rad_per_mm = 0.0001"
        self.write("bumpy.csv", gap_text(bumpy))
        for gap in ("gap.csv", "bumpy.csv", str(GAPS / "shift_0.csv")):
            for methods in (("strip", "faststrip"), ("strip", "fastsim"), ("hertz", "fastsim"),
                            ("strip", "fastsim-weighted"), ("hertz", "fastsim-elliptic"),
                            ("strip", "faststrip-corrected"), ("hertz", "faststrip-paper"),
                            ("strip", "tang"), ("hertz", "tang"), ("norm", "tang")):
                if gap == "bumpy.csv" and methods[0] == "hertz":
                    continue
                with self.subTest(gap=gap, methods=methods):
                    self.write("case.nml", gap_case(gap_file=gap, motion=motion))
                    row = self.solved("contact", "case.nml", "--normal", methods[0], "--tangential",
                                      methods[1], "--strips", "s.csv", "--fields", "f.csv",
                                      "--gap", "g.csv")
                    self.check_strips(row, self.read("s.csv"))
                    self.check_fields(row, self.read("f.csv"))

    def test_sums_of_ellipses_of_the_strips(self):
        self.write("lopsided.csv", gap_text(lambda y: parabola(y) * (1.0 + 0.002 * y * y)))
        for normal in ("equal_area", "equal_moments"):
            row = self.contact("--normal", normal, "--strips", "s.csv", "--fields", "f.csv",
                               gap_file="lopsided.csv", motion="cksi = 0.0008")
            self.check_strips(row, self.read("s.csv"))
            self.check_fields(row, self.read("f.csv"))

    def test_fastsim_by_a_march_of_its_own(self):
        """On the ellipse that Hertz gives, on a finer grid; by strips of the same ellipse nearly
        the same, and by FASTSIM with strips for rows."""
        creepage = (0.0008, 0.0004, 0.0001)
        motion = "cksi = 0.0008, ceta = 0.0004, cphi_rad_per_mm = 0.0001"
        ellipse = self.ellipse_and_coefficients()
        for name, variant, tolerance in (("fastsim", {}, 0.005),
                                         ("fastsim-elliptic", {"elliptic": True}, 0.005),
                                         ("fastsim-weighted", {"weighted": True}, 0.005),
                                         ("faststrip-corrected", {}, 0.02)):
            force = fastsim_force(*ellipse, creepage, **variant)
            for normal in ("hertz", "strip", "equal_area"):
                with self.subTest(name=name, normal=normal):
                    row = self.contact("--normal", normal, "--tangential", name, motion=motion)
                    self.assertEqual((row["normal"], row["tangential"]), (normal, name))
                    near = tolerance + (0.0 if normal == "hertz" else 0.01)
                    for column, value in zip(("Fx_N", "Fy_N"), force):
                        self.assert_close(float(row[column]), value, near, what=column)
                    self.assertNotEqual(row["stick_fraction"], "")

    def test_laws_give_forces_only(self):
        for name in ("linear", "she", "polach"):
            row = self.contact("--tangential", name, motion="cksi = 0.001")
            self.assertEqual(row["stick_fraction"] == "", name != "linear")
            self.refused(1, "contact", "case.nml", "--tangential", name, "--fields", "f.csv",
                         says=[name, "forces only"])

    def ellipse_and_coefficients(self):
        """Semi-axes of the Hertz contact; C11, C22, C23 from one small creepage after the other,
        for a/b = 1.3 somewhat above those of Kalker's table for the circle and nu = 1/4."""
        found = []
        for motion in ("cksi = 1e-6", "ceta = 1e-6", "cphi_rad_per_mm = 1e-6"):
            row = self.contact("--normal", "hertz", "--tangential", "linear", motion=motion)
            found.append(abs(float(row["Fx_N"])) + abs(float(row["Fy_N"])))
        a = float(row["xmax_mm"])
        b = 0.5 * (float(row["ymax_mm"]) - float(row["ymin_mm"]))
        unit = SHEAR * a * b * 1e-6
        c = (found[0] / unit, found[1] / unit, found[2] / (unit * math.sqrt(a * b)))
        self.assertTrue(1.2 < a / b < 1.4, (a, b))
        for value, circle in zip(c, (4.12, 3.67, 1.47)):
            self.assertTrue(circle < value < 1.3 * circle, (value, circle))
        return a, b, c

    def check_strips(self, row, strips):
        load = float(row["N_N"])
        hertz = row["normal"] == "hertz"
        self.assert_close(sum(numbers(strips, "load_N")), load, 1e-6)
        self.assertGreaterEqual(min(numbers(strips, "p0_MPa")), 0.0)
        self.assertGreater(min(numbers(strips, "half_length_mm")), 0.0)
        self.assertEqual(len({strip["patch"] for strip in strips}), int(row["n_patches"]))
        for left, right in zip(strips, strips[1:]):
            self.assertLessEqual(float(left["y_right_mm"]), float(right["y_left_mm"]) + 1e-12)
        self.assert_close(float(strips[0]["y_left_mm"]), float(row["ymin_mm"]), 0, 0.02)
        self.assert_close(float(strips[-1]["y_right_mm"]), float(row["ymax_mm"]), 0, 0.02)
        area = sum(2.0 * float(strip["half_length_mm"])
                   * (float(strip["y_right_mm"]) - float(strip["y_left_mm"])) for strip in strips)
        self.assert_close(area, float(row["area_mm2"]), 0.03)
        if row["tangential"] == "faststrip":
            for name in ("Fx_N", "Fy_N", "friction_power_N"):
                self.assert_close(math.fsum(numbers(strips, name)), float(row[name]), 1e-9)
        else:
            self.assertEqual({strip["friction_power_N"] for strip in strips}, {""})
        if not hertz:
            self.assert_close(max(numbers(strips, "p0_MPa")), float(row["pmax_MPa"]), 0.03)

    def check_fields(self, row, field):
        area = numbers(field, "area_mm2")
        px, py, pn = (numbers(field, name) for name in ("px_MPa", "py_MPa", "pn_MPa"))
        mu_n = 0.3 * float(row["N_N"])
        self.assert_close(math.fsum(p * a for p, a in zip(px, area)), float(row["Fx_N"]),
                          absolute=1e-3 * mu_n)
        self.assert_close(math.fsum(p * a for p, a in zip(py, area)), float(row["Fy_N"]),
                          absolute=1e-3 * mu_n)
        self.assert_close(math.fsum(area), float(row["area_mm2"]), 0.03)
        self.assert_close(math.fsum(p * a for p, a in zip(pn, area)), float(row["N_N"]), 0.02)
        self.assertLessEqual(set(numbers(field, "state")), {1.0, 2.0})
        power = math.fsum(p * a for p, a in zip(numbers(field, "power_MPa"), area))
        if row["tangential"] == "tang":
            # Elements see a little less than what the forces do on the creepages.
            self.assertTrue(0.97 * float(row["friction_power_N"]) < power
                            <= (1.0 + 1e-6) * float(row["friction_power_N"]))
        else:
            self.assert_close(power, float(row["friction_power_N"]), 1e-2)
        self.assertGreaterEqual(min(numbers(field, "power_MPa")), 0.0)
        self.check_bounds(row, field)

    def check_bounds(self, row, field):
        largest = max(numbers(field, "pn_MPa"))
        strips = {}
        for element in field:
            p = math.hypot(float(element["px_MPa"]), float(element["py_MPa"]))
            n = float(element["pn_MPa"])
            # FASTSIM bounds by a paraboloid of the same load; the march by a form of its own
            # whose peak over mu pn stays below 1.25.
            bound = {"faststrip": 0.3 * 1.25 * n, "tang": 0.3 * n}.get(row["tangential"],
                                                                       0.3 * 1.7 * largest)
            self.assertLessEqual(p, bound + 1e-9 * largest)
            total = strips.setdefault(element["y_mm"], 0.0)
            strips[element["y_mm"]] = total + p * float(element["area_mm2"])
        if row["tangential"] == "faststrip":
            for strip in self.read("s.csv"):
                used = strips[strip["y_mm"]]
                self.assertLessEqual(used, 0.3 * float(strip["load_N"]) * (1.0 + 1e-9))

    def test_penetration_gives_back_the_load(self):
        self.write("lopsided.csv", gap_text(lambda y: parabola(y) * (1.0 + 0.05 * y)))
        for normal, relative in (("strip", 1e-6), ("hertz", 1e-12), ("equal_area", 1e-6),
                                 ("equal_moments", 1e-6), ("norm", 1e-7)):
            # Hertz tells that it is a poor one here.
            words = "--normal", normal, "--resolution-limit", "1"
            row = self.contact(*words, gap_file="lopsided.csv")
            text = gap_case(gap_file="lopsided.csv").replace(
                "load_N = 1e5", f"penetration_mm = {float(row['penetration_mm'])!r}")
            self.write("deep.nml", text)
            deep = self.good("contact", "deep.nml", *words)[0]
            self.assertEqual(list(deep), list(row))
            self.assert_close(float(deep["N_N"]), 1e5, 1e-5 + relative, what=normal)
            self.same(deep, row, 1e-4)
        self.write("deep.nml", text.replace("penetration_mm = ", "penetration_mm = -"))
        for normal in ("strip", "hertz", "equal_area", "norm"):
            self.refused(1, "contact", "deep.nml", "--normal", normal, says=["deep.nml", "touch"])

    def test_strips_left_to_the_solver(self):
        self.write("kink.csv", gap_text(lambda y: abs(y) ** 1.5 / 300.0 + parabola(y)))
        counts = {}
        for gap in ("gap.csv", "kink.csv"):
            row = self.contact("--strips-per-patch", "auto", "--strips", "s.csv", gap_file=gap)
            counts[gap] = len(self.read("s.csv"))
            self.assertEqual(row["status"], "ok")
            fine = self.contact("--strips-per-patch", "81", gap_file=gap)
            self.assert_close(float(row["pmax_MPa"]), float(fine["pmax_MPa"]), 0.02)
            listed = self.contact(gap_file=gap, extra="&numerics\n strips_per_patch = 0\n/\n")
            self.same(listed, row)
            self.assertEqual(float(self.contact("--strips-per-patch", "auto", "--normal", "hertz")
                                   ["N_N"]), 1e5)
        self.assertTrue(15 <= counts["gap.csv"] <= 41, counts)
        self.assertTrue(15 <= counts["kink.csv"] <= 41, counts)

    def test_tang_is_kalkers_method(self):
        """Shift -5 mm of the paper: CONTACT, extrapolated in its grid, by any pressures."""
        gap, motion = str(GAPS / "shift_-5.csv"), "cksi = -0.001645, cphi_rad_per_mm = 1.9e-5"
        for normal, side, within in (("norm", "0.4", 40.0), ("strip", "0.4", 150.0)):
            row = self.contact("--normal", normal, "--tangential", "tang", "--element-dx", side,
                               "--element-dy", side, gap_file=gap, load="100004", motion=motion)
            self.assert_close(float(row["Fx_N"]), 18756.5, absolute=within)
            self.assert_close(float(row["Fy_N"]), -653.8, absolute=within)
            self.assert_close(float(row["Mz_Nmm"]), 6541.4, absolute=10 * within)
        self.refused(2, "contact", "case.nml", "--tangential", "kalker", says=["kalker"])

    def test_norm_and_tang_by_elements(self):
        motion = "cksi = 0.0008, cphi_rad_per_mm = 0.0001"
        row = self.contact("--normal", "norm", "--tangential", "tang", "--element-dx", "0.5",
                           "--element-dy", "0.25", "--fields", "f.csv", motion=motion)
        field = self.read("f.csv")
        # Pressures are NORM's, tractions and slip TANG's, on the same elements.
        self.assertEqual(set(numbers(field, "area_mm2")), {0.125})
        self.assert_close(0.125 * len(field), float(row["area_mm2"]), 1e-12)
        self.assert_close(max(numbers(field, "pn_MPa")), float(row["pmax_MPa"]), 1e-12)
        self.assert_close(0.125 * math.fsum(numbers(field, "pn_MPa")), 1e5, 1e-9)
        self.assert_close(0.125 * math.fsum(numbers(field, "px_MPa")), float(row["Fx_N"]), 1e-9)
        # What forces do on creepages; elements see a little less of it.
        power = float(row["friction_power_N"])
        self.assert_close(-(float(row["Fx_N"]) * 0.0008 + float(row["Mz_Nmm"]) * 0.0001), power,
                          1e-9)
        self.assertLess(0.125 * math.fsum(numbers(field, "power_MPa")), power)
        self.assertGreater(0.125 * math.fsum(numbers(field, "power_MPa")), 0.9 * power)
        stuck = [element for element in field if element["state"] == "1"]
        self.assert_close(len(stuck) / len(field), float(row["stick_fraction"]), 1e-12)
        for element in field:
            at_bound = math.hypot(float(element["px_MPa"]), float(element["py_MPa"])) \
                > 0.3 * float(element["pn_MPa"]) * (1.0 - 1e-9)
            slides = float(element["sx"]) != 0.0 or float(element["sy"]) != 0.0
            self.assertEqual(slides, element["state"] == "2")
            self.assertTrue(at_bound or not slides)

    def test_dissimilar_materials(self):
        text = gap_case(motion="cksi = 0.0")
        self.write("case.nml", text.replace("mu = 0.3", "mu = 0.3, E_rail_MPa = 7e4"))
        self.write("turned.nml", text.replace("mu = 0.3", "mu = 0.3, E_rail_MPa = 209920.0, "
                                              "E_wheel_MPa = 7e4"))
        words = ("--tangential", "tang", "--element-dx", 0.4, "--element-dy", 0.4)
        both = self.solved("contact", "case.nml", "--normal", "norm", *words, "--strips",
                           "strips.csv")
        # The strips have the pressures that stay.
        self.assert_close(max(numbers(self.read("strips.csv"), "p0_MPa")),
                          float(both["pmax_MPa"]), 0.01)
        plain = self.solved("contact", "case.nml", "--normal", "norm", "--tangential", "none",
                            *words[2:])
        one_way = self.solved("contact", "case.nml", "--normal", "strip", *words)
        # A soft rail is drawn together under the wheel: it creeps forwards and is driven back.
        self.assertLess(float(both["Fx_N"]), -0.05 * 0.3 * 1e5)
        self.assert_close(float(one_way["Fx_N"]), float(both["Fx_N"]), 0.05)
        # Tractions press the middle, for they point inwards on the stiffer body.
        self.assertGreater(float(both["pmax_MPa"]), 1.001 * float(plain["pmax_MPa"]))
        self.assert_close(float(both["pmax_MPa"]), float(plain["pmax_MPa"]), 0.03)
        turned = self.solved("contact", "turned.nml", "--normal", "norm", *words)
        self.assert_close(-float(turned["Fx_N"]), float(both["Fx_N"]), 1e-6)
        self.assert_close(float(turned["pmax_MPa"]), float(both["pmax_MPa"]), 1e-9)
        # FASTSTRIP has the slip in its strips; its estimate bounds what is left.
        for case, exact in (("case.nml", both), ("turned.nml", turned)):
            row = self.solved("contact", case)
            error = abs(float(row["Fx_N"]) - float(exact["Fx_N"])) / (0.3 * 1e5)
            self.assertLess(error, 0.03)
            self.assertLess(error, float(row["est_err_Fx"]))
            self.assertLess(float(row["est_err_Fx"]), 0.1)
        # All others say that they leave it out.
        for tangential in ("fastsim", "linear", "polach"):
            done = self.run_program("contact", "case.nml", "--tangential", tangential)
            self.assertEqual(rows_of(done.stdout)[0]["status"], "under_resolved", tangential)
            self.assertIn("dissimilar materials", done.stderr, tangential)

    def test_friction_power_between_dissimilar_materials(self):
        # Where nothing sticks tractions do less on the creepage than on the slip.
        text = gap_case(motion="cksi = 0.006")
        self.write("case.nml", text.replace("mu = 0.3", "mu = 0.2, E_rail_MPa = 7e4"))
        row = self.solved("contact", "case.nml", "--fields", "fields.csv")
        tang = self.solved("contact", "case.nml", "--tangential", "tang")
        self.assert_close(float(row["friction_power_N"]), float(tang["friction_power_N"]), 0.02)

    def test_what_tang_refuses(self):
        text = gap_case(motion="cksi = 0.001")
        self.write("unlike.nml", text.replace("mu = 0.3", "mu = 0.3, nu_wheel = 0.3")
                   + "&friction\n  initial_slope_factor = 0.6\n/\n")
        for normal in ("strip", "hertz", "norm"):
            self.refused(1, "contact", "unlike.nml", "--normal", normal, "--tangential", "tang",
                         says=["tang", "initial_slope_factor", "dissimilar materials",
                               "unlike.nml"])
        self.write("case.nml", text)
        self.refused(1, "contact", "case.nml", "--tangential", "tang", "--element-dx", "1e-3",
                     "--element-dy", "1e-3", says=["elements", "case.nml"])

    def test_rows_of_kalkers_method_as_strips(self):
        for tangential in ("faststrip", "fastsim"):
            row = self.contact("--normal", "norm", "--tangential", tangential, "--strips", "s.csv",
                               "--fields", "f.csv", motion="cksi = 0.001")
            strips, field = self.read("s.csv"), self.read("f.csv")
            self.assert_close(sum(numbers(strips, "load_N")), float(row["N_N"]), 1e-9)
            for left, right in zip(numbers(strips, "y_left_mm"), numbers(strips, "y_right_mm")):
                self.assert_close(right - left, 0.2, 1e-9)
            force = sum(px * area for px, area in zip(numbers(field, "px_MPa"),
                                                      numbers(field, "area_mm2")))
            self.assert_close(force, float(row["Fx_N"]), 1e-6)

    def test_gap_that_was_read_is_the_gap_that_is_written(self):
        self.contact("--gap", "g.csv")
        for name in ("y_mm", "h_mm", "inv2R_per_mm"):
            self.assertEqual(numbers(self.read("g.csv"), name), numbers(self.read("gap.csv"), name))

    def test_smoothing_is_told(self):
        rough = gap_text(lambda y: parabola(y) + 5e-4 * math.cos(1e5 * y * y))
        self.write("gap.csv", rough)
        self.write("case.nml", gap_case())
        plain = self.solved("contact", "case.nml")
        self.assertEqual((plain["status"], plain["gap_change_um"]), ("under_resolved", ""))
        row = self.contact("--smooth", "0.4", "--gap", "smooth.csv")
        self.assertGreater(float(row["gap_change_um"]), 0.1)
        self.assertLess(float(row["gap_change_um"]), 0.6)
        text = (self.folder / "smooth.csv").read_text(encoding="utf-8")
        self.assertIn("# smoothed for a noise of 0.4", text)
        self.same(self.contact(extra="&numerics\n smoothing_um = 0.4\n/\n"), row)
        done = self.run_program("contact", "case.nml", "--smooth", "0.4")
        self.assertIn("# gap smoothed for a noise of 0.4", done.stdout)
        self.refused(2, "contact", "case.nml", "--smooth", "-1", says=["--smooth", "-1"])

    def test_resolution_limit(self):
        """Above the limit a row is `under_resolved`, whoever names the limit; its figures stay."""
        rough = gap_text(lambda y: parabola(y) + 3e-4 * math.sin(1e5 * y * y))
        self.write("gap.csv", rough)
        self.write("case.nml", gap_case())
        row = self.solved("contact", "case.nml")
        self.assertEqual(row["status"], "under_resolved")
        estimate = float(row["est_err_pmax"])
        above, below = f"{1.01 * estimate:.6f}", f"{0.99 * estimate:.6f}"
        other = self.contact("--resolution-limit", above)
        self.assertEqual(other["status"], "ok")
        self.same(other, row)
        row = self.contact(extra=f"&numerics\n resolution_limit = {above}\n/\n")
        self.assertEqual(row["status"], "ok")
        self.write("case.nml", gap_case(extra=f"&numerics\n resolution_limit = {below}\n/\n"))
        self.assertEqual(self.solved("contact", "case.nml")["status"], "under_resolved")
        # The command line counts.
        self.assertEqual(self.good("contact", "case.nml", "--resolution-limit", above)[0]["status"],
                         "ok")
        # Kalker's method says so too.
        words = ("contact", "case.nml", "--normal", "norm", "--tangential", "none",
                 "--resolution-limit")
        row = self.good(*words, "1e9")[0]
        self.assertEqual(row["status"], "ok")
        limit = repr(0.5 * float(row["est_err_pmax"]))
        self.assertEqual(self.solved(*words, limit)["status"], "under_resolved")

    def test_a_pressure_beyond_yield_is_named(self):
        row = self.contact()
        pmax = float(row["pmax_MPa"])
        self.write("case.nml", gap_case())
        self.assertEqual(self.good("contact", "case.nml", "--yield-MPa", 1.01 * pmax)[0]["status"],
                         "ok")
        done = self.succeed("contact", "case.nml", "--yield-MPa", 0.99 * pmax)
        self.assertIn(",beyond_yield,", done.stdout)
        self.assertRegex(done.stderr, r"pmax of \S+ MPa is above the limit of \S+ MPa")
        self.write("case.nml", gap_case(extra=f"&numerics\n yield_MPa = {0.99 * pmax}\n/\n"))
        self.assertIn(",beyond_yield,", self.run_program("contact", "case.nml").stdout)

    def forces_of(self, row):
        return [float(row[f"est_err_{name}"]) for name in ("Fx", "Fy", "Mz")]

    def test_errors_of_forces_are_told_where_they_are_known(self):
        motion = "cksi = 0.0008, ceta = 0.0004, cphi_rad_per_mm = 0.0001"
        for normal in ("strip", "hertz", "norm", "equal_area"):
            for tangential in ("faststrip", "faststrip-plain", "fastsim", "tang", "polach",
                               "faststrip-paper", "none"):
                row = self.contact("--normal", normal, "--tangential", tangential, motion=motion)
                what = normal, tangential
                known = normal != "equal_area"
                self.assertEqual(row["est_err_pmax"] != "", known, what)
                known = known and tangential in ("faststrip", "faststrip-plain", "fastsim", "tang")
                self.assertEqual({row[f"est_err_{name}"] != "" for name in ("Fx", "Fy", "Mz")},
                                 {known}, what)
                if known:
                    self.assertTrue(0.0 < min(self.forces_of(row)), what)
                    self.assertLess(max(self.forces_of(row)), 0.1, what)
        # Neither the pressures' errors nor those of the forces are known of one grid.
        row = self.contact("--normal", "norm", "--norm-start", "strips", "--tangential", "tang",
                           motion=motion)
        self.assertEqual({row[f"est_err_{name}"] for name in ("pmax", "Fx", "Fy", "Mz")}, {""})

    def test_tang_is_as_wrong_as_it_says(self):
        motion = "cksi = 0.0008, ceta = 0.0004, cphi_rad_per_mm = 0.0001"
        force = 0.3 * 1e5
        for normal in ("strip", "hertz", "norm"):
            rows = [self.contact("--normal", normal, "--tangential", "tang", "--element-dx", side,
                                 "--element-dy", side, "--resolution-limit", "1", motion=motion)
                    for side in ("1.0", "0.5", "0.2")]
            fine = rows[-1]
            moment = force * math.sqrt(float(fine["area_mm2"]) / math.pi)
            for row in rows[:-1]:
                for i, (name, unit) in enumerate((("Fx_N", force), ("Fy_N", force),
                                                  ("Mz_Nmm", moment))):
                    error = abs(float(row[name]) - float(fine[name])) / unit
                    self.assertLess(error, self.forces_of(row)[i], (normal, name))
            for i in range(3):
                self.assertLess(self.forces_of(rows[1])[i], self.forces_of(rows[0])[i], normal)

    def test_force_limit(self):
        """Above the limit a row is `under_resolved`, by any method and whoever names the limit."""
        motion = "cksi = 0.0008, ceta = 0.0004, cphi_rad_per_mm = 0.0001"
        for methods in (("strip", "faststrip"), ("hertz", "fastsim"), ("strip", "tang")):
            words = ("--normal", methods[0], "--tangential", methods[1])
            row = self.contact(*words, motion=motion)
            largest = max(self.forces_of(row))
            below, above = f"{0.99 * largest:.8f}", f"{1.01 * largest:.8f}"
            told = self.solved("contact", "case.nml", *words, "--force-limit", below)
            self.assertEqual(told["status"], "under_resolved", methods)
            self.same(told, row)
            self.assertEqual(self.contact(*words, "--force-limit", above, motion=motion)["status"],
                             "ok")
            group = f"&numerics\n force_limit = {below}\n/\n"
            self.write("case.nml", gap_case(motion=motion, extra=group))
            self.assertEqual(self.solved("contact", "case.nml", *words)["status"],
                             "under_resolved", methods)

    def test_elements_too_large_to_tell_how_wrong_tang_is(self):
        self.write("case.nml", gap_case(motion="cksi = 0.001"))
        done = self.run_program("contact", "case.nml", "--tangential", "tang", "--element-dx", "8",
                                "--element-dy", "30")
        row = rows_of(done.stdout)[0]
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((row["status"], row["est_err_Fx"] == ""),
                         ("under_resolved", "no error of the forces" in done.stderr))

    def test_strips_across_and_more_strips(self):
        for asked, used in (("1", "3"), ("2", "3"), ("3", "3"), ("15", "15"), ("31", "31")):
            self.write("case.nml", gap_case())
            done = self.succeed("contact", "case.nml", "--strips-per-patch", asked,
                                "--resolution-limit", "1e9", "--strips", "s.csv")
            row = rows_of(done.stdout)[0]
            self.assertEqual(row["strips_across"], used)
            self.assertEqual(len(self.read("s.csv")), int(used))
            self.assertEqual(row["status"], "ok" if asked == used else "more_strips")
            said = "" if asked == used else f"{used} strips used where {asked} "
            self.assertIn(said, done.stderr)
            self.assertEqual(done.stderr == "", asked == used)

    def test_no_tension_in_a_conforming_gap(self):
        self.write("bumpy.csv", gap_text(bumpy))
        for load, patches in (("1e3", 2), ("1e4", 2), ("1e6", 1)):
            row = self.contact("--strips", "s.csv", gap_file="bumpy.csv", load=load)
            self.assertEqual(int(row["n_patches"]), patches)
            strips = self.read("s.csv")
            self.assertGreater(min(numbers(strips, "p0_MPa")), 0.0)
            self.assert_close(sum(numbers(strips, "load_N")), float(load), 1e-6)

    def test_number_of_points(self):
        row = self.contact()
        for n, relative in ((20, 1e-6), (20000, 1e-6)):
            self.write("other.csv", gap_text(parabola, n=n))
            other = self.contact(gap_file="other.csv")
            for name in ("penetration_mm", "area_mm2", "pmax_MPa"):
                self.assert_close(float(other[name]), float(row[name]), relative, what=(n, name))

    def test_absurd_load_is_an_error_of_one_line(self):
        self.write("case.nml", gap_case(load="1e300"))
        done = self.run_program("contact", "case.nml", "-o", "out.csv", "--strips", "s.csv")
        self.assertIn(done.returncode, (1, 3))
        self.assertRegex(done.stderr, r"\Afaststrip: [^\n]*case\.nml[^\n]*\n\Z")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()),
                         ["case.nml", "gap.csv"])

    def test_edge_of_data_is_told(self):
        self.write("short.csv", gap_text(lambda y: y * y / 60000.0, half_width=3.0))
        self.write("case.nml", gap_case(gap_file="short.csv"))
        done = self.succeed("contact", "case.nml")
        self.assertRegex(without_doubts(done.stderr),
                         r"\Afaststrip: [^\n]*end of the gap data[^\n]*\n\Z")
        row = rows_of(done.stdout)[0]
        self.assertEqual(row["status"], "edge_of_data")
        self.assertGreater(float(row["penetration_mm"]), 0.0)


class Profiles(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("case.nml", profile_case(contact="load_N = 1e5, shift_mm = 1",
                                            motion="cksi = 0.0007, cphi_rad_per_mm = 1.5e-4"))

    def test_shift_option_stands_for_that_of_the_case(self):
        own = self.good("contact", "case.nml")[0]
        same = self.good("contact", "case.nml", "--shift", "1.0")[0]
        other = self.good("contact", "case.nml", "--shift=-2")[0]
        for name in FIGURES:
            self.assertEqual(own[name], same[name])
        self.assertEqual((float(own["yw_mm"]), float(other["yw_mm"])), (1.0, -2.0))
        self.assertNotEqual(own["penetration_mm"], other["penetration_mm"])

    def test_gap_that_is_written_gives_the_same_contact(self):
        row = self.good("contact", "case.nml", "--gap", "gap.csv")[0]
        self.write("again.nml", gap_case(motion="cksi = 0.0007, cphi_rad_per_mm = 1.5e-4"))
        again = self.good("contact", "again.nml")[0]
        for name in FIGURES:
            self.assert_close(float(again[name]), float(row[name]), 1e-9, 1e-9, name)

    def measured(self, y_sense, z_sense):
        """Write both profiles as someone measured them, and a case that reads them."""
        self.good("contact", "case.nml", "--profiles", "p.csv", "-o", "row.csv")
        rows = self.read("p.csv")
        for body in ("wheel", "rail"):
            points = [(y_sense * float(row["y_mm"]), z_sense * float(row["z_mm"]))
                      for row in rows if row["body"] == body]
            if body == "wheel":
                # As it stands in the file the wheel was moved to where it touches the rail.
                dy, dz = self.offset
                points = [(y - y_sense * dy, z - z_sense * dz) for y, z in points]
            points.sort()
            self.write(f"{body}.txt", "".join(f"{y!r} {z!r}\n" for y, z in points))
        senses = (f"y_positive_to = '{'field' if y_sense > 0 else 'gauge'}', "
                  f"z_positive_to = '{'down' if z_sense > 0 else 'up'}'")
        self.write("measured.nml", profile_case(
            contact="load_N = 1e5, shift_mm = 1", wheel=f"profile = 'wheel.txt', {senses}",
            rail=f"profile = 'rail.txt', inclination = 0, {senses}",
            motion="cksi = 0.0007, cphi_rad_per_mm = 1.5e-4"))

    def test_measured_profiles_agree_with_the_drawn_ones(self):
        # The wheel's own frame: the tread line z = 0 at y = 0, which the S1002 passes through.
        self.good("contact", "case.nml", "--profiles", "p.csv")
        wheel = [(float(row["y_mm"]), float(row["z_mm"])) for row in self.read("p.csv")
                 if row["body"] == "wheel"]
        wheel.sort()
        dy = wheel[-1][0] - 60.0
        near = min(range(len(wheel) - 1), key=lambda i: abs(wheel[i][0] - dy))
        (y0, z0), (y1, z1) = wheel[near], wheel[near + 1]
        self.offset = dy, z0 + (z1 - z0) * (dy - y0) / (y1 - y0)
        drawn = self.good("contact", "case.nml")[0]
        first = None
        for y_sense in (1, -1):
            for z_sense in (1, -1):
                self.measured(y_sense, z_sense)
                row = self.good("contact", "measured.nml")[0]
                # Points 0.15 mm apart: curvatures, hence pressures, are those of their spline.
                for name, relative in (("penetration_mm", 0.03), ("area_mm2", 0.05),
                                       ("pmax_MPa", 0.05)):
                    self.assert_close(float(row[name]), float(drawn[name]), relative, what=name)
                self.assert_close(float(row["gamma_rad"]), float(drawn["gamma_rad"]), 0, 2e-3)
                if first is None:
                    first = row
                for name in FIGURES:
                    self.assert_close(float(row[name]), float(first[name]), 1e-4, 1e-6, name)

    def test_vertical_load_is_larger_along_the_normal(self):
        self.write("case.nml", profile_case(
            contact="load_N = 1e5, shift_mm = 3, load_direction = 'vertical'"))
        row = self.good("contact", "case.nml")[0]
        self.assert_close(float(row["N_N"]), 1e5 / math.cos(float(row["gamma_rad"])), 1e-12)


class Outputs(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("gap.csv", gap_text(parabola))
        self.write("case.nml", gap_case())
        (self.folder / "dir").mkdir()

    def test_what_cannot_be_written(self):
        for path in ("dir", "dir/", "", "gap.csv/out.csv", "/dev/full",
                     "/proc/out.csv"):
            for words in (["contact", "case.nml"], ["integral", "--n", "1", "--b", "1"]):
                with self.subTest(path=path, words=words):
                    self.refused(1, *words, "-o", path, says=[path])

    def test_all_files_or_none(self):
        for option in ("-o", "--strips", "--fields", "--gap"):
            words = ["contact", "case.nml", "-o", "a.csv", "--strips", "b.csv", "--fields",
                     "c.csv", "--gap", "d.csv"]
            words[words.index(option) + 1] = "dir"
            with self.subTest(option):
                self.refused(1, *words, says=["dir"])
                self.assertEqual(sorted(path.name for path in self.folder.iterdir()),
                                 ["case.nml", "dir", "gap.csv"])
        self.assertEqual(list((self.folder / "dir").iterdir()), [])

    def test_stdout_that_is_full(self):
        with open("/dev/full", "wb") as full:
            done = subprocess.run([str(PROGRAM), "contact", "case.nml"], cwd=self.folder,
                                  stdin=subprocess.DEVNULL, stdout=full, stderr=subprocess.PIPE,
                                  encoding="utf-8", timeout=600, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"\Afaststrip: [^\n]+\n\Z")

    def test_existing_file_is_replaced_whole(self):
        self.write("out.csv", "x" * 100000)
        self.assertEqual(self.good("contact", "case.nml", "-o", "out.csv"), [])
        self.assertEqual(len(self.read("out.csv")), 1)
        self.assertNotIn("xx", (self.folder / "out.csv").read_text(encoding="utf-8"))
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()),
                         ["case.nml", "dir", "gap.csv", "out.csv"])
