"""Reference counts and eigenvalues of chains of uniform segments, in many digits.

Bending: (EI Y'')'' + (N Y')' = omega^2 m Y, N > 0 compression, as the energy form
    int EI Y''^2 - N Y'^2 dx = omega^2 int m Y^2 dx
with the essential conditions of the ends only; stretching: int EA X'^2 dx = omega^2 int m X^2 dx.

Method 1, counts and eigenvalues (`count_below`, `certain_count`, `eigenvalue`): hp finite elements.
An element on xi in [-1, 1] carries its nodal cubics (bar: linears) and the bubbles u_j whose second
(bar: first) derivative is the Legendre polynomial P_j; even and odd functions decouple, the
universal matrices are exact fractions and banded, and the pivots of a banded LDL^T count the
negative eigenvalues of K - omega^2 M (Sylvester). Ritz values lie above the eigenvalues, so this
count is never too high. Nor need it be too low: in the span of all dropped bubbles (from u_d on)
    ||u'|| <= 2 a_d ||u''||,  ||u|| <= 2 a_(d-1) ||u'||,  a_j^2 = 1/(4 j^2 - 1),
so that their block of K - omega^2 M is at least rho times its bending part G (a diagonal), with
    rho = 1 - 4 a_d^2 max(g, 0) - 16 a_d^2 a_(d-1)^2 max(c, 0),
    g = N (h/2)^2 / EI,  c = omega^2 m (h/2)^4 / EI,
and eliminating them would take at most B^T G^-1 B / rho off the matrix that is kept, B being their
coupling to it. Taking that off gives a count that is never too low. Both hold for every degree with
rho > 0; where they agree the count is proven but for the rounding of 60-digit arithmetic.

What sits at a node (masses, springs, supports, joints: `Node`) adds its energy to the nodal matrix;
a joint splits the slope of its node in two. The bubbles vanish at nodes, so that both bounds stand.

Method 2 (`chain_root`): exact solutions of each segment by power series, in enough digits that
their growth does not matter. Independent of a double-precision recursion by its precision only.

Method 3: closed forms of uniform beams and bars (`uniform_beam_roots`, `uniform_axial_root`, ...).
"""

import math
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache
from typing import NamedTuple

import gmpy2
import mpmath
from gmpy2 import mpfr

DIGITS = 60  # of the arithmetic; doubled by itself when a pivot nearly vanishes
ELEMENT = 4.0  # longest element, in wave number times length
TOLERANCE = 1e-16  # of an eigenvalue, aimed at by the automatic degree

HELD = {"free": (), "clamped": (0, 1), "pinned": (0,), "sliding": (1,), "fixed": (0,)}


class UnsettledError(ArithmeticError):
    """The count could not be proven: an eigenvalue lies too close."""


class _NearlySingularError(ArithmeticError):
    """A pivot cancels in too many digits for the precision at hand."""


# --- the problem -----------------------------------------------------------------------------


class Node(NamedTuple):
    """What sits at the node behind segment `at` (0: the left end); a joint stands behind the rest.

    A mass [kg] whose centre lies `offset` [m] to the right and whose inertia about it is `inertia`
    [kg m^2]; springs to ground [N/m, N m/rad]; the joint's compliance [rad/(N m)], for bars [m/N];
    held displacements: 0 for Y (bars: X), 1 for the slope.
    """

    at: int
    mass: float = 0.0
    offset: float = 0.0
    inertia: float = 0.0
    spring: float = 0.0
    rotational_spring: float = 0.0
    compliance: float = 0.0
    holds: tuple = ()

    def energy(self, omega2, order):
        """Upper rows of its stiffness less omega^2 times its mass matrix."""
        m, d, J, k, kr = map(_number, self[1:6])
        own = k - omega2 * m
        if order == 1:
            return [[own]]
        return [[own, -omega2 * m * d], [kr - omega2 * (m * d * d + J)]]


@dataclass(frozen=True)
class BeamChain:
    """Uniform bending segments of length h [m], EI [N m^2], m [kg/m], N [N] from left to right."""

    h: tuple
    EI: tuple
    m: tuple
    N: tuple
    left: str = "free"
    right: str = "free"
    nodes: tuple = ()

    order = 2  # of the derivative in the stiffness, and number of unknowns at a node

    @property
    def segments(self):
        return list(zip(self.h, self.EI, self.m, self.N, strict=True))

    def scaled(self, load):
        """The same chain with all its axial forces times `load`."""
        return replace(self, N=tuple(load * n for n in self.N))


@dataclass(frozen=True)
class BarChain:
    """Uniform stretching segments of length h [m], EA [N], m [kg/m] from left to right."""

    h: tuple
    EA: tuple
    m: tuple
    left: str = "free"
    right: str = "free"
    nodes: tuple = ()

    order = 1

    @property
    def segments(self):
        return [(h, EA, m, 0.0) for h, EA, m in zip(self.h, self.EA, self.m, strict=True)]


def _wave_number(segment, omega2, order):
    """Bound of the moduli of the roots s in EI s^4 + N s^2 = m omega^2 (bar: -EA s^2) [1/m]."""
    _, stiffness, mass, force = (float(value) for value in segment)
    c = mass * abs(float(omega2)) / stiffness
    b = abs(force) / stiffness / 2
    return math.sqrt(b + math.hypot(b, math.sqrt(c))) if order == 2 else math.sqrt(c)


# --- numbers ---------------------------------------------------------------------------------


def _arithmetic(digits):
    return gmpy2.context(precision=math.ceil(digits * 3.33) + 8)


def _number(value):
    """An int, float, Fraction, mpf or mpfr, without loss if the precision admits it."""
    if isinstance(value, mpmath.mpf):
        return mpfr(gmpy2.mpq(*_ratio(value)))
    return mpfr(value) if isinstance(value, int | Fraction | type(mpfr(0))) else mpfr(float(value))


def _ratio(value):
    sign, mantissa, exponent, _ = value._mpf_
    top = -int(mantissa) if sign else int(mantissa)
    return (top << exponent, 1) if exponent >= 0 else (top, 1 << -exponent)


def _as_mpf(value, digits=DIGITS):
    mantissa, exponent = value.as_mantissa_exp()
    with mpmath.workdps(digits):
        return mpmath.mpf((int(mantissa), int(exponent)))


def bracketed_root(f, lo, hi, tolerance):
    """Root of f between lo and hi, by regula falsi (Illinois), with a sign change around it.

    f changes sign over [x - w, x + w], w = tolerance |x|. Works in mpf and in mpfr.
    """
    f_lo, f_hi = f(lo), f(hi)
    if f_lo * f_hi > 0:
        raise ValueError(f"no sign change between {lo} and {hi}")
    x = lo
    for step in range(2000):
        regular = step % 12 < 10 and f_lo != f_hi
        x_old, x = x, hi - f_hi * (hi - lo) / (f_hi - f_lo) if regular else (lo + hi) / 2
        if abs(x - x_old) <= tolerance * abs(x) / 4 and _changes_sign(f, x, tolerance * abs(x)):
            return x
        value = f(x)
        if value * f_hi <= 0:
            lo, f_lo, hi, f_hi = hi, f_hi, x, value
        else:
            hi, f_hi, f_lo = x, value, f_lo / 2
    raise ArithmeticError(f"no convergence between {lo} and {hi}")


def _changes_sign(f, x, width):
    return f(x - width) * f(x + width) <= 0


# --- universal element matrices: exact fractions ----------------------------------------------


class _Sector(NamedTuple):
    """Even or odd functions of an element: bubbles from the highest down, then the nodal ones.

    rows[i][a] = (k, g, m): integrals of the products of functions i and i + a, of their leading
    derivatives, first derivatives and values. `dropped` couples the first two functions to the
    dropped bubbles: (1/k, ((g, m), (g, m))). `decay` holds 4 a_d^2 and its product in rho.
    """

    rows: list
    dropped: list
    decay: tuple
    bubbles: int


_THIRD, _FIFTH = Fraction(1, 3), Fraction(1, 5)
# Legendre coefficients of (u'', u', u) or (u', u): displacements alike and opposite, slopes
# opposite and alike, at the two ends
_NODAL = {
    (2, 0): [({}, {}, {0: 1}), ({0: -1}, {1: -1}, {0: _THIRD, 2: -_THIRD})],
    (2, 1): [
        ({1: -3}, {0: 1, 2: -1}, {1: 6 * _FIFTH, 3: -_FIFTH}),
        ({1: 3}, {2: 1}, {1: -_FIFTH, 3: _FIFTH}),
    ],
    (1, 0): [({}, {0: 1})],
    (1, 1): [({0: 1}, {1: 1})],
}


def _integral(series):
    """int P_j = (P_(j+1) - P_(j-1)) / (2 j + 1), zero at both ends, term by term."""
    result = {}
    for j, value in series.items():
        part = Fraction(value) / (2 * j + 1)
        result[j + 1] = result.get(j + 1, 0) + part
        result[j - 1] = result.get(j - 1, 0) - part
    return result


def _bubble(order, j):
    shape = [{j: Fraction(1)}]
    for _ in range(order):
        shape.append(_integral(shape[-1]))
    return tuple(shape)


def _product(u, v):
    return sum((Fraction(u[j]) * v[j] * 2 / (2 * j + 1) for j in u.keys() & v.keys()), Fraction(0))


def _products(order, u, v):
    g = _product(u[1], v[1]) if order == 2 else Fraction(0)
    return _product(u[0], v[0]), g, _product(u[-1], v[-1])


@cache
def _exact_sector(order, parity, degree):
    if degree < 4 * order - 1:
        raise ValueError(f"degree {degree} is below {4 * order - 1}: dropped bubbles would couple")
    indices = [j for j in range(degree - order, order - 1, -1) if (j + order) % 2 == parity]
    shapes = [_bubble(order, j) for j in indices] + _NODAL[order, parity]
    rows = [_trimmed([_products(order, u, v) for v in shapes[i:]]) for i, u in enumerate(shapes)]
    first = indices[0] + 2
    dropped = []
    for j in (first, first + 2)[:order]:
        extra = _bubble(order, j)
        pairs = tuple(_products(order, u, extra)[1:] for u in shapes[: min(2, len(indices))])
        dropped.append((Fraction(2 * j + 1, 2), pairs))
    factors = [Fraction(4, 4 * j * j - 1) for j in range(first, first - order, -1)]
    return _Sector(rows, dropped, (factors[0], math.prod(factors)), len(indices))


def _trimmed(row):
    while not any(row[-1]):
        row.pop()
    return row


@cache
def _sector(order, parity, degree, bits):
    """The universal matrices rounded to `bits`, the current precision."""
    rows, dropped, decay, bubbles = _exact_sector(order, parity, degree)
    return _Sector(
        [[tuple(map(mpfr, entry)) for entry in row] for row in rows],
        [(mpfr(k), [tuple(map(mpfr, pair)) for pair in pairs]) for k, pairs in dropped],
        tuple(map(mpfr, decay)),
        bubbles,
    )


# --- inertia ---------------------------------------------------------------------------------


class _Tally:
    """Pivots met so far: how many are negative, and their product."""

    def __init__(self, digits):
        self.negative = 0
        self.determinant = mpfr(1)
        self.floor = mpfr(10) ** (-(digits // 3))

    def eliminate(self, rows, scales):
        """Eliminate the first unknowns of the banded upper rows, one for each scale."""
        for i, scale in enumerate(scales):
            row = rows[i]
            pivot = row[0]
            self._note(pivot, scale)
            for a in range(1, len(row)):
                factor = row[a] / pivot
                target = rows[i + a]
                for b in range(a, len(row)):
                    target[b - a] -= factor * row[b]

    def _note(self, pivot, scale):
        if abs(pivot) <= self.floor * scale:
            raise _NearlySingularError(f"pivot {float(pivot):.3g} of {float(scale):.3g}")
        self.negative += pivot < 0
        self.determinant *= pivot


class _Element(NamedTuple):
    """Condensed element: its blocks of the nodal matrix, and what its bubbles counted."""

    near: list  # upper rows of the left node's block
    across: list  # full rows, left node by right node
    far: list  # upper rows of the right node's block
    negative: int
    determinant: mpfr


def _condensed_sector(g, c, sector, tally, upper):
    rows = [[k - g * kg - c * km for k, kg, km in row] for row in sector.rows]
    if upper:
        _take_off_dropped(rows, g, c, sector)
    tally.eliminate(rows, [row[0][0] for row in sector.rows[: sector.bubbles]])
    return rows[sector.bubbles :]


def _take_off_dropped(rows, g, c, sector):
    rho = 1 - max(g, 0) * sector.decay[0] - max(c, 0) * sector.decay[1]
    if rho <= 0:
        raise ValueError("element too long for its degree: no bound on the dropped bubbles")
    for inverse, pairs in sector.dropped:
        b = [g * kg + c * km for kg, km in pairs]
        for i, left in enumerate(b):
            for j in range(i, len(b)):
                rows[i][j - i] -= left * b[j] * inverse / rho


def _element(segment, pieces, degree, omega2, order, digits, upper):
    h, stiffness, mass, force = map(_number, segment)
    half = h / pieces / 2
    g = force * half**2 / stiffness
    c = omega2 * mass * half ** (2 * order) / stiffness
    tally = _Tally(digits)
    bits = gmpy2.get_context().precision
    even, odd = (
        _condensed_sector(g, c, _sector(order, parity, degree, bits), tally, upper)
        for parity in (0, 1)
    )
    blocks = _beam_blocks if order == 2 else _bar_blocks
    scale = stiffness / half ** (2 * order - 1) / 4
    return _Element(*blocks(even, odd, scale, half), tally.negative, tally.determinant)


def _beam_blocks(even, odd, scale, half):
    """Blocks in (Y, Y') of both nodes, from (Y0 + Y1)/2, (Y0' - Y1')/2 and their opposites."""
    (e11, e12), (e22,) = even
    (o11, o12), (o22,) = odd
    s0, s1, s2 = scale, scale * half, scale * half**2
    near = [[s0 * (e11 + o11), s1 * (e12 - o12)], [s2 * (e22 + o22)]]
    far = [[near[0][0], -near[0][1]], [near[1][0]]]
    mixed = s1 * (e12 + o12)
    return near, [[s0 * (e11 - o11), -mixed], [mixed, s2 * (o22 - e22)]], far


def _bar_blocks(even, odd, scale, half):
    ((e,),) = even
    ((o,),) = odd
    return [[scale * (e + o)]], [[scale * (e - o)]], [[scale * (e + o)]]


def _march(chain, mesh, elements, omega2, digits):
    """LDL^T of the nodal matrix from left to right: (negative pivots, determinant)."""
    tally, order = _Tally(digits), chain.order
    state = [[mpfr(0)] * (order - i) for i in range(order)]
    state, held = _pass_node(state, chain, 0, omega2, tally)
    for k, ((pieces, _), element) in enumerate(zip(mesh, elements, strict=True), start=1):
        for _ in range(pieces):
            tally.negative += element.negative
            tally.determinant *= element.determinant
            state = _pass_element(state, element, held, tally)
            held = ()
        state, held = _pass_node(state, chain, k, omega2, tally)
    kept = [i for i in range(order) if i not in held]
    rows = [[state[i][j - i] for j in kept if j >= i] for i in kept]
    tally.eliminate(rows, [abs(element.far[i][0]) for i in kept])
    return tally.negative, tally.determinant


def _pass_node(state, chain, k, omega2, tally):
    """Add what sits at a node, and tell which of its displacements are held."""
    ends = {0: chain.left, len(chain.h): chain.right}
    held, compliance = {*HELD[ends.get(k, "free")]}, mpfr(0)
    for node in (node for node in chain.nodes if node.at == k):
        held |= {*node.holds}
        compliance += _number(node.compliance)
        added = node.energy(omega2, chain.order)
        pairs = zip(state, added, strict=True)
        state = [[a + b for a, b in zip(*rows, strict=True)] for rows in pairs]
    if compliance:
        state = _pass_joint(state, compliance, chain.order - 1 in held, tally)
        held -= {chain.order - 1}
    return state, tuple(held)


def _pass_joint(state, compliance, held, tally):
    """Eliminate the slope (bar: the displacement) left of a joint, if it is not held."""
    stiff, own = 1 / compliance, state[-1][0]
    if held:
        return [*([[state[0][0], mpfr(0)]] if len(state) == 2 else []), [stiff]]
    rows = [[own + stiff, -stiff], [stiff]]
    if len(state) == 2:
        (Y, mixed), _ = state
        rows = [[own + stiff, mixed, -stiff], [Y, mpfr(0)], [stiff]]
    tally.eliminate(rows, [abs(own) + stiff])
    return rows[1:]


def _pass_element(state, element, held, tally):
    rows, scales = [], []
    for i, (own, added) in enumerate(zip(state, element.near, strict=True)):
        if i in held:
            continue
        rows.append(
            [a + b for j, (a, b) in enumerate(zip(own, added, strict=True)) if i + j not in held]
        )
        rows[-1] += element.across[i]
        scales.append(abs(own[0]) + abs(added[0]))
    rows += [list(row) for row in element.far]
    tally.eliminate(rows, scales)
    return rows[len(scales) :]


def _mesh(chain, omega2, degree, tolerance):
    """(pieces, degree) of each segment, for wave numbers up to those at omega2."""
    mesh = []
    for segment in chain.segments:
        length = _wave_number(segment, omega2, chain.order) * float(segment[0])
        pieces = max(1, math.ceil(length / ELEMENT))
        mesh.append((pieces, degree or automatic_degree(length / pieces, tolerance, chain.order)))
    return mesh


def automatic_degree(length, tolerance, order=2):
    """Degree for a relative error of about `tolerance`, [z^(J+1) / (2 J + 1)!!]^2, z = length/2."""
    z, top, term = length / 2, 0, length / 2
    while term**2 > tolerance or top < 3 * order - 1:
        top += 1
        term *= z / (2 * top + 1)
    return top + order


def _inertia(chain, omega2, mesh, *, upper=False, digits=DIGITS):
    """(count, determinant) of K - omega^2 M on a mesh, in as many digits as it needs."""
    for _ in range(4):
        try:
            with _arithmetic(digits):
                return _inertia_once(chain, omega2, mesh, upper, digits)
        except _NearlySingularError as error:
            reason, digits = error, 2 * digits
    raise UnsettledError(f"omega^2 = {omega2} is an eigenvalue: {reason}")


def _inertia_once(chain, omega2, mesh, upper, digits):
    known, elements, omega2 = {}, [], _number(omega2)
    for segment, (pieces, degree) in zip(chain.segments, mesh, strict=True):
        key = (segment, pieces, degree)
        if key not in known:
            known[key] = _element(segment, pieces, degree, omega2, chain.order, digits, upper)
        elements.append(known[key])
    return _march(chain, mesh, elements, omega2, digits)


# --- counts ----------------------------------------------------------------------------------


def count_below(chain, omega2, *, degree=None, tolerance=TOLERANCE, digits=DIGITS):
    """Number of Ritz values below omega2 [rad^2/s^2]: at most the number of eigenvalues."""
    mesh = _mesh(chain, omega2, degree, tolerance)
    return _inertia(chain, omega2, mesh, digits=digits)[0]


def count_above(chain, omega2, *, degree=None, tolerance=TOLERANCE, digits=DIGITS):
    """Upper bound on the number of eigenvalues below omega2, proven from the dropped bubbles."""
    mesh = _mesh(chain, omega2, degree, tolerance)
    return _inertia(chain, omega2, mesh, upper=True, digits=digits)[0]


class Certain(NamedTuple):
    """`count` eigenvalues lie below omega2, and none within the relative distance `gap` of it."""

    count: int
    gap: float


def certain_count(chain, omega2, *, gap=1e-9, tolerance=TOLERANCE):
    """Proven count: the lower bound at omega2 - gap meets the upper bound at omega2 + gap.

    The upper bound uses three degrees more. An unsettled count is tried with higher degrees, then
    with narrower gaps down to 1e-18; after that `UnsettledError` is raised.
    """
    while gap >= 1e-18:
        for power in (1, 2):
            counts = _counts_around(chain, omega2, gap, min(tolerance, gap / 10) ** power)
            if counts[0] == counts[1]:
                return Certain(counts[0], gap)
        gap /= 1e3
    raise UnsettledError(f"an eigenvalue lies within 1e-18 of omega^2 = {omega2}")


def _counts_around(chain, omega2, gap, tolerance):
    with _arithmetic(DIGITS):
        centre, width = _number(omega2), abs(_number(omega2)) * _number(gap)
        lo, hi = centre - width, centre + width
    mesh = _mesh(chain, hi, None, tolerance)
    richer = [(pieces, degree + 3) for pieces, degree in mesh]
    return _inertia(chain, lo, mesh)[0], _inertia(chain, hi, richer, upper=True)[0]


def scale(chain):
    """A small omega^2 [rad^2/s^2] of the chain: its softest segment over its whole length."""
    stiffness = min(float(segment[1]) for segment in chain.segments)
    mass = max(float(segment[2]) for segment in chain.segments)
    return stiffness / (mass * math.fsum(map(float, chain.h)) ** (2 * chain.order))


# --- eigenvalues -----------------------------------------------------------------------------


class Enclosure(NamedTuple):
    """The k-th eigenvalue: lo <= omega_k^2 <= hi is proven; `degree` is the highest used."""

    value: mpmath.mpf
    lo: mpmath.mpf
    hi: mpmath.mpf
    degree: int


def eigenvalue(chain, k, *, digits=20):
    """omega_k^2, k = 1 the lowest, negative ones included, to a relative error of 10^-digits."""
    return enclose(chain, k, digits=digits).value


def enclose(chain, k, *, digits=20):
    """Enclose omega_k^2 within a relative 10^-digits (exactly 0: within 1e-30 `scale(chain)`)."""
    precision = max(DIGITS, digits + 45)
    with _arithmetic(precision):
        nearly = _number(scale(chain)) * mpfr(10) ** -30
        below, above = (count_above(chain, -nearly), count_below(chain, nearly))
        if below < k <= above:
            return Enclosure(mpmath.mpf(0), _as_mpf(-nearly), _as_mpf(nearly), 0)
        sign = 1 if k > above else -1
        lo, hi = _coarse_bracket(chain, k, sign, nearly)
        return _refine(chain, k, lo, hi, digits, precision)


def _coarse_bracket(chain, k, sign, nearly):
    """Moduli of omega^2 on both sides of |omega_k^2|, within a factor of 1.1 of each other.

    For sign < 0 the axis is turned round: the eigenvalues of smaller modulus come first.
    """

    def outside(modulus):
        """|omega_k^2| < modulus."""
        count = count_below(chain, sign * modulus, tolerance=1e-10)
        return count >= k if sign > 0 else count < k

    inner, outer = nearly, mpfr(scale(chain))
    while not outside(outer):
        inner, outer = outer, outer * 64
    while outer > inner * mpfr(1.1):
        middle = gmpy2.sqrt(inner * outer)
        inner, outer = (inner, middle) if outside(middle) else (middle, outer)
    return sorted((sign * inner * mpfr(0.999), sign * outer * mpfr(1.001)))


def _refine(chain, k, lo, hi, digits, precision):
    tolerance = mpfr(10) ** -digits
    aim = 10.0**-digits / 10
    for _ in range(6):
        mesh = _mesh(chain, max(abs(lo), abs(hi)), None, aim)
        value = _ritz_value(chain, k, lo, hi, mesh, tolerance / 4, precision)
        width = abs(value) * tolerance
        ends = value - width, value + width
        below = _inertia(chain, ends[0], mesh, upper=True, digits=precision)[0]
        above = _inertia(chain, ends[1], mesh, digits=precision)[0]
        if below < k <= above:
            highest = max(degree for _, degree in mesh)
            return Enclosure(*(_as_mpf(x, precision) for x in (value, *ends)), highest)
        aim /= 1e4
    raise UnsettledError(f"eigenvalue {k} near {float(value):.6g} not enclosed")


def _ritz_value(chain, k, lo, hi, mesh, tolerance, precision):
    """The k-th Ritz value on a mesh: bisection until it is alone, then a root of det."""
    lo, hi = sorted((lo, hi))

    def evaluate(x):
        return _inertia(chain, x, mesh, digits=precision)

    while hi - lo > tolerance * abs(hi):
        if evaluate(lo)[0] == k - 1 and evaluate(hi)[0] == k:
            return bracketed_root(lambda x: evaluate(x)[1], lo, hi, tolerance)
        middle = (lo + hi) / 2
        lo, hi = (lo, middle) if evaluate(middle)[0] >= k else (middle, hi)
    return (lo + hi) / 2


# --- the second route: exact solutions by power series ----------------------------------------

_START = {  # the two states (Y, Y', M, Q) that an end admits; for `free` M = Q = 0
    "free": (0, 1),
    "clamped": (2, 3),
    "pinned": (1, 3),
    "sliding": (0, 2),
}


def chain_determinant(chain, omega2, digits=40):
    """Boundary determinant of a beam chain at omega2 (scaled at will), entire in omega2.

    The two solutions that the left end admits are carried along as power series of
    Y' = t, t' = M/EI, M' = Q - N t, Q' = omega^2 m Y in each segment, exact to `digits` digits.
    """
    with _arithmetic(_series_digits(chain, omega2, digits)):
        return _as_mpf(_determinant(chain, _number(omega2)), digits)


def chain_root(chain, lo, hi, digits=40):
    """Eigenvalue omega^2 of a beam chain between lo and hi, to a relative error of 10^-digits."""
    with _arithmetic(_series_digits(chain, max(abs(lo), abs(hi)), digits)):
        ends = _number(lo), _number(hi)
        tolerance = mpfr(10) ** -digits
        root = bracketed_root(lambda x: _determinant(chain, x), *ends, tolerance)
        return _as_mpf(root, digits + 5)


def parity_below(chain, omega2):
    """Parity of the number of eigenvalues of a beam chain below omega2, from chain_determinant.

    The determinant is entire with its zeros at the eigenvalues, so its sign below them all depends
    on the ends alone (no zero is met on the way to the unit beam).
    """
    unit = BeamChain((1,), (1,), (1,), (0,), chain.left, chain.right)
    signs = [mpmath.sign(chain_determinant(*point)) for point in ((chain, omega2), (unit, -1))]
    return int(signs[0] != signs[1])


def _series_digits(chain, omega2, digits):
    growth = sum(_wave_number(s, omega2, 2) * float(s[0]) for s in chain.segments)
    return digits + 30 + math.ceil(0.9 * growth)


def _determinant(chain, omega2):
    if chain.nodes:
        raise ValueError("the power series know no masses, springs or joints")
    states = [[mpfr(i == j) for i in range(4)] for j in _START[chain.left]]
    for segment in chain.segments:
        states = [_series_step(state, segment, omega2) for state in states]
    (a, b), (c, d) = ([s[i] for i in range(4) if i not in _START[chain.right]] for s in states)
    return a * d - b * c


def _series_step(state, segment, omega2):
    h, EI, m, N = map(_number, segment)
    term, total, k = list(state), list(state), 0
    compliance, inertia = h / EI, h * m * omega2
    smallest = mpfr(2) ** -gmpy2.get_context().precision
    quiet = 0
    while quiet < 4:
        k += 1
        Y, t, M, Q = term
        term = [h * t / k, compliance * M / k, h * (Q - N * t) / k, inertia * Y / k]
        small = all(abs(a) <= smallest * abs(b) for a, b in zip(term, total, strict=True))
        quiet = quiet + 1 if small else 0
        total = [a + b for a, b in zip(total, term, strict=True)]
    return total


# --- closed forms ----------------------------------------------------------------------------

_RIGID = {
    frozenset({"free"}): 2,
    frozenset({"free", "pinned"}): 1,
    frozenset({"free", "sliding"}): 1,
    frozenset({"sliding"}): 1,
}


def rigid_modes(left, right):
    """Number of exact zeros of omega^2 of an unloaded beam."""
    return _RIGID.get(frozenset({left, right}), 0)


def uniform_beam_roots(left, right, count, digits=40):
    """The first `count` roots beta L of a uniform unloaded beam, rigid modes as exact zeros.

    omega = (beta L)^2 sqrt(EI / (m L^4)).
    """
    with mpmath.workdps(digits + 10):
        rigid = min(count, rigid_modes(left, right))
        roots = [_beam_root(frozenset({left, right}), n) for n in range(1, count - rigid + 1)]
        return [mpmath.mpf(0)] * rigid + roots


def _beam_root(ends, n):
    pi = mpmath.pi
    if ends in ({"pinned"}, {"sliding"}):
        return n * pi
    if ends == {"pinned", "sliding"}:
        return (n - mpmath.mpf(1) / 2) * pi
    near, f = _characteristic(ends)
    x = (n + mpmath.mpf(near)) * pi
    return bracketed_root(f, x - 0.4, x + 0.4, mpmath.mpf(10) ** (5 - mpmath.mp.dps))


def _characteristic(ends):
    """(position of the n-th root as n + position, in pi; characteristic function)."""
    sin, cos, sech, tanh = mpmath.sin, mpmath.cos, mpmath.sech, mpmath.tanh
    if ends in ({"free"}, {"clamped"}):
        return 0.5, lambda x: cos(x) - sech(x)
    if ends == {"clamped", "free"}:
        return -0.5, lambda x: cos(x) + sech(x)
    if ends in ({"clamped", "pinned"}, {"free", "pinned"}):
        return 0.25, lambda x: sin(x) - cos(x) * tanh(x)
    return -0.25, lambda x: sin(x) + cos(x) * tanh(x)  # clamped or free, and sliding


def uniform_bar_roots(left, right, count, digits=40):
    """The first `count` roots k L, omega = k L sqrt(EA / (m L^2)), of a uniform bar."""
    first = {("free", "free"): 0, ("fixed", "fixed"): 1}.get((left, right))
    with mpmath.workdps(digits):
        if first is None:
            return [(n - mpmath.mpf(1) / 2) * mpmath.pi for n in range(1, count + 1)]
        return [n * mpmath.pi for n in range(first, first + count)]


def pinned_axial_omega2(n, N, *, EI=1, m=1, L=1, digits=40):
    """omega_n^2 = (n pi / L)^4 EI/m (1 - N L^2 / (n^2 pi^2 EI)) of a pinned-pinned beam."""
    with mpmath.workdps(digits):
        EI, m, L, N = map(mpmath.mpf, (EI, m, L, N))
        k = n * mpmath.pi / L
        return k**4 * EI / m * (1 - N / (k**2 * EI))


def uniform_axial_root(left, right, N, bracket, *, EI=1, m=1, L=1, digits=50):
    """Eigenvalue omega^2 in `bracket` of a uniform beam under constant N, any pair of ends.

    Root of the 4x4 boundary determinant of exp(s x), EI s^4 + N s^2 = m omega^2, divided by the
    Vandermonde determinant of the four s, which makes it real and entire in omega^2.
    """
    segment = (L, EI, m, N)
    growth = _wave_number(segment, max(map(abs, bracket)), 2) * float(L)
    with mpmath.workdps(digits + 20 + math.ceil(2 * growth)):
        numbers = tuple(map(mpmath.mpf, segment))
        lo, hi = map(mpmath.mpf, bracket)
        tolerance = mpmath.mpf(10) ** -digits
        return bracketed_root(
            lambda x: uniform_axial_determinant(left, right, *numbers, x), lo, hi, tolerance
        )


def uniform_axial_determinant(left, right, L, EI, m, N, omega2):
    """The real function of `uniform_axial_root`, at the precision in force; omega^2 not 0."""
    root = mpmath.sqrt((N / (2 * EI)) ** 2 + m * omega2 / EI)
    halves = [mpmath.sqrt(-N / (2 * EI) + sign * root) for sign in (1, -1)]
    s = [halves[0], -halves[0], halves[1], -halves[1]]
    rows = _end_rows(left, EI, N, s, [1] * 4)
    rows += _end_rows(right, EI, N, s, [mpmath.exp(x * L) for x in s])
    vandermonde = mpmath.fprod(s[i] - s[j] for i in range(4) for j in range(i))
    return mpmath.re(mpmath.det(mpmath.matrix(rows)) / vandermonde)


def _end_rows(end, EI, N, s, factors):
    """The two conditions of an end on the coefficients of exp(s x)."""
    powers = {
        "Y": [1] * 4,
        "slope": s,
        "M": [EI * x**2 for x in s],
        "Q": [EI * x**3 + N * x for x in s],
    }
    zero = {
        "free": ("M", "Q"),
        "clamped": ("Y", "slope"),
        "pinned": ("Y", "M"),
        "sliding": ("slope", "Q"),
    }[end]
    return [[p * f for p, f in zip(powers[name], factors, strict=True)] for name in zero]
