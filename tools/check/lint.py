#!/usr/bin/env python3
"""Check the form of the sources, and count the checks.

    lint.py [--filter TEXT] [--install] [FOLDER]

    ruff        Python files, by the rules of tools/check/ruff.toml
    fortitude   Fortran files, by the rules of tools/check/fortitude.toml
    shellcheck  shell scripts; skipped where it is not installed (--install installs it from Debian)
    columns     at most 100 characters in a line; tables, CSV, lines with an address and what
                programs print are free in Markdown
    blanks      no tab, no blank at the end of a line, one end of line at the end of a file

Checked are the files that git knows or would take; without git all that do not lie below build/,
out/ and the like. The last line is `all modules together: N passed, N failed[, N skipped]`; exit 1
if any failed. With --filter only checks run whose `lint::name` contains TEXT.
"""

import argparse
import os
import pathlib
import shutil
import subprocess
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "building"))
import debian  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
COLUMNS = {".f90": 100, ".py": 100, ".sh": 100, ".md": 100, ".pf": 100, ".c": 100, ".h": 100}
SCRIPTS = ("run", ".ci/run")
NOT_SOURCES = {".git", ".venv", "build", "bin", "out", "__pycache__"}


class Skipped(Exception):
    """Why a check cannot be done."""


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--filter", default="", metavar="TEXT")
    parser.add_argument("--install", action="store_true")
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=ROOT, metavar="FOLDER")
    options = parser.parse_args()
    names = sources(options.folder)
    counts = {"passed": 0, "failed": 0, "skipped": 0}
    for check in (ruff, fortitude, shellcheck, columns, blanks):
        if options.filter not in f"lint::{check.__name__}":
            continue
        try:
            found = check(options.folder, names, options.install)
        except Skipped as why:
            counts["skipped"] += 1
            print(f"lint::{check.__name__:37} skipped: {why}", flush=True)
            continue
        counts["failed" if found else "passed"] += 1
        print("\n".join([*found, f"lint::{check.__name__:37} {'FAILED' if found else 'passed'}"]),
              flush=True)
    skipped = f", {counts['skipped']} skipped" if counts["skipped"] else ""
    print(f"{'all modules together:':43} {counts['passed']} passed, {counts['failed']} failed"
          + skipped)
    return 1 if counts["failed"] else 0


def sources(folder):
    """The files of a checkout, as seen from there."""
    try:
        done = subprocess.run(["git", "ls-files", "-z", "--cached", "--others",
                               "--exclude-standard"], cwd=folder, capture_output=True, check=True)
        names = [os.fsdecode(name) for name in done.stdout.split(b"\0") if name]
    except (OSError, subprocess.CalledProcessError):
        names = []
        for place, folders, files in os.walk(folder):
            folders[:] = [name for name in folders if name not in NOT_SOURCES]
            names += [os.path.relpath(os.path.join(place, name), folder) for name in files]
    return sorted(name for name in set(names) if (folder / name).is_file())


def ending(names, *suffixes):
    return [name for name in names if name.endswith(suffixes)]


def told_by(folder, *words):
    """What a checker said, if it found anything."""
    done = subprocess.run(words, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          encoding="utf-8", errors="replace", check=False)
    return [] if done.returncode == 0 else done.stdout.splitlines() or ["it failed without a word"]


def beside_python(name):
    """A checker that .venv holds."""
    path = pathlib.Path(sys.executable).parent / name
    if not path.exists():
        raise Skipped(f"{name} is not beside {sys.executable}")
    return path


def ruff(folder, names, _):
    files = ending(names, ".py")
    return told_by(folder, beside_python("ruff"), "check", "--quiet", "--no-cache", "--config",
                   ROOT / "tools/check/ruff.toml", "--output-format", "concise", "--", *files
                   ) if files else []


def fortitude(folder, names, _):
    # Hosts are written as hosts are.
    files = [name for name in ending(names, ".f90") if not name.startswith("example/")]
    return told_by(folder, beside_python("fortitude"), "--config-file",
                   ROOT / "tools/check/fortitude.toml", "check", "--quiet", "--output-format",
                   "concise", *files) if files else []


def shellcheck(folder, names, install):
    why = "it is not installed; ./run lint installs it"
    if install and not shutil.which("shellcheck"):
        why = debian.install("shellcheck")
    if not shutil.which("shellcheck"):
        raise Skipped(why)
    files = [name for name in names if name in SCRIPTS or name.endswith(".sh")]
    return told_by(folder, "shellcheck", "--format", "gcc", "--", *files) if files else []


def columns(folder, names, _):
    found = []
    for name in names:
        most = 100 if name in SCRIPTS else COLUMNS.get(pathlib.Path(name).suffix)
        if most is None:
            continue
        lines = lines_of(folder / name)
        # A page that a tool writes may be as wide as that likes.
        if name.endswith(".md") and lines and lines[0].startswith("<!-- Written by "):
            continue
        printed = False
        for number, line in enumerate(lines, start=1):
            if name.endswith(".md") and line.startswith("```"):
                printed = line in ("```output", "```csv")
            free = name.endswith(".md") and (printed or line.lstrip().startswith("|")
                                             or "://" in line or "<!--" in line)
            if len(line) > most and not free:
                found.append(f"{name}:{number}: {len(line)} columns, at most {most}")
    return found


def blanks(folder, names, _):
    found = []
    for name in names:
        if name not in SCRIPTS and pathlib.Path(name).suffix not in COLUMNS:
            continue
        lines = lines_of(folder / name)
        for number, line in enumerate(lines, start=1):
            if "\t" in line:
                found.append(f"{name}:{number}: a tab")
            if line != line.rstrip():
                found.append(f"{name}:{number}: a blank at the end of the line")
        if lines and (lines[-1] == "" or not (folder / name).read_bytes().endswith(b"\n")):
            found.append(f"{name}:{len(lines)}: not one end of line at the end of the file")
    return found


def lines_of(path):
    """Lines without their ends, in characters."""
    text = path.read_bytes().decode("utf-8", errors="replace")
    return text.removesuffix("\n").split("\n") if text else []


if __name__ == "__main__":
    sys.exit(main())
