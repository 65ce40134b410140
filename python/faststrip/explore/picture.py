"""What all pictures of the explorer have in common: a frame, sources of data, a line of text."""

from __future__ import annotations

from typing import Any, Dict, List, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt
from bokeh.models import ColumnDataSource, HoverTool, Label, Range1d
from bokeh.plotting import figure

from .look import AXIS, FONT, GRID, NORM, SMALL
from .wire import Direct

Array = npt.NDArray[np.float64]
WIDTH, HEIGHT = 270, 180  # of a frame, in pixels
BORDERS = {"min_border_left": 58, "min_border_right": 8, "min_border_top": 4,
           "min_border_bottom": 6}
BESIDE_FRAME = BORDERS["min_border_left"] + BORDERS["min_border_right"]
LATER = "solved when the sliders rest"
NOTE = 14  # px: the line of text below the upper edge


def first_above(values: Sequence[float], value: float) -> float:
    """The first of rising numbers that is not below a value; else the value."""
    return next((one for one in values if one >= value), value)


class Picture:
    """A figure with its sources; ``key`` is what it was last drawn of."""

    def __init__(self, out: Direct, title: str, x_label: str, y_label: str, *,
                 span: int = 1, **options: Any) -> None:
        self.x_range = options.pop("x_range", None) or Range1d(-10.0, 10.0)
        self.y_range = options.pop("y_range", None) or Range1d(-7.0, 7.0)
        self.figure = figure(
            title=title, x_axis_label=x_label, y_axis_label=y_label,
            frame_width=span * WIDTH + (span - 1) * BESIDE_FRAME, frame_height=HEIGHT,
            x_range=self.x_range, y_range=self.y_range,
            output_backend=out.backend, toolbar_location=None, tools="",
            styles={"flex": "0 0 auto"}, **{**BORDERS, **options})
        self._style()
        self.name = options.get("name", type(self).__name__.lower())
        self.span = span  # how many columns of the page it takes
        self.out = out
        # What changes from case to case: a title would be laid out anew each time.
        self.note = Label(x=4, y=HEIGHT - NOTE, x_units="screen", y_units="screen", text="",
                          text_font_size=SMALL, text_color="black", background_fill_color="white",
                          background_fill_alpha=0.7)
        self.figure.add_layout(self.note)
        self.sources: Dict[str, ColumnDataSource] = {}
        self.key: Any = None

    def _style(self) -> None:
        plot = self.figure
        plot.title.text_font_size = FONT
        plot.title.text_color = "black"
        plot.grid.grid_line_color = GRID
        plot.outline_line_color = None
        plot.axis.axis_label_text_font_size = SMALL
        plot.axis.axis_label_text_font_style = "normal"
        plot.axis.axis_label_standoff = 3
        plot.axis.major_label_text_font_size = SMALL
        plot.axis.axis_line_color = plot.axis.major_tick_line_color = AXIS
        plot.axis.minor_tick_line_color = None
        plot.axis.axis_label_text_color = plot.axis.major_label_text_color = "black"

    def source(self, name: str, columns: str) -> ColumnDataSource:
        """A source with empty columns."""
        self.sources[name] = ColumnDataSource({column: [] for column in columns.split()},
                                              name=f"{self.name}_{name}")
        return self.sources[name]

    def put(self, name: str, data: Optional[Dict[str, Any]]) -> None:
        """New data of a source; none empties it."""
        source = self.sources[name]
        self.out.put(source, {column: [] for column in source.data} if data is None else data)

    def clear(self, text: str) -> None:
        """Nothing but a line."""
        for name in self.sources:
            self.put(name, None)
        self.tell(text)

    def tell(self, text: str) -> None:
        """The line in the picture."""
        self.out.set(self.note, text=text)

    def is_as_before(self, what: Any, *names: str) -> bool:
        """Is what these sources show the same as before? If not, and if there is none, they are
        emptied."""
        if self.key is what:
            return True
        self.key = what
        if what is None:
            for name in names:
                self.put(name, None)
        self.tell("" if what is not None else LATER)
        return False

    def set_range(self, side: Range1d, start: float, end: float) -> None:
        """Move a range."""
        self.out.set(side, start=start, end=end)

    def draw_norm(self, column: str) -> None:
        """A column over y as NORM is drawn."""
        self.figure.scatter("y", column, source=self.source("norm", f"y {column}"),
                            marker="circle", size=4, fill_color="white", line_color=NORM.colour,
                            line_width=1.4)

    def hover(self, renderer: Any, rows: List[Tuple[str, str]]) -> None:
        self.figure.add_tools(HoverTool(renderers=[renderer], tooltips=rows))
