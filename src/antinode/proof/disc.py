r"""Zeros of an entire function in circles, counted in balls.

From N values on the circle ``z = c + R u``, abs(u) = 1, follows a polynomial P(u). If abs(D) <= M
where ``abs(z - c) <= R/q``, then, as ``abs(a_k) <= M q^k`` for the coefficients of D (Cauchy),

    abs(D - P) <= 2 M q^N/(1 - q)   where abs(u) <= 1.

Along an arc P stays in a disc about its value in the middle; where that disc, wider by that error,
is without zero, D has turned by less than pi, and as P has. Arcs are halved until they are so
narrow. Their turns make an integer: the zeros of D within (argument principle, Rouche).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from .function import Ball, Characteristic, precision

_MOST_SAMPLES = 4096
_ARCS = 8
_MOST_ARCS = 20_000
_SHARES = 1, 2, 3, 4, 6  # q = 2^-j
_GUARD = 64  # bits


class UndecidedError(Exception):
    """Balls that are too wide to tell."""


@dataclass(frozen=True)
class Turned:
    """How many zeros a circle holds, and by how many arcs that is proven."""

    zeros: int
    arcs: int


class Disc:
    """D on a disc as a polynomial P(u), z = centre + radius u, and what it is off at most.

    Parameters
    ----------
    make : callable
        Makes D at the precision that holds.
    centre : float
        On the real axis.
    radius : float
    bits : int
        P is to be off by 2^-bits of the largest value of D.
    """

    def __init__(self, make: Any, flint: Any, centre: float, radius: float, bits: int) -> None:
        self.flint, self.centre, self.radius = flint, centre, radius
        with precision(flint, _GUARD):
            D = make()
            edge = [D.bound(flint.arb(abs(centre)) + flint.arb(radius) * 2**j) for j in _SHARES]
            if not all(M.is_finite() for M in edge):
                raise UndecidedError
        spread = max(_log2(edge[0]), 0.0)
        self.bits = bits + _GUARD + int(spread)
        with precision(flint, self.bits):
            D = make()
            size = max(_log2(self._at(D, j, 16).abs_upper()) for j in range(9))
            wanted = [(_log2(M) + 2 - size + bits) / j for j, M in zip(_SHARES, edge, strict=True)]
            best = min(range(len(wanted)), key=wanted.__getitem__)
            N = max(16, 2 ** math.ceil(math.log2(max(wanted[best], 1.0))))
            if N > _MOST_SAMPLES:
                raise UndecidedError
            q = flint.arb(2) ** -_SHARES[best]
            self.off = (2 * edge[best] * q**N / (1 - q)).abs_upper()
            coefficients = flint.acb.dft(self._samples(D, N))
            self.P = flint.acb_poly([a / N for a in coefficients])

    def _at(self, D: Characteristic, j: int, N: int) -> Ball:
        turn = self.flint.acb(self.flint.arb(2 * j) / N).exp_pi_i()
        return D(self.flint.acb(self.centre) + self.flint.arb(self.radius) * turn)

    def _samples(self, D: Characteristic, N: int) -> list[Ball]:
        if not D.real:
            return [self._at(D, j, N) for j in range(N)]
        upper = [self._at(D, j, N) for j in range(N // 2 + 1)]
        return upper + [value.conjugate() for value in upper[-2:0:-1]]

    def zeros(self, centre: complex | None = None, radius: float = 0.0) -> Turned:
        """Return how many zeros of D a circle within the disc holds: its own edge by default.

        Raises
        ------
        UndecidedError
            If balls cannot tell.
        """
        flint = self.flint
        with precision(flint, self.bits):
            if centre is None:
                return _turns(flint, self.P, self.off)
            place = (flint.acb(centre) - self.centre) / flint.arb(self.radius)
            size = flint.arb(radius) / flint.arb(self.radius)
            shifted = self.P(flint.acb_poly([place, size])).coeffs()
            return _turns(flint, *_shortened(flint, shifted, self.off))


def _shortened(flint: Any, coefficients: list[Ball], off: Ball) -> tuple[Ball, Ball]:
    """Return a polynomial on abs(w) <= 1 without what hardly counts there, and what it is off."""
    sizes = [a.abs_upper() for a in coefficients]
    least = max(sizes[:3], key=_log2) * flint.arb(2) ** -_GUARD
    tail, n = flint.arb(0), len(sizes)
    while n > 1 and bool(tail + sizes[n - 1] < least):
        tail, n = tail + sizes[n - 1], n - 1
    return flint.acb_poly(coefficients[:n]), (off + tail).abs_upper()


def _turns(flint: Any, P: Ball, off: Ball) -> Turned:
    """Return the turns of P along abs(w) = 1, proven to be those of all that is `off` by less."""
    total, arcs = flint.arb(0), 0
    depth = int(math.log2(_ARCS))
    waiting = [(k, depth) for k in range(_ARCS)]  # arc k of 2^depth
    while waiting:
        k, depth = waiting.pop()
        parts = flint.arb(2) ** depth
        first, middle, last = (flint.acb((2 * k + i) / parts).exp_pi_i() for i in (0, 1, 2))
        reach = (flint.arb.pi() / parts).abs_upper()  # half the arc, no less than the chord
        here = P(flint.acb_poly([middle, 1])).coeffs()
        if not here:
            raise UndecidedError
        away, power = off, reach
        for a in here[1:]:
            away, power = away + a.abs_upper() * power, power * reach
        turn = (P(last) / P(first)).arg() if bool(here[0].abs_lower() > away) else None
        if turn is not None and bool(turn.rad() < 2.0**-20):
            total, arcs = total + turn, arcs + 1
        elif depth > 40 or arcs + len(waiting) > _MOST_ARCS:
            raise UndecidedError
        else:
            waiting += [(2 * k, depth + 1), (2 * k + 1, depth + 1)]
    number = (total / (2 * flint.arb.pi())).unique_fmpz()
    if number is None:
        raise UndecidedError
    return Turned(int(number), arcs)


def _log2(ball: Ball) -> float:
    """Return the logarithm of a positive ball's upper end; very small for zero."""
    upper = ball.upper() if hasattr(ball, "upper") else ball
    if not bool(upper > 0):
        return -1e6
    mantissa, exponent = upper.man_exp()
    return math.log2(int(mantissa)) + int(exponent)
