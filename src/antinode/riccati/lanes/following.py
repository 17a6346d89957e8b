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

Where that makes abs(g - 1) < 1 (`riccati.following.ratio`), g does not turn about zero: as many
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

_FIRST_SHARE = 0.125  # of all forces, for guesses
_DRAWN = 0.8  # share of the usual distance of roots below which they are drawn together
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

    Where ends follow, a search without guesses starts from a share of all forces.
    """
    kappa = chain.following
    if kappa[0] == 0.0 and kappa[1] == 0.0:
        return find_roots(chain, task, warm, reach, roots, table, lanes, search)
    total = 0
    if not warm:
        reason, more = _guess(chain, task.below, roots, table, lanes, search)
        if reason != CERTIFIED:
            return reason, more
        total += more
    reason, more = find_roots(chain, task, True, reach, roots, table, lanes, search)
    if reason == TABLE_TOO_SMALL:
        return reason, more
    total += more
    if reason != CERTIFIED or not task.certify:
        return reason, total
    if not _all_change_sign(roots, search):
        return NOT_BRACKETED, total
    reason, more = _prove(chain, task.below, roots.omega2, reach, table, lanes, search.proof)
    return reason, more if reason == TABLE_TOO_SMALL else total + more


@compiled
def _guess(chain, below, roots, table, lanes, search):
    """Set guesses: roots under shares of all forces, doubled until half of them is reached.

    The first is that of fixed directions, under so little that mostly none diverges. Shares are
    powers of two: forces come back to the last bit. Returns the reason, and the number of samples,
    or that of the table's columns needed.
    """
    kappa, rough = chain.following, Task(below, 1e-4, False)
    left, right, share, before = kappa[0], kappa[1], _FIRST_SHARE, roots.rounding
    laws.scale_force(chain, share)
    kappa[0] = kappa[1] = 0.0
    reason, total = find_roots(chain, rough, False, 0.0, roots, table, lanes, search)
    while reason == CERTIFIED and share < 1.0:
        kappa[0], kappa[1] = left * share, right * share
        reason, more = find_roots(chain, rough, True, 0.0, roots, table, lanes, search)
        total = more if reason == TABLE_TOO_SMALL else total + more
        _go_on(roots.omega2, before, share > _FIRST_SHARE)
        laws.scale_force(chain, 2.0)
        share *= 2.0
    laws.scale_force(chain, 1.0 / share)
    kappa[0], kappa[1] = left, right
    return reason, total


@compiled
def _go_on(root, before, known):
    """Let roots go on as they did when the forces were doubled before; keep them for the next."""
    rises = known
    for k in range(len(root)):
        last = root[k - 1] + 2.0 * (root[k - 1] - before[k - 1]) if k > 0 else 0.0
        rises = rises and root[k] + 2.0 * (root[k] - before[k]) > last
    for k in range(len(root)):
        now = root[k]
        if rises:
            root[k] += 2.0 * (now - before[k])
        before[k] = now


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
def _prove(chain, below, root, filled, table, lanes, proof):
    """Tell whether the roots, and so many below them, are all that lie left of a line.

    The table is filled up to `filled`. Also the samples, or the columns that the table needs.
    `proof` is set: the line, what g keeps of 1, the samples.
    """
    n = len(root)
    top = root[n - 1]
    if not (root[0] > 0.0 and top > 0.0):
        return NOT_BRACKETED, 0
    place = math.sqrt(math.sqrt(top))
    spacing = _spacing(chain, root, place)
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
    if _has_gap(number, _COUNTS, state):
        near = _nearness(chain, far, _widest(top, state))
        if near < _NEAR:
            proof[0], proof[1], proof[2] = state[OMEGA2 + 1], 1.0 - near, LANES
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
    near = _nearness(chain, far, factors)
    proof[0], proof[1], proof[2] = (low + high) / 2, 1.0 - near, 2 * LANES
    proven = _has_gap(number, 2, state) and near < _NEAR
    return (CERTIFIED if proven else NOT_BRACKETED), 2 * LANES


@compiled
def _spacing(chain, root, place):
    """Return about how far the next root is, in omega^(1/2): shear draws roots together."""
    usual, n = laws.root_spacing(chain), len(root)
    if n > 2:
        own = (place - math.sqrt(math.sqrt(root[n - 3]))) / 2
        if own < _DRAWN * usual:
            return own
    return usual


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
