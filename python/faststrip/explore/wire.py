"""How changes come to the pictures: all of one update in one message.

Bokeh sends a message for each property of a model, and one more for each array, which takes longer
than to solve the contact. Here everything is collected into one text, and a few lines in the
browser hand it on to the models there. They tell the server nothing of it. These lines know the
insides of one version of Bokeh; with any other one changes go the way that it has for them.
"""

from __future__ import annotations

import base64
import json
from typing import Any, Dict, List, Optional, Protocol

import bokeh
import numpy as np
from bokeh.models import ColumnDataSource, CustomJS, Div, Model

KNOWN = "3.9."  # how the versions begin whose insides HAND_ON knows
# First what Bokeh does needlessly at each painting, for half of its time: it writes the same style
# sheets again, asks for colours that a style sheet may set, which those of this page do not, and
# for the size of letters, which stays.
# `text`: models and their properties; sources and their columns, places in `numbers` or lists;
# elements of pages and what stands in them.
HAND_ON = """
if (!Bokeh.is_spared) {
  Bokeh.is_spared = true
  const sheet = Bokeh.require('core/dom').InlineStyleSheet?.prototype
  if (sheet?._update) sheet._update = function(css) {
    if (this.el.textContent !== css) this.el.textContent = css
  }
  const visual = Bokeh.require('core/visuals/visual').VisualProperties?.prototype
  if (visual?._get_css_value) visual._get_css_value = () => ''
  const plot = Bokeh.require('models/plots/plot_canvas').PlotView?.prototype
  const size = plot && Object.getOwnPropertyDescriptor(plot, 'base_font_size')
  if (size?.get) Object.defineProperty(plot, 'base_font_size', {
    get() { return this.font_size_found ??= size.get.call(this) }})
}
// Bokeh gives documents that are made for export the callbacks of the page.
if (wire.document == null) return
const {set, data, html, numbers} = JSON.parse(wire.text)
const bytes = Uint8Array.from(atob(numbers), (letter) => letter.charCodeAt(0))
const all = new Float32Array(bytes.buffer)
const {document} = wire
const quietly = {sync: false}
for (const [id, properties] of set) document.get_model_by_id(id).setv(properties, quietly)
for (const [id, columns] of data) {
  const found = {}
  for (const [name, [first, after, list]] of Object.entries(columns))
    found[name] = list ?? all.slice(first, after)
  document.get_model_by_id(id).setv({data: found}, quietly)
}
for (const [id, text] of html) {
  const view = Bokeh.index.find_one_by_id(id)
  const place = view?.shadow_el.querySelector('.put')
  if (place != null) place.innerHTML = text
}
"""


class Out(Protocol):
    """Where changes of pictures go."""

    backend: str

    def set(self, model: Model, **properties: Any) -> None: ...

    def put(self, source: ColumnDataSource, data: Dict[str, Any]) -> None: ...


class Direct:
    """Changes that go straight to the models: of pictures that are drawn once, as SVG."""

    backend = "svg"

    def set(self, model: Model, **properties: Any) -> None:
        model.update(**properties)

    def put(self, source: ColumnDataSource, data: Dict[str, Any]) -> None:
        source.data = data


class Sender(Out, Protocol):
    """What the page tells its changes to."""

    text: Div
    on_ready: Optional[CustomJS]

    def write(self, place: Div, text: str) -> None: ...

    def send(self) -> None: ...


def sender() -> Sender:
    """The fast way, where this version of Bokeh is known, or else Bokeh's own."""
    return Wire() if bokeh.__version__.startswith(KNOWN) else Plain()


class Plain(Direct):
    """Changes that go straight to the models of a page."""

    backend = "canvas"

    def __init__(self) -> None:
        self.text = Div(text="", name="wire")
        self.on_ready: Optional[CustomJS] = None
        self._frames: Dict[str, str] = {}
        self._count = 0

    def write(self, place: Div, text: str) -> None:
        """What stands in an element of class ``put``."""
        frame = self._frames.setdefault(place.id, str(place.text))
        place.text = frame.replace("></div>", f">{text}</div>", 1)

    def send(self) -> None:
        """Let the browser know that all has come."""
        self._count += 1
        self.text.text = str(self._count)


class Wire:
    """Changes that are collected, and sent together."""

    backend = "canvas"

    def __init__(self) -> None:
        self.text = Div(text="", name="wire")
        code = CustomJS(args={"wire": self.text}, code=HAND_ON)
        self.text.js_on_change("text", code)
        self.on_ready: Optional[CustomJS] = code
        self._known: Dict[str, Dict[str, Any]] = {}
        self._clear()

    def _clear(self) -> None:
        self._set: List[Any] = []
        self._data: List[Any] = []
        self._html: List[Any] = []
        self._numbers: List[Any] = []
        self._n = 0

    def set(self, model: Model, **properties: Any) -> None:
        """Properties of a model, if they are others than before."""
        known = self._known.setdefault(model.id, {})
        new = {name: value for name, value in properties.items()
               if name not in known or known[name] != value}
        if new:
            known.update(new)
            self._set.append([model.id, new])

    def put(self, source: ColumnDataSource, data: Dict[str, Any]) -> None:
        """Columns of a source: numbers, or lists of texts."""
        columns: Dict[str, Any] = {}
        for name, values in data.items():
            if len(values) and isinstance(values[0], str):
                columns[name] = [0, 0, list(values)]
            else:
                numbers = np.asarray(values, dtype="<f4")
                columns[name] = [self._n, self._n + len(numbers)]
                self._numbers.append(numbers)
                self._n += len(numbers)
        self._data.append([source.id, columns])

    def write(self, place: Div, text: str) -> None:
        """What stands in an element of class ``put``, if it is other than before."""
        known = self._known.setdefault(place.id, {})
        if known.get("html") != text:
            known["html"] = text
            self._html.append([place.id, text])

    def send(self) -> None:
        """Let the browser have what was collected."""
        numbers = np.concatenate([np.empty(0, dtype="<f4"), *self._numbers])
        self.text.text = json.dumps(
            {"set": self._set, "data": self._data, "html": self._html,
             "numbers": base64.b64encode(numbers.tobytes()).decode("ascii")},
            separators=(",", ":"))
        self._clear()
