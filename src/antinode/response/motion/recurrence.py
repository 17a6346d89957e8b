r"""Linear motion under forces that run straight between points: exact from point to point.

Every mode is one or two first-order equations ``z' = lambda z + u``; over a step h in which u runs
from u_0 to u_1,

    z_1 = e^s z_0 + h [(phi_1 - phi_2) u_0 + phi_2 u_1],   s = lambda h,
    phi_1 = (e^s - 1)/s,   phi_2 = (e^s - 1 - s)/s^2:

the first-order hold, without an error of time steps. A mode that rings has
``q = Im z/omega_d``, ``lambda = -zeta omega + i omega_d``; one that creeps or diverges two real
roots, ``q = (z_a - z_b)/(lambda_a - lambda_b)``; a rigid one is a double integral.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from antinode.arrays import Array, Numbers

_SERIES = 20  # terms of phi_1, phi_2 where s is small
_TINY = 1e-7  # relative distance of two real roots that count as one


class Motion(NamedTuple):
    """Coordinates over time.

    Attributes
    ----------
    q, rate : array, shape (times, n)
        Coordinates and their velocities.
    """

    q: Array
    rate: Array


def phi(s: Numbers) -> tuple[Numbers, Numbers, Numbers]:
    """Return e^s, phi_1 and phi_2."""
    e = np.exp(s)
    small = np.abs(s) < 0.5
    safe = np.where(small, 1.0, s)
    one, two = (e - 1) / safe, (e - 1 - s) / safe**2
    if np.any(small):
        t = np.where(small, s, 0.0)
        first, second, term = np.zeros_like(t), np.zeros_like(t), np.ones_like(t)
        for k in range(_SERIES):
            term = term / (k + 1) if k == 0 else term * t / (k + 1)
            first = first + term
            second = second + term / (k + 2)
        one, two = np.where(small, first, one), np.where(small, second, two)
    return e, one, two


def integrate_first_order(roots: Numbers, time_s: Array, start: Numbers, end: Numbers) -> Numbers:
    """Return z at all times, from rest.

    Parameters
    ----------
    roots : array, shape (n,)
    time_s : array, shape (t,)
        Not decreasing.
    start, end : array, shape (t - 1, n)
        u at the beginning and the end of every step.

    Returns
    -------
    array, shape (t, n)
    """
    z = np.zeros((len(time_s), len(roots)), dtype=complex)
    together = max(1, 2_000_000 // max(len(roots), 1))
    h = np.diff(time_s)
    for first in range(0, len(h), together):
        some = slice(first, first + together)
        e, one, two = phi(roots * h[some, None])
        step = h[some, None] * ((one - two) * start[some] + two * end[some])
        now = z[first]
        for k in range(len(step)):
            now = e[k] * now + step[k]
            z[first + k + 1] = now
    return z


def move(omega2: Array, drag: Array, time_s: Array, start: Array, end: Array) -> Motion:
    """Return coordinates ``q'' + drag q' + omega2 q = u`` of modes that do not meet, from rest.

    Parameters
    ----------
    omega2, drag : array, shape (n,)
        [rad^2/s^2], any sign, and 2 zeta omega [1/s].
    time_s, start, end : array
        As `integrate_first_order` has them.
    """
    q, rate = np.zeros((2, len(time_s), len(omega2)))
    half = drag / 2
    square = omega2 - half**2
    scale = np.maximum(np.abs(omega2), half**2)
    rings = square > _TINY**2 * scale
    rigid = scale == 0.0
    slow = ~rings & ~rigid
    if np.any(rings):
        damped = np.sqrt(square[rings])
        roots = -half[rings] + 1j * damped
        z = integrate_first_order(roots, time_s, start[:, rings], end[:, rings])
        q[:, rings], rate[:, rings] = z.imag / damped, (roots * z).imag / damped
    if np.any(slow):
        root = np.sqrt(np.maximum(-square[slow], _TINY**2 * scale[slow]))
        a, b = -half[slow] + root, -half[slow] - root
        za, zb = (
            integrate_first_order(r, time_s, start[:, slow], end[:, slow]).real for r in (a, b)
        )
        q[:, slow], rate[:, slow] = (za - zb) / (a - b), (a * za - b * zb) / (a - b)
    if np.any(rigid):
        q[:, rigid], rate[:, rigid] = twice_integrated(time_s, start[:, rigid], end[:, rigid])
    return Motion(q, rate)


def twice_integrated(time_s: Array, start: Array, end: Array) -> tuple[Array, Array]:
    """Return the double and the single integral of what runs straight in every step."""
    h = np.diff(time_s)[:, None]
    v = np.concatenate([np.zeros((1, start.shape[1])), np.cumsum(h * (start + end) / 2, axis=0)])
    steps = h * v[:-1] + h**2 * (start / 3 + end / 6)
    return np.concatenate([np.zeros((1, start.shape[1])), np.cumsum(steps, axis=0)]), v


def move_together(omega2: Array, damping: Array, time_s: Array, start: Array, end: Array) -> Motion:
    """Return coordinates ``q'' + C q' + omega2 q = u`` of modes that dashpots couple, from rest.

    Where a rigid motion meets no dashpot, a drag of 1e-6 of it over the whole time parts its
    double root.
    """
    n = len(omega2)
    A = np.zeros((2 * n, 2 * n))
    A[:n, n:], A[n:, :n], A[n:, n:] = np.eye(n), -np.diag(omega2), -damping
    roots, V = np.linalg.eig(A)
    if np.linalg.cond(V) > 1e11:
        free = np.flatnonzero(np.abs(omega2) <= 1e-12 * np.max(np.abs(omega2)))
        A[n + free, n + free] -= 1e-6 / (time_s[-1] - time_s[0])
        roots, V = np.linalg.eig(A)
    into = np.linalg.inv(V)[:, n:]
    z = integrate_first_order(roots, time_s, start @ into.T, end @ into.T)
    x = (z @ V.T).real
    return Motion(x[:, :n], x[:, n:])


def companion(stiffness: Array, damping: Array) -> tuple[Array, Array]:
    """Return A of ``z' = A z`` for ``q'' + C q' + K q = 0``, ``z = (w q, q')``, and w."""
    n = len(stiffness)
    w = np.sqrt(np.abs(np.diag(stiffness)))
    w = np.maximum(w, np.min(w[w > 1e-6 * np.max(w)], initial=np.inf if np.any(w) else 1.0))
    w = np.where(np.isfinite(w), w, 1.0)
    A = np.zeros((2 * n, 2 * n))
    A[:n, n:], A[n:, :n], A[n:, n:] = np.diag(w), -stiffness / w, -damping
    return A, w


def move_coupled(
    stiffness: Array, damping: Array, into: Array, time_s: Array, start: Array, end: Array
) -> Motion:
    """Return coordinates ``q'' + C q' + K q = into f`` of modes that anything couples, from rest.

    By exponentials of the whole matrix, one for each length of a step: no eigenvectors, so that
    motions at rest may be as defective as they are where ends follow.

    Parameters
    ----------
    stiffness, damping : array, shape (n, n)
        K [rad^2/s^2] and C [1/s], of any kind.
    into : array, shape (n, forces)
    time_s : array, shape (t,)
    start, end : array, shape (t - 1, forces)
        f at the beginning and the end of every step.
    """
    from scipy.linalg import expm

    (n, forces), h = into.shape, np.diff(time_s)
    A, w = companion(stiffness, damping)
    B = np.vstack([np.zeros((n, forces)), into])
    lengths, which = np.unique(np.round(h / np.max(h), 12), return_inverse=True)
    z, change = np.zeros((len(time_s), 2 * n)), end - start
    steps = []
    for k in range(len(lengths)):
        own = which == k
        size = float(np.mean(h[own]))
        whole = np.zeros((2 * n + 2 * forces, 2 * n + 2 * forces))
        whole[: 2 * n, : 2 * n], whole[: 2 * n, 2 * n : 2 * n + forces] = A * size, B * size
        whole[2 * n : 2 * n + forces, 2 * n + forces :] = np.eye(forces)
        E = expm(whole)[: 2 * n]
        z[1:][own] = start[own] @ E[:, 2 * n : 2 * n + forces].T
        z[1:][own] += change[own] @ E[:, 2 * n + forces :].T
        steps.append(np.ascontiguousarray(E[:, : 2 * n]))
    for k, step in enumerate(which):
        z[k + 1] += steps[step] @ z[k]
    return Motion(z[:, :n] / w, z[:, n:])
