#!/usr/bin/env python3
"""Print columns of a CSV file of the program to read: a table, or name by name if it is one row."""

import argparse
import math
import sys

from faststrip_plots import command
from faststrip_plots.tables import InputError, read_table


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file", metavar="FILE.csv", help="what the program wrote")
    parser.add_argument("columns", nargs="*", metavar="COLUMN",
                        help="names of columns (default: all that are not empty)")
    parser.add_argument("--where", action="append", default=[], metavar="COLUMN=WORD",
                        help="only rows with this word or number in a column")
    parser.add_argument("--digits", type=int, default=4, choices=range(1, 18), metavar="N",
                        help="significant digits (default: 4)")
    options = parser.parse_args(arguments)
    table = read_table(options.file, options.columns)
    rows = [row for row in range(len(table))
            if all(is_there(table, condition, row) for condition in options.where)]
    if not rows:
        raise InputError(f"no row with {' and '.join(options.where)} ({options.file})")
    names = options.columns or [name for name, cells in table.columns.items()
                                if any(cells[row] for row in rows)]
    cells = [[shown(table.words(name)[row], options.digits) for name in names] for row in rows]
    if len(cells) == 1 and len(names) > 1:
        print(aligned(list(zip(names, cells[0])), [False, False]))
    else:
        print(aligned([names, *cells], [is_number(column) for column in zip(*cells)]))


def is_there(table, condition, row):
    """Has a row what `COLUMN=WORD` wants?"""
    name, sign, wanted = condition.partition("=")
    if not sign:
        raise InputError(f"--where takes COLUMN=WORD, got {condition}")
    cell = table.words(name)[row]
    try:
        return cell == wanted or float(cell) == float(wanted)
    except ValueError:
        return False


def shown(cell, digits):
    """A number with a point in few digits, all else as it stands."""
    if not is_number([cell]) or not set(cell) & set(".eE"):
        return cell or "-"
    number = float(cell) + 0.0
    if number == 0.0 or not 1e-4 <= abs(number) < 1e7:
        return f"{number:.{digits - 1}e}" if number else "0."
    before = math.floor(math.log10(abs(number))) + 1
    return f"{number:#.{max(digits - before, 0)}f}"


def is_number(cells):
    try:
        return all(float(cell) is not None for cell in cells if cell not in ("", "-"))
    except ValueError:
        return False


def aligned(lines, right):
    """Lines of cells as text: columns of numbers to the right, of words to the left."""
    widths = [max(map(len, column)) for column in zip(*lines)]
    return "\n".join("  ".join(
        cell.rjust(width) if number else cell.ljust(width)
        for cell, width, number in zip(line, widths, right)).rstrip() for line in lines)


if __name__ == "__main__":
    sys.exit(command.run(main))
