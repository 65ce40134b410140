#!/usr/bin/env python3
"""What happens to contacts of a folder of profiles: S1002 on every rail, every wheel on 60E1.

    profile_table.py FOLDER -o FILE.csv [--load N] [--yield-MPa P]

Eleven lateral shifts each, by strips and FASTSTRIP. A row a contact: patches, largest pressure,
status, and what it says. Files that need to be told something have it in TOLD.
"""

import argparse
import csv
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
PROGRAM = ROOT / "bin" / "faststrip"
SHIFTS = range(-5, 6)

# Names in &wheel or &rail that a file needs.
TOLD = {
    "MBench_UIC60_v3.ban": ["z_positive_to = 'down'"],
    "left-roller-v1-pre-dry.ban": ["z_positive_to = 'down'"],
    "avg_low2.ban": ["any_count = .true."],
    "worn_high_mileage.prw": ["tape_circle_mm = 73.0"],
    "SNX00500.mpt": ["section = 1", "section = 2"],
}
CASE = """\
&contact name = 'profiles', load_N = {load}, load_direction = 'vertical', shift_mm = {shift} /
&wheel profile = {wheel} /
&rail profile = {rail} /
&material mu = 0.3 /
&motion creepage = 'formula' /
"""
COLUMNS = ["wheel", "rail", "shift_mm", "n_patches", "pmax_MPa", "status", "message"]


def solved(folder, load, wheel, rail, shift, options):
    """Patches, largest pressure, status and message of one contact."""
    (folder / "case.nml").write_text(CASE.format(load=load, wheel=wheel, rail=rail, shift=shift),
                                     encoding="utf-8")
    done = subprocess.run([PROGRAM, "contact", "case.nml", *options], cwd=folder, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8")
    said = [line for line in done.stderr.splitlines() if " points " not in line]
    words = said[-1].partition(": ")[2] if said else ""
    if done.returncode != 0:
        return ["", "", "failed", words]
    lines = [line for line in done.stdout.splitlines() if not line.startswith("#")]
    row = next(csv.DictReader(lines))
    pressure = f"{float(row['pmax_MPa']):.1f}"
    return [row["n_patches"], pressure, row["status"], words if row["status"] != "ok" else ""]


def pairs(bank):
    """Names, and what stands in the case, of wheels and rails."""
    for path in sorted(bank.iterdir()):
        for told in TOLD.get(path.name, [""]):
            text = f"'{path}'" + (", " + told if told else "")
            name = f"{path.name} {told}".strip()
            if path.suffix in (".prr", ".ban", ".mpt"):
                yield "s1002", name, "'s1002'", text
            elif path.suffix in (".prw", ".whl"):
                yield name, "60e1", text, "'60e1', cant = 0.025"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bank", type=pathlib.Path, metavar="FOLDER")
    parser.add_argument("-o", type=pathlib.Path, required=True, metavar="FILE.csv")
    parser.add_argument("--load", type=float, default=80000.0)
    parser.add_argument("--yield-MPa", dest="limit")
    arguments = parser.parse_args()
    options = ["--yield-MPa", arguments.limit] if arguments.limit else []
    with tempfile.TemporaryDirectory() as folder, arguments.o.open("w", encoding="utf-8") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(COLUMNS)
        for wheel, rail, wheel_text, rail_text in pairs(arguments.bank.resolve()):
            for shift in SHIFTS:
                figures = solved(pathlib.Path(folder), arguments.load, wheel_text, rail_text, shift,
                                 options)
                writer.writerow([wheel, rail, shift, *figures])


if __name__ == "__main__":
    sys.exit(main())
