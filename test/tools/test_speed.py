"""What `./run speed` makes of times: spreads, ratios of one contact each, the table."""

import contextlib
import io
import math
import pathlib
import tempfile
import unittest
from unittest import mock

import speed
from faststrip_plots.tables import InputError

ROOT = pathlib.Path(__file__).resolve().parents[2]

FASTSIM = {"shift_-5": 10.0, "shift_0": 20.0, "shift_5": 40.0}


class Rows(unittest.TestCase):
    def test_the_spread_is_that_of_the_benches(self):
        self.assertEqual(speed.spread([3.0]), (3.0, 3.0, 3.0))
        self.assertEqual(speed.spread([4.0, 1.0, 2.0, 3.0]), (2.5, 4.0, 4.0))
        self.assertEqual(speed.spread(range(1, 21)), (10.5, 19, 20))
        self.assertEqual(speed.spread(range(1, 101)), (50.5, 95, 100))
        self.assertTrue(all(map(math.isnan, speed.spread([]))))

    def test_ratios_are_of_one_contact_each(self):
        cells = speed.row("a", "b", {"shift_-5": 30.0, "shift_0": 20.0, "shift_5": 10.0}, FASTSIM,
                          ("c", {"shift_-5": 60.0, "shift_0": 20.0}), ("d", {"shift_0": 5.0}))
        self.assertEqual([cells[f"us_{word}"] for word in speed.SPREAD], [20.0, 30.0, 30.0])
        self.assertEqual([cells[f"over_fastsim_{word}"] for word in speed.SPREAD], [1.0, 3.0, 3.0])
        self.assertEqual([cells[f"over_base_{word}"] for word in speed.SPREAD], [0.75, 1.0, 1.0])
        self.assertEqual([cells[f"over_contact_{word}"] for word in speed.SPREAD], [4.0] * 3)
        self.assertEqual((cells["cases"], cells["worst_case"], cells["contact_us_median"]),
                         (3, "shift_-5", 5.0))

    def test_without_fastsim_on_a_case_its_median_counts(self):
        cells = speed.row("a", "b", {"state_1": 40.0, ("shift_5", "3"): 400.0}, FASTSIM)
        self.assertEqual([cells[f"over_fastsim_{word}"] for word in ("median", "worst")],
                         [6.0, 10.0])
        self.assertEqual(cells["worst_case"], "shift_5, step 3")
        self.assertTrue(math.isnan(cells["over_base_median"]))

    def test_the_least_of_the_rounds_counts(self):
        least = {}
        speed.keep(least, ["a", "b"], [2.0, math.nan])
        speed.keep(least, ["a"], [3.0])
        speed.keep(least, ["a"], [1.0])
        self.assertEqual(least, {"a": 1.0})

    def test_steps_are_told_over_the_same_cold_ones(self):
        methods = {(*speed.YARDSTICK, case): us for case, us in FASTSIM.items()}
        steps = {}
        for kind in speed.STEPS:
            for step, warm, cold in (("1", 10.0, 100.0), ("2", 90.0, 100.0)):
                steps[kind, "shift_0", step, "warm"] = warm
                steps[kind, "shift_0", step, "cold"] = cold
        steps["cold", "shift_0", "0", "warm"] = 70.0
        steps["cold", "shift_0", "0", "cold"] = 60.0
        steps["cold", "17", "0", "warm"] = 80.0
        rows = speed.step_rows(methods, steps)
        self.assertEqual(len(rows), 4)
        for cells in rows[:3]:
            self.assertEqual((cells["base"], cells["over_base_worst"], cells["worst_case"]),
                             ("cold", 0.9, "shift_0, step 2"))
            self.assertEqual(cells["over_fastsim_worst"], 4.5)
        self.assertEqual((rows[3]["us_median"], rows[3]["worst_case"]), (70.0, "scene 17"))

    def test_the_start_of_a_program_is_no_part_of_a_row(self):
        # A start takes longer than some rows, and not always as long.
        def time_rows(folder, gaps, figures, gap):
            reads = len(set(gaps))
            return (0.016 if len(gaps) == 1 else 0.014) + 2e-4 * len(gaps) + 1e-4 * reads

        with mock.patch.object(speed, "time_rows", time_rows):
            keys, values = speed.time_batch(pathlib.Path(), ["shift_0"])
        self.assertEqual([name for name, _ in keys], [speed.GAP_READ, speed.GAP_NEW])
        for us, expected in zip(values, (200.0, 300.0), strict=True):
            self.assertLess(abs(us - expected), 0.1 * expected)


class Contact(unittest.TestCase):
    def test_recorded_times_are_those_of_the_reference(self):
        times = speed.contact_times()
        lines = (ROOT / speed.CONTACTS / speed.FULL).read_text(encoding="utf-8").splitlines()
        names, first = lines[1].split(","), lines[2].split(",")
        for stage, (name, _) in speed.SECONDS.items():
            own = times[stage, "full 0.1"]
            self.assertEqual(len(own), 20)
            self.assertAlmostEqual(own[f"shift_{first[0]}"], 1e6 * float(first[names.index(name)]))
            self.assertEqual(len(times[stage, "KPEC+FASTSIM 0.2"]), 20)
        # Its clock did not show them.
        self.assertLess(len(times["normal", "HERTZ+FASTSIM 0.2"]), 20)

    def test_every_mode_of_the_list_is_recorded(self):
        wanted = speed.read_table(str(ROOT / speed.METHODS), ("stage", "contact"))
        times = speed.contact_times()
        for stage, mode in zip(wanted.words("stage"), wanted.words("contact")):
            if mode:
                self.assertEqual(len(times[stage, mode]), 20, (stage, mode))
        self.assertIn(speed.YARDSTICK, set(zip(wanted.words("stage"), wanted.words("method"))))
        self.assertIn(speed.BATCH_SOLVE, set(zip(wanted.words("stage"), wanted.words("method"))))


class File(unittest.TestCase):
    def test_what_is_written_is_read_and_shown(self):
        cells = speed.row("warm", "load", {"shift_0": 1234.0}, FASTSIM,
                          ("cold", {"shift_0": 2468.0}))
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "sub", "speed.csv")
            speed.write(path, speed.speed_csv(["faststrip 0.1.0 rev abc"], [cells]))
            self.assertTrue(path.read_text(encoding="utf-8").startswith("# faststrip 0.1.0 rev"))
            read, = speed.read_speed(path)
        self.assertEqual((read["us_worst"], read["over_base_median"], read["over_contact_median"]),
                         ("1234", "0.5", ""))
        text = speed.shown([read])
        self.assertIn("1234 / 1234 / 1234", text)
        self.assertIn("0.5 / 0.5 / 0.5  cold", text)
        self.assertNotIn("nan", text)

    def test_a_bench_that_fails_is_told_in_one_line(self):
        for words, says in ((["sh", "-c", "echo first >&2; echo second >&2; exit 3"],
                             "exit 3: second"),
                            (["no/such/program"], "cannot run no/such/program")):
            with self.assertRaises(InputError) as caught:
                speed.command(words)
            self.assertIn(says, str(caught.exception))
            self.assertNotIn("\n", str(caught.exception))

    def test_nothing_is_written_where_a_bench_fails(self):
        with tempfile.TemporaryDirectory() as folder, mock.patch.object(
                speed, "ROOT", pathlib.Path(folder)), contextlib.redirect_stderr(io.StringIO()):
            path = pathlib.Path(folder, "speed.csv")
            with self.assertRaises(InputError):
                speed.main(["--quick", "-o", str(path)])
            self.assertFalse(path.exists())
