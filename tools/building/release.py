#!/usr/bin/env python3
"""Check that all is ready for a release, then put together what is handed out.

    release.py [--check]

Checked are versions, which must all be that of fpm.toml, the headings of CHANGELOG.md,
CITATION.cff, the measured figures in the documents, the stamps of the stored results, and that
everything is committed and not yet tagged. What is wrong is told in one line each, and then nothing
is made.

out/release then holds the source distribution, the wheel and the recipes of out/package, the
sources with the site of out/docs in doc/ (faststrip-N-source.tar.gz), and SHA256SUMS. At the end
stands what a person has to do. `./run release` checks, makes site and package, and calls this.
"""

import argparse
import datetime
import gzip
import hashlib
import io
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SITE = ROOT / "out" / "docs"
PACKAGE = ROOT / "out" / "package"
FOLDER = ROOT / "out" / "release"
# Where the version stands besides fpm.toml, for those who cannot read it there.
VERSIONS = (
    ("include/faststrip.h", r'^#define FASTSTRIP_VERSION "(.*)"$'),
    ("src/faststrip/interop/c/c.f90", r"^ *character\(len=\*\), parameter :: version = '(.*)'$"),
    ("python/faststrip/__init__.py", r'^__version__ = "(.*)"$'),
    ("CITATION.cff", r"^version: (.*)$"),
)
REMAINS = """\
what remains, for a person:
- ./run test, ./run fuzz, ./run mutants, ./run report on this revision: all pass, and what does not
  is explained
- names that changed have an alias for this release, those of the release before have gone
- read CHANGELOG.md as somebody who has not worked on it
- git tag -a v{version} -m 'faststrip {version}', and push the tag
- upload the .whl and faststrip-{version}.tar.gz to PyPI; put all of out/release at the tag's page
- in the recipes of conda and Spack the path of faststrip-{version}.tar.gz becomes its address; then
  they can be offered to conda-forge and to Spack
- the archive's DOI, if there is one, into CITATION.cff
- a new [Unreleased] in CHANGELOG.md
"""


def lines_that(path, pattern):
    """Places and values of the lines of a file that match: `file:line`, the first group."""
    text = (ROOT / path).read_text(encoding="utf-8")
    for match in re.finditer(pattern, text, re.MULTILINE):
        yield f"{path}:{text.count(chr(10), 0, match.start()) + 1}", match[1]


def version_of_manifest():
    return next(value for _, value in lines_that("fpm.toml", r'^version = "(.*)"$'))


def versions(version):
    if not re.fullmatch(r"\d+\.\d+\.\d+", version):
        yield f"fpm.toml: the version must be three numbers with points between, got {version}"
    for path, pattern in VERSIONS:
        found = list(lines_that(path, pattern))
        if not found:
            yield f"{path}: the version must stand here, got none"
        for place, value in found:
            if value != version:
                yield f"{place}: the version must be {version} as in fpm.toml, got {value}"


def headings():
    """The headings of the changelog: place, text, what stands below."""
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    parts = re.split(r"^## (.*)$", text, flags=re.MULTILINE)
    line = parts[0].count("\n") + 1
    for title, below in zip(parts[1::2], parts[2::2], strict=True):
        yield f"CHANGELOG.md:{line}", title, below
        line += below.count("\n")


def date_of(version):
    """The date in the changelog's heading of a version; none if it has none."""
    for _, title, _ in headings():
        if match := re.fullmatch(rf"\[{re.escape(version)}\] - (\d{{4}}-\d\d-\d\d)", title):
            return match[1]
    return None


def changelog(version):
    found = [item for item in headings() if item[1] != "[Unreleased]"]
    for place, title, below in headings():
        if title == "[Unreleased]" and re.search(r"^- ", below, re.MULTILINE):
            yield f"{place}: [Unreleased] must be empty, its lines belong to [{version}]"
    if not found or not re.fullmatch(rf"\[{re.escape(version)}\] - \d{{4}}-\d\d-\d\d", found[0][1]):
        yield (f"CHANGELOG.md: the newest heading must be '## [{version}] - YYYY-MM-DD', got "
               + (f"'## {found[0][1]}'" if found else "none"))
        return
    place, title, below = found[0]
    if not re.search(r"^- ", below, re.MULTILINE):
        yield f"{place}: [{version}] must say what users notice, got nothing"
    try:
        if datetime.date.fromisoformat(date_of(version)) > datetime.date.today():
            yield f"{place}: the date must not lie ahead, got {title.rpartition(' ')[2]}"
    except ValueError:
        yield f"{place}: the date must be one, got {title.rpartition(' ')[2]}"


def citation(version):
    for key in ("cff-version", "message", "title", "authors", "license", "date-released"):
        if not list(lines_that("CITATION.cff", rf"^{key}:(.*)$")):
            yield f"CITATION.cff: {key} must stand here, got none"
    date = date_of(version)
    for place, value in lines_that("CITATION.cff", r"^date-released: *(.*)$"):
        if date and value.strip("'\"") != date:
            yield f"{place}: date-released must be {date} as in CHANGELOG.md, got {value}"


def said_by(*words):
    """The lines that a tool has to say if it finds anything wrong."""
    done = subprocess.run([sys.executable, *words], cwd=ROOT, stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, encoding="utf-8", check=False)
    if done.returncode != 0:
        yield from done.stderr.splitlines() or [f"{words[0]} failed"]


def git(*words):
    return subprocess.run(["git", *words], cwd=ROOT, capture_output=True, encoding="utf-8",
                          check=True).stdout


def history(version):
    if not (ROOT / ".git").exists():
        yield "a release is made of a revision, and there is no git history here"
        return
    changed = git("status", "--porcelain").splitlines()
    if changed:
        yield f"everything must be committed, {len(changed)} are not: {changed[0][3:]}"
    if git("tag", "--list", f"v{version}"):
        yield f"the version must be a new one, there is a tag v{version}"


CHECKS = {
    "versions": versions,
    "CHANGELOG.md": changelog,
    "CITATION.cff": citation,
    "measured figures": lambda _: said_by("tools/measure/validation.py", "--check"),
    "stored results": lambda _: said_by("tools/measure/stored.py", "--check"),
    "history": history,
}


def check(version):
    """Say how it stands with each; how many troubles there are."""
    count = 0
    for name, find in CHECKS.items():
        troubles = list(find(version))
        count += len(troubles)
        print(f"{name:18} {'not ready' if troubles else 'ready'}", flush=True)
        for trouble in troubles:
            print(f"release: {trouble}", file=sys.stderr, flush=True)
    return count


def source_archive(path, name):
    """The files of this revision and the site, with the time of the commit: the same revision
    gives the same bytes."""
    time = int(git("log", "-1", "--format=%ct"))
    files = {file: ROOT / file for file in git("ls-files", "-z").split("\0") if file}
    files |= {f"doc/{page.relative_to(SITE).as_posix()}": page for page in SITE.rglob("*")
              if page.is_file()}
    raw = io.BytesIO()
    with tarfile.open(fileobj=raw, mode="w", format=tarfile.PAX_FORMAT) as archive:
        for file, place in sorted(files.items()):
            member = archive.gettarinfo(place, f"{name}/{file}")
            member.mtime, member.uid, member.gid, member.uname, member.gname = time, 0, 0, "", ""
            member.mode = 0o755 if member.mode & 0o100 else 0o644
            if member.isreg():
                with open(place, "rb") as stream:
                    archive.addfile(member, stream)
            else:
                archive.addfile(member)
    path.write_bytes(gzip.compress(raw.getvalue(), mtime=time))


def make(version):
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    for pattern in (f"faststrip-{version}.tar.gz", f"faststrip-{version}-py3-none-*.whl"):
        found = list(PACKAGE.glob(pattern))
        if len(found) != 1:
            sys.exit(f"release: one {pattern} must be in out/package, there are {len(found)}")
        shutil.copy(found[0], FOLDER)
    if not (SITE / "index.html").is_file():
        sys.exit("release: the site must be in out/docs, there is no index.html")
    for kind in ("conda", "spack", "debian"):
        shutil.copytree(PACKAGE / kind, FOLDER / kind)
    source_archive(FOLDER / f"faststrip-{version}-source.tar.gz", f"faststrip-{version}")
    made = sorted(path for path in FOLDER.rglob("*") if path.is_file())
    sums = "".join(f"{hashlib.sha256(path.read_bytes()).hexdigest()}"
                   f"  {path.relative_to(FOLDER).as_posix()}\n" for path in made)
    (FOLDER / "SHA256SUMS").write_text(sums, encoding="utf-8")
    for path in made:
        print(f"{path.name}: {path.stat().st_size / 1e6:.1f} MB")


def main():
    parser = argparse.ArgumentParser(prog="./run release", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="check only, make nothing")
    options = parser.parse_args()
    version = version_of_manifest()
    count = check(version)
    if count:
        sys.exit(f"release: {count} to be put right before faststrip {version} can be released")
    if not options.check:
        make(version)
    print("\n" + REMAINS.format(version=version), end="")


if __name__ == "__main__":
    main()
