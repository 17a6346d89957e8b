"""Elements with shear and rotary inertia for one uniform segment each, exact in statics without N.

Displacement and rotation between the nodes are those of a segment that is bent and sheared by its
ends alone, with ``phi = 12 EI/(kGA h^2)``; unknowns Y, h psi at the nodes. The axial force acts as
Haringx has it, ``-N (Y' psi - psi^2/2)``. Each element is a polynomial in phi over (1 + phi)^2: all
rows of a matrix are one product, as in `hermite`.
"""

import numpy as np
from numpy.polynomial import polynomial

from .hermite import _columns, _rows
from .subspace import Subspace

# Y and h psi over (1 + phi), rows the four unknowns, columns x^0 ... x^3, for phi^0 and phi^1
_Y = np.array([
    [[1, 0, -3, 2], [0, 1, -2, 1], [0, 0, 3, -2], [0, 0, -1, 1]],
    [[1, -1, 0, 0], [0, 0.5, -0.5, 0], [0, 1, 0, 0], [0, -0.5, 0.5, 0]],
])  # fmt: skip
_PSI = np.array([
    [[0, -6, 6, 0], [1, -4, 3, 0], [0, 6, -6, 0], [0, -2, 3, 0]],
    [[0, 0, 0, 0], [1, -1, 0, 0], [0, 0, 0, 0], [0, 1, 0, 0]],
])  # fmt: skip


def _products(a, b):
    """Integrals of a_i b_j over 0 ... 1 for phi^0, phi^1, phi^2, (3, 4, 4)."""
    found = np.zeros((3, 4, 4))
    for p in range(2):
        for q in range(2):
            for i, j in np.ndindex(4, 4):
                whole = polynomial.polyint(polynomial.polymul(a[p, i], b[q, j]))
                found[p + q, i, j] += whole.sum()
    return found


_SLOPE = np.array([[polynomial.polyder(row) for row in part] for part in _Y])
_BENT = np.array([[polynomial.polyder(row) for row in part] for part in _PSI])
_SHEARED = np.array([
    [polynomial.polysub(np.append(y, 0.0), psi) for y, psi in zip(*parts, strict=True)]
    for parts in zip(_SLOPE, _PSI, strict=True)
])  # fmt: skip
_ACROSS = _products(_SLOPE, _PSI)
# of EI/h^3, kGA/h, -N/h, m h, rho I/h
_TABLES = (
    _products(_BENT, _BENT),
    _products(_SHEARED, _SHEARED),
    _ACROSS + _ACROSS.transpose(0, 2, 1) - _products(_PSI, _PSI),
    _products(_Y, _Y),
    _products(_PSI, _PSI),
)
_MASSES = 6
"""Of the tables' parts, those that vibrate stand last."""


def sides(h, m, EI, N, kGA, rotary):
    """What multiplies the tables left and right of every node, (n + 1, 30)."""
    phi = 12 * EI / (kGA * (h * h))
    powers = np.stack([np.ones_like(phi), phi, phi * phi]) / (1 + phi) ** 2
    S = np.zeros((len(m) + 1, 30))
    given = EI * h**-3, kGA / h, N * (-1 / h), m * h, rotary / h
    for k, values in enumerate(given):
        for p in range(3):
            column = 2 * (3 * k + p)
            S[1:, column] = S[:-1, column + 1] = values * powers[p]
    return S


class TimoshenkoSubspace(Subspace):
    """Banded Cholesky and block subspace iteration with these elements."""

    columns = np.vstack([_columns(element) for table in _TABLES for element in table])
    mass_rows = np.vstack([_rows(element) for table in _TABLES[3:] for element in table])
    elastic = 30 - 2 * _MASSES
    sides = staticmethod(sides)
