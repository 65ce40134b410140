"""The pictures: written, not empty, marked with the revision; bad input refused in one line."""

import math
import subprocess
import sys
import unittest

from plot_samples import (
    PLOTS,
    Folder,
    failed_row,
    fields_text,
    gap_text,
    grid_text,
    hertz_row,
    profiles_text,
    reference_text,
    strips_text,
    sweep_row,
    sweep_text,
)

FILES = {
    "out/sweep.csv": sweep_text(
        *[sweep_row(yw) for yw in (-1, 0, 1)],
        hertz_row(-1, Fx_N=5000.0), hertz_row(0), failed_row(1),
        *[sweep_row(yw, tangential="fastsim", Fx_N=900.0) for yw in (-1, 0, 1)],
    ),
    "out/profiles_shift_0.csv": profiles_text(),
    "out/strips_shift_0.csv": strips_text(),
    "out/fields_shift_0.csv": fields_text(),
    "reference/contact/s1002_uic60_B.csv": reference_text(-1, 0, 1),
    "reference/contact/fields/shift_0_B.csv": grid_text(),
    "gap.csv": gap_text(),
    "out/functions.csv": "# faststrip 0.1.0 rev abc\n# compiler\ny_mm,delta_r_mm,gamma_right_rad,"
                         "gamma_left_rad,roll_rad,y_wheel_right_mm,y_wheel_left_mm\n"
                         + "".join(f"{y},{0.1 * y},{-0.05 - 0.01 * y},{-0.05 + 0.01 * y},{roll},"
                                   f"{-20.0 * (y > 0)},{y}\n"
                                   for y, roll in ((-2, 1e-3), (0, 0), (2, -1e-3))),
    "out/conicity.csv": "# faststrip 0.1.0 rev abc\namplitude_mm,tan_gamma_e,regression,method\n"
                        "1,0.05,0.04,klingel\n2,,,klingel\n3,0.06,0.07,klingel\n",
}
WHEELSET = ("# faststrip 0.1.0 rev abc\n# compiler\n"
            "case,side,contact,status,y_track_mm,z_track_mm,contact_angle_rad,N_N,Fx_N,Fs_N,"
            "radius_mm,Fy_track_N,Fz_track_N,y_wheel_mm,y_rail_mm,ymin_mm,ymax_mm\n"
            "1,left,1,ok,-750,0,0.05,5e4,1e3,2e3,460,1e3,5e4,5,3,-6,5\n"
            "1,right,1,under_resolved,750,0,-0.05,5e4,1e3,2e3,460,-1e3,5e4,-5,-3,-5,6\n"
            "2,left,1,ok,-751,0,0.06,4e4,1e3,2e3,460,1e3,4e4,6,4,-6,5\n"
            "2,right,1,ok,749,0,-0.06,4e4,1e3,2e3,460,-1e3,4e4,-6,-4,-5,6\n"
            "2,right,2,ok,720,9,-1.1,1e4,1e3,2e3,460,-1e3,1e4,-36,-30,-1,1\n"
            "3,both,0,no_contact,,,,,,,,,,,,,\n")
WHEELSET_STATES = "case,y_mm\n1,0\n2,1\n3,2\n"
WHEELSET_PROFILES = "case,body,side,y_mm,z_mm,y_profile_mm,z_profile_mm\n" + "".join(
    f"2,{body},{side},{sign * (750 + y)},{bend * y * y},{sign * y},{bend * y * y}\n"
    for body, bend in (("wheel", -0.001), ("rail", 0.002))
    for side, sign in (("left", -1), ("right", 1)) for y in range(-40, 41, 4))
WHEELSET_STRIPS = ("# faststrip 0.1.0 rev abc\n# wear of the wheel by law.csv\n"
                   "case,side,contact,y_left_mm,y_right_mm,"
                   "y_rail_mm,y_wheel_mm,t_gamma_per_area_N_per_mm2,wear_depth_mm_per_pass,"
                   "wear_depth_mm_per_km\n") + "".join(
    f"{case},{side},1,{y},{y + 1},{y},{y + case},{9 - y * y},{9 - y * y}e-6,{9 - y * y}e-3\n"
    for case in (1, 2) for side in ("left", "right") for y in range(-3, 4))
FILES |= {"out/wheelset.csv": WHEELSET, "out/wheelset_profiles.csv": WHEELSET_PROFILES,
          "out/wheelset_strips.csv": WHEELSET_STRIPS, "states.csv": WHEELSET_STATES}
TRACTION = "# faststrip 0.1.0 rev abc\n# compiler\ncase,series,cksi,N_N,mu,Fx_N\n" + "".join(
    f"{k},{series},{cksi},1e5,0.3,{-fall * min(3e4, 1e7 * cksi)}\n"
    for k, (series, fall, cksi) in enumerate((series, fall, cksi)
                                             for series, fall in (("constant", 1), ("falling", 0.7))
                                             for cksi in (1e-5, 1e-3, 1e-2)))
FILES |= {"out/below.csv": "# faststrip 0.1.0 rev abc\n# compiler\n"
                           "x_mm,y_mm,z_mm,von_mises_MPa\n" + "".join(
    f"{x},{y},{z},{900 * math.exp(-x * x - y * y - (z - 1)**2)}\n"
    for z in (0, 0.5, 1, 2) for y in (-1, 0, 1) for x in (-2, -1, 0.5, 1))}
FILES |= {f"out/traction_{name}.csv": TRACTION for name in ("faststrip", "fastsim", "tang")}
FILES |= {"reference/contact/traction_curve.csv": TRACTION}
RIG = ("# faststrip 0.1.0 rev abc\n# compiler\ncase,side,contact,x_track_mm,cphi_rad_per_mm,"
       "Fx_track_N,Fy_track_N\n") + "".join(
    f"{case},{side},1,{case},{1e-4 * case},{1e3 * case},{-2e3 * case}\n"
    for case in (1, 2, 3) for side in ("left", "right"))
FILES |= {"out/roller_rig.csv": RIG, "out/roller_rig_rails.csv": RIG,
          "example/roller_rig_states.csv": "case,yaw_rad\n1,0\n2,0.005\n3,0.01\n"}
FILES |= {"out/strips.csv": "# faststrip 0.1.0 rev abc\n# compiler\n"
                            "y_left_mm,y_right_mm,load_N,Fy_N\n" + "".join(
    f"{y},{y + 1},{3e4 - 1e3 * y * y},{3e3 * y}\n" for y in range(-5, 5)),
          "out/gap.csv": "# faststrip 0.1.0 rev abc\n# compiler\ny_mm,h_mm,inclination_rad\n"
                         + "".join(f"{y},{1e-3 * y * y},{0.05 * y}\n" for y in range(-9, 10))}
LOOKED_UP = ("# faststrip 0.1.0 rev abc\n# compiler\na_mm,b_mm,N_N,mu,G_MPa,cksi,ceta,"
             "cphi_rad_per_mm,Fx_N,Fy_N,Mz_Nmm,Fx_linear_N,Fy_linear_N,Mz_linear_Nmm,Fx_cubic_N,"
             "Fy_cubic_N,Mz_cubic_Nmm\n") + "".join(
    f"{a},5,8e4,0.3,82000,{1e-4 * k},0,0"
    + "".join(f",{-2.4e4 * k / 30 * off},{1e3 * off},{1e4 * off}" for off in (1, 1 + k / 1e3, 1))
    + "\n" for a in (2.5, 5, 10) for k in range(-30, 31))
FILES |= {"out/lookup/lines.csv": LOOKED_UP, "out/lookup/contacts.csv": LOOKED_UP}
PICTURES = {
    "lookup": ("out/lookup/lookup.png",),
    "traction_curve": ("out/traction_curve.png",),
    "roller_rig": ("out/roller_rig.png",),
    "subsurface": ("out/subsurface.png",),
    "curved_surface": ("out/curved_surface.png",),
    "profiles": ("out/profiles_shift_0.png",),
    "patches": ("out/patch_shift_0.png", "out/pressure_shift_0.png"),
    "sweep": ("out/sweep_normal.png", "out/sweep_tangential.png"),
    "overview": ("out/overview.png",),
    "conicity": ("out/conicity.png",),
    "wheelset": ("out/wheelset.png",),
    "wear": ("out/wear.png",),
}
COLUMNS = {
    "lookup": ("out/lookup/contacts.csv", "Fy_cubic_N"),
    "traction_curve": ("out/traction_faststrip.csv", "Fx_N"),
    "roller_rig": ("out/roller_rig_rails.csv", "Fx_track_N"),
    "subsurface": ("out/below.csv", "von_mises_MPa"),
    "curved_surface": ("out/gap.csv", "inclination_rad"),
    "profiles": ("out/profiles_shift_0.csv", "z_mm"),
    "patches": ("out/strips_shift_0.csv", "half_length_mm"),
    "sweep": ("out/sweep.csv", "Mz_Nmm"),
    "overview": ("out/fields_shift_0.csv", "pn_MPa"),
    "conicity": ("out/functions.csv", "delta_r_mm"),
    "wheelset": ("out/wheelset.csv", "radius_mm"),
    "wear": ("out/wheelset_strips.csv", "wear_depth_mm_per_km"),
}


class Pictures(unittest.TestCase):
    def assert_picture(self, path):
        import matplotlib.image

        self.assertEqual(path.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        pixels = matplotlib.image.imread(path)
        self.assertGreater(min(pixels.shape[:2]), 400)
        self.assertGreater(pixels.std(), 0.05, "nothing is drawn")

    def drawn(self, command, *arguments, files=FILES, pictures=None):
        with Folder(files) as folder:
            status, out, err = folder.run(command, *arguments)
            self.assertEqual((status, err), (0, ""))
            for name in pictures or PICTURES[command]:
                self.assert_picture(folder.path / name)
                self.assertIn(name, out)
            return out

    def test_every_command_draws_from_its_default_files(self):
        said = {}
        for command in PICTURES:
            with self.subTest(command):
                said[command] = self.drawn(command)
        self.assertIn("hertz with fastsim: 1 of 3 rows without a result skipped"
                      " (1 no_hertz_ellipse)", said["sweep"])

    def test_wheelsets_over_the_shift_and_wear_without_a_law(self):
        self.drawn("wheelset", "--states", "states.csv",
                   pictures=("out/wheelset.png", "out/wheelset_sweep.png"))
        # Solutions beside a state are no states.
        lines = WHEELSET.splitlines()
        beside = "\n".join([*lines[:2], f"{lines[2]},solution",
                            *(f"{line},1" for line in lines[3:-1]), f"{lines[-1]},",
                            f"4{lines[3][1:]},2", ""])
        self.drawn("wheelset", "--states", "states.csv",
                   files=FILES | {"out/wheelset.csv": beside})
        bare = "".join(line.rsplit(",", 2)[0] + ",,\n" if line[0] in "12" else line + "\n"
                       for line in WHEELSET_STRIPS.splitlines())
        self.drawn("wear", "--body", "rail", files=FILES | {"out/wheelset_strips.csv": bare})
        with Folder(FILES | {"states.csv": "case,y_mm\n1,0\n"}) as folder:
            status, _, err = folder.run("wheelset", "--states", "states.csv")
            self.assertEqual(status, 1)
            self.assertIn("no such state: 2 (states.csv)", err)
        none = WHEELSET_STRIPS.splitlines()[2] + "\n1,left,1,0,1,0,0,,,\n"
        with Folder(FILES | {"out/wheelset_strips.csv": none}) as folder:
            status, _, err = folder.run("wear")
            self.assertEqual((status, err.count("\n")), (1, 1))
            self.assertIn("no strip has wear or T gamma", err)

    def test_traction_curves_need_both_series(self):
        lines = [line for line in TRACTION.splitlines() if "falling" not in line]
        for text in ("\n".join(lines) + "\n", TRACTION.replace("-21000.0", "").replace(
                "-7000.0", "")):
            with Folder(FILES | {"out/traction_tang.csv": text}) as folder:
                status, _, err = folder.run("traction_curve")
                self.assertEqual((status, err.count("\n")), (1, 1))
                self.assertIn("no force of the series falling: out/traction_tang.csv", err)

    def test_profiles_with_the_gap_and_another_name(self):
        self.drawn("profiles", "--gap", "gap.csv", "-o", "new/p.png", pictures=["new/p.png"])

    def test_patches_without_contact_and_without_hertz(self):
        files = dict(FILES)
        del files["reference/contact/fields/shift_0_B.csv"]
        files["out/sweep.csv"] = sweep_text(sweep_row(0), failed_row(0))
        self.assertIn("no Hertz result at shift 0", self.drawn("patches", files=files))

    def test_two_patches(self):
        files = {**FILES, "out/strips_shift_0.csv": strips_text(2),
                 "out/fields_shift_0.csv": fields_text(2)}
        self.drawn("patches", "--no-contact", files=files)

    def test_patches_with_norm(self):
        # two patches along the rolling direction are two lines
        rows = grid_text().splitlines()
        apart = [row for row in rows if row.split(",")[0] not in ("0.25", "-0.25")]
        self.assertLess(len(apart), len(rows))
        for text in (grid_text(), "\n".join(apart) + "\n"):
            self.drawn("patches", "--norm", "norm.csv", files={**FILES, "norm.csv": text})

    def test_negative_shift_finds_its_files(self):
        files = {name.replace("shift_0", "shift_-1.5"): text for name, text in FILES.items()}
        self.drawn("patches", "--shift", "-1.5", files=files,
                   pictures=["out/patch_shift_-1.5.png", "out/pressure_shift_-1.5.png"])

    def test_sweep_alone(self):
        files = {"s.csv": FILES["out/sweep.csv"]}
        self.drawn("sweep", "--sweep", "s.csv", "--no-reference", "--folder", "p", files=files,
                   pictures=["p/sweep_normal.png", "p/sweep_tangential.png"])

    def test_sweep_with_methods_not_known_here(self):
        rows = [sweep_row(yw, normal="variational", tangential="variational") for yw in (0, 1)]
        self.drawn("sweep", files={**FILES, "out/sweep.csv": sweep_text(*rows)})

    def test_sweep_with_a_single_strip(self):
        text = "\n".join(strips_text().splitlines()[:4]) + "\n"
        self.drawn("patches", files={**FILES, "out/strips_shift_0.csv": text})


class BadInput(unittest.TestCase):
    def refused(self, command, files, words, *arguments):
        with Folder(files) as folder:
            folder.refused(self, words, command, *arguments)

    def test_missing_file_column_and_data_or_not_a_number(self):
        for command, (name, column) in COLUMNS.items():
            text = FILES[name]
            header = text.splitlines()[2]
            place = header.split(",").index(column)
            lines = text.splitlines()
            cells = lines[4].split(",")
            cells[place] = "x1"
            wrong = "\n".join(lines[:4] + [",".join(cells)] + lines[5:]) + "\n"
            for kind, files, words in (
                ("file", {k: v for k, v in FILES.items() if k != name}, f"no such file: {name}"),
                ("column", {**FILES, name: text.replace(column, "other")},
                 f"missing column: {column} ({name}:3)"),
                ("number", {**FILES, name: wrong},
                 f"{column} must be a finite number, got x1 ({name}:5)"),
                ("rows", {**FILES, name: header + "\n"},
                 f"no row of data below the header: {name}"),
                ("text", {**FILES, name: ""}, f"the file is empty: {name}"),
            ):
                with self.subTest(command=command, kind=kind):
                    self.refused(command, files, words)

    def test_body_not_known(self):
        name = "out/profiles_shift_0.csv"
        text = FILES[name].replace("rail", "track")
        self.refused("profiles", {**FILES, name: text},
                     "body must be wheel or rail, got track")

    def test_one_body_only(self):
        name = "out/profiles_shift_0.csv"
        text = FILES[name].replace("rail", "wheel")
        self.refused("profiles", {**FILES, name: text},
                     "the rail must have at least 2 points, got 0")

    def test_profiles_apart(self):
        name = "out/profiles_shift_0.csv"
        text = FILES[name].replace("rail,7", "rail,9")
        self.refused("profiles", {**FILES, name: text}, "wheel and rail do not overlap")

    def test_gap_that_does_not_ascend(self):
        lines = FILES["gap.csv"].splitlines()
        text = "\n".join(lines[:3] + [lines[4], lines[3]]) + "\n"
        self.refused("profiles", {**FILES, "gap.csv": text},
                     "y_mm must ascend, got -10 after -9 (gap.csv:5)", "--gap", "gap.csv")

    def test_strip_outside_its_edges(self):
        name = "out/strips_shift_0.csv"
        self.refused("patches", {**FILES, name: FILES[name].replace(",-2.5,", ",2.5,")},
                     f"y_mm must be between the edges of its strip, got 2.5 ({name}:4)")

    def test_no_pressure(self):
        name = "reference/contact/fields/shift_0_B.csv"
        text = "x_mm,y_mm,pn_MPa\n0,0,0\n"
        self.refused("patches", {**FILES, name: text},
                     f"pn_MPa must have a pressure above zero, got none: {name}")

    def test_single_grid_point(self):
        name = "reference/contact/fields/shift_0_B.csv"
        self.refused("patches", {**FILES, name: "x_mm,y_mm,pn_MPa\n0,0,1\n"},
                     f"a grid must have at least 2 points, got 1: {name}")

    def test_fields_of_another_contact(self):
        name = "out/fields_shift_0.csv"
        text = FILES[name].replace(",-2.5,", ",-62.5,")
        self.refused("patches", {**FILES, name: text},
                     "no field points in the strip at y_mm = -2.5")

    def test_picture_that_cannot_be_written(self):
        with Folder({**FILES, "taken": ""}) as folder:
            status, _, err = folder.run("profiles", "-o", "taken/p.png")
        self.assertEqual(status, 1)
        self.assertIn("cannot write: taken/p.png", err)

    def test_binary_file(self):
        with Folder(FILES) as folder:
            (folder.path / "out/sweep.csv").write_bytes(b"\xff\xfe\x00\x81")
            status, _, err = folder.run("sweep")
        self.assertEqual(status, 1)
        self.assertIn("not a text file: out/sweep.csv", err)


class CommandLine(unittest.TestCase):
    """The commands as programs of their own."""

    def run_program(self, command, *arguments):
        return subprocess.run([sys.executable, str(PLOTS / f"{command}.py"), *arguments],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                              timeout=1200, check=False)

    def test_error_is_one_line_and_exit_1(self):
        result = self.run_program("sweep", "--sweep", "not/there.csv")
        self.assertEqual(result.returncode, 1)
        self.assertEqual(result.stderr, "sweep.py: no such file: not/there.csv\n")
        self.assertEqual(result.stdout, "")

    def test_help_and_usage(self):
        for command in (*PICTURES, "accuracy"):
            with self.subTest(command), Folder({}) as folder:
                status, out, _ = folder.run(command, "--help")
                self.assertEqual(status, 0)
                self.assertIn("usage:", out)
                status, _, err = folder.run(command, "--nonsense")
                self.assertEqual(status, 2)
                self.assertIn("--nonsense", err)
