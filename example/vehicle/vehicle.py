#!/usr/bin/env python3
"""Run a bogie through a curve and down from its limit cycle, with contacts by strips, by Hertz and
by a table, and draw what comes out."""

from __future__ import annotations

import argparse
import concurrent.futures
import csv
import os
import pathlib
import subprocess
import sys
import time
import warnings

# Before numpy: more threads cost more, and round otherwise.
os.environ["OPENBLAS_NUM_THREADS"] = "1"

import faststrip
import matplotlib.pyplot as plt
import numpy as np
from bogie import PITCH, YAW, Bogie, Track, Y
from contact import METHODS, ByWheelset
from simulate import Motions, Run

ROOT = pathlib.Path(__file__).resolve().parents[2]
CASE = "&wheel profile = 's1002' /\n&rail profile = '60e1' /\n&material mu = 0.3 /\n"
CURVE_SPEED = 35.0e3  # mm/s
LABELS = {"strips": "strips", "hertz": "Hertz and Polach", "table": "table of the wheel"}
COLOURS = {"strips": "#0b5394", "hertz": "#cc6600", "table": "#38761d"}
ABOVE = {"strips": 4, "table": 3, "hertz": 2}  # which lines lie over others
# Hertz jumps where flanges strike, and its steps become short: its limit cycle is left out.
CYCLES = "strips", "table"
RATE = 100  # times a second that are kept
# Seconds in the curve, of the comparison of Jacobians; speeds down to which the limit cycle is
# followed, m/s, and seconds at each; what the table is made with.
FULL = 20.0, 1.0, (80.0, 75.0, 70.0, 65.0, 60.0), 2.5, "--y -8:8 --error 0.1 --tests 500"
QUICK = 0.6, 0.1, (80.0,), 0.1, "--y -6:6 --error 0.2 --tests 299"


def contacts(method: str, folder: pathlib.Path) -> list[ByWheelset]:
    """Of both wheelsets."""
    table = folder / "wheel.fslt" if method == "table" else None
    return [ByWheelset(method, table) for _ in range(2)]


def track(quick: bool) -> Track:
    """Of the curve; a short one is reached soon."""
    return Track(straight=5.0e3, transition=2.5e4, curve=2.0e4) if quick else Track()


def through_curve(method: str, folder: pathlib.Path, quick: bool, end: float,
                  differences: bool = False) -> tuple[str, Run]:
    """A run on the rough curve."""
    motions = Motions(Bogie(track(quick), CURVE_SPEED), contacts(method, folder))
    times = np.linspace(0, end, round(end * RATE) + 1)
    return method, motions.run(end, motions.start(), times, differences=differences)


def limit_cycles(method: str, folder: pathlib.Path, speeds: tuple[float, ...],
                 each: float) -> tuple[str, list[tuple[float, float]]]:
    """Speeds, m/s, and largest lateral displacement of the front wheelset in the last half of the
    time at each, mm: on even, straight track, from a large displacement at the highest speed, and
    from where the last speed ended."""
    found = []
    state = None
    even = Track(radius=np.inf, cant=0.0, rough=0.0)
    for speed in speeds:
        motions = Motions(Bogie(even, speed * 1e3), contacts(method, folder))
        if state is None:
            state = motions.start(5.0)
        run = motions.run(each, state, np.linspace(0, each, round(each * 2 * RATE) + 1))
        state = run.y[:, -1]
        found.append((speed, float(np.abs(run.y[Y, run.t > each / 2]).max())))
    return method, found


def wheel_forces(method: str, folder: pathlib.Path, quick: bool, run: Run) -> np.ndarray:
    """Forces on the rails of a run: (time, wheelset, wheel, 6)."""
    motions = Motions(Bogie(track(quick), CURVE_SPEED), contacts(method, folder))
    return -np.array([motions.wheel_forces(t, y) for t, y in zip(run.t, run.y.T, strict=True)])


def loads_or_height(quick: bool, run: Run, folder: pathlib.Path) -> tuple[float, float]:
    """Time of a call with z and roll given over one that finds them for the axle load and a moment,
    on the states of a run, each from the last: s."""
    motions = Motions(Bogie(track(quick), CURVE_SPEED), contacts("strips", folder))
    contact = motions.contacts[0]
    spent = np.zeros(2)
    for t, y in zip(run.t, run.y.T, strict=True):
        _, rails = motions.bogie.track_forces(CURVE_SPEED * t)
        motion = motions.motion(y, 0, rails[0])
        began = time.process_time()
        forces = contact.forces(motion).sum(0)
        between = time.process_time()
        contact.wheelset.solve(
            y=motion.q[Y], yaw=motion.q[YAW], speed=CURVE_SPEED, y_rate=motion.v[Y],
            yaw_rate=motion.v[YAW], pitch_rate=motion.v[PITCH], curvature=rails[0][0],
            axle_load=-forces[2], roll_moment=-forces[3], warm_start=True,
            right_rail=faststrip.RailState(*rails[0][1:3]),
            left_rail=faststrip.RailState(*rails[0][3:5]))
        spent += between - began, time.process_time() - between
    return tuple(spent / len(run.t))


def draw_curve(path: pathlib.Path, runs: dict[str, Run], quick: bool) -> None:
    """Displacement and yaw of the front wheelset and the track."""
    figure, (top, middle, bottom) = plt.subplots(3, 1, figsize=(9, 8), sharex=True,
                                                 layout="constrained")
    for method, run in runs.items():
        style = {"color": COLOURS[method], "lw": 0.9, "label": LABELS[method],
                 "zorder": ABOVE[method]}
        top.plot(run.t, run.y[Y], **style)
        middle.plot(run.t, np.degrees(run.y[YAW]), **style)
    top.set_ylabel("y of the front wheelset, mm")
    top.legend(ncols=3, loc="lower center", bbox_to_anchor=(0.5, 1.0), frameon=False)
    middle.set_ylabel("its yaw, degrees")
    here = track(quick)
    t = runs["strips"].t
    s = CURVE_SPEED * t
    rails = here.irregularity(s)
    bottom.plot(t, (rails[0] + rails[2]) / 2, color="#666666", lw=0.9, label="alignment, mm")
    bottom.plot(t, (rails[1] + rails[3]) / 2, color="#b4a7d6", lw=0.9, label="level, down, mm")
    bottom.plot(t, 1e6 * here.curvature(s), color="black", lw=1.8, label="curvature, 1/km")
    bottom.set(xlabel="time, s", ylabel="track")
    bottom.legend(ncols=3, loc="lower center", bbox_to_anchor=(0.5, 1.0), frameon=False)
    for axes in (top, middle, bottom):
        axes.grid(alpha=0.3)
    figure.savefig(path, dpi=130)
    plt.close(figure)


def draw_forces(path: pathlib.Path, t: np.ndarray, own: dict[str, np.ndarray],
                same: dict[str, np.ndarray]) -> None:
    """Forces on the outer rail under the front wheelset: each method with its own motion over time,
    and the others against strips in the motion of the strips."""
    figure, rows = plt.subplots(3, 2, figsize=(11, 9), layout="constrained",
                                gridspec_kw={"width_ratios": [2, 1]})
    for k, (left, right) in enumerate(rows):
        name = "Fx Fy Fz".split()[k]
        for method, forces in own.items():
            left.plot(t, forces[:, 0, 1, k] / 1e3, color=COLOURS[method], lw=0.8,
                      label=LABELS[method], zorder=ABOVE[method])
        left.set_ylabel(f"{name} on the outer rail, kN")
        exact = same["strips"][:, 0, 1, k] / 1e3
        for method in ("hertz", "table"):
            right.plot(exact, same[method][:, 0, 1, k] / 1e3, ".", ms=2.5, color=COLOURS[method],
                       label=LABELS[method])
        ends = [exact.min(), exact.max()]
        right.plot(ends, ends, color="black", lw=0.7)
        right.set(xlabel=f"{name} by strips, kN", ylabel=f"{name} in the same state, kN")
        for axes in (left, right):
            axes.grid(alpha=0.3)
    rows[0, 0].legend(ncols=3, loc="lower center", bbox_to_anchor=(0.5, 1.0), frameon=False)
    rows[0, 1].legend(ncols=2, loc="lower center", bbox_to_anchor=(0.5, 1.0), frameon=False,
                      markerscale=4, fontsize="small", columnspacing=1.0)
    rows[2, 0].set_xlabel("time, s")
    figure.savefig(path, dpi=130)
    plt.close(figure)


def draw_limit_cycles(path: pathlib.Path, cycles: dict[str, list[tuple[float, float]]]) -> None:
    """Amplitude over speed."""
    figure, axes = plt.subplots(figsize=(7, 4.5), layout="constrained")
    for method, found in cycles.items():
        axes.plot(*np.transpose(found), "o-", color=COLOURS[method], label=LABELS[method], ms=4)
    axes.set(xlabel="speed, m/s", ylabel="largest y of the front wheelset, mm")
    axes.set_ylim(bottom=0)
    axes.grid(alpha=0.3)
    axes.legend(ncols=2, loc="lower center", bbox_to_anchor=(0.5, 1.0), frameon=False)
    figure.savefig(path, dpi=130)
    plt.close(figure)


def say(words: str) -> None:
    """Progress."""
    print(f"vehicle: {words}", file=sys.stderr, flush=True)


def main() -> None:
    """All of it; figures, pictures and a table of figures are in the folder."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "out" / "vehicle")
    parser.add_argument("--program", default=ROOT / "bin" / "faststrip")
    parser.add_argument("--quick", action="store_true", help="a second, and a coarser table")
    options = parser.parse_args()
    # Flanges that are struck pass what is usual of pressures.
    warnings.simplefilter("ignore", faststrip.ImplausibleWarning)
    os.environ["PYTHONWARNINGS"] = "ignore::faststrip.ImplausibleWarning"
    end, short, speeds, each, make = QUICK if options.quick else FULL
    folder, quick = options.folder, options.quick
    folder.mkdir(parents=True, exist_ok=True)
    rows: list[tuple[str, float, str]] = []

    with concurrent.futures.ProcessPoolExecutor(2, initializer=warnings.simplefilter,
                                                initargs=("ignore",)) as pool:
        early = [pool.submit(through_curve, method, folder, quick, end)
                 for method in ("strips", "hertz")]
        (folder / "wheel.nml").write_text(CASE, encoding="utf-8")
        say("making the wheel's table, and running strips and Hertz through the curve")
        with open(folder / "table.log", "wb") as log:
            subprocess.run([options.program, "lookup", "wheel", folder / "wheel.nml", "-o",
                            folder / "wheel.fslt", "--load", "10000:130000", "--yaw", "-6e-3:6e-3",
                            "--threads", "1", *make.split()], check=True, stdout=subprocess.DEVNULL,
                           stderr=log)
        early.append(pool.submit(through_curve, "table", folder, quick, end))
        kinds = [pool.submit(through_curve, "strips", folder, quick, short, differences)
                 for differences in (False, True)]
        later = [pool.submit(limit_cycles, method, folder, speeds, each) for method in CYCLES]
        runs, cycles = {}, {}
        for job in concurrent.futures.as_completed([*early, *later]):
            method, found = job.result()
            if isinstance(found, Run):
                runs[method] = found
                say(f"{method} through the curve: {end:g} s in {found.spent:.0f} s, {found.calls}"
                    f" calls, {found.failed} failed")
            else:
                cycles[method] = found
                say(f"{method}, limit cycle: "
                    + ", ".join(f"{y:.1f} mm at {v:g} m/s" for v, y in found))
        for words, job in zip(("derivatives", "differences"), kinds, strict=True):
            run = job.result()[1]
            rows += [(f"{short:g} s by {words}: calls", run.calls, "1"),
                     (f"{short:g} s by {words}: time", run.spent, "s")]

    runs = {method: runs[method] for method in METHODS}
    for method, run in runs.items():
        rows += [(f"{method}: real-time factor", run.factor, "1"),
                 (f"{method}: over that of strips", run.factor / runs["strips"].factor, "1"),
                 (f"{method}: calls", run.calls, "1"), (f"{method}: Jacobians", run.jacobians, "1"),
                 (f"{method}: failed calls", run.failed, "1")]
    say("forces of all three")
    own = {method: wheel_forces(method, folder, quick, run) for method, run in runs.items()}
    same = {method: wheel_forces(method, folder, quick, runs["strips"]) for method in METHODS}
    for method in ("hertz", "table"):
        for k, name in enumerate(("Fx", "Fy", "Fz")):
            apart = same[method][..., k] - same["strips"][..., k]
            rows.append((f"{method}: {name} in the same state, rms difference",
                         float(np.sqrt((apart**2).mean())), "N"))
    z_given, loads_given = loads_or_height(quick, runs["strips"], folder)
    rows += [("call with z given", z_given * 1e3, "ms"),
             ("call with loads given", loads_given * 1e3, "ms")]
    for method, found in cycles.items():
        rows += [(f"{method}: amplitude at {speed:g} m/s", y, "mm") for speed, y in found]

    draw_curve(folder / "curve.png", runs, quick)
    draw_forces(folder / "forces.png", runs["strips"].t, own, same)
    draw_limit_cycles(folder / "limit_cycle.png",
                      {method: cycles[method] for method in CYCLES})
    with open(folder / "figures.csv", "w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows([("what", "value", "unit"), *rows])
    for what, value, unit in rows:
        print(f"  {what:52} {value:10.4g} {unit}")


if __name__ == "__main__":
    main()
