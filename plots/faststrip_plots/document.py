"""A text with tables and pictures, written as Markdown and as one self-contained HTML file."""

from __future__ import annotations

import base64
import html
import os
from dataclasses import dataclass, field

from .tables import InputError

_STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; color: #1c1c1c; max-width: 68rem;
       margin: 2rem auto; padding: 0 1.2rem; }
h1 { font-size: 1.9rem; } h2 { margin-top: 3rem; border-bottom: 1px solid #ccc; }
table { border-collapse: collapse; font-size: .86rem; margin: 1rem 0; display: block;
        overflow-x: auto; }
th, td { padding: .25rem .7rem; border-bottom: 1px solid #e2e2e2; text-align: right;
         white-space: nowrap; }
th:first-child, td:first-child { text-align: left; }
th { border-bottom: 2px solid #888; }
td.wrap { white-space: normal; text-align: left; min-width: 16rem; }
tr.bad td { background: #fdeaea; font-weight: bold; }
figure { margin: 1.6rem 0; } figure img { max-width: 100%; border: 1px solid #e2e2e2; }
figcaption { font-size: .9rem; color: #444; }
nav a { margin-right: 1.2rem; }
"""


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
                parts.append(_markdown_table(rest[0], rest[1]))
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
            f"<title>{html.escape(self.title)}</title><style>{_STYLE}</style></head><body>",
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


def _anchor(text):
    return "".join(c if c.isalnum() else "-" for c in text.lower())


def _markdown_table(header, rows):
    cells = [[cell.replace("|", "\\|") for cell in row] for row in [header, *rows]]
    widths = [max(len(row[k]) for row in cells) for k in range(len(header))]

    def form(row):
        rest = [cell.rjust(width) for cell, width in zip(row[1:], widths[1:])]
        return "| " + " | ".join([row[0].ljust(widths[0])] + rest) + " |"

    rule = "|" + "|".join(
        "-" * (width + 2) if k == 0 else "-" * (width + 1) + ":" for k, width in enumerate(widths)
    ) + "|"
    return "\n".join([form(cells[0]), rule] + [form(row) for row in cells[1:]])


def _html_table(header, rows, bad):
    lines = ["<table><tr>" + "".join(f"<th>{html.escape(c)}</th>" for c in header) + "</tr>"]
    for number, row in enumerate(rows):
        mark = ' class="bad"' if number in bad else ""
        cells = "".join(
            f'<td{" class=wrap" if len(cell) > 48 else ""}>{html.escape(cell)}</td>'
            for cell in row
        )
        lines.append(f"<tr{mark}>{cells}</tr>")
    return "\n".join(lines + ["</table>"])


def _encoded(path):
    try:
        with open(path, "rb") as stream:
            return base64.b64encode(stream.read()).decode("ascii")
    except OSError as error:
        raise InputError(f"cannot read: {path} ({os.strerror(error.errno)})") from None
