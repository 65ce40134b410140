"""The tables of F77's arguments: whole, and what the sources say."""

import re
import subprocess
import sys
import unittest

import f77_arguments
from harness import ROOT


class Tables(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        constants = f77_arguments.Constants()
        cls.calls = [call for name in f77_arguments.FACE
                     for call in f77_arguments.calls(name, constants)]

    def test_the_page_is_what_the_tool_writes(self):
        done = subprocess.run([sys.executable, ROOT / "tools/generate/f77_arguments.py", "--check"],
                              capture_output=True, encoding="utf-8", check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_every_subroutine_and_every_argument_is_there(self):
        made = set()
        for path in (ROOT / "src" / "faststrip" / "interop" / "f77").glob("*.f90"):
            made |= set(re.findall(r"name='(fs\w+)_'", path.read_text(encoding="utf-8")))
        self.assertEqual({name.lower() for name, _, _ in self.calls}, made)
        self.assertGreater(len(made), 30)
        for _, shown, arguments in self.calls:
            told = [re.match(r"\w+", one)[0] for names, *_ in arguments for one in names]
            self.assertEqual(sorted(told),
                             sorted(re.search(r"\((.*)\)", shown)[1].split(", ")), shown)

    def test_types_are_those_of_the_first_letter(self):
        for name, _, arguments in self.calls:
            for names, kind, _, _ in arguments:
                for one in names:
                    if not one.startswith(("BYTES", "TEXT")):
                        self.assertEqual(one[0] in "IJKLMN", kind == "c_int", (name, one))

    def test_sizes_are_numbers_or_arguments(self):
        for name, shown, arguments in self.calls:
            for size in re.findall(r"\(([^)]*)\)", " ".join(one for names, *_ in arguments
                                                             for one in names)):
                for part in size.split(", "):
                    self.assertTrue(part == "*" or part.isdigit() or part in shown, (name, size))
        # As the README's caller declares them.
        sizes = {one for name, _, arguments in self.calls if name == "FSCONT"
                 for names, *_ in arguments for one in names}
        self.assertLessEqual({"IOPT(9)", "PAR(9)", "RES(14)", "IWORK(8)"}, sizes)

    def test_what_the_head_of_a_module_says_is_a_row(self):
        rows = list(f77_arguments.place_rows())
        for row in ("| contacts | `IOPT(6)` | rows of FASTSIM |",
                    "| wheelsets | `CONT(25), CONT(26)` | ends, mm |",
                    "| friction, wear | `YIELD` | in cyclic shear, MPa; 0: not known |"):
            self.assertIn(row, rows)
        self.assertEqual([row for row in rows if "  " in row], [])
