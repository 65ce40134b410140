"""Tables of a wheel on a rail: contacts and their creep forces, looked up."""

from __future__ import annotations

import ctypes
import math
import os
from dataclasses import dataclass
from typing import Any, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._arguments import flag, refused
from ._library import library
from ._lookup import LookedUp, failed, looked_up, opened, order_number, stacked, three
from ._record import Record

Array = npt.NDArray[np.float64]
PLACE = ("y", "yaw", "load")
STATE = (*PLACE, "mu", "cksi", "ceta", "cphi")
#: Numbers of a contact, in this order.
CONTACT = ("n", "angle", "y_rail", "z_rail", "x", "y_wheel", "radius", "z", "area", "pmax", "c",
           "l1", "l2", "l3")
N_ABOUT, N_Z_ERRORS = 60, 12
#: Beyond any table's, and within the library's whole numbers.
MOST_SLOT = 1e6


@dataclass(frozen=True)
class WheelContacts(Record):
    """The contacts of a wheel at an array of places.

    Attributes
    ----------
    numbers : ndarray of float, shape (..., slots, 14)
        Of each contact: normal force, N; contact angle, rad; y, z on the rail, mm; x in the track,
        mm; y on the wheel, mm; rolling radius, mm; z of the wheelset, mm; area, mm2; largest
        pressure, MPa; length c of the moment, mm; lengths that normalise the creepages, mm2, mm2,
        mm3. All are 0 where there is no contact, and nan at a place that fails.
    slopes : ndarray of float, shape (..., slots, 14, 3)
        Their derivatives by y, yaw, load; empty unless asked for.
    status : ndarray of int32, shape (...)
        0, or the error of each place.
    """

    numbers: Array
    slopes: Array
    status: npt.NDArray[np.int32]


class WheelLookup:
    """A table that ``faststrip lookup wheel`` made.

    All threads may share one. It is for Coulomb friction and the materials of its case.

    Parameters
    ----------
    table : str, path or bytes
        The path of its file, or its bytes.

    Attributes
    ----------
    nu, g : float
        Poisson's ratio and shear modulus, MPa.
    promised : float
        99th percentile of the errors that it was made for; where contacts come or go and this
        was not met, the one there.
    tested : tuple of int
        Fresh states that it was judged by: all; those in cells where contacts come or go.
    slots : int
        Contacts that there can be.
    y, yaw, load : tuple of float
        First and last lateral displacement of the wheelset, mm; yaw, rad, both the same in a
        table of one yaw, which knows no other; vertical part of the normal forces, N.
    errors : ndarray of float, shape (2, 2, 3, 5)
        Errors of Fx, Fy, Mz, lateral part of the normal forces, all over them (and mu, and c), and
        of z, as the load that it makes by Hertz' law over the load: as ``tested``; linear, cubic;
        mean, 99th percentile, worst; error. Those of z are nan in a file of an older version.
    """

    def __init__(self, table: Union[str, os.PathLike[str], bytes]) -> None:
        self._table, numbers = opened(table, library.faststrip_lookup_wheel_about, N_ABOUT,
                                      "a table of ellipses: take Lookup")
        self.nu, self.g, self.promised = numbers[:3]
        self.tested = int(numbers[3]), int(numbers[4])
        self.slots = int(numbers[5])
        self.y, self.yaw, self.load = (tuple(numbers[k:k + 2]) for k in (6, 8, 10))
        of_z = (ctypes.c_double * N_Z_ERRORS)()
        code = library.faststrip_lookup_wheel_z_errors(self._table.handle, of_z)
        self.errors = np.concatenate([np.array(numbers[12:]).reshape(2, 2, 3, 4),
                                      np.array(of_z if code == 0 else [math.nan] * N_Z_ERRORS)
                                      .reshape(2, 2, 3, 1)], axis=-1)

    def contacts(self, y: npt.ArrayLike, yaw: npt.ArrayLike, load: npt.ArrayLike, *,
                 order: str = "cubic", slopes: bool = False) -> WheelContacts:
        """Contacts at places, each a number or an array; they are broadcast.

        Parameters
        ----------
        y : array_like
            Lateral displacement of the wheelset, mm.
        yaw : array_like
            Its yaw, rad.
        load : array_like
            Vertical part of the normal forces, N.
        order : str
            ``cubic`` or ``linear``.
        slopes : bool
            Are derivatives wanted?

        Returns
        -------
        WheelContacts
            A place that fails has nan and its status.

        Raises
        ------
        FaststripError
            If all fail.
        """
        places, shape = stacked(PLACE, (y, yaw, load))
        n = len(places)
        number = order_number(order)
        found = np.zeros((n, self.slots, len(CONTACT)))
        by_place = np.zeros((n if flag("slopes", slopes) else 0, 3, self.slots, len(CONTACT)))
        codes = np.zeros(n, dtype=np.int32)
        status = library.faststrip_lookup_wheel_contacts(
            self._table.handle, number, n, places.ctypes.data, found.ctypes.data,
            by_place.ctypes.data if slopes else None, codes.ctypes.data)
        bad = failed(status, codes, "place")
        found[bad] = np.nan
        by_place = by_place.transpose(0, 2, 3, 1)
        if slopes:
            by_place[bad] = np.nan
            by_place = by_place.reshape((*shape, self.slots, len(CONTACT), 3))
        return WheelContacts(found.reshape((*shape, self.slots, len(CONTACT))), by_place,
                             codes.reshape(shape))

    def __call__(self, slot: npt.ArrayLike, y: npt.ArrayLike, yaw: npt.ArrayLike,
                 load: npt.ArrayLike, mu: npt.ArrayLike, creepage: Tuple[Any, Any, Any], *,
                 order: str = "cubic", jacobian: bool = False) -> LookedUp:
        """Creep forces of contacts, each number one or an array; they are broadcast.

        Parameters
        ----------
        slot : array_like of int
            Which contact, from 1.
        y, yaw, load : array_like
            As of `contacts`.
        mu : array_like
            Coefficient of friction.
        creepage : three array_like
            Longitudinal, lateral and spin (rad/mm) creepage in the frame of the contact.
        order : str
            ``cubic`` or ``linear``.
        jacobian : bool
            Are derivatives wanted?

        Returns
        -------
        LookedUp
            Forces are 0 where there is no contact. A state that fails has nan and its status.

        Raises
        ------
        FaststripError
            If all fail.
        """
        rows, shape = stacked(("slot", *STATE), (slot, y, yaw, load, mu, *three(creepage)))
        whole = np.abs(rows[:, 0]) < MOST_SLOT
        whole[whole] = rows[whole, 0] % 1 == 0
        if not whole.all():
            raise refused("slot", "whole numbers", float(rows[~whole, 0][0]))
        slots = np.ascontiguousarray(rows[:, 0], dtype=np.int32)
        states = np.ascontiguousarray(rows[:, 1:])
        return looked_up(library.faststrip_lookup_wheel_forces, self._table, order, jacobian, shape,
                         states, slots)
