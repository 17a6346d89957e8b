"""Bending frequencies against one input: a curve that grows finer while one looks at it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from antinode.arrays import Array
from antinode.errors import AntinodeError

from .compute import wanted_modes
from .inputs import Input
from .quick import quick_omega2
from .state import State

_LEVELS = 4  # 5, 9, 17, 33 points


@dataclass(frozen=True)
class Curve:
    """Frequencies of the bending modes along the range of one input.

    Parameters
    ----------
    key : str
        What the curve depends on: the state without this input.
    path : str
        The input.
    values : array, shape (points,)
        Increasing [SI].
    omega2 : array, shape (points, modes)
        [rad^2/s^2]; NaN where there is no answer.
    """

    key: str
    path: str
    values: Array
    omega2: Array

    def with_points(self, values: Array, omega2: Array) -> Curve:
        """Return the curve with further points."""
        order = np.argsort(both := np.concatenate([self.values, values]))
        rows = np.concatenate([self.omega2, omega2])
        return replace(self, values=both[order], omega2=rows[order])


def curve_key(state: State, item: Input) -> str:
    """Return what a curve depends on: everything but the input that runs."""
    rest = {path: value for path, value in state.changes.items() if path != item.path}
    return f"{replace(state, changes=rest).key} {item.path} {item.low:g} {item.high:g}"


def grow_curve(state: State, item: Input) -> Iterator[Curve]:
    """Yield ever finer curves of the frequencies against an input, to be stopped at any time."""
    modes = wanted_modes(state.problem)
    key = curve_key(state, item)
    curve = Curve(key, item.path, np.empty(0), np.empty((0, modes)))
    for level in range(_LEVELS):
        curve = curve.with_points(*_solved(state, item, _places(item, level), modes))
        yield curve


def _places(item: Input, level: int) -> Array:
    """Return the places that a level adds, halfway between those before."""
    count = 4 * 2**level
    steps = np.arange(count + 1) if level == 0 else np.arange(1, count, 2)
    return np.asarray(item.low + (item.high - item.low) * steps / count)


def _solved(state: State, item: Input, values: Array, modes: int) -> tuple[Array, Array]:
    omega2 = np.full((len(values), modes), np.nan)
    for row, value in enumerate(values.tolist()):
        try:
            beam = state.changed({item.path: value}).beam
            omega2[row] = quick_omega2(beam, modes)
        except AntinodeError:
            continue  # a gap: the input is not allowed there
    return values, omega2
