"""Procedures one can read: strip solver, error estimates, coefficients in small pieces."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROOM = ROOT / "src/faststrip/normal"
FILES = sorted([*ROOM.glob("strip/*.f90"), *ROOM.glob("estimate/errors*.f90"),
                *(ROOT / "src/faststrip/influence").rglob("*.f90")])
MOST_LINES = 500       # of a file
MOST_PROCEDURE = 80    # lines of a procedure, from its first line to its `end`
MOST_ARGUMENTS = 11
# What a host's C or F77 prescribes takes as many as it takes.
FACES = {"faststrip_wheelset_get_elements", "fswelm", "fswstw",
         "faststrip_get_elements", "faststrip_fastsim", "fstsim", "fselem", "fsprof", "fsstwr",
         "faststrip_profile_gap", "faststrip_pair_gap", "faststrip_roller_gap", "fsrprf"}
# Written out for speed; the gain stands beside them.
WRITTEN_OUT = {"far_sums", "near_sums"}
# Procedures of other libraries.
INTERFACE = re.compile(r"^ *interface\b.*?^ *end interface", re.MULTILINE | re.DOTALL)
PROCEDURE = re.compile(r"^ *(?:(?:pure|elemental|recursive|impure) +)*(?:[a-z]+(?:\([^)]*\))? +)?"
                       r"(subroutine|function) +(\w+) *\(([^)]*)\)", re.MULTILINE)


def procedures(text):
    """Name, arguments and lines of each procedure of a source."""
    text = re.sub(r"!.*", "", text)
    for found in PROCEDURE.finditer(text):
        kind, name, arguments = found.groups()
        start = found.start()
        end = re.compile(rf"^ *end {kind} {name}\b", re.MULTILINE).search(text, start).end()
        yield name, re.findall(r"\w+", arguments), text[start:end].count("\n") + 1


class Procedures(unittest.TestCase):
    def test_procedures_are_found(self):
        text = """
module m
contains
    pure type(level_t) function level_of(plan, & ! the plan (all of it)
                                         level)
    end function level_of
    subroutine settle(a)
        x = 1
    end subroutine settle
end module m
"""
        self.assertEqual(list(procedures(text)),
                         [("level_of", ["plan", "level"], 3), ("settle", ["a"], 3)])

    def test_all_are_seen(self):
        for path in FILES:
            text = path.read_text(encoding="utf-8")
            ends = re.findall(r"^ *end (?:subroutine|function) (\w+)", text, re.MULTILINE)
            self.assertEqual(sorted(name for name, _, _ in procedures(text)), sorted(ends), path)
        self.assertGreater(len(FILES), 12)

    def test_few_arguments(self):
        for path in FILES:
            for name, arguments, _ in procedures(path.read_text(encoding="utf-8")):
                self.assertLessEqual(len(arguments), MOST_ARGUMENTS, f"{path.name}: {name}")
                self.assertNotIn("goal", arguments, f"{path.name}: {name}: that is a demand")

    def test_few_arguments_anywhere(self):
        found = set()
        for place in ("src", "app"):
            for path in sorted((ROOT / place).rglob("*.f90")):
                if "build" in path.relative_to(ROOT).parts:
                    continue
                text = INTERFACE.sub("", path.read_text(encoding="utf-8"))
                found |= {name for name, arguments, _ in procedures(text)
                          if len(arguments) > MOST_ARGUMENTS}
        self.assertEqual(found, FACES)

    def test_short(self):
        for path in FILES:
            text = path.read_text(encoding="utf-8")
            self.assertLess(text.count("\n"), MOST_LINES, path.name)
            for name, _, lines in procedures(text):
                if name not in WRITTEN_OUT:
                    self.assertLessEqual(lines, MOST_PROCEDURE, f"{path.name}: {name}")
