"""test/shared_runs.py: the same run is done once, another one anew, by several processes too."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import shared_runs
from harness import ROOT

# Notes each of its runs, says its words, copies in.txt twice and ends with its last word.
PROGRAM = """\
#!/bin/sh
echo run >>"{folder}/runs"
{slow}
echo "$@"
echo more >&2
if [ -e in.txt ]; then
    mkdir -p below
    cat in.txt in.txt >below/out.txt
fi
for last in "$@"; do :; done
exit "$last"
"""
# Asks for a run and says what it found.
ASKING = """\
import pathlib, sys
sys.path.insert(0, sys.argv[1])
from shared_runs import shared_run
done = shared_run([sys.argv[2], "0"], {"in.txt": b"x"}, 600)
print(done.stdout, done.made)
"""
# Makes a folder and says what is in it.
MAKING = """\
import sys, time
sys.path.insert(0, sys.argv[1])
from shared_runs import made_once
def make(folder):
    time.sleep(0.5)
    with open(folder / "made", "a") as stream:
        stream.write("x")
print(made_once("folder", make).joinpath("made").read_text())
"""


class Shared(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        (self.folder / "kept").mkdir()
        patch = mock.patch.dict(os.environ, {shared_runs.PLACE: str(self.folder / "kept")})
        patch.start()
        self.addCleanup(patch.stop)
        shared_runs.place.cache_clear()
        self.addCleanup(shared_runs.place.cache_clear)
        self.program("program")

    def program(self, name, slow=""):
        path = self.folder / name
        path.write_text(PROGRAM.format(folder=self.folder, slow=slow), encoding="utf-8")
        path.chmod(0o755)

    def run_it(self, *words, name="program", **found):
        found = {f"{key}.txt": data for key, data in found.items()}
        return shared_runs.shared_run([self.folder / name, *words], found, 600)

    def runs(self):
        return len((self.folder / "runs").read_text(encoding="utf-8").splitlines())

    def test_a_run_is_done_once_and_told_in_full(self):
        first = self.run_it("a", 3, **{"in": b"\xff\n"})
        self.assertEqual(first, shared_runs.SharedRun(3, "a 3\n", "more\n",
                                                      {"below/out.txt": b"\xff\n\xff\n"}))
        first.made.clear()
        self.assertEqual(self.run_it("a", 3, **{"in": b"\xff\n"}).made,
                         {"below/out.txt": b"\xff\n\xff\n"})
        self.assertEqual(self.runs(), 1)
        # Nothing is left but what is kept.
        self.assertEqual(len(list((self.folder / "kept").iterdir())), 2)

    def test_whatever_decides_about_a_run_makes_another_one(self):
        self.run_it("a", 0)
        self.run_it("b", 0)
        self.run_it("a", 0, **{"in": b"1"})
        self.assertEqual(self.run_it("a", 0, **{"in": b"2"}).made, {"below/out.txt": b"22"})
        self.run_it("a", 0, other=b"2")
        self.assertEqual(self.runs(), 5)
        self.program("program", slow="# Other bytes.")
        self.run_it("a", 0)
        self.assertEqual(self.runs(), 6)
        # The same bytes elsewhere may find other files beside them.
        self.program("another", slow="# Other bytes.")
        self.run_it("a", 0, name="another")
        self.assertEqual(self.runs(), 7)

    def test_a_file_that_is_written_anew_is_made_and_one_left_alone_is_not(self):
        self.program("program", slow="echo new >other.txt")
        self.assertEqual(self.run_it(0, other=b"old\n", more=b"kept\n").made,
                         {"other.txt": b"new\n"})

    def test_a_run_that_did_not_end_is_done_again(self):
        self.program("program", slow=f"[ -e {self.folder}/ready ] || exec sleep 600")
        with self.assertRaises(subprocess.TimeoutExpired):
            shared_runs.shared_run([self.folder / "program", 0], {}, 0.2)
        (self.folder / "ready").touch()
        self.assertEqual(self.run_it(0).stdout, "0\n")

    def test_two_processes_share_a_run(self):
        self.program("slow", slow="sleep 0.5")
        words = [sys.executable, "-c", ASKING, ROOT / "test", self.folder / "slow"]
        asking = [subprocess.Popen(words, stdout=subprocess.PIPE, text=True) for _ in range(3)]
        said = {process.communicate()[0] for process in asking}
        self.assertEqual(said, {"0\n {'below/out.txt': b'xx'}\n"})
        self.assertEqual(self.runs(), 1)

    def test_a_folder_is_made_by_one_process_and_again_if_it_could_not_be(self):
        with self.assertRaises(ZeroDivisionError):
            shared_runs.made_once("folder", lambda folder: 1 / 0)
        making = [subprocess.Popen([sys.executable, "-c", MAKING, ROOT / "test"],
                                   stdout=subprocess.PIPE, text=True) for _ in range(3)]
        self.assertEqual({process.communicate()[0] for process in making}, {"x\n"})

    def test_without_a_place_runs_last_as_long_as_the_process(self):
        words = [sys.executable, "-c", ASKING, ROOT / "test", self.folder / "program"]
        environment = {name: value for name, value in os.environ.items()
                       if name != shared_runs.PLACE}
        environment["TMPDIR"] = str(self.folder / "kept")
        for _ in range(2):
            done = subprocess.run(words, stdout=subprocess.PIPE, text=True, check=True,
                                  env=environment)
            self.assertIn("b'xx'", done.stdout)
        self.assertEqual(self.runs(), 2)
        self.assertEqual(list((self.folder / "kept").iterdir()), [])
