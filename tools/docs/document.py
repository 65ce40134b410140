#!/usr/bin/env python3
"""Build the site of faststrip into out/docs: the pages, and the Fortran interface by FORD in api/.

    document.py

Pages with pictures are run, as tools/docs/blocks.py does. Nothing of the site is loaded from
elsewhere: it reads, and is searched, without network. A warning is an error, and so is a link that
leads nowhere.
"""

import argparse
import html
import importlib.resources
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import blocks
from pages import menu, page, pictures, plain, sections, to_html

ROOT = pathlib.Path(__file__).resolve().parents[2]
SITE = ROOT / "out" / "docs"
# The navigation: groups of pages, what they are called there, file, page.
GROUPS = (
    ("Begin", (
        ("faststrip", "README.md", "index.html"),
        ("Start here", "docs/start.md", "start.html"))),
    ("Tutorials", (
        ("A worn wheel", "docs/tutorial_worn_wheel.md", "tutorial_worn_wheel.html"),
        ("Through a curve", "docs/tutorial_curve.md", "tutorial_curve.html"),
        ("Conicity", "docs/tutorial_conicity.md", "tutorial_conicity.html"),
        ("A table for an old code", "docs/tutorial_table.md", "tutorial_table.html"),
        ("Into Fortran 77", "docs/tutorial_fortran77.md", "tutorial_fortran77.html"),
        ("How accurate is it", "docs/tutorial_accuracy.md", "tutorial_accuracy.html"))),
    ("Use", (
        ("Usage", "docs/usage.md", "usage.html"),
        ("Formats", "docs/formats.md", "formats.html"),
        ("Limitations and errors", "docs/errors.md", "errors.html"),
        ("From FASTSIM or CONTACT", "docs/migration.md", "migration.html"),
        ("Embedding", "docs/embedding.md", "embedding.html"))),
    ("Behind it", (
        ("Method", "docs/method.md", "method.html"),
        ("Validation", "docs/validation.md", "validation.html"),
        ("Constants", "docs/constants.md", "constants.html"),
        ("Architecture", "docs/architecture.md", "architecture.html"),
        ("Extending", "docs/extending.md", "extending.html"),
        ("References", "reference/README.md", "reference.html"))),
    ("Project", (
        ("Contributing", "CONTRIBUTING.md", "contributing.html"),
        ("Changes", "CHANGELOG.md", "changelog.html"))),
)
PAGES = tuple(page for _, pages in GROUPS for page in pages)
API = ("Fortran interface", "api/index.html")
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
    SITE.mkdir(parents=True)
    build_api()
    write_search([*build_pages(), *entities()])
    broken = sorted(broken_targets())
    if broken:
        sys.exit("\n".join(broken))


def readable(text):
    """A source as FORD can read it, which takes a comma in a length for its end."""
    return LENGTH.sub(r"\1\2)", text)


def build_api():
    """FORD's pages, made independent of the network."""
    ford = pathlib.Path(sys.executable).parent / "ford"
    with tempfile.TemporaryDirectory() as folder:
        for path in (ROOT / "src").rglob("*.f90"):
            if "build" not in path.relative_to(ROOT).parts:
                copy = pathlib.Path(folder, path.relative_to(ROOT))
                copy.parent.mkdir(parents=True, exist_ok=True)
                copy.write_text(readable(path.read_text(encoding="utf-8")), encoding="utf-8")
        done = subprocess.run([str(ford), "--src_dir", f"{folder}/src",
                               str(ROOT / "docs" / "ford.md")], cwd=ROOT,
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


def build_pages():
    """The Markdown files of PAGES; what else they point to is copied into files/. What the search
    finds in them: names, heading, target and words."""
    known = {(ROOT / source).resolve(): target for _, source, target in PAGES}
    groups = [(name, [(words, target) for words, _, target in pages]) for name, pages in GROUPS]
    groups[-1][1].append(API)
    report = (ROOT / "plots" / "faststrip_plots" / "document.css").read_text(encoding="utf-8")
    own = (ROOT / "docs" / "pages.css").read_text(encoding="utf-8")
    (SITE / "pages.css").write_text(report + own, encoding="utf-8")
    shutil.copy(ROOT / "docs" / "search.js", SITE / "search.js")
    found = []
    for words, source, target in PAGES:
        path = ROOT / source
        text = path.read_text(encoding="utf-8")
        made = make_pictures(text, target.removesuffix(".html"))

        def target_of(link, folder=path.parent, made=made):
            if link in made:
                return made[link]
            if ELSEWHERE.match(link) or link.startswith("#"):
                return link
            name, hash_sign, anchor = link.partition("#")
            file = (folder / name).resolve()
            if file in known:
                return known[file] + hash_sign + anchor
            if not file.is_file():
                sys.exit(f"document: no such file: {link} ({source})")
            copy = SITE / "files" / file.relative_to(ROOT.resolve())
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, copy)
            return copy.relative_to(SITE).as_posix()

        body = to_html(text, target_of)
        parts = sections(body)
        headings = [(anchor, heading) for anchor, level, heading, _ in parts if level == 2]
        title = words if words == "faststrip" else f"{words} - faststrip"
        (SITE / target).write_text(page(title, body, menu(groups, target, headings)),
                                   encoding="utf-8")
        found += [(words, heading, f"{target}#{anchor}", text)
                  for anchor, _, heading, text in parts]
    return found


def make_pictures(text, name):
    """Run a page that has pictures; where in the site each of them lies."""
    wanted = pictures(text)
    if not wanted:
        return {}
    made = {}
    with tempfile.TemporaryDirectory() as folder:
        blocks.run(text, folder)
        for file, _ in wanted:
            copy = SITE / "files" / name / pathlib.Path(file).name
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(pathlib.Path(folder, "checkout", file), copy)
            made[file] = copy.relative_to(SITE).as_posix()
    return made


def entities():
    """What the search finds in the Fortran interface: a page each of modules, types, procedures."""
    for path in sorted((SITE / "api").rglob("*.html")):
        kind = path.parent.name
        if kind not in ("module", "type", "proc", "interface"):
            continue
        text = path.read_text(encoding="utf-8")
        name = re.search(r"<title>\s*(\S+)", text)
        summary = re.search(r'id="text".*?<p>(.*?)</p>', text, re.DOTALL)
        yield (API[0], html.unescape(name[1]), path.relative_to(SITE).as_posix(),
               plain(summary[1]) if summary else "")


def write_search(entries):
    """The search's data, a script because pages opened as files may not load anything else."""
    rows = [dict(zip(("page", "heading", "target", "words"), entry)) for entry in entries]
    (SITE / "search_data.js").write_text(
        f"const sections = {json.dumps(rows, ensure_ascii=False)};\n", encoding="utf-8")
    lunr = importlib.resources.files("mkdocs") / "contrib/search/templates/search/lunr.js"
    (SITE / "lunr.js").write_bytes(lunr.read_bytes())


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
            file = (path.parent / name).resolve() if name else path
            if not file.exists():
                yield f"{here}: leads nowhere: {target}"
            elif anchor and "api" not in here.parts and anchor not in names.get(file, {anchor}):
                yield f"{here}: no such anchor: {target}"


if __name__ == "__main__":
    main()
