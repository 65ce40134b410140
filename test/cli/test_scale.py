"""What measures batch on many contacts, `./run scale`, by a tenth of them."""

import subprocess
import sys

from cli_program import PATIENCE, ROOT, ProgramTest

TOOL = ROOT / "tools/measure/scale.py"


class Quick(ProgramTest):
    def tool(self, *words):
        return subprocess.run([sys.executable, TOOL, *words], cwd=self.folder, encoding="utf-8",
                              capture_output=True, timeout=PATIENCE, check=False)

    def test_table_file_and_picture(self):
        done = self.tool("--quick", "-o", "scale.csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        for line in done.stderr.splitlines():
            self.assertRegex(line, r"^scale: ")
        self.assertIn("# faststrip ", (self.folder / "scale.csv").read_text(encoding="utf-8"))
        self.assertEqual((self.folder / "scale.png").read_bytes()[:4], b"\x89PNG")
        rows = self.read("scale.csv")
        groups = {}
        for row in rows:
            groups.setdefault(row["group"], []).append(row)
            for name, cell in row.items():
                if name not in ("group", "what") and cell:
                    self.assertGreater(float(cell), 0.0, row)
        self.assertEqual({group: len(own) for group, own in groups.items()},
                         {"method": 6, "threads": 4, "parts": 2, "format": 4, "memory": 3,
                          "on paper": 10})
        self.assertEqual([row["contacts"] for row in groups["memory"]], ["1000", "10000", "100000"])
        self.assertEqual({row["processes"] for row in groups["parts"]}, {"4"})
        # The same results by threads and parts.
        for k in (0, 1):
            self.assertEqual(len({row["size_MB"] for row in
                                  (*groups["threads"][2 * k:2 * k + 2], groups["parts"][k])}), 1)
        _, table, double, single = (float(row["size_MB"]) for row in groups["format"])
        self.assertTrue(single < double < table)
        shown = self.tool("--read", "scale.csv")
        self.assertEqual(shown.returncode, 0, shown.stderr)
        self.assertTrue(done.stdout.startswith(shown.stdout))
        self.assertEqual(shown.stdout.count("on paper: "), 10)

    def test_what_it_refuses(self):
        for words, code, says in ((("--fast",), 2, "--fast"),
                                  (("--read", "no.csv"), 1, "no.csv")):
            done = self.tool(*words)
            self.assertEqual(done.returncode, code)
            self.assertIn(says, done.stderr.splitlines()[-1])
            self.assertEqual(done.stdout, "")
