#!/usr/bin/env python3
"""Make the coefficient tables of the closed influence primitive, and check them.

    G(c) = int_{-1}^{1} sqrt(1 - u^2) asinh(c/|u|) du
         = c [A(x) - B(x) ln c],                x = c^2,    0 <= c <= 1
         = (pi/2) (ln 4c + 1/2) + w R(w),       w = 1/c^2,  c >= 0.7

(A, B and R once more, with fewer terms, for c <= 0.6 and c >= 5/3), and of the kernel off the
centre line, asinh(cr/d) - asinh(cl/d) = 2 atanh((cr - cl)/(s_r + s_l)):

    atanh(z) = z S(z^2),                            0 <= z <= 0.6

(and up to 0.775 for columns, to 1e-11)

A, B, R and S are analytic beyond their intervals, so interpolation at Chebyshev nodes is within a
small factor of the best polynomial. It is done in 60-digit arithmetic and turned into powers of x
(A, B), of z^2 (S) and of w - 1.025 (R; powers of w itself would lose a factor 30 of accuracy,
though not on the short interval).

    influence_coefficients.py           write the Fortran module
    influence_coefficients.py --check   compare it with the committed one, byte for
                                        byte; exit 1 if it differs

Both ways the coefficients, rounded to doubles as the compiler will round them, are compared at
points off the nodes with G by 60-digit quadrature (a formula the fit of A and B does not use) and
with the hypergeometric series; exit 1 if a relative difference exceeds 1e-16.
"""
import argparse
import pathlib
import sys

import mpmath as mp

MODULE = (pathlib.Path(__file__).resolve().parents[2]
          / 'src/faststrip/influence/closed_coefficients.f90')
DIGITS = 60
DEGREE_A, DEGREE_B, DEGREE_R, DEGREE_S = 19, 20, 26, 15
C_SMALL = '1'     # the small-c form holds up to here
C_LARGE = '0.7'   # the large-c form holds from here on
W_TOP = '2.05'    # R is fitted on [0, W_TOP], a little beyond 1/0.7^2
Z_TOP = '0.6'     # S is fitted on [0, Z_TOP^2]
COLUMN = '0.775'  # and for columns on [0, COLUMN^2]
SHORT = '0.36'    # short forms: A and B on c^2 in [0, SHORT], R on w in the same
DEGREE_SHORT = 11
ALLOWED = 1e-16
ALLOWED_COLUMN = 1e-11


def primitive(c):
    """G(c) by quadrature, u = sin t."""
    return 2 * mp.quad(lambda t: mp.cos(t)**2 * mp.asinh(c / mp.sin(t)),
                       [0, mp.mpf(1) / 64, mp.mpf(1) / 4, mp.pi / 2])


def b_factor(x):
    """B(x), the factor of -c ln c, exactly."""
    return 2 * mp.hyp3f2(mp.mpf(1) / 2, -mp.mpf(1) / 2, mp.mpf(1) / 2, 1, mp.mpf(3) / 2, -x)


def a_factor(x):
    """A(x) from its series, terms accelerated near x = 1; x = 0 is its first term."""
    half = mp.mpf(1) / 2

    def term(k):
        k = int(k)
        h = mp.gamma(half + k) / (2 * mp.factorial(k)**2 * mp.gamma(1 + half - k))
        s = 2 * mp.psi(0, k + 1) - mp.psi(0, half + k) - mp.psi(0, 1 + half - k)
        return h * x**k / (2 * k + 1) * (s + mp.mpf(2) / (2 * k + 1))

    if x < mp.mpf(1) / 2:
        return mp.nsum(term, [0, mp.inf], method='d')
    return mp.nsum(term, [0, mp.inf], method='a')


def r_factor(w):
    """R(w) of the large-c form."""
    one_half = mp.mpf(3) / 2
    return mp.pi / 32 * mp.hyper([1, 1, one_half, one_half], [2, 2, 3], -w)


def s_factor(y):
    """atanh(z)/z, y = z^2."""
    return mp.atanh(mp.sqrt(y)) / mp.sqrt(y)


def chebyshev_to_powers(f, left, right, degree, centre):
    """Interpolate f at the Chebyshev nodes of [left, right]; powers of (x - centre)."""
    n = degree + 1
    mid, half = (left + right) / 2, (right - left) / 2
    theta = [mp.pi * (j + mp.mpf(1) / 2) / n for j in range(n)]
    values = [f(mid + half * mp.cos(t)) for t in theta]
    series = [2 * mp.fsum(v * mp.cos(k * t) for v, t in zip(values, theta)) / n
              for k in range(n)]
    series[0] /= 2
    # T_k of s = ((x - centre) + shift)/half, as coefficients of powers of x - centre
    slope, offset = 1 / half, (centre - mid) / half
    previous, current = [mp.mpf(1)], [offset, slope]
    total = [mp.mpf(0)] * n
    total[0] += series[0]
    for k in range(1, n):
        for i, value in enumerate(current):
            total[i] += series[k] * value
        following = [mp.mpf(0)] * (len(current) + 1)
        for i, value in enumerate(current):
            following[i] += 2 * offset * value
            following[i + 1] += 2 * slope * value
        for i, value in enumerate(previous):
            following[i] -= value
        previous, current = current, following
    return total


def as_double(value):
    """The double the compiler makes of the printed number."""
    return float(printed(value))


def printed(value):
    return mp.nstr(value, 20, min_fixed=1, max_fixed=0, strip_zeros=False, show_zero_exponent=True)


def horner(coefficients, x):
    total = mp.mpf(0)
    for a in reversed(coefficients):
        total = total * x + mp.mpf(as_double(a))
    return total


def check(a, b, r, s, short, column):
    """Largest relative difference of the rounded tables from G at points off the nodes."""
    worst_small = worst_large = mp.mpf(0)
    for j in range(1, 40):
        c = mp.sqrt(mp.mpf(SHORT)) * j / 39
        exact = primitive(c)
        value = c * (horner(short[0], c**2) - horner(short[1], c**2) * mp.log(c))
        worst_small = max(worst_small, abs(value / exact - 1))
        c = 1 / c
        exact = mp.pi / 2 * (mp.log(4 * c) + mp.mpf(1) / 2)
        value = exact + horner(short[2], c**-2) / c**2
        exact += r_factor(c**-2) / c**2
        worst_large = max(worst_large, abs(value / exact - 1))
    for j in range(1, 60):
        c = mp.mpf(j) / 59
        exact = primitive(c)
        value = c * (horner(a, c**2) - horner(b, c**2) * mp.log(c))
        worst_small = max(worst_small, abs(value / exact - 1))
    for c in [mp.mpf(10)**-8, mp.mpf(10)**-4, mp.mpf(10)**-2]:
        value = c * (horner(a, c**2) - horner(b, c**2) * mp.log(c))
        series = c * (a_factor(c**2) - b_factor(c**2) * mp.log(c))
        worst_small = max(worst_small, abs(value / series - 1))
    for j in range(60):
        c = mp.mpf(C_LARGE) + mp.mpf(j)**2 / 100
        exact = primitive(c) if j % 3 == 0 else (
            mp.pi / 2 * (mp.log(4 * c) + mp.mpf(1) / 2) + r_factor(c**-2) / c**2)
        w = c**-2
        value = mp.pi / 2 * (mp.log(4 * c) + mp.mpf(1) / 2) + w * horner(r, w - centre_of_r())
        worst_large = max(worst_large, abs(value / exact - 1))
    return (float(worst_small), float(worst_large), atanh_error(s, Z_TOP),
            atanh_error(column, COLUMN))


def atanh_error(s, top):
    return float(max(abs(horner(s, z**2) * z / mp.atanh(z) - 1)
                     for z in (mp.mpf(top) * j / 97 for j in range(1, 98))))


def centre_of_r():
    return mp.mpf(W_TOP) / 2


def fortran_array(name, comment, coefficients):
    lines = [f'    !> {comment}',
             f'    real(wp), parameter :: {name}(0:{len(coefficients) - 1}) = [ &']
    last = len(coefficients) - 1
    for k, value in enumerate(coefficients):
        end = ']' if k == last else ', &'
        lines.append(f'        {printed(value)}_wp{end}')
    return lines


def module_text(a, b, r, s, short, column):
    lines = [
        '!> Coefficients of the influence primitive; made by'
        ' tools/generate/influence_coefficients.py.',
        'module faststrip_influence_closed_coefficients',
        '    use faststrip_base_kinds, only: wp',
        '    implicit none',
        '    private',
        '',
        '    public :: a_small, b_small, r_large, r_centre, atanh_series, atanh_last',
        '    public :: atanh_column, column_last',
        '    public :: a_short, b_short, r_short, short_last',
        '',
        '    !> Centre of the powers of `r_large`.',
        f'    real(wp), parameter :: r_centre = {mp.nstr(centre_of_r(), 20)}_wp',
        '']
    lines += fortran_array('a_small', 'A(x), powers of x = c^2, 0 <= x <= 1.', a) + ['']
    lines += fortran_array('b_small', 'B(x), powers of x = c^2, 0 <= x <= 1.', b) + ['']
    lines += fortran_array('r_large', 'R(w), powers of w - r_centre, w = 1/c^2, 0 <= w <= '
                           f'{W_TOP}.', r) + ['']
    lines += ['    !> Largest argument of the short forms.',
              f'    real(wp), parameter :: short_last = {SHORT}_wp', '']
    lines += fortran_array('a_short', 'A(x) for 0 <= x <= short_last.', short[0]) + ['']
    lines += fortran_array('b_short', 'B(x) for 0 <= x <= short_last.', short[1]) + ['']
    lines += fortran_array('r_short', 'R(w), powers of w itself, 0 <= w <= short_last.',
                           short[2]) + ['']
    lines += ['    !> Largest argument of `atanh_series`.',
              f'    real(wp), parameter :: atanh_last = {Z_TOP}_wp', '']
    lines += fortran_array('atanh_series', 'atanh(z)/z, powers of z^2, |z| <= atanh_last.', s)
    lines += ['', '    !> Largest argument of `atanh_column`.',
              f'    real(wp), parameter :: column_last = {COLUMN}_wp', '']
    lines += fortran_array('atanh_column', 'The same to 1e-11, |z| <= column_last.', column)
    lines += ['end module faststrip_influence_closed_coefficients', '']
    return '\n'.join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--check', action='store_true',
                        help='compare with the committed module instead of writing it')
    arguments = parser.parse_args()
    mp.mp.dps = DIGITS
    top = mp.mpf(C_SMALL)**2
    zero = mp.mpf(0)
    a = chebyshev_to_powers(a_factor, zero, top, DEGREE_A, zero)
    b = chebyshev_to_powers(b_factor, zero, top, DEGREE_B, zero)
    r = chebyshev_to_powers(r_factor, zero, mp.mpf(W_TOP), DEGREE_R, centre_of_r())
    s = chebyshev_to_powers(s_factor, zero, mp.mpf(Z_TOP)**2, DEGREE_S, zero)
    column = chebyshev_to_powers(s_factor, zero, mp.mpf(COLUMN)**2, DEGREE_S, zero)
    short = [chebyshev_to_powers(f, zero, mp.mpf(SHORT), DEGREE_SHORT, zero)
             for f in (a_factor, b_factor, r_factor)]
    small, large, kernel, of_columns = check(a, b, r, s, short, column)
    print(f'relative difference from the exact primitive: {small:.1e} (c <= {C_SMALL}), '
          f'{large:.1e} (c >= {C_LARGE}); of atanh: {kernel:.1e}, {of_columns:.1e}')
    if max(small, large, kernel) > ALLOWED or of_columns > ALLOWED_COLUMN:
        print(f'more than {ALLOWED:.0e} or {ALLOWED_COLUMN:.0e}: refused', file=sys.stderr)
        return 1
    text = module_text(a, b, r, s, short, column)
    if not arguments.check:
        MODULE.write_text(text)
        print(f'{MODULE.name} written')
        return 0
    if MODULE.read_text() != text:
        print(f'{MODULE.name} is not what this script makes', file=sys.stderr)
        return 1
    print(f'{MODULE.name} reproduced byte for byte')
    return 0


if __name__ == '__main__':
    sys.exit(main())
