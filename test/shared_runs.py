"""Runs of a program that several tests look at: each is done once per run of the tests.

What decides about a run is its key: the bytes of the program, its words, names and bytes of the
files it finds. What it said and the files it made are kept in the folder that conftest.py makes
for a run of the tests, or in one of this process; the first who asks
runs it, and who asks meanwhile, in this process or another, waits.
"""

import atexit
import dataclasses
import fcntl
import functools
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import tempfile

# Where conftest.py says that runs are kept.
PLACE = "FASTSTRIP_SHARED_RUNS"


@dataclasses.dataclass
class SharedRun:
    """What a run left; like subprocess.CompletedProcess, with the files it made."""

    returncode: int
    stdout: str
    stderr: str
    made: dict  # names to bytes


def files_below(folder):
    """Names and bytes of all files of a folder."""
    return {path.relative_to(folder).as_posix(): path.read_bytes()
            for path in sorted(folder.rglob("*")) if path.is_file()}


def write_files(folder, files):
    for name, data in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)


def shared_run(words, found, timeout):
    """Run words[0] in a folder with the files `found`, unless it has been done.

    Words must not name places that are a test's own.
    """
    words = [str(word) for word in words]
    kept = place() / key_of(words, found)
    with open(kept.with_suffix(".lock"), "w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not kept.exists():
            keep(kept, words, found, timeout)
    said = json.loads((kept / "said.json").read_text(encoding="utf-8"))
    return SharedRun(**said, made=files_below(kept / "made"))


def made_once(name, make):
    """A folder that make(folder) has filled, for all processes of a run of the tests."""
    folder = place() / name
    with open(folder.with_suffix(".lock"), "w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        done = folder / "done"
        if not done.exists():
            folder.mkdir(exist_ok=True)
            make(folder)
            done.touch()
    return folder


@functools.cache
def place():
    named = os.environ.get(PLACE)
    if named:
        return pathlib.Path(named)
    folder = pathlib.Path(tempfile.mkdtemp())
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


def key_of(words, found):
    program = hashlib.sha256(pathlib.Path(words[0]).read_bytes()).hexdigest()
    files = {name: hashlib.sha256(data).hexdigest() for name, data in found.items()}
    return hashlib.sha256(json.dumps([program, words, files]).encode()).hexdigest()


def keep(kept, words, found, timeout):
    """Run, and put all that is left of it in its place at once."""
    with tempfile.TemporaryDirectory(dir=kept.parent) as name:
        folder, left = pathlib.Path(name, "run"), pathlib.Path(name, "left")
        folder.mkdir()
        write_files(folder, found)
        done = subprocess.run(words, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, encoding="utf-8", timeout=timeout,
                              check=False)
        made = {name: data for name, data in files_below(folder).items()
                if found.get(name) != data}
        (left / "made").mkdir(parents=True)
        write_files(left / "made", made)
        (left / "said.json").write_text(json.dumps(
            {name: getattr(done, name) for name in ("returncode", "stdout", "stderr")}),
            encoding="utf-8")
        left.rename(kept)
