r"""A driven chain in complex numbers: `riccati.forced` in eight lanes, from end to end and back.

z = F a + p;   where a basis is taken anew  F+ R = F,  q = F+^H p,  p+ = p - F+ q,
               a = R^-1 a+ - R^-1 q
"""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import math

from antinode.riccati.lanes.compiling import compiled, wide_vectors
from antinode.riccati.lanes.workspace import LANES

from .layout import (
    BACK,
    BASIS,
    CASE,
    COLUMN,
    COMPLIANCE,
    COUPLING,
    DAMPER,
    DASHPOT,
    EVERY,
    FACTOR,
    FEEDBACK,
    FIRST,
    GROWN,
    HOLD,
    INERTIA,
    JOINT,
    KEEP,
    LANE,
    LOADS,
    LOGS,
    MASS,
    OFFSET,
    OMEGA2,
    OWN_LOAD,
    PAIR,
    PHASE,
    RATES,
    SECOND,
    SEGMENTS,
    SHIFT,
    SPRING,
    TURN_DAMPER,
    TURNING,
    UNIT,
)
from .segments import (
    conjugate,
    driven,
    get,
    over,
    plain,
    plus,
    put,
    series,
    square,
    through_both,
    through_case,
    through_plain,
    times,
    transfer,
)
from .supports import hold

_Y, _PSI, _M, _Q = (row * PAIR for row in range(4))
_POLE = 1e-16
_OFTEN = 32  # bases between logarithms
_ROW = 2 * PAIR  # of the 2 x 2 coefficients, and of the coefficients of a case


@compiled
def drive(chain, ends, lanes, room, out):
    """Set the states at the marks, of every frequency and load case.

    Parameters
    ----------
    chain : Driven
    ends : Ends
    lanes : array, shape (groups, LANE)
    room : Room
    out : array, shape (marks, SIZE, cases, k, 2)
        Set.

    Returns
    -------
    int
        0, or 1 where the room does not do.
    """
    w = room.work
    for group in range(len(lanes)):
        own = min(group, len(ends.start) - 1)
        for place in range(LANE):
            w[place] = lanes[group, place]
        admit(ends.start[own], w)
        active = start(chain, ends.left_moves, w, room.cases)
        bases, marks = sweep(chain, w, room, active)
        if bases < 0:
            return 1
        close(chain, ends, own, w, room)
        back(group, w, chain.stiffness, room, bases, marks, out)
    return 0


@compiled
def admit(start, w):
    """Set the frame of the left end."""
    for row in range(8):
        for lane in range(LANES):
            put(w, FIRST + row * PAIR + lane, complex(start[row * LANES + lane], 0.0))
    for lane in range(LANES):
        put(w, FACTOR + lane, complex(1.0, 0.0))
        w[GROWN + lane], w[LOGS + lane] = 1.0, 0.0


@compiled
def start(chain, moves, w, cases):
    """Set the particular states of the left end; return how many there are."""
    active = 0
    for case in range(len(chain.ground)):
        for place in range(COLUMN):
            cases[case, place] = 0.0
        if moves and chain.ground[case] != 0.0:
            active = len(chain.ground)
            for lane in range(LANES):
                cases[case, lane] = chain.ground[case] / w[UNIT + lane]
    return active


@compiled
def sweep(chain, w, room, active):
    """Pass all steps from left to right; return the numbers of bases and of marks."""
    wide_vectors()
    bases, marks, phase = 0, 0, 0.0
    cases = len(chain.ground)
    for step in range(len(chain.steps)):
        kind, first, last = chain.steps[step, 0], chain.steps[step, 1], chain.steps[step, 2]
        if bases + 2 > len(room.back):
            return -1, 0
        if kind in (SEGMENTS, EVERY):
            for k in range(first, last):
                if kind == EVERY and k > first:
                    _keep(w, room, marks)
                    room.basis[marks] = bases
                    marks += 1
                active = cases if _is_driven(chain.along[k]) else active
                bases, phase = _segment(chain, k, w, room, active, bases, phase)
                if bases < 0:
                    return -1, 0
        elif kind == KEEP:
            _keep(w, room, marks)
            room.basis[marks] = bases
            marks += 1
        else:
            active = max(active, _node(chain, kind, first, last, w, room, bases))
            if kind != LOADS or first >= 0:  # forces alone change no basis
                if kind != HOLD:
                    _renew(w, room, active, bases)
                bases, phase = bases + 1, 0.0
    return bases, marks


@compiled
def _keep(w, room, mark):
    """Keep frame and particular states at a mark."""
    for place in range(2 * COLUMN):
        room.frames[mark, place] = w[FIRST + place]
    for case in range(len(room.cases)):
        for place in range(COLUMN):
            room.kept[mark, case, place] = room.cases[case, place]


@compiled
def _is_driven(forces):
    some = False
    for case in range(len(forces)):
        some = some or forces[case] != 0.0
    return some


@compiled
def _segment(chain, k, w, room, active, bases, phase):
    """Pass a segment in short pieces; return the number of bases, and the phase since the last."""
    own = chain.constants[k]
    if chain.pieces[k] == 1 and active == 0 and len(chain.series) > 0:
        phase += own[PHASE]
        if phase > BASIS:
            if bases + 2 > len(room.back):
                return -1, phase
            _renew(w, room, active, bases)
            bases, phase = bases + 1, own[PHASE]
        through_plain(own, chain.series[k], w)
        return bases, phase
    if len(chain.series) == 0 or _is_driven(chain.along[k]):
        series(own, w)
        transfer(own, w)
        if _is_driven(chain.along[k]):
            driven(own, chain.stiffness, w)
    else:
        plain(own, chain.series[k], w)
    for _ in range(chain.pieces[k]):
        phase += own[PHASE]
        if phase > BASIS:
            if bases + 2 > len(room.back):
                return -1, phase
            _renew(w, room, active, bases)
            bases, phase = bases + 1, own[PHASE]
        through_both(w)
        for case in range(active):
            through_case(w, room.cases[case], chain.along[k, case])
    return bases, phase


@compiled
def _renew(w, room, active, basis):
    """Take a new basis, and what it spans out of the particular states."""
    wide_vectors()
    _orthonormalise(w)
    for place in range(4 * PAIR):
        room.back[basis, place] = w[BACK + place]
    if basis % _OFTEN == _OFTEN - 1:
        for lane in range(LANES):
            w[LOGS + lane] += math.log(w[GROWN + lane])
            w[GROWN + lane] = 1.0
    for case in range(len(room.cases)):
        state, shift = room.cases[case], room.shift[basis, case]
        if case >= active:
            for place in range(2 * PAIR):
                shift[place] = 0.0
        else:
            for place in range(COLUMN):
                w[CASE + place] = state[place]
            _take_out(w)
            for place in range(COLUMN):
                state[place] = w[CASE + place]
            for place in range(2 * PAIR):
                shift[place] = w[SHIFT + place]


@compiled
def _orthonormalise(w):
    """Make the columns of the frame orthonormal, and set R^-1."""
    wide_vectors()
    for lane in range(LANES):
        Y, psi = get(w, FIRST + _Y + lane), get(w, FIRST + _PSI + lane)
        M, Q = get(w, FIRST + _M + lane), get(w, FIRST + _Q + lane)
        size = 1.0 / math.sqrt(square(Y) + square(psi) + square(M) + square(Q))
        Y, psi, M, Q = times(size, Y), times(size, psi), times(size, M), times(size, Q)
        Z, phi = get(w, SECOND + _Y + lane), get(w, SECOND + _PSI + lane)
        N, R = get(w, SECOND + _M + lane), get(w, SECOND + _Q + lane)
        r = conjugate(Y) * Z + conjugate(psi) * phi + conjugate(M) * N + conjugate(Q) * R
        Z, phi, N, R = Z - r * Y, phi - r * psi, N - r * M, R - r * Q
        other = 1.0 / math.sqrt(square(Z) + square(phi) + square(N) + square(R))
        put(w, FIRST + _Y + lane, Y)
        put(w, FIRST + _PSI + lane, psi)
        put(w, FIRST + _M + lane, M)
        put(w, FIRST + _Q + lane, Q)
        put(w, SECOND + _Y + lane, times(other, Z))
        put(w, SECOND + _PSI + lane, times(other, phi))
        put(w, SECOND + _M + lane, times(other, N))
        put(w, SECOND + _Q + lane, times(other, R))
        put(w, BACK + lane, complex(size, 0.0))
        put(w, BACK + PAIR + lane, times(-size * other, r))
        put(w, BACK + _ROW + lane, complex(0.0, 0.0))
        put(w, BACK + _ROW + PAIR + lane, complex(other, 0.0))
        w[GROWN + lane] *= 1.0 / (size * other)


@compiled
def _take_out(w):
    """Take what the frame spans out of one particular state."""
    wide_vectors()
    for lane in range(LANES):
        q0, q1 = complex(0.0, 0.0), complex(0.0, 0.0)
        for row in range(4):
            p = get(w, CASE + row * PAIR + lane)
            q0 += conjugate(get(w, FIRST + row * PAIR + lane)) * p
            q1 += conjugate(get(w, SECOND + row * PAIR + lane)) * p
        for row in range(4):
            p = get(w, CASE + row * PAIR + lane) - get(w, FIRST + row * PAIR + lane) * q0
            put(w, CASE + row * PAIR + lane, p - get(w, SECOND + row * PAIR + lane) * q1)
        put(w, SHIFT + lane, -(get(w, BACK + lane) * q0 + get(w, BACK + PAIR + lane) * q1))
        put(w, SHIFT + PAIR + lane, -(get(w, BACK + _ROW + PAIR + lane) * q1))


@compiled
def _node(chain, kind, first, last, w, room, bases):
    """Pass what stands at a node; return how many particular states there are now."""
    cases, active = len(chain.ground), 0
    if kind == HOLD:
        for column in range(cases):  # zero so far, or carried
            active = cases if chain.ground[column] != 0.0 else active
        hold(chain, last, w, room, bases)
        return active
    if first >= 0:
        _act(chain, kind, first, w, w, FIRST)
        _act(chain, kind, first, w, w, SECOND)
        for case in range(cases):
            _act(chain, kind, first, w, room.cases[case], 0)
    if kind == JOINT:
        return 0
    for case in range(cases):
        force, moment = 0.0, 0.0
        if last >= 0:
            force, moment = chain.forces[last, 0, case], chain.forces[last, 1, case]
        if force != 0.0 or moment != 0.0 or chain.ground[case] != 0.0:
            active = cases
            _push(chain, first, force, moment, case, w, room.cases[case])
    return active


@compiled
def _act(chain, kind, point, lanes, z, column):
    """Pass what stands at a node with one column of states."""
    if kind == JOINT:
        _turn(chain, point, lanes, z, column)
    else:
        _load(chain, point, lanes, z, column)


@compiled
def _load(chain, point, lanes, z, column):
    """Pass a mass, springs and dashpots (`riccati.points.lateral_load`)."""
    own, K0 = chain.points[point], chain.stiffness
    m, d = own[MASS], own[OFFSET]
    turned = m * d * d + own[INERTIA]
    for lane in range(LANES):
        omega2, dashpot = get(lanes, OMEGA2 + lane), get(lanes, DASHPOT + lane)
        unit = lanes[UNIT + lane]
        Y, psi = get(z, column + _Y + lane), get(z, column + _PSI + lane)
        lift = times(m, omega2) - own[SPRING] - times(own[DAMPER], dashpot)
        across = times(m * d, omega2) - own[COUPLING]
        turn = times(own[TURN_DAMPER], dashpot) - times(turned, omega2)
        turn = turn + (own[TURNING] + own[OWN_LOAD] * d)
        lift = lift - _fed_back(own, 0, dashpot)
        pull, push = across - _fed_back(own, 1, dashpot), across - _fed_back(own, 2, dashpot)
        turn = turn + _fed_back(own, 3, dashpot)
        Q = times(unit, lift * Y) + pull * psi
        M = turn * psi - times(unit, push * Y)
        put(z, column + _Q + lane, get(z, column + _Q + lane) + times(unit * unit / K0, Q))
        put(z, column + _M + lane, get(z, column + _M + lane) + times(unit / K0, M))


@compiled
def _fed_back(own, entry, s):
    """Return an entry of K + s C of a feedback."""
    return times(own[RATES + entry], s) + own[FEEDBACK + entry]


@compiled
def _push(chain, point, force, moment, case, lanes, z):
    """Add a force, a moment, and what the ground does through a spring and a dashpot."""
    ground, K0 = chain.ground[case], chain.stiffness
    spring, damper, coupling = 0.0, 0.0, 0.0
    if point >= 0:
        own = chain.points[point]
        spring, damper, coupling = own[SPRING], own[DAMPER], own[COUPLING]
    for lane in range(LANES):
        dashpot, unit = get(lanes, DASHPOT + lane), lanes[UNIT + lane]
        Q = times(damper * ground, dashpot) + (force + spring * ground)
        M = -moment - coupling * ground
        put(z, _Q + lane, get(z, _Q + lane) + times(unit * unit / K0, Q))
        z[_M + lane] += M * unit / K0


@compiled
def _turn(chain, point, lanes, z, column):
    """Pass a joint."""
    for lane in range(LANES):
        flexible = chain.points[point, COMPLIANCE] * chain.stiffness / lanes[UNIT + lane]
        M = get(z, column + _M + lane)
        put(z, column + _PSI + lane, get(z, column + _PSI + lane) + times(flexible, M))


@compiled
def close(chain, ends, group, w, room):
    """Set the coefficients that meet the conditions of the right end."""
    wanted = ends.wanted[group]
    for lane in range(LANES):
        c00, c01 = condition(wanted, 0, w, FIRST, lane), condition(wanted, 0, w, SECOND, lane)
        c10, c11 = condition(wanted, 1, w, FIRST, lane), condition(wanted, 1, w, SECOND, lane)
        whole = c00 * c11 - c01 * c10
        if whole.real == 0.0 and whole.imag == 0.0:  # a pole: as near as numbers are
            size = square(c00) + square(c01) + square(c10) + square(c11)
            whole = complex(_POLE * size, 0.0)
        for case in range(len(chain.ground)):
            z, a = room.cases[case], room.coefficients[case]
            r0, r1 = -condition(wanted, 0, z, 0, lane), -condition(wanted, 1, z, 0, lane)
            if ends.right_moves:
                moved = chain.ground[case] / w[UNIT + lane]
                r0 = r0 + wanted[lane] * moved
                r1 = r1 + wanted[4 * LANES + lane] * moved
            put(a, lane, over(c11 * r0 - c01 * r1, whole))
            put(a, PAIR + lane, over(c00 * r1 - c10 * r0, whole))


@compiled
def condition(wanted, row, z, column, lane):
    """Return one condition of one column."""
    total = complex(0.0, 0.0)
    for part in range(4):
        weight = wanted[(row * 4 + part) * LANES + lane]
        total += times(weight, get(z, column + part * PAIR + lane))
    return total


@compiled
def back(group, w, stiffness, room, bases, marks, out):
    """Carry the coefficients back, and write the states at the marks."""
    mark = marks - 1
    for basis in range(bases, -1, -1):
        if basis < bases:
            _before(w, room, basis)
        while mark >= 0 and room.basis[mark] == basis:
            _write(group, w, stiffness, room, mark, out[mark])
            mark -= 1


@compiled
def _before(w, room, basis):
    """Set ``a = back a+ + shift``."""
    wide_vectors()
    for place in range(4 * PAIR):
        w[BACK + place] = room.back[basis, place]
    for case in range(len(room.coefficients)):
        a = room.coefficients[case]
        for place in range(2 * PAIR):
            w[SHIFT + place], w[CASE + place] = room.shift[basis, case, place], a[place]
        for lane in range(LANES):
            a0, a1 = get(w, CASE + lane), get(w, CASE + PAIR + lane)
            before = get(w, BACK + lane) * a0 + get(w, BACK + PAIR + lane) * a1
            other = get(w, BACK + _ROW + lane) * a0 + get(w, BACK + _ROW + PAIR + lane) * a1
            put(w, CASE + lane, before + get(w, SHIFT + lane))
            put(w, CASE + PAIR + lane, other + get(w, SHIFT + PAIR + lane))
        for place in range(2 * PAIR):
            a[place] = w[CASE + place]


@compiled
def _write(group, w, stiffness, room, mark, out):
    """Write the states at a mark in SI, shape (SIZE, cases, k, 2)."""
    F, first = room.frames[mark], group * LANES
    for case in range(out.shape[1]):
        z, a = room.kept[mark, case], room.coefficients[case]
        for row in range(4):
            for lane in range(min(LANES, out.shape[2] - first)):
                unit, place = w[UNIT + lane], row * PAIR + lane
                scale = unit
                if row == 1:
                    scale = 1.0
                elif row == 2:
                    scale = stiffness / unit
                elif row == 3:
                    scale = stiffness / (unit * unit)
                value = plus(get(z, place), get(F, place), get(a, lane))
                value = plus(value, get(F, COLUMN + place), get(a, PAIR + lane))
                out[row, case, first + lane, 0] = scale * value.real
                out[row, case, first + lane, 1] = scale * value.imag
