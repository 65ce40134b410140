#!/usr/bin/env python3
"""Try to build the tree with other compilers, and print a table of how it went.

They are gfortran 12, the newest gfortran and the newest flang that Debian offers here. Built are
the core, the library of the command line with what it needs, and both programs. What is
missing is installed first, as root or with sudo. What cannot be installed or does not build is
told with its first error; the rest of what a compiler said is in build/logs/. Exit code 1 if a
compiler that was tried does not build all, or none could be tried.
"""

import pathlib
import re
import shutil
import subprocess
import sys

import debian

ROOT = pathlib.Path(__file__).resolve().parents[2]
FPM = ROOT / ".venv" / "bin" / "fpm"
# fpm knows compilers by their names: flang-22 stands here under the one that it knows.
LINKS = ROOT / "build" / "compilers"
LOGS = ROOT / "build" / "logs"
# For fast builds.
FLAGS = {"gfortran": "-O1 -frecursive -fimplicit-none -std=f2018", "flang": "-O1"}
PARTS = (("core", "."), ("command", "app/command"), ("programs", "app"))


def main():
    wanted = dict.fromkeys(("gfortran-12", debian.newest("gfortran") or "gfortran-N",
                            debian.newest("flang") or "flang-N"))
    rows = [("compiler", "version", *(part for part, _ in PARTS), "remark")]
    bad = tried = 0
    for name in wanted:
        row = attempt(name)
        rows.append((name, *row))
        tried += row[0] != "-"
        bad += "fails" in row
    widths = [max(map(len, column)) for column in zip(*rows)]
    for row in rows:
        print("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip())
    return 1 if bad or not tried else 0


def attempt(name):
    """Version, how each part went, and a remark of one compiler."""
    nothing = ("-",) * (1 + len(PARTS))
    if name.endswith("-N"):
        return *nothing, f"Debian offers no {name} here"
    if not shutil.which(name):
        print(f"installing {name}", file=sys.stderr, flush=True)
        trouble = debian.install(name)
        if not shutil.which(name):
            return *nothing, trouble or "installed, but there is no program of that name"
    said = subprocess.run([name, "--version"], capture_output=True, encoding="utf-8", check=False)
    version = re.search(r"\d+\.\d+\.\d+", said.stdout)
    kind = name.partition("-")[0]
    program = name
    if kind == "flang":
        LINKS.mkdir(parents=True, exist_ok=True)
        link = LINKS / "flang-new"
        link.unlink(missing_ok=True)
        link.symlink_to(shutil.which(name))
        program = str(link)
    cells, remark = [], ""
    for part, package in PARTS:
        print(f"{name}: {part}", file=sys.stderr, flush=True)
        trouble = build(name, part, program, package, FLAGS[kind])
        cells.append("fails" if trouble else "builds")
        remark = remark or trouble
    return version[0] if version else "not known", *cells, remark


def build(name, part, program, package, flags):
    """Build one package; the first error if it fails."""
    LOGS.mkdir(parents=True, exist_ok=True)
    log = LOGS / f"{name}-{part}.log"
    with open(log, "wb") as stream:
        code = subprocess.run([FPM, "build", "-C", package, "--compiler", program, "--c-compiler",
                               "gcc", "--flag", flags], cwd=ROOT, stdin=subprocess.DEVNULL,
                              stdout=stream, stderr=subprocess.STDOUT, check=False).returncode
    if code == 0:
        return ""
    lines = log.read_text(encoding="utf-8", errors="replace").splitlines()
    # A compiler's own words name the place; fpm's and those of gfortran's second line do not.
    first = next((line for line in lines if re.search(r":\d+:\d+.*error", line.lower())), None) \
        or next((line for line in lines if "error" in line.lower()), (lines or ["no word"])[-1])
    return f"{first.strip()[:160]} (all of it: {log.relative_to(ROOT)})"


if __name__ == "__main__":
    sys.exit(main())
