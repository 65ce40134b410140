#!/usr/bin/env python3
"""Write the man page of the program from what its --help says.

    man_page.py PROGRAM VERSION >faststrip.1
"""

import pathlib
import re
import subprocess
import sys

HEAD = """\
.TH FASTSTRIP 1 "" "faststrip {version}" "User Commands"
.SH NAME
faststrip \\- wheel/rail contact by the modified strip method
"""
TAIL = """\
.SH EXIT STATUS
0 all went well; 1 bad input; 2 wrong usage; 3 no convergence; 128 + n ended by signal n: then no
output was written and an older one is as it was.
.SH SEE ALSO
The library is described in its header
.I faststrip.h
and in the pages of its Fortran interface. Units are mm, N, MPa, rad.
"""


def help_of(program, *words):
    done = subprocess.run([program, *words, "--help"], stdout=subprocess.PIPE, encoding="utf-8",
                          check=True)
    return done.stdout


def as_it_stands(text):
    """Lines for nroff that come out as they are."""
    lines = (line.replace("\\", "\\e").replace("-", "\\-") for line in text.splitlines())
    return ".nf\n" + "".join(f"\\&{line}\n" for line in lines) + ".fi\n"


def subcommands(text):
    return re.findall(r"^  ([a-z]+) ", text, re.MULTILINE)


def man_page(program, version):
    general = help_of(program)
    parts = [HEAD.format(version=version), ".SH SYNOPSIS\n", as_it_stands(general)]
    parts.append(".SH SUBCOMMANDS\n")
    for name in subcommands(general):
        parts += [f".SS {name}\n", as_it_stands(help_of(program, name))]
    return "".join([*parts, TAIL])


if __name__ == "__main__":
    sys.stdout.write(man_page(pathlib.Path(sys.argv[1]).absolute(), sys.argv[2]))
