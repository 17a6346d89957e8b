"""The eigenvalues of a case on chains of fixed refinement: a smooth function of its numbers.

`solve_modes` refines until its estimate meets a tolerance. That makes tiny jumps as the input
changes, which derivatives and least squares do not like; here the refinement is chosen once.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from antinode.beam import Beam
from antinode.case import Case
from antinode.errors import ComputationError
from antinode.loads import Loads
from antinode.modes import exact_zeros, rigid_modes
from antinode.riccati.chain import Family
from antinode.riccati.roots import CountingError, find_eigenvalues

from .derivatives import Modes, Sensitivity

Array = npt.NDArray[np.float64]
Wanted = Mapping[Family, int]
_FINEST = 16


@dataclass(frozen=True)
class Response:
    """Eigenvalues 1, 2, ... of the families that were asked for.

    Attributes
    ----------
    case : Case
    loads : Loads
    beam : Beam
    modes : dict
        `Modes` 1 ... n by family, rigid ones left out.
    """

    case: Case
    loads: Loads
    beam: Beam
    modes: Mapping[Family, Modes] = field(repr=False)

    def sensitivity(self, family: Family) -> Sensitivity:
        """Return the derivatives of the eigenvalues of a family."""
        return Sensitivity(self.modes[family], self.beam, self.loads)

    def frequencies_hz(self, family: Family) -> Array:
        """Return the frequencies of modes 1, 2, ... [Hz]; negative for a divergent mode."""
        return hertz(self.modes[family].omega2)


def hertz(omega2: Array) -> Array:
    """Return frequencies [Hz] of omega^2 [rad^2/s^2], with its sign."""
    return np.asarray(np.sign(omega2) * np.sqrt(np.abs(omega2)) / (2 * np.pi))


def hertz_slope(omega2: Array) -> Array:
    """Return the derivative of `hertz` by omega^2 [Hz s^2/rad^2]."""
    size = np.sqrt(np.maximum(np.abs(omega2), np.finfo(float).tiny))
    return np.asarray(1 / (4 * np.pi * size))


def respond(case: Case, wanted: Wanted, refinement: int = 2) -> Response:
    """Compute the eigenvalues 1 ... n of each family that is wanted.

    Raises
    ------
    InputError
        If the case cannot be, such as a fin inside the body.
    ComputationError
        If its loads or its eigenvalues cannot be computed.
    """
    loads, beam = case.loads, case.beam()
    modes = {family: _solve(beam, family, n, refinement) for family, n in wanted.items()}
    return Response(case, loads, beam, modes)


def _solve(beam: Beam, family: Family, number: int, refinement: int) -> Modes:
    rigid, zeros = len(rigid_modes(beam, family)), exact_zeros(beam, family)
    chain = beam.chain(family, refinement)
    try:
        found = find_eigenvalues(chain, number + rigid, zeros=zeros)
    except (CountingError, FloatingPointError) as error:
        raise ComputationError(f"the {family} eigenvalues could not be found: {error}") from error
    omega2 = [value.omega2 for value in found]
    for _ in range(zeros):
        omega2.remove(0.0)
    return Modes(chain, np.array(omega2[rigid - zeros :][:number]))


def sufficient_refinement(case: Case, wanted: Wanted, tolerance: float) -> int:
    """Return how finely chains must be divided for frequencies within a relative tolerance."""
    refinement, before = 1, respond(case, wanted, 1)
    while refinement < _FINEST:
        after = respond(case, wanted, 2 * refinement)
        changes = [np.abs(after.modes[f].omega2 / before.modes[f].omega2 - 1).max() for f in wanted]
        if max(changes) / 2 < tolerance:
            return refinement
        refinement, before = 2 * refinement, after
        if max(changes) / 32 < tolerance:
            break
    return refinement
