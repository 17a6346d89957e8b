"""Cubic Hermite elements for one uniform segment each, as band matrices, all beams alike.

(EI Y'')'' + (N Y')' = omega^2 m Y; unknowns Y, h theta at the nodes, so that every entry of an
element is a multiple of its EI/h^3, N/h or m h.
"""

import numpy as np

BENDING = np.array([[12.0, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]])
GEOMETRIC = np.array([[36.0, 3, -36, 3], [3, 4, -3, -1], [-36, -3, 36, -3], [3, -1, -3, 4]]) / 30
MASS = (
    np.array([[156.0, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]]) / 420
)


_LOWER = [(i, j) for i in range(4) for j in range(i + 1)]
_ENTRIES = {
    name: np.array([[element[i, j]] for i, j in _LOWER])
    for name, element in (("bending", BENDING), ("geometric", GEOMETRIC), ("mass", MASS))
}


def _assemble(entries):
    """Lower band (4, 2n + 2) from the ten entries of every element, shape (10, n)."""
    n = entries.shape[1]
    matrix = np.zeros((4, 2 * n + 2))
    for row, (i, j) in zip(entries, _LOWER, strict=True):
        matrix[i - j, j : j + 2 * n : 2] += row
    return matrix


def bands(h, m, EI, N):
    """Stiffness less the axial force's, and mass, for equal segments of length h."""
    K = _ENTRIES["bending"] * (EI / h**3) - _ENTRIES["geometric"] * (N / h)
    return _assemble(K), _assemble(_ENTRIES["mass"] * (m * h))


def multiply(lower, X):
    """Symmetric band matrix times a block of vectors stored by rows, X of shape (vectors, size)."""
    Y = lower[0] * X
    for d in range(1, 4):
        Y[:, d:] += lower[d, :-d] * X[:, :-d]
        Y[:, :-d] += lower[d, :-d] * X[:, d:]
    return Y


def full(lower):
    """The band as a dense symmetric matrix."""
    A = np.diag(lower[0])
    for d in range(1, 4):
        A += np.diag(lower[d, :-d], -d) + np.diag(lower[d, :-d], d)
    return A
