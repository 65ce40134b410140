"""Hostile inputs end with one line and harm no file; what judges them sees what goes wrong."""

import contextlib
import io
import sys
import unittest

from harness import ROOT

sys.path.insert(0, str(ROOT / "tools"))
import hostile  # noqa: E402
import side_files  # noqa: E402

# Generous: the machine may be ten times slower.
SECONDS = "200"


class Hostile(unittest.TestCase):
    def test_a_hundred(self):
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            code = hostile.main(["100", "--seed", "20", "--seconds", SECONDS])
        self.assertEqual(code, 0, said.getvalue())

    def test_files_of_its_own(self):
        """Whatever lies where the program makes files, in each role, place and spelling."""
        wrong = [(str(attempt), *found) for i in range(len(side_files.tries()))
                 if (found := hostile.run(attempt := hostile.side_files(None, i),
                                          float(SECONDS)))[0]]
        self.assertGreater(len(side_files.tries()), 700)
        self.assertEqual(wrong, [])

    def test_the_same_seed_gives_the_same_inputs(self):
        one, two = ([(attempt.words, attempt.files) for _, attempt in hostile.attempts(60, seed)]
                    for seed in (3, 3))
        self.assertEqual(one, two)
        other = [(attempt.words, attempt.files) for _, attempt in hostile.attempts(60, 4)]
        self.assertNotEqual(one, other)


class Judge(unittest.TestCase):
    def wrong(self, code=1, seconds=0.1, err="faststrip: no such file: x\n", changes=(), **about):
        attempt = hostile.Try("case values", ["contact", "x"], **about)
        return hostile.judge(attempt, code, seconds, err, set(changes), 10.0)

    def test_what_is_right(self):
        self.assertEqual(self.wrong(), [])
        self.assertEqual(self.wrong(err="faststrip: work, 1 s\nfaststrip: no\n"), [])
        self.assertEqual(self.wrong(code=0, err="", changes=["o.csv"], may_pass=True), [])

    def test_what_is_wrong(self):
        for found in (dict(code=0), dict(code=2), dict(code=-11), dict(err=""),
                      dict(err="faststrip: a\nfaststrip: b\n"), dict(err="bad\n"),
                      dict(err="faststrip: \x1b[31m\n"), dict(changes=["gap.csv"]),
                      dict(seconds=11.0), dict(err="faststrip: Fortran runtime error: x\n"),
                      dict(err="faststrip: x\n", code=0, changes=["gap.csv"])):
            self.assertNotEqual(self.wrong(**found), [], found)
