"""Certified eigenvalues of a chain: counts bracket every root, interpolation refines inside.

Every pass evaluates counts and the characteristic function at many omega^2 side by side. A bracket
is a pair of neighbouring samples whose counts differ; it can only shrink, and it is the certificate
that is reported. Inside a bracket of one root the samples are placed around the prediction of an
inverse interpolation, with a few equidistant ones that guarantee progress whatever the function.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from .arrays import Array, Integers, distinct
from .chain import Chain, Evaluation, evaluate, omega2_scale

_MAX_PASSES = 80
_GUARD = 4  # equidistant samples inside every open bracket, each pass


class CountingError(ArithmeticError):
    """The counts could not be brought to bracket the eigenvalues asked for."""


@dataclass(frozen=True)
class Eigenvalue:
    """One eigenvalue, or one of a cluster that rounding cannot part, with its certificate.

    Attributes
    ----------
    index : int
        1 for the lowest eigenvalue of the chain, negative ones included.
    omega2 : float
        [rad^2/s^2].
    bracket : tuple of float
        omega^2 below and above the root [rad^2/s^2].
    counts : tuple of int
        Number of eigenvalues below either end of the bracket.
    imaginary : float
        Imaginary part of omega^2 where end forces follow [rad^2/s^2]; a circle as wide as the
        bracket then encloses the eigenvalue.
    """

    index: int
    omega2: float
    bracket: tuple[float, float]
    counts: tuple[int, int]
    imaginary: float = 0.0

    @property
    def value(self) -> complex:
        """omega^2, complex where end forces make it so."""
        return complex(self.omega2, self.imaginary) if self.imaginary else self.omega2

    @property
    def order(self) -> float:
        """What eigenvalues are ordered by: omega^2; (Im s)^2 of the eigenvalue s of a complex one.

        With s^2 = -omega^2 that is ``(|omega^2| + Re omega^2)/2``.
        """
        if not self.imaginary:
            return self.omega2
        return (abs(complex(self.omega2, self.imaginary)) + self.omega2) / 2


@dataclass(frozen=True)
class Certificate:
    """Why nothing is missing and nothing too many left of a line.

    Attributes
    ----------
    below : float
        R, where the line crosses the axis [rad^2/s^2].
    fixed : int
        Eigenvalues below R with fixed directions, by counts.
    turns : int
        Of g about zero: what there is more of where ends follow.
    samples : int
        Of g, on half the line.
    margin : float
        Least share of g that the bounds between samples leave; not proven where it is not positive.
    """

    below: float
    fixed: int
    turns: int
    samples: int
    margin: float

    @property
    def proven(self) -> bool:
        """Whether every arc is bounded in phase."""
        return self.margin > 0.0

    @property
    def number(self) -> int:
        """Eigenvalues left of the line."""
        return self.fixed + self.turns


@dataclass(frozen=True)
class FollowingRoots:
    """Eigenvalues left of a line: real ones ascending, complex pairs, and their certificate."""

    eigenvalues: list[Eigenvalue]
    certificate: Certificate
    complete: bool
    """Whether as many were enclosed as were proven to be there."""


class Samples:
    """Evaluations of a chain, sorted by omega^2."""

    def __init__(self, chain: Chain) -> None:
        self.chain = chain
        self.omega2: Array = np.empty(0)
        self.count: Integers = np.empty(0, dtype=np.int64)
        self.characteristic: Array = np.empty(0)

    def add(self, omega2: Array) -> None:
        """Evaluate the chain at new points and merge them in."""
        new = distinct(omega2)
        if len(self.omega2):
            at = np.searchsorted(self.omega2, new).clip(max=len(self.omega2) - 1)
            new = new[self.omega2[at] != new]
        if not len(new):
            return
        values = evaluate(self.chain, new)
        if not np.all(np.isfinite(values.characteristic)):
            raise CountingError("the characteristic function is not finite")
        self._merge(new, values)

    def _merge(self, new: Array, values: Evaluation) -> None:
        omega2 = np.concatenate([self.omega2, new])
        order = np.argsort(omega2)
        self.omega2 = omega2[order]
        self.count = np.concatenate([self.count, values.below])[order]
        self.characteristic = np.concatenate([self.characteristic, values.characteristic])[order]

    def above(self, index: int) -> int:
        """Return the position of the first sample that counts at least `index` eigenvalues."""
        return int(np.argmax(self.count >= index))


def find_eigenvalues(
    chain: Chain,
    wanted: int,
    *,
    zeros: int = 0,
    width: float = 1e-10,
    expected: Array | None = None,
) -> list[Eigenvalue]:
    """Return the lowest eigenvalues of a chain, and every other one below or at zero.

    Parameters
    ----------
    chain : Chain
    wanted : int
        How many eigenvalues, from the lowest, at the least.
    zeros : int
        How many eigenvalues are exactly zero by the supports (rigid modes that no force holds).
    width : float
        Relative width of the brackets in omega^2.
    expected : array, optional
        Places beside which the eigenvalues probably lie [rad^2/s^2]; they only save time.

    Returns
    -------
    list of Eigenvalue
        In ascending order, without a gap.

    Raises
    ------
    CountingError
        If brackets cannot be found.
    """
    if chain.follows:
        raise CountingError("counts hold for end forces of fixed direction alone")
    samples = Samples(chain)
    samples.add(_first_guesses(chain, wanted) if expected is None else expected)
    _extend(samples, wanted)
    floor = _isolate_zero(samples, zeros)
    last = max(wanted, int(samples.count[np.searchsorted(samples.omega2, floor)]))
    _shrink(samples, last, width, floor)
    return _collect(samples, last, floor if zeros else 0.0)


def _first_guesses(chain: Chain, wanted: int) -> Array:
    """Return samples between the roots that a slowly varying chain would have, and some below 0."""
    scale = omega2_scale(chain)
    trial = scale * np.logspace(-2, 6 + 4 * np.log10(wanted + 2), 200)
    phase = (
        np.array([np.sum(chain.law.oscillation(chain, w) * chain.length) for w in trial]) / np.pi
    )
    targets = np.arange(0.25, wanted + 2.5, 0.5)
    guesses: Array = np.interp(targets, phase, trial)
    below = chain.law.lowest(chain)
    if below == 0.0:
        return guesses
    return np.concatenate([guesses, -below * np.logspace(-6, 0, 4)])


def _extend(samples: Samples, wanted: int) -> None:
    """Add samples until none lies below the first and `wanted` lie below the last."""
    scale = omega2_scale(samples.chain)
    for _ in range(60):
        if samples.count[0] == 0:
            break
        samples.add(np.array([4.0, 40.0, 400.0]) * min(samples.omega2[0], -scale))
    for _ in range(60):
        if samples.count[-1] >= wanted:
            return
        samples.add(np.array([2.0, 4.0, 16.0]) * max(samples.omega2[-1], scale))
    raise CountingError(f"fewer than {wanted} eigenvalues were found")


def _isolate_zero(samples: Samples, zeros: int) -> float:
    """Sample just below and above zero; return the distance at which the counts make sense."""
    floor = 1e-16 * omega2_scale(samples.chain)
    for _ in range(10):
        samples.add(np.array([-floor, floor]))
        low, high = np.searchsorted(samples.omega2, [-floor, floor])
        if samples.count[high] - samples.count[low] >= zeros:
            return floor
        floor *= 10.0
    raise CountingError("the rigid modes at omega^2 = 0 could not be counted")


def _shrink(samples: Samples, last: int, width: float, floor: float) -> None:
    for _ in range(_MAX_PASSES):
        tops = {samples.above(index) for index in range(1, last + 1)}
        points = [_next_samples(samples, top, width, floor) for top in sorted(tops)]
        fresh = np.concatenate(points)
        if not len(fresh):
            return
        samples.add(fresh)
    raise CountingError("a bracket would not shrink")


def _next_samples(samples: Samples, top: int, width: float, floor: float) -> Array:
    """Return where to evaluate next inside the bracket that ends at sample `top`."""
    low, high = samples.omega2[top - 1], samples.omega2[top]
    tolerance = max(width * max(abs(low), abs(high)), 2 * floor)
    if high - low <= tolerance * (1 + 1e-9):
        return np.empty(0)
    if samples.count[top] - samples.count[top - 1] > 1 or low < 0 < high:
        return _spread(low, high, 2 * _GUARD)
    root, error = _predict(samples, top)
    step = max(error, 0.4 * max(width * abs(root), 2 * floor))
    near = root + step * np.array([-5.0, -1.0, 1.0, 5.0])  # never on the root itself
    points = np.concatenate([near, _spread(low, high, _GUARD)])
    return np.asarray(points[(points > low) & (points < high)])


def _spread(low: float, high: float, number: int) -> Array:
    """Return points strictly between, evenly spaced (by ratio where the signs agree)."""
    fraction = np.arange(1, number + 1) / (number + 1)
    if low * high > 0:
        return np.asarray(low * (high / low) ** fraction)
    return np.asarray(low + (high - low) * fraction)


def _predict(samples: Samples, top: int) -> tuple[float, float]:
    """Return a root by inverse interpolation inside a bracket of one, and its likely error."""
    x, y = samples.omega2, samples.characteristic
    low, high = float(x[top - 1]), float(x[top])
    if y[top - 1] * y[top] >= 0:
        return (low + high) / 2, (high - low) / 4
    fraction = abs(y[top - 1]) / (abs(y[top - 1]) + abs(y[top]))
    secant = float(low + (high - low) * fraction)
    count = samples.count
    own = (count == count[top]) | (count == count[top - 1])
    near = [i for i in (top - 3, top - 2, top - 1, top, top + 1, top + 2) if 0 <= i < len(x)]
    near = sorted((i for i in near if own[i]), key=lambda i: abs(x[i] - secant))[:4]
    if len(near) < 3 or not _monotone(y[sorted(near)]):
        return secant, (high - low) / 8
    better, rough = (_inverse_interpolation(x[near[:n]], y[near[:n]]) for n in (len(near), 2))
    middle = _inverse_interpolation(x[near[:3]], y[near[:3]]) if len(near) > 3 else rough
    if not low < better < high:
        return secant, (high - low) / 8
    return float(better), float(min(2 * abs(better - middle), (high - low) / 8))


def _monotone(values: Array) -> bool:
    steps = np.diff(values)
    return bool(np.all(steps > 0) or np.all(steps < 0))


def _inverse_interpolation(x: Array, y: Array) -> float:
    """Return the x at which the polynomial x(y) through the points has y = 0 (Lagrange)."""
    root = 0.0
    for i in range(len(x)):
        others = np.delete(y, i)
        root += x[i] * float(np.prod(-others / (y[i] - others)))
    return float(root)


def _collect(samples: Samples, last: int, zero: float) -> list[Eigenvalue]:
    """Turn the brackets into eigenvalues; a bracket within +-`zero` holds exact zeros."""
    found: list[Eigenvalue] = []
    while len(found) < last:
        top = samples.above(len(found) + 1)
        low, high = float(samples.omega2[top - 1]), float(samples.omega2[top])
        counts = int(samples.count[top - 1]), int(samples.count[top])
        exact = -zero <= low and high <= zero
        omega2 = 0.0 if exact else _predict(samples, top)[0]
        indices = range(len(found) + 1, counts[1] + 1)
        found.extend(Eigenvalue(index, omega2, (low, high), counts) for index in indices)
    return found


def check_certificate(found: list[Eigenvalue]) -> bool:
    """Tell whether the counts of the brackets follow each other without a gap."""
    edges = sorted({value.counts for value in found})
    return all(a[1] == b[0] for a, b in pairwise(edges)) and (not edges or edges[0][0] == 0)


# --- one evaluation at a time: statics of a chain under a factor on its axial force --------------

Sample = tuple[int, float]
"""How many eigenvalues are negative, and the determinant, bounded and without poles."""

_MOST_TURNS = 300


def narrow(
    evaluate: Callable[[float], Sample], allowed: int, low: float, high: float, width: float
) -> tuple[float, float, float]:
    """Return the two ends of a bracket of relative `width`, and the root between them.

    Parameters
    ----------
    evaluate : callable
    allowed : int
        At `low` not more eigenvalues are negative, at `high` more are; both positive.
    """
    below, above = evaluate(low), evaluate(high)
    weights = 1.0, 1.0
    for turn in range(_MOST_TURNS):
        if high - low <= width * high:
            break
        x = _next(low, high, below, above, weights, width, by_halves=turn % 4 == 3)
        found = evaluate(x)
        if found[0] > allowed:
            weights = (weights[0] / 2 if x - low > 0.5 * (high - low) else 1.0), 1.0
            high, above = x, found
        else:
            weights = 1.0, (weights[1] / 2 if high - x > 0.5 * (high - low) else 1.0)
            low, below = x, found
    root = _secant(low, high, below[1], above[1])
    return low, high, (low + high) / 2 if root is None else root


def _secant(low: float, high: float, below: float, above: float) -> float | None:
    return low - below * (high - low) / (above - below) if below * above < 0 else None


def _next(
    low: float,
    high: float,
    below: Sample,
    above: Sample,
    weights: tuple[float, float],
    width: float,
    by_halves: bool,
) -> float:
    """Return where to evaluate next: regula falsi between the ends, or the middle.

    A step stays a share of the width away from either end, so that the bracket closes from both.
    """
    middle = math.sqrt(low * high) if high > 2 * low else (low + high) / 2
    x = _secant(low, high, below[1] * weights[0], above[1] * weights[1])
    if x is None or by_halves or above[0] - below[0] != 1:
        return middle
    least = 0.4 * width * high
    return min(max(x, low + least), high - least)
