"""Hierarchical elements of order 7 between the stations, Gauss points, dense eigh.

(EI Y'')'' + (N Y')' = omega^2 m Y on elements that end where m and EI have kinks: Hermite cubics
and bubbles whose second derivatives are Legendre polynomials. The mesh and its matrices are built
for every call; the shapes on the unit element are tables.
"""

from functools import cache

import numpy as np
from numpy.polynomial import legendre
from scipy.linalg import lapack

ORDER, POINTS = 7, 10
_XI, _W = legendre.leggauss(POINTS)
_CUBICS = np.array([[0.5, -0.75, 0, 0.25], [0.25, -0.25, -0.25, 0.25],
                    [0.5, 0.75, 0, -0.25], [-0.25, -0.25, 0.25, 0.25]])  # fmt: skip


def _tables():
    """Value, slope and curvature of the eight functions at the Gauss points, (3, 8, POINTS)."""
    series = [legendre.poly2leg(c) for c in _CUBICS]
    series += [legendre.legint(np.eye(j + 1)[j], 2, lbnd=-1) for j in range(2, ORDER - 1)]
    return np.array([[legendre.legval(_XI, legendre.legder(c, d)) for c in series]
                     for d in range(3)])  # fmt: skip


_TABLES = _tables()
_PAIRS = [np.einsum("iq,jq,q->qij", t, t, _W).reshape(POINTS, -1) for t in _TABLES]


def omega2(x, m, EI, N, modes, pieces=1):
    """Lowest elastic omega^2 of a free-free beam, log-linear m and EI, linear N between x."""
    t = (np.arange(pieces)[:, None] + (_XI + 1) / 2) / pieces

    def at(values, log):
        a, b = values[:-1, None, None], values[1:, None, None]
        found = a * (b / a) ** t if log else a + (b - a) * t
        return found.reshape(-1, POINTS)

    J = np.repeat(np.diff(x) / pieces, pieces)[:, None] / 2
    scale = np.ones((len(J), 8))
    scale[:, 1:2] = scale[:, 3:4] = J  # slopes are unknowns in x
    both = scale[:, :, None] * scale[:, None, :]
    K = (at(EI, True) / J**3) @ _PAIRS[2] - (at(N, False) / J) @ _PAIRS[1]
    M = (at(m, True) * J) @ _PAIRS[0]
    K, M = (_assemble(A.reshape(-1, 8, 8) * both) for A in (K, M))
    values, _, failed = lapack.dsygv(K, M, jobz="N", uplo="L", overwrite_a=1, overwrite_b=1)
    assert not failed
    return values[2 : modes + 2]


def _assemble(parts):
    """Dense symmetric matrix in Fortran's order."""
    size, flat = _places(len(parts))
    return np.bincount(flat, parts.ravel(), size * size).reshape(size, size).T


@cache
def _places(n):
    """Size, and where every entry of n elements goes."""
    size, e = 2 * n + 2 + 4 * n, np.arange(n)[:, None]
    dofs = np.hstack([2 * e + np.arange(4), 2 * n + 2 + 4 * e + np.arange(4)])
    return size, (dofs[:, :, None] * size + dofs[:, None, :]).ravel()
