#!/usr/bin/env python3
"""Draw the architecture: the one way of a case, step by step, through the rooms of the sources.

The steps and their modules are those of the table of docs/architecture.md; the rooms and their
sizes are read from the sources: modules, and lines of code without blank ones and comments.
"""

import pathlib
import re
import sys

from matplotlib.patches import Rectangle

from faststrip_plots import command, picture, style

ROOT = pathlib.Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "architecture.md"
CORE = ROOT / "src" / "faststrip"
# From the top down, as the rooms import each other.
ROOMS = ("command", "tabulate", "kalker", "files", "interop", "wheelset", "contact", "tangential",
         "normal", "geometry", "influence", "lookup", "numerics", "base")
FOLDERS = {"command": ROOT / "app" / "command", "kalker": ROOT / "src" / "kalker",
           "files": ROOT / "src" / "files", "tabulate": ROOT / "src" / "tabulate"}
STEP = re.compile(r"(?m)^\| (\d+) \| (.+?) \| (.+?) \|$")
TONES = {"core": "#dfe8f1", "other": "#efe6d5", "step": "#0b5c8e"}


def steps(text=None):
    """Number, words and modules of each step of the page."""
    text = PAGE.read_text(encoding="utf-8") if text is None else text
    return [(int(number), words, re.findall(r"`([\w/]+)`", modules))
            for number, words, modules in STEP.findall(text)]


def sources(room):
    folder = FOLDERS.get(room, CORE / room)
    return [path for path in sorted(folder.rglob("*.f90"))
            if "build" not in path.relative_to(ROOT).parts]


def lines(room):
    """Lines of code of a room: no blank ones, no comments."""
    return sum(bool(line.strip()) and not line.lstrip().startswith("!")
               for path in sources(room)
               for line in path.read_text(encoding="utf-8").splitlines())


def room_of(module):
    """The room that a module of the page is in: the first part of its path that is one."""
    return next(room for room in ROOMS if room in module.split("/"))


def main(arguments=None):
    options = command.options(__doc__, arguments, {}, command.png("out/architecture.png"))
    way = steps()
    figure = style.new_figure(10.0, 6.6)
    axes = figure.subplots()
    axes.set_axis_off()
    axes.set(xlim=(0.0, 10.0), ylim=(-0.3, len(ROOMS) + 0.7))
    middles = {}
    for k, room in enumerate(reversed(ROOMS)):
        height = k + 0.5
        middles[room] = height
        axes.add_patch(Rectangle((6.2, height - 0.4), 3.6, 0.8, edgecolor="none",
                                 facecolor=TONES["other" if room in FOLDERS else "core"]))
        axes.text(6.35, height, room, va="center", fontweight="bold")
        axes.text(9.65, height, f"{len(sources(room))} modules, {lines(room):,} lines", va="center",
                  ha="right", fontsize=8)
    top = len(ROOMS) + 0.3
    axes.text(6.2, top, "Rooms: each imports from below", fontweight="bold")
    axes.text(0.1, top, "The one way of a case", fontweight="bold")
    gap = len(ROOMS) / len(way)
    for number, words, modules in way:
        height = len(ROOMS) - (number - 0.5) * gap
        axes.text(0.25, height, str(number), color="white", ha="center", va="center", fontsize=9,
                  bbox={"boxstyle": "circle", "facecolor": TONES["step"], "edgecolor": "none"})
        axes.text(0.6, height + 0.17, words.replace("`", ""), va="center", fontsize=9)
        axes.text(0.6, height - 0.19, ", ".join(modules), va="center", fontsize=7,
                  color=style.GREY)
        for room in dict.fromkeys(map(room_of, modules)):
            axes.plot((4.3, 6.15), (height, middles[room]), color=TONES["step"], alpha=0.6,
                      linewidth=1.0)
    picture.save(figure, options.output, ["docs/architecture.md and the sources"],
                 "blue: the embeddable core; sand: packages above it")


if __name__ == "__main__":
    sys.exit(command.run(main))
