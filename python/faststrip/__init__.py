"""Wheel/rail contact by the modified strip method.

Units are mm, N, MPa, rad; x is the rolling direction, y points to the right, z into the rail.
Creepages are the velocity of the rail surface relative to the wheel surface over the rolling speed;
forces act on the rail.

>>> import numpy, faststrip
>>> y = numpy.linspace(-15.0, 15.0, 601)
>>> contact = faststrip.Contact()
>>> contact.set_gap(y, 0.002 * y**2, 1.0 / 920.0)
>>> result = contact.solve(load=1e5, creepage=(1e-3, 0.0, 0.0), mu=0.3)
>>> round(result.penetration, 3), round(result.fx / 1e3, 1)
(0.108, -12.1)
"""

from ._contact import Contact, Material, fastsim, hertz, kalker, library_version
from ._geometry import Conicity, ContactFunctions, conicity, contact_functions
from ._library import (
    FaststripError,
    ImplausibleWarning,
    LibraryNotFound,
    ProgramNotFound,
    limitation_words,
)
from ._lookup import LookedUp, Lookup
from ._lookup_wheel import WheelContacts, WheelLookup
from ._many import ManyResult, solve_many
from ._plot import plot_profiles
from ._profile import Gap, Profile, draw_profile, profile_gap
from ._results import Elements, Result, Step, Stresses, StressPeak, Strips
from ._wear import Flash, Friction, StripWear, Thermal, Wear, WearLaw
from ._wheelset import RailState, WheelContact, Wheelset, WheelsetResult
from .pair.contact import ContactResult, contact
from .pair.creep_map import CreepMap, creep_map
from .pair.sweep import SweepResult, sweep

__all__ = [
    "Conicity",
    "Contact",
    "ContactFunctions",
    "ContactResult",
    "CreepMap",
    "Elements",
    "FaststripError",
    "Flash",
    "Friction",
    "Gap",
    "ImplausibleWarning",
    "LibraryNotFound",
    "LookedUp",
    "Lookup",
    "ManyResult",
    "Material",
    "Profile",
    "ProgramNotFound",
    "RailState",
    "Result",
    "Step",
    "StressPeak",
    "Stresses",
    "StripWear",
    "Strips",
    "SweepResult",
    "Thermal",
    "Wear",
    "WearLaw",
    "WheelContact",
    "WheelContacts",
    "WheelLookup",
    "Wheelset",
    "WheelsetResult",
    "conicity",
    "contact",
    "contact_functions",
    "creep_map",
    "draw_profile",
    "fastsim",
    "hertz",
    "kalker",
    "library_version",
    "limitation_words",
    "plot_profiles",
    "profile_gap",
    "solve_many",
    "sweep",
]
__version__ = "0.1.0"
