"""The variables of the functional mock-up unit, in one list: as the table of its C sources, and as
the modelDescription.xml of FMI 2.0 and 3.0, for tools/building/fmu.py.

A value reference is the place in the list. Choices come from the enumerations of faststrip.h, and
start values from the unit itself.
"""

import dataclasses
import pathlib
import re
import xml.etree.ElementTree as ET

ROOT = pathlib.Path(__file__).resolve().parents[2]
NAME = "faststrip_wheelset"
ABOUT = ("Wheel/rail contact of a wheelset by the modified strip method: from its motion and that "
         "of the rails to the forces on the rails. x ahead, y to the right, z down.")
# Of each unit the powers of SI units, its size in these, and the step of a difference, which moves
# a contact by some 1e-4 mm or changes a creepage by some 1e-6.
UNITS = {
    "mm": ({"m": 1}, 1e-3, 1e-4),
    "mm2": ({"m": 2}, 1e-6, 0.0),
    "1/mm": ({"m": -1}, 1e3, 1e-9),
    "rad": ({"rad": 1}, 1.0, 1e-7),
    "rad/mm": ({"rad": 1, "m": -1}, 1e3, 0.0),
    "s": ({"s": 1}, 1.0, 0.0),
    "mm/s": ({"m": 1, "s": -1}, 1e-3, 2e-2),
    "s/mm": ({"s": 1, "m": -1}, 1e3, 0.0),
    "rad/s": ({"rad": 1, "s": -1}, 1.0, 4e-5),
    "N": ({"kg": 1, "m": 1, "s": -2}, 1.0, 0.0),
    "N/mm": ({"kg": 1, "s": -2}, 1e3, 0.0),
    "N.mm": ({"kg": 1, "m": 2, "s": -2}, 1e-3, 0.0),
    "MPa": ({"kg": 1, "m": -1, "s": -2}, 1e6, 0.0),
}
SIDES = ("right", "left")
AXES = ("x", "y", "z")
# As SHOWN of fmu/model.h.
CONTACTS = 3
# Name, member of a struct of the header, type or unit, what it is.
PARAMETERS = """
back_spacing    setup.back_spacing   mm   distance of the flange backs; 0: as belongs to the gauge
tread_line      setup.tread_line     mm   flange back to nominal rolling circle
gauge           setup.gauge          mm   distance of the gauge faces
gauge_depth     setup.gauge_depth    mm   below the crown, where the gauge is measured
rail_distance   setup.rail_distance  mm   of the origins of the rails' profiles; 0: by the gauge
inclination     setup.inclination    -    tangent of both rails; 999: 1:40 for profiles by name
damping         setup.damping        s/mm of contacts: share by which forces grow with the approach
speed_floor     setup.speed_floor    mm/s of rolling speeds: below, friction grows with the slip
rail_stiffness_y setup.rail_stiffness_y N/mm of a spring below each rail, lateral; 0: rigid
rail_stiffness_z setup.rail_stiffness_z N/mm of a spring below each rail, vertical; 0: rigid
mu              contact.mu           -    coefficient of friction
normal          contact.normal       normal      normal method
tangential      contact.tangential   tangential  tangential method
strips_per_patch contact.strips_per_patch INTEGER across the largest patch; 0: left to the solver
points_per_strip contact.points_per_strip INTEGER of FASTSTRIP
fastsim_nx      contact.fastsim_nx   INTEGER     points along a row, FASTSIM
fastsim_ny      contact.fastsim_ny   INTEGER     rows, FASTSIM
estimate        contact.estimate     BOOLEAN     are errors estimated, for the statuses?
resolution_limit contact.resolution_limit - estimated error above which pressures have a status
force_limit     contact.force_limit  -    the same of the forces
curved          contact.curved       BOOLEAN     do strips lie on the curved surface?
target          contact.target       target      what the normal method auto is to know
tolerance       contact.tolerance    -    largest estimated error of the target
e_wheel         contact.e_wheel      MPa  Young's modulus of the wheels
e_rail          contact.e_rail       MPa  Young's modulus of the rails
nu_wheel        contact.nu_wheel     -    Poisson's ratio of the wheels
nu_rail         contact.nu_rail      -    Poisson's ratio of the rails
friction        contact.friction     friction    how friction falls with slip
kinetic_share   contact.kinetic_share -   kinetic over static friction
half_slip_speed contact.half_slip_speed mm/s slip speed of half of the fall
slope_factor    contact.slope_factor -    of the initial slope
flange_share    contact.flange_share -    friction on the flange over that on the tread
tread_angle     contact.tread_angle  rad  contact angle up to which the tread's friction counts
flange_angle    contact.flange_angle rad  from which the flange's counts
demand          demand.kind          demand      what is prescribed
warm_start      demand.warm_start    BOOLEAN     does a solution start from the last one?
roll_is_free    demand.roll_is_free  BOOLEAN     is the roll found, with loads?
load_right      demand.load_right    N    vertical force of the right wheel, by loads
load_left       demand.load_left     N    vertical force of the left wheel, by loads
axle_load       demand.axle_load     N    vertical force of both
roll_moment     demand.roll_moment   N.mm of the frame on the wheelset, with a free roll
"""
INPUTS = """
y               state.y              mm    lateral displacement
z               state.z              mm    vertical displacement of the centre, down, by position
roll            state.roll           rad   right wheel down, where it is not free
yaw             state.yaw            rad   nose to the right
speed           state.speed          mm/s  along the track
y_rate          state.y_rate         mm/s  lateral velocity
z_rate          state.z_rate         mm/s  vertical velocity, down
roll_rate       state.roll_rate      rad/s right wheel down
yaw_rate        state.yaw_rate       rad/s relative to the track
pitch_rate      state.pitch_rate     rad/s about the axle, negative ahead; 0: pure rolling
curvature       state.curvature      1/mm  of the track, positive to the right
pitch_rate_difference state.pitch_rate_difference rad/s left less right, of independent wheels
"""
RAIL_INPUTS = """
y               y                    mm    beside its place, to the right
z               z                    mm    below its place
roll            roll                 rad   right side down, about the origin of its profile
y_rate          y_rate               mm/s  lateral velocity
z_rate          z_rate               mm/s  vertical velocity, down
roll_rate       roll_rate            rad/s right side down
"""
WHEEL_OUTPUTS = """
status          status               COUNT 0, or the number of the worst limitation
n_contacts      n_contacts           COUNT number of contacts
z               z                    mm    height of the wheelset's centre, down
"""
CONTACT_OUTPUTS = """
status          status               COUNT 0, or the number of its limitation
angle           angle                rad   contact angle
load            load                 N     normal force
fx              fx                   N     longitudinal creep force
fy              fy                   N     creep force in the tangent plane, to the right
mz              mz                   N.mm  about the normal
cksi            cksi                 -     longitudinal creepage
ceta            ceta                 -     lateral creepage
cphi            cphi                 rad/mm spin
area            area                 mm2   contact area
pmax            pmax                 MPa   maximum pressure
friction_power  friction_power       N     frictional work per distance rolled
"""


@dataclasses.dataclass
class Variable:
    """One row: kind as in C, or the enumeration that it is one of."""

    name: str
    causality: str
    place: str
    kind: str
    unit: str
    about: str

    @property
    def c_kind(self):
        return self.kind if self.kind.isupper() else "INTEGER"

    @property
    def variability(self):
        return "fixed" if self.causality == "parameter" else "continuous"


def rows(text, causality, before="", place="", which=""):
    """The variables of a list, of one thing of several."""
    found = []
    for line in text.strip().splitlines():
        name, member, kind, about = line.split(None, 3)
        unit = kind if kind in UNITS else ""
        found.append(Variable(before + name, causality, place + member,
                              "REAL" if unit or kind == "-" else kind, unit, which + about))
    return found


def vector(causality, name, place, unit, about):
    return [Variable(f"{name}_{axis}", causality, f"{place}[{k}]", "REAL", unit,
                     f"{about} along {axis}") for k, axis in enumerate(AXES)]


def variables():
    """All of them, in the order of their value references."""
    found = [Variable("time", "independent", "time", "REAL", "s", "time")]
    for part, of in enumerate(("wheel", "rail")):
        for k, side in enumerate(SIDES):
            found.append(Variable(
                f"{of}_{side}.profile", "parameter", f"profile[{2 * part + k}]", "STRING", "",
                "name, or file, of the unit's resources or by its path"
                + ("; empty: as right" if k else "")))
    for side in SIDES:
        found.append(Variable(f"wheel_{side}.radius", "parameter", f"setup.radius_{side}", "REAL",
                              "mm", "nominal rolling radius"))
    found += rows(PARAMETERS, "parameter") + rows(INPUTS, "input")
    for k, side in enumerate(SIDES):
        found += rows(RAIL_INPUTS, "input", f"rail_{side}.", f"state.rail[{k}].",
                      f"{side} rail: ")
    found.append(Variable("roll_found", "output", "roll", "REAL", "rad", "roll, given or found"))
    for k, side in enumerate(SIDES):
        name, place, which = f"wheel_{side}.", f"side[{k}].", f"{side} wheel: "
        found += vector("output", f"{name}force", f"{place}force", "N", f"{which}force on the rail")
        found += vector("output", f"{name}moment", f"{place}moment", "N.mm",
                        f"{which}moment on the rail about the wheelset's centre")
        found += rows(WHEEL_OUTPUTS, "output", name, place, which)
        for i in range(CONTACTS):
            one, its = f"{name}contact[{i + 1}].", f"{place}contact[{i}]."
            found += vector("output", f"{one}place", f"{its}place", "mm", "in the track")
            found += rows(CONTACT_OUTPUTS, "output", one, its)
    return found


def c_table(token):
    """variables.h."""
    lines = [f'    {{{v.c_kind}, {v.causality.upper()}, offsetof(values, {v.place}),'
             f' {UNITS[v.unit][2] if v.unit and v.causality == "input" else 0.0}}},'
             for v in variables()]
    return "\n".join(["/* Written by tools/generate/fmu_variables.py. */",
                      f'#define UNIT_TOKEN "{token}"', "static const variable variables[] = {",
                      *lines, "};\n"])


def choices():
    """Of each enumeration of the header that a variable is one of the names, numbers and words."""
    text = (ROOT / "include" / "faststrip.h").read_text(encoding="utf-8")
    found = {}
    for kind in sorted({v.kind for v in variables() if not v.kind.isupper()}):
        body, = re.findall(rf"enum faststrip_{kind} \{{(.*?)\}};", text, re.DOTALL)
        items = re.findall(r"FASTSTRIP_(\w+) = (\d+),?(?:\s*/\* (.*?) \*/)?", body, re.DOTALL)
        found[kind] = [(name.removeprefix(f"{kind.upper()}_").lower(), number,
                        re.sub(r"\s+\*?\s*", " ", words)) for name, number, words in items]
    return found


def add(parent, tag, **attributes):
    """An element, without what has no value."""
    return ET.SubElement(parent, tag, {name: str(value) for name, value in attributes.items()
                                       if value not in ("", None)})


def add_variable_2(parent, index, variable, start):
    one = add(parent, "ScalarVariable", name=variable.name, valueReference=index,
              causality=variable.causality, variability=variable.variability,
              initial="calculated" if variable.causality == "output" else None,
              description=variable.about)
    tag = {"INTEGER": "Integer", "BOOLEAN": "Boolean", "STRING": "String"}.get(
        variable.kind, "Real" if variable.kind.isupper() else "Enumeration")
    inner = add(one, tag, unit=variable.unit,
                declaredType=None if variable.kind.isupper() else variable.kind)
    if start is not None:
        inner.set("start", start)


def add_variable_3(parent, index, variable, start):
    tag = {"INTEGER": "Int32", "BOOLEAN": "Boolean", "STRING": "String"}.get(
        variable.kind, "Float64" if variable.kind.isupper() else "Enumeration")
    one = add(parent, tag, name=variable.name, valueReference=index,
              causality=variable.causality, variability=variable.variability,
              initial="calculated" if variable.causality == "output" else None,
              description=variable.about, unit=variable.unit,
              declaredType=None if variable.kind.isupper() else variable.kind)
    if start is not None and tag == "String":
        add(one, "Start").set("value", start)
    elif start is not None:
        one.set("start", start)


def description(version, release, token, starts):
    """modelDescription.xml of FMI 2 or 3; starts has a text of each parameter and input by name."""
    two = version == 2
    root = ET.Element("fmiModelDescription", {
        "fmiVersion": f"{version}.0", "modelName": NAME, "description": ABOUT, "version": release,
        "guid" if two else "instantiationToken": token, "license": "MIT",
        "generationTool": f"faststrip {release}", "variableNamingConvention": "structured",
        **({"numberOfEventIndicators": "0"} if two else {})})
    can = {"modelIdentifier": NAME, **dict.fromkeys(
        ("canGetAndSetFMUstate", "canSerializeFMUstate", "providesDirectionalDerivative",
         "canNotUseMemoryManagementFunctions") if two else
        ("canGetAndSetFMUState", "canSerializeFMUState", "providesDirectionalDerivatives"),
        "true")}
    add(root, "ModelExchange", **can,
        **({"completedIntegratorStepNotNeeded": "true"} if two else {}))
    add(root, "CoSimulation", **can, canHandleVariableCommunicationStepSize="true")
    units = add(root, "UnitDefinitions")
    for name, (powers, factor, _) in UNITS.items():
        add(add(units, "Unit", name=name), "BaseUnit", **powers, factor=repr(factor))
    types = add(root, "TypeDefinitions")
    for name, items in choices().items():
        of = (add(add(types, "SimpleType", name=name), "Enumeration") if two
              else add(types, "EnumerationType", name=name))
        for item, number, words in items:
            add(of, "Item", name=item, value=number, description=words)
    categories = add(root, "LogCategories")
    for name in ("Warning", "Discard", "Error"):
        add(categories, "Category", name=f"logStatus{name}")
    add(root, "DefaultExperiment", startTime=0, stopTime=1)
    listed = add(root, "ModelVariables")
    for index, variable in enumerate(variables()):
        (add_variable_2 if two else add_variable_3)(listed, index, variable,
                                                    starts.get(variable.name))
    structure = add(root, "ModelStructure")
    outputs = [i for i, v in enumerate(variables()) if v.causality == "output"]
    if two:
        for tag in ("Outputs", "InitialUnknowns"):
            into = add(structure, tag)
            for i in outputs:
                add(into, "Unknown", index=i + 1)
    else:
        for tag in ("Output", "InitialUnknown"):
            for i in outputs:
                add(structure, tag, valueReference=i)
    ET.indent(root)
    return ET.tostring(root, encoding="utf-8", xml_declaration=True)
