"""A build compiles what sees a change, and nothing else."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

from harness import ROOT

# Each uses the one before; `deep` shows the constant of `base` to its users, `upper` does not.
SOURCES = {
    "base.f90": """\
module base
    implicit none
    private
    public :: base_number, base_value
    integer, parameter :: base_number = 3
contains
    integer function base_value(n)
        integer, intent(in) :: n
        base_value = 10*n
    end function base_value
end module base
""",
    "upper.f90": """\
module upper
    use base, only: base_number, base_value
    implicit none
    private
    public :: upper_value
contains
    integer function upper_value()
        upper_value = base_value(base_number)
    end function upper_value
end module upper
""",
    "deep.f90": """\
module deep
    use, intrinsic :: iso_c_binding, only: c_int; use base, only: base_number
    implicit none
    private
    public :: deep_value
    integer(c_int), parameter :: deep_value = 2*base_number
end module deep
""",
    "main.f90": """\
program main
    use upper, only: upper_value
    use deep, only: deep_value
    implicit none
    print '(i0, 1x, i0)', upper_value(), deep_value
end program main
""",
}
ORDER = ("base", "upper", "deep", "main")
FLAGS = ("-O1", "-std=f2018", "-Wall")


class Recompile(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.folder.joinpath("made").mkdir()
        for name, text in SOURCES.items():
            self.folder.joinpath(name).write_text(text, encoding="utf-8")

    def compiler(self, *words, gfortran=None):
        return subprocess.run([sys.executable, "-IS", ROOT / "tools/building/recompile.py",
                               gfortran or shutil.which("gfortran"), *words], cwd=self.folder,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, timeout=600, check=False)

    def compile(self, name, *flags):
        return self.compiler("-c", f"{name}.f90", *FLAGS, *flags, "-J", "made", "-Imade", "-o",
                             f"made/{name}.o")

    def build(self, *flags):
        """Compile all, as fpm does; the sources that were compiled, and what the program says."""
        for name in ORDER:
            path = self.folder / "made" / f"{name}.o"
            if path.exists():
                os.utime(path, (0, 0))
        for name in ORDER:
            done = self.compile(name, *flags)
            self.assertEqual((done.returncode, done.stdout), (0, ""))
        done = self.compiler(*(f"made/{name}.o" for name in ORDER), "-o", "made/main")
        self.assertEqual(done.returncode, 0, done.stdout)
        said = subprocess.run([self.folder / "made" / "main"], stdout=subprocess.PIPE, text=True,
                              check=True).stdout
        return [name for name in ORDER
                if (self.folder / "made" / f"{name}.o").stat().st_mtime > 0.0], said

    def change(self, name, old, new):
        path = self.folder / f"{name}.f90"
        text = path.read_text(encoding="utf-8")
        self.assertEqual(text.count(old), 1)
        path.write_text(text.replace(old, new), encoding="utf-8")

    def test_what_sees_no_change_is_kept(self):
        self.assertEqual(self.build(), ([*ORDER], "30 6\n"))
        self.assertEqual(self.build(), ([], "30 6\n"))
        # The lines below the comment have other numbers.
        self.change("base", "contains\n", "! A comment.\ncontains\n")
        self.assertEqual(self.build(), (["base"], "30 6\n"))
        self.change("base", "10*n", "100*n")
        self.assertEqual(self.build(), (["base"], "300 6\n"))
        self.change("upper", "base_value(base_number)", "base_value(base_number) + 1")
        self.assertEqual(self.build(), (["upper"], "301 6\n"))

    def test_another_interface_reaches_its_users(self):
        self.build()
        self.change("base", "base_number = 3", "base_number = 5")
        # The interface of `upper` stays as it is; the program is compiled because of `deep`.
        self.assertEqual(self.build(), ([*ORDER], "50 10\n"))
        # Nothing that users see of `deep` changes.
        self.change("base", "public :: base_number", "public :: more, base_number")
        self.change("base", "    integer, parameter", "    integer, parameter :: more = 1\n"
                                                      "    integer, parameter")
        self.assertEqual(self.build(), (["base", "upper", "deep"], "50 10\n"))
        self.change("base", "10*n", "10*n + i")
        self.change("base", "base_value(n)", "base_value(n, i)")
        self.change("base", "intent(in) :: n", "intent(in) :: n, i")
        done = self.compile("base")
        self.assertEqual(done.returncode, 0, done.stdout)
        # The call no longer fits, and that is found although its source is the same.
        done = self.compile("upper")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("upper.f90", done.stdout)
        self.change("base", "10*n + i", "10*n")
        self.change("base", "base_value(n, i)", "base_value(n)")
        self.change("base", "intent(in) :: n, i", "intent(in) :: n")
        # What failed is compiled again, though all it sees is as it was.
        self.assertEqual(self.build(), (["base", "upper"], "50 10\n"))

    def test_other_words_and_lost_files(self):
        self.build()
        self.assertEqual(self.build("-O2"), ([*ORDER], "30 6\n"))
        self.assertEqual(self.build("-O2"), ([], "30 6\n"))
        self.folder.joinpath("made", "base.mod").unlink()
        self.assertEqual(self.build("-O2")[0], ["base"])
        self.folder.joinpath("made", "deep.o").unlink()
        self.assertEqual(self.build("-O2")[0], ["deep"])

    def test_what_another_package_has_compiled_the_same_is_copied(self):
        """In folders as fpm has them: module files above objects."""
        calls = self.folder / "calls"
        counting = self.folder / "counting"
        counting.write_text(f"#!/bin/sh\necho \"$2\" >>{calls}\n"
                            f"exec {shutil.which('gfortran')} \"$@\"\n", encoding="utf-8")
        counting.chmod(0o755)

        def package(name, *flags):
            """Compile all in a package; the sources that were compiled."""
            (self.folder / name / "build/x/objects").mkdir(parents=True, exist_ok=True)
            calls.write_text("", encoding="utf-8")
            for source in ORDER:
                done = self.compiler("-c", f"{name}/../{source}.f90", *FLAGS, *flags, "-J",
                                     f"{name}/build/x", f"-I{name}/build/x", "-o",
                                     f"{name}/build/x/objects/.._{source}.f90.o",
                                     gfortran=counting)
                self.assertEqual((done.returncode, done.stdout), (0, ""))
            return [pathlib.Path(path).stem for path in calls.read_text("utf-8").splitlines()]

        def program(name):
            objects = (f"{name}/build/x/objects/.._{source}.f90.o" for source in ORDER)
            done = self.compiler(*objects, "-o", "main")
            self.assertEqual(done.returncode, 0, done.stdout)
            return subprocess.run([self.folder / "main"], stdout=subprocess.PIPE, text=True,
                                  check=True).stdout

        self.assertEqual(package("first"), [*ORDER])
        self.assertEqual(package("second"), [*ORDER])
        with mock.patch.dict(os.environ, FASTSTRIP_TWIN=str(self.folder / "first/build")):
            self.assertEqual(package("third"), [])
            self.assertEqual(program("third"), "30 6\n")
            self.assertEqual(package("fourth", "-O2"), [*ORDER])
            # Neither of another source, nor where a module file is lost.
            (self.folder / "first/build/x/deep.mod").unlink()
            self.change("upper", "base_value(base_number)", "base_value(base_number) + 1")
            self.assertEqual(package("fifth"), ["upper", "deep"])
            self.assertEqual(program("fifth"), "31 6\n")
        # What was copied is kept like what was compiled.
        self.change("upper", "base_value(base_number) + 1", "base_value(base_number)")
        self.assertEqual(package("third"), [])

    def test_an_error_is_told_each_time(self):
        self.build()
        self.change("upper", "end function upper_value", "end function other_value")
        for _ in range(2):
            done = self.compile("upper")
            self.assertEqual(done.returncode, 1)
            self.assertIn("upper.f90:9", done.stdout)
        self.change("upper", "end function other_value", "end function upper_value")
        self.assertEqual(self.build()[0], ["upper"])

    def test_what_includes_files_is_always_compiled(self):
        self.build()
        plain = self.folder.joinpath("deep.f90").read_text(encoding="utf-8")
        self.change("deep", "2*base_number\n", "2*base_number + more\n")
        self.change("deep", "    private\n", "    private\n    include 'more.inc'\n")
        for more in (1, 2):
            self.folder.joinpath("more.inc").write_text(f"integer, parameter :: more = {more}\n",
                                                        encoding="utf-8")
            self.assertEqual(self.build(), (["deep", "main"], f"30 {6 + more}\n"))
        # The object that was made before is not taken for that of the same text.
        self.folder.joinpath("deep.f90").write_text(plain, encoding="utf-8")
        self.assertEqual(self.build(), (["deep", "main"], "30 6\n"))

    def test_a_name_on_the_next_line_is_not_missed(self):
        self.change("deep", "use base, only", "use &\n base, only")
        self.build()
        self.assertEqual(self.build()[0], ["deep"])
        self.change("base", "base_number = 3", "base_number = 4")
        self.assertEqual(self.build()[1], "40 8\n")
