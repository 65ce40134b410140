"""`faststrip-lab bench extremes`: each row a figure or a status, figures within bounds."""

import math

from cli_program import ROOT, LabTest

COLUMNS = "chapter,case,method,x_name,x,y_name,y,quantity,value,reference,status".split(",")
FOLDERS = ("--contacts", ROOT / "reference" / "contact",
           "--references", ROOT / "reference" / "influence",
           "--examples", ROOT / "example" / "cases")
PARTS = {
    "influence": {"influence", "references"},
    "normal": {"strips", "ellipses", "flat_gaps"},
    "tangential": {"tangential"},
    "noise": {"noise", "load_steps"},
    "rounding": {"rounding"},
}


class Extremes(LabTest):
    def extremes(self, *words):
        rows = self.written("bench", "extremes", "--quick", *FOLDERS, *words)
        for row in rows:
            if row["value"] == "":
                self.assertNotIn(row["status"], ("", "ok", "jump"), row)
            else:
                row["value"] = float(row["value"])
                self.assertTrue(math.isfinite(row["value"]), row)
        return rows

    def part(self, name):
        rows = self.extremes("--only", name)
        self.assertEqual({row["chapter"] for row in rows}, PARTS[name])
        return rows

    def largest(self, rows, **words):
        """The largest value of the rows with these words; there has to be one."""
        values = [row["value"] for row in rows if row["value"] != ""
                  and all(row[name] == word for name, word in words.items())]
        self.assertTrue(values, words)
        return max(values)

    def test_all_parts(self):
        rows = self.extremes()
        self.assertEqual(list(rows[0]), COLUMNS)
        self.assertEqual({row["chapter"] for row in rows}, set().union(*PARTS.values()))
        found = "value", "reference", "status"
        places = [tuple(row[name] for name in COLUMNS if name not in found)
                  for row in rows if row["chapter"] != "references"]
        self.assertEqual(len(places), len(set(places)), "a row twice")

    def test_influence(self):
        rows = self.part("influence")
        centre = [row for row in rows if row["case"] == "centre"]
        beside = [row for row in rows if row["y_name"] == "X" and row["chapter"] == "influence"]
        self.assertLess(min(float(row["x"]) for row in centre), 1.1e-12)
        self.assertGreater(max(float(row["x"]) for row in centre), 0.9e12)
        self.assertLess(self.largest(centre, method="closed"), 1e-15)
        self.assertLess(self.largest(centre, method="column"), 1e-15)
        self.assertLess(self.largest(centre, method="gsl"), 3e-15)
        self.assertLess(self.largest(beside, method="closed"), 1e-12)
        # With derivatives, for one point and for many.
        self.assertLess(self.largest(beside, method="gradient"), 1e-11)
        self.assertLess(self.largest(beside, method="column"), 1e-11)
        # The judge is better than the judged.
        self.assertLess(self.largest(rows, chapter="references", method="quad"), 3e-16)
        # The table is right to a percent where it stands, and says so elsewhere.
        for method, bound in (("published", 1e-2), ("refit", 1e-4)):
            self.assertTrue(1e-9 < self.largest(centre, method=method) < bound, method)
            for row in centre:
                if row["method"] == method and not 0.009 < float(row["x"]) < 11.0:
                    self.assertEqual((row["value"], row["status"]), ("", "out_of_range"))

    def test_normal(self):
        rows = self.part("normal")
        for row in rows:
            # Some are as large as the bodies, which the solver says and Hertz does not mind.
            self.assertIn(row["status"], ("ok", "conformal"), row)
            if row["chapter"] != "ellipses":
                self.assertEqual(row["status"], "ok", row)
        for chapter in ("ellipses", "flat_gaps"):
            for quantity in ("penetration_err", "pmax_err", "area_err"):
                self.assertTrue(1e-6 < self.largest(rows, chapter=chapter, quantity=quantity)
                                < 1e-2, (chapter, quantity))
        errors = {}
        for row in rows:
            if row["chapter"] != "strips":
                continue
            if row["quantity"] == "penetration_err":
                errors.setdefault(row["x"], {})[float(row["y"])] = row["value"]
            elif row["quantity"] == "condition":
                self.assertTrue(1.0 < row["value"] < 1e3, row)
        for of_ratio in errors.values():
            # Three strips are few for what their penetration is corrected by.
            falling = [of_ratio[strips] for strips in sorted(of_ratio)][1:]
            self.assertEqual(falling, sorted(falling, reverse=True))

    def test_tangential(self):
        rows = self.part("tangential")
        methods = {row["method"] for row in rows}
        self.assertLessEqual({"faststrip", "fastsim", "linear"}, methods)
        # Linear theory knows no friction.
        for method in methods - {"linear"}:
            # Full slip gives all of mu N, and no more; the paper's method not quite all.
            most = self.largest(rows, method=method, quantity="force")
            self.assertTrue(0.99 < most < 1.0 + 1e-13, (method, most))
            self.assertLess(self.largest(rows, method=method, quantity="oddness"), 1e-14)
            self.assertEqual(self.largest(rows, method=method, quantity="negative_power"), 0.0)
            self.assertTrue(1e-8 < self.largest(rows, method=method, quantity="step") < 2e-6)
        for row in rows:
            if row["quantity"] == "force" and row["method"] != "linear" \
                    and 0.0 in (float(row["x"]), float(row["y"])):
                self.assertEqual(row["value"], 0.0, row)

    def test_noise(self):
        rows = [row for row in self.part("noise") if row["chapter"] == "noise"]
        self.assertLess(self.largest(rows, quantity="other_status"), 0.5)
        self.assertNotIn("jump", {row["status"] for row in rows})
        for row in rows:
            # No figure takes part in more than 120 times the noise; edges follow curvatures.
            if row["quantity"] != "other_status":
                self.assertLess(row["value"], 120.0 * float(row["x"]) + 1e-14, row)
        self.assertGreater(self.largest(rows, quantity="pmax"), 1e-9, "no noise was made")

    def test_rounding(self):
        rows = self.part("rounding")
        centre = [row for row in rows if row["quantity"] == "influence" and float(row["y"]) == 0.0]
        self.assertTrue(1e-17 < self.largest(centre) < 1e-13)
        # The library rounds to nearest whatever its host does; its solvers alone do not.
        for row in rows:
            if row["method"] == "strip+faststrip":
                self.assertEqual(row["value"], 0.0, row)
        self.assertGreater(self.largest(rows, method="solvers alone"), 1e-17)

    def test_refused(self):
        for words, says in ((["extremes", "--only", "guess"], "guess"),
                            (["extremes", "--rounds", "3"], "--rounds"),
                            (["extremes", "--seconds", "1"], "--seconds"),
                            (["normal", "--quick"], "--quick"),
                            (["accuracy", "--examples", "x"], "--examples")):
            self.refused(2, "bench", *words, says=[says])
        self.refused_and_untouched("bench", "extremes", "--quick", "--only", "influence",
                                   "--references", "nowhere", says=["nowhere"])
        self.refused_and_untouched("bench", "extremes", "--quick", "--only", "noise", *FOLDERS[:4],
                                   "--examples", "nowhere", says=["nowhere"])
