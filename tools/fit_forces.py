#!/usr/bin/env python3
"""Fit what FASTSTRIP misses of the creep forces: reference/force_correction.json.

    fit_forces.py FEATURES.csv [--leave-out FAMILY+FAMILY]... [--steps N] [-o FILE]

FEATURES.csv is what `faststrip-lab force-features` writes: forces of the march and of TANG, and
what the correction depends on. The network is that of
src/faststrip/tangential/force_correction.f90; jax and optax do the fitting
(tools/requirements-fit.txt). Contacts whose number is a multiple of VALIDATION are never fitted;
the errors on them, and on whole families that were left out, are kept in the file. Then
tools/force_weights.py writes the module of the weights.
"""

import argparse
import csv
import json
import math
import os
import pathlib
import sys
import time

os.environ.setdefault("XLA_FLAGS", "--xla_cpu_multi_thread_eigen=false")
import jax
import jax.numpy as jnp
import numpy as np
import optax

ROOT = pathlib.Path(__file__).resolve().parents[1]
TARGET = ROOT / "reference" / "force_correction.json"
EVEN, ODD, SIDES = 5, 5, 3
HIDDEN, OUTPUTS = 48, 10 + 4 * SIDES
# Scales of the shape's numbers: about one over what they are at most.
EVEN_SCALE = np.array([30.0, 8.0, 8.0, 8.0, 30.0])
ODD_SCALE = np.array([15.0, 5.0, 10.0, 10.0, 10.0])
HALF_SHAPE = 0.02
STRONG = 10.0
SLIDING = (30.0, 300.0)
VALIDATION = 10
SEED = 1
BATCH = 1024
RATE = 6.0e-3
# Rows of the file of samples.
SAMPLES = 40
# Below this error, in parts of mu N, an error counts by its square.
ROUND = 0.002
# What the squares count beside the sizes of the errors.
SQUARES = 20.0


def read(path):
    with open(path, encoding="utf-8") as stream:
        rows = csv.reader(line for line in stream if line[0] != "#")
        head = next(rows)
        table = list(rows)
    columns = list(zip(*table, strict=True))
    return {name: np.array(column) if name == "family" else np.array(column, float)
            for name, column in zip(head, columns, strict=True)}


def contacts(path):
    """Inputs and targets of the network, one row for each contact and creepage without a neck."""
    d = read(path)
    keep = d["neck"] == 0
    d = {name: column[keep] for name, column in d.items()}
    a, b, y = d["a_mm"], d["b_mm"], d["yc_mm"]
    force = d["mu"] * d["load_N"]
    arm = np.sqrt(a * b)

    def forces(fx, fy, mz):
        return np.stack([fx, fy, (mz + y * fx) / arm], 1) / force[:, None]

    march = forces(d["Fx_N"], d["Fy_N"], d["Mz_Nmm"])
    # The extrapolation makes Fx of TANG worse, Fy and Mz better.
    truth = forces(d["Fx_fine_N"], d["Fy_tang_N"], d["Mz_tang_Nmm"])
    u = np.stack([d["u1"], d["u2"], d["u3"]], 1)
    squared = (u**2).sum(1)
    v = u / np.sqrt(1 + squared)[:, None]
    even = np.stack([d[f"even{k}"] for k in range(1, EVEN + 1)], 1)
    odd = np.stack([d[f"odd{k}"] for k in range(1, ODD + 1)], 1)
    spin = d["cphi_rad_per_mm"]
    along, across = d["cksi"] - y * spin, d["ceta"]
    slip = along**2 + across**2 + 0.25 * spin**2 * (a**2 + b**2)
    slip = np.where(slip > 0, slip, 1)
    o = odd.T
    x = np.stack([v[:, 0]**2, v[:, 1]**2, v[:, 2]**2, v[:, 1] * v[:, 2], np.log1p(squared),
                  np.log(a / b), d["nu"], along**2 / slip, across**2 / slip,
                  across * spin * a / slip, spin**2 * a * b / slip,
                  np.log1p(squared / STRONG**2), *even.T,
                  *(o[:4] * v[:, 0] * v[:, 1]), *(o[:4] * v[:, 0] * v[:, 2]),
                  *(o[:4]**2), o[0] * o[1], o[0] * o[2]], 1)
    unlike = ((even * EVEN_SCALE)**2).sum(1) + ((odd * ODD_SCALE)**2).sum(1)
    t = np.log(np.maximum(np.sqrt(squared), 1e-30) / SLIDING[0]) / math.log(SLIDING[1] / SLIDING[0])
    t = np.clip(t, 0, 1)
    march_part = 1 - t**3 * (10 - t * (15 - 6 * t))
    return {"family": d["family"], "number": d["number"].astype(int), "x": x, "v": v,
            "odd": odd[:, :SIDES], "ellipse": np.linalg.norm(v, axis=1) * march_part,
            "form": unlike / (unlike + HALF_SHAPE) * march_part, "missing": truth - march,
            "inputs": np.concatenate([u, np.stack([along, across, spin, a, b, d["nu"]], 1), even,
                                      odd], 1),
            "march": march, "truth": truth, "u": np.sqrt(squared), "unlike": unlike}


def rows(data, chosen):
    return {name: column[chosen] for name, column in data.items()}


def network(p, x):
    for weights, bias in p[:-1]:
        x = x @ weights + bias
        x = x * jax.lax.rsqrt(1 + x * x)
    weights, bias = p[-1]
    return x @ weights + bias


def correction(p, x, v, o, ellipse, form):
    c = network(p, x)
    parts = []
    for k, gate in ((0, ellipse), (5, form)):
        parts.append(gate[:, None] * jnp.stack(
            [c[:, k] * v[:, 0], c[:, k + 1] * v[:, 1] + c[:, k + 2] * v[:, 2],
             c[:, k + 3] * v[:, 2] + c[:, k + 4] * v[:, 1]], 1))
    k = 10
    along = sum(o[:, j] * (c[:, k + 2 * j] * v[:, 1] + c[:, k + 2 * j + 1] * v[:, 2])
                for j in range(SIDES))
    k += 2 * SIDES
    across = v[:, 0] * (o * c[:, k:k + SIDES]).sum(1)
    k += SIDES
    moment = v[:, 0] * (o * c[:, k:k + SIDES]).sum(1)
    return parts[0] + parts[1] + form[:, None] * jnp.stack([along, across, moment], 1)


def columns(data, scaling):
    mean, spread, side = scaling
    return [jnp.array(column, jnp.float32) for column in
            ((data["x"] - mean) / spread, data["v"], data["odd"] / side, data["ellipse"],
             data["form"], data["missing"])]


def fit(data, steps, seed=SEED):
    """Weights of the network, and the scaling of its inputs."""
    scaling = data["x"].mean(0), data["x"].std(0), data["odd"].std(0)
    all_columns = columns(data, scaling)
    sizes = (data["x"].shape[1], HIDDEN, HIDDEN, OUTPUTS)
    keys = jax.random.split(jax.random.PRNGKey(seed), len(sizes))
    p = [(jax.random.normal(key, (n, m)) / math.sqrt(n), jnp.zeros(m))
         for key, n, m in zip(keys, sizes[:-1], sizes[1:], strict=False)]
    p[-1] = (0.1 * p[-1][0], p[-1][1])
    solver = optax.adamw(optax.cosine_decay_schedule(RATE, steps), weight_decay=1e-5)
    state = solver.init(p)
    n = len(data["missing"])

    def loss(p, x, v, o, ellipse, form, missing):
        left = correction(p, x, v, o, ellipse, form) - missing
        return jnp.mean(jnp.sqrt(left**2 + ROUND**2)) + SQUARES * jnp.mean(left**2)

    @jax.jit
    def run(p, state, key):
        def step(carry, key):
            p, state = carry
            chosen = jax.random.randint(key, (BATCH,), 0, n)
            gradient = jax.grad(loss)(p, *(column[chosen] for column in all_columns))
            update, state = solver.update(gradient, state, p)
            return (optax.apply_updates(p, update), state), None
        return jax.lax.scan(step, (p, state), jax.random.split(key, 1000))[0]

    key = keys[-1]
    begin = time.monotonic()
    for done in range(0, steps, 1000):
        key, now = jax.random.split(key)
        p, state = run(p, state, now)
        if done % 10000 == 0:
            print(f"fit-forces: {done + 1000} of {steps} steps, {time.monotonic() - begin:.0f} s",
                  file=sys.stderr, flush=True)
    return p, scaling


def left_over(fitted, data):
    """Errors of the corrected forces, in parts of mu N and mu N sqrt(ab)."""
    p, scaling = fitted
    *inputs, missing = columns(data, scaling)
    return np.array(correction(p, *inputs) - missing, float)


def figures(errors):
    """Mean, 95th percentile and worst in percent, for Fx, Fy, Mz."""
    size = 100 * np.abs(errors)
    return [[round(float(value), 3) for value in
             (column.mean(), np.percentile(column, 95), column.max())] for column in size.T]


def folded(fitted):
    """The network's layers with the scaling of the inputs in the first."""
    p, (mean, spread, side) = fitted
    layers = [(np.array(weights, float), np.array(bias, float)) for weights, bias in p]
    weights = layers[0][0] / spread[:, None]
    layers[0] = weights, layers[0][1] - mean @ weights
    return layers, side


def rounded(values):
    return [float(f"{value:.7g}") for value in np.asarray(values).ravel()]


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("features", type=pathlib.Path)
    parser.add_argument("--leave-out", action="append", default=[], metavar="FAMILY+FAMILY")
    parser.add_argument("--steps", type=int, default=100000)
    parser.add_argument("--residuals", type=pathlib.Path, metavar="FILE.npz",
                        help="keep the errors on families that were left out")
    parser.add_argument("-o", type=pathlib.Path, default=TARGET, dest="target")
    options = parser.parse_args()
    data = contacts(options.features)
    fitted_rows = data["number"] % VALIDATION != 0
    report = {}
    out = np.full_like(data["missing"], np.nan)
    for words in options.leave_out:
        away = np.isin(data["family"], words.split("+"))
        result = fit(rows(data, fitted_rows & ~away), options.steps)
        out[away] = left_over(result, rows(data, away))
        for family in words.split("+"):
            mine = data["family"] == family
            report[f"left out: {family}"] = {"rows": int(mine.sum()),
                                             "march": figures(data["missing"][mine]),
                                             "corrected": figures(out[mine])}
            print(family, report[f"left out: {family}"], flush=True)
    if options.residuals:
        np.savez(options.residuals, left=out, **data)
    result = fit(rows(data, fitted_rows), options.steps)
    errors = left_over(result, data)
    ellipse = data["family"] == "ellipse"
    for name, mine in (("fitted", fitted_rows), ("validation, ellipses", ~fitted_rows & ellipse),
                       ("validation, others", ~fitted_rows & ~ellipse)):
        report[name] = {"rows": int(mine.sum()), "march": figures(data["missing"][mine]),
                        "corrected": figures(errors[mine])}
        print(name, report[name], flush=True)
    layers, side = folded(result)
    text = {
        "what": "what FASTSTRIP misses of the creep forces, fitted by tools/fit_forces.py",
        "contacts": int(len(np.unique(data["number"]))), "rows": int(len(errors)),
        "steps": options.steps, "seed": SEED, "batch": BATCH, "rate": RATE,
        "percent of mu N, mu N sqrt(ab): mean, 95th percentile, worst of Fx, Fy, Mz": report,
        "half_shape": HALF_SHAPE, "even_scale": rounded(EVEN_SCALE),
        "odd_scale": rounded(ODD_SCALE), "side_scale": rounded(side),
        "largest_log_ratio": round(float(np.abs(data["x"][:, 5]).max()), 3),
        "largest_shape": round(float(np.percentile(np.sqrt(data["unlike"]), 99.9)), 3),
        "least_poisson": round(float(data["x"][:, 6].min()), 3),
        "largest_poisson": round(float(data["x"][:, 6].max()), 3),
        "layers": [{"inputs": weights.shape[0], "outputs": weights.shape[1],
                    "weights": rounded(weights), "bias": rounded(bias)}
                   for weights, bias in layers],
    }
    options.target.write_text(json.dumps(text, indent=1) + "\n", encoding="utf-8")
    write_samples(options.target.with_suffix(".csv"), result, data)
    return 0


def write_samples(path, fitted, data):
    """What the network gives for some contacts, for a test of the module that evaluates it."""
    chosen = np.random.default_rng(SEED).choice(
        np.flatnonzero((data["u"] < SLIDING[0]) & (data["unlike"] < 10)), SAMPLES, replace=False)
    some = rows(data, chosen)
    given = left_over(fitted, some) + some["missing"]
    names = ["u1", "u2", "u3", "cksi", "ceta", "cphi_rad_per_mm", "a_mm", "b_mm", "nu",
             *(f"even{k}" for k in range(1, EVEN + 1)), *(f"odd{k}" for k in range(1, ODD + 1)),
             "Fx_over_muN", "Fy_over_muN", "Mz_over_muNc"]
    with open(path, "w", newline="", encoding="utf-8") as stream:
        stream.write("# forces that FASTSTRIP misses, by the fit in force_correction.json; "
                     "written by tools/fit_forces.py; creepages and moment about the centroid\n")
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(names)
        for inputs, forces in zip(some["inputs"], given, strict=True):
            writer.writerow([*(f"{value:.12g}" for value in inputs),
                             *(f"{value:.9g}" for value in forces)])


if __name__ == "__main__":
    sys.exit(main())
