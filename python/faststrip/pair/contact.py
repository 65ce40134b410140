"""From two profiles to the forces of one contact."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any, Dict, Optional, Tuple

from .._arguments import number, numbers, several
from .._contact import CREEPAGE_NAMES, Contact
from .._profile import Gap
from .._record import Row, described
from .._results import Elements, Result, Strips
from .bodies import Body, Creepages, Options, Pair, check_yaw, demand_of, track_forces

if TYPE_CHECKING:
    from .bodies import Unpack

# Of the solver, not of its workspace.
OF_SOLVE = "material", "friction", "speed", "target", "tolerance", "budget_us"


@dataclass(frozen=True)
class Placed(Row):
    """Where a contact is, and how it moves."""

    y: float
    contact_angle: float
    radius: float
    rail_y: float
    wheel_y: float
    cksi: float
    ceta: float
    cphi: float
    force_y: float
    force_z: float
    gap: Gap = field(repr=False, compare=False)
    strips: Strips = field(repr=False, compare=False)
    elements: Elements = field(repr=False, compare=False)


# Of a `Result`, what `Placed` has not got.
FIGURES = [one.name for one in fields(Result)
           if one.name not in {other.name for other in fields(Placed)}]


@described
@dataclass(frozen=True)
class ContactResult(Result, Placed):
    """The contact of a right wheel on the right rail: a `Result`, and where it comes from.

    Attributes
    ----------
    y : float
        Lateral displacement of the wheelset to the right, mm.
    <figures>
    gap : Gap
        Of both profiles about the contact.
    strips : Strips
        Of the contact, y from its place.
    elements : Elements
        The same; empty where a method has none.
    limitations : tuple of str
        As of a `Result`, as are the others.
    status : int
        As well.
    word : str
        As well.
    target_is_met : bool, or None
        As well.
    steps : tuple of Step
        As well.
    derivatives : ndarray of float, or None
        There are none: take a `Contact`.
    """

    def _columns(self) -> Dict[str, Any]:
        columns = super()._columns()
        for name in ("gap", "strips", "elements"):
            del columns[name]
        return columns

    def plot(self, figure: Any = None) -> Any:
        """Draw the patch with its pressures, pressures on the centre line, and tractions on the
        rail with the border of adhesion.

        Parameters
        ----------
        figure : matplotlib.figure.Figure
            To draw on; a new one unless given.

        Returns
        -------
        matplotlib.figure.Figure
        """
        from .._plot import plot_contact

        return plot_contact(self.strips, self.elements, figure)


def contact(wheel: Body, rail: Body, y: float = 0.0, *, vertical_load: Optional[float] = None,
            load: Optional[float] = None, penetration: Optional[float] = None,
            creepage: Optional[Tuple[float, float, float]] = None, yaw: float = 0.0,
            mu: float = 0.3, inclination: Optional[float] = None, wheel_radius: float = 460.0,
            **options: Unpack[Options]) -> ContactResult:
    """The contact of a right wheel on the right rail, from profiles to forces.

    It is that of ``faststrip contact``: the wheel comes down vertically, without roll, and its
    first point of contact is the one that is solved. Two-point contacts with flange and tread are
    for a `Wheelset`.

    Parameters
    ----------
    wheel, rail : str, path or Profile
        A name (``s1002``, ``cone20``, ``cone40``; ``uic60``, ``60e1``, ``54e1``), the path of a
        file that needs no options to be read, or a `Profile`.
    y : float
        Lateral displacement of the wheelset to the right, mm: above 0 the flange of this wheel
        comes near the rail. The left wheel is this one at -y, in its mirror: lateral forces, spin
        and moment of the other sign.
    vertical_load, load, penetration : float
        Vertical wheel load or normal force, N, or penetration, mm; one of the three.
    creepage : three floats, optional
        Longitudinal, lateral and spin (rad/mm) creepage. Not given they are those of a wheelset
        that rolls steadily on rigid axles: of the rolling radius difference of both wheels, of the
        yaw, of the contact angle.
    yaw : float
        Nose to the right, rad. It counts for the lateral creepage, not for the gap.
    mu : float
        Coefficient of friction.
    inclination : float, optional
        Rail inclination: the tangent by which the rail leans to the track's centre. Not given
        0.025 (1:40) for a name; a file or a Profile must have one: 0 where its points lie as in
        the track.
    wheel_radius : float
        Rolling radius at the nominal rolling circle, mm.
    **options
        back_spacing, tread_line, gauge, gauge_depth, step, height and roller_radius as of
        `profile_gap`, on a roller with all creepages given; material, friction, speed, target,
        tolerance and budget_us as of `Contact.solve`; normal, tangential, strips_per_patch,
        points_per_strip, fastsim_grid, estimate, resolution_limit, force_limit and curved as of
        `Contact`.

    Returns
    -------
    ContactResult

    Raises
    ------
    FaststripError
        Where the profiles do not touch, or an argument is wrong.

    Warns
    -----
    ImplausibleWarning
        As of `Contact.solve`.

    Examples
    --------
    >>> found = contact("s1002", "60e1", y=3.0, vertical_load=80e3)
    >>> found.word, round(found.fx / 1e3, 2), round(found.fy / 1e3, 2)
    ('ok', -9.85, -5.58)
    """
    pair = Pair("contact", wheel, rail, inclination, wheel_radius, options)
    demand = demand_of(vertical_load, load, penetration)
    check_yaw(creepage, yaw)
    given: Optional[Creepages] = None
    if creepage is not None:
        cksi, ceta, cphi = numbers(CREEPAGE_NAMES, several(
            "creepage", creepage, "longitudinal, lateral and spin", (3,)))
        given = cksi, ceta, cphi
    y, value, yaw = numbers(("y", demand.name, "yaw"), (y, demand.value, yaw))
    gap = pair.gap(y)
    motion = given or pair.rolling(gap, pair.gap(-y).radius, yaw)
    of_contact = {name: one for name, one in pair.solving.items() if name not in OF_SOLVE}
    of_solve = {name: one for name, one in pair.solving.items() if name in OF_SOLVE}
    of_solve[demand.of_solver] = demand.at(value, gap.angle)
    with Contact(with_elements=True, **of_contact) as solver:
        solver.set_gap(gap)
        result = solver.solve(creepage=motion, mu=number("mu", mu), contact_angle=gap.angle,
                              rail_y=gap.y_rail, **of_solve)
        strips, elements = solver.strips(), solver.elements()
    forces = map(float, track_forces(result.fy, result.load, gap.angle))
    found: Tuple[Any, ...] = (y, gap.angle, gap.radius, gap.y_rail, gap.y_wheel, *motion, *forces,
                              gap, strips, elements,
                              *(getattr(result, name) for name in FIGURES))
    return ContactResult(*found)
