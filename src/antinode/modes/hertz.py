"""Frequencies [Hz] of eigenvalues omega^2 [rad^2/s^2], and what an error of omega^2 makes of them.

    f = sqrt(omega^2) / (2 pi)

Where omega^2 < 0 the motion grows instead of vibrating: there is no frequency, and `hertz` is NaN.
What is below zero by no more than its own error is `settled` as 0.
A fit that runs through buckling needs a number on either side of zero: `signed_hertz` is there
minus the growth rate over 2 pi.
"""

from __future__ import annotations

import math
from typing import Any, overload

import numpy as np

from antinode.arrays import Array


@overload
def hertz(omega2: float) -> float: ...
@overload
def hertz(omega2: Array) -> Array: ...
def hertz(omega2: float | Array) -> float | Array:
    """Return the frequencies [Hz] that belong to omega^2 [rad^2/s^2]; NaN where negative."""
    if isinstance(omega2, float | int):
        return math.sqrt(omega2) / (2 * math.pi) if omega2 >= 0 else math.nan
    return np.asarray(np.sqrt(np.where(omega2 >= 0, omega2, np.nan)) / (2 * np.pi))


@overload
def growth_rate(omega2: float) -> float: ...
@overload
def growth_rate(omega2: Array) -> Array: ...
def growth_rate(omega2: float | Array) -> float | Array:
    """Return the rate [1/s] at which a divergent motion grows; NaN for omega^2 >= 0."""
    if isinstance(omega2, float | int):
        return math.sqrt(-omega2) if omega2 < 0 else math.nan
    return np.asarray(np.sqrt(np.where(omega2 < 0, -omega2, np.nan)))


@overload
def error_hz(omega2: float, error: float) -> float: ...
@overload
def error_hz(omega2: Array, error: Array) -> Array: ...
def error_hz(omega2: float | Array, error: float | Array) -> float | Array:
    """Return how far f may be from `hertz` if omega^2 is within `error`; NaN where divergent."""
    if isinstance(omega2, float | int):
        return error_of_root(omega2, float(error)) / (2 * math.pi) if omega2 >= 0 else math.nan
    square = np.where(omega2 >= 0, omega2, np.nan)
    root, upper = np.sqrt(square), np.sqrt(square + error)
    with np.errstate(invalid="ignore", divide="ignore"):
        below = np.where(error < square, error / (root + np.sqrt(square - error)), root)
        off = np.maximum(below, error / (root + upper))
    return np.asarray(np.where(error == 0.0, square * 0.0, off) / (2 * np.pi))


def error_of_root(square: float, error: float) -> float:
    """Return the largest distance of sqrt(square +- error) from sqrt(square), square >= 0."""
    if not error or math.isnan(error):
        return error
    root = math.sqrt(square)
    below = error / (root + math.sqrt(square - error)) if error < square else root
    return max(below, error / (root + math.sqrt(square + error)))


@overload
def settled(omega2: float, error: float) -> tuple[float, float]: ...
@overload
def settled(omega2: Array, error: Array) -> tuple[Array, Array]: ...
def settled(omega2: float | Array, error: float | Array) -> tuple[Any, Any]:
    """Return omega^2 and its error: 0 where it is below zero by no more than its error.

    Nobody can tell from such a value that a motion grows. The interval that holds the true one
    stays inside that of the new error.
    """
    if isinstance(omega2, float | int):
        return (0.0, error - omega2) if 0 > omega2 >= -error else (omega2, error)
    below: Any = omega2 < 0
    if not np.count_nonzero(below):
        return omega2, error
    unknown = below & (omega2 >= -error)
    return np.where(unknown, 0.0, omega2), np.where(unknown, error - omega2, error)


def signed_hertz(omega2: Array) -> Array:
    """Return frequencies [Hz] with the sign of omega^2 [rad^2/s^2]."""
    return np.asarray(np.sign(omega2) * np.sqrt(np.abs(omega2)) / (2 * np.pi))


def signed_hertz_slope(omega2: Array) -> Array:
    """Return the derivative of `signed_hertz` by omega^2 [Hz s^2/rad^2]."""
    size = np.sqrt(np.maximum(np.abs(omega2), np.finfo(float).tiny))
    return np.asarray(1 / (4 * np.pi * size))
