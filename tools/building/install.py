#!/usr/bin/env python3
"""Install faststrip below a prefix: program, library, modules, header, man page, completion for
shells, what tells pkg-config and CMake about them, and the scripts that draw for --plot.

    install.py --stage FOLDER --program FILE --prefix FOLDER

FOLDER of --stage is what `fpm install` made of the core and of src/files, whose readers of profiles
belong to the library too, and FILE the program, beside which lies what it loads to write NetCDF.
The archives could be handed on as they are, but for what hosts of other languages need and what
they must not see:

- Only public names are visible: what `use faststrip` gives, the modules that its head lists, the C
  and F77 interfaces. No host can come to depend on a procedure behind them, or clash with it. Local
  names do not reach across files, so what the public names need of the archives is linked into one
  object first. The rest, words for the packages above, stays out, and with it variables of the
  compiler's.
- F77's procedures have second names without underscore, for hosts that are compiled with
  -fno-underscoring, and for C.
- The shared library has a soname, which changes when programs have to be linked anew, and a
  version at each name, so that a program built with a later release is refused by an older one.
- The pkg-config file and the CMake package tell compilers where all that is, and what static
  linking needs more. The latter is the one that CMakeLists.txt makes, for find_package.
"""

import argparse
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tomllib

from completion import completions
from man_page import man_page

ROOT = pathlib.Path(__file__).resolve().parents[2]
# What the program loads to write NetCDF.
NETCDF = "faststrip_netcdf.so"
# What plots/plot.py, which draws for --plot, needs of its package.
DRAWS = ("__init__", "command", "looks", "panels", "picture", "results", "style", "tables")
PKG_CONFIG = """\
prefix={prefix}
libdir=${{prefix}}/lib
includedir=${{prefix}}/include

Name: faststrip
Description: Wheel/rail contact by the modified strip method
Version: {version}
Cflags: -I${{includedir}} -I${{includedir}}/faststrip
Libs: -L${{libdir}} -lfaststrip
Libs.private: {run_time}
Requires.private: openblas
"""

CMAKE_CONFIG = """\
# Gives the targets faststrip::faststrip, the shared library, and faststrip::static, the archive.
include(CMakeFindDependencyMacro)
find_dependency(LAPACK)
if(NOT TARGET faststrip::faststrip)
    get_filename_component(faststrip_PREFIX "${{CMAKE_CURRENT_LIST_DIR}}/../../.." ABSOLUTE)
    add_library(faststrip::faststrip SHARED IMPORTED)
    set_target_properties(faststrip::faststrip PROPERTIES
        IMPORTED_LOCATION "${{faststrip_PREFIX}}/lib/libfaststrip.so.{version}"
        IMPORTED_SONAME libfaststrip.so.{major})
    add_library(faststrip::static STATIC IMPORTED)
    set_target_properties(faststrip::static PROPERTIES
        IMPORTED_LOCATION "${{faststrip_PREFIX}}/lib/libfaststrip.a"
        INTERFACE_LINK_LIBRARIES "LAPACK::LAPACK;{run_time}")
    set_property(TARGET faststrip::faststrip faststrip::static PROPERTY
        INTERFACE_INCLUDE_DIRECTORIES
        "${{faststrip_PREFIX}}/include" "${{faststrip_PREFIX}}/include/faststrip")
endif()
"""
# As the soname: programs of an older release of the same major version go on.
CMAKE_VERSION = """\
set(PACKAGE_VERSION "{version}")
if(PACKAGE_VERSION VERSION_LESS PACKAGE_FIND_VERSION
        OR NOT "${{PACKAGE_FIND_VERSION_MAJOR}}" STREQUAL "{major}"
        OR (PACKAGE_FIND_VERSION_RANGE AND PACKAGE_VERSION VERSION_GREATER
            PACKAGE_FIND_VERSION_MAX))
    set(PACKAGE_VERSION_COMPATIBLE FALSE)
else()
    set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
if(PACKAGE_VERSION VERSION_EQUAL PACKAGE_FIND_VERSION)
    set(PACKAGE_VERSION_EXACT TRUE)
endif()
if(CMAKE_SIZEOF_VOID_P AND NOT CMAKE_SIZEOF_VOID_P EQUAL {pointer})
    set(PACKAGE_VERSION_UNSUITABLE TRUE)
endif()
"""


def command(*words):
    done = subprocess.run([str(word) for word in words], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, encoding="utf-8", check=False)
    if done.returncode != 0:
        sys.exit(f"install: {words[0]} failed\n{done.stdout}")
    return done.stdout


def defined_names(archives):
    """All global functions and data of archives."""
    names = set()
    for line in command("nm", "--defined-only", "--extern-only", *archives).splitlines():
        words = line.split()
        if len(words) == 3 and words[1] in "TDBR":
            names.add(words[2])
    return names


# Where the abstract methods are that a host's own methods extend.
EXTENDED = ("method", "method_capacity")


CORE = ROOT / "src" / "faststrip"


def by_module():
    """Modules that a host may use beside `faststrip`, as the head of that one lists them."""
    text = (CORE / "faststrip.f90").read_text(encoding="utf-8")
    head = "\n".join(re.findall(r"^!>.*$", text, re.MULTILINE))
    return sorted(set(re.findall(r"faststrip_\w+", head)))


def fortran_names():
    """The linker's names of what a Fortran host may use, whether they are procedures or not: what
    `use faststrip` gives, what is public of the modules beside it; of types the tables of their
    procedures, and those that a host's methods inherit."""
    modules, given = by_module(), []
    for path in CORE.rglob("*.f90"):
        source = re.sub(r"!.*", "", path.read_text(encoding="utf-8"))
        source = re.sub(r"&\s*\n\s*", "", source)
        module = re.search(r"^module (\w+)", source, re.MULTILINE)[1]
        if module in modules:
            given += [(module, name) for names in re.findall(r"public :: (.*)$", source,
                                                             re.MULTILINE)
                      for name in re.findall(r"\w+", names)]
        elif module == "faststrip":
            given += [(origin, name) for origin, only in
                      re.findall(r"^\s*use (\w+), only: (.*)$", source, re.MULTILINE)
                      for name in re.findall(r"\w+", only)]
    names = set()
    for module, name in given:
        names.add(f"__{module}_MOD_{name}")
        names.add(f"__{module}_MOD___vtab_{module}_{name.capitalize()}")
    for last in EXTENDED:
        source = CORE / "contact" / "method" / f"{last.split('_')[-1]}.f90"
        bound = re.findall(r"procedure :: \w+ => (\w+)", source.read_text(encoding="utf-8"))
        names.update(f"__faststrip_contact_{last}_MOD_{name}" for name in bound)
    return names


def public_names(archives):
    """Names that stay visible, and those that get a second name without underscore."""
    defined = defined_names(archives)
    c_face = {name for name in defined if re.fullmatch(r"faststrip_[a-z_]+", name)}
    f77_face = {name for name in defined if re.fullmatch(r"fs[a-z]{1,4}_", name)}
    if not c_face or not f77_face:
        sys.exit(f"install: {archives[0]} has no C or F77 interface")
    return (fortran_names() & defined) | c_face | f77_face, f77_face


def link_object(archives, names, aliases, target):
    """One object of what the names need, in which only they and the second ones are visible."""
    listed = target.with_suffix(".names")
    listed.write_text("".join(f"{name}\n" for name in sorted(names | plain(aliases))),
                      encoding="utf-8")
    needed = [word for name in sorted(names) for word in ("-u", name)]
    second = [f"--defsym={name[:-1]}={name}" for name in sorted(aliases)]
    command("ld", "-r", *needed, *second, *archives, "-o", target)
    command("objcopy", f"--keep-global-symbols={listed}", target)


def plain(aliases):
    return {name[:-1] for name in aliases}


def install_library(stage, prefix, version):
    library = prefix / "lib"
    library.mkdir(parents=True, exist_ok=True)
    work = stage / "link"
    work.mkdir(exist_ok=True)
    # The one that needs the other goes before it.
    archives = [stage / "lib" / f"lib{name}.a" for name in ("faststrip-files", "faststrip")]
    names, aliases = public_names(archives)
    whole = work / "faststrip.o"
    link_object(archives, names, aliases, whole)
    static = library / "libfaststrip.a"
    static.unlink(missing_ok=True)
    command("ar", "rcs", static, whole)
    major, minor, _ = version.split(".")
    script = work / "faststrip.map"
    listed = "".join(f"        {name};\n" for name in sorted(names | plain(aliases)))
    script.write_text(f"FASTSTRIP_{major}.{minor} {{\n    global:\n{listed}    local: *;\n}};\n",
                      encoding="utf-8")
    soname = f"libfaststrip.so.{major}"
    shared = library / f"libfaststrip.so.{version}"
    shared.unlink(missing_ok=True)
    command("gfortran", "-shared", whole, f"-Wl,-soname,{soname}", f"-Wl,--version-script={script}",
            "-Wl,--no-undefined", "-Wl,--as-needed", "-lopenblas", "-o", shared)
    for link in (soname, "libfaststrip.so"):
        (library / link).unlink(missing_ok=True)
        (library / link).symlink_to(shared.name)


# What Fortran's run-time library calls once a program has threads, by references too weak to
# bring it along from an archive: without, a program linked statically jumps to nowhere at its end.
OF_THREADS = ("pthread_mutex_init", "pthread_mutex_destroy", "pthread_cond_init",
              "pthread_cond_destroy", "pthread_cond_wait", "pthread_cond_broadcast")


def run_time_libraries():
    """What a program linked statically needs of Fortran's compiler, in the linker's order."""
    names = ["gfortran", "quadmath", "m"]
    # Not every machine has the one with numbers of 16 bytes; a name that comes back was not found.
    if command("gfortran", "-print-file-name=libquadmath.a").strip() == "libquadmath.a":
        names.remove("quadmath")
    wanted = ",".join(f"-u,{name}" for name in OF_THREADS)
    return [f"-Wl,{wanted}", *(f"-l{name}" for name in names)]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--stage", required=True, type=pathlib.Path)
    parser.add_argument("--program", required=True, type=pathlib.Path)
    parser.add_argument("--prefix", required=True, type=pathlib.Path)
    options = parser.parse_args()
    prefix = options.prefix.absolute()
    with open(ROOT / "fpm.toml", "rb") as file:
        version = tomllib.load(file)["version"]
    copies = (
        (options.program, "bin/faststrip"),
        (options.program.with_name(NETCDF), f"lib/faststrip/{NETCDF}"),
        *((options.stage / "include" / f"{name}.mod", f"include/faststrip/{name}.mod")
          for name in ("faststrip", *by_module())),
        (ROOT / "include" / "faststrip.h", "include/faststrip.h"),
        (ROOT / "LICENSE", "share/doc/faststrip/LICENSE"),
    )
    plots = [(ROOT / "plots" / name, f"share/faststrip/plots/{name}")
             for name in ("plot.py", "conicity.py", "wheelset.py")]
    plots += [(source, f"share/faststrip/plots/faststrip_plots/{source.name}")
              for source in (ROOT / "plots" / "faststrip_plots" / f"{name}.py" for name in DRAWS)]
    plots.append((ROOT / "python" / "faststrip" / "_style.py",
                  "share/faststrip/python/faststrip/_style.py"))
    for source, target in copies + tuple(plots):
        (prefix / target).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source, prefix / target)
    program = prefix / "bin" / "faststrip"
    texts = {"share/man/man1/faststrip.1": man_page(program, version), **completions(program)}
    for name, text in texts.items():
        (prefix / name).parent.mkdir(parents=True, exist_ok=True)
        (prefix / name).write_text(text, encoding="utf-8")
    install_library(options.stage, prefix, version)
    run_time = run_time_libraries()
    about = {"prefix": prefix, "version": version, "major": version.split(".")[0],
             "pointer": struct.calcsize("P")}
    for name, text, separator in (("pkgconfig/faststrip.pc", PKG_CONFIG, " "),
                                  ("cmake/faststrip/faststripConfig.cmake", CMAKE_CONFIG, ";"),
                                  ("cmake/faststrip/faststripConfigVersion.cmake", CMAKE_VERSION,
                                   ";")):
        path = prefix / "lib" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text.format(run_time=separator.join(run_time), **about), encoding="utf-8")


if __name__ == "__main__":
    main()
