"""Headings of columns as people write them: EI, Bending stiffness [kNm²], x (mm), x / m, x in m."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from .written import number


class Heading(NamedTuple):
    """The name of a column, and its unit; empty if it names none."""

    name: str
    unit: str


_SYMBOLS = {
    "EI": "bending_stiffness",
    "EA": "axial_stiffness",
    "GJ": "torsional_stiffness",
    "kGA": "shear_stiffness",
    "kAG": "shear_stiffness",
    "GAs": "shear_stiffness",
    "m": "mass_per_length",
    "mu": "mass_per_length",
    "\u03bc": "mass_per_length",
    "rhoA": "mass_per_length",
    "\u03c1A": "mass_per_length",
    "rhoI": "rotary_inertia_per_length",
    "\u03c1I": "rotary_inertia_per_length",
    "rhoIp": "polar_inertia_per_length",
    "\u03c1Ip": "polar_inertia_per_length",
}
_WORDS = {
    "mass_per_unit_length": "mass_per_length",
    "mass_per_metre": "mass_per_length",
    "mass_per_meter": "mass_per_length",
    "linear_mass": "mass_per_length",
    "linear_density": "mass_per_length",
    "bending_rigidity": "bending_stiffness",
    "flexural_rigidity": "bending_stiffness",
    "flexural_stiffness": "bending_stiffness",
    "axial_rigidity": "axial_stiffness",
    "torsional_rigidity": "torsional_stiffness",
    "shear_rigidity": "shear_stiffness",
    "position": "x",
}
"""Names that mean a column; not N and tension, whose sign people set either way."""


def heading(written: str, columns: Sequence[str]) -> Heading:
    """Return what a heading means.

    Parameters
    ----------
    written : str
    columns : sequence of str
        Names that are known.
    """
    text = written.strip().strip("\"'").strip()
    for form in _FORMS:
        if (found := form.match(text)) and (name := column_name(found[1], columns)) in columns:
            return Heading(name, bare_unit(found[2]))
    bracket = re.match(r"(.*?)\s*[\[(](.*)$", text)
    name = bracket[1] if bracket else text
    unit = bare_unit(f"[{bracket[2]}") if bracket else ""
    return Heading(column_name(name, columns), unit)


_FORMS = (
    re.compile(r"(.+?)\s*(\[.*\]|\(.*\))$"),
    re.compile(r"(.+?)\s*/\s*(.+)$"),
    re.compile(r"(.+?)\s+in\s+(.+)$"),
)


def bare_unit(text: str) -> str:
    """Return a unit without the brackets around all of it; one that is not closed stays."""
    text = text.strip()
    closed = (text[:1], text[-1:]) in (("[", "]"), ("(", ")")) and len(text) > 1
    return text[1:-1].strip() if closed else text


def column_name(written: str, columns: Sequence[str]) -> str:
    """Return the column that a name means: EI, Bending stiffness; as it is if none."""
    written = written.strip()
    words = "_".join(re.split(r"[\s_-]+", written.lower()))
    symbol = _SYMBOLS.get("".join(written.split()), "")
    found = (name for name in (written, symbol, words, _WORDS.get(words, "")) if name in columns)
    return next(found, written)


def are_units(cells: Sequence[str]) -> bool:
    """Tell whether a row below headings holds their units: no numbers, but something."""
    filled = [cell for cell in cells if cell]
    return bool(filled) and not any(_is_number(cell) for cell in filled)


def _is_number(cell: str) -> bool:
    try:
        number(cell)
    except ValueError as error:
        return "may be" in str(error)
    return True
