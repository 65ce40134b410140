"""The pictures of one contact. Each is drawn anew only when what it shows has changed."""

from __future__ import annotations

import math
from typing import Any, Dict, List, NamedTuple, Optional, Tuple

import numpy as np
import numpy.typing as npt
from bokeh.models import (
    ColorBar,
    CustomJSTickFormatter,
    FixedTicker,
    Label,
    Legend,
    LinearColorMapper,
    Range1d,
    Span,
)
from bokeh.palettes import viridis

from .._style import GREY, PALE
from . import fields
from .case import CONTROL
from .look import AXIS, BODY, HERTZ, LOOKS, NORM, SLIP, SMALL, STRIPS
from .picture import HEIGHT, WIDTH, Picture, first_above
from .solving import AXES, MAP_POINTS, SWEEP, Curve, Outcome, Survey, half_width
from .wire import Direct

Array = npt.NDArray[np.float64]
# Around a patch, to its sides, and above, where words stand; part of the width below which it is
# narrow, and how much of the width is left to it then.
BESIDE, ABOVE, NARROW, STRETCHED = 1.08, 1.3, 0.3, 2.0
LENGTHS = (0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 15.0, 20.0, 25.0, 30.0, 40.0,
           50.0)
PRESSURES = (200.0, 500.0, 1000.0, 1500.0, 2000.0, 3000.0, 4000.0, 6000.0, 10000.0, 20000.0)
ARROW = 22.0  # pixels: the longest arrow
APART = 7.0  # pixels: marks of NORM
# Of a line contact without friction, over the yield stress in shear: Johnson, Contact Mechanics
# (1985), section 9.2.
SHAKEDOWN = 4.0
LATERAL = "y to the field side, mm"
ROLLING = "x ahead, mm"
TIMES = (("gap", "gap of the profiles", GREY), ("strips", STRIPS.label, STRIPS.colour),
         ("hertz", HERTZ.label, HERTZ.colour), ("curve", "two creep curves", GREY),
         ("sweep", "sweep", GREY), ("map", "map", GREY), ("pictures", "pictures", GREY),
         ("norm", NORM.label, NORM.colour))
SHORTEST, LONGEST = 0.01, 3.0e4  # ms, of the time bar


class Profiles(Picture):
    """Both profiles where they touch, with the flange."""

    LEFT, RIGHT, UP = -75.0, 60.0, -38.0  # mm

    def __init__(self, out: Direct) -> None:
        height = (self.RIGHT - self.LEFT) * HEIGHT / WIDTH
        super().__init__(out, "Profiles", LATERAL, "z down, mm",
                         x_range=Range1d(self.LEFT, self.RIGHT),
                         y_range=Range1d(self.UP + height, self.UP))
        for name, colour in (("rail", BODY), ("wheel", PALE)):
            self.figure.varea("y", "z", "far", source=self.source(name, "y z far"),
                              fill_color=colour)
            self.figure.line("y", "z", source=self.sources[name], line_color=AXIS, line_width=1.6)
        self.figure.line("y", "z", source=self.source("bearing", "y z"), line_color="black",
                         line_width=5.0)
        self.figure.scatter("y", "z", source=self.source("places", "y z"), size=9,
                            marker="inverted_triangle", fill_color="black", line_color="white")
        for text, y, z in (("wheel", 38.0, -15.0), ("rail", -12.0, 40.0)):
            self.figure.add_layout(Label(x=y, y=z, text=text, text_font_size=SMALL,
                                         text_color=AXIS))

    def show(self, outcome: Outcome) -> None:
        geometry = outcome.geometry
        if geometry is None or outcome.profiles[0] is None:
            self.clear("")
            return
        (y_wheel, z_wheel), (y_rail, z_rail) = outcome.profiles
        place = geometry.place
        at = float(np.interp(place.y_rail, y_rail, z_rail))
        y_wheel = y_wheel + place.y_rail - place.y_wheel
        z_wheel = z_wheel + at - float(np.interp(place.y_rail, y_wheel, z_wheel))
        self.put("wheel", {"y": y_wheel, "z": z_wheel, "far": np.full(len(y_wheel), -100.0)})
        self.put("rail", {"y": y_rail, "z": z_rail, "far": np.full(len(y_rail), 100.0)})
        places = np.array([one.y_rail for one in geometry.places])
        self.put("places", {"y": places, "z": np.interp(places, y_rail, z_rail) - 2.2})
        strips = outcome.answers["strips"].strips
        y, z = [], []
        if strips is not None:
            for patch in np.unique(strips.patch):
                of = strips.patch == patch
                ends = np.array([strips.y_left[of].min(), strips.y_right[of].max()])
                first, last = place.y_rail + ends * math.cos(place.angle)
                across = np.linspace(first, last, 9)
                y += [*across, math.nan]
                z += [*np.interp(across, y_rail, z_rail), math.nan]
        self.put("bearing", {"y": y, "z": z})
        more = f", {len(places)} contacts" if len(places) > 1 else ""
        self.tell(f"contact angle {math.degrees(place.angle):.2f}°, rolling radius "
                  f"{geometry.radius:.2f} mm{more}")


class Patch(Picture):
    """The strips with their pressure, the Hertz ellipse, NORM's patch."""

    def __init__(self, out: Direct) -> None:
        super().__init__(out, "Contact patch: strips and their pressure", LATERAL, ROLLING)
        self.high = 1000.0
        self.mapper = LinearColorMapper(palette=viridis(64)[::-1], low=0.0, high=1000.0)
        self.ticks = FixedTicker(ticks=[0.0, 500.0, 1000.0])
        drawn = self.figure.quad(
            left="left", right="right", bottom="bottom", top="top",
            source=self.source("strips", "left right bottom top p0 y"),
            fill_color={"field": "p0", "transform": self.mapper}, line_color="white",
            line_width=0.6)
        self.figure.add_layout(scale_bar(self.mapper, "MPa", self.ticks))
        self.hover(drawn, [("y", "@y{0.00} mm"), ("half-length", "@top{0.00} mm"),
                           ("pressure", "@p0{0} MPa")])
        self.figure.line("y", "x", source=self.source("ellipse", "y x"), **HERTZ.line)
        self.draw_norm("x")

    def show(self, outcome: Outcome) -> None:
        strips, hertz = outcome.strips("strips"), outcome.result("hertz")
        self.put("strips", None if strips is None else fields.bars(strips))
        self.put("ellipse", None if hertz is None else fields.ellipse(hertz)[0])
        shown = window(outcome)
        rows = outcome.rows
        if rows is None:
            self.put("norm", None)
        else:
            few = marked(rows.y / shown.half_y, rows.x_last / shown.half_x)
            self.put("norm", {"y": np.concatenate([rows.y[few], rows.y[few]]),
                              "x": np.concatenate([rows.x_first[few], rows.x_last[few]])})
        result = outcome.result("strips")
        high = 1000.0 if result is None else first_above(PRESSURES, result.pmax)
        if self.high != high:
            self.high = high
            self.out.set(self.mapper, high=high)
            self.out.set(self.ticks, ticks=[0.0, 0.5 * high, high])
        self.set_range(self.x_range, shown.middle - shown.half_y, shown.middle + shown.half_y)
        self.set_range(self.y_range, -shown.half_x, shown.half_x)
        self.tell("y is stretched" if shown.is_stretched else "")


def scale_bar(mapper: LinearColorMapper, title: str, ticks: Any) -> ColorBar:
    """What colours stand for, in the upper right corner."""
    return ColorBar(
        color_mapper=mapper, orientation="horizontal", width=86, height=6, padding=2, margin=10,
        location="top_right", title=title, title_text_font_size="10px",
        title_text_font_style="normal", title_standoff=1, label_standoff=2,
        major_label_text_font_size="10px", major_tick_line_color=None, ticker=ticks,
        background_fill_alpha=0.7)


class Window(NamedTuple):
    """What pictures of the patch show: their middle, and half of what they show of y and x, mm."""

    middle: float
    half_y: float
    half_x: float

    @property
    def is_stretched(self) -> bool:
        return self.half_y * HEIGHT < 0.99 * self.half_x * WIDTH


def window(outcome: Outcome) -> Window:
    """In steps, so that pictures do not tremble; with one scale along both sides, but for patches
    that are so narrow that nothing could be seen of them."""
    results = [result for name in ("strips", "hertz")
               if (result := outcome.result(name)) is not None]
    if not results:
        return Window(0.0, LENGTHS[-1], LENGTHS[-1] * HEIGHT / WIDTH)
    low, high = min(one.y_min for one in results), max(one.y_max for one in results)
    middle = float(round(0.5 * (low + high)))
    across = BESIDE * max(high - middle, middle - low)
    along = ABOVE * max(one.x_max for one in results)
    half = first_above(LENGTHS, max(across, along * WIDTH / HEIGHT))
    if across < NARROW * half:
        return Window(middle, first_above(LENGTHS, STRETCHED * across), half * HEIGHT / WIDTH)
    return Window(middle, half, half * HEIGHT / WIDTH)


def marked(across: Array, up: Array) -> List[int]:
    """Points of a curve that get a mark, so that marks do not cover each other; both over half of
    what a picture shows."""
    found: List[int] = []
    x, y = 0.5 * WIDTH * across, 0.5 * HEIGHT * up
    for k in range(len(x)):
        if not found or math.hypot(x[k] - x[found[-1]], y[k] - y[found[-1]]) >= APART:
            found.append(k)
    return found


class Pressure(Picture):
    """Pressure across the patch, at x = 0."""

    def __init__(self, out: Direct, x_range: Range1d) -> None:
        super().__init__(out, "Pressure at x = 0", LATERAL, "pressure, MPa",
                         x_range=x_range, y_range=Range1d(0.0, 1000.0))
        strips = self.figure.line("y", "p", source=self.source("strips", "y p"),
                                  **STRIPS.line)
        self.hover(strips, [("y", "@y{0.00} mm"), ("pressure", "@p{0} MPa")])
        self.limit = shakedown_line(self)
        self.figure.line("y", "p", source=self.source("hertz", "y p"), **HERTZ.line)
        self.draw_norm("p")

    def show(self, outcome: Outcome) -> None:
        strips, hertz = outcome.strips("strips"), outcome.result("hertz")
        highest = 0.0
        self.put("strips", None if strips is None else fields.pressure_line(strips))
        self.put("hertz", None if hertz is None else fields.ellipse(hertz)[1])
        for answer in outcome.answers.values():
            if answer.result is not None:
                highest = max(highest, answer.result.pmax)
        top = first_above(PRESSURES, 1.05 * highest)
        rows = outcome.rows
        if rows is None:
            self.put("norm", None)
        else:
            few = marked(rows.y / window(outcome).half_y, 2.0 * rows.pressure / top)
            self.put("norm", {"y": rows.y[few], "p": rows.pressure[few]})
        self.out.set(self.limit, location=SHAKEDOWN * outcome.case.yield_shear)
        if highest > 0.0:
            self.set_range(self.y_range, 0.0, top)


def shakedown_line(picture: Picture) -> Span:
    """Where the pressure of shakedown is."""
    line = Span(location=SHAKEDOWN, dimension="width", line_color="#a0306a", line_dash="dashdot")
    picture.figure.add_layout(line)
    return line


class Tractions(Picture):
    """Tractions of one method as arrows, with adhesion, slip and the border between."""

    def __init__(self, out: Direct, method: str, x_range: Range1d, y_range: Range1d) -> None:
        self.method = method
        look = LOOKS[method]
        super().__init__(out, f"Tractions on the rail, {look.label}", LATERAL, ROLLING,
                         name=f"tractions_{method}",
                         x_range=x_range, y_range=y_range)
        self.figure.quad(left="left", right="right", bottom="bottom", top="top",
                         source=self.source("runs", "left right bottom top state"),
                         fill_color={"field": "state", "transform": LinearColorMapper(
                             palette=[PALE, SLIP], low=1.0, high=2.0)},
                         line_color="#b9c6d6", line_width=0.5)
        arrows = self.source("arrows", "x0 x1 y0 y1 angle")
        self.figure.segment("x0", "y0", "x1", "y1", source=arrows, line_color=look.colour,
                            line_width=1.1)
        self.figure.scatter("x1", "y1", angle="angle", source=arrows, marker="triangle", size=4,
                            fill_color=look.colour, line_color=look.colour)
        self.figure.segment("x0", "y0", "x1", "y1", source=self.source("border", "x0 x1 y0 y1"),
                            line_color="black", line_width=2.4)

    def show(self, outcome: Outcome) -> None:
        answer = outcome.answers.get(self.method)
        if answer is None or answer.elements is None or answer.result is None:
            self.clear("no result")
            return
        runs = fields.runs(answer.elements)
        self.put("border", fields.borders(runs))
        self.put("runs", runs)
        longest = outcome.case.mu * answer.result.pmax
        shown = window(outcome)
        pixel = 2.0 * shown.half_y / WIDTH, 2.0 * shown.half_x / HEIGHT
        self.put("arrows", fields.arrows(answer.elements, longest, ARROW, pixel))
        most = float(np.hypot(answer.elements.px, answer.elements.py).max())
        # The share of adhesion of FASTSTRIP is corrected, its elements are not.
        state = "adhesion (march)" if self.method == "strips" else "adhesion"
        self.tell(f"up to {most:.0f} MPa; shaded: {state}")


class Creep(Picture):
    """The force over one creepage, and where the case is on it."""

    def __init__(self, out: Direct) -> None:
        super().__init__(out, "Creep curve", CONTROL["cksi"].label, "Fx on the rail over μ·N",
                         x_range=Range1d(-1.0, 1.0),
                         y_range=Range1d(-1.1, 1.1))
        items = []
        for name in ("strips", "hertz"):
            look = LOOKS[name]
            line = self.figure.line(
                "creepage", "force", source=self.source(name, "creepage force"),
                **look.line)
            items.append((look.label, [line]))
        dots = self.figure.scatter([0.0], [math.nan], marker="circle", size=5, fill_color="white",
                                   line_color=NORM.colour, line_width=1.4)
        self.figure.add_layout(Legend(
            items=[*items, (NORM.label, [dots])], location="top_right", padding=2, spacing=0,
            margin=2, label_text_font_size="10px", glyph_height=14, label_height=14,
            border_line_color=None, background_fill_alpha=0.6))
        self.here = here(self)
        self.figure.scatter("creepage", "force", marker="marker", size=9, fill_color="colour",
                            line_color="white",
                            source=self.source("now", "creepage force marker colour"))

    def show(self, outcome: Outcome, curve: Optional[Curve]) -> None:
        control = CONTROL[outcome.axis]
        force = "Fx" if outcome.axis == "cksi" else "Fy"
        plot = self.figure
        self.out.set(plot.xaxis[0], axis_label=control.label)
        self.out.set(plot.yaxis[0], axis_label=f"{force} on the rail over μ·N")
        value = getattr(outcome.case, outcome.axis) / control.scale
        self.out.set(self.here, location=value)
        half = half_width(outcome.axis, getattr(outcome.case, outcome.axis)) / control.scale
        self.set_range(self.x_range, -half, half)
        self._points(outcome, value)
        if self.is_as_before(curve, "strips", "hertz") or curve is None:
            return
        for name, forces in (curve.fx if force == "Fx" else curve.fy).items():
            self.put(name, {"creepage": curve.creepage / control.scale, "force": forces})

    def _points(self, outcome: Outcome, value: float) -> None:
        rows: Dict[str, List[Any]] = {"creepage": [], "force": [], "marker": [], "colour": []}
        for name, marker in (("hertz", "square"), ("strips", "circle"), ("norm", "diamond")):
            answer = outcome.answers.get(name)
            if answer is None or answer.result is None:
                continue
            force = answer.result.fx if outcome.axis == "cksi" else answer.result.fy
            rows["creepage"].append(value)
            rows["force"].append(force / (outcome.case.mu * answer.result.load))
            rows["marker"].append(marker)
            rows["colour"].append(LOOKS[name].colour)
        self.put("now", rows)


class Sweep(Picture):
    """Maximum pressures over the lateral displacement."""

    def __init__(self, out: Direct) -> None:
        super().__init__(out, "Sweep: maximum pressure", CONTROL["shift"].label,
                         "pressure, MPa", x_range=Range1d(SWEEP[0], SWEEP[-1]),
                         y_range=Range1d(0.0, 4000.0))
        for name in ("strips", "hertz"):
            self.figure.line("y", "p", source=self.source(name, "y p"), **LOOKS[name].line)
        self.limit = shakedown_line(self)
        self.here = here(self)

    def show(self, outcome: Outcome, survey: Survey) -> None:
        self.out.set(self.limit, location=SHAKEDOWN * outcome.case.yield_shear)
        self.out.set(self.here, location=outcome.case.shift)
        if self.is_as_before(survey.pressure, "strips", "hertz") or survey.pressure is None:
            return
        for name, pressure in survey.pressure.items():
            self.put(name, {"y": SWEEP, "p": pressure})
        highest = max((float(np.nanmax(p)) for p in survey.pressure.values()
                       if not np.all(np.isnan(p))), default=1.0)
        self.set_range(self.y_range, 0.0, first_above(PRESSURES, min(1.05 * highest, 6000.0)))


class Map(Picture):
    """The creep force over both creepages."""

    def __init__(self, out: Direct) -> None:
        super().__init__(out, "Creep-force map, strips + FASTSTRIP", CONTROL["cksi"].label,
                         CONTROL["ceta"].label)
        self.now: Tuple[float, ...] = ()
        mapper = LinearColorMapper(palette=viridis(64)[::-1], low=0.0, high=1.0)
        colour = {"field": "part", "transform": mapper}
        cells = self.figure.quad(left="left", right="right", bottom="bottom", top="top",
                                 source=self.source("cells", "left right bottom top part"),
                                 fill_color=colour, line_color=colour)
        self.figure.add_layout(scale_bar(mapper, "force over μ·N",
                                         FixedTicker(ticks=[0.0, 0.5, 1.0])))
        self.hover(cells, [("force over μ·N", "@part{0.000}")])
        self.figure.scatter("x", "y", source=self.source("now", "x y"), marker="circle", size=9,
                            fill_color="white", line_color="black", line_width=1.6)

    def show(self, outcome: Outcome, survey: Survey) -> None:
        scale = [CONTROL[name].scale for name in AXES]
        now = outcome.case.cksi / scale[0], outcome.case.ceta / scale[1]
        if self.now != now:
            self.now = now
            self.put("now", {"x": now[:1], "y": now[1:]})
        if self.is_as_before(survey.part, "cells") or survey.part is None:
            return
        ends = [np.linspace(-half, half, MAP_POINTS) / one
                for half, one in zip(survey.half, scale)]
        x, y = (values.ravel() for values in np.meshgrid(*ends))
        wide, high = (0.5 * (one[1] - one[0]) for one in ends)
        self.put("cells", {"left": x - wide, "right": x + wide, "bottom": y - high,
                           "top": y + high, "part": survey.part.ravel()})
        self.set_range(self.x_range, ends[0][0], ends[0][-1])
        self.set_range(self.y_range, ends[1][0], ends[1][-1])


def here(picture: Picture) -> Span:
    """The line that marks where the case is."""
    line = Span(location=0.0, dimension="height", line_color=GREY, line_dash="dotted")
    picture.figure.add_layout(line)
    return line


class Times(Picture):
    """What each method cost."""

    def __init__(self, out: Direct) -> None:
        rows = [label for _, label, _ in TIMES][::-1]
        super().__init__(out, "Solution times on this machine", "time, ms", "",
                         x_range=Range1d(SHORTEST, LONGEST), y_range=rows, x_axis_type="log")
        source = self.source("times", "row left right colour text")
        self.figure.hbar(y="row", left="left", right="right", height=0.9, fill_color="colour",
                         fill_alpha=0.35, line_color=None, source=source)
        self.figure.text("left", "row", text="text", source=source, x_offset=4,
                         text_baseline="middle", text_font_size=SMALL)
        self.figure.ygrid.grid_line_color = None
        self.figure.yaxis[0].visible = False
        self.figure.xaxis[0].ticker.desired_num_ticks = 4
        self.figure.xaxis[0].formatter = CustomJSTickFormatter(
            code="return tick >= 1000 ? (tick/1000) + ' s' : tick + ''")

    def show(self, times: Dict[str, float]) -> None:
        rows = [(label, colour, 1e3 * times[name]) for name, label, colour in TIMES
                if name in times]
        self.put("times", {
            "row": [label for label, _, _ in rows], "colour": [colour for _, colour, _ in rows],
            "left": [SHORTEST] * len(rows), "right": [max(ms, SHORTEST) for _, _, ms in rows],
            "text": [f"{label}: {time_text(ms)}" for label, _, ms in rows]})


def time_text(ms: float) -> str:
    """A time with two digits."""
    if ms >= 1000.0:
        return f"{ms / 1000.0:.3g} s"
    return f"{ms:.2g} ms" if ms < 100.0 else f"{ms:.0f} ms"


class Pictures:
    """All pictures of one contact."""

    def __init__(self, out: Direct) -> None:
        self.profiles = Profiles(out)
        self.patch = Patch(out)
        shared = self.patch.x_range, self.patch.y_range
        self.pressure = Pressure(out, shared[0])
        self.tractions = {name: Tractions(out, name, *shared) for name in ("strips", "hertz")}
        self.creep = Creep(out)
        self.sweep = Sweep(out)
        self.map = Map(out)
        self.times = Times(out)

    def all(self) -> List[Picture]:
        """In the order in which they stand beside and below each other."""
        return [self.profiles, self.patch, self.pressure, *self.tractions.values(), self.creep,
                self.sweep, self.map, self.times]

    def show(self, outcome: Outcome, survey: Survey, rests: bool = True) -> None:
        """Draw anew what shows something else than before; what is not known yet when the sliders
        rest."""
        normal = outcome.where, outcome.case.yield_shear, outcome.rows is not None
        for picture, key in ((self.profiles, outcome.where), (self.patch, normal),
                             (self.pressure, normal),
                             (self.tractions["strips"], outcome.motion),
                             (self.tractions["hertz"], outcome.motion)):
            if picture.key != key:
                picture.show(outcome)
                picture.key = key
        if rests or survey.curve is not None:
            self.creep.show(outcome, survey.curve)
        if rests:
            self.sweep.show(outcome, survey)
        if rests or survey.part is not None:
            self.map.show(outcome, survey)
