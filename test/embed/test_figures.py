"""Every figure of every interface is that of the Fortran interface, bit for bit: dissimilar bodies,
gaps without symmetry, all creepages, every method, every field of every struct and array."""

import math
import random
import sys

import methods
from installed import HOSTS, HostTest

# Those of the core, by name.
NORMAL, TANGENTIAL = methods.listed("normal"), methods.listed("tangential")
ESTIMATES = ("est_err_penetration", "est_err_pmax", "est_err_area", "residual_inside",
             "overlap_outside")
FORCE_ESTIMATES = ("est_err_fx", "est_err_fy", "est_err_mz", "est_err_cksi", "est_err_ceta")
# What came of auto, but its steps.
TAKEN = ("n_steps", "best_step", "target_is_known", "target_is_met", "est_err_target")
TARGETS = (None, "forces", "pmax", "penetration", "area", "power")
FORCES_ONLY = {name for name, method in TANGENTIAL.items() if not method.gives_elements}
# Bodies, friction, load, penetration, creepages: no two alike, the second demand unlike the first.
FIRST = (2.1e5, 1.584e5, 0.27, 0.335, 0.31, 7.3e4, 0.061, 1.3e-3, -7e-4, 1.7e-4)
SECOND = (1.9e5, 2.3e5, 0.31, 0.24, 0.23, 6.1e4, 0.047, -9e-4, 1.6e-3, -2.3e-4)
CLASSIC = {
    "fastsim": ((6.1, 4.3, 7.9e4, 4.4, 3.8, 1.6, 1e-3, 5e-4, 2e-4, 0.31, 9e4, 17, 9),
                (3.2, 5.9, 8.3e4, 3.6, 3.1, 1.2, -7e-4, 9e-4, -1e-4, 0.23, 6e4, 8, 21),
                (5.0, 4.0, 8.0e4, 4.1, 3.7, 1.4, 2e-4, -3e-4, 9e-4, 0.4, 5e4, 12, 13),
                (0.0, 4.3, 7.9e4, 4.4, 3.8, 1.6, 1e-3, 5e-4, 2e-4, 0.31, 9e4, 17, 9),
                (6.1, 4.3, 7.9e4, 4.4, 3.8, 1.6, 1e-3, 5e-4, 2e-4, 0.31, -9e4, 17, 9)),
    "hertz": ((2.1e5, 1.43e5, 0.27, 0.335, 1.1e-3, 2.3e-3, 9e4),
              (1.9e5, 2.3e5, 0.31, 0.24, 2.7e-3, 4e-4, 6e4),
              (2.0e5, 2.1e5, 0.2, 0.29, 1e-3, 9e-4, 1e5),
              (2.1e5, 1.43e5, 0.27, 0.335, -1.1e-3, 2.3e-3, 9e4),
              (2.1e5, 0.0, 0.27, 0.335, 1.1e-3, 2.3e-3, 9e4)),
    "kalker": ((1.7, 0.27), (0.3, 0.24), (1.0, 0.335), (0.0, 0.27), (1.7, 0.9)),
}


def name_of(table, number):
    return next(name for name, method in table.items() if method.number == number)


def lopsided(y):
    return 2.1e-3 * y * y + 3e-5 * y**3 + 4e-3 * y


def valleys(y):
    return 4e-5 * (y * y - 40.0)**2 + 3e-4 * y


def gap(height, first, last, n):
    """y, h, inv2r, turn of points that lie the denser the farther right."""
    rows = []
    for i in range(n):
        part = i / (n - 1)
        y = first + (last - first) * part * (1.2 - 0.2 * part)
        rows.append((y, height(y), (1.0 + 0.011 * y) / 903.0, 0.08 * y + 1e-3 * y * y))
    return rows


def rough_gap():
    """An ellipse's gap, a point every 0.1 mm, with 0.5 um of noise."""
    source = random.Random(7)
    rows = ((0.1 * i, source.gauss(0.0, 5e-4)) for i in range(-150, 151))
    return [(y, 2e-3 * y * y + noise, 1.0 / 920.0, 0.0) for y, noise in rows]


# Estimate errors, and the limit from which on they are named: the default, others for a rough gap.
USUAL = (1, 0.1)
ROUGH = (USUAL, (1, 1e9), (0, 0.1), (1, 0.02))
# Target and tolerance of auto.
WANTED = (1, 0.02)


def contacts():
    """normal, tangential, strips, points, nx, ny, by load, elements, turn, estimate, limit,
    target, tolerance, demands, gap: the rough ones first."""
    for estimate in ROUGH:
        yield ("strip", "faststrip", 15, 6, 7, 11, 1, 0, 0, *estimate, *WANTED, FIRST, SECOND,
               rough_gap())
    for *numbers, first, second, rows in smooth_contacts():
        yield (*numbers, *USUAL, *WANTED, first, second, rows)
    usual = gap(lopsided, -14.0, 17.0, 201)
    for normal in (name for name in NORMAL if name != "auto"):
        for estimate in ((0, 0.1), (1, 1e-9), (1, -0.1)):
            yield (normal, "faststrip", 8, 6, 7, 11, 1, 0, 0, *estimate, *WANTED, FIRST, SECOND,
                   usual)
    yield from auto_contacts(usual)


def auto_contacts(usual):
    """Every target; both demands; what is missed; ellipses that are enough; other tangential
    methods, also none, which the target of forces refuses; nothing wanted, which is refused."""
    ellipse = gap(lambda y: 2e-3 * y * y, -14.0, 14.0, 201)
    for tangential, by_load, elements, target, tolerance, rows in (
            ("faststrip", 1, 0, *WANTED, usual), ("faststrip", 0, 1, 2, 3e-3, usual),
            ("faststrip-plain", 1, 1, 3, 3e-3, usual), ("fastsim", 1, 1, 4, 5e-3, usual),
            ("faststrip", 1, 1, 5, 0.03, usual), ("polach", 1, 0, 5, 0.04, usual),
            ("faststrip", 1, 1, 1, 1e-5, usual), ("faststrip", 1, 0, 2, 1e-7, rough_gap()),
            ("faststrip", 1, 1, 1, 0.05, gap(valleys, -13.0, 14.0, 181)),
            ("faststrip", 1, 1, *WANTED, ellipse), ("none", 1, 0, 4, 0.01, usual),
            ("none", 1, 0, *WANTED, usual), ("faststrip", 1, 0, 1, 0.0, usual)):
        yield ("auto", tangential, 8, 6, 7, 11, by_load, elements, 0, *USUAL, target, tolerance,
               FIRST, SECOND, rows)


def smooth_contacts():
    """The same without estimate and limit."""
    usual = gap(lopsided, -14.0, 17.0, 201)
    for normal in (name for name in NORMAL if name != "auto"):
        for tangential in TANGENTIAL:
            yield (normal, tangential, 11, 7, 13, 9, 1, int(tangential not in FORCES_ONLY), 0,
                   FIRST, SECOND, usual)
    for normal in (name for name in NORMAL if name != "auto"):
        for by_load in (0, 1):
            for rows in (usual, gap(valleys, -13.0, 14.0, 181)):
                yield (normal, "faststrip", 9, 5, 7, 11, by_load, 0, 0, SECOND, FIRST, rows)
    yield ("strip", "faststrip", 0, 6, 7, 11, 1, 1, 0, FIRST, SECOND, usual)
    yield ("strip", "fastsim", 12, 6, 5, 17, 0, 1, 0, FIRST, SECOND, usual)
    # A surface that turns much; points that end in the contact; an error, then none.
    yield ("strip", "faststrip", 8, 6, 7, 11, 1, 1, 1, FIRST, SECOND, usual)
    yield ("hertz", "fastsim", 8, 6, 7, 11, 1, 0, 1, FIRST, SECOND, usual)
    yield ("strip", "faststrip", 8, 6, 7, 11, 1, 1, 0, FIRST, SECOND, usual[60:105])
    yield ("strip", "faststrip", 8, 6, 7, 11, 1, 1, 0, (*FIRST[:5], -7.0, *FIRST[6:]), SECOND,
           usual)
    yield ("strip", "faststrip", 8, 6, 7, 11, 0, 1, 0, FIRST, (*SECOND[:6], -0.3, *SECOND[7:]),
           usual)


def input_text():
    rows = list(contacts())
    lines = [str(len(rows))]
    for normal, tangential, *numbers, first, second, points in rows:
        lines.append(" ".join(map(str, (normal, tangential, NORMAL[normal].number,
                                        TANGENTIAL[tangential].number, *numbers, len(points)))))
        lines += [" ".join(map(repr, row)) for row in (first, second, *points)]
    for values in (*CLASSIC["fastsim"], *CLASSIC["hertz"], *CLASSIC["kalker"]):
        lines.append(" ".join(map(repr, values)))
    return "\n".join(lines) + "\n"


def figures(text):
    """What a program printed: numbers by name, contact, step and index; words by name and place."""
    found = {}
    for line in text.splitlines():
        name, *places = line.split()
        if name in ("message", "word"):
            _, contact, step, *words = line.split(None, 3)
            found[name, int(contact), int(step), 0] = " ".join(words).strip()
        else:
            contact, step, i, value = places
            found[name, int(contact), int(step), int(i)] = float(value)
    return found


class Figures(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.faststrip = cls.import_package()
        cls.write("contacts.txt", input_text())
        cls.shell(f"gfortran -O1 -J. '{HOSTS}/figures.f90' $(pkg-config --cflags --libs faststrip)"
                  " -o by_fortran")
        cls.wanted = figures(cls.shell("./by_fortran <contacts.txt"))
        cls.contacts = list(contacts())

    def same(self, found, left_out=lambda name, contact: False):
        """What is wanted, and the number of strips in the result, is found, and nothing else."""
        wanted = {key: value for key, value in self.wanted.items() if not left_out(*key[:2])}
        for key in [key for key in found if key[0] == "result_n_strips"]:
            self.assertEqual(found.pop(key), wanted["n_strips", *key[1:]], key)
        self.assertEqual(sorted(set(wanted) ^ set(found))[:9], [])
        self.assertEqual([(key, wanted[key], found[key]) for key in wanted
                          if wanted[key] != found[key]][:9], [])

    def test_the_contacts_tell_figures_apart(self):
        """In most contacts no two figures are equal, so that none can stand for another."""
        names = ("load", "penetration", "area", "pmax", "y_min", "y_max", "x_max", "fx", "fy", "mz",
                 "friction_power", "stick_fraction", "n_patches", "n_strips", "iterations",
                 "n_elements", *ESTIMATES, "est_err_fx", "est_err_mz")
        apart = 0
        for contact in range(1, len(self.contacts) + 1):
            values = [self.wanted[name, contact, 1, 0] for name in names]
            self.assertTrue(all(map(math.isfinite, values)))
            apart += len(set(values)) == len(names)
        self.assertGreater(apart, 5)
        forces = FORCE_ESTIMATES[:3]
        self.assertGreater(sum(len({self.wanted[name, contact, 1, 0] for name in forces})
                               == 3 for contact in range(1, len(self.contacts) + 1)), 5)
        statuses = {value for key, value in self.wanted.items() if key[0] == "status"}
        self.assertLessEqual({0.0, 2.0, 6.0, 8.0, 100.0, 105.0}, statuses)
        # A set holds the status, and some hold more.
        sets = [(value, self.wanted["status", *key[1:]])
                for key, value in self.wanted.items() if key[0] == "limitations"]
        for value, status in sets:
            self.assertEqual(int(value) >> int(status) & 1 if 0 < status < 100 else value == 0.0, 1)
        self.assertGreater(sum(value.bit_count() > 1 for value in (int(one) for one, _ in sets)), 0)
        self.assertGreater(sum(value not in (0.0, self.wanted["n_strips", *key[1:]])
                               for key, value in self.wanted.items() if key[0] == "strips_across"),
                           9)
        self.assertGreater(sum(key[0] == "element_px" and value != 0.0
                               for key, value in self.wanted.items()), 1000)

    def test_a_rough_gap_is_told_unless_it_is_not_to_be(self):
        found = [[self.wanted[name, contact, 1, 0] for name in (*ESTIMATES, "is_estimated")]
                 for contact in range(1, len(ROUGH) + 1)]
        self.assertEqual([self.wanted["status", contact, 1, 0]
                          for contact in range(1, len(ROUGH) + 1)], [8.0, 0.0, 0.0, 8.0])
        self.assertGreater(found[0][1], 0.1)
        self.assertEqual(found[1], found[0])
        self.assertEqual(found[2], [0.0] * 6)
        self.assertIn("above 0.200000E-1: ", self.wanted["message", 4, 1, 0])
        refused = {self.wanted["message", contact, 1, 0]
                   for contact, row in enumerate(self.contacts, 1) if row[10] < 0.0}
        self.assertEqual(refused, {"the resolution limit must be above 0, got -0.100000"})

    def test_auto_meets_and_misses_by_all_kinds_of_steps(self):
        first = {key[1]: value for key, value in self.wanted.items()
                 if key[0] == "n_steps" and key[2] == 1 and value > 0.0}
        auto = {i for i, row in enumerate(self.contacts, 1) if row[0] == "auto"}
        self.assertEqual(auto - set(first), {len(self.contacts) - 1, len(self.contacts)})
        self.assertLessEqual(set(first), auto)
        self.assertLessEqual({1.0, 2.0, 3.0}, set(first.values()))
        self.assertEqual({self.wanted["status", i, 1, 0] for i in auto}, {0.0, 7.0, 100.0})
        self.assertEqual({self.wanted["target_is_met", i, 1, 0] for i in first}, {0.0, 1.0})
        self.assertEqual({self.wanted["step_normal", i, 1, self.wanted["best_step", i, 1, 0]]
                          for i in first}, {1.0, 2.0})
        # Where the last step is not the best, where the elements are those of another method.
        self.assertTrue(any(self.wanted["best_step", i, 1, 0] < count
                            for i, count in first.items()))
        self.assertGreater(sum(self.wanted["n_elements", i, 1, 0] > 0.0 for i in first), 4)
        self.assertEqual([self.wanted["message", len(self.contacts) - i, 1, 0] for i in (1, 0)],
                         ["the target forces needs a tangential method, got none",
                          "a tolerance or a budget must be given, both are 0"])

    def test_c(self):
        self.shell(f"gcc -O1 -Wall -Wextra -Werror '{HOSTS}/figures.c'"
                   " $(pkg-config --cflags --libs faststrip) -o by_c")
        self.same(figures(self.shell("./by_c <contacts.txt")),
                  lambda name, contact: name == "shear_modulus")

    def test_f77(self):
        self.shell(f"gfortran -std=legacy -Wall -O1 '{HOSTS}/figures.f'"
                   " $(pkg-config --libs faststrip) -o by_f77")
        turning = {i for i, row in enumerate(self.contacts, 1) if row[8]}
        self.assertEqual(len(turning), 2)
        # FSLIMT and FSWANT refuse at once what a limit and a tolerance cannot be: test_legacy.
        refused = {i for i, row in enumerate(self.contacts, 1) if row[10] < 0.0 or row[12] <= 0.0}
        self.same(figures(self.shell("./by_f77 <contacts.txt")),
                  lambda name, contact: name in (
                      "shear_modulus", "iterations", "default_penetration", "default_estimate",
                      "default_resolution_limit", "default_force_limit", "default_target",
                      "default_tolerance", "default_budget_us")
                  or contact in turning or contact in refused)

    def test_python(self):
        found = {}
        for number, row in enumerate(self.contacts, 1):
            self.by_python(found, number, *row)
        self.classic_by_python(found)
        self.same(found, lambda name, contact: name.startswith("default_") or name == "word")

    def by_python(self, found, number, normal, tangential, strips, points, nx, ny, by_load,
                  elements, turn, estimate, limit, target, tolerance, first, second, rows):
        faststrip = self.faststrip
        options = {"normal": normal, "tangential": tangential, "strips_per_patch": strips or "auto",
                   "points_per_strip": points, "fastsim_grid": (nx, ny),
                   "with_elements": elements == 1, "max_points": len(rows),
                   "estimate": estimate == 1, "resolution_limit": limit, "force_limit": limit}
        if limit <= 0.0:
            # Refused at once, by a name of its own.
            with self.assertRaisesRegex(faststrip.FaststripError,
                                        f"resolution_limit .*got {limit}"):
                faststrip.Contact(**options)
            found.update((key, value) for key, value in self.wanted.items() if key[1] == number)
            return
        contact, copy = faststrip.Contact(**options), faststrip.Contact(**options)
        y, h, inv2r, turns = zip(*rows)
        contact.set_gap(y, h, inv2r, turns if turn else None)

        def show_arrays(of, step):
            strips, elements = of.strips(), of.elements()
            found["n_strips", number, step, 0] = len(strips.p0)
            for what, table in (("strip", strips), ("element", elements)):
                for name, values in table._asdict().items():
                    for i, value in enumerate(values, 1):
                        found[f"{what}_{name}", number, step, i] = value

        package = sys.modules["faststrip._contact"]
        wanted = {"target": TARGETS[target], "tolerance": tolerance} if normal == "auto" else {}

        def show_steps(result, step):
            numbers = {"n_steps": len(result.steps), "est_err_target": result.est_err_target or 0.0,
                       "target_is_known": result.est_err_target is not None,
                       "target_is_met": result.target_is_met or 0, "best_step": sum(
                           i for i, one in enumerate(result.steps, 1) if one.is_best)}
            found.update({(name, number, step, 0): value for name, value in numbers.items()})
            for i, one in enumerate(result.steps, 1):
                for name, value in (
                        ("normal", package.NORMAL[one.normal]),
                        ("tangential", package.TANGENTIAL[one.tangential]),
                        ("strips", one.strips), ("points", one.points_per_strip),
                        ("estimate", -1.0 if one.estimate is None else one.estimate)):
                    found[f"step_{name}", number, step, i] = value
                self.assertGreater(one.normal_us, 0.0)
                self.assertGreaterEqual(one.tangential_us, 0.0)

        def solve(of, step, demand):
            e_wheel, e_rail, nu_wheel, nu_rail, mu, load, penetration, *creepage = demand
            try:
                result = of.solve(
                    **({"load": load} if by_load else {"penetration": penetration}),
                    creepage=tuple(creepage), mu=mu, warm_start=step > 1, **wanted,
                    material=faststrip.Material(e_wheel=e_wheel, e_rail=e_rail, nu_wheel=nu_wheel,
                                                nu_rail=nu_rail))
            except faststrip.FaststripError as problem:
                self.assertEqual(problem.word, self.wanted["word", 0, problem.status, 0])
                found["status", number, step, 0] = problem.status
                found["message", number, step, 0] = problem.message
                for name in ("load", "penetration", "area", "pmax", "y_min", "y_max", "x_max",
                             "cksi", "ceta", "fx", "fy", "mz", "friction_power",
                             "stick_fraction", "n_patches", "iterations", "n_elements",
                             "strips_across", "is_estimated", "forces_are_estimated",
                             "limitations", *ESTIMATES, *FORCE_ESTIMATES, *TAKEN):
                    found[name, number, step, 0] = 0.0
            else:
                self.assertEqual(result.word, self.wanted["word", 0, result.status, 0])
                # Words of a limitation are not handed on.
                found["message", number, step, 0] = self.wanted["message", number, step, 0]
                for name, value in vars(result).items():
                    if name not in ("word", "n_strips", "steps", "limitations", "derivatives",
                                    *TAKEN):
                        found[name, number, step, 0] = 0.0 if value is None else value
                found["limitations", number, step, 0] = float(sum(
                    1 << status for status in range(1, 13)
                    if self.wanted["word", 0, status, 0] in result.limitations))
                for flag, names in (("is_estimated", ESTIMATES),
                                    ("forces_are_estimated", FORCE_ESTIMATES)):
                    known = {getattr(result, name) is not None for name in names}
                    self.assertEqual(len(known), 1)
                    found[flag, number, step, 0] = float(known.pop())
                found["result_n_strips", number, step, 0] = result.n_strips
                show_steps(result, step)
            show_arrays(of, step)

        solve(contact, 1, first)
        copy.copy_from(contact)
        show_arrays(copy, 2)
        solve(contact, 3, second)
        solve(copy, 4, second)

    def classic_by_python(self, found):
        faststrip = self.faststrip

        def fastsim(a, b, g, c11, c22, c23, cksi, ceta, cphi, mu, load, nx, ny):
            return faststrip.fastsim(a, b, (c11, c22, c23), (cksi, ceta, cphi), mu, load,
                                     shear_modulus=g, grid=(nx, ny))

        def hertz(e_wheel, e_rail, nu_wheel, nu_rail, inv2r_x, inv2r_y, load):
            return faststrip.hertz(inv2r_x, inv2r_y, load, faststrip.Material(
                e_wheel=e_wheel, e_rail=e_rail, nu_wheel=nu_wheel, nu_rail=nu_rail))

        for function, names in ((fastsim, ("fx", "fy", "mz")),
                                (hertz, ("a", "b", "penetration", "pmax")),
                                (faststrip.kalker, ("c11", "c22", "c23", "c33"))):
            what = function.__name__
            for step, values in enumerate(CLASSIC[what], 1):
                status, answers = 0, [0.0] * len(names)
                try:
                    answers = function(*values)
                except faststrip.FaststripError as problem:
                    status = problem.status
                found[f"{what}_status", 0, step, 0] = status
                for name, value in zip(names, answers):
                    found[f"{what}_{name}", 0, step, 0] = value
        for step, values in enumerate(CLASSIC["hertz"], 1):
            e_wheel, e_rail, nu_wheel, nu_rail = values[:4]
            # By another formula: to the last bits only.
            wanted = self.wanted["shear_modulus", 0, step, 0]
            modulus = faststrip.Material(e_wheel, e_rail, nu_wheel, nu_rail).shear_modulus \
                if e_rail > 0.0 else wanted
            self.assertAlmostEqual(modulus, wanted, delta=1e-12 * wanted)
            found["shear_modulus", 0, step, 0] = wanted

    def test_the_defaults_of_python(self):
        package, material = self.faststrip, self.faststrip.Material()
        for name in ("e_wheel", "e_rail", "nu_wheel", "nu_rail"):
            self.assertEqual(getattr(material, name), self.wanted[f"default_{name}", 0, 0, 0])
        y, h, inv2r, _ = zip(*self.contacts[0][-1])
        bare, told = package.Contact(), package.Contact(
            normal=name_of(NORMAL, self.wanted["default_normal", 0, 0, 0]),
            tangential=name_of(TANGENTIAL, self.wanted["default_tangential", 0, 0, 0]),
            strips_per_patch=int(self.wanted["default_strips_per_patch", 0, 0, 0]),
            points_per_strip=int(self.wanted["default_points_per_strip", 0, 0, 0]),
            estimate=self.wanted["default_estimate", 0, 0, 0] == 1.0)
        self.assertEqual(told._case.resolution_limit,
                         self.wanted["default_resolution_limit", 0, 0, 0])
        self.assertEqual(told._case.force_limit, self.wanted["default_force_limit", 0, 0, 0])
        results = []
        for contact, friction in ((bare, {}), (told, {"mu": self.wanted["default_mu", 0, 0, 0]})):
            contact.set_gap(y, h, inv2r)
            results.append(contact.solve(load=8e4, creepage=(4e-3, 1e-3, 1e-4), **friction))
        self.assertEqual(*results)
        for normal, tangential in (("hertz", "fastsim"),):
            grid = tuple(int(self.wanted[f"default_fastsim_{name}", 0, 0, 0])
                         for name in ("nx", "ny"))
            results = []
            for options in ({}, {"fastsim_grid": grid}):
                contact = package.Contact(normal=normal, tangential=tangential, **options)
                contact.set_gap(y, h, inv2r)
                results.append(contact.solve(load=8e4, creepage=(1e-3, 1e-3, 1e-4)))
            self.assertEqual(*results)
