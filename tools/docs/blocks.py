#!/usr/bin/env python3
"""Run what the pages show: commands, programs and case files, and compare their output.

    blocks.py [--write] [PAGE...]

PAGE is README.md, CONTRIBUTING.md or one of docs/ (default: all). With --write what a page shows
as output is made anew where it differs.

The blocks of a page run in their order, in one shell, in a folder that has what a fresh clone has
after `./run build`, and a shell that knows nothing of it: what a page needs besides it has to make
or say itself. What a block is says its fence, and a comment in front of it:

    ```sh       commands, each of which must succeed
    ```python   a program, run by .venv/bin/python
    ```output   what the block before it prints, stdout and stderr together

    <!-- file: NAME -->          the block is a file, which the words before it and a later block
                                 have to name
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

ROOT = pathlib.Path(__file__).resolve().parents[2]
# What later runs leave in a checkout, and a fresh one does not have; `./run` makes its own build/.
LEFT = ("out", "build")
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
            if block.notes["file"] not in words_before(text, block):
                found.append(f"{place}: the words before it do not name {block.notes['file']}")
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


def words_before(text, block):
    """What readers see before a block, without other blocks."""
    return re.sub(r"<!--.*?-->", "", BLOCK.sub("", text[:block.span[0]]), flags=re.DOTALL)


def installs(text):
    """Do blocks of a page install the library?"""
    return any(block.runs() and "./run install" in block.text for block in blocks_of(text))


def run(text, folder):
    """Run a page's blocks in a folder; what each printed, in the order of `outputs`.

    RuntimeError tells the first block that ends otherwise than it should.
    """
    checkout = pathlib.Path(folder, "checkout")
    kept = pathlib.Path(folder, "kept")
    for made in (checkout, kept, pathlib.Path(folder, "home")):
        made.mkdir()
    for path in ROOT.iterdir():
        if path.name not in LEFT:
            (checkout / path.name).symlink_to(path)
    blocks = blocks_of(text)
    (kept / "script").write_text(script(blocks, kept), encoding="utf-8")
    with open(kept / "said", "w", encoding="utf-8") as said:
        code = subprocess.run(["sh", kept / "script"], cwd=checkout, env=environment(folder),
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


def environment(folder):
    """The shell of a page: where programs of the machine are, and a home. Only time and this
    checkout have the rest: fonts are not looked for again, nothing is compiled beside sources."""
    home = os.environ.get("HOME", "/")
    return {
        "PATH": os.pathsep.join(path for path in os.environ["PATH"].split(os.pathsep)
                                if not pathlib.Path(path).resolve().is_relative_to(ROOT)),
        "HOME": str(pathlib.Path(folder, "home")),
        "XDG_CACHE_HOME": os.environ.get("XDG_CACHE_HOME", f"{home}/.cache"),
        "PYTHONDONTWRITEBYTECODE": "1",
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


def check(path, write=False):
    """What is wrong with a page, in words; with `write` its outputs are made anew instead."""
    text = path.read_text(encoding="utf-8")
    wrong = problems(text)
    if wrong:
        return "\n".join(wrong)
    with tempfile.TemporaryDirectory() as folder:
        try:
            found = differences(text, run(text, folder))
        except RuntimeError as problem:
            return str(problem)
        missing = [file for file, _ in pictures(text)
                   if not pathlib.Path(folder, "checkout", file).is_file()]
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
    parser.add_argument("pages", nargs="*", type=pathlib.Path, metavar="PAGE")
    options = parser.parse_args()
    bad = False
    for path in options.pages or pages():
        words = check(path, options.write)
        if words:
            bad = True
            print(f"{path}: {words}", flush=True)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
