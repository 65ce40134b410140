"""How things look: one colour, line style and name per method, readable in grey."""

from __future__ import annotations

import os

import matplotlib
import PIL.Image
import PIL.PngImagePlugin
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter, StrMethodFormatter

from .looks import looks
from .tables import InputError

FONT, SMALL, DPI, MAP, GREY = looks.FONT, looks.SMALL, looks.DPI, looks.MAP, looks.GREY
PALE, NORMAL, METHOD, CONTACT = looks.PALE, looks.NORMAL, looks.METHOD, looks.CONTACT
Look, normal_look, method_look = looks.Look, looks.normal_look, looks.method_look
number, jumps, broken, PATCH = looks.number, looks.jumps, looks.broken, looks.PATCH

COLOURS = 256  # of a PNG: what a byte tells


def luminance(colour: str) -> float:
    """How light a colour prints in grey, 0 to 1."""
    red, green, blue = matplotlib.colors.to_rgb(colour)
    return 0.299 * red + 0.587 * green + 0.114 * blue


def new_figure(width: float, height: float):
    """An empty figure in the common style, size in inches."""
    matplotlib.rcParams.update(looks.PARAMETERS)
    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    figure.get_layout_engine().set(w_pad=0.08, h_pad=0.06)
    return figure


def fit_panel(figure, axes, width: float, height: float) -> None:
    """Make a figure fit its one panel of equal scales, at most `width` by `height` inches."""
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    scale = min(width / abs(right - left), height / abs(high - low))
    figure.set_size_inches(
        max(5.5, scale * abs(right - left) + 0.8), scale * abs(high - low) + 1.5
    )


def legend_above(figure, *axes, columns=lambda names: min(5, names), length=3.2,
                 spacing=2.4) -> None:
    """One legend for the whole figure, above all panels, each name once; in so many columns by the
    number of names."""
    handles = {}
    for each in axes:
        for handle, label in zip(*each.get_legend_handles_labels()):
            handles.setdefault(label, handle)
    figure.legend(handles.values(), handles.keys(), loc="outside upper center",
                  ncols=max(1, columns(len(handles))), handlelength=length, columnspacing=spacing)


def log_axes(axes) -> None:
    """Logarithmic both, with plain numbers."""
    axes.set(xscale="log", yscale="log")
    for axis in (axes.xaxis, axes.yaxis):
        plain_numbers(axis)
        axis.set_minor_formatter(NullFormatter())


class _Plain(StrMethodFormatter):
    """Numbers without exponents."""

    def __call__(self, x, pos=None):
        return super().__call__(x, pos).rstrip("0").rstrip(".")


def plain_numbers(axis) -> None:
    """Let a logarithmic axis show all its numbers in one way, 0.00001 beside 100."""
    axis.set_major_formatter(_Plain("{x:.12f}"))


def mark_width(axes, left: float, right: float) -> None:
    """Mark how wide a contact patch is, along the lateral axis."""
    known = "width of the patch" in axes.get_legend_handles_labels()[1]
    axes.axvspan(left, right, facecolor=PATCH, alpha=0.25, linewidth=0, zorder=0.5,
                 label=None if known else "width of the patch")
    axes.text(0.5 * (left + right), 0.96, f"{right - left:.1f} mm", rotation=90.0, ha="center",
              va="top", fontsize=SMALL, transform=axes.get_xaxis_transform())


def write_png(figure, path: str, description: str) -> None:
    """Write a PNG of 256 colours, a third of the bytes of all: none is off by more than can be
    seen. It is drawn once: savefig would draw it twice, the first time for the layout alone."""
    dpi = figure.dpi
    figure.set_dpi(DPI)
    figure.canvas.draw()
    pixels = PIL.Image.frombuffer("RGBA", figure.canvas.get_width_height(),
                                  figure.canvas.buffer_rgba(), "raw", "RGBA", 0, 1)
    pixels = pixels.convert("RGB").quantize(
        COLOURS, method=PIL.Image.Quantize.MAXCOVERAGE, dither=PIL.Image.Dither.NONE)
    figure.set_dpi(dpi)
    about = PIL.PngImagePlugin.PngInfo()
    about.add_text("Description", description)
    pixels.save(path, format="png", pnginfo=about, optimize=True, dpi=(DPI, DPI))


def save(figure, path: str, stamps, note: str = "", vector: bool = False) -> None:
    """Stamp the revisions the figure was made from into its corner and write it as PNG, or as the
    path ends: .svg, .pdf.

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
        kind = os.path.splitext(path)[1].lower()
        if kind in (".svg", ".pdf"):
            with matplotlib.rc_context({"svg.hashsalt": "faststrip"}):
                figure.savefig(path, format=kind[1:],
                               metadata={"Date" if kind == ".svg" else "CreationDate": None})
        else:
            write_png(figure, path, f"{text};")
        if vector or os.environ.get("FASTSTRIP_SVG"):
            figure.set_layout_engine()  # none: what was placed for the PNG stays where it is
            # neither date nor random names: the same data give the same file
            with matplotlib.rc_context({"svg.hashsalt": "faststrip"}):
                figure.savefig(os.path.splitext(path)[0] + ".svg", format="svg",
                               metadata={"Date": None})
    except OSError as error:
        raise InputError(f"cannot write: {path} ({os.strerror(error.errno)})") from None
