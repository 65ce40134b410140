"""Inputs as they come from the field: written by other programs, printed rounded, stitched."""


from cli_program import BATCH_COLUMNS, ProgramTest, gap_case, gap_text, profile_case, rows_of

FIGURES = ("penetration_mm", "pmax_MPa", "area_mm2", "Fx_N", "Fy_N")
# A wheel of a flange, its root and a straight tread, points 5 mm apart on it.
WHEEL = """-56.2543,24.1607 -55.4403,25.6731 -54.2825,26.9417 -52.8506,27.8901 -51.2309,28.4614
-49.5209,28.6211 -47.8234,28.3595 -46.2407,27.6925 -44.8681,26.6602 -43.7881,25.3247
-43.1169,23.9191 -42.4612,22.0296 -41.8055,20.1401 -41.1499,18.2507 -40.4942,16.3612
-39.8385,14.4717 -39.1828,12.5823 -38.5271,10.6928 -38.1076,9.6268 -37.6023,8.5987
-37.0147,7.6153 -36.3486,6.6833 -35.6086,5.8088 -34.7995,4.9978 -33.9268,4.2556
-32.9964,3.5873 -32.0145,2.9973 -30.9876,2.4895 -29.9226,2.0674 -28.8267,1.7338
-27.7071,1.4909 -26.5715,1.3403 -26.0000,1.3000""".split() + [
    f"{y}.0000,{-0.05 * y:.4f}" for y in range(-21, 60, 5)]
LAW = """# source: coefficients as a public implementation of a law has them
# body: wheel
# density_kg_per_m3: 7850
from_N_per_mm2,to_N_per_mm2,constant_ug_per_m_mm2,slope_ug_per_m_N
0,10.4,0,5.3
10.4,77.2,55.0,0
77.2,{end},-4778.7,61.9
"""


def fine_parabola(y):
    return 0.002 * y * y


class Field(ProgramTest):
    def row(self, *words):
        """The row of a contact that is solved without a word but of its resolution."""
        done = self.succeed("contact", *words)
        return rows_of(done.stdout)[0]

    def same(self, row, clean, relative):
        self.assertEqual((row["status"], clean["status"]), ("ok", "ok"))
        for name in FIGURES:
            self.assert_close(float(row[name]), float(clean[name]), relative, 1e-3, name)
        self.assertLess(float(row["est_err_pmax"]), 0.03)

    def test_a_law_of_rounded_coefficients(self):
        self.write("gap.csv", gap_text(fine_parabola, n=61, inv2r=0.00108695652))
        self.write("case.nml", gap_case(motion="cksi = 0.001"))
        for end in ("1000", "inf", ""):
            self.write("law.csv", LAW.format(end=end))
            row = self.good("contact", "case.nml", "--wear", "law.csv")[0]
            self.assert_close(float(row["wear_ug_per_m"]), 64.18, 1e-3)

    def test_one_point_written_twice(self):
        self.write("case.nml", profile_case(
            contact="load_N = 8e4, load_direction = 'vertical', shift_mm = 0",
            wheel="profile = 'w.csv', radius_mm = 460", rail="profile = '60e1', cant = 0.025",
            material="mu = 0.35", motion="creepage = 'given', cksi = 0.001"))
        self.write("w.csv", "y_mm,z_mm\n" + "\n".join(WHEEL) + "\n")
        clean = self.row("case.nml")
        self.assert_close(float(clean["pmax_MPa"]), 1152.0, 0.02)
        place = WHEEL.index("-1.0000,0.0500")
        for double in ("-1.0000,0.0500", "-0.999999999,0.0500", "-1.000000001,0.0500",
                       "-0.999999,0.0500", "-1.000001,0.0500"):
            self.write("w.csv", "y_mm,z_mm\n" + "\n".join(
                WHEEL[:place + 1] + [double] + WHEEL[place + 1:]) + "\n")
            row = self.row("case.nml")
            self.assertEqual(row["status"], clean["status"], double)
            for name in FIGURES:
                self.assert_close(float(row[name]), float(clean[name]), 1e-6, 1e-3, double)

    def test_rows_that_were_written_twice(self):
        self.write("case.nml", gap_case(motion="cksi = 0.001"))
        radii = "y_mm,delta_r_mm\n" + "".join(
            f"{0.5 * i - 8},{0.05 * i - 0.8!r}\n" for i in range(33))
        found = []
        for again in (1, 2):
            for name, text in (("gap.csv", gap_text(fine_parabola, n=61)), ("r.csv", radii)):
                lines = text.splitlines()
                lines[20:22] = lines[20:22] if again == 1 else [
                    lines[20], lines[20], lines[21], lines[21]]
                self.write(name, "\n".join(lines) + "\n")
            row = self.good("contact", "case.nml")[0]
            found.append([[row[name] for name in FIGURES],
                          self.good("conicity", "--delta-r", "r.csv", "--amplitudes", "3")])
        self.assertEqual(found[0], found[1])

    def test_tables_in_every_dialect(self):
        gap = gap_text(fine_parabola, n=61)
        states = ("case,side,y_mm,roll_rad,yaw_rad,speed_mm_s,pitch_rate_rad_s,Fz_N\n"
                  "a,both,1,,0,20000,,160000\n")
        batch = f"{BATCH_COLUMNS}\na,gap.csv,210000,0.28,0.3,1e5,0.001,0,0\n"
        delta_r = "y_mm,delta_r_mm\n" + "".join(
            f"{0.5 * i - 8},{0.05 * i - 0.8!r}\n" for i in range(33))
        self.write("case.nml", gap_case(motion="cksi = 0.001"))
        self.write("w.nml", "&wheel\n profile = 's1002'\n/\n&rail\n profile = '60e1', cant = 0.025"
                            "\n/\n&material\n mu = 0.3\n/\n")
        self.write("law.csv", LAW.format(end="1000"))

        def results():
            return [
                [{name: value for name, value in row.items() if not name.endswith("_us")}
                 for row in rows_of(self.run_program(*words).stdout)] for words in (
                    ("contact", "case.nml", "--wear", "law.csv"), ("batch", "cases.csv"),
                    ("wheelset", "w.nml", "--states", "states.csv"),
                    ("conicity", "--delta-r", "r.csv", "--amplitudes", "3"))]

        texts = {"gap.csv": gap, "states.csv": states, "cases.csv": batch, "r.csv": delta_r,
                 "law.csv": LAW.format(end="1000")}
        for name, text in texts.items():
            self.write(name, text)
        clean = results()
        self.assertTrue(all(rows for rows in clean))
        dialects = (
            lambda text: text.replace(",", ";"), lambda text: text.replace(",", "\t"),
            lambda text: "sep=;\n" + text.replace(",", ";"), lambda text: "\ufeff" + text,
            lambda text: "sep=,\r\n" + text.replace("\n", "\r\n"),
            lambda text: text.replace(",", "\t").replace("\n", "\r"),
            lambda text: text.replace(",", " ;  ").replace("\n", " \n\n"),
        )
        for dialect in dialects:
            for name, text in texts.items():
                self.write(name, dialect(text))
            self.assertEqual(results(), clean, dialect("a,b\n"))
        for name in ("gap.csv", "r.csv", "law.csv"):
            self.write(name, texts[name].replace(",", " "))
        self.assertEqual([results()[i] for i in (0, 3)], [clean[i] for i in (0, 3)])
        for text, words in ((gap.replace(",", ";").replace(".", ","), "not a comma"),
                            (gap.replace("y_mm", "Y_mm"), "missing column: y_mm, got Y_mm"),
                            (gap.replace(",", "|"), "missing column: y_mm, got y_mm|h_mm")):
            self.write("gap.csv", text)
            self.refused(1, "contact", "case.nml", says=[words, "gap.csv"])
        (self.folder / "gap.csv").write_bytes(gap.encode("utf-16"))
        self.refused(1, "contact", "case.nml", says=["UTF-16", "gap.csv:1"])

    def test_columns_that_may_be_left_out_are_not_misspelt(self):
        self.write("w.nml", "&wheel\n profile = 's1002'\n/\n&rail\n profile = '60e1', cant = 0.025"
                            "\n/\n&material\n mu = 0.3\n/\n")
        self.write("gap.csv", gap_text(fine_parabola, n=61))
        for wrong, right in (("curve_radius_m", "curve_radius_mm"), ("Vy_mm_s", "vy_mm_s"),
                             ("yaw_rate_deg_s", "yaw_rate_rad_s"),
                             ("rail_right_y_um", "rail_right_y_mm"),
                             ("rol_rate_rad_s", "roll_rate_rad_s")):
            self.write("s.csv", "case,side,y_mm,roll_rad,yaw_rad,speed_mm_s,pitch_rate_rad_s,Fz_N,"
                                f"{wrong}\na,both,1,,0,20000,,160000,1\n")
            self.refused(1, "wheelset", "w.nml", "--states", "s.csv",
                         says=[f"a column must be named {right}, got {wrong}"])
        # The other columns of friction are the program's where a row may say its kind.
        for wrong, right, kind in (("given_penetration_um", "given_penetration_mm", ""),
                                   ("Friction_kind", "friction_kind", ""),
                                   ("mu_kinetik", "mu_kinetic", "friction_kind,"),
                                   ("speed_m_s", "speed_mm_s", "friction_kind,")):
            cell = "constant," if kind else ""
            self.write("b.csv", f"{BATCH_COLUMNS},{kind}{wrong}\n"
                                f"a,gap.csv,210000,0.28,0.3,1e5,0.001,0,0,{cell}\n")
            self.refused(1, "batch", "b.csv",
                         says=[f"a column must be named {right}, got {wrong}"])

    def test_scans_that_were_stitched(self):
        self.write("case.nml", gap_case(motion="cksi = 0.001"))
        self.write("gap.csv", gap_text(fine_parabola, n=601))
        clean = self.good("contact", "case.nml")[0]
        lines = gap_text(fine_parabola, n=601).splitlines()
        for scans in (2, 3):
            for off in (1e-8, 1e-7, 1e-6, 1e-5):
                stitched = lines[:1]
                for i, line in enumerate(lines[1:]):
                    y, h, a = line.split(",")
                    stitched.append(f"{y},{float(h) + (off if i % scans == 1 else 0.0):.9f},{a}")
                self.write("gap.csv", "\n".join(stitched) + "\n")
                # Edges of strips follow the ridges.
                self.same(self.good("contact", "case.nml")[0], clean, 1e-4 + 50.0 * off)

    def test_scans_that_share_points(self):
        self.write("case.nml", gap_case(motion="cksi = 0.001"))
        self.write("gap.csv", gap_text(fine_parabola, n=301))
        clean = self.good("contact", "case.nml")[0]
        for apart in (1e-9, 1e-8, 1e-7, 1e-6):
            for higher in (0.0, 1e-6):
                lines = ["y_mm,h_mm,inv2R_per_mm"]
                for i in range(-150, 151):
                    y = 0.1 * i
                    lines.append(f"{y:.10f},{fine_parabola(y):.6f},{1.0 / 920.0!r}")
                    if i % 10 == 0 and abs(i) < 60:
                        lines.append(f"{y + apart:.10f},{fine_parabola(y) + higher:.6f},"
                                     f"{1.0 / 920.0!r}")
                self.write("gap.csv", "\n".join(lines) + "\n")
                self.same(self.good("contact", "case.nml")[0], clean, 1e-3)
        # A wall stays one, however close its points are.
        self.write("gap.csv", "\n".join(
            lines[:1] + [f"{0.1 * i + (1e-9 if i == 21 else 0.0) - (0.1 if i > 20 else 0.0)!r},"
                         f"{fine_parabola(0.1 * min(i, i - (i > 20))) + (0.01 if i > 20 else 0)!r},"
                         f"{1.0 / 920.0!r}" for i in range(-150, 151)]) + "\n")
        done = self.run_program("contact", "case.nml")
        self.assertEqual(rows_of(done.stdout)[0]["status"], "conformal")
        self.assertIn("a step of 0.100000E-1 mm", done.stderr)
