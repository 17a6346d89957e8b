"""Cubic Hermite elements for one uniform segment each, all beams alike.

(EI Y'')'' + (N Y')' = omega^2 m Y; unknowns Y, h theta at the nodes, so that every entry of an
element is a multiple of its EI/h^3, N/h or m h, and all rows of a matrix are one product of what
lies left and right of the nodes with a small table.
"""

import numpy as np

BENDING = np.array([[12.0, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]])
GEOMETRIC = np.array([[36.0, 3, -36, 3], [3, 4, -3, -1], [-36, -3, 36, -3], [3, -1, -3, 4]]) / 30
MASS = (
    np.array([[156.0, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]]) / 420
)


def _columns(element):
    """Diagonal and what is above it in LAPACK's upper band, for a node's two unknowns, (2, 8)."""
    table = np.zeros((2, 2, 4))
    for side, first in enumerate((2, 0)):
        for j in (first, first + 1):
            table[side, j - first, 3 - j :] = element[: j + 1, j]
    return table.reshape(2, 8)


def _rows(element):
    """A node's two rows, from the node before to the one behind, (2, 12)."""
    table = np.zeros((2, 2, 6))
    table[0, :, :4], table[1, :, 2:] = element[2:], element[:2]
    return table.reshape(2, 12)


COLUMNS = np.vstack([_columns(element) for element in (BENDING, GEOMETRIC, MASS)])
MASS_ROWS = _rows(MASS)


def sides(h, m, EI, N):
    """EI/h^3, -N/h and m h of the segments left and right of every node, (n + 1, 6)."""
    S = np.zeros((len(m) + 1, 6))
    for k, values in enumerate((EI * h**-3, N * (-1 / h), m * h)):
        S[1:, 2 * k] = S[:-1, 2 * k + 1] = values
    return S


def band(S, columns):
    """Upper band (4, 2n + 2) in Fortran's order."""
    return (S @ columns).reshape(-1, 4).T


def bands(h, m, EI, N):
    """Stiffness less the axial force's, and mass, for equal segments of length h."""
    S = sides(h, m, EI, N)
    return band(S[:, :4], COLUMNS[:4]), band(S[:, 4:], COLUMNS[4:])


def full(upper):
    """Upper triangle of the dense matrix, in Fortran's order."""
    n = upper.shape[1]
    A = np.zeros(n * n)
    for d in range(4):
        A[d * n :: n + 1] = upper[3 - d, d:]
    return A.reshape(n, n).T
