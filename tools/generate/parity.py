#!/usr/bin/env python3
"""Write docs/parity.md, what faststrip has, lacks or does otherwise than other codes, from
reference/parity.toml, or check that it is up to date.

    parity.py [--check]

A state without a source, a word that is none of the states, and evidence that does not exist are
errors: a test, as FILE::NAME, must be in its file. With --check nothing is written; the exit code
is 1 if something would be.
"""

import argparse
import pathlib
import re
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = "reference/parity.toml"
PAGE = "docs/parity.md"
STATES = ("has", "lacks", "differs")
STATE = re.compile(r"(?P<word>\w+)(?:: (?P<more>.*?))?(?: @ (?P<section>.*))?")
HEAD = """\
<!-- Written by tools/generate/parity.py from reference/parity.toml. -->
# Parity with other codes

What faststrip has, lacks or does otherwise than other codes for wheel/rail contact, as their public
documents have it.

- `has`, `lacks`
- `differs`: there is something for the same end; what, stands below the table
- `?`: unknown, the public documents that were found do not state it. Manuals of commercial programs
  are for their customers, so most of their cells say nothing about the programs.

CONTACT's user guide and the papers on KP and STRIPES are taken as complete: a feature that they do
not mention counts as `lacks`. KP and STRIPES are methods, not programs.

## Documents

- **faststrip**: this repository, MIT licence
"""


def read(data):
    """Codes and groups, or the first thing that is wrong."""
    codes, groups = data["codes"], data["group"]
    for group in groups:
        for feature in group["feature"]:
            name = feature["name"]
            for key in set(feature) - {"name", "evidence", "faststrip", *codes}:
                raise ValueError(f"{name}: no such code: {key}")
            for code in ("faststrip", *codes):
                word, _, section = state(feature, code)
                if word not in (*STATES, "?"):
                    raise ValueError(f"{name}: {code} must be one of {', '.join(STATES)}, got"
                                     f" {word}")
                if code != "faststrip" and word in ("has", "differs") and not section:
                    raise ValueError(f"{name}: {code} {word} it, and no section says so")
            if state(feature, "faststrip")[0] == "has" and not feature["evidence"]:
                raise ValueError(f"{name}: faststrip has it, and nothing shows it")
    return codes, groups


def state(feature, code):
    """The word of a code's cell, what is to be added, the section that has it."""
    match = STATE.fullmatch(feature.get(code, "?"))
    return match.group("word", "more", "section") if match else ("?", None, None)


def missing(groups, root):
    """Evidence that is not there: tests or files."""
    for group in groups:
        for feature in group["feature"]:
            for place in feature["evidence"]:
                file, _, test = place.partition("::")
                path = root / file
                text = path.read_text(encoding="utf-8") if path.is_file() else ""
                if not text or test and not re.search(rf"(?:def|subroutine) {test}\b", text):
                    yield f"{feature['name']}: no such test or file: {place}"


def shown(place):
    if "::" in place:
        return f"`{place}`"
    return f"[{place}](../{place})".replace("../docs/", "")


def details(feature, codes):
    """What a cell cannot hold: evidence, what differs, sections."""
    parts = []
    for code in ("faststrip", *codes):
        word, more, section = state(feature, code)
        said = "; ".join(filter(None, (more, section and f"*{section}*")))
        if said:
            name = codes[code]["name"] if code in codes else code
            parts.append((said, name if word != "lacks" else f"{name} lacks it"))
    # Codes of which the same is said stand together.
    lines = []
    for said in dict.fromkeys(said for said, _ in parts):
        lines.append(f"{', '.join(name for each, name in parts if each == said)}: {said}.")
    if feature["evidence"]:
        lines.append(f"Shown by {', '.join(map(shown, feature['evidence']))}.")
    return f"- **{feature['name']}.** {' '.join(lines)}" if lines else None


def page(codes, groups):
    lines = [HEAD.rstrip()]
    lines += [f"- **{code['name']}**: {code['document']}" for code in codes.values()]
    for group in groups:
        names = ["feature", "faststrip", *(code["name"] for code in codes.values())]
        lines += ["", f"## {group['name']}", "", f"| {' | '.join(names)} |",
                  f"|{' --- |' * len(names)}"]
        for feature in group["feature"]:
            cells = [state(feature, code)[0] for code in ("faststrip", *codes)]
            lines.append(f"| {' | '.join([feature['name'], *cells])} |")
        below = [details(feature, codes) for feature in group["feature"]]
        lines += ["", *filter(None, below)]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="write nothing, exit 1 if stale")
    parser.add_argument("--root", type=pathlib.Path, default=ROOT, help=argparse.SUPPRESS)
    options = parser.parse_args()
    try:
        with open(options.root / DATA, "rb") as file:
            codes, groups = read(tomllib.load(file))
    except (ValueError, KeyError) as error:
        sys.exit(f"parity: {DATA}: {error}")
    wrong = [f"parity: {line}" for line in missing(groups, options.root)]
    if wrong:
        sys.exit("\n".join(wrong))
    text, path = page(codes, groups), options.root / PAGE
    if path.exists() and path.read_text(encoding="utf-8") == text:
        return
    if options.check:
        sys.exit(f"parity: {PAGE} is not as {DATA} says, run tools/generate/parity.py")
    path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
