#!/usr/bin/env python3
"""Judge the figures of a report's data folder and write report.md, report.html, verdicts.csv."""

import glob
import math
import os
import sys

from faststrip_plots import command
from faststrip_plots.document import ANNOUNCED, Document, write_rows, write_text
from faststrip_plots.results import revision
from faststrip_plots.stamps import History, stamp_of, stored_files
from faststrip_plots.tables import InputError, read_table
from faststrip_plots.verdicts import CHAPTERS, judge, read_manifest, shown, shown_tolerance

# Pictures and tables of commands that announce none themselves.
LIST = "reference/report_figures.csv"
STORED = "reference/stored.csv"
VERDICTS = ("id", "chapter", "value", "tolerance", "rows", "verdict", "remark", "value_shown",
            "tolerance_shown")

# Chapters after the verdicts, with what introduces them; pictures and tables say where they go.
CHAPTER_TEXTS = {
    "paper": ("The paper, redone", "Ours as lines, CONTACT and the paper's tables as symbols."),
    "trade": ("Error against time", "What an error costs, method by method."),
    "examples": ("Examples", "The cases of example/cases, each by every method."),
    "auto": ("Only what a case requires",
             "Models chosen by the error they are predicted to have."),
    "extremes": ("Extremes", "Where numbers hold, and where a status word says that they do not."),
}


def main(arguments=None):
    options = command.options(
        __doc__, arguments, {"manifest": (
            "reference/comparisons.csv",
            "what is compared with what, and how closely it has to agree")},
        folder=("out/report", "the report's folder; its CSV files stand in data/"),
        more={"quick": dict(action="store_true", help="comparisons whose file is missing are left"
                            " out, not failed")})
    data = os.path.join(options.folder, "data")
    verdicts = [judge(row, data) for row in read_manifest(options.manifest)]
    left_out = 0
    if options.quick:
        judged = [v for v in verdicts if v.word != "missing"]
        left_out = len(verdicts) - len(judged)
        verdicts = judged
    if not verdicts:
        raise InputError(f"nothing to judge: {options.manifest}")
    document = build(verdicts, left_out, options.folder)
    write_rows(os.path.join(options.folder, "verdicts.csv"), VERDICTS, map(verdict_row, verdicts))
    write_text(os.path.join(options.folder, "report.md"), document.markdown(options.folder))
    write_text(os.path.join(options.folder, "report.html"), document.page())
    failed = [v for v in verdicts if not v.good]
    for verdict in failed:
        print(f"{verdict.row['id']}: {verdict.word}, {shown(verdict.row, verdict.value)} for"
              f" {shown_tolerance(verdict.row)} {verdict.remark}".rstrip(), file=sys.stderr)
    print(f"{len(verdicts) - len(failed)} comparisons passed, {len(failed)} failed"
          + (f", {left_out} left out" if left_out else ""))
    if failed:
        raise InputError(f"{len(failed)} of {len(verdicts)} comparisons failed: see"
                         f" {os.path.join(options.folder, 'report.md')}")


def build(verdicts, left_out, folder):
    """The whole report."""
    document = Document("faststrip: accuracy, time and limits")
    document.paragraph(stamp(folder))
    good = sum(v.good for v in verdicts)
    document.paragraph(
        f"{good} of {len(verdicts)} comparisons hold their tolerance"
        + (f"; {left_out} are left out of the quick report." if left_out else ".")
    )
    introductions = {
        "verification": "Against exact solutions.",
        "validation": "Against another code: full CONTACT, extrapolated in its grid where its"
                      " grid error counts, and the paper's own tables.",
    }
    for chapter in CHAPTERS:
        chosen = [v for v in verdicts if v.row["chapter"] == chapter]
        if not chosen:
            continue
        document.heading(chapter.capitalize())
        document.paragraph(introductions[chapter])
        document.table(
            ("comparison", "quantity", "method", "measure", "rows", "value", "tolerance",
             "verdict", "reference"),
            [verdict_cells(v) for v in chosen],
            bad=[k for k, v in enumerate(chosen) if not v.good],
        )
    pictures = read_pictures(folder)
    tables = read_tables(folder)
    for chapter, (title, introduction) in CHAPTER_TEXTS.items():
        own_tables = [t for t in tables if t["chapter"] == chapter]
        own_pictures = [p for p in pictures if p["chapter"] == chapter]
        if not own_tables and not own_pictures:
            continue
        document.heading(title)
        document.paragraph(introduction)
        for entry in own_tables:
            document.heading(entry["title"], 3)
            if entry["caption"]:
                document.paragraph(entry["caption"])
            add_table(document, entry["path"])
        for entry in own_pictures:
            document.figure(entry["path"], entry["title"], entry["caption"])
    add_stored(document)
    add_runs(document, folder)
    return document


def stamp(folder):
    """Revision, compiler, flags and processor, from the comments of the files themselves."""
    lines = []
    for path in sorted(glob.glob(os.path.join(folder, "data", "*.csv"))):
        try:
            table = read_table(path)
        except InputError:  # no rows
            continue
        for comment in [revision(table)] + [c for c in table.comments if c.startswith("compiler")]:
            if comment and comment not in lines:
                lines.append(comment)
    lines.append(f"processor {processor()}")
    return "; ".join(lines)


def processor():
    """The processor's name as the system gives it."""
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as stream:
            for line in stream:
                if line.startswith("model name"):
                    return line.partition(":")[2].strip()
    except OSError:
        pass
    return "not known"


def verdict_cells(verdict):
    row = verdict.row
    return (row["id"], row["quantity"], row["method"] or "–", row["metric"], str(verdict.rows),
            shown(row, verdict.value), shown_tolerance(row),
            verdict.word + (f" ({verdict.remark})" if verdict.remark else ""), row["source"])


def verdict_row(v):
    value = "" if math.isnan(v.value) else repr(v.value)
    return (v.row["id"], v.row["chapter"], value, v.row["tolerance"], v.rows, v.word, v.remark,
            shown(v.row, v.value), shown_tolerance(v.row))


def read_pictures(folder):
    """All pictures that a `figures.csv` (file,title,caption,chapter) beside them announces, and
    those of LIST that were made."""
    return announced(os.path.join(folder, "figures"), "figures.csv") + from_list(folder, ".png")


def read_tables(folder):
    """All CSV files that a `tables.csv` of the same columns announces as tables to print."""
    return [
        *announced(os.path.join(folder, "data"), "tables.csv"),
        *announced(os.path.join(folder, "figures"), "tables.csv"),
        *from_list(folder, ".csv"),
    ]


def from_list(folder, ending):
    """The entries of LIST with an ending, as far as the files were made."""
    if not os.path.exists(LIST):
        return []
    entries = listed(LIST, os.path.join(folder, "figures"), must_be_there=False)
    return [entry for entry in entries if entry["file"].endswith(ending)]


def announced(folder, name):
    found = []
    pattern = os.path.join(glob.escape(folder), "**", name)
    for path in sorted(glob.glob(pattern, recursive=True)):
        found += listed(path, os.path.dirname(path), must_be_there=True)
    return found


def listed(path, folder, must_be_there):
    """The entries of one list; files are named as seen from a folder."""
    found = []
    table = read_table(path, ANNOUNCED)
    for k, line in enumerate(table.lines):
        entry = {name: table.words(name)[k] for name in ANNOUNCED}
        entry["path"] = entry["file"]
        if not entry["file"].startswith("reference/"):
            entry["path"] = os.path.join(folder, entry["file"])
        if entry["chapter"] not in CHAPTER_TEXTS:
            raise InputError(f"no such chapter: {entry['chapter']} ({path}:{line})")
        if os.path.exists(entry["path"]):
            found.append(entry)
        elif must_be_there:
            raise InputError(f"no such file: {entry['path']} ({path}:{line})")
    return found


def add_table(document, path):
    """Print a CSV file, numbers shortened."""
    table = read_table(path)
    names = list(table.columns)
    document.table(names, [
        [short(table.columns[name][k]) for name in names] for k in range(len(table))
    ])


def short(text):
    """A cell as people read it: whole numbers as they are, others with four digits."""
    try:
        value = float(text)
    except ValueError:
        return text
    if not math.isfinite(value) or text.lstrip("+-").isdigit():
        return text
    return f"{value:.4g}"


def add_stored(document, root="."):
    """How old the results are that were not made for this report."""
    path = os.path.join(root, STORED)
    if not os.path.exists(path):
        return
    history = History(root)
    document.heading("Stored results")
    document.paragraph(
        "Not made for this report but stored with the program, which made them (`./run stored`):"
        " the revision that did, its date and how many commits have followed."
        + ("" if history.known else " There is no git history here: what the stamps say."))
    document.table(("file", "age"), [
        (file, history.age(stamp_of(os.path.join(root, file)))) for file in stored_files(path)
    ])


def add_runs(document, folder):
    """How each run ended and how long it took."""
    path = os.path.join(folder, "data", "runs.csv")
    if not os.path.exists(path):
        return
    table = read_table(path, ("id", "exit_code", "seconds", "words"))
    document.heading("Runs")
    document.paragraph("What was run for this report, and how long it took.")
    codes = table.words("exit_code")
    document.table(
        ("run", "exit code", "seconds", "words"),
        [(table.words("id")[k], codes[k], f"{table.numbers('seconds')[k]:.1f}",
          table.words("words")[k]) for k in range(len(table))],
        bad=[k for k, code in enumerate(codes) if code != "0"],
    )


if __name__ == "__main__":
    sys.exit(command.run(main))
