"""What the figures of results are called and measured in, and tables of them.

pandas and xarray are asked for only where a table of theirs is.
"""

from __future__ import annotations

import importlib
from typing import Any, Dict, Mapping, Optional, Sequence, Tuple

import numpy as np

# Unit, as UDUNITS writes it, and what it is.
QUANTITIES: Dict[str, Tuple[str, str]] = {
    "load": ("N", "normal force"),
    "penetration": ("mm", "penetration"),
    "area": ("mm2", "area of the contact"),
    "pmax": ("MPa", "maximum pressure"),
    "y_min": ("mm", "left end of the contact"),
    "y_max": ("mm", "right end of the contact"),
    "x_max": ("mm", "largest half-length along x"),
    "fx": ("N", "longitudinal force on the rail"),
    "fy": ("N", "lateral force on the rail"),
    "mz": ("N mm", "moment on the rail about the reference point"),
    "friction_power": ("N", "frictional work per distance rolled"),
    "stick_fraction": ("1", "share of the area in adhesion"),
    "n_patches": ("1", "number of patches"),
    "n_strips": ("1", "number of strips"),
    "n_elements": ("1", "number of elements"),
    "iterations": ("1", "steps of the normal solution"),
    "strips_across": ("1", "strips across the patch that has most"),
    "est_err_penetration": ("1", "estimated error of the penetration over the depth"),
    "est_err_pmax": ("1", "estimated relative error of the maximum pressure"),
    "est_err_area": ("1", "estimated relative error of the area"),
    "residual_inside": ("1", "largest gap left inside over the depth"),
    "overlap_outside": ("1", "largest overlap outside over the depth"),
    "est_err_fx": ("1", "estimated error of fx over mu times the load"),
    "est_err_fy": ("1", "estimated error of fy over mu times the load"),
    "est_err_mz": ("1", "estimated error of mz over mu times the load times sqrt(area/pi)"),
    "est_err_target": ("1", "estimated error of the target"),
    "limitations": ("1", "all limitations, 1 << status of each added up"),
    "y_left": ("mm", "left edge of the strip"),
    "y_right": ("mm", "right edge of the strip"),
    "half_length": ("mm", "half-length of the strip along x"),
    "p0": ("MPa", "pressure on the centre line of the strip"),
    "patch": ("1", "number of the patch"),
    "x": ("mm", "middle of the element along x"),
    "y": ("mm", "lateral coordinate"),
    "pn": ("MPa", "pressure"),
    "px": ("MPa", "longitudinal traction on the rail"),
    "py": ("MPa", "lateral traction on the rail"),
    "sx": ("1", "longitudinal slip over rolling speed"),
    "sy": ("1", "lateral slip over rolling speed"),
    "state": ("1", "1 adhesion, 2 slip"),
    "h": ("mm", "gap on the line x = 0"),
    "inv2r": ("mm-1", "gap per x squared"),
    "inclination": ("rad", "inclination of the surfaces"),
    "z": ("mm", "height, down"),
    "t_gamma": ("N", "T gamma without spin"),
    "t_gamma_spin": ("N", "T gamma"),
    "t_gamma_per_area": ("N mm-2", "T gamma over the area"),
    "mass": ("ug m-1", "wear per distance rolled"),
    "volume": ("mm3 m-1", "wear per distance rolled"),
    "fatigue_index": ("1", "fatigue index of the surface"),
    "pass_depth": ("mm", "depth of wear when rolled over once"),
    "amplitude": ("mm", "amplitude"),
    "tan_gamma_e": ("1", "equivalent conicity by Klingel's equation"),
    "regression": ("1", "equivalent conicity by linear regression"),
    "nonlinearity": ("mm-1", "nonlinearity of the conicity"),
    "nonlinearity_regression": ("mm-1", "nonlinearity of the conicity by regression"),
    "delta_r": ("mm", "rolling radius difference, right less left"),
    "radius_right": ("mm", "rolling radius of the right wheel"),
    "radius_left": ("mm", "rolling radius of the left wheel"),
    "angle_right": ("rad", "contact angle of the right wheel"),
    "angle_left": ("rad", "contact angle of the left wheel"),
    "contact_angle": ("rad", "contact angle"),
    "radius": ("mm", "rolling radius"),
    "speed": ("mm s-1", "rolling speed"),
    "cksi": ("1", "longitudinal creepage"),
    "ceta": ("1", "lateral creepage"),
    "cphi": ("rad mm-1", "spin creepage"),
    **{f"place_{axis}": ("mm", f"{axis} of the reference point in the track") for axis in "xyz"},
    **{f"rail_{axis}": ("mm", f"{axis} of it on the rail's profile") for axis in "yz"},
    **{f"wheel_{axis}": ("mm", f"{axis} of it in the frame of the wheel's profile")
       for axis in "xyz"},
    **{f"force_{axis}": ("N", f"{axis} of the force on the rail, in the track") for axis in "xyz"},
    **{f"force_wheelset_{axis}": ("N", f"{axis} of it in the wheelset's frame")
       for axis in "xyz"},
    **{f"moment_{axis}": ("N mm", f"{axis} of the moment about the wheelset's centre, in the track")
       for axis in "xyz"},
    "roll": ("rad", "roll, right wheel down"),
    "y_wheel_right": ("mm", "place of the contact on the right wheel"),
    "y_rail_right": ("mm", "place of the contact on the right rail"),
    "y_wheel_left": ("mm", "place of the contact on the left wheel"),
    "y_rail_left": ("mm", "place of the contact on the left rail"),
}


def extra(module: str, what: str) -> Any:
    """A module that is not always there, or an error that says how to get it."""
    try:
        return importlib.import_module(module)
    except ImportError as problem:
        package = module.partition(".")[0]
        if problem.name is not None and problem.name.partition(".")[0] != package:
            raise
        name = {"matplotlib": "plot"}.get(package, package)
        raise ImportError(f"{what} needs {package}: pip install 'faststrip[{name}]'",
                          name=package) from None


def frame(columns: Mapping[str, Any], index: Any = None) -> Any:
    """A pandas DataFrame of columns; its ``attrs["units"]`` has the unit of each that has one."""
    pandas = extra("pandas", "to_pandas")
    made = pandas.DataFrame(dict(columns), index=index)
    made.attrs["units"] = {name: QUANTITIES[name][0] for name in columns if name in QUANTITIES}
    return made


def dataset(columns: Mapping[str, Any], dims: Sequence[str],
            coords: Optional[Mapping[str, Any]] = None,
            attributes: Optional[Mapping[str, Any]] = None) -> Any:
    """An xarray Dataset of arrays of the same dimensions, with ``units`` and ``long_name``."""
    xarray = extra("xarray", "to_xarray")
    variables = {}
    for name, values in columns.items():
        about = {}
        if name in QUANTITIES:
            about["units"], about["long_name"] = QUANTITIES[name]
        variables[name] = (tuple(dims), np.asarray(values), about)
    return xarray.Dataset(variables, coords=coords, attrs=dict(attributes or {}))
