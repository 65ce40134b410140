"""Tables as NetCDF: read by xarray through HDF5, values, units and words are those of the CSV."""

import functools
import os
import shutil
import subprocess
import sys
from unittest import mock

import cf_units
import numpy as np
import xarray as xr
from h5netcdf.dimensions import Dimension

import other_user
from cli_program import BATCH_COLUMNS, PROGRAM, ROOT, ProgramTest, gap_text, parabola, profile_case

PLUGIN = PROGRAM.with_name("faststrip_netcdf.so")
UNITS = {
    "pmax_MPa": "MPa", "N_N": "N", "cphi_rad_per_mm": "rad mm-1", "normal_us": "us",
    "gap_change_um": "um", "cksi": "1", "n_patches": "1", "stick_fraction": "1",
    "t_gamma_per_area_N_per_mm2": "N mm-2", "wear_ug_per_m": "ug m-1", "area_mm2": "mm2",
    "wear_mm3_per_m": "mm3 m-1", "Mz_Nmm": "N mm", "gamma_rad": "rad", "yw_mm": "mm",
    "est_err_Fx": "1",
}
# What one of each unit is in units of the SI.
IN_SI = {
    "1": (1, "1"), "mm": (1e-3, "m"), "um": (1e-6, "m"), "mm2": (1e-6, "m2"),
    "mm-1": (1e3, "m-1"), "rad": (1, "rad"), "rad mm-1": (1e3, "rad m-1"),
    "rad s-1": (1, "rad s-1"), "N": (1, "N"),
    "N mm": (1e-3, "N m"), "MPa": (1e6, "Pa"), "N mm-2": (1e6, "Pa"), "us": (1e-6, "s"),
    "mm s-1": (1e-3, "m s-1"), "ug m-1": (1e-9, "kg m-1"), "mm3 m-1": (1e-9, "m2"),
    "mm km-1": (1e-6, "1"), "K": (1, "K"), "degC": (274.15, "K"),
}


STATES = ("case,side,y_mm,roll_rad,yaw_rad,speed_mm_s,pitch_rate_rad_s,Fz_N\n"
          "a,both,1,,0,20000,,160000\n")


class Netcdf(ProgramTest):
    def opened(self, name):
        # xarray asks for the size of `record` for each variable, and h5netcdf looks at all of them
        # each time: with some hundred columns that takes seconds. Here each is asked for once.
        size = functools.cache(Dimension.size.fget)
        with mock.patch.object(Dimension, "size", property(size)):
            return xr.load_dataset(self.folder / name, engine="h5netcdf")

    def converted(self, text, *words):
        """A table as it comes back."""
        self.write("t.csv", text)
        self.good("netcdf", "t.csv", "-o", "t.nc", *words)
        return self.opened("t.nc")

    def assert_same(self, data, rows, rounded=float):
        """All cells are there, as numbers, as text, or not there."""
        self.assertEqual(sorted(data.variables), sorted(rows[0]))
        for name in rows[0]:
            cells, values = [row[name] for row in rows], data[name].values
            if values.dtype.kind in "OU":
                self.assertEqual(values.tolist(), cells, name)
                self.assertNotIn("units", data[name].attrs)
                continue
            self.assertEqual(values.shape, (len(cells),), name)
            wanted = [rounded(cell) if cell else float("nan") for cell in cells]
            np.testing.assert_array_equal(values, wanted, name)


class Results(Netcdf):
    def contact(self):
        self.write("case.nml", profile_case(contact="name = 'mine', load_N = 8e4, shift_mm = -2",
                                            motion="cksi = 0.001, cphi_rad_per_mm = 1e-4"))
        self.good("contact", "case.nml", "-o", "c.csv", "--strips", "s.csv", "--fields", "f.csv",
                  "--gap", "g.csv", "--profiles", "p.csv")
        return "csfgp"

    def test_all_of_a_contact_comes_back(self):
        for name in self.contact():
            self.good("netcdf", f"{name}.csv", "-o", f"{name}.nc")
            self.assert_same(self.opened(f"{name}.nc"), self.read(f"{name}.csv"))

    def test_units_are_those_of_the_names(self):
        self.contact()
        self.good("netcdf", "c.csv", "-o", "c.nc")
        data = self.opened("c.nc")
        for name, unit in UNITS.items():
            self.assertEqual(data[name].attrs["units"], unit, name)
        self.assertEqual(data.pmax_MPa.attrs["long_name"], "maximum pressure")
        self.assertEqual(dict(data.sizes), {"record": 1})
        self.assertEqual(data.n_patches.dtype, np.int32)
        self.assertEqual(data.pmax_MPa.dtype, np.float64)
        self.assertEqual(data.case.values.tolist(), ["mine"])

    def test_every_column_says_what_it_is_in_units_of_udunits(self):
        """Also those of a wheelset, of conicity and of profiles."""
        self.contact()
        shutil.copy(ROOT / "example" / "wheelset_states.nml", self.folder)
        self.write("states.csv", STATES)
        self.good("wheelset", "wheelset_states.nml", "--states", "states.csv", "-o", "w.csv",
                  "--strips", "ws.csv", "--profiles", "wp.csv")
        self.good("conicity", "wheelset_states.nml", "--y-max", "4", "--y-step", "1", "-o", "k.csv",
                  "--functions", "kf.csv")
        self.write("rail.txt", "".join(f"{y} {y * y / 600}\n" for y in range(-30, 31)))
        self.run_program("profile", "rail.txt", "--kind", "rail", "-o", "d.csv")
        self.write("gap.csv", gap_text(parabola))
        self.write("b.csv", f"{BATCH_COLUMNS},given_penetration_mm,friction_kind,mu_kinetic,"
                            "half_slip_speed_mm_s,initial_slope_factor,speed_mm_s\n"
                            "a,gap.csv,210000,0.28,0.3,1e5,0.001,0,0,,constant,,,,\n")
        self.good("batch", "b.csv", "-o", "r.csv")
        seen = set()
        for name in ("c", "s", "f", "g", "p", "w", "ws", "wp", "k", "kf", "d", "r"):
            self.good("netcdf", f"{name}.csv", "-o", f"{name}.nc")
            data = self.opened(f"{name}.nc")
            self.assert_same(data, self.read(f"{name}.csv"))
            for column, values in data.variables.items():
                with self.subTest(column):
                    self.assertNotEqual(values.attrs["long_name"], column.replace("_", " "))
                    if values.dtype.kind in "OU":
                        continue
                    unit = values.attrs["units"]
                    seen.add(unit)
                    factor, base = IN_SI[unit]
                    self.assert_close(cf_units.Unit(unit).convert(1.0, cf_units.Unit(base)), factor,
                                      1e-14, what=unit)
        self.assertEqual(seen, set(IN_SI))

    def test_comments_and_revisions_are_attributes(self):
        self.contact()
        self.good("netcdf", "c.csv", "-o", "c.nc")
        text = (self.folder / "c.csv").read_text(encoding="utf-8")
        comments = [line[2:] for line in text.splitlines() if line.startswith("#")]
        about = self.opened("c.nc").attrs
        self.assertEqual(about["comment"].split("\n"), comments)
        self.assertEqual(about["source"], comments[0])
        self.assertEqual(about["revision"], comments[0].split(" rev ")[1])
        version = self.run_program("--version").stdout.strip()
        self.assertEqual(about["history"], f"written as NetCDF by {version}")
        self.assertTrue(about["Conventions"].startswith("CF-"))

    def test_the_same_table_is_the_same_file(self):
        self.contact()
        for name in ("one", "two"):
            self.good("netcdf", "c.csv", "-o", f"{name}.nc")
        self.assertEqual(*((self.folder / f"{name}.nc").read_bytes() for name in ("one", "two")))


class Outputs(Netcdf):
    """-o FILE.nc of those that write tables."""

    def assert_same_output(self, words, *options):
        """The same with FILE.csv and with FILE.nc, but for times."""
        for ending in ("csv", "nc"):
            files = [(option, f"{option.strip('-')}.{ending}") for option in options]
            self.succeed(*words, *(word for pair in files for word in pair))
        for option in options:
            name = option.strip("-")
            data, rows = self.opened(f"{name}.nc"), self.read(f"{name}.csv")
            times = [column for column in rows[0] if column.endswith("_us")]
            for row in rows:
                for column in times:
                    del row[column]
            self.assert_same(data.drop_vars(times), rows)
        self.assertEqual([path.name for path in self.folder.iterdir() if "tmp" in path.name], [])

    def test_contacts_and_sweeps(self):
        self.write("case.nml", profile_case(motion="cksi = 0.001", extra="&sweep\n shifts_mm = 1,"
                                            " -2\n/\n"))
        self.assert_same_output(("contact", "case.nml"), "-o", "--strips", "--fields", "--gap",
                                "--profiles")
        self.assert_same_output(("sweep", "case.nml"), "-o")

    def test_wheelsets(self):
        shutil.copy(ROOT / "example" / "wheelset_states.nml", self.folder)
        self.write("states.csv", STATES)
        self.assert_same_output(("wheelset", "wheelset_states.nml", "--states", "states.csv"), "-o",
                                "--strips", "--profiles")
        self.assert_same_output(("conicity", "wheelset_states.nml", "--y-max", "4", "--y-step",
                                 "1"), "-o", "--functions")

    def cases(self):
        self.write("gap.csv", gap_text(parabola))
        self.write("b.csv", BATCH_COLUMNS + ",mine_kN\n" + "".join(
            f"c{i},gap.csv,210000,0.28,{'O.3' if i == 5 else 0.3},{1e4 * (i + 1)!r},0.001,0,0,{i}"
            "\n" for i in range(9)))

    def test_batches_and_what_is_merged(self):
        self.cases()
        for part in (1, 2):
            self.run_program("batch", "b.csv", "--part", f"{part}/2", "-o", f"p{part}.csv")
        for words, name in ((("batch", "b.csv"), "b.nc"), (("merge", "p1.csv", "p2.csv"), "m.nc"),
                            (("batch", "b.csv", "--threads", "2"), "t.nc")):
            done = self.run_program(*words, "-o", name)
            self.assertEqual(done.returncode, 1)
            self.assertIn("left out: 1 cells that are no numbers, first in column mu, got 'O.3'",
                          done.stderr)
            self.assertIn("1 of 9 contacts failed", done.stderr)
            data = self.opened(name)
            self.assertEqual(data.status.values.tolist().count("ok"), 8)
            self.assertEqual(data.N_N.values.tolist(), [1e4 * (i + 1) for i in range(9)])
            self.assertEqual(np.isnan(data.mu.values).tolist(), [i == 5 for i in range(9)])
            self.assertEqual(data.mine_kN.attrs["units"], "kN")
        self.assertEqual(*((self.folder / name).read_bytes() for name in ("b.nc", "t.nc")))
        self.run_program("batch", "b.csv", "-o", "r.csv")
        wanted = [float(row["pmax_MPa"] or "nan") for row in self.read("r.csv")]
        np.testing.assert_array_equal(self.opened("m.nc").pmax_MPa.values, wanted)
        self.run_program("batch", "b.csv", "-o", "s.nc", "--single")
        np.testing.assert_array_equal(self.opened("s.nc").pmax_MPa.values,
                                      np.array(wanted, dtype=np.float32))

    def test_what_a_batch_refuses_at_once(self):
        self.cases()
        self.refused(2, "batch", "b.csv", "--part", "1/2", "-o", "b.nc", says=["parts are CSV"])
        self.refused(2, "batch", "b.csv", "--parts", "2", "-o", "b.nc", says=["parts are CSV"])
        self.refused(2, "batch", "b.csv", "--single", "-o", "r.csv",
                     says=["--single needs -o with a file that ends with .nc"])
        text = (self.folder / "b.csv").read_text(encoding="utf-8")
        self.write("b.csv", text.replace("mine_kN", "mine/kN"))
        self.refused(1, "batch", "b.csv", "-o", "b.nc",
                     says=["a column must have a name that NetCDF takes, got 'mine/kN' (b.csv)"])

    def test_what_was_solved_is_not_lost(self):
        """Where NetCDF cannot be written, a run that goes on writes it."""
        self.cases()
        self.run_program("batch", "b.csv", "-o", "b.nc")
        whole = (self.folder / "b.nc").read_bytes()
        (self.folder / "b.nc").unlink()
        good, self.program = self.program, self.folder / "faststrip"
        shutil.copy(good, self.program)
        done = self.run_program("batch", "b.csv", "-o", "b.nc")
        self.assertEqual(done.returncode, 1)
        self.assertIn("faststrip: cannot write NetCDF: ", done.stderr)
        self.assertFalse((self.folder / "b.nc").exists())
        self.assertTrue((self.folder / "b.nc.partial").exists())
        self.program = good
        # It would be of a gap that is gone.
        gap = (self.folder / "gap.csv").read_text()
        (self.folder / "gap.csv").write_text("none")
        self.refused(1, "batch", "b.csv", "-o", "b.nc", "--resume", says=["gap.csv has changed"])
        (self.folder / "gap.csv").write_text(gap)
        done = self.run_program("batch", "b.csv", "-o", "b.nc", "--resume")
        self.assertIn("1 of 9 contacts failed", done.stderr)
        self.assertEqual((self.folder / "b.nc").read_bytes(), whole)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()),
                         ["b.csv", "b.nc", "faststrip", "gap.csv"])


class Tables(Netcdf):
    def test_columns_of_others_hold_what_their_cells_say(self):
        data = self.converted("# mine\nname,n,x,t_s,load_kN,note_mm,nothing,big\n"
                              "a b,1,1,0.5,1,1.5,,3000000000\n"
                              "'',-2,2.5,1,2,none,,1\n"
                              '"c, ""d""",3,1e300,2,3,2,,2\n'
                              "größe,4,0,3,4,,,2\n")
        self.assert_same(data, self.read("t.csv"))
        self.assertEqual({name: data[name].dtype.kind for name in data.variables},
                         {"name": "O", "n": "i", "x": "f", "t_s": "f", "load_kN": "f",
                          "note_mm": "O", "nothing": "f", "big": "f"})
        self.assertEqual(data.t_s.attrs, {"long_name": "t s", "units": "s"})
        self.assertEqual(data.load_kN.attrs["units"], "kN")
        # Whether these are pure numbers nobody knows.
        for name in ("name", "n", "x", "note_mm", "nothing"):
            self.assertNotIn("units", data[name].attrs)
        self.assertEqual(data.attrs["comment"], "mine")
        self.assertNotIn("revision", data.attrs)

    def test_empty_cells_have_the_fill_value(self):
        data = self.converted("n_patches,pmax_MPa,strips_across,status\n"
                              "1,,15,ok\n,2.5,15,\n2,NaN,15,ok\n")
        np.testing.assert_array_equal(data.n_patches.values, [1, np.nan, 2])
        np.testing.assert_array_equal(data.pmax_MPa.values, [np.nan, 2.5, np.nan])
        self.assertEqual(data.strips_across.dtype, np.int32)
        self.assertEqual(data.status.values.tolist(), ["ok", "", "ok"])
        raw = xr.load_dataset(self.folder / "t.nc", engine="h5netcdf", mask_and_scale=False)
        self.assertEqual(raw.pmax_MPa.attrs["_FillValue"], raw.pmax_MPa.values[0])
        self.assertEqual(raw.n_patches.attrs["_FillValue"], raw.n_patches.values[1])
        self.assertEqual(raw.n_patches.dtype, np.int32)

    def test_a_cell_that_is_no_number_is_left_out_and_told(self):
        self.write("t.csv", "case,mu,status\na,0.3,ok\nb,O.3,file_format\nc,x,file_format\n")
        done = self.succeed("netcdf", "t.csv", "-o", "t.nc")
        self.assertEqual(done.stderr, "faststrip: left out: 2 cells that are no numbers, first in"
                                      " column mu, got 'O.3' (t.csv:3)\n")
        np.testing.assert_array_equal(self.opened("t.nc").mu.values, [0.3, np.nan, np.nan])

    def test_single_precision(self):
        text = "pmax_MPa,n,x\n1.2345678901234567E+003,16777217,0.1\n,2,-1e-50\n"
        data = self.converted(text, "--single")
        self.assertEqual(data.pmax_MPa.dtype, np.float32)
        self.assert_same(data, self.read("t.csv"), lambda cell: np.float32(float(cell))
                         if "." in cell or "e" in cell else int(cell))
        self.assertEqual(data.n.values[0], 16777217)
        self.write("t.csv", text + "1,1,1\n1e39,1,2\n1e40,3,4\n")
        self.refused(1, "netcdf", "t.csv", "-o", "t.nc", "--single",
                     says=["within single precision in column pmax_MPa", "(t.csv:5)"])

    def test_many_rows_in_chunks(self):
        """More than three chunks, the last one not full."""
        rows = 30011
        data = self.converted("case,y_mm,patch,note\n" + "".join(
            f"c{i},{i / 7!r},{i % 5},{'x' * (i % 3)}\n" for i in range(rows)))
        self.assert_same(data, self.read("t.csv"))
        self.assertEqual(data.sizes["record"], rows)
        self.assertEqual(data.y_mm.encoding["chunksizes"], (8192,))
        self.assertTrue(data.y_mm.encoding["zlib"])
        self.assertEqual(data.encoding["unlimited_dims"], {"record"})
        size = (self.folder / "t.nc").stat().st_size
        self.assertLess(size, (self.folder / "t.csv").stat().st_size / 3)

    def test_long_texts_take_fewer_rows_at_a_time(self):
        data = self.converted("case,choice\n" + "".join(
            f"c{i},{'x' * (60000 if i == 50 else i)}\n" for i in range(100)))
        self.assert_same(data, self.read("t.csv"))
        self.assertLess(data.choice.encoding["chunksizes"][0], 100)

    def test_no_rows(self):
        data = self.converted("case,pmax_MPa\n")
        self.assertEqual(data.sizes["record"], 0)
        self.assertEqual(data.pmax_MPa.attrs["units"], "MPa")

    def test_names_of_dimensions_leave_those_of_columns_alone(self):
        data = self.converted("record,length_of_case,case\n1,2,a\n3,4,b\n")
        self.assert_same(data, self.read("t.csv"))
        self.assertEqual(dict(data.sizes), {"record_": 2})

    def test_memory_does_not_grow_with_the_rows(self):
        peak = []
        for rows in (20000, 300000):
            self.write("t.csv", "case,y_mm,z_mm\n" + "".join(
                f"c{i},{i / 7!r},{i / 3!r}\n" for i in range(rows)))
            peak.append(self.peak_memory("netcdf", "t.csv", "-o", "t.nc"))
        # The longer table has 12 MB more.
        self.assertLess(peak[1] - peak[0], 6000, "kB")


class Refusals(Netcdf):
    def setUp(self):
        super().setUp()
        self.write("t.csv", "case,pmax_MPa\na,1\n")

    def refused_and_kept(self, *words, says):
        """Refused with one line; what is there stays, and nothing is left over."""
        before = {path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}
        self.refused(1, "netcdf", *words, says=says)
        self.assertEqual({path: path.read_bytes() for path in self.folder.rglob("*")
                          if path.is_file()}, before)

    def test_tables_that_are_none(self):
        (self.folder / "old.nc").write_bytes(b"kept")
        for text, says in (
            ("case,pmax_MPa\na,1\n\nb,2,3\n", ("a row must have 2 cells", "3", "(t.csv:4)")),
            ("case,pmax_MPa\na\n", ("a row must have 2 cells", "none for the column pmax_MPa",
                                    "(t.csv:2)")),
            ("case,case\na,1\n", ("column names must differ", "'case'", "(t.csv:1)")),
            ("", ("column names must be given", "(t.csv)")),
            ("case,a/b\na,1\n", ("a column must have a name that NetCDF takes", "'a/b'")),
            ("case,\na,1\n", ("a column must have a name that NetCDF takes", "''")),
            ('case,pmax_MPa\n"a,1\n', ("quotes must enclose", "(t.csv:2)")),
        ):
            self.write("t.csv", text)
            self.refused_and_kept("t.csv", "-o", "old.nc", says=says)

    def test_usage(self):
        self.refused(2, "netcdf", says=["missing TABLE.csv"])
        self.refused(2, "netcdf", "t.csv", says=["missing -o FILE.nc"])
        for name in ("t.txt", "t.NC", ".nc", "nc", "t.nc4", "-"):
            self.refused(2, "netcdf", "t.csv", "-o", name,
                         says=["-o must be a file that ends with .nc, got", f"'{name}'"])
        shutil.copy(self.folder / "t.csv", self.folder / "t.nc")
        self.refused(2, "netcdf", "t.nc", "-o", "t.nc", says=["must not be a file that is read"])

    def test_places_that_cannot_be_written(self):
        (self.folder / "folder.nc").mkdir()
        for name, why in (("folder.nc", "Is a directory"), ("/proc/t.nc", ""),
                          ("t.csv/t.nc", "Not a directory")):
            self.refused_and_kept("t.csv", "-o", name, says=["cannot write the file: " + name, why])
        (self.folder / "full.nc").symlink_to("/dev/full")
        self.refused_and_kept("t.csv", "-o", "full.nc",
                              says=["NetCDF must go to a file, got full.nc"])

    def test_a_folder_without_permission(self):
        why = other_user.why_not(PROGRAM)
        if why:
            self.skipTest(why)
        folder = self.folder / "closed"
        folder.mkdir()
        folder.chmod(0o555)
        self.folder.chmod(0o755)
        words = [other_user.runnable(PROGRAM), "netcdf", "t.csv", "-o", "closed/t.nc"]
        done = subprocess.run(words, cwd=self.folder, capture_output=True, encoding="utf-8",
                              user=other_user.without_rights(), check=False)
        self.assertEqual((done.returncode, done.stderr), (
            1, "faststrip: cannot write the file: closed/t.nc: Permission denied\n"))

    def test_what_cannot_be_read_twice(self):
        self.refused_and_kept("missing.csv", "-o", "t.nc", says=["no such file: missing.csv"])
        self.refused_and_kept(".", "-o", "t.nc", says=["a folder, not a file: ."])
        done = subprocess.run([PROGRAM, "netcdf", "/dev/stdin", "-o", "t.nc"], cwd=self.folder,
                              input="case\na\n", capture_output=True, encoding="utf-8", check=False)
        self.assertEqual((done.returncode, done.stderr), (
            1, "faststrip: must be a file, which can be read twice, got /dev/stdin\n"))

    def test_a_program_without_its_library(self):
        shutil.copy(PROGRAM, self.folder / "faststrip")
        self.program = self.folder / "faststrip"
        self.refused_and_kept("t.csv", "-o", "t.nc",
                              says=["cannot write NetCDF: ", "faststrip_netcdf.so"])

    def test_a_full_disk(self):
        """The library itself, called where files may have 50 kB: all that is written beyond fails,
        as it does where no space is left."""
        self.write("t.csv", "case,y_mm\n" + "".join(f"c{i},{i / 7!r}\n" for i in range(20000)))
        said = subprocess.run([sys.executable, "-c", f"""\
import ctypes
import resource

library = ctypes.CDLL({os.fspath(PLUGIN)!r})
said = ctypes.create_string_buffer(256)
tell = ctypes.CFUNCTYPE(None, ctypes.c_int, ctypes.c_int)(lambda rows, total: None)
resource.setrlimit(resource.RLIMIT_FSIZE, (50000, 50000))
code = library.faststrip_write_netcdf(b"t.csv", b"t.csv", b"t.tmp", b"t.nc", b"", 0, tell, said)
print(code, said.raw.decode().strip())
"""], cwd=self.folder, stdout=subprocess.PIPE, encoding="utf-8", check=False).stdout
        self.assertEqual(said, "122 cannot write the file: t.nc: File too large\n")
