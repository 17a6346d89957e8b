"""A wave: one freedom, eight omega^2 side by side; the bar's and the shaft's equation.

With the bar's signs, u' = -Q/K and Q' = m omega^2 u; in units of the piece q = Q h/K and
c = m omega^2 h^2/K,

    u <- C u - S q,  q <- C q + c S u,     C = cos(sqrt c), S = sin(sqrt c)/sqrt c,

as series. For K = EA, u is X; for K = GJ and m = rho I_p, u is phi and Q is -T.
"""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import math

from .compiling import compiled, wide_vectors
from .pieces import MOST_PIECES, STEP
from .workspace import (
    COMPLIANCE,
    COUNT,
    FLEXIBILITY,
    INERTIA,
    LANES,
    LENGTH,
    MASS,
    OMEGA2,
    RATIO,
    SPRING,
    Q,
    U,
)

ENDS = {"free": 0, "fixed": 1}
_FIXED = 1

_TERMS = 8  # of the series: sqrt(c) is at most STEP
_COSINE = tuple((-1.0) ** k / math.factorial(2 * k) for k in range(_TERMS))
_SINE = tuple((-1.0) ** k / math.factorial(2 * k + 1) for k in range(_TERMS))


@compiled
def count_pieces(h, m, K, omega2, starts):
    """Set the first piece of every segment; return how many pieces reach up to abs(omega2)."""
    total = 0
    for k in range(len(h)):
        starts[k] = total
        wave = math.sqrt(m[k] * omega2 / K[k]) * h[k] / STEP
        if not wave < MOST_PIECES:
            return -1
        total += max(1, math.ceil(wave))
    starts[len(h)] = total
    return total if total < MOST_PIECES else -1


@compiled
def fill_table(h, m, K, starts, marks, table):
    """Fill the table: one column a piece."""
    previous = 1.0
    for k in range(len(h)):
        pieces = starts[k + 1] - starts[k]
        size, f = h[k] / pieces, 1.0 / K[k]
        if marks[k] >= 0 or k == 0:
            previous = 1.0
        for i in range(starts[k], starts[k + 1]):
            table[INERTIA, i], table[RATIO, i] = m[k] * size * size * f, size * f / previous
            table[LENGTH, i], table[FLEXIBILITY, i] = size, f
            previous = size * f


@compiled
def advance(table, state, first, last):
    """Carry the lanes through pieces, and count the changes of sign of u."""
    wide_vectors()
    c0, c1, c2, c3, c4, c5, c6, c7 = _COSINE
    s0, s1, s2, s3, s4, s5, s6, s7 = _SINE
    for i in range(first, last):
        inertia, ratio = table[INERTIA, i], table[RATIO, i]
        for lane in range(LANES):
            c = state[OMEGA2 + lane] * inertia
            C = c0 + c * (c1 + c * (c2 + c * (c3 + c * (c4 + c * (c5 + c * (c6 + c * c7))))))
            S = s0 + c * (s1 + c * (s2 + c * (s3 + c * (s4 + c * (s5 + c * (s6 + c * s7))))))
            u, q = state[U + lane], state[Q + lane] * ratio
            following = C * u - S * q
            state[U + lane], state[Q + lane] = following, C * q + c * S * u
            state[COUNT + lane] += 1.0 if u * following < 0.0 else 0.0


@compiled
def to_chain_units(table, piece, state):
    """Take the force out of the units of a piece."""
    for lane in range(LANES):
        state[Q + lane] /= table[LENGTH, piece] * table[FLEXIBILITY, piece]


@compiled
def start(left, state, sign):
    """Set u and Q of an end."""
    for lane in range(LANES):
        state[(Q if left == _FIXED else U) + lane] = 1.0
        sign[lane] = -1.0 if left == _FIXED else 0.0


@compiled
def pass_point(point, state):
    """Apply mass and spring, and then the joint, of a node."""
    for lane in range(LANES):
        u = state[U + lane]
        force = state[Q + lane] + (state[OMEGA2 + lane] * point[MASS] - point[SPRING]) * u
        following = u - point[COMPLIANCE] * force
        state[COUNT + lane] += 1.0 if u * following < 0.0 else 0.0
        state[U + lane], state[Q + lane] = following, force


@compiled
def finish(right, state, value):
    """Count what the right end leaves free, and set the characteristic function."""
    for lane in range(LANES):
        u, force = state[U + lane], state[Q + lane]
        value[lane] = u if right == _FIXED else force
        state[COUNT + lane] += 1.0 if right != _FIXED and force * u > 0.0 else 0.0


@compiled
def first_samples(h, m, K, number, samples):
    """Set samples between the roots that a slowly varying chain would have."""
    phase = 0.0
    for k in range(len(h)):
        phase += h[k] * math.sqrt(m[k] / K[k])
    for i in range(number):
        samples[i] = ((0.25 + 0.5 * i) * math.pi / phase) ** 2


@compiled
def size_and_unit(omega2, right, carried):
    """Return the size of u and Q at omega^2, and the unit of the characteristic function in it."""
    scale = 1.0 / math.sqrt(abs(omega2) + 1.0)
    return max(abs(carried[0]), abs(carried[1]) * scale), (1.0 if right == _FIXED else scale)
