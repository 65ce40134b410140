"""The pages of the interfaces: C from its header, Python from its docstrings, Fortran 77 from its
sources, and what leads into FORD's pages of Fortran."""

from __future__ import annotations

import ast
import itertools
import pathlib
import re
import sys

from c_header import Item, items

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "python" / "faststrip" / "__init__.py"
UMBRELLA = ROOT / "src" / "faststrip" / "faststrip.f90"
# Pages of an interface: file, title, names. A name of C stands for all that begin so, the longest
# counts; faststrip_ and FASTSTRIP_ are left out.
C = (
    ("status", "Status, messages, version",
     "version message last_message status doubt VERSION TEXT wheelset_last_message"),
    ("case", "Cases and workspaces",
     "case workspace normal tangential target friction places default_case check_case new free"
     " copy"),
    ("solve", "Gaps and solutions", "set_gap gap solve result"),
    ("details", "Strips, elements, derivatives, wear", "get_ wear_law"),
    ("formulas", "Hertz, FASTSIM, Kalker's coefficients", "fastsim hertz kalker"),
    ("profiles", "Profiles", "profile pair_gap roller_gap reading default_reading read_profile "
     "draw_profile INCLINATION_UNSET"),
    ("wheelset", "Wheelsets",
     "wheelset default_wheelset rail_state demand wheels LOCKED_WHEELS MOST_CONTACTS"),
    ("geometry", "Contact geometry and conicity", "contact_functions conicity"),
    ("lookup", "Lookup tables", "lookup wheelset_use_lookup"),
)
# Names of methods, which docstrings speak of.
METHODS = ("``NORMAL`` and ``TANGENTIAL`` have the names of the command line's `methods "
           "<../docs/usage.html#methods>`__.\n")
PYTHON = (
    ("contact", "One contact", "Contact Result Step Strips Elements Stresses StressPeak "
     "Material Friction"),
    ("pair", "A wheel on a rail",
     "contact ContactResult sweep SweepResult creep_map CreepMap"),
    ("many", "Many contacts", "solve_many ManyResult"),
    ("profiles", "Profiles and gaps", "Profile Gap profile_gap draw_profile plot_profiles"),
    ("wheelset", "Wheelsets", "Wheelset RailState WheelsetResult WheelContact"),
    ("geometry", "Contact geometry and conicity",
     "contact_functions ContactFunctions conicity Conicity"),
    ("wear", "Wear and temperatures", "Wear StripWear WearLaw Thermal Flash"),
    ("lookup", "Lookup tables", "Lookup LookedUp WheelLookup WheelContacts"),
    ("formulas", "Hertz, FASTSIM, Kalker's coefficients", "hertz fastsim kalker"),
    ("errors", "Errors, limitations, version",
     "FaststripError ImplausibleWarning LibraryNotFound ProgramNotFound limitation_words "
     "library_version"),
)
ROLES = {"macro": "macro", "enum": "enum", "struct": "struct", "type": "type", "function": "func"}
WORD = re.compile(r"(?P<name>\b(?:faststrip|FASTSTRIP)_\w+)|(?P<code>\*?`?\b[a-zA-Z]\w*_\w+\b`?"
                  r"|\*[a-z]\w*\b|`[^`\n]+`)|(?P<number>(?<![\w.:])1[0-2]\d(?!\w|\.\d))"
                  r"|(?P<special>[*`|\\_])")


def pages(api):
    """All of them: file and text. FORD's pages are in the folder `api`."""
    return {**c_pages(), **python_pages(), "fortran77.md": fortran_77(),
            "fortran.md": fortran(api)}


def title(words, mark):
    return f"{words}\n{mark * len(words)}\n"


def indented(text, by="   "):
    return "\n".join(by + line if line else "" for line in text.splitlines())


def contents(folder, groups):
    return (".. toctree::\n   :hidden:\n\n"
            + "".join(f"   {folder}/{file}\n" for file, *_ in groups))


class Header:
    """The pages of C."""

    def __init__(self):
        self.head, self.items = items()
        self.roles = {item.name: ROLES[item.kind] for item in self.items}
        status, = (item for item in self.items if item.name == "faststrip_status")
        self.errors = {}
        for item in self.items:
            for part in item.parts if item.kind == "enum" else ():
                self.roles[part.name] = "enumerator"
        for part in status.parts:
            number = part.shown.split(" = ")[1]
            if len(number) == 3:
                self.errors[number] = part.name.removeprefix("FASTSTRIP_").lower()

    def words(self, text):
        """Words of a comment as reStructuredText, with links."""
        def shown(match):
            if match["name"] in self.roles:
                return f":c:{self.roles[match['name']]}:`{match['name']}`"
            if match["number"] in self.errors:
                return self.error(match["number"], match["number"])
            if match["number"]:
                return match[0]
            if match["special"]:
                return "\\" + match[0]
            name = match[0].strip("`")
            return f":c:{self.roles[name]}:`{name}`" if name in self.roles else f"``{name}``"
        return WORD.sub(shown, text)

    def error(self, number, words):
        return f"`{words} <../docs/errors.html#{self.errors[number]}>`__"

    def page_of(self, item):
        """The page of an item: that with the longest beginning of its name."""
        name = re.sub("^(faststrip|FASTSTRIP)_", "", item.name)
        found = [(len(start), file) for file, _, names in C for start in names.split()
                 if name == start or name.startswith(start.rstrip("_") + "_")]
        if not found:
            sys.exit(f"interfaces: {item.name} is on no page of C")
        return max(found)[1]

    def entry(self, item: Item):
        """Text, arguments, those of like words together, and what comes back."""
        role = {"func": "function"}.get(ROLES[item.kind], ROLES[item.kind])
        body = [self.words(item.words)]
        if item.like:
            body = [f"As :c:func:`{item.like}`, where it is described."]
        if item.kind == "enum":
            body += [f".. c:enumerator:: {part.shown}\n\n{indented(self.words(part.words))}"
                     for part in item.parts]
        groups: list[list] = []
        for part in item.parts if item.kind == "struct" else ():
            # What has no words shares those of the one before.
            if part.words or not groups:
                groups.append([])
            groups[-1].append(part)
        for group in groups:
            shown = "\n              ".join(part.shown for part in group)
            body.append(f".. c:member:: {shown}\n\n{indented(self.words(group[0].words))}")
        if item.kind == "function":
            rows = []
            for words, same in itertools.groupby(item.arguments, key=lambda one: one[1]):
                names = ", ".join(f"``{name}``" for name, _ in same)
                rows.append(f"   - {names}: {self.words(words)}\n")
            body.append(":arguments:\n" + "".join(rows) + self.returned(item))
        return f".. c:{role}:: {item.shown}\n\n" + indented("\n\n".join(filter(None, body)))

    def returned(self, item):
        named = [number for number in self.errors if re.search(rf"(?<![\w.:]){number}(?!\w|\.\d)|"
                 rf"FASTSTRIP_{self.errors[number].upper()}\b", item.words)]
        told = ", ".join(self.error(number, self.errors[number]) for number in named)
        return ":returns: a :c:enum:`faststrip_status`" + (f"; errors named here: {told}" if told
                                                           else "")


def first_sentence(text):
    return re.split(r"(?<=\.)\s|:\s|;\s", " ".join(text.split()), maxsplit=1)[0].rstrip(".:;")


def c_pages():
    header = Header()
    head = header.head.removeprefix("faststrip: ")
    texts = {}
    lists = []
    for file, words, _ in C:
        own = [item for item in header.items if header.page_of(item) == file]
        texts[f"c/{file}.rst"] = "\n".join([title(words, "="), *(header.entry(item) + "\n"
                                                                for item in own)])
        lists.append(title(f":doc:`{words} <c/{file}>`", "-") + "\n" + "".join(
            f"- :c:{ROLES[item.kind]}:`{item.name}` "
            f"{header.words(first_sentence(item.words))}\n" for item in own))
    intro = header.words(head[0].upper() + head[1:]).replace("../docs/", "docs/")
    texts["c.rst"] = "\n".join([title("C interface", "="), "``#include <faststrip.h>``.\n", intro,
                                "", *lists, contents("c", C)])
    return texts


def python_names():
    """`__all__`, read and not imported."""
    tree = ast.parse(PACKAGE.read_text(encoding="utf-8"))
    value, = (node.value for node in tree.body if isinstance(node, ast.Assign)
              and node.targets[0].id == "__all__")
    return ast.literal_eval(value)


def python_pages():
    grouped = [name for *_, names in PYTHON for name in names.split()]
    missing = set(python_names()) ^ set(grouped)
    if missing:
        sys.exit(f"interfaces: Python's {', '.join(sorted(missing))}: not once on a page")
    texts, lists = {}, []
    for file, words, names in PYTHON:
        entries = [METHODS] if file in ("contact", "many") else []
        for name in names.split():
            if name[0].islower():
                entries.append(f".. autofunction:: faststrip.{name}\n")
            elif name.endswith(("Error", "Warning", "NotFound")):
                entries.append(f".. autoexception:: faststrip.{name}\n")
            else:
                entries.append(f".. autoclass:: faststrip.{name}\n   :members:\n"
                               "   :inherited-members: object\n   :special-members: __call__\n")
        texts[f"python/{file}.rst"] = "\n".join([title(words, "="), *entries])
        lists.append(title(f":doc:`{words} <python/{file}>`", "-") + "\n.. autosummary::\n"
                     "   :nosignatures:\n\n" + "".join(f"   {name}\n"
                                                       for name in names.split()))
    texts["python.rst"] = "\n".join([
        title("Python interface", "="), ".. automodule:: faststrip\n   :no-members:\n", *lists,
        contents("python", PYTHON)])
    return texts


def fortran_77():
    """The calls and the places of their arrays, of each module."""
    sys.path.append(str(ROOT / "tools" / "generate"))
    from f77_arguments import FACE, Constants, call_rows, place_rows

    constants = Constants()
    lines = ["# Fortran 77 interface", "", "Calls, with what each takes and gives, and the places "
             "of their arrays. [Embedding](docs/embedding.md#fixed-form-fortran) tells how to use "
             "them.", ""]
    for name, about in FACE.items():
        rows = list(call_rows(constants, [name]))
        places = list(place_rows([name]))
        lines += [f"## {about[0].upper()}{about[1:]}", ""]
        for row in rows:
            call, takes, gives = row[2:-2].split(" | ")
            lines += [f"### {call.strip('`').split('(')[0]}", "", f"`CALL {call.strip('`')}`", ""]
            lines += [f"- {word} {told}" for word, told in (("takes", takes), ("gives", gives))
                      if told]
            lines.append("")
        if places:
            lines += ["| place | what |", "|---|---|"]
            lines += [f"| {row.split(' | ', 1)[1]}" for row in places] + [""]
    return "\n".join(lines)


def fortran(api):
    """A page that leads into FORD's: what `use faststrip` gives, in its groups, and all modules."""
    found = {}
    for kind in ("module", "type", "proc", "interface"):
        for path in sorted((api / kind).glob("*.html")):
            text = path.read_text(encoding="utf-8")
            name = re.search(r"<title>\s*(\S+)", text)[1]
            summary = re.search(r"id='text'>.*?<p>(.*?)</p>", text, re.DOTALL)
            words = " ".join(re.sub(r"<[^>]+>", " ", summary[1]).split()) if summary else ""
            address = path.relative_to(api.parent).as_posix()
            found.setdefault((kind == "module", name.lower()), f'<a href="{address}">{name}</a> '
                             f"{words}")
    lines = ["# Fortran interface", "", '<a href="api/index.html">All of it</a>: modules, their '
             "types and procedures, made from the sources. What a host needs comes by "
             "`use faststrip`; all else by its module.", ""]
    body = UMBRELLA.read_text(encoding="utf-8").split("\nmodule faststrip\n")[1]
    body = re.sub(r" *&\n *|\n +! (?:BEGIN|END) .*", " ", body)
    for heading, used in re.findall(r"    ! (\w.*?)\.\n((?:    use .*\n)+)", body):
        lines += [f"## {heading}", ""]
        for module, names in re.findall(r"use (\w+), only: (.*)", used):
            constants = []
            for name in re.split(r"\s*,\s*", names.strip()):
                if (False, name) in found:
                    lines.append(f"- {found[False, name]}")
                else:
                    constants.append(f'<a href="api/module/{module}.html#variable-{name}">{name}'
                                     "</a>")
            if constants:
                kind = "constant" if len(constants) == 1 else "constants"
                lines.append(f"- {', '.join(constants)}: {kind}")
        lines.append("")
    for heading, wanted in (("Modules", True), ("All types and procedures", False)):
        lines += [f"## {heading}", ""]
        lines += [f"- {words}" for (is_module, _), words in found.items() if is_module is wanted]
        lines.append("")
    return "\n".join([*lines, ""])
