"""The Python package: installed by pip, found, its arrays, its exceptions."""

import concurrent.futures
import copy
import decimal
import gc
import importlib
import pickle
import re
import signal
import subprocess
import sys
import threading
import time

from installed import ROOT, HostTest


class Package(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.shell(f"cp -r '{ROOT}/python' source")
        cls.shell(f"'{sys.executable}' -m pip install --quiet --no-deps --no-index"
                  " --no-build-isolation --target site ./source")

    def python(self, text, **environment):
        return self.shell(f"'{sys.executable}' -c '{text}'", PYTHONPATH="site", **environment)

    def test_pip_installs_the_package(self):
        names = sorted(path.name for path in (self.folder / "site" / "faststrip").iterdir())
        mine = sorted(path.name for path in (ROOT / "python" / "faststrip").iterdir())
        for found in (names, mine):
            if "__pycache__" in found:
                found.remove("__pycache__")
        self.assertEqual(names, mine)
        self.assertLessEqual({"__init__.py", "_library.py", "_many.py", "py.typed"}, set(names))

    def test_the_example_of_its_help(self):
        self.python("import doctest, faststrip, sys; "
                    "sys.exit(doctest.testmod(faststrip).failed"
                    " or not doctest.testmod(faststrip).attempted)")

    def test_the_library_is_found_by_every_way(self):
        prefix = self.installed.prefix
        show = "import faststrip; print(faststrip.library_version())"
        base = {"FASTSTRIP_PREFIX": None, "LD_LIBRARY_PATH": None, "PKG_CONFIG_PATH": None}
        ways = ({"FASTSTRIP_PREFIX": str(prefix)},
                {"FASTSTRIP_LIBRARY": str(self.installed.library)},
                {"PKG_CONFIG_PATH": str(prefix / "lib" / "pkgconfig")},
                {"LD_LIBRARY_PATH": str(prefix / "lib")})
        for way in ways:
            with self.subTest(way):
                done = self.bare(show, {**base, **way})
                self.assertEqual(done.stdout.strip(), "0.1.0", done.stderr)
        for way in ({}, {"FASTSTRIP_PREFIX": "/nowhere"}, {"FASTSTRIP_LIBRARY": "/dev/null"}):
            with self.subTest(way):
                done = self.bare(show, {**base, **way})
                self.assertIn("LibraryNotFound: no libfaststrip", done.stderr)

    def bare(self, text, changes):
        environment = {**self.installed.environment, "PYTHONPATH": str(self.folder / "site")}
        for name, value in changes.items():
            environment.pop(name, None)
            if value is not None:
                environment[name] = value
        return subprocess.run([sys.executable, "-c", text], cwd=self.folder, env=environment,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8",
                              check=False)


POOL = """
import multiprocessing, sys, faststrip, numpy

def work(load):
    y = numpy.linspace(-15.0, 15.0, 301)
    contact = faststrip.Contact(normal="hertz")
    contact.set_gap(y, 2e-3 * y**2, 1.0 / 920.0)
    return contact.solve(load=load)

if __name__ == "__main__":
    with multiprocessing.get_context(sys.argv[1]).Pool(2) as pool:
        print(pool.apply_async(work, (1e5,)).get(60).word)
        try:
            pool.apply_async(work, (-1.0,)).get(60)
        except faststrip.FaststripError as problem:
            print(problem.status, problem.word, problem)
        print(pool.apply_async(work, (2e5,)).get(60).word)
"""

# Strips by which two valleys take many seconds.
LONG_CALL = """
import os, sys, time, faststrip, numpy
y = numpy.linspace(-15.0, 15.0, 601)
gap = y, 4e-5 * (y * y - 40.0)**2, 1.0 / 920.0
contact = faststrip.Contact(strips_per_patch=1000)
contact.set_gap(*gap)
print("ready", flush=True)
try:
    contact.solve(load=1e5)
    print("done", flush=True)
except KeyboardInterrupt:
    print("interrupted", time.monotonic(), flush=True)
try:
    contact.solve(load=1e5)
except faststrip.FaststripError as problem:
    print(problem, flush=True)
contact.set_gap(*gap)
other = faststrip.Contact()
other.set_gap(*gap)
print(other.solve(load=1e5).word, flush=True)
del contact
"""


class Processes(HostTest):
    """Signals and other processes."""

    def start(self, name, text, *words):
        self.write(name, text)
        return subprocess.Popen(
            [sys.executable, name, *words], cwd=self.folder, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, encoding="utf-8",
            # A shell starts what runs in its background with Ctrl-C ignored.
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
            env={**self.installed.environment, "PYTHONPATH": str(ROOT / "python")})

    def test_errors_come_back_from_a_pool(self):
        for way in ("fork", "spawn"):
            with self.subTest(way), self.start("pool.py", POOL, way) as process:
                try:
                    text, _ = process.communicate(timeout=120)
                finally:
                    process.kill()
                self.assertRegex(text, r"\Aok\n105 bad_load bad_load: .*-1.*\nok\n\Z")

    def test_ctrl_c_ends_a_long_call(self):
        with self.start("long.py", LONG_CALL) as process:
            try:
                self.assertEqual(process.stdout.readline(), "ready\n")
                time.sleep(1.0)  # by then it is in the library, also on a busy machine
                sent = time.monotonic()
                process.send_signal(signal.SIGINT)
                word, when = process.stdout.readline().split()
                self.assertEqual(word, "interrupted")
                self.assertLess(float(when) - sent, 1.0)
                rest = process.stdout.read()
                self.assertEqual(process.wait(60), 0)
            finally:
                process.kill()
        self.assertEqual(rest, "bad_argument: the last call was interrupted: set the gap again\n"
                               "ok\n")


class Contacts(HostTest):
    """In this process, from the checkout."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.faststrip, cls.numpy = cls.import_package(), importlib.import_module("numpy")
        cls.y = cls.numpy.linspace(-15.0, 15.0, 601)
        cls.gap = (cls.y, 2e-3 * cls.y**2, 1.0 / 920.0)

    def contact(self, **options):
        contact = self.faststrip.Contact(**options)
        contact.set_gap(*self.gap)
        return contact

    def test_the_older_name_of_the_inclination(self):
        contact = self.faststrip.Contact()
        contact.set_gap(*self.gap, turn=0.1 * self.y)
        self.assertEqual(contact.solve(load=1e5).word, "conformal")
        contact.set_gap(*self.gap, inclination=0.0)
        self.assertEqual(contact.solve(load=1e5).word, "ok")
        self.refused("bad_argument", contact.set_gap, *self.gap, inclination=0.0, turn=0.0,
                     says="given twice")

    def test_a_longer_gap_gets_capacity(self):
        contact = self.faststrip.Contact(max_points=10)
        contact.set_gap(*self.gap)
        self.assertEqual(contact.solve(load=1e5).word, "ok")

    def test_threads_of_python_give_the_serial_results(self):
        def work(first):
            contact = self.contact()
            return [contact.solve(load=1e4 * (i + 1)) for i in range(first, 40, 4)]

        serial = [work(first) for first in range(4)]
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            self.assertEqual(list(pool.map(work, range(4))), serial)

    def test_other_kinds_of_arrays(self):
        contact = self.faststrip.Contact()
        wanted = self.contact().solve(load=1e5)
        y = self.numpy.repeat(self.y, 2)[::2]
        contact.set_gap(y, list(self.gap[1]), self.numpy.full(601, 1.0 / 920.0))
        self.assertEqual(contact.solve(load=1e5), wanted)

    def test_errors_are_pickled_and_copied(self):
        with self.assertRaises(self.faststrip.FaststripError) as caught:
            self.contact().solve(load=-1.0)
        problem = caught.exception
        problem.where = "here"
        for again in (pickle.loads(pickle.dumps(problem)), copy.copy(problem),
                      copy.deepcopy(problem)):
            self.assertIs(type(again), self.faststrip.FaststripError)
            self.assertEqual((str(again), again.args, again.status, again.word, again.message,
                              again.where),
                             (str(problem), problem.args, 105, "bad_load", problem.message, "here"))
        for call in (copy.copy, copy.deepcopy, pickle.dumps):
            with self.assertRaisesRegex(TypeError, "cannot be copied or pickled"):
                call(self.contact())

    def test_the_constructor_says_what_is_wrong(self):
        np, contact = self.numpy, self.faststrip.Contact
        wrong_numbers = (1.7, 15.0, np.float64(15.0), 2**32 + 5, 2**64, -3, 0, True, np.True_, None,
                         "15", b"15", 1j, np.array([15]), np.ma.masked, float("nan"),
                         decimal.Decimal(15))
        for name in ("strips_per_patch", "points_per_strip", "max_points"):
            for value in wrong_numbers:
                with self.subTest(name, value=value):
                    self.refused("bad_argument", contact, says=f"{name} must be a whole number",
                                 **{name: value})
        for grid in (50, (50,), (50, 50, 50), None, "ab", "50", (50, None), (1.5, 50), (50, 0),
                     (True, 50), (2**32 + 5, 50), {50: 50, 20: 20}, (50, 10001)):
            with self.subTest(grid=grid):
                self.refused("bad_argument", contact, says="fastsim_grid must be",
                             fastsim_grid=grid)
        for value in ("yes", None, 2, 1.0, [], np.array([True])):
            with self.subTest(value=value):
                self.refused("bad_argument", contact, says="with_elements must be True or False",
                             with_elements=value)
            self.refused("bad_argument", contact, says="estimate must be True or False",
                         estimate=value)
        for value in (0.0, -0.0, -0.1, float("nan"), -np.inf, -10**400, np.float32("nan"), None,
                      "0.1", b"1", True, 1j, [0.1], np.array([0.1]), np.ma.masked, object()):
            for name in ("resolution_limit", "force_limit"):
                with self.subTest(name=name, value=value):
                    self.refused("bad_argument", contact, **{name: value},
                                 says=f"{name} must be a number above 0, got ")
        for value in (1, 10**400, np.inf, np.float32(0.5), np.array(0.5), decimal.Decimal("0.5")):
            made = self.contact(resolution_limit=value, force_limit=value)
            self.assertEqual(made.solve(load=1e5), self.contact().solve(load=1e5))
        for name in ("normal", "tangential"):
            for value in (None, 1, [], "Strip", ""):
                self.refused("bad_argument", contact, says=f"{name} must be one of ",
                             **{name: value})
                self.refused("bad_argument", contact, says=f", got {value!r}", **{name: value})
        self.refused("bad_argument", contact, strips_per_patch="many", says="'many'")
        self.refused("bad_argument", contact, strips_per_patch=1001, says="got 1001")
        self.refused("bad_argument", contact, tangential="polach", with_elements=True,
                     says="polach gives forces only")
        for value in (np.int8(7), np.uint64(7), np.array(7), np.int64(7)):
            made = contact(strips_per_patch=value, points_per_strip=value, max_points=value,
                           fastsim_grid=(value, value), with_elements=np.True_)
            made.set_gap(self.y[::100], 2e-3 * self.y[::100]**2, 1e-3)
            self.assertEqual(made.solve(load=1e3).n_strips, 7)

    def test_each_limit_is_that_of_its_own_errors(self):
        for options, word in (({"resolution_limit": 1e-6}, "under_resolved"),
                              ({"force_limit": 1e-6}, "under_resolved"),
                              ({"resolution_limit": 1e-6, "tangential": "none"}, "under_resolved"),
                              ({"force_limit": 1e-6, "tangential": "none"}, "ok"),
                              ({"resolution_limit": 1e-6, "estimate": False}, "ok")):
            with self.subTest(**options):
                result = self.contact(**options).solve(load=1e5, creepage=(1e-3, 5e-4, 1e-4))
                self.assertEqual(result.word, word)

    def test_auto_of_which_nothing_is_said_and_within_a_budget(self):
        contact = self.contact(normal="auto")
        contact.set_gap(self.y, 2e-3 * self.y**2 + 3e-5 * self.y**3, 1.0 / 920.0)
        creepage = (1e-3, 5e-4, 1e-4)
        self.assertEqual(contact.solve(load=1e5, creepage=creepage),
                         contact.solve(load=1e5, creepage=creepage, target="forces",
                                       tolerance=0.02))
        # In no time one step; in any time the same as without a tolerance that can be met.
        least = contact.solve(load=1e5, target="area", budget_us=1e-3)
        self.assertEqual((len(least.steps), least.target_is_met), (1, None))
        most = contact.solve(load=1e5, target="area", budget_us=1e9)
        self.assertGreater(len(most.steps), 1)
        self.assertLess(most.est_err_target, least.est_err_target)
        both = contact.solve(load=1e5, target="area", tolerance=1e-9, budget_us=1e-3)
        self.assertEqual((both.word, len(both.steps)), ("target_missed", 1))
        other = self.contact().solve(load=1e5)
        self.assertEqual((other.est_err_target, other.target_is_met, other.steps), (None, None, ()))

    def test_what_is_wanted_is_refused_by_name(self):
        np, contact = self.numpy, self.contact(normal="auto")
        for value in ("Forces", "", 1, [], np.array(1)):
            self.refused("bad_argument", contact.solve, load=1e5, target=value,
                         says="target must be one of forces, pmax, penetration, area, power, got ")
        for name in ("tolerance", "budget_us"):
            for value in ("1", True, 1j, [0.1], np.array([0.1]), np.ma.masked, object()):
                self.refused("bad_argument", contact.solve, load=1e5, **{name: value},
                             says=f"{name} must be a number")
            self.refused("bad_argument", contact.solve, load=1e5, **{name: -0.5},
                         says=f"{name} must be a number from 0 on, got -0.5")
            for value in (np.nan, np.inf, 10**400):
                self.refused("not_finite", contact.solve, load=1e5, **{name: value},
                             says=f"{name} must be finite")
        self.refused("bad_argument", contact.solve, load=1e5, tolerance=0, says="both are 0")
        self.refused("bad_argument", self.contact(normal="auto", tangential="none").solve, load=1e5,
                     says="the target forces needs a tangential method, got none")
        for name, value in (("target", "pmax"), ("tolerance", 0.1), ("budget_us", 0.0)):
            self.refused("bad_argument", self.contact().solve, load=1e5, **{name: value},
                         says=f"{name} must be None unless normal is 'auto', got {value!r}")

    def test_targets_are_those_of_the_library(self):
        source = (ROOT / "src/faststrip/contact/wanted.f90").read_text(encoding="utf-8")
        header = (ROOT / "include/faststrip.h").read_text(encoding="utf-8")
        package = sys.modules["faststrip._contact"]
        names = re.search(r"target_names\(5\) = \[.*?::(.*?)\]", source, re.DOTALL)[1]
        self.assertEqual(re.findall(r"'(\w+)'", names), list(package.TARGETS))
        for name, value in package.TARGETS.items():
            self.assertRegex(source, rf"target_{name} = {value}\b")
            self.assertRegex(header, rf"FASTSTRIP_TARGET_{name.upper()} = {value}\b")
        self.assertIn(f"tolerance = {package.TOLERANCE}_wp", source)

    def test_limits_are_those_of_the_library(self):
        sources = "".join((ROOT / "src" / "faststrip" / f"{name}.f90").read_text(encoding="utf-8")
                          for name in ("tangential/types", "geometry/gap/gap"))
        package = sys.modules["faststrip._contact"]
        for name, limit in (("most_points", package.MOST_STRIPS),
                            ("most_points", package.MOST_POINTS),
                            ("most_rows", package.MOST_ROWS),
                            ("min_gap_points", package.GAP_POINTS[0])):
            self.assertEqual(re.findall(rf"\b{name} = (\d+)", sources), [str(limit)], name)
        limits = (ROOT / "src" / "faststrip" / "base" / "limits.f90").read_text(encoding="utf-8")
        self.assertIn(f"most_points = {package.GAP_POINTS[1]}\n", limits)

    def test_gaps_are_refused_by_name(self):
        np, y = self.numpy, self.y
        contact = self.faststrip.Contact()
        good = {"y": y, "h": 2e-3 * y**2, "inv2r": np.full(601, 1e-3), "inclination": np.zeros(601)}
        nan, hole = y.copy(), [*y]
        nan[3], hole[7] = np.nan, None
        for name in good:
            for value in (np.ma.array(y), np.ma.masked_less(y, 0.0), y + 0j, y > 0.0,
                          y.astype(str), y.astype("M8[s]"), "abc", {}, hole, [[1.0], [1.0, 2.0]],
                          np.array([y]), [*map(str, y)], object()):
                with self.subTest(name, value=str(value)[:20]):
                    self.refused("bad_argument", contact.set_gap, says=name,
                                 **{**good, name: value})
            if name != "inclination":
                self.refused("bad_argument", contact.set_gap, says=f"{name} must be",
                             **{**good, name: None})
            if name != "y":
                for value in (y[1:], y[:1], []):
                    self.refused("bad_argument", contact.set_gap, says=f"{name} must be as long as "
                                 f"y, 601, or one number, got {len(value)}",
                                 **{**good, name: value})
            for value in (nan, -np.inf) if name != "y" else (nan,):
                self.refused("not_finite", contact.set_gap, says=name, **{**good, name: value})
        self.refused("bad_argument", contact.set_gap, np.arange(1e6 + 1), 0.0, 0.0, says="1000000")
        with self.assertRaises(self.faststrip.FaststripError):
            contact.solve(load=1e5)
        wanted = self.contact().solve(load=1e5)
        for kind in (np.float32, np.longdouble, object, ">f8"):
            contact.set_gap(y.astype(kind) if kind != np.float32 else y, self.gap[1].astype(
                kind if kind != np.float32 else float), 1.0 / 920.0)
            self.assertEqual(contact.solve(load=1e5), wanted)

    def test_numbers_are_refused_by_name(self):
        np, contact, faststrip = self.numpy, self.contact(), self.faststrip
        good = {"load": 1e5, "mu": 0.3}
        for name in ("load", "mu", "penetration"):
            rest = {key: value for key, value in good.items() if key != "load" or name == "mu"}
            for value in ("1e5", True, 1j, np.complex128(1.0), [1e5], np.array([1e5]), np.ma.masked,
                          np.ma.array(1.0), b"1", object(), *((None,) if name == "mu" else ())):
                with self.subTest(name, value=value):
                    self.refused("bad_argument", contact.solve, says=f"{name} must be a number",
                                 **{**rest, name: value})
            for value in (float("inf"), -np.inf, np.nan, np.float32("nan"), 10**400):
                self.refused("not_finite", contact.solve, says=f"{name} must be finite",
                             **{**rest, name: value})
        for value in (None, 1.0, (1.0, 2.0), "abc", (0.0, 0.0, 0.0, 0.0), (0.0, "0", 0.0),
                      np.ma.zeros(3), {1.0, 2.0, 3.0}, (0.0, 1j, 0.0)):
            self.refused("bad_argument", contact.solve, load=1e5, creepage=value, says="creepage")
        self.refused("not_finite", contact.solve, load=1e5, creepage=(0.0, np.nan, 0.0),
                     says="creepage[1]")
        for value in (None, 2e5, (2e5, 2e5, 0.3, 0.3)):
            self.refused("bad_argument", contact.solve, load=1e5, material=value, says="material")
        self.refused("bad_argument", contact.solve, load=1e5,
                     material=faststrip.Material(nu_rail="0.3"), says="material.nu_rail")
        self.refused("bad_argument", contact.solve, load=1e5, warm_start=None, says="warm_start")
        self.refused("bad_argument", contact.copy_from, None, says="other must be a Contact")
        self.refused("bad_argument", faststrip.hertz, "1", 1.0, 1.0, says="inv2r_x")
        self.refused("no_hertz_ellipse", faststrip.hertz, 0.0, 1.0, 1.0, says="inv2r_x = 0.0")
        self.refused("not_finite", faststrip.kalker, np.nan, says="a_over_b")
        self.refused("out_of_range", faststrip.kalker, 0.0, says="a_over_b = 0.0")
        ellipse = {"a": 6.0, "b": 5.0, "coefficients": (4.0, 4.0, 1.5), "creepage": (0.0, 0.0, 0.0),
                   "mu": 0.3, "load": 1e5}
        for name in ellipse:
            self.refused("bad_argument", faststrip.fastsim, says=name, **{**ellipse, name: None})
        self.refused("bad_argument", faststrip.fastsim, says="grid", **ellipse, grid=(2**32 + 5, 5))
        self.refused("bad_argument", faststrip.fastsim, says="load = -1.0",
                     **{**ellipse, "load": -1})
        wanted = contact.solve(load=1e5, creepage=(1e-3, 0.0, 0.0))
        for load in (100000, np.float32(1e5), np.array(1e5), np.int64(100000),
                     decimal.Decimal(100000)):
            for creepage in ([1e-3, 0, 0], np.array([1e-3, 0.0, 0.0]), (np.float64(1e-3), 0, 0)):
                self.assertEqual(contact.solve(load=load, creepage=creepage), wanted)

    def test_a_contact_serves_one_thread_at_a_time(self):
        contact = self.contact(strips_per_patch=200)
        alone = contact.solve(load=1e5)
        answers = []

        def work():
            for _ in range(5):
                try:
                    answers.append(contact.solve(load=1e5))
                except self.faststrip.FaststripError as problem:
                    answers.append(str(problem))

        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertIn("bad_argument: the contact is in use by another thread", answers)
        self.assertIn(alone, answers)
        self.assertEqual({answer for answer in answers if isinstance(answer, str)},
                         {"bad_argument: the contact is in use by another thread"})
        for answer in answers:
            self.assertTrue(isinstance(answer, str) or answer == alone, answer)

    def test_the_memory_of_a_running_call_stays(self):
        contact = self.contact(strips_per_patch=400)
        thread = threading.Thread(target=contact.solve, kwargs={"load": 1e5})
        thread.start()
        contact.close()
        del contact
        gc.collect()
        thread.join()

    def test_errors_have_a_word_and_say_what(self):
        contact, faststrip, y = self.contact(), self.faststrip, self.y
        for word, says, call, values, options in (
                ("bad_load", "-1.0", contact.solve, (), {"load": -1.0}),
                ("no_contact", "", contact.solve, (), {"penetration": -0.1}),
                ("bad_material", "", contact.solve, (),
                 {"load": 1e5, "material": faststrip.Material(e_rail=0.0)}),
                ("bad_argument", "", contact.solve, (), {}),
                ("bad_argument", "", contact.solve, (), {"load": 1.0, "penetration": 1.0}),
                ("bad_argument", "strip", faststrip.Contact, (), {"normal": "norm"}),
                ("not_increasing", "", contact.set_gap, (-y, y, 0.0), {}),
                ("too_few_points", "", contact.set_gap, ([0.0, 1.0], [0.0, 1.0], 0.0), {}),
                ("bad_argument", "", faststrip.fastsim,
                 (0.0, 1.0, (4.0, 4.0, 1.5), (0.0, 0.0, 0.0), 0.3, 1.0), {})):
            with self.subTest(word, call=call.__name__, options=options):
                self.refused(word, call, *values, says=says, **options)
        contact.close()
        self.refused("bad_argument", contact.solve, load=1e5)
