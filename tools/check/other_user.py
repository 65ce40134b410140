"""A user without rights, and programs where that one may run them."""

import atexit
import functools
import os
import pathlib
import shutil
import subprocess
import tempfile

NOBODY = 65534


def without_rights():
    """The user for whom permissions hold: nobody, where root runs this, else oneself."""
    return NOBODY if os.geteuid() == 0 else None


@functools.cache
def runnable(program):
    """A program and what lies beside it as that user may run them. A checkout may be in a folder
    that others must not enter: for nobody they are copied. If even these cannot be run, the
    error says why."""
    program = pathlib.Path(program)
    if without_rights() is None:
        return program
    place = pathlib.Path(tempfile.mkdtemp())
    atexit.register(shutil.rmtree, place, ignore_errors=True)
    for path in program.parent.iterdir():
        if path.is_file():
            shutil.copyfile(path, place / path.name)
            (place / path.name).chmod(0o755)
    place.chmod(0o755)
    subprocess.run([place / program.name, "--version"], user=NOBODY, capture_output=True,
                   check=True)
    return place / program.name


def why_not(program):
    """Why no user without rights can run a program, in one line, or nothing."""
    try:
        runnable(program)
    except (OSError, subprocess.SubprocessError) as error:
        return f"{pathlib.Path(program).name} cannot be run as user {NOBODY}: {error}"
    return ""
