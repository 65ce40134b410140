"""Run bin/faststrip or bin/faststrip-lab in folders of their own, and read what they write."""

import csv
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from shared_runs import files_below, shared_run, write_files

# Long enough for a machine ten times slower, s.
PATIENCE = 600

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "bin" / "faststrip"
LAB = ROOT / "bin" / "faststrip-lab"
GAPS = ROOT / "reference" / "contact" / "gaps"


BATCH_COLUMNS = "case,gap_file,E_MPa,nu,mu,N_N,cksi,ceta,cphi_rad_per_mm"
RESULT_COLUMNS = (
    "status,penetration_mm,area_mm2,pmax_MPa,ymin_mm,ymax_mm,xmax_mm,n_patches,Fx_N,Fy_N,"
    "Mz_Nmm,friction_power_N,stick_fraction,normal_us,tangential_us,residual_inside,"
    "overlap_outside,est_err_penetration,est_err_pmax,est_err_area,est_err_Fx,est_err_Fy,"
    "est_err_Mz,est_err_cksi,est_err_ceta,gap_change_um,choice,strips_across,limitations,"
    "t_gamma_N,t_gamma_spin_N,t_gamma_per_area_N_per_mm2,fatigue_index,wear_ug_per_m,"
    "wear_mm3_per_m,flash_temperature_K,"
    "temperature_max_C,temperature_x_mm,temperature_y_mm,von_mises_max_MPa,"
    "von_mises_x_mm,von_mises_y_mm,von_mises_z_mm,est_err_von_mises"
).split(",")

# What does not change from run to run and is no status.
FIGURES = RESULT_COLUMNS[1:RESULT_COLUMNS.index("normal_us")]


def without_progress(said):
    """What was said on stderr, but for the lines that tell how far long work is."""
    return "".join(line for line in said.splitlines(keepends=True)
                   if not re.fullmatch(r"faststrip(-lab)?: .*, \d+ s\n", line))


def without_doubts(said):
    """What was said on stderr, but for the lines that name what no contact has in practice."""
    return "".join(line for line in said.splitlines(keepends=True)
                   if not re.search(r" should be at (least|most) \S+, got \S+: [^?]+\?", line))


def rows_of(text):
    """The rows of a CSV text as dictionaries, comments left out."""
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines, strict=True))


def numbers(rows, name):
    return [float(row[name]) for row in rows]


def gap_text(height, n=601, half_width=15.0, inv2r=1.0 / 920.0):
    """A gap file of n points; height(y) in mm."""
    lines = ["y_mm,h_mm,inv2R_per_mm"]
    for i in range(n):
        y = -half_width + 2.0 * half_width * i / (n - 1)
        lines.append(f"{y!r},{height(y)!r},{inv2r!r}")
    return "\n".join(lines) + "\n"


def parabola(y):
    return y * y / 600.0


def gap_case(gap_file="gap.csv", load="1e5", mu="0.3", motion="", extra=""):
    """A case file that works on a gap file."""
    return (
        f"&contact\n  name = 'gap'\n  gap_file = '{gap_file}'\n  load_N = {load}\n/\n"
        f"&material\n  mu = {mu}\n/\n"
        f"&motion\n  {motion}\n/\n{extra}"
    )


def profile_case(contact="load_N = 1e5", wheel="profile = 's1002'", rail="profile = 'uic60'",
                 material="mu = 0.3", motion="", extra=""):
    """A case file that works on two profiles; each group takes one line."""
    return (
        f"&contact\n  {contact}\n/\n&wheel\n  {wheel}\n/\n&rail\n  {rail}\n/\n"
        f"&material\n  {material}\n/\n&motion\n  {motion}\n/\n{extra}"
    )

# What wheelset and sweep say of their results.
COUNTED = r"(?m)^faststrip: \d+ of \d+ results have a limitation: .*\n"


class ProgramTest(unittest.TestCase):
    """Tests that run the program in a folder that is gone afterwards."""

    program = PROGRAM
    # Is it tried with numbers that no contact has in practice, which is said?
    is_doubtful = False

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text.encode("utf-8"))
        return path

    def read(self, name):
        return rows_of((self.folder / name).read_text(encoding="utf-8"))

    def peak_memory(self, *words):
        """Of a good run, kB. Under a small process: a new one inherits the peak of its parent."""
        done = subprocess.run([sys.executable, "-c", (
            "import resource, subprocess, sys; subprocess.run(sys.argv[1:], check=True); "
            "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)"),
            self.program, *words], cwd=self.folder, stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL, encoding="utf-8", check=True)
        return int(done.stdout)

    def run_program(self, *words):
        """Run the program; its stderr without the lines of progress."""
        done = subprocess.run(
            [str(self.program), *(str(word) for word in words)],
            cwd=self.folder,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            encoding="utf-8",
            timeout=PATIENCE,
            check=False,
        )
        done.stderr = without_progress(done.stderr)
        return done

    def share_program(self, *words):
        """As `run_program`; tests that run the same on the same files share one run.

        For dear runs whose output is looked at, not for tests of how the program runs.
        """
        self.assertNotIn(str(self.folder), " ".join(str(word) for word in words))
        done = shared_run([self.program, *words], files_below(self.folder), PATIENCE)
        write_files(self.folder, done.made)
        done.stderr = without_progress(done.stderr)
        return done

    def succeed(self, *words):
        """Run what has to succeed, whatever it says on stderr."""
        done = self.run_program(*words)
        self.assertEqual(done.returncode, 0, (words, done.stdout, done.stderr))
        return done

    def written(self, *words, share=False):
        """The rows of the file that a run writes, which succeeds and prints nothing."""
        words = (*words, "-o", "out.csv")
        done = self.share_program(*words) if share else self.run_program(*words)
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        return self.read("out.csv")

    def assert_columns(self, row, wanted):
        """Its columns are these, in this order; there may be others."""
        self.assertEqual([name for name in row if name in wanted], wanted)

    def good(self, *words, share=False):
        """Run what has to succeed without a word on stderr, but of how many results have a
        limitation; the rows on stdout."""
        done = self.share_program(*words) if share else self.run_program(*words)
        said = without_doubts(done.stderr) if self.is_doubtful else done.stderr
        said = re.sub(COUNTED, "", said)
        self.assertEqual((done.returncode, said), (0, ""), words)
        return rows_of(done.stdout)

    def solved(self, *words):
        """Run what has to succeed, with at most the word that one contact is under resolved.

        It is said on stderr, with the estimates, if and only if the row has the status.
        """
        done = self.succeed(*words)
        rows = rows_of(done.stdout)
        self.assertEqual(len(rows), 1, words)
        if rows[0]["status"] == "ok":
            self.assertEqual(done.stderr, "", words)
        else:
            self.assertEqual(rows[0]["status"], "under_resolved", words)
            self.assertRegex(done.stderr, r"\Afaststrip: [^\n]+\n\Z", words)
            for clause in done.stderr.removeprefix("faststrip: ").strip().split("; "):
                said = re.fullmatch(r"the estimated error of (?:the )?(\w+) is above (\S+?)"
                                    r"(?: of mu N(?: c)?)?: (\S+)", clause)
                self.assertIsNotNone(said, (words, done.stderr))
                self.assertGreater(float(said[3]), float(said[2]), words)
                self.assert_close(float(said[3]), float(rows[0][f"est_err_{said[1]}"]), 1e-5,
                                  what=words)
        return rows[0]

    def refused(self, code, *words, says=()):
        """Run what has to fail with one line on stderr that holds some texts."""
        done = self.run_program(*words)
        self.assertEqual(done.returncode, code, (words, done.stderr))
        self.assertEqual(done.stdout, "", words)
        self.assertRegex(done.stderr, rf"\A{self.program.name}: [^\n]+\n\Z", words)
        for text in says:
            self.assertIn(text, done.stderr, words)
        return done.stderr

    def refused_and_untouched(self, *words, says=()):
        """The same on stdout and with -o: an existing file stays, nothing is left over."""
        self.refused(1, *words, says=says)
        kept = b"kept as it is,\r\n no line end"
        (self.folder / "kept.csv").write_bytes(kept)
        before = sorted(path.name for path in self.folder.iterdir())
        self.refused(1, *words, "-o", "kept.csv", says=says)
        self.assertEqual((self.folder / "kept.csv").read_bytes(), kept, words)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), before, words)

    def assert_spread(self, row, prefix):
        """Median, 95th percentile and worst of a time ascend; `us` is the median's older name."""
        figures = [float(row[f"{prefix}_{name}"]) for name in ("median", "p95", "worst")]
        self.assertEqual(figures, sorted(figures))
        self.assertGreater(figures[0], 0.0)
        self.assertEqual(row["us"], row[f"{prefix}_median"])

    def assert_close(self, value, wanted, relative=0.0, absolute=0.0, what=None):
        self.assertLessEqual(abs(value - wanted), relative * abs(wanted) + absolute,
                             (what, value, wanted))


class LabTest(ProgramTest):
    """The same with the program of the laboratory."""

    program = LAB
