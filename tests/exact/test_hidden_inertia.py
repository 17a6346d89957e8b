"""Heavy masses off their nodes, whose own inertia the lever hides: against 50 digits.

One mass at the tip stands in `test_attachments.py`; here between two segments under tension, two
whose offsets balance, one without any inertia of its own, and one on a beam of Timoshenko.
State [Y, psi, M, Q]; a mass m, whose centre lies d to the right, with inertia I about it, adds
omega^2 m (Y + d psi) to Q and takes omega^2 (m d (Y + d psi) + I psi) from M.
"""

from itertools import pairwise

import mpmath as mp
import pytest

from antinode import Beam, Ends, natural_frequencies, solve_modes
from antinode.beam.attachments import PointMass

WITH_SHEAR = {"shear_stiffness": 100.0, "rotary_inertia_per_length": 0.01}
CASES = {
    "between two segments": ([0.0, 0.4, 1.0], -5.0, {}, [(0.4, 1e9, -0.2, 1e-3)]),
    "two that balance": ([0.0, 1.0], 0.0, {}, [(1.0, 5e8, 0.3, 1e-3), (1.0, 5e8, -0.3, 1e-3)]),
    "without inertia": ([0.0, 1.0], 1.0, {}, [(1.0, 1e9, 0.3, 0.0)]),
    "Timoshenko": ([0.0, 1.0], 1.0, WITH_SHEAR, [(1.0, 1e6, 0.3, 1e-4)]),
}


def segment(h, N, omega2, shear_stiffness=None, rotary_inertia_per_length=0.0):
    """Transfer matrix of a length with m = EI = 1, by Haringx."""
    s = 1 / mp.mpf(shear_stiffness) if shear_stiffness else mp.mpf(0)
    alpha = 1 + N * s
    beta = alpha * N + mp.mpf(rotary_inertia_per_length) * omega2
    A = mp.matrix([[0, alpha, 0, -s], [0, 0, 1, 0], [0, -beta, 0, alpha], [omega2, 0, 0, 0]])
    return mp.expm(A * h)


def masses(items, omega2):
    J = mp.eye(4)
    for m, d, inertia in items:
        J[3, 0] += omega2 * m
        J[3, 1] += omega2 * m * d
        J[2, 0] -= omega2 * m * d
        J[2, 1] -= omega2 * (m * d * d + inertia)
    return J


def determinant(x, N, columns, items, omega2):
    """Zero at the eigenvalues of the beam, clamped on its left and free on its right."""
    T = mp.eye(4)
    for a, b in pairwise(x):
        T = segment(mp.mpf(b) - mp.mpf(a), N, omega2, **columns) * T
        here = [tuple(map(mp.mpf, item[1:])) for item in items if item[0] == b]
        T = masses(here, omega2) * T
    return T[2, 2] * T[3, 3] - T[2, 3] * T[3, 2]


def true_frequency(case, near):
    """Frequency of the eigenvalue beside one that was found."""
    with mp.workdps(50):
        start = mp.mpf(near) * (1 + mp.mpf(10) ** -9), mp.mpf(near) * (1 - mp.mpf(10) ** -9)
        options = {"solver": "secant", "tol": mp.mpf(10) ** -40, "verify": False}
        root = mp.findroot(lambda w: determinant(*case, w), start, **options)
        assert abs(root / near - 1) < 1e-6
        return mp.sqrt(root) / (2 * mp.pi)


@pytest.mark.parametrize("backend", ["numpy", "numba"])
@pytest.mark.parametrize("name", CASES)
def test_the_stated_error_holds(name, backend):
    x, N, columns, items = CASES[name]
    beam = Beam.from_stations(x, 1.0, 1.0, None, N, ends=Ends(left="clamped"), **columns)
    beam = beam.with_attachments(*(PointMass(a, m, J, offset=d) for a, m, d, J in items))
    found = solve_modes(beam, 3, families=["bending"], backend=backend).modes
    alone = natural_frequencies(beam, 3, backend=backend)
    for mode, f, error in zip(found, alone.frequencies_hz, alone.error_hz, strict=True):
        true = true_frequency(CASES[name], mode.omega2)
        assert abs(mode.frequency_hz - true) <= mode.error_hz <= 1e-9 * max(1.0, true)
        assert abs(f - true) <= error
