#!/usr/bin/env python3
"""Make reference/contact/spence_theory.csv: Spence's contact by its integral equations.

Columns: ways (1: pressures are Hertz's, 2: tractions change them), stick (radius in adhesion over
that of the contact), beta (Dundurs' constant), mu, then over Hertz's for this radius: load,
penetration, pmax; share (tractions over their bounds, sums).

    spence_reference.py           write the file
    spence_reference.py --check   compare with the committed one; exit 1 if
                                  a number differs by more than 2e-5

With the contact's radius and the compliance 1, Hankel transforms of pressure and traction
int g cos(kt) dt and int h sin(kt) dt over 0 < t < 1, Abel's operators make of the displacements

    pi/2 g(t) - beta int s h(s)/(s^2 - t^2) ds = D - 2 t^2          (one way: without beta)
    pi/2 h(t) - beta int t g(s)/(t^2 - s^2) ds = C t^2              in adhesion, t < c
    h(t) = -2/pi mu int_t^1 g'(s) k K(sqrt(1 - k^2)) ds, k = t/s    in slip, t > c

C t^2: displacements in adhesion, which do not change while all grows alike, are as r^2. g(1) = 0,
and at c, which moves outwards, h and h' are continuous: that makes mu. g and h are linear between
nodes, with exact integrals; three numbers of nodes are extrapolated.
"""
import argparse
import csv
import math
import pathlib
import sys

import numpy as np

FILE = pathlib.Path(__file__).resolve().parents[2] / 'reference/contact/spence_theory.csv'
COLUMNS = ['ways', 'stick', 'beta', 'mu', 'load', 'penetration', 'pmax', 'share']
CASES = [(1, 0.3, 0.5), (1, 0.5, 0.5), (1, 0.7, 0.5), (2, 0.3, 0.5), (2, 0.5, 0.5), (2, 0.7, 0.5),
         (2, 0.5, 2 / 7)]
NODES = 100
LAST_DIGIT = 2e-5


def elliptic(k):
    """K(sqrt(1 - k^2)) by the arithmetic-geometric mean."""
    a, b = np.ones_like(k), k
    for _ in range(8):
        a, b = (a + b) / 2, np.sqrt(a * b)
    return math.pi / (2 * a)


def make_nodes(c, n):
    """Nodes from 0 to 1, c the one in the middle; denser towards all three."""
    graded = (1 - np.cos(math.pi * np.linspace(0, 1, n // 2 + 1))) / 2
    return np.concatenate([c * graded, c + (1 - c) * graded[1:]])


def cauchy(t, at):
    """Principal values of int f(s)/(s - at) ds, columns: f is 1 at one node, linear beside it."""
    a, b, at = t[None, :-1], t[None, 1:], at[:, None]
    # What is infinite at a node cancels between the elements beside it.
    distance = [np.where(np.abs(end - at) < 1e-14, 1.0, np.abs(end - at)) for end in (a, b)]
    whole = np.log(distance[1] / distance[0])
    rising = 1 + (at - a) / (b - a) * whole
    matrix = np.zeros((at.size, t.size))
    matrix[:, 1:] += rising
    matrix[:, :-1] += whole - rising
    return matrix


def sliding(t, first):
    """h of the nodes from `first` on over mu, by g."""
    points, weights = np.polynomial.legendre.leggauss(6)
    s = t[first:-1, None] + (points + 1) / 2 * np.diff(t[first:])[:, None]
    matrix = np.zeros((t.size - 1 - first, t.size))
    for row, place in enumerate(t[first:-1]):
        k = place / s[row:]
        part = (k * elliptic(k)) @ weights / math.pi
        matrix[row, first + row + 1:] -= part
        matrix[row, first + row:-1] += part
    return matrix


def slope(x, f):
    """Derivative at the first of three points."""
    near, far = x[1] - x[0], x[2] - x[0]
    return ((f[1] - f[0]) * far / near - (f[2] - f[0]) * near / far) / (far - near)


class Equations:
    def __init__(self, ways, c, beta, n):
        self.t = t = make_nodes(c, n)
        self.middle = m = n // 2
        plus, minus = cauchy(t, -t), cauchy(t, t)
        g, h = np.arange(n), n + np.arange(n - 1)  # g at all nodes but the last, h at those inside
        self.slides = sliding(t, m)
        self.matrix = np.zeros((2 * n + 1, 2 * n + 1))
        self.right = np.zeros(2 * n + 1)
        self.matrix[g, g] = math.pi / 2
        if ways == 2:
            self.matrix[:n + 1, h] = -beta * (minus + plus)[:, 1:-1] / 2
        self.matrix[:n + 1, 2 * n - 1] = -1
        self.right[:n + 1] = -2 * t**2
        rows = n + np.arange(1, m + 1)
        self.matrix[rows, h[:m]] = math.pi / 2
        self.matrix[rows, :n] = -beta * (plus - minus)[1:m + 1, :-1] / 2
        self.matrix[rows, 2 * n] = -t[1:m + 1]**2
        self.last = n + m + 1 + np.arange(n - m)
        self.matrix[self.last, h[m - 1:]] = 1

    def solve(self, mu):
        """What the derivative of h jumps by at c; D, g and h."""
        n = self.t.size - 1
        self.matrix[self.last, :n] = -mu * self.slides[:, :-1]
        x = np.linalg.solve(self.matrix, self.right)
        g = np.append(x[:n], 0)
        h = np.concatenate([[0], x[n:2 * n - 1], [0]])
        m, t = self.middle, self.t
        jump = slope(t[m:m + 3], h[m:m + 3]) - slope(t[m:m - 3:-1], h[m:m - 3:-1])
        return jump, x[2 * n - 1], g, h


def figures(ways, c, beta, n):
    """mu, load, penetration, pmax, share on so many nodes."""
    equations = Equations(ways, c, beta, n)
    t = equations.t
    mu, other = 0.5 * beta, 0.6 * beta
    jump = equations.solve(mu)[0]
    while abs(other - mu) > 1e-12 * beta:
        new = equations.solve(other)[0]
        mu, other, jump = other, other - new * (other - mu) / (new - jump), new
    _, depth, g, h = equations.solve(other)
    load = np.trapezoid(g, t)
    top = -np.sum(np.diff(g) / ((t[1:] + t[:-1]) / 2))
    return np.array([other, load * 3 * math.pi / 8, depth / 2, top / (3 * load),
                     math.pi / 2 * np.trapezoid(h, t) / (other * load)])


def extrapolated(ways, c, beta):
    """Aitken's limit for nodes without end."""
    one, two, three = (figures(ways, c, beta, NODES * 2**level) for level in range(3))
    bend = three - 2 * two + one
    return np.where(np.abs(bend) < 1e-10, three, three - (three - two)**2 / np.where(bend, bend, 1))


def rows():
    for ways, c, beta in CASES:
        yield dict(zip(COLUMNS, [ways, c, f'{beta:.6f}',
                                 *(f'{value:.5f}' for value in extrapolated(ways, c, beta))],
                       strict=True))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--check', action='store_true')
    if not parser.parse_args().check:
        with FILE.open('w', encoding='utf-8', newline='') as stream:
            writer = csv.DictWriter(stream, COLUMNS, lineterminator='\n')
            writer.writeheader()
            writer.writerows(rows())
        return
    with FILE.open(encoding='utf-8') as stream:
        for old, new in zip(csv.DictReader(stream), rows(), strict=True):
            if any(abs(float(old[name]) - float(new[name])) > LAST_DIGIT for name in COLUMNS):
                sys.exit(f'{FILE.name}: {old} is {new}')


if __name__ == '__main__':
    main()
