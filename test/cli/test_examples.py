"""The cases of example/cases: each solves, and is what its first lines say it is."""

import math
import subprocess
import sys

from cli_program import ROOT, LabTest, ProgramTest

CASES = ROOT / "example" / "cases"
MADE = ["worn_wheel.txt", "worn_wheel.whl", "worn_rail.ban", "near_conformal.csv",
        "polymer_roller.csv", "twin_disc.txt"]


class Examples(ProgramTest):
    def example(self, name, *words):
        # Of its dissimilar materials all other methods say that they leave something out.
        if name == "polymer_roller":
            words += ("--normal", "norm", "--tangential", "tang")
        row = self.good("contact", str(CASES / f"{name}.nml"), *words)[0]
        return {key: float(row[key]) for key in row if key not in (
            "case", "normal", "tangential", "status") and row[key] != ""} | {
                "status": row["status"]}

    def test_every_example_solves(self):
        names = sorted(path.stem for path in CASES.glob("*.nml"))
        self.assertGreaterEqual(len(names), 10)
        for name in names:
            result = self.example(name)
            force = math.hypot(result["Fx_N"], result["Fy_N"])
            self.assertLessEqual(force, 0.36 * result["N_N"], name)
            self.assertGreater(result["area_mm2"], 30.0, name)

    def test_what_they_require(self):
        def width(r):
            return r["ymax_mm"] - r["ymin_mm"]

        flange = self.example("curve_flange_root")
        self.assertLess(flange["stick_fraction"], 0.01)
        self.assertGreater(abs(flange["gamma_rad"]), 0.4)
        self.assertEqual(self.example("two_point_contact")["n_patches"], 2)
        pull = self.example("locomotive_traction")
        self.assertGreater(math.hypot(pull["Fx_N"], pull["Fy_N"]), 0.995 * 0.35 * pull["N_N"])
        straight = self.example("tread_straight")
        self.assertGreater(straight["ymax_mm"], -4.0 * straight["ymin_mm"])
        conformal = self.example("near_conformal")
        self.assertGreater(width(conformal), 7.0 * conformal["xmax_mm"])
        roller = self.example("polymer_roller")
        self.assertGreater(roller["penetration_mm"], 0.1)
        # Symmetric; TANG's residual is 1e-7 of its tractions, and the friction is 0.2.
        self.assertLess(abs(roller["Fy_N"]), 1e-9 * 0.2 * roller["N_N"])
        # Two equal crowned discs: by Hertz a circle under a mean pressure of 2/3 of pmax.
        discs = self.example("twin_disc")
        self.assertAlmostEqual(discs["xmax_mm"] * 2, width(discs), delta=0.05)
        self.assertAlmostEqual(discs["pmax_MPa"] * discs["area_mm2"], 1.5 * discs["N_N"],
                               delta=0.01 * discs["N_N"])
        for name in ("freight_25t", "tram_small_wheel"):
            self.assertGreater(self.example(name)["stick_fraction"], 0.6, name)

    def test_made_files_are_those_of_the_tool(self):
        self.example("tread_straight", "--shift", "0", "--profiles", str(self.folder / "p.csv"))
        subprocess.run([sys.executable, ROOT / "tools/generate/example_files.py", "p.csv", "."],
                       cwd=self.folder, check=True)
        for name in MADE:
            self.assertEqual((self.folder / name).read_text(encoding="utf-8"),
                             (CASES / name).read_text(encoding="utf-8"), name)


class BenchExamples(LabTest):
    def test_one_solver_serves_all_methods(self):
        done = self.run_program("bench", "examples", "--examples", CASES, "-o", "out.csv")
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        rows = self.read("out.csv")
        names = sorted(path.stem for path in CASES.glob("*.nml"))
        self.assertEqual(len(rows), 5 * len(names))
        for name in names:
            strips, = (row for row in rows if row["example"] == name
                       and row["method"] == "strips 15 + FASTSTRIP")
            subprocess.run([ROOT / "bin" / "faststrip", "contact", CASES / f"{name}.nml",
                            "--strips-per-patch", "15", "-o", "alone.csv"],
                           cwd=self.folder, check=True)
            alone, = self.read("alone.csv")
            for column in ("penetration_mm", "pmax_MPa", "area_mm2", "Fx_N", "Fy_N", "status"):
                self.assertEqual(strips[column], alone[column], (name, column))
