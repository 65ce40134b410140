"""`faststrip-lab fuzz`: random gaps, a few of the cases of `./run fuzz`."""

from cli_program import LabTest, rows_of

FAMILIES = {"hertz", "several", "merging", "small_second", "kinks", "flat_top", "wavy",
            "conformal", "concave", "varying_a", "negative_a", "measured", "edge", "mixed",
            "cliff", "fill", "noise", "exponential", "tanh", "ripples", "neck", "slender", "worn",
            "contacts", "corner", "coarse", "fine", "uneven", "offset", "metres"}

# What no limitation excuses and no gap, however bad, may bring about.
FORM = {"finite", "order", "load", "pmax", "area", "ends", "bound", "moment", "power",
        "force_sign"}

# A planted error, who has to tell it, and in what share of the cases at least.
FAULTS = {
    "penetration_low": ("centre", 1.0),
    "penetration_high": ("centre", 1.0),
    "penetration_slight": ("centre", 1.0),
    "penetration_below": ("depth", 1.0),
    "penetration_size": ("scale", 0.05),
    "pmax_half": ("pmax", 1.0),
    "pmax_high": ("pmax", 0.7),
    "area_double": ("area", 1.0),
    "area_low": ("area", 1.0),
    "traded": ("centre", 1.0),
    "traded_back": ("area", 1.0),
    "traded_all": ("centre", 1.0),
    "pressures_high": ("load", 1.0),
    "pressures_uneven": ("centre", 1.0),
    "lengths_uneven": ("tip", 1.0),
    "shifted": ("centre", 0.7),
    "widened": ("centre", 0.7),
    "ends_exchanged": ("ends", 1.0),
    "length_low": ("ends", 0.7),
    "load_high": ("load", 1.0),
    "patches_wrong": ("ends", 1.0),
    "force_high": ("saturation", 1.0),
    "force_half": ("saturation", 1.0),
    "fx_sign": ("saturation", 1.0),
    "fy_sign": ("power", 0.1),
    "mz_sign": ("power", 0.1),
    "fy_even": ("force_mirror", 0.7),
    "fx_offset": ("force_sign", 0.7),
    "power_sign": ("power", 0.7),
}


class Fuzz(LabTest):
    def test_no_case_of_a_plain_family_displeases_a_check(self):
        for family in ("slender", "offset", "fine"):
            with self.subTest(family):
                self.succeed("fuzz", "--cases", 200, "--first", 2001, "--family",
                             family, "-o", "cases.csv")
                rows = self.read("cases.csv")
                self.assertEqual({row["family"] for row in rows}, {family})
                for row in rows:
                    self.assertGreater(float(row["pmax_MPa"]), 0.0, row)
                    self.assertGreaterEqual(float(row["centre"]), 0.0, row)

    def test_cells_find_the_patches_of_what_does_not_converge_at_once(self):
        # Cases that end in fallback_used or fewer_strips without coarse cells, the last one where
        # cells that press again are as long as they were.
        for seed, case in ((9001, 606), (9001, 759), (9002, 79), (9001, 989)):
            with self.subTest((seed, case)):
                self.succeed("fuzz", "--seed", seed, "--case", case, "-o", "one.csv")
                self.assertEqual([row["status"] for row in self.read("one.csv")], ["ok"])

    def test_cells_close_the_gap(self):
        for family in ("slender", "offset", "worn"):
            with self.subTest(family):
                self.run_program("fuzz", "--cases", 200, "--first", 2001, "--solver", "cells",
                                 "--family", family, "-o", "cases.csv")
                for row in self.read("cases.csv"):
                    broken = FORM | {"answer", "depth", "centre", "tip", "middle", "outside"}
                    self.assertEqual(broken & set(row["violation"].split()), set(), row)
                    self.assertGreaterEqual(float(row["centre"]), 0.0, row)

    def test_no_case_of_any_family_breaks_the_form(self):
        self.run_program("fuzz", "--cases", 160, "--first", 2001, "-o", "cases.csv")
        rows = self.read("cases.csv")
        self.assertEqual([int(row["case"]) for row in rows], list(range(2001, 2161)))
        self.assertLessEqual({row["family"] for row in rows}, FAMILIES)
        for row in rows:
            if row["status"] == "no_finite_patch":
                self.assertIn(row["family"], {"negative_a", "varying_a", "mixed"}, row)
                self.assertIn("positive nowhere", row["message"], row)
                continue
            if row["status"] == "out_of_range":
                self.assertIn("fill values" if row["family"] == "fill" else "penetration",
                              row["message"], row)
                self.assertNotIn("answer", row["violation"].split(), row)
                continue
            self.assertEqual(FORM & set(row["violation"].split()), set(), row)
            self.assertLess(abs(float(row["load_error"])), 1e-6, row)
            self.assertGreater(float(row["pmax_MPa"]), 0.0, row)

    def test_every_planted_error_is_told(self):
        listed = self.run_program("fuzz", "--plant", "list").stdout.split()
        self.assertEqual(set(listed), set(FAULTS) | {"patch_lost"})
        cases = ("--cases", 600, "--family", "offset")
        done = self.succeed("fuzz", *cases)
        for fault, (check, share) in FAULTS.items():
            with self.subTest(fault):
                done = self.run_program("fuzz", *cases, "--plant", fault, "-o", "planted.csv")
                self.assertEqual(done.returncode, 1, done.stdout)
                self.assertIn("cases failed a check", done.stderr)
                rows = self.read("planted.csv")
                told = [row for row in rows if check in row["violation"].split()]
                self.assertGreaterEqual(len(told), share * len(rows), done.stdout)

    def test_the_unit_of_length_does_not_matter(self):
        """A contact whose start once depended on a level in millimetres."""
        self.run_program("fuzz", "--seed", 2, "--case", 2641, "--thorough", "-o", "case.csv")
        row = self.read("case.csv")[0]
        self.assertEqual((row["family"], row["status"]), ("concave", "ok"))
        self.assertLess(float(row["scale"]), 1.0)

    def test_rounding_turns_no_decision(self):
        """Contacts whose answer or status was another after y -> -y or in another unit."""
        for seed, case in ((1, 5711), (1, 4531), (5, 1863), (21, 101), (21, 1361),
                           (21, 1363), (22, 291), (22, 383), (41, 68611), (9003, 893), (9101, 203)):
            with self.subTest(seed=seed, case=case):
                self.run_program("fuzz", "--seed", seed, "--case", case, "--thorough",
                                 "-o", "case.csv")
                row = self.read("case.csv")[0]
                for check in ("mirror", "scale", "stiffness"):
                    self.assertLess(float(row[check]), 1e-3, row)
                    self.assertGreaterEqual(float(row[check]), 0.0, row)

    def test_the_power_of_friction_is_what_creepages_feed_in(self):
        """Small patches beside large ones, whose tractions carry them along."""
        for seed, case in ((9002, 756), (9108, 233), (12, 600)):
            with self.subTest(seed=seed, case=case):
                self.run_program("fuzz", "--seed", seed, "--case", case, "-o", "case.csv")
                self.assertNotIn("power", self.read("case.csv")[0]["violation"])

    def test_slender_strips_close_at_their_tips(self):
        """Or a limitation says what they do not."""
        for seed, case in ((9001, 199), (9002, 109), (9002, 678), (9003, 49),
                           (9004, 448), (9106, 655)):
            with self.subTest(seed=seed, case=case):
                self.run_program("fuzz", "--seed", seed, "--case", case, "-o", "case.csv")
                self.assertEqual(self.read("case.csv")[0]["violation"], "")

    def test_a_wall_stands_behind_all_patches_and_far_enough(self):
        """Two patches in dips between points, and contacts that felt a wall 12 points away."""
        for case in (3689, 3719, 5489):
            with self.subTest(case):
                self.run_program("fuzz", "--case", case, "--thorough", "-o", "case.csv")
                row = self.read("case.csv")[0]
                self.assertEqual(row["status"], "ok", row)
                self.assertLess(float(row["wall"]), 0.1, row)
                self.assertGreaterEqual(float(row["wall"]), 0.0, row)

    def test_a_strip_on_a_step_is_known_as_well_as_its_place(self):
        """Patches with a fill value of 1e10 mm in them, and one that a planted error moves."""
        for case in (138, 2390):
            with self.subTest(case):
                self.run_program("fuzz", "--case", case, "-o", "case.csv")
                row = self.read("case.csv")[0]
                self.assertEqual((row["status"], row["violation"]), ("conformal", ""), row)
                self.assertGreaterEqual(float(row["centre"]), 0.0, row)
                self.run_program("fuzz", "--case", case, "--plant", "penetration_slight",
                                 "-o", "case.csv")
                self.assertGreater(float(self.read("case.csv")[0]["centre"]), 1.0, row)

    def test_a_lost_patch_is_told(self):
        self.run_program("fuzz", "--cases", 400, "--family", "contacts", "-o", "whole.csv")
        self.run_program("fuzz", "--cases", 400, "--family", "contacts", "--plant", "patch_lost",
                         "-o", "lost.csv")
        several = [row["case"] for row in self.read("whole.csv") if int(row["patches"]) > 1]
        self.assertGreater(len(several), 3)
        for row in self.read("lost.csv"):
            if row["case"] in several:
                self.assertIn("load", row["violation"].split(), row)

    def test_all_checks_are_asked(self):
        done = self.succeed("fuzz", "--case", 100, "--thorough", "-o", "case.csv")
        row = self.read("case.csv")[0]
        for check in list(row)[list(row).index("answer"):]:
            self.assertGreaterEqual(float(row[check]), 0.0, check)
            self.assertIn(check, done.stdout)

    def test_what_did_not_settle_once_settles(self):
        """Slender contacts and jumps of 1/(2R), where passes used to go back and forth."""
        for case in (83, 195, 1539, 1663, 1893, 1899):
            with self.subTest(case):
                self.run_program("fuzz", "--case", case, "-o", "case.csv")
                row = self.read("case.csv")[0]
                self.assertNotIn(row["status"], ("fallback_used", "fewer_strips"), row)
                self.assertLess(int(row["iterations"]), 300, row)

    def test_a_punch_is_answered_and_named(self):
        """A contact over all of its 29 points, so hard that Newton's steps go astray."""
        self.run_program("fuzz", "--case", 1811, "-o", "case.csv")
        row = self.read("case.csv")[0]
        self.assertIn(row["status"], ("edge_of_data", "fallback_used"), row)
        self.assertIn("end of the gap data", row["message"], row)
        self.assertEqual(row["violation"], "", row)
        self.assertLess(int(row["iterations"]), 300, row)

    def test_overlap_outside_is_named(self):
        for case in (1400, 1603, 1936, 2511, 2611, 6120, 6285, 11300, 11389, 11783, 21260,
                     36154, 75150, 75577, 96296):
            with self.subTest(case):
                self.run_program("fuzz", "--case", 2 * case - 1, "-o", "case.csv")
                row = self.read("case.csv")[0]
                self.assertNotIn("outside", row["violation"].split(), row)
                if float(row["overlap"]) > 0.02 and row["status"] != "fallback_used":
                    self.assertIn("overlap", row["status"] + row["message"], row)

    def test_a_case_is_the_same_wherever_the_run_starts(self):
        for words, name in ((("--first", 11, "--cases", 20), "many.csv"),
                            (("--first", 30, "--cases", 1), "one.csv")):
            self.run_program("fuzz", *words, "-o", name)
        many, one = self.read("many.csv")[-1], self.read("one.csv")[0]
        for name in many:
            if name != "time_us":
                self.assertEqual(many[name], one[name], name)

    def test_gap_of_a_case_can_be_solved_alone(self):
        self.run_program("fuzz", "--first", 30, "--cases", 1, "-o", "one.csv")
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
                            (["--solver", "newton"], "newton"),
                            (["--case", "0"], "0"), (["--plant", "nothing"], "nothing"),
                            (["--family", "nobody"], "nobody")):
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
        share, whole = (done.stdout.partition("time per case")[0]
                        for done in (read, tables["all.csv"]))
        self.assertEqual(share, whole)
        self.assertIn("force_mirror", share)
        self.assertIn("slowest, ms:", read.stdout)
        self.refused(2, "fuzz", "--case", 6, "--cases", 2, says=["--case"])
