"""Every bad input is one line that names file, line and value; nothing is written."""

from cli_program import ProgramTest, gap_case, gap_text, parabola, profile_case


class GapFiles(ProgramTest):
    def test_bad_gaps(self):
        self.write("case.nml", gap_case())
        lines = gap_text(parabola, n=31).splitlines()

        def changed(number, text):
            return "\n".join(lines[:number - 1] + [text] + lines[number:]) + "\n"

        for text, says in (
            (changed(7, "NaN,1,0.001"), ["(gap.csv:7)", "'NaN'", "y_mm"]),
            (changed(7, "-10,nan,0.001"), ["(gap.csv:7)", "'nan'", "h_mm"]),
            (changed(7, "-10,1,Inf"), ["(gap.csv:7)", "'Inf'", "inv2R_per_mm"]),
            (changed(7, "-10,,0.001"), ["(gap.csv:7)", "''", "h_mm"]),
            (changed(7, "-10,1e400,0.001"), ["(gap.csv:7)", "1e400"]),
            (changed(7, "-10,1 2,0.001"), ["(gap.csv:7)", "1 2"]),
            (changed(7, "-10,1"), ["(gap.csv:7)"]),
            (changed(7, "-20,1,0.001"), ["(gap.csv:7)", "-20"]),
            (changed(7, f"{lines[5].split(',')[0]},1,0.001"),
             ["(gap.csv:7)", lines[5].split(",")[0]]),
            ("\n".join(lines[:5]) + "\n", ["gap.csv", "got 4 "]),
            (lines[0] + "\n", ["gap.csv", "got 0 "]),
            ("y,h,r\n1,2,3\n", ["gap.csv", "y_mm"]),
            ("", ["gap.csv"]),
        ):
            with self.subTest(says):
                self.write("gap.csv", text)
                self.refused_and_untouched("contact", "case.nml", says=says)
        (self.folder / "gap.csv").unlink()
        self.refused_and_untouched("contact", "case.nml", says=["gap.csv"])

    def test_comments_count_as_lines(self):
        self.write("case.nml", gap_case())
        self.write("gap.csv", "# one\n\n" + gap_text(parabola).replace("15.0,", "x,", 1))
        self.refused_and_untouched("contact", "case.nml", says=["(gap.csv:4)", "'-x'"])


class CaseFiles(ProgramTest):
    """What one setting may not be is told by test_settings; here is what settings may not be
    together, and files."""

    def check(self, text, *says):
        with self.subTest(text=text):
            self.write("c.nml", text)
            self.refused_and_untouched("contact", "c.nml", says=says)

    def test_values_that_do_not_go_together(self):
        self.write("gap.csv", gap_text(parabola, n=61))
        self.check(gap_case(motion="creepage = 'formula'"), "(c.nml:10)", "formula")
        self.check(gap_case(load="1e5\n load_direction = 'vertical'"), "(c.nml:5)", "vertical")
        self.check(gap_case(load="1e5\n penetration_mm = 0.1"), "(c.nml:5)", "penetration_mm",
                   "load_N")
        self.check(gap_case(load="1e5\n penetration_mm = 0.1").replace("  load_N = 1e5\n", "")
                   .replace("penetration_mm = 0.1", "penetration_mm = NaN"), "(c.nml:4)", "NaN")
        self.check(gap_case(load="1\n penetration_mm = 1\n load_direction = 'vertical'")
                   .replace("  load_N = 1\n", ""), "(c.nml:5)", "vertical")

    def test_values_of_profiles(self):
        for changes, says in (
            (dict(rail="profile = 'uic60', rail_distance_mm = 1500, gauge_mm = 1435"),
             ["(c.nml:8)", "rail_distance_mm", "gauge_mm", "1500"]),
            (dict(rail="profile = 'uic60', rail_distance_mm = 1500\n gauge_depth_mm = 14"),
             ["(c.nml:8)", "rail_distance_mm", "gauge_depth_mm", "1500"]),
            (dict(rail="profile = 'uic60', profile_left = '60e1'"),
             ["(c.nml:8)", "&rail profile_left", "one contact"]),
            (dict(wheel="profile = 's1002'\n radius_left_mm = 459"),
             ["(c.nml:6)", "&wheel radius_left_mm", "one contact"]),
            (dict(wheel="profile = 's1002'\n profile_left = 'cone20'"),
             ["(c.nml:6)", "&wheel profile_left", "one contact"]),
            (dict(rail="profile = 'uic60', cant = 3"), ["(c.nml:8)", "&rail cant", "inclination"]),
            (dict(rail="profile = 'uic60', inclination = 3"), ["(c.nml:8)", "&rail inclination"]),
            (dict(rail="profile = 'uic60', inclination = 999"), ["(c.nml:8)", "999", "tangent"]),
            (dict(rail="profile = 'uic60', inclination = 0.025, cant = 0.025"),
             ["(c.nml:8)", "&rail cant", "inclination"]),
            (dict(rail="profile = 'uic60', gauge_mm = 1668"),
             ["(c.nml:4)", "&wheel back_spacing_mm", "1668"]),
            (dict(wheel="profile = 's1002', back_spacing_mm = 1440"), ["1435", "1440", "-70"]),
            (dict(rail="cant = 0.025"), ["&rail", "profile", "c.nml:7"]),
            (dict(wheel="profile = 'none.txt'"), ["none.txt"]),
            (dict(rail="profile = 'none.prr'"), ["none.prr"]),
            (dict(contact="load_N = 1e5, shift_mm = 100"), ["c.nml", "100"]),
            (dict(contact="shift_mm = 1"), ["&contact", "load_N"]),
            (dict(material="nu_rail = 0.3"), ["&material", "mu"]),
        ):
            self.check(profile_case(**changes), *says)

    def test_measured_profiles(self):
        points = [f"{y} {abs(y) ** 1.5 / 100.0}" for y in range(-30, 31)]
        for number, text, says in (
            (5, "NaN 1", ["(p.txt:5)", "NaN"]), (5, "-26 Inf", ["(p.txt:5)", "Inf"]),
            (5, "-26", ["(p.txt:5)", "-26"]), (5, "-26 1 2", ["(p.txt:5)", "-26 1 2"]),
            (5, "-26 one", ["(p.txt:5)", "one"]), (5, "-40 1", ["(p.txt:5)", "turns back"]),
            (5, "-26 1e12", ["(p.txt:5)", "1e12"]),
        ):
            lines = points[:]
            lines[number - 1] = text
            self.write("p.txt", "\n".join(lines) + "\n")
            self.check(profile_case(wheel="profile = 'p.txt'"), *says)
            self.check(profile_case(rail="profile = 'p.txt'"), *says)
        self.write("p.txt", "\n".join(points) + "\n")
        self.check(profile_case(rail="profile = 'p.txt'"), "(c.nml:7)", "&rail inclination",
                   "p.txt", "0.025")
        self.write("p.txt", "\n".join(points[:4]) + "\n")
        self.check(profile_case(wheel="profile = 'p.txt'"), "p.txt", "4")
        self.write("p.txt", "")
        self.check(profile_case(wheel="profile = 'p.txt'"), "p.txt", "0")

    def test_groups_and_names(self):
        self.write("gap.csv", gap_text(parabola, n=61))
        good = gap_case()
        for text, says in (
            (good.replace("load_N", "loadN"), ["(c.nml:4)", "loadN", "did you mean load_N"]),
            (good.replace("load_N", "loadN").replace("mu ", "mue "),
             ["(c.nml:4)", "&contact unknown name: loadN, did you mean load_N",
              "&material unknown name: mue, did you mean mu"]),
            ("&contact load_N = 1 /\n", ["missing groups: &material, &motion, &wheel, &rail"]),
            (gap_case(load="1e5\n colour = 'red'"), ["(c.nml:5)", "colour"]),
            (good.replace("&motion", "&emotion"), ["(c.nml:9)", "&emotion"]),
            (good + "&mystery x = 1 /\n", ["(c.nml:12)", "&mystery"]),
            (good + "&motion\n/\n", ["(c.nml:12)", "&motion"]),
            (good.split("&motion")[0], ["c.nml", "&motion"]),
            (good.replace("&material\n  mu = 0.3\n/\n", ""), ["c.nml", "&material"]),
            (good[good.index("&material"):], ["c.nml", "&contact"]),
            ("", ["c.nml", "&contact"]),
            (profile_case().replace("&wheel\n  profile = 's1002'\n/\n", ""), ["c.nml", "&wheel"]),
            (profile_case().replace("&rail\n  profile = 'uic60'\n/\n", ""), ["c.nml", "&rail"]),
            (good.rstrip("/\n"), ["(c.nml:9)", "&motion"]),
            (good.replace("1e5\n/", "1e5\n"), ["(c.nml:1)", "&contact"]),
            (good.replace("1e5\n/", "1e5\n/\nstray"), ["(c.nml:6)", "stray"]),
            (gap_case(load="abc"), ["(c.nml:4)", "abc"]),
            (gap_case(load="'1e5'"), ["(c.nml:4)", "'1e5'"]),
            (gap_case(load="1e5 shift_mm = .true."), ["(c.nml:4)", ".true."]),
            (gap_case(load="1,5"), ["(c.nml:4)", "1,5"]),
            (gap_case(load="200000/2"), ["(c.nml:4)", "200000/2"]),
            (gap_case(load="1e400"), ["(c.nml:4)"]),
            (gap_case(load="1e5 2e5"), ["(c.nml:4)", "2e5"]),
            (gap_case(motion="cksi = 0.1 / ceta = 0.1"), ["(c.nml:10)", "ceta"]),
            (gap_case(extra="&numerics\n strips_per_patch = 15.5\n/\n"), ["(c.nml:13)", "15.5"]),
            (gap_case(extra="&numerics\n strips_per_patch = 99999999999\n/\n"), ["(c.nml:13)"]),
            (gap_case(gap_file="gap.csv"[:3] + "'x"), ["(c.nml:3)"]),
            (gap_case(load="1e5 !" + 70000 * "x"), ["(c.nml:4)", "65536 characters"]),
        ):
            self.check(text, *says)

    def test_files(self):
        self.refused_and_untouched("contact", "none.nml", says=["none.nml"])
        self.refused_and_untouched("sweep", "none.nml", says=["none.nml"])
        (self.folder / "dir").mkdir()
        self.refused_and_untouched("contact", "dir", says=["dir"])
        self.refused_and_untouched("contact", "", says=["no such file"])
