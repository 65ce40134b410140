#!/usr/bin/env python3
"""Fill the documents with measured figures, which stand in reference/measured.csv alone.

    validation.py                 write docs/validation.md and fill the marked places
    validation.py --check         exit 1 and name what is not as this tool would write it
    validation.py --take FOLDER   before that, condense the full report in FOLDER, with
                                  data/estimates.csv of `bench estimates`, into
                                  reference/measured.csv

A marked place of README.md or docs/*.md is `<!-- measured: NAME -->...<!-- end -->`. NAME is a
table of TABLES here, or TABLE/ROW/COLUMN of reference/measured.csv: two digits of that number, or
of a hundred times it where NAME ends in `%`.
"""

from __future__ import annotations

import argparse
import math
import os
import re
import sys
from pathlib import Path

from measured import ROOT, Measured, condense, measured_csv  # first: it finds the plots' package

# isort: split
sys.path.append(str(ROOT / "tools" / "docs"))
from faststrip_plots.tables import InputError, read_table  # noqa: E402
from faststrip_plots.verdicts import (  # noqa: E402
    CHAPTERS,
    accepts,
    read_manifest,
    shown,
    shown_tolerance,
)
from pages import FENCE  # noqa: E402

MEASURED = "reference/measured.csv"
MANIFEST = "reference/comparisons.csv"
CLAIMS = "reference/claims/claims.csv"
ESTIMATED = "reference/claims/estimates.csv"
SPEED = "reference/speed.csv"
PAINTED = "reference/page.csv"
SCALE = "reference/scale.csv"
SPREAD = ("median", "p95", "worst")
# What docs/choosing.md shows of it.
TAILS = (("normal", "strips in KPEC 15"), ("normal", "strips 15"),
         ("warm step, 15 strips", "load 2.5 %"), ("tangential", "FASTSIM 50x50"),
         ("tangential", "FASTSTRIP 15x15"), ("wheelset", "cold start"),
         ("batch", "row, new gap"))
# What docs/choosing.md compares: solutions of `trade`, with their methods in `scale`.
CHOICES = (("Hertz + Polach", "hertz + polach"), ("Hertz + FASTSIM 50x50", "hertz + fastsim"),
           ("strips 15 + FASTSIM 50x50", None), ("strips + FASTSTRIP 5x8", None),
           ("strips + FASTSTRIP 15x15", "strip + faststrip"), ("NORM + TANG 0.4 mm", None),
           ("NORM + TANG 0.2 mm", "norm + tang"))
ALL = "all"  # kinds together
PROMISED = ("worst", "times_strips_sure", "times_strips", "times_kalker_sure", "times_kalker",
            "us_median", "us_p95")
PAGE = "docs/validation.md"
PLACE = re.compile(r"<!-- measured: (?P<name>.*?) -->(?P<text>.*?)<!-- end -->", re.DOTALL)

FIGURES = ("penetration", "area", "pmax", "Fx", "Fy", "Mz")
FORCES = ("Fx", "Fy", "Mz")
LABELS = {
    "faststrip": "FASTSTRIP", "faststrip-plain": "FASTSTRIP, plain",
    "fastsim": "FASTSIM", "faststrip-paper": "TFASTSTRIP as printed",
    "faststrip-corrected": "TFASTSTRIP as corrected", "fastsim-elliptic": "FASTSIM, elliptic bound",
    "fastsim-weighted": "FASTSIM, one flexibility", "linear": "linear theory", "polach": "Polach",
    "she": "Shen, Hedrick and Elkins", "cold": "cold start", "warm_load": "load changed by 5 %",
    "warm_shift": "wheelset moved by 0.05 mm",
}
KALKER = {"NORM": "kalker_normal", "TANG": "kalker_tangential"}
CONTACTS = {
    "strip + faststrip": "strips + FASTSTRIP",
    "strip + fastsim": "strips + FASTSIM on the equal ellipse",
    "hertz + fastsim": "Hertz + FASTSIM",
}
ESTIMATES = {"residuals": "strips", "richardson": "strips, from two numbers of them",
             "norm": "kalker_normal"}
SLIDERS = {"shift": "lateral displacement", "yaw": "yaw", "load": "wheel load",
           "cksi": "longitudinal creepage", "cphi": "spin", "mu": "friction",
           "wheelset": "lateral displacement, wheelset"}
INFLUENCE = {
    "published": "published polynomial, degree 6", "refit 6": "fresh fit, degree 6",
    "refit 9": "fresh fit, degree 9", "refit 12": "fresh fit, degree 12",
    "closed": "closed evaluation", "gsl 1-D": "GSL, one dimension",
    "gsl 2-D": "GSL, two dimensions",
}


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--take", metavar="FOLDER")
    parser.add_argument("--root", default=str(ROOT), metavar="FOLDER",
                        help="the checkout whose documents are meant")
    options = parser.parse_args(arguments)
    root = Path(options.root)
    if options.take:
        write(root / MEASURED, measured_csv(*condense(options.take)))
    wanted = documents(root)
    changed = [path for path, text in wanted.items()
               if not path.is_file() or path.read_text(encoding="utf-8") != text]
    if options.check:
        for path in changed:
            print(f"validation: not as measured: {path.relative_to(root)}; run"
                  " tools/measure/validation.py", file=sys.stderr)
        return 1 if changed else 0
    for path in changed:
        write(path, wanted[path])
        print(path.relative_to(root))
    return 0


def write(path, text):
    """Write a file in one go: whole or as it was."""
    rest = path.with_name(path.name + ".part")
    rest.write_text(text, encoding="utf-8")
    os.replace(rest, path)


def documents(root):
    """Every document with its marked places filled, and the page made here."""
    figures = Figures(root)
    page = root / PAGE
    found = {page: validation_page(figures)}
    pages = sorted((root / "docs").glob("*.md"))
    for path in [root / "README.md", root / "CONTRIBUTING.md", *pages]:
        if path != page and path.is_file():
            found[path] = filled(path.read_text(encoding="utf-8"), figures,
                                 path.relative_to(root))
    return found


def filled(text, figures, path):
    """A text with its marked places filled; code stays as it is."""
    def fill(match):
        return f"<!-- measured: {match['name']} -->{figures.place(match['name'])}<!-- end -->"

    parts, last = [], 0
    for start, end in [fence.span() for fence in FENCE.finditer(text)] + [(len(text), len(text))]:
        words = text[last:start]
        if words.count("<!-- measured:") != len(PLACE.findall(words)):
            raise InputError(f"every marked place must end: {path}")
        parts += [PLACE.sub(fill, words), text[start:end]]
        last = end
    return "".join(parts)


class Figures:
    """The measured figures of a checkout, as the documents show them."""

    def __init__(self, root):
        self.measured = Measured(root / MEASURED)
        self.manifest = read_manifest(str(root / MANIFEST))
        self.root = root

    def place(self, name):
        """What stands in a marked place."""
        if name in TABLES:
            return f"\n{TABLES[name](self)}\n"
        percent = name.endswith("%")
        parts = name.rstrip("% ").split("/")
        if len(parts) != 3:
            raise InputError(f"a marked place must be a table or TABLE/ROW/COLUMN, got {name}")
        word = self.measured.word(*parts)
        try:
            value = float(word)
        except ValueError:
            raise InputError(f"a figure must be a number, got {word}: {name}") from None
        return digits(100.0 * value if percent else value)

    def pair(self, table, row, name, factor=1.0):
        """`mean / largest`, or a dash."""
        if (table, row, f"{name}_mean") not in self.measured.cells:
            return "–"
        return " / ".join(digits(factor * self.measured.number(table, row, f"{name}_{word}"))
                          for word in ("mean", "max"))

    def triple(self, table, row, name):
        """`median / 95th percentile / largest`."""
        return " / ".join(digits(self.measured.number(table, row, f"{name}_{word}"))
                          for word in ("median", "p95", "worst"))


def digits(value):
    """A number as people read it: two digits, whole numbers from ten on as they are."""
    if value == 0.0 or not math.isfinite(value):
        return f"{value:g}"
    if abs(value) >= 9.95:
        return f"{value:.0f}"
    if abs(value) < 1e-4:
        mantissa, power = f"{value:.1e}".split("e")
        return f"{mantissa}e{int(power)}"
    return f"{value:.{1 - math.floor(math.log10(abs(float(f'{value:.1e}'))))}f}"


def label(name, labels):
    """A name of the data, word by word as people call them."""
    return " ".join(labels.get(word, word) for word in name.split())


def table(header, rows):
    """A Markdown table; columns of figures stand on the right."""
    columns = list(zip(*rows)) or [()] * len(header)
    rule = ["---:" if all(re.match(r"[\d–-]", cell) for cell in cells) else "---"
            for cells in columns]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in [header, rule, *rows])


def contacts_table(figures):
    return table(["method", "penetration %", "area %", "pmax %", "Fx % of mu N", "Fy % of mu N",
                  "Mz % of mu N c"],
                 [[CONTACTS.get(row, row),
                   *(figures.pair("contacts", row, name) for name in FIGURES)]
                  for row in figures.measured.rows("contacts")])


def forces_table(figures, own):
    rows = [row for row in figures.measured.rows("forces") if row.startswith(f"{own} ")]
    return table(["method", "contacts", "Fx % of mu N", "Fy % of mu N", "Mz % of mu N c"],
                 [[LABELS.get(row.split(" ", 1)[1], row),
                   figures.measured.word("forces", row, "contacts"),
                   *(figures.pair("forces", row, name) for name in FORCES)] for row in rows])


def rolling_table(figures):
    return table(["scheme and elements", "Fx % of mu N", "Fy % of mu N", "Mz % of mu N c"],
                 [[row.replace(" ", " order, ", 1),
                   *(figures.pair("rolling", row, name) for name in ("fx", "fy", "mz"))]
                  for row in figures.measured.rows("rolling")])


def convergence_table(figures):
    kinds = {"hertz": "ellipses, against Hertz", "shift": "20 contacts, against 301 strips"}
    return table(["contacts and strips", "penetration %", "pmax %", "area %"],
                 [[f"{kinds[row.split()[0]]}: {row.split()[1]}",
                   *(figures.pair("convergence", row, name, 100.0)
                     for name in ("penetration", "pmax", "area"))]
                  for row in figures.measured.rows("convergence")])


def trade_table(figures):
    return table(["method", "contacts", "error %: mean / largest",
                  "ms: median / 95th percentile / largest"],
                 [[label(row, KALKER), figures.measured.word("trade", row, "contacts"),
                   figures.pair("trade", row, "error"), figures.triple("trade", row, "ms")]
                  for row in figures.measured.rows("trade")])


def choice_table(figures):
    """A few solutions of `trade`, with contacts per second in `batch` where they were measured."""
    given = read_table(str(figures.root / SCALE), ("group", "what", "contacts_per_core_s"))
    rates = dict(zip(zip(given.words("group"), given.words("what")),
                     given.numbers("contacts_per_core_s", missing=True)))
    return table(["method", "contacts", "error of the forces, %: mean / largest",
                  "ms: median / 95th percentile / largest", "contacts / s in `batch`"],
                 [[row, figures.measured.word("trade", row, "contacts"),
                   figures.pair("trade", row, "error"), figures.triple("trade", row, "ms"),
                   known(rates.get(("method", method), math.nan))] for row, method in CHOICES])


def influence_table(figures):
    def nanoseconds(row, loop):
        if ("influence", row, f"ns_{loop}") not in figures.measured.cells:
            return "–"
        return digits(figures.measured.number("influence", row, f"ns_{loop}"))

    return table(["method", "largest relative error", "ns, one by one", "ns, in a row of 21"],
                 [[INFLUENCE.get(row, row),
                   digits(figures.measured.number("influence", row, "rel_err")),
                   nanoseconds(row, "scalar"), nanoseconds(row, "row")]
                  for row in figures.measured.rows("influence")])


def times_table(figures):
    rows = figures.measured.rows("times")
    return table(["stage", "µs: median / 95th percentile / largest"],
                 [[label(row, LABELS), figures.triple("times", row, "us")] for row in rows])


def extremes_table(figures):
    return table(["what", "cases", "largest relative error"],
                 [[row, figures.measured.word("extremes", row, "cases"),
                   digits(figures.measured.number("extremes", row, "largest"))]
                  for row in figures.measured.rows("extremes")])


def estimates_table(figures):
    names = ("penetration", "pmax", "area")

    def cells(row):
        for name in names:
            if ("estimates", row, f"{name}_bounded") in figures.measured.cells:
                share = figures.measured.number("estimates", row, f"{name}_bounded")
                ratio = figures.measured.number("estimates", row, f"{name}_ratio")
                cases = figures.measured.word("estimates", row, f"{name}_cases")
                yield f"{100.0 * share:.0f} % of {cases}, {digits(ratio)} times"
            else:
                yield "–"

    return table(["estimate and contacts", *names],
                 [[f"{ESTIMATES.get(own, own)}: {contacts}", *cells(f"{own}, {contacts}")]
                  for own, contacts in (row.split(", ", 1)
                                        for row in figures.measured.rows("estimates"))])


def claims_table(figures):
    given = read_table(str(figures.root / CLAIMS),
                       ("target", "tolerance", "promised", "kept", *PROMISED))
    numbers = {name: given.numbers(name, missing=True) for name in ("tolerance", *PROMISED)}
    return table(["target and tolerance", "claims held", "largest error over tolerance",
                  "times faster than 31 strips that claim it", "that are within it",
                  "than NORM and TANG that claim it", "all", "ms: median / 95 %"],
                 [[f"{target}, {100.0 * numbers['tolerance'][k]:g} %",
                   f"{kept} of {promised}, {100.0 * int(kept) / max(int(promised), 1):.1f} %",
                   *(known(numbers[name][k]) for name in PROMISED[:5]),
                   " / ".join(known(1e-3 * numbers[f"us_{name}"][k])
                              for name in ("median", "p95"))]
                  for k, (target, promised, kept) in enumerate(zip(
                      given.words("target"), given.words("promised"), given.words("kept")))])


def force_estimates_table(figures):
    given = read_table(str(figures.root / ESTIMATED),
                       ("method", "kind", *(f"{name}_{word}" for name in FORCES
                                            for word in ("bounded", "ratio"))))
    numbers = {f"{name}_{word}": given.numbers(f"{name}_{word}", missing=True)
               for name in FORCES for word in ("bounded", "ratio")}

    def cell(k, name):
        if math.isnan(numbers[f"{name}_bounded"][k]):
            return "–"
        return (f"{100.0 * numbers[f'{name}_bounded'][k]:.1f} %,"
                f" {known(numbers[f'{name}_ratio'][k])} times")

    return table(["method", *FORCES],
                 [[method, *(cell(k, name) for name in FORCES)]
                  for k, (method, kind) in enumerate(zip(given.words("method"),
                                                         given.words("kind")))
                  if kind == ALL and not math.isnan(numbers["Fx_bounded"][k])])


def known(value):
    """Digits, or a dash where there is no number."""
    return "–" if math.isnan(value) else digits(value)


SPEEDS = tuple(f"{name}_{word}" for name in ("us", "over_fastsim", "over_contact")
               for word in SPREAD)


def speeds(figures):
    """What `./run speed` has measured, and a row's spread of one name."""
    given = read_table(str(figures.root / SPEED),
                       ("group", "what", "worst_case", "contact", *SPEEDS))
    numbers = {name: given.numbers(name, missing=True) for name in SPEEDS}

    def triple(name, k):
        values = [numbers[f"{name}_{word}"][k] for word in SPREAD]
        return "–" if math.isnan(values[0]) else " / ".join(map(digits, values))

    return given, triple


def speed_table(figures):
    given, triple = speeds(figures)
    return table(["median / 95th percentile / largest", "µs", "largest at", "over FASTSIM 50x50",
                  "over CONTACT's time", "its mode and grid, mm"],
                 [[f"{group}: {what}", triple("us", k), given.words("worst_case")[k],
                   triple("over_fastsim", k), triple("over_contact", k),
                   given.words("contact")[k] or "–"]
                  for k, (group, what) in enumerate(zip(given.words("group"),
                                                        given.words("what")))])


def tails(figures):
    """Times of a few things that hosts wait for, with the case of the largest."""
    given, triple = speeds(figures)
    places = {key: k for k, key in enumerate(zip(given.words("group"), given.words("what")))}
    for key in TAILS:
        if key not in places:
            raise InputError(f"no such time: {', '.join(key)} ({SPEED})")
    return table(["µs", "median / 95th percentile / largest", "largest at"],
                 [[f"{group}: {what}", triple("us", places[group, what]),
                   given.words("worst_case")[places[group, what]]] for group, what in TAILS])


def page_table(figures):
    """What `./run page` has measured."""
    steps = ("arrived", "drawn", "painted")
    given = read_table(str(figures.root / PAINTED),
                       ("slider", *(f"{step}_ms_{word}" for step in steps
                                    for word in ("median", "p95"))))
    numbers = {step: [given.numbers(f"{step}_ms_{word}") for word in ("median", "p95")]
               for step in steps}
    return table(["median / 95th percentile, ms", "changes in the browser", "drawn", "seen"],
                 [[SLIDERS[slider], *(" / ".join(f"{both[k]:.0f}" for both in numbers[step])
                                      for step in steps)]
                  for k, slider in enumerate(given.words("slider"))])


def scale_table(figures):
    """What `./run scale` has measured."""
    names = ("contacts_per_core_s", "efficiency", "peak_MB", "size_MB")
    given = read_table(str(figures.root / SCALE),
                       ("group", "what", "contacts", "processes", "threads", "hours", "cores",
                        *names))
    numbers = {name: given.numbers(name, missing=True)
               for name in ("contacts", "processes", "threads", "hours", "cores", *names)}
    rows = []
    for k, (group, what) in enumerate(zip(given.words("group"), given.words("what"))):
        cell = {name: values[k] for name, values in numbers.items()}
        shared = "–"
        if not math.isnan(cell["processes"]):
            shared = f"{cell['processes']:.0f} x {cell['threads']:.0f}"
        rows.append([f"{group}: {what}", f"{cell['contacts']:.0e}".replace("e+0", "e"), shared,
                     *(known(cell[name]) for name in names),
                     known(cell["hours"] * cell["cores"])])
    return table(["", "contacts", "processes x threads", "contacts / s / core", "efficiency",
                  "memory, MB", "size, MB", "core hours"], rows)


def statements_table(figures):
    return table(["verdict", "statements"],
                 [[row, figures.measured.word("statements", row, "count")]
                  for row in figures.measured.rows("statements")])


def verdict_table(figures, chapter):
    rows = []
    for row in figures.manifest:
        if row["chapter"] != chapter:
            continue
        if ("verdicts", row["id"], "value") in figures.measured.cells:
            value = figures.measured.number("verdicts", row["id"], "value")
            word = "holds" if accepts(row, value) else "does not hold"
            number = figures.measured.word("verdicts", row["id"], "rows")
        else:
            value, word, number = math.nan, "not measured yet", "–"
        rows.append([f"`{row['id']}`", number, shown(row, value), shown_tolerance(row), word,
                     label(row["source"], KALKER)])
    return table(["comparison", "rows", "value", "tolerance", "verdict", "reference"], rows)


def stamp(figures):
    lines = [line for line in figures.measured.comments
             if line.startswith(("faststrip ", "compiler ", "processor "))]
    return "\n".join(f"- {line}" for line in lines)


TABLES = {
    "contacts": contacts_table,
    "forces of other gaps": lambda figures: forces_table(figures, "scenes"),
    "forces of ellipses": lambda figures: forces_table(figures, "hertz"),
    "rolling": rolling_table,
    "convergence": convergence_table,
    "trade": trade_table,
    "choice": choice_table,
    "influence": influence_table,
    "times": times_table,
    "speed": speed_table,
    "tails": tails,
    "page": page_table,
    "scale": scale_table,
    "extremes": extremes_table,
    "estimates": estimates_table,
    "claims": claims_table,
    "force estimates": force_estimates_table,
    "statements": statements_table,
    "stamp": stamp,
} | {chapter: (lambda figures, own=chapter: verdict_table(figures, own)) for chapter in CHAPTERS}

# The page: headings, words, and the tables that belong to them.
SECTIONS = (
    ("Data and revision", "", "stamp"),
    ("Verification against exact solutions",
     "Each row is a line of `reference/comparisons.csv`, which defines how it is computed.",
     "verification"),
    ("Extreme cases",
     "Strips 1e-12 to 1e12 times as wide as long, up to a million strips apart, against quadruple"
     " precision; ellipses with a/b from 1e-3 to 1e3 under loads from 1e-6 to 1e9 N, 15 strips,"
     " against Hertz (`bench extremes`).", "extremes"),
    ("Validation against other codes",
     "CONTACT's penetration and maximum pressure are those of its 0.1 mm grid; everything else is"
     " extrapolated in its grid. References of `kalker_normal` and `kalker_tangential` are this"
     " project's own, themselves compared with CONTACT.", "validation"),
    ("Contacts of the paper's section 5",
     "The 20 contacts against full CONTACT, mean / largest absolute error, with the usual 15 strips"
     " in the largest patch and 15 points along each. c is the root of area over pi.",
     "contacts"),
    ("Convergence of strips", "Errors against the number of strips, mean / largest.",
     "convergence"),
    ("Creep forces on random gaps",
     "Eight families of gaps with loads, materials, friction and creepages drawn at random, against"
     " kalker_normal and kalker_tangential; no constant was fitted to them. Mean / largest.",
     "forces of other gaps"),
    ("Creep forces on ellipses",
     "From no slip to saturation, against full CONTACT. Mean / largest. On these contacts and the"
     " paper's the constants of FASTSTRIP were chosen.", "forces of ellipses"),
    ("Kalker's method in rolling",
     "`kalker_tangential` against CONTACT extrapolated, the paper's contacts with the physical"
     " signs, mean / largest.", "rolling"),
    ("Coverage of the error estimates",
     "Share of the true errors that the estimates bound, and the median of estimate over error"
     " (`bench estimates`, 5 to 41 strips and auto). Where the reference solution is uncertain"
     " a contact does not count. Most factors of the estimates were chosen on ellipses, on every"
     " second of the 20 contacts and on random gaps of other distributions.", "estimates"),
    ("Coverage of the force error estimates",
     "The same for the creep forces, on contacts of 15 kinds to which nothing was fitted and on"
     " ellipses, each with two creepages (`faststrip-lab claims`; NORM and TANG, extrapolated,"
     " are the reference).", "force estimates"),
    ("Coverage of automatic solutions",
     "On the same contacts, by the program itself: status `ok` claims an error within the"
     " tolerance. Times are summed over the contacts and compared with those of 31 strips with"
     " FASTSTRIP, on the contacts where their own estimates are within the tolerance, and where"
     " their errors are (which is unknown in practice); and with those of NORM and TANG with 36"
     " elements across.", "claims"),
    ("Error against time",
     "The worst of Fx, Fy, Mz, in percent of mu N and mu N c; times of both stages together on one"
     " core, cold (`bench trade`).", "trade"),
    ("Influence integral",
     "Geometric means of times over n = 0, 1, 10 and b = 0.02, 0.3, 5 (`bench integral`).",
     "influence"),
    ("Computing times of the stages", "Processor time on the paper's contacts (`bench normal`,"
     " `bench tangential`, 15 strips by 15 points).", "times"),
    ("Computing times in one run",
     "Processor time of one contact, step, state or row; ratios for the same contact, to FASTSIM in"
     " the same run and to the time recorded for CONTACT on another machine, whose KPEC and ANALYN"
     " were given the penetration (`./run speed`, `./run stored speed`).", "speed"),
    ("Large batches",
     "`batch` on the paper's gaps in turn, with a load and creepages for each row: rows per second"
     " of processor time, elapsed time of one thread over that of n times n (or the number of"
     " cores, two), peak memory, sizes of input and results, and a thousand million contacts by"
     " division (`./run scale`, `./run stored scale`).", "scale"),
    ("Statements of the paper",
     "The report tests the statements of the paper one by one and gives each a verdict.",
     "statements"),
)


def validation_page(figures):
    """The whole of docs/validation.md."""
    parts = [
        "<!-- Written by tools/measure/validation.py from reference/comparisons.csv and"
        " reference/measured.csv; change those, not this. -->",
        "# Validation",
        "The results of the last full report, condensed. `./run report` repeats all measurements,"
        " with pictures; `./run stored measured` also writes this page again. Times are of one"
        " machine and depend on its load.",
    ]
    for title, words, name in SECTIONS:
        parts += [part for part in (f"## {title}", words, TABLES[name](figures)) if part]
    return "\n\n".join(parts) + "\n"


if __name__ == "__main__":
    try:
        sys.exit(main())
    except InputError as error:
        sys.exit(f"validation: {error}")
