r"""Chains in compiled code: eight omega^2 side by side, counts and roots certified.

What the Riccati form carries as a frame (`riccati.chain`) travels in bending as its 2 x 2 minors,
``a = Y^theta, b = Y^M, e = Y^Q = theta^M, d = theta^Q, f = M^Q`` (x^y: the minor of those rows).
They determine the plane, ``K = P S = [[d, -e], [-e, b]] / a``, obey a linear equation,

    a' = b/EI,  b' = 2e - N a,  e' = d,  d' = f/EI - m omega^2 a,  f' = -N d - m omega^2 b,

and so need neither division nor orthonormalisation. ``a`` is det A, and the characteristic
function of every end is one of the five. In a segment of length h, with n = N h^2/EI and
c = m omega^2 h^4/EI, the solution is made of G0 and its derivatives G1, G2, G3,

    G0^(5) + 2n G0''' + (n^2 + 4c) G0' = 0,   G0''''(0) = 1, all lower ones zero,

polynomials in c whose coefficients depend on the segment alone (docs/theory/lanes.md). Counts are
those of Wittrick and Williams, joint by joint in segments too short for roots of their own.

All numbers are made dimensionless by the chain's length, mean EI and mean m. Python's side of it is
`riccati.lanes.calls`.
"""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import math

import numpy as np

from antinode.riccati import convergence
from antinode.riccati.arrays import Array
from antinode.riccati.reasons import (
    CERTIFIED,
    CHAIN_TOO_SMALL,
    CLUSTERED,
    INVALID,
    NOT_BRACKETED,
    NOT_CONVERGED,
    NOT_FINITE,
    OUT_OF_REACH,
    TABLE_TOO_SMALL,
    TOO_MANY_STEPS,
)

from .compiling import compiled, summing, wide_vectors

LANES = 8
ENDS = {"free": 0, "clamped": 1, "pinned": 2, "sliding": 3}
BAR_ENDS = {"free": 4, "fixed": 5}
BAR_FREE, BAR_FIXED = 4, 5
"""Of longitudinal chains: 4 and more tell find_roots that it has one."""

_STEP = 0.6  # wave number times length of a piece, at most: four terms in c reach rounding
_IN_C, _IN_N = 4, 9  # terms of the series in c and in n
_FEW_UP_TO = 8e-3  # of n: its fifth power times 6/11! is below rounding, five terms do
ROWS = 24  # of the table of pieces: 16 coefficients, n, 2c/omega^2, 4 ratios of units, h, 1/EI
_RESCALE = 128  # pieces after which the lanes are scaled
_HUGE = 4e6  # pieces
_SMALL = 1e-60  # of the minors, or 1 over it: what lies between is not scaled


def _series() -> Array:
    """Return T[m, j, i]: ``G_m = sum of T[m, j, i] (2c)^j n^i``."""
    T = np.zeros((4, _IN_C, _IN_N))
    for m, j, i in np.ndindex(*T.shape):
        binomial = math.comb(2 * j + 1 + i, i) * (-1) ** i
        T[m, j, i] = (-2.0) ** j * binomial / math.factorial(4 * j + 4 + 2 * i - m)
    return T


_T = _series()


# --- the table of pieces ----------------------------------------------------------------------


@compiled
def _all_short(h, m, EI, N, omega2):
    """Tell whether wave number times length is below the limit in every segment."""
    wide_vectors()
    longer = 0
    for k in range(len(h)):
        s = _STEP * _STEP / (h[k] * h[k])
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
        wave = math.sqrt(b + math.sqrt(b * b + m[k] * omega2 / EI[k])) * h[k] / _STEP
        if not wave < _HUGE:
            return -1
        total += max(1, math.ceil(wave))
    starts[len(h)] = total
    return total if total < _HUGE else -1


@compiled
def fill_table(h, m, EI, N, starts, marks, table):
    """Fill the table: one column a piece."""
    wide_vectors()
    n, inertia, length, flexibility = table[16], table[17], table[22], table[23]
    last = starts[len(h)]
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
    _fill_ratios(table, last)
    for k in range(len(h)):
        if marks[k] >= 0:
            _fill_ratio(table, starts[k], 1.0, 1.0)
    _fill_ratio(table, 0, 1.0, 1.0)
    _fill_series(table, last)


@compiled
def _fill_ratios(table, last):
    """Fill what depends on the units of a piece and of the one before; and complete 2c/omega^2."""
    wide_vectors()
    inertia, r1, r2, r3, r4 = table[17], table[18], table[19], table[20], table[21]
    length, flexibility = table[22], table[23]
    for i in range(last):
        square = length[i] * length[i]
        inertia[i] *= square * square * flexibility[i]
    for i in range(1, last):
        r, s = length[i] / length[i - 1], flexibility[i] / flexibility[i - 1]
        first, second = r * s, r * r * s
        r1[i], r2[i], r3[i], r4[i] = first, second, r * second, second * second


@compiled
def _fill_ratio(table, i, before_h, before_f):
    """Fill the ratios of the units of one piece to those given."""
    r, s = table[22, i] / before_h, table[23, i] / before_f
    table[18, i], table[19, i] = r * s, r * r * s
    table[20, i], table[21, i] = r * r * r * s, r * r * r * r * s * s


@compiled
def _fill_series(table, last):
    """Fill the coefficients of the series, which follow from n."""
    wide_vectors()
    n, most = table[16], 0.0
    for i in range(last):
        most = max(most, abs(n[i]))
    few = most < _FEW_UP_TO
    for g in range(4):
        for j in range(_IN_C):
            row = table[4 * g + j]
            t0, t1, t2, t3, t4 = _T[g, j, 0], _T[g, j, 1], _T[g, j, 2], _T[g, j, 3], _T[g, j, 4]
            t5, t6, t7, t8 = _T[g, j, 5], _T[g, j, 6], _T[g, j, 7], _T[g, j, 8]
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
def _fill_force(N, starts, table):
    """Fill what depends on the axial force, for a chain whose other numbers stand in the table."""
    for k in range(len(N)):
        for i in range(starts[k], starts[k + 1]):
            table[16, i] = N[k] * (table[22, i] * table[22, i] * table[23, i])
    _fill_series(table, starts[len(N)])


# --- one pass of eight lanes ------------------------------------------------------------------
# state: rows of 8 lanes, one after the other: a, b, 2e, 2d, 2f in the units of the last piece,
# the count, omega^2, and the power of two taken out.


@compiled
def _advance(table, state, first, last):
    """Carry the lanes through pieces: equation 74 in minors, and the count of every joint."""
    wide_vectors()
    for i in range(first, last):
        a0, a1, a2, a3 = table[0, i], table[1, i], table[2, i], table[3, i]
        b0, b1, b2, b3 = table[4, i], table[5, i], table[6, i], table[7, i]
        c0, c1, c2, c3 = table[8, i], table[9, i], table[10, i], table[11, i]
        d0, d1, d2, d3 = table[12, i], table[13, i], table[14, i], table[15, i]
        n, inertia = table[16, i], table[17, i]
        r1, r2, r3, r4 = table[18, i], table[19, i], table[20, i], table[21, i]
        for lane in range(LANES):
            c = state[48 + lane] * inertia
            G0 = a0 + c * (a1 + c * (a2 + c * a3))
            G1 = b0 + c * (b1 + c * (b2 + c * b3))
            G2 = c0 + c * (c1 + c * (c2 + c * c3))
            G3 = d0 + c * (d1 + c * (d2 + c * d3))
            h0, h1, h2, h3 = c * G0, c * G1, c * G2, c * G3
            w, v = G2 + n * G0, G3 + n * G1
            u, s = h2 - n * h0, h3 - n * h1
            p = 1.0 - n * w - h0
            q, r, t = p - h0, n * v + h1, 1.0 - 2.0 * h0
            a, B = state[lane], state[8 + lane] * r1
            E, D, F = state[16 + lane] * r2, state[24 + lane] * r3, state[32 + lane] * r4
            following = p * a + v * B + w * E + G1 * D + G0 * F
            trace = G0 * (2.0 * B + D) + a * (2.0 * G1 + v)
            state[lane] = following
            state[8 + lane] = q * B - r * a + v * E + G2 * D + G1 * F
            state[16 + lane] = t * E - u * a - (h1 + h1) * B + v * D + w * F
            state[24 + lane] = q * D - s * a - (h2 + h2) * B - (h1 + h1) * E + v * F
            state[32 + lane] = (n * (h2 + h2) + c * h0) * a - s * B - u * E - r * D + p * F
            negative = 1.0 if a * following < 0.0 else (2.0 if trace * a < 0.0 else 0.0)
            state[40 + lane] += negative


@compiled
def repeat(table, state, last, times):
    """Pass a free chain a number of times: to be timed."""
    for _ in range(times):
        _start(state, 0)
        _advance(table, state, 0, last)


@compiled
def _rescale(state):
    """Take a power of two out of a lane that grows large or small."""
    for lane in range(LANES):
        size = 0.0
        for row in range(5):
            size = max(size, abs(state[8 * row + lane]))
        if _SMALL < size < 1.0 / _SMALL:
            continue
        power = math.frexp(size)[1]
        for row in range(5):
            state[8 * row + lane] = math.ldexp(state[8 * row + lane], -power)
        state[56 + lane] += power


@compiled
def _to_chain_units(table, piece, state):
    h, f = table[22, piece], table[23, piece]
    for lane in range(LANES):
        state[8 + lane] /= h * f
        state[16 + lane] /= h * h * f
        state[24 + lane] /= h * h * h * f
        state[32 + lane] /= h * h * h * h * f * f


@compiled
def _start(state, left):
    """Set the minors of an end: free (theta and Y), clamped, pinned, sliding."""
    for k in range(48):
        state[k] = 0.0
    row, value = 0, 1.0
    if left == 1:
        row, value = 4, 2.0
    elif left == 2:
        row, value = 3, 2.0
    elif left == 3:
        row = 1
    for lane in range(LANES):
        state[8 * row + lane] = value
        state[56 + lane] = 0.0


@compiled
def _stretch(table, state, first, last, sign):
    """Carry the lanes from one point to the next; at a held node `sign` is compared."""
    if first == last:
        return
    held = False
    for lane in range(LANES):
        held = held or sign[lane] != 0.0
    if held:
        _advance(table, state, first, first + 1)
        for lane in range(LANES):
            state[40 + lane] += 1.0 if sign[lane] * state[lane] < 0.0 else 0.0
            sign[lane] = 0.0
        first += 1
    while last - first > _RESCALE:
        _advance(table, state, first, first + _RESCALE)
        _rescale(state)
        first += _RESCALE
    _advance(table, state, first, last)
    _to_chain_units(table, last - 1, state)


@compiled
def _pass_point(point, state, sign):
    """Apply support, load and joint of a node (`riccati.points`).

    `sign` stands for a where a node is held (a = 0), and is 0 elsewhere.
    """
    hold_Y, hold_theta, joint = point[5] != 0.0, point[6] != 0.0, point[7]
    for lane in range(LANES):
        a, B, E = state[lane], state[8 + lane], state[16 + lane] / 2
        D, F, omega2 = state[24 + lane] / 2, state[32 + lane] / 2, state[48 + lane]
        before = a if a != 0.0 else sign[lane]
        if hold_Y and hold_theta:
            a, B, E, D, F = 0.0, 0.0, 0.0, 0.0, a
        elif hold_Y:
            a, B, E, D, F = 0.0, 0.0, 0.0, -a, -B
        elif hold_theta:
            a, B, E, D, F = 0.0, a, 0.0, 0.0, D
        across, along = omega2 * point[1], omega2 * point[0] - point[3]
        turn = point[4] - omega2 * point[2]
        F += turn * D - 2.0 * across * E - along * B - (across * across + along * turn) * a
        B, E, D = B + turn * a, E + across * a, D - along * a
        sign[lane] = -before if hold_Y and not hold_theta else before
        a, D = a + joint * B, D + joint * F
        if a != 0.0:
            state[40 + lane] += 1.0 if sign[lane] * a < 0.0 else 0.0
            sign[lane] = 0.0
        state[lane], state[8 + lane], state[16 + lane] = a, B, 2.0 * E
        state[24 + lane], state[32 + lane] = 2.0 * D, 2.0 * F
    _rescale(state)


@compiled
def _finish(state, right, value):
    """Count what the right end leaves free, and set the characteristic function."""
    for lane in range(LANES):
        a, B, D, F = state[lane], state[8 + lane], state[24 + lane], state[32 + lane]
        more = 0.0
        if right == 0:
            value[lane] = F
            more = 1.0 if F * a < 0.0 else (2.0 if (2.0 * B + D) * a < 0.0 else 0.0)
        elif right == 1:
            value[lane] = a
        elif right == 2:
            value[lane] = B
            more = 1.0 if B * a < 0.0 else 0.0
        else:
            value[lane] = D
            more = 1.0 if D * a < 0.0 else 0.0
        state[40 + lane] += more


@compiled
def _sweep(table, starts, marks, points, left, right, state, sign, value):
    """Pass the chain from left to right."""
    for lane in range(LANES):
        sign[lane] = 1.0 if left > 0 else 0.0
    _start(state, left)
    first, n = 0, len(starts) - 1
    for node in range(n if len(points) == 0 else 0, n + 1):
        if marks[node] < 0 and node < n:
            continue
        _stretch(table, state, first, starts[node], sign)
        first = starts[node]
        if marks[node] >= 0:
            _pass_point(points[marks[node]], state, sign)
    _rescale(state)
    _finish(state, right, value)


# --- longitudinal chains ----------------------------------------------------------------------
# X' = -Q/EA, Q' = m omega^2 X; in units of the piece q = Q h/EA and c = m omega^2 h^2/EA:
# X <- C X - S q, q <- C q + c S X with C = cos(sqrt c), S = sin(sqrt c)/sqrt c, as series. The
# state has X where bending has a, and q where it has b; the table the rows 17, 18, 22 and 23.

_BAR_TERMS = 8  # of the series: sqrt(c) is at most _STEP
_COSINE = tuple((-1.0) ** k / math.factorial(2 * k) for k in range(_BAR_TERMS))
_SINE = tuple((-1.0) ** k / math.factorial(2 * k + 1) for k in range(_BAR_TERMS))


@compiled
def count_bar_pieces(h, m, EA, omega2, starts):
    """Set the first piece of every segment; return how many pieces reach up to abs(omega2)."""
    total = 0
    for k in range(len(h)):
        starts[k] = total
        wave = math.sqrt(m[k] * omega2 / EA[k]) * h[k] / _STEP
        if not wave < _HUGE:
            return -1
        total += max(1, math.ceil(wave))
    starts[len(h)] = total
    return total if total < _HUGE else -1


@compiled
def fill_bar_table(h, m, EA, starts, marks, table):
    """Fill the table: one column a piece."""
    previous = 1.0
    for k in range(len(h)):
        pieces = starts[k + 1] - starts[k]
        size, f = h[k] / pieces, 1.0 / EA[k]
        if marks[k] >= 0 or k == 0:
            previous = 1.0
        for i in range(starts[k], starts[k + 1]):
            table[17, i], table[18, i] = m[k] * size * size * f, size * f / previous
            table[22, i], table[23, i] = size, f
            previous = size * f


@compiled
def _advance_bar(table, state, first, last):
    """Carry the lanes through pieces, and count the changes of sign of X."""
    wide_vectors()
    c0, c1, c2, c3, c4, c5, c6, c7 = _COSINE
    s0, s1, s2, s3, s4, s5, s6, s7 = _SINE
    for i in range(first, last):
        inertia, ratio = table[17, i], table[18, i]
        for lane in range(LANES):
            c = state[48 + lane] * inertia
            C = c0 + c * (c1 + c * (c2 + c * (c3 + c * (c4 + c * (c5 + c * (c6 + c * c7))))))
            S = s0 + c * (s1 + c * (s2 + c * (s3 + c * (s4 + c * (s5 + c * (s6 + c * s7))))))
            X, q = state[lane], state[8 + lane] * ratio
            following = C * X - S * q
            state[lane], state[8 + lane] = following, C * q + c * S * X
            state[40 + lane] += 1.0 if X * following < 0.0 else 0.0


@compiled
def _stretch_bar(table, state, first, last, sign):
    """Carry the lanes from one point to the next; at a fixed end `sign` is compared."""
    if first == last:
        return
    if sign[0] != 0.0:
        _advance_bar(table, state, first, first + 1)
        for lane in range(LANES):
            state[40 + lane] += 1.0 if sign[lane] * state[lane] < 0.0 else 0.0
            sign[lane] = 0.0
        first += 1
    while last - first > _RESCALE:
        _advance_bar(table, state, first, first + _RESCALE)
        _rescale(state)
        first += _RESCALE
    _advance_bar(table, state, first, last)
    for lane in range(LANES):
        state[8 + lane] /= table[22, last - 1] * table[23, last - 1]


@compiled
def _pass_bar_point(point, state):
    """Apply mass and spring, and then the joint, of a node."""
    for lane in range(LANES):
        X = state[lane]
        Q = state[8 + lane] + (state[48 + lane] * point[0] - point[3]) * X
        following = X - point[7] * Q
        state[40 + lane] += 1.0 if X * following < 0.0 else 0.0
        state[lane], state[8 + lane] = following, Q


@compiled
def _sweep_bar(table, starts, marks, points, left, right, state, sign, value):
    """Pass a longitudinal chain from left to right."""
    fixed = left == BAR_FIXED
    for k in range(48):
        state[k] = 0.0
    for lane in range(LANES):
        state[lane], state[8 + lane] = (0.0, 1.0) if fixed else (1.0, 0.0)
        state[56 + lane], sign[lane] = 0.0, -1.0 if fixed else 0.0
    first, n = 0, len(starts) - 1
    for node in range(n if len(points) == 0 else 0, n + 1):
        if marks[node] < 0 and node < n:
            continue
        _stretch_bar(table, state, first, starts[node], sign)
        first = starts[node]
        if marks[node] >= 0:
            _pass_bar_point(points[marks[node]], state)
    _rescale(state)
    for lane in range(LANES):
        X, Q = state[lane], state[8 + lane]
        value[lane] = X if right == BAR_FIXED else Q
        state[40 + lane] += 1.0 if right != BAR_FIXED and Q * X > 0.0 else 0.0


# --- either family ------------------------------------------------------------------------------


@compiled
def prepare(h, m, EI, N, ends, omega2, starts, marks, table):
    """Fill the table for all up to abs(omega2); return the pieces, which may be more than fit."""
    bar = ends[0] >= BAR_FREE
    if bar:
        pieces = count_bar_pieces(h, m, EI, omega2, starts)
    else:
        pieces = count_pieces(h, m, EI, N, omega2, starts)
    if 0 <= pieces <= table.shape[1]:
        if bar:
            fill_bar_table(h, m, EI, starts, marks, table)
        else:
            fill_table(h, m, EI, N, starts, marks, table)
    return pieces


@compiled
def _pass(table, starts, marks, points, ends, state, sign, value):
    """Pass a chain of either family from left to right."""
    if ends[0] >= BAR_FREE:
        _sweep_bar(table, starts, marks, points, ends[0], ends[1], state, sign, value)
    else:
        _sweep(table, starts, marks, points, ends[0], ends[1], state, sign, value)


@compiled
def evaluate_lanes(table, starts, marks, points, ends, omega2, state, sign, found, count, value):
    """Evaluate a chain at any number of omega^2."""
    for first in range(0, len(omega2), LANES):
        for lane in range(LANES):
            state[48 + lane] = omega2[min(first + lane, len(omega2) - 1)]
        _pass(table, starts, marks, points, ends, state, sign, found)
        for lane in range(min(LANES, len(omega2) - first)):
            count[first + lane] = int(state[40 + lane])
            value[first + lane] = found[lane]


# --- roots ------------------------------------------------------------------------------------
# A solver keeps all samples of one chain. Eigenvalue k of those wanted has index `below + k + 1`
# among all: its bracket lies between the highest sample that counts less and the lowest that does
# not. Inside, the characteristic function divided by (omega^2 - root) of the other roots is
# nearly linear: it has no poles, and no other zero near.

MOST_SAMPLES = 256, 64  # and more for every root
_MOST_PASSES = 100
_EPSILON = 64 * float(np.finfo(float).eps)  # rounding of the minors, relative
_MARGIN = 0.45  # half the distance of the certifying samples, in widths
_SURE = 0.3  # share of a bracket that rounding may take
PARTED = 1e-7  # relative distance of roots below which frames part them, and their shapes
_APART, _ALONE = 1e-4, 1e-3  # ... below which counts are not sure, and without other samples
_OFF, _WITHIN = 1e-7, 3e-2  # relative distances of samples that tell a slope
_BESIDE = 1e-3  # relative distance from a first guess of a second sample, where a lane is free
_FAR = 0.05  # relative likely error of a root up to which a second sample helps
_NEIGHBOURS = 4  # roots on each side that are divided out


@compiled
def _first_samples(h, m, EI, N, number, samples):
    """Set samples between the roots that a slowly varying chain would have, and one below 0.

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
    samples[number] = -1.0
    return number + 1


@compiled
def _first_bar_samples(h, m, EA, number, samples):
    """Set samples between the roots that a slowly varying bar would have, and one below 0."""
    phase = 0.0
    for k in range(len(h)):
        phase += h[k] * math.sqrt(m[k] / EA[k])
    for i in range(number):
        samples[i] = ((0.25 + 0.5 * i) * math.pi / phase) ** 2
    samples[number] = -1.0
    return number + 1


@compiled
def _others(x, root, k, rigid):
    """Return the product of (x - root) over the neighbouring roots and the rigid ones."""
    product = 1.0
    for j in range(max(0, k - _NEIGHBOURS), min(len(root), k + _NEIGHBOURS + 1)):
        if j != k:
            product *= x - root[j]
    if root[0] > 0.0 and k < _NEIGHBOURS:
        for _ in range(rigid):
            product *= x
    return product


@compiled
def _nearest(k, index, samples, total, root, near):
    """Collect up to four samples next to root k that lie between its neighbours."""
    found = 0
    left = 0.0 if root[0] > 0.0 else -np.inf
    if k > 0:
        left = root[k - 1]
    right = root[k + 1] if k + 1 < len(root) else np.inf
    for i in range(total):
        x, count = samples[i, 0], samples[i, 1]
        if x <= left or x >= right or count < index - 1 or count > index:
            continue
        away = abs(x - root[k])
        if found == 4 and away >= abs(samples[near[3], 0] - root[k]):
            continue
        place = min(found, 3)
        while place > 0 and abs(samples[near[place - 1], 0] - root[k]) > away:
            near[place] = near[place - 1]
            place -= 1
        near[place] = i
        found = min(found + 1, 4)
    return found


@compiled
def _latest(k, index, samples, root, own, near):
    """Collect the samples that root k asked for last, as `_nearest` would."""
    found = 0
    left = root[k - 1] if k > 0 else (0.0 if root[0] > 0.0 else -np.inf)
    right = root[k + 1] if k + 1 < len(root) else np.inf
    for i in range(4):
        j = own[k, i]
        if j >= 0 and left < samples[j, 0] < right and index - 1 <= samples[j, 1] <= index:
            near[found] = j
            found += 1
    return found


@compiled
def _interpolate(x, y, number):
    """Return x where the polynomial x(y) through the points has y = 0 (Neville; x is lost).

    Also the same without the last point, and the x of that.
    """
    farthest, rough = x[number - 1], x[0]
    for size in range(1, number):
        rough = x[0]
        for i in range(number - size):
            x[i] = (y[i] * x[i + 1] - y[i + size] * x[i]) / (y[i] - y[i + size])
    return x[0], rough, farthest


@compiled
def _shifted(value, power):
    """Return the value times a power of two, which mostly is 0."""
    return value if power == 0.0 else math.ldexp(value, int(power))


@compiled
def _predict(k, index, samples, total, root, rigid, slope, own, near, x, y):
    """Return a root from the samples next to it, and its likely error (inf: no prediction)."""
    number = _latest(k, index, samples, root, own, near)
    if number < 2 and (slope == 0.0 or number == 0):
        number = _nearest(k, index, samples, total, root, near)
    if number == 0:
        return root[k], np.inf
    for i in range(number):
        j = near[i]
        value = _shifted(samples[j, 2], samples[j, 3] - samples[near[0], 3])
        x[i], y[i] = samples[j, 0], value / _others(samples[j, 0], root, k, rigid)
    if number == 1:
        if slope == 0.0:
            return root[k], np.inf
        step = _shifted(y[0], samples[near[0], 3]) / slope
        return x[0] - step, abs(step)
    better, rough, farthest = _interpolate(x, y, number)
    gap = abs(root[k])
    if k > 0:
        gap = min(gap, abs(root[k] - root[k - 1]))
    if k + 1 < len(root):
        gap = min(gap, abs(root[k + 1] - root[k]))
    return better, abs(better - rough) * min(1.0, abs(farthest - better) / gap)


@compiled
def _slopes(samples, total, root, below, slope, own, near):
    """Set the divided function's slope at every root, for the next chain's first step."""
    for k in range(len(root)):
        slope[k] = 0.0
        if _slope_from(samples, own[k], 4, root, k, below, slope):
            continue
        number = _nearest(k, below + k + 1, samples, total, root, near)
        _slope_from(samples, near, number, root, k, below, slope)


@compiled
def _slope_from(samples, near, number, root, k, below, slope):
    """Set the slope at root k by the first of some samples that is not too near."""
    for i in range(number):
        j = near[i]
        if j < 0:
            return False
        x = samples[j, 0]
        away = x - root[k]
        if 1e-8 * abs(root[k]) < abs(away) < 1e-2 * abs(root[k]):
            slope[k] = _shifted(samples[j, 2] / _others(x, root, k, below) / away, samples[j, 3])
            return True
    return False


@compiled
def _choose(
    k, index, samples, total, lo, hi, root, rigid, slope, width, certify, stuck, own, near, x, y,
    wanted
):  # fmt: skip
    """Return how many samples root k asks for next, and whether they certify it; set them.

    No sample: it is found. wanted[2] is set to how far a second one may stand, or 0.
    """
    wanted[2] = 0.0
    bounded = math.isfinite(lo) and math.isfinite(hi)
    if bounded and hi - lo <= width * max(abs(lo), abs(hi)):
        return 0, False
    if bounded and stuck[k] >= 5:
        stuck[k] = 0
        wanted[0] = _middle(lo, hi)
        return 1, False
    guess, error = _predict(k, index, samples, total, root, rigid, slope, own, near, x, y)
    if not (lo < guess < hi and math.isfinite(error)):
        root[k] = wanted[0] = _middle(lo, hi)
        return 1, False
    root[k] = guess
    size = abs(guess) * width
    if error > 0.1 * size:
        wanted[0] = guess
        if guess + error < hi and error < _FAR * abs(guess):
            wanted[2] = error
        return 1, False
    number = 0
    if not certify and bounded:
        return number, False
    if lo < guess - _MARGIN * size:
        wanted[number] = guess - _MARGIN * size
        number += 1
    if hi > guess + _MARGIN * size:
        wanted[number] = guess + _MARGIN * size
        number += 1
    if number == 2 and hi - lo < 1.05 * size:
        number = 1
    return number, True


@compiled
def _middle(lo, hi):
    """Return a place that halves a bracket, or goes on from its one end."""
    if math.isinf(lo):
        return hi - 4.0 * max(abs(hi), 1.0) if hi <= 1e-3 else hi / 8.0
    if math.isinf(hi):
        return 2.0 * max(lo, 1.0)
    if lo > 0.0 and hi > 2.0 * lo:
        return math.sqrt(lo * hi)
    return (lo + hi) / 2


@compiled
def _schedule(number, certifies, wanted, before, asked, owner):
    """Fill whole passes of lanes; return the number of samples.

    Searches come first, then certificates as far as lanes are free, then second samples beside
    those of the searches. Certificates alone all go at once.
    """
    total, waiting, roots = 0, 0, len(number)
    for k in range(roots):
        if certifies[k]:
            waiting += number[k]
        elif number[k]:
            asked[total], owner[total] = wanted[k, 0], k
            total += 1
        else:
            before[k] = np.inf  # it asks for nothing: it is not stuck
    searches = total
    room = LANES * ((searches + LANES - 1) // LANES) if searches else waiting
    for k in range(roots):
        if not certifies[k]:
            continue
        if total + number[k] > room:
            before[k] = np.inf  # it has not been tried: it is not stuck
            continue
        for i in range(number[k]):
            asked[total], owner[total] = wanted[k, i], k
            total += 1
    for i in range(searches):
        k = owner[i]
        if wanted[k, 2] > 0.0 and total < room:
            asked[total], owner[total] = wanted[k, 0] + wanted[k, 2], k
            total += 1
    return total


@compiled
def _take_sample(lane, state, value, samples, total, below, low, high, counts, at):
    """Keep one lane, and let it narrow the brackets."""
    omega2, count = state[48 + lane], int(state[40 + lane])
    samples[total, 0], samples[total, 1] = omega2, count
    samples[total, 2], samples[total, 3] = value[lane], state[56 + lane]
    for row in range(5):
        samples[total, 4 + row] = state[8 * row + lane]
    for k in range(len(low)):
        if count <= below + k:
            if omega2 > low[k]:
                low[k], counts[k, 0], at[k, 0] = omega2, count, total
        elif omega2 < high[k]:
            high[k], counts[k, 1], at[k, 1] = omega2, count, total


@compiled
def _between(samples, at, root):
    """Return the root by the secant of its bracket, where the ends have different signs."""
    low, high = at[0], at[1]
    before = samples[low, 2]
    after = _shifted(samples[high, 2], samples[high, 3] - samples[low, 3])
    if not before * after < 0.0:
        return root
    return samples[low, 0] + (samples[high, 0] - samples[low, 0]) * before / (before - after)


@compiled
def _over_slope(size, unit, width, rise, steepness, power):
    """Return the rounding of minors over the smaller of two slopes: in the bracket, and around."""
    slope = rise / width
    if steepness > 0.0:
        slope = min(slope, _shifted(steepness, -power))
    return _EPSILON * size / (slope * unit) if slope > 0.0 else np.inf


@compiled
def _rounding(samples, at, right, force, steepness):
    """Estimate the rounding of a root: that of the minors, over the slope of the one that is 0.

    The determinant of two roots that nearly coincide is small of second order, and its sign is
    sure no nearer to them than the square root of rounding.
    """
    low, high = at[0], at[1]
    width = samples[high, 0] - samples[low, 0]
    if right >= BAR_FREE:
        scale = 1.0 / math.sqrt(abs(samples[low, 0]) + 1.0)
        size = max(abs(samples[low, 4]), abs(samples[low, 5]) * scale)
        other = _shifted(samples[high, 2], samples[high, 3] - samples[low, 3])
        unit = 1.0 if right == BAR_FIXED else scale
        return _over_slope(size, unit, width, abs(samples[low, 2]) + abs(other), steepness,
                           samples[low, 3])  # fmt: skip
    scale = 1.0 / math.sqrt(math.sqrt(abs(samples[low, 0]) + force * force + 1.0))
    square = scale * scale
    e, d, f = square / 2, scale * square / 2, square * square / 2
    size = max(abs(samples[low, 4]), abs(samples[low, 5]) * scale, abs(samples[low, 6]) * e)
    size = max(size, abs(samples[low, 7]) * d, abs(samples[low, 8]) * f)
    unit = f if right == 0 else 1.0 if right == 1 else scale if right == 2 else d
    other = _shifted(samples[high, 2], samples[high, 3] - samples[low, 3])
    return _over_slope(size, unit, width, abs(samples[low, 2]) + abs(other), steepness,
                       samples[low, 3])  # fmt: skip


@compiled
def _steepness(samples, total, root, k, rigid):
    """Return the slope of the characteristic function at root k, from a sample off all roots.

    It is the divided function there times the distances of the other roots; 0 if no sample will do.
    Beside a root that nearly coincides, samples in between tell noise.
    """
    best, place = _OFF * abs(root[k]), -1
    for i in range(total):
        x = samples[i, 0]
        if abs(x - root[k]) > _WITHIN * abs(root[k]):
            continue
        off = abs(x - root[k])
        for j in range(max(0, k - 1), min(len(root), k + 2)):
            off = min(off, abs(x - root[j]))
        if off > best:
            best, place = off, i
    if place < 0:
        return 0.0
    x = samples[place, 0]
    divided = samples[place, 2] / _others(x, root, k, rigid) / (x - root[k])
    return abs(_shifted(divided * _others(root[k], root, k, rigid), samples[place, 3]))


@compiled
def _closest(root, k):
    """Return the distance of root k to its neighbours, relative to it."""
    gap = np.inf
    if k > 0:
        gap = min(gap, abs(root[k] - root[k - 1]))
    if k + 1 < len(root):
        gap = min(gap, abs(root[k + 1] - root[k]))
    return gap / max(abs(root[k]), 1e-300)


@compiled
def _cancelling(omega2, force):
    """Estimate the rounding of omega^2 that is small against what EI and N add to it."""
    wave = force / 2.0 + math.sqrt(force * force / 4.0 + abs(omega2))
    return _EPSILON * (abs(omega2) + 2.0 * force * wave)


@compiled
def _watch(low, high, before, stuck, root, centre):
    """Notice brackets that do not halve; start roots in the middle of theirs where asked."""
    for k in range(len(root)):
        if centre and not low[k] < root[k] < high[k]:
            if math.isinf(high[k]):
                root[k] = 2.0 * low[k]
            else:
                root[k] = high[k] / 2 if math.isinf(low[k]) else (low[k] + high[k]) / 2
        size = high[k] - low[k]
        stuck[k] = stuck[k] + 1 if size > 0.5 * before[k] else 0
        before[k] = size


@compiled
def find_roots(
    h, m, EI, N, ends, below, warm, root, slope, width, certify, low, high, counts, rounding,
    table, work, reach,
):  # fmt: skip
    """Bracket and certify the eigenvalues below + 1 ... below + len(root) of one chain.

    Without `certify` each is only enclosed, and predicted to a tenth of the width.

    `root` holds guesses if `warm`, `slope` those of `_slopes`; both are set for the next chain.
    If the table is filled up to some omega^2 = `reach` > 0, the guesses are taken for exact: the
    first samples are those that certify them.
    Returns the reason, and the number of samples, or that of the table's columns needed.
    """
    samples, asked, owner, starts, marks, points, state, sign, value, before = work[:10]
    stuck, at, own, near, x, y, wanted, requests, certifies = work[10:]
    total, number, exact = 0, len(root), warm and reach > 0.0
    for k in range(number):
        asked[k], owner[k], before[k], stuck[k] = root[k], k, np.inf, 0
        low[k], high[k] = -np.inf, np.inf
        own[k, 0] = own[k, 1] = own[k, 2] = own[k, 3] = -1
    if not warm:
        number = 2 * (max(below - 2, 0) + number) + 3
        if ends[0] >= BAR_FREE:
            number = _first_bar_samples(h, m, EI, number, asked)
        else:
            number = _first_samples(h, m, EI, N, number, asked)
        for k in range(number):
            owner[k] = -1
        for k in range(len(root)):
            slope[k] = 0.0
    elif exact:
        number = 2 * len(root)
        for k in range(len(root)):
            size = _MARGIN * width * abs(root[k])
            asked[2 * k], asked[2 * k + 1] = root[k] - size, root[k] + size
            owner[2 * k] = owner[2 * k + 1] = k
    else:
        for k in range(len(root)):
            requests[k], certifies[k] = 1, False
            wanted[k, 0], wanted[k, 2] = root[k], _BESIDE * abs(root[k])
        number = _schedule(requests, certifies, wanted, before, asked, owner)
    for turn in range(_MOST_PASSES):
        if total + number > len(samples):
            break
        largest = 0.0
        for k in range(number):
            largest = max(largest, abs(asked[k]))
        if largest > reach:
            reach = 1.2 * largest
            pieces = prepare(h, m, EI, N, ends, reach, starts, marks, table)
            if pieces < 0:
                return OUT_OF_REACH, total
            if pieces > table.shape[1]:
                return TABLE_TOO_SMALL, pieces
        for first in range(0, number, LANES):
            for lane in range(LANES):
                state[48 + lane] = asked[min(first + lane, number - 1)]
            _pass(table, starts, marks, points, ends, state, sign, value)
            for lane in range(min(LANES, number - first)):
                if not math.isfinite(value[lane]):
                    return NOT_FINITE, total
                _take_sample(*(lane, state, value, samples, total, below, low, high, counts, at))
                k = owner[first + lane]
                if k >= 0:
                    own[k, 3], own[k, 2], own[k, 1] = own[k, 2], own[k, 1], own[k, 0]
                    own[k, 0] = total
                total += 1
        _watch(low, high, before, stuck, root, turn == 0 and not warm)
        for k in range(len(root)):
            requests[k], certifies[k] = _choose(
                *(k, below + k + 1, samples, total, low[k], high[k], root, below, slope[k]),
                *(width, certify, stuck, own, near, x, y, wanted[k]),
            )
        number = _schedule(requests, certifies, wanted, before, asked, owner)
        if number == 0:
            for k in range(len(root) if certify else 0):
                root[k] = _between(samples, at[k], root[k])
                root[k] = min(max(root[k], low[k]), high[k])
            if not exact:
                _slopes(samples, total, root, below, slope, own, near)
            if not certify:
                return CERTIFIED, total
            force, most, sure = _pull(h, N), 0.0, True
            for i in range(len(h)):
                most = max(most, abs(N[i]))
            for k in range(len(root)):
                steepness = _steepness(samples, total, root, k, below)
                rounding[k] = _rounding(samples, at[k], ends[1], force, steepness)
                sure = sure and rounding[k] <= _SURE * width * abs(root[k])
                sure = sure and _closest(root, k) > (_APART if steepness > 0.0 else _ALONE)
                rounding[k] = max(rounding[k], _cancelling(root[k], most))
            return CERTIFIED if sure else CLUSTERED, total
    return NOT_BRACKETED, total


@compiled
def _is_valid(h, m, EI, N):
    """Tell whether lengths, masses and stiffnesses are positive, and all is finite."""
    valid = 0
    for k in range(len(h)):
        valid += 1 if h[k] > 0.0 and h[k] < np.inf and abs(N[k]) < np.inf else 0
        valid += 1 if m[k] > 0.0 and m[k] < np.inf else 0
        valid += 1 if EI[k] > 0.0 and EI[k] < np.inf else 0
    return valid == 3 * len(h)


@summing
def _means(own):
    """Return the length, the mean m and the mean EI of the rows h, m, EI, N of a chain."""
    L, m0, EI0, n = 0.0, 0.0, 0.0, own.shape[1]
    for k in range(n):
        L, m0, EI0 = L + own[0, k], m0 + own[1, k], EI0 + own[2, k]
    return L, m0 / n, EI0 / n


@summing
def _pull(h, N):
    """Return the integral of abs(N)."""
    total = 0.0
    for k in range(len(h)):
        total += abs(N[k]) * h[k]
    return total


@compiled
def make_dimensionless(own):
    """Make the rows h, m, EI, N of a chain dimensionless; return length, mean m and mean EI."""
    L, m0, EI0 = _means(own)
    for k in range(own.shape[1]):
        own[0, k], own[1, k] = own[0, k] / L, own[1, k] / m0
        own[2, k], own[3, k] = own[2, k] / EI0, own[3, k] * (L * L / EI0)
    return L, m0, EI0


@summing
def _quotients(weights, mass, stiffness, force, quotient):
    """Set Rayleigh's quotients of given shapes for a chain [rad^2/s^2].

    `weights` holds the integrals of Y''^2, Y'^2 and Y^2 over every segment, by shape.
    """
    for k in range(len(quotient)):
        bending, slope, displacement = weights[0, k], weights[1, k], weights[2, k]
        stored, moving = 0.0, 0.0
        for i in range(len(mass)):
            stored += stiffness[i] * bending[i] - force[i] * slope[i]
            moving += mass[i] * displacement[i]
        quotient[k] = stored / moving


@compiled
def _guess(root, quotient, before, unit, current):
    """Guess the roots from a neighbour's and the change of Rayleigh's quotients, if they rise."""
    for k in range(1, len(root)):
        last = root[k - 1] + (quotient[k - 1] - before[k - 1])
        if not last < root[k] + (quotient[k] - before[k]):
            return
    for k in range(len(root)):
        current[k] = (root[k] + (quotient[k] - before[k])) / unit


@compiled
def solve_rows(
    length, mass, stiffness, force, ends, below, width, weights, first, neighbour, current, slope,
    quotient, own, table, work, root, low, high, counts, rounding, reason, total
):  # fmt: skip
    """Solve chains from row `first` on; return (row, columns) if one needs a larger table.

    Each starts from the roots of its neighbour, the row solved before (-1: none).
    """
    for b in range(first, len(mass)):
        i = b if len(length) > 1 else 0
        if not _is_valid(length[i], mass[b], stiffness[b], force[b]):
            reason[b] = INVALID
            continue
        for k in range(own.shape[1]):
            own[0, k], own[1, k] = length[i, k], mass[b, k]
            own[2, k], own[3, k] = stiffness[b, k], force[b, k]
        L, m0, EI0 = make_dimensionless(own)
        unit = EI0 / (m0 * L * L * L * L)
        if weights.shape[1]:
            _quotients(weights, mass[b], stiffness[b], force[b], quotient[0])
            if neighbour[0] >= 0:
                _guess(root[neighbour[0]], quotient[0], quotient[1], unit, current)
        for _attempt in range(2):
            reason[b], more = find_roots(
                *(own[0], own[1], own[2], own[3], ends, below, neighbour[0] >= 0, current, slope),
                *(width, True, low[b], high[b], counts[b], rounding[b], table, work, 0.0),
            )
            if reason[b] == TABLE_TOO_SMALL:
                return b, more
            total[b] += more
            if reason[b] == CERTIFIED or reason[b] == CLUSTERED or neighbour[0] < 0:
                break
            neighbour[0] = -1
        neighbour[0] = b if reason[b] == CERTIFIED else -1
        for k in range(root.shape[1]):
            quotient[1, k] = quotient[0, k]
            root[b, k] = unit * min(max(current[k], low[b, k]), high[b, k])
            low[b, k], high[b, k] = unit * low[b, k], unit * high[b, k]
            rounding[b, k] *= unit
    return len(mass), 0


@compiled
def certify_rows(
    own, force, ends, below, width, guess, root, low, high, counts, rounding, reason, total,
    table, work, most, slope,
):  # fmt: skip
    """Certify the guesses for chains that differ in axial force alone; refine those that fail."""
    L, m0, EI0 = make_dimensionless(own)
    unit, pull = EI0 / (m0 * L * L * L * L), L * L / EI0
    starts, marks, reach, n = work[3], work[4], 0.0, own.shape[1]
    for b in range(len(force)):
        outside, highest, finite = 0, 0.0, 0
        for k in range(n):
            N = force[b, k] * pull
            own[3, k] = N
            outside += 1 if abs(N) > most[k] else 0
            finite += 1 if abs(N) < np.inf else 0
        for k in range(root.shape[1]):
            root[b, k] = guess[b, k] / unit
            highest = max(highest, abs(root[b, k]))
            finite += 1 if abs(root[b, k]) < np.inf else 0
            slope[k] = 0.0
        if finite < n + root.shape[1]:
            reason[b] = NOT_FINITE
            continue
        if outside > 0 or highest * (1.0 + width) > reach:
            reach = 1.2 * highest
            for k in range(n):
                most[k] = max(most[k], 1.1 * abs(own[3, k]))
            pieces = count_pieces(own[0], own[1], own[2], most, reach, starts)
            if pieces < 0 or pieces > table.shape[1]:
                reason[b], reach = NOT_BRACKETED, 0.0
                continue
            fill_table(own[0], own[1], own[2], own[3], starts, marks, table)
        else:
            _fill_force(own[3], starts, table)
        reason[b], more = find_roots(
            *(own[0], own[1], own[2], own[3], ends, below, True, root[b], slope, width),
            *(True, low[b], high[b], counts[b], rounding[b], table, work, reach),
        )
        total[b] += more
        if more > 2 * root.shape[1]:
            reach = 0.0
        for k in range(root.shape[1]):
            root[b, k] *= unit
            low[b, k], high[b, k] = unit * low[b, k], unit * high[b, k]
            rounding[b, k] *= unit


# --- beams that vary inside intervals ---------------------------------------------------------
# Each step of an interval is two uniform half-segments whose 1/EI, m and N are averages of the
# values at its two Gauss points with weights 1/2 +- sqrt(3)/3, the larger for the nearer point:
# what `Beam.chain` makes.

GAUSS = 0.5 - math.sqrt(3) / 6
NEAR = 0.5 + math.sqrt(3) / 3

MOST_LEVELS = 7
_COARSE = 1e-8  # relative width of chains that only tell how omega^2 changes
_LEAST = 1e-9  # omega^2, dimensionless, that is as good as zero


@compiled
def _at(a, b, t, log):
    if t == 0.0:
        return a
    if t == 1.0:
        return b
    return a * math.exp(math.log(b / a) * t) if log else a + (b - a) * t


@compiled
def _gauss_values(a, b, start, step, log):
    """Return a property at the two Gauss points of the first of equal steps of an interval.

    And what it grows by from one step to the next, or is multiplied by.
    """
    if not log:
        first, second = start + step * GAUSS, start + step * (1.0 - GAUSS)
        return a + (b - a) * first, a + (b - a) * second, (b - a) * step
    if a == b:
        return a, a, 1.0
    rate = math.log(b / a)
    near, times = math.exp(rate * step * GAUSS), math.exp(rate * step)
    first = a * math.exp(rate * start) * near
    return first, first * (times / (near * near)), times


@compiled
def _mass_until(a, b, h, t, log):
    """Return the mass of the first part of an interval: a share t of its length h."""
    if not log:
        return h * t * (a + (b - a) * t / 2)
    rate = math.log(b / a) * t
    return h * t * a * (math.expm1(rate) / rate if abs(rate) > 1e-12 else 1.0)


@compiled
def _varying(m, EI, N, acceleration, varies):
    """Set which intervals something varies in; return whether it does anywhere."""
    anywhere = False
    for k in range(len(m)):
        same = m[k, 0] == m[k, 1] and EI[k, 0] == EI[k, 1] and N[k, 0] == N[k, 1]
        varies[k] = 0 if same and acceleration == 0.0 else 1
        anywhere = anywhere or varies[k] == 1
    return anywhere


@compiled
def coarsest_steps(x, m, EI, varies, log, limits, interval, steps):
    """Halve steps in which something varies until none is steep or long; return their number.

    Sets the interval of every step; in `steps` its start and size, as shares of the interval.
    """
    steepest, longest, halvings = limits
    start, size, phase, steep = steps[0], steps[1], steps[2], steps[3]
    number = len(x) - 1
    for k in range(number):
        interval[k], start[k], size[k] = k, 0.0, 1.0
    for _ in range(halvings):
        total = 0.0
        for i in range(number):
            k, left, right = interval[i], start[i], start[i] + size[i]
            ma, mb = _at(m[k, 0], m[k, 1], left, log), _at(m[k, 0], m[k, 1], right, log)
            sa, sb = _at(EI[k, 0], EI[k, 1], left, log), _at(EI[k, 0], EI[k, 1], right, log)
            steep[i] = max(ma / mb, mb / ma, sa / sb, sb / sa)
            wave = math.sqrt(math.sqrt(ma * mb) / math.sqrt(sa * sb))
            phase[i] = math.sqrt(wave) * (x[k + 1] - x[k]) * size[i]
            total += phase[i]
        more = 0
        for i in range(number):
            coarse = steep[i] > steepest or phase[i] > longest * total
            steep[i] = 1.0 if coarse and varies[interval[i]] else 0.0
            more += int(steep[i])
        if more == 0 or number + more > len(interval):
            return number if more == 0 else -1
        to = number + more - 1
        for i in range(number - 1, -1, -1):
            k, left, whole = interval[i], start[i], size[i]
            if steep[i] == 1.0:
                interval[to], start[to], size[to] = k, left + whole / 2, whole / 2
                interval[to - 1], start[to - 1], size[to - 1] = k, left, whole / 2
                to -= 2
            else:
                interval[to], start[to], size[to] = k, left, whole
                to -= 1
        number += more
    return number


@compiled
def make_halves(
    x, m, EI, N, acceleration, mass_left, varies, log, interval, steps, number, refinement, first,
    own,
):  # fmt: skip
    """Set h, m, EI and N of all segments, and the first of every interval; return their number."""
    start, size, i, last = steps[0], steps[1], 0, -1
    for s in range(number):
        k = interval[s]
        h = x[k + 1] - x[k]
        if k != last:
            first[k], last = i, k
        if not varies[k]:
            own[0, i], own[1, i] = h * size[s], m[k, 0]
            own[2, i], own[3, i] = EI[k, 0], N[k, 0]
            i += 1
            continue
        step = size[s] / refinement
        m1, m2, dm = _gauss_values(m[k, 0], m[k, 1], start[s], step, log)
        s1, s2, ds = _gauss_values(EI[k, 0], EI[k, 1], start[s], step, log)
        for r in range(refinement):
            t1, t2 = start[s] + step * (r + GAUSS), start[s] + step * (r + 1.0 - GAUSS)
            if r > 0:
                m1, m2 = (m1 * dm, m2 * dm) if log else (m1 + dm, m2 + dm)
                s1, s2 = (s1 * ds, s2 * ds) if log else (s1 + ds, s2 + ds)
            f1, f2 = 1.0 / s1, 1.0 / s2
            n1, n2 = _at(N[k, 0], N[k, 1], t1, False), _at(N[k, 0], N[k, 1], t2, False)
            if acceleration != 0.0:
                n1 += acceleration * (mass_left[k] + _mass_until(m[k, 0], m[k, 1], h, t1, log))
                n2 += acceleration * (mass_left[k] + _mass_until(m[k, 0], m[k, 1], h, t2, log))
            for half in range(2):
                w = NEAR if half == 0 else 1.0 - NEAR
                own[0, i], own[1, i] = h * step / 2, w * m1 + (1.0 - w) * m2
                own[2, i] = 1.0 / (w * f1 + (1.0 - w) * f2)
                own[3, i] = w * n1 + (1.0 - w) * n2
                i += 1
    first[len(m)] = i
    return i


_extrapolate, _within = compiled(convergence.extrapolate), compiled(convergence.within)


@compiled
def _layer_length(own, first, varies):
    """Return the largest N h^2/EI of the segments of what varies: of layers, in segments."""
    longest = 0.0
    for k in range(len(varies)):
        if varies[k]:
            for i in range(first[k], first[k + 1]):
                longest = max(longest, abs(own[3, i]) * own[0, i] * own[0, i] / own[2, i])
    return longest


@compiled
def _in_units(x, m, EI, points, scaled):
    """Make points dimensionless; return length, mean mass per length and mean EI of a beam."""
    L, m0, EI0, n = x[len(x) - 1] - x[0], 0.0, 0.0, len(m)
    for k in range(n):
        m0, EI0 = m0 + (m[k, 0] + m[k, 1]) / (2 * n), EI0 + (EI[k, 0] + EI[k, 1]) / (2 * n)
    mass, spring = m0 * L, EI0 / (L * L * L)
    for k in range(len(points)):
        scaled[k, 0] = points[k, 0] / mass
        scaled[k, 1] = points[k, 1] / (mass * L)
        scaled[k, 2] = points[k, 2] / (mass * L * L)
        scaled[k, 3] = points[k, 3] / spring
        scaled[k, 4] = points[k, 4] / (spring * L * L)
        scaled[k, 5], scaled[k, 6] = points[k, 5], points[k, 6]
        scaled[k, 7] = points[k, 7] / (L / EI0)
    return L, m0, EI0


@compiled
def _to_chain(n, L, m0, EI0, own, at, first, marks):
    """Make the segments of a beam dimensionless, and mark the nodes of its points."""
    for i in range(n):
        own[0, i], own[1, i] = own[0, i] / L, own[1, i] / m0
        own[2, i], own[3, i] = own[2, i] / EI0, own[3, i] * (L * L / EI0)
    for i in range(n + 1):
        marks[i] = -1
    for i in range(len(at)):
        marks[first[at[i]]] = i


@compiled
def _report(unit, better, error, low, high, rounding, omega2, error_omega2, bracket):
    """Set results in SI; the error is that of the segments, and the way to the bracket's end."""
    for k in range(len(better)):
        below, above = low[k] - rounding[k], high[k] + rounding[k]
        inside = min(max(better[k], below), above)
        omega2[k] = unit * better[k]
        error_omega2[k] = unit * (error[k] + max(above - inside, inside - below))
        bracket[k, 0], bracket[k, 1] = unit * below, unit * above


@compiled
def solve_levels(
    x, m, EI, N, acceleration, mass_left, log, limits, ends, below, refinement, tolerance, width,
    at, points, omega2, error_omega2, bracket, counts, evaluations,
    varies, first, interval, steps, own, starts, marks, levels, roots, scaled, table, work,
):  # fmt: skip
    """Solve a beam with steps halved each time, until two extrapolated results agree.

    `at` holds the breakpoints of the points. Returns the reason and the number of segments of the
    finest chain; or what is too small, and the size it needs.
    """
    L, m0, EI0 = _in_units(x, m, EI, points, scaled)
    varying = _varying(m, EI, N, acceleration, varies)
    number = coarsest_steps(x, m, EI, varies, log, limits, interval, steps)
    if number < 0:
        return TOO_MANY_STEPS, 0
    root, slope, better, error, low, high, rounding = roots
    coarse = max(width, min(_COARSE, tolerance / 100))
    evaluations[0] = 0
    for k in range(len(root)):
        root[k] = 0.0
    for level in range(MOST_LEVELS):
        size = 0
        for i in range(number):
            size += 2 * refinement if varies[interval[i]] else 1
        if size > own.shape[1]:
            return CHAIN_TOO_SMALL, size
        n = make_halves(
            *(x, m, EI, N, acceleration, mass_left, varies, log, interval, steps, number),
            *(refinement, first, own),
        )
        _to_chain(n, L, m0, EI0, own, at, first, marks)
        arrays = (*work[:3], starts[: n + 1], marks[: n + 1], scaled, *work[6:])
        warm, last = level > 0, level > 1 or not varying
        wide = width if last else coarse
        while True:
            reason, more = find_roots(
                *(own[0, :n], own[1, :n], own[2, :n], own[3, :n], ends, below, warm, root, slope),
                *(wide, last, low, high, counts, rounding, table, arrays, 0.0),
            )
            if reason == TABLE_TOO_SMALL:
                return reason, more
            evaluations[0] += more
            if reason == CERTIFIED or not warm:
                break
            warm = False
        if reason != CERTIFIED:
            return reason, n
        for k in range(len(root)):
            levels[level, k] = root[k]
            better[k], error[k] = root[k], 0.0
            if level > 0:
                root[k] += (root[k] - levels[level - 1, k]) / 16
        done = not varying
        if level > 1:
            _extrapolate(levels, level, coarse, _layer_length(own, first, varies), better, error)
            done = _within(better, error, tolerance, _LEAST)
        if done:
            unit = EI0 / (m0 * L * L * L * L)
            _report(unit, better, error, low, high, rounding, omega2, error_omega2, bracket)
            return CERTIFIED, n
        refinement *= 2
    return NOT_CONVERGED, 0
