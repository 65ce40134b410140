#!/usr/bin/env python3
"""Write what repeats the catalogue of columns, or check that it is up to date.

    columns.py PROGRAM [--check]

The catalogue is what `faststrip columns` prints: the figures of a contact and the other columns,
with unit, meaning and the name that interfaces have for them. Written from it are the tables of
docs/formats.md, the members of faststrip_result and their comments in the C header, the rows of
the F77 interface in its comment, units, meanings and fields of Python's results, and, from the
structs of the C interface in Fortran, Python's structs. With --check nothing is written; the exit
code is 1 if something would be.
"""

import argparse
import csv
import itertools
import pathlib
import re
import subprocess
import sys
import textwrap

ROOT = pathlib.Path(__file__).resolve().parents[2]
WIDTH = 100
STRUCTS = "src/faststrip/interop/c/structs.f90"
WHEELSETS = "src/faststrip/interop/c/wheelset.f90"
ROWS = "src/faststrip/interop/f77/rows.f90"
F77 = "src/faststrip/interop/f77/f77.f90"
# Between which lines of its comment the figures of its rows stand.
PLACES = {"res": ("PAR(9) spin, rad/mm\n", "\n!> RES(14)"),
          "err": ("!> RES(14) number of strips\n", "\n!> ERR(6)"),
          "ferr": ("0: no strips\n", "\n!> FERR(4)")}
PARTS = {"case": "What is solved", "result": "How it ended", "contact": "Figures of a contact",
         "part": "Strips, elements, gaps", "wheelset": "Wheelsets",
         "conicity": "Conicity and contact functions", "profile": "Descriptions of profiles"}
# What a figure needs, in words.
NEEDS = {"forces": "creep forces", "stick": "a method that knows it", "strips": "strips",
         "errors": "estimates", "residuals": "estimates", "force errors": "estimates of forces",
         "target": "`--normal auto`", "smoothing": "`--smooth`", "times": "",
         "temperatures": "`&thermal`",
         "yield in shear": "`--yield-shear-MPa`",
         "wear law": "`--wear`, and a method with forces of strips"}
# As people write units.
PLAIN = {"mm2": "mm^2", "mm-1": "1/mm", "mm s-1": "mm/s", "rad mm-1": "rad/mm",
         "N mm-2": "N/mm^2", "ug m-1": "ug per metre", "mm3 m-1": "mm^3 per metre", "degC": "C",
         "1": ""}


def rows_of(program):
    done = subprocess.run([program, "columns"], stdout=subprocess.PIPE, encoding="utf-8",
                          check=True)
    return list(csv.DictReader(line for line in done.stdout.splitlines() if line[0] != "#"))


def members_of(text, struct):
    """Members of a `bind(c)` type, in their order: kind, name, number of elements."""
    body = re.search(rf"type, bind\(c\) :: {struct}\n(.*?)\n    end type", text, re.DOTALL)
    joined = re.sub(r"&\s*\n\s*", "", body.group(1))
    found = []
    for kind, names in re.findall(r"(?:integer|real|type)\((\w+)\) :: (.*)", joined):
        for name, length in re.findall(r"(\w+)(?:\((\d+)\))?(?: = (?:0|c_null_ptr))?(?:, |$)",
                                       names):
            found.append((kind.replace("c_ptr", "c_void_p"), name, int(length or 1)))
    return found


def in_words(row):
    unit = PLAIN.get(row["unit"], row["unit"])
    return row["what"] + (f", {unit}" if unit else "")


def of_page(rows):
    lines = []
    for group, title in PARTS.items():
        lines += ["", f"{title}:", "", "| column | unit | in interfaces | what |",
                  "|---|---|---|---|"]
        for row in rows:
            if row["group"] != group:
                continue
            needs = NEEDS.get(row["needs"], "")
            member = f"`{row['member']}`" if row["member"] else ""
            unit = "" if row["unit"] == "1" else row["unit"]
            lines.append(f"| `{row['column']}` | {unit} | {member} | {row['what']}"
                         + (f"; needs {needs}" if needs else "") + " |")
    return lines[1:]


def of_header(old, members, told):
    """The members with comments: those of figures from the catalogue, the others as they are."""
    comments = {name: re.sub(r"\s*\n\s*\* ", " ", comment) for name, comment in re.findall(
        r"^    (?:double|int|size_t) (\w+); */\* (.*?) \*/", old, re.MULTILINE | re.DOTALL)}
    lines = []
    for kind, name, _ in members:
        words = told.get(name) or comments.get(name, "")
        start = f"    {dict(c_size_t='size_t', c_int='int', c_double='double')[kind]} {name};"
        if not words:
            lines.append(start)
            continue
        start = f"{start:27} /* "
        body = textwrap.wrap(words, WIDTH - len(start) - 3)
        lines.append(start + ("\n" + " " * (len(start) - 2) + "* ").join(body) + " */")
    return lines


def of_f77(rows_text, row, told):
    places = re.search(rf":: {row}_figures\(\d+\) = \[(.*?)\]",
                       re.sub(r"&\s*\n\s*", "", rows_text)).group(1)
    return [f"!> {row.upper()}({i}) {told[name]}"
            for i, name in enumerate(re.findall(r"figure_(\w+)", places), start=1)]


def of_python(rows, structs):
    lines = ['"""Units, meanings and structs of the library, written by columns.py."""', "",
             "from __future__ import annotations", "", "import ctypes",
             "from ctypes import c_double, c_int, c_size_t, c_void_p",
             "from typing import Any, Dict, List, Tuple", "",
             "# Unit, as UDUNITS writes it, what it is, and what must be there for it to be known.",
             "QUANTITIES: Dict[str, Tuple[str, str, str]] = {"]
    found = {row["member"]: row for row in rows if row["member"]}
    lines += [f'    "{name}": ("{row["unit"] or 1}", "{row["what"]}", "{row["needs"]}"),'
              for name, row in found.items()]
    lines += ["}", "", "# As people write units."]
    lines += filled("PLAIN: Dict[str, str] = {", [f'"{unit}": "{plain}"'
                                                  for unit, plain in PLAIN.items()], "}")
    lines += ["", "", "def members(kind: Any, *names: str) -> List[Tuple[str, Any]]:",
              '    """Members of a struct that are of one kind."""',
              "    return [(name, kind) for name in names]"]
    for name, (words, members) in structs.items():
        lines += ["", "", f"class {name}(ctypes.Structure):",
                  f'    """``{words}`` of the header."""', "", "    _fields_ = ["]
        kinds = [f"{kind} * {length}" if length > 1 else kind for kind, _, length in members]
        for kind, own in itertools.groupby(zip(kinds, members), key=lambda pair: pair[0]):
            lines += filled("        *members(",
                            [kind, *(f'"{member}"' for _, (_, member, _) in own)], "),")
        lines.append("    ]")
    return "\n".join(lines) + "\n"


def filled(begin, parts, end):
    """Parts one after the other in lines that are filled, each beginning below the first."""
    lines = [begin]
    for part in (*(f"{part}, " for part in parts[:-1]), parts[-1] + end):
        if len((lines[-1] + part).rstrip()) > WIDTH:
            lines.append(" " * len(begin))
        lines[-1] += part
    return [line.rstrip() for line in lines]


def of_class(rows, names, kinds):
    """Fields of a dataclass: kinds of numbers that are always known, that may not be, of counts."""
    needs = {row["member"]: row for row in rows if row["member"]}
    lines = []
    for name in names:
        row = needs[name]
        kind = kinds[2] if row["holds"] == "count" else \
            kinds[1] if "err" in row["needs"] or row["needs"] == "residuals" else kinds[0]
        lines.append(f"    {name}: {kind}")
    return lines


def between(text, begin, end, lines):
    """The text with lines between two others, which stay."""
    before, rest = text.split(begin, 1)
    _, after = rest.split(end, 1)
    return before + begin + "\n".join(lines) + end + after


def written(program):
    """What each file should hold."""
    rows = rows_of(program)
    read = {name: (ROOT / name).read_text(encoding="utf-8")
            for name in (STRUCTS, WHEELSETS, ROWS, "docs/formats.md", "include/faststrip.h",
                         F77)}
    told = {row["member"]: in_words(row) for row in rows if row["member"]}
    told["limitations"] = ""
    needs = {row["member"]: row["needs"] for row in rows}
    structs = {"Case": ("faststrip_case", members_of(read[STRUCTS], "c_case_t")),
               "Figures": ("faststrip_result", members_of(read[STRUCTS], "c_result_t")),
               "Row": ("faststrip_wheelset_contact", members_of(read[WHEELSETS], "c_contact_t"))}
    page = between(read["docs/formats.md"],
                   "<!-- BEGIN columns, written by tools/generate/columns.py -->\n",
                   "\n<!-- END columns -->", of_page(rows))
    begin, end = "typedef struct faststrip_result {\n", "\n} faststrip_result;"
    old = read["include/faststrip.h"].split(begin)[1].split(end)[0]
    header = between(read["include/faststrip.h"], begin, end,
                     of_header(old, structs["Figures"][1], told))
    f77 = read[F77]
    for row, (begin, end) in PLACES.items():
        f77 = between(f77, begin, end, of_f77(read[ROWS], row, told))
    members = [name for kind, name, _ in structs["Figures"][1]
               if name in told and name not in ("limitations", "est_err_target")]
    # A contact alone has temperatures in a class of their own.
    cold = [one for one in members if needs.get(one) != "temperatures"]
    # Of wheelsets the motion gives the creepages, which have members of their own.
    moved = [one for one in cold if "cksi" not in one and "ceta" not in one]
    plain = "float", "Optional[float]", "int"
    classes = {}
    for name, part, names, kinds in (
            ("_results", "figures", cold, plain),
            ("_many", "figures", [one for one in members if one != "n_elements"],
             ("Array", "Array", "Whole")),
            ("_wheelset", "figures", moved[:moved.index("n_patches")], plain),
            ("_wheelset", "errors", [one for one in moved if one.startswith("est_err")], plain)):
        name = f"python/faststrip/{name}.py"
        text = classes.get(name) or (ROOT / name).read_text(encoding="utf-8")
        classes[name] = between(text, f"    # BEGIN {part}, written by tools/generate/columns.py\n",
                                f"\n    # END {part}\n",
                                of_class(rows, names, kinds))
    return {**classes, "docs/formats.md": page, "include/faststrip.h": header, F77: f77,
            "python/faststrip/_catalogue.py": of_python(rows, structs)}


def main(words):
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("program")
    parser.add_argument("--check", action="store_true", help="write nothing")
    given = parser.parse_args(words)
    stale = []
    for name, text in written(given.program).items():
        path = ROOT / name
        if path.exists() and path.read_text(encoding="utf-8") == text:
            continue
        stale.append(name)
        if not given.check:
            path.write_text(text, encoding="utf-8")
    if given.check and stale:
        print("not as `faststrip columns` has it, run tools/generate/columns.py:",
              ", ".join(stale))
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
