"""Peaks of responses: found by what resonates, bracketed, never sampled past.

Every resonance in the band is known beforehand (`modal.basis`), so that the first grid has points
on both sides of each. A peak lies between two frequencies whose responses are smaller than one
between them; the bracket is then cut by five until it is narrow.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from antinode.arrays import Array

_CUT = 9  # points inside a bracket; two of the ten parts remain
_ROUNDS = 9
_ALIKE = 1e-6  # share of a bracket nearer than which two places are one
_NARROW = 1e-8  # relative width at which a bracket is as narrow as the response can tell
_BESIDE = np.array([-4.0, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 4.0])


class Peak(NamedTuple):
    """A largest response among its neighbours.

    Attributes
    ----------
    frequency_hz : float
    bracket_hz : tuple of float
        Between them lies the peak of the chain's response [Hz].
    size : float
        Modulus of the response, in its unit.
    """

    frequency_hz: float
    bracket_hz: tuple[float, float]
    size: float

    def to_dict(self) -> dict[str, Any]:
        """Return it as plain numbers."""
        return {
            "frequency_hz": self.frequency_hz,
            "bracket_hz": list(self.bracket_hz),
            "magnitude": self.size,
        }


def with_resonances(frequency_hz: Array, resonance_hz: Array, ratio: Array) -> Array:
    """Return frequencies with some beside every resonance inside their band, sorted.

    Parameters
    ----------
    frequency_hz : array, shape (k,)
        Increasing.
    resonance_hz, ratio : array, shape (n,)
        Natural frequencies and damping ratios.
    """
    low, high = frequency_hz[0], frequency_hz[-1]
    width = np.maximum(ratio, 1e-7) * resonance_hz
    beside = (resonance_hz[:, None] + width[:, None] * _BESIDE).ravel()
    inside = beside[(beside > low) & (beside < high)]
    return np.unique(np.concatenate([frequency_hz, inside]))


def find_peaks(
    sizes: Callable[[Array], Array], frequency_hz: Array, known: Array
) -> list[list[Peak]]:
    """Return the peaks of several responses inside a band, each in order of frequency.

    Parameters
    ----------
    sizes : callable
        Moduli of the responses at frequencies, shape (responses, k).
    frequency_hz : array, shape (k,)
        First grid, increasing.
    known : array, shape (responses, k)
        Moduli there.
    """
    inner = (known[:, 1:-1] > known[:, :-2]) & (known[:, 1:-1] >= known[:, 2:])
    which, at = np.nonzero(inner)
    middle = frequency_hz[at + 1]
    low, high, height = frequency_hz[at], frequency_hz[at + 2], known[which, at + 1]
    for _ in range(_ROUNDS):
        if not len(which) or np.all(high - low <= _NARROW * middle):
            break
        share = np.arange(1, _CUT + 1) / (_CUT + 1)
        inside = low[:, None] + (high - low)[:, None] * share
        rows = np.concatenate([low[:, None], inside, high[:, None], middle[:, None]], axis=1)
        rows.sort(axis=1)
        places, back = np.unique(rows, return_inverse=True)
        values = sizes(places)[which[:, None], back.reshape(rows.shape)]
        best = np.argmax(values, axis=1).clip(1, rows.shape[1] - 2)
        row = np.arange(len(which))
        middle, height = rows[row, best], values[row, best]
        low, high = _beside(rows, middle, _ALIKE * (high - low))
    found: list[list[Peak]] = [[] for _ in known]
    for k in np.lexsort((middle, which)):
        bracket = float(low[k]), float(high[k])
        found[which[k]].append(Peak(float(middle[k]), bracket, float(height[k])))
    return found


def _beside(rows: Array, middle: Array, gap: Array) -> tuple[Array, Array]:
    """Return the places of each row next to one of them, but for itself met twice."""
    before, after = rows < (middle - gap)[:, None], rows > (middle + gap)[:, None]
    low = np.max(np.where(before, rows, rows[:, :1]), axis=1)
    return low, np.min(np.where(after, rows, rows[:, -1:]), axis=1)
