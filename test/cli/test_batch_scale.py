"""`faststrip batch` with threads, in parts, ended and resumed, and `faststrip merge`: the same
bytes whatever happens."""

import hashlib
import os
import random
import resource
import signal
import subprocess
import threading
import time

from cli_program import (
    BATCH_COLUMNS,
    GAPS,
    PATIENCE,
    PROGRAM,
    ROOT,
    ProgramTest,
    gap_text,
    parabola,
    rows_of,
    without_progress,
)

CONTACT = ROOT / "reference" / "contact" / "s1002_uic60_B.csv"


def table(count, seed=1):
    """Contacts of the paper's gaps under other loads and creepages, every ninth one wrong."""
    rng = random.Random(seed)
    cases = rows_of(CONTACT.read_text(encoding="utf-8"))
    lines = [f"{BATCH_COLUMNS},remark"]
    for k in range(count):
        case = cases[rng.randrange(len(cases))]
        gap = GAPS / f"shift_{case['yw_mm']}.csv"
        load = float(case["Fn_N"]) * rng.uniform(0.6, 1.2)
        if k % 9 == 4:
            gap, load = [(GAPS / "none.csv", load), (gap, -1.0)][k % 2]
        creepages = (rng.uniform(-3e-3, 3e-3), rng.uniform(-3e-3, 3e-3), rng.uniform(-4e-4, 4e-4))
        lines.append(f"{k},{gap},209920,0.28,0.3,{load!r},{','.join(map(repr, creepages))},"
                     f"\"row {k}, said \"\"so\"\"\"")
    return "\n".join(lines) + "\n"


class Scale(ProgramTest):
    def bytes_of(self, name):
        return (self.folder / name).read_bytes()

    def solve(self, *words, code=1):
        done = self.run_program("batch", *words)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())


class Threads(Scale):
    def test_bytes_do_not_depend_on_threads(self):
        self.write("cases.csv", table(150))
        for words in ((), ("--chain", "7"), ("--normal", "norm", "--tangential", "tang",
                                             "--element-dx", "0.8", "--element-dy", "0.8"),
                      ("--normal", "auto", "--target", "pmax")):
            with self.subTest(words):
                said = self.solve("cases.csv", "-o", "one.csv", "--threads", "1", *words)
                self.assertEqual(len(said.splitlines()), 18)
                for n in (2, 8):
                    self.assertEqual(
                        self.solve("cases.csv", "-o", "more.csv", "--threads", n, *words), said)
                    self.assertEqual(self.bytes_of("more.csv"), self.bytes_of("one.csv"))

    def test_rows_do_not_know_of_each_other(self):
        lines = table(40).splitlines()
        self.write("cases.csv", "\n".join(lines) + "\n")
        self.write("back.csv", "\n".join([lines[0], *lines[:0:-1]]) + "\n")
        self.solve("cases.csv", "-o", "there.csv")
        self.solve("back.csv", "-o", "back_again.csv", "--threads", "1")
        self.assertEqual(self.read("there.csv"), self.read("back_again.csv")[::-1])

    def test_chains_start_from_nothing(self):
        self.write("gap.csv", gap_text(parabola, n=301))
        lines = [BATCH_COLUMNS] + [f"{k},gap.csv,209920,0.28,0.3,{9e4 + 1e3 * k!r},0.001,0,1e-4"
                                   for k in range(12)]
        self.write("cases.csv", "\n".join(lines) + "\n")
        cold = self.good("batch", "cases.csv")
        warm = self.good("batch", "cases.csv", "--chain", "4")
        for k, (one, other) in enumerate(zip(cold, warm, strict=True)):
            if k % 4 == 0:
                self.assertEqual(one, other)
            for name in ("penetration_mm", "pmax_MPa", "Fx_N"):
                self.assert_close(float(other[name]), float(one[name]), 1e-4, what=(k, name))
        self.assertGreater(sum(one != other for one, other in zip(cold, warm)), 6)

    def test_times_are_told_if_asked_for(self):
        self.write("cases.csv", table(3))
        for row in self.good("batch", "cases.csv"):
            self.assertEqual((row["normal_us"], row["tangential_us"]), ("", ""))
        for row in self.good("batch", "cases.csv", "--times"):
            self.assertGreater(float(row["normal_us"]), 0.0)
            self.assertGreater(float(row["tangential_us"]), 0.0)
        words = ("batch", "cases.csv", "--normal", "auto")
        self.assertNotIn(" us", self.good(*words)[0]["choice"])
        self.assertIn(" us", self.good(*words, "--times")[0]["choice"])

    def test_what_is_not_a_number_of_threads_or_parts(self):
        self.write("cases.csv", table(3))
        for words in (("--threads", "0"), ("--threads", "x"), ("--chain", "0"), ("--part", "0/3"),
                      ("--part", "4/3"), ("--part", "3"), ("--part", "1/x"), ("--parts", "0"),
                      ("--part", "1/2", "--parts", "2")):
            self.refused(2, "batch", "cases.csv", "-o", "out.csv", *words, says=[words[0]])
        for word in ("--part=1/2", "--parts=2", "--resume"):
            self.refused(2, "batch", "cases.csv", word, says=[word.split("=")[0], "-o"])
            self.refused(2, "batch", "/dev/null", "-o", "out.csv", word, says=["/dev/null"])


class Parts(Scale):
    def setUp(self):
        super().setUp()
        self.write("cases.csv", table(60))
        self.said = self.solve("cases.csv", "-o", "whole.csv")

    def make_parts(self, count, *words, name="part"):
        names = [f"{name}_{k + 1}.csv" for k in range(count)]
        for k, path in enumerate(names):
            self.run_program("batch", "cases.csv", "--part", f"{k + 1}/{count}", "-o", path, *words)
        return names

    def test_parts_make_the_whole(self):
        for count in (1, 3, 7, 61):
            parts = self.make_parts(count)
            random.Random(count).shuffle(parts)
            done = self.run_program("merge", *parts, "-o", "merged.csv")
            self.assertEqual((done.returncode, done.stderr), (1, self.said.splitlines()[-1] + "\n"))
            self.assertEqual(self.bytes_of("merged.csv"), self.bytes_of("whole.csv"))
        done = self.run_program("merge", *parts)
        self.assertEqual(done.stdout.encode(), self.bytes_of("whole.csv"))

    def test_chains_stay_together(self):
        self.solve("cases.csv", "-o", "whole.csv", "--chain", "7")
        self.run_program("merge", *self.make_parts(4, "--chain", "7"), "-o", "merged.csv")
        self.assertEqual(self.bytes_of("merged.csv"), self.bytes_of("whole.csv"))

    def test_a_manifest(self):
        self.make_parts(3)
        manifest = {row["name"]: row["value"] for row in self.read("part_2.csv.manifest")}
        sums = subprocess.run(["sha256sum", "cases.csv", "part_2.csv"], cwd=self.folder,
                              stdout=subprocess.PIPE, encoding="utf-8", check=True).stdout.split()
        rows = self.read("part_2.csv")
        self.assertEqual([row["case"] for row in rows], [str(k) for k in range(20, 40)])
        for name, value in (("kind", "batch"), ("items", "60"), ("part", "2"), ("parts", "3"),
                            ("first", "21"), ("done", "20"), ("input", "cases.csv"),
                            ("input_sha256", sums[0]), ("sha256", sums[2]), ("options", ""),
                            ("bytes", str(len(self.bytes_of("part_2.csv"))))):
            self.assertEqual(manifest[name], value, name)
        for word in {row["status"] for row in rows}:
            self.assertEqual(manifest[f"status {word}"],
                             str([row["status"] for row in rows].count(word)))
        stamps = [line[2:] for line in self.bytes_of("whole.csv").decode().splitlines()[:2]]
        self.assertEqual([manifest["revision"], f"compiler {manifest['compiler']}"], stamps)

    def gap_cases(self, count=60):
        """Half of the rows name one gap in this folder, half another one."""
        lines = [f"{k},{'ab'[2 * k // count]}.csv,209920,0.28,0.3,{50000 + k},0.001,0,0"
                 for k in range(count)]
        self.write("cases.csv", "\n".join([BATCH_COLUMNS, *lines]) + "\n")
        self.write("a.csv", gap_text(parabola))
        self.write("b.csv", gap_text(lambda y: 1.1 * parabola(y)))

    def test_gaps_that_are_no_longer_those(self):
        self.gap_cases()
        parts = self.make_parts(3)
        manifest = {row["name"]: row["value"] for row in self.read("part_2.csv.manifest")}
        for name in ("a.csv", "b.csv"):
            self.assertEqual(manifest[f"gap_sha256 {name}"],
                             hashlib.sha256(self.bytes_of(name)).hexdigest())
        self.solve("cases.csv", "-o", "merged.csv", "--parts", "3", code=0)
        joined = {row["name"]: row["value"] for row in self.read("merged.csv.manifest")}
        for name in ("a.csv", "b.csv"):
            self.assertEqual(joined[f"gap_sha256 {name}"], manifest[f"gap_sha256 {name}"])
        self.write("b.csv", gap_text(lambda y: 1.2 * parabola(y)))
        self.refused(1, "batch", "cases.csv", "-o", "merged.csv", "--parts", "3",
                     says=["merged.csv is there", "b.csv has changed"])
        # The first part never saw it.
        self.solve("cases.csv", "-o", parts[0], "--part", "1/3", "--resume", code=0)
        for part, words in ((parts[1], ("--part", "2/3")), (parts[2], ("--part", "3/3"))):
            kept = self.bytes_of(part)
            self.refused(1, "batch", "cases.csv", *words, "--resume", "-o", part,
                         says=["cannot resume", part, "b.csv has changed"])
            self.assertEqual(self.bytes_of(part), kept)
        self.run_program("batch", "cases.csv", "--part", "3/3", "-o", parts[2])
        self.refused_and_untouched("merge", *parts, says=["gap file b.csv", parts[2]])
        (self.folder / "b.csv").unlink()
        self.refused(1, "batch", "cases.csv", "--part", "3/3", "--resume", "-o", parts[2],
                     says=["b.csv has changed"])

    def test_parts_that_do_not_fit(self):
        parts = self.make_parts(3)
        other = self.make_parts(3, "--chain", "2", name="other")
        self.write("alone.csv", "a\n1\n")
        for names, says in ((parts[:2], ["part 3 of 3 is missing"]),
                            ([*parts, parts[0]], ["part 1 is there twice", parts[0]]),
                            ([parts[0], other[1], parts[2]], ["options", "--chain=2", other[1]]),
                            (["none.csv"], ["no such file: none.csv.manifest"]),
                            (["alone.csv"], ["no such file: alone.csv.manifest"])):
            self.refused_and_untouched("merge", *names, says=says)
        text = self.bytes_of(parts[1])
        for broken in (text[:-1], text.replace(b"20", b"21", 1), text + b"\n"):
            (self.folder / parts[1]).write_bytes(broken)
            self.refused_and_untouched("merge", *parts, says=["its manifest", parts[1]])
        (self.folder / parts[1]).write_bytes(text)
        self.write("cases.csv", table(60, seed=2))
        self.run_program("batch", "cases.csv", "--part", "2/3", "-o", parts[1])
        self.refused_and_untouched("merge", *parts, says=["input_sha256", parts[1]])
        self.refused(2, "merge", *parts, "-o", parts[0], says=["-o", parts[0]])

    def test_processes_share_the_parts(self):
        before = self.names()
        words = [str(PROGRAM), "batch", "cases.csv", "--parts", "12", "-o", "out.csv", "--threads",
                 "1"]
        done = [subprocess.Popen(words, cwd=self.folder, stdout=subprocess.PIPE,
                                 stderr=subprocess.PIPE, encoding="utf-8") for _ in range(3)]
        said = []
        for process in done:
            out, err = process.communicate(timeout=PATIENCE)
            self.assertEqual((process.returncode, out), (1, ""))
            said += without_progress(err).splitlines()
        self.assertEqual(self.bytes_of("out.csv"), self.bytes_of("whole.csv"))
        self.assertEqual(self.names(), sorted([*before, "out.csv", "out.csv.manifest"]))
        # Each wrong row is told once, and by each process how many there are.
        last = self.said.splitlines()[-1]
        self.assertEqual(sorted(said), sorted([*self.said.splitlines(), last, last]))
        # It is made: nobody makes it again, nor something else in its place.
        done = self.run_program(*words[1:])
        self.assertEqual((done.returncode, done.stderr), (1, last + "\n"))
        self.refused(1, *words[1:], "--chain", "2", says=["options", "out.csv.manifest"])
        # What was changed and is as long as before is made anew.
        (self.folder / "out.csv").write_bytes(self.bytes_of("whole.csv").replace(b"20", b"21", 1))
        self.run_program(*words[1:])
        self.assertEqual(self.bytes_of("out.csv"), self.bytes_of("whole.csv"))

    def test_a_lost_process(self):
        words = [str(PROGRAM), "batch", "cases.csv", "--parts", "5", "-o", "out.csv",
                 "--threads", "1"]
        for wait in (0.02, 0.06):
            lost = subprocess.Popen(words, cwd=self.folder, stderr=subprocess.DEVNULL)
            time.sleep(wait)
            lost.kill()
            lost.wait()
        self.run_program(*words[1:])
        self.assertEqual(self.bytes_of("out.csv"), self.bytes_of("whole.csv"))


class Ended(Scale):
    """Runs that are ended, and gone on with."""

    def setUp(self):
        super().setUp()
        self.write("cases.csv", table(900))
        self.solve("cases.csv", "-o", "whole.csv")

    def start(self, *words, setup=None):
        return subprocess.Popen([PROGRAM, "batch", "cases.csv", "-o", "out.csv", "--threads", "2",
                                 *words], cwd=self.folder, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, encoding="utf-8", preexec_fn=setup)

    def begun(self, process):
        """Wait until something is written."""
        while process.poll() is None and "out.csv.partial" not in self.names():
            time.sleep(0.002)

    def resume(self, *words):
        self.solve("cases.csv", "-o", "out.csv", "--resume", *words)
        self.assertEqual(self.bytes_of("out.csv"), self.bytes_of("whole.csv"))
        self.assertEqual(self.names(), ["cases.csv", "out.csv", "whole.csv"])
        (self.folder / "out.csv").unlink()

    def test_killed_at_any_moment(self):
        rng = random.Random(5)
        for _ in range(4):
            for _ in range(rng.randrange(1, 4)):
                process = self.start("--resume")
                if rng.random() < 0.7:
                    self.begun(process)
                time.sleep(rng.uniform(0.0, 0.1))
                process.kill()
                process.communicate()
            self.resume()

    def test_a_gap_that_changes_meanwhile(self):
        # Two gaps for which there is not room enough: one of them is read again and again.
        self.write("cases.csv", "\n".join([BATCH_COLUMNS] + [
            f"{k},{'ab'[k % 2]}.csv,209920,0.28,0.3,50000,0,0,0" for k in range(600)]) + "\n")
        for name in ("a.csv", "b.csv"):
            self.write(name, gap_text(parabola, n=110001))
        process = self.start("--normal", "hertz", "--tangential", "none")
        self.begun(process)
        self.write("c.csv", gap_text(lambda y: 1.1 * parabola(y), n=110001))
        os.replace(self.folder / "c.csv", self.folder / "a.csv")
        self.write("c.csv", gap_text(lambda y: 1.1 * parabola(y), n=110001))
        os.replace(self.folder / "c.csv", self.folder / "b.csv")
        said = without_progress(process.communicate()[1]).splitlines()
        self.assertEqual(process.returncode, 1, said)
        self.assertRegex(said[-1], r"gap file has changed since other rows were solved: [ab]\.csv")
        self.refused(1, "batch", "cases.csv", "-o", "out.csv", "--resume", "--normal", "hertz",
                     "--tangential", "none", says=["cannot resume out.csv", "has changed"])

    def test_a_table_that_is_cut_meanwhile(self):
        os.mkfifo(self.folder / "pipe.csv")
        self.write("gap.csv", gap_text(parabola, n=61))
        rows = [f"{k},{'gap' if k else 'pipe'}.csv,209920,0.28,0.3,50000,0,0,0"
                for k in range(9000)]
        lines = [line + "\n" for line in [BATCH_COLUMNS, *rows]]
        self.write("cases.csv", "".join(lines))
        process = self.start("--normal", "hertz", "--tangential", "none")
        # Opened once the program has counted the rows and wants the first gap.
        with open(self.folder / "pipe.csv", "w", encoding="utf-8") as pipe:
            os.truncate(self.folder / "cases.csv", len("".join(lines[:6000])))
            pipe.write(gap_text(parabola, n=61))
        said = without_progress(process.communicate()[1]).splitlines()
        self.assertEqual(process.returncode, 1, said)
        self.assertRegex(said[-1], r"the file has changed.* \(cases.csv:6000\)")
        self.assertFalse((self.folder / "out.csv").exists())

    def test_what_was_done_is_not_done_again(self):
        process = self.start()
        self.begun(process)
        process.kill()
        process.communicate()
        self.assertEqual(self.names(), ["cases.csv", "out.csv.journal", "out.csv.lock",
                                        "out.csv.partial", "whole.csv"])
        done = int({row["name"]: row["value"] for row in self.read("out.csv.journal")}["done"])
        self.assertGreater(done, 0)
        said = self.solve("cases.csv", "-o", "out.csv", "--resume").splitlines()
        self.assertEqual(said[-1], "faststrip: 100 of 900 contacts failed")
        for line in said[:-1]:
            self.assertGreater(int(line.split()[2]), done)
        self.assertEqual(self.bytes_of("out.csv"), self.bytes_of("whole.csv"))

    def test_ended_by_a_signal(self):
        self.write("out.csv", "old\n")
        process = self.start()
        self.begun(process)
        process.terminate()
        said = without_progress(process.communicate()[1]).splitlines()
        self.assertEqual(process.returncode, 128 + signal.SIGTERM)
        self.assertRegex(said[-1], r"\Afaststrip: ended by signal TERM ")
        self.assertEqual(self.bytes_of("out.csv"), b"old\n")
        self.assertEqual(self.names(), ["cases.csv", "out.csv", "out.csv.journal",
                                        "out.csv.partial", "whole.csv"])
        self.resume()

    def test_a_full_disk(self):
        def setup():
            # Then a file that grows too large is an error as that of a full disk.
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (200000, 200000))

        self.write("out.csv", "old\n")
        process = self.start(setup=setup)
        said = without_progress(process.communicate()[1]).splitlines()
        if process.returncode == 128 + signal.SIGXFSZ:
            self.assertRegex(said[-1], r"ulimit -f")
        else:
            self.assertEqual(process.returncode, 1)
            self.assertEqual(said[-1], "faststrip: cannot write the file: out.csv: File too large")
        self.assertEqual(self.bytes_of("out.csv"), b"old\n")
        self.resume()

    def test_two_runs_on_one_output(self):
        process = self.start()
        self.begun(process)
        process.send_signal(signal.SIGSTOP)
        for words in ((), ("--resume",), ("--part", "1/2")):
            self.refused(1, "batch", "cases.csv", "-o", "out.csv", *words,
                         says=["another run is writing", "out.csv", f"process {process.pid} on"])
        process.send_signal(signal.SIGCONT)
        process.communicate()
        self.assertEqual(self.bytes_of("out.csv"), self.bytes_of("whole.csv"))

    def test_other_work_is_not_resumed(self):
        process = self.start()
        self.begun(process)
        process.kill()
        process.communicate()
        kept = self.bytes_of("out.csv.partial")
        for words, says in ((("--chain", "2"), ["options was , is --chain=2"]),
                            (("--normal", "hertz"), ["--normal=hertz"]),
                            (("--part", "1/2"), ["parts was 1, is 2"])):
            self.refused(1, "batch", "cases.csv", "-o", "out.csv", "--resume", *words,
                         says=["cannot resume out.csv", *says])
        self.write("cases.csv", table(900, seed=3))
        self.refused(1, "batch", "cases.csv", "-o", "out.csv", "--resume", says=["input_sha256"])
        self.write("cases.csv", table(900))
        self.assertEqual(self.bytes_of("out.csv.partial"), kept)
        (self.folder / "out.csv.partial").write_bytes(b"#" + kept[1:-1] + b"x")
        self.refused(1, "batch", "cases.csv", "-o", "out.csv", "--resume", says=["is not what"])
        (self.folder / "out.csv.partial").write_bytes(kept)
        self.resume()

    def test_what_lies_behind_the_last_piece_is_dropped(self):
        process = self.start()
        self.begun(process)
        process.kill()
        process.communicate()
        with open(self.folder / "out.csv.partial", "ab") as stream:
            stream.write(b"a piece of which no journal tells\n" * 100000)
        self.resume()
        self.solve("cases.csv", "-o", "out.csv", "--part", "1/9")
        self.assertLess(len(self.bytes_of("out.csv")), len(self.bytes_of("whole.csv")) / 5)

    def test_ended_between_the_name_and_the_end_of_the_journal(self):
        for words, names in ((("--part", "1/1"), ["out.csv", "out.csv.manifest"]),
                             ((), ["out.csv"])):
            self.solve("cases.csv", "-o", "out.csv", "--part", "1/1")
            (self.folder / "out.csv.manifest").rename(self.folder / "out.csv.journal")
            made = os.stat(self.folder / "out.csv")
            said = self.solve("cases.csv", "-o", "out.csv", "--resume", *words)
            self.assertEqual(said, "faststrip: 100 of 900 contacts failed\n")
            self.assertEqual(os.stat(self.folder / "out.csv").st_mtime_ns, made.st_mtime_ns)
            self.assertEqual(self.bytes_of("out.csv"), self.bytes_of("whole.csv"))
            self.assertEqual(self.names(), ["cases.csv", *names, "whole.csv"])
        # What has another content by then is no output of that journal.
        self.solve("cases.csv", "-o", "out.csv", "--part", "1/1")
        (self.folder / "out.csv.manifest").rename(self.folder / "out.csv.journal")
        (self.folder / "out.csv").write_bytes(self.bytes_of("whole.csv")[:-2] + b"9\n")
        self.resume()

    def test_ended_before_the_first_piece_had_its_name(self):
        process = self.start()
        self.begun(process)
        process.kill()
        process.communicate()
        (self.folder / "out.csv.partial").unlink()
        self.resume()

    def test_an_output_of_other_options_is_not_taken_as_made(self):
        for first, second in (((), ("--chain", "3")), (("--chain", "3"), ())):
            self.solve("cases.csv", "-o", "wanted.csv", "--part", "2/9", *second)
            self.solve("cases.csv", "-o", "part.csv", "--part", "2/9", *first)
            self.solve("cases.csv", "-o", "part.csv", "--part", "2/9", "--resume", *second)
            self.assertEqual(self.bytes_of("part.csv"), self.bytes_of("wanted.csv"))
            self.assertEqual(self.bytes_of("part.csv.manifest"),
                             self.bytes_of("wanted.csv.manifest"))
        self.solve("cases.csv", "-o", "part.csv", "--part", "3/9", "--resume")
        self.assertNotEqual(self.bytes_of("part.csv"), self.bytes_of("wanted.csv"))

    def test_a_part_that_is_made_is_not_made_again(self):
        words = ("cases.csv", "-o", "part.csv", "--part", "2/9", "--resume")
        self.assertEqual(len(self.solve(*words).splitlines()), 12)
        made = os.stat(self.folder / "part.csv")
        self.assertEqual(len(self.solve(*words).splitlines()), 1)
        self.assertEqual(os.stat(self.folder / "part.csv").st_mtime_ns, made.st_mtime_ns)


class Streams(Scale):
    def feed(self, text, head=b""):
        """A pipe into which text flows as long as somebody reads."""
        os.mkfifo(self.folder / "pipe")

        def run():
            try:
                with open(self.folder / "pipe", "wb", buffering=0) as stream:
                    stream.write(head)
                    while True:
                        stream.write(text * 10000)
            except OSError:
                pass

        threading.Thread(target=run, daemon=True).start()

    def test_rows_from_a_pipe(self):
        text = table(200)
        self.write("cases.csv", text)
        said = self.solve("cases.csv", "-o", "file.csv")
        done = subprocess.run([PROGRAM, "batch", "/dev/stdin", "-o", "pipe.csv"], cwd=self.folder,
                              input=text.encode(), stderr=subprocess.PIPE, check=False,
                              timeout=PATIENCE)
        self.assertEqual(self.bytes_of("pipe.csv"), self.bytes_of("file.csv"))
        self.assertEqual(without_progress(done.stderr.decode()).replace("/dev/stdin", "cases.csv"),
                         said)
        self.assertEqual(self.names(), ["cases.csv", "file.csv", "pipe.csv"])

    def test_comments_without_end(self):
        self.feed(b"# no row\n", head=table(1).encode())
        self.refused(1, "batch", "pipe", "-o", "out.csv",
                     says=["pipe:1200003", "1200000 lines without a row"])
        self.assertEqual(self.names(), ["pipe"])

    def test_memory_does_not_grow_with_the_rows(self):
        lines = table(9).splitlines()
        lines = [lines[0], *(line for k, line in enumerate(lines[1:]) if k != 4)]
        sizes = []
        for count in (500, 8000):
            self.write("cases.csv", "\n".join([lines[0], *(lines[1:] * count)[:count]]) + "\n")
            sizes.append(self.peak_memory("batch", "cases.csv", "-o", "out.csv", "--threads", "2",
                                          "--normal", "hertz", "--tangential", "none"))
            self.assertEqual(len(self.read("out.csv")), count)
        self.assertLess(sizes[1], sizes[0] + 30000)
        self.assertLess(sizes[1], 100000)

    def test_a_row_that_is_none_is_found_before_all_others_are_solved(self):
        self.write("cases.csv", table(5000) + "1,2\n")
        self.write("out.csv", "old\n")
        self.refused_and_untouched("batch", "cases.csv", says=["cases.csv:5002", "10 cells"])

    def test_quiet(self):
        self.write("cases.csv", table(3000))
        done = subprocess.run([PROGRAM, "batch", "cases.csv", "-o", "out.csv", "--quiet"],
                              cwd=self.folder, stderr=subprocess.PIPE, encoding="utf-8",
                              timeout=PATIENCE, check=False)
        self.assertEqual(without_progress(done.stderr), done.stderr)
