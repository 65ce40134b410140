"""`faststrip-lab bench integral`: the file it writes. Times are the machine's; errors are ours."""

from cli_program import LabTest

COLUMNS = ["method", "n", "b", "loop", "ns", "ratio", "rel_err", "flags", "compiler", "cpu",
           "ns_p95", "ns_worst"]
METHODS = {"published", "refit 6", "refit 9", "refit 12", "closed", "gsl 1-D", "gsl 2-D"}


class Bench(LabTest):
    def bench(self):
        """The rows of one run for all tests: it takes seconds."""
        printed = self.good("bench", "integral", "--rounds", "1", "-o", "bench.csv", share=True)
        self.assertEqual(printed, [])
        return self.read("bench.csv")

    def test_every_method_is_timed(self):
        rows = self.bench()
        self.assertEqual(list(rows[0]), COLUMNS)
        scalar = [row for row in rows if row["loop"] == "scalar"]
        row_loop = [row for row in rows if row["loop"] == "row"]
        self.assertEqual(len(scalar) + len(row_loop), len(rows))
        self.assertEqual({row["method"] for row in scalar}, METHODS)
        self.assertEqual({row["method"] for row in row_loop}, METHODS - {"gsl 1-D", "gsl 2-D"})
        for row in rows:
            self.assertGreater(float(row["ns"]), 0.0)
            self.assertLessEqual(float(row["ns"]), float(row["ns_p95"]))
            self.assertLessEqual(float(row["ns_p95"]), float(row["ns_worst"]))
            self.assertGreater(float(row["ratio"]), 0.0)
            self.assertRegex(row["flags"], r"-O\w")
            self.assertTrue(row["compiler"].startswith("GCC"))
            self.assertTrue(row["cpu"])
            if row["method"] == "published":
                self.assertEqual(float(row["ratio"]), 1.0)

    def test_errors_are_those_of_the_methods(self):
        worst = {}
        for row in self.bench():
            worst[row["method"]] = max(worst.get(row["method"], 0.0), float(row["rel_err"]))
        self.assertLess(worst["closed"], 2e-15)
        self.assertLess(worst["gsl 1-D"], 2e-15)
        self.assertLess(worst["gsl 2-D"], 1e-11)
        self.assertLess(worst["published"], 2.3e-2)
        self.assertGreater(worst["published"], 1e-2)
        self.assertLess(worst["refit 12"], worst["refit 9"])
        self.assertLess(worst["refit 9"], worst["refit 6"])

    def test_what_it_refuses(self):
        self.refused(2, "bench")
        self.refused(2, "bench", "strips", says=["strips"])
        self.refused(2, "bench", "integral", "--rounds", "0", says=["--rounds"])
        self.refused(1, "bench", "integral", "--rounds", "1", "-o", "/dev/null/folder.csv")
