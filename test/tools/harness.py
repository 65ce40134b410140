"""Translate, compile and run small .pf samples in a folder of their own."""

import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
TRANSLATOR = ROOT / "tools/building/pf2f90.py"
FLAGS = (
    "-Og -g -frecursive -fimplicit-none -std=f2018 -Wall -Wextra -pedantic -Werror "
    "-Wno-compare-reals -fcheck=all -fbacktrace -ffpe-trap=invalid,zero,overflow "
    "-finit-real=snan"
).split()


def run(command, folder):
    return subprocess.run(
        [str(word) for word in command],
        cwd=folder,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        timeout=3000,
        check=False,
    )


class Sample:
    """A folder with .pf files, used as a context manager."""

    compiled = None  # folder with the compiled funit, shared by all samples

    def __init__(self, files):
        self.files = files

    def __enter__(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)
        for name, text in self.files.items():
            self.write(name, text)
        self.generated.mkdir(parents=True)
        return self

    def __exit__(self, *problem):
        self.temporary.cleanup()

    @property
    def generated(self):
        return self.folder / "generated"

    def write(self, name, text):
        path = self.folder / "test" / "pf" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def translate(self):
        return run([sys.executable, TRANSLATOR, "--target", "generated"], self.folder)

    def build(self):
        """Translate and compile; the text of what went wrong, or nothing."""
        translation = self.translate()
        if translation.returncode != 0:
            return translation.stderr
        sources = [*self.generated.glob("generated_support_*.f90"),
                   *sorted(self.generated.glob("generated_*test_*.f90"))]
        sources.append(self.generated / "generated_runner.f90")
        funit = compile_funit()
        command = ["gfortran", *FLAGS, "-I", funit, "-o", "runner"]
        compilation = run([*command, *sources, *funit.glob("*.o")], self.folder)
        return compilation.stderr

    def run(self, *arguments):
        return run([self.folder / "runner", *arguments], self.folder)


def compile_funit():
    """Compile funit once for all samples."""
    if Sample.compiled is None:
        Sample.compiled = tempfile.TemporaryDirectory()
        sources = [ROOT / "test" / "funit" / name for name in ("funit.f90", "funit_runner.f90")]
        compilation = run(["gfortran", *FLAGS, "-c", *sources], Sample.compiled.name)
        if compilation.returncode != 0:
            raise RuntimeError(compilation.stderr)
    return pathlib.Path(Sample.compiled.name)


def module(name, body, before_contains=""):
    """The text of a .pf file: a module of this name around some routines."""
    return (
        f"module {name}\n"
        "    use funit\n"
        "    use, intrinsic :: iso_fortran_env, only: real64, int64\n"
        "    use, intrinsic :: ieee_arithmetic\n"
        "    implicit none\n"
        f"{before_contains}"
        "contains\n"
        f"{body}"
        f"end module {name}\n"
    )


def test(name, *lines):
    """One @test subroutine."""
    body = "".join(f"        {line}\n" for line in lines)
    return f"    @test\n    subroutine {name}()\n{body}    end subroutine {name}\n"
