"""The catalogue of columns: what tables, interfaces and pages say of a figure is said once."""

import csv
import io
import re
import subprocess
import sys

from cli_program import (
    BATCH_COLUMNS,
    PROGRAM,
    ROOT,
    ProgramTest,
    gap_text,
    parabola,
    profile_case,
    rows_of,
)

EXAMPLES = ROOT / "example"
CASE = EXAMPLES / "s1002_uic60.nml"


def header_of(text):
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    return next(csv.reader(io.StringIO(lines[0])))


class Catalogue(ProgramTest):

    def setUp(self):
        super().setUp()
        self.rows = rows_of(self.run_program("columns").stdout)
        self.columns = {row["column"]: row for row in self.rows}

    def test_a_column_stands_once(self):
        self.assertGreater(len(self.rows), 140)
        self.assertEqual(len(self.columns), len(self.rows))
        members = [row["member"] for row in self.rows if row["member"]]
        self.assertEqual(len(set(members)), len(members))
        for row in self.rows:
            with self.subTest(row["column"]):
                self.assertTrue(row["what"])
                self.assertNotIn(row["what"][-1], ".,; ")
                self.assertLess(len(row["what"]), 64, "cut off?")
                self.assertEqual(row["unit"] == "", row["holds"] == "text")

    def test_pages_and_interfaces_say_what_it_says(self):
        done = subprocess.run([sys.executable, ROOT / "tools/generate/columns.py", PROGRAM,
                               "--check"], capture_output=True, encoding="utf-8")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_all_columns_of_all_tables_are_in_it(self):
        self.write("gap.csv", gap_text(parabola))
        self.write("rows.csv", BATCH_COLUMNS + "\none,gap.csv,210000,0.28,0.3,50000,0.001,0,0\n")
        states = EXAMPLES / "wheelset_states"
        runs = (("contact", CASE, "-o", "contact.csv", "--strips", "strips.csv", "--fields",
                 "fields.csv", "--gap", "gap_of.csv", "--profiles", "profiles.csv"),
                ("sweep", CASE, "-o", "sweep.csv"),
                ("batch", "rows.csv", "-o", "batch.csv"),
                ("wheelset", f"{states}.nml", "--states", f"{states}.csv", "-o", "wheelset.csv",
                 "--strips", "wheel_strips.csv", "--fields", "wheel_fields.csv", "--profiles",
                 "wheel_profiles.csv"),
                ("conicity", f"{states}.nml", "-o", "conicity.csv", "--functions", "functions.csv"),
                ("profile", EXAMPLES / "cases/worn_wheel.whl", "-o", "profile.csv"))
        seen = 0
        for words in runs:
            self.succeed(*words)
            for option, table in zip(words, words[1:]):
                if not str(option).startswith("-") or option == "--states":
                    continue
                for name in header_of((self.folder / table).read_text(encoding="utf-8")):
                    seen += 1
                    with self.subTest(f"{table}: {name}"):
                        self.assertIn(name, self.columns)
        self.assertGreater(seen, 250)

    def test_what_is_not_known_is_an_empty_cell(self):
        # Of each figure that needs something: a case that lacks it, and one that has it.
        lacking, having = {}, {}
        self.write("warm.nml", profile_case(motion="speed_mm_s = 1e4", extra="&thermal\n/\n"))
        for words in (("--tangential", "none"), ("--normal", "equal_area"),
                      ("--tangential", "polach"), (), ("--smooth", "1", "--yield-shear-MPa", "300"),
                      ("--wear", self.law()), ("--subsurface",), ("warm.nml",)):
            case = words[0] if words[:1] == ("warm.nml",) else CASE
            done = self.succeed("contact", case, *map(str, words[case != CASE:]))
            row = rows_of(done.stdout)[0]
            for one in self.rows:
                if one["group"] == "contact" and one["column"] in row:
                    (having if row[one["column"]] else lacking)[one["column"]] = words
        for one in self.rows:
            if one["group"] != "contact" or one["column"] in ("N_N", "iterations"):
                continue
            with self.subTest(one["column"]):
                self.assertIn(one["column"], having)
                if one["needs"] in ("", "times"):
                    self.assertNotIn(one["column"], lacking)
                elif one["needs"] != "strips":
                    self.assertIn(one["column"], lacking)

    def law(self):
        return self.write("law.csv", "# source: made up\n# body: wheel\n# density_kg_per_m3: 7850\n"
                          "from_N_per_mm2,to_N_per_mm2,constant_ug_per_m_mm2,slope_ug_per_m_N\n"
                          "0,inf,0,2\n")

    def test_the_header_has_its_members(self):
        header = (ROOT / "include/faststrip.h").read_text(encoding="utf-8")
        struct = re.search(r"typedef struct faststrip_result \{(.*?)\} faststrip_result;", header,
                           re.DOTALL).group(1)
        members = {row["member"]: row for row in self.rows if row["member"]}
        found = re.findall(r"^    (?:int|double) (\w+); +/\* (.*?) \*/", struct,
                           re.MULTILINE | re.DOTALL)
        figures = [name for name, _ in found if name in members]
        self.assertGreater(len(figures), 25)
        for name, comment in found:
            if name in members and name != "limitations":
                self.assertIn(members[name]["what"], re.sub(r"\s*\n \s*\* ", " ", comment))
