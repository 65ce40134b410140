"""One contact: no second type holds what presses two bodies together, or a gap and its load."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# What else may say whether a load or a penetration is given: the C struct, which cannot extend a
# Fortran type; and which Jacobian is kept.
OTHERS = {"c_case_t", "newton_workspace_t"}


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
        self.assertEqual(found["contact_case_t"], "demand_t")
        for name in ("case_t", "prepared_case_t", "bench_case_t", "trade_case_t", "fuzz_case_t"):
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


if __name__ == "__main__":
    unittest.main()
