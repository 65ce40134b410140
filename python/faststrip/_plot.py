"""Pictures of contacts and profiles with matplotlib, in the style of the project."""

from __future__ import annotations

import contextlib
import math
import pathlib
from typing import (
    TYPE_CHECKING,
    Any,
    Dict,
    Iterator,
    List,
    Mapping,
    Optional,
    Sequence,
    Tuple,
    Union,
)

import numpy as np
import numpy.typing as npt

from . import _style as style
from ._library import bad_argument
from ._profile import Gap, Profile, draw_profile
from ._tables import extra

if TYPE_CHECKING:
    from ._results import Elements, Strips

Array = npt.NDArray[np.float64]
Numbers = Union[Array, Sequence[float]]
ADHESION = 1
ARROWS, ARROWS_ALONG = 13, 8  # rows that have some, and how many each, at most
ALONG = 48  # pieces of a strip along x, where its pressure is drawn
Y_LABEL = "lateral $y$, mm"
X_LABEL = "rolling direction $x$, mm"


def new_figure(width: float, height: float) -> Any:
    """A figure of that size, inches, in the style."""
    pyplot = extra("matplotlib.pyplot", "plot")
    with styled():
        figure = pyplot.figure(figsize=(width, height), layout="constrained")
        figure.get_layout_engine().set(w_pad=0.12, h_pad=0.06)
        return figure


def styled() -> Any:
    """The style, as long as it is entered."""
    return extra("matplotlib", "plot").rc_context(style.PARAMETERS)


@contextlib.contextmanager
def _drawing(axes: Any, width: float = 4.6, height: float = 3.9) -> Iterator[Any]:
    """The axes of the caller, or new ones, in the style."""
    with styled():
        yield new_figure(width, height).subplots() if axes is None else axes


def _profile_axes(axes: Any, **aspect: Any) -> None:
    axes.set_aspect("equal", **aspect)
    if not axes.yaxis_inverted():
        axes.invert_yaxis()
    axes.set(xlabel="$y$ to the field side, mm", ylabel="$z$ (down), mm")


def plot_contact(strips: Strips, elements: Elements, figure: Any = None) -> Any:
    """A contact: patch with pressures, pressures on the centre line, and tractions with the
    border of adhesion if there are elements."""
    if len(strips.p0) == 0:
        raise bad_argument("there is no contact to draw: solve one first")
    has_tractions = len(elements.x) > 0 and bool(np.any(elements.pn > 0.0))
    with styled():
        if figure is None:
            figure = new_figure(11.6 if has_tractions else 7.8, 3.9)
        panels = figure.subplots(1, 3 if has_tractions else 2)
        draw_pressure(panels[0], strips)
        draw_centre_line(panels[1], strips)
        if has_tractions:
            draw_tractions(panels[2], elements, strips)
    return figure


def _refuse_nothing(n: int, what: str) -> None:
    if n == 0:
        raise bad_argument(f"there are no {what} to draw")


def plot_strips(strips: Strips, axes: Any = None) -> Any:
    """The patch from above; the axes are given back."""
    _refuse_nothing(len(strips.p0), "strips")
    with _drawing(axes) as axes:
        draw_pressure(axes, strips)
    return axes


def plot_elements(elements: Elements, axes: Any = None) -> Any:
    """Tractions on the rail; the axes are given back."""
    _refuse_nothing(len(elements.x), "elements")
    with _drawing(axes) as axes:
        draw_tractions(axes, elements)
    return axes


def plot_lines(axes: Any, x: Numbers, lines: Mapping[str, Numbers], x_label: str,
               y_label: str) -> Any:
    """Lines over x, told apart also in grey; the axes are given back."""
    looks = list(style.METHOD.values())
    with _drawing(axes, 5.6, 3.4) as axes:
        for look, (label, values) in zip(looks, lines.items()):
            axes.plot(x, values, **{**look.line_style, "label": label or None})
        axes.set(xlabel=x_label, ylabel=y_label)
        if any(lines):
            axes.legend()
    return axes


def plot_profile(profile: Profile, axes: Any, options: Dict[str, Any]) -> Any:
    """The points of one profile, z down; the axes are given back."""
    with _drawing(axes, 7.0, 3.4) as axes:
        axes.plot(profile.y, profile.z, **{
            "label": pathlib.Path(profile.path).name or profile.kind, **options})
        _profile_axes(axes, adjustable="datalim")
    return axes


def draw_pressure(axes: Any, strips: Strips) -> Any:
    """The patch from above: strips, coloured by pressure; the colours are given back."""
    collections = extra("matplotlib.collections", "plot")
    tiles, values = [], []
    edges = np.cos(np.linspace(math.pi, 0.0, ALONG + 1))
    for left, right, half, top in zip(strips.y_left, strips.y_right, strips.half_length,
                                      strips.p0):
        for low, high in zip(edges[:-1], edges[1:]):
            tiles.append(((left, half * low), (right, half * low), (right, half * high),
                          (left, half * high)))
            values.append(top * math.sqrt(max(0.0, 1.0 - (0.5 * (low + high))**2)))
    colours = collections.PolyCollection(tiles, array=np.array(values), cmap=style.MAP,
                                         edgecolor="face", linewidth=0.2)
    colours.set_clim(0.0, float(np.max(strips.p0)))
    axes.add_collection(colours)
    _outline(axes, strips)
    axes.figure.colorbar(colours, ax=axes, label="pressure, MPa", shrink=0.8)
    _patch_axes(axes, "Patch and pressure")
    return colours


def _outline(axes: Any, strips: Strips) -> None:
    """The strips as bars."""
    collections = extra("matplotlib.collections", "plot")
    bars = [((left, -half), (right, -half), (right, half), (left, half))
            for left, right, half in zip(strips.y_left, strips.y_right, strips.half_length)]
    axes.add_collection(collections.PolyCollection(
        bars, facecolor="none", edgecolor=style.NORMAL["strip"].colour, linewidth=0.6, zorder=3))


def draw_centre_line(axes: Any, strips: Strips) -> None:
    """Pressures on the line x = 0, at the middle of each strip, from end to end of each patch."""
    look = style.normal_look("strip")
    for patch in np.unique(strips.patch):
        here = np.flatnonzero(strips.patch == patch)
        here = here[np.argsort(strips.y_left[here])]
        middles = 0.5 * (strips.y_left + strips.y_right)[here]
        y = np.concatenate([[strips.y_left[here[0]]], middles, [strips.y_right[here[-1]]]])
        axes.plot(y, np.concatenate([[0.0], strips.p0[here], [0.0]]), color=look.colour,
                  linestyle=look.line, linewidth=look.width, marker="o", markersize=3.2,
                  clip_on=False)
    axes.set(ylim=(0.0, None), xlabel=Y_LABEL, ylabel="pressure at $x$ = 0, MPa", title="Pressure")


def draw_tractions(axes: Any, elements: Elements, strips: Optional[Strips] = None) -> None:
    """Tractions on the rail as arrows; elements in adhesion are dark, and a black line is their
    border."""
    collections = extra("matplotlib.collections", "plot")
    tiles, width, length = _tiles(elements)
    adhesion = elements.state == ADHESION
    for which, colour in ((adhesion, style.STICK), (~adhesion, style.SLIP)):
        chosen = [tile for tile, is_it in zip(tiles, which) if is_it]
        if chosen:
            axes.add_collection(collections.PolyCollection(chosen, facecolor=colour,
                                                           edgecolor="face", linewidth=0.2))
    axes.add_collection(collections.LineCollection(
        _border(elements, adhesion, width, length), color="black", linewidth=1.8, zorder=4))
    if strips is not None:
        _outline(axes, strips)
    largest = float(np.hypot(elements.px, elements.py).max())
    if largest > 0.0:
        chosen_ones = _chosen(elements)
        # The longest arrow goes over two of its neighbours' places.
        span = max(float(np.ptp(elements.x)), float(np.ptp(elements.y)))
        arrows = axes.quiver(
            elements.y[chosen_ones], elements.x[chosen_ones], elements.py[chosen_ones],
            elements.px[chosen_ones], color=style.NORMAL["strip"].colour, pivot="tail", zorder=5,
            angles="xy", scale_units="xy", scale=largest * ARROWS / (2.0 * max(span, 1e-300)),
            width=4.5e-3, headwidth=4.0, headlength=4.5)
        axes.quiverkey(arrows, 0.86, 1.03, largest, f"{largest:.0f} MPa", labelpos="W",
                       coordinates="axes")
    _patch_axes(axes, "Tractions on the rail")
    axes.set_xlabel(f"{Y_LABEL}; {'dark: adhesion' if adhesion.any() else 'all slides'}")


def _tiles(elements: Elements) -> Tuple[List[Any], Array, Array]:
    """Each element as the rectangle that it stands for; their widths and lengths, mm."""
    length = np.empty(len(elements.x))
    for y in np.unique(elements.y):
        row = np.flatnonzero(elements.y == y)
        along = np.sort(elements.x[row])
        # A row of one element: as long as it is wide.
        length[row] = np.diff(along).mean() if len(row) > 1 else np.sqrt(elements.area[row])
    width = elements.area / length
    low, high = elements.x - 0.5 * length, elements.x + 0.5 * length
    left, right = elements.y - 0.5 * width, elements.y + 0.5 * width
    corners = np.stack([np.stack([left, low], -1), np.stack([right, low], -1),
                        np.stack([right, high], -1), np.stack([left, high], -1)], 1)
    return list(corners), width, length


def _border(elements: Elements, adhesion: npt.NDArray[np.bool_], width: Array,
            length: Array) -> List[Any]:
    """Lines between elements in adhesion and those that slide: across each row, and between rows
    where one of two that stand side by side slides."""
    lines = []
    rows = []
    for y in np.unique(elements.y):
        row = np.flatnonzero(elements.y == y)
        row = row[np.argsort(elements.x[row])]
        rows.append(row)
        for one, other in zip(row[:-1], row[1:]):
            if adhesion[one] != adhesion[other]:
                x = 0.5 * (elements.x[one] + elements.x[other])
                lines.append([(y - 0.5 * width[one], x), (y + 0.5 * width[one], x)])
    for row, following in zip(rows[:-1], rows[1:]):
        edge = elements.y[row[0]] + 0.5 * width[row[0]]
        if elements.y[following[0]] - 0.5 * width[following[0]] > edge + 0.25 * width[row[0]]:
            continue
        for i in row:
            for j in following:
                low = max(elements.x[i] - 0.5 * length[i], elements.x[j] - 0.5 * length[j])
                high = min(elements.x[i] + 0.5 * length[i], elements.x[j] + 0.5 * length[j])
                if low < high and adhesion[i] != adhesion[j]:
                    lines.append([(edge, low), (edge, high)])
    return lines


def _chosen(elements: Elements) -> npt.NDArray[np.intp]:
    """Elements that get an arrow: some of each of some rows."""
    rows = np.unique(elements.y)
    chosen: List[int] = []
    for y in rows[(len(rows) - 1) % -(-len(rows) // ARROWS) // 2::-(-len(rows) // ARROWS)]:
        row = np.flatnonzero(elements.y == y)
        row = row[np.argsort(elements.x[row])]
        step = -(-len(row) // ARROWS_ALONG)
        chosen.extend(row[(len(row) - 1) % step // 2::step])
    return np.array(chosen, dtype=np.intp)


def _patch_axes(axes: Any, title: str) -> None:
    axes.set_aspect("equal")
    axes.margins(0.05)
    axes.autoscale_view()
    axes.grid(False)
    axes.set(xlabel=Y_LABEL, ylabel=X_LABEL, title=title)


def plot_profiles(wheel: Union[str, Profile], rail: Union[str, Profile],
                  gap: Optional[Gap] = None, *, inclination: Optional[float] = None,
                  cant: Optional[float] = None, axes: Any = None) -> Any:
    """Draw a wheel on a rail, z down, mm; the axes are given back.

    Parameters
    ----------
    wheel, rail : str or Profile
        As of `profile_gap`.
    gap : Gap
        Of both, by `profile_gap`: the wheel then stands on the rail where they touch, and the
        place is marked. Without one both are drawn in the axes of their own.
    inclination, cant : float, optional
        Of the rail, as it was for the gap.
    axes : matplotlib.axes.Axes
        To draw on; new ones unless given.

    Returns
    -------
    matplotlib.axes.Axes
    """
    y_rail, z_rail = draw_profile(rail, "rail", inclination=inclination, cant=cant)
    y_wheel, z_wheel = draw_profile(wheel, "wheel")
    with _drawing(axes, 7.0, 3.4) as axes:
        if gap is not None:
            place = gap.y_rail, float(np.interp(gap.y_rail, y_rail, z_rail))
            y_wheel = y_wheel + place[0] - gap.y_wheel
            z_wheel = z_wheel + place[1] - np.interp(place[0], y_wheel, z_wheel)
        axes.fill_between(y_rail, z_rail, z_rail.max(), color=style.BODY, linewidth=0, zorder=1)
        axes.fill_between(y_wheel, z_wheel, z_wheel.min(), color=style.PALE, linewidth=0, zorder=1)
        axes.plot(y_wheel, z_wheel, color=style.WHEEL, linewidth=2.0, zorder=3, label="wheel")
        axes.plot(y_rail, z_rail, color=style.DARK, linewidth=2.0, zorder=3, label="rail")
        if gap is not None:
            axes.plot(*place, zorder=4, **{**style.CONTACT, "label": "contact"})
        _profile_axes(axes)
        axes.legend(loc="lower right")
    return axes
