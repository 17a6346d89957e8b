"""`riccati.forced.DrivenChain` by compiled code."""

from __future__ import annotations

from functools import cache
from itertools import pairwise
from math import comb, factorial
from typing import NamedTuple

import numpy as np

from antinode.riccati import forced as readable
from antinode.riccati.arrays import Array, Integers, Numbers
from antinode.riccati.chain import Chain, end_frame, right_conditions, state_units
from antinode.riccati.forced import Lanes, Loads, Sides
from antinode.riccati.lanes.library import library
from antinode.riccati.lanes.workspace import LANES
from antinode.riccati.lateral import Lateral
from antinode.riccati.laws import Columns, Law
from antinode.riccati.points import Point

from .layout import (
    BASIS,
    CONSTANTS,
    EVERY,
    FORCE,
    HOLD,
    INERT,
    JOINT,
    KEEP,
    LANE,
    LENGTH,
    LOADS,
    LONGEST,
    PHASE,
    POINT,
    POWERS,
    SEGMENTS,
    SIZE,
    TERMS,
    Driven,
    Ends,
    new_room,
)

_MOST_BASES = 200_000  # that one group of lanes keeps
_AS_HIGH = 1e-3  # by which omega^2 may be above that for which segments were parted
_FIELDS = "mass", "offset", "inertia", "spring", "rotational_spring", "coupling", "own_load"
_LENGTHS = np.repeat(
    [2, 4, -2, 0, 1, 0, 2, 4], [4, 4, 2, 6, 1, 1, 1, 1]
)  # powers of h in constants
_MORE_FIELDS = "dashpot", "rotational_dashpot", "compliance"
_NONE = (0.0, 0.0, 0.0, 0.0)


class DrivenChain:
    """A chain with what drives it, ready to be asked at any frequencies.

    Bars and shafts, loads that turn with the section, pedestals, and what would take too many
    bases, are left to the readable form.

    Parameters
    ----------
    chain, columns, loads, wanted
        As `riccati.forced.forced_states` takes them.
    """

    def __init__(self, chain: Chain, columns: Columns, loads: Loads, wanted: Integers) -> None:
        self._asked = chain, columns, loads, wanted
        self._plain = is_known(chain)
        self._largest = 0.0
        self._made: tuple[Driven, int] | None = None

    def states(self, lanes: Lanes) -> Sides:
        """Return the states at the wanted nodes."""
        chain, columns, loads, wanted = self._asked
        size = np.abs(lanes.omega2)
        driven, bases = self._driven(float(np.max(size))) if self._plain else (None, 0)
        if driven is None:
            return readable.forced_states(chain, columns, lanes, loads, wanted)
        places = driven.steps[driven.steps[:, 0] == KEEP, 1:]
        out = np.empty((len(places), SIZE, loads.cases, len(size), 2))
        room = new_room(loads.cases, bases, len(places))
        given = driven, ends_of(chain, size), _lanes(chain, lanes, size), room, out
        if library("forced").call("drive", *given)[0]:
            raise FloatingPointError("the chain takes more bases than were expected")
        left: list[Numbers] = []
        right: list[Numbers] = []
        for states, after in zip(out.view(complex)[..., 0], places[:, 1], strict=True):
            if after:
                right[-1] = states.transpose(2, 0, 1)
            else:  # it is the same on the right where nothing stands
                left.append(states.transpose(2, 0, 1))
                right.append(left[-1])
        return Sides(left, right)

    def _driven(self, largest: float) -> tuple[Driven | None, int]:
        """Return the chain in pieces that are short enough, and how many bases they take.

        Those of a frequency before do where it was as high, but not more than twice.
        """
        if self._made is not None and 0.25 < largest / self._largest < 1 + _AS_HIGH:
            return self._made
        chain, columns, loads, wanted = self._asked
        phase = chain.law.wave_number(chain, largest) * chain.length
        bases = most_bases(chain, float(np.sum(phase)), loads)
        if bases > _MOST_BASES:
            return None, bases
        steps = steps_of(chain, sorted(loads.at_nodes), wanted)
        driven = driven_chain(chain, cut(chain, columns, phase), loads, steps)
        self._largest, self._made = largest, (driven, bases)
        return self._made


def most_bases(chain: Chain, total: float, loads: Loads) -> int:
    """Return how many bases a sweep takes at most; very many where no number comes out."""
    if not np.isfinite(total) or total > BASIS * _MOST_BASES:
        return _MOST_BASES + 1
    # two neighbouring bases have more than a limit of phase behind them together
    return int(2 * total / BASIS) + 3 * (len(chain.points) + len(loads.at_nodes)) + 8


class Cut(NamedTuple):
    """The segments of a chain in pieces short enough for some size of omega^2."""

    constants: Array
    pieces: Integers
    series: Array
    phase: float
    """Of a wave all along."""


def cut(chain: Chain, columns: Columns, phase: Array) -> Cut:
    """Return a chain in pieces, for a wave of so much phase in each segment."""
    pieces = np.maximum(np.ceil(phase / LONGEST), 1).astype(np.int64)
    constants = constants_of(chain, columns, pieces, phase / pieces)
    return Cut(constants, pieces, _series(chain, constants), float(np.sum(phase)))


def driven_chain(chain: Chain, own: Cut, loads: Loads, steps: Integers) -> Driven:
    """Return a chain in pieces with its points and what drives it."""
    along = loads.along
    if loads.ground.any() and "foundation" in chain.columns:
        along = along + chain.columns["foundation"][:, None] * loads.ground
    rows = [_row(point) for point in chain.points]
    forces = [loads.at_nodes[node] for node in sorted(loads.at_nodes)]
    return Driven(
        steps,
        own.constants,
        own.pieces,
        own.series,
        np.ascontiguousarray(along, dtype=float),
        np.array(rows, dtype=float).reshape(-1, POINT),
        np.array(forces, dtype=float).reshape(len(forces), 2, loads.cases),
        np.array(loads.ground, dtype=float),
        chain.reference[0],
    )


def is_known(chain: Chain) -> bool:
    """Tell whether the compiled form knows a chain's law, columns and points."""
    turning = any(name.startswith("tangential") for name in chain.columns)
    if turning or any(point.pedestal is not None for point in chain.points):
        return False
    return isinstance(chain.law, Lateral)


def _row(point: Point) -> list[float]:
    """Return a point as `layout` has it."""
    own = [getattr(point, name) for name in (*_FIELDS, *_MORE_FIELDS)]
    return [*own, *(point.feedback or _NONE), *(point.feedback_damping or _NONE)]


def steps_of(chain: Chain, forced: list[int], wanted: Integers) -> Integers:
    """Return the steps from the left end to the right one."""
    index = {node: i for i, node in enumerate(wanted.tolist())}
    points = {point.node: (i, point) for i, point in enumerate(chain.points)}
    places = sorted({*points, *forced, *index, 0, len(chain.length)})
    steps: list[tuple[int, int, int]] = []
    for here, after in zip(places, [*places[1:], -1], strict=True):
        if here in index:
            steps.append((KEEP, index[here], 0))
        number, point = points.get(here, (-1, None))
        force = forced.index(here) if here in forced else -1
        steps += _at_node(number, point, force)
        if here in index and (point is not None or force >= 0):
            steps.append((KEEP, index[here], 1))
        if after >= 0:
            steps.append((SEGMENTS, here, after))
    return np.array(steps)


def node_steps(chain: Chain) -> Integers:
    """Return the steps with a mark at every node: behind what stands there, at the last before."""
    n = len(chain.length)
    points = {point.node: (i, point) for i, point in enumerate(chain.points)}
    nothing: tuple[int, Point | None] = -1, None
    places = sorted({*points, 0, n})
    steps: list[tuple[int, int, int]] = []
    for here, after in pairwise(places):
        number, point = points.get(here, nothing)
        steps += [*_at_node(number, point, -1), (KEEP, here, 0)]
        steps.append((EVERY, here, after))
    number, point = points.get(n, nothing)
    steps += [(KEEP, n, 0), *_at_node(number, point, -1)]
    return np.array(steps)


def _at_node(number: int, point: Point | None, force: int) -> list[tuple[int, int, int]]:
    """Return a support, then what has mass or pulls, then a joint."""
    steps: list[tuple[int, int, int]] = []
    acts = point is not None and (point.loads or point.damps or point.feeds_back)
    if point is not None and point.holds:
        steps.append((HOLD, number, sum(1 << row for row in point.holds)))
    if acts or force >= 0:
        steps.append((LOADS, number if acts else -1, force))
    if point is not None and point.compliance:
        steps.append((JOINT, number, 0))
    return steps


def constants_of(chain: Chain, columns: Columns, pieces: Integers, phase: Array) -> Array:
    """Return the constants of a piece of every segment, shape (n, CONSTANTS)."""
    h, EI, K0 = chain.length / pieces, columns["stiffness"], chain.reference[0]
    s, turn, work, rotary, foundation = (columns.get(name, 0.0) for name in chain.law.more)
    two, four = h * h, h**4
    own = np.zeros((len(h), LENGTH // 2), dtype=complex)
    own[:, 0], own[:, 1] = (columns["axial_force"] + work) * two / EI, rotary * two / EI
    own[:, 2], own[:, 3] = -foundation * four / EI, columns["mass"] * four / EI
    own[:, 4], own[:, 5], own[:, 6], own[:, 7] = s * EI / two, 1 + turn, K0 / EI, EI / K0
    constants = np.empty((len(h), CONSTANTS))
    constants[:, :LENGTH], constants[:, LENGTH], constants[:, PHASE] = own.view(float), h, phase
    constants[:, FORCE] = columns["axial_force"].real * two / K0
    constants[:, INERT] = columns["mass"].real * four / K0
    return constants


def at_shares(constants: Array, shares: Array) -> Array:
    """Return the constants of a share of every piece, shape (shares, n, CONSTANTS)."""
    return np.asarray(constants * shares[:, None, None] ** _LENGTHS)


def _series(chain: Chain, constants: Array) -> Array:
    """Return g_3 ... g_0 in powers of c, ``sum C(k - p, p) b^(k - 2 p) c^p/(2 k + j)!``."""
    if not chain.is_plain:
        return np.empty((0, 8 * POWERS))
    powers = np.ones((len(constants), TERMS), complex)
    powers[:, 1:] = -constants[:, :2].copy().view(complex)
    return (np.cumprod(powers, axis=1) @ _weights()).view(float)


@cache
def _weights() -> Array:
    """Return what each power of b has in each power of c of each series."""
    weights = np.zeros((TERMS, 4 * POWERS))
    for column in range(4 * POWERS):
        j, p = 3 - column // POWERS, column % POWERS
        for k in range(2 * p, TERMS):
            weights[k - 2 * p, column] = comb(k - p, p) / factorial(2 * k + j)
    return weights


def _groups(values: Array) -> Array:
    """Return rows of numbers in groups of lanes, shape (groups, numbers LANES)."""
    missing = -len(values) % LANES
    whole = np.concatenate([values, np.repeat(values[-1:], missing, axis=0)])
    whole = whole.reshape(-1, LANES, values[0].size).transpose(0, 2, 1)
    return np.ascontiguousarray(whole.reshape(len(whole), -1))


def _lanes(chain: Chain, lanes: Lanes, size: Array) -> Array:
    parts = np.empty((len(size), LANE // LANES))
    parts[:, 0], parts[:, 1] = lanes.omega2.real, lanes.omega2.imag
    parts[:, 2], parts[:, 3] = lanes.dashpot.real, lanes.dashpot.imag
    parts[:, 4] = chain.scale_length(size)
    parts[:, 5] = 1 / parts[:, 4]
    return _groups(parts)


def ends_of(chain: Chain, size: Array) -> Ends:
    """Return what the ends admit and want, for lanes of these abs(omega^2)."""
    if not any(chain.following):
        return _alike(chain.law, chain.left, chain.right)
    ends, units = chain.law.ends, state_units(chain, size)  # these tell how much of a force turns
    start = np.swapaxes(end_frame(chain, 0, units), 1, 2)
    conditions = np.broadcast_to(right_conditions(chain, units), start.shape)
    frame, wanted = (_groups(np.asarray(part, dtype=float)) for part in (start, conditions))
    return Ends(frame, wanted, 0 in ends[chain.left], 0 in ends[chain.right])


@cache
def _alike(law: Law, left: str, right: str) -> Ends:
    """Return the ends of a chain whose forces keep their direction: the same in all units."""
    one, held = np.eye(SIZE), law.zeros(left)
    start, wanted = one[[i for i in range(SIZE) if i not in held]], one[law.zeros(right)]
    frame, conditions = (_groups(part[None]) for part in (start, wanted))
    return Ends(frame, conditions, 0 in law.ends[left], 0 in law.ends[right])
