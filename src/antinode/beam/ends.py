"""How the two ends of a beam are held."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from antinode.arguments import choice

from .families import FAMILIES, FamilyName

End = Literal["free", "clamped", "pinned", "sliding"]


AxialEnd = Literal["free", "fixed"]
TorsionEnd = AxialEnd


@dataclass(frozen=True)
class Ends:
    """How the two ends are held: laterally, axially, and against rotation about the axis.

    Parameters
    ----------
    left, right : {"free", "clamped", "pinned", "sliding"}
        A pinned end has Y = M = 0, a sliding one theta = Q = 0. Forces at an end keep their
        direction: at a free end Q = M' + N Y' = 0 (equations 64-65).
    left_axial, right_axial : {"free", "fixed"}, optional
        Default: fixed for clamped and pinned ends, else free.
    left_torsion, right_torsion : {"free", "fixed"}, optional
        Default: fixed for clamped ends, else free.

    Raises
    ------
    InputError
        If a word is not one of these.
    """

    left: End = "free"
    right: End = "free"
    left_axial: AxialEnd | None = None
    right_axial: AxialEnd | None = None
    left_torsion: TorsionEnd | None = None
    right_torsion: TorsionEnd | None = None

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            sideways = name in ("left", "right")
            if sideways or value is not None:
                choice(f"the end {name}", value, End if sideways else AxialEnd)

    def of(self, name: FamilyName) -> tuple[str, str]:
        """Return the two ends as the solver names them for a family of modes."""
        family = FAMILIES[name]
        left, right = (getattr(self, field) for field in family.ends)
        if family.default_end is None:
            return left, right
        return left or family.default_end[self.left], right or family.default_end[self.right]

    def reversed(self) -> Ends:
        """Return the ends of the beam read from its other end."""
        names = [family.ends for family in FAMILIES.values()]
        turned = {a: getattr(self, b) for pair in names for a, b in (pair, pair[::-1])}
        return Ends(**turned)


FREE = Ends()
"""Both ends free: the default."""
