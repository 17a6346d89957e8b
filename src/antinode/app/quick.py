"""Bending frequencies and shapes fast enough for a moving slider: some milliseconds.

Frequencies are the compiled ones, to 1e-4; shapes are those of one chain at these frequencies.
Where shear, foundation or curved columns take part two chains are extrapolated, one twice as fine
as the other. Modes that coincide, flutter or are damped go through `solve_modes` instead. Cases of
a vehicle along one input are solved side by side, as those of a study.
"""

from __future__ import annotations

import threading
from typing import Any, NamedTuple

import numpy as np

from antinode.arrays import Array, Integers
from antinode.beam.attachments import is_damped
from antinode.beam.beam import Beam
from antinode.beam.families import BENDING, FAMILIES
from antinode.modes.backends import choose
from antinode.modes.following import certifying
from antinode.modes.frequencies import natural_frequencies
from antinode.modes.rigid import exact_zeros, rigid_modes
from antinode.modes.rotation import elastic
from antinode.modes.solve import solve_modes
from antinode.modes.solvers import solver_of
from antinode.riccati.arrays import Complex
from antinode.riccati.chain import Chain
from antinode.study.cases.allowed import outside_range
from antinode.study.cases.beams import CaseBeams, beams_on_arrays
from antinode.study.cases.bending import solve_free
from antinode.study.cases.reasons import PAST_BUCKLING
from antinode.vehicle.case import Case
from antinode.vehicle.numbers import Keys, is_vectorised
from antinode.vehicle.refusals import OUT_OF_RANGE

QUICK_FAMILY = BENDING
"""The only family that is solved at once; the others come with the full solve."""
TOLERANCE = 1e-4
_WIDTH = 1e-6  # relative, of brackets of many cases
_POINTS = 121
_REFINEMENT = 2  # of the chain whose shapes are shown
_MODES_PER_REFINEMENT = 8
_RIGID = 2  # modes of a body that nothing holds
_PARTED = 1e-6  # relative distance of omega^2 below which shapes need `solve_modes`


class Quick(NamedTuple):
    """Bending modes 1, 2, ... of a beam.

    Attributes
    ----------
    omega2 : array, shape (modes,)
        [rad^2/s^2].
    error : array, shape (modes,)
        Of omega2, estimated.
    x : array, shape (points,)
        [m].
    states : array, shape (points, modes, 4)
        Y, theta, M, Q_y; the largest Y is 1.
    phasors : array of complex, shape (points, modes, 4), or None
        Of complex modes: amplitude and phase; their places do not pass through zero together.
    """

    omega2: Array
    error: Array
    x: Array
    states: Array
    phasors: Complex | None = None


def warm_up() -> None:
    """Load the compiled code in the background, before the first page asks for it."""
    threading.Thread(target=choose, name="antinode-kernel", daemon=True).start()


def quick_omega2(beam: Beam, modes: int) -> Array:
    """Return omega^2 of the first bending modes, for a curve."""
    return _found(beam, modes)[0]


def fits_side_by_side(case: Case, keys: Keys) -> bool:
    """Tell whether cases of a vehicle that differ in one number can be solved side by side."""
    return is_vectorised(keys) and not case.model.water_answers


def quick_cases(case: Case, keys: Keys, values: Array, modes: int) -> tuple[Array, Integers]:
    """Return omega^2 of the first bending modes of cases that differ in one number.

    Parameters
    ----------
    case : Case
    keys : tuple
        Of the number; `fits_side_by_side` holds for it.
    values : array, shape (cases,)
        [SI].
    modes : int

    Returns
    -------
    omega2 : array, shape (cases, modes)
        [rad^2/s^2]; NaN where the case is refused.
    alone : array of int
        Cases to be solved by themselves: what flutters, or is too far from its extrapolation.
    """
    outside = np.where(outside_range(case, keys, values), OUT_OF_RANGE, 0)
    beams = beams_on_arrays(case, {keys: values}, outside)
    refinement = _refinement(modes + _RIGID)
    levels = [_level(beams, modes, refinement * finer) for finer in (1, 2)]
    known = np.all([np.isin(reason, (0, PAST_BUCKLING)) for _, reason in levels], axis=0)
    with np.errstate(invalid="ignore"):
        omega2, _, near = _between(*(values for values, _ in levels))
    solvable = beams.reason == 0
    return omega2, np.flatnonzero(solvable & ~(known & near))


def _level(beams: CaseBeams, modes: int, refinement: int) -> tuple[Array, Integers]:
    """Return omega^2 of all chains of a refinement, NaN without one, and why there is none."""
    omega2, reason = np.full((len(beams.reason), modes), np.nan), beams.reason.copy()
    for chains in beams.chains(np.flatnonzero(reason == 0), refinement):
        omega2[chains.rows], _, reason[chains.rows], _ = solve_free(chains, modes, _WIDTH)
    return omega2, reason


def _refinement(modes: int) -> int:
    """Return the refinement of the coarser of two chains for so many modes, rigid ones too."""
    return max(1, modes // _MODES_PER_REFINEMENT)


def _between(coarse: Array, fine: Array) -> tuple[Array, Array, Any]:
    """Extrapolate omega^2 of two chains, (..., modes): values, errors, whether all are near."""
    change = (fine - coarse) / 15
    near = np.all(np.abs(change) <= 2 * TOLERANCE * np.abs(fine), axis=-1)
    return fine + change, np.abs(change), near


def quick_modes(beam: Beam, modes: int) -> Quick:
    """Return the first bending modes of a beam.

    Raises
    ------
    ComputationError
        If they cannot be computed.
    """
    if is_damped(beam.attachments, QUICK_FAMILY):
        return _full_modes(beam, modes)
    omega2, error, chain = _found(beam, modes)
    if len(omega2) < modes or np.any(np.diff(omega2) <= _PARTED * np.abs(omega2[1:])):
        return _full_modes(beam, modes)
    chain = chain or beam.chain(QUICK_FAMILY, _REFINEMENT)
    chain = chain.cut_at(np.linspace(0.0, beam.length, _POINTS))
    with np.errstate(all="ignore"):
        states = choose().mode_states(chain, omega2, np.ones(modes, dtype=np.int64))
    return Quick(omega2, error, beam.x[0] + chain.nodes, _scaled(states))


def _found(beam: Beam, modes: int) -> tuple[Array, Array, Chain | None]:
    """Return omega^2, its error, and the chain that has it, if any."""
    if is_damped(beam.attachments, QUICK_FAMILY):
        full = _full_modes(beam, modes)
        return full.omega2, full.error, None
    if beam.is_curved or FAMILIES[QUICK_FAMILY].used(beam):
        found = _extrapolated(beam, modes)
        if found is not None:
            return found
    plain = natural_frequencies(beam, modes, tolerance=TOLERANCE)
    return plain.omega2, plain.error_omega2, None


def _extrapolated(beam: Beam, modes: int) -> tuple[Array, Array, Chain] | None:
    """Extrapolate two chains whose error falls as the fourth power; None where that is too far."""
    rigid = len(rigid_modes(beam, QUICK_FAMILY))
    zeros = exact_zeros(beam, QUICK_FAMILY)
    solver = certifying(solver_of("riccati", choose()), beam, QUICK_FAMILY)
    refinement = _refinement(modes + rigid)
    levels: list[Array] = []
    for finer in (refinement, 2 * refinement):
        chain = beam.chain(QUICK_FAMILY, finer)
        listed = elastic(solver.find(chain, modes + rigid, zeros=zeros).eigenvalues, rigid, chain)
        if len(listed) < modes or any(value.imaginary for value in listed[:modes]):
            return None
        levels.append(np.array([value.omega2 for value in listed[:modes]]))
    omega2, error, near = _between(*levels)
    return (omega2, error, chain) if near else None


def _full_modes(beam: Beam, modes: int) -> Quick:
    result = solve_modes(beam, modes, tolerance=TOLERANCE, families=[QUICK_FAMILY])
    found = [mode for mode in result.modes if mode.number][:modes]
    states = np.stack([mode.states for mode in found], axis=1)
    error = np.array([mode.error_omega2 for mode in found])
    omega2 = np.array([mode.omega2 for mode in found])
    known = [mode.phasors for mode in found if mode.phasors is not None]
    phasors = np.stack(known, axis=1) if known and len(known) == len(found) else None
    return Quick(omega2, error, result.x, states, phasors)


def _scaled(states: Array) -> Array:
    """Scale shapes to a largest Y of 1, their first extremum positive."""
    Y = states[..., 0]
    largest = np.max(np.abs(Y), axis=0)
    signs = [_first_extremum(column / size) for column, size in zip(Y.T, largest, strict=True)]
    return np.asarray(states / (np.array(signs) * largest)[:, None])


def _first_extremum(y: Array) -> float:
    size = np.abs(y)
    rises = np.concatenate([[True], size[1:] >= size[:-1]])
    falls = np.concatenate([size[:-1] >= size[1:], [True]])
    return float(np.sign(y[np.flatnonzero(rises & falls & (size > 1e-3))[0]]))
