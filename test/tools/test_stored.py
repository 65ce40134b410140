"""Stored results carry the stamp of a clean revision in the history, and one command makes them."""

import csv
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from faststrip_plots import style
from faststrip_plots.stamps import History, stamp_of, stored_files, trouble_with

ROOT = Path(__file__).resolve().parents[2]

LIST = ROOT / "reference" / "stored.csv"


class OfTheProject(unittest.TestCase):
    def test_every_stamp_is_of_a_clean_revision_in_the_history(self):
        history = History(ROOT)
        for file in stored_files(LIST):
            self.assertEqual(trouble_with(stamp_of(ROOT / file), history), "", file)

    def test_no_stamped_file_is_left_out_of_the_list(self):
        listed = set(stored_files(LIST))
        self.assertGreaterEqual(len(listed), 4)
        for folder in ("reference", "plots", "example"):
            for path in sorted((ROOT / folder).rglob("*")):
                if path.suffix in (".csv", ".png") and stamp_of(path).text != "no stamp":
                    self.assertIn(path.relative_to(ROOT).as_posix(), listed)

    def test_the_list_says_how_each_file_is_made(self):
        with open(LIST, encoding="utf-8") as stream:
            rows = list(csv.DictReader(line for line in stream if not line.startswith("#")))
        for row in rows:
            self.assertLessEqual(set(row["stamped"].split()), set(row["files"].split()))
            program = row["command"].split()[0]
            self.assertIn(program, ("bin/faststrip", "bin/faststrip-lab", "python"))
            if program == "python":
                self.assertTrue((ROOT / row["command"].split()[1]).exists(), row["command"])
            elif (ROOT / program).exists():
                known = subprocess.run([ROOT / program, row["command"].split()[1], "--help"],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                       check=False)
                self.assertEqual(known.returncode, 0, row["command"])


@unittest.skipUnless(shutil.which("git"), "no git")
class InAFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def git(self, *words):
        done = subprocess.run(
            ["git", "-C", str(self.folder), "-c", "user.name=a", "-c", "user.email=a@b.c", *words],
            capture_output=True, encoding="utf-8", check=True)
        return done.stdout.strip()

    def commit(self):
        self.git("add", "-A")
        self.git("commit", "--allow-empty", "-qm", "x", "--date", "2001-02-03T04:05:06")
        return self.git("rev-parse", "--short", "HEAD")

    def stamped(self, revision):
        path = self.folder / "r.csv"
        path.write_text(f"# words\n# faststrip 0.1.0 rev {revision}\na,b\n1,2\n", encoding="utf-8")
        return stamp_of(path)

    def test_bad_stamps_are_refused_with_git_and_without(self):
        for with_git in (False, True):
            if with_git:
                self.git("init", "-q")
                good = self.commit()
            else:
                good = "0123abc"
            history = History(self.folder)
            self.assertEqual(trouble_with(self.stamped(good), history), "")
            for bad in (f"{good}-dirty", "unknown", "unknown-dirty", "main", good[:5]):
                self.assertEqual(trouble_with(self.stamped(bad), history),
                                 f"not a clean revision: {bad}")
            wrong = "fedcba9" if good != "fedcba9" else "fedcba8"
            self.assertEqual(trouble_with(self.stamped(wrong), history),
                             f"not in the history: {wrong}" if with_git else "")
        (self.folder / "r.csv").write_text("a,b\n1,2\n# faststrip 0.1.0 rev x\n", encoding="utf-8")
        self.assertEqual(stamp_of(self.folder / "none.csv").text, "no such file")
        (self.folder / "r.csv").write_text("a,b\n1,2\n", encoding="utf-8")
        self.assertEqual(trouble_with(stamp_of(self.folder / "r.csv"), history), "no stamp")
        (self.folder / "r.csv").write_text(
            f"# faststrip 0.1.0 rev {good}\n# faststrip 0.1.0 rev {wrong}\na\n1\n",
            encoding="utf-8")
        self.assertEqual(trouble_with(stamp_of(self.folder / "r.csv"), history),
                         "stamps of several revisions")

    def test_a_revision_on_another_branch_is_not_in_the_history(self):
        self.git("init", "-q")
        self.commit()
        self.git("checkout", "-qb", "aside")
        (self.folder / "f").write_text("f", encoding="utf-8")
        aside = self.commit()
        self.git("checkout", "-q", "-")
        self.assertEqual(trouble_with(self.stamped(aside), History(self.folder)),
                         f"not in the history: {aside}")

    def test_age(self):
        stamp = self.stamped("0123abc")
        self.assertEqual(History(self.folder).age(stamp), "faststrip 0.1.0 rev 0123abc")
        self.git("init", "-q")
        first = self.commit()
        self.commit()
        self.commit()
        date = self.git("log", "-1", "--format=%cs", first)
        self.assertEqual(History(self.folder).age(self.stamped(first)),
                         f"faststrip 0.1.0 rev {first}, {date}, 2 commits ago")
        self.assertEqual(History(self.folder).age(self.stamped(f"{first}-dirty")),
                         f"faststrip 0.1.0 rev {first}-dirty")

    def test_pictures_carry_the_stamp_too(self):
        figure = style.new_figure(3.0, 2.0)
        figure.subplots().plot([0.0, 1.0], [0.0, 1.0])
        path = self.folder / "p.png"
        style.save(figure, str(path), ["faststrip 0.1.0 rev 0123abc"])
        self.assertEqual(stamp_of(path).revision, "0123abc")

    def test_the_command_refuses_what_is_not_committed_and_names_it(self):
        for name in ("tools/measure/stored.py", "plots/faststrip_plots/__init__.py",
                     "plots/faststrip_plots/stamps.py", "plots/faststrip_plots/tables.py"):
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, self.folder / name)
        (self.folder / ".gitignore").write_text("__pycache__/\nout/\nbin/\n", encoding="utf-8")
        program = self.folder / "bin" / "faststrip"
        program.parent.mkdir()
        (self.folder / "make.py").write_text(
            "import subprocess as s\n"
            "said = s.run(['bin/faststrip', '--version'], capture_output=True, text=True).stdout\n"
            "open('r.csv', 'w').write('# ' + said + 'a\\n1\\n')\n", encoding="utf-8")
        (self.folder / "reference").mkdir()
        (self.folder / "reference" / "stored.csv").write_text(
            "name,stamped,files,command\none,r.csv,r.csv,python make.py\n", encoding="utf-8")

        def run(*words):
            return subprocess.run([sys.executable, "tools/measure/stored.py", *words],
                                  cwd=self.folder, capture_output=True, encoding="utf-8",
                                  check=False)

        self.assertIn("no git history", run().stderr)
        self.git("init", "-q")
        revision = self.commit()

        def build(said):
            program.write_text(f"#!/bin/sh\necho 'faststrip 0.1.0 rev {said}'\n",
                               encoding="utf-8")
            program.chmod(0o755)

        build("0123abc")
        done = run()
        self.assertEqual(done.returncode, 1)
        self.assertIn("not built from this revision", done.stderr)
        self.assertFalse((self.folder / "r.csv").exists())
        build(revision)
        (self.folder / "new file").write_text("x", encoding="utf-8")
        done = run()
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"commit everything first.*new file")
        self.commit()
        build(self.git("rev-parse", "--short", "HEAD"))
        done = run("two")
        self.assertRegex(done.stderr, "no such result: two")
        done = run("one")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(run("--check").returncode, 0)
        text = (self.folder / "r.csv").read_text(encoding="utf-8")
        (self.folder / "r.csv").write_text(re.sub(r"rev (\w+)", r"rev \1-dirty", text),
                                           encoding="utf-8")
        done = run("--check")
        self.assertEqual(done.returncode, 1)
        self.assertIn("r.csv: not a clean revision", done.stderr)
