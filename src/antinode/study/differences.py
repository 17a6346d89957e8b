"""Derivatives by differences of fourth order, at a bound on one side.

``f' = (8 (f(h) - f(-h)) - (f(2 h) - f(-2 h))) / (12 h)``
"""

from __future__ import annotations

import numpy as np

from antinode.arrays import Array

_STEP = 2e-3  # of a value's size
_CENTRAL = np.array([-2.0, -1.0, 1.0, 2.0]), np.array([1.0, -8.0, 8.0, -1.0, 0.0]) / 12
_FORWARD = np.array([1.0, 2.0, 3.0, 4.0]), np.array([48.0, -36.0, 16.0, -3.0, -25.0]) / 12
"""Places in steps, and weights of what is found there and, last, at the value itself."""


def rule(size: float, below: float, above: float) -> tuple[Array, Array]:
    """Return how far a value is moved, and the weights of what is found there.

    Parameters
    ----------
    size : float
        Of the value: the derivative is one over two thousandths of it.
    below, above : float
        How far it may go down and up.

    Returns
    -------
    places : array, shape (4,)
    weights : array, shape (5,)
        The last is that of the value itself.
    """
    (places, weights), room = (
        (_CENTRAL, min(below, above) / 3) if min(below, above) > 0 else (_FORWARD, above / 5)
    )
    if room <= 0 < below:
        (places, weights), room = (-_FORWARD[0], -_FORWARD[1]), below / 5
    step = min(_STEP * size, room)
    return places * step, weights / step
