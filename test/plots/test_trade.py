"""plots/trade.py: fronts and choices are those of the numbers, files are announced."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import trade
from faststrip_plots.tables import read_table

ROOT = Path(__file__).resolve().parents[2]

HEADER = "set,case,stage,method,status,us,err_penetration,err_pmax,err_area,err_Fx,err_Fy,err_Mz\n"
ROWS = (
    "s,1,normal,Hertz,ok,1,0.2,-0.3,0.1,,,\n"
    "s,2,normal,Hertz,ok,3,0.1,0.02,0.1,,,\n"
    "s,1,normal,strips 5,ok,50,0.01,-0.02,0.0,,,\n"
    "s,2,normal,strips 5,fewer_strips,50,0.01,-0.005,0.0,,,\n"
    "s,1,normal,strips 9,ok,60,0.02,0.03,0.0,,,\n"
    "s,2,normal,strips 9,no_convergence,,,,,,,\n"
    "s,1,both,strips 5,ok,60,,,,0.001,0.002,-0.004\n"
)
FRONT_HEADER = HEADER.replace("err_Mz", "err_Mz,cpu_us_solution_median")
FRONT_ROWS = (
    "scenes,1,normal,Hertz,ok,31,0.2,-0.3,,,,,1\n"
    "scenes,2,normal,Hertz,ok,33,0.1,0.2,,,,,1\n"
    "scenes,1,normal,KPEC,ok,70,0.01,-0.2,,,,,30\n"
    "scenes,2,normal,KPEC,ok,70,0.03,-0.1,,,,,40\n"
    "scenes,1,normal,strips 5,ok,60,0.03,0.02,,,,,20\n"
    "scenes,2,normal,strips 5,ok,90,0.04,0.03,,,,,25\n"
    "scenes,1,normal,ANALYN,ok,50,0.04,0.01,,,,,10\n"
    "scenes,2,normal,ANALYN,ok,50,0.04,0.01,,,,,10\n"
    "scenes,1,normal,NORM 0.4 mm,ok,5000,0.001,0.001,,,,,\n"
)


class Trade(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "trade.csv").write_text(HEADER + ROWS, encoding="utf-8")

    def points(self):
        return trade.summarize(read_table(str(self.folder / "trade.csv")))

    def test_summary(self):
        hertz, five, nine, both = self.points()
        self.assertEqual((hertz["contacts"], hertz["unsolved"], hertz["us"]), (2, 0, 2.0))
        self.assertAlmostEqual(hertz["mean"], 0.2)
        self.assertAlmostEqual(hertz["max"], 0.3)
        self.assertAlmostEqual(hertz["max_area"], 0.1)
        self.assertEqual(hertz["max_Fx"], "")
        self.assertAlmostEqual(five["max"], 0.02)
        self.assertEqual(nine["unsolved"], 1)
        self.assertAlmostEqual(both["mean"], 0.004)

    def test_front_and_choices(self):
        points = self.points()
        normal = [p for p in points if p["stage"] == "normal"]
        self.assertEqual([p["method"] for p in trade.front(normal, "max")], ["Hertz", "strips 5"])
        rows = {row["target"]: row["Normal contact"] for row in trade.choices(points)}
        self.assertEqual(rows["10 %"], "strips 5, 50 µs (strips 5, 50 µs)")
        self.assertEqual(rows["3 %"], "strips 5, 50 µs (strips 5, 50 µs)")
        self.assertEqual(rows["1 %"], "none (none)")

    def test_peers_below_ours_are_told(self):
        (self.folder / "trade.csv").write_text(FRONT_HEADER + FRONT_ROWS, encoding="utf-8")
        rows = trade.normal_fronts(read_table(str(self.folder / "trade.csv")))
        by_name = {row["method"]: row for row in rows}
        self.assertEqual([by_name[name]["us"] for name in ("Hertz", "KPEC", "NORM 0.4 mm")],
                         [1.0, 35.0, 5000.0])
        self.assertAlmostEqual(by_name["KPEC"]["mean"], 0.15)
        self.assertAlmostEqual(by_name["KPEC"]["mean_penetration"], 0.02)
        self.assertEqual((by_name["KPEC"]["us_worst"], by_name["KPEC"]["worst_case"]), (40.0, "2"))
        self.assertEqual([by_name[name]["below"] for name in ("KPEC", "ANALYN", "strips 5")],
                         ["mean_penetration", "mean mean_penetration mean_pmax", ""])
        self.assertEqual(trade.verdict(rows), "Below ours: ANALYN (scenes).")
        self.assertEqual(trade.verdict(rows[:3]), "No one lies below ours.")
        trade.draw_fronts(rows, str(self.folder / "front.png"), "rev")
        self.assertGreater((self.folder / "front.png").stat().st_size, 10000)

    def test_the_command(self):
        done = subprocess.run(
            [sys.executable, str(ROOT / "plots" / "trade.py"), "--trade", "trade.csv",
             "--folder", "out"], cwd=self.folder, encoding="utf-8", capture_output=True,
            check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for name in ("figures.csv", "tables.csv"):
            for file in read_table(str(self.folder / "out" / name)).words("file"):
                self.assertGreater((self.folder / "out" / file).stat().st_size, 100, file)
        done = subprocess.run(
            [sys.executable, str(ROOT / "plots" / "trade.py"), "--trade", "no.csv"],
            cwd=self.folder, encoding="utf-8", capture_output=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (1, "trade.py: no such file: no.csv\n"))
