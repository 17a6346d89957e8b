"""Uniform beams under a constant axial force: the cases whose frequencies are exact to Bokaian."""

import math

import numpy as np
import pytest

import antinode as an
from literature.published import omegas

EXACT = {
    ("pinned", "pinned"): lambda n: n,
    ("sliding", "sliding"): lambda n: n,
    ("sliding", "pinned"): lambda n: n - 0.5,
}


@pytest.mark.parametrize("force", [-30.0, -2.0, 1.0, 2.3])
@pytest.mark.parametrize("ends", EXACT)
def test_bokaian_1988_1990(ends, force):
    """A. Bokaian, Natural frequencies of beams under compressive axial loads, Journal of Sound and
    Vibration 126 (1988) 49-65, and under tensile axial loads, 142 (1990) 481-498: for these ends
    omega_n = omega_n0 sqrt(1 - N/N_n), N_n the n-th buckling load. N as part of EI/L^2.
    """
    beam = an.Beam.from_stations([0.0, 1.0], 1.0, 1.0, None, force, ends=an.Ends(*ends))
    k = np.array([EXACT[ends](n) for n in range(1, 7)]) * math.pi
    np.testing.assert_allclose(omegas(beam, 6), k**2 * np.sqrt(1 - force / k**2), rtol=1e-11)
