#!/usr/bin/env python3
"""Time the same contacts through the four interfaces of an installed library.

    bench_embed.py --prefix FOLDER -o FILE.csv

CSV: what,face,ns,over_fortran_ns (face: the interface); the least of many rounds, one core, one
process for the compiled interfaces and this one for Python. Python's own are many contacts in one
call, ns a contact, and the import of the package where numpy is there already, in processor time.
"""

import argparse
import csv
import os
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]


def compiled_rows(prefix):
    with tempfile.TemporaryDirectory() as folder:
        program = pathlib.Path(folder) / "bench"
        library = prefix / "lib"
        subprocess.run(["gfortran", "-O2", f"-I{prefix}/include/faststrip", f"-J{folder}",
                        str(ROOT / "example" / "hosts" / "bench.f90"), f"-L{library}",
                        "-lfaststrip", f"-Wl,-rpath,{library}", "-o", str(program)], check=True)
        done = subprocess.run([str(program)], stdout=subprocess.PIPE, encoding="utf-8", check=True)
    return [(what, face, float(ns)) for what, face, ns in csv.reader(done.stdout.splitlines())]


def least_ns(call, calls, rounds=21):
    least = float("inf")
    for _ in range(rounds):
        start = time.perf_counter_ns()
        for i in range(calls):
            call(i)
        least = min(least, (time.perf_counter_ns() - start) / calls)
    return least


def python_rows(prefix):
    os.environ["FASTSTRIP_PREFIX"] = str(prefix)
    sys.path.insert(0, str(ROOT / "python"))
    import faststrip
    import numpy

    y = numpy.linspace(-15.0, 15.0, 301)
    cases = (("hertz", "hertz", "none", False, 2000),
             ("hertz + faststrip", "hertz", "faststrip", False, 400),
             ("strips + faststrip, warm", "strip", "faststrip", True, 10))
    for what, normal, tangential, warm, calls in cases:
        contact = faststrip.Contact(normal=normal, tangential=tangential)
        contact.set_gap(y, 2e-3 * y**2, 1.0 / 920.0)
        yield what, "python", least_ns(
            lambda i: contact.solve(load=1e5 * (1.0 + 0.01 * (i % 2)), warm_start=warm,
                                    creepage=(1e-3, 5e-4, 1e-4)), calls)
    c = faststrip.kalker(6.0 / 5.0)[:3]
    for n, calls in ((1, 2000), (10, 1000)):
        yield f"fastsim {n} x {n}", "python", least_ns(
            lambda i: faststrip.fastsim(6.0, 5.0, c, (1e-3 + 1e-9 * i, 5e-4, 1e-4), 0.3, 1e5,
                                        shear_modulus=82000.0, grid=(n, n)), calls)


IMPORT = """
import time, numpy
start = time.process_time_ns()
import faststrip
print(time.process_time_ns() - start)
"""


def rows_of_python_alone(prefix):
    import faststrip
    import numpy

    y = numpy.linspace(-15.0, 15.0, 301)
    gap = y, 2e-3 * y**2, 1.0 / 920.0
    for what, normal, tangential, n in (("hertz + polach", "hertz", "polach", 20000),
                                        ("strips + faststrip", "strip", "faststrip", 200)):
        contact = faststrip.Contact(normal=normal, tangential=tangential)
        contact.set_gap(*gap)
        load = numpy.linspace(5e4, 1.5e5, n)
        yield f"{what}, one by one", "python", least_ns(
            lambda i: contact.solve(load=load[i], creepage=(1e-3, 5e-4, 1e-4)), n // 10, 5)
        yield f"{what}, many, one thread", "python", least_ns(
            lambda i: faststrip.solve_many(gap, load=load, creepage=(1e-3, 5e-4, 1e-4),
                                           normal=normal, tangential=tangential, threads=1),
            1, 5) / n
    yield "import", "python", min(
        float(subprocess.run([sys.executable, "-c", IMPORT], stdout=subprocess.PIPE,
                             encoding="utf-8", check=True,
                             env={**os.environ, "PYTHONPATH": str(ROOT / "python"),
                                  "FASTSTRIP_PREFIX": str(prefix)}).stdout) for _ in range(7))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--prefix", required=True, type=pathlib.Path)
    parser.add_argument("-o", dest="output", required=True, type=pathlib.Path)
    options = parser.parse_args()
    prefix = options.prefix.absolute()
    rows = [*compiled_rows(prefix), *python_rows(prefix)]
    fortran = {what: ns for what, face, ns in rows if face == "fortran"}
    with open(options.output, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["what", "face", "ns", "over_fortran_ns"])
        for what in fortran:
            for other, face, ns in rows:
                if other != what:
                    continue
                writer.writerow([what, face, f"{ns:.1f}", f"{ns - fortran[what]:.1f}"])
                print(f"{what:26} {face:8} {ns:10.0f} ns {ns - fortran[what]:+8.0f}")
        for what, face, ns in rows_of_python_alone(prefix):
            writer.writerow([what, face, f"{ns:.1f}", ""])
            print(f"{what:38} {ns:12.0f} ns")


if __name__ == "__main__":
    main()
