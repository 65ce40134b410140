"""tools/check/wheelset_smoothness.py: its figures by hand, and a short sweep of the program."""

import contextlib
import io
import pathlib
import tempfile
import unittest

import wheelset_smoothness

CASE = "&wheel\n profile='s1002'\n/\n&rail\n profile='60e1'\n/\n&material\n mu=0.3\n/\n"


class Figures(unittest.TestCase):
    def test_largest_step_and_second_difference(self):
        states = [(0.0, 1.0, 10.0, 1, "ok"), (0.1, 3.0, 10.0, 1, "ok"),
                  (0.2, 9.0, 11.0, 2, "ok"), (0.3, None, None, 0, "no_contact"),
                  (0.4, 99.0, 99.0, 1, "ok")]
        lines = wheelset_smoothness.report(states, 100.0)
        self.assertIn("5 states from 0 to 0.4 mm in 100 um: 4 ok, 1 no_contact", lines[0])
        self.assertIn("Fy: largest step 6 N at 0.1000 mm", lines[1])
        self.assertIn("Fy: largest second difference 4 N at 0.1000 mm", lines[2])
        # Nothing is compared across a state that failed.
        self.assertIn("N: largest step 1 N", lines[3])

    def test_a_sweep(self):
        with tempfile.TemporaryDirectory() as folder:
            case, steps = pathlib.Path(folder, "case.nml"), pathlib.Path(folder, "steps.csv")
            case.write_text(CASE, encoding="utf-8")
            out = io.StringIO()
            with contextlib.redirect_stdout(out):
                wheelset_smoothness.main([str(case), "--from", "0", "--to", "0.01", "-o",
                                          str(steps)])
            self.assertIn("11 states from 0 to 0.01 mm in 1 um: 11 ok", out.getvalue())
            self.assertEqual(len(steps.read_text(encoding="utf-8").splitlines()), 12)
            with self.assertRaises(SystemExit):
                wheelset_smoothness.main([str(case.with_name("none.nml"))])
