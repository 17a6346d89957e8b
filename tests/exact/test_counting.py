"""Counts on random chains against the independent reference (record: validation/counting.md)."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from validation.counting import judge_kept, mismatches, run, wanting

from antinode.riccati.chain import count_below
from chains import draw_case, kept_case
from law_chains import bending_chain
from reference import BeamChain, certain_count

ENDS = st.sampled_from(["free", "clamped", "pinned", "sliding"])


def test_a_tenth_of_the_record():
    """100 seeded cases: none skipped, a quarter each steep, near buckling, long."""
    verdicts = run(2026, 100, jobs=1, judge=judge_kept)
    assert mismatches(verdicts) == []
    assert wanting(verdicts) == []


@pytest.mark.parametrize(("seed", "index"), [(2026, 6), (2026, 37), (2026, 81), (515, 24)])
def test_kept_cases_are_those_that_are_drawn(seed, index):
    kept, drawn = kept_case(seed, index), draw_case(seed, index)
    assert (kept.chain.left, kept.chain.right) == (drawn.chain.left, drawn.chain.right)
    for name in ("h", "EI", "m", "N"):
        assert getattr(kept.chain, name) == pytest.approx(getattr(drawn.chain, name), rel=1e-12)
    assert (kept.target, kept.negative) == (drawn.target, drawn.negative)
    assert kept.omega2 == pytest.approx(drawn.omega2, rel=1e-9)
    assert kept.room == pytest.approx(drawn.room, rel=1e-6)
    assert kept.load_factor == pytest.approx(drawn.load_factor, nan_ok=True)


@settings(max_examples=60, deadline=None, derandomize=True)
@given(
    st.lists(
        st.tuples(st.floats(0.05, 2.0), st.floats(-3, 3), st.floats(-1, 1), st.floats(-20.0, 20.0)),
        min_size=1,
        max_size=12,
    ),
    ENDS,
    ENDS,
    st.floats(-2, 5),
    st.booleans(),
)
def test_small_chains_of_any_kind(rows, left, right, exponent, negative):
    h, logs, mass, force = (np.array(column) for column in zip(*rows, strict=True))
    EI, m = 10.0**logs, 10.0**mass
    N = force * float(np.median(EI)) / float(np.sum(h)) ** 2
    omega2 = (-1 if negative else 1) * 10.0**exponent * float(np.median(EI / m)) / h.sum() ** 4
    reference = certain_count(BeamChain(*map(tuple, (h, EI, m, N)), left, right), omega2)
    assert count_below(bending_chain(h, m, EI, N, left, right), [omega2])[0] == reference.count


@pytest.mark.parametrize("omega2", [-1e30, 1e30])
def test_a_hopeless_omega2_is_refused(omega2):
    one = np.ones(3)
    with pytest.raises(FloatingPointError, match="out of reach"):
        count_below(bending_chain(one, one, one * 1e-9, one), [omega2])
