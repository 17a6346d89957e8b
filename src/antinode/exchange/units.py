"""Systems of units for formats that carry none, as NASTRAN."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

SystemName = Literal["SI", "mm-t-s", "mm-kg-ms", "in-lbf-s", "ft-lbf-s"]
INCH = 0.0254
"""[m], exactly."""
POUND_FORCE = 4.4482216152605
"""[N], exactly."""


@dataclass(frozen=True)
class System:
    """How many of its units make up one SI unit.

    Attributes
    ----------
    name : {"SI", "mm-t-s", "mm-kg-ms", "in-lbf-s", "ft-lbf-s"}
    length, mass : float
        Units to 1 m and to 1 kg.
    words : str
        For a comment.
    time : float
        Units to 1 s.
    """

    name: SystemName
    length: float
    mass: float
    words: str
    time: float = 1.0

    @property
    def force(self) -> float:
        """Units to 1 N: 1 kg m/s^2."""
        return self.mass * self.length / self.time**2


SI = System("SI", 1.0, 1.0, "m, kg, s, N, Pa")
MM_T_S = System("mm-t-s", 1e3, 1e-3, "mm, t, s, N, MPa")
MM_KG_MS = System("mm-kg-ms", 1e3, 1.0, "mm, kg, ms, kN, GPa", 1e3)
IN_LBF_S = System("in-lbf-s", 1 / INCH, INCH / POUND_FORCE, "inch, lbf s^2/inch, s, lbf, psi")
FT_LBF_S = System(
    "ft-lbf-s", 1 / (12 * INCH), 12 * INCH / POUND_FORCE, "ft, slug, s, lbf, lbf/ft^2"
)
SYSTEMS = {system.name: system for system in (SI, MM_T_S, MM_KG_MS, IN_LBF_S, FT_LBF_S)}
