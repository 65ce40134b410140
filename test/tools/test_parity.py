"""The page of parity with other codes: as its data say, and what it points to exists."""

import pathlib
import subprocess
import sys
import tempfile
import tomllib
import unittest

import parity

ROOT = pathlib.Path(__file__).resolve().parents[2]


def stated(**feature):
    """Data of one code and one feature."""
    return {"codes": {"other": {"name": "Other", "document": "A paper"}},
            "group": [{"name": "Contact", "feature": [
                {"name": "Patch", "faststrip": "has", "evidence": ["docs/method.md"], **feature}]}]}


class OfTheProject(unittest.TestCase):
    def test_the_page_is_as_the_data_say_and_its_evidence_exists(self):
        done = subprocess.run([sys.executable, ROOT / "tools/generate/parity.py", "--check"],
                              capture_output=True, encoding="utf-8", check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_every_feature_is_stated_of_every_code(self):
        with open(ROOT / parity.DATA, "rb") as file:
            codes, groups = parity.read(tomllib.load(file))
        text = (ROOT / parity.PAGE).read_text(encoding="utf-8")
        features = [feature for group in groups for feature in group["feature"]]
        self.assertGreater(len(features), 30)
        for feature in features:
            row, = (line for line in text.splitlines() if line.startswith(f"| {feature['name']} |"))
            words = row.strip("| ").split(" | ")[1:]
            self.assertEqual(len(words), 1 + len(codes))
            self.assertNotEqual(words[0], "?", feature["name"])
        # What is lacking here stands there, too.
        self.assertGreater(sum(parity.state(feature, "faststrip")[0] == "lacks"
                               for feature in features), 4)


class Read(unittest.TestCase):
    def test_what_is_wrong_is_refused_by_name(self):
        parity.read(stated(other="has @ Section 2"))
        for feature, words in (
                ({"other": "has"}, "Patch: other has it, and no section says so"),
                ({"other": "may @ Section 2"}, "Patch: other must be one of has, lacks, differs,"
                                               " got may"),
                ({"another": "lacks"}, "Patch: no such code: another"),
                ({"evidence": []}, "Patch: faststrip has it, and nothing shows it")):
            with self.assertRaisesRegex(ValueError, words):
                parity.read(stated(**feature))

    def test_evidence_that_does_not_exist_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "test.py").write_text("def test_a_patch():\n", encoding="utf-8")
            groups = stated(evidence=["test.py::test_a_patch", "test.py::test_a", "none.md"])
            self.assertEqual(list(parity.missing(groups["group"], root)),
                             ["Patch: no such test or file: test.py::test_a",
                              "Patch: no such test or file: none.md"])

    def test_the_same_words_of_several_codes_stand_once(self):
        feature = stated(other="differs: by a table @ Section 2")["group"][0]["feature"][0]
        codes = {"other": {"name": "Other"}, "third": {"name": "Third"}}
        feature["third"] = feature["other"]
        self.assertEqual(parity.details(feature, codes),
                         "- **Patch.** Other, Third: by a table; *Section 2*. Shown by"
                         " [docs/method.md](method.md).")
