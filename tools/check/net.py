#!/usr/bin/env python3
"""Keep every figure that the program and the hosts give, and say which of them a change moves.

    net.py --installed PREFIX [--keep] [--folder FOLDER]

Runs the 20 contacts of reference/contact by every method and by auto, the cases of example/, a
sweep, a wheelset, conicities, two small lookup tables and the hosts of example/hosts. What each
run gives is kept in FOLDER/new (default out/net), without times and stamps, and its SHA-256 in
FOLDER/new.csv. It is then compared with FOLDER/kept: each output that is another one is named, with
the column whose numbers differ most. With --keep, or where nothing is kept yet, today's outputs
become the kept ones. Exit code 1 if any output is another one.

The bits are those of a compiler and of a processor, so they are kept beside the build, not in the
repository: keep them before a change, run again after it.
"""

from __future__ import annotations

import argparse
import csv
import hashlib
import importlib
import math
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "generate"))
import methods  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
CONTACTS = ROOT / "reference" / "contact"
# Not figures: the stamp of a file, times in columns and in words.
STAMP = re.compile(r"# (faststrip|compiler) ")
TIME_COLUMNS = ("normal_us", "tangential_us", "lookup_us")
TIME = re.compile(r"\d+(\.\d+)? us\b")
# Of auto: what it is asked for.
TARGETS = (("forces", "0.02"), ("forces", "0.002"), ("pmax", "0.02"), ("penetration", "0.001"),
           ("area", "0.02"), ("power", "0.02"))
# What the shell runs in a folder of its own, beside the contacts: name, command, further outputs.
RUNS = (
    ("sweep", "faststrip sweep {example}/s1002_uic60.nml -o sweep.csv"),
    ("sweep_rising", "faststrip sweep {example}/wheelset_shift.nml --normal kpec --tangential "
                     "polach -o sweep_rising.csv"),
    ("traction", "faststrip batch {example}/traction_curve.csv --normal hertz -o traction.csv"),
    ("wheelset", "faststrip wheelset {example}/wheelset_states.nml --states "
                 "{example}/wheelset_states.csv -o wheelset.csv --strips wheelset_strips.csv "
                 "--profiles wheelset_profiles.csv --near-jumps 1"),
    ("conicity", "faststrip conicity {example}/wheelset_states.nml -o conicity.csv --functions "
                 "functions.csv"),
    ("integral", "faststrip integral --n 3 --b 0.4 --x 0.7 -o integral.csv"),
    ("table", "faststrip table -o table.csv"),
    ("curves", "faststrip table --curves curves.csv"),
    ("lookup", "faststrip lookup make -o hertz.fslt --error 0.2 --tests 299 --threads 2"),
    ("lookup_wheel", "faststrip lookup wheel {example}/wheelset_states.nml -o wheel.fslt --y 0:2 "
                     "--load 60000:80000 --error 0.2 --least-step 0.2 --tests 299"),
)
EXAMPLE = ("faststrip contact {case} -o {name}.csv --strips {name}_strips.csv --fields "
           "{name}_fields.csv --gap {name}_gap.csv")
HOSTS = ("figures", "wheelset")
COMPILERS = {".f90": "gfortran -O1 -J.", ".c": "gcc -O1", ".f": "gfortran -std=legacy -O1"}


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--installed", type=pathlib.Path, required=True, metavar="PREFIX",
                        help="where ./run install went: program and library")
    parser.add_argument("--keep", action="store_true", help="today's outputs become the kept ones")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "out" / "net")
    options = parser.parse_args()
    new, kept = options.folder / "new", options.folder / "kept"
    shutil.rmtree(new, ignore_errors=True)
    new.mkdir(parents=True)
    run_all(options.installed.absolute(), new)
    sums = [(path.name, hashlib.sha256(path.read_bytes()).hexdigest())
            for path in sorted(new.iterdir())]
    with open(options.folder / "new.csv", "w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows([("output", "sha256"), *sums])
    changed = compare(kept, new) if kept.exists() else []
    for line in changed:
        print(line)
    print(f"{len(sums)} outputs, " + (f"{len(changed)} of them others than kept"
                                      if kept.exists() else "kept"))
    if options.keep or not kept.exists():
        shutil.rmtree(kept, ignore_errors=True)
        shutil.copytree(new, kept)
    sys.exit(bool(changed) and not options.keep)


def run_all(prefix, new):
    """Run everything; one output a file of `new`."""
    with tempfile.TemporaryDirectory() as folder:
        here = pathlib.Path(folder)
        environment = os.environ | {
            "PATH": f"{prefix / 'bin'}{os.pathsep}{os.environ['PATH']}",
            "PKG_CONFIG_PATH": str(prefix / "lib" / "pkgconfig"),
            "LD_LIBRARY_PATH": str(prefix / "lib"), "OPENBLAS_NUM_THREADS": "1"}

        def shell(name, line):
            """Run a line; what it printed, with its exit code, is an output, too."""
            print(f"  {name}", file=sys.stderr, flush=True)
            done = subprocess.run(["sh", "-c", line], cwd=here, env=environment,
                                  stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, encoding="utf-8", check=False)
            said = "".join(row for row in done.stdout.replace(f"{ROOT}{os.sep}", "")
                           .splitlines(keepends=True)
                           if not re.match(r"faststrip.*, \d+ s\b", row))
            (new / f"{name}.txt").write_text(f"{TIME.sub('us', said)}exit code {done.returncode}\n",
                                             encoding="utf-8")

        write_batch(here / "contacts.csv")
        for name, words in choices():
            shell(name, f"faststrip batch contacts.csv -o {name}.csv --quiet {words}")
        names = {"example": shlex.quote(str(ROOT / "example"))}
        for name, line in RUNS:
            shell(name, line.format(**names))
        for case in sorted((ROOT / "example" / "cases").glob("*.nml")):
            for ending, words in (("", ""), ("_auto", " --normal auto")):
                name = f"case_{case.stem}{ending}"
                shell(name, EXAMPLE.format(case=shlex.quote(str(case)), name=name) + words)
        (here / "contacts.csv").unlink()
        (here / "figures.txt").write_text(input_of_figures(), encoding="utf-8")
        for name in HOSTS:
            for ending, compiler in COMPILERS.items():
                source = shlex.quote(str(ROOT / "example" / "hosts" / (name + ending)))
                given = " <figures.txt" if name == "figures" else ""
                shell(f"host_{name}{ending.replace('.', '_')}",
                      f"{compiler} {source} $(pkg-config --cflags --libs faststrip) -o host"
                      f" && ./host{given}")
        for path in sorted([*here.glob("*.csv"), *here.glob("*.fslt")]):
            (new / path.name).write_bytes(without_stamps(path))


def write_batch(path):
    """The 20 contacts of the paper, both of Table 2's sign sets, as a batch."""
    rows = []
    for signs in "AB":
        text = (CONTACTS / f"s1002_uic60_{signs}.csv").read_text(encoding="utf-8")
        for row in csv.DictReader(line for line in text.splitlines() if not line.startswith("#")):
            gap = CONTACTS / "gaps" / f"shift_{row['yw_mm']}.csv"
            rows.append((f"{signs}{row['yw_mm']}", gap, 2.0 * 82000.0 * 1.28, 0.28, 0.3,
                         row["Fn_N"], row["cksi"], row["ceta"], row["cphi_rad_per_mm"]))
    with open(path, "w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows([("case", "gap_file", "E_MPa", "nu", "mu", "N_N", "cksi", "ceta",
                                     "cphi_rad_per_mm"), *rows])


def choices():
    """Names and options of all methods: each normal one with each tangential one but the
    references, these with their like, and auto for each target."""
    listed = methods.read_methods((ROOT / methods.LIST).read_text(encoding="utf-8"))
    for normal in (method.name for method in listed["normal"]):
        if normal == "auto":
            for target, tolerance in TARGETS:
                yield (f"auto_{target}_{tolerance}",
                       f"--normal auto --target {target} --tolerance {tolerance}")
            continue
        for tangential in (method.name for method in listed["tangential"]):
            if (normal == "norm") == (tangential in ("tang", "none", "fastsim")):
                elements = " --element-dx 0.4 --element-dy 0.4" if tangential == "tang" else ""
                yield (f"{normal}_{tangential}",
                       f"--normal {normal} --tangential {tangential}{elements}")


def input_of_figures():
    """What the hosts that print every figure read: the contacts of their test."""
    sys.path[:0] = [str(ROOT / place)
                    for place in ("test", "test/embed", "tools/docs", "tools/measure")]
    return importlib.import_module("test_figures").input_text()


def without_stamps(path):
    """The bytes of an output without what says when, where and by which revision it was made."""
    if path.suffix != ".csv":
        return path.read_bytes()
    text = path.read_text(encoding="utf-8").replace(f"{ROOT}{os.sep}", "")
    lines = [line for line in text.splitlines() if not STAMP.match(line)]
    comments = [line for line in lines if line.startswith("#")]
    rows = list(csv.reader(lines[len(comments):]))
    timed = {i for i, name in enumerate(rows[0]) if name in TIME_COLUMNS}
    text = [*comments, *(",".join("" if i in timed and row is not rows[0] else TIME.sub("us", cell)
                                  for i, cell in enumerate(row)) for row in rows)]
    return "".join(f"{line}\n" for line in text).encode()


def compare(kept, new):
    """A line for each output that is missing, new or another one than it was."""
    names = {path.name for folder in (kept, new) for path in folder.iterdir()}
    changed = []
    for name in sorted(names):
        before, after = kept / name, new / name
        if not before.exists() or not after.exists():
            changed.append(f"{name}: {'new' if after.exists() else 'no longer there'}")
        elif before.read_bytes() != after.read_bytes():
            changed.append(f"{name}: {difference(before, after)}")
    return changed


def difference(before, after):
    """What differs most between two outputs."""
    if before.suffix != ".csv":
        return f"{before.stat().st_size} bytes, now {after.stat().st_size}"
    old, new = (list(csv.DictReader(line for line in path.read_text(encoding="utf-8").splitlines()
                                    if not line.startswith("#"))) for path in (before, after))
    widths = [len(table[0]) if table else 0 for table in (old, new)]
    if len(old) != len(new) or old and list(old[0]) != list(new[0]):
        return f"{len(old)} rows of {widths[0]} columns, now {len(new)} of {widths[1]}"
    largest, where, cells = -1.0, "comments alone", 0
    for i, (one, other) in enumerate(zip(old, new, strict=True), 1):
        for column in one:
            if one[column] == other[column]:
                continue
            cells += 1
            change = relative_change(one[column], other[column])
            if change > largest:
                largest, where = change, (f"most {column} of row {i}: {one[column]}, now "
                                          f"{other[column]}")
    return f"{cells} cells, {where}"


def relative_change(one, other):
    try:
        before, after = float(one), float(other)
    except ValueError:
        return math.inf
    return abs(after - before) / max(abs(before), abs(after), sys.float_info.min)


if __name__ == "__main__":
    main()
