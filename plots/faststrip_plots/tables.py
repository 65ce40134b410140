"""Reading CSV tables: `#` lines of metadata, one header row, one quantity per column."""

from __future__ import annotations

import csv
import math
import os
from collections.abc import Iterable

import numpy as np


class InputError(Exception):
    """Bad input; the message is one line naming the file and, where known, line and column."""


class Table:
    """A CSV file as read: text cells by column name, and where each row stood in the file."""

    def __init__(self, path, comments, header_line, columns, lines):
        self.path = path
        self.comments = comments
        self.header_line = header_line
        self.columns = columns
        self.lines = lines

    def __len__(self):
        return len(self.lines)

    def require(self, names: Iterable[str]) -> None:
        """Raise `InputError` unless every column is there."""
        for name in names:
            if name not in self.columns:
                raise InputError(f"missing column: {name} ({self.path}:{self.header_line})")

    def words(self, name: str) -> list[str]:
        """The cells of a column as text without surrounding blanks."""
        self.require([name])
        return self.columns[name]

    def where(self, name: str, wanted: Iterable[str]) -> Table:
        """The rows whose word in a column is one of those wanted; all if there is no column."""
        if name not in self.columns:
            return self
        kept = [row for row, word in enumerate(self.columns[name]) if word in wanted]
        columns = {key: [cells[row] for row in kept] for key, cells in self.columns.items()}
        return Table(self.path, self.comments, self.header_line, columns,
                     [self.lines[row] for row in kept])

    def numbers(self, name: str, missing: bool = False) -> np.ndarray:
        """The cells of a column as finite numbers; empty cells become NaN where `missing`."""
        return np.array(
            [
                self._number(name, text, line, missing)
                for text, line in zip(self.words(name), self.lines)
            ],
            dtype=float,
        )

    def positive(self, name: str, missing: bool = False) -> np.ndarray:
        """The same, all above zero."""
        values = self.numbers(name, missing)
        for value, line in zip(values, self.lines):
            if value <= 0.0:
                raise InputError(f"{name} must be above zero, got {value:g} ({self.path}:{line})")
        return values

    def one_of(self, name: str, known: Iterable[str]) -> list[str]:
        """The cells of a column, each of which is one of the words known."""
        for word, line in zip(self.words(name), self.lines):
            if word not in known:
                raise InputError(
                    f"{name} must be one of {', '.join(known)}, got {word} ({self.path}:{line})")
        return self.words(name)

    def _number(self, name, text, line, missing):
        if text == "":
            if missing:
                return math.nan
            raise InputError(f"{name} must be a number, got an empty cell ({self.path}:{line})")
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not math.isfinite(value) or "_" in text:
            raise InputError(f"{name} must be a finite number, got {text} ({self.path}:{line})")
        return value


def read_table(path: str, names: Iterable[str] = ()) -> Table:
    """Read a CSV file that must hold the columns `names` and at least one row of data."""
    comments, header, rows, lines = [], None, [], []
    header_line = 0
    for number, line in enumerate(_lines(path), start=1):
        text = line.strip()
        if text.startswith("#"):
            comments.append(text.lstrip("#").strip())
        elif text and header is None:
            header, header_line = _cells(text), number
            _check_header(header, path, number)
        elif text:
            cells = _cells(text)
            if len(cells) != len(header):
                raise InputError(
                    f"a row must have {len(header)} cells as the header, got {len(cells)}"
                    f" ({path}:{number})"
                )
            rows.append(cells)
            lines.append(number)
    if header is None:
        raise InputError(f"no header row, the file is empty: {path}")
    columns = {name: [row[k] for row in rows] for k, name in enumerate(header)}
    table = Table(path, comments, header_line, columns, lines)
    table.require(names)
    if not rows:
        raise InputError(f"no row of data below the header: {path}")
    return table


def _lines(path):
    try:
        with open(path, encoding="utf-8", newline=None) as stream:
            return stream.read().splitlines()
    except FileNotFoundError:
        raise InputError(f"no such file: {path}") from None
    except UnicodeDecodeError:
        raise InputError(f"not a text file: {path}") from None
    except OSError as error:
        raise InputError(f"cannot read: {path} ({os.strerror(error.errno)})") from None


def _cells(text):
    return [cell.strip() for cell in next(csv.reader([text], skipinitialspace=True))]


def _check_header(header, path, number):
    for name in header:
        if header.count(name) > 1:
            raise InputError(f"column names must differ, got {name} twice ({path}:{number})")
