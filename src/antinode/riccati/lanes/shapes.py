"""Shapes in compiled code: `riccati.shapes` for eight modes side by side.

The frames of both ends are carried through every segment, matched where they come closest, and the
state is carried outwards by the changes of basis. Supports, clusters and longitudinal modes are
left to the readable form.

Arrays are indexed [node or segment, component, lane], a lane being a mode. States are scaled by
`riccati.chain.state_units` of the lane.
"""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import math

import numpy as np

from .compiling import compiled
from .workspace import GROUND, LANES, ROTARY_INERTIA, SHEAR, SHEAR_TURN, SHEAR_WORK

TERMS = 16
"""Most terms of the series: twice what the longest segment needs."""

_SERIES = np.array([[1 / math.factorial(2 * k + j) for k in range(TERMS)] for j in (3, 2, 1, 0)])
_BELOW_ROUNDING = 1e-18
SCRATCH = 27
"""Rows of lanes that the functions write into."""


@compiled
def _terms(h, own, scale):
    """Return how many terms make the truncation of every series smaller than rounding."""
    most = 0.0
    for i in range(len(h)):
        EI, alpha = own.stiffness[i], own.coupling[i]
        for lane in range(LANES):
            x, s = h[i] / scale[lane], own.shear[i, lane]
            beta, mu = own.turning[i, lane], own.inertia[i, lane]
            b = (abs(beta) / EI + abs(s * mu)) * x * x / 2
            c = abs(mu * (alpha * alpha - s * beta)) / EI * x * x * x * x
            most = max(most, b + math.sqrt(b * b + c))
    terms, size = 1, 1.0
    while size * (terms + 1) > _BELOW_ROUNDING and terms < TERMS:
        size *= most / ((2 * terms - 1) * (2 * terms))
        terms += 1
    return max(terms, 2)


@compiled
def scaled_chain(mass, stiffness, force, more, omega2, scale, EI0, own):
    """Set EI, alpha, s, beta and mu of every segment in the units of the lanes."""
    for i in range(len(mass)):
        own.stiffness[i], own.coupling[i] = stiffness[i] / EI0, 1.0
        for lane in range(LANES):
            square = scale[lane] * scale[lane]
            own.shear[i, lane], own.turning[i, lane] = 0.0, force[i] * (square / EI0)
            own.inertia[i, lane] = mass[i] * (omega2[lane] * square * square / EI0)
    for i in range(more.shape[1]):
        own.coupling[i] = 1.0 + more[SHEAR_TURN, i]
        for lane in range(LANES):
            square = scale[lane] * scale[lane]
            turning = more[SHEAR_WORK, i] + more[ROTARY_INERTIA, i] * omega2[lane]
            own.shear[i, lane] = more[SHEAR, i] * (EI0 / square)
            own.turning[i, lane] += turning * (square / EI0)
            own.inertia[i, lane] -= more[GROUND, i] * (square * square / EI0)


@compiled
def _transfer(h, EI, alpha, s, beta, mu, terms, q, sums, U):
    """Set the ten different entries of the transfer matrix (equation 62) of one segment.

    In this order: 00 = 33, 01 = 23, 02 = 13, 03, 10 = 32, 11 = 22, 12, 20 = 31, 21, 30.
    """
    for lane in range(LANES):
        square = h[lane] * h[lane]
        kappa = alpha * alpha - s[lane] * beta[lane]
        q[0, lane], q[1, lane] = 1.0, -(beta[lane] / EI + s[lane] * mu[lane]) * square
        for j in range(4):
            sums[j, lane] = _SERIES[j, 0] + q[1, lane] * _SERIES[j, 1]
        q[2, lane], q[3, lane] = mu[lane] / EI * kappa * square * square, q[1, lane]
    for k in range(2, terms):
        s0, s1, s2, s3 = _SERIES[0, k], _SERIES[1, k], _SERIES[2, k], _SERIES[3, k]
        for lane in range(LANES):
            following = q[1, lane] * q[3, lane] + q[2, lane] * q[0, lane]
            q[0, lane], q[3, lane] = q[3, lane], following
            sums[0, lane] += s0 * following
            sums[1, lane] += s1 * following
            sums[2, lane] += s2 * following
            sums[3, lane] += s3 * following
    for lane in range(LANES):
        x, mw, flexible = h[lane], mu[lane], s[lane]
        kappa, turn = alpha * alpha - flexible * beta[lane], beta[lane] / EI
        g, g1 = x * x * x * sums[0, lane], x * x * sums[1, lane]
        g2, g3 = x * sums[2, lane], sums[3, lane]
        U[0, lane] = g3 + turn * g1
        U[1, lane] = alpha * g2
        U[2, lane] = alpha * g1 / EI
        U[3, lane] = kappa * g / EI - flexible * g2
        U[4, lane] = alpha * mw / EI * g
        U[5, lane] = g3 + flexible * mw * g1
        U[6, lane] = (g2 + flexible * mw * g) / EI
        U[7, lane] = alpha * mw * g1
        U[8, lane] = kappa * mw * g - beta[lane] * g2
        U[9, lane] = mw * (g2 + turn * g)


@compiled
def transfers(h, own, scale, scratch, U):
    """Set the transfer matrices of all segments."""
    q, sums, x = scratch[0:4], scratch[4:8], scratch[8]
    terms = _terms(h, own, scale)
    for i in range(len(h)):
        for lane in range(LANES):
            x[lane] = h[i] / scale[lane]
        _transfer(
            *(x, own.stiffness[i], own.coupling[i], own.shear[i]),
            *(own.turning[i], own.inertia[i], terms, q, sums, U[i]),
        )


@compiled
def _step(U, side, before, first, after):
    """Carry a column of four rows from `first` on through a segment: to the right, or to the left.

    To the left h changes its sign, and with it the odd entries.
    """
    for lane in range(LANES):
        y, t = before[first, lane], before[first + 1, lane]
        m, s = before[first + 2, lane], before[first + 3, lane]
        u01, u03, u10 = side * U[1, lane], side * U[3, lane], side * U[4, lane]
        u12, u21, u30 = side * U[6, lane], side * U[8, lane], side * U[9, lane]
        u00, u02, u11, u20 = U[0, lane], U[2, lane], U[5, lane], U[7, lane]
        after[first, lane] = u00 * y + u01 * t + u02 * m + u03 * s
        after[first + 1, lane] = u10 * y + u11 * t + u12 * m + u02 * s
        after[first + 2, lane] = u20 * y + u21 * t + u11 * m + u01 * s
        after[first + 3, lane] = u30 * y + u20 * t + u10 * m + u00 * s


@compiled
def _pass_point(point, side, F):
    """Pass the two columns of a frame through a point: load and then joint, or back."""
    for first in (0, 4):
        for lane in range(LANES):
            y, t = F[first, lane], F[first + 1, lane]
            m, s = F[first + 2, lane], F[first + 3, lane]
            if side < 0.0:
                t -= point[4, lane] * m
            s += side * (point[0, lane] * y + point[1, lane] * t)
            m += side * (point[2, lane] * y + point[3, lane] * t)
            if side > 0.0:
                t += point[4, lane] * m
            F[first + 1, lane], F[first + 2, lane], F[first + 3, lane] = t, m, s


@compiled
def _orthonormalise(F, back):
    """Make the columns of F orthonormal; set back to the inverse of R in F = Q R (00, 01, 11)."""
    for lane in range(LANES):
        a0, a1, a2, a3 = F[0, lane], F[1, lane], F[2, lane], F[3, lane]
        b0, b1, b2, b3 = F[4, lane], F[5, lane], F[6, lane], F[7, lane]
        first = 1.0 / math.sqrt(a0 * a0 + a1 * a1 + a2 * a2 + a3 * a3)
        a0, a1, a2, a3 = a0 * first, a1 * first, a2 * first, a3 * first
        shared = a0 * b0 + a1 * b1 + a2 * b2 + a3 * b3
        b0, b1, b2, b3 = b0 - shared * a0, b1 - shared * a1, b2 - shared * a2, b3 - shared * a3
        second = 1.0 / math.sqrt(b0 * b0 + b1 * b1 + b2 * b2 + b3 * b3)
        F[0, lane], F[1, lane], F[2, lane], F[3, lane] = a0, a1, a2, a3
        F[4, lane], F[5, lane] = b0 * second, b1 * second
        F[6, lane], F[7, lane] = b2 * second, b3 * second
        back[0, lane], back[1, lane], back[2, lane] = first, -shared * first * second, second


@compiled
def _copy(given, F):
    """Set a frame."""
    for row in range(8):
        for lane in range(LANES):
            F[row, lane] = given[row, lane]


@compiled
def sweeps(U, marks, points, ends, scratch, left, right, back_left, back_right):
    """Carry the frames of both ends along; those of a node belong to its right side (last: left).

    `ends` holds the frames that they admit, left and right; `points` what the loads add, Q by Y and
    by theta, M by Y and by theta, and the compliance of the joint.
    """
    n, before = len(U), scratch[0:8]
    _copy(ends[0], left[0])
    if marks[0] >= 0:
        _pass_point(points[marks[0]], 1.0, left[0])
    _orthonormalise(left[0], back_left[0])
    for i in range(n):
        F = left[i + 1]
        _step(U[i], 1.0, left[i], 0, F)
        _step(U[i], 1.0, left[i], 4, F)
        if marks[i + 1] >= 0 and i + 1 < n:
            _pass_point(points[marks[i + 1]], 1.0, F)
        _orthonormalise(F, back_left[i + 1])
    _copy(ends[1], right[n])
    if marks[n] >= 0:
        _pass_point(points[marks[n]], -1.0, right[n])
    _orthonormalise(right[n], back_right[n])
    for i in range(n - 1, -1, -1):
        _copy(right[i + 1], before)
        if marks[i + 1] >= 0 and i + 1 < n:
            _pass_point(points[marks[i + 1]], -1.0, before)
        _step(U[i], -1.0, before, 0, right[i])
        _step(U[i], -1.0, before, 4, right[i])
        _orthonormalise(right[i], back_right[i])


@compiled
def _product(L, a, R, b, lane):
    """Return the symplectic product of column a of one frame and b of another."""
    return (
        L[a + 3, lane] * R[b, lane]
        - L[a, lane] * R[b + 3, lane]
        + L[a + 1, lane] * R[b + 2, lane]
        - L[a + 2, lane] * R[b + 1, lane]
    )


@compiled
def meet(left, right, scratch, node, state):
    """Set, for each lane, the node where the two frames come closest, and the state they share.

    Where the force of the left end follows, `left` is what the adjoint problem admits
    (`riccati.shapes.match`).
    """
    least = scratch[0]
    for lane in range(LANES):
        least[lane] = np.inf
    for i in range(len(left)):
        L, R = left[i], right[i]
        for lane in range(LANES):
            c00, c01 = _product(L, 0, R, 0, lane), _product(L, 0, R, 4, lane)
            c10, c11 = _product(L, 4, R, 0, lane), _product(L, 4, R, 4, lane)
            upper, lower = c00 * c00 + c01 * c01, c10 * c10 + c11 * c11
            gap = abs(c00 * c11 - c01 * c10) / math.sqrt(max(upper + lower, 1e-300))
            if gap < least[lane]:
                least[lane], node[lane] = gap, i
                x, y = (c01, -c00) if upper >= lower else (c11, -c10)
                size = math.sqrt(x * x + y * y)
                x, y = (x / size, y / size) if size > 0.0 else (1.0, 0.0)
                for row in range(4):
                    state[row, lane] = x * R[row, lane] + y * R[4 + row, lane]


@compiled
def carry(left, right, back_left, back_right, node, state, units, z):
    """Carry the shared states outwards; set z[node, mode, component] in SI."""
    for lane in range(z.shape[1]):
        for side in range(2):
            F, back = (left, back_left) if side == 0 else (right, back_right)
            i, x, y = node[lane], 0.0, 0.0
            for row in range(4):
                x += F[i, row, lane] * state[row, lane]
                y += F[i, 4 + row, lane] * state[row, lane]
            while 0 <= i < len(F):
                for row in range(4):
                    value = x * F[i, row, lane] + y * F[i, 4 + row, lane]
                    z[i, lane, row] = value * units[lane, row]
                x = back[i, 0, lane] * x + back[i, 1, lane] * y
                y = back[i, 2, lane] * y
                i += -1 if side == 0 else 1


@compiled
def squares(h, force, own, scale, units, states, shares, weights, scratch, total):
    """Add up the integrals of Y^2, psi^2, M^2, V^2 and Q^2 over every segment, by Gauss points.

    total is indexed [which, segment, mode], in SI.
    """
    q, sums, x = scratch[0:4], scratch[4:8], scratch[8]
    U, z, there = scratch[9:19], scratch[19:23], scratch[23:27]
    terms = _terms(h, own, scale)
    for i in range(len(h)):
        for lane in range(states.shape[1]):
            for row in range(4):
                z[row, lane] = states[i, lane, row] / units[lane, row]
        for p in range(len(shares)):
            for lane in range(LANES):
                x[lane] = h[i] * shares[p] / scale[lane]
            _transfer(
                *(x, own.stiffness[i], own.coupling[i], own.shear[i]),
                *(own.turning[i], own.inertia[i], terms, q, sums, U),
            )
            _step(U, 1.0, z, 0, there)
            weight = weights[p] * h[i]
            for lane in range(states.shape[1]):
                unit = units[lane]
                psi, Q = there[1, lane] * unit[1], there[3, lane] * unit[3]
                shear = Q - force[i] * psi
                total[0, i, lane] += weight * (there[0, lane] * unit[0]) ** 2
                total[1, i, lane] += weight * psi**2
                total[2, i, lane] += weight * (there[2, lane] * unit[2]) ** 2
                total[3, i, lane] += weight * shear**2
                total[4, i, lane] += weight * Q**2
