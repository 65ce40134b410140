#!/usr/bin/env python3
"""Redo Figs 5 to 14 and 17 to 26 of Lack and Gerlici (2014); PNG, SVG and a list of them."""

import os
import sys

from faststrip_plots import command, paper_figures, picture
from faststrip_plots.curves import read_curves
from faststrip_plots.document import announce
from faststrip_plots.results import read_reference, read_sweep, read_sweeps

LIST = "figures.csv"


def main(arguments=None):
    options = command.options(
        __doc__, arguments, {
            "curves": ("out/paper/curves.csv", "what `faststrip table --curves` wrote"),
            "fine": ("out/paper/sweep_fine.csv",
                     "a sweep in fine steps (example/s1002_uic60_fine.nml)"),
            "reference": ("reference/contact/s1002_uic60_A.csv",
                          "the same by full CONTACT; A has the paper's signs")},
        folder=("out/paper", f"where the pictures and {LIST} go"),
        more={"sweep": dict(
                  default=["out/paper/sweep_A.csv"], metavar="CSV", nargs="+", help="sweeps of"
                  " Table 2 (example/s1002_uic60_A.nml), by more methods each"),
              **command.friction("coefficient of friction of the sweep")})
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
    for one in pictures:
        picture.save(one.figure, os.path.join(options.folder, one.stem + ".png"), one.stamps,
                     one.note, vector=True)
    announce(options.folder, LIST, [
        (one.stem + ".png", one.title, one.caption, paper_figures.CHAPTER) for one in pictures])
    print(os.path.join(options.folder, LIST))


if __name__ == "__main__":
    sys.exit(command.run(main))
