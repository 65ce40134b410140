"""How things look: the colours of the project's pictures, told apart also in grey and by the
colour-blind."""

from __future__ import annotations

from typing import NamedTuple


class Look(NamedTuple):
    """Name, colour and line of a method."""

    label: str
    colour: str
    dash: str
    width: float


STRIPS = Look("strips + FASTSTRIP", "#0b3c78", "solid", 2.0)
HERTZ = Look("Hertz + FASTSIM", "#f08519", "dashed", 2.0)
NORM = Look("NORM + TANG", "#4d9748", "dotted", 3.6)
LOOKS = {"strips": STRIPS, "hertz": HERTZ, "norm": NORM}

GREY = "#6b6b6b"
GRID = "#e3e3e3"
AXIS = "#444444"
PALE = "#dfe8f3"  # the body of the wheel, and elements in adhesion
SLIP = "#ffffff"  # elements that slide
BODY = "#ececec"  # the body of the rail
SMALL = "11px"
FONT = "12px"
