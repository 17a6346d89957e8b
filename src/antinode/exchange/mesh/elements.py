"""Matrices of plane beam elements as solvers have them: three freedoms a node, along x, y, about z.

`bars`: the CBAR of NASTRAN's. Cubic shape functions, shear by `phi = 12 EI/(kGA h^2)`, half of the
mass and of the rotary inertia at either end. N acts as a chain of taut strings,
`N/h (v2 - v1)^2`, or by the shape functions.
`solids`: the B32R of CalculiX, a row of solid elements. Three nodes, quadratic, two points of
integration, shear and rotary inertia of the section. Strain is Green's: after a linear static step
a fibre shortened by `e = N/EA` has `(1 - 3 e)` times its stiffness, and a section that turns by psi
shears it by `v' - (1 - e) psi`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from antinode.arrays import Array

Kind = Literal["bars", "bars by strings", "solids"]


@dataclass(frozen=True)
class Matrices:
    """Stiffness, mass, and what a compression of the elements takes off the stiffness.

    Attributes
    ----------
    K, M, G : array, shape (d, d)
        d is 6 for two nodes, 9 for three: along x, along y, about z of each.
    """

    K: Array
    M: Array
    G: Array


class Bar(NamedTuple):
    """An element: length, stiffness, mass, N, shear (inf is rigid) and rotary inertia."""

    h: float
    EI: float
    EA: float
    m: float
    N: float
    kGA: float
    rotary: float


def bar(own: Bar, *, strings: bool) -> Matrices:
    """Return an element of two nodes."""
    h, EI, EA, m, N = own[:5]
    K, G = np.zeros((6, 6)), np.zeros((6, 6))
    bending = np.ix_([1, 2, 4, 5], [1, 2, 4, 5])
    phi = 12 * EI / (own.kGA * h**2)
    K[bending] = EI / ((1 + phi) * h**3) * _cubic(h, 12, 6, 4 + phi, 2 - phi)
    K[np.ix_([0, 3], [0, 3])] = EA / h * np.array([[1, -1], [-1, 1]])
    if strings:
        G[np.ix_([1, 4], [1, 4])] = N / h * np.array([[1, -1], [-1, 1]])
    else:
        G[bending] = N / (30 * h) * _cubic(h, 36, 3, 4, -1)
    turning = own.rotary / m
    return Matrices(K, np.diag(m * h / 2 * np.array([1, 1, turning, 1, 1, turning])), G)


def _cubic(h: float, a: float, b: float, c: float, d: float) -> Array:
    return np.array(
        [
            [a, b * h, -a, b * h],
            [b * h, c * h**2, -b * h, d * h**2],
            [-a, -b * h, a, -b * h],
            [b * h, d * h**2, -b * h, c * h**2],
        ]
    )


def solid(own: Bar, *, strained: bool) -> Matrices:
    """Return an element of three nodes; strained by N, or about to be.

    Its rotary inertia is that of a solid, m EI/EA.
    """
    h, EI, EA, m, N, kGA, _ = own
    K, M, G = np.zeros((9, 9)), np.zeros((9, 9)), np.zeros((9, 9))
    gyration2, e = EI / EA, N / EA if strained else 0.0
    for s in (-1 / math.sqrt(3), 1 / math.sqrt(3)):
        f = np.array([s * (s - 1) / 2, 1 - s**2, s * (s + 1) / 2])
        g = np.array([s - 0.5, -2 * s, s + 0.5]) * 2 / h
        zero = np.zeros(3)
        stretch, curvature = _row(g, zero, zero), _row(zero, zero, g)
        shear, slope = _row(zero, g, -(1 - e) * f), _row(zero, g, zero)
        w = h / 2
        K += (
            w
            * (1 - 3 * e)
            * (EA * np.outer(stretch, stretch) + EI * np.outer(curvature, curvature))
        )
        K += w * kGA * np.outer(shear, shear)
        G += w * N * np.outer(slope, slope)
        if not strained:
            G += w * N * gyration2 * np.outer(curvature, curvature)
        for row, inertia in ((_row(f, zero, zero), m), (_row(zero, f, zero), m),
                             (_row(zero, zero, f), m * gyration2)):  # fmt: skip
            M += w * inertia * np.outer(row, row)
    return Matrices(K, M, G)


def _row(u: Array, v: Array, turn: Array) -> Array:
    return np.stack([u, v, turn], axis=1).ravel()
