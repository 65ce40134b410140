"""faststrip profile: what it reads, says, draws and writes."""

import collections
import csv
import math
import re
import subprocess
import sys
import unittest
import xml.etree.ElementTree

from cli_program import ROOT, ProgramTest, profile_case, rows_of

# Measured profiles that are no part of the project; where they are not, these tests are skipped.
BANK = ROOT.parent / "shared" / "data" / "profiles"

# Files that need to be told something, and what.
TOLD = {
    "MBench_UIC60_v3.ban": ["--z-positive-to", "down"],
    "left-roller-v1-pre-dry.ban": ["--z-positive-to", "down"],
    "avg_low2.ban": ["--any-count"],
    "worn_high_mileage.prw": ["--tape-circle", "73"],
    "SNX00500.mpt": ["--section", "2"],
}

POINT = re.compile(r'\s*"?\s*[-+]?[\d.]')


def by_line(of_points, of_words=str):
    """A change of the lines of points, and of the others."""
    return lambda text: "\n".join(
        of_points(line) if POINT.match(line) and "=" not in line else of_words(line)
        for line in text.split("\n"))


# What editors, spreadsheets and other programs do to files, and what cannot be read then.
CHANGES = {
    "CRLF": lambda text: text.replace("\n", "\r\n"),
    "mark": lambda text: "\xef\xbb\xbf" + text,
    "no end": lambda text: text.rstrip("\n"),
    "blank lines": lambda text: text + "\n  \n\t\n",
    "upper case": by_line(str, str.upper),
    "lower case": by_line(str, str.lower),
    "comma behind": by_line(lambda line: line.rstrip() + ","),
    "commas": by_line(lambda line: re.sub(r"[ \t]+", ",", line.strip())),
    "comments": by_line(lambda line: line.rstrip() + " ! caf\xe9"),
    "signs": by_line(lambda line: re.sub(r"(^|[ \t])(\d)", r"\1+\2", line)),
    "decimal commas": by_line(lambda line: line.replace(".", ",")),
    "UTF-16": lambda text: text.encode("utf-16").decode("latin-1"),
}
REFUSED = {"decimal commas": "a point for its decimals", "UTF-16": "UTF-16"}


def wheel_text(n=261, scale=1.0):
    """A cone 1:20 with a flange of two arcs, y to the field side, z down."""
    lines = []
    for i in range(n):
        y = -68.0 + 128.0 * i / (n - 1)
        z = -0.05 * y
        if y < -35.0:
            z = 1.75 + 26.0 * math.sin(min((-35.0 - y) / 15.0, 1.0) * math.pi / 2.0) ** 2
        if y < -50.0:
            z = 27.75 - 15.0 * ((-50.0 - y) / 18.0) ** 2
        lines.append(f"{y * scale:.6f} {z * scale:.6f}")
    return "\n".join(lines) + "\n"


def rail_text(n=401):
    lines = []
    for i in range(n):
        angle = math.radians(178.0 * (i / (n - 1) - 0.5))
        lines.append(f"{36.0 * math.sin(angle):.6f} {36.0 * (1.0 - math.cos(angle)):.6f}")
    return "\n".join(lines) + "\n"


class Profiles(ProgramTest):
    def rows(self, *words):
        done = self.run_program("profile", *words)
        return done, rows_of(done.stdout)

    def test_one_row_a_file_also_where_it_fails(self):
        self.write("w.txt", wheel_text())
        self.write("bad.txt", "1 1\n2 x\n")
        done, rows = self.rows("w.txt", "bad.txt", "none.txt", "--kind", "wheel")
        self.assertEqual(done.returncode, 1)
        self.assertEqual([row["status"] for row in rows], ["ok", "file_format", "file_missing"])
        self.assertEqual([row["file"] for row in rows], ["w.txt", "bad.txt", "none.txt"])
        self.assertIn("(bad.txt:2)", rows[1]["message"])
        self.assertEqual(len(done.stderr.splitlines()), 3)
        self.assertIn("2 of 3 profiles failed", done.stderr)
        self.assertEqual(rows[0]["points"], "261")
        self.assertAlmostEqual(float(rows[0]["y_min_mm"]), -68.0, places=9)
        self.assertAlmostEqual(float(rows[0]["Sh_mm"]), 27.75, delta=0.01)
        self.assertEqual(rows[1]["points"], "")

    def test_the_columns_that_are_promised(self):
        self.write("r.txt", rail_text())
        done, rows = self.rows("r.txt", "--kind", "rail")
        self.assertEqual(done.returncode, 0, done.stderr)
        promised = ("file,format,kind,points,y_min_mm,y_max_mm,z_min_mm,z_max_mm,Sd_mm,Sh_mm,"
                    "qR_mm,status,message").split(",")
        self.assertLessEqual(set(promised), set(rows[0]))
        self.assertEqual(list(rows[0])[:11], promised[:11])
        self.assertEqual(rows[0]["Sd_mm"], "")
        self.assertAlmostEqual(float(rows[0]["curvature_max_per_mm"]), 1.0 / 36.0, delta=1e-3)

    def test_what_was_clipped_is_said_once_and_stands_in_the_csv(self):
        text = "-36.5 60\n-36.2 50\n" + rail_text() + "35.9 40\n36.0 50\n"
        self.write("r.txt", text)
        done, rows = self.rows("r.txt", "--kind", "rail")
        self.assertEqual(done.returncode, 0, done.stderr)
        words = "2 points clipped beyond y = 35.9945 mm"
        self.assertIn(words, done.stderr)
        self.assertIn(words, rows[0]["message"])
        self.assertTrue(any(line.startswith("# ") and words in line
                            for line in done.stdout.splitlines()))
        self.assertEqual(len(done.stderr.splitlines()), 1)

    def test_cleaning_is_done_as_asked_and_told(self):
        self.write("w.txt", wheel_text(scale=0.001))
        done, rows = self.rows("w.txt", "--kind", "wheel")
        self.assertIn("--unit", rows[0]["message"])
        done, rows = self.rows("w.txt", "--kind", "wheel", "--unit", "m", "--shift-z", "2",
                               "--smooth-wavelength", "2", "--resample", "0.25")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertAlmostEqual(float(rows[0]["spacing_max_mm"]), 0.25, delta=0.01)
        for words in ("shifted by 0.00000, 2.00000 mm", "smoothed by a wavelength of 2.00000 mm",
                      "resampled every 0.250000 mm"):
            self.assertIn(words, rows[0]["curation"])
            self.assertIn(words, done.stderr)
        done, rows = self.rows("w.txt", "--kind", "wheel", "--unit", "m")
        self.assertEqual(rows[0]["curation"], "")
        self.assertEqual(done.stderr, "")

    def test_conversion_round_trips(self):
        self.write("w.txt", wheel_text())
        for path in ("a.csv", "a.prw"):
            done = self.succeed("profile", "w.txt", "--kind", "wheel", "-o", path)
            done = self.succeed("profile", path, "--kind", "wheel", "-o", "b.csv")
            points = [[float(x) for x in row.values()] for row in self.read("b.csv")]
            given = [[float(x) for x in line.split()] for line in wheel_text().splitlines()]
            self.assertEqual(points, given)
        done = self.run_program("profile", "w.txt", "--kind", "wheel", "-o", "a.prr")
        self.assertEqual(done.returncode, 2)

    def test_standard_profiles_by_their_names(self):
        done, rows = self.rows("60e1", "--nominal", "60e1", "-o", "60e1.csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((rows[0]["format"], rows[0]["kind"]), ("standard", "rail"))
        self.assertEqual(float(rows[0]["wear_max_mm"]), 0.0)
        self.assertEqual(rows[0]["y_max_mm"], "3.7149999999999999E+001")
        again = self.rows("60e1.csv", "--kind", "rail")[1]
        self.assertEqual(again[0]["points"], rows[0]["points"])
        wheel = self.rows("s1002")[1]
        self.assertEqual(wheel[0]["kind"], "wheel")
        self.assertAlmostEqual(float(wheel[0]["Sd_mm"]), 32.5, delta=0.1)
        self.assertAlmostEqual(float(wheel[0]["Sh_mm"]), 28.0, delta=0.1)

    def test_files_called_like_standard_profiles_are_told_from_them(self):
        for words in (("--kind", "wheel"), ("--unit", "m"), ("--side", "left"), ("--section", "2"),
                      ("--y-positive-to", "gauge"), ("--z-positive-to", "up"), ("--any-count",),
                      ("--ignore-smoothing",), ("--tape-circle", "1")):
            done, rows = self.rows("uic60", *words)
            self.assertEqual((done.returncode, rows[0]["status"]), (1, "bad_argument"), words)
            self.assertEqual(len(done.stderr.splitlines()), 1)
            self.assertIn("standard profile", done.stderr)
            self.assertIn("./uic60", done.stderr)
        self.assertEqual(self.succeed("profile", "uic60", "--kind", "rail").stderr, "")
        self.write("uic60", rail_text())
        done, rows = self.rows("./uic60", "--kind", "rail")
        self.assertEqual((done.stderr, rows[0]["points"]), ("", "401"))
        self.assertIn("./uic60", self.succeed("profile", "--help").stdout)

    def test_wear_against_a_nominal_rail(self):
        self.write("x.txt", rail_text())
        done = self.run_program("profile", "x.txt", "--nominal", "uic60")
        self.assertEqual(done.returncode, 1)
        self.assertIn("--kind", done.stderr)
        self.good_points("uic60", "r.csv", cant="0")
        rows = self.read("r.csv")
        lines = [f"{float(r['y_mm'])} {float(r['z_mm']) + 0.7 * (float(r['y_mm']) < 3.0)}"
                 for r in rows if r["body"] == "rail"]
        self.write("worn.txt", "\n".join(lines) + "\n")
        done, rows = self.rows("worn.txt", "--kind", "rail", "--nominal", "uic60", "--cant",
                               "0.025", "--draw", "p.svg")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertAlmostEqual(float(rows[0]["wear_top_mm"]), 0.7, delta=0.02)
        # 0.7 mm lower, on R13 a little above where it ends in the flank.
        self.assertAlmostEqual(float(rows[0]["wear_side_mm"]), 0.068, delta=0.01)
        turned = self.rows("worn.txt", "--kind", "rail", "--nominal", "uic60", "--inclination",
                           "0.025")[1]
        self.assertEqual(turned[0], rows[0])
        done = self.run_program("profile", "worn.txt", "--kind", "rail", "--cant", "0.025",
                                "--inclination", "0.025")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--inclination", done.stderr)
        picture = xml.etree.ElementTree.fromstring(
            (self.folder / "p.svg").read_text(encoding="utf-8"))
        names = [text.text for text in picture.iter("{http://www.w3.org/2000/svg}text")]
        for name in ("z (down), mm", "curvature, 1/mm", "wear depth, mm"):
            self.assertIn(name, names)

    def good_points(self, rail, path, cant):
        self.write("c.nml", profile_case(rail=f"profile = '{rail}', cant = {cant}"))
        self.succeed("contact", "c.nml", "--profiles", path)

    def test_a_case_takes_the_same_words(self):
        self.write("w.txt", wheel_text(scale=0.001))
        self.write("r.txt", rail_text() + "35.9 40\n")
        wheel = "profile = 'w.txt', unit = 'm'"
        self.write("c.nml", profile_case(wheel=wheel, rail="profile = 'r.txt', inclination = 0"))
        done = self.succeed("contact", "c.nml")
        self.assertIn("r.txt: 1 points clipped beyond y = 35.9945 mm", done.stderr)
        self.assertIn("# r.txt: 1 points clipped", done.stdout)
        self.write("c.nml", profile_case(wheel="profile = 'w.txt'"))
        done = self.run_program("contact", "c.nml")
        self.assertEqual(done.returncode, 1)
        self.assertIn("--unit", done.stderr)

    def test_a_contact_that_hangs_on_single_points_is_named(self):
        words = "do not resolve the contact: with every second one pmax changes by "
        lines = rail_text().splitlines()
        # Where S1002 touches it.
        at = min(range(len(lines)), key=lambda i: abs(float(lines[i].split()[0]) + 2.0))
        y, z = lines[at].split()
        for depth, status in ((0.0, "ok"), (0.01, "under_resolved")):
            lines[at] = f"{y} {float(z) + depth:.6f}"
            self.write("r.txt", "\n".join(lines) + "\n")
            self.write("c.nml", profile_case(contact="load_N = 8e4",
                                             rail="profile = 'r.txt', inclination = 0",
                                             motion="cksi = 1e-3",
                                             extra="&sweep\n shifts_mm = 0\n/\n"))
            done = self.run_program("contact", "c.nml")
            self.assertEqual(rows_of(done.stdout)[0]["status"], status, done.stderr)
            self.assertEqual(words in done.stderr, depth > 0.0, done.stderr)
            self.is_doubtful = depth > 0.0  # no steel carries the point that stands out
            rows = self.good("sweep", "c.nml")
            self.assertEqual(rows[0]["status"], status)

    def test_usage(self):
        self.write("w.txt", wheel_text())
        for words in (["w.txt", "w.txt", "-o", "x.csv"], ["w.txt", "--keep", "3"],
                      ["w.txt", "--unit", "ft"], ["w.txt", "--smooth-noise", "0"], [],
                      ["w.txt", "--smooth-noise", "5", "--smooth-wavelength", "3"]):
            done = self.run_program("profile", *words)
            self.assertEqual(done.returncode, 2, words)
            self.assertEqual(len(done.stderr.splitlines()), 1)


class Mutated(unittest.TestCase):
    def test_mutated_files_give_a_profile_or_one_line(self):
        done = subprocess.run([sys.executable, ROOT / "tools/check/mutated_profiles.py", "1200",
                               "--seed", "3"], stdout=subprocess.PIPE, encoding="utf-8",
                              check=False)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertRegex(done.stdout, r"1200 files: .*\b\d{2,} ok")


class Stored(unittest.TestCase):
    def test_the_documents_say_what_the_table_has(self):
        lines = (ROOT / "reference" / "profiles.csv").read_text(encoding="utf-8").splitlines()
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        text = " ".join((ROOT / "docs" / "formats.md").read_text(encoding="utf-8").split())
        self.assertTrue(f"Of {len(rows)} contacts: " in text, len(rows))
        for status, count in collections.Counter(row["status"] for row in rows).items():
            self.assertTrue(f"{count} `{status}`" in text, status)
        # Each that is not ok is explained.
        explained = text.split("| profile | not `ok` |")[1].split("###")[0]
        for row in rows:
            self.assertEqual(row["status"] == "ok", not row["message"])
            if row["status"] != "ok":
                name = (row["rail"] if row["wheel"] == "s1002" else row["wheel"]).split()[0]
                self.assertTrue(name in explained or name.partition("_")[0] + "_*" in explained,
                                name)


@unittest.skipUnless(BANK.is_dir(), "the measured profiles are not here")
class Bank(ProgramTest):
    def test_every_file_gives_a_profile_or_names_the_option(self):
        files = sorted(path for path in BANK.iterdir() if path.suffix != ".md")
        self.assertGreaterEqual(len(files), 32)
        for path in files:
            done = self.run_program("profile", str(path))
            row = rows_of(done.stdout)[0]
            if path.name not in TOLD:
                self.assertEqual((done.returncode, row["status"]), (0, "ok"), path.name)
                continue
            self.assertEqual(done.returncode, 1, path.name)
            self.assertIn(TOLD[path.name][0], done.stderr)
            done = self.succeed("profile", str(path), *TOLD[path.name])

    def test_what_programs_do_to_files_changes_no_profile(self):
        for path in sorted(BANK.glob("*.*")):
            if path.suffix == ".md":
                continue
            told = TOLD.get(path.name, [])
            text = path.read_bytes().decode("latin-1").replace("\r\n", "\n")
            given = self.run_program("profile", str(path), *told, "-o", "a.csv")
            self.assertEqual(given.returncode, 0, given.stderr)
            points = self.points("a.csv")
            for name, change in CHANGES.items():
                (self.folder / path.name).write_bytes(change(text).encode("latin-1"))
                done = self.run_program("profile", path.name, *told, "-o", "b.csv")
                if name in REFUSED:
                    self.assertEqual(done.returncode, 1, (path.name, name))
                    self.assertIn(REFUSED[name], done.stderr)
                    self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                else:
                    self.assertEqual(done.returncode, 0, (path.name, name, done.stderr))
                    self.assertEqual(self.points("b.csv"), points, (path.name, name))

    def test_flange_figures_are_those_of_the_headers(self):
        for path in sorted(BANK.glob("*.whl")):
            printed = {}
            for line in path.read_text(encoding="latin-1").splitlines():
                key, equals, value = line.partition("=")
                if equals and key in ("Sd", "Sh", "qR"):
                    printed[key] = float(value)
            if not printed:
                continue
            row = rows_of(self.run_program("profile", str(path)).stdout)[0]
            for key, value in printed.items():
                self.assertAlmostEqual(float(row[f"{key}_mm"]), value, delta=0.05, msg=path.name)

    def test_what_is_written_reads_back(self):
        for path in sorted(BANK.glob("*.*")):
            if path.suffix == ".md":
                continue
            told = TOLD.get(path.name, [])
            ending = ".prw" if path.suffix in (".prw", ".whl") else ".prr"
            for name in ("a.csv", "a" + ending):
                kind = ["--kind", "wheel" if ending == ".prw" else "rail"]
                first = self.run_program("profile", str(path), *told, "-o", name)
                self.assertEqual(first.returncode, 0, first.stderr)
                second = self.run_program("profile", name, *kind, "-o", "b.csv")
                self.assertEqual(second.returncode, 0, second.stderr)
                if name == "a.csv":
                    points = self.points("a.csv")
                self.assertEqual(self.points("b.csv"), points, path.name)

    def points(self, name):
        return [(float(row["y_mm"]), float(row["z_mm"])) for row in self.read(name)]

    def test_the_benchmark_profiles_are_the_analytic_ones(self):
        def forces(wheel, rail):
            self.write("c.nml", profile_case(
                contact="load_N = 8e4", wheel=wheel, rail=rail, motion="creepage = 'formula'",
                extra="&sweep\n shifts_mm = -4, 0, 3\n/\n"))
            return self.good("sweep", "c.nml")

        analytic = forces("profile = 's1002'", "profile = 'uic60', cant = 0.025")
        measured = forces(f"profile = '{BANK / 'MBench_S1002_v3.prw'}'",
                          f"profile = '{BANK / 'MBench_UIC60_v3.prr'}', inclination = 0")
        for one, other in zip(analytic, measured):
            self.assertAlmostEqual(float(one["pmax_MPa"]) / float(other["pmax_MPa"]), 1.0,
                                   delta=2.5e-3)
