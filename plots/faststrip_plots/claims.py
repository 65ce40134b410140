"""What `faststrip-lab claims` wrote, judged: claims kept, estimates that bound, errors, times.

A claim is a row of an automatic method with the status ok: its figure is within the tolerance.
Any other status claims nothing. Times are those of what the target asks for: of the forces and
the friction power the whole contact, of the rest the normal problem.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .results import RESULTS
from .tables import InputError, Table, read_table

FIGURES = ("penetration", "pmax", "area", "Fx", "Fy", "Mz", "friction_power", "stick_fraction")
ESTIMATED = FIGURES[:6]
# Figures of each target; the worst of them counts.
TARGETS = {
    "forces": ("Fx", "Fy", "Mz"),
    "pmax": ("pmax",),
    "penetration": ("penetration",),
    "area": ("area",),
    "power": ("friction_power",),
}
WITH_FORCES = ("forces", "power")
AUTO = "auto"
# What a list of methods calls those that auto is compared with.
BASELINES = ("strips", "kalker")
ALL = "all"  # kinds together
UPPER = 0.95
TINY = 1e-12  # an error below this is none


@dataclass(frozen=True)
class Method:
    """One row of the list of methods."""

    name: str
    target: str  # of auto, else empty
    tolerance: float  # of auto, else 0
    baseline: str  # one of BASELINES or empty


@dataclass(frozen=True)
class Solved:
    """What one method made of all contacts, in the order of the reference."""

    method: Method
    status: np.ndarray
    has_result: np.ndarray
    normal_us: np.ndarray
    us: np.ndarray
    error: dict  # by figure; NaN where there is none
    estimate: dict  # by figure of ESTIMATED; NaN where there is none


class Judged:
    """All methods on all contacts, with what is doubtful about the reference."""

    def __init__(self, results: str, reference: str, methods: str):
        self.table = read_table(results, ("kind", "number", "state", "method", "status",
                                          "normal_us", "tangential_us")
                                + tuple(f"err_{name}" for name in FIGURES)
                                + tuple(f"est_{name}" for name in ESTIMATED))
        keys = list(zip(*(self.table.words(name) for name in ("kind", "number", "state"))))
        names = self.table.words("method")
        first = [key for key, name in zip(keys, names) if name == names[0]]
        self.kind = np.array([key[0] for key in first])
        self.doubt = doubts(read_table(reference), first)
        self.solved = []
        for method in read_methods(methods):
            rows = np.array([k for k, name in enumerate(names) if name == method.name], dtype=int)
            if not rows.size:
                continue
            if [keys[k] for k in rows] != first:
                raise InputError(f"other contacts by {method.name} than by {names[0]}: {results}")
            self.solved.append(take(self.table, method, rows))

    def __len__(self):
        return len(self.kind)

    def fixed(self) -> list[Solved]:
        """The methods that are no automatic ones."""
        return [solved for solved in self.solved if not solved.method.target]

    def auto(self, target: str) -> list[Solved]:
        """The automatic ones of a target, by falling tolerance."""
        own = [solved for solved in self.solved if solved.method.target == target]
        return sorted(own, key=lambda solved: -solved.method.tolerance)

    def baseline(self, which: str) -> Solved:
        """What auto is compared with."""
        for solved in self.solved:
            if solved.method.baseline == which:
                return solved
        raise InputError(f"no method is the baseline {which}: {self.table.path}")

    def kinds(self) -> list[str]:
        """The kinds of contacts in their order."""
        return list(dict.fromkeys(self.kind.tolist()))


def read_methods(path: str) -> list[Method]:
    """The list of methods."""
    table = read_table(path, ("method", "normal", "target", "tolerance", "baseline"))
    tolerance = table.numbers("tolerance", missing=True)
    found = []
    for k, name in enumerate(table.words("method")):
        target, baseline = table.words("target")[k], table.words("baseline")[k]
        is_auto = table.words("normal")[k] == AUTO
        if is_auto != (target != "") or is_auto == np.isnan(tolerance[k]) or \
                (is_auto and target not in TARGETS) or baseline not in ("", *BASELINES):
            raise InputError("auto must have a target and a tolerance, no other method one, and a"
                             f" baseline be one of {', '.join(BASELINES)}: {name}"
                             f" ({path}:{table.lines[k]})")
        found.append(Method(name, target, 0.0 if np.isnan(tolerance[k]) else float(tolerance[k]),
                            baseline))
    return found


def doubts(reference: Table, keys) -> dict:
    """How far the reference of each contact may be off, by figure."""
    known = {key: k for k, key in enumerate(zip(*(reference.words(name) for name in
                                                  ("kind", "number", "state"))))}
    missing = [key for key in keys if key not in known]
    if missing:
        raise InputError(f"no such contact: {' '.join(missing[0])} ({reference.path})")
    rows = [known[key] for key in keys]
    return {name: reference.numbers(f"doubt_{name}")[rows] for name in FIGURES}


def take(table: Table, method: Method, rows) -> Solved:
    """The rows of one method."""
    def numbers(name):
        return table.numbers(name, missing=True)[rows]

    status = np.array(table.words("status"))[rows]
    normal = numbers("normal_us")
    return Solved(method, status, np.isin(status, RESULTS), normal,
                  normal + numbers("tangential_us"),
                  {name: np.abs(numbers(f"err_{name}")) for name in FIGURES},
                  {name: numbers(f"est_{name}") for name in ESTIMATED})


def target_error(solved: Solved, target: str) -> np.ndarray:
    """The error that a target is about."""
    return np.max([solved.error[name] for name in TARGETS[target]], axis=0)


def target_estimate(solved: Solved, target: str) -> np.ndarray:
    """The estimate of that error; infinite where there is none: of the friction power."""
    if any(name not in solved.estimate for name in TARGETS[target]):
        return np.full(len(solved.status), np.inf)
    return np.max([np.nan_to_num(solved.estimate[name], nan=np.inf) for name in TARGETS[target]],
                  axis=0)


def target_doubt(judged: Judged, target: str) -> np.ndarray:
    """How far that error may be off."""
    return np.max([judged.doubt[name] for name in TARGETS[target]], axis=0)


def target_time(solved: Solved, target: str) -> np.ndarray:
    """Time of what a target asks for, us."""
    return solved.us if target in WITH_FORCES else solved.normal_us


def promised(solved: Solved) -> np.ndarray:
    """Where something is promised."""
    return solved.status == "ok"


def kept(solved: Solved) -> np.ndarray:
    """Where the figure is within the tolerance, whatever is promised."""
    return target_error(solved, solved.method.target) <= solved.method.tolerance


def claim_rows(judged: Judged) -> list[dict]:
    """One row a target and tolerance, all kinds together."""
    rows = []
    for target in TARGETS:
        for solved in judged.auto(target):
            tolerance = solved.method.tolerance
            error, doubt = target_error(solved, target), target_doubt(judged, target)
            word, good = promised(solved), kept(solved)
            us = target_time(solved, target)
            known = solved.has_result
            row = {
                "target": target, "tolerance": tolerance, "contacts": len(judged),
                "promised": int(word.sum()), "kept": int((word & good).sum()),
                "kept_share": share(good[word]),
                "near": int((word & (np.abs(error - tolerance) <= doubt)).sum()),
                "worst": float(np.max(error[word], initial=0.0)) / tolerance,
                "within": share(good),
                "doubtful": int((doubt > 0.1 * tolerance).sum()),
                "us_median": upper(us[known], 0.5), "us_p95": upper(us[known], UPPER),
                "us_total": float(us[known].sum()),
            }
            for which in BASELINES:
                other = judged.baseline(which)
                both = known & other.has_result
                if which == "strips":
                    both &= target_error(other, target) <= tolerance
                row[f"{which}_contacts"] = int(both.sum())
                row[f"times_{which}"] = ratio(target_time(other, target)[both], us[both])
                sure = known & other.has_result & (target_estimate(other, target) <= tolerance)
                row[f"{which}_sure"] = int(sure.sum())
                row[f"times_{which}_sure"] = ratio(target_time(other, target)[sure], us[sure])
            row["kalker_within"] = share(target_error(judged.baseline("kalker"), target)
                                         <= tolerance)
            rows.append(row)
    return rows


def kind_rows(judged: Judged) -> list[dict]:
    """Claims by kind of contact: promised and kept of each tolerance."""
    rows = []
    for target in TARGETS:
        for solved in judged.auto(target):
            word, good = promised(solved), kept(solved)
            for kind in judged.kinds():
                own = judged.kind == kind
                rows.append({"target": target, "tolerance": solved.method.tolerance, "kind": kind,
                             "contacts": int(own.sum()), "promised": int((own & word).sum()),
                             "kept": int((own & word & good).sum())})
    return rows


def estimate_rows(judged: Judged) -> list[dict]:
    """How many errors the estimates bound, and how many times larger they are in the median."""
    rows = []
    for solved in judged.fixed():
        for kind in (ALL, *judged.kinds()):
            own = np.ones(len(judged), dtype=bool) if kind == ALL else judged.kind == kind
            row = {"method": solved.method.name, "kind": kind}
            for name in ESTIMATED:
                error, estimate = solved.error[name], solved.estimate[name]
                known = own & ~np.isnan(error) & ~np.isnan(estimate)
                doubt = judged.doubt[name][known]
                error, estimate = error[known], estimate[known]
                row[f"{name}_contacts"] = int(known.sum())
                row[f"{name}_bounded"] = share(error <= estimate + TINY)
                # an error that is lost in the reference's own has no ratio
                told = error > doubt
                row[f"{name}_ratio"] = upper(estimate[told] / error[told], 0.5)
            if any(row[f"{name}_contacts"] for name in ESTIMATED):
                rows.append(row)
    return rows


def error_rows(judged: Judged) -> list[dict]:
    """Mean, 95 % quantile and largest error of each figure, by method and kind, and times."""
    rows = []
    for solved in judged.solved:
        kinds = (ALL,) if solved.method.target else (ALL, *judged.kinds())
        for kind in kinds:
            own = solved.has_result & (True if kind == ALL else judged.kind == kind)
            if not own.any():
                continue
            row = {"method": solved.method.name, "kind": kind, "contacts": int(own.sum()),
                   "us_median": upper(solved.us[own], 0.5), "us_p95": upper(solved.us[own], UPPER)}
            groups = {name: solved.error[name] for name in FIGURES}
            groups["forces"] = target_error(solved, "forces")
            for name, error in groups.items():
                own_error = error[own & ~np.isnan(error)]
                row[f"{name}_mean"] = float(own_error.mean()) if own_error.size else None
                row[f"{name}_p95"] = upper(own_error, UPPER)
                row[f"{name}_max"] = float(own_error.max()) if own_error.size else None
            rows.append(row)
    return rows


def share(good) -> float | None:
    """How many of some, 0 to 1; None of none."""
    return float(np.mean(good)) if len(good) else None


def ratio(others, own) -> float | None:
    """How many times longer the others take together."""
    return float(np.sum(others) / np.sum(own)) if len(own) else None


def upper(values, quantile) -> float | None:
    """A quantile: the least value that so many do not exceed; None of none."""
    return float(np.quantile(values, quantile, method="inverted_cdf")) if len(values) else None


def front(points):
    """Pairs of time and error that no other beats in both, by ascending time."""
    best, found = np.inf, []
    for time, error in sorted(points):
        if error < best:
            best = error
            found.append((time, error))
    return found


def largest_gap(points) -> float:
    """The largest factor between the times of two neighbours on a front."""
    times = [time for time, _ in front(points)]
    return max((after / before for before, after in zip(times, times[1:])), default=1.0)
