"""What ./run says and returns, in a small project of its own."""

import contextlib
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import steps
from harness import ROOT, module, test

MAIN = """\
program main
    use faststrip_command_revision, only: revision
    implicit none
    print '(a)', 'revision ' // revision
end program main
"""
LAB = "program lab\n    implicit none\n    print '(a)', 'lab'\nend program lab\n"
LIBRARY = """\
module faststrip_base_kinds
    implicit none
    private
    public :: wp
    integer, parameter :: wp = kind(1.0d0)
end module faststrip_base_kinds
"""
FILES = """\
module faststrip_files_words
    use faststrip_base_kinds, only: wp
    implicit none
    private
    public :: wp
end module faststrip_files_words
"""
PASSING = test("passes", "@assertTrue(.true.)")
FAILING = test("fails", "@assertTrue(.false.)")
STOPPING = test("stops", "error stop 'on purpose'")
PYTHON = """\
import unittest


class Good(unittest.TestCase):
    def test_good(self):
        pass
"""
# Stands for tools/check/lint.py: one check.
LINT = """\
import sys

found = sys.argv[-1] in "lint::form"
print(f"all modules together: {int(found)} passed, 0 failed")
"""
# Stands for tools/building/install.py: says what it is asked for.
INSTALL = """\
import pathlib
import sys

print(*sys.argv[1:])
print(all(pathlib.Path(f"build/stage/lib/libfaststrip{name}.a").is_file()
          for name in ("", "-files")))
"""
# What ./run needs of a machine before it can install anything.
BASIC_TOOLS = "sh dirname cat cmp printf mkdir rm cp sed tr tail tee env".split()


class Project(unittest.TestCase):
    """A folder with ./run, a library of one file and two programs."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        for name in ("run", "fpm.toml", "src/files/fpm.toml", "test/funit/funit.f90",
                     "test/funit/funit_runner.f90", "test/conftest.py", "test/pytest.ini"):
            self.copy(name)
        for name in ("requirements.txt", "steps.py", "building/pf2f90.py", "building/recompile.py",
                     "building/netcdf_plugin.py"):
            self.copy(f"tools/{name}")
        self.manifest("app", 'faststrip-command.path = "command"')
        self.manifest("app/command", 'faststrip.path = "../.."')
        self.manifest("test", 'faststrip.path = ".."')
        self.write("tools/check/lint.py", LINT)
        self.write("tools/building/install.py", INSTALL)
        self.write("app/programs/faststrip.f90", MAIN)
        self.write("app/programs/faststrip_lab.f90", LAB)
        self.write("src/faststrip/base/kinds.f90", LIBRARY)
        self.write("src/files/words.f90", FILES)
        self.write("src/netcdf/plugin.f90", "module faststrip_netcdf_plugin\nend module\n")

    def copy(self, name):
        (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, self.folder / name)

    def manifest(self, package, needs):
        """The manifest of a package, which here needs less."""
        text = (ROOT / package / "fpm.toml").read_text(encoding="utf-8")
        text, count = re.subn(r"(?m)^\[dependencies\]\n(.+\n)*", f"[dependencies]\n{needs}\n",
                              text)
        self.assertEqual(count, 1)
        self.write(f"{package}/fpm.toml", text)

    def write(self, name, text):
        (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
        (self.folder / name).write_text(text, encoding="utf-8")

    def run_it(self, *arguments, **environment):
        return subprocess.run(
            [self.folder / "run", *arguments],
            cwd="/",
            env={**os.environ, **environment},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            timeout=3000,
            check=False,
        )


class Usage(Project):
    def test_help(self):
        result = self.run_it("help")
        self.assertEqual(result.returncode, 0)
        self.assertIn("usage: ./run", result.stdout)

    def test_an_unknown_command(self):
        result = self.run_it("frobnicate")
        self.assertEqual(result.returncode, 2)
        self.assertIn("usage: ./run", result.stderr)
        self.assertEqual(result.stdout, "")
        for word in ("", " ", "build ", "*"):
            self.assertEqual(self.run_it(word).returncode, 2, word)
        # Nothing was installed for it.
        self.assertEqual([name for name in ("build", ".venv") if (self.folder / name).exists()], [])

    def test_the_help_lists_every_step(self):
        listed = re.findall(r"^  ([\w-]+) ", self.run_it("help").stdout, re.MULTILINE)
        self.assertEqual(sorted(listed), sorted([*steps.STEPS, "help"]))
        self.assertLessEqual(set(steps.WORDS), set(steps.STEPS))
        for name in (*steps.QUICK, *(f"test/pf/{name}.pf" for name in steps.QUICK_WITHOUT)):
            self.assertTrue((ROOT / name).is_file(), name)
        for word in ("-h", "--help", "help"):
            self.assertEqual(self.run_it(word).stdout, steps.__doc__)
        self.assertEqual(self.run_it().stdout, steps.__doc__)

    def test_commands_without_words_have_the_same_help(self):
        for command in ("build", "test", "demo"):
            for word in ("-h", "--help"):
                with contextlib.redirect_stdout(io.StringIO()) as said:
                    self.assertEqual(steps.main(command, word), 0)
                self.assertEqual(said.getvalue(), steps.__doc__)

    def test_an_option_that_test_does_not_have(self):
        with self.assertRaisesRegex(steps.Trouble, "has the option --quick, not --fast"):
            steps.test("--fast")

    def test_the_bootstrap_stays_short(self):
        text = (ROOT / "run").read_text(encoding="utf-8")
        self.assertLessEqual(len(text.splitlines()), 150)


class Cleaning(Project):
    def test_what_was_built_goes_and_nothing_else(self):
        kept = ("app/command/x.f90", "src/faststrip/base/kinds.f90", "reference/build.csv")
        built = ("build/a/b", "bin/faststrip", "out/x.csv", "app/build/x", "app/command/build/x",
                 "test/build/x", "tools/__pycache__/x.pyc", "app/command/revision.f90")
        for name in (*kept, *built, ".venv/x/__pycache__/y", "reference/build/x.csv"):
            self.write(name, "text\n")
        self.assertEqual(self.run_it("clean", "more").returncode, 1)
        self.assertEqual(self.run_it("clean", "all", "more").returncode, 2)
        self.assertTrue((self.folder / "build/a/b").exists())
        self.assertEqual(self.run_it("clean").returncode, 0)
        for name in built:
            self.assertFalse((self.folder / name).exists(), name)
        for name in (*kept, ".venv/x/__pycache__/y", "reference/build/x.csv"):
            self.assertTrue((self.folder / name).exists(), name)
        self.assertEqual(self.run_it("clean", "all").returncode, 0)
        self.assertFalse((self.folder / ".venv").exists())
        self.assertEqual(self.run_it("clean").returncode, 0)


class Telling(unittest.TestCase):
    """How far a build is, by what fpm has written."""

    LOG = "fpm: Entering\n[ 36%]   a.f90\n[ 37%]   a.f90  done.\n[ 37%]   b.f90\n"

    def told(self, seconds, code=0, terminal=False):
        with tempfile.TemporaryDirectory() as folder:
            log = pathlib.Path(folder, "x.log")
            log.write_text(self.LOG, encoding="utf-8")
            said = io.StringIO()
            said.isatty = lambda: terminal
            with mock.patch.object(sys, "stderr", said), \
                    mock.patch.multiple(steps.Progress, FIRST=0.6, EVERY=1.0):
                words = [sys.executable, "-c", f"import time; time.sleep({seconds});"
                                               f" raise SystemExit({code})"]
                with subprocess.Popen(words) as process:
                    self.assertEqual(steps.Progress("the tests", log).wait(process), code)
        return said.getvalue().replace(str(log), "x.log")

    def test_a_line_from_time_to_time(self):
        said = self.told(3.0)
        self.assertRegex(said, r"\Arun: building the tests \(log: x.log\)\n"
                               r"(run: the tests: 37 %, 1 compiled, 0:0\d\n){2,}"
                               r"run: the tests: done, 0:0\d\n\Z")
        self.assertTrue(self.told(1.5, code=1).splitlines()[-1].startswith("run: the tests: fail"))

    def test_one_line_on_a_terminal(self):
        said = self.told(2.0, terminal=True)
        self.assertRegex(said, r"\A(\rrun: the tests: 37 %, 1 compiled, 0:0\d\x1b\[K)+"
                               r"\rrun: the tests: done, 0:0\d\x1b\[K\n\Z")

    def test_nothing_of_what_is_soon_done(self):
        self.assertEqual(self.told(0.0), "")


class Installing(Project):
    def test_without_packages_and_rights_the_command_is_named(self):
        tools = self.folder / "bare"
        tools.mkdir()
        for name in BASIC_TOOLS:
            (tools / name).symlink_to(shutil.which(name))
        for name, body in (("id", "echo 1000"), ("apt-get", "exit 9")):
            self.write(f"bare/{name}", f"#!/bin/sh\n{body}\n")
            (tools / name).chmod(0o755)
        for command in ("build", "test", "demo"):
            with self.subTest(command):
                result = self.run_it(command, PATH=str(tools))
                self.assertEqual(result.returncode, 1)
                self.assertRegex(
                    result.stderr,
                    r"\n +sudo apt-get install -y gfortran g\+\+ pkg-config libopenblas-dev"
                    r" libgsl-dev libfftw3-dev libnetcdff-dev"
                    r"( python3-venv)?\n",
                )
                self.assertFalse((self.folder / ".venv").exists())


class Room(Project):
    """Where nothing can be built, one line says why."""

    def refused(self, words, says):
        done = subprocess.run(["sh", "-c", f"{words}; exec {self.folder}/run build"], cwd="/",
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, timeout=3000, check=False)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertRegex(done.stderr, r"\Arun: [^\n]+\n\Z")
        self.assertIn(says, done.stderr)

    def test_a_limit_of_file_sizes(self):
        self.refused("ulimit -f 10", "ulimit -f")

    def test_a_folder_that_is_none(self):
        self.write("build", "in the way\n")
        self.refused("true", "cannot write into this folder")

    def test_a_folder_that_cannot_be_written(self):
        self.folder.joinpath("bin").symlink_to("/proc/self")
        self.refused("true", "cannot write into the folder bin")

    def test_lists_of_packages_that_cannot_be_had(self):
        """The one line holds what apt-get said."""
        tools = self.folder / "bare"
        tools.mkdir()
        for name in (*BASIC_TOOLS, "grep"):
            (tools / name).symlink_to(shutil.which(name))
        for name, body in (("id", "echo 0"), ("apt-get", "echo 'E: no such list' >&2; exit 9")):
            self.write(f"bare/{name}", f"#!/bin/sh\n{body}\n")
            (tools / name).chmod(0o755)
        done = self.run_it("build", PATH=str(tools))
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"\Arun: cannot install gfortran [^\n]*: E: no such list "
                                      r"[^\n]*; apt-get update: E: no such list [^\n]*\n\Z")


class Building(Project):
    """Needs the .venv of the checkout, as ./run test makes it."""

    def setUp(self):
        super().setUp()
        (self.folder / ".venv").symlink_to(ROOT / ".venv")
        self.write("test/tools/test_good.py", PYTHON)

    def check(self, body, code, counts, *arguments):
        self.write("test/pf/test_x.pf", module("test_x", body))
        result = self.run_it("test", *arguments)
        last = result.stdout.splitlines()[-1]
        self.assertEqual(last, counts, result.stdout + result.stderr)
        self.assertEqual(result.returncode, code)
        return result


class FromNothing(Building):
    def test_words_that_no_step_takes_are_refused(self):
        for words in (("build", "--quick"), ("test", "a", "b"), ("demo", "x"), ("fuzz", "1", "2")):
            result = self.run_it(*words)
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertRegex(result.stderr, rf"\Arun: {words[0]} takes [^\n]*{words[-1]}\n\Z")
        for words, says in ((("fuzz", "many"), "not a number of cases: many"),
                            (("install",), "install takes --prefix FOLDER"),
                            (("install", "--prefix", ""), "install takes --prefix FOLDER")):
            result = self.run_it(*words)
            self.assertEqual((result.returncode, result.stderr), (1, f"run: {says}\n"))

    def test_the_library_is_staged_and_the_prefix_seen_from_the_caller(self):
        place = self.folder / "else where"
        place.mkdir()
        self.write("app/programs/faststrip.f90", MAIN.replace(
            "    implicit none", "    use faststrip_base_kinds, only: wp\n    implicit none"
            "\n    if (wp < 0) stop"))
        self.assertEqual(self.run_it("build").returncode, 0)
        # What the programs' build has compiled is not compiled again.
        made, = (self.folder / "app" / "build").rglob("*_kinds.f90.o")
        made.write_bytes(made.read_bytes() + b"marked")
        for prefix, seen in (("be low", place / "be low"), (self.folder / "p", self.folder / "p")):
            result = subprocess.run([self.folder / "run", "install", "--prefix", prefix],
                                    cwd=place, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                    text=True, timeout=3000, check=False)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn(f"--stage build/stage --program bin/faststrip --prefix {seen}\nTrue\n",
                          result.stdout)
            self.assertIn(f"== installed below {seen}\n", result.stdout)
            copied, = (self.folder / "src" / "files" / "build").rglob("*_kinds.f90.o")
            self.assertEqual(copied.read_bytes(), made.read_bytes())

    def test_quick_compiles_nothing_twice_and_leaves_out_what_takes_long(self):
        self.write("app/programs/faststrip.f90", MAIN.replace(
            "    implicit none", "    use faststrip_base_kinds, only: wp\n    implicit none"
            "\n    if (wp < 0) stop"))
        self.assertEqual(self.run_it("build").returncode, 0)
        made, = (self.folder / "app" / "build").rglob("*_kinds.f90.o")
        made.write_bytes(made.read_bytes() + b"marked")
        self.write("test/cli/test_contact.py", PYTHON)
        self.write("test/pf/normal/test_cells_invariance.pf",
                   module("test_cells_invariance", FAILING))
        self.check(PASSING, 0, "3 passed, 0 failed", "--quick")
        copied, = (self.folder / "test" / "build").rglob("*_kinds.f90.o")
        self.assertEqual(copied.read_bytes(), made.read_bytes())
        self.check(PASSING, 0, "1 passed, 0 failed", "--quick", "::passes")

    def test_a_build_that_fails_says_so(self):
        self.write("app/programs/faststrip.f90", MAIN.replace("print", "prnt"))
        result = self.run_it("build")
        self.assertEqual((result.returncode, result.stdout), (1, ""))
        self.assertEqual(result.stderr.splitlines()[-1], "run: the build failed")
        self.assertIn("prnt", result.stderr)

    def test_only_what_sees_a_change_is_compiled(self):
        library, kept = "src/faststrip/base/kinds.f90", "faststrip_lab.f90"

        def built():
            """The objects that were compiled, and what the first program says."""
            before = {path: path.stat().st_mtime_ns for path in self.folder.glob("app/**/*.o")}
            result = self.run_it("build")
            self.assertEqual(result.returncode, 0, result.stderr)
            said = subprocess.run([self.folder / "bin/faststrip"], stdout=subprocess.PIPE,
                                  text=True, check=True).stdout
            return [path.name for path in self.folder.glob("app/**/*.o")
                    if before.get(path) != path.stat().st_mtime_ns], said

        text = LIBRARY.replace("public :: wp",
                               "public :: wp, say\n    integer, parameter :: say = 1")
        main = MAIN.replace("    implicit none", "    use faststrip_base_kinds, only: say\n"
                            "    implicit none\n    print '(i0)', say")
        self.write(library, text)
        self.write("app/programs/faststrip.f90", main)
        objects, said = built()
        self.assertEqual((len(objects), said), (4, "1\nrevision unknown\n"))
        self.write(library, "! A comment.\n" + text)
        objects, said = built()
        self.assertEqual((len(objects), said), (1, "1\nrevision unknown\n"))
        text = text.replace("say = 1", "say = 2")
        self.write(library, text)
        objects, said = built()
        self.assertEqual((len(objects), said), (2, "2\nrevision unknown\n"))
        self.assertFalse([name for name in objects if kept in name])
        # After a build that failed nothing is taken for done that is not.
        self.write(library, text.replace("say = 2", "say = 3"))
        self.write("app/programs/faststrip.f90", main.replace("print", "prnt"))
        self.assertEqual(self.run_it("build").returncode, 1)
        self.write("app/programs/faststrip.f90", main)
        objects, said = built()
        self.assertEqual((objects, said), (["programs_faststrip.f90.o"], "3\nrevision unknown\n"))

    def test_a_module_that_has_moved_is_built_again(self):
        text = LIBRARY.replace("public :: wp", "public :: wp\n    public :: tell").replace(
            "end module", "contains\n\n    subroutine tell() bind(c)\n    end subroutine tell\n"
            "end module")
        main = MAIN.replace("    implicit none", "    use faststrip_base_kinds, only: tell\n"
                            "    implicit none\n    call tell()")
        self.write("src/faststrip/base/kinds.f90", text)
        self.write("app/programs/faststrip.f90", main)
        self.assertEqual(self.run_it("build").returncode, 0)
        (self.folder / "src/faststrip/base/kinds.f90").unlink()
        self.write("src/faststrip/ground/kinds.f90", text)
        result = self.run_it("build")
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_all_stages_are_counted(self):
        disabled = PASSING.replace("@test", "@test\n@disable").replace("passes", "waits")
        self.check(PASSING + disabled, 0, "3 passed, 0 failed, 1 skipped")
        program = subprocess.run([self.folder / "bin/faststrip"], stdout=subprocess.PIPE, text=True)
        self.assertEqual(program.stdout, "revision unknown\n")
        program = subprocess.run([self.folder / "bin/faststrip-lab"], stdout=subprocess.PIPE,
                                 text=True)
        self.assertEqual(program.stdout, "lab\n")
        self.assertEqual(sorted(path.name for path in self.folder.joinpath("test").iterdir()),
                         ["build", "conftest.py", "fpm.toml", "funit", "pf", "pytest.ini", "tools"])


class Testing(Building):
    """Each test goes on from a copy of a project that was built once: its objects serve on."""

    built = None

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.built = pathlib.Path(temporary.name)

    def setUp(self):
        super().setUp()
        first = not any(self.built.iterdir())
        if first:
            self.check(PASSING, 0, "3 passed, 0 failed")
        shutil.copytree(*((self.folder, self.built) if first else (self.built, self.folder)),
                        ignore=shutil.ignore_patterns(".venv"), dirs_exist_ok=True)

    def test_lint_counts(self):
        self.write("tools/check/lint.py", "raise SystemExit("
                   "print('all modules together: 4 passed, 2 failed, 3 skipped') or 1)\n")
        self.check(PASSING, 1, "6 passed, 2 failed, 3 skipped")
        self.write("tools/check/lint.py", "raise SystemExit(1)\n")
        self.check(PASSING, 1, "2 passed, 1 failed")

    def test_a_failing_test_fails_the_run(self):
        self.check(PASSING + FAILING, 1, "3 passed, 1 failed")

    def test_a_crash_counts_as_one_failure(self):
        self.check(PASSING + STOPPING, 1, "2 passed, 1 failed")

    def test_what_does_not_compile_counts_as_one_failure(self):
        result = self.check(PASSING + test("wrong", "call ("), 1, "2 passed, 1 failed")
        self.assertIn("test/pf/test_x.pf:13", result.stdout)

    def test_a_warning_counts_as_one_failure(self):
        self.check(PASSING + test("untidy", "integer :: unused"), 1, "2 passed, 1 failed")

    def test_a_release_that_does_not_build_counts_as_one_failure(self):
        self.write("app/programs/faststrip.f90", MAIN.replace("print", "prnt"))
        self.check(PASSING, 1, "3 passed, 1 failed")

    def test_a_filter(self):
        self.check(PASSING + FAILING, 0, "1 passed, 0 failed", "::passes")
        self.check(PASSING, 0, "1 passed, 0 failed", "tools/test_good")
        self.check(PASSING, 0, "1 passed, 0 failed", "lint::")
        self.check(PASSING, 1, "0 passed, 1 failed", "unknown")
