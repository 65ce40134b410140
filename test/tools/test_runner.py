"""What the generated runner runs, counts and returns."""

import pathlib
import tempfile
import unittest

from harness import Sample, module, test

PASSING = test("passes", "@assertTrue(.true.)")
FAILING = test("fails", "@assertTrue(.true.)", "@assertEqual(1, 2, message='one is not two')")

FIXTURE = """\
    @before
    subroutine set_up()
        print '(a)', 'set up'
{0}    end subroutine set_up

    @after
    subroutine tear_down()
        print '(a)', 'tear down'
    end subroutine tear_down

    @test
    subroutine second_in_the_alphabet()
        print '(a)', 'first test'
        @assertTrue(.false.)
        print '(a)', 'not reached'
    end subroutine second_in_the_alphabet

    @test
    @disable
    subroutine left_out()
        print '(a)', 'disabled test'
    end subroutine left_out

    @test
    subroutine a_test()
        print '(a)', 'second test'
    end subroutine a_test
"""


class Runs(unittest.TestCase):
    def run_sample(self, files, *arguments):
        with Sample(files) as sample:
            self.assertEqual(sample.build(), "")
            return sample.run(*arguments)

    def last_line(self, result):
        return result.stdout.splitlines()[-1].split(":")[-1].strip()

    def test_passing(self):
        result = self.run_sample({"test_x.pf": module("test_x", PASSING)})
        self.assertEqual(result.returncode, 0)
        self.assertEqual(self.last_line(result), "1 passed, 0 failed")

    def test_a_failing_assertion_fails_the_run(self):
        text = module("test_x", FAILING + PASSING)
        result = self.run_sample({"room/test_x.pf": text})
        self.assertEqual(result.returncode, 1)
        self.assertEqual(self.last_line(result), "1 passed, 1 failed")
        lines = [line.strip() for line in result.stdout.splitlines()]
        self.assertIn("FAILED room/test_x::fails", lines)
        self.assertIn("test/pf/room/test_x.pf:10: assertEqual: one is not two", lines)
        self.assertIn("expected:   1", lines)
        self.assertIn("actual:     2", lines)

    def test_order_before_after_and_disable(self):
        result = self.run_sample({"test_x.pf": module("test_x", FIXTURE.format(""))})
        self.assertEqual(result.returncode, 1)
        said = [line for line in result.stdout.splitlines() if "test_x" not in line]
        events = [line for line in said if not line.startswith((" ", "all "))]
        one = ["set up", "{} test", "tear down"]
        expected = [line.format(n) for n in ("first", "second") for line in one]
        self.assertEqual(events, expected)
        self.assertEqual(self.last_line(result), "1 passed, 1 failed, 1 skipped")

    def test_a_failure_before_the_test_keeps_it_from_running(self):
        broken = FIXTURE.format("        call throw('no set-up')\n")
        result = self.run_sample({"test_x.pf": module("test_x", broken)})
        self.assertEqual(result.returncode, 1)
        self.assertNotIn("first test", result.stdout)
        self.assertNotIn("tear down", result.stdout)
        self.assertEqual(self.last_line(result), "0 passed, 2 failed, 1 skipped")

    def test_no_test_at_all_fails(self):
        result = self.run_sample({})
        self.assertEqual(result.returncode, 1)
        self.assertIn("no test ran", result.stdout)

    def test_processes_share_the_modules(self):
        """Each module is run by the process that claims it, once; who comes too late is no
        failure, and a module that is filtered out stays so."""
        files = {f"room/test_{name}.pf": module(f"test_{name}", PASSING) for name in "abc"}
        with Sample(files) as sample, tempfile.TemporaryDirectory() as claims:
            self.assertEqual(sample.build(), "")
            (pathlib.Path(claims) / "room_test_b").touch()
            first = sample.run("", "room/test_c", claims)
            second = sample.run("", "", claims)
        self.assertEqual((first.returncode, second.returncode), (0, 0))
        self.assertEqual(self.last_line(first), "1 passed, 0 failed")
        self.assertIn("room/test_a", first.stdout)
        self.assertEqual(self.last_line(second), "0 passed, 0 failed")

    def test_only_disabled_tests_fail(self):
        text = module("test_x", PASSING.replace("@test\n", "@test\n    @disable\n"))
        result = self.run_sample({"test_x.pf": text})
        self.assertEqual(result.returncode, 1)
        self.assertIn("0 passed, 0 failed, 1 skipped", result.stdout)

    def test_a_failure_in_a_helper_is_not_lost(self):
        body = test("calls_a_helper", "call helper()", "call helper()") + (
            "    subroutine helper()\n"
            "        @assertTrue(.false.)\n"
            "    end subroutine helper\n"
        )
        result = self.run_sample({"test_x.pf": module("test_x", body)})
        self.assertEqual(result.returncode, 1)
        self.assertEqual(result.stdout.count("test/pf/test_x.pf:13: assertTrue"), 2)
        self.assertEqual(self.last_line(result), "0 passed, 1 failed")

    def test_a_trapped_operation_fails_the_run(self):
        body = test(
            "divides", "real(real64) :: zero", "zero = 0.0_real64", "@assertIsFinite(1.0/zero)"
        )
        result = self.run_sample({"test_x.pf": module("test_x", body)})
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("test/pf/test_x.pf:11", result.stderr)


class Filters(unittest.TestCase):
    FILES = {
        "one/test_a.pf": module("test_a", PASSING + FAILING),
        "two/test_b.pf": module("test_b", PASSING + test("is_alone", "@assertTrue(.true.)")),
    }

    @classmethod
    def setUpClass(cls):
        cls.sample = Sample(cls.FILES).__enter__()
        cls.addClassCleanup(cls.sample.__exit__)
        problem = cls.sample.build()
        if problem:
            raise RuntimeError(problem)

    def check(self, wanted, code, counts):
        result = self.sample.run(wanted)
        self.assertEqual(result.returncode, code, result.stdout)
        self.assertIn(f"together:                       {counts}", result.stdout)

    def test_by_room_module_and_test(self):
        self.check("", 1, "3 passed, 1 failed")
        self.check("two/", 0, "2 passed, 0 failed")
        self.check("test_b", 0, "2 passed, 0 failed")
        self.check("::passes", 0, "2 passed, 0 failed")
        self.check("test_b::is_alone", 0, "1 passed, 0 failed")
        self.check("one/test_a::fails", 1, "0 passed, 1 failed")

    def test_an_unknown_name_fails(self):
        self.check("test_c", 1, "0 passed, 0 failed")
