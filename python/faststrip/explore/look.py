"""How things look: as in the project's other pictures, told apart also in grey and by the
colour-blind."""

from __future__ import annotations

from typing import Any, Dict, NamedTuple

from .._style import METHOD


class Look(NamedTuple):
    """Name, colour and line of a method."""

    label: str
    colour: str
    dash: str
    width: float

    @property
    def line(self) -> Dict[str, Any]:
        """What Bokeh's ``line`` takes of it."""
        return {"line_color": self.colour, "line_dash": self.dash, "line_width": self.width}


def _look(normal: str, tangential: str, dash: str) -> Look:
    """The look of two methods, with the dash as Bokeh has it."""
    look = METHOD[normal, tangential]
    return Look(look.label, look.colour, dash, look.width)


STRIPS = _look("strip", "faststrip", "solid")
HERTZ = _look("hertz", "fastsim", "dashed")
NORM = _look("norm", "tang", "dotted")
RIGHT = STRIPS  # wheel
LEFT = Look("left", "#a0306a", "dashed", 1.8)
LOOKS = {"strips": STRIPS, "hertz": HERTZ, "norm": NORM}

GRID = "#e3e3e3"
AXIS = "#444444"
SLIP = "#ffffff"  # elements that slide
BODY = "#ececec"  # the body of the rail
TEXT, BAD = "#222222", "#a0306a"  # of what is said
SMALL = "11px"
FONT = "12px"

# The frame of the page. Dark is light turned around, but for its hues. What Bokeh lays out is
# told its width by properties, as style sheets of the page do not reach into it.
TEMPLATE = """
{% block preamble %}
<script>
  const dark = matchMedia('(prefers-color-scheme: dark)')
  const scheme = () => localStorage.getItem('scheme') ?? (dark.matches ? 'dark' : 'light')
  const show = () => { document.documentElement.dataset.scheme = scheme() }
  const turn = () => {
    localStorage.setItem('scheme', scheme() === 'dark' ? 'light' : 'dark')
    show()
  }
  dark.addEventListener('change', show)
  show()
</script>
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>
  html, body { margin: 0; background: white; font-family: sans-serif; font-size: 12px; }
  html { min-height: 100vh; --left: 258px; --right: 0; }
  html[data-scheme=dark] { filter: invert(0.9) hue-rotate(180deg); }
  body { padding: 4px 6px; }
  @media (max-width: 700px) { html { --left: 100%; --right: 100%; } }
  @page { size: A4 landscape; margin: 8mm; }
  @media print {
    html[data-scheme] { filter: none; }
    body { zoom: 0.8; padding: 0; print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  }
</style>
{% endblock %}
"""
