"""How sure a root is between its two counts: rounding, held against the bracket's width."""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import math

import numpy as np

from antinode.riccati.reasons import CERTIFIED, CLUSTERED

from . import laws
from .compiling import compiled, summing
from .prediction import distance_to_others, divided_out, shifted
from .workspace import AT, CARRIED_FROM, GROUND, SHEAR_WORK, SHIFT, VALUE

_EPSILON = 64 * float(np.finfo(float).eps)  # rounding of what is carried, relative
_SURE = 0.3  # share of a bracket that rounding may take
_APART, _ALONE = 1e-4, 1e-3  # relative distance of roots below which counts are not sure, and
# below which they are not without a sample off all roots
_OFF, _WITHIN = 1e-7, 3e-2  # relative distances of such a sample


@compiled
def certify(chain, task, total, roots, search):
    """Set the rounding of every root; return whether all are certified."""
    pull, most, sure = _pull(chain.length, chain.force), 0.0, True
    root, rounding = roots.omega2, roots.rounding
    for i in range(len(chain.force)):
        most = max(most, abs(chain.force[i]))
    if chain.more.shape[1]:
        pull, most = _pull_of_more(chain, pull, most)
    for k in range(len(root)):
        steepness = _steepness(k, task.below, total, root, search.samples)
        rounding[k] = _rounding(chain, search.samples, search.at[k], pull, steepness)
        apart = distance_to_others(root, k) / max(abs(root[k]), 1e-300)
        sure = sure and rounding[k] <= _SURE * task.width * abs(root[k])
        sure = sure and apart > (_APART if steepness > 0.0 else _ALONE)
        rounding[k] = max(rounding[k], _cancelling(root[k], most))
    return CERTIFIED if sure else CLUSTERED


@compiled
def settle(roots, search):
    """Set every root to the secant of its bracket, where the ends have different signs."""
    root, samples = roots.omega2, search.samples
    for k in range(len(root)):
        low, high = search.at[k, 0], search.at[k, 1]
        before = samples[low, VALUE]
        after = shifted(samples[high, VALUE], samples[high, SHIFT] - samples[low, SHIFT])
        if before * after < 0.0:
            way = (samples[high, AT] - samples[low, AT]) * before / (before - after)
            root[k] = samples[low, AT] + way
        root[k] = min(max(root[k], roots.low[k]), roots.high[k])


@compiled
def _rounding(chain, samples, at, force, steepness):
    """Estimate the rounding of a root: that of what is carried, over the slope of what is 0.

    The slope is the smaller of that in the bracket and of the steepness around. The determinant of
    two roots that nearly coincide is small of second order, and its sign is sure no nearer to them
    than the square root of rounding.
    """
    low, high = samples[at[0]], samples[at[1]]
    size, unit = laws.size_and_unit(chain, low[AT], force, low[CARRIED_FROM:])
    rise = abs(low[VALUE]) + abs(shifted(high[VALUE], high[SHIFT] - low[SHIFT]))
    slope = rise / (high[AT] - low[AT])
    if steepness > 0.0:
        slope = min(slope, shifted(steepness, -low[SHIFT]))
    return _EPSILON * size / (slope * unit) if slope > 0.0 else np.inf


@compiled
def _steepness(k, rigid, total, root, samples):
    """Return the slope of the characteristic function at root k, from a sample off all roots.

    It is the divided function there times the distances of the other roots; 0 if no sample will do.
    Beside a root that nearly coincides, samples in between tell noise.
    """
    best, place = _OFF * abs(root[k]), -1
    for i in range(total):
        x = samples[i, AT]
        if abs(x - root[k]) > _WITHIN * abs(root[k]):
            continue
        off = abs(x - root[k])
        for j in range(max(0, k - 1), min(len(root), k + 2)):
            off = min(off, abs(x - root[j]))
        if off > best:
            best, place = off, i
    if place < 0:
        return 0.0
    x = samples[place, AT]
    divided = samples[place, VALUE] / divided_out(x, root, k, rigid) / (x - root[k])
    return abs(shifted(divided * divided_out(root[k], root, k, rigid), samples[place, SHIFT]))


@compiled
def _cancelling(omega2, force):
    """Estimate the rounding of omega^2 that is small against what EI and N add to it."""
    wave = force / 2.0 + math.sqrt(force * force / 4.0 + abs(omega2))
    return _EPSILON * (abs(omega2) + 2.0 * force * wave)


@summing
def _pull_of_more(chain, pull, most):
    """Return the integral and the largest of abs(N) with what shear and foundation add."""
    h, more, bed = chain.length, chain.more, 0.0
    for k in range(len(h)):
        pull += more[SHEAR_WORK, k] * h[k]
        bed += more[GROUND, k] * h[k]
        most = max(most, abs(chain.force[k]) + more[SHEAR_WORK, k])
    return pull + math.sqrt(bed), most


@summing
def _pull(h, N):
    """Return the integral of abs(N)."""
    total = 0.0
    for k in range(len(h)):
        total += abs(N[k]) * h[k]
    return total
