"""The fixed-form wheelset of example/legacy: it hunts as Klingel says, with the Fortran API's bits."""

import math
import unittest

from installed import HOSTS, ROOT, HostTest

# Rolling radius and half the distance of the contacts, mm; cone.
R0, S, CONE = 460.0, 750.0, 0.05


class Wheelset(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.shell(f"gfortran -std=legacy -Wall -O2 '{ROOT}/example/legacy/wheelset.f'"
                  " $(pkg-config --libs faststrip) -o wheelset")
        cls.lines = cls.shell("./wheelset").splitlines()
        text = (cls.folder / "wheelset.txt").read_text(encoding="utf-8")
        cls.steps = {1: [], 2: []}
        for line in text.splitlines():
            method, *numbers = line.split()
            cls.steps[int(method)].append([float(number) for number in numbers])

    def test_every_step_is_there(self):
        self.assertEqual([len(self.steps[method]) for method in (1, 2)], [10000, 10000])
        for rows in self.steps.values():
            self.assertTrue(all(map(math.isfinite, sum(rows, []))))

    def test_the_wave_is_klingel_s(self):
        klingel = 2.0 * math.pi * math.sqrt(R0 * S / CONE)
        for line in self.lines:
            _, crossings, wave, formula, _, _ = (float(word) for word in line.split())
            self.assertEqual(crossings, 6)
            self.assertAlmostEqual(formula, klingel, delta=1e-2)
            # Creep at 20 m/s changes it by 0.03 %.
            self.assertAlmostEqual(wave, klingel, delta=2e-3 * klingel)

    def test_it_grows_slowly_as_without_suspension(self):
        for line in self.lines:
            first, last = (float(word) for word in line.split()[-2:])
            self.assertGreater(first, 3.0)
            self.assertLess(first, last)
            self.assertLess(last, 4.0)

    def test_strips_and_fastsim_agree(self):
        for ours, classic in zip(self.steps[1], self.steps[2]):
            self.assertAlmostEqual(ours[1], classic[1], delta=0.15)

    def test_forces_stay_below_friction(self):
        for rows in self.steps.values():
            for row in rows:
                self.assertLessEqual(math.hypot(row[6], row[7]), 0.3 * row[2] * (1.0 + 1e-12))

    def test_the_same_bits_by_the_fortran_api(self):
        self.shell(f"gfortran -O2 '{HOSTS}/replay.f90' $(pkg-config --cflags --libs faststrip)"
                   " -o replay")
        found = self.findings("./replay")
        self.assertEqual(found["rows"], [10000, 10000])
        self.assertEqual(found["different"], [0, 0])


if __name__ == "__main__":
    unittest.main()
