"""plots/show.py: columns of a CSV file, to read."""

import os
import sys
import unittest

from plot_samples import Folder

TABLE = """\
# faststrip 0.1.0
case,n,pmax_MPa,Fx_N,empty,status
a,1,1.23456789012E+003,-0.0000000000000000E+000,,ok
b c,12,9.8765432E-002,1.2345678E+009,,under_resolved
"""


def error(text):
    return f"{os.path.basename(sys.argv[0]) or 'plots'}: {text}\n"


class Show(unittest.TestCase):
    def shown(self, *words):
        with Folder({"a.csv": TABLE}) as folder:
            return folder.run("show", "a.csv", *words)

    def test_a_table_of_what_is_there(self):
        self.assertEqual(self.shown(), (0, (
            "case   n  pmax_MPa       Fx_N  status\n"
            "a      1     1235.         0.  ok\n"
            "b c   12   0.09877  1.235e+09  under_resolved\n"), ""))

    def test_one_row_is_turned(self):
        self.assertEqual(self.shown("pmax_MPa", "empty", "status", "--where", "n=1"), (0, (
            "pmax_MPa  1235.\n"
            "empty     -\n"
            "status    ok\n"), ""))

    def test_a_single_column_stays_one(self):
        self.assertEqual(self.shown("n", "--where", "case=a")[1], "n\n1\n")

    def test_digits(self):
        self.assertEqual(self.shown("pmax_MPa", "--digits", "7")[1],
                         "  pmax_MPa\n  1234.568\n0.09876543\n")
        self.assertEqual(self.shown("pmax_MPa", "--digits", "1")[1],
                         "pmax_MPa\n   1235.\n    0.10\n")

    def test_rows_are_chosen_by_words_and_numbers(self):
        for condition in ("case=b c", "n=12.0", "Fx_N=1.2345678e9"):
            self.assertEqual(self.shown("status", "--where", condition)[1],
                             "status\nunder_resolved\n")
        self.assertEqual(self.shown("n", "--where", "n=1", "--where", "case=b c"),
                         (1, "", error("no row with n=1 and case=b c (a.csv)")))

    def test_what_is_not_there_is_named(self):
        for words, text in ((("gone",), "missing column: gone (a.csv:2)"),
                            (("n", "--where", "gone=1"), "missing column: gone (a.csv:2)"),
                            (("n", "--where", "n"), "--where takes COLUMN=WORD, got n")):
            self.assertEqual(self.shown(*words), (1, "", error(text)))
        self.assertEqual(self.shown("n", "--digits", "0")[0], 2)
