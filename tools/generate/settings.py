#!/usr/bin/env python3
"""Write what a case file can set into docs/formats.md, or check that it is up to date.

    settings.py PROGRAM [--check]

The rows are those of `faststrip settings`, which prints its one table of settings: those of case
files, and of the states of a wheelset. With --check nothing is written; the exit code is 1 if
something would be.
"""

import argparse
import csv
import pathlib
import re
import subprocess
import sys

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs/formats.md"
# Where it says more than a list of words can.
MAY_BE = {"normal": "[a method](usage.md#methods)", "tangential": "[a method](usage.md#methods)",
          "inclination": "-1 to 1", "cant": "-1 to 1"}


def rows_of(program):
    done = subprocess.run([program, "settings"], stdout=subprocess.PIPE, encoding="utf-8",
                          check=True)
    return list(csv.DictReader(line for line in done.stdout.splitlines() if line[0] != "#"))


def code(text):
    return f"`{text}`" if text else ""


def what(row):
    """The meaning; what the columns beside it say of defaults and words is left out."""
    text = re.sub(r" \(default [^,)]*\)", "", row["what"])
    text = re.sub(r"(\(default) [^,)]*, ", "(", text)
    return text.replace(", one of the above", "").replace("|", "\\|")


def table(rows, group):
    lines = ["", f"`&{group}`" if " " not in group else
             " and ".join(f"`&{name}`" for name in group.split()) + ", for files of profiles", "",
             "| name | what | may be | default | option |", "|---|---|---|---|---|"]
    for row in rows:
        may_be = MAY_BE.get(row["name"], row["may_be"])
        lines.append(f"| `{row['name']}` | {what(row)} | {may_be} | {row['default']} "
                     f"| {code(row['option'])} |")
    return lines


def of_case_files(rows):
    groups = list(dict.fromkeys(row["group"] for row in rows if row["group"] != "state"))
    lines = []
    for group in groups:
        lines += table([row for row in rows if row["group"] == group], group)
    return lines[1:]


def of_states(rows):
    lines = ["| column | what |", "|---|---|", "| `case` | a name, carried through |"]
    for row in rows:
        if row["group"] == "state":
            nought = "; 0 if empty or not there" if row["default"] == "0" else ""
            lines.append(f"| `{row['name']}` | {row['what']}{nought} |")
    return lines


def written(text, mark, lines):
    """The page with the lines between its two marks."""
    begin = f"<!-- BEGIN {mark}, written by tools/generate/settings.py -->"
    end = f"<!-- END {mark} -->"
    before, rest = text.split(f"{begin}\n")
    return f"{before}{begin}\n" + "\n".join(lines) + f"\n{end}{rest.split(end, 1)[1]}"


def main(words):
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("program")
    parser.add_argument("--check", action="store_true", help="write nothing")
    given = parser.parse_args(words)
    rows = rows_of(given.program)
    old = PAGE.read_text(encoding="utf-8")
    new = written(written(old, "settings", of_case_files(rows)), "states", of_states(rows))
    if new == old:
        return 0
    if given.check:
        print(f"{PAGE.name} does not say what `faststrip settings` does: run"
              " tools/generate/settings.py")
        return 1
    PAGE.write_text(new, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
