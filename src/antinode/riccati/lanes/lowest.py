"""The lowest eigenvalues of one chain in one call, those that are exactly zero among them.

Counts on either side of zero tell how many lie below it; these and those above are searched.
"""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import math

from antinode.riccati.reasons import (
    CERTIFIED,
    CHAIN_TOO_SMALL,
    CLUSTERED,
    NOT_BRACKETED,
    OUT_OF_REACH,
    TABLE_TOO_SMALL,
)

from . import laws
from .compiling import compiled
from .following import find_all
from .search import pass_chain
from .workspace import COUNT, LANES, OMEGA2, Roots, Search, Task

PARTED = 1e-7
"""Relative distance of roots below which frames part them, and their shapes."""

_FLOORS = 1e-16, 1e-15, 1e-14, 1e-13
"""Distances from zero at which counts may make sense, in the chain's natural unit."""


@compiled
def _natural_unit(chain):
    """Return `riccati.chain.omega2_scale` of a chain without units."""
    logarithm, mass = 0.0, 0.0
    for k in range(len(chain.length)):
        logarithm += chain.length[k] * math.log(abs(chain.stiffness[k]))
        mass += chain.length[k] * chain.mass[k]
    return math.exp(logarithm) / mass


@compiled
def _count_beside_zero(chain, table, lanes):
    """Count eigenvalues below the floors' places on either side of zero, in lanes left and right.

    Returns the reason, and the pieces.
    """
    unit, half = _natural_unit(chain), LANES // 2
    pieces = laws.prepare(chain, unit * _FLOORS[half - 1], table)
    if pieces < 0:
        return OUT_OF_REACH, 0
    if pieces > table.shape[1]:
        return TABLE_TOO_SMALL, pieces
    for lane in range(half):
        lanes.state[OMEGA2 + lane] = -unit * _FLOORS[lane]
        lanes.state[OMEGA2 + half + lane] = unit * _FLOORS[lane]
    pass_chain(chain, table, lanes)
    return CERTIFIED, pieces


@compiled
def _floor(zeros, lanes):
    """Return the lane at whose distance from zero the counts make sense, -1 for none."""
    half = LANES // 2
    for lane in range(half):
        inside = lanes.state[COUNT + half + lane] - lanes.state[COUNT + lane]
        if inside >= zeros:
            return lane if inside == zeros else -1
    return -1


@compiled
def _some_roots(roots, first, last):
    """Return some of the roots."""
    return Roots(
        roots.omega2[first:last],
        roots.slope[first:last],
        roots.low[first:last],
        roots.high[first:last],
        roots.counts[first:last],
        roots.rounding[first:last],
    )


@compiled
def _search_for(number, search):
    """Return room for the search of so many roots."""
    return Search(
        search.samples,
        search.asked,
        search.owner,
        search.before[:number],
        search.stuck[:number],
        search.at[:number],
        search.guess[:number],
        search.own[:number],
        search.wanted[:number],
        search.requests[:number],
        search.certifies[:number],
        search.near,
        search.x,
        search.y,
        search.proof,
    )


@compiled
def _set_zeros(first, last, distance, roots):
    """Set the roots that are zero, in the bracket that the counts left and right of it make."""
    for k in range(first, last):
        roots.omega2[k], roots.low[k], roots.high[k] = 0.0, -distance, distance
        roots.counts[k, 0], roots.counts[k, 1] = first, last


@compiled
def _judge(first, last, roots):
    """Return CERTIFIED where counts go on without a gap, and roots are apart."""
    for k in range(first, last):
        before = roots.counts[k - 1, 1] if k > 0 else 0
        same = k > 0 and roots.counts[k, 0] == roots.counts[k - 1, 0]
        if not (roots.counts[k, 0] == before or (same and roots.counts[k, 1] == before)):
            return NOT_BRACKETED
        if k > first and roots.omega2[k] - roots.omega2[k - 1] <= PARTED * abs(roots.omega2[k]):
            return CLUSTERED
    return CERTIFIED


@compiled
def find_lowest(chain, zeros, wanted, width, unit, roots, table, lanes, search):
    """Find the lowest roots of a chain, and every other one below or at zero, in SI.

    `unit` is that of omega^2. Returns the reason, and how many there are; or what is too small, and
    the size it needs.
    """
    reason, pieces = _count_beside_zero(chain, table, lanes)
    if reason != CERTIFIED:
        return reason, pieces
    lane = _floor(zeros, lanes)
    if lane < 0:
        return NOT_BRACKETED, 0
    negative = int(lanes.state[COUNT + lane])
    first, distance = negative + zeros, lanes.state[OMEGA2 + LANES // 2 + lane]
    total = max(wanted, first)
    if total > len(roots.omega2):
        return CHAIN_TOO_SMALL, total
    _set_zeros(negative, first, distance, roots)
    for part in range(2):
        below, last = (0, negative) if part == 0 else (first, total)
        if last > below:
            own, room = _some_roots(roots, below, last), _search_for(last - below, search)
            task = Task(below, width, True)
            reason, more = find_all(chain, task, False, 0.0, own, table, lanes, room)
            if reason == CERTIFIED:
                reason = _judge(below, last, roots)
            if reason != CERTIFIED:
                return reason, more
    for k in range(total):
        roots.omega2[k] *= unit
        roots.low[k], roots.high[k] = unit * roots.low[k], unit * roots.high[k]
    return CERTIFIED, total
