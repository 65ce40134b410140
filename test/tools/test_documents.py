"""The documents: links lead somewhere, formulas can be shown, deviations are numbered once."""

import re
import tempfile
import unittest
from pathlib import Path

import document
import pages
import steps

ROOT = Path(__file__).resolve().parents[2]

PAGES = [ROOT / source for _, source in document.PAGES]
LABEL = r"- \*\*([NFSPLKV]\d+)\*\* "

# Tuned numbers of the code, by file and name, and how docs/method.md says them.
CONSTANTS = (
    ("strip/grading.f90", "end_grading", "0.7", "$g = 0.7$"),
    ("strip/equations.f90", "leaving_length_ratio", "0.15", "its length falls below 0.15 of its"),
    ("overlap.f90", "overlap_tolerance", "1.0e-3", "below $-10^{-3} D$"),
    ("strip/patches.f90", "fewest_strips_small_patch", "9", "but at least nine"),
    ("strip/grading.f90", "most_narrowed", "5.0", "$V$, at most 5,"),
    ("strip/figures.f90", "missed", "0.09", "\\left( 1 + 0.09"),
    ("strip/converge.f90", "second_order", "0.05", "$0.05\\, e^2$"),
    ("strip/converge.f90", "most_change", "0.5", "where $e$ is above 0.5"),
    ("normal/strips.f90", "usual_strips", "15", "reached by way of 15"),
    ("cells/solve.f90", "fine_cells", "26", "Fine cells are 26 across"),
    ("strip/levels.f90", "level_factor", "2", "reached by way of 15, 31, 63 and so on"),
    ("strip/level.f90", "loose_end_tolerance", "0.3", "would move by 0.3 strip or less"),
    ("strip/level.f90", "max_passes", "40", "40 iterations"),
    ("strip/level.f90", "max_splits_at_all", "8", "eight splits"),
    ("strip/level.f90", "max_couplings", "4", "at most four iterations"),
    ("estimate/errors.f90", "area_section", "9.4", "$9.4\\, \\mathrm{mean}"),
    ("estimate/errors.f90", "area_edge", "1.85", "1.85\\, \\mathrm{rms}\\, e"),
    ("limitations.f90", "default_resolution", "0.1", "(10 % by default)"),
    ("limitations.f90", "doubtful_slope", "0.2", "slopes above 0.2"),
    ("patch_law.f90", "gamma_length", "0.375", "$\\gamma = 3/8$"),
)


def labels(folder):
    """The labels of deviations that modules define, with the file of each."""
    return [(label, path.name) for path in sorted((ROOT / folder).rglob("*.f90"))
            for label in re.findall(rf"(?m)^!> {LABEL}", path.read_text(encoding="utf-8"))]


class OfTheProject(unittest.TestCase):
    def test_every_page_is_part_of_the_site(self):
        known = {path.relative_to(ROOT).as_posix() for path in PAGES}
        found = {path.relative_to(ROOT).as_posix() for path in (ROOT / "docs").glob("*.md")}
        self.assertEqual(found - known, {"docs/ford.md"})
        self.assertEqual([path for path in PAGES if not path.is_file()], [])

    def test_links_lead_to_files_and_headings(self):
        links = 0
        for path in PAGES:
            self.assertEqual(pages.broken_links(path, ROOT), [])
            links += len(pages.links(path.read_text(encoding="utf-8")))
        self.assertGreater(links, 40)

    def test_paths_that_pages_name_exist(self):
        """Files of the project in backticks, and the commands of code blocks."""
        name = re.compile(r"`((?:src|app|test|tools|reference|example|include|docs|plots|\.ci)"
                          r"/[\w./-]+)`")
        command = re.compile(r"(?m)^(?:\./|\.venv/bin/python )?((?:tools|\.ci)/[\w./-]+|run(?= ))")
        for path in PAGES:
            if path.name == "CHANGELOG.md":
                continue
            text = path.read_text(encoding="utf-8")
            for named in name.findall(text) + command.findall(text):
                with self.subTest(page=path.name, named=named):
                    self.assertTrue((ROOT / named).exists())

    def test_steps_that_pages_name_exist(self):
        for path in PAGES:
            if path.name != "CHANGELOG.md":
                named = set(re.findall(r"\./run ([a-z]+)", path.read_text(encoding="utf-8")))
                self.assertEqual(named - set(steps.STEPS) - {"help"}, set(), path.name)

    def test_the_navigation_names_each_page_once(self):
        for k in range(2):
            names = [page[k] for page in document.PAGES]
            self.assertEqual(len(set(names)), len(names))
        self.assertEqual(document.PAGES[0][1], "README.md")

    def test_formulas_can_be_shown(self):
        count = 0
        for path in PAGES:
            text = path.read_text(encoding="utf-8")
            self.assertEqual(pages.strange_formulas(text), [], path.name)
            self.assertNotIn("$", pages.INLINE.sub("", pages.BLOCK.sub("", pages.prose(text))),
                             f"{path.name}: a dollar sign without its other half")
            count += len(pages.formulas(text))
        self.assertGreater(count, 100)

    def test_deviations_stand_once_in_the_code_and_once_in_the_list(self):
        code = labels("src")
        text = (ROOT / "docs" / "method.md").read_text(encoding="utf-8")
        listed = re.findall(rf"(?m)^{LABEL}", text)
        self.assertEqual(len(listed), len(set(listed)))
        self.assertEqual(sorted(label for label, _ in code), sorted(listed))
        for letter in {label[0] for label in listed}:
            numbers = sorted(int(label[1:]) for label in listed if label[0] == letter)
            self.assertEqual(numbers, list(range(1, len(numbers) + 1)), letter)
        for path in sorted((ROOT / "src").rglob("*.f90")):
            self.assertNotRegex(path.read_text(encoding="utf-8"), r"(?i)\bdeviation \d",
                                path.name)

    def test_docstrings_hold_no_formula_that_needs_a_script(self):
        """FORD leaves `$$` and `\\(` to MathJax, which the site does without."""
        for path in sorted((ROOT / "src").rglob("*.f90")):
            for line in path.read_text(encoding="utf-8").splitlines():
                if "!>" in line or "!!" in line:
                    self.assertNotRegex(line, r"\$\$|\\\(|\\\[", path.name)

    def test_constants_that_the_method_names_are_those_of_the_code(self):
        text = " ".join((ROOT / "docs" / "method.md").read_text(encoding="utf-8").split())
        for file, name, value, phrase in CONSTANTS:
            with self.subTest(name):
                path = next(path for path in sorted((ROOT / "src" / "faststrip").rglob(file))
                            if f" {name} = " in path.read_text(encoding="utf-8"))
                found = re.search(rf"\b{name} = ([-\d.e]+)", path.read_text(encoding="utf-8"))
                self.assertEqual(found[1], value)
                self.assertIn(phrase, text)

    def test_every_status_word_is_explained(self):
        (status,) = (ROOT / "src").rglob("status.f90")
        words = re.findall(r"case \(st_\w+\); word = '(\w+)'", status.read_text(encoding="utf-8"))
        self.assertGreater(len(words), 20)
        text = (ROOT / "docs" / "method.md").read_text(encoding="utf-8")
        section = text.split("## Limitations and errors")[1].split("\n## ")[0]
        self.assertEqual([word for word in words if f"`{word}`" not in section], [])

    def test_every_status_word_has_its_entry_and_an_example(self):
        """What the examples print test_pages compares; of a limitation it has the word."""
        (status,) = (ROOT / "src").rglob("status.f90")
        text = status.read_text(encoding="utf-8")
        codes = {word: int(code) for word, code in
                 re.findall(r"integer, parameter :: st_(\w+) = (\d+)", text)}
        codes.pop("ok")
        self.assertGreater(len(codes), 25)
        page = (ROOT / "docs" / "errors.md").read_text(encoding="utf-8")
        entries = dict(re.findall(r"(?ms)^### (\w+)\n(.*?)(?=^##|\Z)", page))
        self.assertEqual(set(entries), set(codes))
        for word, entry in entries.items():
            with self.subTest(word):
                self.assertIn(f"| {codes[word]} | [`{word}`](#{word}) |", page)
                self.assertIn("**What to do.**", entry)
                (printed,) = re.findall(r"(?ms)^```output\n(.*?)^```", entry)
                self.assertTrue(printed)
                if codes[word] < 100:
                    self.assertRegex(printed, rf"(?m)^status +{word}$")

    def test_every_error_has_symptoms_of_its_own(self):
        text = (ROOT / "docs" / "errors.md").read_text(encoding="utf-8")
        symptoms = document.symptoms_of(text)
        self.assertEqual(list(symptoms), re.findall(r"(?m)^### (\w+)$", text))
        each = [one for many in symptoms.values() for one in many]
        self.assertEqual(len(each), len(set(each)))
        self.assertEqual([one for one in each if not re.fullmatch(r"[\w' -]+", one)], [])
        for word, one in (("no_convergence", "wheel lift"), ("no_contact", "derailed"),
                          ("not_finite", "NaN forces")):
            self.assertIn(one, symptoms[word])

    def test_the_readme_is_one_to_read(self):
        lines = (ROOT / "README.md").read_text(encoding="utf-8").splitlines()
        self.assertLessEqual(len(lines), 150)


class Tools(unittest.TestCase):
    """What the checks above rest on, on pages made to fail them."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def page(self, text, name="a.md"):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def test_broken_links_are_named(self):
        self.page("# Other page\n\n## It's `b` & c\n", "b.md")
        good = self.page("[x](b.md) [y](b.md#its-b--c) [z](#here) ![p](b.md)\n\n# Here\n"
                         "`[no](gone.md)` <!-- [no](gone.md) --> [w](https://example.org/x)\n"
                         "```\n[no](gone.md)\n# nor a heading\n```\n")
        self.assertEqual(pages.broken_links(good, self.folder), [])
        bad = self.page("[x](gone.md) [y](b.md#gone) [z](#gone) [w](b.md#nor-a-heading)\n")
        self.assertEqual(pages.broken_links(bad, self.folder),
                         ["a.md: no such file: gone.md", "a.md: no such anchor: b.md#gone",
                          "a.md: no such anchor: #gone",
                          "a.md: no such anchor: b.md#nor-a-heading"])
        outside = self.page("[x](../)\n")
        self.assertEqual(len(pages.broken_links(outside, self.folder)), 1)

    def test_formulas_are_found_and_doubted(self):
        text = "$x$ and `$no$` and\n\n$$\n\\frac{a}{b}\n$$\n\n```\n$no$ \n```\n"
        self.assertEqual(pages.formulas(text), [("\\frac{a}{b}", True), ("x", False)])
        self.assertEqual(pages.strange_formulas(text), [])
        for bad in ("\\unheard{x}", "\\frac{a}{b", "a & b", "\\left( x", "|x|"):
            self.assertEqual(pages.strange_formulas(f"${bad}$\n"), [bad])

    def test_a_page_shows_its_pictures_and_names_its_files(self):
        text = ("<!-- picture: out/a.png Two\nwords. -->\n\n<!-- file: a.nml -->\n```text\n"
                "&contact\n```\n")
        self.assertEqual(
            document.for_sphinx(text, "docs/start.md"),
            "```{figure} /out/a.png\n:alt: Two words.\n\nTwo words.\n```\n\n`a.nml`:\n\n"
            "```text\n&contact\n```\n")

    def test_the_first_page_has_the_navigation(self):
        text = document.for_sphinx("# faststrip\n", "README.md")
        self.assertEqual(text.count("{toctree}"), len(document.GROUPS))
        for words, file in [*document.PAGES[1:], *document.MADE]:
            self.assertIn(f"\n{words} <{file.rpartition('.')[0]}>\n", text)

    def test_pictures_are_named_outside_of_code(self):
        text = ("<!-- picture: out/a.png Two\nwords. -->\n\n```text\n<!-- picture: b.png no -->\n"
                "```\n")
        self.assertEqual(pages.pictures(text), [("out/a.png", "Two words.")])

    def test_words_of_pages_are_those_that_are_read(self):
        texts = ["<script>never</script><p>Slip slip&#x2013;slip: <b>strip</b> 1234 abc</p>",
                 "<math><mi>mathematics</mi></math> est_err_fx strip"]
        self.assertEqual(document.words_of(texts), ["slip", "strip", "est_err_fx"])

    def test_ford_is_given_lengths_without_commas(self):
        for text, wanted in (
                ("character(len=f(table, row)) :: text", "character(len=f) :: text"),
                ("character(len=f(n)) :: text", None), ("character(len=*) :: a, b", None),
                ("call f(a, (b))  ! character(len=3)", None)):
            self.assertEqual(document.readable(text), wanted or text)

    def test_the_api_pages_load_nothing_from_elsewhere(self):
        page = ('<link href="https://cdn.x/a.css" rel="stylesheet"\n integrity="sha"><script\n'
                ' src="https://cdn.x/b.js" async></script><script type="text/x-mathjax-config">'
                'x</script><script src="./own.js"></script><link href="./own.css">')
        self.assertEqual(document.LOADED.sub("", page),
                         '<script src="./own.js"></script><link href="./own.css">')
