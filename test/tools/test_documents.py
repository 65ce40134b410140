"""The documents: links lead somewhere, formulas can be shown, deviations are numbered once."""

import importlib.util
import re
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

import document  # noqa: E402
import pages  # noqa: E402

PAGES = [ROOT / source for _, source, _ in document.PAGES]
LABEL = r"- \*\*([NFSPLK]\d+)\*\* "


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
        """In backticks: files of the folders that a page of the project may name."""
        name = re.compile(r"`((?:src|test|tools|reference|example|include|docs|plots|app|\.ci)/[\w./-]+)`")
        for path in PAGES:
            if path.name == "CHANGELOG.md":
                continue
            for named in name.findall(path.read_text(encoding="utf-8")):
                with self.subTest(page=path.name, named=named):
                    self.assertTrue((ROOT / named).exists())

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

    def test_every_status_word_is_explained(self):
        (status,) = (ROOT / "src").rglob("status.f90")
        words = re.findall(r"case \(st_\w+\); word = '(\w+)'", status.read_text(encoding="utf-8"))
        self.assertGreater(len(words), 20)
        text = (ROOT / "docs" / "method.md").read_text(encoding="utf-8")
        section = text.split("## Limitations and errors")[1].split("\n## ")[0]
        self.assertEqual([word for word in words if f"`{word}`" not in section], [])

    def test_every_result_column_is_explained(self):
        (source,) = (ROOT / "app").rglob("result_csv.f90")
        block = re.search(r"result_columns\(\d+\) = \[(.*?)\]", source.read_text(encoding="utf-8"),
                          re.DOTALL)[1]
        columns = re.findall(r"'(\w+)'", block)
        self.assertGreater(len(columns), 20)
        text = (ROOT / "docs" / "formats.md").read_text(encoding="utf-8")
        section = text.split("## Result CSV")[1]
        self.assertEqual([name for name in columns if f"`{name}`" not in section], [])

    def test_the_readme_is_one_to_read(self):
        lines = (ROOT / "README.md").read_text(encoding="utf-8").splitlines()
        self.assertLessEqual(len(lines), 150)

    @unittest.skipUnless(importlib.util.find_spec("markdown")
                         and importlib.util.find_spec("latex2mathml"),
                         "./run docs installs what the site is made with")
    def test_pages_become_html_with_mathml_and_no_script(self):
        for path in PAGES:
            text = path.read_text(encoding="utf-8")
            body = pages.to_html(text, lambda link: link)
            self.assertEqual(body.count("<math"), len(pages.formulas(text)), path.name)
            for left in ("@KEPT", "<script", "<merror", "\\frac", "<p>|"):
                self.assertNotIn(left, body, path.name)
            made = re.findall(r'<h\d id="([^"]+)"', body)
            self.assertEqual(made, pages.anchors(text), path.name)


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
                          "a.md: no such anchor: #gone", "a.md: no such anchor: b.md#nor-a-heading"])
        outside = self.page("[x](../)\n")
        self.assertEqual(len(pages.broken_links(outside, self.folder)), 1)

    def test_formulas_are_found_and_doubted(self):
        text = "$x$ and `$no$` and\n\n$$\n\\frac{a}{b}\n$$\n\n```\n$no$ \n```\n"
        self.assertEqual(pages.formulas(text), [("\\frac{a}{b}", True), ("x", False)])
        self.assertEqual(pages.strange_formulas(text), [])
        for bad in ("\\unheard{x}", "\\frac{a}{b", "a & b", "\\left( x", "|x|"):
            self.assertEqual(pages.strange_formulas(f"${bad}$\n"), [bad])

    def test_the_api_pages_load_nothing_from_elsewhere(self):
        page = ('<link href="https://cdn.x/a.css" rel="stylesheet"\n integrity="sha"><script\n'
                ' src="https://cdn.x/b.js" async></script><script type="text/x-mathjax-config">'
                'x</script><script src="./own.js"></script><link href="./own.css">')
        self.assertEqual(document.LOADED.sub("", page),
                         '<script src="./own.js"></script><link href="./own.css">')


if __name__ == "__main__":
    unittest.main()
