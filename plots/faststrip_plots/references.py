"""CONTACT's results, which lie in the checkout: no installed picture draws them."""

from __future__ import annotations

import os

SWEEP = {"reference": ("reference/contact/s1002_uic60_B.csv", "the same sweep by full CONTACT")}
FIELD = {"contact": (None, "CONTACT's field of the same contact (default:"
                     " reference/contact/fields/shift_MM_B.csv if there is one)")}


def contact_file(given: str | None, shift: float) -> str | None:
    """CONTACT's field: the file given, or the reference's for that shift if there is one."""
    default = f"reference/contact/fields/shift_{shift:g}_B.csv"
    return given or (default if os.path.exists(default) else None)
