r"""Uniform segments in complex numbers: transfer matrices in each lane, and states through them.

In units of its own length and stiffness a segment has n = beta h^2/EI, nu = mu h^4/EI and
sigma = s EI/h^2 (`riccati.segment`), and with ``g_j = sum q_k/(2k + j)!``,
``q_k = (nu kappa) q_k-2 - (n + sigma nu) q_k-1``, ``kappa = alpha^2 - sigma n``

    U00 = g_0 + n g_2,  U01 = alpha g_1 h,  U02 = alpha g_2 h^2/EI,  U03 = (kappa g_3 - sigma g_1) h^3/EI

and so on. A constant force per length leaves the integral of the last column of U: the same
functions, one order higher. n and nu are linear in omega^2.
"""  # noqa: E501

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import math

from antinode.riccati.lanes.compiling import compiled, wide_vectors
from antinode.riccati.lanes.workspace import LANES

from .layout import (
    ALPHA,
    CASE,
    COLUMN,
    D0,
    D1,
    D2,
    D3,
    FIRST,
    FORCE,
    G0,
    G1,
    G2,
    G3,
    GI,
    INERT,
    KAPPA,
    LENGTH,
    MU,
    MU_0,
    MU_1,
    OMEGA2,
    PAIR,
    PER_UNIT,
    SECOND,
    SIGMA,
    SOFT,
    STIFF,
    TERMS,
    TURN,
    TURN_0,
    TURN_1,
    U00,
    U01,
    U02,
    U03,
    U10,
    U11,
    U12,
    U20,
    U21,
    U30,
    UNIT,
)

_H, _H1, _H2, _H3, _HI = (
    tuple(1.0 / math.factorial(2 * k + j) for k in range(TERMS)) for j in (3, 2, 1, 0, 4)
)
_Y, _PSI, _M, _Q = (row * PAIR for row in range(4))


@compiled
def times(real, value):
    """Return a real multiple of a complex number."""
    return complex(real * value.real, real * value.imag)


@compiled
def conjugate(value):
    """Return the conjugate."""
    return complex(value.real, -value.imag)


@compiled
def over(a, b):
    """Return a/b."""
    return times(1.0 / (b.real * b.real + b.imag * b.imag), a * conjugate(b))


@compiled
def square(value):
    """Return the square of the modulus."""
    return value.real * value.real + value.imag * value.imag


@compiled
def plus(z, a, b):
    """Return z + a b: four multiplications that add at once, where `z + a * b` takes six steps."""
    real, imaginary = z.real, z.imag
    real = real + a.real * b.real
    real = real - a.imag * b.imag
    imaginary = imaginary + a.real * b.imag
    imaginary = imaginary + a.imag * b.real
    return complex(real, imaginary)


@compiled
def four(a, p, b, q, c, r, d, s):
    """Return a p + b q + c r + d s."""
    return plus(plus(plus(a * p, b, q), c, r), d, s)


@compiled
def get(array, place):
    """Return the complex number of a lane."""
    return complex(array[place], array[place + LANES])


@compiled
def put(array, place, value):
    """Set the complex number of a lane."""
    array[place], array[place + LANES] = value.real, value.imag


@compiled
def _sum(weights, q1, q2, q3, q4, q5, q6, q7):
    """Return a series of eight terms, the first of which is real."""
    w0, w1, w2, w3, w4, w5, w6, w7 = weights
    real = w0 + w1 * q1.real + w2 * q2.real + w3 * q3.real
    real += w4 * q4.real + w5 * q5.real + w6 * q6.real + w7 * q7.real
    imaginary = w1 * q1.imag + w2 * q2.imag + w3 * q3.imag
    imaginary += w4 * q4.imag + w5 * q5.imag + w6 * q6.imag + w7 * q7.imag
    return complex(real, imaginary)


@compiled
def series(own, w):
    """Set n, nu, kappa and the sums of the series of a piece in every lane."""
    wide_vectors()
    n0, n1 = get2(own, TURN_0), get2(own, TURN_1)
    m0, m1 = get2(own, MU_0), get2(own, MU_1)
    sigma, alpha = get2(own, SIGMA), get2(own, ALPHA)
    for lane in range(LANES):
        omega2 = get(w, OMEGA2 + lane)
        n, mu = n0 + n1 * omega2, m0 + m1 * omega2
        kappa = alpha * alpha - sigma * n
        b, c = -(n + sigma * mu), mu * kappa
        q2 = b * b + c
        q3 = b * q2 + c * b
        q4 = b * q3 + c * q2
        q5 = b * q4 + c * q3
        q6 = b * q5 + c * q4
        q7 = b * q6 + c * q5
        g = _sum(_H, b, q2, q3, q4, q5, q6, q7)
        g1 = _sum(_H1, b, q2, q3, q4, q5, q6, q7)
        g2 = _sum(_H2, b, q2, q3, q4, q5, q6, q7)
        g3 = _sum(_H3, b, q2, q3, q4, q5, q6, q7)
        gi = _sum(_HI, b, q2, q3, q4, q5, q6, q7)
        put(w, G0 + lane, g)
        put(w, G1 + lane, g1)
        put(w, G2 + lane, g2)
        put(w, G3 + lane, g3)
        put(w, GI + lane, gi)
        put(w, KAPPA + lane, kappa)
        put(w, TURN + lane, n)
        put(w, MU + lane, mu)


@compiled
def get2(own, place):
    """Return a complex constant of a segment."""
    return complex(own[place], own[place + 1])


@compiled
def transfer(own, w):
    """Set the entries of U in the units of the lanes (equation 62)."""
    wide_vectors()
    h = own[LENGTH]
    sigma, alpha = get2(own, SIGMA), get2(own, ALPHA)
    soft, stiff, per = get2(own, SOFT), get2(own, STIFF), 1.0 / h
    for lane in range(LANES):
        g, g1, g2 = get(w, G0 + lane), get(w, G1 + lane), get(w, G2 + lane)
        g3, kappa = get(w, G3 + lane), get(w, KAPPA + lane)
        n, mu = get(w, TURN + lane), get(w, MU + lane)
        H, of = h * w[PER_UNIT + lane], w[UNIT + lane] * per
        square = H * H
        sheared, ag1, mug = sigma * mu, alpha * g1, mu * g
        amu = alpha * mu
        put(w, U00 + lane, g3 + n * g1)
        put(w, U01 + lane, times(H, alpha * g2))
        put(w, U02 + lane, times(square, ag1 * soft))
        put(w, U03 + lane, times(square * H, (kappa * g - sigma * g2) * soft))
        put(w, U10 + lane, times(of, alpha * mug))
        put(w, U11 + lane, g3 + sheared * g1)
        put(w, U12 + lane, times(H, (g2 + sheared * g) * soft))
        put(w, U20 + lane, times(of * of, amu * g1 * stiff))
        put(w, U21 + lane, times(of, (kappa * mug - n * g2) * stiff))
        put(w, U30 + lane, times(of * of * of, (mu * (g2 + n * g)) * stiff))


@compiled
def _cubic(a, x, square, cube):
    """Return a polynomial of four coefficients."""
    return plus(plus(plus(a[0], a[1], x), a[2], square), a[3], cube)


@compiled
def _plain(lane, piece, a, b, c, d, w):
    """Return the entries of U of one lane: polynomials of m omega^2 h^4/EI."""
    h, n, soft, m, force, inert = piece
    omega2, per = get(w, OMEGA2 + lane), 1.0 / h
    x = m * omega2
    square = x * x
    cube = square * x
    g, g1 = _cubic(a, x, square, cube), _cubic(b, x, square, cube)
    g2, g3 = _cubic(c, x, square, cube), _cubic(d, x, square, cube)
    mu, H, of = times(inert, omega2), h * w[PER_UNIT + lane], w[UNIT + lane] * per
    flexible = times(H * H, soft)
    return (
        plus(g3, n, g1),
        times(H, g2),
        flexible * g1,
        times(H, flexible * g),
        times(of, x * g),
        g3,
        times(H, g2 * soft),
        times(of * of, mu * g1),
        times(of, plus(times(-force, g2), mu, g)),
        times(of * of * of, mu * plus(g2, n, g)),
    )


@compiled
def _powers(own, place):
    """Return four complex constants of a segment."""
    return get2(own, place), get2(own, place + 2), get2(own, place + 4), get2(own, place + 6)


@compiled
def _piece(own):
    """Return the constants that `_plain` takes."""
    n, soft, m = get2(own, TURN_0), get2(own, SOFT), get2(own, MU_1)
    return own[LENGTH], n, soft, m, own[FORCE], own[INERT]


@compiled
def plain(own, powers, w):
    """Set the entries of U where there is nothing but N."""
    wide_vectors()
    piece, a, b = _piece(own), _powers(powers, 0), _powers(powers, 8)
    c, d = _powers(powers, 16), _powers(powers, 24)
    for lane in range(LANES):
        u00, u01, u02, u03, u10, u11, u12, u20, u21, u30 = _plain(lane, piece, a, b, c, d, w)
        put(w, U00 + lane, u00)
        put(w, U01 + lane, u01)
        put(w, U02 + lane, u02)
        put(w, U03 + lane, u03)
        put(w, U10 + lane, u10)
        put(w, U11 + lane, u11)
        put(w, U12 + lane, u12)
        put(w, U20 + lane, u20)
        put(w, U21 + lane, u21)
        put(w, U30 + lane, u30)


@compiled
def through_plain(own, powers, w):
    """Carry the frame through a segment where there is nothing but N, in one piece."""
    wide_vectors()
    piece, a, b = _piece(own), _powers(powers, 0), _powers(powers, 8)
    c, d = _powers(powers, 16), _powers(powers, 24)
    for lane in range(LANES):
        U = _plain(lane, piece, a, b, c, d, w)
        _carry(U, w, FIRST + lane)
        _carry(U, w, SECOND + lane)


@compiled
def driven(own, stiffness, w):
    """Set what a unit force per length leaves behind a piece."""
    h = own[LENGTH]
    sigma, alpha = get2(own, SIGMA), get2(own, ALPHA)
    soft = get2(own, SOFT)
    for lane in range(LANES):
        g, g1, g2 = get(w, G0 + lane), get(w, G1 + lane), get(w, G2 + lane)
        n, unit = get(w, TURN + lane), w[UNIT + lane]
        H, each = h / unit, h * unit * unit / stiffness
        lower = get(w, KAPPA + lane) * get(w, GI + lane) - sigma * g1
        put(w, D0 + lane, times(each * H * H * H, lower * soft))
        put(w, D1 + lane, times(each * H * H, alpha * g * soft))
        put(w, D2 + lane, times(each * H, alpha * g1))
        put(w, D3 + lane, times(each, g2 + n * g))


@compiled
def _carry(U, w, first):
    """Carry one lane of a column of states through a segment."""
    u00, u01, u02, u03, u10, u11, u12, u20, u21, u30 = U
    Y, psi, M, Q = get(w, first), get(w, first + _PSI), get(w, first + _M), get(w, first + _Q)
    put(w, first, four(u00, Y, u01, psi, u02, M, u03, Q))
    put(w, first + _PSI, four(u10, Y, u11, psi, u12, M, u02, Q))
    put(w, first + _M, four(u20, Y, u21, psi, u11, M, u01, Q))
    put(w, first + _Q, four(u30, Y, u20, psi, u10, M, u00, Q))


@compiled
def through(w, first):
    """Carry one column of states through a segment."""
    wide_vectors()
    for lane in range(LANES):
        u00, u01, u02 = get(w, U00 + lane), get(w, U01 + lane), get(w, U02 + lane)
        u10, u11, u20 = get(w, U10 + lane), get(w, U11 + lane), get(w, U20 + lane)
        u03, u12 = get(w, U03 + lane), get(w, U12 + lane)
        u21, u30 = get(w, U21 + lane), get(w, U30 + lane)
        _carry((u00, u01, u02, u03, u10, u11, u12, u20, u21, u30), w, first + lane)


@compiled
def through_both(w):
    """Carry the frame through a segment."""
    through(w, FIRST)
    through(w, SECOND)


@compiled
def through_case(w, state, force):
    """Carry a particular state through a segment with a force per length."""
    for place in range(COLUMN):
        w[CASE + place] = state[place]
    through(w, CASE)
    for place in range(COLUMN):
        state[place] = w[CASE + place]
    if force != 0.0:
        for place in range(COLUMN):
            state[place] += force * w[D0 + place]
