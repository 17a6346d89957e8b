"""How the two ends of a beam are held."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from antinode.riccati.chain import Family

End = Literal["free", "clamped", "pinned", "sliding"]


AxialEnd = Literal["free", "fixed"]


@dataclass(frozen=True)
class Ends:
    """How the two ends are held, laterally and axially.

    Parameters
    ----------
    left, right : {"free", "clamped", "pinned", "sliding"}
        A pinned end has Y = M = 0, a sliding one theta = Q = 0. Forces at an end keep their
        direction: at a free end Q = M' + N Y' = 0 (equations 64-65).
    left_axial, right_axial : {"free", "fixed"}, optional
        Default: fixed for clamped and pinned ends, else free.
    """

    left: End = "free"
    right: End = "free"
    left_axial: AxialEnd | None = None
    right_axial: AxialEnd | None = None

    def of(self, family: Family) -> tuple[str, str]:
        """Return the two ends as the solver names them for a family of modes."""
        if family == "bending":
            return self.left, self.right
        return (
            self.left_axial or _axial_default(self.left),
            self.right_axial or _axial_default(self.right),
        )


def _axial_default(end: End) -> AxialEnd:
    return "fixed" if end in ("clamped", "pinned") else "free"


HOLDS: dict[str, tuple[int, ...]] = {
    "free": (),
    "pinned": (0,),
    "sliding": (1,),
    "clamped": (0, 1),
    "fixed": (0,),
}


def held_end(end: str, holds: tuple[int, ...], family: Family) -> str:
    """Return an end that a support holds as well."""
    if family == "longitudinal":
        return "fixed" if holds else end
    both = tuple(sorted({*HOLDS[end], *holds}))
    return {(): "free", (0,): "pinned", (1,): "sliding", (0, 1): "clamped"}[both]


FREE = Ends()
"""Both ends free: the default."""
