"""Uniform beams and bars against their characteristic equations at 40 digits."""

import numpy as np
import pytest

from antinode.modes.backends import choose
from law_chains import bar_chain, bending_chain
from reference import uniform_bar_roots, uniform_beam_roots

ENDS = ("free", "clamped", "pinned", "sliding")
PAIRS = [(left, right) for left in ENDS for right in ENDS]
ALLOWED = 1e-10  # of a frequency, by the issue; 1e-13 is what the method keeps


def uniform_chain(segments, left, right, N=0.0):
    one = np.ones(segments)
    return bending_chain(one / segments, one, one, N * one, left, right)


def check(chain, roots, power, allowed=1e-13, backend="numpy"):
    """Compare all eigenvalues with roots^power: values, brackets and counts."""
    zeros = sum(root == 0 for root in roots)
    found = choose(backend).find_eigenvalues(chain, len(roots), zeros=zeros)
    assert [value.omega2 for value in found[:zeros]] == [0.0] * zeros
    worst = 0.0
    for k, (value, root) in enumerate(zip(found, roots, strict=True)):
        exact = root**power
        low, high = value.bracket
        assert low <= exact <= high
        assert value.counts == ((k, k + 1) if root else (0, zeros))
        if root:
            assert high - low <= 1e-10 * exact * (1 + 1e-6)
            worst = max(worst, abs(float(value.omega2 / exact - 1)) / 2)
    assert worst <= allowed
    return worst


@pytest.mark.parametrize(("left", "right"), PAIRS)
@pytest.mark.parametrize("segments", [1, 10, 100, 1000])
def test_all_pairs_of_ends(left, right, segments):
    count = 60 if segments <= 100 else 12
    check(uniform_chain(segments, left, right), uniform_beam_roots(left, right, count), 4)


@pytest.mark.parametrize(("backend", "left"), [("numpy", "free"), ("numba", "clamped")])
def test_mode_60_of_ten_thousand_segments(backend, left):
    roots = uniform_beam_roots(left, "free", 62)
    check(uniform_chain(10_000, left, "free"), roots, 4, backend=backend)


@pytest.mark.parametrize(("left", "right"), PAIRS)
def test_ten_thousand_segments_with_any_ends(left, right):
    """By numpy, which 1,000 segments try with all ends, with like ones; by numba with all."""
    chain, roots = uniform_chain(10_000, left, right), uniform_beam_roots(left, right, 4)
    for backend in ("numba", "numpy") if left == right else ("numba",):
        check(chain, roots, 4, 1e-12, backend)


@pytest.mark.parametrize("left", ["free", "fixed"])
@pytest.mark.parametrize("right", ["free", "fixed"])
@pytest.mark.parametrize("segments", [1, 10, 1000, 10_000])
def test_bar(left, right, segments):
    count = 60 if segments <= 1000 else 6
    one = np.ones(segments)
    chain = bar_chain(one / segments, one, one, left, right)
    check(chain, uniform_bar_roots(left, right, count), 2, 1e-13 if segments < 10_000 else 1e-12)
