"""What tools/building/pf2f90.py accepts, refuses and writes."""

import unittest

from harness import Sample, module, test

GOOD = module("test_good", test("works", "@assertTrue(.true.)"))


class Refusals(unittest.TestCase):
    """Nothing that starts with @ is dropped in silence: it is refused with file and line."""

    def refused(self, text, place, words, name="test_x.pf"):
        with Sample({name: text}) as sample:
            result = sample.translate()
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertIn(f"test/pf/{place}: ", result.stderr)
            self.assertIn(words, result.stderr)
            self.assertEqual(list(sample.generated.iterdir()), [])

    def test_lines_of_a_test(self):
        not_whole = "is not one whole call on one line"
        for line, says in (
            *((line, "unknown directive") for line in (
                "@assertNotEqual(1, 2)", "@mpiTest", "@asserttrue(.true.)", "@", "@ test",
                "@testCase", "@testParameter(constructor=x)", "@suite(name='s')")),
            ("@test(npes=[1])", "takes nothing after it"),
            ("@before ! each", "takes nothing after it"),
            *((line, not_whole) for line in (
                "@assertTrue(.true.) ! why", "@assertTrue(.true.); return", "@assertEqual(1, &",
                "@assertEqual(1, (2)", "@assertEqual(1, [2)", "@assertEqual('a, 'b')",
                "@assertEqual(1, , 2)", "@assertTrue", "@assertTrue(a) .and. (b)")),
            ("@assertEqual(1)", "needs at least 2 arguments"),
            ("@assertTrue()", "needs at least 1 arguments"),
            ("@assertRelativelyEqual(1.0, 2.0)", "needs at least 3 arguments"),
            ("@assertTrue(.true., location=here)", "location"),
            (f"@assertTrue({'.not. ' * 20}.true.)", "columns"),
            ("@disable", "has to follow @test"),
        ):
            with self.subTest(line):
                text = module("test_x", test("one", "@assertTrue(.true.)", line))
                self.refused(text, "test_x.pf:10", says)

    def test_what_is_between_tests(self):
        once = "    @before\n    subroutine {0}()\n    end subroutine {0}\n"
        no_subroutine = "a subroutine without arguments"
        for body, line, says in (
            ("    @test\n    @assertTrue(.true.)\n", 8, "where a subroutine has to follow"),
            ("    @test\n    integer function f()\n    end function f\n", 8, no_subroutine),
            ("    @test\n    subroutine t(this)\n    end subroutine t\n", 8, no_subroutine),
            ("    @disable\n    @test\n    subroutine t()\n", 7, "has to follow @test"),
            ("    @before\n    @disable\n    subroutine t()\n", 8, "has to follow @test"),
            (once.format("a") + once.format("b"), 10, "a second @before"),
            (test("t") + test("T"), 11, "a second test T"),
            ("", 1, "there is no @test"),
        ):
            with self.subTest(says, body=body):
                self.refused(module("test_x", body), f"test_x.pf:{line}", says)

    def test_names_that_do_not_fit(self):
        self.refused(GOOD, "test_other.pf:1", "not named as its file", name="test_other.pf")
        self.refused(GOOD, "good.pf:1", "named test_<thing>.pf", name="good.pf")
        self.refused("subroutine t()\nend\n", "test_x.pf:1", "there is no module")
        self.refused("module test_x\n@test\n", "test_x.pf:2", "no subroutine follows")

    def test_modules_of_the_same_name(self):
        with Sample({"a/test_good.pf": GOOD, "b/test_good.pf": GOOD}) as sample:
            result = sample.translate()
            self.assertEqual(result.returncode, 1)
            self.assertIn("test/pf/b/test_good.pf:1: ", result.stderr)


class Files(unittest.TestCase):
    """What is written, kept and removed."""

    def test_names_and_rooms(self):
        with Sample({"room/test_good.pf": GOOD}) as sample:
            self.assertEqual(sample.translate().returncode, 0)
            names = sorted(path.name for path in sample.generated.iterdir())
            self.assertEqual(names, ["generated_room_test_good.f90", "generated_runner.f90"])

    def test_what_tests_share_is_compiled_with_them(self):
        shared = "module shared\n    integer, parameter :: one = 1\nend module\n"
        text = module("test_x", test("it", "use shared, only: one", "@assertEqual(1, one)"))
        with Sample({"room/test_x.pf": text, "support/shared.f90": shared}) as sample:
            self.assertEqual(sample.build(), "")
            self.assertEqual(sample.run().returncode, 0)

    def test_an_unchanged_file_is_not_written_again(self):
        other = module("test_other", test("works", "@assertTrue(.true.)"))
        with Sample({"test_good.pf": GOOD, "test_other.pf": other}) as sample:
            sample.translate()
            good = sample.generated / "generated_test_good.f90"
            changing = sample.generated / "generated_test_other.f90"
            before = good.stat().st_mtime_ns, changing.stat().st_mtime_ns
            sample.write("test_other.pf", other.replace(".true.", ".false."))
            sample.translate()
            after = good.stat().st_mtime_ns, changing.stat().st_mtime_ns
            self.assertEqual(before[0], after[0])
            self.assertNotEqual(before[1], after[1])

    def test_stale_files_are_removed(self):
        with Sample({"test_good.pf": GOOD}) as sample:
            stale = sample.generated / "generated_test_gone.f90"
            stale.write_text("program gone\nend program\n", encoding="utf-8")
            kept = sample.generated / "helper.f90"
            kept.write_text("module helper\nend module\n", encoding="utf-8")
            sample.translate()
            self.assertFalse(stale.exists())
            self.assertTrue(kept.exists())

    def test_compiler_errors_name_the_line_of_the_source(self):
        text = module("test_x", test("one", "@assertTrue(.true.)", "call undeclared(", ""))
        with Sample({"room/test_x.pf": text}) as sample:
            self.assertIn("test/pf/room/test_x.pf:10:", sample.build())
        text = module("test_x", test("one", "@assertTrue(undeclared)"))
        with Sample({"test_x.pf": text}) as sample:
            self.assertIn("test/pf/test_x.pf:9:", sample.build())
