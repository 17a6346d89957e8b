"""Columns of a vehicle's stations: named, read, replaced, interpolated."""

from __future__ import annotations

import numpy as np

from antinode.arrays import Array
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
