"""The beams that are timed, and the rules of a fair time."""

import statistics
import time

import numpy as np

LENGTH = 6.0
SEGMENTS = 100
MODES = 6
DASHPOTS = (1.8, 200.0), (LENGTH, 500.0)
"""Of damped beams: x [m] and c [N s/m]."""


def smooth_case(rng, beams, spread=0.1, segments=SEGMENTS):
    """Free-free beams of uniform segments: m, EI and N different in every one, shape (beams, n).

    m and EI follow a course of their own and a log-linear one between 8 control points drawn with
    the given spread (standard deviation of the logarithm); N rises along the beam, 20 to 100 % of
    13 to 50 kN.
    """
    s = (np.arange(segments) + 0.5) / segments
    knots = np.linspace(0, 1, 8)

    def drawn():
        draws = spread * rng.standard_normal((beams, 8))
        return np.exp(np.array([np.interp(s, knots, row) for row in draws]))

    m = 330 * np.exp(-4 * (s - 0.45) ** 2) * drawn()
    EI = 4e5 * np.exp(-3 * (s - 0.3) ** 2) * drawn()
    N = (13e3 + 37e3 * s) * rng.uniform(0.2, 1.0, (beams, 1))
    return np.full(segments, LENGTH / segments), m, EI, N


def stepped_beam(segments):
    """One beam of the kind above as `antinode.Beam`."""
    import antinode as an

    x = np.linspace(0.0, LENGTH, segments + 1)
    _, m, EI, N = smooth_case(np.random.default_rng(0), 1, 0.0, segments)
    return an.Beam.from_stations(x, m[0], EI[0], None, N[0])


def damped_beam(seed):
    """A clamped beam without N that carries dashpots, m and EI different in every segment."""
    import antinode as an

    _, m, EI, _ = smooth_case(np.random.default_rng(seed), 1)
    x = np.linspace(0.0, LENGTH, SEGMENTS + 1)
    beam = an.Beam.from_stations(x, m[0], EI[0], ends=an.Ends("clamped"))
    return beam.with_attachments(*(an.Dashpot(at, translational=c) for at, c in DASHPOTS))


def steep_stations(seed):
    """A steep smooth beam: x, m, EI and N at ten stations, log-linear between them."""
    rng, x = np.random.default_rng(seed), np.linspace(0.0, LENGTH, 10)
    s = x / LENGTH
    m = 330 * np.exp(-4 * (s - 0.45) ** 2 + 0.3 * rng.standard_normal(10))
    EI = 4e5 * np.exp(-3 * (s - 0.3) ** 2 + 0.3 * rng.standard_normal(10))
    return x, m, EI, 10e3 + 20e3 * s


def medians(repeats, *calls):
    """Median time of each call [s]; they take turns, so that a busy machine slows all alike."""
    taken = [[] for _ in calls]
    for call in calls:
        call()
    for _ in range(repeats):
        for times, call in zip(taken, calls, strict=True):
            start = time.perf_counter()
            call()
            times.append(time.perf_counter() - start)
    return [statistics.median(times) for times in taken]
