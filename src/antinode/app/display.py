"""Units on the screen: SI, millimetre-tonne-second, and US customary.

Inside everything is SI; a unit of the screen is a name and the factor that makes a shown number SI.
"""

from __future__ import annotations

import math
from typing import Literal, NamedTuple

System = Literal["SI", "mm-t-s", "US"]
SYSTEMS: tuple[System, ...] = ("SI", "mm-t-s", "US")

_FOOT, _POUND, _LBF = 0.3048, 0.45359237, 4.4482216152605
_PSI = _LBF / (_FOOT / 12) ** 2


class Shown(NamedTuple):
    """A unit on the screen: one shown unit is `factor` SI units."""

    name: str
    factor: float

    def of(self, value: float) -> float:
        """Return an SI value as a number of this unit."""
        return value / self.factor


_DEGREE = Shown("deg", math.pi / 180)
_UNITS: dict[str, tuple[Shown, Shown, Shown]] = {
    "rad": (_DEGREE, _DEGREE, _DEGREE),
    "m": (Shown("m", 1.0), Shown("mm", 1e-3), Shown("ft", _FOOT)),
    "m/s": (Shown("m/s", 1.0), Shown("mm/s", 1e-3), Shown("ft/s", _FOOT)),
    "m/s^2": (Shown("m/s²", 1.0), Shown("mm/s²", 1e-3), Shown("ft/s²", _FOOT)),
    "kg": (Shown("kg", 1.0), Shown("t", 1e3), Shown("lb", _POUND)),
    "kg/m": (Shown("kg/m", 1.0), Shown("t/mm", 1e6), Shown("lb/ft", _POUND / _FOOT)),
    "kg/m^3": (Shown("kg/m³", 1.0), Shown("t/mm³", 1e12), Shown("lb/ft³", _POUND / _FOOT**3)),
    "kg m^2": (Shown("kg m²", 1.0), Shown("t mm²", 1e-3), Shown("lb ft²", _POUND * _FOOT**2)),
    "N": (Shown("kN", 1e3), Shown("N", 1.0), Shown("lbf", _LBF)),
    "N/m": (Shown("kN/m", 1e3), Shown("N/mm", 1e3), Shown("lbf/ft", _LBF / _FOOT)),
    "N m": (Shown("kN m", 1e3), Shown("N mm", 1e-3), Shown("lbf ft", _LBF * _FOOT)),
    "N m/rad": (Shown("kN m/rad", 1e3), Shown("N mm/rad", 1e-3), Shown("lbf ft/rad", _LBF * _FOOT)),
    "N m^2": (Shown("kN m²", 1e3), Shown("N mm²", 1e-6), Shown("lbf ft²", _LBF * _FOOT**2)),
    "Pa": (Shown("kPa", 1e3), Shown("MPa", 1e6), Shown("psi", _PSI)),
    "stiff Pa": (Shown("GPa", 1e9), Shown("MPa", 1e6), Shown("ksi", 1e3 * _PSI)),
}


def shown_unit(si: str, system: System) -> Shown:
    """Return the unit on the screen for an SI unit; the SI unit itself where none is known."""
    units = _UNITS.get(si)
    return units[SYSTEMS.index(system)] if units else Shown(si, 1.0)


def number_text(value: float, digits: int = 6) -> str:
    """Write a number for a field, without trailing zeros."""
    text = f"{value:.{digits}g}"
    return text if "e" not in text or abs(value) >= 1e9 or 0 < abs(value) < 1e-6 else f"{value:.0f}"
