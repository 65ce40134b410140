#!/usr/bin/env python3
"""usage: ./run COMMAND

  build         build the release; the programs are then bin/faststrip and bin/faststrip-lab
  test [TEXT] [--quick]
                run all tests and lint, or those whose room/module::test contains TEXT; --quick:
                rooms and interfaces only, by the release, and nothing that takes long
  lint [TEXT]   check the form of the sources: ruff, shellcheck, line lengths
  bare [TEXT]   as root, where debootstrap can be had: demo and test, or test TEXT, in a bare Debian
                12, as root and as a user without rights; in build/bare/, about an hour
  mutants [ROOM] [--only ID] [--jobs N] [--quick]
                change one thing at a time in a copy and list the changes that no test notices;
                --quick runs the tests of the room only
  hostile [N] [--seed S]
                build, then try 500 (or N) hostile inputs: each must end with one clear line
  fuzz [CASES]  build, then solve 100000 (or CASES) random contacts and check the answers
  corrections   build, then solve 47400 random contacts by NORM and TANG, fit the error of
                FASTSTRIP's forces, and write it into the sources; about two hours; contacts that
                are in out/force_data/ are not solved again
  demo          build, then compute and draw the example; results in out/
  strips        build, then time the strip solver and draw its convergence; in out/strips/
  speed [--quick] [-o FILE]
                build, then time everything beside FASTSIM and CONTACT, median to largest; table
                and picture in out/ (--quick: half a minute)
  scale [--quick] [-o FILE]
                build, then measure batch on many contacts: rates, threads, parts, memory, CSV and
                NetCDF; table and picture in out/; some minutes and 20 GB of disk (--quick: half a
                minute)
  net [--keep]  build, install below build/, then run all methods, examples and hosts and list
                the outputs that differ from those kept; --keep keeps the new ones; in out/net/
  lookup [--quick]
                build, install below build/, then make a table of creep forces and report its
                errors, size, time, look-ups per second; in out/lookup/
  vehicle [--quick]
                build, install below build/, then run a bogie through a curve and up to its limit
                cycle with strips, Hertz and a table; pictures and figures in out/vehicle/; some
                ten minutes (--quick: half a minute)
  explore [FILE...]
                build, install below build/, then serve the interactive explorer: of a case file,
                or of the profiles of a wheel and a rail (--help: its options)
  page [-o FILE] [--moves N]
                build, install below build/, then time faststrip-explore in a browser: from the
                move of a slider to the picture; table in out/; some minutes
  extremes      build, then measure accuracy and steadiness at the extremes, also in single
                precision and in all rounding modes; in out/extremes/
  forces        build, then compare, time and draw the tangential methods; in out/forces/
  lists         write the sources and documents that follow from the lists of methods, settings,
                columns, arguments and tuned numbers; builds in between
  scenes        the first of the stored results: forces of 240 contacts; in reference/scenes/
  stored [NAME] build, then make the stored results again, all or one (listed in
                reference/stored.csv); everything has to be committed before, some minutes
  report [...]  build, then measure, compare and draw everything; in out/report/ (--quick: less)
  install --prefix FOLDER
                build, then install program, library, modules, header, man page and completion
                for shells there
  fmu [FILE...] make the functional mock-up units of a wheelset, FMI 2.0 and 3.0, for other
                simulators, with these profile files in them; in out/fmu/
  package       make the Python package for pip, with the library in it, its source distribution,
                and recipes for conda, Spack and Debian; in out/package/
  release [--check]
                check versions, documents and stored results, then make the Python package, its
                source distribution and the sources with the site; in out/release/
  docs          build the site: pages, run where they have pictures, and the Fortran interface;
                in out/docs/
  embed         build, then time calls from Fortran, F77, C and Python, and a vehicle's next call
                of a wheelset; in out/embed/
  tables        build, then audit, remake, time and draw the coefficient tables; in out/tables/
  compilers     try to build with gfortran 12 and the newest gfortran and flang of Debian
  clean [all]   remove what was built; with `all` also .venv
  help          this text

What is missing is installed first: Debian packages as root or with sudo, Python packages into
.venv. FASTSTRIP_FFLAGS adds compiler flags to the release build, for example -march=native.
"""

import concurrent.futures
import fcntl
import filecmp
import os
import pathlib
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[1]
LOGS = pathlib.Path("build/logs")
# Holds what stands for gfortran in fpm's builds.
COMPILER = pathlib.Path("build/compiler")
FPM = ".venv/bin/fpm"
PROGRAMS = ("faststrip", "faststrip-lab")

COMMON = "-frecursive -fimplicit-none -std=f2018"
# Nobody replaces the library's procedures by others of their names: so they may be inlined.
SHARED = "-fPIC -fno-semantic-interposition"
RELEASE_FLAGS = f"-O3 -fopenmp-simd {SHARED} {COMMON} {os.environ.get('FASTSTRIP_FFLAGS', '')}"
# Of the programs: rows of a batch are solved by threads. The library that is installed has no
# such directives, so that these flags change nothing of it, and it need not be compiled again.
PROGRAM_FLAGS = f"{RELEASE_FLAGS} -fopenmp"
# Without the C library's vector functions, which know rounding to nearest only.
SCALAR_FLAGS = f"-O3 -fno-tree-vectorize -fPIC {COMMON}"
TEST_FLAGS = (f"-Og -g -fopenmp-simd {COMMON} -Wall -Wextra -pedantic -Werror -Wno-compare-reals"
              " -Wno-unused-dummy-argument"
              " -fcheck=all -fbacktrace -ffpe-trap=invalid,zero,overflow -finit-real=snan")

# The pipelines: `== ` before a heading; the other lines are commands, run from the checkout.
DEMO = """
== the paper, section 5: S1002 on UIC60 1:40, 20 lateral shifts
faststrip sweep example/s1002_uic60.nml --normal norm --tangential tang -o out/sweep.csv
"""
DEMO_SHIFT = """
faststrip contact example/s1002_uic60.nml --shift {shift} -o out/contact_shift_{shift}.csv \
    --profiles out/profiles_shift_{shift}.csv --strips out/strips_shift_{shift}.csv \
    --fields out/fields_shift_{shift}.csv
faststrip contact example/s1002_uic60.nml --shift {shift} --normal norm --tangential tang \
    -o /dev/null --fields out/norm_shift_{shift}.csv
python plots/profiles.py --shift {shift} --strips out/strips_shift_{shift}.csv
python plots/patches.py --shift {shift} --norm out/norm_shift_{shift}.csv
"""
DEMO_END = """
python plots/sweep.py
python plots/overview.py
== stresses below a contact
faststrip contact example/s1002_uic60.nml --shift 0 -o /dev/null --below out/below.csv
python plots/subsurface.py
== a flange root on its curved surface
faststrip contact example/cases/curve_flange_root.nml --curved -o /dev/null \
    --strips out/strips.csv --gap out/gap.csv
python plots/curved_surface.py
== a wheelset on its track, from side to side
faststrip wheelset example/wheelset_states.nml --states example/wheelset_states.csv \
    -o out/wheelset.csv --strips out/wheelset_strips.csv --profiles out/wheelset_profiles.csv \
    --profiles-of 29
python plots/wheelset.py --states example/wheelset_states.csv
python plots/wear.py
== traction curves: constant friction, and friction that falls with slip
faststrip batch example/traction_curve.csv --normal hertz -o out/traction_faststrip.csv
faststrip batch example/traction_curve.csv --normal hertz --tangential fastsim \
    -o out/traction_fastsim.csv
faststrip batch example/traction_curve.csv --normal hertz --tangential tang \
    --element-dx 0.4 --element-dy 0.8 -o out/traction_tang.csv
python plots/traction_curve.py
== accuracy
python plots/accuracy.py
== done: tables and pictures are in out/, the accuracy table in out/accuracy.md
"""
TABLES = """
== the published table audited, and the paper as printed
faststrip table --audit -o {out}/audit.csv
faststrip-lab errata -o {out}/errata.csv >{out}/errata.txt
== tables made anew
faststrip table -o {out}/table_lsq.csv
faststrip table --fit minimax -o {out}/table_minimax.csv
faststrip table --fit author -o {out}/table_author.csv
faststrip table --degree 16 --basis chebyshev --format fortran -o {out}/strip_table.inc
== curves, degrees and times
faststrip table --curves {out}/curves.csv
faststrip table --degrees {out}/degrees.csv
faststrip-lab bench integral -o {out}/bench_integral.csv
python plots/integrals.py --curves {out}/curves.csv --folder {out}
python plots/degrees.py --degrees {out}/degrees.csv -o {out}/degrees.png
python plots/bench_integral.py --bench {out}/bench_integral.csv -o {out}/bench_integral.png
== done: tables, errata and pictures are in {out}/
"""
STRIPS = """
== errors against CONTACT, against many strips and against Hertz
faststrip-lab bench accuracy -o {out}/accuracy.csv
faststrip-lab bench convergence -o {out}/convergence.csv
== times
faststrip-lab bench normal -o {out}/bench_normal.csv
python plots/convergence.py --convergence {out}/convergence.csv -o {out}/convergence.png
python plots/bench_normal.py --bench {out}/bench_normal.csv -o {out}/bench_normal.png
== done: tables and pictures are in {out}/
"""
EXTREMES = """
== errors at the extremes
faststrip-lab bench extremes -o {out}/extremes.csv
== rounding modes without vector functions
"""
EXTREMES_END = """
{scalar} bench extremes --only rounding -o {out}/rounding.csv
== single precision
python tools/building/single_precision.py -o {out}/single.csv
python plots/extremes.py --extremes {out}/extremes.csv --rounding {out}/rounding.csv \
    --single {out}/single.csv --folder {out}
== done: tables and pictures are in {out}/
"""
FORCES = """
== errors of all tangential methods against CONTACT and TANG
faststrip-lab bench forces -o {out}/forces.csv
== times
faststrip-lab bench tangential -o {out}/bench_tangential.csv
python plots/forces.py
"""
FORCES_SHIFT = """
faststrip contact example/s1002_uic60.nml --shift {shift} --strips-per-patch 31 \
    --points-per-strip 31 -o /dev/null --fields {out}/fields_shift_{shift}.csv
python plots/tractions.py --shift {shift} --fields {out}/fields_shift_{shift}.csv \
    -o {out}/tractions_shift_{shift}.png
"""
FORCES_END = """
== done: tables and pictures are in {out}/
"""


class Trouble(Exception):
    """Why a step cannot be done, in one line, and what there is to read about it."""

    def __init__(self, why, log="", code=1):
        super().__init__(why)
        self.log = log
        self.code = code


# Running

def heading(text):
    print(f"\n== {text}", flush=True)


def exit_code(code):
    """An exit code as the shell has it: 128 + n after signal n."""
    return 128 - code if code < 0 else code


def do(*words, output=None):
    """Run a command; one that fails ends the step with its exit code and has said why."""
    code = exit_code(subprocess.run([str(word) for word in words], check=False,
                                    stdout=output).returncode)
    if code != 0:
        sys.exit(code)


def quietly(name, words, trouble, environment=None, work=""):
    """Run a command in silence; what it said is in its log, and told only if it fails. Of work that
    has a name it is told how far it is, once it takes long."""
    LOGS.mkdir(parents=True, exist_ok=True)
    log = LOGS / f"{name}.log"
    with open(log, "wb") as stream, subprocess.Popen(
            words, stdout=stream, stderr=subprocess.STDOUT, env=environment) as process:
        try:
            code = Progress(work, log).wait(process) if work else process.wait()
        except BaseException:
            process.kill()
            raise
    if code != 0:
        raise Trouble(trouble, log.read_text(encoding="utf-8", errors="replace"))


class Progress:
    """Tells on stderr how far a build by fpm is, by its log: on a terminal in one line that
    changes, elsewhere in a line from time to time. A build that is soon done is not told of."""

    FIRST, EVERY = 2.0, 15.0  # s

    def __init__(self, work, log):
        self.work, self.log = work, log
        self.start = self.told = time.monotonic()
        self.said = False
        self.terminal = sys.stderr.isatty()

    def wait(self, process):
        while True:
            try:
                code = process.wait(timeout=0.5)
            except subprocess.TimeoutExpired:
                self.tell()
                continue
            if self.said:
                self.say("done" if code == 0 else "failed")
                if self.terminal:
                    print(file=sys.stderr)
            return code

    def tell(self):
        now = time.monotonic()
        pause = (1.0 if self.terminal else self.EVERY) if self.said else self.FIRST
        if now - self.told < pause:
            return
        if not self.said and not self.terminal:
            print(f"run: building {self.work} (log: {self.log})", file=sys.stderr)
        text = self.log.read_text(encoding="utf-8", errors="replace")
        shares = re.findall(r"^\[ *(\d+)%\]", text, re.MULTILINE)
        self.say(f"{shares[-1] if shares else 0} %, {text.count('  done.')} compiled")
        self.told, self.said = now, True

    def say(self, words):
        minutes, seconds = divmod(int(time.monotonic() - self.start), 60)
        line = f"run: {self.work}: {words}, {minutes}:{seconds:02}"
        print(f"\r{line}\x1b[K" if self.terminal else line, end="" if self.terminal else "\n",
              file=sys.stderr, flush=True)


def pipeline(text, **names):
    """Do the lines of a pipeline, with {names} filled in."""
    programs = {name: f"bin/{name}" for name in PROGRAMS} | {"python": sys.executable}
    for line in filter(None, text.split("\n")):
        line = line.format(**names)
        if line.startswith("== "):
            heading(line[3:])
            continue
        first, *words = shlex.split(line)
        first = programs.get(first, first)
        if words[-1].startswith(">"):
            with open(words[-1][1:], "wb") as stream:
                do(first, *words[:-1], output=stream)
        else:
            do(first, *words)


def folder(name):
    """A folder below out/, made."""
    path = pathlib.Path("out", name)
    path.mkdir(parents=True, exist_ok=True)
    return path.as_posix()


# Building

def git(*words):
    """What git says, or nothing if it fails or there is none."""
    try:
        return subprocess.run(["git", *words], capture_output=True, encoding="utf-8",
                              check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def write_revision():
    """The module that tells the programs what they are and what they were built from; untouched if
    it is right."""
    with open("fpm.toml", "rb") as file:
        version = tomllib.load(file)["version"]
    revision = (os.path.exists(".git") and git("rev-parse", "--short", "HEAD")) or "unknown"
    if revision != "unknown" and git("status", "--porcelain"):
        revision += "-dirty"
    text = f"""\
!> Written by ./run: which version the program is, by fpm.toml, and of which revision.
module faststrip_command_revision
    implicit none
    private

    character(len=*), parameter, public :: version = '{version}'
    character(len=*), parameter, public :: revision = '{revision}'
end module faststrip_command_revision
"""
    path = pathlib.Path("app/command/revision.f90")
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


def compiler():
    """An environment in which gfortran is recompile.py: it keeps what sees no change."""
    real = shutil.which("gfortran")
    if real is None:
        raise Trouble("there is no gfortran")
    words = [sys.executable, "-IS", str(ROOT / "tools/building/recompile.py"), real]
    text = f'#!/bin/sh\nexec {shlex.join(words)} "$@"\n'
    path = COMPILER / "gfortran"
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        COMPILER.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        path.chmod(0o755)
    # Threads of fpm that wait take no time from what is built beside it.
    return {**os.environ, "OMP_WAIT_POLICY": "passive",
            "PATH": f"{COMPILER.resolve()}{os.pathsep}{os.environ['PATH']}"}


# What fpm builds in its packages, in words.
WORK = {"app": "the programs", "test": "the Fortran tests", "src/files": "the library"}


def fpm(name, package, command, flags, *words, trouble, twin=""):
    """Let fpm build; what the package `twin` has already compiled the same is taken from there.
    After a build that was not finished fpm takes what it had not yet come to for finished too: it
    is made to forget. Where it first looks for the packages they have other paths than once they
    are known, and paths are words of the compiler: they are looked for before, or the next command
    of fpm would compile everything again."""
    place = pathlib.Path(package, "build")
    place.mkdir(exist_ok=True)
    unfinished = place / "unfinished"
    with open(place / "lock", "w", encoding="utf-8") as lock:
        # One build at a time in a folder.
        fcntl.flock(lock, fcntl.LOCK_EX)
        if unfinished.exists():
            for path in place.rglob("*.digest"):
                path.unlink()
        unfinished.touch()
        drop_old_archives(place)
        quietly(name, [FPM, "update", "-C", package], trouble, compiler())
        # Without a buffer the log tells at any time how far fpm is.
        quietly(name, [FPM, command, "-C", package, "--compiler", "gfortran", "--flag", flags,
                       *words], trouble,
                compiler() | {"GFORTRAN_UNBUFFERED_ALL": "y"}
                | ({"FASTSTRIP_TWIN": str(ROOT / twin / "build")} if twin else {}), WORK[package])
        unfinished.unlink()


def drop_old_archives(place):
    """Remove libraries that hold an object of a source that is no longer there, or is elsewhere:
    fpm adds to a library and takes nothing out."""
    sources = tuple(f"{path.relative_to(ROOT).as_posix().replace('/', '_')}.o"
                    for folder in ("src", "app", "test/funit", "build/tests")
                    for end in ("f90", "c")
                    for path in pathlib.Path(ROOT, folder).rglob(f"*.{end}"))
    for archive in place.rglob("*.a"):
        members = subprocess.run(["ar", "t", archive], stdout=subprocess.PIPE, check=False,
                                 stderr=subprocess.DEVNULL, encoding="utf-8").stdout.split()
        # The name of an object is the path of its source from the package, or from one beside it.
        if not all(any(name.endswith(member.split("_.._")[-1].removeprefix(".._"))
                       for name in sources) for member in members):
            archive.unlink()


def fpm_build(name, package, flags, twin=""):
    fpm(name, package, "build", flags, trouble="the build failed", twin=twin)


def built(package, flags, *targets):
    """Paths of programs that fpm has built; fpm names them from the package's folder."""
    said = subprocess.run([FPM, "run", "-C", package, "--all", "--compiler", "gfortran",
                           "--flag", flags, "--runner", "echo"], stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, encoding="utf-8", env=compiler(),
                          check=False).stdout
    found = {path.name: path.as_posix() for path in (pathlib.Path(package, line.strip())
                                                     for line in said.splitlines())
             if path.is_file()}
    for target in targets:
        if target not in found:
            raise Trouble("the build failed", f"fpm names no program {target}\n")
    return [found[target] for target in targets]


def build():
    """Both programs in bin/, written only where they have changed."""
    write_revision()
    fpm_build("build", "app", PROGRAM_FLAGS)
    pathlib.Path("bin").mkdir(exist_ok=True)
    for name, made in zip(PROGRAMS, built("app", PROGRAM_FLAGS, *PROGRAMS), strict=True):
        target = f"bin/{name}"
        if not os.path.exists(target) or not filecmp.cmp(made, target, shallow=False):
            # One that is running at the moment can be replaced, not written over.
            shutil.copy2(made, f"{target}.new")
            os.replace(f"{target}.new", target)
    quietly("build-netcdf", [sys.executable, "tools/building/netcdf_plugin.py", "--flags",
                             RELEASE_FLAGS, "-o", "bin/faststrip_netcdf.so"], "the build failed")


# Testing

# How the line begins that counts all tests of a stage.
TOGETHER = "all modules together:"


class Counts:
    """What the stages of a test counted together."""

    def __init__(self, text):
        self.text = text  # only tests that hold it run
        self.passed = self.failed = self.skipped = 0

    def stage(self, name, title, work):
        """Run one stage of tests and add what it counted.

        One that ends badly without counting a failure is one failure itself; only with a filter
        a stage may have nothing to run.
        """
        heading(title)
        try:
            code, said = work(self.text)
        except Trouble as trouble:
            print(trouble.log or trouble, flush=True)
            code, said = 1, ""
        LOGS.mkdir(parents=True, exist_ok=True)
        (LOGS / f"{name}.log").write_text(said, encoding="utf-8")
        # The words are: N passed, N failed[, N skipped].
        lines = re.findall(rf"^{TOGETHER} *(.*)$", said, re.MULTILINE)
        passed, failed, skipped = ([int(n) for n in re.findall(r"\d+", lines[-1])] + [0, 0, 0]
                                   if lines else [0, 0, 0])[:3]
        if code != 0 and failed == 0 and (not lines or not self.text):
            print(f"the stage '{name}' did not end well: counted as one failure", flush=True)
            failed = 1
        self.passed += passed
        self.failed += failed
        self.skipped += skipped


def told(*words):
    """Run a command and pass on what it says line by line; its exit code and its words."""
    said = []
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          encoding="utf-8", errors="replace") as process:
        try:
            for line in process.stdout:
                said.append(line)
                print(line, end="", flush=True)
        except BaseException:
            process.kill()
            raise
    return process.returncode, "".join(said)


def fortran_tests(text, flags=TEST_FLAGS, twin="", left_out=()):
    pathlib.Path("build/tests").mkdir(parents=True, exist_ok=True)
    code, said = told(sys.executable, "tools/building/pf2f90.py")
    if code != 0:
        return code, said
    fpm_build("build-tests", "test", flags, twin)
    return shared(*built("test", flags, "run-tests"), text, ",".join(left_out))


def shared(runner, *words):
    """Run the Fortran tests in as many processes as there are cores, which share the modules; their
    exit code and what they said, with the counts of all in the last line."""
    counts, others = [], []
    with tempfile.TemporaryDirectory() as claims, \
            concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:

        def run(_):
            with subprocess.Popen([runner, *words, claims], stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, encoding="utf-8",
                                  errors="replace") as process:
                for line in process.stdout:
                    found = re.match(rf"{TOGETHER} *(.*)", line)
                    if found:
                        counts.append([int(n) for n in re.findall(r"\d+", found[1])])
                    else:
                        others.append(line)
                        print(line, end="", flush=True)
            return process.returncode

        codes = list(pool.map(run, os.sched_getaffinity(0)))
    passed, failed, skipped = (sum((each + [0])[i] for each in counts) for i in range(3))
    last = f"{TOGETHER:43} {passed} passed, {failed} failed"
    last += f", {skipped} skipped" if skipped else ""
    print(last, flush=True)
    # A process that crashed has no counts, and its exit code tells it.
    code = next((code for code in codes if code != 0), 0)
    if passed + failed == 0 and code == 0:
        print("no test ran")
        code = 1
    if len(counts) < len(codes):
        return code, "".join(others)
    return code, "".join([*others, last + "\n"])


def quick_fortran_tests(text):
    """Compiled as the programs are, of which they take all that is no test."""
    return fortran_tests(text, PROGRAM_FLAGS, "app", QUICK_WITHOUT)


def release_build(_):
    build()
    return 0, ""


def has_packages(text, name, what):
    """Install what test_NAME.py needs beside the others, if it is to run; without that it is
    skipped."""
    if not os.path.exists(f"test/embed/test_{name}.py") or text and name not in text:
        return False
    try:
        python_packages(name, what)
    except Trouble as trouble:
        print(f"test_{name}.py is skipped: {trouble}", flush=True)
        return False
    return True


def install_browser():
    """Chromium and what drives it, if they are not there; why they are not in one line, or
    nothing."""
    sys.path.append("tools/building")
    import debian  # which nothing else here needs

    for program, package in (("chromium", "chromium"), ("chromedriver", "chromium-driver")):
        if not shutil.which(program):
            heading(f"installing {package}")
            why = debian.install(package)
            if why:
                return why
    return ""


def python_tests(text):
    has_packages(text, "fmu", "FMPy")
    has_packages(text, "docs", "FORD and Sphinx")
    why = has_packages(text, "explore", "Bokeh and selenium") and install_browser()
    if why:
        print(f"the page is not tested in a browser: {why}", flush=True)
    if os.path.isdir("test/cli"):
        python_packages("test", "what the tests of the Python package and of NetCDF need")
        python_packages("vehicle", "scipy")
    # Towards the end what is short, so that all processes end together.
    return pytest(text, ["test/embed", "test/cli", "test/tools", "test/plots"])


def quick_python_tests(text):
    return pytest(text, QUICK)


def pytest(text, names):
    """Run Python tests in as many processes as there are cores, two at least, for most tests wait
    for one program; but not in more than there are files."""
    names = list(filter(os.path.exists, names))
    files = sum(1 if os.path.isfile(name) else len(list(pathlib.Path(name).glob("test_*.py")))
                for name in names)
    processes = min(files, max(2, len(os.sched_getaffinity(0))))
    return told(sys.executable, "-m", "pytest", "-c", "test/pytest.ini", "--durations=20",
                "-n", str(processes if processes > 1 else 0), f"--text={text}", *names)


def lint_checks(text):
    return told(sys.executable, "tools/check/lint.py", "--filter", text)


# The steps; each takes the words that follow its name.

def build_step():
    build()


def test(*words):
    text, *more = [word for word in words if word != "--quick"] or [""]
    if more:
        raise Trouble(f"test takes one TEXT, got {' '.join([text, *more])}", code=2)
    if text.startswith("-"):
        raise Trouble(f"test has the option --quick, not {text}", code=2)
    counts = Counts(text)
    counts.stage("lint", "form of the sources", lint_checks)
    if "--quick" in words:
        counts.stage("release", "release build", release_build)
        counts.stage("fortran", "Fortran tests, of the release", quick_fortran_tests)
        counts.stage("python", "tests of the interfaces", quick_python_tests)
    else:
        # Side by side: towards its end a build has one core idle that waits for a module.
        with concurrent.futures.ThreadPoolExecutor(1) as beside:
            programs = beside.submit(build)
            counts.stage("fortran", "Fortran tests, warnings as errors and traps on", fortran_tests)
            counts.stage("release", "release build", lambda _: (0, programs.result() or ""))
        counts.stage("python", "Python tests", python_tests)
    if counts.passed + counts.failed == 0:
        print("no test ran")
        counts.failed = 1
    skipped = f", {counts.skipped} skipped" if counts.skipped else ""
    print(f"\n{counts.passed} passed, {counts.failed} failed{skipped}", flush=True)
    sys.exit(counts.failed > 0)


def lint(text=""):
    do(sys.executable, "tools/check/lint.py", "--install", "--filter", text)


def bare(*text):
    do(sys.executable, "tools/check/bare.py", *(("--text", *text) if text else ()), "build/bare")


def mutants(*words):
    do(sys.executable, "tools/check/run_mutants.py", *words)


def hostile(*words):
    build()
    do(sys.executable, "tools/check/hostile.py", *words)


def fuzz(cases="100000"):
    """The cases are dealt to two processes; each prints the table of its half."""
    if not re.fullmatch("[0-9]+", cases):
        raise Trouble(f"not a number of cases: {cases}")
    count = int(cases)
    half = (count + 1) // 2
    pathlib.Path("out").mkdir(exist_ok=True)
    build()
    heading(f"cases 1 to {half}, and from {half + 1} to {count}")
    whole = pathlib.Path("out/fuzz.csv")
    parts = [pathlib.Path("out/fuzz_1.csv"), pathlib.Path("out/fuzz_2.csv")]
    for path in (whole, *parts):
        path.unlink(missing_ok=True)
    words = ["bin/faststrip-lab", "fuzz", "--cases"]
    halves = [subprocess.Popen([*words, str(half), "-o", parts[0]], stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)]
    if count > half:
        halves.append(subprocess.Popen([*words, str(count - half), "--first", str(half + 1), "-o",
                                        parts[1]], stdout=subprocess.DEVNULL))
    try:
        codes = [process.wait() for process in halves]
    finally:
        for process in halves:
            process.kill()
    lines = []
    for name, code, path in zip(("first", "second"), codes, parts, strict=False):
        # An exit code of 1 is a failed check, which the tables tell again.
        if code not in (0, 1) or not path.exists():
            raise Trouble(f"the {name} half broke off")
        rows = path.read_text(encoding="utf-8").splitlines(keepends=True)
        lines += [row for row in rows if not row.startswith("#")][1:] if lines else rows
        path.unlink()
    whole.write_text("".join(lines), encoding="utf-8")
    if subprocess.run(["bin/faststrip-lab", "fuzz", "--read", whole], check=False).returncode != 0:
        raise Trouble("some cases failed a check")
    print("no case failed a check; one row per case in out/fuzz.csv")


def corrections():
    """Fit the forces; judged on families that were left out and on every tenth contact."""
    build()
    python_packages("fit", "jax and optax")
    contacts = []
    for family, seed, count in FORCE_DATA:
        out = pathlib.Path("out", "force_data", family or "all")
        do(sys.executable, "tools/generate/force_data.py", count, "--folder", out, "--seed", seed,
           *(("--family", family) if family else ()))
        contacts += sorted(out.glob("*.csv"))
    features = []
    for k, (strips, points) in enumerate(FORCE_ELEMENTS):
        features.append(pathlib.Path("out", "force_data", f"features_{strips}_{points}.csv"))
        # One file in four but for the elements that users have.
        some = contacts[k % 4::4] if k else contacts
        do("bin/faststrip-lab", "force-features", *some, "--strips", strips, "--points", points,
           "-o", features[-1])
    heading("fitting, first without some families")
    do(sys.executable, "tools/generate/fit_forces.py", *features,
       *(word for families in LEFT_OUT for word in ("--leave-out", families)))
    do(sys.executable, "tools/generate/force_weights.py")
    heading("done: src/faststrip/tangential/force/weights.f90")


def demo():
    build()
    pathlib.Path("out").mkdir(exist_ok=True)
    pipeline(DEMO)
    for shift in (-5, 0):
        pipeline(DEMO_SHIFT, shift=shift)
    pipeline(DEMO_END)
    rows = pathlib.Path("out/accuracy.md").read_text(encoding="utf-8").splitlines()
    print("\n".join([row for row in rows if row.startswith((
        "| method", "| strips + FASTSTRIP", "| NORM + TANG"))][:3]))


def tables():
    build()
    pipeline(TABLES, out=folder("tables"))


def strips():
    build()
    pipeline(STRIPS, out=folder("strips"))


def extremes():
    build()
    out = folder("extremes")
    pipeline(EXTREMES, out=out)
    fpm_build("build-scalar", "app", SCALAR_FLAGS)
    pipeline(EXTREMES_END, out=out, scalar=built("app", SCALAR_FLAGS, "faststrip-lab")[0])


def forces():
    build()
    out = folder("forces")
    pipeline(FORCES, out=out)
    for shift in (-5, 0):
        pipeline(FORCES_SHIFT, shift=shift, out=out)
    pipeline(FORCES_END, out=out)


def scenes():
    stored("scenes")


def stored(*names):
    """What the program itself has made and the repository holds; it carries the revision."""
    build()
    if subprocess.run([sys.executable, "tools/measure/stored.py", *names],
                      check=False).returncode != 0:
        raise Trouble("the stored results are not all new")
    heading("done: look at the changes and commit them")


def report(*words):
    if not {"-h", "--help"} & set(words):
        build()
    do(sys.executable, "tools/measure/report_runs.py", *words)


def speed(*words):
    measured("tools/measure/speed.py", *words)


def scale(*words):
    measured("tools/measure/scale.py", *words)


def page(*words):
    if not {"-h", "--help"} & set(words):
        python_packages("explore", "Bokeh and selenium")
        why = install_browser()
        if why:
            raise Trouble(f"no browser to measure in: {why}")
        install_below(ROOT / "build" / "embed")
    do(sys.executable, "tools/measure/bench_page.py", "--prefix", "build/embed", *from_start(words))


def explore(*words):
    """The interactive explorer of this checkout, where ./run was called."""
    python_packages("explore", "Bokeh")
    # For help, too: the package needs its library.
    install_below(ROOT / "build" / "embed")
    os.environ.update(FASTSTRIP_PREFIX=str(ROOT / "build" / "embed"),
                      PYTHONPATH=str(ROOT / "python"))
    os.chdir(START)
    os.execv(sys.executable, [sys.executable, "-m", "faststrip.explore", *words])


def from_start(words):
    """Words with the file of the output as seen from where ./run was called."""
    return [os.path.join(START, word) if before in ("-o", "--output") else word
            for before, word in zip(("", *words), words)]


def measured(tool, *words):
    if not {"-h", "--help"} & set(words):
        build()
    do(sys.executable, tool, *from_start(words))


def lists():
    do(sys.executable, "tools/generate/methods.py")
    build()
    for tool in "settings", "columns":
        do(sys.executable, f"tools/generate/{tool}.py", "bin/faststrip")
    do(sys.executable, "tools/generate/f77_arguments.py")
    do(sys.executable, "tools/check/constants.py")
    do(sys.executable, "tools/generate/parity.py")


def net(*words):
    if not {"-h", "--help"} & set(words):
        install_below(ROOT / "build" / "embed")
    do(sys.executable, "tools/check/net.py", "--installed", "build/embed", *words)


def lookup(*words):
    if not {"-h", "--help"} & set(words):
        install_below(ROOT / "build" / "embed")
    do(sys.executable, "tools/measure/lookup.py", "--installed", "build/embed", *words)
    if not {"-h", "--help"} & set(words):
        do(sys.executable, "plots/lookup.py")


def vehicle(*words):
    python_packages("vehicle", "scipy")
    install_below(ROOT / "build" / "embed")
    os.environ.update(FASTSTRIP_PREFIX=str(ROOT / "build" / "embed"),
                      PYTHONPATH=str(ROOT / "python"))
    do(sys.executable, "example/vehicle/vehicle.py", *words)
    heading("done: pictures and figures are in out/vehicle/")


def install_below(prefix):
    build()
    with open("build/stage.lock", "w", encoding="utf-8") as lock:
        # One installation at a time from a folder.
        fcntl.flock(lock, fcntl.LOCK_EX)
        shutil.rmtree("build/stage", ignore_errors=True)
        fpm("stage", "src/files", "install", PROGRAM_FLAGS, "--c-flag", "-fPIC", "--prefix",
            str(ROOT / "build/stage"), trouble="fpm install failed", twin="app")
        if subprocess.run([sys.executable, "tools/building/install.py", "--stage", "build/stage",
                           "--program", "bin/faststrip", "--prefix", prefix],
                          check=False).returncode != 0:
            raise Trouble("the installation failed")


def install(*words):
    if len(words) != 2 or words[0] != "--prefix" or not words[1]:
        raise Trouble("install takes --prefix FOLDER")
    prefix = os.path.join(START, words[1])
    install_below(prefix)
    heading(f"installed below {prefix}")
    print("Python: pip install ./python, which takes this library")


def python_packages(name, what):
    """Install what only some steps need."""
    wanted, kept = f"tools/requirements-{name}.txt", f".venv/requirements-{name}.txt"
    if not os.path.exists(kept) or not filecmp.cmp(wanted, kept, shallow=False):
        heading(f"installing {what}")
        quietly(f"pip-{name}", [sys.executable, "-m", "pip", "install", "--quiet", "-r", wanted],
                f"cannot install {what}: .venv/bin/python -m pip install -r {wanted}")
        shutil.copy(wanted, kept)


def docs():
    python_packages("docs", "FORD")
    build()
    do(sys.executable, "tools/docs/document.py")
    heading("done: out/docs/index.html")


def fmu(*files):
    python_packages("fmu", "FMPy")
    install_below(ROOT / "build" / "embed")
    do(sys.executable, "tools/building/fmu.py", "--prefix", "build/embed", "--folder",
       folder("fmu"), *(os.path.join(START, file) for file in files))
    heading("done: the units are in out/fmu/")


def package():
    python_packages("test", "what builds the Python package")
    do(sys.executable, "tools/building/package.py", "--folder", folder("package"))
    heading("done: pip install out/package/*.whl")


def release(*words):
    if words not in ((), ("--check",)):
        raise Trouble(f"release takes nothing or --check, not {' '.join(words)}", code=2)
    do(sys.executable, "tools/building/release.py", "--check")
    if not words:
        docs()
        package()
        do(sys.executable, "tools/building/release.py")
        heading("done: out/release/")


def embed():
    out = folder("embed")
    install_below(ROOT / "build" / "embed")
    do(sys.executable, "tools/measure/bench_embed.py", "--prefix", "build/embed", "-o",
       f"{out}/bench_embed.csv")
    do("bin/faststrip-lab", "bench", "host", "-o", f"{out}/bench_host.csv")
    heading(f"done: the tables are {out}/bench_embed.csv and {out}/bench_host.csv")


def compilers():
    write_revision()
    do(sys.executable, "tools/building/compilers.py")


def clean(what=""):
    if what not in ("", "all"):
        raise Trouble(f"clean takes nothing or 'all', not '{what}'")
    rubbish = [*map(pathlib.Path, ("build", "bin", "out"))]
    for place, folders, files in os.walk("."):
        folders[:] = [name for name in folders if name not in (".git", ".venv")]
        if "fpm.toml" in files:
            rubbish.append(pathlib.Path(place, "build"))
        if pathlib.Path(place).name == "__pycache__":
            rubbish.append(pathlib.Path(place))
    if what == "all":
        rubbish.append(pathlib.Path(".venv"))
    pathlib.Path("app/command/revision.f90").unlink(missing_ok=True)
    for path in rubbish:
        if path.exists():
            shutil.rmtree(path)


# Modules of the rooms that take some seconds each, which `test --quick` leaves out.
QUICK_WITHOUT = ("normal/test_cells_invariance", "tangential/test_sub_patch_forces")
# What it runs of the interfaces: command line, Fortran, F77, C and Python.
QUICK = tuple(f"test/{name}.py" for name in (
    "cli/test_auto", "cli/test_bad_input", "cli/test_batch", "cli/test_columns",
    "cli/test_contact", "cli/test_files", "cli/test_friction", "cli/test_integral",
    "cli/test_profile", "cli/test_wear", "cli/test_wheelset", "cli/test_words",
    "embed/test_callers", "embed/test_install", "embed/test_python", "embed/test_values"))
# Families that the force correction is fitted without, to judge it.
LEFT_OUT = ("zones", "tanh+exp+wedge", "worn+hollow+waisted+double", "mixed+wheel",
            "unequal+flat+power+quartic")
# Family (nothing: all but the last two in turn), seed and number of contacts that they are fitted
# to; strips across and points along, the first as users have them.
FORCE_DATA = (("", 1, 14400), ("mixed", 2, 10000), ("ellipse", 3, 14000), ("zones", 4, 9000))
FORCE_ELEMENTS = ((15, 15), (5, 15), (9, 15), (9, 9), (15, 30), (23, 23), (31, 31), (31, 15),
                  (15, 7))
STEPS = {step.__name__.removesuffix("_step").replace("_", "-"): step for step in (
    build_step, test, lint, bare, mutants, hostile, fuzz, corrections, demo, strips, speed, scale,
    lists, net, lookup, vehicle, explore, page, extremes, forces, scenes, stored, report, install,
    fmu, package, release, docs, embed, tables, compilers, clean)}
# Commands that take words, and how many at most.
WORDS = {"lint": 1, "bare": 1, "fuzz": 1, "clean": 1, **dict.fromkeys((
    "test", "install", "mutants", "hostile", "stored", "report", "speed", "scale", "net", "lookup",
    "vehicle", "page", "release", "fmu")), "explore": None}


def main(command="", *words):
    if command not in STEPS:
        print(__doc__, end="", file=sys.stderr)
        return 2
    if command in ("build", "test", "demo", "vehicle") and {"-h", "--help"} & set(words):
        print(__doc__, end="")
        return 0
    most = WORDS.get(command, 0)
    try:
        if most is not None and len(words) > most:
            raise Trouble(f"{command} takes at most {most} words, got {' '.join(words)}"
                          if most else f"{command} takes nothing, got {' '.join(words)}", code=2)
        STEPS[command](*words)
    except Trouble as trouble:
        print(f"{trouble.log}run: {trouble}", file=sys.stderr)
        return trouble.code
    except OSError as error:
        print(f"run: {error.strerror}: {error.filename}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 128 + signal.SIGINT
    return 0


if __name__ == "__main__":
    START = sys.argv[1]
    os.chdir(ROOT)
    # Ended by a signal, a step ends the command that it runs.
    signal.signal(signal.SIGTERM, lambda number, _: sys.exit(128 + number))
    sys.exit(main(*sys.argv[2:]))
