"""The lists of mutants fit their files, and the runner tells killed from survived."""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import run_mutants
from harness import ROOT

RUNNER = ROOT / "tools/check/run_mutants.py"

FEWEST = 150

MODULE = """\
def larger(a, b):
    return a if a > b else b


def half(a):
    while a == 7:
        pass
    return a / 2


def unseen(a):
    return a + 1
"""
TEST = """\
import pathlib
import sys
import unittest

import sums


class Sums(unittest.TestCase):
    def test_larger(self):
        self.assertEqual(sums.larger(2, 3), 3)

    def test_half(self):
        self.assertEqual(sums.half(4), 2)
"""
UNSTEADY = """
    def test_an_unsteady_one(self):
        seen = pathlib.Path("seen")
        is_new = not seen.exists()
        seen.touch()
        self.assertFalse(is_new and pathlib.Path.cwd().name == "job_0")
"""
LIST = """\
[[mutant]]
id = "plots-smaller"
file = "plots/sums.py"
text = "a if a > b else b"
replacement = "a if a < b else b"
why = "the smaller"

[[mutant]]
id = "plots-endless"
file = "plots/sums.py"
text = "while a == 7"
replacement = "while a == 4"
why = "never ends"

[[mutant]]
id = "plots-equal"
file = "plots/sums.py"
text = "a > b"
replacement = "a >= b"
why = "which of two equals"
equivalent = "equals are equal"
"""
SURVIVOR = """
[[mutant]]
id = "plots-nobody-looks"
file = "plots/sums.py"
text = "a + 1"
replacement = "a - 1"
why = "no test calls it"
"""
BROKEN = """
[[mutant]]
id = "plots-broken"
file = "plots/sums.py"
text = "return a + 1"
replacement = "return a +"
why = "does not compile"
"""
NAMED_WRONGLY = """
[[mutant]]
id = "plots-not-equivalent"
file = "plots/sums.py"
text = "a / 2"
replacement = "a * 2"
why = "twice"
equivalent = "nobody looks"
"""
AMBIGUOUS = SURVIVOR.replace("a + 1", "return").replace("a - 1", "yield")

ARITHMETIC = """\
module arithmetic
    implicit none
    private

    public :: twice, offset

    integer, parameter :: offset = 3

contains

    integer function twice(n)
        integer, intent(in) :: n
        twice = 2*n
    end function twice
end module arithmetic
"""
CALLER = """\
module caller
    use arithmetic, only: twice, offset
    implicit none
    private

    public :: total

contains

    integer function total(n)
        integer, intent(in) :: n
        total = twice(n) + offset
    end function total
end module caller
"""
SUPPORT = """\
module support
    implicit none
    private

    public :: two

contains

    integer function two()
        two = 2
    end function two
end module support
"""
FORTRAN_TEST = """\
module test_caller
    use funit
    use caller, only: total
    use support, only: two
    implicit none
contains
    @test
    subroutine seven()
        @assertEqual(7, total(two()))
    end subroutine seven
end module test_caller
"""
FORTRAN_LIST = """\
[[mutant]]
id = "numerics-other-offset"
file = "src/faststrip/arithmetic.f90"
text = "offset = 3"
replacement = "offset = 4"
why = "a constant that another module uses"

[[mutant]]
id = "numerics-squared"
file = "src/faststrip/arithmetic.f90"
text = "2*n"
replacement = "n*n"
why = "the same at 2"
"""


class Lists(unittest.TestCase):
    def test_every_text_stands_where_it_says(self):
        mutants = run_mutants.read_lists(ROOT / "tools/check/mutants")
        self.assertGreaterEqual(len(mutants), FEWEST)
        self.assertEqual({mutant.room for mutant in mutants}, set(run_mutants.OWN_STAGES))
        for mutant in mutants:
            with self.subTest(mutant.id):
                source = (ROOT / mutant.file).read_text(encoding="utf-8")
                self.assertNotEqual(mutant.applied(source), source)
                self.assertTrue(mutant.why.strip())
                self.assertTrue(mutant.id.startswith(f"{mutant.room}-"))
                self.assertRegex(mutant.file, rf"^((src/faststrip|src|app)/)?{mutant.room}/")
                if mutant.first and mutant.first.endswith(".py"):
                    self.assertTrue((ROOT / mutant.first).is_file())
                elif mutant.first:
                    module = mutant.first.split("::")[0]
                    self.assertTrue(list((ROOT / "test" / "pf").glob(f"{module}*.pf")))
                self.assertNotEqual(mutant.equivalent, "")

    def test_every_stage_has_tests(self):
        """A filter that fits no room, or a file that is gone, would let every mutant live."""
        stages = [stage for own in run_mutants.OWN_STAGES.values() for stage in own]
        for kind, what in stages + run_mutants.ALL_STAGES:
            with self.subTest(what):
                if kind == "fortran":
                    self.assertTrue(list((ROOT / "test" / "pf" / what).rglob("test_*.pf")))
                else:
                    self.assertEqual([name for name in what if not (ROOT / name).exists()], [])

    def test_every_source_is_linked_somewhere(self):
        """What a mutant's programs are linked of is what the packages hold."""
        linked = sum(run_mutants.PROGRAMS.values(), run_mutants.TESTS + run_mutants.LIBRARY
                     + run_mutants.plugin_sources())
        for begin in linked:
            if not begin.startswith("build/"):
                self.assertTrue((ROOT / begin).exists(), begin)
        for name in run_mutants.files_of(ROOT):
            if name.suffix in (".f90", ".c") and name.parts[0] in ("src", "app", "test"):
                with self.subTest(name):
                    self.assertTrue(name.as_posix().startswith(linked))
        self.assertEqual(run_mutants.linked_libraries(ROOT, run_mutants.files_of(ROOT))[-1],
                         "openblas")

    def test_no_change_stands_twice(self):
        changes = [(mutant.file, mutant.applied((ROOT / mutant.file).read_text(encoding="utf-8")))
                   for mutant in run_mutants.read_lists(ROOT / "tools/check/mutants")]
        self.assertEqual(len(changes), len(set(changes)))


class Verdicts(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        for name in ("test/conftest.py", "test/pytest.ini"):
            self.write(name, (ROOT / name).read_text("utf-8"))
        self.write("plots/sums.py", MODULE)
        self.write("test/plots/test_sums.py", TEST)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def judge(self, code, *words, room="plots", text=""):
        if text:
            self.write(f"tools/check/mutants/{room}.toml", text)
        # Seconds without a mutant are few: what does not end is told soon.
        shorter = (f"import sys; sys.path.insert(0, {str(RUNNER.parent)!r}); import run_mutants; "
                   "run_mutants.TIME_EXTRA = 3.0; sys.exit(run_mutants.main())")
        done = subprocess.run([sys.executable, "-c", shorter, "--root", str(self.folder), *words],
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, encoding="utf-8", timeout=120, check=False)
        self.assertEqual(done.returncode, code, done.stdout)
        return done.stdout

    def test_killed_endless_and_equivalent(self):
        said = self.judge(0, "plots", "--jobs", "2", text=LIST)
        self.assertRegex(said, r"plots-smaller +killed +plots/test_sums::Sums\.test_larger")
        self.assertRegex(said, r"plots-endless +killed +time-out")
        self.assertRegex(said, r"plots-equal +equivalent +equals are equal")
        self.assertEqual(said.splitlines()[-1],
                         "3 mutants: 1 killed, 1 time-out, 0 survived, 1 equivalent, 0 invalid")
        self.assertEqual((self.folder / "plots/sums.py").read_text("utf-8"), MODULE)

    def test_a_survivor_an_invalid_one_and_one_named_wrongly(self):
        said = self.judge(1, text=SURVIVOR + BROKEN + NAMED_WRONGLY)
        self.assertRegex(said, r"plots-nobody-looks +survived +all tests")
        self.assertRegex(said, r"plots-broken +invalid +does not build")
        self.assertIn("although it is named equivalent", said)
        self.assertEqual(said.splitlines()[-1],
                         "3 mutants: 1 killed, 1 survived, 0 equivalent, 1 invalid")

    def test_a_test_that_fails_now_and_then_kills_nothing(self):
        # It fails once, as one may that waits for a busy machine.
        self.write("test/plots/test_sums.py", TEST + UNSTEADY)
        said = self.judge(1, "--jobs", "1", text=SURVIVOR)
        self.assertRegex(said, r"plots-nobody-looks +survived +all tests")

    def test_the_tests_to_begin_with_may_be_fortran(self):
        first = run_mutants.Mutant("normal", {"id": "", "file": "a.f90", "why": "", "text": "",
                                              "replacement": "", "first": "normal/test_hertz"})
        self.assertEqual(run_mutants.stages_of(first, True),
                         [("fortran", "normal/test_hertz"), ("fortran", "normal/")])

    def test_tests_of_hosts_to_begin_with_have_the_installed_library(self):
        first = run_mutants.Mutant("interop", {"id": "", "file": "a.f90", "why": "", "text": "",
                                               "replacement": "",
                                               "first": "test/embed/test_hosts.py"})
        self.assertEqual(run_mutants.stages_of(first, True)[0],
                         ("installed", ["test/embed/test_hosts.py"]))

    def test_a_verdict_is_that_of_the_tests_to_begin_with(self):
        entry = {"id": "", "file": "a.f90", "why": "", "text": "", "replacement": ""}
        keys = {run_mutants.Mutant("normal", {**entry, **first}).key("tree")
                for first in ({}, {"first": "normal/test_hertz"}, {"first": "normal/test_strip"})}
        self.assertEqual(len(keys), 3)

    def test_a_run_goes_on_where_it_was(self):
        self.judge(1, text=SURVIVOR)
        results = self.folder / "build/mutants/results.jsonl"
        kept = results.read_text("utf-8")
        self.judge(1)
        self.assertEqual(results.read_text("utf-8"), kept)
        # A test that looks makes all results void.
        self.write("test/plots/test_sums.py", TEST + "\n    def test_unseen(self):\n"
                   "        self.assertEqual(sums.unseen(1), 2)\n")
        self.assertIn("1 mutants: 1 killed", self.judge(0))

    def test_what_cannot_be_used_is_refused(self):
        self.assertIn("times in plots/sums.py", self.judge(2, text=AMBIGUOUS))
        self.assertIn("not in plots/sums.py",
                      self.judge(2, text=SURVIVOR.replace("a + 1", "a + 2")))
        self.assertIn("no such room", self.judge(2, room="cellar", text=SURVIVOR))
        (self.folder / "tools/check/mutants/cellar.toml").unlink()
        self.judge(2, "--only", "nobody", text=SURVIVOR)
        self.write("test/plots/test_sums.py", TEST.replace("sums.half(4), 2", "sums.half(4), 3"))
        self.assertIn("a test fails without a mutant", self.judge(2, text=LIST))

    def test_fortran_is_compiled_with_what_uses_it(self):
        self.write("fpm.toml", 'name = "tiny"\n[build]\nauto-executables = false\n'
                   'auto-examples = false\n[library]\nsource-dir = "src"\n')
        self.write("src/faststrip/arithmetic.f90", ARITHMETIC)
        self.write("src/faststrip/caller.f90", CALLER)
        self.write("test/pf/numerics/test_caller.pf", FORTRAN_TEST)
        self.write("test/pf/support/two.f90", SUPPORT)
        for name in ("tools/building/pf2f90.py", "test/funit/funit.f90",
                     "test/funit/funit_runner.f90"):
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, self.folder / name)
        (self.folder / ".venv").symlink_to(ROOT / ".venv")
        said = self.judge(1, "numerics", "--quick", "--jobs", "1", room="numerics",
                          text=FORTRAN_LIST)
        self.assertRegex(said, r"numerics-other-offset +killed +numerics/test_caller::seven")
        self.assertRegex(said, r"numerics-squared +survived +tests of its room")
