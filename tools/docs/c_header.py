"""What include/faststrip.h declares, with the words that it has for each.

Words of arguments stand beside those of the functions in Fortran.
"""

from __future__ import annotations

import pathlib
import re
from dataclasses import dataclass, field

ROOT = pathlib.Path(__file__).resolve().parents[2]
HEADER = ROOT / "include" / "faststrip.h"
FORTRAN = (*ROOT.glob("src/faststrip/interop/c/*.f90"), ROOT / "src/files/profile/c.f90")
COMMENT = r"/\*(?:(?!\*/).)*\*/"
ITEM = re.compile(
    rf"(?P<comment>{COMMENT})"
    r"|^#define (?P<macro>FASTSTRIP_\w+) (?P<value>\S+)"
    r"|^enum (?P<enum>\w+) \{(?P<constants>.*?)\};"
    r"|^typedef struct (?P<struct>\w+) \{(?P<members>.*?)\} \w+;"
    r"|^typedef struct (?P<type>\w+) \w+;"
    r"|^(?P<result>int) (?P<function>\w+)\((?P<arguments>.*?)\);", re.MULTILINE | re.DOTALL)
MEMBER = re.compile(r"(?P<shown>\w[\w ]*?[ *]+(?P<name>\w+)(?:\[\d+\])*);[ ]*"
                    rf"(?P<words>{COMMENT})?", re.DOTALL)
CONSTANT = re.compile(rf"(?P<shown>(?P<name>\w+) = \d+),?[ ]*(?P<words>{COMMENT})?", re.DOTALL)
FUNCTION = re.compile(r"function (faststrip_\w+)\((.*?)\)(.*?)end function \1", re.DOTALL)
ARGUMENT = re.compile(r"^ +(?:type|integer|real)\(\w+\), value :: ([\w, ]+?) *!! (.*)$",
                      re.MULTILINE)


@dataclass(frozen=True)
class Part:
    """A member of a struct, or a constant of an enumeration."""

    shown: str
    name: str
    words: str


@dataclass(frozen=True)
class Item:
    """A macro, enum, struct, type or function: as the page shows it, and its words; an argument of
    a function is its name in C, with its words. A function that shares the words of the one before
    has that one's name in `like`."""

    kind: str
    name: str
    shown: str
    words: str
    parts: list[Part] = field(default_factory=list)
    arguments: list[tuple[str, str]] = field(default_factory=list)
    like: str = ""


def plain(comment):
    """The words of a comment, paragraphs with an empty line between."""
    lines = [re.sub(r"^\s*\*? ?", "", line) for line in comment[2:-2].strip().splitlines()]
    return "\n".join(line.rstrip() for line in lines)


def parts_of(pattern, text):
    return [Part(" ".join(match["shown"].split()), match["name"], plain(match["words"] or "/**/"))
            for match in pattern.finditer(text)]


def words_of_arguments():
    """Of each function the words of its arguments, in their order."""
    found = {}
    for path in FORTRAN:
        text = re.sub(r" *&\n *", " ", path.read_text(encoding="utf-8"))
        for name, dummies, body in FUNCTION.findall(re.sub(r"\n +!! ", " !! ", text)):
            words = {one: told.replace(" !! ", " ") for names, told in ARGUMENT.findall(body)
                     for one in names.split(", ")}
            found[name] = [words[one] for one in re.split(r"\s*,\s*", dummies)]
    return found


def items():
    """The words at the head of the header, and its items in their order."""
    text = HEADER.read_text(encoding="utf-8")
    told = words_of_arguments()
    found, comment, end = [], "", 0
    for match in ITEM.finditer(text):
        between = text[end:match.start()]
        # What stands by itself says nothing of what follows.
        if "\n\n" in between:
            comment = ""
        end = match.end()
        if match["comment"]:
            comment = "" if "BEGIN" in match["comment"] else plain(match["comment"])
            continue
        kind = next(one for one in ("macro", "enum", "struct", "type", "function") if match[one])
        name = match[kind]
        shown = " ".join(match[0].split()).removesuffix(";") if kind == "function" else name
        parts, arguments, like = [], [], ""
        if kind == "enum":
            parts = parts_of(CONSTANT, match["constants"])
        elif kind == "struct":
            parts = parts_of(MEMBER, match["members"])
        elif kind == "function":
            names = [one.split("[")[0].split()[-1].lstrip("*")
                     for one in match["arguments"].split(",")]
            arguments = list(zip(names, told[name], strict=True))
            if not comment and between == "\n" and found[-1].kind == kind:
                like = found[-1].like or found[-1].name
        found.append(Item(kind, name, shown, comment, parts, arguments, like))
        comment = ""
    return plain(re.search(COMMENT, text, re.DOTALL)[0]), found
