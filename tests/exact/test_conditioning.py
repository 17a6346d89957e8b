"""Problems that amplify rounding: the reported error covers the true one, the bracket the root.

Near buckling, with jumps of 1e6 in stiffness, and on 10,000 segments, against eigenvalues in many
digits (reference.py) of the numbers exactly as the solver receives them.
"""

from itertools import pairwise

import mpmath
import numpy as np
import pytest

import antinode as an
import reference
from antinode.beam.ends import Ends

MODES = 4


def _exact_chain(x, m, EI, N, ends):
    h = [mpmath.mpf(b) - mpmath.mpf(a) for a, b in pairwise(x)]
    columns = (tuple(map(float, column)) for column in (EI, m, N))
    return reference.BeamChain(tuple(h), *columns, *ends)


def _beam(x, m, EI, N, ends):
    m, EI, N = (np.repeat(np.asarray(v, float)[:, None], 2, axis=1) for v in (m, EI, N))
    return an.Beam(np.asarray(x, float), m, EI, axial_force=N, ends=Ends(*ends))


def _check(result, chain):
    """Every root lies in its bracket and within its error, which is small; the worst distance."""
    modes = sorted(result.modes, key=lambda mode: mode.bracket_omega2)[:MODES]
    assert len(modes) == MODES
    worst = 0.0
    for k, mode in enumerate(modes, start=1):
        if mode.omega2 == 0.0:
            continue
        root = reference.eigenvalue(chain, k)
        low, high = mode.bracket_omega2
        assert low <= root <= high, mode.name
        assert abs(mode.omega2 - root) <= mode.error_omega2 <= 1e-8 * abs(root), mode.name
        worst = max(worst, float(abs(mode.omega2 / root - 1)))
    return worst


def _check_batch(x, m, EI, N, ends, chain):
    """The same of `solve_many`, for a batch of one."""
    h, m, EI, N = (np.asarray(values, float) for values in (np.diff(x), m, EI, N))
    result = an.solve_many(an.BeamBatch(h, m, EI, N, Ends(*ends), MODES - 1))
    for k, index in enumerate(result.counts[0, :, 1]):
        root = reference.eigenvalue(chain, int(index))
        low, high = result.bracket_omega2[0, k]
        assert low <= root <= high
        assert abs(result.omega2[0, k] - root) <= result.error_omega2[0, k] <= 1e-8 * abs(root)


def _at_buckling(x, m, EI, pattern, ends):
    """The load factor at which the lowest eigenvalue vanishes, by bisecting proven counts."""
    chain = _exact_chain(x, m, EI, pattern, ends)
    low, high = 0.0, 1.0
    barely = -1e-14 * reference.scale(chain)
    while not reference.count_below(chain.scaled(high), barely):
        low, high = high, 4 * high
    while high - low > 1e-10 * high:
        middle = (low + high) / 2
        below = reference.count_below(chain.scaled(middle), barely)
        low, high = (low, middle) if below else (middle, high)
    return high


BUCKLING = {
    "uniform column": ([0.0, 3.0], [7.0], [2.0], [1.0], ("clamped", "free")),
    "stepped strut": (
        [0.0, 0.7, 1.1, 2.9, 4.0], [3.0, 11.0, 2.0, 5.0], [9.0, 40.0, 6.0, 25.0],
        [1.0, 0.8, 1.3, 1.1], ("pinned", "clamped"),
    ),
    "soft piece": ([0.0, 1.0, 1.01, 2.0], [1.0] * 3, [1e3, 1e-1, 1e3], [1.0] * 3,
                   ("clamped", "pinned")),
}  # fmt: skip


@pytest.mark.parametrize("name", BUCKLING)
@pytest.mark.parametrize("share", [0.99, 0.99999, 1.00001])
def test_near_buckling(name, share):
    x, m, EI, pattern, ends = BUCKLING[name]
    N = [share * _at_buckling(x, m, EI, pattern, ends) * n for n in pattern]
    result = an.solve_modes(_beam(x, m, EI, N, ends), MODES)
    chain = _exact_chain(x, m, EI, N, ends)
    assert (result.modes[0].omega2 > 0) == (share < 1)
    assert _check(result, chain) < 1e-9
    _check_batch(x, m, EI, N, ends, chain)


@pytest.mark.parametrize("ends", [("free", "free"), ("clamped", "free"), ("pinned", "sliding")])
@pytest.mark.parametrize("seed", range(3))
def test_jumps_of_1e6_in_stiffness(seed, ends):
    rng = np.random.default_rng(seed)
    x = np.concatenate([[0.0], np.cumsum(rng.uniform(0.1, 1.0, 12))])
    EI = 10.0 ** (6.0 * (np.arange(12) % 2)) * rng.uniform(1, 3, 12)
    m = rng.uniform(1, 10, 12)
    N = rng.uniform(-1, 0.2, 12) / x[-1] ** 2
    result = an.solve_modes(_beam(x, m, EI, N, ends), MODES)
    chain = _exact_chain(x, m, EI, N, ends)
    assert _check(result, chain) < 1e-9
    _check_batch(x, m, EI, N, ends, chain)


@pytest.mark.parametrize("ends", [("free", "free"), ("clamped", "free")])
@pytest.mark.parametrize("decades", [0, 1, 6])
def test_ten_thousand_segments(decades, ends):
    rng = np.random.default_rng(10 + decades)
    coarse = np.concatenate([[0.0], np.cumsum(rng.uniform(0.5, 1.0, 20))])
    m, EI = rng.uniform(1, 5, 20), 10.0 ** rng.uniform(0, decades, 20) if decades else np.ones(20)
    N = rng.uniform(-0.5, 0.5, 20) * EI.min() / coarse[-1] ** 2
    pieces = [np.linspace(a, b, 500, endpoint=False) for a, b in pairwise(coarse)]
    x = np.concatenate([*pieces, coarse[-1:]])
    fine = [np.repeat(values, 500) for values in (m, EI, N)]
    result = an.solve_modes(_beam(x, *fine, ends), MODES)
    assert result.segments["bending"] == 10_000
    chain = _exact_chain(coarse, m, EI, N, ends)
    assert _check(result, chain) < 1e-9
    _check_batch(x, *fine, ends, chain)
