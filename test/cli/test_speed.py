"""What times everything: `faststrip-lab bench speed` and, over it, `./run speed`."""

import csv
import subprocess
import sys

from cli_program import PATIENCE, ROOT, LabTest

TOOL = ROOT / "tools/measure/speed.py"
HEADER = ("stage,method,when,normal,tangential,strips_per_patch,points_per_strip,fastsim_nx,"
          "fastsim_ny,element_mm\n")
INFLUENCE = {"centre", "tip", "centre with derivatives", "tip with derivatives"}
STATES = {"cold start", "from the state before"}


class Bench(LabTest):
    def bench(self, methods, *words):
        self.write("methods.csv", HEADER + methods)
        self.good("bench", "speed", "--rounds", "1", "--methods", "methods.csv", *words,
                  "-o", "speed.csv")
        return self.read("speed.csv")

    def test_stages_are_timed_by_themselves(self):
        rows = self.bench("normal,few,always,strip,fastsim,5,,200,200,\n"
                          "normal,many,always,strip,linear,41,,,,\n"
                          "tangential,much,always,strip,fastsim,5,,200,200,\n"
                          "both,all,always,strip,fastsim,5,,200,200,\n"
                          "normal,later,full,norm,linear,,,,,0.2\n", "--quick")
        self.assertEqual(list(rows[0]), ["stage", "method", "case", "status", "cpu_us", "cpu"])
        us = {}
        for row in rows:
            us.setdefault((row["stage"], row["method"]), []).append(row["cpu_us"])
        self.assertEqual(set(us), {("normal", "few"), ("normal", "many"), ("tangential", "much"),
                                   ("both", "all"), ("gap", "made a curve"),
                                   *(("influence", name) for name in INFLUENCE),
                                   *(("wheelset", name) for name in STATES)})
        # The first state has none before it.
        self.assertEqual(us["wheelset", "from the state before"].pop(0), "")
        least = {key: min(map(float, values)) for key, values in us.items()}
        worst = {key: max(map(float, values)) for key, values in us.items()}
        self.assertGreater(min(least.values()), 0.0)
        # By far: 40000 elements, and a hundred times the operations.
        self.assertLess(least["normal", "few"], least["tangential", "much"])
        self.assertLess(worst["normal", "few"], worst["normal", "many"])
        self.assertLess(least["tangential", "much"], worst["both", "all"])
        self.assertLess(worst["influence", "tip with derivatives"], least["normal", "many"])

    def test_what_cannot_be_solved_has_a_status_and_no_time(self):
        rows = self.bench("normal,KPEC,always,kpec,linear,,,,,\n")
        own = [row for row in rows if row["method"] == "KPEC"]
        self.assertEqual(len(own), 20)
        for row in own:
            self.assertEqual(row["cpu_us"] == "", row["status"] not in ("ok", "under_resolved"),
                             row)

    def test_what_it_refuses(self):
        self.refused(2, "bench", "speed", "--seconds", "1", says=["--seconds"])
        self.write("methods.csv", HEADER + "normal,a,always,nothing,linear,,,,,\n")
        self.refused(1, "bench", "speed", "--methods", "methods.csv", says=["normal", "nothing"])


class Quick(LabTest):
    def tool(self, *words):
        return subprocess.run([sys.executable, TOOL, *words], cwd=self.folder, encoding="utf-8",
                              capture_output=True, timeout=PATIENCE, check=False)

    def test_table_file_and_picture(self):
        done = self.tool("--quick", "-o", "speed.csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        for line in done.stderr.splitlines():
            self.assertRegex(line, r"^speed: round 1 of 1: ")
        rows = self.read("speed.csv")
        self.assertIn("# faststrip ", (self.folder / "speed.csv").read_text(encoding="utf-8"))
        self.assertEqual((self.folder / "speed.png").read_bytes()[:4], b"\x89PNG")
        self.assertEqual(
            {row["group"] for row in rows},
            {"normal", "tangential", "normal and tangential", "gap", "influence coefficient",
             "wheelset", "warm step, 15 strips", "cold, 15 strips", "batch"})
        for row in rows:
            for name in ("us", "over_fastsim", "over_base", "over_contact"):
                values = [row[f"{name}_{word}"] for word in ("median", "p95", "worst")]
                if values[0] != "" or name in ("us", "over_fastsim"):
                    values = list(map(float, values))
                    self.assertEqual(values, sorted(values), row)
                    self.assertGreater(values[0], 0.0, row)
            self.assertTrue(row["worst_case"], row)
            self.assertEqual(row["contact"] == "", row["over_contact_median"] == "", row)
            self.assertEqual(row["base"] == "", row["over_base_median"] == "", row)
            self.assertIn(f"{row['group']}: {row['what']}", done.stdout)
        fastsim, = (row for row in rows if row["what"] == "FASTSIM 50x50")
        self.assertEqual([fastsim[f"over_fastsim_{word}"] for word in ("median", "worst")],
                         ["1", "1"])
        shown = self.tool("--read", "speed.csv")
        self.assertEqual(shown.returncode, 0, shown.stderr)
        self.assertTrue(done.stdout.startswith(shown.stdout))

    def test_what_it_refuses(self):
        for words, code, says in ((("--fast",), 2, "--fast"),
                                  (("--read", "no.csv"), 1, "no.csv")):
            done = self.tool(*words)
            self.assertEqual(done.returncode, code)
            self.assertIn(says, done.stderr.splitlines()[-1])
            self.assertEqual(done.stdout, "")
        (self.folder / "other.csv").write_text("a,b\n1,2\n", encoding="utf-8")
        done = self.tool("--read", "other.csv")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1))

    def test_the_list_of_methods_is_whole(self):
        with open(ROOT / "reference" / "speed_methods.csv", encoding="utf-8") as stream:
            rows = list(csv.DictReader(line for line in stream if not line.startswith("#")))
        text = (ROOT / "src/faststrip/contact/methods.f90").read_text(encoding="utf-8")
        normal = text.split("normal_table(*)")[1].split("tangential_table(*)")[0]
        known = [line.split("'")[1] for line in normal.splitlines() if "method_t(" in line
                 and "'" in line]
        self.assertGreaterEqual(len(known), 9)
        self.assertEqual(set(known) - {row["normal"] for row in rows}, set())
