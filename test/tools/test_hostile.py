"""Hostile inputs end with one line and harm no file; what judges them sees what goes wrong."""

import contextlib
import io
import pathlib
import shutil
import tempfile
import unittest
from unittest import mock

import hostile
import other_user

# Generous: the machine may be ten times slower.
SECONDS = "200"


class Hostile(unittest.TestCase):
    def tried(self, *words):
        """What is said of inputs of which none may be wrong."""
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            code = hostile.main([*words, "--seconds", SECONDS])
        self.assertEqual(code, 0, said.getvalue())
        return said.getvalue()

    def test_a_hundred(self):
        self.tried("100", "--seed", "20")

    def test_settings_of_the_run_time_library(self):
        self.tried("24", "--family", "environments")

    def test_permissions_in_a_checkout_that_others_cannot_enter(self):
        why = other_user.why_not(hostile.PROGRAM)
        if why:
            self.skipTest(why)
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(hostile.PROGRAM.parent, pathlib.Path(folder, "bin"))
            pathlib.Path(folder).chmod(0o700)
            program = pathlib.Path(folder, "bin", hostile.PROGRAM.name)
            with mock.patch.object(hostile, "PROGRAM", program):
                said = self.tried("14", "--family", "permissions")
        self.assertIn("14 hostile inputs", said)
        self.assertNotIn("in the place of permissions", said)

    def test_where_no_other_user_can_run_the_program_it_is_said(self):
        with mock.patch.object(other_user, "why_not", return_value="not here"):
            said = self.tried("3", "--family", "permissions")
        self.assertIn("\nin the place of permissions other paths were tried: not here\n",
                      f"\n{said}")

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
