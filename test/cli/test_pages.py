"""What the pages show is run and printed so, as users run it: in order, with nothing prepared."""

import unittest

import blocks
from cli_program import ROOT


class Pages(unittest.TestCase):
    """A test a page; those that install are in test/embed."""


def test_of(path):
    return lambda self: self.assertEqual(blocks.check(path), "")


for page in blocks.pages():
    if not blocks.installs(page.read_text(encoding="utf-8")):
        setattr(Pages, f"test_{page.relative_to(ROOT).with_suffix('')}", test_of(page))
