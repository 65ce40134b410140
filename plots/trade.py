#!/usr/bin/env python3
"""Draw errors against time of every method and resolution, and tabulate which one to take."""

import os
import sys

import numpy as np

from faststrip_plots import command, style
from faststrip_plots.claims import UPPER, upper
from faststrip_plots.document import announce, write_dicts
from faststrip_plots.results import RESULTS, revision
from faststrip_plots.tables import InputError, read_table

FIGURES = ("penetration", "pmax", "area", "Fx", "Fy", "Mz")
FORCES = "Fx and Fy, in % of mu N, and Mz, in % of mu N c"
STAGES = {
    "influence": ("Influence coefficients in the strip method", "pressures and penetration against"
                  " the closed evaluation"),
    "normal": ("Normal contact", "penetration, maximum pressure and area"),
    "tangential": ("Tangential contact", FORCES),
    "both": ("Both together", FORCES),
}
TARGETS = (0.1, 0.03, 0.01, 0.003, 0.001)
# families of methods: colour, marker, and the words a name of theirs may begin with
FAMILIES = {
    "tables: published, refitted": ("#c9a227", "p", ("published", "refitted")),
    "quadratures": ("#6b6b6b", "h", ("trapezoids", "quadrature")),
    "closed": ("#0b3c78", "D", ("closed",)),
    "laws: linear, SHE, Polach": ("#8a8a8a", "X", ("linear", "SHE", "Polach")),
    "Hertz": ("#f08519", "s", ("Hertz",)),
    "peers: KPEC, ANALYN": ("#c0392b", "*", ("KPEC", "ANALYN")),
    "ellipses of the strips": ("#b8870b", "D", ("equal-area",)),
    "FASTSIM": ("#a8326e", "^", ("FASTSIM",)),
    "FASTSTRIP as printed, corrected": ("#5f4ba8", "P", ("FASTSTRIP-",)),
    "strips in KPEC's patch": ("#3a86c8", "d", ("strips in KPEC",)),
    "strips": ("#0b3c78", "o", ("strips", "FASTSTRIP")),
    "Kalker's NORM, TANG": ("#2f7d32", "v", ("NORM", "TANG")),
}
# Fast normal methods of other programs: no one of them may be better than ours in both.
PEERS = ("KPEC", "ANALYN")
# Contacts on which they are compared, and the words for them.
FRONT_SETS = {"s1002_uic60": "the paper's 20 contacts", "scenes": "scenes of many kinds"}
FRONT_US = (1.0, 1e6)  # from 1 us to 1 s
MOST = 2.0  # larger errors are drawn at the upper edge
LEAST = 1e-15  # and smaller ones, zero too, at the lower


def main(arguments=None):
    options = command.options(
        __doc__, arguments, {"trade": ("out/trade.csv", "what `faststrip-lab bench trade` wrote")},
        folder=("out/trade", "pictures and tables go there"))
    table = read_table(options.trade, ("set", "stage", "method", "status", "us")
                       + tuple("err_" + name for name in FIGURES))
    points = summarize(table)
    announced = []
    for stage, (heading, what) in STAGES.items():
        own = [point for point in points if point["stage"] == stage]
        if own:
            name = f"trade_{stage}.png"
            draw(own, heading, os.path.join(options.folder, name), revision(table))
            announced.append((name, heading, f"Errors of {what} against time; the line joins the"
                              " methods that no other beats in both.", "trade"))
    fronts = normal_fronts(table)
    if fronts:
        draw_fronts(fronts, os.path.join(options.folder, "trade_front.png"), revision(table))
        write_dicts(os.path.join(options.folder, "trade_front.csv"), fronts)
        announced.append(("trade_front.png", "Normal methods of ours and of others",
                          f"Mean error against processor time without the gap's curve; line: the"
                          f" best of ours so far; stars: {' and '.join(PEERS)}, as written here"
                          f" from their authors' equations. {verdict(fronts)}", "trade"))
    announce(options.folder, "figures.csv", announced)
    write_dicts(os.path.join(options.folder, "trade_points.csv"), points)
    write_dicts(os.path.join(options.folder, "trade_choice.csv"), choices(points))
    announce(options.folder, "tables.csv", [
        ("trade_choice.csv", "Which method to take",
         "The fastest whose mean error, over all contacts and figures of its stage, is within the"
         " target, with the median of its processor times; in brackets the same for the largest"
         " error. 95th percentile and worst of the times stand in trade_points.csv. Errors of"
         f" forces and moment: {FORCES}.", "trade"),
    ])


def summarize(table):
    """Mean and largest error of each method over all its contacts, and median (`us`), 95th
    percentile and worst of their processor times."""
    status, stage = table.words("status"), table.words("stage")
    method = table.words("method")
    us = table.numbers("us", missing=True)
    errors = np.abs([table.numbers("err_" + name, missing=True) for name in FIGURES])
    points = []
    for key in dict.fromkeys(zip(stage, method)):
        rows = np.array([k for k, other in enumerate(zip(stage, method)) if other == key])
        solved = np.array([k for k in rows if status[k] in RESULTS], dtype=int)
        point = {"stage": key[0], "method": key[1], "contacts": len(rows),
                 "unsolved": len(rows) - len(solved)}
        if not solved.size:
            continue
        known = [f for f in range(len(FIGURES)) if not np.isnan(errors[f, solved]).all()]
        if not known:
            raise InputError(f"no errors for {key[1]}: {table.path}")
        # each figure counts alike: the worst figure of a contact is its error
        worst = np.nanmax(errors[np.ix_(known, solved)], axis=0)
        point |= {"us": float(np.median(us[solved])),
                  "cpu_us_p95": upper(us[solved], UPPER),
                  "cpu_us_worst": float(us[solved].max()), "mean": float(worst.mean()),
                  "max": float(worst.max())}
        for f, name in enumerate(FIGURES):
            point[f"mean_{name}"] = float(np.nanmean(errors[f, solved])) if f in known else ""
            point[f"max_{name}"] = float(np.nanmax(errors[f, solved])) if f in known else ""
        points.append(point)
    if not points:
        raise InputError(f"no method has a result: {table.path}")
    return points


def front(points, error):
    """The points that no other beats in both time and error, by ascending time."""
    best, found = np.inf, []
    for point in sorted(points, key=lambda p: (p["us"], p[error])):
        if point[error] < best:
            best = point[error]
            found.append(point)
    return found


def normal_fronts(table):
    """Mean errors and times of the normal methods, one row per set and method: `below` says in
    which errors a peer lies below all of ours that take no longer."""
    if "cpu_us_solution_median" not in table.columns:
        return []
    stage, method, sets = (table.words(name) for name in ("stage", "method", "set"))
    alone = table.numbers("cpu_us_solution_median", missing=True)
    times = np.where(np.isnan(alone), table.numbers("us", missing=True), alone)
    figures = FIGURES[:3]
    errors = np.abs([table.numbers("err_" + name, missing=True) for name in figures])
    rows = []
    for name in FRONT_SETS:
        own = []
        for key in dict.fromkeys(m for m, s in zip(method, stage) if s == "normal"):
            mask = np.array([(s, m, n) == ("normal", key, name)
                             for s, m, n in zip(stage, method, sets)]) & ~np.isnan(times)
            known = [f for f in range(3) if mask.any() and not np.isnan(errors[f, mask]).any()]
            if not known:
                continue
            row = {"set": name, "method": key, "peer": "yes" if key in PEERS else "no",
                   "contacts": int(mask.sum()), "us": float(np.median(times[mask])),
                   "us_p95": upper(times[mask], UPPER),
                   "us_worst": float(times[mask].max()),
                   "worst_case": table.words("case")[int(np.argmax(np.where(mask, times, -1)))],
                   "mean": float(errors[np.ix_(known, mask)].max(axis=0).mean())}
            for f, figure in enumerate(figures):
                row[f"mean_{figure}"] = float(errors[f, mask].mean()) if f in known else ""
            own.append(row)
        for row in own:
            row["below"] = " ".join(
                error for error in ("mean", *(f"mean_{figure}" for figure in figures))
                if row["peer"] == "yes" and row[error] != "" and not any(
                    other["peer"] == "no" and other["us"] <= row["us"]
                    and other[error] <= row[error] for other in own))
        rows += own
    return rows


def verdict(fronts):
    """Where a peer lies below ours, in words."""
    below = [f"{row['method']} ({row['set']})" for row in fronts if "mean" in row["below"].split()]
    return ("Below ours: " + ", ".join(below) if below else "No one lies below ours") + "."


def draw_fronts(rows, path, stamp):
    """One panel for each set of contacts, one curve for our best so far."""
    figure = style.new_figure(11.5, 5.0)
    panels = figure.subplots(1, len(FRONT_SETS), sharex=True, sharey=True)
    for axes, (name, words) in zip(panels, FRONT_SETS.items()):
        points = [row for row in rows if row["set"] == name]
        best = front([row for row in points if row["peer"] == "no"], "mean")
        if best:
            axes.step([p["us"] for p in best] + [FRONT_US[1]],
                      [drawn(p["mean"]) for p in [*best, best[-1]]], where="post",
                      color="#333333", linewidth=1.0, zorder=1, label="the best of ours so far")
        draw_families(axes, points, "mean")
        for point in points:
            if point not in best and point["peer"] == "no":
                continue
            outside = point["peer"] == "yes" or point is best[0]
            axes.annotate(shorter(point["method"]), (point["us"], drawn(point["mean"])),
                          xytext=(5, 5) if outside else (-5, -9), textcoords="offset points",
                          ha="left" if outside else "right", fontsize=7.5, color="#333333")
        axes.set(xscale="log", yscale="log", xlim=(0.5 * FRONT_US[0], FRONT_US[1]),
                 xlabel="processor time of a solution in µs, median over the contacts",
                 ylabel="mean error of the worst figure in %", title=words)
    style.legend_above(figure, *panels)
    style.save(figure, path, [stamp], "")


def choices(points):
    """The fastest method of each stage for each target, by mean and by largest error."""
    rows = []
    for target in TARGETS:
        row = {"target": f"{100 * target:g} %"}
        for stage, (heading, _) in STAGES.items():
            own = [p for p in points if p["stage"] == stage and p["unsolved"] == 0]
            if own:
                row[heading] = " ".join(
                    form.format(cheapest(own, error, target))
                    for error, form in (("mean", "{}"), ("max", "({})"))
                )
        rows.append(row)
    return rows


def cheapest(points, error, target):
    good = [point for point in points if point[error] <= target]
    if not good:
        return "none"
    best = min(good, key=lambda point: point["us"])
    return f"{best['method']}, {best['us']:.3g} µs"


def family(method):
    """The family of a method by its name."""
    for name, (_, _, words) in FAMILIES.items():
        if method.startswith(words):
            return name
    raise InputError(f"a method of no known family: {method}")


def draw(points, heading, path, stamp):
    """Mean errors on the left, largest errors on the right."""
    figure = style.new_figure(11.5, 5.4)
    point_stage = points[0]["stage"]
    panels = figure.subplots(1, 2, sharex=True, sharey=True)
    for axes, error, words in zip(panels, ("mean", "max"), ("mean error", "largest error")):
        best = front(points, error)
        axes.plot([p["us"] for p in best], [drawn(p[error]) for p in best],
                  color="#333333", linewidth=1.0, zorder=1, label="no other is better in both")
        draw_families(axes, points, error)
        for number, point in enumerate(p for p in best if p[error] < MOST):
            axes.annotate(shorter(point["method"]), (point["us"], drawn(point[error])),
                          xytext=(4, 6 if number % 2 else -12), textcoords="offset points",
                          fontsize=7.5, color="#333333")
        axes.set(xscale="log", yscale="log",
                 xlabel="processor time per contact in µs, median over the contacts")
        forces = point_stage in ("tangential", "both")
        axes.set(ylabel="error in % of $\\mu\\cdot N$; of $M_z$ in % of $\\mu\\cdot N c$" if forces
                        else "error in %", title=f"{heading}: {words}")
        axes.margins(0.14)
    style.legend_above(figure, *panels)
    note = ""
    if any(p["max"] >= MOST for p in points):
        note = f"errors above {100 * MOST:.0f} % are drawn there"
    style.save(figure, path, [stamp], note)


def draw_families(axes, points, error):
    """Marks of each family of methods; peers are larger."""
    for name, (colour, marker, _) in FAMILIES.items():
        own = [p for p in points if family(p["method"]) == name]
        if own:
            axes.plot([p["us"] for p in own], [drawn(p[error]) for p in own], linestyle="none",
                      marker=marker, color=colour, markeredgecolor="white", label=name,
                      markersize=11 if own[0].get("peer") == "yes" else 6.5)


def drawn(error):
    """An error in %, no larger and no smaller than what is drawn."""
    return 100 * min(max(error, LEAST), MOST)


def shorter(name):
    """A method's name without the words every label would repeat."""
    for word in ("strips + FASTSTRIP ", "FASTSTRIP ", "FASTSIM ", "strips ", "NORM + TANG ",
                 "NORM ", "TANG "):
        if name.startswith(word):
            return name[len(word):]
    return name.replace("Hertz + ", "H + ")


if __name__ == "__main__":
    sys.exit(command.run(main))
