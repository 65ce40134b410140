"""Stresses of the rail below a contact: --below, --subsurface."""

import itertools
import math

from cli_program import BATCH_COLUMNS, ProgramTest, gap_case, gap_text, numbers

A = 1.0 / 600.0
COMPONENTS = ("sxx_MPa", "syy_MPa", "szz_MPa", "sxy_MPa", "sxz_MPa", "syz_MPa")
STEEL = "E_wheel_MPa = 2.1e5, E_rail_MPa = 2.1e5, nu_wheel = 0.3, nu_rail = 0.3, mu = 0.3"


class Below(ProgramTest):
    def setUp(self):
        super().setUp()
        # A ball on a plane: circles.
        self.write("gap.csv", gap_text(lambda y: A * y * y, n=301, inv2r=A))
        self.write("case.nml", gap_case(motion="cksi = 0.02").replace("mu = 0.3", STEEL))

    def stresses(self, *words):
        row, = self.good("contact", "case.nml", "--below", "below.csv", *words)
        head = (self.folder / "below.csv").read_text(encoding="utf-8").splitlines()
        self.assertTrue(head[0].startswith("# faststrip "))
        return row, self.read("below.csv")

    def test_hertz_below_a_ball(self):
        """On the axis szz = -p0/(1 + z^2/a^2); von Mises .6200 p0 at .481 a."""
        row, points = self.stresses("--normal", "hertz", "--tangential", "none", "--below-x", "0",
                                    "--below-y", "0", "--below-z", "1:12:0.5,20",
                                    "--points-per-strip", "60", "--strips-per-patch", "31")
        p0, a = float(row["pmax_MPa"]), float(row["xmax_mm"])
        self.assertEqual(numbers(points, "z_mm"), [0.5 * k for k in range(2, 25)] + [20.0])
        for point in points:
            z = float(point["z_mm"]) / a
            self.assert_close(float(point["szz_MPa"]), -p0 / (1 + z * z), 2e-3)
            radial = -1.3 * (1 - z * math.atan(1 / z)) + 0.5 / (1 + z * z)
            for name in COMPONENTS[:2]:
                self.assert_close(float(point[name]), p0 * radial, 2e-3, 5e-3 * p0)
            self.assert_close(float(point["von_mises_MPa"]), float(point["tresca_MPa"]), 0.02)
        self.assert_close(float(row["von_mises_max_MPa"]), 0.6200 * p0, 1.5e-3)
        self.assert_close(float(row["von_mises_z_mm"]), 0.481 * a, 0.01)
        self.assertLess(float(row["est_err_von_mises"]), 0.01)

    def test_all_methods_carry_the_load(self):
        """Below all of the patch szz carries N, sxz Fx but for what a point force has further
        away."""
        near = 1.5**2 * sum(1.5 * x * x * 4.0 / math.pi / (x * x + y * y + 16.0)**2.5
                            for x, y in itertools.product([1.5 * k for k in range(-40, 41)],
                                                          repeat=2))
        for normal, tangential in (("strip", "faststrip"), ("hertz", "fastsim"),
                                   ("norm", "tang"), ("norm", "none"), ("strip", "none")):
            with self.subTest(normal + " " + tangential):
                row, points = self.stresses(
                    "--normal", normal, "--tangential", tangential, "--element-dx", "0.6",
                    "--element-dy", "0.6", "--fastsim-nx", "12", "--fastsim-ny", "12",
                    "--below-x=-60:60:1.5", "--below-y=-60:60:1.5", "--below-z", "4")
                load = -1.5**2 * sum(numbers(points, "szz_MPa"))
                self.assert_close(load, float(row["N_N"]), 4e-3)
                along = -1.5**2 * sum(numbers(points, "sxz_MPa"))
                if tangential == "none":
                    self.assertLess(abs(along), 1e-6 * load)
                else:
                    self.assert_close(along, near * float(row["Fx_N"]), 0.01)
                self.assertGreater(float(row["von_mises_max_MPa"]),
                                   0.57 * float(row["pmax_MPa"]))

    def test_a_grid_of_its_own_and_the_sum(self):
        """By FFT on the program's grid, by the sum at the same points."""
        options = ("--normal", "norm", "--tangential", "tang", "--element-dx", "0.8",
                   "--element-dy", "0.8")
        _, points = self.stresses(*options)
        self.assertEqual(list(points[0])[:9], ["x_mm", "y_mm", "z_mm", *COMPONENTS])
        depths = sorted({float(point["z_mm"]) for point in points})
        self.assertGreater(len(depths), 10)
        self.assert_close(depths[0], 0.5 * (depths[1] - depths[0]), 1e-9)
        most = max(points, key=lambda point: float(point["von_mises_MPa"]))
        _, alone = self.stresses(*options, *(f"--below-{axis}={most[axis + '_mm']}"
                                             for axis in "xyz"))
        for name in COMPONENTS:
            self.assertAlmostEqual(float(alone[0][name]), float(most[name]), delta=1e-9)
        s1, s2, s3 = (float(most[name]) for name in ("s1_MPa", "s2_MPa", "s3_MPa"))
        self.assertTrue(s1 >= s2 >= s3)
        self.assert_close(s1 + s2 + s3, sum(float(most[name]) for name in COMPONENTS[:3]), 1e-12)
        self.assert_close(s1 - s3, float(most["tresca_MPa"]), 1e-12)

    def test_batches_and_what_was_not_asked_for(self):
        self.write("b.csv", f"{BATCH_COLUMNS}\nball,gap.csv,2.1e5,0.3,0.3,1e5,0.01,0,0\n")
        for name in ("faststrip", "none", "polach"):
            self.run_program("batch", "b.csv", "-o", "r.csv", "--subsurface", "--tangential", name)
            row, = self.read("r.csv")
            self.assertEqual(row["status"], "bad_argument" if name == "polach" else "ok")
            if name != "polach":
                self.assert_close(float(row["von_mises_max_MPa"]), 0.64 * float(row["pmax_MPa"]),
                                  0.04)
        bare = self.good("contact", "case.nml")[0]
        self.assertEqual(bare["von_mises_max_MPa"], "")
        self.write("case.nml", gap_case(extra="&numerics\n  subsurface = .true.\n/\n"))
        self.assertGreater(float(self.good("contact", "case.nml")[0]["von_mises_max_MPa"]), 0.0)

    def test_bad_input(self):
        for words, said in (
                (("--below-x", "0"), "--below-x needs --below"),
                (("--below", "b.csv", "--below-x", "0:1"), "--below-x must be numbers in mm, as "
                 "0:9:0.1 (from, to, step) or 0,1,2.5, got '0:1'"),
                (("--below", "b.csv", "--below-y", "1:0:1"), "got '1:0:1'"),
                (("--below", "b.csv", "--below-y", "0:1:0"), "got '0:1:0'"),
                (("--below", "b.csv", "--below-z", "1,nan"), "got '1,nan'"),
                (("--below", "b.csv", "--below-z", "1,,2"), "got '1,,2'"),
                (("--below", "b.csv", "--below-z=-1"), "--below-z must be depths from 0 on"),
                (("--below", "b.csv", "--below-x", "0:9:0.001", "--below-y", "0:9:0.001"),
                 "--below takes at most 10000000 points")):
            with self.subTest(words):
                done = self.run_program("contact", "case.nml", *words)
                self.assertEqual(done.returncode, 2)
                self.assertIn(said, done.stderr)
        done = self.run_program("contact", "case.nml", "--below", "b.csv", "--tangential", "she")
        self.assertEqual(done.returncode, 1)
        self.assertIn("she gives forces only", done.stderr)
        self.assertFalse((self.folder / "b.csv").exists())
