"""Stability with dampers: the factor at which a mode first grows, dashpots and losses counted.

Without them a mode that does not flutter has no growth at all, so that the least of damping may
decide: it can lower the load at which two modes flutter by much (Ziegler, Ing.-Arch. 20 (1952) 49).
The largest Re s of the complex modes is followed in even steps on a coarse chain, and its first
change of sign is closed in on there. From that place secants go on over chains that are refined
until they meet the tolerance.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from antinode.beam.attachments import is_damped
from antinode.beam.beam import Beam
from antinode.beam.families import BENDING
from antinode.modes.backends import choose
from antinode.modes.damped.family import on_refinement
from antinode.modes.damped.modes import names_in
from antinode.modes.loading import under
from antinode.modes.solve import solve_modes

from .result import DampedLoss, Stability

_STEPS = 16
_BEYOND = 1.2  # of the first loss of stability without dampers
_MODES = 4
_WIDTH = 1e-9  # of the bracket, relative
_COARSE_WIDTH = 1e-5
_TOLERANCE = 1e-10
_SLOW = 4  # turns in which a bracket must have halved
_MOST = 100
_BESIDE = 0.45  # of the size of a bracket: where its ends are put
_HIDDEN = 1e-3  # relative width to which growth is told from rounding
_ERRORS = 6.0  # of the growth, that the growth changes by in a bracket, at the least


@dataclass(frozen=True)
class _Growth:
    """The mode that grows fastest under one factor."""

    factor: float
    value: float
    """Re s [1/s]."""
    error: float
    frequency_hz: float
    name: str
    proven: bool

    @property
    def grows(self) -> bool:
        """Whether it grows by more than the error of its growth."""
        return self.value > self.error

    @property
    def decays(self) -> bool:
        """Whether it decays by more than that."""
        return self.value < -self.error


@dataclass(frozen=True)
class _Bracket:
    """Two factors, between which something begins to grow; the lower one is 0 if it has no mode."""

    below: _Growth | None
    above: _Growth

    @property
    def low(self) -> float:
        return 0.0 if self.below is None else self.below.factor

    @property
    def high(self) -> float:
        return self.above.factor

    def narrowed(self, here: _Growth) -> _Bracket:
        """Return what is left of it: all, where the errors leave open what happens."""
        if here.grows:
            return _Bracket(self.below, here)
        return _Bracket(here, self.above) if here.decays else self

    @property
    def slope(self) -> float:
        """Of the growth, by its two ends; NaN where one is not known."""
        return math.nan if self.below is None else _slope(self.below, self.above)

    @property
    def root(self) -> float:
        """Where a secant through its ends crosses zero, inside; else its middle."""
        root = self.high - self.above.value / self.slope if self.slope > 0 else math.nan
        return root if self.low <= root <= self.high else (self.low + self.high) / 2

    @property
    def frequency_hz(self) -> float:
        """Where the secant crosses zero [Hz]; 0 where what grows does not oscillate."""
        below, above = self.below, self.above
        if below is None or not below.frequency_hz or not above.frequency_hz:
            return above.frequency_hz
        share = (self.root - self.low) / (self.high - self.low)
        return below.frequency_hz + share * (above.frequency_hz - below.frequency_hz)


def damped_loss(beam: Beam, found: Stability) -> DampedLoss | None:
    """Return where stability is first lost with dampers; None without any, or where it is not.

    Parameters
    ----------
    beam : Beam
    found : Stability
        Without dampers.
    """
    if not (is_damped(beam.attachments, BENDING) or np.any(beam.loss_factor)):
        return None
    first = found.first
    last = _BEYOND * first.load_factor if first is not None else found.range[1]
    if not 0 < last < np.inf:
        return None
    low: _Growth | None = None
    for factor in last * np.arange(1, _STEPS + 1) / _STEPS:
        here = _on_coarse_chain(beam, float(factor))
        if here.grows:
            return _sharpened(beam, _Bracket(low, here), _WIDTH * last)
        low = here
    return None


def _sharpened(beam: Beam, step: _Bracket, least: float) -> DampedLoss:
    """Close in on the factor: on a coarse chain, then from there on refined ones."""
    coarse, refined = partial(_on_coarse_chain, beam), partial(_refined, beam)
    near = _closed(coarse, step, _COARSE_WIDTH, step.high, step.slope, least)
    found = _closed(refined, step, _WIDTH, near.high, near.slope, least)
    below, above = found.below, found.above
    proven = above is not step.above and above.proven  # both ends on refined chains
    proven &= below is None or (below is not step.below and below.proven)
    bracket = found.low, found.high
    return DampedLoss(found.root, bracket, found.frequency_hz, above.name, proven)


def _closed(
    solve: Callable[[float], _Growth],
    bracket: _Bracket,
    width: float,
    place: float,
    slope: float,
    least: float,
) -> _Bracket:
    """Shrink a bracket by secants through the last two places, put just beyond the root.

    The one of its ends that is farther off is moved; it halves where it does not shrink, or a
    secant leaves it. It ends where the growth at its ends is some errors of the growth. Where
    rounding hides all growth below its upper end, that end alone is closed in on.

    Parameters
    ----------
    solve : callable
    bracket : _Bracket
    width : float
        Relative.
    place, slope : float
        A first guess, and the slope of the growth there; NaN where it is not known.
    least : float
        Factor below which nothing is looked for.
    """
    sizes: list[float] = []
    last: _Growth | None = None
    size, hidden = width * bracket.high, math.nan
    for _ in range(_MOST):
        sizes.append(bracket.high - bracket.low)
        if sizes[-1] <= size or bracket.high < least:
            break
        stuck = len(sizes) > _SLOW and sizes[-1] > sizes[-1 - _SLOW] / 2
        if stuck or not bracket.low < place < bracket.high:
            place = (bracket.low + bracket.high) / 2
        here = solve(place)
        if not (here.grows or here.decays):
            hidden = here.factor
        bracket = bracket.narrowed(here)
        slope = slope if last is None else _slope(last, here)
        size, last = width * bracket.high, here
        place = math.nan
        if slope > 0:
            size = max(size, _ERRORS * here.error / slope)
            root = here.factor - here.value / slope
            up = bracket.high - root > root - bracket.low
            place = root + (_BESIDE if up else -_BESIDE) * size
    return _past_rounding(solve, bracket, hidden)


def _past_rounding(solve: Callable[[float], _Growth], bracket: _Bracket, hidden: float) -> _Bracket:
    """Return a bracket with a lower upper end: from a place on where rounding hides the growth."""
    if not bracket.low < hidden < bracket.high:
        return bracket
    while bracket.high - hidden > _HIDDEN * bracket.high:
        here = solve((hidden + bracket.high) / 2)
        if here.grows:
            bracket = bracket.narrowed(here)
        else:
            hidden = here.factor
    return bracket


def _slope(one: _Growth, other: _Growth) -> float:
    across = other.factor - one.factor
    return (other.value - one.value) / across if across else math.nan


def _on_coarse_chain(beam: Beam, factor: float) -> _Growth:
    """Return what grows fastest on the coarsest chain of a beam."""
    loaded = under(beam, factor)
    solved = on_refinement(loaded, 1, _MODES, choose(), dampers=True)
    s = [value.s for value in solved.eigenvalues]
    k = max(range(len(s)), key=lambda k: s[k].real)
    name, _ = names_in(loaded, solved)[k]
    return _Growth(
        factor,
        s[k].real,
        float(solved.error[k]),
        s[k].imag / (2 * math.pi),
        name,
        solved.certificate["kind"] != "none",
    )


def _refined(beam: Beam, factor: float) -> _Growth:
    """Return what grows fastest, to the tolerance."""
    result = solve_modes(
        under(beam, factor),
        _MODES,
        tolerance=_TOLERANCE,
        families=[BENDING],
        damping="complex",
    )
    moving = [m for m in result.modes if m.number or m.omega2 != 0.0]
    mode = max(moving, key=lambda m: float(m.growth_rate_per_s or 0.0))
    error = mode.error_growth_rate_per_s
    frequency = float(mode.frequency_hz or 0.0)
    return _Growth(
        factor,
        float(mode.growth_rate_per_s or 0.0),
        float(error) if error is not None and math.isfinite(error) else 0.0,
        frequency if math.isfinite(frequency) else 0.0,
        mode.name,
        result.certificate.get("kind") != "none",
    )
