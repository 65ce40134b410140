"""The manifest of comparisons: one row per figure that is judged, and its verdict.

Columns of the manifest:

- `id`, `chapter`: a name, and `verification` (exact solutions) or `validation` (other codes);
- `case`, `method`: which rows of the value file count, `column=value` parts joined by `;`;
- `quantity`: the column of the value file;
- `value_file`: a CSV file of the report's data folder, or of `reference/`;
- `reference_file`: empty, or a number, or `FILE#COLUMN@KEY`, the row being found by a key column
  that both files have (FILE as seen from where the command runs);
- `metric`: how rows become one number: `mean`, `max`, `min`, `median` or `rms`, an underscore, and
  `value` (as it is), `abs` (size of the value, or of its difference from the reference), `rel`
  (of the reference), or `of:` with factors joined by `*`, each a number, a column of the value
  file or `c`, the square root of area/pi: `mean_of:0.3*N_N*c`;
- `tolerance`: `0.01`, the most that is accepted, or `>0.95`, the least;
- `figure`, `source`: a picture that shows it, and where the reference comes from;
- `unit`, which may be left out: the unit of value and tolerance as they are printed. Of `rel` and
  `of:` it begins with `%` (and is `%` unless given), and what is printed is 100 times the number;
  of `value` and `abs` it is that of the quantity, by default the one that ends the column's name.
"""

from __future__ import annotations

import math
import os
from dataclasses import dataclass

import numpy as np

from .tables import InputError, read_table

COLUMNS = (
    "id", "chapter", "case", "method", "quantity", "value_file", "reference_file", "metric",
    "tolerance", "figure", "source",
)
CHAPTERS = ("verification", "validation")
KEY_TOLERANCE = 1e-6
# by the end of a column's name
UNITS = {"mm": "mm", "mm2": "mm2", "MPa": "MPa", "N": "N", "Nmm": "N mm", "rad": "rad",
         "rad_per_mm": "rad/mm", "pct": "%", "us": "us", "ns": "ns", "s": "s"}

_WAYS = {
    "mean": np.mean,
    "max": np.max,
    "min": np.min,
    "median": np.median,
    "rms": lambda values: math.sqrt(np.mean(values**2)),
}


@dataclass(frozen=True)
class Verdict:
    """A row of the manifest and what became of it."""

    row: dict
    value: float  # of the metric; NaN if it could not be had
    rows: int  # how many rows it was made from
    word: str  # pass, FAIL or missing
    remark: str

    @property
    def good(self) -> bool:
        return self.word == "pass"


def read_manifest(path: str) -> list[dict]:
    """The rows of a manifest; ids and chapters are checked."""
    table = read_table(path, COLUMNS)
    rows = [
        {name: table.words(name)[k] for name in COLUMNS} | {"at": f"{path}:{line}"}
        for k, line in enumerate(table.lines)
    ]
    units = table.words("unit") if "unit" in table.columns else [""] * len(rows)
    for row, unit in zip(rows, units):
        row["unit"] = unit
    seen = set()
    for row in rows:
        if not row["id"] or row["id"] in seen:
            raise InputError(f"id must be given, each once, got '{row['id']}' ({row['at']})")
        seen.add(row["id"])
        if row["chapter"] not in CHAPTERS:
            raise InputError(f"chapter must be verification or validation, got {row['chapter']}"
                             f" ({row['at']})")
        _bound(row)
        _way(row)
        row["unit"] = row["unit"] or _usual_unit(row)
        if _is_fraction(row) and not row["unit"].startswith("%"):
            raise InputError(f"a unit of {row['metric']} must begin with %, got {row['unit']}"
                             f" ({row['at']})")
    return rows


def shown(row: dict, value: float) -> str:
    """A value of a row's metric with its unit; a dash if there is none."""
    if math.isnan(value):
        return "–"
    return f"{100.0 * value if _is_fraction(row) else value:.3g} {row['unit']}".rstrip()


def shown_tolerance(row: dict) -> str:
    """The tolerance of a row with its side and unit."""
    at_least, bound = _bound(row)
    return f"{'≥' if at_least else '≤'} {shown(row, bound)}"


def _is_fraction(row):
    return _way(row)[1] == "rel" or _way(row)[1].startswith("of:")


def _usual_unit(row):
    if _is_fraction(row):
        return "%"
    parts = row["quantity"].split("_")
    ends = ("_".join(parts[k:]) for k in range(1, len(parts)))
    return next((UNITS[end] for end in ends if end in UNITS), "")


def judge(row: dict, folder: str) -> Verdict:
    """Compare what one row of the manifest asks for."""
    path = row["value_file"]
    if not path.startswith("reference/"):
        path = os.path.join(folder, path)
    if not os.path.exists(path):
        return Verdict(row, math.nan, 0, "missing", f"no file {row['value_file']}")
    table = read_table(path, [row["quantity"]])
    chosen = _select(table, row["case"], row) & _select(table, row["method"], row)
    values = table.numbers(row["quantity"], missing=True)
    if not chosen.any():
        return Verdict(row, math.nan, 0, "missing", "no such row in the value file")
    if np.isnan(values[chosen]).any():
        count = int(np.isnan(values[chosen]).sum())
        return Verdict(row, math.nan, int(chosen.sum()), "FAIL", f"{count} rows without a result")
    reduce, measure = _way(row)
    reference = _reference(row, table, chosen)
    sizes = _sizes(row, table, chosen, values[chosen], reference, measure)
    value = float(_WAYS[reduce](sizes))
    word = "pass" if accepts(row, value) else "FAIL"
    return Verdict(row, value, int(chosen.sum()), word, "")


def accepts(row: dict, value: float) -> bool:
    """Does a value of a row's metric hold its tolerance?"""
    at_least, bound = _bound(row)
    return value >= bound if at_least else value <= bound


def _bound(row):
    text = row["tolerance"]
    at_least = text.startswith(">")
    try:
        bound = float(text.lstrip(">"))
    except ValueError:
        bound = math.nan
    if not math.isfinite(bound):
        raise InputError(f"tolerance must be a number, got {text} ({row['at']})")
    return at_least, bound


def _way(row):
    reduce, _, measure = row["metric"].partition("_")
    if reduce not in _WAYS or not (measure in ("value", "abs", "rel") or measure[:3] == "of:"):
        raise InputError(f"metric must be one of {', '.join(_WAYS)} with _value, _abs, _rel or"
                         f" _of:, got {row['metric']} ({row['at']})")
    return reduce, measure


def _select(table, conditions, row):
    """Which rows fulfil all of `column=value; ...`; numbers are compared as numbers."""
    chosen = np.ones(len(table), dtype=bool)
    for part in filter(None, (text.strip() for text in conditions.split(";"))):
        column, equals, wanted = part.partition("=")
        if not equals:
            raise InputError(f"case must be column=value, got {part} ({row['at']})")
        chosen &= np.array([_same(word, wanted.strip()) for word in table.words(column.strip())])
    return chosen


def _same(word, wanted):
    if word == wanted:
        return True
    try:
        return math.isclose(float(word), float(wanted), rel_tol=1e-12)
    except ValueError:
        return False


def _reference(row, table, chosen):
    """The reference of each chosen row: zero where there is none."""
    text = row["reference_file"]
    if not text:
        return np.zeros(int(chosen.sum()))
    try:
        return np.full(int(chosen.sum()), float(text))
    except ValueError:
        pass
    path, hash_sign, rest = text.partition("#")
    column, at_sign, key = rest.partition("@")
    if not hash_sign or not at_sign:
        raise InputError(f"reference_file must be a number or FILE#COLUMN@KEY, got {text}"
                         f" ({row['at']})")
    other = read_table(path, (column, key))
    values, keys = other.numbers(column), other.words(key)
    found = []
    for word in np.array(table.words(key))[chosen]:
        places = [k for k, known in enumerate(keys) if _near(word, known)]
        if len(places) != 1:
            raise InputError(f"{path} must have one row with {key} {word}, got {len(places)}"
                             f" ({row['at']})")
        found.append(values[places[0]])
    return np.array(found)


def _near(word, known):
    try:
        return abs(float(word) - float(known)) < KEY_TOLERANCE
    except ValueError:
        return word == known


def _sizes(row, table, chosen, values, reference, measure):
    if measure == "value":
        return values
    difference = np.abs(values - reference)
    if measure == "abs":
        return difference
    if measure == "rel":
        base = np.abs(reference)
    else:
        base = np.ones(len(values))
        for factor in measure[3:].split("*"):
            base = base * _factor(factor.strip(), table, chosen)
    if (base == 0.0).any():
        raise InputError(f"the base of {row['metric']} must not be zero ({row['at']})")
    return difference / base


def _factor(text, table, chosen):
    if text == "c":
        return np.sqrt(table.numbers("area_mm2", missing=True)[chosen] / math.pi)
    try:
        return float(text)
    except ValueError:
        return table.numbers(text, missing=True)[chosen]
