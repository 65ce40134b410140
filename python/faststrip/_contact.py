"""Contacts with numpy arrays in and out."""

from __future__ import annotations

import ctypes
import operator
from ctypes import c_double, c_int, c_void_p
from dataclasses import MISSING, dataclass, fields
from typing import Any, Dict, List, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._arguments import (
    above_zero,
    array,
    as_long_as,
    flag,
    from_zero,
    number,
    numbers,
    refused,
    several,
    whole,
)
from ._catalogue import Case, Figures
from ._interrupt import interruptible
from ._library import (
    FIRST_ERROR,
    NO_CONVERGENCE,
    TOO_SMALL,
    FaststripError,
    Handle,
    bad_argument,
    check,
    check_case,
    library,
    limitation_words,
    told,
    warn_of_doubts,
    word_of,
)
from ._profile import Gap
from ._results import Elements, Result, Step, Stresses, StressPeak, Strips
from ._wear import (
    CONSTANT,
    Flash,
    Friction,
    StripWear,
    Thermal,
    Wear,
    WearLaw,
    WearQuestion,
    take_flash,
    take_friction,
    take_thermal,
    temperatures,
)

Array = npt.NDArray[np.float64]

# BEGIN methods, written by tools/generate/methods.py
NORMAL = {
    "strip": 1,           # strips, for any patch and any number of patches
    "hertz": 2,           # the Hertz ellipse where the gap is lowest
    "equal_area": 3,      # ellipses of equal area, proportions of Hertz
    "equal_moments": 4,   # the same, proportions of the second moments
    "auto": 6,            # both methods, as fine as estimated errors ask
    "kpec": 7,            # Kik and Piotrowski with the elliptic correction
    "analyn": 8,          # Sichani, Enblom and Berg, strips as local ellipses
    "kpec_strips": 9,     # strips in the patch of KPEC, pressures their own
}
TANGENTIAL = {
    "none": 0,                  # no forces
    "faststrip": 1,             # marching in the strips: the best fast one
    "fastsim": 2,               # Kalker's FASTSIM on the patches' ellipses
    "faststrip-paper": 3,       # TFASTSTRIP as printed
    "faststrip-corrected": 4,   # TFASTSTRIP as corrected
    "fastsim-elliptic": 5,      # FASTSIM with the elliptic traction bound
    "fastsim-weighted": 6,      # FASTSIM with a single flexibility
    "linear": 7,                # Kalker's linear theory; no elements
    "she": 8,                   # Shen, Hedrick and Elkins; no elements
    "polach": 9,                # Polach; no elements
    "faststrip-plain": 11,      # FASTSTRIP without its correction
}
# END methods

# What normal="auto" is to know as well as the tolerance asks.
TARGETS = {
    "forces": 1,        # the worst of est_err_fx, est_err_fy, est_err_mz
    "pmax": 2,          # est_err_pmax
    "penetration": 3,   # est_err_penetration
    "area": 4,          # est_err_area
    "power": 5,         # friction power, relative
}

# Limits of the library.
MOST_STRIPS = 1000
MOST_POINTS = 1000
MOST_ROWS = 10000
GAP_POINTS = 5, 1000000
# Of auto, where neither tolerance nor budget is given.
TOLERANCE = 0.02

# From here on a call may take more than a tenth of a second on a slow machine, and is made so that
# Ctrl-C ends it, which costs 10 to 40 us: strips of a patch, points of FASTSIM, points of a gap.
# Below, the slowest gaps seen took 0.15 s (waves, 31 strips, a busy machine).
LONG_STRIPS = 31
LONG_GRID = 100000
LONG_GAP = 100000
# Points with stresses.
LONG_POINTS = 2000
# Numbers of such a point.
N_STRESSES = 11
# FASTSIM and its variants.
BY_GRID = 2, 5, 6


@dataclass(frozen=True)
class Material:
    """Elastic constants of both bodies; steel on steel by default.

    Parameters
    ----------
    e_wheel, e_rail : float
        Young's moduli, MPa.
    nu_wheel, nu_rail : float
        Poisson's ratios.
    """

    e_wheel: float = 209920.0
    e_rail: float = 209920.0
    nu_wheel: float = 0.28
    nu_rail: float = 0.28

    @property
    def shear_modulus(self) -> float:
        """The combined shear modulus, MPa."""
        wheel = self.e_wheel / (2.0 * (1.0 + self.nu_wheel))
        rail = self.e_rail / (2.0 * (1.0 + self.nu_rail))
        return 2.0 / (1.0 / wheel + 1.0 / rail)


# Of `Contact.solve`: creepages are given.
NO_FORCES = None, None

# What a result takes from the library's struct: by its names, whatever their order there.
ESTIMATES = 5
OF_FORCES = 5
_names = [one.name for one in fields(Result) if one.default is MISSING]
_figures_of = operator.attrgetter(*_names[2:-ESTIMATES - OF_FORCES])
_estimates_of = operator.attrgetter(*_names[-ESTIMATES - OF_FORCES:-OF_FORCES])
_force_errors_of = operator.attrgetter(*_names[-OF_FORCES:])
_NO_ESTIMATES = (None,) * ESTIMATES
_NO_FORCE_ERRORS = (None,) * OF_FORCES
_NAMES_OF_NORMAL = {number: name for name, number in NORMAL.items()}
_NAMES_OF_TANGENTIAL = {number: name for name, number in TANGENTIAL.items()}


def number_of(names: Dict[str, int], name: Any, what: str) -> int:
    """The number of a name, of those there are."""
    if not isinstance(name, str) or name not in names:
        raise bad_argument(f"{what} must be one of {', '.join(names)}, got {name!r}")
    return names[name]


MATERIAL_NAMES = "material.e_wheel", "material.e_rail", "material.nu_wheel", "material.nu_rail"
CREEPAGE_NAMES = "creepage[0]", "creepage[1]", "creepage[2]"
MOTION_NAMES = "speed", "contact_angle", "rail_y"
FORCE_NAMES = "forces[0]", "forces[1]"
FASTSIM_NAMES = ("a", "b", "shear_modulus", "coefficients[0]", "coefficients[1]",
                 "coefficients[2]", *CREEPAGE_NAMES, "mu", "load")


def new_case(normal: Any, tangential: Any, strips_per_patch: Any, points_per_strip: Any,
             fastsim_grid: Any, estimate: Any, resolution_limit: Any, force_limit: Any,
             curved: Any) -> Case:
    """A case with methods and how errors are estimated; the rest is as the library has it."""
    case = Case()
    check(library.faststrip_default_case(ctypes.byref(case), ctypes.sizeof(Case)))
    case.normal = number_of(NORMAL, normal, "normal")
    case.tangential = number_of(TANGENTIAL, tangential, "tangential")
    auto = isinstance(strips_per_patch, str) and strips_per_patch == "auto"
    case.strips_per_patch = 0 if auto else whole("strips_per_patch", strips_per_patch, 1,
                                                 MOST_STRIPS, ", or 'auto'")
    case.points_per_strip = whole("points_per_strip", points_per_strip, 1, MOST_POINTS)
    case.fastsim_nx, case.fastsim_ny = grid_of("fastsim_grid", fastsim_grid)
    case.estimate = flag("estimate", estimate)
    case.resolution_limit = above_zero("resolution_limit", resolution_limit)
    case.force_limit = above_zero("force_limit", force_limit)
    case.curved = flag("curved", curved)
    return case


def take_material(case: Case, material: Any) -> None:
    """Put elastic constants into a case."""
    case.e_wheel, case.e_rail, case.nu_wheel, case.nu_rail = _material_of(material)


def want(case: Case, target: Any, tolerance: Any, budget_us: Any) -> None:
    """Put what is wanted of auto into a case; other methods refuse it."""
    if case.normal != NORMAL["auto"]:
        for name, value in (("target", target), ("tolerance", tolerance),
                            ("budget_us", budget_us)):
            if value is not None:
                raise refused(name, "None unless normal is 'auto'", value)
        return
    case.target = TARGETS["forces"] if target is None else number_of(TARGETS, target, "target")
    case.budget_us = 0.0 if budget_us is None else from_zero("budget_us", budget_us)
    if tolerance is not None:
        case.tolerance = from_zero("tolerance", tolerance)
    else:
        case.tolerance = 0.0 if case.budget_us > 0.0 else TOLERANCE


def _material_of(material: Any) -> List[float]:
    if not isinstance(material, Material):
        raise refused("material", "a faststrip.Material", material)
    return numbers(MATERIAL_NAMES, (material.e_wheel, material.e_rail, material.nu_wheel,
                                    material.nu_rail))


def give_forces(case: Case, forces: Any) -> None:
    """Put forces that are given in place of creepages into a case."""
    fx, fy = several("forces", forces, "longitudinal and lateral, a number or None", (2,))
    case.fx_is_given, case.fy_is_given = fx is not None, fy is not None
    case.given_fx, case.given_fy = numbers(
        FORCE_NAMES, (0.0 if fx is None else fx, 0.0 if fy is None else fy))


def _three_creepages(creepage: Any) -> Tuple[Any, ...]:
    return several("creepage", creepage, "longitudinal, lateral and spin", (3,))


def parts_of_gap(name: str, gap: Union[Tuple[Any, ...], Gap]) -> List[Any]:
    """y, h, inv2r and, if there is one, the inclination; a `Gap` has more."""
    if not (isinstance(gap, Gap) or len(gap) in (3, 4)):
        raise refused(name, "a tuple (y, h, inv2r) or (y, h, inv2r, inclination)", gap)
    parts = list(gap[:4])
    return parts[:3] if len(parts) == 4 and parts[3] is None else parts


def grid_of(name: str, grid: Any) -> Tuple[int, int]:
    """Points along a row, and rows."""
    nx, ny = several(name, grid, "points along a row and rows", (2,))
    return whole(name, nx, 1, MOST_ROWS), whole(name, ny, 1, MOST_ROWS)


def _arrays(n: int, doubles: int) -> list:
    return [*(np.empty(n) for _ in range(doubles)), np.empty(n, dtype=np.int32)]


def _addresses(arrays: list) -> list:
    return [c_void_p(array.ctypes.data) for array in arrays]


def fetch(call: Any, function: Any, doubles: int, *first: int) -> list:
    """As many numbers as a function of the library has, in so many arrays, and one of integers."""
    n = c_int()
    arrays = _arrays(0, doubles)
    try:
        call(function, *first, 0, ctypes.byref(n), *_addresses(arrays))
    except FaststripError as problem:
        if problem.status != TOO_SMALL:
            raise
    arrays = _arrays(n.value, doubles)
    call(function, *first, n.value, ctypes.byref(n), *_addresses(arrays))
    return arrays


def slopes(call: Any, function: Any, shape: Tuple[int, ...]) -> Array:
    """Derivatives at the last solution; nan of a contact, or a wheel, where patches come or go."""
    found = np.full(shape, np.nan)
    try:
        call(function, found.ctypes.data)
    except FaststripError as problem:
        if problem.status != NO_CONVERGENCE:
            raise
    return found


def strip_wear(call: Any, function: Any, n_strips: int, law: Optional[WearLaw],
               *first: int) -> StripWear:
    """Forces and wear of so many strips."""
    question = WearQuestion(law, None)
    n, arrays = c_int(), np.empty((6, n_strips))
    call(function, *first, question.law, n_strips, ctypes.byref(n), *_addresses(list(arrays)))
    return StripWear(*(row.copy() for row in arrays[:4]),
                     *((row.copy() if law is not None else None) for row in arrays[4:]))


class Contact:
    """One wheel on one rail: methods, their workspace, the gap, the last solution.

    Use one Contact per thread; calls release Python's lock while they compute. Ctrl-C ends a call;
    after that the contact needs a gap again.

    Parameters
    ----------
    normal : str
        A name of ``NORMAL``, where each has a line. With ``auto`` both methods are
        as fine as their estimated errors ask, see `solve`.
    tangential : str
        A name of ``TANGENTIAL``; some give forces alone, no elements.
    strips_per_patch : int or str
        Across the largest patch, 1 to 1000, or ``auto``.
    points_per_strip : int
        Along a strip, 1 to 1000, of FASTSTRIP.
    fastsim_grid : two ints
        Points along a row, and rows, of FASTSIM.
    with_elements : bool
        Are tractions and slip of every element kept, for `elements`, `stresses` and `plot`?
    max_points : int
        Points of a gap there is room for at first; longer ones get room.
    estimate : bool
        Are errors estimated? Of strips that costs about one step.
    resolution_limit, force_limit : float
        A result with an estimated relative error of penetration, pmax or area above the first, or
        an estimated error of its forces above the second, is called ``under_resolved``.
    curved : bool
        Do strips lie on the curved surface, each with its own plane? Gaps need an inclination
        then; the load is the force along the normal of the contact.
    """

    def __init__(self, *, normal: str = "strip", tangential: str = "faststrip",
                 strips_per_patch: Union[int, str] = 15, points_per_strip: int = 15,
                 fastsim_grid: Tuple[int, int] = (50, 50), with_elements: bool = False,
                 max_points: int = 1000, estimate: bool = True,
                 resolution_limit: float = 0.1, force_limit: float = 0.1,
                 curved: bool = False) -> None:
        self._workspace: Optional[Handle] = None
        self._closed = False
        self._material: Any = Material  # that is in the case; none yet
        self._friction: Any = CONSTANT  # that is in the case
        case = self._case = new_case(normal, tangential, strips_per_patch, points_per_strip,
                                     fastsim_grid, estimate, resolution_limit, force_limit, curved)
        case.with_elements = flag("with_elements", with_elements)
        self._reserve(whole("max_points", max_points, *GAP_POINTS))

    def _reserve(self, max_points: int) -> None:
        workspace, case = Handle(library.faststrip_free), self._case
        arguments = ctypes.byref(case), max_points, ctypes.byref(workspace.handle)

        def make() -> Tuple[int, Handle]:
            return library.faststrip_new(*arguments), workspace

        # A large workspace is a matter of seconds too.
        elements = case.fastsim_nx * case.fastsim_ny if case.with_elements else 0
        long = case.strips_per_patch > 100 or elements > LONG_GRID or max_points > LONG_GAP
        status, _ = interruptible(make, self._abandon) if long else make()
        if status >= FIRST_ERROR:
            check_case(case, max_points)
            check(status)
        self._workspace = workspace
        self._max_points = max_points
        # What may take longer than a moment; elsewhere a thread of its own would cost too much.
        strips = case.strips_per_patch if case.normal != NORMAL["hertz"] else 1
        grid = case.fastsim_nx * case.fastsim_ny if case.tangential in BY_GRID else 0
        self._long = (case.normal == NORMAL["auto"] or strips == 0 or strips > LONG_STRIPS
                      or grid > LONG_GRID or max_points > LONG_GAP)

    def _abandon(self) -> None:
        """Leave workspace and case to a call that goes on after it was interrupted."""
        self._workspace = None
        self._case = Case.from_buffer_copy(self._case)

    def _open_workspace(self) -> Handle:
        if self._workspace is None:
            raise bad_argument("the contact is closed" if self._closed else
                               "the last call was interrupted: set the gap again")
        return self._workspace

    def _call(self, function: Any, *arguments: Any, long: bool = False, keep: Any = None) -> int:
        """The status of a call on the workspace; if it is long, `keep` is kept until its end."""
        workspace = self._open_workspace()
        if not workspace.in_use.acquire(False):
            raise bad_argument("the contact is in use by another thread")
        try:
            if long:
                def call(kept: Any = keep) -> Any:
                    return function(workspace.handle, *arguments)

                status = interruptible(call, self._abandon)
            else:
                status = function(workspace.handle, *arguments)
            return check(status, workspace.handle) if status >= FIRST_ERROR else status
        finally:
            workspace.in_use.release()

    def close(self) -> None:
        """Give the memory back; the contact cannot be used afterwards."""
        self._workspace = None
        self._closed = True

    def __enter__(self) -> "Contact":
        return self

    def __exit__(self, *problem: Any) -> None:
        self.close()

    def __reduce__(self) -> Any:
        raise TypeError("a Contact cannot be copied or pickled: make one in every process, "
                        "or use copy_from")

    def set_gap(self, y: Union[npt.ArrayLike, Gap, Tuple[Array, ...]],
                h: Optional[npt.ArrayLike] = None, inv2r: Optional[npt.ArrayLike] = None,
                inclination: Optional[npt.ArrayLike] = None,
                turn: Optional[npt.ArrayLike] = None) -> None:
        """The gap of the undeformed bodies, ``h(x, y) = h(y) + x**2 inv2r(y)``; it is copied.

        Parameters
        ----------
        y : array_like, shape (n,), or Gap
            Lateral coordinate, strictly increasing, mm; 5 to 1000000 points. Or all of the gap, as
            `profile_gap` and `Wheelset.gap` give it, and nothing else.
        h : array_like, shape (n,) or ()
            Gap on the line x = 0, mm.
        inv2r : array_like, shape (n,) or ()
            1/(2 R) with the local radius R along x, 1/mm.
        inclination : array_like, shape (n,) or (), optional
            How far the surfaces have turned from the tangent plane at y = 0, rad, by which
            conformal contacts are named.
        turn : array_like, optional
            Old name of inclination.

        Raises
        ------
        FaststripError
            ``bad_argument``, ``not_finite``, ``not_increasing``, ``too_few_points``.
        """
        if turn is not None:
            if inclination is not None:
                raise bad_argument("inclination must not be given twice, got turn too")
            inclination = turn
        if isinstance(y, (Gap, tuple)) and h is None and inv2r is None and inclination is None:
            y, h, inv2r, inclination = [*parts_of_gap("a gap", y), None][:4]
        elif isinstance(y, Gap):
            raise bad_argument("a Gap must be given alone: it has h, inv2r and inclination")
        points = array("y", y)
        if points.ndim != 1:
            raise bad_argument(f"y must be one-dimensional, got shape {points.shape}")
        if points.size > GAP_POINTS[1]:
            raise bad_argument(f"y must have at most {GAP_POINTS[1]} points, got {points.size}")
        others = [as_long_as(points, "h", h), as_long_as(points, "inv2r", inv2r)]
        if inclination is not None:
            others.append(as_long_as(points, "inclination", inclination))
        if not self._closed and (self._workspace is None or points.size > self._max_points):
            self._reserve(max(points.size, self._max_points))
        addresses = _addresses([points, *others])
        if inclination is None:
            addresses.append(None)
        self._call(library.faststrip_set_gap, points.size, *addresses,
                   long=points.size > LONG_GAP, keep=(points, others))

    def solve(self, *, load: Optional[float] = None, penetration: Optional[float] = None,
              creepage: Tuple[float, float, float] = (0.0, 0.0, 0.0),
              forces: Tuple[Optional[float], Optional[float]] = NO_FORCES, mu: float = 0.3,
              material: Material = Material(), friction: Friction = CONSTANT, speed: float = 0.0,
              contact_angle: float = 0.0, rail_y: float = 0.0, warm_start: bool = False,
              target: Optional[str] = None, tolerance: Optional[float] = None,
              budget_us: Optional[float] = None, derivatives: bool = False,
              thermal: Optional[Thermal] = None) -> Result:
        """Solve for a load or a penetration: one of the two.

        Parameters
        ----------
        load : float
            Normal force, N.
        penetration : float
            From h = 0, mm.
        creepage : three floats
            Longitudinal, lateral and spin (rad/mm) creepage about y = 0.
        forces : two floats or None
            Longitudinal and lateral force on the rail, N, in place of a creepage, which must be 0
            and is found: cksi and ceta of the result.
        mu : float
            Coefficient of friction.
        material : Material
            Elastic constants of both bodies.
        friction : Friction
            How mu falls with slip or temperature, which needs the speed, and what it is on the
            flange or across the rail, for which contact_angle and rail_y count.
        speed : float
            Rolling speed, mm/s.
        contact_angle : float
            Of either sign, rad.
        rail_y : float
            Where y = 0 is on the profile of the rail, mm: for friction at places over the rail.
        warm_start : bool
            Begin with the last solution, if there is one.
        target : str
            Of a contact with normal ``auto``: one of ``TARGETS``, ``forces`` by default.
            Where it needs forces, ``faststrip`` gives them, whatever tangential is, but not
            ``none``.
        tolerance : float
            The largest estimated error of the target that will do, 0.02 by default;
            ``target_missed`` is as near as strips come.
        budget_us : float
            Time for it, us: without a tolerance it gives the least estimated error in that time.
        derivatives : bool
            Are those over penetration and creepages wanted, too? Not of ``auto`` and references.
        thermal : Thermal, optional
            What makes `flash` and `temperatures` known; it needs the speed, and a contact made
            with_elements.

        Returns
        -------
        Result
            Figures; of ``auto`` also the steps that were taken.

        Raises
        ------
        FaststripError
            Where there is no result.

        Warns
        -----
        ImplausibleWarning
            Of a number that no contact has in practice, mostly a unit; nothing changes by it.
        """
        if (load is None) == (penetration is None):
            raise bad_argument("one of load and penetration must be given, got "
                               + ("none" if load is None else "both"))
        case = self._case
        case.by_load = load is not None
        case.load = 0.0 if load is None else number("load", load)
        case.penetration = 0.0 if penetration is None else number("penetration", penetration)
        case.cksi, case.ceta, case.cphi = numbers(CREEPAGE_NAMES, _three_creepages(creepage))
        if forces is not NO_FORCES or case.fx_is_given or case.fy_is_given:
            give_forces(case, forces)
        case.mu = number("mu", mu)
        if material is not self._material:
            take_material(case, material)
            self._material = material
        if friction is not self._friction:
            take_friction(case, friction)
            self._friction = friction
        case.speed, case.contact_angle, case.rail_y = numbers(MOTION_NAMES,
                                                              (speed, contact_angle, rail_y))
        take_thermal(case, thermal)
        case.warm_start = flag("warm_start", warm_start)
        want(case, target, tolerance, budget_us)
        figures = Figures()
        try:
            status = self._call(library.faststrip_solve, ctypes.byref(case),
                                ctypes.byref(figures), long=self._long)
        finally:
            if self._workspace is not None:
                warn_of_doubts(self._workspace.handle)
        found: Tuple[Any, ...] = (
            status, word_of(status), *_figures_of(figures),
            *(_estimates_of(figures) if figures.is_estimated else _NO_ESTIMATES),
            *(_force_errors_of(figures) if figures.forces_are_estimated else _NO_FORCE_ERRORS),
            *(self._taken(figures) if figures.n_steps else (None, None, ())),
            limitation_words(figures.limitations),
            slopes(self._call, library.faststrip_get_derivatives, (4, 4))
            if flag("derivatives", derivatives) else None)
        return Result(*found)

    def _taken(self, figures: Figures) -> Tuple[Optional[float], Optional[bool], Tuple[Step, ...]]:
        """What came of auto: estimated error of the target, is it met, the steps."""
        n, most = c_int(), figures.n_steps
        whole_numbers = [np.empty(most, dtype=np.int32) for _ in range(4)]
        reals = [np.empty(most) for _ in range(3)]
        self._call(library.faststrip_get_steps, most, ctypes.byref(n),
                   *_addresses([*whole_numbers, *reals]))
        steps = tuple(
            Step(_NAMES_OF_NORMAL[normal], _NAMES_OF_TANGENTIAL[tangential], strips, points,
                 estimate if estimate >= 0.0 else None, normal_us, tangential_us,
                 i == figures.best_step)
            for i, (normal, tangential, strips, points, estimate, normal_us, tangential_us)
            in enumerate(zip(*(values.tolist() for values in (*whole_numbers, *reals))), 1))
        estimate = figures.est_err_target if figures.target_is_known else None
        is_met = figures.target_is_met == 1 if self._case.tolerance > 0.0 else None
        return estimate, is_met, steps

    def strips(self) -> Strips:
        """The strips of the last contact.

        Returns
        -------
        Strips
            Edges, half-lengths and pressures, patch by patch; empty before the first solution.
        """
        return Strips(*fetch(self._call, library.faststrip_get_strips, 4))

    def elements(self) -> Elements:
        """The elements of the last contact.

        Returns
        -------
        Elements
            Pressures, tractions, slip and states; empty unless the Contact was made with_elements.
        """
        return Elements(*fetch(self._call, library.faststrip_get_elements, 8))

    def stresses(self, x: Any, y: Any, z: Any) -> Stresses:
        """Stresses of the rail at points below the last contact.

        Parameters
        ----------
        x, y, z : array_like
            Points in the frame of the contact, z the depth from 0 on, mm; of shapes that numpy
            broadcasts together.

        Returns
        -------
        Stresses
            In the shape of the points. On the surface they are good at the middles of elements.

        Raises
        ------
        FaststripError
            Unless the Contact was made with_elements, or with tangential ``none``.
        """
        given = [array(name, value) for name, value in (("x", x), ("y", y), ("z", z))]
        try:
            spread = np.broadcast_arrays(*given)
        except ValueError:
            raise bad_argument("x, y and z must have shapes that fit together, got "
                               + ", ".join(str(one.shape) for one in given)) from None
        points, shape = [one.ravel() for one in spread], spread[0].shape
        n = points[0].size
        found = np.empty((n, N_STRESSES))
        self._call(library.faststrip_get_stresses, n, *_addresses([*points, found]),
                   long=n > LONG_POINTS, keep=(points, found))
        return Stresses(*(one.reshape(shape).copy() for one in (*points, *found.T)))

    def stress_peak(self) -> StressPeak:
        """The largest von Mises stress of the rail below the last contact.

        Returns
        -------
        StressPeak
            With its estimated relative error.

        Raises
        ------
        FaststripError
            Unless the Contact was made with_elements, or with tangential ``none``.
        """
        figures = (c_double * len(fields(StressPeak)))()
        self._call(library.faststrip_get_stress_peak, figures)
        return StressPeak(*figures)

    def wear(self, law: Optional[WearLaw] = None, *,
             yield_shear: Optional[float] = None) -> Wear:
        """T gamma of the last contact, wear by a law, its fatigue index.

        Parameters
        ----------
        law : WearLaw, optional
            It needs tangential ``faststrip`` or ``faststrip-plain``.
        yield_shear : float, optional
            Yield stress in cyclic shear, MPa, for the fatigue index.

        Returns
        -------
        Wear
        """
        question = WearQuestion(law, yield_shear)
        self._call(library.faststrip_get_wear, question.law, question.yield_shear,
                   question.figures)
        return question.answer()

    def strip_wear(self, law: Optional[WearLaw] = None) -> StripWear:
        """Forces and wear of the strips of the last contact.

        Parameters
        ----------
        law : WearLaw, optional
            Without one there are forces alone.

        Returns
        -------
        StripWear
            In the order of `strips`.

        Raises
        ------
        FaststripError
            Where tangential is not ``faststrip`` or ``faststrip-plain``.
        """
        return strip_wear(self._call, library.faststrip_get_strip_wear, len(self.strips().p0), law)

    def flash(self) -> Flash:
        """Largest rise and temperature of the last contact, if it was solved with a thermal.

        Returns
        -------
        Flash
        """
        return take_flash(self._call, library.faststrip_get_flash)

    def temperatures(self, x: npt.ArrayLike, y: npt.ArrayLike) -> Tuple[Array, Array]:
        """Temperatures of both surfaces of the last contact, if it was solved with a thermal.

        Parameters
        ----------
        x, y : array_like
            Places, mm: in the contact, behind it, ahead of it, beside it.

        Returns
        -------
        wheel, rail : ndarray of float
            C, at each of them; in the contact both are one.
        """
        return temperatures(self._call, library.faststrip_get_temperatures, x, y)

    def plot(self, figure: Any = None) -> Any:
        """Draw the last contact with matplotlib: the patch with its strips and pressures, pressures
        on the centre line, and, if the contact was made with_elements, tractions on the rail with
        the border of adhesion.

        Parameters
        ----------
        figure : matplotlib.figure.Figure
            To draw on; a new one unless given.

        Returns
        -------
        matplotlib.figure.Figure
        """
        from ._plot import plot_contact

        return plot_contact(self.strips(), self.elements(), figure)

    def copy_from(self, other: "Contact") -> None:
        """Take over gap, solution and capacity of another contact, for a step taken back.

        Parameters
        ----------
        other : Contact
            It stays as it is.
        """
        if not isinstance(other, Contact):
            raise refused("other", "a Contact", other)
        if other is self:
            return
        mine = self._open_workspace()
        other._call(library.faststrip_copy, mine.handle)
        self._max_points, self._long = other._max_points, other._long or self._long


def fastsim(a: float, b: float, coefficients: Tuple[float, float, float],
            creepage: Tuple[float, float, float], mu: float, load: float, *,
            shear_modulus: float = Material().shear_modulus,
            grid: Tuple[int, int] = (50, 50)) -> Tuple[float, float, float]:
    """FASTSIM on a Hertz ellipse.

    Parameters
    ----------
    a, b : float
        Semi-axes along x and along y, mm.
    coefficients : three floats
        Kalker's C11, C22, C23; a fourth is passed over.
    creepage : three floats
        Longitudinal, lateral and spin (rad/mm) creepage.
    mu : float
        Coefficient of friction.
    load : float
        Normal force, N.
    shear_modulus : float
        Of both bodies together, MPa.
    grid : two ints
        Points along a row, and rows.

    Returns
    -------
    fx, fy, mz : float
        Forces, N, and moment, N mm, on the rail.
    """
    forces = (c_double * 3)()
    c = several("coefficients", coefficients, "C11, C22, C23", (3, 4))
    nx, ny = grid_of("grid", grid)
    values = numbers(FASTSIM_NAMES, (a, b, shear_modulus, c[0], c[1], c[2],
                                     *_three_creepages(creepage), mu, load))
    if nx * ny > LONG_GRID:
        status = interruptible(lambda: library.faststrip_fastsim(*values, nx, ny, forces))
    else:
        status = library.faststrip_fastsim(*values, nx, ny, forces)
    if status >= FIRST_ERROR:
        check(status, None, **dict(zip(FASTSIM_NAMES, values)), grid=grid)
    return tuple(forces)


def hertz(inv2r_x: float, inv2r_y: float, load: float,
          material: Material = Material()) -> Tuple[float, float, float, float]:
    """Hertz's contact of the gap ``inv2r_x x**2 + inv2r_y y**2``.

    Parameters
    ----------
    inv2r_x, inv2r_y : float
        1/(2 R) along x and along y, 1/mm.
    load : float
        Normal force, N.
    material : Material
        Elastic constants of both bodies.

    Returns
    -------
    a, b : float
        Semi-axes along x and along y, mm.
    penetration : float
        mm.
    pmax : float
        Maximum pressure, MPa.
    """
    figures = (c_double * 4)()
    check(library.faststrip_hertz(*_material_of(material), number("inv2r_x", inv2r_x),
                                  number("inv2r_y", inv2r_y), number("load", load), figures),
          None, inv2r_x=inv2r_x, inv2r_y=inv2r_y, load=load, material=material)
    return tuple(figures)


def kalker(a_over_b: float, nu: float = 0.28) -> Tuple[float, float, float, float]:
    """Kalker's creepage coefficients of an ellipse.

    Parameters
    ----------
    a_over_b : float
        Semi-axis along x over that along y, any above 0.
    nu : float
        Poisson's ratio.

    Returns
    -------
    c11, c22, c23, c33 : float
    """
    coefficients = (c_double * 4)()
    check(library.faststrip_kalker(number("a_over_b", a_over_b), number("nu", nu), coefficients),
          None, a_over_b=a_over_b, nu=nu)
    return tuple(coefficients)


def library_version() -> str:
    """The version of the library, which is that of this package or a compatible one."""
    return told(library.faststrip_version)
