"""The networks that correct FASTSTRIP's forces and say how wrong they are, for their fitting.

What src/faststrip/tangential/force/correction.f90 and errors.f90 evaluate: inputs from the
columns of `faststrip-lab force-features`, layers, and how the factors make forces. jax and optax do
the fitting (tools/requirements-fit.txt).
"""

import csv
import math
import os
import sys
import time

os.environ.setdefault("XLA_FLAGS", "--xla_cpu_multi_thread_eigen=false")
import jax
import jax.numpy as jnp
import numpy as np
import optax

EVEN, ODD, SIDES = 5, 5, 3
HIDDEN = 48
# Factors: those of an ellipse's three forces and of its stick.
FACTORS = 6
# Scales of the shape's numbers: about one over what they are at most.
EVEN_SCALE = np.array([30.0, 8.0, 8.0, 8.0, 30.0])
ODD_SCALE = np.array([15.0, 5.0, 10.0, 10.0, 10.0])
HALF_SHAPE = 0.02
STRONG = 10.0
WEAK = 0.2
# How near the pole of spin is to the axes counts down to this, squared.
NEAR = 0.02
SLIDING = (30.0, 300.0)
# Most that is corrected, of forces, moment and stick.
MOST = np.array([0.2, 0.2, 0.5, 0.4])
# From where a patch slides whole if it does not spin: half the linear force, slip by spin.
HALF_TRANSLATION, LITTLE_SPIN = 2.0, 0.05
BATCH = 1024
RATE = 6.0e-3
# Below this error, in parts of mu N, an error counts by its square.
ROUND = 0.002
# What the squares count beside the sizes of the errors; and what a share of stick does.
SQUARES, STICK = 20.0, 0.2
# The estimates are passed by the errors of one row in 20.
QUANTILE = 0.95
# Errors of the forces count from here on; estimates of the normal figures do within these.
SMALLEST = 1.0e-5
ESTIMATES = (1.0e-6, 1.0)


def read(path):
    with open(path, encoding="utf-8") as stream:
        rows = csv.reader(line for line in stream if line[0] != "#")
        head = next(rows)
        table = list(rows)
    columns = list(zip(*table, strict=True))
    return {name: np.array(column) if name == "family" else np.array(column, float)
            for name, column in zip(head, columns, strict=True)}


def states(path):
    """Inputs and targets, one row for each contact and creepage."""
    d = read(path)
    a, b, y = d["a_mm"], d["b_mm"], d["yc_mm"]
    force = d["mu"] * d["load_N"]
    arm = np.sqrt(a * b)

    def forces(fx, fy, mz):
        return np.stack([fx, fy, (mz + y * fx) / arm], 1) / force[:, None]

    # The extrapolation makes Fx of TANG worse, Fy and Mz better.
    reference = forces(d["Fx_fine_N"], d["Fy_tang_N"], d["Mz_tang_Nmm"])
    march = forces(d["Fx_N"], d["Fy_N"], d["Mz_Nmm"])
    fastsim = forces(d["Fx_fastsim_N"], d["Fy_fastsim_N"], d["Mz_fastsim_Nmm"])
    missing = np.concatenate([reference - march, (d["stick_fraction_fine"]
                                              - d["stick_fraction"])[:, None]], 1)
    u = np.stack([d["u1"], d["u2"], d["u3"]], 1)
    squared = (u**2).sum(1)
    v = u / np.sqrt(1 + squared)[:, None]
    even = np.stack([d[f"even{k}"] for k in range(1, EVEN + 1)], 1)
    odd = np.stack([d[f"odd{k}"] for k in range(1, ODD + 1)], 1)
    spin = d["cphi_rad_per_mm"]
    along, across = d["cksi"] - y * spin, d["ceta"]
    ellipse = ellipse_inputs(u, v, squared, along, across, spin, a, b, d["nu"], d["width"],
                             d["points"])
    shape = shape_inputs(v, even, odd)
    unlike = ((even * EVEN_SCALE)**2).sum(1) + ((odd * ODD_SCALE)**2).sum(1)
    t = np.log(np.maximum(np.sqrt(squared), 1e-30) / SLIDING[0])
    t = t / math.log(SLIDING[1] / SLIDING[0])
    centre = np.where(along**2 + across**2 > 0, along**2 + across**2, 1e-200)
    little = fade(np.sqrt(0.25 * spin**2 * (a**2 + b**2) / centre) / LITTLE_SPIN)
    march_part = fade(1 + t) * (1 - (1 - fade(np.sqrt(squared) / HALF_TRANSLATION)) * little)
    return {
        "family": d["family"], "seed": d["seed"], "number": d["number"].astype(int),
        "neck": d["neck"], "ellipse": ellipse, "shape": shape, "v": v, "odd": odd[:, :SIDES],
        "size": np.sqrt((v**2).sum(1)) * march_part,
        "form": unlike / (unlike + HALF_SHAPE) * march_part, "missing": missing,
        "fastsim": reference - fastsim, "u": np.sqrt(squared), "unlike": unlike,
        "resolution": np.log(np.stack([d["width"], d["points"], *(
            np.clip(d[f"est_err_{name}"], *ESTIMATES) for name in
            ("penetration", "pmax", "area"))], 1)),
        "inputs": np.concatenate([u, np.stack([along, across, spin, a, b, d["nu"]], 1), even, odd,
                                  np.stack([d["width"], d["points"]], 1)], 1)}


def fade(x):
    """1 up to 1, then smoothly down to 0 at 2."""
    t = np.clip(x - 1, 0, 1)
    return 1 - t**3 * (10 - t * (15 - 6 * t))


def ellipse_inputs(u, v, squared, along, across, spin, a, b, nu, width, points):
    slip = along**2 + across**2 + 0.25 * spin**2 * (a**2 + b**2)
    slip = np.where(slip > 0, slip, 1)
    lateral = across**2 + spin**2 * a**2 + NEAR * slip
    longitudinal = along**2 + spin**2 * b**2 + NEAR * slip
    some = np.where(squared > 0, squared, 1)
    return np.stack([
        v[:, 0]**2, v[:, 1]**2, v[:, 2]**2, v[:, 1] * v[:, 2], np.log1p(squared), np.log(a / b), nu,
        along**2 / slip, across**2 / slip, across * spin * a / slip, spin**2 * a * b / slip,
        np.log1p(squared / STRONG**2), np.log1p(squared / WEAK**2), u[:, 0]**2 / some,
        u[:, 1]**2 / some, u[:, 1] * u[:, 2] / some, along**2 / longitudinal, across**2 / lateral,
        across * spin * a / lateral, np.sqrt(a / b), width, 1 / points], 1)


def shape_inputs(v, even, odd):
    o = odd.T
    return np.stack([*even.T, *(o[:4] * v[:, 0] * v[:, 1]), *(o[:4] * v[:, 0] * v[:, 2]),
                     *(o[:4]**2), o[0] * o[1], o[0] * o[2]], 1)


def rows(data, chosen):
    return {name: column[chosen] for name, column in data.items()}


def joined(parts):
    return {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}


def network(p, x):
    for weights, bias in p[:-1]:
        x = x @ weights + bias
        x = x * jax.lax.rsqrt(1 + x * x)
    weights, bias = p[-1]
    return x @ weights + bias


def by_factors(c, v):
    """Forces and stick that five factors and one give."""
    return jnp.stack([c[:, 0] * v[:, 0], c[:, 1] * v[:, 1] + c[:, 2] * v[:, 2],
                      c[:, 3] * v[:, 2] + c[:, 4] * v[:, 1], c[:, 5] * (v**2).sum(1)], 1)


def of_ellipse(c, v, size):
    return size[:, None] * by_factors(c, v)


def of_shape(c, v, form, o):
    k = FACTORS
    along = sum(o[:, j] * (c[:, k + 2 * j] * v[:, 1] + c[:, k + 2 * j + 1] * v[:, 2])
                for j in range(SIDES))
    k += 2 * SIDES
    across = v[:, 0] * (o * c[:, k:k + SIDES]).sum(1)
    k += SIDES
    moment = v[:, 0] * (o * c[:, k:k + SIDES]).sum(1)
    sides = jnp.stack([along, across, moment, 0 * along], 1)
    return form[:, None] * (by_factors(c, v) + sides)


def limited(missing):
    """No more than the march ever missed: where nothing was seen, a network may say anything."""
    return missing / (1 + (missing / MOST)**4)**0.25


class Network:
    """A network with the scaling of its inputs."""

    def __init__(self, x, outputs, seed, hidden=HIDDEN):
        self.mean, self.spread = x.mean(0), np.maximum(x.std(0), 1e-9)
        sizes = (x.shape[1], hidden, hidden, outputs)
        keys = jax.random.split(jax.random.PRNGKey(seed), len(sizes))
        self.p = [(jax.random.normal(key, (n, m)) / math.sqrt(n), jnp.zeros(m))
                  for key, n, m in zip(keys, sizes[:-1], sizes[1:], strict=False)]
        self.p[-1] = (0.1 * self.p[-1][0], self.p[-1][1])
        self.key = keys[-1]

    def scaled(self, x):
        return jnp.array((x - self.mean) / self.spread, jnp.float32)

    def fit(self, x, columns, loss, steps, name):
        """Least mean of `loss(outputs, *columns)`."""
        data = [self.scaled(x), *(jnp.array(column, jnp.float32) for column in columns)]
        solver = optax.adamw(optax.cosine_decay_schedule(RATE, steps), weight_decay=1e-5)
        n = len(x)

        def cost(p, x, *some):
            return loss(network(p, x), *some)

        @jax.jit
        def run(p, state, key):
            def step(carry, key):
                p, state = carry
                chosen = jax.random.randint(key, (BATCH,), 0, n)
                gradient = jax.grad(cost)(p, *(column[chosen] for column in data))
                update, state = solver.update(gradient, state, p)
                return (optax.apply_updates(p, update), state), None
            return jax.lax.scan(step, (p, state), jax.random.split(key, 1000))[0]

        p, state, key = self.p, solver.init(self.p), self.key
        begin = time.monotonic()
        for done in range(0, steps, 1000):
            key, now = jax.random.split(key)
            p, state = run(p, state, now)
            if done % 10000 == 0:
                jax.block_until_ready(p)
                print(f"fit-forces: {name}: {done + 1000} of {steps} steps, "
                      f"{time.monotonic() - begin:.0f} s", file=sys.stderr, flush=True)
        self.p = p
        return self

    def __call__(self, x):
        return network(self.p, self.scaled(x))

    def folded(self):
        """The layers with the scaling of the inputs in the first, as the source has them."""
        layers = [(np.array(weights, float), np.array(bias, float)) for weights, bias in self.p]
        weights = layers[0][0] / self.spread[:, None]
        layers[0] = weights, layers[0][1] - self.mean @ weights
        return [{"inputs": w.shape[0], "outputs": w.shape[1], "weights": rounded(w),
                 "bias": rounded(b)} for w, b in layers]


def rounded(values):
    return [float(f"{value:.7g}") for value in np.asarray(values).ravel()]


def pinball(c, y):
    """Least where one row in 20 is above."""
    return jnp.mean(jnp.maximum(QUANTILE * (y - c), (QUANTILE - 1) * (y - c)))


def error_inputs(correction, data):
    """What the estimates of the errors depend on."""
    size = np.log(np.abs(correction(data)[:, :3]) + SMALLEST)
    return np.concatenate([data["ellipse"], data["shape"], data["resolution"], size,
                           np.log1p(data["unlike"])[:, None], data["neck"][:, None]], 1)


def misfit(left):
    left = left * jnp.array([1.0, 1.0, 1.0, STICK])
    return jnp.mean(jnp.sqrt(left**2 + ROUND**2)) + SQUARES * jnp.mean(left**2)


class Correction:
    """What the march misses: the part of an ellipse, and that of the shape."""

    def __init__(self, ellipse):
        self.ellipse = ellipse
        self.shape = self.side = None

    @classmethod
    def of_ellipses(cls, data, steps, seed):
        net = Network(data["ellipse"], FACTORS, seed)
        return cls(net.fit(data["ellipse"], [data["v"], data["size"], data["missing"]],
                           lambda c, v, size, missing: misfit(of_ellipse(c, v, size) - missing),
                           steps, "ellipses"))

    def shape_x(self, data):
        return np.concatenate([data["ellipse"], data["shape"]], 1)

    def with_shape(self, data, steps, seed, name):
        """The same, the shape's part fitted to what the ellipse's leaves."""
        new = Correction(self.ellipse)
        new.side = data["odd"].std(0)
        left = data["missing"] - np.array(self.part_of_ellipse(data))
        x = self.shape_x(data)
        net = Network(x, FACTORS + 4 * SIDES, seed)
        new.shape = net.fit(
            x, [data["v"], data["form"], data["odd"] / new.side, left],
            lambda c, v, form, o, left: misfit(of_shape(c, v, form, o) - left), steps, name)
        return new

    def part_of_ellipse(self, data):
        return of_ellipse(self.ellipse(data["ellipse"]), *(
            jnp.array(data[name], jnp.float32) for name in ("v", "size")))

    def __call__(self, data):
        """Forces over mu N, moment about the centroid over mu N sqrt(ab), share of stick."""
        total = self.part_of_ellipse(data)
        if self.shape:
            total = total + of_shape(
                self.shape(self.shape_x(data)),
                *(jnp.array(data[name], jnp.float32) for name in ("v", "form")),
                jnp.array(data["odd"] / self.side, jnp.float32))
        return limited(np.array(total, float))
