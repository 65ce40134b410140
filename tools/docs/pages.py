"""Markdown pages: their headings and links as GitHub sees them, and as HTML for the site.

Formulas are LaTeX between dollar signs, `$x$` in a line and `$$` on lines of their own around a
block. The site holds them as MathML, which browsers show without any script. A picture is a
comment, `<!-- picture: FILE Words. -->`: the site shows it, where commands of the page have made
it.
"""

from __future__ import annotations

import html
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
    " sin sinh cos sqrt sum tau theta varphi xi".split())


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


def to_html(text, target_of):
    """The body of a page; `target_of` says where a link leads in the site, or a picture lies."""
    import markdown  # of tools/requirements-docs.txt, which the tests do without
    from latex2mathml.converter import convert

    names = anchors(text)
    kept = []

    def keep(words):
        kept.append(words)
        return f"@KEPT{len(kept) - 1}@"

    strange = strange_formulas(text)
    if strange:
        raise ValueError(f"a formula that cannot be shown: {strange[0]}")

    def formula(match, display):
        return keep(convert(match["formula"].strip(), display=display))

    def figure(match):
        words = html.escape(" ".join(match["words"].split()))
        return "\n" + keep(f'<figure><img src="{target_of(match["file"])}" alt="{words}">\n'
                           f"<figcaption>{words}</figcaption></figure>") + "\n"

    text = FENCE.sub(lambda match: "\n" + keep(match[0]) + "\n", text)
    text = FILE.sub(lambda match: keep(f'<p class="file">{match["name"]}</p>') + "\n",
                    PICTURE.sub(figure, text))
    text = COMMENT.sub("", text)
    text = CODE.sub(lambda match: keep(match[0]), text)
    text = BLOCK.sub(lambda match: formula(match, "block"), text)
    text = INLINE.sub(lambda match: formula(match, "inline"), text)
    text = LINK.sub(lambda match: match[0].replace(f"({match['target']})",
                                                   f"({target_of(match['target'])})"), text)

    def put_back(words, only_code):
        def own(match):
            content = kept[int(match[1])]
            return match[0] if only_code and content.startswith("<math") else content
        return re.sub(r"@KEPT(\d+)@", own, words)

    text = put_back(text, only_code=True)
    body = markdown.markdown(text, extensions=["tables", "fenced_code", "sane_lists"])
    names = iter(names)
    body = re.sub(r"<h([1-6])>", lambda match: f'<h{match[1]} id="{next(names)}">', body)
    # On a screen a wide table has a box to scroll in.
    body = re.sub(r"<table>.*?</table>", r'<div class="table" tabindex="0">\g<0></div>', body,
                  flags=re.DOTALL)
    return put_back(body, only_code=False)


def sections(body):
    """The sections of a page's body: anchor, level, heading and words, without formulas."""
    parts = re.split(r'<h([1-6]) id="([^"]+)">(.*?)</h\1>', body, flags=re.DOTALL)
    return [(anchor, int(level), plain(heading), plain(text))
            for level, anchor, heading, text in zip(*(parts[k::4] for k in range(1, 5)))]


def plain(body):
    """The words of HTML."""
    words = re.sub(r"<math.*?</math>|<[^>]+>", " ", body, flags=re.DOTALL)
    return " ".join(html.unescape(words).split())


def page(title, body, navigation):
    """A whole HTML page; `navigation` is what `menu` makes."""
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{html.escape(title)}</title>
<link rel="stylesheet" href="pages.css">
<script src="lunr.js" defer></script>
<script src="search_data.js" defer></script>
<script src="search.js" defer></script>
</head>
<body>
<a class="skip" href="#content">To the text</a>
<nav aria-label="pages">
<input type="checkbox" id="unfold" aria-label="show all pages"><label for="unfold">Pages</label>
<search><input type="search" id="search" placeholder="Search" aria-label="search all pages"
autocomplete="off"><ol id="found" aria-live="polite"></ol></search>
{navigation}
</nav>
<main id="content">
{body}
</main>
</body>
</html>
"""


def menu(groups, here, headings):
    """The navigation: groups of words and targets, beneath the page `here` its own headings."""
    lines = ['<div class="menu">']
    for name, entries in groups:
        lines.append(f"<h2>{html.escape(name)}</h2>\n<ul>")
        for words, target in entries:
            current = ' aria-current="page"' if target == here else ""
            lines.append(f'<li><a href="{target}"{current}>{html.escape(words)}</a>')
            if current and headings:
                lines += ["<ul>", *(f'<li><a href="#{anchor}">{html.escape(heading)}</a></li>'
                                    for anchor, heading in headings), "</ul>"]
            lines.append("</li>")
        lines.append("</ul>")
    return "\n".join([*lines, "</div>"])
