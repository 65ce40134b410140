"""Case files of the program, as far as the page can show them."""

from __future__ import annotations

import pathlib
from typing import Any, Dict

import f90nml

from .case import RADIUS, STANDARD, Case, CaseError, find_shape

# Names of the program that the page takes: its own, and the one number of those it has fixed.
TAKEN = {("contact", "load_n"): "load", ("contact", "shift_mm"): "shift",
         ("motion", "cksi"): "cksi", ("motion", "ceta"): "ceta",
         ("motion", "cphi_rad_per_mm"): "cphi", ("material", "mu"): "mu",
         ("rail", "inclination"): "given_inclination", ("rail", "cant"): "given_inclination",
         ("rail", "roller_radius_mm"): "roller_radius", ("numerics", "curved"): "is_curved"}
FIXED = {("wheel", "radius_mm"): RADIUS, ("wheel", "back_spacing_mm"): 1360.0,
         ("wheel", "tread_line_mm"): 70.0, ("rail", "gauge_mm"): 1435.0,
         ("rail", "gauge_depth_mm"): 14.0, ("material", "e_wheel_mpa"): 209920.0,
         ("material", "e_rail_mpa"): 209920.0, ("material", "nu_wheel"): 0.28,
         ("material", "nu_rail"): 0.28, ("motion", "creepage"): "given"}
PASSED = {("contact", "name")}  # names that change nothing
PASSED_GROUPS = {"numerics", "sweep", "state"}  # the page has its own


def read_case(name: str) -> Case:
    """The case of a file; CaseError where it holds what the page cannot show."""
    try:
        groups: Dict[str, Any] = f90nml.read(name)
    except OSError as problem:
        raise CaseError(f"{problem.strerror}: {name}") from None
    except Exception as problem:
        raise CaseError(f"not a case file: {name} ({problem})") from None
    found: Dict[str, Any] = {"is_vertical": False}
    for group, values in groups.items():
        if not isinstance(values, dict):
            raise CaseError(f"the group &{group} stands twice: {name}")
        for key, value in values.items():
            if group not in PASSED_GROUPS or (group, key) in TAKEN:
                take(found, group, key, value, name)
    if not {"wheel", "rail"} <= set(found):
        raise CaseError(f"a case must have the groups wheel and rail with profiles: {name}")
    case = Case(**found)
    if case.is_as_it_lies:
        raise CaseError(f"inclination of &rail must be given for the rail of {case.rail.label}: 0 "
                        f"if it stands as in the track, 0.025 to turn it by 1:40: {name}")
    return case


def take(found: Dict[str, Any], group: str, key: str, value: Any, name: str) -> None:
    """One value of a case file."""
    place = group, key
    if place in PASSED:
        return
    if place in TAKEN:
        if TAKEN[place] in found:
            raise CaseError("cant of &rail must not be given with inclination, which is its name: "
                            f"{name}")
        is_flag = TAKEN[place] == "is_curved"
        if isinstance(value, bool) is not is_flag or not isinstance(value, (int, float)):
            wanted = ".true. or .false." if is_flag else "a number"
            raise CaseError(f"{key} of &{group} must be {wanted}, got {value!r}: {name}")
        found[TAKEN[place]] = value if is_flag else float(value)
    elif key == "profile" and group in ("wheel", "rail"):
        found[group] = find_shape(group, beside(name, str(value), group))
    elif place == ("contact", "load_direction"):
        if value not in ("vertical", "normal"):
            raise CaseError(f"load_direction must be vertical or normal, got {value}: {name}")
        found["is_vertical"] = value == "vertical"
    elif place not in FIXED:
        raise CaseError(f"{key} of &{group} cannot be shown on the page: {name}")
    elif value != FIXED[place]:
        raise CaseError(f"{key} of &{group} must be {FIXED[place]} on the page, got {value}: "
                        f"{name}")


def beside(name: str, profile: str, kind: str) -> str:
    """A profile of a case file: a name, or a file relative to the case's folder."""
    if profile.lower() in STANDARD[kind]:
        return profile
    return str(pathlib.Path(name).parent / profile)
