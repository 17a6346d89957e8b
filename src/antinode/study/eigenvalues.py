"""The eigenvalues of a case on chains of fixed refinement: a smooth function of its numbers.

`solve_modes` refines until its estimate meets a tolerance. That makes tiny jumps as the input
changes, which derivatives and least squares do not like; here the refinement is chosen once.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from antinode.arrays import Array
from antinode.beam.beam import Beam
from antinode.beam.ends import FREE
from antinode.beam.families import BENDING, FAMILIES, FamilyName
from antinode.errors import ComputationError
from antinode.modes.batch import BeamBatch, solve_many
from antinode.modes.hertz import signed_hertz
from antinode.modes.rigid import elastic, zeros_of
from antinode.riccati.chain import Chain
from antinode.riccati.roots import CountingError, find_eigenvalues
from antinode.vehicle.case import Case
from antinode.vehicle.derivatives import ChainModes, EigenvalueDerivatives
from antinode.vehicle.loads import Loads

Wanted = Mapping[FamilyName, int]
_FINEST = 16


@dataclass(frozen=True)
class CaseEigenvalues:
    """Eigenvalues 1, 2, ... of the families that were asked for.

    Attributes
    ----------
    case : Case
    loads : Loads
    beam : Beam
    modes : dict
        `ChainModes` 1 ... n by family, rigid ones left out.
    """

    case: Case
    loads: Loads
    beam: Beam
    modes: Mapping[FamilyName, ChainModes] = field(repr=False)

    def sensitivity(self, family: FamilyName) -> EigenvalueDerivatives:
        """Return the derivatives of the eigenvalues of a family."""
        return EigenvalueDerivatives(self.modes[family], self.beam, self.loads)

    def frequencies_hz(self, family: FamilyName) -> Array:
        """Return the frequencies of modes 1, 2, ... [Hz]; negative for a divergent mode."""
        return signed_hertz(self.modes[family].omega2)


def eigenvalues_of(
    cases: Sequence[Case], wanted: Sequence[Wanted], refinement: int = 2
) -> tuple[CaseEigenvalues, ...]:
    """Compute the eigenvalues 1 ... n of each family that is wanted, of several cases at once.

    Raises
    ------
    InputError
        If a case cannot be, such as a fin inside the body.
    ComputationError
        If its loads or its eigenvalues cannot be computed.
    """
    beams = [case.beam() for case in cases]
    modes: list[dict[FamilyName, ChainModes]] = [{} for _ in cases]
    rows = [k for k, families in enumerate(wanted) if BENDING in families]
    chains = [beams[k].chain(BENDING, refinement) for k in rows]
    numbers = [wanted[k][BENDING] for k in rows]
    for k, chain, omega2 in zip(rows, chains, _bending(chains, numbers), strict=True):
        modes[k][BENDING] = ChainModes(chain, omega2)
    for k, families in enumerate(wanted):
        for family, number in families.items():
            if not FAMILIES[family].law.has_axial_force:
                chain = beams[k].chain(family, refinement)
                modes[k][family] = ChainModes(chain, _solve(chain, number, 1, 1))
    return tuple(map(CaseEigenvalues, cases, [case.loads for case in cases], beams, modes))


def _bending(chains: Sequence[Chain], numbers: Sequence[int]) -> list[Array]:
    """Return the eigenvalues 1 ... n of free-free chains; those of equal size side by side."""
    found: list[Array] = [np.zeros(0)] * len(chains)
    sizes = [len(chain.length) for chain in chains]
    for size in set(sizes):
        rows = [k for k, n in enumerate(sizes) if n == size]
        batch = BeamBatch(
            length=np.stack([chains[k].length for k in rows]),
            mass_per_length=np.stack([chains[k].mass for k in rows]),
            bending_stiffness=np.stack([chains[k].stiffness for k in rows]),
            axial_force=np.stack([chains[k].axial_force for k in rows]),
            modes=max(numbers[k] for k in rows),
        )
        omega2 = solve_many(batch).omega2
        for k, values in zip(rows, omega2, strict=True):
            known = bool(np.all(np.isfinite(values)))
            zeros = zeros_of(FREE, chains[k].axial_force)
            found[k] = values[: numbers[k]] if known else _solve(chains[k], numbers[k], 2, zeros)
    return found


def _solve(chain: Chain, number: int, rigid: int, zeros: int) -> Array:
    """Return the eigenvalues 1 ... n of a chain, after its rigid modes, some of them at zero."""
    try:
        found = find_eigenvalues(chain, number + rigid, zeros=zeros)
    except (CountingError, FloatingPointError) as error:
        wrong = f"the {chain.family} eigenvalues could not be found: {error}"
        raise ComputationError(wrong) from error
    return np.array([value.omega2 for value in elastic(found, rigid)[:number]])


def sufficient_refinement(case: Case, wanted: Wanted, tolerance: float) -> int:
    """Return how finely chains must be divided for frequencies within a relative tolerance."""
    refinement, (before,) = 1, eigenvalues_of([case], [wanted], 1)
    while refinement < _FINEST:
        (after,) = eigenvalues_of([case], [wanted], 2 * refinement)
        changes = [np.abs(after.modes[f].omega2 / before.modes[f].omega2 - 1).max() for f in wanted]
        if max(changes) / 2 < tolerance:
            return refinement
        refinement, before = 2 * refinement, after
        if max(changes) / 32 < tolerance:
            break
    return refinement
