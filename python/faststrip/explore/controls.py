"""The controls of the explorer: a slider with a field for each number, profiles, buttons."""

from __future__ import annotations

from typing import Any, Dict, List

from bokeh.layouts import column, row
from bokeh.models import (
    CustomJS,
    Div,
    FileInput,
    Model,
    RadioButtonGroup,
    Select,
    Slider,
    TextInput,
)

from .case import CONTROLS, ENDINGS, Case, Control, Shape, to_slider

LEAST = 140  # px: of a frame with less columns than it would take
NUMBER_STYLE = "input { padding: 0 6px !important; font-size: 12px; }"
# The name of the file stands in the list above.
FILE_STYLE = ("input { color: transparent; width: 100%; border: 0; padding: 0; } "
              "input::file-selector-button { width: 100%; }")
REFUSED_STYLE = ":host { color: #a0306a; font-size: 11.5px; } .bk-clearfix { white-space: normal; }"
# Into the field: as it is written; from it: with a comma for a point, too, or refused beside it.
SHOW = """
field.setv({value: String(Number(cb_obj.value.toPrecision(10)))}, {sync: false})
refused.setv({visible: false}, {sync: false})
"""
TAKE = """
const text = cb_obj.value.trim().replace(',', '.').replace('\u2212', '-')
const value = Number(text)
const fits = text !== '' && (least <= value && value <= high || value === 0 && low <= 0)
if (!fits) refused.text = `must be ${range}, got ${cb_obj.value}`
refused.visible = !fits
const input = Bokeh.index.find_one_by_id(cb_obj.id)?.input_el
input?.setAttribute('aria-invalid', String(!fits))
if (fits && Number(slider.value.toPrecision(10)) !== value) slider.value = value
"""
# What the page shows in as many columns as fit: frames of one shape, words at their upper edges.
FIT = """
const fit = () => {
  const room = document.documentElement.clientWidth
  const wide = room > 700 ? room - left - 18 : room - 12
  const n = Math.max(1, Math.min(4, Math.floor(wide / (0.96 * (width + beside)))))
  const one = Math.floor(wide / n) - beside
  const high = Math.round(one * height / width)
  for (const [k, figure] of figures.entries()) {
    const span = Math.min(n, spans[k])
    const frame_width = span * one + (span - 1) * beside
    const frame_height = span < spans[k] ? Math.max(least, Math.round(high / spans[k])) : high
    if (figure.frame_width === frame_width && figure.frame_height === frame_height) continue
    figure.setv({frame_width, frame_height}, {sync: false})
    notes[k].setv({y: frame_height - below}, {sync: false})
    if (spans[k] > 1) {
      const {x_range, y_range} = figure
      const tall = (x_range.end - x_range.start) * frame_height / frame_width
      y_range.setv({start: y_range.end + tall}, {sync: false})
    }
  }
}
if (!window.fits) {
  window.fits = true
  addEventListener('resize', fit)
  for (const [name, label] of Object.entries(labels)) {
    const slider = Bokeh.index.find_one_by_id(sliders[name])
    slider?.shadow_el.querySelector('.noUi-handle')?.setAttribute('aria-label', label)
    Bokeh.index.find_one_by_id(inputs[name])?.input_el?.setAttribute('aria-label', label)
  }
}
fit()
"""


class Number:
    """A slider, a field that can be typed into, and a line for what is refused."""

    def __init__(self, control: Control, title: str, value: float) -> None:
        ends = {"low": control.low, "high": control.high, "range": control.range,
                "least": max(control.low, control.least)}
        self.slider = Slider(start=control.low, end=control.high, step=control.step, value=value,
                             title=title, show_value=False, sizing_mode="stretch_width",
                             name=control.name, margin=(0, 5, 0, 8))
        self.field = TextInput(value=f"{value:.10g}", width=72, name=f"{control.name}_number",
                               margin=(2, 4, 0, 0), stylesheets=[NUMBER_STYLE])
        refused = Div(render_as_text=True, visible=False, sizing_mode="stretch_width",
                      name=f"{control.name}_refused", margin=(0, 0, 0, 8),
                      stylesheets=[REFUSED_STYLE])
        self.slider.js_on_change("value", CustomJS(
            args={"field": self.field, "refused": refused}, code=SHOW))
        self.field.js_on_change("value", CustomJS(
            args={"slider": self.slider, "refused": refused, **ends}, code=TAKE))
        self.refusal = control.refusal
        self.told = Div(text='<div class="put" role="status"></div>', sizing_mode="stretch_width",
                        name=f"{control.name}_told", margin=(0, 0, 0, 8),
                        stylesheets=[REFUSED_STYLE])
        self.all = column(row(self.slider, self.field, sizing_mode="stretch_width"), refused,
                          *([self.told] if control.refusal else []),
                          sizing_mode="stretch_width", name=f"{control.name}_all")


class Controls:
    """All that a case is told by; `changed` is called when one has moved."""

    def __init__(self, case: Case, shapes: Dict[str, Dict[str, Shape]], changed: Any,
                 take_file: Any) -> None:
        self.view = RadioButtonGroup(labels=["one contact", "wheelset"], active=0, name="view",
                                     margin=(2, 4, 4, 4), sizing_mode="stretch_width")
        self.selects: Dict[str, Select] = {}
        self.files: Dict[str, FileInput] = {}
        for kind in ("wheel", "rail"):
            self.selects[kind] = Select(
                title=f"{kind} profile", name=kind, sizing_mode="stretch_width",
                margin=(0, 4, 0, 4), value=getattr(case, kind).label, options=list(shapes[kind]))
            self.selects[kind].on_change("value", changed)
            self.files[kind] = FileInput(
                name=f"{kind}_file", sizing_mode="stretch_width", margin=(2, 4, 2, 4),
                stylesheets=[FILE_STYLE], accept=ENDINGS.replace(" ", ","),
                title=f"or drop a {kind} file")
            self.files[kind].on_change("value", lambda attr, old, new, kind=kind: take_file(kind))
        self.load = RadioButtonGroup(
            labels=["vertical load Q", "normal force N"], active=0 if case.is_vertical else 1,
            name="load_direction", margin=(0, 4, 4, 4), sizing_mode="stretch_width")
        self.load.on_change("active", changed)
        self.planes = RadioButtonGroup(
            labels=["one plane", "a plane each strip"], active=int(case.is_curved), name="planes",
            margin=(0, 4, 4, 4), sizing_mode="stretch_width")
        self.planes.on_change("active", changed)
        self.numbers = {
            control.name: Number(control, control.label,
                                 to_slider(control, getattr(case, control.name, 0.0)))
            for control in CONTROLS}
        for number in self.numbers.values():
            number.slider.on_change("value", changed)

    def rows(self) -> List[Model]:
        """Everything below each other."""
        return [self.view, row(*self.selects.values(), sizing_mode="stretch_width"),
                row(*self.files.values(), sizing_mode="stretch_width"), self.load, self.planes,
                *(number.all for number in self.numbers.values())]

    def show(self, view: str) -> None:
        """Only what a view has."""
        for control in CONTROLS:
            self.numbers[control.name].all.visible = control.view in ("", view)
