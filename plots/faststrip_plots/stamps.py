"""The stamps of stored results: which revision of the program made them, and how long ago."""

from __future__ import annotations

import re
import subprocess
from dataclasses import dataclass
from pathlib import Path

from .tables import InputError, read_table

_STAMP = re.compile(r"faststrip \S+ rev ([\w-]+)")


@dataclass(frozen=True)
class Stamp:
    """What a file says of its making."""

    text: str  # `faststrip VERSION rev REVISION`, or why there is none
    revision: str | None


def stamp_of(path) -> Stamp:
    """The stamp of a CSV file, in its first lines, or of a picture, in its description."""
    try:
        with open(path, "rb") as stream:
            head = stream.read(65536)
    except OSError:
        return Stamp("no such file", None)
    if not head.startswith(b"\x89PNG"):
        head = b"\n".join(line for line in head.splitlines() if line.startswith(b"#"))
    found = {match.group(1): match.group() for match in
             _STAMP.finditer(head.decode("utf-8", errors="replace"))}
    if len(found) != 1:
        return Stamp("no stamp" if not found else "stamps of several revisions", None)
    (revision, text), = found.items()
    return Stamp(text, revision)


class History:
    """The history of a checkout, where there is git and where it is whole."""

    def __init__(self, root):
        self.root = Path(root)
        # a folder inside somebody else's repository has no history of its own
        self.known = (self.root / ".git").exists() and self._git("rev-parse", "HEAD") is not None
        self.whole = self.known and self._git("rev-parse", "--is-shallow-repository") == "false"

    def _git(self, *words):
        try:
            done = subprocess.run(["git", "-C", str(self.root), *words], capture_output=True,
                                  encoding="utf-8", check=False)
        except OSError:
            return None
        return done.stdout.rstrip() if done.returncode == 0 else None

    def changes(self) -> list[str]:
        """What is not committed."""
        return [line[3:] for line in (self._git("status", "--porcelain") or "").splitlines()]

    def is_head(self, revision) -> bool:
        """Is a revision, however short, the present one?"""
        head = self._git("rev-parse", "HEAD") or ""
        return len(revision) >= 7 and head.startswith(revision)

    def holds(self, revision) -> bool | None:
        """Is a revision among those that led here? None where that cannot be known."""
        if self.known and self._git("merge-base", "--is-ancestor", revision, "HEAD") is not None:
            return True
        return False if self.whole else None

    def age(self, stamp) -> str:
        """Revision, date and commits since, as far as they can be known."""
        if stamp.revision is None or not self.known or not self.holds(stamp.revision):
            return stamp.text
        date = self._git("log", "-1", "--format=%cs", stamp.revision)
        count = self._git("rev-list", "--count", f"{stamp.revision}..HEAD")
        return f"{stamp.text}, {date}, {count} commits ago"


def trouble_with(stamp, history) -> str:
    """Why a stamp is not that of a clean revision in the history; empty if it is."""
    if stamp.revision is None:
        return stamp.text
    if not re.fullmatch("[0-9a-f]{7,40}", stamp.revision):
        return f"not a clean revision: {stamp.revision}"
    if history.holds(stamp.revision) is False:
        return f"not in the history: {stamp.revision}"
    return ""


def stored_files(path) -> list[str]:
    """The files that carry a stamp in a list of stored results."""
    table = read_table(path, ("name", "stamped", "files", "command"))
    files = list(dict.fromkeys(" ".join(table.words("stamped")).split()))
    if not files:
        raise InputError(f"no stored result: {path}")
    return files
