"""`faststrip lookup`: tables are made as good as asked for, judged, read; damage is told."""

import math
import pathlib
import struct
import subprocess
import time
import zlib

import numpy as np
import xarray as xr

from cli_program import ROOT, ProgramTest, numbers, rows_of

MAKE = ("--error", "0.05", "--ab", "0.5:3", "--tests", "1000")
STATES = "a_mm,b_mm,N_N,mu,G_MPa,cksi,ceta,cphi_rad_per_mm"


class Lookup(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.made = None

    def table(self):
        """A small table, made once."""
        if Lookup.made is None:
            self.good("lookup", "make", "-o", "made.fslt", *MAKE)
            Lookup.made = (self.folder / "made.fslt").read_bytes()
        (self.folder / "table.fslt").write_bytes(Lookup.made)
        return "table.fslt"

    def good(self, *words):
        return self.succeed(*words).stdout

    def test_a_table_is_as_good_as_asked_for(self):
        table = self.table()
        self.good("lookup", "make", "-o", "again.fslt", *MAKE)
        self.assertEqual((self.folder / "again.fslt").read_bytes(), Lookup.made)
        text = self.good("lookup", "info", table)
        for words in ("method faststrip, 15 strips, 15 points", "nu 0.28", "a/b: ", "1000 fresh"):
            self.assertIn(words, text)
        rows = rows_of(self.good("lookup", "test", table, "--seed", "5", "--tests", "3000"))
        self.assertEqual(len(rows), 6)
        for row in rows:
            mean, high, worst = (float(row[name]) for name in ("mean", "percentile_99", "worst"))
            # Other contacts than it was made for.
            self.assertLess(high, 0.05)
            self.assertLess(mean, 0.006)
            self.assertTrue(0.0 < mean < high <= worst, row)
            self.assertGreater(float(row["lookup_us"]), 0.0)

    def test_other_methods(self):
        table = self.table()
        self.good("lookup", "make", "-o", "fastsim.fslt", "--axes-of", table, "--method", "fastsim",
                  "--strips", "10", "--points", "10", "--tests", "200")
        self.assertIn("method fastsim, 10 strips", self.good("lookup", "info", "fastsim.fslt"))
        rows = rows_of(self.good("lookup", "test", "fastsim.fslt", "--method", "fastsim",
                                 "--strips", "10", "--points", "10", "--tests", "300"))
        self.assertLess(max(numbers(rows, "mean")), 0.02)
        against = rows_of(self.good("lookup", "test", table, "--method", "tang", "--across", "16",
                                    "--tests", "20"))
        self.assertLess(max(numbers(against, "mean")), 0.02)
        by_auto = rows_of(self.good("lookup", "test", table, "--method", "auto", "--across", "16",
                                    "--tolerance", "0.05", "--tests", "20"))
        self.assertLess(max(numbers(by_auto, "mean")), 0.02)


    def test_auto_takes_tang_where_the_worst_error_asks_for_it(self):
        # Longitudinal creepage alone: the errors of Fy and Mz are next to nothing.
        self.write("states.csv", "a_mm,b_mm,N_N,mu,G_MPa,cksi,ceta,cphi_rad_per_mm\n" + "".join(
            f"6,4,80000,0.3,82000,{cksi},0,0\n" for cksi in (0.0005, 0.001, 0.002)))
        found = {}
        for method, *words in (("faststrip",), ("tang",), ("auto", "--tolerance", "0.0025")):
            self.good("lookup", "test", self.table(), "--states", "states.csv", "--contacts",
                      "c.csv", "--method", method, *words)
            found[method] = numbers(self.read("c.csv"), "Fx_N")
        self.assertNotIn(found["tang"][0], found["faststrip"])
        self.assertEqual(found["auto"], [found["faststrip"][0], *found["tang"][1:]])

    def test_parts_are_joined_and_ended_runs_gone_on_with(self):
        table = self.table()
        on_axes = ("lookup", "make", "--axes-of", table, "--tests", "500")
        self.good(*on_axes, "-o", "whole.fslt", "--threads", "1")
        whole = (self.folder / "whole.fslt").read_bytes()
        self.good(*on_axes, "-o", "threads.fslt", "--threads", "3")
        self.assertEqual((self.folder / "threads.fslt").read_bytes(), whole)
        parts = [f"part{k}.fslt" for k in (1, 2, 3)]
        for k, part in enumerate(parts):
            self.good(*on_axes, "-o", part, "--part", f"{k + 1}/3")
            self.refused(1, "lookup", "info", part, says=["not finite"])
        self.good("lookup", "join", *parts[::-1], "-o", "joined.fslt", "--tests", "500")
        self.assertEqual((self.folder / "joined.fslt").read_bytes(), whole)
        self.refused(1, "lookup", "join", *parts[1:], "-o", "x", says=["parts are missing"])
        for names, again in (((parts[0], *parts), parts[0]), ((*parts, parts[1]), parts[1]),
                             ((parts[0], "whole.fslt"), "whole.fslt"),
                             (("whole.fslt", "whole.fslt"), "whole.fslt")):
            self.refused(1, "lookup", "join", *names, "-o", "x",
                         says=["nothing that another one has", f"again in {again}"])
        self.refused(1, "lookup", "join", parts[0], table, "-o", "x", "--strips", "14",
                     says=["method faststrip, 14 strips"])
        # What a killed run leaves is a part that is not whole.
        unfinished = self.folder / "again.fslt.unfinished"
        unfinished.write_bytes((self.folder / parts[1]).read_bytes())
        self.good(*on_axes, "-o", "again.fslt", "--resume")
        self.assertEqual((self.folder / "again.fslt").read_bytes(), whole)
        self.assertFalse(unfinished.exists())
        unfinished.write_bytes((self.folder / parts[1]).read_bytes()[:-1])
        self.refused(1, *on_axes, "-o", "again.fslt", "--resume", says=["again.fslt.unfinished"])
        # Where nothing is left yet, all of it is made.
        self.good(*on_axes, "-o", "none.fslt", "--resume")
        self.assertEqual((self.folder / "none.fslt").read_bytes(), whole)
        unfinished.write_bytes((self.folder / parts[1]).read_bytes())
        self.refused(1, *on_axes, "-o", "again.fslt", "--resume", "--points", "14",
                     says=["the same nodes, method"])
        self.assertFalse((self.folder / "x").exists())
        self.good(*on_axes, "-o", "/dev/null")
        self.assertTrue(pathlib.Path("/dev/null").is_char_device())
        self.assertFalse(pathlib.Path("/dev/null.unfinished").exists())

    def test_a_table_is_not_where_work_is_kept(self):
        content = (self.folder / self.table()).read_bytes()
        place = self.folder / "q.fslt.unfinished"
        on_axes = ("lookup", "make", "--tests", "300", "-o", "q.fslt", "--axes-of")
        place.write_bytes(content)
        for name in ("q.fslt.unfinished", "./q.fslt.unfinished"):
            self.refused(2, *on_axes, name, says=["-o", "q.fslt.unfinished"])
        self.refused(1, *on_axes, "table.fslt", says=["q.fslt.unfinished"])
        self.refused(1, *on_axes, "table.fslt", "--resume", says=["q.fslt.unfinished"])
        self.assertEqual(place.read_bytes(), content)
        place.unlink()
        place.symlink_to("table.fslt")
        self.refused(2, *on_axes, "table.fslt", says=["q.fslt.unfinished"])
        place.unlink()
        place.write_text("somebody's\n")
        self.refused(1, *on_axes, "table.fslt", says=["q.fslt.unfinished"])
        self.assertEqual(place.read_text(), "somebody's\n")
        self.assertEqual((self.folder / "table.fslt").read_bytes(), content)

    def test_a_killed_run_loses_one_step_at_most(self):
        table = self.table()
        on_axes = ("lookup", "make", "--axes-of", table, "--tests", "500", "--strips", "60")
        self.good(*on_axes, "-o", "whole.fslt")
        for seconds in (0.3, 0.9):
            words = [str(self.program), *on_axes, "-o", "killed.fslt"]
            unfinished = self.folder / "killed.fslt.unfinished"
            if unfinished.exists():
                words.append("--resume")
            run = subprocess.Popen(words, cwd=self.folder, stdin=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
            deadline = time.monotonic() + 60.0
            before = unfinished.stat().st_mtime_ns if unfinished.exists() else 0
            # Until there is more than before, and a while longer.
            while time.monotonic() < deadline and run.poll() is None:
                if unfinished.exists() and unfinished.stat().st_mtime_ns > before:
                    break
                time.sleep(0.01)
            time.sleep(0.02 * seconds)
            run.kill()
            run.wait()
        resume = ("--resume",) if unfinished.exists() else ()
        self.good(*on_axes, "-o", "killed.fslt", *resume)
        self.assertEqual((self.folder / "killed.fslt").read_bytes(),
                         (self.folder / "whole.fslt").read_bytes())

    def test_states_get_their_forces(self):
        table = self.table()
        self.write("in.csv", f"name,{STATES}\nslow,5,4,8e4,0.3,82000,1e-6,0,0\n"
                             "fast,5,4,8e4,0.3,82000,1,0,0\nslender,50,4,8e4,0.3,82000,1e-3,0,0\n"
                             "word,5,4,8e4,x,82000,1e-3,0,0\n")
        done = self.run_program("lookup", "eval", table, "in.csv", "--order", "cubic", "--jacobian")
        self.assertEqual(done.returncode, 1)
        self.assertIn("row 3 (in.csv:4): a/b must be within the table", done.stderr)
        self.assertIn("2 of 4 states failed", done.stderr)
        rows = rows_of(done.stdout)
        self.assertEqual([row["status"] for row in rows],
                         ["ok", "ok", "out_of_range", "file_format"])
        self.assertEqual([row["name"] for row in rows], ["slow", "fast", "slender", "word"])
        self.assertEqual(rows[2]["Fx_N"] + rows[3]["Fx_N"], "")
        # Kalker's linear theory, C11 = 4.6 at a/b = 1.25; all slides.
        self.assertAlmostEqual(float(rows[0]["Fx_N"]) / (-82000 * 20 * 1e-6 * 4.6), 1.0, delta=0.05)
        self.assertAlmostEqual(float(rows[0]["Fx_N"]) / (1e-6 * float(rows[0]["dFx_dcksi"])), 1.0,
                               delta=0.001)
        self.assertAlmostEqual(float(rows[1]["Fx_N"]) / -24000.0, 1.0, delta=0.001)
        self.assertEqual(len(rows[0]), 1 + 8 + 4 + 24)

    def test_given_contacts_are_judged(self):
        table = self.table()
        self.write("in.csv", f"{STATES}\n5,4,8e4,0.3,82000,1e-3,0,1e-4\n"
                             "4,5,8e4,0.3,82000,0,1e-2,0\n")
        rows = rows_of(self.good("lookup", "test", table, "--states", "in.csv", "--contacts",
                                 "out.csv"))
        contacts = self.read("out.csv")
        self.assertEqual(numbers(contacts, "cksi"), [1e-3, 0.0])
        for order in ("linear", "cubic"):
            off = [abs(float(row["Fx_N"]) - float(row[f"Fx_{order}_N"])) / 2.4e4
                   for row in contacts]
            said = next(row for row in rows if (row["order"], row["force"]) == (order, "Fx"))
            self.assertAlmostEqual(float(said["worst"]), max(off), delta=1e-12)
            self.assertAlmostEqual(float(said["mean"]), sum(off) / 2, delta=1e-12)
        self.refused(2, "lookup", "test", table, "--states", "in.csv", "--seed", "3",
                     says=["--states"])
        self.write("none.csv", STATES + "\n")
        self.refused(1, "lookup", "test", table, "--states", "none.csv", says=["no states"])
        self.write("bad.csv", STATES + "\n5,4,8e4,0.3,82000,1e-3,0,x\n")
        self.refused(1, "lookup", "test", table, "--states", "bad.csv", says=["bad.csv:2"])
        self.write("far.csv", STATES + "\n50,4,8e4,0.3,82000,1e-3,0,0\n")
        self.refused(1, "lookup", "test", table, "--states", "far.csv", says=["a/b must be"])

    def test_damaged_tables_are_told(self):
        content = bytearray((self.folder / self.table()).read_bytes())
        for at, says in ((0, "does not begin as one"), (12, "version 1, got"), (20, "header"),
                         (100, "checksum"), (len(content) // 2, "checksum"),
                         (len(content) - 1, "checksum")):
            bad = bytearray(content)
            bad[at] ^= 4
            (self.folder / "bad.fslt").write_bytes(bad)
            for words in (("info",), ("test",)):
                self.refused(1, "lookup", *words, "bad.fslt", says=[says, "(bad.fslt)"])
        for length in (0, 7, 39, 100, len(content) - 1):
            (self.folder / "bad.fslt").write_bytes(content[:length])
            self.refused(1, "lookup", "info", "bad.fslt", says=["lookup table", "(bad.fslt)"])
        huge = bytearray(content)
        struct.pack_into("<i", huge, 20, 2**31 - 1)
        struct.pack_into("<I", huge, len(huge) - 4, zlib.crc32(huge[:-4]))
        (self.folder / "bad.fslt").write_bytes(huge)
        self.refused(1, "lookup", "info", "bad.fslt", says=["header"])
        self.refused(1, "lookup", "info", "none.fslt", says=["none.fslt"])
        self.refused(1, "lookup", "info", ".", says=["folder"])

    def test_the_layout_is_that_of_the_document(self):
        content = (self.folder / self.table()).read_bytes()
        self.assertEqual(content[:8], b"FSLT\r\n\x1a\n")
        mark, version, kind, n_q, n_ratio, n_shape, n_parameters, n_text = struct.unpack_from(
            "<8i", content, 8)
        self.assertEqual((mark, version, kind, n_parameters), (0x01020304, 1, 1, 21))
        doubles = n_parameters + n_q + n_ratio + 4 * n_shape
        values = 3 * n_q * n_ratio**2 * 6 * n_shape
        self.assertEqual(len(content), 40 + 8 * doubles + 4 * values + n_text + 4)
        self.assertEqual(struct.unpack_from("<I", content, len(content) - 4)[0],
                         zlib.crc32(content[:-4]))
        numbers_ = struct.unpack_from(f"<{doubles}d", content, 40)
        self.assertEqual(numbers_[0], 0.28)
        self.assertEqual(numbers_[n_parameters], 0.0)
        self.assertAlmostEqual(math.exp(numbers_[n_parameters + n_q + n_ratio]), 0.5)
        layout = (ROOT / "docs" / "formats.md").read_text(encoding="utf-8")
        self.assertIn("## Lookup tables", layout)

    def test_netcdf_gives_the_table_back(self):
        self.good("lookup", "export", self.table(), "-o", "table.nc")
        data = xr.load_dataset(self.folder / "table.nc", engine="h5netcdf")
        content = Lookup.made
        n_q, n_ratio, n_shape = struct.unpack_from("<3i", content, 20)
        doubles = np.frombuffer(content, "<f8", 21 + n_q + n_ratio + 4 * n_shape, 40)
        np.testing.assert_array_equal(data.error.values.ravel(), doubles[3:21])
        np.testing.assert_array_equal(data.q.values, doubles[21:21 + n_q])
        shapes = 21 + n_q + n_ratio
        np.testing.assert_array_equal(data.ratio_2.values, doubles[21 + n_q:shapes])
        np.testing.assert_allclose(data.a_over_b.values,
                                   np.exp(doubles[shapes:shapes + n_shape]), rtol=1e-14)
        np.testing.assert_array_equal(data.scale.values.ravel(), doubles[shapes + n_shape:])
        self.assertEqual(data.phi.shape, (n_shape, 6, n_ratio, n_ratio, n_q, 3))
        np.testing.assert_array_equal(
            data.phi.values.ravel(),
            np.frombuffer(content, "<f4", data.phi.size, 40 + 8 * len(doubles)))
        self.assertEqual((data.Conventions, data.poisson_ratio, data.error.tested),
                         ("CF-1.8", 0.28, 1000))

    def test_wrong_calls(self):
        self.write("in.csv", STATES.replace("mu", "my") + "\n")
        self.write("twice.csv", STATES + ",Fx_N\n5,4,1,1,1,0,0,0,0\n")
        table = self.table()
        for words, says in (
            ((), "make, wheel, join, info, test, eval or export"),
            (("frobnicate",), "got frobnicate"),
            (("make",), "-o TABLE.fslt"),
            (("make", "-o", "-"), "-o TABLE.fslt"),
            (("make", "-o", "x", "--ab", "3:1"), "'3:1'"),
            (("make", "-o", "x", "--ab", "1"), "'1'"),
            (("make", "-o", "x", "--error", "0"), "'0'"),
            (("make", "-o", "x", "--nu", "0.6"), "'0.6'"),
            (("make", "-o", "x", "--method", "magic"), "'magic'"),
            (("make", "-o", "x", "--tolerance", "0.1"), "--method auto"),
            (("make", "-o", table, "--axes-of", table), table),
            (("make", "-o", "x", "--axes-of", table, "--error", "0.1"), "--axes-of"),
            (("make", "-o", "x", "--part", "1/2"), "--axes-of"),
            (("make", "-o", "x", "--axes-of", table, "--part", "3/2"), "'3/2'"),
            (("make", "-o", "x", "--axes-of", table, "--part", "2"), "'2'"),
            (("make", "-o", "x", "--threads", "0"), "'0'"),
            (("join", table), "-o TABLE.fslt"),
            (("test", table, "--tests", "0"), "'0'"),
            (("make", "-o", "x", "--tests", "298"), "from 299"),
            (("eval", table), "STATES.csv"),
            (("eval", table, "in.csv", "--order", "2"), "'2'"),
        ):
            self.refused(2, "lookup", *words, says=[says])
        self.refused(1, "lookup", "eval", table, "in.csv", says=["missing column: mu"])
        self.refused(1, "lookup", "eval", table, "twice.csv", says=["Fx_N"])
        self.refused(1, "lookup", "make", "-o", "/dev/null/x.fslt", *MAKE,
                     says=["/dev/null/x.fslt"])
        self.refused(3, "lookup", "make", "-o", "x", "--error", "1e-9", "--ab", "1:1.1",
                     "--tests", "299", says=["nodes"])
        self.assertFalse((self.folder / "x").exists())

    def test_help(self):
        text = self.good("lookup", "--help")
        for action in ("make", "wheel", "join", "info", "test", "eval", "export"):
            self.assertIn(f"\n  {action} ", text)
            about = self.good("lookup", action, "--help")
            self.assertTrue(about.startswith(f"usage: faststrip lookup {action} "))
            for line in about.splitlines():
                self.assertLessEqual(len(line), 100)
