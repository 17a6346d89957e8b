"""Eigenvalues of a chain under other end forces than those that were solved, from the ones known.

They lie near each other: changes of sign between the middles of what is known enclose them, and
counts, or turns about zero, prove that there are no others (`riccati.following_roots`). Where that
does not hold the answer says so; a full solve may still find them.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .arrays import Array
from .chain import Chain, evaluate
from .following_roots import Finder
from .roots import Eigenvalue

_SHARES = np.linspace(0.1, 0.9, 5)  # of the way to the next eigenvalue, where a gap is looked for


class Neighbours(NamedTuple):
    """Elastic eigenvalues, as many as were known."""

    eigenvalues: list[Eigenvalue]
    """Empty where they were not all enclosed."""
    proven: bool


def neighbours(chain: Chain, known: Array, rigid: int, zeros: int, width: float) -> Neighbours:
    """Return the elastic eigenvalues of a chain near those under other end forces.

    Parameters
    ----------
    chain : Chain
    known : array, shape (n,)
        Positive, ascending [rad^2/s^2].
    rigid, zeros : int
        Eigenvalues below them, and how many of these are exactly zero.
    width : float
        Relative width of brackets in omega^2.
    """
    finder = Finder(chain, lambda _: [], zeros, width)
    x = known**0.25
    step = x[-1] - x[-2] if len(x) > 1 else x[-1]
    edges = np.concatenate([[0.6 * x[0]], (x[1:] + x[:-1]) / 2, [x[-1] + step / 2]]) ** 4
    values = finder.divided(edges)
    if not np.all(values[1:] * values[:-1] < 0):
        return Neighbours([], False)
    rows = zip(edges[:-1], edges[1:], values[:-1], values[1:], strict=True)
    found = finder.shrink([(float(a), float(b), float(c), float(d)) for a, b, c, d in rows])
    proven = _is_complete(finder, chain, found, rigid, float(edges[0]), step)
    return Neighbours(found, proven)


def _is_complete(
    finder: Finder, chain: Chain, found: list[Eigenvalue], rigid: int, start: float, step: float
) -> bool:
    """Tell whether so many rigid eigenvalues, and those found, are all below a line above them."""
    top, number = found[-1].omega2, rigid + len(found)
    places = (top**0.25 + step * _SHARES) ** 4
    counts = evaluate(chain.fixed, np.concatenate([places, [start, -top]])).below
    if not chain.follows:
        return bool(counts[-2] == rigid and np.any(counts[:-2] == number))
    inside = np.flatnonzero(counts[:-2] == number)
    if counts[-1] != 0 or len(inside) < 2 or np.any(np.diff(inside) != 1):
        return False
    low, high = places[inside[0]], places[inside[-1]]
    turns = finder.turns(float((low + high) / 2), float(low), float(high), -top)
    ends = finder.following.values(np.array([-top, start]))
    even = rigid % 2 == 0  # of rigid ones, all below the others
    return bool(turns.proven and turns.number == 0 and (ends[0] * ends[1] > 0) == even)
