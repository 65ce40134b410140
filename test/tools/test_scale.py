"""What `./run scale` makes of what it measures: rates, efficiency, what stands on paper."""

import math
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

import scale
import speed
from faststrip_plots.tables import InputError

ROOT = pathlib.Path(__file__).resolve().parents[2]

PYTHON = sys.executable
CELLS = {"contacts": 100, "processes": 1, "threads": 1, "cpu_s": 2.0, "elapsed_s": 4.0,
         "contacts_per_core_s": 50.0, "peak_MB": 10.0, "size_MB": 1.0, "bytes_per_contact": 1e4}


class Run(unittest.TestCase):
    def test_peak_is_that_of_the_command(self):
        text = "x = bytearray({}); x[::1000] = b'1'*len(x[::1000])"
        peaks = [scale.run([[PYTHON, "-I", "-S", "-c", text.format(n)]])[2]
                 for n in (1, 30000000, 60000000)]
        for less, more in zip(peaks, peaks[1:]):
            self.assertTrue(25.0 < more - less < 35.0, peaks)

    def test_commands_run_at_the_same_time(self):
        # Each waits until the other is there.
        with tempfile.TemporaryDirectory() as folder:
            text = ("import os, sys, time\nos.mkdir(sys.argv[1])\n"
                    "while not os.path.isdir(sys.argv[2]): time.sleep(0.01)")
            names = [f"{folder}/one", f"{folder}/two"]
            cpu, elapsed, peak = scale.run([[PYTHON, "-c", text, *names],
                                            [PYTHON, "-c", text, *names[::-1]]])
        self.assertTrue(0.0 < cpu and 0.0 < elapsed and 1.0 < peak)

    def test_what_fails_is_told_in_one_line(self):
        good = [PYTHON, "-c", "pass"]
        for commands, says in (([["sh", "-c", "echo a >&2; echo why >&2; exit 3"]], "sh -c"),
                               ([good, ["sh", "-c", "echo why >&2; kill -9 $$"]], "why"),
                               ([["no/such/program"]], "no/such/program")):
            with self.assertRaises(InputError) as caught:
                scale.run(commands)
            self.assertIn(says, str(caught.exception))
            self.assertNotIn("\n", str(caught.exception))


class Rows(unittest.TestCase):
    def test_of_rounds_the_least_times_and_the_largest_peak_count(self):
        other = CELLS | {"cpu_s": 1.0, "elapsed_s": 5.0, "peak_MB": 9.0}
        self.assertEqual(scale.lesser(None, other), other)
        for pair in ((CELLS, other), (other, CELLS)):
            cells = scale.lesser(*pair)
            self.assertEqual([cells[name] for name in ("cpu_s", "elapsed_s", "peak_MB",
                                                       "contacts_per_core_s")],
                             [1.0, 4.0, 10.0, 100.0])

    def test_efficiency_is_of_the_cores_there_are(self):
        for cores, processes, threads, elapsed, wanted in ((8, 1, 2, 2.5, 0.8), (8, 4, 1, 1.0, 1.0),
                                                           (2, 4, 1, 2.0, 1.0), (2, 4, 2, 4.0, 0.5),
                                                           (1, 1, 2, 4.0, 1.0)):
            more = CELLS | {"processes": processes, "threads": threads, "elapsed_s": elapsed}
            with mock.patch.object(scale.os, "sched_getaffinity", lambda _, n=cores: range(n)):
                self.assertEqual(scale.efficiency(CELLS, more), wanted)

    def test_on_paper(self):
        rate, length = scale.paper_rows([
            {"group": "method", "what": "a + b"} | CELLS, {"group": "memory", "what": "a"} | CELLS,
            {"group": "format", "what": "CSV"} | CELLS])
        self.assertAlmostEqual(rate["hours"], 1e9 / 50.0 / 1000.0 / 3600.0)
        self.assertEqual(length["size_MB"], 1e7)

    def test_the_largest_is_left_out_where_it_takes_too_long_or_too_much(self):
        small = CELLS | {"contacts": 10**6}
        with mock.patch.object(scale, "memory_rows", lambda _, counts: list(counts)), \
                mock.patch.object(scale, "note"):
            self.assertEqual(scale.most_rows(ROOT, small), [10**7])
            for name, value in (("elapsed_s", 40.0), ("size_MB", 1e12)):
                self.assertEqual(scale.most_rows(ROOT, small | {name: value}), [])

    def test_contacts_differ_and_are_the_same_again(self):
        with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as other:
            texts = [scale.contacts(pathlib.Path(folder), 45).read_text(encoding="utf-8")
                     for folder in (one, other)]
            lines = texts[0].splitlines()
            for line in lines[1:]:
                self.assertTrue(pathlib.Path(one, line.split(",")[1]).exists(), line)
        self.assertEqual(texts[0], texts[1])
        self.assertEqual(len({line.partition(",")[2] for line in lines}), 46)


class File(unittest.TestCase):
    def test_what_is_written_is_read_and_shown(self):
        rows = [{"group": "method", "what": "a + b"} | CELLS,
                {"group": "format", "what": "CSV", "contacts": 100, "size_MB": 1.0,
                 "bytes_per_contact": 1e4}]
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "sub", "scale.csv")
            speed.write(path, scale.scale_csv(["faststrip 0.1.0 rev abc"],
                                              rows + scale.paper_rows(rows)))
            self.assertTrue(path.read_text(encoding="utf-8").startswith("# faststrip 0.1.0 rev"))
            read = scale.read_scale(path)
        self.assertEqual((read[0]["cpu_s"], read[1]["size_MB"]), (2.0, 1.0))
        self.assertTrue(math.isnan(read[1]["cpu_s"]))
        text = scale.shown(read)
        self.assertIn("on paper: a + b: 1e9 / (50 per s and core * 1000 cores) / 3600 = 5.6 h,"
                      " 5556 core hours\n", text)
        self.assertIn("on paper: CSV: 1e9 * 10000 bytes = 10000 GB\n", text)
        self.assertNotIn("nan", text)
