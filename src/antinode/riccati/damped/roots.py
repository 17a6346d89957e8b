r"""Complex eigenvalues of a chain within a circle about s = 0: all of them, proven.

    zeros of D within = 2 (eigenvalues of the base chain within) + turns of g

D and g have real values on the real axis, so half the circle is followed (`riccati.winding`). Each
eigenvalue, or a group that rounding cannot part, stands in a circle of its own around which the
same is counted. Nothing is proven where columns are complex (loss): that is `damped.loss`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from antinode.riccati.arrays import Array, Complex, Numbers
from antinode.riccati.chain import Chain, omega2_scale
from antinode.riccati.roots import CountingError, Eigenvalue
from antinode.riccati.winding import Path, follow

from .chain import Damped
from .ratio import Ratio, RatioSamples, remainder
from .search import Search, left_over

BaseEigenvalues = Callable[[int], list[Eigenvalue]]
"""Returns at least so many eigenvalues, from the lowest, of the base chain."""

_GAPS = 8  # above those wanted in which the circle may stand
_SHARES = 0.5, 0.35, 0.65  # of a gap where it crosses the axis
_MOST = 1500  # samples on half a circle
_WIDTH = 1e-11  # of a circle around an eigenvalue
_FLOOR = 1e-14  # the same of the scale of s
_NEAR_ZERO = 1e-11  # of that scale: where secants near s = 0 end, and roots are one
_TRIES = (
    (1, 16),
    (1, 64),
    (1, 256),
    (10, 64),
    (1e2, 256),
    (1e3, 256),
    (1e4, 256),
    (1e5, 256),
    (1e6, 256),
)
_TRIES_REAL = 6  # of them, to tell a real one
"""Circles about an eigenvalue: over the first radius, and with how many corners."""
_DISC = 0.2  # of the distance to the next pole of g: where its tangent is bounded
_STEP = 1e-4  # of that disc, between places that tell the slope
_STEPS = 1e-4, 1e-5, 1e-6, 1e-7  # the same where the bound on the disc is wide
_NOISE = 10.0  # times what is seen of rounding
_WIDE = 1e-2  # the same step for curvature
_PAIRS = 1e-11 * 10 ** np.arange(0, 8.5, 0.5)  # of s: circles about two that all but meet
_TANGENTS = 1.0, 30.0, 0.1  # of the first radius, in which that is tried
_APART = 1e-6  # relative distance of eigenvalues that starts alone may tell apart
_FLAT = 1e-5, 1e-12  # of s, and of its scale: imaginary parts that may be rounding
_ROUNDS = 6
_ROUNDING = 4e-15  # of omega^2, in units of EI/(m L^4): ten times what is seen
_NEAR_EDGE = 1e-9  # step over radius, below which a circle may meet an eigenvalue
_MOVES = 2  # of a circle whose eigenvalues could not be enclosed


def rounding(chain: Chain, s: Numbers) -> Array:
    """Return how far rounding of omega^2 = -s^2 moves eigenvalues: much where they are small."""
    return np.asarray(_ROUNDING * omega2_scale(chain) / np.maximum(np.abs(s), 1e-300))


@dataclass(frozen=True)
class ComplexEigenvalue:
    """One eigenvalue, Im s >= 0, for itself and its conjugate.

    Attributes
    ----------
    s : complex
        [1/s].
    error : float
        Radius of a circle about s that holds it [1/s].
    proven : bool
        Whether turns around that circle prove so.
    members : int
        Eigenvalues in that circle: rounding cannot part them.
    """

    s: complex
    error: float
    proven: bool
    members: int = 1


@dataclass(frozen=True)
class Circle:
    """Why nothing is missing and nothing too many in a circle.

    Attributes
    ----------
    radius : float
        [1/s].
    base : int
        Eigenvalues omega^2 of the base chain within, each for two of s.
    turns : int
        Of g, all the way round.
    samples : int
        Of g, on half the circle.
    margin : float
        Least share of g that the bounds between samples leave.
    at_zero : int
        Eigenvalues s = 0.
    loss : float
        With loss factors what must be below 1 for them to leave the number as it is.
    turning : float
        The same of loads along the axis that turn with the section.
    """

    radius: float
    base: int
    turns: int
    samples: int
    margin: float
    at_zero: int
    loss: float = 0.0
    turning: float = 0.0

    @property
    def number(self) -> int:
        """Eigenvalues within, s = 0 and conjugates counted."""
        return 2 * self.base + self.turns


@dataclass(frozen=True)
class ComplexRoots:
    """Eigenvalues within a circle, by abs(Im s), then Re s; those at s = 0 are not among them."""

    eigenvalues: list[ComplexEigenvalue]
    circle: Circle
    counted: int | None = None
    """With loss: how many were found in all of the circle."""

    @property
    def found(self) -> int:
        """How many were found, s = 0 and conjugates counted."""
        if self.counted is not None:
            return self.counted
        return self.circle.at_zero + sum(2 if v.s.imag else 1 for v in self.eigenvalues)

    @property
    def proven(self) -> bool:
        """Whether as many are enclosed as are proven to be there."""
        enclosed = all(v.proven for v in self.eigenvalues)
        inside = all(abs(v.s) + v.error < self.circle.radius for v in self.eigenvalues)
        whole = self.circle.margin > 0 and self.found == self.circle.number
        return whole and enclosed and inside


class Finder:
    """Finds the eigenvalues of one chain within a circle.

    Parameters
    ----------
    damped : Damped
        Without loss.
    base : callable
    zeros : int
        Eigenvalues omega^2 = 0 of the base chain.
    at_zero : int
        Eigenvalues s = 0 of the chain itself, each as often as it counts.
    """

    def __init__(self, damped: Damped, base: BaseEigenvalues, zeros: int, at_zero: int) -> None:
        self.damped, self.base, self.zeros, self.at_zero = damped, base, zeros, at_zero
        self.scale = math.sqrt(omega2_scale(damped.chain))
        self.poles: Array = np.zeros(0)

    def find(self, wanted: int) -> ComplexRoots:
        """Find all eigenvalues within a circle, `wanted` that oscillate among them at the least.

        One that passes too near to an eigenvalue is moved on to the next gap.
        """
        below, enough, moved = wanted, None, 0
        for _ in range(_GAPS):
            circle, path, below = self._certify(below)
            roots = self._within(circle, path)
            oscillating = sum(v.s.imag > 0 for v in roots.eigenvalues)
            if oscillating >= wanted:
                enough = enough or roots
                if roots.proven:
                    return roots
            alone = circle.margin > 0 and all(v.proven for v in roots.eigenvalues)
            if not roots.proven and (not alone or moved >= _MOVES):
                break
            moved += not roots.proven
            below += max(1, wanted - oscillating)
        return enough or roots

    # --- how many ---------------------------------------------------------------------------------

    def _certify(self, below: int) -> tuple[Circle, Path, int]:
        """Return a proof for a circle through the gap above so many base eigenvalues, or higher."""
        best: tuple[Circle, Path, int] | None = None
        for index in range(below, below + _GAPS):
            values = self.base(index + 2)
            self.poles = np.array([0.0 if abs(v.omega2) == 0 else v.omega2 for v in values])
            low, high = values[index - 1].bracket[1], values[index].bracket[0]
            if not high > 0 or not low < high:
                continue
            low = max(low, 0.0)
            for share in _SHARES:
                root = low**0.25 + (high**0.25 - low**0.25) * share
                circle, path = self._circle(root**2)
                if circle.margin > 0:
                    return circle, path, index
                best = best or (circle, path, index)
        if best is None:
            raise CountingError("no circle was found around the eigenvalues that are wanted")
        return best

    @cached_property
    def _angles(self) -> Array:
        return np.linspace(0, math.pi, 25)

    def _circle(self, radius: float) -> tuple[Circle, Path]:
        """Count the turns of g along half a circle."""
        places = radius * np.exp(1j * self._angles)
        places[0], places[-1] = radius, -radius
        path = follow(self.ratio.samples, places, _MOST, radius)
        turns = path.turn / math.pi
        number = round(turns) if math.isfinite(turns) else 0
        whole = math.isfinite(turns) and abs(turns - number) < 1e-6
        inside = int(np.sum(np.abs(self.poles) < radius**2))
        sure = whole and not self._meets_one(path)
        margin = path.margin if sure else min(path.margin, -1.0)
        circle = Circle(radius, inside, number, len(path.samples.at), margin, self.at_zero)
        return circle, path

    def _meets_one(self, path: Path) -> bool:
        """Tell whether a path is so near to an eigenvalue that rounding hides its side."""
        step = np.abs(np.diff(path.samples.at))
        k = int(np.argmin(step))
        if step[k] > _NEAR_EDGE * abs(path.samples.at[k]):
            return False
        beside = slice(k, k + 2)
        return bool(
            np.any(np.abs(path.samples.value[beside]) < 2 * self._noise(path.samples.at[beside]))
        )

    @property
    def ratio(self) -> Ratio:
        """G of the chain, with the poles that are known."""
        return Ratio(self.damped, self.poles)

    # --- where ------------------------------------------------------------------------------------

    def _within(self, circle: Circle, path: Path) -> ComplexRoots:
        """Find and enclose the eigenvalues within a circle."""
        floor = _NEAR_ZERO * self.scale
        search = Search(self.damped, self.at_zero, circle.radius, floor=floor)
        known: list[complex] = []
        steps: list[float] = []

        def missing() -> int:
            return circle.number - circle.at_zero - sum(2 if s.imag else 1 for s in known)

        def take(found: Complex, step: Array, apart: float) -> None:
            for s, size in zip(self._made_real(found, step), step, strict=True):
                new = complex(s)
                near = apart > 0 and any(abs(new - z) <= apart * abs(z) + floor for z in known)
                inside = self._is_inside(new, circle)
                if np.isfinite(size) and inside and not near and missing() > 0:
                    known.append(new)
                    steps.append(float(size))

        starts = np.sqrt(self.poles[(np.abs(self.poles) < circle.radius**2)] + 0j) * 1j
        starts = starts[starts != 0]
        if len(starts):
            take(*search.run(starts * (1 + 1e-4j), []), _APART)
        polished = missing() <= 0
        for turn in range(_ROUNDS):
            if missing() <= 0:
                break
            for start in self._starts(circle, path, known, turn):
                if missing() > 0:
                    take(*search.run(np.array([start]), known), 0.0)
        if known and not polished:  # without what was divided out
            at, step = search.run(np.array(known), [])
            at = self._made_real(at, step)
            for k, (s, size) in enumerate(zip(at, step, strict=True)):
                if np.isfinite(size) and abs(s - known[k]) < 1e-7 * abs(known[k]) + floor:
                    known[k], steps[k] = complex(s), float(size)
        return ComplexRoots(self._enclosed(known, steps), circle)

    def _made_real(self, found: Complex, step: Array) -> Complex:
        """Return places with those made real that are off the axis by rounding alone.

        Zeros off the axis come in pairs; where a circle about the axis holds one, it is real.
        """
        share, least = _FLAT
        near = np.abs(found.imag) <= share * np.abs(found) + least * self.scale
        rows = np.flatnonzero(near & (found.imag != 0) & np.isfinite(step))
        if not len(rows):
            return found
        off = np.abs(found.imag[rows])
        places: Complex = found.real[rows].astype(complex)
        radius = np.maximum(_WIDTH * np.abs(places), np.maximum(8 * step[rows], 2 * off))
        radius = radius + _FLOOR * self.scale
        alone, used = self._holds_one(places, radius)
        alone &= off < used
        for growth, corners in _TRIES[:_TRIES_REAL]:
            open_ = np.flatnonzero(~alone)
            if not len(open_):
                break
            number, sure = self._counted(places[open_], growth * radius[open_], corners)
            alone[open_] = sure & (number == 1)
        found = found.copy()
        found[rows] = np.where(alone, places, found[rows])
        return found

    def _is_inside(self, s: complex, circle: Circle) -> bool:
        """Tell whether s is inside the circle that was followed."""
        return abs(s) < circle.radius

    def _starts(self, circle: Circle, path: Path, known: list[complex], turn: int) -> Complex:
        """Return where to look for what is missing: by sums of powers, then all over."""
        rho = circle.radius
        if turn < 2:
            of_base = 1j * np.sqrt(self.poles[np.abs(self.poles) < rho**2] + 0j)
            all_base = np.concatenate([of_base, -of_base]) / rho
            full = [*known, *(s.conjugate() for s in known if s.imag)]
            have: Numbers = np.array([*full, *[0.0] * circle.at_zero], dtype=complex) / rho
            number = circle.number - len(have)
            sums = _sums(path, all_base, rho, circle.number, number + 1)
            with np.errstate(all="ignore"):  # of a path that meets an eigenvalue
                places = left_over(sums, have) * rho
            upper = places[np.isfinite(places) & (places.imag >= -1e-9 * rho)]
            upper = np.where(upper.imag < 0, upper.conjugate(), upper)
            return upper[np.argsort(-np.abs(upper))] * (1 + 1e-6 * turn)
        rng = np.random.default_rng(turn)
        r, phi = rho * np.sqrt(rng.uniform(0, 1, 12)), rng.uniform(0, math.pi, 12)
        real = rho * np.concatenate([-np.geomspace(1e-4, 0.99, 8), np.geomspace(1e-4, 0.99, 4)])
        return np.concatenate([real + 0j, r * np.exp(1j * phi)])

    # --- how sure ---------------------------------------------------------------------------------

    def _enclosed(self, known: list[complex], steps: list[float]) -> list[ComplexEigenvalue]:
        """Put a circle about every eigenvalue around which turns prove how many it holds."""
        if not known:
            return []
        s = np.array(known)
        radius = np.maximum(_WIDTH * np.abs(s), 8 * np.array(steps)) + _FLOOR * self.scale
        proven, outer = self._holds_one(s, radius)
        members = np.ones(len(s), int)
        everyone = np.concatenate([s, s[s.imag > 0].conj()])
        for k in np.flatnonzero(~proven):
            other = everyone[np.argsort(np.abs(everyone - s[k]))[1:2]]
            radius_of_two = self._holds_two(complex(np.mean([s[k], *other])))
            if len(other) and abs(other[0] - s[k]) / 2 < radius_of_two < np.inf:
                proven[k], members[k] = True, 2
                outer[k] = radius_of_two + abs(other[0] - s[k]) / 2
        for growth, corners in _TRIES:
            open_ = np.flatnonzero(~proven)
            if not len(open_):
                break
            outer[open_] = growth * radius[open_] / math.cos(math.pi / corners)
            number, sure = self._counted(s[open_], growth * radius[open_], corners)
            gap = np.abs(everyone[None, :] - s[open_, None])
            inside = np.sum(gap < growth * radius[open_, None], axis=1)
            good = sure & (number == inside) & (number > 0)
            proven[open_[good]], members[open_[good]] = True, number[good]
        outer = outer + rounding(self.damped.chain, s)
        rows = zip(s.tolist(), outer.tolist(), proven.tolist(), members.tolist(), strict=True)
        found = [ComplexEigenvalue(*row) for row in rows]
        return sorted(found, key=lambda v: (v.s.imag, v.s.real))

    def _holds_one(self, s: Complex, radius: Array) -> tuple[Numbers, Array]:
        """Tell about which places the tangent of g alone decides that one zero is near (Rouche).

        Returns also the radii for which it does: those given where they do, else as much as
        rounding asks for. Where that fails the displacements are combined, at more cost.
        """
        proven, used, noise = np.zeros(len(s), bool), radius.copy(), self._noise(s)
        for turned, steps in ((False, _STEPS[:1]), (True, _STEPS)):
            open_ = np.flatnonzero(~proven)
            if not len(open_):
                break
            here = self.ratio.samples(s[open_], turned=turned)
            disc, off = _disc(here), np.abs(here.value) + noise[open_]
            bound = here.spread(disc)
            slope = self._least_slope(here.at, disc, bound, noise[open_], steps)
            with np.errstate(all="ignore"):
                trials = [growth * radius[open_] for growth in _TANGENTS]
                for trial in (*trials, 4 * off / slope):
                    most = off + remainder(bound, trial, disc)
                    good = ~proven[open_] & (most < 0.5 * slope * trial) & (trial < disc)
                    proven[open_[good]], used[open_[good]] = True, trial[good]
                    if good.all():
                        break
        return proven, used

    def _least_slope(
        self, s: Complex, disc: Array, most: Array, noise: Array, shares: tuple[float, ...]
    ) -> Array:
        """Return what abs(dg/ds) is at the least: by differences, each less what it may err by.

        A short step errs by rounding, a long one by the third derivative, for which the bound on
        the disc leaves much room where many forces act at once.
        """
        least = np.zeros(len(s))
        for share in shares:
            step = share * disc
            there = self.ratio.values(np.concatenate([s + step, s - step]))
            with np.errstate(all="ignore"):
                slope = np.abs(there[: len(s)] - there[len(s) :]) / (2 * step)
                slope = slope - most / disc * share**2 / (1 - share**2) - noise / step
            least = np.fmax(least, slope)
        return least

    def _noise(self, s: Complex) -> Array:
        """Estimate how far rounding moves g: by what it leaves of straight lines very near."""
        steps = np.array([-3, -2, -1, 0, 1, 2, 3])
        places = s[:, None] * (1 + 1e-13 * steps)
        value = self.ratio.values(places.ravel()).reshape(places.shape)
        slope = value @ steps / np.sum(steps**2)
        rest = value - np.mean(value, axis=1, keepdims=True) - slope[:, None] * steps
        return np.asarray(_NOISE * np.max(np.abs(rest), axis=1) + 0.1 * np.abs(slope))

    def _holds_two(self, centre: complex) -> float:
        """Return the least radius within which the parabola of g decides that two zeros are near.

        Infinite where there is none.
        """
        c = np.array([centre])
        here = self.ratio.samples(c)
        disc = _disc(here)
        h, small = _WIDE * disc, _STEP * disc
        there = self.ratio.values(np.concatenate([c + h, c - h, c + small, c - small]))
        radii, noise = _PAIRS * abs(centre), self._noise(c)
        x = np.minimum(radii / disc, 1 - 1e-9)
        with np.errstate(all="ignore"):
            most = here.spread(disc)
            error = most / disc**2 * _WIDE**2 / (1 - _WIDE**2)
            slope = np.abs(there[2] - there[3]) / (2 * small) + noise / small
            slope = slope + most / disc * _STEP**2 / (1 - _STEP**2)
            curvature = np.abs(there[0] + there[1] - 2 * here.value) / (2 * h * h)
            curvature = curvature - error - 4 * noise / h**2
            off = np.abs(here.value) + noise + slope * radii + most * x**3 / (1 - x)
            good = np.flatnonzero(off < 0.5 * curvature * radii**2)
        return float(radii[good[0]]) if len(good) else math.inf

    def _counted(self, centre: Complex, radius: Array, corners: int) -> tuple[Array, Array]:
        """Return the zeros of D in polygons about some places, and whether that is proven."""
        turn = np.exp(2j * math.pi * (np.arange(corners) + 0.5) / corners)
        outer = radius / math.cos(math.pi / corners)
        places = centre[:, None] + outer[:, None] * turn
        samples = self.ratio.samples(places.ravel())
        half = np.repeat(outer * math.sin(math.pi / corners), corners)
        with np.errstate(all="ignore"):
            beside = np.max(self._noise(places[:, :: corners // 4].ravel()).reshape(-1, 4), axis=1)
            off = samples.spread(half) + np.repeat(beside, corners)
            margin = 1 - off / np.maximum(np.abs(samples.value), 1e-300)
        value = samples.value.reshape(places.shape)
        turns = np.sum(np.angle(np.roll(value, -1, axis=1) / value), axis=1) / (2 * math.pi)
        of_base = np.sqrt(-self.poles + 0j)
        of_base = np.concatenate([of_base, -of_base])
        inside = np.sum(np.abs(of_base[None, :] - centre[:, None]) < radius[:, None], axis=1)
        outside = np.sum(np.abs(of_base[None, :] - centre[:, None]) < outer[:, None], axis=1)
        sure = np.all(margin.reshape(places.shape) > 0.02, axis=1) & (inside == outside)
        sure &= np.abs(turns - np.round(turns)) < 1e-6
        return np.round(np.nan_to_num(turns)).astype(int) + inside, sure


def _disc(here: RatioSamples) -> Array:
    """Return radii about places within which g is bounded: -s^2 keeps off its poles there."""
    size, room = np.abs(here.at), _DISC * here.reach
    return np.asarray(room / (size + np.sqrt(size * size + room)))


def _sums(path: Path, of_base: Numbers, rho: float, number: int, most: int) -> Complex:
    """Return sums of powers of the zeros of D within, over rho: of the base chain's, and by g."""
    z, value = path.samples.at / rho, path.samples.value
    with np.errstate(all="ignore"):
        rise = np.log(value[1:] / value[:-1])
    middle = (z[1:] + z[:-1]) / 2
    sums = [complex(number)]
    for k in range(1, most):
        of_g = np.sum(np.nan_to_num(middle**k * rise)).imag / math.pi
        sums.append(complex(np.sum(of_base**k).real + of_g))
    return np.array(sums)
