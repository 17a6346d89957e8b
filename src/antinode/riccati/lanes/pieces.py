r"""Bending in pieces that are short enough, as a table of one column a piece.

In a piece of length h, with n = N h^2/EI and c = m omega^2 h^4/EI, the minors of a frame
(`riccati.lanes.bending`) are made of one function G0 and its derivatives G1, G2, G3,

    G0^(5) + 2n G0''' + (n^2 + 4c) G0' = 0,   G0''''(0) = 1, all lower ones zero,

polynomials in c whose coefficients depend on the piece alone (docs/theory/lanes.md).
"""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import math

import numpy as np

from antinode.riccati.arrays import Array

from .compiling import compiled, wide_vectors
from .workspace import FLEXIBILITY, FORCE, INERTIA, LENGTH, RATIO, RATIO_D, RATIO_E, RATIO_F

STEP = 0.6
"""Wave number times length of a piece, at most: four terms in c reach rounding."""

MOST_PIECES = 4e6
IN_C, IN_N = 4, 9
"""Terms of the series in c and in n."""

_FEW_UP_TO = 8e-3  # of n: its fifth power times 6/11! is below rounding, five terms do


def _series() -> Array:
    """Return T[m, j, i]: ``G_m = sum of T[m, j, i] (2c)^j n^i``."""
    T = np.zeros((4, IN_C, IN_N))
    for m, j, i in np.ndindex(*T.shape):
        binomial = math.comb(2 * j + 1 + i, i) * (-1) ** i
        T[m, j, i] = (-2.0) ** j * binomial / math.factorial(4 * j + 4 + 2 * i - m)
    return T


SERIES = _series()


@compiled
def _all_short(h, m, EI, N, omega2):
    """Tell whether wave number times length is below the limit in every segment."""
    wide_vectors()
    longer = 0
    for k in range(len(h)):
        s = STEP * STEP / (h[k] * h[k])
        longer += 1 if m[k] * omega2 > s * (s * EI[k] - abs(N[k])) else 0
    return longer == 0


@compiled
def count_pieces(h, m, EI, N, omega2, starts):
    """Set the first piece of every segment; return how many pieces reach up to abs(omega2)."""
    if _all_short(h, m, EI, N, omega2):
        for k in range(len(h) + 1):
            starts[k] = k
        return len(h)
    total = 0
    for k in range(len(h)):
        starts[k] = total
        b = abs(N[k]) / EI[k] / 2
        wave = math.sqrt(b + math.sqrt(b * b + m[k] * omega2 / EI[k])) * h[k] / STEP
        if not wave < MOST_PIECES:
            return -1
        total += max(1, math.ceil(wave))
    starts[len(h)] = total
    return total if total < MOST_PIECES else -1


@compiled
def fill_table(h, m, EI, N, starts, marks, table):
    """Fill the table: one column a piece."""
    wide_vectors()
    n, inertia, length = table[FORCE], table[INERTIA], table[LENGTH]
    flexibility, last = table[FLEXIBILITY], starts[len(h)]
    if last == len(h):
        for k in range(last):
            length[k], flexibility[k] = h[k], 1.0 / EI[k]
            n[k], inertia[k] = N[k] * (h[k] * h[k] / EI[k]), 2.0 * m[k]
    else:
        for k in range(len(h)):
            pieces = starts[k + 1] - starts[k]
            size, f = h[k] / pieces, 1.0 / EI[k]
            for i in range(starts[k], starts[k + 1]):
                length[i], flexibility[i] = size, f
                n[i], inertia[i] = N[k] * (size * size * f), 2.0 * m[k]
    fill_ratios(table, last)
    for k in range(len(h)):
        if marks[k] >= 0:
            fill_ratio(table, starts[k])
    fill_ratio(table, 0)
    _fill_series(table, last)


@compiled
def fill_ratios(table, last):
    """Fill what depends on the units of a piece and of the one before; and complete 2c/omega^2."""
    wide_vectors()
    inertia, length, flexibility = table[INERTIA], table[LENGTH], table[FLEXIBILITY]
    of_b, of_e, of_d, of_f = table[RATIO], table[RATIO_E], table[RATIO_D], table[RATIO_F]
    for i in range(last):
        square = length[i] * length[i]
        inertia[i] *= square * square * flexibility[i]
    for i in range(1, last):
        r, s = length[i] / length[i - 1], flexibility[i] / flexibility[i - 1]
        first, second = r * s, r * r * s
        of_b[i], of_e[i], of_d[i], of_f[i] = first, second, r * second, second * second


@compiled
def fill_ratio(table, i):
    """Fill the ratios of the units of one piece to those of the chain."""
    r, s = table[LENGTH, i], table[FLEXIBILITY, i]
    table[RATIO, i], table[RATIO_E, i] = r * s, r * r * s
    table[RATIO_D, i], table[RATIO_F, i] = r * r * r * s, r * r * r * r * s * s


@compiled
def _fill_series(table, last):
    """Fill the coefficients of the series, which follow from n."""
    wide_vectors()
    n, most = table[FORCE], 0.0
    for i in range(last):
        most = max(most, abs(n[i]))
    few = most < _FEW_UP_TO
    for g in range(4):
        for j in range(IN_C):
            row, t = table[4 * g + j], SERIES[g, j]
            t0, t1, t2, t3, t4, t5, t6, t7, t8 = (
                t[0],
                t[1],
                t[2],
                t[3],
                t[4],
                t[5],
                t[6],
                t[7],
                t[8],
            )
            if few:
                for i in range(last):
                    x = n[i]
                    row[i] = t0 + x * (t1 + x * (t2 + x * (t3 + x * t4)))
                continue
            for i in range(last):
                x = n[i]
                row[i] = t0 + x * (
                    t1 + x * (t2 + x * (t3 + x * (t4 + x * (t5 + x * (t6 + x * (t7 + x * t8))))))
                )


@compiled
def refill_force(N, starts, table):
    """Fill what depends on the axial force, for a chain whose other numbers stand in the table."""
    for k in range(len(N)):
        for i in range(starts[k], starts[k + 1]):
            table[FORCE, i] = N[k] * (table[LENGTH, i] * table[LENGTH, i] * table[FLEXIBILITY, i])
    _fill_series(table, starts[len(N)])
