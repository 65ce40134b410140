"""Gaps with walls, steps and fill values, by `faststrip batch`."""

import random

from cli_program import BATCH_COLUMNS, ProgramTest, rows_of

FIGURES = ("penetration_mm", "pmax_MPa", "area_mm2")
METHODS = ("strip", "hertz", "equal_area", "norm", "auto")
CASE = f"{2.0 * 82000.0 * 1.28!r},0.28,0.3,1e5,0.001,0,1e-4"
# The patch of this load on this gap
CURVATURE = 0.002
PATCH = 4.935


def places(step, half_width):
    n = round(half_width / step)
    return [i * step for i in range(-n, n + 1)]


def parabola(y):
    return CURVATURE * y * y


class Cliffs(ProgramTest):
    def solve(self, gaps, *words, code=0):
        """The rows of some gaps: lists of places and heights by name."""
        lines = [BATCH_COLUMNS]
        for name, (y, h) in gaps.items():
            text = "\n".join(f"{a!r},{b!r},{1.0 / 920.0!r}" for a, b in zip(y, h))
            self.write(f"{name}.csv", f"y_mm,h_mm,inv2R_per_mm\n{text}\n")
            lines.append(f"{name},{name}.csv,{CASE}")
        self.write("cases.csv", "\n".join(lines) + "\n")
        done = self.run_program("batch", "cases.csv", "--tangential", "none", *words)
        self.assertEqual(done.returncode, code, done.stderr)
        return {row["case"]: row for row in rows_of(done.stdout)}, done.stderr

    def same(self, row, clean, what):
        self.assertEqual((row["status"], clean["status"]), ("ok", "ok"), what)
        for name in FIGURES:
            # A tenth of the strips' tolerance.
            self.assert_close(float(row[name]), float(clean[name]), relative=2e-8,
                              what=(what, name))

    def test_a_wall_outside_is_not_seen(self):
        gaps = {}
        for step in (0.05, 0.2, 0.5):
            y = places(step, 20.0)
            gaps[f"clean {step}"] = y, [parabola(a) for a in y]
            gaps[f"wall at 12 {step}"] = y, [parabola(a) if abs(a) <= 12.0 else 10.0 for a in y]
            y = places(step, 70.0)
            gaps[f"wall at 60 {step}"] = y, [parabola(a) + (9.0 if a > 60.0 else 0.0) for a in y]
        for method in METHODS[:3] + ("norm",):
            rows, _ = self.solve(gaps, "--normal", method)
            for name, row in rows.items():
                self.same(row, rows[f"clean {name.split()[-1]}"], (method, name))
        # auto tells steps of rounding apart; its choice is the same
        rows, _ = self.solve(gaps, "--normal", "auto")
        self.assertEqual({row["status"] for row in rows.values()}, {"ok"})

    def test_walls_of_any_height_at_any_place(self):
        random_numbers = random.Random(7)
        gaps = {}
        for number in range(120):
            step = 10.0 ** random_numbers.uniform(-1.7, 0.0)
            half_width = random_numbers.choice((15.0, 15.0, 110.0)) if step > 0.1 else 12.0
            y = places(step, half_width)
            from_edge = random_numbers.choice((0.0, 1.0, half_width))
            foot = PATCH + 2.0 * step + from_edge * random_numbers.random()
            height = 10.0 ** random_numbers.uniform(-3.0, 6.0)
            sides = random_numbers.choice(((1,), (-1,), (-1, 1)))
            gaps[f"clean{number}"] = y, [parabola(a) for a in y]
            gaps[f"wall{number}"] = y, [
                parabola(a) + (height if any(s * a > foot for s in sides) else 0.0) for a in y]
        rows, _ = self.solve(gaps)
        for number in range(120):
            self.same(rows[f"wall{number}"], rows[f"clean{number}"], number)

    def test_a_wall_in_the_patch_is_right_or_named(self):
        random_numbers = random.Random(3)
        gaps = {}
        for number in range(40):
            step = random_numbers.choice((0.05, 0.1, 0.2, 0.5))
            y = places(step, 12.0)
            foot = PATCH * random_numbers.uniform(0.2, 1.05)
            height = 10.0 ** random_numbers.uniform(-3.0, 5.0)
            two_sided = random_numbers.random() < 0.4
            gaps[f"{number}"] = y, [
                parabola(a) + (height if (abs(a) if two_sided else a) > foot else 0.0) for a in y]
        strips, _ = self.solve(gaps)
        norm, _ = self.solve(gaps, "--normal", "norm", "--element-dx", "0.1", "--element-dy", "0.1")
        ok = [name for name, row in strips.items() if row["status"] == "ok"]
        self.assertGreater(len(ok), 2)
        self.assertLess(len(ok), 30)
        for name in ok:
            for figure in FIGURES[:2]:
                self.assert_close(float(strips[name][figure]), float(norm[name][figure]),
                                  relative=0.01, what=(name, figure))

    def test_fill_values_are_walls_or_refused(self):
        for step in (0.05, 0.2, 0.5):
            y = places(step, 20.0)

            def filled(*values):
                return y, [parabola(a) if abs(a) < 12.0 else values[i % len(values)]
                           for i, a in enumerate(y)]

            above = {"clean": (y, [parabola(a) for a in y]), "1e10": filled(1e10),
                     "999": filled(999.0), "1e30": filled(1e30),
                     "mixed": filled(1e10, 9999.0), "three": filled(1e10, 999.0, 9999.0)}
            below = {"-999": filled(-999.0), "-1": filled(-1.0), "-9999": filled(-9999.0),
                     "mixed": filled(1e10, -999.0), "all": filled(999.0, -999.0, 9999.0)}
            for method in METHODS:
                rows, _ = self.solve(above, "--normal", method)
                for name, row in rows.items():
                    if method != "auto":
                        self.same(row, rows["clean"], (method, step, name))
                    self.assertEqual(row["status"], "ok", (method, step, name))
                rows, said = self.solve(below, "--normal", method, code=1)
                for name, row in rows.items():
                    self.assertNotEqual(row["status"], "ok", (method, step, name))
                    if row["penetration_mm"]:
                        self.assertGreater(float(row["penetration_mm"]), 0.0, (method, name))
                if method not in ("hertz", "equal_area"):
                    self.assertIn("must not hold fill values below the gap: -999.000 mm", said)
