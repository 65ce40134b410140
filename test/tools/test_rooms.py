"""The rooms of src/: who may import whom, and what the embeddable core must not need."""

import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# From the ground up; a room imports only from rooms below it, and from itself.
# Readings of the paper that are known to be wrong stand on top, for program and tests only.
ORDER = [
    "ground", "numerics", "influence", "profile", "normal", "tangential", "contact", "interop",
    "errata",
]
# Files that read and write, and those that need GPL libraries: for program and tests only.
OUTSIDE_CORE = {
    "faststrip_files_csv",
    "faststrip_files_profile",
    "faststrip_files_gap",
    "faststrip_tables_gsl",
    "faststrip_tables_quadrature",
    "faststrip_kalker_fftw",
    "faststrip_kalker_convolution",
}


def room_of(path):
    parts = path.relative_to(ROOT / "src" / "faststrip").with_suffix("").parts
    return parts[0] if parts[0] in ORDER else "ground"


def sources():
    return sorted((ROOT / "src" / "faststrip").rglob("*.f90"))


def imports(path):
    text = path.read_text(encoding="utf-8").lower()
    return set(re.findall(r"^\s*use\s+(faststrip\w*)", text, re.MULTILINE))


class Rooms(unittest.TestCase):
    def setUp(self):
        self.modules = {}
        for path in sources():
            name = "_".join(path.relative_to(ROOT / "src").with_suffix("").parts)
            self.modules[name] = path

    def test_there_are_rooms(self):
        self.assertGreater(len(self.modules), 20)

    def test_module_names_follow_the_paths(self):
        for name, path in self.modules.items():
            with self.subTest(path.name):
                declared = re.findall(
                    r"^module\s+(\w+)", path.read_text(encoding="utf-8"), re.MULTILINE
                )
                self.assertEqual(declared, [name])

    def test_rooms_import_only_from_below(self):
        for name, path in self.modules.items():
            for other in imports(path):
                with self.subTest(f"{name} uses {other}"):
                    self.assertIn(other, self.modules)
                    self.assertLessEqual(
                        ORDER.index(room_of(self.modules[other])), ORDER.index(room_of(path))
                    )

    def test_every_import_is_limited_and_every_module_private(self):
        for name, path in self.modules.items():
            text = path.read_text(encoding="utf-8")
            with self.subTest(name):
                self.assertIn("\n    private\n", text)
                for line in re.findall(r"^\s*use\s.*$", text, re.MULTILINE):
                    self.assertIn("only:", line)

    def test_core_needs_no_file_and_no_gpl(self):
        umbrella = ROOT / "src" / "faststrip.f90"
        seen, waiting = set(), sorted(imports(umbrella))
        while waiting:
            name = waiting.pop()
            if name in seen:
                continue
            seen.add(name)
            waiting.extend(imports(self.modules[name]))
        self.assertIn("faststrip_normal_strip", seen)
        self.assertEqual(seen & OUTSIDE_CORE, set())
        self.assertEqual([name for name in seen if name.startswith("faststrip_errata")], [])
        self.assertEqual([name for name in seen if "variational" in name], [])
        for name in seen:
            text = self.modules[name].read_text(encoding="utf-8").lower()
            with self.subTest(name):
                self.assertIsNone(re.search(r"^\s*(open|read|print|stop|error stop)\b", text, re.M))
                for unit in re.findall(r"^\s*write\s*\(([^,)]*)", text, re.M):
                    self.assertNotIn("unit", unit)
                    self.assertNotEqual(unit.strip(), "*")


if __name__ == "__main__":
    unittest.main()
