r"""A chain by itself at complex s: its characteristic function, the zeros of that, and modes.

The frame alone is carried (`sweep`); D is the determinant of what the right end wants of it, times
what every basis took from it. Zeros by secants through three places, as `riccati.damped.search`;
at a zero the states are those that the right end wants, carried back.
"""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import math

from antinode.riccati.lanes.compiling import compiled
from antinode.riccati.lanes.workspace import LANES

from .layout import (
    DASHPOT,
    FACTOR,
    FIRST,
    GROWN,
    LOGS,
    OMEGA2,
    PAIR,
    PER_UNIT,
    SECOND,
    SIZE_AT,
    STEP,
    UNIT,
    VALUE_AT,
    X0,
    X1,
    X2,
)
from .segments import conjugate, get, over, put, square, times
from .sweep import admit, back, condition, sweep

_PASSES = 40
_SMALL = 1e-14
_NEAR = 1e-3  # of a start: the two places beside it
_SETTLED = 1e-9  # of s: the last step of one that counts
_REAL = 1e-13  # of s: an imaginary part that is none
_FAR = 0.1  # of the unit, beside the size of s: the longest step


@compiled
def size_of(value):
    """Return the modulus."""
    return math.sqrt(square(value))


@compiled
def root_of(z):
    """Return a square root."""
    m = size_of(z)
    if m == 0.0:
        return complex(0.0, 0.0)
    a = math.sqrt((m + abs(z.real)) / 2)
    b = z.imag / (2 * a)
    if z.real >= 0:
        return complex(a, b)
    return complex(abs(b), a if z.imag >= 0 else -a)


@compiled
def set_lanes(free, w):
    """Set omega^2 and the units of the lanes from s."""
    for lane in range(LANES):
        s = get(w, DASHPOT + lane)
        put(w, OMEGA2 + lane, -(s * s))
        unit = 1.0 / math.sqrt(math.sqrt(square(s) * free.inertia + free.rest))
        w[UNIT + lane], w[PER_UNIT + lane] = unit, 1.0 / unit


@compiled
def pass_chain(free, room):
    """Carry the frame through the chain at s of the lanes; return how many bases and marks."""
    w = room.work
    set_lanes(free, w)
    admit(free.ends.start[0], w)
    return sweep(free.chain, w, room, 0)


@compiled
def determinants(free, room, q):
    """Set D and the logarithm of its size in every lane, at s of the lanes."""
    w = room.work
    if pass_chain(free, room)[0] < 0:
        return 1
    wanted = free.ends.wanted[0]
    for lane in range(LANES):
        c00, c01 = condition(wanted, 0, w, FIRST, lane), condition(wanted, 0, w, SECOND, lane)
        c10, c11 = condition(wanted, 1, w, FIRST, lane), condition(wanted, 1, w, SECOND, lane)
        put(q, VALUE_AT + lane, (c00 * c11 - c01 * c10) * get(w, FACTOR + lane))
        units = free.power * math.log(w[UNIT + lane]) + free.constant
        q[SIZE_AT + lane] = w[LOGS + lane] + math.log(w[GROWN + lane]) + units
    return 0


@compiled
def characteristic(free, s, room, q, value, size):
    """Set D at many s.

    Parameters
    ----------
    free : Free
    s, value : array, shape (k, 2)
        Real and imaginary parts.
    size : array, shape (k,)
    """
    for first in range(0, len(s), LANES):
        for lane in range(LANES):
            k = min(first + lane, len(s) - 1)
            put(room.work, DASHPOT + lane, complex(s[k, 0], s[k, 1]))
        if determinants(free, room, q):
            return 1
        for lane in range(min(LANES, len(s) - first)):
            D = get(q, VALUE_AT + lane)
            value[first + lane, 0], value[first + lane, 1] = D.real, D.imag
            size[first + lane] = q[SIZE_AT + lane]
    return 0


@compiled
def _deflated(free, task, known, room, q):
    """Set D with what is known divided out."""
    if determinants(free, room, q):
        return 1
    for lane in range(LANES):
        s, D, size = get(room.work, DASHPOT + lane), get(q, VALUE_AT + lane), q[SIZE_AT + lane]
        for k in range(-task.zeros, len(known)):
            root = complex(0.0, 0.0)
            if k >= 0:
                root = complex(known[k, 0], known[k, 1])
            d = times(1.0 / task.unit, s - root)
            D, size = _without(D, size, d)
            if task.mirrored and root.imag != 0.0:
                D, size = _without(D, size, times(1.0 / task.unit, s - conjugate(root)))
        put(q, VALUE_AT + lane, D)
        q[SIZE_AT + lane] = size
    return 0


@compiled
def _without(D, size, d):
    m = size_of(d)
    return times(1.0 / m, D * conjugate(d)), size - math.log(m)


@compiled
def find(free, task, starts, known, room, q, found, step):
    """Follow secants from many starts; see `riccati.damped.search.Search.run`.

    Parameters
    ----------
    free : Free
    task : Zeros
    starts, known, found : array, shape (k, 2)
        Real and imaginary parts.
    step : array, shape (k,)
        Set: the length of the last step, infinite where it did not settle.
    """
    for first in range(0, len(starts), LANES):
        number = min(LANES, len(starts) - first)
        for which in range(3):
            for lane in range(LANES):
                k = min(first + lane, len(starts) - 1)
                beside = complex(_NEAR if which == 1 else 0.0, _NEAR if which == 2 else 0.0)
                start = complex(starts[k, 0], starts[k, 1])
                put(room.work, DASHPOT + lane, start + start * beside)
                q[STEP + lane] = math.inf
                q[STEP + LANES + lane] = 0.0  # done
            if _deflated(free, task, known, room, q):
                return 1
            _keep(which, room.work, q)
        for _ in range(_PASSES):
            if not _move(task, number, room.work, q):
                break
            if _deflated(free, task, known, room, q):
                return 1
            _take(task, number, room.work, q)
        for lane in range(number):
            x = get(q, X2 + lane)
            found[first + lane, 0], found[first + lane, 1] = x.real, x.imag
            step[first + lane] = q[STEP + lane]
    return 0


@compiled
def _keep(which, w, q):
    """Keep place, value and size of one of the three."""
    at = X0 + which * (X1 - X0)
    for lane in range(LANES):
        put(q, at + lane, get(w, DASHPOT + lane))
        put(q, at + PAIR + lane, get(q, VALUE_AT + lane))
        q[at + 2 * PAIR + lane] = q[SIZE_AT + lane]


@compiled
def _value(q, at, lane, scale):
    return times(math.exp(q[at + 2 * PAIR + lane] - scale), get(q, at + PAIR + lane))


@compiled
def _move(task, number, w, q):
    """Set the next places; return how many lanes are not done."""
    open_ = 0
    for lane in range(LANES):
        x, new = get(q, X2 + lane), complex(math.nan, 0.0)
        if lane < number and q[STEP + LANES + lane] == 0.0:
            new = _next(task, lane, q)
        if math.isfinite(new.real) and math.isfinite(new.imag):
            open_ += 1
            put(w, DASHPOT + lane, new)
            q[STEP + LANES + lane] = 0.0
        else:  # it stays where it is
            put(w, DASHPOT + lane, x)
            q[STEP + LANES + lane] = 1.0
    return open_


@compiled
def _next(task, lane, q):
    """Return the place to which the parabola through three values leads."""
    x0, x1, x2 = get(q, X0 + lane), get(q, X1 + lane), get(q, X2 + lane)
    scale = max(q[X0 + 2 * PAIR + lane], q[X1 + 2 * PAIR + lane])
    scale = max(scale, q[X2 + 2 * PAIR + lane])
    y0, y1 = _value(q, X0, lane, scale), _value(q, X1, lane, scale)
    y2 = _value(q, X2, lane, scale)
    h1, h2 = x1 - x0, x2 - x1
    move = complex(0.0, 0.0)
    if square(h1) > 0.0 and square(h2) > 0.0 and square(y2) > 0.0:
        d1, d2 = over(y1 - y0, h1), over(y2 - y1, h2)
        a = over(d2 - d1, h1 + h2)
        b = a * h2 + d2
        root = root_of(b * b - times(4.0, a * y2))
        below = b - root
        if square(b + root) > square(below):
            below = b + root
        move = over(times(-2.0, y2), below)
        far, long = size_of(x2) + _FAR * task.unit, size_of(move)
        if long > far:
            move = times(far / long, move)
    new = x2 + move
    long = size_of(new)
    if long > task.most:
        new = times(task.most / long, new)
    if task.mirrored:
        if new.imag < 0.0:
            new = conjugate(new)
        if abs(new.imag) < _REAL * size_of(new):
            new = complex(new.real, 0.0)
    return new


@compiled
def _take(task, number, w, q):
    """Take the new places and values in."""
    for lane in range(number):
        if q[STEP + LANES + lane] == 0.0:
            new, before = get(w, DASHPOT + lane), get(q, X2 + lane)
            moved, long = size_of(new - before), size_of(new)
            for place in range(X1, X2 + (X2 - X1), LANES):
                q[place - (X1 - X0) + lane] = q[place + lane]
            put(q, X2 + lane, new)
            put(q, X2 + PAIR + lane, get(q, VALUE_AT + lane))
            q[X2 + 2 * PAIR + lane] = q[SIZE_AT + lane]
            q[STEP + lane] = moved if moved < _SETTLED * long + task.floor else math.inf
            if moved <= _SMALL * long or square(get(q, VALUE_AT + lane)) == 0.0:
                q[STEP + LANES + lane] = 1.0


@compiled
def modes(free, s, room, out):
    """Set the states of modes at the marks.

    Parameters
    ----------
    s : array, shape (k, 2)
        Zeros of D.
    room : Room
        For one load case, which is none.
    out : array, shape (marks, SIZE, 1, k, 2)
    """
    w, stiffness = room.work, free.chain.stiffness
    for place in range(len(room.cases[0])):
        room.cases[0, place] = 0.0
    for group in range(0, len(s), LANES):
        for lane in range(LANES):
            k = min(group + lane, len(s) - 1)
            put(w, DASHPOT + lane, complex(s[k, 0], s[k, 1]))
        bases, marks = pass_chain(free, room)
        if bases < 0:
            return 1
        _annul(free.ends.wanted[0], w, room.coefficients[0])
        back(group // LANES, w, stiffness, room, bases, marks, out)
    return 0


@compiled
def _annul(wanted, w, a):
    """Set the coefficients of the state that the right end wants the least of."""
    for lane in range(LANES):
        c00, c01 = condition(wanted, 0, w, FIRST, lane), condition(wanted, 0, w, SECOND, lane)
        c10, c11 = condition(wanted, 1, w, FIRST, lane), condition(wanted, 1, w, SECOND, lane)
        first, second = square(c00) + square(c01), square(c10) + square(c11)
        if second > first:
            c00, c01, first = c10, c11, second
        size = 1.0 / math.sqrt(first)
        put(a, lane, times(-size, c01))
        put(a, PAIR + lane, times(size, c00))
