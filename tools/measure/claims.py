#!/usr/bin/env python3
"""Condense what `faststrip-lab claims` wrote into the tables of reference/claims/.

    claims.py --take CSV    write them anew
    claims.py RESULTS.csv   print claims kept and estimates that bound, write nothing

claims.csv: of each target and tolerance of auto, claims given and kept, and times over those
of the finest strips (on the contacts where they are good enough) and of Kalker's methods;
kinds.csv: the same claims by kind of contact; estimates.csv: how many errors the estimates of
each method bound, and how many times larger they are in the median; errors.csv: errors and times.
plots/faststrip_plots/claims.py says how each is reckoned.
"""

from __future__ import annotations

import argparse
import csv
import io
import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "plots"))

from faststrip_plots.claims import (  # noqa: E402
    ALL,
    ESTIMATED,
    Judged,
    claim_rows,
    error_rows,
    estimate_rows,
    kind_rows,
)
from faststrip_plots.tables import InputError  # noqa: E402

FOLDER = ROOT / "reference" / "claims"
TABLES = {"claims": claim_rows, "kinds": kind_rows, "estimates": estimate_rows,
          "errors": error_rows}


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", nargs="?", metavar="RESULTS.csv")
    parser.add_argument("--take", metavar="CSV")
    parser.add_argument("--references", default=str(FOLDER / "references.csv"), metavar="CSV")
    parser.add_argument("--methods", default=str(FOLDER / "methods.csv"), metavar="CSV")
    parser.add_argument("--folder", type=Path, default=FOLDER, help="where the tables go")
    options = parser.parse_args(arguments)
    if (options.results is None) == (options.take is None):
        parser.error("give RESULTS.csv or --take")
    try:
        judged = Judged(options.take or options.results, options.references, options.methods)
        if options.take:
            for name, rows_of in TABLES.items():
                rows = rows_of(judged)
                if rows:
                    write(options.folder / f"{name}.csv", table(rows, judged.table.comments))
        else:
            tell(judged)
    except InputError as error:
        print(f"claims: {error}", file=sys.stderr)
        return 1
    return 0


def table(rows, comments):
    """CSV with the stamp of the results."""
    stream = io.StringIO()
    stream.writelines(f"# {comment}\n" for comment in comments
                      if comment.startswith(("faststrip ", "compiler ")))
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(rows[0])
    writer.writerows([cell(value) for value in row.values()] for row in rows)
    return stream.getvalue()


def cell(value):
    """Numbers with three digits, empty where there is none."""
    if value is None:
        return ""
    return f"{value:.3g}" if isinstance(value, float) else value


def write(path, text):
    """Write a file in one go: whole or as it was."""
    rest = path.with_name(path.name + ".part")
    rest.write_text(text, encoding="utf-8")
    os.replace(rest, path)


def tell(judged):
    """Claims and estimates for people."""
    print(f"{len(judged)} contacts\n\ntarget       tolerance  promised  kept         worst"
          "  times finest strips, Kalker's  ms: median, 95 %")
    for row in claim_rows(judged):
        kept = "" if row["kept_share"] is None else f"({100 * row['kept_share']:.1f} %)"
        times = " ".join(f"{cell(row[f'times_{which}']):>8}" for which in ("strips", "kalker"))
        print(f"{row['target']:12} {100 * row['tolerance']:6g} % {row['promised']:9}"
              f" {row['kept']:5} {kept:9} {row['worst']:5.2f} {times}"
              f"   {cell(thousandth(row['us_median'])):>8} {cell(thousandth(row['us_p95'])):>8}")
    print("\nerrors bounded by their estimates, and estimate over error in the median")
    for row in estimate_rows(judged):
        if row["kind"] == ALL:
            cells = [f"{name} {100 * row[f'{name}_bounded']:.0f} % {cell(row[f'{name}_ratio'])}"
                     for name in ESTIMATED if row[f"{name}_contacts"]]
            print(f"{row['method']:30} {', '.join(cells)}")
    print("\nerrors in %: mean / 95 % quantile / largest, and the median time, us")
    for row in error_rows(judged):
        if row["kind"] == ALL:
            cells = [f"{name} " + "/".join(cell(100 * row[f"{name}_{word}"])
                                           for word in ("mean", "p95", "max"))
                     for name in ("Fx", "Fy", "Mz") if row[f"{name}_mean"] is not None]
            print(f"{row['method']:30} {cell(row['us_median']):>9} us  {', '.join(cells)}")


def thousandth(value):
    return None if value is None else value / 1000.0


if __name__ == "__main__":
    sys.exit(main())
