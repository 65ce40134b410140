"""./run release: what is not ready is told in one line, and what is made is whole."""

import hashlib
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import tomllib
import unittest

import steps
from harness import ROOT

DATE = "2026-01-31"


def git(folder, *words):
    return subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@b.c", *words],
                          cwd=folder, capture_output=True, encoding="utf-8", check=True).stdout


@unittest.skipUnless((ROOT / ".git").exists() and steps.git("rev-parse", "HEAD"),
                     "a release is made of a revision, and git knows none here")
class Release(unittest.TestCase):
    """A clone of the checkout as it is, that is ready for a release."""

    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name) / "clone"
        git(ROOT, "clone", "--quiet", ROOT, cls.folder)
        changed = git(ROOT, "diff", "--name-only", "-z", "HEAD") \
            + git(ROOT, "ls-files", "-z", "--others", "--exclude-standard")
        for name in filter(None, changed.split("\0")):
            (cls.folder / name).unlink(missing_ok=True)
            if (ROOT / name).exists():
                (cls.folder / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(ROOT / name, cls.folder / name)
        with open(cls.folder / "fpm.toml", "rb") as file:
            cls.version = tomllib.load(file)["version"]
        # What is not released yet becomes a part of the newest release.
        changes = re.sub(r"## \[Unreleased\]\n(.*?\n)## \[[\d.]+\] - [^\n]*\n",
                         rf"## [Unreleased]\n\n## [{cls.version}] - {DATE}\n\1",
                         (cls.folder / "CHANGELOG.md").read_text(encoding="utf-8"), count=1,
                         flags=re.DOTALL)
        cls.write("CHANGELOG.md", changes)
        citation = (cls.folder / "CITATION.cff").read_text(encoding="utf-8")
        citation = re.sub(r"date-released:.*\n", "", citation)
        cls.write("CITATION.cff", citation + f"date-released: {DATE}\n")
        git(cls.folder, "add", "--all")
        git(cls.folder, "commit", "--quiet", "--message", "ready")
        cls.ready = git(cls.folder, "rev-parse", "HEAD").strip()

    @classmethod
    def write(cls, name, text):
        (cls.folder / name).parent.mkdir(parents=True, exist_ok=True)
        (cls.folder / name).write_text(text, encoding="utf-8")

    @classmethod
    def change(cls, name, old, new):
        text = (cls.folder / name).read_text(encoding="utf-8")
        assert old in text, (name, old)
        cls.write(name, text.replace(old, new, 1))

    def release(self, *words):
        return subprocess.run([sys.executable, "tools/building/release.py", *words],
                              cwd=self.folder, capture_output=True, encoding="utf-8", check=False)

    def refused(self, says, *words):
        """One thing is wrong, told in one line; nothing is made."""
        done = self.release(*words)
        told = done.stderr.splitlines()
        self.assertEqual((done.returncode, len(told)), (1, 2), done.stderr)
        self.assertTrue(told[0].startswith("release: "))
        self.assertRegex(told[0].removeprefix("release: "), says)
        self.assertEqual(told[1], "release: 1 to be put right before faststrip "
                                  f"{self.version} can be released")
        self.assertEqual(done.stdout.count("not ready"), 1)
        self.assertFalse((self.folder / "out" / "release").exists())

    def test_what_is_ready_passes(self):
        done = self.release("--check")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertNotIn("not ready", done.stdout)
        self.assertIn("what remains, for a person:", done.stdout)
        self.assertIn(f"git tag -a v{self.version} ", done.stdout)
        self.assertFalse((self.folder / "out").exists())

    def test_each_thing_that_does_not_agree(self):
        version = self.version
        heading = f"## [{version}] - {DATE}\n"
        for name, old, new, says in (
            ("include/faststrip.h", f'VERSION "{version}"', 'VERSION "9.9.9"',
             rf"include/faststrip\.h:\d+: the version must be {version} as .*, got 9\.9\.9"),
            ("src/faststrip/interop/c/c.f90", f"version = '{version}'", "version = '9.9.9'",
             r"src/faststrip/interop/c/c\.f90:\d+: the version must be .* got 9\.9\.9"),
            ("python/faststrip/__init__.py", f'__version__ = "{version}"', '__version__ = "9"',
             r"python/faststrip/__init__\.py:\d+: the version must be .* got 9"),
            ("python/faststrip/__init__.py", "__version__ = ", "_version = ",
             r"python/faststrip/__init__\.py: the version must stand here, got none"),
            ("CITATION.cff", f"version: {version}", "version: 9.9.9",
             r"CITATION\.cff:\d+: the version must be .* got 9\.9\.9"),
            ("CITATION.cff", f"date-released: {DATE}", "date-released: 2026-02-01",
             rf"CITATION\.cff:\d+: date-released must be {DATE} as .*, got 2026-02-01"),
            ("CITATION.cff", f"date-released: {DATE}", "",
             "CITATION.cff: date-released must stand here, got none"),
            ("CITATION.cff", "\nlicense:", "\nlicence:", "CITATION.cff: license must stand here"),
            ("CHANGELOG.md", heading, f"- A line.\n\n{heading}",
             rf"CHANGELOG\.md:\d+: \[Unreleased\] must be empty, .* \[{version}\]"),
            ("CHANGELOG.md", heading, f"{heading}\n## [0.0.1] - {DATE}\n",
             rf"CHANGELOG\.md:\d+: \[{version}\] must say what users notice, got nothing"),
            ("CHANGELOG.md", heading, f"## [9.9.9] - {DATE}\n",
             rf"CHANGELOG.md: the newest heading must be '## \[{version}\] - YYYY-MM-DD', got"
             r" '## \[9\.9\.9\]"),
            ("CHANGELOG.md", heading, f"## [{version}] {DATE}\n", "the newest heading must be"),
            ("README.md", "<!-- measured: contacts -->\n", "<!-- measured: contacts -->\nmore\n",
             r"validation: not as measured: README\.md"),
            ("reference/speed.csv", " rev ", " rev 0000000", "stored: reference/speed.csv: "),
        ):
            with self.subTest(name, new=new):
                self.addCleanup(git, self.folder, "reset", "--quiet", "--hard", self.ready)
                self.change(name, old, new)
                git(self.folder, "commit", "--quiet", "--all", "--message", "broken")
                self.refused(says)
                git(self.folder, "reset", "--quiet", "--hard", self.ready)

    def test_dates_that_are_none_or_ahead(self):
        self.addCleanup(git, self.folder, "reset", "--quiet", "--hard", self.ready)
        for date, says in (("2026-02-30", "the date must be one, got 2026-02-30"),
                           ("9000-01-01", "the date must not lie ahead, got 9000-01-01")):
            for name in ("CHANGELOG.md", "CITATION.cff"):
                self.change(name, DATE, date)
            git(self.folder, "commit", "--quiet", "--all", "--message", "broken")
            self.refused(says)
            git(self.folder, "reset", "--quiet", "--hard", self.ready)

    def test_what_is_not_committed_or_tagged_already(self):
        self.write("note.txt", "new")
        self.refused("everything must be committed, 1 are not: note.txt")
        (self.folder / "note.txt").unlink()
        git(self.folder, "tag", f"v{self.version}")
        self.addCleanup(git, self.folder, "tag", "--delete", f"v{self.version}")
        self.refused(f"the version must be a new one, there is a tag v{self.version}", "--check")

    def make_parts(self):
        """What stands for the site and the Python package."""
        self.addCleanup(shutil.rmtree, self.folder / "out", ignore_errors=True)
        for name in ("docs/index.html", f"package/faststrip-{self.version}.tar.gz",
                     f"package/faststrip-{self.version}-py3-none-any.whl",
                     "package/conda/recipe.yaml", "package/spack/packages/package.py",
                     "package/debian/control"):
            self.write(f"out/{name}", name)

    def test_what_is_made(self):
        made = self.folder / "out" / "release"
        self.make_parts()
        name = f"faststrip-{self.version}-source.tar.gz"
        sums = []
        for _ in range(2):
            done = self.release()
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn("what remains, for a person:", done.stdout)
            self.assertEqual({path.name for path in made.rglob("*") if path.is_file()},
                             {"SHA256SUMS", name, f"faststrip-{self.version}-py3-none-any.whl",
                              f"faststrip-{self.version}.tar.gz", "recipe.yaml", "package.py",
                              "control"})
            sums.append((made / "SHA256SUMS").read_text(encoding="utf-8"))
        self.assertEqual(*sums)
        for line in sums[0].splitlines():
            digest, file = line.split("  ")
            self.assertEqual(hashlib.sha256((made / file).read_bytes()).hexdigest(), digest)
        self.assertEqual(len(sums[0].splitlines()), 6)
        with tarfile.open(made / name) as archive:
            members = {member.name: member for member in archive}
            top = f"faststrip-{self.version}/"
            files = filter(None, git(self.folder, "ls-files", "-z").split("\0"))
            self.assertEqual(set(members), {*(top + file for file in files),
                                            top + "doc/index.html"})
            self.assertEqual(members[top + "run"].mode, 0o755)
            self.assertEqual(members[top + "fpm.toml"].mode, 0o644)
            text = archive.extractfile(top + "README.md").read()
        self.assertEqual(text, (self.folder / "README.md").read_bytes())

    def test_parts_that_are_missing(self):
        for name, says in (("docs/index.html", "the site must be in out/docs, there is no index"),
                           (f"package/faststrip-{self.version}.tar.gz",
                            f"one faststrip-{self.version}.tar.gz must be in out/package, there"
                            " are 0")):
            self.make_parts()
            (self.folder / "out" / name).unlink()
            done = self.release()
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, rf"\Arelease: {re.escape(says)}[^\n]*\n\Z")
