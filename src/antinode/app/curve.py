"""Bending frequencies against one input: five points while something moves, then a finer curve.

Cases of a vehicle are solved side by side, the fine curve in one go. Others are solved one by one,
and the curve grows finer while one looks at it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from antinode.arrays import Array
from antinode.errors import AntinodeError
from antinode.vehicle.case import Case

from .compute import wanted_modes
from .inputs import Input
from .quick import fits_side_by_side, quick_cases, quick_omega2
from .state import State

COARSE, FINE = 5, 33
"""Points of a curve while something moves, and in the end."""


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


def grow_curve(state: State, item: Input, known: Curve | None = None) -> Iterator[Curve]:
    """Yield ever finer curves of the frequencies against an input, to be stopped at any time.

    The first is coarse, or finer than one that is known.
    """
    modes = wanted_modes(state.problem)
    curve = known or Curve(curve_key(state, item), item.path, np.empty(0), np.empty((0, modes)))
    keys = tuple(int(key) if key.isdigit() else key for key in item.path.split("."))
    case = state.problem if isinstance(state.problem, Case) else None
    case = case if case and fits_side_by_side(case, keys) else None
    while (have := len(curve.values)) < FINE:
        values = _places(item, have, COARSE if not have else FINE if case else 2 * have - 1)
        omega2, alone = np.full((len(values), modes), np.nan), np.arange(len(values))
        if case:
            omega2, alone = quick_cases(case, keys, values, modes)
        for row in alone.tolist():
            omega2[row] = _solved(state.changed({item.path: float(values[row])}), modes)
        curve = curve.with_points(values, omega2)
        yield curve


def _places(item: Input, have: int, wanted: int) -> Array:
    """Return the places between those that there are, all of them evenly spaced."""
    count = wanted - 1
    new = [k for k in range(wanted) if not have or k * (have - 1) % count]
    return np.asarray(item.low + (item.high - item.low) * np.array(new) / count)


def _solved(state: State, modes: int) -> Array:
    """Return omega^2 of a case by itself; a gap where the input is not allowed."""
    try:
        return quick_omega2(state.beam, modes)
    except AntinodeError:
        return np.full(modes, np.nan)
