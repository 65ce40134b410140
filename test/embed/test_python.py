"""The Python package: installed by pip, found, its arrays, its exceptions."""

import concurrent.futures
import os
import subprocess
import sys
import unittest

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
        self.assertEqual([name for name in names if name != "__pycache__"],
                         ["__init__.py", "_contact.py", "_library.py", "py.typed"])

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


class Contacts(HostTest):
    """In this process, from the checkout."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        os.environ["FASTSTRIP_PREFIX"] = str(cls.installed.prefix)
        sys.path.insert(0, str(ROOT / "python"))
        try:
            import faststrip
            import numpy
        finally:
            sys.path.remove(str(ROOT / "python"))
            del os.environ["FASTSTRIP_PREFIX"]
        cls.faststrip, cls.numpy = faststrip, numpy
        cls.y = numpy.linspace(-15.0, 15.0, 601)
        cls.gap = (cls.y, 2e-3 * cls.y**2, 1.0 / 920.0)

    def contact(self, **options):
        contact = self.faststrip.Contact(**options)
        contact.set_gap(*self.gap)
        return contact

    def refused(self, word, call, *values, says="", **options):
        with self.assertRaises(self.faststrip.FaststripError) as caught:
            call(*values, **options)
        self.assertEqual(caught.exception.word, word)
        self.assertGreaterEqual(caught.exception.status, 100)
        self.assertIn(says, str(caught.exception))

    def test_strips_and_elements_add_up(self):
        for tangential in ("faststrip", "fastsim"):
            contact = self.contact(tangential=tangential, with_elements=True)
            result = contact.solve(load=1e5, creepage=(1e-3, -5e-4, 1e-4))
            strips, elements = contact.strips(), contact.elements()
            self.assertEqual(len(strips.p0), result.n_strips)
            self.assertEqual(len(elements.px), result.n_elements)
            load = (0.5 * self.numpy.pi * strips.p0 * strips.half_length
                    * (strips.y_right - strips.y_left)).sum()
            self.assertAlmostEqual(load, 1e5, delta=1e-6)
            self.assertAlmostEqual((elements.px * elements.area).sum(), result.fx, delta=1e-6)
            self.assertEqual(set(strips.patch), {1})
            self.assertLessEqual(set(elements.state), {1, 2})

    def test_methods_and_classics_belong_together(self):
        faststrip = self.faststrip
        result = self.contact(normal="hertz", tangential="fastsim").solve(
            load=1e5, creepage=(1e-3, -5e-4, 1e-4))
        a, b, penetration, pmax = faststrip.hertz(1.0 / 920.0, 2e-3, 1e5)
        self.assertAlmostEqual(result.penetration, penetration, delta=1e-9)
        self.assertAlmostEqual(result.pmax, pmax, delta=1e-6)
        forces = faststrip.fastsim(a, b, faststrip.kalker(a / b)[:3], (1e-3, -5e-4, 1e-4), 0.3, 1e5)
        self.assertAlmostEqual(result.fx, forces[0], delta=1e-4)
        self.assertAlmostEqual(result.fy, forces[1], delta=1e-4)
        self.assertEqual(self.contact(tangential="none").solve(load=1e5).fx, 0.0)

    def test_penetration_warm_start_auto_and_copy(self):
        contact = self.contact(strips_per_patch="auto")
        cold = contact.solve(load=1e5)
        again = contact.solve(penetration=cold.penetration)
        self.assertAlmostEqual(again.load, 1e5, delta=1.0)
        saved = self.contact(strips_per_patch="auto")
        saved.copy_from(contact)
        first = contact.solve(load=1.1e5, warm_start=True)
        self.assertEqual(saved.solve(load=1.1e5, warm_start=True), first)
        self.assertAlmostEqual(first.penetration, self.contact().solve(load=1.1e5).penetration,
                               delta=1e-4)

    def test_limitations_are_no_errors(self):
        contact = self.faststrip.Contact()
        contact.set_gap(*(values[260:341] if hasattr(values, "__len__") else values
                          for values in self.gap))
        result = contact.solve(load=1e5)
        self.assertEqual((result.status, result.word), (2, "edge_of_data"))

    def test_surfaces_that_turn_are_conformal(self):
        contact = self.faststrip.Contact()
        contact.set_gap(*self.gap, turn=0.1 * self.y)
        self.assertEqual(contact.solve(load=1e5).word, "conformal")
        contact.set_gap(*self.gap, turn=0.0)
        self.assertEqual(contact.solve(load=1e5).word, "ok")

    def test_a_longer_gap_gets_room(self):
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

    def test_errors_have_a_word_and_say_what(self):
        contact = self.contact()
        nan = float("nan")
        self.refused("bad_load", contact.solve, load=-1.0, says="-1.0")
        self.refused("not_finite", contact.solve, load=nan)
        self.refused("not_finite", contact.solve, load=1e5, mu=nan)
        self.refused("no_contact", contact.solve, penetration=-0.1)
        self.refused("bad_material", contact.solve, load=1e5,
                     material=self.faststrip.Material(e_rail=0.0))
        self.refused("bad_argument", contact.solve)
        self.refused("bad_argument", contact.solve, load=1.0, penetration=1.0)
        self.refused("bad_argument", self.faststrip.Contact, normal="norm", says="strip")
        self.refused("bad_argument", self.faststrip.Contact, strips_per_patch=-1)
        self.refused("bad_argument", contact.set_gap, self.y, self.y[1:], 0.0)
        self.refused("bad_argument", contact.set_gap, [self.y], self.y, 0.0)
        self.refused("not_increasing", contact.set_gap, -self.y, self.y, 0.0)
        self.refused("too_few_points", contact.set_gap, [0.0, 1.0], [0.0, 1.0], 0.0)
        self.refused("bad_argument", self.faststrip.fastsim, 0.0, 1.0, (4.0, 4.0, 1.5),
                     (0.0, 0.0, 0.0), 0.3, 1.0)
        self.refused("no_hertz_ellipse", self.faststrip.hertz, 0.0, 1.0, 1.0)
        self.refused("out_of_range", self.faststrip.kalker, 0.0)
        contact.close()
        self.refused("bad_argument", contact.solve, load=1e5)


if __name__ == "__main__":
    unittest.main()
