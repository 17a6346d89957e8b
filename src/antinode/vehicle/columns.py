"""Columns of a vehicle's stations: named, read, replaced, interpolated, and by their rows."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from antinode.arrays import Array, Interpolation
from antinode.beam.mass import moments_within
from antinode.errors import InputError
from antinode.text import nearest, short

from .numbers import Keys
from .vehicle import Stations

_MASS = "mass_per_length"
_PLAIN = (
    "bending_stiffness",
    "axial_stiffness",
    "radius",
    "torsional_stiffness",
    "polar_inertia_per_length",
    "shear_stiffness",
    "rotary_inertia_per_length",
)


def column_keys(stations: Stations, name: str) -> Keys:
    """Return the keys from the stations to a column.

    Raises
    ------
    InputError
        If there is no such column, or it cannot be a parameter.
    """
    base, _, state = name.partition(":")
    states = list(stations.mass_per_length)
    if base == _MASS:
        state = state or states[0]
        if state in states:
            return base, state
    elif name in _PLAIN and getattr(stations, name) is not None:
        return (name,)
    known = [*(f"{_MASS}:{s}" for s in states[1:]), _MASS]
    known += [column for column in _PLAIN if getattr(stations, column) is not None]
    raise InputError(f"distributions: column = {short(name)}; {nearest(name, known)}")


def column_values(stations: Stations, keys: Keys) -> Array:
    """Return the column that keys lead to."""
    column = getattr(stations, str(keys[0]))
    return np.asarray(column[keys[1]] if len(keys) > 1 else column)


def interpolation_matrix(points: Array, x: Array, how: str) -> Array:
    """Return W with ``W @ values`` the interpolation at `x`; constant outside the points."""
    if how == "" or len(points) == 1:
        return np.eye(len(x)) if how == "" else np.ones((len(x), 1))
    inside = np.clip(x, points[0], points[-1])
    if how == "cubic" and len(points) > 2:
        from scipy.interpolate import CubicSpline

        return np.asarray(CubicSpline(points, np.eye(len(points)), bc_type="natural")(inside))
    unit = np.eye(len(points))
    return np.stack([np.interp(inside, points, row) for row in unit], axis=1)


class Hats(NamedTuple):
    """How a column between the stations follows each of its rows, shape (q, stations)."""

    value: Array
    """Derivative of the value at a point by every row."""
    ahead: Array
    """Integral of the same from the nose to the point; the last row is the whole body's."""


def hats(x: Array, stations: Array, column: Array, how: Interpolation) -> Hats:
    """Return how the values of a column at `x`, and their integrals, depend on its rows.

    Parameters
    ----------
    x : array, shape (q,)
        Points [m].
    stations, column : array, shape (s,)
        Where the rows stand [m], and their values.
    how : {"step", "linear", "log"}
    """
    k = np.clip(np.searchsorted(stations, x, side="right") - 1, 0, len(stations) - 2)
    size = np.diff(stations)
    return Hats(
        hat(k, (x - stations[k]) / size[k], column, how), integrals(x, stations, column, how)
    )


def hat(k: npt.NDArray[np.int64], t: Array, column: Array, how: Interpolation) -> Array:
    """Return the derivatives at a fraction `t` of the intervals `k`, shape (..., stations)."""
    rows = np.arange(len(column))
    first, second = rows == k[..., None], rows == k[..., None] + 1
    if how == "step":
        return np.where(first, 1.0, 0.0)
    t = t[..., None]
    if how == "linear":
        return np.asarray((1 - t) * first + t * second)
    value = (column[k] * (column[k + 1] / column[k]) ** t[..., 0])[..., None]
    return np.asarray(value * ((1 - t) * first + t * second) / column)


def integrals(x: Array, stations: Array, column: Array, how: Interpolation) -> Array:
    """Return the derivatives of the integrals up to `x`, and of the whole, by the rows."""
    points = np.append(x, stations[-1])
    size = np.diff(stations)
    every = np.arange(len(size))
    whole = _partial(every, np.ones(len(size)), column, how) * size[:, None]
    before = np.concatenate([np.zeros((1, len(column))), np.cumsum(whole, axis=0)])
    k = np.clip(np.searchsorted(stations, points, side="right") - 1, 0, len(size) - 1)
    t = (points - stations[k]) / size[k]
    return np.asarray(before[k] + _partial(k, t, column, how) * size[k][:, None])


def _partial(k: npt.NDArray[np.int64], t: Array, column: Array, how: Interpolation) -> Array:
    """Integrate the derivatives over the first part of intervals, over the intervals' lengths."""
    rows = np.arange(len(column))
    first, second = rows == k[:, None], rows == k[:, None] + 1
    if how == "step":
        return np.asarray(t[:, None] * first)
    one = np.ones(len(k))
    a, b = (column[k], column[k + 1]) if how == "log" else (one, one)
    J0, J1, _ = moments_within(a, b, one, t, how)
    return np.asarray(((J0 - J1) / a)[:, None] * first + (J1 / b)[:, None] * second)
