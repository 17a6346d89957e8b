"""A seeded tenth of validation/complex_modes.py: dense elements, and 40 digits."""

import numpy as np
import pytest
from damped_beams import compared, random_beam


@pytest.mark.parametrize("seed", range(5000, 5030))
def test_none_missing_and_none_too_many(seed):
    missing, spurious, over, far, proven = compared(random_beam(np.random.default_rng(seed)))
    assert (missing, spurious, proven) == (0, 0, True)
    assert over <= 1
    assert far < 1e-9
