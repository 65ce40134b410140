"""The page of faststrip-explore: what stands behind it, and in a browser without a screen."""

import contextlib
import csv
import dataclasses
import importlib.util
import io
import os
import socket
import subprocess
import sys
import time
import unittest
import urllib.request
import xml.etree.ElementTree
import zipfile

import numpy as np

from installed import ROOT, HostTest, page_in_browser

MISSING = [name for name in ("bokeh", "f90nml", "selenium") if not importlib.util.find_spec(name)]
NO_PAGE = (f"{', '.join(MISSING)} not installed: tools/requirements-explore.txt" if MISSING else "")
NO_BROWSER = NO_PAGE or ("" if page_in_browser.BROWSER and page_in_browser.DRIVER
                         else "no chromium with chromium-driver")
BAD = ("header.begin\ntype = 1\nheader.end\nspline.begin\npoint.begin\n1 2\n3 x\npoint.end\n"
       "spline.end\n")


def wheel_rows(last):
    """A wheel from -40 mm to a quarter of `last`."""
    return "".join(f"{y / 4} {-(y / 4) ** 2 / 2000}\n" for y in range(-160, last + 1))


def wheel_text(last):
    return ("header.begin\ntype = 1\nheader.end\nspline.begin\npoint.begin\n"
            + wheel_rows(last) + "point.end\nspline.end\n")


WHEEL = wheel_text(160)
FIGURES = ("penetration_mm", "area_mm2", "pmax_MPa", "Fx_N", "Fy_N", "Mz_Nmm", "est_err_pmax",
           "est_err_Fx", "N_N")


def rows_of(text):
    return list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))


class ExploreTest(HostTest):
    """Tests with the package of the checkout on the installed library and program."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.faststrip = cls.import_package()
        cls.environment = {**cls.installed.environment, "PYTHONPATH": str(ROOT / "python")}
        os.environ["FASTSTRIP_PREFIX"] = str(cls.installed.prefix)
        cls.addClassCleanup(os.environ.pop, "FASTSTRIP_PREFIX", None)

    @classmethod
    def part(cls, name):
        """A module of the page."""
        return importlib.import_module(f"faststrip.explore.{name}")

    def solved_by_program(self, files):
        """The row that the program gives for a case of the page."""
        for name, content in files.items():
            (self.folder / name).write_bytes(content)
        self.shell(f"{self.installed.prefix}/bin/faststrip contact explore.nml -o explore_row.csv")
        return rows_of((self.folder / "explore_row.csv").read_text(encoding="utf-8"))[0]

    def agree(self, ours, theirs):
        for name in FIGURES:
            expected = float(theirs[name])
            self.assertAlmostEqual(float(ours[name]), expected, delta=1e-12 * abs(expected),
                                   msg=name)
        self.assertEqual(ours["status"], theirs["status"])


class Behind(ExploreTest):
    def test_an_exported_case_gives_the_same_numbers(self):
        case, exporting = self.part("case"), self.part("exporting")
        solver = self.part("solving").Solver()
        wheel = case.read_shape("wheel", "it's a wheel.prw", WHEEL.encode())
        for changes in ({}, {"shift": 4.3, "cphi": 2e-4, "mu": 0.45}, {"yaw": 7e-3, "load": 7e4},
                        {"wheel": wheel, "load": 5e4, "is_vertical": False},
                        {"rail": case.STANDARD["rail"]["60e1"], "given_inclination": 0.05},
                        {"roller_radius": 500.0, "shift": 2.0}, {"is_curved": True, "shift": 6.0},
                        {"roller_radius": 400.0, "yaw": 5e-3},
                        {"is_curved": True, "shift": 5.5, "yaw": 0.01},
                        {"shift": 6.5, "yaw": 3e-3}):
            with self.subTest(changes=list(changes)):
                outcome = solver.solve(dataclasses.replace(case.Case(), **changes))
                ours = rows_of(exporting.numbers_csv(outcome))
                self.assertEqual([row["normal"] for row in ours], ["strip", "hertz"])
                files = exporting.case_files(outcome)
                self.agree(ours[0], self.solved_by_program(files))
                name, content = exporting.packed(files)
                self.assertEqual(name, "explore.zip" if len(files) > 1 else "explore.nml")
                if len(files) > 1:
                    with zipfile.ZipFile(io.BytesIO(content)) as archive:
                        self.assertEqual(set(archive.namelist()), set(files))

    def test_files_of_one_name_are_both_saved(self):
        case, exporting = self.part("case"), self.part("exporting")
        rail = "".join(f"{36 * np.sin(a / 100)} {36 - 36 * np.cos(a / 100)}\n"
                       for a in range(-150, 151))
        shapes = {"wheel": case.read_shape("wheel", "one.txt", wheel_rows(160).encode()),
                  "rail": case.read_shape("rail", "one.txt", rail.encode())}
        outcome = self.part("solving").Solver().solve(case.Case(**shapes))
        files = exporting.case_files(outcome)
        self.assertEqual(set(files), {"explore.nml", "one.txt", "rail_one.txt"})
        self.agree(rows_of(exporting.numbers_csv(outcome))[0], self.solved_by_program(files))
        named = dataclasses.replace(shapes["wheel"], label="s1002")
        outcome = self.part("solving").Solver().solve(case.Case(wheel=named))
        self.assertIn("wheel_s1002", exporting.case_files(outcome))

    def test_norm_and_tang_are_the_programs(self):
        case, exporting = self.part("case"), self.part("exporting")
        outcome = self.part("solving").Solver().solve(case.Case())
        found = exporting.Program().reference(exporting.case_files(outcome))
        strips = outcome.answers["strips"].result
        self.assertAlmostEqual(found.answer.result.pmax / strips.pmax, 1.0, delta=0.05)
        self.assertAlmostEqual(found.pressure.max() / strips.pmax, 1.0, delta=0.05)
        self.assertAlmostEqual(found.x_last.max() / strips.x_max, 1.0, delta=0.1)
        self.assertAlmostEqual(found.y[-1] - found.y[0], strips.y_max - strips.y_min, delta=0.6)
        self.assertGreater(found.seconds, 0.0)
        with self.assertRaisesRegex(RuntimeError, "unknown name|cannot|must"):
            exporting.Program().reference({"explore.nml": b"&contact nonsense = 1 /\n"})
        os.environ["FASTSTRIP_PROGRAM"] = "/nowhere/faststrip"
        self.addCleanup(os.environ.pop, "FASTSTRIP_PROGRAM", None)
        with self.assertRaisesRegex(ImportError, "no program faststrip: .*FASTSTRIP_PROGRAM"):
            exporting.Program().reference(exporting.case_files(outcome))

    def test_marks_do_not_cover_each_other(self):
        figures = self.part("figures")
        angle = np.linspace(0.0, np.pi, 500)
        x, y = np.cos(angle), np.sin(angle)
        few = figures.marked(x, y)
        self.assertEqual(few[0], 0)
        apart = np.hypot(0.5 * figures.WIDTH * np.diff(x[few]),
                         0.5 * figures.HEIGHT * np.diff(y[few]))
        self.assertGreaterEqual(apart.min(), figures.APART)
        self.assertLess(apart.max(), 1.3 * figures.APART)
        self.assertEqual(figures.marked(x[:0], y[:0]), [])

    def test_only_what_has_changed_is_solved(self):
        case = self.part("case").Case()
        solver = self.part("solving").Solver()
        first = solver.solve(case)
        surveys = list(solver.survey(case, "cksi"))
        self.assertEqual([one.pressure is None for one in surveys], [True, False, False])
        survey = surveys[-1]
        for changes, same in (({}, ("curve", "pressure", "part")),
                              ({"cksi": 2e-3}, ("curve", "pressure", "part")),
                              ({"ceta": 2e-3}, ("pressure", "part")), ({"load": 9e4}, ()),
                              ({"shift": 1.0}, ("pressure",)), ({"yield_shear": 90.0},
                                                                ("curve", "pressure", "part"))):
            still = survey.still(dataclasses.replace(case, **changes), "cksi")
            for name in ("curve", "pressure", "part"):
                self.assertEqual(getattr(still, name) is not None, name in same, (changes, name))
        for changes, same in (({}, ("gap", "strips")), ({"cksi": 2e-3}, ("gap",)),
                              ({"ceta": 2e-3}, ("gap",)), ({"load": 9e4}, ("gap",)),
                              ({"shift": 1.0}, ())):
            second = solver.solve(dataclasses.replace(case, **changes))
            self.assertEqual(second.geometry.gap is first.geometry.gap, "gap" in same, changes)
            self.assertEqual(second.answers["strips"] is first.answers["strips"],
                             "strips" in same, changes)
            solver.solve(case)
            first = solver.solve(case)

    def test_forces_lie_on_their_curve(self):
        case = self.part("case").Case()
        for axis, force in (("cksi", "fx"), ("ceta", "fy"), ("cphi", "fy")):
            solver = self.part("solving").Solver()
            outcome, found = solver.solve(case, axis), next(solver.survey(case, axis)).curve
            for name, answer in outcome.answers.items():
                curve = getattr(found, force)[name]
                there = np.interp(getattr(case, axis), found.creepage, curve)
                value = getattr(answer.result, force) / (case.mu * answer.result.load)
                self.assertAlmostEqual(there, value, delta=0.01, msg=(axis, name))

    def test_errors_are_one_line(self):
        case = self.part("case")
        solver = self.part("solving").Solver()
        for changes, text in (({"shift": 200.0}, "no_contact"), ({"yaw": 0.6}, "yaw"),
                              ({"yaw": 1e-3, "is_vertical": False}, "vertical load"),
                              ({"shift": 200.0, "yaw": 1e-3}, "")):
            outcome = solver.solve(dataclasses.replace(case.Case(), **changes))
            self.assertIn(text, outcome.error)
            self.assertEqual((outcome.geometry, len(outcome.error.splitlines())), (None, 1))
        for kind, name, content, text in (
                ("wheel", "bad.prw", BAD.encode(), r"\(bad\.prw:7\)"),
                ("rail", "empty.txt", b"", r"empty\.txt"),
                ("rail", "../", b"1 2\n", "empty|must|txt|point")):
            with self.assertRaisesRegex(case.CaseError, text) as caught:
                case.read_shape(kind, name, content)
            self.assertNotIn("\n", str(caught.exception))
            self.assertNotIn("/tmp", str(caught.exception))
        with self.assertRaisesRegex(case.CaseError, "s1002, cone20, cone40 or a file, got s1003"):
            case.find_shape("wheel", "s1003")

    def test_what_is_drawn_of_elements(self):
        fields = self.part("fields")
        outcome = self.part("solving").Solver().solve(self.part("case").Case())
        for name, answer in outcome.answers.items():
            runs = fields.runs(answer.elements)
            area = ((runs["right"] - runs["left"]) * (runs["top"] - runs["bottom"])).sum()
            self.assertAlmostEqual(area / answer.elements.area.sum(), 1.0, delta=1e-9, msg=name)
            sticking = runs["state"] == fields.ADHESION
            stick = ((runs["right"] - runs["left"]) * (runs["top"] - runs["bottom"]))[sticking]
            elements = answer.elements
            expected = elements.area[elements.state == fields.ADHESION].sum()
            self.assertAlmostEqual(stick.sum() / expected, 1.0, delta=1e-9, msg=name)
            border = fields.borders(runs)
            self.assertEqual(sorted(border), ["x0", "x1", "y0", "y1"])
            # Adhesion ahead, slip behind: one border in a row that has both.
            self.assertGreater(len(border["x0"]), 8)
            arrows = fields.arrows(answer.elements, 300.0, 22.0, (0.1, 0.1))
            self.assertLess(len(arrows["x0"]), 450)
            middle = int(np.argmax(np.hypot(arrows["x1"] - arrows["x0"],
                                            arrows["y1"] - arrows["y0"])))
            # Forces oppose the creepages, which are above zero.
            self.assertLess(arrows["y1"][middle], arrows["y0"][middle])
            self.assertLess(arrows["x1"][middle], arrows["x0"][middle])
        empty = self.faststrip.Elements(*[np.empty(0)] * 9)
        self.assertEqual(len(fields.runs(empty)["left"]), 0)
        self.assertEqual(len(fields.arrows(empty, 1.0, 1.0, (1.0, 1.0))["x0"]), 0)


@unittest.skipIf(NO_PAGE, NO_PAGE)
class Command(ExploreTest):
    def explore(self, *words, **environment):
        return subprocess.run([sys.executable, "-m", "faststrip.explore", *words],
                              cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True,
                              encoding="utf-8", env={**self.environment, **environment},
                              timeout=page_in_browser.PATIENCE, check=False)

    def explore_here(self, *words):
        """The same without a process of its own, which takes a second."""
        out, err = io.StringIO(), io.StringIO()
        with contextlib.chdir(self.folder), contextlib.redirect_stdout(out), \
                contextlib.redirect_stderr(err):
            code = self.part("server").main(list(words))
        return subprocess.CompletedProcess(words, code, out.getvalue(), err.getvalue())

    def test_bad_words_are_one_line(self):
        self.write("strange.nml", "&contact load_N = 1e5 /\n&wheel profile = 's1002' /\n"
                   "&rail profile = '60e1', gauge_mm = 1000.0 /\n")
        self.write("falling.nml", "&wheel profile = 's1002' /\n&rail profile = '60e1' /\n"
                   "&friction kind = 'linear' /\n")
        self.write("bad.prw", BAD)
        for words, text in ((["--case", "none.nml"], "No such file or directory: none.nml"),
                            (["--case", "strange.nml"], "gauge_mm of &rail must be 1435.0"),
                            (["--case", "falling.nml"], "kind of &friction cannot be shown"),
                            (["--wheel", "bad.prw"], "(bad.prw:7)"),
                            (["none.nml"], "No such file or directory: none.nml"),
                            (["strange.nml"], "gauge_mm of &rail must be 1435.0"),
                            (["none.prw", "60e1"], "a file, got none.prw (No such file"),
                            (["bad.prw", "60e1"], "(bad.prw:7)"),
                            (["bad.prw"], "one file alone must be a case file"),
                            (["a.prw", "b.prr", "c.prr"], "got 3 files: a.prw b.prr c.prr"),
                            (["a.prw", "b.prr", "--rail", "60e1"], "--rail must not be given"),
                            (["--port", "70000"], "faststrip-explore: 127.0.0.1:70000")):
            # A process each for the first and the last, which changes what its process logs.
            is_alone = words[0] == "--port" or "none.nml" in words[1:]
            call = self.explore if is_alone else self.explore_here
            done = call("--no-browser", *words)
            self.assertEqual((done.returncode, done.stdout), (1, ""), words)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertIn(text, done.stderr)
        done = self.explore("--help")
        self.assertEqual(done.returncode, 0)
        for word in ("--wheel", "--rail", "--case", "--port", "--no-browser", "127.0.0.1"):
            self.assertIn(word, done.stdout)

    def test_without_bokeh_it_says_what_to_install(self):
        for name in ("bokeh", "f90nml"):
            self.write(f"{name}.py", f"raise ModuleNotFoundError('no {name}', name='{name}')\n")
            done = self.explore(PYTHONPATH=f"{self.folder}:{ROOT / 'python'}")
            (self.folder / f"{name}.py").unlink()
            self.assertEqual((done.returncode, done.stdout, len(done.stderr.splitlines())),
                             (1, "", 1))
            self.assertIn(f"{name} is missing: pip install 'faststrip[explore]'", done.stderr)

    def test_case_files_of_the_examples(self):
        casefile = self.part("casefile")
        case = casefile.read_case(str(ROOT / "example" / "s1002_uic60.nml"))
        self.assertEqual((case.wheel.label, case.rail.label, case.load, case.mu),
                         ("s1002", "uic60", 1e5, 0.3))
        self.assertEqual((case.is_vertical, case.inclination), (False, 0.025))
        exporting = self.part("exporting")
        outcome = self.part("solving").Solver().solve(case)
        self.write("again.nml", exporting.case_files(outcome)["explore.nml"].decode())
        self.assertEqual(casefile.read_case(str(self.folder / "again.nml")), case)
        case = dataclasses.replace(case, roller_radius=350.0, is_curved=True)
        outcome = self.part("solving").Solver().solve(case)
        self.write("again.nml", exporting.case_files(outcome)["explore.nml"].decode())
        self.assertEqual(casefile.read_case(str(self.folder / "again.nml")), case)


class InBrowser(ExploreTest):
    """Tests with a page that is served, and shown by a browser."""

    before = ""  # what Python does at its start where it is served

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        if cls.before:
            cls.write("sitecustomize.py", cls.before)
            cls.environment["PYTHONPATH"] = f"{cls.folder}:{cls.environment['PYTHONPATH']}"
        cls.write("bad.prw", BAD)
        cls.write("wheel.prw", WHEEL)
        cls.downloads = cls.folder / "downloads"
        cls.downloads.mkdir()
        cls.served = page_in_browser.Served(cls.environment, cls.folder,
                                            *cls.words_of_start())
        cls.addClassCleanup(cls.served.end)
        cls.browser = page_in_browser.start_browser(cls.downloads)
        cls.addClassCleanup(cls.browser.quit)
        cls.browser.get(cls.served.address)
        cls.wait(lambda: cls.browser.execute_script(
            "return window.Bokeh?.documents?.[0]?.is_idle === true"), "the page is shown")

    @classmethod
    def words_of_start(cls):
        """What is served."""
        return []

    @classmethod
    def wait(cls, is_so, what):
        end = time.monotonic() + page_in_browser.PATIENCE
        while not is_so():
            if time.monotonic() > end:
                raise AssertionError(f"it did not come so far: {what}")
            time.sleep(0.05)

    def model(self, name, what):
        return self.browser.execute_script(
            f"return Bokeh.documents[0].get_model_by_name(arguments[0]).{what}", name)

    def element(self, name, selector):
        return self.browser.execute_script(
            "return Bokeh.index.find_one_by_id(Bokeh.documents[0].get_model_by_name(arguments[0])"
            ".id).shadow_el.querySelector(arguments[1])", name, selector)

    def words(self, name):
        """What an element says; it may be replaced at any time."""
        return self.browser.execute_script(
            "return Bokeh.index.find_one_by_id(Bokeh.documents[0].get_model_by_name(arguments[0])"
            ".id).shadow_el.querySelector('.put').innerText", name)

    def status(self):
        return self.words("status")

    def columns(self, name):
        return self.browser.execute_script(
            "return Object.fromEntries(Object.entries(Bokeh.documents[0]"
            ".get_model_by_name(arguments[0]).data).map(([key, list]) => [key, [...list]]))", name)

    def set(self, name, value):
        """Move a slider as the mouse does; wait until the pictures have followed."""
        self.browser.execute_async_script("""
            const [name, value, done] = arguments
            const wire = Bokeh.documents[0].get_model_by_name('wire')
            const slider = Bokeh.documents[0].get_model_by_name(name)
            if (slider.value == value) { done(); return }
            const follow = () => { wire.properties.text.change.disconnect(follow)
                                   requestAnimationFrame(() => setTimeout(done, 0)) }
            wire.properties.text.change.connect(follow)
            slider.value = value""", name, value)

    def let_rest(self):
        """Wait until what takes longer has come."""
        self.browser.execute_async_script("""
            const [done] = arguments
            const {text} = Bokeh.documents[0].get_model_by_name('wire').properties
            let timer = setTimeout(done, 2000)
            text.change.connect(() => { clearTimeout(timer); timer = setTimeout(done, 2000) })""")

    def severe(self):
        """What went wrong in the browser."""
        return [line for line in self.browser.get_log("browser") if line["level"] == "SEVERE"
                and "favicon" not in line["message"]]

    def focused(self):
        """Name of the model and tag of what has the focus."""
        return tuple(self.browser.execute_script("""
            let one = document.activeElement
            while (one?.shadowRoot?.activeElement) one = one.shadowRoot.activeElement
            const host = one?.getRootNode()?.host
            const view = [...Bokeh.documents[0]._all_models.values()].find((model) =>
                Bokeh.index.find_one_by_id(model.id)?.el === host)
            return [view?.name ?? '', one?.tagName ?? '']"""))

    def saved(self, button, name):
        """A file that a button brings."""
        path = self.downloads / name
        path.unlink(missing_ok=True)
        self.element(button, "button").click()
        self.wait(lambda: path.exists() and path.stat().st_size > 0, f"{name} is saved")
        return path

    def setUp(self):
        for name, value in (("shift", 0), ("yaw", 0), ("load", 100), ("cksi", 0.1),
                            ("ceta", 0.05), ("cphi", 0.05), ("mu", 0.3)):
            self.set(name, value)


@unittest.skipIf(NO_BROWSER, NO_BROWSER)
class Browser(InBrowser):
    def test_it_is_the_fast_way(self):
        self.assertTrue(self.browser.execute_script("return Bokeh.is_spared"))
        self.assertIn("numbers", self.model("wire", "text"))

    def test_sliders_move_by_keys_and_pictures_follow(self):
        from selenium.webdriver.common.keys import Keys

        patch, before = self.columns("patch_strips"), self.columns("tractions_strips_arrows")
        screen = self.browser.get_screenshot_as_png()
        self.element("cksi", ".noUi-handle").send_keys(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
        self.wait(lambda: abs(self.model("cksi", "value") - 0.12) < 1e-9, "the slider moves")
        self.wait(lambda: self.columns("tractions_strips_arrows") != before, "arrows follow")
        self.assertEqual(self.model("cksi_number", "value"), "0.12")
        self.assertEqual(self.columns("patch_strips"), patch)
        self.wait(lambda: self.browser.get_screenshot_as_png() != screen, "the screen follows")
        self.element("shift", ".noUi-handle").send_keys(Keys.PAGE_UP)
        self.wait(lambda: self.columns("patch_strips") != patch, "the patch follows")
        self.element("axis", ".bk-btn:nth-child(2)").click()
        self.wait(lambda: self.browser.execute_script(
            "return Bokeh.documents[0].get_model_by_name('creep_now').data.force[0]") is not None
            and "ceta" in self.browser.execute_script(
                "return Bokeh.documents[0]._all_models ? [...Bokeh.documents[0]._all_models"
                ".values()].map((m) => m.axis_label ?? '').join() : ''"), "the curve follows")
        self.element("axis", ".bk-btn:nth-child(1)").click()

    def test_images_of_axes_are_what_would_be_drawn(self):
        """Ranges and labels change; then axes are drawn anew, and every pixel is as before."""
        for name, value in (("shift", 5.5), ("load", 160), ("cphi", 0.6), ("ceta", -1.2)):
            self.set(name, value)
        for button in (2, 3):
            self.element("axis", f".bk-btn:nth-child({button})").click()
            self.wait(lambda number=button - 1: self.model("axis", "active") == number, "axis")
        self.set("mu", 0.4)
        self.let_rest()
        axes, others = self.browser.execute_async_script("""
            const [done] = arguments
            const plots = [...Bokeh.documents[0]._all_models.values()]
                .filter((model) => model.type == 'Figure'
                        && Bokeh.index.find_one_by_id(model.id)?.el.clientWidth > 0)
                .map((model) => Bokeh.index.find_one_by_id(model.id))
            // Bokeh does not clear the first row and column, which lie half outside.
            const look = () => plots.map(({canvas_view: {primary: {canvas, ctx}}}) =>
                ctx.getImageData(1, 1, canvas.width - 1, canvas.height - 1).data)
            const later = (call) => setTimeout(call, 500)
            later(() => {
                const before = look()
                const axes = plots.flatMap((view) => view.computed_renderer_views)
                    .filter((view) => view.image_of != null)
                for (const one of axes) one.image_of = one.extents_of = null
                for (const view of plots) view.request_repaint()
                later(() => done([axes.map((one) => one.image_of), look().map((pixels, k) =>
                    pixels.filter((value, i) => value !== before[k][i]).length)]))
            })""")
        self.assertEqual(len(axes), 17)
        self.assertNotIn(None, axes)
        self.assertEqual(others, [0] * 9)
        self.element("axis", ".bk-btn:nth-child(1)").click()

    def test_all_is_within_reach_of_the_tab_key(self):
        from selenium.webdriver.common.action_chains import ActionChains
        from selenium.webdriver.common.keys import Keys

        seen = set()
        for _ in range(60):
            ActionChains(self.browser).send_keys(Keys.TAB).perform()
            seen.add(self.focused())
        for name in ("shift", "yaw", "load", "cksi", "ceta", "cphi", "mu", "yield_shear",
                     "smoothing"):
            self.assertIn((name, "DIV"), seen)
            self.assertIn((f"{name}_number", "INPUT"), seen)
        for name in ("case", "csv", "svg", "free", "solve_norm", "scheme", "view", "axis",
                     "load_direction"):
            self.assertIn((name, "BUTTON"), seen)
        for name, tag in (("wheel", "SELECT"), ("rail", "SELECT"), ("wheel_file", "INPUT"),
                          ("rail_file", "INPUT")):
            self.assertIn((name, tag), seen)

    def drop(self, name, path):
        """A file that the mouse lets fall."""
        x, y = self.browser.execute_script(
            "const box = arguments[0].getBoundingClientRect()\n"
            "return [box.x + box.width/2, box.y + box.height/2]", self.element(name, "input"))
        for what in ("dragEnter", "dragOver", "drop"):
            self.browser.execute_cdp_cmd("Input.dispatchDragEvent", {
                "type": what, "x": x, "y": y,
                "data": {"items": [], "files": [str(path)], "dragOperationsMask": 1}})

    def test_saved_case_numbers_and_picture(self):
        self.set("shift", 2.5)
        self.set("cphi", 0.2)
        ours = rows_of(self.saved("csv", "explore.csv").read_text(encoding="utf-8"))
        self.assertEqual((ours[0]["yw_mm"], ours[0]["cphi_rad_per_mm"]), ("2.5", "0.0002"))
        case = self.saved("case", "explore.nml")
        self.agree(ours[0], self.solved_by_program({case.name: case.read_bytes()}))
        self.set("yaw", 4)
        ours = rows_of(self.saved("csv", "explore.csv").read_text(encoding="utf-8"))
        with zipfile.ZipFile(self.saved("case", "explore.zip")) as archive:
            files = {name: archive.read(name) for name in archive.namelist()}
        self.agree(ours[0], self.solved_by_program(files))
        picture = xml.etree.ElementTree.fromstring(self.saved("svg", "explore.svg").read_bytes())
        tags = [part.tag.rpartition("}")[2] for part in picture.iter()]
        self.assertEqual(tags[0], "svg")
        self.assertGreater(tags.count("path"), 300)
        words = " ".join(part.text or "" for part in picture.iter() if part.tag.endswith("text"))
        for text in ("Contact patch", "pressure, MPa", "s1002 on uic60", "yaw 4 mrad"):
            self.assertIn(text, words)

    def test_files_are_dropped_and_bad_ones_told(self):
        self.drop("wheel_file", self.folder / "bad.prw")
        self.wait(lambda: self.status().endswith("got 'x' (bad.prw:7)"), "the error is told")
        self.assertEqual(self.model("wheel", "value"), "s1002")
        before = self.columns("profiles_wheel")
        self.element("wheel_file", "input").send_keys(str(self.folder / "wheel.prw"))
        self.wait(lambda: self.columns("profiles_wheel") != before, "the wheel is drawn")
        self.assertEqual(self.model("wheel", "value"), "wheel.prw")
        self.assertNotIn("bad.prw", self.status())
        self.browser.execute_script(
            "Bokeh.documents[0].get_model_by_name('wheel').value = 's1002'")
        self.wait(lambda: self.columns("profiles_wheel") == before, "s1002 is drawn")

    def test_norm_and_tang_on_a_button(self):
        self.assertEqual(self.columns("pressure_norm")["p"], [])
        self.element("solve_norm", "button").click()
        self.wait(lambda: len(self.columns("pressure_norm")["p"]) > 0, "NORM is drawn")
        self.wait(lambda: "NORM + TANG" in self.columns("times_times")["row"], "its time too")
        self.wait(lambda: len(self.columns("creep_now")["force"]) == 3, "and its force")
        self.set("mu", 0.31)
        self.wait(lambda: self.columns("pressure_norm")["p"] == [], "of the old case nothing stays")

    def test_free_rolling_and_no_contact(self):
        self.set("yaw", 5)
        self.element("free", "button").click()
        self.wait(lambda: abs(self.model("ceta", "value") - 0.5) < 0.01, "yaw gives ceta")
        self.set("yaw", 0)
        self.write("short.prw", wheel_text(0))
        self.element("wheel_file", "input").send_keys(str(self.folder / "short.prw"))
        self.wait(lambda: "no_contact" in self.status(), "there is no contact")
        self.assertEqual(self.columns("patch_strips")["left"], [])
        self.assertIn("–", self.words("contact_numbers"))
        self.browser.execute_script(
            "Bokeh.documents[0].get_model_by_name('wheel').value = 's1002'")
        self.wait(lambda: "no_contact" not in self.status(), "there is contact again")

    def test_nothing_comes_from_or_goes_to_elsewhere(self):
        addresses = self.browser.execute_script(
            "return performance.getEntriesByType('resource').map((one) => one.name)")
        self.assertGreater(len(addresses), 2)
        for address in addresses:
            self.assertTrue(address.startswith((self.served.address, "blob:", "data:")), address)
        with socket.create_connection(("127.0.0.1", self.served.port)):
            pass
        others = {"127.0.0.2", *(info[4][0] for info in self.addresses())} - {"127.0.0.1"}
        for other in others:
            with self.assertRaises(OSError, msg=other), \
                    socket.create_connection((other, self.served.port), timeout=5):
                pass
        for origin, answer in (("http://elsewhere.example", b" 403 "),
                               (self.served.address.rstrip("/"), b" 101 ")):
            with socket.create_connection(("127.0.0.1", self.served.port)) as stream:
                stream.sendall(f"GET /ws HTTP/1.1\r\nHost: {self.served.address[7:-1]}\r\n"
                               f"Origin: {origin}\r\nUpgrade: websocket\r\n"
                               "Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                               "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n"
                               "Sec-WebSocket-Protocol: bokeh, none\r\n\r\n".encode())
                self.assertIn(answer, stream.recv(200).splitlines()[0])

    @staticmethod
    def addresses():
        with contextlib.suppress(OSError):
            return socket.getaddrinfo(socket.gethostname(), None, socket.AF_INET)
        return []


@unittest.skipIf(NO_BROWSER, NO_BROWSER)
class UnknownBokeh(InBrowser):
    """A version of Bokeh whose insides nobody has looked at: changes go its own way."""

    before = "import bokeh.resources\nbokeh.__version__ = '3.99.0'\n"

    def test_pictures_follow_and_files_are_saved(self):
        self.assertIsNone(self.browser.execute_script("return Bokeh.is_spared"))
        patch, arrows = self.columns("patch_strips"), self.columns("tractions_strips_arrows")
        self.set("cksi", 0.3)
        self.wait(lambda: self.columns("tractions_strips_arrows") != arrows, "arrows follow")
        self.assertEqual(self.columns("patch_strips"), patch)
        # What takes longer may come in between.
        self.set("shift", 3)
        self.wait(lambda: self.columns("patch_strips") != patch, "the patch follows")
        self.let_rest()
        numbers = self.words("contact_numbers")
        ours = rows_of(self.saved("csv", "explore.csv").read_text(encoding="utf-8"))
        self.assertIn(f"{float(ours[0]['pmax_MPa']):.0f}", numbers)
        case = self.saved("case", "explore.nml")
        self.agree(ours[0], self.solved_by_program({case.name: case.read_bytes()}))
        self.element("wheel_file", "input").send_keys(str(self.folder / "bad.prw"))
        self.wait(lambda: self.status().endswith("got 'x' (bad.prw:7)"), "the error is told")
        self.assertEqual(self.severe(), [])


@unittest.skipIf(NO_PAGE, NO_PAGE)
class Ends(ExploreTest):
    def test_ctrl_c_ends_it_and_a_port_in_use_is_told(self):
        self.write("start.nml", "&contact load_N = 8e4, load_direction = 'vertical', shift_mm = 1.5"
                   " /\n&wheel profile = 's1002' /\n&rail profile = '60e1', cant = 0.025 /\n")
        served = page_in_browser.Served(self.environment, self.folder, "--case", "start.nml")
        try:
            with urllib.request.urlopen(served.address) as answer:
                self.assertIn(b"faststrip explore", answer.read())
            done = subprocess.run(
                [sys.executable, "-m", "faststrip.explore", "--no-browser", "--port",
                 str(served.port)], cwd=self.folder, capture_output=True, encoding="utf-8",
                env=self.environment, timeout=page_in_browser.PATIENCE, check=False)
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertEqual(done.stderr, f"faststrip-explore: 127.0.0.1:{served.port}: the port "
                                          "is in use; another with --port N\n")
        finally:
            ended = served.end()
        self.assertEqual(ended, (0, ""))
