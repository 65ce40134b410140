"""What the net keeps of an output, and how it says that one is another."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import net
from harness import ROOT

TABLE = ("# faststrip 0.1.0 rev {}\n# rail {}\ncase,Fx_N,normal_us,choice\n"
         "a,{},{},strip 5: 0.02 in {} us\n")


class Net(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def kept(self, *values):
        path = self.folder / "table.csv"
        path.write_text(TABLE.format(*values), encoding="utf-8")
        return net.without_stamps(path)

    def changed(self, *pairs):
        """The lines for outputs that were and are these, by name; nothing: not there."""
        folders = [self.folder / "kept", self.folder / "new"]
        for folder, texts in zip(folders, zip(*(texts for _, texts in pairs), strict=True),
                                 strict=True):
            folder.mkdir()
            for (name, _), text in zip(pairs, texts, strict=True):
                if text is not None:
                    (folder / name).write_text(text, encoding="utf-8")
        return net.compare(*folders)

    def test_the_contacts_of_the_hosts_are_found_outside_the_tests(self):
        done = subprocess.run([sys.executable, "-c",
                               "import net; print(len(net.input_of_figures().splitlines()))"],
                              cwd=ROOT / "tools/check", stdout=subprocess.PIPE, check=True)
        self.assertGreater(int(done.stdout), 10)

    def test_stamps_and_times_do_not_count(self):
        first = self.kept("abc", "60e1", "-1.5", "12.0", "104")
        self.assertEqual(first, self.kept("def", "60e1", "-1.5", "13.5", "99.5"))
        self.assertNotEqual(first, self.kept("abc", "uic60", "-1.5", "12.0", "104"))
        self.assertNotEqual(first, self.kept("abc", "60e1", "-1.6", "12.0", "104"))

    def test_what_changed_is_named_with_the_largest_change(self):
        lines = self.changed(
            ("same.csv", ("a\n1\n", "a\n1\n")), ("gone.csv", ("a\n1\n", None)),
            ("come.csv", (None, "a\n1\n")), ("other.txt", ("one\n", "three\n")),
            ("longer.csv", ("a\n1\n", "a\n1\n2\n")),
            ("moved.csv", ("a,b\n1,2\n4,8\n", "a,b\n1.1,2\n4,16\n")),
            ("said.csv", ("# one\na\n1\n", "# two\na\n1\n")))
        self.assertEqual(lines, [
            "come.csv: new", "gone.csv: no longer there",
            "longer.csv: 1 rows of 1 columns, now 2 of 1",
            "moved.csv: 2 cells, most b of row 2: 8, now 16",
            "other.txt: 4 bytes, now 6", "said.csv: 0 cells, comments alone"])

    def test_every_method_is_run(self):
        names = [name for name, _ in net.choices()]
        self.assertEqual(len(names), len(set(names)))
        listed = net.methods.read_methods((net.ROOT / net.methods.LIST).read_text(encoding="utf-8"))
        for normal in listed["normal"]:
            self.assertTrue(any(name.startswith(f"{normal.name}_") for name in names), normal.name)
        for tangential in listed["tangential"]:
            self.assertTrue(any(name.endswith(f"_{tangential.name}") for name in names),
                            tangential.name)
