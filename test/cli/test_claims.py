"""`faststrip-lab references` and `claims`: a few contacts that nothing was fitted to."""

import csv
import math

from cli_program import PROGRAM, ROOT, LabTest, numbers, rows_of

HERTZ = ROOT / "reference" / "contact" / "hertz_creep.csv"
METHODS = ROOT / "reference" / "claims" / "methods.csv"
KINDS = ["ellipse", "new_wheel", "worn_wheel", "several", "small_second", "flat_top", "conformal",
         "wavy", "kinks", "radius_wave", "step", "two_powers", "noisy", "three_places", "corner"]
FORCES = ("Fx", "Fy", "Mz")
FIGURES = ("penetration", "pmax", "area", *FORCES, "friction_power", "stick_fraction")
SOME = "stage,method,when,normal,tangential,strips_per_patch,points_per_strip,fastsim_nx," \
       "fastsim_ny,across,target,tolerance\n"


class Claims(LabTest):
    def reference(self, *words):
        done = self.share_program("references", "--across", 16, *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.left_out = [line.split(" is left out")[0].split(": ")[1]
                         for line in done.stderr.splitlines()]
        return done.stdout

    def judge(self, reference, methods, *words):
        self.write("references.csv", reference)
        self.write("methods.csv", SOME + methods)
        return self.good("claims", "--references", "references.csv", "--methods", "methods.csv",
                         *words)

    def test_contacts_hold_what_was_asked(self):
        rows = rows_of(self.reference("--each", 2))
        self.assertEqual(list(dict.fromkeys(row["kind"] for row in rows)), KINDS)
        solved = {(row["kind"], row["number"]) for row in rows}
        self.assertEqual(len(solved) + len(self.left_out), 2 * len(KINDS))
        for row in rows:
            about = row["kind"], row["number"], row["state"]
            load, mu, nu = (float(row[name]) for name in ("N_N", "mu", "nu"))
            self.assertTrue(1e4 <= load <= 1.5e5 and 0.1 <= mu <= 0.6, about)
            self.assertTrue(0.2 <= nu <= 0.35, about)
            fx, fy, mz = (float(row[name]) for name in ("Fx_N", "Fy_N", "Mz_Nmm"))
            self.assertLess(math.hypot(fx, fy), 1.01 * mu * load, about)
            power = -sum(force * float(row[name]) for force, name in zip(
                (fx, fy, mz), ("cksi", "ceta", "cphi_rad_per_mm"), strict=True))
            if row["kind"] != "ellipse":
                self.assert_close(float(row["friction_power_N"]), power, 1e-4, what=about)
                self.assertLess(float(row["doubt_Fx"]), 0.05, about)
            self.assertGreater(power, 0.0, about)
            self.assertTrue(0.0 <= float(row["stick_fraction"]) <= 1.0, about)
            for name, most in (("penetration", 0.05), ("pmax", 1.0), ("area", 0.3)):
                self.assertLess(float(row[f"doubt_{name}"]), most, about)
            self.assertGreater(float(row["width_mm"]) * float(row["length_mm"]),
                               float(row["area_mm2"]) / int(row["patches"]) / 4.0, about)
        states = [int(row["state"]) for row in rows if row["kind"] != "ellipse"]
        self.assertEqual(states, [1, 2] * (len(states) // 2))
        spins = [float(row["cphi_rad_per_mm"]) != 0.0 for row in rows]
        self.assertTrue(len(rows) // 2 < sum(spins) < len(rows))

    def test_a_contact_is_the_same_in_every_run(self):
        rows = rows_of(self.reference("--each", 2))
        own = rows_of(self.reference("--each", 1, "--kind", "radius_wave"))
        self.assertEqual(own, [row for row in rows if row["kind"] == "radius_wave"
                               and row["number"] == "1"])
        self.assertEqual(len(own), 2)

    def test_more_elements_come_nearer(self):
        fine, coarse = (rows_of(self.run_program(
            "references", "--each", 2, "--kind", "corner", "--across", across).stdout)
            for across in (72, 24))
        self.assertEqual(len(fine), 4)
        for name in ("penetration", *FORCES):
            self.assertLess(sum(numbers(fine, f"doubt_{name}")),
                            0.5 * sum(numbers(coarse, f"doubt_{name}")), name)
        for a, b in zip(fine, coarse, strict=True):
            bound = float(a["mu"]) * float(a["N_N"])
            c = math.sqrt(float(a["area_mm2"]) / math.pi)
            for name, unit, size in (("Fx", "N", bound), ("Fy", "N", bound),
                                     ("Mz", "Nmm", bound * c)):
                doubt = float(a[f"doubt_{name}"]) + float(b[f"doubt_{name}"])
                self.assert_close(float(a[f"{name}_{unit}"]), float(b[f"{name}_{unit}"]),
                                  absolute=2.0 * doubt * size, what=name)

    def test_ellipses_are_those_of_contact(self):
        rows = rows_of(self.reference("--each", 3, "--kind", "ellipse"))
        with open(HERTZ, encoding="utf-8") as stream:
            known = list(csv.DictReader(line for line in stream if not line.startswith("#")))
        self.assertEqual([row["number"] for row in rows], ["1", "6", "11"])
        for row in rows:
            other = known[int(row["number"]) - 1]
            for name, its in (("N_N", "N"), ("cksi", "cksi"), ("ceta", "ceta"),
                              ("Fx_N", "Fx_extrap"), ("Fy_N", "Fy_extrap"),
                              ("Mz_Nmm", "Mz_extrap")):
                self.assert_close(float(row[name]), float(other[its]), 1e-5, 1e-12, name)
            area = math.pi * float(other["a_mm"]) * float(other["b_mm"])
            self.assert_close(float(row["area_mm2"]), area, 1e-5)
            self.assert_close(float(row["pmax_MPa"]), 1.5 * 1e5 / area, 1e-5)
            for name in FORCES:
                self.assertLess(float(row[f"doubt_{name}"]), 0.02)

    def test_kalker_comes_near_the_reference(self):
        reference = self.reference("--each", 1)
        rows = self.judge(reference, "both,fine,always,norm,tang,,,,,16,,\n"
                                     "both,coarse,always,norm,tang,,,,,6,,\n"
                                     "both,strips,always,strip,faststrip,15,15,,,,,\n")
        self.assertEqual([row["method"] for row in rows],
                         [name for name in ("fine", "coarse", "strips")
                          for _ in rows_of(reference)])
        mean = {name: [sum(abs(float(row[f"err_{figure}"])) for row in rows
                           if row["method"] == name and row["err_Fx"])
                       for figure in ("penetration", *FORCES)]
                for name in ("fine", "coarse", "strips")}
        for fine, coarse in zip(mean["fine"], mean["coarse"], strict=True):
            self.assertLess(fine, 0.5 * coarse)
        for row in rows:
            self.assertGreater(float(row["normal_us"]), 0.0)
            self.assertGreater(float(row["tangential_us"]), 0.0)
            if row["method"] == "strips":
                self.assertGreater(float(row["est_pmax"]), 0.0)
                self.assertLess(abs(float(row["err_Fx"])), 0.1)

    def test_the_program_says_the_same_of_these_contacts(self):
        reference = self.reference("--each", 1)
        judged = self.judge(reference, "both,strips,always,strip,faststrip,11,9,,,,,\n"
                            "both,auto,always,auto,faststrip,,,,,,penetration,0.1\n", "--every", 3)
        (self.folder / "cases").mkdir()
        done = self.run_program("claims", "--references", "references.csv", "--every", 3, "--cases",
                                "cases")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        self.program = PROGRAM
        true = rows_of(reference)[::3]
        self.assertGreater(len(true), 8)
        self.assertEqual(len(judged), 2 * len(true))
        for method, words in (("strips", ("--strips-per-patch", 11, "--points-per-strip", 9)),
                              ("auto", ("--normal", "auto", "--target", "penetration",
                                        "--tolerance", "0.1"))):
            self.is_doubtful = True  # fill values among the heights
            solved = self.good("batch", "cases/cases.csv", *words)
            own = [row for row in judged if row["method"] == method]
            self.assertEqual([row["case"] for row in solved],
                             [f"{row['kind']}_{row['number']}_{row['state']}" for row in true])
            for row, said, other in zip(own, solved, true, strict=True):
                self.check_row(row, said, other)
        self.assertGreater(sum("strip" in row["choice"] for row in own), 3)

    def check_row(self, row, said, other):
        """What the judge found is what the program says, less the reference."""
        self.assertEqual(row["status"], said["status"])
        bound = float(other["mu"]) * float(other["N_N"])
        for name, column, unit in (("Fx", "Fx_N", bound), ("Fy", "Fy_N", bound),
                                   ("pmax", "pmax_MPa", float(other["pmax_MPa"]))):
            error = (float(said[column]) - float(other[column])) / unit
            self.assert_close(float(row[f"err_{name}"]), error, 1e-4, 1e-8, name)
        for name in ("pmax", "Fy"):
            self.assertEqual(row[f"est_{name}"] == "", said[f"est_err_{name}"] == "")
            if row[f"est_{name}"]:
                self.assert_close(float(row[f"est_{name}"]), float(said[f"est_err_{name}"]), 1e-5)

    def test_bad_input(self):
        for words, says in ((["--each", "0"], "0"), (["--across", "7"], "7"),
                            (["--kind", "round"], "round")):
            with self.subTest(words):
                self.refused(2, "references", *words, says=[says])
        self.refused(1, "claims", "--references", "none.csv", says=["none.csv"])
        self.refused(2, "claims", "--every", "0", says=["0"])
        reference = self.reference("--each", 1, "--kind", "step")
        self.write("methods.csv", SOME + "both,strips,always,strip,faststrip,,,,,,,\n")
        for old, new, says in (("\nstep", "\nsteep", "steep"), ("number,", "numbers,", "number"),
                               ("\nstep,1,1,1", "\nstep,1,1,one", "one")):
            with self.subTest(says):
                self.write("bad.csv", reference.replace(old, new, 1))
                self.refused(1, "claims", "--references", "bad.csv", "--methods", "methods.csv",
                             says=[says, "bad.csv"])
        self.write("references.csv", reference)
        for row, says in (("both,x,always,norm,tang,,,,,1,,", "across"),
                          ("both,x,always,nrm,tang,,,,,9,,", "nrm"),
                          ("bth,x,always,norm,tang,,,,,9,,", "bth"),
                          ("both,x,always,auto,tang,,,,,,pmx,0.1", "pmx"),
                          ("both,x,always,auto,tang,,,,,,pmax,0,1", "cells")):
            with self.subTest(row):
                self.write("methods.csv", f"{SOME}{row}\n")
                self.refused(1, "claims", "--references", "references.csv", "--methods",
                             "methods.csv", says=[says, "methods.csv"])
        self.write("methods.csv", SOME + "both,strips,always,strip,faststrip,,,,,,,\n")
        self.refused(1, "claims", "--references", "references.csv", "--methods", "methods.csv",
                     "--cases", "/dev/null", says=["/dev/null"])
