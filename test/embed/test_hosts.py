"""What the library never does to its host."""

import os
import re
import shutil
import subprocess
import unittest

import methods
from installed import HOSTS, ROOT, HostTest

# Bytes of stack a call may need; README and header claim less than 64 kB.
MOST_STACK = 64 * 1024


def sanitizer():
    """Can programs be compiled with the address sanitizer here?"""
    done = subprocess.run(["gcc", "-fsanitize=address", "-x", "c", "-", "-o", "/dev/null"],
                          input="int main(void) { return 0; }\n", encoding="utf-8",
                          stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    return done.returncode == 0


class Hosts(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.compile_host("host.c", "host")

    def test_flags_traps_and_rounding_stay(self):
        found = self.findings("./host arithmetic")
        self.assertEqual(found["traps"], [1] * 4)
        self.assertEqual(found["rounding"], [1] * 4)
        self.assertEqual(found["raised"], [0])
        self.assertEqual(found["kept"], [1])
        # Many of the calls were meant to fail, and do whatever the rounding.
        self.assertEqual(len(set(found["failures"])), 1)
        self.assertGreater(found["failures"][0], 200)

    def test_every_pointer_and_size_is_checked(self):
        found = self.findings("./host errors")
        self.assertEqual(found.get("line", []), [])
        self.assertEqual(found["wrong"], [0])
        self.assertGreater(found["checked"][0], 150)

    def test_freed_workspaces_are_told(self):
        self.assertEqual(self.findings("./host freed"), {"wrong": [0], "twins": [0]})

    def test_a_case_of_another_header_is_refused(self):
        found = self.findings("./host sizes")
        self.assertEqual(found["wrong"], [0])
        self.assertGreater(found["refused"][0], 200)

    def test_forked_processes_make_workspaces(self):
        self.assertEqual(self.findings("./host forked"), {"children": [300], "wrong": [0]})

    def test_the_first_fork_may_come_at_any_time(self):
        for _ in range(100):
            self.assertEqual(self.findings("./host forked_once"), {"children": [1], "wrong": [0]})

    def test_the_locale_stays(self):
        self.assertEqual(self.findings("./host locale"), {"program": [1], "thread": [1]})

    def test_nothing_is_allocated_and_no_file_touched(self):
        self.compile_host("host.c", "counting", "-DCOUNTING")
        found = self.findings("./counting quiet")
        self.assertGreater(found["solved"][0], 450)
        self.assertEqual(found["solving"], [0])
        self.assertGreater(found["rolled"][0], 8)
        self.assertEqual(found["rolling"], [0])
        self.assertGreater(found["worn"][0], 150)
        self.assertEqual(found["wearing"], [0])
        # Not for the words of limitations either.
        self.assertGreater(found["rough"][0], 20)
        self.assertGreater(found["missed"][0], 5)
        self.assertGreater(found["limited"][0], found["rough"][0] + found["missed"][0])
        self.assertEqual(found["files"], [0])
        # The counters do count: a workspace is many arrays, a line of findings one call.
        self.assertGreater(found["making"][0], 20)
        self.assertGreater(found["written"][0], 0)

    @unittest.skipIf(os.environ.get("FASTSTRIP_NOT_OPTIMIZED"), "frames are larger in such a build")
    def test_the_stack_is_bounded(self):
        found = self.findings("./host stack")
        for name in ("stack", "wheelset"):
            self.assertGreater(found[name][0], 1000)
            self.assertLess(found[name][0], MOST_STACK)

    def test_an_answer_also_when_memory_runs_out(self):
        found = self.findings("./host little_memory")
        self.assertGreater(found["made"][0], 0)
        self.assertGreater(found["refused"][0], 0)

    @unittest.skipUnless(shutil.which("valgrind"), "needs valgrind")
    def test_no_leak_under_valgrind(self):
        # In one process, which takes ten seconds to start; of what is freed a few say as much.
        self.compile_host("host.c", "plain", "-DKEPT=8")
        text = self.shell("valgrind --error-exitcode=9 --leak-check=full"
                          " --errors-for-leak-kinds=definite,indirect"
                          " ./plain memory freed sizes errors 2>&1")
        self.assertRegex(text, "ERROR SUMMARY: 0 errors")
        lost = re.search(r"definitely lost: ([\d,]+) bytes", text)
        self.assertTrue(lost is None or lost[1] == "0", text)
        self.assertEqual(re.findall(r"(?m)^(copy|wrong) (\d+)$", text),
                         [("copy", "0"), ("wrong", "0"), ("wrong", "0"), ("wrong", "0")])

    @unittest.skipUnless(sanitizer(), "needs the address sanitizer")
    def test_no_leak_under_the_address_sanitizer(self):
        self.compile_host("host.c", "asan", "-fsanitize=address,undefined -DKEPT=8")
        found = self.findings("./asan memory errors freed sizes")
        self.assertEqual(found["copy"], [0])
        self.assertEqual(found["wrong"], [0, 0, 0])


class Threads(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.compile_host("threads.c", "threads", "-O2 -fopenmp")
        # What races, races between two; each thread takes its time for its workspaces.
        cls.compile_host("threads.c", "three", "-O2 -fopenmp -DTHREADS=3")
        cls.compile_host("host.c", "few", "-DKEPT=8")

    @unittest.skipUnless(shutil.which("valgrind"), "needs valgrind")
    def test_no_race_under_valgrind(self):
        # Both tools find races by the same rule; drd takes three times as long for solutions.
        text = self.shell("valgrind --tool=helgrind --error-exitcode=9 ./three 20 posix 2>&1")
        self.assertRegex(text, r"ERROR SUMMARY: 0 errors")
        self.assertRegex(text, r"(?m)^pthreads 0$")
        text = self.shell("valgrind --tool=drd --error-exitcode=9 ./few freed 2>&1")
        self.assertRegex(text, r"ERROR SUMMARY: 0 errors")

    def test_eight_threads_give_the_serial_bits(self):
        found = self.findings("./threads 600")
        self.assertGreater(found["solved"][0], 570)
        self.assertEqual(found["pthreads"], [0])
        self.assertEqual(found["openmp"], [0])

    def test_the_library_has_no_variables_but_the_register(self):
        """No data race by design: nothing that outlives a call is ever written, but the register
        of workspaces in use, which has a lock.

        The compiler puts tables that are constant among the data (of types, defaults, jumps, and
        arrays `A.n` with their values), and the counters of implied loops it has evaluated itself.
        So are the methods of the core: objects, for pointers to them, that nobody writes.
        """
        constant = re.compile(r". \w*(___vtab_|___def_init_|_MOD_[a-z]_$)|. jumptable\.|. DW\.ref\."
                              r"|d A\.[\d.]+$"
                              r"|[dD] __faststrip_contact_method_\w+_MOD_(\w+_method|no_forces)$"
                              r"|[bd] __faststrip_interop_register_MOD_\w+$|b mutex$")
        done = subprocess.run(["nm", self.installed.archive], stdout=subprocess.PIPE,
                              encoding="utf-8", check=True)
        writable = re.findall(r"^[0-9a-f]+ ([bBdDcC] \S+)$", done.stdout, re.MULTILINE)
        self.assertGreater(len(writable), 3)
        self.assertEqual([name for name in writable if not constant.match(name)], [])
        methods = {name.rsplit("_MOD_")[1] for name in writable if "_contact_method_" in name}
        methods = {name for name in methods if not name.startswith("__")}
        self.assertGreater(len(methods), 15)
        for path in (ROOT / "src").rglob("*.f90"):
            text = path.read_text(encoding="utf-8")
            self.assertNotRegex(text, rf"(?m)^(?!.*::).*\b(?:{'|'.join(methods)})(?:%\w+)? = ",
                                path.name)

    def test_a_host_adds_a_method(self):
        """Types of the library can be extended by who only has it installed; the new method's
        pressures carry the load, and FASTSTRIP finds forces on them within mu N; a law of its own
        has mu N."""
        for library in ("-lfaststrip", f"'{self.installed.archive}' -lopenblas"):
            self.shell(f"gfortran -O1 -J. '{HOSTS}/method.f90' $(pkg-config --cflags faststrip)"
                       f" -L'{self.installed.library.parent}' {library} -o method")
            lines = self.shell("./method").splitlines()
            self.assertEqual([line.split()[1] for line in lines], ["1", "101", "1"])
            force = 0.0
            for line in lines:
                load, _, fx, fy = (float(word) for word in line.split()[3::2])
                force = (fx * fx + fy * fy) ** 0.5
                self.assertAlmostEqual(load, 8e4, delta=0.005)
                self.assertTrue(1e4 < force < 0.3 * load + 0.005)
            self.assertAlmostEqual(force, 0.3 * 8e4, delta=0.005)

    def test_the_tour_takes_all_names(self):
        self.shell(f"gfortran -O1 -Wall -Wextra -Werror '{HOSTS}/tour.f90'"
                   " $(pkg-config --cflags --libs faststrip) -o tour")
        lines = self.shell("./tour").splitlines()
        for part, more in (("normal", 0), ("tangential", 1)):
            # Without forces there are none to print.
            self.assertEqual(sum(line.startswith(f"{part} ") for line in lines),
                             len(methods.listed(part)) - more)
        self.assertEqual(sum(line.startswith("side ") for line in lines), 6)
        carried = [float(line.split()[3]) for line in lines if line.startswith("side ")]
        self.assertAlmostEqual(sum(carried[2:4]), 1.6e5, delta=0.005)
