"""Python's side of the compiled chain: arrays in and out, one call for each question.

This module is a backend, as `riccati.readable` is: both answer the same calls.
"""

from __future__ import annotations

import threading
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from antinode.riccati import shapes
from antinode.riccati.arrays import Array, Integers
from antinode.riccati.chain import (
    Chain,
    Evaluation,
    largest_wave_number,
    omega2_scale,
    point_steps,
    state_units,
)
from antinode.riccati.chain import evaluate as evaluate_readable
from antinode.riccati.chains import BeamRoots, ChainRoots, Chains, Tables
from antinode.riccati.laws import BENDING, Squares
from antinode.riccati.points import Point
from antinode.riccati.reasons import CERTIFIED, CHAIN_TOO_SMALL, TABLE_TOO_SMALL
from antinode.riccati.roots import Eigenvalue, check_certificate
from antinode.riccati.roots import find_eigenvalues as find_readable
from antinode.riccati.segment import LONGEST_STEP

from . import kernel as lanes
from . import shapes as lane_shapes
from .kernel import ENDS, LANES
from .library import library

name = "numba"

_KEPT = 16  # sizes of chains whose arrays a thread keeps
_MOST_STEPS = 4096  # coarsest ones of a beam
_MOST_NODES = 20_000  # whose frames are kept
_MANY = 64  # chains of a batch from which integrals over shapes are worth their time
_GUESSED = 1e-8  # relative width of brackets of the chain in the middle of a batch
_ENDS = {(left, right): np.array([ENDS[left], ENDS[right]]) for left in ENDS for right in ENDS}
_NO_POINTS = np.empty(0, np.int64), np.empty((0, 8)), np.empty((0, 8))


def evaluate(chain: Chain, omega2: npt.ArrayLike) -> Evaluation:
    """Count the eigenvalues below each `omega2`: `riccati.chain.evaluate`, compiled.

    Parameters
    ----------
    chain : Chain
        Supports at its two ends belong into `left` and `right`; one that needs frames gets them.
    omega2 : array_like, shape (k,)
        [rad^2/s^2], any sign.

    Returns
    -------
    Evaluation
        The characteristic function is scaled to the last minors of each omega^2: bounded by 1.
    """
    asked = np.atleast_1d(np.asarray(omega2, dtype=float))
    return evaluate_readable(chain, asked) if _needs_frames(chain) else SingleChain(chain)(asked)


def _needs_frames(chain: Chain) -> bool:
    """Tell whether supports stand where the compiled chain does not know them."""
    known = range(1, len(chain.length)) if chain.law is BENDING else ()
    return any(point.holds and point.node not in known for point in chain.points)


def _point_rows(points: Sequence[Point], L: float, EI0: float, m0: float) -> Array:
    """Return what `lanes` reads of each point, dimensionless, shape (points, 8)."""
    table = np.zeros((len(points), 8))
    for k, p in enumerate(points):
        inertia = p.mass * p.offset**2 + p.inertia
        turning = p.rotational_spring + p.own_load * p.offset if p.loads else 0.0
        table[k] = (
            *(p.mass / (m0 * L), p.mass * p.offset / (m0 * L**2), inertia / (m0 * L**3)),
            *(p.spring * L**3 / EI0, turning * L / EI0),
            *(float(0 in p.holds), float(1 in p.holds), p.compliance * EI0 / L),
        )
    return table


def _bar_point_rows(points: Sequence[Point], L: float, EA0: float, m0: float) -> Array:
    """Return the same of a longitudinal chain."""
    table = np.zeros((len(points), 8))
    for k, p in enumerate(points):
        table[k, [0, 3, 7]] = p.mass / (m0 * L), p.spring * L / EA0, p.compliance * EA0 / L
    return table


def _workspace(n: int, roots: int) -> tuple[npt.NDArray[Any], ...]:
    """Return the arrays that `lanes.find_roots` writes into."""
    most = lanes.MOST_SAMPLES[0] + lanes.MOST_SAMPLES[1] * roots
    return (
        np.empty((most, 9)),
        np.empty(most),
        np.zeros(most, np.int64),
        np.empty(n + 1, np.int64),
        np.full(n + 1, -1),
        np.empty((0, 8)),
        np.zeros(8 * LANES),
        np.zeros(LANES),
        np.zeros(LANES),
        np.zeros(roots),
        np.zeros(roots, np.int64),
        np.zeros((roots, 2), np.int64),
        np.zeros((roots, 4), np.int64),
        np.zeros(4, np.int64),
        np.zeros(4),
        np.zeros(4),
        np.zeros((roots, 3)),
        np.zeros(roots, np.int64),
        np.zeros(roots, np.bool_),
    )


def solve_chains(chains: Chains, below: int, number: int, width: float) -> ChainRoots:
    """Solve chain after chain, each from the roots of the one before.

    The table is new in every call: its size decides where a row starts afresh, and a result must
    not depend on what was solved before.

    Parameters
    ----------
    chains : Chains
    below : int
        Eigenvalues below those wanted: the rigid ones.
    number : int
        Of eigenvalues wanted.
    width : float
        Relative width of the brackets in omega^2.
    """
    length, mass, stiffness, force = _whole(chains)
    n, ends, found = mass.shape[1], _ends(chains), ChainRoots.empty(len(chains), number)
    neighbour, current, slope = np.full(1, -1), np.zeros(number), np.zeros(number)
    weights, quotient, own = np.empty((3, 0, n)), np.zeros((2, number)), np.empty((4, n))
    if len(chains) >= _MANY and len(length) == 1:
        weights = _weights(_middle(chains), below, number, weights)
    table, work, row = np.empty((lanes.ROWS, n + n // 2 + 8)), _scratch.work(n, number), 0
    while row < len(chains):
        row, columns, _ = library().call(
            "solve_rows",
            *(length, mass, stiffness, force, ends, below, width, weights, row),
            *(neighbour, current, slope, quotient, own, table, work, *found),
        )
        if row < len(chains):
            neighbour[0], table = -1, np.empty((lanes.ROWS, columns + columns // 2))
    return found


def _whole(chains: Chains) -> tuple[Array, ...]:
    """Return the arrays of chains, with a row for each but for the length, where one may do."""
    shape = chains.axial_force.shape
    rest = (np.ascontiguousarray(np.broadcast_to(v, shape)) for v in chains.arrays[1:])
    return np.ascontiguousarray(chains.length), *rest


def _ends(chains: Chains) -> Integers:
    return _ENDS[chains.left, chains.right]


def _middle(chains: Chains) -> Chain:
    """Return the mean of all chains."""
    with np.errstate(all="ignore"):
        m, EI, N = (np.mean(values, axis=0) for values in chains.arrays[1:])
        columns = BENDING.named(m, EI, N)
        return Chain(BENDING, chains.length[0], columns, chains.left, chains.right)


def _weights(chain: Chain, below: int, roots: int, none: Array) -> Array:
    """Return integrals of Y''^2, Y'^2 and Y^2 over the segments of a chain, (3, roots, n).

    They tell how a root moves with the chain: what starts a search, and never what it finds.
    """
    with np.errstate(all="ignore"):
        if not np.all(np.isfinite(chain.mass + chain.stiffness + chain.axial_force)):
            return none
        found = SingleChain(chain).roots(below, roots, _GUESSED)
        if found.reason != CERTIFIED:
            return none
        states = mode_states(chain, found.omega2, np.ones(roots, np.int64)).transpose(2, 1, 0)
        squares = (states[:3, :, 1:] ** 2 + states[:3, :, :-1] ** 2) * (chain.length / 2)
        weights = squares[::-1] / (squares[0] @ chain.mass)[:, None]
        weights[0] /= chain.stiffness**2
    return np.ascontiguousarray(weights) if np.all(np.isfinite(weights)) else none


def certify_guesses(chains: Chains, guess: Array, below: int, width: float) -> ChainRoots:
    """Certify guesses for chains of one structure under many axial forces.

    Parameters
    ----------
    chains : Chains
        All with the structure of the first.
    guess : array, shape (chains, roots)
        [rad^2/s^2].
    below, width
        As for `solve_chains`.

    Returns
    -------
    ChainRoots
        With two evaluations a root where the guess held.
    """
    n, number = chains.axial_force.shape[1], guess.shape[1]
    found, own = ChainRoots.empty(len(chains), number), np.zeros((4, n))
    own[0], own[1], own[2] = chains.length[0], chains.mass[0], chains.stiffness[0]
    library().call(
        "certify_rows",
        *(own, np.ascontiguousarray(chains.axial_force), _ends(chains), below, width),
        *(np.ascontiguousarray(guess), *found, np.empty((lanes.ROWS, n + 64))),
        *(_scratch.work(n, number), np.zeros(n), np.zeros(number)),
    )
    return found


class Roots(NamedTuple):
    """Consecutive eigenvalues of one chain, each with its certificate [rad^2/s^2]."""

    reason: int
    omega2: Array
    low: Array
    high: Array
    counts: Integers
    rounding: Array
    evaluations: int


def solve_beam(
    beam: Tables, below: int, number: int, refinement: int, tolerance: float, width: float
) -> BeamRoots:
    """Bracket and certify eigenvalues below + 1 ... below + number of a beam.

    Steps are halved until two extrapolated results agree; the brackets are those of the last chain.

    Parameters
    ----------
    refinement : int
        Number by which the coarsest steps are divided in the first chain.
    tolerance : float
        Relative error of the frequencies.
    width : float
        Relative width of the brackets in omega^2.
    """
    x, m, EI, N = (np.array(table, dtype=float, order="C") for table in beam[:4])
    at, points, scaled = _NO_POINTS
    if beam.points:
        at = np.array([point.node for point in beam.points], dtype=np.int64)
        points = _point_rows(beam.points, 1.0, 1.0, 1.0)
        scaled = np.empty_like(points)
    omega2, error, bracket = np.empty(number), np.empty(number), np.empty((number, 2))
    counts, evaluations = np.empty((number, 2), np.int64), np.empty(1, np.int64)
    columns, segments = 0, 64
    while True:
        reason, size, _ = library().call(
            "solve_levels",
            *(x, m, EI, N, beam.acceleration, beam.mass_left, beam.logarithmic, beam.limits),
            *(_ENDS[beam.left, beam.right], below, refinement, tolerance, width, at, points),
            *(omega2, error, bracket, counts, evaluations),
            *_scratch.levels(len(m), segments, number),
            *(scaled, _scratch.table(columns), _scratch.work(1, number)),
        )
        if reason == TABLE_TOO_SMALL:
            columns = size
        elif reason == CHAIN_TOO_SMALL:
            segments = size
        else:
            return BeamRoots(reason, omega2, error, bracket, counts, int(evaluations[0]), size)


class SingleChain:
    """One chain made dimensionless, ready for evaluations and root searches.

    Parameters
    ----------
    chain : Chain
        Without supports that need frames.
    """

    def __init__(self, chain: Chain) -> None:
        bar = chain.law is not BENDING
        own = np.empty((4, len(chain.length)))
        own[0], own[1], own[2] = chain.length, chain.mass, chain.stiffness
        own[3] = 0.0 if bar else chain.axial_force
        L, m0, stiffness = library().call("make_dimensionless", own, results="ddd")
        self.own, self.unit = own, stiffness / (m0 * L ** (2 if bar else 4))
        names = lanes.BAR_ENDS if bar else ENDS
        self.ends = np.array([names[chain.left], names[chain.right]])
        self.points: tuple[Integers, Array] | None = None
        if chain.points:
            marks = np.full(len(chain.length) + 1, -1)
            marks[[point.node for point in chain.points]] = np.arange(len(chain.points))
            rows = _bar_point_rows if bar else _point_rows
            self.points = marks, rows(chain.points, L, stiffness, m0)

    def _work(self, roots: int) -> tuple[Any, ...]:
        work = _scratch.work(self.own.shape[1], roots)
        return work if self.points is None else (*work[:4], *self.points, *work[6:])

    def __call__(self, omega2: Array) -> Evaluation:
        """Evaluate the chain at every omega^2 [rad^2/s^2]."""
        scaled, work, columns = omega2 / self.unit, self._work(1), self.own.shape[1]
        largest = float(np.max(np.abs(scaled)))
        while True:
            table = _scratch.table(columns)
            pieces = library().call(
                "prepare", *self.own, self.ends, largest, work[3], work[4], table
            )[0]
            if pieces <= table.shape[1]:
                break
            columns = pieces
        if pieces < 0:
            worst = float(np.max(np.abs(omega2)))
            raise FloatingPointError(f"omega^2 = {worst:g} is out of reach for this chain")
        count, value = np.empty(len(scaled), np.int64), np.empty(len(scaled))
        library().call(
            "evaluate_lanes", table, *work[3:6], self.ends, scaled, *work[6:9], count, value
        )
        return Evaluation(count, value)

    def roots(self, below: int, number: int, width: float) -> Roots:
        """Bracket and certify eigenvalues below + 1 ... below + number.

        Parameters
        ----------
        width : float
            Relative width of the brackets in omega^2.
        """
        work = self._work(number)
        values, counts = np.zeros((5, number)), np.zeros((number, 2), np.int64)
        root, slope, low, high, rounding = values
        columns = self.own.shape[1] + 8
        while True:
            reason, total, _ = library().call(
                "find_roots",
                *(*self.own, self.ends, below, False, root, slope, width, True, low, high),
                *(counts, rounding, _scratch.table(columns), work, 0.0),
            )
            if reason != TABLE_TOO_SMALL:
                break
            columns = total
        values *= self.unit
        return Roots(reason, root, low, high, counts, rounding, total)


class _Scratch(threading.local):
    """Arrays that root searches of one thread write into, kept from one to the next."""

    def __init__(self) -> None:
        self.kept: dict[tuple[int, int], tuple[Any, ...]] = {}
        self.columns = np.empty((lanes.ROWS, 0))
        self.intervals: tuple[Any, ...] = _intervals(0)
        self.chain: tuple[Any, ...] = _chain(0)
        self.by_level: dict[int, tuple[Any, ...]] = {}

    def work(self, n: int, roots: int) -> tuple[Any, ...]:
        """Return what `lanes.find_roots` writes into."""
        if (n, roots) not in self.kept:
            if len(self.kept) == _KEPT:
                self.kept.clear()
            self.kept[n, roots] = _workspace(n, roots)
        return self.kept[n, roots]

    def table(self, columns: int) -> Array:
        """Return a table of pieces with at least so many columns."""
        if self.columns.shape[1] < columns:
            self.columns = np.empty((lanes.ROWS, columns + columns // 2))
        return self.columns

    def levels(self, intervals: int, segments: int, roots: int) -> tuple[Any, ...]:
        """Return what `lanes.solve_levels` writes into, but for the last three."""
        if len(self.intervals[0]) < intervals:
            self.intervals = _intervals(intervals)
        if self.chain[0].shape[1] < segments:
            self.chain = _chain(2 * segments)
        if roots not in self.by_level:
            levels = np.empty((lanes.MOST_LEVELS, roots))
            self.by_level[roots] = levels, tuple(np.empty(roots) for _ in range(7))
        return *self.intervals, *self.chain, *self.by_level[roots]


def _intervals(n: int) -> tuple[Array | Integers, ...]:
    """Return which intervals vary, their first segments, and the interval and place of steps."""
    most = _MOST_STEPS + n
    integers = np.empty(n, np.int64), np.empty(n + 1, np.int64), np.empty(most, np.int64)
    return *integers, np.empty((4, most))


def _chain(n: int) -> tuple[Array | Integers, ...]:
    """Return h, m, EI and N of segments, their first pieces and the marks of points."""
    return np.empty((4, n)), np.empty(n + 1, np.int64), np.empty(n + 1, np.int64)


_scratch = _Scratch()


def find_eigenvalues(
    chain: Chain,
    wanted: int,
    *,
    zeros: int = 0,
    width: float = 1e-10,
    expected: Array | None = None,
) -> list[Eigenvalue]:
    """Return the lowest eigenvalues of a chain as `riccati.roots.find_eigenvalues` does.

    Where determinants do not do - some supports, modes that nearly coincide - that function does.
    """
    found = None if _needs_frames(chain) else _by_determinants(chain, wanted, zeros, width)
    if found is not None and check_certificate(found):
        return found
    return find_readable(chain, wanted, zeros=zeros, width=width, expected=expected)


def _by_determinants(
    chain: Chain, wanted: int, zeros: int, width: float
) -> list[Eigenvalue] | None:
    """Return the lowest eigenvalues of a chain by the compiled search; None where it fails."""
    ready = SingleChain(chain)
    floor = _floor(ready, omega2_scale(chain), zeros)
    if floor is None:
        return None
    distance, negative = floor
    found: list[Eigenvalue] = []
    parts = [(0, negative), (negative + zeros, max(wanted - negative - zeros, 0))]
    for below, number in parts:
        if below and zeros:
            counts = (negative, below)
            found += [Eigenvalue(k + 1, 0.0, (-distance, distance), counts) for k in range(*counts)]
        if number:
            roots = ready.roots(below, number, width)
            near = np.diff(roots.omega2) <= lanes.PARTED * np.abs(roots.omega2[1:])
            if roots.reason != CERTIFIED or np.any(near):
                return None
            found += _listed(roots, below)
    return found


def _floor(ready: SingleChain, scale: float, zeros: int) -> tuple[float, int] | None:
    """Return the least distance from zero at which the counts make sense, and the lower count."""
    floors = scale * 10.0 ** np.arange(-16, -12)
    count = ready(np.concatenate([-floors, floors])).below
    if not zeros:
        return (0.0, int(count[4])) if count[0] == count[4] else None
    for floor, low, high in zip(floors, count[:4], count[4:], strict=True):
        if high - low >= zeros:
            return (float(floor), int(low)) if high - low == zeros else None
    return None


def _listed(roots: Roots, below: int) -> list[Eigenvalue]:
    columns = (values.tolist() for values in roots[1:5])
    return [
        Eigenvalue(below + k + 1, omega2, (low, high), (counts[0], counts[1]))
        for k, (omega2, low, high, counts) in enumerate(zip(*columns, strict=True))
    ]


def mode_states(chain: Chain, omega2: Array, multiplicity: Integers) -> Array:
    """Return the states of the modes at every node: `riccati.shapes.mode_states`, compiled.

    Supports between the ends, clusters and longitudinal modes are left to the readable form.
    """
    fine = None if _is_special(chain, multiplicity) else shapes.split_for(chain, omega2)
    if fine is None or len(fine.length) > _MOST_NODES:
        return shapes.mode_states(chain, omega2, multiplicity)
    keep = shapes.kept_nodes(chain, fine)
    parts = [_states(fine, omega2[i : i + LANES]) for i in range(0, len(omega2), LANES)]
    return np.concatenate([part[keep] for part in parts], axis=1)


def _is_special(chain: Chain, multiplicity: Integers) -> bool:
    held = any(point.holds for point in chain.points)
    return chain.law is not BENDING or held or bool(np.any(multiplicity > 1))


class _LaneChain:
    """A chain in the units of up to eight modes; arrays are copied into the layout compiled for."""

    def __init__(self, chain: Chain, omega2: Array) -> None:
        n, number = len(chain.length), len(omega2)
        lane = np.minimum(np.arange(LANES), number - 1)
        self.scale = chain.scale_length(omega2)[lane]
        arrays = chain.length, chain.mass, chain.stiffness, chain.axial_force
        self.length, mass, stiffness, force = (np.array(values, order="C") for values in arrays)
        self.units = state_units(chain, omega2)[lane]
        self.EI, self.N, self.inertia = np.empty(n), np.empty((n, LANES)), np.empty((n, LANES))
        library().call(
            "scaled_chain",
            *(mass, stiffness, force, omega2[lane], self.scale),
            *(chain.reference[0], self.EI, self.N, self.inertia),
        )
        self.scratch = np.zeros((lane_shapes.SCRATCH, LANES))

    def transfers(self) -> Array:
        U = np.empty((len(self.length), 10, LANES))
        library().call(
            "transfers", self.length, self.EI, self.N, self.inertia, self.scale, self.scratch, U
        )
        return U


def _states(fine: Chain, omega2: Array) -> Array:
    own = _LaneChain(fine, omega2)
    n, number = len(fine.length), len(omega2)
    frames, backs = np.empty((2, n + 1, 8, LANES)), np.empty((2, n + 1, 3, LANES))
    free = [i for end in (fine.left, fine.right) for i in range(4) if i not in fine.law.zeros(end)]
    library().call(
        "sweeps",
        *(own.transfers(), *_lane_points(fine, omega2, own.units)),
        *(np.array(free).reshape(2, 2), own.scratch, *frames, *backs),
    )
    node, state = np.zeros(LANES, np.int64), np.empty((4, LANES))
    library().call("meet", *frames, own.scratch, node, state)
    z = np.empty((n + 1, number, 4))
    library().call("carry", *frames, *backs, node, state, own.units, z)
    return z


def _lane_points(chain: Chain, omega2: Array, units: Array) -> tuple[Integers, Array]:
    """Return which point sits at every node (-1: none), and what `lane_shapes.sweeps` needs."""
    marks, table = np.full(len(chain.length) + 1, -1), np.zeros((len(chain.points), 5, LANES))
    lane = np.minimum(np.arange(LANES), len(omega2) - 1)
    for k, point in enumerate(chain.points):
        marks[point.node] = k
        for kind, T, _ in point_steps(chain.law, point, omega2[lane], units):
            if kind == "load":
                table[k, :4] = T[:, 3, 0], T[:, 3, 1], T[:, 2, 0], T[:, 2, 1]
                table[k, 3] = T[:, 2, 1]
            else:
                table[k, 4] = T[:, 1, 2]
    return marks, table


def mode_energies(chain: Chain, states: Array, omega2: Array) -> shapes.Energies:
    """Return modal mass and stiffness of modes: `riccati.shapes.mode_energies`, compiled."""
    phase = float(np.max(largest_wave_number(chain, float(np.max(np.abs(omega2)))) * chain.length))
    if chain.law is not BENDING or phase > LONGEST_STEP:
        return shapes.mode_energies(chain, states, omega2)
    share, weight = shapes.gauss_rule(phase)
    parts = []
    for i in range(0, len(omega2), LANES):
        own = _LaneChain(chain, omega2[i : i + LANES])
        these = np.array(states[:, i : i + LANES], order="C")
        total = np.zeros((4, *these[:-1, :, 0].shape))
        library().call(
            "squares",
            *(own.length, own.EI, own.N, own.inertia, own.scale, own.units),
            *(these, share, weight, own.scratch, total),
        )
        parts.append(total)
    return shapes.energies(chain, states, Squares(*np.concatenate(parts, axis=2)))
