#!/usr/bin/env python3
"""Make a lookup table of creep forces and say what it is worth: errors, size, time, look-ups a
second from Fortran, C and Python, and what CONTACT has on Hertz contacts beside it."""

from __future__ import annotations

import argparse
import csv
import os
import pathlib
import resource
import subprocess
import sys
import time

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
CONTACT = ROOT / "reference" / "contact" / "hertz_creep.csv"
STATE = ("a_mm", "b_mm", "N_N", "mu", "G_MPa", "cksi", "ceta", "cphi_rad_per_mm")
OF_CONTACT = ("a_mm", "b_mm", "N", "mu", "G", "cksi", "ceta", "cphi")
FORCES = ("Fx", "Fy", "Mz")
LOOKED_UP = ("Fx_N", "Fy_N", "Mz_Nmm")
STATES, PASSES = 20000, 20


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "out" / "lookup")
    parser.add_argument("--installed", type=pathlib.Path, required=True, metavar="PREFIX",
                        help="where ./run install went: program and library")
    parser.add_argument("--quick", action="store_true", help="a coarser table, fewer contacts")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    prefix = options.installed.absolute()

    def program(*words):
        subprocess.run([prefix / "bin" / "faststrip", "lookup", *words], check=True,
                       stdin=subprocess.DEVNULL)

    table = options.folder / "table.fslt"
    make = ("--error", "0.03", "--tests", "1000") if options.quick else ()
    began, used = time.monotonic(), spent()
    program("make", "-o", table, *make)
    made, cpu = time.monotonic() - began, spent() - used
    contacts = "2000" if options.quick else "10000"
    program("test", table, "--tests", contacts, "--contacts", options.folder / "contacts.csv",
            "-o", options.folder / "errors.csv")
    write(options.folder / "states.csv", STATE, lines())
    program("test", table, "--states", options.folder / "states.csv", "--contacts",
            options.folder / "lines.csv", "-o", options.folder / "line_errors.csv")
    rows = [("size", table.stat().st_size / 1e6, "MB"), ("made in", made, "s"),
            ("made in, processor time", cpu, "s")]
    errors = read(options.folder / "errors.csv")
    for row in errors:
        for name in ("mean", "percentile_99", "worst"):
            rows.append((f"{row['order']} {row['force']} {name}", 100 * float(row[name]), "%"))
    for order in ("linear", "cubic"):
        of_order = [float(row["lookup_us"]) for row in errors if row["order"] == order]
        rows.append((f"Fortran {order}, with derivatives", of_order[0], "us"))
    rows += by_c(options.folder, prefix, table)
    rows += by_python(prefix, table)
    rows += beside_contact(program, options.folder, table)
    write(options.folder / "figures.csv", ("what", "value", "unit"), rows)
    for what, value, unit in rows:
        print(f"  {what:44} {value:10.4g} {unit}")


def spent():
    """Processor time of all programs that have ended, s."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def write(path, names, rows):
    with open(path, "w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows((names, *rows))


def read(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def lines():
    """States along lines of longitudinal creepage, with some lateral creepage and spin."""
    for ratio in (0.2, 1.0, 5.0):
        a, b = 5.0 * ratio**0.5, 5.0 / ratio**0.5
        for step in range(-100, 101):
            yield a, b, 8e4, 0.3, 82000.0, 6e-3 * (step / 100) ** 3, 5e-4, 2e-4


def by_c(folder, prefix, table):
    """Times of the example host."""
    host = folder / "host"
    subprocess.run(["gcc", "-O2", ROOT / "example" / "hosts" / "lookup.c", "-o", host,
                    f"-I{prefix}/include", f"-L{prefix}/lib", f"-Wl,-rpath,{prefix}/lib",
                    "-lfaststrip"], check=True)
    done = subprocess.run([host, table, "time"], check=True, stdout=subprocess.PIPE,
                          encoding="utf-8")
    names = {"linear": "C linear, with derivatives", "cubic": "C cubic, with derivatives",
             "linear_one_by_one": "C linear, a call each"}
    return [(names[name], float(value), "us")
            for name, value in map(str.split, done.stdout.splitlines())]


def by_python(prefix, table):
    """Times of arrays of states in one call."""
    os.environ["FASTSTRIP_PREFIX"] = str(prefix)
    sys.path.insert(0, str(ROOT / "python"))
    import faststrip  # noqa: PLC0415  (which library it takes is known only now)

    lookup = faststrip.Lookup(table)
    numbers = np.random.default_rng(1)
    a = 5.0 * np.exp(numbers.uniform(-1.0, 1.0, STATES))
    creepage = tuple(size * numbers.standard_normal(STATES) for size in (2e-3, 2e-3, 2e-4))
    rows = []
    for order in ("linear", "cubic"):
        best = np.inf
        for _ in range(PASSES):
            began = time.process_time()
            lookup(a, 5.0, 8e4, 0.3, 82000.0, creepage, order=order, jacobian=True)
            best = min(best, time.process_time() - began)
        rows.append((f"Python {order}, with derivatives", 1e6 * best / STATES, "us"))
    return rows


def beside_contact(program, folder, table):
    """Errors against CONTACT's Hertz contacts, extrapolated to fine elements."""
    reference = read(CONTACT)
    write(folder / "contact_states.csv", STATE,
          [[row[name] for name in OF_CONTACT] for row in reference])
    program("eval", table, folder / "contact_states.csv", "-o", folder / "contact_forces.csv")
    found = read(folder / "contact_forces.csv")
    rows = []
    for name, column in zip(FORCES, LOOKED_UP):
        errors = []
        for row, other in zip(reference, found):
            unit = float(row["mu"]) * float(row["N"])
            if name == "Mz":
                unit *= (float(row["a_mm"]) * float(row["b_mm"])) ** 0.5
            errors.append(abs(float(other[column]) - float(row[f"{name}_extrap"])) / unit)
        for what, value in (("mean", np.mean(errors)), ("95 %", np.percentile(errors, 95)),
                            ("worst", max(errors))):
            rows.append((f"beside CONTACT {name} {what}", 100 * value, "%"))
    return rows


if __name__ == "__main__":
    sys.exit(main())
