#!/usr/bin/env python3
"""Build the site of faststrip into out/docs: the pages by Sphinx, and the Fortran interface by FORD
in api/.

    document.py

Pages with pictures are run, as tools/docs/blocks.py does. Nothing of the site is loaded from
elsewhere: it reads, and is searched, without network. A warning is an error, and so is a link that
leads nowhere.
"""

import argparse
import collections
import html
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import blocks
import interfaces
from pages import FILE, PICTURE, links, pictures, strange_formulas

ROOT = pathlib.Path(__file__).resolve().parents[2]
SITE = ROOT / "out" / "docs"
# Pages of the interfaces, which are made here.
MADE = (
    ("Python", "python.rst"),
    ("C", "c.rst"),
    ("Fortran", "fortran.md"),
    ("Fortran 77", "fortran77.md"))
# The navigation: groups of pages, what they are called there, file.
GROUPS = (
    ("Getting started", (
        ("faststrip", "README.md"),
        ("Start here", "docs/start.md"),
        ("Installation", "docs/install.md"),
        ("Choosing a method", "docs/choosing.md"))),
    ("Tutorials", (
        ("Worn wheel", "docs/tutorial_worn_wheel.md"),
        ("Wheelset in a curve", "docs/tutorial_curve.md"),
        ("Ground rail, hollow wheel", "docs/tutorial_ground_rail.md"),
        ("Braked locomotive", "docs/tutorial_braked_locomotive.md"),
        ("Roller rig", "docs/tutorial_roller_rig.md"),
        ("Conicity", "docs/tutorial_conicity.md"),
        ("Coefficient table for an old code", "docs/tutorial_table.md"),
        ("Vehicle model", "docs/tutorial_vehicle.md"),
        ("Fortran 77 code", "docs/tutorial_fortran77.md"),
        ("Accuracy", "docs/tutorial_accuracy.md"))),
    ("User guide", (
        ("Usage", "docs/usage.md"),
        ("Formats", "docs/formats.md"),
        ("Limitations and errors", "docs/errors.md"),
        ("From FASTSIM or CONTACT", "docs/migration.md"),
        ("Embedding", "docs/embedding.md"),
        ("Common mistakes", "docs/traps.md"))),
    ("Interfaces", MADE),
    ("Theory and development", (
        ("Method", "docs/method.md"),
        ("Validation", "docs/validation.md"),
        ("Constants", "docs/constants.md"),
        ("Parity with other codes", "docs/parity.md"),
        ("Paper", "docs/paper.md"),
        ("Architecture", "docs/architecture.md"),
        ("Extending", "docs/extending.md"),
        ("Reference data", "reference/README.md"))),
    ("Project", (
        ("Contributing", "CONTRIBUTING.md"),
        ("Changes", "CHANGELOG.md"))),
)
PAGES = tuple(page for _, pages in GROUPS for page in pages if page not in MADE)
# What stands before a paper, whose sections are headings of the first level.
FRONT = re.compile(r"---\n.*?^title: '(?P<title>[^']*)'$.*?^---\n", re.MULTILINE | re.DOTALL)
# What an error is known by: the first words of its entry.
SYMPTOMS = re.compile(r"^### (\w+)\n\n\*Symptoms: (.*?)\.\*\n", re.MULTILINE | re.DOTALL)
NOT_READ = re.compile(r"<(script|style|math)\b.*?</\1>|<[^>]+>", re.DOTALL)
ELSEWHERE = re.compile(r"(?:[a-z]+:)?//|(?:mailto|data):")
# A length that is asked with several arguments.
LENGTH = re.compile(r"\b(character\(len=)(\w+)\([^()]*,[^()]*\)\)", re.IGNORECASE)
# What FORD's pages load from a network: a style sheet, in whose place is docs/api.css, and scripts.
LOADED = re.compile(r'<link [^>]*href="https?://[^>]*>|<script[^>]*src="https?://[^>]*>\s*</script>'
                    r'|<script type="text/x-mathjax-config">.*?</script>', re.DOTALL)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.parse_args()
    shutil.rmtree(SITE, ignore_errors=True)
    build_api()
    with tempfile.TemporaryDirectory() as folder:
        gather(pathlib.Path(folder))
        build_pages(folder)
    write_words()
    broken = sorted(broken_targets())
    if broken:
        sys.exit("\n".join(broken))


def readable(text):
    """A source as FORD can read it, which takes a comma in a length for its end."""
    return LENGTH.sub(r"\1\2)", text)


def build_api(sources=ROOT / "src", page=ROOT / "docs" / "ford.md"):
    """FORD's pages of the sources in a folder, made independent of the network."""
    ford = pathlib.Path(sys.executable).parent / "ford"
    with tempfile.TemporaryDirectory() as folder:
        for path in sources.rglob("*.f90"):
            if "build" not in path.relative_to(sources).parts:
                copy = pathlib.Path(folder, "src", path.relative_to(sources))
                copy.parent.mkdir(parents=True, exist_ok=True)
                copy.write_text(readable(path.read_text(encoding="utf-8")), encoding="utf-8")
        done = subprocess.run([str(ford), "--src_dir", f"{folder}/src", "--output_dir",
                               str(SITE / "api"), str(page)], cwd=ROOT,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8",
                              check=False)
    warnings = [line for line in done.stdout.splitlines() if "warning" in line.lower()]
    if done.returncode != 0 or warnings or not (SITE / "api" / "index.html").is_file():
        sys.exit("\n".join(warnings) or done.stdout)
    shutil.copy(ROOT / "docs" / "api.css", SITE / "api" / "css" / "api.css")
    for path in sorted((SITE / "api").rglob("*.html")):
        up = "../" * (len(path.relative_to(SITE / "api").parts) - 1) or "./"
        text = LOADED.sub("", path.read_text(encoding="utf-8"))
        style = f'<link href="{up}css/api.css" rel="stylesheet">\n  </head>'
        text = text.replace("</head>", style, 1)
        # The name at the top leads back to the other pages.
        path.write_text(re.sub(r'(class="navbar-brand" href=)"[^"]*"', rf'\1"{up}../index.html"',
                               text), encoding="utf-8")


def gather(folder):
    """The pages as Sphinx reads them, what they point to, and the pictures they make."""
    shutil.copytree(ROOT / "tools" / "docs" / "site", folder, dirs_exist_ok=True)
    for _, source in PAGES:
        path = ROOT / source
        text = path.read_text(encoding="utf-8")
        strange = strange_formulas(text)
        if strange:
            sys.exit(f"document: a formula that cannot be shown: {strange[0]} ({source})")
        for link in links(text):
            file = (path.parent / link.partition("#")[0]).resolve()
            if ELSEWHERE.match(link) or file.suffix == ".md" or not file.is_file():
                continue
            copy(file, folder / file.relative_to(ROOT.resolve()))
        make_pictures(text, folder)
        copy_text(for_sphinx(text, source), folder / source)
    for source, text in interfaces.pages(SITE / "api").items():
        copy_text(text, folder / source)


def copy(file, target):
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copy(file, target)


def copy_text(text, target):
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text(text, encoding="utf-8")


def make_pictures(text, folder):
    """Run a page that has pictures."""
    if not pictures(text):
        return
    with tempfile.TemporaryDirectory() as ran:
        blocks.run(text, ran)
        for file, _ in pictures(text):
            copy(pathlib.Path(ran, "checkout", file), folder / file)


def for_sphinx(text, source):
    """A page with its pictures and names of files in sight; the first has the navigation."""
    def figure(match):
        words = " ".join(match["words"].split())
        return f"```{{figure}} /{match['file']}\n:alt: {words}\n\n{words}\n```"

    text = PICTURE.sub(figure, text)
    text = FILE.sub(r"`\g<name>`:\n", text)
    if front := FRONT.match(text):
        text = f"# {front['title']}\n" + re.sub("^#", "##", text[front.end():], flags=re.MULTILINE)
    if source != "README.md":
        return text
    for name, pages in GROUPS:
        entries = "\n".join(f"{words} <{file.rpartition('.')[0]}>" for words, file in pages
                            if file != source)
        text += f"\n```{{toctree}}\n:hidden:\n:caption: {name}\n\n{entries}\n```\n"
    return text


def build_pages(folder):
    """The pages by Sphinx; the first one is README.html."""
    done = subprocess.run([sys.executable, "-m", "sphinx", "-b", "html", "-q", "-W", "-j", "auto",
                           "-D", "root_doc=README", folder, str(SITE)], cwd=ROOT,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8",
                          env={**os.environ, "PYTHONPATH": str(ROOT / "python")}, check=False)
    if done.returncode != 0:
        sys.exit(done.stdout)
    shutil.rmtree(SITE / ".doctrees", ignore_errors=True)
    (SITE / "index.html").write_text(
        '<!DOCTYPE html><meta http-equiv="refresh" content="0; url=README.html">'
        '<a href="README.html">faststrip</a>\n', encoding="utf-8")


def words_of(texts):
    """The words of pages, the most frequent first."""
    count = collections.Counter()
    for text in texts:
        words = html.unescape(NOT_READ.sub(" ", text)).lower()
        count.update(re.findall(r"(?<!\w)[^\W\d]\w{3,}", words))
    return [word for word, _ in count.most_common()]


def symptoms_of(text):
    """Of each error of docs/errors.md what it is known by."""
    return {word: [" ".join(one.split()) for one in words.split(",")]
            for word, words in SYMPTOMS.findall(text)}


def write_words():
    """What the search knows beside Sphinx's index."""
    texts = [path.read_text(encoding="utf-8") for path in SITE.rglob("*.html")
             if "api" not in path.relative_to(SITE).parts]
    symptoms = symptoms_of((ROOT / "docs" / "errors.md").read_text(encoding="utf-8"))
    (SITE / "_static" / "words.js").write_text(
        f"const WORDS = {json.dumps(words_of(texts), ensure_ascii=False)};\n"
        f"const SYMPTOMS = {json.dumps(symptoms)};\n", encoding="utf-8")


def broken_targets():
    """What a page of the site loads or points to and is not there."""
    texts = {path.resolve(): path.read_text(encoding="utf-8") for path in SITE.rglob("*.html")}
    names = {path: set(re.findall(r'\bid="([^"]+)"', text)) for path, text in texts.items()}
    for path, text in texts.items():
        here = path.relative_to(SITE.resolve())
        for loaded in re.findall(r'<(?:script|link|img)[^>]*\b(?:src|href)="([^"]+)"', text):
            if ELSEWHERE.match(loaded):
                yield f"{here}: loaded from elsewhere: {loaded}"
        for target in re.findall(r'\b(?:src|href)="([^"]+)"', text):
            name, _, anchor = target.partition("#")
            if ELSEWHERE.match(target) or target.startswith("javascript"):
                continue
            file = (path.parent / name.partition("?")[0]).resolve() if name else path
            if not file.exists():
                yield f"{here}: leads nowhere: {target}"
            elif anchor and "api" not in here.parts and anchor not in names.get(file, {anchor}):
                yield f"{here}: no such anchor: {target}"


if __name__ == "__main__":
    main()
