"""Batches: chain after chain, each from the roots of the one before, or from guesses."""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import numpy as np

from antinode.riccati.reasons import (
    CERTIFIED,
    CLUSTERED,
    INVALID,
    NOT_BRACKETED,
    NOT_FINITE,
    TABLE_TOO_SMALL,
)

from . import laws
from .compiling import compiled, summing
from .following import find_all
from .pieces import refill_force
from .workspace import GROUND, LANES, ROTARY_INERTIA, SHEAR, SHEAR_TURN, SHEAR_WORK, Roots

_REACH = 1.2  # of a table that serves many rows, over the highest root
_MORE_FORCE = 1.1


@compiled
def _is_valid(h, m, K, N):
    """Tell whether lengths, masses and stiffnesses are positive, and all is finite."""
    valid = 0
    for k in range(len(h)):
        valid += 1 if h[k] > 0.0 and h[k] < np.inf and abs(N[k]) < np.inf else 0
        valid += 1 if m[k] > 0.0 and m[k] < np.inf else 0
        valid += 1 if K[k] > 0.0 and K[k] < np.inf else 0
    return valid == 3 * len(h)


@summing
def _means(h, m, K):
    """Return the length, the mean m and the mean stiffness of a chain."""
    L, m0, K0, n = 0.0, 0.0, 0.0, len(h)
    for k in range(n):
        L, m0, K0 = L + h[k], m0 + m[k], K0 + K[k]
    return L, m0 / n, K0 / n


@compiled
def _scale_more(more, L, m0, K0):
    """Make s, sN^2, rho I and k dimensionless."""
    square = L * L
    for k in range(more.shape[1]):
        more[SHEAR, k] *= K0 / square
        more[SHEAR_WORK, k] *= square / K0
        more[ROTARY_INERTIA, k] /= m0 * square
        more[GROUND, k] *= square * square / K0


@compiled
def make_dimensionless(chain):
    """Make a chain dimensionless; return the unit of omega^2, length, mean m and mean stiffness."""
    h, m, K, N = chain.length, chain.mass, chain.stiffness, chain.force
    L, m0, K0 = _means(h, m, K)
    for k in range(len(h)):
        h[k], m[k] = h[k] / L, m[k] / m0
        K[k], N[k] = K[k] / K0, N[k] * (L * L / K0)
    _scale_more(chain.more, L, m0, K0)
    return laws.omega2_unit(chain.law, L, m0, K0), L, m0, K0


@compiled
def scale(chain, units):
    """Make a chain dimensionless; set what `make_dimensionless` returns."""
    units[0], units[1], units[2], units[3] = make_dimensionless(chain)


@summing
def _quotients(weights, mass, stiffness, force, more, quotient):
    """Set Rayleigh's quotients of given shapes for a chain [rad^2/s^2]."""
    for k in range(len(quotient)):
        bending, slope, displacement = weights[0, k], weights[1, k], weights[2, k]
        stored, moving = 0.0, 0.0
        for i in range(len(mass)):
            stored += stiffness[i] * bending[i] - force[i] * slope[i]
            moving += mass[i] * displacement[i]
        for i in range(more.shape[1]):
            stored += more[GROUND, i] * displacement[i] - more[SHEAR_WORK, i] * slope[i]
            stored += weights[4, k, i] - more[SHEAR, i] * weights[3, k, i]
            moving += more[ROTARY_INERTIA, i] * slope[i]
        quotient[k] = stored / moving


@compiled
def _guess(root, quotient, before, unit, current):
    """Guess the roots from a neighbour's and the change of Rayleigh's quotients, if they rise."""
    for k in range(1, len(root)):
        last = root[k - 1] + (quotient[k - 1] - before[k - 1])
        if not last < root[k] + (quotient[k] - before[k]):
            return
    for k in range(len(root)):
        current[k] = (root[k] + (quotient[k] - before[k])) / unit


@compiled
def _roots_of(row, omega2, slope, found):
    """Return the roots of a row, whose brackets and counts are those of the results."""
    low, high, counts = found.low[row], found.high[row], found.counts[row]
    return Roots(omega2, slope, low, high, counts, found.rounding[row])


@compiled
def _to_si(row, unit, found):
    """Set the results of a row in SI."""
    for k in range(found.omega2.shape[1]):
        found.omega2[row, k] *= unit
        found.low[row, k], found.high[row, k] = unit * found.low[row, k], unit * found.high[row, k]
        found.rounding[row, k] *= unit


@compiled
def _take_row(length, mass, stiffness, force, chain):
    """Copy a row into a chain."""
    for k in range(len(chain.length)):
        chain.length[k], chain.mass[k] = length[k], mass[k]
        chain.stiffness[k], chain.force[k] = stiffness[k], force[k]


@compiled
def _take_more(shear, turn, work, rotary, ground, N, own):
    """Set what segments have besides; tell whether all is finite, and in its range.

    Without columns of their own, sN and sN^2 are products of the segment's s and N.
    """
    valid, n, averaged = 0, own.shape[1], len(turn) > 0
    for k in range(n):
        s = shear[k]
        along = turn[k] if averaged else s * N[k]
        own[SHEAR, k], own[SHEAR_TURN, k] = s, along
        own[SHEAR_WORK, k] = work[k] if averaged else along * N[k]
        own[ROTARY_INERTIA, k], own[GROUND, k] = rotary[k], ground[k]
        valid += 1 if s >= 0.0 and s < np.inf and along > -1.0 and along < np.inf else 0
        valid += 1 if abs(own[SHEAR_WORK, k]) < np.inf else 0
        valid += 1 if rotary[k] >= 0.0 and rotary[k] < np.inf else 0
        valid += 1 if ground[k] >= 0.0 and ground[k] < np.inf else 0
    return valid == 4 * n


@compiled
def solve_rows(given, first, chain, task, warmth, table, lanes, search, found):
    """Solve chains from row `first` on; return (row, columns) if one needs a larger table.

    Each starts from the roots of its neighbour, the row solved before.
    """
    length, mass, stiffness, force, shear, turn, work, rotary, ground, following = given
    neighbour, current, quotient = warmth.neighbour, warmth.omega2, warmth.quotient
    for row in range(first, len(mass)):
        h, m, K, N = length[row if len(length) > 1 else 0], mass[row], stiffness[row], force[row]
        if not _is_valid(h, m, K, N):
            found.reason[row] = INVALID
            continue
        _take_row(h, m, K, N, chain)
        s, inertia = shear[row if len(shear) > 1 else 0], rotary[row if len(rotary) > 1 else 0]
        along, twice = turn[row if len(turn) > 1 else 0], work[row if len(work) > 1 else 0]
        bed = ground[row if len(ground) > 1 else 0]
        if not _take_more(s, along, twice, inertia, bed, N, chain.more):
            found.reason[row] = INVALID
            continue
        if warmth.weights.shape[1]:
            _quotients(warmth.weights, m, K, N, chain.more, quotient[0])
        unit, L, _, K0 = make_dimensionless(chain)
        _take_ends(following[row if len(following) > 1 else 0], L * L / K0, chain.following)
        if warmth.weights.shape[1] and neighbour[0] >= 0:
            _guess(found.omega2[neighbour[0]], quotient[0], quotient[1], unit, current)
        roots = _roots_of(row, current, warmth.slope, found)
        columns = _solve_row(row, chain, task, neighbour, roots, table, lanes, search, found)
        if columns:
            return row, columns
        neighbour[0] = row if found.reason[row] == CERTIFIED else -1
        for k in range(len(current)):
            quotient[1, k] = quotient[0, k]
            inside = min(max(current[k], found.low[row, k]), found.high[row, k])
            found.omega2[row, k] = inside
        _to_si(row, unit, found)
    return len(mass), 0


@compiled
def _solve_row(row, chain, task, neighbour, roots, table, lanes, search, found):
    """Solve a row, without its neighbour if need be; return columns if the table needs more."""
    for _attempt in range(2):
        warm = neighbour[0] >= 0
        reason, more = find_all(chain, task, warm, 0.0, roots, table, lanes, search)
        if reason == TABLE_TOO_SMALL:
            return more
        found.reason[row] = reason
        found.evaluations[row] += more
        if reason in (CERTIFIED, CLUSTERED) or not warm:
            break
        neighbour[0] = -1
    return 0


@compiled
def _is_finite(values):
    finite = 0
    for k in range(len(values)):
        finite += 1 if abs(values[k]) < np.inf else 0
    return finite == len(values)


@compiled
def certify_rows(force, following, guess, chain, most, task, slope, table, lanes, search, found):
    """Certify the guesses for chains that differ in axial force alone; refine those that fail.

    `most` is the largest force on every segment that the table is filled for.
    """
    unit, L, _, K0 = make_dimensionless(chain)
    pull, reach, number = L * L / K0, 0.0, guess.shape[1]
    for row in range(len(force)):
        if not (_is_finite(force[row]) and _is_finite(guess[row])):
            found.reason[row] = NOT_FINITE
            continue
        highest = 0.0
        for k in range(number):
            slope[k], found.omega2[row, k] = 0.0, guess[row, k] / unit
            highest = max(highest, abs(found.omega2[row, k]))
        outside = _take_force(force[row], pull, most, chain.force)
        _take_ends(following[row if len(following) > 1 else 0], pull, chain.following)
        follows = chain.following[0] != 0.0 or chain.following[1] != 0.0
        if outside or highest * (1.0 + task.width) > reach:
            reach = _fill_for_many(chain, highest, follows, most, table)
            if reach == 0.0:
                found.reason[row] = NOT_BRACKETED
                continue
        else:
            refill_force(chain.force, chain.starts, table)
        roots = _roots_of(row, found.omega2[row], slope, found)
        reason, more = find_all(chain, task, True, reach, roots, table, lanes, search)
        found.reason[row] = reason
        found.evaluations[row] += more
        if more > 2 * number + (LANES if follows else 0):
            reach = 0.0
        _to_si(row, unit, found)


@compiled
def _take_ends(given, pull, own):
    """Set what turns with the ends of a chain."""
    own[0], own[1] = given[0] * pull, given[1] * pull


@compiled
def _take_force(force, pull, most, own):
    """Set the axial force of a chain; tell whether it is larger than the table is filled for."""
    outside = 0
    for k in range(len(own)):
        own[k] = force[k] * pull
        outside += 1 if abs(own[k]) > most[k] else 0
    return outside > 0


@compiled
def _fill_for_many(chain, highest, follows, most, table):
    """Fill a table with some room for more force; return its reach, 0 if it does not fit."""
    reach = _REACH * (laws.beyond(chain, highest) if follows else highest)
    for k in range(len(most)):
        most[k] = max(most[k], _MORE_FORCE * abs(chain.force[k]))
    pieces = laws.count_pieces(chain, most, reach)
    if pieces < 0 or pieces > table.shape[1]:
        return 0.0
    laws.fill_table(chain, table)
    return reach
