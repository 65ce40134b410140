"""Help, version and what the command line itself refuses."""

import pathlib
import subprocess
import tempfile

from cli_program import LAB, PROGRAM, ROOT, ProgramTest, gap_case, gap_text, parabola

SUBCOMMANDS = ("integral", "contact", "batch", "merge", "sweep", "wheelset", "conicity",
               "netcdf")
OF_THE_LAB = ("bench", "fuzz", "scenes", "errata")


class Help(ProgramTest):
    def check(self, *words, lines=1):
        done = self.run_program(*words)
        self.assertEqual((done.returncode, done.stderr), (0, ""), words)
        self.assertGreaterEqual(len(done.stdout.splitlines()), lines)
        for line in done.stdout.splitlines():
            self.assertLessEqual(len(line), 100, line)
            self.assertEqual(line, line.rstrip())
        return done.stdout

    def test_overview_names_every_subcommand(self):
        for words in (["--help"], ["-h"], ["help"]):
            text = self.check(*words, lines=8)
            for name in SUBCOMMANDS:
                self.assertIn(f"\n  {name} ", text)

    def test_subcommands(self):
        for name in SUBCOMMANDS:
            text = self.check(name, "--help", lines=6)
            self.assertTrue(text.startswith(f"usage: faststrip {name}"))
            self.assertIn("\n  -o FILE ", text)
            self.assertEqual(self.check(name, "-h"), text)
            self.assertEqual(self.check(name, "no_such_file", "--help"), text)

    def test_options_of_the_issue_are_told(self):
        for name, options in (
            ("integral", ("--n", "--b", "--x", "--method", "--input")),
            ("contact", ("--fields", "--strips", "--gap", "--profiles", "--shift")),
            ("batch", ("--normal", "--tangential", "--strips-per-patch")),
            ("wheelset", ("--states",)),
            ("netcdf", ("-o", "--single")),
            ("conicity", ("--delta-r", "--amplitudes", "--method", "--roll", "--functions")),
        ):
            text = self.check(name, "--help")
            for option in options:
                self.assertIn(f"\n  {option} ", text)

    def test_the_laboratory_is_a_program_of_its_own(self):
        text = self.check("--help")
        for name in (*OF_THE_LAB, "report"):
            self.assertNotRegex(text, rf"\b{name}\b")
            self.refused(2, name, says=[f"unknown subcommand: {name}"])
        self.program = LAB
        text = self.check("--help")
        self.assertTrue(text.startswith("usage: faststrip-lab "))
        for name in OF_THE_LAB:
            self.assertIn(f"\n  {name} ", text)
            about = self.check(name, "--help", lines=4)
            self.assertTrue(about.startswith(f"usage: faststrip-lab {name}"))
        self.refused(2, "contact", says=["unknown subcommand: contact", "see faststrip-lab --help"])
        self.assertRegex(self.check("--version"), r"\Afaststrip-lab \S+ rev \S+\n\Z")

    def test_the_page_is_a_command_of_its_own(self):
        page = "faststrip-explore"
        text = self.check("explore", "--help", lines=4)
        self.assertTrue(text.startswith("usage: faststrip explore"))
        self.assertIn("\n  explore ", self.check("--help"))
        nowhere = {"PATH": "/nowhere"}
        done = subprocess.run([PROGRAM, "explore", "--port", "0"], capture_output=True,
                              encoding="utf-8", env=nowhere, check=False)
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (1, "", 1))
        self.assertIn("pip install 'faststrip[explore]' brings " + page, done.stderr)
        with tempfile.TemporaryDirectory() as folder:
            script = pathlib.Path(folder, page)
            script.write_text('#!/bin/sh\nprintf "%s.\\n" "$@"\nexit 7\n', encoding="utf-8")
            script.chmod(0o755)
            done = subprocess.run([PROGRAM, "explore", "--port", "0", "a b", ""],
                                  capture_output=True, encoding="utf-8", env={"PATH": folder},
                                  check=False)
        self.assertEqual((done.returncode, done.stdout), (7, "--port.\n0.\na b.\n.\n"))

    def test_version_is_that_of_the_manifest(self):
        manifest = (ROOT / "fpm.toml").read_text(encoding="utf-8")
        version = manifest.split('version = "', 1)[1].split('"', 1)[0]
        for word in ("--version", "-V"):
            text = self.check(word)
            self.assertRegex(text, rf"\Afaststrip {version} rev \S+\n\Z")


class Usage(ProgramTest):
    def test_wrong_calls(self):
        self.write("gap.csv", gap_text(parabola, n=61))
        self.write("case.nml", gap_case())
        for words, says in (
            ([], "subcommand"),
            (["frobnicate"], "frobnicate"),
            (["--frobnicate"], "--frobnicate"),
            ([""], "subcommand"),
            (["--help", "more"], "more"),
            (["--version", "more"], "more"),
            (["integral"], "--n"),
            (["integral", "--n", "1"], "--b"),
            (["integral", "--n"], "--n"),
            (["integral", "--n", "1", "--n", "2", "--b", "1"], "twice: --n"),
            (["integral", "--n=1", "--n", "2", "--b", "1"], "twice: --n"),
            (["integral", "--n", "1", "--b", "1", "more"], "more"),
            (["integral", "--n", "1", "--b", "1", "--", "--x"], "--x"),
            (["integral", "--n", "1.5", "--b", "1"], "1.5"),
            (["integral", "--n", "99999999999", "--b", "1"], "99999999999"),
            (["integral", "--n", "1", "--b", "1e999"], "1e999"),
            (["integral", "--n", "1", "--b", "one"], "one"),
            (["integral", "--n", "1", "--b", "NaN"], "NaN"),
            (["integral", "--n", "1", "--b="], "--b"),
            (["integral", "--n", "1", "--b", "1", "--x", "1,5"], "1,5"),
            (["integral", "--n", "1", "--b", "1", "--method", "guess"], "guess"),
            (["integral", "--n", "1", "--b", "1", "--input", "x.csv"], "--input"),
            (["integral", "--strips", "x"], "--strips"),
            (["contact"], "CASE.nml"),
            (["contact", "case.nml", "case.nml"], "case.nml"),
            (["contact", "case.nml", "--frobnicate"], "--frobnicate"),
            (["contact", "case.nml", "--frob=1"], "--frob=1"),
            (["contact", "case.nml", "-o"], "-o"),
            (["contact", "case.nml", "--shift", "1"], "--shift"),
            (["contact", "case.nml", "--profiles", "p.csv"], "--profiles"),
            (["batch"], "CASES.csv"),
            (["batch", "a.csv", "b.csv"], "b.csv"),
            (["batch", "a.csv", "--shift", "1"], "--shift"),
            (["batch", "a.csv", "--normal", "guess"], "guess"),
            (["sweep"], "CASE.nml"),
            (["sweep", "a.nml", "b.nml"], "b.nml"),
            (["sweep", "a.nml", "--shift", "1"], "--shift"),
        ):
            with self.subTest(words):
                text = self.refused(2, *words, says=[says])
                self.assertIn("--help", text)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()),
                         ["case.nml", "gap.csv"])
