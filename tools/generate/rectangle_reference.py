#!/usr/bin/env python3
"""Make reference/influence/reference_rectangle.csv: integrals over rectangles seen from a point.

Columns, mm: x, y from the middle of the rectangle to the point, sides dx, dy, and the integrals of
x^2/r^3, y^2/r^3, xy/r^3, x/r^2 and y/r^2 over it: primitives at the corners in 40 digits.

    rectangle_reference.py           write the file
    rectangle_reference.py --check   compare with the committed one; exit 1 if other
"""
import argparse
import pathlib
import sys

import mpmath as mp

FILE = (pathlib.Path(__file__).resolve().parents[2]
        / 'reference/influence/reference_rectangle.csv')


def integrals(x, y, dx, dy):
    """The five integrals; arguments are exact doubles."""
    x, y, dx, dy = (mp.mpf(value) for value in (x, y, dx, dy))

    def corners(primitive):
        return sum(i * j * primitive(x + i * dx / 2, y + j * dy / 2)
                   for i in (1, -1) for j in (1, -1))

    def potential(s, t):
        return t * mp.asinh(s / abs(t)) if t else mp.mpf(0)

    def logarithm(s, t):
        return ((t * mp.log(s * s + t * t) / 2 if t else mp.mpf(0))
                + (s * mp.atan(t / s) if s else mp.mpf(0)))

    return (corners(potential), corners(lambda s, t: potential(t, s)),
            corners(lambda s, t: -mp.sqrt(s * s + t * t)),
            corners(logarithm), corners(lambda s, t: logarithm(t, s)))


def rows():
    yield 'x_mm,y_mm,dx_mm,dy_mm,xx_r3_mm,yy_r3_mm,xy_r3_mm,x_r2_mm,y_r2_mm'
    for dx, dy in ((.2, .2), (.1, .3), (2., .5), (.2, 4.)):
        m = max(dx, dy)
        for x, y in ((0., dy), (.3 * dx, .2 * dy), (dx / 2, dy / 2), (dx, 0.), (dx / 2, dy),
                     (3 * dx, -2 * dy), (-1.7 * dx, .9 * dy), (10 * dx, 0.), (-7 * dx, 11 * dy),
                     (22 * m, 3 * m), (23 * m, -4 * m), (0., 30 * m), (-41 * m, 50 * m),
                     (300 * m, 1e-3 * m), (1e3 * m, -2e3 * m)):
            yield ','.join([repr(value) for value in (x, y, dx, dy)]
                           + [mp.nstr(value, 30) for value in integrals(x, y, dx, dy)])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--check', action='store_true')
    check = parser.parse_args().check
    mp.mp.dps = 40
    text = '\n'.join(rows()) + '\n'
    if not check:
        FILE.write_text(text, encoding='utf-8')
    elif FILE.read_text(encoding='utf-8') != text:
        sys.exit(f'{FILE.name} is not what this script makes')


if __name__ == '__main__':
    main()
