"""No output is an input or another output; what is read and what is solved has an end."""

import os
import subprocess
import threading
from unittest import mock

import hostile
from cli_program import (
    BATCH_COLUMNS,
    GAPS,
    LAB,
    PATIENCE,
    PROGRAM,
    ROOT,
    ProgramTest,
    gap_case,
    gap_text,
    parabola,
    profile_case,
    rows_of,
)

ROW = "a,gap.csv,210000,0.28,0.3,1e5,0.001,0,0"


class Environment(ProgramTest):
    def test_settings_of_fortran_s_run_time_change_nothing(self):
        """They move units, sizes and signs of a program, or end it."""
        self.write("gap.csv", gap_text(parabola, n=61))
        self.write("case.nml", gap_case())
        self.write("ok.csv", f"{BATCH_COLUMNS}\n{ROW}\n")
        runs = (("contact", "case.nml"), ("batch", "ok.csv"), ("--help",), ("contact", "no.nml"))
        wanted = [self.ended(*words) for words in runs]
        self.assertEqual([code for code, _, _ in wanted], [0, 0, 0, 1])
        for name, values in hostile.RUN_TIME.items():
            for value in values:
                with mock.patch.dict(os.environ, {f"GFORTRAN_{name}": value}):
                    for words, ended in zip(runs, wanted, strict=True):
                        self.assertEqual(self.ended(*words), ended, (name, value, words))

    def ended(self, *words):
        """Exit code, what was printed but for the times, and what was said."""
        done = self.run_program(*words)
        rows = rows_of(done.stdout) if done.stdout.startswith("#") else done.stdout
        for row in rows if isinstance(rows, list) else ():
            for name in ("normal_us", "tangential_us"):
                del row[name]
        return done.returncode, rows, done.stderr


class Outputs(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("gap.csv", gap_text(parabola, n=61))
        self.write("case.nml", gap_case())
        self.write("ok.csv", f"{BATCH_COLUMNS}\n{ROW}\n")
        self.write("w.txt", "".join(f"{y} {abs(y) ** 1.5 / 100.0}\n" for y in range(-30, 31)))
        self.write("prof.nml", profile_case(wheel="profile = 'w.txt'"))
        (self.folder / "dir").mkdir()
        os.link(self.folder / "gap.csv", self.folder / "hard.csv")
        (self.folder / "soft.csv").symlink_to("gap.csv")
        (self.folder / "dirlink").symlink_to(".")

    def contents(self):
        return {path.name: path.read_bytes() for path in self.folder.iterdir() if path.is_file()}

    def untouched(self, code, *words, says=()):
        before = self.contents()
        self.refused(code, *words, says=says)
        self.assertEqual(self.contents(), before, words)

    def spellings(self, name):
        return (name, f"./{name}", f"dir/../{name}", f".//{name}", self.folder / name,
                f"dirlink/{name}")

    def test_an_output_that_is_read(self):
        for option in ("-o", "--strips", "--fields", "--gap"):
            for path in (*self.spellings("case.nml"), *self.spellings("gap.csv"), "hard.csv",
                         "soft.csv"):
                self.untouched(2, "contact", "case.nml", option, path, says=[option, str(path)])
        for option in ("-o", "--profiles", "--gap"):
            for path in ("w.txt", "./prof.nml"):
                self.untouched(2, "contact", "prof.nml", option, path, says=[option, path])
        for path in (*self.spellings("ok.csv"), *self.spellings("gap.csv"), "hard.csv", "soft.csv"):
            self.untouched(2, "batch", "ok.csv", "-o", path, says=["-o", str(path)])
        self.untouched(2, "sweep", "prof.nml", "-o", "w.txt", says=["-o", "w.txt"])
        self.untouched(2, "table", "--audit", "ok.csv", "-o", "./ok.csv", says=["-o", "./ok.csv"])
        self.untouched(2, "integral", "--input", "ok.csv", "-o", "ok.csv", says=["-o", "ok.csv"])
        self.program = LAB
        self.untouched(2, "fuzz", "--read", "ok.csv", "-o", "ok.csv", says=["-o"])

    def test_two_outputs_on_one_path(self):
        for path in self.spellings("new.csv"):
            self.untouched(2, "contact", "case.nml", "-o", "new.csv", "--strips", path,
                           says=["-o", "--strips", "new.csv"])
        (self.folder / "dangling.csv").symlink_to("new.csv")
        self.untouched(2, "contact", "case.nml", "--gap", "new.csv", "--fields", "dangling.csv",
                       says=["--gap", "--fields"])
        self.write("one.csv", "one\n")
        os.link(self.folder / "one.csv", self.folder / "two.csv")
        self.untouched(2, "contact", "case.nml", "-o", "one.csv", "--strips", "two.csv",
                       says=["one.csv", "two.csv"])
        self.untouched(2, "table", "--curves", "a.csv", "--degrees", "./a.csv", says=["--degrees"])

    def test_devices_may_be_named_twice(self):
        rows = self.good("contact", "case.nml", "--strips", "/dev/null", "--fields", "/dev/null",
                         "-o", "/dev/stdout")
        self.assertEqual(len(rows), 1)

    def test_links_are_followed(self):
        (self.folder / "link.csv").symlink_to("dir/new.csv")
        self.good("contact", "case.nml", "-o", "link.csv")
        self.assertTrue((self.folder / "link.csv").is_symlink())
        self.assertEqual(len(self.read("dir/new.csv")), 1)
        self.assertEqual([path.name for path in (self.folder / "dir").iterdir()], ["new.csv"])

    def test_long_names(self):
        name = "x" * 250 + ".csv"
        self.good("contact", "case.nml", "-o", name)
        self.assertEqual(len(self.read(name)), 1)

    def test_folders_of_inputs(self):
        self.program = LAB
        for name in ("gaps/shift_0.csv", "gaps/shift_1.csv", "s1002_uic60_B.csv"):
            self.write(f"contacts/{name}", (GAPS.parent / name).read_text(encoding="utf-8"))
        self.refused(2, "bench", "accuracy", "--contacts", "contacts", "-o",
                     "contacts/gaps/shift_1.csv", says=["-o", "shift_1.csv"])
        self.refused(2, "bench", "accuracy", "--contacts", ROOT / "reference" / "contact", "-o",
                     GAPS / "shift_0.csv", says=["-o", "shift_0.csv"])

    def test_links_without_an_end_are_no_place_for_a_table(self):
        (self.folder / "one.csv").symlink_to("two.csv")
        (self.folder / "two.csv").symlink_to("one.csv")
        self.refused(2, "contact", "case.nml", "-o", "one.csv", says=["-o", "links", "one.csv"])
        self.assertEqual(os.readlink(self.folder / "one.csv"), "two.csv")

    def test_a_pipe_is_no_place_for_a_table(self):
        os.mkfifo(self.folder / "pipe")
        self.refused(2, "contact", "case.nml", "-o", "pipe", says=["-o", "pipe"])
        self.assertTrue((self.folder / "pipe").is_fifo())


class Endless(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("gap.csv", gap_text(parabola, n=601))
        self.write("case.nml", gap_case())

    def feed(self, text):
        """A pipe into which text flows as long as somebody reads."""
        os.mkfifo(self.folder / "pipe")

        def run():
            try:
                with open(self.folder / "pipe", "wb", buffering=0) as stream:
                    while True:
                        stream.write(text * 10000)
            except OSError:
                pass

        threading.Thread(target=run, daemon=True).start()

    def test_devices(self):
        for command in ("contact", "batch"):
            self.refused(1, command, "/dev/zero", says=["/dev/zero:1", "65536 characters"])

    def test_pipes(self):
        os.mkfifo(self.folder / "silent")
        self.refused(1, "contact", "silent", says=["silent", "nobody writes"])
        self.feed(b"# nothing\n")
        self.refused(1, "batch", "pipe", says=["pipe:1200001", "1200000 lines"])

    def test_pipes_that_are_written_at_once(self):
        """Who feeds them has written all, and is gone, before they are read."""
        os.mkfifo(self.folder / "pipe")
        self.write("piped.nml", gap_case("pipe"))
        self.write("gap.csv", gap_text(parabola, n=61))
        self.write("b.csv", f"{BATCH_COLUMNS}\na,gap.csv,210000,0.28,0.3,1e5,0.001,0,0\n")
        for name, words in (("gap.csv", ("contact", "piped.nml")),
                            ("case.nml", ("contact", "pipe")), ("b.csv", ("batch", "pipe"))):
            with subprocess.Popen([PROGRAM, *words], cwd=self.folder, stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, encoding="utf-8") as process:
                (self.folder / "pipe").write_bytes((self.folder / name).read_bytes())
                try:
                    said = process.communicate(timeout=PATIENCE / 10)
                except subprocess.TimeoutExpired:
                    process.kill()
                    self.fail(f"{name} is waited for without end")
            self.assertEqual((process.returncode, len(rows_of(said[0]))), (0, 1), (name, said[1]))

    def test_a_case_file(self):
        self.feed(b"&contact\n")
        self.refused(1, "contact", "pipe", says=["pipe:", "10000 lines"])

    def test_work(self):
        for words in (("--error-target", "1e-12", "--max-elements", "20000"),
                      ("--element-dx", "1e-4", "--element-dy", "1e-4")):
            self.refused(1, "contact", "case.nml", "--normal", "norm", *words,
                         says=["max_elements", "gap.csv"])
        self.write("n.nml", gap_case(extra="&numerics\n normal = 'norm'\n max_elements = 100\n/\n"))
        self.refused(1, "contact", "n.nml", says=["max_elements", "100"])
        self.refused(2, "contact", "case.nml", "--max-elements", "0",
                     says=["--max-elements", "'0'"])
