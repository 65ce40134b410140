"""Generated modules are what their scripts write of the numbers that are stored."""

import subprocess
import sys
import unittest

from harness import ROOT

SCRIPTS = ("kalker_table.py", "force_weights.py")


class GeneratedModules(unittest.TestCase):
    def run_script(self, name, option):
        return subprocess.run([sys.executable, ROOT / "tools/generate" / name, option], check=False,
                              stderr=subprocess.PIPE).returncode

    def test_the_modules_are_up_to_date(self):
        for name in SCRIPTS:
            with self.subTest(name):
                self.assertEqual(0, self.run_script(name, "--check"))

    def test_an_unknown_option_is_refused(self):
        for name in SCRIPTS:
            with self.subTest(name):
                self.assertEqual(2, self.run_script(name, "--chekc"))
