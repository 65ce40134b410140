"""On a terminal the program shows tables for people, elsewhere CSV; --plot draws; folders are
made."""

import os
import pathlib
import pty
import select
import shutil
import subprocess

from cli_program import (
    PATIENCE,
    PROGRAM,
    ROOT,
    ProgramTest,
    gap_case,
    gap_text,
    parabola,
    profile_case,
    rows_of,
    without_progress,
)

CASE = profile_case(contact="name = 'mine', load_N = 80000.0, load_direction = 'vertical',"
                            " shift_mm = 2.0",
                    wheel="profile = 's1002', radius_mm = 460.0",
                    rail="profile = '60e1', cant = 0.025", material="mu = 0.35",
                    motion="creepage = 'formula'")


class PeopleTest(ProgramTest):

    def setUp(self):
        super().setUp()
        self.write("case.nml", CASE)

    def on_terminal(self, *words):
        """Run the program with its output on a pseudo-terminal."""
        ours, its = pty.openpty()
        process = subprocess.Popen([str(PROGRAM), *words], cwd=self.folder, stdout=its,
                                   stdin=subprocess.DEVNULL, stderr=subprocess.PIPE)
        os.close(its)
        seen = b""
        while select.select([ours], [], [], PATIENCE)[0]:
            try:
                part = os.read(ours, 65536)
            except OSError:
                break
            if not part:
                break
            seen += part
        os.close(ours)
        said = process.stderr.read().decode("utf-8")
        process.stderr.close()
        return (process.wait(), seen.decode("utf-8").replace("\r\n", "\n"),
                without_progress(said))


class TestTerminal(PeopleTest):

    def test_contact(self):
        code, seen, said = self.on_terminal("contact", "case.nml")
        self.assertEqual((code, said), (0, ""))
        row = self.good("contact", "case.nml")[0]
        lines = {}
        for line in seen.splitlines():
            words = [word.strip() for word in line.split("  ") if word.strip()]
            if len(words) > 1:
                lines[words[0]] = words[1:]
        self.assertEqual(lines["status"], ["ok"])
        for name, column, unit in (("normal force", "N_N", "N"),
                                   ("maximum pressure", "pmax_MPa", "MPa"),
                                   ("contact angle", "gamma_rad", "rad"),
                                   ("contact area", "area_mm2", "mm^2"),
                                   ("longitudinal force on the rail", "Fx_N", "N"),
                                   ("estimated error of Fx", "est_err_Fx", "of mu N")):
            self.assertEqual(lines[name][1:], [unit])
            self.assert_close(float(lines[name][0]), float(row[column]), 6e-4, what=name)
        self.assertIn("-o FILE.csv", seen)
        self.assertLessEqual(max(map(len, seen.splitlines())), 100)

    def test_limitation_is_told(self):
        self.write("gap.csv", gap_text(parabola, half_width=3.0))
        self.write("gap.nml", gap_case())
        code, seen, said = self.on_terminal("contact", "gap.nml")
        self.assertEqual(code, 0)
        self.assertIn("edge_of_data", seen)
        self.assertIn("the contact runs to the end of the gap data", said)

    def test_rows(self):
        self.write("sweep.nml", CASE + "&sweep shifts_mm = -1.0, 0.0 /\n")
        self.write("states.csv", "case,side,y_mm,roll_rad,yaw_rad,speed_mm_s,pitch_rate_rad_s,Fz_N"
                                 "\na,both,1,,0.001,20000,,160000\n")
        for words, header, n in (
            (("sweep", "sweep.nml"), ["yw_mm", "normal", "tangential", "status"], 6),
            (("wheelset", "case.nml", "--states", "states.csv"),
             ["case", "side", "contact", "status"], 2),
            (("conicity", "case.nml", "--amplitudes", "1,2,3"),
             ["amplitude_mm", "tan_gamma_e"], 3),
        ):
            with self.subTest(words[0]):
                code, seen, said = self.on_terminal(*words)
                self.assertEqual((code, said), (0, ""))
                lines = seen.splitlines()
                self.assertEqual(lines[0].split()[:len(header)], header)
                self.assertEqual(lines.index(""), n + 1)
                self.assertIn(f"{n} rows; all ", lines[-1])
                self.assertNotIn("#", seen)

    def test_csv_where_it_is_asked_for(self):
        piped = self.run_program("conicity", "case.nml", "--amplitudes", "1,2,3").stdout
        self.assertTrue(piped.startswith("# faststrip "))
        for words in (("-o", "out.csv"), ("-o", "-")):
            code, seen, said = self.on_terminal("conicity", "case.nml", "--amplitudes", "1,2,3",
                                                *words)
            self.assertEqual((code, said), (0, ""))
            got = seen if words[1] == "-" else (self.folder / "out.csv").read_text("utf-8")
            self.assertEqual(got, piped)


class TestFolders(PeopleTest):

    def test_folders_of_outputs_are_made(self):
        self.good("contact", "case.nml", "-o", "new/deep/out.csv", "--strips", "other/strips.csv")
        self.assertEqual(rows_of((self.folder / "new/deep/out.csv").read_text("utf-8"))[0]["case"],
                         "mine")
        self.assertTrue((self.folder / "other" / "strips.csv").exists())
        self.write("gap.csv", gap_text(parabola))
        self.write("cases.csv", "case,gap_file,E_MPa,nu,mu,N_N,cksi,ceta,cphi_rad_per_mm\n"
                                "1,gap.csv,210000,0.28,0.3,1e5,0.001,0,0\n")
        self.good("batch", "cases.csv", "-o", "rows/out.csv")
        self.assertTrue((self.folder / "rows" / "out.csv").exists())

    def test_two_outputs_in_a_new_folder_are_told_apart(self):
        self.refused(2, "contact", "case.nml", "-o", "new/x.csv", "--strips", "new/../new/x.csv",
                     says=("must be different files",))

    def test_a_file_is_no_folder(self):
        self.refused(1, "contact", "case.nml", "-o", "case.nml/x.csv", says=("Not a directory",))


class TestPlot(PeopleTest):

    BEGIN = {".png": b"\x89PNG", ".svg": b"<?xml", ".pdf": b"%PDF"}

    def assert_picture(self, name):
        data = (self.folder / name).read_bytes()
        self.assertTrue(data.startswith(self.BEGIN[pathlib.Path(name).suffix]), data[:20])
        self.assertGreater(len(data), 5000)

    def test_every_command_draws(self):
        self.write("sweep.nml", CASE + "&sweep shifts_mm = -1.0, 0.0, 1.0 /\n")
        self.write("states.csv", "case,side,y_mm,roll_rad,yaw_rad,speed_mm_s,pitch_rate_rad_s,Fz_N"
                                 "\na,both,1,,0.001,20000,,160000\n")
        self.write("table.csv", "y_mm,delta_r_mm\n" + "".join(
            f"{y / 10.0},{y / 100.0}\n" for y in range(-80, 81)))
        for words in (
            ("contact", "case.nml", "--plot", "pictures/contact.png"),
            ("contact", "case.nml", "--normal", "hertz", "--tangential", "none",
             "--plot", "hertz.svg"),
            ("sweep", "sweep.nml", "--plot", "sweep.pdf"),
            ("wheelset", "case.nml", "--states", "states.csv", "--plot", "wheelset.png"),
            ("conicity", "case.nml", "--plot", "conicity.svg"),
            ("conicity", "--delta-r", "table.csv", "--plot", "table.png"),
        ):
            with self.subTest(words):
                plain = self.run_program(*words[:-2])
                done = self.run_program(*words)
                self.assertEqual((done.returncode, done.stderr), (0, plain.stderr))
                self.assert_picture(words[-1])
                if words[0] == "conicity":
                    self.assertEqual(done.stdout, plain.stdout)

    def test_other_endings_are_refused(self):
        for name in ("out.gif", ".png", "png"):
            self.refused(2, "contact", "case.nml", "--plot", name,
                         says=("--plot must end with .png, .svg or .pdf",))

    def test_what_is_missing_is_named(self):
        program = self.folder / "bin" / "faststrip"
        program.parent.mkdir()
        shutil.copy(PROGRAM, program)
        words = [str(program), "contact", "case.nml", "--plot", "x.png"]

        def said(**environment):
            done = subprocess.run(words, cwd=self.folder, stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, encoding="utf-8", check=False,
                                  env=os.environ | environment, timeout=PATIENCE)
            self.assertEqual((done.returncode, done.stdout), (1, ""), done.stderr)
            self.assertRegex(done.stderr, r"\Afaststrip: [^\n]+\n\Z")
            self.assertFalse((self.folder / "x.png").exists())
            return done.stderr

        self.assertIn("--plot needs the scripts installed with the program", said())
        shutil.copytree(ROOT / "plots", self.folder / "share" / "faststrip" / "plots")
        self.assertIn("python3 with matplotlib and numpy: install", said(PATH=str(self.folder)))
