#!/usr/bin/env python3
"""Write src/faststrip/tangential/kalker_table.f90 from reference/kalker_table.csv.

For every coefficient and each nu of the table: ln C at the nodes of ln(a/b), and the slopes of
the twice continuously differentiable cubic spline through them. Its end slopes are those of the
asymptotes that continue it outside the table (the same expressions as in kalker.f90), so that
the coefficients are smooth across the ends of the table too.

    tools/generate/kalker_table.py            write the module
    tools/generate/kalker_table.py --check    exit 1 if the module is not what would be written

Decimal arithmetic, so that every machine writes the same digits.
"""
import csv
import sys
from decimal import Decimal, getcontext
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TABLE = ROOT / "reference" / "kalker_table.csv"
MODULE = ROOT / "src" / "faststrip" / "tangential" / "kalker_table.f90"

COEFFICIENTS = ("C11", "C22", "C23", "C33")
POISSON = ("0", "0.25", "0.5")
PI = Decimal("3.141592653589793238462643383279502884197169399375105820974944592307816406286")

getcontext().prec = 60


def asymptote(coefficient, nu, log_ratio):
    """Kalker's expression for a/b -> 0 (log_ratio < 0) or a/b -> infinity."""
    g = (-abs(log_ratio)).exp()
    lam = Decimal(16).ln() + 2 * abs(log_ratio)
    ln4 = Decimal(4).ln()
    if log_ratio < 0:
        if coefficient == "C11":
            return PI**2 / (4 * (1 - nu))
        if coefficient == "C22":
            return PI**2 / 4
        if coefficient == "C23":
            return PI * g.sqrt() / (3 * (1 - nu)) * (1 + nu * (lam / 2 + ln4 - 5))
        return PI**2 / (16 * (1 - nu) * g)
    if coefficient == "C11":
        q = lam - 2 * nu
        return 2 * PI / (g * q) * (1 + (3 - ln4) / q)
    if coefficient == "C22":
        q = (1 - nu) * lam + 2 * nu
        return 2 * PI / (g * q) * (1 + (1 - nu) * (3 - ln4) / q)
    q = (1 - nu) * lam - 2 + 4 * nu
    if coefficient == "C23":
        return 2 * PI / (3 * g * g.sqrt() * q)
    return PI / 4 * (1 - nu * (lam - 2) / q)


def fading(coefficient, log_ratio, log_end):
    """How the misfit of the asymptote at the end of the table fades outside: 1 at the end."""
    if log_ratio > 0 and coefficient in ("C11", "C22"):
        ln16 = Decimal(16).ln()
        return ((ln16 + 2 * log_end) / (ln16 + 2 * log_ratio)) ** 2
    return (-abs(log_ratio - log_end)).exp()


def outer_slope(coefficient, nu, log_end, log_value):
    """d ln C/d ln(a/b) of the continuation at the end of the table."""
    misfit = log_value - asymptote(coefficient, nu, log_end).ln()
    h = Decimal(10) ** -20

    def log_outer(log_ratio):
        return (asymptote(coefficient, nu, log_ratio).ln()
                + misfit * fading(coefficient, log_ratio, log_end))

    # One-sided and of second order (the fading has a corner at the end of the table); with
    # this h the error is far below the digits kept.
    s = h if log_end > 0 else -h
    return (4 * log_outer(log_end + s) - log_outer(log_end + 2 * s)
            - 3 * log_outer(log_end)) / (2 * s)


def spline_slopes(x, y, first, last):
    """Slopes at the nodes of the cubic spline with given end slopes."""
    n = len(x)
    slopes = [first] + [Decimal(0)] * (n - 2) + [last]
    upper = [Decimal(0)] * n
    right = list(slopes)
    for i in range(1, n - 1):
        hl, hr = x[i] - x[i - 1], x[i + 1] - x[i]
        rhs = 3 * ((y[i] - y[i - 1]) / hl**2 + (y[i + 1] - y[i]) / hr**2)
        pivot = 2 / hl + 2 / hr - upper[i - 1] / hl
        upper[i] = 1 / hr / pivot
        right[i] = (rhs - right[i - 1] / hl) / pivot
    for i in range(n - 2, 0, -1):
        slopes[i] = right[i] - upper[i] * slopes[i + 1]
    return slopes


def read_table():
    """{(coefficient, nu): {ratio: value}} with the ratio a/b exact (n/10 or 10/n)."""
    values = {}
    with open(TABLE, newline="", encoding="utf-8") as stream:
        rows = csv.DictReader(line for line in stream if not line.startswith("#"))
        for row in rows:
            ratio = Decimal(row["ratio"])
            if row["ratio_type"] == "b/a":
                ratio = 1 / ratio
            column = values.setdefault((row["coef"], row["nu"]), {})
            value = Decimal(row["value"])
            if column.setdefault(ratio, value) != value:
                sys.exit(f"kalker_table.py: two values for {row['coef']} at a/b = {ratio}")
    return values


def rows_of(numbers):
    """Fortran literals, three a line, continued."""
    words = [f"{number:.17e}_wp" if number else "0.0_wp" for number in numbers]
    lines = [", ".join(words[i:i + 3]) for i in range(0, len(words), 3)]
    return ", &\n        ".join(lines)


def module_text():
    values = read_table()
    ratios = sorted(values[COEFFICIENTS[0], POISSON[0]])
    x = [ratio.ln() for ratio in ratios]
    logs, slopes = [], []
    for coefficient in COEFFICIENTS:
        for nu in POISSON:
            column = values[coefficient, nu]
            if sorted(column) != ratios:
                sys.exit(f"kalker_table.py: {coefficient}, nu = {nu}: other a/b than the first")
            y = [column[ratio].ln() for ratio in ratios]
            logs += y
            slopes += spline_slopes(x, y, outer_slope(coefficient, Decimal(nu), x[0], y[0]),
                                    outer_slope(coefficient, Decimal(nu), x[-1], y[-1]))
    n, m, k = len(x), len(POISSON), len(COEFFICIENTS)
    poisson = ", ".join(nu + "_wp" if "." in nu else nu + ".0_wp" for nu in POISSON)
    return f"""\
!> Kalker's creepage coefficients: the table. Written by tools/generate/kalker_table.py from
!> reference/kalker_table.csv; change those, not this.
module faststrip_tangential_kalker_table
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: n_ratios, n_poisson, table_poisson, table_log_ratio, table_log_value, table_slope

    !> Number of aspect ratios of the table.
    integer, parameter :: n_ratios = {n}

    !> Number of Poisson's ratios of the table.
    integer, parameter :: n_poisson = {m}

    !> Poisson's ratios of the table.
    real(wp), parameter :: table_poisson(n_poisson) = [{poisson}]

    !> ln(a/b) of the nodes, increasing.
    real(wp), parameter :: table_log_ratio(n_ratios) = [ &
        {rows_of(x)}]

    !> ln C at the nodes; the last index counts C11, C22, C23, C33.
    real(wp), parameter :: table_log_value(n_ratios, n_poisson, {k}) = reshape([ &
        {rows_of(logs)}], &
        [n_ratios, n_poisson, {k}])

    !> d ln C/d ln(a/b) at the nodes.
    real(wp), parameter :: table_slope(n_ratios, n_poisson, {k}) = reshape([ &
        {rows_of(slopes)}], &
        [n_ratios, n_poisson, {k}])
end module faststrip_tangential_kalker_table
"""


def main(arguments):
    if arguments not in ([], ["--check"]):
        print(__doc__, file=sys.stderr)
        return 2
    text = module_text()
    if arguments:
        if MODULE.exists() and MODULE.read_text(encoding="utf-8") == text:
            return 0
        print(f"kalker_table.py: {MODULE.relative_to(ROOT)} is not what the table gives",
              file=sys.stderr)
        return 1
    MODULE.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
