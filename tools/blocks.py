#!/usr/bin/env python3
"""Run what the pages show: commands, programs and case files, and compare their output.

    blocks.py [--write] [--prefix FOLDER] [PAGE...]

PAGE is README.md, CONTRIBUTING.md or one of docs/ (default: all). With --write what a page shows
as output is made anew where it differs. --prefix is where faststrip is installed, for pages that
call the library.

The blocks of a page run in their order, in one shell and one folder, in which bin, example, plots
and the like are those of the checkout and ./run knows `install` alone. What a block is says its
fence, and a comment in front of it:

    ```sh       commands, each of which must succeed
    ```python   a program, run by .venv/bin/python
    ```output   what the block before it prints, stdout and stderr together

    <!-- file: NAME -->          the block is a file, which a later block has to name
    <!-- exit: CODE -->          its last command ends with this exit code
    <!-- output not shown: WHY -->
    <!-- not run: WHY -->        neither run nor looked at

Whatever else a page fences is an error. Output agrees if its words do, line by line: a number with
a point or an exponent within one unit of the last digit shown, or a millionth; other numbers
exactly. A number before s, ms, us or MB is a measurement and agrees with any other. A word `...`
stands for any word, a line `...` for any lines, also for none. `<!-- picture: FILE Words. -->`
names a picture that the blocks make, which the site shows in its place.
"""

from __future__ import annotations

import argparse
import dataclasses
import decimal
import itertools
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from pages import pictures

ROOT = pathlib.Path(__file__).resolve().parents[1]
SHARED = (".venv", "app", "bin", "docs", "example", "include", "plots", "python", "reference",
          "src", "tools")
BLOCK = re.compile(r"(?P<notes>(?:^<!--(?:(?!-->).)*-->[ \t]*\n\n?)*)"
                   r"^(?P<mark>```+|~~~+)(?P<language>[^\n`]*)\n(?P<text>.*?)^(?P=mark)[ \t]*$",
                   re.MULTILINE | re.DOTALL)
NOTE = re.compile(r"<!-- (file|exit|not run|output not shown): (.*?) -->", re.DOTALL)
NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][-+]\d+)?")
WORDS = re.compile(r"[^\s,;:=()\[\]|'\"]+")
MEASURED = ("s", "ms", "us", "µs", "MB", "s.", "us.")
PROGRESS = re.compile(r"faststrip(?:-lab)?: .*, \d+ s")
NEAR = decimal.Decimal("1e-6")
PATIENCE = 1200  # s, for a page

# What `./run install --prefix FOLDER` is in a page's folder.
RUN = """\
#!/bin/sh
[ "$#" -eq 3 ] && [ "$1" = install ] && [ "$2" = --prefix ] || exit 2
ln -s "$FASTSTRIP_INSTALLED" "$3"
"""


@dataclasses.dataclass
class Block:
    """A fenced block of a page."""

    line: int
    language: str
    text: str
    notes: dict
    span: tuple  # where its text stands in the page

    def runs(self):
        return "not run" not in self.notes and "file" not in self.notes


def blocks_of(text):
    """All fenced blocks of a page, in their order."""
    return [Block(text.count("\n", 0, match.start("mark")) + 1, match["language"].strip(),
                  match["text"], dict(NOTE.findall(match["notes"])), match.span("text"))
            for match in BLOCK.finditer(text)]


def outputs(blocks):
    """Pairs of a block that runs and the block of what it prints, or None."""
    return [(block, after if after is not None and after.language == "output" else None)
            for block, after in itertools.pairwise([*blocks, None])
            if block.runs() and block.language != "output"]


def problems(text):
    """What of a page cannot be run and does not say why, in words."""
    blocks = blocks_of(text)
    found = []
    fences = len(re.findall(r"^[ \t]*(?:```+|~~~+)", text, re.MULTILINE))
    if fences != 2 * len(blocks):
        found.append("a fence that is indented, or not closed")
    before = None
    for k, block in enumerate(blocks):
        place = f"line {block.line}"
        if "file" in block.notes:
            if not any(block.notes["file"] in later.text for later in blocks[k + 1:]
                       if later.runs()):
                found.append(f"{place}: no later block names {block.notes['file']}")
        elif "not run" in block.notes:
            if len(block.notes["not run"].split()) < 2:
                found.append(f"{place}: not run, and no reason")
        elif block.language == "output":
            if before is None or not before.runs() or before.language == "output":
                found.append(f"{place}: output of nothing that runs")
        elif block.language not in ("sh", "python"):
            found.append(f"{place}: neither run nor a file: ```{block.language}")
        before = block
    return found


def needs_library(text):
    """Do blocks of a page need an installed library?"""
    return any(block.runs() and (block.language == "python" or "./run install" in block.text)
               for block in blocks_of(text))


def run(text, folder, prefix=None):
    """Run a page's blocks in a folder; what each printed, in the order of `outputs`.

    RuntimeError tells the first block that ends otherwise than it should.
    """
    folder = pathlib.Path(folder)
    kept = folder / ".blocks"
    kept.mkdir()
    for name in SHARED:
        (folder / name).symlink_to(ROOT / name)
    for name in ("out", "home"):
        (folder / name).mkdir()
    (folder / "run").write_text(RUN, encoding="utf-8")
    (folder / "run").chmod(0o755)
    blocks = blocks_of(text)
    (kept / "script").write_text(script(blocks, kept), encoding="utf-8")
    with open(kept / "said", "w", encoding="utf-8") as said:
        code = subprocess.run(["sh", kept / "script"], cwd=folder, env=environment(folder, prefix),
                              stdin=subprocess.DEVNULL, stdout=said, stderr=said, check=False,
                              timeout=PATIENCE).returncode
    printed = []
    for k, block in enumerate(blocks):
        if not block.runs() or block.language == "output":
            continue
        ended, wanted = kept / f"{k}.exit", block.notes.get("exit", "0")
        got = ended.read_text(encoding="utf-8").strip() if ended.exists() else str(code)
        out = kept / f"{k}.out"
        words = out.read_text(encoding="utf-8") if out.exists() else ""
        if got != wanted or not ended.exists():
            raise RuntimeError(f"line {block.line}: exit code {got}, not {wanted}\n{block.text}"
                               f"{words}{(kept / 'said').read_text(encoding='utf-8')}")
        printed.append("".join(line for line in words.splitlines(keepends=True)
                               if not PROGRESS.fullmatch(line.rstrip("\n"))))
    return printed


def script(blocks, kept):
    """The shell script of a page."""
    lines = ["set -eu"]
    for k, block in enumerate(blocks):
        stored = kept / str(k)
        text = block.text
        if "file" in block.notes:
            stored.write_text(text, encoding="utf-8")
            lines.append(f"cp '{stored}' '{block.notes['file']}'")
        if not block.runs() or block.language == "output":
            continue
        if block.language == "python":
            stored.write_text(text, encoding="utf-8")
            text = f".venv/bin/python '{stored}'\n"
        redirection = f">'{stored}.out' 2>&1 </dev/null"
        if "exit" in block.notes:
            lines += ["set +e", f"( set -e\n{text}) {redirection}", f"echo $? >'{stored}.exit'",
                      "set -e"]
        else:
            lines += [f"{{\n{text}}} {redirection}", f"echo 0 >'{stored}.exit'"]
    return "\n".join(lines) + "\n"


def environment(folder, prefix):
    """What commands of a page see of the machine."""
    home = os.environ.get("HOME", "/")
    return {
        **{name: os.environ[name] for name in ("TMPDIR",) if name in os.environ},
        "PATH": f"{ROOT / 'bin'}{os.pathsep}{os.environ['PATH']}",
        "HOME": str(folder / "home"),
        "XDG_CACHE_HOME": os.environ.get("XDG_CACHE_HOME", f"{home}/.cache"),
        "XDG_CONFIG_HOME": os.environ.get("XDG_CONFIG_HOME", f"{home}/.config"),
        "LC_ALL": "C.UTF-8",
        "MPLBACKEND": "Agg",
        "OPENBLAS_NUM_THREADS": "1",
        "PYTHONDONTWRITEBYTECODE": "1",
        **({"FASTSTRIP_INSTALLED": str(prefix), "FASTSTRIP_PREFIX": str(prefix),
            "PYTHONPATH": str(ROOT / "python")} if prefix else {}),
    }


def agree(shown, printed):
    """Is what a page shows what was printed?"""
    shown = [line.split() and line for line in shown.rstrip("\n").split("\n")]
    printed = [line.split() and line for line in printed.rstrip("\n").split("\n")]

    def match(i, j):
        while i < len(shown):
            if str(shown[i]).strip() == "...":
                return any(match(i + 1, k) for k in range(j, len(printed) + 1))
            if j == len(printed) or not lines_agree(shown[i] or "", printed[j] or ""):
                return False
            i, j = i + 1, j + 1
        return j == len(printed)

    return match(0, 0)


def lines_agree(shown, printed):
    # What stands between the words, but for how many blanks, has to be the same.
    between = [" ".join(text.split()) for text in (WORDS.sub("", shown), WORDS.sub("", printed))]
    shown, printed = WORDS.findall(shown), WORDS.findall(printed)
    return between[0] == between[1] and len(shown) == len(printed) and all(
        words_agree(a, b, after) for a, b, after in zip(shown, printed, [*shown[1:], ""]))


def words_agree(shown, printed, after):
    if shown in ("...", printed):
        return True
    if shown.endswith("%") and printed.endswith("%"):
        shown, printed = shown[:-1], printed[:-1]
    if not NUMBER.fullmatch(shown) or not NUMBER.fullmatch(printed):
        return False
    if after in MEASURED:
        return True
    if re.fullmatch(r"[-+]?\d+", shown):
        return False
    a, b = (decimal.Decimal(re.sub("[dD]", "e", word)) for word in (shown, printed))
    last = decimal.Decimal((0, (1,), a.as_tuple().exponent))
    return abs(a - b) <= max(last, NEAR * abs(a))


def differences(text, printed):
    """What blocks printed and a page does not show so: block, block of its output, words."""
    return [(block, output, words) for (block, output), words in zip(outputs(blocks_of(text)),
                                                                     printed, strict=True)
            if "output not shown" not in block.notes
            and not agree(output.text if output else "", words)]


def told(found):
    """Differences in words."""
    return "\n".join(f"line {block.line}: printed is\n{words}"
                     + (f"shown is\n{output.text}" if output else "and nothing of it is shown")
                     for block, output, words in found)


def rewritten(text, found):
    """A page with what was printed."""
    for block, output, words in sorted(found, key=lambda item: -item[0].line):
        words = "".join(line.rstrip() + "\n" for line in words.splitlines())
        if output:
            start, end = output.span
            text = text[:start] + words + text[end:]
        else:
            end = text.index("\n", block.span[1])
            text = f"{text[:end]}\n\n```output\n{words}```{text[end:]}"
    return text


def check(path, prefix=None, write=False):
    """What is wrong with a page, in words; with `write` its outputs are made anew instead."""
    text = path.read_text(encoding="utf-8")
    wrong = problems(text)
    if wrong:
        return "\n".join(wrong)
    with tempfile.TemporaryDirectory() as folder:
        try:
            found = differences(text, run(text, folder, prefix))
        except RuntimeError as problem:
            return str(problem)
        missing = [file for file, _ in pictures(text)
                   if not pathlib.Path(folder, file).is_file()]
    if found and write:
        path.write_text(rewritten(text, found), encoding="utf-8")
        found = []
    return "\n".join([told(found)] * bool(found) + [f"no such picture: {file}" for file in missing])


def pages():
    """All pages of the checkout."""
    return sorted([*ROOT.glob("*.md"), *ROOT.glob("docs/*.md"), ROOT / "reference" / "README.md"])


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--prefix", type=lambda text: pathlib.Path(text).resolve(),
                        metavar="FOLDER")
    parser.add_argument("pages", nargs="*", type=pathlib.Path, metavar="PAGE")
    options = parser.parse_args()
    bad = False
    for path in options.pages or pages():
        if needs_library(path.read_text(encoding="utf-8")) and not options.prefix:
            sys.exit(f"blocks: {path} needs --prefix FOLDER, where faststrip is installed")
        words = check(path, options.prefix, options.write)
        if words:
            bad = True
            print(f"{path}: {words}", flush=True)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
