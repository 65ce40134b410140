"""The frame of every plotting command: one line on stderr and exit 1 on bad input."""

from __future__ import annotations

import argparse
import os
import sys

from .tables import InputError

SWEEP = "out/sweep.csv"


def parser(description: str) -> argparse.ArgumentParser:
    """An argument parser that shows defaults."""
    return argparse.ArgumentParser(
        description=description, formatter_class=argparse.ArgumentDefaultsHelpFormatter
    )


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


def friction(text: str) -> float:
    """A coefficient of friction from the command line."""
    value = float(text)
    if not 0.0 < value < 10.0:
        raise ValueError(text)
    return value


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
