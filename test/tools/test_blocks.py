"""The runner of what pages show: what it takes for the same, what it refuses, how it runs."""

import os
import pathlib
import re
import tempfile
import unittest
from unittest import mock

import blocks

ROOT = pathlib.Path(__file__).resolve().parents[2]


def fence(language, text, note=""):
    return f"{note}```{language}\n{text}```\n\n"


class OfTheProject(unittest.TestCase):
    def test_every_block_runs_or_says_why_not(self):
        for path in blocks.pages():
            with self.subTest(path.name):
                self.assertEqual(blocks.problems(path.read_text(encoding="utf-8")), [])

    def test_most_blocks_run(self):
        found = [block for path in blocks.pages()
                 for block in blocks.blocks_of(path.read_text(encoding="utf-8"))
                 if block.language in ("sh", "python")]
        run = [block for block in found if block.runs()]
        self.assertGreater(len(run), 70)
        self.assertLess(len(found) - len(run), 0.25 * len(found))


class Agreement(unittest.TestCase):
    def agree(self, shown, printed):
        self.assertTrue(blocks.agree(shown, printed), (shown, printed))

    def differ(self, shown, printed):
        self.assertFalse(blocks.agree(shown, printed), (shown, printed))

    def test_numbers_within_one_of_the_last_digit(self):
        self.agree("a  1.234\n", "a 1.235\n")
        self.agree("a 1.234\n", "a 1.2339\n")
        self.agree("N 1024. x\n", "N 1025. x\n")
        self.agree("1.234e-5\n", "1.235E-05\n")
        self.agree("12.5%\n", "12.6%\n")
        self.differ("a 1.234\n", "a 1.236\n")
        self.differ("a 1.234e-5\n", "a 1.234e-4\n")
        self.differ("12.5%\n", "12.7%\n")
        self.differ("a 1.234\n", "a -1.234\n")
        self.differ("a 1.234\n", "a nan\n")

    def test_many_digits_within_a_millionth(self):
        self.agree("1.0793737699930207E-01\n", "1.0793738E-01\n")
        self.differ("1.0793737699930207E-01\n", "1.07938E-01\n")

    def test_whole_numbers_and_words_exactly(self):
        self.agree("15 strips\n", "15   strips\n")
        self.differ("15 strips\n", "16 strips\n")
        self.differ("15 strips\n", "15. strips\n")
        self.differ("ok\n", "under_resolved\n")
        self.differ("60e1\n", "61e1\n")
        self.differ("a,b\n", "a;b\n")
        self.differ("a (b)\n", "a b\n")

    def test_times_are_masked(self):
        self.agree("took 12.5 ms\n", "took 99 ms\n")
        self.differ("took 12.5 mm\n", "took 99 mm\n")

    def test_lines_count(self):
        self.differ("a\n", "a\nb\n")
        self.differ("a\nb\n", "a\n")
        self.differ("", "a\n")
        self.agree("", "")
        self.agree("a  \n\nb\n", "a\n\nb\n")

    def test_dots_stand_for_anything(self):
        self.agree("a\n...\nd\n", "a\nb\nc\nd\n")
        self.agree("a\n...\nd\n", "a\nd\n")
        self.agree("...\n", "")
        self.agree("rev ... of 2\n", "rev abc of 2\n")
        self.differ("a\n...\nd\n", "a\nb\nc\n")
        self.differ("rev ... of 2\n", "rev abc of 3\n")


class Problems(unittest.TestCase):
    def test_a_block_needs_a_language_or_a_reason(self):
        for text, words in (
            (fence("", "x\n"), "neither run nor a file"),
            (fence("c", "x\n"), "neither run nor a file"),
            (fence("sh", "x\n", "<!-- not run: -->\n") + fence("c", ""), "neither run"),
            (fence("sh", "x\n", "<!-- not run: slow -->\n"), "no reason"),
            (fence("output", "x\n"), "output of nothing"),
            (fence("sh", "x\n") + fence("output", "") + fence("output", ""), "output of nothing"),
            ("`a.c`:\n" + fence("c", "x\n", "<!-- file: a.c -->\n"), "no later block names a.c"),
            (fence("sh", "b a.c\n", "<!-- file: b -->\n") + "<!-- a.c -->\n"
             + fence("c", "x\n", "<!-- file: a.c -->\n") + fence("sh", "cat a.c\n"),
             "the words before it do not name a.c"),
            ("- a\n\n  ```sh\n  x\n  ```\n", "indented"),
            ("```sh\nx\n", "not closed"),
        ):
            with self.subTest(text):
                self.assertIn(words, "".join(blocks.problems(text)))

    def test_good_blocks_have_none(self):
        text = ("Of `a.c`:\n\n" + fence("c", "x\n", "<!-- file: a.c -->\n")
                + fence("sh", "cat a.c\n")
                + fence("output", "x\n") + fence("text", "y\n", "<!-- not run: a drawing -->\n")
                + fence("python", "print(1)\n") + fence("output", "1\n"))
        self.assertEqual(blocks.problems(text), [])
        self.assertFalse(blocks.installs(text))
        self.assertFalse(blocks.installs(fence("sh", "./run install\n", "<!-- not run: a b -->\n")))
        self.assertTrue(blocks.installs(fence("sh", "./run install --prefix a\n")))


class Running(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.page = pathlib.Path(folder.name, "page.md")

    def check(self, text, **options):
        self.page.write_text(text, encoding="utf-8")
        return blocks.check(self.page, **options)

    def test_blocks_share_a_folder_and_a_shell(self):
        self.assertEqual(self.check(
            "a.txt:\n\n" + fence("text", "one\n", "<!-- file: a.txt -->\n")
            + fence("sh", "x=$(cat a.txt)\n")
            + "words\n\n" + fence("sh", "echo $x; echo two >&2; ls -d bin/faststrip run\n")
            + fence("output", "one\ntwo\nbin/faststrip\nrun\n")), "")

    def test_nothing_is_prepared(self):
        """Not what a checkout has after later runs, nor what its users' shells know."""
        shown = fence("output", "no out\nno build\nHOME\nPATH\n")
        lines = ("for name in out build; do [ -e $name ] || echo no $name; done\n"
                 "env | grep -v '^_=\\|^PWD=\\|CACHE\\|BYTECODE\\|^SHLVL\\|^OLDPWD' | sed 's/=.*//'"
                 " | sort\n")
        with mock.patch.dict(os.environ, {"PYTHONPATH": str(ROOT / "python"), "OTHER": "1",
                                          "FASTSTRIP_PREFIX": "/", "LD_LIBRARY_PATH": "/",
                                          "PATH": f"{ROOT}/bin:{os.environ['PATH']}"}):
            self.assertEqual(self.check(fence("sh", lines) + shown), "")
            for line in ("faststrip --version", "touch out/a", "cat my.nml"):
                self.assertRegex(self.check(fence("sh", f"{line}\n")), "line 1: exit code [0-9]+, ")
            self.assertIn("No module named 'faststrip'",
                          self.check(fence("python", "import faststrip\n")))

    def test_python_runs(self):
        self.assertEqual(self.check(fence("python", "import sys\nprint(1 + 1)\n")
                                    + fence("output", "2\n")), "")

    def test_a_command_that_fails_is_told(self):
        found = self.check(fence("sh", "echo 1 >a\nfalse\necho 2\n"))
        self.assertIn("line 1: exit code 1, not 0", found)
        self.assertIn("line 5: exit code 3, not 0",
                      self.check(fence("sh", "x=1\n") + fence("sh", "sh -c 'exit 3'\n")))

    def test_exit_codes_are_compared(self):
        note = "<!-- exit: 3 -->\n"
        text = fence("sh", "echo a; exit 3\n", note) + fence("output", "a\n") + fence("sh", "x=1\n")
        self.assertEqual(self.check(text), "")
        self.assertIn("exit code 0, not 3", self.check(fence("sh", "true\n", note)))
        self.assertIn("exit code 1, not 3", self.check(fence("sh", "false\ntrue\n", note)))

    def test_what_is_printed_has_to_be_shown(self):
        self.assertIn("nothing of it is shown", self.check(fence("sh", "echo a\n")))
        self.assertIn("printed is\na\nshown is\nb\n",
                      self.check(fence("sh", "echo a\n") + fence("output", "b\n")))
        self.assertEqual(self.check(fence("sh", "echo a\n", "<!-- output not shown: long -->\n")),
                         "")

    def test_pictures_have_to_be_made(self):
        text = "<!-- picture: a.png A. -->\n"
        self.assertEqual(self.check(fence("sh", "touch a.png\n") + text), "")
        self.assertEqual(self.check(fence("sh", "true\n") + text), "no such picture: a.png")

    def test_outputs_are_written(self):
        text = (fence("sh", "echo a\n") + fence("output", "b\n") + fence("sh", "echo 2.001\n")
                + fence("output", "2.000\n") + fence("sh", "echo c\n"))
        self.assertEqual(self.check(text, write=True), "")
        # What agrees stays.
        self.assertEqual(re.findall(r"```output\n(.*?)```", self.page.read_text(encoding="utf-8"),
                                    re.DOTALL), ["a\n", "2.000\n", "c\n"])
        self.assertEqual(blocks.check(self.page), "")
