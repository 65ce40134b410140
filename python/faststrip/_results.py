"""What comes of one contact: its figures, its strips, its elements."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, ClassVar, Dict, Optional, Tuple

import numpy as np
import numpy.typing as npt

from ._record import Record, Row, Table

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Step(Record):
    """One step of ``normal="auto"``.

    Attributes
    ----------
    normal, tangential : str
        Methods.
    strips : int
        Strips across the widest patch.
    points_per_strip : int
        Points along a strip.
    estimate : float or None
        Estimated error of the target; None where it is not known.
    normal_us : float
        Time of the pressures and their estimates, us.
    tangential_us : float
        Time of the forces and their estimates, us.
    is_best : bool
        Is its solution the result?
    """

    normal: str
    tangential: str
    strips: int
    points_per_strip: int
    estimate: Optional[float]
    normal_us: float
    tangential_us: float
    is_best: bool


@dataclass(frozen=True)
class Result(Row):
    """Figures of one contact; forces act on the rail.

    Attributes
    ----------
    status : int
        0, or the number of a named limitation.
    word : str
        ``ok``, or the name of the limitation: ``fallback_used``, ``edge_of_data``,
        ``fewer_strips``, ``overlap_left``, ``flat_along_x``, ``conformal``, ``target_missed``,
        ``under_resolved``, ``more_strips``.
    load : float
        Normal force, N.
    penetration : float
        From h = 0, mm.
    area : float
        Of all patches, mm^2.
    pmax : float
        Maximum pressure, MPa.
    y_min, y_max : float
        Ends of the contact along y, mm.
    x_max : float
        Largest half-length along x, mm.
    fx, fy : float
        Longitudinal and lateral force, N.
    mz : float
        Moment about the reference point, N mm.
    friction_power : float
        Frictional work per distance rolled (T gamma), N.
    stick_fraction : float
        Share of the area in adhesion.
    n_patches, n_strips, n_elements : int
        Numbers of patches, strips and elements.
    iterations : int
        Steps of the normal solution.
    strips_across : int
        Strips across the patch that has most; 0: no strips.
    est_err_penetration : float or None
        Estimated error over the depth, which is the penetration less the gap's lowest height;
        like the four below None where it is not known: of ellipses in the strips' place, or with
        ``estimate=False``.
    est_err_pmax, est_err_area : float or None
        Estimated relative errors of pmax and of the area.
    residual_inside : float or None
        Largest gap that is left inside the patches, over the depth.
    overlap_outside : float or None
        Largest overlap outside of them, over the depth.
    est_err_fx, est_err_fy : float or None
        Estimated errors of the forces over mu times the load; like the one below None where they
        are not known: of some methods, and where est_err_pmax is None.
    est_err_mz : float or None
        Estimated error of mz over mu times the load times sqrt(area/pi).
    est_err_target : float or None
        Estimated error of what ``normal="auto"`` was to know; None where it is not known, and by
        other methods.
    target_is_met : bool or None
        Is it within the tolerance? None without a tolerance, and by other methods.
    steps : tuple of Step
        What ``normal="auto"`` did; results are compared without, as it has times.
    limitations : tuple of str
        All of them, of which `word` is the first.
    """

    status: int
    word: str
    load: float
    penetration: float
    area: float
    pmax: float
    y_min: float
    y_max: float
    x_max: float
    fx: float
    fy: float
    mz: float
    friction_power: float
    stick_fraction: float
    n_patches: int
    n_strips: int
    n_elements: int
    iterations: int
    strips_across: int
    est_err_penetration: Optional[float]
    est_err_pmax: Optional[float]
    est_err_area: Optional[float]
    residual_inside: Optional[float]
    overlap_outside: Optional[float]
    est_err_fx: Optional[float]
    est_err_fy: Optional[float]
    est_err_mz: Optional[float]
    est_err_target: Optional[float] = None
    target_is_met: Optional[bool] = None
    steps: Tuple[Step, ...] = field(default=(), compare=False)
    limitations: Tuple[str, ...] = ()

    def _columns(self) -> Dict[str, Any]:
        columns = super()._columns()
        del columns["steps"]
        columns["limitations"] = " ".join(self.limitations)
        columns["target_is_met"] = bool(self.target_is_met)
        return columns


@dataclass(frozen=True)
class Strips(Table):
    """The strips of a contact, patch by patch.

    Attributes
    ----------
    y_left, y_right : ndarray of float, shape (n,)
        Edges, mm.
    half_length : ndarray of float, shape (n,)
        Half-length along x, mm.
    p0 : ndarray of float, shape (n,)
        Pressure at x = 0, MPa.
    patch : ndarray of int32, shape (n,)
        Number of the patch, from 1.
    """

    y_left: Array
    y_right: Array
    half_length: Array
    p0: Array
    patch: npt.NDArray[np.int32]
    _rows: ClassVar[str] = "strip"

    def plot(self, axes: Any = None) -> Any:
        """Draw them from above, coloured by their pressures.

        Parameters
        ----------
        axes : matplotlib.axes.Axes
            To draw on; new ones unless given.

        Returns
        -------
        matplotlib.axes.Axes
        """
        from ._plot import plot_strips

        return plot_strips(self, axes)


@dataclass(frozen=True)
class Elements(Table):
    """The elements of a contact, row by row; tractions are those on the rail.

    Attributes
    ----------
    x, y : ndarray of float, shape (n,)
        Middle, mm.
    area : ndarray of float, shape (n,)
        mm^2.
    pn : ndarray of float, shape (n,)
        Pressure, MPa.
    px, py : ndarray of float, shape (n,)
        Longitudinal and lateral traction, MPa.
    sx, sy : ndarray of float, shape (n,)
        Longitudinal and lateral slip over the rolling speed.
    state : ndarray of int32, shape (n,)
        1 adhesion, 2 slip.
    """

    x: Array
    y: Array
    area: Array
    pn: Array
    px: Array
    py: Array
    sx: Array
    sy: Array
    state: npt.NDArray[np.int32]
    _rows: ClassVar[str] = "element"

    def plot(self, axes: Any = None) -> Any:
        """Draw the tractions as arrows; elements in adhesion are dark, a black line is their
        border.

        Parameters
        ----------
        axes : matplotlib.axes.Axes
            To draw on; new ones unless given.

        Returns
        -------
        matplotlib.axes.Axes
        """
        from ._plot import plot_elements

        return plot_elements(self, axes)
