#!/usr/bin/env python3
"""Reference creep forces of many random contacts, from which corrections of FASTSTRIP are fitted.

`faststrip-lab force-data` makes files of 200 contacts each, several at a time. A file that is
there is not made again, so that a run that was ended goes on where it was; one that is being
written has another name.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile
import time

PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "bin" / "faststrip-lab"
SHARD = 200


def positive(text):
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError(f"a whole number from 1 on is needed, got {text}")
    return value


def shards(contacts, folder):
    """First contact, number of contacts and file of each shard; the last one may be shorter."""
    for first in range(1, contacts + 1, SHARD):
        count = min(SHARD, contacts + 1 - first)
        yield first, count, folder / f"contacts_{first:06d}_{first + count - 1:06d}.csv"


def tell(text):
    print(f"force-data: {text}", file=sys.stderr, flush=True)


def make(wanted, jobs, options):
    """Make shards, so many at a time; the exit code of the first that fails, else 0."""
    waiting = list(wanted)
    total, made = sum(count for _, count, _ in waiting), 0
    running = {}
    begin = time.monotonic()
    try:
        while waiting or running:
            while waiting and len(running) < jobs:
                first, count, path = waiting.pop(0)
                words = [PROGRAM, "force-data", "--first", first, "--cases", count, "-o", path,
                         *options]
                said = tempfile.TemporaryFile()
                running[subprocess.Popen([str(word) for word in words], stderr=said)] = count, said
            for process in [one for one in running if one.poll() is not None]:
                count, said = running.pop(process)
                if process.returncode != 0:
                    said.seek(0)
                    print(said.read().decode(errors="replace"), end="", file=sys.stderr)
                    return process.returncode
                made += count
                rate = made / (time.monotonic() - begin)
                tell(f"{made} of {total} contacts, {rate:.1f} a second, {(total - made) / rate:.0f}"
                     " s left")
            time.sleep(0.05)
    finally:
        for process in running:
            process.kill()
            process.wait()
    return 0


def main():
    parser = argparse.ArgumentParser(prog="force_data.py", description=__doc__)
    parser.add_argument("contacts", type=positive, nargs="?", default=2000)
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("out/force_data"))
    parser.add_argument("--jobs", type=positive, default=2)
    parser.add_argument("--seed", default="1")
    parser.add_argument("--family",
                        help="contacts of one family (default: of all but the last two)")
    parser.add_argument("--across", help="elements across a patch")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    every = list(shards(arguments.contacts, arguments.folder))
    wanted = [shard for shard in every if not shard[2].exists()]
    tell(f"{len(every) - len(wanted)} of {len(every)} files are there")
    options = ["--seed", arguments.seed]
    if arguments.family:
        options += ["--family", arguments.family]
    if arguments.across:
        options += ["--across", arguments.across]
    code = make(wanted, arguments.jobs, options)
    if code == 0:
        tell(f"done: {arguments.contacts} contacts in {arguments.folder}")
    return code


if __name__ == "__main__":
    sys.exit(main())
