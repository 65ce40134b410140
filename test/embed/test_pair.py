"""A wheel on a rail in one line of Python: contact, sweep and creep map, against the program and
against loops of `Contact`; their pictures, their tables, what they refuse."""

import csv
import dataclasses
import importlib
import inspect
import math

from installed import ROOT, HostTest

CASES = ROOT / "example" / "cases"
# Python's name of a column of the program.
GIVEN = "'given', cksi = 0.001, ceta = -0.0005, cphi_rad_per_mm = 0.0001"
FORMULA = "'formula'"
COLUMNS = {"N_N": "load", "gamma_rad": "contact_angle", "cksi": "cksi", "ceta": "ceta",
           "cphi_rad_per_mm": "cphi", "status": "word", "penetration_mm": "penetration",
           "area_mm2": "area", "pmax_MPa": "pmax", "ymin_mm": "y_min", "Fx_N": "fx", "Fy_N": "fy",
           "Mz_Nmm": "mz", "friction_power_N": "friction_power", "est_err_Fx": "est_err_fx"}
CASE = """
&contact load_N = 80000.0, load_direction = '{direction}', shift_mm = {y} /
&wheel profile = '{wheel}', radius_mm = {radius} /
&rail profile = '{rail}', inclination = {inclination} /
&material mu = {mu} /
&motion creepage = {by} /
&numerics strips_per_patch = {strips} /
"""


class Pair(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        importlib.import_module("matplotlib").use("Agg")
        cls.faststrip, cls.np = cls.import_package(), importlib.import_module("numpy")
        cls.worn = str(CASES / "worn_wheel.txt"), str(CASES / "worn_rail.ban")

    def program(self, **case):
        self.write("case.nml", CASE.format(**case))
        self.shell(f"'{self.installed.prefix}/bin/faststrip' contact case.nml -o case.csv")
        text = (self.folder / "case.csv").read_text(encoding="utf-8")
        row, = csv.DictReader(line for line in text.splitlines() if not line.startswith("#"))
        return row

    def test_rollers_with_creepages(self):
        row = self.program(y=2.0, wheel="s1002", rail="60e1", mu=0.3, radius=460.0, by=GIVEN,
                           inclination="0.025, roller_radius_mm = 500.0", direction="normal",
                           strips=15)
        rig = {"load": 8e4, "roller_radius": 500.0}
        found = self.faststrip.contact("s1002", "60e1", 2.0, creepage=(1e-3, -5e-4, 1e-4), **rig)
        self.assertEqual(found.fx, float(row["Fx_N"]))
        self.assertEqual(found.area, float(row["area_mm2"]))
        on_rail = self.faststrip.contact("s1002", "60e1", 2.0, load=8e4, creepage=(1e-3, -5e-4, 0))
        self.assertLess(found.area, 0.95 * on_rail.area)
        there = self.faststrip.creep_map("s1002", "60e1", 2.0, longitudinal=[1e-3], lateral=-5e-4,
                                         spin=1e-4, **rig)
        self.assertAlmostEqual(there.fx[0], found.fx, delta=1e-3)
        words = "all creepages must be given with a roller_radius"
        with self.assertRaisesRegex(self.faststrip.FaststripError, words):
            self.faststrip.contact("s1002", "60e1", 2.0, **rig)
        with self.assertRaisesRegex(self.faststrip.FaststripError, words):
            self.faststrip.creep_map("s1002", "60e1", 2.0, longitudinal=[1e-3], **rig)

    def test_the_program_has_the_same_contact(self):
        for y, wheel, rail, inclination, radius, mu, by, direction, strips in (
                (3.0, "s1002", "60e1", 0.025, 460.0, 0.3, FORMULA, "vertical", 15),
                (-2.5, "S1002", "uic60", 0.05, 500.0, 0.4, FORMULA, "normal", 9),
                (6.5, "s1002", "54e1", 0.025, 460.0, 0.3, GIVEN, "vertical", 15),
                (1.5, self.worn[0], self.worn[1], 0.0, 430.0, 0.35, FORMULA, "vertical", 15)):
            with self.subTest(wheel, y=y, by=by):
                row = self.program(y=y, wheel=wheel, rail=rail, inclination=inclination, mu=mu,
                                   radius=radius, by=by, direction=direction, strips=strips)
                demand = {"vertical_load" if direction == "vertical" else "load": 8e4}
                found = self.faststrip.contact(
                    wheel, rail, y, inclination=inclination, wheel_radius=radius, mu=mu,
                    creepage=None if by == FORMULA else (1e-3, -5e-4, 1e-4),
                    strips_per_patch=strips, **demand)
                for column, name in COLUMNS.items():
                    value = getattr(found, name)
                    if name == "word":
                        self.assertEqual(row[column], value)
                    else:
                        self.assertAlmostEqual(float(row[column]), value,
                                               delta=1e-12 * abs(value), msg=name)
        self.assertNotEqual(found.fx, 0.0)

    def test_a_contact_is_that_of_the_class_and_of_a_wheelset(self):
        f = self.faststrip
        gap = f.profile_gap("s1002", "60e1", shift=4.0, gauge=1437.0, step=0.1)
        friction = f.Friction("linear", kinetic_share=0.5, half_slip_speed=500.0)
        motion = (1e-3, 2e-3, 3e-4)
        solver = f.Contact(normal="hertz", tangential="fastsim", fastsim_grid=(12, 10))
        solver.set_gap(gap)
        alone = solver.solve(load=9e4, creepage=motion, friction=friction, speed=2e4, mu=0.4,
                             material=f.Material(e_wheel=2e5), contact_angle=gap.angle)
        found = f.contact("s1002", "60e1", 4.0, load=9e4, creepage=motion, friction=friction,
                          speed=2e4, mu=0.4, material=f.Material(e_wheel=2e5), gauge=1437.0,
                          step=0.1, normal="hertz", tangential="fastsim", fastsim_grid=(12, 10))
        for one in dataclasses.fields(f.Result):
            if one.name != "n_elements":
                self.assertEqual(getattr(found, one.name), getattr(alone, one.name), one.name)
        self.assertEqual((found.contact_angle, found.radius, found.rail_y, found.wheel_y),
                         (gap.angle, gap.radius, gap.y_rail, gap.y_wheel))
        self.assertEqual(len(found.elements.x), found.n_elements)
        self.assertGreater(found.n_elements, 50)
        # In the track: what a wheelset has of the same contact, whose loaded wheel sits deeper.
        for y, yaw in ((3.0, 2e-3), (-3.0, -1e-3)):
            wheels = f.Wheelset().solve(y=y, yaw=yaw, roll=0.0, load=1e5, wheels="right",
                                        speed=2e4)
            one, = wheels.contacts
            found = f.contact("s1002", "60e1", y, yaw=yaw, load=one.load)
            self.assertAlmostEqual(found.ceta / one.ceta, 1.0, delta=2e-3)
            same = f.contact("s1002", "60e1", y, load=one.load,
                             creepage=(one.cksi, one.ceta, one.cphi))
            self.assertAlmostEqual(same.force_y, one.force[1], delta=400.0)
            self.assertAlmostEqual(same.force_z, one.force[2], delta=400.0)
            self.assertLess(same.force_y * y, 0.0 if y < 0.0 else math.inf)
        deep = f.contact("s1002", "60e1", penetration=found.penetration, normal="auto",
                         target="pmax", tolerance=0.05)
        self.assertAlmostEqual(deep.penetration, found.penetration, delta=1e-16)
        self.assertEqual((deep.target_is_met, len(deep.steps) > 0), (True, True))

    def test_a_sweep_has_the_bits_of_its_contacts(self):
        f, np = self.faststrip, self.np
        y = np.array([70.0, 2.0, -3.0, 300.0, 6.5])
        loads = np.linspace(6e4, 1e5, 5)
        for options in ({}, {"yaw": np.linspace(-1e-3, 1e-3, 5)},
                        {"creepage": (1e-3, np.linspace(0.0, 1e-3, 5), 0.0)},
                        {"tangential": "fastsim", "fastsim_grid": (9, 9), "threads": 1}):
            found = f.sweep("s1002", "60e1", y, vertical_load=loads, **options)
            # At 70 the left wheel, which would roll with it, is beside its rail.
            there = [0, 1, 2, 4] if "creepage" in options else [1, 2, 4]
            self.assertEqual(np.flatnonzero(found.has_result).tolist(), there)
            for i in range(5):
                if i not in there:
                    self.assertEqual((found.word[i], found.n_strips[i]), ("no_contact", 0))
                    for name in ("fx", "load", "contact_angle", "rail_y", "cksi", "force_z"):
                        self.assertTrue(np.isnan(getattr(found, name)[i]), name)
                    continue
                alone = {name: value for name, value in options.items() if name != "threads"}
                if "yaw" in alone:
                    alone["yaw"] = options["yaw"][i]
                if "creepage" in alone:
                    alone["creepage"] = (1e-3, options["creepage"][1][i], 0.0)
                one = f.contact("s1002", "60e1", y[i], vertical_load=loads[i], **alone)
                for name in ("contact_angle", "radius", "rail_y", "wheel_y", "cksi", "ceta", "cphi",
                             "load", "fx", "fy", "mz", "pmax", "est_err_fx", "n_strips"):
                    self.assertEqual(getattr(found, name)[i], getattr(one, name), (i, name))
                self.assertAlmostEqual(found.force_z[i], one.force_z, places=8)
            first = 3 if "creepage" in options else 0
            self.assertTrue(found.first_error.startswith(f"contact {first}: "), found.first_error)
        bad = f.sweep("s1002", "60e1", [0.0, 1.0], load=[1e5, -1.0])
        self.assertEqual(bad.word.tolist(), ["ok", "bad_load"])
        self.assertIn("contact 1: ", bad.first_error)
        self.assertEqual(f.sweep("s1002", "60e1", [1.0, 2.0], load=8e4).first_error, "")

    def test_a_creep_map_is_that_of_cold_contacts(self):
        f, np = self.faststrip, self.np
        along, across = np.linspace(-4e-3, 4e-3, 5), np.array([-1e-3, 0.0, 3e-3])
        for normal in importlib.import_module("faststrip._contact").NORMAL:
            found = f.creep_map("s1002", "60e1", 1.0, longitudinal=along, lateral=across,
                                load=8e4, normal=normal)
            self.assertEqual((found.shape, found.axes), ((5, 3), ("cksi", "ceta")))
            for i, j in ((0, 0), (2, 1), (4, 2)):
                one = f.contact("s1002", "60e1", 1.0, load=8e4, normal=normal,
                                creepage=(along[i], across[j], found.cphi[i, j]))
                for name in ("fx", "fy"):
                    self.assertAlmostEqual(getattr(found, name)[i, j], getattr(one, name),
                                           delta=1e-6 * 0.3 * 8e4, msg=(normal, name))
        rolling = f.contact("s1002", "60e1", 1.0, load=8e4)
        self.assertEqual((found.cphi.min(), found.cphi.max()), (rolling.cphi,) * 2)
        # What is not given is that of rolling; a number stays.
        found = f.creep_map("s1002", "60e1", 1.0, spin=[0.0, rolling.cphi], vertical_load=8e4)
        self.assertEqual((found.axes, found.cksi.tolist(), found.ceta.tolist()),
                         (("cphi",), [rolling.cksi] * 2, [0.0, 0.0]))
        self.assertEqual(found.values("cphi").tolist(), [0.0, rolling.cphi])
        found = f.creep_map("s1002", "60e1", spin=[0.0, 1e-4, 2e-4], lateral=[0.0, 1e-3],
                            longitudinal=2e-3, penetration=0.1, threads=1)
        self.assertEqual((found.axes, found.shape, found.cksi[1, 2], found.penetration[0, 0]),
                         (("ceta", "cphi"), (2, 3), 2e-3, 0.1))
        self.assertEqual(found.values("cphi").tolist(), [0.0, 1e-4, 2e-4])
        self.assertEqual(found.ceta[1].tolist(), [1e-3] * 3)

    def test_tables(self):
        f, np = self.faststrip, self.np
        one = f.contact("s1002", "60e1", 3.0, vertical_load=8e4)
        frame, data = one.to_pandas(), one.to_xarray()
        self.assertEqual((len(frame), frame["fx"][0], float(data.force_y)),
                         (1, one.fx, one.force_y))
        self.assertEqual((frame.attrs["units"]["contact_angle"], data.radius.units), ("rad", "mm"))
        found = f.sweep("s1002", "60e1", [0.0, 300.0, 1.0], load=8e4)
        frame, data = found.to_pandas(), found.to_xarray()
        self.assertEqual((frame["word"].tolist(), frame["y"].tolist()),
                         (["ok", "no_contact", "ok"], [0.0, 300.0, 1.0]))
        self.assertEqual((data.fx.dims, float(data.fx.sel(y=1.0)), data.y.units),
                         (("y",), found.fx[2], "mm"))
        self.assertIn("contact 1", data.attrs["first_error"])
        self.assertEqual(set(frame.columns) - set(data.variables), set())
        creep = f.creep_map("s1002", "60e1", lateral=[0.0, 1e-3], spin=[0.0, 1e-4, 2e-4], load=8e4)
        frame, data = creep.to_pandas(), creep.to_xarray()
        self.assertEqual((len(frame), frame.loc[(1, 2), "cphi"]), (6, 2e-4))
        self.assertEqual(dict(data.sizes), {"ceta": 2, "cphi": 3})
        self.assertEqual((float(data.fy.sel(ceta=1e-3, cphi=1e-4)), data.cphi.units),
                         (creep.fy[1, 1], "rad mm-1"))
        renamed = creep.to_xarray(["a", "b"])
        self.assertEqual((renamed.ceta.dims, renamed.ceta.units), (("a", "b"), "1"))
        np.testing.assert_array_equal(renamed.ceta, creep.ceta)

    def test_pictures(self):
        f, np = self.faststrip, self.np
        pyplot = importlib.import_module("matplotlib.pyplot")
        y = np.concatenate([np.linspace(-2.0, 6.0, 21), [300.0], np.linspace(6.2, 6.8, 4)])
        found = f.sweep("s1002", "60e1", y, vertical_load=8e4)
        mine = pyplot.figure()
        self.assertIs(found.plot(mine), mine)
        mine.canvas.draw()
        forces, angle, pressure, patch = mine.axes
        self.assertEqual([axes.get_ylabel().split(", ")[-1] for axes in mine.axes],
                         ["kN", "degrees", "MPa", "mm"])
        for axes in (pressure, patch):
            self.assertEqual(axes.get_xlabel(), "lateral displacement $y$, mm")
        x, drawn = angle.lines[0].get_data()
        expected = np.degrees(found.contact_angle)
        np.testing.assert_array_equal(drawn[~np.isnan(drawn)], expected[~np.isnan(expected)])
        # The jumps of this pair, and the displacement without contact.
        breaks = sorted(x[np.isnan(drawn)].tolist())
        for at, (low, high) in zip(breaks, ((0.0, 0.8), (4.8, 5.6), (6.5, 6.8), (299.0, 300.0)),
                                   strict=True):
            self.assertTrue(low < at <= high, breaks)
        self.assertEqual([line.get_label() for line in forces.lines],
                         ["normal", "longitudinal", "lateral"])
        np.testing.assert_array_equal(np.nanmax(forces.lines[0].get_ydata()),
                                      np.nanmax(found.load) / 1e3)
        along = np.linspace(-5e-3, 5e-3, 5)
        creep = f.creep_map("s1002", "60e1", 3.0, longitudinal=along[::-1], lateral=along[:3],
                            vertical_load=8e4)
        creep.fx[4, 0] = np.nan
        figure = creep.plot()
        figure.canvas.draw()
        maps = [axes for axes in figure.axes if axes.get_xlabel()]
        self.assertEqual([axes.get_xlabel() for axes in maps], ["longitudinal creepage, %"] * 2)
        self.assertEqual(maps[0].get_ylabel(), "lateral creepage, %")
        self.assertEqual([axes.get_ylabel() for axes in figure.axes if axes not in maps],
                         ["longitudinal force on the rail, kN", "lateral force on the rail, kN"])
        colours = np.ma.asarray(maps[0].collections[0].get_array())
        self.assertEqual(colours.shape, (3, 5))
        # Creepages rise along the axes, whatever their order was; white where there is no force.
        self.assertTrue(colours.mask[0, 0])
        self.assertEqual(colours.mask.sum(), 1)
        np.testing.assert_array_equal(colours[2], creep.fx[::-1, 2] / 1e3)
        line = f.creep_map("s1002", "60e1", spin=[-1e-4, 0.0, 1e-4], load=8e4)
        axes, = line.plot().axes
        self.assertEqual((axes.get_xlabel(), axes.get_ylabel()),
                         ("spin creepage, rad/mm", "force on the rail, kN"))
        np.testing.assert_array_equal(axes.lines[1].get_ydata(), line.fy / 1e3)
        cube = f.creep_map("s1002", "60e1", longitudinal=[0.0], lateral=[0.0], spin=[0.0], load=8e4)
        self.refused("bad_argument", cube.plot, says="over three creepages cannot be drawn")
        one = f.contact("s1002", "60e1", 3.0, vertical_load=8e4)
        self.assertEqual(len([axes for axes in one.plot().axes if axes.get_title(loc="left")]), 3)
        pyplot.close("all")

    def test_texts_of_all_results_are_short(self):
        f, np = self.faststrip, self.np
        many = np.linspace(-6.0, 6.0, 41)
        solver = f.Contact(normal="auto", with_elements=True)
        gap = f.profile_gap("s1002", "60e1")
        solver.set_gap(gap)
        auto = solver.solve(load=1e5, creepage=(1e-3, 5e-4, 1e-4), tolerance=1e-9)
        solver.solve(load=1e5, speed=2e4, thermal=f.Thermal())
        flash = solver.flash()
        functions = f.contact_functions("s1002", "60e1", many)
        wheels = f.Wheelset().solve(load=1e5, y=6.6, speed=2e4, derivatives=True)
        law = f.WearLaw([(0.0, 1e9, 0.0, 5.0)], 7850.0)
        table = f.Lookup(ROOT / "example" / "notebooks" / "steel.fslt")
        looked = table(np.linspace(3.0, 8.0, 50), 4.0, 8e4, 0.3, 82000.0, (1e-3, 0.0, 0.0))
        random = np.random.default_rng(1).uniform(0.9, 1.1, (200, 30))
        results = [
            flash, auto, auto.steps[0], solver.strips(), solver.elements(), solver.wear(law),
            solver.strip_wear(law), solver.stresses(many, 0.0, 1.0), solver.stress_peak(), gap,
            functions, functions.conicity(np.linspace(0.5, 4.0, 99)),
            f.Profile(many, many, "wheel", "long/" * 99, "format", "message " * 99), wheels,
            wheels.contacts[0], looked,
            f.WheelContacts(random, np.arange(99, dtype=np.int32), np.arange(99, dtype=np.int32)),
            f.solve_many(gap, load=8e4 * random), f.contact("s1002", "60e1", 1.23, load=8e4),
            f.sweep("s1002", "60e1", [*many, 300.0], vertical_load=8e4),
            f.creep_map("s1002", "60e1", longitudinal=many / 1e3, spin=many / 1e4, load=8e4)]
        for result in results:
            with self.subTest(type(result).__name__):
                text = repr(result)
                self.assertLess(len(text), 1500)
                self.assertNotIn("\n", text)
                self.assertTrue(text.startswith(type(result).__name__ + "("))
        # None is left out: what is not here is passed in.
        inputs = {"Friction", "Material", "RailState", "Thermal", "WearLaw"}
        public = {name for name in f.__all__ if inspect.isclass(getattr(f, name))
                  and dataclasses.is_dataclass(getattr(f, name))}
        self.assertEqual(public - inputs, {type(result).__name__ for result in results})
        self.assertIn("fx=-9854.18, ", repr(f.contact("s1002", "60e1", 3.0, vertical_load=8e4)))

    def test_what_is_refused(self):
        f = self.faststrip
        pair, load = ("s1002", "60e1"), {"vertical_load": 8e4}
        demand = "one of vertical_load, load and penetration must be given, got "
        self.all_refused(
            (demand + "none", lambda: f.contact(*pair)),
            (demand + "vertical_load and load", lambda: f.sweep(*pair, [0.0], load=1.0, **load)),
            (demand + "none", lambda: f.creep_map(*pair, spin=[0.0])),
            ("the wheel profile must be s1002, cone20 or cone40, got s1003",
             lambda: f.contact("s1003", "60e1", **load)),
            ("no such file: nothing.whl", lambda: f.contact("nothing.whl", "60e1", **load)),
            ("the profile must be that of a rail, the file is that of a wheel",
             lambda: f.sweep("s1002", CASES / "worn_wheel.whl", [0.0], **load)),
            ("the rail inclination must be given", lambda: f.contact(*self.worn, **load)),
            ("wheel must be a Profile of a wheel or a name, got 5",
             lambda: f.contact(5, "60e1", **load)),
            ("y must be a number, got '3'", lambda: f.contact(*pair, "3", **load)),
            ("y must be finite, got nan", lambda: f.contact(*pair, math.nan, **load)),
            ("y must be a row of numbers, got 3.0", lambda: f.sweep(*pair, 3.0, **load)),
            ("y must be a row of numbers, got []", lambda: f.sweep(*pair, [], **load)),
            ("y[1] must be finite, got inf", lambda: f.sweep(*pair, [0.0, math.inf], **load)),
            ("vertical_load must be finite, got inf",
             lambda: f.contact(*pair, vertical_load=math.inf)),
            ("load must be", lambda: f.contact(*pair, vertical_load=-8e4)),
            ("wheel_radius must be a number above 0, got -460.0",
             lambda: f.contact(*pair, wheel_radius=-460.0, **load)),
            ("inclination must be a tangent, -1 to 1, got 40.0",
             lambda: f.contact(*pair, inclination=40.0, **load)),
            ("yaw must be 0 where creepage is given",
             lambda: f.contact(*pair, yaw=1e-3, creepage=(0.0, 0.0, 0.0), **load)),
            ("creepage must be longitudinal, lateral and spin, 3 numbers, got (0.0, 0.0)",
             lambda: f.contact(*pair, creepage=(0.0, 0.0), **load)),
            ("creepage must be longitudinal, lateral and spin, numbers or as long as y, got 0.001",
             lambda: f.sweep(*pair, [0.0], creepage=1e-3, **load)),
            ("creepage[1] must be as long as y, 2, or one number, got 3",
             lambda: f.sweep(*pair, [0.0, 1.0], creepage=(0.0, [1.0] * 3, 0.0), **load)),
            ("mu must be as long as y, 2", lambda: f.sweep(*pair, [0.0, 1.0], mu=[0.3], **load)),
            ("normal must be one of strip, ", lambda: f.sweep(*pair, [0.0], normal="x", **load)),
            ("threads must be a whole number", lambda: f.sweep(*pair, [0.0], threads=0, **load)),
            ("one of longitudinal, lateral and spin must be an array, got none",
             lambda: f.creep_map(*pair, spin=1e-4, **load)),
            ("lateral must be a row of numbers, got",
             lambda: f.creep_map(*pair, lateral=[[0.0]], **load)),
            ("spin[0] must be finite, got nan",
             lambda: f.creep_map(*pair, spin=[math.nan], **load)),
            ("axis must be one of cphi, got 'cksi'",
             lambda: f.creep_map(*pair, spin=[0.0], **load).values("cksi")))
        for call, more in ((f.contact, ()), (f.sweep, ([0.0],))):
            self.refused("no_contact", call, *pair, *([300.0],) if more else (300.0,),
                         says="300.000", **load)
            with self.assertRaisesRegex(TypeError, rf"{call.__name__}\(\) got an unexpected keyword"
                                                   " argument 'strips'"):
                call(*pair, *more, strips=3, **load)

    def test_conicity_of_two_measured_files(self):
        f, np = self.faststrip, self.np
        wheel, rail = (f.Profile.read(path, smooth_wavelength=5.0) for path in self.worn)
        functions = f.contact_functions(wheel, rail, inclination=0.0)
        self.assertEqual((len(functions.y), functions.y[0], functions.y[-1]), (201, -10.0, 10.0))
        found = functions.conicity([2.0, 3.0])
        np.testing.assert_array_equal(
            found.tan_gamma_e,
            f.conicity(functions.y, functions.delta_r, [2.0, 3.0]).tan_gamma_e)
        self.assertTrue((found.tan_gamma_e > 0.15).all())
