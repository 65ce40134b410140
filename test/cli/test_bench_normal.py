"""`faststrip-lab bench normal`, `accuracy`, `convergence`: the columns, and that they measure."""

import math
import statistics

from cli_program import GAPS, ROOT, LabTest

CONTACTS = ROOT / "reference" / "contact"


class Bench(LabTest):
    def setUp(self):
        super().setUp()
        # Three of the twenty contacts.
        lines = (CONTACTS / "s1002_uic60_B.csv").read_text(encoding="utf-8").splitlines()
        shifts = ("-5", "-1", "2")
        kept = [line for line in lines if line.startswith("#")]
        rows = [line for line in lines if not line.startswith("#")]
        kept += rows[:1] + [row for row in rows if row.split(",")[0] in shifts]
        self.write("contacts/s1002_uic60_B.csv", "\n".join(kept) + "\n")
        for shift in shifts:
            name = f"shift_{shift}.csv"
            self.write(f"contacts/gaps/{name}", (GAPS / name).read_text(encoding="utf-8"))

    def bench(self, what, *words):
        done = self.run_program("bench", what, "--contacts", "contacts", "-o", "out.csv", *words)
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        return self.read("out.csv"), done.stderr

    def test_steps(self):
        scenes = (ROOT / "reference" / "scenes" / "scenes.csv").read_text(encoding="utf-8")
        lines = [line for line in scenes.splitlines() if not line.startswith("#")]
        self.write("scenes.csv", "\n".join(lines[:4]) + "\n")
        rows, said = self.bench("steps", "--rounds", "1", "--strips", "9", "--scenes", "scenes.csv")
        self.assertEqual([sum(row["kind"] == kind for row in rows)
                          for kind in ("load", "shift", "both", "cold")], [60, 60, 60, 6])
        for kind in ("load", "shift", "both", "cold"):
            self.assertIn(f"{kind}: ", said)
        for row in rows:
            self.assertEqual((row["status"] in ("ok", "under_resolved"), row["strips"]),
                             (True, "9"), row)
            for name in ("penetration", "pmax", "area"):
                # Where a jump of curvature enters the patch edges are left a little off.
                self.assertLess(abs(float(row["err_" + name])), 3e-4, row)
            self.assertGreater(float(row["cold_us"]), 0)
            if row["kind"] == "load":
                self.assertLessEqual(int(row["iterations"]), 2 * int(row["cold_iterations"]), row)
        # One evaluation of all influence coefficients in most steps.
        self.assertLessEqual(
            statistics.median(int(row["gradients"]) for row in rows if row["kind"] != "cold"),
            2 * 9**2)

    def test_normal(self):
        rows, said = self.bench("normal", "--most-strips", "9", "--seconds", "0.2")
        self.assertEqual(list(rows[0]), (
            "start,strips,us,iterations,ns_per_entry,fastsim_us,ratio,flags,compiler,cpu,gap_us,"
            "case,runs,factorings,ns_per_value,entries_us,algebra_us,cpu_us_median,cpu_us_p95,"
            "cpu_us_worst").split(","))
        for strips in (5, 7, 9):
            self.assertIn(f"{strips} strips, ", said)
            own = [row for row in rows if int(row["strips"]) == strips]
            self.assertEqual({row["start"] for row in own}, {"cold", "warm_load", "warm_shift"})
        # One contact at least was solved from all starts; the first is the same in every run.
        first = {row["start"]: float(row["iterations"]) for row in rows
                 if row["strips"] == "9" and row["case"] == "shift_-5"}
        # Loads go up and down, by six and seven steps: few runs may have the median of either. Of
        # new Jacobians there are fewer in any run.
        self.assertLessEqual(first["warm_load"], first["cold"])
        self.assertLess(first["warm_shift"], first["cold"])
        factorings = {row["start"]: float(row["factorings"]) for row in rows
                      if row["strips"] == "9" and row["case"] == "shift_-5"}
        self.assertLess(factorings["warm_load"], factorings["cold"])
        for row in rows:
            for name in ("us", "iterations", "ns_per_entry", "fastsim_us", "ratio"):
                self.assertGreater(float(row[name]), 0.0, name)
            self.assert_close(float(row["ratio"]), float(row["us"]) / float(row["fastsim_us"]),
                              1e-12)
            # An entry costs tens of nanoseconds: a factor of a hundred is a wrong unit.
            self.assertTrue(1.0 < float(row["ns_per_entry"]) < 1e4, row["ns_per_entry"])
            self.assertGreaterEqual(int(row["runs"]), 1)
            self.assert_spread(row, "cpu_us")
            self.assertTrue(1.0 < float(row["ns_per_value"]) < 1e4, row["ns_per_value"])
            factorings = float(row["factorings"])
            # A load that changes a little needs no new Jacobian.
            if row["start"] == "warm_load":
                self.assertLess(factorings, float(row["iterations"]))
            if row["start"] == "cold":
                self.assertGreaterEqual(factorings, 1.0)
            for name in ("entries_us", "algebra_us"):
                self.assertTrue(0.0 < float(row[name]) < 3.0 * float(row["us"]), name)

        # Hundreds of runs that all take the same time are one run written three times.
        many = [row for row in rows if int(row["runs"]) >= 5]
        self.assertTrue(many)
        self.assertTrue(any(float(row["cpu_us_worst"]) > float(row["cpu_us_median"])
                            for row in many))

    def test_reference(self):
        rows, said = self.bench("reference", "--most-elements", "1000", "--seconds", "0.2")
        self.assertEqual(list(rows[0]), (
            "method,start,tolerance,elements,us,iterations,convolutions,dx_mm,grid,flags,compiler,"
            "cpu,case,runs,cpu_us_median,cpu_us_p95,cpu_us_worst").split(","))
        for elements in (500, 1000):
            self.assertIn(f"{elements} elements, ", said)
        starts = {"new_plans", "cold", "coarse", "strips", "warm_load"}
        rolling = [row for row in rows if row["method"] == "tang"]
        norm = [row for row in rows if row["method"] == "norm"]
        self.assertEqual(len(rolling) + len(norm), len(rows))
        for tolerance in (1e-9, 1e-4):
            first = {row["start"]: row for row in norm if row["case"] == "shift_-5"
                     and float(row["tolerance"]) == tolerance and float(row["dx_mm"]) < 0.4}
            self.assertEqual(set(first), starts)
            self.assertLessEqual(float(first["strips"]["iterations"]),
                                 float(first["cold"]["iterations"]))
            self.assertEqual(first["new_plans"]["iterations"], first["cold"]["iterations"])
        first = {row["start"]: row for row in rolling if row["case"] == "shift_-5"
                 and float(row["dx_mm"]) < 0.4}
        self.assertEqual(set(first), {"new_plans", "cold", "warm_creepage"})
        self.assertEqual(first["new_plans"]["iterations"], first["cold"]["iterations"])
        # A cold start comes from coarser grids, whose iterations are not counted.
        self.assertLess(float(first["warm_creepage"]["iterations"]),
                        2.0 * float(first["cold"]["iterations"]))
        for row in rows:
            self.assert_spread(row, "cpu_us")
            self.assertGreater(float(row["us"]), 0.0)
            self.assertGreaterEqual(float(row["convolutions"]), float(row["iterations"]))
            self.assertGreater(int(row["grid"]), int(row["elements"]))

    def test_accuracy(self):
        rows, said = self.bench("accuracy")
        self.assertEqual([(row["case"], row["strips"]) for row in rows],
                         [(f"shift_{shift}", strips) for strips in ("15", "auto")
                          for shift in ("-5", "-1", "2")])
        self.assertEqual(said.count("penetration"), 2)
        for row in rows:
            self.assertLess(abs(float(row["penetration_err"])), 2e-3)
            self.assertLess(abs(float(row["pmax_err"])), 2e-2)
            self.assertLess(abs(float(row["area_err"])), 1e-2)
            self.assertLess(abs(float(row["ymin_err_mm"])), 0.15)
            self.assertGreaterEqual(int(row["strips_used"]), 15)

    def test_convergence(self):
        rows, _ = self.bench("convergence", "--most-strips", "15")
        self.assertEqual(list(rows[0]), (
            "set,case,method,strips,status,strips_used,iterations,penetration_err,pmax_err,"
            "area_err,ymin_err_mm,ymax_err_mm").split(","))
        self.assertEqual(len(rows), (3 + 12) * 5)
        errors = {}
        for row in rows:
            self.assertEqual(row["status"], "ok")
            if row["case"].startswith("hertz_"):
                errors.setdefault(int(row["strips"]), []).append(abs(float(row["penetration_err"])))
        # Second order in the number of strips.
        order = math.log(statistics.median(errors[5]) / statistics.median(errors[15]), 3)
        self.assertTrue(1.6 < order < 2.6, order)

    def test_robust(self):
        rows, said = self.bench("robust")
        counts = {}
        for row in rows:
            self.assertIn(row["status"], ("fallback_used",) if row["method"] == "cells"
                          else ("ok", "under_resolved"), row)
            self.assertLess(abs(float(row["penetration_err"])), 2e-2, row)
            kind = row["set"], row["method"]
            counts[kind] = counts.get(kind, 0) + 1
        self.assertEqual(counts, {
            ("s1002_uic60", "cells"): 3, ("ellipses", "cells"): 12,
            ("kinks", "strip"): 10 * 4, ("flat_tops", "strip"): 6 * 4})
        self.assertEqual(said.count("mean/max"), 10)
        finest = [abs(float(row["pmax_err"])) for row in rows if row["strips"] == "201"]
        usual = [abs(float(row["pmax_err"])) for row in rows if row["strips"] == "15"]
        self.assertLess(max(finest), 0.02 * max(usual))

    def test_refused(self):
        for words, says in ((["guess"], "guess"), ([], "WHAT"),
                            (["normal", "--rounds", "3"], "--rounds"),
                            (["normal", "--seconds", "-1"], "-1"),
                            (["accuracy", "--seconds", "1"], "--seconds"),
                            (["integral", "--contacts", "x"], "--contacts")):
            self.refused(2, "bench", *words, says=[says])
        self.refused_and_untouched("bench", "accuracy", "--contacts", "nowhere", says=["nowhere"])
