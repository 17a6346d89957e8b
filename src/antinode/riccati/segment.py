r"""Transfer matrices of one uniform segment under constant axial force (equations 48-62).

Lateral motion, state ``z = [Y, psi, M, Q]``, psi the turn of the section and ``M = EI psi'``::

    z' = A z,   A = [[0, alpha, 0, -s], [0, 0, f, 0], [0, -beta, 0, alpha], [mu, 0, 0, 0]]

with f = 1/EI; mu = m omega^2 - k of mass and foundation; and of the axial force N, the shear
flexibility s = 1/kGA and the rotary inertia rho I (Haringx; docs/theory/beam.md)::

    alpha = 1 + s N,   beta = N + s N^2 + rho I omega^2

Euler-Bernoulli has s = 0, rho I = 0: psi = Y', Q = M' + N Y' (equation 48). A is Hamiltonian, and
its characteristic equation biquadratic: ``lambda^4 + b lambda^2 - c = 0``, ``b = s mu + f beta``,
``c = f mu kappa``, ``kappa = alpha^2 - s beta`` (equations 50-51 for s = 0).
Where a load of t per length turns with the section, ``Q' = mu Y + t psi``, and
``- f alpha t lambda`` joins the characteristic equation.
A bar has the state ``[X, Q]`` with ``Q = -EA X'``, a shaft ``[phi, T]`` with ``T = GJ phi'``.

The paper writes U = B(x) B(0)^-1 with the four roots of the quartic (equation 61). Here U is
written with the one solution ``g`` that starts as ``g = g' = g'' = 0, g''' = 1`` and its
derivatives: a power series in ``b h^2`` and ``c h^4``, real for every sign of omega^2 and N, also
where roots coincide. N > 0 is compression. The series needs short segments: see `LONGEST_STEP`.

Everything may be complex: omega^2 off the real axis, stiffness with loss. Bounds use moduli.
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from .arrays import Array

LONGEST_STEP = 1.5
"""Largest wave number times length for which the series are meant, and used, here."""


def wave_number(b: Array, c: Array) -> Array:
    """Return a bound on the modulus of the four roots of ``lambda^4 + b lambda^2 - c = 0``.

    Parameters
    ----------
    b, c : array
        Or bounds on their moduli [1/m^2, 1/m^4], broadcast together.

    Returns
    -------
    array
        ``sqrt(|b|/2 + sqrt(b^2/4 + |c|))`` [1/m].
    """
    half = np.abs(b) / 2
    return np.asarray(np.sqrt(half + np.sqrt(half * half + np.abs(c))))


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
        Length [m], b [1/m^2] and c [1/m^4], real or complex, broadcast together; with
        ``wave_number * h`` at most about `LONGEST_STEP`.

    Returns
    -------
    tuple of array
        ``g, g', g'', g'''`` [m^3, m^2, m, 1].
    """
    h, beta, gamma = np.broadcast_arrays(h, -b * h * h, c * h**4)
    size = np.abs(beta)
    step = math.sqrt(float(np.max(size / 2 + np.sqrt(size**2 / 4 + np.abs(gamma)))))
    coefficients = _inverse_factorials(_terms_needed(step))
    terms = coefficients.shape[1]
    q = np.empty((terms, *h.shape), np.result_type(beta, gamma))
    q[0], q[1] = 1.0, beta
    for k in range(2, terms):
        q[k] = beta * q[k - 1] + gamma * q[k - 2]
    sums = (coefficients @ q.reshape(terms, -1)).reshape(4, *h.shape)
    return h**3 * sums[0], h**2 * sums[1], h * sums[2], sums[3]


def lateral_transfer(
    h: Array,
    stiffness: Array,
    turning: Array,
    inertia: Array,
    shear: Array | float = 0.0,
    coupling: Array | float = 1.0,
) -> Array:
    """Return the lateral transfer matrix U of uniform segments (equations 58, 61, 62).

    Parameters
    ----------
    h, stiffness, turning, inertia : array
        Length [m], EI [N m^2], beta [N], mu [N/m^2], real or complex; broadcast together.
    shear, coupling : array or float
        s [1/N] and alpha.

    Returns
    -------
    array, shape (..., 4, 4)
        ``z(h) = U z(0)``, ``z = [Y, psi, M, Q]``.
    """
    EI, beta, mu, s, alpha = stiffness, turning, inertia, shear, coupling
    kappa, s_mu = alpha * alpha - s * beta, s * mu
    of_force, of_inertia = beta / EI, mu / EI * kappa
    g, g1, g2, g3 = fundamental(h, of_force + s_mu, of_inertia)
    U = np.empty((*g.shape, 4, 4), g.dtype)
    U[..., 0, 0] = U[..., 3, 3] = g3 + of_force * g1
    U[..., 0, 1] = U[..., 2, 3] = alpha * g2
    U[..., 0, 2] = U[..., 1, 3] = alpha * g1 / EI
    U[..., 0, 3] = kappa * g / EI - s * g2
    U[..., 1, 0] = U[..., 3, 2] = alpha * mu / EI * g
    U[..., 1, 1] = U[..., 2, 2] = g3 + s_mu * g1
    U[..., 1, 2] = (g2 + s_mu * g) / EI
    U[..., 2, 0] = U[..., 3, 1] = alpha * mu * g1
    U[..., 2, 1] = kappa * mu * g - beta * g2
    U[..., 3, 0] = mu * (g2 + of_force * g)
    return U


def following_transfer(
    h: Array,
    stiffness: Array,
    turning: Array,
    inertia: Array,
    load: Array,
    shear: Array | float = 0.0,
    coupling: Array | float = 1.0,
) -> Array:
    """Return the lateral transfer matrix where a load along the axis turns with the section.

    With ``A`` of this module and ``A_Q,psi = t``, by Cayley and Hamilton from the powers of A.

    Parameters
    ----------
    h, stiffness, turning, inertia, shear, coupling : array
        As of `lateral_transfer`.
    load : array
        t, along +x [N/m].

    Returns
    -------
    array, shape (..., 4, 4)
    """
    f, beta, mu, t, s, alpha = 1 / stiffness, turning, inertia, load, shear, coupling
    b, c = s * mu + f * beta, f * mu * (alpha * alpha - s * beta)
    g, g1, g2, g3 = _fundamental_of_four(h, b, f * alpha * t, c)
    weights = g3 + b * g1 - f * alpha * t * g, g2 + b * g, g1, g
    U = np.empty((*g.shape, 16), g.dtype)
    for k, entries in enumerate(zip(*_powers(f, beta, mu, t, s, alpha, b), strict=True)):
        U[..., k] = sum(w * entry for w, entry in zip(weights, entries, strict=True))
    return U.reshape(*g.shape, 4, 4)


def _powers(
    f: Array,
    beta: Array,
    mu: Array,
    t: Array,
    s: Array | float,
    alpha: Array | float,
    b: Array,
) -> tuple[tuple[Array | float, ...], ...]:
    """Return the 16 entries of 1, A, A^2 and A^3, row by row."""
    one, zero = 1.0, 0.0
    return (
        (
            one,
            zero,
            zero,
            zero,
            zero,
            one,
            zero,
            zero,
            zero,
            zero,
            one,
            zero,
            zero,
            zero,
            zero,
            one,
        ),
        (zero, alpha, zero, -s, zero, zero, f, zero, zero, -beta, zero, alpha, mu, t, zero, zero),
        (
            *(-s * mu, -s * t, alpha * f, zero),
            *(zero, -f * beta, zero, f * alpha),
            *(alpha * mu, alpha * t, -f * beta, zero),
            *(zero, alpha * mu, f * t, -s * mu),
        ),
        (
            *(zero, -alpha * b, -s * f * t, f * alpha * alpha + s * s * mu),
            *(f * alpha * mu, f * alpha * t, -f * f * beta, zero),
            *(zero, f * beta * beta + alpha * alpha * mu, f * alpha * t, -alpha * b),
            *(-s * mu * mu, -t * b, alpha * f * mu, f * alpha * t),
        ),
    )


def _fundamental_of_four(h: Array, b: Array, d: Array, c: Array) -> tuple[Array, ...]:
    """Return what `fundamental` does of a quartic ``lambda^4 + b lambda^2 - d lambda - c``."""
    h, two, three, four = np.broadcast_arrays(h, -b * h * h, d * h**3, c * h**4)
    half = np.abs(two) / 2
    step = float(np.max(np.sqrt(half + np.sqrt(half**2 + np.abs(four))) + np.cbrt(np.abs(three))))
    terms = 2 * _terms_needed(step)
    p = np.zeros((terms, *h.shape), np.result_type(two, three, four))
    p[0] = 1.0
    for k in range(2, terms):
        p[k] = two * p[k - 2]
        if k > 2:
            p[k] += three * p[k - 3]
        if k > 3:
            p[k] += four * p[k - 4]
    n = np.arange(terms)
    rows = np.array([[1 / math.factorial(k + j) for k in n] for j in (3, 2, 1, 0)])
    sums = (rows @ p.reshape(terms, -1)).reshape(4, *h.shape)
    return h**3 * sums[0], h**2 * sums[1], h * sums[2], sums[3]


def wave_transfer(h: Array, stiffness: Array, inertia: Array, sign: float) -> Array:
    """Return the transfer matrix of uniform segments that obey the wave equation (48, 55, 58).

    Parameters
    ----------
    h, stiffness, inertia : array
        Length [m], K and m omega^2, real or complex; broadcast together. K is EA [N] of a bar,
        GJ [N m^2] of a shaft, m its mass or polar inertia per length.
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
    powers = np.empty((coefficients.shape[1], *z.shape), z.dtype)
    powers[0] = 1.0
    for k in range(1, len(powers)):
        powers[k] = powers[k - 1] * z
    sine, cosine = (coefficients @ powers.reshape(len(powers), -1)).reshape(2, *h.shape)
    U = np.empty((*h.shape, 2, 2), z.dtype)
    U[..., 0, 0] = U[..., 1, 1] = cosine
    U[..., 0, 1] = sign * (h * sine) / stiffness
    U[..., 1, 0] = -sign * (h * sine) * inertia
    return U
