"""One installation for all tests of this folder, and what compiles and runs hosts against it."""

import importlib
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import unittest

import blocks
import page_in_browser  # noqa: F401
from shared_runs import made_once

ROOT = pathlib.Path(__file__).resolve().parents[2]

HOSTS = ROOT / "example" / "hosts"
# Pages with callers, and their headings.
CALLERS = (("README.md", "Embedding"), ("docs/embedding.md", "Callers in C and Fortran 77"))


def bits(*numbers):
    """Sixteen hexadecimal digits a number, as the hosts print them."""
    return " ".join(struct.pack(">d", number).hex().upper() for number in numbers)


def number(text):
    """The number that is printed so."""
    return struct.unpack(">d", bytes.fromhex(text))[0]


def callers():
    """Language and text of the callers that pages show, and of the lines that compile and run them:
    those of the README, then those of docs/embedding.md."""
    found = []
    for page, heading in CALLERS:
        section = (ROOT / page).read_text(encoding="utf-8").split(f"\n## {heading}\n")[1]
        # Installed it is, and where is known.
        found += [(block.language, re.sub(r"(?m)^(\./run install|export) .*\n", "", block.text))
                  for block in blocks.blocks_of(section.split("\n## ")[0])
                  if block.language != "output"]
    return found


def install(folder):
    done = subprocess.run([ROOT / "run", "install", "--prefix", folder / "prefix"], cwd=folder,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, encoding="utf-8", timeout=6000, check=False)
    if done.returncode != 0:
        raise RuntimeError(done.stdout)


class Installation:
    """./run install, once for all processes of a run of the tests.

    FASTSTRIP_INSTALLED names a prefix that is ready instead: the one of a mutant.
    """

    made = None

    def __init__(self):
        ready = os.environ.get("FASTSTRIP_INSTALLED")
        self.prefix = pathlib.Path(ready or made_once("installation", install) / "prefix")
        self.library = self.prefix / "lib" / "libfaststrip.so"
        self.archive = self.prefix / "lib" / "libfaststrip.a"
        self.header = self.prefix / "include" / "faststrip.h"

    @property
    def environment(self):
        """What a host needs to know, and nothing of the checkout."""
        return {
            **{name: os.environ[name] for name in ("PATH", "HOME", "TMPDIR") if name in os.environ},
            "PKG_CONFIG_PATH": str(self.prefix / "lib" / "pkgconfig"),
            "LD_LIBRARY_PATH": str(self.prefix / "lib"),
            "FASTSTRIP_PREFIX": str(self.prefix),
            "OPENBLAS_NUM_THREADS": "1",
            "PYTHONDONTWRITEBYTECODE": "1",
        }


def installation():
    if Installation.made is None:
        Installation.made = Installation()
    return Installation.made


class HostTest(unittest.TestCase):
    """Tests in a folder of their own, away from the checkout."""

    @classmethod
    def setUpClass(cls):
        cls.installed = installation()
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)

    @classmethod
    def import_package(cls):
        """The checkout's Python package on the installed library, in this process."""
        os.environ["FASTSTRIP_PREFIX"] = str(cls.installed.prefix)
        sys.path.insert(0, str(ROOT / "python"))
        try:
            return importlib.import_module("faststrip")
        finally:
            sys.path.remove(str(ROOT / "python"))
            del os.environ["FASTSTRIP_PREFIX"]

    @classmethod
    def write(cls, name, text):
        (cls.folder / name).write_text(text, encoding="utf-8")

    @classmethod
    def shell(cls, line, **environment):
        """Run a line of shell that has to succeed; what it printed."""
        done = subprocess.run(["sh", "-euc", line], cwd=cls.folder, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8",
                              env={**cls.installed.environment, **environment}, timeout=6000,
                              check=False)
        if done.returncode != 0:
            raise AssertionError(f"{line}: {done.returncode}\n{done.stdout}")
        return done.stdout

    @classmethod
    def compile_host(cls, source, program, flags=""):
        cls.shell(f"gcc -O1 -g -Wall -Wextra -Werror {flags} '{HOSTS / source}' -o {program}"
                  " $(pkg-config --cflags --libs faststrip) -lm -pthread")

    @classmethod
    def findings(cls, line, **environment):
        """Lines `name number` that a program printed, as a dictionary of lists."""
        found = {}
        for row in cls.shell(line, **environment).splitlines():
            name, value = row.split()
            found.setdefault(name, []).append(int(value))
        return found

    def check_calls(self, declared, rows, functions=""):
        """Statements of fixed-form Fortran, row by row: a name, the number wanted, the statements,
        and the number where that is not INFO."""
        lines = ["      PROGRAM CALLS", declared.rstrip("\n")]
        for name, _, statements, *expression in rows:
            lines += [f"      {one}" for one in statements.split("; ") if one]
            lines.append(f"      WRITE (*, *) '{name}', {expression[0] if expression else 'INFO'}")
        self.write("calls.f", "\n".join([*lines, "      END", functions]))
        self.shell("gfortran -std=legacy -ffixed-line-length-none -g"
                   " -ffpe-trap=invalid,zero,overflow calls.f $(pkg-config --libs faststrip)"
                   " -o calls")
        self.assertEqual(self.findings("./calls"), {row[0]: [row[1]] for row in rows})

    def refused(self, word, call, *values, says="", **options):
        """A call of the Python package that fails, with its word and some of its message."""
        with self.assertRaises(sys.modules["faststrip"].FaststripError, msg=says) as caught:
            call(*values, **options)
        self.assertEqual(caught.exception.word, word, says)
        self.assertGreaterEqual(caught.exception.status, 100, says)
        self.assertIn(says, str(caught.exception))

    def all_refused(self, *rows):
        """Rows of words and a call of the Python package, which fails with these words."""
        for i, (says, call) in enumerate(rows):
            with self.subTest(says, row=i):
                with self.assertRaises(sys.modules["faststrip"].FaststripError) as caught:
                    call()
                self.assertIn(says, str(caught.exception))
