#!/usr/bin/env python3
"""Test the statements of Lack and Gerlici (2014) on what was computed; one row and verdict each."""

import csv
import os
import sys
from collections import Counter

from faststrip_plots import command, paper_figures, statements
from faststrip_plots.curves import read_curves
from faststrip_plots.results import read_reference, read_strips, read_sweep
from faststrip_plots.tables import InputError, read_table

FOLDER = "out/paper"
INPUTS = {
    "curves": ("curves.csv", "what `faststrip table --curves` wrote"),
    "audit": ("audit.csv", "what `faststrip table --audit` wrote"),
    "errata": ("errata.csv", "what `faststrip table --errata` wrote"),
    "sweep-a": ("sweep_A.csv", "the sweep of Table 2, signs as printed"),
    "sweep-b": ("sweep_B.csv", "the sweep of Table 2, signs of the motion"),
    "fine": ("sweep_fine.csv", "a sweep in fine steps"),
    "bench-integral": ("bench_integral.csv", "what `faststrip bench integral` wrote"),
    "bench-normal": ("bench_normal.csv", "what `faststrip bench normal` wrote"),
}
TABLES = {
    "audit": ("n", "max_rel_err", "rms_rel_err", "residual_max", "misprint", "rel_err_below",
              "rel_err_above"),
    "errata": ("equation", "what", "deviation"),
    "fine": ("yw_mm", "gamma_rad", "cksi", "cphi_rad_per_mm"),
    "bench-integral": ("method", "loop", "ns", "rel_err"),
    "bench-normal": ("start", "strips", "us"),
}


def main(arguments=None):
    parser = command.parser(__doc__)
    for name, (file, words) in INPUTS.items():
        parser.add_argument(f"--{name}", default=f"{FOLDER}/{file}", metavar="CSV", help=words)
    parser.add_argument("--bench-reference", metavar="CSV",
                        help="times of NORM: columns start (cold, strips) and us")
    parser.add_argument("--strips", nargs="*", default=[], metavar="CSV",
                        help="what `faststrip contact --strips` wrote, for the range of b")
    parser.add_argument("--reference-a", default="reference/contact/s1002_uic60_A.csv",
                        metavar="CSV", help="sweep A by full CONTACT, with its times")
    parser.add_argument("--reference-b", default="reference/contact/s1002_uic60_B.csv",
                        metavar="CSV", help="sweep B by full CONTACT")
    parser.add_argument("--table2", default="reference/paper/table2.csv", metavar="CSV",
                        help="the paper's Table 2")
    parser.add_argument("--mu", type=command.friction, default=0.3, metavar="MU",
                        help="coefficient of friction of the sweeps")
    parser.add_argument("-o", "--output", default=f"{FOLDER}/paper_statements.csv", metavar="CSV",
                        help="list to write")
    options = parser.parse_args(arguments)
    rows = statements.all_statements(read(options))
    write(options.output, rows)
    counts = Counter(row.verdict for row in rows)
    print(f"{len(rows)} rows: " + ", ".join(
        f"{counts[word]} {word}" for word in (statements.HOLDS, statements.LIMITED,
                                              statements.FAILS, statements.UNKNOWN)))
    print(options.output)


def read(options):
    """All files; refuses sweeps whose creepages are not their reference's."""
    paths = vars(options)
    tables = {name: read_table(paths[name.replace("-", "_")], columns)
              for name, columns in TABLES.items()}
    sweeps = {}
    for letter in "AB":
        sweep, reference = paths[f"sweep_{letter.lower()}"], paths[f"reference_{letter.lower()}"]
        paper_figures.check_creepages(sweep, reference)
        sweeps[letter] = read_sweep(sweep), read_reference(reference)
    return statements.Data(
        audit=tables["audit"],
        errata=tables["errata"],
        table2=read_table(options.table2, ("yw_mm", "Fn_N", "tan_gamma", "gamma_rad", "Sx",
                                           "Phi_rad_per_mm")),
        curves=read_curves(options.curves)[0],
        sweeps=sweeps,
        fine=read_sweep(options.fine),
        fine_table=tables["fine"],
        contact=read_table(options.reference_a, ("yw_mm", "cpu_norm_s", "cpu_total_s",
                                                 "r_wheel_mm")),
        integral=tables["bench-integral"],
        normal=tables["bench-normal"],
        reference=read_table(options.bench_reference, ("start", "us"))
        if options.bench_reference else None,
        strips=[read_strips(path) for path in options.strips],
        mu=options.mu,
    )


def write(path, rows):
    """The list as CSV, figures with six digits."""
    try:
        os.makedirs(os.path.dirname(os.path.abspath(path)), exist_ok=True)
        with open(path, "w", encoding="utf-8", newline="") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow(statements.COLUMNS)
            for row in rows:
                cells = {name: getattr(row, name) for name in statements.COLUMNS}
                cells["value"] = "" if row.value is None else f"{row.value:.6g}"
                writer.writerow([cells[name] for name in statements.COLUMNS])
    except OSError as error:
        raise InputError(f"cannot write: {path} ({os.strerror(error.errno)})") from None


if __name__ == "__main__":
    sys.exit(command.run(main))
