"""Mode shapes with their internal forces along a chain, and integrals of their squares (eq. 81).

At an eigenvalue the frames carried from the two ends share a state. They are matched at the node
where they come closest (where the mode is large), and the state is carried outwards by the changes
of basis of the two sweeps. These shrink where solutions grow, so that nothing is lost on long
chains or for modes that live at one end, where equation 81 taken literally drowns in the growing
solution.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import NamedTuple

import numpy as np

from .arrays import Array, Integers
from .chain import (
    Chain,
    Steps,
    Sweep,
    block_starts,
    end_frame,
    largest_wave_number,
    make_steps,
    multiply_groups,
    segment_transfers,
    split_long,
    state_units,
    sweep,
)
from .laws import Squares
from .points import Point

_CANDIDATE_NODES = 12  # matching nodes tried for a cluster of modes


class Matching(NamedTuple):
    """Both sweeps, and how far their frames are from sharing a state at every block boundary."""

    left: Sweep
    right: Sweep
    gap: Array
    """Smallest singular value of the symplectic product of the frames, (steps + 1, lanes)."""
    state: Array
    """The state closest to both frames, of norm one, (steps + 1, lanes, s)."""


def match(chain: Chain, steps: Steps, units: Array, *, adjoint: bool = False) -> Matching:
    """Sweep from both ends through the steps and compare the frames between them.

    A state lies in a plane where its symplectic product with the adjoint plane is zero: with the
    plane itself, unless an end's force follows.
    """
    left = sweep(steps, end_frame(chain, 0, units, adjoint=adjoint))
    from_right = sweep(steps.reversed(), end_frame(chain, -1, units, adjoint=adjoint))
    F, R, back, factor = from_right
    right = Sweep(F[::-1], R[::-1], back[::-1], factor)
    across = left
    if chain.following[0]:
        across = sweep(steps, end_frame(chain, 0, units, adjoint=not adjoint))
    product = np.swapaxes(across.F, -1, -2) @ chain.law.symplectic @ right.F
    gap, null = _smallest_singular(product)
    return Matching(left, right, gap, np.einsum("...sd,...d->...s", right.F, null))


def _smallest_singular(C: Array) -> tuple[Array, Array]:
    """Return the smallest singular value of 1x1 or 2x2 matrices, and its right vector."""
    if C.shape[-1] == 1:
        return np.abs(C[..., 0, 0]), np.ones(C.shape[:-1])
    norms = np.sum(np.abs(C) ** 2, axis=-1)
    row = np.take_along_axis(C, np.argmax(norms, axis=-1)[..., None, None], axis=-2)[..., 0, :]
    null = np.stack([row[..., 1], -row[..., 0]], axis=-1)
    length = np.linalg.norm(null, axis=-1, keepdims=True)
    null = np.where(length > 0, null / np.where(length > 0, length, 1.0), np.array([1.0, 0.0]))
    determinant = C[..., 0, 0] * C[..., 1, 1] - C[..., 0, 1] * C[..., 1, 0]
    return np.abs(determinant) / np.sqrt(np.maximum(norms.sum(-1), 1e-300)), null


def carry_outwards(left: Sweep, right: Sweep, node: Integers, state: Array) -> Array:
    """Return the states between all steps, given the one at a place of each lane.

    Parameters
    ----------
    left, right : Sweep
        From either end.
    node : array of int, shape (lanes,)
        Place between steps, 0 ... steps.
    state : array, shape (lanes, s)

    Returns
    -------
    array, shape (steps + 1, lanes, s)
    """
    z = np.zeros(left.F.shape[:-1], left.F.dtype)
    last = len(z) - 1
    for part, order in ((left, range(last, -1, -1)), (right, range(last + 1))):
        start = np.einsum("lsd,ls->ld", np.conj(part.F[node, np.arange(len(node))]), state)
        coefficients = np.zeros_like(start)
        for i in order:
            previous = i - order.step
            if 0 <= previous <= last:
                coefficients = np.einsum("lij,lj->li", part.back[previous], coefficients)
            coefficients = np.where((node == i)[:, None], start, coefficients)
            reached = i <= node if order.step < 0 else i >= node
            value = np.einsum("lsd,ld->ls", part.F[i], coefficients)
            z[i] = np.where(reached[:, None], value, z[i])
    return z


def fill_blocks(z: Array, U: Array, starts: Integers) -> Array:
    """Carry the states at block boundaries through the segments of each block.

    Parameters
    ----------
    z : array, shape (blocks + 1, lanes, s)
        At the left end of every block, and at the right end of the last.
    U : array, shape (n, lanes, s, s)
        Transfer matrices of the segments.
    starts : array of int, shape (blocks,)

    Returns
    -------
    array, shape (n + 1, lanes, s)
    """
    states = np.empty((len(U) + 1, *z.shape[1:]), z.dtype)
    states[np.append(starts, len(U))] = z
    sizes = np.diff(starts, append=len(U))
    for position in range(1, int(sizes.max())):
        here = starts[sizes > position] + position
        states[here] = np.einsum("nlij,nlj->nli", U[here - 1], states[here - 1])
    return states


def mode_states(
    chain: Chain, omega2: Array, multiplicity: Integers, *, adjoint: bool = False
) -> Array:
    """Return the states of the modes at every node, on its right side; at the last on its left.

    Parameters
    ----------
    chain : Chain
    omega2 : array, shape (k,)
        Eigenvalues [rad^2/s^2], ascending.
    multiplicity : array of int, shape (k,)
        Size of the cluster each belongs to; its members follow each other.
    adjoint : bool
        Of the adjoint problem: left eigenvectors, where an end's force follows.

    Returns
    -------
    array, shape (n + 1, k, s)
        The law's components, e.g. ``[Y, theta, M, Q]``, in SI up to one factor per mode; the
        members of a cluster are independent of each other.
    """
    largest = float(np.max(np.abs(omega2)))
    fine = split_for(chain, omega2)
    keep = kept_nodes(chain, fine)
    together = max(1, 4_000_000 // (16 * len(fine.length)))
    parts, first = [], 0
    while first < len(omega2):
        last = min(first + together, len(omega2))
        while last < len(omega2) and multiplicity[last] > 1 and omega2[last] == omega2[last - 1]:
            last += 1
        these = slice(first, last)
        found = _states(fine, omega2[these], multiplicity[these], largest, adjoint)
        parts.append(found[keep])
        first = last
    return np.concatenate(parts, axis=1)


def split_for(chain: Chain, omega2: Array) -> Chain:
    """Return the chain with its segments cut short enough for the series at every omega^2."""
    return split_long(chain, float(np.max(np.abs(omega2))))


def cut(chain: Chain, positions: Array, omega2: Array) -> Chain:
    """Return the chain with a joint at each ascending position [m], fit for every omega^2."""
    new = np.append(True, positions[1:] > positions[:-1])
    return split_for(chain.cut_at(positions[new]), np.abs(omega2))


def kept_nodes(chain: Chain, fine: Chain) -> Integers:
    """Return where the nodes of a chain lie among those of a finer one."""
    if fine is chain:
        return np.arange(len(chain.length) + 1)
    ends = np.searchsorted(fine.nodes, chain.nodes)
    nearest = np.abs(fine.nodes[np.maximum(ends - 1, 0)] - chain.nodes)
    after = np.abs(fine.nodes[np.minimum(ends, len(fine.length))] - chain.nodes)
    return np.where(nearest < after, ends - 1, np.minimum(ends, len(fine.length)))


def _states(
    fine: Chain, omega2: Array, multiplicity: Integers, largest: float, adjoint: bool
) -> Array:
    U = segment_transfers(fine, omega2)
    starts = block_starts(fine, largest)
    steps = make_steps(fine, omega2, multiply_groups(U, starts), starts)
    units = state_units(fine, omega2)
    matching = match(fine, steps, units, adjoint=adjoint)
    node = np.argmin(matching.gap, axis=0)
    state = matching.state[node, np.arange(len(omega2))]
    z = carry_outwards(matching.left, matching.right, node, state)
    kinds = np.array(steps.kind)
    block, points = np.flatnonzero(kinds == "block"), np.flatnonzero(kinds != "block")
    weight = np.zeros(len(z))
    weight[block] = np.add.reduceat(fine.mass * fine.length, starts)
    for lane in np.flatnonzero(multiplicity > 1):
        if lane == 0 or omega2[lane - 1] != omega2[lane]:
            members = slice(int(lane), int(lane + multiplicity[lane]))
            z[:, members] = _cluster(matching, int(lane), int(multiplicity[lane]), weight, points)
    states = fill_blocks(z[np.append(block, block[-1] + 1)], U, starts)
    return states * units


def _cluster(matching: Matching, lane: int, members: int, weight: Array, points: Integers) -> Array:
    """Return independent modes of a cluster, matched at several places, (steps + 1, members, s).

    There is a place between any two points: each span may have a mode of its own. Where they cannot
    be told apart, all are NaN.
    """
    gap = matching.gap[:, lane]
    even = np.linspace(0, len(gap), min(_CANDIDATE_NODES, len(gap)) + 1)[1:-1].astype(np.int64)
    spread = np.split(np.arange(len(gap)), sorted({*even.tolist(), *(points + 1).tolist()}))
    nodes = np.array([part[np.argmin(gap[part])] for part in spread if len(part)])
    d = matching.right.F.shape[-1]
    frames = matching.right.F[nodes, lane]
    states = np.concatenate([matching.state[nodes, lane]] + [frames[..., j] for j in range(d)])
    nodes = np.tile(nodes, d + 1)
    quality = gap[nodes]
    quality[len(nodes) // (d + 1) :] = _misfit(matching, lane, nodes, states)[
        len(nodes) // (d + 1) :
    ]
    z = carry_outwards(*_repeat_lane(matching, lane, len(nodes)), nodes, states)
    return _independent(z, weight, quality, members)


def _misfit(matching: Matching, lane: int, nodes: Integers, states: Array) -> Array:
    """Return how far states of the right frame lie outside the left frame."""
    F = matching.left.F[nodes, lane]
    inside = np.einsum("nsd,nd->ns", F, np.einsum("nsd,ns->nd", F, states))
    return np.asarray(np.linalg.norm(states - inside, axis=-1))


def _repeat_lane(matching: Matching, lane: int, times: int) -> tuple[Sweep, Sweep]:
    """Return both sweeps of one lane, as many times side by side."""
    here = np.full(times, lane)
    left, right = (
        Sweep(part.F[:, here], part.R[:, here], part.back[:, here], part.factor[here])
        for part in (matching.left, matching.right)
    )
    return left, right


def _independent(z: Array, weight: Array, quality: Array, members: int) -> Array:
    """Pick and orthogonalise the most independent candidates (pivoted Gram-Schmidt by mass)."""
    displacement = z[..., 0] * np.sqrt(weight)[:, None]
    norm = np.linalg.norm(displacement, axis=0)
    usable = (quality < 1e-5) & (norm > 0)
    scale = np.where(norm > 0, norm, 1.0)
    z, displacement = z / scale[:, None], displacement / scale
    displacement = np.where(usable, displacement, 0.0)
    chosen = np.empty((z.shape[0], members, z.shape[-1]))
    for k in range(members):
        best = int(np.argmax(np.linalg.norm(displacement, axis=0)))
        size = float(np.linalg.norm(displacement[:, best]))
        if size < 1e-6:
            return np.full(chosen.shape, np.nan)
        chosen[:, k] = z[:, best] / size
        unit = displacement[:, best] / size
        share = unit @ displacement
        displacement = displacement - unit[:, None] * share
        z = z - chosen[:, k][:, None, :] * share[:, None]
    return chosen


class Energies(NamedTuple):
    """Quadratic forms of the modes, points included; shape (modes,) but for `squares`."""

    squares: Squares
    mass: Array
    """Integral of m Y^2 and the points' share: the modal mass."""
    stiffness: Array
    """Integral of EI Y''^2 - N Y'^2 (or EA X'^2) and the points' share: omega^2 times the mass."""
    size: Array
    """The same with every term taken positive, and the force of each spring over the largest
    displacement, of which rounding takes a share even where the spring hardly moves: how much
    cancels in the stiffness."""

    def scaled(self, scale: Array) -> Energies:
        """Return those of the modes with a factor on each shape, shape (modes,)."""
        square = scale**2
        squares = Squares(*(part * square for part in self.squares))
        return Energies(squares, *(part * square for part in self[1:]))


def mode_energies(chain: Chain, states: Array, omega2: Array) -> Energies:
    """Return modal mass and stiffness of modes along a chain with all its points.

    Parameters
    ----------
    states : array, shape (n + 1, k, s)
    omega2 : array, shape (k,)
    """
    return energies(chain, states, integrate_squares(chain, states, omega2), omega2)


def energies_between(
    energies_of: Callable[[Chain, Array, Array], Energies],
    chain: Chain,
    right: Array,
    left: Array,
    omega2: Array,
) -> Energies:
    """Return energies between right and left eigenvectors, from those of sums and differences.

    The stiffness holds what following ends do: ``kappa psi_v w`` at the right, less the same at
    the left.
    """
    plus, minus = (energies_of(chain, right + sign * left, omega2) for sign in (1.0, -1.0))
    squares = Squares(*((a - b) / 4 for a, b in zip(plus.squares, minus.squares, strict=True)))
    mass, stiffness = (plus.mass - minus.mass) / 4, (plus.stiffness - minus.stiffness) / 4
    for side, sign in ((0, -1.0), (-1, 1.0)):
        turn = chain.following[side] * right[side, :, 1] * left[side, :, 0]
        stiffness = stiffness + sign * turn
    return Energies(squares, mass, stiffness, np.abs(plus.size + minus.size) / 4)


def energies(
    chain: Chain, states: Array, squares: Squares, omega2: Array | float = 0.0
) -> Energies:
    """Return modal mass and stiffness from the integrals over the segments, and the points."""
    mass, strain, work, size = chain.law.forms(chain.columns, squares)
    reach = np.max(np.abs(states[:, :, 0]), axis=0)
    moved = moved_masses(chain, states, omega2)
    for point in chain.points:
        last = point.node == len(states) - 1
        inertia, elastic = chain.law.point_energies(
            point, states[point.node], last, moved.get(point.node, 0.0)
        )
        mass, strain, size = mass + inertia, strain + elastic, size + np.abs(elastic)
        size = size + point.spring * np.abs(states[point.node][:, 0]) * reach
    return Energies(squares, mass, strain - work, size)


def moved_masses(chain: Chain, states: Array, omega2: Array | float) -> dict[int, Array]:
    """Return how far the masses of pedestals move, (k,) each by node.

    That is ``k_1 Y/(k_1 + k_2 - m omega^2)``; near that pole, where Y all but vanishes, what the
    upper spring pulls by the step of Q tells it.
    """
    found = {}
    lanes = np.broadcast_to(np.asarray(omega2), states.shape[1:2])
    for point in chain.points:
        own = point.pedestal
        if own is None:
            continue
        Y = states[point.node][:, 0]
        x = own.moved(lanes) * Y
        near = np.abs(lanes - own.pole) < NEAR_POLE * own.pole
        if near.any() and not chain.follows:
            x = np.where(near, Y - _pulled(chain, states, lanes, point) / own.upper, x)
        found[point.node] = np.asarray(x)
    return found


NEAR_POLE = 1e-4  # of omega^2
"""How near frames through a pedestal want an unknown of their own."""


def _pulled(chain: Chain, states: Array, omega2: Array, point: Point) -> Array:
    """Return the force with which a pedestal pulls the beam down [N], (k,)."""
    node, law, last = point.node, chain.law, len(states) - 1
    own = law.load(replace(point, pedestal=None), omega2)
    if node == 0:
        before = np.zeros_like(states[0])
        before[:, :2], before[:, -1] = states[0][:, :2], 0.0
        before[:, 1] -= point.compliance * states[0][:, 2]
    else:
        here = slice(node - 1, node)
        before = propagate(chain, states[here], omega2, chain.length[here], here)[0]
    after = np.zeros(len(omega2)) if node == last else states[node][:, -1]
    return np.asarray(np.einsum("ks,ks->k", own[:, -1], before) - after)


def integrate_squares(chain: Chain, states: Array, omega2: Array) -> Squares:
    """Integrate the squares of a mode's state over every segment (Gauss points, exact states).

    Parameters
    ----------
    states : array, shape (n + 1, k, s)
    omega2 : array, shape (k,)
    """
    phase = largest_wave_number(chain, float(np.max(np.abs(omega2)))) * chain.length
    total = np.zeros((len(Squares._fields), len(chain.length), len(omega2)), states.dtype)
    for point, weight in zip(*gauss_rule(float(np.max(phase))), strict=True):
        z = propagate(chain, states[:-1], omega2, point * chain.length)
        total += weight * chain.length[:, None] * chain.law.squares(chain.columns, z)
    return Squares(*total)


RULES = (0.05, 3), (0.2, 4), (0.7, 6), (math.inf, 10)
"""Points for squares of states, up to so much of a wave."""


def gauss_rule(phase: float) -> tuple[Array, Array]:
    """Return points on 0 ... 1 and weights for squares of states over so much of a wave."""
    numbers = (number for limit, number in RULES if phase < limit)
    return gauss_points(next(numbers, RULES[-1][1]))


@cache
def gauss_points(number: int) -> tuple[Array, Array]:
    """Return a rule of Gauss on 0 ... 1."""
    points, weights = np.polynomial.legendre.leggauss(number)
    return (points + 1) / 2, weights / 2


def propagate(
    chain: Chain,
    states: Array,
    omega2: Array,
    distance: Array,
    segment: Integers | slice = slice(None),
) -> Array:
    """Return the states a `distance` [m] into segments from those at their left ends, (n, k, s)."""
    units = state_units(chain, omega2)
    U = segment_transfers(chain, omega2, distance, segment)
    return np.asarray(np.einsum("nkij,nkj->nki", U, states / units) * units)
