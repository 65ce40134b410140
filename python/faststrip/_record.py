"""What results have in common: dataclasses that unpack in the order of their fields."""

from __future__ import annotations

import dataclasses
import itertools
from typing import Any, ClassVar, Dict, Iterator, Mapping, TypeVar

import numpy as np

from ._catalogue import PLAIN, QUANTITIES
from ._tables import dataset, frame

Self = TypeVar("Self", bound="Record")
# Arrays of more numbers are shown by their size and range, tuples of more by their length alone.
MOST_SHOWN = 6
# Characters of a text, and of one value in it, with all that is behind left out.
MOST_TEXT, MOST_OF_ONE = 1350, 120


class Shown:
    """A dataclass whose text is short: of long arrays it has size and range alone."""

    __dataclass_fields__: ClassVar[Dict[str, Any]]

    def __init_subclass__(cls, **words: Any) -> None:
        super().__init_subclass__(**words)
        # Where there is one already, a dataclass makes none.
        cls.__repr__ = Shown.__repr__  # type: ignore[method-assign]

    def __repr__(self) -> str:
        found = [f"{one.name}={_shown(getattr(self, one.name))}"
                 for one in dataclasses.fields(self) if one.repr]
        ends = itertools.accumulate(len(text) + 2 for text in found)
        shown = [text for text, end in zip(found, ends) if end <= MOST_TEXT]
        if len(shown) < len(found):
            shown.append(f"... {len(found) - len(shown)} more")
        return f"{type(self).__qualname__}({', '.join(shown)})"


def _shown(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, np.ndarray):
        return _shown(value.tolist()) if value.size <= MOST_SHOWN else _range_of(value)
    if isinstance(value, (tuple, list)):
        if len(value) > MOST_SHOWN or any(isinstance(one, Shown) for one in value):
            return f"<{len(value)} {type(value[0]).__name__}>"
        ends = "()" if isinstance(value, tuple) else "[]"
        return ends[0] + ", ".join(map(_shown, value)) + ends[1]
    text = repr(value)
    return text if len(text) <= MOST_OF_ONE else f"{text[:MOST_OF_ONE]}..."


def _range_of(value: Any) -> str:
    shape = " x ".join(map(str, value.shape))
    kind = "" if value.dtype == np.float64 else f" {value.dtype}"
    numbers = value[np.isfinite(value)]
    ends = f" from {numbers.min():.6g} to {numbers.max():.6g}" if numbers.size else ""
    return f"<{shape}{kind}{ends}>"


# What a docstring says of the kind of a field, by its annotation.
KINDS = {"float": "float", "int": "int", "Optional[float]": "float or None",
         "Array": "ndarray of float", "Whole": "ndarray of int32",
         "npt.NDArray[np.int32]": "ndarray of int32"}


def described(cls: type) -> Any:
    """Put the figures of a dataclass, with units and meanings, where its docstring has a place."""
    text = cls.__doc__ or ""
    place = "    <figures>\n"
    if place not in text:  # python -OO
        return cls
    rows = []
    for one in dataclasses.fields(cls):
        if f"    {one.name} : " in text or one.name not in QUANTITIES:
            continue
        unit, meaning, _ = QUANTITIES[one.name]
        unit = PLAIN.get(unit, unit)
        rows.append(f"    {one.name} : {KINDS[str(one.type)]}\n"
                    f"        {meaning[0].upper()}{meaning[1:]}{', ' if unit else ''}{unit}.\n")
    cls.__doc__ = text.replace(place, "".join(rows))
    return cls


class Record(Shown):
    """A frozen dataclass that can be unpacked, and asked by a place, as a tuple."""

    def __iter__(self) -> Iterator[Any]:
        return (getattr(self, one.name) for one in dataclasses.fields(self))

    def __len__(self) -> int:
        return len(dataclasses.fields(self))

    def __getitem__(self, place: Any) -> Any:
        return tuple(self)[place]

    def _asdict(self) -> Dict[str, Any]:
        """Old: results were named tuples. `dataclasses.fields` has the names."""
        return {one.name: getattr(self, one.name) for one in dataclasses.fields(self)}

    def _replace(self: Self, **changes: Any) -> Self:
        """Old name of `dataclasses.replace`."""
        return dataclasses.replace(self, **changes)


class Row(Record):
    """A record of figures, which is one row of a table."""

    def _columns(self) -> Dict[str, Any]:
        """The figures; what is not known is nan."""
        return {one.name: float("nan") if getattr(self, one.name) is None
                else getattr(self, one.name) for one in dataclasses.fields(self)}

    def to_pandas(self) -> Any:
        """The figures as a table of pandas.

        Returns
        -------
        pandas.DataFrame
            One row; ``attrs["units"]`` has the units. What is not known is nan.
        """
        return frame({name: [value] for name, value in self._columns().items()})

    def to_xarray(self) -> Any:
        """The figures as a dataset of xarray.

        Returns
        -------
        xarray.Dataset
            Numbers, with ``units`` and ``long_name``. What is not known is nan.
        """
        return dataset(self._columns(), ())


class Table(Record):
    """A record of arrays of one length, which are the columns of a table."""

    _rows: ClassVar[str]  # what a row stands for: the dimension of a dataset

    def _columns(self) -> Dict[str, Any]:
        """The arrays that are there."""
        found = {one.name: getattr(self, one.name) for one in dataclasses.fields(self)}
        return {name: values for name, values in found.items() if values is not None}

    def _attributes(self) -> Mapping[str, Any]:
        """What the dataset says of all rows."""
        return {}

    def to_pandas(self) -> Any:
        """The arrays as a table of pandas.

        Returns
        -------
        pandas.DataFrame
            A row for each place of the arrays; ``attrs["units"]`` has the units.
        """
        return frame(self._columns())

    def to_xarray(self) -> Any:
        """The arrays as a dataset of xarray.

        Returns
        -------
        xarray.Dataset
            Over one dimension, with ``units`` and ``long_name``.
        """
        return dataset(self._columns(), (self._rows,), attributes=self._attributes())
