#!/usr/bin/env python3
"""Run the unittest files test_*.py of some folders, or some files, and count them.

    run_pytests.py [--filter TEXT] [--jobs N] [--whole FOLDER] [--times] FOLDER|FILE...

With --jobs files are run N at a time, each in a process of its own, but those of the folder of
--whole, which share what they install, in one. The last line is
`all modules together: N passed, N failed[, N skipped]`; exit 1 if any failed or none ran. With
--filter only tests run whose `folder/module::class.test` contains TEXT. With --times each file's
line ends with the processor seconds of its tests and of what they ran. All files share a folder for
runs that several tests look at (test/shared_runs.py); it is gone afterwards.
"""

import argparse
import concurrent.futures
import importlib.util
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import unittest

TOGETHER = "all modules together:"
# Names the folder of shared runs to test/shared_runs.py.
SHARED_RUNS = "FASTSTRIP_SHARED_RUNS"


class Counts(unittest.TestResult):
    """Counts tests, not their subtests, and tells of a failure at once."""

    def __init__(self):
        super().__init__()
        self.started = set()
        self.bad = set()

    def startTest(self, test):
        super().startTest(test)
        self.started.add(test.id())

    def addFailure(self, test, err):
        super().addFailure(test, err)
        self.tell(test, self.failures[-1][1])

    def addError(self, test, err):
        super().addError(test, err)
        self.tell(test, self.errors[-1][1])

    def addSubTest(self, test, subtest, err):
        super().addSubTest(test, subtest, err)
        if err is not None:
            self.tell(test, f"{subtest}\n{self._exc_info_to_string(err, subtest)}")

    def addSkip(self, test, reason):
        super().addSkip(test, reason)
        self.started.add(test.id())
        print(f"skipped {test.id()}: {reason}", flush=True)

    def addUnexpectedSuccess(self, test):
        super().addUnexpectedSuccess(test)
        self.tell(test, "passed although it was expected to fail\n")

    def tell(self, test, text):
        self.started.add(test.id())
        self.bad.add(test.id())
        print(f"FAILED {test.id()}\n{text}", flush=True)

    def totals(self):
        skipped = {test.id() for test, _ in self.skipped} - self.bad
        return len(self.started - self.bad - skipped), len(self.bad), len(skipped)


def load(path, title):
    """The tests of one file; a file that cannot be imported is a failing test."""
    name = title.replace("/", "_")
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    sys.path.insert(0, str(path.parent))
    try:
        spec.loader.exec_module(module)
    except (Exception, SystemExit) as problem:
        error = problem

        def cannot_import():
            raise error

        return unittest.TestSuite([unittest.FunctionTestCase(cannot_import, description=title)])
    finally:
        sys.path.remove(str(path.parent))
    return unittest.defaultTestLoader.loadTestsFromModule(module)


def flatten(suite):
    for item in suite:
        if isinstance(item, unittest.TestSuite):
            yield from flatten(item)
        else:
            yield item


def summary(totals):
    passed, failed, skipped = totals
    return f"{passed} passed, {failed} failed" + (f", {skipped} skipped" if skipped else "")


def seconds():
    """Processor time of this process and of those that it has waited for."""
    return sum(sum(resource.getrusage(who)[:2])
               for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))


def run_here(paths, text, times):
    """Run files one after the other; what they count together."""
    together = [0, 0, 0]
    for path in paths:
        title = f"{path.parent.as_posix()}/{path.stem}"
        start = seconds()
        suite = unittest.TestSuite(
            test
            for test in flatten(load(path, title))
            if text in f"{title}::{'.'.join(test.id().split('.')[1:])}"
        )
        if suite.countTestCases() == 0:
            continue
        counts = Counts()
        suite.run(counts)
        together = [a + b for a, b in zip(together, counts.totals())]
        spent = f", {seconds() - start:.1f} s" if times else ""
        print(f"{title:43} {summary(counts.totals())}{spent}", flush=True)
    return together


def run_apart(paths, text, times):
    """Run files in a process of their own; what it counts, and what it says before that."""
    done = subprocess.run([sys.executable, __file__, "--filter", text,
                           *(["--times"] if times else []), *paths],
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, encoding="utf-8", errors="replace",
                          check=False)
    said, found, last = done.stdout.rpartition(TOGETHER)
    numbers = [int(n) for n in re.findall(r"\d+", last)] if found else []
    if len(numbers) < 2:
        names = ", ".join(str(path) for path in paths)
        return [0, 1, 0], f"{done.stdout}FAILED {names}: exit code {done.returncode}\n"
    return [*numbers, 0][:3], said


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--filter", default="")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--whole", type=pathlib.Path)
    parser.add_argument("--times", action="store_true")
    parser.add_argument("folders", nargs="+", type=pathlib.Path, metavar="FOLDER")
    options = parser.parse_args()
    if SHARED_RUNS in os.environ:
        return run_files(options)
    with tempfile.TemporaryDirectory() as folder:
        os.environ[SHARED_RUNS] = folder
        return run_files(options)


def run_files(options):
    files = [path for folder in options.folders
             for path in ([folder] if folder.is_file() else sorted(folder.glob("test_*.py")))]
    if options.jobs == 1:
        together = run_here(files, options.filter, options.times)
    else:
        whole = [path for path in files if path.parent == options.whole]
        units = [[path] for path in files if path.parent != options.whole]
        if whole:
            # The longest first.
            units.insert(0, whole)
        together = [0, 0, 0]
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            runs = [pool.submit(run_apart, unit, options.filter, options.times) for unit in units]
            for run in concurrent.futures.as_completed(runs):
                totals, said = run.result()
                together = [a + b for a, b in zip(together, totals)]
                print(said, end="", flush=True)
    print(f"{TOGETHER:43} {summary(together)}")
    return 0 if together[0] > 0 and together[1] == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
