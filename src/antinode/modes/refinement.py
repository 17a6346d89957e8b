"""Refinement: chains halved until the estimated error of every frequency meets the tolerance."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from antinode.arrays import Array
from antinode.beam.beam import Beam
from antinode.beam.families import FamilyName
from antinode.riccati.chain import Chain, omega2_scale
from antinode.riccati.roots import Eigenvalue

from .rigid import exact_zeros, rigid_modes
from .solvers import Solver

ROUNDING = 64 * np.finfo(float).eps  # times the conditioning of an eigenvalue
_MOST_SEGMENTS = 100_000
_MOST_WORK = 250_000  # segments times modes, some seconds
_LEAST_PER_MODE = 8  # segments that are never too many
_MODES_PER_REFINEMENT = 8  # that the coarsest steps are meant for
_MOST_DOUBTS = 5  # representations after which a strange order of convergence is accepted
_SAFETY = 2.5  # estimate over likely error
_ACCIDENT = 1 / 1024  # share of the last change but one that an estimate keeps
_LIKELY = 1e-9  # least relative distance of samples from where an eigenvalue is expected
_BESIDE = np.array([-4.0, -1.0, 1.0, 4.0])
_LAYER = 0.1  # N h^2/EI up to which two representations are enough where N alone varies
_NEAR_ZERO = 1e-9  # of the chain's own omega^2


@dataclass(frozen=True)
class Solved:
    """Eigenvalues of one family on the finest chain, with the error of the representation."""

    chain: Chain
    eigenvalues: list[Eigenvalue]
    discretisation: Array
    """Of omega^2 [rad^2/s^2]; NaN where the solver proves nothing."""
    warnings: list[str]


def solve_family(
    beam: Beam, family: FamilyName, modes: int, tolerance: float, solver: Solver
) -> Solved:
    """Refine until the estimated error of every wanted frequency is within the tolerance.

    Two representations give an estimate. Where m or EI vary, the coarsest may be too coarse for
    the error to fall as the fourth power of the steps: further ones must confirm that it does.
    """
    wanted = modes + len(rigid_modes(beam, family))
    zeros = exact_zeros(beam, family)
    smooth = not np.any(beam.without_axial_force().varies(family))
    most = max(min(_MOST_SEGMENTS, _MOST_WORK // wanted), _LEAST_PER_MODE * wanted)
    refinement = max(1, wanted // _MODES_PER_REFINEMENT)
    chain = beam.chain(family, refinement)
    smooth = smooth and _resolves_force(chain)
    counting = solver.counting
    eigenvalues = counting.find(chain, wanted, zeros=zeros).eigenvalues
    levels = [_omega2(eigenvalues)]
    error = np.zeros(len(eigenvalues))
    warnings: list[str] = []
    while np.any(beam.varies(family)):
        refinement *= 2
        chain, before = beam.chain(family, refinement), error
        expected = _expected(levels)
        eigenvalues = counting.find(chain, wanted, zeros=zeros, expected=expected).eigenvalues
        levels.append(_omega2(eigenvalues))
        error = _discretisation_error(levels[-3:])
        relative = _relative_error(chain, levels[-1], error)
        trusted = smooth or len(levels) > _MOST_DOUBTS or _order_is_four(levels, relative)
        if trusted and np.all(relative <= tolerance):
            break
        if 2 * len(chain.length) > most or _is_noise(error, before, relative):
            if np.any(relative > tolerance):
                warnings.append(
                    f"{family}: {len(chain.length)} segments do not reach the tolerance "
                    f"{tolerance:g}; see the errors, or ask for fewer modes or a larger tolerance"
                )
            break
    if solver is counting:
        return Solved(chain, eigenvalues, error, warnings)
    found = solver.find(chain, wanted, zeros=zeros)
    unknown = np.full(len(found.eigenvalues), np.nan)
    return Solved(chain, found.eigenvalues, unknown, [*warnings, *found.warnings])


def _resolves_force(chain: Chain) -> bool:
    """Tell whether no segment is long against sqrt(EI/N), the width of a layer at an end."""
    if not chain.law.has_axial_force:
        return True
    return bool(np.all(np.abs(chain.axial_force) * chain.length**2 < _LAYER * chain.stiffness))


def _expected(levels: list[Array]) -> Array | None:
    """Return places beside the next eigenvalues, if the error keeps falling as the fourth power."""
    if len(levels) < 2 or len(levels[-1]) != len(levels[-2]):
        return None
    last, change = levels[-1], levels[-1] - levels[-2]
    spread = np.maximum(np.abs(change) / 64, _LIKELY * np.abs(last))
    return np.unique(last + change / 16 + spread * _BESIDE[:, None])


def _omega2(eigenvalues: list[Eigenvalue]) -> Array:
    return np.array([value.omega2 for value in eigenvalues])


def _discretisation_error(levels: list[Array]) -> Array:
    """Estimate the error of the last omega^2 from solutions with steps halved each time.

    When the error falls by 16 it is 1/15 of the last change. A multiple of that is reported, a
    larger one where the changes fall more slowly or faster, as they do before the fourth order is
    reached. Where two solutions agree by accident, a share of the change before takes over.
    """
    changes, fall = _changes(levels)
    error = changes[-1] * (_SAFETY / 15)
    if len(changes) > 1:
        fall = np.clip(np.minimum(fall, 256 / np.maximum(fall, 1.0)), 3.0, 16.0)
        error = np.maximum(_SAFETY * changes[-1] / (fall - 1), changes[-2] * _ACCIDENT)
    return np.append(error, np.full(len(levels[-1]) - len(error), np.max(error)))


def _changes(levels: list[Array]) -> tuple[Array, Array]:
    """Return how omega^2 changed from level to level, and by what the last change is smaller."""
    common = min(map(len, levels))
    changes = np.abs(np.diff([omega2[:common] for omega2 in levels], axis=0))
    return changes, changes[-2 % len(changes)] / np.maximum(changes[-1], np.finfo(float).tiny)


def _order_is_four(levels: list[Array], relative: Array) -> bool:
    """Tell whether the last change of every omega^2 is near 1/16 of the one before, or tiny."""
    if len(levels) < 3:
        return False
    _, fall = _changes(levels[-3:])
    near = (fall > 16 / 2.5) & (fall < 16 * 2.5)
    return bool(np.all(near | (relative[: len(fall)] < 1e-10)))


def _relative_error(chain: Chain, omega2: Array, error: Array) -> Array:
    """Return the error of each frequency relative to it (to the chain's own, where near zero)."""
    return np.asarray(error / 2 / np.maximum(np.abs(omega2), _NEAR_ZERO * omega2_scale(chain)))


def _is_noise(error: Array, before: Array, relative: Array) -> bool:
    """Tell whether estimates are so small, and fall so little, that rounding makes them."""
    common = min(len(error), len(before))
    falls_little = np.any(before) and np.all(error[:common] > before[:common] / 4)
    return bool(falls_little and np.max(relative) < _NEAR_ZERO)
