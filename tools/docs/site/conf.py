"""How Sphinx makes the site of the pages that tools/docs/document.py has gathered beside this."""

import dataclasses
import re
from unittest import mock

from docutils.nodes import SkipNode
from latex2mathml.converter import convert
from pygments.lexers.fortran import FortranFixedLexer
from pygments.lexers.special import TextLexer
from sphinx.addnodes import pending_xref

project = "faststrip"
author = copyright = "the faststrip developers"
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.autosummary", "sphinx.ext.napoleon"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 6
autosummary_generate = False
autodoc_member_order, autodoc_typehints = "bysource", "none"
default_role = "py:obj"
maximum_signature_line_length = 80
toc_object_entries_show_parents = "hide"
html_theme = "furo"
html_static_path, html_css_files = ["site.css", "search.js"], ["site.css"]
html_title = "faststrip"
html_show_sourcelink = html_copy_source = html_use_index = False
html_math_renderer = "mathml"

# Docstrings are read, nothing is called: no library needs to be there.
with mock.patch("ctypes.CDLL"):
    import faststrip

assert faststrip.__all__


def one_by_one(app, what, name, obj, options, lines):
    """Attributes that share their words, each with them: `a, b : float`. What a dataclass is made
    of are its attributes."""
    text = "\n".join(lines)
    if dataclasses.is_dataclass(obj) and "Attributes\n" not in text:
        text = text.replace("Parameters\n", "Attributes\n")
    head, mark, rest = text.partition("Attributes\n----------\n")
    rest = re.sub(r"(?m)^(\w+(?:, \w+)+)( : .*\n(?: .*\n)+)",
                  lambda row: "".join(one + row[2] for one in row[1].split(", ")), rest + "\n")
    lines[:] = (head + mark + rest).split("\n")


def no_signature(app, what, name, obj, *_):
    """Results are not made by users: their attributes say what they hold."""
    words = obj.__doc__ or ""
    is_result = what == "class" and "Attributes\n" in words and "Parameters\n" not in words
    return ("", None) if is_result else None


def types_alone(app, doctree):
    """Words of a type that are no classes of the package, as `shape`, are no links."""
    for link in list(doctree.findall(pending_xref)):
        if link.get("reftype") == "class" and link["reftarget"] not in faststrip.__all__:
            link.replace_self(link.children)


def search_scripts(app, page, template, context, doctree):
    if page == "search":
        for name in ("words.js", "search.js"):
            app.add_js_file(name, loading_method="defer")


def setup(app):
    """Formulas as MathML, which browsers show without any script; names of blocks of code."""
    def show(display):
        def visit(writer, node):
            writer.body.append(convert(node.astext().strip(), display=display))
            raise SkipNode
        return visit, None

    app.add_html_math_renderer("mathml", show("inline"), show("block"))
    for name in ("output", "csv"):
        app.add_lexer(name, TextLexer)
    app.add_lexer("f77", FortranFixedLexer)
    app.connect("autodoc-process-docstring", one_by_one, priority=400)
    app.connect("autodoc-process-signature", no_signature)
    app.connect("doctree-read", types_alone)
    app.connect("html-page-context", search_scripts)
