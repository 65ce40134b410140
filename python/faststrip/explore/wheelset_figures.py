"""The pictures of a wheelset: both wheels on the track, and its contact functions."""

from __future__ import annotations

import math
from typing import Any, Dict, List, Union

import numpy as np
from bokeh.models import CustomJSTickFormatter, FixedTicker, Legend, Range1d, Span

from .._style import GREY, PALE, jumps
from .case import CONTROL
from .figures import here
from .look import AXIS, BODY, LEFT, RIGHT, SMALL
from .picture import BESIDE_FRAME, HEIGHT, WIDTH, Array, Picture, first_above
from .wheelset import DISPLACEMENTS, SIDES, Functions, WheelsetOutcome
from .wire import Direct

CUT = 650.0  # mm of the track that are left out on either side of its centre
REACH, UP = 180.0, -42.0  # mm: to the sides, and up
MIDDLE = 14.0  # mm: from the centre to the lines where the picture is cut
WORDS_AT, WORDS_DOWN = 48.0, 32.0  # mm: of the forces, below the flanges
LONGEST = 45.0  # mm: the longest force
FORCES = (2e4, 5e4, 1e5, 2e5, 3e5, 5e5, 1e6, 2e6)  # N, of that length
LOOK = {"right": RIGHT, "left": LEFT}


class Track(Picture):
    """Both wheels on their rails, seen along the track."""

    def __init__(self, out: Direct) -> None:
        height = 2.0 * REACH * HEIGHT / (2 * WIDTH + BESIDE_FRAME)
        super().__init__(out, "Wheelset on the track, seen ahead", "y to the right, mm",
                         "z down, mm", span=2, x_range=Range1d(-REACH, REACH),
                         y_range=Range1d(UP + height, UP))
        plot = self.figure
        plot.xaxis[0].ticker = FixedTicker(ticks=[-150, -100, -50, 50, 100, 150])
        plot.xaxis[0].formatter = CustomJSTickFormatter(
            code=f"return String(tick + Math.sign(tick) * {CUT:g}).replace('-', '\u2212')")
        for end in (-MIDDLE, MIDDLE):
            plot.add_layout(Span(location=end, dimension="height", line_color=GREY,
                                 line_dash="dashed"))
        for side in SIDES:
            for body, colour in (("rail", BODY), ("wheel", PALE)):
                name = f"{body}_{side}"
                plot.varea("y", "z", "far", source=self.source(name, "y z far"), fill_color=colour)
                plot.line("y", "z", source=self.sources[name], line_color=AXIS, line_width=1.6)
        plot.line("y", "z", source=self.source("bearing", "y z"), line_color="black",
                  line_width=5.0)
        forces = self.source("forces", "x0 y0 x1 y1 angle")
        plot.segment("x0", "y0", "x1", "y1", source=forces, line_color=RIGHT.colour, line_width=2.4)
        plot.scatter("x1", "y1", angle="angle", source=forces, marker="triangle", size=9,
                     fill_color=RIGHT.colour, line_color=RIGHT.colour)
        plot.text("y", "z", text="words", source=self.source("words", "y z words"),
                  text_align="center", text_baseline="top", text_font_size=SMALL)

    def show(self, outcome: WheelsetOutcome) -> None:
        result = outcome.result
        if result is None:
            self.clear("")
            return
        y_bearing: List[float] = []
        z_bearing: List[float] = []
        longest = first_above(FORCES, max(math.hypot(*one.force[1:]) for one in result.contacts))
        rows = []
        for side in SIDES:
            sense = 1.0 if side == "right" else -1.0
            contacts = [one for one in result.contacts if one.side == side]
            (y_wheel, z_wheel), (y_rail, z_rail) = outcome.profiles
            first = contacts[0]
            for body, far, y, z, place in (
                    ("wheel", -200.0, y_wheel, z_wheel, first.wheel[1:]),
                    ("rail", 200.0, y_rail, z_rail, first.rail)):
                at = float(np.interp(sense * place[0], y, z))
                self.put(f"{body}_{side}", {
                    "y": sense * y + first.place[1] - place[0] - sense * CUT,
                    "z": z + first.place[2] - at, "far": np.full(len(y), far)})
            for contact, strips in zip(result.contacts, outcome.strips):
                if contact.side != side:
                    continue
                y, z = contact.place[1] - sense * CUT, contact.place[2]
                _, fy, fz = (LONGEST / longest * one for one in contact.force)
                rows.append((y, z, y + fy, z + fz, math.atan2(-fz, fy) - 0.5 * math.pi))
                ends = ((strips.y_left.min(), strips.y_right.max()) if len(strips.p0)
                        else (0.0, 0.0))
                y_bearing += [*(y + end * math.cos(contact.contact_angle) for end in ends),
                              math.nan]
                z_bearing += [*(z + end * math.sin(contact.contact_angle) for end in ends),
                              math.nan]
        self.put("bearing", {"y": y_bearing, "z": z_bearing})
        self.put("forces", dict(zip(("x0", "y0", "x1", "y1", "angle"), zip(*rows))))
        self.put("words", {"y": [-WORDS_AT, WORDS_AT], "z": [WORDS_DOWN] * 2,
                           "words": [words_of(outcome, side) for side in SIDES]})
        self.tell(f"arrows: force on the rail, {LONGEST:g} mm are {longest / 1e3:g} kN")


def words_of(outcome: WheelsetOutcome, side: str) -> str:
    """Forces of one wheel, beside it."""
    one = outcome.rests(side)
    return (f"Q {one.vertical / 1e3:.1f} kN\nY {one.lateral / 1e3:.1f} kN\n"
            f"Y/Q {one.ratio:.2f}").replace("-", "\N{MINUS SIGN}")


class Function(Picture):
    """A function of the displacement or of the amplitude, for both wheels or of the wheelset."""

    def __init__(self, out: Direct, title: str, x_label: str, y_label: str, low: float,
                 names: Dict[str, str], name: str, legend: str = "") -> None:
        super().__init__(out, title, x_label, y_label, name=name,
                         x_range=Range1d(low, DISPLACEMENTS[-1]))
        lines: List[Any] = []
        for key, label in names.items():
            look = LOOK.get(key, RIGHT if not lines else LEFT)
            lines.append((label, [self.figure.line("x", "y", source=self.source(key, "x y"),
                                                   **look.line)]))
        if legend:
            self.figure.add_layout(Legend(
                items=lines, location=legend, padding=2, spacing=0, margin=2,
                label_text_font_size="10px", glyph_height=14, label_height=14,
                border_line_color=None, background_fill_alpha=0.6))
        self.here = here(self)

    def draw(self, x: Array, lines: Dict[str, Array], least: float) -> None:
        """Lines over x; what is shown of y holds them and is not less high than this."""
        for name, values in lines.items():
            self.put(name, {"x": x, "y": values})
        both = np.concatenate(list(lines.values()))
        both = both[np.isfinite(both)]
        low, high = (float(both.min()), float(both.max())) if len(both) else (0.0, 1.0)
        room = max(0.08 * (high - low), 0.5 * (least - (high - low)))
        self.set_range(self.y_range, low - room, high + room)


class WheelsetPictures:
    """All pictures of a wheelset."""

    def __init__(self, out: Direct) -> None:
        shift = CONTROL["shift"].label
        both = {"right": "right", "left": "left"}
        first = float(DISPLACEMENTS[0])
        self.track = Track(out)
        self.radii = Function(out, "Rolling radius difference", shift, "Δr, mm", first,
                              {"delta_r": ""}, "radii")
        self.angles = Function(out, "Contact angle", shift, "angle to the track, °", first, both,
                               "angles", "bottom_center")
        self.conicity = Function(out, "Equivalent conicity", "amplitude, mm", "tan γe", 0.0,
                                 {"klingel": "Klingel", "regression": "regression"}, "conicity",
                                 "top_center")
        self.key: Any = None

    def all(self) -> List[Picture]:
        """In the order in which they stand beside and below each other."""
        return [self.track, self.radii, self.angles, self.conicity]

    def show(self, outcome: WheelsetOutcome, functions: Union[None, str, Functions]) -> None:
        """Draw anew what shows something else than before."""
        if self.track.key is not outcome.result or outcome.result is None:
            self.track.show(outcome)
            self.track.key = outcome.result
        for picture in (self.radii, self.angles):
            self.track.out.set(picture.here, location=outcome.case.shift)
        self.track.out.set(self.conicity.here, location=abs(outcome.case.shift))
        if functions is None or self.key is functions:
            return
        self.key = functions
        if isinstance(functions, str):
            for picture in (self.radii, self.angles, self.conicity):
                picture.clear("")
            return
        of_y, conicity = functions
        self.radii.draw(of_y.y, {"delta_r": broken(of_y.y, of_y.delta_r, of_y.y_wheel_right,
                                                   of_y.y_wheel_left)}, 1.0)
        self.angles.draw(of_y.y, {
            "right": broken(of_y.y, np.degrees(of_y.angle_right), of_y.y_wheel_right),
            "left": broken(of_y.y, np.degrees(of_y.angle_left), of_y.y_wheel_left)}, 2.0)
        self.conicity.draw(conicity.amplitude, {"klingel": conicity.tan_gamma_e,
                                                "regression": conicity.regression}, 0.1)


def broken(over: Array, values: Array, *places: Array) -> Array:
    """A line with gaps where a contact jumps on its wheel."""
    found = values.copy()
    found[:-1][jumps(over, *places)] = math.nan
    return found
