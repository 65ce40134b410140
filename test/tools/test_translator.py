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

    def refused_line(self, line, words):
        text = module("test_x", test("one", "@assertTrue(.true.)", line))
        self.refused(text, "test_x.pf:10", words)

    def test_unknown_directives(self):
        for line in ("@assertNotEqual(1, 2)", "@mpiTest", "@asserttrue(.true.)", "@", "@ test"):
            with self.subTest(line):
                self.refused_line(line, "unknown directive")
        for line in ("@testCase", "@testParameter(constructor=x)", "@suite(name='s')"):
            with self.subTest(line):
                self.refused_line(line, "unknown directive")

    def test_directives_with_options(self):
        self.refused_line("@test(npes=[1])", "takes nothing after it")
        self.refused_line("@before ! each", "takes nothing after it")

    def test_assertions_that_are_not_whole(self):
        for line in (
            "@assertTrue(.true.) ! why",
            "@assertTrue(.true.); return",
            "@assertEqual(1, &",
            "@assertEqual(1, (2)",
            "@assertEqual(1, [2)",
            "@assertEqual('a, 'b')",
            "@assertEqual(1, , 2)",
            "@assertTrue",
            "@assertTrue(a) .and. (b)",
        ):
            with self.subTest(line):
                self.refused_line(line, "is not one whole call on one line")

    def test_too_few_arguments(self):
        self.refused_line("@assertEqual(1)", "needs at least 2 arguments")
        self.refused_line("@assertTrue()", "needs at least 1 arguments")
        self.refused_line("@assertRelativelyEqual(1.0, 2.0)", "needs at least 3 arguments")

    def test_a_location_of_ones_own(self):
        self.refused_line("@assertTrue(.true., location=here)", "location")

    def test_a_line_that_would_not_fit(self):
        self.refused_line(f"@assertTrue({'.not. ' * 20}.true.)", "columns")

    def test_an_assertion_before_the_subroutine(self):
        text = module("test_x", "    @test\n    @assertTrue(.true.)\n")
        self.refused(text, "test_x.pf:8", "where a subroutine has to follow")

    def test_a_test_without_subroutine(self):
        text = module("test_x", "    @test\n    integer function f()\n    end function f\n")
        self.refused(text, "test_x.pf:8", "a subroutine without arguments")
        self.refused("module test_x\n@test\n", "test_x.pf:2", "no subroutine follows")

    def test_a_test_with_arguments(self):
        text = module("test_x", "    @test\n    subroutine t(this)\n    end subroutine t\n")
        self.refused(text, "test_x.pf:8", "a subroutine without arguments")

    def test_disable_in_the_wrong_place(self):
        self.refused_line("@disable", "has to follow @test")
        text = module("test_x", "    @disable\n    @test\n    subroutine t()\n")
        self.refused(text, "test_x.pf:7", "has to follow @test")
        text = module("test_x", "    @before\n    @disable\n    subroutine t()\n")
        self.refused(text, "test_x.pf:8", "has to follow @test")

    def test_two_of_a_kind(self):
        once = "    @before\n    subroutine {0}()\n    end subroutine {0}\n"
        twice = once.format("a") + once.format("b")
        self.refused(module("test_x", twice), "test_x.pf:10", "a second @before")
        self.refused(module("test_x", test("t") + test("T")), "test_x.pf:11", "a second test T")

    def test_a_file_without_tests(self):
        self.refused(module("test_x", ""), "test_x.pf:1", "there is no @test")

    def test_names_that_do_not_fit(self):
        self.refused(GOOD, "test_other.pf:1", "not named as its file", name="test_other.pf")
        self.refused(GOOD, "good.pf:1", "named test_<thing>.pf", name="good.pf")
        self.refused("subroutine t()\nend\n", "test_x.pf:1", "there is no module")

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
