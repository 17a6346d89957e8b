"""Beams that vary inside intervals: steps halved each time, until extrapolated results agree.

Each step of an interval is two uniform half-segments whose 1/EI, m and N are averages of the values
at its two Gauss points with weights 1/2 +- sqrt(3)/3, the larger for the nearer point: what
`Beam.chain` makes.
"""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import math

from antinode.riccati import convergence
from antinode.riccati.reasons import (
    CERTIFIED,
    CHAIN_TOO_SMALL,
    NOT_CONVERGED,
    TABLE_TOO_SMALL,
    TOO_MANY_STEPS,
)

from . import laws
from .compiling import compiled
from .following import find_all
from .workspace import (
    CENTRAL,
    COMPLIANCE,
    COUPLING,
    FIRST_MOMENT,
    HOLDS_THETA,
    HOLDS_Y,
    LOWER,
    MASS,
    MOST_LEVELS,
    PHASE,
    ROTARY,
    SIZE,
    SPRING,
    SPRUNG,
    START,
    STEEP,
    TURNING,
    UPPER,
    Chain,
    Task,
)

GAUSS = 0.5 - math.sqrt(3) / 6
NEAR = 0.5 + math.sqrt(3) / 3

_COARSE = 1e-8  # relative width of chains that only tell how omega^2 changes
_LEAST = 1e-9  # omega^2, dimensionless, that is as good as zero


@compiled
def _at(a, b, t, log):
    if t == 0.0:
        return a
    if t == 1.0:
        return b
    return a * math.exp(math.log(b / a) * t) if log else a + (b - a) * t


@compiled
def _gauss_values(a, b, start, step, log):
    """Return a property at the two Gauss points of the first of equal steps of an interval.

    And what it grows by from one step to the next, or is multiplied by.
    """
    if not log:
        first, second = start + step * GAUSS, start + step * (1.0 - GAUSS)
        return a + (b - a) * first, a + (b - a) * second, (b - a) * step
    if a == b:
        return a, a, 1.0
    rate = math.log(b / a)
    near, times = math.exp(rate * step * GAUSS), math.exp(rate * step)
    first = a * math.exp(rate * start) * near
    return first, first * (times / (near * near)), times


@compiled
def _mass_until(a, b, h, t, log):
    """Return the mass of the first part of an interval: a share t of its length h."""
    if not log:
        return h * t * (a + (b - a) * t / 2)
    rate = math.log(b / a) * t
    return h * t * a * (math.expm1(rate) / rate if abs(rate) > 1e-12 else 1.0)


@compiled
def mark_varying(beam, acceleration):
    """Set which intervals something varies in; return whether it does anywhere."""
    m, EI, N, anywhere = beam.mass, beam.stiffness, beam.force, False
    for k in range(len(m)):
        same = m[k, 0] == m[k, 1] and EI[k, 0] == EI[k, 1] and N[k, 0] == N[k, 1]
        beam.varies[k] = 0 if same and acceleration == 0.0 else 1
        anywhere = anywhere or beam.varies[k] == 1
    return anywhere


@compiled
def coarsest_steps(beam, interior):
    """Halve steps in which something varies until none is steep or long; return their number."""
    x, interval, steps, number = beam.x, beam.interval, beam.steps, len(beam.mass)
    for k in range(number):
        interval[k], steps[START, k], steps[SIZE, k] = k, 0.0, 1.0
    for _ in range(interior.halvings):
        total = 0.0
        for i in range(number):
            k = interval[i]
            steps[STEEP, i], wave = _steepness(beam, i, interior.logarithmic)
            steps[PHASE, i] = math.sqrt(wave) * (x[k + 1] - x[k]) * steps[SIZE, i]
            total += steps[PHASE, i]
        more = 0
        for i in range(number):
            long = steps[PHASE, i] > interior.longest * total
            coarse = steps[STEEP, i] > interior.steepest or long
            steps[STEEP, i] = 1.0 if coarse and beam.varies[interval[i]] else 0.0
            more += int(steps[STEEP, i])
        if more == 0 or number + more > len(interval):
            return number if more == 0 else -1
        _halve(interval, steps, number, more)
        number += more
    return number


@compiled
def _steepness(beam, i, log):
    """Return the largest ratio over a step, and sqrt(m/EI) in it."""
    m, EI, k, left = beam.mass, beam.stiffness, beam.interval[i], beam.steps[START, i]
    right = left + beam.steps[SIZE, i]
    ma, mb = _at(m[k, 0], m[k, 1], left, log), _at(m[k, 0], m[k, 1], right, log)
    sa, sb = _at(EI[k, 0], EI[k, 1], left, log), _at(EI[k, 0], EI[k, 1], right, log)
    steepest = max(ma / mb, mb / ma, sa / sb, sb / sa)
    return steepest, math.sqrt(math.sqrt(ma * mb) / math.sqrt(sa * sb))


@compiled
def _halve(interval, steps, number, more):
    """Halve the steps that are marked, from the last one on, in place."""
    to = number + more - 1
    for i in range(number - 1, -1, -1):
        k, left, whole = interval[i], steps[START, i], steps[SIZE, i]
        if steps[STEEP, i] == 1.0:
            interval[to], steps[START, to], steps[SIZE, to] = k, left + whole / 2, whole / 2
            interval[to - 1], steps[START, to - 1], steps[SIZE, to - 1] = k, left, whole / 2
            to -= 2
        else:
            interval[to], steps[START, to], steps[SIZE, to] = k, left, whole
            to -= 1


@compiled
def make_halves(beam, interior, number, refinement):
    """Set h, m, EI and N of all segments, and the first of every interval; return their number."""
    x, size, own, i, last = beam.x, beam.steps[SIZE], beam.chain, 0, -1
    for s in range(number):
        k = beam.interval[s]
        h = x[k + 1] - x[k]
        if k != last:
            beam.first[k], last = i, k
        if beam.varies[k]:
            _make_step(beam, interior, s, i, refinement)
            i += 2 * refinement
        else:
            own.length[i], own.mass[i] = h * size[s], beam.mass[k, 0]
            own.stiffness[i], own.force[i] = beam.stiffness[k, 0], beam.force[k, 0]
            i += 1
    beam.first[len(beam.mass)] = i
    return i


@compiled
def _make_step(beam, interior, s, i, refinement):
    """Set the segments of one step, from segment i on."""
    m, EI, N, log = beam.mass, beam.stiffness, beam.force, interior.logarithmic
    k, acceleration, own = beam.interval[s], interior.acceleration, beam.chain
    h, start = beam.x[k + 1] - beam.x[k], beam.steps[START, s]
    step = beam.steps[SIZE, s] / refinement
    m1, m2, dm = _gauss_values(m[k, 0], m[k, 1], start, step, log)
    s1, s2, ds = _gauss_values(EI[k, 0], EI[k, 1], start, step, log)
    for r in range(refinement):
        t1, t2 = start + step * (r + GAUSS), start + step * (r + 1.0 - GAUSS)
        if r > 0:
            m1, m2 = (m1 * dm, m2 * dm) if log else (m1 + dm, m2 + dm)
            s1, s2 = (s1 * ds, s2 * ds) if log else (s1 + ds, s2 + ds)
        f1, f2 = 1.0 / s1, 1.0 / s2
        n1, n2 = _at(N[k, 0], N[k, 1], t1, False), _at(N[k, 0], N[k, 1], t2, False)
        if acceleration != 0.0:
            n1 += acceleration * (beam.mass_left[k] + _mass_until(m[k, 0], m[k, 1], h, t1, log))
            n2 += acceleration * (beam.mass_left[k] + _mass_until(m[k, 0], m[k, 1], h, t2, log))
        for half in range(2):
            w = NEAR if half == 0 else 1.0 - NEAR
            own.length[i], own.mass[i] = h * step / 2, w * m1 + (1.0 - w) * m2
            own.stiffness[i] = 1.0 / (w * f1 + (1.0 - w) * f2)
            own.force[i] = w * n1 + (1.0 - w) * n2
            i += 1


_extrapolate, _within = compiled(convergence.extrapolate), compiled(convergence.within)


@compiled
def _layer_length(beam):
    """Return the largest N h^2/EI of the segments of what varies: of layers, in segments."""
    chain, longest = beam.chain, 0.0
    for k in range(len(beam.varies)):
        if beam.varies[k]:
            for i in range(beam.first[k], beam.first[k + 1]):
                pull = abs(chain.force[i]) * chain.length[i] * chain.length[i]
                longest = max(longest, pull / chain.stiffness[i])
    return longest


@compiled
def _units_of(beam):
    """Return length, mean mass per length and mean EI of a beam."""
    m, EI, n = beam.mass, beam.stiffness, len(beam.mass)
    L, m0, EI0 = beam.x[n] - beam.x[0], 0.0, 0.0
    for k in range(n):
        m0, EI0 = m0 + (m[k, 0] + m[k, 1]) / (2 * n), EI0 + (EI[k, 0] + EI[k, 1]) / (2 * n)
    return L, m0, EI0


@compiled
def _scale_points(nodes, L, m0, EI0):
    """Make points dimensionless."""
    mass, spring = m0 * L, EI0 / (L * L * L)
    for k in range(len(nodes.at)):
        point, scaled = nodes.points[k], nodes.scaled[k]
        scaled[MASS] = point[MASS] / mass
        scaled[FIRST_MOMENT] = point[FIRST_MOMENT] / (mass * L)
        scaled[ROTARY] = point[ROTARY] / (mass * L * L)
        scaled[CENTRAL] = point[CENTRAL] / (mass * L * L)
        scaled[SPRING] = point[SPRING] / spring
        scaled[TURNING] = point[TURNING] / (spring * L * L)
        scaled[COUPLING] = point[COUPLING] / (spring * L)
        scaled[SPRUNG] = point[SPRUNG] / mass
        scaled[UPPER], scaled[LOWER] = point[UPPER] / spring, point[LOWER] / spring
        scaled[HOLDS_Y], scaled[HOLDS_THETA] = point[HOLDS_Y], point[HOLDS_THETA]
        scaled[COMPLIANCE] = point[COMPLIANCE] / (L / EI0)


@compiled
def _to_chain(n, interior, nodes, beam, L, m0, EI0):
    """Return the first n segments of a beam as a chain: dimensionless, nodes of points marked."""
    own = beam.chain
    for i in range(n):
        own.length[i], own.mass[i] = own.length[i] / L, own.mass[i] / m0
        own.stiffness[i], own.force[i] = own.stiffness[i] / EI0, own.force[i] * (L * L / EI0)
    for i in range(n + 1):
        own.marks[i] = -1
    for i in range(len(nodes.at)):
        own.marks[beam.first[nodes.at[i]]] = i
    own.following[0] = interior.kappa_left * (L * L / EI0)
    own.following[1] = interior.kappa_right * (L * L / EI0)
    return Chain(
        own.law,
        interior.left,
        interior.right,
        own.length[:n],
        own.mass[:n],
        own.stiffness[:n],
        own.force[:n],
        own.starts[: n + 1],
        own.marks[: n + 1],
        nodes.scaled,
        own.more,
        own.following,
    )


@compiled
def _report(unit, beam):
    """Set results in SI; the error is that of the segments, and the way to the bracket's end."""
    better, roots, bracket = beam.better, beam.roots, beam.bracket
    for k in range(len(better)):
        below, above = roots.low[k] - roots.rounding[k], roots.high[k] + roots.rounding[k]
        inside = min(max(better[k], below), above)
        beam.omega2[k] = unit * better[k]
        beam.error_omega2[k] = unit * (beam.error[k] + max(above - inside, inside - below))
        bracket[k, 0], bracket[k, 1] = unit * below, unit * above


@compiled
def _solve_level(chain, task, warm, beam):
    """Find the roots of a chain, without guesses if they lead nowhere."""
    total = 0
    while True:
        reason, more = find_all(
            chain, task, warm, 0.0, beam.roots, beam.table, beam.lanes, beam.search
        )
        if reason == TABLE_TOO_SMALL:
            return reason, more
        total += more
        if reason == CERTIFIED or not warm:
            return reason, total
        warm = False


@compiled
def _count_segments(beam, number, refinement):
    """Return how many segments the steps make."""
    total = 0
    for i in range(number):
        total += 2 * refinement if beam.varies[beam.interval[i]] else 1
    return total


@compiled
def _keep_level(level, beam):
    """Keep the roots of a level, and guess those of the next."""
    root, levels = beam.roots.omega2, beam.levels
    for k in range(len(root)):
        levels[level, k] = root[k]
        beam.better[k], beam.error[k] = root[k], 0.0
        if level > 0:
            root[k] += (root[k] - levels[level - 1, k]) / 16


@compiled
def solve_levels(beam, interior, nodes, below, refinement, tolerance, width):
    """Solve a beam with steps halved each time, until two extrapolated results agree.

    Returns the reason, the number of segments of the finest chain and that of evaluations; or what
    is too small, and the size it needs.
    """
    L, m0, EI0 = _units_of(beam)
    _scale_points(nodes, L, m0, EI0)
    varying = mark_varying(beam, interior.acceleration)
    number = coarsest_steps(beam, interior)
    if number < 0:
        return TOO_MANY_STEPS, 0, 0
    coarse = max(width, min(_COARSE, tolerance / 100))
    total = 0
    for k in range(len(beam.better)):
        beam.roots.omega2[k] = 0.0
    for level in range(MOST_LEVELS):
        size = _count_segments(beam, number, refinement)
        if size > len(beam.chain.length):
            return CHAIN_TOO_SMALL, size, 0
        n = make_halves(beam, interior, number, refinement)
        chain = _to_chain(n, interior, nodes, beam, L, m0, EI0)
        last = level > 1 or not varying
        task = Task(below, width if last else coarse, last)
        reason, more = _solve_level(chain, task, level > 0, beam)
        if reason == TABLE_TOO_SMALL:
            return reason, more, 0
        total += more
        if reason != CERTIFIED:
            return reason, n, total
        _keep_level(level, beam)
        done = not varying
        if level > 1:
            layer = _layer_length(beam)
            _extrapolate(beam.levels, level, coarse, layer, beam.better, beam.error)
            done = _within(beam.better, beam.error, tolerance, _LEAST)
        if done:
            _report(laws.omega2_unit(chain.law, L, m0, EI0), beam)
            return CERTIFIED, n, total
        refinement *= 2
    return NOT_CONVERGED, 0, total
