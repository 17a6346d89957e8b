"""A seeded tenth of validation/counting_lateral.py: counts of random beams with all columns."""

import numpy as np
import pytest
from validation.counting_lateral import compare


@pytest.mark.parametrize("block", range(4))
def test_counts_are_those_of_60_digits(block):
    for seed in range(25 * block, 25 * block + 25):
        compared, wrong = compare(np.random.default_rng([16, seed]))
        assert compared > 0
        assert not wrong, seed
