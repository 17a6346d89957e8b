"""Guesses of omega^2 for many axial forces on one structure, from exact solves at a few of them.

Forces that belong to one family, ``N(x) = N_0(x) + a_1 V_1(x) + a_2 V_2(x)``, differ in one or two
numbers. The eigenvalues are analytic in them: between the solves at Chebyshev points, polynomials
guess them to the last digits. Whoever uses a guess counts at both sides of it.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

POINTS = 16  # along each of the numbers
_SAMPLES = 24  # forces that tell whether all belong to a family
_FOREIGN = 1e-11  # share of a force that may lie outside its family


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
    if len(force) < 6 * POINTS:
        return None
    middle, directions = _family(force)
    number = len(directions)
    if not 1 <= number <= 2 or len(force) < 6 * POINTS**number:
        return None
    amounts = (force - middle) @ directions.T
    low, high = np.min(amounts, axis=0), np.max(amounts, axis=0)
    centre, half = (high + low) / 2, np.maximum((high - low) / 2, 1e-300)
    nodes = np.cos(np.pi * (np.arange(POINTS) + 0.5) / POINTS)
    grid = np.stack(np.meshgrid(*number * [nodes], indexing="ij"), axis=-1).reshape(-1, number)
    exact = solve(middle + (centre + half * grid) @ directions)
    if not np.all(np.isfinite(exact)):
        return None
    return _interpolate(_transform(nodes), exact, (amounts - centre) / half)


def _family(force: Array) -> tuple[Array, Array]:
    """Return the mean of the forces, and the directions in which some of them differ from it."""
    sample = force[np.linspace(0, len(force) - 1, _SAMPLES).astype(int)]
    middle = np.mean(sample, axis=0)
    if not np.all(np.isfinite(sample)):
        return middle, np.empty((0, force.shape[1]))
    _, size, directions = np.linalg.svd(sample - middle, full_matrices=False)
    largest = max(float(np.linalg.norm(middle)), float(size[0]))
    return middle, directions[size > _FOREIGN * largest]


def _chebyshev(t: Array) -> Array:
    """Return the polynomials T_0 ... at t, shape (len(t), POINTS)."""
    T = np.empty((POINTS, len(t)))
    T[0], T[1] = 1.0, t
    for k in range(2, POINTS):
        T[k] = 2 * t * T[k - 1] - T[k - 2]
    return T.T


def _transform(nodes: Array) -> Array:
    """Return the matrix that makes coefficients of values at the nodes."""
    matrix = 2 * _chebyshev(nodes).T / POINTS
    matrix[0] /= 2
    return np.asarray(matrix)


def _interpolate(transform: Array, exact: Array, t: Array) -> Array:
    modes = exact.shape[1]
    first = transform @ exact.reshape(POINTS, -1)
    if t.shape[1] == 1:
        return np.asarray(_chebyshev(t[:, 0]) @ first)
    both = np.einsum("kj,ijm->ikm", transform, first.reshape(POINTS, POINTS, modes))
    partial = (_chebyshev(t[:, 0]) @ both.reshape(POINTS, -1)).reshape(len(t), POINTS, modes)
    return np.asarray(np.einsum("bk,bkm->bm", _chebyshev(t[:, 1]), partial))
