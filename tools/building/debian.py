"""Debian's packages, for steps that can do with less: what there is, and installing it."""

import os
import re
import subprocess


def candidate(name):
    """The version that apt would install, or nothing."""
    said = _said("apt-cache", "policy", name)
    found = re.search(r"^ *Candidate: (?!\(none\))(\S+)", said, re.MULTILINE)
    return found[1] if found else ""


def newest(stem):
    """The package `stem-N` with the largest N that apt would install, or nothing."""
    numbers = re.findall(rf"^{stem}-(\d+) ", _said("apt-cache", "search", "--names-only",
                                                   rf"^{stem}-[0-9]+$"), re.MULTILINE)
    for number in sorted(map(int, numbers), reverse=True):
        if candidate(f"{stem}-{number}"):
            return f"{stem}-{number}"
    return ""


def install(name):
    """Install a package; why it is not there in one line, or nothing."""
    as_root = [] if os.geteuid() == 0 else ["sudo", "-n"]
    words = [*as_root, "env", "DEBIAN_FRONTEND=noninteractive", "apt-get", "install", "-y", name]
    if not candidate(name):
        return f"Debian offers no {name} here"
    try:
        done = subprocess.run(words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, encoding="utf-8", errors="replace",
                              check=False)
    except OSError as error:
        return f"{words[0]}: {error.strerror}"
    if done.returncode == 0:
        return ""
    lines = [line for line in done.stdout.splitlines() if line.startswith("E:")]
    return (lines or done.stdout.splitlines() or ["no word was said"])[0]


def _said(*words):
    try:
        return subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True,
                              encoding="utf-8", errors="replace", check=False).stdout
    except OSError:
        return ""
