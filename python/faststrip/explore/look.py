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
LOOKS = {"strips": STRIPS, "hertz": HERTZ, "norm": NORM}

GRID = "#e3e3e3"
AXIS = "#444444"
SLIP = "#ffffff"  # elements that slide
BODY = "#ececec"  # the body of the rail
SMALL = "11px"
FONT = "12px"
