#!/usr/bin/env python3
"""How smooth the forces of a wheel are in its lateral displacement: sweeps `faststrip wheelset`.

    tools/check/wheelset_smoothness.py CASE.nml --from -10 --to 10 --step-um 1 [-o STEPS.csv]

Prints the largest step of Fy and N (of all contacts of the wheel together) from one state to the
next, the largest second difference, where they are, and how many states had which status. States
that fail end a stretch: nothing is compared across them.
"""

import argparse
import collections
import csv
import itertools
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
HEADER = "case,side,y_mm,roll_rad,yaw_rad,speed_mm_s,pitch_rate_rad_s,Fz_N"
CHUNK = 1000  # states of one run of the program


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("case", help="a case file")
    parser.add_argument("--from", dest="first", type=float, default=-10.0, help="mm (default -10)")
    parser.add_argument("--to", dest="last", type=float, default=10.0, help="mm (default 10)")
    parser.add_argument("--step-um", type=float, default=1.0, help="between states (default 1)")
    parser.add_argument("--load", type=float, default=60000.0, help="of the wheel, N")
    parser.add_argument("--yaw", type=float, default=0.002, help="rad (default 0.002)")
    parser.add_argument("--speed", type=float, default=20000.0, help="mm/s (default 20000)")
    parser.add_argument("--program", default=str(ROOT / "bin" / "faststrip"))
    parser.add_argument("-o", dest="output", help="write y_mm,Fy_N,N_N,contacts,status there")
    options = parser.parse_args(arguments)
    states = sweep(options)
    if options.output:
        with open(options.output, "w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(["y_mm", "Fy_N", "N_N", "contacts", "status"])
            writer.writerows(states)
    for line in report(states, options.step_um):
        print(line)


def sweep(options):
    """y, Fy, N, number of contacts and status of each state; None for forces that failed."""
    n = round((options.last - options.first) * 1e3 / options.step_um) + 1
    states = []
    with tempfile.TemporaryDirectory() as folder:
        given, result = pathlib.Path(folder, "states.csv"), pathlib.Path(folder, "result.csv")
        for start in range(0, n, CHUNK):
            ys = [options.first + i * options.step_um * 1e-3
                  for i in range(start, min(n, start + CHUNK))]
            given.write_text("\n".join([HEADER, *(
                f"{i},right,{y!r},0,{options.yaw},{options.speed},,{options.load}"
                for i, y in enumerate(ys))]) + "\n", encoding="utf-8")
            run = subprocess.run([options.program, "wheelset", options.case, "--states",
                                  str(given), "-o", str(result)], capture_output=True, text=True,
                                 check=False)
            if not result.exists():
                sys.exit(run.stderr.strip())
            with open(result, encoding="utf-8", newline="") as file:
                rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
            for name, contacts in itertools.groupby(rows, key=lambda row: row["case"]):
                states.append(one_state(ys[int(name)], list(contacts)))
            result.unlink()
    return states


def one_state(y, contacts):
    """The sums over the contacts of a state."""
    worst = next((row["status"] for row in contacts if row["status"] != "ok"), "ok")
    if any(row["N_N"] == "" for row in contacts):
        return (y, None, None, 0, worst)
    return (y, sum(float(row["Fy_track_N"]) for row in contacts),
            sum(float(row["N_N"]) for row in contacts), len(contacts), worst)


def report(states, step_um):
    """What is printed of a sweep."""
    lines = [f"{len(states)} states from {states[0][0]:g} to {states[-1][0]:g} mm in "
             f"{step_um:g} um: " + ", ".join(
                 f"{count} {word}" for word, count in
                 collections.Counter(state[4] for state in states).most_common())]
    for name, column in (("Fy", 1), ("N", 2)):
        forces = [state[column] for state in states]
        steps = [(abs(b - a), i) for i, (a, b) in enumerate(itertools.pairwise(forces))
                 if a is not None and b is not None]
        bends = [(abs(a - 2 * b + c), i + 1)
                 for i, (a, b, c) in enumerate(zip(forces, forces[1:], forces[2:]))
                 if None not in (a, b, c)]
        for what, found in (("step", steps), ("second difference", bends)):
            if not found:
                lines.append(f"{name}: no {what}")
                continue
            largest, at = max(found)
            middle = sorted(found)[len(found) // 2][0]
            lines.append(f"{name}: largest {what} {largest:.4g} N at {states[at][0]:.4f} mm, "
                         f"median {middle:.3g} N; {states[at][3]} contacts, {states[at][4]}")
    return lines


if __name__ == "__main__":
    main()
