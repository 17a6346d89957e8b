r"""Transfer matrices of one uniform segment under constant axial force (equations 48-62).

Bending, state ``z = [Y, theta, M, Q]`` with ``M = EI Y''`` and ``Q = M' + N Y'``::

    z' = A z,   A = [[0, 1, 0, 0], [0, 0, 1/EI, 0], [0, -N, 0, 1], [m omega^2, 0, 0, 0]]

so that ``Y'''' + b Y'' - c Y = 0`` with ``b = N/EI``, ``c = m omega^2/EI`` (equations 50-51).
A bar has the state ``[X, Q]`` with ``Q = -EA X'``, a shaft ``[phi, T]`` with ``T = GJ phi'``.

The paper writes U = B(x) B(0)^-1 with the four roots of the quartic (equation 61). Here U is
written with the one solution ``g`` that starts as ``g = g' = g'' = 0, g''' = 1`` and its
derivatives: a power series in ``b h^2`` and ``c h^4``, real for every sign of omega^2 and N, also
where roots coincide. N > 0 is compression. The series needs short segments: see `LONGEST_STEP`.
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from .arrays import Array

LONGEST_STEP = 1.5
"""Largest wave number times length for which the series are meant, and used, here."""


def wave_number(bending_stiffness: Array, axial_force: Array, inertia: Array) -> Array:
    """Return a bound on the modulus of the four roots lambda of equation 50.

    Parameters
    ----------
    bending_stiffness, axial_force, inertia : array
        EI [N m^2], N [N] (compression positive) and m omega^2 [N/m^2], broadcast together.

    Returns
    -------
    array
        ``sqrt(|b|/2 + sqrt(b^2/4 + |c|))`` [1/m].
    """
    b = np.abs(axial_force) / bending_stiffness / 2
    return np.sqrt(b + np.sqrt(b * b + np.abs(inertia) / bending_stiffness))


@cache
def _inverse_factorials(terms: int) -> Array:
    """Return ``1/(2k + j)!`` for j = 3, 2, 1, 0 (rows) and k = 0 ... terms - 1 (columns)."""
    return np.array([[1 / math.factorial(2 * k + j) for k in range(terms)] for j in (3, 2, 1, 0)])


def _terms_needed(step: float) -> int:
    """Return how many terms make the truncation of every series smaller than rounding."""
    terms, size = 2, 1.0
    while size * (terms + 1) > 1e-18:
        size = step ** (2 * terms) / math.factorial(2 * terms)
        terms += 1
    return terms


def fundamental(h: Array, b: Array, c: Array) -> tuple[Array, Array, Array, Array]:
    """Return g, g', g'', g''' at `h` for ``g'''' + b g'' - c g = 0``, g'''(0) = 1, else zero.

    Parameters
    ----------
    h, b, c : array
        Length [m], N/EI [1/m^2] and m omega^2/EI [1/m^4], broadcast together; with
        ``wave_number * h`` at most about `LONGEST_STEP`.

    Returns
    -------
    tuple of array
        ``g, g', g'', g'''`` [m^3, m^2, m, 1].
    """
    h, beta, gamma = np.broadcast_arrays(h, -b * h * h, c * h**4)
    step = math.sqrt(float(np.max(np.abs(beta) / 2 + np.sqrt(beta**2 / 4 + np.abs(gamma)))))
    coefficients = _inverse_factorials(_terms_needed(step))
    terms = coefficients.shape[1]
    q = np.empty((terms, *h.shape))
    q[0], q[1] = 1.0, beta
    for k in range(2, terms):
        q[k] = beta * q[k - 1] + gamma * q[k - 2]
    sums = (coefficients @ q.reshape(terms, -1)).reshape(4, *h.shape)
    return h**3 * sums[0], h**2 * sums[1], h * sums[2], sums[3]


def bending_transfer(
    h: Array, bending_stiffness: Array, axial_force: Array, inertia: Array
) -> Array:
    """Return the bending transfer matrix U of uniform segments (equations 58, 61, 62).

    Parameters
    ----------
    h, bending_stiffness, axial_force, inertia : array
        Length [m], EI [N m^2], N [N] (compression positive), m omega^2 [N/m^2]; broadcast together.

    Returns
    -------
    array, shape (..., 4, 4)
        ``z(h) = U z(0)``, ``z = [Y, theta, M, Q]``.
    """
    EI, mw = bending_stiffness, inertia
    b, c = axial_force / EI, inertia / EI
    g, g1, g2, g3 = fundamental(h, b, c)
    U = np.empty((*g.shape, 4, 4))
    U[..., 0, 0] = U[..., 3, 3] = g3 + b * g1
    U[..., 0, 1] = U[..., 2, 3] = g2
    U[..., 0, 2] = U[..., 1, 3] = g1 / EI
    U[..., 0, 3] = g / EI
    U[..., 1, 0] = U[..., 3, 2] = c * g
    U[..., 1, 1] = U[..., 2, 2] = g3
    U[..., 1, 2] = g2 / EI
    U[..., 2, 0] = U[..., 3, 1] = mw * g1
    U[..., 2, 1] = mw * g - axial_force * g2
    U[..., 3, 0] = mw * (g2 + b * g)
    return U


def wave_transfer(h: Array, stiffness: Array, inertia: Array, sign: float) -> Array:
    """Return the transfer matrix of uniform segments that obey the wave equation (48, 55, 58).

    Parameters
    ----------
    h, stiffness, inertia : array
        Length [m], K and m omega^2; broadcast together. K is EA [N] of a bar, GJ [N m^2] of a
        shaft, m its mass or polar inertia per length.
    sign : float
        s of the force ``F = s K u'``: -1 for a bar, 1 for a shaft.

    Returns
    -------
    array, shape (..., 2, 2)
        ``z(h) = U z(0)``, ``z = [u, F]``.
    """
    c = inertia / stiffness
    h, z = np.broadcast_arrays(h, -c * h * h)
    coefficients = _inverse_factorials(_terms_needed(math.sqrt(float(np.max(np.abs(z))))))[2:]
    powers = np.empty((coefficients.shape[1], *z.shape))
    powers[0] = 1.0
    for k in range(1, len(powers)):
        powers[k] = powers[k - 1] * z
    sine, cosine = (coefficients @ powers.reshape(len(powers), -1)).reshape(2, *h.shape)
    U = np.empty((*h.shape, 2, 2))
    U[..., 0, 0] = U[..., 1, 1] = cosine
    U[..., 0, 1] = sign * (h * sine) / stiffness
    U[..., 1, 0] = -sign * (h * sine) * inertia
    return U
