"""Integrals of products of two modes over segments, compiled: at Gauss points, by exact states."""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

from antinode.riccati.lanes.compiling import compiled
from antinode.riccati.lanes.workspace import LANES

from .free import set_lanes
from .layout import DASHPOT, FIRST, PAIR, SECOND, UNIT
from .segments import conjugate, get, put, series, through_both, times, transfer

_PSI, _M, _Q = PAIR, 2 * PAIR, 3 * PAIR


@compiled
def integrate(free, rule, s, left, right, room, out):
    """Set integrals of ``w v`` and of ``conj(v) v`` over every segment.

    Parameters
    ----------
    free : Free
    rule : Rule
    s : array, shape (k, 2)
    left, right : array, shape (n + 1, k, SIZE, 2)
        States w and v at the nodes, SI.
    room : Room
    out : array, shape (2, 5, n, k, 2)
        Zeros, to which products of displacement, turn, moment, force across and Q are added.
    """
    w = room.work
    for first in range(0, len(s), LANES):
        for lane in range(LANES):
            k = min(first + lane, len(s) - 1)
            put(w, DASHPOT + lane, complex(s[k, 0], s[k, 1]))
        set_lanes(free, w)
        number = min(LANES, len(s) - first)
        for point in range(len(rule.weights)):
            for segment in range(len(free.chain.pieces)):
                own = rule.constants[point, segment]
                _load(free, left[segment], first, w, FIRST)
                _load(free, right[segment], first, w, SECOND)
                series(own, w)
                transfer(own, w)
                for _ in range(free.chain.pieces[segment]):
                    through_both(w)
                weight = rule.weights[point] * rule.length[segment]
                for lane in range(number):
                    at = segment, first + lane
                    _add(free, weight, rule.force[segment], lane, at, w, out)
    return 0


@compiled
def _load(free, states, first, w, column):
    """Set a column of states in the units of the lanes."""
    K0 = free.chain.stiffness
    for lane in range(LANES):
        k, unit = min(first + lane, len(states) - 1), w[UNIT + lane]
        scale = 1.0 / unit
        for row in range(4):
            value = complex(states[k, row, 0], states[k, row, 1])
            put(w, column + row * PAIR + lane, times(scale, value))
            scale = 1.0 if row == 0 else unit / K0 if row == 1 else unit * unit / K0


@compiled
def _add(free, weight, N, lane, at, w, out):
    """Add the products at one place of one lane."""
    K0, unit, (segment, k) = free.chain.stiffness, w[UNIT + lane], at
    moment, force = K0 / unit, K0 / (unit * unit)
    Y, Z = times(unit, get(w, FIRST + lane)), times(unit, get(w, SECOND + lane))
    psi, phi = get(w, FIRST + _PSI + lane), get(w, SECOND + _PSI + lane)
    M, R = times(moment, get(w, FIRST + _M + lane)), times(moment, get(w, SECOND + _M + lane))
    Q, P = times(force, get(w, FIRST + _Q + lane)), times(force, get(w, SECOND + _Q + lane))
    V, U = Q - times(N, psi), P - times(N, phi)
    for which in range(2):
        _put(out, which, 0, segment, k, times(weight, Y * Z))
        _put(out, which, 1, segment, k, times(weight, psi * phi))
        _put(out, which, 2, segment, k, times(weight, M * R))
        _put(out, which, 3, segment, k, times(weight, V * U))
        _put(out, which, 4, segment, k, times(weight, Q * P))
        Y, psi, M = conjugate(Z), conjugate(phi), conjugate(R)
        V, Q = conjugate(U), conjugate(P)


@compiled
def _put(out, which, form, segment, k, value):
    out[which, form, segment, k, 0] += value.real
    out[which, form, segment, k, 1] += value.imag
