"""Tuned numbers: named, with unit and origin, listed in the docs; bare ones are refused."""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import constants
import sensitivity

ROOT = pathlib.Path(__file__).resolve().parents[2]

TAG = "! What it is. Tuned [mm]. Origin: chosen.\n"


def read(text, file="src/faststrip/normal/strip/strip.f90"):
    return constants.read_file(file, text)


class OfTheProject(unittest.TestCase):
    def test_no_number_of_the_rooms_is_bare(self):
        found, wrong = constants.read_rooms(ROOT)
        self.assertEqual(wrong, [])
        self.assertGreater(len(found), 300)
        self.assertEqual(len({constant.key for constant in found}), len(found))

    def test_the_page_is_as_the_sources_say(self):
        done = subprocess.run([sys.executable, ROOT / "tools/check/constants.py", "--check"],
                              capture_output=True, encoding="utf-8", check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_what_was_measured_belongs_to_the_numbers_of_today(self):
        found, _ = constants.read_rooms(ROOT)
        measured = constants.read_measured(ROOT)
        self.assertIn(("", "", ""), measured)
        rows = [row for row in (constants.row_for(one, measured) for one in found) if row]
        self.assertGreater(len(rows), 20)
        for row in rows:
            for factor in sensitivity.FACTORS:
                self.assertIn(row[f"{factor}_outcome"], ("ok", "fails", "does not compile"))

    def test_a_bare_number_in_a_room_ends_the_tool(self):
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder)
            for room in constants.ROOMS:
                (copy / room).parent.mkdir(parents=True, exist_ok=True)
                copied = shutil.copy if room.endswith(".f90") else shutil.copytree
                copied(ROOT / room, copy / room)
            path = copy / "src/faststrip/normal/strip/figures.f90"
            text = path.read_text(encoding="utf-8")
            path.write_text(text.replace("correction = 1.0_wp", "correction = 1.7_wp"),
                            encoding="utf-8")
            done = subprocess.run([sys.executable, ROOT / "tools/check/constants.py", "--bare",
                                   "--root", copy], capture_output=True, encoding="utf-8",
                                  check=False)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"strip/figures\.f90:\d+: bare number 1\.7_wp")


class Rule(unittest.TestCase):
    def test_bare_numbers_are_refused_wherever_they_stand(self):
        for line in ("x = 0.37_wp*y", "x = 1.0e-3", "x = 1d-3*y", "x = .3_wp", "x = y**7",
                     "x = y + 5e0_wp", "if (n > 12) return", "do i = 1, 60", "n = max(3, 17)",
                     "call solve(x, 60)", "data x /0.3/", "parameter (n = 17)",
                     "x = a(3)*0.7_wp", "x = y &\n    + 0.7_wp", "case (7)", "n = 100_int64*m",
                     "x = 1.0_wp; y = 0.7_wp", "x = merge(0.3_wp, 1.0_wp, ok)",
                     "where (x > 0.1_wp) x = 0.0_wp"):
            with self.subTest(line):
                self.assertTrue(read(f"subroutine s\n{line}\nend\n")[1])

    def test_plain_numbers_subscripts_and_words_may_stand(self):
        for line in ("x = 2.0_wp/3.0_wp*y", "x = 0.5_wp*a(17)", "x = y**2", "x = 0.25e0_wp*y",
                     "x = '0.37' ! 0.37", "allocate (a(60))", "x = c%list(i, 12)%y3", "x1 = y2e5",
                     "real(wp) :: a(60), b", "character(len=80) :: line",
                     "x = 6.0_wp*y ! Given: a moment", "! Given: a moment\nx = 6.0_wp*y"):
            with self.subTest(line):
                self.assertEqual(read(f"subroutine s\n{line}\nend\n")[1], [])

    def test_constants_need_a_tag_of_their_own(self):
        plain = "real(wp), parameter :: a = 0.37_wp\n"
        for text in (plain, "integer, parameter :: n = 3\n", "real(wp) :: a = 0.37_wp\n",
                     "real(wp), parameter :: a = 0.5_wp\n", "integer :: n = 15 !! strips\n",
                     "real(wp), parameter :: a = 0.3_wp*b\n", TAG + "\n" + plain,
                     TAG + "real(wp), parameter :: b = 0.1_wp\n" + plain,
                     "! Tuned [mm]: what it is.\n" + plain, "! Origin: chosen.\n" + plain,
                     "! Tuned: what. Origin: chosen.\n" + plain,
                     "! Tuned [mm]. Origin: nobody says what it is.\n" + plain,
                     "! Given: numbers of kinds.\ninteger, parameter :: k = 1\n" + plain,
                     "real(wp), parameter :: &\n    a = 0.37_wp\n",
                     "logical, parameter :: l = b > 0.3_wp\n"):
            with self.subTest(text):
                self.assertTrue(read(text)[1])

    def test_constants_with_a_tag_are_listed_with_it(self):
        text = ("! Tuned [mm]: what it is.\n!   Origin: it was\n! chosen.\n"
                "real(wp), parameter :: a = 0.37_wp, &  ! first\n    b(2) = [0.5_wp, 1.0e3_wp]\n")
        (a, b), wrong = read(text)
        self.assertEqual(wrong, [])
        self.assertEqual((a.name, a.value, a.unit, a.what, a.origin),
                         ("a", "0.37_wp", "mm", "what it is. first", "it was chosen."))
        self.assertEqual((b.name, b.value), ("b", "[0.5_wp, 1.0e3_wp]"))
        for text in (TAG + "integer :: n = 15 !! strips\n", "real(wp), parameter :: c = 0.5_wp*a\n",
                     "integer :: n = 0\n", "! Given: numbers of kinds.\n"
                     "integer, parameter :: k = 1 !! one\ninteger, parameter :: l = 2\n"):
            self.assertEqual(read(text)[1], [], text)


class Halves(unittest.TestCase):
    def test_one_number_is_changed_and_no_other(self):
        text = (TAG + "real(wp), parameter :: a = 0.37_wp, b(2) = [0.1_wp, & ! a = 1\n"
                "    0.2_wp] ! b\n" + TAG + "integer, parameter :: n = 15 ! strips\n")
        (a, b, n), wrong = read(text)
        self.assertEqual(wrong, [])
        for one, old, half, double in (
                (a, "a = 0.37_wp", "a = 0.5_wp*(0.37_wp)", "a = 2.0_wp*(0.37_wp)"),
                (n, "n = 15", "n = (15)/2", "n = 2*(15)")):
            self.assertEqual(sensitivity.changed(text, one, "half"), text.replace(old, half, 1))
            self.assertEqual(sensitivity.changed(text, one, "double"),
                             text.replace(old, double, 1))
        self.assertIn("b(2) = 2.0_wp*([0.1_wp, &", sensitivity.changed(text, b, "double"))
        self.assertIn("0.2_wp]) ! b", sensitivity.changed(text, b, "double"))
