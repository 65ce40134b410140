"""Tables of creep forces on Hertz ellipses, looked up."""

from __future__ import annotations

import ctypes
import os
from ctypes import c_void_p
from typing import Any, NamedTuple, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._arguments import array, flag, refused
from ._library import FIRST_ERROR, TEXT, FaststripError, library, word_of

Array = npt.NDArray[np.float64]
ORDERS = {"linear": 1, "cubic": 3}
STATE = ("a", "b", "load", "mu", "g", "cksi", "ceta", "cphi")
N_FORCES, N_STATE, N_ABOUT = 3, 8, 23


class LookedUp(NamedTuple):
    """Forces on the rail of a row of states; nan where there are none."""

    forces: Array  #: Fx, Fy, N, and Mz about the middle of the ellipse, N mm: shape (..., 3)
    jacobian: Array  #: their derivatives by a, b, load, mu, g, cksi, ceta, cphi: (..., 3, 8); empty
    status: npt.NDArray[np.int32]  #: 0, or the error of each state: shape (...)


class Lookup:
    """A table that `faststrip lookup make` made, from the path of its file or from its bytes.

    All threads may share one. It is for Coulomb friction and like materials of one Poisson's ratio.
    """

    def __init__(self, table: Union[str, os.PathLike[str], bytes]) -> None:
        self._handle = c_void_p()
        content = table
        if not isinstance(content, bytes):
            with open(content, "rb") as file:
                content = file.read()
        text = ctypes.create_string_buffer(TEXT)
        status = library.faststrip_lookup_open(content, len(content), ctypes.byref(self._handle),
                                               text, TEXT)
        if status >= FIRST_ERROR:
            raise FaststripError(status, word_of(status), text.value.decode("ascii", "replace"))
        numbers = (ctypes.c_double * N_ABOUT)()
        library.faststrip_lookup_about(self._handle, numbers)
        self.nu = numbers[0]  #: Poisson's ratio
        self.promised = numbers[1]  #: 99th percentile of the errors that it was made for
        self.tested = int(numbers[2])  #: fresh contacts that it was judged by
        self.least_ab, self.most_ab = numbers[3], numbers[4]  #: a/b, a along x
        #: errors of Fx, Fy, Mz: (linear, cubic; mean, 99th percentile, worst; force)
        self.errors = np.array(numbers[5:]).reshape(2, 3, 3)

    def __del__(self) -> None:
        if getattr(self, "_handle", None):
            library.faststrip_lookup_free(ctypes.byref(self._handle))

    def __call__(self, a: npt.ArrayLike, b: npt.ArrayLike, load: npt.ArrayLike,
                 mu: npt.ArrayLike, g: npt.ArrayLike, creepage: Tuple[Any, Any, Any], *,
                 order: str = "linear", jacobian: bool = False) -> LookedUp:
        """Forces of states: semi-axes a (along the rolling direction) and b, mm, load, N, mu, shear
        modulus g, MPa, creepage (cksi, ceta, cphi in rad/mm). Each is a number or an array; they
        are broadcast. A state that fails has nan and its status; raises FaststripError if all do.
        """
        if order not in ORDERS:
            raise refused("order", "linear or cubic", order)
        try:
            cksi, ceta, cphi = creepage
        except (TypeError, ValueError):
            raise refused("creepage", "three numbers or arrays", creepage) from None
        values = (a, b, load, mu, g, cksi, ceta, cphi)
        try:
            parts = np.broadcast_arrays(*(_numbers(name, value)
                                          for name, value in zip(STATE, values)))
        except ValueError:
            raise refused("a, b, load, mu, g, creepage", "numbers or arrays of shapes that go "
                          "together", tuple(np.shape(value) for value in values)) from None
        shape = parts[0].shape
        states = np.stack([part.ravel() for part in parts], axis=-1)
        n = states.shape[0]
        forces = np.zeros((n, N_FORCES))
        slopes = np.zeros((n if flag("jacobian", jacobian) else 0, N_STATE, N_FORCES))
        codes = np.zeros(n, dtype=np.int32)
        status = library.faststrip_lookup_forces(
            self._handle, ORDERS[order], n, states.ctypes.data, forces.ctypes.data,
            slopes.ctypes.data if jacobian else None, codes.ctypes.data)
        bad = codes >= FIRST_ERROR
        if n and bad.all() or status >= FIRST_ERROR and not bad.any():
            raise FaststripError(status, word_of(status), f"no state of {n} is in the table")
        forces[bad] = np.nan
        slopes = slopes.transpose(0, 2, 1)
        if jacobian:
            slopes[bad] = np.nan
            slopes = slopes.reshape((*shape, N_FORCES, N_STATE))
        return LookedUp(forces.reshape((*shape, N_FORCES)), slopes, codes.reshape(shape))


def _numbers(name: str, value: Any) -> Array:
    """Numbers of any shape; one that is not finite is the library's to tell."""
    if isinstance(value, float):
        return np.array(value)
    return array(name, value)
