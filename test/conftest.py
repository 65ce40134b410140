"""What pytest does not know of these tests: where runs are shared (shared_runs.py), which a TEXT
names, and how they are counted in one line."""

import os
import tempfile

# Names the folder of shared runs to shared_runs.py, in all processes.
SHARED_RUNS = "FASTSTRIP_SHARED_RUNS"


def name_of(one):
    """Of a test or a module: folder/module::class.test."""
    module, _, test = one.nodeid.partition("::")
    return f"{module.removesuffix('.py')}::{test.replace('::', '.')}"


def full_name(item):
    """What a TEXT is looked for in."""
    return f"test/{name_of(item)}"


class Counts:
    """Counts tests, not their subtests, and names those that fail at once."""

    def __init__(self, config):
        self.config = config
        self.started, self.bad, self.named, self.skipped = set(), set(), set(), set()

    def pytest_runtest_logreport(self, report):
        name = name_of(report)
        self.started.add(name)
        if report.failed:
            self.bad.add(name)
        if report.skipped and not hasattr(report, "wasxfail"):
            self.skipped.add(name)

    def pytest_runtest_logfinish(self):
        # Not before: what a subtest says while its test runs is captured.
        terminal = self.config.pluginmanager.get_plugin("terminalreporter")
        for name in sorted(self.bad - self.named):
            terminal.write_line(f"\nFAILED {name}", flush=True)
        self.named |= self.bad

    def pytest_collectreport(self, report):
        # A module that cannot be imported is a failing test.
        if report.failed:
            self.pytest_runtest_logreport(report)

    def pytest_terminal_summary(self, terminalreporter):
        self.pytest_runtest_logfinish()
        skipped = self.skipped - self.bad
        words = (f"{len(self.started - self.bad - skipped)} passed, {len(self.bad)} failed"
                 + (f", {len(skipped)} skipped" if skipped else ""))
        terminalreporter.write_line(f"{'all modules together:':43} {words}")


def pytest_addoption(parser):
    parser.addoption("--text", default="", help="only tests whose folder/module::class.test has it")


def pytest_configure(config):
    if hasattr(config, "workerinput"):
        return
    config.pluginmanager.register(Counts(config), "counts")
    if SHARED_RUNS not in os.environ:
        folder = tempfile.TemporaryDirectory()
        os.environ[SHARED_RUNS] = folder.name
        config.add_cleanup(folder.cleanup)
        config.add_cleanup(lambda: os.environ.pop(SHARED_RUNS))


def pytest_collection_modifyitems(config, items):
    text = config.option.text
    config.hook.pytest_deselected(items=[item for item in items if text not in full_name(item)])
    items[:] = [item for item in items if text in full_name(item)]
