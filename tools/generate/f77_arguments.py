#!/usr/bin/env python3
"""Write the arguments of the F77 interface into docs/embedding.md, from its sources.

    f77_arguments.py [--check]

Two tables stand between `<!-- f77: arguments -->` and `<!-- end -->`: the calls, with what each
takes and gives, and what the places of the arrays are. Names and their order are those of the lines
`!> CALL NAME(...)`, sizes and words those of the declarations, places those of the blocks at the
head of each module. With --check nothing is written; exit 1 if the page is another one.
"""

import argparse
import ast
import operator
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "embedding.md"
# The modules of the interface, and what their arrays are about.
FACE = {"f77": "contacts", "f77_doubts": "doubts", "f77_wheelset": "wheelsets",
        "f77_wear": "friction, wear", "f77_heat": "temperatures", "f77_derivatives": "derivatives",
        "f77_given_forces": "forces given",
        "f77_stress": "stresses", "f77_wheelset_memory": "memory of a wheelset",
        "f77_geometry": "geometry", "f77_lookup": "tables",
        "f77_lookup_wheel": "tables of a wheel"}
MARKS = re.compile(r"(?s)(<!-- f77: arguments -->\n).*?(<!-- end -->)")
CALL = re.compile(r"!> CALL (\w+)\((.*?)\)$", re.MULTILINE)
DECLARED = re.compile(r"(?m)^ +(?:real|integer|character)\(([^)]*)\), *(?:intent\((\w+)\))?[^:]*:: "
                      r"*(.*?) *!! *(.*)$")
ITEM = re.compile(r"(\w+)(?:\(([^)]*)\))?")
# A place, a range of places, or a whole argument, with what follows of the line.
PLACE = re.compile(r"([A-Z]\w*(?:\([^)]*\))?(?:(?:,| to| and) [A-Z]\w*(?:\([^)]*\))?)*) +(.+)")
OPERATORS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul}


class Constants:
    """Whole numbers that modules of the library name, as a module sees them."""

    def __init__(self):
        self.values, self.used = {}, {}
        for path in (ROOT / "src" / "faststrip").rglob("*.f90"):
            text = re.sub(r" *&\n *", " ", path.read_text(encoding="utf-8"))
            module = re.search(r"(?m)^module (\w+)", text)
            if not module:
                continue
            values, used = self.values.setdefault(module[1], {}), {}
            for line in re.findall(r"(?m)^    integer, parameter[^:]*:: (.*)$", text):
                values |= dict(re.findall(r"(\w+) = ([\w +*-]+)", line))
            for name, only in re.findall(r"(?m)^    use (\w+), only: (.*)$", text):
                for item in only.split(","):
                    seen, _, own = item.strip().partition(" => ")
                    used[seen] = (name, own or seen)
            self.used[module[1]] = used

    def number(self, module, text):
        """The value of an expression of names and numbers, or None."""
        def value(node):
            if isinstance(node, ast.Constant):
                return node.value
            if isinstance(node, ast.BinOp):
                return OPERATORS[type(node.op)](value(node.left), value(node.right))
            if node.id in self.values[module]:
                return self.number(module, self.values[module][node.id])
            where, name = self.used[module][node.id]
            return self.number(where, name)

        try:
            return value(ast.parse(text.strip(), mode="eval").body)
        except (KeyError, AttributeError, SyntaxError, TypeError):
            return None


def source(name):
    """The file of a module of the interface."""
    return ROOT / "src/faststrip/interop/f77" / f"{name.removeprefix('f77_')}.f90"


def calls(name, constants):
    """Name, words and arguments of the subroutines of a module of the interface; an argument is its
    F77 name with its size, in, out or inout, and what it is."""
    text = source(name).read_text(encoding="utf-8")
    for match in CALL.finditer(text):
        shown = match[2].split(", ")
        rest = text[match.end():]
        body = re.sub(r" *&\n *|\n +(?=!!)", " ", rest[:rest.index("end subroutine")])
        dummies = re.search(r"subroutine \w+\((.*?)\)", body)[1].split(", ")
        names = dict(zip(dummies, shown, strict=False))
        arguments = []
        for kind, intent, items, words in DECLARED.findall(body):
            found = []
            for item, shape in ITEM.findall(items):
                if item in names:
                    sizes = [str(size) for size in (
                        names.get(one) or constants.number(f"faststrip_interop_{name}", one) or one
                        for one in filter(None, shape.split(", ")))]
                    found.append(names[item] + (f"({', '.join(sizes)})" if sizes else ""))
            if found:
                arguments.append((found, kind, intent, words))
        yield match[1], f"{match[1]}({match[2]})", arguments


def call_rows(constants, names=FACE):
    for name in names:
        for _name, shown, arguments in calls(name, constants):
            cells = {"in": [], "out": []}
            for names, _, intent, words in arguments:
                if names == ["INFO"] and intent == "out" or \
                        names[0].startswith("IWORK(") and intent == "in":
                    continue
                told = ", ".join(f"`{one}`" for one in names)
                words = re.sub("^as above(, |; )?", "", words)
                if words not in ("", told):
                    told += f" {words}"
                cells["in" if intent == "in" else "out"].append(told)
            yield f"| `{shown}` | {'; '.join(cells['in'])} | {'; '.join(cells['out'])} |"


def place_rows(names=FACE):
    for name in names:
        head = source(name).read_text(encoding="utf-8").split("\nmodule ")[0]
        found = []
        for block in re.findall(r"(?s)!> ```\n(.*?)!> ```", head):
            for line in block.splitlines():
                line = line.removeprefix("!>").removeprefix(" ")
                for part in filter(str.strip, re.split(r" {2,}(?=[A-Z]{2,}\w*[( ])", line)):
                    match = PLACE.fullmatch(part)
                    if match and not part.startswith(" "):
                        found.append([match[1], match[2].strip()])
                    else:
                        found[-1][1] += f" {part.strip()}"
        for place, words in found:
            yield f"| {FACE[name]} | `{place}` | {words} |"


def tables():
    return "\n".join([
        "", "| call | takes | gives |", "|---|---|---|", *call_rows(Constants()), "",
        "| of | place | what |", "|---|---|---|", *place_rows(), "", ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    old = PAGE.read_text(encoding="utf-8")
    new, count = MARKS.subn(lambda marks: marks[1] + tables() + marks[2], old)
    if count != 1:
        sys.exit(f"{PAGE.name} has no place for the arguments of F77")
    if options.check:
        if new != old:
            sys.exit(f"{PAGE.name} is not what tools/generate/f77_arguments.py writes")
    elif new != old:
        PAGE.write_text(new, encoding="utf-8")


if __name__ == "__main__":
    main()
