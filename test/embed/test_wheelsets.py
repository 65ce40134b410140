"""Wheelsets are the same in every face: every figure of every contact, bit for bit."""

import unittest

from installed import HOSTS, HostTest


class Faces(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.shell(f"gfortran -O1 '{HOSTS}/wheelset.f90' $(pkg-config --cflags --libs faststrip)"
                  " -o by_fortran")
        cls.lines = cls.shell("./by_fortran").splitlines()

    def rows(self, word):
        return [list(map(int, line.split()[1:])) for line in self.lines if line.startswith(word)]

    def test_what_is_compared(self):
        self.assertEqual(len(self.rows("solved")), 24)
        self.assertGreater(sum(status < 100 for status, _ in self.rows("solved")), 20)
        self.assertGreater(sum(n == 0 for _, n, _ in self.rows("wheel")), 1)
        sides = [row[0] for row in self.rows("contact")]
        self.assertGreater(min(sides.count(1), sides.count(2)), 12)
        self.assertGreater(len(set(self.lines)), 200)

    def test_c_has_the_bits_of_fortran(self):
        self.shell(f"gcc -O1 -Wall -Wextra -Werror '{HOSTS}/wheelset.c'"
                   " $(pkg-config --cflags --libs faststrip) -o by_c")
        self.assertEqual(self.shell("./by_c").splitlines(), self.lines)

    def test_fixed_form_fortran_has_them(self):
        self.shell(f"gfortran -std=legacy -Wall -O1 '{HOSTS}/wheelset.f'"
                   " $(pkg-config --libs faststrip) -o by_f77")
        self.assertEqual(self.shell("./by_f77").splitlines(), self.lines)


if __name__ == "__main__":
    unittest.main()
