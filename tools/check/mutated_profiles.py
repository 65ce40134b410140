#!/usr/bin/env python3
"""Try faststrip profile with mutated files, made from a seed.

    mutated_profiles.py [N] [--seed S] [--bank FOLDER]

Good profile files, small ones in every layout and those of a folder, are cut, shuffled, spoilt by
bytes and numbers, or joined. Each must give a profile or one line on stderr, within a second of
the processor, with exit code 0 or 1, and without a word of the run-time library. Prints what went
wrong, with the number that makes the file again, and a summary; exit code 1 if anything did.
"""

import argparse
import collections
import csv
import math
import pathlib
import random
import re
import resource
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "bin" / "faststrip"
NEVER = ("Fortran runtime error", "Backtrace", "Error termination", "At line", "Segmentation",
         "forrtl", "core dumped", "terminate called", "NaN")
STATUSES = {"ok", "file_format", "too_few_points", "file_missing", "bad_argument", "not_finite",
            "not_increasing", "out_of_range", "linear_algebra", "no_convergence"}
# How far long work is; no message.
PROGRESS = re.compile(r"faststrip: .*, \d+ s")
BATCH = 200
SECONDS = 1.0

# What is done to the points besides reading them, one of these a batch.
OPTIONS = ([], [], ["--kind", "wheel"], ["--kind", "rail"], ["--section", "1", "--any-count"],
           ["--smooth-wavelength", "3"], ["--smooth-noise", "10", "--drop-double", "0"],
           ["--resample", "0.5", "--drop-folds"], ["--unit", "m"], ["--z-positive-to", "up"],
           ["--tape-circle", "70"], ["--kind", "rail", "--nominal", "uic60"])


def rail_points(n=80):
    for i in range(n):
        angle = math.radians(170.0 * (i / (n - 1) - 0.5))
        yield 36.0 * math.sin(angle), 36.0 * (1.0 - math.cos(angle))


def wheel_points(n=100):
    for i in range(n):
        y = -68.0 + 128.0 * i / (n - 1)
        z = -0.05 * y
        if y < -50.0:
            z = 27.75 - 15.0 * ((-50.0 - y) / 18.0) ** 2
        elif y < -35.0:
            z = 1.75 + 26.0 * math.sin((-35.0 - y) / 15.0 * math.pi / 2.0) ** 2
        yield y, z


def good_files(bank):
    """Names and lines of the files that are mutated."""
    rail = [f"{y:.4f} {z:.4f}" for y, z in rail_points()]
    wheel = [f"{y:.4f} {z:.4f}" for y, z in wheel_points()]
    ban = [f"{-y:.4f} {-z:.4f} 0.1 0.02" for y, z in rail_points()]
    whl = [f"{y + 70.0:.4f} {z:.4f}" for y, z in wheel_points()]

    def simpack(kind, points):
        return ["header.begin", " version = 1", f" type = {kind}", "header.end", "spline.begin",
                " approx.smooth = 0", " point.dist.min = 0", " shift.y = 0.5", " rotate = 0.01",
                " bound.y.min = 1", " bound.y.max = 0", " mirror.y = 0", " inversion = 1",
                " units.len.f = 1000", " units.ang.f = 1", " comment = 'a ! b'", " point.begin",
                *points, " point.end", "spline.end"]

    section = ["XYPoints=80", "ColumnDef=X,Y,A,C"]
    files = [
        ("a.txt", rail), ("b.csv", ["y_mm,z_mm", *(line.replace(" ", ",") for line in wheel)]),
        ("c.prr", simpack(0, rail)), ("d.prw", simpack(1, wheel)),
        ("e.whl", ["MINIPROF 101", "a name", "32.5 28 10", "", *whl]),
        ("f.ban", ["MPTypeNo=299", "XOffset=0.0", "Other=x", *section, "", *ban]),
        ("g.whl", ["Sd=32.5", "XYPoints=100", "ColumnDef=X,Y", *whl]),
        ("h.mpt", ["[FileInfo]", "Date=1", "[Profile1Info]", *section, "[Profile1Points]", *ban,
                   "", "[Profile2Info]", *section, "[Profile2Points]", *ban]),
        ("i.rai", ["RAILPROFILE", "title", "GAUGEPOINT EUROPEAN", "GAUGE 1432", *(
            f"{-752 - y:.3f} {-z:.3f} {752 + y:.3f} {-z:.3f}" for y, z in rail_points())]),
        ("j.whe", ["WHEELPROFILE", "title", "TREADDATUM EUROPEAN", "FLANGEBACK 1360", *(
            f"{-750 - y:.3f} {z:.3f} {750 + y:.3f} {z:.3f}" for y, z in wheel_points())]),
        ("k.wheel", [f"{-y:.4f} {z:.4f} # x" for y, z in wheel_points()]),
        ("l.rail", rail),
    ]
    if bank is not None:
        files += [(path.name, path.read_text(encoding="latin-1").splitlines())
                  for path in sorted(bank.iterdir()) if path.is_file() and path.suffix != ".md"]
    return files


NUMBERS = ["1e308", "-1e308", "1e9", "1e-320", "NaN", "Inf", "-Infinity", "1e400", "0", "-0",
           "1d5", "0x10", "1,5", "--3", "1e", ".", "999999999999", "1.7976931348623159e308"]


def spoil_lines(rng, lines):
    """One change of whole lines or of words in them."""
    at = rng.randrange(len(lines)) if lines else 0
    kind = rng.randrange(12)
    if not lines:
        return [rng.choice(NUMBERS)]
    if kind == 0:
        del lines[at:at + rng.choice([1, 2, 10, 1000])]
    elif kind == 1:
        lines = lines[:at]
    elif kind == 2:
        lines = lines[at:]
    elif kind == 3:
        other = rng.randrange(len(lines))
        lines[at], lines[other] = lines[other], lines[at]
    elif kind == 4:
        head = lines[:20]
        rng.shuffle(head)
        lines[:20] = head
    elif kind == 5:
        lines[at:at] = lines[at:at + rng.choice([1, 3, 30])]
    elif kind == 6:
        lines[at:at + 40] = reversed(lines[at:at + 40])
    elif kind in (7, 8):
        words = lines[at].split() or [""]
        words[rng.randrange(len(words))] = rng.choice(NUMBERS)
        lines[at] = " ".join(words)
    elif kind == 9:
        key = lines[at].split("=")[0]
        lines[at] = f"{key}={rng.choice(NUMBERS)}"
    elif kind == 10:
        factor = rng.choice([1e-3, 1e3, -1.0, 25.4, 1e150, 0.0])
        lines = [" ".join(scaled(word, factor) for word in line.split()) for line in lines]
    else:
        lines[at] = rng.choice(["", "=", "'", '"', "point.begin", "point.end", "[Profile1Info]",
                                "ColumnDef=Y,X", "ColumnDef=,,,", "XYPoints=-1", "x" * 70000,
                                "WHEELPROFILE", "units.len.f = 1e-6", "point.dist.min = 1e9",
                                "rotate = 1e9", "bound.z.min=-1\nbound.z.max=1", "%" * 300])
    return lines


def scaled(word, factor):
    try:
        return f"{float(word) * factor:.6g}"
    except (ValueError, OverflowError):
        return word


def mutated(rng, files):
    """A name and the bytes of a file."""
    name, lines = rng.choice(files)
    lines = list(lines)
    for _ in range(rng.choice([1, 1, 1, 2, 4])):
        lines = spoil_lines(rng, lines)
    if rng.random() < 0.05:
        lines += rng.choice(files)[1]
    data = bytearray(rng.choice(["\n", "\n", "\n", "\r\n", "\r"]).join(lines).encode(
        "latin-1", "replace"))
    kind = rng.randrange(6)
    if kind == 0 and data:
        for _ in range(rng.choice([1, 1, 8])):
            data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)
    elif kind == 1 and data:
        at = rng.randrange(len(data))
        data[at:at] = rng.randbytes(rng.choice([1, 3, 300]))
    elif kind == 2 and rng.random() < 0.3:
        data = bytearray(rng.randbytes(rng.choice([0, 1, 1000, 5000])))
    if rng.random() < 0.1:
        name = rng.choice(["z.txt", "z.prw", "z.prr", "z.ban", "z.whl", "z.mpt", "z.rai", "z.csv"])
    return name, bytes(data)


def faults_of(done, seconds, names):
    """What is wrong with one run."""
    faults = []
    if done.returncode not in (0, 1):
        faults.append(f"exit code {done.returncode}")
    said = [line for line in done.stderr.decode("utf-8", "replace").splitlines()
            if not PROGRESS.fullmatch(line)]
    faults += [f"said {line!r}" for line in said
               if not line.startswith("faststrip: ") or any(word in line for word in NEVER[:-1])]
    if len(said) > len(names) + 1:
        faults.append(f"{len(said)} lines on stderr for {len(names)} files")
    text = done.stdout.decode("utf-8", "replace")
    rows = list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
    if len(rows) != len(names):
        faults.append(f"{len(rows)} rows for {len(names)} files")
    for row in rows:
        if row["status"] not in STATUSES or None in row.values():
            faults.append(f"a row of {row['file']} with the status {row['status']!r}")
        elif row["status"] == "ok" and "NaN" in "".join(row.values()):
            faults.append(f"NaN for {row['file']}")
    if seconds > SECONDS * (1 if len(names) == 1 else 10):
        faults.append(f"{seconds:.1f} s")
    return faults, rows


def run(folder, names, options):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        done = subprocess.run([str(PROGRAM), "profile", *options, *names], cwd=folder, check=False,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, timeout=120)
    except subprocess.TimeoutExpired:
        return ["no end within 120 s"], []
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return faults_of(done, after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime,
                     names)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("number", nargs="?", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--bank", type=pathlib.Path)
    arguments = parser.parse_args()
    files = good_files(arguments.bank)
    statuses = collections.Counter()
    n_bad = 0
    for first in range(0, arguments.number, BATCH):
        numbers = range(first, min(first + BATCH, arguments.number))
        options = OPTIONS[first // BATCH % len(OPTIONS)]
        with tempfile.TemporaryDirectory() as folder:
            names = []
            for i in numbers:
                rng = random.Random(f"{arguments.seed} {i}")
                name, data = mutated(rng, files)
                names.append(f"{i}_{name}")
                (pathlib.Path(folder) / names[-1]).write_bytes(data)
            faults, rows = run(folder, names, options)
            statuses.update(row["status"] for row in rows)
            if not faults:
                continue
            # One by one, to see which.
            for name in names:
                for fault in run(folder, [name], options)[0]:
                    n_bad += 1
                    print(f"{name} {' '.join(options)}: {fault}")
            if not n_bad:
                n_bad += 1
                print(f"{names[0]} to {names[-1]} {' '.join(options)}: {faults[:3]}")
    print(f"{arguments.number} files:", ", ".join(
        f"{count} {status}" for status, count in statuses.most_common()), f"; {n_bad} faults")
    return 1 if n_bad else 0


if __name__ == "__main__":
    sys.exit(main())
