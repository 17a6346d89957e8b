"""A root between two counts: the bracket of a function that counts eigenvalues and has a sign.

For functions that are evaluated one by one, such as the statics of a chain under a factor on its
axial force; many omega^2 at once are `riccati.roots`.
"""

from __future__ import annotations

import math
from collections.abc import Callable

Sample = tuple[int, float]
"""How many eigenvalues are negative, and the determinant, bounded and without poles."""

_MOST = 300


def narrow(
    evaluate: Callable[[float], Sample], allowed: int, low: float, high: float, width: float
) -> tuple[float, float, float]:
    """Return the two ends of a bracket of relative `width`, and the root between them.

    Parameters
    ----------
    evaluate : callable
    allowed : int
        At `low` not more eigenvalues are negative, at `high` more are; both positive.
    """
    below, above = evaluate(low), evaluate(high)
    weights = 1.0, 1.0
    for turn in range(_MOST):
        if high - low <= width * high:
            break
        x = _next(low, high, below, above, weights, width, by_halves=turn % 4 == 3)
        found = evaluate(x)
        if found[0] > allowed:
            weights = (weights[0] / 2 if x - low > 0.5 * (high - low) else 1.0), 1.0
            high, above = x, found
        else:
            weights = 1.0, (weights[1] / 2 if high - x > 0.5 * (high - low) else 1.0)
            low, below = x, found
    root = _secant(low, high, below[1], above[1])
    return low, high, (low + high) / 2 if root is None else root


def _secant(low: float, high: float, below: float, above: float) -> float | None:
    return low - below * (high - low) / (above - below) if below * above < 0 else None


def _next(
    low: float,
    high: float,
    below: Sample,
    above: Sample,
    weights: tuple[float, float],
    width: float,
    by_halves: bool,
) -> float:
    """Return where to evaluate next: regula falsi between the ends, or the middle.

    A step stays a share of the width away from either end, so that the bracket closes from both.
    """
    middle = math.sqrt(low * high) if high > 2 * low else (low + high) / 2
    x = _secant(low, high, below[1] * weights[0], above[1] * weights[1])
    if x is None or by_halves or above[0] - below[0] != 1:
        return middle
    least = 0.4 * width * high
    return min(max(x, low + least), high - least)
