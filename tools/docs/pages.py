"""Markdown pages: their headings, links, formulas and pictures as GitHub sees them.

Formulas are LaTeX between dollar signs, `$x$` in a line and `$$` on lines of their own around a
block. A picture is a comment, `<!-- picture: FILE Words. -->`: the site shows it, where commands of
the page have made it.
"""

from __future__ import annotations

import re
from pathlib import Path

FENCE = re.compile(r"^(?P<mark>```+|~~~+).*?^(?P=mark)[ \t]*$", re.MULTILINE | re.DOTALL)
PICTURE = re.compile(r"^<!-- picture: (?P<file>\S+)\s+(?P<words>.*?) -->[ \t]*$",
                     re.MULTILINE | re.DOTALL)
FILE = re.compile(r"^<!-- file: (?P<name>\S+) -->[ \t]*$", re.MULTILINE)
COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
CODE = re.compile(r"(?P<ticks>`+)(?!`).*?(?<!`)(?P=ticks)(?!`)", re.DOTALL)
BLOCK = re.compile(r"^\$\$[ \t]*\n(?P<formula>.*?)\n\$\$[ \t]*$", re.MULTILINE | re.DOTALL)
INLINE = re.compile(r"(?<![\\$\w])\$(?P<formula>[^\s$](?:[^$\n]*[^\s$])?)\$(?![\w$])")
HEADING = re.compile(r"^(#{1,6})[ \t]+(.*?)[ \t]*#*$", re.MULTILINE)
LINK = re.compile(r"!?\[(?:[^\]\[]|\[[^\]]*\])*\]\((?P<target>[^()\s]+)\)")


# LaTeX that both GitHub and latex2mathml show. latex2mathml leaves others out without a word.
COMMANDS = frozenset(
    "Delta Rightarrow alpha bar beta delta ell eta frac gamma ge int kappa lambda le left ln log"
    " lvert mathrm mu ne nu omega operatorname overline partial pi psi qquad rho right rvert sigma"
    " sin sinh cos sqrt sum tau theta varphi xi zeta".split())


def prose(text):
    """A page without code and comments, which hold neither headings nor links nor formulas."""
    return CODE.sub("", COMMENT.sub("", FENCE.sub("", text)))


def slug(heading):
    """The anchor of a heading, as GitHub makes it."""
    words = re.sub(r"\]\([^)]*\)|[`*\[\]$]", "", heading).strip().lower()
    return re.sub(r"[^\w\- ]", "", words).replace(" ", "-")


def anchors(text):
    """The anchors of a page's headings, in their order; the second of a name gets `-1`."""
    found, count = [], {}
    for match in HEADING.finditer(COMMENT.sub("", FENCE.sub("", text))):
        name = slug(match[2])
        found.append(f"{name}-{count[name]}" if name in count else name)
        count[name] = count.get(name, 0) + 1
    return found


def links(text):
    """The targets of a page's links and pictures."""
    return [match["target"] for match in LINK.finditer(prose(text))]


def pictures(text):
    """The files and words of a page's pictures that its commands make."""
    return [(match["file"], " ".join(match["words"].split()))
            for match in PICTURE.finditer(FENCE.sub("", text))]


def formulas(text):
    """The formulas of a page: LaTeX, and whether it stands in a block."""
    words = prose(text)
    found = [(match["formula"], True) for match in BLOCK.finditer(words)]
    return found + [(match["formula"], False) for match in INLINE.finditer(BLOCK.sub("", words))]


def broken_links(path, root):
    """Links of a page whose file or anchor does not exist, in words."""
    path = Path(path)
    text = path.read_text(encoding="utf-8")
    found = []
    for target in links(text):
        if re.match(r"[a-z]+:", target):
            continue
        name, _, anchor = target.partition("#")
        file = (path.parent / name).resolve() if name else path.resolve()
        if not file.exists() or not file.is_relative_to(Path(root).resolve()):
            found.append(f"{path.name}: no such file: {target}")
        elif anchor and (file.suffix != ".md"
                         or anchor not in anchors(file.read_text(encoding="utf-8"))):
            found.append(f"{path.name}: no such anchor: {target}")
    return found


def strange_formulas(text):
    """Formulas of a page that the site cannot show, or that are no formulas."""
    found = []
    for formula, _ in formulas(text):
        commands = set(re.findall(r"\\([A-Za-z]+)", formula))
        braces = re.sub(r"\\[{}]", "", formula)
        if (commands - COMMANDS or "&" in formula or "\\\\" in formula or "|" in formula
                or braces.count("{") != braces.count("}")
                or formula.count("\\left") != formula.count("\\right")):
            found.append(formula)
    return found
