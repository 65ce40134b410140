#!/usr/bin/env python3
"""Build the pages of the Fortran interface with FORD into out/docs; a warning is an error."""

import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]


def main():
    pages = ROOT / "out" / "docs"
    shutil.rmtree(pages, ignore_errors=True)
    ford = pathlib.Path(sys.executable).parent / "ford"
    done = subprocess.run([str(ford), str(ROOT / "docs" / "ford.md")], cwd=ROOT,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8",
                          check=False)
    warnings = [line for line in done.stdout.splitlines() if "warning" in line.lower()]
    if done.returncode != 0 or warnings or not (pages / "index.html").is_file():
        sys.exit("\n".join(warnings) or done.stdout)


if __name__ == "__main__":
    main()
