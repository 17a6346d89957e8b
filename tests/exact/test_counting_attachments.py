"""Counts with masses, springs, supports, joints and tables against Hermite elements."""

import math

import hermite
import numpy as np
import pytest

from antinode import Beam, Ends
from antinode.beam.attachments import Joint, PointMass, Spring
from antinode.riccati.chain import count_below

ENDS = ("free", "clamped", "pinned", "sliding")
STATIONS = np.array([0.0, 0.6, 1.1, 2.0, 2.4, 3.0])


def draw(seed):
    rng = np.random.default_rng(seed)
    EI, m = 10.0 ** rng.uniform(-0.7, 0.7, 6), 10.0 ** rng.uniform(-0.5, 0.5, 6)
    N = rng.uniform(-1, 1, 6) * 10.0 ** rng.uniform(-1, 1.3) * EI.min()
    left, right = (str(end) for end in rng.choice(ENDS, 2))
    beam = Beam.from_stations(STATIONS, m, EI, None, N, ends=Ends(left, right))
    return beam.with_attachments(*(attachment(rng) for _ in range(rng.integers(1, 7))))


def attachment(rng):
    x = float(rng.choice(STATIONS))
    a, b, c = 10.0 ** rng.uniform(-1.5, 1.5, 3)
    kind = rng.integers(6)
    if kind == 3 and 0 < x < 3.0:
        return Joint(x, 0.3 * a)
    if kind == 4:
        return Spring(x, math.inf, b)
    if kind == 5:
        return Spring(x, a, math.inf)
    return [PointMass(x, a, 0.1 * b, 0.2 * (c - 1)), Spring(x, 10 * a), Spring(x, a, 10 * b)][
        min(int(kind), 2)
    ]


@pytest.mark.parametrize("seed", range(80))
def test_counts_between_the_eigenvalues(seed):
    """In the middle of every gap wider than the elements' error, below the first one too."""
    beam = draw(seed)
    values = hermite.eigenvalues(beam, 8, elements=16, shift=3000.0)
    scale = abs(values[-1])
    low, high = values[:-1], values[1:]
    wide = high - low > 1e-4 * np.maximum(np.abs(low), np.abs(high)) + 1e-5 * scale
    middle = np.where(low > 0, np.sqrt(np.abs(low * high)), (low + high) / 2)
    points = np.append(middle[wide], values[0] - 0.05 * scale)
    expected = np.append(np.arange(1, 8)[wide], 0)
    assert np.sum(wide) >= 3
    np.testing.assert_array_equal(count_below(beam.chain("bending"), points), expected)
