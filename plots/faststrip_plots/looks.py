"""The style of the Python package, for what draws and for what only reads: without matplotlib, and
without the package, which would look for its library."""

from __future__ import annotations

import importlib.util
import pathlib
import sys


def _package_style():
    path = pathlib.Path(__file__).resolve().parents[2] / "python" / "faststrip" / "_style.py"
    spec = importlib.util.spec_from_file_location("faststrip_style", path)
    module = sys.modules[spec.name] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


looks = _package_style()
