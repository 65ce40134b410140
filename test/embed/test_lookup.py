"""A lookup table gives the same forces in every interface; what is none is refused."""

import csv
import math
import subprocess
import sys
import threading

import numpy as np

from installed import HOSTS, ROOT, HostTest, number
from test_allocation import COUNTER

# A state alone and many of them, by both orders; status and allocations.
ALLOCATIONS = r"""
#include <faststrip.h>
#include <stdio.h>
static char bytes[20000000];
static double states[100][8], forces[100][3], jacobians[100][24];
int main(void)
{
    faststrip_lookup *table;
    FILE *file = fopen("table.fslt", "rb");
    size_t length = fread(bytes, 1, sizeof bytes, file);
    int codes[100], order;
    if (faststrip_lookup_open(bytes, length, &table, NULL, 0) != 0) return 1;
    for (int i = 0; i < 100; i++) {
        double state[8] = {5.0, 4.0, 8e4, 0.3, 82000.0, 1e-4 * (i - 50), 1e-4, 1e-5 * (i - 30)};
        for (int k = 0; k < 8; k++) states[i][k] = state[k];
    }
    for (order = 1; order <= 3; order += 2) {
        long before = allocations();
        int status = faststrip_lookup_forces(table, (enum faststrip_lookup_order)order, 100,
                                             states[0], forces[0], jacobians[0], codes);
        status |= faststrip_lookup_forces(table, (enum faststrip_lookup_order)order, 1, states[0],
                                          forces[0], NULL, NULL);
        before = allocations() - before;
        printf("%d %ld\n", status, before);
    }
    return faststrip_lookup_free(&table);
}
"""


class Interfaces(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.package = cls.import_package()
        subprocess.run([str(cls.installed.prefix / "bin" / "faststrip"), "lookup", "make", "-o",
                        "table.fslt", "--error", "0.08", "--ab", "0.8:2", "--tests", "500"],
                       cwd=cls.folder, check=True, stdin=subprocess.DEVNULL)
        cls.table = cls.package.Lookup(cls.folder / "table.fslt")
        cls.compile_host("lookup.c", "by_c")
        cls.lines = cls.shell("./by_c table.fslt").splitlines()

    def test_fixed_form_fortran_has_the_bits_of_c(self):
        self.shell("gfortran -std=legacy -Wall -O1 -ffpe-trap=invalid,zero,overflow"
                   f" '{HOSTS}/lookup.f' $(pkg-config --libs faststrip) -o by_f77")
        self.assertEqual(self.shell("./by_f77").splitlines(), self.lines)
        self.assertEqual(self.lines.count("0"), 2 * 198)
        self.assertEqual((self.lines[1], self.lines.count("105"), self.lines.count("109")),
                         ("105", 2 + 2, 2))

    def test_python_has_them(self):
        about = [number(bits) for bits in self.lines[0].split()]
        table = self.table
        self.assertEqual([table.nu, table.promised, table.tested, table.least_ab, table.most_ab],
                         about[:5])
        self.assertEqual(table.errors.ravel().tolist(), about[5:])
        i = np.arange(200)
        c = 1.0 + i % 7
        a, load = c * (1.0 + 0.01 * (i % 23)), 1e4 + 1e3 * (i % 101)
        load[3], a[4] = 0.0, 1e9
        creepage = 1e-4 * (i % 89 - 44), 1e-4 * (i % 61 - 30), 1e-5 * (i % 37 - 18)
        at = 1
        for order in ("linear", "cubic"):
            found = table(a, c, load, 0.1 + 0.01 * (i % 41), 82000.0, creepage, order=order,
                          jacobian=True)
            at += 1
            for k in i:
                self.assertEqual(found.status[k], int(self.lines[at]))
                forces = [number(bits) for bits in self.lines[at + 1].split()]
                slopes = [number(bits) for bits in self.lines[at + 2].split()]
                if found.status[k] == 0:
                    self.assertEqual(found.forces[k].tolist(), forces)
                    self.assertEqual(found.jacobian[k].T.ravel().tolist(), slopes)
                else:
                    self.assertTrue(np.isnan(found.forces[k]).all())
                    self.assertEqual(forces + slopes, [0.0] * 27)
                at += 3

    def test_arrays_are_broadcast_and_threads_share_a_table(self):
        alone = self.table(5.0, 4.0, 8e4, 0.3, 82000.0, (1e-3, 0.0, 0.0))
        self.assertEqual((alone.forces.shape, alone.status.shape), ((3,), ()))
        grid = self.table(5.0, 4.0, np.full((3, 1), 8e4), 0.3, 82000.0,
                          (np.full(4, 1e-3), 0.0, 0.0), jacobian=True)
        self.assertEqual((grid.forces.shape, grid.jacobian.shape), ((3, 4, 3), (3, 4, 3, 8)))
        self.assertTrue((grid.forces == alone.forces).all())
        frame, dataset = grid.to_pandas(), grid.to_xarray()
        self.assertEqual((len(frame), dict(dataset.sizes)), (12, {"state_0": 3, "state_1": 4}))
        self.assertEqual((frame["fx"][5], float(dataset.mz[1, 2])),
                         (grid.forces[1, 1, 0], grid.forces[1, 2, 2]))
        self.assertEqual((dataset.fy.units, frame.attrs["units"]["mz"]), ("N", "N mm"))
        self.assertEqual(dict(grid.to_xarray(["a", "b"]).sizes), {"a": 3, "b": 4})
        found = []

        def work():
            creepage = np.linspace(-1e-2, 1e-2, 20001)
            found.append(self.table(5.0, 4.0, 8e4, 0.3, 82000.0, (creepage, 1e-3, 1e-5)).forces)

        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertTrue(all((one == found[0]).all() for one in found))

    def test_looking_up_allocates_nothing(self):
        self.write("counted.c", COUNTER + ALLOCATIONS)
        self.shell("gcc -O1 counted.c $(pkg-config --cflags --libs faststrip) -o counted")
        self.assertEqual(self.shell("./counted"), "0 0\n0 0\n")

    def test_times_are_told(self):
        told = dict(line.split() for line in self.shell("./by_c table.fslt time").splitlines())
        self.assertEqual(set(told), {"linear", "cubic", "linear_one_by_one"})
        self.assertTrue(all(float(value) > 0.0 for value in told.values()))

    def test_the_tool_says_what_a_table_is_worth(self):
        words = f"--quick --folder '{self.folder}/worth' --installed '{self.installed.prefix}'"
        self.shell(f"'{sys.executable}' '{ROOT}/tools/measure/lookup.py' {words} 2>/dev/null")
        with open(self.folder / "worth" / "figures.csv", encoding="utf-8") as file:
            found = {row["what"]: float(row["value"]) for row in csv.DictReader(file)}
        self.assertGreater(found["size"], 0.05)
        for force in ("Fx", "Fy", "Mz"):
            # In percent: what was promised, with some room for other contacts.
            self.assertLess(found[f"linear {force} percentile_99"], 3.6)
            self.assertLess(found[f"beside CONTACT {force} mean"], 0.8)
            self.assertGreater(found[f"beside CONTACT {force} worst"], 0.0)
        for name in ("Fortran linear", "Fortran cubic", "C linear", "C cubic", "Python linear",
                     "Python cubic"):
            self.assertGreater(found[f"{name}, with derivatives"], 0.0)

    def test_what_is_none_is_refused(self):
        content = (self.folder / "table.fslt").read_bytes()
        table, none = self.table, (0.0, 0.0, 0.0)
        with self.assertRaises(OSError):
            self.package.Lookup(self.folder / "none.fslt")
        good = (5.0, 4.0, 8e4, 0.3, 82000.0)
        changed = content[:5000] + b"\0" + content[5001:]
        self.all_refused(
            ("lookup table", lambda: self.package.Lookup(b"")),
            ("lookup table", lambda: self.package.Lookup(content[:-1])),
            ("lookup table", lambda: self.package.Lookup(changed)),
            ("lookup table", lambda: self.package.Lookup(b"x" * 100)),
            ("not_finite", lambda: table(5.0, 4.0, math.nan, 0.3, 82000.0, none)),
            ("out_of_range", lambda: table(50.0, 4.0, 1.0, 0.3, 82000.0, none)),
            ("linear or cubic", lambda: table(*good, none, order=2)),
            ("three numbers", lambda: table(*good, 0.0)),
            ("shapes", lambda: table(*good, (np.zeros(3), np.zeros(4), 0.0))),
            ("a must be", lambda: table("5", *good[1:], none)))
        self.shell("printf x >bad.fslt; ./by_c bad.fslt || test $? = 4")
