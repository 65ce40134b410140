"""What FORD would take for something else than words, found without FORD."""

import re
import unittest

from installed import ROOT

METADATA = re.compile(r"\A!> ?[\w-]+:\s")


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
