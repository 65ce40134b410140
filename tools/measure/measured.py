"""The figures of a full report, condensed to the few hundred that the documents show.

`condense` reads a report's folder and gives rows (table, row, column, value), the lines of
reference/measured.csv; `Measured` reads that file. Nothing is rounded here but to six digits.
"""

from __future__ import annotations

import csv
import io
import os
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "plots"))

from faststrip_plots.results import (  # noqa: E402
    QUANTITIES,
    compare,
    percent_errors,
    read_reference,
    read_sweep,
)
from faststrip_plots.tables import InputError, read_table  # noqa: E402

COLUMNS = ("table", "row", "column", "value")
CONTACT = "reference/contact/s1002_uic60_B.csv"
MU = 0.3  # of that reference
TINY = 1e-300  # of an error that is zero
TIMES = ("median", "p95", "worst")
# of `bench extremes`: the row, and the words that choose its cases
EXTREMES = (
    ("influence, centre line", dict(chapter="influence", method="closed", case="centre")),
    ("influence, anywhere", dict(chapter="influence", method="closed")),
    ("ellipses, penetration", dict(chapter="ellipses", quantity="penetration_err")),
    ("ellipses, pmax", dict(chapter="ellipses", quantity="pmax_err")),
    ("ellipses, area", dict(chapter="ellipses", quantity="area_err")),
)


def condense(folder):
    """Stamp lines and rows of a report's folder; refuses one that is not full."""
    data = Path(folder) / "data"
    sources = (
        (verdict_rows, Path(folder) / "verdicts.csv"),
        (contact_rows, data / "sweep.csv"),
        (force_rows, data / "forces.csv"),
        (rolling_rows, data / "rolling.csv"),
        (convergence_rows, data / "convergence.csv"),
        (trade_rows, data / "trade.csv"),
        (influence_rows, data / "bench_integral.csv"),
        (audit_rows, data / "audit.csv"),
        (normal_time_rows, data / "bench_normal.csv"),
        (tangential_time_rows, data / "bench_tangential.csv"),
        (extreme_rows, data / "extremes.csv"),
        (statement_rows, Path(folder) / "figures" / "paper" / "paper_statements.csv"),
        (estimates_rows, data / "estimates.csv"),
    )
    rows = []
    for reader, path in sources:
        rows += reader(str(path))
    return stamp_lines(data), rows


def stamp_lines(data):
    """Revision, compiler and processor, the same in all files."""
    stamps = {}
    for path in sorted(data.glob("*.csv")):
        for line in path.read_text(encoding="utf-8").splitlines()[:4]:
            if line.startswith(("# faststrip ", "# compiler ")):
                stamps.setdefault(line.split()[1], {})[line] = path
    for known in stamps.values():
        if len(known) > 1:
            raise InputError("stamps must be of one run, got "
                             + ", ".join(map(str, known.values())))
    if set(stamps) != {"faststrip", "compiler"}:
        raise InputError(f"no stamp of revision and compiler: {data}")
    cpu = sorted(set(read_table(str(data / "bench_integral.csv")).words("cpu")))
    return [next(iter(known)) for known in stamps.values()] + [f"# processor {', '.join(cpu)}"]


def measured_csv(lines, rows):
    """The text of reference/measured.csv."""
    stream = io.StringIO()
    stream.write("# Figures of the last full report, which the documents are filled with;"
                 " written by\n# tools/measure/validation.py --take\n")
    stream.write("".join(f"{line}\n" for line in lines))
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(COLUMNS)
    for *key, value in rows:
        writer.writerow((*key, value if isinstance(value, str) else f"{value:.6g}"))
    return stream.getvalue()


class Measured:
    """What reference/measured.csv holds, by table, row and column."""

    def __init__(self, path):
        table = read_table(str(path), COLUMNS)
        self.path = os.path.relpath(path, ROOT)
        self.comments = table.comments
        self.cells = {}
        for k, line in enumerate(table.lines):
            *key, value = (table.words(name)[k] for name in COLUMNS)
            if tuple(key) in self.cells:
                raise InputError(f"each figure must be given once, got {'/'.join(key)} twice"
                                 f" ({self.path}:{line})")
            self.cells[tuple(key)] = value

    def rows(self, table):
        """The names of a table's rows, in the order of the file."""
        return list(dict.fromkeys(row for name, row, _ in self.cells if name == table))

    def word(self, table, row, column):
        """A cell as text."""
        try:
            return self.cells[table, row, column]
        except KeyError:
            raise InputError(f"no such figure: {table}/{row}/{column} ({self.path})") from None

    def number(self, table, row, column):
        """A cell as a number."""
        return float(self.word(table, row, column))


def chosen(table, **words):
    """Which rows of a table have these words."""
    mask = np.ones(len(table), dtype=bool)
    for column, word in words.items():
        mask &= np.array([own == word for own in table.words(column)])
    return mask


def sizes(rows, table, row, name, values):
    """Add mean and largest size of some values."""
    values = np.abs(values[~np.isnan(values)])
    if values.size:
        rows += [(table, row, f"{name}_mean", values.mean()),
                 (table, row, f"{name}_max", values.max())]


def times(rows, table, row, name, values):
    """Add median, 95th percentile and largest of some times."""
    for word, value in zip(TIMES, np.percentile(values, (50, 95, 100), method="nearest")):
        rows.append((table, row, f"{name}_{word}", value))


def verdict_rows(path):
    table = read_table(path, ("id", "value", "rows"))
    return [("verdicts", name, column, table.words(column)[k])
            for k, name in enumerate(table.words("id")) for column in ("value", "rows")]


def contact_rows(path):
    """Errors on the paper's contacts against CONTACT."""
    sweep = read_sweep(path)
    reference = read_reference(str(ROOT / CONTACT))
    rows = []
    for method in sweep.methods:
        pairs = compare(sweep, method, reference)
        name = f"{method.normal} + {method.tangential}"
        rows.append(("contacts", name, "contacts", str(len(pairs.rows))))
        for quantity in QUANTITIES:
            sizes(rows, "contacts", name, quantity,
                  percent_errors(pairs, reference, quantity, MU))
    return rows


def force_rows(path):
    table = read_table(path, ("set", "method", "Fx_err", "Fy_err", "Mz_err", "force_err"))
    rows = []
    for own in ("scenes", "hertz"):
        for method in dict.fromkeys(table.words("method")):
            mask = chosen(table, set=own, method=method)
            rows.append(("forces", f"{own} {method}", "contacts", str(int(mask.sum()))))
            for name in ("Fx", "Fy", "Mz", "force"):
                values = table.numbers(f"{name}_err", missing=True)[mask]
                sizes(rows, "forces", f"{own} {method}", name, values)
    return rows


def rolling_rows(path):
    table = read_table(path, ("group", "scheme", "dx_mm", "fx_err_pct"))
    step = table.numbers("dx_mm")
    rows = []
    for dx in sorted(set(step)):
        for scheme in ("first", "second"):
            mask = chosen(table, group="paper_B", scheme=scheme) & (step == dx)
            for name in ("fx", "fy", "mz"):
                sizes(rows, "rolling", f"{scheme} {dx:g} mm", name,
                      table.numbers(f"{name}_err_pct", missing=True)[mask])
    return rows


def convergence_rows(path):
    table = read_table(path, ("case", "strips", "status", "penetration_err"))
    rows = []
    for kind in ("hertz", "shift"):
        own = np.array([case.startswith(kind) for case in table.words("case")])
        for strips in ("5", "9", "15", "31", "61"):
            for name in ("penetration", "pmax", "area"):
                mask = own & chosen(table, strips=strips)
                sizes(rows, "convergence", f"{kind} {strips}", name,
                      table.numbers(f"{name}_err", missing=True)[mask])
    return rows


def trade_rows(path):
    """Both stages together: the worst of the three forces, and the time."""
    table = read_table(path, ("stage", "method", "us", "err_Fx", "err_Fy", "err_Mz"))
    errors = np.abs([table.numbers(f"err_{name}", missing=True) for name in ("Fx", "Fy", "Mz")])
    us = table.numbers("us", missing=True)
    rows = []
    for method in dict.fromkeys(table.words("method")):
        mask = chosen(table, stage="both", method=method) & ~np.isnan(errors).any(axis=0)
        if not mask.any():
            continue
        rows.append(("trade", method, "contacts", str(int(mask.sum()))))
        sizes(rows, "trade", method, "error", 100.0 * errors.max(axis=0)[mask])
        times(rows, "trade", method, "ms", us[mask & ~np.isnan(us)] / 1000.0)
    return rows


def influence_rows(path):
    table = read_table(path, ("method", "loop", "ns", "rel_err"))
    ns, error = table.numbers("ns"), table.numbers("rel_err")
    rows = []
    for method in dict.fromkeys(table.words("method")):
        for loop in ("scalar", "row"):
            mask = chosen(table, method=method, loop=loop)
            if mask.any():
                rows.append(("influence", method, f"ns_{loop}", np.exp(np.log(ns[mask]).mean())))
        rows.append(("influence", method, "rel_err", error[chosen(table, method=method)].max()))
    return rows


def audit_rows(path):
    table = read_table(path, ("max_rel_err", "rms_rel_err", "misprint"))
    largest = np.abs(table.numbers("max_rel_err"))
    return [("audit", "published", "largest", largest.max()),
            ("audit", "published", "smallest", largest.min()),
            ("audit", "published", "rows", str(len(table))),
            ("audit", "published", "misprints",
             str(sum(word != "no" for word in table.words("misprint"))))]


def normal_time_rows(path):
    table = read_table(path, ("start", "strips", "us"))
    rows = []
    for start in dict.fromkeys(table.words("start")):
        for strips in ("5", "15", "41"):
            mask = chosen(table, start=start, strips=strips)
            if mask.any():
                times(rows, "times", f"strips {strips} {start}", "us", table.numbers("us")[mask])
    return rows


def tangential_time_rows(path):
    table = read_table(path, ("method", "strips", "points", "us"))
    rows = []
    for method in dict.fromkeys(table.words("method")):
        mask = chosen(table, method=method, strips="15", points="15")
        if mask.any():
            times(rows, "times", f"{method} 15x15", "us", table.numbers("us")[mask])
    return rows


def extreme_rows(path):
    table = read_table(path, ("chapter", "case", "method", "quantity", "value"))
    values = table.numbers("value", missing=True)
    rows = []
    for name, words in EXTREMES:
        known = np.abs(values[chosen(table, **words) & ~np.isnan(values)])
        rows += [("extremes", name, "cases", str(known.size)),
                 ("extremes", name, "largest", known.max())]
    return rows


def statement_rows(path):
    words = read_table(path, ("verdict",)).words("verdict")
    return [("statements", verdict, "count", str(words.count(verdict)))
            for verdict in dict.fromkeys(words)]


def estimates_rows(path):
    """How often the estimated errors bound the true ones, and how much larger they are."""
    table = read_table(path, ("family", "estimator", "quantity", "true_err", "est_err", "covered"))
    true, estimated, covered = (table.numbers(name, missing=True)
                                for name in ("true_err", "est_err", "covered"))
    kinds = {"ellipses": "ellipses", "gaps_contact": "20 contacts, CONTACT",
             "gaps": "20 contacts, kalker_normal"}
    kind = np.array([kinds.get(word, "random families") for word in table.words("family")])
    rows = []
    for estimator in dict.fromkeys(table.words("estimator")):
        for own in dict.fromkeys(kind):
            for quantity in dict.fromkeys(table.words("quantity")):
                # a reference that is itself in doubt leaves `covered` empty
                mask = (chosen(table, estimator=estimator, quantity=quantity) & (kind == own)
                        & ~np.isnan(covered))
                if not mask.any():
                    continue
                name = f"{estimator}, {own}"
                rows += [
                    ("estimates", name, f"{quantity}_cases", str(int(mask.sum()))),
                    ("estimates", name, f"{quantity}_bounded",
                     covered[mask].mean()),
                    ("estimates", name, f"{quantity}_ratio",
                     np.median(estimated[mask] / np.maximum(np.abs(true[mask]), TINY))),
                ]
    return rows
