"""Banded Cholesky and block subspace iteration: the fast way to a few modes with scipy.

K + shift M is factorised once; each sweep solves for the block and does Rayleigh-Ritz. The vectors
of the beam before are the start of the next one.
"""

import numpy as np
from scipy.linalg import lapack

from .hermite import bands, multiply

VECTORS, SWEEPS = 14, 2


class Subspace:
    """Solver that keeps its vectors from call to call."""

    def __init__(self, segments, vectors=VECTORS, sweeps=SWEEPS):
        self.sweeps = sweeps
        self.start = polynomials(segments, vectors)
        self.X = self.start

    def restart(self):
        self.X = self.start

    def omega2(self, h, m, EI, N, modes):
        """The lowest elastic omega^2 of a free-free beam, its two rigid modes set aside."""
        K, M = bands(h, m, EI, N)
        shift = 20 * N.max() / (m.mean() * (h * len(m)) ** 2)  # above the rotation's -omega^2
        factor, failed = lapack.dpbtrf(K + shift * M, lower=1)
        assert not failed
        X = self.X
        MX = multiply(M, X)
        for _ in range(self.sweeps):
            solved, _ = lapack.dpbtrs(factor, MX.T, lower=1)
            Z = solved.T
            MZ = multiply(M, Z)
            mass = Z @ MZ.T  # and (K + shift M) Z = M X:
            values, Q, _ = lapack.dsygv(Z @ MX.T - shift * mass, mass)
            X, MX = Q.T @ Z, Q.T @ MZ
        self.X = X
        return values[2 : 2 + modes]


def polynomials(segments, vectors):
    """Legendre polynomials and their slopes at the nodes, shape (vectors, 2 segments + 2)."""
    x = np.linspace(-1, 1, segments + 1)
    X = np.empty((vectors, 2 * len(x)))
    for k in range(vectors):
        p = np.polynomial.legendre.Legendre.basis(k)
        X[k, 0::2], X[k, 1::2] = p(x), p.deriv()(x) * 2 / segments
    return X
