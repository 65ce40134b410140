"""Pictures of integrals, degrees, convergence and times: drawn, right, bad input refused."""

import math
import pathlib
import unittest
from unittest import mock

import matplotlib.image
import numpy as np

# First: it finds the plots' package.
from plot_samples import Folder, csv_text, load

# isort: split
from faststrip_plots import scales, style
from faststrip_plots.tables import read_table

ROOT = pathlib.Path(__file__).resolve().parents[2]
CURVES = "out/curves.csv"
DEGREES = "out/degrees.csv"
INTEGRAL = "out/bench_integral.csv"
CONVERGENCE = "out/convergence.csv"
NORMAL = "out/bench_normal.csv"
REFERENCE = "out/bench_reference.csv"


def curve_rows(*distances, error=0.01):
    """Curves like the integrals'; the published ones off by `error` inside, far more outside."""
    rows = []
    for n in distances:
        for step in range(-16, 13):
            L = 0.25 * step
            exact = (10.0**L if n else 4.0 * 10.0**L) / (1.0 + n * 10.0**L)
            off = error if -2.0 <= L <= 1.0 else error * 10.0 ** (3.0 * abs(L))
            rows.append(dict(n=n, L=L, b=10.0**L, exact=exact, published=exact * (1.0 + off),
                             rel_err=off))
    return rows


def degree_rows(floor=1e-8, last=20, fit="lsq", refused=99):
    """Errors falling tenfold with each degree; monomials stop at `floor`."""
    rows = []
    for basis in ("monomial", "chebyshev"):
        for n in (0, 2):
            for degree in range(last + 1):
                error = (1 + n) * 10.0**-degree
                if basis == "monomial":
                    error = max(error, floor)
                row = dict(basis=basis, fit=fit, n=n, degree=degree, max_rel_err=error,
                           rms_rel_err=0.3 * error,
                           condition=10.0**degree if basis == "monomial" else 3.0)
                if basis == "monomial" and degree >= refused:
                    row.update(max_rel_err="", rms_rel_err="")
                rows.append(row)
    return rows


def integral_rows():
    rows = []
    for method, loop, ns, error in (
        ("polynomial", "scalar", 20.0, 5e-3), ("polynomial", "row", 5.0, 5e-3),
        ("refit", "scalar", 20.5, 4e-3), ("refit", "row", 5.1, 4e-3),
        ("closed", "scalar", 21.0, 0.0), ("closed", "row", 6.0, 1e-16),
        ("gsl_1d", "scalar", 4e3, 2e-16), ("new_way", "scalar", 3e5, 5e-13),
    ):
        for n, factor in ((0, 0.8), (1, 1.0), (9, 1.4)):
            rows.append(dict(method=method, n=n, b=0.1, loop=loop, ns=ns * factor,
                             rel_err=error * factor, flags="-O3", compiler="gfortran", cpu="x"))
    return rows


def convergence_rows(order=2.0):
    return [
        dict(case=f"gap {case}", strips=strips, status="ok", penetration_err=-case * strips**-order,
             pmax_err=9 * case * strips**-order, area_err=3 * case * strips**-order)
        for case in (1, 2, 4) for strips in (5, 9, 15, 31)
    ]


def normal_rows():
    return [
        dict(start=start, strips=strips, us=factor * strips**2 * again, iterations=7,
             ns_per_entry=20.0, fastsim_us=120.0)
        for start, factor in (("cold", 1.0), ("warm_load", 0.2), ("warm_shift", 0.25))
        for strips in (5, 10, 20, 100, 400)
        for again in (1.0, 1.1, 3.0)
    ]


def reference_rows():
    return [
        dict(method=method, start=start, tolerance=tolerance, elements=elements + more,
             us=factor * elements**1.2 * again, iterations=12)
        for method, start, factor, tolerances in (
            ("norm", "cold", 1.0, (1e-9, 1e-4)), ("norm", "coarse", 0.9, (1e-9, 1e-4)),
            ("norm", "strips", 0.7, (1e-9, 1e-4)), ("norm", "warm_load", 0.8, (1e-9, 1e-4)),
            ("norm", "new_plans", 1.2, (1e-9, 1e-4)), ("tang", "cold", 20.0, (1e-7,)),
            ("tang", "warm_creepage", 13.0, (1e-7,)), ("tang", "new_plans", 23.0, (1e-7,)))
        for tolerance in tolerances
        for elements in (500, 1000, 4000, 16000, 100000)
        for again, more in ((1.0, 0), (1.1, 30), (3.0, -20))
    ]


HEADERS = {
    CURVES: "n,L,b,exact,published,rel_err",
    DEGREES: "basis,fit,n,degree,max_rel_err,rms_rel_err,condition",
    INTEGRAL: "method,n,b,loop,ns,rel_err,flags,compiler,cpu",
    CONVERGENCE: "case,strips,status,penetration_err,pmax_err,area_err",
    NORMAL: "start,strips,us,iterations,ns_per_entry,fastsim_us",
    REFERENCE: "method,start,tolerance,elements,us,iterations",
}
ROWS = {
    CURVES: curve_rows(0, 1, 2, 4, 5, 20),
    DEGREES: degree_rows(),
    INTEGRAL: integral_rows(),
    CONVERGENCE: convergence_rows(),
    NORMAL: normal_rows(),
    REFERENCE: reference_rows(),
}
COMMANDS = {
    "integrals": (CURVES, "exact", ("out/integrals.png", "out/integral_errors.png")),
    "degrees": (DEGREES, "max_rel_err", ("out/degrees.png",)),
    "bench_integral": (INTEGRAL, "ns", ("out/bench_integral.png",)),
    "convergence": (CONVERGENCE, "pmax_err", ("out/convergence.png",)),
    "bench_normal": (NORMAL, "us", ("out/bench_normal.png",)),
    "bench_reference": (REFERENCE, "us", ("out/bench_reference.png",)),
}


def text(name, rows=None):
    return csv_text(HEADERS[name].split(","), ROWS[name] if rows is None else rows)


def changed(name, row, **cells):
    """The sample of a file with some cells of one row changed."""
    rows = [dict(each) for each in ROWS[name]]
    rows[row].update(cells)
    return text(name, rows)


def texts(axes):
    return [each.get_text() for each in axes.texts]


class Pictures(unittest.TestCase):
    def drawn(self, command, content=None, *arguments, pictures=None):
        name, _, own = COMMANDS[command]
        with Folder({name: content or text(name)}) as folder:
            status, out, err = folder.run(command, *arguments)
            self.assertEqual((status, err), (0, ""))
            for picture in pictures or own:
                pixels = matplotlib.image.imread(folder.path / picture)
                self.assertGreater(min(pixels.shape[:2]), 400)
                self.assertGreater(pixels.std(), 0.05, "nothing is drawn")
                self.assertIn(picture, out)
            return out

    def test_every_command_draws_from_its_default_file(self):
        for command in COMMANDS:
            with self.subTest(command):
                self.drawn(command)

    def test_other_names(self):
        # These are drawn of the same rows under their own names.
        for command, arguments, names in (
                ("integrals", ("--folder", "p"), ("p/integrals.png", "p/integral_errors.png")),
                *((command, ("-o", "p/q.png"), ("p/q.png",))
                  for command in ("degrees", "bench_integral", "convergence", "bench_normal"))):
            with self.subTest(command), Folder({COMMANDS[command][0]: text(COMMANDS[command][0])}) \
                    as folder, mock.patch.object(style, "write_png",
                                                 lambda _, path, __: pathlib.Path(path).touch()):
                self.assertEqual(folder.run(command, *arguments),
                                 (0, "".join(f"{name}\n" for name in names), ""))
                self.assertEqual({path.relative_to(folder.path).as_posix()
                                  for path in folder.path.rglob("*.png")}, set(names))
        contact = str(ROOT / "reference/contact/s1002_uic60_B.csv")
        self.drawn("bench_reference", None, "--contact", contact, "-o", "p/q.png",
                   pictures=["p/q.png"])

    def test_curves_of_some_distances_only(self):
        for distances in ((7,), (0, 12)):
            with self.subTest(distances):
                self.drawn("integrals", text(CURVES, curve_rows(*distances)))

    def test_curves_without_published_values_somewhere(self):
        rows = [dict(row) for row in ROWS[CURVES]]
        # Outside of the table's range, and inside.
        for k in (3, 14):
            rows[k].update(published="", rel_err="")
        self.drawn("integrals", text(CURVES, rows))

    def test_exact_polynomials(self):
        self.drawn("integrals", text(CURVES, curve_rows(0, 1, error=0.0)))

    def test_several_fits_and_one_basis(self):
        self.drawn("degrees", text(DEGREES, degree_rows() + degree_rows(fit="minimax")))
        rows = [row for row in degree_rows() if row["basis"] == "chebyshev"]
        self.drawn("degrees", text(DEGREES, rows))

    def test_single_rows(self):
        for command, (name, _, _) in COMMANDS.items():
            with self.subTest(command):
                row = next(row for row in ROWS[name] if row.get("L", -1.0) == -1.0)
                self.drawn(command, text(name, [row]))

    def test_rows_without_a_result_are_counted(self):
        content = changed(CONVERGENCE, 1, status="no_convergence", penetration_err="",
                          pmax_err="", area_err="")
        self.assertIn("1 of 12 rows without a result skipped (1 no_convergence)",
                      self.drawn("convergence", content))

    def test_times_without_iterations_entries_and_fastsim(self):
        self.drawn("bench_normal", text(NORMAL, [
            dict(row, iterations="", ns_per_entry="", fastsim_us="") for row in ROWS[NORMAL]
        ]))


class BadInput(unittest.TestCase):
    def refused(self, command, content, words):
        name, _, _ = COMMANDS[command]
        with Folder({} if content is None else {name: content}) as folder:
            folder.refused(self, words, command)

    def test_missing_file_column_and_data_or_not_a_number(self):
        for command, (name, column, _) in COMMANDS.items():
            for content, words in (
                (None, f"no such file: {name}"),
                ("", f"the file is empty: {name}"),
                (text(name, []), f"no row of data below the header: {name}"),
                (text(name).replace(f",{column}", ",other", 1),
                 f"missing column: {column} ({name}:3)"),
                (changed(name, 1, **{column: "x1"}),
                 f"{column} must be a finite number, got x1 ({name}:5)"),
            ):
                with self.subTest(command=command, words=words):
                    self.refused(command, content, words)

    def test_figures_that_cannot_be(self):
        for command, changes, words in (
            ("integrals", dict(n=1.5), "n must be one of 0 to 20, got 1.5"),
            ("integrals", dict(n=21), "n must be one of 0 to 20, got 21"),
            ("integrals", dict(n=-1), "n must be one of 0 to 20, got -1"),
            ("integrals", dict(b=0), "b must be above zero, got 0"),
            ("integrals", dict(exact=-1), "exact must be above zero, got -1"),
            ("degrees", dict(basis="fourier"), "basis must be monomial or chebyshev, got fourier"),
            ("bench_integral", dict(ns=0), "ns must be above zero, got 0"),
            ("bench_integral", dict(loop="both"), "loop must be one of scalar, row, got both"),
            ("convergence", dict(strips=0), "strips must be at least 1, got 0"),
            ("bench_normal", dict(us=-1), "us must be above zero, got -1"),
            ("bench_normal", dict(strips=0), "strips must be above zero, got 0"),
            ("bench_normal", dict(start="hot"), "start must be one of cold, warm_load,"
                                              " warm_shift, got hot"),
            ("bench_reference", dict(us=-1), "us must be above zero, got -1"),
            ("bench_reference", dict(elements=0), "elements must be above zero, got 0"),
            ("bench_reference", dict(method="hope"), "method must be one of norm, tang, got hope"),
            ("bench_reference", dict(start="hot"), "start must be one of cold, coarse, strips,"
                                                   " warm_load, warm_creepage, new_plans, got hot"),
        ):
            with self.subTest(command=command, words=words):
                name = COMMANDS[command][0]
                self.refused(command, changed(name, 2, **changes), f"{words} ({name}:6)")

    def test_curves_that_miss_the_range(self):
        rows = [row for row in curve_rows(0, 3) if row["n"] == 0 or row["L"] > 1.0]
        self.refused("integrals", text(CURVES, rows),
                     f"L must have values from -2 to 1 for n = 3: {CURVES}")

    def test_no_errors_at_all(self):
        self.refused("degrees", text(DEGREES, [dict(r, max_rel_err=0) for r in ROWS[DEGREES]]),
                     f"max_rel_err must have an error above zero, got none: {DEGREES}")
        self.refused("convergence",
                     text(CONVERGENCE, [dict(r, area_err="") for r in ROWS[CONVERGENCE]]),
                     f"area_err must have an error above zero, got none: {CONVERGENCE}")

    def test_times_of_different_runs(self):
        for column in ("flags", "compiler", "cpu"):
            with self.subTest(column):
                self.refused("bench_integral", changed(INTEGRAL, 0, **{column: "other"}),
                             f"{column} must be that of one run, got several: {INTEGRAL}")


class Drawn(unittest.TestCase):
    """What the pictures show."""

    def decays(self, rows):
        degrees = load("degrees")
        with Folder({"d.csv": text(DEGREES, rows)}) as folder:
            table = read_table(str(folder.path / "d.csv"))
        return degrees, {basis: degrees.Decay(table, own)
                         for basis, own in scales.groups(table.words("basis"))}

    def test_where_monomials_break_down(self):
        cut = [row for row in degree_rows(floor=0.0)
               if row["basis"] == "chebyshev" or row["degree"] <= 12]
        for rows, degree, words in (
            # 3e-8 at degree 8 is still above the floor, 3e-9 is not
            (degree_rows(), 9, "break down at degree 9"),
            (degree_rows(refused=7), 7, "refused from degree 7 on"),
            (cut, 13, "refused from degree 13 on"),
            (degree_rows(floor=0.0), None, ""),
        ):
            with self.subTest(words):
                degrees, decays = self.decays(rows)
                found, why = degrees.breakdown(decays["monomial"], decays["chebyshev"])
                self.assertEqual(found, degree)
                self.assertTrue(why.startswith(words))

    def test_the_worst_distance_is_the_line(self):
        _, decays = self.decays(degree_rows())
        np.testing.assert_allclose(decays["chebyshev"].high[:3], [3.0, 0.3, 0.03])
        np.testing.assert_allclose(decays["chebyshev"].low[:3], [1.0, 0.1, 0.01])
        np.testing.assert_allclose(decays["chebyshev"].rms[:3], [0.9, 0.09, 0.009])

    def test_curves_are_split_at_the_range(self):
        integrals = load("integrals")
        with Folder({"c.csv": text(CURVES, curve_rows(2)[::-1])}) as folder:
            curves, stamp = integrals.read_curves(str(folder.path / "c.csv"))
        self.assertEqual(stamp, "faststrip 0.1.0 rev abc1234")
        self.assertTrue((np.diff(curves[0].L) > 0.0).all())
        inside = curves[0].L[curves[0].inside]
        self.assertEqual((inside[0], inside[-1]), (-2.0, 1.0))
        self.assertAlmostEqual(integrals.largest_inside(curves[0]), 0.01)

    def test_the_worst_error_is_named(self):
        integrals = load("integrals")
        rows = curve_rows(1, 2)
        at = next(k for k, row in enumerate(rows) if (row["n"], row["L"]) == (2, -1.75))
        rows[at].update(rel_err=-0.0216)
        with Folder({"c.csv": text(CURVES, rows)}) as folder:
            curves, _ = integrals.read_curves(str(folder.path / "c.csv"))
        figure, note = integrals.error_figure([(1, 4, curves)])
        self.assertIn("worst, $n$ = 2: \N{MINUS SIGN}2.16 % at $L$ = \N{MINUS SIGN}1.75",
                      texts(figure.axes[0]))
        self.assertIn("errors above 1000 not shown", note)

    def test_labels_of_the_trade_keep_clear(self):
        bench = load("bench_integral")
        with Folder({"b.csv": text(INTEGRAL)}) as folder:
            table = read_table(str(folder.path / "b.csv"))
        ns = table.numbers("ns")
        error = np.maximum(table.numbers("rel_err"), bench.FLOOR)
        dots = [(method, loop, bench.spread(ns[rows]), bench.spread(error[rows]))
                for (method, loop), rows in scales.groups(table.words("method"),
                                                          table.words("loop"))]
        figure = style.new_figure(9.0, 5.8)
        axes = figure.subplots()
        obstacles = bench.draw_dots(axes, dots)
        axes.set_xscale("log")
        axes.set_yscale("log")
        bench.fit_limits(axes, dots)
        figure.draw_without_rendering()
        drawn = bench.label(axes, dots, obstacles)
        self.assertEqual([each.get_text() for each in drawn][2:], [
            "closed evaluation\n21 ns scalar, 6.0 ns row",
            "GSL quadrature, 1-D\n4.0 µs scalar", "new way\n300 µs scalar",
        ])
        boxes = [each.get_window_extent() for each in drawn]
        for k, box in enumerate(boxes):
            for other in boxes[k + 1:]:
                self.assertFalse(box.overlaps(other))
            for x0, y0, x1, y1 in obstacles:
                (left, low), (right, high) = axes.transData.transform([(x0, y0), (x1, y1)])
                self.assertFalse(box.x0 < right and left < box.x1 and box.y0 < high
                                 and low < box.y1, drawn[k].get_text())
            frame = axes.get_window_extent()
            self.assertTrue(frame.x0 <= box.x0 and box.x1 <= frame.x1)
            self.assertTrue(frame.y0 <= box.y0 and box.y1 <= frame.y1)
        # an error of zero stands at the floor
        self.assertEqual(list(dots[4][3]), [bench.FLOOR] * 3)

    def test_times_with_units(self):
        duration = load("bench_integral").duration
        for ns, words in ((4.87, "4.9 ns"), (21.4, "21 ns"), (0.4, "0.4 ns"), (1300.0, "1.3 µs"),
                          (30000.0, "30 µs"), (9e6, "9.0 ms")):
            self.assertEqual(duration(ns), words)

    def test_median_largest_and_order(self):
        convergence = load("convergence")
        for order in (1.0, 2.0):
            rows = convergence_rows(order)
            strips = np.array([float(row["strips"]) for row in rows])
            error = np.array([row["pmax_err"] for row in rows])
            number, median, most = convergence.summary(strips, error)
            np.testing.assert_allclose(number, [5, 9, 15, 31])
            np.testing.assert_allclose(median, 18.0 * number**-order)
            np.testing.assert_allclose(most, 36.0 * number**-order)
            axes = style.new_figure(4.0, 3.0).subplots()
            convergence.draw(axes, strips, error)
            self.assertIn(f"$p$ = {order:g}", texts(axes))
            # the triangle is of second order whatever the errors are, and above them
            corners = axes.patches[0].get_xy()
            (low, top), (high, _), (_, bottom) = corners[:3]
            self.assertAlmostEqual(math.log(bottom / top) / math.log(high / low), -2.0, places=12)
            for n, value in zip(number, most):
                if low <= n <= high:
                    self.assertGreater(bottom * (n / high) ** -2.0, value)

    def test_medians_and_slopes_of_elements(self):
        bench = load("bench_reference")
        rows = [row for row in reference_rows() if row["tolerance"] == 1e-9]
        values = {name: np.array([row[name] for row in rows], dtype=float)
                  for name in ("elements", "us", "iterations")}
        cold = np.array([k for k, row in enumerate(rows) if row["start"] == "cold"])
        run = bench.medians(cold, values)
        np.testing.assert_allclose(run["elements"], [500, 1000, 4000, 16000, 100000])
        np.testing.assert_allclose(run["us"], 1.1 * run["elements"] ** 1.2)
        self.assertEqual([list(part) for part in scales.ends(run["elements"],
                                                             bench.SLOPE_PART)],
                         [[0, 1, 2], [3, 4]])
        axes = style.new_figure(4.0, 3.0).subplots()
        bench.draw_times(axes, [("norm", "cold", 1e-9, run), ("norm", "cold", 1e-4, run)])
        self.assertEqual(axes.lines[0].get_marker(), "o")
        self.assertEqual(texts(axes), ["∝ $N^{1.20}$"] * 2)

    def test_medians_and_slopes_of_times(self):
        bench = load("bench_normal")
        rows = [row for row in normal_rows() if row["start"] == "cold"]
        values = {name: np.array([row[name] for row in rows], dtype=float)
                  for name in ("strips", "us", "iterations", "ns_per_entry")}
        run = bench.medians(np.arange(len(rows)), values)
        np.testing.assert_allclose(run["us"], 1.1 * run["strips"] ** 2)
        self.assertEqual([list(part) for part in scales.ends(run["strips"], bench.SLOPE_PART)],
                         [[0, 1, 2], [3, 4]])
        few = np.array([5.0, 9.0, 15.0])
        self.assertEqual([list(part) for part in scales.ends(few, bench.SLOPE_PART)],
                         [[0, 1, 2]])
        axes = style.new_figure(4.0, 3.0).subplots()
        bench.draw_times(axes, [("cold", run)], np.array([120.0, math.nan]))
        self.assertEqual(texts(axes), ["∝ $N^{2.0}$"] * 2 + ["FASTSIM, 50 × 50: 120 µs"])


class Scales(unittest.TestCase):
    def test_groups_keep_the_order_of_appearance(self):
        found = scales.groups(["b", "a", "b"], ["x", "x", "y"])
        self.assertEqual([(key, list(rows)) for key, rows in found],
                         [(("b", "x"), [0]), (("a", "x"), [1]), (("b", "y"), [2])])
        self.assertEqual([(key, list(rows)) for key, rows in scales.groups([2, 1, 2])],
                         [(2, [0, 2]), (1, [1])])

    def test_power(self):
        x = np.array([1.0, 2.0, 4.0, 8.0])
        self.assertAlmostEqual(scales.power(x, 3.0 * x**-2.5), -2.5, places=12)
        self.assertAlmostEqual(scales.power(x, np.array([0.0, 2.0, 4.0, np.nan])), 1.0, places=12)
        self.assertTrue(math.isnan(scales.power(x[:1], x[:1])))
        self.assertTrue(math.isnan(scales.power(x[[1, 1]], x[:2])))

    def test_labels_at_ends_give_way_to_the_first(self):
        axes = style.new_figure(4.0, 3.0).subplots()
        axes.set_ylim(0.0, 100.0)
        scales.label_ends(axes, 1.0, [(50.0, "first", "k"), (51.0, "near", "k"),
                                      (90.0, "far", "k")])
        self.assertEqual(texts(axes), ["first", "far"])
