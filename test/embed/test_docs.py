"""The site of pages: what FORD would take for something else than words, found without FORD; the
interfaces, searching and reading it on a small screen, on a site without pictures."""

import importlib.util
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.parse
from unittest import mock

import document
from installed import ROOT, page_in_browser

METADATA = re.compile(r"\A!> ?[\w-]+:\s")
MISSING = [name for name in ("sphinx", "ford", "furo", "myst_parser", "latex2mathml")
           if not importlib.util.find_spec(name)]
NO_SITE = f"{', '.join(MISSING)} not installed: tools/requirements-docs.txt" if MISSING else ""
NO_BROWSER = ("selenium not installed: tools/requirements-explore.txt"
              if not importlib.util.find_spec("selenium") else
              "" if page_in_browser.BROWSER and page_in_browser.DRIVER
              else "no chromium with chromium-driver")
WIDTH = 390
# Two modules, one with long names, stand for all of FORD's pages.
SOURCES = "faststrip/contact/derivatives.f90", "faststrip/interop/c/c.f90"
# Names of __all__, and what a class has: methods, properties, fields of a dataclass.
PUBLIC = """
import dataclasses, inspect, json
from unittest import mock
with mock.patch("ctypes.CDLL"):
    import faststrip
found = {}
for name in faststrip.__all__:
    one = getattr(faststrip, name)
    parts = []
    if inspect.isclass(one) and not issubclass(one, Exception):
        fields = dataclasses.fields(one) if dataclasses.is_dataclass(one) else ()
        parts = [each.name for each in fields] + [
            each for each, value in inspect.getmembers(one)
            if each[0] != "_" and (inspect.isroutine(value) or isinstance(value, property))]
    found[name] = parts
print(json.dumps(found))
"""
# What is searched, what it is taken for, and the page that stands first.
TRIALS = (
    ("conicty", "conicity", "python/geometry.html#faststrip.conicity"),
    ("penetraton", "penetration", ".penetration"),
    ("faststrip_wheelst_solve", "faststrip_wheelset_solve",
     "c/wheelset.html#c.faststrip_wheelset_solve"),
    ("singular matrx", "singular matrix", "docs/errors.html#linear_algebra"),
    ("wheel lift", None, "docs/errors.html#no_convergence"),
    ("wheel lifts", None, "docs/errors.html#no_convergence"),
    ("derailed", None, "docs/errors.html#no_contact"),
    ("forces NaN", None, "docs/errors.html#not_finite"),
    ("faststrip_solve", None, "c/solve.html#c.faststrip_solve"),
    ("Wheelset.solve", None, "python/wheelset.html#faststrip.Wheelset.solve"),
    ("FSWNEW", None, "fortran77.html"),
)
# Parts of a page that reach beyond its right edge and cannot be scrolled to.
CUT_OFF = """
return [...document.querySelectorAll("article *, .container *")].filter((one) => {
    const place = one.getBoundingClientRect();
    if (place.width === 0 || place.right <= innerWidth + 0.5 || one.closest("math")) return false;
    for (let up = one.parentElement; up && up !== document.body; up = up.parentElement)
        if (["auto", "scroll"].includes(getComputedStyle(up).overflowX)) return false;
    return true;
}).map((one) => one.outerHTML.slice(0, 100));
"""
# Of text and what is behind it: how many times as bright the brighter one is (WCAG 2.1).
CONTRAST = """
const seen = (one) => {
    const colour = getComputedStyle(one).backgroundColor;
    return /, 0\\)$/.test(colour) && one.parentElement ? seen(one.parentElement) : colour;
};
const bright = (colour) => colour.match(/[\\d.]+/g).slice(0, 3).map((part) => part / 255)
    .map((part) => part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4)
    .reduce((sum, part, k) => sum + part * [0.2126, 0.7152, 0.0722][k], 0.05);
return [...document.querySelectorAll("article p, article a, .container p, .container td, " +
                                     ".container a")]
    .filter((one) => one.offsetWidth > 0 && one.textContent.trim())
    .map((one) => [bright(getComputedStyle(one).color), bright(seen(one)), one.outerHTML])
    .map(([a, b, words]) => [Math.max(a, b) / Math.min(a, b), words.slice(0, 200)])
    .filter(([contrast, _]) => contrast < 4.5);
"""


class Docstrings(unittest.TestCase):
    def test_no_module_begins_like_metadata(self):
        """FORD takes `word: text` at the head of a docstring for one of its keys, and warns."""
        paths = sorted((ROOT / "src").rglob("*.f90"))
        self.assertGreater(len(paths), 40)
        self.assertEqual([path.name for path in paths
                          if METADATA.match(path.read_text(encoding="utf-8"))], [])
        self.assertRegex("!> FASTSIM: Kalker's", METADATA)

    def test_no_argument_is_explained_like_metadata(self):
        for path in sorted((ROOT / "src").rglob("*.f90")):
            with self.subTest(path.name):
                self.assertNotRegex(path.read_text(encoding="utf-8"), r"(?m)!! ?\w[\w-]*: ")


@unittest.skipIf(NO_SITE, NO_SITE)
class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        folder = pathlib.Path(temporary.name)
        cls.site = folder / "site"
        page = folder / "ford.md"
        # Its text leads to what those do not have.
        page.write_text(re.match(r"(?s)---\n.*?\n---\n", (ROOT / "docs" / "ford.md").read_text(
            encoding="utf-8"))[0] + "\nText.\n", encoding="utf-8")
        for name in SOURCES:
            document.copy(ROOT / "src" / name, folder / "sources" / name)
        with mock.patch.multiple(document, SITE=cls.site, PICTURE=re.compile("(?!)"),
                                 make_pictures=lambda *_: None):
            document.build_api(folder / "sources", page)
            document.gather(folder / "pages")
            document.build_pages(folder / "pages")
            document.write_words()
        cls.pages = [path for path in sorted(cls.site.rglob("*.html"))
                     if path != cls.site / "index.html"]
        cls.browser = None
        if not NO_BROWSER:
            cls.browser = page_in_browser.start_browser()
            cls.addClassCleanup(cls.browser.quit)
            cls.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
                "width": WIDTH, "height": 844, "deviceScaleFactor": 1, "mobile": False})

    def anchors(self, folder):
        texts = [path.read_text(encoding="utf-8") for path in (self.site / folder).glob("*.html")]
        found = [name for text in texts for name in re.findall(r'\bid="([^"]+)"', text)]
        return {name for name in found if re.match(r"c\.|faststrip\.", name)}

    def test_every_name_of_c_has_its_place_and_no_other(self):
        text = re.sub(r"/\*.*?\*/", "", (ROOT / "include" / "faststrip.h").read_text(
            encoding="utf-8"), flags=re.DOTALL)
        names = {f"c.{name}" for name in re.findall(
            r"\bint (faststrip_\w+)\(|#define (FASTSTRIP_\w+) |\benum (\w+) \{|\} (\w+);"
            r"|typedef struct \w+ (\w+);", text) for name in name if name}
        members = {f"c.{whole}.{''.join(part)}"
                   for whole, body in re.findall(r"(?:enum|struct) (\w+) \{([^{}]*)\}", text)
                   for part in re.findall(r"(\w+)(?:\[\d+\])*;|(\w+) = ", body)}
        self.assertGreater(len(names), 75)
        self.assertGreater(len(members), 220)
        places = self.anchors("c")
        self.assertEqual((names | members) - places, set())
        self.assertEqual({name for name in places if name.count(".") == 1} - names, set())

    def test_every_name_of_python_has_its_place_and_no_other(self):
        done = subprocess.run([sys.executable, "-c", PUBLIC], cwd=ROOT / "python", check=True,
                              stdout=subprocess.PIPE, encoding="utf-8")
        public = json.loads(done.stdout)
        names = {f"faststrip.{name}" for name in public}
        parts = {f"faststrip.{name}.{part}" for name, parts in public.items() for part in parts}
        self.assertGreater(len(names), 37)
        self.assertGreater(len(parts), 200)
        places = self.anchors("python")
        self.assertEqual((names | parts) - places, set())
        self.assertEqual({name for name in places if name.count(".") == 1} - names, set())
        self.assertEqual([name for name in places if re.search(r"\._(?!_call__)", name)], [])

    def test_functions_tell_arguments_and_errors(self):
        text = (self.site / "c" / "solve.html").read_text(encoding="utf-8")
        entry = text.split('id="c.faststrip_set_gap"')[1].split('class="c function"')[0]
        told = re.sub(r"<[^>]+>|\s+", " ", entry)
        for words in ("inclination", "numbers, rad, or null: not known", "Returns",
                      "workspace_too_small"):
            self.assertIn(words, told)
        self.assertIn('href="../docs/errors.html#workspace_too_small"', entry)

    @unittest.skipIf(NO_BROWSER, NO_BROWSER)
    def test_pages_fit_a_small_screen_and_load_nothing_from_elsewhere(self):
        self.assertGreater(len(self.pages), 55)
        for path in self.pages:
            with self.subTest(path.relative_to(self.site)):
                self.browser.get(path.as_uri())
                width, loaded = self.browser.execute_script(
                    "return [document.documentElement.scrollWidth,"
                    " performance.getEntriesByType('resource').map((one) => one.name)]")
                self.assertLessEqual(width, WIDTH)
                self.assertEqual(self.browser.execute_script(CUT_OFF), [])
                self.assertEqual([name for name in loaded if not name.startswith("file:")], [])

    @unittest.skipIf(NO_BROWSER, NO_BROWSER)
    def test_pages_can_be_read_in_the_light_and_in_the_dark(self):
        grounds = {}
        for scheme in ("light", "dark"):
            self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [
                {"name": "prefers-color-scheme", "value": scheme}]})
            for page in ("c/solve.html", "python/contact.html", "docs/errors.html",
                         "fortran.html", "api/module/faststrip_interop_c.html"):
                with self.subTest(scheme=scheme, page=page):
                    self.browser.get((self.site / page).as_uri())
                    self.assertEqual(self.browser.execute_script(CONTRAST), [])
                    ground = self.browser.execute_script(
                        "return getComputedStyle(document.body).backgroundColor")
                    self.assertNotEqual(grounds.setdefault(page, ground) == ground,
                                        scheme == "dark")

    @unittest.skipIf(NO_BROWSER, NO_BROWSER)
    def test_searching_forgives_typos_and_knows_symptoms(self):
        for words, meant, first in TRIALS:
            with self.subTest(words):
                self.browser.get(f"{(self.site / 'search.html').as_uri()}?q="
                                 + urllib.parse.quote(words))
                end = time.monotonic() + page_in_browser.PATIENCE
                links = []
                while not links and time.monotonic() < end:
                    links = self.browser.execute_script(
                        "return [...document.querySelectorAll('ul.search a')].map((one) =>"
                        " one.getAttribute('href'))")
                said = self.browser.execute_script(
                    "return document.getElementById('search-meant')?.textContent ?? null")
                self.assertEqual(said, meant and f"Searched for: {meant}")
                self.assertTrue(links and links[0].endswith(first), links[:3])
