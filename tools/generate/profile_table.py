#!/usr/bin/env python3
"""What happens to contacts of a folder of profiles: S1002 on every rail, every wheel on 60E1.

    profile_table.py FOLDER -o FILE.csv [--load N] [--yield-MPa P]

Eleven lateral shifts each, by strips and FASTSTRIP. A row a contact: patches, maximum pressure,
status, and what it says. Files that need to be told something have it in TOLD. Where the folder is
not there, nothing is made: profiles of others are no part of the project.
"""

import argparse
import csv
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "bin" / "faststrip"
SHIFTS = range(-5, 6)

# Names in &wheel or &rail that a file needs.
TOLD = {
    "MBench_UIC60_v3.ban": ["z_positive_to = 'down'"],
    "left-roller-v1-pre-dry.ban": ["z_positive_to = 'down', gauge_depth_mm = 5.0"],
    "meas_roller.prr": ["gauge_depth_mm = 0.7"],
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
    """Patches, maximum pressure, status and message of one contact, and the program's stamp."""
    (folder / "case.nml").write_text(CASE.format(load=load, wheel=wheel, rail=rail, shift=shift),
                                     encoding="utf-8")
    done = subprocess.run([PROGRAM, "contact", "case.nml", *options], cwd=folder, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8")
    # One line is about the contact, others, which begin with their path, are about the files.
    said = [line.partition(": ")[2] for line in done.stderr.splitlines()]
    words = " ".join(line for line in said if not line.startswith("/"))
    lines = done.stdout.splitlines()
    if done.returncode != 0:
        return ["", "", "failed", words.removesuffix(" (case.nml)")], []
    row = next(csv.DictReader(line for line in lines if not line.startswith("#")))
    pressure = f"{float(row['pmax_MPa']):.1f}"
    return ([row["n_patches"], pressure, row["status"], words if row["status"] != "ok" else ""],
            [line for line in lines if line.startswith(("# faststrip ", "# compiler "))])


def pairs(bank):
    """Names, and what stands in the case, of wheels and rails."""
    for path in sorted(bank.iterdir()):
        for told in TOLD.get(path.name, [""]):
            text = f"'{path}'" + (", " + told if told else "")
            name = f"{path.name} {told}".strip()
            if path.suffix in (".prr", ".ban", ".mpt"):
                yield "s1002", name, "'s1002'", text + ", inclination = 0"
            elif path.suffix in (".prw", ".whl"):
                yield name, "60e1", text, "'60e1', inclination = 0.025"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bank", type=pathlib.Path, metavar="FOLDER")
    parser.add_argument("-o", type=pathlib.Path, required=True, metavar="FILE.csv")
    parser.add_argument("--load", type=float, default=80000.0)
    parser.add_argument("--yield-MPa", dest="limit")
    arguments = parser.parse_args()
    if not arguments.bank.is_dir():
        print(f"profile_table: no folder {arguments.bank}: {arguments.o} stays as it is")
        return
    options = ["--yield-MPa", arguments.limit] if arguments.limit else []
    rows, stamp = [], []
    with tempfile.TemporaryDirectory() as folder:
        for wheel, rail, wheel_text, rail_text in pairs(arguments.bank.resolve()):
            for shift in SHIFTS:
                figures, made_by = solved(pathlib.Path(folder), arguments.load, wheel_text,
                                          rail_text, shift, options)
                rows.append([wheel, rail, shift, *figures])
                stamp = stamp or made_by
    with arguments.o.open("w", encoding="utf-8") as out:
        out.writelines(line + "\n" for line in stamp)
        out.write(f"# {arguments.load:g} N vertical, mu 0.3, creepages by formula, strips and "
                  "FASTSTRIP\n")
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows(rows)


if __name__ == "__main__":
    sys.exit(main())
