"""`&thermal` of a case file and of a batch: temperatures, friction that falls with them."""

import math

from cli_program import BATCH_COLUMNS, ProgramTest, gap_case, gap_text, rows_of

# CONTACT's example ertz_temperature (github.com/eve70a/CONTACT, examples), of E. Ertz and
# K. Knothe, Wear 253 (2002): an ellipse of 5.88 by 10.54 mm at 30 m/s. Creepages, as seen in the
# rolling direction, which is -x there; temperature of the wheel.
ERTZ = {1: (-0.03333, 0.0, 0.0, 0.0), 2: (0.0, 0.0, 0.0, 150.0), 3: (-0.03333, 0.0, 0.0, 150.0),
        4: (-2e-3, 1e-3, -2e-4, 150.0)}
HOT = "&friction\n  mu_hot = 0.1\n  cold_temperature_C = 60.0\n  hot_temperature_C = 200.0\n/\n"
EFFUSIVITY = math.sqrt(50.0 * 450.0 * 7850.0 * 1e-6)


def moving(cksi, ceta=0.0, cphi=0.0, speed=3e4):
    return f"cksi = {cksi!r}\n  ceta = {ceta!r}\n  cphi_rad_per_mm = {cphi!r}\n" + (
        f"  speed_mm_s = {speed!r}" if speed else "")


def sliding_force(a, p0, slip_speed, rows=15, n=60):
    """Force over N of an ellipse that slides on the friction of HOT: row by row, the temperature of
    each element by bisection."""
    force = load = 0.0
    for row in range(rows):
        width = math.sqrt(1.0 - ((2 * row + 1) / rows - 1.0) ** 2)
        length = 2.0 * a * width / n
        heats = []
        for i in range(n):
            pressure = p0 * width * math.sqrt(1.0 - ((2 * i + 1) / n - 1.0) ** 2)
            ahead = sum(2.0 * q / (math.sqrt(i - j + 0.5) + math.sqrt(i - j - 0.5))
                        for j, q in enumerate(heats))
            scale = math.sqrt(length / (math.pi * 3e4)) / (2.0 * EFFUSIVITY)
            low, high = 0.1, 0.3
            for _ in range(40):
                mu = 0.5 * (low + high)
                heat = mu * pressure * slip_speed
                t = 20.0 + scale * (ahead + math.sqrt(2.0) * heat)
                if mu > 0.3 - 0.2 * min(max((t - 60.0) / 140.0, 0.0), 1.0):
                    high = mu
                else:
                    low = mu
            heats.append(heat)
            force += mu * pressure * length
            load += pressure * length
    return force / load


class Heat(ProgramTest):
    def row(self, motion, groups, *options, method="faststrip"):
        self.write("gap.csv", gap_text(lambda y: 4.215e-4 * y * y, 301, inv2r=1.015e-3))
        self.write("case.nml", gap_case(motion=motion, extra=groups))
        return rows_of(self.run_program("contact", "case.nml", "--normal", "hertz",
                                        "--tangential", method, *options).stdout)[0]

    def ertz(self, case, method):
        *creepage, wheel = ERTZ[case]
        row = self.row(moving(*creepage), f"&thermal\n  temperature_wheel_C = {wheel!r}\n"
                       "  temperature_rail_C = 0.0\n/\n", "--fields", "fields.csv", method=method)
        return row, self.read("fields.csv")

    def test_cases_of_ertz_and_knothe(self):
        # CONTACT prints 166.8 and 241.8 for the first and the third, as it counts the heat of each
        # element twice: less that term it has 152.6 and 227.6.
        for case, expected in ((1, 152.6), (2, 75.0), (3, 227.6)):
            for method in ("tang", "faststrip", "fastsim-elliptic"):
                row, _ = self.ertz(case, method)
                self.assertEqual(row["status"], "ok")
                self.assertAlmostEqual(float(row["temperature_max_C"]) / expected, 1.0,
                                       delta=1e-3 if method == "tang" else 0.02, msg=method)

    def test_partial_slip_with_spin(self):
        # Through the middle of CONTACT's fourth case; where it is hottest it is warmer.
        row, elements = self.ertz(4, "tang")
        middle = max(float(one["surface_rail_C"]) for one in elements
                     if abs(float(one["y_mm"])) < 0.11)
        self.assertAlmostEqual(middle / 86.5, 1.0, delta=0.005)
        self.assertAlmostEqual(float(row["temperature_max_C"]), 89.3, delta=0.1)
        self.assertAlmostEqual(float(row["temperature_y_mm"]), -3.9, delta=0.3)
        for method in ("faststrip", "fastsim-elliptic"):
            other, _ = self.ertz(4, method)
            self.assertAlmostEqual(float(other["temperature_max_C"]), 89.3, delta=1.2, msg=method)

    def test_elements_have_the_integral_of_their_heat(self):
        row, elements = self.ertz(3, "faststrip")
        place = row["temperature_y_mm"]
        strip = [(float(one["x_mm"]), float(one["power_MPa"]), float(one["surface_wheel_C"]))
                 for one in elements if one["y_mm"] == place]
        self.assertEqual(len(strip), 15)
        length = strip[0][0] - strip[1][0]
        for x, _, temperature in strip:
            heat = 0.0
            for other, power, _ in strip:
                front, back = other + 0.5 * length - x, other - 0.5 * length - x
                if front > 0.0:
                    heat += 2.0 * power * (math.sqrt(front) - math.sqrt(max(back, 0.0)))
            heat *= math.sqrt(3e4 / math.pi) / (2.0 * EFFUSIVITY)
            self.assertAlmostEqual(75.0 + heat, temperature, places=9)
        self.assertEqual(max(one[2] for one in strip), float(row["temperature_max_C"]))
        self.assertTrue(all(one["surface_wheel_C"] == one["surface_rail_C"] for one in elements))

    def test_unlike_bodies_share_the_heat(self):
        # Four times the conductivity is twice the effusivity.
        alike = self.row(moving(0.03), "&thermal\n/\n")
        unlike = self.row(moving(0.03), "&thermal\n  conductivity_wheel_W_per_mK = 200.0\n"
                          "  temperature_wheel_C = 110.0\n/\n")
        self.assertAlmostEqual(float(unlike["flash_temperature_K"]) * 1.5,
                               float(alike["flash_temperature_K"]), places=9)
        self.assertAlmostEqual(float(unlike["temperature_max_C"])
                               - float(unlike["flash_temperature_K"]), 80.0, places=9)

    def test_nothing_changes_where_it_is_not_asked_for(self):
        hot = self.row(moving(3e-3, 1e-3, 2e-4), "&thermal\n/\n")
        cold = self.row(moving(3e-3, 1e-3, 2e-4, 0.0), "")
        self.assertEqual({name for name in hot if hot[name] != cold[name]} - {
            "normal_us", "tangential_us"}, {name for name in hot if "temperature" in name})

    def test_hot_friction(self):
        cold = self.row(moving(0.04), "&thermal\n/\n")
        for method in ("faststrip", "faststrip-plain", "fastsim", "fastsim-elliptic",
                       "fastsim-weighted"):
            row = self.row(moving(0.04), HOT + "&thermal\n/\n", method=method)
            self.assertEqual(row["status"], "under_resolved")
            self.assertLess(float(row["temperature_max_C"]), float(cold["temperature_max_C"]))
            force = -float(row["Fx_N"]) / 1e5
            if method != "fastsim-elliptic":
                self.assertLess(force, 0.27)
        # FASTSTRIP comes nearer with points along the strips.
        expected = -1e5 * sliding_force(5.88, 770.5, 6e3)
        for method, points, delta in (("faststrip", 15, 0.035), ("faststrip", 31, 0.015),
                                      ("faststrip", 61, 0.008), ("fastsim-elliptic", 15, 3e-3)):
            row = self.row(moving(0.2), HOT, "--points-per-strip", points, method=method)
            self.assertAlmostEqual(float(row["Fx_N"]) / expected, 1.0, delta=delta, msg=method)
        # One that stays cold is friction as it was.
        slow = self.row(moving(1e-4), HOT)
        self.assertEqual(slow["Fx_N"], self.row(moving(1e-4), "")["Fx_N"])

    def test_elements_slide_on_the_friction_of_their_temperature(self):
        tractions = {}
        for friction in ("", HOT):
            self.row(moving(0.2), friction + "&thermal\n/\n", "--points-per-strip", 61,
                     "--fields", "fields.csv")
            tractions[friction] = self.read("fields.csv")
        apart = []
        for cold, hot in zip(tractions[""], tractions[HOT], strict=True):
            temperature = float(hot["surface_rail_C"])
            share = 1.0 - min(max((temperature - 60.0) / 140.0, 0.0), 1.0) * (2.0 / 3.0)
            apart.append(abs(float(hot["px_MPa"]) / float(cold["px_MPa"]) - share))
        # Steps of the march end where elements have their middles.
        self.assertLess(max(apart), 0.05)
        self.assertLess(sum(apart) / len(apart), 0.01)

    def refuses(self, words, groups, motion=None, method="faststrip"):
        self.write("gap.csv", gap_text(lambda y: 4.215e-4 * y * y, 301))
        self.write("case.nml", gap_case(motion=motion or moving(0.03), extra=groups))
        self.refused(1, "contact", "case.nml", "--tangential", method, says=words)

    def test_what_cannot_be_is_refused(self):
        hot = "&friction\n  mu_hot = {}\n  cold_temperature_C = 60.0\n  hot_temperature_C = {}\n/\n"
        for method in ("linear", "she", "polach", "none"):
            self.refuses(["element by element", method], "&thermal\n/\n", method=method)
        for method in ("tang", "faststrip-paper", "polach"):
            self.refuses([f"{method} takes no friction that falls with temperature"],
                         hot.format(0.1, 200.0), method=method)
        self.refuses(["speed_mm_s", "must be given with &thermal"], "&thermal\n/\n",
                     moving(0.03, speed=0.0))
        self.write("case.nml", gap_case(motion=moving(0.03), extra=hot.format(0.1, 200.0)))
        self.refused(1, "contact", "case.nml", "--points-per-strip", 129, says=["at most 128"])
        self.refuses(["mu_hot", "speed_mm_s"], hot.format(0.1, 200.0), moving(0.03, speed=0.0))
        self.refuses(["mu_hot", "at most &material mu"], hot.format(0.5, 200.0))
        self.refuses(["hot_temperature_C", "above cold_temperature_C"], hot.format(0.1, 50.0))
        self.refuses(["cold_temperature_C", "must be given with mu_hot"],
                     "&friction\n  mu_hot = 0.1\n  hot_temperature_C = 60.0\n/\n")
        self.refuses(["temperature_rail_C", "-273.15"],
                     "&thermal\n  temperature_rail_C = -300.0\n/\n")

    def test_slow_rolling_is_named(self):
        row = self.row(moving(0.03, speed=40.0), "&thermal\n/\n")
        self.assertEqual(row["status"], "under_resolved")
        self.assertGreater(float(row["flash_temperature_K"]), 0.0)

    def test_a_batch_has_them_by_row(self):
        self.write("gap.csv", gap_text(lambda y: 4.215e-4 * y * y, 301, inv2r=1.015e-3))
        names = "speed_mm_s,temperature_wheel_C,density_rail_kg_per_m3,mu_hot," \
                "cold_temperature_C,hot_temperature_C"
        start = "gap.csv,209920,0.28,0.3,1e5,0.03,0,0"
        self.write("cases.csv", f"{BATCH_COLUMNS},{names}\na,{start},3e4,,,,,\n"
                   f"b,{start},3e4,150,,,,\nc,{start},3e4,150,-1,,,\nd,{start},,150,,,,\n"
                   f"e,{start},3e4,20,,0.1,60,200\nf,{start},3e4,20,,0.1,60,\n")
        done = self.run_program("batch", "cases.csv")
        self.assertEqual(done.returncode, 1)
        rows = {row["case"]: row for row in rows_of(done.stdout)}
        self.assertEqual(rows["a"]["flash_temperature_K"], "")
        self.assertAlmostEqual(float(rows["b"]["temperature_max_C"])
                               - float(rows["b"]["flash_temperature_K"]), 85.0, places=9)
        self.assertEqual([rows[name]["status"] for name in "cdf"], ["bad_argument"] * 3)
        self.assertLess(float(rows["e"]["flash_temperature_K"]),
                        float(rows["b"]["flash_temperature_K"]))
        self.assertLess(float(rows["e"]["friction_power_N"]), float(rows["b"]["friction_power_N"]))
