"""Complex modes of elements with dashpots: LAPACK's dense solver of the state space, and ARPACK.

z = [u, u'], z' = A z, with A = [[0, 1], [-M^-1 K, -M^-1 C]] dense; shift and invert about s = 0
needs K alone, which is symmetric, positive and banded: its Cholesky factors by LAPACK, M and C as
sparse products.
"""

import numpy as np
import scipy.sparse as sparse
from scipy.linalg import cho_solve_banded, cholesky_banded, eig
from scipy.linalg.lapack import dpbtrs
from scipy.sparse.linalg import LinearOperator, eigs

from .banded import _element

_VECTORS = 24  # of ARPACK: the fewest that find six pairs without a restart too many


class StateSpace:
    """A beam that is clamped on its left, with dashpots of [x, N s/m]."""

    def __init__(self, own, dashpots):
        size = 2 * len(own.x)
        K, M, C = np.zeros((3, size, size))
        for k, h in enumerate(np.diff(own.x)):
            some = slice(2 * k, 2 * k + 4)
            stiff, mass = _element(h, own.bending_stiffness[k, 0], own.mass_per_length[k, 0])
            K[some, some] += stiff
            M[some, some] += mass
        for x, c in dashpots:
            place = 2 * int(np.argmin(np.abs(own.x - x)))
            C[place, place] += c
        self.K, self.M, self.C = K[2:, 2:], M[2:, 2:], C[2:, 2:]
        self.size = size - 2
        self.bands = np.zeros((4, self.size), order="F")
        self.mass = np.zeros((4, self.size), order="F")
        for band in range(4):
            self.bands[3 - band, band:] = np.diagonal(self.K, band)
            self.mass[3 - band, band:] = np.diagonal(self.M, band)
        self.sparse = sparse.csr_matrix(self.M), sparse.csr_matrix(self.C)

    def dense(self):
        """Return all eigenvalues, and right vectors."""
        n = self.size
        A = np.zeros((2 * n, 2 * n), order="F")
        A[:n, n:] = np.eye(n)
        factors = cholesky_banded(self.mass, check_finite=False), False
        A[n:, :n] = -cho_solve_banded(factors, self.K, check_finite=False)
        A[n:, n:] = -cho_solve_banded(factors, self.C, check_finite=False)
        return eig(A, overwrite_a=True, check_finite=False)

    def inverted(self, pairs, start=None):
        """Return the pairs nearest to s = 0, with right vectors."""
        n, (M, C) = self.size, self.sparse
        factors = cholesky_banded(self.bands, check_finite=False)

        def inverse(z):
            top = -dpbtrs(factors, C @ z[:n] + M @ z[n:])[0]
            return np.concatenate([top.ravel(), z[:n].ravel()])

        A = LinearOperator((2 * n, 2 * n), matvec=inverse, dtype=float)
        values, vectors = eigs(A, 2 * pairs, v0=start, ncv=_VECTORS)
        return 1 / values, vectors
