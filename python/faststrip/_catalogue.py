"""Units, meanings and structs of the library, written by columns.py."""

from __future__ import annotations

import ctypes
from ctypes import c_double, c_int, c_size_t, c_void_p
from typing import Any, Dict, List, Tuple

# Unit, as UDUNITS writes it, what it is, and what must be there for it to be known.
QUANTITIES: Dict[str, Tuple[str, str, str]] = {
    "cksi": ("1", "longitudinal creepage", ""),
    "ceta": ("1", "lateral creepage", ""),
    "cphi": ("rad mm-1", "spin creepage", ""),
    "limitations": ("1", "all limitations of the result", ""),
    "n_strips": ("1", "number of strips", ""),
    "n_elements": ("1", "number of elements", ""),
    "est_err_target": ("1", "estimated error of the target of auto", "target"),
    "load": ("N", "normal load", ""),
    "penetration": ("mm", "penetration, the approach from h = 0", ""),
    "area": ("mm2", "contact area", ""),
    "pmax": ("MPa", "maximum pressure", ""),
    "y_min": ("mm", "least y of the contact", ""),
    "y_max": ("mm", "largest y of the contact", ""),
    "x_max": ("mm", "largest half-length of the contact, along x", ""),
    "fx": ("N", "longitudinal force on the rail", "forces"),
    "fy": ("N", "lateral force on the rail, in the contact plane", "forces"),
    "mz": ("N mm", "moment on the rail about the reference point", "forces"),
    "friction_power": ("N", "frictional work per distance rolled", "forces"),
    "stick_fraction": ("1", "share of the area in adhesion", "stick"),
    "n_patches": ("1", "number of contact patches", ""),
    "iterations": ("1", "steps of the normal solution", ""),
    "strips_across": ("1", "strips across the patch that has most", "strips"),
    "est_err_penetration": ("1", "estimated error of the penetration over the depth", "errors"),
    "est_err_pmax": ("1", "estimated relative error of pmax", "errors"),
    "est_err_area": ("1", "estimated relative error of the area", "errors"),
    "residual_inside": ("1", "largest gap left inside, over the depth", "residuals"),
    "overlap_outside": ("1", "largest overlap outside, over the depth", "residuals"),
    "est_err_fx": ("1", "estimated error of Fx over mu N", "force errors"),
    "est_err_fy": ("1", "estimated error of Fy over mu N", "force errors"),
    "est_err_mz": ("1", "estimated error of Mz over mu N sqrt(area/pi)", "force errors"),
    "gap_change": ("um", "what smoothing changed of the gap, rms", "smoothing"),
    "normal_us": ("us", "wall time of the normal contact", "times"),
    "tangential_us": ("us", "wall time of the creep forces", "times"),
    "t_gamma": ("N", "T gamma without spin", "forces"),
    "t_gamma_spin": ("N", "T gamma with spin", "forces"),
    "t_gamma_per_area": ("N mm-2", "T gamma without spin per area", "forces"),
    "fatigue_index": ("1", "surface-fatigue index", "yield in shear"),
    "mass": ("ug m-1", "wear, mass per distance rolled", "wear law"),
    "volume": ("mm3 m-1", "wear, volume per distance rolled", "wear law"),
    "est_err_cksi": ("1", "estimated error of cksi, 0 where it is given", "force errors"),
    "est_err_ceta": ("1", "estimated error of ceta, 0 where it is given", "force errors"),
    "flash_temperature": ("K", "largest rise by the heat of friction", "temperatures"),
    "temperature_max": ("degC", "largest temperature of the surfaces in contact", "temperatures"),
    "temperature_x": ("mm", "x of the largest temperature", "temperatures"),
    "temperature_y": ("mm", "y of the largest temperature", "temperatures"),
    "von_mises_max": ("MPa", "largest von Mises stress of the rail", "subsurface"),
    "von_mises_x": ("mm", "where it is, x", "subsurface"),
    "von_mises_y": ("mm", "where it is, y", "subsurface"),
    "von_mises_z": ("mm", "where it is, depth", "subsurface"),
    "est_err_von_mises": ("1", "estimated relative error of it", "subsurface"),
    "patch": ("1", "number of the patch", ""),
    "x": ("mm", "x, along the rolling direction", ""),
    "y": ("mm", "y, across the rolling direction", ""),
    "y_left": ("mm", "left edge of the strip", ""),
    "y_right": ("mm", "right edge of the strip", ""),
    "half_length": ("mm", "half-length of the strip", ""),
    "p0": ("MPa", "maximum pressure of the strip", ""),
    "pass_depth": ("mm", "wear depth per pass", ""),
    "state": ("1", "state of the element: 1 adhesion, 2 slip", ""),
    "pn": ("MPa", "pressure", ""),
    "px": ("MPa", "longitudinal traction", ""),
    "py": ("MPa", "lateral traction", ""),
    "sx": ("1", "longitudinal slip over the rolling speed", ""),
    "sy": ("1", "lateral slip over the rolling speed", ""),
    "sxx": ("MPa", "stress of the rail, along x", ""),
    "syy": ("MPa", "stress of the rail, along y", ""),
    "szz": ("MPa", "stress of the rail, in depth", ""),
    "sxy": ("MPa", "shear stress of the rail", ""),
    "sxz": ("MPa", "shear stress of the rail", ""),
    "syz": ("MPa", "shear stress of the rail", ""),
    "von_mises": ("MPa", "von Mises equivalent stress", ""),
    "tresca": ("MPa", "Tresca equivalent stress, s1 - s3", ""),
    "s1": ("MPa", "largest principal stress", ""),
    "s2": ("MPa", "principal stress between", ""),
    "s3": ("MPa", "smallest principal stress", ""),
    "h": ("mm", "undeformed gap", ""),
    "inv2r": ("mm-1", "1/(2R) along the rolling direction", ""),
    "inclination": ("rad", "inclination of the surfaces", ""),
    "place_x": ("mm", "x of the contact in the track", ""),
    "place_y": ("mm", "y of the contact in the track", ""),
    "place_z": ("mm", "z of the contact in the track, down", ""),
    "contact_angle": ("rad", "contact angle", ""),
    "force_x": ("N", "force on the rail along x of the track", ""),
    "force_y": ("N", "force on the rail along y of the track", ""),
    "force_z": ("N", "force on the rail along z of the track", ""),
    "force_wheelset_x": ("N", "force on the rail along x of the wheelset", ""),
    "force_wheelset_y": ("N", "force on the rail along y of the wheelset", ""),
    "force_wheelset_z": ("N", "force on the rail along z of the wheelset", ""),
    "z": ("mm", "z, down", ""),
    "roll": ("rad", "roll of the wheelset", ""),
    "rail_y": ("mm", "y on the profile of the rail", ""),
    "rail_z": ("mm", "z on the profile of the rail", ""),
    "wheel_x": ("mm", "x on the wheel", ""),
    "wheel_y": ("mm", "y on the profile of the wheel", ""),
    "wheel_z": ("mm", "z on the profile of the wheel", ""),
    "radius": ("mm", "rolling radius", ""),
    "speed": ("mm s-1", "rolling speed", ""),
    "est_err_load": ("1", "share of N that the accuracy of the profiles may move", ""),
    "moment_x": ("N mm", "moment about x of the track, about the centre of the wheelset", ""),
    "moment_y": ("N mm", "moment about y of the track, about the centre of the wheelset", ""),
    "moment_z": ("N mm", "moment about z of the track, about the centre of the wheelset", ""),
    "amplitude": ("mm", "amplitude of the lateral motion", ""),
    "tan_gamma_e": ("1", "equivalent conicity", ""),
    "regression": ("1", "equivalent conicity by linear regression", ""),
    "nonlinearity": ("mm-1", "nonlinearity of the conicity", ""),
    "delta_r": ("mm", "rolling radius difference, right less left", ""),
    "radius_right": ("mm", "rolling radius of the right wheel", ""),
    "radius_left": ("mm", "rolling radius of the left wheel", ""),
    "angle_right": ("rad", "contact angle of the right wheel", ""),
    "angle_left": ("rad", "contact angle of the left wheel", ""),
    "y_wheel_right": ("mm", "y on the profile of the right wheel", ""),
    "y_rail_right": ("mm", "y on the profile of the right rail", ""),
    "y_wheel_left": ("mm", "y on the profile of the left wheel", ""),
    "y_rail_left": ("mm", "y on the profile of the left rail", ""),
    "nonlinearity_regression": ("mm-1", "nonlinearity of the conicity by linear regression", ""),
}

# As people write units.
PLAIN: Dict[str, str] = {"mm2": "mm^2", "mm-1": "1/mm", "mm s-1": "mm/s", "rad mm-1": "rad/mm",
                         "N mm-2": "N/mm^2", "ug m-1": "ug per metre", "mm3 m-1": "mm^3 per metre",
                         "degC": "C", "1": ""}


def members(kind: Any, *names: str) -> List[Tuple[str, Any]]:
    """Members of a struct that are of one kind."""
    return [(name, kind) for name in names]


class Case(ctypes.Structure):
    """``faststrip_case`` of the header."""

    _fields_ = [
        *members(c_size_t, "size"),
        *members(c_int, "normal", "tangential", "strips_per_patch", "points_per_strip",
                 "fastsim_nx", "fastsim_ny", "by_load", "warm_start", "with_elements"),
        *members(c_double, "e_wheel", "e_rail", "nu_wheel", "nu_rail", "mu", "load", "penetration",
                 "cksi", "ceta", "cphi"),
        *members(c_int, "estimate"),
        *members(c_double, "resolution_limit", "force_limit"),
        *members(c_int, "target"),
        *members(c_double, "tolerance", "budget_us"),
        *members(c_int, "friction"),
        *members(c_double, "kinetic_share", "half_slip_speed", "speed", "slope_factor",
                 "flange_share", "tread_angle", "flange_angle", "contact_angle"),
        *members(c_int, "n_mu", "mu_over"),
        *members(c_void_p, "mu_at", "mu_table"),
        *members(c_double, "rail_y"),
        *members(c_int, "fx_is_given", "fy_is_given"),
        *members(c_double, "given_fx", "given_fy", "hot_share", "cold_temperature",
                 "hot_temperature"),
        *members(c_int, "with_temperatures"),
        *members(c_double, "conductivity_wheel", "conductivity_rail", "heat_capacity_wheel",
                 "heat_capacity_rail", "density_wheel", "density_rail", "temperature_wheel",
                 "temperature_rail"),
    ]


class Figures(ctypes.Structure):
    """``faststrip_result`` of the header."""

    _fields_ = [
        *members(c_size_t, "size"),
        *members(c_double, "load", "penetration", "area", "pmax", "y_min", "y_max", "x_max", "cksi",
                 "ceta", "fx", "fy", "mz", "friction_power", "stick_fraction"),
        *members(c_int, "n_patches", "n_strips", "n_elements", "iterations", "is_estimated",
                 "strips_across"),
        *members(c_double, "est_err_penetration", "est_err_pmax", "est_err_area", "residual_inside",
                 "overlap_outside"),
        *members(c_int, "forces_are_estimated", "limitations"),
        *members(c_double, "est_err_fx", "est_err_fy", "est_err_mz", "est_err_cksi",
                 "est_err_ceta"),
        *members(c_int, "n_steps", "best_step", "target_is_known", "target_is_met"),
        *members(c_double, "est_err_target"),
    ]


class Row(ctypes.Structure):
    """``faststrip_wheelset_contact`` of the header."""

    _fields_ = [
        *members(c_int, "side", "status", "n_patches", "strips_across", "is_estimated",
                 "forces_are_estimated"),
        *members(c_double * 3, "place"),
        *members(c_double, "angle"),
        *members(c_double * 2, "rail"),
        *members(c_double * 3, "wheel"),
        *members(c_double, "radius", "speed", "cksi", "ceta", "cphi", "load", "penetration", "area",
                 "pmax", "y_min", "y_max", "x_max", "fx", "fy", "mz", "friction_power",
                 "stick_fraction"),
        *members(c_double * 3, "force", "force_wheelset", "moment"),
        *members(c_double, "est_err_penetration", "est_err_pmax", "est_err_area", "est_err_fx",
                 "est_err_fy", "est_err_mz", "est_err_load"),
        *members(c_int, "limitations", "n_strips", "n_elements"),
    ]
