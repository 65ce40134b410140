"""What comes of one contact: its figures, its strips, its elements."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, ClassVar, Dict, Optional, Tuple

import numpy as np
import numpy.typing as npt

from ._record import Record, Row, Table, described

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


@described
@dataclass(frozen=True)
class Result(Row):
    """Figures of one contact; forces act on the rail.

    What is not known is None: estimated errors of ellipses in the strips' place or with
    ``estimate=False``, those of forces also of some methods, that of the target unless by
    ``normal="auto"``. The depth is the penetration less the gap's lowest height.

    Attributes
    ----------
    status : int
        0, or the number of a named limitation.
    word : str
        ``ok``, or the name of the limitation: ``fallback_used``, ``edge_of_data``,
        ``fewer_strips``, ``overlap_left``, ``flat_along_x``, ``conformal``, ``target_missed``,
        ``under_resolved``, ``more_strips``, ``not_unique``.
    <figures>
    target_is_met : bool or None
        Is it within the tolerance? None without a tolerance, and by other methods.
    steps : tuple of Step
        What ``normal="auto"`` did; results are compared without, as it has times.
    limitations : tuple of str
        All of them, of which `word` is the first.
    derivatives : ndarray of float, shape (4, 4), or None
        Where they were asked for: of load, fx, fy, mz over penetration, cksi, ceta, cphi, in N,
        N mm over mm, 1, rad/mm; nan where patches come or go.
    """

    status: int
    word: str
    # BEGIN figures, written by tools/generate/columns.py
    load: float
    penetration: float
    area: float
    pmax: float
    y_min: float
    y_max: float
    x_max: float
    cksi: float
    ceta: float
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
    est_err_cksi: Optional[float]
    est_err_ceta: Optional[float]
    # END figures
    est_err_target: Optional[float] = None
    target_is_met: Optional[bool] = None
    steps: Tuple[Step, ...] = field(default=(), compare=False)
    limitations: Tuple[str, ...] = ()
    derivatives: Optional[Array] = field(default=None, compare=False, repr=False)

    def _columns(self) -> Dict[str, Any]:
        columns = super()._columns()
        del columns["steps"], columns["derivatives"]
        columns["limitations"] = " ".join(self.limitations)
        columns["target_is_met"] = bool(self.target_is_met)
        return columns


@described
@dataclass(frozen=True)
class Strips(Table):
    """The strips of a contact, patch by patch.

    Attributes
    ----------
    <figures>
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


@described
@dataclass(frozen=True)
class Elements(Table):
    """The elements of a contact, row by row; tractions are those on the rail.

    Attributes
    ----------
    area : ndarray of float
        Of the element, mm^2.
    <figures>
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


@described
@dataclass(frozen=True)
class Stresses(Table):
    """Stresses of the rail at points below a contact; tension is positive.

    The arrays have the shape of the points; the tables have a row for each.

    Attributes
    ----------
    <figures>
    """

    x: Array
    y: Array
    z: Array
    sxx: Array
    syy: Array
    szz: Array
    sxy: Array
    sxz: Array
    syz: Array
    von_mises: Array
    tresca: Array
    s1: Array
    s2: Array
    s3: Array
    _rows: ClassVar[str] = "point"

    def _columns(self) -> Dict[str, Any]:
        return {name: values.ravel() for name, values in super()._columns().items()}


@described
@dataclass(frozen=True)
class StressPeak(Row):
    """The largest von Mises stress of the rail below a contact.

    Attributes
    ----------
    <figures>
    """

    von_mises_max: float
    von_mises_x: float
    von_mises_y: float
    von_mises_z: float
    est_err_von_mises: float
