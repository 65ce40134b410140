"""What a caller passed, made into what the library takes, or refused by its name.

Nothing is cut, rounded or guessed: a whole number must be one, a mask or an imaginary part is not
dropped, a text is not read as a number.
"""

from __future__ import annotations

import math
import operator
from typing import Any, List, Sequence, Tuple

import numpy as np
import numpy.typing as npt

from ._library import NOT_FINITE, FaststripError, bad_argument, word_of

Array = npt.NDArray[np.float64]
LONGEST = 60  # characters of a value in a message


def refused(name: str, must: str, value: Any) -> FaststripError:
    """The error that says which argument must be what, and what was passed."""
    return bad_argument(f"{name} must be {must}, got {_shown(value)}")


def _shown(value: Any) -> str:
    if isinstance(value, np.ma.MaskedArray):
        return f"a masked array of shape {value.shape}"
    if isinstance(value, np.ndarray):
        return f"an array of {value.dtype} of shape {value.shape}"
    text = " ".join(repr(value).split())
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}... ({type(value).__name__})"


def _not_a_real_number(value: Any) -> bool:
    if isinstance(value, (np.ndarray, np.generic)):
        return (isinstance(value, np.ma.MaskedArray) or value.ndim > 0
                or value.dtype.kind not in "iuf")
    return isinstance(value, (bool, str, bytes, bytearray, complex))


def whole(name: str, value: Any, least: int, most: int, or_else: str = "") -> int:
    """A whole number between two others, of Python or numpy."""
    if type(value) is int and least <= value <= most:
        return value
    must = f"a whole number from {least} to {most}{or_else}"
    if type(value) is not int:
        if _not_a_real_number(value):
            raise refused(name, must, value)
        try:
            value = operator.index(value)
        except TypeError:
            raise refused(name, must, value) from None
    if not least <= value <= most:
        raise refused(name, must, value)
    return value


def _real(name: str, must: str, value: Any) -> float:
    """A number, of Python or numpy; one that is too large is infinite."""
    if _not_a_real_number(value):
        raise refused(name, must, value)
    try:
        return float(value)
    except OverflowError:
        return math.inf if value > 0 else -math.inf
    except (TypeError, ValueError):
        raise refused(name, must, value) from None


def number(name: str, value: Any) -> float:
    """A finite number, of Python or numpy."""
    found = value if type(value) is float else _real(name, "a number", value)
    if not math.isfinite(found):
        raise FaststripError(NOT_FINITE, word_of(NOT_FINITE),
                             f"{name} must be finite, got {_shown(value)}")
    return found


def above_zero(name: str, value: Any) -> float:
    """A number above 0, of Python or numpy; infinity will do."""
    must = "a number above 0"
    found = _real(name, must, value)
    if not found > 0.0:
        raise refused(name, must, value)
    return found


def from_zero(name: str, value: Any) -> float:
    """A finite number from 0 on, of Python or numpy."""
    found = number(name, value)
    if found < 0.0:
        raise refused(name, "a number from 0 on", value)
    return found


def numbers(names: Sequence[str], values: Sequence[Any]) -> List[float]:
    """Finite numbers, each with a name."""
    return [value if type(value) is float and math.isfinite(value) else number(name, value)
            for name, value in zip(names, values)]


def flag(name: str, value: Any) -> bool:
    """True or False; 1 and 0 will do."""
    if value is True or value is False:
        return value
    if isinstance(value, np.bool_):
        return bool(value)
    if isinstance(value, (int, np.integer)) and value in (0, 1):
        return value == 1
    raise refused(name, "True or False", value)


def several(name: str, value: Any, what: str, counts: Sequence[int]) -> Tuple[Any, ...]:
    """A tuple of so many things, from anything that gives them one by one."""
    if type(value) is tuple and len(value) in counts:
        return value
    must = f"{what}, {' or '.join(map(str, counts))} numbers"
    if isinstance(value, (str, bytes, bytearray, dict, set, frozenset, np.ma.MaskedArray)):
        raise refused(name, must, value)
    try:
        found = tuple(value)
    except TypeError:
        raise refused(name, must, value) from None
    if len(found) not in counts:
        raise refused(name, must, value)
    return found


def array(name: str, value: Any) -> Array:
    """Numbers of double precision, of any shape, in one piece."""
    must = "an array of real numbers"
    if value is None:
        raise refused(name, must, value)
    if isinstance(value, np.ma.MaskedArray):
        raise refused(name, f"{must} without a mask (see numpy.ma.filled, compressed)", value)
    try:
        found = np.asarray(value)
    except (TypeError, ValueError):
        raise refused(name, f"{must}, with rows of one length", value) from None
    if found.dtype.kind == "O":
        numbers = [number(f"{name}[{i}]" if found.ndim else name, one)
                   for i, one in enumerate(found.ravel())]
        found = np.array(numbers, dtype=np.float64).reshape(found.shape)
    elif found.dtype.kind not in "iuf":
        raise refused(name, must, found if isinstance(value, np.ndarray) else value)
    if found.ndim == 0:
        return np.array(number(name, found[()]))
    return np.ascontiguousarray(found, dtype=np.float64)


def as_long_as(points: Array, name: str, value: Any) -> Array:
    """An array as long as the points, or one number for all of them."""
    found = array(name, value)
    if found.ndim == 0:
        return np.full(points.shape, found[()])
    if found.shape != points.shape:
        length = str(found.size) if found.ndim == 1 else f"shape {found.shape}"
        raise bad_argument(f"{name} must be as long as y, {points.size}, or one number, "
                           f"got {length}")
    return found
