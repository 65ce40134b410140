"""The page of one browser tab: sliders, pictures, numbers, downloads."""

from __future__ import annotations

import base64
import html
import json
import threading
import time
from typing import Any, Callable, Dict, List, Optional, Tuple, Union

from bokeh.document import Document
from bokeh.embed import json_item
from bokeh.events import DocumentReady
from bokeh.layouts import column, gridplot, row
from bokeh.models import (
    Button,
    ColumnDataSource,
    CustomJS,
    Div,
    RadioButtonGroup,
    Title,
)

from .._library import FaststripError
from .case import (
    CONTROL,
    STANDARD,
    Case,
    CaseError,
    Shape,
    read_shape,
    smoothed,
    to_case,
    to_slider,
)
from .controls import FIT, LEAST, Controls
from .exporting import Program, Reference, case_files, numbers_csv, packed
from .figures import Pictures, time_text
from .look import BAD, SMALL
from .picture import BESIDE_FRAME, HEIGHT, NOTE, WIDTH, Picture
from .solving import AXES, Outcome, Solver, Survey
from .tables import (
    status_of,
    summary_of,
    table_of,
    wheelset_status_of,
    wheelset_table_of,
)
from .wheelset import Functions, WheelsetOutcome, WheelsetSolver
from .wheelset_figures import WheelsetPictures
from .wire import Direct, sender

LEFT = 258  # width of the controls, px
VIEWS = "contact", "wheelset"
REST = 250  # ms without a change, then what takes longer is solved
SIGNS = ("x ahead, y to the right (of a right wheel: to the field side), z down. Creepages: rail "
         "relative to wheel over the rolling speed; forces act on the rail. Yaw: nose to the "
         "right.")
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
        self.solver, self.wheelsets = Solver(), WheelsetSolver()
        self.slow, self.slow_wheelsets = Solver(), WheelsetSolver()  # of the other thread
        self.wire = sender()
        self.pictures = Pictures(self.wire)
        self.wheelset_pictures = WheelsetPictures(self.wire)
        self.shapes: Dict[str, Dict[str, Shape]] = {
            kind: {**STANDARD[kind], getattr(case, kind).label: getattr(case, kind)}
            for kind in ("wheel", "rail")}
        self.outcome = Outcome(case)
        self.wheelset = WheelsetOutcome(case)
        self.survey = Survey()
        self.functions: Union[None, str, Functions] = None
        self.begun = case
        self.reference: Optional[Reference] = None
        self.run: Optional[Program] = None
        self.pending = self.is_slow = self.is_ready = False
        self.rest: Any = None
        self.controls = Controls(case, self.shapes, self.changed, lambda kind:
                                 document.add_next_tick_callback(lambda: self.take_file(kind)))
        self.controls.view.on_change("active", self.turn)
        self._make_texts()
        document.add_root(self._layout())
        document.title = "faststrip explore"
        for script in (self.wire.on_ready, self._fit()):
            if script is not None:
                document.js_on_event(DocumentReady, script)
        document.on_event(DocumentReady, self.be_ready)
        document.on_session_destroyed(self._leave)
        self.turn("active", 0, 0)

    # What stands on the page

    def _make_texts(self) -> None:
        self.axis = RadioButtonGroup(labels=[f"over {name}" for name in AXES], active=0,
                                     name="axis", margin=(2, 4, 4, 4),
                                     sizing_mode="stretch_width")
        self.axis.on_change("active", self.changed)
        self.status = Div(text='<div class="put" role="status"></div>', name="status",
                          sizing_mode="stretch_width", margin=(2, 0, 0, 4),
                          styles={"min-height": "18px"})
        self.tables = {view: Div(
            text='<div class="put" tabindex="0"></div>', name=f"{view}_numbers",
            margin=(0, 0, 0, 4), styles={"max-width": "calc(100% - 8px)", "overflow-x": "auto"})
            for view in VIEWS}
        self.download = ColumnDataSource({"name": [], "content": [], "type": []}, name="download")
        self.download.js_on_change("data", CustomJS(code=DOWNLOAD))
        self.drawing = ColumnDataSource({"item": []}, name="drawing")
        self.drawing.js_on_change("data", CustomJS(code=DRAW_SVG))

    def _button(self, label: str, name: str, work: Callable[[], None]) -> Button:
        button = Button(label=label, name=name, sizing_mode="stretch_width", margin=(2, 4, 2, 4))
        button.on_click(lambda: work())
        return button

    def _layout(self) -> Any:
        def beside(*models: Any) -> Any:
            return row(*models, sizing_mode="stretch_width")

        self.norm = self._button("Solve by NORM + TANG", "solve_norm", self.start_norm)
        colours = Button(label="dark / light", name="scheme", width=90, margin=(0, 4, 0, 4))
        colours.js_on_click(CustomJS(code="turn()"))
        # What one contact has and a wheelset has not.
        self.own = column(
            Div(text="creep curve", height=14, margin=(0, 4, 0, 8)), self.axis,
            beside(self._button("Case (.nml)", "case", self.save_case),
                   self._button("Numbers (.csv)", "csv", self.save_numbers)),
            self._button("Free rolling", "free", self.roll_freely), self.norm,
            sizing_mode="stretch_width", name="own")
        controls = column(
            beside(Div(text="<b>faststrip</b>", sizing_mode="stretch_width"), colours),
            *self.controls.rows(), self.own,
            self._button("Picture (.svg)", "svg", self.save_picture),
            Div(text=f'<div style="font-size:11px;color:#444;line-height:14px">{SIGNS}</div>',
                sizing_mode="stretch_width", name="signs", margin=(8, 4, 0, 6)),
            name="controls", styles={"flex": "0 0 var(--left)", "min-width": "0"})
        all_pictures: Dict[str, List[Picture]] = {
            "contact": self.pictures.all(), "wheelset": self.wheelset_pictures.all()}
        self.grids = {view: row(*(one.figure for one in pictures), self.tables[view],
                                name=f"{view}_view",
                                styles={"flex-wrap": "wrap", "align-items": "flex-start"})
                      for view, pictures in all_pictures.items()}
        shown = column(self.status, *self.grids.values(), self._hidden(),
                       styles={"flex": "1 1 var(--right)", "min-width": "0"}, name="shown")
        return row(controls, shown, name="page",
                   styles={"flex-wrap": "wrap", "align-items": "flex-start", "width": "100%"})

    def _fit(self) -> CustomJS:
        """As many columns of pictures as there is width for."""
        pictures: List[Picture] = [*self.pictures.all(), *self.wheelset_pictures.all()]
        numbers = self.controls.numbers
        return CustomJS(code=FIT, args={
            "figures": [one.figure for one in pictures], "notes": [one.note for one in pictures],
            "spans": [one.span for one in pictures], "left": LEFT, "width": WIDTH,
            "height": HEIGHT, "beside": BESIDE_FRAME, "below": NOTE, "least": LEAST,
            "labels": {name: CONTROL[name].label for name in numbers},
            "sliders": {name: one.slider.id for name, one in numbers.items()},
            "inputs": {name: one.field.id for name, one in numbers.items()}})

    def _hidden(self) -> Any:
        """Sources that belong to no figure."""
        return Div(visible=False, name="hidden",
                   tags=[self.download, self.drawing, self.wire.text])

    # What happens

    @property
    def view(self) -> str:
        """Which of the views is shown."""
        return VIEWS[self.controls.view.active or 0]

    def turn(self, attr: str, old: Any, new: Any) -> None:
        """Show another view."""
        for view, grid in self.grids.items():
            grid.visible = view == self.view
        self.own.visible = self.view == "contact"
        self.controls.show(self.view)
        self.update()

    def case(self) -> Case:
        """The case that the controls tell."""
        told: Dict[str, Any] = {name: to_case(CONTROL[name], number.slider.value)
                                for name, number in self.controls.numbers.items()}
        wavelength = told.pop("smoothing")
        told.update((kind, smoothed(kind, self.shapes[kind][select.value], wavelength))
                    for kind, select in self.controls.selects.items())
        # What was said of the first rail is not said of another one.
        is_first = self.shapes["rail"][self.controls.selects["rail"].value] is self.begun.rail
        return Case(**told, is_vertical=self.controls.load.active == 0,
                    is_curved=self.controls.planes.active == 1,
                    given_inclination=self.begun.given_inclination if is_first else None)

    def changed(self, attr: str, old: Any, new: Any) -> None:
        """Solve when what has come with this is in too."""
        if not self.pending:
            self.pending = True
            self.document.add_next_tick_callback(self.update)

    def update(self) -> None:
        """Solve, and show what is other than before."""
        self.pending = False
        try:
            case = self.case()
        except CaseError as problem:
            self.say(str(problem))
            return
        if self.view == "wheelset":
            self.wheelset = self.wheelsets.solve(case)
        else:
            self.outcome = self.solver.solve(case, list(AXES)[self.axis.active or 0])
            if self.reference is not None and self.outcome.motion != self.reference_of:
                self.reference = None
        self.show(rests=not self.is_ready)
        self.wait()

    def show(self, rests: bool = True) -> None:
        """Show what was solved; only when the sliders rest what it took and what takes longer."""
        start = time.thread_time()
        if self.view == "wheelset":
            self.wheelset_pictures.show(self.wheelset, self.functions)
            self.wire.write(self.tables["wheelset"], wheelset_table_of(self.wheelset))
            self.say()
            return
        outcome = self.outcome
        if self.reference is not None:
            outcome.answers["norm"] = self.reference.answer
            outcome.rows = self.reference
            outcome.times["norm"] = self.reference.seconds
        self.pictures.show(outcome, self.survey.still(outcome.case, outcome.axis), rests)
        self.wire.write(self.tables["contact"], table_of(outcome))
        outcome.times["pictures"] = time.thread_time() - start
        if rests:
            self.pictures.times.show({**outcome.times, **self.slow.times})
        self.say()

    def say(self, trouble: str = "") -> None:
        """The line above the pictures: what is wrong, or how it ended."""
        text, colour = trouble, BAD
        if not trouble:
            text, colour = (wheelset_status_of(self.wheelset) if self.view == "wheelset"
                            else status_of(self.outcome))
        self.wire.write(self.status, f'<div style="color:{colour}">{html.escape(text)}</div>')
        for number in self.controls.numbers.values():
            if number.refusal:
                self.wire.write(number.told, html.escape(text) if number.refusal in text else "")
        self.wire.send()

    # What takes longer, in a thread of its own once the sliders rest

    def wait(self) -> None:
        """Wait until the sliders rest, in a browser that has what was shown first."""
        if self.rest is not None:
            self.document.remove_timeout_callback(self.rest)
        self.rest = (self.document.add_timeout_callback(self.start_slow, REST)
                     if self.is_ready else None)

    def be_ready(self, event: Any) -> None:
        """The browser has all."""
        self.is_ready = True
        self.wait()

    def start_slow(self) -> None:
        """Solve sweep and map, or contact functions, of what is shown."""
        self.rest = None
        self.show()
        if self.is_slow:
            return
        self.is_slow = True
        of = self.shown()

        def work() -> None:
            view, case, axis = of
            steps = ([self.slow_wheelsets.functions(case)] if view == "wheelset"
                     else self.slow.survey(case, axis))
            for found in steps:
                self.document.add_next_tick_callback(
                    lambda found=found: self.take_slow(of, found))
                if self.shown() != of:
                    break
            self.document.add_next_tick_callback(lambda: self.end_slow(of))

        threading.Thread(target=work, daemon=True).start()

    def shown(self) -> Tuple[str, Case, str]:
        """What the page is of now."""
        view = self.view
        return (view, self.wheelset.case if view == "wheelset" else self.outcome.case,
                self.outcome.axis)

    def take_slow(self, of: Tuple[str, Case, str], found: Any) -> None:
        """Show what was found, as far as it is of what is shown."""
        if of[0] == "wheelset":
            self.functions = found
        else:
            self.survey = found
        if of[0] == self.view:
            self.show()

    def end_slow(self, of: Tuple[str, Case, str]) -> None:
        """Go on if something else is shown by now."""
        self.is_slow = False
        if self.shown() != of and self.rest is None:
            self.start_slow()

    def take_file(self, kind: str) -> None:
        """A file was chosen or dropped."""
        chosen = self.controls.files[kind]
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
        select = self.controls.selects[kind]
        select.options = list(self.shapes[kind])
        if select.value == shape.label:
            self.changed("value", "", "")
        select.value = shape.label

    def roll_freely(self) -> None:
        """Creepages of a wheelset that rolls freely at this displacement and yaw."""
        try:
            creepage = self.solver.free_rolling(self.case())
        except (FaststripError, CaseError) as problem:
            self.say(str(problem))
            return
        beyond = []
        for name, value in zip(AXES, creepage):
            control = CONTROL[name]
            wanted = to_slider(control, value)
            slider = self.controls.numbers[name].slider
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
        self.send(*packed(case_files(self.outcome)), "application/octet-stream")

    def save_numbers(self) -> None:
        self.send("explore.csv", numbers_csv(self.outcome).encode("utf-8"), "text/csv")

    def save_picture(self) -> None:
        if self.view == "wheelset":
            wheelset = WheelsetPictures(Direct())
            wheelset.show(self.wheelset, self.functions)
            case, shown, columns = self.wheelset.case, wheelset.all(), 1
        else:
            pictures = Pictures(Direct())
            pictures.show(self.outcome, self.survey.still(self.outcome.case, self.outcome.axis))
            pictures.times.show(self.outcome.times)
            case, shown, columns = self.outcome.case, pictures.all(), 3
        figures = [one.figure for one in shown]
        for figure, text in zip(figures, summary_of(case, None if self.view == "wheelset" else
                                                    self.outcome)):
            figure.add_layout(Title(text=text, text_font_size=SMALL, text_font_style="normal"),
                              "above")
        item = json_item(gridplot(figures, ncols=columns, toolbar_location=None))
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
        files, motion = case_files(self.outcome), self.outcome.motion
        self.run = run = Program()
        self.norm.label = "NORM + TANG runs: end it"

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
