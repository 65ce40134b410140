"""What `contact --normal norm` says of its area, where the area is known."""

import math
import statistics

from cli_program import ProgramTest, gap_case

# Steel on steel, as the program has it by default
MODULUS = 209920.0 / (2.0 * (1.0 - 0.28 ** 2))


class NormArea(ProgramTest):
    def test_areas_of_round_contacts_are_bounded(self):
        curvature = 1.0 / 1000.0
        y = [0.05 * i - 30.0 for i in range(1201)]
        lines = "\n".join(f"{a!r},{curvature * (a - 0.07) ** 2!r},{curvature!r}" for a in y)
        self.write("gap.csv", "y_mm,h_mm,inv2R_per_mm\n" + lines + "\n")
        ratios = []
        for load in (1e4, 5e4, 1e5):
            self.write("case.nml", gap_case(load=repr(load)))
            radius = (3.0 * load / (8.0 * curvature * MODULUS)) ** (1.0 / 3.0)
            for across in (5.3, 6.1, 7.4, 9.0, 12.7, 17.2, 25.0, 38.0):
                row = self.solved("contact", "case.nml", "--normal", "norm", "--tangential",
                                  "none", "--element-dx", 2.0 * radius / across,
                                  "--element-dy", 2.1 * radius / across)
                error = abs(float(row["area_mm2"]) / (math.pi * radius ** 2) - 1.0)
                estimate = float(row["est_err_area"])
                self.assertLessEqual(error, estimate, (load, across))
                ratios.append(estimate / error)
        self.assertLess(statistics.median(ratios), 2.5)
