"""Where a root lies, by the samples around it; and how sure it is between its two counts.

The characteristic function divided by (omega^2 - root) of the other roots is nearly linear between
its neighbours: it has no poles, and no other zero near.
"""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import math

import numpy as np

from antinode.riccati.reasons import CERTIFIED, CLUSTERED

from . import laws
from .compiling import compiled, summing
from .workspace import AT, BELOW, CARRIED_FROM, GROUND, SHEAR_WORK, SHIFT, VALUE

_NEIGHBOURS = 4  # roots on each side that are divided out
_NEAR = 4  # samples that a polynomial goes through, at most
_TOO_NEAR, _TOO_FAR = 1e-8, 1e-2  # relative distances of samples that tell a slope


@compiled
def divided_out(x, root, k, rigid):
    """Return the product of (x - root) over the neighbouring roots and the rigid ones."""
    product = 1.0
    for j in range(max(0, k - _NEIGHBOURS), min(len(root), k + _NEIGHBOURS + 1)):
        if j != k:
            product *= x - root[j]
    if root[0] > 0.0 and k < _NEIGHBOURS:
        for _ in range(rigid):
            product *= x
    return product


@compiled
def shifted(value, power):
    """Return the value times a power of two, which mostly is 0."""
    return value if power == 0.0 else math.ldexp(value, int(power))


@compiled
def _between_neighbours(k, root):
    """Return the interval between the roots on both sides."""
    left = 0.0 if root[0] > 0.0 else -np.inf
    if k > 0:
        left = root[k - 1]
    return left, root[k + 1] if k + 1 < len(root) else np.inf


@compiled
def _nearest(k, index, total, root, search):
    """Collect up to four samples next to root k that lie between its neighbours."""
    samples, near, found = search.samples, search.near, 0
    left, right = _between_neighbours(k, root)
    for i in range(total):
        x, count = samples[i, AT], samples[i, BELOW]
        if x <= left or x >= right or count < index - 1 or count > index:
            continue
        away = abs(x - root[k])
        if found == _NEAR and away >= abs(samples[near[_NEAR - 1], AT] - root[k]):
            continue
        place = min(found, _NEAR - 1)
        while place > 0 and abs(samples[near[place - 1], AT] - root[k]) > away:
            near[place] = near[place - 1]
            place -= 1
        near[place] = i
        found = min(found + 1, _NEAR)
    return found


@compiled
def _latest(k, index, root, search):
    """Collect the samples that root k asked for last, as `_nearest` would."""
    samples, found = search.samples, 0
    left, right = _between_neighbours(k, root)
    for i in range(_NEAR):
        j = search.own[k, i]
        if j >= 0 and left < samples[j, AT] < right and index - 1 <= samples[j, BELOW] <= index:
            search.near[found] = j
            found += 1
    return found


@compiled
def _interpolate(x, y, number):
    """Return x where the polynomial x(y) through the points has y = 0 (Neville; x is lost).

    Also the same without the last point, and the x of that.
    """
    farthest, rough = x[number - 1], x[0]
    for size in range(1, number):
        rough = x[0]
        for i in range(number - size):
            x[i] = (y[i] * x[i + 1] - y[i + size] * x[i]) / (y[i] - y[i + size])
    return x[0], rough, farthest


@compiled
def predict(k, rigid, total, roots, search):
    """Return root k from the samples next to it, and its likely error (inf: no prediction)."""
    samples, near, x, y = search.samples, search.near, search.x, search.y
    root, slope, index = roots.omega2, roots.slope[k], rigid + k + 1
    number = _latest(k, index, root, search)
    if number < 2 and (slope == 0.0 or number == 0):
        number = _nearest(k, index, total, root, search)
    if number == 0:
        return root[k], np.inf
    power = samples[near[0], SHIFT]
    for i in range(number):
        j = near[i]
        value = shifted(samples[j, VALUE], samples[j, SHIFT] - power)
        x[i], y[i] = samples[j, AT], value / divided_out(samples[j, AT], root, k, rigid)
    if number == 1:
        if slope == 0.0:
            return root[k], np.inf
        step = shifted(y[0], power) / slope
        return x[0] - step, abs(step)
    better, rough, farthest = _interpolate(x, y, number)
    gap = min(abs(root[k]), distance_to_others(root, k))
    return better, abs(better - rough) * min(1.0, abs(farthest - better) / gap)


@compiled
def distance_to_others(root, k):
    """Return the distance of root k to its neighbours; inf if it has none."""
    gap = np.inf
    if k > 0:
        gap = abs(root[k] - root[k - 1])
    if k + 1 < len(root):
        gap = min(gap, abs(root[k + 1] - root[k]))
    return gap


@compiled
def keep_slopes(below, total, roots, search):
    """Set the divided function's slope at every root, for the next chain's first step."""
    for k in range(len(roots.omega2)):
        roots.slope[k] = 0.0
        if _slope_from(search.own[k], _NEAR, k, below, roots, search):
            continue
        number = _nearest(k, below + k + 1, total, roots.omega2, search)
        _slope_from(search.near, number, k, below, roots, search)


@compiled
def _slope_from(near, number, k, below, roots, search):
    """Set the slope at root k by the first of some samples that is neither too near nor too far."""
    samples, root = search.samples, roots.omega2
    for i in range(number):
        j = near[i]
        if j < 0:
            return False
        x = samples[j, AT]
        away = x - root[k]
        if _TOO_NEAR * abs(root[k]) < abs(away) < _TOO_FAR * abs(root[k]):
            divided = samples[j, VALUE] / divided_out(x, root, k, below) / away
            roots.slope[k] = shifted(divided, samples[j, SHIFT])
            return True
    return False


# --- how sure a root is: rounding, held against the bracket's width -------------------------------

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
