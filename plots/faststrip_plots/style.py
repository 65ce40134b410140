"""How things look: one colour, line style and name per method, readable in grey."""

from __future__ import annotations

import os
from dataclasses import dataclass

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)

from .tables import InputError  # noqa: E402

FONT = 10
SMALL = 9
DPI = 150
MAP = "viridis_r"
GREY = "#6b6b6b"


@dataclass(frozen=True)
class Look:
    """Name, colour and line of a method."""

    label: str
    colour: str
    line: object
    width: float = 1.8


NORMAL = {
    "strip": Look("strips", "#0b3c78", "-", 2.0),
    "hertz": Look("Hertz", "#f08519", (0, (5, 1.8)), 1.8),
    # wide, to be seen on both sides of a line it agrees with
    "norm": Look("NORM", "#4d9748", (0, (1.6, 0.8)), 3.6),
}
METHOD = {
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
CONTACT = dict(
    linestyle="none",
    marker="o",
    markersize=5.2,
    markerfacecolor="white",
    markeredgecolor="black",
    markeredgewidth=1.1,
    label="CONTACT",
)


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


def luminance(colour: str) -> float:
    """How light a colour prints in grey, 0 to 1."""
    red, green, blue = matplotlib.colors.to_rgb(colour)
    return 0.299 * red + 0.587 * green + 0.114 * blue


def new_figure(width: float, height: float):
    """An empty figure in the common style, size in inches."""
    plt.rcParams.update(
        {
            "font.size": FONT,
            "axes.titlesize": FONT,
            "axes.labelsize": FONT,
            "xtick.labelsize": SMALL,
            "ytick.labelsize": SMALL,
            "legend.fontsize": FONT,
            "axes.spines.top": False,
            "axes.spines.right": False,
            "axes.edgecolor": "#444444",
            "axes.linewidth": 0.8,
            "axes.grid": True,
            "axes.axisbelow": True,
            "grid.color": "#e3e3e3",
            "grid.linewidth": 0.7,
            "legend.frameon": False,
            "mathtext.fontset": "dejavusans",
            "savefig.facecolor": "white",
        }
    )
    figure = plt.figure(figsize=(width, height), layout="constrained")
    figure.get_layout_engine().set(w_pad=0.08, h_pad=0.06)
    return figure


def number(value: float) -> str:
    """A short number for titles, with a true minus sign and no negative zero."""
    return f"{value + 0.0:g}".replace("-", "\N{MINUS SIGN}")


def title(axes, text: str) -> None:
    """Title of a panel, flush left."""
    axes.set_title(text, loc="left", fontweight="bold")


def fit_panel(figure, axes, width: float, height: float) -> None:
    """Make a figure fit its one panel of equal scales, at most `width` by `height` inches."""
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    scale = min(width / abs(right - left), height / abs(high - low))
    figure.set_size_inches(
        max(5.5, scale * abs(right - left) + 0.8), scale * abs(high - low) + 1.5
    )


def legend_above(figure, *axes) -> None:
    """One legend for the whole figure, above all panels, each name once."""
    handles = {}
    for each in axes:
        for handle, label in zip(*each.get_legend_handles_labels()):
            handles.setdefault(label, handle)
    figure.legend(
        handles.values(), handles.keys(), loc="outside upper center",
        ncols=max(1, min(5, len(handles))),
        handlelength=3.2, columnspacing=2.4,
    )


def save(figure, path: str, stamps, note: str = "", vector: bool = False) -> None:
    """Stamp the revisions the figure was made from into its corner and write it as PNG.

    They also stand in the file's description. A `note` goes into the other corner. With
    `vector`, or FASTSTRIP_SVG in the environment, the
    same is also written as SVG, under the same name with that ending.
    """
    known = list(dict.fromkeys(stamp for stamp in stamps if stamp))
    text = "; ".join(known) if known else "faststrip, revision not given"
    figure.supxlabel(text, x=0.99, ha="right", fontsize=SMALL, color=GREY)
    figure.text(0.01, 0.01, note, ha="left", va="bottom", fontsize=SMALL, color=GREY)
    try:
        os.makedirs(os.path.dirname(os.path.abspath(path)), exist_ok=True)
        figure.savefig(path, dpi=DPI, format="png", metadata={"Description": f"{text};"})
        if vector or os.environ.get("FASTSTRIP_SVG"):
            figure.set_layout_engine("none")  # what was placed for the PNG stays where it is
            # neither date nor random names: the same data give the same file
            with matplotlib.rc_context({"svg.hashsalt": "faststrip"}):
                figure.savefig(os.path.splitext(path)[0] + ".svg", format="svg",
                               metadata={"Date": None})
    except OSError as error:
        raise InputError(f"cannot write: {path} ({os.strerror(error.errno)})") from None
    finally:
        plt.close(figure)
