"""How Sphinx makes the site of the pages that tools/docs/document.py has gathered beside this."""

from docutils.nodes import SkipNode
from latex2mathml.converter import convert
from pygments.lexers.fortran import FortranFixedLexer
from pygments.lexers.special import TextLexer

project = "faststrip"
author = copyright = "the faststrip developers"
extensions = ["myst_parser"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 6
html_theme = "furo"
html_static_path, html_css_files = ["site.css"], ["site.css"]
html_title = "faststrip"
html_show_sourcelink = html_copy_source = html_use_index = False
html_math_renderer = "mathml"


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
