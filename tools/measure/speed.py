#!/usr/bin/env python3
"""Time everything in one run and set it beside FASTSIM and CONTACT: `./run speed`.

    speed.py [--quick] [-o FILE]    measure; the table on stdout, the same as CSV in FILE,
                                    its picture beside it (FILE's name with .png)
    speed.py --read FILE            print the table of such a file

Methods are those of reference/speed_methods.csv on the paper's 20 contacts, then steps of a
history, influence coefficients, states of a wheelset, and rows of `batch`. Times are of the
processor. All is timed in several rounds, turn about; of each contact, step or state the least
counts, so that the tail (95th percentile, worst) is that of the contacts, not of the machine.
Columns `over_...` are ratios of one contact each, then their median, 95th percentile and worst: to
FASTSIM on 50 x 50 elements in the same run (on the same contact; where there is none, its median),
to `base`, and to the times of CONTACT that reference/contact holds: of another machine, and of KPEC
and ANALYN one evaluation at a known penetration."""

from __future__ import annotations

import argparse
import csv
import io
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "plots"))

from faststrip_plots.tables import InputError, read_table  # noqa: E402

METHODS = "reference/speed_methods.csv"
CONTACTS = "reference/contact"
FULL = "s1002_uic60_B.csv"
FAST = "s1002_uic60_fast_modes_B.csv"
YARDSTICK = ("tangential", "FASTSIM 50x50")
BATCH_SOLVE = ("both", "strips + FASTSTRIP 15x15")
SPREAD = ("median", "p95", "worst")
COLUMNS = ("group", "what", "cases", *(f"us_{word}" for word in SPREAD), "worst_case",
           *(f"over_fastsim_{word}" for word in SPREAD),
           "base", *(f"over_base_{word}" for word in SPREAD),
           "contact", "contact_us_median", *(f"over_contact_{word}" for word in SPREAD))
# Of CONTACT's tables: seconds of a stage, in the full solution and in the fast modes.
SECONDS = {"normal": ("cpu_norm_s", "cpu_norm_s"), "tangential": ("cpu_tang_s", "cpu_tang_s"),
           "both": ("cpu_total_s", "cpu_s")}
STEPS = {"load": "load 2.5 %", "shift": "place 0.1 mm", "both": "place 0.1 mm, load 5 %"}
COLD = "cold start, contacts and scenes"
GROUPS = {"normal": "normal", "tangential": "tangential", "both": "normal and tangential",
          "gap": "gap", "influence": "influence coefficient", "wheelset": "wheelset"}
COLD_START, FROM_BEFORE = "cold start", "from the state before"
GAP_READ, GAP_NEW = "row, gap read before", "row, new gap"
# So many rows are timed that they take this many times what a run of one row does, start and all.
OVER_START = 2.0
# Steel of the references: nu 0.28, G 82000 MPa.
BATCH_HEADER = "case,gap_file,E_MPa,nu,mu,N_N,cksi,ceta,cphi_rad_per_mm"
BATCH_MATERIAL = "209920,0.28,0.3"


def main(arguments=None):
    return measured_table(
        "speed", __doc__, "few methods, few contacts, one round: half a minute at most",
        lambda quick: speed_csv(*measure(quick)), lambda path: shown(read_speed(path)), arguments)


def measured_table(name, description, quick, measured, shown_of, arguments):
    """The options of `./run NAME`, and what it does: `measured(is_quick)` is the text of a CSV,
    `shown_of(path)` that as people read it; `plots/NAME.py` draws it."""
    parser = argparse.ArgumentParser(prog=f"./run {name}", description=description,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help=quick)
    parser.add_argument("-o", "--output", default=f"out/{name}.csv", metavar="FILE",
                        help=f"the CSV to write (default out/{name}.csv)")
    parser.add_argument("--no-picture", action="store_true", help="the CSV only")
    parser.add_argument("--read", metavar="FILE", help="print the table of such a file")
    options = parser.parse_args(arguments)
    if options.read:
        print(shown_of(options.read), end="")
        return 0
    output = Path(options.output)
    write(output, measured(options.quick))
    print(shown_of(output), end="")
    print(output)
    if not options.no_picture:
        picture = output.with_suffix(".png")
        command([sys.executable, str(ROOT / "plots" / f"{name}.py"), f"--{name}", str(output),
                 "-o", str(picture)])
        print(picture)
    return 0


# Measuring

def measure(quick):
    """Stamp lines and rows of the table."""
    rounds, own_rounds = (1, 2) if quick else (3, 2)
    methods, steps, batch, stamps = {}, {}, {}, []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for k in range(rounds):
            said = f"round {k + 1} of {rounds}"
            note(f"{said}: methods")
            lab("speed", folder / "speed.csv", "--rounds", own_rounds,
                *(["--quick"] if quick else []))
            table = read_table(str(folder / "speed.csv"), ("stage", "method", "case", "cpu_us"))
            stamps = table.comments + [f"processor {table.words('cpu')[0]}"]
            keep(methods, zip(table.words("stage"), table.words("method"), table.words("case")),
                 table.numbers("cpu_us", missing=True))
            note(f"{said}: steps of a history")
            lab("steps", folder / "steps.csv", "--rounds", 1 if quick else own_rounds)
            table = read_table(str(folder / "steps.csv"),
                               ("kind", "case", "step", "cpu_us", "cold_us"))
            keys = list(zip(table.words("kind"), table.words("case"), table.words("step")))
            keep(steps, ((*key, "warm") for key in keys), table.numbers("cpu_us"))
            keep(steps, ((*key, "cold") for key in keys), table.numbers("cold_us"))
            note(f"{said}: rows of batch")
            cases = list(dict.fromkeys(key[2] for key in methods if key[0] == "both"))
            keys, values = time_batch(folder, cases)
            keep(batch, keys, values)
    return stamps, method_rows(methods) + step_rows(methods, steps) + batch_rows(methods, batch)


def note(words):
    print(f"speed: {words}", file=sys.stderr, flush=True)


def command(words):
    """Run a command in silence; its processor seconds. One that fails is told in one line."""
    environment = os.environ | {"OPENBLAS_NUM_THREADS": "1", "MPLBACKEND": "Agg"}
    with tempfile.TemporaryFile() as said:
        try:
            process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=said,
                                       env=environment)
        except OSError as error:
            raise InputError(f"cannot run {words[0]}: {error.strerror}") from None
        _, state, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(state)
        if process.returncode != 0:
            said.seek(0)
            lines = said.read().decode("utf-8", errors="replace").strip().splitlines() or [""]
            raise InputError(f"exit code {process.returncode} of"
                             f" {' '.join([os.path.basename(words[0]), *words[1:3]])}: {lines[-1]}")
    return usage.ru_utime + usage.ru_stime


def lab(bench, output, *words):
    command([str(ROOT / "bin" / "faststrip-lab"), "bench", bench, *map(str, words),
             "-o", str(output)])


def keep(least, keys, values):
    """Of each key the least value so far; what is missing is no value."""
    for key, value in zip(keys, values, strict=True):
        if not math.isnan(value):
            least[key] = min(least.get(key, math.inf), value)


def time_batch(folder, cases):
    """A row's time by gap read before and new gap, us: many rows of a contact less one row. So
    many that the program's start, which differs from run to run, is but a small part of them."""
    table = read_table(str(ROOT / CONTACTS / FULL))
    figures = {f"shift_{word}": [table.words(name)[k] for name in
                                 ("Fn_N", "cksi", "ceta", "cphi_rad_per_mm")]
               for k, word in enumerate(table.words("yw_mm"))}
    keys, values = [], []
    for case in cases:
        gap = (ROOT / CONTACTS / "gaps" / f"{case}.csv").read_text(encoding="utf-8")
        single = time_rows(folder, [0], figures[case], gap)
        for name, is_new in ((GAP_READ, 0), (GAP_NEW, 1)):
            count, seconds = 8, 0.0
            while seconds <= OVER_START * single:
                count *= 2
                gaps = [is_new * k for k in range(count + 1)]
                seconds = time_rows(folder, gaps, figures[case], gap) - single
            keys.append((name, case))
            values.append(1e6 * seconds / count)
    return keys, values


def time_rows(folder, gaps, figures, gap):
    """Processor seconds of `batch` on rows whose files with these numbers hold a gap, the lesser
    of two runs. By one thread: what another does while it waits for rows is not theirs."""
    for number in set(gaps):
        (folder / f"gap_{number}.csv").write_text(gap, encoding="utf-8")
    rows = [f"{k},gap_{number}.csv,{BATCH_MATERIAL},{','.join(figures)}"
            for k, number in enumerate(gaps)]
    (folder / "batch.csv").write_text("\n".join([BATCH_HEADER, *rows]) + "\n", encoding="utf-8")
    words = [str(ROOT / "bin" / "faststrip"), "batch", str(folder / "batch.csv"), "-o",
             str(folder / "result.csv"), "--threads", "1"]
    return min(command(words), command(words))


# The rows

def spread(values):
    """Median, 95th percentile, worst; the percentile as the benches have it."""
    own = sorted(values)
    if not own:
        return (math.nan,) * 3
    n = len(own)
    return (0.5 * (own[(n + 1) // 2 - 1] + own[n // 2]), own[(95 * n + 99) // 100 - 1], own[-1])


def row(group, what, times, fastsim, base=("", {}), contact=("", {})):
    """A row of the table from the times of its cases, us; ratios are those of one case each."""
    middle = spread(fastsim.values())[0]
    worst = max(times, key=times.get)
    cells = {"group": group, "what": what, "cases": len(times), "base": base[0],
             "worst_case": worst if isinstance(worst, str) else f"{worst[0]}, step {worst[1]}",
             "contact": contact[0], "contact_us_median": spread(contact[1].values())[0]}
    ratios = {
        "us": times.values(),
        "over_fastsim": [us / fastsim.get(case if isinstance(case, str) else case[0], middle)
                         for case, us in times.items()],
        "over_base": [us / base[1][case] for case, us in times.items() if case in base[1]],
        "over_contact": [us / contact[1][case] for case, us in times.items()
                         if case in contact[1]],
    }
    for name, values in ratios.items():
        cells |= {f"{name}_{word}": value for word, value in zip(SPREAD, spread(values))}
    return cells


def yardstick(methods):
    """FASTSIM's times by contact, us."""
    return {case: us for (*key, case), us in methods.items() if tuple(key) == YARDSTICK}


def method_rows(methods):
    fastsim, peers = yardstick(methods), contact_times()
    wanted = read_table(str(ROOT / METHODS), ("stage", "method", "contact"))
    peer = dict(zip(zip(wanted.words("stage"), wanted.words("method")), wanted.words("contact")))
    found = []
    for stage, what in dict.fromkeys((stage, what) for stage, what, _ in methods):
        def times(name, stage=stage):
            return {case: us for (*key, case), us in methods.items() if key == [stage, name]}

        name = peer.get((stage, what), "")
        if name and not peers.get((stage, name)):
            raise InputError(f"no such times of CONTACT: {name}, {stage} ({METHODS})")
        base = ("", {})
        if (stage, what) == ("wheelset", FROM_BEFORE):
            base = (COLD_START, times(COLD_START))
        found.append(row(GROUPS[stage], what, times(what), fastsim, base,
                         (name, peers.get((stage, name), {}))))
    return found


def step_rows(methods, steps):
    fastsim, found = yardstick(methods), []
    for kind, what in STEPS.items():
        warm, cold = ({(case, step): us for (own, case, step, start), us in steps.items()
                       if (own, start) == (kind, wanted)} for wanted in ("warm", "cold"))
        found.append(row("warm step, 15 strips", what, warm, fastsim, ("cold", cold)))
    cold = {}
    for (kind, case, _, _), us in steps.items():
        if kind == "cold":
            keep(cold, [case if case.startswith("shift") else f"scene {case}"], [us])
    return found + [row("cold, 15 strips", COLD, cold, fastsim)]


def batch_rows(methods, batch):
    solve = {case: us for (*key, case), us in methods.items() if tuple(key) == BATCH_SOLVE}
    return [row("batch", name, {case: us for (own, case), us in batch.items() if own == name},
                yardstick(methods), (BATCH_SOLVE[1], solve)) for name in (GAP_READ, GAP_NEW)]


def contact_times():
    """CONTACT's recorded times by stage, mode with its grid, and contact, us."""
    found = {}
    full, fast = (read_table(str(ROOT / CONTACTS / name)) for name in (FULL, FAST))
    for stage, (of_full, of_fast) in SECONDS.items():
        for table, column in ((full, of_full), (fast, of_fast)):
            modes = table.words("method") if table is fast else ["full"] * len(table)
            for mode, dx, case, seconds in zip(modes, table.words("dx_mm"), table.words("yw_mm"),
                                               table.numbers(column)):
                own = found.setdefault((stage, f"{mode} {dx}"), {})
                # What its clock did not show is no time.
                if seconds > 0.0:
                    own[f"shift_{case}"] = 1e6 * seconds
    return found


# The table

def speed_csv(stamps, rows):
    """The text of the CSV."""
    stream = io.StringIO()
    for line in [*stamps, "processor time, us, written by ./run speed; over_fastsim: FASTSIM"
                 " 50x50 in the same run; over_contact:", "recorded on another machine, KPEC and"
                 " ANALYN without the search for the penetration"]:
        stream.write(f"# {line}\n")
    writer = csv.DictWriter(stream, COLUMNS, lineterminator="\n")
    writer.writeheader()
    for cells in rows:
        writer.writerow({name: cell if not isinstance(cell, float) else
                         "" if math.isnan(cell) else f"{cell:.6g}"
                         for name, cell in cells.items()})
    return stream.getvalue()


def write(path, text):
    """Write a file in one go: whole or as it was."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        rest = path.with_name(path.name + ".part")
        rest.write_text(text, encoding="utf-8")
        os.replace(rest, path)
    except OSError as error:
        raise InputError(f"cannot write {path}: {error.strerror}") from None


def read_speed(path):
    """The rows of such a file, cells as text."""
    table = read_table(str(path), COLUMNS)
    return [{name: table.words(name)[k] for name in COLUMNS} for k in range(len(table))]


def digits(text):
    """Two or three digits of a cell, a dash for an empty one."""
    if text == "":
        return "-"
    value = float(text)
    return f"{value:.0f}" if value >= 100.0 else f"{value:.3g}" if value >= 10.0 else f"{value:.2g}"


def shown(rows):
    """The table as a person reads it."""
    def triple(cells, name):
        values = [cells[f"{name}_{word}"] for word in SPREAD]
        return "" if values[0] == "" else " / ".join(digits(value) for value in values)

    lines = [["", "n", "us: median / 95 % / worst", "worst case", "over FASTSIM 50x50",
              "over base", "base", "over CONTACT, recorded", "its mode and grid in mm; median us"]]
    for cells in rows:
        lines.append([f"{cells['group']}: {cells['what']}", cells["cases"], triple(cells, "us"),
                      cells["worst_case"], triple(cells, "over_fastsim"),
                      triple(cells, "over_base"), cells["base"], triple(cells, "over_contact"),
                      f"{cells['contact']}; {digits(cells['contact_us_median'])}"
                      if cells["contact"] else ""])
    widths = [max(map(len, column)) for column in zip(*lines)]
    return "".join("  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip()
                   + "\n" for line in lines)


if __name__ == "__main__":
    try:
        sys.exit(main())
    except InputError as trouble:
        sys.exit(f"speed: {trouble}")
