"""tools/check/lint.py: what it finds, what it leaves alone, and how it counts."""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from harness import ROOT

SCRIPT = ROOT / "tools/check/lint.py"
GOOD = {
    "a.py": "import sys\n\nprint(sys.argv)\n",
    "run": "#!/bin/sh\necho \"$1\"\n",
    "src/a.f90": "!> A module.\nmodule a\n    implicit none\n    private\n\n    public :: n\n\n"
                 "    integer, parameter :: n = 1\nend module a\n",
    "test/a.pf": "x" * 100 + "\n  @assert" + "x" * 91 + "\n",
    "a.md": "x" * 100 + "\n| " + "x" * 200 + " |\n[words](https://" + "x" * 100 + ")\n",
    "build/b.py": "import os, sys\t\n" + "x" * 200,
    "data.csv": "x" * 200 + "\t\n",
}


class Lint(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        for name, text in GOOD.items():
            self.write(name, text)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def lint(self, text="", **options):
        return subprocess.run([sys.executable, SCRIPT, "--filter", text, self.folder],
                              encoding="utf-8", capture_output=True, check=False, **options)

    def found(self, check, name, text, says):
        """A file in which one check has to find something; the others pass."""
        self.write(name, text)
        done = self.lint(check)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn(says, done.stdout)
        self.assertRegex(done.stdout, rf"(?m)^lint::{check} +FAILED$")
        self.assertRegex(done.stdout, r"all modules together: +0 passed, 1 failed\n\Z")
        if name in GOOD:
            self.write(name, GOOD[name])
        else:
            (self.folder / name).unlink()

    def test_what_is_good_passes(self):
        done = self.lint()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        shell = shutil.which("shellcheck") is not None
        self.assertRegex(done.stdout, r"all modules together: +" + (
            r"5 passed, 0 failed\n\Z" if shell else r"4 passed, 0 failed, 1 skipped\n\Z"))

    @unittest.skipUnless(shutil.which("git"), "no git")
    def test_with_git_the_files_that_git_would_take(self):
        subprocess.run(["git", "init", "-q", self.folder], check=True)
        self.write(".gitignore", "ignored.py\nbuild/\n")
        self.write("ignored.py", "import os, sys\n" + "x" * 200 + "\n")
        self.assertEqual(self.lint().returncode, 0)
        self.found("ruff", "new.py", "import os\n", "new.py:1:8: F401")

    def test_without_git_all_but_what_was_built(self):
        self.write(".gitignore", "ignored.py\n")
        self.assertEqual(self.lint("ruff", env={"PATH": "/nowhere"}).returncode, 0)
        self.write("new.py", "import os\n")
        self.assertEqual(self.lint("ruff", env={"PATH": "/nowhere"}).returncode, 1)

    def test_columns(self):
        for name, most in (("a.py", 100), ("src/a.f90", 100), ("run", 100), ("x.sh", 100),
                           ("a.md", 100), ("test/a.pf", 100)):
            self.found("columns", name, "\n" + (most + 1) * "x" + "\n",
                       f"{name}:2: {most + 1} columns, at most {most}")
        self.found("columns", "test/a.pf", "  @assert" + "x" * 92 + "\n",
                   "test/a.pf:1: 101 columns, at most 100")
        # Characters, not bytes.
        self.write("a.md", "ü" * 100 + "\n")
        self.assertEqual(self.lint("columns").returncode, 0)
        self.found("columns", "a.md", "ü" * 101 + "\n", "a.md:1: 101 columns")

    def test_blanks(self):
        for text, says in (("a \n", "a.py:1: a blank at the end"), ("\tb\n", "a.py:1: a tab"),
                           ("a\r\n", "a.py:1: a blank at the end"),
                           ("a\n\n", "a.py:2: not one end of line"), ("a", "a.py:1: not one end")):
            with open(self.folder / "a.py", "w", encoding="utf-8", newline="") as stream:
                stream.write(text)
            done = self.lint("blanks")
            self.assertEqual(done.returncode, 1, text)
            self.assertIn(says, done.stdout)

    def test_ruff_and_fortitude(self):
        for text, code in (("import os\n", "F401"), ("import sys\nimport os\nprint(os, sys)\n",
                                                     "I001"),
                           ("def f(x=[]):\n    return x\n", "B006"), ("l = 1\n", "E741"),
                           ("print('%s' % 1)\n", "UP031"), ("def f(:\n", "invalid-syntax")):
            self.found("ruff", "a.py", text, code)
        self.found("fortitude", "src/a.f90", "module a\nend module a\n", "C001")
        self.found("fortitude", "src/a.f90", GOOD["src/a.f90"].replace("    private\n", ""), "C131")

    def test_a_file_that_cannot_be_read_is_found(self):
        (self.folder / "src/a.f90").write_bytes(GOOD["src/a.f90"].encode() + b"! \xe9\n")
        done = self.lint("fortitude")
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("a.f90:1:1: E000", done.stdout)

    @unittest.skipUnless(shutil.which("shellcheck"), "no shellcheck")
    def test_shellcheck(self):
        self.found("shellcheck", "run", "#!/bin/sh\nrm $1\n", "run:2:4: note: Double quote")
        self.found("shellcheck", "tools/x.sh", "#!/bin/sh\nif [ a = b ]; then\n", "x.sh:2")

    def test_a_checker_that_is_missing_is_skipped_and_said(self):
        done = self.lint("shellcheck", env={"PATH": "/nowhere"})
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stdout, r"lint::shellcheck +skipped: [^\n]*\n"
                                      r"all modules together: +0 passed, 0 failed, 1 skipped\n\Z")

    def test_compilers_that_cannot_be_had_are_told(self):
        done = subprocess.run([sys.executable, ROOT / "tools/building/compilers.py"],
                              encoding="utf-8", capture_output=True, check=False,
                              env={"PATH": "/nowhere"})
        self.assertEqual(done.returncode, 1)
        lines = done.stdout.splitlines()
        self.assertEqual(lines[0].split(), ["compiler", "version", "core", "command", "programs",
                                            "remark"])
        for line, name in zip(lines[1:], ("gfortran-12", "gfortran-N", "flang-N"), strict=True):
            self.assertRegex(line, rf"\A{name} +- +- +- +- +Debian offers no {name} here\Z")
