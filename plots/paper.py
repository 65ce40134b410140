#!/usr/bin/env python3
"""Redo Figs 5 to 14 and 17 to 26 of Lack and Gerlici (2014); PNG, SVG and a list of them."""

import csv
import os
import sys

from faststrip_plots import command, paper_figures, style
from faststrip_plots.curves import read_curves
from faststrip_plots.results import read_reference, read_sweep, read_sweeps
from faststrip_plots.tables import InputError

LIST = "figures.csv"


def main(arguments=None):
    parser = command.parser(__doc__)
    parser.add_argument("--curves", default="out/paper/curves.csv", metavar="CSV",
                        help="what `faststrip table --curves` wrote")
    parser.add_argument("--fine", default="out/paper/sweep_fine.csv", metavar="CSV",
                        help="a sweep in fine steps (example/s1002_uic60_fine.nml)")
    parser.add_argument("--sweep", default=["out/paper/sweep_A.csv"], metavar="CSV", nargs="+",
                        help="sweeps of Table 2 (example/s1002_uic60_A.nml), by more methods each")
    parser.add_argument("--reference", default="reference/contact/s1002_uic60_A.csv",
                        metavar="CSV", help="the same by full CONTACT; A has the paper's signs")
    parser.add_argument("--mu", type=command.friction, default=0.3, metavar="MU",
                        help="coefficient of friction of the sweep")
    parser.add_argument("--folder", default="out/paper", metavar="DIR",
                        help=f"where the pictures and {LIST} go")
    options = parser.parse_args(arguments)
    curves, stamp = read_curves(options.curves)
    fine = read_sweep(options.fine)
    sweep = read_sweeps(options.sweep)
    reference = read_reference(options.reference)
    for file in options.sweep:
        signs = paper_figures.check_creepages(file, options.reference)
    for each in (fine, sweep):
        command.report_failures(each)

    # all are drawn before any is written: bad input leaves no picture behind
    pictures = [
        *paper_figures.integral_pictures(curves, stamp),
        *paper_figures.shift_pictures(fine, reference),
        paper_figures.normal_picture(sweep, reference, options.mu),
        *paper_figures.force_pictures(sweep, reference, options.mu, signs),
    ]
    for picture in pictures:
        path = os.path.join(options.folder, picture.stem + ".png")
        style.save(picture.figure, path, picture.stamps, picture.note, vector=True)
        print(path)
    path = os.path.join(options.folder, LIST)
    write_list(path, pictures)
    print(path)


def write_list(path, pictures):
    """One row per picture: file (PNG; the SVG lies beside it), title, caption, chapter."""
    try:
        with open(path, "w", encoding="utf-8", newline="") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow(("file", "title", "caption", "chapter"))
            for picture in pictures:
                writer.writerow((picture.stem + ".png", picture.title, picture.caption,
                                 paper_figures.CHAPTER))
    except OSError as error:
        raise InputError(f"cannot write: {path} ({os.strerror(error.errno)})") from None


if __name__ == "__main__":
    sys.exit(command.run(main))
