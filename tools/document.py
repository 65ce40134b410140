#!/usr/bin/env python3
"""Build the site of faststrip into out/docs: the pages, and the Fortran interface by FORD in api/.

Nothing of it is loaded from elsewhere: it reads without network. A warning is an error, and so is
a link that leads nowhere.
"""

import pathlib
import re
import shutil
import subprocess
import sys

from pages import page, to_html

ROOT = pathlib.Path(__file__).resolve().parents[1]
SITE = ROOT / "out" / "docs"
# Pages, in the order of the navigation: what they are called there, file, page.
PAGES = (
    ("faststrip", "README.md", "index.html"),
    ("Usage", "docs/usage.md", "usage.html"),
    ("Formats", "docs/formats.md", "formats.html"),
    ("Embedding", "docs/embedding.md", "embedding.html"),
    ("Method", "docs/method.md", "method.html"),
    ("Validation", "docs/validation.md", "validation.html"),
    ("Constants", "docs/constants.md", "constants.html"),
    ("References", "reference/README.md", "reference.html"),
    ("Architecture", "docs/architecture.md", "architecture.html"),
    ("Contributing", "CONTRIBUTING.md", "contributing.html"),
    ("Changes", "CHANGELOG.md", "changelog.html"),
)
API = ("Fortran interface", "api/index.html")
ELSEWHERE = re.compile(r"(?:[a-z]+:)?//|(?:mailto|data):")
# What FORD's pages load from a network: a style sheet, in whose place is docs/api.css, and scripts.
LOADED = re.compile(r'<link [^>]*href="https?://[^>]*>|<script[^>]*src="https?://[^>]*>\s*</script>'
                    r'|<script type="text/x-mathjax-config">.*?</script>', re.DOTALL)


def main():
    shutil.rmtree(SITE, ignore_errors=True)
    SITE.mkdir(parents=True)
    build_api()
    build_pages()
    broken = sorted(broken_targets())
    if broken:
        sys.exit("\n".join(broken))


def build_api():
    """FORD's pages, made independent of the network."""
    ford = pathlib.Path(sys.executable).parent / "ford"
    done = subprocess.run([str(ford), str(ROOT / "docs" / "ford.md")], cwd=ROOT,
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
    """The Markdown files of PAGES; what else they point to is copied into files/."""
    known = {(ROOT / source).resolve(): target for _, source, target in PAGES}
    navigation = [(words, target) for words, _, target in PAGES] + [API]
    shutil.copy(ROOT / "docs" / "pages.css", SITE / "pages.css")
    for words, source, target in PAGES:
        path = ROOT / source

        def target_of(link, folder=path.parent):
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

        body = to_html(path.read_text(encoding="utf-8"), target_of)
        title = words if words == "faststrip" else f"{words} - faststrip"
        (SITE / target).write_text(page(title, body, navigation), encoding="utf-8")


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
