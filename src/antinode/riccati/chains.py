"""What a backend takes and gives where it solves many chains, or a beam, in one call."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .arrays import Array, Integers
from .chain import Chain
from .laws import Law
from .points import Point


@dataclass(frozen=True)
class Chains:
    """Chains of as many segments each, one a row, without points.

    Every array has the shape (chains, n), or (1, n) where all chains share the row; the axial
    force has a row for each.
    """

    law: Law
    length: Array
    mass: Array
    stiffness: Array
    axial_force: Array
    left: str
    right: str
    following: Array | None = None
    """kappa of both ends [N], shape (chains, 2); None where no force turns with its end."""
    more: Mapping[str, Array] | None = None
    """What segments have besides: flexibility in shear s, rotary inertia, foundation; all three.

    Where N varies inside the steps that segments are halves of, `shear_turn` and `shear_work` are
    the averages of sN and sN^2; by default the products of the segments' own.
    """

    def __len__(self) -> int:
        return len(self.axial_force)

    def __getitem__(self, row: int) -> Chain:
        """Return one of them."""
        h, m, stiffness, N = (v[row if len(v) > 1 else 0] for v in self.arrays)
        columns = {"mass": m, "stiffness": stiffness, "axial_force": N}
        own = {name: columns[name] for name in self.law.columns}
        ends = (0.0, 0.0)
        if self.following is not None:
            ends = float(self.following[row, 0]), float(self.following[row, 1])
        if self.more is not None:
            more = {name: v[row if len(v) > 1 else 0] for name, v in self.more.items()}
            s = more["shear"]
            own |= {"shear_turn": s * N, "shear_work": s * N**2} | more
        return Chain(self.law, h, own, self.left, self.right, following=ends)

    @property
    def arrays(self) -> tuple[Array, Array, Array, Array]:
        """Length, mass, stiffness and axial force."""
        return self.length, self.mass, self.stiffness, self.axial_force

    def some(self, rows: Integers) -> Chains:
        """Return some of them."""

        def part(values: Array) -> Array:
            return values if len(values) == 1 < len(self) else values[rows]

        more = None if self.more is None else {name: part(v) for name, v in self.more.items()}
        h, m, stiffness, N = map(part, self.arrays)
        following = None if self.following is None else self.following[rows]
        ends = self.left, self.right
        return Chains(self.law, h, m, stiffness, N, *ends, following, more)


class ChainRoots(NamedTuple):
    """Consecutive eigenvalues of many chains, each with its certificate."""

    omega2: Array
    """As are `low`, `high` and `rounding`: [rad^2/s^2], shape (chains, roots)."""
    low: Array
    """Ends of the brackets, without rounding."""
    high: Array
    counts: Integers
    """Eigenvalues below either end of the bracket, shape (chains, roots, 2)."""
    rounding: Array
    reason: Integers
    """Of `riccati.reasons`, shape (chains,)."""
    evaluations: Integers
    """Of the chain, shape (chains,); 0 where they are not counted."""

    @classmethod
    def empty(cls, chains: int, roots: int, reason: int = 0) -> ChainRoots:
        """Return results that are to be set."""
        omega2, low, high, rounding = np.zeros((4, chains, roots))
        counts = np.zeros((chains, roots, 2), np.int64)
        reasons, evaluations = np.zeros((2, chains), np.int64)
        if reason:
            reasons[:] = reason
        return cls(omega2, low, high, counts, rounding, reasons, evaluations)


class Tables(NamedTuple):
    """A beam in bending whose numbers vary inside intervals."""

    x: Array
    """Breakpoints, shape (n + 1,)."""
    mass: Array
    """As are stiffness and axial force: at both ends of every interval, shape (n, 2)."""
    stiffness: Array
    axial_force: Array
    acceleration: float
    """Times the mass left of x, it adds to the axial force."""
    mass_left: Array
    """Of every breakpoint; not read without acceleration."""
    logarithmic: bool
    limits: tuple[float, float, int]
    """Steepest ratio over a step, longest share of the phase, and most halvings."""
    left: str
    right: str
    points: Sequence[Point]
    """Their nodes are numbers of breakpoints."""
    following: tuple[float, float] = (0.0, 0.0)
    """What turns with the ends [N] (`riccati.following.ratio`)."""


class BeamRoots(NamedTuple):
    """Consecutive eigenvalues of one beam [rad^2/s^2]; without meaning if it failed."""

    reason: int
    omega2: Array
    error: Array
    """Distance to the eigenvalue of the beam, at most, shape (roots,)."""
    bracket: Array
    """Of the finest chain, rounding included, shape (roots, 2)."""
    counts: Integers
    evaluations: int
    segments: int
    """Of the finest chain."""
