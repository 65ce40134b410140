#!/usr/bin/env python3
"""Make reference/influence/reference_edges.csv and reference_slopes.csv.

reference_edges.csv: the strip influence and its derivatives. Columns, all in half-lengths of the
strip that carries the pressure:
    X, c_left, c_right   field point and edges, doubles to be read as they stand (17 digits)
    value                int_{-1}^{1} sqrt(1-u^2) [asinh(c_right/|u-X|) - asinh(c_left/|u-X|)] du
    d_x                  its derivative in X
    d_half_length        int_{-1}^{1} u^2/sqrt(1-u^2) [the same] du, the derivative of
                         I = xd value with respect to xd, field point and edges fixed in mm
reference_slopes.csv: derivatives with respect to the edge and the width. Columns:
    n, X, c, slope       n = -1: int_{-1}^{1} sqrt(1-u^2)/sqrt((u-X)^2 + c^2) du
                         n >= 0: di_n/db at b = c, X = 0
Tanh-sinh quadrature of the definition in 34 digits, u = sin t, cut at the field point and at
distances in proportion to the edges; di_n/db by elliptic integrals in 150; 20 digits written.

    influence_reference.py           write the files
    influence_reference.py --check   compare them with the committed ones; exit 1 if
                                     one differs
"""
import argparse
import pathlib
import random
import sys

import mpmath as mp

FOLDER = pathlib.Path(__file__).resolve().parents[2] / 'reference/influence'
SEED = 20140


def integrals(x, c_left, c_right):
    """Value, derivative in X, derivative in the half-length; arguments are exact doubles."""
    x, c_left, c_right = mp.mpf(x), mp.mpf(c_left), mp.mpf(c_right)
    sizes = sorted({s for s in (abs(c_left), abs(c_right), abs(abs(x) - 1)) if 0 < s})
    places = {mp.mpf(-1), mp.mpf(1)}
    for size in sizes:
        for power in range(-1, 3):
            for side in (-1, 1):
                places.add(x + side * size * mp.mpf(6)**power)
    if sizes and sizes[0] < 1:
        distance = sizes[0]
        while distance < 2:
            places.update((x - distance, x + distance))
            distance *= 16
    places.add(x)
    places = sorted(p for p in places if -1 <= p <= 1)
    cuts = [mp.asin(p) for p in places]

    known = {}

    def kernel(t):
        if t not in known:
            delta = abs(mp.sin(t) - x)
            known[t] = mp.mpf(0) if delta == 0 else (
                mp.asinh(c_right / delta) - mp.asinh(c_left / delta))
        return known[t]

    def total(f):
        return mp.fsum(mp.quad(f, [left, right]) for left, right in zip(cuts, cuts[1:])
                       if right - left > mp.mpf(10)**-30)

    value = total(lambda t: mp.cos(t)**2 * kernel(t))
    d_x = -total(lambda t: mp.sin(t) * kernel(t))
    d_half_length = total(lambda t: mp.sin(t)**2 * kernel(t))
    return value, d_x, d_half_length


def places():
    """Field points and edges: a lattice over every regime, then strips as a solver meets them."""
    rows = []
    for x in (0.0, 1e-3, 0.3, 0.9, 0.999, 1.0 - 1e-6, 1.0, 1.0 + 1e-6, 1.001, 1.05, 1.3, 3.0):
        for c_left, c_right in ((0.0, 1e-6), (0.0, 2e-3), (0.0, 0.05), (0.0, 0.6), (0.0, 40.0),
                                (1e-6, 3e-6), (1e-3, 3e-3), (1e-3, 1.001e-3), (0.02, 0.06),
                                (0.3, 0.3001), (0.4, 1.2), (2.0, 2.5), (7.0, 7.7),
                                (-0.1, 0.1), (-1e-3, 0.2)):
            rows.append((x, c_left, c_right))
    source = random.Random(SEED)
    for _ in range(150):
        width = 10.0**source.uniform(-3.0, 1.0)
        c_left = width * source.choice((0.0, 0.5, -0.5, 1.0, 1.5, 2.5, 5.5, 12.5, -3.5))
        x = source.choice((source.uniform(0.0, 1.0), source.uniform(0.9, 1.1),
                           source.uniform(1.0, 4.0), 1.0))
        rows.append((x, c_left, c_left + width))
    for x in (1e3, 1e6):
        rows += [(x, 0.0, 1e-2), (x, -1.0, 1.0), (x, 300.0, 301.0), (x, 1e7, 1.1e7)]
    return rows


def edge_slope(x, c):
    """dG/dc by quadrature of the definition."""
    x, c = mp.mpf(x), mp.mpf(c)
    places = {mp.mpf(-1), mp.mpf(1), x}
    distance = max(c, abs(x - 1)) / 4
    while distance < 4:
        places.update((x - distance, x + distance, 1 - distance))
        distance *= 4
    distance = c / 4
    while distance < 4:
        places.update((x - distance, x + distance))
        distance *= 8
    cuts = [mp.asin(p) for p in sorted(p for p in places if -1 <= p <= 1)]
    return mp.fsum(mp.quad(lambda t: mp.cos(t)**2 / mp.sqrt((mp.sin(t) - x)**2 + c * c),
                           [left, right])
                   for left, right in zip(cuts, cuts[1:]) if right - left > mp.mpf(10)**-30)


def width_slope(n, b):
    """di_n/db from G'(c) = 2 sqrt(1 + c^2) [K(m) - E(m)], m = 1/(1 + c^2)."""
    def slope(c):
        m = 1 / (1 + c * c)
        return 2 * mp.sqrt(1 + c * c) * (mp.ellipk(m) - mp.ellipe(m))

    with mp.workdps(150):
        right, left = (2 * n + 1) * mp.mpf(b), (2 * n - 1) * mp.mpf(b)
        if n == 0:
            return 2 * slope(right)
        return (2 * n + 1) * slope(right) - (2 * n - 1) * slope(left)


def slope_lines():
    lines = ['n,X,c,slope']
    for x in (0.0, 1e-6, 0.3, 0.9, 0.999, 1.0 - 1e-6, 1.0, 1.0 + 1e-6, 1.001, 1.05, 1.3, 3.0, 1e3):
        for c in (1e-12, 1e-8, 1e-4, 1e-2, 0.1, 0.4, 1.0, 3.0, 1e2, 1e6):
            lines.append(f'-1,{x:.16e},{c:.16e},{digits(edge_slope(x, c))}')
    for n in (0, 1, 2, 10, 100, 10000):
        for b in (1e-8, 1e-4, 1e-2, 0.1, 0.3, 0.55, 1.0, 1.7, 1e1, 1e4, 1e8):
            lines.append(f'{n},{0:.16e},{b:.16e},{digits(width_slope(n, b))}')
    return lines


def digits(value):
    return mp.nstr(value, 20, min_fixed=1, max_fixed=0, strip_zeros=False, show_zero_exponent=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--check', action='store_true',
                        help='compare with the committed files instead of writing them')
    arguments = parser.parse_args()
    mp.mp.dps = 34
    edges = ['X,c_left,c_right,value,d_x,d_half_length']
    for x, c_left, c_right in places():
        value, d_x, d_half_length = integrals(x, c_left, c_right)
        d_x = mp.mpf(0) if x == 0 else d_x
        edges.append(f'{x:.16e},{c_left:.16e},{c_right:.16e},'
                     f'{digits(value)},{digits(d_x)},{digits(d_half_length)}')
    code = 0
    for name, lines in (('reference_edges.csv', edges), ('reference_slopes.csv', slope_lines())):
        text = '\n'.join(lines) + '\n'
        if not arguments.check:
            (FOLDER / name).write_text(text)
            print(f'{name}: {len(lines) - 1} rows written')
        elif (FOLDER / name).read_text() != text:
            print(f'{name} is not what this script makes', file=sys.stderr)
            code = 1
        else:
            print(f'{name} reproduced byte for byte')
    return code


if __name__ == '__main__':
    sys.exit(main())
