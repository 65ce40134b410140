"""What is said of bad input names the thing, the value and the place, in one line."""

import re
import subprocess

import methods
from cli_program import BATCH_COLUMNS, LAB, PROGRAM, ProgramTest, gap_case, gap_text, parabola

ROW = "a,gap.csv,210000,0.28,0.3,1e5,0.001,0,0"


class Words(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("gap.csv", gap_text(parabola, n=61))
        self.write("case.nml", gap_case())

    def test_a_value_that_is_none(self):
        for group, line, says in (
            ("contact", "load_N = 1e5x", "&contact load_N must be a number, got 1e5x"),
            ("contact", "LOAD_n = '1e5'", "&contact load_N must be a number, got '1e5'"),
            ("contact", "gap_file = gap", "&contact gap_file must be text in quotes, got gap"),
            ("numerics", "strips_per_patch = 1.7",
             "&numerics strips_per_patch must be a whole number, got 1.7"),
            ("sweep", "shifts_mm = 1, 2x", "&sweep shifts_mm must be a list of numbers, got 1, 2x"),
            ("contact", "colour = 'red'", "&contact unknown name: colour"),
        ):
            text = gap_case()
            if group in ("numerics", "sweep"):
                text += f"&{group}\n  {line}\n/\n"
            else:
                name = line.split()[0]
                text = re.sub(rf"(?mi)^  {name} = .*\n", "", text)
                text = text.replace(f"&{group}\n", f"&{group}\n  {line}\n")
            self.write("bad.nml", text)
            at = text[:text.index(line)].count("\n") + 1
            self.refused(1, "contact", "bad.nml", says=[says, f"(bad.nml:{at})"])

    def test_options_are_named(self):
        for words, says in (
            (("--strips-per-patch", "1.7"),
             "--strips-per-patch must be a whole number from 1 to 1000 or auto, got '1.7'"),
            (("--fastsim-nx=0",), "--fastsim-nx must be a whole number from 1 to 10000, got '0'"),
            (("--smooth", ""), "--smooth must be a number from 0 on, got ''"),
            (("--normal", "strap"), "--normal must be strip, hertz, equal_area, equal_moments,"
                                    " kpec, kpec_strips, analyn, norm or auto, got 'strap'"),
            (("--normal", "strip" + 30 * " " + "x"), "--normal must be "),
            (("--target", ""), "--target must be forces, pmax, penetration, area or power, got ''"),
        ):
            self.refused(2, "contact", "case.nml", *words, says=[says])
        for words, says in (
            (("table", "--format", "xml"), ["--format must be", "'xml'"]),
            (("table", "--range", "1"), ["--range must be LOW:HIGH", "'1'"]),
            (("table", "--n", "3:1"), ["--n must be", "'3:1'"]),
            (("integral", "--n", "1", "--b", "x"), ["--b must be", "'x'"]),
            (("integral", "--n", "1", "--b", "1", "--method", "x"), ["--method must"]),
        ):
            self.refused(2, *words, says=says)
        self.program = LAB
        said = self.refused(2, "bench", "integral", "--rounds", "0",
                            says=["--rounds must be", "'0'"])
        self.assertIn("see faststrip-lab bench --help", said)

    def test_the_gap_file_is_named(self):
        flat = gap_text(lambda y: 1.0 - 1e-3 * y * y, n=61, inv2r=-1.0)
        self.write("gap.csv", flat)
        self.refused(1, "contact", "case.nml", says=["gap.csv", "case.nml"])
        self.write("b.csv", f"{BATCH_COLUMNS}\n{ROW}\n")
        done = self.run_program("batch", "b.csv")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr.splitlines()[0], r"row 1 \(b\.csv:2\): .*gap\.csv")

    def test_control_characters(self):
        for path in ("a\x1b[31m", "a\nb", "a\x07", "a\x7f", "a\x9b1m", "a\u202eb"):
            said = self.refused(1, "contact", path)
            self.assertTrue(said[:-1].isprintable(), repr(said))
        self.assertIn("\\x1b[31m", self.refused(1, "contact", "a\x1b[31m"))
        self.assertIn("größe.nml", self.refused(1, "contact", "größe.nml"))
        done = subprocess.run([PROGRAM, "contact", b"\xff\xc3"], capture_output=True, check=False)
        self.assertEqual(done.stderr, b"faststrip: no such file: \\xff\\xc3\n")

    def test_the_missing_column_is_named(self):
        head = BATCH_COLUMNS + "\n"
        self.write("b.csv", head + ROW.rsplit(",", 2)[0] + "\n")
        self.refused(1, "batch", "b.csv", says=["column ceta", "(b.csv:2)"])
        self.write("b.csv", head + ROW + ",7\n")
        self.refused(1, "batch", "b.csv", says=["beyond the column cphi_rad_per_mm", "'7'"])

    def test_every_line_of_the_help_is_indented(self):
        for name in ("contact", "batch", "sweep"):
            done = self.run_program(name, "--help")
            lines = done.stdout.split("options:\n")[1].splitlines()
            for line in lines:
                self.assertTrue(line.startswith("  "), line)

    def test_the_help_tells_every_method_in_a_line(self):
        listed = methods.read_methods((methods.ROOT / methods.LIST).read_text(encoding="utf-8"))
        for name in ("contact", "batch", "sweep"):
            text = self.run_program(name, "--help").stdout
            for method in [*listed["normal"], *listed["tangential"]]:
                self.assertRegex(text, rf"(?m)^  {method.name} +{re.escape(methods.told(method))}$")

    def test_a_full_standard_output(self):
        for words in (("--help",), ("contact", "--help"), ("contact", "case.nml")):
            with open("/dev/full", "w", encoding="utf-8") as full:
                done = subprocess.run([PROGRAM, *words], cwd=self.folder, stdout=full, check=False,
                                      stderr=subprocess.PIPE, encoding="utf-8")
            self.assertEqual(done.returncode, 1, words)
            self.assertRegex(done.stderr, r"\Afaststrip: [^\n]*standard output[^\n]*\n\Z")
