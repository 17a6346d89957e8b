"""Many beams of one family in batches: chains that nothing is attached to, of equal size.

Steps are halved until the stated error of every frequency of a beam is within the tolerance, beam
by beam, by the one rule (`riccati.convergence`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from antinode.arrays import Array, Integers
from antinode.beam.beam import Beam
from antinode.beam.ends import Ends
from antinode.beam.families import FAMILIES, FamilyName
from antinode.modes.batch import BeamBatch, solve_many
from antinode.modes.refinement import NEAR_ZERO, Refinement, layer_length
from antinode.riccati.chain import Chain, omega2_scale
from antinode.vehicle.many_beams import sheared_columns

from .reasons import NOT_FOUND, PAST_BUCKLING

_FINEST = 64  # times the coarsest steps
Answer = tuple[Array, Array]
"""omega^2 of the elastic modes 1, 2, ... of a beam, and their errors, each (modes,)."""


def fits_a_batch(beam: Beam, family: FamilyName) -> bool:
    """Tell whether a beam fits a batch in a family: nothing attached to it, nothing turns."""
    left, right, points = beam.points(family)
    turns = beam.loads_turn and FAMILIES[family].law.has_axial_force
    return not turns and not points and (left, right) == beam.ends.of(family)


def solve_batches(
    beams: Mapping[int, Beam], family: FamilyName, modes: int, tolerance: float
) -> tuple[dict[int, Answer], list[int]]:
    """Solve beams side by side.

    Parameters
    ----------
    beams : mapping
        Those that fit a batch, by their cases.
    family : str
    modes : int
    tolerance : float
        Relative error of a frequency.

    Returns
    -------
    found : dict
        Answers by case.
    alone : list of int
        Cases that need to be solved by themselves: past buckling, flutter, modes close together.
    """
    found: dict[int, Answer] = {}
    alone: list[int] = []
    levels = {i: Refinement(tolerance) for i in beams}
    refinement = max(1, modes // 8)
    exact = {i for i, beam in beams.items() if not np.any(beam.varies(family))}
    while levels:
        chains = {i: beams[i].chain(family, refinement) for i in levels}
        for rows in _groups(chains, beams, family):
            solved = _solve([chains[i] for i in rows], beams[rows[0]], modes)
            for i, omega2, error, reason in zip(rows, *solved, strict=True):
                if reason or not omega2[0] > error[0]:
                    alone.append(i)
                    del levels[i]
                    continue
                answer = _judged(levels[i], chains[i], omega2, error, exact=i in exact)
                if answer is not None or refinement >= _FINEST:
                    found[i] = answer or (omega2, error + levels[i].error_of_last)
                    del levels[i]
        refinement *= 2
    return found, sorted(alone)


def _judged(
    level: Refinement, chain: Chain, omega2: Array, error: Array, *, exact: bool
) -> Answer | None:
    """Return the answer if its error is small enough, else None."""
    if exact:
        return omega2, error
    level.least = NEAR_ZERO * omega2_scale(chain)
    level.add(omega2, layer_length(chain))
    off = error + level.error_of_last
    return (omega2, off) if np.all(np.isfinite(off)) and level.met(off) else None


def _groups(
    chains: Mapping[int, Chain], beams: Mapping[int, Beam], family: FamilyName
) -> list[list[int]]:
    """Return the cases whose chains may stand side by side."""
    groups: dict[Any, list[int]] = {}
    for i, chain in chains.items():
        held = len(beams[i].freedoms(family))
        key = (len(chain.length), chain.left, chain.right, held, tuple(sorted(chain.columns)))
        groups.setdefault(key, []).append(i)
    return list(groups.values())


def _solve(chains: Sequence[Chain], beam: Beam, modes: int) -> tuple[Array, Array, Integers]:
    """Return omega^2, its error, and what speaks against it for each of some equal chains."""
    family = FAMILIES[chains[0].family]
    names = chains[0].columns
    stacked = {name: np.stack([chain.columns[name] for chain in chains]) for name in names}
    tables: dict[str, Any] = {table: stacked[name] for name, table in family.columns.items()}
    tables |= sheared_columns(stacked)
    if "foundation" in stacked:
        tables["foundation_stiffness"] = stacked["foundation"]
    ends: dict[str, Any] = dict(zip(family.ends, beam.ends.of(family.name), strict=True))
    following = np.array([chain.following for chain in chains])
    batch = BeamBatch(
        np.stack([chain.length for chain in chains]),
        ends=Ends(**ends),
        modes=modes,
        family=family.name,
        following=following if following.any() else None,
        **tables,
    )
    result = solve_many(batch)
    reason = np.where(np.isfinite(result.omega2).all(axis=1), result.reason, NOT_FOUND)
    return result.omega2, result.error_omega2, np.where(reason == PAST_BUCKLING, NOT_FOUND, reason)
