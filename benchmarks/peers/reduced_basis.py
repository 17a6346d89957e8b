"""Where loads alone vary: a Galerkin basis of exact modes at a few conditions.

The beam is the chain itself: mass, stiffness and work of the axial force are integrals over the
exact shapes, by Gauss points, once. A case is then a small dense eigenproblem with the load as its
factor, and many cases are a stack of them.
"""

import numpy as np
from scipy.linalg import eigh

import antinode as an


class ReducedBasis:
    """Basis for one structure under factor times one distribution of N."""

    def __init__(self, h, m, EI, N, factors, modes=8, points=8):
        x = np.concatenate([[0.0], np.cumsum(h)])
        gauss, weight = np.polynomial.legendre.leggauss(points)
        grid = (x[:-1, None] + (gauss + 1) / 2 * h[:, None]).ravel()
        w = (weight / 2 * h[:, None]).ravel()
        segment = np.repeat(np.arange(len(h)), points)
        shapes = []
        for factor in factors:
            beam = an.Beam.from_stations(x, m, EI, None, factor * N)
            result = an.solve_modes(beam, modes - 2, families=("bending",))
            shapes.append(result.at(grid))
        Y, theta, M = (np.concatenate(shapes, axis=1)[..., i].T for i in range(3))
        mass = (Y * (w * m[segment])) @ Y.T
        size = 1 / np.sqrt(np.diag(mass))
        values, Q = eigh(mass * size[:, None] * size)
        keep = values > 1e-11
        T = (Q[:, keep] / np.sqrt(values[keep])).T * size
        self.K = T @ ((M * (w / EI[segment])) @ M.T) @ T.T
        self.G = T @ ((theta * (w * N[segment])) @ theta.T) @ T.T

    def omega2(self, factors, modes):
        """One row of eigenvalues for every factor, all small problems in one call."""
        K = self.K - np.multiply.outer(factors, self.G)
        return np.linalg.eigvalsh(K)[:, 2 : 2 + modes]
