r"""A chain of uniform segments: Riccati form, characteristic function, certified counts.

The Riccati transformation ``Z_b = S Z_a`` of equations 67-80 (Z_a displacements, Z_b forces) is
carried as an orthonormal frame ``F = [A; B]`` of the states that satisfy the left end:
``S = B A^-1`` wherever it exists, and the frame stays bounded where S has a pole. Equation 74
becomes ``F <- U F`` followed by a change of basis, and the characteristic function is the
determinant of those rows of the last frame that the right end sets to zero (det B at a free end:
the numerator of equation 79).

Counting (Wittrick and Williams, 1971): with ``P = [[0, -1], [1, 0]]`` the dynamic stiffness of all
that lies left of a joint is ``K = P S``, symmetric. The number of eigenvalues below omega^2 is the
number of negative eigenvalues met when the joints are condensed from left to right. Short segments
are first multiplied into blocks which, clamped at both ends, have no eigenvalue below omega^2, so
that no further term is needed; long ones are split. With ``D`` the stiffness of a joint when the
next one is held, ``A_i^T D A_i = A_i^T P U12^-1 A_i+1``: determinant and trace of the right-hand
side tell its inertia without dividing by anything that can vanish.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from .segment import (
    LONGEST_STEP,
    bending_transfer,
    longitudinal_transfer,
    wave_number,
)

Array = npt.NDArray[np.float64]
Family = Literal["bending", "longitudinal"]
Integers = npt.NDArray[np.int64]

ZERO_COMPONENTS: dict[str, dict[str, list[int]]] = {
    "bending": {"free": [2, 3], "clamped": [0, 1], "pinned": [0, 2], "sliding": [1, 3]},
    "longitudinal": {"free": [1], "fixed": [0]},
}
"""Components of the state that an end sets to zero: of [Y, theta, M, Q] and of [X, Q]."""

_BLOCK_PHASE = 1.25  # wave number times length at which a block of short segments is closed
_BLOCK_LIMIT = 2.5  # ... and the bound, with the block's extreme properties, that it must keep
_LARGEST_STACK = 4_000_000  # matrix entries held at once


@dataclass(frozen=True)
class Chain:
    """Uniform segments from left to right with constant axial force, and two ends.

    Parameters
    ----------
    length, mass, stiffness : array, shape (n,)
        Length [m], mass per length [kg/m]; EI [N m^2] in bending, EA [N] longitudinally.
    axial_force : array, shape (n,)
        N [N], compression positive; ignored by the longitudinal family.
    left, right : str
        Keys of `ZERO_COMPONENTS` of the family.
    family : {"bending", "longitudinal"}
    """

    length: Array
    mass: Array
    stiffness: Array
    axial_force: Array
    left: str = "free"
    right: str = "free"
    family: Family = "bending"

    @property
    def nodes(self) -> Array:
        """Positions of the joints and ends, from zero [m], shape (n + 1,)."""
        return np.concatenate([[0.0], np.cumsum(self.length)])

    def split(self, pieces: Integers) -> Chain:
        """Return the same chain with segment k cut into ``pieces[k]`` equal ones."""
        arrays: dict[str, Any] = {
            name: np.repeat(getattr(self, name), pieces)
            for name in ("mass", "stiffness", "axial_force")
        }
        return replace(self, length=np.repeat(self.length / pieces, pieces), **arrays)

    def cut_at(self, positions: Array) -> Chain:
        """Return the same chain with a joint at each of the positions [m] as well."""
        nodes = self.nodes
        after = np.searchsorted(nodes, positions).clip(1, len(nodes) - 1)
        gap = np.minimum(np.abs(nodes[after] - positions), np.abs(positions - nodes[after - 1]))
        cuts = np.sort(np.concatenate([nodes, positions[gap > 1e-12 * nodes[-1]]]))
        owner = np.clip(np.searchsorted(nodes, (cuts[1:] + cuts[:-1]) / 2) - 1, 0, len(nodes) - 2)
        arrays: dict[str, Any] = {
            name: getattr(self, name)[owner] for name in ("mass", "stiffness", "axial_force")
        }
        return replace(self, length=np.diff(cuts), **arrays)

    def reference(self) -> tuple[float, float]:
        """Return stiffness and mass per length that scale the equations (means over the length)."""
        weight = self.length / np.sum(self.length)
        return float(np.exp(weight @ np.log(self.stiffness))), float(weight @ self.mass)

    def scale_length(self, omega2: Array) -> Array:
        """Return the length [m] that makes the states of a wave at `omega2` of order one."""
        stiffness, mass = self.reference()
        inertia = np.abs(omega2) * mass / stiffness
        total = float(np.sum(self.length))
        if self.family == "longitudinal":
            return (inertia + total**-2) ** -0.5
        weight = self.length / np.sum(self.length)
        b = float(weight @ np.abs(self.axial_force)) / stiffness
        return (inertia + b * b + total**-4) ** -0.25


def omega2_scale(chain: Chain) -> float:
    """Return a natural unit of omega^2 for the chain [rad^2/s^2]: EI/(m L^4) or EA/(m L^2)."""
    stiffness, mass = chain.reference()
    power = 4 if chain.family == "bending" else 2
    return stiffness / (mass * float(np.sum(chain.length)) ** power)


def largest_wave_number(chain: Chain, omega2: float) -> Array:
    """Return the bound on the wave number of every segment at `omega2` [1/m], shape (n,)."""
    inertia = chain.mass * abs(omega2)
    if chain.family == "longitudinal":
        return np.sqrt(inertia / chain.stiffness)
    return wave_number(chain.stiffness, chain.axial_force, inertia)


def split_long(chain: Chain, omega2: float, limit: float = LONGEST_STEP) -> Chain:
    """Return the chain with every segment cut until wave number times length is within `limit`."""
    pieces = np.ceil(largest_wave_number(chain, omega2) * chain.length / limit)
    if not np.all(np.isfinite(pieces)) or np.sum(pieces) > 5e6:
        raise FloatingPointError(f"omega^2 = {omega2:g} rad^2/s^2 is out of reach for this chain")
    return chain.split(np.maximum(pieces, 1).astype(np.int64))


def block_starts(chain: Chain, omega2: float) -> Integers:
    """Return the first segment of each block: blocks have no clamped-clamped root up to `omega2`.

    A block of length H is safe where the wave number of a beam with its smallest stiffness and
    largest mass and axial force, times H, is small against 4.73 (2 pi if buckling governs, pi for
    a bar).
    """
    phase = np.cumsum(largest_wave_number(chain, omega2) * chain.length)
    first = np.flatnonzero(np.diff(np.floor(phase / _BLOCK_PHASE), prepend=-1.0))
    first[0] = 0
    starts: Integers = np.unique(first)
    worst = replace(
        chain,
        length=np.add.reduceat(chain.length, starts),
        stiffness=np.minimum.reduceat(chain.stiffness, starts),
        mass=np.maximum.reduceat(chain.mass, starts),
        axial_force=np.maximum.reduceat(np.abs(chain.axial_force), starts),
    )
    unsafe = largest_wave_number(worst, omega2) * worst.length > _BLOCK_LIMIT
    if not np.any(unsafe):
        return starts
    block = np.repeat(np.arange(len(starts)), np.diff(starts, append=len(chain.length)))
    return np.union1d(starts, np.flatnonzero(unsafe[block]))


def segment_transfers(
    chain: Chain,
    omega2: Array,
    length: Array | None = None,
    segment: Integers | slice = slice(None),
) -> Array:
    """Return the scaled transfer matrix of every segment at every `omega2`.

    Parameters
    ----------
    omega2 : array, shape (k,)
        [rad^2/s^2], any sign.
    length : array, shape (n,), optional
        Distance into each segment [m]; its whole length by default.
    segment : array of int, shape (n,), optional
        Which segments; all by default.

    Returns
    -------
    array, shape (n, k, s, s)
        For states ``[Y/l, theta, M l/EI0, Q l^2/EI0]`` (or ``[X/l, Q/EA0]``), with l from
        `Chain.scale_length` and EI0 from `Chain.reference`.
    """
    scale, (stiffness, _) = chain.scale_length(omega2), chain.reference()
    h = (chain.length[segment] if length is None else length)[:, None] / scale
    rigidity, mass = chain.stiffness[segment, None] / stiffness, chain.mass[segment, None]
    if chain.family == "longitudinal":
        return longitudinal_transfer(h, rigidity, mass * (omega2 * scale**2 / stiffness))
    N = chain.axial_force[segment, None] * (scale**2 / stiffness)
    return bending_transfer(h, rigidity, N, mass * (omega2 * scale**4 / stiffness))


def state_units(chain: Chain, omega2: Array) -> Array:
    """Return what one unit of each scaled state component is in SI, shape (k, s)."""
    scale, (stiffness, _) = chain.scale_length(omega2), chain.reference()
    one = np.ones_like(scale)
    if chain.family == "longitudinal":
        return np.stack([scale, stiffness * one], axis=-1)
    return np.stack([scale, one, stiffness / scale, stiffness / scale**2], axis=-1)


def multiply_groups(U: Array, starts: Integers) -> Array:
    """Return the ordered product of the matrices of each group, by halving (equation 63)."""
    sizes = np.diff(starts, append=len(U))
    while np.any(sizes > 1):
        position = np.arange(len(U)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
        left = np.flatnonzero(position % 2 == 0)
        paired = position[left] + 1 < np.repeat(sizes, sizes)[left]
        product = U[left]
        product[paired] = U[left[paired] + 1] @ product[paired]
        U, sizes = product, (sizes + 1) // 2
    return U


def orthonormalise(F: Array) -> tuple[Array, Array]:
    """Return Q and upper triangular R with positive diagonal, ``F = Q R``, for one or two columns.

    Parameters
    ----------
    F : array, shape (..., s, d)
    """
    Q, R = np.empty_like(F), np.zeros((*F.shape[:-2], F.shape[-1], F.shape[-1]))
    for j in range(F.shape[-1]):
        column = F[..., j]
        for i in range(j):
            R[..., i, j] = np.einsum("...s,...s->...", Q[..., i], column)
            column = column - R[..., i, j, None] * Q[..., i]
        R[..., j, j] = np.sqrt(np.einsum("...s,...s->...", column, column))
        Q[..., j] = column / R[..., j, j, None]
    return Q, R


def end_frame(chain: Chain, end: str, lanes: int) -> Array:
    """Return the frame of states that satisfy an end, free displacements first, (lanes, s, d)."""
    size = 4 if chain.family == "bending" else 2
    free = [i for i in range(size) if i not in ZERO_COMPONENTS[chain.family][end]]
    return np.broadcast_to(np.eye(size)[:, free], (lanes, size, len(free))).copy()


class Sweep(NamedTuple):
    """Frames at the block boundaries: ``F[i + 1] R[i + 1] = U[i] F[i]``."""

    F: Array
    """Orthonormal frames, shape (blocks + 1, lanes, s, d)."""
    R: Array
    """Changes of basis, upper triangular, shape (blocks + 1, lanes, d, d); R[0] = 1."""


def sweep(U: Array, start: Array) -> Sweep:
    """Carry the frame of one end through the blocks: the Riccati recursion (equation 74)."""
    F = np.empty((len(U) + 1, *start.shape))
    R = np.empty((len(U) + 1, *start.shape[:-2], start.shape[-1], start.shape[-1]))
    F[0], R[0] = start, np.eye(start.shape[-1])
    for i, block in enumerate(U):
        F[i + 1], R[i + 1] = orthonormalise(block @ F[i])
    return Sweep(F, R)


def minor(F: Array, rows: list[int]) -> Array:
    """Return the determinant of the given rows of the frames, shape (...,)."""
    if len(rows) == 1:
        return F[..., rows[0], 0]
    i, j = rows
    return F[..., i, 0] * F[..., j, 1] - F[..., i, 1] * F[..., j, 0]


def negative_at_joints(U: Array, frames: Sweep) -> Integers:
    """Count the negative eigenvalues met while the joints are condensed, shape (lanes,)."""
    F, R = frames
    if F.shape[-1] == 1:
        return np.asarray(np.sum(F[:-1, :, 0, 0] * F[1:, :, 0, 0] < 0, axis=0), dtype=np.int64)
    determinant = minor(F, [0, 1])
    P_adjugate = np.empty((*U.shape[:-2], 2, 2))  # P adj(U12); det U12 > 0 in every block
    P_adjugate[..., 0, 0], P_adjugate[..., 0, 1] = U[..., 1, 2], -U[..., 0, 2]
    P_adjugate[..., 1, 0], P_adjugate[..., 1, 1] = U[..., 1, 3], -U[..., 0, 3]
    A_next = F[1:, :, :2] @ R[1:]
    trace = np.sum(F[:-1, :, :2] * (P_adjugate @ A_next), axis=(-2, -1))
    indefinite = determinant[:-1] * determinant[1:] < 0
    negative = np.where(indefinite, 1, np.where(trace < 0, 2, 0))
    held = determinant[0] == 0.0  # the first joint of a beam that is not free: one or no freedom
    negative[0] = np.where(held, trace[0] < 0, negative[0])
    return np.asarray(np.sum(negative, axis=0), dtype=np.int64)


def negative_at_end(F: Array, family: Family, right: str) -> Integers:
    """Count the negative eigenvalues of the stiffness of the whole, seen by the right end."""
    if family == "longitudinal":
        negative = F[..., 1, 0] * F[..., 0, 0] > 0
        return np.where(right == "free", negative, False).astype(np.int64)
    held = minor(F, [0, 1])
    along_theta, along_Y = minor(F, [0, 2]) * held, minor(F, [1, 3]) * held
    if right == "pinned":
        return (along_theta < 0).astype(np.int64)
    if right == "sliding":
        return (along_Y < 0).astype(np.int64)
    if right == "clamped":
        return np.zeros(held.shape, dtype=np.int64)
    indefinite = minor(F, [2, 3]) * held < 0
    return np.where(indefinite, 1, np.where(along_theta + along_Y < 0, 2, 0))


class Evaluation(NamedTuple):
    """What one pass over the chain tells at each omega^2."""

    below: Integers
    """Number of eigenvalues below omega^2, shape (k,)."""
    characteristic: Array
    """Characteristic function, bounded and without poles, shape (k,)."""


def evaluate(chain: Chain, omega2: npt.ArrayLike) -> Evaluation:
    """Count the eigenvalues below each `omega2` and return the characteristic function there.

    Parameters
    ----------
    chain : Chain
    omega2 : array_like, shape (k,)
        [rad^2/s^2], any sign.

    Returns
    -------
    Evaluation
    """
    lanes = np.atleast_1d(np.asarray(omega2, dtype=float))
    largest = float(np.max(np.abs(lanes)))
    fine = split_long(chain, largest)
    together = max(1, _LARGEST_STACK // (16 * len(fine.length)))
    parts = [
        _evaluate(fine, lanes[i : i + together], largest) for i in range(0, len(lanes), together)
    ]
    return Evaluation(*(np.concatenate(values) for values in zip(*parts, strict=True)))


def _evaluate(fine: Chain, omega2: Array, largest: float) -> Evaluation:
    U = multiply_groups(segment_transfers(fine, omega2), block_starts(fine, largest))
    frames = sweep(U, end_frame(fine, fine.left, len(omega2)))
    last = frames.F[-1]
    count = negative_at_joints(U, frames) + negative_at_end(last, fine.family, fine.right)
    return Evaluation(count, minor(last, ZERO_COMPONENTS[fine.family][fine.right]))


def count_below(chain: Chain, omega2: npt.ArrayLike) -> Integers:
    """Return the number of eigenvalues of the chain below each `omega2`, shape (k,)."""
    return evaluate(chain, omega2).below
