"""Tables of creep forces on Hertz ellipses, looked up."""

from __future__ import annotations

import ctypes
import os
from dataclasses import dataclass
from typing import Any, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._arguments import array, flag, refused
from ._library import FIRST_ERROR, FaststripError, Handle, library, told, word_of
from ._record import Record
from ._tables import dataset, dims_of, frame

Array = npt.NDArray[np.float64]
ORDERS = {"linear": 1, "cubic": 3}
STATE = ("a", "b", "load", "mu", "g", "cksi", "ceta", "cphi")
N_FORCES, N_ABOUT = 3, 23


@dataclass(frozen=True)
class LookedUp(Record):
    """Forces on the rail of an array of states; nan where there are none.

    Attributes
    ----------
    forces : ndarray of float, shape (..., 3)
        Fx, Fy, N, and Mz about the middle of the ellipse or the place of contact, N mm.
    jacobian : ndarray of float, shape (..., 3, 8)
        Their derivatives by a, b, load, mu, g, cksi, ceta, cphi; empty unless asked for. Of
        `WheelLookup` shape (..., 3, 7): by y, yaw, load, mu, cksi, ceta, cphi.
    status : ndarray of int32, shape (...)
        0, or the error of each state.
    """

    forces: Array
    jacobian: Array
    status: npt.NDArray[np.int32]

    def _columns(self) -> Dict[str, Any]:
        columns = {name: self.forces[..., k] for k, name in enumerate(("fx", "fy", "mz"))}
        return {**columns, "status": self.status}

    def to_pandas(self) -> Any:
        """The forces as a table of pandas.

        Returns
        -------
        pandas.DataFrame
            A row for each state, the last axis fastest; ``attrs["units"]`` has the units.
        """
        return frame({name: np.ravel(values) for name, values in self._columns().items()})

    def to_xarray(self, dims: Optional[Sequence[str]] = None) -> Any:
        """The forces as a dataset of xarray.

        Parameters
        ----------
        dims : sequence of str, optional
            Names of the dimensions: ``state``, or ``state_0``, ``state_1`` and so on.

        Returns
        -------
        xarray.Dataset
            With ``units`` and ``long_name``.
        """
        return dataset(self._columns(), dims_of(dims, self.status.ndim, "state"))


class Lookup:
    """A table that ``faststrip lookup make`` made.

    All threads may share one. It is for Coulomb friction and like materials of one Poisson's ratio.

    Parameters
    ----------
    table : str, path or bytes
        The path of its file, or its bytes.

    Attributes
    ----------
    nu : float
        Poisson's ratio.
    promised : float
        99th percentile of the errors that it was made for.
    tested : int
        Fresh contacts that it was judged by.
    least_ab, most_ab : float
        Range of a/b, a along x.
    errors : ndarray of float, shape (2, 3, 3)
        Errors of Fx, Fy, Mz: linear, cubic; mean, 99th percentile, worst; force.
    """

    def __init__(self, table: Union[str, os.PathLike[str], bytes]) -> None:
        self._table, numbers = opened(table, library.faststrip_lookup_about, N_ABOUT,
                                      "the table of a wheel: take WheelLookup")
        self.nu = numbers[0]
        self.promised = numbers[1]
        self.tested = int(numbers[2])
        self.least_ab, self.most_ab = numbers[3], numbers[4]
        self.errors = np.array(numbers[5:]).reshape(2, 3, 3)

    def __call__(self, a: npt.ArrayLike, b: npt.ArrayLike, load: npt.ArrayLike,
                 mu: npt.ArrayLike, g: npt.ArrayLike, creepage: Tuple[Any, Any, Any], *,
                 order: str = "linear", jacobian: bool = False) -> LookedUp:
        """Forces of states, each a number or an array; they are broadcast.

        Parameters
        ----------
        a, b : array_like
            Semi-axes along the rolling direction and across, mm.
        load : array_like
            Normal force, N.
        mu : array_like
            Coefficient of friction.
        g : array_like
            Shear modulus, MPa.
        creepage : three array_like
            Longitudinal, lateral and spin (rad/mm) creepage.
        order : str
            ``linear`` or ``cubic``.
        jacobian : bool
            Are derivatives wanted?

        Returns
        -------
        LookedUp
            A state that fails has nan and its status.

        Raises
        ------
        FaststripError
            If all fail.
        """
        states, shape = stacked(STATE, (a, b, load, mu, g, *three(creepage)))
        return looked_up(library.faststrip_lookup_forces, self._table, order, jacobian, shape,
                         states)


def opened(table: Union[str, os.PathLike[str], bytes], about: Any, count: int,
           other: str) -> Tuple[Handle, List[float]]:
    """A table and so many numbers about it; `other` is what it is if it has none of these."""
    handle = Handle(library.faststrip_lookup_free)
    content = table
    if not isinstance(content, bytes):
        with open(content, "rb") as file:
            content = file.read()
    told(library.faststrip_lookup_open, content, len(content), ctypes.byref(handle.handle))
    numbers = (ctypes.c_double * count)()
    status = about(handle.handle, numbers)
    if status >= FIRST_ERROR:
        raise FaststripError(status, word_of(status), other)
    return handle, numbers[:]


def order_number(order: str) -> int:
    """The number of an order of interpolation."""
    if order not in ORDERS:
        raise refused("order", "linear or cubic", order)
    return ORDERS[order]


def three(creepage: Tuple[Any, Any, Any]) -> Tuple[Any, Any, Any]:
    """Three creepages."""
    try:
        cksi, ceta, cphi = creepage
    except (TypeError, ValueError):
        raise refused("creepage", "three numbers or arrays", creepage) from None
    return cksi, ceta, cphi


def stacked(names: Sequence[str], values: Sequence[Any]) -> Tuple[Array, Tuple[int, ...]]:
    """States as rows, and the shape that their numbers have together."""
    try:
        parts = np.broadcast_arrays(*(_numbers(name, value)
                                      for name, value in zip(names, values)))
    except ValueError:
        said = [name for name in names if not name.startswith("c")]
        if len(said) < len(names):
            said.append("creepage")
        raise refused(", ".join(said), "numbers or arrays of shapes that go together",
                      tuple(np.shape(value) for value in values)) from None
    return np.stack([part.ravel() for part in parts], axis=-1), parts[0].shape


def failed(status: int, codes: npt.NDArray[np.int32], what: str) -> npt.NDArray[np.bool_]:
    """Where a table has nothing. Raises if that is everywhere."""
    bad = codes >= FIRST_ERROR
    if bad.size and bad.all() or status >= FIRST_ERROR and not bad.any():
        raise FaststripError(status, word_of(status), f"no {what} of {bad.size} is in the table")
    return bad


def looked_up(function: Any, table: Handle, order: str, jacobian: bool, shape: Tuple[int, ...],
              states: Array, *slots: Any) -> LookedUp:
    """Forces in the shape of the states; nan where there are none. Raises if all failed."""
    number = order_number(order)
    n, n_state = states.shape
    wanted = flag("jacobian", jacobian)
    forces = np.zeros((n, N_FORCES))
    slopes = np.zeros((n if wanted else 0, n_state, N_FORCES))
    codes = np.zeros(n, dtype=np.int32)
    status = function(table.handle, number, n, *(slot.ctypes.data for slot in slots),
                      states.ctypes.data, forces.ctypes.data,
                      slopes.ctypes.data if wanted else None, codes.ctypes.data)
    bad = failed(status, codes, "state")
    forces[bad] = np.nan
    slopes = slopes.transpose(0, 2, 1)
    if wanted:
        slopes[bad] = np.nan
        slopes = slopes.reshape((*shape, N_FORCES, n_state))
    return LookedUp(forces.reshape((*shape, N_FORCES)), slopes, codes.reshape(shape))


def _numbers(name: str, value: Any) -> Array:
    """Numbers of any shape; one that is not finite is the library's to tell."""
    if isinstance(value, float):
        return np.array(value)
    return array(name, value)
