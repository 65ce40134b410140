"""A run that is ended leaves the old output, no other file, and one line."""

import functools
import os
import random
import resource
import signal
import subprocess
import time

from cli_program import (
    BATCH_COLUMNS,
    LAB,
    PATIENCE,
    PROGRAM,
    ProgramTest,
    gap_case,
    gap_text,
    parabola,
    without_progress,
)

# Renaming and ending are slow, so that most signals come while a file has no name yet, and other
# threads go on behind the handler.
SLOW = r"""
#define _GNU_SOURCE
#include <fcntl.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>
static void nap(void)
{
    struct timespec time = { 0, 20000000 };
    nanosleep(&time, NULL);
}
int rename(const char *old, const char *new)
{
    nap();
    return (int)syscall(SYS_renameat2, AT_FDCWD, old, AT_FDCWD, new, 0);
}
void _exit(int code)
{
    nap();
    for (;;)
        syscall(SYS_exit_group, code);
}
"""
ROW = "a,gap.csv,210000,0.28,0.3,1e5,0.001,0,0"


def as_from_a_shell(setup=None):
    """In the child: signals that a parent ignores are not ignored here."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT):
        signal.signal(number, signal.SIG_DFL)
    if setup:
        setup()


class Signals(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("gap.csv", gap_text(parabola, n=601))
        self.write("case.nml", gap_case())
        self.write("cases.csv", "\n".join([BATCH_COLUMNS] + [ROW] * 100000) + "\n")
        self.write("out.csv", "old\n")

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())

    def start(self, setup=None, library=None):
        """A batch that takes long, once it has begun to write."""
        environment = {**os.environ, **({"LD_PRELOAD": library} if library else {})}
        process = subprocess.Popen([PROGRAM, "batch", "cases.csv", "-o", "out.csv"],
                                   cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   encoding="utf-8", env=environment,
                                   preexec_fn=functools.partial(as_from_a_shell, setup))
        while process.poll() is None and "out.csv.journal" not in self.names():
            time.sleep(0.01)
        return process

    def left(self):
        """The files beside those of the test; what a batch leaves to be resumed is removed."""
        left = set(self.names()) - {"out.csv.partial", "out.csv.journal"}
        for name in set(self.names()) - left:
            (self.folder / name).unlink()
        return sorted(left)

    def ended(self, process):
        out, err = process.communicate(timeout=PATIENCE)
        self.assertEqual(out, "")
        self.assertEqual((self.folder / "out.csv").read_text(encoding="utf-8"), "old\n")
        return process.returncode, without_progress(err)

    def test_signals(self):
        names = self.names()
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT,
                       signal.SIGXFSZ, signal.SIGPIPE, signal.SIGXCPU, signal.SIGUSR1):
            process = self.start()
            process.send_signal(number)
            code, said = self.ended(process)
            self.assertEqual(code, 128 + number)
            self.assertRegex(said, rf"\Afaststrip: [^\n]* {number.name[3:]} [^\n]*\n\Z")
            self.assertEqual(self.left(), names)

    def test_a_signal_at_any_moment(self):
        """Also while a later journal is written, by whichever thread."""
        draw = random.Random(1)
        self.write("slow.c", SLOW)
        library = self.folder / "slow.so"
        subprocess.run(["gcc", "-shared", "-fPIC", "-o", library, "slow.c"], cwd=self.folder,
                       check=True, capture_output=True)
        names = self.names()
        for _ in range(12):
            process = self.start(library=str(library))
            time.sleep(0.2 * draw.random())
            process.terminate()
            self.assertEqual(self.ended(process)[0], 128 + signal.SIGTERM)
            self.assertEqual(self.left(), names)

    def test_the_laboratory_speaks_by_its_own_name(self):
        process = subprocess.Popen([LAB, "fuzz", "--cases", "1000000", "-o", "out.csv"],
                                   cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   encoding="utf-8", preexec_fn=as_from_a_shell)
        self.assertRegex(process.stderr.readline(), r"\Afaststrip-lab: [^\n]*, \d+ s\n\Z")
        process.terminate()
        code, said = self.ended(process)
        self.assertEqual(code, 128 + signal.SIGTERM)
        self.assertRegex(said, r"\Afaststrip-lab: ended by signal TERM [^\n]*\n\Z")

    def test_a_limit_of_file_sizes(self):
        names = self.names()
        process = self.start(lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (9000, 9000)))
        code, said = self.ended(process)
        self.assertEqual(code, 128 + signal.SIGXFSZ)
        self.assertRegex(said, r"\Afaststrip: [^\n]*ulimit -f[^\n]*\n\Z")
        self.assertEqual(self.left(), names)

    def test_what_was_made_to_be_ignored(self):
        process = self.start(lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        process.send_signal(signal.SIGHUP)
        time.sleep(0.2)
        self.assertIsNone(process.poll())
        process.send_signal(signal.SIGTERM)
        self.assertEqual(self.ended(process)[0], 128 + signal.SIGTERM)

    def test_leftovers(self):
        names = self.names()
        # A table that does not end: what is written of it is kept nowhere.
        os.mkfifo(self.folder / "pipe")
        words = [PROGRAM, "batch", "pipe", "-o", "out.csv"]

        def start():
            before = self.names()
            process = subprocess.Popen(words, cwd=self.folder, stdout=subprocess.PIPE,
                                       stderr=subprocess.PIPE, encoding="utf-8",
                                       preexec_fn=as_from_a_shell)
            stream = open(self.folder / "pipe", "w", encoding="utf-8")
            stream.write((self.folder / "cases.csv").read_text(encoding="utf-8")[:400000])
            while process.poll() is None and not any(
                    name.endswith(".tmp") and name not in before for name in self.names()):
                time.sleep(0.01)
            return process, stream

        killed, stream = start()
        killed.kill()
        self.ended(killed)
        stream.close()
        left = [name for name in self.names() if name.endswith(".tmp")]
        self.assertEqual(len(left), 1)
        going_on, stream = start()
        own = [name for name in self.names() if name not in [*names, *left]]
        self.write("notes_1.tmp", "not ours\n")
        self.refused(1, "contact", "none.nml", "-o", "other.csv")
        self.assertIn(left[0], self.names())
        self.good("contact", "case.nml", "-o", "other.csv")
        self.assertNotIn(left[0], self.names())
        for name in (*own, "notes_1.tmp"):
            self.assertIn(name, self.names())
        going_on.terminate()
        self.ended(going_on)
        stream.close()
        self.assertEqual(self.names(), sorted([*names, "notes_1.tmp", "other.csv", "pipe"]))

    def test_progress(self):
        process = self.start()
        said = process.stderr.readline()
        while "contacts" not in said:
            self.assertEqual(without_progress(said), "")
            said = process.stderr.readline()
        self.assertRegex(said, r"\Afaststrip: contacts \d+ of 100000, [\d.]+/s, "
                               r"\d+ (s|min|h) left, \d+ s\n\Z")
        process.terminate()
        self.ended(process)
