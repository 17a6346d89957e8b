r"""Ends whose force follows, compiled: real roots by changes of sign, and a proof of their number.

A plane that a following left end admits is not Lagrangian: Y^Q and theta^M differ, by a number that
no segment, mass or spring changes, sigma = Y^Q - theta^M = kappa. What travels as e is their mean,
and obeys the equations of `riccati.lanes.bending` as they stand. At a following right end

    D = M^Q + kappa theta^M,   theta^M = e - sigma/2.

Counts do not hold. A root is known by its place among guesses, and a sample by the sign of D: an
even number of roots lies below it, or an odd one. How many there are is proven by the chain with
fixed directions. Let R lie in a gap (a, b) of its eigenvalues lambda_k, all above -t. On the line
Re lambda = R ``|psi_i/Q_j|^2 <= P(psi_i) P(Y_j)``, where P sums over the modes what each adds to a
receptance, over abs(lambda_k - R). With f the receptance (psi/M or Y/Q) at -t, where every term is
positive,

    P <= c f,   c = max (x + t)/abs(x - R)   over x outside the gap,

and where that is too coarse, from two more samples in the gap, at R - h and R + h: all terms of
their divided difference d are positive too, and at least those of the sum over (lambda_k - R)^2.
By Cauchy and Schwarz ``P^2 <= f (S d + P)``, S = R + t, so that

    P <= f/2 + sqrt(f^2/4 + S f d).

Where that makes abs(g - 1) < 1 (`riccati.following`), g does not turn about zero: as many
eigenvalues lie left of the line as with fixed directions. A sign of D tells that the rigid ones lie
below the others.
"""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import math

import numpy as np

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
_INSIDE = 0.33, 0.62
"""Places of two samples in the gap, in spacings. Lanes: the fixed chain's plane at both, those of a
unit moment, and those of a unit force at the left."""


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
    reason, more = _prove(chain, task.below, roots.omega2, reach, table, lanes)
    return reason, more if reason == TABLE_TOO_SMALL else total + more


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

    The table is filled up to `filled`. Also the samples, or the columns that the table needs.
    """
    n = len(root)
    top = root[n - 1]
    if not (root[0] > 0.0 and top > 0.0):
        return NOT_BRACKETED, 0
    spacing = laws.root_spacing(chain)
    place = math.sqrt(math.sqrt(top))
    state, number = lanes.state, below + n
    reach = (place + spacing) ** 4
    if reach > filled:
        pieces = laws.prepare(chain, reach, table)
        if pieces < 0:
            return NOT_BRACKETED, 0
        if pieces > table.shape[1]:
            return TABLE_TOO_SMALL, pieces
    _start_fixed(chain, lanes)
    for lane in range(_COUNTS):
        state[OMEGA2 + lane] = (place + spacing * (0.12 + 0.38 * lane)) ** 4
    for lane in range(_COUNTS, LANES):
        state[OMEGA2 + lane] = -top
    _apply_moment(4, state)
    _apply_force(5, state)
    state[E + 6] = state[E + 7] = chain.following[0]
    state[OMEGA2 + 7] = root[0] / 2
    carry_chain(chain, table, lanes)
    if int(state[COUNT + 3]) != 0 or not _are_below(chain, below, lanes):
        return NOT_BRACKETED, LANES
    far = _receptances(3, 4, 5, state)
    if _has_gap(number, _COUNTS, state) and _nearness(chain, far, _widest(top, state)) < _NEAR:
        return CERTIFIED, LANES
    _start_fixed(chain, lanes)
    for lane in range(LANES):
        state[OMEGA2 + lane] = (place + spacing * _INSIDE[lane % 2]) ** 4
    low, high = state[OMEGA2], state[OMEGA2 + 1]
    for lane in range(2):
        _apply_moment(2 + lane, state)
        _apply_force(4 + lane, state)
    carry_chain(chain, table, lanes)
    total = (low + high) / 2 + top
    one, other = _receptances(0, 2, 4, state), _receptances(1, 3, 5, state)
    factors = (
        _factor(far[0], (other[0] - one[0]) / (high - low), total),
        _factor(far[1], (other[1] - one[1]) / (high - low), total),
        _factor(far[2], (other[2] - one[2]) / (high - low), total),
        _factor(far[3], (other[3] - one[3]) / (high - low), total),
    )
    proven = _has_gap(number, 2, state) and _nearness(chain, far, factors) < _NEAR
    return (CERTIFIED if proven else NOT_BRACKETED), 2 * LANES


@compiled
def _start_fixed(chain, lanes):
    """Set what the left end admits with fixed directions."""
    kappa, left = chain.following, chain.following[0]
    kappa[0] = 0.0
    laws.start(chain, lanes)
    kappa[0] = left


@compiled
def _apply_moment(lane, state):
    """Set the plane of a free left end to Y^M."""
    state[A + lane], state[B + lane] = 0.0, 1.0


@compiled
def _apply_force(lane, state):
    """Set the plane of a free left end to theta^Q."""
    state[A + lane], state[D + lane] = 0.0, 2.0


@compiled
def _are_below(chain, below, lanes):
    """Tell whether the rigid eigenvalues lie below the others, by the signs of D."""
    state, kappa = lanes.state, chain.following
    sigma = kappa[0] if laws.keeps_sigma(chain) else 0.0
    first = state[F + 6] + kappa[1] * (state[E + 6] - shifted(sigma, -state[POWER + 6]))
    second = state[F + 7] + kappa[1] * (state[E + 7] - shifted(sigma, -state[POWER + 7]))
    return (first * second > 0.0) == (below % 2 == 0)


@compiled
def _has_gap(number, lanes, state):
    """Tell whether the first lanes all count one number."""
    same = True
    for lane in range(lanes):
        same = same and int(state[COUNT + lane]) == number
    return same


@compiled
def _receptances(plane, moment, force, state):
    """Return psi/M and Y/Q of the left end, then of the right one, each up to its own sign."""
    f, power = state[F + plane], state[POWER + plane]
    turn = shifted(state[F + moment], state[POWER + moment] - power) / f
    move = shifted(state[F + force], state[POWER + force] - power) / f
    return turn, move, state[D + plane] / f, 2.0 * state[B + plane] / f


@compiled
def _widest(t, state):
    """Return c, from the gap alone, for every receptance."""
    low, middle, high = state[OMEGA2], state[OMEGA2 + 1], state[OMEGA2 + 2]
    c = max((high + t) / (high - middle), (low + t) / (middle - low))
    return c, c, c, c


@compiled
def _factor(far, difference, total):
    """Return P/f from the divided difference in the gap."""
    share = total * difference / far
    return 0.5 + math.sqrt(0.25 + share) if share >= 0.0 else np.inf


@compiled
def _nearness(chain, far, factors):
    """Return a bound on abs(g - 1) from receptances at -t, and what P is in their units."""
    kappa, left, right = chain.following, 0.0, 0.0
    if kappa[0] != 0.0:
        left = abs(kappa[0]) * math.sqrt(abs(far[0] * far[1]) * factors[0] * factors[1])
    if kappa[1] != 0.0:
        right = abs(kappa[1]) * math.sqrt(abs(far[2] * far[3]) * factors[2] * factors[3])
    return left + right + 2.0 * left * right
