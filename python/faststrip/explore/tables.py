"""What the explorer says: how it ended, and the numbers as tables."""

from __future__ import annotations

import math
from typing import List, Optional, Tuple

from .._wear import Wear
from .._wheelset import WheelContact
from .case import CONTROLS, Case, to_slider
from .figures import SHAKEDOWN
from .look import BAD, HERTZ, NORM, STRIPS, TEXT, Look
from .solving import AXES, Answer, Outcome
from .wheelset import SIDES, WheelsetOutcome

METHODS = (("strips", STRIPS), ("hertz", HERTZ), ("norm", NORM))
# Symbol, unit, attribute, what one unit is, format, estimated error and what it is a part of.
ROWS = (("penetration", "mm", "penetration", 1.0, ".4f", "est_err_penetration"),
        ("contact area", "mm²", "area", 1.0, ".1f", "est_err_area"),
        ("maximum pressure", "MPa", "pmax", 1.0, ".0f", "est_err_pmax"),
        ("Fx", "kN", "fx", 1e3, ".3f", "est_err_fx"),
        ("Fy", "kN", "fy", 1e3, ".3f", "est_err_fy"),
        ("Mz", "N m", "mz", 1e3, ".2f", "est_err_mz"),
        ("T gamma", "N", "friction_power", 1.0, ".2f", None),
        ("adhesion", "%", "stick_fraction", 1e-2, ".0f", None))
# What follows from them and the contact angle: title, unit, format.
MORE = (("normal force N", "kN", ".2f"), ("vertical force on the rail Q", "kN", ".2f"),
        ("lateral force on the rail Y", "kN", ".2f"), ("Y/Q", "", ".3f"),
        (f"maximum pressure over {SHAKEDOWN:g} k", "%", ".0f"), ("fatigue index", "", ".3f"))
NONE = Answer(None, None, None)
# Of a wheel, and of each of its contacts.
WHEEL_ROWS = (("vertical force Q", "kN", "vertical", 1e3, ".2f"),
              ("lateral force Y, to the field side", "kN", "lateral", 1e3, ".2f"),
              ("longitudinal force", "kN", "longitudinal", 1e3, ".2f"),
              ("Y/Q", "", "ratio", 1.0, ".3f"))
CONTACT_ROWS = (("status", "", "word", 1.0, ""),
                ("contact angle, right side down", "°", "contact_angle", math.pi / 180.0, ".2f"),
                ("rolling radius", "mm", "radius", 1.0, ".2f"),
                ("normal force N", "kN", "load", 1e3, ".2f"),
                ("maximum pressure", "MPa", "pmax", 1.0, ".0f"),
                ("contact area", "mm²", "area", 1.0, ".1f"),
                ("Fx", "kN", "fx", 1e3, ".3f"), ("Fy", "kN", "fy", 1e3, ".3f"),
                ("longitudinal creepage", "%", "cksi", 1e-2, ".4f"),
                ("lateral creepage", "%", "ceta", 1e-2, ".4f"),
                ("spin", "rad/m", "cphi", 1e-3, ".4f"),
                ("T gamma", "N", "t_gamma", 1.0, ".2f"),
                ("fatigue index", "", "fatigue_index", 1.0, ".3f"))
CELL = "padding:0 8px 0 0;text-align:right;white-space:nowrap"
WORDS = {
    "ok": "ok: the estimated errors are small",
    "fallback_used": "fixed cells gave the answer: the ends of the patch did not converge",
    "edge_of_data": "the contact runs to the end of the profiles",
    "fewer_strips": "more strips did not converge",
    "overlap_left": "valleys overlap beside the patches",
    "flat_along_x": "the gap is nearly flat along x",
    "conformal": "the surfaces turn much within the contact: the half-space is doubtful",
    "under_resolved": "an estimated error is above its limit",
    "more_strips": "more strips than usual gave the answer",
}


def summary_of(case: Case, outcome: Optional[Outcome]) -> List[str]:
    """A case in a few lines, for a picture that stands alone; of a wheelset without an outcome."""
    numbers = {control.name: f"{to_slider(control, getattr(case, control.name, 0.0)):g} "
                             f"{control.unit}" for control in CONTROLS}
    load = "Q" if case.is_vertical else "N"
    lines = [f"{case.wheel.label} on {case.rail.label}, y {numbers['shift']}, "
             f"yaw {numbers['yaw']}, {load} {numbers['load']}"
             + (f", rollers of {numbers['roller_radius']}" if case.roller_radius else "")
             + (", a plane each strip" if case.is_curved else "")]
    if outcome is None:
        return [f"{lines[0]}, load transfer {numbers['transfer']}, curvature "
                f"{numbers['curvature']}, mu {case.mu:g}"]
    strips = outcome.result("strips")
    return [*lines, ", ".join(f"{name} {numbers[name]}" for name in AXES) + f", mu {case.mu:g}",
            f"{STRIPS.label}: {strips.word if strips is not None else 'no result'}"]


def status_of(outcome: Outcome) -> Tuple[str, str]:
    """How it ended, in one line, and its colour."""
    if outcome.error:
        return outcome.error, BAD
    parts = []
    if outcome.case.is_as_it_lies:
        parts.append(f"{outcome.case.rail.label}: inclination 0, as the file has it")
    colour = TEXT
    for name, look in METHODS:
        answer = outcome.answers.get(name)
        if answer is None:
            continue
        if answer.result is None:
            parts.append(f"{look.label}: {answer.error}")
        elif name == "strips" or answer.result.word != "ok":
            word = answer.result.word
            parts.append(f"{look.label}: {WORDS.get(word, word)}"
                         + (f" ({word})" if word != "ok" else ""))
        if name == "strips" and (answer.result is None or answer.result.word != "ok"):
            colour = BAD
    strips = outcome.result("strips")
    if strips is not None and strips.pmax > SHAKEDOWN * outcome.case.yield_shear:
        parts.append(yielding(strips.pmax, outcome.case.yield_shear))
        colour = BAD
    return "; ".join(parts), colour


def yielding(pmax: float, yield_shear: float) -> str:
    """A maximum pressure is beyond shakedown."""
    return (f"maximum pressure {pmax:.0f} MPa is above {SHAKEDOWN:g} k = "
            f"{SHAKEDOWN * yield_shear:.0f} MPa: the material yields at each pass")


def wheelset_status_of(outcome: WheelsetOutcome) -> Tuple[str, str]:
    """How a wheelset ended, in one line, and its colour."""
    if outcome.result is None:
        return outcome.error, BAD
    parts, colour = [], TEXT
    for contact in outcome.result.contacts:
        where = f"{contact.side} wheel, {digits(math.degrees(contact.contact_angle), '.1f')}°"
        if contact.word != "ok":
            parts.append(f"{where}: {WORDS.get(contact.word, contact.word)} ({contact.word})")
            colour = BAD
        if contact.pmax > SHAKEDOWN * outcome.case.yield_shear:
            parts.append(f"{where}: {yielding(contact.pmax, outcome.case.yield_shear)}")
            colour = BAD
    return "; ".join(parts) or WORDS["ok"], colour


def digits(value: float, form: str) -> str:
    """A number with a true minus sign, and no zero below zero."""
    text = f"{value:{form}}"
    return (text if float(text) else f"{0.0:{form}}").replace("-", "\N{MINUS SIGN}")


def percent(part: float) -> str:
    """A part in percent, with two digits."""
    value = 100.0 * part
    return f"{value:.0f}" if value >= 10.0 else f"{value:.2g}"


def sample(look: Look) -> str:
    """A piece of the line of a method, or its mark."""
    if look is NORM:
        return (f'<svg width="10" height="8"><circle cx="5" cy="4" r="3" fill="white" '
                f'stroke="{look.colour}" stroke-width="1.4"/></svg>')
    dashes = {"solid": "", "dashed": "6 3"}[look.dash]
    return (f'<svg width="24" height="8"><line x1="0" x2="24" y1="4" y2="4" stroke="{look.colour}"'
            f' stroke-width="{look.width:g}" stroke-dasharray="{dashes}"/></svg>')


def more_rows(outcome: Outcome, answer: Answer) -> Tuple[Optional[float], ...]:
    """What else stands in the table for one method, in the order of MORE."""
    result, geometry = answer.result, outcome.geometry
    if result is None or geometry is None:
        return (None,) * len(MORE)
    angle = geometry.place.angle
    vertical = result.load * math.cos(angle) + result.fy * math.sin(angle)
    lateral = result.fy * math.cos(angle) - result.load * math.sin(angle)
    return (result.load / 1e3, vertical / 1e3, lateral / 1e3, lateral / vertical,
            100.0 * result.pmax / (SHAKEDOWN * outcome.case.yield_shear),
            answer.wear.fatigue_index if answer.wear is not None else None)


def table_of(outcome: Outcome) -> str:
    """The numbers of all methods, with their estimated errors."""
    head = "".join(f'<th colspan="2" style="{CELL};text-align:center">{sample(look)} '
                   f"{look.label}</th>" for _, look in METHODS)
    lines = [f'<tr><th style="text-align:left">(estimated errors)</th>{head}</tr>']
    answers = [outcome.answers.get(name, NONE) for name, _ in METHODS]
    for title, unit, attribute, scale, form, estimate in ROWS:
        cells: List[str] = []
        for answer in answers:
            value = getattr(answer.result, attribute, None)
            wrong = getattr(answer.result, estimate, None) if estimate else None
            cells.append(f'<td style="{CELL}">'
                         + ("–" if value is None else digits(value / scale, form)) + "</td>"
                         + '<td style="padding:0 6px 0 0;color:#444">'
                         + ("" if wrong is None else f"({percent(wrong)} %)") + "</td>")
        lines.append(line_of(title, unit, "".join(cells)))
    others = [more_rows(outcome, answer) for answer in answers]
    for k, (title, unit, form) in enumerate(MORE):
        lines.append(line_of(title, unit, "".join(
            f'<td style="{CELL}">' + ("–" if value is None else digits(value, form))
            + "</td><td></td>" for value in (row[k] for row in others))))
    return table(lines)


def wheelset_table_of(outcome: WheelsetOutcome) -> str:
    """Forces of both wheels, and the numbers of their contacts."""
    result = outcome.result
    if result is None:
        return ""
    sides = [[one for one in result.contacts if one.side == side] for side in SIDES]
    head = "".join(f'<th colspan="{len(of)}" style="{CELL}">{side} wheel</th>'
                   for side, of in zip(SIDES, sides))
    lines = [f"<tr><th></th>{head}</tr>"]
    rests = [outcome.rests(side) for side in SIDES]
    for title, unit, attribute, scale, form in WHEEL_ROWS:
        lines.append(line_of(title, unit, "".join(
            f'<td colspan="{len(of)}" style="{CELL}">'
            f"{digits(getattr(one, attribute) / scale, form)}</td>"
            for one, of in zip(rests, sides))))
    wear = dict(zip(map(id, result.contacts), outcome.wear))
    for title, unit, attribute, scale, form in CONTACT_ROWS:
        lines.append(line_of(title, unit, "".join(
            f'<td style="{CELL}">{value_of(one, wear[id(one)], attribute, scale, form)}</td>'
            for of in sides for one in of)))
    return table(lines)


def value_of(contact: WheelContact, wear: Wear, attribute: str, scale: float, form: str) -> str:
    """A number of a contact or of its wear; a word as it is."""
    value = getattr(contact, attribute, None)
    if value is None:
        value = getattr(wear, attribute)
    return str(value) if isinstance(value, str) else digits(value / scale, form)


def line_of(title: str, unit: str, cells: str) -> str:
    """A row with its title."""
    named = title + (f", {unit}" if unit else "")
    return f'<tr><td style="padding-right:8px;white-space:nowrap">{named}</td>{cells}</tr>'


def table(lines: List[str]) -> str:
    """Rows as a table."""
    return ('<table style="font-size:11.5px;border-collapse:collapse;line-height:15px">'
            f'{"".join(lines)}</table>')
