"""Natural frequencies of one beam without its shapes: certified, in a fraction of a millisecond.

    an.natural_frequencies(beam, modes=6).frequencies_hz

Where the compiled kernel is loaded (by `solve_many`, a sweep, the app) a beam takes some ten
microseconds for every hundred segments and frequency; elsewhere `solve_modes` computes the same in
numpy. Beams that vary inside intervals are solved with steps halved each time; since the error
falls as the fourth power of the steps, ``omega^2 + (omega^2 - omega^2 before) / 15`` is reported.
"""

from __future__ import annotations

from dataclasses import dataclass
from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from .batch import rigid_modes_of
from .beam import LIMITS, Beam
from .errors import InputError
from .kernel import kernel_if_worthwhile
from .limits import out_of_range_is_an_error
from .modes import HasBeam, rigid_modes, solve_modes
from .result import hertz
from .riccati.chain import Chain

if TYPE_CHECKING:
    from .riccati.lanes import Roots

Array = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]

_WIDTH = 0.98e-10
_MOST_LEVELS = 7
_MODES_PER_REFINEMENT = 8  # that the coarsest steps are meant for
_SHARE = 1 / 4  # of the last change of the extrapolated omega^2: its error falls by 16 or more


@dataclass(frozen=True)
class Frequencies:
    """Elastic bending modes 1 ... n of one beam, each with its certificate.

    Attributes
    ----------
    omega2 : array, shape (modes,)
        [rad^2/s^2]; negative past buckling.
    error_omega2 : array, shape (modes,)
        Bound on the distance to the eigenvalue of the beam as given [rad^2/s^2].
    bracket_omega2 : array, shape (modes, 2)
        Encloses the eigenvalue of the finest segment chain, rounding included [rad^2/s^2].
    counts : array of int, shape (modes, 2)
        Number of eigenvalues, rigid ones included, below either end of the bracket.
    segments : int
        Of the finest chain.
    """

    omega2: Array
    error_omega2: Array
    bracket_omega2: Array
    counts: Integers
    segments: int

    @property
    def frequencies_hz(self) -> Array:
        """Natural frequencies [Hz], shape (modes,); NaN where omega^2 < 0."""
        return np.array([hertz(value) for value in self.omega2.tolist()])

    @property
    def error_hz(self) -> Array:
        """Half-width of the interval of frequency that holds the beam's own [Hz]."""
        lower = self.omega2 - np.minimum(self.error_omega2, np.abs(self.omega2))
        return self.frequencies_hz - [hertz(value) for value in lower.tolist()]


@out_of_range_is_an_error()
def natural_frequencies(
    problem: Beam | HasBeam, modes: int = 6, *, tolerance: float = 1e-6
) -> Frequencies:
    """Compute the natural frequencies of a beam in bending, certified, without shapes.

    Parameters
    ----------
    problem : Beam or case
        A beam, or anything with a method ``beam()``.
    modes : int
        Elastic modes 1 ... `modes`.
    tolerance : float
        Largest relative error of a frequency that is allowed to what varies inside segments.

    Returns
    -------
    Frequencies

    Raises
    ------
    InputError
        If an argument is outside its range.
    ComputationError
        If the eigenvalues could not be bracketed.
    """
    if not 1 <= modes <= 500:
        raise InputError(f"modes is {modes}; allowed are 1 ... 500")
    if not 1e-12 <= tolerance <= 0.1:
        raise InputError(f"tolerance is {tolerance:g}; allowed are 1e-12 ... 0.1 (relative)")
    beam = problem if isinstance(problem, Beam) else problem.beam()
    compiled = kernel_if_worthwhile(len(beam.x), modes)
    found = None if compiled is None else _by_kernel(compiled, beam, modes, tolerance)
    return found or _by_modes(beam, modes, tolerance)


def _by_modes(beam: Beam, modes: int, tolerance: float) -> Frequencies:
    result = solve_modes(beam, modes, tolerance=tolerance, families=("bending",))
    found = [mode for mode in result.modes if mode.number][:modes]
    return Frequencies(
        np.array([mode.omega2 for mode in found]),
        np.array([mode.error_omega2 for mode in found]),
        np.array([mode.bracket_omega2 for mode in found]),
        np.array([mode.counts for mode in found]),
        result.segments["bending"],
    )


class _Chains:
    """The chains of one beam, level by level; compiled where N comes from the table alone."""

    def __init__(self, beam: Beam) -> None:
        self.beam, self.varies = beam, beam.varies("bending")
        self.halves = None
        if beam.attachments or beam.axial_acceleration:
            return
        from .riccati.halves import Halves

        tables = beam.x, beam.mass_per_length, beam.bending_stiffness, beam.axial_force
        self.halves = Halves(*tables, self.varies, beam.interpolation == "log", LIMITS)

    def at(self, refinement: int) -> Chain:
        if self.halves is None:
            return self.beam.chain("bending", refinement)
        h, m, EI, N = self.halves.segments(refinement)
        return Chain(h, m, EI, N, self.beam.ends.left, self.beam.ends.right)


def _by_kernel(
    compiled: ModuleType, beam: Beam, modes: int, tolerance: float
) -> Frequencies | None:
    """Refine until two extrapolated results agree; None where the kernel does not do."""
    try:
        chains = _Chains(beam)
    except OverflowError:
        return None
    rigid = len(rigid_modes(beam, "bending")) if beam.attachments else rigid_modes_of(beam.ends)
    refinement = max(1, (modes + rigid) // _MODES_PER_REFINEMENT)
    levels: list[Array] = []
    start, error = None, np.zeros(modes)
    for _ in range(_MOST_LEVELS):
        chain = chains.at(refinement)
        start = compiled.SingleChain(chain).roots(rigid, modes, _WIDTH, start)
        if start.reason != compiled.CERTIFIED:
            return None
        levels.append(start.omega2)
        if not chains.varies.any():
            return _certified(chain, start, start.omega2, error)
        if len(levels) > 2:
            better, before = (b + (b - a) / 15 for a, b in (levels[-2:], levels[-3:-1]))
            error = _SHARE * np.abs(better - before)
            if np.all(error <= 2 * tolerance * np.abs(better)):
                return _certified(chain, start, better, error)
        refinement *= 2
    return None


def _certified(chain: Chain, found: Roots, omega2: Array, error: Array) -> Frequencies:
    bracket = np.empty((len(omega2), 2))
    bracket[:, 0], bracket[:, 1] = found.low - found.rounding, found.high + found.rounding
    half = np.maximum(bracket[:, 1] - found.omega2, found.omega2 - bracket[:, 0])
    return Frequencies(omega2, error + half, bracket, found.counts, len(chain.length))
