r"""Bending: eight omega^2 side by side through pieces, points and ends.

What the Riccati form carries as a frame (`riccati.chain`) travels here as its 2 x 2 minors,
``a = Y^theta, b = Y^M, e = Y^Q = theta^M, d = theta^Q, f = M^Q`` (x^y: the minor of those rows).
They determine the plane, ``K = P S = [[d, -e], [-e, b]] / a``, obey a linear equation,

    a' = b/EI,  b' = 2e - N a,  e' = d,  d' = f/EI - m omega^2 a,  f' = -N d - m omega^2 b,

and so need neither division nor orthonormalisation. ``a`` is det A, and the characteristic
function of every end is one of the five. Counts are those of Wittrick and Williams, joint by joint
in segments too short for roots of their own.
"""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import math

from .compiling import compiled, wide_vectors
from .workspace import (
    CARRIED,
    CENTRAL,
    COMPLIANCE,
    COUNT,
    COUPLING,
    FIRST_MOMENT,
    FLEXIBILITY,
    FORCE,
    HOLDS_THETA,
    HOLDS_Y,
    INERTIA,
    LANES,
    LENGTH,
    LOWER,
    MASS,
    OMEGA2,
    POWER,
    RATIO,
    RATIO_D,
    RATIO_E,
    RATIO_F,
    ROTARY,
    SERIES_0,
    SERIES_1,
    SERIES_2,
    SERIES_3,
    SPRING,
    SPRUNG,
    TURNING,
    UPPER,
    A,
    B,
    D,
    E,
    F,
)

ENDS = {"free": 0, "clamped": 1, "pinned": 2, "sliding": 3}
_FREE, _CLAMPED, _PINNED, _SLIDING = range(4)


@compiled
def advance(table, state, first, last):
    """Carry the lanes through pieces: equation 74 in minors, and the count of every joint."""
    wide_vectors()
    for i in range(first, last):
        a0, a1 = table[SERIES_0, i], table[SERIES_0 + 1, i]
        a2, a3 = table[SERIES_0 + 2, i], table[SERIES_0 + 3, i]
        b0, b1 = table[SERIES_1, i], table[SERIES_1 + 1, i]
        b2, b3 = table[SERIES_1 + 2, i], table[SERIES_1 + 3, i]
        c0, c1 = table[SERIES_2, i], table[SERIES_2 + 1, i]
        c2, c3 = table[SERIES_2 + 2, i], table[SERIES_2 + 3, i]
        d0, d1 = table[SERIES_3, i], table[SERIES_3 + 1, i]
        d2, d3 = table[SERIES_3 + 2, i], table[SERIES_3 + 3, i]
        n, inertia = table[FORCE, i], table[INERTIA, i]
        of_b, of_e = table[RATIO, i], table[RATIO_E, i]
        of_d, of_f = table[RATIO_D, i], table[RATIO_F, i]
        for lane in range(LANES):
            c = state[OMEGA2 + lane] * inertia
            G0 = a0 + c * (a1 + c * (a2 + c * a3))
            G1 = b0 + c * (b1 + c * (b2 + c * b3))
            G2 = c0 + c * (c1 + c * (c2 + c * c3))
            G3 = d0 + c * (d1 + c * (d2 + c * d3))
            h0, h1, h2, h3 = c * G0, c * G1, c * G2, c * G3
            w, v = G2 + n * G0, G3 + n * G1
            u, s = h2 - n * h0, h3 - n * h1
            p = 1.0 - n * w - h0
            q, r, t = p - h0, n * v + h1, 1.0 - 2.0 * h0
            a, b = state[A + lane], state[B + lane] * of_b
            e, d, f = state[E + lane] * of_e, state[D + lane] * of_d, state[F + lane] * of_f
            following = p * a + v * b + w * e + G1 * d + G0 * f
            trace = G0 * (2.0 * b + d) + a * (2.0 * G1 + v)
            state[A + lane] = following
            state[B + lane] = q * b - r * a + v * e + G2 * d + G1 * f
            state[E + lane] = t * e - u * a - (h1 + h1) * b + v * d + w * f
            state[D + lane] = q * d - s * a - (h2 + h2) * b - (h1 + h1) * e + v * f
            state[F + lane] = (n * (h2 + h2) + c * h0) * a - s * b - u * e - r * d + p * f
            negative = 1.0 if a * following < 0.0 else (2.0 if trace * a < 0.0 else 0.0)
            state[COUNT + lane] += negative


@compiled
def to_chain_units(table, piece, state):
    """Take the minors out of the units of a piece."""
    h, f = table[LENGTH, piece], table[FLEXIBILITY, piece]
    for lane in range(LANES):
        state[B + lane] /= h * f
        state[E + lane] /= h * h * f
        state[D + lane] /= h * h * h * f
        state[F + lane] /= h * h * h * h * f * f


@compiled
def start(left, state, sign):
    """Set the minors of an end: free (theta and Y), clamped, pinned, sliding."""
    row, value = A, 1.0
    if left == _CLAMPED:
        row, value = F, 2.0
    elif left == _PINNED:
        row, value = D, 2.0
    elif left == _SLIDING:
        row = B
    for lane in range(LANES):
        state[row + lane] = value
        sign[lane] = 1.0 if left != _FREE else 0.0


@compiled
def pass_point(point, state, sign):
    """Apply support, load and joint of a node (`riccati.points`)."""
    hold_Y, hold_theta = point[HOLDS_Y] != 0.0, point[HOLDS_THETA] != 0.0
    for lane in range(LANES):
        a, b, e = state[A + lane], state[B + lane], state[E + lane] / 2
        d, f, omega2 = state[D + lane] / 2, state[F + lane] / 2, state[OMEGA2 + lane]
        before = a if a != 0.0 else sign[lane]
        if hold_Y and hold_theta:
            a, b, e, d, f = 0.0, 0.0, 0.0, 0.0, a
        elif hold_Y:
            a, b, e, d, f = 0.0, 0.0, 0.0, -a, -b
        elif hold_theta:
            a, b, e, d, f = 0.0, a, 0.0, 0.0, d
        moment, coupling = omega2 * point[FIRST_MOMENT], point[COUPLING]
        across = moment - coupling
        along = omega2 * point[MASS] - point[SPRING]
        if point[SPRUNG] != 0.0:
            # its stiffness is n/g: all minors times g, which changes its sign at the pole
            inertia, springs = omega2 * point[SPRUNG], point[UPPER] + point[LOWER]
            size = 1.0 / math.sqrt(springs * springs + inertia * inertia)
            g = (springs - inertia) * size
            n = point[UPPER] * (point[LOWER] - inertia) * size
            state[COUNT + lane] += 1.0 if g < 0.0 else 0.0
            before = -before if g < 0.0 else before
            d, f = g * d + n * a, g * f + n * b
            a, b, e = g * a, g * b, g * e
        turn = point[TURNING] - omega2 * point[ROTARY]
        own = (
            omega2 * point[MASS] * (point[TURNING] - omega2 * point[CENTRAL]) - point[SPRING] * turn
        )
        own += coupling * (coupling - 2.0 * moment)
        f += turn * d - 2.0 * across * e - along * b - own * a
        b, e, d = b + turn * a, e + across * a, d - along * a
        sign[lane] = -before if hold_Y and not hold_theta else before
        a, d = a + point[COMPLIANCE] * b, d + point[COMPLIANCE] * f
        if a != 0.0:
            state[COUNT + lane] += 1.0 if sign[lane] * a < 0.0 else 0.0
            sign[lane] = 0.0
        state[A + lane], state[B + lane], state[E + lane] = a, b, 2.0 * e
        state[D + lane], state[F + lane] = 2.0 * d, 2.0 * f


@compiled
def finish(right, state, value):
    """Count what the right end leaves free, and set the characteristic function."""
    for lane in range(LANES):
        a, b, d, f = state[A + lane], state[B + lane], state[D + lane], state[F + lane]
        more = 0.0
        if right == _FREE:
            value[lane] = f
            more = 1.0 if f * a < 0.0 else (2.0 if (2.0 * b + d) * a < 0.0 else 0.0)
        elif right == _CLAMPED:
            value[lane] = a
        elif right == _PINNED:
            value[lane] = b
            more = 1.0 if b * a < 0.0 else 0.0
        else:
            value[lane] = d
            more = 1.0 if d * a < 0.0 else 0.0
        state[COUNT + lane] += more


@compiled
def follow_start(kappa, state):
    """Set what a left end admits whose force follows: Y^Q beside Y^theta."""
    for lane in range(LANES):
        state[E + lane] += kappa


@compiled
def follow_finish(sigma, kappa, state, value):
    """Set the characteristic function of a right end whose force follows."""
    for lane in range(LANES):
        power = state[POWER + lane]
        own = sigma if power == 0.0 else math.ldexp(sigma, -int(power))
        value[lane] = state[F + lane] + kappa * (state[E + lane] - own)


@compiled
def first_samples(h, m, EI, N, number, samples):
    """Set samples between the roots that a slowly varying chain would have.

    The phase integral of the oscillating wave number (equation 51) with one mean N/EI for all.
    """
    phase, load = 0.0, 0.0
    for k in range(len(h)):
        root = math.sqrt(m[k] / EI[k])
        own = h[k] * math.sqrt(root)
        phase += own
        load += own * N[k] / (EI[k] * root)
    for i in range(number):
        square = ((0.25 + 0.5 * i) * math.pi / phase) ** 2
        samples[i] = max(square * (square - load / phase), 0.01 * square * square)


@compiled
def size_and_unit(omega2, force, right, carried):
    """Return the size of minors at omega^2, and the unit of the characteristic function in it."""
    scale = 1.0 / math.sqrt(math.sqrt(abs(omega2) + force * force + 1.0))
    square = scale * scale
    of_e, of_d, of_f = square / 2, scale * square / 2, square * square / 2
    size = max(abs(carried[0]), abs(carried[1]) * scale, abs(carried[2]) * of_e)
    size = max(size, abs(carried[3]) * of_d, abs(carried[CARRIED - 1]) * of_f)
    if right == _FREE:
        return size, of_f
    if right == _CLAMPED:
        return size, 1.0
    return size, (scale if right == _PINNED else of_d)
