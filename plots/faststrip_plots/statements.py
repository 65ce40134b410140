"""The statements of Lack and Gerlici (2014) that figures can test, each with a verdict.

Statements are in our own words, criteria are ours and stated beside each verdict; every figure
comes from a CSV the program or the reference solver wrote.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from . import style
from .curves import RANGE
from .results import QUANTITIES, SHIFT_TOLERANCE, compare, error_sizes, percent_errors
from .tables import Table

HOLDS, LIMITED, FAILS = "holds", "holds with a limit", "does not hold"
UNKNOWN = "not measured"
COLUMNS = ("id", "place", "statement", "subject", "quantity", "value", "unit", "criterion",
           "verdict", "detail", "source")

STRIPS = 15  # strips per patch whose times are quoted
ELEMENTS = 3700  # of Kalker's method, in contact, whose times are quoted: 0.2 mm
TABLE_RANGE = tuple(10.0**L for L in RANGE)  # of b = yd/xd
# The paper's own method as printed and as corrected: what its statements are judged on, asked for
# even where it was not run.
PAPER = (("strip", "faststrip-paper"), ("strip", "faststrip-corrected"))
# FASTSIM on the same strips, by their ellipse, and on the Hertz ellipse, as the paper has it.
RIVALS = (("strip", "fastsim"), ("hertz", "fastsim"))
SAME_FIT = 5e-4  # in E, 0.1 % of the integral: a row nearer to a fit than this came of it
ABSENT = "the sweep does not have this method"
OURS = ("strip", "faststrip")  # this project's: no statement of the paper is judged on it
SYMBOLS = {"Fx": "Tx", "Fy": "Ty", "Mz": "Mz"}


@dataclass(frozen=True)
class Limits:
    """What a figure must reach for `holds` and for `holds with a limit`."""

    holds: float
    limited: float | None = None
    least: bool = False  # it must be at least that, not at most

    def words(self, unit: str) -> str:
        side, unit = "at least" if self.least else "at most", f" {unit}" if unit else ""
        text = f"{side} {self.holds:g}{unit}"
        if self.limited is not None:
            text += f"; with a limit {side} {self.limited:g}{unit}"
        return text

    def verdict(self, value: float) -> str:
        for bound, word in ((self.holds, HOLDS), (self.limited, LIMITED)):
            if bound is not None and (value >= bound if self.least else value <= bound):
                return word
        return FAILS


# of the mean error of a force in % of mu N or mu N c: the same for FASTSTRIP and FASTSIM
SIMILAR = Limits(5.0, 10.0)


@dataclass(frozen=True)
class Statement:
    """One row of the list."""

    id: str
    place: str  # in the paper
    statement: str
    subject: str  # whose figure it is
    quantity: str
    value: float | None
    unit: str
    criterion: str
    verdict: str
    detail: str
    source: str


@dataclass
class Data:
    """All that statements are tested on; what is None or empty was not given."""

    audit: Table
    errata: Table
    table2: Table
    curves: list
    sweeps: dict  # by sign set: sweep, reference
    fine: object
    fine_table: Table
    contact: Table  # CONTACT's own times
    integral: Table  # bench integral
    normal: Table  # bench normal
    reference: Table | None = None  # bench reference
    strips: list = field(default_factory=list)
    mu: float = 0.3


def all_statements(data: Data) -> list[Statement]:
    """Every statement, in the order of the paper."""
    rows = []
    for make in (_integrals, _table1, _tip_formula, _normal, _smoothness, _normal_times, _table2,
                 _closeness, _fastsim, _tangential_times, _equations):
        rows += make(data)
    return rows


def judged(id, place, statement, subject, quantity, value, unit, limits, detail, source):
    """A statement whose verdict is its figure against limits; no figure, no verdict."""
    known = value is not None and math.isfinite(value)
    return Statement(id, place, statement, subject, quantity, float(value) if known else None, unit,
                     limits.words(unit), limits.verdict(value) if known else UNKNOWN, detail,
                     source)


# --------------------------------------------------------------- section 2.1: the integrals


def _integrals(data):
    method, loop = data.integral.words("method"), data.integral.words("loop")
    ns = data.integral.numbers("ns")
    error = np.abs(data.integral.numbers("rel_err"))

    def of(name):
        return np.array([m == name and k == "scalar" for m, k in zip(method, loop)])

    def ratio(above, below):
        if not (of(above).any() and of(below).any()):
            return math.nan
        return float(np.median(ns[of(above)]) / np.median(ns[of(below)]))

    worst = float(error[of("closed")].max()) if of("closed").any() else math.nan
    # a closed evaluation this good refutes the statement
    found = Limits(1e-12)
    verdict = UNKNOWN if math.isnan(worst) else FAILS if found.verdict(worst) == HOLDS else HOLDS
    yield Statement(
        "I1", "2.1, after (9)", "The influence integral has no analytical solution and must be"
        " integrated numerically", "closed evaluation", "largest relative error",
        None if math.isnan(worst) else worst, "",
        "does not hold if a closed evaluation is right within 1e-12", verdict,
        "true of elementary functions only: it is one function of one variable, by series",
        "bench integral",
    )
    yield judged(
        "I2", "2.1, after (9)", "Numerical integration strip by strip takes far longer than the"
        " new procedure", "GSL, 1-D, over published polynomial", "ratio of median times",
        ratio("gsl 1-D", "published"), "times", Limits(10.0, 2.0, least=True),
        f"the closed evaluation takes {_short(ratio('closed', 'published'))} times the polynomial",
        "bench integral",
    )


# ------------------------------------------------------------------ (13)-(15) and Table 1


def _table1(data):
    curves = {curve.n: curve for curve in data.curves}
    literal = [
        float(np.nanmax(np.abs(0.5 * curve.published / curves[2 * n].exact - 1.0)[curve.inside]))
        for n, curve in curves.items()
        if 2 * n in curves and np.array_equal(curves[2 * n].L, curve.L)
    ]
    yield judged(
        "T1", "(12), (15), Table 1", "10^E of column |s-k| is the integral i of a strip |s-k|"
        " strips away", "Table 1 as printed", "largest relative error",
        100.0 * max(literal) if literal else math.nan, "%", Limits(1.0, 5.0),
        f"it is one half of the integral of a strip |s-k|/2 strips away; L from {RANGE[0]:g} to"
        f" {RANGE[1]:g}", "table --curves",
    )
    errors = data.audit.numbers("max_rel_err")
    n = data.audit.numbers("n")
    rms = data.audit.numbers("rms_rel_err")
    worst = int(np.argmax(errors))
    yield judged(
        "T2", "(13)-(15), Table 1", "A polynomial of degree 6 gives the logarithm of the integral"
        " (column 2n, one half of it)", "Table 1, read rightly", "largest relative error",
        100.0 * errors[worst], "%", Limits(1.0, 5.0),
        f"rows {_short(100.0 * errors.min())} to {_short(100.0 * errors.max())} %, rms"
        f" {_short(100.0 * rms.min())} to {_short(100.0 * rms.max())} %; worst"
        f" |s-k| = {2 * n[worst]:g}", "table --audit",
    )
    distance = data.audit.numbers("residual_max")
    near = float(np.mean(distance <= SAME_FIT))
    bad = ", ".join(f"{2 * n[k]:g}" for k in np.flatnonzero(distance > SAME_FIT)) or "none"
    misprints = sum(word == "yes" for word in data.audit.words("misprint"))
    yield judged(
        "T3", "Table 1", "The coefficients are a fit of the integral of the paper",
        f"rows within {SAME_FIT:g} in E of the fit made afresh as the author's", "share of rows",
        100.0 * near, "%", Limits(100.0, 90.0, least=True),
        f"largest difference of E {_short(distance.max())}; rows |s-k| that differ by more: {bad};"
        f" demonstrable misprints: {misprints}", "table --audit",
    )
    outside = np.abs(np.concatenate([data.audit.numbers("rel_err_below"),
                                     data.audit.numbers("rel_err_above")]))
    if data.strips:
        b = np.concatenate([
            0.5 * (patch.y_right - patch.y_left) / patch.half_length
            for strips in data.strips for patch in strips.patches
        ])
        inside = float(np.mean((b >= TABLE_RANGE[0]) & (b <= TABLE_RANGE[1])))
        span, value = f"b from {b.min():.2g} to {b.max():.2g} in {len(b)} strips", 100.0 * inside
    else:
        span, value = "no strips were given", math.nan
    yield judged(
        "T4", "Figs 5-10", "The range drawn, b from 0.01 to 10, is the range that strips need",
        "our strips of the contacts given", "share of strips inside", value, "%",
        Limits(100.0, 95.0, least=True),
        f"{span}; one decade outside Table 1 errs by up to {_short(100.0 * outside.max())} %",
        "contact --strips, table --audit",
    )


def _tip_formula(data):
    rows = _errata(data, "(22)-(24)")
    yield judged(
        "I3", "(21)-(24)", "Off the centre line the integral follows from that at the centre by a"
        " quotient of elementary integrals", "(22)-(24), decoded", "largest relative error",
        100.0 * max(rows, default=math.nan), "%", Limits(5.0, 15.0),
        f"of {len(rows)} points near the ends of strips, where it is worst", "errata",
    )


# ------------------------------------------------------------ section 2.2, Figs 11 to 20


def _normal(data):
    sweep, reference = data.sweeps["A"]
    methods = {method.normal: method for method in sweep.normals()}
    names = ("penetration", "area", "pmax")
    errors = {(key, name): error_sizes(sweep, method, reference, name, data.mu)
              for key, method in methods.items() for name in names}
    strip = methods.get("strip")
    shape = np.array([math.nan]) if strip is None else (
        (strip.values["ymax_mm"] - strip.values["ymin_mm"]) / (2.0 * strip.values["xmax_mm"]))
    shape = shape[np.isfinite(shape)]
    yield judged(
        "N0", "1", "Contact areas are slim across the rolling direction", "our strips, Table 2",
        "median of width over length", np.median(shape) if shape.size else math.nan, "",
        Limits(0.5, 1.0),
        f"from {_short(shape.min())} to {_short(shape.max())}" if shape.size else "", "sweep A",
    )
    for number, name, words in zip((1, 2, 3), names, ("shift (approach)", "area", "largest"
                                                      " pressure")):
        own = errors.get(("strip", name), np.array([]))
        yield judged(
            f"N{number}", "2.2, 5.1 and 5, Figs 11-14, 17-19", f"The strip method's {words} is very"
            " close to Kalker's", "our strips",
            "largest error over the contacts of Table 2", own.max() if own.size else math.nan, "%",
            Limits(2.0, 5.0),
            f"mean {_short(own.mean())} %; the algorithm is ours, the paper gives none"
            if own.size else "",
            "sweep A, CONTACT set A",
        )
    if "strip" in methods and "hertz" in methods:
        nearer, count = 0, 0
        strip = compare(sweep, methods["strip"], reference)
        hertz = compare(sweep, methods["hertz"], reference)
        both = np.intersect1d(strip.reference_rows, hertz.reference_rows)
        for name in names:
            own = errors["strip", name][np.isin(strip.reference_rows, both)]
            other = errors["hertz", name][np.isin(hertz.reference_rows, both)]
            nearer, count = nearer + int((own <= other).sum()), count + own.size
        share = 100.0 * nearer / count if count else math.nan
        detail = "mean errors of Hertz: " + ", ".join(
            f"{_short(errors['hertz', name].mean())} % ({name})" for name in names
            if errors["hertz", name].size)
    else:
        share, detail = math.nan, ""
    yield judged(
        "N4", "Figs 17-20", "Strips are nearer to Kalker's method than Hertz is",
        "shift, area and maximum pressure of each contact", "share in which strips are nearer",
        share, "%", Limits(100.0, 75.0, least=True), detail, "sweep A, CONTACT set A",
    )


def roughness(values):
    """Relative distance of each value from the cubic through its four neighbours, NaN at ends."""
    rough = np.full(values.shape, np.nan)
    if values.size >= 5:
        cubic = (4.0 * (values[1:-3] + values[3:-1]) - values[:-4] - values[4:]) / 6.0
        rough[2:-2] = np.abs(values[2:-2] - cubic) / np.abs(values[2:-2])
    return rough


def _smoothness(data):
    for number, name, words in ((5, "area", "area"), (6, "pmax", "maximum pressure")):
        for method in data.fine.normals():
            if method.normal != "strip":
                continue
            rough = roughness(method.values[QUANTITIES[name].column])
            known = rough[np.isfinite(rough)]
            usual = 100.0 * float(np.quantile(known, 0.95)) if known.size else math.nan
            step = float(np.median(np.diff(method.yw))) if method.yw.size > 1 else math.nan
            worst = "" if not known.size else (
                f"median {_short(100.0 * np.median(known))} %, largest"
                f" {_short(100.0 * known.max())} % at {method.yw[np.nanargmax(rough)]:g} mm")
            yield judged(
                f"N{number}", "Figs 11-14",
                f"The {words} is a smooth curve over the shift (drawn, not said)",
                "our strips",
                f"95 % of points within, of the cubic through four neighbours, steps"
                f" {_short(step)} mm", usual, "%", Limits(0.1, 1.0), worst, "sweep, fine steps",
            )


def _normal_times(data):
    start = np.array(data.normal.words("start"))
    use = (start == "cold") & (data.normal.numbers("strips") == STRIPS)
    cold = float(np.median(data.normal.numbers("us")[use])) if use.any() else math.nan
    contact = 1e6 * float(np.median(data.contact.numbers("cpu_norm_s")))
    place = "2.2, list of times"
    yield judged(
        "N7", place, "The strip method takes tenths of a second a contact (3 GHz, 2013)",
        f"{STRIPS} strips, cold", "median time", 1e-3 * cold, "ms", Limits(300.0),
        "on the machine of the bench", "bench normal",
    )
    claim = "Kalker's variational method takes a hundred times as long as strips (over 10 s to" \
            " tenths of a second)"
    many = Limits(100.0, 10.0, least=True)
    yield judged(
        "N8", place, claim, "CONTACT's NORM, 0.1 mm grid, over strips", "ratio of times",
        contact / cold, "times", many,
        f"CONTACT {_short(1e-3 * contact)} ms, on another run of the machine; the ratio goes with"
        " the grid", "CONTACT set A, bench normal",
    )
    own = {name: math.nan for name in ("cold", "strips")}
    words = _milliseconds(math.nan)
    if data.reference is not None:
        own = {name: _time_of_kalker(data.reference, "norm", name) for name in own}
        words = _milliseconds(own["cold"])
        rolling = _time_of_kalker(data.reference, "tang", "cold")
        if math.isfinite(rolling):
            words += f"; TANG {_milliseconds(rolling)}"
    yield judged(
        "N9", place, claim, "our NORM cold, over strips", "ratio of times",
        own["cold"] / cold, "times", many, words, "bench reference, bench normal",
    )
    yield judged(
        "N10", place, "Started from the strips, Kalker's method takes ten times as long as strips",
        "our NORM from strips over strips", "ratio of times", own["strips"] / cold, "times",
        Limits(30.0, 100.0), _milliseconds(own["strips"]), "bench reference, bench normal",
    )
    yield judged(
        "N11", place, "Strips as a start make Kalker's method several times as fast",
        "our NORM, cold over from strips", "ratio of times", own["cold"] / own["strips"],
        "times", Limits(5.0, 1.2, least=True), "", "bench reference",
    )


def _time_of_kalker(table, method, start):
    """Median us with about `ELEMENTS` elements in contact, to the smallest tolerance there is."""
    tolerance = table.numbers("tolerance")
    use = (np.array(table.words("method")) == method) & (np.array(table.words("start")) == start)
    use &= np.abs(np.log(table.numbers("elements") / ELEMENTS)) < 0.5 * math.log(2.0)
    if not use.any():
        return math.nan
    use &= tolerance == tolerance[use].min()
    return float(np.median(table.numbers("us")[use]))


# ---------------------------------------------------------------- section 5.1: Table 2


def _table2(data):
    column = data.table2.numbers
    yw, load, gamma = column("yw_mm"), column("Fn_N"), column("gamma_rad")
    worst = np.abs(load * np.cos(gamma) / 1e5 - 1.0).max()
    yield judged(
        "F1", "5.1, Table 2", "The normal force is Q = 100 kN over the cosine of the contact angle",
        "Table 2", "largest relative deviation", 100.0 * worst, "%", Limits(0.01, 0.1), "",
        "table2.csv",
    )
    worst = np.abs(np.arctan(column("tan_gamma")) - gamma).max()
    yield judged(
        "F2", "5.1, Table 2", "The two columns of the contact angle agree", "Table 2",
        "largest deviation", worst, "rad", Limits(1e-6, 1e-5), "", "table2.csv",
    )
    radius = np.interp(yw, *_sorted(data.contact, "yw_mm", "r_wheel_mm"))
    worst = np.abs(np.abs(np.sin(gamma)) / radius - column("Phi_rad_per_mm")).max()
    yield judged(
        "F3", "5.1, Table 2", "The spin is the sine of the contact angle over the rolling radius",
        "Table 2", "largest deviation", worst, "rad/mm", Limits(1e-6, 5e-6),
        "Table 2 has six decimals", "table2.csv, CONTACT set A",
    )
    here, there = _same_shifts(yw, data.fine_table.numbers("yw_mm"))
    ours = {name: data.fine_table.numbers(name)[there]
            for name in ("gamma_rad", "cksi", "cphi_rad_per_mm")}
    count = f"{here.size} shifts"
    some = here.size > 0
    rms = math.sqrt(np.mean((ours["gamma_rad"] - gamma[here]) ** 2)) if some else math.nan
    yield judged(
        "F4", "5.1, Table 2", "The contact angles are those of S1002 on UIC60 inclined 1:40",
        "ours, of the profiles, less Table 2's", "rms difference", 1e3 * rms, "mrad",
        Limits(1.0, 5.0), count, "sweep, fine steps",
    )
    creep, spin = column("Sx")[here], column("Phi_rad_per_mm")[here]
    size = np.abs(np.abs(creep) - np.abs(ours["cksi"])).max(initial=0.0)
    size = size / np.abs(ours["cksi"]).max() if some else math.nan
    yield judged(
        "F5", "5.1, Table 2", "The longitudinal creepages are those of the rolling radii, in size",
        "ours, of the profiles", "largest difference of size, of the largest creepage",
        100.0 * size, "%", Limits(1.0, 5.0), count, "sweep, fine steps",
    )
    theirs, own = creep * spin, ours["cksi"] * ours["cphi_rad_per_mm"]
    rolling = theirs * own != 0.0
    share = 100.0 * float(np.mean((theirs * own)[rolling] > 0.0)) if rolling.any() else math.nan
    yield judged(
        "F6", "5.1, Table 2", "The longitudinal creepage goes with the spin as on a wheelset that"
        " rolls freely", "ours, of the profiles",
        "share of contacts where Sx times Phi has the same sign", share, "%",
        Limits(100.0, 90.0, least=True),
        "the product is the same seen from wheel or rail; it turns with the axis of the spin, which"
        " the paper does not give. Set A: signs as printed; set B: those of the motion",
        "sweep, fine steps",
    )


def _same_shifts(yw, others):
    """Indices of the shifts that both lists have, in the first and in the second."""
    pairs = [(k, near[0]) for k, value in enumerate(yw)
             if (near := np.flatnonzero(np.abs(others - value) < SHIFT_TOLERANCE)).size]
    return tuple(np.array(pairs, dtype=int).reshape(-1, 2).T)


# ------------------------------------------------------- section 5.2: tangential forces


def _closeness(data):
    for signs, (sweep, reference) in sorted(data.sweeps.items()):
        methods = sweep.by_key
        source = f"sweep {signs}, CONTACT set {signs}"
        for key in PAPER:
            subject = style.method_look(*key).label
            for rival in RIVALS:
                for name in SYMBOLS:
                    yield _nearer(
                        f"C.{signs}.{key[1]}.{rival[0]}.{SYMBOLS[name]}", name,
                        f"{subject} over {style.method_look(*rival).label}, set {signs}",
                        _errors_of_pair(data, sweep, reference, name, methods.get(key),
                                        methods.get(rival)),
                        _own_words(data, sweep, reference, name, methods.get(OURS)), source)
            means = _means(data, sweep, reference, methods.get(key))
            known = np.isfinite(means).all()
            yield judged(
                f"C.{signs}.{key[1]}", "3.1", "FASTSTRIP's results are similar to Kalker's",
                f"{subject}, set {signs}", "largest of the mean errors of Tx, Ty, Mz", means.max(),
                "% of mu N (c)", SIMILAR,
                "means " + ", ".join(_short(value) for value in means) if known else ABSENT,
                source,
            )


def _errors_of_pair(data, sweep, reference, name, method, rival):
    """Sizes of the errors of two methods at the shifts where both have a result."""
    if method is None or rival is None:
        return np.array([]), np.array([])
    mine, theirs = compare(sweep, method, reference), compare(sweep, rival, reference)
    both = np.intersect1d(mine.reference_rows, theirs.reference_rows)
    return tuple(
        np.abs(percent_errors(pairs, reference, name, data.mu))[np.isin(pairs.reference_rows, both)]
        for pairs in (mine, theirs)
    )


def _own_words(data, sweep, reference, name, method):
    """What this project's FASTSTRIP does there, which no statement of the paper is judged on."""
    if method is None:
        return ""
    error = error_sizes(sweep, method, reference, name, data.mu)
    if error.size == 0:
        return ""
    return (f"; not judged: this project's FASTSTRIP, {_short(error.mean())} and"
            f" {_short(error.max())}, its constants chosen on these and on Hertz"
            f" contacts")


def _nearer(id, name, subject, errors, own_words, source):
    unit = {"mu N": "% of mu N", "mu N c": "% of mu N c"}[QUANTITIES[name].base]
    value, verdict, detail, quantity = None, UNKNOWN, ABSENT, "mean error over FASTSIM's"
    own, other = errors
    if own.size:
        value = float(own.mean() / other.mean()) if other.mean() > 0.0 else math.inf
        verdict = FAILS if value >= 1.0 else HOLDS if own.max() < other.max() else LIMITED
        quantity += f", {_short(own.mean())} over {_short(other.mean())} {unit}"
        detail = (f"mean and largest: {_short(own.mean())} and {_short(own.max())}, FASTSIM"
                  f" {_short(other.mean())} and {_short(other.max())} {unit}; {own.size} contacts"
                  + own_words)
    return Statement(
        id, "3.1, 5.2, Figs 21-26",
        f"FASTSTRIP's {SYMBOLS[name]} is nearer to Kalker's than FASTSIM's", subject, quantity,
        value, "times",
        "mean and largest error below FASTSIM's; with a limit: only the mean", verdict, detail,
        source,
    )


def _means(data, sweep, reference, method):
    """Mean errors of Tx, Ty and Mz; NaN where the method has no result."""
    errors = [] if method is None else [
        error_sizes(sweep, method, reference, name, data.mu) for name in SYMBOLS]
    return np.array([error.mean() for error in errors if error.size] or [math.nan] * 3)


def _fastsim(data):
    sweep, reference = data.sweeps["A"]
    methods = sweep.by_key
    hertz, strip = (_means(data, sweep, reference, methods.get((normal, "fastsim")))
                    for normal in ("hertz", "strip"))
    yield judged(
        "S1", "3.1", "FASTSIM on the Hertz ellipse differs from the variational method, but"
        " acceptably", "Hertz + FASTSIM, set A", "largest of the mean errors of Tx, Ty, Mz",
        hertz.max(), "% of mu N (c)", SIMILAR,
        "means of Tx, Ty, Mz: " + ", ".join(_short(v) for v in hertz), "sweep A, CONTACT set A",
    )
    gone = 100.0 * (1.0 - strip.sum() / hertz.sum())
    yield judged(
        "S2", "3.1", "What makes FASTSIM differ most is shape and size of its contact ellipse",
        "strips + FASTSIM (same area, same load), set A",
        "share of the mean errors that goes with the patch of the strips", gone, "%",
        Limits(50.0, 25.0, least=True), "", "sweep A, CONTACT set A",
    )


def _tangential_times(data):
    sweep, _ = data.sweeps["A"]
    for letter, source, words, where in (
        ("usual", sweep, "each at its usual resolution", "sweep A"),
        ("equal", data.fine, "FASTSIM on 15 by 15 elements", "sweep, fine steps"),
    ):
        methods = source.by_key
        for key in PAPER:
            ratio, times = _times(methods.get(key), methods.get(("hertz", "fastsim")))
            yield judged(
                f"S3.{letter}.{key[1]}", "3.1, 5", "FASTSTRIP computes about as fast as FASTSIM",
                f"{style.method_look(*key).label}, {words}", "median of wall times over FASTSIM's",
                ratio, "times", Limits(2.0, 10.0), times, where,
            )
    start = np.array(data.normal.words("start"))
    use = (start == "warm_shift") & (data.normal.numbers("strips") == STRIPS)
    warm = float(np.median(data.normal.numbers("us")[use])) if use.any() else math.nan
    contact = 1e6 * float(np.median(data.contact.numbers("cpu_total_s")))
    methods = data.fine.by_key
    for key in PAPER:
        whole = warm + _median_time(methods[key]) if key in methods else math.nan
        known = math.isfinite(whole)
        yield judged(
            f"S4.{key[1]}", "5, conclusions", "It is fast enough to be put into vehicle dynamics,"
            " where the variational method is not",
            f"{style.method_look(*key).label}, {STRIPS} of our strips from the step before",
            "times faster than full CONTACT, 0.1 mm grid", contact / whole, "times",
            Limits(100.0, 10.0, least=True),
            f"{_short(1e-3 * whole)} ms a contact, CONTACT {_short(1e-3 * contact)} ms"
            if known else ABSENT,
            "bench normal, sweep, CONTACT set A",
        )


def _times(method, fastsim):
    """Median of the ratios of two methods' tangential times at the same shifts, and words."""
    if method is None or fastsim is None:
        return math.nan, ABSENT
    here, there = _same_shifts(method.yw, fastsim.yw)
    own = method.values["tangential_us"][here]
    other = fastsim.values["tangential_us"][there]
    known = (own > 0.0) & (other > 0.0)
    if not known.any():
        return math.nan, "no times in the sweep"
    return float(np.median(own[known] / other[known])), (
        f"medians {_short(np.median(own[known]))} and {_short(np.median(other[known]))} us")


def _median_time(method):
    """Median of the tangential times in microseconds, NaN where none is known."""
    known = method.values["tangential_us"]
    known = known[known > 0.0]
    return float(np.median(known)) if known.size else math.nan


# ------------------------------------------------------------- the equations as printed

DEVIATION = "largest deviation from the right reading"
# equation, place, statement, subject, quantity, words in the demonstrations used
EQUATIONS = (
    ("(6) (9) (17)-(20)", "2.1", "The matrix of (6), (9) gives the pressures that carry the load",
     "as printed", "largest error of the load", "load"),
    ("(12)", "2.1", "The integral in reduced coordinates is (12)", "as printed", DEVIATION, ""),
    ("(30) (42) (46)", "5, conclusions", "FASTSIM's theory is the engine of FASTSTRIP",
     "(25)-(48) with the errata mended, on an ellipse", "largest difference of force and moment"
     " from FASTSIM", ""),
    ("(31)", "3.2", "Int(8a) points along a strip are enough", "a in mm, of a contact of the paper",
     "error of the force", "55 points"),
    ("(34)", "4.1", "The bound of each strip's own pressure gives Kalker's stiffness", "as printed",
     DEVIATION, ""),
    ("(41)", "4.2", "Adding slip times the distance from the edge gives Kalker's stiffness",
     "as printed", DEVIATION, ""),
    ("(44)", "4.2", "The spin moment is (44)", "as printed", DEVIATION, ""),
    ("(46)-(48)", "4.2", "Scaled by pi/2, sliding gives mu N", "as printed",
     "largest error of the force", ""),
)


def _equations(data):
    for number, (equation, place, words, subject, quantity, part) in enumerate(EQUATIONS, 1):
        rows = _errata(data, equation, part)
        yield judged(
            f"E{number}", f"{place}, {equation}", words, subject, quantity,
            100.0 * max(rows, default=math.nan), "%", Limits(1.0, 10.0),
            f"demonstrations: {len(rows)}", "errata",
        )


def _errata(data, equation, part=""):
    """Sizes of the deviations that the errata list has for an equation."""
    deviation = data.errata.numbers("deviation", missing=True)
    return [
        abs(float(value))
        for name, what, value in zip(data.errata.words("equation"), data.errata.words("what"),
                                     deviation)
        if name == equation and part in what and math.isfinite(value)
    ]


def _sorted(table, x, y):
    order = np.argsort(table.numbers(x))
    return table.numbers(x)[order], table.numbers(y)[order]


def _short(value):
    return f"{value:.3g}"


def _milliseconds(us):
    return "" if math.isnan(us) else f"{_short(1e-3 * us)} ms"
