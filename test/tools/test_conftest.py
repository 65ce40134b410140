"""What test/conftest.py adds to pytest: counts in one line, TEXT, shared runs."""

import os
import pathlib
import re
import sys
import tempfile
import unittest
from unittest import mock

from harness import ROOT, run

MIXED = """\
import unittest


class Mixed(unittest.TestCase):
    def test_passes(self):
        pass

    def test_fails(self):
        self.fail("on purpose")

    def test_breaks(self):
        raise ValueError("on purpose")

    @unittest.skip("on purpose")
    def test_is_skipped(self):
        self.fail("not reached")

    def test_fails_in_parts(self):
        for i in range(3):
            with self.subTest(i):
                self.assertEqual(i, 1)

    @unittest.expectedFailure
    def test_surprises(self):
        pass


class Unready(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        raise ValueError("on purpose")

    def test_never_starts(self):
        pass
"""
GOOD = """\
import unittest


class Good(unittest.TestCase):
    def test_passes(self):
        pass
"""
# Says where runs are shared.
SHARING = GOOD + """\
        import os
        import pathlib
        pathlib.Path(os.environ["FASTSTRIP_SHARED_RUNS"], __name__).touch()
        with open({list!r}, "a") as stream:
            stream.write(os.environ["FASTSTRIP_SHARED_RUNS"] + chr(10))
"""


class Counted(unittest.TestCase):
    def check(self, files, code, counts, *arguments):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for module in ("conftest.py", "pytest.ini"):
                files[module] = (ROOT / "test" / module).read_text(encoding="utf-8")
            for path, text in files.items():
                (folder / path).parent.mkdir(parents=True, exist_ok=True)
                (folder / path).write_text(text, encoding="utf-8")
            done = run([sys.executable, "-m", "pytest", *arguments, folder], folder)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.assertIn(f"\n{'all modules together:':43} {counts}\n", done.stdout)
        return done.stdout

    def test_every_way_to_fail_counts_once(self):
        for jobs in ("0", "2"):
            said = self.check({"a/test_mixed.py": MIXED}, 1, "1 passed, 5 failed, 1 skipped",
                              "-n", jobs)
            self.assertIn("ValueError: on purpose", said)
            for name in ("Mixed.test_breaks", "Mixed.test_fails_in_parts",
                         "Unready.test_never_starts"):
                self.assertEqual(said.count(f"\nFAILED a/test_mixed::{name}\n"), 1, said)

    def test_a_module_that_cannot_be_imported_fails(self):
        files = {"a/test_bad.py": "import no_such_module\n"}
        said = self.check(files, 2, "0 passed, 1 failed")
        self.assertIn("no_such_module", said)
        self.assertIn("\nFAILED a/test_bad::\n", said)

    def test_a_test_that_ends_its_process_fails(self):
        files = {"a/test_end.py": GOOD.replace("pass\n", "import os; os._exit(3)\n"),
                 "a/test_good.py": GOOD}
        self.assertIn("crashed", self.check(files, 1, "1 passed, 1 failed", "-n", "2"))

    def test_a_text(self):
        files = {"a/test_mixed.py": MIXED, "b/test_same.py": GOOD, "a/test_same.py": GOOD}
        self.check(files, 0, "1 passed, 0 failed", "--text", "test/b/test_same")
        self.check(files, 0, "3 passed, 0 failed", "--text", ".test_passes")
        self.check(files, 5, "0 passed, 0 failed", "--text", "unknown")

    def test_a_folder_for_shared_runs_is_there_for_all_and_goes(self):
        for jobs in ("0", "2"):
            with tempfile.NamedTemporaryFile("r", encoding="utf-8") as places, \
                    mock.patch.dict(os.environ):
                os.environ.pop("FASTSTRIP_SHARED_RUNS", None)
                text = SHARING.replace("{list!r}", repr(places.name))
                self.check({"a/test_first.py": text, "a/test_second.py": text}, 0,
                           "2 passed, 0 failed", "-n", jobs)
                found = re.findall(".+", places.read())
            self.assertEqual((len(found), len(set(found))), (2, 1))
            self.assertFalse(pathlib.Path(found[0]).exists())
