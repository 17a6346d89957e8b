"""Counts and eigenvalues of beams whose m, EI and N vary, in 32 digits: `ManyDigits(beam, top)`.

    (EI Y'')'' + (N Y')' = omega^2 m Y, N > 0 compression

Every interval is cut into pieces that are short against the waves and the layers sqrt(EI/N) and
over which m and EI change little. In a piece Y, Y', M and Q = M' + N Y' are Taylor series about its
middle, in which m, N and EI (linear) or 1/EI (logarithmic) are series themselves: nothing is
averaged, and the series end below 1e-33. Their values at both ends make the piece's exact dynamic
stiffness, and an LDL^T of the whole counts the eigenvalues below omega^2 (Wittrick and Williams,
1971: the pieces have no clamped-clamped eigenvalue of their own) and gives the determinant.

Numbers are pairs of doubles (Dekker, 1971), so that a relative error of 1e-31 grows by the
conditioning of thousands of pieces and still leaves every digit of a double. The same with
`load_factor` at omega^2 = 0: what a factor on all axial forces buckles. Nothing is shared with the
solver: no transfer matrices, no minors, no chains of uniform segments.
"""

import math
from functools import partial

import mpmath
import numba
import numpy as np

TERMS = 48
_PHASE = 1.6  # wave number times length of a piece
_SLOPE = 0.3  # share by which m, EI change linearly over a piece, from its middle: half of it
_MOST = 8_000  # pieces
_RATE = 0.7  # logarithm of the ratio over a piece
_compiled = numba.njit(cache=True, error_model="numpy")
_inlined = partial(numba.njit, inline="never", cache=True, error_model="numpy")()


# --- pairs of doubles -------------------------------------------------------------------------


@_inlined
def _add(ah, al, bh, bl):
    s = ah + bh
    v = s - ah
    e = (ah - (s - v)) + (bh - v) + (al + bl)
    h = s + e
    return h, e - (h - s)


@_inlined
def _mul(ah, al, bh, bl):
    p = ah * bh
    t = 134217729.0 * ah
    x = t - (t - ah)
    t = 134217729.0 * bh
    y = t - (t - bh)
    e = ((x * y - p) + x * (bh - y) + (ah - x) * y) + (ah - x) * (bh - y)
    e += ah * bl + al * bh
    h = p + e
    return h, e - (h - p)


@_inlined
def _div(ah, al, bh, bl):
    q = ah / bh
    ph, pl = _mul(q, 0.0, bh, bl)
    rh, rl = _add(ah, al, -ph, -pl)
    r = rh / bh
    ph, pl = _mul(r, 0.0, bh, bl)
    rh, rl = _add(rh, rl, -ph, -pl)
    hi, lo = _add(q, 0.0, r, 0.0)
    return _add(hi, lo, rh / bh, 0.0)


# --- a piece ----------------------------------------------------------------------------------
# t runs from -1/2 to 1/2; y = Y, u = hi Y', w = M h^2/E, q = Q h^3/E with E the middle's EI.


@_compiled
def _series(c, m, n, e, log, S):
    """Fill S[state, start, term]: series of y, u, w, q for the four unit states of the middle.

    c: omega^2 m h^4/E; m: series of m by its middle; n: of N h^2/E; e: slope of EI by E, or, `log`,
    series of E/EI. All in pairs.
    """
    last = 0
    for start in range(4):
        S[:, start] = 0.0
        S[start, start, 0, 0] = 1.0
        quiet = 0
        for k in range(TERMS - 1):
            y, u, w, q = S[0, start], S[1, start], S[2, start], S[3, start]
            step = float(k + 1)
            hi, lo = _div(u[k, 0], u[k, 1], step, 0.0)
            y[k + 1, 0], y[k + 1, 1] = hi, lo
            # u' = w/e
            hi, lo = 0.0, 0.0
            if log:
                for j in range(k + 1):
                    if e[j, 0] == 0.0:
                        break
                    a, b = _mul(e[j, 0], e[j, 1], w[k - j, 0], w[k - j, 1])
                    hi, lo = _add(hi, lo, a, b)
            else:  # (1 + e t) u' = w
                a, b = _mul(e[0, 0], e[0, 1], u[k, 0], u[k, 1])
                a, b = _mul(a, b, float(k), 0.0)
                hi, lo = _add(w[k, 0], w[k, 1], -a, -b)
            u[k + 1, 0], u[k + 1, 1] = _div(hi, lo, step, 0.0)
            # w' = q - n u
            hi, lo = q[k, 0], q[k, 1]
            for j in range(k + 1):
                if n[j, 0] == 0.0 and j > 2:
                    break
                a, b = _mul(n[j, 0], n[j, 1], u[k - j, 0], u[k - j, 1])
                hi, lo = _add(hi, lo, -a, -b)
            w[k + 1, 0], w[k + 1, 1] = _div(hi, lo, step, 0.0)
            # q' = c m y
            hi, lo = 0.0, 0.0
            for j in range(k + 1):
                if m[j, 0] == 0.0 and j > 1:
                    break
                a, b = _mul(m[j, 0], m[j, 1], y[k - j, 0], y[k - j, 1])
                hi, lo = _add(hi, lo, a, b)
            hi, lo = _mul(hi, lo, c[0], c[1])
            q[k + 1, 0], q[k + 1, 1] = _div(hi, lo, step, 0.0)
            size = abs(y[k + 1, 0]) + abs(u[k + 1, 0]) + abs(w[k + 1, 0]) + abs(q[k + 1, 0])
            quiet = quiet + 1 if size * 0.5 ** (k + 1) < 1e-34 else 0
            last = max(last, k + 1)
            if quiet == 5:
                break
    return last


@_compiled
def _ends(S, last, D, F):
    """Set displacements D and forces F at both ends, (4, start), from the series."""
    for start in range(4):
        for state in range(4):
            for side in range(2):
                t = -0.5 if side == 0 else 0.5
                hi, lo = 0.0, 0.0
                for k in range(last, -1, -1):
                    hi, lo = _add(hi * t, lo * t, S[state, start, k, 0], S[state, start, k, 1])
                sign = 1.0 if side == 0 else -1.0
                if state < 2:
                    D[2 * side + state, start, 0], D[2 * side + state, start, 1] = hi, lo
                else:  # on Y: Q, -Q; on the slope: -M, M
                    row = 2 * side + (1 if state == 2 else 0)
                    sign = -sign if state == 2 else sign
                    F[row, start, 0], F[row, start, 1] = sign * hi, sign * lo


@_compiled
def _divide(F, D):
    """Set F to F D^-1 (4 x 4), by elimination with pivots; D is lost."""
    for k in range(4):
        p = k
        for j in range(k + 1, 4):
            if abs(D[k, j, 0]) > abs(D[k, p, 0]):
                p = j
        for A in (D, F):
            for i in range(4):
                for part in range(2):
                    A[i, k, part], A[i, p, part] = A[i, p, part], A[i, k, part]
        dh, dl = D[k, k, 0], D[k, k, 1]
        for A in (D, F):
            for i in range(4):
                A[i, k, 0], A[i, k, 1] = _div(A[i, k, 0], A[i, k, 1], dh, dl)
        for j in range(4):
            if j == k:
                continue
            gh, gl = D[k, j, 0], D[k, j, 1]
            for A in (D, F):
                for i in range(4):
                    a, b = _mul(gh, gl, A[i, k, 0], A[i, k, 1])
                    A[i, j, 0], A[i, j, 1] = _add(A[i, j, 0], A[i, j, 1], -a, -b)


@_compiled
def _coefficients(piece, log, omega2, load, m, n, e):
    """Set the series of a piece; return c. Its row: h, E, m0, m1, N0, N1, e1, load of mass."""
    h, E = piece[0], piece[1]
    m[:], n[:], e[:] = 0.0, 0.0, 0.0
    h2h, h2l = _mul(h[0], h[1], h[0], h[1])
    h2h, h2l = _div(h2h, h2l, E[0], E[1])  # h^2/E
    m[0, 0], rate = 1.0, piece[3]
    n[0], n[1] = piece[4], piece[5]
    if log:
        e[0, 0] = 1.0
        for j in range(1, TERMS):
            a, b = _mul(m[j - 1, 0], m[j - 1, 1], rate[0], rate[1])
            m[j, 0], m[j, 1] = _div(a, b, float(j), 0.0)
            a, b = _mul(e[j - 1, 0], e[j - 1, 1], -piece[6, 0], -piece[6, 1])
            e[j, 0], e[j, 1] = _div(a, b, float(j), 0.0)
            if abs(m[j, 0]) < 1e-36:
                m[j] = 0.0
            if abs(e[j, 0]) < 1e-36:
                e[j] = 0.0
    else:
        m[1], e[0] = rate, piece[6]
    if piece[7, 0] != 0.0:  # acceleration times m0 h, integrated
        for j in range(1, TERMS):
            a, b = _mul(piece[7, 0], piece[7, 1], m[j - 1, 0], m[j - 1, 1])
            a, b = _div(a, b, float(j), 0.0)
            n[j, 0], n[j, 1] = _add(n[j, 0], n[j, 1], a, b)
    for j in range(TERMS):
        a, b = _mul(n[j, 0], n[j, 1], h2h, h2l)
        n[j, 0], n[j, 1] = _mul(a, b, load, 0.0)
    a, b = _mul(h2h, h2l, h[0], h[1])
    a, b = _mul(a, b, h[0], h[1])
    a, b = _mul(a, b, piece[2, 0], piece[2, 1])
    return _mul(a, b, omega2, 0.0)


# --- the whole --------------------------------------------------------------------------------


@_compiled
def _eliminate(S, size, keep, tally):
    """Eliminate the first unknowns of a dense symmetric matrix until `keep` remain."""
    for k in range(size - keep):
        ph, pl = S[k, k, 0], S[k, k, 1]
        tally[0] += 1.0 if ph < 0.0 else 0.0
        mantissa, power = math.frexp(ph)
        tally[1], tally[2] = tally[1] * mantissa, tally[2] + power
        mantissa, power = math.frexp(tally[1])
        tally[1], tally[2] = mantissa, tally[2] + power
        for i in range(k + 1, size):
            gh, gl = _div(S[i, k, 0], S[i, k, 1], ph, pl)
            for j in range(k + 1, i + 1):
                a, b = _mul(gh, gl, S[j, k, 0], S[j, k, 1])
                S[i, j, 0], S[i, j, 1] = _add(S[i, j, 0], S[i, j, 1], -a, -b)
                S[j, i] = S[i, j]


@_compiled
def _place(A, row, column, hi, lo):
    A[row, column, 0], A[row, column, 1] = _add(A[row, column, 0], A[row, column, 1], hi, lo)


@_compiled
def _pass_node(S, node, omega2, load, tally):
    """Add what sits at a node: rows mass, m d, m d^2 + J, k, k_r, own load times d, compliance.

    A joint parts the slope; the one on its left is eliminated.
    """
    for i, j, inertia, spring in ((0, 0, 0, 3), (0, 1, 1, -1), (1, 1, 2, 4)):
        hi, lo = _mul(node[inertia, 0], node[inertia, 1], -omega2, 0.0)
        if spring >= 0:
            hi, lo = _add(hi, lo, node[spring, 0], node[spring, 1])
        if i == 1:
            a, b = _mul(node[5, 0], node[5, 1], load, 0.0)
            hi, lo = _add(hi, lo, a, b)
        _place(S, i, j, hi, lo)
        if i != j:
            _place(S, j, i, hi, lo)
    if node[6, 0] == 0.0:
        return
    kh, kl = _div(1.0, 0.0, node[6, 0], node[6, 1])
    T = np.zeros((3, 3, 2))  # slope on the left, Y, slope on the right
    T[0, 0], T[1, 0], T[0, 1], T[1, 1] = S[1, 1], S[0, 1], S[0, 1], S[0, 0]
    _place(T, 0, 0, kh, kl)
    _place(T, 2, 2, kh, kl)
    T[2, 0, 0], T[2, 0, 1] = -kh, -kl
    T[0, 2] = T[2, 0]
    if node[8, 0] != 0.0:  # the slope on the left is held
        S[1, 1], S[0, 1], S[1, 0] = T[2, 2], T[1, 2], T[1, 2]
        return
    _eliminate(T, 3, 2, tally)
    S[0, 0], S[0, 1], S[1, 0], S[1, 1] = T[1, 1], T[1, 2], T[1, 2], T[2, 2]


@_compiled
def _pass(pieces, first, nodes, log, omega2, load):
    """Return the count below omega^2 and the determinant's mantissa and power of two.

    nodes: as `_pass_node`, then whether Y and the slope are held. first: first piece by node.
    """
    tally = np.array([0.0, 1.0, 0.0])
    m, n, e = np.zeros((TERMS, 2)), np.zeros((TERMS, 2)), np.zeros((TERMS, 2))
    series, D, F = np.zeros((4, 4, TERMS, 2)), np.zeros((4, 4, 2)), np.zeros((4, 4, 2))
    S, A, c = np.zeros((2, 2, 2)), np.zeros((4, 4, 2)), np.zeros(2)
    at = np.zeros(4, np.int64)
    for k in range(len(nodes)):
        joint = nodes[k, 6, 0] != 0.0
        _pass_node(S, nodes[k], omega2, load, tally)
        held_Y = nodes[k, 7, 0] != 0.0
        held_slope = nodes[k, 8, 0] != 0.0 and not joint
        if k == len(nodes) - 1:
            break
        for i in range(first[k], first[k + 1]):
            c[0], c[1] = _coefficients(pieces[i], log, omega2, load, m, n, e)
            last = _series(c, m, n, e, log, series)
            _ends(series, last, D, F)
            _divide(F, D)
            # local to global: slopes times h, energies times E/h^3
            h, E = pieces[i, 0], pieces[i, 1]
            uh, ul = _mul(h[0], h[1], h[0], h[1])
            uh, ul = _mul(uh, ul, h[0], h[1])
            uh, ul = _div(E[0], E[1], uh, ul)
            size = 0
            for row in range(4):
                if not ((row == 0 and held_Y) or (row == 1 and held_slope)):
                    at[size] = row
                    size += 1
            for r in range(size):
                for s in range(size):
                    row, column = at[r], at[s]
                    a, b = _mul(F[row, column, 0], F[row, column, 1], uh, ul)
                    if row % 2:
                        a, b = _mul(a, b, h[0], h[1])
                    if column % 2:
                        a, b = _mul(a, b, h[0], h[1])
                    if row < 2 and column < 2:
                        a, b = _add(a, b, S[row, column, 0], S[row, column, 1])
                    A[r, s, 0], A[r, s, 1] = a, b
            _eliminate(A, size, 2, tally)
            for r in range(2):
                for s in range(2):
                    S[r, s] = A[size - 2 + r, size - 2 + s]
            held_Y = held_slope = False
    size = 0
    for i in range(2):
        if nodes[len(nodes) - 1, 7 + i, 0] == 0.0 or (i == 1 and joint):
            at[size] = i
            size += 1
    for r in range(size):
        for s in range(size):
            A[r, s] = S[at[r], at[s]]
    _eliminate(A, size, 0, tally)
    return int(tally[0]), tally[1], tally[2]


_HELD = {"free": (), "clamped": (0, 1), "pinned": (0,), "sliding": (1,)}


def _pair(value):
    """An mpf, or a float, as two doubles."""
    high = float(value)
    return high, float(mpmath.mpf(value) - high)


class TooFineError(ValueError):
    """The beam would need more pieces than patience allows."""


class ManyDigits:
    """A beam, ready for counts up to abs(omega^2) = `top` and `load` times its axial force."""

    def __init__(self, beam, top, load=1.0, fineness=1.0):
        self.log = beam.interpolation == "log"
        with mpmath.workdps(45):
            self.first, self.pieces = self._cut(beam, float(top), load, fineness)
            self.nodes = _nodes(beam)
        E = float(np.mean(beam.bending_stiffness))
        mass = float(np.mean(beam.mass_per_length))
        self.unit = E / (mass * beam.length**4)

    def _cut(self, beam, top, load, fineness):
        mpf, rows, first, before = mpmath.mpf, [], [0], mpmath.mpf(0)
        masses = _masses_at(beam)
        for k in range(len(beam.x) - 1):
            (ma, mb), (Ea, Eb), (Na, Nb) = (
                tuple(map(mpf, table[k].tolist()))
                for table in (beam.mass_per_length, beam.bending_stiffness, beam.axial_force)
            )
            H, a = mpf(float(beam.x[k + 1])) - mpf(float(beam.x[k])), mpf(beam.axial_acceleration)
            before += masses.get(k, 0)
            total = _mass(ma, mb, mpf(1), self.log) * H
            N = max(abs(Na), abs(Nb)) + abs(a) * (abs(before) + total)
            for t, size in _pieces(beam, k, top, float(N) * load, fineness, self.log):
                middle, h = mpf(t) + mpf(size) / 2, mpf(size) * H
                if self.log:
                    mr, er = mpmath.log(mb / ma), mpmath.log(Eb / Ea)
                    m0, E = ma * mpmath.exp(mr * middle), Ea * mpmath.exp(er * middle)
                    m1, e1 = mr * size, er * size
                else:
                    m0, E = ma + (mb - ma) * middle, Ea + (Eb - Ea) * middle
                    m1, e1 = (mb - ma) * size / m0, (Eb - Ea) * size / E
                N0 = Na + (Nb - Na) * middle + a * (before + H * _mass(ma, mb, middle, self.log))
                rows.append([*map(_pair, (h, E, m0, m1, N0, (Nb - Na) * size, e1, a * m0 * h))])
            before += total
            first.append(len(rows))
            if len(rows) > _MOST:
                raise TooFineError(f"more than {_MOST} pieces")
        return np.array(first), np.array(rows)

    def __call__(self, omega2, load=1.0):
        """Return the count below omega^2, and the determinant as (mantissa, power of two)."""
        count, mantissa, power = _pass(
            self.pieces, self.first, self.nodes, self.log, float(omega2), float(load)
        )
        assert math.isfinite(mantissa)
        return count, mantissa, power


def _pieces(beam, k, top, N, fineness, log):
    """Start and size of the pieces of an interval, as shares of it (exact doubles)."""
    (ma, mb), (Ea, Eb) = beam.mass_per_length[k].tolist(), beam.bending_stiffness[k].tolist()
    H = float(beam.x[k + 1] - beam.x[k])
    stack, found = [(0.0, 1.0)], []
    while stack:
        t, size = stack.pop()
        m, E = (_ends_of(a, b, t, t + size, log) for a, b in ((ma, mb), (Ea, Eb)))
        b = abs(N) / min(E) / 2
        wave = math.sqrt(b + math.sqrt(b * b + max(m) * top / min(E))) * H * size
        change = max(math.log(max(m) / min(m)), math.log(max(E) / min(E)))
        if len(stack) + len(found) > _MOST:
            raise TooFineError(f"more than {_MOST} pieces")
        if wave * fineness > _PHASE or change * fineness > (_RATE if log else _SLOPE):
            stack += [(t + size / 2, size / 2), (t, size / 2)]
        else:
            found.append((t, size))
    return found


def _ends_of(a, b, t0, t1, log):
    return [a * (b / a) ** t if log else a + (b - a) * t for t in (t0, t1)]


def _mass(a, b, t, log):
    """Integral of m over the first share t of an interval of unit length."""
    if not log or a == b:
        return t * (a + (b - a) * t / 2)
    rate = mpmath.log(b / a)
    return a * mpmath.expm1(rate * t) / rate


def _at(beam, item):
    return int(np.argmin(np.abs(beam.x - item.x)))


def _masses_at(beam):
    masses = {}
    for item in beam.attachments:
        if type(item).__name__ == "PointMass":
            k = _at(beam, item)
            masses[k] = masses.get(k, 0) + mpmath.mpf(item.mass)
    return masses


def _nodes(beam):
    """What sits at every breakpoint, see `_pass`."""
    mpf = mpmath.mpf
    nodes = [[mpf(0)] * 9 for _ in beam.x]
    for k, end in ((0, beam.ends.left), (-1, beam.ends.right)):
        for i in _HELD[end]:
            nodes[k][7 + i] = mpf(1)
    for item in beam.attachments:
        node, kind = nodes[_at(beam, item)], type(item).__name__
        if kind == "Joint":
            node[6] += mpf(item.rotational)
        elif kind == "Spring":
            for i, stiffness in enumerate((item.translational, item.rotational)):
                if math.isinf(stiffness):
                    node[7 + i] = mpf(1)
                else:
                    node[3 + i] += mpf(stiffness)
        else:
            m, d = mpf(item.mass), mpf(item.offset)
            node[0] += m
            node[1] += m * d
            node[2] += m * d * d + mpf(item.rotary_inertia)
            if beam.offset_weight:
                node[5] += mpf(beam.axial_acceleration) * m * d
    return np.array([[_pair(value) for value in node] for node in nodes])


# --- roots ------------------------------------------------------------------------------------


def _search(evaluate, index, low, high, floor, guess=None):
    """Return the `index`-th zero between low and high (counts below and from it), in doubles."""
    samples = {}

    def at(x):
        if x not in samples:
            samples[x] = evaluate(x)
        return samples[x]

    if guess is not None:
        for width in (1e-13, 1e-10, 1e-7, 1e-4):
            near = abs(guess) * width + floor
            a, b = guess - near, guess + near
            if low < a and b < high and at(a)[0] < index <= at(b)[0]:
                low, high = a, b
                break
    side, weight = 0, [1.0, 1.0]
    for step in range(400):
        if high - low <= 2e-16 * max(abs(low), abs(high)) + floor:
            return (low + high) / 2
        (c0, m0, p0), (c1, m1, p1) = at(low), at(high)
        x = (low + high) / 2 if low * high <= 0 or high < 4 * low else math.sqrt(low * high)
        if c1 - c0 == 1 and m0 * m1 < 0 and step % 4 < 3:
            top = max(p0, p1)
            f0, f1 = (
                math.ldexp(m, int(p - top)) * w
                for m, p, w in ((m0, p0, weight[0]), (m1, p1, weight[1]))
            )
            if f1 != f0:
                x = low - f0 * (high - low) / (f1 - f0)
            near = 1e-15 * abs(x)  # step over the root: a bracket closes from both sides
            if x - low < near:
                x = low + near
            elif high - x < near:
                x = high - near
        if not low < x < high:
            x = (low + high) / 2
        if x in (low, high):
            return x
        if at(x)[0] < index:
            weight = [1.0, weight[1] / 2 if side == -1 else 1.0]
            low, side = x, -1
        else:
            weight = [weight[0] / 2 if side == 1 else 1.0, 1.0]
            high, side = x, 1
    return (low + high) / 2


def eigenvalue(exact, index, guess, fineness=1.0):
    """The `index`-th eigenvalue omega^2 (1 the lowest) of a `ManyDigits`; `guess` saves time."""
    floor = 1e-19 * exact.unit
    low, high = guess - abs(guess) * 1e-3 - floor, guess + abs(guess) * 1e-3 + floor
    step = abs(guess) * 1e-2 + 1e-3 * exact.unit
    while exact(low)[0] >= index:
        low, step = low - step, 4 * step
    step = abs(guess) * 1e-2 + 1e-3 * exact.unit
    while exact(high)[0] < index:
        high, step = high + step, 4 * step
    return _search(exact, index, low, high, floor, guess)


def critical_load(beam, rigid, guess):
    """The factor on all axial forces at which more than the rigid rotations diverge.

    `rigid` holds the names of the rigid modes that the supports leave. At omega^2 = 0 a translation
    costs nothing: holding Y at the left end takes it away and changes no other eigenvalue's sign.
    The lowest of them is a concave function of the factor: what has diverged stays so.
    """

    def statics(load):
        exact = ManyDigits(beam, 0.0, load)
        if "translation" in rigid:
            exact.nodes[0, 7, 0] = 1.0
        return lambda factor: exact(0.0, factor)

    low, high = guess * (1 - 1e-3), guess * (1 + 1e-3)
    evaluate = statics(2 * high)
    allowed = min(int("rotation" in rigid), evaluate(guess * 1e-9)[0])
    while evaluate(low)[0] > allowed:
        low /= 2
    while evaluate(high)[0] <= allowed:
        high *= 2
        evaluate = statics(2 * high)
    return _search(evaluate, allowed + 1, low, high, 0.0, guess)
