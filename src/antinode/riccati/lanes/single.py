"""One chain in compiled code: evaluations and root searches.

Where end forces follow, the elastic eigenvalues are found and proven as those of batches are
(`riccati.lanes.following`). One rotation is left below them that is not exactly zero: the one
change of sign there of the characteristic function, divided by omega^2 where a translation is free.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from antinode.riccati.arrays import Array, Integers
from antinode.riccati.chain import Chain, Evaluation, omega2_scale
from antinode.riccati.reasons import CERTIFIED, CHAIN_TOO_SMALL, TABLE_TOO_SMALL
from antinode.riccati.roots import Certificate, Eigenvalue, FollowingRoots

from .laws import FORMS
from .library import library
from .scratch import scratch
from .workspace import NO_MORE, NO_POINTS, POINT, Task, new_roots
from .workspace import Chain as Own

_NEAREST = 1e-9  # to zero, of the chain's own omega^2, where the sign is sure
_TINY = 1e-14  # of it, which is as good as zero
_PLACES = 12  # on either side of zero
_PASSES = 40
_MORE = 0, 2, 5  # eigenvalues than are wanted
_LANES_BESIDE = np.array([0.02, 3e-4, 5e-6])  # of a bracket, from where the root is expected

Bracket = tuple[float, float, float, float]
"""Two places with values of different signs, and these."""


class Found(NamedTuple):
    """Consecutive eigenvalues of one chain, each with its certificate [rad^2/s^2]."""

    reason: int
    omega2: Array
    low: Array
    high: Array
    counts: Integers
    rounding: Array
    evaluations: int
    line: float
    """Where ends follow: left of it the eigenvalues are proven to be all [rad^2/s^2]."""
    margin: float
    """What the proof leaves of 1."""
    samples: int
    """Of the proof."""


def more_columns(chain: Chain) -> Array:
    """Return what segments have besides as the rows of `workspace.Chain.more`."""
    if chain.is_plain:
        return NO_MORE
    none = np.zeros(len(chain.length))
    return np.stack([chain.columns.get(name, none) for name in chain.law.more])


def in_si(chain: Chain) -> Own:
    """Return a chain as compiled code takes it, not scaled; its arrays are those of the chain."""
    form, points = FORMS[chain.law], NO_POINTS
    marks = np.full(len(chain.length) + 1, -1)
    if chain.points:
        marks[[point.node for point in chain.points]] = np.arange(len(chain.points))
        points = np.array([form.point(point, 1.0, 1.0, 1.0) for point in chain.points])
    force = chain.axial_force if chain.law.has_axial_force else np.zeros(len(chain.length))
    return Own(
        form.number if chain.is_plain else form.with_more,
        form.ends[chain.left],
        form.ends[chain.right],
        length=_contiguous(chain.length),
        mass=_contiguous(chain.mass),
        stiffness=_contiguous(chain.stiffness),
        force=_contiguous(force),
        starts=np.empty(len(marks), np.int64),
        marks=marks,
        points=points,
        more=more_columns(chain),
        following=np.array(chain.following),
    )


def _contiguous(values: Array) -> Array:
    return np.ascontiguousarray(values, dtype=float)


class SingleChain:
    """One chain made dimensionless, ready for evaluations and root searches.

    Parameters
    ----------
    chain : Chain
        Without supports that need frames.
    """

    def __init__(self, chain: Chain) -> None:
        form, given = FORMS[chain.law], in_si(chain)
        self.sign = form.sign(chain.left, chain.right)
        own = given._replace(
            length=given.length.copy(),
            mass=given.mass.copy(),
            stiffness=given.stiffness.copy(),
            force=given.force.copy(),
        )
        units = np.empty(4)
        library("roots").call("scale", own, units)
        self.unit, L, m0, stiffness = units.tolist()
        own.following[:] *= L * L / stiffness
        self.follows = chain.follows
        if chain.points:
            rows = np.array([form.point(point, L, stiffness, m0) for point in chain.points])
            own = own._replace(points=rows.reshape(-1, POINT))
        self.chain = own

    def __call__(self, omega2: Array) -> Evaluation:
        """Evaluate the chain at every omega^2 [rad^2/s^2]."""
        scaled, columns = omega2 / self.unit, len(self.chain.length)
        largest = float(np.max(np.abs(scaled)))
        while True:
            table = scratch.table(columns)
            pieces = library("roots").call("prepare", self.chain, largest, table)[0]
            if pieces <= table.shape[1]:
                break
            columns = pieces
        if pieces < 0:
            worst = float(np.max(np.abs(omega2)))
            raise FloatingPointError(f"omega^2 = {worst:g} is out of reach for this chain")
        count, value = np.empty(len(scaled), np.int64), np.empty(len(scaled))
        library("roots").call("evaluate", self.chain, scaled, table, scratch.lanes, count, value)
        return Evaluation(count * 0 - 1 if self.follows else count, self.sign * value)

    def roots(self, below: int, number: int, width: float) -> Found:
        """Bracket and certify eigenvalues below + 1 ... below + number.

        Parameters
        ----------
        width : float
            Relative width of the brackets in omega^2.
        """
        task, found, search = Task(below, width, True), new_roots(number), scratch.search(number)
        columns = len(self.chain.length) + 8
        while True:
            reason, total, _ = library("roots").call(
                "find_roots",
                *(self.chain, task, False, 0.0, found),
                *(scratch.table(columns), scratch.lanes, search),
            )
            if reason != TABLE_TOO_SMALL:
                break
            columns = total
        omega2, low, high, rounding = (
            self.unit * v for v in (found.omega2, found.low, found.high, found.rounding)
        )
        line, margin, samples = search.structure.proof.tolist()
        proof = self.unit * line, margin, int(samples)
        return Found(reason, omega2, low, high, found.counts, rounding, total, *proof)

    def lowest(self, wanted: int, zeros: int, width: float) -> list[Eigenvalue] | None:
        """Return the lowest eigenvalues, and every other one below or at zero, certified.

        None where determinants do not tell them apart.

        Parameters
        ----------
        wanted : int
            How many from the lowest at the least.
        zeros : int
            How many are exactly zero.
        width : float
            Relative width of the brackets in omega^2.
        """
        number, columns = wanted, len(self.chain.length) + 8
        while True:
            found, search = new_roots(number), scratch.search(number)
            reason, total, _ = library("roots").call(
                "find_lowest",
                *(self.chain, zeros, wanted, width, self.unit, found),
                *(scratch.table(columns), scratch.lanes, search),
            )
            if reason == TABLE_TOO_SMALL:
                columns = total
            elif reason == CHAIN_TOO_SMALL:
                number = total
            else:
                break
        if reason != CERTIFIED:
            return None
        omega2, low, high, counts = (
            values.tolist() for values in (found.omega2, found.low, found.high, found.counts)
        )
        return [
            Eigenvalue(k + 1, omega2[k], (low[k], high[k]), (counts[k][0], counts[k][1]))
            for k in range(total)
        ]


# --- where end forces follow ----------------------------------------------------------------------


def find_following(
    chain: Chain, below: int, wanted: int, *, zeros: int, free: bool, width: float
) -> FollowingRoots | None:
    """Return the lowest eigenvalues of a chain, proven; None where this proof does not reach.

    Parameters
    ----------
    chain : Chain
        Without supports that need frames.
    below, wanted : int
        How many eigenvalues are rigid, and how many are wanted, rigid ones included.
    zeros : int
        How many are exactly zero on any chain.
    free : bool
        Whether the rotation is zero as the chain gets finer: it may be as near as it likes.
    width : float
        Relative width of the brackets in omega^2.
    """
    if not 0 <= below - zeros <= 1:
        return None
    ready, number = SingleChain(chain), max(wanted - below, 1)
    for more in _MORE:  # higher gaps are easier to prove
        found = ready.roots(below, number + more, width)
        if found.reason == CERTIFIED or not found.omega2[0] > 0:
            break
    if found.reason != CERTIFIED:
        return None
    scale = omega2_scale(chain)
    tiny = _TINY * scale
    listed = [
        Eigenvalue(0, omega2, (low, high), (0, 0))
        for omega2, low, high in zip(*(v.tolist() for v in found[1:4]), strict=True)
    ]
    listed += [Eigenvalue(0, 0.0, (-tiny, tiny), (0, 0))] * zeros
    if below > zeros:
        edges = -found.line, listed[0].omega2 / 2
        rotation = _rotation(ready, edges, _NEAREST * scale, zeros, free, width)
        if rotation is None:
            return None
        listed.append(rotation)
    listed.sort(key=lambda value: value.omega2)
    numbered = [Eigenvalue(k + 1, v.omega2, v.bracket, (k, k + 1)) for k, v in enumerate(listed)]
    proof = found.samples, found.margin
    return FollowingRoots(numbered, Certificate(found.line, len(listed), 0, *proof), True)


def _rotation(
    ready: SingleChain,
    edges: tuple[float, float],
    nearest: float,
    zeros: int,
    free: bool,
    width: float,
) -> Eigenvalue | None:
    """Bracket the one eigenvalue between two edges; None where it cannot be told from zero."""

    def divided(places: Array) -> Array:
        return np.asarray(ready(places).characteristic * (np.sign(places) if zeros % 2 else 1.0))

    if not edges[1] > nearest:
        return None
    left, right = (np.geomspace(nearest, abs(edge), _PLACES) for edge in edges)
    places = np.concatenate([-left[::-1], right])
    values = divided(places)
    change = np.flatnonzero(values[1:] * values[:-1] <= 0)
    if len(change) != 1:
        return None
    k = int(change[0])
    low, high, a, b = map(float, (*places[k : k + 2], *values[k : k + 2]))
    bracket = low, high, a, b
    if places[k] < 0 < places[k + 1]:
        middle = float(_secant(bracket)) or nearest * _TINY
        return Eigenvalue(0, middle, bracket[:2], (0, 0)) if free else None
    low, high, a, b = _shrunk(divided, bracket, width)
    root = min(max(_secant((low, high, a, b)), low), high)
    return Eigenvalue(0, root, (low, high), (0, 0))


def _shrunk(divided: Callable[[Array], Array], bracket: Bracket, width: float) -> Bracket:
    """Return a bracket shrunk to its width: samples at once in whole passes of lanes."""
    low, high, a, b = bracket
    for _ in range(_PASSES):
        size = width * max(abs(low), abs(high))
        if high - low <= size:
            break
        guess, whole = _secant((low, high, a, b)), high - low
        away = np.concatenate([[0.45 * size], _LANES_BESIDE * whole])
        places = np.unique(np.concatenate([guess - away, guess + away, [(low + high) / 2]]))
        places = places[(places > low) & (places < high)]
        values = divided(places)
        k = int(np.argmax(np.append(values, b) * a <= 0))
        places, values = np.append(places, high), np.append(values, b)
        before = (low, a) if k == 0 else (float(places[k - 1]), float(values[k - 1]))
        low, a, high, b = *before, float(places[k]), float(values[k])
    return low, high, a, b


def _secant(bracket: Bracket) -> float:
    low, high, a, b = bracket
    return (low + high) / 2 if a == b else low - a * (high - low) / (b - a)
