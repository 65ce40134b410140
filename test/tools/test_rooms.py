"""Rooms and packages: who may import whom, and what the embeddable core must not do."""

import re
import tomllib
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CORE = "src/faststrip"
# Rooms of the core from the ground up: each imports from rooms below it, and from itself.
ROOMS = ["base", "numerics", "lookup", "influence", "geometry", "normal", "tangential", "stress",
         "contact", "wheelset", "interop"]
# Packages from the ground up: each imports from those it names here, and from itself.
PACKAGES = {
    CORE: [],
    "src/files": [CORE],
    "src/kalker": [CORE],
    "src/tables": [CORE],
    "src/netcdf": [CORE, "src/files"],
    "src/tabulate": [CORE, "src/files", "src/kalker"],
    "app/command": [CORE, "src/files", "src/kalker", "src/tables", "src/tabulate"],
    "app/lab": [CORE, "src/files", "src/kalker", "src/tables", "app/command"],
}
# The programs in app/programs: which packages each is made of.
PROGRAMS = {
    "app/programs/faststrip.f90": ["app/command"],
    "app/programs/faststrip_lab.f90": ["app/command", "app/lab"],
}
# Made by the build.
REVISION = "app/command/revision.f90"


def module_of(package, path):
    """The name of a file's module; folder/folder.f90 says the word once."""
    parts = path.relative_to(ROOT / package).with_suffix("").parts
    words = [*([] if package == CORE else [package.split("/")[1]]), *parts]
    if len(words) > 1 and words[-1] == words[-2]:
        words.pop()
    return "faststrip" if words == ["faststrip"] else "_".join(["faststrip", *words])


def without_comments(text):
    """Code in small letters; no text of the project has an exclamation mark before its code."""
    return re.sub(r"![^\n]*", "", text.lower())


def imports(path):
    return set(re.findall(r"^\s*use\s*(?:,[^:\n]*::)?\s*(faststrip\w*)",
                          without_comments(path.read_text(encoding="utf-8")), re.MULTILINE))


class Rooms(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.files, cls.package, cls.path = {}, {}, {}
        for package in PACKAGES:
            cls.files[package] = sorted(path for path in (ROOT / package).rglob("*.f90")
                                        if "build" not in path.relative_to(ROOT).parts
                                        and path.relative_to(ROOT).as_posix() != REVISION)
            for path in cls.files[package]:
                name = module_of(package, path)
                cls.package[name], cls.path[name] = package, path
        cls.package["faststrip_command_revision"] = "app/command"

    def room(self, path):
        """How high a file of the core stands; the umbrella is above all rooms."""
        parts = path.relative_to(ROOT / CORE).parts
        return ROOMS.index(parts[0]) if len(parts) > 1 else len(ROOMS)

    def test_no_folder_is_too_full(self):
        for paths in self.files.values():
            folders = {}
            for path in paths:
                folders.setdefault(path.parent.relative_to(ROOT).as_posix(), []).append(path.name)
            for folder, names in folders.items():
                with self.subTest(folder):
                    self.assertLessEqual(len(names), 17, sorted(names))

    def test_every_source_is_in_a_room(self):
        found = {path for place in ("src", "app") for path in (ROOT / place).rglob("*.f90")
                 if "build" not in path.relative_to(ROOT).parts}
        known = {path for paths in self.files.values() for path in paths}
        known |= {ROOT / name for name in (*PROGRAMS, REVISION)}
        self.assertEqual(sorted(map(str, found - known)), [])
        for package, paths in self.files.items():
            with self.subTest(package):
                self.assertGreater(len(paths), 2)
        found = {path.relative_to(ROOT / CORE).parts[0] for path in self.files[CORE]}
        self.assertEqual(found, {*ROOMS, "faststrip.f90"})

    def test_module_names_follow_the_paths(self):
        for name, path in self.path.items():
            with self.subTest(path.relative_to(ROOT).as_posix()):
                text = path.read_text(encoding="utf-8")
                self.assertEqual(re.findall(r"^(?:sub)?module\s+(\w+)", text, re.MULTILINE), [name])
        self.assertEqual(self.path["faststrip_normal_strip"].name, "strip.f90")
        self.assertEqual(self.path["faststrip_command_batch"].parent.name, "batch")

    def test_rooms_of_the_core_import_only_from_below(self):
        count = 0
        for path in self.files[CORE]:
            for other in imports(path):
                with self.subTest(f"{path.relative_to(ROOT)} uses {other}"):
                    self.assertIn(other, self.path)
                    self.assertEqual(self.package[other], CORE)
                    self.assertLessEqual(self.room(self.path[other]), self.room(path))
                    count += 1
        self.assertGreater(count, 100)

    def test_packages_import_only_from_below(self):
        for package, below in PACKAGES.items():
            for path in self.files[package]:
                for other in imports(path):
                    with self.subTest(f"{path.relative_to(ROOT)} uses {other}"):
                        self.assertIn(self.package.get(other), [package, *below])
        for program, packages in PROGRAMS.items():
            used = {self.package.get(other) for other in imports(ROOT / program)}
            self.assertEqual(used, set(packages), program)

    def test_no_modules_use_each_other(self):
        left = {name: imports(path) & set(self.path) for name, path in self.path.items()}
        while left:
            ready = {name for name, used in left.items() if not used & set(left)}
            self.assertTrue(ready, f"modules that use each other, and what uses them: {set(left)}")
            left = {name: used for name, used in left.items() if name not in ready}

    def test_the_manifests_say_the_same(self):
        """Of each package, what it depends on and in which folder it is."""
        for package, below in PACKAGES.items():
            folder = ROOT if package == CORE else ROOT / package
            with open(folder / "fpm.toml", "rb") as file:
                manifest = tomllib.load(file)
            with self.subTest(package):
                self.assertEqual((folder / manifest["library"]["source-dir"]).resolve(),
                                 ROOT / package)
                found = {(folder / value["path"]).resolve()
                         for value in manifest.get("dependencies", {}).values()}
                self.assertEqual(found, {ROOT if name == CORE else ROOT / name for name in below})
                for key in ("auto-executables", "auto-tests", "auto-examples"):
                    self.assertIs(manifest["build"][key], False)

    def test_every_import_is_limited_and_every_module_private(self):
        for name, path in self.path.items():
            text = path.read_text(encoding="utf-8")
            with self.subTest(name):
                if name != "faststrip":
                    self.assertIn("\n    private\n", text)
                for line in re.findall(r"^\s*use\s.*$", text, re.MULTILINE):
                    self.assertIn("only:", line)

    def test_the_core_reads_prints_and_stops_nothing(self):
        """Not only what `use faststrip` reaches: all of it is linked into its hosts."""
        for path in self.files[CORE]:
            text = without_comments(path.read_text(encoding="utf-8"))
            with self.subTest(path.relative_to(ROOT).as_posix()):
                # Alone in its line or after an `if (...)`.
                self.assertIsNone(re.search(
                    r"^(?:\s*|\s*if\b.*\)\s*)(open|close|inquire|backspace|rewind|flush)\s*\(",
                    text, re.M))
                self.assertIsNone(re.search(r"^(?:\s*|\s*if\b.*\)\s*)(print\b|(error\s+)?stop\b)",
                                            text, re.M))
                # From and to texts only.
                for unit in re.findall(r"\b(?:read|write)\s*\(\s*([^,)]*)", text):
                    self.assertRegex(unit.strip(), r"^[a-z]\w*(%\w+|\(.*)?$")
                    self.assertNotRegex(unit, "unit")

    def test_kalker_s_methods_are_not_in_the_core(self):
        for path in self.files[CORE]:
            text = without_comments(path.read_text(encoding="utf-8"))
            self.assertNotRegex(text, r"\bfftw_|\bgsl_|\buse faststrip_(kalker|tables)", path.name)
