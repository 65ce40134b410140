"""Commands that draw one picture of tables: their options, reading, saving."""

from __future__ import annotations

import os

from . import style
from .command import options, png
from .results import revision
from .tables import read_table


def command(description, output, folder=None, more=None, **inputs):
    """Makes a command of a function that draws a figure of some tables.

    `inputs` are tables by their options: default, what it is, and columns that must be there; with
    `folder` the option --folder says where `output` goes, without it -o names the file. `more` are
    other options, as the parser takes them, which the function gets by name. It gives the figure
    and a note on it.
    """

    def command_of(draw):
        def main(arguments=None):
            told = vars(options(
                description, arguments, {name: rest[:2] for name, rest in inputs.items()},
                png(output) if folder is None else None,
                folder and (folder, f"where {output} goes"), more))
            tables = [read_table(told[name], columns) for name, (_, _, columns) in inputs.items()]
            figure, note = draw(*tables, **{name: told[name] for name in more or ()})
            path = told["output"] if folder is None else os.path.join(told["folder"], output)
            save(figure, path, map(revision, tables), note)

        return main

    return command_of


def save(figure, path, stamps, note="", vector=False):
    """Write a picture and tell its name."""
    style.save(figure, path, stamps, note, vector)
    print(path)
