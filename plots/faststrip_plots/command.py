"""The frame of every plotting command: one line on stderr and exit 1 on bad input."""

from __future__ import annotations

import argparse
import os
import sys

from .tables import InputError

SWEEP = {"sweep": ("out/sweep.csv", "what `faststrip sweep` wrote")}
STRIPS = {"strips": (None, "strips of the contact (default: out/strips_shift_MM.csv)")}
FIELDS = {"fields": (None, "fields of the contact (default: out/fields_shift_MM.csv)")}


def parser(description: str) -> argparse.ArgumentParser:
    """An argument parser that shows defaults."""
    return argparse.ArgumentParser(
        description=description, formatter_class=argparse.ArgumentDefaultsHelpFormatter
    )


def options(description, arguments, files, output=None, folder=None, more=None):
    """What a command was told: `files` are CSV files by their options, default and meaning of each,
    `output` default, kind and meaning of -o, `folder` default and meaning of --folder; `more` are
    other options, as the parser takes them."""
    made = parser(description)
    for name, (default, words) in files.items():
        made.add_argument(f"--{name}", default=default, metavar="CSV", help=words)
    for name, words in (more or {}).items():
        made.add_argument(f"--{name}", **words)
    if output:
        default, kind, words = output
        made.add_argument("-o", "--output", default=default, metavar=kind, help=words)
    if folder:
        made.add_argument("--folder", default=folder[0], metavar="FOLDER", help=folder[1])
    return made.parse_args(arguments)


def run(main, arguments=None) -> int:
    """Run a command; returns its exit status."""
    name = os.path.basename(sys.argv[0]) or "plots"
    try:
        main(arguments)
    except InputError as error:
        print(f"{name}: {error}", file=sys.stderr)
        return 1
    return 0


def shift_file(kind: str, shift: float) -> str:
    """Where the program leaves a file of one shift by default."""
    return f"out/{kind}_shift_{shift:g}.csv"


def png(default) -> tuple:
    """The option -o of a picture."""
    return default, "PNG", "picture to write"


def shift(what: str) -> dict:
    """The option --shift: a lateral shift of the wheel, and what it is for."""
    return {"shift": dict(type=float, default=0.0, metavar="MM", help=what)}


def friction(what: str) -> dict:
    """The option --mu: a coefficient of friction, and what of."""
    def value(text):
        found = float(text)
        if not 0.0 < found < 10.0:
            raise ValueError(text)
        return found

    value.__name__ = "friction"
    return {"mu": dict(type=value, default=0.3, metavar="MU", help=what)}


def report_failures(sweep) -> None:
    """Say on stdout how many rows of a sweep were skipped and why."""
    for method in sweep.methods:
        count = sum(method.failures.values())
        if count:
            why = ", ".join(f"{number} {status}" for status, number in method.failures.items())
            print(
                f"{method.normal} with {method.tangential}:"
                f" {count} of {len(method.yw)} rows without a result skipped ({why})"
            )
