"""How pictures look: one colour, line style and name per method, readable in grey.

The pictures of ``plots/`` take it from this file, so it asks for nothing but Python.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Dict, Iterable, List, Tuple

FONT = 10
SMALL = 9
DPI = 150
MAP = "viridis_r"
GREY = "#6b6b6b"
DARK = "#444444"
PALE = "#dfe8f3"  # the body of strips and wheel
BODY = "#dcdcdc"  # the body of the rail
WHEEL = "#0b3c78"
STICK = "#b9cde5"  # elements in adhesion
SLIP = "#f4efe6"  # elements that slide
PATCH = "#c9a227"  # how wide a contact is
# A place of contact that moves farther than that, mm, and besides than so many times what it is
# drawn over, has jumped. Chosen: S1002 on 60E1 moves up to 6 times as far as it is displaced, and
# jumps by 4 to 33.
JUMP, RATE = 2.0, 5.0


@dataclass(frozen=True)
class Look:
    """Name, colour and line of a method."""

    label: str
    colour: str
    line: Any
    width: float = 1.8

    @property
    def line_style(self) -> Dict[str, Any]:
        """What matplotlib's ``plot`` takes of it."""
        return {"color": self.colour, "linestyle": self.line, "linewidth": self.width,
                "label": self.label}


NORMAL: Dict[str, Look] = {
    "strip": Look("strips", "#0b3c78", "-", 2.0),
    "hertz": Look("Hertz", "#f08519", (0, (5, 1.8)), 1.8),
    # wide, to be seen on both sides of a line it agrees with
    "norm": Look("NORM", "#4d9748", (0, (1.6, 0.8)), 3.6),
}
METHOD: Dict[Tuple[str, str], Look] = {
    ("strip", "faststrip"): Look("strips + FASTSTRIP", "#0b3c78", "-", 2.0),
    ("hertz", "fastsim"): Look("Hertz + FASTSIM", "#f08519", (0, (5, 1.8)), 1.8),
    ("norm", "tang"): Look("NORM + TANG", "#4d9748", (0, (1.6, 0.8)), 3.6),
    ("strip", "fastsim"): Look("strips + FASTSIM", "#a0306a", (0, (6, 1.6, 1.2, 1.6)), 1.6),
    ("strip", "faststrip-paper"): Look(
        "strips + FASTSTRIP as printed", "#111111", (0, (1.2, 1.2)), 1.8
    ),
    ("strip", "faststrip-corrected"): Look(
        "strips + FASTSTRIP corrected", "#86dcc6", (0, (3, 1, 1, 1, 1, 1)), 2.2
    ),
}
_OTHERS = (("#4b8f3c", (0, (1.2, 1.2))), ("#5f4ba8", (0, (3, 1, 1, 1, 1, 1))), ("#8a8a8a", "-"))
CONTACT: Dict[str, Any] = dict(
    linestyle="none",
    marker="o",
    markersize=5.2,
    markerfacecolor="white",
    markeredgecolor="black",
    markeredgewidth=1.1,
    label="CONTACT",
)
# Of matplotlib.
PARAMETERS: Dict[str, Any] = {
    "font.size": FONT,
    "axes.titlesize": FONT,
    "axes.titlelocation": "left",
    "axes.titleweight": "bold",
    "axes.labelsize": FONT,
    "xtick.labelsize": SMALL,
    "ytick.labelsize": SMALL,
    "legend.fontsize": FONT,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": DARK,
    "axes.linewidth": 0.8,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#e3e3e3",
    "grid.linewidth": 0.7,
    "legend.frameon": False,
    "mathtext.fontset": "dejavusans",
    "savefig.facecolor": "white",
    # Figures choose their layout; what was laid out stays.
    "figure.autolayout": False,
    "figure.constrained_layout.use": False,
}


def normal_look(normal: str) -> Look:
    """How a normal method is drawn; methods not known yet get a style of their own."""
    if normal in NORMAL:
        return NORMAL[normal]
    colour, line = _OTHERS[sum(normal.encode()) % len(_OTHERS)]
    return Look(normal, colour, line)


def method_look(normal: str, tangential: str) -> Look:
    """How a combination of methods is drawn."""
    if (normal, tangential) in METHOD:
        return METHOD[normal, tangential]
    colour, line = _OTHERS[sum((normal + tangential).encode()) % len(_OTHERS)]
    return Look(f"{normal} + {tangential}", colour, line)


def jumps(over: Any, *places: Any) -> List[bool]:
    """Has a contact jumped before each point but the first, in any of its places, mm, over the
    displacement, mm?"""
    most = [JUMP + RATE * abs(after - before) for before, after in zip(over[:-1], over[1:])]
    return [any(abs(after - before) > limit for before, after in pairs)
            for limit, *pairs in zip(most, *(zip(place[:-1], place[1:]) for place in places))]


def broken(jumped: Iterable[bool], *columns: Any) -> List[List[float]]:
    """Columns of a line with a hole at every jump, so that nothing is drawn across it."""
    found = [[column[0]] for column in columns]
    for k, hole in enumerate(jumped, 1):
        for column, line in zip(columns, found):
            line.extend([math.nan, column[k]] if hole else [column[k]])
    return found


def number(value: float) -> str:
    """A short number for titles, with a true minus sign and no negative zero."""
    return f"{value + 0.0:g}".replace("-", "\N{MINUS SIGN}")
