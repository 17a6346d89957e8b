r"""Forced vibration of a chain: a frame carried along, with a particular state.

Between the ends every state is ``z = F a + p``: F spans what the left end admits, p answers the
forces met so far. A step ``z+ = U z + f`` gives

    F+ R = U F,   q = F+^H (U p + f),   p+ = U p + f - F+ q,   a = R^-1 (a+ - q),

so that p keeps what F cannot take, and neither grows (Godunov's sweep; with f = 0 it is the Riccati
recursion, equation 74). The right end's conditions give a there, and the last of the four carries
it back. No mode is left out: the answer is exact for the chain, at any complex omega^2 and
stiffness that `Law.transfer` takes.

A force F along a displacement makes the jump that an inertia force m omega^2 u makes, because a
mass is felt as that force (`Law.load`): ``Q+ = Q- + F``, ``M+ = M- - moment``, ``T+ = T- - T``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from .arrays import Array, Integers, Numbers
from .chain import (
    Chain,
    end_frame,
    multiply_groups,
    right_conditions,
    split_long,
    state_units,
)
from .laws import Columns, Law, Units
from .points import Point, moving
from .shapes import gauss_rule, kept_nodes

_LARGEST_STACK = 2_000_000  # complex matrix entries held at once
_POLE = 1e-16  # beside the largest, what stands for a determinant that is nothing
_BLOCK_PHASE = 1.25  # of a wave, in radians, that is multiplied without a new basis


@dataclass(frozen=True)
class Loads:
    """What drives a chain, by load case.

    Parameters
    ----------
    at_nodes : dict
        By node: forces along the displacements of the law, shape (d, cases) [N, N m].
    along : array, shape (n, cases)
        Force along the first displacement per length of each segment [N/m, N m/m].
    ground : array, shape (cases,)
        Motion of all that is fixed to the ground, along the first displacement [m, rad].
    """

    at_nodes: Mapping[int, Array]
    along: Array
    ground: Array

    @property
    def cases(self) -> int:
        """How many load cases there are."""
        return len(self.ground)


class Lanes(NamedTuple):
    """The frequencies at which a chain is driven, side by side.

    Attributes
    ----------
    omega2 : array, shape (k,)
        [rad^2/s^2], complex.
    dashpot : array, shape (k,)
        What a dashpot of 1 N s/m adds to a spring: i omega [1/s], complex.
    """

    omega2: Numbers
    dashpot: Numbers


class Sides(NamedTuple):
    """States at some nodes, on either side of what sits there: by node, shape (k, s, cases)."""

    left: list[Numbers]
    right: list[Numbers]


def unit_jump(law: Law, freedom: int) -> Array:
    """Return the jump of the state by a unit force along a displacement, shape (s,)."""
    one = Point(0, mass=1.0) if freedom == 0 else Point(0, inertia=1.0)
    T = law.load(one, np.ones(1))[0] - np.eye(law.size)
    return np.asarray(T[:, freedom])


def forced_states(
    chain: Chain, columns: Columns, lanes: Lanes, loads: Loads, wanted: Integers
) -> Sides:
    """Return the states of a driven chain at some of its nodes.

    Parameters
    ----------
    chain : Chain
        With its real columns.
    columns : dict of array, shape (n,)
        The columns as they damp: complex where they lose energy.
    lanes : Lanes
    loads : Loads
    wanted : array of int
        Nodes, ascending.

    Returns
    -------
    Sides
        SI. Outside of the two ends the state is that of what the end is fastened to.
    """
    largest = float(np.max(np.abs(lanes.omega2)))
    fine = split_long(chain, largest)
    owner = np.searchsorted(chain.nodes, (fine.nodes[1:] + fine.nodes[:-1]) / 2) - 1
    place = kept_nodes(chain, fine)
    fine_loads = Loads(
        {int(place[node]): force for node, force in loads.at_nodes.items()},
        loads.along[owner],
        loads.ground,
    )
    fine_columns = {name: values[owner] for name, values in columns.items()}
    together = max(1, _LARGEST_STACK // (16 * len(owner)))
    parts = []
    for first in range(0, len(lanes.omega2), together):
        some = Lanes(*(values[first : first + together] for values in lanes))
        parts.append(_states(fine, fine_columns, some, fine_loads, place[wanted]))
    lefts, rights = zip(*parts, strict=True)
    return Sides(*(list(np.concatenate(side, axis=1)) for side in (lefts, rights)))


class DrivenChain:
    """A chain with what drives it, ready to be asked at any frequencies.

    Parameters
    ----------
    chain, columns, loads, wanted
        As `forced_states` takes them.
    """

    def __init__(self, chain: Chain, columns: Columns, loads: Loads, wanted: Integers) -> None:
        self._asked = chain, columns, loads, wanted

    def states(self, lanes: Lanes) -> Sides:
        """Return the states on either side of the wanted nodes."""
        chain, columns, loads, wanted = self._asked
        return forced_states(chain, columns, lanes, loads, wanted)


class _Step(NamedTuple):
    """Between two places: ``a = back a+ + shift``, and the frame and particular state after it."""

    F: Numbers
    p: Numbers
    back: Numbers
    shift: Numbers


def _states(
    chain: Chain, columns: Columns, lanes: Lanes, loads: Loads, wanted: Integers
) -> tuple[Numbers, Numbers]:
    """Carry frame and particular state to the right end, and the coefficients back.

    Return the states left and right of the nodes, shape (nodes, k, s, cases).
    """
    sweep = _Sweep(chain, columns, lanes, loads)
    before, after = sweep.run(wanted)
    a = sweep.last_coefficients()
    k, s = sweep.units.shape
    left = np.empty((len(wanted), k, s, loads.cases), dtype=complex)
    right = np.empty_like(left)
    for number in range(len(sweep.steps) - 1, -1, -1):
        step = sweep.steps[number]
        for index in before.get(number, ()):
            left[index] = step.F @ a + step.p
        for index in after.get(number, ()):
            right[index] = step.F @ a + step.p
        a = step.back @ a + step.shift
    scale = sweep.units[:, :, None]
    return left * scale, right * scale


class _Sweep:
    """One sweep from the left end: its steps, and where nodes lie among them."""

    def __init__(self, chain: Chain, columns: Columns, lanes: Lanes, loads: Loads) -> None:
        self.chain, self.columns, self.lanes, self.loads = chain, columns, lanes, loads
        self.law = chain.law
        foundation = chain.columns.get("foundation", np.zeros(len(chain.length)))
        self.along = loads.along + foundation[:, None] * loads.ground
        size = np.abs(lanes.omega2)
        self.of_chain: Units = chain.units(size)
        self.units = state_units(chain, size)
        frame = end_frame(chain, 0, self.units).astype(complex)
        p = np.zeros((*self.units.shape, loads.cases), dtype=complex)
        for row in self.law.ends[chain.left]:
            p[:, row] = self._ground(row)
        d = frame.shape[-1]
        start = np.broadcast_to(np.eye(d, dtype=complex), (len(size), d, d))
        zero = np.zeros((len(size), d, loads.cases), dtype=complex)
        self.steps = [_Step(frame, p, start, zero)]

    def _ground(self, row: int) -> Numbers:
        """Return the scaled motion of the ground along a displacement, shape (k, cases)."""
        motion = self.loads.ground if row == 0 else np.zeros(self.loads.cases)
        return np.asarray(motion / self.units[:, row, None])

    def run(self, wanted: Integers) -> tuple[dict[int, list[int]], dict[int, list[int]]]:
        """Pass all nodes; return which wanted nodes have their left and right side at each step."""
        points = {point.node: point for point in self.chain.points}
        stops = {*points, *self.loads.at_nodes, *wanted.tolist(), 0, len(self.chain.length)}
        places = sorted(stops)
        index = {node: i for i, node in enumerate(wanted.tolist())}
        before: dict[int, list[int]] = {}
        after: dict[int, list[int]] = {}
        for k, node in enumerate(places):
            if node in index:
                before.setdefault(len(self.steps) - 1, []).append(index[node])
            self._pass_node(points.get(node), self.loads.at_nodes.get(node))
            if node in index:
                after.setdefault(len(self.steps) - 1, []).append(index[node])
            if k + 1 < len(places):
                self._pass_segments(node, places[k + 1])
        return before, after

    def last_coefficients(self) -> Numbers:
        """Return the coefficients that meet the right end's conditions."""
        chain, last = self.chain, self.steps[-1]
        C = right_conditions(chain, self.units)
        wall = np.zeros_like(last.p)
        for row in self.law.ends[chain.right]:
            wall[:, row] = self._ground(row)
        closing = C @ last.F
        for lane in np.flatnonzero(np.linalg.det(closing) == 0.0):  # a pole: as near as numbers are
            closing[lane] += _POLE * np.max(np.abs(closing[lane])) * np.eye(closing.shape[-1])
        return np.asarray(np.linalg.solve(closing, C @ (wall - last.p)))

    def _pass_node(self, point: Point | None, force: Array | None) -> None:
        """Pass supports, then masses, springs and forces, then a joint."""
        if point is not None and point.holds:
            self._hold(point.holds)
        if force is not None or (point is not None and _acts(point)):
            self._pass_loads(point, force)
        if point is not None and point.compliance:
            T = self.law.joint(point, len(self.units)).astype(complex)
            self._pass(self._scaled(T), None)

    def _pass_loads(self, point: Point | None, force: Array | None) -> None:
        law, f = self.law, np.zeros_like(self.steps[-1].p)
        for freedom in range(law.size // 2 if force is not None else 0):
            assert force is not None
            jump = unit_jump(law, freedom)[:, None] * force[freedom]
            f += jump / self.units[:, :, None]
        if point is None:
            self._add(f)
            return
        stiff = moving(point, self.lanes.dashpot)
        tied = replace(stiff, mass=0.0, inertia=0.0, own_load=0.0, feedback=None, pedestal=None)
        pull = np.eye(law.size)[:, 0] - law.load(tied, self.lanes.omega2)[:, :, 0]
        if point.pedestal is not None:
            pull[:, -1] += point.pedestal.passed_on(self.lanes.omega2)
        f += pull[:, :, None] * self.loads.ground / self.units[:, :, None]
        self._pass(self._scaled(law.load(stiff, self.lanes.omega2)), f)

    def _pass_segments(self, node: int, end: int) -> None:
        """Pass the segments between two nodes, in blocks of a part of a wave."""
        some = slice(node, end)
        columns = {name: values[some, None] for name, values in self.columns.items()}
        length = self.chain.length[some, None]
        U = self.law.transfer(length, columns, self.lanes.omega2, self.of_chain)
        along = self.along[some]
        if np.any(along):
            driven = self._driven(length, columns)
            for k in range(end - node):
                self._pass(U[k], driven[k, :, :, None] * along[k])
            return
        wave = self.law.wave_number(self.chain, float(np.max(np.abs(self.lanes.omega2))))
        phase = np.cumsum((wave * self.chain.length)[some])
        starts = np.flatnonzero(np.diff(np.floor(phase / _BLOCK_PHASE), prepend=-1.0))
        starts[0] = 0
        for block in multiply_groups(U, starts):
            self._pass(block, None)

    def _driven(self, length: Array, columns: Columns) -> Numbers:
        """Return the state behind segments under a unit force per length, (n, k, s)."""
        jump = unit_jump(self.law, 0) / self.units
        total = np.zeros((len(length), *self.units.shape), dtype=complex)
        for point, weight in zip(*gauss_rule(1.0), strict=True):
            U = self.law.transfer(point * length, columns, self.lanes.omega2, self.of_chain)
            total += weight * length[:, :, None] * np.einsum("nkij,kj->nki", U, jump)
        return total

    def _scaled(self, T: Numbers) -> Numbers:
        return np.asarray(T * self.units[:, None, :] / self.units[:, :, None])

    def _add(self, f: Numbers) -> None:
        """Pass a force alone."""
        before = self.steps[-1]
        q = np.swapaxes(before.F.conj(), -1, -2) @ f
        unit = np.broadcast_to(np.eye(q.shape[-2], dtype=complex), (*q.shape[:-1], q.shape[-2]))
        self.steps.append(_Step(before.F, before.p + f - before.F @ q, unit, -q))

    def _pass(self, U: Numbers, f: Numbers | None) -> None:
        """Pass ``z+ = U z + f``."""
        before = self.steps[-1]
        F, inverse = orthonormal(U @ before.F)
        g = U @ before.p
        g = g if f is None else g + f
        q = np.swapaxes(F.conj(), -1, -2) @ g
        self.steps.append(_Step(F, g - F @ q, inverse, -inverse @ q))

    def _hold(self, rows: tuple[int, ...]) -> None:
        """Pass a support, which moves as the ground does."""
        F, p, _, _ = self.steps[-1]
        k, s, d = F.shape
        new, wall = np.zeros_like(F), np.zeros_like(p)
        back = np.zeros((k, d, d), dtype=complex)
        if len(rows) == d:
            new[:, d:] = np.eye(d)
            for row in rows:
                wall[:, row] = self._ground(row)
            shift = np.linalg.solve(F[:, :d], (wall - p)[:, :d])
            self.steps.append(_Step(new, wall, back, shift))
            return
        row, force = rows[0], s - 1 - rows[0]
        moved, null = self._onto(F[:, row], self._ground(row) - p[:, row])
        wall = p + F @ moved
        wall[:, row], wall[:, force] = self._ground(row), 0.0
        state = np.einsum("ksd,kd->ks", F, null)
        state[:, [row, force]] = 0.0
        length = np.linalg.norm(state, axis=-1, keepdims=True)
        new[:, :, 0], new[:, force, 1] = state / length, 1.0
        back[:, :, 0] = null / length
        q = np.swapaxes(new.conj(), -1, -2) @ wall
        self.steps.append(_Step(new, wall - new @ q, back, moved - back @ q))

    @staticmethod
    def _onto(row: Numbers, missing: Numbers) -> tuple[Numbers, Numbers]:
        """Return the shortest a with ``row a = missing``, and a unit vector that row annuls."""
        size = np.linalg.norm(row, axis=-1, keepdims=True)
        unit = row / size
        null = np.stack([unit[:, 1], -unit[:, 0]], axis=-1)
        return (unit.conj() / size)[:, :, None] * missing[:, None, :], null


def _acts(point: Point) -> bool:
    """Tell whether a mass, a spring, a dashpot or a feedback acts at a point."""
    return point.loads or point.damps or point.feeds_back


def orthonormal(V: Numbers) -> tuple[Numbers, Numbers]:
    """Return Q with orthonormal columns and R^-1, where ``V = Q R``, for one or two columns."""
    k, _, d = V.shape
    Q, inverse = np.empty_like(V), np.zeros((k, d, d), dtype=complex)
    first = V[..., 0]
    size = 1.0 / np.sqrt(_square(first))
    Q[..., 0] = first * size[:, None]
    inverse[:, 0, 0] = size
    if d == 2:
        r = np.einsum("ks,ks->k", Q[..., 0].conj(), V[..., 1])
        second = V[..., 1] - r[:, None] * Q[..., 0]
        other = 1.0 / np.sqrt(_square(second))
        Q[..., 1] = second * other[:, None]
        inverse[:, 1, 1] = other
        inverse[:, 0, 1] = -r * size * other
    return Q, inverse


def _square(v: Numbers) -> Array:
    return np.asarray(np.sum(v.real**2 + v.imag**2, axis=-1))
