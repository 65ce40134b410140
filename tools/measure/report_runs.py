#!/usr/bin/env python3
"""Do the runs of a list one after the other, so that times are not disturbed, and report them.

    report_runs.py [-o FOLDER] [--quick] [--runs FILE] [--manifest FILE]

What each run said and wrote goes into FOLDER/data, how it ended and how long it took into
FOLDER/data/runs.csv. Then plots/report.py compares the figures with references as the manifest
says, and writes report.md, report.html, verdicts.csv and pictures. Exit code 1 if a comparison
fails. `{data}` and `{figures}` in the list stand for the folders of the report.
"""

import argparse
import csv
import glob
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "plots"))

from faststrip_plots.tables import InputError, read_table  # noqa: E402

PARTS = ("data", "figures")
COLUMNS = ("id", "exit_code", "seconds", "words")
# When a run is wanted: in the full report, in the quick one.
WHEN = {"always": (True, True), "full": (True, False), "quick": (False, True)}
PROGRAMS = {"faststrip": [str(ROOT / "bin" / "faststrip")],
            "faststrip-lab": [str(ROOT / "bin" / "faststrip-lab")],
            "python": [sys.executable]}
# What the runs are told: pictures also as SVG, one thread for LAPACK.
ENVIRONMENT = {"FASTSTRIP_SVG": "1", "MPLBACKEND": "Agg", "OPENBLAS_NUM_THREADS": "1"}
NOT_FOUND = 127  # as the shell says of a program that cannot be run


class Usage(Exception):
    """A wrong call, in one line."""


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise Usage(message)


def main(words=None):
    parser = Parser(prog="./run report", description=__doc__,
                    formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", dest="folder", default="out/report", metavar="FOLDER",
                        help="write there (default out/report)")
    parser.add_argument("--quick", action="store_true",
                        help="only the runs that take a few seconds")
    parser.add_argument("--runs", default=str(ROOT / "reference/report_runs.csv"), metavar="FILE",
                        help="the runs (default reference/report_runs.csv)")
    parser.add_argument("--manifest", default=str(ROOT / "reference/comparisons.csv"),
                        metavar="FILE", help="the comparisons (default reference/comparisons.csv)")
    try:
        options = parser.parse_args(words)
        if not options.folder:
            raise Usage("-o must be a folder, got ''")
        runs = read_runs(options.runs, options.quick)
        if not os.path.isfile(options.manifest):
            raise InputError(f"no such file: {options.manifest}")
        for path in (options.runs, options.manifest):
            refuse_input_inside(options.folder, path)
        make_folder(options.folder)
        do_runs(runs, options.folder)
        judge(options)
    except Usage as error:
        tell(f"{error}; see ./run report --help")
        return 2
    except InputError as error:
        tell(str(error))
        return 1
    return 0


def tell(text):
    """One line on stderr, whatever the text holds."""
    safe = "".join(c if c.isprintable() else f"\\x{ord(c):02x}" for c in text)
    print(f"report: {safe}", file=sys.stderr, flush=True)


def read_runs(path, quick):
    """The rows of the list that are wanted, each with its number and how many there are."""
    table = read_table(path, ("id", "when", "program", "words"))
    runs = []
    columns = (table.words(name) for name in ("id", "when", "program", "words"))
    for row, (name, when, program, words) in enumerate(zip(*columns, strict=True)):
        where = f"({path}:{table.lines[row]})"
        if when not in WHEN:
            raise InputError(f"when must be always, full or quick, got {when} {where}")
        if program not in PROGRAMS:
            raise InputError(f"program must be faststrip, faststrip-lab or python, got {program}"
                             f" {where}")
        if not name or "/" in name:
            raise InputError(f"id must be the name of a file, got '{name}' {where}")
        try:
            shlex.split(words)
        except ValueError as error:
            raise InputError(f"words must be those of a command, got {words}: {error} {where}"
                             ) from None
        if WHEN[when][quick]:
            runs.append((f"run {row + 1} of {len(table)}", name, program, words))
    return runs


def refuse_input_inside(folder, path):
    """A list that stands where the older report goes would go with it."""
    for part in PARTS:
        inside = pathlib.Path(folder, part).resolve()
        if pathlib.Path(path).resolve().is_relative_to(inside):
            raise Usage(f"-o must not be a folder whose files are read, got {folder} with {path}")


def make_folder(folder):
    """An older report goes; a folder that is no report stays as it is."""
    try:
        if os.path.lexists(os.path.join(folder, "data", "runs.csv")):
            for part in PARTS:
                shutil.rmtree(os.path.join(folder, part), ignore_errors=True)
        for part in PARTS:
            os.makedirs(os.path.join(folder, part), exist_ok=True)
    except OSError as error:
        raise InputError(f"cannot make the folder: {folder} ({error.strerror})") from None


def do_runs(runs, folder):
    """Do the runs; how each ended and how long it took goes into runs.csv at once."""
    data = os.path.join(folder, "data")
    with open(os.path.join(data, "runs.csv"), "w", encoding="utf-8", newline="") as stream:
        stream.write(stamp())
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(COLUMNS)
        for number, name, program, words in runs:
            tell(f"{number}: {name}")
            stream.flush()
            said = os.path.join(data, f"{name}.txt")
            start = time.monotonic()
            code = run([*PROGRAMS[program], *command_words(words, seen_from_root(folder))], said)
            seconds = time.monotonic() - start
            if code != 0:
                tell(f"run {name} ended with exit code {code}: see {folder}/data/{name}.txt")
            writer.writerow((name, code, f"{seconds:.6f}", words))


def stamp():
    """The comments that say what made a CSV file, as the program writes them."""
    done = subprocess.run([*PROGRAMS["faststrip"], "integral", "--n", "0", "--b", "1"],
                          capture_output=True, encoding="utf-8", check=False)
    return "".join(line for line in done.stdout.splitlines(keepends=True) if line.startswith("#"))


def seen_from_root(path):
    """A path for commands that run in the checkout: as short as it may be, for what they print."""
    path = pathlib.Path(path).absolute()
    return str(path.relative_to(ROOT) if path.is_relative_to(ROOT) else path)


def command_words(words, folder):
    """The words of a run; a pattern stands for the files that fit, in their order."""
    result = []
    for word in shlex.split(words):
        fill = {f"{{{part}}}": os.path.join(folder, part) for part in PARTS}
        pattern = literal = word
        for name, path in fill.items():
            pattern = pattern.replace(name, glob.escape(path))
            literal = literal.replace(name, path)
        found = sorted(glob.glob(pattern, root_dir=ROOT)) if "*" in word else []
        result += found or [literal]
    return result


def run(words, said):
    """Run a command from the checkout; its exit code as the shell has it."""
    with open(said, "wb") as stream:
        try:
            code = subprocess.run(words, cwd=ROOT, env=os.environ | ENVIRONMENT, stdout=stream,
                                  stdin=subprocess.DEVNULL, stderr=subprocess.STDOUT,
                                  check=False).returncode
        except OSError as error:
            stream.write(f"{words[0]}: {error.strerror}\n".encode())
            return NOT_FOUND
    return 128 - code if code < 0 else code


def judge(options):
    """Let plots/report.py compare, draw and write."""
    words = [sys.executable, str(ROOT / "plots" / "report.py"), "--manifest",
             seen_from_root(options.manifest), "--folder", seen_from_root(options.folder)]
    code = subprocess.run(words + ["--quick"] * options.quick, cwd=ROOT,
                          env=os.environ | {"MPLBACKEND": "Agg"}, check=False).returncode
    if code != 0:
        raise InputError("the report has comparisons that fail, or could not be written:"
                         f" {options.folder}/report.md")


if __name__ == "__main__":
    sys.exit(main())
