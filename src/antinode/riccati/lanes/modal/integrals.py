"""Integrals over modes, their largest displacement, and modes as they are given out: normalised.

`riccati.shapes.integrate_squares`, `riccati.shapes.energies` and `riccati.normalised`, compiled for
eight modes side by side.
"""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import math

from antinode.riccati.lanes.compiling import apart, compiled, wide_vectors
from antinode.riccati.lanes.workspace import (
    CENTRAL,
    COMPLIANCE,
    COUPLING,
    FIRST_MOMENT,
    FORMS_OF,
    GROUND,
    LANES,
    LOWER,
    MASS,
    PER_UNIT,
    ROTARY_INERTIA,
    SHEAR,
    SHEAR_TURN,
    SHEAR_WORK,
    SPRING,
    SPRUNG,
    SQUARES,
    TURNING,
    UNIT,
    UPPER,
)

from .segments import longest_phase, scale_columns, set_units, step, terms_for, transfer
from .shapes import set_states

_MASS, _STIFFNESS, _SIZE, _ROTARY, _SOFT, _STRAIN = range(6)
_GIVEN, _WORK, _REACH, _SUMMED = 6, 6, 7, 8
"""Rows of what is summed: as `riccati.normalised.Forms` has it, of which `_GIVEN` are given out;
the work of the axial force, and the largest displacement at nodes."""
_PEAKS, _TURNS, _NEAR = 4, 3, 1e-7
_SURE, _SHORT = 0.9, 0.5
"""The cubic of a peak in a segment of so short a phase is nearer to its height than by a tenth."""


@compiled
def _scale(states, i, k, work, here):
    """Set the states of node i in the units of the lanes; those beyond the last mode are zero."""
    for at in range(4 * LANES):
        here[at] = 0.0
    for lane in range(k):
        state = states[i, lane]
        for row in range(4):
            here[row * LANES + lane] = state[row]
    for at in range(4 * LANES):
        here[at] *= work[PER_UNIT + at]


@apart
def _add_squares(force, weight, there, work, square):
    """Add the weighted squares of Y, psi, M, V and Q."""
    for lane in range(LANES):
        Y = there[lane] * work[UNIT + lane]
        psi = there[LANES + lane] * work[UNIT + LANES + lane]
        M = there[2 * LANES + lane] * work[UNIT + 2 * LANES + lane]
        Q = there[3 * LANES + lane] * work[UNIT + 3 * LANES + lane]
        V = Q - force * psi
        square[lane] += weight * (Y * Y)
        square[LANES + lane] += weight * (psi * psi)
        square[2 * LANES + lane] += weight * (M * M)
        square[3 * LANES + lane] += weight * (V * V)
        square[4 * LANES + lane] += weight * (Q * Q)


@compiled
def _set_squares(chain, states, shares, weights, terms, room):
    """Integrate the squares of states over every segment, by Gauss points and exact states.

    Points lie in pairs on either side of the middle, and one matrix leads to both.
    """
    work, own, k = room.work, room.own, states.shape[1]
    middle = room.frame[0]
    for i in range(len(chain.length)):
        h, square, column = chain.length[i], room.squares[i], own.columns[i]
        EI, alpha, force = own.stiffness[i], own.coupling[i], chain.force[i]
        _scale(states, i, k, work, room.here)
        for j in range(SQUARES):
            square[j] = 0.0
        transfer(h / 2.0, EI, alpha, column, terms, work, room.step)
        step(room.step, 1.0, room.here, middle)
        if len(shares) % 2 == 1:
            _add_squares(force, weights[len(shares) // 2] * h, middle, work, square)
        for p in range(len(shares) // 2):
            transfer(h * (0.5 - shares[p]), EI, alpha, column, terms, work, room.step)
            step(room.step, -1.0, middle, room.there)
            _add_squares(force, weights[p] * h, room.there, work, square)
            step(room.step, 1.0, middle, room.there)
            _add_squares(force, weights[p] * h, room.there, work, square)


@compiled
def _through(states, i, distance, terms, room):
    """Set the states of all modes at a distance into a segment, in SI, rows of lanes."""
    work, own, there = room.work, room.own, room.there
    _scale(states, i, states.shape[1], work, room.here)
    transfer(
        *(distance, own.stiffness[i], own.coupling[i]),
        *(own.columns[i], terms, work, room.step),
    )
    step(room.step, 1.0, room.here, there)
    for k in range(4 * LANES):
        there[k] *= work[UNIT + k]


@compiled
def _prepare(chain, omega2, phase, room):
    """Set the columns in the units of the lanes; return the terms of the series."""
    EI0 = set_units(chain, omega2, room.work)
    scale_columns(chain, omega2, EI0, room.work, room.own)
    return terms_for(phase)


@compiled
def _rule(phase, rules):
    """Return which rule of Gauss does for squares of states over so much of a wave."""
    which = 0
    while which < len(rules.limits) - 1 and not phase < rules.limits[which]:
        which += 1
    return which


@compiled
def integrate(chain, omega2, states, rules, longest, room):
    """Set the integrals of squares in the room; tell whether no segment is too long for that."""
    phase = longest_phase(chain, omega2)
    if phase <= longest:
        _integrate(chain, omega2, states, rules, phase, room)
    return phase <= longest


@compiled
def _integrate(chain, omega2, states, rules, phase, room):
    """Set the integrals of squares, given the largest phase of a segment."""
    wide_vectors()
    terms, which = _prepare(chain, omega2, phase / 2.0, room), _rule(phase, rules)
    number = rules.numbers[which]
    shares, weights = rules.shares[which, :number], rules.weights[which, :number]
    _set_squares(chain, states, shares, weights, terms, room)


@compiled
def _point_energies(marks, points, omega2, states, work):
    """Add the points' shares: `riccati.points.lateral_energies`."""
    last = len(states) - 1
    for i in range(len(states)):
        if marks[i] < 0:
            continue
        p = points[marks[i]]
        arm = p[FIRST_MOMENT] / p[MASS] if p[MASS] != 0.0 else 0.0
        for lane in range(states.shape[1]):
            Y, turn, M = states[i, lane, 0], states[i, lane, 1], states[i, lane, 2]
            if i < last:
                turn -= p[COMPLIANCE] * M
            moved, k = Y + arm * turn, FORMS_OF + lane
            work[k + _MASS * LANES] += p[MASS] * moved * moved + p[CENTRAL] * turn * turn
            springs = p[SPRING] * Y * Y + 2.0 * p[COUPLING] * Y * turn + p[TURNING] * turn * turn
            elastic = springs + p[COMPLIANCE] * M * M
            if p[SPRUNG] != 0.0:
                x = p[UPPER] * Y / (p[UPPER] + p[LOWER] - omega2[lane] * p[SPRUNG])
                work[k + _MASS * LANES] += p[SPRUNG] * x * x
                elastic += p[UPPER] * (Y - x) * (Y - x) + p[LOWER] * x * x
            work[k + _STIFFNESS * LANES] += elastic
            reach = p[SPRING] * abs(Y) * work[k + _REACH * LANES]
            work[k + _SIZE * LANES] += abs(elastic) + reach


@compiled
def _sum_up(chain, omega2, states, beside, room):
    """Set the quadratic forms of modes from the squares: `Lateral.forms`, points included.

    `beside` holds rho I and 1/kGA that are left out, whose energies are summed too.
    """
    wide_vectors()
    work, f = room.work, FORMS_OF
    for k in range(_SUMMED * LANES):
        work[f + k] = 0.0
    for i in range(len(chain.length)):
        m, flexible, force = chain.mass[i], 1.0 / chain.stiffness[i], chain.force[i]
        square = room.squares[i]
        s, rotary, ground = 0.0, 0.0, 0.0
        if chain.more.shape[1] > 0:
            s, rotary = chain.more[SHEAR, i], chain.more[ROTARY_INERTIA, i]
            ground, force = chain.more[GROUND, i], force + chain.more[SHEAR_WORK, i]
        of_turn, of_shear, size = beside[0, i], beside[1, i], abs(force)
        for lane in range(LANES):
            Y, psi, M = square[lane], square[LANES + lane], square[2 * LANES + lane]
            V, Q = square[3 * LANES + lane], square[4 * LANES + lane]
            bent = flexible * M
            strain = bent + s * Q + ground * Y
            work[f + _MASS * LANES + lane] += m * Y + rotary * psi
            work[f + _STIFFNESS * LANES + lane] += strain
            work[f + _SIZE * LANES + lane] += strain + size * psi
            work[f + _ROTARY * LANES + lane] += of_turn * psi
            work[f + _SOFT * LANES + lane] += of_shear * V
            work[f + _STRAIN * LANES + lane] += bent
            work[f + _WORK * LANES + lane] += force * psi
    for i in range(len(states)):
        for lane in range(states.shape[1]):
            k = f + _REACH * LANES + lane
            work[k] = max(work[k], abs(states[i, lane, 0]))
    if len(chain.points) > 0:
        _point_energies(chain.marks, chain.points, omega2, states, work)
    for lane in range(LANES):
        work[f + _STIFFNESS * LANES + lane] -= work[f + _WORK * LANES + lane]


@compiled
def _slope(more, i, psi, Q):
    """Return Y' = alpha psi - s Q."""
    if more.shape[1] == 0:
        return psi
    return (1.0 + more[SHEAR_TURN, i]) * psi - more[SHEAR, i] * Q


@compiled
def _cubic_peak(Y, s, after, t):
    """Return where a cubic between two displacements peaks, and how high.

    Slopes of different signs, times the length of the segment.
    """
    rise = after - Y
    b, a = 3.0 * rise - 2.0 * s - t, s + t - 2.0 * rise
    root = b + math.copysign(math.sqrt(max(b * b - 3.0 * a * s, 0.0)), b)
    x = -s / root
    if not 0.0 < x < 1.0:
        x = -root / (3.0 * a)
    if not 0.0 < x < 1.0:
        x = 0.0
    return x, abs(Y + x * (s + x * (b + x * a)))


@compiled
def _height(h, more, states, i, lane, place, terms, room):
    """Return the displacement of a peak near a place of a segment: secants improve the place."""
    z, height, before = room.there, 0.0, 0.0
    slope = _slope(more, i, states[i, lane, 1], states[i, lane, 3])
    for _ in range(_TURNS):
        _through(states, i, h * place, terms, room)
        height = max(height, abs(z[lane]))
        here = _slope(more, i, z[LANES + lane], z[3 * LANES + lane])
        change = here - slope
        if change == 0.0:
            break
        following = min(max(place - here * (place - before) / change, 0.0), 1.0)
        near = abs(following - place) < _NEAR
        before, slope, place = place, here, following
        if near:
            break
    return height


@compiled
def _keep_highest(most, height, place, i):
    """Put a peak among the highest ones of a mode: its height, place and segment."""
    k = _PEAKS - 1
    if height > most[k, 0]:
        while k > 0 and height > most[k - 1, 0]:
            for column in range(3):
                most[k, column] = most[k - 1, column]
            k -= 1
        most[k, 0], most[k, 1], most[k, 2] = height, place, float(i)


@compiled
def _find_peaks(length, marks, more, states, terms, room):
    """Set the largest displacement at nodes, on either side of them, and the highest peaks."""
    largest, z = room.largest, room.there
    for lane in range(states.shape[1]):
        largest[lane] = abs(states[len(length), lane, 0])
        for k in range(_PEAKS):
            room.peaks[lane, k, 0] = 0.0
    for i in range(len(length)):
        h, beside = length[i], marks[i + 1] >= 0
        if beside:
            _through(states, i, h, terms, room)
        for lane in range(states.shape[1]):
            here, there = states[i, lane], states[i + 1, lane]
            Y, after, psi, Q = here[0], there[0], there[1], there[3]
            if beside:
                after, psi, Q = z[lane], z[LANES + lane], z[3 * LANES + lane]
            largest[lane] = max(largest[lane], abs(Y), abs(after))
            s, t = _slope(more, i, here[1], here[3]) * h, _slope(more, i, psi, Q) * h
            if s * t < 0.0:
                place, height = _cubic_peak(Y, s, after, t)
                _keep_highest(room.peaks[lane], height, place, i)


@compiled
def _largest(length, more, states, lane, sure, terms, room):
    """Return the largest displacement of a mode: `riccati.normalised.largest_displacements`.

    A peak is not computed whose cubic is less than a share `sure` of what is known.
    """
    largest, most = room.largest[lane], room.peaks[lane]
    for k in range(_PEAKS):
        if most[k, 0] > sure * largest:
            i = int(most[k, 2])
            height = _height(length[i], more, states, i, lane, most[k, 1], terms, room)
            largest = max(largest, height)
    return largest


@compiled
def _sign(states, lane, largest):
    """Return the sign of the first local maximum of abs(Y), ends included."""
    n = len(states)
    for i in range(n):
        size = abs(states[i, lane, 0])
        rises = i == 0 or size >= abs(states[i - 1, lane, 0])
        falls = i == n - 1 or size >= abs(states[i + 1, lane, 0])
        if size > 1e-3 * largest and rises and falls:
            return 1.0 if states[i, lane, 0] >= 0.0 else -1.0
    return 1.0 if states[0, lane, 0] >= 0.0 else -1.0


@compiled
def _give(length, states, places, terms, room, grid):
    """Set the states at places; where one is doubled, that of its left side first."""
    node, at, middle = 0, 0.0, length[0] / 2.0
    for p in range(len(places)):
        while node < len(length) and middle < places[p]:
            at += length[node]
            node += 1
            if node < len(length):
                middle = at + length[node] / 2.0
        doubled = p + 1 < len(places) and places[p + 1] == places[p]
        if doubled:
            _through(states, node - 1, length[node - 1], terms, room)
        for lane in range(states.shape[1]):
            given, here = grid[lane, p], states[node, lane]
            for row in range(4):
                given[row] = room.there[row * LANES + lane] if doubled else here[row]


@compiled
def _take(work, sums, sign):
    """Add the forms that were summed up, less where the sign says so; sizes always."""
    for lane in range(sums.shape[1]):
        for row in range(_GIVEN):
            value = work[FORMS_OF + row * LANES + lane]
            sums[row, lane] += value if row == _SIZE else sign * value


@compiled
def _turning_ends(following, pair, sums):
    """Add what following ends do to the stiffness, and quarter all: `energies_between`."""
    last = pair.shape[1] - 1
    for lane in range(sums.shape[1]):
        for row in range(_GIVEN):
            sums[row, lane] /= 4.0
        for side in range(2):
            i = 0 if side == 0 else last
            plus, minus = pair[0, i, lane], pair[1, i, lane]
            turn = following[side] * (plus[1] + minus[1]) * (plus[0] - minus[0]) / 4.0
            sums[_STIFFNESS, lane] += turn if side == 1 else -turn


@compiled
def _set_forms(chain, omega2, states, pair, beside, rules, phase, room, sums):
    """Set the forms of modes: between right and left ones where their sum and difference stand."""
    for row in range(_GIVEN):
        for lane in range(sums.shape[1]):
            sums[row, lane] = 0.0
    for which in range(max(len(pair), 1)):
        given = pair[which] if len(pair) > 0 else states
        _integrate(chain, omega2, given, rules, phase, room)
        _sum_up(chain, omega2, given, beside, room)
        _take(room.work, sums, 1.0 if which == 0 else -1.0)
    if len(pair) > 0:
        _turning_ends(chain.following, pair, sums)
    elif len(chain.points) > 0:  # what springs and joints store is strain, too
        for lane in range(sums.shape[1]):
            of_force = room.work[FORMS_OF + _WORK * LANES + lane]
            sums[_STRAIN, lane] = sums[_STIFFNESS, lane] + of_force


@compiled
def normalise(chain, omega2, states, pair, asked, rules, longest, room, sums, grid):
    """Scale modes as `riccati.normalised.normalise` does; tell whether no segment is too long."""
    wide_vectors()
    phase = longest_phase(chain, omega2)
    if not phase <= longest:
        return False
    _set_forms(chain, omega2, states, pair, asked.beside, rules, phase, room, sums)
    terms, sure = terms_for(phase), _SURE if phase < _SHORT else 0.0
    _find_peaks(chain.length, chain.marks, chain.more, states, terms, room)
    for lane in range(states.shape[1]):
        largest = _largest(chain.length, chain.more, states, lane, sure, terms, room)
        size = math.sqrt(abs(sums[_MASS, lane])) if asked.by_mass else largest
        room.factor[lane] = _sign(states, lane, largest) / size
        for row in range(_GIVEN):
            sums[row, lane] *= room.factor[lane] * room.factor[lane]
    for i in range(len(states)):
        for lane in range(states.shape[1]):
            state, factor = states[i, lane], room.factor[lane]
            for row in range(4):
                state[row] *= factor
    _give(chain.length, states, asked.places, terms, room, grid)
    return True


@compiled
def _set_motions(length, motion, states):
    """Set the states of modes that move as a + b x, x from the left end: a and b, or NaN."""
    for lane in range(len(motion)):
        a, b, x = motion[lane, 0], motion[lane, 1], 0.0
        if a != a:
            continue
        for i in range(len(states)):
            state = states[i, lane]
            state[0], state[1], state[2], state[3] = a + b * x, b, 0.0, 0.0
            if i < len(length):
                x += length[i]


@compiled
def _is_finite(states):
    """Tell whether all states are numbers."""
    total = 0.0
    for i in range(len(states)):
        for lane in range(states.shape[1]):
            for row in range(4):
                total += 0.0 * states[i, lane, row]
    return total == 0.0


@compiled
def solve_modes(chain, omega2, motion, no_pair, asked, rules, longest, room, states, sums, grid):
    """Set the states of modes that are apart, and scale them: `set_states` and `normalise`.

    Those whose motion is given are not solved. Tells whether that could be done.
    """
    if not set_states(chain, omega2, False, longest, room, states):
        return False
    _set_motions(chain.length, motion, states)
    if not _is_finite(states):
        return False
    return normalise(chain, omega2, states, no_pair, asked, rules, longest, room, sums, grid)
