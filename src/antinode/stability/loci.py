"""Root loci: the eigenvalues of a beam along a factor on its axial forces.

In s, where the motion goes as ``exp(s t)`` and ``omega^2 = -s^2``: a stable mode stands on the
imaginary axis, one that diverges on the real one, and one that flutters off both, with a twin that
decays. Of each the frequency abs(Im s)/(2 pi) and the growth Re s are given.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from antinode.arguments import whole
from antinode.arrays import Array
from antinode.beam.beam import Beam
from antinode.beam.families import BENDING
from antinode.beam.limits import out_of_range_is_an_error
from antinode.modes.backends import choose, for_one
from antinode.modes.solve import HasBeam

from .crossing import Root
from .result import Stability
from .stability import EVALUATIONS
from .states import State, Watcher

_BEYOND = 1.15  # of the last critical load, that loci reach to
_NEAR = np.array([-1e-2, -1e-3, -1e-5, 1e-5, 1e-3, 1e-2])  # of a critical load, looked at as well
_UNKNOWN = 1.0  # largest factor where nothing is critical and the range has no end


@dataclass(frozen=True)
class Mark:
    """A change of stability on the axis: where, `kind`, `change` and the modes that it is of."""

    value: float
    kind: str
    change: str
    modes: tuple[str, ...]


@dataclass(frozen=True)
class Loci:
    """Eigenvalues along a factor, or along an input.

    Attributes
    ----------
    factor : array, shape (factors,)
    frequency_hz, growth_per_s : array, shape (factors, modes)
        By rising frequency, then falling growth; rigid modes that are always at zero are left out.
    names : tuple of str
        Of the modes, as they are numbered before the first flutter.
    marks : tuple of Mark
        Changes of stability.
    label : str
        What stands along the axis.
    """

    factor: Array
    frequency_hz: Array
    growth_per_s: Array
    names: tuple[str, ...]
    marks: tuple[Mark, ...]
    label: str = "factor on all axial forces"


@out_of_range_is_an_error()
def root_loci(
    problem: Beam | HasBeam, found: Stability, *, modes: int = 4, points: int = 60
) -> Loci:
    """Follow the lowest modes along the factor, some way past the last critical load.

    Parameters
    ----------
    problem : Beam or case
    found : Stability
        Its critical loads.
    modes : int
        Elastic modes, 1 to 30.
    points : int
        Factors, evenly spaced; some more stand beside each critical load.
    """
    beam = problem if isinstance(problem, Beam) else problem.beam()
    modes, points = whole("modes", modes, 30), whole("points", points, 2000)
    segments = len(beam.chain(BENDING).length)
    watcher = Watcher(beam, choose(for_one(segments, EVALUATIONS)), 1, modes)
    factor = _factors(found, points)
    states = [watcher.at(each) for each in factor]
    number = min(modes + len(watcher.rigid) - watcher.zeros, *map(_size, states))
    rows = np.array([_rows(state, number) for state in states])
    frequency, growth = rows[:, :, 0], rows[:, :, 1]
    marks = (Mark(c.load_factor, c.kind, c.change, c.modes) for c in found.critical)
    return Loci(factor, frequency, growth, watcher.names[:number], tuple(marks))


def _factors(found: Stability, points: int) -> Array:
    critical = [each.load_factor for each in found.critical if each.load_factor > 0]
    last = _BEYOND * critical[-1] if critical else found.range[1]
    last = last if np.isfinite(last) else _UNKNOWN
    near = [factor * (1 + share) for factor in critical for share in _NEAR]
    return np.unique(np.concatenate([np.linspace(0.0, last, points), near]))


def _size(state: State) -> int:
    return len(state.real) + 2 * len(state.pairs)


def _rows(state: State, number: int) -> list[tuple[float, float]]:
    """Return frequency [Hz] and growth [1/s] of the lowest modes: both of a pair."""
    real = [(np.sqrt(max(v, 0.0)), np.sqrt(max(-v, 0.0))) for v in state.real.tolist()]
    for value in state.pairs.tolist():
        s = np.sqrt(-value)
        real += [(abs(s.imag), sign * abs(s.real)) for sign in (-1.0, 1.0)]
    rows = sorted((omega / (2 * np.pi), -growth) for omega, growth in real)
    return [(float(f), float(-g)) for f, g in rows[:number]]


def rows_of_roots(roots: Sequence[Sequence[Root]], number: int) -> tuple[Array, Array]:
    """Return frequency [Hz] and growth [1/s] of the lowest eigenvalues in many lists.

    Of shape (lists, number), NaN where there are fewer. Two that stand on the real axis are one
    motion that does not oscillate: the one that grows more, or decays less, is told.
    """
    frequency = np.full((len(roots), number), np.nan)
    growth = frequency.copy()
    for k, row in enumerate(roots):
        still = sorted((r.s.real for r in row if not r.s.imag), reverse=True)
        motions = max(-(-len(still) // 2), sum(s > 0 for s in still))
        told = [(0.0, s) for s in still[:motions]]
        told += sorted(((abs(r.s.imag), r.s.real) for r in row if r.s.imag), key=lambda z: z[0])
        for i, (omega, rate) in enumerate(told[:number]):
            frequency[k, i], growth[k, i] = omega / (2 * np.pi), rate
    return frequency, growth
