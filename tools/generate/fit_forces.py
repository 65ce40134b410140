#!/usr/bin/env python3
"""Fit what FASTSTRIP misses of the creep forces, and how wrong they are expected to be.

    fit_forces.py FEATURES.csv [OTHERS.csv ...] [--leave-out FAMILY+FAMILY]... [--steps N] [-o FILE]

The files are what `faststrip-lab force-features` writes: forces of the march and of TANG, and what
the correction depends on. The first one has 15 strips of 15 points; the others, with more and
fewer, are fitted too, and the figures are those of the first. First the ellipses' part is fitted to
ellipses, then the shape's to what that leaves of all contacts, once for each group of families that
is left out and once with all. The estimate of the errors is fitted to the errors on contacts that
the correction did not know: those groups, and half of the ellipses. Contacts whose number is a
multiple of VALIDATION are never fitted.

Written are reference/force_correction.json with the figures and reference/force_correction.csv,
samples for a test; then tools/generate/force_weights.py writes the module of the weights.
"""

import argparse
import csv
import json
import pathlib
import sys

import numpy as np

import force_network as net

ROOT = pathlib.Path(__file__).resolve().parents[2]
TARGET = ROOT / "reference" / "force_correction.json"
VALIDATION = 10
SEED = 1
# Rows of the file of samples.
SAMPLES = 40
# Units of the layers of the network of the errors, and its part of the steps.
ERROR_HIDDEN, ERROR_STEPS = 32, 0.5
# Estimates are larger by this than what one error in 20 passes on what is known.
ERROR_SAFETY = 1.3
METHODS = ("march", "corrected", "fastsim")


def sizes(errors):
    """Mean, 95th percentile and worst in percent, for Fx, Fy, Mz and the stick fraction."""
    size = 100 * np.abs(errors)
    return [[round(float(value), 3) for value in
             (column.mean(), np.percentile(column, 95), column.max())] for column in size.T]


def before_and_after(data, left):
    return {"rows": len(left), "march": sizes(data["missing"]), "corrected": sizes(left)}


def fit_correction(data, steps, left_out):
    """The correction; the errors of each row by one that does not know it; figures."""
    fitted = data["number"] % VALIDATION != 0
    round_ones = (data["family"] == "ellipse") & (data["neck"] == 0)
    whole = data["neck"] == 0
    ellipses = net.Correction.of_ellipses(net.rows(data, fitted & round_ones), steps, SEED)
    report, unknown = {}, np.full_like(data["missing"], np.nan)

    def judge(name, correction, mine, keep=True):
        some = net.rows(data, mine)
        left = some["missing"] - correction(some)
        if keep:
            unknown[mine] = left
        report[name] = before_and_after(net.rows(some, some["first"]), left[some["first"]])
        print(name, report[name], flush=True)

    judge("validation, ellipses by the ellipses' part", ellipses, ~fitted & round_ones, False)
    for half in (0, 1):
        here = data["number"] // 100 % 2 == half
        other = net.Correction.of_ellipses(net.rows(data, round_ones & here), int(steps / 2), SEED)
        judge(f"ellipses, half {half + 1} by the other", other, round_ones & ~here)
    for words in left_out:
        away = np.isin(data["family"], words.split("+"))
        other = ellipses.with_shape(net.rows(data, fitted & whole & ~away), int(steps / 2), SEED,
                                    "without " + words)
        for family in words.split("+"):
            mine = whole & (data["family"] == family)
            if mine.any():
                judge(f"left out: {family}", other, mine)
    result = ellipses.with_shape(net.rows(data, fitted & whole), steps, SEED, "all")
    for name, mine in (("fitted", fitted & whole),
                       ("validation, ellipses", ~fitted & round_ones),
                       ("validation, others", ~fitted & whole & ~round_ones)):
        judge(name, result, mine, False)
    # Sub-patches are corrected one by one: the march's own errors stand in for what is left.
    unknown[~whole] = data["missing"][~whole]
    return result, unknown, report


def fit_errors(correction, data, unknown, steps, left_out):
    """Estimates of the errors; figures of those on families that they do not know."""
    known = np.isfinite(unknown[:, 0]) & (data["u"] > 0)
    x = net.error_inputs(correction, data)
    y = np.log(np.abs(np.concatenate([data["missing"][:, :3], unknown[:, :3], data["fastsim"]], 1))
               + net.SMALLEST)
    report = {}

    def estimate(rows, name):
        return net.Network(x[rows], y.shape[1], SEED, ERROR_HIDDEN).fit(
            x[rows], [y[rows]], net.pinball, int(steps * ERROR_STEPS), name)

    for words in ["ellipse", *left_out]:
        away = np.isin(data["family"], words.split("+"))
        other = estimate(known & ~away, "errors without " + words)
        mine = known & away
        above = ERROR_SAFETY * np.exp(np.array(other(x[mine]), float)) / np.exp(y[mine])
        report[words] = {method: [[round(100 * float((one >= 1).mean()), 1),
                                   round(float(np.median(one)), 2)] for one in
                                  above.T[3 * k:3 * k + 3]] for k, method in enumerate(METHODS)}
        print("errors without", words, report[words], flush=True)
    return estimate(known, "errors"), report


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("features", type=pathlib.Path, nargs="+")
    parser.add_argument("--leave-out", action="append", default=[], metavar="FAMILY+FAMILY")
    parser.add_argument("--steps", type=int, default=60000)
    parser.add_argument("-o", type=pathlib.Path, default=TARGET, dest="target")
    options = parser.parse_args()
    parts = [net.states(path) for path in options.features]
    for part in parts:
        part["first"] = np.full(len(part["number"]), part is parts[0])
    data = net.joined(parts)
    result, unknown, report = fit_correction(data, options.steps, options.leave_out)
    errors, bounds = fit_errors(result, data, unknown, options.steps, options.leave_out)
    text = {
        "what": "what FASTSTRIP misses of the creep forces, fitted by tools/generate/fit_forces.py",
        "contacts": len(np.unique(data["number"] + 1j * data["seed"])),
        "rows": len(data["number"]), "steps": options.steps, "seed": SEED, "batch": net.BATCH,
        "rate": net.RATE,
        "percent of mu N, mu N sqrt(ab), area: mean, 95th percentile, worst of Fx, Fy, Mz, stick":
            report,
        "estimates on families left out: bounded in percent, median of estimate over error":
            bounds,
        "half_shape": net.HALF_SHAPE, "even_scale": net.rounded(net.EVEN_SCALE),
        "odd_scale": net.rounded(net.ODD_SCALE), "side_scale": net.rounded(result.side),
        "largest_log_ratio": round(float(np.abs(data["ellipse"][:, 5]).max()), 3),
        "largest_shape": round(float(np.percentile(np.sqrt(data["unlike"]), 99)), 3),
        "most": net.rounded(net.MOST),
        "least_poisson": round(float(data["ellipse"][:, 6].min()), 3),
        "largest_poisson": round(float(data["ellipse"][:, 6].max()), 3),
        "ellipse": result.ellipse.folded(), "shape": result.shape.folded(),
        "errors": errors.folded(), "error_safety": ERROR_SAFETY,
        "smallest_error": net.SMALLEST, "largest_estimate": net.ESTIMATES[1],
    }
    options.target.write_text(json.dumps(text, indent=1) + "\n", encoding="utf-8")
    write_samples(options.target.with_suffix(".csv"), result, data)
    return 0


def write_samples(path, result, data):
    """What the networks give for some contacts, for a test of the module that evaluates them."""
    chosen = np.random.default_rng(SEED).choice(
        np.flatnonzero((data["u"] < net.SLIDING[0]) & (data["unlike"] < 10)
                       & (data["neck"] == 0)), SAMPLES, replace=False)
    some = net.rows(data, chosen)
    names = ["u1", "u2", "u3", "cksi", "ceta", "cphi_rad_per_mm", "a_mm", "b_mm", "nu",
             *(f"even{k}" for k in range(1, net.EVEN + 1)),
             *(f"odd{k}" for k in range(1, net.ODD + 1)), "width", "points",
             "Fx_over_muN", "Fy_over_muN", "Mz_over_muNc", "stick"]
    with open(path, "w", newline="", encoding="utf-8") as stream:
        stream.write("# forces and share of stick that FASTSTRIP misses, by the fit in "
                     "force_correction.json; written by tools/generate/fit_forces.py; creepages "
                     "and moment about the centroid\n")
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(names)
        for inputs, missing in zip(some["inputs"], result(some), strict=True):
            writer.writerow([*(f"{value:.12g}" for value in inputs),
                             *(f"{value:.9g}" for value in missing)])


if __name__ == "__main__":
    sys.exit(main())
