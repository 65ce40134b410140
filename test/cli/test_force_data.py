"""`faststrip-lab force-data` and `force-features`, a few contacts of `./run force-data`."""

import math
import subprocess
import sys

from cli_program import ROOT, LabTest, numbers, rows_of

# The families in the order of 17 contacts in a row.
FAMILIES = ["ellipse"] * 5 + ["quartic", "unequal", "wedge", "waisted", "tanh", "exp", "worn",
                              "hollow", "power", "flat", "double", "wheel"]
STATES = ("cksi", "ceta", "cphi_rad_per_mm", "Fx_N", "Fy_N", "Mz_Nmm", "friction_power_N",
          "stick_fraction", "Fx_coarse_N", "Fy_coarse_N", "Mz_coarse_Nmm", "steps", "residual")


def listed(row, name):
    return [float(word) for word in row[name].split()]


class ForceData(LabTest):
    def data(self, *words):
        done = self.run_program("force-data", "--across", 16, *words)
        self.assertEqual((done.returncode, done.stderr), (0, ""), words)
        return done.stdout

    def test_contacts_hold_what_was_asked(self):
        rows = rows_of(self.data("--cases", 34))
        self.assertEqual([row["family"] for row in rows], 2 * FAMILIES)
        good = [row for row in rows if row["status"] == "ok"]
        self.assertGreater(len(good), 28)
        for row in rows:
            states = len(listed(row, "cksi"))
            self.assertEqual({len(listed(row, name)) for name in STATES}, {states})
            self.assertEqual(states == 6, row in good, row["number"])
        for row in good:
            bound = float(row["mu"]) * float(row["load_N"])
            for fx, fy, power, *motion in zip(*(listed(row, name) for name in (
                    "Fx_N", "Fy_N", "friction_power_N", "Mz_Nmm", *STATES[:3])), strict=True):
                self.assertLessEqual(math.hypot(fx, fy), 1.0001 * bound)
                mz, cksi, ceta, cphi = motion
                fed = -(fx * cksi + fy * ceta + mz * cphi)
                # Where next to nothing slides, the heat is in few of 16 elements.
                self.assertGreaterEqual(power, 0.0, row["number"])
                if math.hypot(fx, fy) > 0.5 * bound:
                    self.assertLess(abs(power / fed - 1.0), 0.2, row["number"])

    def test_a_contact_is_the_same_wherever_the_run_starts(self):
        whole = rows_of(self.data("--cases", 8))
        self.assertEqual(whole, rows_of(self.data("--cases", 8)))
        self.assertEqual(whole[5:], rows_of(self.data("--first", 6, "--cases", 3)))
        other = rows_of(self.data("--cases", 2, "--seed", 2))
        self.assertNotEqual(whole[0]["load_N"], other[0]["load_N"])

    def test_creepages_do_not_depend_on_the_grid(self):
        coarse = rows_of(self.data("--first", 7, "--cases", 2))
        fine = rows_of(self.run_program("force-data", "--first", 7, "--cases", 2).stdout)
        for a, b in zip(coarse, fine, strict=True):
            self.assertGreater(int(b["elements"]), 4 * int(a["elements"]))
            for name in STATES[:3]:
                self.assertEqual(a[name], b[name])
            for fx, other in zip(listed(a, "Fx_N"), listed(b, "Fx_N"), strict=True):
                self.assertLess(abs(fx - other), 0.03 * float(a["mu"]) * float(a["load_N"]))

    def test_faststrip_beside_the_reference(self):
        self.data("--cases", 9, "-o", "1.csv")
        self.data("--first", 10, "--cases", 3, "-o", "2.csv")
        done = self.run_program("force-features", "1.csv", "2.csv", "-o", "both.csv")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        rows = self.read("both.csv")
        contacts = [row for row in self.read("1.csv") + self.read("2.csv")
                    if row["status"] == "ok"]
        self.assertEqual([(row["number"], row["state"]) for row in rows],
                         [(row["number"], str(i + 1)) for row in contacts for i in range(6)])
        fine, coarse = ([value for row in contacts for value in listed(row, name)]
                        for name in ("Fy_N", "Fy_coarse_N"))
        self.assertEqual(numbers(rows, "Fy_fine_N"), fine)
        self.assertNotEqual(fine, coarse)
        for value, f, c in zip(numbers(rows, "Fy_tang_N"), fine, coarse, strict=True):
            self.assertAlmostEqual(value, f + (f - c) / (2**1.5 - 1), 6)
        errors = [abs(fx - tang) / (mu * load) for fx, tang, mu, load in zip(
            *(numbers(rows, name) for name in ("Fx_N", "Fx_tang_N", "mu", "load_N")),
            strict=True)]
        self.assertLess(sum(errors) / len(errors), 0.03)
        self.assertGreater(max(errors), 1e-4)
        done = self.run_program("force-features", "2.csv", "--strips", 7, "--points", 9)
        few = rows_of(done.stdout)
        self.assertEqual({row["strips"] for row in few}, {"7"})
        # Contact 10 has a neck beside which 15 strips are no better than 7.
        asked = {row["number"] for row in few}
        self.assertLessEqual({"11", "12"}, asked)
        many = [row for row in rows if row["number"] in asked]
        self.assertEqual(numbers(few, "Fx_tang_N"), numbers(many, "Fx_tang_N"))
        for a, b in zip(few, many, strict=True):
            if a["number"] != "10":
                self.assertGreater(float(a["est_err_pmax"]), float(b["est_err_pmax"]))

    def test_files_that_are_there_are_not_made_again(self):
        words = [sys.executable, ROOT / "tools/generate/force_data.py", "--across", "8"]
        for contacts, folder in ((210, "parts"), (205, "whole"), (210, "whole")):
            if folder == "whole":
                kept = self.folder / "whole" / "contacts_000001_000200.csv"
                if kept.exists():
                    kept.write_text("kept", encoding="utf-8")
            subprocess.run([*words, str(contacts), "--folder", self.folder / folder], check=True,
                           stderr=subprocess.DEVNULL)
        last = "contacts_000201_000210.csv"
        self.assertEqual(kept.read_text(encoding="utf-8"), "kept")
        self.assertEqual(self.read(f"parts/{last}"), self.read(f"whole/{last}"))
        self.assertEqual([row["number"] for row in self.read(f"parts/{last}")],
                         [str(n) for n in range(201, 211)])
        self.assertEqual(len(self.read("parts/contacts_000001_000200.csv")), 200)
        self.assertEqual(sorted(path.name for path in (self.folder / "parts").iterdir()),
                         ["contacts_000001_000200.csv", last])
        failed = subprocess.run([*words[:2], "1", "--across", "7", "--folder", "bad"],
                                cwd=self.folder, check=False, stderr=subprocess.PIPE,
                                encoding="utf-8")
        self.assertEqual(failed.returncode, 2)
        self.assertIn("--across must be", failed.stderr)

    def test_bad_input(self):
        for words, says in ((["--cases", "0"], "0"), (["--first", "0"], "0"),
                            (["--seed", "-1"], "-1"), (["--across", "7"], "7"),
                            (["--first", "2147483647", "--cases", "2"], "--cases")):
            with self.subTest(words):
                self.refused(2, "force-data", *words, says=[says])
        self.refused(2, "force-features", says=["FILE"])
        self.refused(1, "force-features", "none.csv", says=["none.csv"])
        text = self.data("--cases", 1)
        row = rows_of(text)[0]
        fx = row["Fx_N"]
        for old, new, says in ((fx, fx.rsplit(" ", 1)[0], "Fx_N"),
                               (fx, fx.replace("E", "F", 1), "Fx_N"),
                               ("cksi,", "ksi,", "cksi"),
                               *((row[name], f"{row[name]} 1 1", name) for name in ("ceta",))):
            with self.subTest(says):
                self.write("bad.csv", text.replace(old, new))
                self.refused(1, "force-features", "bad.csv", says=[says, "bad.csv"])
