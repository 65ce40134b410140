#!/usr/bin/env python3
"""Write the accuracy table: errors against full CONTACT and time per contact."""

import sys

import numpy as np

from faststrip_plots import command, references
from faststrip_plots.document import markdown_table, write_text
from faststrip_plots.results import (
    QUANTITIES,
    compare,
    percent_errors,
    read_reference,
    read_sweep,
)
from faststrip_plots.style import method_look
from faststrip_plots.tables import read_table

FAST_MODES = "reference/contact/s1002_uic60_fast_modes_B.csv"
HEADER = (
    "method", "results", "penetration %", "area %", "pmax %", "Fx % of mu N", "Fy % of mu N",
    "Mz % of mu N c", "normal µs", "tangential µs",
)
# error columns of CONTACT's fast modes, in the order of QUANTITIES
PEER_ERRORS = (
    "err_pen_pct", "err_area_pct", "err_pmax_pct", "err_Fx_pct_of_muN", "err_Fy_pct_of_muN",
    "err_Mz_Nmm",
)


def main(arguments=None):
    options = command.options(
        __doc__, arguments, {
            **command.SWEEP, **references.SWEEP,
            "fast-modes": (FAST_MODES, "the same sweep by CONTACT's fast modes")},
        output=("out/accuracy.md", "MD", "file to write; the same goes to stdout"),
        more={"no-fast-modes": dict(action="store_true", help="leave the second table out"),
              **command.friction("coefficient of friction")})
    sweep = read_sweep(options.sweep)
    reference = read_reference(options.reference)
    text = report(sweep, reference, options)
    write_text(options.output, text)
    print(text, end="")


def report(sweep, reference, options):
    """The whole text."""
    parts = [
        "# Accuracy against full CONTACT",
        f"{sweep.stamp or 'faststrip, revision not given'}; sweep {options.sweep},"
        f" reference {options.reference}, µ = {options.mu:g}.",
        "Each cell: mean / largest absolute error over the shifts with a result. Penetration and"
        " pmax in percent of CONTACT's on its 0.1 mm grid; area in percent, Fx and Fy in percent of"
        " mu N, Mz in percent of mu N c with c = sqrt(area/π) of CONTACT's patch, against"
        " CONTACT's values extrapolated in the grid size (columns `*_extrap`; on the 0.1 mm grid"
        " itself the area is 0.3 % larger, for elements count whole). Times:"
        " median microseconds of wall time"
        " per contact.",
        markdown_table(HEADER, [method_row(sweep, method, reference, options.mu)
                                for method in sweep.methods]),
    ]
    remarks = [
        f"- {method_look(*method.key).label}: {number} of {len(method.yw)} shifts {what} ({status})"
        for method in sweep.methods
        for what, counts in (
            ("without a result", method.failures),
            ("with a limited result", method.limitations),
        )
        for status, number in counts.items()
    ]
    if remarks:
        parts.append("\n".join(remarks))
    if not options.no_fast_modes:
        parts += [
            "## CONTACT's own fast modes on the same gaps",
            "Times: median microseconds of processor time of one evaluation with the penetration"
            " given; KPEC and ANALYN need several to find the penetration of a load.",
            markdown_table(HEADER, fast_mode_rows(options.fast_modes, reference, options.mu)),
        ]
    return "\n\n".join(parts) + "\n"


def method_row(sweep, method, reference, mu):
    """One line of the table for a combination of methods."""
    pairs = compare(sweep, method, reference)
    errors = [percent_errors(pairs, reference, name, mu) for name in QUANTITIES]
    times = [method.values[name][method.ok] for name in ("normal_us", "tangential_us")]
    return line(
        method_look(*method.key).label, len(pairs.rows), len(method.yw), errors, times
    )


def fast_mode_rows(path, reference, mu):
    """Lines of the table for CONTACT's fast modes; moments are made relative here."""
    data = read_table(
        path, ("method", "dx_mm", "yw_mm", "cpu_norm_s", "cpu_tang_s") + PEER_ERRORS
    )
    rows = reference.rows_for(data.numbers("yw_mm"))
    columns = [data.numbers(name, missing=True) for name in PEER_ERRORS]
    columns[-1] = 100.0 * columns[-1] / reference.base("Mz", mu)[rows]
    ok = (rows >= 0) & ~np.isnan(columns).any(axis=0)
    times = [data.numbers(name, missing=True) * 1e6 for name in ("cpu_norm_s", "cpu_tang_s")]
    names = [
        f"{method}, {step:g} mm"
        for method, step in zip(data.words("method"), data.numbers("dx_mm"))
    ]
    lines = []
    for name in sorted(set(names)):
        own = np.array([other == name for other in names])
        lines.append(
            line(name, (own & ok).sum(), own.sum(), [c[own & ok] for c in columns],
                 [t[own & ok] for t in times])
        )
    return lines


def line(name, results, of, errors, times):
    """Cells of one line."""
    cells = [name, f"{results} / {of}"]
    for values in errors:
        size = np.abs(values)
        cells.append(f"{digits(size.mean())} / {digits(size.max())}" if size.size else "–")
    for values in times:
        known = values[~np.isnan(values)]
        cells.append(digits(np.median(known)) if known.size else "–")
    return cells


def digits(value):
    """Two decimals below ten, one below a hundred, none above."""
    return f"{value:.2f}" if value < 9.995 else f"{value:.1f}" if value < 99.95 else f"{value:.0f}"


if __name__ == "__main__":
    sys.exit(command.run(main))
