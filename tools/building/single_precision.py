#!/usr/bin/env python3
"""Build the kernels in single precision from the sources as they are, and compare them.

src/faststrip/base/kinds.f90 is exchanged for tools/building/single_precision/kinds.f90, and the
names of LAPACK's double precision routines in the objects for those of the single precision ones.
The same program is built in double precision too; the relative differences of what both print are
written as CSV.
"""

import argparse
import csv
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
OWN = ROOT / "tools/building/single_precision"
PROGRAM = OWN / "kernels.f90"
KINDS = ROOT / "src" / "faststrip" / "base" / "kinds.f90"
LAPACK = ("getrf", "getrs", "gecon", "geqrf", "ormqr", "trtrs", "gesvd", "posv", "potrf",
          "potrs", "sytrf", "sytrs")
# Constants beyond the range of single precision become 0 or infinity.
FLAGS = ("-fopenmp-simd -frecursive -fimplicit-none -std=f2018 -fno-range-check").split()
KEY = ("case", "method", "x_name", "x", "y_name", "y", "quantity")
COLUMNS = ("chapter", *KEY, "value", "reference", "status")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("-o", "--output", default="out/extremes/single.csv", metavar="CSV")
    parser.add_argument("--folder", default="build/single", metavar="FOLDER",
                        help="where to build")
    parser.add_argument("--flags", default="-O2", help="of the compiler, for speed")
    options = parser.parse_args()
    folder = pathlib.Path(options.folder)
    single = values(build(folder / "real32", OWN / "kinds.f90", options.flags, True))
    double = values(build(folder / "real64", KINDS, options.flags, False))
    write(pathlib.Path(options.output), single, double)


def build(folder, kinds, flags, renamed):
    """Compile the program and every module it uses; the path of the executable."""
    folder.mkdir(parents=True, exist_ok=True)
    objects = []
    for source in in_order(kinds):
        target = folder / (str(source.relative_to(ROOT)).replace("/", "_") + ".o")
        in_c = source.with_suffix(".c")
        kind = ["-cpp", "-Dc_double=c_float"] if renamed and in_c.exists() else []
        run("gfortran", *FLAGS, *kind, *flags.split(), "-J", folder, "-c", source, "-o", target)
        if renamed:
            run("objcopy", *(f"--redefine-sym=d{name}_=s{name}_" for name in LAPACK), target)
        objects.append(target)
        if in_c.exists():
            # Its loops are in double precision.
            flag = ["-DFASTSTRIP_NO_LANES"] if renamed else []
            objects.append(target.with_suffix(".c.o"))
            run("gcc", *flag, "-c", in_c, "-o", objects[-1])
    run("gfortran", *objects, "-o", folder / "kernels", "-lopenblas")
    return folder / "kernels"


def in_order(kinds):
    """The sources the program needs, each after those it uses."""
    found = {"faststrip_base_kinds": kinds}
    for path in sorted((ROOT / "src").rglob("*.f90")):
        match = re.search(r"^module (\w+)", path.read_text(encoding="utf-8"), re.M)
        found.setdefault(match[1], path)
    order = []

    def visit(path):
        for name in re.findall(r"^ *use (faststrip_\w+)", path.read_text(encoding="utf-8"), re.M):
            if found[name] not in order:
                visit(found[name])
        order.append(path)

    visit(PROGRAM)
    return order


def run(*words):
    subprocess.run([str(word) for word in words], check=True)


def values(program):
    """Rows of a program by their key."""
    text = subprocess.run([program], check=True, stdout=subprocess.PIPE, encoding="ascii").stdout
    return {tuple(row[name] for name in KEY): row for row in csv.DictReader(text.splitlines())}


def write(path, single, double):
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w", encoding="ascii", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(COLUMNS)
        for key, row in single.items():
            reference = double[key]["value"]
            error = ""
            if row["value"] and reference:
                error = relative(float(row["value"]), float(reference))
            writer.writerow(("single", *key, error, "double", row["status"]))


def relative(value, reference):
    """The relative difference; a reference of zero is met or missed altogether."""
    if reference == 0.0:
        return 0.0 if value == 0.0 else 1.0
    return f"{abs(value / reference - 1.0):.6e}"


if __name__ == "__main__":
    sys.exit(main())
