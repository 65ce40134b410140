"""The functional mock-up units: valid, and with the bits of the C interface under any master."""

import importlib.util
import re
import sys
import unittest
import zipfile

import numpy as np

import blocks
from installed import ROOT, HostTest, bits

NO_FMPY = ("" if importlib.util.find_spec("fmpy")
           else "fmpy not installed: tools/requirements-fmu.txt")
KINDS = ("CoSimulation", "ModelExchange")
MOTION = ("y", "z", "roll", "yaw", "speed", "y_rate", "z_rate", "roll_rate", "yaw_rate",
          "pitch_rate", "pitch_rate_difference", "curvature")
RAIL = ("y", "z", "roll", "y_rate", "z_rate", "roll_rate")
SIDES = ("right", "left")
FORCES = [f"wheel_{side}.{what}_{axis}" for side in SIDES for what in ("force", "moment")
          for axis in "xyz"]
CONTACTS = [f"wheel_{side}.{name}" for side in SIDES for name in (
    "n_contacts", "contact[2].load", *(f"contact[1].{one}" for one in (
        "load", "fx", "fy", "mz", "pmax", "cksi", "place_y", "angle")))]
MEASURED = "worn_wheel.whl"
STATE = {"y": 2.0, "roll": 2e-5, "yaw": 1.5e-3, "speed": 2e4, "y_rate": 4.0, "yaw_rate": 2e-3,
         "pitch_rate_difference": 0.2,
         "rail_right.y": 0.3, "rail_left.z": -0.02, "rail_left.y_rate": 2.0}


def motion_of(values):
    """Arguments of Wheelset.solve for the inputs by name."""
    package = sys.modules["faststrip"]
    rails = {f"{side}_rail": package.RailState(**{name: values[f"rail_{side}.{name}"]
                                                  for name in RAIL if f"rail_{side}.{name}"
                                                  in values}) for side in SIDES}
    given = {name: values[name] for name in MOTION if name in values}
    if given.get("pitch_rate") == 0.0:
        del given["pitch_rate"]
    return {"z": 0.0, **given, **rails}


def outputs_of(result):
    """FORCES and CONTACTS of a result."""
    found = [number for side in range(2)
             for number in (*result.force[side], *result.moment[side])]
    for side in SIDES:
        mine = [one for one in result.contacts if one.side == side]
        found += [float(len(mine)), mine[1].load if len(mine) > 1 else 0.0]
        found += ([0.0] * 8 if not mine else
                  [mine[0].load, mine[0].fx, mine[0].fy, mine[0].mz, mine[0].pmax, mine[0].cksi,
                   mine[0].place[1], mine[0].contact_angle])
    return found


class Unit:
    """An instance of a unit of either version; variables by name."""

    def __init__(self, fmpy, folder, about, kind="CoSimulation"):
        self.said = []
        self.two = about.fmiVersion == "2.0"
        self.numbers = {v.name: v.valueReference for v in about.modelVariables}
        self.types = {v.name: v.type for v in about.modelVariables}
        log = ((lambda _, name, status, category, text:
                self.said.append((status, category.decode(), text.decode()))) if self.two else
               (lambda _, status, category, text:
                self.said.append((status, category.decode(), text.decode()))))
        self.fmu = fmpy.instantiate_fmu(folder, about, kind, logger=log)

    def start(self, **parameters):
        if self.two:
            self.fmu.setupExperiment()
        self.fmu.enterInitializationMode()
        self.set(parameters)
        self.fmu.exitInitializationMode()
        return self

    def _call(self, verb, name):
        kind = self.types[name]
        if self.two:
            kind = kind.replace("Enumeration", "Integer")
        return getattr(self.fmu, verb + kind.replace("Enumeration", "Int64"))

    def set(self, values):
        for name, value in values.items():
            self._call("set", name)([self.numbers[name]], [value])

    def get(self, names):
        return self._call("get", names[0])([self.numbers[name] for name in names])

    def derivatives(self, outputs, inputs, seeds):
        return self.fmu.getDirectionalDerivative([self.numbers[name] for name in outputs],
                                                 [self.numbers[name] for name in inputs], seeds)

    def state(self):
        return self.fmu.getFMUstate() if self.two else self.fmu.getFMUState()

    def restore(self, state):
        (self.fmu.setFMUstate if self.two else self.fmu.setFMUState)(state)

    def bytes_of(self, state):
        return (self.fmu.serializeFMUstate if self.two else self.fmu.serializeFMUState)(state)

    def state_of(self, data):
        return (self.fmu.deSerializeFMUstate if self.two
                else self.fmu.deserializeFMUState)(data)


@unittest.skipIf(NO_FMPY, NO_FMPY)
class Units(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.fmpy = importlib.import_module("fmpy")
        cls.failure = importlib.import_module("fmpy.fmi1").FMICallException
        cls.faststrip = cls.import_package()
        measured = ROOT / "example" / "cases" / MEASURED
        cls.shell(f"'{sys.executable}' '{ROOT}/tools/building/fmu.py' --folder ."
                  f" --prefix '{cls.installed.prefix}' '{measured}'")
        cls.files = {v: str(cls.folder / f"faststrip_wheelset_{v}.fmu") for v in (2, 3)}
        cls.about = {v: cls.fmpy.read_model_description(cls.files[v]) for v in (2, 3)}
        cls.unpacked = {v: cls.fmpy.extract(cls.files[v], str(cls.folder / f"unit %{v}"))
                        for v in (2, 3)}
        cls.rest = cls.faststrip.Wheelset().solve(axle_load=1.2e5, at_rest=True).z[0]

    def unit(self, version, kind="CoSimulation"):
        unit = Unit(self.fmpy, self.unpacked[version], self.about[version], kind)
        self.addCleanup(unit.fmu.freeInstance)
        return unit

    def here(self, **changes):
        return {**STATE, "z": self.rest, **changes}

    def failing(self, call, *values):
        with self.assertRaises(self.failure) as caught:
            call(*values)
        return caught.exception.status

    def test_they_are_valid(self):
        validation = importlib.import_module("fmpy.validation")
        for version, path in self.files.items():
            self.assertEqual(validation.validate_fmu(path), [])
            names = [v.name for v in self.about[version].modelVariables]
            self.assertEqual(names, [v.name for v in self.about[2].modelVariables])
            self.assertEqual(len(names), len(set(names)))

    def test_they_need_the_c_library_alone(self):
        for version, path in self.files.items():
            with zipfile.ZipFile(path) as archive:
                names = archive.namelist()
            folder = self.folder / f"unit %{version}"
            for name in names:
                if ".so" not in name:
                    continue
                needed = re.findall(r"NEEDED.*\[([^]]+)\]",
                                    self.shell(f"readelf -dW '{folder / name}'"))
                beside = {each.rpartition("/")[2] for each in names}
                for each in set(needed) - beside:
                    self.assertRegex(each, r"^(libc|libm|libmvec|libgcc_s|ld-linux.*)\.so")

    def simulated(self, version, kind, **start):
        """Inputs and outputs of a simulation by FMPy, row by row."""
        times = np.arange(0.0, 25.0)
        turn = 0.25 * times
        signals = {"y": 3.0 * np.sin(turn), "z": self.rest + 0.01 * np.cos(3.0 * turn),
                   "yaw": 2e-3 * np.cos(turn), "roll": 1e-5 * np.sin(turn),
                   "y_rate": 0.75 * np.cos(turn), "rail_left.z": 0.02 * np.sin(2.0 * turn),
                   "speed": 0.0 * times + 2e4}
        rows = np.array(list(zip(times, *signals.values(), strict=True)),
                        dtype=[(name, float) for name in ("time", *signals)])
        found = self.fmpy.simulate_fmu(
            self.unpacked[version], fmi_type=kind, stop_time=24.0, step_size=1.0,
            output_interval=1.0, input=rows, output=[*signals, *FORCES, *CONTACTS],
            start_values={**start, **{name: signals[name][0] for name in signals}})
        self.assertGreaterEqual(len(found), 25)
        inputs = [{name: float(row[name]) for name in signals} for row in found]
        self.assertGreater(len({one["y"] for one in inputs}), 20)
        return inputs, [[float(row[name]) for name in (*FORCES, *CONTACTS)] for row in found]

    def test_simulations_have_the_bits_of_the_c_interface(self):
        for version, kind, warm in ((2, KINDS[0], True), (2, KINDS[1], False),
                                    (3, KINDS[0], False), (3, KINDS[1], True)):
            with self.subTest(version=version, kind=kind):
                wheelset, last, expected = self.faststrip.Wheelset(mu=0.4), None, None
                inputs, outputs = self.simulated(version, kind, mu=0.4, warm_start=warm)
                for given, found in zip(inputs, outputs, strict=True):
                    if given != last:
                        expected = outputs_of(wheelset.solve(warm_start=warm, **motion_of(given)))
                    last = given
                    self.assertEqual(found, expected)
                self.assertGreater(max(row[1] for row in outputs), 1e3)

    def test_parameters_are_those_of_the_wheelset(self):
        wheel = self.faststrip.Profile.read(ROOT / "example" / "cases" / MEASURED)
        parameters = {"wheel_right.profile": MEASURED, "wheel_left.profile": "s1002",
                      "rail_right.profile": str(self.folder / "rail.csv"),
                      "rail_left.profile": "54e1", "wheel_right.radius": 455.0,
                      "wheel_left.radius": 456.0, "gauge": 1437.0, "inclination": 0.05,
                      "normal": 2, "tangential": 9, "mu": 0.25, "flange_share": 0.5,
                      "tread_angle": 0.1, "flange_angle": 0.6}
        rail = self.faststrip.draw_profile("uic60", "rail")
        self.write("rail.csv", "y_mm,z_mm\n" + "".join(f"{float(y)!r},{float(z)!r}\n"
                                                       for y, z in zip(*rail, strict=True)))
        wheelset = self.faststrip.Wheelset(
            wheel, self.faststrip.Profile.read(self.folder / "rail.csv", kind="rail"),
            wheel_left="s1002", rail_left="54e1", radius=455.0, radius_left=456.0, gauge=1437.0,
            inclination=0.05, normal="hertz", tangential="polach", mu=0.25,
            friction=self.faststrip.Friction(flange_share=0.5, tread_angle=0.1, flange_angle=0.6))
        state = self.here(z=self.rest + 0.15, **{"rail_right.y": 0.0})
        solved = wheelset.solve(**motion_of(state))
        expected = outputs_of(solved)
        self.assertGreater(solved.status, 0)
        for version in (2, 3):
            unit = self.unit(version).start(**parameters)
            unit.set(state)
            self.assertEqual(list(unit.get([*FORCES, *CONTACTS])), expected)
            statuses = unit.get([f"wheel_{side}.contact[1].status" for side in SIDES])
            self.assertEqual([self.faststrip._library.word_of(int(number)) for number in statuses],
                             [next(one.word for one in solved.contacts if one.side == side)
                              for side in SIDES])
            self.assertEqual(solved.status, max(unit.get(["wheel_right.status",
                                                          "wheel_left.status"])))
            self.assertEqual(self.failing(unit.set, {"mu": 0.3}), 3)

    def test_two_contacts_of_a_wheel(self):
        wheel = self.faststrip.Profile.read(ROOT / "example" / "cases" / MEASURED)
        state = {"y": 1.5, "z": -0.62827, "roll": -3.6224e-4, "speed": 2e4}
        expected = outputs_of(self.faststrip.Wheelset(wheel).solve(**state))
        unit = self.unit(3).start(**{"wheel_right.profile": MEASURED})
        unit.set(state)
        self.assertEqual(list(unit.get([*FORCES, *CONTACTS])), expected)
        self.assertEqual(list(unit.get(["wheel_right.n_contacts", "wheel_left.n_contacts"])),
                         [1.0, 2.0])

    def test_static_equilibrium(self):
        unit = self.unit(3).start(demand=3, axle_load=1.2e5)
        self.assertEqual(list(unit.get(["wheel_right.z", "wheel_left.z"])), [self.rest] * 2)
        self.assertAlmostEqual(sum(unit.get(["wheel_right.force_z", "wheel_left.force_z"])),
                               1.2e5, delta=1.0)

    def test_a_motion_that_fails_is_discarded_and_a_parameter_an_error(self):
        for version in (2, 3):
            unit = self.unit(version).start()
            unit.set(self.here())
            before = list(unit.get(FORCES))
            for bad in ({"yaw": 9.0}, {"y": float("nan")}):
                unit.set(bad)
                self.assertEqual(self.failing(unit.get, FORCES), 2)
                self.assertEqual(self.failing(unit.fmu.doStep, 1.0, 0.5), 2)
                self.assertIn(f"bad_argument: {next(iter(bad))} of the wheelset",
                              unit.said[-1][2])
                self.assertEqual(unit.said[-1][:2], (2, "logStatusDiscard"))
                if version == 2:
                    self.assertEqual(unit.fmu.getRealStatus(2), 1.0)
                    self.assertFalse(unit.fmu.getBooleanStatus(3))
                unit.set(self.here())
                unit.fmu.doStep(1.0, 0.25)
                np.testing.assert_allclose(unit.get(FORCES), before, rtol=1e-6)
            for bad, says in (({"mu": -1.0}, "-1"), ({"wheel_right.profile": "none.whl"}, "none"),
                              ({"rail_left.profile": "61e1"}, "61e1"), ({"normal": 5}, "5"),
                              ({"demand": 2, "axle_load": -2.0}, "-2"), ({"gauge": 1e3}, "1000"),
                              ({"flange_share": 0.5}, "angle of the flange")):
                with self.subTest(version=version, bad=bad):
                    unit = self.unit(version)
                    self.assertEqual(self.failing(lambda: unit.start(**bad)), 3)
                    self.assertEqual(unit.said[-1][:2], (3, "logStatusError"))
                    self.assertIn(says, unit.said[-1][2])

    def walk(self, unit):
        """Forces over some steps to the right."""
        found = []
        for y in (2.01, 2.02, 2.03):
            unit.set({"y": y})
            found.append(list(unit.get(FORCES)))
        self.assertNotEqual(found[0], found[1])
        return found

    def test_states_are_taken_back(self):
        for version, warm in ((2, False), (2, True), (3, False), (3, True)):
            unit = self.unit(version).start(warm_start=warm)
            unit.set(self.here())
            before = list(unit.get(FORCES))
            state = unit.state()
            first = self.walk(unit)
            unit.restore(state)
            self.assertEqual(list(unit.get(FORCES)), before)
            self.assertEqual(list(unit.get(["y"])), [2.0])
            again = self.walk(unit)
            # Of bytes, in a unit that was another one.
            data = unit.bytes_of(state)
            other = self.unit(version).start(mu=0.1)
            self.assertNotEqual(list(other.get(FORCES)), before)
            other.restore(other.state_of(data))
            self.assertEqual(list(other.get(["mu", "y"])), [0.3, 2.0])
            self.assertEqual(list(other.get(FORCES)), before)
            self.assertEqual(self.walk(other), again)
            self.assertEqual(again, first)
            # The library's memory is checked where it is taken over.
            broken = other.state_of(data[:-2000] + bytes(2000))
            self.assertEqual(self.failing(other.restore, broken), 3)
            for bad in (data[:-1], b"x" + data[1:]):
                self.assertEqual(self.failing(other.state_of, bad), 3)

    def test_derivatives_are_those_of_the_library(self):
        names = ("y", "z", "roll", "yaw", "y_rate", "z_rate", "roll_rate", "yaw_rate",
                 "pitch_rate")
        wheelset = self.faststrip.Wheelset()
        slopes = wheelset.solve(derivatives=True, **motion_of(self.here())).derivatives
        for version in (2, 3):
            unit = self.unit(version).start()
            unit.set(self.here())
            for k, name in enumerate(names):
                found = unit.derivatives(FORCES, [name], [1.0])
                self.assertEqual(list(found), list(slopes[:, :, k].ravel()), name)
            both = unit.derivatives(FORCES, ["z", "y_rate"], [2.0, -3.0])
            np.testing.assert_allclose(both, (2.0 * slopes[:, :, 1] - 3.0 * slopes[:, :, 4])
                                       .ravel(), rtol=1e-12)
            # Where the library has none: a rail that is moved is a wheelset moved back.
            for rail, sign in (("y", -1.0), ("z", -1.0), ("y_rate", -1.0), ("z_rate", -1.0)):
                found = unit.derivatives(FORCES[:6], [f"rail_right.{rail}", "z"], [1.0, 1.0])
                k = names.index(rail)
                np.testing.assert_allclose(found, sign * slopes[0, :, k] + slopes[0, :, 1],
                                           atol=0.01 * abs(slopes[0, :, k]).max())
            loads = [f"wheel_{side}.contact[1].load" for side in SIDES]
            found = unit.derivatives(loads, ["z"], [1.0])
            np.testing.assert_allclose(found, slopes[:, 2, 1], rtol=0.05)
            self.assertEqual(self.failing(unit.derivatives, FORCES, ["mu"], [1.0]), 3)

    def test_derivatives_change_nothing_that_follows(self):
        for version, demand in ((2, {}), (3, {}), (3, {"demand": 2, "axle_load": 1.2e5})):
            unit = self.unit(version).start(**demand)
            unit.set(self.here(y=1.98))
            unit.get(FORCES)
            state = unit.state()
            unit.set(self.here())
            before = list(unit.get(FORCES))
            after = unit.state()
            expected = self.walk(unit)
            expected_slopes = {}
            for start, name in ((state, "yaw"), (after, "yaw"), (after, "rail_right.y")):
                unit.restore(start)
                unit.set(self.here())
                slopes = unit.derivatives(FORCES, [name], [1.0])
                self.assertGreater(np.abs(slopes).max(), 1e3)
                # Each over the largest of its force or moment: Fz of a given axle load is no more
                # than what is left of its parts.
                expected_slopes.setdefault(name, slopes)
                for mine, wanted in zip(*(np.reshape(each, (4, 3))
                                          for each in (slopes, expected_slopes[name]))):
                    np.testing.assert_allclose(mine, wanted, rtol=0.0,
                                               atol=1e-8 * np.abs(wanted).max())
                self.assertEqual(list(unit.get(FORCES)), before)
                self.assertEqual(self.walk(unit), expected)
                unit.derivatives(FORCES, [name], [1.0])  # elsewhere

    def test_a_wrong_token_is_refused(self):
        for version in (2, 3):
            about = self.fmpy.read_model_description(self.files[version])
            about.guid = about.instantiationToken = "another"
            with self.assertRaisesRegex(Exception, "instantiate"):
                Unit(self.fmpy, self.unpacked[version], about)


MODELICA_HOST = """
#include <stdio.h>
#include <stdlib.h>
#include "wheelset_modelica.h"
void ModelicaError(const char *text)
{
    puts(text);
    exit(1);
}
int main(void)
{
    double motion[10] = {2.0, 0.3, 1e-5, 1e-3, 2e4, 3.0, 1.0, 2e-3, 3e-3, -43.0}, found[12];
    void *wheelset = wheelset_open(0.35);
    for (int i = 0; i < 2; i++) {
        wheelset_forces(wheelset, motion, found, found + 6);
        for (int k = 0; k < 12; k++) {
            unsigned long long digits;
            memcpy(&digits, &found[k], sizeof digits);
            printf("%016llX%c", digits, k == 11 ? '\\n' : ' ');
        }
        motion[0] = 2.01;
    }
    motion[3] = 9.0;
    wheelset_forces(wheelset, motion, found, found + 6);
    wheelset_close(wheelset);
}
"""


class Modelica(HostTest):
    def test_the_c_file_of_the_documentation_has_the_bits(self):
        page = (ROOT / "docs" / "embedding.md").read_text(encoding="utf-8")
        text, = (block.text for block in blocks.blocks_of(page)
                 if block.language == "c" and "ModelicaUtilities" in block.text)
        self.write("wheelset_modelica.h", text)
        self.write("ModelicaUtilities.h", "void ModelicaError(const char *text);\n")
        self.write("modelica.c", MODELICA_HOST)
        self.shell("gcc -Wall -Wextra -Werror -I. modelica.c"
                   " $(pkg-config --cflags --libs faststrip) -o modelica")
        wheelset = self.import_package().Wheelset(mu=0.35)
        expected = []
        for y in (2.0, 2.01):
            result = wheelset.solve(y=y, z=0.3, roll=1e-5, yaw=1e-3, speed=2e4, y_rate=3.0,
                                    z_rate=1.0, roll_rate=2e-3, yaw_rate=3e-3, pitch_rate=-43.0,
                                    warm_start=True)
            self.assertGreater(result.force[:, 2].min(), 1e4)
            expected.append(bits(*result.force.ravel(), *result.moment.ravel()))
        *found, said = self.shell("./modelica || true").splitlines()
        self.assertEqual(found, expected)
        self.assertIn("yaw", said)
