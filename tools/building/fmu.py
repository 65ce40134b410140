#!/usr/bin/env python3
"""Make the functional mock-up units faststrip_wheelset_2.fmu and faststrip_wheelset_3.fmu, of FMI
2.0 and 3.0, of the C sources in fmu and an installed library.

    fmu.py --prefix FOLDER --folder FOLDER [FILE...]

FOLDER of --prefix is what `./run install` made; the units come into the other one. Each FILE, a
profile, is packed into their resources, where parameters find it by its name. The header files of
FMI are those of the installed FMPy. A unit needs the C library alone: of LAPACK it takes the two
routines of tools/building/cmake/lapack_small.f90, and it holds the run-time libraries of Fortran.
"""

import argparse
import ctypes
import importlib.util
import pathlib
import platform
import re
import subprocess
import sys
import tempfile
import tomllib
import uuid
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tools" / "generate"))
from fmu_variables import NAME, c_table, description, variables  # noqa: E402

SOURCES = ROOT / "fmu"
WARNINGS = ("-Wall", "-Wextra", "-Werror", "-Wno-unused-parameter")
OWN_LAPACK = ("dpbtrf", "dpbtrs")
BUNDLED = ("libgfortran", "libquadmath")
LONG_AGO = (1980, 1, 1, 0, 0, 0)


def command(*words, folder=None):
    done = subprocess.run([str(word) for word in words], stdout=subprocess.PIPE, cwd=folder,
                          stderr=subprocess.STDOUT, encoding="utf-8", check=False)
    if done.returncode != 0:
        sys.exit(f"fmu: {words[0]} failed\n{done.stdout}")
    return done.stdout


def headers():
    """Where FMPy has the header files of FMI; it is not imported."""
    found = importlib.util.find_spec("fmpy")
    if found is None:
        sys.exit("fmu: there is no FMPy: pip install -r tools/requirements-fmu.txt")
    return pathlib.Path(found.submodule_search_locations[0]) / "c-code"


def link(version, prefix, work):
    """The library of a unit."""
    target = work / f"{NAME}_{version}.so"
    script = work / f"fmi{version}.map"
    script.write_text(f"{{\n    global: fmi{version}*;\n    local: *;\n}};\n", encoding="utf-8")
    objects = []
    for source in (f"fmi{version}", "model"):
        objects.append(work / f"{source}_{version}.o")
        command("gcc", "-std=c99", "-D_POSIX_C_SOURCE=200809L", "-O2", "-fPIC", *WARNINGS,
                f"-I{prefix / 'include'}", f"-I{headers()}", f"-I{work}", "-c",
                SOURCES / f"{source}.c", "-o", objects[-1])
    command("gfortran", "-shared", "-static-libgcc", *objects, prefix / "lib" / "libfaststrip.a",
            work / "lapack_small.o",
            *(f"-Wl,--defsym={name}_=__faststrip_numerics_lapack_MOD_{name}"
              for name in OWN_LAPACK),
            f"-Wl,--version-script={script}", "-Wl,--no-undefined,--gc-sections,-s",
            "-Wl,--disable-new-dtags,-rpath,$ORIGIN", "-o", target)
    return target


def bundled(library):
    """The run-time libraries of Fortran that a library needs."""
    found = re.findall(r"(\S+) => (\S+)", command("ldd", library))
    return [(name, pathlib.Path(path)) for name, path in found if name.startswith(BUNDLED)]


def start_values(library, token):
    """What a new instance has, as texts of the description."""
    unit = ctypes.CDLL(str(library))
    unit.fmi3InstantiateModelExchange.restype = ctypes.c_void_p
    instance = ctypes.c_void_p(unit.fmi3InstantiateModelExchange(
        b"", token.encode(), b"", False, False, None, None))
    texts = {}
    types = {"REAL": ("Float64", ctypes.c_double), "INTEGER": ("Int64", ctypes.c_int64),
             "BOOLEAN": ("Boolean", ctypes.c_bool), "STRING": ("String", ctypes.c_char_p)}
    for index, variable in enumerate(variables()):
        if variable.causality not in ("parameter", "input"):
            continue
        name, kind = types[variable.c_kind]
        value, reference = (kind * 1)(), (ctypes.c_uint32 * 1)(index)
        if getattr(unit, f"fmi3Get{name}")(instance, reference, ctypes.c_size_t(1), value,
                                           ctypes.c_size_t(1)) != 0:
            sys.exit(f"fmu: the unit does not tell {variable.name}")
        texts[variable.name] = (value[0].decode() if kind is ctypes.c_char_p
                                else str(value[0]).lower())
    unit.fmi3FreeInstance(instance)
    return texts


def pack(target, files):
    """Write a unit, of bytes by name, whole or not at all."""
    new = target.with_suffix(".new")
    with zipfile.ZipFile(new, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            about = zipfile.ZipInfo(name, LONG_AGO)
            about.compress_type, about.external_attr = zipfile.ZIP_DEFLATED, 0o644 << 16
            archive.writestr(about, data)
    new.replace(target)
    print(f"{target.name}: {target.stat().st_size / 1e6:.1f} MB")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--prefix", required=True, type=pathlib.Path)
    parser.add_argument("--folder", required=True, type=pathlib.Path)
    parser.add_argument("files", nargs="*", type=pathlib.Path, metavar="FILE")
    options = parser.parse_args()
    prefix = options.prefix.absolute()
    for path in options.files:
        if not path.is_file():
            sys.exit(f"fmu: no such file: {path}")
    options.folder.mkdir(parents=True, exist_ok=True)
    with open(ROOT / "fpm.toml", "rb") as file:
        release = tomllib.load(file)["version"]
    # The same sources are the same unit.
    token = str(uuid.uuid5(uuid.NAMESPACE_URL, c_table("") + release))
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        (work / "variables.h").write_text(c_table(token), encoding="utf-8")
        command("gfortran", "-O3", "-fPIC", "-c", ROOT / "src/faststrip/base/kinds.f90",
                ROOT / "tools/building/cmake/lapack_small.f90", folder=work)
        libraries = {version: link(version, prefix, work) for version in (2, 3)}
        starts = start_values(libraries[3], token)
        common = {f"resources/{path.name}": path.read_bytes() for path in options.files}
        common["documentation/licenses/license.txt"] = (ROOT / "LICENSE").read_bytes()
        common["documentation/licenses/LICENSES_bundled.txt"] = (
            ROOT / "python" / "LICENSES_bundled.txt").read_bytes()
        for version, place in ((2, "linux64"), (3, f"{platform.machine()}-linux")):
            files = {"modelDescription.xml": description(version, release, token, starts),
                     f"binaries/{place}/{NAME}.so": libraries[version].read_bytes()}
            for library, path in bundled(libraries[version]):
                files[f"binaries/{place}/{library}"] = path.read_bytes()
            pack(options.folder / f"{NAME}_{version}.fmu", files | common)


if __name__ == "__main__":
    main()
