"""Bending frequencies of the cases of a chunk, refined until their estimated error is small enough.

The error by what varies inside segments is judged on every 32nd case, or on 64 of more than 2,048,
by the one rule on levels of halved steps; all chains are refined until it is within the tolerance.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from antinode.arrays import Array, Integers
from antinode.beam.ends import FREE
from antinode.beam.families import BENDING, FAMILIES
from antinode.modes.backends import choose
from antinode.modes.batch import NARROW, BeamBatch, predict_many, solve_many
from antinode.modes.following import eigenvalues_alone
from antinode.modes.hertz import growth_rate, settled
from antinode.modes.rigid import rigid_modes_of, zeros_of
from antinode.modes.rotation import elastic
from antinode.riccati.chain import Chain
from antinode.riccati.convergence import extrapolate
from antinode.riccati.roots import CountingError
from antinode.study.design.file import Study
from antinode.vehicle.derivatives import ChainModes
from antinode.vehicle.many_beams import Chains, sheared_columns

from .beams import CaseBeams
from .reasons import PAST_BUCKLING, failed

IN_BATCHES = (BENDING,)
"""Families whose cases are solved together."""
_SAMPLE, _ENOUGH = 32, 64  # one case in so many, but for more of them no more than these
_WIDEST = 1e-8  # of brackets, relative to omega^2
_FOR_EFFECT = 1e-7  # of those that a frequency is only compared with
_ALIKE = 0.05  # largest distance of effects from those of most cases, up to which no root is missed
_OF_TOLERANCE = 1e-2  # a bracket's part in what is allowed
_SAFETY = 2.5  # for cases that are not in the sample
_NEAR_BUCKLING = 1e-7  # share of the highest omega^2 below which the first may be a rigid one
_FINEST = 32
_LEAST = 3  # levels that tell an error


@dataclass(frozen=True)
class Eigenvalues:
    """Eigenvalues of one family of some cases; NaN where there are none.

    Attributes
    ----------
    omega2, error : array, shape (cases, modes)
        With a bound on the error [rad^2/s^2].
    reason : array of int, shape (cases,)
        0, past buckling, or why there are none.
    shapes : array, shape (cases, modes, points)
        At even points, of unit norm; without points where they are not wanted.
    net_force : array, shape (cases,)
        Integral of N along the axis less what following ends turn back [N m]: it turns the body
        on where it is positive. 0 in families that it does not act on.
    lowest_diverges : array of bool, shape (cases,)
        Whether the mode that is counted as rigid rotation diverges in net tension.
    effect_of_shear : array, shape (cases, modes)
        What shear and rotary inertia do to each frequency, solved, relative; NaN where they are not
        solved, or where a mode of either theory has no frequency.
    growth_rate_per_s : array, shape (cases, modes)
        Re s of modes that diverge or flutter [1/s]; NaN of all others.
    """

    omega2: Array
    error: Array
    reason: Integers
    shapes: Array
    net_force: Array
    lowest_diverges: npt.NDArray[np.bool_]
    effect_of_shear: Array
    growth_rate_per_s: Array


def nothing_solved(study: Study, reason: Integers, points: int) -> Eigenvalues:
    """Return eigenvalues that are all unknown yet."""
    shape = len(reason), study.solve.modes
    omega2, error, effect, growth = np.full((4, *shape), np.nan)
    shapes = np.full((*shape, points), np.nan)
    none = np.zeros(len(reason))
    return Eigenvalues(
        omega2, error, reason.copy(), shapes, none, none.astype(bool), effect, growth
    )


def solve_bending(study: Study, beams: CaseBeams, points: int) -> Eigenvalues:
    """Return the bending eigenvalues of some cases, with shapes at so many points."""
    out = nothing_solved(study, beams.reason, points)
    rows = np.flatnonzero(beams.reason == 0)
    if not len(rows):
        return out
    weight = _weight(study, beams, rows)
    refinement, share = 1, np.zeros(study.solve.modes)
    if not beams.exact:
        refinement, share = _refine(study, beams, rows, weight)
    x = np.linspace(0, study.vehicle_case.vehicle.length, points)
    for chains in beams.chains(rows, refinement):
        at = chains.rows
        found = solve_free(chains, study.solve.modes, _width(study))
        omega2, error, out.reason[at], growth = found
        out.net_force[at] = net_force(chains)
        out.lowest_diverges[at] = lowest_diverges(chains, omega2, out.net_force[at])
        error = error + np.abs(omega2) * share * weight[at, None]
        out.omega2[at], out.error[at] = settled(omega2, error)
        out.growth_rate_per_s[at] = np.where(out.omega2[at] == 0, np.nan, growth)
        out.reason[at[(out.reason[at] == PAST_BUCKLING) & (out.omega2[at, 0] >= 0)]] = 0
        if chains.more and "effect_of_shear" in study.outputs:
            out.effect_of_shear[at] = _solved_effect(chains.rigid, omega2)
        if points:
            real = np.where(omega2 > 0, omega2 - np.nan_to_num(growth) ** 2, omega2)
            out.shapes[at] = _shapes(chains, real, out.reason[at], x)
    return out


def _width(study: Study) -> float:
    """Return how wide brackets may be, relative to omega^2: a small part of the tolerance."""
    return min(max(_OF_TOLERANCE * study.solve.tolerance, NARROW), _WIDEST)


def effect_of_shear(omega2: Array, rigid: Array) -> Array:
    """Return the relative change of frequencies from those of Euler-Bernoulli, NaN without them."""
    with np.errstate(all="ignore"):
        effect = np.sqrt(omega2 / rigid) - 1
    return np.where((omega2 > 0) & (rigid > 0), effect, np.nan)


def _weight(study: Study, beams: CaseBeams, rows: Integers) -> Array:
    """Return what the error of a chain goes with: the slope of N, where only N varies."""
    size = np.abs(beams.scalars["a_X"])
    largest = np.max(size[rows])
    vehicle = study.vehicle_case.vehicle
    stepped = vehicle.interpolation == "step" and not vehicle.masses
    weight = np.maximum(size, 0.05 * largest) if stepped and largest > 0 else np.ones(len(size))
    return np.nan_to_num(weight, nan=1.0)


def _refine(study: Study, beams: CaseBeams, rows: Integers, weight: Array) -> tuple[int, Array]:
    """Return the refinement, and the estimated relative error of every omega^2, by weight.

    Levels of the sample are judged by the one rule; the coarsest whose own values are near enough
    is taken. The cases that are not in the sample have a margin.
    """
    step = max(1, min(_SAMPLE, len(rows) // 8), len(rows) // _ENOUGH)
    sample, modes = rows[::step], study.solve.modes
    levels: list[Array] = []
    while True:
        groups = beams.chains(sample, 2 ** len(levels))
        levels.append(_omega2(groups, modes, _width(study)))
        if len(levels) < _LEAST:
            continue
        better, error = _judged(levels, max(map(_layer, groups)), _width(study))
        for level, omega2 in enumerate(levels):
            size = np.maximum(np.abs(better), 1e-3 * np.abs(better[:, -1:]))
            off = (np.abs(better - omega2) + error) / size / weight[sample, None]
            share = np.max(np.nan_to_num(off), axis=0) * _SAFETY
            share = np.maximum(share, share.max() / 4)
            if share.max() * weight[rows].max() / 2 <= study.solve.tolerance:
                return 2**level, share
        if 2 ** len(levels) > _FINEST:
            return 2 ** (len(levels) - 1), share


def _judged(levels: list[Array], layer: float, width: float) -> tuple[Array, Array]:
    """Return extrapolated omega^2 of every case and their errors, shape (cases, modes)."""
    better, error = np.zeros((2, *levels[-1].shape))
    with np.errstate(all="ignore"):
        for case, rows in enumerate(np.stack(levels[-4:], axis=1)):
            extrapolate(rows, len(rows) - 1, width, layer, better[case], error[case])
    return better, error


def _layer(chains: Chains) -> float:
    """Return the largest abs(N) h^2/EI of segments: layers of the axial force, in segments."""
    return float(np.max(np.abs(chains.axial_force) * chains.length**2 / chains.stiffness))


def _omega2(groups: list[Chains], modes: int, width: float) -> Array:
    """Return omega^2 of all chains, in the order of their cases."""
    rows = np.concatenate([g.rows for g in groups])
    omega2 = np.concatenate([solve_free(g, modes, width)[0] for g in groups])
    return np.asarray(omega2[np.argsort(rows)])


def solve_free(
    chains: Chains, modes: int, width: float = NARROW
) -> tuple[Array, Array, Integers, Array]:
    """Return omega^2, its error, the reason and growth for every chain; by frames where lanes fail.

    Of a pair that flutters omega^2 is the square of its frequency.
    """
    result = solve_many(_batch(chains, modes), width=width)
    omega2, error, reason = result.omega2, result.error_omega2, result.reason
    growth = result.growth_rate_per_s
    buckled = ~(omega2[:, 0] > _NEAR_BUCKLING * omega2[:, -1])
    for i in np.flatnonzero(failed(reason) | buckled).tolist():
        found = _by_frames(chain_of(chains, i), modes)
        if found is not None:
            omega2[i], error[i] = found
            reason[i] = PAST_BUCKLING if omega2[i, 0] < 0 else 0
            growth[i] = growth_rate(omega2[i])
    return omega2, error, reason, growth


def _batch(chains: Chains, modes: int) -> BeamBatch:
    tables = chains.length, chains.mass, chains.stiffness, chains.axial_force
    more: dict[str, Any] = sheared_columns(chains.more)
    return BeamBatch(*tables, modes=modes, following=chains.following, **more)


def _solved_effect(rigid: Chains, omega2: Array) -> Array:
    """Return what shear does to frequencies, from chains without it.

    Their frequencies are predicted. Where one is not, or the effect is not that of most cases, as
    where a root was missed, they are solved with certificates.
    """
    modes = omega2.shape[1]
    effect = effect_of_shear(omega2, predict_many(_batch(rigid, modes), _FOR_EFFECT))
    known = effect[np.isfinite(effect).all(axis=1)]
    most = np.median(known, axis=0) if len(known) else np.zeros(modes)
    with np.errstate(invalid="ignore"):
        far = np.abs(effect - most)
    doubtful = np.flatnonzero(~np.all(far < _ALIKE, axis=1))
    if len(doubtful):
        again, *_ = solve_free(rigid.some(doubtful), modes, _FOR_EFFECT)
        effect[doubtful] = effect_of_shear(omega2[doubtful], again)
    return effect


def net_force(chains: Chains) -> Array:
    """Return the integral of N along the axis less what forces that follow turn back [N m]."""
    net = np.sum(chains.length * chains.axial_force, axis=1)
    if chains.following is None:
        return np.asarray(net)
    right = np.cumsum(chains.length, axis=1)
    m = np.broadcast_to(chains.mass * chains.length, chains.axial_force.shape)
    centre = np.sum(m * (right - chains.length / 2), axis=1) / np.sum(m, axis=1)
    nose, tail = chains.following.T
    return np.asarray(net - nose * centre - tail * (right[:, -1] - centre))


def lowest_diverges(chains: Chains, omega2: Array, net_force: Array) -> npt.NDArray[np.bool_]:
    """Tell where a body in net tension has a part that is compressed past its buckling.

    The lowest eigenvalue, below the translation, is then no elastic mode's by its index.
    """
    told = np.zeros(len(omega2), dtype=bool)
    if chains.following is not None:  # counts do not hold; the sign of the turning force does
        return told
    compressed = np.any(chains.axial_force > 0, axis=1)
    for i in np.flatnonzero((net_force < 0) & compressed & np.isfinite(omega2[:, -1])).tolist():
        below_zero = -_NEAR_BUCKLING * abs(float(omega2[i, -1]))
        told[i] = choose("numba").evaluate(chain_of(chains, i), [below_zero]).below[0] > 0
    return told


def chain_of(chains: Chains, i: int) -> Chain:
    """Return one of some chains."""
    tables = (chains.length, chains.mass, chains.stiffness, chains.axial_force)
    length, *columns = (table[i if len(table) > 1 else 0] for table in tables)
    law = FAMILIES[BENDING].law
    more = {name: table[i] for name, table in chains.more.items()}
    ends = (0.0, 0.0) if chains.following is None else tuple(chains.following[i].tolist())
    return Chain(law, length, law.named(*columns) | more, following=ends)


def _by_frames(chain: Chain, modes: int) -> tuple[Array, Array] | None:
    """Return omega^2 of the elastic modes of a free chain, and its error."""
    zeros = zeros_of(FREE, chain)
    rigid = rigid_modes_of(FREE, chain.family)
    try:
        found = eigenvalues_alone(choose("numba"), chain, modes + rigid, zeros, NARROW, rigid)
    except (CountingError, FloatingPointError, ValueError):
        return None
    rest = elastic(found, rigid, chain)[:modes]
    if len(rest) < modes or any(e.imaginary for e in rest):
        return None
    omega2 = np.array([e.omega2 for e in rest])
    return omega2, np.array([e.bracket[1] - e.bracket[0] for e in rest])


def _shapes(chains: Chains, omega2: Array, reason: Integers, x: Array) -> Array:
    """Return the shapes at places, of unit norm; NaN where there are none."""
    found = np.full((*omega2.shape, len(x)), np.nan)
    for i in np.flatnonzero(~failed(reason)).tolist():
        found[i] = unit_shapes(ChainModes(chain_of(chains, i), omega2[i]).displacement(x))
    return found


def unit_shapes(displacement: Array) -> Array:
    """Return shapes (points, modes) as rows of unit norm, the largest displacement positive."""
    y = displacement.T
    largest = np.take_along_axis(y, np.argmax(np.abs(y), axis=1)[:, None], axis=1)
    return np.asarray(y * np.sign(largest) / np.linalg.norm(y, axis=1)[:, None])
