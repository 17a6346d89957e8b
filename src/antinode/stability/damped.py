"""Stability with dampers: the factor at which a mode first grows, dashpots and losses counted.

Without them a mode that does not flutter has no growth at all, so that the least of damping may
decide: it can lower the load at which two modes flutter by much (Ziegler, Ing.-Arch. 20 (1952) 49).
The largest Re s of the complex modes is followed in even steps, and its first change of sign is
closed in on.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from antinode.beam.attachments import is_damped
from antinode.beam.beam import Beam
from antinode.beam.families import BENDING
from antinode.modes.loading import under
from antinode.modes.result import Mode
from antinode.modes.solve import solve_modes

from .result import DampedLoss, Stability

_STEPS = 16
_BEYOND = 1.2  # of the first loss of stability without dampers
_MODES = 4
_WIDTH = 1e-9  # of the bracket, relative
_TOLERANCE = 1e-8


@dataclass(frozen=True)
class _Growth:
    """The mode that grows fastest under one factor."""

    mode: Mode
    proven: bool

    @property
    def value(self) -> float:
        """Re s [1/s]."""
        return float(self.mode.growth_rate_per_s or 0.0)

    @property
    def grows(self) -> bool:
        """Whether it grows by more than the error of its growth."""
        error = self.mode.error_growth_rate_per_s
        return self.value > (float(error) if error is not None and np.isfinite(error) else 0.0)


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
    low, below = 0.0, None
    for factor in last * np.arange(1, _STEPS + 1) / _STEPS:
        here = _fastest(beam, float(factor))
        if here.grows:
            return _closed(beam, low, below, float(factor), here)
        low, below = float(factor), here
    return None


def _closed(
    beam: Beam, low: float, below: _Growth | None, high: float, above: _Growth
) -> DampedLoss:
    """Close in on the factor between two, by secants kept inside and halves."""
    last = high
    while high - low > _WIDTH * high:
        middle = (low + high) / 2
        if below is not None and below.value < 0 < above.value:
            secant = low - below.value * (high - low) / (above.value - below.value)
            inside = 0.45 * _WIDTH * high
            near = min(max(secant, low + inside), high - inside)
            middle = near if high - low < 1e-2 * high else (middle + near) / 2
        here = _fastest(beam, middle)
        if here.value > 0:
            high, above = middle, here
        else:
            low, below = middle, here
        if below is None and high < _WIDTH * last:  # at once
            break
    proven = above.proven and (below is None or below.proven)
    frequency = float(above.mode.frequency_hz or 0.0)
    frequency = frequency if np.isfinite(frequency) else 0.0
    return DampedLoss((low + high) / 2, (low, high), frequency, above.mode.name, proven)


def _fastest(beam: Beam, factor: float) -> _Growth:
    result = solve_modes(
        under(beam, factor),
        _MODES,
        tolerance=_TOLERANCE,
        families=[BENDING],
        damping="complex",
    )
    moving = [m for m in result.modes if m.number or m.omega2 != 0.0]
    mode = max(moving, key=lambda m: float(m.growth_rate_per_s or 0.0))
    return _Growth(mode, result.certificate.get("kind") != "none")
