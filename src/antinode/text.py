"""Words for messages: values on one short line, and the nearest of several names."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Sequence
from reprlib import Repr

MOST_CHARACTERS = 60

_repr = Repr()
_repr.maxlevel = 3
_repr.maxstring = _repr.maxother = _repr.maxlong = 200


def short(value: object, most: int = MOST_CHARACTERS) -> str:
    """Write a value on one line, as a file has it, with at most so many characters."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return f"'{one_line(value[:1000], most)}'"
    if isinstance(value, float | dict | list | tuple):
        return one_line(_repr.repr(value), most)
    try:
        return one_line(str(value), most)
    except ValueError:
        return "a number of thousands of digits"


def one_line(text: str, most: int) -> str:
    """Return a text without line breaks and control characters, shortened in its middle."""
    text = " ".join("".join(c if c.isprintable() else " " for c in text).split())
    if len(text) <= most:
        return text
    return f"{text[: most - most // 4 - 3]}...{text[len(text) - most // 4 :]}"


def counted(number: int, noun: str, plural: str = "") -> str:
    """Write a number with its noun: 1 interval, 2 intervals, 2 point masses."""
    return f"{number} {noun if number == 1 else plural or noun + 's'}"


def listed(names: Iterable[str]) -> str:
    """Write names as a list in a sentence: a, b and c."""
    *most, last = names
    return f"{', '.join(most)} and {last}" if most else last


_CALLED = {
    "mass_per_length": (
        "m",
        "mass",
        "mu",
        "rhoA",
        "linear_density",
        "weight",
        "mass_per_unit_length",
    ),
    "mass": ("m", "weight"),
    "bending_stiffness": ("EI", "stiffness", "flexural_rigidity"),
    "axial_stiffness": ("EA", "AE"),
    "torsional_stiffness": ("GJ", "GK"),
    "shear_stiffness": ("GA", "kGA", "GAs"),
    "translational": ("k", "stiffness", "ky"),
    "rotary_inertia": ("inertia", "J", "I"),
    "x": ("position", "station", "s", "z", "y", "location", "distance"),
    "tolerance": ("tol", "rtol", "accuracy"),
    "left": ("base", "start", "root", "bottom"),
    "right": ("tip", "end", "top"),
    "gravity": ("g",),
    "speed": ("V", "velocity"),
    "cavitation_number": ("sigma",),
    "wall": ("wall_thickness", "thickness", "t", "wt"),
    "outer_diameter": ("od", "OD", "D", "d", "outside_diameter"),
}
"""What others call the keys and columns."""
_OF_TENSION = "N", "tension", "T", "P", "axial_load", "preload"


def nearest(name: str, allowed: Sequence[str]) -> str:
    """Suggest the allowed name that is meant by an unknown one or is nearest, or list them all."""
    if "axial_force" in allowed and name in _OF_TENSION:
        return "did you mean axial_force, in which compression is positive and tension negative?"
    meant = (key for key, others in _CALLED.items() if key in allowed and name in others)
    close = [*meant, *difflib.get_close_matches(name[:MOST_CHARACTERS], allowed, n=1)]
    return f"did you mean {close[0]}?" if close else f"allowed are {', '.join(allowed)}"
