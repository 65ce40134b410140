"""A text with tables and pictures, written as Markdown and as one self-contained HTML file."""

from __future__ import annotations

import base64
import csv
import html
import io
import os
import re
from dataclasses import dataclass, field
from pathlib import Path

from .tables import InputError

LONG = 48  # letters: a longer cell is a text of its own
SHORT = 12  # letters: a shorter one is never broken
NUMBER = 24  # letters: with more a number has a text behind it
ANNOUNCED = ("file", "title", "caption", "chapter")
MANY = 12  # columns: more are printed small

# Also the style of the site: tools/docs/document.py.
STYLE = Path(__file__).with_name("document.css")


@dataclass
class Document:
    """Blocks in order; `markdown` and `page` render them."""

    title: str
    blocks: list = field(default_factory=list)

    def heading(self, text: str, level: int = 2) -> None:
        self.blocks.append(("heading", level, text))

    def paragraph(self, text: str) -> None:
        self.blocks.append(("paragraph", text))

    def table(self, header, rows, bad=()) -> None:
        """Cells as text; `bad` are the numbers of rows to mark. Long cells may wrap."""
        self.blocks.append(("table", list(header), [list(row) for row in rows], set(bad)))

    def figure(self, path: str, title: str, caption: str = "") -> None:
        """A PNG file, named as seen from where the command runs."""
        self.blocks.append(("figure", path, title, caption))

    def markdown(self, folder: str) -> str:
        """The text as Markdown; pictures are linked as seen from `folder`."""
        parts = [f"# {self.title}"]
        for kind, *rest in self.blocks:
            if kind == "heading":
                parts.append("#" * rest[0] + " " + rest[1])
            elif kind == "paragraph":
                parts.append(rest[0])
            elif kind == "table":
                parts.append(markdown_table(rest[0], rest[1]))
            else:
                path, title, caption = rest
                link = os.path.relpath(path, folder).replace(os.sep, "/")
                parts.append(f"![{title}](<{link}>)\n\n*{title}.* {caption}".rstrip())
        return "\n\n".join(parts) + "\n"

    def page(self) -> str:
        """The text as one HTML file with its pictures inside."""
        parts = [
            '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            f"<title>{html.escape(self.title)}</title><style>\n{STYLE.read_text(encoding='utf-8')}"
            "</style></head><body>",
            f"<h1>{html.escape(self.title)}</h1>",
            "<nav>" + "".join(
                f'<a href="#{_anchor(rest[1])}">{html.escape(rest[1])}</a>'
                for kind, *rest in self.blocks if kind == "heading" and rest[0] == 2
            ) + "</nav>",
        ]
        for kind, *rest in self.blocks:
            if kind == "heading":
                level, text = rest
                parts.append(
                    f'<h{level} id="{_anchor(text)}">{html.escape(text)}</h{level}>'
                )
            elif kind == "paragraph":
                parts.append(f"<p>{html.escape(rest[0])}</p>")
            elif kind == "table":
                parts.append(_html_table(*rest))
            else:
                path, title, caption = rest
                parts.append(
                    f'<figure><img alt="{html.escape(title)}" '
                    f'src="data:image/png;base64,{_encoded(path)}">'
                    f"<figcaption><b>{html.escape(title)}.</b> {html.escape(caption)}"
                    "</figcaption></figure>"
                )
        return "\n".join(parts + ["</body></html>"]) + "\n"


def write_text(path: str, text: str) -> None:
    """Write a whole file or leave the old one."""
    temporary = f"{path}.tmp{os.getpid()}"
    try:
        os.makedirs(os.path.dirname(os.path.abspath(path)), exist_ok=True)
        with open(temporary, "w", encoding="utf-8") as stream:
            stream.write(text)
        os.replace(temporary, path)
    except OSError as error:
        raise InputError(f"cannot write: {path} ({os.strerror(error.errno)})") from None


def write_rows(path: str, header, rows) -> None:
    """Write a whole CSV file or leave the old one."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(header)
    writer.writerows(rows)
    write_text(path, stream.getvalue())


def write_dicts(path: str, rows) -> None:
    """The same of rows that know the names of their cells."""
    write_rows(path, rows[0], [row.values() for row in rows])


def announce(folder: str, name: str, rows) -> None:
    """The list `name` of a folder, of pictures or tables for the report: file, title, caption,
    chapter."""
    write_rows(os.path.join(folder, name), ANNOUNCED, rows)


def _anchor(text):
    return "".join(c if c.isalnum() else "-" for c in text.lower())


def markdown_table(header, rows):
    """A Markdown table whose columns line up as plain text too."""
    cells = [[cell.replace("|", "\\|") for cell in row] for row in [header, *rows]]
    widths = [max(len(row[k]) for row in cells) for k in range(len(header))]

    aligned = [[row[0].ljust(widths[0]), *map(str.rjust, row[1:], widths[1:])] for row in cells]
    first, *others = [f"| {' | '.join(row)} |" for row in aligned]
    rule = "|" + "|".join(["-" * (widths[0] + 2), *("-" * (w + 1) + ":" for w in widths[1:])]) + "|"
    return "\n".join([first, rule, *others])


def _html_table(header, rows, bad):
    """A table that scrolls in its own box on a screen and fits the paper when printed."""
    many = ' class="many"' if len(header) > MANY else ""
    left = [k > 0 and not all(_is_number(row[k]) for row in rows) for k in range(len(header))]
    lines = [f'<div class="table" tabindex="0"><table{many}><thead><tr>' + "".join(
        f"<th{' class=left' if left[k] else ''}>{_breakable(cell)}</th>"
        for k, cell in enumerate(header)) + "</tr></thead><tbody>"]
    for number, row in enumerate(rows):
        mark = ' class="bad"' if number in bad else ""
        cells = "".join(f"<td{_look(cell, left[k])}>{_breakable(cell)}</td>"
                        for k, cell in enumerate(row))
        lines.append(f"<tr{mark}>{cells}</tr>")
    return "\n".join(lines + ["</tbody></table></div>"])


def _is_number(cell):
    """A number, alone or with its unit, or none."""
    return cell in ("", "–") or (len(cell) <= NUMBER
                                 and re.match("[-+>≤≥ ]*[0-9.]", cell) is not None)


def _look(cell, left):
    """Class of a cell: short words and numbers, with their units, stay on one line."""
    if len(cell) > LONG:
        return ' class="wrap"'
    if len(cell) > SHORT and not _is_number(cell):
        return ' class="text"'
    return ' class="left"' if left else ""


def _breakable(text):
    """Names and paths may break after their joints, numbers nowhere."""
    if len(text) <= SHORT or _is_number(text):
        return html.escape(text)
    parts = re.split(r"(?<=[_;=*/])(?=\w)|(?<=\.)(?=[A-Za-z])", text)
    return "<wbr>".join(html.escape(part) for part in parts)


def _encoded(path):
    try:
        with open(path, "rb") as stream:
            return base64.b64encode(stream.read()).decode("ascii")
    except OSError as error:
        raise InputError(f"cannot read: {path} ({os.strerror(error.errno)})") from None
