"""Eigenvalues of a free chain under other end forces than those whose eigenvalues are known.

What turns with an end changes no segment: several choices of it are evaluated side by side, in as
many lanes. Eight samples between the middles of what is known tell where the sign changes, a
polynomial through six of them where within; counts and turns about zero prove that none is missing.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from antinode.riccati.arrays import Array, Integers
from antinode.riccati.chain import Chain, evaluate
from antinode.riccati.roots import Eigenvalue

from .ratio import Following, Kept, values_under
from .roots import Bracket, shrink, turns_along

_SHARES = np.linspace(0.1, 0.9, 5)  # of the way to the next eigenvalue, where a gap is looked for
_PARTS = 8  # between the middles of what is known
_NEAREST = np.arange(-2, 4)  # samples about a change of sign that tell where it lies
_BESIDE = np.array([-1.0, -0.03, 0.03, 1.0])  # of what is uncertain there


class Neighbours(NamedTuple):
    """Elastic eigenvalues, as many as were known."""

    eigenvalues: list[Eigenvalue]
    """Empty where they were not all enclosed."""
    proven: bool


def neighbours(
    chain: Chain, choices: Array, known: Array, rigid: int, width: float
) -> list[Neighbours]:
    """Return the elastic eigenvalues of a free chain near those known, under other end forces.

    All choices go side by side. Changes of sign between the middles of what is known enclose them;
    counts, or turns about zero, prove that there are no others. Where that does not hold the answer
    says so.

    Parameters
    ----------
    chain : Chain
        Free at both ends.
    choices : array, shape (c, 2)
        The part of the forces at both ends that turns with them [N].
    known : array, shape (n,)
        Positive, ascending [rad^2/s^2].
    rigid : int
        Eigenvalues below them.
    width : float
        Relative width of brackets in omega^2.
    """
    x = known**0.25
    step = x[-1] - x[-2] if len(x) > 1 else x[-1]
    edges = np.concatenate([[0.6 * x[0]], (x[1:] + x[:-1]) / 2, [x[-1] + step / 2]])
    number = _PARTS * len(known)
    places = np.interp(np.arange(number + 1) / _PARTS, np.arange(len(edges)), edges)
    at = np.append(places**4, -(places[-1] ** 4))
    which = np.repeat(np.arange(len(choices)), len(at))
    sampled = values_under(chain, np.tile(at, len(choices)), choices, which)
    sampled = sampled.reshape(len(choices), -1)
    changes = [_one_in_each(row[:-1]) for row in sampled]
    good = [k for k, rows in enumerate(changes) if rows is not None]
    if not good:
        return [Neighbours([], False)] * len(choices)
    rows = np.concatenate([changes[k] for k in good])
    owner = np.repeat(np.array(good), len(known))

    def values(where: Array, bracket: Integers) -> Array:
        return values_under(chain, where, choices, owner[bracket])

    brackets = _narrowed(places, sampled[owner, :-1], rows, values)
    found = shrink(brackets, values, width)
    own = {k: found[i * len(known) :][: len(known)] for i, k in enumerate(good)}
    even = sampled[:, 0] * sampled[:, -1] > 0
    return _proven(chain, choices, own, rigid, even, step, float(at[0]))


def _one_in_each(values: Array) -> Integers | None:
    """Return where the one change of sign of every part lies; None if there are not as many."""
    changes = np.flatnonzero(values[1:] * values[:-1] <= 0)
    parts = np.arange((len(values) - 1) // _PARTS)
    return changes if np.array_equal(changes // _PARTS, parts) else None


def _narrowed(
    places: Array, sampled: Array, rows: Integers, values: Callable[[Array, Integers], Array]
) -> list[Bracket]:
    """Return brackets about the changes of sign, by polynomials through the samples next to them.

    Parameters
    ----------
    places : array, shape (k,)
        omega^2 to the power 1/4.
    sampled : array, shape (b, k)
        Values at the places, of each bracket.
    rows : array of int, shape (b,)
        The samples before the changes.
    """
    of = np.arange(len(rows))
    low, high = places[rows], places[rows + 1]
    index = rows[:, None] + _NEAREST
    index -= np.maximum(index[:, -1:] - len(places) + 1, 0) + np.minimum(index[:, :1], 0)
    t = (places[index] - low[:, None]) / (high - low)[:, None]
    y = sampled[of[:, None], index]
    a, b = sampled[of, rows], sampled[of, rows + 1]
    root, rough = _root_of_polynomial(t, y), _root_of_polynomial(t[:, 1:5], y[:, 1:5])
    doubt = np.maximum(np.abs(root - rough), 1e-9)
    beside = np.clip(root[:, None] + doubt[:, None] * _BESIDE, 0.0, 1.0)
    near = (low[:, None] + (high - low)[:, None] * beside) ** 4
    y = values(near.ravel(), np.repeat(of, len(_BESIDE))).reshape(near.shape)
    ends = np.column_stack([low**4, near, high**4]), np.column_stack([a, y, b])
    first = np.argmax(ends[1][:, 1:] * ends[1][:, :-1] <= 0, axis=1)
    pairs = [(e[of, first].tolist(), e[of, first + 1].tolist()) for e in ends]
    return list(zip(*pairs[0], *pairs[1], strict=True))


def _root_of_polynomial(t: Array, y: Array) -> Array:
    """Return where polynomials through values at t vanish between 0 and 1, shape (b,)."""
    power = np.arange(t.shape[1])
    scale = np.max(np.abs(y), axis=1, keepdims=True)
    of = np.linalg.solve(t[..., None] ** power, (y / scale)[..., None])[..., 0]

    def value(at: Array) -> Array:
        return np.asarray(np.sum(of * at[:, None] ** power, axis=1))

    at = y[:, 0] * 0.0 + 0.5
    for _ in range(8):
        slope = np.sum((of * power)[:, 1:] * at[:, None] ** power[:-1], axis=1)
        at = np.clip(at - value(at) / slope, 0.0, 1.0)
    return np.asarray(at)


def _proven(
    chain: Chain,
    choices: Array,
    found: dict[int, list[Eigenvalue]],
    rigid: int,
    even: npt.NDArray[np.bool_],
    step: float,
    start: float,
) -> list[Neighbours]:
    """Tell of each choice whether the rigid eigenvalues and those found are all below a line."""
    number = rigid + len(next(iter(found.values())))
    top = max(values[-1].omega2 for values in found.values())
    places = (top**0.25 + step * _SHARES) ** 4
    counts = evaluate(chain.fixed, np.concatenate([places, [start, -top]])).below
    inside, kept = np.flatnonzero(counts[:-2] == number), Kept()
    listed = []
    for k, forces in enumerate(choices):
        own = found.get(k, [])
        if not forces.any():
            proven = bool(own) and bool(counts[-2] == rigid and len(inside))
        else:
            proven = bool(own) and counts[-1] == 0 and len(inside) > 1
            proven = proven and bool(np.all(np.diff(inside) == 1))
            low, high = (float(places[inside[j]]) for j in (0, -1)) if proven else (0.0, 0.0)
            following = Following(replace(chain, following=(forces[0], forces[1])), kept)
            turns = turns_along(following, (low + high) / 2, low, high, -top) if proven else None
            proven = turns is not None and turns.proven and turns.number == 0
            proven = proven and bool(even[k] == (rigid % 2 == 0))  # all below the others
        listed.append(Neighbours(own, proven))
    return listed
