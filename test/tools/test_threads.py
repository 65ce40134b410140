"""Texts of threads: no function that threads call has a result of deferred length, the length of
which gfortran keeps in one place for all of them (see src/faststrip/base/text.f90)."""

import re
import unittest

from harness import ROOT

# Rooms of which a host's threads may call all there is. The C library for NetCDF serves one thread.
ROOMS = [path for path in sorted((ROOT / "src").iterdir())
         if path.is_dir() and path.name not in ("build", "netcdf")]
# What the threads of a batch and of a sweep run; those of tables run what is in src/tabulate.
THREADED = [ROOT / "app/command" / f"{name}.f90" for name in (
    "batch/rows", "settings/friction", "settings/table", "batch/gap_cache", "batch/worker",
    "contact/solver", "contact/prepared_case", "rows/auto_words", "rows/result_csv",
    "rows/wear_figures")]
FUNCTION = re.compile(
    r"^ *(?:(?:pure|elemental|recursive|impure) +)*function +(?P<name>\w+) *\([^)]*\)"
    r"(?: *result *\((?P<result>\w+)\))?(?P<body>.*?)^ *end function", re.MULTILINE | re.DOTALL)


def deferred(text):
    """Functions of a source whose result has a deferred length."""
    text = re.sub(r"!.*", "", text).replace("&\n", " ")
    return [found["name"] for found in FUNCTION.finditer(text)
            if re.search(rf"^ *character\([^)]*len=:\), *(?:allocatable|pointer)[^:]*::.*"
                         rf"\b{found['result'] or found['name']}\b", found["body"], re.MULTILINE)]


def source(path):
    return path.read_text(encoding="utf-8")


class Threads(unittest.TestCase):
    def test_such_functions_are_found(self):
        text = """
    pure function one(a) result(text)
        character(len=*), intent(in) :: a
        character(len=:), allocatable :: text
    end function one
    function two(a, & ! more
                 b)
        character(kind=c_char, len=:), pointer :: two
    end function two
    pure function three(a) result(text)
        character(len=len(a)) :: text
        character(len=:), allocatable :: other
    end function three
"""
        self.assertEqual(deferred(text), ["one", "two"])

    def test_hosts_call_none(self):
        sources = [path for room in ROOMS for path in room.rglob("*.f90")
                   if "build" not in path.relative_to(ROOT).parts]
        self.assertGreater(len(sources), 200)
        self.assertEqual([(path.name, name) for path in sources
                          for name in deferred(source(path))], [])

    def test_threads_of_the_program_call_none(self):
        names = {name for path in (ROOT / "app/command").rglob("*.f90")
                 for name in deferred(source(path))}
        self.assertGreater(len(names), 30)
        self.assertNotIn("digest_of_gap", names)
        for path in THREADED:
            text = re.sub(r"!.*", "", source(path)).replace("&\n", " ")
            known = set(deferred(text)).union(*(
                re.findall(r"\w+", listed) for listed in re.findall(r"^ *use .*?only:(.*)", text,
                                                                  re.MULTILINE)))
            called = set(re.findall(r"\b(\w+)\(", text))
            self.assertEqual(sorted(called & known & names), [], path)
