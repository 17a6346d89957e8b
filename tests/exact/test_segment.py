"""One segment's transfer matrix against the matrix exponential at 40 digits."""

import mpmath
import numpy as np
import pytest

from antinode.riccati.segment import lateral_transfer, wave_number, wave_transfer


def exponential(A, h):
    with mpmath.workdps(40):
        return np.array(mpmath.expm(mpmath.matrix(A.tolist()) * h).tolist(), dtype=float)


@pytest.mark.parametrize("N", [-30.0, -1.0, 0.0, 1e-9, 1.0, 30.0])
@pytest.mark.parametrize("inertia", [-50.0, -1e-8, 0.0, 1e-8, 3.0, 50.0, -(30.0**2) / 4 / 7.0])
@pytest.mark.parametrize("phase", [1e-3, 0.3, 1.5])
def test_bending(N, inertia, phase):
    """Every sign of N and omega^2, coincident roots (the last inertia at N = +-30) included."""
    EI = 7.0
    h = phase / max(float(wave_number(np.array(N / EI), np.array(inertia / EI))), 1e-3)
    A = np.array([[0, 1, 0, 0], [0, 0, 1 / EI, 0], [0, -N, 0, 1], [inertia, 0, 0, 0]], dtype=float)
    U = lateral_transfer(*map(np.array, (h, EI, N, inertia)))
    np.testing.assert_allclose(U, exponential(A, h), rtol=1e-13, atol=1e-300)


@pytest.mark.parametrize("inertia", [-50.0, 0.0, 1e-8, 50.0])
def test_longitudinal(inertia):
    EA, h = 30.0, 0.9
    A = np.array([[0, -1 / EA], [inertia, 0]])
    U = wave_transfer(*map(np.array, (h, EA, inertia)), -1.0)
    np.testing.assert_allclose(U, exponential(A, h), rtol=1e-13, atol=1e-300)


def test_determinant_and_symplectic_form():
    U = lateral_transfer(*map(np.array, (0.3, 7.0, 4.0, 20.0)))
    J = np.zeros((4, 4))
    J[0, 3], J[3, 0], J[1, 2], J[2, 1] = -1, 1, 1, -1
    np.testing.assert_allclose(U.T @ J @ U, J, atol=1e-14)
