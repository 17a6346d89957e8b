"""Shock response spectra: how far their largest values may be off, and what is refused."""

import numpy as np
import pytest

from antinode.errors import InputError
from antinode.response.shock import _spectrum, srs


@pytest.mark.parametrize("ratio", [0.0, 0.05, 0.6, 0.99])
def test_maxima_between_points_have_an_error_that_holds(ratio):
    """A record of straight lines, and the same with 300 points on each line."""
    draw = np.random.default_rng(7)
    for length in (4, 30):
        t, a = np.linspace(0, 0.3, length), draw.normal(size=length)
        fine = np.linspace(0, 0.3, 300 * (length - 1) + 1)
        f = np.geomspace(1, 1000, 9)
        found, off = _spectrum(t, a, f, ratio)
        exact = srs(fine, np.interp(fine, t, a), f, ratio)
        assert np.all(np.abs(found - exact) <= off)
        assert np.all(off <= 0.01 * exact)


def test_a_record_of_no_numbers_has_no_spectrum():
    with pytest.raises(InputError, match="must be a finite number"):
        srs([0, 0.1, 0.2], [0, np.nan, 0], [1.0])
