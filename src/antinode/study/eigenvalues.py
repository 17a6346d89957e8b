"""The eigenvalues of a case or a beam on chains of fixed refinement: smooth in its numbers.

`solve_modes` refines until its estimate meets a tolerance. That makes tiny jumps as the input
changes, which derivatives and least squares do not like; here the refinement is chosen once.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from antinode.arrays import Array
from antinode.beam.attachments import feeds_back
from antinode.beam.beam import Beam
from antinode.beam.families import FAMILIES, FamilyName
from antinode.beam.limits import check_limits
from antinode.errors import ComputationError
from antinode.modes.backends import choose
from antinode.modes.batch import BeamBatch, solve_many
from antinode.modes.following import eigenvalues_alone
from antinode.modes.hertz import signed_hertz
from antinode.modes.rigid import exact_zeros, rigid_modes
from antinode.modes.rotation import elastic
from antinode.riccati.chain import Chain
from antinode.riccati.reasons import FLUTTERS
from antinode.riccati.roots import CountingError
from antinode.study.design.subject import Given
from antinode.vehicle.case import Case
from antinode.vehicle.derivatives import ChainModes, EigenvalueDerivatives
from antinode.vehicle.loads import Loads
from antinode.vehicle.many_beams import sheared_columns

from .complex_modes import ComplexModes, complex_modes

Wanted = Mapping[FamilyName, int]
_FINEST = 16


@dataclass(frozen=True)
class CaseEigenvalues:
    """Eigenvalues 1, 2, ... of the families that were asked for.

    Attributes
    ----------
    case : Case or BeamFile
    loads : Loads or None
        Of a case.
    beam : Beam
    modes : dict
        `ChainModes` 1 ... n by family, rigid ones left out; `ComplexModes` where the water's
        stiffness acts.
    """

    case: Given
    loads: Loads | None
    beam: Beam
    modes: Mapping[FamilyName, ChainModes | ComplexModes] = field(repr=False)

    def sensitivity(self, family: FamilyName) -> EigenvalueDerivatives:
        """Return the derivatives of the eigenvalues of a family, of a case."""
        assert self.loads is not None
        assert isinstance(self.case, Case)
        modes = self.modes[family]
        assert isinstance(modes, ChainModes)
        beam = self.case.without_added_mass.beam() if self.case.added_masses else self.beam
        return EigenvalueDerivatives(modes, beam, self.loads)

    def frequencies_hz(self, family: FamilyName) -> Array:
        """Return the frequencies of modes 1, 2, ... [Hz]; negative for a divergent mode."""
        modes = self.modes[family]
        if isinstance(modes, ComplexModes):
            return modes.frequencies_hz
        return signed_hertz(modes.omega2)


def eigenvalues_of(
    cases: Sequence[Given], wanted: Sequence[Wanted], refinement: int = 2
) -> tuple[CaseEigenvalues, ...]:
    """Compute the eigenvalues 1 ... n of each family that is wanted, of several cases at once.

    Those of vehicles side by side, those of beams, which are held in all sorts of ways, in turn.

    Raises
    ------
    InputError
        If a case cannot be, such as a fin inside the body.
    ComputationError
        If its loads or its eigenvalues cannot be computed.
    """
    beams = [case.beam() for case in cases]
    for beam in beams:
        check_limits(beam)
    modes: list[dict[FamilyName, ChainModes | ComplexModes]] = [{} for _ in cases]
    for family in FAMILIES:
        rows = [k for k, families in enumerate(wanted) if family in families]
        answered = [k for k in rows if feeds_back(beams[k].attachments, family)]
        for k in answered:
            modes[k][family] = complex_modes(beams[k], wanted[k][family], refinement)
        rows = [k for k in rows if k not in answered]
        chains = [beams[k].chain(family, refinement) for k in rows]
        own = [beams[k] for k in rows]
        numbers = [wanted[k][family] for k in rows]
        found = _eigenvalues(own, chains, numbers, [isinstance(cases[k], Case) for k in rows])
        for k, chain, omega2 in zip(rows, chains, found, strict=True):
            modes[k][family] = ChainModes(chain, omega2, shear_form=beams[k].shear_form)
    loads = [case.loads if isinstance(case, Case) else None for case in cases]
    return tuple(map(CaseEigenvalues, cases, loads, beams, modes))


def _eigenvalues(
    beams: Sequence[Beam], chains: Sequence[Chain], numbers: Sequence[int], free: Sequence[bool]
) -> list[Array]:
    """Return the eigenvalues 1 ... n of chains of a family; free ones of equal size in a batch."""
    found: list[Array] = [np.zeros(0)] * len(chains)
    sizes = [len(chain.length) if alone else 0 for chain, alone in zip(chains, free, strict=True)]
    for k in (k for k, size in enumerate(sizes) if not size):
        found[k] = _solve(beams[k], chains[k], numbers[k])
    for size in set(sizes) - {0}:
        rows = [k for k, n in enumerate(sizes) if n == size]
        batch = _batch([chains[k] for k in rows], max(numbers[k] for k in rows))
        solved = solve_many(batch)
        for k, values, reason in zip(rows, solved.omega2, solved.reason, strict=True):
            known = bool(np.all(np.isfinite(values))) and reason != FLUTTERS
            found[k] = values[: numbers[k]] if known else _solve(beams[k], chains[k], numbers[k])
    return found


def _batch(chains: Sequence[Chain], modes: int) -> BeamBatch:
    """Return free chains of a family and of equal size as a batch."""
    family = FAMILIES[chains[0].family]
    tables: dict[str, Any] = {
        table: np.stack([chain.columns[name] for chain in chains])
        for name, table in family.columns.items()
    }
    more = {
        name: np.stack([chain.columns[name] for chain in chains])
        for name in chains[0].columns
        if name not in family.columns
    }
    tables |= sheared_columns(more)
    length = np.stack([chain.length for chain in chains])
    ends = np.array([chain.following for chain in chains])
    following = ends if ends.any() else None
    return BeamBatch(length, modes=modes, family=family.name, following=following, **tables)


def _solve(beam: Beam, chain: Chain, number: int) -> Array:
    """Return the eigenvalues 1 ... n of a chain, after the rigid modes of its beam."""
    rigid = len(rigid_modes(beam, chain.family))
    try:
        zeros = exact_zeros(beam, chain.family)
        found = eigenvalues_alone(choose(), chain, number + rigid, zeros, 1e-10, rigid)
    except (CountingError, FloatingPointError) as error:
        wrong = f"the {chain.family} eigenvalues could not be found: {error}"
        raise ComputationError(wrong) from error
    wanted = elastic(found, rigid, chain)[:number]
    if any(value.imaginary for value in wanted):
        raise ComputationError(
            f"a pair of {chain.family} modes flutters; only modes that oscillate steadily have "
            "derivatives here: reduce the forces that follow"
        )
    return np.array([value.omega2 for value in wanted])


def sufficient_refinement(case: Given, wanted: Wanted, tolerance: float) -> int:
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
