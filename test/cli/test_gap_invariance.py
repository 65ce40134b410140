"""What must not count in a gap: where its heights count from, in which units lengths and moduli
are, and how large numbers may be."""

import math
import random

import methods
from cli_program import ProgramTest, rows_of

COLUMNS = ("case,gap_file,E_MPa,nu,mu,N_N,given_penetration_mm,cksi,ceta,cphi_rad_per_mm")
NORMAL = tuple(methods.listed("normal", core_only=False))
# What is made of a gap without solving it.
GUESSES = "kpec", "kpec_strips", "analyn"
TANGENTIAL = tuple(name for name in methods.listed("tangential") if name != "none")
OFFSETS = (0.0, 1e-6, -1e-6, 1e-3, -1e-3, 1.0, -1.0, 1e3, -1e3)
E = 210000.0


def places(step, half_width):
    n = round(half_width / step)
    return [i * step for i in range(-n, n + 1)]


def gap_shapes(seed):
    """Heights over places: smooth, two patches, waves, noise, a wall, fill values."""
    rng = random.Random(seed)
    r, c = rng.uniform(100.0, 2000.0), rng.uniform(-2.0, 2.0)
    noise = [rng.gauss(0.0, 3e-4) for _ in range(401)]
    y = places(0.1, 20.0)
    smooth = [(a - c) ** 2 / (2.0 * r) for a in y]
    return {
        "smooth": (y, smooth),
        "cubic": (y, [abs(a - c) ** 3 / 9000.0 for a in y]),
        "two": (y, [min((a - 6.0) ** 2 / 300.0, (a + 5.0) ** 2 / 500.0 + 0.004) for a in y]),
        "waves": (y, [b + 0.003 * math.sin(3.0 * a) * math.sin(7.0 * a)
                      for a, b in zip(y, smooth)]),
        "noise": (y, [b + n for b, n in zip(smooth, noise)]),
        "wall": (y, [b + (9.0 if a > 12.0 else 0.0) for a, b in zip(y, smooth)]),
        "fill": (y, [b if abs(a) < 15.0 else -999.0 for a, b in zip(y, smooth)]),
        "spike": (y, [b if abs(a - 11.0) > 0.05 else -50.0 for a, b in zip(y, smooth)])}


class GapInvariance(ProgramTest):
    def gap(self, name, y, h, inv2r=1.0 / 920.0):
        text = "\n".join(f"{a!r},{b!r},{inv2r!r}" for a, b in zip(y, h))
        self.write(f"{name}.csv", f"y_mm,h_mm,inv2R_per_mm\n{text}\n")

    def batch(self, rows, *words):
        """Rows of results by name; a row is a name and the cells behind it."""
        self.write("rows.csv", "\n".join([COLUMNS] + [
            ",".join(map(str, row)) for row in rows]) + "\n")
        done = self.run_program("batch", "rows.csv", *words)
        self.assertIn(done.returncode, (0, 1, 3), done.stderr)
        for word in ("NaN", "Infinity"):
            self.assertNotIn(word, done.stderr)
        found = {row["case"]: row for row in rows_of(done.stdout)}
        self.assertEqual(set(found), {str(row[0]) for row in rows}, done.stderr)
        return found

    def case(self, name, gap, demand):
        self.write(name, f"&contact\n gap_file = '{gap}'\n {demand}\n/\n&material\n mu = 0.3\n/\n"
                         "&motion\n cksi = 0.001\n/\n")

    def test_heights_count_from_anywhere(self):
        shapes = gap_shapes(1)
        rows = []
        lowest = {}
        for name, (y, h) in shapes.items():
            lowest[name] = min(h)
            for k, offset in enumerate(OFFSETS):
                file = f"{name}{k}"
                self.gap(file, y, [b + offset for b in h])
                rows += [(f"{file} load", f"{file}.csv", E, 0.28, 0.3, 8e4, "", 1e-3, 0, 1e-4),
                         (f"{file} depth", f"{file}.csv", E, 0.28, 0.3, "",
                          repr(lowest[name] + 0.05 + offset), 1e-3, 0, 1e-4)]
        for method in NORMAL:
            found = self.batch(rows, "--normal", method)
            for name in shapes:
                for demand in ("load", "depth"):
                    first = found[f"{name}0 {demand}"]
                    for k, offset in enumerate(OFFSETS):
                        row = found[f"{name}{k} {demand}"]
                        what = (method, name, demand, offset)
                        self.assertEqual(row["status"], first["status"], what)
                        if name in ("fill", "spike"):
                            self.assertNotEqual(row["status"], "ok", what)
                            self.assertEqual(row["pmax_MPa"], "", what)
                        # Where patches meet, no penetration of these has the load.
                        if not first["pmax_MPa"] or (method in GUESSES
                                                     and name in ("waves", "noise")):
                            continue
                        # In waves and noise auto may take other strips.
                        waves = method == "auto" and name in ("waves", "noise")
                        self.assert_close(float(row["penetration_mm"]) - lowest[name] - offset,
                                          float(first["penetration_mm"]) - lowest[name],
                                          relative=1e-2 if waves else 1e-5, what=what)
                        for figure in ("pmax_MPa", "area_mm2", "Fx_N"):
                            relative = 1e-4 if method == "auto" else 1e-5
                            self.assert_close(float(row[figure]), float(first[figure]),
                                              relative=0.1 if waves else relative,
                                              what=(*what, figure))

    def test_units_do_not_count(self):
        y = places(0.1, 20.0)
        gaps = {"smooth": ([a * a / 600.0 for a in y], 1.0 / 920.0),
                "wavy": ([a * a / 600.0 + 0.01 * math.cos(a) for a in y], 1.0 / 920.0),
                "flat": ([a * a / 2.0e4 for a in y], 1.0 / 920.0),
                "long": ([a * a / 600.0 for a in y], 1.0e-6)}
        # Powers of two: all digits but those of powers of 1/3.
        scales = [(1.0, 1.0), (2.0 ** 10, 1.0), (2.0 ** -10, 1.0), (1.0, 2.0 ** 10),
                  (1.0, 2.0 ** -10), (2.0 ** 10, 2.0 ** -10)]
        rows = []
        for name, (h, inv2r) in gaps.items():
            for k, (length, modulus) in enumerate(scales):
                self.gap(f"{name}{k}", [a * length for a in y], [b * length for b in h],
                         inv2r / length)
                rows.append((f"{name}{k}", f"{name}{k}.csv", repr(E * modulus), 0.28, 0.3,
                             repr(5e4 * modulus * length ** 2), "", 1e-3, -5e-4,
                             repr(1e-4 / length)))
        ways = [(normal, "fastsim") for normal in methods.listed("normal") if normal != "auto"] + [
            ("strip", tangential) for tangential in TANGENTIAL]
        for normal, tangential in ways:
            found = self.batch(rows, "--normal", normal, "--tangential", tangential)
            for name in gaps:
                first = found[f"{name}0"]
                for k, (length, modulus) in enumerate(scales):
                    row = found[f"{name}{k}"]
                    what = (normal, tangential, name, k)
                    self.assertEqual(row["status"], first["status"], what)
                    if not first["pmax_MPa"]:
                        continue
                    for figure, unit in (("pmax_MPa", modulus), ("area_mm2", length ** 2),
                                         ("penetration_mm", length),
                                         ("Fx_N", modulus * length ** 2),
                                         ("Fy_N", modulus * length ** 2),
                                         ("Mz_Nmm", modulus * length ** 3)):
                        if row[figure]:
                            self.assert_close(float(row[figure]) / unit, float(first[figure]),
                                              relative=1e-9, what=(*what, figure))

    def test_analyn_is_hertz_at_any_radius_across(self):
        for radius in (6e2, 6e3, 2e4, 5e4, 1e6):
            half = 4.0 * math.sqrt(0.05 * 2.0 * radius)
            y = places(half / 100.0, half)
            self.gap("gap", y, [a * a / (2.0 * radius) for a in y])
            self.case("case.nml", "gap.csv", "load_N = 1e5")
            pair = []
            for method in ("hertz", "analyn"):
                done = self.run_program("contact", "case.nml", "--normal", method)
                pair.append(rows_of(done.stdout)[0])
            for figure in ("pmax_MPa", "penetration_mm", "area_mm2"):
                self.assert_close(float(pair[1][figure]), float(pair[0][figure]), relative=1e-3,
                                  what=(radius, figure))

    def test_elements_fit_a_small_contact(self):
        y = places(0.1, 10.0)
        self.gap("gap", y, [a * a / 600.0 for a in y])
        sizes = []
        for load in ("10", "1", "1e-3", "1e5"):
            self.case("case.nml", "gap.csv", f"load_N = {load}")
            found = {}
            for method in ("hertz", "norm"):
                done = self.succeed("contact", "case.nml", "--normal", method, "--tangential",
                                    "tang")
                found[method] = rows_of(done.stdout)[0]
            self.assertEqual(found["norm"]["status"], "ok", load)
            for figure in ("pmax_MPa", "penetration_mm", "area_mm2"):
                self.assert_close(float(found["norm"][figure]), float(found["hertz"][figure]),
                                  relative=0.05 if figure == "area_mm2" else 0.01,
                                  what=(load, figure))
            if load != "1e5":
                self.assert_close(float(found["hertz"]["Fx_N"]), float(found["norm"]["Fx_N"]),
                                  relative=0.01, what=load)
                sizes.append(float(found["norm"]["area_mm2"]) / float(load) ** (2.0 / 3.0))
        # One contact in other units
        self.assert_close(sizes[0], sizes[2], relative=0.01)
        # Sides that are given stay.
        done = self.run_program("contact", "case.nml", "--normal", "norm")
        given = self.run_program("contact", "case.nml", "--normal", "norm", "--element-dx", "0.2",
                                 "--element-dy", "0.2")
        row, other = (rows_of(run.stdout)[0] for run in (done, given))
        self.assertEqual(row["pmax_MPa"], other["pmax_MPa"])

    def test_no_number_is_too_large_to_end(self):
        y = places(0.1, 20.0)
        self.gap("gap", y, [a * a / 600.0 for a in y])
        for demand in ("penetration_mm = 1e220", "penetration_mm = 1e300", "penetration_mm = 1e60",
                       "penetration_mm = 1e-300", "load_N = 1e300", "load_N = 1e-300"):
            self.case("case.nml", "gap.csv", demand)
            for method in NORMAL:
                done = self.run_program("contact", "case.nml", "--normal", method, "--tangential",
                                        "none")
                self.assertIn(done.returncode, (0, 1, 3), (demand, method))
                self.assertNotIn("NaN", done.stderr + done.stdout, (demand, method))
                self.assertNotIn("Infinity", done.stderr + done.stdout, (demand, method))
        rows = [("a", "gap.csv", E, 0.28, 0.3, "", "1e220", 0, 0, 0),
                ("b", "gap.csv", E, 0.28, 0.3, 1e5, "", 1e-3, 0, 0)]
        found = self.batch(rows)
        self.assertEqual((found["a"]["status"], found["b"]["status"]), ("out_of_range", "ok"))

    def test_elements_of_any_size_have_a_message_without_nan(self):
        y = places(0.1, 20.0)
        self.gap("gap", y, [a * a / 600.0 for a in y])
        for load in ("1e-15", "1e-30"):
            self.case("case.nml", "gap.csv", f"load_N = {load}")
            for words in ((), ("--element-dx", "0.2", "--element-dy", "0.2")):
                done = self.run_program("contact", "case.nml", "--normal", "norm",
                                        "--tangential", "none", *words)
                self.assertNotIn("NaN", done.stderr + done.stdout, (load, words))

    def test_poissons_ratio_is_that_of_a_body(self):
        y = places(0.1, 20.0)
        self.gap("gap", y, [a * a / 500.0 for a in y])
        for nu in ("-0.5", "-1e-9", "0.5", "0.7", "-1"):
            for method in NORMAL:
                row = self.batch([("a", "gap.csv", E, nu, 0.3, 1e5, "", 3e-4, 0, 0)], "--normal",
                                 method)["a"]
                self.assertEqual(row["status"], "bad_material", (nu, method))
                self.assertEqual(row["Fx_N"], "")
            done = self.run_program("lookup", "make", "--nu", nu, "-o", "t.fslt")
            self.assertEqual(done.returncode, 2, done.stderr)
        found = self.batch([("a", "gap.csv", E, nu, 0.3, 1e5, "", 3e-4, 0, 0)
                            for nu in (0, 0.4999)])
        self.assertEqual(found["a"]["status"], "ok")

    def test_no_share_of_stick_is_above_one(self):
        y = places(0.1, 20.0)
        rng = random.Random(2)
        rows = []
        for k in range(30):
            r = rng.uniform(100.0, 2000.0)
            self.gap(f"g{k}", y, [a * a / r for a in y], rng.uniform(3e-4, 3e-3))
            rows.append((f"{k}", f"g{k}.csv", E, 0.28, 0.3, rng.uniform(1e3, 1e5), "",
                         rng.choice((0, 1e-12, 1e-9)), 0, 0))
        for tangential in TANGENTIAL:
            for normal in ("strip", "hertz"):
                for row in self.batch(rows, "--normal", normal, "--tangential",
                                      tangential).values():
                    if row["stick_fraction"]:
                        self.assertLessEqual(float(row["stick_fraction"]), 1.0,
                                             (normal, tangential))
