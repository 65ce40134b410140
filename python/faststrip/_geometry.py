"""Contact geometry functions of a wheelset and its equivalent conicity by EN 15302:2008+A1:2010."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any, ClassVar, Dict, Mapping, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._arguments import array, as_long_as, flag, refused
from ._library import FIRST_ERROR, library, told, word_of
from ._profile import Profile
from ._record import Table
from ._wheelset import setup_of

Array = npt.NDArray[np.float64]
N_FUNCTIONS = 10
N_CONICITIES = 6


@dataclass(frozen=True)
class ContactFunctions(Table):
    """Where both wheels touch, over the lateral shift.

    Attributes
    ----------
    y : ndarray of float, shape (n,)
        Shifts to the right at which both wheels touch, mm.
    delta_r : ndarray of float, shape (n,)
        Rolling radius difference, right less left, mm.
    radius_right, radius_left : ndarray of float, shape (n,)
        Rolling radii, mm.
    angle_right, angle_left : ndarray of float, shape (n,)
        Contact angles, rad; what is of the left side is given in its mirror, here and below.
    roll : ndarray of float, shape (n,)
        Right wheel down, rad.
    y_wheel_right, y_rail_right, y_wheel_left, y_rail_left : ndarray of float, shape (n,)
        Places of the contacts on wheel and rail, mm.
    """

    y: Array
    delta_r: Array
    radius_right: Array
    radius_left: Array
    angle_right: Array
    angle_left: Array
    roll: Array
    y_wheel_right: Array
    y_rail_right: Array
    y_wheel_left: Array
    y_rail_left: Array
    _rows: ClassVar[str] = "y"

    def conicity(self, amplitudes: npt.ArrayLike) -> Conicity:
        """Equivalent conicity at some amplitudes.

        Parameters
        ----------
        amplitudes : array_like, shape (m,)
            mm.

        Returns
        -------
        Conicity
        """
        return conicity(self.y, self.delta_r, amplitudes)

    def plot(self, axes: Any = None) -> Any:
        """Draw the rolling radius difference over the shift, broken where a contact jumps.

        Parameters
        ----------
        axes : matplotlib.axes.Axes
            To draw on; new ones unless given.

        Returns
        -------
        matplotlib.axes.Axes
        """
        from ._plot import plot_lines
        from ._style import broken, jumps

        y, delta_r = broken(jumps(self.y, self.y_wheel_right, self.y_wheel_left), self.y,
                            self.delta_r)
        return plot_lines(axes, y, {"": delta_r}, "lateral shift $y$, mm",
                          "rolling radius difference, mm")


@dataclass(frozen=True)
class Conicity(Table):
    """Equivalent conicity over the amplitude; nan where it is not known.

    Attributes
    ----------
    amplitude : ndarray of float, shape (n,)
        Half of the way between the turning points, mm.
    tan_gamma_e : ndarray of float, shape (n,)
        By Klingel's equation, Annex B.
    regression : ndarray of float, shape (n,)
        By linear regression, Annex C; below 0 where the wheelset leaves the equilibrium.
    y_min, y_max : ndarray of float, shape (n,)
        Turning points, mm; without a wave the ends of the straight line.
    nonlinearity : ndarray of float, shape (n,)
        Half of what tan_gamma_e rises from 1 mm less to 1 mm more, 1/mm.
    nonlinearity_regression : ndarray of float, shape (n,)
        The same by regression, 1/mm.
    words : tuple of str
        For each amplitude ``ok``, ``no_wave`` where delta_r falls through zero and no motion turns,
        or ``out_of_range``: beyond the table.
    y_equilibrium : float
        Where delta_r passes through zero nearest to y = 0, mm: about it the amplitudes are meant.
    largest_amplitude : float
        That the table holds, mm.
    """

    amplitude: Array
    tan_gamma_e: Array
    regression: Array
    y_min: Array
    y_max: Array
    nonlinearity: Array
    nonlinearity_regression: Array
    words: Tuple[str, ...]
    y_equilibrium: float
    largest_amplitude: float
    _rows: ClassVar[str] = "amplitude"

    def _columns(self) -> Dict[str, Any]:
        columns = super()._columns()
        del columns["y_equilibrium"], columns["largest_amplitude"]
        return {name: list(values) for name, values in columns.items()}

    def _attributes(self) -> Mapping[str, Any]:
        return {"y_equilibrium_mm": self.y_equilibrium,
                "largest_amplitude_mm": self.largest_amplitude}

    def plot(self, axes: Any = None) -> Any:
        """Draw both conicities over the amplitude.

        Parameters
        ----------
        axes : matplotlib.axes.Axes
            To draw on; new ones unless given.

        Returns
        -------
        matplotlib.axes.Axes
        """
        from ._plot import plot_lines

        return plot_lines(axes, self.amplitude, {"Klingel": self.tan_gamma_e,
                                                 "regression": self.regression},
                          "amplitude, mm", r"equivalent conicity $\tan\gamma_e$")


def contact_functions(wheel: Union[str, Profile], rail: Union[str, Profile],
                      y: Optional[npt.ArrayLike] = None, *,
                      wheel_left: Union[None, str, Profile] = None,
                      rail_left: Union[None, str, Profile] = None, radius: float = 460.0,
                      radius_left: Optional[float] = None, back_spacing: Optional[float] = None,
                      tread_line: float = 70.0, gauge: float = 1435.0, gauge_depth: float = 14.0,
                      rail_distance: Optional[float] = None, inclination: Optional[float] = None,
                      cant: Optional[float] = None, roll: bool = False) -> ContactFunctions:
    """The rolling radius difference, radii, contact angles and roll over the lateral shift.

    Parameters
    ----------
    wheel, rail, wheel_left, rail_left, radius, radius_left, back_spacing, tread_line, gauge, \
gauge_depth, rail_distance, inclination, cant
        As of a `Wheelset`.
    y : array_like, shape (n,), optional
        Shifts to the right, mm; -10 to 10 in steps of 0.1 unless given.
    roll : bool
        Does the wheelset roll until both wheels touch? Unless told so each wheel comes down on its
        rail by itself, as the standard has it.

    Returns
    -------
    ContactFunctions
        Shifts at which a wheel leaves its rail are left out.

    Raises
    ------
    FaststripError
        Where these are all.
    """
    shifts = np.linspace(-10.0, 10.0, 201) if y is None else _row("y", y)
    setup, wheels, rails = setup_of(wheel, rail, wheel_left, rail_left, radius, radius_left,
                                    back_spacing, tread_line, gauge, gauge_depth, rail_distance,
                                    inclination, cant)
    functions = np.zeros((shifts.size, N_FUNCTIONS))
    states = np.zeros(shifts.size, dtype=np.int32)
    told(library.faststrip_contact_functions, ctypes.byref(setup), wheels, rails,
         flag("roll", roll), shifts.size, shifts.ctypes.data, functions.ctypes.data,
         states.ctypes.data)
    there = states == 0
    return ContactFunctions(shifts[there], *functions[there].T.copy())


def conicity(y: npt.ArrayLike, delta_r: npt.ArrayLike, amplitudes: npt.ArrayLike) -> Conicity:
    """Equivalent conicity at some amplitudes.

    Parameters
    ----------
    y : array_like, shape (n,)
        Lateral shifts, rising, mm.
    delta_r : array_like, shape (n,)
        Rolling radius difference, of the side to which y points less that of the other, mm.
    amplitudes : array_like, shape (m,)
        mm.

    Returns
    -------
    Conicity

    Examples
    --------
    >>> conicity([-10.0, 10.0], [-1.0, 1.0], [3.0]).tan_gamma_e.round(12).tolist()
    [0.05]
    """
    shifts, wanted = _row("y", y), _row("amplitudes", amplitudes)
    radii = as_long_as(shifts, "delta_r", delta_r)
    equilibrium, found = np.zeros(2), np.zeros((wanted.size, N_CONICITIES))
    states = np.zeros((wanted.size, 2), dtype=np.int32)
    told(library.faststrip_conicity, shifts.size, shifts.ctypes.data, radii.ctypes.data,
         wanted.size, wanted.ctypes.data, equilibrium.ctypes.data, found.ctypes.data,
         states.ctypes.data)
    found[states[:, 0] >= FIRST_ERROR] = np.nan
    found[states[:, 0] != 0, 0] = np.nan
    found[states[:, 1] == 0, 4:] = np.nan
    figures: Tuple[Any, ...] = (*found.T.copy(), tuple(map(word_of, states[:, 0].tolist())),
                                *equilibrium.tolist())
    return Conicity(wanted, *figures)


def _row(name: str, value: Any) -> Array:
    found = array(name, value)
    if found.ndim != 1:
        raise refused(name, "a row of numbers", value)
    return found
