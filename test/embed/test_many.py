"""Many contacts in one call, of C and of Python: the bits of one by one, whatever the threads."""

import doctest
import importlib
import os
import pickle
import shutil
import subprocess
import sys
import unittest

from installed import ROOT, HostTest


class FromC(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.compile_host("many.c", "many")

    def test_any_number_of_threads_gives_the_bits_of_one_by_one(self):
        found = self.findings("./many bits")
        self.assertEqual((found["status"], found["different"]), ([0] * 6, [0] * 6))

    def test_chains_start_from_the_contact_before(self):
        found = self.findings("./many chains")
        self.assertEqual((found["status"], found["different"]), ([0] * 3, [0] * 3))
        self.assertEqual(found["failed"], [7])
        self.assertGreater(found["cold"][0], 100)

    def test_a_wrong_contact_costs_only_itself_and_a_wrong_call_is_told(self):
        found = self.findings("./many errors")
        self.assertEqual((found.get("line", []), found["wrong"]), ([], [0]))
        self.assertEqual(sum(found["checked"]), 22)
        # Numbers in messages are the library's own, whatever Fortran's run time is told.
        self.assertEqual(self.findings("./many errors", GFORTRAN_OPTIONAL_PLUS="y"), found)

    def test_a_fork_after_a_call_does_not_hang(self):
        self.assertEqual(self.findings("./many forked"), {"wrong": [0]})

    @unittest.skipUnless(shutil.which("valgrind"), "needs valgrind")
    def test_no_race_and_no_leak_under_valgrind(self):
        # helgrind finds races by the same rule as drd, in twice its time.
        for tool in ("--tool=drd", "--leak-check=full"):
            text = self.shell(f"valgrind {tool} --error-exitcode=9 ./many errors 2>&1")
            self.assertRegex(text, r"ERROR SUMMARY: 0 errors")


FORKS = """
import os, signal, numpy, faststrip
y = numpy.linspace(-15.0, 15.0, 101)
gap = y, 2e-3 * y**2, 1.0 / 920.0
load = numpy.linspace(1e4, 1e5, 50)

def work():
    return faststrip.solve_many(gap, load=load, normal="hertz", threads=4).fx.sum()

work()
child = os.fork()
if child == 0:
    signal.alarm(100)  # a child that waits for ever ends by this
    work()
    os._exit(0)
print(os.waitpid(child, 0)[1])
"""


class FromPython(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.faststrip, cls.np = cls.import_package(), importlib.import_module("numpy")
        cls.y = cls.np.linspace(-15.0, 15.0, 301)
        cls.gap = cls.y, 2e-3 * cls.y**2, 1.0 / 920.0

    def same(self, many, place, result):
        """Is it the result of that place?"""
        for name in ("status", "load", "penetration", "area", "pmax", "y_min", "y_max", "x_max",
                     "fx", "fy", "mz", "friction_power", "stick_fraction", "n_patches", "n_strips",
                     "iterations", "strips_across", "est_err_penetration", "est_err_pmax",
                     "est_err_area", "residual_inside", "overlap_outside", "est_err_fx",
                     "est_err_fy", "est_err_mz", "est_err_target"):
            mine, wanted = getattr(many, name)[place], getattr(result, name)
            if wanted is None:
                self.assertTrue(self.np.isnan(mine), name)
            else:
                self.assertEqual(mine, wanted, (name, place))
        self.assertEqual(many.word[place], result.word)
        self.assertEqual(bool(many.target_is_met[place]), bool(result.target_is_met))

    def test_each_is_what_solve_gives_alone(self):
        np, faststrip = self.np, self.faststrip
        load = np.array([3e4, 6e4, 9e4])
        cksi = np.array([[0.0], [2e-3]])
        mu = np.array([[0.2, 0.3, 0.4]])
        options = dict(speed=2e4, contact_angle=0.3, friction=faststrip.Friction(
            "rational", 0.4, 1e3, flange_share=0.5, tread_angle=0.1, flange_angle=0.5),
            material=faststrip.Material(nu_rail=0.3))
        for methods in ({}, {"normal": "hertz", "tangential": "fastsim", "fastsim_grid": (9, 11)},
                        {"normal": "auto", "points_per_strip": 9, "estimate": False}):
            wanted = ({"target": "pmax", "tolerance": 0.01} if methods.get("normal") == "auto"
                      else {})
            for threads in (1, 4, 7):
                many = faststrip.solve_many(self.gap, load=load, creepage=(cksi, -1e-3, 2e-4),
                                            mu=mu, threads=threads, **options, **methods, **wanted)
                self.assertEqual((many.shape, many.first_error), ((2, 3), ""))
                contact = faststrip.Contact(**methods)
                contact.set_gap(*self.gap)
                for place in np.ndindex(2, 3):
                    self.same(many, place, contact.solve(
                        load=load[place[1]], creepage=(cksi[place[0], 0], -1e-3, 2e-4),
                        mu=mu[0, place[1]], **options, **wanted))

    def test_by_penetration_and_by_other_ways_to_say_creepages(self):
        np = self.np
        creepage = np.array([[1e-3, 0.0, 0.0], [0.0, 1e-3, 1e-4]])
        many = self.faststrip.solve_many(self.gap, penetration=0.1, creepage=creepage)
        self.assertEqual(many.shape, (2,))
        columns = self.faststrip.solve_many(self.gap, penetration=[0.1, 0.1],
                                            creepage=[[1e-3, 0.0], [0.0, 1e-3], [0.0, 1e-4]])
        np.testing.assert_array_equal(many.fx, columns.fx)
        contact = self.faststrip.Contact()
        contact.set_gap(*self.gap)
        for i in range(2):
            self.same(many, i, contact.solve(penetration=0.1, creepage=tuple(creepage[i])))
        self.assertEqual(self.faststrip.solve_many(self.gap, load=1e5).shape, ())

    def test_gaps_as_arrays_and_as_lists(self):
        np, y = self.np, self.y
        curvatures = np.array([1e-3, 2e-3, 3e-3])
        h = curvatures[:, None] * y**2
        inclination = 0.1 * y
        load = np.array([[5e4], [1e5]])
        singly = [[None] * 3, [None] * 3]
        for j in range(3):
            contact = self.faststrip.Contact()
            contact.set_gap(y, h[j], 1.0 / 920.0, inclination)
            for i in range(2):
                singly[i][j] = contact.solve(load=load[i, 0], mu=0.4)
        shorter = slice(20, -20)
        ways = {
            "stack": (y, h, 1.0 / 920.0, inclination),
            "strides": (np.repeat(y, 2)[::2], np.asfortranarray(h), np.full((3, 301), 1.0 / 920.0),
                        list(inclination)),
            "list": [(y, h[0], 1.0 / 920.0, inclination), (y, h[1], 1.0 / 920.0, inclination),
                     (y, h[2], np.full(301, 1.0 / 920.0), inclination)]}
        for name, gaps in ways.items():
            with self.subTest(name):
                many = self.faststrip.solve_many(gaps, load=load, mu=0.4, threads=3)
                self.assertEqual(many.shape, (2, 3))
                for place in np.ndindex(2, 3):
                    self.same(many, place, singly[place[0]][place[1]])
        gap = self.faststrip.Gap(y, h[0], np.full(301, 1.0 / 920.0), inclination, 0.0, 460.0, 0.0,
                                 0.0, (0, 0))
        self.same(self.faststrip.solve_many(gap, load=[5e4], mu=0.4), 0, singly[0][0])
        # Of different lengths.
        many = self.faststrip.solve_many([(y[shorter], h[0][shorter], 1.0 / 920.0),
                                          (y, h[1], 1.0 / 920.0)], load=2e4)
        contact = self.faststrip.Contact()
        contact.set_gap(y[shorter], h[0][shorter], 1.0 / 920.0)
        self.same(many, 0, contact.solve(load=2e4))

    def test_what_is_wrong_with_one_costs_only_that_one(self):
        np = self.np
        load = np.array([1e5, np.nan, -1.0, 1e5, np.inf])
        h = np.stack([self.gap[1]] * 5)
        h[3, 7] = np.nan
        many = self.faststrip.solve_many((self.y, h, 1.0 / 920.0), load=load, threads=3)
        self.assertEqual(many.word.tolist(),
                         ["ok", "not_finite", "bad_load", "not_finite", "not_finite"])
        self.assertEqual(many.has_result.tolist(), [True] + [False] * 4)
        self.assertEqual(many.counts, {"ok": 1, "not_finite": 3, "bad_load": 1})
        self.assertRegex(many.first_error, "^contact 1: .*NaN")
        for name in ("load", "fx", "pmax", "est_err_fx", "stick_fraction"):
            self.assertEqual(np.isnan(getattr(many, name)).tolist(), [False] + [True] * 4, name)
        self.assertEqual(many.n_strips.tolist()[1:], [0] * 4)
        contact = self.faststrip.Contact()
        contact.set_gap(*self.gap)
        self.same(many, 0, contact.solve(load=1e5))
        # In several calls of the library, and several dimensions.
        loads = np.full((40, 50), 1e5)
        loads[33, 7] = np.nan
        many = self.faststrip.solve_many(self.gap, load=loads, normal="hertz", threads=1)
        self.assertRegex(many.first_error, r"^contact \[33, 7\]: .*NaN")
        self.assertEqual(many.counts, {"ok": 1999, "not_finite": 1})

    def test_chains_do_not_depend_on_threads_or_calls(self):
        np = self.np
        load = np.linspace(5e4, 1e5, 500)
        one, four = (self.faststrip.solve_many(self.gap, load=load, warm_start=True, chain=9,
                                               strips_per_patch=5, threads=threads)
                     for threads in (1, 4))
        np.testing.assert_array_equal(one.fx, four.fx)
        np.testing.assert_array_equal(one.iterations, four.iterations)
        contact = self.faststrip.Contact(strips_per_patch=5)
        contact.set_gap(*self.gap)
        for i in range(50):
            self.same(one, i, contact.solve(load=load[i], warm_start=i % 9 > 0))

    def test_empty_arrays_give_empty_ones(self):
        for load, gap, shape in (([], self.gap, (0,)),
                                 (1e5, (self.y, self.np.zeros((0, 301)), 1e-3), (0,)),
                                 (self.np.ones((3, 0)), self.gap, (3, 0))):
            many = self.faststrip.solve_many(gap, load=load)
            self.assertEqual((many.shape, many.word.shape, many.counts, many.first_error),
                             (shape, shape, {}, ""))

    def test_wrong_arguments_are_refused_by_name(self):
        np, y, gap = self.np, self.y, self.gap
        nan, bad, solve_many = float("nan"), "bad_argument", self.faststrip.solve_many
        for gaps, says in (
                (None, "gaps must be a tuple (y, h, inv2r)"), (y, "gaps must be a tuple"),
                ([], "gaps must be a list of at least one gap"),
                ((y, y), "gaps must be a tuple (y, h, inv2r)"),
                ([gap, y], "gaps[1] must be a tuple"), ([gap, (y, y)], "gaps[1] must be a tuple"),
                ((1.0, y, 1e-3), "y must be an array, got one number"),
                ((y, y[1:], 1e-3), "h must be as long as y along its last axis, 301, or one"),
                ((y, np.ones((2, 301)), np.ones((3, 301))), "the gaps must broadcast"),
                ([gap, (y, y[1:], 1e-3)], "gaps[1] h must be as long as y, 301"),
                ([gap, (y, "h", 1e-3)], "gaps[1] h must be an array"),
                ((np.arange(1e6 + 1), 0.0, 1e-3), "y must have at most 1000000 points")):
            self.refused(bad, solve_many, gaps, load=1e5, says=says)
        for word, says, gaps in (
                ("too_few_points", "5", (y[:0], y[:0], 1e-3)),
                ("too_few_points", "5", (y[:4], y[:4], 1e-3)),
                ("not_finite", "", (y, np.full(301, nan), 1e-3)),
                ("not_increasing", "", (-y, y, 1e-3))):
            self.refused(word, solve_many, gaps, load=1e5, says=says)
        for options, says in (
                ({}, "one of load and penetration must be given, got none"),
                ({"load": 1e5, "penetration": 0.1}, "got both"),
                ({"load": "1"}, "load must be"), ({"load": np.ma.array([1.0])}, "load must be"),
                ({"load": [1e5] * 3, "mu": [0.3] * 2},
                 "shapes must broadcast, got load (3,), mu (2,)"),
                ({"load": 1e5, "creepage": 1.0}, "creepage must be three arrays"),
                ({"load": 1e5, "creepage": np.ones((3, 2))}, "creepage must be three arrays"),
                ({"load": 1e5, "creepage": (0.0, "a", 0.0)}, "creepage[1] must be"),
                ({"load": 1e5, "material": None}, "material must be a faststrip.Material"),
                ({"load": 1e5, "friction": 0.3}, "friction must be a faststrip.Friction"),
                ({"load": 1e5, "normal": "norm"}, "normal must be one of strip"),
                ({"load": 1e5, "tolerance": 0.1}, "tolerance must be None unless"),
                ({"load": 1e5, "threads": 0}, "threads must be a whole number from 1"),
                ({"load": 1e5, "threads": 1.5}, "threads must be a whole number from 1"),
                ({"load": 1e5, "warm_start": True, "chain": 0}, "chain must be a whole number"),
                ({"load": 1e5, "warm_start": "yes"}, "warm_start must be True or False")):
            self.refused(bad, solve_many, gap, says=says, **options)
        for name in ("load", "mu", "speed", "contact_angle"):
            self.refused("not_finite", solve_many, gap, says=f"{name} must be finite",
                         **{"load": 1e5, name: nan})

    def test_the_example_of_its_help(self):
        module = sys.modules["faststrip._many"]
        found = doctest.testmod(module)
        self.assertEqual((found.failed, found.attempted > 3), (0, True))

    def test_results_travel(self):
        many = self.faststrip.solve_many(self.gap, load=[1e5, 2e5], normal="hertz")
        again = pickle.loads(pickle.dumps(many))
        self.np.testing.assert_array_equal(again.fx, many.fx)

    def test_a_fork_after_a_call_does_not_hang(self):
        self.write("forks.py", FORKS)
        done = subprocess.run([sys.executable, "forks.py"], cwd=self.folder, encoding="utf-8",
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False,
                              env={**self.installed.environment, "PYTHONWARNINGS": "ignore",
                                   "PYTHONPATH": str(ROOT / "python"), "HOME": os.getcwd()})
        self.assertEqual((done.stdout, done.stderr), ("0\n", ""))
