"""What can be set: one table, whatever it is set by."""

import re
import subprocess
import sys

from cli_program import (
    FIGURES,
    PROGRAM,
    ROOT,
    ProgramTest,
    gap_text,
    parabola,
    profile_case,
    rows_of,
)

# Words that no program can make up, and values that a contact needs to have a solution.
VALUES = {"normal": "hertz", "tangential": "fastsim", "target": "area", "norm_start": "strips",
          "tolerance": "0.3", "budget_us": "1e9", "side": "left", "strips_per_patch": "9",
          "max_elements": "20000", "subsurface": ".true.", "curved": ".true."}
FLAG = ".true. or .false."
NORM = ("element_dx_mm", "element_dy_mm", "error_target", "max_elements", "norm_start")
AUTO = ("tolerance", "target", "budget_us")


def quoted(row, value):
    is_text = row["may_be"] in ("text", "a file") or " or " in row["may_be"] and \
        "number" not in row["may_be"] and "true" not in row["may_be"]
    return f"'{value}'" if is_text else value


def value_for(row):
    """A value that it may be, and not the one it is where nothing is said."""
    if row["name"] in VALUES:
        return VALUES[row["name"]]
    if "whole" not in row["may_be"]:
        return "0.4"
    most = re.search(r"whole number from 1 to (\d+)", row["may_be"])
    return str(min(11, int(most[1]))) if most else "11"


class Settings(ProgramTest):

    def setUp(self):
        super().setUp()
        self.rows = rows_of(self.run_program("settings").stdout)

    def group(self, name):
        return [row for row in self.rows if name in row["group"].split()]

    def solved(self, case, *words, command="contact"):
        self.write("case.nml", case)
        done = self.run_program(command, "case.nml", *words)
        self.assertIn(done.returncode, (0, 1, 3), done.stderr)
        self.assertTrue(done.stdout, done.stderr)
        row = rows_of(done.stdout)[0]
        return [row.get(name) for name in ["status", "normal", "tangential", *FIGURES,
                                           "fatigue_index", "von_mises_max_MPa"]]

    def test_the_pages_say_what_the_table_says(self):
        done = subprocess.run([sys.executable, ROOT / "tools/generate/settings.py", PROGRAM,
                               "--check"], capture_output=True, encoding="utf-8")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_what_is_told_is_what_happens(self):
        """Every default that the table tells, given, changes no bit."""
        groups = {}
        for row in self.rows:
            value = row["default"]
            for group in row["group"].split():
                if value and " " not in value and group not in ("state", "sweep"):
                    groups.setdefault(group, []).append(f"{row['name']} = {quoted(row, value)}")
        self.assertGreater(sum(map(len, groups.values())), 35)
        given = profile_case(
            contact="load_N = 1e5\n  " + "\n  ".join(groups["contact"]),
            wheel="profile = 's1002'\n  " + "\n  ".join(groups["wheel"]),
            rail="profile = 'uic60'\n  " + "\n  ".join(groups["rail"]),
            material="mu = 0.3\n  " + "\n  ".join(groups["material"]),
            motion="\n  ".join(groups["motion"]),
            extra="".join(f"&{group}\n  " + "\n  ".join(groups[group]) + "\n/\n"
                          for group in ("friction", "numerics")))
        self.assertEqual(self.solved(given), self.solved(profile_case()))

    def methods_for(self, row):
        """A setting counts where its method is asked for."""
        if row["name"] in NORM:
            return ["--normal", "norm", "--tangential", "none", "--element-dx", "0.8",
                    "--element-dy", "0.8"]
        if row["name"] in AUTO:
            return ["--normal", "auto"]
        if row["name"].startswith("fastsim"):
            return ["--tangential", "fastsim"]
        return []

    def test_an_option_and_a_case_file_do_the_same(self):
        changed = []
        for row in self.group("numerics"):
            if not row["option"] or row["name"] == "wear_file":
                continue
            words = self.methods_for(row)
            if row["option"] in words:
                at = words.index(row["option"])
                words = words[:at] + words[at + 2:]
            motion, value = "cksi = 0.002", value_for(row)
            plain = self.solved(profile_case(motion=motion), *words)
            by_option = self.solved(profile_case(motion=motion), *words, row["option"],
                                    *([] if row["may_be"] == FLAG else [value]))
            extra = f"&numerics\n  {row['name']} = {quoted(row, value)}\n/\n"
            by_file = self.solved(profile_case(motion=motion, extra=extra), *words)
            self.assertEqual(by_option, by_file, row["name"])
            if by_file != plain:
                changed.append(row["name"])
        for name in ("normal", "tangential", "strips_per_patch", "points_per_strip", "fastsim_nx",
                     "fastsim_ny", "element_dx_mm", "element_dy_mm", "smoothing_um", "yield_MPa",
                     "yield_shear_MPa", "subsurface", "curved"):
            self.assertIn(name, changed)

    def test_sides_that_are_given_stay_in_a_small_contact(self):
        """Those of which nothing is said are shorter there, though they are as long by default."""
        case = profile_case(contact="load_N = 2.0")
        norm = ("--normal", "norm", "--tangential", "none")
        shorter = self.solved(case, *norm)
        for along in ("--element-dx", "--element-dy"):
            self.assertNotEqual(self.solved(case, *norm, along, "0.2"), shorter, along)

    def test_a_wheelset_takes_every_option(self):
        state = "&state\n  y_mm = 1.0, yaw_rad = 0.001, speed_mm_s = 2e4, Fz_N = 1.6e5\n/\n"
        case = profile_case(extra=state)
        plain = self.solved(case, command="wheelset")
        for words in (("--normal", "hertz"), ("--tangential", "polach"),
                      ("--strips-per-patch", "9"), ("--yield-MPa", "1.0")):
            row = next(row for row in self.rows if row["option"] == words[0])
            extra = f"&numerics\n  {row['name']} = {quoted(row, words[1])}\n/\n"
            by_option = self.solved(case, *words, command="wheelset")
            self.assertEqual(by_option, self.solved(case + extra, command="wheelset"))
            self.assertNotEqual(by_option, plain, words)

    def test_the_target_is_that_of_the_forces_asked_for_at_last(self):
        """Without forces auto is for pmax; an option that asks for forces asks for theirs."""
        state = "&state\n  y_mm = 1.0, yaw_rad = 0.001, speed_mm_s = 2e4, Fz_N = 1.6e5\n/\n"
        words = ("--normal", "auto", "--tolerance", "0.006", "--tangential", "faststrip")
        none = "&numerics\n  tangential = 'none'\n/\n"
        for case, command in ((profile_case(extra=state), "wheelset"), (profile_case(), "contact")):
            self.assertEqual(self.solved(case + none, *words, command=command),
                             self.solved(case, *words, command=command))
            self.assertNotEqual(self.solved(case, *words, "--target", "pmax", command=command),
                                self.solved(case, *words, command=command))

    def test_a_budget_of_a_wheelset_is_told(self):
        """As of a contact: another run may end with other bytes."""
        state = "&state\n  y_mm = 1.0, yaw_rad = 0.001, speed_mm_s = 2e4, Fz_N = 1.6e5\n/\n"
        self.write("case.nml", profile_case(extra=state))
        for words, is_told in (((), False), (("--budget-us", "1e6"), True)):
            done = self.run_program("wheelset", "case.nml", "--normal", "auto", *words)
            self.assertEqual("# within a budget of time" in done.stdout, is_told, words)

    def test_a_state_has_its_numbers_in_their_places(self):
        """The group and a row of a table, each number another one, are the same state."""
        rows = self.group("state")
        given = {"y_mm": 0.5, "yaw_rad": 1e-3, "speed_mm_s": 2e4, "Fz_N": 1.6e5, "vy_mm_s": 3.0,
                 "vz_mm_s": 2.0, "roll_rate_rad_s": 1e-3, "yaw_rate_rad_s": 2e-3,
                 "pitch_rate_rad_s": -43.0, "curve_radius_mm": 5e5, "roll_moment_Nmm": 1e6}
        given |= {row["name"]: 1e-4 * (3 + i) for i, row in enumerate(rows)
                  if row["name"].startswith("rail_")}
        state = "&state\n" + "".join(f"  {key} = {value!r}\n" for key, value in given.items())
        by_group = self.solved(profile_case(extra=state + "/\n"), command="wheelset")
        columns = ["case", "side", "roll_rad", *given]
        self.write("states.csv", ",".join(columns) + "\na,both,," +
                   ",".join(repr(value) for value in given.values()) + "\n")
        by_row = self.solved(profile_case(), "--states", "states.csv", command="wheelset")
        self.assertEqual(by_group, by_row)

    def test_each_range_is_held_by_files_and_options(self):
        """Every setting has what it may not be refused, with its line and value."""
        n_refused = 0
        for row in self.rows:
            words = row["may_be"]
            for bad, is_bad in (("-0.5", " 0" in words or "whole" in words or "or" in words),
                                ("0", "above 0" in words or "whole" in words and " or " not in
                                 words), ("0.5", "below 0.5" in words),
                                ("1.5", re.search(r"(most|to) 1\b", words) or "whole" in words),
                                ("-3", "whole" in words), ("1001", re.search(r"to 1000\b", words)),
                                ("99999999", "to 1000" in words or "to 2000" in words),
                                ("-0.0", "number above 0" in words), ("nan", "number" in words),
                                ("inf", "number" in words and "whole" not in words),
                                ("x", words not in ("text", "a file"))):
                if not is_bad or "state" in row["group"] or "sweep" in row["group"]:
                    continue
                n_refused += 1
                with self.subTest(row["name"], bad=bad):
                    self.refused_by_file(row, bad)
                    if row["option"] and row["group"] == "numerics" and words != FLAG:
                        self.refused(2, "contact", "case.nml", row["option"], bad,
                                     says=[f"{row['option']} must be {words}, got '{bad}'"])
        self.assertGreater(n_refused, 150)

    def refused_by_file(self, row, bad):
        groups = {name: text for name, text in
                  (("contact", "load_N = 1e5"), ("wheel", "profile = 's1002'"),
                   ("rail", "profile = 'uic60'"), ("material", "mu = 0.3"), ("motion", ""),
                   ("friction", ""), ("numerics", ""))}
        group = row["group"].split()[0]
        groups.setdefault(group, "")
        kept = [part for part in groups[group].split(", ") if row["name"] not in part.split()]
        groups[group] = "\n  ".join([*kept, f"{row['name']} = {quoted(row, bad)}"])
        text = "".join(f"&{name}\n  {body}\n/\n" for name, body in groups.items())
        self.write("case.nml", text)
        line = next(i for i, words in enumerate(text.splitlines(), 1)
                    if words.split()[:1] == [row["name"]])
        self.refused_and_untouched("contact", "case.nml", says=[
            f"&{group} {row['name']} must be ", f"(case.nml:{line})",
            "got 0" if bad == "0" else bad if "whole" in row["may_be"] else
            {"nan": "NaN", "inf": "Inf", "-0.0": "0.0"}.get(bad, bad),
            "must be at least 0 and below 0.5" if bad == "0.5" else "must be "])
        self.write("case.nml", profile_case())

    def test_text_is_read_as_it_stands(self):
        self.write("gap's.csv", gap_text(parabola))
        for line in ("gap_file = 'gap''s.csv'", 'gap_file = "gap\'s.csv"',
                     "GAP_FILE = 'gap''s.csv' ! a comment, with 'quotes'"):
            self.write("case.nml", f"&contact {line}\n name = \"a \"\"b\"\"\", load_N = 1d5,\n/\n"
                       "&material mu = .3 /\n&motion /\n")
            row = rows_of(self.run_program("contact", "case.nml").stdout)[0]
            self.assertEqual((row["case"], row["status"]), ('a "b"', "ok"))

    def test_a_number_may_be_its_word(self):
        rows = []
        for value in ("0", "auto", "'auto'", "AUTO"):
            extra = f"&numerics\n  points_per_strip = 9, strips_per_patch = {value}\n/\n"
            rows.append(self.solved(profile_case(extra=extra)))
        rows.append(self.solved(profile_case(), "--points-per-strip", "9", "--strips-per-patch",
                                "auto"))
        self.assertTrue(all(row == rows[0] for row in rows), rows)
        self.assertNotEqual(rows[0], self.solved(profile_case(), "--points-per-strip", "9"))

    def test_endless_values_end(self):
        """Ten thousand lines of numbers are refused as fast as a few."""
        numbers = "  " + 200 * "1.5 " + "\n"
        for group, name, says in (("sweep", "shifts_mm", "at most 1000 finite numbers"),
                                  ("numerics", "tolerance", "must be one value")):
            self.write("case.nml", profile_case(extra=f"&{group}\n  {name} =\n" + 9900 * numbers
                                                + "/\n"))
            self.refused(1, "contact", "case.nml", says=[says])

    def test_a_name_that_stands_twice_is_the_last(self):
        twice = "&sweep\n  shifts_mm = 0.1, 0.2\n  shifts_mm = 0.5\n/\n"
        self.write("case.nml", profile_case(contact="shift_mm = 1.0, load_N = 9e4, load_N = 1e5",
                                            extra=twice))
        rows = rows_of(self.run_program("sweep", "case.nml", "--normal", "hertz").stdout)
        self.assertEqual({(float(row["yw_mm"]), float(row["N_N"])) for row in rows}, {(0.5, 1e5)})

    def test_lists_go_over_lines(self):
        same = []
        for text in ("0.5, 0.5, 0.5 1", "2*0.5,\n  0.5\n  1.0", "3*0.5, 1.0,"):
            self.write("case.nml", profile_case(extra=f"&sweep\n  shifts_mm = {text}\n/\n"))
            rows = rows_of(self.run_program("sweep", "case.nml").stdout)
            same.append([(row["yw_mm"], row["pmax_MPa"]) for row in rows])
        self.assertEqual({float(shift) for shift, _ in same[0]}, {0.5, 1.0})
        self.assertTrue(all(rows == same[0] for rows in same), same)
