"""The search for consecutive roots of one chain: ask, evaluate, certify; and one pass through it.

All samples of a chain are kept, and serve all roots. Eigenvalue k of those wanted has index
`below + k + 1` among all: its bracket lies between the highest sample that counts less and the
lowest that does not.
"""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import math

import numpy as np

from antinode.riccati.reasons import (
    CERTIFIED,
    NOT_BRACKETED,
    NOT_FINITE,
    OUT_OF_REACH,
    TABLE_TOO_SMALL,
)

from . import laws
from .compiling import compiled
from .prediction import certify, keep_slopes, predict, settle
from .workspace import (
    AT,
    BELOW,
    BESIDE,
    CARRIED,
    CARRIED_FROM,
    COUNT,
    FIRST,
    LANES,
    OMEGA2,
    POWER,
    SECOND,
    SHIFT,
    VALUE,
    A,
)

_MOST_PASSES = 100
_MARGIN = 0.45  # half the distance of the certifying samples, in widths
_NEXT_TO = 1e-3  # relative distance from a first guess of a second sample, where a lane is free
_FAR = 0.05  # relative likely error of a root up to which a second sample helps
_STUCK = 5  # turns
_BEYOND = 1.2  # how far beyond what is asked for the table reaches
_RESCALE = 128  # pieces after which the lanes are scaled
_SMALL = 1e-60  # of what is carried, or 1 over it: what lies between is not scaled


@compiled
def find_roots(chain, task, warm, reach, roots, table, lanes, search):
    """Bracket and certify the eigenvalues that a task names.

    `roots.omega2` holds guesses if `warm`, `roots.slope` what an earlier search left. If the table
    is filled up to some omega^2 = `reach` > 0, the guesses are taken for exact: the first samples
    are those that certify them.
    Returns the reason, and the number of samples, or that of the table's columns needed.
    """
    exact, total = warm and reach > 0.0, 0
    _forget(roots, search)
    number = _begin(chain, task, warm, exact, roots, search)
    for turn in range(_MOST_PASSES):
        if total + number > len(search.samples):
            break
        reach, pieces = _prepare(chain, number, reach, table, search)
        if pieces < 0:
            return OUT_OF_REACH, total
        if pieces > table.shape[1]:
            return TABLE_TOO_SMALL, pieces
        finite, total = _evaluate(chain, task, number, total, roots, table, lanes, search)
        if not finite:
            return NOT_FINITE, total
        _watch(turn == 0 and not warm, roots, search)
        number = _ask(task, total, roots, search)
        if number == 0:
            if task.certify:
                settle(roots, search)
            if not exact:
                keep_slopes(task.below, total, roots, search)
            reason = certify(chain, task, total, roots, search) if task.certify else CERTIFIED
            return reason, total
    return NOT_BRACKETED, total


@compiled
def _forget(roots, search):
    """Forget what was known of the roots of another chain."""
    for k in range(len(roots.omega2)):
        search.before[k], search.stuck[k] = np.inf, 0
        roots.low[k], roots.high[k] = -np.inf, np.inf
        for i in range(search.own.shape[1]):
            search.own[k, i] = -1


@compiled
def _begin(chain, task, warm, exact, roots, search):
    """Ask for the first samples; return their number."""
    asked, owner, root, wanted = search.asked, search.owner, roots.omega2, search.wanted
    for k in range(len(root)):
        search.guess[k] = root[k]
    if not warm:
        number = 2 * (max(task.below - 2, 0) + len(root)) + 3
        number = laws.first_samples(chain, number, asked)
        for i in range(number):
            owner[i] = -1
        for k in range(len(root)):
            roots.slope[k] = 0.0
        return number
    if exact:
        for k in range(len(root)):
            size = _MARGIN * task.width * abs(root[k])
            asked[2 * k], asked[2 * k + 1] = root[k] - size, root[k] + size
            owner[2 * k] = owner[2 * k + 1] = k
        return 2 * len(root)
    for k in range(len(root)):
        search.requests[k], search.certifies[k] = 1, False
        wanted[k, FIRST], wanted[k, BESIDE] = root[k], _NEXT_TO * abs(root[k])
    return _schedule(search)


@compiled
def _prepare(chain, number, reach, table, search):
    """Fill the table if it does not reach what is asked for; return its reach, and the pieces."""
    largest = 0.0
    for i in range(number):
        largest = max(largest, abs(search.asked[i]))
    if largest <= reach:
        return reach, 0
    reach = _BEYOND * largest
    return reach, laws.prepare(chain, reach, table)


@compiled
def _evaluate(chain, task, number, total, roots, table, lanes, search):
    """Evaluate what is asked for; return whether all is finite, and the number of samples."""
    own = search.own
    for first in range(0, number, LANES):
        for lane in range(LANES):
            lanes.state[OMEGA2 + lane] = search.asked[min(first + lane, number - 1)]
        pass_chain(chain, table, lanes)
        for lane in range(min(LANES, number - first)):
            if not math.isfinite(lanes.value[lane]):
                return False, total
            if chain.following[0] != 0.0 or chain.following[1] != 0.0:
                count = _rank(lanes.state[OMEGA2 + lane], lanes.value[lane], task.below, search)
                lanes.state[COUNT + lane] = count
            _take_sample(lane, task.below, total, lanes, roots, search)
            k = search.owner[first + lane]
            if k >= 0:
                own[k, 3], own[k, 2], own[k, 1] = own[k, 2], own[k, 1], own[k, 0]
                own[k, 0] = total
            total += 1
    return True, total


@compiled
def _rank(omega2, value, below, search):
    """Return how many roots lie below where ends follow: by guesses, as the sign of D has it.

    It is positive below all of them. Where guesses are an odd number off, the nearest one is.
    """
    guess, last = search.guess, 0
    while last < len(guess) and guess[last] < omega2:
        last += 1
    if (last + below) % 2 == (1 if value < 0.0 else 0):
        return last + below
    under = guess[last - 1] if last > 0 else 0.0
    over = guess[last] if last < len(guess) else np.inf
    return below + (last + 1 if over - omega2 < omega2 - under else last - 1)


@compiled
def _take_sample(lane, below, total, lanes, roots, search):
    """Keep one lane, and let it narrow the brackets."""
    sample, state, at = search.samples[total], lanes.state, search.at
    low, high, counts = roots.low, roots.high, roots.counts
    omega2, count = state[OMEGA2 + lane], int(state[COUNT + lane])
    sample[AT], sample[BELOW] = omega2, count
    sample[VALUE], sample[SHIFT] = lanes.value[lane], state[POWER + lane]
    for row in range(CARRIED):
        sample[CARRIED_FROM + row] = state[LANES * row + lane]
    for k in range(len(low)):
        if count <= below + k:
            if omega2 > low[k]:
                low[k], counts[k, 0], at[k, 0] = omega2, count, total
        elif omega2 < high[k]:
            high[k], counts[k, 1], at[k, 1] = omega2, count, total


@compiled
def _watch(centre, roots, search):
    """Notice brackets that do not halve; start roots in the middle of theirs where asked."""
    root, low, high = roots.omega2, roots.low, roots.high
    before, stuck = search.before, search.stuck
    for k in range(len(root)):
        if centre and not low[k] < root[k] < high[k]:
            if math.isinf(high[k]):
                root[k] = 2.0 * low[k]
            else:
                root[k] = high[k] / 2 if math.isinf(low[k]) else (low[k] + high[k]) / 2
        size = high[k] - low[k]
        stuck[k] = stuck[k] + 1 if size > 0.5 * before[k] else 0
        before[k] = size


@compiled
def _ask(task, total, roots, search):
    """Let every root ask for samples; return how many are taken on."""
    for k in range(len(roots.omega2)):
        search.requests[k], search.certifies[k] = _choose(k, task, total, roots, search)
    return _schedule(search)


@compiled
def _choose(k, task, total, roots, search):
    """Return how many samples root k asks for next, and whether they certify it; set them.

    No sample: it is found. The third number that is set is how far a second one may stand, or 0.
    """
    lo, hi, wanted = roots.low[k], roots.high[k], search.wanted[k]
    wanted[BESIDE] = 0.0
    bounded = math.isfinite(lo) and math.isfinite(hi)
    if bounded and hi - lo <= task.width * max(abs(lo), abs(hi)):
        return 0, False
    if bounded and search.stuck[k] >= _STUCK:
        search.stuck[k] = 0
        wanted[FIRST] = _middle(lo, hi)
        return 1, False
    guess, error = predict(k, task.below, total, roots, search)
    if not (lo < guess < hi and math.isfinite(error)):
        roots.omega2[k] = wanted[FIRST] = _middle(lo, hi)
        return 1, False
    roots.omega2[k] = guess
    size = abs(guess) * task.width
    if error > 0.1 * size:
        wanted[FIRST] = guess
        if guess + error < hi and error < _FAR * abs(guess):
            wanted[BESIDE] = error
        return 1, False
    if not task.certify and bounded:
        return 0, False
    return _enclose(guess, size, lo, hi, wanted), True


@compiled
def _enclose(guess, size, lo, hi, wanted):
    """Ask for the two samples that close the bracket, as far as they narrow it; return how many."""
    number = 0
    if lo < guess - _MARGIN * size:
        wanted[FIRST] = guess - _MARGIN * size
        number += 1
    if hi > guess + _MARGIN * size:
        wanted[SECOND if number else FIRST] = guess + _MARGIN * size
        number += 1
    if number == 2 and hi - lo < 1.05 * size:
        number = 1
    return number


@compiled
def _middle(lo, hi):
    """Return a place that halves a bracket, or goes on from its one end."""
    if math.isinf(lo):
        return hi - 4.0 * max(abs(hi), 1.0) if hi <= 1e-3 else hi / 8.0
    if math.isinf(hi):
        return 2.0 * max(lo, 1.0)
    if lo > 0.0 and hi > 2.0 * lo:
        return math.sqrt(lo * hi)
    return (lo + hi) / 2


@compiled
def _schedule(search):
    """Fill whole passes of lanes; return the number of samples.

    Searches come first, then certificates as far as lanes are free, then second samples beside
    those of the searches. Certificates alone all go at once.
    """
    number, certifies, wanted = search.requests, search.certifies, search.wanted
    asked, owner, before = search.asked, search.owner, search.before
    total, waiting, roots = 0, 0, len(number)
    for k in range(roots):
        if certifies[k]:
            waiting += number[k]
        elif number[k]:
            asked[total], owner[total] = wanted[k, FIRST], k
            total += 1
        else:
            before[k] = np.inf  # it asks for nothing: it is not stuck
    searches = total
    room = LANES * ((searches + LANES - 1) // LANES) if searches else waiting
    for k in range(roots):
        if not certifies[k]:
            continue
        if total + number[k] > room:
            before[k] = np.inf  # it has not been tried: it is not stuck
            continue
        for i in range(number[k]):
            asked[total], owner[total] = wanted[k, i], k
            total += 1
    for i in range(searches):
        k = owner[i]
        if wanted[k, BESIDE] > 0.0 and total < room:
            asked[total], owner[total] = wanted[k, FIRST] + wanted[k, BESIDE], k
            total += 1
    return total


@compiled
def _rescale(state):
    """Take a power of two out of a lane that grows large or small."""
    for lane in range(LANES):
        size = 0.0
        for row in range(CARRIED):
            size = max(size, abs(state[LANES * row + lane]))
        if _SMALL < size < 1.0 / _SMALL:
            continue
        power = math.frexp(size)[1]
        for row in range(CARRIED):
            state[LANES * row + lane] = math.ldexp(state[LANES * row + lane], -power)
        state[POWER + lane] += power


@compiled
def _stretch(law, table, lanes, first, last):
    """Carry the lanes from one point to the next; behind a held node signs are compared."""
    state, sign, held = lanes.state, lanes.sign, False
    if first == last:
        return
    for lane in range(LANES):
        held = held or sign[lane] != 0.0
    if held:
        laws.advance(law, table, state, first, first + 1)
        for lane in range(LANES):
            state[COUNT + lane] += 1.0 if sign[lane] * state[A + lane] < 0.0 else 0.0
            sign[lane] = 0.0
        first += 1
    while last - first > _RESCALE:
        laws.advance(law, table, state, first, first + _RESCALE)
        _rescale(state)
        first += _RESCALE
    laws.advance(law, table, state, first, last)
    laws.to_chain_units(law, table, last - 1, state)


@compiled
def pass_chain(chain, table, lanes):
    """Pass a chain from left to right."""
    laws.start(chain, lanes)
    carry_chain(chain, table, lanes)


@compiled
def carry_chain(chain, table, lanes):
    """Carry the lanes from the left end to the right one, whatever they start with."""
    starts, marks = chain.starts, chain.marks
    first, n = 0, len(chain.length)
    for node in range(n if len(chain.points) == 0 else 0, n + 1):
        if marks[node] < 0 and node < n:
            continue
        _stretch(chain.law, table, lanes, first, starts[node])
        first = starts[node]
        if marks[node] >= 0:
            laws.pass_point(chain.law, chain.points[marks[node]], lanes)
            _rescale(lanes.state)
    _rescale(lanes.state)
    laws.finish(chain, lanes)


@compiled
def evaluate(chain, omega2, table, lanes, count, value):
    """Evaluate a chain at any number of omega^2."""
    for first in range(0, len(omega2), LANES):
        for lane in range(LANES):
            lanes.state[OMEGA2 + lane] = omega2[min(first + lane, len(omega2) - 1)]
        pass_chain(chain, table, lanes)
        for lane in range(min(LANES, len(omega2) - first)):
            count[first + lane] = int(lanes.state[COUNT + lane])
            value[first + lane] = lanes.value[lane]


@compiled
def repeat(chain, table, lanes, last, times):
    """Pass the pieces of a chain a number of times: to be timed."""
    for _ in range(times):
        laws.start(chain, lanes)
        laws.advance(chain.law, table, lanes.state, 0, last)
