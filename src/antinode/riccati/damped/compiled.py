"""Chains at complex s in compiled code: eight s side by side (`riccati.lanes.forced.free`).

Lateral motion, with all that acts at points and with columns that lose energy. What is left to
numpy gives None: bars, shafts, loads along the axis that turn, and what is out of reach.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from antinode.riccati.arrays import Array, Complex, Integers, Numbers
from antinode.riccati.chain import Chain
from antinode.riccati.forced import Loads
from antinode.riccati.lanes.forced.layout import (
    BASIS,
    EVERY,
    KEEP,
    PHASE,
    SEARCH,
    SIZE,
    Acting,
    Ends,
    Free,
    RatioWork,
    Room,
    Rule,
    Sampled,
    Zeros,
    new_room,
)
from antinode.riccati.lanes.forced.states import (
    Cut,
    at_shares,
    cut,
    driven_chain,
    ends_of,
    is_known,
    most_bases,
    node_steps,
    steps_of,
)
from antinode.riccati.lanes.library import library
from antinode.riccati.lanes.structures import Kept
from antinode.riccati.laws import Columns, Squares
from antinode.riccati.shapes import gauss_rule

from .chain import Acting as ActingOn
from .chain import Damped, Form
from .ratio import RatioSamples

_MOST_BASES = 200_000  # that one group of lanes keeps
_LENGTHS = 1, 0, -1, -2  # powers of l in the units of states
_STEP = 16.0  # the largest abs(omega^2) is taken up to a power of this
_REACH = 2.0  # times its unit, as far as a search goes: the chain is cut for that at once


class _Own(NamedTuple):
    """The segments of a chain cut for some size of omega^2, its ends and units."""

    cut: Cut
    rest: tuple[Ends, float, float, float, float]

    @classmethod
    def of(cls, chain: Chain, columns: Columns, phase: Array) -> _Own:
        """Return those of a chain with columns that may lose energy."""
        zero, (stiffness, mass) = np.zeros(1), chain.reference
        unit = float(chain.scale_length(zero)[0]) ** -4
        rest = ends_of(chain, zero), mass / stiffness, unit, *_units(chain)
        return cls(cut(chain, columns, phase), rest)


class _Ready(NamedTuple):
    """A chain cut for some size of omega^2."""

    free: Kept[Free]
    room: Kept[Room]


class _Driven(NamedTuple):
    """A base chain under unit forces where something acts."""

    acting: Kept[Acting]
    room: Kept[Room]
    marks: int

    @classmethod
    def of(cls, ready: _Ready, acting: ActingOn, nodes: Integers) -> _Driven:
        """Return a chain that is cut with what acts on it."""
        steps = ready.free.structure.chain.steps
        marks = steps[steps[:, 0] == KEEP]
        left = np.flatnonzero(marks[:, 2] == 0)
        mark = left[np.searchsorted(nodes, acting.node)]
        freedom = np.array(acting.freedom, dtype=np.int64)
        K, C = np.ascontiguousarray(acting.K), np.ascontiguousarray(acting.C)
        given = Acting(ready.free.structure, mark, freedom, K, C)
        return cls(Kept(given), ready.room, len(marks))

    def work(self, places: int) -> RatioWork:
        """Return room for so many places."""
        r = len(self.acting.structure.mark)
        return RatioWork(
            np.empty((places, 2)),
            np.empty(places, np.int64),
            np.empty((self.marks, SIZE, r, places, 2)),
            np.empty((places, r, r, 2)),
            *(np.empty((r, r, 2)) for _ in range(4)),
        )


class CompiledSamples(RatioSamples):
    """Samples whose bounds compiled code works out."""

    def spread(self, distance: Array) -> Array:
        """Return how far the function may be from its values within a distance of each."""
        at, value, reach, a, b, c, d, e, acting, size = self
        room, out = np.empty((*a.shape[1:], 2)), np.empty(len(at))
        found = Sampled(_pairs(value), reach, a, b, c, d, e, _parts(acting), size)
        far = np.ascontiguousarray(np.broadcast_to(distance, out.shape), dtype=float)
        library("complex").call("spread", _pairs(at), found, far, room, out)
        return out


class Compiled(Form):
    """What compiled code tells of one chain with all that acts on it.

    Parameters
    ----------
    damped : Damped
    """

    def __init__(self, damped: Damped) -> None:
        chain = replace(damped.chain, following=(0.0, 0.0), points=damped.points)
        super().__init__(damped)
        self._own: dict[tuple[int, bool], _Own | None] = {}
        self._of_base: dict[int | None, _Driven | None] = {}
        self._chain, self._columns = chain, damped.columns or damped.chain.columns
        self._known = is_known(chain)
        self._ready: dict[int | None, _Ready | None] = {}
        self._marked: dict[int | None, _Ready] = {}
        self._search = np.empty(SEARCH)

    def characteristic(self, s: Complex) -> tuple[Complex, Array] | None:
        """Return D(s) as `Damped.characteristic` does."""
        ready = self._free(float(np.max(np.abs(s))) ** 2)
        if ready is None:
            return None
        value, size = np.empty(len(s), complex), np.empty(len(s))
        given = ready.free, _pairs(s), ready.room, self._search, value.view(float).reshape(-1, 2)
        _done(library("complex").call("characteristic", *given, size))
        return value, size

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
        """Return what `search.Search.run` does."""
        asked = Zeros(zeros, float(unit), float(floor), _REACH * float(unit), mirrored)
        ready = self._free(float(unit) ** 2)
        if ready is None:
            return None
        found, step = np.empty(len(starts), complex), np.empty(len(starts))
        roots = np.array(known, dtype=complex)
        given = ready.free, asked, _pairs(starts), _pairs(roots), ready.room, self._search
        _done(library("complex").call("find_zeros", *given, _pairs(found), step))
        return found, step

    def samples(self, s: Complex, poles: Array) -> RatioSamples | None:
        """Return samples of g, bounded, where something acts."""
        ready = self._driven(float(np.max(np.abs(s))) ** 2) if len(s) else None
        if ready is None:
            return None
        k, r = len(s), len(ready.acting.structure.mark)
        size, number = (k, r), (k, r, r)
        a, b, c, d, e = (np.empty(number) for _ in range(5))
        ends = np.empty((*number, 2)), np.empty(size)
        found = Sampled(np.empty((k, 2)), np.empty(k), a, b, c, d, e, *ends)
        work = ready.work(2 * k)
        given = ready.acting, _pairs(s), poles, ready.room, work, found
        _done(library("complex").call("ratio", *given))
        value, acting = (np.asarray(z.view(complex)[..., 0]) for z in (found.value, found.acting))
        return CompiledSamples(s, value, found.reach, a, b, c, d, e, acting, found.size)

    def ratios(self, s: Complex) -> Complex | None:
        """Return g alone."""
        ready = self._driven(float(np.max(np.abs(s))) ** 2) if len(s) else None
        if ready is None:
            return None
        value, work = np.empty(len(s), complex), ready.work(len(s))
        _done(
            library("complex").call(
                "ratio_values", ready.acting, _pairs(s), ready.room, work, _pairs(value)
            )
        )
        return value

    def receptances(self, omega2: Complex) -> Complex | None:
        """Return G of the base chain, shape (k, r, r)."""
        ready = self._driven(float(np.max(np.abs(omega2)))) if len(omega2) else None
        if ready is None:
            return None
        work = ready.work(len(omega2))
        _done(
            library("complex").call("receptances", ready.acting, _pairs(omega2), ready.room, work)
        )
        return np.asarray(work.G.view(complex)[..., 0])

    def states(self, s: Complex) -> Complex | None:
        """Return the states of modes as `shapes.complex_states` does.

        They come from what the right end wants: a support that holds all cuts it off from the rest.
        """
        cut_off = any(len(point.holds) > 1 for point in self._chain.points)
        ready = None if cut_off else self._at_nodes(s)
        if ready is None:
            return None
        out = np.empty((len(self._chain.length) + 1, SIZE, 1, len(s), 2))
        _done(library("complex").call("free_modes", ready.free, _pairs(s), ready.room, out))
        return np.asarray(out.view(complex)[:, :, 0, :, 0].transpose(0, 2, 1))

    def products(self, s: Numbers, right: Numbers, left: Numbers) -> tuple[Squares, Squares] | None:
        """Return the integrals of ``w v`` and of ``conj(v) v`` over every segment, shape (n, k)."""
        ready = self._at_nodes(s)
        if ready is None:
            return None
        chain, given = self._chain, ready.free.structure.chain
        phase = given.constants[:, PHASE] * given.pieces
        points, weights = gauss_rule(float(np.max(phase)))
        constants = at_shares(given.constants, points)
        rule = Rule(weights, constants, chain.length, np.real(chain.axial_force))
        out = np.zeros((2, len(Squares._fields), len(chain.length), len(s), 2))
        v = _parts(right)
        w = v if left is right else _parts(left)
        taken = ready.free, rule, _pairs(s), w, v, ready.room, out
        _done(library("complex").call("products", *taken))
        whole = out.view(complex)[..., 0]
        return Squares(*whole[0]), Squares(*whole[1])

    def _at_nodes(self, s: Numbers) -> _Ready | None:
        """Return the chain with marks at its nodes."""
        key = _size(float(np.max(np.abs(s))) ** 2)
        own = self._segments(key, base=False)
        if own is None:
            return None
        if key not in self._marked:
            loads = Loads({}, np.zeros((len(self._chain.length), 1)), np.zeros(1))
            self._marked[key] = self._made(self._chain, own, loads, node_steps(self._chain))
        return self._marked[key]

    def _driven(self, largest: float) -> _Driven | None:
        """Return the base chain under unit forces where something acts."""
        acting, key = self.damped.acting, _size(largest)
        if key not in self._of_base:
            own = self._segments(key, base=True) if acting.node else None
            self._of_base[key] = own and self._under_forces(own)
        return self._of_base[key]

    def _under_forces(self, own: _Own) -> _Driven:
        base, acting = self.damped.base, self.damped.acting
        number, d = len(acting.node), base.law.size // 2
        at: dict[int, Array] = {}
        for case, (node, freedom) in enumerate(zip(acting.node, acting.freedom, strict=True)):
            at.setdefault(node, np.zeros((d, number)))[freedom, case] = 1.0
        loads = Loads(at, np.zeros((len(base.length), number)), np.zeros(number))
        nodes = np.array(sorted(at), dtype=np.int64)
        ready = self._made(base, own, loads, steps_of(base, sorted(at), nodes))
        return _Driven.of(ready, acting, nodes)

    def _free(self, largest: float) -> _Ready | None:
        """Return the chain for places up to some size of omega^2."""
        key = _size(largest)
        if key not in self._ready:
            own = self._segments(key, base=False)
            loads = Loads({}, np.zeros((len(self._chain.length), 0)), np.zeros(0))
            steps = steps_of(self._chain, [], np.zeros(0, np.int64))
            self._ready[key] = own and self._made(self._chain, own, loads, steps)
        return self._ready[key]

    def _segments(self, key: int | None, *, base: bool) -> _Own | None:
        """Return the segments for a size of omega^2; the base chain's lose no energy."""
        lossy = self.damped.columns is not None and not base
        if key is None or not self._known:
            return None
        if (key, lossy) not in self._own:
            chain = self._chain
            phase = chain.law.wave_number(chain, _STEP**key) * chain.length
            columns = self._columns if lossy else chain.columns
            within = float(np.sum(phase)) < BASIS * _MOST_BASES
            self._own[key, lossy] = _Own.of(chain, columns, phase) if within else None
        return self._own[key, lossy]

    def _made(self, chain: Chain, own: _Own, loads: Loads, steps: Integers) -> _Ready:
        """Return a chain of these segments."""
        driven = driven_chain(chain, own.cut, loads, steps)
        free = Free(driven, *own.rest)
        kinds = steps[:, 0]
        between = steps[kinds == EVERY]
        marks = int(np.sum(kinds == KEEP) + np.sum(between[:, 2] - between[:, 1] - 1))
        bases = most_bases(chain, own.cut.phase, loads)
        return _Ready(Kept(free), Kept(new_room(loads.cases, bases, marks)))


def _size(largest: float) -> int | None:
    """Return the power of `_STEP` up to which omega^2 may go: the same whatever came before.

    A search that stays in a circle, and samples on that, have the same.
    """
    if not 0 <= largest < math.inf:
        return None
    return math.ceil(math.log(max(_REACH**2 * largest, 1e-300)) / math.log(_STEP))


def _units(chain: Chain) -> tuple[float, float]:
    """Return p and q where D has ``p log(l) + q`` for its units, those of [Y, psi, M, Q]."""
    law = chain.law
    wanted, held = law.zeros(chain.right), law.zeros(chain.left)
    rows = [*wanted, *held]  # what is free at the left counts less: all but what is held
    power = sum(_LENGTHS[i] for i in rows) - sum(_LENGTHS)
    stiff = sum(i > 1 for i in rows) - 2
    return float(power), stiff * math.log(chain.reference[0])


def _pairs(values: Numbers) -> Array:
    """Return complex numbers as rows of two."""
    return _parts(values).reshape(-1, 2)


def _parts(values: Numbers) -> Array:
    """Return complex numbers as real and imaginary parts, in one more dimension."""
    whole = np.ascontiguousarray(values, dtype=complex)
    return whole.view(float).reshape(*whole.shape, 2)


def _done(results: list[int]) -> None:
    if results[0]:
        raise FloatingPointError("the chain takes more bases than were expected")
