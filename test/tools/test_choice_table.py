"""tools/choice_table.py: its files are up to date, and what they say of the choice is good."""

import csv
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


class ChoiceTable(unittest.TestCase):
    def test_files_are_up_to_date(self):
        done = subprocess.run([sys.executable, str(ROOT / "tools" / "choice_table.py"), "--check"],
                              encoding="utf-8", capture_output=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_promises_are_kept_on_contacts_left_out(self):
        with open(ROOT / "reference" / "choice_validation.csv", encoding="utf-8") as stream:
            rows = list(csv.DictReader(line for line in stream if not line.startswith("#")))
        self.assertEqual({row["target"] for row in rows}, {"forces", "pmax", "penetration"})
        met = promised = 0
        for row in rows:
            promised += int(row["promised"])
            if row["promised"] != "0":
                met += float(row["met_of_promised"]) * int(row["promised"])
        self.assertGreater(met / promised, 0.95)
