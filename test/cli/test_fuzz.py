"""`faststrip fuzz`: random gaps, a few of the cases of `./run fuzz`."""

from cli_program import ProgramTest, rows_of

FAMILIES = {"hertz", "several", "merging", "small_second", "kinks", "flat_top", "wavy",
            "conformal", "concave", "varying_a", "negative_a", "measured", "edge", "mixed"}


class Fuzz(ProgramTest):
    def test_no_case_fails_a_check(self):
        for solver in ("strip", "lattice"):
            with self.subTest(solver):
                done = self.run_program("fuzz", "--cases", 80, "--first", 2001, "--solver", solver,
                                        "-o", "cases.csv")
                self.assertEqual(done.returncode, 0, done.stdout)
                rows = self.read("cases.csv")
                self.assertEqual([int(row["case"]) for row in rows], list(range(2001, 2081)))
                self.assertLessEqual({row["family"] for row in rows}, FAMILIES)
                for row in rows:
                    if row["status"] == "no_finite_patch":
                        self.assertIn(row["family"], {"negative_a", "varying_a", "mixed"}, row)
                        self.assertIn("positive nowhere", row["message"], row)
                        continue
                    self.assertLess(abs(float(row["load_error"])), 1e-6, row)
                    self.assertGreater(float(row["pmax_MPa"]), 0.0, row)

    def test_what_did_not_settle_once_settles(self):
        """Slender contacts and jumps of 1/(2R), where passes used to go back and forth."""
        for case in (42, 98, 770, 832, 947, 950):
            with self.subTest(case):
                done = self.run_program("fuzz", "--cases", 1, "--first", case, "-o", "case.csv")
                self.assertEqual(done.returncode, 0, done.stdout)
                row = self.read("case.csv")[0]
                self.assertNotIn(row["status"], ("fallback_used", "fewer_strips"), row)
                self.assertLess(int(row["iterations"]), 300, row)

    def test_a_punch_gets_the_answer_of_the_lattice(self):
        """A contact over all of its 29 points, so hard that Newton's steps go astray."""
        done = self.run_program("fuzz", "--case", 906, "-o", "case.csv")
        self.assertEqual(done.returncode, 0, done.stdout)
        row = self.read("case.csv")[0]
        self.assertEqual(row["status"], "fallback_used", row)
        self.assertIn("end of the gap data", row["message"], row)
        self.assertLess(int(row["iterations"]), 300, row)

    def test_overlap_outside_is_named(self):
        for case in (1400, 1603, 1936, 2511, 2611, 6120, 6285, 11300, 11389, 11783, 21260,
                     36154, 75150, 75577, 96296):
            with self.subTest(case):
                done = self.run_program("fuzz", "--cases", 1, "--first", case, "-o", "case.csv")
                self.assertEqual(done.returncode, 0, done.stdout)
                row = self.read("case.csv")[0]
                if float(row["overlap"]) > 0.02:
                    self.assertIn("overlap", row["status"] + row["message"], row)

    def test_a_case_is_the_same_wherever_the_run_starts(self):
        for words, name in ((("--first", 11, "--cases", 20), "many.csv"),
                            (("--first", 30, "--cases", 1), "one.csv")):
            self.assertEqual(self.run_program("fuzz", *words, "-o", name).returncode, 0)
        many, one = self.read("many.csv")[-1], self.read("one.csv")[0]
        for name in many:
            if name != "time_us":
                self.assertEqual(many[name], one[name], name)

    def test_gap_of_a_case_can_be_solved_alone(self):
        self.assertEqual(self.run_program("fuzz", "--first", 30, "--cases", 1, "-o",
                                          "one.csv").returncode, 0)
        done = self.run_program("fuzz", "--gap-of", 30, "-o", "gap.csv")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        text = (self.folder / "gap.csv").read_text(encoding="utf-8")
        rows = rows_of(text)
        self.assertEqual(len(rows), int(self.read("one.csv")[0]["points"]))
        self.assertEqual(list(rows[0]), ["y_mm", "h_mm", "inv2R_per_mm"])
        self.assertRegex(text, r"\A# random gap 30 of seed 1: ")
        other = self.run_program("fuzz", "--gap-of", 30, "--seed", 2).stdout
        self.assertNotEqual(rows_of(other)[0], rows[0])

    def test_usage_errors(self):
        for words, says in ((["--cases", "0"], "0"), (["--first", "0"], "0"),
                            (["--seed", "-1"], "-1"), (["--gap-of", "0"], "0"),
                            (["--solver", "newton"], "newton")):
            with self.subTest(words):
                self.refused(2, "fuzz", *words, says=[says])

    def test_rows_of_two_runs_make_one_table(self):
        tables = {}
        for words, name in ((("--cases", 8), "all.csv"), (("--cases", 5), "1.csv"),
                            (("--first", 6, "--cases", 3), "2.csv")):
            tables[name] = self.run_program("fuzz", *words, "-o", name)
        lines = (self.folder / "2.csv").read_text(encoding="utf-8").splitlines()
        rows = [line for line in lines if not line.startswith("#")][1:]
        with (self.folder / "1.csv").open("a", encoding="utf-8") as joined:
            joined.write("\n".join(rows) + "\n")
        read = self.run_program("fuzz", "--read", "1.csv")
        share = [line for line in read.stdout.splitlines() if " %  " in line]
        whole = [line for line in tables["all.csv"].stdout.splitlines() if " %  " in line]
        self.assertEqual(share, whole)
        self.assertIn("slowest, ms:", read.stdout)
        self.assertEqual(self.run_program("fuzz", "--case", 6).returncode, 0)
        self.refused(2, "fuzz", "--case", 6, "--cases", 2, says=["--case"])
