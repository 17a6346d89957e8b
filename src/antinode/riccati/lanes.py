r"""The bending chain in compiled code: eight omega^2 side by side, counts and roots certified.

What the Riccati form carries as a frame (`riccati.chain`) travels here as its 2 x 2 minors,
``a = Y^theta, b = Y^M, e = Y^Q = theta^M, d = theta^Q, f = M^Q`` (x^y: the minor of those rows).
They determine the plane, ``K = P S = [[d, -e], [-e, b]] / a``, obey a linear equation,

    a' = b/EI,  b' = 2e - N a,  e' = d,  d' = f/EI - m omega^2 a,  f' = -N d - m omega^2 b,

and so need neither division nor orthonormalisation. ``a`` is det A, and the characteristic
function of every end is one of the five. In a segment of length h, with n = N h^2/EI and
c = m omega^2 h^4/EI, the solution is made of G0 and its derivatives G1, G2, G3,

    G0^(5) + 2n G0''' + (n^2 + 4c) G0' = 0,   G0''''(0) = 1, all lower ones zero,

polynomials in c whose coefficients depend on the segment alone (docs/theory/lanes.md). Counts are
those of Wittrick and Williams, joint by joint in segments too short for roots of their own.

All numbers are made dimensionless by the chain's length, mean EI and mean m. Numba keeps compiled
code by the date of one file: all that is compiled together stands here.
"""

from __future__ import annotations

import math
import threading
from typing import Any, NamedTuple

import numba
import numpy as np
import numpy.typing as npt
from numba.core import types
from numba.extending import intrinsic

from .chain import Chain, Evaluation, omega2_scale
from .chain import evaluate as evaluate_readable
from .roots import Eigenvalue

Array = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]

LANES = 8
ENDS = {"free": 0, "clamped": 1, "pinned": 2, "sliding": 3}

_STEP = 0.6  # wave number times length of a piece, at most: four terms in c reach rounding
_IN_C, _IN_N = 4, 9  # terms of the series in c and in n
_ROWS = 24  # of the table of pieces: 16 coefficients, n, 2c/omega^2, 4 ratios of units, h, 1/EI
_RESCALE = 128  # pieces after which the lanes are scaled
_HUGE = 4e6  # pieces
_KEPT = 16  # sizes of chains whose arrays a thread keeps
_SMALL = 1e-60  # of the minors, or 1 over it: what lies between is not scaled


def _series() -> Array:
    """Return T[m, j, i]: ``G_m = sum of T[m, j, i] (2c)^j n^i``."""
    T = np.zeros((4, _IN_C, _IN_N))
    for m, j, i in np.ndindex(*T.shape):
        binomial = math.comb(2 * j + 1 + i, i) * (-1) ** i
        T[m, j, i] = (-2.0) ** j * binomial / math.factorial(4 * j + 4 + 2 * i - m)
    return T


_T = _series()


def _prefer_wide(_context: Any, builder: Any, _signature: Any, _arguments: Any) -> Any:
    attributes = builder.function.attributes
    if isinstance(attributes, set):
        set.add(attributes, '"prefer-vector-width"="512"')
    return _context.get_dummy_value()


def _wide(_typing: Any) -> Any:
    """Ask LLVM for whole 512-bit vectors where the processor has them (it prefers halves)."""
    return types.none(), _prefer_wide


_wide_vectors: Any = intrinsic(_wide)


_OPTIONS: dict[str, Any] = {
    "cache": True,
    "nogil": True,
    "error_model": "numpy",
    "fastmath": {"contract", "nsz", "arcp"},
    "_nrt": False,  # nothing is allocated inside, and no array's references are counted
}
_compiled = numba.njit(**_OPTIONS)


# --- the table of pieces ----------------------------------------------------------------------


@_compiled
def _pieces(h, m, EI, N, omega2, starts):
    """Set the first piece of every segment; return how many pieces reach up to |omega2|."""
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


@_compiled
def _fill(h, m, EI, N, starts, marks, table):
    """Fill the table: one column a piece."""
    previous_h, previous_f = 1.0, 1.0
    for k in range(len(h)):
        pieces = starts[k + 1] - starts[k]
        size, f = h[k] / pieces, 1.0 / EI[k]
        if marks[k] >= 0:
            previous_h, previous_f = 1.0, 1.0
        square = size * size
        for i in range(starts[k], starts[k + 1]):
            r, s = size / previous_h, f / previous_f
            table[16, i], table[17, i] = N[k] * square * f, 2.0 * m[k] * square * square * f
            table[18, i], table[19, i] = r * s, r * r * s
            table[20, i], table[21, i] = r * r * r * s, r * r * r * r * s * s
            table[22, i], table[23, i] = size, f
            previous_h, previous_f = size, f
    _fill_series(table, starts[len(h)])


@_compiled
def _fill_series(table, last):
    """Fill the coefficients of the series, which follow from n."""
    _wide_vectors()
    for g in range(4):
        for j in range(_IN_C):
            row = table[4 * g + j]
            n = table[16]
            t0, t1, t2, t3, t4 = _T[g, j, 0], _T[g, j, 1], _T[g, j, 2], _T[g, j, 3], _T[g, j, 4]
            t5, t6, t7, t8 = _T[g, j, 5], _T[g, j, 6], _T[g, j, 7], _T[g, j, 8]
            for i in range(last):
                x = n[i]
                row[i] = t0 + x * (
                    t1 + x * (t2 + x * (t3 + x * (t4 + x * (t5 + x * (t6 + x * (t7 + x * t8))))))
                )


@_compiled
def _fill_force(N, starts, table):
    """Fill what depends on the axial force, for a chain whose other numbers stand in the table."""
    for k in range(len(N)):
        for i in range(starts[k], starts[k + 1]):
            table[16, i] = N[k] * (table[22, i] * table[22, i] * table[23, i])
    _fill_series(table, starts[len(N)])


# --- one pass of eight lanes ------------------------------------------------------------------
# state: rows of 8 lanes, one after the other: a, b, 2e, 2d, 2f in the units of the last piece,
# the count, omega^2, and the power of two taken out.


@_compiled
def _advance(table, state, first, last):
    """Carry the lanes through pieces: equation 74 in minors, and the count of every joint."""
    _wide_vectors()
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


@_compiled
def repeat(table, state, last, times):
    """Pass a free chain a number of times: to be timed."""
    for _ in range(times):
        _start(state, 0)
        _advance(table, state, 0, last)


@_compiled
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


@_compiled
def _to_chain_units(table, piece, state):
    h, f = table[22, piece], table[23, piece]
    for lane in range(LANES):
        state[8 + lane] /= h * f
        state[16 + lane] /= h * h * f
        state[24 + lane] /= h * h * h * f
        state[32 + lane] /= h * h * h * h * f * f


@_compiled
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


@_compiled
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


@_compiled
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


@_compiled
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


@_compiled
def _sweep(table, starts, marks, points, left, right, state, sign, value):
    """Pass the chain from left to right."""
    for lane in range(LANES):
        sign[lane] = 1.0 if left > 0 else 0.0
    _start(state, left)
    first, n = 0, len(starts) - 1
    for node in range(n + 1):
        if marks[node] < 0 and node < n:
            continue
        _stretch(table, state, first, starts[node], sign)
        first = starts[node]
        if marks[node] >= 0:
            _pass_point(points[marks[node]], state, sign)
    _rescale(state)
    _finish(state, right, value)


@_compiled
def _evaluate(table, starts, marks, points, left, right, omega2, state, sign, found, count, value):
    """Evaluate a chain at any number of omega^2."""
    for first in range(0, len(omega2), LANES):
        for lane in range(LANES):
            state[48 + lane] = omega2[min(first + lane, len(omega2) - 1)]
        _sweep(table, starts, marks, points, left, right, state, sign, found)
        for lane in range(min(LANES, len(omega2) - first)):
            count[first + lane] = int(state[40 + lane])
            value[first + lane] = found[lane]


def evaluate(chain: Chain, omega2: npt.ArrayLike) -> Evaluation:
    """Count the eigenvalues below each `omega2`: `riccati.chain.evaluate`, compiled.

    Parameters
    ----------
    chain : Chain
        Of the bending family; supports at its two ends belong into `left` and `right`.
    omega2 : array_like, shape (k,)
        [rad^2/s^2], any sign.

    Returns
    -------
    Evaluation
        The characteristic function is scaled to the last minors of each omega^2: bounded by 1.
    """
    lanes = np.atleast_1d(np.asarray(omega2, dtype=float))
    n = len(chain.length)
    if chain.family != "bending" or any(p.holds and p.node in (0, n) for p in chain.points):
        return evaluate_readable(chain, lanes)
    L, EI0, m0 = _units(chain)
    marks, points = _point_table(chain, L, EI0, m0)
    own = chain.length / L, chain.mass / m0, chain.stiffness / EI0, chain.axial_force * L * L / EI0
    scaled, starts = lanes * (m0 * L**4 / EI0), np.empty(n + 1, np.int64)
    pieces = _pieces(*own, np.max(np.abs(scaled)), starts)
    if pieces < 0:
        worst = float(np.max(np.abs(lanes)))
        raise FloatingPointError(f"omega^2 = {worst:g} rad^2/s^2 is out of reach for this chain")
    table = np.empty((_ROWS, pieces))
    _fill(*own, starts, marks, table)
    count, value = np.empty(len(lanes), np.int64), np.empty(len(lanes))
    _evaluate(
        *(table, starts, marks, points, ENDS[chain.left], ENDS[chain.right], scaled),
        *(np.zeros(8 * LANES), np.zeros(LANES), np.zeros(LANES), count, value),
    )
    return Evaluation(count, value)


def _units(chain: Chain) -> tuple[float, float, float]:
    """Return length [m], EI [N m^2] and mass per length [kg/m] that make a chain dimensionless."""
    L = float(np.sum(chain.length))
    return L, *chain.reference()


def _point_table(chain: Chain, L: float, EI0: float, m0: float) -> tuple[Integers, Array]:
    """Return which point sits at every node (-1: none), and the points' dimensionless numbers."""
    marks = np.full(len(chain.length) + 1, -1)
    table = np.zeros((len(chain.points), 8))
    for k, p in enumerate(chain.points):
        marks[p.node] = k
        inertia = p.mass * p.offset**2 + p.inertia
        turning = p.rotational_spring + p.own_load * p.offset if p.loads else 0.0
        table[k] = (
            *(p.mass / (m0 * L), p.mass * p.offset / (m0 * L**2), inertia / (m0 * L**3)),
            *(p.spring * L**3 / EI0, turning * L / EI0),
            *(float(0 in p.holds), float(1 in p.holds), p.compliance * EI0 / L),
        )
    return marks, table


# --- roots ------------------------------------------------------------------------------------
# A solver keeps all samples of one chain. Eigenvalue k of those wanted has index `below + k + 1`
# among all: its bracket lies between the highest sample that counts less and the lowest that does
# not. Inside, the characteristic function divided by (omega^2 - root) of the other roots is
# nearly linear: it has no poles, and no other zero near.

CERTIFIED, OUT_OF_REACH, NOT_BRACKETED, NOT_FINITE, INVALID, CLUSTERED = 0, 1, 2, 3, 4, 5
TABLE_TOO_SMALL = -1

_MOST_SAMPLES = 256, 64  # and more for every root
_MOST_PASSES = 100
_EPSILON = 64 * float(np.finfo(float).eps)  # rounding of the minors, relative
_MARGIN = 0.45  # half the distance of the certifying samples, in widths
_SURE = 0.3  # share of a bracket that rounding may take
_PARTED = 1e-7  # relative distance of roots below which frames part them, and their shapes
_NEIGHBOURS = 4  # roots on each side that are divided out


@_compiled
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


@_compiled
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


@_compiled
def _nearest(k, index, samples, total, root, near):
    """Collect up to four samples next to root k that lie between its neighbours."""
    found = 0
    left = 0.0 if root[0] > 0.0 else -np.inf
    if k > 0:
        left = root[k - 1]
    right = root[k + 1] if k + 1 < len(root) else np.inf
    for i in range(total):
        x, count = samples[0, i], samples[1, i]
        if x <= left or x >= right or count < index - 1 or count > index:
            continue
        away = abs(x - root[k])
        if found == 4 and away >= abs(samples[0, near[3]] - root[k]):
            continue
        place = min(found, 3)
        while place > 0 and abs(samples[0, near[place - 1]] - root[k]) > away:
            near[place] = near[place - 1]
            place -= 1
        near[place] = i
        found = min(found + 1, 4)
    return found


@_compiled
def _latest(k, index, samples, root, own, near):
    """Collect the samples that root k asked for last, as `_nearest` would."""
    found = 0
    left = root[k - 1] if k > 0 else (0.0 if root[0] > 0.0 else -np.inf)
    right = root[k + 1] if k + 1 < len(root) else np.inf
    for i in range(4):
        j = own[k, i]
        if j >= 0 and left < samples[0, j] < right and index - 1 <= samples[1, j] <= index:
            near[found] = j
            found += 1
    return found


@_compiled
def _interpolate(x, y, number):
    """Return x where the polynomial x(y) through the points has y = 0 (Lagrange)."""
    result = 0.0
    for i in range(number):
        term = x[i]
        for j in range(number):
            if j != i:
                term *= -y[j] / (y[i] - y[j])
        result += term
    return result


@_compiled
def _predict(k, index, samples, total, root, rigid, slope, own, near, x, y):
    """Return a root from the samples next to it, and its likely error (inf: no prediction)."""
    number = _latest(k, index, samples, root, own, near)
    if number < 2 and (slope == 0.0 or number == 0):
        number = _nearest(k, index, samples, total, root, near)
    if number == 0:
        return root[k], np.inf
    for i in range(number):
        j = near[i]
        value = math.ldexp(samples[2, j], int(samples[3, j] - samples[3, near[0]]))
        x[i], y[i] = samples[0, j], value / _others(samples[0, j], root, k, rigid)
    if number == 1:
        if slope == 0.0:
            return root[k], np.inf
        step = math.ldexp(y[0], int(samples[3, near[0]])) / slope
        return x[0] - step, abs(step)
    better = _interpolate(x, y, number)
    rough = _interpolate(x, y, number - 1) if number > 2 else x[0]
    gap = abs(root[k])
    if k > 0:
        gap = min(gap, abs(root[k] - root[k - 1]))
    if k + 1 < len(root):
        gap = min(gap, abs(root[k + 1] - root[k]))
    return better, abs(better - rough) * min(1.0, abs(x[number - 1] - better) / gap)


@_compiled
def _slopes(samples, total, root, below, slope, near):
    """Set the divided function's slope at every root, for the next chain's first step."""
    for k in range(len(root)):
        slope[k] = 0.0
        number = _nearest(k, below + k + 1, samples, total, root, near)
        for i in range(number):
            j = near[i]
            x = samples[0, j]
            away = x - root[k]
            if abs(away) > 1e-8 * abs(root[k]):
                value = samples[2, j] / _others(x, root, k, below)
                slope[k] = math.ldexp(value / away, int(samples[3, j]))
                break


@_compiled
def _choose(
    k, index, samples, total, lo, hi, root, rigid, slope, width, stuck, own, near, x, y, wanted
):
    """Return how many samples root k asks for next (0: certified), and set them."""
    bounded = math.isfinite(lo) and math.isfinite(hi)
    if bounded and hi - lo <= width * max(abs(lo), abs(hi)):
        return 0
    if bounded and stuck[k] >= 5:
        stuck[k] = 0
        if lo > 0.0 and hi > 2.0 * lo:
            wanted[0] = math.sqrt(lo * hi)
        else:
            wanted[0] = (lo + hi) / 2
        return 1
    guess, error = _predict(k, index, samples, total, root, rigid, slope, own, near, x, y)
    inside = lo < guess < hi and math.isfinite(error)
    if not inside:
        if math.isinf(lo):
            wanted[0] = hi - 4.0 * max(abs(hi), 1.0) if hi <= 1e-3 else hi / 8.0
        elif math.isinf(hi):
            wanted[0] = 2.0 * max(lo, 1.0)
        elif lo > 0.0 and hi > 2.0 * lo:
            wanted[0] = math.sqrt(lo * hi)
        else:
            wanted[0] = (lo + hi) / 2
        root[k] = wanted[0]
        return 1
    root[k] = guess
    size = abs(guess) * width
    if error > 0.1 * size:
        wanted[0] = guess
        return 1
    number = 0
    if lo < guess - _MARGIN * size:
        wanted[number] = guess - _MARGIN * size
        number += 1
    if hi > guess + _MARGIN * size:
        wanted[number] = guess + _MARGIN * size
        number += 1
    if number == 2 and hi - lo < 1.05 * size:
        number = 1
    return number


@_compiled
def _take_sample(lane, state, value, samples, total, below, low, high, counts, at):
    """Keep one lane, and let it narrow the brackets."""
    omega2, count = state[48 + lane], int(state[40 + lane])
    samples[0, total], samples[1, total] = omega2, count
    samples[2, total], samples[3, total] = value[lane], state[56 + lane]
    for row in range(5):
        samples[4 + row, total] = state[8 * row + lane]
    for k in range(len(low)):
        if count <= below + k:
            if omega2 > low[k]:
                low[k], counts[k, 0], at[k, 0] = omega2, count, total
        elif omega2 < high[k]:
            high[k], counts[k, 1], at[k, 1] = omega2, count, total


@_compiled
def _between(samples, at, root):
    """Return the root by the secant of its bracket, where the ends have different signs."""
    low, high = at
    before = samples[2, low]
    after = math.ldexp(samples[2, high], int(samples[3, high] - samples[3, low]))
    if not before * after < 0.0:
        return root
    return samples[0, low] + (samples[0, high] - samples[0, low]) * before / (before - after)


@_compiled
def _rounding(samples, at, right, force):
    """Estimate the rounding of a root: that of the minors, over the slope of the one that is 0.

    The determinant of two roots that nearly coincide is small of second order, and its sign is
    sure no nearer to them than the square root of rounding.
    """
    low, high = at
    width = samples[0, high] - samples[0, low]
    scale = 1.0 / math.sqrt(math.sqrt(abs(samples[0, low]) + force * force + 1.0))
    units = (1.0, scale, scale**2 / 2, scale**3 / 2, scale**4 / 2)
    size = 0.0
    for row in range(5):
        size = max(size, abs(samples[4 + row, low]) * units[row])
    unit = units[4] if right == 0 else units[0] if right == 1 else units[1 if right == 2 else 3]
    other = math.ldexp(samples[2, high], int(samples[3, high] - samples[3, low]))
    rise = (abs(samples[2, low]) + abs(other)) * unit
    return _EPSILON * size * width / rise if rise > 0.0 else np.inf


@_compiled
def _cancelling(omega2, force):
    """Estimate the rounding of omega^2 that is small against what EI and N add to it."""
    wave = force / 2.0 + math.sqrt(force * force / 4.0 + abs(omega2))
    return _EPSILON * (abs(omega2) + 2.0 * force * wave)


@_compiled
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


@_compiled
def _solve(
    h, m, EI, N, ends, below, warm, root, slope, width, low, high, counts, rounding, table, work,
    reach,
):  # fmt: skip
    """Bracket and certify the eigenvalues below + 1 ... below + len(root) of one chain.

    `root` holds guesses if `warm`, `slope` those of `_slopes`; both are set for the next chain.
    If the table is filled up to some omega^2 = `reach` > 0, the guesses are taken for exact: the
    first samples are those that certify them.
    Returns the reason, and the number of samples, or that of the table's columns needed.
    """
    samples, asked, owner, starts, marks, points, state, sign, value, before = work[:10]
    stuck, at, own, near, x, y, wanted = work[10:]
    total, number = 0, len(root)
    for k in range(number):
        asked[k], owner[k], before[k], stuck[k] = root[k], k, np.inf, 0
        low[k], high[k] = -np.inf, np.inf
        own[k, 0] = own[k, 1] = own[k, 2] = own[k, 3] = -1
    if not warm:
        number = _first_samples(h, m, EI, N, 2 * (max(below - 2, 0) + number) + 3, asked)
        for k in range(number):
            owner[k] = -1
        for k in range(len(root)):
            slope[k] = 0.0
    elif reach > 0.0:
        number = 2 * len(root)
        for k in range(len(root)):
            size = _MARGIN * width * abs(root[k])
            asked[2 * k], asked[2 * k + 1] = root[k] - size, root[k] + size
            owner[2 * k] = owner[2 * k + 1] = k
    for turn in range(_MOST_PASSES):
        if total + number > samples.shape[1]:
            break
        largest = 0.0
        for k in range(number):
            largest = max(largest, abs(asked[k]))
        if largest > reach:
            reach = 1.2 * largest
            pieces = _pieces(h, m, EI, N, reach, starts)
            if pieces < 0:
                return OUT_OF_REACH, total
            if pieces > table.shape[1]:
                return TABLE_TOO_SMALL, pieces
            _fill(h, m, EI, N, starts, marks, table)
        for first in range(0, number, LANES):
            for lane in range(LANES):
                state[48 + lane] = asked[min(first + lane, number - 1)]
            _sweep(table, starts, marks, points, ends[0], ends[1], state, sign, value)
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
        number = 0
        for k in range(len(root)):
            more = _choose(
                *(k, below + k + 1, samples, total, low[k], high[k], root, below, slope[k]),
                *(width, stuck, own, near, x, y, wanted),
            )
            for i in range(more):
                asked[number], owner[number] = wanted[i], k
                number += 1
        if number == 0:
            for k in range(len(root)):
                root[k] = _between(samples, at[k], root[k])
                root[k] = min(max(root[k], low[k]), high[k])
            _slopes(samples, total, root, below, slope, near)
            force, most, sure = 0.0, 0.0, True
            for i in range(len(h)):
                force, most = force + abs(N[i]) * h[i], max(most, abs(N[i]))
            for k in range(len(root)):
                rounding[k] = _rounding(samples, at[k], ends[1], force)
                sure = sure and rounding[k] <= _SURE * width * abs(root[k])
                rounding[k] = max(rounding[k], _cancelling(root[k], most))
            return CERTIFIED if sure else CLUSTERED, total
    return NOT_BRACKETED, total


def _workspace(n: int, roots: int) -> tuple[Array | Integers, ...]:
    """Return the arrays that `_solve` writes into."""
    most = _MOST_SAMPLES[0] + _MOST_SAMPLES[1] * roots
    return (
        np.empty((9, most)),
        np.empty(most),
        np.zeros(most, np.int64),
        np.empty(n + 1, np.int64),
        np.full(n + 1, -1),
        np.empty((0, 8)),
        np.zeros(8 * LANES),
        np.zeros(LANES),
        np.zeros(LANES),
        np.zeros(roots),
        np.zeros(roots, np.int64),
        np.zeros((roots, 2), np.int64),
        np.zeros((roots, 4), np.int64),
        np.zeros(4, np.int64),
        np.zeros(4),
        np.zeros(4),
        np.zeros(2),
    )


@_compiled
def _is_valid(h, m, EI, N):
    """Tell whether lengths, masses and stiffnesses are positive, and all is finite."""
    valid = True
    for k in range(len(h)):
        positive = 0.0 < h[k] < np.inf and 0.0 < m[k] < np.inf and 0.0 < EI[k] < np.inf
        valid = valid and positive and abs(N[k]) < np.inf
    return valid


@_compiled
def _dimensionless(h, m, EI, N, own):
    """Set own to the chain in units of its length and its mean m and EI; return that of omega^2."""
    L, m0, EI0, n = 0.0, 0.0, 0.0, len(h)
    for k in range(n):
        L, m0, EI0 = L + h[k], m0 + m[k] / n, EI0 + EI[k] / n
    for k in range(n):
        own[0, k], own[1, k] = h[k] / L, m[k] / m0
        own[2, k], own[3, k] = EI[k] / EI0, N[k] * (L * L / EI0)
    return EI0 / (m0 * L * L * L * L)


@_compiled
def _scale(own):
    """Make the rows h, m, EI, N of a chain dimensionless; return length, mean m and mean EI."""
    L, m0, EI0, n = 0.0, 0.0, 0.0, own.shape[1]
    for k in range(n):
        L, m0, EI0 = L + own[0, k], m0 + own[1, k] / n, EI0 + own[2, k] / n
    for k in range(n):
        own[0, k], own[1, k] = own[0, k] / L, own[1, k] / m0
        own[2, k], own[3, k] = own[2, k] / EI0, own[3, k] * (L * L / EI0)
    return L, m0, EI0


@_compiled
def _solve_rows(
    length, mass, stiffness, force, ends, below, width, first, warm, current, slope, own, table,
    work, root, low, high, counts, rounding, reason, total
):  # fmt: skip
    """Solve chains from row `first` on; return (row, columns) if one needs a larger table."""
    for b in range(first, len(mass)):
        i = b if len(length) > 1 else 0
        if not _is_valid(length[i], mass[b], stiffness[b], force[b]):
            reason[b] = INVALID
            continue
        unit = _dimensionless(length[i], mass[b], stiffness[b], force[b], own)
        for _attempt in range(2):
            reason[b], more = _solve(
                *(own[0], own[1], own[2], own[3], ends, below, warm[0], current, slope),
                *(width, low[b], high[b], counts[b], rounding[b], table, work, 0.0),
            )
            if reason[b] == TABLE_TOO_SMALL:
                return b, more
            total[b] += more
            if reason[b] == CERTIFIED or reason[b] == CLUSTERED or not warm[0]:
                break
            warm[0] = False
        warm[0] = reason[b] == CERTIFIED
        for k in range(root.shape[1]):
            root[b, k] = unit * min(max(current[k], low[b, k]), high[b, k])
            low[b, k], high[b, k] = unit * low[b, k], unit * high[b, k]
            rounding[b, k] *= unit
    return len(mass), 0


def solve_chains(
    length: Array,
    mass: Array,
    stiffness: Array,
    force: Array,
    ends: Integers,
    below: int,
    width: float,
    results: tuple[Array, Array, Array, Integers, Array],
) -> tuple[Integers, Integers]:
    """Solve chain after chain, each from the roots of the one before.

    Parameters
    ----------
    length, mass, stiffness, force : array, shape (chains, n)
        As in `Chain`, each row a chain; one row of lengths may serve all.
    ends : array of int, shape (2,)
        Numbers of `ENDS`.
    below : int
        Eigenvalues below those wanted: the rigid ones.
    width : float
        Relative width of the brackets in omega^2.
    results : tuple of array
        Set to the roots, shape (chains, roots), the lower and upper ends of their brackets, their
        counts, shape (chains, roots, 2), and the rounding; [rad^2/s^2].

    Returns
    -------
    reason, total : array of int, shape (chains,)
        0 where all roots are certified, and the number of evaluations.
    """
    chains, n = mass.shape
    roots = results[0].shape[1]
    reason, total = np.zeros(chains, np.int64), np.zeros(chains, np.int64)
    warm, current, slope, own = (
        np.zeros(1, bool),
        np.zeros(roots),
        np.zeros(roots),
        np.empty((4, n)),
    )
    table, work, row = np.empty((_ROWS, n + n // 2 + 8)), _workspace(n, roots), 0
    while row < chains:
        row, columns = _solve_rows(
            *(length, mass, stiffness, force, ends, below, width, row, warm, current, slope),
            *(own, table, work, *results, reason, total),
        )
        if row < chains:
            warm[0], table = False, np.empty((_ROWS, columns + columns // 2))
    return reason, total


@_compiled
def _solve_guessed(
    own, force, ends, below, width, guess, root, low, high, counts, rounding, reason, total,
    table, work, most, slope,
):  # fmt: skip
    """Certify the guesses for chains that differ in axial force alone; refine those that fail."""
    L, m0, EI0 = _scale(own)
    unit, pull = EI0 / (m0 * L * L * L * L), L * L / EI0
    starts, marks, reach, n = work[3], work[4], 0.0, own.shape[1]
    for b in range(len(force)):
        outside, highest, finite = reach == 0.0, 0.0, True
        for k in range(n):
            N = force[b, k] * pull
            own[3, k] = N
            outside = outside or abs(N) > most[k]
            finite = finite and abs(N) < np.inf
        for k in range(root.shape[1]):
            root[b, k] = guess[b, k] / unit
            highest = max(highest, abs(root[b, k]))
            finite = finite and abs(root[b, k]) < np.inf
            slope[k] = 0.0
        if not finite:
            reason[b] = NOT_FINITE
            continue
        if outside or highest * (1.0 + width) > reach:
            reach = 1.2 * highest
            for k in range(n):
                most[k] = max(most[k], 1.1 * abs(own[3, k]))
            pieces = _pieces(own[0], own[1], own[2], most, reach, starts)
            if pieces < 0 or pieces > table.shape[1]:
                reason[b], reach = NOT_BRACKETED, 0.0
                continue
            _fill(own[0], own[1], own[2], own[3], starts, marks, table)
        else:
            _fill_force(own[3], starts, table)
        reason[b], more = _solve(
            *(own[0], own[1], own[2], own[3], ends, below, True, root[b], slope, width),
            *(low[b], high[b], counts[b], rounding[b], table, work, reach),
        )
        total[b] += more
        if more > 2 * root.shape[1]:
            reach = 0.0
        for k in range(root.shape[1]):
            root[b, k] *= unit
            low[b, k], high[b, k] = unit * low[b, k], unit * high[b, k]
            rounding[b, k] *= unit


def certify_guesses(
    chain: tuple[Array, Array, Array],
    force: Array,
    ends: Integers,
    below: int,
    width: float,
    guess: Array,
    results: tuple[Array, Array, Array, Integers, Array],
) -> tuple[Integers, Integers]:
    """Certify guesses for chains of one structure under many axial forces.

    Parameters
    ----------
    chain : tuple of array, shape (n,)
        Length, mass and stiffness of all.
    force : array, shape (chains, n)
    guess : array, shape (chains, roots)
        [rad^2/s^2].
    ends, below, width, results
        As for `solve_chains`.

    Returns
    -------
    reason, total : array of int, shape (chains,)
        0 where all roots are certified, and the number of evaluations: two a root where the guess
        held.
    """
    chains, n = force.shape
    roots = guess.shape[1]
    reason, total = np.zeros(chains, np.int64), np.zeros(chains, np.int64)
    own = np.zeros((4, n))
    own[0], own[1], own[2] = chain
    _solve_guessed(
        *(own, force, ends, below, width, guess, *results, reason, total),
        *(_scratch.table(n + 64), _scratch.work(n, roots), np.zeros(n), np.zeros(roots)),
    )
    return reason, total


class Roots(NamedTuple):
    """Consecutive eigenvalues of one chain, each with its certificate, and how they were found."""

    reason: int
    omega2: Array
    low: Array
    high: Array
    counts: Integers
    rounding: Array
    slope: Array
    """Of the divided characteristic function: a start for a chain that resembles this one."""
    evaluations: int


class SingleChain:
    """One chain made dimensionless, ready for evaluations and root searches.

    Parameters
    ----------
    chain : Chain
        Of the bending family, without supports in `points` at its two ends.
    """

    def __init__(self, chain: Chain) -> None:
        own = np.empty((4, len(chain.length)))
        own[0], own[1] = chain.length, chain.mass
        own[2], own[3] = chain.stiffness, chain.axial_force
        L, m0, EI0 = _scale(own)
        self.own, self.unit = own, EI0 / (m0 * L**4)
        self.left, self.right = ENDS[chain.left], ENDS[chain.right]
        self.points: tuple[Integers, Array] | None = None
        if chain.points:
            self.points = _point_table(chain, L, EI0, m0)

    def _work(self, roots: int) -> tuple[Any, ...]:
        work = _scratch.work(self.own.shape[1], roots)
        return work if self.points is None else (*work[:4], *self.points, *work[6:])

    def count(self, omega2: Array) -> Integers:
        """Return how many eigenvalues lie below each omega^2 [rad^2/s^2]."""
        scaled, work = omega2 / self.unit, self._work(1)
        pieces = _pieces(*self.own, float(np.max(np.abs(scaled))), work[3])
        if pieces < 0:
            raise FloatingPointError("omega^2 is out of reach for this chain")
        table = _scratch.table(pieces)
        _fill(*self.own, work[3], work[4], table)
        count, value = np.empty(len(scaled), np.int64), np.empty(len(scaled))
        _evaluate(table, *work[3:6], self.left, self.right, scaled, *work[6:9], count, value)
        return count

    def roots(self, below: int, number: int, width: float, start: Roots | None = None) -> Roots:
        """Bracket and certify eigenvalues below + 1 ... below + number.

        Parameters
        ----------
        width : float
            Relative width of the brackets in omega^2.
        start : Roots, optional
            As many of a chain that resembles this one, to start from.
        """
        work, ends = self._work(number), np.array([self.left, self.right])
        values, counts = np.zeros((5, number)), np.zeros((number, 2), np.int64)
        root, slope, low, high, rounding = values
        warm, total, columns = start is not None, 0, self.own.shape[1] + 8
        if start is not None:
            root[:], slope[:] = start.omega2 / self.unit, start.slope
        while True:
            reason, more = _solve(
                *(*self.own, ends, below, warm, root, slope, width, low, high, counts, rounding),
                *(_scratch.table(columns), work, 0.0),
            )
            if reason == TABLE_TOO_SMALL:
                columns, warm = more, False
                continue
            total += more
            if reason in (CERTIFIED, CLUSTERED) or not warm:
                break
            warm = False
        kept = slope.copy()
        values *= self.unit
        return Roots(reason, root, low, high, counts, rounding, kept, total)


class _Scratch(threading.local):
    """Arrays that root searches of one thread write into, kept from one to the next."""

    def __init__(self) -> None:
        self.kept: dict[tuple[int, int], tuple[Any, ...]] = {}
        self.columns = np.empty((_ROWS, 0))

    def work(self, n: int, roots: int) -> tuple[Any, ...]:
        if (n, roots) not in self.kept:
            if len(self.kept) == _KEPT:
                self.kept.clear()
            self.kept[n, roots] = _workspace(n, roots)
        return self.kept[n, roots]

    def table(self, columns: int) -> Array:
        if self.columns.shape[1] < columns:
            self.columns = np.empty((_ROWS, columns + columns // 2))
        return self.columns


_scratch = _Scratch()


def find_eigenvalues(
    chain: Chain, wanted: int, *, zeros: int = 0, width: float = 1e-10
) -> list[Eigenvalue] | None:
    """Return the lowest eigenvalues of a chain as `riccati.roots.find_eigenvalues` does.

    None where determinants do not do: longitudinally, at springs or supports of the ends, and
    for modes that nearly coincide; the frames do there.
    """
    n = len(chain.length)
    if chain.family != "bending" or any(p.holds and p.node in (0, n) for p in chain.points):
        return None
    ready = SingleChain(chain)
    floor = _floor(ready, omega2_scale(chain), zeros)
    if floor is None:
        return None
    distance, negative = floor
    found: list[Eigenvalue] = []
    parts = [(0, negative), (negative + zeros, max(wanted - negative - zeros, 0))]
    for below, number in parts:
        if below and zeros:
            counts = (negative, below)
            found += [Eigenvalue(k + 1, 0.0, (-distance, distance), counts) for k in range(*counts)]
        if number:
            roots = ready.roots(below, number, width)
            near = np.diff(roots.omega2) <= _PARTED * np.abs(roots.omega2[1:])
            if roots.reason != CERTIFIED or np.any(near):
                return None
            found += _listed(roots, below)
    return found


def _floor(ready: SingleChain, scale: float, zeros: int) -> tuple[float, int] | None:
    """Return the least distance from zero at which the counts make sense, and the lower count."""
    floors = scale * 10.0 ** np.arange(-16, -12)
    count = ready.count(np.concatenate([-floors, floors]))
    if not zeros:
        return (0.0, int(count[4])) if count[0] == count[4] else None
    for floor, low, high in zip(floors, count[:4], count[4:], strict=True):
        if high - low >= zeros:
            return (float(floor), int(low)) if high - low == zeros else None
    return None


def _listed(roots: Roots, below: int) -> list[Eigenvalue]:
    columns = (values.tolist() for values in roots[1:5])
    return [
        Eigenvalue(below + k + 1, omega2, (low, high), (counts[0], counts[1]))
        for k, (omega2, low, high, counts) in enumerate(zip(*columns, strict=True))
    ]


def compiled_here() -> bool:
    """Tell whether this process had to compile the kernel: it was not in numba's cache."""
    return bool(_solve_rows.stats.cache_misses or _solve.stats.cache_misses)
