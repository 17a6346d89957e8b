r"""A chain that loses or takes energy: what it is without that, and what acts besides.

Motion is ``exp(s t)``, and omega^2 is ``-s^2``. Dashpots, feedback and end forces that turn act at
few displacements q: there the forces are ``-(K + s C) q``. All the rest is self-adjoint: the `base`
chain, whose eigenvalues are real and counted. An end force that turns is a feedback: at the right
end ``Q = kappa psi`` there (at the left ``-kappa``).

Loads along the axis that turn with the section, ``Q' = ... + t psi``, are of the chain itself; the
base chain has none, and of the adjoint problem they act on M (`riccati.lateral`).

Stiffness that loses energy is complex: columns times ``1 + i eta``, for ``Im s > 0``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from antinode.riccati.arrays import Array, Complex, Integers, Numbers
from antinode.riccati.chain import (
    Chain,
    Steps,
    block_starts,
    end_frame,
    make_steps,
    multiply_groups,
    right_conditions,
    split_long,
    state_units,
    sweep,
)
from antinode.riccati.frames import determinant
from antinode.riccati.lateral import without_tangential
from antinode.riccati.laws import Columns, Squares
from antinode.riccati.points import Point, moving

if TYPE_CHECKING:
    from .ratio import RatioSamples

_LARGEST_STACK = 2_000_000  # complex matrix entries held at once


Matrix = tuple[float, float, float, float]


class Acting(NamedTuple):
    """Displacements at which something acts that is not of the base chain, and its matrices."""

    node: list[int]
    freedom: list[int]
    K: Array
    """Shape (r, r), forces of displacements."""
    C: Array
    """Of velocities."""


class Passed(NamedTuple):
    """A chain at some s: its segments, the steps through it, and its units."""

    fine: Chain
    U: Numbers
    """Of every segment, shape (n, k, s, s)."""
    starts: Integers
    steps: Steps
    units: Array


class Form:
    """What answers for a chain at complex s; None stands for what numpy is to answer: here, all.

    Parameters
    ----------
    damped : Damped
    """

    def __init__(self, damped: Damped) -> None:
        self.damped = damped

    def characteristic(self, s: Complex) -> tuple[Complex, Array] | None:
        """Return D and the logarithm of its size (`Damped.characteristic`)."""
        return None

    def find(
        self,
        starts: Complex,
        known: list[complex],
        *,
        zeros: int,
        unit: float,
        floor: float,
        mirrored: bool,
    ) -> tuple[Complex, Array] | None:
        """Return where secants end, and their last steps (`search.Search.run`)."""
        return None

    def states(self, s: Complex) -> Complex | None:
        """Return states of modes (`shapes.complex_states`)."""
        return None

    def products(self, s: Numbers, right: Numbers, left: Numbers) -> tuple[Squares, Squares] | None:
        """Return integrals of w v and of conj(v) v over every segment (`energies.products`)."""
        return None

    def samples(self, s: Complex, poles: Array) -> RatioSamples | None:
        """Return samples of g, bounded (`ratio.Ratio.samples`)."""
        return None

    def ratios(self, s: Complex) -> Complex | None:
        """Return g alone (`ratio.Ratio.values`)."""
        return None

    def receptances(self, omega2: Complex) -> Complex | None:
        """Return G of the base chain (`ratio.Ratio.receptances`)."""
        return None


@dataclass(frozen=True)
class Damped:
    """A chain with all that acts on it.

    Parameters
    ----------
    chain : Chain
        Columns without loss.
    columns : dict of array, optional
        The same columns as they lose energy, complex; none where nothing does.
    adjoint : bool
        Whether every feedback stands transposed: its states are left eigenvectors then.
    form : type
        What answers for it: compiled code (`damped.compiled`), or numpy alone.
    """

    chain: Chain
    columns: Columns | None = None
    adjoint: bool = False
    form: type[Form] = Form

    @cached_property
    def other(self) -> Form:
        """What answers for it in place of the functions here, where it can."""
        return self.form(self)

    @cached_property
    def points(self) -> tuple[Point, ...]:
        """All that sits at the nodes, end forces that turn as feedback."""
        at = {point.node: point for point in self.chain.points}
        last = len(self.chain.length)
        for node, kappa in ((0, -self.chain.following[0]), (last, self.chain.following[1])):
            if kappa:
                point = at.get(node, Point(node))
                a, b, c, d = point.feedback or (0.0, 0.0, 0.0, 0.0)
                at[node] = replace(point, feedback=(a, b + kappa, c, d))
        points = tuple(at[node] for node in sorted(at))
        return tuple(map(_transposed, points)) if self.adjoint else points

    @cached_property
    def base(self) -> Chain:
        """The self-adjoint rest: springs with the diagonal of every feedback's stiffness."""
        return replace(
            self.chain,
            columns=without_tangential(self.chain.columns),
            following=(0.0, 0.0),
            points=tuple(map(_undamped, self.points)),
        )

    @cached_property
    def is_symmetric(self) -> bool:
        """Whether the problem is its own adjoint, so that left eigenvectors are the right ones."""
        alike = (point == _transposed(point) for point in self.points)
        return not self.turns and all(alike)

    @property
    def turns(self) -> bool:
        """Whether loads along the axis turn with the section."""
        return "tangential" in self.chain.columns

    @property
    def without_turning(self) -> Damped:
        """The same without these loads; N stays."""
        columns = without_tangential(self.chain.columns)
        return replace(self, chain=replace(self.chain, columns=columns))

    @cached_property
    def acting(self) -> Acting:
        """What acts besides, at displacements that nothing holds."""
        law, last = self.chain.law, len(self.chain.length)
        held = {(0, i) for i in law.ends[self.chain.left]}
        held |= {(last, i) for i in law.ends[self.chain.right]}
        blocks: list[tuple[list[tuple[int, int]], Array, Array]] = []
        for point in self.points:
            if not (point.feeds_back or point.damps):
                continue
            K, C = _matrices(point, law.size // 2)
            both = np.abs(K) + np.abs(C)
            felt = (both.sum(0) + both.sum(1)).tolist()
            free = [
                i
                for i in range(len(K))
                if felt[i] and (point.node, i) not in held and i not in point.holds
            ]
            if free:
                some = np.ix_(free, free)
                blocks.append(([(point.node, i) for i in free], K[some], C[some]))
        places = [place for block in blocks for place in block[0]]
        total_K, total_C = np.zeros((2, len(places), len(places)))
        first = 0
        for own, K, C in blocks:
            these = slice(first, first + len(own))
            total_K[these, these], total_C[these, these] = K, C
            first += len(own)
        return Acting([n for n, _ in places], [i for _, i in places], total_K, total_C)

    @property
    def transposed(self) -> Damped:
        """The adjoint problem, whose states are left eigenvectors."""
        return replace(self, adjoint=not self.adjoint)

    def passed(self, s: Complex) -> Passed:
        """Return the steps through the chain at some s, shape (k,)."""
        omega2: Numbers = -s * s
        largest = float(np.max(np.abs(omega2)))
        moved = replace(
            self.chain, following=(0.0, 0.0), points=tuple(moving(p, s) for p in self.points)
        )
        if self.adjoint:
            moved = adjoint_chain(moved)
        fine = split_long(moved, largest)
        columns = fine.columns
        if self.columns is not None:
            middle = (fine.nodes[1:] + fine.nodes[:-1]) / 2
            owner = np.searchsorted(self.chain.nodes, middle) - 1
            own = adjoint_columns(self.columns) if self.adjoint else self.columns
            columns = {name: values[owner] for name, values in own.items()}
        starts, units = block_starts(fine, largest), state_units(fine, omega2)
        beside = {name: values[:, None] for name, values in columns.items()}
        U = fine.law.transfer(fine.length[:, None], beside, omega2, fine.units(omega2))
        steps = make_steps(fine, omega2, multiply_groups(U, starts), starts)
        return Passed(fine, U, starts, steps, units)

    def characteristic(self, s: Complex) -> tuple[Complex, Array]:
        """Return the entire characteristic function D(s), shape (k,): value and logarithm of size.

        It is ``value exp(size)``, size real: the determinant of equation 66 without its growth.
        """
        found = self.other.characteristic(s)
        if found is not None:
            return found
        together = max(1, _LARGEST_STACK // (16 * len(self.chain.length)))
        parts = [self._characteristic(s[i : i + together]) for i in range(0, len(s), together)]
        value, size = zip(*parts, strict=True)
        return np.concatenate(value), np.concatenate(size)

    def _characteristic(self, s: Complex) -> tuple[Complex, Array]:
        fine, _, _, steps, units = self.passed(s)
        frames = sweep(steps, end_frame(fine, 0, units).astype(complex))
        value = frames.factor * determinant(right_conditions(fine, units) @ frames.F[-1])
        size = np.sum(np.log(np.diagonal(frames.R, axis1=-2, axis2=-1).real), axis=(0, -1))
        for i, rows in enumerate(steps.holds):
            if len(rows) == 1:
                size = size + np.log(_after_hold(frames.F[i], rows[0]))
        law, logarithm = fine.law, np.log(units)
        free = [i for i in range(law.size) if i not in law.zeros(fine.left)]
        size = size + logarithm[:, law.zeros(fine.right)].sum(-1) - logarithm[:, free].sum(-1)
        return np.asarray(value), np.asarray(size)


def adjoint_chain(chain: Chain) -> Chain:
    """Return the chain whose states are left eigenvectors, as to loads that turn."""
    return replace(chain, columns=adjoint_columns(chain.columns)) if _turning(chain) else chain


def _turning(chain: Chain) -> bool:
    return any(name.startswith("tangential") for name in chain.columns)


def adjoint_columns(columns: Columns) -> Columns:
    """Return columns with the load that turns acting on M, or on Q again."""
    other = {"tangential": "tangential_adjoint", "tangential_adjoint": "tangential"}
    return {other.get(name, name): values for name, values in columns.items()}


def _after_hold(F: Numbers, row: int) -> Array:
    """Return by what a frame shrinks where a support holds one of two displacements."""
    a = np.stack([F[:, row, 1], -F[:, row, 0]], axis=-1)
    state = np.einsum("ksd,kd->ks", F, a)
    state[:, [row, F.shape[1] - 1 - row]] = 0.0
    return np.asarray(np.linalg.norm(state, axis=-1))


def _undamped(point: Point) -> Point:
    """Return a point without dashpots, and of a feedback its springs alone."""
    K = point.feedback or (0.0, 0.0, 0.0, 0.0)
    return replace(
        point,
        spring=point.spring + K[0],
        rotational_spring=point.rotational_spring + K[3],
        dashpot=0.0,
        rotational_dashpot=0.0,
        feedback=None,
        feedback_damping=None,
    )


def _matrices(point: Point, freedoms: int) -> tuple[Array, Array]:
    """Return K and C of what acts at a point beside the base chain."""
    K, C = point.feedback or _NONE, point.feedback_damping or _NONE
    apart = [[0.0, K[1]], [K[2], 0.0]]
    rates = [[C[0] + point.dashpot, C[1]], [C[2], C[3] + point.rotational_dashpot]]
    return np.array(apart)[:freedoms, :freedoms], np.array(rates)[:freedoms, :freedoms]


_NONE = (0.0, 0.0, 0.0, 0.0)


def _transposed(point: Point) -> Point:
    def turned(K: Matrix | None) -> Matrix | None:
        return K and (K[0], K[2], K[1], K[3])

    return replace(
        point,
        feedback=turned(point.feedback),
        feedback_damping=turned(point.feedback_damping),
    )
