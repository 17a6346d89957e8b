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
from functools import cached_property
from typing import Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from .arrays import Array, Integers
from .points import Point, StepKind, hold
from .segment import LONGEST_STEP, bending_transfer, longitudinal_transfer, wave_number

Family = Literal["bending", "longitudinal"]

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
    points : tuple of Point
        What sits at the nodes, at most one for each node, in order.
    """

    length: Array
    mass: Array
    stiffness: Array
    axial_force: Array
    left: str = "free"
    right: str = "free"
    family: Family = "bending"
    points: tuple[Point, ...] = ()

    @cached_property
    def nodes(self) -> Array:
        """Positions of the joints and ends, from zero [m], shape (n + 1,)."""
        return np.concatenate([[0.0], np.cumsum(self.length)])

    def split(self, pieces: Integers) -> Chain:
        """Return the same chain with segment k cut into ``pieces[k]`` equal ones."""
        arrays: dict[str, Any] = {
            name: np.repeat(getattr(self, name), pieces)
            for name in ("mass", "stiffness", "axial_force")
        }
        first = np.concatenate([[0], np.cumsum(pieces)])
        points = tuple(replace(p, node=int(first[p.node])) for p in self.points)
        return replace(
            self, length=np.repeat(self.length / pieces, pieces), points=points, **arrays
        )

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
        places = np.searchsorted(cuts, nodes - 1e-13 * nodes[-1])
        points = tuple(replace(p, node=int(places[p.node])) for p in self.points)
        return replace(self, length=np.diff(cuts), points=points, **arrays)

    @cached_property
    def reference(self) -> tuple[float, float]:
        """Stiffness and mass per length that scale the equations (means over the length)."""
        weight = self.length / np.sum(self.length)
        return float(np.exp(weight @ np.log(self.stiffness))), float(weight @ self.mass)

    def scale_length(self, omega2: Array) -> Array:
        """Return the length [m] that makes the states of a wave at `omega2` of order one."""
        stiffness, mass = self.reference
        inertia = np.abs(omega2) * mass / stiffness
        total = float(np.sum(self.length))
        if self.family == "longitudinal":
            return (inertia + total**-2) ** -0.5
        weight = self.length / np.sum(self.length)
        b = float(weight @ np.abs(self.axial_force)) / stiffness
        return (inertia + b * b + total**-4) ** -0.25


def omega2_scale(chain: Chain) -> float:
    """Return a natural unit of omega^2 for the chain [rad^2/s^2]: EI/(m L^4) or EA/(m L^2)."""
    stiffness, mass = chain.reference
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
    inner = [p.node for p in chain.points if 0 < p.node < len(chain.length)]
    starts: Integers = np.unique(np.concatenate([[0], first[1:], inner]).astype(np.int64))
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
    scale, (stiffness, _) = chain.scale_length(omega2), chain.reference
    h = (chain.length[segment] if length is None else length)[:, None] / scale
    rigidity, mass = chain.stiffness[segment, None] / stiffness, chain.mass[segment, None]
    if chain.family == "longitudinal":
        return longitudinal_transfer(h, rigidity, mass * (omega2 * scale**2 / stiffness))
    N = chain.axial_force[segment, None] * (scale**2 / stiffness)
    return bending_transfer(h, rigidity, N, mass * (omega2 * scale**4 / stiffness))


def state_units(chain: Chain, omega2: Array) -> Array:
    """Return what one unit of each scaled state component is in SI, shape (k, s)."""
    scale, (stiffness, _) = chain.scale_length(omega2), chain.reference
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


class Steps(NamedTuple):
    """Blocks of segments and points in the order in which a sweep passes them."""

    U: Array
    """Transfer matrix of every step, shape (steps, lanes, s, s)."""
    kind: list[StepKind]
    holds: list[tuple[int, ...]]
    """Displacements held by every step that is a support."""

    def reversed(self) -> Steps:
        """Return the steps as the sweep from the right end passes them."""
        J = symplectic_form(self.U.shape[-1])
        inverse = -J @ np.swapaxes(self.U, -1, -2) @ J
        return Steps(inverse[::-1], self.kind[::-1], self.holds[::-1])


def symplectic_form(size: int) -> Array:
    """Return J with ``U^T J U = J`` for every transfer matrix; ``J^-1 = -J``."""
    if size == 2:
        return np.array([[0.0, 1.0], [-1.0, 0.0]])
    J = np.zeros((4, 4))
    J[0, 3], J[3, 0], J[1, 2], J[2, 1] = -1.0, 1.0, 1.0, -1.0
    return J


def make_steps(chain: Chain, omega2: Array, blocks: Array, starts: Integers) -> Steps:
    """Put the points of a chain between its blocks."""
    if not chain.points:
        return Steps(blocks, ["block"] * len(blocks), [()] * len(blocks))
    units = state_units(chain, omega2)
    at = {point.node: point for point in chain.points}
    matrices: list[Array] = []
    kinds: list[StepKind] = []
    holds: list[tuple[int, ...]] = []
    for k, node in enumerate([*starts.tolist(), len(chain.length)]):
        steps = at[node].steps(blocks.shape[-1], omega2, units) if node in at else ()
        for kind, matrix in steps:
            matrices.append(matrix)
            kinds.append(kind)
            holds.append(at[node].holds if kind == "support" else ())
        if k < len(blocks):
            matrices.append(blocks[k])
            kinds.append("block")
            holds.append(())
    return Steps(np.stack(matrices), kinds, holds)


class Sweep(NamedTuple):
    """Frames between the steps: ``F[i + 1] R[i + 1] = U[i] F[i]``."""

    F: Array
    """Orthonormal frames, shape (steps + 1, lanes, s, d)."""
    R: Array
    """Changes of basis, upper triangular, shape (steps + 1, lanes, d, d); R[0] = 1."""
    back: Array
    """Coefficients before step i are ``back[i + 1]`` times those after it."""
    factor: Array
    """Characteristic functions of parts that supports cut off, multiplied, shape (lanes,)."""


def sweep(steps: Steps, start: Array) -> Sweep:
    """Carry the frame of one end through the steps: the Riccati recursion (equation 74)."""
    d = start.shape[-1]
    F = np.empty((len(steps.U) + 1, *start.shape))
    R = np.empty((len(steps.U) + 1, len(start), d, d))
    F[0], R[:] = start, np.eye(d)
    factor = np.ones(len(start))
    held: dict[int, Array] = {}
    for i, (U, rows) in enumerate(zip(steps.U, steps.holds, strict=True)):
        if rows:
            F[i + 1], held[i + 1], cut = hold(F[i], rows)
            factor = factor * cut
        else:
            F[i + 1], R[i + 1] = orthonormalise(U @ F[i])
    back = inverse_upper(R)
    for i, matrix in held.items():
        back[i] = matrix
    return Sweep(F, R, back, factor)


def inverse_upper(R: Array) -> Array:
    """Return the inverse of upper triangular 1x1 or 2x2 matrices."""
    inverse = np.zeros_like(R)
    for j in range(R.shape[-1]):
        inverse[..., j, j] = 1.0 / R[..., j, j]
    if R.shape[-1] == 2:
        inverse[..., 0, 1] = -R[..., 0, 1] * inverse[..., 0, 0] * inverse[..., 1, 1]
    return inverse


def minor(F: Array, rows: list[int]) -> Array:
    """Return the determinant of the given rows of the frames, shape (...,)."""
    if len(rows) == 1:
        return F[..., rows[0], 0]
    i, j = rows
    return F[..., i, 0] * F[..., j, 1] - F[..., i, 1] * F[..., j, 0]


def negative_at_nodes(steps: Steps, frames: Sweep) -> Integers:
    """Count the negative eigenvalues met while the nodes are condensed, shape (lanes,)."""
    kind = np.array(steps.kind)
    block, joint = np.flatnonzero(kind == "block"), np.flatnonzero(kind == "joint")
    in_blocks = _negative_in_blocks(steps.U[block], frames.F, frames.R, block)
    before, after = (displacement_sign(frames.F[joint + side]) for side in (0, 1))
    return np.asarray(in_blocks + np.sum(before * after < 0, axis=0), dtype=np.int64)


def _negative_in_blocks(U: Array, F: Array, R: Array, block: Integers) -> Integers:
    here, following = F[block], F[block + 1]
    changes = displacement_sign(here) * displacement_sign(following) < 0
    if F.shape[-1] == 1:
        return np.asarray(np.sum(changes, axis=0))
    P_adjugate = np.empty((*U.shape[:-2], 2, 2))  # P adj(U12); det U12 > 0 in every block
    P_adjugate[..., 0, 0], P_adjugate[..., 0, 1] = U[..., 1, 2], -U[..., 0, 2]
    P_adjugate[..., 1, 0], P_adjugate[..., 1, 1] = U[..., 1, 3], -U[..., 0, 3]
    A_next = following[:, :, :2] @ R[block + 1]
    trace = np.sum(here[:, :, :2] * (P_adjugate @ A_next), axis=(-2, -1))
    held = minor(here, [0, 1]) == 0.0  # a supported node has one freedom, or none
    return np.asarray(np.sum(np.where(changes, 1, np.where((trace < 0) & ~held, 2, 0)), axis=0))


def displacement_sign(F: Array) -> Array:
    """Return what changes its sign where a state of the frame has no displacement.

    That is det A; at a node that is held, the one free displacement, or the sign that A takes just
    behind it. Both neighbours of a node use the same number, so that its rounding cannot spoil the
    sum of their counts.
    """
    d = F.shape[-1]
    A = F[..., :d, :]
    determinant = minor(F, list(range(d)))
    free = np.sum(A[..., 0], axis=-1)
    behind = 1.0 if d == 2 else -1.0  # of U12: a reaction Q pushes toward -x
    return np.where(determinant != 0.0, determinant, np.where(free != 0.0, free, behind))


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
    starts = block_starts(fine, largest)
    blocks = multiply_groups(segment_transfers(fine, omega2), starts)
    steps = make_steps(fine, omega2, blocks, starts)
    frames = sweep(steps, end_frame(fine, fine.left, len(omega2)))
    last = frames.F[-1]
    below = negative_at_nodes(steps, frames) + negative_at_end(last, fine.family, fine.right)
    rows = ZERO_COMPONENTS[fine.family][fine.right]
    return Evaluation(below, frames.factor * minor(last, rows))


def count_below(chain: Chain, omega2: npt.ArrayLike) -> Integers:
    """Return the number of eigenvalues of the chain below each `omega2`, shape (k,)."""
    return evaluate(chain, omega2).below
