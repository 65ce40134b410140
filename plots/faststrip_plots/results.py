"""What the program and the reference solver wrote, ready to draw or to compare."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass

import numpy as np

from .looks import looks
from .tables import InputError, Table, read_table

SHIFT_TOLERANCE = 1e-6  # mm; two shifts closer than this are the same case
# status words of rows with a result: all well, or a limitation that has a name
RESULTS = ("ok", "fallback_used", "edge_of_data", "fewer_strips", "overlap_left", "flat_along_x",
           "conformal", "target_missed", "under_resolved", "more_strips",
           "beyond_yield", "no_wave", "not_unique")
LOAD_TOLERANCE = 0.01  # relative; a larger difference means the cases are not the same


@dataclass(frozen=True)
class Quantity:
    """A figure of the sweep, its counterpart in the reference and how both are shown."""

    column: str
    reference: str
    symbol: str
    name: str
    unit: str
    scale: float  # from the unit of the column to the unit shown
    base: str  # what an error is a percentage of: the reference value, mu N or mu N c

    @property
    def title(self) -> str:
        """Its name, and what a force acts on."""
        return self.name.capitalize() + (" on the rail" if self.base.startswith("mu") else "")


QUANTITIES = {
    "penetration": Quantity(
        "penetration_mm", "penetration_mm", r"$\delta$", "approach", "mm", 1.0, "value"
    ),
    "area": Quantity("area_mm2", "area_extrap_mm2", "$A$", "contact area", "mm²", 1.0, "value"),
    "pmax": Quantity(
        "pmax_MPa", "pmax_MPa", r"$p_\mathrm{max}$", "maximum pressure", "MPa", 1.0, "value"
    ),
    "Fx": Quantity("Fx_N", "Fx_extrap_N", "$F_x$", "longitudinal force", "kN", 1e-3, "mu N"),
    "Fy": Quantity("Fy_N", "Fy_extrap_N", "$F_y$", "lateral force", "kN", 1e-3, "mu N"),
    "Mz": Quantity("Mz_Nmm", "Mz_extrap_Nmm", "$M_z$", "spin moment", "N m", 1e-3, "mu N c"),
}
NORMAL_QUANTITIES = ("penetration", "area", "pmax")
TANGENTIAL_QUANTITIES = ("Fx", "Fy", "Mz")

_PATCH_COLUMNS = ("ymin_mm", "ymax_mm", "xmax_mm")
_TIME_COLUMNS = ("normal_us", "tangential_us")
_FIGURES = tuple(q.column for q in QUANTITIES.values()) + _PATCH_COLUMNS


def revision(table: Table) -> str | None:
    """The metadata line that names the program's version and revision, if there is one."""
    for comment in table.comments:
        if comment.startswith("faststrip"):
            return comment
    return None


class MethodSweep:
    """The sweep by one combination of methods, by ascending shift; failed rows hold NaN."""

    def __init__(self, normal, tangential, yw, load, values, failures, limitations):
        self.normal = normal
        self.tangential = tangential
        self.yw = yw
        self.load = load
        self.values = values
        self.failures = failures  # how often each status without a result
        self.limitations = limitations  # how often each named limitation of a result
        self.ok = ~np.isnan(values[_FIGURES[0]])

    @property
    def key(self):
        return self.normal, self.tangential

    def row_at(self, shift: float) -> int | None:
        """Index of the row of a shift, none if it is absent or has failed."""
        found = np.flatnonzero((np.abs(self.yw - shift) < SHIFT_TOLERANCE) & self.ok)
        return int(found[0]) if found.size else None


class Sweep:
    """All rows of a sweep file, one `MethodSweep` per combination of methods."""

    def __init__(self, path, methods, stamp):
        self.path = path
        self.methods = methods
        self.stamp = stamp

    def normals(self) -> list[MethodSweep]:
        """One sweep for each normal method: the tangential method does not touch these figures."""
        found = {}
        for method in self.methods:
            best = found.get(method.normal)
            if best is None or method.ok.sum() > best.ok.sum():
                found[method.normal] = method
        return list(found.values())

    def jumps(self) -> list[float]:
        """Shifts amid which the contact point jumps: both ends of the patch by strips, which are
        told from that point, move as one."""
        for method in self.methods:
            if method.normal == "strip":
                low, high = (method.values[name] for name in ("ymin_mm", "ymax_mm"))
                return [0.5 * (one + other) for one, other, left, right in zip(
                    method.yw, method.yw[1:], looks.jumps(method.yw, low),
                    looks.jumps(method.yw, high))
                    if left and right]
        return []

    @property
    def by_key(self) -> dict:
        """The methods by their combination."""
        return {method.key: method for method in self.methods}

    def find(self, normal: str, shift: float):
        """Sweep and row of a normal method at a shift, none if there is no result."""
        for method in self.methods:
            if method.normal == normal:
                row = method.row_at(shift)
                if row is not None:
                    return method, row
        return None


def read_sweep(path: str) -> Sweep:
    """Read what `faststrip sweep` wrote."""
    table = read_table(
        path, ("yw_mm", "normal", "tangential", "status", "N_N") + _FIGURES + _TIME_COLUMNS
    )
    status = table.words("status")
    yw = table.numbers("yw_mm")
    load = table.numbers("N_N", missing=True)
    columns = {n: table.numbers(n, missing=True) for n in _FIGURES + _TIME_COLUMNS}
    complete = ~np.isnan([load] + [columns[name] for name in _FIGURES]).any(axis=0)
    ok = complete & np.array([word in RESULTS for word in status])
    keys = list(zip(table.words("normal"), table.words("tangential")))
    methods = []
    for key in dict.fromkeys(keys):
        rows = np.array([k for k, other in enumerate(keys) if other == key])
        rows = rows[np.argsort(yw[rows], kind="stable")]
        for first, second in zip(rows, rows[1:]):
            if yw[second] - yw[first] < SHIFT_TOLERANCE:
                raise InputError(
                    f"each shift must be given once for {key[0]} with {key[1]},"
                    f" got {yw[second]:g} twice ({path}:{table.lines[max(first, second)]})"
                )
        failures = Counter(
            "incomplete" if status[k] in RESULTS else status[k] for k in rows if not ok[k]
        )
        limitations = Counter(status[k] for k in rows if ok[k] and status[k] != "ok")
        values = {name: np.where(ok[rows], c[rows], np.nan) for name, c in columns.items()}
        methods.append(
            MethodSweep(key[0], key[1], yw[rows], load[rows], values, failures, limitations)
        )
    return Sweep(path, methods, revision(table))


def read_sweeps(paths) -> Sweep:
    """Several sweep files as one: each method counts from the first file that has it."""
    sweeps = [read_sweep(path) for path in paths]
    found = {}
    for sweep in sweeps:
        for method in sweep.methods:
            found.setdefault(method.key, method)
    stamps = dict.fromkeys(sweep.stamp for sweep in sweeps if sweep.stamp)
    return Sweep(", ".join(paths), list(found.values()), "; ".join(stamps) or None)


class Reference:
    """Full CONTACT's figures, by ascending shift."""

    def __init__(self, path, yw, load, values):
        self.path = path
        self.yw = yw
        self.load = load
        self.values = values
        self.length = np.sqrt(values["area"] / math.pi)  # c = sqrt(a b) of the contact patch

    def rows_for(self, yw: np.ndarray) -> np.ndarray:
        """Row of the reference for each shift, -1 where there is none."""
        distance = np.abs(self.yw[None, :] - np.asarray(yw)[:, None])
        nearest = np.argmin(distance, axis=1)
        return np.where(distance[np.arange(len(nearest)), nearest] < SHIFT_TOLERANCE, nearest, -1)

    def base(self, name: str, mu: float) -> np.ndarray:
        """What an error of a quantity is a fraction of, in the unit of its column."""
        kind = QUANTITIES[name].base
        if kind == "value":
            return self.values[name]
        return mu * self.load * (self.length if kind == "mu N c" else 1.0)


def read_reference(path: str) -> Reference:
    """Read the reference sweep made with full CONTACT."""
    names = tuple(quantity.reference for quantity in QUANTITIES.values())
    table = read_table(path, ("yw_mm", "Fn_N") + names)
    yw = table.numbers("yw_mm")
    order = np.argsort(yw, kind="stable")
    values = {name: (table.positive if name in NORMAL_QUANTITIES else table.numbers)(
        quantity.reference)[order] for name, quantity in QUANTITIES.items()}
    return Reference(path, yw[order], table.positive("Fn_N")[order], values)


@dataclass(frozen=True)
class Comparison:
    """Rows of a method's sweep beside the same shifts of the reference."""

    method: MethodSweep
    rows: np.ndarray  # of the sweep
    reference_rows: np.ndarray


def compare(sweep: Sweep, method: MethodSweep, reference: Reference) -> Comparison:
    """Pair the results of a method with the reference; refuse cases that are not the same."""
    found = reference.rows_for(method.yw)
    rows = np.flatnonzero(method.ok & (found >= 0))
    for row in rows:
        expected = reference.load[found[row]]
        if abs(method.load[row] - expected) > LOAD_TOLERANCE * expected:
            raise InputError(
                f"N_N at shift {method.yw[row]:g} must be the load of the reference, {expected:g},"
                f" got {method.load[row]:g} ({sweep.path}, {reference.path})"
            )
    return Comparison(method, rows, found[rows])


def percent_errors(
    comparison: Comparison, reference: Reference, name: str, mu: float
) -> np.ndarray:
    """Signed errors of a quantity in percent of its base, one per compared row."""
    got = comparison.method.values[QUANTITIES[name].column][comparison.rows]
    expected = reference.values[name][comparison.reference_rows]
    return 100.0 * (got - expected) / reference.base(name, mu)[comparison.reference_rows]


def error_sizes(sweep: Sweep, method: MethodSweep, reference: Reference, name: str,
                mu: float) -> np.ndarray:
    """Sizes of the errors of a method where both have a result, in percent."""
    return np.abs(percent_errors(compare(sweep, method, reference), reference, name, mu))


@dataclass(frozen=True)
class Patch:
    """The strips of one contact patch, by ascending y."""

    y_left: np.ndarray
    y_right: np.ndarray
    y: np.ndarray
    half_length: np.ndarray
    p0: np.ndarray

    def smooth(self, values: np.ndarray, points: int = 241):
        """A fine curve through values of the strips that fall to zero like a root at the ends.

        The squares are joined by cubics; values of an ellipse give the ellipse.
        """
        low, high = self.y_left[0], self.y_right[-1]
        middle, half = 0.5 * (low + high), 0.5 * (high - low)
        y = middle + half * np.sin(np.linspace(-0.5, 0.5, points) * math.pi)
        nodes = np.concatenate([[low], self.y, [high]])
        squares = np.concatenate([[0.0], values**2, [0.0]])
        return y, np.sqrt(np.maximum(0.0, _hermite(nodes, squares, y)))


def _hermite(x, y, at):
    """Piecewise cubic through points y >= 0, slopes by differences, nowhere below zero."""
    width = np.diff(x)
    slope = np.gradient(y, x, edge_order=2)
    slope[:-1] = np.maximum(slope[:-1], -2.0 * y[:-1] / width)
    slope[1:] = np.minimum(slope[1:], 2.0 * y[1:] / width)
    k = np.clip(np.searchsorted(x, at, side="right") - 1, 0, len(x) - 2)
    t = (at - x[k]) / width[k]
    return (
        (1.0 + 2.0 * t) * (1.0 - t) ** 2 * y[k]
        + t**2 * (3.0 - 2.0 * t) * y[k + 1]
        + t * (1.0 - t) * ((1.0 - t) * slope[k] - t * slope[k + 1]) * width[k]
    )


class Strips:
    """A normal solution by strips, patch by patch."""

    def __init__(self, path, patches, stamp):
        self.path = path
        self.patches = patches
        self.stamp = stamp

    def strongest(self):
        """Patch and index of the strip with the maximum pressure."""
        patch = max(self.patches, key=lambda p: p.p0.max())
        return patch, int(np.argmax(patch.p0))


def read_strips(path: str) -> Strips:
    """Read the strips of one contact."""
    names = ("y_left_mm", "y_right_mm", "y_mm", "half_length_mm", "p0_MPa")
    table = read_table(path, names + ("patch",))
    columns = [table.numbers(name) for name in names]
    number = table.numbers("patch")
    for k, line in enumerate(table.lines):
        if not columns[0][k] < columns[2][k] < columns[1][k]:
            raise InputError(
                f"y_mm must be between the edges of its strip, got {columns[2][k]:g}"
                f" ({path}:{line})"
            )
    table.positive("half_length_mm")
    patches = []
    for value in sorted(set(number)):
        rows = np.flatnonzero(number == value)
        rows = rows[np.argsort(columns[0][rows])]
        patches.append(Patch(*(column[rows] for column in columns)))
    return Strips(path, patches, revision(table))


@dataclass(frozen=True)
class Field:
    """Pressures at points of a contact, by rows of equal y, each with ascending x."""

    path: str
    y: np.ndarray
    x: list
    pressure: list
    stamp: str | None

    def nearest_row(self, y: float) -> int:
        return int(np.argmin(np.abs(self.y - y)))


def read_field(path: str) -> Field:
    """Read the pressures of one contact, by the program or by CONTACT; only points in contact."""
    table = read_table(path, ("x_mm", "y_mm", "pn_MPa"))
    x, y, p = (table.numbers(name) for name in ("x_mm", "y_mm", "pn_MPa"))
    inside = p > 0.0
    if not inside.any():
        raise InputError(f"pn_MPa must have a pressure above zero, got none: {path}")
    x, y, p = x[inside], y[inside], p[inside]
    rows_y = np.unique(y)
    rows = [np.flatnonzero(y == value) for value in rows_y]
    rows = [row[np.argsort(x[row])] for row in rows]
    return Field(path, rows_y, [x[r] for r in rows], [p[r] for r in rows], revision(table))


def grid_step(field: Field) -> float:
    """Side of the square elements of a regular grid."""
    steps = np.concatenate([np.diff(np.unique(np.concatenate(field.x))), np.diff(field.y)])
    steps = steps[steps > 1e-9]
    if steps.size == 0:
        raise InputError(f"a grid must have at least 2 points, got 1: {field.path}")
    return float(steps.min())


@dataclass(frozen=True)
class Profiles:
    """Wheel and rail in contact, lateral y and z down, ascending y."""

    wheel: np.ndarray
    rail: np.ndarray
    stamp: str | None


def read_profiles(path: str) -> Profiles:
    """Read the profiles in contact at one shift, in the track frame."""
    table = read_table(path, ("body", "y_mm", "z_mm"))
    points = np.column_stack([table.numbers("y_mm"), table.numbers("z_mm")])
    bodies = table.words("body")
    for body, line in zip(bodies, table.lines):
        if body not in ("wheel", "rail"):
            raise InputError(f"body must be wheel or rail, got {body} ({path}:{line})")
    found = {}
    for body in ("wheel", "rail"):
        rows = points[[k for k, other in enumerate(bodies) if other == body]]
        if len(rows) < 2:
            raise InputError(f"the {body} must have at least 2 points, got {len(rows)}: {path}")
        found[body] = rows
    return Profiles(found["wheel"], found["rail"], revision(table))


@dataclass(frozen=True)
class Gap:
    """The undeformed distance along y in the frame of the contact."""

    y: np.ndarray
    h: np.ndarray
    stamp: str | None


def read_gap(path: str) -> Gap:
    """Read the undeformed gap of a contact."""
    table = read_table(path, ("y_mm", "h_mm"))
    y, h = table.numbers("y_mm"), table.numbers("h_mm")
    for k in range(1, len(table)):
        if y[k] <= y[k - 1]:
            raise InputError(f"y_mm must ascend, got {y[k]:g} after {y[k - 1]:g}"
                             f" ({path}:{table.lines[k]})")
    return Gap(y, h, revision(table))
