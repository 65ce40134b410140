"""Tables of the figures of results.

pandas and xarray are asked for only where a table of theirs is.
"""

from __future__ import annotations

import importlib
from typing import Any, Dict, Mapping, Optional, Sequence

import numpy as np

from ._arguments import refused
from ._catalogue import QUANTITIES


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


def dims_of(dims: Optional[Sequence[str]], n: int, what: str) -> Sequence[str]:
    """Names of n dimensions: those wanted, or some after what stands there."""
    if dims is None:
        return [what] if n == 1 else [f"{what}_{k}" for k in range(n)]
    if isinstance(dims, str) or len(dims) != n:
        raise refused("dims", f"{n} names", dims)
    return dims


def about(name: str) -> Dict[str, str]:
    """Unit and meaning of a column, if it has them, as attributes of xarray."""
    return dict(zip(("units", "long_name"), QUANTITIES.get(name, ())))


def dataset(columns: Mapping[str, Any], dims: Sequence[str],
            coords: Optional[Mapping[str, Any]] = None,
            attributes: Optional[Mapping[str, Any]] = None) -> Any:
    """An xarray Dataset of arrays of the same dimensions, with ``units`` and ``long_name``."""
    xarray = extra("xarray", "to_xarray")
    variables = {name: (tuple(dims), np.asarray(values), about(name))
                 for name, values in columns.items()}
    return xarray.Dataset(variables, coords=coords, attrs=dict(attributes or {}))
