"""g(s) of `riccati.damped.ratio` and what bounds it, compiled: samples of it, and its spread."""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import math

from antinode.riccati.lanes.compiling import compiled
from antinode.riccati.lanes.workspace import LANES

from .free import size_of
from .layout import BESIDE, DASHPOT, OMEGA2, PER_UNIT, UNIT
from .segments import over, put, square, times
from .sweep import admit, back, close, start, sweep


@compiled
def _at(array, k, i, j):
    """Return an entry of one of many matrices."""
    return complex(array[k, i, j, 0], array[k, i, j, 1])


@compiled
def _entry(array, i, j):
    return complex(array[i, j, 0], array[i, j, 1])


@compiled
def _set(array, i, j, value):
    array[i, j, 0], array[i, j, 1] = value.real, value.imag


@compiled
def _receptances(acting, places, number, room, out, G):
    """Set G at so many omega^2, shape (2 k, r, r, 2)."""
    w, free = room.work, acting.free
    for group in range(0, number, LANES):
        for lane in range(LANES):
            k = min(group + lane, number - 1)
            omega2 = complex(places[k, 0], places[k, 1])
            put(w, OMEGA2 + lane, omega2)
            put(w, DASHPOT + lane, complex(0.0, 0.0))
            unit = 1.0 / math.sqrt(math.sqrt(size_of(omega2) * free.inertia + free.rest))
            w[UNIT + lane], w[PER_UNIT + lane] = unit, 1.0 / unit
        admit(free.ends.start[0], w)
        active = start(free.chain, False, w, room.cases)
        bases, marks = sweep(free.chain, w, room, active)
        if bases < 0:
            return 1
        close(free.chain, free.ends, 0, w, room)
        back(group // LANES, w, free.chain.stiffness, room, bases, marks, out)
    r = len(acting.mark)
    for k in range(number):
        for i in range(r):
            for j in range(i + 1):
                a, b = acting.mark[i], acting.mark[j]
                p, q = acting.freedom[i], acting.freedom[j]
                re = (out[a, p, j, k, 0] + out[b, q, i, k, 0]) / 2
                im = (out[a, p, j, k, 1] + out[b, q, i, k, 1]) / 2
                G[k, i, j, 0], G[k, i, j, 1] = re, im
                G[k, j, i, 0], G[k, j, i, 1] = re, im
    return 0


@compiled
def receptances(acting, omega2, room, work):
    """Set G at many omega^2, shape (k, 2), in `work.G`."""
    return _receptances(acting, omega2, len(omega2), room, work.out, work.G)


@compiled
def _places(s, poles, places, reach, beside):
    """Set omega^2 of every s, and behind them places beside the axis; return how many in all."""
    number = len(s)
    for k in range(len(s)):
        here = complex(s[k, 0], s[k, 1])
        omega2 = -(here * here)
        least = math.inf
        for pole in poles:
            least = min(least, size_of(omega2 - pole))
        reach[k] = least * (1 - 1e-9)
        places[k, 0], places[k, 1] = omega2.real, omega2.imag
        beside[k] = -1
        if abs(omega2.imag) < BESIDE * reach[k]:
            off = -BESIDE * reach[k] if omega2.imag < 0 else BESIDE * reach[k]
            places[number, 0], places[number, 1] = omega2.real, omega2.imag + off
            beside[k] = number
            number += 1
    return number


@compiled
def _inverted(m, r, inverse):
    """Set the inverse of a matrix, which is lost; return its determinant."""
    whole = complex(1.0, 0.0)
    for i in range(r):
        for j in range(r):
            _set(inverse, i, j, complex(1.0 if i == j else 0.0, 0.0))
    for i in range(r):
        best = i
        for k in range(i + 1, r):
            if square(_entry(m, k, i)) > square(_entry(m, best, i)):
                best = k
        if best != i:
            whole = -whole
            for j in range(r):
                a, b = _entry(m, i, j), _entry(inverse, i, j)
                _set(m, i, j, _entry(m, best, j))
                _set(inverse, i, j, _entry(inverse, best, j))
                _set(m, best, j, a)
                _set(inverse, best, j, b)
        pivot = _entry(m, i, i)
        whole = whole * pivot
        one = over(complex(1.0, 0.0), pivot)
        for j in range(r):
            _set(m, i, j, _entry(m, i, j) * one)
            _set(inverse, i, j, _entry(inverse, i, j) * one)
        for k in range(r):
            if k != i:
                share = _entry(m, k, i)
                for j in range(r):
                    _set(m, k, j, _entry(m, k, j) - share * _entry(m, i, j))
                    _set(inverse, k, j, _entry(inverse, k, j) - share * _entry(inverse, i, j))
    return whole


@compiled
def values(acting, s, room, work, value):
    """Set g at many s, shape (k, 2)."""
    number = len(s)
    for k in range(number):
        here = complex(s[k, 0], s[k, 1])
        omega2 = -(here * here)
        work.places[k, 0], work.places[k, 1] = omega2.real, omega2.imag
    if _receptances(acting, work.places, number, room, work.out, work.G):
        return 1
    r = len(acting.mark)
    for k in range(number):
        here = complex(s[k, 0], s[k, 1])
        for i in range(r):
            for j in range(r):
                total = complex(1.0 if i == j else 0.0, 0.0)
                for p in range(r):
                    Z = times(acting.C[p, j], here) + acting.K[p, j]
                    total += _at(work.G, k, i, p) * Z
                _set(work.m, i, j, total)
        g = _inverted(work.m, r, work.inverse)
        value[k, 0], value[k, 1] = g.real, g.imag
    return 0


@compiled
def samples(acting, s, poles, room, work, found):
    """Set samples of g, bounded.

    Parameters
    ----------
    acting : Acting
    s : array, shape (k, 2)
    poles : array
    room : Room
    work : RatioWork
    found : Sampled
    """
    number = _places(s, poles, work.places, found.reach, work.beside)
    if _receptances(acting, work.places, number, room, work.out, work.G):
        return 1
    for k in range(len(s)):
        _sample(acting, complex(s[k, 0], s[k, 1]), k, work, found)
    return 0


@compiled
def _sample(acting, s, k, work, found):
    r, size = len(acting.mark), found.size[k]
    for i in range(r):
        S = work.G[k, i, i, 1] / work.places[k, 1]
        if work.beside[k] >= 0:
            other = work.beside[k]
            S = work.G[other, i, i, 1] * (1 + BESIDE) ** 2 / work.places[other, 1]
        size[i] = math.sqrt(max(abs(S), 1e-300))
    for i in range(r):
        for j in range(r):
            both = size[i] * size[j]
            _set(work.g, i, j, times(1.0 / both, _at(work.G, k, i, j)))
            _set(work.z, i, j, times(both, times(acting.C[i, j], s) + acting.K[i, j]))
            found.receptance[k, i, j] = size_of(_entry(work.g, i, j))
            found.stiffness[k, i, j] = size_of(_entry(work.z, i, j))
            found.damping[k, i, j] = abs(acting.C[i, j]) * both
    for i in range(r):
        for j in range(r):
            total = complex(1.0 if i == j else 0.0, 0.0)
            for p in range(r):
                total += _entry(work.g, i, p) * _entry(work.z, p, j)
            _set(work.m, i, j, total)
            found.matrix[k, i, j] = size_of(total)
    g = _inverted(work.m, r, work.inverse)
    found.value[k, 0], found.value[k, 1] = g.real, g.imag
    for i in range(r):
        for j in range(r):
            found.inverse[k, i, j] = size_of(_entry(work.inverse, i, j))
            total = complex(0.0, 0.0)
            for p in range(r):
                total += _entry(work.z, i, p) * _entry(work.inverse, p, j)
            found.acting[k, i, j, 0], found.acting[k, i, j, 1] = total.real, total.imag


@compiled
def spread(s, found, distance, room, out):
    """Set how far g may be from its values within a distance of each; infinite where unbounded.

    The change of the matrix, and what the inverse makes of it; the sums of either along rows and
    columns bound the determinant.
    """
    r = found.size.shape[1]
    for k in range(len(s)):
        t = distance[k]
        moved = t * (2 * size_of(complex(s[k, 0], s[k, 1])) + t)
        out[k] = math.inf
        if moved < found.reach[k]:
            tau = moved / (1.0 - moved / found.reach[k])
            out[k] = _bounded(found, k, t, tau, r, room)
    return 0


@compiled
def _bounded(found, k, t, tau, r, m):
    """Return the least of four bounds on the change of a determinant."""
    for j in range(r):
        acts = 0.0
        for i in range(r):
            acts += found.stiffness[k, i, j] + t * found.damping[k, i, j]
        for i in range(r):
            across = 0.0
            for p in range(r):
                across += found.receptance[k, i, p] * found.damping[k, p, j]
            m[i, j, 0] = tau * acts + t * across
    for i in range(r):
        for j in range(r):
            total = 0.0
            for p in range(r):
                total += found.inverse[k, i, p] * m[p, j, 0]
            m[i, j, 1] = total
    g = size_of(complex(found.value[k, 0], found.value[k, 1]))
    least = math.inf
    for across in range(2):
        change, relative, own = 0.0, 0.0, 1.0
        for i in range(r):
            here, more, part = 0.0, 0.0, 0.0
            for j in range(r):
                a, b = (i, j) if across == 0 else (j, i)
                here += found.matrix[k, a, b]
                more += m[a, b, 0]
                part += m[a, b, 1]
            own *= here
            change += math.log1p(more / here)
            relative += math.log1p(part)
        for bound in (own * math.expm1(change), g * math.expm1(relative)):
            if bound < least:
                least = bound
    return least
