"""What tools/run_pytests.py counts and returns."""

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
# What a file runs takes processor time, whatever else the machine does.
BUSY = """\
import subprocess
import sys
subprocess.run([sys.executable, "-c",
                "import time\\nwhile time.process_time() < 0.3: pass"], check=True)
"""
# Says where runs are shared, and leaves something there.
SHARING = """\
import os
import pathlib
import unittest


class Sharing(unittest.TestCase):
    def test_a_place(self):
        place = pathlib.Path(os.environ["FASTSTRIP_SHARED_RUNS"])
        print(f"shared in {place}, {len(list(place.iterdir()))} before")
        (place / __name__).touch()
"""


class Runs(unittest.TestCase):
    def check(self, files, code, counts, *arguments):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for path, text in files.items():
                (folder / path).parent.mkdir(parents=True, exist_ok=True)
                (folder / path).write_text(text, encoding="utf-8")
            folders = sorted({str(pathlib.Path(path).parent) for path in files})
            command = [sys.executable, ROOT / "tools" / "run_pytests.py", *arguments, *folders]
            result = run(command, folder)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        last = result.stdout.splitlines()[-1]
        self.assertEqual(last, f"{'all modules together:':43} {counts}", result.stdout)
        return result.stdout

    def test_passing(self):
        self.check({"a/test_good.py": GOOD}, 0, "1 passed, 0 failed")

    def test_every_way_to_fail_counts_once(self):
        said = self.check({"a/test_mixed.py": MIXED}, 1, "1 passed, 5 failed, 1 skipped")
        self.assertIn("ValueError: on purpose", said)

    def test_a_skip_says_why(self):
        said = self.check({"a/test_mixed.py": MIXED}, 1, "0 passed, 0 failed, 1 skipped",
                          "--filter", "is_skipped")
        self.assertRegex(said, r"(?m)^skipped \S+\.test_is_skipped: on purpose$")
        whole = GOOD.replace("    def", "    @classmethod\n    def setUpClass(cls):\n"
                             "        raise unittest.SkipTest('not here')\n\n    def")
        said = self.check({"a/test_good.py": whole}, 1, "0 passed, 0 failed, 1 skipped")
        self.assertRegex(said, r"(?m)^skipped setUpClass \S+: not here$")

    def test_same_name_in_two_folders(self):
        files = {"a/test_same.py": GOOD, "b/test_same.py": GOOD}
        self.check(files, 0, "2 passed, 0 failed")

    def test_a_file_that_cannot_be_imported_fails(self):
        said = self.check({"a/test_bad.py": "import no_such_module\n"}, 1, "0 passed, 1 failed")
        self.assertIn("no_such_module", said)

    def test_nothing_to_run_fails(self):
        self.check({"a/helper.py": GOOD}, 1, "0 passed, 0 failed")
        self.check({"a/test_good.py": GOOD}, 1, "0 passed, 0 failed", "--filter", "unknown")

    def test_files_beside_folders(self):
        with tempfile.TemporaryDirectory() as name:
            for path in ("test_one.py", "test_two.py"):
                (pathlib.Path(name) / path).write_text(GOOD, encoding="utf-8")
            runner = ROOT / "tools" / "run_pytests.py"
            result = run([sys.executable, runner, f"{name}/test_two.py"], name)
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertRegex(result.stdout, r"\A\S*/test_two +1 passed, 0 failed\nall modules")

    def test_several_at_a_time_count_the_same(self):
        files = {"a/test_mixed.py": MIXED, "a/test_bad.py": "import no_such_module\n",
                 "b/test_good.py": GOOD, "b/test_more.py": GOOD}
        said = self.check(files, 1, "3 passed, 6 failed, 1 skipped", "--jobs", "3", "--whole", "b")
        self.assertIn("ValueError: on purpose", said)
        self.assertIn("no_such_module", said)
        self.assertRegex(said, r"(?m)^b/test_good +1 passed, 0 failed\nb/test_more +1 passed")
        self.check(files, 0, "2 passed, 0 failed", "--jobs", "2", "--filter", "b/")

    def test_times_are_of_each_file_and_of_what_it_runs(self):
        files = {"a/test_busy.py": BUSY + GOOD, "a/test_good.py": GOOD}
        for jobs in ("1", "2"):
            said = self.check(files, 0, "2 passed, 0 failed", "--jobs", jobs, "--times")
            busy, good = (float(re.search(rf"(?m)^a/test_{name} .* 0 failed, (\S+) s$", said)[1])
                          for name in ("busy", "good"))
            self.assertGreaterEqual(busy, 0.3)
            self.assertLess(good, busy)

    def test_a_folder_for_shared_runs_is_there_for_all_and_goes(self):
        files = {"a/test_first.py": SHARING, "a/test_second.py": SHARING}
        for jobs in ("1", "2"):
            with mock.patch.dict(os.environ):
                os.environ.pop("FASTSTRIP_SHARED_RUNS", None)
                said = self.check(files, 0, "2 passed, 0 failed", "--jobs", jobs)
            places, before = zip(*re.findall(r"(?m)^shared in (.*), (\d) before$", said))
            self.assertEqual((len(places), len(set(places))), (2, 1))
            self.assertFalse(pathlib.Path(places[0]).exists())
            if jobs == "1":
                self.assertEqual(before, ("0", "1"))

    def test_a_file_that_ends_its_process_fails(self):
        files = {"a/test_end.py": "import os\nos._exit(3)\n", "a/test_good.py": GOOD}
        said = self.check(files, 1, "1 passed, 1 failed", "--jobs", "2")
        self.assertIn("test_end.py: exit code 3", said)

    def test_a_filter(self):
        files = {"a/test_mixed.py": MIXED, "b/test_good.py": GOOD}
        self.check(files, 0, "1 passed, 0 failed", "--filter", "b/test_good")
        self.check(files, 0, "2 passed, 0 failed", "--filter", ".test_passes")


if __name__ == "__main__":
    unittest.main()
