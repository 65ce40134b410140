"""What the assertions of test/funit/funit.f90 let pass and what they fail, with traps on."""

import unittest

from harness import Sample, module, test

# Shared by all tests below; unset reals of the test build are signalling NaN, too.
NUMBERS = """\
    real(real64), parameter :: one = 1.0_real64, big = huge(one), small = tiny(one)
    real(real64), parameter :: eps = epsilon(one)
"""
HELPERS = """\
    real(real64) function nan()
        nan = ieee_value(one, ieee_quiet_nan)
    end function nan

    subroutine make_signalling(x)
        real(real64), intent(out) :: x
        x = transfer(int(z'7ff0000000000001', int64), x)
    end subroutine make_signalling

    real(real64) function inf()
        inf = ieee_value(one, ieee_positive_inf)
    end function inf
"""

GOOD = [
    # integers
    "@assertEqual(3, 1 + 2)",
    "@assertEqual(3_int64, 3_int64)",
    "@assertEqual(3, 3_int64)",
    "@assertEqual([1, 2], [1, 2])",
    "@assertEqual(7, [7, 7, 7])",
    "@assertEqual(reshape([1, 2, 3, 4], [2, 2]), reshape([1, 2, 3, 4], [2, 2]))",
    "@assertEqual(1, reshape([1, 1], [1, 2]), 'a message')",
    "@assertEqual(1, [integer ::])",
    # strings: blanks around do not count
    "@assertEqual('word', '  word ')",
    "@assertEqual('', '   ')",
    "@assertEqual('a b', 'a b', message='a message')",
    # reals, absolute tolerance
    "@assertEqual(one, one)",
    "@assertEqual(0.0_real64, -0.0_real64)",
    "@assertEqual(one, one + 0.5_real64, tolerance=0.5_real64)",
    "@assertEqual(one, one - 0.5_real64, 0.5_real64, 'a message')",
    "@assertEqual(one, [one, one])",
    "@assertEqual(one, reshape([one, one + eps], [2, 1]), tolerance=eps)",
    "@assertEqual([one, 2*one], [one, 2*one], message='a message')",
    "@assertEqual(reshape([one, 2*one], [1, 2]), reshape([one, 2*one], [1, 2]))",
    "@assertEqual(inf(), inf())",
    "@assertEqual(-inf(), -inf(), tolerance=one)",
    "@assertEqual(big, 0.5_real64*big, tolerance=0.5_real64*big)",
    "@assertEqual(0.0_real64, 0.5_real64*small, tolerance=0.5_real64*small)",
    # reals, relative tolerance
    "@assertRelativelyEqual(4*one, 5*one, tolerance=0.25_real64)",
    "@assertRelativelyEqual(-4*one, -3*one, 0.25_real64)",
    "@assertRelativelyEqual(one, one + eps, eps)",
    "@assertRelativelyEqual([one, 1.0e9_real64], [one, 1.0e9_real64 + 1], 1.0e-9_real64)",
    "@assertRelativelyEqual(one, reshape([one, one], [1, 2]), 0.0_real64)",
    "@assertRelativelyEqual(big, 0.0_real64, one)",
    "@assertRelativelyEqual(inf(), inf(), 0.0_real64)",
    "@assertRelativelyEqual(one, 9*one, 8*one)",
    "@assertRelativelyEqual(0.5_real64*big, -0.25_real64*big, big)",
    # truth
    "@assertTrue(1 < 2)",
    "@assertTrue([.true., .true.])",
    "@assertFalse(2 < 1, 'a message')",
    "@assertFalse([.false., .false.])",
    # order
    "@assertGreaterThan(2, 1)",
    "@assertGreaterThan(2*one, one)",
    "@assertGreaterThan(inf(), big)",
    "@assertGreaterThanOrEqual(1, 1)",
    "@assertGreaterThanOrEqual(one, one)",
    "@assertLessThan(1, 2, message='a message')",
    "@assertLessThan(-big, big)",
    "@assertLessThanOrEqual(1, 1)",
    "@assertLessThanOrEqual(one, one, message='a message')",
    # kinds of numbers
    "@assertIsNaN(nan())",
    "@assertIsFinite(big)",
    "@assertIsFinite(0.5_real64*small)",
]

BAD = [
    # integers
    "@assertEqual(3, 4)",
    "@assertEqual(3, 4_int64)",
    "@assertEqual(3_int64, 4_int64)",
    "@assertEqual([1, 2], [1, 3])",
    "@assertEqual(7, [7, 7, 8])",
    "@assertEqual(reshape([1, 2], [1, 2]), reshape([1, 3], [1, 2]))",
    "@assertEqual([1, 2], [1, 2, 3])",
    "@assertEqual(reshape([1, 2], [1, 2]), reshape([1, 2], [2, 1]))",
    "@assertEqual([1], 1)",
    "@assertEqual(1, reshape([1], [1, 1, 1]))",
    # strings
    "@assertEqual('word', 'words')",
    "@assertEqual('word', 'Word')",
    "@assertEqual('a b', 'ab')",
    "@assertEqual('', 'x')",
    # reals, absolute tolerance
    "@assertEqual(one, one + eps)",
    "@assertEqual(one, one - 0.5_real64, tolerance=0.49_real64)",
    "@assertEqual(one, [one, one + eps])",
    "@assertEqual([one, one], [one, one + 2*eps], tolerance=eps)",
    "@assertEqual(one, reshape([one, 2*one], [1, 2]))",
    "@assertEqual([one], [one, one])",
    "@assertEqual(big, -big, tolerance=big)",
    "@assertEqual(one, one, tolerance=-eps)",
    "@assertEqual(one, one, tolerance=nan())",
    "@assertEqual(one, 2*one, tolerance=inf())",
    "@assertEqual(0.0_real64, 0.5_real64*small)",
    # NaN and infinity equal nothing else, not even with a tolerance
    "@assertEqual(nan(), nan())",
    "@assertEqual(nan(), nan(), tolerance=big)",
    "@assertEqual(one, nan(), tolerance=big)",
    "@assertEqual(nan(), one)",
    "@assertEqual(one, [one, nan()], tolerance=big)",
    "@assertEqual(inf(), -inf(), tolerance=big)",
    "@assertEqual(inf(), big, tolerance=big)",
    "@assertRelativelyEqual(nan(), nan(), big)",
    "@assertRelativelyEqual(one, nan(), big)",
    "@assertRelativelyEqual(one, inf(), big)",
    "@assertRelativelyEqual(inf(), one, big)",
    # reals, relative tolerance
    "@assertRelativelyEqual(4*one, 5*one, tolerance=0.24_real64)",
    "@assertRelativelyEqual(one, -one, one)",
    "@assertRelativelyEqual(one, one + 2*eps, eps)",
    "@assertRelativelyEqual([one, 1.0e9_real64], [one, 1.0e9_real64 + 2], 1.0e-9_real64)",
    "@assertRelativelyEqual(0.0_real64, 0.0_real64, one)",
    "@assertRelativelyEqual([one, 0.0_real64], [one, 0.0_real64], one)",
    "@assertRelativelyEqual(small, big, one)",
    "@assertRelativelyEqual(-big, big, one)",
    "@assertRelativelyEqual(one, one, -eps)",
    # truth
    "@assertTrue(2 < 1)",
    "@assertTrue([.true., .false.])",
    "@assertFalse(1 < 2)",
    "@assertFalse([.true., .false.])",
    # order; NaN has none
    "@assertGreaterThan(1, 1)",
    "@assertGreaterThan(one, one)",
    "@assertGreaterThan(nan(), one)",
    "@assertGreaterThanOrEqual(1, 2)",
    "@assertGreaterThanOrEqual(one, one + eps)",
    "@assertGreaterThanOrEqual(one, nan())",
    "@assertLessThan(1, 1)",
    "@assertLessThan(one, one)",
    "@assertLessThan(one, nan())",
    "@assertLessThanOrEqual(2, 1)",
    "@assertLessThanOrEqual(one + eps, one)",
    "@assertLessThanOrEqual(nan(), nan())",
    # kinds of numbers
    "@assertIsNaN(one)",
    "@assertIsNaN(inf())",
    "@assertIsFinite(nan())",
    "@assertIsFinite(-inf())",
    # exceptions
    "@assertExceptionRaised()",
    "@assertExceptionRaised('words')",
]

# Name -> lines of a test that passes.
EXCEPTIONS = {
    "thrown_and_caught": ["call throw('words')", "@assertExceptionRaised('words')"],
    "any_thrown": ["call throw('words')", "@assertExceptionRaised()"],
    "caught_by_hand": [
        "call throw('words')",
        "@assertExceptionRaised('words')",
        "call throw('other words')",
        "if (catch('words')) call throw('caught what was not there')",
        "if (.not. catch('other words', preserve=.true.)) call throw('not kept')",
        "if (.not. catch()) call throw('lost')",
        "if (anyExceptions()) call throw('still there')",
    ],
    "location_by_hand": [
        "call assertEqual(1, 2, location=SourceLocation('here', 5))",
        "if (getNumExceptions() /= 1) call throw('not one')",
        "if (index(exception_text(1), 'here:5: assertEqual') /= 1) call throw('no place')",
        "call clearAll()",
    ],
}

# Name -> the last line of a test that fails; x is a signalling NaN.
SIGNALLING = {
    "equal_to_signalling_nan": "@assertEqual(one, x, tolerance=one)",
    "expected_signalling_nan": "@assertRelativelyEqual(x, one, one)",
    "order_of_signalling_nan": "@assertLessThan(x, one)",
    "signalling_nan_is_not_finite": "@assertIsFinite(x)",
}


class Assertions(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        body = "".join(test(f"good_{i}", line) for i, line in enumerate(GOOD))
        body += "".join(test(f"bad_{i}", line) for i, line in enumerate(BAD))
        body += "".join(test(f"good_{name}", *lines) for name, lines in EXCEPTIONS.items())
        for name, line in SIGNALLING.items():
            body += test(f"bad_{name}", "real(real64) :: x", "call make_signalling(x)", line)
        cls.sample = Sample({"test_x.pf": module("test_x", body + HELPERS, NUMBERS)}).__enter__()
        cls.addClassCleanup(cls.sample.__exit__)
        problem = cls.sample.build()
        if problem:
            raise RuntimeError(problem)
        cls.result = cls.sample.run()
        cls.failed = {
            line.split("::")[1]
            for line in cls.result.stdout.splitlines()
            if line.startswith("FAILED")
        }

    def test_what_passes(self):
        for i, line in enumerate(GOOD):
            with self.subTest(line):
                self.assertNotIn(f"good_{i}", self.failed)

    def test_what_fails(self):
        for i, line in enumerate(BAD):
            with self.subTest(line):
                self.assertIn(f"bad_{i}", self.failed)

    def test_exceptions(self):
        for name in EXCEPTIONS:
            with self.subTest(name):
                self.assertNotIn(f"good_{name}", self.failed)

    def test_signalling_nan_fails_without_a_trap(self):
        for name in SIGNALLING:
            with self.subTest(name):
                self.assertIn(f"bad_{name}", self.failed)

    def test_every_test_was_counted(self):
        n_good = len(GOOD) + len(EXCEPTIONS)
        n_bad = len(BAD) + len(SIGNALLING)
        last = self.result.stdout.splitlines()[-1]
        self.assertTrue(last.endswith(f" {n_good} passed, {n_bad} failed"), last)
        self.assertEqual(self.result.returncode, 1)


class Words(unittest.TestCase):
    """What a failure says."""

    @classmethod
    def setUpClass(cls):
        body = test("relative", "@assertRelativelyEqual(4*one, 5*one, 0.1_real64, 'force')")
        body += test(
            "matrix",
            "@assertEqual(reshape([1, 2, 3, 4], [2, 2]), reshape([1, 9, 9, 4], [2, 2]))",
        )
        body += test("shapes", "@assertEqual([1, 2], [1, 2, 3])")
        body += test("not_a_number", "@assertEqual(one, nan())")
        body += test("order", "@assertLessThan(2, 1)")
        cls.sample = Sample({"test_x.pf": module("test_x", body + HELPERS, NUMBERS)}).__enter__()
        cls.addClassCleanup(cls.sample.__exit__)
        problem = cls.sample.build()
        if problem:
            raise RuntimeError(problem)

    def said(self, name):
        lines = self.sample.run(f"::{name}").stdout.splitlines()
        return [line.strip() for line in lines[1:-2]]

    def test_a_relative_difference(self):
        self.assertEqual(
            self.said("relative"),
            [
                "test/pf/test_x.pf:11: assertRelativelyEqual: force",
                "expected:   4.0000000000000000E+000",
                "actual:     5.0000000000000000E+000",
                "relative:   2.5000000000000000E-001 (tolerance 1.0000000000000001E-001)",
            ],
        )

    def test_the_place_in_an_array(self):
        self.assertIn("at element: (2, 1), the first of 2 that differ (of 4)", self.said("matrix"))

    def test_shapes(self):
        self.assertIn("expected shape: (2)", self.said("shapes"))
        self.assertIn("actual shape:   (3)", self.said("shapes"))

    def test_numbers_that_are_none(self):
        self.assertIn("actual:     NaN", self.said("not_a_number"))

    def test_an_order(self):
        self.assertIn("expected:   2 < 1", self.said("order"))
