"""What Python says of the package: every public thing is told in numpydoc's sections, each argument
and each figure by its name, figures with the unit that tables of them have."""

import dataclasses
import importlib
import inspect
import re

from installed import HostTest

# Written otherwise in words than as UDUNITS has it.
UNITS = {"mm2": "mm^2", "mm-1": "1/mm", "mm s-1": "mm/s", "rad mm-1": "rad/mm",
         "N mm-2": "N/mm^2", "ug m-1": "ug per metre", "mm3 m-1": "mm^3 per metre",
         "degC": "C"}
SECTION = re.compile(r"^(\w+)\n-{3,}\n", re.MULTILINE)


def sections_of(thing):
    """The sections of a docstring: names that stand before them, and what is said below."""
    parts = SECTION.split(inspect.getdoc(thing) or "")
    found = {}
    for title, text in zip(parts[1::2], parts[2::2]):
        rows = re.split(r"^(?=\S)", text.replace("\\\n", ""), flags=re.MULTILINE)
        items = {}
        for row in filter(str.strip, rows):
            head, _, below = row.partition("\n")
            names, _, kind = head.partition(" : ")
            for name in names.split(","):
                items[name.strip()] = kind + " " + " ".join(below.split())
        found[title] = items
    return parts[0], found


def arguments_of(function):
    return [("**" if one.kind is one.VAR_KEYWORD else "") + one.name
            for one in inspect.signature(function).parameters.values()
            if one.name not in ("self", "cls")]


class Docstrings(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.faststrip = cls.import_package()
        cls.units = {name: unit for name, (unit, *_) in importlib.import_module(
            "faststrip._tables").QUANTITIES.items()}
        public = [getattr(cls.faststrip, name) for name in cls.faststrip.__all__]
        cls.classes = [one for one in public if inspect.isclass(one)
                       and not issubclass(one, Exception)]
        cls.functions = [one for one in public if inspect.isfunction(one)]

    def check_arguments(self, thing, told, wanted):
        _, sections = told
        with self.subTest(thing):
            self.assertEqual(sorted(sections.get("Parameters", {})), sorted(wanted))

    def methods(self):
        for one in self.classes:
            for name, method in inspect.getmembers(one, callable):
                if (not name.startswith("_") or name == "__call__") and name != "_rows" \
                        and inspect.isroutine(method):
                    yield f"{one.__name__}.{name}", method

    def test_arguments_are_told_by_their_names(self):
        self.assertGreater(len(self.classes), 15)
        for function in self.functions:
            self.check_arguments(function.__name__, sections_of(function), arguments_of(function))
        count = 0
        for name, method in self.methods():
            count += 1
            self.check_arguments(name, sections_of(method), arguments_of(method))
        self.assertGreater(count, 30)
        for one in self.classes:
            if "Attributes" not in sections_of(one)[1] or not dataclasses.is_dataclass(one):
                self.check_arguments(one.__name__, sections_of(one), arguments_of(one))

    def test_what_comes_back_is_told(self):
        things = {function.__name__: function for function in self.functions}
        things.update(self.methods())
        for name, thing in things.items():
            with self.subTest(name):
                answer = inspect.signature(thing).return_annotation
                first, sections = sections_of(thing)
                self.assertRegex(first.splitlines()[0], r"^[A-Z].*\.$|^[A-Z].*[^.]$")
                if answer not in ("None", None, "str"):
                    self.assertIn("Returns", sections)

    def test_figures_are_told_with_their_units(self):
        count = 0
        for one in self.classes:
            attributes = sections_of(one)[1].get("Attributes")
            if attributes is None or not dataclasses.is_dataclass(one):
                continue
            names = [each.name for each in dataclasses.fields(one)]
            self.assertEqual(sorted(attributes), sorted(names), one.__name__)
            for each in dataclasses.fields(one):
                text, unit = attributes[each.name], self.units.get(each.name, "1")
                with self.subTest(f"{one.__name__}.{each.name}"):
                    if "Array" in str(each.type) or "NDArray" in str(each.type):
                        self.assertIn("ndarray of", text)
                    if unit != "1":
                        count += 1
                        self.assertIn(UNITS.get(unit, unit), text)
        self.assertGreater(count, 80)

    def test_results_are_dataclasses_that_unpack(self):
        np = importlib.import_module("numpy")
        y = np.linspace(-15.0, 15.0, 301)
        contact = self.faststrip.Contact(with_elements=True)
        contact.set_gap(y, 2e-3 * y**2, 1.0 / 920.0)
        result = contact.solve(load=1e5, creepage=(1e-3, 5e-4, 0.0))
        gap = self.faststrip.profile_gap("s1002", "60e1")
        wheels = self.faststrip.Wheelset().solve(axle_load=1e5)
        for found in (contact.strips(), contact.elements(), contact.strip_wear(), contact.wear(),
                      gap, wheels, wheels.contacts[0], result):
            with self.subTest(type(found).__name__):
                names = [one.name for one in dataclasses.fields(found)]
                self.assertEqual(len(found), len(names))
                for k, (name, value) in enumerate(zip(names, found, strict=True)):
                    self.assertIs(value, getattr(found, name))
                    self.assertIs(found[k], value)
                    # The name of releases before.
                    self.assertIs(found._asdict()[name], value)
                    with self.assertRaises(dataclasses.FrozenInstanceError):
                        setattr(found, name, value)
        y_left, *_, patch = contact.strips()
        np.testing.assert_array_equal(y_left, contact.strips().y_left)
        self.assertEqual(patch.dtype, np.int32)
        self.assertEqual(gap._replace(radius=1.0).radius, 1.0)
        self.assertEqual(len(gap[:4]), 4)
        many = self.faststrip.solve_many(gap, load=[1e5])
        listed = self.faststrip.solve_many([gap], load=[1e5])
        contact.set_gap(*gap[:4])
        self.assertEqual((many.pmax[0], listed.pmax[0]), (contact.solve(load=1e5).pmax,) * 2)
