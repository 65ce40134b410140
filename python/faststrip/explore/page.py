"""The page of one browser tab: sliders, pictures, numbers, downloads."""

from __future__ import annotations

import base64
import html
import json
import threading
import time
from typing import Any, Callable, Dict, List, Optional

from bokeh.document import Document
from bokeh.embed import json_item
from bokeh.events import DocumentReady
from bokeh.layouts import column, gridplot, row
from bokeh.models import (
    Button,
    ColumnDataSource,
    CustomJS,
    Div,
    FileInput,
    RadioButtonGroup,
    Select,
    Slider,
    Spinner,
    Title,
)

from .._library import FaststripError
from .case import (
    CONTROL,
    CONTROLS,
    ENDINGS,
    STANDARD,
    Case,
    CaseError,
    Shape,
    read_shape,
    to_case,
    to_slider,
)
from .exporting import Program, Reference, case_files, numbers_csv, packed
from .figures import Pictures, time_text
from .look import HERTZ, NORM, SMALL, STRIPS, Look
from .solving import AXES, Outcome, Solver
from .wire import Direct, sender

LEFT = 258  # width of the controls, px
HALF = LEFT // 2 - 8
SIGNS = ("x ahead, y to the right (of a right wheel: to the field side), z down. Creepages: rail "
         "relative to wheel over the rolling speed; forces act on the rail. Yaw: nose to the "
         "right.")
METHODS = (("strips", STRIPS), ("hertz", HERTZ), ("norm", NORM))
# Symbol, unit, attribute, what one unit is, format, estimated error and what it is a part of.
ROWS = (("penetration", "mm", "penetration", 1.0, ".4f", "est_err_penetration"),
        ("contact area", "mm²", "area", 1.0, ".1f", "est_err_area"),
        ("maximum pressure", "MPa", "pmax", 1.0, ".0f", "est_err_pmax"),
        ("Fx", "kN", "fx", 1e3, ".3f", "est_err_fx"),
        ("Fy", "kN", "fy", 1e3, ".3f", "est_err_fy"),
        ("Mz", "N m", "mz", 1e3, ".2f", "est_err_mz"),
        ("T gamma", "N", "friction_power", 1.0, ".2f", None),
        ("adhesion", "%", "stick_fraction", 1e-2, ".0f", None))
# The name of the file stands in the list above.
FILE_STYLE = "input { color: transparent; } input::file-selector-button { width: 100%; }"
NUMBER_STYLE = "input { padding: 0 2px 0 6px !important; font-size: 12px; }"
DOWNLOAD = """
const {name, content, type} = Object.fromEntries(
    Object.entries(cb_obj.data).map(([key, values]) => [key, values[0]]))
if (name == null) return
const bytes = Uint8Array.from(atob(content), (letter) => letter.charCodeAt(0))
const link = document.createElement('a')
link.href = URL.createObjectURL(new Blob([bytes], {type}))
link.download = name
link.click()
setTimeout(() => URL.revokeObjectURL(link.href), 10000)
"""
# The same figures once more, drawn as SVG out of sight, and saved when they are done.
DRAW_SVG = """
const draw = async (item) => {
  const place = document.createElement('div')
  place.style.cssText = 'position: absolute; left: -10000px; top: 0'
  document.body.appendChild(place)
  const views = await Bokeh.embed.embed_item(item, place)
  const view = views.roots[0]
  await view.ready
  const text = view.export('svg').ctx.get_serialized_svg(true)
  const link = document.createElement('a')
  link.href = URL.createObjectURL(new Blob([text], {type: 'image/svg+xml'}))
  link.download = 'explore.svg'
  link.click()
  setTimeout(() => { URL.revokeObjectURL(link.href); view.remove(); place.remove() }, 2000)
}
const [item] = cb_obj.data.item
if (item != null) draw(JSON.parse(item))
"""


class Page:
    """What one tab shows, and what happens there."""

    def __init__(self, document: Document, case: Case) -> None:
        self.document = document
        self.solver = Solver()
        self.wire = sender()
        self.pictures = Pictures(self.wire)
        self.shapes: Dict[str, Dict[str, Shape]] = {
            kind: {**STANDARD[kind], getattr(case, kind).label: getattr(case, kind)}
            for kind in ("wheel", "rail")}
        self.outcome = Outcome(case)
        self.begun = case
        self.reference: Optional[Reference] = None
        self.run: Optional[Program] = None
        self.pending = False
        self._make_controls(case)
        self._make_texts()
        document.add_root(self._layout())
        document.title = "faststrip explore"
        if self.wire.on_ready is not None:
            document.js_on_event(DocumentReady, self.wire.on_ready)
        document.on_session_destroyed(self._leave)
        self.update()

    # What stands on the page

    def _make_controls(self, case: Case) -> None:
        self.selects: Dict[str, Select] = {}
        self.files: Dict[str, FileInput] = {}
        for kind in ("wheel", "rail"):
            self.selects[kind] = Select(
                title=f"{kind} profile", name=kind, width=HALF, margin=(0, 4, 0, 4),
                value=getattr(case, kind).label, options=list(self.shapes[kind]))
            self.selects[kind].on_change("value", self.changed)
            self.files[kind] = FileInput(
                name=f"{kind}_file", width=HALF, margin=(2, 4, 2, 4),
                stylesheets=[FILE_STYLE], accept=ENDINGS.replace(" ", ","),
                title=f"or drop a {kind} file")
            self.files[kind].on_change("value", lambda attr, old, new, kind=kind:
                                       self.document.add_next_tick_callback(
                                           lambda: self.take_file(kind)))
        self.sliders: Dict[str, Slider] = {}
        self.spinners: Dict[str, Spinner] = {}
        for control in CONTROLS:
            value = to_slider(control, getattr(case, control.name))
            title = control.title
            if control.name == "load" and not case.is_vertical:
                title = "normal force N"
            title += ("" if control.unit == "-" else f", {control.unit}")
            slider = Slider(start=control.low, end=control.high, step=control.step, value=value,
                            title=title, show_value=False, width=LEFT - 90, name=control.name,
                            margin=(0, 5, 0, 8))
            spinner = Spinner(low=control.low, high=control.high, step=control.step, value=value,
                              width=72, name=f"{control.name}_number", format="0.[0000]",
                              margin=(2, 0, 0, 0), stylesheets=[NUMBER_STYLE])
            slider.js_on_change("value", CustomJS(
                args={"other": spinner}, code="other.setv({value: this.value}, {sync: false})"))
            spinner.js_link("value", slider, "value")
            slider.on_change("value", self.changed)
            self.sliders[control.name], self.spinners[control.name] = slider, spinner
        self.axis = RadioButtonGroup(labels=[f"over {name}" for name in AXES], active=0,
                                     name="axis", width=230, margin=(2, 5, 4, 130))
        self.axis.on_change("active", self.changed)

    def _make_texts(self) -> None:
        self.status = Div(text='<div class="put" role="status"></div>', name="status", width=1000,
                          height=18, margin=(2, 0, 0, 4))
        self.table = Div(text='<div class="put"></div>', name="numbers", width=600, height=160,
                         margin=(0, 0, 0, 4))
        self.download = ColumnDataSource({"name": [], "content": [], "type": []}, name="download")
        self.download.js_on_change("data", CustomJS(code=DOWNLOAD))
        self.drawing = ColumnDataSource({"item": []}, name="drawing")
        self.drawing.js_on_change("data", CustomJS(code=DRAW_SVG))

    def _button(self, label: str, name: str, work: Callable[[], None], width: int) -> Button:
        button = Button(label=label, name=name, width=width, margin=(2, 4, 2, 4))
        button.on_click(lambda: work())
        return button

    def _layout(self) -> Any:
        self.norm = self._button("Solve by NORM + TANG", "solve_norm", self.start_norm, LEFT - 8)
        buttons = [
            row(self._button("Case (.nml)", "case", self.save_case, HALF),
                self._button("Numbers (.csv)", "csv", self.save_numbers, HALF)),
            row(self._button("Picture (.svg)", "svg", self.save_picture, HALF),
                self._button("Free rolling", "free", self.roll_freely, HALF)), self.norm]
        controls = column(
            Div(text="<b>faststrip</b>", height=18), row(*self.selects.values()),
            row(*self.files.values()),
            *(row(self.sliders[name], self.spinners[name]) for name in CONTROL), *buttons,
            Div(text=f'<div style="font-size:11px;color:#444;line-height:14px">{SIGNS}</div>',
                width=LEFT - 14, name="signs", margin=(8, 4, 0, 6)),
            width=LEFT, name="controls")
        self.grid = gridplot(self.pictures.rows(), toolbar_location=None)
        bottom = row(self.table, column(self.axis, self.pictures.times.figure))
        return row(controls, column(self.status, self.grid, bottom, self._hidden()), name="page")

    def _hidden(self) -> Any:
        """Sources that belong to no figure."""
        return Div(visible=False, name="hidden",
                   tags=[self.download, self.drawing, self.wire.text])

    # What happens

    def case(self) -> Case:
        """The case that the controls tell."""
        told: Dict[str, Any] = {name: to_case(CONTROL[name], slider.value)
                                for name, slider in self.sliders.items()}
        told.update((kind, self.shapes[kind][select.value])
                    for kind, select in self.selects.items())
        # What was said of the first rail is not said of another one.
        said = self.begun.given_inclination if told["rail"] is self.begun.rail else None
        return Case(**told, is_vertical=self.begun.is_vertical, given_inclination=said)

    def changed(self, attr: str, old: Any, new: Any) -> None:
        """Solve when what has come with this is in too."""
        if not self.pending:
            self.pending = True
            self.document.add_next_tick_callback(self.update)

    def update(self) -> None:
        """Solve, and show what is other than before."""
        self.pending = False
        case = self.case()
        self.outcome = self.solver.solve(case, list(AXES)[self.axis.active])
        if self.reference is not None and self.outcome.motion != self.reference_of:
            self.reference = None
        self.show()
        self.document.add_next_tick_callback(lambda: self.solver.prepare(case))

    def show(self) -> None:
        start = time.thread_time()
        outcome = self.outcome
        if self.reference is not None:
            outcome.answers["norm"] = self.reference.answer
            outcome.rows = self.reference
            outcome.times["norm"] = self.reference.seconds
        self.pictures.show(outcome)
        self.wire.write(self.table, table_of(outcome))
        outcome.times["pictures"] = time.thread_time() - start
        self.pictures.times.show(outcome.times)
        self.say()

    def say(self, trouble: str = "") -> None:
        """The line above the pictures: what is wrong, or how it ended."""
        text, colour = trouble, "#a0306a"
        if not trouble:
            text, colour = status_of(self.outcome)
        self.wire.write(self.status, (
            f'<div style="color:{colour};width:1000px;overflow:hidden;text-overflow:ellipsis;'
            f'white-space:nowrap">{html.escape(text)}</div>'))
        self.wire.send()

    def take_file(self, kind: str) -> None:
        """A file was chosen or dropped."""
        chosen = self.files[kind]
        if not chosen.value:
            return
        try:
            shape = read_shape(kind, str(chosen.filename), base64.b64decode(str(chosen.value)))
        except CaseError as problem:
            self.say(str(problem))
            return
        if shape.label in STANDARD[kind]:
            self.say(f"a file must not be called as a profile of the list: {shape.label}")
            return
        self.shapes[kind][shape.label] = shape
        select = self.selects[kind]
        select.options = list(self.shapes[kind])
        if select.value == shape.label:
            self.changed("value", "", "")
        select.value = shape.label

    def roll_freely(self) -> None:
        """Creepages of a wheelset that rolls freely at this displacement and yaw."""
        try:
            creepage = self.solver.free_rolling(self.case())
        except FaststripError as problem:
            self.say(str(problem))
            return
        beyond = []
        for name, value in zip(AXES, creepage):
            control = CONTROL[name]
            wanted = to_slider(control, value)
            slider = self.sliders[name]
            slider.value = min(max(round(wanted, 6), control.low), control.high)
            if slider.value != round(wanted, 6):
                beyond.append(f"{control.title} {wanted:.3g} {control.unit}")
        if beyond:
            self.say("beyond the sliders: " + ", ".join(beyond))

    def send(self, name: str, content: bytes, kind: str) -> None:
        """Let the browser save a file."""
        self.download.data = {"name": [name], "type": [kind],
                              "content": [base64.b64encode(content).decode("ascii")]}

    def save_case(self) -> None:
        name, content = packed(case_files(self.outcome))
        self.send(name, content, "application/octet-stream")

    def save_numbers(self) -> None:
        self.send("explore.csv", numbers_csv(self.outcome).encode("utf-8"), "text/csv")

    def save_picture(self) -> None:
        pictures = Pictures(Direct())
        pictures.show(self.outcome)
        pictures.times.show(self.outcome.times)
        for figure, text in zip(pictures.rows()[0], summary_of(self.outcome)):
            figure.add_layout(Title(text=text, text_font_size=SMALL, text_font_style="normal"),
                              "above")
        item = json_item(gridplot(pictures.rows(), toolbar_location=None))
        self.drawing.data = {"item": [json.dumps(item)]}

    # NORM + TANG, which takes as long as it takes

    def start_norm(self) -> None:
        """Start the program, or end it if it runs."""
        if self.run is not None:
            self.run.end()
            return
        if self.outcome.geometry is None:
            self.say("there is no contact that NORM + TANG could solve")
            return
        self.run = run = Program()
        self.norm.label = "NORM + TANG runs: end it"
        files, motion = case_files(self.outcome), self.outcome.motion

        def work() -> None:
            try:
                found: Any = run.reference(files)
            except (RuntimeError, ImportError, OSError, KeyError, ValueError) as problem:
                found = str(problem)
            self.document.add_next_tick_callback(lambda: self.take_norm(found, motion))

        threading.Thread(target=work, daemon=True).start()

    def take_norm(self, found: Any, motion: Any) -> None:
        """What came of NORM + TANG, if it still is of what the page shows."""
        self.run = None
        self.norm.label = "Solve by NORM + TANG"
        if isinstance(found, str):
            self.say(f"NORM + TANG: {found}")
        elif motion == self.outcome.motion:
            self.reference, self.reference_of = found, motion
            self.show()
        else:
            self.say("NORM + TANG has solved another case than the one shown now: "
                     f"{time_text(1e3 * found.seconds)}")

    def _leave(self, context: Any) -> None:
        if self.run is not None:
            self.run.end()


WORDS = {
    "ok": "ok: the estimated errors are small",
    "fallback_used": "a fixed lattice gave the answer: the ends of the patch did not converge",
    "edge_of_data": "the contact runs to the end of the profiles",
    "fewer_strips": "more strips did not converge",
    "overlap_left": "valleys overlap beside the patches",
    "flat_along_x": "the gap is nearly flat along x",
    "conformal": "the surfaces turn much within the contact: the half-space is doubtful",
    "under_resolved": "an estimated error is above its limit",
    "more_strips": "more strips than usual gave the answer",
}


def summary_of(outcome: Outcome) -> List[str]:
    """A case in three lines, for a picture that stands alone."""
    case = outcome.case
    numbers = {control.name: f"{to_slider(control, getattr(case, control.name)):g} {control.unit}"
               for control in CONTROLS}
    strips = outcome.answers.get("strips")
    word = strips.result.word if strips is not None and strips.result is not None else "no result"
    load = "Q" if case.is_vertical else "N"
    return [f"{case.wheel.label} on {case.rail.label}, y {numbers['shift']}, "
            f"yaw {numbers['yaw']}, {load} {numbers['load']}",
            ", ".join(f"{name} {numbers[name]}" for name in AXES) + f", mu {case.mu:g}",
            f"{STRIPS.label}: {word}"]


def status_of(outcome: Outcome) -> Any:
    """How it ended, in one line, and its colour."""
    if outcome.error:
        return outcome.error, "#a0306a"
    parts = []
    if outcome.case.is_as_it_lies:
        parts.append(f"{outcome.case.rail.label}: inclination 0, as the file has it")
    colour = "#222222"
    for name, look in METHODS:
        answer = outcome.answers.get(name)
        if answer is None:
            continue
        if answer.result is None:
            parts.append(f"{look.label}: {answer.error}")
        elif name == "strips" or answer.result.word != "ok":
            word = answer.result.word
            parts.append(f"{look.label}: {WORDS.get(word, word)}"
                         + (f" ({word})" if word != "ok" else ""))
        if name == "strips" and (answer.result is None or answer.result.word != "ok"):
            colour = "#a0306a"
    return "; ".join(parts), colour


def percent(part: float) -> str:
    """A part in percent, with two digits."""
    value = 100.0 * part
    return f"{value:.0f}" if value >= 10.0 else f"{value:.2g}"


def sample(look: Look) -> str:
    """A piece of the line of a method, or its mark."""
    if look is NORM:
        return (f'<svg width="10" height="8"><circle cx="5" cy="4" r="3" fill="white" '
                f'stroke="{look.colour}" stroke-width="1.4"/></svg>')
    dashes = {"solid": "", "dashed": "6 3"}[look.dash]
    return (f'<svg width="24" height="8"><line x1="0" x2="24" y1="4" y2="4" stroke="{look.colour}"'
            f' stroke-width="{look.width:g}" stroke-dasharray="{dashes}"/></svg>')


def table_of(outcome: Outcome) -> str:
    """The numbers of all methods, with their estimated errors."""
    cell = "padding:0 8px 0 0;text-align:right;white-space:nowrap"
    head = "".join(f'<th colspan="2" style="{cell};text-align:center">{sample(look)} '
                   f"{look.label}</th>" for _, look in METHODS)
    lines = [f'<tr><th style="text-align:left">(estimated errors)</th>{head}</tr>']
    for title, unit, attribute, scale, form, estimate in ROWS:
        cells: List[str] = []
        for name, _ in METHODS:
            answer = outcome.answers.get(name)
            result = answer.result if answer is not None else None
            value = getattr(result, attribute, None) if result is not None else None
            wrong = getattr(result, estimate, None) if result is not None and estimate else None
            cells.append(f'<td style="{cell}">'
                         + ("–" if value is None else f"{value / scale:{form}}") + "</td>"
                         + '<td style="padding:0 6px 0 0;color:#444">'
                         + ("" if wrong is None else f"({percent(wrong)} %)") + "</td>")
        lines.append(f'<tr><td style="padding-right:8px">{title}, {unit}</td>{"".join(cells)}</tr>')
    return ('<table style="font-size:11.5px;border-collapse:collapse;line-height:15px">'
            f'{"".join(lines)}</table>')
