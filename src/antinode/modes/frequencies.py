"""Natural frequencies of one beam without its shapes: certified, in a fraction of a millisecond.

    an.natural_frequencies(beam, modes=6).frequencies_hz

Compiled, a beam takes some ten microseconds for every hundred segments and frequency; in numpy
`solve_modes` computes the same. Beams that vary inside intervals are solved with steps halved each
time; since the error falls as the fourth power of the steps, ``omega^2 + (omega^2 - omega^2
before) / 15`` is reported.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from antinode.arguments import ByValue, whole, within
from antinode.arrays import Array, Integers
from antinode.beam.beam import Beam
from antinode.beam.families import BENDING, FAMILIES
from antinode.beam.limits import out_of_range_is_an_error
from antinode.beam.loads.turning import refuse_complex
from antinode.beam.representation import LIMITS
from antinode.riccati.chains import Tables
from antinode.riccati.points import Point
from antinode.riccati.reasons import CERTIFIED

from .backends import Backend, BackendName, choose
from .brackets import share_brackets
from .hertz import error_hz, hertz, settled
from .result import ModalResult
from .rigid import rigid_modes, rigid_modes_of
from .solve import HasBeam, beam_of, solve_modes

_WIDTH = 0.98e-10
_MODES_PER_REFINEMENT = 8  # that the coarsest steps are meant for
_NOT_READ = np.zeros(0)


@dataclass(frozen=True, eq=False)
class Frequencies(ByValue):
    """Elastic bending modes 1 ... n of one beam, each with its certificate.

    Attributes
    ----------
    omega2 : array, shape (modes,)
        [rad^2/s^2]; negative past buckling.
    error_omega2 : array, shape (modes,)
        Distance to the eigenvalue of the beam as given [rad^2/s^2]: that to the bracket's end,
        which is certain, and the estimated error of representing what varies by uniform segments.
    bracket_omega2 : array, shape (modes, 2)
        Encloses the eigenvalue of the finest segment chain, rounding included, and reaches to
        `omega2` where that is extrapolated beyond it [rad^2/s^2].
    counts : array of int, shape (modes, 2)
        Number of eigenvalues of the chain, rigid ones included, below either end of the bracket.
    segments : int
        Of the finest chain.
    beam : Beam
        That was solved.
    """

    omega2: Array
    error_omega2: Array
    bracket_omega2: Array
    counts: Integers
    segments: int
    beam: Beam = field(repr=False)

    @cached_property
    def _with_shapes(self) -> ModalResult:
        return solve_modes(self.beam, len(self.omega2), families=(BENDING,), damping="none")

    @property
    def model_error(self) -> Array:
        """First-order effect of shear and rotary inertia on each frequency, relative, (modes,).

        It needs the shapes, which are computed when it is first asked for; NaN where the beam does
        not tell, and past buckling.
        """
        modes = [mode for mode in self._with_shapes.modes if mode.number][: len(self.omega2)]
        return np.array([mode.model_error for mode in modes], dtype=float)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What `solve_modes` warns of; computed when it is first asked for, as `model_error`."""
        return self._with_shapes.warnings

    @property
    def frequencies_hz(self) -> Array:
        """Natural frequencies [Hz], shape (modes,); NaN where omega^2 < 0."""
        return hertz(self.omega2)

    @property
    def error_hz(self) -> Array:
        """Half-width of the interval of frequency that holds the beam's own [Hz]."""
        return error_hz(self.omega2, self.error_omega2)


def natural_frequencies(
    problem: Beam | HasBeam,
    modes: int = 6,
    *,
    tolerance: float = 1e-6,
    backend: BackendName = "auto",
) -> Frequencies:
    """Compute the natural frequencies of a beam in bending, certified, without shapes.

    They are undamped: dashpots do nothing to them.

    Parameters
    ----------
    problem : Beam or case
        A beam, or anything with a method ``beam()``.
    modes : int
        Elastic modes 1 ... `modes`.
    tolerance : float
        Largest relative error of a frequency that is allowed to what varies inside segments.
    backend : {"auto", "numpy", "numba"}
        What solves: compiled code, or numpy, which takes some milliseconds. "auto" is numba.

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
    modes = whole("modes", modes, 500)
    tolerance = within("tolerance", tolerance, 1e-12, 0.1, " (relative)")
    beam = problem if isinstance(problem, Beam) else _beam_of(problem)
    refuse_complex(beam, BENDING, "undamped frequencies")
    found = _directly(choose(backend), beam, modes, tolerance)
    return found or _by_modes(beam, modes, tolerance, backend)


@out_of_range_is_an_error()
def _beam_of(problem: HasBeam) -> Beam:
    return beam_of(problem)


def _by_modes(beam: Beam, modes: int, tolerance: float, backend: BackendName) -> Frequencies:
    result = solve_modes(
        beam, modes, tolerance=tolerance, families=(BENDING,), backend=backend, damping="none"
    )
    found = [mode for mode in result.modes if mode.number][:modes]
    return Frequencies(
        np.array([mode.omega2 for mode in found]),
        np.array([mode.error_omega2 for mode in found]),
        np.array([mode.bracket_omega2 for mode in found]),
        np.array([mode.counts for mode in found]),
        result.segments[BENDING],
        beam,
    )


def _directly(solver: Backend, beam: Beam, modes: int, tolerance: float) -> Frequencies | None:
    """Solve with steps halved until two extrapolated results agree; None where that fails."""
    if beam.is_curved or FAMILIES[BENDING].used(beam):
        return None
    held: tuple[str, str, tuple[Point, ...]] = beam.ends.left, beam.ends.right, ()
    rigid, acceleration, mass_left = rigid_modes_of(beam.ends, BENDING), 0.0, _NOT_READ
    if beam.attachments or beam.axial_acceleration:
        held, rigid, acceleration, mass_left = _held_and_accelerated(beam)
    left, right, points = held
    tables = Tables(
        x=beam.x,
        mass=beam.mass_per_length,
        stiffness=beam.bending_stiffness,
        axial_force=beam.axial_force,
        acceleration=acceleration,
        mass_left=mass_left,
        logarithmic=beam.interpolation == "log",
        limits=LIMITS,
        left=left,
        right=right,
        points=points,
        following=beam.following(),
    )
    refinement = max(1, (modes + rigid) // _MODES_PER_REFINEMENT)
    found = solver.solve_beam(tables, rigid, modes, refinement, float(tolerance), _WIDTH)
    if found is None or found.reason != CERTIFIED or not np.isfinite(found.error).all():
        return None
    if found.omega2[0] < 0 and "translation" in rigid_modes(beam, BENDING):
        return None  # its omega^2 = 0 lies above an elastic mode: indices do not tell them apart
    _reach(found.bracket, found.omega2, found.counts)
    omega2, error = settled(found.omega2, found.error)
    return Frequencies(omega2, error, found.bracket, found.counts, found.segments, beam)


def _reach(bracket: Array, omega2: Array, counts: Integers) -> None:
    """Let brackets reach to extrapolated values, and neighbours share them where they then meet."""
    low, high = bracket[:, 0], bracket[:, 1]
    np.minimum(low, omega2, out=low)
    np.maximum(high, omega2, out=high)
    if np.count_nonzero(low[1:] <= high[:-1]):
        share_brackets(low, high, counts)


@out_of_range_is_an_error()
def _held_and_accelerated(
    beam: Beam,
) -> tuple[tuple[str, str, tuple[Point, ...]], int, float, Array]:
    """Return the ends and points of a beam, its rigid modes, acceleration and mass left of x."""
    held, rigid = beam.points(BENDING), len(rigid_modes(beam, BENDING))
    return held, rigid, float(beam.axial_acceleration), beam.mass_left
