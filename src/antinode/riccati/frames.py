"""Frames: bases of the states that one end of a chain admits, as arrays (..., s, d).

A frame's first d rows are displacements, its last d rows the forces that go with them, in reverse
order: component i meets component s - 1 - i.
"""

from __future__ import annotations

import numpy as np

from .arrays import Array


def orthonormalise(F: Array) -> tuple[Array, Array]:
    """Return Q and upper triangular R with positive diagonal, ``F = Q R``, for one or two columns.

    Parameters
    ----------
    F : array, shape (..., s, d)
    """
    Q, R = np.empty_like(F), np.zeros((*F.shape[:-2], F.shape[-1], F.shape[-1]), F.dtype)
    for j in range(F.shape[-1]):
        column = F[..., j]
        for i in range(j):
            R[..., i, j] = _product(Q[..., i], column)
            column = column - R[..., i, j, None] * Q[..., i]
        R[..., j, j] = np.sqrt(_product(column, column).real)
        Q[..., j] = column / R[..., j, j, None]
    return Q, R


def _product(a: Array, b: Array) -> Array:
    """Return the scalar products of columns, shape (...,)."""
    left = np.conj(a) if np.iscomplexobj(a) else a
    return np.asarray(np.einsum("...s,...s->...", left, b))


def inverse_upper(R: Array) -> Array:
    """Return the inverse of upper triangular 1x1 or 2x2 matrices."""
    inverse = np.zeros_like(R)
    for j in range(R.shape[-1]):
        inverse[..., j, j] = 1.0 / R[..., j, j]
    if R.shape[-1] == 2:
        inverse[..., 0, 1] = -R[..., 0, 1] * inverse[..., 0, 0] * inverse[..., 1, 1]
    return inverse


def determinant(C: Array) -> Array:
    """Return the determinant of 1x1 or 2x2 matrices, shape (...,)."""
    if C.shape[-1] == 1:
        return C[..., 0, 0]
    return C[..., 0, 0] * C[..., 1, 1] - C[..., 0, 1] * C[..., 1, 0]


def minor(F: Array, rows: list[int]) -> Array:
    """Return the determinant of the given rows of the frames, shape (...,)."""
    return determinant(F[..., rows, :])


def turning(F: Array, kappa: Array, adjoint: bool) -> Array:
    """Return the frame of a free end with ``Q = kappa psi``; of the adjoint one ``M = -kappa Y``.

    The adjoint plane is all that the symplectic form takes to zero with the first.
    """
    F, size = F.copy(), np.sqrt(1 + kappa**2)
    row, column, sign = (-2, 0, -1) if adjoint else (-1, 1, 1)
    F[:, row, column] += sign * kappa
    F[:, :, column] /= size[:, None]
    return F


def hold(F: Array, rows: tuple[int, ...]) -> tuple[Array, Array, Array]:
    """Pass a frame through a support that holds displacements at zero.

    Parameters
    ----------
    F : array, shape (k, s, d)
        Frame on the left.
    rows : tuple of int
        Which displacements are held.

    Returns
    -------
    F : array, shape (k, s, d)
        Frame on the right: the states that obey the support, with the reactions free.
    back : array, shape (k, d, d)
        Coefficients on the left are these times those on the right.
    factor : array, shape (k,)
        What the part on the left adds to the characteristic function where it is cut off.
    """
    lanes, size, d = F.shape
    new, back = np.zeros_like(F), np.zeros((lanes, d, d), F.dtype)
    if len(rows) == d:  # everything held: what follows knows nothing of what came before
        new[:, d:] = np.eye(d)
        return new, back, np.linalg.det(F[:, :d])
    row, force = rows[0], size - 1 - rows[0]
    a = np.stack([F[:, row, 1], -F[:, row, 0]], axis=-1)
    a = np.where(np.any(a, axis=-1, keepdims=True), a, np.array([1.0, 0.0]))
    state = np.einsum("ksd,kd->ks", F, a)
    state[:, [row, force]] = 0.0
    length = np.linalg.norm(state, axis=-1, keepdims=True)
    length = np.where(length > 0, length, 1.0)
    new[:, :, 0], new[:, force, 1] = state / length, 1.0
    back[:, :, 0] = a / length
    return new, back, np.ones(lanes)


def pass_off_centre(F: Array, U: Array, arm: Array, own: Array) -> tuple[Array, Array]:
    """Pass a lateral frame through a mass whose centre is off the node.

    Turned so that in its second column the centre rests, and the mass itself does nothing: what
    the rotary inertia J adds there would drown in J + m d^2.

    Parameters
    ----------
    F : array, shape (k, 4, 2)
    U, own : array, shape (k, 4, 4)
        The step, and what it is without the mass, but with its rotary inertia.
    arm : array, shape (k,)

    Returns
    -------
    F : array, shape (k, 4, 2)
    back : array, shape (k, 2, 2)
        Coefficients on the left are these times those on the right.
    """
    centre = F[:, 0] + arm[:, None] * F[:, 1]
    size = np.copysign(np.hypot(centre[:, 0], centre[:, 1]), centre[:, 0])
    safe = np.where(size == 0, 1.0, size)
    c, s = (
        np.where(size == 0, 1.0, centre[:, 0] / safe),
        np.where(size == 0, 0.0, centre[:, 1] / safe),
    )
    turn = np.stack([np.stack([c, -s], axis=-1), np.stack([s, c], axis=-1)], axis=-2)
    turned = F @ turn
    new, R = orthonormalise(np.concatenate([U @ turned[..., :1], own @ turned[..., 1:]], axis=-1))
    return new, turn @ inverse_upper(R)


def pull(F: Array, spring: Array) -> Array:
    """Return a lateral frame behind a spring in the units of the states, shape (k,)."""
    new = F.copy()
    new[:, -1] -= spring[:, None] * F[:, 0]
    return new


def pass_pedestal(F: Array, numerator: Array, denominator: Array) -> tuple[Array, Array]:
    """Pass a real lateral frame through a spring ``numerator/denominator``, perhaps infinite.

    What it pulls, R, is an unknown beside the two coefficients c of the frame: new states are
    ``F c - e_Q R`` with ``denominator R = numerator Y c``, a plane whatever the two numbers are.
    Its basis keeps the orientation of c.

    Parameters
    ----------
    F : array, shape (k, 4, 2)
    numerator, denominator : array, shape (k,)
        In the units of the states.

    Returns
    -------
    F : array, shape (k, 4, 2)
    back : array, shape (k, 2, 2)
        Coefficients on the left are these times those on the right.
    """
    a = -numerator[:, None] * F[:, 0]
    size = np.sqrt(np.sum(a**2, axis=-1) + denominator**2)
    size = np.where(size > 0, size, 1.0)
    p, g = a / size[:, None], denominator / size
    rho = np.hypot(p[:, 0], p[:, 1])
    first, second = np.where(rho > 0, p.T / np.where(rho > 0, rho, 1.0), np.array([[0.0], [1.0]]))
    sign = np.where(g < 0, -1.0, 1.0)
    none, across = np.zeros(len(g)), np.where(rho > 0, rho, 0.0)
    N = np.stack([second * sign, -first * sign, none, g * first, g * second, -across], axis=-1)
    N = np.swapaxes(N.reshape(-1, 2, 3), -1, -2)
    new = F @ N[:, :2]
    new[:, -1] -= N[:, 2]
    Q, R = orthonormalise(new)
    return Q, N[:, :2] @ inverse_upper(R)


def displacement_sign(F: Array, behind: float) -> Array:
    """Return what changes its sign where a state of the frame has no displacement.

    That is det A; at a node that is held, the one free displacement, or the sign that A takes just
    `behind` it. Both neighbours of a node use the same number, so that its rounding cannot spoil
    the sum of their counts.
    """
    d = F.shape[-1]
    A = F[..., :d, :]
    of_all = determinant(A)
    free = np.sum(A[..., 0], axis=-1)
    return np.where(of_all != 0.0, of_all, np.where(free != 0.0, free, behind))
