"""Another fpm project that depends on the core by its path: it needs LAPACK and no GPL library."""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest

import steps
from installed import ROOT, callers

FORBIDDEN = re.compile(r"gsl|fftw", re.IGNORECASE)
MANIFEST = """\
name = "host"

[build]
auto-executables = false

[dependencies]
{package}.path = "{path}"

[[executable]]
name = "host"
source-dir = "app"
main = "main.f90"
"""
# Stands before the linker: notes what it is told and refuses all that the core must not need.
LINKER = """\
#!/bin/sh
printf '%s\\n' "$*" >>"{folder}/linked"
refused=
for word in "$@"; do
    case $word in
    *gsl* | *fftw*)
        echo "ld: refused: $word" >&2
        refused=yes
        ;;
    esac
done
[ -z "$refused" ] || exit 1
exec {linker} "$@"
"""
# Stands for gfortran and keeps what sees no change.
COMPILER = """\
#!/bin/sh
exec {words} "$@"
"""


class Dependency(unittest.TestCase):
    """A host, and a linker that refuses what the core must not need."""

    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        # Without links: what is relative is so to the place itself.
        cls.folder = pathlib.Path(temporary.name).resolve()
        cls.host = cls.folder / "host"
        recompile = [sys.executable, "-IS", str(ROOT / "tools/building/recompile.py")]
        for name, text in (
                ("ld", LINKER.format(folder=cls.folder, linker=shutil.which("ld"))),
                ("gfortran", COMPILER.format(
                    words=shlex.join([*recompile, shutil.which("gfortran")])))):
            cls.write(f"bin/{name}", text)
            (cls.folder / "bin" / name).chmod(0o755)

    @classmethod
    def write(cls, name, text):
        path = cls.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def build(self, package, path, source):
        """Build a host of a package; the code, and what was said."""
        self.write("host/fpm.toml", MANIFEST.format(
            package=package, path=os.path.relpath(ROOT / path, self.host)))
        self.write("host/app/main.f90", source)
        (self.folder / "linked").unlink(missing_ok=True)
        kept = {name: os.environ[name] for name in ("HOME", "TMPDIR") if name in os.environ}
        kept["PATH"] = f"{self.folder}/bin{os.pathsep}{os.environ['PATH']}"
        # The programs' objects are the core's too.
        kept["FASTSTRIP_TWIN"] = str(ROOT / "app" / "build")
        done = subprocess.run(
            [pathlib.Path(sys.executable).parent / "fpm", "build", "--compiler", "gfortran",
             "--flag", steps.PROGRAM_FLAGS, "--link-flag", f"-B{self.folder}/bin"],
            cwd=self.host, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, encoding="utf-8", env=kept, timeout=6000, check=False)
        return done.returncode, done.stdout

    def linked(self):
        """What the linker was told."""
        return (self.folder / "linked").read_text(encoding="utf-8")

    def test_the_core_links_without_gsl_and_fftw(self):
        code, said = self.build("faststrip", ".", dict(callers())["fortran"])
        self.assertEqual(code, 0, said)
        self.assertRegex(self.linked(), r"-lopenblas\b")
        self.assertNotRegex(self.linked(), FORBIDDEN)
        program, = self.host.glob("build/gfortran_*/app/host")
        needed = subprocess.run(["readelf", "-dW", program], stdout=subprocess.PIPE,
                                encoding="utf-8", check=True).stdout
        self.assertIn("[libopenblas.so", needed)
        self.assertNotRegex(needed, FORBIDDEN)
        # No more of the project was compiled than the core.
        objects = [path.name for path in self.host.glob("build/gfortran_*/**/*.o")]
        self.assertGreater(len(objects), 40)
        self.assertEqual([name for name in objects
                          if re.search("src_(kalker|tables|files)|app_(command|lab)", name)], [])
        result = subprocess.run([program], stdout=subprocess.PIPE, encoding="utf-8", check=True,
                                env={"OPENBLAS_NUM_THREADS": "1"})
        status, penetration, force = (float(word) for word in result.stdout.split())
        self.assertEqual(status, 0.0)
        # Hertz: 0.10799 mm; a little less than half of what friction can carry.
        self.assertAlmostEqual(penetration, 0.10799, delta=1e-4)
        self.assertAlmostEqual(force, -12.23e3, delta=200.0)

    def test_the_linker_would_have_refused_them(self):
        self.write("main.f90", "end\n")
        done = subprocess.run(["gfortran", f"-B{self.folder}/bin", "main.f90", "-lgsl", "-lfftw3"],
                              cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              encoding="utf-8", check=False)
        self.assertNotEqual(done.returncode, 0)
        for library in ("gsl", "fftw3"):
            self.assertIn(f"ld: refused: -l{library}", done.stdout)

    def test_packages_name_the_libraries_they_need(self):
        """And none that they do not need."""
        found = {}
        for path in sorted(ROOT.glob("**/fpm.toml")):
            name = path.relative_to(ROOT).parent.as_posix()
            if name.split("/")[0] in (".venv", "build", "out"):
                continue
            build = tomllib.loads(path.read_text(encoding="utf-8")).get("build", {})
            found[name] = build.get("link", [])
        self.assertEqual({name: link for name, link in found.items() if link},
                         {".": ["openblas"], "src/kalker": ["fftw3"], "src/tables": ["gsl"]})
