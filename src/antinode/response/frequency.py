"""Frequency responses: outputs over drives, exact for the chain, with an error beside each.

    response = frequency_response(beam, [10, 20, 30], [Force(6.0)], [Output(1.2, "acceleration")])

No mode is left out: every frequency is one pass through the chain (`riccati.forced`). The stated
error holds for all frequencies of an output: that of representing what varies by uniform segments
(`riccati.convergence`), and that of rounding, which is how far a change of the frequency by some
units in the last place moves the response.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from antinode.arguments import ByValue, numbers, within
from antinode.arrays import Array, Numbers
from antinode.beam.beam import Beam
from antinode.beam.families import FamilyName
from antinode.beam.limits import out_of_range_is_an_error
from antinode.errors import InputError
from antinode.modes.backends import BackendName
from antinode.modes.solve import HasBeam

from .damping import UNDAMPED, Damping
from .forced import Forced, judged, refined, with_stations
from .modal import modes_below
from .quantities import Base, Drive, Force, Output, check_places, stations_of

ROUNDING = 5e-14
"""Relative change of a frequency that moves a response at least as far as rounding does."""
_LOST = 0.05  # share of a response that rounding moves: at a pole no digit is certain
_ANY = 10.0  # times it, how wrong it may be there, where it is but rounding
_STEPS = 1e-7, 1e-10, 3e-13  # relative steps by which that change is measured
_PER_REFINEMENT = 8  # modes that the coarsest steps are meant for


@dataclass(frozen=True, eq=False)
class FrequencyResponse(ByValue):
    """Outputs over drives at some frequencies.

    Attributes
    ----------
    beam : Beam
    frequency_hz : array, shape (k,)
        [Hz].
    drives : tuple of Force or Base
    outputs : tuple of Output
    values : array, shape (outputs, drives, k)
        Numbers, time as exp(+i omega t): unit of the output over unit of the drive.
    error : array, shape (outputs, drives)
        Largest distance of any of the values from the beam's own, in the same unit.
    segments : dict
        Uniform segments that represent the beam at last, by family.
    """

    beam: Beam
    frequency_hz: Array
    drives: tuple[Drive, ...]
    outputs: tuple[Output, ...]
    values: Numbers = field(repr=False)
    error: Array
    segments: dict[str, int]

    def __str__(self) -> str:
        head = (
            f"{self.beam.name}: {len(self.frequency_hz)} frequencies, "
            f"{self.frequency_hz[0]:g} to {self.frequency_hz[-1]:g} Hz"
        )
        lines = []
        for row, output in enumerate(self.outputs):
            for case, drive in enumerate(self.drives):
                most = float(np.max(np.abs(self.values[row, case])))
                unit = f"{output.unit} per {drive.unit}"
                lines.append(f"  {output.name} by {drive.name}: at most {most:.5g} {unit}")
        return "\n".join([head, *lines])


class Model:
    """A beam with drives and outputs, ready to be asked at any frequency.

    Parameters
    ----------
    beam : Beam
    drives : sequence of Force or Base
    outputs : sequence of Output
    damping : Damping
    highest_hz : float
        No frequency will be higher [Hz].
    backend : {"auto", "numpy", "numba"}
    """

    def __init__(
        self,
        beam: Beam,
        drives: Sequence[Drive],
        outputs: Sequence[Output],
        damping: Damping,
        highest_hz: float,
        backend: BackendName = "auto",
    ) -> None:
        self.backend = backend
        self.drives, self.outputs, self.damping = tuple(drives), tuple(outputs), damping
        if not self.drives or not self.outputs:
            raise InputError("a response needs at least one force, or [base], and one output")
        check_places(beam, self.drives, self.outputs)
        self.beam = with_stations(beam, stations_of(self.drives, self.outputs))
        driven = {drive.family for drive in self.drives}
        self.families: list[FamilyName] = [
            f for f in self.beam.families if f in driven and any(o.family == f for o in outputs)
        ]
        self.highest_hz = highest_hz
        self._chains: dict[tuple[FamilyName, int], Forced] = {}
        self._at: Callable[[Array], Numbers] | None = None
        self._doubt: Callable[[Array], Array] | None = None

    def with_outputs(self, rows: Sequence[int]) -> Model:
        """Return the model with some of its outputs alone."""
        rows = list(rows)
        if len(rows) == len(self.outputs):
            return self
        outputs = [self.outputs[row] for row in rows]
        own = Model(self.beam, self.drives, outputs, self.damping, self.highest_hz, self.backend)
        if (at := self._at) is not None:
            own.use(lambda f: at(f)[rows])
        return own

    def first(self, family: FamilyName) -> int:
        """Return the refinement to start from: of no weight where nothing varies."""
        if not np.any(self.beam.varies(family)):
            return 1
        return max(
            1, modes_below(self.beam, family, self.highest_hz, self.backend) // _PER_REFINEMENT
        )

    def rows(self, family: FamilyName) -> list[int]:
        """Return which outputs are of a family."""
        return [row for row, output in enumerate(self.outputs) if output.family == family]

    def forced(self, family: FamilyName, refinement: int) -> Forced:
        """Return one family's driven chain."""
        key = family, refinement
        if key not in self._chains:
            outputs = tuple(self.outputs[row] for row in self.rows(family))
            self._chains[key] = Forced(
                self.beam, family, self.drives, outputs, self.damping, refinement, self.backend
            )
        return self._chains[key]

    def segments(self) -> dict[str, int]:
        """Return the number of segments of the finest chain of each family."""
        return {
            family: max(
                len(forced.chain.length)
                for (name, _), forced in self._chains.items()
                if name == family
            )
            for family in self.families
        }

    def response(self, frequency_hz: Array, tolerance: float) -> tuple[Numbers, Array]:
        """Return outputs over drives (outputs, drives, k), and errors (outputs, drives)."""
        H, error, _ = self.response_with(frequency_hz, np.empty(0), tolerance)
        return H, error

    def response_with(
        self, frequency_hz: Array, more_hz: Array, tolerance: float
    ) -> tuple[Numbers, Array, Array]:
        """Return the same, and errors (outputs, drives) at more frequencies, such as peaks."""
        omega, needed = 2 * np.pi * np.concatenate([frequency_hz, more_hz]), len(frequency_hz)
        H = np.zeros((len(self.outputs), len(self.drives), len(omega)), dtype=complex)
        error, wrong = np.zeros(H.shape[:2]), np.zeros(H.shape[:2])
        for family in self.families:
            rows = self.rows(family)

            def compute(refinement: int, family: FamilyName = family) -> Numbers:
                return self.forced(family, refinement).at(omega)

            units = [self.outputs[row].unit for row in rows]
            H[rows], each = refined(
                *(self.beam, family, compute, self.first(family), tolerance, units), needed=needed
            )
            finest = self.forced(family, max(r for name, r in self._chains if name == family))
            for errors, part in ((error, slice(needed)), (wrong, slice(needed, None))):
                if len(omega[part]):
                    round_off = rounding(finest, omega[part], H[rows][:, :, part])
                    errors[rows] = np.max(each[:, :, part], axis=-1) + round_off
        return H[:, :, :needed], error, wrong

    def judged(self, frequency_hz: Array) -> tuple[Numbers, Array]:
        """Return outputs over drives by three levels of chains, and the error of each number.

        However large it is: for a look that must not take long. (outputs, drives, k) each.
        """
        levels = {}
        for family in self.families:
            first = self.first(family)
            varies = np.any(self.beam.varies(family))
            levels[family] = [first, 2 * first, 4 * first] if varies else [first]
        return self._judged_on(levels, frequency_hz)

    def known(self, frequency_hz: Array) -> tuple[Numbers, Array]:
        """Return what `quick` does, and the error of each number, (outputs, drives, k) each."""
        if self._doubt is not None:
            return self.quick(frequency_hz), self._doubt(frequency_hz)
        return self._judged_on({f: self._solved(f)[-4:] for f in self.families}, frequency_hz)

    def _judged_on(
        self, levels: dict[FamilyName, list[int]], frequency_hz: Array
    ) -> tuple[Numbers, Array]:
        """Return outputs over drives by chains of given refinements, and errors."""
        omega = 2 * np.pi * frequency_hz
        H = np.zeros((len(self.outputs), len(self.drives), len(omega)), dtype=complex)
        error = np.zeros(H.shape)
        for family in self.families:
            rows = self.rows(family)
            chains = [self.forced(family, refinement) for refinement in levels[family]]
            H[rows], error[rows] = judged(self.beam, chains, omega)
            moved, noise = _moved(chains[-1], omega, chains[-1].at(omega))
            size = np.abs(H[rows])
            error[rows] += ROUNDING * (moved + size) + noise
            lost = ROUNDING * moved > _LOST * size + noise
            error[rows] += np.where(lost, _ANY * size, 0.0)
        return H, error

    def _solved(self, family: FamilyName) -> list[int]:
        """Return the refinements that were asked for so far, in order."""
        return sorted(refinement for name, refinement in self._chains if name == family)

    def use(
        self, at: Callable[[Array], Numbers], doubt: Callable[[Array], Array] | None = None
    ) -> None:
        """Take outputs over drives, and their errors, from functions of frequencies [Hz]."""
        self._at, self._doubt = at, doubt

    def on(self, levels: dict[FamilyName, int], frequency_hz: Array) -> Numbers:
        """Return outputs over drives, (outputs, drives, k), on chains of given refinements."""
        if self._at is not None:
            return self._at(frequency_hz)
        omega = 2 * np.pi * frequency_hz
        H = np.zeros((len(self.outputs), len(self.drives), len(omega)), dtype=complex)
        for family, refinement in levels.items():
            H[self.rows(family)] = self.forced(family, refinement).at(omega)
        return H

    def quick(self, frequency_hz: Array) -> Numbers:
        """Return outputs over drives, (outputs, drives, k), by the chains that `response` needed.

        Extrapolated from the last two levels where something varies.
        """
        if self._at is not None:
            return self._at(frequency_hz)
        omega = 2 * np.pi * frequency_hz
        H = np.zeros((len(self.outputs), len(self.drives), len(omega)), dtype=complex)
        for family in self.families:
            levels = self._solved(family)
            fine = self.forced(family, levels[-1]).at(omega)
            if len(levels) > 1:
                fine = fine + (fine - self.forced(family, levels[-2]).at(omega)) / 15
            H[self.rows(family)] = fine
        return H


def rounding(forced: Forced, omega: Array, H: Numbers) -> Array:
    """Return how wrong rounding may make responses (outputs, drives, k): (outputs, drives)."""
    rows, last = H.reshape(-1, len(omega)), len(omega) - 1
    size = np.abs(rows)
    largest = np.argmax(size, axis=-1)
    steepest = np.argmax(np.abs(np.diff(rows)), axis=-1) if last else largest
    beside = np.concatenate([[0, last], largest, largest + 1, steepest, steepest + 1])
    worst = np.unique(np.minimum(beside, last))
    moved, noise = _moved(forced, omega[worst], H[:, :, worst])
    most = np.max(size, axis=-1).reshape(H.shape[:2])
    error = ROUNDING * (np.max(moved, axis=-1) + most) + np.max(noise, axis=-1)
    lost = np.any(ROUNDING * moved > _LOST * np.abs(H[:, :, worst]) + noise, axis=-1)
    return np.where(lost, np.inf, error)


def _moved(forced: Forced, omega: Array, H: Numbers) -> tuple[Array, Array]:
    """Return how fast responses move with a relative change of frequency, and what is noise.

    The fastest of three steps: beside a resonance without damping the longer ones leap over it.
    """
    steps = np.array(_STEPS)
    far, noise = forced.at_with_noise((omega * (1 + steps[:, None])).ravel())
    far, noise = (part.reshape(*H.shape[:2], len(steps), -1) for part in (far, noise))
    moved = np.abs(far - H[:, :, None]) / steps[:, None]
    return np.max(moved, axis=2), np.max(noise, axis=2)


@out_of_range_is_an_error()
def frequency_response(
    problem: Beam | HasBeam,
    frequency_hz: npt.ArrayLike,
    drives: Drive | Sequence[Drive],
    outputs: Output | Sequence[Output],
    *,
    damping: Damping = UNDAMPED,
    tolerance: float = 1e-6,
    backend: BackendName = "auto",
) -> FrequencyResponse:
    """Compute frequency responses of a beam, without modal truncation.

    Parameters
    ----------
    problem : Beam or case
        A beam, or anything with a method ``beam()``.
    frequency_hz : array_like, shape (k,)
        Above 0 [Hz].
    drives : Force, Base or sequence of them
        A unit of each, one after the other.
    outputs : Output or sequence of Output
    damping : Damping
        Not by ratios of modes: `modal_response` takes those.
    tolerance : float
        Error of an output by what varies inside segments, relative to its largest value.
    backend : {"auto", "numpy", "numba"}
        What carries the states: compiled code, or numpy, which is read.

    Returns
    -------
    FrequencyResponse

    Raises
    ------
    InputError
        If a station is off the beam, the beam lacks a column, or an argument is out of range.
    """
    drives = (drives,) if isinstance(drives, Force | Base) else drives
    outputs = (outputs,) if isinstance(outputs, Output) else outputs
    frequency = checked_frequencies(frequency_hz)
    tolerance = within("tolerance", tolerance, 1e-12, 0.1, " (relative)")
    if damping.modal:
        raise InputError(
            "ratios of modes are no property of a beam: use modal_response, or a loss factor"
        )
    beam = problem if isinstance(problem, Beam) else problem.beam()
    model = Model(beam, drives, outputs, damping, float(np.max(frequency)), backend)
    H, error = model.response(frequency, tolerance)
    return FrequencyResponse(
        beam, frequency, model.drives, model.outputs, H, error, model.segments()
    )


def checked_frequencies(frequency_hz: npt.ArrayLike) -> Array:
    """Return frequencies as an array, or raise InputError unless all are above 0 [Hz]."""
    frequency = np.atleast_1d(numbers("frequency_hz", frequency_hz))
    bad = ~(np.isfinite(frequency) & (frequency > 0))
    if frequency.ndim != 1 or not len(frequency):
        raise InputError("frequency_hz must be a list of frequencies [Hz]")
    if np.any(bad):
        raise InputError(
            f"a frequency is {frequency[bad][0]:g} Hz; it must be finite and above 0 (statics are "
            "the limit: give a low frequency)"
        )
    return frequency
