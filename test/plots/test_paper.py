"""The paper redone: pictures with their list, and statements with verdicts that can turn."""

import csv
import io
import math
import unittest

import numpy as np

# First: it finds the plots' package.
from plot_samples import (
    AREA,
    REFERENCE_COLUMNS,
    SWEEP_COLUMNS,
    Folder,
    csv_text,
    hertz_row,
    strips_text,
    sweep_row,
)

# isort: split
from faststrip_plots import paper_figures, statements, style
from faststrip_plots.results import read_reference, read_sweep
from faststrip_plots.statements import FAILS, HOLDS, LIMITED, UNKNOWN, Limits

SHIFTS = (-2.0, -1.0, 0.0, 1.0, 2.0)
COMMANDS = ("paper", "paper_statements")
PICTURES = ["fig05_06", "fig07_08", "fig09_10", "fig11_12", "fig13_14", "fig17_20", "fig21_25",
            "fig22_26", "fig23_24"]
GAMMA, RADIUS = -0.05, 460.0
SPIN = abs(math.sin(GAMMA)) / RADIUS


def curves_text(error=0.015):
    rows = []
    for n in (0, 1, 2, 4, 5, 10):
        for step in range(-12, 9):
            L = 0.25 * step
            exact = 10.0**L / (1.0 + n * 10.0**L)
            rows.append(dict(n=n, L=L, b=10.0**L, exact=exact, published=exact * (1.0 + error),
                             rel_err=error))
    return csv_text("n,L,b,exact,published,rel_err".split(","), rows)


def creep(signs, yw):
    """Set B has the creepages of a rolling wheelset, set A those with the other sign."""
    return dict(cksi={"A": -1.0, "B": 1.0}[signs] * 1e-4 * yw, ceta=0.0, cphi_rad_per_mm=SPIN)


def sweep(signs, *changes, **ours):
    """Strips near the reference but for `ours`, Hertz 10 % off; one more method per entry."""
    rows = []
    for yw in SHIFTS:
        same = dict(creep(signs, yw), gamma_rad=GAMMA)
        off = dict(same, penetration_mm=0.055, area_mm2=1.1 * AREA, pmax_MPa=1100.0, Fx_N=1300.0,
                   Fy_N=-800.0, Mz_Nmm=1260.0, tangential_us=10.0)
        rows += [sweep_row(yw, **{**same, "Fx_N": 1003.0, "Fy_N": -503.0, "Mz_Nmm": 606.0, **ours}),
                 hertz_row(yw, **off),
                 sweep_row(yw, tangential="fastsim", **dict(same, Fx_N=1100.0))]
        rows += [sweep_row(yw, **{**same, **change}) for change in changes]
    return csv_text(SWEEP_COLUMNS, rows)


def reference(signs):
    columns = REFERENCE_COLUMNS + ["cksi", "ceta", "cphi_rad_per_mm", "cpu_norm_s", "cpu_total_s",
                                   "r_wheel_mm"]
    rows = [dict(yw_mm=yw, Fn_N=10000.0, penetration_mm=0.05, area_extrap_mm2=repr(AREA),
                 pmax_MPa=1000.0, Fx_extrap_N=1000.0, Fy_extrap_N=-500.0, Mz_extrap_Nmm=600.0,
                 cpu_norm_s=0.2, cpu_total_s=4.0, r_wheel_mm=RADIUS, **creep(signs, yw))
            for yw in SHIFTS]
    return csv_text(columns, rows, f"# full CONTACT; sign set {signs}\n")


def audit(**changes):
    row = dict(n=1, max_rel_err=0.004, rms_rel_err=0.002, residual_max=1e-4, misprint="no",
               rel_err_below=-0.6, rel_err_above=-0.8)
    return csv_text(list(row), [dict(row, n=0), dict(row, **changes)])


def errata():
    rows = [
        ("(6) (9) (17)-(20)", "load at 0 mm", -0.4), ("(6) (9) (17)-(20)", "pressure", 40.0),
        ("(12)", "i", 9.0), ("(22)-(24)", "i", -0.4), ("(30) (42) (46)", "Tx", 0.002),
        ("(31)", "force with 55 points", 0.0003), ("(34)", "C11", 0.05), ("(41)", "C11", 15.0),
        ("(44)", "Mz", ""),
    ]
    return csv_text(("equation", "what", "deviation"),
                    [dict(zip(("equation", "what", "deviation"), row)) for row in rows])


def table2():
    rows = [dict(yw_mm=yw, Fn_N=1e5 / math.cos(GAMMA), tan_gamma=math.tan(GAMMA), gamma_rad=GAMMA,
                 Sx=creep("A", yw)["cksi"], Phi_rad_per_mm=SPIN) for yw in SHIFTS]
    return csv_text(list(rows[0]), rows, "# Table 2\n")


def bench_normal():
    return csv_text(("start", "strips", "us"), [
        dict(start=start, strips=strips, us=us)
        for start, us in (("cold", 1000.0), ("warm_shift", 500.0)) for strips in (5, 15)
    ])


def bench_integral(closed=1e-16):
    return csv_text(("method", "loop", "ns", "rel_err"), [
        dict(method=method, loop="scalar", ns=ns, rel_err=error)
        for method, ns, error in (("published", 20.0, 0.01), ("closed", 18.0, closed),
                                  ("gsl 1-D", 9000.0, 0.0))
    ])


# the paper's own method, twice as far off in Fx as FASTSIM on the strips, and in the rest 10 %
PRINTED = dict(tangential="faststrip-paper", Fx_N=1200.0, Fy_N=-530.0, Mz_Nmm=666.0,
               tangential_us=300.0)
FILES = {
    "out/paper/curves.csv": curves_text(),
    "out/paper/audit.csv": audit(max_rel_err=0.02, residual_max=2e-3),
    "out/paper/errata.csv": errata(),
    "out/paper/sweep_A.csv": sweep("A"),
    "out/paper/sweep_B.csv": sweep("B"),
    "out/paper/sweep_fine.csv": sweep("B"),
    "out/paper/bench_integral.csv": bench_integral(),
    "out/paper/bench_normal.csv": bench_normal(),
    "reference/contact/s1002_uic60_A.csv": reference("A"),
    "reference/contact/s1002_uic60_B.csv": reference("B"),
    "reference/paper/table2.csv": table2(),
}


def judge(*arguments, more=(), **files):
    """Rows of the list by id, with some files of out/paper changed and `more` of any name."""
    changed = {f"out/paper/{name}.csv": text for name, text in files.items()} | dict(more)
    with Folder({**FILES, **changed}) as folder:
        status, out, err = folder.run("paper_statements", *arguments)
        if (status, err) != (0, ""):
            raise AssertionError(err)
        text = (folder.path / "out/paper/paper_statements.csv").read_text(encoding="utf-8")
    rows = list(csv.DictReader(io.StringIO(text)))
    assert len({row["id"] for row in rows}) == len(rows), "an id twice"
    assert f"{len(rows)} rows" in out
    return {row["id"]: row for row in rows}


class Pictures(unittest.TestCase):
    def test_all_are_drawn_twice_over_and_listed(self):
        with Folder(FILES) as folder:
            status, out, err = folder.run("paper", "--folder", "p")
            self.assertEqual((status, err), (0, ""))
            with open(folder.path / "p/figures.csv", encoding="utf-8") as stream:
                rows = list(csv.DictReader(stream))
            self.assertEqual([row["file"] for row in rows], [f"{n}.png" for n in PICTURES])
            for row in rows:
                self.assertEqual(list(row), ["file", "title", "caption", "chapter"])
                self.assertTrue(all(row.values()))
                picture = folder.path / "p" / row["file"]
                self.assertEqual(picture.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
                self.assertIn("<svg", picture.with_suffix(".svg").read_text(encoding="utf-8"))
                self.assertIn(f"p/{row['file']}", out)
            captions = {row["file"]: row["caption"] for row in rows}
            self.assertIn("1.5 % at most", captions["fig07_08.png"])
            self.assertIn("Hertz 10 %, 10 %, 10 %", captions["fig17_20.png"])
            self.assertIn("sign set A", captions["fig21_25.png"])
            self.assertIn("in percent of mu N:", captions["fig21_25.png"])
            self.assertIn("in percent of mu N c:", captions["fig23_24.png"])
            self.assertIn("strips + FASTSTRIP 0.1 %", captions["fig22_26.png"])
            self.assertIn("Hertz + FASTSIM 10 %", captions["fig22_26.png"])

    def test_the_same_picture_gives_the_same_svg(self):
        texts = []
        for name in ("a.png", "b.png"):
            with Folder({}) as folder:
                figure = style.new_figure(3.0, 2.0)
                figure.subplots().plot([0.0, 1.0], [0.0, 1.0])
                style.save(figure, str(folder.path / name), ["x"], vector=name == "a.png")
                svg = (folder.path / name).with_suffix(".svg")
                self.assertEqual(svg.exists(), name == "a.png")
                figure = style.new_figure(3.0, 2.0)
                figure.subplots().plot([0.0, 1.0], [0.0, 1.0])
                style.save(figure, str(folder.path / "c.png"), ["x"], vector=True)
                texts.append((folder.path / "c.svg").read_bytes())
        self.assertEqual(*texts)

    def test_lines_are_broken_at_jumps(self):
        x, y = paper_figures.broken(np.arange(4.0), np.array([1.0, 1.1, 2.0, 2.1]))
        self.assertEqual(list(np.flatnonzero(np.isnan(y))), [2])
        self.assertTrue(np.isnan(x[2]))
        self.assertEqual(list(y[~np.isnan(y)]), [1.0, 1.1, 2.0, 2.1])

    def test_axis_of_ratios_is_as_narrow_as_it_can_be(self):
        for ratio, span in ((1.05, 0.1), (0.8, 0.25), (1.4, 0.5), (0.1, 1.0)):
            axes = style.new_figure(3.0, 2.0).subplots()
            axes.plot([0.0, 1.0, 2.0], [1.0, ratio, np.nan])
            paper_figures.fit_ratios(axes)
            self.assertEqual(axes.get_ylim(), (1.0 - span, 1.0 + span))


    def test_what_is_compared_with_is_called_what_it_is(self):
        """Reference symbols, axes and titles name CONTACT; NORM and TANG are this project's."""
        with Folder(FILES) as folder:
            path = str(folder.path / "out/paper/sweep_A.csv")
            found = read_sweep(path)
            contact = read_reference(str(folder.path / "reference/contact/s1002_uic60_A.csv"))
            pictures = [paper_figures.normal_picture(found, contact, 0.3),
                        *paper_figures.force_pictures(found, contact, 0.3, "A")]
        for picture in pictures:
            ratios = [axes for axes in picture.figure.axes if "over" in axes.get_ylabel()]
            self.assertEqual(len(ratios), 1)
            for axes in picture.figure.axes:
                words = axes.get_title(loc="left") + picture.title + picture.caption
                self.assertNotIn("NORM", words)
                self.assertNotIn("TANG", words)
            self.assertIn("over CONTACT's", ratios[0].get_title(loc="left"))
            self.assertIn("over CONTACT's", ratios[0].get_ylabel())


class BadInput(unittest.TestCase):
    def refused(self, command, files, words):
        with Folder({**FILES, **files}) as folder:
            folder.refused(self, words, command)

    def test_creepages_of_the_other_sign_set(self):
        for command in COMMANDS:
            self.refused(command, {"out/paper/sweep_A.csv": sweep("B")},
                         "cksi at shift -2 must be the reference's, 0.0002, got -0.0002"
                         " (out/paper/sweep_A.csv:4, reference/contact/s1002_uic60_A.csv)")

    def test_missing_columns(self):
        for command, name, column in (
            ("paper", "out/paper/curves.csv", "published"),
            ("paper", "out/paper/sweep_A.csv", "ceta"),
            ("paper_statements", "out/paper/audit.csv", "rms_rel_err"),
            ("paper_statements", "out/paper/errata.csv", "deviation"),
            ("paper_statements", "out/paper/bench_normal.csv", "strips"),
            ("paper_statements", "out/paper/sweep_fine.csv", "gamma_rad"),
            ("paper_statements", "reference/paper/table2.csv", "Sx"),
            ("paper_statements", "reference/contact/s1002_uic60_A.csv", "cpu_total_s"),
        ):
            with self.subTest(command=command, column=column):
                self.refused(command, {name: FILES[name].replace(column, "other")},
                             f"missing column: {column} ({name}:")


class Verdicts(unittest.TestCase):
    def test_limits(self):
        least = Limits(10.0, 2.0, least=True)
        for value, word in ((12.0, HOLDS), (10.0, HOLDS), (5.0, LIMITED), (1.0, FAILS)):
            self.assertEqual(least.verdict(value), word)
        most = Limits(1.0, 5.0)
        for value, word in ((1.0, HOLDS), (1.1, LIMITED), (5.1, FAILS)):
            self.assertEqual(most.verdict(value), word)
        self.assertEqual(Limits(1.0).verdict(1.1), FAILS)
        self.assertEqual(most.words("%"), "at most 1 %; with a limit at most 5 %")

    def test_roughness_sees_scatter_and_no_smooth_curve(self):
        x = np.linspace(1.0, 2.0, 11)
        rough = statements.roughness(x**3)
        self.assertTrue(np.isnan(rough[[0, 1, -2, -1]]).all())
        self.assertLess(rough[2:-2].max(), 1e-12)
        values = np.ones(11)
        values[5] = 1.02
        self.assertAlmostEqual(statements.roughness(values)[5], 0.02 / 1.02)

    def test_every_statement_on_the_samples(self):
        rows = judge()
        expected = dict(
            I1=FAILS, I2=HOLDS, T1=FAILS, T2=LIMITED, T3=FAILS, T4=UNKNOWN, I3=FAILS, N0=FAILS,
            N1=HOLDS, N2=HOLDS, N3=HOLDS, N4=HOLDS, N5=HOLDS, N6=HOLDS, N7=HOLDS, N8=HOLDS,
            N9=UNKNOWN,
            N10=UNKNOWN, N11=UNKNOWN, F1=HOLDS, F2=HOLDS, F3=HOLDS, F4=HOLDS, F5=HOLDS, F6=FAILS,
            S1=FAILS, S2=HOLDS, E1=FAILS, E2=FAILS, E3=HOLDS, E4=HOLDS, E5=LIMITED,
            E6=FAILS, E7=UNKNOWN, E8=UNKNOWN,
        )
        # the sweeps of the samples have this project's FASTSTRIP only, which nothing is judged on
        for method in ("faststrip-paper", "faststrip-corrected"):
            for signs in "AB":
                expected[f"C.{signs}.{method}"] = UNKNOWN
                for rival in ("strip", "hertz"):
                    for name in ("Tx", "Ty", "Mz"):
                        expected[f"C.{signs}.{method}.{rival}.{name}"] = UNKNOWN
            for kind in ("S3.usual", "S3.equal", "S4"):
                expected[f"{kind}.{method}"] = UNKNOWN
        got = {key: row["verdict"] for key, row in rows.items()}
        self.assertEqual(sorted(set(got.items()) ^ set(expected.items())), [])
        for row in rows.values():
            self.assertEqual(row["value"] == "", row["verdict"] == UNKNOWN, row)
            for name in ("place", "statement", "subject", "quantity", "criterion", "source"):
                self.assertTrue(row[name], row)

    def test_the_narrow_list_is_announced_and_reads_alike(self):
        with Folder(FILES) as folder:
            status, _, err = folder.run("paper_statements", "-o", "p/s.csv")
            self.assertEqual((status, err), (0, ""))
            whole, narrow, tables = (
                list(csv.DictReader(io.StringIO((folder.path / "p" / name).read_text("utf-8"))))
                for name in ("s.csv", "s_short.csv", "tables.csv"))
        self.assertEqual([(row["file"], row["chapter"]) for row in tables],
                         [("s_short.csv", "paper")])
        self.assertEqual([row["verdict"] for row in whole], [row["verdict"] for row in narrow])
        measured = {row["id"]: row["measured"] for row in narrow}
        self.assertEqual(measured["T2"], "2 %, largest relative error")
        self.assertEqual(measured["N9"], "")

    def test_figures_are_those_of_the_samples(self):
        rows = judge()
        for key, value in (
            ("I2", 450.0), ("N0", 5.0 / 3.0), ("T2", 2.0), ("T3", 50.0), ("N7", 1.0),
            ("N8", 200.0), ("E1", 40.0), ("S1", 11.0), ("N4", 100.0), ("F6", 0.0),
        ):
            self.assertAlmostEqual(float(rows[key]["value"]), value, places=4, msg=key)

    def test_figures_of_the_papers_own_method(self):
        """Against FASTSIM on the same strips and on the Hertz ellipse, from files of their own."""
        extra = {f"out/paper/{name}_more.csv": sweep(signs, PRINTED)
                 for name, signs in (("sweep_A", "A"), ("sweep_B", "B"), ("sweep_fine", "B"))}
        rows = judge("--sweep-a", "out/paper/sweep_A.csv", "out/paper/sweep_A_more.csv",
                     "--sweep-b", "out/paper/sweep_B.csv", "out/paper/sweep_B_more.csv",
                     "--fine", "out/paper/sweep_fine.csv", "out/paper/sweep_fine_more.csv",
                     more=extra)
        for signs in "AB":
            for key, value, verdict in (
                ("strip.Tx", 2.0, FAILS), ("hertz.Tx", 200.0 / 300.0, HOLDS),
                ("hertz.Ty", 0.1, HOLDS), ("hertz.Mz", 66.0 / 660.0, HOLDS),
            ):
                row = rows[f"C.{signs}.faststrip-paper.{key}"]
                self.assertAlmostEqual(float(row["value"]), value, places=4, msg=key)
                self.assertEqual(row["verdict"], verdict)
                self.assertIn("as printed over", row["subject"])
                self.assertIn(f"set {signs}", row["subject"])
            row = rows[f"C.{signs}.faststrip-paper.strip.Tx"]
            self.assertIn("6.67 over 3.33 % of mu N", row["quantity"])
            self.assertIn("not judged: this project's FASTSTRIP, 0.1 and 0.1", row["detail"])
            self.assertEqual(rows[f"C.{signs}.faststrip-paper"]["verdict"], LIMITED)
            self.assertEqual(rows[f"C.{signs}.faststrip-corrected.strip.Tx"]["verdict"], UNKNOWN)
        self.assertEqual(rows["S3.usual.faststrip-paper"]["verdict"], FAILS)
        self.assertAlmostEqual(float(rows["S4.faststrip-paper"]["value"]), 4e6 / 800.0, places=1)

    def test_nothing_is_judged_on_this_projects_own_method(self):
        """However good or bad it is, no verdict and no figure turns."""
        names = [name for name in statements.COLUMNS if name != "detail"]
        found = []
        for fx in (1000.0, 1600.0):
            rows = judge(sweep_A=sweep("A", PRINTED, Fx_N=fx, tangential_us=9.0 * fx),
                         sweep_B=sweep("B", PRINTED, Fx_N=fx, tangential_us=9.0 * fx),
                         sweep_fine=sweep("B", PRINTED, Fx_N=fx, tangential_us=9.0 * fx))
            found.append([[row[name] for name in names] for row in rows.values()])
            self.assertEqual(rows["C.A.faststrip-paper.strip.Tx"]["verdict"], FAILS)
        self.assertEqual(*found)

    def test_errors_turn_verdicts(self):
        for off, word in ((1.03, LIMITED), (1.10, FAILS)):
            row = judge(sweep_A=sweep("A", penetration_mm=0.05 * off))["N1"]
            self.assertEqual(row["verdict"], word)
            self.assertAlmostEqual(float(row["value"]), 100.0 * (off - 1.0), places=4)

    def test_a_method_worse_than_fastsim_is_called_so(self):
        change = dict(PRINTED, Fx_N=1600.0)
        rows = judge(sweep_B=sweep("B", change))
        row = rows["C.B.faststrip-paper.hertz.Tx"]
        self.assertEqual((row["verdict"], float(row["value"])), (FAILS, 2.0))
        row = rows["C.B.faststrip-paper.strip.Tx"]
        self.assertEqual((row["verdict"], float(row["value"])), (FAILS, 6.0))

    def test_only_the_mean_below_fastsim(self):
        lines = sweep("B", PRINTED).splitlines()
        lines[6] = lines[6].replace("1200.0", "1400.0")
        row = judge(sweep_B="\n".join(lines) + "\n")["C.B.faststrip-paper.hertz.Tx"]
        self.assertEqual(row["verdict"], LIMITED)

    def test_times_of_the_variational_method_where_given(self):
        columns = ("method", "start", "tolerance", "elements", "us")
        with_reference = csv_text(columns, [
            dict(zip(columns, cells)) for cells in (
                ("norm", "cold", 1e-9, 3700, 2e5), ("norm", "strips", 1e-9, 3650, 5e4),
                # neither another tolerance nor another number of elements, nor rolling
                ("norm", "cold", 1e-4, 3700, 1.0), ("norm", "cold", 1e-9, 500, 1.0),
                ("norm", "strips", 1e-9, 7500, 1.0), ("tang", "cold", 1e-7, 3700, 7e4),
            )])
        rows = judge("--bench-reference", "out/paper/reference.csv", reference=with_reference)
        self.assertEqual([rows[key]["verdict"] for key in ("N9", "N10", "N11")],
                         [HOLDS, LIMITED, LIMITED])
        self.assertEqual([float(rows[key]["value"]) for key in ("N9", "N10", "N11")],
                         [200.0, 50.0, 4.0])
        self.assertIn("TANG 70 ms", rows["N9"]["detail"])

    def test_range_of_strips(self):
        row = judge("--strips", "out/paper/strips.csv", strips=strips_text())["T4"]
        self.assertEqual((row["verdict"], float(row["value"])), (HOLDS, 100.0))
        # the two end strips of five become a hundred times as short
        wide = strips_text().replace(",0.89999", ",0.00899")
        row = judge("--strips", "out/paper/strips.csv", strips=wide)["T4"]
        self.assertEqual((row["verdict"], float(row["value"])), (FAILS, 60.0))

    def test_signs_of_the_motion_hold(self):
        rows = [dict(yw_mm=yw, Fn_N=1e5, tan_gamma=0.0, gamma_rad=0.0, Phi_rad_per_mm=SPIN,
                     Sx=creep("B", yw)["cksi"]) for yw in SHIFTS]
        text = csv_text(list(rows[0]), rows)
        with Folder({**FILES, "t.csv": text}) as folder:
            status, _, err = folder.run("paper_statements", "--table2", "t.csv", "-o", "s.csv")
            self.assertEqual((status, err), (0, ""))
            verdicts = {row["id"]: row["verdict"] for row in csv.DictReader(
                io.StringIO((folder.path / "s.csv").read_text(encoding="utf-8")))}
        self.assertEqual(verdicts["F6"], HOLDS)
        self.assertEqual(verdicts["F4"], FAILS)
        self.assertEqual(verdicts["F1"], HOLDS)
