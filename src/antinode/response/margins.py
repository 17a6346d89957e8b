"""The smallest distance of a response below an allowed curve, between samples as well.

Over x = ln f the distance is smooth but at kinks of the curves, which are samples. Samples lie ever
closer toward a resonance; then intervals are halved in which a parabola, of twice the curvature
that is seen, could come nearer than the nearest sample does. What is left of that is an error.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from antinode.arrays import Array, Numbers

_GRADED = 0.25  # of the distance to a resonance, the longest interval near the smallest margin
_COARSE = 1.0  # the same anywhere
_NEAR = 2.0  # nepers from the smallest margin within which intervals are graded so
_LEAST_RATIO = 1e-7  # of a resonance without damping
_SAFETY = 2.0  # of the curvature that samples show
_ROUNDS = 60
_ONE = 1e-12  # relative distance of two samples that are one
_MOST = 50_000


class Margin(NamedTuple):
    """A margin, and between what the true one lies [dB]; infinite where nothing is felt.

    Attributes
    ----------
    value, least, most : float
    at : int
        Of which sample.
    """

    value: float
    least: float
    most: float
    at: int


def samples_for(
    excess: Callable[[Array], Array],
    frequency_hz: Array,
    resonance_hz: Array,
    ratio: Array,
    settled: float = 1e-6,
) -> tuple[Array, float]:
    """Return frequencies among which the largest excess is, and by how much more one may be missed.

    Parameters
    ----------
    excess : callable
        ln of what is felt over what is allowed, at frequencies [Hz].
    frequency_hz : array, shape (k,)
        Increasing; with every kink.
    resonance_hz, ratio : array, shape (n,)
        Natural frequencies and damping ratios.
    settled : float
        Nepers that may be missed.

    Returns
    -------
    frequency_hz : array
        Those and more.
    missed : float
        In nepers.
    """
    f = frequency_hz[np.diff(np.log(frequency_hz), prepend=-np.inf) > _ONE]
    g = excess(f)
    for _ in range(_ROUNDS):
        split, missed = _unsettled(np.log(f), g, np.log(resonance_hz), ratio, settled)
        if not np.any(split) or len(f) > _MOST:
            break
        middle = np.sqrt(f[:-1] * f[1:])[split]
        middle = middle[(middle > f[:-1][split]) & (middle < f[1:][split])]
        if not len(middle):
            break
        order = np.argsort(np.concatenate([f, middle]), kind="stable")
        f = np.concatenate([f, middle])[order]
        g = np.concatenate([g, excess(middle)])[order]
    return f, missed


def _unsettled(
    x: Array, g: Array, resonance: Array, ratio: Array, settled: float
) -> tuple[Numbers, float]:
    """Return which intervals must be halved, and how much larger an excess may be between."""
    h = np.maximum(np.diff(x), _ONE)
    if not len(h):
        return np.zeros(0, dtype=bool), 0.0
    ends, best = np.maximum(g[:-1], g[1:]), np.max(g)
    slope = np.diff(g) / h
    bent = np.zeros(len(x))
    bent[1:-1] = np.maximum(2 * (slope[:-1] - slope[1:]) / (h[:-1] + h[1:]), 0.0)
    bent[[0, -1]] = bent[[1, -2]] if len(x) > 2 else 0.0
    over = ends + _SAFETY * np.maximum(bent[:-1], bent[1:]) * h**2 / 8 - best
    graded = h / _to_resonance((x[:-1] + x[1:]) / 2, resonance, ratio)
    split = (over > settled) | (graded > _COARSE)
    split |= (graded > _GRADED) & (ends > best - _NEAR)
    short = h <= 10 * _ONE  # a sample itself
    split, over = split & ~short, np.where(short, 0.0, over)
    return split, float(max(np.max(over), 0.0))


def _to_resonance(x: Array, resonance: Array, ratio: Array) -> Array:
    """Return how far places are from the nearest resonance, no less than its width; 1 at most."""
    if not len(resonance):
        return np.ones(len(x))
    far = np.maximum(np.abs(x[:, None] - resonance), np.maximum(ratio, _LEAST_RATIO))
    return np.asarray(np.minimum(np.min(far, axis=1), 1.0))


def margin_of(
    allowed: Array, felt: Array, wrong: Array, floor: float, missed: float, decibel: float
) -> Margin:
    """Return the smallest margin of samples [dB], and what it is at least and at most.

    Parameters
    ----------
    allowed, felt, wrong : array, shape (k,)
        What may be felt, what is, and how wrong that may be.
    floor : float
        Below which nobody looked between samples.
    missed : float
        Nepers by which it may be less between samples.
    decibel : float
        10 for what goes with power, 20 for amplitudes.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        value = decibel * np.log10(allowed / felt)
        least = decibel * np.log10(allowed / (np.maximum(felt, floor) + wrong))
        most = decibel * np.log10(allowed / np.maximum(felt - wrong, 0.0))
    at = int(np.argmin(value))
    least_of = float(np.min(least)) - decibel / np.log(10.0) * missed
    return Margin(float(value[at]), least_of, float(np.min(most)), at)
