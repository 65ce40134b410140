"""`faststrip lookup wheel`: the table of a wheel on a rail, with two contacts at some places."""

import math
import re
import struct
import subprocess
import zlib

import cf_units
import numpy as np
import xarray as xr

from cli_program import ROOT, ProgramTest, numbers, rows_of

PROMISED = 0.2
MAKE = ("--error", str(PROMISED), "--y", "6:9.5", "--tests", "2000", "--least-step", "0.02")
STATES = "y_mm,yaw_rad,load_N,mu,cksi,ceta,cphi_rad_per_mm,slot"
CASE = "&wheel\n profile = 'cone.csv'\n/\n&rail\n profile = '60e1'\n/\n&material\n mu = 0.3\n/\n"
# Names of a contact's numbers in NetCDF, their units, and by which power of N, in thirds, the table
# has them divided.
NUMBERS = (("normal_force", "N", 0), ("contact_angle", "rad", 0), ("y_rail", "mm", 0),
           ("z_rail", "mm", 0), ("x_track", "mm", 0), ("y_wheel", "mm", 0),
           ("rolling_radius", "mm", 0), ("z_wheelset", "mm", 0), ("area", "mm2", 2),
           ("pmax", "MPa", 1), ("c", "mm", 1), ("l1", "mm2", 2), ("l2", "mm2", 2), ("l3", "mm3", 3))
ERRORS = ("Fx", "Fy", "Mz", "N_y", "z")


def cone():
    """A conical tread with a narrow root: tread and flange touch at once."""
    start, end, r, y0 = math.atan(1 / 40), math.radians(70), 9.0, -30.0
    y_arc, z_arc = y0 + r * math.sin(start), -y0 / 40 + r * math.cos(start)
    arc = [(y_arc - r * math.sin(t), z_arc - r * math.cos(t))
           for t in (start + (end - start) * k / 60 for k in range(60, -1, -1))]
    flange = [(arc[0][0] - d * math.cos(end), arc[0][1] + d * math.sin(end))
              for d in (0.5 * k for k in range(24, 0, -1))]
    tread = [(y0 + 0.5 * k, -(y0 + 0.5 * k) / 40) for k in range(1, 181)]
    return "y_mm,z_mm\n" + "".join(f"{y:.9f},{z:.9f}\n" for y, z in flange + arc + tread)


class LookupWheel(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.made = cls.said = cls.whole_made = None

    def setUp(self):
        super().setUp()
        self.write("cone.csv", cone())
        self.write("cone.nml", CASE)

    def table(self):
        """A small table, made once."""
        if LookupWheel.made is None:
            done = self.succeed("lookup", "wheel", "cone.nml", "-o", "made.fslt", *MAKE)
            LookupWheel.said = done.stderr
            LookupWheel.made = (self.folder / "made.fslt").read_bytes()
        (self.folder / "table.fslt").write_bytes(LookupWheel.made)
        return "table.fslt"

    def on_axes(self):
        """Words that make a table on the axes of that one."""
        return "lookup", "wheel", "cone.nml", "--axes-of", self.table(), "--tests", "100"

    def whole(self):
        """The bytes of a table on the axes of that one, made at once by one thread, once."""
        if LookupWheel.whole_made is None:
            self.good(*self.on_axes(), "-o", "whole.fslt", "--threads", "1")
            LookupWheel.whole_made = (self.folder / "whole.fslt").read_bytes()
        return LookupWheel.whole_made

    def slot_at(self, y):
        """The contact that carries most."""
        self.write("slots.csv", STATES + "".join(f"\n{y},0,7e4,0.3,0,0,0,{slot}"
                                                 for slot in (1, 2)) + "\n")
        rows = rows_of(self.good("lookup", "eval", self.table(), "slots.csv"))
        return max((1, 2), key=lambda slot: float(rows[slot - 1]["N_N"]))

    def good(self, *words):
        return self.succeed(*words).stdout

    def test_a_table_says_what_it_is(self):
        text = self.good("lookup", "info", self.table())
        for words in ("right wheel cone.csv on rail 60e1", "method faststrip, 15 strips",
                      "a wheel on a rail, nu 0.28", "slot 1: ", "slot 2: ", "on 2000 fresh states",
                      "fresh states where contacts come or go"):
            self.assertIn(words, text)
        self.assertNotIn("slot 3", text)

    def test_errors_are_fractions(self):
        for words in (("make",), ("wheel", "cone.nml")):
            for text in ("0.5", "0.201", "1", "0"):
                self.refused(2, "lookup", *words, "-o", "x.fslt", "--error", text,
                             says=["--error", "a fraction of mu N above 0 to 0.2",
                                   "0.005 for half a per cent", f"'{text}'"])
            self.assertIn("a fraction of mu N", self.good("lookup", words[0], "--help"))
        self.assertIn("99th percentile of 0.200000 of mu N", self.good("lookup", "info",
                                                                       self.table()))

    def test_an_older_table_has_no_errors_of_z(self):
        self.table()
        content = LookupWheel.made
        head = list(struct.unpack_from("<12i", content, 8))
        about = np.frombuffer(content, "<f8", head[6], 56)
        errors = about[5:].reshape(2, 2, 3, 5)[..., :4]
        older = content[:8] + struct.pack("<12i", *head[:6], 53, *head[7:]) + about[:5].tobytes() \
            + errors.tobytes() + content[56 + 8 * head[6]:-4]
        (self.folder / "older.fslt").write_bytes(older + struct.pack("<I", zlib.crc32(older)))
        text = self.good("lookup", "info", "older.fslt")
        self.assertIn("an older table: errors of z are not known", text)
        self.assertIn("cubic  N_y", text)
        self.assertNotIn("cubic  z", text)
        rows = rows_of(self.good("lookup", "test", "older.fslt", "--case", "cone.nml", "--tests",
                                 "20"))
        self.assertEqual({row["error"] for row in rows}, {*ERRORS})
        self.good("lookup", "export", "older.fslt", "-o", "older.nc")
        self.assertEqual(xr.load_dataset(self.folder / "older.nc", engine="h5netcdf").error.shape,
                         (2, 2, 3, 4))

    def test_z_out_of_place_is_found(self):
        self.table()
        content = bytearray(LookupWheel.made[:-4])
        head = struct.unpack_from("<12i", content, 8)
        first = 56 + 8 * (head[6] + sum(head[3:6]) + head[8] + head[9])
        places = np.frombuffer(content, "<f8", 14 * head[5] * head[9] * head[10], first).reshape(
            head[9], head[5], head[10], 14).copy()
        # Every other node of y by 5 um: contacts and creep forces stay.
        places[:, ::2, :, 7] += 5e-3
        content[first:first + places.nbytes] = places.tobytes()
        (self.folder / "moved.fslt").write_bytes(content + struct.pack("<I", zlib.crc32(content)))
        test = "--case", "cone.nml", "--tests", "100"
        means = {name: [float(row["mean"]) for row in rows_of(self.good(
            "lookup", "test", name, *test)) if row["error"] == "z" and row["states"] == "all"]
            for name in ("moved.fslt", self.table())}
        self.assertLess(max(means["table.fslt"]), 0.006)
        self.assertGreater(min(means["moved.fslt"]), 0.02)

    def test_no_cell_is_halved_below_the_least(self):
        # Thirteen nodes to begin with: cells of 0.29 mm, which would have to be halved.
        done = self.run_program("lookup", "wheel", "cone.nml", "-o", "few.fslt", "--error", "0.2",
                                "--y", "6:9.5", "--tests", "299", "--least-step", "0.2", "--load",
                                "65000:80000", "--strips", "5", "--points", "5")
        self.assertEqual(done.returncode, 3)
        self.assertIn("the error asked for was not met: 0.200000, got ", done.stderr)
        self.assertEqual(set(re.findall(r" y (\d+),", done.stderr)), {"13"})
        self.assertFalse((self.folder / "few.fslt").exists())
        fine = self.good("lookup", "info", self.table())
        self.assertGreaterEqual(float(re.search(r"shortest cell of y: (\S+) mm", fine)[1]), 0.01999)

    def test_limitations_of_the_contacts_are_told(self):
        self.assertNotIn("limitations", self.good("lookup", "info", self.table()))
        self.write("steep.nml", CASE.replace("cone.csv", "s1002"))
        self.good("lookup", "wheel", "steep.nml", "-o", "steep.fslt", "--error", "0.2", "--y",
                  "5:7", "--tests", "299")
        text = self.good("lookup", "info", "steep.fslt")
        told, of, words = re.search(r"^limitations of (\d+) of (\d+) contacts: (.+)$", text,
                                    re.MULTILINE).groups()
        # A yawed one may miss auto's target, too.
        counts = {word: int(count) for word, count in re.findall(r"(\w+) (\d+)", words)}
        self.assertEqual(sum(counts.values()), int(told))
        self.assertGreater(counts.pop("conformal"), counts.pop("target_missed", 0))
        self.assertEqual(counts, {})
        self.assertIn(f", {of} contacts, ", text)
        self.assertTrue(0 < int(told) < int(of))

    def test_a_table_is_as_good_as_asked_for(self):
        table = self.table()
        rows = rows_of(self.good("lookup", "test", table, "--case", "cone.nml", "--tests", "400",
                                 "--seed", "7", "--contacts", "states.csv"))
        self.assertEqual([row["error"] for row in rows], [*ERRORS] * 4)
        for row in rows:
            mean, high, worst = (float(row[name]) for name in ("mean", "percentile_99", "worst"))
            self.assertTrue(0.0 < mean <= high <= worst, row)
            # Other states than it was made for.
            if row["order"] == "cubic":
                self.assertLess(high, PROMISED)
            if row["error"] == "z" and row["states"] == "all":
                self.assertLess(mean, 0.006)
            if row["states"] == "all":
                self.assertLess(mean, 0.02)
            self.assertGreater(float(row["lookup_us"]), 0.0)
        # What the errors are taken of is in the file.
        states = self.read("states.csv")
        fresh = states[:400]
        self.assertEqual({row["contacts"] for row in states}, {"1", "2"})
        self.assertTrue(all(row["change"] == "1" for row in states[400:]))
        self.assertEqual(len(states), 800)
        off = [abs(float(row["Fx_N"]) - float(row["Fx_linear"])) for row in fresh]
        self.assertGreater(max(off), 0.0)
        # z by the load that it makes: over 0.05 mm on the tread, some 0.5 mm on the steep flange.
        miss = [abs(float(row["z_mm"]) - float(row["z_cubic"])) for row in fresh]
        told = float(rows[9]["mean"])
        self.assertTrue(0.05 < sum(miss) / len(miss) / told < 0.5, (sum(miss), told))
        lateral = [abs(float(row["N_y_N"]) - float(row["N_y_cubic"])) for row in fresh]
        self.assertLess(sum(lateral), 0.05 * sum(abs(float(row["N_y_N"])) for row in fresh))

    def test_contacts_are_those_of_the_wheelset(self):
        self.write("states.csv",
                   "case,side,y_mm,roll_rad,yaw_rad,speed_mm_s,pitch_rate_rad_s,Fz_N\n"
                   "tread,right,7,0,0,20000,-43.47826086956522,80000\n"
                   "flange,right,9.3,0,0,20000,-43.47826086956522,80000\n")
        solved = rows_of(self.good("wheelset", "cone.nml", "--states", "states.csv"))
        self.write("in.csv", STATES + "".join(
            f"\n{y},0,80000,0.3,{row['cksi']},{row['ceta']},{row['cphi_rad_per_mm']},{slot}"
            for y, row in zip((7, 9.3), solved) for slot in (1, 2)) + "\n")
        found = [row for row in rows_of(self.good("lookup", "eval", self.table(), "in.csv"))
                 if float(row["N_N"]) > 0.0]
        self.assertEqual([row["y_mm"] for row in found], ["7", "9.3"])
        self.assertNotEqual(found[0]["slot"], found[1]["slot"])
        for here, there in zip(found, solved):
            angle = float(here["contact_angle_rad"])
            self.assertAlmostEqual(angle, float(there["contact_angle_rad"]), delta=0.02)
            # The vertical force of the table is that of the normal forces alone.
            self.assertAlmostEqual(float(here["N_N"]) * math.cos(angle), 8e4, delta=400.0)
            self.assertAlmostEqual(float(here["radius_mm"]), float(there["radius_mm"]),
                                   delta=0.5)
            self.assertAlmostEqual(float(here["Fx_N"]) / float(here["N_N"]),
                                   float(there["Fx_N"]) / float(there["N_N"]), delta=0.03)

    def test_jacobian_is_that_of_the_forces(self):
        table = self.table()
        steps = {"y": ("y_mm", 1e-5), "load": ("load_N", 1e-1), "mu": ("mu", 1e-6),
                 "cksi": ("cksi", 1e-9), "cphi": ("cphi_rad_per_mm", 1e-11)}
        at = {"y_mm": 7.321, "yaw_rad": 0.0, "load_N": 7.1e4, "mu": 0.31, "cksi": 3e-4,
              "ceta": -5e-4, "cphi_rad_per_mm": 2e-5, "slot": self.slot_at(7.321)}
        lines = [at]
        for name, step in steps.values():
            lines += [{**at, name: at[name] + step}, {**at, name: at[name] - step}]
        self.write("in.csv", STATES + "\n" + "".join(
            ",".join(repr(line[name]) for name in STATES.split(",")) + "\n" for line in lines))
        for order in ("linear", "cubic"):
            rows = rows_of(self.good("lookup", "eval", table, "in.csv", "--jacobian", "--order",
                                     order))
            self.assertGreater(float(rows[0]["N_N"]), 1e4)
            for i, (name, (_, step)) in enumerate(steps.items()):
                for force in ("Fx_N", "Fy_N", "Mz_Nmm"):
                    more, less = (float(row[force]) for row in rows[1 + 2 * i:3 + 2 * i])
                    slope = float(rows[0][f"d{force[:2]}_d{name}"])
                    self.assertAlmostEqual((more - less) / (2 * step), slope,
                                           delta=1e-4 * abs(slope) + 1e-3, msg=(name, force))

    def test_parts_are_joined_and_ended_runs_gone_on_with(self):
        on_axes = self.on_axes()
        whole = self.whole()
        self.good(*on_axes, "-o", "threads.fslt", "--threads", "3")
        self.assertEqual((self.folder / "threads.fslt").read_bytes(), whole)
        for k in (1, 2):
            self.good(*on_axes, "-o", f"part{k}.fslt", "--part", f"{k}/2")
            self.refused(1, "lookup", "info", f"part{k}.fslt", says=["not finite"])
        self.good("lookup", "join", "part2.fslt", "part1.fslt", "-o", "joined.fslt", "--case",
                  "cone.nml", "--tests", "100")
        self.assertEqual((self.folder / "joined.fslt").read_bytes(), whole)
        self.refused(1, "lookup", "join", "part1.fslt", "-o", "x", says=["parts are missing"])
        self.refused(2, "lookup", "join", "part1.fslt", "part2.fslt", "-o", "x", says=["--case"])
        unfinished = self.folder / "again.fslt.unfinished"
        unfinished.write_bytes((self.folder / "part2.fslt").read_bytes())
        self.good(*on_axes, "-o", "again.fslt", "--resume")
        self.assertEqual((self.folder / "again.fslt").read_bytes(), whole)
        self.assertFalse(unfinished.exists())
        unfinished.write_bytes((self.folder / "part2.fslt").read_bytes())
        self.refused(1, *on_axes, "-o", "again.fslt", "--resume", "--points", "14",
                     says=["the same nodes, method"])

    def test_a_killed_run_leaves_what_it_has(self):
        on_axes = self.on_axes()
        words = [str(self.program), *on_axes, "-o", "killed.fslt"]
        unfinished = self.folder / "killed.fslt.unfinished"
        run = subprocess.Popen(words, cwd=self.folder, stdin=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
        while run.poll() is None and not unfinished.exists():
            try:
                run.wait(0.01)
            except subprocess.TimeoutExpired:
                pass
        run.kill()
        run.wait()
        self.assertTrue(unfinished.exists())
        self.good(*on_axes, "-o", "killed.fslt", "--resume")
        self.assertEqual((self.folder / "killed.fslt").read_bytes(), self.whole())

    def test_the_layout_is_that_of_the_document(self):
        self.table()
        content = LookupWheel.made
        self.assertEqual(content[:8], b"FSLT\r\n\x1a\n")
        head = struct.unpack_from("<12i", content, 8)
        mark, version, kind, n_q, n_ratio, n_y, n_numbers, n_text, n_yaw, n_load, slots, sets = head
        self.assertEqual((mark, version, kind, n_numbers, n_yaw, slots),
                         (0x01020304, 1, 2, 65, 1, 2))
        places = n_y * n_yaw * n_load * slots
        doubles = n_numbers + n_q + n_ratio + n_y + n_yaw + n_load + 14 * places
        values = 2 * 3 * 6 * n_q * n_ratio**2 * sets
        self.assertEqual(len(content), 56 + 8 * doubles + 4 * (places + values) + n_text + 4)
        self.assertEqual(struct.unpack_from("<I", content, len(content) - 4)[0],
                         zlib.crc32(content[:-4]))
        nu, shear, promised, tested, _ = struct.unpack_from("<5d", content, 56)
        self.assertEqual((nu, promised, tested), (0.28, PROMISED, 2000.0))
        self.assertAlmostEqual(shear, 82000.0)
        y = struct.unpack_from(f"<{n_y}d", content, 56 + 8 * (n_numbers + n_q + n_ratio))
        self.assertEqual((y[0], y[-1]), (6.0, 9.5))
        # Judged by what the 99th percentiles do not exceed at 95 %, not by those that were drawn.
        errors = np.frombuffer(content, "<f8", 60, 56 + 40).reshape(2, 2, 3, len(ERRORS))
        bounds = re.findall(r"99 % (\S+), where contacts come or go (\S+)", LookupWheel.said)[-1]
        for bound, (_, high, worst) in zip(bounds, errors[:, 1].max(axis=-1)):
            self.assertTrue(high < float(bound) < worst, (bound, high, worst))

    def test_netcdf_gives_the_table_back(self):
        self.good("lookup", "export", self.table(), "-o", "table.nc")
        data = xr.load_dataset(self.folder / "table.nc", engine="h5netcdf", mask_and_scale=False)
        content = LookupWheel.made
        n_q, n_ratio, n_y, n_numbers, _, n_yaw, n_load, slots, sets = struct.unpack_from(
            "<9i", content, 20)
        doubles = np.frombuffer(content, "<f8", n_numbers + n_q + n_ratio + n_y + n_yaw + n_load,
                                56)
        at = n_numbers
        for name, n in (("q", n_q), ("ratio_1", n_ratio), ("y", n_y), ("yaw", n_yaw),
                        ("load", n_load)):
            np.testing.assert_array_equal(data[name].values, doubles[at:at + n])
            at += n
        np.testing.assert_array_equal(data.error.values.ravel(), doubles[5:n_numbers])
        places = (n_load, n_yaw, n_y, slots)
        contacts = np.frombuffer(content, "<f8", 14 * math.prod(places), 56 + 8 * at).reshape(
            *places, 14)
        load = contacts[..., 0]
        there = load > 0
        for k, (name, unit, thirds) in enumerate(NUMBERS):
            self.assertEqual(cf_units.Unit(data[name].units), cf_units.Unit(unit))
            self.assertTrue(data[name].long_name)
            np.testing.assert_allclose(data[name].values[there],
                                       (contacts[..., k] * load**(thirds / 3))[there], rtol=1e-14)
            self.assertTrue((data[name].values[~there] == data[name].attrs["_FillValue"]).all())
        at = 56 + 8 * (at + contacts.size)
        np.testing.assert_array_equal(data.contact_of.values.ravel(),
                                      np.frombuffer(content, "<i4", math.prod(places), at))
        at += 4 * math.prod(places)
        self.assertEqual(data.phi.shape, (sets, 2, 6, n_ratio, n_ratio, n_q, 3))
        np.testing.assert_array_equal(data.phi.values.ravel(),
                                      np.frombuffer(content, "<f4", data.phi.size, at))
        self.assertEqual((data.Conventions, data.poisson_ratio, data.promised_error),
                         ("CF-1.8", 0.28, PROMISED))
        self.assertIn("right wheel cone.csv on rail 60e1", data.source)
        self.refused(2, "lookup", "export", "table.fslt", "-o", "x.csv", says=["'x.csv'"])
        self.refused(2, "lookup", "export", "table.fslt", says=["-o FILE.nc"])
        self.refused(1, "lookup", "export", "cone.csv", "-o", "x.nc", says=["cone.csv"])
        self.refused(1, "lookup", "export", "table.fslt", "-o", "/dev/null/x.nc",
                     says=["/dev/null/x.nc"])
        self.assertFalse((self.folder / "x.nc").exists())

    def test_wrong_calls(self):
        table = self.table()
        self.write("falling.nml", CASE + "&friction\n kind = 'linear'\n mu_kinetic = 0.1\n"
                   " half_slip_speed_mm_s = 100\n/\n")
        self.write("state.nml", CASE + "&state\n y_mm = 1, yaw_rad = 0, speed_mm_s = 1\n"
                   " Fz_N = 1e4, side = 'right'\n/\n")
        self.write("in.csv", STATES + "\n0,0,8e4,0.3,0,0,0,1\n7,0,8e4,0.3,0,0,0,9\n"
                   "7,0,8e4,0.3,1e-3,0,0,1\n7,0,8e4,0.3,0,0,0,1.5\n7,0.01,8e4,0.3,0,0,0,1\n")
        wheel = ("wheel", "cone.nml", "-o", "x")
        for words, says in (
            (("wheel", "cone.nml"), "-o TABLE.fslt"), (("wheel", "-o", "x"), "CASE.nml"),
            ((*wheel, "--y", "3:1"), "'3:1'"), ((*wheel, "--y", "3"), "'3'"),
            ((*wheel, "--load", "0:1"), "'0:1'"), ((*wheel, "--yaw", "0.1:0"), "'0.1:0'"),
            ((*wheel, "--method", "fastsim"), "'fastsim'"),
            ((*wheel, "--part", "1/2"), "--axes-of"),
            ((*wheel, "--axes-of", table, "--error", "0.1"), "--axes-of"),
            (("test", table, "--states", "in.csv", "--case", "cone.nml"), "--states"),
        ):
            self.refused(2, "lookup", *words, says=[says])
        self.refused(1, "lookup", "test", table, says=["--case"])
        self.refused(1, "lookup", "make", "-o", "x", "--axes-of", table, says=["ellipses", table])
        self.refused(1, "lookup", "wheel", "falling.nml", "-o", "x", says=["Coulomb"])
        self.refused(1, "lookup", "wheel", "state.nml", "-o", "x", says=["&state"])
        # A wheel that is beside its rail.
        self.refused(1, "lookup", *wheel, "--y", "80:90", says=["y 80"])
        done = self.run_program("lookup", "eval", table, "in.csv")
        self.assertEqual(done.returncode, 1)
        self.assertIn("row 1 (in.csv:2): y must be within the table", done.stderr)
        self.assertEqual([row["status"] for row in rows_of(done.stdout)],
                         ["out_of_range", "bad_argument", "ok", "bad_argument", "out_of_range"])
        self.assertIn("slot must be a whole number from 1 to 6, got 1.5", done.stderr)
        self.assertIn("yaw must be within the table", done.stderr)
        self.assertFalse((self.folder / "x").exists())
        self.assertIn("## Lookup tables", (ROOT / "docs" / "formats.md").read_text("utf-8"))
        self.assertEqual(numbers(rows_of(done.stdout), "slot"), [1.0, 9.0, 1.0, 1.5, 1.0])
