"""Contact geometry functions of a wheelset and its equivalent conicity by EN 15302:2008+A1:2010."""

from __future__ import annotations

import ctypes
from typing import Any, Dict, NamedTuple, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._arguments import array, as_long_as, flag, refused
from ._library import FIRST_ERROR, TEXT, FaststripError, library, word_of
from ._profile import Profile
from ._tables import dataset, frame
from ._wheelset import setup_of

Array = npt.NDArray[np.float64]
N_FUNCTIONS = 10
N_CONICITIES = 6


class ContactFunctions(NamedTuple):
    """Where both wheels touch, over the lateral shift."""

    y: Array  #: shifts to the right at which both wheels touch, mm
    delta_r: Array  #: rolling radius difference, right less left, mm
    radius_right: Array  #: rolling radius, mm
    radius_left: Array  #: mm
    angle_right: Array  #: contact angle, rad
    angle_left: Array  #: rad, of the left side in its mirror, as the two below
    roll: Array  #: right wheel down, rad
    y_wheel_right: Array  #: place of the contact on the wheel, mm
    y_rail_right: Array  #: and on the rail, mm
    y_wheel_left: Array  #: mm
    y_rail_left: Array  #: mm

    def to_pandas(self) -> Any:
        """A pandas DataFrame, a row for each shift; ``attrs["units"]`` has the units."""
        return frame(self._asdict())

    def to_xarray(self) -> Any:
        """An xarray Dataset over ``y``, with ``units`` and ``long_name``."""
        return dataset(self._asdict(), ("y",))


class Conicity(NamedTuple):
    """Equivalent conicity over the amplitude; nan where it is not known."""

    amplitude: Array  #: half of the way between the turning points, mm
    tan_gamma_e: Array  #: by Klingel's equation, Annex B
    regression: Array  #: by linear regression, Annex C
    y_min: Array  #: turning point, mm
    y_max: Array  #: turning point, mm
    nonlinearity: Array  #: half of what tan_gamma_e rises from 1 mm less to 1 mm more, 1/mm
    nonlinearity_regression: Array  #: the same by regression
    words: Tuple[str, ...]  #: ``ok``, or ``out_of_range``: beyond the table, or no motion turns
    y_equilibrium: float  #: where delta_r rises through zero, mm
    largest_amplitude: float  #: that the table holds, mm

    def to_pandas(self) -> Any:
        """A pandas DataFrame, a row for each amplitude; ``attrs["units"]`` has the units."""
        return frame(self._columns())

    def to_xarray(self) -> Any:
        """An xarray Dataset over ``amplitude``, with ``units`` and ``long_name``."""
        return dataset(self._columns(), ("amplitude",), attributes={
            "y_equilibrium_mm": self.y_equilibrium,
            "largest_amplitude_mm": self.largest_amplitude})

    def _columns(self) -> Dict[str, Any]:
        columns = self._asdict()
        del columns["y_equilibrium"], columns["largest_amplitude"]
        return {name: list(values) for name, values in columns.items()}


def contact_functions(wheel: Union[str, Profile], rail: Union[str, Profile], y: npt.ArrayLike, *,
                      wheel_left: Union[None, str, Profile] = None,
                      rail_left: Union[None, str, Profile] = None, radius: float = 460.0,
                      radius_left: Optional[float] = None, back_spacing: float = 1360.0,
                      tread_line: float = 70.0, gauge: float = 1435.0, gauge_depth: float = 14.0,
                      rail_distance: Optional[float] = None, cant: float = 0.025,
                      roll: bool = False) -> ContactFunctions:
    """The rolling radius difference, radii, contact angles and roll at lateral shifts y, mm.

    Profiles and dimensions are those of a `Wheelset`. Each wheel comes down on its rail by itself,
    as the standard has it, or with roll the wheelset rolls until both touch. Shifts at which a
    wheel leaves its rail are left out; raises FaststripError if these are all.
    """
    shifts = _row("y", y)
    setup, wheels, rails = setup_of(wheel, rail, wheel_left, rail_left, radius, radius_left,
                                    back_spacing, tread_line, gauge, gauge_depth, rail_distance,
                                    cant)
    functions = np.zeros((shifts.size, N_FUNCTIONS))
    states = np.zeros(shifts.size, dtype=np.int32)
    _call(library.faststrip_contact_functions, ctypes.byref(setup), wheels, rails,
          flag("roll", roll), shifts.size, shifts.ctypes.data, functions.ctypes.data,
          states.ctypes.data)
    there = states == 0
    return ContactFunctions(shifts[there], *functions[there].T.copy())


def conicity(y: npt.ArrayLike, delta_r: npt.ArrayLike, amplitudes: npt.ArrayLike) -> Conicity:
    """Equivalent conicity at amplitudes, mm, from a rolling radius difference delta_r, mm, over
    rising lateral shifts y, mm: of the side to which y points less that of the other side.

    >>> conicity([-10.0, 10.0], [-1.0, 1.0], [3.0]).tan_gamma_e.round(12).tolist()
    [0.05]
    """
    shifts, wanted = _row("y", y), _row("amplitudes", amplitudes)
    radii = as_long_as(shifts, "delta_r", delta_r)
    equilibrium, found = np.zeros(2), np.zeros((wanted.size, N_CONICITIES))
    states = np.zeros((wanted.size, 2), dtype=np.int32)
    _call(library.faststrip_conicity, shifts.size, shifts.ctypes.data, radii.ctypes.data,
          wanted.size, wanted.ctypes.data, equilibrium.ctypes.data, found.ctypes.data,
          states.ctypes.data)
    found[states[:, 0] != 0] = np.nan
    found[states[:, 1] == 0, 4:] = np.nan
    return Conicity._make((wanted, *found.T.copy(), tuple(map(word_of, states[:, 0].tolist())),
                           *equilibrium.tolist()))


def _row(name: str, value: Any) -> Array:
    found = array(name, value)
    if found.ndim != 1:
        raise refused(name, "a row of numbers", value)
    return found


def _call(function: Any, *arguments: Any) -> None:
    text = ctypes.create_string_buffer(TEXT)
    status = function(*arguments, text, TEXT)
    if status >= FIRST_ERROR:
        raise FaststripError(status, word_of(status), text.value.decode("ascii", "replace"))
