"""tools/measure/report_runs.py: runs, verdicts and the files it leaves; exit 1 where one fails."""

import csv
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from harness import ROOT

STEP = ROOT / "tools/measure/report_runs.py"
RUNS = "id,when,program,words\n"
MANIFEST = ("id,chapter,case,method,quantity,value_file,reference_file,metric,tolerance,figure,"
            "source\n")
INTEGRAL = "integral --n 0 --b 1 -o {data}/integral.csv\n"
ROW = "there,verification,n=0,,value,integral.csv,,max_abs,9,,-\n"


def rows_of(text):
    """The rows of a CSV text as dictionaries, comments left out."""
    return list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))


class Report(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def report(self, own_runs, own_manifest, *words, folder="a report", **where):
        """Do a list with a manifest; `where` puts them elsewhere."""
        for name, text in (("runs", RUNS + own_runs), ("manifest", MANIFEST + own_manifest)):
            path = self.folder / where.get(name, f"{name}.csv")
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
            words += f"--{name}", str(path)
        return self.step("-o", str(self.folder / folder), *words)

    def step(self, *words):
        return subprocess.run([sys.executable, STEP, *words], cwd=self.folder, encoding="utf-8",
                              capture_output=True, timeout=600, check=False,
                              env=os.environ | {"MPLBACKEND": "Agg"})

    def refused(self, done, code, *says):
        """One line, and nothing has been run."""
        self.assertEqual((done.returncode, done.stdout), (code, ""), done.stderr)
        self.assertRegex(done.stderr, r"\Areport: [^\n]+\n\Z")
        for text in says:
            self.assertIn(text, done.stderr)

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
        runs_csv = self.in_report("data/runs.csv")
        self.assertRegex(runs_csv, r"\A# faststrip \S+ rev \S+\n# compiler [^\n]+\n"
                                   r"id,exit_code,seconds,words\none,0,\d+\.\d+,integral ")
        self.assertEqual(rows_of(runs_csv)[0]["words"], INTEGRAL.rstrip())
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
        for runs, says in ((",never,faststrip,x\n",
                            "when must be always, full or quick, got never"),
                           ("x,always,perl,x\n",
                            "program must be faststrip, faststrip-lab or python, got perl"),
                           (",always,faststrip,x\n", "id must be the name of a file, got ''"),
                           ("a/b,always,faststrip,x\n", "id must be the name of a file, got 'a/b'"),
                           ("x,always,faststrip,it's\n", "words must be those of a command")):
            self.refused(self.report(runs, ROW), 1, says, "runs.csv:2")
            good = "one,always,faststrip," + INTEGRAL
            self.refused(self.report(good + runs, ROW), 1, says, "runs.csv:3")
            self.assertFalse((self.folder / "a report").exists())
        self.refused(self.step("--runs", "none.csv"), 1, "no such file: none.csv")
        self.refused(self.step("--manifest", "none.csv"), 1, "no such file: none.csv")
        self.refused(self.step("-o", ""), 2, "-o must be a folder")
        self.refused(self.step("--frobnicate"), 2, "--frobnicate")
        self.refused(self.step("more"), 2, "more")
        (self.folder / "file").write_text("kept", encoding="utf-8")
        good = "one,always,faststrip," + INTEGRAL
        self.refused(self.report(good, ROW, folder="file"), 1, "cannot make the folder")

    def test_inputs_inside_the_report_are_refused(self):
        good = "one,always,faststrip," + INTEGRAL
        for where in ({"runs": "a report/data/r.csv"}, {"manifest": "a report/figures/m.csv"},
                      {"runs": "a report/data/deep/r.csv"}):
            self.refused(self.report(good, ROW, **where), 2, "-o must not be a folder whose files")
        self.refused(self.report(good, ROW, folder="a report/data/..", runs="a report/data/r.csv"),
                     2, "-o must not be")
        (self.folder / "link").symlink_to("a report")
        self.refused(self.report(good, ROW, folder="link", runs="a report/data/r.csv"), 2,
                     "-o must not be")
        self.assertTrue((self.folder / "a report" / "data" / "r.csv").exists())
        self.assertEqual(self.report(good, ROW, runs="a report/r.csv").returncode, 0)

    def test_words_of_a_run(self):
        """Patterns stand for files, quotes for blanks; a program that is killed has its code."""
        for name in ("b_2.csv", "b_1.csv"):
            (self.folder / "a report" / "data").mkdir(parents=True, exist_ok=True)
            (self.folder / "a report" / "data" / name).write_text("x\n", encoding="utf-8")
        show = "import sys; print(*sys.argv[1:], sep=chr(10))"
        kill = "import os; os.kill(os.getpid(), 15)"
        done = self.report(f"one,always,faststrip,{INTEGRAL}"
                           f"two,always,python,\"-c '{show}' {{data}}/b_*.csv 'a  b' none_*.x\"\n"
                           f"three,always,python,\"-c '{kill}'\"\n", ROW)
        self.assertEqual(done.returncode, 0, done.stderr)
        data = self.folder / "a report" / "data"
        self.assertEqual(self.in_report("data/two.txt").splitlines(),
                         [str(data / "b_1.csv"), str(data / "b_2.csv"), "a  b", "none_*.x"])
        self.assertIn("run three ended with exit code 143", done.stderr)
        self.assertEqual([row["exit_code"] for row in rows_of(self.in_report("data/runs.csv"))],
                         ["0", "0", "143"])

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
