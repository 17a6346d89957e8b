"""Columns of the stations as unknowns: their logarithms on control points or segments.

With unknowns q a column is ``exp(base + W q)``: the rows of W interpolate between the control
points. A column may be relative to another one, whose logarithm is then part of its base.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from antinode.arrays import Array
from antinode.errors import InputError
from antinode.inputs.places import Keys
from antinode.study.design.subject import Given, OfBeam, OfVehicle
from antinode.text import nearest, short
from antinode.vehicle.columns import column_keys, interpolation_matrix

from .file import Distribution, parameters_of


@dataclass(frozen=True)
class Column:
    """A column of the stations that changes with unknowns.

    Attributes
    ----------
    key : str
        As in the file: ``mass_per_length:burnt``.
    label : str
        For tables.
    keys : tuple
        From the stations to the column.
    points : array, shape (n,)
        Where the unknowns stand [m].
    weights : array, shape (rows, n)
        W.
    base : array, shape (rows,)
    parent : str or None
        Key of the column that this one is relative to.
    start : array, shape (n,)
        Of the unknowns.
    """

    key: str
    label: str
    keys: Keys
    points: Array
    weights: Array
    base: Array
    parent: str | None
    start: Array

    def logarithm(self, unknowns: Array, parent: Array | None) -> Array:
        """Return the logarithm of the column, given that of its parent."""
        own = self.base + self.weights @ unknowns
        return np.asarray(own if parent is None else own + parent)


def make_column(case: Given, given: Distribution) -> Column:
    """Turn a table of the file into a column with unknowns."""
    subject = parameters_of(case)
    step, x = subject.interpolation == "step", subject.x
    keys = _keys(subject, given.column)
    rows = (x[1:] + x[:-1]) / 2 if step else x
    points = _points(given, rows, x)
    weights = interpolation_matrix(points, rows, given.interpolation if not given.segments else "")
    column = _logarithm(subject, keys)
    parent = None
    if given.relative_to is not None:
        parent_keys = _keys(subject, given.relative_to)
        if parent_keys == keys:
            raise InputError(f"distributions: {given.column} cannot be relative to itself")
        column = column - _logarithm(subject, parent_keys)
        parent = ":".join(map(str, parent_keys))
    start = np.zeros(len(points))
    if given.fitted == "value":
        start, column = np.interp(points, rows, column[: len(rows)]), np.zeros(len(column))
    if step:
        weights = np.concatenate([weights, weights[-1:]])
    label = given.name or given.column.replace("_", " ")
    return Column(":".join(map(str, keys)), label, keys, points, weights, column, parent, start)


def _keys(subject: OfVehicle | OfBeam, name: str) -> Keys:
    """Return the keys from the stations to a column."""
    if isinstance(subject, OfVehicle):
        return column_keys(subject.case.vehicle.stations, name)
    known = subject.columns
    if name not in known:
        raise InputError(f"distributions: column = {short(name)}; {nearest(name, known)}")
    return (name,)


def _logarithm(subject: OfVehicle | OfBeam, keys: Keys) -> Array:
    values = subject.values((*subject.stations, *keys))
    for row in np.flatnonzero(~((values > 0) & np.isfinite(values)))[:1]:
        raise InputError(
            f"distributions: column = {':'.join(map(str, keys))}: row {row + 1} is "
            f"{values[row]:g}; what changes along the body does so on a logarithmic scale, which "
            "needs finite values above 0"
        )
    return np.asarray(np.log(values))


def _points(given: Distribution, rows: Array, x: Array) -> Array:
    if given.segments:
        return rows
    if isinstance(given.control_points, tuple):
        points = np.array(given.control_points)
        if points[0] < x[0] or points[-1] > x[-1]:
            say = f"they must lie on the body, from {x[0]:g} to {x[-1]:g} m"
            raise InputError(f"distributions: control_points of {given.column}: {say}")
        return points
    assert given.control_points is not None
    return np.linspace(x[0], x[-1], given.control_points)


def second_differences(points: Array) -> Array:
    """Return the matrix of second differences, for uneven points scaled to their mean distance."""
    if len(points) < 3:
        return np.zeros((0, len(points)))
    size = np.diff(points)
    mean = float(np.mean(size))
    matrix = np.zeros((len(points) - 2, len(points)))
    for i, (a, b) in enumerate(pairwise(size.tolist())):
        scale = 2 * mean**2 / (a + b)
        matrix[i, i : i + 3] = scale / a, -scale * (1 / a + 1 / b), scale / b
    return matrix
