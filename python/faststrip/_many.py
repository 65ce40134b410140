"""Many contacts at once: arrays that broadcast in, arrays by name out."""

from __future__ import annotations

import ctypes
import math
import os
import time
from dataclasses import dataclass, fields
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._arguments import array, flag, refused, several, whole
from ._catalogue import QUANTITIES, Case, Figures
from ._contact import (
    CREEPAGE_NAMES,
    FORCE_NAMES,
    GAP_POINTS,
    NO_FORCES,
    Contact,
    Material,
    new_case,
    parts_of_gap,
    take_material,
    want,
)
from ._interrupt import interruptible
from ._library import FIRST_ERROR, TEXT, FaststripError, bad_argument, library, word_of
from ._profile import Gap
from ._record import Shown, described
from ._tables import dataset, dims_of, extra, frame
from ._wear import CONSTANT, Friction, Thermal, take_friction, take_thermal

Array = npt.NDArray[np.float64]
Whole = npt.NDArray[np.int32]
_CASE = np.dtype(Case)
_FIGURES = np.dtype(Figures)
_GAP = np.dtype([("n", np.int32), *((name, np.uintp) for name in ("y", "h", "inv2r",
                                                                  "inclination"))], align=True)
GAP_NAMES = "y", "h", "inv2r", "inclination"
STEEL = Material()
MOST_CHAIN = 2**31 - 1
MOST_THREADS = 10000
# Contacts of one call of the library: at first for each thread, and at most. A call that lasts
# about as long as this (s) costs nothing by being one of many, and Ctrl-C is soon heard.
FIRST_CALL = 64
LONGEST_CALL = 65536
CALL_SECONDS = 0.25


@described
@dataclass(frozen=True)
class ManyResult(Shown):
    """Figures of many contacts, all arrays of one shape; forces act on the rail.

    Numbers of a contact without a result are nan, or 0 where they count something; estimated errors
    that are not known are nan.

    Attributes
    ----------
    status : ndarray of int32
        0, the number of a named limitation, or from 100 on that of an error; see `word`.
    <figures>
    target_is_met : ndarray of bool
        Is it within the tolerance? False by other methods.
    limitations : ndarray of int32
        All of them as a set, of which `status` is the first: ``1 << status`` of each added up;
        `limitation_words` names them.
    first_error : str
        Which contact is the first without a result, and why; empty if all have one.
    """

    status: Whole
    # BEGIN figures, written by tools/generate/columns.py
    load: Array
    penetration: Array
    area: Array
    pmax: Array
    y_min: Array
    y_max: Array
    x_max: Array
    cksi: Array
    ceta: Array
    fx: Array
    fy: Array
    mz: Array
    friction_power: Array
    stick_fraction: Array
    n_patches: Whole
    n_strips: Whole
    iterations: Whole
    strips_across: Whole
    est_err_penetration: Array
    est_err_pmax: Array
    est_err_area: Array
    residual_inside: Array
    overlap_outside: Array
    est_err_fx: Array
    est_err_fy: Array
    est_err_mz: Array
    est_err_cksi: Array
    est_err_ceta: Array
    flash_temperature: Array
    temperature_max: Array
    temperature_x: Array
    temperature_y: Array
    # END figures
    est_err_target: Array
    target_is_met: npt.NDArray[np.bool_]
    limitations: Whole
    first_error: str

    @property
    def shape(self) -> Tuple[int, ...]:
        """Shape of each array: what gaps and arguments broadcast to."""
        return self.status.shape

    @property
    def word(self) -> npt.NDArray[np.str_]:
        """The word of each status, ``ok`` or the name of a limitation or an error."""
        found, place = np.unique(self.status, return_inverse=True)
        words = np.array([word_of(int(status)) for status in found], dtype=np.str_)
        return words[place].reshape(self.shape)

    @property
    def has_result(self) -> npt.NDArray[np.bool_]:
        """Is there a result, with or without a limitation?"""
        return self.status < FIRST_ERROR

    @property
    def counts(self) -> Dict[str, int]:
        """How many contacts have which word."""
        return {word_of(int(status)): int(count)
                for status, count in zip(*np.unique(self.status, return_counts=True))}

    def _columns(self) -> Dict[str, Any]:
        return {one.name: getattr(self, one.name) for one in fields(ManyResult)[:-1]}

    def to_pandas(self) -> Any:
        """The figures as a table of pandas.

        Returns
        -------
        pandas.DataFrame
            A row for each contact, indexed by its place where the arrays have several dimensions;
            ``attrs["units"]`` has the units.
        """
        index = None
        if len(self.shape) > 1:
            places = [range(n) for n in self.shape]
            index = extra("pandas", "to_pandas").MultiIndex.from_product(places)
        columns = {name: np.ravel(values) for name, values in self._columns().items()}
        return frame({"word": np.ravel(self.word), **columns}, index)

    def to_xarray(self, dims: Optional[Sequence[str]] = None,
                  coords: Optional[Mapping[str, Any]] = None) -> Any:
        """The figures as a dataset of xarray.

        Parameters
        ----------
        dims : sequence of str, optional
            Names of the dimensions: ``contact``, or ``contact_0``, ``contact_1`` and so on unless
            told otherwise.
        coords : mapping, optional
            Coordinates, for xarray.

        Returns
        -------
        xarray.Dataset
            The arrays, with ``units`` and ``long_name``.
        """
        dims = dims_of(dims, len(self.shape), "contact")
        # What is over a dimension of its name is a coordinate already.
        columns = {name: values for name, values in self._columns().items()
                   if name not in (coords or ())}
        made = dataset({"word": self.word, **columns}, dims, coords,
                       {"first_error": self.first_error} if self.first_error else None)
        statuses = np.unique(self.status)
        made["status"].attrs.update(
            long_name="status", flag_values=statuses,
            flag_meanings=" ".join(word_of(int(status)) for status in statuses))
        made["word"].attrs["long_name"] = "word of the status"
        made["target_is_met"].attrs["long_name"] = "is est_err_target within the tolerance"
        return made


class _Gaps:
    """Gaps as the library takes them; they stay as long as this."""

    def __init__(self, gaps: Any) -> None:
        self.kept: List[Any] = []
        if isinstance(gaps, (tuple, Gap)):
            self._take_arrays(gaps)
        elif isinstance(gaps, list):
            self._take_list(gaps)
        else:
            raise refused("gaps", "a tuple (y, h, inv2r) of arrays, or a list of such", gaps)

    def _take_arrays(self, gaps: Union[Tuple[Any, ...], Gap]) -> None:
        values = parts_of_gap("gaps", gaps)
        names = GAP_NAMES[:len(values)]
        arrays = [array(name, value) for name, value in zip(names, values)]
        n = _points(arrays[0])
        for name, one in zip(names, arrays):
            if one.ndim and one.shape[-1] != n:
                raise bad_argument(f"{name} must be as long as y along its last axis, {n}, or one "
                                   f"number, got shape {one.shape}")
        try:
            self.shape = np.broadcast_shapes(*(one.shape[:-1] for one in arrays))
        except ValueError:
            raise bad_argument("the gaps must broadcast but for their last axis, got "
                               + ", ".join(f"{name} {one.shape}"
                                           for name, one in zip(names, arrays))) from None
        table = np.zeros(self.shape, dtype=_GAP)
        table["n"] = n
        for name, one in zip(names, arrays):
            if one.ndim == 0:
                one = np.full(n, one[()])
            self.kept.append(one)
            rows = one.shape[:-1]
            places = np.arange(math.prod(rows), dtype=np.uintp).reshape(rows)
            table[name] = one.ctypes.data + n * one.itemsize * places
        self.table = table.reshape(-1)
        if self.shape == ():
            _check_gap(*self.kept)

    def _take_list(self, gaps: List[Any]) -> None:
        if not gaps:
            raise refused("gaps", "a list of at least one gap", gaps)
        self.shape = (len(gaps),)
        self.table = np.zeros(self.shape, dtype=_GAP)
        for i, gap in enumerate(gaps):
            if not isinstance(gap, (tuple, Gap)):
                raise refused(f"gaps[{i}]", "a tuple (y, h, inv2r) of arrays", gap)
            values = parts_of_gap(f"gaps[{i}]", gap)
            names = [f"gaps[{i}] {name}" for name in GAP_NAMES]
            arrays = [array(name, value) for name, value in zip(names, values)]
            n = _points(arrays[0], names[0])
            self.table["n"][i] = n
            for name, one, key in zip(names, arrays, GAP_NAMES):
                if one.ndim == 0:
                    one = np.full(n, one[()])
                if one.shape != (n,):
                    raise bad_argument(f"{name} must be as long as y, {n}, or one number, "
                                       f"got shape {one.shape}")
                self.kept.append(one)
                self.table[key][i] = one.ctypes.data


def _points(y: Array, name: str = "y") -> int:
    if y.ndim == 0:
        raise bad_argument(f"{name} must be an array, got one number")
    n = y.shape[-1]
    if n > GAP_POINTS[1]:
        raise bad_argument(f"{name} must have at most {GAP_POINTS[1]} points, got {n}")
    return n


def _check_gap(y: Array, *others: Array) -> None:
    """Raise what a gap that all contacts have is refused for."""
    Contact(normal="hertz", tangential="none",
            max_points=max(y.size, GAP_POINTS[0])).set_gap(y, *others)


def _creepages(creepage: Any) -> List[Any]:
    if isinstance(creepage, np.ndarray) and not isinstance(creepage, np.ma.MaskedArray):
        if creepage.ndim == 0 or creepage.shape[-1] != 3:
            raise refused("creepage", "three arrays, or one whose last axis is of 3", creepage)
        return [creepage[..., k] for k in range(3)]
    if not isinstance(creepage, (tuple, list)) or len(creepage) != 3:
        raise refused("creepage", "three arrays, longitudinal, lateral and spin, or one whose "
                                  "last axis is of 3", creepage)
    return list(creepage)


def cores() -> int:
    """Cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def solve_many(gaps: Any, *, load: Optional[npt.ArrayLike] = None,
               penetration: Optional[npt.ArrayLike] = None, creepage: Any = (0.0, 0.0, 0.0),
               forces: Tuple[Optional[npt.ArrayLike], Optional[npt.ArrayLike]] = NO_FORCES,
               mu: npt.ArrayLike = 0.3, material: Material = STEEL,
               friction: Friction = CONSTANT, thermal: Optional[Thermal] = None,
               speed: npt.ArrayLike = 0.0,
               contact_angle: npt.ArrayLike = 0.0, rail_y: npt.ArrayLike = 0.0,
               normal: str = "strip",
               tangential: str = "faststrip", strips_per_patch: Union[int, str] = 15,
               points_per_strip: int = 15, fastsim_grid: Tuple[int, int] = (50, 50),
               estimate: bool = True, resolution_limit: float = 0.1, force_limit: float = 0.1,
               curved: bool = False,
               target: Optional[str] = None, tolerance: Optional[float] = None,
               budget_us: Optional[float] = None, warm_start: bool = False, chain: int = 100,
               threads: Optional[int] = None) -> ManyResult:
    """Solve many contacts by several threads, with Python's lock released.

    Gaps and arrays broadcast together. Each result has the bits that `Contact.solve` gives for
    that contact alone, whatever the number of threads (but by a budget of time). A contact that
    cannot be solved costs only itself: its status says why. No thread outlives the call.

    Parameters
    ----------
    gaps : tuple of arrays, or list of such tuples
        ``(y, h, inv2r)`` or ``(y, h, inv2r, inclination)`` as `Contact.set_gap` takes them, or a
        `Gap`: one gap for all contacts, each of shape (points,), mm, mm, 1/mm, rad; or many,
        points along the last axis, and the axes before it broadcast with the arguments below. A
        list has one gap for each contact along the last axis; they may have different numbers of
        points.
    load, penetration : array_like
        N, mm; one of the two.
    creepage : three array_like, or ndarray of shape (..., 3)
        Longitudinal, lateral and spin (rad/mm) creepage about y = 0.
    forces : two array_like or None
        Longitudinal and lateral force on the rail, N, in place of a creepage, which must be 0 and
        is found.
    mu : array_like
        Coefficient of friction.
    speed, contact_angle, rail_y : array_like
        Rolling speed, mm/s, contact angle, rad, and where y = 0 is on the profile of the rail, mm,
        for friction and temperatures that need them.
    material, friction, thermal, normal, tangential, strips_per_patch, points_per_strip, \
fastsim_grid, estimate, resolution_limit, force_limit, curved, target, tolerance, budget_us
        As of `Contact` and `Contact.solve`, the same for all contacts.
    warm_start : bool
        Start each contact from the one before it, along the last axis first, which is faster
        where neighbours are alike; the last digits then depend on it. The first of every `chain`
        contacts is a cold start, so that results do not depend on the threads.
    chain : int
        Contacts from one cold start to the next with warm_start.
    threads : int
        At most so many; by default as many as there are cores.

    Returns
    -------
    ManyResult
        Arrays of the shape that all of these broadcast to; empty ones if one of them is empty.

    Raises
    ------
    FaststripError
        Where an argument is wrong for all contacts. A number of an array that is not finite is its
        contact's (``not_finite``).

    Examples
    --------
    >>> y = np.linspace(-15.0, 15.0, 301)
    >>> result = solve_many((y, 2e-3 * y**2, 1.0 / 920.0), load=[5e4, 1e5, -1.0],
    ...                     creepage=(np.array([[0.0], [1e-3]]), 0.0, 0.0))
    >>> result.shape, result.counts
    ((2, 3), {'ok': 4, 'bad_load': 2})
    >>> (result.fx[1, :2] / 1e3).round(1).tolist()
    [-7.4, -12.1]
    """
    case = new_case(normal, tangential, strips_per_patch, points_per_strip, fastsim_grid, estimate,
                    resolution_limit, force_limit, curved)
    if (load is None) == (penetration is None):
        raise bad_argument("one of load and penetration must be given, got "
                           + ("none" if load is None else "both"))
    case.by_load = load is not None
    take_material(case, material)
    take_friction(case, friction)
    case.with_elements = thermal is not None
    take_thermal(case, thermal)
    want(case, target, tolerance, budget_us)
    case.warm_start = flag("warm_start", warm_start)
    links = whole("chain", chain, 1, MOST_CHAIN) if warm_start else 1
    n_threads = cores() if threads is None else whole("threads", threads, 1, MOST_THREADS)
    table = _Gaps(gaps)
    names = ["load" if case.by_load else "penetration", "cksi", "ceta", "cphi", "mu", "speed",
             "contact_angle", "rail_y"]
    told = [names[0], *CREEPAGE_NAMES, *names[4:]]
    values = [array(name, value) for name, value in zip(told, (
        load if case.by_load else penetration, *_creepages(creepage), mu, speed, contact_angle,
        rail_y))]
    fx, fy = several("forces", forces, "longitudinal and lateral, arrays or None", (2,))
    case.fx_is_given, case.fy_is_given = fx is not None, fy is not None
    for name, alias, value in zip(("given_fx", "given_fy"), FORCE_NAMES, (fx, fy)):
        if value is not None:
            names.append(name)
            told.append(alias)
            values.append(array(alias, value))
    try:
        shape = np.broadcast_shapes(table.shape, *(value.shape for value in values))
    except ValueError:
        shapes = [(name, value.shape) for name, value in zip(told, values) if value.ndim]
        raise bad_argument("shapes must broadcast, got " + ", ".join(
            f"{name} {shape}" for name, shape in [("gaps", table.shape), *shapes]
            if shape)) from None
    varying = {}
    for name, value in zip(names, values):
        if value.ndim == 0:
            setattr(case, name, value[()])
        else:
            varying[name] = np.broadcast_to(value, shape).reshape(-1)
    gap_of = None
    if table.table.size > 1:
        order = np.arange(table.table.size, dtype=np.int32).reshape(table.shape)
        gap_of = np.broadcast_to(order, shape).reshape(-1)
    return _solve_all(case, varying, table, gap_of, shape, links, n_threads)


def _solve_all(case: Case, varying: Dict[str, Array], table: _Gaps, gap_of: Any,
               shape: Tuple[int, ...], links: int, n_threads: int) -> ManyResult:
    """Call the library for so many contacts at a time that Ctrl-C is heard between the calls."""
    n = math.prod(shape)
    found = _Found(n)
    start, size = 0, FIRST_CALL * n_threads
    while start < n:
        size = max(links, size // links * links)
        end = min(start + size, n)
        begun = time.monotonic()
        _solve_some(case, varying, table, gap_of, start, end, links, n_threads, found)
        spent = max(time.monotonic() - begun, 1e-6)
        growth = min(4.0, max(0.25, CALL_SECONDS / spent))
        size = min(LONGEST_CALL, max(n_threads, int(size * growth)))
        start = end
    return found.result(shape)


def _solve_some(case: Case, varying: Dict[str, Array], table: _Gaps, gap_of: Any, start: int,
                end: int, links: int, n_threads: int, found: "_Found") -> None:
    n = end - start
    cases = np.empty(n, dtype=_CASE)
    cases[:] = np.frombuffer(bytes(case), dtype=_CASE)
    for name, values in varying.items():
        cases[name] = values[start:end]
    places = None if gap_of is None else np.ascontiguousarray(gap_of[start:end])
    figures, statuses = np.empty(n, dtype=_FIGURES), np.empty(n, dtype=np.int32)
    text = ctypes.create_string_buffer(TEXT)
    kept = cases, table, places, figures, statuses, text

    def call(kept: Any = kept) -> int:
        return library.faststrip_solve_many(
            n, cases.ctypes.data, table.table.size, table.table.ctypes.data,
            None if places is None else places.ctypes.data, links, n_threads, figures.ctypes.data,
            statuses.ctypes.data, text, TEXT)

    status = interruptible(call)
    words = text.value.decode("ascii", "replace")
    if status >= FIRST_ERROR:
        raise FaststripError(status, word_of(status), words)
    found.take(start, figures, statuses, words)


class _Found:
    """The arrays of a result, filled in piece by piece."""

    def __init__(self, n: int) -> None:
        self.columns: Dict[str, Any] = {}
        for one in fields(ManyResult)[:-1]:
            kind = {"Whole": np.int32, "Array": np.float64}.get(str(one.type), np.bool_)
            self.columns[one.name] = np.empty(n, dtype=kind)
        self.first: Tuple[int, str] = (-1, "")

    def take(self, start: int, figures: Any, statuses: Whole, words: str) -> None:
        """The contacts from `start` on."""
        here = slice(start, start + len(statuses))
        failed = statuses >= FIRST_ERROR
        not_estimated = figures["is_estimated"] == 0
        unknown = {"errors": not_estimated, "residuals": not_estimated,
                   "force errors": figures["forces_are_estimated"] == 0,
                   "temperatures": figures["temperatures_are_known"] == 0,
                   "target": figures["target_is_known"] == 0}
        self.columns["status"][here] = statuses
        for name, column in self.columns.items():
            if name == "status":
                continue
            column[here] = figures[name]
            if column.dtype != np.float64:
                continue
            nothing = unknown.get(QUANTITIES[name][2], failed)
            if nothing.any():
                column[here][nothing] = np.nan
        if words and self.first[0] < 0:
            place, _, why = words.partition(": ")
            self.first = start + int(place[len("contacts["):-1]), why

    def result(self, shape: Tuple[int, ...]) -> ManyResult:
        """All of them."""
        place, why = self.first
        told = ""
        if place >= 0:
            index = tuple(int(i) for i in np.unravel_index(place, shape))
            told = f"contact {list(index) if len(index) != 1 else index[0]}: {why}"
        return ManyResult(**{name: column.reshape(shape)
                             for name, column in self.columns.items()}, first_error=told)
