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
that no further term is needed, but for one of each pedestal above its pole, where its mass moves
while the beam stands still; long ones are split. With ``D`` the stiffness of a joint when the
next one is held, ``A_i^T D A_i = A_i^T P U12^-1 A_i+1``: determinant and trace of the right-hand
side tell its inertia without dividing by anything that can vanish.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .arrays import Array, Integers, distinct
from .frames import (
    determinant,
    displacement_sign,
    hold,
    inverse_upper,
    orthonormalise,
    pass_off_centre,
    pass_pedestal,
    pull,
    turning,
)
from .laws import Columns, Law, LawName, Units
from .points import Pedestal, Point, StepKind
from .segment import LONGEST_STEP

_LARGEST_STACK = 4_000_000  # matrix entries held at once


@dataclass(frozen=True)
class Chain:
    """Uniform segments from left to right that obey one law, and two ends.

    Parameters
    ----------
    law : Law
    length : array, shape (n,)
        [m].
    columns : dict of array, shape (n,)
        The law's columns by name, e.g. `mass`, `stiffness` and `axial_force`.
    left, right : str
        Names of ends of the law.
    points : tuple of Point
        What sits at the nodes, at most one for each node, in order.
    following : tuple of float
        kappa of the left and right end [N]: the part of its force that turns with a free end, where
        then M = 0 and ``Q = kappa psi``. Counts know fixed directions alone: see
        `riccati.following.ratio`.
    """

    law: Law
    length: Array
    columns: Columns
    left: str = "free"
    right: str = "free"
    points: tuple[Point, ...] = ()
    following: tuple[float, float] = (0.0, 0.0)

    @property
    def follows(self) -> bool:
        """Whether the force of an end turns with it: the problem is then not self-adjoint."""
        return any(self.following)

    @property
    def fixed(self) -> Chain:
        """The same chain with end forces that keep their direction."""
        return replace(self, following=(0.0, 0.0)) if self.follows else self

    @property
    def family(self) -> LawName:
        """Name of the law."""
        return self.law.name

    @property
    def mass(self) -> Array:
        """Inertia per length: m [kg/m], or rho I_p [kg m] in torsion, shape (n,)."""
        return self.columns["mass"]

    @property
    def stiffness(self) -> Array:
        """EI [N m^2], EA [N] or GJ [N m^2], shape (n,)."""
        return self.columns["stiffness"]

    @property
    def axial_force(self) -> Array:
        """N [N], compression positive, of a law that has it; shape (n,)."""
        return self.columns["axial_force"]

    @property
    def is_plain(self) -> bool:
        """Whether it has the columns that its law must have, and no others."""
        return len(self.columns) == len(self.law.columns)

    def with_columns(self, **columns: Array) -> Chain:
        """Return the chain with some of its columns replaced."""
        return replace(self, columns={**self.columns, **columns})

    @cached_property
    def nodes(self) -> Array:
        """Positions of the joints and ends, from zero [m], shape (n + 1,)."""
        return np.concatenate([[0.0], np.cumsum(self.length)])

    def split(self, pieces: Integers) -> Chain:
        """Return the same chain with segment k cut into ``pieces[k]`` equal ones."""
        first = np.concatenate([[0], np.cumsum(pieces)])
        length = np.repeat(self.length / pieces, pieces)
        return self._with_segments(length, lambda values: np.repeat(values, pieces), first)

    def cut_at(self, positions: Array) -> Chain:
        """Return the same chain with a joint at each of the ascending positions [m] as well.

        Segments that are not cut keep their length to the last bit, however thin they are.
        """
        nodes = self.nodes
        after = np.searchsorted(nodes, positions).clip(1, len(nodes) - 1)
        gap = np.minimum(np.abs(nodes[after] - positions), np.abs(positions - nodes[after - 1]))
        new = gap > 1e-12 * nodes[-1]
        if not new.any():
            return self
        cut, n = after[new] - 1, len(self.length)
        pieces = np.bincount(cut, minlength=n) + 1
        places = np.concatenate([[0], np.cumsum(pieces)])
        owner = np.repeat(np.arange(n), pieces)
        start, end = np.zeros(len(owner)), self.length[owner]
        inside = np.ones(len(owner), dtype=bool)
        inside[places[:-1]] = False
        start[inside] = positions[new] - nodes[cut]
        end[:-1][inside[1:]] = start[inside]
        return self._with_segments(end - start, lambda values: values[owner], places)

    def _with_segments(
        self, length: Array, column: Callable[[Array], Array], places: Integers
    ) -> Chain:
        """Return the chain with other segments, and its points at the new places of their nodes."""
        columns = {name: column(values) for name, values in self.columns.items()}
        points = tuple(replace(p, node=int(places[p.node])) for p in self.points)
        return replace(self, length=length, columns=columns, points=points)

    @cached_property
    def reference(self) -> tuple[float, float]:
        """Stiffness and mass per length that scale the equations (means over the length)."""
        weight = self.length / self.length.sum()
        return float(np.exp(weight @ np.log(np.abs(self.stiffness)))), float(weight @ self.mass)

    def units(self, omega2: Array) -> Units:
        """Return what scales the states, so that those of a wave at `omega2` are of order one."""
        return Units(self.law.scale_length(self, omega2), self.reference[0])

    def scale_length(self, omega2: Array) -> Array:
        """Return the length [m] that makes the states of a wave at `omega2` of order one."""
        return self.law.scale_length(self, omega2)


def omega2_scale(chain: Chain) -> float:
    """Return a natural unit of omega^2 for the chain [rad^2/s^2]: EI/(m L^4) or EA/(m L^2)."""
    stiffness, mass = chain.reference
    return float(stiffness / (mass * float(chain.length.sum()) ** chain.law.power))


def largest_wave_number(chain: Chain, omega2: float) -> Array:
    """Return the bound on the wave number of every segment at `omega2` [1/m], shape (n,)."""
    return chain.law.wave_number(chain, omega2)


def state_units(chain: Chain, omega2: Array) -> Array:
    """Return what one unit of each scaled state component is in SI, shape (k, s)."""
    return chain.law.state_units(chain.units(omega2))


def split_long(chain: Chain, omega2: float, limit: float = LONGEST_STEP) -> Chain:
    """Return the chain with every segment cut until wave number times length is within `limit`."""
    pieces = np.ceil(largest_wave_number(chain, omega2) * chain.length / limit)
    if not np.all(np.isfinite(pieces)) or np.sum(pieces) > 5e6:
        raise FloatingPointError(f"omega^2 = {omega2:g} rad^2/s^2 is out of reach for this chain")
    if pieces.max() <= 1:
        return chain
    return chain.split(np.maximum(pieces, 1).astype(np.int64))


def block_starts(chain: Chain, omega2: float) -> Integers:
    """Return the first segment of each block: blocks have no clamped-clamped root up to `omega2`.

    A block of length H is safe where the wave number of a uniform one with its softest and heaviest
    columns, times H, is within the law's limit.
    """
    law = chain.law
    phase = np.cumsum(largest_wave_number(chain, omega2) * chain.length)
    first = np.flatnonzero(np.diff(np.floor(phase / law.block_phase), prepend=-1.0))
    inner = [p.node for p in chain.points if 0 < p.node < len(chain.length)]
    starts = distinct(np.concatenate([[0], first[1:], inner]).astype(np.int64))
    length = np.add.reduceat(chain.length, starts)
    worst = replace(chain, length=length, columns=law.worst(chain.columns, starts))
    unsafe = largest_wave_number(worst, omega2) * worst.length > law.block_limit
    if not np.any(unsafe):
        return starts
    block = np.repeat(np.arange(len(starts)), np.diff(starts, append=len(chain.length)))
    return distinct(np.append(starts, np.flatnonzero(unsafe[block])))


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
        For states in units of `state_units`.
    """
    columns = {name: values[segment, None] for name, values in chain.columns.items()}
    distance = (chain.length[segment] if length is None else length)[:, None]
    return chain.law.transfer(distance, columns, omega2, chain.units(omega2))


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


class Steps(NamedTuple):
    """Blocks of segments and points in the order in which a sweep passes them."""

    U: Array
    """Transfer matrix of every step, shape (steps, lanes, s, s)."""
    kind: list[StepKind]
    holds: list[tuple[int, ...]]
    """Displacements held by every step that is a support."""
    symplectic: Array
    off_centre: dict[int, tuple[Array, Array]]
    """Of a step with a mass off its node: how far off, scaled, and the step without that mass."""
    pedestals: dict[int, tuple[Array, Array]]
    """Of a step through a pedestal: numerator and denominator of its stiffness, scaled."""

    def reversed(self) -> Steps:
        """Return the steps as the sweep from the right end passes them."""
        J = self.symplectic
        last = len(self.U) - 1

        def inverse(U: Array) -> Array:
            return np.asarray(-J @ np.swapaxes(U, -1, -2) @ J)

        off = {last - i: (arm, inverse(own)) for i, (arm, own) in self.off_centre.items()}
        pedestals = {last - i: (-n, g) for i, (n, g) in self.pedestals.items()}
        return Steps(inverse(self.U)[::-1], self.kind[::-1], self.holds[::-1], J, off, pedestals)

    @property
    def poles_below(self) -> Array:
        """How many pedestals have omega^2 above their pole, shape (lanes,)."""
        above = [np.real(g) < 0 for _, g in self.pedestals.values()]
        return np.sum(above, axis=0, dtype=np.int64) if above else np.zeros(self.U.shape[1], int)


def make_steps(chain: Chain, omega2: Array, blocks: Array, starts: Integers) -> Steps:
    """Put the points of a chain between its blocks."""
    J = chain.law.symplectic
    if not chain.points:
        return Steps(blocks, ["block"] * len(blocks), [()] * len(blocks), J, {}, {})
    units = state_units(chain, omega2)
    at = {point.node: point for point in chain.points}
    steps: list[tuple[StepKind, Array, tuple[int, ...]]] = []
    off: dict[int, tuple[Array, Array]] = {}
    pedestals: dict[int, tuple[Array, Array]] = {}
    for k, node in enumerate([*starts.tolist(), len(chain.length)]):
        if node in at:
            point, own = at[node], replace(at[node], mass=0.0, pedestal=None)
            if point.mass and point.offset:
                arm = point.offset * units[:, 1] / units[:, 0]
                place = len(steps) + bool(point.holds)
                off[place] = arm, _scaled(chain.law.load(own, omega2), units)
            steps += point_steps(chain.law, replace(point, pedestal=None), omega2, units)
            if point.pedestal is not None:
                own_step = len(steps) - bool(point.compliance)
                pedestals[own_step] = _pedestal(point.pedestal, omega2, units)
                steps.insert(own_step, ("pedestal", _unit(chain.law, len(omega2)), ()))
        if k < len(blocks):
            steps.append(("block", blocks[k], ()))
    kinds, matrices, holds = zip(*steps, strict=True)
    return Steps(np.stack(matrices), list(kinds), list(holds), J, off, pedestals)


def _unit(law: Law, lanes: int) -> Array:
    return np.broadcast_to(np.eye(law.size), (lanes, law.size, law.size))


def _pedestal(pedestal: Pedestal, omega2: Array, units: Array) -> tuple[Array, Array]:
    """Return numerator and denominator of a pedestal's stiffness in the units of the states."""
    numerator, denominator = pedestal.parts(omega2)
    size = np.hypot(pedestal.upper + pedestal.lower, np.abs(pedestal.mass * omega2))
    return numerator / size * units[:, 0] / units[:, -1], denominator / size


def point_steps(
    law: Law, point: Point, omega2: Array, units: Array
) -> list[tuple[StepKind, Array, tuple[int, ...]]]:
    """Return kind, scaled matrix and held displacements of the steps of a point, left to right.

    Parameters
    ----------
    omega2 : array, shape (k,)
    units : array, shape (k, s)
        SI value of one unit of each scaled state component.
    """
    steps: list[tuple[StepKind, Array, tuple[int, ...]]] = []
    if point.holds:
        steps.append(("support", _unit(law, len(omega2)), point.holds))
    if point.loads:
        steps.append(("load", _scaled(law.load(point, omega2), units), ()))
    if point.compliance:
        steps.append(("joint", _scaled(law.joint(point, len(omega2)), units), ()))
    return steps


def _scaled(T: Array, units: Array) -> Array:
    return np.asarray(T * units[:, None, :] / units[:, :, None])


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
    kind = np.result_type(steps.U, start)
    F = np.empty((len(steps.U) + 1, *start.shape), kind)
    R = np.empty((len(steps.U) + 1, len(start), d, d), kind)
    F[0], R[:] = start, np.eye(d)
    factor = np.ones(len(start))
    held: dict[int, Array] = {}
    for i, (U, rows) in enumerate(zip(steps.U, steps.holds, strict=True)):
        if rows:
            F[i + 1], held[i + 1], cut = hold(F[i], rows)
            factor = factor * cut
        elif i in steps.pedestals:
            above, below = steps.pedestals[i]
            if np.iscomplexobj(below):
                F[i + 1], R[i + 1] = orthonormalise(pull(F[i], above / below))
                continue
            F[i + 1], held[i + 1] = pass_pedestal(F[i], above, below)
            factor = np.where(below < 0, -factor, factor)
        elif i in steps.off_centre and not np.iscomplexobj(F):
            F[i + 1], held[i + 1] = pass_off_centre(F[i], U, *steps.off_centre[i])
        else:
            F[i + 1], R[i + 1] = orthonormalise(U @ F[i])
    back = inverse_upper(R)
    for i, matrix in held.items():
        back[i] = matrix
    return Sweep(F, R, back, factor)


def end_frame(chain: Chain, side: int, units: Array, *, adjoint: bool = False) -> Array:
    """Return the frame of states that an end admits: side 0 or -1, units (k, s); (k, s, d).

    Where its force follows, the `adjoint` problem admits others.
    """
    F = chain.law.admitted((chain.left, chain.right)[side], _beside(chain, side), units)
    kappa = chain.following[side]
    return turning(F, force_for_turn(kappa, units), adjoint) if kappa else F


def force_for_turn(kappa: float | Array, units: Array) -> Array:
    """Return Q for a turn of one in the units of the states, shape (k,), or (k, c) of kappas."""
    one = units[:, 1] / units[:, -1]
    return np.asarray(kappa * (one[:, None] if np.ndim(kappa) == 2 else one))


def _beside(chain: Chain, side: int) -> dict[str, Any]:
    """Return the columns of the segment beside an end."""
    return {name: values[side] for name, values in chain.columns.items()}


def right_conditions(chain: Chain, units: Array) -> Array:
    """Return what vanishes at the right end: rows that give zero times its states, (k, d, s)."""
    rows, kappa = chain.law.conditions(chain.right, _beside(chain, -1), units), chain.following[-1]
    if kappa:
        rows = rows.copy()
        rows[:, -1, 1] -= force_for_turn(kappa, units)
    return rows


def characteristic(chain: Chain, F: Array, units: Array) -> Array:
    """Return the determinant of what the right end wants to vanish in the last frame, (k,)."""
    return determinant(right_conditions(chain, units) @ F)


def negative_at_nodes(law: Law, steps: Steps, frames: Sweep) -> Integers:
    """Count the negative eigenvalues met while the nodes are condensed, shape (lanes,)."""
    kind, sign = np.array(steps.kind), displacement_sign(frames.F, law.behind)
    for load in np.flatnonzero((kind == "load") | (kind == "pedestal")):
        # leaves A as it is, but for rounding
        sign[load + 1] = sign[load]
    changes = sign[:-1] * sign[1:] < 0
    block = np.flatnonzero(kind == "block")
    in_blocks = law.negative_in_blocks(
        steps.U[block], frames.F[block], frames.F[block + 1], frames.R[block + 1], changes[block]
    )
    at_joints = np.sum(changes[kind == "joint"], axis=0)
    return np.asarray(in_blocks + at_joints + steps.poles_below, dtype=np.int64)


class Evaluation(NamedTuple):
    """What one pass over the chain tells at each omega^2."""

    below: Integers
    """Number of eigenvalues below omega^2, shape (k,); -1 where a force follows."""
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
    starts, units = block_starts(fine, largest), state_units(fine, omega2)
    blocks = multiply_groups(segment_transfers(fine, omega2), starts)
    steps = make_steps(fine, omega2, blocks, starts)
    frames = sweep(steps, end_frame(fine, 0, units))
    last = frames.F[-1]
    value = frames.factor * characteristic(fine, last, units)
    if fine.follows or "tangential" in fine.columns:
        return Evaluation(np.full(len(omega2), -1), value)
    at_end = fine.law.negative_at_end(last, fine.right)
    below = negative_at_nodes(fine.law, steps, frames) + at_end
    return Evaluation(below, value)


def count_below(chain: Chain, omega2: npt.ArrayLike) -> Integers:
    """Return the number of eigenvalues of the chain below each `omega2`, shape (k,)."""
    return evaluate(chain, omega2).below
