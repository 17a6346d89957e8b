"""Refinement: chains with steps halved until the error of every frequency meets the tolerance.

One error rule (`riccati.convergence`) judges every number that is found so. Reported is the
eigenvalue of the finest chain, whose bracket and shape belong to it; its error is its distance from
the extrapolated value, and the error of that.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from antinode.arrays import Array, distinct
from antinode.beam.beam import Beam
from antinode.beam.families import FamilyName
from antinode.beam.loads.turning import refuse_complex
from antinode.riccati.chain import Chain, largest_wave_number, omega2_scale
from antinode.riccati.convergence import extrapolate, within
from antinode.riccati.roots import Eigenvalue

from .following import certifying
from .rigid import exact_zeros, rigid_modes
from .solvers import Found, Solver

NEAR_ZERO = 1e-9  # of the chain's own omega^2: what lies below is as good as zero
_MOST_SEGMENTS = 100_000
_MOST_WORK = 250_000  # segments times modes, some seconds
_LEAST_PER_MODE = 8  # segments that are never too many
_MODES_PER_REFINEMENT = 8  # that the coarsest steps are meant for
_LIKELY = 1e-9  # least relative distance of samples from where an eigenvalue is expected
_BESIDE = np.array([-4.0, -1.0, 1.0, 4.0])
_FEW = 0.1  # N h^2/EI of the coarsest steps up to which two levels do where N alone varies


@dataclass
class Refinement:
    """Levels of chains whose steps are halved each time, and what they tell of their limit.

    Parameters
    ----------
    tolerance : float
        Relative error of a frequency.
    few : bool
        Whether two levels are enough: N alone varies, and no layer is narrower than a step.
    coarse : float
        Relative width to a tenth of which values are known.
    least : float
        What values near zero are measured by.
    """

    tolerance: float
    few: bool = False
    coarse: float = 1e-10
    least: float = 0.0
    levels: list[Array] = field(default_factory=list)
    better: Array = field(default_factory=lambda: np.zeros(0))
    """Extrapolated values."""
    error: Array = field(default_factory=lambda: np.zeros(0))
    """Of the extrapolated values; infinite while too few levels are known."""

    def add(self, values: Array, layer: float) -> None:
        """Take what the next finer chain gives, and its `layer_length`."""
        self.levels.append(np.asarray(values, dtype=float))
        self.better, self.error = self.levels[-1], np.full(len(values), np.inf)
        common = min(map(len, self.levels[-4:]))
        rows = np.array([level[:common] for level in self.levels[-4:]])
        if len(rows) > (1 if self.few else 2):
            better, error = np.empty(common), np.empty(common)
            extrapolate(rows, len(rows) - 1, self.coarse, layer, better, error)
            self.better = np.append(better, self.levels[-1][common:])
            self.error = np.append(error, np.full(len(values) - common, np.max(error)))

    @property
    def error_of_last(self) -> Array:
        """Error of the values of the finest chain as they stand."""
        return np.asarray(np.abs(self.better - self.levels[-1]) + self.error)

    @property
    def expected(self) -> Array | None:
        """Places beside the next values, if the error keeps falling as the fourth power."""
        if len(self.levels) < 2 or len(self.levels[-1]) != len(self.levels[-2]):
            return None
        last = self.levels[-1]
        change = last - self.levels[-2]
        spread = np.maximum(np.abs(change) / 64, _LIKELY * np.abs(last))
        return distinct((last + change / 16 + spread * _BESIDE[:, None]).ravel())

    def met(self, error: Array) -> bool:
        """Tell whether errors of the last values are all within the tolerance."""
        return bool(within(self.levels[-1], error, self.tolerance, self.least))

    def relative(self, error: Array) -> float:
        """Return the largest error of a frequency relative to it."""
        size = np.maximum(np.abs(self.levels[-1]), self.least)
        return float(np.max(error / (2 * size)))


def layer_length(chain: Chain, varies: Array | None = None) -> float:
    """Return the largest abs(N) h^2/EI of the segments; 0 in a family without axial force.

    With shear or a foundation it is the square of what grows fastest at omega^2 = 0, times h^2.

    `varies` says for each whether it stands for something that varies; others are exact.
    """
    if not chain.law.has_axial_force:
        return 0.0
    if chain.is_plain:
        length = np.abs(chain.axial_force) * chain.length**2 / chain.stiffness
    else:
        length = (largest_wave_number(chain, 0.0) * chain.length) ** 2
    return float(np.max(length if varies is None else np.where(varies, length, 0.0)))


def varying_segments(beam: Beam, chain: Chain) -> Array:
    """Tell for each segment of a beam's chain whether its interval varies."""
    middle = beam.x[0] + (chain.nodes[1:] + chain.nodes[:-1]) / 2
    interval = np.clip(np.searchsorted(beam.x, middle) - 1, 0, len(beam.x) - 2)
    return np.asarray(beam.varies(chain.law.name)[interval])


@dataclass(frozen=True)
class Solved:
    """Eigenvalues of one family on the finest chain, with the error of the representation."""

    chain: Chain
    eigenvalues: list[Eigenvalue]
    discretisation: Array
    """Of omega^2 [rad^2/s^2]; NaN where the solver proves nothing."""
    warnings: list[str]
    certificate: Mapping[str, Any]
    """What proves the list, as JSON has it."""


def solve_family(
    beam: Beam, family: FamilyName, modes: int, tolerance: float, solver: Solver
) -> Solved:
    """Refine until the estimated error of every wanted frequency is within the tolerance."""
    refuse_complex(beam, family, "undamped modes")
    wanted = modes + len(rigid_modes(beam, family))
    zeros = exact_zeros(beam, family)
    most = max(min(_MOST_SEGMENTS, _MOST_WORK // wanted), _LEAST_PER_MODE * wanted)
    counting, first = certifying(solver, beam, family), max(1, wanted // _MODES_PER_REFINEMENT)

    def solve(chain: Chain, expected: Array | None = None) -> Found:
        return counting.find(chain, wanted, zeros=zeros, expected=expected)

    if not beam.varies(family).any():
        chain = beam.chain(family)
        found = solve(chain)
        error, warnings = np.zeros(len(found.eigenvalues)), list[str]()
    else:
        chain, found, error, warnings = _refine(beam, family, first, tolerance, most, solve)
    if solver is not solver.counting:
        found = solver.find(chain, wanted, zeros=zeros)
        error = np.full(len(found.eigenvalues), np.nan)
    warnings = [*warnings, *found.warnings]
    return Solved(chain, found.eigenvalues, error, warnings, found.certificate)


def _refine(
    beam: Beam,
    family: FamilyName,
    refinement: int,
    tolerance: float,
    most: int,
    solve: Callable[[Chain, Array | None], Found],
) -> tuple[Chain, Found, Array, list[str]]:
    """Return the finest chain that was needed, what was found, errors, and warnings."""
    smooth = not np.any(beam.without_axial_force().varies(family))
    chain = beam.chain(family, refinement)
    few = smooth and layer_length(chain) < _FEW
    levels = Refinement(tolerance, few, least=NEAR_ZERO * omega2_scale(chain))
    before = np.inf
    while True:
        found = solve(chain, levels.expected)
        levels.add(_numbers(found.eigenvalues), layer_length(chain, varying_segments(beam, chain)))
        error = levels.error_of_last
        if levels.met(error):
            return chain, found, _of_pairs(found.eigenvalues, error), []
        relative = levels.relative(error)
        noise = relative < NEAR_ZERO and relative > before / 4
        if noise or (2 * len(chain.length) > most and np.isfinite(relative)):
            warning = (
                f"{family}: {len(chain.length)} segments do not reach the tolerance "
                f"{tolerance:g}; see the errors, or ask for fewer modes or a larger tolerance"
            )
            return chain, found, _of_pairs(found.eigenvalues, error), [warning]
        refinement, before = 2 * refinement, relative
        chain = beam.chain(family, refinement)


def _numbers(eigenvalues: list[Eigenvalue]) -> Array:
    """Return omega^2; of a complex pair the real part, and for its second one the imaginary."""
    return np.array([-v.imaginary if v.imaginary < 0 else v.omega2 for v in eigenvalues])


def _of_pairs(eigenvalues: list[Eigenvalue], error: Array) -> Array:
    """Return errors of omega^2; both of a pair have that of the real and the imaginary part."""
    found = error.copy()
    for k, value in enumerate(eigenvalues[1:], 1):
        if value.imaginary < 0:
            found[k - 1 : k + 1] = np.hypot(error[k - 1], error[k])
    return found
