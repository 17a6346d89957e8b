"""A change of stability on ever finer chains, extrapolated, with its error and its proof.

On each chain the factor is where a smooth function of it is zero: the sum of the eigenvalues in a
circle about 0 for a divergence, the squared distance of two for a flutter (`.circles`). What the
finest chain says is proven by all eigenvalues on either side, as few parts in 1e10 off as can be.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from antinode.beam.families import BENDING
from antinode.modes.hertz import error_hz, hertz
from antinode.modes.refinement import Refinement, layer_length, varying_segments
from antinode.riccati.chain import Chain

from .circles import sums
from .result import Certificate, CriticalLoad
from .result import Change as Told
from .search import Change
from .states import State, Watcher

_ROUNDING = 1e-13  # relative, beside what two circles tell
_WIDEST = 1e-5  # half a bracket, relative
_NARROWEST = 1e-10
_MOST_SEGMENTS = 20_000
_OTHER_CIRCLE = 0.8  # of the radius
_STEPS = 60
_SAME = 4e-16
_NEAR = 1e-10


@dataclass(frozen=True)
class Root:
    """Where a change happens on one chain."""

    factor: float
    rounding: float
    omega2: float
    omega2_rounding: float


def sharpen(
    watcher: Watcher, change: Change, tolerance: float
) -> tuple[CriticalLoad | None, list[str]]:
    """Return a change as a critical load of the beam, and what to warn of; None: it is rounding."""
    beam, names = watcher.beam, tuple(watcher.names[k] for k in change.index)
    sides = change.before, change.after
    if not change.flutter and all(watcher.doubtful(s, change.index[0]) for s in sides):
        return None, []
    if not change.number:
        return _unsharp(change, names), []
    varies = bool(np.any(beam.varies(BENDING)))
    factors, places = (Refinement(tolerance / 2, coarse=_ROUNDING) for _ in range(2))
    finest, guess, warnings = watcher, change, list[str]()
    while True:
        root = _root(finest, guess)
        if root is None:
            return _unsharp(change, names), []
        loaded = finest.load(root.factor)
        layer = layer_length(loaded, varying_segments(beam, loaded))
        factors.add(np.array([root.factor]), layer)
        places.add(np.array([root.omega2]), layer)
        if not varies or factors.met(factors.error):
            break
        if 2 * len(loaded.length) > _MOST_SEGMENTS:
            warnings = [_not_reached(names, len(loaded.length), tolerance)]
            break
        finest = replace(finest, refinement=2 * finest.refinement, solved={})
        guess = replace(change, before=_at(root.factor, -1), after=_at(root.factor, 1))
    value, error = (
        (float(factors.better[0]), float(factors.error[0])) if varies else (root.factor, 0.0)
    )
    place, off = (float(places.better[0]), float(places.error[0])) if varies else (root.omega2, 0.0)
    error, off = error + root.rounding, off + root.omega2_rounding
    bracket, certificate = _proven(finest, change, root, value, error)
    return _critical(change, names, (value, error), (place, off), bracket, certificate), warnings


def _not_reached(names: tuple[str, ...], segments: int, tolerance: float) -> str:
    return (
        f"{' with '.join(names)}: {segments} segments do not reach the tolerance {tolerance:g}; "
        "see the error, or give the stations more smoothly"
    )


def _at(factor: float, side: int) -> State:
    """Return a place beside a factor, whose state nobody asks for."""
    return State(factor * (1 + side * 1e-4), np.zeros(0), np.zeros(0, complex), 0, proven=False)


def _root(watcher: Watcher, change: Change) -> Root | None:
    """Return where the change happens on the chains of a watcher: by secants, in two circles."""
    circles = change, replace(change, radius=_OTHER_CIRCLE * change.radius)
    found = [_secant(watcher, each) for each in circles]
    if found[0] is None or found[1] is None:
        return None
    factor = found[0]
    here, other = (_place(watcher.load(factor), each) for each in circles)
    rounding = 4 * abs(found[0] - found[1]) + _ROUNDING * abs(factor)
    off = 4 * abs(here - other) + _ROUNDING * (abs(here) + change.radius)
    return Root(factor, rounding, here, off)


def _place(chain: Chain, change: Change) -> float:
    """Return omega^2 of what changes: the mean of two that meet, and zero for a divergence."""
    if not change.flutter:
        return 0.0
    return change.centre + sums(chain, change.centre, change.radius).first / 2


def _pair(chain: Chain, change: Change) -> complex | None:
    """Return the pair in the circle of a flutter, or the middle of the two that meet there."""
    if not change.flutter:
        return None
    found = sums(chain, change.centre, change.radius)
    return complex(change.centre + found.first / 2, np.sqrt(max(-found.apart, 0.0)) / 2)


def _secant(watcher: Watcher, change: Change) -> float | None:
    """Return the factor at which the smooth value is zero, to rounding.

    Secants stay between two places of different signs, where there are such: next to where the
    value is lowest, as where a stability is regained soon, a secant by itself would leave them.
    """
    a, b = change.before.factor, change.after.factor
    at_a, at_b = change.value(watcher.load(a)), change.value(watcher.load(b))
    sides = {at_a > 0: a, at_b > 0: b} if at_a is not None and at_b is not None else {}
    for _ in range(_STEPS):
        if at_a is None or at_b is None:
            return None
        if at_a == at_b or abs(b - a) <= _SAME * abs(b):
            return b
        a, b = b, b - at_b * (b - a) / (at_b - at_a)
        within = min(sides.values()) <= b <= max(sides.values())
        if len(sides) == 2 and not within and abs(b - a) > _NEAR * abs(b):
            b = sum(sides.values()) / 2
        at_a, at_b = at_b, change.value(watcher.load(b))
        if at_b is not None:
            sides[at_b > 0] = b
        near = abs(b - a) < _NEAR * abs(b)
        if near and at_b is not None and abs(at_b) >= abs(at_a):  # nothing but rounding is left
            return a
    return None


def _proven(
    watcher: Watcher, change: Change, root: Root, value: float, error: float
) -> tuple[tuple[float, float], Certificate]:
    """Return a bracket, proven on the finest chain, that reaches over the error as well."""
    statuses = change.before.status, change.after.status
    low, high = min(root.factor, value - error), max(root.factor, value + error)
    half, watcher = max(_NARROWEST, 4 * root.rounding / value), replace(watcher, solved={})
    while half <= _WIDEST:
        edges = low - half * value, high + half * value
        sides = [watcher.at(edge, _pair(watcher.load(edge), change)) for edge in edges]
        if all(s.proven for s in sides) and tuple(s.status for s in sides) == statuses:
            certificate = Certificate(
                "winding",
                (sides[0].unstable, sides[1].unstable),
                (sides[0].number, sides[1].number),
            )
            return (sides[0].factor, sides[1].factor), certificate
        half *= 10
    bracket = low - _WIDEST * value, high + _WIDEST * value
    unstable = change.before.unstable, change.after.unstable
    return bracket, Certificate("none", unstable)


def _critical(
    change: Change,
    names: tuple[str, ...],
    factor: tuple[float, float],
    omega2: tuple[float, float],
    bracket: tuple[float, float],
    certificate: Certificate,
) -> CriticalLoad:
    place, off = omega2
    oscillates = change.flutter and place > 0
    return CriticalLoad(
        kind="flutter" if change.flutter else "divergence",
        load_factor=factor[0],
        bracket=bracket,
        error=factor[1],
        frequency_hz=hertz(place) if oscillates else 0.0,
        frequency_error_hz=error_hz(place, off) if oscillates else 0.0,
        omega2=place if change.flutter else 0.0,
        modes=names,
        change=_told(change, place),
        certificate=certificate,
    )


def _told(change: Change, place: float) -> Told:
    if change.flutter:
        return "lost" if place > 0 else "merged"
    return "lost" if change.after.unstable > change.before.unstable else "regained"


def _unsharp(change: Change, names: tuple[str, ...]) -> CriticalLoad:
    """Return a change that could not be told from another beside it, as wide as it was left."""
    before, after = change.before, change.after
    half = (after.factor - before.factor) / 2
    middle = before.factor + half
    pair = after.pairs[:1].real if change.flutter else np.zeros(0)
    place = float(pair[0]) if len(pair) else 0.0
    proven = before.proven and after.proven
    certificate = Certificate(
        "winding" if proven else "none",
        (before.unstable, after.unstable),
        (before.number, after.number),
    )
    spread = float(abs(after.pairs[0].imag)) if len(pair) else 0.0
    bracket = before.factor, after.factor
    return _critical(change, names, (middle, half), (place, spread), bracket, certificate)
