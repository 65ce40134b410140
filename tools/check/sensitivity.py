#!/usr/bin/env python3
"""Halve and double each tuned number in a copy and measure what that does: reference/constants.csv.

    sensitivity.py [--only FILE:NAME]... [--room ROOM]... [--minutes M] [--jobs N] [-o FILE]

Tuned numbers are those that tools/check/constants.py finds. One after the other is halved and
doubled in a copy of the tree, one file is compiled and the programs are linked (the machinery of
tools/check/run_mutants.py), and these are run with the change and without:

    bench accuracy          20 contacts of the reference against CONTACT, 15 strips and auto
    bench forces            all tangential methods on 441 contacts
    fuzz --cases 60         random gaps by strips, and 20 by cells alone
    sweep --normal norm     20 contacts by kalker_normal and kalker_tangential, coarse

Columns: file, name, value; for `half` and `double` each: `outcome` (ok, does not compile, fails),
largest relative change of penetration, pmax and area on the 20 contacts, mean errors there with 15
strips after it (%), mean error of the method faststrip over mu N (%) and the largest change of a
force by any method, the largest relative change of penetration, pmax and area of the random gaps,
how many of them have another status, the largest change of an estimated error over the larger of
both, the largest change of kalker_normal's and kalker_tangential's answers, and the iterations of
the random gaps over those without the change, a measure of time that does not depend on what else
the machine does.

What was measured for the same code, comments apart, is kept in build/sensitivity and not measured
again; --minutes ends the run in time, and the numbers left over are not in the file. The first
rooms are those of the strips and their forces.
"""

import argparse
import concurrent.futures
import csv
import hashlib
import json
import os
import pathlib
import queue
import re
import shutil
import subprocess
import sys
import threading
import time

import constants
import run_mutants
from run_mutants import Base, Job, Unfit, files_of

ROOT = pathlib.Path(__file__).resolve().parents[2]
FLAGS = "-O2 -fopenmp -fPIC -frecursive -fimplicit-none -std=f2018"
ROOMS = ("normal", "tangential", "contact", "geometry", "kalker", "numerics", "influence")
FIRST = ("normal/strip", "normal/estimate", "normal/cells", "normal/sub_patches",
         "normal/limitations", "tangential/faststrip")
PROGRAM_SOURCES = ("src/", "app/")
FACTORS = ("half", "double")
COLUMNS = ("outcome", "change", "penetration_error", "pmax_error", "area_error", "force_error",
           "force_change", "random_change", "random_status", "estimate_change",
           "kalker_change", "iterations")
RUNS = {
    "accuracy": "bin/faststrip-lab bench accuracy -o {}",
    "forces": "bin/faststrip-lab bench forces -o {}",
    "random": "bin/faststrip-lab fuzz --cases 60 -o {}",
    "cells": "bin/faststrip-lab fuzz --cases 20 --solver cells -o {}",
    "kalker": "bin/faststrip sweep example/s1002_uic60.nml --normal norm --tangential tang"
              " --element-dx 0.8 --element-dy 0.8 -o {}",
}
TIME_LIMIT = 60.0


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", action="append", metavar="FILE:NAME")
    parser.add_argument("--room", action="append", choices=ROOMS)
    parser.add_argument("--minutes", type=float, default=float("inf"))
    parser.add_argument("--jobs", type=int, default=1, metavar="N")
    parser.add_argument("-o", type=pathlib.Path, default=ROOT / constants.MEASURED, dest="target")
    options = parser.parse_args()
    stamp = subprocess.run([str(ROOT / "bin" / "faststrip"), "--version"], check=True,
                           stdout=subprocess.PIPE, encoding="utf-8").stdout.strip()
    found, wrong = constants.read_rooms(ROOT)
    if wrong:
        sys.exit("\n".join(wrong))
    chosen = sorted((constant for constant in found if wanted(constant, options)), key=in_turn)
    if not chosen:
        sys.exit("sensitivity: no such number")
    end = time.monotonic() + 60.0 * options.minutes
    try:
        rows = measure_all(chosen, end, options.jobs)
    except Unfit as problem:
        sys.exit(f"sensitivity: {problem}")
    rows.sort(key=lambda row: (row["file"], row["name"]))
    with open(options.target, "w", encoding="utf-8", newline="") as stream:
        stream.write("# Tuned numbers halved and doubled, by tools/check/sensitivity.py, which"
                     f" explains the columns\n# {stamp}\n")
        names = [f"{factor}_{column}" for factor in FACTORS for column in COLUMNS]
        writer = csv.DictWriter(stream, ["file", "name", "value", *names], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    print(f"sensitivity: {len(rows) - 1} of {len(chosen)} numbers measured")


def wanted(constant, options):
    """Is it asked for, and can it be halved?"""
    if constant.kind == "type":
        return False
    if options.only and constant.key not in options.only:
        return False
    # What is measured says nothing of others: wheelsets, tables, the program.
    return constant.short.split("/")[0] in (options.room or ROOMS)


def in_turn(constant):
    first = [number for number, name in enumerate(FIRST) if constant.short.startswith(name)]
    room = ROOMS.index(constant.short.split("/")[0])
    return (first[0] if first else len(FIRST), room, constant.short, constant.line)


def changed(source, constant, factor):
    """The text of a file with one number halved or doubled."""
    lines = source.splitlines(keepends=True)
    start = sum(map(len, lines[:constant.line - 1]))
    found = re.compile(rf"(?<![\w%]){constant.name}\s*(?:\([^=]*?\))?\s*=\s*").search(source, start)
    at, depth = found.end(), 0
    while True:
        sign = source[at]
        if depth == 0 and (sign in ",!" or (sign == "\n" and source[found.end():at].rstrip()[-1:]
                                            != "&")):
            break
        depth += (sign in "([") - (sign in ")]")
        at += 1
    value = source[found.end():at].rstrip()
    if constant.kind == "real":
        new = f"{'0.5_wp' if factor == 'half' else '2.0_wp'}*({value})"
    else:
        new = f"({value})/2" if factor == "half" else f"2*({value})"
    return source[:found.end()] + new + source[found.end() + len(value):]


def hash_of_code():
    """Of all that is compiled, without its comments."""
    digest = hashlib.sha256()
    for name in files_of(ROOT):
        if name.suffix in (".f90", ".c", ".nml") and name.parts[0] in ("src", "app", "example"):
            text = (ROOT / name).read_text(encoding="utf-8")
            if name.suffix == ".f90":
                code = (constants.without_strings(line)[0].rstrip() for line in text.splitlines())
                text = "\n".join(line for line in code if line)
            digest.update(f"{name}\0{text}\0".encode())
    return digest.hexdigest()


def measure_all(chosen, end, count):
    """A row for each number, as far as the time goes, and one without a change."""
    run_mutants.FLAGS, run_mutants.TRAPS = FLAGS, ""
    store = ROOT / "build" / "sensitivity"
    store.mkdir(parents=True, exist_ok=True)
    record = store / f"{hash_of_code()[:16]}.jsonl"
    kept = {}
    if record.exists():
        for line in record.read_text(encoding="utf-8").splitlines():
            entry = json.loads(line)
            kept[entry["key"]] = entry["row"]
    left = [constant for constant in chosen if constant.key not in kept]
    if "" in kept and (not left or time.monotonic() > end):
        left = []
    else:
        base = Base(ROOT, sys.executable, "sensitivity")
        jobs = queue.Queue()
        for number_of_job in range(count):
            job = Job(base, number_of_job, {})
            job.clear()
            jobs.put(job)
        plain = measure(job, store / "plain")
        if plain is None:
            raise Unfit("the programs do not run without a change")
        kept[""] = {"file": "", "name": "", "value": "",
                    **{f"{factor}_{column}": value for factor in FACTORS
                       for column, value in compare(plain, plain).items()}}
    lock = threading.Lock()

    def keep(key):
        with lock, open(record, "a", encoding="utf-8") as stream:
            stream.write(json.dumps({"key": key, "row": kept[key]}) + "\n")

    def try_one(constant):
        if time.monotonic() > end:
            return
        job = jobs.get()
        try:
            kept[constant.key] = row_of(job, constant, plain)
        finally:
            jobs.put(job)
        keep(constant.key)
        outcomes = [kept[constant.key][f"{factor}_outcome"] for factor in FACTORS]
        print(constant.key, *outcomes, flush=True)

    if left or not record.exists():
        keep("")
    with concurrent.futures.ThreadPoolExecutor(count) as pool:
        list(pool.map(try_one, left))
    return [kept[key] for key in ["", *(constant.key for constant in chosen)] if key in kept]


def row_of(job, constant, plain):
    row = {"file": constant.short, "name": constant.name,
           "value": " ".join(constant.value.replace("&", " ").split())}
    path = job.folder / constant.file
    source = path.read_text(encoding="utf-8")
    for factor in FACTORS:
        row.update({f"{factor}_{column}": "" for column in COLUMNS})
        try:
            path.write_text(changed(source, constant, factor), encoding="utf-8")
            job.clear()
            job.compile(constant.file, PROGRAM_SOURCES)
            results = measure(job, job.folder / "changed")
        except Unfit:
            row[f"{factor}_outcome"] = "does not compile"
            continue
        finally:
            path.write_text(source, encoding="utf-8")
        if results is None:
            row[f"{factor}_outcome"] = "fails"
            continue
        compared = compare(plain, results)
        row.update({f"{factor}_{column}": value for column, value in compared.items()})
    return row


def measure(job, folder):
    """The tables that the programs of a job write; None if one fails."""
    job.link_programs()
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    environment = os.environ | {"OPENBLAS_NUM_THREADS": "1"}
    tables = {}
    for name, command in RUNS.items():
        path = folder / f"{name}.csv"
        try:
            done = subprocess.run(command.format(path).split(), cwd=job.folder, env=environment,
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                  timeout=TIME_LIMIT, check=False)
        except subprocess.TimeoutExpired:
            return None
        # The fuzz ends with 1 where a check fails, and batches where a row fails.
        if done.returncode not in (0, 1, 3) or not path.exists():
            return None
        with open(path, encoding="utf-8") as stream:
            tables[name] = list(csv.DictReader(line for line in stream if line[0] != "#"))
    return tables


def number(text):
    try:
        return float(text)
    except (TypeError, ValueError):
        return None


def largest_change(pairs, columns):
    """Largest relative difference of columns that both rows have."""
    largest = 0.0
    for old, new in pairs:
        for column in columns:
            a, b = number(old.get(column)), number(new.get(column))
            if a is not None and b is not None and max(abs(a), abs(b)) > 0.0:
                largest = max(largest, abs(a - b) / max(abs(a), abs(b)))
    return largest


def mean_size(rows, column):
    values = [abs(value) for row in rows if (value := number(row[column])) is not None]
    return sum(values) / len(values) if values else float("nan")


def iterations(tables):
    return sum(number(row["iterations"]) or 0.0 for row in tables["random"] + tables["cells"])


def compare(plain, results):
    """What the columns of the file say."""
    errors = ("penetration_err", "pmax_err", "area_err")
    accuracy = list(zip(plain["accuracy"], results["accuracy"]))
    # Errors are relative to CONTACT: 1 + error is the value.
    change = max((abs(number(a[name]) - number(b[name])) for a, b in accuracy for name in errors
                  if number(a[name]) is not None and number(b[name]) is not None), default=0.0)
    fifteen = [row for row in results["accuracy"] if row["strips"] == "15"]
    # Linear forces have no bound.
    forces = [pair for pair in zip(plain["forces"], results["forces"])
              if pair[0]["method"] != "linear"]
    force = max((abs(number(a[name]) - number(b[name])) for a, b in forces
                 for name in ("Fx_err", "Fy_err")
                 if number(a[name]) is not None and number(b[name]) is not None), default=0.0)
    own = [row for row in results["forces"]
           if row["method"] == "faststrip" and number(row["force_err"]) is not None]
    random = [pair for name in ("random", "cells") for pair in zip(plain[name], results[name])]
    sizes = ("penetration_mm", "pmax_MPa", "area_mm2")
    kalker = [(a, b) for a, b in zip(plain["kalker"], results["kalker"]) if a["normal"] == "norm"]
    values = {
        "change": change, "penetration_error": 100.0 * mean_size(fifteen, errors[0]),
        "pmax_error": 100.0 * mean_size(fifteen, errors[1]),
        "area_error": 100.0 * mean_size(fifteen, errors[2]),
        "force_error": mean_size(own, "force_err"), "force_change": 0.01 * force,
        "random_change": largest_change(random, sizes),
        "estimate_change": largest_change(random, ("est_penetration", "est_pmax", "est_area")),
        "kalker_change": largest_change(kalker, (*sizes, "Fx_N")),
        "iterations": iterations(results) / iterations(plain),
    }
    told = {name: f"{value:.4g}" for name, value in values.items()}
    told["random_status"] = str(sum(a["status"] != b["status"] for a, b in random))
    return {"outcome": "ok", **told}


if __name__ == "__main__":
    main()
