"""Views of the explorer: a wheelset's numbers, and the page in a browser at several widths, in both
colour schemes, by keyboard."""

import base64
import dataclasses
import io
import math
import time
import types
import unittest

import numpy as np

import page_in_browser
from test_explore import NO_BROWSER, WHEEL, ExploreTest, InBrowser, rows_of

WIDTHS = (390, 1024, 1920)
SCHEMES = {"light": 200, "dark": 60}  # and how bright a page is, of 255


class Views(ExploreTest):
    def test_a_wheelset_is_the_librarys(self):
        case, wheelset = self.part("case").Case(), self.part("wheelset")
        solver = wheelset.WheelsetSolver()
        for changes in ({}, {"shift": 5.0, "yaw": 4e-3, "transfer": 0.3, "curvature": 2e-6,
                             "mu": 0.4}):
            told = dataclasses.replace(case, **changes)
            outcome = solver.solve(told)
            load = [told.load * (1.0 + one * told.transfer) for one in (1, -1)]
            speed = 2e4
            expected = self.faststrip.Wheelset("s1002", "uic60", mu=told.mu).solve(
                y=told.shift, yaw=told.yaw, speed=speed, curvature=told.curvature, load=load)
            for k, side in enumerate(("right", "left")):
                rests = outcome.rests(side)
                sense = 1.0 if side == "right" else -1.0
                np.testing.assert_array_equal(
                    [rests.longitudinal, sense * rests.lateral, rests.vertical], expected.force[k])
                self.assertAlmostEqual(rests.vertical, load[k], delta=1.0)
        self.assertIn("vertical load", solver.solve(
            dataclasses.replace(case, is_vertical=False)).error)
        functions = solver.functions(case)
        self.assertTrue(np.all(np.diff(functions.of_y.y) > 0.0))
        at = int(np.argmin(np.abs(functions.conicity.amplitude - 3.0)))
        self.assertAlmostEqual(functions.conicity.tan_gamma_e[at], 0.18, delta=0.03)

    def test_lateral_and_vertical_force_follow_from_the_angle(self):
        """As of a wheelset's contact, whose forces in the track the library knows."""
        tables = self.part("tables")
        solver = self.part("wheelset").WheelsetSolver()
        case = self.part("case").Case(shift=5.5, yaw=5e-3)
        contact = solver.solve(case).result.contacts[0]
        outcome = types.SimpleNamespace(case=case, geometry=types.SimpleNamespace(
            place=types.SimpleNamespace(angle=contact.contact_angle)))
        answer = types.SimpleNamespace(result=contact, wear=None)
        normal, vertical, lateral, ratio, part, _ = tables.more_rows(outcome, answer)
        self.assertAlmostEqual(normal, contact.load / 1e3, delta=1e-9)
        # Yaw turns the forces along and across a little.
        self.assertAlmostEqual(vertical, contact.force[2] / 1e3, delta=0.01)
        self.assertAlmostEqual(lateral, contact.force[1] / 1e3, delta=0.2)
        self.assertAlmostEqual(ratio, lateral / vertical, delta=1e-12)
        self.assertAlmostEqual(part, contact.pmax / 12.0, delta=1e-9)

    def test_what_yields_is_said(self):
        case, tables = self.part("case").Case(), self.part("tables")
        solver = self.part("solving").Solver()
        self.assertNotIn("yields", tables.status_of(solver.solve(case))[0])
        soft = dataclasses.replace(case, yield_shear=200.0)
        self.assertIn("is above 4 k = 800 MPa: the material yields",
                      tables.status_of(solver.solve(soft))[0])
        wheelset = self.part("wheelset").WheelsetSolver().solve(soft)
        words = tables.wheelset_status_of(wheelset)[0]
        self.assertEqual((words.count("yields"), words.count("right wheel")), (2, 1))

    def test_sweep_and_map_are_single_contacts(self):
        case, solving = self.part("case").Case(), self.part("solving")
        solver = solving.Solver()
        survey = list(solver.survey(case, "cksi"))[-1]
        for k in (8, 24, 36):
            shifted = dataclasses.replace(case, shift=float(solving.SWEEP[k]))
            for name, answer in solver.solve(shifted).answers.items():
                if math.isfinite(survey.pressure[name][k]):
                    self.assertAlmostEqual(survey.pressure[name][k] / answer.result.pmax, 1.0,
                                           delta=1e-9)
        self.assertGreater(np.isfinite(survey.pressure["strips"]).sum(), 30)
        ends = [np.linspace(-half, half, solving.MAP_POINTS) for half in survey.half]
        for row, at in ((3, 12), (8, 8), (15, 2)):
            result = solver.solve(dataclasses.replace(
                case, ceta=ends[1][row], cksi=ends[0][at])).answers["strips"].result
            force = math.hypot(result.fx, result.fy) / (case.mu * result.load)
            self.assertAlmostEqual(survey.part[row, at], force, delta=1e-9)
        nowhere = list(solver.survey(dataclasses.replace(case, shift=200.0), "cksi"))
        self.assertEqual([one.curve for one in nowhere], [None])

    def test_a_measured_profile_is_smoothed(self):
        case, exporting = self.part("case"), self.part("exporting")
        noise = np.random.default_rng(3).normal(0.0, 5e-3, 321)
        rows = "".join(f"{y / 4} {-(y / 4) ** 2 / 2000 + dz}\n"
                       for y, dz in zip(range(-160, 161), noise))
        rough = case.read_shape("wheel", "rough.txt", rows.encode())
        self.assertIs(case.smoothed("wheel", rough, 0.0), rough)
        standard = case.STANDARD["wheel"]["s1002"]
        self.assertIs(case.smoothed("wheel", standard, 10.0), standard)
        smooth = case.smoothed("wheel", rough, 10.0)
        self.assertIs(case.smoothed("wheel", rough, 10.0), smooth)
        bends = [np.diff(one.profile.z, 2).std() for one in (rough, smooth)]
        self.assertLess(bends[1], 0.1 * bends[0])
        outcome = self.part("solving").Solver().solve(case.Case(wheel=smooth))
        files = exporting.case_files(outcome)
        self.assertIn("rough_smooth10.txt", files)
        self.agree(rows_of(exporting.numbers_csv(outcome))[0], self.solved_by_program(files))


@unittest.skipIf(NO_BROWSER, NO_BROWSER)
class Widths(InBrowser):
    @classmethod
    def show(cls, width, scheme):
        cls.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [
            {"name": "prefers-color-scheme", "value": scheme}]})
        cls.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": 800, "deviceScaleFactor": 1, "mobile": False})
        cls.wait(lambda: cls.browser.execute_script(
            "return innerWidth === arguments[0] && document.documentElement.dataset.scheme ==="
            "arguments[1]", width, scheme), f"{width} px, {scheme}")

    def tearDown(self):
        self.turn(0)
        self.show(page_in_browser.WIDTH, "light")

    def turn(self, view):
        self.browser.execute_script(
            "Bokeh.documents[0].get_model_by_name('view').active = arguments[0]", view)
        name = ("contact", "wheelset")[view]
        self.wait(lambda: self.browser.execute_script(
            "return Bokeh.index.find_one_by_id(Bokeh.documents[0].get_model_by_name("
            "arguments[0]).id)?.el.clientHeight > 0", f"{name}_view"), name)

    def look(self):
        """What lies beyond the width, ratios of frames, and how bright the page is."""
        from PIL import Image

        # Figures follow a change of the window in their own time.
        end = time.monotonic() + page_in_browser.PATIENCE
        while True:
            wide, columns = self.browser.execute_script("""
                const room = document.documentElement
                const figures = [...Bokeh.documents[0]._all_models.values()]
                    .filter((model) => model.type == 'Figure')
                    .map((model) => Bokeh.index.find_one_by_id(model.id)?.el)
                    .filter((el) => el?.clientWidth > 0)
                    .map((el) => el.getBoundingClientRect())
                return [Math.max(room.scrollWidth - room.clientWidth,
                                 ...figures.map((box) => box.right - room.clientWidth)),
                        new Set(figures.map((box) => Math.round(box.left))).size]""")
            if wide <= 0 or time.monotonic() > end:
                break
            time.sleep(0.05)
        picture = Image.open(io.BytesIO(base64.b64decode(
            self.browser.get_screenshot_as_base64()))).convert("L")
        return wide, columns, np.asarray(picture).mean()

    def test_both_views_at_three_widths_in_both_schemes(self):
        for view, most in ((0, 4), (1, 3)):  # columns; the track takes two
            self.turn(view)
            for width in WIDTHS:
                for scheme, bright in SCHEMES.items():
                    with self.subTest(view=view, width=width, scheme=scheme):
                        self.show(width, scheme)
                        wide, columns, mean = self.look()
                        self.assertLessEqual(wide, 0)
                        self.assertEqual(columns, {390: 1, 1024: 2, 1920: most}[width])
                        self.assertEqual(mean > 128, scheme == "light")
                        self.assertLess(abs(mean - bright), 60)
        self.assertEqual(self.severe(), [])

    def test_the_switch_turns_the_scheme_and_stays(self):
        from selenium.webdriver.common.keys import Keys

        self.show(1024, "light")
        of = "return document.documentElement.dataset.scheme"
        button = self.element("scheme", "button")
        button.send_keys(Keys.ENTER)
        self.wait(lambda: self.browser.execute_script(of) == "dark", "it is dark")
        self.assertEqual(self.browser.execute_script("return localStorage.scheme"), "dark")
        button.send_keys(Keys.ENTER)
        self.wait(lambda: self.browser.execute_script(of) == "light", "it is light")
        self.browser.execute_script("localStorage.clear()")

    def field(self, name, text):
        from selenium.webdriver.common.keys import Keys

        field = self.element(f"{name}_number", "input")
        field.send_keys(Keys.BACKSPACE * len(field.get_attribute("value")), text, Keys.ENTER)
        return field

    def test_numbers_are_typed_with_a_comma_and_bad_ones_refused_beside(self):
        before = self.columns("patch_strips")
        field = self.field("shift", "3,5")
        self.wait(lambda: self.model("shift", "value") == 3.5, "3,5 is taken")
        self.wait(lambda: self.columns("patch_strips") != before, "the patch follows")
        for text in ("12", "3,5,1", "much", ""):
            self.field("shift", text)
            self.wait(lambda text=text: self.model("shift_refused", "visible")
                      and self.model("shift_refused", "text").endswith(f"got {text}"), text)
            self.assertIn("from -10 to 10", self.model("shift_refused", "text"))
            self.assertEqual(field.get_attribute("aria-invalid"), "true")
            self.assertEqual(self.model("shift", "value"), 3.5)
        self.field("shift", "\u22122")
        self.wait(lambda: self.model("shift", "value") == -2, "a true minus sign is taken")
        self.assertFalse(self.model("shift_refused", "visible"))
        for text in ("50", "3000", "-400"):
            self.field("roller_radius", text)
            self.wait(lambda text=text: self.model("roller_radius_refused", "visible")
                      and self.model("roller_radius_refused", "text")
                      == f"must be 0 or a number from 100 to 2500, got {text}", text)
        self.assertEqual(self.model("roller_radius", "value"), 0)
        self.assertEqual(self.element("shift", ".noUi-handle").get_attribute("aria-label"),
                         "lateral displacement y, mm")

    def test_rollers_and_a_plane_for_each_strip(self):
        # An answer may come late: what is waited for is no state of before, or that very one.
        seen = [self.words("contact_numbers")]
        for change, what in ((lambda: self.field("shift", "6"), "the wheel is displaced"),
                             (lambda: self.field("roller_radius", "500"), "a roller"),
                             (lambda: self.element("planes", ".bk-btn:nth-child(2)").click(),
                              "a plane for each strip")):
            change()
            self.wait(lambda: self.words("contact_numbers") not in seen, what)
            seen.append(self.words("contact_numbers"))
        self.element("planes", ".bk-btn:nth-child(1)").click()
        self.wait(lambda: self.words("contact_numbers") == seen[2], "one plane")
        self.field("roller_radius", "0")
        self.wait(lambda: self.words("contact_numbers") == seen[1], "a rail")
        # What only the library knows is said at the field, too.
        self.turn(1)
        self.field("curvature", "2")
        self.field("roller_radius", "500")
        self.wait(lambda: "on rollers must be 0" in self.words("curvature_told"), "refused")
        self.assertEqual(self.words("roller_radius_told"), "")
        self.field("curvature", "0")
        self.wait(lambda: self.words("curvature_told") == "" and "Y/Q" in
                  self.words("wheelset_numbers"), "a wheelset on rollers")
        self.field("roller_radius", "0")
        self.turn(0)

    def test_a_wheelset_by_keyboard(self):
        from selenium.webdriver.common.action_chains import ActionChains
        from selenium.webdriver.common.keys import Keys

        self.turn(1)
        self.wait(lambda: len(self.columns("radii_delta_r")["x"]) > 50, "functions are drawn")
        before = self.columns("track_forces"), self.words("wheelset_numbers")
        self.assertEqual(len(before[0]["x0"]), 2)
        self.assertIn("Y/Q", before[1])
        self.element("shift", ".noUi-handle").send_keys(Keys.PAGE_UP)
        self.wait(lambda: self.columns("track_forces") != before[0], "arrows follow")
        self.wait(lambda: self.words("wheelset_numbers") != before[1], "numbers follow")
        order = []
        for _ in range(20):
            ActionChains(self.browser).send_keys(Keys.TAB).perform()
            order.append(self.focused()[0])
        wanted = ["shift_number", "yaw", "yaw_number", "load", "load_number", "transfer",
                  "transfer_number", "curvature", "curvature_number", "mu", "mu_number",
                  "yield_shear", "yield_shear_number", "roller_radius", "roller_radius_number",
                  "smoothing", "smoothing_number", "svg"]
        self.assertEqual([one for one in order if one in wanted], wanted)
        self.element("load_direction", ".bk-btn:nth-child(2)").click()
        self.wait(lambda: "vertical load" in self.status(), "a normal force is refused")
        self.element("load_direction", ".bk-btn:nth-child(1)").click()
        self.wait(lambda: "vertical load" not in self.status(), "a vertical one is not")

    def test_long_errors_are_whole(self):
        self.show(390, "light")
        self.element("wheel_file", "input").send_keys(str(self.folder / "bad.prw"))
        self.wait(lambda: self.status().endswith("got 'x' (bad.prw:7)"), "the error is told")
        cut = self.browser.execute_script(
            "const e = arguments[0]; return e.scrollWidth > e.clientWidth", self.element(
                "status", ".put"))
        self.assertFalse(cut)

    def test_curve_sweep_and_map_come_when_the_sliders_rest(self):
        self.let_rest()
        before = [self.columns(name) for name in ("creep_strips", "sweep_strips", "map_cells")]
        self.assertEqual([len(next(iter(one.values()))) for one in before], [31, 41, 17**2])
        self.set("load", 140)
        self.set("shift", 1.5)
        self.let_rest()
        for name, old in zip(("creep_strips", "sweep_strips", "map_cells"), before):
            new = self.columns(name)
            self.assertEqual({key: len(one) for key, one in new.items()},
                             {key: len(one) for key, one in old.items()})
            self.assertNotEqual(new, old)


@unittest.skipIf(NO_BROWSER, NO_BROWSER)
class Opened(InBrowser):
    """A measured pair that was given on the command line."""

    @classmethod
    def words_of_start(cls):
        cls.write("own.prw", WHEEL)
        return ["own.prw", "60e1", "--inclination", "0.05"]

    def test_it_begins_with_this_pair(self):
        self.assertEqual((self.model("wheel", "value"), self.model("rail", "value")),
                         ("own.prw", "60e1"))
        before = self.columns("profiles_wheel")["z"]
        self.set("smoothing", 20)
        self.wait(lambda: self.columns("profiles_wheel")["z"] != before, "it is smoothed")
        self.set("smoothing", 0)
        self.wait(lambda: self.columns("profiles_wheel")["z"] == before, "and as it was")


if __name__ == "__main__":
    unittest.main()
