"""The case as a file of the program, the numbers as CSV; and NORM + TANG by the program."""

from __future__ import annotations

import csv
import dataclasses
import io
import os
import pathlib
import shutil
import subprocess
import tempfile
import zipfile
from typing import Any, Dict, Iterator, List, NamedTuple, Optional, Tuple

import numpy as np
import numpy.typing as npt

from .._contact import library_version
from .._library import ProgramNotFound, library
from .._results import Result
from .case import RADIUS, STANDARD, Shape
from .solving import METHODS, Answer, Outcome

Array = npt.NDArray[np.float64]
NAME = "explore"
FIGURES = (("penetration_mm", "penetration"), ("area_mm2", "area"), ("pmax_MPa", "pmax"),
           ("ymin_mm", "y_min"), ("ymax_mm", "y_max"), ("xmax_mm", "x_max"),
           ("n_patches", "n_patches"), ("strips_across", "strips_across"), ("Fx_N", "fx"),
           ("Fy_N", "fy"), ("Mz_Nmm", "mz"), ("friction_power_N", "friction_power"),
           ("stick_fraction", "stick_fraction"), ("est_err_penetration", "est_err_penetration"),
           ("est_err_pmax", "est_err_pmax"), ("est_err_area", "est_err_area"),
           ("est_err_Fx", "est_err_fx"), ("est_err_Fy", "est_err_fy"),
           ("est_err_Mz", "est_err_mz"))
CASE_COLUMNS = ("wheel", "rail", "yw_mm", "yaw_rad", "Q_N", "N_N", "gamma_rad", "cksi", "ceta",
                "cphi_rad_per_mm", "mu")
GAP = ("y_mm", "h_mm", "inv2R_per_mm", "inclination_rad")
METHOD_NAMES = {**METHODS, "norm": ("norm", "tang")}


def _candidates() -> Iterator[str]:
    if "FASTSTRIP_PROGRAM" in os.environ:
        yield os.environ["FASTSTRIP_PROGRAM"]
        return
    if "FASTSTRIP_PREFIX" in os.environ:
        yield str(pathlib.Path(os.environ["FASTSTRIP_PREFIX"]) / "bin" / "faststrip")
        return
    yield str(pathlib.Path(library._name).parent.parent / "bin" / "faststrip")
    yield shutil.which("faststrip") or ""


def _program() -> str:
    tried = [name for name in _candidates() if name]
    for name in tried:
        if os.access(name, os.X_OK) and os.path.isfile(name):
            return name
    raise ProgramNotFound("no program faststrip: install it with ./run install --prefix FOLDER and "
                          "set FASTSTRIP_PREFIX to that folder, or FASTSTRIP_PROGRAM to the file; "
                          "tried " + (", ".join(tried) or "PATH"))


def _rows(path: pathlib.Path) -> List[Dict[str, str]]:
    lines = path.read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def quoted(text: str) -> str:
    """A text of a namelist."""
    return "'" + text.replace("'", "''") + "'"


def put_beside(kind: str, shape: Shape, files: Dict[str, bytes]) -> str:
    """The name of a profile in a case file; a file is put among those beside it."""
    if not shape.is_file:
        return shape.label
    name = shape.label
    while name in files or name in STANDARD[kind] or name == f"{NAME}.nml":
        name = f"{kind}_{name}"
    files[name] = shape.content
    return name


def case_files(outcome: Outcome) -> Dict[str, bytes]:
    """The case file and what has to stand beside it, by their names.

    A yawed contact is given by its gap, as the program's ``contact`` knows no yaw.
    """
    case, geometry = outcome.case, outcome.geometry
    files: Dict[str, bytes] = {}
    direction = "vertical" if case.is_vertical else "normal"
    lines = [f"! Written by faststrip-explore {library_version()}: one right wheel on one right "
             "rail.", "! faststrip contact solves it as the page does."]
    if case.yaw and geometry is not None:
        name = f"{NAME}_gap.csv"
        rows = zip(*(values.tolist() for values in geometry.gap))
        files[name] = "".join(",".join(map(str, row)) + "\n" for row in (GAP, *rows)).encode()
        lines += [f"! The gap of {case.wheel.label} on {case.rail.label}, shifted by "
                  f"{case.shift!r} mm and yawed by {case.yaw!r} rad,",
                  f"! under a vertical load of {case.load!r} N.",
                  "&contact", f"  name = {quoted(NAME)}", f"  gap_file = {quoted(name)}",
                  f"  load_N = {geometry.load!r}", "/"]
    else:
        lines += ["&contact", f"  name = {quoted(NAME)}", f"  load_N = {case.load!r}",
                  f"  load_direction = {quoted(direction)}", f"  shift_mm = {case.shift!r}", "/",
                  "&wheel", f"  profile = {quoted(put_beside('wheel', case.wheel, files))}",
                  f"  radius_mm = {RADIUS!r}", "/",
                  "&rail", f"  profile = {quoted(put_beside('rail', case.rail, files))}",
                  f"  inclination = {case.inclination!r}",
                  f"  roller_radius_mm = {case.roller_radius!r}", "/"]
    lines += ["&material", f"  mu = {case.mu!r}", "/",
              "&motion", "  creepage = 'given'", f"  cksi = {case.cksi!r}",
              f"  ceta = {case.ceta!r}", f"  cphi_rad_per_mm = {case.cphi!r}", "/",
              "&numerics", "  normal = 'strip'", "  tangential = 'faststrip'",
              "  strips_per_patch = 15", "  points_per_strip = 15",
              f"  curved = .{str(case.is_curved).lower()}.", "/", ""]
    return {f"{NAME}.nml": "\n".join(lines).encode("utf-8"), **files}


def packed(files: Dict[str, bytes]) -> Tuple[str, bytes]:
    """Name and content of what is downloaded: the case file alone, or an archive."""
    if len(files) == 1:
        return next(iter(files.items()))
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return f"{NAME}.zip", stream.getvalue()


def numbers_csv(outcome: Outcome) -> str:
    """One row a method, with the columns of ``faststrip contact``."""
    case, geometry = outcome.case, outcome.geometry
    stream = io.StringIO()
    stream.write(f"# faststrip-explore {library_version()}\n")
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(["normal", "tangential", *CASE_COLUMNS, "status",
                     *(name for name, _ in FIGURES), "time_us"])
    if geometry is None:
        return stream.getvalue()
    head = [case.wheel.label, case.rail.label, case.shift, case.yaw, case.load, geometry.load,
            geometry.place.angle, *case.creepage, case.mu]
    for name, answer in outcome.answers.items():
        row: List[Any] = [*METHOD_NAMES[name], *head]
        if answer.result is None:
            row += [answer.error.partition(":")[0], *[None] * len(FIGURES)]
        else:
            row += [answer.result.word, *(getattr(answer.result, what) for _, what in FIGURES)]
        seconds = outcome.times.get(name)
        writer.writerow([*(repr(value) if isinstance(value, float) else value for value in row),
                         None if seconds is None else repr(round(1e6 * seconds, 1))])
    return stream.getvalue()


class Reference(NamedTuple):
    """What NORM + TANG of the program made of a case."""

    answer: Answer
    y: Array  #: rows of elements
    pressure: Array  #: largest of each row, MPa
    x_first: Array  #: ends of each row, mm
    x_last: Array
    seconds: float


class Program:
    """A run of the program, which can be ended."""

    def __init__(self) -> None:
        self.process: Optional[subprocess.Popen] = None

    def reference(self, files: Dict[str, bytes]) -> Reference:
        """Solve by NORM + TANG; RuntimeError in one line where that fails, ImportError without a
        program."""
        program = _program()
        with tempfile.TemporaryDirectory() as folder:
            for name, content in files.items():
                pathlib.Path(folder, name).write_bytes(content)
            self.process = subprocess.Popen(
                [program, "contact", f"{NAME}.nml", "--normal", "norm", "--tangential", "tang",
                 "-o", "norm_result.csv", "--fields", "norm_fields.csv"], cwd=folder,
                stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                encoding="utf-8", errors="replace")
            words = self.process.communicate()[1]
            if self.process.returncode != 0:
                lines = words.strip().splitlines() or [f"exit code {self.process.returncode}"]
                raise RuntimeError(lines[-1])
            return read_reference(pathlib.Path(folder))

    def end(self) -> None:
        """End a run that goes on."""
        if self.process is not None and self.process.poll() is None:
            self.process.kill()


def result_of(row: Dict[str, str]) -> Result:
    """A row of the program as a result; what it does not say is None."""
    known: Dict[str, Any] = {field.name: None for field in dataclasses.fields(Result)}
    known.update({what: float(row[name]) if row.get(name) else None for name, what in FIGURES})
    known.update(status=0 if row["status"] == "ok" else 1, word=row["status"],
                 load=float(row["N_N"]), steps=())
    return Result(**known)


def read_reference(folder: pathlib.Path) -> Reference:
    """What the program has written."""
    figures = _rows(folder / "norm_result.csv")[0]
    seconds = 1e-6 * (float(figures["normal_us"]) + float(figures["tangential_us"]))
    rows = _rows(folder / "norm_fields.csv")
    x, y, p = (np.array([float(row[name]) for row in rows])
               for name in ("x_mm", "y_mm", "pn_MPa"))
    places, row = np.unique(y, return_inverse=True)
    pressure = np.zeros(len(places))
    first, last = np.full(len(places), np.inf), np.full(len(places), -np.inf)
    inside = p > 0.0
    np.maximum.at(pressure, row[inside], p[inside])
    np.minimum.at(first, row[inside], x[inside])
    np.maximum.at(last, row[inside], x[inside])
    there = pressure > 0.0
    return Reference(Answer(result_of(figures), None, None), places[there], pressure[there],
                     first[there], last[there], seconds)
