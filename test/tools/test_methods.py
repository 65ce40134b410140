"""The one list of methods: what repeats it is as the list says, and a new row reaches all of it."""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import methods

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Methods(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.copy = pathlib.Path(folder.name)
        for path in methods.TARGETS:
            (self.copy / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(ROOT / path, self.copy / path)

    def run_tool(self, *words):
        return subprocess.run(
            [sys.executable, ROOT / "tools/generate/methods.py", "--root", self.copy, *words],
            capture_output=True, encoding="utf-8", check=False)

    def change(self, path, old, new):
        text = (self.copy / path).read_text(encoding="utf-8")
        self.assertEqual(text.count(old), 1, old)
        (self.copy / path).write_text(text.replace(old, new), encoding="utf-8")

    def read(self, path):
        return (self.copy / path).read_text(encoding="utf-8")

    def test_all_that_repeats_the_list_is_as_it_says(self):
        done = self.run_tool("--check")
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_what_was_changed_by_hand_is_told(self):
        self.change("include/faststrip.h", "FASTSTRIP_TANGENTIAL_SHE = 8,",
                    "FASTSTRIP_TANGENTIAL_SHE = 9,")
        done = self.run_tool("--check")
        self.assertEqual(done.returncode, 1)
        self.assertIn("include/faststrip.h", done.stderr)
        self.assertNotIn("docs/usage.md", done.stderr)

    def test_a_new_row_reaches_all_that_repeats_it(self):
        free = 1 + max(m.number for m in methods.listed("tangential", core_only=False).values())
        self.change(methods.LIST, "        method_t(9, 'polach'",
                    f"        method_t({free}, 'new-one', needs='strips', &\n"
                    "                 gives_elements=.false., &\n"
                    "                 help='what''s new (12)'), &\n"
                    "        method_t(9, 'polach'")
        self.assertEqual(self.run_tool("--check").returncode, 1)
        self.assertEqual(self.run_tool().returncode, 0)
        self.assertEqual(self.run_tool("--check").returncode, 0)
        for path, words in (
            (methods.LIST, f"parameter :: tangential_new_one = {free}"),
            ("src/faststrip/faststrip.f90", " tangential_new_one"),
            ("example/hosts/tour.f90", " tangential_new_one"),
            ("include/faststrip.h", f"FASTSTRIP_TANGENTIAL_NEW_ONE = {free}"),
            ("src/faststrip/interop/f77/f77.f90", f"{free} new-one"),
            ("python/faststrip/_contact.py", f'"new-one": {free},'),
            ("docs/usage.md", "| `new-one` | what's new (12); no elements | strips |"),
        ):
            self.assertIn(words, self.read(path), path)

    def test_methods_outside_the_core_are_not_told_to_its_hosts(self):
        listed = methods.read_methods(self.read(methods.LIST))
        outside = [m.name for part in listed.values() for m in part if not m.in_core]
        self.assertEqual(outside, ["norm", "tang"])
        for name in outside:
            self.assertNotIn(f'"{name}":', self.read("python/faststrip/_contact.py"))
            self.assertNotRegex(self.read("include/faststrip.h"),
                                f"FASTSTRIP_[A-Z]+_{name.upper()}")

    def test_a_list_that_makes_no_sense_is_refused(self):
        for old, new, says in (
            ("method_t(9, 'polach'", "method_t(8, 'polach'", "number"),
            ("method_t(9, 'polach'", "method_t(9, 'she'", "name"),
            ("help='Polach'", "help='" + 90 * "x" + "'", "too long"),
        ):
            with self.subTest(new):
                self.setUp()
                self.change(methods.LIST, old, new)
                before = {path: self.read(path) for path in methods.TARGETS}
                done = self.run_tool()
                self.assertEqual(done.returncode, 1)
                self.assertIn(says, done.stderr)
                self.assertEqual({path: self.read(path) for path in methods.TARGETS}, before)

    def test_every_file_has_one_place(self):
        self.change("docs/usage.md", "<!-- END methods -->\n", "")
        self.assertIn("docs/usage.md must have one place", self.run_tool().stderr)
