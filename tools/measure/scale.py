#!/usr/bin/env python3
"""Measure `faststrip batch` on many contacts: `./run scale`.

    scale.py [--quick] [-o FILE]    measure; the table on stdout, the same as CSV in FILE,
                                    its picture beside it (FILE's name with .png)
    scale.py --read FILE            print the table of such a file

Contacts are those of the paper's 20 gaps in turn, each under its own load and creepages. Groups of
the table: `method`, one thread each; `threads` and `parts`, the same contacts by more threads and
by processes that share parts, joining counted; `format`, sizes of input and results, as CSV and as
NetCDF; `memory`, peak memory against contacts; `on paper`, a thousand million contacts, by division
of the rows before. Of several rounds the least times count. `contacts_per_core_s` is by processor
time, `efficiency` by elapsed time: that of one thread over that of n, times n or the cores there
are. On a machine that does other things too only the former is steady.
"""

from __future__ import annotations

import csv
import io
import json
import math
import os
import random
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from speed import digits, measured_table

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "plots"))

from faststrip_plots.tables import InputError, read_table  # noqa: E402

CONTACTS = "reference/contact"
HEADER = "case,gap_file,E_MPa,nu,mu,N_N,cksi,ceta,cphi_rad_per_mm"
# Steel of the references: nu 0.28, G 82000 MPa.
MATERIAL = "209920,0.28,0.3"
NUMBERS = ("contacts", "processes", "threads", "cpu_s", "elapsed_s", "contacts_per_core_s",
           "efficiency", "peak_MB", "size_MB", "bytes_per_contact", "cores", "hours")
COLUMNS = ("group", "what", *NUMBERS)
# Normal and tangential method, contacts that take a second or two.
METHODS = (("hertz", "none", 100000), ("hertz", "polach", 100000), ("hertz", "fastsim", 20000),
           ("strip", "none", 4000), ("strip", "faststrip", 4000), ("norm", "tang", 40))
USUAL, LIGHT = ("strip", "faststrip"), ("hertz", "polach")
MEMORY = (10**4, 10**5, 10**6)
MOST, MOST_SECONDS = 10**7, 360.0
NETCDF = {"NetCDF double, of the CSV": (), "NetCDF single, of the CSV": ("--single",)}
PAPER, PAPER_CORES = 10**9, 1000
# Runs commands at the same time, out of a small process: the peak of a command is never below that
# of the process which started it.
RUNNER = """
import json, os, subprocess, sys, time
start, done = time.monotonic(), []
running = [subprocess.Popen(words, stdout=subprocess.DEVNULL) for words in json.load(sys.stdin)]
for process in running:
    _, state, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(state)
    done.append((process.returncode, usage.ru_utime + usage.ru_stime, usage.ru_maxrss))
codes, seconds, peaks = zip(*done)
print(json.dumps([max(map(abs, codes)), sum(seconds), time.monotonic() - start, max(peaks)]))
"""


def main(arguments=None):
    return measured_table(
        "scale", __doc__, "a tenth of the contacts, one round: half a minute",
        lambda quick: scale_csv(*measure(quick)), lambda path: shown(read_scale(path)), arguments)


# Measuring

def measure(quick):
    """Stamp lines and rows of the table."""
    rounds, share = (1, 10) if quick else (3, 1)
    # Not in /tmp, which may be memory: the largest table has gigabytes.
    (ROOT / "out").mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory(dir=ROOT / "out", prefix="scale-") as name:
        folder = Path(name)
        rows = method_rows(folder, rounds, share)
        stamps = comments(folder / "results.csv") + [f"processor {processor()}"]
        rows += shared_rows(folder, rounds, share)
        memory = memory_rows(folder, [count // share for count in MEMORY])
        rows += format_rows(folder, memory[-1])
        rows += memory + ([] if quick else most_rows(folder, memory[-1]))
    return stamps, rows + paper_rows(rows)


def note(words):
    print(f"scale: {words}", file=sys.stderr, flush=True)


def run(commands):
    """Run commands at the same time: processor seconds of all, elapsed seconds, largest peak, MB.

    One that fails is told in one line.
    """
    environment = os.environ | {"OPENBLAS_NUM_THREADS": "1", "MPLBACKEND": "Agg"}
    done = subprocess.run([sys.executable, "-I", "-S", "-c", RUNNER], input=json.dumps(commands),
                          capture_output=True, encoding="utf-8", errors="replace",
                          env=environment, check=False)
    if done.returncode != 0 or json.loads(done.stdout)[0] != 0:
        words = [os.path.basename(commands[0][0]), *commands[0][1:3]]
        lines = done.stderr.strip().splitlines() or [""]
        raise InputError(f"cannot run {' '.join(words)}: {lines[-1]}")
    _, cpu, elapsed, peak = json.loads(done.stdout)
    return cpu, elapsed, peak * 1024.0 / 1e6


def contacts(folder, count):
    """The path of a table of so many contacts; written if it is not there."""
    path = folder / f"contacts_{count}.csv"
    if path.exists():
        return path
    table = read_table(str(ROOT / CONTACTS / "s1002_uic60_B.csv"), ("yw_mm", "Fn_N"))
    base = list(zip(table.words("yw_mm"), table.numbers("Fn_N")))
    for case, _ in base:
        shutil.copy(ROOT / CONTACTS / "gaps" / f"shift_{case}.csv", folder)
    draw = random.Random(1).uniform
    with open(path, "w", encoding="utf-8") as stream:
        stream.write(HEADER + "\n")
        for k in range(count):
            case, load = base[k % len(base)]
            stream.write(f"{k},shift_{case}.csv,{MATERIAL},{load * draw(0.6, 1.2):.8g},"
                         f"{draw(-3e-3, 3e-3):.8g},{draw(-3e-3, 3e-3):.8g},"
                         f"{draw(-4e-4, 4e-4):.8g}\n")
    return path


def batch(folder, count, methods, threads=1, processes=1):
    """The least times of a batch, its peak, and the size of its results: a row of the table."""
    path, out = contacts(folder, count), folder / "results.csv"
    for old in (out, Path(f"{out}.manifest")):
        old.unlink(missing_ok=True)
    words = [str(ROOT / "bin" / "faststrip"), "batch", str(path), "-o", str(out), "--quiet",
             "--threads", str(threads), "--normal", methods[0], "--tangential", methods[1]]
    if processes > 1:
        words += ["--parts", str(processes)]
    cpu, elapsed, peak = run([words] * processes)
    return {"what": named(methods), "contacts": count, "processes": processes, "threads": threads,
            "cpu_s": cpu, "elapsed_s": elapsed, "contacts_per_core_s": count / cpu,
            "peak_MB": peak, **size(out, count)}


def size(path, count):
    length = path.stat().st_size
    return {"size_MB": length / 1e6, "bytes_per_contact": length / count}


def named(methods):
    return " + ".join(methods)


def lesser(one, other):
    """Of two rows of the same work the least times; the larger peak."""
    if one is None:
        return other
    cells = one | {name: min(one[name], other[name]) for name in ("cpu_s", "elapsed_s")}
    return cells | {"contacts_per_core_s": cells["contacts"] / cells["cpu_s"],
                    "peak_MB": max(one["peak_MB"], other["peak_MB"])}


def method_rows(folder, rounds, share):
    found = [None] * len(METHODS)
    for k in range(rounds):
        note(f"methods, round {k + 1} of {rounds}")
        for i, (*methods, count) in enumerate(METHODS):
            found[i] = lesser(found[i], batch(folder, count // share, methods))
    return [{"group": "method"} | cells for cells in found]


def shared_rows(folder, rounds, share):
    """More threads, and processes that share parts, over one thread."""
    ways = (("threads", 1, 1), ("threads", 2, 1), ("parts", 1, 4))
    found = []
    for methods in (LIGHT, USUAL):
        count = next(number for *names, number in METHODS if tuple(names) == methods) // share
        own = [None] * len(ways)
        for k in range(rounds):
            note(f"threads and parts of {named(methods)}, round {k + 1} of {rounds}")
            for i, (_, threads, processes) in enumerate(ways):
                own[i] = lesser(own[i], batch(folder, count, methods, threads, processes))
        found += [{"group": group} | cells | {"efficiency": efficiency(own[0], cells)}
                  for (group, *_), cells in zip(ways, own, strict=True)]
    return found


def efficiency(one, more):
    """Elapsed time of one thread over that of more, of what the cores there are could do."""
    cores = min(more["processes"] * more["threads"], len(os.sched_getaffinity(0)))
    return one["elapsed_s"] / (cores * more["elapsed_s"])


def memory_rows(folder, counts):
    found = []
    for count in counts:
        note(f"memory of {count} contacts")
        found.append({"group": "memory"} | batch(folder, count, LIGHT))
    return found


def format_rows(folder, solved):
    """The table of the batch that ran last, its input, and the same made NetCDF."""
    out, made = folder / "results.csv", folder / "results.nc"
    count = solved["contacts"]
    given = {"what": "input", "contacts": count, **size(contacts(folder, count), count)}
    found = [given, solved | {"what": "CSV, solved and written"}]
    for what, words in NETCDF.items():
        note(f"{what}: {count} contacts")
        cpu, elapsed, peak = run([[str(ROOT / "bin" / "faststrip"), "netcdf", str(out), "-o",
                                   str(made), *words]])
        found.append({"what": what, "contacts": count, "cpu_s": cpu, "elapsed_s": elapsed,
                      "contacts_per_core_s": count / cpu, "peak_MB": peak, **size(made, count)})
    return [{**cells, "group": "format"} for cells in found]


def most_rows(folder, last):
    """The largest table, if by the last one time and disk allow it."""
    times = MOST // last["contacts"]
    seconds, room = times * last["elapsed_s"], 3e6 * times * last["size_MB"]
    if seconds > MOST_SECONDS or room > shutil.disk_usage(folder).free:
        note(f"{MOST} contacts left out: they would take {seconds:.0f} s and {room / 1e9:.0f} GB")
        return []
    return memory_rows(folder, [MOST])


def paper_rows(rows):
    """A thousand million contacts by the rates and sizes of the other rows."""
    found = []
    for cells in rows:
        own = {"group": "on paper", "what": cells["what"], "contacts": PAPER}
        if cells["group"] == "method":
            rate = cells["contacts_per_core_s"]
            found.append(own | {"contacts_per_core_s": rate, "cores": PAPER_CORES,
                                "hours": PAPER / (rate * PAPER_CORES) / 3600.0})
        elif cells["group"] == "format":
            length = cells["bytes_per_contact"]
            found.append(own | {"bytes_per_contact": length, "size_MB": PAPER * length / 1e6})
    return found


def comments(path):
    """The stamps at the head of a result."""
    found = []
    with open(path, encoding="utf-8") as stream:
        for line in stream:
            if not line.startswith("#"):
                return found[:2]
            found.append(line[1:].strip())
    return found[:2]


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as stream:
        for line in stream:
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return "unknown"


# The table

def scale_csv(stamps, rows):
    """The text of the CSV."""
    stream = io.StringIO()
    for line in [*stamps, "written by ./run scale; MB are 10^6 bytes; on paper: hours = contacts /"
                 " (contacts_per_core_s * cores) / 3600"]:
        stream.write(f"# {line}\n")
    writer = csv.DictWriter(stream, COLUMNS, lineterminator="\n")
    writer.writeheader()
    for cells in rows:
        writer.writerow({name: f"{cell:.6g}" if isinstance(cell, float) else cell
                         for name, cell in cells.items()})
    return stream.getvalue()


def read_scale(path):
    """The rows of such a file: words, and numbers that are NaN where there is none."""
    table = read_table(str(path), COLUMNS)
    numbers = {name: table.numbers(name, missing=True) for name in NUMBERS}
    return [{"group": group, "what": what} | {name: numbers[name][k] for name in NUMBERS}
            for k, (group, what) in enumerate(zip(table.words("group"), table.words("what")))]


def shown(rows):
    """The table as a person reads it, and the arithmetic of what is on paper."""
    names = NUMBERS[:-2]
    lines = [["", *names]]
    for cells in rows:
        if cells["group"] != "on paper":
            lines.append([f"{cells['group']}: {cells['what']}",
                          *("-" if math.isnan(cells[name]) else digits(cells[name])
                            for name in names)])
    widths = [max(map(len, column)) for column in zip(*lines)]
    text = "".join("  ".join([line[0].ljust(widths[0]), *(cell.rjust(width) for cell, width in
                                                          zip(line[1:], widths[1:]))]) + "\n"
                   for line in lines)
    return text + "".join(f"on paper: {words}\n" for words in map(sum_of, rows) if words)


def sum_of(cells):
    """One division or product on paper, in words; empty for what is measured."""
    if cells["group"] != "on paper":
        return ""
    count = f"{cells['contacts']:.0e}".replace("e+0", "e")
    if math.isnan(cells["hours"]):
        return (f"{cells['what']}: {count} * {digits(cells['bytes_per_contact'])} bytes ="
                f" {digits(cells['size_MB'] / 1e3)} GB")
    rate, cores = digits(cells["contacts_per_core_s"]), f"{cells['cores']:.0f}"
    return (f"{cells['what']}: {count} / ({rate} per s and core * {cores} cores) / 3600 ="
            f" {digits(cells['hours'])} h, {digits(cells['hours'] * cells['cores'])} core hours")


if __name__ == "__main__":
    try:
        sys.exit(main())
    except InputError as trouble:
        sys.exit(f"scale: {trouble}")
