"""Banded Cholesky and block subspace iteration: the fast way to a few modes with scipy.

K + shift M is factorised once. Every sweep solves for the block; between sweeps a Cholesky factor
of its Gram matrix keeps the vectors apart, and Rayleigh-Ritz follows the last. The vectors of the
beam before are the start of the next one.
"""

import numpy as np
from scipy.linalg import blas, lapack
from scipy.sparse import csr_array

from .hermite import COLUMNS, MASS_ROWS, band, sides

VECTORS, SWEEPS = 13, 2


def _place(x):
    """Y and its derivatives by x at a share x of an element of length 1, by its four unknowns."""
    return [
        [1 - 3 * x**2 + 2 * x**3, x - 2 * x**2 + x**3, 3 * x**2 - 2 * x**3, x**3 - x**2],
        [6 * x**2 - 6 * x, 1 - 4 * x + 3 * x**2, 6 * x - 6 * x**2, 3 * x**2 - 2 * x],
        [12 * x - 6, 6 * x - 4, 6 - 12 * x, 6 * x - 2],
        [12, 6, -12, 6],
    ]


PLACES = np.array(_place(0.0) + _place(0.5))


class Subspace:
    """Solver that keeps its vectors from call to call."""

    columns, mass_rows, elastic = COLUMNS, MASS_ROWS, 4
    """Of the elements: their tables, and how many columns of `sides` do not vibrate."""
    sides = staticmethod(sides)

    def __init__(self, segments, vectors=VECTORS, sweeps=SWEEPS):
        self.sweeps = sweeps
        self.mass = _node_rows(segments)
        self.start = polynomials(segments, vectors)
        self.X = self.start

    def restart(self):
        self.X = self.start

    def omega2(self, h, m, EI, N, modes, *more):
        """The lowest elastic omega^2 of a free-free beam, its two rigid modes set aside."""
        M, S = self.mass, self.sides(h, m, EI, N, *more)
        np.matmul(S[:, self.elastic :], self.mass_rows, out=M.data.reshape(-1, 12))
        shift = 20 * N.max() / (m.sum() * h * len(m) * h)  # above the rotation's -omega^2
        S[:, self.elastic :] *= shift
        factor, failed = lapack.dpbtrf(band(S, self.columns), overwrite_ab=1)
        assert not failed
        F = M @ self.X
        Z, MZ, mass = _sweep(factor, M, F)
        for _ in range(self.sweeps - 1):
            gram, _ = lapack.dpotrf(mass, lower=1)
            F = blas.dtrsm(1.0, gram, MZ.T, lower=1, overwrite_b=1).T
            Z, MZ, mass = _sweep(factor, M, F)
        # (K + shift M) Z = F
        values, Q, failed = lapack.dsygv(Z.T @ F, mass, overwrite_a=1, overwrite_b=1)
        assert not failed
        self.X = Z @ Q
        return values[2 : 2 + modes] - shift

    def states(self, h, EI, N, modes):
        """Y, h theta, M and M' + N theta of the modes found last at left nodes and in middles."""
        u = self.X[:, 2 : 2 + modes].reshape(-1, 2, modes)
        z = np.matmul(PLACES, np.concatenate([u[:-1], u[1:]], axis=1)).reshape(-1, 2, 4, modes)
        z[:, :, 2] *= (EI / h**2)[:, None, None]
        z[:, :, 3] *= (EI / h**3)[:, None, None]
        z[:, :, 3] += z[:, :, 1] * (N / h)[:, None, None]
        return z


def _sweep(factor, M, F):
    Z, _ = lapack.dpbtrs(factor, F)
    MZ = M @ Z
    return Z, MZ, Z.T @ MZ


def _node_rows(segments):
    """Sparse matrix with six places in every row: two unknowns of a node and its neighbours."""
    size = 2 * segments + 2
    first = np.repeat(np.arange(-2, size - 2, 2), 2)
    columns = np.clip(first[:, None] + np.arange(6), 0, size - 1).ravel()
    starts = np.arange(0, 6 * size + 1, 6)
    return csr_array((np.zeros(6 * size), columns, starts), shape=(size, size))


def polynomials(segments, vectors):
    """Legendre polynomials and their slopes at the nodes, shape (2 segments + 2, vectors)."""
    x = np.linspace(-1, 1, segments + 1)
    X = np.empty((2 * len(x), vectors))
    for k in range(vectors):
        p = np.polynomial.legendre.Legendre.basis(k)
        X[0::2, k], X[1::2, k] = p(x), p.deriv()(x) * 2 / segments
    return X
