r"""Ends whose force follows, compiled: real roots by changes of sign, and a proof of their number.

A plane that a following left end admits is not Lagrangian: Y^Q and theta^M differ, by a number that
no segment, mass or spring changes, sigma = Y^Q - theta^M = kappa. What travels as e is their mean,
and obeys the equations of `riccati.lanes.bending` as they stand. At a following right end

    D = M^Q + kappa theta^M,   theta^M = e - sigma/2.

Counts do not hold. A root is known by its place among guesses, and a sample by the sign of D: an
even number of roots lies below it, or an odd one. How many there are is proven by the chain with
fixed directions. Let R lie in a gap (a, b) of its eigenvalues lambda_k, all above -t. On the line
Re lambda = R, and everywhere left of it in the limit, with ``w = (lambda + t)`` for weights,

    |psi_i/Q_j|^2 <= c^2 (psi/M at i, at -t) (Y/Q at j, at -t),   c = max (x + t)/|x - R|

over x outside the gap, because every term of these sums over modes is positive at -t. Where that
makes abs(g - 1) < 1 (`riccati.following`), g does not turn about zero: as many eigenvalues lie left
of the line as with fixed directions. A sign of D tells that the rigid ones lie below the others.
"""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import math

from antinode.riccati.reasons import CERTIFIED, NOT_BRACKETED, TABLE_TOO_SMALL

from . import laws
from .compiling import compiled
from .prediction import shifted
from .search import carry_chain, find_roots
from .workspace import AT, COUNT, LANES, OMEGA2, POWER, VALUE, A, B, D, E, F, Task

_STEPS = 4  # from fixed directions to those that follow, for guesses
_NEAR = 0.97  # of abs(g - 1) that is less than 1 for certain
_COUNTS = 3  # lanes that look for a gap
"""Lanes of the proof: three counts in the gap; then at -t the fixed chain's plane, those of a unit
moment and a unit force at the left, D; and D below the lowest root that is wanted."""


@compiled
def find_all(chain, task, warm, reach, roots, table, lanes, search):
    """Find and certify the roots that a task names, as `search.find_roots` does.

    Where ends follow, a search without guesses starts from fixed directions.
    """
    kappa = chain.following
    left, right = kappa[0], kappa[1]
    if left == 0.0 and right == 0.0:
        return find_roots(chain, task, warm, reach, roots, table, lanes, search)
    total = 0
    if not warm:
        rough = Task(task.below, 1e-4, False)
        for step in range(_STEPS):
            kappa[0], kappa[1] = left * step / _STEPS, right * step / _STEPS
            reason, more = find_roots(chain, rough, step > 0, 0.0, roots, table, lanes, search)
            if reason != CERTIFIED:
                kappa[0], kappa[1] = left, right
                return reason, more if reason == TABLE_TOO_SMALL else total + more
            total += more
        kappa[0], kappa[1] = left, right
    reason, more = find_roots(chain, task, True, reach, roots, table, lanes, search)
    if reason == TABLE_TOO_SMALL:
        return reason, more
    total += more
    if reason != CERTIFIED or not task.certify:
        return reason, total
    if not _all_change_sign(roots, search):
        return NOT_BRACKETED, total
    reason, pieces = _prove(chain, task.below, roots.omega2, reach, table, lanes)
    return reason, pieces if reason == TABLE_TOO_SMALL else total + LANES


@compiled
def _all_change_sign(roots, search):
    """Tell whether D changes its sign in every bracket, and no two brackets meet."""
    samples, sure = search.samples, True
    for k in range(len(roots.omega2)):
        low, high = samples[search.at[k, 0]], samples[search.at[k, 1]]
        sure = sure and low[AT] < high[AT] and low[VALUE] * high[VALUE] < 0.0
        sure = sure and low[AT] == roots.low[k] and high[AT] == roots.high[k]
        if k > 0:
            sure = sure and roots.high[k - 1] < roots.low[k]
    return sure


@compiled
def _prove(chain, below, root, filled, table, lanes):
    """Tell whether the roots, and so many below them, are all that lie left of a line.

    The table is filled up to `filled`.
    """
    n = len(root)
    top = root[n - 1]
    if not (root[0] > 0.0 and top > 0.0):
        return NOT_BRACKETED, 0
    spacing = laws.root_spacing(chain)
    place, t = math.sqrt(math.sqrt(top)), top
    state = lanes.state
    kappa, left = chain.following, chain.following[0]
    reach = (place + spacing) ** 4
    if reach > filled:
        pieces = laws.prepare(chain, reach, table)
        if pieces < 0:
            return NOT_BRACKETED, 0
        if pieces > table.shape[1]:
            return TABLE_TOO_SMALL, pieces
    kappa[0] = 0.0
    laws.start(chain, lanes)
    kappa[0] = left
    for lane in range(_COUNTS):
        state[OMEGA2 + lane] = (place + spacing * (0.12 + 0.38 * lane)) ** 4
    for lane in range(_COUNTS, LANES):
        state[OMEGA2 + lane] = -t
    state[A + 4] = 0.0
    state[B + 4] = 1.0  # Y^M
    state[A + 5] = 0.0
    state[D + 5] = 2.0  # twice theta^Q
    state[E + 6] = state[E + 7] = left
    state[OMEGA2 + 7] = root[0] / 2
    carry_chain(chain, table, lanes)
    return (CERTIFIED if _is_proven(chain, below + n, below, t, lanes) else NOT_BRACKETED), 0


@compiled
def _is_proven(chain, number, below, t, lanes):
    """Judge the lanes of the proof."""
    state, kappa = lanes.state, chain.following
    sigma = kappa[0] if laws.keeps_sigma(chain) else 0.0
    counts_hold = True
    for lane in range(_COUNTS):
        counts_hold = counts_hold and int(state[COUNT + lane]) == number
    counts_hold = counts_hold and int(state[COUNT + 3]) == 0
    low, middle, high = state[OMEGA2], state[OMEGA2 + 1], state[OMEGA2 + 2]
    c = max((high + t) / (high - middle), (low + t) / (middle - low))
    f = abs(state[F + 3])
    right = abs(kappa[1]) * math.sqrt(2.0 * abs(state[B + 3]) * abs(state[D + 3])) / f
    shift = state[POWER + 3]
    turn = shifted(abs(state[F + 4]), state[POWER + 4] - shift) / f
    move = shifted(abs(state[F + 5]), state[POWER + 5] - shift) / f
    left = abs(kappa[0]) * math.sqrt(turn * move)
    one, other = c * left, c * right
    near = one + other + 2.0 * one * other
    even = below % 2 == 0
    first = state[F + 6] + kappa[1] * (state[E + 6] - shifted(sigma, -state[POWER + 6]))
    second = state[F + 7] + kappa[1] * (state[E + 7] - shifted(sigma, -state[POWER + 7]))
    return counts_hold and near < _NEAR and (first * second > 0.0) == even
