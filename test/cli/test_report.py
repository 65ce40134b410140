"""`faststrip-lab report`: runs, verdicts and the files it leaves; exit 1 where one fails."""

import os
import subprocess
import sys

from cli_program import PROGRAM, ROOT, ProgramTest, rows_of

RUNS = "id,when,program,words\n"
MANIFEST = ("id,chapter,case,method,quantity,value_file,reference_file,metric,tolerance,figure,"
            "source\n")
INTEGRAL = "integral --n 0 --b 1 -o {data}/integral.csv\n"


class Report(ProgramTest):
    def report(self, runs, manifest, *words):
        self.write("runs.csv", RUNS + runs)
        self.write("manifest.csv", MANIFEST + manifest)
        return subprocess.run(
            [str(PROGRAM), "report", "--runs", str(self.folder / "runs.csv"), "--manifest",
             str(self.folder / "manifest.csv"), "--python", sys.executable, "-o",
             str(self.folder / "a report"), *words],
            cwd=ROOT, encoding="utf-8", capture_output=True, timeout=600, check=False,
            env=os.environ | {"MPLBACKEND": "Agg"},
        )

    def in_report(self, name):
        return (self.folder / "a report" / name).read_text(encoding="utf-8")

    def test_good_and_bad_verdicts(self):
        row = "{0},verification,n=0,,value,integral.csv,{1},max_rel,1e-6,,by hand\n"
        runs = "one,always,faststrip," + INTEGRAL
        first = self.report(runs, row.format("right", 5.0))
        names = rows_of(self.in_report("data/integral.csv"))[0]
        self.assertIn("n", names)
        value = float(names["value"])
        done = self.report(runs, row.format("right", value))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(first.returncode, 1)
        verdicts = rows_of(self.in_report("verdicts.csv"))
        self.assertEqual([v["verdict"] for v in verdicts], ["pass"])
        self.assertIn("1 of 1 comparisons hold", self.in_report("report.md"))
        self.assertIn("<h1>faststrip", self.in_report("report.html"))
        self.assertEqual(rows_of(self.in_report("data/runs.csv"))[0]["exit_code"], "0")
        done = self.report(runs, row.format("right", value) + row.format("wrong", 2 * value))
        self.assertEqual(done.returncode, 1)
        self.assertIn("wrong: FAIL", done.stderr)
        self.assertEqual([v["verdict"] for v in rows_of(self.in_report("verdicts.csv"))],
                         ["pass", "FAIL"])

    def test_missing_files_fail_but_not_in_the_quick_report(self):
        rows = ("there,verification,n=0,,value,integral.csv,,max_abs,9,,-\n"
                "absent,verification,,,value,nothing.csv,,max_abs,9,,-\n")
        runs = "one,always,faststrip," + INTEGRAL
        done = self.report(runs, rows)
        self.assertEqual(done.returncode, 1)
        self.assertIn("absent: missing", done.stderr)
        done = self.report(runs, rows, "--quick")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("1 left out", done.stdout)

    def test_a_run_that_fails_is_told(self):
        row = "there,verification,n=0,,value,integral.csv,,max_abs,9,,-\n"
        done = self.report("one,always,faststrip," + INTEGRAL + "two,full,faststrip,nonsense\n"
                           "three,quick,faststrip,nonsense\n", row)
        self.assertEqual(done.returncode, 0)
        self.assertIn("run two ended with exit code 2", done.stderr)
        self.assertIn("unknown subcommand: nonsense", self.in_report("data/two.txt"))
        self.assertFalse((self.folder / "a report/data/three.txt").exists())

    def test_what_is_refused(self):
        for runs, says in ((",never,faststrip,x\n", "neither always, full nor quick: never"),
                           ("x,always,perl,x\n", "neither faststrip nor python: perl")):
            done = self.report(runs, "")
            self.assertEqual(done.returncode, 1)
            self.assertIn(says, done.stderr)
            self.assertIn("runs.csv:2", done.stderr)

    def test_an_older_report_goes_and_other_folders_stay(self):
        folder = self.folder / "a report"
        (folder / "data").mkdir(parents=True)
        (folder / "data" / "mine.csv").write_text("kept", encoding="utf-8")
        row = "there,verification,n=0,,value,integral.csv,,max_abs,9,,-\n"
        runs = "one,always,faststrip," + INTEGRAL
        self.report(runs, row)
        self.assertTrue((folder / "data" / "mine.csv").exists())
        self.report(runs, row)
        self.assertFalse((folder / "data" / "mine.csv").exists())
