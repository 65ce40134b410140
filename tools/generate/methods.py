#!/usr/bin/env python3
"""Write what repeats the list of methods, or check that it is up to date.

    methods.py [--check]

The list is that of src/faststrip/contact/methods.f90: one row a method. Written from it, between
lines with `BEGIN methods` and `END methods`, are the numbers there, what `use faststrip` gives, the
lists of example/hosts/tour.f90 and figures.c, the enumerations of the C header, the comment of the
F77 interface, Python's dictionaries and the tables of docs/usage.md. The command line and its help,
and so the man page, read the list itself. With --check nothing is written; the exit code is 1 if
something would be.
"""

import argparse
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIST = "src/faststrip/contact/methods.f90"
WIDTH = 100


class Method:
    """One row of the list."""

    def __init__(self, part, number, name, rest):
        self.part = part
        self.number = int(number)
        self.name = name
        words = dict(re.findall(r"(\w+)='((?:[^']|'')*)'", rest))
        flags = dict(re.findall(r"(\w+)=\.(true|false)\.", rest))
        self.needs = words.get("needs", "").replace("''", "'")
        self.help = words.get("help", "").replace("''", "'")
        self.in_core = flags.get("in_core", "true") == "true"
        self.gives_elements = flags.get("gives_elements", "true") == "true"
        self.gives_stick = flags.get("gives_stick", "true") == "true"

    def constant(self):
        return f"{self.part}_{self.name.replace('-', '_')}"


def read_methods(text):
    """The rows of both tables, each in the order of the list."""
    methods = {}
    joined = re.sub(r"&\s*\n\s*", "", text)
    for part in ("normal", "tangential"):
        table = re.search(rf":: {part}_table\(\*\) = \[(.*)$", joined, re.MULTILINE).group(1)
        rows = re.findall(r"method_t\((\d+), '([^']+)'((?:[^']|'(?:[^']|'')*')*?)\)(?:, ?|\])",
                          table)
        if len(rows) != table.count("method_t("):
            sys.exit(f"methods: a row of {part}_table cannot be read")
        methods[part] = [Method(part, *row) for row in rows]
        for what in ("number", "name"):
            values = [getattr(method, what) for method in methods[part]]
            if len(set(values)) < len(values):
                sys.exit(f"methods: two rows of {part}_table have the same {what}")
    return methods


def in_order(methods, core_only=True):
    """By number."""
    return sorted((m for m in methods if m.in_core or not core_only), key=lambda m: m.number)


def listed(part, core_only=True):
    """The methods of the checkout, by name: of a part, `normal` or `tangential`, as people see
    them."""
    methods = read_methods((ROOT / LIST).read_text(encoding="utf-8"))
    return {m.name: m for m in methods[part] if m.in_core or not core_only}


def wrapped(words, indent, first, end=""):
    """Words in lines; `first` begins the first one, `end` ends all but the last."""
    lines, line = [], first
    for word in words:
        if len(line) + len(word) + 1 + len(end) > WIDTH:
            lines.append(line + end)
            line = indent + word
        else:
            line += (" " if line.strip() else "") + word if line != indent else word
    return [*lines, line]


def numbers(methods):
    """Those of the core, then those outside of it."""
    lines = []
    for part in methods:
        rows = in_order(methods[part], core_only=False)
        words = [f"{m.constant()}," for m in rows if m.in_core]
        lines += wrapped([*words[:-1], words[-1].rstrip(",")], " " * 14, "    public ::", " &")
        for method in sorted(rows, key=lambda m: not m.in_core):
            public = "" if method.in_core else ", public"
            lines += [f"    integer, parameter{public} :: {method.constant()} = {method.number}",
                      f"        !! {told(method)}"]
    return lines


def umbrella(methods):
    names = [m.constant() for part in methods for m in in_order(methods[part], core_only=False)]
    words = [f"{name}," for name in names[:-1]] + [names[-1]]
    return wrapped(words, " " * 41, "    use faststrip_contact_methods, only:", " &")


def tour(methods):
    """The arrays of the example that goes through all methods of the core."""
    lines = []
    for part in methods:
        names = [m.constant() for m in in_order(methods[part])]
        words = [f"{name}," for name in names[:-1]] + [names[-1] + "]"]
        lines += [f"    integer, parameter :: {part}s(*) = [ &",
                  *wrapped(words, " " * 8, " " * 8, " &")]
    return lines


def pairs(methods):
    """Names and constants of the methods of the core, in C."""
    return [f'    {{"{m.name}", FASTSTRIP_{m.constant().upper()}}},'
            for part in methods for m in in_order(methods[part])]


def header(methods):
    lines = []
    for part in methods:
        rows = in_order(methods[part])
        entries = [f"    FASTSTRIP_{m.constant().upper()} = {m.number}" for m in rows]
        entries = [f"{entry}{',' if i < len(rows) - 1 else ''}" for i, entry in enumerate(entries)]
        width = max(map(len, entries))
        lines += ["", f"/* The {part} methods. */", f"enum faststrip_{part} {{"]
        for entry, method in zip(entries, rows):
            lines.append(f"{entry:{width}} /* {told(method)} */")
        lines.append("};")
    return lines[1:]


def told(method):
    """One line of help, with what the method does not give."""
    return method.help + ("" if method.gives_elements else "; no elements")


def comment(methods):
    lines = []
    for i, part in enumerate(methods, start=1):
        words = [f"{m.number} {m.name}" for m in in_order(methods[part])]
        words = [f"{word}," for word in words[:-1]] + [words[-1]]
        lines += wrapped(words, "!>         ", f"!> IOPT({i}) {part} method:")
    return lines


def dictionaries(methods):
    lines = []
    for part in methods:
        rows = in_order(methods[part])
        width = max(len(m.name) for m in rows) + len('"": 99,')
        lines.append(f"{part.upper()} = {{")
        for method in rows:
            entry = f'"{method.name}": {method.number},'
            lines.append(f"    {entry:{width}}  # {told(method)}")
        lines.append("}")
    return lines


def tables(methods):
    lines = []
    for part in methods:
        lines += ["", f"| `--{part}` | | needs |", "|---|---|---|"]
        lines += [f"| `{m.name}` | {told(m)} | {m.needs} |" for m in methods[part]]
    return lines[1:]


# The lines written stand between these, unless the file has marks of its own.
MARKS = r"^.*BEGIN methods.*\n", r"^.*END methods.*\n"
OWN_MARKS = {"src/faststrip/interop/f77/f77.f90": (r"(?=^!> IOPT\(1\))", r"(?=^!> IOPT\(3\))")}
# Where, and what.
TARGETS = {
    LIST: numbers,
    "src/faststrip/faststrip.f90": umbrella,
    "example/hosts/tour.f90": tour,
    "example/hosts/figures.c": pairs,
    "include/faststrip.h": header,
    "src/faststrip/interop/f77/f77.f90": comment,
    "python/faststrip/_contact.py": dictionaries,
    "docs/usage.md": tables,
}


def rewritten(text, lines, path):
    """The text with other lines between the two marks."""
    begin, end = (list(re.finditer(mark, text, re.MULTILINE))
                  for mark in OWN_MARKS.get(path, MARKS))
    if len(begin) != 1 or len(end) != 1 or begin[0].end() > end[0].start():
        sys.exit(f"methods: {path} must have one place for the list: BEGIN methods, END methods")
    for line in lines:
        if len(line) > WIDTH:
            sys.exit(f"methods: too long for {path}, at most {WIDTH} characters: {line.strip()}")
    return text[:begin[0].end()] + "".join(f"{line}\n" for line in lines) + text[end[0].start():]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="write nothing, exit 1 if stale")
    parser.add_argument("--root", type=pathlib.Path, default=ROOT, help=argparse.SUPPRESS)
    options = parser.parse_args()
    methods = read_methods((options.root / LIST).read_text(encoding="utf-8"))
    texts = {}
    for path, lines in TARGETS.items():
        text = (options.root / path).read_text(encoding="utf-8")
        new = rewritten(text, lines(methods), path)
        if new != text:
            texts[path] = new
    if not options.check:
        # All or none: a line that is too long for one of them ends the rest, too.
        for path, text in texts.items():
            (options.root / path).write_text(text, encoding="utf-8")
    elif texts:
        sys.exit("methods: not as the list says, run tools/generate/methods.py: "
                 + ", ".join(texts))


if __name__ == "__main__":
    main()
