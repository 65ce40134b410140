#!/usr/bin/env python3
"""Make reference/influence/reference_edges.csv.

The strip influence and its derivatives. Columns, all in half-lengths of the strip that carries the
pressure:
    X, c_left, c_right   field point and edges, doubles to be read as they stand (17 digits)
    value                int_{-1}^{1} sqrt(1-u^2) [asinh(c_right/|u-X|) - asinh(c_left/|u-X|)] du
    d_x                  its derivative in X
    d_half_length        int_{-1}^{1} u^2/sqrt(1-u^2) [the same] du, the derivative of
                         I = xd value with respect to xd, field point and edges fixed in mm
Tanh-sinh quadrature of the definition in 34 digits, u = sin t, cut at the field point and at
distances in proportion to the edges; 20 digits written.

    influence_reference.py           write the file
    influence_reference.py --check   compare it with the committed one; exit 1 if it differs
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
    name = 'reference_edges.csv'
    text = '\n'.join(edges) + '\n'
    if not arguments.check:
        (FOLDER / name).write_text(text)
        print(f'{name}: {len(edges) - 1} rows written')
    elif (FOLDER / name).read_text() != text:
        print(f'{name} is not what this script makes', file=sys.stderr)
        return 1
    else:
        print(f'{name} reproduced byte for byte')
    return 0


if __name__ == '__main__':
    sys.exit(main())
