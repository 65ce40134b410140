#!/usr/bin/env python3
"""Write src/faststrip/contact/choice_table.f90: which error to expect from which method.

    bin/faststrip-lab bench trade -o out/trade.csv
    tools/choice_table.py --take out/trade.csv   condense a measurement into reference/choice.csv
    tools/choice_table.py                        write module and reference/choice_validation.csv
    tools/choice_table.py --check                exit 1 if they are not what would be written

Methods of the stages `both` (forces) and `normal` (largest pressure, penetration) that the list of
methods marks in its column `choice` are the ones to choose from. Their errors are told by bins:

    error = base(saturation, spin) + excess(misfit),

each the largest but for one in twenty of the calibration contacts in the bin; the base from the
contacts with next to no misfit (from all of them for strips, which know no ellipse), the excess
from the rest. A bin with few contacts takes the
worst of its neighbours. Every second contact of each set calibrates; on the others the choice is
tried: how often the target is met, and how much faster it is than always taking the finest.
"""

from __future__ import annotations

import argparse
import csv
import io
import math
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
METHODS = ROOT / "reference" / "trade_methods.csv"
DATA = ROOT / "reference" / "choice.csv"
VALIDATION = ROOT / "reference" / "choice_validation.csv"
MODULE = ROOT / "src" / "faststrip" / "contact" / "choice_table.f90"

MISFIT_EDGES = (0.01, 0.05, 0.2, 0.6)
SATURATION_EDGES = (0.2, 0.6, 1.2, 2.5)
SPIN_EDGES = (0.25,)
QUANTILE = 0.95
FEWEST = 5  # contacts in a bin

TARGETS = {"forces": "both", "pmax": "normal", "penetration": "normal"}
TOLERANCES = (0.1, 0.05, 0.03, 0.02, 0.01, 0.005)
# What the tolerance of a target is a part of.
UNITS = {"forces": "of mu N", "pmax": "of the value", "penetration": "of the value"}
DATA_COLUMNS = ("set", "case", "stage", "method", "us", "forces", "pmax", "penetration", "misfit",
                "saturation", "spin_share")


def rows_of(path):
    with open(path, encoding="utf-8") as stream:
        return list(csv.DictReader(line for line in stream if not line.startswith("#")))


def origin(path):
    """The comments that say which program measured, and on what."""
    with open(path, encoding="utf-8") as stream:
        return [line for line in stream if line.startswith(("# faststrip ", "# compiler "))]


def choices():
    """The methods to choose from, by stage, in the order of the list."""
    found = defaultdict(list)
    for row in rows_of(METHODS):
        if row["choice"] == "yes":
            found[row["stage"]].append(row)
    return found


def condense(path):
    """The rows of a measurement that count, as the text of DATA."""
    names = {(stage, row["method"]) for stage, rows in choices().items() for row in rows}
    stream = io.StringIO()
    stream.write("# Errors and times of the methods to choose from; tools/choice_table.py --take\n")
    with open(path, encoding="utf-8") as source:
        stream.writelines(line for line in source if line.startswith("#"))
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(DATA_COLUMNS)
    for row in rows_of(path):
        if (row["stage"], row["method"]) not in names:
            continue
        cells = {name: row.get(name, "") for name in DATA_COLUMNS}
        for name, value in measured(row).items():
            cells[name] = "" if value is None else f"{value:.3e}"
        for name in ("us", "misfit", "saturation", "spin_share"):
            cells[name] = f"{float(row[name]):.3e}" if row[name] else ""
        writer.writerow([cells[name] for name in DATA_COLUMNS])
    return stream.getvalue()


def measured(row):
    """Errors of one row; none where the method has no result or is not judged by it."""
    def number(name):
        return float(row[name]) if row[name] else None

    fx, fy = number("err_Fx"), number("err_Fy")
    forces = None if fx is None or fy is None else math.hypot(fx, fy)
    return {"forces": forces, "pmax": None if number("err_pmax") is None
            else abs(number("err_pmax")), "penetration": None
            if number("err_penetration") is None else abs(number("err_penetration"))}


def bin_of(value, edges):
    return sum(value >= edge for edge in edges)


def upper(values):
    """The quantile, by the next larger value: never below it."""
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, math.ceil(QUANTILE * len(ordered)) - 1)]


class Contacts:
    """Every contact with its indicators, errors and times by method."""

    def __init__(self, rows):
        self.cases = {}
        for row in rows:
            key = row["set"], row["case"]
            case = self.cases.setdefault(key, {
                "misfit": bin_of(float(row["misfit"]), MISFIT_EDGES),
                "force": bin_of(float(row["saturation"]), SATURATION_EDGES) * (len(SPIN_EDGES) + 1)
                + bin_of(float(row["spin_share"]), SPIN_EDGES),
                "errors": {}, "us": {},
            })
            for target, stage in TARGETS.items():
                if stage == row["stage"]:
                    value = float(row[target]) if row[target] else math.inf
                    case["errors"][target, row["method"]] = value
            case["us"][row["stage"], row["method"]] = float(row["us"]) if row["us"] else math.inf

    def halves(self):
        """Calibration and validation: every second contact of each set."""
        count = defaultdict(int)
        first, second = [], []
        for (name, _), case in self.cases.items():
            count[name] += 1
            (first if count[name] % 2 else second).append(case)
        return first, second


def filled(values, worst_of):
    """Bins without enough contacts take the worst of those that `worst_of` names for them."""
    known = {k: v for k, v in values.items() if v is not None}
    return {k: v if v is not None else max([known[n] for n in worst_of(k) if n in known],
                                           default=max(known.values(), default=math.inf))
            for k, v in values.items()}


def expected(cases, target, method, any_gap):
    """Base by saturation and spin, excess by misfit."""
    n_force = (len(SATURATION_EDGES) + 1) * (len(SPIN_EDGES) + 1)
    n_misfit = len(MISFIT_EDGES) + 1
    base = {k: 0.0 for k in range(n_force)}
    if target == "forces":
        raw = {}
        for k in base:
            errors = [c["errors"][target, method] for c in cases
                      if (any_gap or c["misfit"] == 0) and c["force"] == k
                      and (target, method) in c["errors"]]
            raw[k] = upper(errors) if len(errors) >= FEWEST else None
        step = len(SPIN_EDGES) + 1
        base = filled(raw, lambda k: (k - 1, k + 1, k - step, k + step))
    excess = {}
    for m in range(n_misfit):
        errors = [c["errors"][target, method] - base[c["force"]] for c in cases
                  if c["misfit"] == m and (target, method) in c["errors"]]
        excess[m] = max(0.0, upper(errors)) if len(errors) >= FEWEST else None
    excess = filled(excess, lambda m: (m - 1, m + 1))
    # More misfit is never better.
    for m in range(1, n_misfit):
        excess[m] = max(excess[m], excess[m - 1])
    return [base[k] for k in range(n_force)], [excess[m] for m in range(n_misfit)]


def typical_time(cases, stage, method):
    times = sorted(c["us"].get((stage, method), math.inf) for c in cases)
    return times[len(times) // 2]


def build(contacts):
    """Per target: methods by ascending time, each with time, base and excess."""
    first, _ = contacts.halves()
    tables = {}
    for target, stage in TARGETS.items():
        entries = []
        for row in choices()[stage]:
            own = [c for c in first if (target, row["method"]) in c["errors"]]
            if own:
                entries.append((typical_time(own, stage, row["method"]), row,
                                *expected(own, target, row["method"], row["normal"] == "strip")))
        tables[target] = sorted(entries, key=lambda entry: entry[0])
    return tables


def choose(entries, case, tolerance):
    """The number of the first entry that is expected to do; else of the one expected best."""
    predicted = [base[case["force"]] + excess[case["misfit"]] for _, _, base, excess in entries]
    for k, value in enumerate(predicted):
        if value <= tolerance:
            return k, value
    best = min(range(len(entries)), key=lambda k: predicted[k])
    return best, predicted[best]


def validation(contacts, tables):
    """How the choice does on the contacts it was not calibrated on."""
    _, second = contacts.halves()
    rows = []
    for target, stage in TARGETS.items():
        entries = tables[target]
        finest = entries[-1][1]["method"]
        for tolerance in TOLERANCES:
            promised = met = met_all = 0
            spent = most = 0.0
            total = 0
            for case in second:
                if (target, finest) not in case["errors"]:
                    continue
                k, predicted = choose(entries, case, tolerance)
                method = entries[k][1]["method"]
                good = case["errors"][target, method] <= tolerance
                total += 1
                met_all += good
                spent += case["us"][stage, method]
                most += case["us"][stage, finest]
                if predicted <= tolerance:
                    promised += 1
                    met += good
            rows.append((target, f"{tolerance:g}", UNITS[target], total, promised,
                         f"{met / promised:.3f}" if promised else "", f"{met_all / total:.3f}",
                         f"{most / spent:.2f}"))
    stream = io.StringIO()
    stream.write("# How choosing methods does on contacts it was not calibrated on; written by\n"
                 "# tools/choice_table.py from reference/choice.csv. speedup: time of always taking"
                 " the slowest choice\n")
    stream.writelines(origin(DATA))
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(("target", "tolerance", "unit", "contacts", "promised", "met_of_promised",
                     "met_of_all", "speedup"))
    writer.writerows(rows)
    return stream.getvalue()


def number(value):
    return f"{min(value, 9.999e9):.3e}".replace("e", "e") + "_wp"


def array(name, shape, values, comment):
    """A parameter array, four numbers a line."""
    lines = [", ".join(values[k:k + 6]) for k in range(0, len(values), 6)]
    body = ", &\n        ".join(lines)
    return (f"    !> {comment}\n    real(wp), parameter :: {name}({shape}) = reshape([ &\n"
            f"        {body}], [{shape}])\n")


def module(tables):
    out = ["""!> What error to expect from which method. Written by tools/choice_table.py from
!> reference/choice.csv; change those, not this.
module faststrip_contact_choice_table
    use faststrip_base_kinds, only: wp
    use faststrip_contact_methods, only: contact_methods_t, &
"""]
    names = sorted({f"normal_{r['normal']}" for t in tables.values() for _, r, _, _ in t}
                   | {"tangential_none"}
                   | {f"tangential_{r['tangential'].replace('-', '_')}"
                      for _, r, _, _ in tables["forces"]})
    out.append("        " + ", &\n        ".join(names) + "\n")
    out.append("""    implicit none
    private

    public :: misfit_edges, saturation_edges, spin_edges
    public :: forces_methods, forces_base, forces_excess, pmax_methods, pmax_excess
    public :: penetration_methods, penetration_excess

    !> Upper edges of the bins but the last: misfit, saturation, share of spin.
""")
    for name, edges in (("misfit", MISFIT_EDGES), ("saturation", SATURATION_EDGES),
                        ("spin", SPIN_EDGES)):
        text = ", ".join(f"{edge!r}_wp" for edge in edges)
        out.append(f"    real(wp), parameter :: {name}_edges({len(edges)}) = [{text}]\n")
    for target, entries in tables.items():
        n = len(entries)
        lines = []
        for _, row, _, _ in entries:
            tangential = "tangential_none"
            if target == "forces":
                tangential = "tangential_" + row["tangential"].replace("-", "_")
            parts = [f"normal_{row['normal']}", tangential]
            for name, default in (("strips_per_patch", "15"), ("points_per_strip", "15"),
                                  ("fastsim_nx", "50"), ("fastsim_ny", "50")):
                key = {"strips_per_patch": "strips_per_patch",
                       "points_per_strip": "points_per_strip"}.get(name, name)
                parts.append(f"{key}={row[name] or default}")
            lines.append(f"contact_methods_t({', '.join(parts[:2])}, &\n            "
                         f"{', '.join(parts[2:])})")
        body = ", &\n        ".join(lines)
        out.append(f"\n    !> To choose from for {target}, by ascending time.\n"
                   f"    type(contact_methods_t), parameter :: {target}_methods({n}) = [ &\n"
                   f"        {body}]\n")
        if target == "forces":
            n_force = len(entries[0][2])
            out.append(array(f"{target}_base", f"{n_force}, {n}",
                             [number(v) for _, _, base, _ in entries for v in base],
                             "Error over mu N by bin of saturation and spin, and method."))
        out.append(array(f"{target}_excess", f"{len(MISFIT_EDGES) + 1}, {n}",
                         [number(v) for _, _, _, excess in entries for v in excess],
                         "Error by bin of misfit, and method."))
    out.append("end module faststrip_contact_choice_table\n")
    return "".join(out)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--take", metavar="CSV", help="what `faststrip-lab bench trade` wrote")
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    if options.take:
        DATA.write_text(condense(options.take), encoding="utf-8")
    contacts = Contacts(rows_of(DATA))
    tables = build(contacts)
    wanted = {MODULE: module(tables), VALIDATION: validation(contacts, tables)}
    if options.check:
        wrong = [path for path, text in wanted.items()
                 if not path.exists() or path.read_text(encoding="utf-8") != text]
        for path in wrong:
            print(f"not up to date: {path.relative_to(ROOT)}", file=sys.stderr)
        sys.exit(1 if wrong else 0)
    for path, text in wanted.items():
        path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
