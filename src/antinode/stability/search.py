"""Changes of stability along a factor: followed step by step, and each closed in on its own.

Steps are as long as the eigenvalues can be foreseen by straight lines, within a share of the gaps
between them. The squares of these gaps, and the eigenvalues next to zero, are smooth in the factor;
where a parabola through three of them dips, its lowest point is looked at as well, so that a
stability that is lost and regained within a step is not missed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

from antinode.riccati.chain import Chain

from .circles import sums
from .states import State, Watcher

_FIRST = 1e-3  # of the unit of the factor
_LONGEST = 0.5  # step, over the factor
_ASTRAY = 0.1, 0.02  # of a gap, by which a foreseen eigenvalue may be off; up to which steps grow
_GROWTH = 1.7
_SHORTEST = 5e-3  # step, over the factor
_DIP = 0.25  # of the neighbours' values, below which a lowest point is looked at
_LOOKS = 4  # for it
_CLOSE = 1e-7  # relative width at which what was not told apart stays together
_INSIDE = 0.5  # share of a radius within which zeros must lie


@dataclass(frozen=True)
class Change:
    """A change of stability between two factors, and the circle that holds what changes.

    Attributes
    ----------
    before, after : State
    flutter : bool
    index : tuple of int
        Which eigenvalues, among those that are not always zero.
    centre, radius : float
        Of a circle in the plane of omega^2 [rad^2/s^2].
    number : int
        Eigenvalues in it; 0 where the change could not be told from another one beside it.
    """

    before: State
    after: State
    flutter: bool
    index: tuple[int, ...]
    centre: float = 0.0
    radius: float = 0.0
    number: int = 0

    def value(self, chain: Chain) -> float | None:
        """Return what changes its sign; None where the circle holds others as well."""
        found = sums(chain, self.centre, self.radius)
        if found.number != self.number:
            return None
        return found.apart if self.flutter else found.first


def walk(watcher: Watcher, unit: float, most: float) -> Iterator[tuple[State, State]]:
    """Yield neighbours by rising factor, from 0 up to `most`, near enough to see every change.

    Parameters
    ----------
    watcher : Watcher
    unit : float
        A factor at which the axial force begins to matter.
    most : float
    """
    before, here = None, watcher.at(0.0)
    step = min(_FIRST * unit, most)
    while here.factor < most:
        factor = min(here.factor + step, most)
        after = watcher.at(factor)
        off = _astray(before, here, after)
        if off > _ASTRAY[0] and step > _SHORTEST * factor:
            step *= 0.5
            continue
        if before is not None:
            yield from _islands(watcher, before, here, after)
        yield here, after
        before, here = here, after
        longest = max(_LONGEST * here.factor, _FIRST * unit)
        step = min(step * (_GROWTH if off < _ASTRAY[1] else 1.0), longest)


def _islands(
    watcher: Watcher, before: State, here: State, after: State
) -> Iterator[tuple[State, State]]:
    """Yield neighbours with a state of another status between states of one."""
    for pick in _watched(before, here, after):
        three = [before, here, after]
        for _ in range(_LOOKS):
            dip = _lowest([s.factor for s in three], [pick(s) for s in three])
            if dip is None:
                break
            k = 1 + (dip > three[1].factor)
            new = watcher.at(dip)
            if new.status != here.status:
                yield three[k - 1], new
                yield new, three[k]
                return
            three = [three[k - 1], new, three[k]]


def _astray(before: State | None, here: State, after: State) -> float:
    """Return how far eigenvalues are from a straight line, in gaps between them."""
    if before is None or not before.status == here.status == after.status:
        return 0.0
    n = min(len(s.real) for s in (before, here, after))
    if n == 0 or before.factor == here.factor:
        return 0.0
    share = (after.factor - here.factor) / (here.factor - before.factor)
    foreseen = here.real[:n] + share * (here.real[:n] - before.real[:n])
    gaps = np.diff(here.real[:n], append=np.inf)
    gap = np.minimum(gaps, np.concatenate([[np.inf], gaps[:-1]]))
    return float(np.max(np.abs(after.real[:n] - foreseen) / gap)) if n > 1 else 0.0


def _watched(before: State, here: State, after: State) -> list[Callable[[State], float]]:
    """Return what is smooth and changes its sign with the status: gaps squared, distances to 0."""
    if not before.status == here.status == after.status:
        return []
    n, negative = min(len(s.real) for s in (before, here, after)), here.status[0]
    found: list[Callable[[State], float]] = []
    if negative:
        found.append(lambda s: -float(s.real[negative - 1]))
    if negative < n:
        found.append(lambda s: float(s.real[negative]))
    return [*found, *(partial(_gap_squared, k) for k in range(n - 1))]


def _gap_squared(k: int, state: State) -> float:
    return float(state.real[k + 1] - state.real[k]) ** 2


def _lowest(factors: list[float], values: list[float]) -> float | None:
    """Return where a parabola through three values is lowest, if it is much lower than they."""
    shifted = np.array(factors) - factors[1]
    a, b, c = np.polyfit(shifted, values, 2)
    if not a > 0:
        return None
    at, lowest = -b / (2 * a), c - b * b / (4 * a)
    edge = 1e-6 * (shifted[2] - shifted[0])
    apart = shifted[0] + edge < at < shifted[2] - edge and abs(at) > edge
    return float(factors[1] + at) if apart and lowest < _DIP * min(values) else None


def changes(watcher: Watcher, before: State, after: State) -> Iterator[Change]:
    """Yield the changes of stability between two factors, one by one, by rising factor."""
    if before.status == after.status:
        return
    change = _alone(watcher, before, after)
    if change is not None:
        yield change
        return
    a, b = before.factor, after.factor
    middle = np.sqrt(a * b) if a > 0 and b > 4 * a else (a + b) / 2
    if b - a < _CLOSE * b or not a < middle < b:
        yield from _together(watcher, before, after)
        return
    between = watcher.at(float(middle))
    yield from changes(watcher, before, between)
    yield from changes(watcher, between, after)


def _alone(watcher: Watcher, before: State, after: State) -> Change | None:
    """Return the change if there is one alone, in a circle that holds nothing else."""
    more = after.status[0] - before.status[0]
    pairs = after.status[1] - before.status[1]
    if before.factor == 0:
        return None
    if pairs == 0 and abs(more) == 1:
        change = _divergence(watcher, before, after)
    elif pairs == 1 and more in (0, -2):
        change = _flutter(watcher, before, after)
    else:
        return None
    if change is None:
        return None
    values = [change.value(watcher.load(s.factor)) for s in (before, after)]
    if values[0] is None or values[1] is None or not values[0] * values[1] < 0:
        return None
    return change


def _divergence(watcher: Watcher, before: State, after: State) -> Change | None:
    index = min(before.status[0], after.status[0])
    sides = before, after
    others = np.concatenate([np.delete(np.abs(s.real), index) for s in sides])
    pairs = np.concatenate([np.abs(s.pairs) for s in sides])
    radius = _INSIDE * float(np.min(np.append(others, pairs)))
    if any(abs(s.real[index]) > _INSIDE * radius for s in sides):
        return None
    return Change(before, after, False, (index,), 0.0, radius, watcher.zeros + 1)


def _flutter(watcher: Watcher, before: State, after: State) -> Change | None:
    """Return the two real eigenvalues that became a pair."""
    k = _which(before, after)
    if k is None:
        return None
    two = before.real[k : k + 2]
    mean, half = float(np.mean(two)), float(two[1] - two[0]) / 2
    nearest = int(np.argmin(np.abs(after.pairs.real - mean)))
    pair = complex(after.pairs[nearest])
    centre, shift = (mean + pair.real) / 2, abs(mean - pair.real) / 2
    rest = np.delete(before.real, [k, k + 1]), after.real, np.delete(after.pairs, nearest)
    others = np.abs(np.concatenate(rest) - centre)
    radius = _INSIDE * float(np.min(np.append(others, [abs(centre)] if watcher.zeros else [])))
    if max(half, abs(pair.imag)) + shift > _INSIDE * radius:
        return None
    return Change(before, after, True, (k, k + 1), centre, radius, 2)


def _which(before: State, after: State) -> int | None:
    """Return the first of the two real eigenvalues that are no longer real."""
    n = min(len(before.real) - 2, len(after.real))
    if n < 0:
        return None
    misfit = []
    for k in range(len(before.real) - 1):
        rest, mean = np.delete(before.real, [k, k + 1])[:n], np.mean(before.real[k : k + 2])
        off = np.min(np.abs(after.pairs.real - mean))
        misfit.append(float(np.sum(np.abs(rest - after.real[:n])) + off))
    return int(np.argmin(misfit))


def _together(watcher: Watcher, before: State, after: State) -> Iterator[Change]:
    """Yield changes that could not be told apart: without a circle of their own."""
    pairs = after.status[1] - before.status[1]
    more = after.status[0] - before.status[0] + 2 * max(pairs, 0)
    start = before.status[0]
    for k in range(abs(more)) if pairs <= 0 else ():
        index = start + k if more > 0 else start - 1 - k
        yield Change(before, after, False, (index,))
    for _ in range(max(pairs, 0)):
        found = _flutter(watcher, before, after)
        yield Change(before, after, True, found.index if found else (start, start + 1))
