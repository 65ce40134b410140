#!/usr/bin/env python3
"""Build what the program loads when it is to write NetCDF: src/netcdf as a shared library.

    netcdf_plugin.py --flags FLAGS -o LIBRARY

Linked to the program, netcdf-fortran and the three dozen libraries behind it would make each start
three times as long. So src/netcdf and the modules that it uses are compiled together here, if one
of them, the compiler or its words have changed since the last time. Where netcdf-fortran is,
pkg-config tells.
"""

import argparse
import hashlib
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
FIRST = "faststrip_netcdf_plugin"
WORK = ROOT / "build" / "netcdf"
# Where the modules of these beginnings are; all others are of the core.
PACKAGES = {"netcdf": "src/netcdf", "files": "src/files"}
USE = re.compile(r"^\s*use\s+(faststrip_\w+)", re.MULTILINE)


def path_of(module):
    """The source of a module, which is named as its path; folder/folder.f90 says the word once."""
    room, _, name = module.removeprefix("faststrip_").partition("_")
    folder = ROOT / PACKAGES.get(room, f"src/faststrip/{room}")
    words = name.split("_")
    nested = [folder / "_".join(words[:i]) / f"{'_'.join(words[i:])}.f90"
              for i in range(1, len(words))]
    found = [path for path in (*nested, folder / name / f"{name}.f90") if path.exists()]
    return found[0] if found else folder / f"{name}.f90"


def sources(module, found):
    """The sources of a module, each behind those that it uses; C beside Fortran belongs to it."""
    path = path_of(module)
    if path in found:
        return
    for used in USE.findall(path.read_text(encoding="utf-8")):
        sources(used, found)
    beside = path.with_suffix(".c")
    found.update(dict.fromkeys([beside, path] if beside.exists() else [path]))


def plugin_sources():
    """Names of all sources, as from the root of the project."""
    found = {}
    sources(FIRST, found)
    return tuple(str(path.relative_to(ROOT)) for path in found)


def where_netcdf_is():
    """Words for the compiler. Its folder of modules may be one that C looks into anyway."""
    done = subprocess.run(["pkg-config", "--cflags", "--libs", "netcdf-fortran"],
                          capture_output=True, encoding="utf-8", check=False,
                          env={**os.environ, "PKG_CONFIG_ALLOW_SYSTEM_CFLAGS": "1"})
    if done.returncode != 0:
        sys.exit(f"netcdf_plugin: {done.stderr.strip()}")
    return shlex.split(done.stdout)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--flags", required=True)
    parser.add_argument("-o", dest="library", required=True, type=pathlib.Path)
    options = parser.parse_args()
    found = {}
    sources(FIRST, found)
    compiler = shutil.which("gfortran") or "gfortran"
    in_c = [path for path in found if path.suffix == ".c"]
    objects = [WORK / f"{path.stem}.o" for path in in_c]
    calls = [["gcc", "-O3", "-fPIC", "-c", path, "-o", target]
             for path, target in zip(in_c, objects, strict=True)]
    calls.append([compiler, *shlex.split(options.flags), "-shared", f"-J{WORK}",
                  *(path for path in found if path not in in_c), *objects, "-Wl,--no-undefined",
                  *where_netcdf_is(), "-o"])
    digest = hashlib.sha256(repr(calls).encode())
    for path in (*found, pathlib.Path(compiler)):
        digest.update(path.read_bytes())
    note = WORK / "made_of"
    if options.library.exists() and note.exists() and note.read_text() == digest.hexdigest():
        return
    WORK.mkdir(parents=True, exist_ok=True)
    new = options.library.with_name(f"{options.library.name}.new")
    calls[-1].append(new)
    for words in calls:
        done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              encoding="utf-8", check=False)
        if done.returncode != 0:
            sys.exit(f"netcdf_plugin: the build failed\n{done.stdout}")
    # One that is loaded at the moment can be replaced, not written over.
    os.replace(new, options.library)
    note.write_text(digest.hexdigest(), encoding="utf-8")


if __name__ == "__main__":
    main()
