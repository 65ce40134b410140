"""What notebooks make of results: tables of pandas and xarray, pictures, many contacts by Dask; and
the types of the package."""

import importlib
import subprocess
import sys

from installed import ROOT, HostTest

DASK = """
import os, dask.distributed, numpy as np, xarray as xr, faststrip

y = np.linspace(-15.0, 15.0, 301)

def forces(h, load, cksi):
    found = faststrip.solve_many((y, h, 1.0 / 920.0), load=load, creepage=(cksi, 0.0, 0.0),
                                 strips_per_patch=7, threads=1)
    return found.fx, found.status, np.full(found.shape, os.getpid())

if __name__ == "__main__":
    curvature = xr.DataArray([1e-3, 2e-3, 3e-3, 4e-3], dims="gap")
    h = curvature * xr.DataArray(y**2, dims="point")
    load = xr.DataArray(np.linspace(4e4, 1e5, 6), dims="load")
    load[2] = np.nan
    cksi = xr.DataArray([0.0, 2e-3], dims="cksi")
    options = dict(input_core_dims=[["point"], [], []], output_core_dims=[[], [], []])
    with dask.distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, host="127.0.0.1",
            dashboard_address=None) as cluster, dask.distributed.Client(cluster):
        chunks = h.chunk(gap=2), load.chunk(load=2), cksi
        fx, status, process = xr.apply_ufunc(
            forces, *chunks, dask="parallelized", output_dtypes=[float, np.int32, int], **options)
        fx, status, process = dask.compute(fx, status, process)
    direct, direct_status, _ = xr.apply_ufunc(forces, h, load, cksi, **options)
    print(fx.dims, fx.shape)
    print(bool(((fx == direct) | (np.isnan(fx) & np.isnan(direct))).all()))
    print(bool((status == direct_status).all()), sorted(set(status.values.ravel().tolist())))
    print(len(set(process.values.ravel().tolist())), os.getpid() in process.values)
    alone = faststrip.Contact(strips_per_patch=7)
    alone.set_gap(y, h[3].values, 1.0 / 920.0)
    print(alone.solve(load=float(load[5]), creepage=(2e-3, 0.0, 0.0)).fx == float(fx[3, 5, 1]))
"""

CALLER = """
from typing import Tuple
import numpy as np
import faststrip

y = np.linspace(-15.0, 15.0, 301)
contact = faststrip.Contact(normal="strip", with_elements=True)
contact.set_gap(y, 2e-3 * y**2, 1.0 / 920.0)
result: faststrip.Result = contact.solve(load=1e5, creepage=(1e-3, 0.0, 0.0))
force: float = result.fx + contact.strips().p0[0]
many: faststrip.ManyResult = faststrip.solve_many((y, 2e-3 * y**2, 1e-3), load=[1e4, 2e4])
shape: Tuple[int, ...] = many.shape
gap: faststrip.Gap = faststrip.profile_gap("s1002", "60e1", shift=1.0)
wheels: faststrip.WheelsetResult = faststrip.Wheelset().solve(axle_load=1e5)
"""
WRONG = """
import faststrip
faststrip.Contact(normal=1)
faststrip.Contact().solve(load="1")
reveal: str = faststrip.Contact().solve(load=1.0).fx
faststrip.solve_many(load=1.0)
"""


class Tables(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.faststrip, cls.np = cls.import_package(), importlib.import_module("numpy")
        cls.y = cls.np.linspace(-15.0, 15.0, 301)
        cls.contact = cls.faststrip.Contact(with_elements=True)
        cls.contact.set_gap(cls.y, 2e-3 * cls.y**2, 1.0 / 920.0)
        cls.result = cls.contact.solve(load=1e5, creepage=(1e-3, 5e-4, 0.0))

    def test_every_column_of_a_table_is_what_the_result_has(self):
        np = self.np
        shifts = np.linspace(-5.0, 5.0, 11)
        functions = self.faststrip.contact_functions("s1002", "60e1", shifts)
        conicity = self.faststrip.conicity(functions.y, functions.delta_r, [1.0, 2.0, 3.0])
        law = self.faststrip.WearLaw([(0.0, 1e9, 0.0, 5.0)], 7850.0)
        for found, dim in ((self.contact.strips(), "strip"), (self.contact.elements(), "element"),
                           (self.contact.strip_wear(law), "strip"), (functions, "y"),
                           (self.faststrip.profile_gap("s1002", "60e1"), "y"),
                           (conicity, "amplitude")):
            with self.subTest(type(found).__name__):
                frame, dataset = found.to_pandas(), found.to_xarray()
                self.assertEqual(list(dataset.sizes), [dim])
                self.assertGreaterEqual(len(frame.columns), 4)
                self.assertEqual(set(frame.columns), set(dataset.variables))
                for name in frame.columns:
                    np.testing.assert_array_equal(frame[name], getattr(found, name))
                    np.testing.assert_array_equal(dataset[name], getattr(found, name))
                    if name != "words":
                        units = frame.attrs["units"][name]
                        self.assertEqual(dataset[name].attrs["units"], units)
                        self.assertTrue(dataset[name].attrs["long_name"])
        self.assertNotIn("mass", self.contact.strip_wear().to_pandas().columns)
        self.assertEqual(self.contact.elements().to_pandas().attrs["units"]["px"], "MPa")

    def test_a_result_is_one_row(self):
        frame, dataset = self.result.to_pandas(), self.result.to_xarray()
        self.assertEqual((len(frame), dict(dataset.sizes)), (1, {}))
        self.assertEqual((frame["fx"][0], float(dataset.fx), str(dataset.word.values)),
                         (self.result.fx, self.result.fx, "ok"))
        self.assertEqual((dataset.mz.units, dataset.area.units, dataset.pmax.units),
                         ("N mm", "mm2", "MPa"))
        self.assertTrue(self.np.isnan(frame["est_err_target"][0]))
        wear = self.contact.wear()
        frame, dataset = wear.to_pandas(), wear.to_xarray()
        self.assertEqual((frame["t_gamma"][0], float(dataset.t_gamma)), (wear.t_gamma,) * 2)
        self.assertTrue(self.np.isnan(frame["mass"][0]))
        self.assertEqual((dataset.t_gamma_per_area.units, dataset.volume.units),
                         ("N mm-2", "mm3 m-1"))

    def test_contacts_of_a_wheelset_are_rows(self):
        found = self.faststrip.Wheelset().solve(axle_load=1e5, y=1.0, speed=2e4,
                                                pitch_rate=-2e4 / 460.0)
        frame, dataset = found.to_pandas(), found.to_xarray()
        self.assertEqual(frame["side"].tolist(), [one.side for one in found.contacts])
        for i, one in enumerate(found.contacts):
            self.assertEqual([frame[f"force_{axis}"][i] for axis in "xyz"], list(one.force))
            self.assertEqual([frame[f"rail_{axis}"][i] for axis in "yz"], list(one.rail))
            self.assertEqual(float(dataset.cksi[i]), one.cksi)
        self.assertEqual((dataset.moment_x.units, dataset.speed.units), ("N mm", "mm s-1"))

    def test_many_contacts_as_tables(self):
        np = self.np
        load = np.array([[1e4, 5e4, np.nan], [2e4, 6e4, 1e5]])
        many = self.faststrip.solve_many((self.y, 2e-3 * self.y**2, 1e-3), load=load)
        frame = many.to_pandas()
        self.assertEqual((len(frame), frame.index.nlevels), (6, 2))
        self.assertEqual(frame.loc[(1, 2), "fx"], many.fx[1, 2])
        self.assertEqual(frame.loc[(0, 2), "word"], "not_finite")
        self.assertEqual(frame.attrs["units"]["pmax"], "MPa")
        dataset = many.to_xarray(["row", "step"], {"step": [0.1, 0.2, 0.3]})
        self.assertEqual(dict(dataset.sizes), {"row": 2, "step": 3})
        np.testing.assert_array_equal(dataset.pmax, many.pmax)
        self.assertEqual(float(dataset.fx.sel(step=0.2)[1]), many.fx[1, 1])
        for name in dataset.data_vars:
            self.assertIn("long_name", dataset[name].attrs, name)
            if name not in ("status", "word", "target_is_met"):
                self.assertIn("units", dataset[name].attrs, name)
        self.assertEqual(dataset.status.flag_values.tolist(), [0, 101])
        self.assertEqual(dataset.status.flag_meanings, "ok not_finite")
        self.assertIn("[0, 2]", dataset.attrs["first_error"])
        one = self.faststrip.solve_many((self.y, 2e-3 * self.y**2, 1e-3), load=[1e4, 2e4])
        self.assertEqual(list(one.to_xarray().sizes), ["contact"])
        self.assertEqual(len(one.to_pandas()), 2)
        for dims in ("row", ["row"], ["a", "b", "c"]):
            with self.assertRaisesRegex(self.faststrip.FaststripError, "dims must be 2 names"):
                many.to_xarray(dims)


class Pictures(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        importlib.import_module("matplotlib").use("Agg")
        cls.faststrip, cls.np = cls.import_package(), importlib.import_module("numpy")

    def contact(self, **options):
        gap = self.faststrip.profile_gap("s1002", "60e1", shift=-5.0)
        contact = self.faststrip.Contact(**options)
        contact.set_gap(*gap[:4])
        return contact

    def test_a_contact(self):
        for tangential in ("faststrip", "fastsim"):
            contact = self.contact(with_elements=True, tangential=tangential, fastsim_grid=(11, 9))
            contact.solve(load=1e5, creepage=(1.5e-3, 8e-4, 2e-4))
            figure = contact.plot()
            panels = [axes for axes in figure.axes if axes.get_title(loc="left")]
            self.assertEqual([axes.get_title(loc="left") for axes in panels],
                             ["Patch and pressure", "Pressure", "Tractions on the rail"])
            strips, elements = contact.strips(), contact.elements()
            low, high = panels[0].dataLim.intervalx
            self.assertAlmostEqual(low, strips.y_left.min(), places=9)
            self.assertAlmostEqual(high, strips.y_right.max(), places=9)
            # Elements in adhesion and those that slide are as many as there are.
            sizes = [len(each.get_paths()) for each in panels[2].collections]
            sticks = int((elements.state == 1).sum())
            self.assertEqual(sizes[:2], [sticks, len(elements.x) - sticks])
            lines, = panels[1].lines
            self.assertEqual(max(lines.get_ydata()), strips.p0.max())
            figure.canvas.draw()

    def test_results_draw_themselves(self):
        np, pyplot = self.np, importlib.import_module("matplotlib.pyplot")
        contact = self.contact(with_elements=True)
        for empty, what in ((contact.strips(), "strips"), (contact.elements(), "elements")):
            with self.assertRaisesRegex(self.faststrip.FaststripError, f"no {what} to draw"):
                empty.plot()
        contact.solve(load=1e5, creepage=(1.5e-3, 8e-4, 2e-4))
        strips, elements = contact.strips(), contact.elements()
        axes = strips.plot()
        self.assertAlmostEqual(axes.dataLim.intervalx[1], strips.y_right.max(), places=9)
        axes.figure.canvas.draw()
        axes = elements.plot()
        sticks = int((elements.state == 1).sum())
        self.assertEqual([len(each.get_paths()) for each in axes.collections][:2],
                         [sticks, len(elements.x) - sticks])
        axes.figure.canvas.draw()
        gap = self.faststrip.profile_gap("s1002", "60e1", shift=2.0)
        functions = self.faststrip.contact_functions("s1002", "60e1", np.linspace(-5.0, 5.0, 21))
        conicity = self.faststrip.conicity(functions.y, functions.delta_r, [1.0, 2.0, 3.0])
        profile = self.faststrip.Profile(gap.y, gap.h, "wheel", "folder/worn.whl")
        line, = functions.plot().lines
        whole = np.isfinite(line.get_ydata())
        np.testing.assert_array_equal(line.get_xdata()[whole], functions.y)
        np.testing.assert_array_equal(line.get_ydata()[whole], functions.delta_r)
        places = functions.y_wheel_right, functions.y_wheel_left
        jumps = np.any([abs(np.diff(place)) > 4.5 for place in places], axis=0)
        self.assertEqual(np.sum(~whole), np.sum(jumps))
        self.assertGreater(np.sum(jumps), 0)
        for found, lines in ((gap, [(gap.y, gap.h)]),
                             (conicity, [(conicity.amplitude, conicity.tan_gamma_e),
                                         (conicity.amplitude, conicity.regression)]),
                             (profile, [(profile.y, profile.z)])):
            mine = pyplot.figure().subplots()
            self.assertIs(found.plot(mine), mine)
            for line, (x, y) in zip(mine.lines, lines, strict=True):
                np.testing.assert_array_equal(line.get_xdata(), x)
                np.testing.assert_array_equal(line.get_ydata(), y)
            self.assertTrue(mine.get_xlabel().endswith("mm"))
            found.plot().figure.canvas.draw()
            pyplot.close("all")
        self.assertEqual(profile.plot(label="mine").lines[0].get_label(), "mine")

    def test_without_elements_and_on_a_figure_of_the_caller(self):
        pyplot = importlib.import_module("matplotlib.pyplot")
        contact = self.contact()
        with self.assertRaisesRegex(self.faststrip.FaststripError, "no contact to draw"):
            contact.plot()
        contact.solve(load=1e5)
        mine = pyplot.figure()
        self.assertIs(contact.plot(mine), mine)
        self.assertEqual(len([axes for axes in mine.axes if axes.get_title(loc="left")]), 2)

    def test_all_slides_and_one_element(self):
        contact = self.contact(with_elements=True)
        contact.solve(load=1e5, creepage=(0.1, 0.0, 0.0))
        self.assertIn("all slides", contact.plot().axes[2].get_xlabel())
        contact = self.contact(with_elements=True, strips_per_patch=1, points_per_strip=1)
        contact.solve(load=1e5, creepage=(1e-3, 0.0, 0.0))
        contact.plot().canvas.draw()

    def test_a_pair_of_profiles_touches_where_the_gap_says(self):
        np = self.np
        for shift in (-3.0, 0.0, 6.0):
            gap = self.faststrip.profile_gap("s1002", "60e1", shift=shift)
            axes = self.faststrip.plot_profiles("s1002", "60e1", gap)
            wheel, rail, mark = axes.lines
            at, = mark.get_xdata()
            self.assertEqual(at, gap.y_rail)
            y = np.linspace(at - 8.0, at + 3.0, 400)
            gaps = (np.interp(y, *rail.get_data()) - np.interp(y, *wheel.get_data()))
            # The wheel is above the rail and touches it; chords of the curves are off a little.
            self.assertGreater(gaps.min(), -0.03)
            self.assertAlmostEqual(np.interp(at, y, gaps), 0.0, delta=0.01)
            self.assertTrue(axes.yaxis_inverted())
            axes.figure.canvas.draw()
        axes = self.faststrip.plot_profiles("cone20", "uic60", axes=axes)
        self.assertEqual(len(axes.lines), 5)


class Others(HostTest):
    def script(self, name, text, *words):
        self.write(name, text)
        return subprocess.run([sys.executable, *words, name], cwd=self.folder, encoding="utf-8",
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False,
                              timeout=600, env={**self.installed.environment,
                                                "PYTHONPATH": str(ROOT / "python")})

    def test_two_workers_of_dask(self):
        done = self.script("by_dask.py", DASK)
        self.assertEqual(done.stdout.splitlines(), [
            "('gap', 'load', 'cksi') (4, 6, 2)", "True", "True [0, 101]", "2 False", "True"],
            done.stderr)

    def test_the_types_hold(self):
        done = self.script("caller.py", CALLER, "-m", "mypy", "--strict", "--cache-dir=cache")
        self.assertEqual(done.stdout, "Success: no issues found in 1 source file\n", done.stderr)
        done = self.script("wrong.py", WRONG, "-m", "mypy", "--strict", "--cache-dir=cache")
        self.assertEqual([line.split(":")[1] for line in done.stdout.splitlines()
                          if ": error:" in line], ["3", "4", "5", "6"], done.stdout)

    def test_the_types_of_the_package_hold(self):
        done = subprocess.run(
            [sys.executable, "-m", "mypy", "--cache-dir", str(self.folder / "cache"),
             "--config-file", str(ROOT / "pyproject.toml")], cwd=ROOT, encoding="utf-8",
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        self.assertRegex(done.stdout, r"^Success: no issues found in \d+ source files\n$")
