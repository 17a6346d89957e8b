"""Zeros of an analytic function in a region: its winding number, with every arc bounded in phase.

The number of zeros less that of poles inside a closed path is the number of turns that the value
makes about zero. Along a path it is sampled; around each sample it stays in a disc, whose radius
follows from a bound on its derivative. Where the discs of neighbours, that meet half-way, do not
hold zero, the value turns by less than a right angle on either side of the middle, and the turn
from sample to sample is the difference of their arguments: nothing is missed in between.

Whoever knows a function says how far it may move: `Bounded.spread`. Nothing here knows a beam.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple, Protocol, Self

import numpy as np

from .arrays import Array, Complex, Integers

_SHARE = 0.9  # of a value that may separate it from the rest of its half arc
_MOST = 4000  # samples of a path


class Bounded(Protocol):
    """Values of a function at some places, and how far it may be from them nearby."""

    @property
    def at(self) -> Complex:
        """Places, shape (k,)."""
        ...

    @property
    def value(self) -> Complex:
        """Values there."""
        ...

    def spread(self, distance: Array) -> Array:
        """Return how far the function may be from its values within a distance of each."""
        ...

    def some(self, rows: slice) -> Self:
        """Return some of them."""
        ...

    def joined(self, other: Any, order: Integers) -> Self:
        """Return both, in an order."""
        ...


class Samples(NamedTuple):
    """Values of a function g at some places, and how fast it may leave them.

    At a distance t below `reach` it is within ``first tau + second tau^2`` of its value, with
    ``tau = t / (1 - t/reach)``.
    """

    at: Complex
    value: Complex
    first: Array
    second: Array
    reach: Array

    def spread(self, distance: Array) -> Array:
        """Return how far the function may be from its values within a distance of each."""
        near = np.minimum(distance / self.reach, 1.0)
        with np.errstate(divide="ignore", invalid="ignore"):
            tau = np.where(near < 1.0, distance / (1.0 - near), np.inf)
            return np.where(near < 1.0, self.first * tau + self.second * tau * tau, np.inf)

    def remainder(self, distance: float) -> Array:
        """Return how far the function may be from its tangents within a distance of each place.

        By Cauchy's inequality, from the bound on a disc of half the reach.
        """
        x = 2 * distance / self.reach
        size = self.first * self.reach + self.second * self.reach**2
        return np.where(x < 1, size * x * x / np.maximum(1 - x, 1e-300), np.inf)

    def some(self, rows: slice) -> Samples:
        """Return some of them."""
        at, value, first, second, reach = self
        return Samples(at[rows], value[rows], first[rows], second[rows], reach[rows])

    def joined(self, other: Samples, order: Integers) -> Samples:
        """Return both, in an order."""
        both: list[Any] = [np.concatenate(pair)[order] for pair in zip(self, other, strict=True)]
        return Samples(*both)


class Path(NamedTuple):
    """A path from place to place, and what the value does along it."""

    samples: Bounded
    turn: float
    """Of the value from the first place to the last [rad]; without meaning if not proven."""
    margin: float
    """Least share of a value that its discs leave; negative where they hold zero."""

    @property
    def proven(self) -> bool:
        """Whether every arc is bounded in phase."""
        return self.margin > 0.0


def follow(
    evaluate: Callable[[Complex], Bounded], places: Complex, most: int = _MOST, radius: float = 0.0
) -> Path:
    """Follow a function along lines through places; halve them until all are bounded.

    Parameters
    ----------
    evaluate : callable
        Of places, returns their samples in the same order.
    places : array of complex, shape (k,)
        Corners of the path, k >= 2.
    most : int
        Samples at which it gives up: the path passes a zero, or a pole.
    radius : float
        Of a circle about 0 on which all places lie: its arcs are followed in place of straight
        lines.
    """
    samples, corner = evaluate(places), np.arange(len(places), dtype=float)
    while True:
        half = np.abs(np.diff(samples.at)) / 2
        if radius:  # from the ends of an arc to its middle
            half = half * np.sqrt(2 / (1 + np.sqrt(np.maximum(1 - (half / radius) ** 2, 0.0))))
        size = np.abs(samples.value)
        sides = [samples.some(rows).spread(half) for rows in (slice(-1), slice(1, None))]
        room = np.maximum(size, 1e-300)
        worst = np.maximum(sides[0] / room[:-1], sides[1] / room[1:])
        wide = np.flatnonzero(~(worst < _SHARE))
        if not len(wide) or len(size) + len(wide) > most:
            break
        middle = (corner[wide] + corner[wide + 1]) / 2
        between = (samples.at[wide] + samples.at[wide + 1]) / 2
        new = evaluate(between * (radius / np.abs(between)) if radius else between)
        corner = np.concatenate([corner, middle])
        order = np.argsort(corner, kind="stable")
        samples, corner = samples.joined(new, order), corner[order]
    with np.errstate(all="ignore"):
        turn = float(np.sum(np.angle(samples.value[1:] / samples.value[:-1])))
    return Path(samples, turn, 1.0 - float(np.max(worst)) if np.all(np.isfinite(worst)) else -1.0)


class Turns(NamedTuple):
    """How often a value turns about zero along a closed path, and how sure that is."""

    number: int
    samples: int
    margin: float
    proven: bool


def around(
    evaluate: Callable[[Complex], Bounded], centre: complex, radius: float, most: int = _MOST
) -> Turns:
    """Count zeros less poles in a circle: by a polygon outside it, whose sides touch it."""
    corners = 8
    turn = np.exp(2j * math.pi * np.arange(corners + 1) / corners)
    path = follow(evaluate, centre + radius / math.cos(math.pi / corners) * turn, most)
    return _turns(path, path.turn / (2 * math.pi))


def holds_one(
    evaluate: Callable[[Complex], Samples], centre: complex, radius: float, step: float
) -> bool:
    """Tell whether exactly one zero lies within a radius: whether the tangent alone decides.

    On the circle the tangent is larger than what it leaves out (Rouche); its slope is known from a
    second place, a step away.
    """
    there = evaluate(np.array([centre, centre + step]))
    here = there.some(slice(1))
    slope = abs(there.value[1] - there.value[0]) / step - float(here.remainder(step)[0]) / step
    return bool(abs(there.value[0]) + here.remainder(radius)[0] < slope * radius)


def left_of(
    evaluate: Callable[[Complex], Samples], x: float, first: float, height: float, near: float
) -> Turns:
    """Count zeros less poles with a real part below x, of a function with real values on the axis.

    Parameters
    ----------
    evaluate : callable
    x : float
        Where the line crosses the axis.
    first : float
        Imaginary part of the lowest sample: below it the function is bounded by that sample.
    height : float
        Imaginary part up to which the line is followed.
    near : float
        abs(g - 1) beyond, left of the line: less than 1, so that it cannot turn about zero there.
    """
    rise = np.geomspace(first, height, 2 + int(2 * math.log(height / first)))
    path = follow(evaluate, np.asarray(x + 1j * rise, dtype=complex))
    low = path.samples.some(slice(1))
    below = float(low.spread(np.array([first]))[0] / max(abs(low.value[0]), 1e-300))
    start = np.angle(low.value[0] * np.sign(low.value[0].real))
    top = float(np.angle(path.samples.value[-1]))
    margin = min(path.margin, 1.0 - below, 1.0 - near)
    return _turns(path._replace(margin=margin), (start + path.turn - top) / math.pi)


def _turns(path: Path, turns: float) -> Turns:
    number = round(turns) if math.isfinite(turns) else 0
    whole = math.isfinite(turns) and abs(turns - number) < 1e-6
    return Turns(number, len(path.samples.at), path.margin, path.proven and whole)
