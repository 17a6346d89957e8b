"""Guesses of omega^2 for many axial forces on one structure, from exact solves at a few of them.

Forces that belong to one family, ``N(x) = N_0(x) + a_1 V_1(x) + ... + a_q V_q(x)``, differ in a few
numbers. The eigenvalues are analytic in them: between the solves at Chebyshev points, polynomials
guess them to the last digits. Along each number as many points are taken as its coefficients need
to vanish. Whoever uses a guess counts at both sides of it.

A guess has the same bits in any process: its products are numpy's own sums, for those of a BLAS
library depend on how many threads it has.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache

import numpy as np

from antinode.arrays import Array

POINTS = 16  # along each of the numbers, at most
_NUMBERS = 3  # of a family, at most: for more, a full solve takes no longer
_WORTH = 6  # cases for every exact solve
_SAMPLES = 24  # forces that tell whether all belong to a family
_FOREIGN = 1e-11  # share of a force that may lie outside its family
_VANISHES = 1e-12  # coefficients relative to the largest
_TOGETHER = 4096  # cases evaluated at once


def guess_omega2(force: Array, solve: Callable[[Array], Array]) -> Array | None:
    """Return omega^2 for every axial force; None if they are too few or no family.

    Parameters
    ----------
    force : array, shape (cases, n)
        N [N].
    solve : callable
        Returns the exact omega^2, shape (k, modes), for forces of shape (k, n).

    Returns
    -------
    array, shape (cases, modes), or None
        [rad^2/s^2].
    """
    if len(force) < _WORTH * POINTS:
        return None
    middle, directions = _family(force)
    number = len(directions)
    if not 1 <= number <= _NUMBERS or len(force) < _WORTH * POINTS * number:
        return None
    amounts = np.einsum("ij,kj->ik", force - middle, directions)
    low, high = np.min(amounts, axis=0), np.max(amounts, axis=0)
    centre, half = (high + low) / 2, np.maximum((high - low) / 2, 1e-300)

    def exact_at(places: Array) -> Array:
        return solve(middle + _product(centre + half * places, directions))

    exact = _on_axes(number, exact_at)
    if number > 1 and np.all(np.isfinite(exact)):
        points = [_points_needed(values) for values in exact]
        if len(force) < _WORTH * math.prod(points):
            return None
        exact = exact_at(_grid(points)).reshape(*points, -1)
    if not np.all(np.isfinite(exact)):
        return None
    return _interpolate(exact, (amounts - centre) / half)


def _on_axes(number: int, exact_at: Callable[[Array], Array]) -> Array:
    """Return exact values along each number, the others in the middle, (numbers, POINTS, modes).

    A single number has no axis in the shape.
    """
    places = np.zeros((number, POINTS, number))
    for k in range(number):
        places[k, :, k] = _nodes(POINTS)
    shape = (number, POINTS, -1) if number > 1 else (POINTS, -1)
    return exact_at(places.reshape(-1, number)).reshape(shape)


def _points_needed(values: Array) -> int:
    """Return how many points a number needs, from exact values at POINTS of it."""
    size = np.abs(_product(_transform(POINTS), values))
    large = np.flatnonzero(np.any(size > _VANISHES * np.max(size, axis=0), axis=1))
    return min(int(large[-1]) + 2, POINTS)


def _nodes(points: int) -> Array:
    return np.asarray(np.cos(np.pi * (np.arange(points) + 0.5) / points))


def _grid(points: list[int]) -> Array:
    """Return the places of a grid, the last number running fastest, (places, numbers)."""
    axes = np.meshgrid(*(_nodes(p) for p in points), indexing="ij")
    return np.stack(axes, axis=-1).reshape(-1, len(points))


def _family(force: Array) -> tuple[Array, Array]:
    """Return the mean of the forces, and the directions in which some of them differ from it.

    Gram and Schmidt's way, the largest rest first; one direction too many tells of no family.
    """
    sample = force[np.linspace(0, len(force) - 1, _SAMPLES).astype(int)]
    middle = np.mean(sample, axis=0)
    if not np.all(np.isfinite(sample)):
        return middle, np.empty((0, force.shape[1]))
    rest, directions = sample - middle, np.empty((0, force.shape[1]))
    size = _norms(rest)
    least = _FOREIGN * max(float(_norms(middle[None])[0]), float(np.max(size)))
    while np.max(size) > least and len(directions) <= _NUMBERS:
        k = np.argmax(size)
        directions = np.concatenate([directions, rest[k : k + 1] / size[k]])
        for _ in range(2):  # once more for what rounding has left
            rest = rest - np.einsum("ij,j->i", rest, directions[-1])[:, None] * directions[-1]
        size = _norms(rest)
    return middle, directions


def _norms(rows: Array) -> Array:
    return np.asarray(np.sqrt(np.einsum("ij,ij->i", rows, rows)))


def _product(a: Array, b: Array) -> Array:
    """Return the product of two matrices."""
    return np.asarray(np.einsum("ij,jk->ik", a, b))


def _chebyshev(t: Array, points: int) -> Array:
    """Return the polynomials T_0 ... at t, shape (len(t), points)."""
    T = np.empty((points, len(t)))
    T[0], T[1] = 1.0, t
    for k in range(2, points):
        T[k] = 2 * t * T[k - 1] - T[k - 2]
    return T.T


@cache
def _transform(points: int) -> Array:
    """Return the matrix that makes coefficients of values at the nodes."""
    matrix = 2 * _chebyshev(_nodes(points), points).T / points
    matrix[0] /= 2
    return np.asarray(matrix)


def _interpolate(exact: Array, t: Array) -> Array:
    """Evaluate the polynomials through a grid of values, shape (points ..., modes), at places t."""
    coefficients = exact
    for axis in range(t.shape[1]):
        transform = _transform(exact.shape[axis])
        first = np.moveaxis(coefficients, axis, 0)
        product = _product(transform, first.reshape(len(first), -1)).reshape(-1, *first.shape[1:])
        coefficients = np.moveaxis(product, 0, axis)
    parts = [_evaluate(coefficients, t[i : i + _TOGETHER]) for i in range(0, len(t), _TOGETHER)]
    return np.concatenate(parts)


def _evaluate(coefficients: Array, t: Array) -> Array:
    points = coefficients.shape[:-1]
    found = _product(_chebyshev(t[:, 0], points[0]), coefficients.reshape(points[0], -1))
    for axis in range(1, len(points)):
        T = _chebyshev(t[:, axis], points[axis])
        found = np.einsum("ij,ijk->ik", T, found.reshape(len(t), points[axis], -1))
    return np.asarray(found)
