"""Shapes in compiled code: `riccati.shapes` for eight modes side by side, in one call.

The frames of both ends are carried through every segment, matched where they come closest, and the
state is carried outwards by the changes of basis. Supports, clusters and longitudinal modes are
left to the readable form.

Frames have two columns of four rows of lanes; changes of basis three rows (00, 01, 11).
"""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import math

import numpy as np

from antinode.riccati.lanes.bending import ENDS
from antinode.riccati.lanes.compiling import apart, compiled, wide_vectors
from antinode.riccati.lanes.workspace import (
    COMPLIANCE,
    COUPLING,
    FIRST_MOMENT,
    LANES,
    LEAST,
    LOWER,
    MASS,
    NODE,
    PER_MODE,
    ROTARY,
    SPRING,
    SPRUNG,
    STARTS,
    TURNING,
    UNIT,
    UPPER,
    X_OF,
    Y_OF,
)

from .segments import longest_phase, scale_columns, set_transfers, set_units, step, terms_for

_FREE, _CLAMPED, _PINNED, _SLIDING = ENDS.values()


@compiled
def _admit(end, kappa, adjoint, work, a, b):
    """Set the frame that an end admits: `riccati.law.Law.admitted`, `riccati.frames.turning`."""
    first = 2 if end == _CLAMPED else (1 if end == _PINNED else 0)
    second = 1 if end == _FREE else (2 if end == _SLIDING else 3)
    for lane in range(LANES):
        turn = kappa * work[UNIT + LANES + lane] / work[UNIT + 3 * LANES + lane]
        size = 1.0 / math.sqrt(1.0 + turn * turn)
        for row in range(4):
            a[row * LANES + lane] = 1.0 if row == first else 0.0
            b[row * LANES + lane] = 1.0 if row == second else 0.0
        if kappa != 0.0 and adjoint:
            a[lane], a[2 * LANES + lane] = size, -turn * size
        elif kappa != 0.0:
            b[LANES + lane], b[3 * LANES + lane] = size, turn * size


@apart
def _pass_point(point, side, work, column):
    """Pass a column of a frame through a point: load and then joint, or back."""
    mass, moment, rotary = side * point[MASS], side * point[FIRST_MOMENT], side * point[ROTARY]
    spring, turning = side * point[SPRING], side * point[TURNING]
    coupling, compliance = side * point[COUPLING], point[COMPLIANCE]
    for lane in range(LANES):
        omega2, of_Y = work[PER_MODE + lane], work[UNIT + lane]
        of_M, of_Q = work[UNIT + 2 * LANES + lane], work[UNIT + 3 * LANES + lane]
        across = omega2 * moment - coupling
        pulled = spring
        if point[SPRUNG] != 0.0:
            inertia = omega2 * point[SPRUNG]
            below = point[UPPER] + point[LOWER] - inertia
            pulled += side * point[UPPER] * (point[LOWER] - inertia) / below
        joint = compliance * of_M
        y, t = column[lane], column[LANES + lane]
        m, s = column[2 * LANES + lane], column[3 * LANES + lane]
        if side < 0.0:
            t -= joint * m
        s += ((omega2 * mass - pulled) * of_Y * y + across * t) / of_Q
        m += ((turning - omega2 * rotary) * t - across * of_Y * y) / of_M
        if side > 0.0:
            t += joint * m
        column[LANES + lane], column[2 * LANES + lane], column[3 * LANES + lane] = t, m, s


@apart
def _orthonormalise(a, b, back):
    """Make two columns orthonormal; set back to the inverse of R in F = Q R (00, 01, 11)."""
    for lane in range(LANES):
        a0, a1, a2, a3 = a[lane], a[LANES + lane], a[2 * LANES + lane], a[3 * LANES + lane]
        b0, b1, b2, b3 = b[lane], b[LANES + lane], b[2 * LANES + lane], b[3 * LANES + lane]
        first = 1.0 / math.sqrt(a0 * a0 + a1 * a1 + a2 * a2 + a3 * a3)
        a0, a1, a2, a3 = a0 * first, a1 * first, a2 * first, a3 * first
        shared = a0 * b0 + a1 * b1 + a2 * b2 + a3 * b3
        b0, b1, b2, b3 = b0 - shared * a0, b1 - shared * a1, b2 - shared * a2, b3 - shared * a3
        second = 1.0 / math.sqrt(b0 * b0 + b1 * b1 + b2 * b2 + b3 * b3)
        a[lane], a[LANES + lane], a[2 * LANES + lane], a[3 * LANES + lane] = a0, a1, a2, a3
        b[lane], b[LANES + lane] = b0 * second, b1 * second
        b[2 * LANES + lane], b[3 * LANES + lane] = b2 * second, b3 * second
        back[lane], back[LANES + lane] = first, -shared * first * second
        back[2 * LANES + lane] = second


@compiled
def _pass(marks, points, i, side, work, a, b):
    """Pass the columns of a frame through what stands at a node, if anything does."""
    if marks[i] >= 0:
        _pass_point(points[marks[i]], side, work, a)
        _pass_point(points[marks[i]], side, work, b)


@compiled
def _from_left(chain, adjoint, U, work, F, back):
    """Carry the frame of the left end along; that of a node belongs to its right side."""
    wide_vectors()
    n, marks, points = len(chain.length), chain.marks, chain.points
    for i in range(n + 1):
        a, b = F[i, 0], F[i, 1]
        if i == 0:
            _admit(chain.left, chain.following[0], adjoint, work, a, b)
        else:
            step(U[i - 1], 1.0, F[i - 1, 0], a)
            step(U[i - 1], 1.0, F[i - 1, 1], b)
        if i < n:
            _pass(marks, points, i, 1.0, work, a, b)
        _orthonormalise(a, b, back[i])


@compiled
def _from_right(chain, adjoint, U, work, F, back, frame):
    """Carry the frame of the right end along; at the last node it belongs to the left side."""
    wide_vectors()
    n, marks, points, c, d = len(chain.length), chain.marks, chain.points, frame[0], frame[1]
    for i in range(n, -1, -1):
        a, b = F[i, 0], F[i, 1]
        if i == n:
            _admit(chain.right, chain.following[1], adjoint, work, a, b)
            _pass(marks, points, n, -1.0, work, a, b)
        else:
            for k in range(4 * LANES):
                c[k], d[k] = F[i + 1, 0, k], F[i + 1, 1, k]
            if i + 1 < n:
                _pass(marks, points, i + 1, -1.0, work, c, d)
            step(U[i], -1.0, c, a)
            step(U[i], -1.0, d, b)
        _orthonormalise(a, b, back[i])


@compiled
def _product(L, R, lane):
    """Return the symplectic product of a column of one frame and one of another."""
    return (
        L[3 * LANES + lane] * R[lane]
        - L[lane] * R[3 * LANES + lane]
        + L[LANES + lane] * R[2 * LANES + lane]
        - L[2 * LANES + lane] * R[LANES + lane]
    )


@apart
def _compare(here, a, b, c, d, work):
    """Take a node for each lane whose frames come closer there: the least singular value."""
    for lane in range(LANES):
        c00, c01 = _product(a, c, lane), _product(a, d, lane)
        c10, c11 = _product(b, c, lane), _product(b, d, lane)
        det = c00 * c11 - c01 * c10
        gap = det * det / max(c00 * c00 + c01 * c01 + c10 * c10 + c11 * c11, 1e-300)
        closer = gap < work[LEAST + lane]
        work[LEAST + lane] = gap if closer else work[LEAST + lane]
        work[NODE + lane] = here if closer else work[NODE + lane]


@compiled
def _meet(n, left, right, work):
    """Set, for each lane, the node where the two frames come closest.

    Where the force of the left end follows, `left` is what the adjoint problem admits
    (`riccati.shapes.match`).
    """
    wide_vectors()
    for lane in range(LANES):
        work[LEAST + lane], work[NODE + lane] = np.inf, 0.0
    for i in range(n + 1):
        _compare(float(i), left[i, 0], left[i, 1], right[i, 0], right[i, 1], work)


@compiled
def _share(left, right, state, work):
    """Set the state that both frames share where they meet."""
    for lane in range(LANES):
        i = int(work[NODE + lane])
        a, b, c, d = left[i, 0], left[i, 1], right[i, 0], right[i, 1]
        c00, c01 = _product(a, c, lane), _product(a, d, lane)
        c10, c11 = _product(b, c, lane), _product(b, d, lane)
        first = c00 * c00 + c01 * c01 >= c10 * c10 + c11 * c11
        x, y = (c01, -c00) if first else (c11, -c10)
        size = math.sqrt(x * x + y * y)
        x, y = (x / size, y / size) if size > 0.0 else (1.0, 0.0)
        for row in range(0, 4 * LANES, LANES):
            state[row + lane] = x * c[row + lane] + y * d[row + lane]


@apart
def _carry_to(here, rightwards, before, a, b, work, z):
    """Carry the shared states on to a node, and add them there.

    The node where the frames meet is given by the way to the left.
    """
    own = 0.0 if rightwards else 1.0
    for lane in range(LANES):
        x, y = work[X_OF + lane], work[Y_OF + lane]
        x, y = before[lane] * x + before[LANES + lane] * y, before[2 * LANES + lane] * y
        starts = here == work[NODE + lane]
        x = work[STARTS + lane] if starts else x
        y = work[STARTS + LANES + lane] if starts else y
        work[X_OF + lane], work[Y_OF + lane] = x, y
        share = own if starts else 1.0
        x, y = share * x, share * y
        z[lane] += x * a[lane] + y * b[lane]
        z[LANES + lane] += x * a[LANES + lane] + y * b[LANES + lane]
        z[2 * LANES + lane] += x * a[2 * LANES + lane] + y * b[2 * LANES + lane]
        z[3 * LANES + lane] += x * a[3 * LANES + lane] + y * b[3 * LANES + lane]


@compiled
def _carry(n, F, back, side, state, work, z):
    """Carry the shared states outwards, to the right or to the left: `carry_outwards`."""
    wide_vectors()
    for lane in range(LANES):
        i, x, y = int(work[NODE + lane]), 0.0, 0.0
        for row in range(0, 4 * LANES, LANES):
            x += F[i, 0, row + lane] * state[row + lane]
            y += F[i, 1, row + lane] * state[row + lane]
        work[STARTS + lane], work[STARTS + LANES + lane] = x, y
        work[X_OF + lane], work[Y_OF + lane] = 0.0, 0.0
    for k in range(n + 1):
        i = k if side > 0 else n - k
        before = back[max(i - side, 0)] if k > 0 else back[i]
        _carry_to(float(i), side > 0, before, F[i, 0], F[i, 1], work, z[i])


@compiled
def set_states(chain, omega2, adjoint, longest, room, states):
    """Set states[node, mode, component] in SI; tell whether no segment is too long for that."""
    phase = longest_phase(chain, omega2)
    if not phase <= longest:
        return False
    n, work, own, z = len(chain.length), room.work, room.own, room.z
    scale_columns(chain, omega2, set_units(chain, omega2, work), work, own)
    set_transfers(chain, own, terms_for(phase), work, room.U)
    _from_right(chain, adjoint, room.U, work, room.right, room.back_right, room.frame)
    follows = chain.following[0] != 0.0
    _from_left(chain, adjoint != follows, room.U, work, room.left, room.back_left)
    _meet(n, room.left, room.right, work)
    _share(room.left, room.right, room.here, work)
    if follows:
        _from_left(chain, adjoint, room.U, work, room.left, room.back_left)
    for i in range(n + 1):
        for k in range(4 * LANES):
            z[i, k] = 0.0
    _carry(n, room.right, room.back_right, 1, room.here, work, z)
    _carry(n, room.left, room.back_left, -1, room.here, work, z)
    for i in range(n + 1):
        for lane in range(states.shape[1]):
            for row in range(4):
                value = z[i, row * LANES + lane]
                states[i, lane, row] = value * work[UNIT + row * LANES + lane]
    return True
