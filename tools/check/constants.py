#!/usr/bin/env python3
"""List the tuned numbers in docs/constants.md, or check that the list is up to date.

    constants.py [--check] [--bare] [--root FOLDER]

Every number of the rooms that somebody has chosen is a named constant, a parameter or the
default of a component, and carries a tag in the comment above it or beside it:

    ! Strips that find the patches. Tuned [strips]. Origin: chosen for the time of a cold start.
    integer, parameter :: scout_strips = 7

The words before `Tuned` and those between `]:` and `Origin:` say what it is; what stands beside a
name does too. A tag holds for one declaration. Numbers that nobody has chosen carry `Given: why`
instead of it: coefficients of a published formula, dimensions of a standard, numbers of kinds.
Above integers, as numbers of kinds are, it holds for all declarations without a comment between
them. Files of tables are in GIVEN_FILES.

What may stand bare in the code, and in the value of a constant made from others:

- 0, 1, 2, 3, 4, 0.5 and 0.25, with or without a decimal point; whole numbers that are a subscript,
  a bound or a length;
- any number in a statement with `Given: why` in its comment, or in the comment directly above.

All others are refused (--bare prints them only). What happens at half and at double of a number is
in reference/constants.csv, measured by tools/check/sensitivity.py.
"""

import argparse
import csv
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROOMS = ("src/faststrip/base/limits.f90", "src/faststrip/numerics", "src/faststrip/influence",
         "src/faststrip/geometry", "src/faststrip/normal", "src/faststrip/tangential",
         "src/faststrip/stress", "src/faststrip/contact", "src/faststrip/wheelset", "src/kalker",
         "src/tabulate", "app/command")
# Tables and nothing else, and why none of their numbers is tuned.
GIVEN_FILES = {
    "influence/angle_rules.f90": "quadrature rules by their errors",
    "influence/closed_coefficients.f90": "fits, made by tools/generate/influence_coefficients.py",
    "geometry/wheel/s1002.f90": "the profile of EN 13715",
    "tangential/kalker_table.f90": "Kalker's table, written by tools/generate/kalker_table.py",
    "tangential/force/weights.f90": "a fit, written by tools/generate/force_weights.py",
}
PAGE = "docs/constants.md"
MEASURED = "reference/constants.csv"
PLAIN = {0.0, 1.0, 2.0, 3.0, 4.0, 0.5, 0.25}
LARGEST_PLAIN = 4
# Written by tools/generate/methods.py.
GENERATED = re.compile(r"^ *! BEGIN methods.*?^ *! END methods", re.MULTILINE | re.DOTALL)

STRING = re.compile(r"'(?:[^']|'')*'|\"(?:[^\"]|\"\")*\"")
REAL = re.compile(r"(?<![\w.])(?:(\d+\.\d*|\.\d+)(?:[ed]([+-]?\d+))?|(\d+)[ed]([+-]?\d+))"
                  r"(?:_\w+)?(?!\w)", re.IGNORECASE)
WHOLE = re.compile(r"(?<![\w.])(\d+)(?:_[a-z]\w*)?(?![\w.])", re.IGNORECASE)
DECLARATION = re.compile(r"\s*(real|integer|type|complex|character|logical)\b"
                         r"(\s*\([^()]*(?:\([^()]*\)[^()]*)*\))?((?:\s*,[^:]*)?)\s*::\s*(.*)",
                         re.IGNORECASE | re.DOTALL)
ENTITY = re.compile(r"\s*(\w+)\s*(\(.*?\))?\s*=(?!>)\s*(.*)", re.DOTALL)
# Calls whose arguments are no subscripts.
INTRINSIC = re.compile(r"^(?:abs|ceiling|exp|floor|int|log|log10|max|merge|min|mod|modulo|nint|real"
                       r"|sign|spread|sqrt|if|while|case|elseif|parameter|call)$", re.IGNORECASE)
TAG = re.compile(r"Tuned \[([^\]]+)\](?::\s*|\.\s*)(.*?)\s*Origin:\s*(.+)", re.DOTALL)
GIVEN = re.compile(r"\bGiven: \w")
ROW = re.compile(r"\babout=")


class Constant:
    """A named number of a room."""

    def __init__(self, file, line, name, value, kind):
        self.file, self.line, self.name, self.value, self.kind = file, line, name, value, kind
        self.again = 1  # which one, if a file has several of that name
        self.unit = self.what = self.origin = ""

    @property
    def key(self):
        """FILE:NAME, and which one if there are several."""
        again = f":{self.again}" if self.again > 1 else ""
        return f"{self.short.removesuffix('.f90')}:{self.name}{again}"

    @property
    def short(self):
        return short_name(self.file)


class Statement:
    """A statement of Fortran: its code in one line, its lines, its comments."""

    def __init__(self, first, above):
        self.first, self.last, self.above = first, first, above
        self.code, self.beside = "", []


def short_name(file):
    return file.removeprefix("src/").removeprefix("faststrip/").removeprefix("app/")


def without_strings(line):
    """The code of a line with its strings blanked, and its comment, or None."""
    blanked = STRING.sub(lambda found: "'" + " " * (len(found[0]) - 2) + "'", line)
    at = blanked.find("!")
    return (blanked, None) if at < 0 else (blanked[:at], line[at:])


def words_of(comments):
    """The text of comments, without their signs."""
    return " ".join(re.sub(r"^\s*!+[><]?\s?", "", comment).strip() for comment in comments).strip()


def statements(text):
    """The statements of a file in order; each knows the comments directly above and beside it."""
    found, above, current = [], [], None
    for number, line in enumerate(text.splitlines(), start=1):
        code, comment = without_strings(line)
        if not code.strip():
            if comment is None:
                above = []
                if current is None and found:
                    found.append(None)
            elif current is not None:
                current.beside.append(comment)
            elif re.match(r"!!", comment) and found and found[-1] is not None and not above:
                found[-1].beside.append(comment)
            else:
                above.append(comment)
            continue
        if current is None:
            current, above = Statement(number, above), []
        current.last = number
        if comment is not None:
            current.beside.append(comment)
        part = code.strip()
        part = part[1:] if part.startswith("&") else part
        current.code += " " + part.rstrip("&").rstrip() if part.endswith("&") else " " + part
        if not part.endswith("&"):
            found.append(current)
            current = None
    return found


def split_at_commas(text):
    """Parts between the commas outside of all brackets."""
    parts, depth, part = [], 0, ""
    for sign in text:
        depth += (sign in "([") - (sign in ")]")
        if sign == "," and depth == 0:
            parts.append(part)
            part = ""
        else:
            part += sign
    return [*parts, part]


def bare_numbers(code):
    """Numbers of a piece of code that the rule above does not let pass."""
    found = []
    for number in REAL.finditer(code):
        mantissa, power = (number[1], number[2]) if number[1] else (number[3], number[4])
        if float(mantissa) * 10.0 ** int(power or 0) not in PLAIN:
            found.append(number[0])
    # The arguments of a call are no subscripts.
    rest = re.sub(r"\bcall\s+[\w%]+", "call", REAL.sub(" ", code), flags=re.IGNORECASE)
    # Subscripts, bounds and lengths: brackets after a name, the inner ones first.
    before = None
    while before != rest:
        before = rest
        rest = re.sub(r"(\w+)\s*\(([^()]*)\)", take_subscripts, rest)
        rest = re.sub(r"(?<![\w\s])\s*\(([^()]*)\)", r" \1 ", rest)
    found += [number[0] for number in WHOLE.finditer(rest) if int(number[1]) > LARGEST_PLAIN]
    return found


def take_subscripts(found):
    name, inside = found[1], found[2]
    return f" {inside} " if INTRINSIC.match(name) else f" {name} "


def needs_a_tag(value, is_parameter):
    """Is it a number, or made from more than other constants and plain numbers?"""
    # The object of a method has its row of the list, no number of its own.
    if not REAL.search(value) and not WHOLE.search(value) or ROW.search(value):
        return False
    if not is_parameter:
        return not re.fullmatch(r"[-+]?[01](?:\.0*)?(?:_\w+)?", value)
    names = re.findall(r"(?<![\w.%])[a-z]\w*", REAL.sub(" ", WHOLE.sub(" ", value)), re.IGNORECASE)
    return bool(bare_numbers(value)) or not [name for name in names if not name.startswith("_")]


def read_file(file, text):
    """The constants of a file that carry a tag, and what is wrong in it."""
    constants, wrong = [], []
    short = short_name(file)
    text = GENERATED.sub(lambda found: re.sub(r"[^\n]+", "! -", found[0]), text)
    found = statements(text)
    if short in GIVEN_FILES:
        return [], []
    tag, kinds = [], []
    for statement in found:
        if statement is None:
            kinds = []
            continue
        declared = DECLARATION.match(statement.code)
        whole = bool(declared) and declared[1].lower() == "integer"
        tag = statement.above or (kinds if whole else [])
        kinds = tag if whole and GIVEN.search(words_of(tag)) else []
        beside = words_of(statement.beside)
        if not declared:
            if not GIVEN.search(words_of([*statement.above, *statement.beside])):
                wrong += [f"{file}:{statement.first}: bare number {number}"
                          for number in bare_numbers(statement.code)]
            continue
        is_parameter = "parameter" in declared[3].lower()
        text_of_tag = f"{words_of(tag)} {beside}" if tag else beside
        for part in split_at_commas(declared[4]):
            entity = ENTITY.match(part)
            if not entity or declared[1].lower() == "character":
                continue
            value = entity[3].strip()
            if not needs_a_tag(value, is_parameter):
                continue
            constant = Constant(file, statement.first, entity[1], value, declared[1].lower())
            marked = TAG.search(text_of_tag) if "Tuned" in text_of_tag else None
            if marked:
                above = TAG.search(words_of(tag))
                if above:
                    marked = above
                    what = [words_of(tag)[:above.start()], above[2], beside]
                else:
                    what = [beside[:marked.start()], marked[2]]
                constant.unit, constant.origin = marked[1], marked[3].strip()
                constant.what = " ".join(words.strip() for words in what if words.strip())
                if not constant.what:
                    wrong.append(f"{file}:{statement.first}: {constant.name}: not said what it is")
                constant.again += sum(other.name == constant.name for other in constants)
                constants.append(constant)
            elif not GIVEN.search(text_of_tag):
                wrong.append(f"{file}:{statement.first}: {constant.name} = {value[:30]}: neither "
                             "`Tuned [unit]: ... Origin: ...` nor `Given: ...`")
    return constants, wrong


def read_rooms(root):
    constants, wrong = [], []
    for room in ROOMS:
        place = root / room
        for path in [place] if place.is_file() else sorted(place.rglob("*.f90")):
            found, bad = read_file(path.relative_to(root).as_posix(),
                                   path.read_text(encoding="utf-8"))
            constants += found
            wrong += bad
    return constants, wrong


def read_measured(root):
    """The rows of the measured file by file and name; that without a change has neither."""
    path = root / MEASURED
    if not path.exists():
        return {}
    with open(path, encoding="utf-8") as stream:
        rows = csv.DictReader(line for line in stream if not line.startswith("#"))
        return {(row["file"], row["name"], row["value"]): row for row in rows}


def row_for(constant, measured):
    """What was measured for a number of that value; one that moved keeps its row."""
    value = " ".join(constant.value.replace("&", " ").split())
    row = measured.get((constant.short, constant.name, value))
    if row:
        return row
    same = [row for (_, name, old), row in measured.items()
            if (name, old) == (constant.name, value)]
    return same[0] if len(same) == 1 else None


def percent(text):
    value = 100.0 * float(text)
    return f"{value:.2g} %" if value >= 0.001 else ""


def told(row, factor, plain):
    """What happens at half or at double, in few words."""
    if row is None:
        return "not measured"
    if row[f"{factor}_outcome"] != "ok":
        return row[f"{factor}_outcome"]
    said = []
    for column, words in (("change", "contacts"), ("force_change", "forces"),
                          ("random_change", "random gaps"), ("estimate_change", "estimates"),
                          ("kalker_change", "kalker")):
        value = percent(row[f"{factor}_{column}"])
        if value:
            said.append(f"{words} {value}")
    if int(row[f"{factor}_random_status"]):
        said.append(f"{row[f'{factor}_random_status']} of 80 with another status")
    for column, words in (("penetration_error", "penetration"), ("pmax_error", "pmax"),
                          ("area_error", "area"), ("force_error", "forces")):
        new, old = float(row[f"{factor}_{column}"]), float(plain[f"{factor}_{column}"])
        if abs(new - old) > 0.05 * old:
            said.append(f"error of {words} {old:.2g} to {new:.2g} %")
    ratio = row[f"{factor}_iterations"]
    if ratio and abs(float(ratio) - 1.0) > 0.05:
        said.append(f"iterations x {float(ratio):.2g}")
    return ", ".join(said) or "nothing"


def cell(text):
    return text.replace("|", "\\|").replace("$", "").replace("[", "\\[").replace("]", "\\]")


def page(constants, measured):
    plain = measured.get(("", "", ""))
    rows = {constant.key: row_for(constant, measured) for constant in constants}
    count = sum(row is not None for row in rows.values())
    lines = [
        f"<!-- Written by tools/check/constants.py from the sources and {MEASURED}; change those,"
        f" not this."
        " -->", "",
        "# Constants", "",
        f"The {len(constants)} tuned numbers of the solver and the program, by room: those that"
        " were chosen in this project."
        " Unit and origin are beside each in the source, marked by `Tuned [unit]`. Origins:"
        " *chosen* is by judgement, no measurement was kept; *safeguard* bounds what no sensible"
        " contact reaches; *capacity* bounds memory or work; *calibrated* was fitted to"
        " errors.", "",
        "Given numbers are not listed: those of published formulas, standards and"
        " fits, and numbers of kinds; in the source they are marked `Given`. Without a name only"
        " 0, 1, 2,"
        " 3, 4, 0.5 and 0.25, subscripts, bounds and lengths are allowed; a test rejects all others"
        " (`tools/check/constants.py`, which states the rule).", "",
        f"Effect of half and double the value: {count} were measured by"
        " `tools/check/sensitivity.py`, the others were not. Given is the largest relative change"
        " of penetration, pmax and area on the 20 contacts of the reference (contacts), of a"
        " force by any method over mu N on 441 contacts (forces), of 80 random gaps, of"
        " estimated errors there over the larger of both, and of the results of kalker_normal"
        " and kalker_tangential (kalker); of mean errors against CONTACT those that change by a"
        " twentieth, and so of iterations of the random gaps, where counted. *nothing*: no"
        " change above 0.001 %. A single random gap near to two solutions makes a large change.",
    ]
    for room in sorted({constant.short.split("/")[0] for constant in constants}):
        lines += ["", f"## {room}", "",
                  "| name | file | value | unit | what | origin | half | double |",
                  "|---|---|---|---|---|---|---|---|"]
        for constant in constants:
            if constant.short.split("/")[0] != room:
                continue
            value = " ".join(constant.value.replace("&", " ").split())
            value = re.sub(r"_(?:wp|int64)\b", "", value)
            value = value if len(value) <= 60 else value[:57] + "..."
            row = rows[constant.key]
            cells = [f"`{constant.name}`", cell(constant.short), f"`{value}`", cell(constant.unit),
                     cell(constant.what), cell(constant.origin),
                     *(told(row, factor, plain) for factor in ("half", "double"))]
            lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="write nothing, exit 1 if stale")
    parser.add_argument("--bare", action="store_true", help="write nothing, print what is refused")
    parser.add_argument("--root", type=pathlib.Path, default=ROOT, help=argparse.SUPPRESS)
    options = parser.parse_args()
    constants, wrong = read_rooms(options.root)
    if wrong:
        sys.exit("\n".join(wrong))
    if options.bare:
        return
    text = page(constants, read_measured(options.root))
    path = options.root / PAGE
    if path.exists() and path.read_text(encoding="utf-8") == text:
        return
    if options.check:
        sys.exit(f"constants: {PAGE} is not as the sources say, run tools/check/constants.py")
    path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
