r"""Lateral motion with shear, rotary inertia or a foundation: eight omega^2 side by side.

The minors of `riccati.lanes.bending`, in the units of a piece (h = 1, EI = 1), obey

    a' = b + s d,  b' = 2 alpha e + s f - beta a,  e' = alpha d,
    d' = f - mu a,  f' = -beta d - mu b,

so that b and d alone obey a second-order equation, ``(b, d)'' = M (b, d)`` with

    M = [[-B, 2 kappa], [-2 mu, -B]],   B = beta + s mu,   kappa = alpha^2 - s beta,

and all follows from four functions G0 ... G3 of B and c = mu kappa alone: those of bending, with B
in place of n (docs/theory/lanes.md). Here both depend on omega^2, and the series run in each lane.
"""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import math

from . import bending
from .compiling import compiled, wide_vectors
from .pieces import MOST_PIECES, fill_ratio, fill_ratios
from .workspace import (
    COUNT,
    COUPLING,
    FLEXIBILITY,
    FOUNDATION,
    GROUND,
    HALF_SHEAR,
    INERTIA,
    KAPPA,
    KAPPA_INERTIA,
    LANES,
    LENGTH,
    OMEGA2,
    RATIO,
    RATIO_D,
    RATIO_E,
    RATIO_F,
    ROTARY_INERTIA,
    SHEAR,
    SHEAR_TURN,
    SHEAR_WORK,
    TURN_FORCE,
    TURN_INERTIA,
    A,
    B,
    D,
    E,
    F,
)

STEP = 0.7
"""Wave number times length of a piece, at most: nine terms reach rounding.

With w of 2 STEP^2 the first that is left out, (k + 1) abs(w)^k / (2k + 1)!, is below 1e-16.
"""

_TERMS = 9
_G0, _G1, _G2, _G3 = (
    tuple(1.0 / math.factorial(2 * k + j) for k in range(_TERMS)) for j in (4, 3, 2, 1)
)


@compiled
def _all_short(h, m, EI, N, more, omega2):
    """Tell whether wave number times length is below the limit in every segment."""
    wide_vectors()
    longer = 0
    for k in range(len(h)):
        square, (b, c) = STEP * STEP / (h[k] * h[k]), _bounds(m, EI, N, more, omega2, k)
        longer += 1 if c > square * (square - b) else 0
    return longer == 0


@compiled
def _bounds(m, EI, N, more, omega2, k):
    """Return bounds on the coefficients of the characteristic equation of a segment."""
    s, alpha, rotary = more[SHEAR, k], 1.0 + more[SHEAR_TURN, k], more[ROTARY_INERTIA, k] * omega2
    inertia, force = m[k] * omega2 + more[GROUND, k], N[k] + more[SHEAR_WORK, k]
    kappa = abs(alpha * alpha - s * force) + s * rotary
    f = 1.0 / EI[k]
    return s * inertia + (abs(force) + rotary) * f, inertia * kappa * f


@compiled
def count_pieces(h, m, EI, N, more, omega2, starts):
    """Set the first piece of every segment; return how many pieces reach up to abs(omega2)."""
    if _all_short(h, m, EI, N, more, omega2):
        for k in range(len(h) + 1):
            starts[k] = k
        return len(h)
    total = 0
    for k in range(len(h)):
        starts[k] = total
        b, c = _bounds(m, EI, N, more, omega2, k)
        wave = math.sqrt(b / 2.0 + math.sqrt(b * b / 4.0 + c)) * h[k] / STEP
        if not wave < MOST_PIECES:
            return -1
        total += max(1, math.ceil(wave))
    starts[len(h)] = total
    return total if total < MOST_PIECES else -1


@compiled
def fill_table(h, m, EI, N, more, starts, marks, table):
    """Fill the table: one column a piece."""
    wide_vectors()
    last = starts[len(h)]
    if last == len(h):
        for k in range(last):
            _fill_piece(h[k], m, EI, N, more, k, k, table)
    else:
        for k in range(len(h)):
            size = h[k] / (starts[k + 1] - starts[k])
            for i in range(starts[k], starts[k + 1]):
                _fill_piece(size, m, EI, N, more, k, i, table)
    fill_ratios(table, last)
    for k in range(len(h)):
        if marks[k] >= 0:
            fill_ratio(table, starts[k])
    fill_ratio(table, 0)


@compiled
def _fill_piece(size, m, EI, N, more, k, i, table):
    """Fill what depends on one piece alone: piece i, of segment k."""
    f, square = 1.0 / EI[k], size * size
    s, alpha, force = more[SHEAR, k], 1.0 + more[SHEAR_TURN, k], N[k] + more[SHEAR_WORK, k]
    rotary = more[ROTARY_INERTIA, k]
    table[LENGTH, i], table[FLEXIBILITY, i], table[INERTIA, i] = size, f, 2.0 * m[k]
    table[FOUNDATION, i] = 2.0 * more[GROUND, k] * (square * square * f)
    table[TURN_FORCE, i], table[TURN_INERTIA, i] = force * square * f, rotary * square * f
    table[HALF_SHEAR, i], table[COUPLING, i] = s / (2.0 * square * f), alpha
    table[KAPPA, i], table[KAPPA_INERTIA, i] = alpha * alpha - s * force, s * rotary


@compiled
def advance(table, state, first, last):
    """Carry the lanes through pieces: equation 74 in minors, and the count of every joint."""
    wide_vectors()
    t0, t1, t2, t3, t4, t5, t6, t7, t8 = _G0
    u0, u1, u2, u3, u4, u5, u6, u7, u8 = _G1
    v0, v1, v2, v3, v4, v5, v6, v7, v8 = _G2
    w0, w1, w2, w3, w4, w5, w6, w7, w8 = _G3
    for i in range(first, last):
        inertia, ground = table[INERTIA, i], table[FOUNDATION, i]
        n, turn = table[TURN_FORCE, i], table[TURN_INERTIA, i]
        half, alpha = table[HALF_SHEAR, i], table[COUPLING, i]
        kappa_0, kappa_1 = table[KAPPA, i], table[KAPPA_INERTIA, i]
        of_b, of_e = table[RATIO, i], table[RATIO_E, i]
        of_d, of_f = table[RATIO_D, i], table[RATIO_F, i]
        for lane in range(LANES):
            omega2 = state[OMEGA2 + lane]
            mu, beta = omega2 * inertia - ground, n + turn * omega2  # mu is twice mu here
            kappa = kappa_0 - kappa_1 * omega2
            b_, c = beta + half * mu, 2.0 * mu * kappa
            p, q = -2.0 * b_, -(b_ * b_ + c)
            r2 = p * p + q
            r3 = p * r2 + q * p
            r4 = p * r3 + q * r2
            r5 = p * r4 + q * r3
            r6 = p * r5 + q * r4
            r7 = p * r6 + q * r5
            r8 = p * r7 + q * r6
            Z = t0 + t1 * p + t2 * r2 + t3 * r3 + t4 * r4 + t5 * r5 + t6 * r6 + t7 * r7 + t8 * r8
            S = u0 + u1 * p + u2 * r2 + u3 * r3 + u4 * r4 + u5 * r5 + u6 * r6 + u7 * r7 + u8 * r8
            C = v0 + v1 * p + v2 * r2 + v3 * r3 + v4 * r4 + v5 * r5 + v6 * r6 + v7 * r7 + v8 * r8
            G3 = w0 + w1 * p + w2 * r2 + w3 * r3 + w4 * r4 + w5 * r5 + w6 * r6 + w7 * r7 + w8 * r8
            Z0, S0 = C + b_ * Z, G3 + b_ * S
            C0 = 1.0 - b_ * Z0 - c * Z
            four = 2.0 * mu
            kZ, kS, kC, mZ, mS, mC = kappa * Z, kappa * S, kappa * C, four * Z, four * S, four * C
            a, b = state[A + lane], state[B + lane] * of_b
            e, d, f = state[E + lane] * of_e, state[D + lane] * of_d, state[F + lane] * of_f
            db, dd = alpha * e + half * f - beta * a, f - mu * a
            y, z = S0 * b + kS * d + Z0 * db + kZ * dd, S0 * d - mS * b + Z0 * dd - mZ * db
            following = a + y + half * z
            sheared = half * (2.0 * S0 - mS)
            trace = (kZ + half * (2.0 * Z0 - half * mZ)) * (2.0 * b + d)
            trace += a * (S0 + 2.0 * kS + sheared)
            state[A + lane] = following
            state[B + lane] = C0 * b + kC * d + S0 * db + kS * dd
            state[E + lane] = e + alpha * z
            state[D + lane] = C0 * d - mC * b + S0 * dd - mS * db
            state[F + lane] = f - mu * y - beta * z
            negative = 1.0 if a * following < 0.0 else (2.0 if trace * a < 0.0 else 0.0)
            state[COUNT + lane] += negative


@compiled
def first_samples(h, m, EI, N, more, number, samples):
    """Set samples between the roots that a slowly varying chain would have.

    Those of bending, softer by shear and rotary inertia, and raised by the foundation.
    """
    bending.first_samples(h, m, EI, N, number, samples)
    phase, softer, raised = 0.0, 0.0, 0.0
    for k in range(len(h)):
        root = math.sqrt(m[k] / EI[k])
        own = h[k] * math.sqrt(root)
        phase += own
        softer += own * (more[SHEAR, k] * EI[k] + more[ROTARY_INERTIA, k] / m[k]) * root
        raised += own * more[GROUND, k] / m[k]
    for i in range(number):
        square = math.sqrt(samples[i])
        samples[i] = samples[i] / (1.0 + square * softer / phase) + raised / phase
