"""Hermite elements, their dynamic stiffness in bands: one complex solve for each frequency.

Stiffness and mass are made once, in bands; each frequency is one product into an array that is
kept, and `scipy.linalg.solve_banded`, or LAPACK's zgbsv in place, as lean as Python calls it.
"""

from itertools import pairwise

import numpy as np
from scipy.linalg import solve_banded
from scipy.linalg.lapack import zgbsv

_BANDS = 3  # on either side of the diagonal


def _element(h, EI, m):
    stiff = EI / h**3 * np.array(
        [[12, 6 * h, -12, 6 * h], [6 * h, 4 * h**2, -6 * h, 2 * h**2],
         [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h**2, -6 * h, 4 * h**2]]
    )  # fmt: skip
    mass = m * h / 420 * np.array(
        [[156, 22 * h, 54, -13 * h], [22 * h, 4 * h**2, 13 * h, -3 * h**2],
         [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h**2, -22 * h, 4 * h**2]]
    )  # fmt: skip
    return stiff, mass


class Banded:
    """A beam that is clamped on its left, with a loss factor."""

    def __init__(self, own, eta):
        size, rows = 2 * len(own.x), 3 * _BANDS + 1  # zgbsv needs room for what fills in
        K, M = np.zeros((rows, size)), np.zeros((rows, size))
        for k, (a, b) in enumerate(pairwise(own.x.tolist())):
            parts = _element(b - a, own.bending_stiffness[k, 0], own.mass_per_length[k, 0])
            for i in range(4):
                for j in range(4):
                    for whole, part in zip((K, M), parts, strict=True):
                        whole[2 * _BANDS + i - j, 2 * k + j] += part[i, j]
        self.K = np.asfortranarray(K[:, 2:] * (1 + 1j * eta))
        self.M = np.asfortranarray(M[:, 2:].astype(complex))

    def scipy(self, omega, force, outputs):
        """Return the same by scipy's own function for bands."""
        K, M = (np.ascontiguousarray(A[_BANDS:]) for A in (self.K, self.M))
        D, load = np.empty_like(K), np.zeros(K.shape[1], complex)
        load[force] = 1.0
        H, bands = np.empty((len(omega), len(outputs)), complex), (_BANDS, _BANDS)
        for k, w in enumerate(omega.tolist()):
            np.multiply(M, -w * w, out=D)
            D += K
            H[k] = solve_banded(bands, D, load, overwrite_ab=True, check_finite=False)[outputs]
        return H.T

    def __call__(self, omega, force, outputs):
        """Return the displacements of unknowns under a unit force on one, (outputs, k)."""
        D, load = np.empty_like(self.K), np.zeros((self.K.shape[1], 1), complex, order="F")
        H = np.empty((len(omega), len(outputs)), complex)
        for k, w in enumerate(omega.tolist()):
            np.multiply(self.M, -w * w, out=D)
            D += self.K
            load[:] = 0.0
            load[force] = 1.0
            _, _, u, info = zgbsv(_BANDS, _BANDS, D, load, overwrite_ab=True, overwrite_b=True)
            assert info == 0
            H[k] = u[outputs, 0]
        return H.T
