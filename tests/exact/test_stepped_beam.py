"""Stepped beams under stepped axial force against a 40-digit transfer of the exact solutions."""

import numpy as np
import pytest

import reference
from antinode.riccati.literal import riccati_characteristic, tmm_characteristic
from antinode.riccati.roots import find_eigenvalues
from law_chains import bending_chain

ENDS = ("free", "clamped", "pinned", "sliding")


def stepped(seed, segments, decades):
    rng = np.random.default_rng(seed)
    left, right = rng.choice(ENDS, 2)
    h = rng.uniform(0.2, 1.0, segments)
    EI = 10.0 ** rng.uniform(0, decades, segments)
    m = 10.0 ** rng.uniform(0, decades / 3, segments)
    N = rng.uniform(-1, 1, segments) * EI.min() / h.sum() ** 2 * 5
    return h, m, EI, N, str(left), str(right)


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize(("segments", "decades"), [(3, 1), (7, 3), (12, 6)])
def test_against_forty_digits(seed, segments, decades):
    h, m, EI, N, left, right = stepped(seed, segments, decades)
    chain = bending_chain(h, m, EI, N, left, right)
    exact = reference.BeamChain(tuple(h), tuple(EI), tuple(m), tuple(N), left, right)
    zeros = int({left, right} <= {"free", "sliding"})
    for value in find_eigenvalues(chain, 6, zeros=zeros):
        if value.omega2 == 0.0:
            continue
        low, high = sorted(value.bracket, key=abs)
        root = reference.chain_root(exact, min(low, high), max(low, high))
        assert float(abs(value.omega2 / root - 1)) < 1e-11


def test_mode_list_of_a_long_jumpy_chain_is_complete():
    h, m, EI, N, *_ = stepped(5, 200, 6)
    chain = bending_chain(h, m, EI, N, "clamped", "free")
    found = find_eigenvalues(chain, 10)
    assert [value.index for value in found] == list(range(1, 11))
    assert [value.counts for value in found] == [(k, k + 1) for k in range(10)]


@pytest.mark.parametrize("left", ENDS)
@pytest.mark.parametrize("right", ENDS)
def test_the_papers_characteristic_functions_change_sign_at_the_same_roots(left, right):
    h, m, EI, N, *_ = stepped(3, 6, 1)
    chain = bending_chain(h, m, EI, N, left, right)
    zeros = int({left, right} <= {"free", "sliding"})
    for value in find_eigenvalues(chain, 4, zeros=zeros):
        if value.omega2 == 0.0:
            continue
        sides = value.omega2 * np.array([1 - 1e-6, 1 + 1e-6])
        for function in (tmm_characteristic, riccati_characteristic):
            a, b = function(chain, sides)
            assert a * b < 0
