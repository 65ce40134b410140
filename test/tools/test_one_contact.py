"""One contact: no second type holds what presses two bodies together, or a gap and its load."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# What else may say whether a load or a penetration is given: the C struct, which cannot extend a
# Fortran type; and which Jacobian is kept.
OTHERS = {"c_case_t", "newton_workspace_t"}

# The solvers of methods.
SOLVERS = ("strip_solve", "strip_solve_demand", "strip_solve_penetration", r"hertz_solve_gap\w*",
           "kpec_solve", "kpec_strips_solve", "analyn_solve", "replace_by_ellipses",
           "faststrip_tangential_solve", "paper_solve", "corrected_solve", r"fastsim\w*_solve",
           "law_solve", "law_strips_solve", r"norm_solve\w*", "tang_solve", "solve_dissimilar")
# Who calls one of them besides solve_contact.
STUDIES = {
    # procedures without a workspace
    "src/faststrip/interop/classic.f90",
    # a map of creepages, from which searches of forces start
    "src/faststrip/tangential/force_map.f90",
    # its rows, in the plane or on a curved surface
    "src/faststrip/tangential/fastsim.f90",
    *(f"app/lab/{path}.f90" for path in (
        # a solver alone: its times from the last solution on, its floating-point flags, rounding,
        # the cells that strips fall back to
        "grid/normal", "grid/steps", "grid/errors", "fuzz/run", "extremes/noise",
        # the paper as printed; what a march misses; other forces on strips that were recorded
        "studies/errata", "studies/correction", "forces/features",
        # references by Kalker's methods, on grids and pressures of their own
        "forces/reference", "grid/tang", "pressures", "claims/reference",
        "studies/estimates_reference", "studies/kalker", "studies/reference",
        "studies/reference_scenes", "studies/reference_tang", "studies/rolling"))}


def types():
    """Name, what it extends, and the components of every derived type in the sources."""
    for folder in ("src", "app"):
        for path in sorted((ROOT / folder).rglob("*.f90")):
            text = re.sub(r"!.*", "", path.read_text(encoding="utf-8"))
            text = re.sub(r"&\s*\n", " ", text)
            for head, name, body in re.findall(
                    r"^ *type\b([^:(\n]*(?:\([^)\n]*\))?[^:\n]*)::\s*(\w+)\s*\n(.*?)^ *end type",
                    text, re.MULTILINE | re.DOTALL):
                base = re.search(r"extends\s*\((\w+)\)", head)
                components = {}
                for kind, names in re.findall(r"^\s*(\w[^\n]*?)::\s*([^\n]*)$", body,
                                              re.MULTILINE):
                    for word in re.findall(r"(\w+)\s*(?:\([^)]*\))?\s*(?:=[^,]*)?(?:,|$)", names):
                        components[word] = kind
                yield path.relative_to(ROOT), name, base and base.group(1), components


class OneContact(unittest.TestCase):
    def test_types_are_found(self):
        found = {name: base for _, name, base, _ in types()}
        self.assertGreater(len(found), 60)
        self.assertEqual(found["contact_terms_t"], "demand_t")
        self.assertEqual(found["contact_case_t"], "contact_terms_t")
        self.assertEqual(found["case_t"], "settings_t")
        for name in ("settings_t", "prepared_case_t", "bench_case_t",
                     "fuzz_case_t"):
            self.assertEqual(found[name], "contact_case_t", name)

    def test_one_type_says_what_is_prescribed(self):
        told = {name for _, name, _, components in types() if "by_load" in components}
        self.assertEqual(told - OTHERS, {"demand_t"})

    def test_a_gap_under_a_load_is_a_contact(self):
        for path, name, base, components in types():
            with self.subTest(str(path), type=name):
                has_gap = any("gap_t" in kind for kind in components.values())
                pressed = {"load", "penetration", "demand"} & set(components)
                self.assertFalse(has_gap and pressed and base != "demand_t", (pressed, base))

    def test_no_two_arguments_say_it(self):
        for folder in ("src", "app"):
            for path in sorted((ROOT / folder).rglob("*.f90")):
                text = path.read_text(encoding="utf-8")
                for names in re.findall(r"\bsubroutine \w+\(((?:[^)]|\n)*)\)", text):
                    words = set(re.findall(r"\w+", names))
                    self.assertFalse({"by_load", "load"} <= words or {"by_load", "target"} <= words,
                                     f"{path}: {names}")

    def test_nobody_else_calls_a_method(self):
        """Pressures and forces come from solve_contact. Solvers below it call each other; who calls
        one besides is a study of that method, a reference by Kalker's, or an interface of its own.
        """
        called = re.compile(rf"\bcall ({'|'.join(SOLVERS)})\b")
        callers = {path.relative_to(ROOT).as_posix()
                   for folder in ("src", "app") for path in (ROOT / folder).rglob("*.f90")
                   if called.search(re.sub(r"!.*", "", path.read_text(encoding="utf-8")))}
        below = ("src/faststrip/contact/method/", "src/faststrip/normal/", "src/kalker/")
        self.assertGreater(len(callers), len(STUDIES))
        self.assertEqual({path for path in callers if not path.startswith(below)}, STUDIES)
