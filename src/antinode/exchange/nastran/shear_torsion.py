"""How cross-sections give way to shear and to torsion.

Shear: `K = I^2/(A int S^2/b dt)` with the width b across the direction t of the force and the first
moment S of what lies beyond t: the energy of Jourawski's stresses (Gere and Timoshenko, Mechanics
of Materials, form factor for shear, `K = 1/f_s`), which gives the 5/6 of a bar. Of circles and
rings by Cowper (1966), as MYSTRAN has it too.

Torsion: of a rectangle by Saint-Venant's series (Timoshenko and Goodier, Theory of Elasticity,
equation 160); of an open section the sum of its rectangles, a lower bound; of closed cells by Bredt
`J = 4 A^T D^-1 A`, D being the sums of length over thickness of their walls (the same book, 104).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from antinode.arrays import Array

_ZETA_5 = 1.0369277551433699
"""Sum of 1/n^5, of which the odd n make up 31/32."""
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(30)


def shear_factor(at: Array, width: Array) -> float:
    """Return K of a section whose width runs linearly between places.

    Parameters
    ----------
    at : array, shape (n + 1,)
        Along the force.
    width : array, shape (n, 2)
        Across it, at both ends of each piece.
    """
    size = np.diff(at)
    s = (_POINTS + 1) / 2
    t = at[:-1, None] + size[:, None] * s
    b = width[:, :1] + (width[:, 1:] - width[:, :1]) * s
    w = size[:, None] * _WEIGHTS / 2
    A = float(np.sum(w * b))
    t = t - np.sum(w * b * t) / A
    I, whole = float(np.sum(w * b * t**2)), np.sum(w * b * t, axis=1)  # noqa: E741
    start = np.append(0.0, np.cumsum(whole)[:-1])
    slope = (width[:, 1:] - width[:, :1]) / size[:, None]
    d, left = t - (t[:, :1] - size[:, None] * s[0]), t[:, :1] - size[:, None] * s[0]
    # the integral of b t from the left end of a piece: b0 + slope d, left + d
    moment = width[:, :1] * (left * d + d**2 / 2) + slope * (left * d**2 / 2 + d**3 / 3)
    S = start[:, None] + moment
    return I**2 / (A * float(np.sum(w * S**2 / b)))


def shear_factor_of_ring(outer: float, inner: float, nu: float) -> float:
    """Return K of a circle with a hole, of Poisson's ratio nu."""
    m2 = (inner / outer) ** 2
    top = 6 * (1 + nu) * (1 + m2) ** 2
    return top / ((7 + 6 * nu) * (1 + m2) ** 2 + (20 + 12 * nu) * m2)


def rectangle_in_torsion(d1: float, d2: float) -> float:
    """Return J of a rectangle."""
    a, b = max(d1, d2), min(d1, d2)
    if not b > 0:
        return 0.0
    n = np.arange(1, 20, 2)
    rest = 2 / (np.exp(np.minimum(n * math.pi * a / b, 700.0)) + 1) / n**5
    series = 31 / 32 * _ZETA_5 - float(np.sum(rest))
    return a * b**3 / 3 * (1 - 192 / math.pi**5 * b / a * series)


def cells_in_torsion(areas: Sequence[float], around: Sequence[float], between: float) -> float:
    """Return J of one closed cell, or of two that share a wall.

    Parameters
    ----------
    areas : sequence of float
        Within the middle lines of the walls.
    around : sequence of float
        Sums of length over thickness of the walls around each.
    between : float
        The same of the wall between them; 0 for one cell.
    """
    A, D = np.array(areas), np.diag(np.array(around, dtype=float))
    D[~np.eye(len(A), dtype=bool)] = -between
    return float(4 * A @ np.linalg.solve(D, A))
