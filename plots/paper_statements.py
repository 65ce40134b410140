#!/usr/bin/env python3
"""Test the statements of Lack and Gerlici (2014) on what was computed; one row and verdict each.

Beside the list go its narrow form for print, NAME_short.csv, and tables.csv, which announces that.
"""

import os
import sys
from collections import Counter

from faststrip_plots import command, paper_figures, statements
from faststrip_plots.curves import read_curves
from faststrip_plots.document import announce, write_rows
from faststrip_plots.results import read_reference, read_strips, read_sweeps
from faststrip_plots.tables import read_table

FOLDER = "out/paper"
FILES = {
    "curves": (f"{FOLDER}/curves.csv", "what `faststrip table --curves` wrote"),
    "audit": (f"{FOLDER}/audit.csv", "what `faststrip table --audit` wrote"),
    "errata": (f"{FOLDER}/errata.csv", "what `faststrip-lab errata` wrote"),
    "bench-integral": (f"{FOLDER}/bench_integral.csv", "what `faststrip-lab bench integral` wrote"),
    "bench-normal": (f"{FOLDER}/bench_normal.csv", "what `faststrip-lab bench normal` wrote"),
    "bench-reference": (None, "what `faststrip-lab bench reference` wrote"),
    "reference-a": ("reference/contact/s1002_uic60_A.csv",
                    "sweep A by full CONTACT, with its times"),
    "reference-b": ("reference/contact/s1002_uic60_B.csv", "sweep B by full CONTACT"),
    "table2": ("reference/paper/table2.csv", "the paper's Table 2"),
}
# Of which several files may be given.
SWEEPS = {
    "sweep-a": (f"{FOLDER}/sweep_A.csv",
                "sweeps of Table 2, signs as printed, by more methods each"),
    "sweep-b": (f"{FOLDER}/sweep_B.csv", "sweeps of Table 2, signs of the motion"),
    "fine": (f"{FOLDER}/sweep_fine.csv", "sweeps in fine steps"),
}
SHORT = ("id", "statement", "of", "measured", "criterion", "verdict")
TABLES = {
    "audit": ("n", "max_rel_err", "rms_rel_err", "residual_max", "misprint", "rel_err_below",
              "rel_err_above"),
    "errata": ("equation", "what", "deviation"),
    "fine": ("yw_mm", "gamma_rad", "cksi", "cphi_rad_per_mm"),
    "bench-integral": ("method", "loop", "ns", "rel_err"),
    "bench-normal": ("start", "strips", "us"),
}


def main(arguments=None):
    several = {name: dict(nargs="+", default=[default], metavar="CSV", help=words)
               for name, (default, words) in SWEEPS.items()}
    options = command.options(
        __doc__, arguments, FILES,
        (f"{FOLDER}/paper_statements.csv", "CSV", "list to write"),
        more={**several, "strips": dict(
            nargs="*", default=[], metavar="CSV",
            help="what `faststrip contact --strips` wrote, for the range of b"),
            **command.friction("coefficient of friction of the sweeps")})
    rows = statements.all_statements(read(options))
    write(options.output, rows)
    short = os.path.splitext(options.output)[0] + "_short.csv"
    write_rows(short, SHORT, [short_cells(row) for row in rows])
    announce(os.path.dirname(options.output), "tables.csv", [
        (os.path.basename(short), "The paper's statements, tested",
         "Statements in our words, judged on the paper's own method where they speak of FASTSTRIP;"
         f" criteria are ours; verdicts follow from the figures. {counted(rows)}.",
         paper_figures.CHAPTER)])
    print(counted(rows))
    print(options.output)


def counted(rows):
    """How many rows have which verdict."""
    counts = Counter(row.verdict for row in rows)
    return f"{len(rows)} rows: " + ", ".join(
        f"{counts[word]} {word}" for word in (statements.HOLDS, statements.LIMITED,
                                              statements.FAILS, statements.UNKNOWN))


def read(options):
    """All files; refuses sweeps whose creepages are not their reference's."""
    paths = vars(options)
    tables = {name: read_table(paths[name.replace("-", "_")], columns)
              for name, columns in TABLES.items() if name not in SWEEPS}
    tables["fine"] = read_table(options.fine[0], TABLES["fine"])
    sweeps = {}
    for letter in "AB":
        files, reference = paths[f"sweep_{letter.lower()}"], paths[f"reference_{letter.lower()}"]
        for file in files:
            paper_figures.check_creepages(file, reference)
        sweeps[letter] = read_sweeps(files), read_reference(reference)
    return statements.Data(
        audit=tables["audit"],
        errata=tables["errata"],
        table2=read_table(options.table2, ("yw_mm", "Fn_N", "tan_gamma", "gamma_rad", "Sx",
                                           "Phi_rad_per_mm")),
        curves=read_curves(options.curves)[0],
        sweeps=sweeps,
        fine=read_sweeps(options.fine),
        fine_table=tables["fine"],
        contact=read_table(options.reference_a, ("yw_mm", "cpu_norm_s", "cpu_total_s",
                                                 "r_wheel_mm")),
        integral=tables["bench-integral"],
        normal=tables["bench-normal"],
        reference=read_table(
            options.bench_reference, ("method", "start", "tolerance", "elements", "us"))
        if options.bench_reference else None,
        strips=[read_strips(path) for path in options.strips],
        mu=options.mu,
    )


def short_cells(row):
    """A statement as a line of a table: the figure in words."""
    if row.value is None:
        measured = ""
    else:
        measured = f"{row.value:.3g} {row.unit}".rstrip() + f", {row.quantity}"
    return row.id, row.statement, row.subject, measured, row.criterion, row.verdict


def write(path, rows):
    """The whole list as CSV, figures with six digits."""
    write_rows(path, statements.COLUMNS, [
        ["" if value is None else f"{value:.6g}" if isinstance(value, float) else value
         for value in (getattr(row, name) for name in statements.COLUMNS)]
        for row in rows
    ])


if __name__ == "__main__":
    sys.exit(command.run(main))
