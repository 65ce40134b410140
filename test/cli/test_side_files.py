"""What lies where the program makes files of its own stays: inputs, links, and what others have."""

import os
import threading
import unittest

import hostile
import side_files
from cli_program import (
    BATCH_COLUMNS,
    PATIENCE,
    ProgramTest,
    gap_case,
    gap_text,
    parabola,
)

ROW = "gap.csv,210000,0.28,0.3,1e5,0.001,0,0"


class EveryPlace(unittest.TestCase):
    def test_roles_places_and_spellings(self):
        """As inputs, as files of others and as links: nothing of it is changed.

        Every third of them, in an order by chance; tools/check/hostile.py tries all.
        """
        wrong = []
        for i in range(0, len(side_files.tries()), 3):
            attempt = hostile.side_files(None, i)
            found, code, err = hostile.run(attempt, float(PATIENCE))
            if found:
                wrong.append((str(attempt), found, code, err))
        self.assertGreater(len(side_files.tries()), 700)
        self.assertEqual(wrong, [])


class Places(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("gap.csv", gap_text(parabola, n=61))
        self.write("case.nml", gap_case())
        self.write("b.csv", "\n".join([BATCH_COLUMNS, *(f"{k},{ROW}" for k in range(9))]) + "\n")

    def contents(self):
        return {path.name: path.read_bytes() for path in self.folder.iterdir()}

    def make_journal(self):
        """As a killed run leaves them: all rows, but for the name."""
        self.good("batch", "b.csv", "-o", "r.csv", "--part", "1/1")
        (self.folder / "r.csv").rename(self.folder / "r.csv.partial")
        (self.folder / "r.csv.manifest").rename(self.folder / "r.csv.journal")

    def test_what_a_run_has_left_is_begun_anew(self):
        self.good("batch", "b.csv", "-o", "whole.csv")
        self.make_journal()
        self.write("r.csv.lock", f"process {side_files.GONE} on nowhere")
        self.good("batch", "b.csv", "-o", "r.csv")
        self.assertEqual(sorted(self.contents()), ["b.csv", "case.nml", "gap.csv", "r.csv",
                                                   "whole.csv"])
        self.assertEqual(self.contents()["r.csv"], self.contents()["whole.csv"])

    def test_what_no_journal_tells_of_stays(self):
        self.make_journal()
        partial = self.folder / "r.csv.partial"
        partial.write_bytes(b"#" + partial.read_bytes()[1:-1] + b"x")
        before = self.contents()
        for words in ((), ("--resume",)):
            self.refused(1, "batch", "b.csv", "-o", "r.csv", *words, says=["r.csv.partial"])
            self.assertEqual(self.contents(), before)

    def test_a_second_name_of_what_there_is_is_not_written_into(self):
        self.make_journal()
        os.link(self.folder / "r.csv.partial", self.folder / "kept")
        before = self.contents()
        self.refused(1, "batch", "b.csv", "-o", "r.csv", "--resume", says=["r.csv.partial"])
        self.assertEqual(self.contents(), before)

    def test_parts_of_others_stay_when_all_is_made(self):
        self.good("batch", "b.csv", "-o", "p1.csv", "--part", "1/2")
        self.good("batch", "b.csv", "-o", "r.csv", "--parts", "2")
        (self.folder / "r.csv.part1of2").symlink_to("p1.csv")
        self.write("r.csv.part2of2", "somebody's\n")
        self.write("r.csv.part2of2.manifest", "somebody's\n")
        before = self.contents()
        self.good("batch", "b.csv", "-o", "r.csv", "--parts", "2")
        self.assertEqual(self.contents(), before)

    def test_a_gap_in_the_place_of_a_part_is_told_before_one_is_made(self):
        self.write("r.csv.part2of2", gap_text(parabola, n=61))
        rows = [f"{k},{ROW}" for k in range(8)]
        rows.insert(0, "x,r.csv.part2of2,210000,0.28,0.3,1e5,0,0,0")
        self.write("b.csv", "\n".join([BATCH_COLUMNS, *rows]) + "\n")
        before = self.contents()
        self.refused(2, "batch", "b.csv", "-o", "r.csv", "--parts", "2", says=["r.csv.part2of2"])
        self.assertEqual(self.contents(), before)

    def test_a_lock_that_only_begins_as_one(self):
        for text in ("process", "process on here", "process 12", "process 12 of here", ""):
            self.write("r.csv.lock", text)
            before = self.contents()
            self.refused(1, "batch", "b.csv", "-o", "r.csv", says=["r.csv.lock"])
            self.assertEqual(self.contents(), before)

    def test_gaps_that_rows_name_in_later_chunks(self):
        # By a pipe nothing is known of them before.
        rows = [f"{k},{ROW}" for k in range(3000)]
        rows.append(f"x,{side_files.STALE},210000,0.28,0.3,1e5,0,0,0")
        self.write(side_files.STALE, gap_text(parabola, n=61))
        self.write("b.csv", "\n".join([BATCH_COLUMNS, *rows]) + "\n")
        os.mkfifo(self.folder / "pipe")
        threading.Thread(target=lambda: (self.folder / "pipe").write_bytes(
            (self.folder / "b.csv").read_bytes()), daemon=True).start()
        self.good("batch", "pipe", "-o", "r.csv", "--normal", "hertz", "--tangential", "none")
        self.assertEqual(len(self.read("r.csv")), 3001)
        self.assertTrue((self.folder / side_files.STALE).exists())
        # Nothing names it any more.
        self.good("contact", "case.nml", "-o", "r.csv")
        self.assertFalse((self.folder / side_files.STALE).exists())
