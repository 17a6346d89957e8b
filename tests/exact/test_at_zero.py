"""Elastic modes beside the rigid one at omega^2 = 0: a translating beam just at buckling."""

import mpmath
import numpy as np
import pytest

import antinode as an

SLIDING = an.Ends("sliding", "sliding")


def true_omega2(k, N):
    """Of mode k of a sliding beam of EI = m = L = 1, in 40 digits, with N as the double is."""
    with mpmath.workdps(40):
        b = k * mpmath.pi
        return b**4 - mpmath.mpf(N) * b**2


@pytest.mark.parametrize("k", [2, 3, 5])
@pytest.mark.parametrize("off", [0.0, 2e-16, -1e-15, 1e-12])
def test_rounding_is_stated_where_a_mode_meets_the_translation(k, off):
    N = float((k * np.pi) ** 2 * (1 + off))
    beam = an.Beam.from_stations([0, 1], 1.0, 1.0, None, N, ends=SLIDING)
    mode = an.solve_modes(beam, k + 1, backend="numpy").mode("bending", k)
    one = an.natural_frequencies(beam, k + 1)
    row = an.BeamBatch(np.full(4, 0.25), np.ones(4), np.ones(4), np.full(4, N), SLIDING, k + 1)
    many = an.solve_many(row)
    found = [
        (mode.omega2, mode.error_omega2),
        (one.omega2[k - 1], one.error_omega2[k - 1]),
        (many.omega2[0, k - 1], many.error_omega2[0, k - 1]),
    ]
    for omega2, error in found:
        assert abs(omega2 - true_omega2(k, N)) <= error < 1e-6
