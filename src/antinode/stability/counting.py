"""Divergence under forces of fixed direction: each critical load from counts at omega^2 = 0.

Stiffness less factor times the work of the forces, ``K - p G`` with ``K >= 0``: over p it is
``K/p - G``, which can only fall by a rising factor. So the number of negative eigenvalues can only
rise, each step of it is one critical load, and none is missing between two counts. Flutter there is
none: all eigenvalues are real.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np

from antinode.beam.beam import Beam
from antinode.beam.families import BENDING
from antinode.errors import ComputationError, InputError
from antinode.modes.backends import Backend
from antinode.modes.buckling import WIDTH, rounding_of, statics
from antinode.modes.loading import (
    greatest_in_shear,
    loading,
    range_of_factors,
    zeros_of_force,
)
from antinode.modes.refinement import Refinement, layer_length, varying_segments
from antinode.modes.rigid import rigid_modes
from antinode.riccati.roots import narrow

from .result import Certificate, CriticalLoad

_ENOUGH = 4  # modes that have lost stability
_FAR = 1e3  # times the first critical load
_GROWTH = 2.0
_MOST = 100  # critical loads below a factor that was asked for
_MOST_SEGMENTS = 100_000
_NEAR = 1e-3


@dataclass(frozen=True)
class Counted:
    """Critical loads by counts, and how far they were looked for."""

    critical: tuple[CriticalLoad, ...]
    reach: float
    unstable: int
    """Modes that diverge without any axial force."""
    warnings: tuple[str, ...]


def divergences(beam: Beam, most: float | None, tolerance: float, backend: Backend) -> Counted:
    """Find the factors at which one more mode diverges.

    Parameters
    ----------
    beam : Beam
        With end forces of fixed direction.
    most : float or None
        The largest factor; by default where four modes have diverged, or 1e3 times the first.
    tolerance : float
        Largest relative error of a factor by what varies inside segments.
    backend : Backend
    """
    beam = beam.with_breakpoints(zeros_of_force(beam))
    factors = range_of_factors(beam)
    if factors is None:
        return Counted((), most or np.inf, 0, ())
    low, limit = factors[0], min(factors[1], greatest_in_shear(beam), most or np.inf)
    search = _Search(beam, backend, min(low, limit / 2), limit)
    first = search.below(search.low)
    start = [_at_once(search, k, first) for k in range(min(first, search.rotations))]
    unstable = first - len(start)
    wanted = _MOST if most else max(_ENOUGH - len(start), 1)
    reach = limit if most else search.reach(first + wanted)
    number = search.below(reach) - first
    if number > wanted and most:
        raise InputError(
            f"{number} modes diverge below the factor {reach:g}; at most {_MOST} are told: ask for "
            "a smaller range"
        )
    number = min(number, wanted)
    found, warnings = search.sharpened(first, number, tolerance) if number else ([], ())
    found = [*start, *found]
    if not most and found:
        positive = [each.load_factor for each in found if each.load_factor > 0]
        far = _FAR * positive[0] if positive else limit
        found = [each for each in found if each.load_factor <= far]
        whole = len(found) >= _ENOUGH
        reach = found[-1].bracket[1] if whole else min(far, limit)
    return Counted(tuple(found), reach, unstable, tuple(warnings))


class _Search:
    """Counts on the chains of one beam."""

    def __init__(self, beam: Beam, backend: Backend, low: float, limit: float) -> None:
        self.beam, self.backend, self.limit = beam, backend, limit
        self.hard = greatest_in_shear(beam)
        self.rigid = rigid_modes(beam, BENDING)
        self.rotations = int("rotation" in self.rigid)
        self.load = loading(beam, 1, "translation" in self.rigid)
        while low > 0 and self.below(low) > self.rotations and low > 1e-12 * limit:
            low /= 1e3
        self.low = low

    def below(self, factor: float) -> int:
        """Return how many eigenvalues are negative under a factor."""
        return statics(self.backend, self.load, factor)[0]

    def reach(self, number: int) -> float:
        """Return a factor under which so many are negative, or the largest one."""
        factor = self.low
        while factor < self.limit and self.below(factor) < number:
            factor = min(_GROWTH * factor, self.limit)
        return factor

    def name(self, index: int) -> str:
        """Return the name of the eigenvalue that is the index-th negative one."""
        turning = self.rotations and index == 0
        return "rigid rotation" if turning else f"{BENDING} {index + 1 - self.rotations}"

    def sharpened(
        self, first: int, number: int, tolerance: float
    ) -> tuple[list[CriticalLoad], tuple[str, ...]]:
        """Return the next critical loads, on chains fine enough."""
        varies = bool(np.any(self.beam.varies(BENDING)))
        levels, refinement = Refinement(tolerance / 2, coarse=WIDTH), 1
        warnings: tuple[str, ...] = ()
        guesses: list[float] = []
        while True:
            brackets = self._brackets(first, number, guesses)
            guesses = [root for _, _, root in brackets]
            loaded = self.load(guesses[-1])
            levels.add(np.array(guesses), layer_length(loaded, varying_segments(self.beam, loaded)))
            if not varies or levels.met(levels.error):
                break
            if 2 * len(loaded.length) > _MOST_SEGMENTS:
                warnings = (
                    f"{len(loaded.length)} segments do not reach the tolerance {tolerance:g}; see "
                    "the errors, or give the stations more smoothly",
                )
                break
            refinement *= 2
            self.load = loading(self.beam, refinement, "translation" in self.rigid)
        errors = levels.error if varies else np.zeros(number)
        values = levels.better if varies else np.array(guesses)
        rows = zip(brackets, values.tolist(), errors.tolist(), strict=True)
        return [self._critical(first + k, *row) for k, row in enumerate(rows)], warnings

    def _brackets(
        self, first: int, number: int, guesses: list[float]
    ) -> list[tuple[float, float, float]]:
        evaluate = partial(statics, self.backend, self.load)
        found: list[tuple[float, float, float]] = []
        for k in range(number):
            allowed = first + k
            low, high = self.low, self.hard
            if guesses:
                low, high = guesses[k] * (1 - _NEAR), guesses[k] * (1 + _NEAR)
            elif found:
                low = found[-1][0]
            while evaluate(low)[0] > allowed:
                low /= _GROWTH
            high = min(high if guesses else low * _GROWTH, self.hard)
            while evaluate(high)[0] <= allowed:
                if high == self.hard:
                    raise ComputationError(
                        f"{self.name(allowed)} diverges where the stiffness in shear is used up, "
                        f"or not at all; ask for a largest factor below {high:g}"
                    )
                high = min(high * _GROWTH, self.hard)
            found.append(narrow(evaluate, allowed, low, high, WIDTH))
        return found

    def _critical(
        self, index: int, bracket: tuple[float, float, float], value: float, error: float
    ) -> CriticalLoad:
        low, high, root = bracket
        rounding = value * rounding_of(self.backend, self.load(root))
        error = error + max(high - root, root - low) + rounding
        low, high = min(low, value - error), max(high, value + error)
        counts = self.below(low), self.below(high)
        return _divergence(self.name(index), value, error, (low, high), counts)


def _at_once(search: _Search, index: int, below: int) -> CriticalLoad:
    """Return the rotation that any factor at all makes diverge."""
    return _divergence(search.name(index), 0.0, 0.0, (0.0, search.low), (0, below))


def _divergence(
    name: str, value: float, error: float, bracket: tuple[float, float], counts: tuple[int, int]
) -> CriticalLoad:
    return CriticalLoad(
        kind="divergence",
        load_factor=value,
        bracket=bracket,
        error=error,
        frequency_hz=0.0,
        frequency_error_hz=0.0,
        omega2=0.0,
        modes=(name,),
        change="lost",
        certificate=Certificate("counts", counts),
    )
