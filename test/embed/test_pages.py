"""What the pages show is run and printed so: those that install; docstrings of Python."""

import sys
import unittest

from installed import ROOT, HostTest, blocks


class Pages(unittest.TestCase):
    """A test a page."""


def test_of(path):
    return lambda self: self.assertEqual(blocks.check(path), "")


for page in blocks.pages():
    if blocks.installs(page.read_text(encoding="utf-8")):
        setattr(Pages, f"test_{page.relative_to(ROOT).with_suffix('')}", test_of(page))


class Docstrings(HostTest):
    def test_the_examples_of_all_modules(self):
        """Every module that has examples, whatever it is called."""
        found = 0
        python = ROOT / "python"
        for path in sorted((python / "faststrip").rglob("*.py")):
            if ">>> " not in path.read_text(encoding="utf-8"):
                continue
            found += 1
            module = ".".join(path.relative_to(python).with_suffix("").parts)
            module = module.removesuffix(".__init__")
            with self.subTest(module):
                self.shell(f"'{sys.executable}' -c 'import doctest, sys, {module}; "
                           f"found = doctest.testmod(sys.modules[\"{module}\"]); "
                           "sys.exit(found.failed or not found.attempted)'",
                           PYTHONPATH=str(ROOT / "python"))
        self.assertGreaterEqual(found, 3)
