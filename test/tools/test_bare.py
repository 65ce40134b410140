"""./run bare: what it lays into the bare machine, what it says, and why it cannot be tried."""

import contextlib
import io
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import bare
import debian


class Bare(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name, "bare")

    def said(self, *words):
        """Exit code, and what was said, of the tool with the folder."""
        out, err = io.StringIO(), io.StringIO()
        with mock.patch.object(sys, "argv", ["bare.py", *words, str(self.folder)]), \
                contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = bare.main()
        return code, out.getvalue(), err.getvalue()

    def test_why_it_cannot_be_tried_is_one_line(self):
        done = subprocess.CompletedProcess([], 1, "", "unshare: not permitted\n")
        fine = subprocess.CompletedProcess([], 0, "", "")
        for user, made, offered, says in (
                (1000, fine, "", "only root can make a bare machine"),
                (0, done, "", "no namespace of mounts here: unshare: not permitted"),
                (0, fine, "no such package", "no debootstrap: no such package")):
            with mock.patch.object(os, "geteuid", return_value=user), \
                    mock.patch.object(bare.subprocess, "run", return_value=made), \
                    mock.patch.object(bare.shutil, "which", return_value=None), \
                    mock.patch.object(debian, "install", return_value=offered):
                self.assertEqual(self.said(), (2, "", f"bare: {says}\n"))

    def test_a_system_half_made_does_not_stay(self):
        def half(words, **_):
            if words[0] == "debootstrap":
                (self.folder / "bin").mkdir()
                (self.folder / "bin" / "sh").touch()
            return subprocess.CompletedProcess(words, words[0] == "debootstrap", "E: no net\n", "")

        with mock.patch.object(os, "geteuid", return_value=0), \
                mock.patch.object(bare.shutil, "which", return_value="/usr/sbin/debootstrap"), \
                mock.patch.object(bare.subprocess, "run", side_effect=half):
            code, _, err = self.said()
        self.assertEqual((code, err), (2, "bare: debootstrap: E: no net\n"))
        self.assertFalse(self.folder.exists())

    def runs(self, *words, fails=""):
        """What is run inside a machine that is ready, by whom, and what is said of it."""
        run = []

        def inside(_, user, line):
            run.append((user, line))
            bad = fails and fails in line
            return (1, "2 passed, 1 failed") if bad else (0, "3 passed, 0 failed")

        with mock.patch.object(bare, "need"), mock.patch.object(bare, "take_along"), \
                mock.patch.object(bare, "run_inside", side_effect=inside):
            code, out, _ = self.said(*words)
        return code, out, [(user, line.split("&& ")[-1]) for user, line in run if "./run" in line]

    def test_both_users_run_both_commands_on_the_files_of_the_checkout(self):
        code, out, run = self.runs()
        self.assertEqual((code, run), (0, [("root", "./run demo"), ("root", "./run test"),
                                           ("tester", "./run demo"), ("tester", "./run test")]))
        self.assertRegex(out, r"\ntester +\./run test +green +3 passed, 0 failed\n\Z")
        for home in ("root", "home/tester"):
            place = self.folder / home / "faststrip"
            self.assertTrue(os.access(place / "run", os.X_OK))
            self.assertTrue((place / "reference").is_dir())
            for name in (".git", ".venv", "build", "bin", "app/build"):
                self.assertFalse((place / name).exists(), name)

    def test_what_fails_is_told(self):
        code, out, run = self.runs("--text", "a b", fails="./run test")
        self.assertEqual((code, len(run)), (1, 2))
        self.assertRegex(out, r"\nroot +\./run test 'a b' +exit code 1 +2 passed, 1 failed\n")
