#!/usr/bin/env python3
"""Try both programs with hostile inputs, made from a seed: files, options, paths, signals.

    hostile.py [N] [--seed S] [--family NAME] [--seconds T]

Each has to end in time with an exit code that fits (1 bad input, 2 usage, 3 no convergence, 128 + n
signal n), with one line on stderr that begins with the name of the program and holds no control
character, and must leave every file as it was. Batches say one line more for each row that fails.
What chance changed in a good file may turn out to be good still: then the exit code is 0. Prints a
table of what went wrong and a summary; exit code 1 if anything did.
"""

import argparse
import collections
import dataclasses
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import socket
import stat
import subprocess
import sys
import tempfile
import threading
import time

import other_user
from side_files import tries

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "bin" / "faststrip"
LAB = ROOT / "bin" / "faststrip-lab"
# What the second program does.
OF_THE_LAB = ("bench", "fuzz", "scenes", "errata")

# How far long work is; not counted as the one line.
PROGRESS = re.compile(r"faststrip(-lab)?: .*, \d+ s")
NEVER = ("Fortran runtime error", "Backtrace", "Error termination", "At line", "Segmentation",
         "Traceback", "core dumped", "terminate called")

COLUMNS = "case,gap_file,E_MPa,nu,mu,N_N,cksi,ceta,cphi_rad_per_mm"
ROW = "a,gap.csv,210000,0.28,0.3,1e5,0.001,0,0"


def gap_lines(n=61, height=lambda y: y * y / 600.0):
    return ["y_mm,h_mm,inv2R_per_mm"] + [
        f"{y!r},{height(y)!r},{1.0 / 920.0!r}" for y in (0.5 * (i - n // 2) for i in range(n))]


def text_of(lines):
    return "\n".join(lines) + "\n"


CASE = ["&contact", "  name = 'gap'", "  gap_file = 'gap.csv'", "  load_N = 1e5", "/",
        "&material", "  mu = 0.3", "/", "&motion", "  cksi = 0.001", "/"]
PROFILES = ["&contact", "  load_N = 1e5", "  shift_mm = 0", "/", "&wheel", "  profile = 'w.txt'",
            "/", "&rail", "  profile = 'uic60'", "/", "&material", "  mu = 0.3", "/", "&motion",
            "/"]
WHEELSET = ["&wheel", "  profile = 'w.txt'", "  profile_left = 's1002'",
            "  radius_left_mm = 459.5", "/", "&rail", "  profile = 'uic60'",
            "  profile_left = '60e1'", "  rail_distance_mm = 1500", "/"]
AXLE = ["&wheel", "  profile = 's1002'", "/", "&rail", "  profile = '60e1'", "  cant = 0.025", "/",
        "&material", "  mu = 0.3", "/"]
RADII = ["y_mm,delta_r_mm"] + [f"{y / 2},{(y / 8) ** 3 / 10 + y / 20}" for y in range(-20, 21)]
POINTS = [f"{y} {abs(y) ** 1.5 / 100.0}" for y in range(-30, 31)]
GOOD = {"gap.csv": text_of(gap_lines()), "case.nml": text_of(CASE), "prof.nml": text_of(PROFILES),
        "w.txt": text_of(POINTS), "set.nml": text_of(WHEELSET), "radii.csv": text_of(RADII),
        "ok.csv": text_of([COLUMNS, ROW]), "kept.csv": "kept\n"}


@dataclasses.dataclass
class Try:
    """One hostile input."""

    family: str
    words: list
    codes: tuple = (1,)
    files: dict = dataclasses.field(default_factory=dict)  # beside or instead of the good ones
    prepare: object = None      # called with the folder
    setup: object = None        # called in the child
    during: object = None       # called with the process and the folder
    rows: bool = False          # a batch: its rows may fail each with a line of its own
    may_pass: bool = False      # changed by chance
    says: str = ""              # what stderr must hold, with a result or without
    silent: bool = False        # nobody can read stderr
    makes: tuple = ()           # may be there afterwards, and what was there if all goes well
    rights: bool = True         # False: run as a user whom permissions bind
    environment: dict = dataclasses.field(default_factory=dict)

    def in_the_child(self):
        """Signals that a parent ignores are not ignored by the program."""
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT):
            signal.signal(number, signal.SIG_DFL)
        if self.setup:
            self.setup()

    @property
    def program(self):
        program = LAB if self.words and self.words[0] in OF_THE_LAB else PROGRAM
        return program if self.rights else other_user.runnable(program)

    @property
    def user(self):
        return None if self.rights else other_user.without_rights()

    def __str__(self):
        settings = [f"{name}={value}" for name, value in self.environment.items()]
        return " ".join(repr(word)[1:-1] if word.isprintable() else repr(word)
                        for word in (*settings, *map(str, self.words)))


# The families: each makes one input from a random number generator and a counter.

BAD_NUMBERS = ["1e5x", "abc", "'1e5'", "1,5", "NaN", "Infinity", "-Inf", "1e400", "", "..", "1e",
               "0x10", "--1", "1e5 2e5", "2*3", ".true.", "1_8", "\x1b[31m", "é", "1e5;", "=",
               "\"", "1 000"]
BAD_TEXTS = ["guess", "NORM ", "", "strip,hertz", "\x1b]0;x\x07", "ü" * 20, "x" * 600, "'"]


def case_values(rng, _):
    if rng.random() < 0.35:
        group, name, value = rng.choice([
            ("contact", "load_direction", "up"), ("contact", "penetration_mm", "1"),
            ("motion", "sign_set", "C"), ("motion", "creepage", "guess"),
            ("numerics", "normal", "guess"), ("numerics", "tangential", "guess"),
            ("numerics", "target", "wear"), ("numerics", "norm_start", "hot"),
            ("contact", "gap_file", "none.csv"), ("contact", "gap_file", "."),
            ("contact", "colour", "red")])
        value = value if rng.random() < 0.5 else rng.choice(BAD_TEXTS)
        value = f"'{value}'" if rng.random() < 0.8 else value
        may = True
    else:
        group, name = rng.choice([
            ("contact", "load_N"), ("contact", "shift_mm"), ("material", "mu"),
            ("material", "nu_wheel"), ("material", "nu_rail"), ("material", "E_wheel_MPa"),
            ("material", "E_rail_MPa"), ("motion", "cksi"), ("motion", "cphi_rad_per_mm"),
            ("numerics", "strips_per_patch"), ("numerics", "points_per_strip"),
            ("numerics", "fastsim_nx"), ("numerics", "gap_step_mm"), ("numerics", "tolerance"),
            ("numerics", "element_dx_mm"), ("numerics", "max_elements"),
            ("numerics", "smoothing_um"), ("numerics", "error_target")])
        value = rng.choice(BAD_NUMBERS + ["-1", "-1e300"])
        may = value in ("", "-1", "-1e300")
    lines = [line for line in CASE if not line.strip().startswith(name + " ")]
    if group == "numerics":
        lines += [f"&numerics {name} = {value}", "/"]
    else:
        lines.insert(lines.index(f"&{group}") + 1, f"  {name} = {value}")
    return Try("case values", ["contact", "case.nml"], files={"case.nml": text_of(lines)},
               may_pass=may)


# Group, name, right number, factor of the mistake, its name; in a case with profiles or a gap file.
UNITS = [
    ("material", "mu", 0.3, 100.0, "percent"), ("material", "E_wheel_MPa", 2.1e5, 1e-3, "GPa"),
    ("material", "E_rail_MPa", 2.1e5, 1e6, "Pa"), ("material", "E_rail_MPa", 7e4, 1e-3, "GPa"),
    ("contact", "load_N", 8e4, 1e-3, "kN"), ("contact", "load_N", 1e5, 1e-4, "tonnes"),
    ("motion", "cksi", 5e-3, 100.0, "percent"), ("motion", "ceta", -8e-3, 100.0, "percent"),
    ("motion", "cphi_rad_per_mm", 2e-4, 1e3, "1/m"),
    ("wheel", "radius_mm", 460.0, 1e-3, "metres"), ("wheel", "radius_mm", 425.0, 2.0, "diameter"),
    ("rail", "cant", 0.025, 57.3, "degrees"), ("rail", "gauge_mm", 1435.0, 1e-3, "metres"),
    ("wheel", "back_spacing_mm", 1360.0, 1e-3, "metres"),
    ("contact", "shift_mm", 2.0, 1e3, "micrometres"),
]


def units(rng, _):
    """A number in another unit, somewhat larger or smaller: the likely mistake is named."""
    group, name, right, factor, says = rng.choice(UNITS)
    case = PROFILES if group in ("wheel", "rail") or name == "shift_mm" else rng.choice(
        [CASE, PROFILES])
    lines = [line for line in case if not line.strip().startswith(name + " ")]
    at = next(i for i, line in enumerate(lines) if line.split()[0] == f"&{group}") + 1
    lines.insert(at, f"  {name} = {right * factor * rng.uniform(0.85, 1.15):.6g}")
    return Try("units", ["contact", "case.nml"], codes=(1, 3),
               files={"case.nml": text_of(lines)}, may_pass=True, says=says)


def mutated(rng, text):
    data = bytearray(text.encode())
    for _ in range(rng.choice([1, 1, 1, 2, 4, 8])):
        at = rng.randrange(len(data))
        kind = rng.randrange(7)
        if kind == 0:
            del data[at:at + rng.choice([1, 3, 20])]
        elif kind == 1:
            data[at:at] = bytes([rng.randrange(256)])
        elif kind == 2:
            data[at] = rng.randrange(256)
        elif kind == 3:
            data[at:at] = rng.choice([b"'", b"/", b"&", b"=", b"\0", b"\n", b",", b"\"", b"!",
                                      b"\r", b"(", b"*", b"\x1b[2J", b"\xff\xfe", b"%", b";"])
        elif kind == 4:
            data = data[:at + 1]
        elif kind == 5:
            end = min(len(data), at + rng.choice([5, 30]))
            data[at:at] = data[at:end]
        else:
            lines = data.split(b"\n")
            rng.shuffle(lines)
            data = bytearray(b"\n".join(lines))
        if not data:
            data = bytearray(b"\n")
    return bytes(data)


def namelists(rng, _):
    name = rng.choice(["case.nml", "prof.nml"])
    return Try("namelists", ["contact", name], codes=(1, 3), files={name: mutated(rng, GOOD[name])},
               may_pass=True)


def gap_files(rng, i):
    lines = gap_lines()
    kind = i % 12
    at = rng.randrange(1, len(lines))
    cells = lines[at].split(",")
    bad = rng.choice(["NaN", "inf", "1e400", "", "1 2", "x", "\x1b[0m", "1;2", "\u202e1", "'1'"])
    if kind == 0:
        cells[rng.randrange(3)] = bad
        lines[at] = ",".join(cells)
    elif kind == 1:
        lines[at] = ",".join(cells[:rng.randrange(1, 3)])
    elif kind == 2:
        lines[at] = ",".join(cells + ["1"] * rng.choice([1, 5]))
    elif kind == 3:
        lines.insert(at, f"{cells[0]},1e3,{cells[2]}")
    elif kind == 4:
        lines[1:] = reversed(lines[1:])
    elif kind == 5:
        lines = lines[:rng.choice([0, 1, 2, 4])]
    elif kind == 6:
        lines[0] = rng.choice(["y,h,r", "y_mm,h_mm", "y_mm,y_mm,h_mm", "", "\"y_mm,h_mm",
                               "y_mm;h_mm"])
    elif kind == 7:
        lines[at] = f"\"{lines[at]}"
    elif kind == 8:
        return Try("gap files", ["contact", "case.nml"],
                   files={"gap.csv": rng.randbytes(rng.choice([1, 50, 5000]))})
    elif kind == 9:
        lines = [lines[0]] + [f"{i},{rng.choice(['1e300', '-1e300', '1e-300'])},1e-3"
                              for i in range(20)]
        return Try("gap files", ["contact", "case.nml"], codes=(1, 3),
                   files={"gap.csv": text_of(lines)}, may_pass=True)
    elif kind == 10:
        lines = [lines[0]] + [f"{i},{i * i / 600 + 100},{rng.choice(['-1e-3', '-1', '-1e9'])}"
                              for i in range(-20, 21)]
        return Try("gap files", ["contact", "case.nml"], codes=(1, 3),
                   files={"gap.csv": text_of(lines)}, may_pass=True)
    else:
        return Try("gap files", ["contact", "case.nml"], codes=(1, 3),
                   files={"gap.csv": mutated(rng, GOOD["gap.csv"])}, may_pass=True)
    return Try("gap files", ["contact", "case.nml"], files={"gap.csv": text_of(lines)})


def profile_files(rng, i):
    lines = POINTS[:]
    at = rng.randrange(1, len(lines))
    words = ["contact", "prof.nml"]
    if i % 3 == 0:
        name, case = "w.prw", GOOD["prof.nml"].replace("w.txt", "w.prw")
        text = rng.choice([
            "", "header.begin\ntype = 1\nheader.end\n", "point.begin\n1 2\n",
            "type = 0\npoint.begin\n" + text_of(POINTS) + "point.end\n",
            "type = 1\nrotate = 3\npoint.begin\n" + text_of(POINTS) + "point.end\n",
            "type = x\npoint.begin\npoint.end\n", "no key\n", "point.begin\npoint.end\n",
            "type = 1\npoint.begin\n1\npoint.end\n", "units.len.f = 0\n", "\x1b[1m = 2\n\x1b\n"])
        return Try("profile files", words, files={name: text, "prof.nml": case}, codes=(1, 3),
                   may_pass="rotate" in text or "type = 0" not in text and "point.end" in text)
    if i % 3 == 1:
        lines[at] = rng.choice(["NaN 1", "1 Inf", "1", "1 2 3", "one two", "-40 1", "1 1e12",
                                "1,,2", "\x1b[1m 2", lines[at - 1], "1 2x", "\x00 1"])
        return Try("profile files", words, files={"w.txt": text_of(lines)},
                   may_pass=lines[at] == lines[at - 1])
    text = rng.choice([b"", text_of(lines[:3]).encode(), rng.randbytes(300), b"\0" * 3000,
                       mutated(rng, GOOD["w.txt"])])
    return Try("profile files", words, codes=(1, 3), files={"w.txt": text}, may_pass=True)


def conicities(rng, i):
    lines = RADII[:]
    at = rng.randrange(1, len(lines))
    y, radius = lines[at].split(",")
    if i % 4 == 0:
        return Try("conicities", ["conicity", "set.nml", "--y-max", "4", "--y-step", "1"],
                   files={"set.nml": mutated(rng, GOOD["set.nml"])}, may_pass=True)
    if i % 4 == 1:
        lines[at] = rng.choice([f"NaN,{radius}", f"{y},Inf", y, f"{y},{radius},1", "99,1", "-99,1",
                                f"{y},\x1b[1m", f"{y},1e400", f"{y} 1,{radius}", ","])
        lines.append("98,1e300")
        return Try("conicities", ["conicity", "--delta-r", "radii.csv"],
                   files={"radii.csv": text_of(lines)})
    if i % 4 == 2:
        return Try("conicities", ["conicity", "--delta-r", "radii.csv"],
                   files={"radii.csv": mutated(rng, GOOD["radii.csv"])}, may_pass=True)
    scale = rng.choice(["1e300", "1e-300", "-1", "0", "1e-320", "1e154"])
    lines[1:] = [f"{y},{float(scale) * float(radius)}"
                 for y, radius in (line.split(",") for line in lines[1:])]
    return Try("conicities", ["conicity", "--delta-r", "radii.csv"],
               files={"radii.csv": text_of(lines)}, may_pass=True)


def pairs(rng, i):
    """A number of one thing without the other, or of two that do not fit."""
    rail, wheel = "  profile = 'uic60'", "  profile = 's1002'"
    kind = i % 5
    if kind == 0:
        rail = rng.choice(["  profile = 'w.txt'", "  profile = 'w.txt', gauge_depth_mm = 1"])
    elif kind == 1:
        rail += f", cant = 0.025, inclination = {rng.choice(['0.025', '0', '1e400', 'NaN'])}"
    elif kind == 2:
        rail += f", {rng.choice(['cant', 'inclination'])} = {rng.choice([999, 25, -0.2, 1e300])}"
    elif kind == 3:
        rail += f", gauge_mm = {rng.choice([300, 914, 1000, 1067, 1480, 1600, 1668, 1e300])}"
    else:
        back = rng.choice([rng.uniform(1371, 1500), rng.uniform(100, 1290), 1e300])
        wheel += f", back_spacing_mm = {back!r}"
    lines = [{"  profile = 'uic60'": rail, "  profile = 'w.txt'": wheel}.get(line, line)
             for line in PROFILES]
    return Try("pairs", rng.choice([["contact", "prof.nml"], ["conicity", "prof.nml"]]),
               files={"prof.nml": text_of(lines)})


def wheelset_states(rng, i):
    """Wheelsets that stand, slide, stop and roll back, at every pace; and cells that are none."""
    names = ["y_mm", "roll_rad", "yaw_rad", "speed_mm_s", "pitch_rate_rad_s", "Fz_N", "vy_mm_s",
             "yaw_rate_rad_s", "rail_right_y_mm", "rail_left_roll_rad", "rail_right_vy_mm_s"]
    cells = dict.fromkeys(names, "0") | {"roll_rad": "", "Fz_N": "160000"}

    def pace():
        return rng.choice(["0", "-0", repr(rng.choice([-1, 1]) * 10.0 ** rng.uniform(-323, 9))])

    for name in ("speed_mm_s", "pitch_rate_rad_s", "vy_mm_s", "yaw_rate_rad_s",
                 "rail_right_vy_mm_s"):
        if rng.random() < 0.5:
            cells[name] = pace()
    cells["y_mm"] = repr(rng.uniform(-8, 8))
    cells["yaw_rad"] = rng.choice(["0", repr(rng.uniform(-0.1, 0.1))])
    cells["rail_right_y_mm"] = rng.choice(["", repr(rng.uniform(-9, 9))])
    is_bad = i % 2 == 0
    if is_bad:
        name = rng.choice(names)
        cells[name] = rng.choice(["NaN", "inf", "1e400", "1,5", "x", "1e309", "--1"])
        if "," in cells[name]:
            cells[name] = f'"{cells[name]}"'
    text = text_of(["case,side," + ",".join(names), "a,both," + ",".join(cells.values())])
    return Try("wheelset states", ["wheelset", "axle.nml", "--states", "states.csv"], rows=True,
               files={"states.csv": text, "axle.nml": text_of(AXLE)}, may_pass=not is_bad)


def batches(rng, i):
    names, cells = COLUMNS.split(","), ROW.split(",")
    kind = i % 8
    if kind == 0:
        cells[rng.randrange(1, len(cells))] = rng.choice(
            ["NaN", "", "x", "1e400", "-1e400", "\x1b[31m", "1 2", "../../none.csv"])
        return Try("batches", ["batch", "b.csv"], files={
            "b.csv": text_of([COLUMNS, ",".join(cells)])}, rows=True)
    if kind == 1:
        cells = cells[:rng.randrange(1, len(cells))]
    elif kind == 2:
        cells += ["1"] * rng.randrange(1, 5)
    elif kind == 3:
        del names[rng.randrange(len(names))]
        cells = cells[:len(names)]
    elif kind == 4:
        names.append(rng.choice(["status", "area_mm2", "choice", "mu", "case"]))
        cells.append("1")
    elif kind == 5:
        cells[0] = rng.choice(["\"a", "a\"b\"", "\"a\"b"])
    elif kind == 6:
        return Try("batches", ["batch", "b.csv"], codes=(1, 3), files={
            "b.csv": mutated(rng, GOOD["ok.csv"])}, rows=True, may_pass=True)
    else:
        column, value = rng.choice([(2, "-1"), (2, "0"), (3, "0.7"), (3, "-1"), (4, "-0.1"),
                                    (5, "0"), (5, "-5")])
        cells[column] = value
        return Try("batches", ["batch", "b.csv"], files={
            "b.csv": text_of([COLUMNS, ",".join(cells)])}, rows=True)
    return Try("batches", ["batch", "b.csv"], files={"b.csv": text_of(
        [",".join(names), ",".join(cells)])})


# Tables of every kind, and what reads them.
TABLES = (
    ("gap.csv", gap_lines(), ["contact", "case.nml"]),
    ("radii.csv", RADII, ["conicity", "--delta-r", "radii.csv"]),
    ("law.csv", ["# source: none", "# body: rail", "# density_kg_per_m3: 7850",
                 "from_N_per_mm2,to_N_per_mm2,constant_ug_per_m_mm2,slope_ug_per_m_N",
                 "0,10.5,0,2.5", "10.5,inf,26.3,0.1"], ["contact", "case.nml", "--wear",
                                                     "law.csv"]),
    ("b.csv", [COLUMNS + ",given_penetration_mm,friction_kind,mu_kinetic", ROW + ",,,"],
     ["batch", "b.csv"]),
    ("s.csv", ["case,side,y_mm,roll_rad,yaw_rad,speed_mm_s,pitch_rate_rad_s,Fz_N,vy_mm_s,"
               "curve_radius_mm", "a,both,1.5,,0,20000,,160000.5,,"],
     ["wheelset", "axle.nml", "--states", "s.csv"]))


def tables(rng, i):
    """Tables of other dialects than there are, and columns of nearly the right name."""
    name, lines, words = TABLES[i % len(TABLES)]
    lines = lines[:]
    at = next(k for k, line in enumerate(lines) if not line.startswith("#"))
    names = lines[at].split(",")
    kind = rng.randrange(6)
    encoding = "utf-8"
    if kind == 0:  # a comma for the point
        lines[at:] = [line.replace(",", ";").replace(".", ",") for line in lines[at:]]
        lines[-1] = "0,5" + lines[-1][lines[-1].index(";"):] if name != "b.csv" else lines[-1] + ";"
    elif kind == 1:
        encoding = rng.choice(["utf-16", "utf-16-le", "utf-16-be"])
    elif kind == 2:
        separator = rng.choice("|:/~")
        lines[at:] = [line.replace(",", separator) for line in lines[at:]]
    elif kind == 3:  # names parted otherwise than cells
        lines[at] = lines[at].replace(",", rng.choice(";\t"))
    elif kind == 4:
        del lines[at]
    else:
        column = rng.choice([k for k, one in enumerate(names) if one not in ("case", "side")])
        wrong = rng.choice([str.upper, str.title, lambda one: one + "m", lambda one: one + ","])
        names[column] = wrong(names[column])
        if names[column] in COLUMNS or names[column].lower() == "nu":
            names[column] = "Status"
        lines[at] = ",".join(names)
    return Try("tables", words, rows=True, may_pass=kind == 5, files={
        name: text_of(lines).encode(encoding), "axle.nml": text_of(
            ["&wheel", "  profile = 's1002'", "/", "&rail", "  profile = 'uic60'", "/",
             "&material", "  mu = 0.3", "/"])})


BAD_VALUES = {"N": ["1.7", "0", "-1", "99999999999", "", "x", "1e3", "auto!", "\x1b[31m", "²"],
              "INTEGER": ["1.7", "-1", "99999999999", "", "x", "--"],
              "NUMBER": ["NaN", "-inf", "", "1,5", "1e999", "x"],
              "MM": ["NaN", "inf", "", "1 mm", "1e999", "x", "é"],
              "UM": ["NaN", "-1", "", "x"], "E": ["NaN", "-1", "", "x", "2%"],
              "S": ["NaN", "-1", "x"], "D": ["-1", "41", "x", "1.5"],
              "LIST": ["5:2", "x", "-1", "1,,2", "0:99999999"],
              "LOW:HIGH": ["1", "2:1", "x:y", "-99:99", "1:"],
              "NAME": ["", "guess", "STRIP", "strip ,hertz", "\x1b[2J", "strip\n", "x" * 5000],
              "PART": ["guess", ""], "FILE.csv": ["none.csv", "", "."]}
SUBCOMMANDS = {"integral": ["--n", "1", "--b", "0.1"], "contact": ["case.nml"],
               "batch": ["ok.csv"], "sweep": ["prof.nml"], "conicity": ["set.nml"], "table": [],
               "fuzz": ["--cases", "2"],
               "bench": ["integral"], "scenes": []}


def options_of(subcommand):
    """Names and kinds of the options that take a value of a kind known above."""
    program = Try("options", [subcommand]).program
    done = subprocess.run([program, subcommand, "--help"], capture_output=True, text=True,
                          check=True)
    found = re.findall(r"^  (--[a-z-]+) ([A-Z][A-Za-z.:]*) ", done.stdout, re.MULTILINE)
    return [(name, kind) for name, kind in found if kind in BAD_VALUES]


OPTIONS = {}


def options(rng, i):
    if i % 5 == 4:
        words = rng.choice([
            [], ["frobnicate"], ["--frob"], ["contact"], ["contact", "a", "b"], ["batch"],
            ["contact", "case.nml", "--shift"], ["contact", "case.nml", "--shift", "1"],
            ["contact", "case.nml", "-o"], ["contact", "case.nml", "--normal=hertz", "--normal",
                                            "strip"],
            ["integral"], ["integral", "--n", "1"], ["integral", "--n", "1", "--b", "-1"],
            ["table", "x.csv"], ["table", "--audit", "--degree", "3"], ["bench"], ["bench", "x"],
            ["bench", "normal", "--quick"], ["\x1b[31m"], ["contact", "--\x07"], ["--version", "x"],
            ["fuzz", "--read", "none.csv"], ["fuzz", "--case", "1", "--cases", "2"], [""],
            ["contact", ""], ["contact", "case.nml", "--profiles", "p.csv"],
            ["table", "--curves", "a.csv", "-o", "b.csv"], ["report", "--runs", "none.csv"],
            ["sweep", "prof.nml"], ["sweep", "case.nml"], ["contact", "x" * 5000]])
        return Try("options", words, codes=(1, 2))
    subcommand = rng.choice(list(SUBCOMMANDS))
    if subcommand not in OPTIONS:
        OPTIONS[subcommand] = options_of(subcommand)
    name, kind = rng.choice(OPTIONS[subcommand])
    value = rng.choice(BAD_VALUES[kind])
    words = SUBCOMMANDS[subcommand]
    if name in words:
        at = words.index(name)
        words = words[:at] + words[at + 2:]
    words = words + ([name, value] if rng.random() < 0.5 else [f"{name}={value}"])
    code = (1, 2) if kind in ("FILE.csv", "LOW:HIGH", "D") or subcommand == "integral" else (2,)
    attempt = Try("options", [subcommand, *words], codes=code)
    if name in ("--scenes", "--examples") and subcommand == "bench":
        attempt.codes = (1, 2)
    return attempt


def paths(rng, i):
    def links(folder):
        os.link(folder / "gap.csv", folder / "hard.csv")
        (folder / "soft.csv").symlink_to("gap.csv")
        (folder / "dangling.csv").symlink_to("new.csv")
        (folder / "loop.csv").symlink_to("loop.csv")
        (folder / "dir").mkdir()
        (folder / "dirlink").symlink_to("dir")
        os.mkfifo(folder / "pipe")

    spell = rng.choice(["{}", "./{}", "dir/../{}", "{folder}/{}", "dirlink/../{}", ".//{}"])
    output = rng.choice(["-o", "--strips", "--fields", "--gap"])
    contact = ["contact", "case.nml"]
    choice = [
        lambda: contact + [output, spell.format("case.nml", folder="{folder}")],
        lambda: contact + [output, spell.format("gap.csv", folder="{folder}")],
        lambda: contact + [output, rng.choice(["hard.csv", "soft.csv"])],
        lambda: contact + ["--strips", "new.csv", "-o", spell.format("new.csv", folder="{folder}")],
        lambda: contact + ["--gap", "dangling.csv", "--strips", "new.csv"],
        lambda: contact + ["--fields", "hard.csv", "--strips", "soft.csv"],
        lambda: ["contact", "prof.nml", rng.choice(["-o", "--profiles"]), rng.choice(
            ["prof.nml", "w.txt", "./w.txt"])],
        lambda: ["batch", "ok.csv", "-o", spell.format("ok.csv", folder="{folder}")],
        lambda: ["batch", "ok.csv", "-o", rng.choice(["gap.csv", "hard.csv", "soft.csv"])],
        lambda: ["table", "--curves", "a.csv", "--degrees", "./a.csv"],
        lambda: ["table", "--audit", "ok.csv", "-o", "ok.csv"],
        lambda: ["integral", "--input", "ok.csv", "-o", "./ok.csv"],
        lambda: ["fuzz", "--read", "ok.csv", "-o", "ok.csv"],
        lambda: contact + ["-o", rng.choice(["dir", "dir/", "gap.csv/x.csv", "x" * 300, "",
                                             "loop.csv", "pipe", "case.nml/x.csv", "dirlink", "/",
                                             ".", "/proc/x.csv", "y" * 5000])],
        lambda: ["contact", rng.choice(["dir", ".", "none.nml", "loop.csv", "case.nml/x",
                                        "\x1b[31m", "pipe/x", "x" * 300])],
    ][i % 15]
    return Try("paths", choice(), codes=(1, 2), prepare=links)


def permissions(rng, i):
    if other_user.why_not(PROGRAM):
        return paths(rng, i)

    def unreadable(folder):
        (folder / "gap.csv").chmod(0)

    def unreadable_case(folder):
        (folder / "case.nml").chmod(0)

    def closed_folder(folder):
        (folder / "dir").mkdir()
        (folder / "dir" / "old.csv").write_text("old\n")
        (folder / "dir").chmod(0o555)

    def hidden_folder(folder):
        (folder / "dir").mkdir()
        shutil.copy(folder / "case.nml", folder / "dir" / "case.nml")
        (folder / "dir").chmod(0)

    words, prepare = [
        (["contact", "case.nml"], unreadable), (["batch", "ok.csv"], unreadable),
        (["contact", "case.nml"], unreadable_case),
        (["contact", "case.nml", "-o", "dir/new.csv"], closed_folder),
        (["contact", "case.nml", "--strips", "dir/old.csv"], closed_folder),
        (["contact", "dir/case.nml"], hidden_folder),
        (["contact", "case.nml", "-o", "dir/x.csv"], hidden_folder),
    ][i % 7]
    return Try("permissions", words, prepare=prepare, rights=False, rows=words[0] == "batch")


def special_files(rng, i):
    def pipe(folder):
        os.mkfifo(folder / "in")

    def fed_pipe(text):
        def prepare(folder):
            os.mkfifo(folder / "in")

            def feed():
                try:
                    with open(folder / "in", "wb", buffering=0) as stream:
                        while True:
                            stream.write(text * (65536 // len(text)))
                except OSError:
                    pass

            threading.Thread(target=feed, daemon=True).start()
        return prepare

    def bound_socket(folder):
        with socket.socket(socket.AF_UNIX) as place:
            here = os.getcwd()
            os.chdir(folder)
            place.bind("in")
            os.chdir(here)

    def hole(folder):
        with open(folder / "in", "wb") as stream:
            stream.truncate(3 << 30)

    def long_line(folder):
        (folder / "in").write_bytes(b"y_mm," * 400000)

    def columns(folder):
        (folder / "in").write_text(",".join(f"c{i}" for i in range(9000)) + "\n1\n")

    gap = {"case.nml": GOOD["case.nml"].replace("gap.csv", "in")}
    prepare = [pipe, fed_pipe(b"1,2,3\n"), fed_pipe(b"#\n"), fed_pipe(b"x" * 1000), bound_socket,
               hole, long_line, columns, fed_pipe(b"\n"), fed_pipe(b"\0")][i % 10]
    words = rng.choice([["contact", "case.nml"], ["contact", "in"], ["batch", "in"],
                        ["integral", "--input", "in"], ["table", "--audit", "in"]])
    if i % 11 == 10:
        return Try("special files", [rng.choice(["contact", "batch"]), rng.choice(
            ["/dev/zero", "/dev/null", "/dev/urandom", "/dev", "/proc/self/mem"])])
    if i % 11 == 9:
        return Try("special files", ["contact", "case.nml", rng.choice(["-o", "--gap"]),
                                     "/dev/full"])
    return Try("special files", words, files=gap, prepare=prepare)


def signals(rng, i):
    number = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT, signal.SIGXFSZ,
              signal.SIGPIPE, signal.SIGUSR1, signal.SIGXCPU][i % 8]
    wait = rng.uniform(0.0, 0.2)

    def send(process, folder):
        # Once the output is begun.
        for _ in range(1000):
            if any(path.suffix in (".tmp", ".journal") for path in folder.iterdir()):
                break
            time.sleep(0.005)
        time.sleep(wait)
        process.send_signal(number)

    def file_size():
        resource.setrlimit(resource.RLIMIT_FSIZE, (3000, 3000))

    def processor_time():
        resource.setrlimit(resource.RLIMIT_CPU, (1, 2))

    many = {"b.csv": text_of([COLUMNS] + [ROW] * 100000)}
    if i % 10 == 8:
        return Try("signals", ["batch", "b.csv", "-o", "kept.csv"], codes=(128 + signal.SIGXFSZ,),
                   files={"b.csv": text_of([COLUMNS] + [ROW] * 100)}, setup=file_size)
    if i % 10 == 9:
        return Try("signals", ["batch", "b.csv", "-o", "kept.csv"], codes=(128 + signal.SIGXCPU,),
                   files=many, setup=processor_time)
    return Try("signals", ["batch", "b.csv", "-o", "kept.csv"], codes=(128 + number,), files=many,
               during=send)


def endless_work(rng, i):
    sides = rng.choice(["1e-3", "1e-6", "1e-300"])
    words = [["--normal", "norm", "--error-target", rng.choice(["1e-9", "1e-12", "1e-300"]),
              "--max-elements", "100000"],
             ["--normal", "norm", "--element-dx", sides, "--element-dy", sides],
             ["--tangential", "tang", "--element-dx", sides, "--element-dy", sides],
             ["--normal", "auto", "--target", "pmax", "--tolerance", "1e-12", "--max-elements",
              "100000"],
             ["--normal", "hertz", "--tangential", "tang", "--element-dx", "1e-9"]][i % 5]
    if "auto" in words:
        # No ellipse, which would be exact: a solution that says by how much it misses.
        return Try("endless work", ["contact", "case.nml", *words], codes=(0,), files={
            "gap.csv": text_of(gap_lines(height=lambda y: abs(y) ** 1.5 / 100.0))})
    return Try("endless work", ["contact", "case.nml", *words], codes=(1, 3))


def side_files(_, i):
    """What lies where the program makes files of its own: all of them in turn, mixed by chance."""
    side = ORDER_OF_SIDES[i % len(ORDER_OF_SIDES)]
    return Try("side files", side.words, codes=side.codes, prepare=side.prepare, makes=side.makes)


ORDER_OF_SIDES = random.Random(0).sample(tries(), len(tries()))

# What Fortran's run-time library reads, and what it may be told.
RUN_TIME = {"STDIN_UNIT": ["6", "7", "0", "-1"], "STDOUT_UNIT": ["7", "0", "5", "-9", "x"],
            "STDERR_UNIT": ["7", "6", "99", "x"], "UNBUFFERED_ALL": ["y", "1"],
            "UNBUFFERED_PRECONNECTED": ["y"], "SHOW_LOCUS": ["n"], "OPTIONAL_PLUS": ["y"],
            "LIST_SEPARATOR": [";", " , ", "xyz"], "DEFAULT_RECL": ["10", "1", "-1", "x"],
            "CONVERT_UNIT": ["swap", "big_endian", "native;swap:10-20", "x"],
            "ERROR_BACKTRACE": ["y", "n"], "FORMATTED_BUFFER_SIZE": ["1", "-1", "x"],
            "UNFORMATTED_BUFFER_SIZE": ["1", "-1", "x"], "TMPDIR": ["/nowhere", ""]}


def environments(rng, i):
    names = rng.sample(sorted(RUN_TIME), rng.choice([1, 1, 2, 4])) if i % 4 else ["STDOUT_UNIT"]
    settings = {f"GFORTRAN_{name}": rng.choice(RUN_TIME[name]) for name in names}
    if i % 2:
        return Try("environments", rng.choice([["contact", "none.nml"], ["batch", "gap.csv"]]),
                   environment=settings)
    words = rng.choice([["contact", "case.nml"], ["batch", "ok.csv"], ["profile", "w.txt"],
                        ["table"], ["--help"]])
    return Try("environments", words, codes=(0,), may_pass=True, environment=settings)


def sizes(rng, i):
    """A number that is huge or tiny, by any method: an end in bounded time, in words."""
    value = f"{rng.choice(['', '', '-'])}1e{rng.choice([-300, -60, -20, 20, 60, 150, 220, 300])}"
    group, name = [("contact", "load_N"), ("contact", "penetration_mm"),
                   ("material", "E_wheel_MPa"), ("material", "nu_rail"), ("material", "mu"),
                   ("motion", "cksi"), ("motion", "cphi_rad_per_mm")][i % 7]
    lines = [line for line in CASE if not line.strip().startswith(name + " ")
             and not (name == "penetration_mm" and "load_N" in line)]
    lines.insert(lines.index(f"&{group}") + 1, f"  {name} = {value}")
    normal = rng.choice(["strip", "hertz", "equal_area", "equal_moments", "kpec", "kpec_strips",
                         "analyn", "norm"])
    return Try("sizes", ["contact", "case.nml", "--normal", normal, "--max-elements", "100000"],
               codes=(1, 3), files={"case.nml": text_of(lines)}, may_pass=True)


FAMILIES = {"case values": (case_values, 16), "units": (units, 8), "namelists": (namelists, 14),
            "gap files": (gap_files, 14), "profile files": (profile_files, 10),
            "conicities": (conicities, 8), "pairs": (pairs, 6), "batches": (batches, 12),
            "options": (options, 16), "paths": (paths, 10), "side files": (side_files, 10),
            "permissions": (permissions, 2), "special files": (special_files, 2),
            "signals": (signals, 3), "endless work": (endless_work, 1),
            "environments": (environments, 3), "sizes": (sizes, 6), "tables": (tables, 10),
            "wheelset states": (wheelset_states, 10)}


def snapshot(folder):
    """What every file of a folder is and holds."""
    found = {}
    for path in sorted(folder.rglob("*")):
        about = path.lstat()
        if stat.S_ISREG(about.st_mode):
            found[str(path.relative_to(folder))] = (about.st_mode, content(path, about))
        elif stat.S_ISLNK(about.st_mode):
            found[str(path.relative_to(folder))] = (about.st_mode, os.readlink(path))
        else:
            found[str(path.relative_to(folder))] = (about.st_mode, None)
    return found


def content(path, about):
    """What a file holds, as far as it is small and oneself may read it."""
    if about.st_size >= 1 << 20 or not os.access(path, os.R_OK):
        return about.st_size
    return path.read_bytes()


def judge(attempt, code, seconds, err, changes, limit):
    """What is wrong, in words; an empty list if nothing is."""
    wrong = []
    lines = [line for line in err.splitlines() if not PROGRESS.fullmatch(line)]
    speaker = f"{attempt.program.name}: "
    if seconds > limit:
        wrong.append(f"took {seconds:.1f} s")
    if attempt.family == "sizes" and any(word in err for word in ("NaN", "Infinity")):
        wrong.append("words of what is no number")
    if attempt.says not in err:
        wrong.append(f"does not say {attempt.says!r}")
    if any(word in err for word in NEVER):
        wrong.append("the runtime speaks")
    if changes and not (code == 0 and attempt.may_pass):
        wrong.append("changed: " + ", ".join(sorted(changes)))
    if code == 0 and (attempt.may_pass or 0 in attempt.codes and attempt.makes):
        wrong += ["an unclear note" for line in lines if not line.startswith(speaker)]
        return wrong
    if code not in attempt.codes:
        wrong.append(f"exit code {code}, not {' or '.join(map(str, attempt.codes))}")
    if any(not line.startswith(speaker) or not line.isprintable() for line in lines):
        wrong.append("an unclear line")
    if len(lines) != 1 and not (attempt.rows and 1 <= len(lines) <= 10):
        wrong.append(f"{len(lines)} lines")
    return wrong


def run(attempt, limit):
    """What is wrong with one input, its exit code and what it said."""
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        for name, content in {**GOOD, **attempt.files}.items():
            (folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
        if attempt.prepare:
            attempt.prepare(folder)
        before = snapshot(folder)
        if attempt.user is not None:
            os.chown(folder, attempt.user, attempt.user)
        words = [word.replace("{folder}", place) for word in attempt.words]
        start = time.monotonic()
        process = subprocess.Popen(
            [attempt.program, *words], cwd=folder, stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, user=attempt.user,
            preexec_fn=attempt.in_the_child,
            env={**os.environ, "OPENBLAS_NUM_THREADS": "1", **attempt.environment})
        if attempt.during:
            attempt.during(process, folder)
        try:
            err = process.communicate(timeout=limit)[1]
        except subprocess.TimeoutExpired:
            process.kill()
            err = process.communicate()[1]
        seconds = time.monotonic() - start
        after = snapshot(folder)
        changes = {name for name in before.keys() | after.keys()
                   if before.get(name) != after.get(name)}
        # What a batch has done stays for who resumes it.
        changes -= {"kept.csv.partial", "kept.csv.journal"}
        code = process.returncode
        changes -= {name for name in attempt.makes if code == 0 or name not in before}
        err = err.decode("utf-8", "backslashreplace")
        return judge(attempt, code, seconds, err, changes, limit), code, err


def attempts(n, seed, family=""):
    """The inputs, the same for the same seed, dealt to the families by their weights."""
    names = [name for name in FAMILIES if family in name]
    weights = [FAMILIES[name][1] for name in names]
    counts = collections.Counter()
    rng = random.Random(seed)
    for number in range(n):
        # Every family in turn first, then by weight.
        name = names[number] if number < len(names) else rng.choices(names, weights)[0]
        own = random.Random(f"{seed} {name} {counts[name]}")
        yield number + 1, FAMILIES[name][0](own, counts[name])
        counts[name] += 1


def main(words=None):
    parser = argparse.ArgumentParser(prog="hostile.py")
    parser.add_argument("n", nargs="?", type=int, default=500, metavar="N")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--family", default="", help="only families whose name holds this")
    parser.add_argument("--seconds", type=float, default=10.0, help="each has to end within")
    parser.add_argument("--show", action="store_true", help="print what every input led to")
    arguments = parser.parse_args(words)
    if arguments.n < 1:
        parser.error(f"N must be at least 1, got {arguments.n}")
    if not any(arguments.family in name for name in FAMILIES):
        parser.error(f"--family must be in one of {', '.join(FAMILIES)}, got {arguments.family}")
    bad, codes = 0, collections.Counter()
    for number, attempt in attempts(arguments.n, arguments.seed, arguments.family):
        wrong, code, err = run(attempt, arguments.seconds)
        codes[code] += 1
        if arguments.show:
            print(f"{number:4}  {code:3}  {attempt.family:14} {attempt}\n{err}", end="")
        if wrong:
            bad += 1
            if bad == 1:
                print("number  family          what is wrong")
            print(f"{number:6}  {attempt.family:14}  {'; '.join(wrong)}\n"
                  f"{'':24}{str(attempt)[:200]}\n{'':24}{err[-400:]!r}", flush=True)
    why = other_user.why_not(PROGRAM)
    if why and arguments.family in "permissions":
        print(f"in the place of permissions other paths were tried: {why}")
    ends = ", ".join(f"{count} x {code}" for code, count in sorted(codes.items()))
    print(f"{arguments.n} hostile inputs with seed {arguments.seed}: {bad} wrong;"
          f" exit codes {ends}")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
