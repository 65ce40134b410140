"""The Python package as pip gets it: built from its source distribution, with the library in it,
installed where there is no compiler."""

import email.utils
import hashlib
import importlib
import os
import pathlib
import re
import subprocess
import sys
import tarfile
import tempfile
import tomllib
import unittest
import zipfile

import yaml

import blocks
from installed import ROOT

MOST_BYTES = 5 * 1024**2
FIRST_CONTACT = """
import sys, numpy as np, faststrip
y = 0.1 * np.arange(-150, 151)
contact = faststrip.Contact()
contact.set_gap(y, 0.002 * y**2, 1.0 / 920.0)
result = contact.solve(load=1e5, creepage=(1e-3, 0.0, 0.0))
print(result.status, f"{result.penetration:.16E} {result.fx:.16E}")
many = faststrip.solve_many((y, 0.002 * y**2, 1.0 / 920.0), load=[1e5], creepage=(1e-3, 0.0, 0.0))
print(many.fx[0] == result.fx)
print(len(faststrip.Wheelset().solve(axle_load=1e5).contacts))
print(faststrip.__version__, faststrip.library_version())
with open("/proc/self/maps") as maps:
    print(*sorted({line.split()[-1] for line in maps if ".so" in line}), sep="\\n")
"""
MODULES = """
import sys
before = set(sys.modules)
import numpy
numpy_alone = set(sys.modules)
import faststrip
print(*sorted(set(sys.modules) - numpy_alone))
"""


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        cls.command(sys.executable, ROOT / "tools/building/package.py", "--fast", "--folder",
                    cls.folder)
        cls.wheel, = cls.folder.glob("*.whl")
        cls.source, = cls.folder.glob("*.tar.gz")
        with open(ROOT / "fpm.toml", "rb") as file:
            cls.version = tomllib.load(file)["version"]
        # An empty environment, but for numpy.
        cls.command(sys.executable, "-m", "venv", "--without-pip", cls.folder / "empty")
        cls.python = cls.folder / "empty" / "bin" / "python"
        site, = (cls.folder / "empty").glob("lib/python3*/site-packages")
        cls.command(sys.executable, "-m", "pip", "--python", cls.python, "install", "--no-deps",
                    "--no-index", cls.wheel)
        numpy = pathlib.Path(importlib.import_module("numpy").__file__).parent
        for name in ("numpy", "numpy.libs"):
            if (numpy.parent / name).exists():
                (site / name).symlink_to(numpy.parent / name)
        cls.site = site
        # The same beside what `faststrip[plot]` brings along.
        cls.drawing = cls.folder / "drawing"
        cls.drawing.mkdir()
        for each in numpy.parent.iterdir():
            if not each.name.startswith(("faststrip", "__editable__")):
                (cls.drawing / each.name).symlink_to(each)

    @classmethod
    def command(cls, *words, **environment):
        done = subprocess.run([str(word) for word in words], stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8",
                              cwd=cls.folder, timeout=6000, check=False,
                              env={**os.environ, **environment})
        if done.returncode != 0:
            raise AssertionError(f"{words}: {done.returncode}\n{done.stdout}{done.stderr}")
        return done.stdout

    def without_compiler(self, text, **more):
        """What Python says where PATH has nothing and nothing names another library."""
        nothing = self.folder / "nothing"
        nothing.mkdir(exist_ok=True)
        return subprocess.run([self.python, "-c", text], cwd=nothing, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, encoding="utf-8", check=False,
                              env={"PATH": str(nothing), "HOME": str(nothing),
                                   "OPENBLAS_NUM_THREADS": "1", **more})

    def drawn(self, text):
        """What Python prints where the packages of `faststrip[plot]` are, too."""
        done = self.without_compiler(text, PYTHONPATH=str(self.drawing), MPLBACKEND="Agg")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def test_python_of_the_readme_runs(self):
        text = (ROOT / "README.md").read_text(encoding="utf-8")
        programs = [block.text for block in blocks.blocks_of(text) if block.language == "python"]
        self.assertTrue(self.drawn("\n".join(programs)))

    def test_a_profile_is_read_and_drawn(self):
        name = ROOT / "example" / "cases" / "worn_wheel.whl"
        printed = self.drawn(
            "import faststrip\n"
            f"wheel = faststrip.Profile.read({str(name)!r}, smooth_wavelength=5)\n"
            "faststrip.plot_profiles(wheel, '60e1').figure.savefig('worn.png')\n"
            "print(faststrip.__file__)\n")
        self.assertTrue(printed.startswith(str(self.site)), printed)
        picture = (self.folder / "nothing" / "worn.png").read_bytes()
        self.assertEqual(picture[:8], b"\x89PNG\r\n\x1a\n")
        self.assertGreater(len(picture), 10_000)

    def test_a_first_contact_where_there_is_no_compiler(self):
        done = self.without_compiler(FIRST_CONTACT)
        self.assertEqual(done.stderr, "")
        figures, same, contacts, versions, *loaded = done.stdout.splitlines()
        status, penetration, force = figures.split()
        self.assertEqual((status, same, contacts), ("0", "True", "2"))
        self.assertAlmostEqual(float(penetration), 0.10799, delta=1e-4)
        self.assertAlmostEqual(float(force), -12.23e3, delta=200.0)
        self.assertEqual(versions, f"{self.version} {self.version}")
        # The library of the package, with the run-time library that came with it.
        mine = [path for path in loaded if "faststrip" in path and "numpy" not in path]
        self.assertTrue(any(path.endswith("faststrip/libfaststrip.so.0") for path in mine), mine)
        self.assertTrue(any("faststrip.libs/libgfortran" in path for path in mine), mine)

    def test_profiles_are_read_where_there_is_no_program(self):
        name = ROOT / "example" / "cases" / "worn_wheel.whl"
        done = self.without_compiler(
            "import faststrip\n"
            f"wheel = faststrip.Profile.read({str(name)!r}, smooth_wavelength=5)\n"
            "print(wheel.kind, wheel.format, len(wheel.y))\n"
            "contact = faststrip.Contact()\n"
            "contact.set_gap(faststrip.profile_gap(wheel, '60e1', shift=1.0))\n"
            "print(contact.solve(load=8e4).status)\n"
            "faststrip.Profile.read('none.whl')\n")
        self.assertEqual(done.stdout, "wheel miniprof 258\n0\n")
        self.assertEqual(done.stderr.splitlines()[-1], "faststrip._library.FaststripError: "
                         "file_missing: no such file: none.whl")

    def test_the_library_needs_no_lapack(self):
        text = self.command("readelf", "-dW", self.site / "faststrip" / "libfaststrip.so.0")
        needed = re.findall(r"NEEDED.*\[([^]]+)\]", text)
        self.assertNotRegex(" ".join(needed), "(?i)lapack|blas")
        self.assertTrue(any(name.startswith("libgfortran") for name in needed), needed)

    def test_what_is_in_it(self):
        version = re.escape(self.version)
        self.assertRegex(self.wheel.name,
                         rf"^faststrip-{version}-py3-none-manylinux_2_\d+_\w+\.whl$")
        self.assertLess(self.wheel.stat().st_size, MOST_BYTES)
        with zipfile.ZipFile(self.wheel) as archive:
            names = archive.namelist()
            about = f"faststrip-{self.version}.dist-info/"
            metadata = email.message_from_bytes(archive.read(f"{about}METADATA"))
        self.assertEqual((metadata["Name"], metadata["Version"]), ("faststrip", self.version))
        extras = {"plot", "pandas", "xarray", "explore", "all"}
        self.assertEqual(set(metadata.get_all("Provides-Extra")), extras)
        wanted = {path.relative_to(ROOT / "python").as_posix()
                  for path in (ROOT / "python" / "faststrip").rglob("*")
                  if path.is_file() and "__pycache__" not in path.parts}
        found = {name for name in names if name.startswith("faststrip/")
                 and not name.endswith("/")}
        self.assertEqual(found - wanted, {"faststrip/libfaststrip.so.0"})
        self.assertEqual(wanted - found, set())
        for name in ("LICENSE", "LICENSES_bundled.txt"):
            self.assertTrue(any(each.startswith(about) and each.endswith(name) for each in names))

    def test_the_source_distribution_has_what_builds_it_and_no_more(self):
        with tarfile.open(self.source) as archive:
            names = {"/".join(name.split("/")[1:]) for name in archive.getnames()}
        for name in ("CMakeLists.txt", "fpm.toml", "include/faststrip.h", "LICENSE",
                     "pyproject.toml", "python/faststrip/__init__.py",
                     "src/faststrip/faststrip.f90", "tools/building/cmake/lapack_small.f90",
                     "tools/building/cmake/public_names.cmake"):
            self.assertIn(name, names)
        folders = {name.split("/")[0] for name in names if "/" in name}
        self.assertEqual(folders, {"include", "python", "src", "tools"})
        self.assertEqual({name.split("/")[1] for name in names if name.startswith("src/")},
                         {"faststrip", "files"})

    def test_recipes_build_from_that_source_distribution(self):
        sum_of = hashlib.sha256(self.source.read_bytes()).hexdigest()
        texts = {path.relative_to(self.folder).as_posix(): path.read_text(encoding="utf-8")
                 for kind in ("conda", "spack") for path in (self.folder / kind).rglob("*")
                 if path.is_file()}
        spack = "spack/spack_repo/faststrip"
        self.assertEqual(set(texts), {"conda/recipe.yaml", f"{spack}/repo.yaml",
                                      f"{spack}/packages/faststrip/package.py"})
        self.assertNotRegex("".join(texts.values()), r"@[A-Z]+\d*@")
        recipe = yaml.safe_load(texts["conda/recipe.yaml"])
        self.assertEqual((recipe["context"]["version"], recipe["source"]["sha256"]),
                         (self.version, sum_of))
        self.assertEqual((self.folder / "conda" / recipe["source"]["path"].replace(
            "${{ version }}", self.version)).resolve(), self.source.resolve())
        # Of Spack's the two names that it gives are enough to find the file.
        recipe = texts[f"{spack}/packages/faststrip/package.py"]
        self.assertIn(f'version("{self.version}", sha256="{sum_of}")', recipe)
        place = re.search(r'url = (f"file://.*")', recipe)[1]
        path = self.folder / spack / "packages" / "faststrip" / "package.py"
        url = eval(place, {"pathlib": pathlib, "__file__": str(path)})
        self.assertEqual(url, f"file://{self.source.resolve()}")

    def test_debian_makes_three_packages_of_that_source_distribution(self):
        folder = self.folder / "debian"
        texts = {path.relative_to(folder).as_posix(): path.read_text(encoding="utf-8")
                 for path in folder.rglob("*") if path.is_file()}
        packages = re.findall(r"^Package: (\S+)$", texts["control"], re.MULTILINE)
        self.assertEqual(packages, ["libfaststrip0", "libfaststrip-dev", "python3-faststrip"])
        self.assertEqual(set(texts), {
            "changelog", "control", "copyright", "not-installed", "rules", "source/format",
            *(f"{name}.install" for name in packages)})
        self.assertNotRegex("".join(texts.values()), r"@[A-Z]+\d*@")
        self.assertTrue(os.access(folder / "rules", os.X_OK))
        self.assertTrue(texts["changelog"].startswith(f"faststrip ({self.version}-1) unstable;"))
        email.utils.parsedate_to_datetime(texts["changelog"].strip().rpartition(">  ")[2])
        with open(ROOT / "pyproject.toml", "rb") as file:
            cmake = tomllib.load(file)["tool"]["scikit-build"]["cmake"]["version"]
        self.assertIn(f"cmake ({cmake.replace('>=', '>= ')})", texts["control"])
        # The optimized release, not debhelper's build type None.
        self.assertIn("\tdh_auto_configure -- -DCMAKE_BUILD_TYPE=Release\n", texts["rules"])
        source, target = texts["python3-faststrip.install"].split()
        with tarfile.open(self.source) as archive:
            self.assertIn(f"{self.source.name[:-len('.tar.gz')]}/{source}/__init__.py",
                          archive.getnames())
        self.assertEqual(target, "usr/lib/python3/dist-packages")

    def test_cmake_finds_all_it_needs_in_the_source_distribution(self):
        with tempfile.TemporaryDirectory() as folder:
            with tarfile.open(self.source) as archive:
                archive.extractall(folder, filter="data")
            self.command("cmake", "-S", pathlib.Path(folder, self.source.name[:-len(".tar.gz")]),
                         "-B", f"{folder}/build", "-DFASTSTRIP_OWN_LAPACK=ON",
                         "-DCMAKE_INSTALL_LIBDIR=lib/any")
            rules = pathlib.Path(folder, "build", "cmake_install.cmake").read_text(encoding="utf-8")
            for path in re.findall(rf'"({re.escape(folder)}/faststrip-[^"]+)"', rules):
                self.assertTrue(pathlib.Path(path).exists(), path)
        # Each folder that it installs into goes into one of Debian's packages, or is named there.
        taken = [line.replace("usr/lib/*", "lib/any").removeprefix("usr/")
                 for name in ("libfaststrip0.install", "libfaststrip-dev.install", "not-installed")
                 for line in (self.folder / "debian" / name).read_text("utf-8").splitlines()]
        folders = set(re.findall(r'DESTINATION "\${CMAKE_INSTALL_PREFIX}/([^"]+)"', rules))
        self.assertIn("lib/any", folders)
        for each in sorted(folders):
            self.assertTrue(any(f"{each}/".startswith(f"{one}/") or one.startswith(f"{each}/")
                                for one in taken), each)

    def test_only_what_is_needed_is_imported(self):
        modules = self.command(self.python, "-c", MODULES).split()
        for name in ("pandas", "xarray", "matplotlib", "dask", "bokeh", "importlib.metadata"):
            self.assertNotIn(name, modules)
        # No compiler and no pkg-config is asked where the library is.
        done = self.without_compiler("import faststrip, sys; print('ok')")
        self.assertEqual(done.stdout, "ok\n")

    def test_what_is_missing_is_told(self):
        text = ("import faststrip, numpy\n"
                "y = numpy.linspace(-15, 15, 101)\n"
                "many = faststrip.solve_many((y, 2e-3 * y**2, 1e-3), load=[1e5])\n"
                "many.to_{0}()")
        for name in ("pandas", "xarray"):
            done = self.without_compiler(text.format(name))
            self.assertEqual(done.stderr.splitlines()[-1], f"ImportError: to_{name} needs "
                             f"{name}: pip install 'faststrip[{name}]'")

    def test_the_environment_names_another_library(self):
        done = subprocess.run([self.python, "-c", "import faststrip"], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, encoding="utf-8", check=False,
                              env={"FASTSTRIP_LIBRARY": "/nowhere/libfaststrip.so"})
        self.assertIn("LibraryNotFound: no libfaststrip", done.stderr)
        self.assertIn("/nowhere/libfaststrip.so", done.stderr)


COMPARE = """\
! Random systems by the package's own routines and by LAPACK.
program compare
    use faststrip_base_kinds, only: wp
    use faststrip_numerics_lapack, only: own_dpbtrf => dpbtrf, own_dpbtrs => dpbtrs
    implicit none

    integer, parameter :: counts(7) = [1, 2, 3, 7, 40, 300, 5000]
    external :: dpbtrf, dpbtrs
    integer :: i, seed

    do i = 1, size(counts)
        do seed = 1, 20
            call band(counts(i), mod(seed, 5), 1 + mod(seed, 4))
        end do
    end do
    call singular()

contains

    subroutine band(n, kd, nrhs)
        integer, intent(in) :: n, kd, nrhs
        real(wp) :: ab(kd + 2, n), ab2(kd + 2, n), b(n + 1, nrhs), b2(n + 1, nrhs)
        integer :: info, info2, j
        call random_number(ab)
        call random_number(b)
        ab(kd + 1, :) = ab(kd + 1, :) + 2.0_wp*kd
        ab2 = ab
        b2 = b
        call own_dpbtrf('U', n, kd, ab, kd + 2, info)
        call dpbtrf('U', n, kd, ab2, kd + 2, info2)
        do j = 1, n
            associate (first => kd + 1 - min(kd, j - 1))
                call tell('dpbtrf', maxval(abs(ab(first:kd + 1, j) - ab2(first:kd + 1, j))) &
                          /maxval(abs(ab2(first:kd + 1, j))), info - info2)
            end associate
        end do
        call own_dpbtrs('U', n, kd, nrhs, ab, kd + 2, b, n + 1, info)
        call dpbtrs('U', n, kd, nrhs, ab2, kd + 2, b2, n + 1, info2)
        call tell('dpbtrs', maxval(abs(b(:n, :) - b2(:n, :)))/maxval(abs(b2(:n, :))), info - info2)
        ! What is beyond the system stays.
        call tell('beyond', maxval(abs(b(n + 1:, :) - b2(n + 1:, :))), 0)
    end subroutine band

    subroutine singular()
        real(wp) :: ab(2, 3)
        integer :: info
        ab(1, :) = 2.0_wp
        ab(2, :) = 1.0_wp
        call own_dpbtrf('U', 3, 1, ab, 2, info)
        write (*, '(a, i0)') 'info ', info
        call own_dpbtrf('L', 3, 1, ab, 2, info)
        write (*, '(a, i0)') 'info ', info
    end subroutine singular

    subroutine tell(name, error, info)
        character(len=*), intent(in) :: name
        real(wp), intent(in) :: error
        integer, intent(in) :: info
        write (*, '(a, 1x, es12.4, 1x, i0)') name, error, info
    end subroutine tell
end program compare
"""


class OwnRoutines(unittest.TestCase):
    """tools/building/cmake/lapack_small.f90 against LAPACK."""

    def test_they_agree_with_lapack(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "compare.f90").write_text(COMPARE, encoding="utf-8")
            done = subprocess.run(
                ["sh", "-euc", f"gfortran -O2 -std=f2018 '{ROOT}/src/faststrip/base/kinds.f90' "
                 f"'{ROOT}/tools/building/cmake/lapack_small.f90' compare.f90 -o compare "
                 "$(pkg-config --libs openblas) && ./compare"],
                cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8",
                check=False, env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
        self.assertEqual(done.returncode, 0, done.stdout)
        worst, infos = {}, []
        for line in done.stdout.splitlines():
            name, *numbers = line.split()
            if name == "info":
                infos.append(int(numbers[0]))
                continue
            self.assertEqual(int(numbers[1]), 0, line)
            worst[name] = max(worst.get(name, 0.0), float(numbers[0]))
        self.assertEqual(set(worst), {"beyond", "dpbtrf", "dpbtrs"})
        for name, error in worst.items():
            self.assertLessEqual(error, 0.0 if name == "beyond" else 1e-15, (name, worst))
        self.assertEqual(infos, [2, -1])
