"""Lateral segments in the units of eight modes side by side: their transfer matrices.

What belongs to one segment or node is flat, a row of eight lanes after another: with constant
places in it, loops over lanes become vectors. States are scaled by `riccati.chain.state_units`.
"""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import math

import numpy as np

from antinode.riccati.lanes.compiling import apart, compiled, wide_vectors
from antinode.riccati.lanes.workspace import (
    BETA,
    GAMMA,
    GROUND,
    INERTIA_OF,
    INVERSE,
    LANES,
    NEW,
    OLD,
    PER_MODE,
    PER_UNIT,
    ROTARY_INERTIA,
    SCALE,
    SHEAR,
    SHEAR_OF,
    SHEAR_TURN,
    SHEAR_WORK,
    SUMS,
    TURNING_OF,
    UNIT,
)

TERMS = 16
"""Most terms of the series: twice what the longest segment needs."""

_SERIES = np.array([[1 / math.factorial(2 * k + j) for k in range(TERMS)] for j in (3, 2, 1, 0)])
_BELOW_ROUNDING = 1e-18


@compiled
def longest_phase(chain, omega2):
    """Return the largest wave number times length of the segments: `Lateral.wave_number`."""
    most, size = 0.0, 0.0
    for lane in range(len(omega2)):
        size = max(size, abs(omega2[lane]))
    for i in range(len(chain.length)):
        EI, N, inertia = chain.stiffness[i], chain.force[i], chain.mass[i] * size
        b, c = abs(N) / EI, inertia / EI
        if chain.more.shape[1] > 0:
            s, alpha = chain.more[SHEAR, i], 1.0 + chain.more[SHEAR_TURN, i]
            beta, rotary = N + chain.more[SHEAR_WORK, i], chain.more[ROTARY_INERTIA, i] * size
            inertia += chain.more[GROUND, i]
            b = s * inertia + (abs(beta) + rotary) / EI
            c = inertia * (abs(alpha * alpha - s * beta) + s * rotary) / EI
        square = chain.length[i] * chain.length[i]
        b, c = abs(b) * square / 2.0, abs(c) * square * square
        phase = b + math.sqrt(b * b + c)
        if not phase <= most:  # one that is no number, too
            most = phase
    return math.sqrt(most)


@compiled
def cut(chain, omega2, longest, positions, length, owner, places):
    """Cut segments at positions: `riccati.chain.Chain.cut_at`; tell how many there are then.

    `places` are the new numbers of the nodes. Tells too whether no segment was too long.
    """
    n, total, start, k, p = len(chain.length), 0.0, 0.0, 0, 0
    for i in range(n):
        total += chain.length[i]
    for i in range(n):
        h, before = chain.length[i], 0.0
        end = start + h
        places[i] = k
        while p < len(positions) and (positions[p] <= end or i == n - 1):
            at = positions[p]
            near = min(abs(end - at), abs(at - start)) <= 1e-12 * total
            if not near and at - start > before:
                length[k], owner[k] = at - start - before, i
                before = at - start
                k += 1
            p += 1
        length[k], owner[k] = h - before, i
        k += 1
        start = end
    places[n] = k
    return k, longest_phase(chain, omega2) <= longest


@compiled
def terms_for(phase):
    """Return how many terms make the truncation of every series smaller than rounding."""
    terms, size = 1, 1.0
    while size * (terms + 1) > _BELOW_ROUNDING and terms < TERMS:
        size *= phase * phase / ((2 * terms - 1) * (2 * terms))
        terms += 1
    return max(terms, 2)


@compiled
def set_units(chain, omega2, work):
    """Set what scales the states of each lane (`Lateral.scale_length`); return EI of the chain."""
    total, mass, logarithm, force = 0.0, 0.0, 0.0, 0.0
    for i in range(len(chain.length)):
        h = chain.length[i]
        total, mass, force = total + h, mass + h * chain.mass[i], force + h * abs(chain.force[i])
        logarithm += h * math.log(abs(chain.stiffness[i]))
    EI0, m0 = math.exp(logarithm / total), mass / total
    b, least = force / total / EI0, 1.0 / (total * total * total * total)
    for lane in range(LANES):
        inertia = abs(omega2[min(lane, len(omega2) - 1)]) * m0 / EI0
        scale = 1.0 / math.sqrt(math.sqrt(inertia + b * b + least))
        work[SCALE + lane], work[INVERSE + lane] = scale, 1.0 / scale
        work[UNIT + lane], work[UNIT + LANES + lane] = scale, 1.0
        work[UNIT + 2 * LANES + lane] = EI0 / scale
        work[UNIT + 3 * LANES + lane] = EI0 / (scale * scale)
        for row in range(0, 4 * LANES, LANES):
            work[PER_UNIT + row + lane] = 1.0 / work[UNIT + row + lane]
    return EI0


@compiled
def scale_columns(chain, omega2, EI0, work, own):
    """Set EI and alpha of every segment, and s, beta and mu of it in the units of the lanes."""
    last = len(omega2) - 1
    for lane in range(LANES):
        work[PER_MODE + lane] = omega2[min(lane, last)]
    for i in range(len(chain.length)):
        own.stiffness[i], own.coupling[i] = chain.stiffness[i] / EI0, 1.0
        m, N, s, rotary, ground = chain.mass[i], chain.force[i], 0.0, 0.0, 0.0
        if chain.more.shape[1] > 0:
            own.coupling[i] += chain.more[SHEAR_TURN, i]
            N += chain.more[SHEAR_WORK, i]
            s, rotary = chain.more[SHEAR, i] * EI0, chain.more[ROTARY_INERTIA, i]
            ground = chain.more[GROUND, i]
        column = own.columns[i]
        for lane in range(LANES):
            scale, omega2_of = work[SCALE + lane], work[PER_MODE + lane]
            square = scale * scale
            column[SHEAR_OF + lane] = s / square
            column[TURNING_OF + lane] = (N + rotary * omega2_of) * (square / EI0)
            column[INERTIA_OF + lane] = (m * omega2_of - ground) * (square * square / EI0)


@apart
def transfer(h, EI, alpha, column, terms, work, U):
    """Set the ten different entries of the transfer matrix (equation 62) h into a segment.

    In this order: 00 = 33, 01 = 23, 02 = 13, 03, 10 = 32, 11 = 22, 12, 20 = 31, 21, 30.
    """
    for lane in range(LANES):
        x = h * work[INVERSE + lane]
        s, beta = column[SHEAR_OF + lane], column[TURNING_OF + lane]
        mu, square = column[INERTIA_OF + lane], x * x
        b = -(beta / EI + s * mu) * square
        work[BETA + lane] = b
        work[GAMMA + lane] = mu / EI * (alpha * alpha - s * beta) * square * square
        work[OLD + lane], work[NEW + lane] = 1.0, b
        work[SUMS + lane] = _SERIES[0, 0] + b * _SERIES[0, 1]
        work[SUMS + LANES + lane] = _SERIES[1, 0] + b * _SERIES[1, 1]
        work[SUMS + 2 * LANES + lane] = _SERIES[2, 0] + b * _SERIES[2, 1]
        work[SUMS + 3 * LANES + lane] = _SERIES[3, 0] + b * _SERIES[3, 1]
    for k in range(2, terms):
        s0, s1, s2, s3 = _SERIES[0, k], _SERIES[1, k], _SERIES[2, k], _SERIES[3, k]
        for lane in range(LANES):
            following = work[BETA + lane] * work[NEW + lane] + work[GAMMA + lane] * work[OLD + lane]
            work[OLD + lane], work[NEW + lane] = work[NEW + lane], following
            work[SUMS + lane] += s0 * following
            work[SUMS + LANES + lane] += s1 * following
            work[SUMS + 2 * LANES + lane] += s2 * following
            work[SUMS + 3 * LANES + lane] += s3 * following
    for lane in range(LANES):
        x = h * work[INVERSE + lane]
        s, beta = column[SHEAR_OF + lane], column[TURNING_OF + lane]
        mu, turn = column[INERTIA_OF + lane], beta / EI
        kappa = alpha * alpha - s * beta
        g, g1 = x * x * x * work[SUMS + lane], x * x * work[SUMS + LANES + lane]
        g2, g3 = x * work[SUMS + 2 * LANES + lane], work[SUMS + 3 * LANES + lane]
        U[lane] = g3 + turn * g1
        U[LANES + lane] = alpha * g2
        U[2 * LANES + lane] = alpha * g1 / EI
        U[3 * LANES + lane] = kappa * g / EI - s * g2
        U[4 * LANES + lane] = alpha * mu / EI * g
        U[5 * LANES + lane] = g3 + s * mu * g1
        U[6 * LANES + lane] = (g2 + s * mu * g) / EI
        U[7 * LANES + lane] = alpha * mu * g1
        U[8 * LANES + lane] = kappa * mu * g - beta * g2
        U[9 * LANES + lane] = mu * (g2 + turn * g)


@compiled
def set_transfers(chain, own, terms, work, U):
    """Set the transfer matrices of all segments."""
    wide_vectors()
    for i in range(len(chain.length)):
        transfer(
            *(chain.length[i], own.stiffness[i], own.coupling[i]),
            *(own.columns[i], terms, work, U[i]),
        )


@apart
def step(U, side, before, after):
    """Carry four rows through a segment: to the right, or to the left.

    To the left h changes its sign, and with it the odd entries.
    """
    for lane in range(LANES):
        y, t = before[lane], before[LANES + lane]
        m, s = before[2 * LANES + lane], before[3 * LANES + lane]
        u00, u01 = U[lane], side * U[LANES + lane]
        u02, u03 = U[2 * LANES + lane], side * U[3 * LANES + lane]
        u10, u11 = side * U[4 * LANES + lane], U[5 * LANES + lane]
        u12, u20 = side * U[6 * LANES + lane], U[7 * LANES + lane]
        u21, u30 = side * U[8 * LANES + lane], side * U[9 * LANES + lane]
        after[lane] = u00 * y + u01 * t + u02 * m + u03 * s
        after[LANES + lane] = u10 * y + u11 * t + u12 * m + u02 * s
        after[2 * LANES + lane] = u20 * y + u21 * t + u11 * m + u01 * s
        after[3 * LANES + lane] = u30 * y + u20 * t + u10 * m + u00 * s
