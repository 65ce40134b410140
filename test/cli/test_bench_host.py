"""`faststrip-lab bench host`: the walks of its table, and that they measure. Times are the
machine's."""

import itertools

from cli_program import ROOT, LabTest

COLUMNS = ("pair,walk,step_um,demand,with,calls,ok_share,cpu_us_median,cpu_us_p95,cpu_us_worst,"
           "worst_y_mm,fastsim_us,ratio,solutions_median,solutions_worst,kinstructions_median,"
           "kinstructions_worst,cpu").split(",")
PAIRS = ("s1002 on 60e1", "worn_wheel.txt on 60e1")
WALKS = {"straight": (-0.5, 0.5), "curve": (3.0, 4.0), "two contacts": (5.0, 6.0),
         "flange root": (6.5, 7.5), "all": (-8.0, 8.0)}
DEMANDS = ("z given", "loads", "free roll")
WANTED = ("forces", "estimates", "derivatives")
NOT_COUNTED = "faststrip-lab: instructions cannot be counted on this machine"


class Host(LabTest):
    def test_walks(self):
        done = self.run_program("bench", "host", "--quick", "--rounds", "1", "-o", "host.csv")
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        rows = self.read("host.csv")
        self.assertEqual(list(rows[0]), COLUMNS)
        kinds = [(pair, walk, step, demand, wanted)
                 for pair, walk in itertools.product(PAIRS, WALKS)
                 for step in ((500.0,) if walk == "all" else (1.0, 10.0, 100.0))
                 for demand, wanted in itertools.product(DEMANDS, WANTED)]
        self.assertEqual([(row["pair"], row["walk"], float(row["step_um"]), row["demand"],
                           row["with"]) for row in rows], kinds)
        counts = NOT_COUNTED not in done.stderr
        for row in rows:
            times = [float(row[f"cpu_us_{name}"]) for name in ("median", "p95", "worst")]
            self.assertEqual(times, sorted(times), row)
            self.assertGreater(times[0], 0.0, row)
            self.assert_close(float(row["ratio"]), times[0] / float(row["fastsim_us"]), 1e-12)
            self.assertEqual(int(row["calls"]), 32 if row["walk"] == "all" else 5, row)
            first, last = WALKS[row["walk"]]
            if row["walk"] != "all":
                first, last = (first + n * 1e-3 * float(row["step_um"]) for n in (0.999, 5.001))
            self.assertTrue(first < float(row["worst_y_mm"]) <= last, row)
            solved = float(row["solutions_median"]), float(row["solutions_worst"])
            self.assertTrue(2.0 <= solved[0] <= solved[1], row)
            # One a contact where z is given; a free roll takes several.
            if row["demand"] == "z given":
                self.assertTrue(solved[0] == 2.0 and solved[1] <= 4.0, row)
            elif row["demand"] == "free roll":
                self.assertGreater(solved[0], 2.0, row)
            # Estimates may call a contact under-resolved; nothing else may be wrong on a tread.
            least = 0.95 if row["with"] == "forces" and row["walk"] in ("straight", "curve") else 0
            self.assertTrue(least <= float(row["ok_share"]) <= 1.0, row)
            for name in ("kinstructions_median", "kinstructions_worst"):
                self.assertEqual(row[name] != "", counts, row)
                if counts:
                    self.assertTrue(1e2 < float(row[name]) < 1e6, row)
        # No wheelset is timed where it is not solved.
        for row in rows:
            if row["walk"] == "all" and row["with"] != "estimates":
                self.assertGreater(float(row["ok_share"]), 0.9, row)
        self.assertEqual(done.stderr.count(" times the median, at y = "), 2 * 9)

    def test_what_it_refuses(self):
        self.refused(1, "bench", "host", "--case", "no.nml", says=["no.nml"])
        self.refused(1, "bench", "host", "--quick", "--case",
                     ROOT / "example" / "cases" / "polymer_roller.nml", says=["wheel"])
        self.refused(2, "bench", "host", "--strips", "9", says=["--strips"])
