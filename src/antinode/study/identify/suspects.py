"""What makes a fit poor: how unlikely its misfit is, a row that alone spoils it, far-off priors.

With residuals r in standard deviations, J their Jacobian, and C the inverse of J^T J + P^T P, the
sum of squares that goes when the frequencies i are left out is, to first order,

    r_i^T (1 - J_i C J_i^T)^-1 r_i.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from .estimates import Estimates
from .result import Comparison
from .unknowns import Unknown

_UNLIKELY = 1e-3  # chance of a larger misfit, were model and standard deviations right
_SHARE = 0.5  # of the sum of squares that one row makes
_OUTLYING = 12.0  # mean square of a row over that of the others
_FAR = 3.0  # standard deviations from a prior


class Fit(NamedTuple):
    """How large the residuals are, and how large they should be, in standard deviations (rms)."""

    rms: float
    expected: float
    chance: float
    """Of a sum of squares at least as large."""

    @property
    def is_poor(self) -> bool:
        """Whether it is too unlikely."""
        return self.chance < _UNLIKELY


def quality(estimates: Estimates) -> Fit:
    """Judge the residuals of a fit whose standard deviations are known.

    Parameters took up some of the noise: as many degrees of freedom are left as there are
    frequencies, less the effective number of parameters.
    """
    from scipy.special import chdtrc

    r, left = estimates.residuals, max(estimates.freedoms, 1e-3)
    squares = float(r @ r)
    rms, expected = (math.sqrt(s / len(r)) for s in (squares, left))
    return Fit(rms, expected, float(chdtrc(left, squares)))


class Spoiler(NamedTuple):
    """A row that alone spoils a fit."""

    worst: Comparison
    """Its frequency that is farthest off."""
    share: float
    """Of the sum of squares, priors included, that would go with it."""


def spoiling_row(estimates: Estimates, comparisons: Sequence[Comparison]) -> Spoiler | None:
    """Return the row without which nearly all misfit would be gone, if there is one."""
    prior = estimates.unknowns.prior_residuals(estimates.vector)
    total = float(estimates.residuals @ estimates.residuals + prior @ prior)
    rows = np.array([c.row for c in comparisons])
    found = {row: estimates.without(rows == row) for row in np.unique(rows).tolist()}
    row = max(found, key=lambda k: found[k])
    number, gone = int(np.sum(rows == row)), min(found[row], total)
    others = estimates.freedoms - number
    if others < 1 or gone < _SHARE * total:
        return None
    if gone / number <= _OUTLYING * (total - gone) / others:
        return None
    own = [c for c in comparisons if c.row == row]
    worst = max(own, key=lambda c: abs(c.fitted_hz - c.observed_hz) / c.sd_hz)
    return Spoiler(worst, gone / total)


def far_from_priors(estimates: Estimates) -> Iterator[tuple[Unknown, float, float]]:
    """Yield what ended far from its prior, with its value and the distance in deviations."""
    for item, value in estimates.unknowns.with_prior(estimates.vector):
        distance = item.prior_distance(value)
        if abs(distance) > _FAR:
            yield item, value, distance
