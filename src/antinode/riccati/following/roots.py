"""Eigenvalues of a chain whose end forces follow: all of them left of a line, proven.

How many lie left of a line ``Re omega^2 = R`` follows from the count of the chain with fixed
directions, and the turns that g makes about zero along the line (`riccati.following.ratio`). The
real ones are enclosed by changes of sign of the characteristic function; what is missing to the
number are pairs of complex ones, each enclosed by a circle round which g turns once.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cached_property
from itertools import pairwise

import numpy as np

from antinode.riccati.arrays import Array, Complex, Integers
from antinode.riccati.chain import Chain, omega2_scale
from antinode.riccati.roots import Certificate, CountingError, Eigenvalue, FollowingRoots
from antinode.riccati.winding import Samples, Turns, around, holds_one, left_of

from .ratio import Following, beyond

FixedEigenvalues = Callable[[int], list[Eigenvalue]]
"""Returns at least so many eigenvalues, from the lowest, of the chain with fixed directions."""

_GAPS = 6  # above those wanted in which the line may stand
_ENOUGH = 0.8  # of abs(g - 1) far off
_DENSE = 6  # samples of the characteristic function for each eigenvalue
_PASSES = 60
_BLURRED = 1e-7  # of the scale, and of the least eigenvalue of fixed directions that is not zero:
# nearer to zero than this, changes of sign may be rounding
_ROUNDED = 1e-7  # of a zero, up to which steps that shrink no more are rounding
_STEPS = 1e-3, 1e-5  # share of an imaginary part: against rounding, and beside a pole
_ON_AXIS = 1e-9  # share of an imaginary part that is rounding
_SINE = math.sin(math.pi / 8)  # of theta/2 left of the line, as far off as 1.5 R


Bracket = tuple[float, float, float, float]
"""Two places with values of different signs, and these."""


class Finder:
    """Finds the eigenvalues of one chain.

    Parameters
    ----------
    chain : Chain
        With an end that follows.
    fixed : callable
    zeros : int
        Eigenvalues that are zero by the supports.
    width : float
        Relative width of brackets in omega^2.
    """

    def __init__(
        self,
        chain: Chain,
        fixed: FixedEigenvalues,
        zeros: int,
        width: float,
    ) -> None:
        self.following, self.fixed, self.zeros, self.width = Following(chain), fixed, zeros, width
        self.scale = omega2_scale(chain)

    def find(self, wanted: int, expected: Complex | None = None) -> FollowingRoots:
        """Find the lowest eigenvalues, `wanted` at the least.

        Where pairs are `expected`, and where two are about to meet, it looks first.
        """
        hints = np.zeros(0, complex) if expected is None else expected
        certificate, poles = self._certify(wanted)
        places, values = self._scan(certificate.below, poles, hints.real)
        missing = certificate.number - self.zeros
        blurred, floor = self._blurred(poles), self._floor
        brackets = _without_rounding(_changes(places, values), blurred)
        while len(brackets) > missing and floor < 1e-5 * self.scale:  # rounding beside zero
            floor *= 10
            keep = np.abs(places) > floor
            brackets = _without_rounding(_changes(places[keep], values[keep]), blurred)
        found = self.shrink(brackets)
        found += [Eigenvalue(0, 0.0, (-floor, floor), (0, 0))] * self.zeros
        if len(brackets) < missing:
            starts = [*hints.tolist(), *self._starts(poles, certificate.below)]
            found += self._missing(missing - len(brackets), found, poles, starts, certificate.below)
        return FollowingRoots(_ordered(found), certificate, len(found) == certificate.number)

    # --- how many ---------------------------------------------------------------------------------

    def _certify(self, wanted: int) -> tuple[Certificate, list[Eigenvalue]]:
        """Return a proof for a line above `wanted` eigenvalues, and those of fixed directions."""
        poles = self.fixed(wanted + 2)
        best: Certificate | None = None
        for below in range(wanted, wanted + _GAPS):
            if len(poles) < below + 1:
                poles = self.fixed(below + 2)
            low, high = poles[below - 1].bracket[1], poles[below].bracket[0]
            if not high > 0 or not low < high:
                continue
            low = max(low, 0.0)
            for share in (0.5, 0.35, 0.65):
                R = (low**0.25 + (high**0.25 - low**0.25) * share) ** 4
                found = turns_along(self.following, R, low, high, poles[0].bracket[0])
                certificate = Certificate(R, below, found.number, found.samples, found.margin)
                if found.proven and certificate.number >= wanted:
                    return certificate, poles
                if found.proven:
                    break
                best = best or certificate
        if best is None:
            raise CountingError("no line was found above the eigenvalues that are wanted")
        return best, poles

    # --- the real ones ----------------------------------------------------------------------------

    @cached_property
    def _floor(self) -> float:
        return 1e-14 * self.scale

    def _scan(self, R: float, poles: list[Eigenvalue], hints: Array) -> tuple[Array, Array]:
        """Return places on the axis up to R, and the characteristic function, zeros divided out."""
        lowest = -max(self.scale, -2 * poles[0].omega2)
        while beyond(self.following.far_off(np.array([-lowest])), 1.0)[0] > _ENOUGH:
            lowest *= 2
        inside = [p.omega2 for p in poles if p.omega2 < R]
        number = _DENSE * (len(inside) + 2)
        roots = np.linspace(-((-lowest) ** 0.25), R**0.25, 2 * number)
        places = np.sign(roots) * roots**4
        near = 1.0001 * np.array(inside), self._near_zero(), hints
        places = np.concatenate([places, [lowest, R], *near])
        places = np.sort(places[(places >= lowest) & (places <= R)])
        new = np.append(True, places[1:] > places[:-1])
        places = places[new & (np.abs(places) >= self._floor)]
        return places, self.divided(places)

    def _blurred(self, poles: list[Eigenvalue]) -> float:
        """Return how near to zero rounding may change signs: a double zero is flat beside others.

        Rounding is a share of the function away from zero, and that rises as the square there.
        """
        sizes = [abs(pole.omega2) for pole in poles]
        return _BLURRED * max(self.scale, min(s for s in sizes if s > self._floor))

    def _near_zero(self) -> Array:
        steps = self.scale * 10.0 ** np.arange(-13, 1)
        return np.concatenate([-steps, steps])

    def divided(self, places: Array) -> Array:
        """Return the characteristic function over omega^2 to the number of its zeros there."""
        sign = np.sign(places) if self.zeros % 2 else 1.0
        return np.asarray(self.following.values(places) * sign)

    def shrink(self, brackets: list[Bracket]) -> list[Eigenvalue]:
        """Shrink brackets to their width, all side by side."""
        least = 2 * self._floor
        return shrink(brackets, lambda places, _: self.divided(places), self.width, least)

    # --- pairs that are missing -------------------------------------------------------------------

    def _missing(
        self,
        number: int,
        found: list[Eigenvalue],
        poles: list[Eigenvalue],
        starts: list[complex],
        R: float,
    ) -> list[Eigenvalue]:
        """Find eigenvalues that change no sign: pairs, complex or too near to be told apart."""
        known: list[complex] = [value.omega2 for value in found]
        more: list[Eigenvalue] = []
        failed: list[complex] = []
        for start in starts:
            root = self._newton(start, known, poles, R) if len(more) < number else None
            if root is None or any(abs(root - z) < 1e-6 * abs(z) for z in failed):
                continue
            new = self._enclosed(root, poles)
            more += new
            failed += [] if new else [root]
            known += [complex(v.omega2, v.imaginary) for v in new]
        return more

    def _starts(self, poles: list[Eigenvalue], R: float) -> list[complex]:
        inside = sorted(abs(p.omega2) for p in poles if p.omega2 < R)
        middle = [(a + b) / 2 for a, b in pairwise(inside)] + inside
        return [complex(x, y * max(x, self.scale)) for y in (0.1, 0.5, 0.02) for x in middle]

    def _newton(
        self, start: complex, known: list[complex], poles: list[Eigenvalue], R: float
    ) -> complex | None:
        """Return a zero of g, with what is known divided out, by secants through three places."""
        inside = np.array([p.omega2 for p in poles if p.omega2 < R])
        unit = max(R, self.scale)

        def deflated(z: Complex) -> Complex:
            value = self.following.ratio(z)
            for pole in inside:
                value = value * ((z - pole) / unit)
            for root in known:
                value = value / ((z - root) / unit)
            return value

        x = np.array([start, start * (1 + 1e-3), start * (1 + 1e-3j)])
        with np.errstate(all="ignore"):
            y, last = deflated(x), math.inf
            for _ in range(_PASSES):
                step = _muller(x, y)
                new = x[2] + step
                if not np.isfinite(new):
                    return None
                if new.imag < 0:
                    new = new.conjugate()
                size = abs(new - x[2])
                if size <= 1e-13 * abs(new) or last / 2 <= size <= _ROUNDED * abs(new):
                    break
                last = size
                if abs(new.imag) < 1e-12 * abs(new):
                    new = complex(new.real, 1e-12 * abs(new))
                x, y = np.append(x[1:], new), np.append(y[1:], deflated(np.array([new])))
            else:
                return None
        return complex(new) if new.real < 4 * R else None

    def _enclosed(self, root: complex, poles: list[Eigenvalue]) -> list[Eigenvalue]:
        """Return an eigenvalue on the axis, or a pair in circles, with proof; none without."""
        if root.imag < _ON_AXIS * abs(root):
            single = self._on_axis(root.real)
            if single:
                return single
        fixed = np.array([p.omega2 for p in poles])
        radius = max(self.width * abs(root) / 2, 4 * self._floor)
        for _ in range(5):
            if radius >= 0.5 * root.imag:
                return self._together(root, poles)
            steps = [share * root.imag for share in _STEPS]
            if any(holds_one(lambda z: self._sampled(z, fixed), root, radius, s) for s in steps):
                edge = (root.real - radius, root.real + radius)
                parts = (root.imag, -root.imag)
                return [Eigenvalue(0, root.real, edge, (0, 0), part) for part in parts]
            radius *= 8
        return []

    def _on_axis(self, root: float) -> list[Eigenvalue]:
        """Bracket an eigenvalue that has a near neighbour on the axis."""
        step = max(self.width * abs(root) / 2, 2 * self._floor) * 4.0 ** np.arange(8)
        values = self.divided(np.concatenate([root - step, root + step]))
        below, above = values[: len(step)], values[len(step) :]
        apart = np.flatnonzero(below * above < 0)[:1]
        return self.shrink([(root - step[k], root + step[k], below[k], above[k]) for k in apart])

    def _together(self, root: complex, poles: list[Eigenvalue]) -> list[Eigenvalue]:
        """Enclose two eigenvalues that are too near each other, and to the axis, to tell apart."""
        fixed = np.array([p.omega2 for p in poles])
        radius = max(4 * root.imag, self.width * abs(root))
        for _ in range(4):
            turns = around(
                lambda z: self._off_axis(z, fixed), complex(root.real), radius, most=1000
            )
            inside = int(np.sum(np.abs(fixed - root.real) < radius))
            if turns.proven and turns.number + inside == 2:
                edge = (root.real - radius, root.real + radius)
                return [Eigenvalue(0, root.real, edge, (0, 0))] * 2
            radius *= 4
        return []

    def _off_axis(self, z: Complex, fixed: Array) -> Samples:
        """Sample g; where a circle meets the axis it is bounded from just beside."""
        reach = np.min(np.abs(z[:, None] - fixed), axis=1)
        return self._sampled(z + 1e-3j * reach * (np.abs(z.imag) < 1e-3 * reach), fixed)

    def _sampled(self, z: Complex, fixed: Array) -> Samples:
        """Sample g at places that are off the axis."""
        return self.following.samples(z, np.min(np.abs(z[:, None] - fixed), axis=1))


def turns_along(following: Following, R: float, low: float, high: float, lowest: float) -> Turns:
    """Count turns of g along a line in a gap between eigenvalues of fixed directions."""
    distance = 1.5 * max(R, -2 * lowest)
    while True:
        near = float(beyond(following.far_off(np.array([distance])), _SINE)[0])
        if near < _ENOUGH or distance > 1e9 * R:
            break
        distance *= 4
    gap = min(R - low, high - R)

    def evaluate(at: Complex) -> Samples:
        return following.samples(at, np.hypot(gap, at.imag))

    height = math.sqrt(distance**2 - R**2)
    return left_of(evaluate, R, 0.3 * gap, height, near)


def shrink(
    brackets: Sequence[Bracket],
    values: Callable[[Array, Integers], Array],
    width: float,
    least: float = 0.0,
) -> list[Eigenvalue]:
    """Shrink brackets to their width, all side by side.

    Parameters
    ----------
    values : callable
        Returns what changes its sign, at places in the brackets of given numbers.
    width : float
        Relative.
    least : float
        And no narrower than this [rad^2/s^2].
    """
    if not len(brackets):
        return []
    low, high, at_low, at_high = np.array(brackets).T.copy()
    guess, old = (low + high) / 2, np.full(len(low), np.inf)
    last, at_last = low.copy(), at_low.copy()
    for turn in range(_PASSES):
        size = np.maximum(width * np.maximum(np.abs(low), np.abs(high)), least)
        open_ = np.flatnonzero(high - low > size * (1 + 1e-9))
        if not len(open_):
            break
        guess = _inverse_quadratic(low, high, at_low, at_high, last, at_last)
        slow = (high - low > 0.5 * old) & (turn % 3 == 2)
        guess = np.where(slow, _middle(low, high), guess)
        old = high - low
        beside = guess[open_, None] + 0.45 * size[open_, None] * np.array([-1.0, 1.0])
        inside = (beside > low[open_, None]) & (beside < high[open_, None])
        flat, owner = beside[inside], np.repeat(open_, 2)[inside.ravel()]
        if not len(flat):
            break
        for k, x, y in zip(owner, flat, values(flat, owner), strict=True):
            if not low[k] < x < high[k]:
                continue
            if y * at_low[k] > 0:
                last[k], at_last[k] = low[k], at_low[k]
                low[k], at_low[k] = x, y
            else:
                last[k], at_last[k] = high[k], at_high[k]
                high[k], at_high[k] = x, y
    root = np.clip(_secant(low, high, at_low, at_high), low, high)
    return [
        Eigenvalue(0, float(x), (float(a), float(b)), (0, 0))
        for x, a, b in zip(root, low, high, strict=True)
    ]


def _ordered(found: list[Eigenvalue]) -> list[Eigenvalue]:
    """Return eigenvalues numbered by omega^2, complex ones by (Im s)^2, then Re s."""
    ordered = sorted(found, key=lambda value: (value.order, -value.imaginary))
    return [
        Eigenvalue(k + 1, v.omega2, v.bracket, (k, k + 1), v.imaginary)
        for k, v in enumerate(ordered)
    ]


def _changes(places: Array, values: Array) -> list[Bracket]:
    """Return the neighbours between which a value changes its sign."""
    change = np.flatnonzero(values[1:] * values[:-1] <= 0)
    rows = np.stack([places[:-1], places[1:], values[:-1], values[1:]], axis=1)[change]
    return [(a, b, c, d) for a, b, c, d in rows.tolist()]


def _without_rounding(brackets: list[Bracket], blurred: float) -> list[Bracket]:
    """Take three or more changes of sign close to zero for one, if odd in number, or for two.

    A double root at zero, of a body whose turn is free, makes its neighbourhood so flat that
    rounding changes the sign again and again; each would pass for an eigenvalue.
    """
    near = [k for k, (low, high, *_) in enumerate(brackets) if max(-low, high) < blurred]
    if len(near) < 3:
        return brackets
    first, last = brackets[near[0]], brackets[near[-1]]
    whole = (first[0], last[1], first[2], last[3])
    kept = [whole] if len(near) % 2 else [first, last]
    return [*brackets[: near[0]], *kept, *brackets[near[-1] + 1 :]]


def _middle(low: Array, high: Array) -> Array:
    same = low * high > 0
    with np.errstate(invalid="ignore"):
        ratio = np.sign(low) * np.sqrt(low * high)
    return np.where(same, ratio, (low + high) / 2)


def _secant(low: Array, high: Array, a: Array, b: Array) -> Array:
    gap = np.where(b == a, 1.0, b - a)
    return np.asarray(np.where(b == a, (low + high) / 2, low - a * (high - low) / gap))


def _inverse_quadratic(low: Array, high: Array, a: Array, b: Array, last: Array, c: Array) -> Array:
    """Return where the parabola x(y) through three places is zero; the secant where it leaves."""
    with np.errstate(all="ignore"):
        x = (
            low * b * c / ((a - b) * (a - c))
            + high * a * c / ((b - a) * (b - c))
            + last * a * b / ((c - a) * (c - b))
        )
    inside = (x > low) & (x < high)
    return np.where(inside, x, _secant(low, high, a, b))


def _muller(x: Complex, y: Complex) -> complex:
    """Return the step from the last of three places to the nearest zero of their parabola."""
    h1, h2 = x[1] - x[0], x[2] - x[1]
    d1, d2 = (y[1] - y[0]) / h1, (y[2] - y[1]) / h2
    a = (d2 - d1) / (h1 + h2)
    b = a * h2 + d2
    root = np.sqrt(b * b - 4 * a * y[2] + 0j)
    below = b + root if abs(b + root) > abs(b - root) else b - root
    return complex(-2 * y[2] / below)
