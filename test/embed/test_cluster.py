"""What runs here and grows elsewhere: many gaps by Dask, a batch as an array job of Slurm."""

import csv
import importlib.util
import subprocess
import sys
import unittest

from installed import ROOT, HostTest

CLUSTER = ROOT / "example" / "cluster"
CASES = ROOT / "example" / "traction_curve.csv"


class Cluster(HostTest):
    def slurm(self, *words, **environment):
        """The script as a task, or a job without an array; the installed program is found."""
        path = f"{self.installed.prefix}/bin:{self.installed.environment['PATH']}"
        return subprocess.run(
            ["sh", CLUSTER / "batch_array.sh", *words], cwd=self.folder, encoding="utf-8",
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=600, check=False,
            env={**self.installed.environment, "PATH": path, **environment})

    def test_an_array_job_has_the_bytes_of_one_run(self):
        self.shell(f"'{self.installed.prefix}/bin/faststrip' batch '{CASES}' -o one.csv")
        # Tasks in any order; one comes twice, as one that is queued again.
        for task in (3, 1, 2, 1):
            if task == 2:
                done = self.slurm(CASES, "all.csv")
                self.assertEqual(done.returncode, 1)
                self.assertIn("part", done.stderr)
                self.assertFalse((self.folder / "all.csv").exists())
            done = self.slurm(CASES, "all.csv", SLURM_ARRAY_TASK_ID=str(task),
                              SLURM_ARRAY_TASK_COUNT="3", SLURM_CPUS_PER_TASK="2")
            self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        done = self.slurm(CASES, "all.csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "all.csv").read_bytes(),
                         (self.folder / "one.csv").read_bytes())
        self.assertIn("the results", self.slurm(CASES).stderr)

    @unittest.skipUnless(importlib.util.find_spec("dask") and
                         importlib.util.find_spec("distributed"),
                         "dask.distributed is not installed: tools/requirements-test.txt has it")
    def test_many_gaps_by_two_workers_of_dask(self):
        said = self.shell(f"'{sys.executable}' '{CLUSTER}/gaps_by_dask.py' -o dask.csv"
                          " --displacements 11", PYTHONPATH=str(ROOT / "python"))
        self.assertRegex(said, r"^1089 contacts in 2 tasks: \{'ok': \d+")
        with (self.folder / "dask.csv").open(encoding="utf-8") as lines:
            rows = list(csv.DictReader(lines))
        self.assertEqual(len(rows), 1089)
        faststrip = self.import_package()
        for row in rows[::137]:
            alone = faststrip.contact(
                "s1002", "60e1", float(row["y"]), vertical_load=float(row["vertical_load"]),
                creepage=(float(row["cksi"]), 0.0, self.spin(faststrip, float(row["y"]))))
            self.assertEqual(row["word"], alone.word)
            for name in ("load", "fx", "fy", "pmax"):
                self.assertAlmostEqual(float(row[name]), getattr(alone, name),
                                       delta=1e-9 * abs(getattr(alone, name)), msg=name)

    @staticmethod
    def spin(faststrip, y):
        return faststrip.contact("s1002", "60e1", y, load=8e4, tangential="none").cphi
