#!/usr/bin/env python3
"""Change one thing at a time in a copy of the program and see whether a test notices.

    run_mutants.py [ROOM] [--only ID]... [--jobs N] [--quick] [--lists FOLDER] [--root FOLDER]

The mutants of a room stand in tools/check/mutants/ROOM.toml, one table each:

    [[mutant]]
    id = "room-what-changes"
    file = "src/faststrip/..."
    text = "as it stands in the file, exactly once"
    index = 2                      # which one, if the text stands there more often
    replacement = "what takes its place"
    why = "what a user would get wrong"
    first = "test/cli/test_auto.py"            # optional: tests to begin with, a file of Python or
                                               # a filter of the Fortran tests
    equivalent = "why no test can see it"      # only where that is so

A mutant is killed if a test fails that passes without it, and fails once more when it is run
alone, or if the tests crash or do not end (counted apart). The tests of its room come first, then
all others; with --quick only those of its room. What does not compile is invalid: it judges
nothing. Results are kept in build/mutants/ under a hash of the tree and of the
mutant, so that a run which was broken off goes on where it was. Exit 1 if a mutant survives that
is not named equivalent, if one so named is killed, or if one is invalid; 2 if the tests fail
without any mutant.

A mutant costs one compilation: only if the interface of its module changes, what uses it is
compiled too.
"""

import argparse
import concurrent.futures
import fcntl
import gzip
import hashlib
import json
import os
import pathlib
import queue
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
import tomllib

# With traps, as the tests' own build, but without its checks, which cost compilation time.
sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "building"))
from netcdf_plugin import plugin_sources, where_netcdf_is  # noqa: E402

FLAGS = "-Og -fopenmp -fPIC -frecursive -fimplicit-none -std=f2018"
TRAPS = "-ffpe-trap=invalid,zero,overflow"
C_FLAGS = "-O1 -fPIC"
# Not copied: what is built, and the lists themselves, which change no result.
LEFT_OUT = {".git", ".venv", "build", "bin", "out", "__pycache__", "tools/check/mutants"}
# The main program of the tests, which sets the traps.
RUNNER = "build/tests/generated_runner.f90"
# Written by the build, and here once and for all: a new commit alone changes no result.
REVISION = "app/command/revision.f90"
REVISION_TEXT = """\
module faststrip_command_revision
    implicit none
    private

    character(len=*), parameter, public :: version = '{version}'
    character(len=*), parameter, public :: revision = 'mutant'
end module faststrip_command_revision
"""
# A stage of tests may take this many times longer than without a mutant, and some seconds more.
TIME_FACTOR = 8.0
TIME_EXTRA = 60.0
# A test that fails, and passes when it is run alone, fails for another reason than the mutant: the
# stage is run so many times at most.
ATTEMPTS = 3
TIME_OUT = "time-out"

# The tests that a room's mutants meet first: a filter of the Fortran tests, or files of Python.
INTERFACES = [f"test/embed/test_{name}.py" for name in (
    "values", "figures", "python", "callers", "legacy", "wheelsets")]
FORTRAN_ROOMS = ("base", "numerics", "lookup", "influence", "geometry", "normal", "tangential",
                 "stress", "contact", "wheelset", "files", "kalker", "tables")
OWN_STAGES = {
    **{room: [("fortran", f"{room}/")] for room in FORTRAN_ROOMS},
    "interop": [("installed", INTERFACES)],
    "command": [("python", ["test/cli"])],
    "netcdf": [("python", ["test/cli/test_netcdf.py"])],
    "tabulate": [("python", ["test/cli/test_lookup.py", "test/cli/test_lookup_wheel.py"])],
    "lab": [("python", ["test/cli/test_claims.py", "test/cli/test_force_data.py"])],
    "python": [("installed", [*INTERFACES[:3], INTERFACES[-1]])],
    "fmu": [("installed", ["test/embed/test_fmu.py"])],
    "plots": [("python", ["test/plots"])],
    "tools": [("python", ["test/tools/test_blocks.py"])],
}
TABLES = ["test/tools/test_generated_modules.py"]
ALL_STAGES = [("fortran", ""), ("python", TABLES), ("python", ["test/cli"]),
              ("installed", INTERFACES), ("python", ["test/plots"])]
# What is linked of what: the beginnings of the names of its sources.
PACKAGES = ("src/faststrip/", "src/files/", "src/kalker/", "src/tables/")
TESTS = (*PACKAGES, "test/", "build/tests/")
PROGRAMS = {
    "faststrip": (*PACKAGES, "src/tabulate/", "app/command/", "app/programs/faststrip.f90"),
    "faststrip-lab": (*PACKAGES, "src/tabulate/", "app/command/", "app/lab/",
                      "app/programs/faststrip_lab.f90"),
}
# Of the archives that are installed: the core, and what the readers of profiles are taken from.
LIBRARY = ("src/faststrip/", "src/files/")
# What the program loads to write NetCDF: bin/faststrip_netcdf.so.
NETCDF_PACKAGE = "src/netcdf/"


class Unfit(Exception):
    """The lists or the tree cannot be used; the text says why."""


class Mutant:
    KEYS = {"id", "file", "text", "replacement", "why"}
    MORE = {"index", "first", "equivalent"}

    def __init__(self, room, entry):
        missing = self.KEYS - entry.keys()
        unknown = entry.keys() - self.KEYS - self.MORE
        if missing or unknown:
            raise Unfit(f"{room}.toml, mutant {entry.get('id', '?')}: "
                        f"missing {sorted(missing)}, unknown {sorted(unknown)}")
        self.room = room
        self.id, self.file, self.why = entry["id"], entry["file"], entry["why"]
        self.text, self.replacement = entry["text"], entry["replacement"]
        self.index = entry.get("index")
        self.first = entry.get("first")
        self.equivalent = entry.get("equivalent")

    def applied(self, source):
        """The text of its file with the change."""
        count = source.count(self.text)
        if self.text == self.replacement:
            raise Unfit(f"{self.id}: the replacement changes nothing")
        if count == 0:
            raise Unfit(f"{self.id}: not in {self.file}: {self.text!r}")
        if self.index is None and count > 1:
            raise Unfit(f"{self.id}: {count} times in {self.file}: {self.text!r}")
        if self.index is not None and not 1 <= self.index <= count:
            raise Unfit(f"{self.id}: index must be 1 to {count}, got {self.index}")
        at = -1
        for _ in range(self.index or 1):
            at = source.index(self.text, at + 1)
        return source[:at] + self.replacement + source[at + len(self.text):]

    def key(self, tree):
        words = [tree, self.room, self.file, self.text, self.replacement, str(self.index),
                 str(self.first)]
        return hashlib.sha256("\0".join(words).encode()).hexdigest()


def read_lists(folder, room=None):
    """All mutants of a folder of lists, or those of one room."""
    mutants = []
    for path in sorted(folder.glob("*.toml")):
        if path.stem not in OWN_STAGES:
            raise Unfit(f"{path.name}: no such room; rooms are {', '.join(OWN_STAGES)}")
        try:
            entries = tomllib.loads(path.read_text(encoding="utf-8")).get("mutant", [])
        except tomllib.TOMLDecodeError as problem:
            raise Unfit(f"{path.name}: {problem}") from None
        mutants += [Mutant(path.stem, entry) for entry in entries]
    names = [mutant.id for mutant in mutants]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise Unfit(f"ids used twice: {', '.join(twice)}")
    if room is not None and room not in OWN_STAGES:
        raise Unfit(f"no room {room}; rooms are {', '.join(OWN_STAGES)}")
    return [mutant for mutant in mutants if room in (None, mutant.room)]


def files_of(root):
    """The files of a tree that are copied, as paths below its root."""
    found = []
    for folder, names, files in os.walk(root):
        here = pathlib.Path(folder).relative_to(root)
        names[:] = sorted(name for name in names
                          if name not in LEFT_OUT and (here / name).as_posix() not in LEFT_OUT)
        found += [here / name for name in sorted(files)
                  if not (name.startswith("generated_") and name.endswith(".f90")
                          or (here / name).as_posix() == REVISION)]
    return found


def hash_of(root, names):
    digest = hashlib.sha256()
    for name in names:
        data = (root / name).read_bytes()
        digest.update(f"{name}\0{len(data)}\0".encode())
        digest.update(data)
    return digest.hexdigest()


def copy_tree(root, target, names):
    """Make target hold these files; what has not changed keeps its date."""
    for name in names:
        source, copy = root / name, target / name
        if copy.exists() and copy.read_bytes() == source.read_bytes():
            continue
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(source, copy)
    wanted = set(names)
    for name in files_of(target):
        if name not in wanted:
            (target / name).unlink()
    venv = target / ".venv"
    if not venv.exists() and (root / ".venv").exists():
        venv.symlink_to((root / ".venv").resolve())


def environment():
    kept = {name: value for name, value in os.environ.items() if not name.startswith("FPM_")}
    return {**kept, "OPENBLAS_NUM_THREADS": "1", "MPLBACKEND": "Agg",
            "PYTHONDONTWRITEBYTECODE": "1"}


def call(command, folder):
    """Run what has to succeed."""
    done = subprocess.run([str(word) for word in command], cwd=folder, env=environment(),
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, encoding="utf-8", errors="replace",
                          check=False)
    if done.returncode != 0:
        raise Unfit(f"{command[0]} failed in {folder}\n{done.stdout}")
    return done.stdout


def module_text(path):
    """What a module file says, or nothing if there is none."""
    return gzip.decompress(path.read_bytes()) if path.exists() else None


class Source:
    """A file of Fortran, the modules it makes and those it uses; or a file of C."""

    MADE = re.compile(r"^\s*module\s+(?!procedure\b)(\w+)\s*(?:!.*)?$", re.I | re.M)
    USED = re.compile(r"^\s*use\b(?:\s*,[^:\n]*)?\s*(?:::)?\s*(\w+)", re.I | re.M)

    def __init__(self, root, name):
        self.name = name
        self.object = name.replace("/", "_") + ".o"
        self.text = (root / name).read_text(encoding="utf-8")
        self.is_c = name.endswith(".c")
        code = "" if self.is_c else self.text
        self.made = {word.lower() for word in self.MADE.findall(code)}
        self.used = {word.lower() for word in self.USED.findall(code)} - self.made

    def compile(self, path, folder, modules, target):
        """Compile it from a path; modules are sought in some folders, what is made goes to one."""
        if self.is_c:
            compiler = ["gcc", *C_FLAGS.split()]
        else:
            compiler = ["gfortran", *FLAGS.split(), *(TRAPS.split() if self.name == RUNNER else []),
                        "-J", str(target), *(f"-I{place}" for place in (target, *modules))]
            if self.name.startswith(NETCDF_PACKAGE):
                compiler += where_netcdf_is()
        done = subprocess.run(
            [*compiler, "-c", str(path), "-o", str(target / self.object)],
            cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, encoding="utf-8", errors="replace", check=False)
        if done.returncode != 0:
            raise Unfit(f"{path} does not compile\n{done.stdout}")


def linked_libraries(root, names):
    """What the packages of a tree are linked to: those above the core before it."""
    found = []
    for name in sorted(names, key=lambda name: len(name.parts), reverse=True):
        if name.name == "fpm.toml":
            manifest = tomllib.loads((root / name).read_text(encoding="utf-8"))
            link = manifest.get("build", {}).get("link", [])
            found += [link] if isinstance(link, str) else link
    return list(dict.fromkeys(found))


def in_order(sources):
    """Sources in levels: each uses modules of earlier levels only."""
    made = {module for source in sources for module in source.made}
    levels, ready, left = [], set(), list(sources)
    while left:
        level = [source for source in left if not (source.used & made) - ready]
        if not level:
            raise Unfit(f"modules use each other: {', '.join(source.name for source in left)}")
        levels.append(level)
        ready.update(module for source in level for module in source.made)
        left = [source for source in left if source not in level]
    return levels


class Base:
    """The tree without a mutant, built once, in a folder below build/."""

    def __init__(self, root, python, place="mutants"):
        self.python = python
        self.folder = root / "build" / place / "base"
        self.names = files_of(root)
        self.hash = hash_of(root, self.names)
        copy_tree(root, self.folder, self.names)
        self.objects = self.folder / "build" / "objects"
        self.has_fortran = (self.folder / "fpm.toml").exists()
        self.sources, self.libraries = [], []
        if self.has_fortran:
            self.build()

    def build(self):
        """Compile what has changed, or uses a module that has."""
        if (self.folder / REVISION).parent.exists():
            manifest = tomllib.loads((self.folder / "fpm.toml").read_text(encoding="utf-8"))
            (self.folder / REVISION).write_text(REVISION_TEXT.format(version=manifest["version"]),
                                                encoding="utf-8")
        generated = self.folder / RUNNER
        generated.parent.mkdir(parents=True, exist_ok=True)
        call([self.python, "tools/building/pf2f90.py", "--target", generated.parent], self.folder)
        self.libraries = [f"-l{name}" for name in linked_libraries(self.folder, self.names)]
        # What lies in test/pf is among what was generated of it.
        paths = [path for place in ("src", "app", "test/funit", generated.parent)
                 for suffix in ("f90", "c") for path in (self.folder / place).rglob(f"*.{suffix}")]
        levels = in_order([Source(self.folder, path.relative_to(self.folder).as_posix())
                           for path in sorted(paths)])
        self.sources = [source for level in levels for source in level]
        self.objects.mkdir(parents=True, exist_ok=True)
        record = self.objects / "keys.json"
        keys = json.loads(record.read_text(encoding="utf-8")) if record.exists() else {}
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count() or 1) as pool:
            for level in levels:
                keys.update(pool.map(lambda source: self.compiled(source, keys), level))
                record.write_text(json.dumps(keys), encoding="utf-8")

    def compiled(self, source, keys):
        """Compile a file if that is needed; its name and the hash of what it was made from."""
        digest = hashlib.sha256(f"{FLAGS} {TRAPS} {C_FLAGS} {source.text}".encode())
        for module in sorted(source.used):
            digest.update(module_text(self.objects / f"{module}.mod") or b"")
        key = digest.hexdigest()
        if keys.get(source.name) != key or not (self.objects / source.object).exists():
            source.compile(source.name, self.folder, [], self.objects)
        return source.name, key


class Job:
    """A copy of the tree of its own, in which one mutant after the other is tried."""

    def __init__(self, base, number, seconds):
        self.base, self.seconds = base, seconds
        self.folder = base.folder.parent / f"job_{number}"
        copy_tree(base.folder, self.folder, base.names)
        self.scratch = self.folder / "build" / "scratch"
        self.prefix = self.folder / "build" / "prefix"
        self.linked, self.compiled = set(), set()

    def clear(self):
        shutil.rmtree(self.scratch, ignore_errors=True)
        self.scratch.mkdir(parents=True)
        self.linked, self.compiled = set(), set()

    def compile(self, changed, beginnings=("",)):
        """Compile a changed file, and what uses its module if that looks different now."""
        different = set()
        for source in self.base.sources:
            if not source.name.startswith(beginnings):
                continue
            if source.name != changed and not source.used & different:
                continue
            own = self.folder / source.name
            if not own.exists():
                own = self.base.folder / source.name
            source.compile(own, self.folder, [self.base.objects], self.scratch)
            self.compiled.add(source.name)
            for module in source.made:
                made = f"{module}.mod"
                if module_text(self.scratch / made) != module_text(self.base.objects / made):
                    different.add(module)

    def object_paths(self, beginnings):
        """Objects of the sources whose names begin so; those of the mutant where it has some."""
        return [(self.scratch if source.name in self.compiled else self.base.objects)
                / source.object
                for source in self.base.sources if source.name.startswith(beginnings)]

    def link(self, what, make):
        """Link a thing once per mutant."""
        if what not in self.linked:
            make()
            self.linked.add(what)

    def link_tests(self):
        call(["gfortran", "-fopenmp", "-o", self.folder / "build" / "runner",
              *self.object_paths(TESTS), *self.base.libraries], self.folder)

    def link_programs(self):
        (self.folder / "bin").mkdir(exist_ok=True)
        for name, beginnings in PROGRAMS.items():
            call(["gfortran", "-fopenmp", "-o", self.folder / "bin" / name,
                  *self.object_paths(beginnings), *self.base.libraries], self.folder)
        if self.object_paths((NETCDF_PACKAGE,)):
            call(["gfortran", "-shared", "-Wl,--no-undefined", "-o",
                  self.folder / "bin" / "faststrip_netcdf.so",
                  *self.object_paths(plugin_sources()), *where_netcdf_is()], self.folder)

    def install(self):
        """Install as ./run install does, from the objects of the mutant."""
        stage = self.folder / "build" / "stage"
        shutil.rmtree(stage, ignore_errors=True)
        shutil.rmtree(self.prefix, ignore_errors=True)
        for name in ("include", "lib"):
            (stage / name).mkdir(parents=True)
        for folder in (self.base.objects, self.scratch):
            for made in folder.glob("faststrip*.mod"):
                shutil.copy(made, stage / "include")
        for name, beginning in zip(("faststrip", "faststrip-files"), LIBRARY):
            call(["ar", "rcs", stage / "lib" / f"lib{name}.a", *self.object_paths((beginning,))],
                 self.folder)
        call([self.base.python, "tools/building/install.py", "--stage", stage, "--program",
              self.folder / "bin" / "faststrip", "--prefix", self.prefix], self.folder)

    def prepare(self, kind):
        if not self.base.has_fortran:
            return
        if kind == "fortran":
            self.link("tests", self.link_tests)
        else:
            self.link("programs", self.link_programs)
        if kind == "installed":
            self.link("installation", self.install)

    def stage(self, kind, what):
        """The first test that fails, or None. The stage `what` is a filter or a list of files."""
        for _ in range(ATTEMPTS):
            failure = self.attempt(kind, what)
            if failure is None or not is_test(failure) or self.attempt(kind, what, only=failure):
                return failure
        return None

    def attempt(self, kind, what, only=None):
        """The same, tried once; of one test if there is an `only`."""
        self.prepare(kind)
        extra = {}
        if kind == "installed":
            extra = {"FASTSTRIP_INSTALLED": str(self.prefix), "FASTSTRIP_NOT_OPTIMIZED": "1"}
        if kind == "fortran":
            command = [str(self.folder / "build" / "runner"), only or what]
        else:
            present = [name for name in what if (self.folder / name).exists()]
            if not present:
                return None
            command = [str(self.base.python), "-m", "pytest", "-c", "test/pytest.ini",
                       f"--text={only or ''}", *present]
        limit = self.seconds.get(stage_name(kind, what))
        limit = None if limit is None else TIME_FACTOR * limit + TIME_EXTRA
        return first_failure(command, self.folder, {**environment(), **extra}, limit)

    def judge(self, mutant, quick):
        """The verdict on a mutant and what made it: a test, or the words of the compiler."""
        source = self.folder / mutant.file
        kept = source.read_bytes()
        try:
            text = mutant.applied(kept.decode())
            source.write_text(text, encoding="utf-8")
            self.clear()
            try:
                if source.suffix in (".f90", ".c"):
                    self.compile(mutant.file)
                elif source.suffix == ".py":
                    compile(text, mutant.file, "exec")
            except (Unfit, SyntaxError) as problem:
                return "invalid", f"does not build: {last_error(str(problem))}"
            for kind, what in stages_of(mutant, quick):
                try:
                    failure = self.stage(kind, what)
                except Unfit as problem:
                    # It compiled: what it breaks is what runs while installing.
                    failure = f"installing: {last_error(str(problem))}"
                if failure:
                    return "killed", failure
            return "survived", "tests of its room" if quick else "all tests"
        finally:
            source.write_bytes(kept)


def stages_of(mutant, quick):
    """The tests a mutant meets, in order; a change of Python meets no Fortran test."""
    own = OWN_STAGES[mutant.room]
    if mutant.first and mutant.first.endswith(".py"):
        kind = "installed" if mutant.first.startswith("test/embed/") else "python"
        own = [(kind, [mutant.first])] + own
    elif mutant.first:
        own = [("fortran", mutant.first)] + own
    others = [] if quick else [stage for stage in ALL_STAGES if stage not in own]
    return [stage for stage in own + others
            if stage[0] != "fortran" or mutant.file.endswith((".f90", ".c"))]


def is_test(failure):
    """Is it the name of a test, or a crash or a time-out?"""
    return not failure.startswith(("crash ", TIME_OUT))


def last_error(text):
    lines = [line for line in text.splitlines() if line.strip()]
    errors = [line for line in lines if "Error" in line]
    return (errors or lines or ["?"])[-1].strip()[:90]


def stage_name(kind, what):
    return f"{kind} {what if isinstance(what, str) else ' '.join(what)}".strip()


def first_failure(command, folder, variables, limit):
    """Run tests up to the first that fails; its name, a crash or a time-out, or None."""
    process = subprocess.Popen(command, cwd=folder, env=variables, stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               encoding="utf-8", errors="replace", start_new_session=True)
    late = threading.Event()

    def stop():
        late.set()
        end(process)

    timer = threading.Timer(limit, stop) if limit is not None else None
    if timer:
        timer.start()
    last = "the start"
    try:
        for line in process.stdout:
            if line.startswith("FAILED "):
                return line.split()[1]
            if re.match(r"\S+/\S+ +\d+ passed", line):
                last = line.split()[0]
        code = process.wait()
        if late.is_set():
            return f"{TIME_OUT} after {last}"
        return None if code == 0 else f"crash ({code}) after {last}"
    finally:
        if timer:
            timer.cancel()
        end(process)


def end(process):
    """End a process and what it started."""
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
    if process.poll() is None:
        process.wait()


class Results:
    """What earlier runs found, one line of JSON each."""

    def __init__(self, path):
        self.path, self.found, self.lock = path, {}, threading.Lock()
        if path.exists():
            for line in path.read_text(encoding="utf-8").splitlines():
                try:
                    entry = json.loads(line)
                    self.found[entry["key"]] = entry
                except (ValueError, KeyError):
                    continue  # the line a broken-off run was writing

    def get(self, key, quick):
        """A verdict that still holds; `survived` only of as many tests as asked for."""
        entry = self.found.get(key)
        if entry and entry["verdict"] == "survived" and entry["quick"] and not quick:
            return None
        return entry

    def put(self, key, **entry):
        with self.lock:
            self.found[key] = {"key": key, **entry}
            with open(self.path, "a", encoding="utf-8") as file:
                file.write(json.dumps(self.found[key]) + "\n")


def check_base(base, mutants, quick, results):
    """Run the tests without a mutant; seconds of each stage."""
    stages = []
    for mutant in mutants:
        stages += stages_of(mutant, quick)
    seconds = {}
    job = Job(base, "base", {})
    job.clear()
    for kind, what in stages:
        name = stage_name(kind, what)
        if name in seconds:
            continue
        key = f"{base.hash} {name}"
        known = results.get(key, True)
        if known is None:
            print(f"without a mutant: {name}", flush=True)
            start = time.monotonic()
            failure = job.stage(kind, what)
            if failure:
                raise Unfit(f"a test fails without a mutant: {failure}")
            results.put(key, verdict="base", quick=True, seconds=time.monotonic() - start)
            known = results.get(key, True)
        seconds[name] = known["seconds"]
    return seconds


def run(mutants, base, results, options):
    """Judge all; a list of (mutant, verdict, by)."""
    seconds = check_base(base, mutants, options.quick, results) if mutants else {}
    jobs = queue.SimpleQueue()
    for number in range(options.jobs):
        jobs.put(Job(base, number, seconds))

    def judge(mutant):
        key = mutant.key(base.hash)
        entry = results.get(key, options.quick)
        if entry is None:
            job = jobs.get()
            try:
                start = time.monotonic()
                verdict, by = job.judge(mutant, options.quick)
                results.put(key, id=mutant.id, verdict=verdict, by=by, quick=options.quick,
                            seconds=time.monotonic() - start)
            finally:
                jobs.put(job)
            entry = results.get(key, options.quick)
        print(f"{mutant.id:44} {entry['verdict']:9} {entry['by']}", flush=True)
        return mutant, entry["verdict"], entry["by"]

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        return list(pool.map(judge, mutants))


def tell(found):
    """Print the table and the counts; whether all is well."""
    counts = {"killed": 0, TIME_OUT: 0, "survived": 0, "equivalent": 0, "invalid": 0}
    bad = []
    print(f"\n{'mutant':44} {'verdict':10} by")
    for mutant, verdict, by in found:
        shown = verdict
        if verdict == "survived" and mutant.equivalent:
            shown, by = "equivalent", mutant.equivalent
        counts[TIME_OUT if shown == "killed" and by.startswith(TIME_OUT) else shown] += 1
        if shown in ("survived", "invalid"):
            bad.append(mutant)
        elif shown == "killed" and mutant.equivalent:
            by = f"{by}, although it is named equivalent"
            bad.append(mutant)
        print(f"{mutant.id:44} {shown:10} {by}")
    for mutant in bad:
        print(f"\nsee {mutant.id} in {mutant.room}.toml: {mutant.file}\n"
              f"    {mutant.text}\n    -> {mutant.replacement}\n    {mutant.why}")
    print(f"\n{len(found)} mutants: " + ", ".join(f"{n} {word}" for word, n in counts.items()
                                              if n or word != TIME_OUT))
    return not bad


def main():
    here = pathlib.Path(__file__).resolve().parents[2]
    parser = argparse.ArgumentParser()
    parser.add_argument("room", nargs="?", metavar="ROOM")
    parser.add_argument("--only", action="append", default=[], metavar="ID")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, metavar="N")
    parser.add_argument("--quick", action="store_true", help="only the tests of a mutant's room")
    parser.add_argument("--lists", type=pathlib.Path, metavar="FOLDER")
    parser.add_argument("--root", type=pathlib.Path, default=here, metavar="FOLDER")
    options = parser.parse_args()
    if options.jobs < 1:
        parser.error(f"--jobs must be at least 1, got {options.jobs}")
    root = options.root.resolve()
    try:
        mutants = read_lists(options.lists or root / "tools/check/mutants", options.room)
        unknown = sorted(set(options.only) - {mutant.id for mutant in mutants})
        if unknown:
            raise Unfit(f"no mutant {', '.join(unknown)}")
        if options.only:
            mutants = [mutant for mutant in mutants if mutant.id in options.only]
        for mutant in mutants:
            mutant.applied((root / mutant.file).read_text(encoding="utf-8"))
        kept = root / "build" / "mutants"
        kept.mkdir(parents=True, exist_ok=True)
        lock = open(kept / "lock", "w", encoding="utf-8")
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise Unfit(f"another run uses {kept}") from None
        base = Base(root, pathlib.Path(sys.executable))
        results = Results(root / "build" / "mutants" / "results.jsonl")
        found = run(mutants, base, results, options)
    except (Unfit, OSError) as problem:
        print(f"mutants: {problem}", file=sys.stderr)
        return 2
    return 0 if tell(found) else 1


if __name__ == "__main__":
    sys.exit(main())
