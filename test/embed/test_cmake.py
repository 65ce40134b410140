"""The core by CMake: installed, for hosts that find it, and as the subproject of a host."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest

from installed import ROOT, callers, installation

PROGRAMS = pathlib.Path(sys.executable).parent
FORBIDDEN = re.compile(r"gsl|fftw", re.IGNORECASE)
FINDING = """\
cmake_minimum_required(VERSION 3.18)
project(host LANGUAGES {language})
find_package(faststrip {version} REQUIRED)
add_executable(shared {source})
target_link_libraries(shared PRIVATE faststrip::faststrip)
add_executable(static {source})
target_link_libraries(static PRIVATE faststrip::static)
"""
SUBPROJECT = """\
cmake_minimum_required(VERSION 3.18)
project(host LANGUAGES C Fortran)
add_subdirectory("{root}" faststrip)
add_executable(by_c caller.c)
target_link_libraries(by_c PRIVATE faststrip::faststrip)
add_executable(by_fortran caller.f90)
target_link_libraries(by_fortran PRIVATE faststrip::static)
"""


class CMakeTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        sources = dict(callers())
        for name, language in (("caller.c", "c"), ("caller.f90", "fortran"), ("caller.f", "f77")):
            cls.write(name, sources[language])
        with open(ROOT / "fpm.toml", "rb") as file:
            cls.version = tomllib.load(file)["version"]

    @classmethod
    def write(cls, name, text):
        path = cls.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    @classmethod
    def said(cls, *words, **environment):
        """The code of a command in the folder, and what it said."""
        kept = {name: os.environ[name] for name in ("HOME", "TMPDIR") if name in os.environ}
        path = f"{PROGRAMS}{os.pathsep}{os.environ['PATH']}"
        done = subprocess.run([str(word) for word in words], cwd=cls.folder,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, encoding="utf-8", timeout=6000,
                              env={**kept, "PATH": path, "CMAKE_GENERATOR": "Ninja",
                                   "OPENBLAS_NUM_THREADS": "1", **environment}, check=False)
        return done.returncode, done.stdout

    @classmethod
    def command(cls, *words, **environment):
        code, said = cls.said(*words, **environment)
        if code != 0:
            raise AssertionError(f"{words}: {code}\n{said}")
        return said

    @classmethod
    def cmake(cls, *words, **environment):
        return cls.command(PROGRAMS / "cmake", *words, **environment)

    def results(self, program, **environment):
        """Status, penetration and longitudinal force that a caller printed."""
        status, *numbers = self.command(program, **environment).split()
        penetration, force = (float(number) for number in numbers)
        self.assertEqual(int(status), 0)
        # Hertz: 0.10799 mm; a little less than half of what friction can carry.
        self.assertAlmostEqual(penetration, 0.10799, delta=1e-4)
        self.assertAlmostEqual(force, -12.23e3, delta=200.0)
        return penetration, force


class Finding:
    """Hosts find the package below a prefix, wherever that is now."""

    def host(self, name, language, source, version=""):
        """A host of one language, configured and built in a folder of its own."""
        self.write(f"{name}/CMakeLists.txt",
                   FINDING.format(language=language, version=version, source=source))
        shutil.copy(self.folder / source, self.folder / name)
        folder = self.folder / name
        self.cmake("-S", folder, "-B", folder / "build", f"-DCMAKE_PREFIX_PATH={self.prefix}")
        self.cmake("--build", folder / "build")
        return folder / "build"

    def test_hosts_find_the_package(self):
        """In Fortran, F77 and C, each a project of this language alone."""
        found = set()
        for name, language, source in (("fortran", "Fortran", "caller.f90"),
                                       ("f77", "Fortran", "caller.f"), ("c", "C", "caller.c")):
            built = self.host(name, language, source)
            for program in ("shared", "static"):
                with self.subTest(language=name, program=program):
                    found.add(self.results(built / program))
                    needed = self.command("readelf", "-dW", built / program)
                    self.assertNotRegex(needed, FORBIDDEN)
                    wanted = self.assertIn if program == "shared" else self.assertNotIn
                    wanted("libfaststrip.so.0", needed)
        self.assertEqual(len(found), 1, found)

    def test_the_version_is_judged(self):
        major, minor, _ = self.version.split(".")
        self.host("same", "C", "caller.c", f"{major}.{minor}")
        for version in (f"{major}.{int(minor) + 1}", f"{int(major) + 1}.0"):
            with self.subTest(version):
                with self.assertRaisesRegex(AssertionError, "compatible with requested version"):
                    self.host(f"other_{version}", "C", "caller.c", version)
        self.assertIn(f'"{self.version}"',
                      (self.prefix / "lib/cmake/faststrip/faststripConfigVersion.cmake").read_text(
                          encoding="utf-8"))


class InstalledByRun(Finding, CMakeTest):
    """By ./run install."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.prefix = cls.folder / "moved here"
        shutil.copytree(installation().prefix, cls.prefix, symlinks=True)

    def test_no_place_is_remembered(self):
        for path in (self.prefix / "lib" / "cmake").rglob("*.cmake"):
            text = path.read_text(encoding="utf-8")
            for place in (self.folder, ROOT, installation().prefix):
                self.assertNotIn(str(place), text)


class Installed(Finding, CMakeTest):
    """By CMake, built once: as the subproject of a host of no build type, which installs what the
    project itself would."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.configured = cls.cmake("-B", "alone", "-S", ROOT)
        cls.write("super/CMakeLists.txt", SUBPROJECT.format(root=ROOT))
        for name in ("caller.c", "caller.f90"):
            shutil.copy(cls.folder / name, cls.folder / "super")
        # Optimisation would take most of the time, and changes nothing that is looked at here.
        cls.cmake("-B", "build", "-S", "super", "-DCMAKE_Fortran_FLAGS=-O0")
        cls.cmake("--build", "build")
        cls.cmake("--install", "build", "--prefix", cls.folder / "first")
        # Nothing may remember where it was installed or built.
        cls.prefix = cls.folder / "moved"
        (cls.folder / "first").rename(cls.prefix)
        (cls.folder / "build").rename(cls.folder / "away")

    def test_gsl_and_fftw_are_not_even_sought(self):
        self.assertIn("LAPACK", self.configured)
        self.assertNotRegex(self.configured, FORBIDDEN)
        cache = (self.folder / "alone" / "CMakeCache.txt").read_text(encoding="utf-8")
        self.assertNotRegex(cache, r"(?i)libgsl|fftw|pfunit_dir")
        needed = self.command("readelf", "-dW", self.prefix / "lib" / "libfaststrip.so")
        self.assertIn("[libfaststrip.so.0]", needed)
        self.assertNotRegex(needed, FORBIDDEN)
        for path in sorted(self.prefix.rglob("*")):
            if path.is_file():
                self.assertNotRegex(path.read_bytes().decode("latin-1"), "(?i)gsl_|fftw_")

    def test_everything_is_in_its_place(self):
        for name in ("include/faststrip.h", "include/faststrip/faststrip.mod",
                     "lib/libfaststrip.a", "lib/libfaststrip.so", "lib/libfaststrip.so.0",
                     f"lib/libfaststrip.so.{self.version}", "lib/pkgconfig/faststrip.pc",
                     "lib/cmake/faststrip/faststripConfig.cmake",
                     "lib/cmake/faststrip/faststripConfigVersion.cmake",
                     "lib/cmake/faststrip/faststripTargets.cmake",
                     "share/doc/faststrip/LICENSE"):
            with self.subTest(name):
                self.assertTrue((self.prefix / name).is_file())
        for path in self.prefix.rglob("*"):
            if path.is_file() and path.suffix in (".cmake", ".pc"):
                with self.subTest(path.name):
                    text = path.read_text(encoding="utf-8")
                    self.assertNotIn(str(self.folder), text)
                    self.assertNotIn(str(ROOT), text)

    def test_pkg_config_finds_it_where_it_is_now(self):
        packages = {"PKG_CONFIG_PATH": str(self.prefix / "lib" / "pkgconfig")}
        self.assertEqual(
            self.command("pkg-config", "--modversion", "faststrip", **packages).strip(),
            self.version)
        found = set()
        for line in ("gcc caller.c $(pkg-config --cflags --libs faststrip)",
                     "gfortran caller.f90 $(pkg-config --cflags --libs faststrip)",
                     "gcc -static caller.c $(pkg-config --static --cflags --libs faststrip)"):
            with self.subTest(line):
                self.command("sh", "-euc", f"{line} -o caller", **packages)
                found.add(self.results(self.folder / "caller",
                                       LD_LIBRARY_PATH=str(self.prefix / "lib")))
        self.assertEqual(len(found), 1, found)

    def test_the_same_names_are_public_as_of_run_install(self):
        """The names are found by other means there: in the objects."""
        for words in (("-D", "lib/libfaststrip.so"), ("lib/libfaststrip.a",)):
            *options, name = words
            text = self.command("nm", "--defined-only", "--extern-only", *options,
                                self.prefix / name)
            names = {line.split()[-1].partition("@")[0] for line in text.splitlines()
                     if len(line.split()) == 3}
            with self.subTest(name):
                self.assertGreater(len(names), 80)
                self.assertEqual(names - {"FASTSTRIP_0.1"}, self.public_names())

    def test_a_subproject_of_a_host(self):
        away = self.folder / "away"
        self.assertEqual(self.results(away / "by_c", LD_LIBRARY_PATH=str(away / "faststrip")),
                         self.results(away / "by_fortran"))

    def public_names(self):
        text = self.command("nm", "--defined-only", "--extern-only", installation().archive)
        return {line.split()[-1] for line in text.splitlines() if len(line.split()) == 3}
