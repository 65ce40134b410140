"""CONTACT's results, which lie in the checkout: no installed picture draws them."""

from __future__ import annotations

import os

REFERENCE = "reference/contact/s1002_uic60_B.csv"


def contact_file(given: str | None, shift: float) -> str | None:
    """CONTACT's field: the file given, or the reference's for that shift if there is one."""
    default = f"reference/contact/fields/shift_{shift:g}_B.csv"
    return given or (default if os.path.exists(default) else None)
