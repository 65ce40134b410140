"""Pictures of the extremes: drawn from all parts or some, right, bad input refused."""

import unittest
from unittest import mock

import matplotlib.image
import numpy as np

# First: it finds the plots' package.
from plot_samples import Folder, csv_text, load

# isort: split
from faststrip_plots import picture, style

COLUMNS = "chapter,case,method,x_name,x,y_name,y,quantity,value,reference,status".split(",")
EXTREMES = "out/extremes/extremes.csv"
FIGURES = ("penetration", "pmax", "area", "Fx", "Fy", "Mz")


def row(chapter, method, x, y, quantity, value, case="", status="ok"):
    return dict(chapter=chapter, case=case, method=method, x_name="x", x=x, y_name="y", y=y,
                quantity=quantity, value=value, reference="hertz", status=status)


def influence_rows():
    rows = []
    for k in range(-12, 13, 4):
        for n in (0, 1, 1000000):
            rows += [row("influence", method, 10.0**k, n, "rel_err", 1e-16, "centre")
                     for method in ("closed", "column", "gsl")]
            inside = -2 <= k <= 1 and n < 20
            rows += [row("influence", method, 10.0**k, n, "rel_err", 1e-3 if inside else "",
                         "centre", "ok" if inside else "out_of_range")
                     for method in ("published", "refit")]
        rows += [row("influence", method, 10.0**k, x, "rel_err", 1e-15, "n = 1")
                 for method in ("closed", "gsl") for x in (0.3, 1.0, 1.000001)]
    return rows


def normal_rows():
    rows = []
    for ratio in (0.01, 1.0):
        for strips in (3, 15, 101):
            rows += [row("strips", "strip", ratio, strips, name, strips**-2.0)
                     for name in ("penetration_err", "pmax_err", "area_err")]
            rows.append(row("strips", "strip", ratio, strips, "condition", 10.0 * strips))
    for chapter in ("ellipses", "flat_gaps"):
        rows += [row(chapter, "strip", x, y, name, 1e-3) for x in (1e-3, 1e3) for y in (5, 1e9)
                 for name in ("penetration_err", "pmax_err", "area_err")]
    return rows


def tangential_rows(methods=("faststrip", "fastsim")):
    return [row("tangential", method, x, y, name, value, "all nu = 0.28")
            for method in methods for x in (0.0, 1e-3, 10.0) for y in (0.0, 2.0)
            for name, value in (("force", min(1.0, x)), ("negative_power", 0.0), ("oddness", 0.0),
                                ("step", 1e-7))]


def noise_rows():
    rows = []
    for case in ("one", "two"):
        for name in FIGURES:
            rows += [row("noise", "both", noise, 20, name, 3.0 * noise, case)
                     for noise in (2.2e-16, 1e-11, 1e-7)]
            rows.append(row("load_steps", "both", 1e-3, 200, name, 1e-5, case))
    return rows


def rounding_rows(spread):
    rows = [row("rounding", "closed", 1.0, 0.0, "influence", spread)]
    rows += [row("rounding", method, 0.0, 0.0, name, value) for name in FIGURES
             for method, value in (("strip+faststrip", 0.0), ("solvers alone", spread))]
    return rows


def single_rows():
    rows = [row("single", method, 1.375 * 2.0**k, x, "value", 1e-7, "n = 1")
            for method in ("strip_influence_at", "gradient", "column_gradient")
            for k in range(-40, 41) for x in (0.875, 1.0)]
    rows += [row("single", method, x, load, "area", 1e-6)
             for method in ("hertz", "strips", "faststrip") for x in (0.01, 1.0) for load in (1, 9)]
    rows[5].update(value="", status="not_finite")
    return rows


ALL = influence_rows() + normal_rows() + tangential_rows() + noise_rows() + rounding_rows(1e-4)
NAMES = ("influence", "normal", "tangential", "steadiness")


class Pictures(unittest.TestCase):
    def drawn(self, files, names, *arguments, folder_name="out/extremes"):
        with Folder({name: csv_text(COLUMNS, rows) for name, rows in files.items()}) as folder:
            status, out, err = folder.run("extremes", *arguments)
            self.assertEqual((status, err), (0, ""))
            wanted = [f"{folder_name}/extremes_{name}.png" for name in names]
            self.assertEqual(out.split(), wanted)
            for name in wanted:
                pixels = matplotlib.image.imread(folder.path / name)
                self.assertGreater(min(pixels.shape[:2]), 400)
                self.assertGreater(pixels.std(), 0.05, "nothing is drawn")

    def test_everything(self):
        self.drawn({EXTREMES: ALL, "r.csv": rounding_rows(1e-15), "s.csv": single_rows()},
                   (*NAMES, "single"), "--rounding", "r.csv", "--single", "s.csv",
                   "--folder", "p", folder_name="p")

    def test_some_parts(self):
        for name, rows in (("tangential", tangential_rows(("a", "b", "c", "d", "e"))),
                           ("steadiness", noise_rows())):
            with self.subTest(name):
                self.drawn({EXTREMES: rows}, [name])
        # These are drawn of the same rows among all.
        for name, rows in (("influence", influence_rows()), ("normal", normal_rows())):
            with self.subTest(name), Folder({EXTREMES: csv_text(COLUMNS, rows)}) as folder, \
                    mock.patch.object(picture, "save", lambda _, path, *__: print(path)):
                self.assertEqual(folder.run("extremes"),
                                 (0, f"out/extremes/extremes_{name}.png\n", ""))

    def test_methods_that_give_no_force(self):
        rows = tangential_rows() + [row("tangential", "broken", 1.0, 2.0, "force", "",
                                        status="no_convergence")]
        self.drawn({EXTREMES: rows}, ["tangential"])


class BadInput(unittest.TestCase):
    def refused(self, text, words, *arguments):
        with Folder({} if text is None else {EXTREMES: text}) as folder:
            folder.refused(self, words, "extremes", *arguments)

    def test_files_and_columns(self):
        good = csv_text(COLUMNS, ALL)
        self.refused(None, f"no such file: {EXTREMES}")
        self.refused(good, "no such file: r.csv", "--rounding", "r.csv")
        self.refused(good, "no such file: s.csv", "--single", "s.csv")
        self.refused(good.replace(",quantity", ",other", 1), "missing column: quantity")
        self.refused(csv_text(COLUMNS, [row("noise", "m", "x1", 1, "pmax", 1)]), "x1")
        self.refused(csv_text(COLUMNS, [row("guess", "m", 1, 1, "pmax", 1)]),
                     "none of the chapters")


class Drawn(unittest.TestCase):
    """What the maps show."""

    def test_the_largest_of_each_place_and_the_statuses(self):
        extremes = load("extremes")
        rows = [row("c", "m", 1.0, 5.0, "q", 1e-3, "a"), row("c", "m", 1.0, 5.0, "q", 2e-3, "b"),
                row("c", "m", 10.0, 5.0, "q", "", status="out_of_range"),
                row("c", "m", 10.0, 7.0, "q", -4e-3)]
        with Folder({"c.csv": csv_text(COLUMNS, rows)}) as folder:
            read = extremes.read_rows(extremes.read_table(str(folder.path / "c.csv")))
        figure = style.new_figure(4.0, 4.0)
        axes = figure.subplots()
        panel = extremes.Panel("Heading", read, (1e-5, 1.0))
        image = extremes.draw_map(axes, panel, "x", "y")
        grid = np.ma.filled(image.get_array(), np.nan).reshape(2, 2)
        np.testing.assert_allclose(grid, [[2e-3, np.nan], [np.nan, 4e-3]])
        self.assertEqual([each.get_text() for each in axes.texts],
                         ["largest 0.004; 1 × out of range"])

    def test_short_numbers(self):
        short = load("extremes").short
        for value, text in ((0.0, "0"), (0.3, "0.3"), (1000.0, "1000"), (1e6, "$10^{6}$"),
                            (9.95e-13, "$10^{-12}$"), (3.85e-16, "$3.9\\cdot 10^{-16}$"),
                            (1.000001, "$1+$$10^{-6}$")):
            self.assertEqual(short(value), text)
