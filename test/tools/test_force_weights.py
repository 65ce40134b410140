"""The generated module of the force correction is what its script writes of the stored fit."""

import subprocess
import sys
import unittest

from harness import ROOT

SCRIPT = ROOT / "tools" / "force_weights.py"


class ForceWeights(unittest.TestCase):
    def test_the_module_is_up_to_date(self):
        outcome = subprocess.run([sys.executable, SCRIPT, "--check"], check=False)
        self.assertEqual(0, outcome.returncode)

    def test_an_unknown_option_is_refused(self):
        outcome = subprocess.run([sys.executable, SCRIPT, "--chekc"], check=False,
                                 stderr=subprocess.PIPE)
        self.assertEqual(2, outcome.returncode)


if __name__ == "__main__":
    unittest.main()
