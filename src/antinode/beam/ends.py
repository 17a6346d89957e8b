"""How the two ends of a beam are held."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from antinode.arguments import choice, numbers
from antinode.arrays import Array
from antinode.errors import InputError

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
    left_follower, right_follower : float
        Share of the axial force at this free end, 0 to 1, that turns with the end's section as a
        fixed nozzle's thrust does: there ``Q = share * N * psi``. By default all of it keeps its
        direction.

    Raises
    ------
    InputError
        If a word is not one of these, or a share is outside 0 ... 1 or at an end that is not free.
    """

    left: End = "free"
    right: End = "free"
    left_axial: AxialEnd | None = None
    right_axial: AxialEnd | None = None
    left_torsion: TorsionEnd | None = None
    right_torsion: TorsionEnd | None = None
    left_follower: float = 0.0
    right_follower: float = 0.0

    def __post_init__(self) -> None:
        for name, end in (("left_follower", self.left), ("right_follower", self.right)):
            object.__setattr__(self, name, _share(name, getattr(self, name)))
            check_follower(name, getattr(self, name), end)
        for name, value in vars(self).items():
            if name in _FOLLOWERS:
                continue
            sideways = name in ("left", "right")
            if sideways or value is not None:
                choice(f"the end {name}", value, End if sideways else AxialEnd)

    @property
    def follow(self) -> tuple[float, float]:
        """Shares of the forces at both ends that turn with them."""
        return self.left_follower, self.right_follower

    def of(self, name: FamilyName) -> tuple[str, str]:
        """Return the two ends as the solver names them for a family of modes."""
        family = FAMILIES[name]
        left, right = (getattr(self, field) for field in family.ends)
        if family.default_end is None:
            return left, right
        return left or family.default_end[self.left], right or family.default_end[self.right]

    def reversed(self) -> Ends:
        """Return the ends of the beam read from its other end."""
        names = [*(family.ends for family in FAMILIES.values()), _FOLLOWERS]
        turned = {a: getattr(self, b) for pair in names for a, b in (pair, pair[::-1])}
        return Ends(**turned)


_FOLLOWERS = "left_follower", "right_follower"


def _share(name: str, value: float) -> float:
    share = float(numbers(name, value))
    if not 0 <= share <= 1:
        raise InputError(
            f"{name} is {share:g}; allowed is 0 (the force keeps its direction) to 1 (it turns "
            "with the end)"
        )
    return share


def check_follower(name: str, share: float, end: str) -> None:
    """Raise InputError where a force follows an end that is not free."""
    if share and end != "free":
        side = name.partition("_")[0]
        raise InputError(
            f"{name} is {share:g}, but the {side} end is {end}; a force turns with a free end "
            "only: set it to 0 or leave it out"
        )


FREE = Ends()
"""Both ends free: the default."""


def lateral_freedoms(places: set[float], slope_held: bool) -> Array:
    """Return the motions ``a + b x`` that are zero at some places, however near they are."""
    if len(places) + slope_held >= 2:
        return np.zeros((0, 2))
    if slope_held:
        return np.array([[1.0, 0.0]])
    return np.array([[-x, 1.0] for x in places]) if places else np.eye(2)
