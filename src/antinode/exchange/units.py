"""Systems of units for formats that carry none, as NASTRAN."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

SystemName = Literal["SI", "mm-t-s"]


@dataclass(frozen=True)
class System:
    """How many of its units make up one SI unit.

    Attributes
    ----------
    name : {"SI", "mm-t-s"}
    length, mass : float
        Units to 1 m and to 1 kg. Time is in seconds in every system.
    words : str
        For a comment.
    """

    name: SystemName
    length: float
    mass: float
    words: str

    @property
    def force(self) -> float:
        """Units to 1 N: 1 kg m/s^2."""
        return self.mass * self.length


SI = System("SI", 1.0, 1.0, "m, kg, s, N, Pa")
MM_T_S = System("mm-t-s", 1e3, 1e-3, "mm, t, s, N, MPa")
SYSTEMS = {system.name: system for system in (SI, MM_T_S)}
