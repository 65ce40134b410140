"""How changes come to the pictures: all of one update in one message.

Bokeh sends a message for each property of a model, and one more for each array, which takes longer
than to solve the contact. Here everything is collected into one text, and a few lines in the
browser hand it on to the models there. They tell the server nothing of it. These lines know the
insides of one version of Bokeh; with any other one changes go the way that it has for them.
"""

from __future__ import annotations

import base64
import json
from typing import Any, Dict, List, Optional

import bokeh
import numpy as np
from bokeh.models import ColumnDataSource, CustomJS, Div, Model

KNOWN = "3.9."  # how the versions begin whose insides HAND_ON knows
# What Bokeh does needlessly at each painting, for more than half of its time. It writes the same
# style sheets again; it asks for colours that a style sheet may set, which those of this page do
# not, and for the size of letters, which stays; it takes the columns of a source for five looks of
# a glyph, of which the page has one, as nothing is selected; it places empty elements where it has
# drawn, and asks where the legend stands; and it draws axes letter by letter, which are the same
# until a range is another one: these are kept as images.
SPARE = """
if (!Bokeh.is_spared) {
  Bokeh.is_spared = true
  const sheet = Bokeh.require('core/dom').InlineStyleSheet.prototype
  sheet._update = function(css) {
    if (this.written !== css) this.el.textContent = this.written = css
  }
  const visual = Bokeh.require('core/visuals/visual').VisualProperties.prototype
  visual._get_css_value = () => ''
  const replace = (prototype, name, get) => {
    const old = Object.getOwnPropertyDescriptor(prototype, name).get
    Object.defineProperty(prototype, name, {get() { return get(this, old) }})
  }
  const plot = Bokeh.require('models/plots/plot_canvas').PlotView.prototype
  replace(plot, 'base_font_size', (view, old) => view.size_found ??= old.call(view))
  const glyphs = Bokeh.require('models/renderers/glyph_renderer').GlyphRendererView.prototype
  glyphs.map_data = function() { this.glyph.map_data() }
  glyphs.set_visuals = async function() {
    this.glyph.set_visuals(this.model.data_source, this.all_indices)
    this.glyph.after_visuals()
    await this.glyph.after_lazy_visuals()
  }
  glyphs.set_data = async function(indices) {
    const {view, data_source} = this.model
    this.all_indices = view.indices
    await this.glyph.set_data(data_source, this.all_indices, indices)
    await this.set_visuals()
    this._update_masked_indices()
    this.plot_view.invalidate_dataranges = true
  }
  const renderer = Bokeh.require('models/renderers/renderer').RendererView.prototype
  renderer.update_position = () => {}
  const legend = Bokeh.require('models/annotations/legend').LegendView.prototype
  const place = legend.update_position
  legend.update_position = function() {
    const {x, y, width, height} = this.plot_view.frame.bbox
    const key = [x, y, width, height].join()
    if (this.placed_in === key && this._bbox.width > 0) return
    this.placed_in = key
    place.call(this)
  }
  const axis = Bokeh.require('models/axes/axis').AxisView.prototype
  const shown = ({ranges, model}) =>
    [...ranges.flatMap(({start, end}) => [start, end]), model.axis_label].join()
  replace(axis, 'extents', (view, old) => {
    const key = shown(view)
    if (view.extents_of !== key) {
      view.extents_found = old.call(view)
      view.extents_of = key
    }
    return view.extents_found
  })
  const paint = axis._paint
  axis._paint = function(ctx) {
    const {canvas, layer} = ctx
    if (layer?.backend !== 'canvas') { paint.call(this, ctx); return }
    const {x, y, width, height} = this.bbox
    const key = [shown(this), x, y, width, height, canvas.width, canvas.height].join()
    if (this.image_of !== key) {
      const image = this.image ??= window.document.createElement('canvas')
      image.width = canvas.width
      image.height = canvas.height
      const own = image.getContext('2d')
      own.layer = layer
      own.setTransform(ctx.getTransform())
      paint.call(this, own)
      this.image_of = key
    }
    ctx.save()
    ctx.resetTransform()
    ctx.drawImage(this.image, 0, 0)
    ctx.restore()
  }
}
"""
# `text`: models and their properties; sources and their columns, places in `numbers` or lists;
# elements of pages and what stands in them.
HAND_ON = SPARE + """
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


class Direct:
    """Where changes of pictures go: straight to the models, of pictures that are drawn once, as
    SVG."""

    backend = "svg"

    def set(self, model: Model, **properties: Any) -> None:
        model.update(**properties)

    def put(self, source: ColumnDataSource, data: Dict[str, Any]) -> None:
        source.data = data


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


class Wire(Plain):
    """Changes that are collected, and sent together."""

    def __init__(self) -> None:
        super().__init__()
        self.on_ready = CustomJS(args={"wire": self.text}, code=HAND_ON)
        self.text.js_on_change("text", self.on_ready)
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


def sender() -> Plain:
    """The fast way, where this version of Bokeh is known, or else Bokeh's own."""
    return Wire() if bokeh.__version__.startswith(KNOWN) else Plain()
