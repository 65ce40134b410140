#!/usr/bin/env python3
"""Make the stored results anew: files of the repository that the program itself has made.

    stored.py --list         which command makes which file, and what each file's stamp says
    stored.py --check        exit 1 if a stamp is not that of a clean revision in the history
    stored.py [NAME...]      make them anew, all or those named (`./run stored`)

They are listed in reference/stored.csv, in the order in which they are made: the later ones rest
on the earlier. A stored result carries the revision of the program that made it, so that everything
has to be committed before; the new files are committed after.
"""

from __future__ import annotations

import argparse
import csv
import os
import shlex
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "plots"))

from faststrip_plots.stamps import History, stamp_of, stored_files, trouble_with  # noqa: E402

LIST = ROOT / "reference" / "stored.csv"


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help="which to make; all by default")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    with open(LIST, encoding="utf-8") as stream:
        rows = list(csv.DictReader(line for line in stream if not line.startswith("#")))
    known = list(dict.fromkeys(row["name"] for row in rows))
    for name in options.names:
        if name not in known:
            sys.exit(f"stored: no such result: {name} (one of {', '.join(known)})")
    history = History(ROOT)
    if options.list:
        for row in rows:
            print(f"{row['name']}: {row['command']}")
            for file in row["files"].split():
                age = history.age(stamp_of(ROOT / file)) if file in row["stamped"].split() else ""
                print(f"    {file} {age}".rstrip())
        return
    if options.check:
        check(history)
        return
    refuse_if_not_clean(history)
    environment = os.environ | {"OPENBLAS_NUM_THREADS": "1", "MPLBACKEND": "Agg"}
    (ROOT / "out" / "stored").mkdir(parents=True, exist_ok=True)
    for row in rows:
        if options.names and row["name"] not in options.names:
            continue
        print(f"{row['name']}: {row['command']}", flush=True)
        words = shlex.split(row["command"])
        if words[0] == "python":
            words[0] = sys.executable
        done = subprocess.run(words, cwd=ROOT, env=environment, check=False)
        if done.returncode != 0:
            sys.exit(f"stored: exit code {done.returncode} of: {row['command']}")
    check(history)


def check(history):
    """Exit 1 unless every stored file has a stamp that is good."""
    bad = [f"{file}: {trouble}" for file in stored_files(LIST)
           if (trouble := trouble_with(stamp_of(ROOT / file), history))]
    for line in bad:
        print(f"stored: {line}", file=sys.stderr)
    if bad:
        sys.exit(1)


def refuse_if_not_clean(history):
    """Only a clean revision leaves a stamp that anyone can go back to."""
    if not history.known:
        sys.exit("stored: a stored result carries a revision, and there is no git history here")
    if history.changes():
        sys.exit("stored: commit everything first, a stored result carries a clean revision;"
                 f" changed: {history.changes()[0]}")
    said = subprocess.run([str(ROOT / "bin" / "faststrip"), "--version"], capture_output=True,
                          encoding="utf-8", check=False).stdout.strip()
    if not history.is_head(said.rpartition(" ")[2]):
        sys.exit(f"stored: the program is not built from this revision, ./run stored does: {said}")


if __name__ == "__main__":
    main()
