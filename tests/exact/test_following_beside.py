"""Eigenvalues under other end forces, side by side, against each choice solved by itself."""

from dataclasses import replace

import numpy as np
import pytest

import antinode as an
from antinode.modes.backends import choose
from antinode.modes.following import eigenvalues_alone
from antinode.riccati.following.beside import neighbours

CHOICES = np.array([[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [0.4, 0.7]])


def free_beam(seed, load):
    """A free stepped beam; N runs from a drag at its nose to a thrust at its tail."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(3, 12))
    x = np.concatenate([[0.0], np.cumsum(rng.uniform(0.3, 1.0, n))])
    m, EI = (np.exp(rng.uniform(-0.7, 0.7, n)) for _ in range(2))
    thrust = load * np.mean(EI) / x[-1] ** 2
    N = thrust * np.linspace(rng.uniform(0.2, 0.9), 1.0, n)
    more = {}
    if seed % 2:
        more = {"shear_stiffness": 200 * EI, "rotary_inertia_per_length": 0.01 * m}
    return an.Beam(x, m, EI, axial_force=N, interpolation="step", **more)


@pytest.mark.parametrize("seed", range(12))
def test_every_choice_is_what_it_is_by_itself(seed):
    beam = free_beam(seed, load=[1.0, 4.0, 8.0][seed % 3])
    chain, backend = beam.chain("bending"), choose("numba")
    forces = CHOICES * beam.end_forces
    alone = [_alone(backend, chain, ends) for ends in forces]
    known = alone[seed % 4]
    found = neighbours(chain, forces, known, 2, 1e-9)
    enclosed = 0
    for one, exact in zip(found, alone, strict=True):
        if one.eigenvalues:
            values = np.array([v.omega2 for v in one.eigenvalues])
            assert values == pytest.approx(exact, rel=2e-9)
            assert one.proven
            enclosed += 1
    assert enclosed >= 3


def _alone(backend, chain, ends):
    own = replace(chain, following=tuple(ends))
    values = eigenvalues_alone(backend, own, 7, 1, 1e-11, 2)
    return np.array(sorted(v.omega2 for v in values if v.omega2)[1:6])


def test_what_is_not_next_to_the_known_is_left_open_or_unproven():
    """Where one known eigenvalue is left out, another choice has one more than it may have."""
    chain = free_beam(3, load=4.0).chain("bending")
    backend, forces = choose("numba"), CHOICES * free_beam(3, load=4.0).end_forces
    known = _alone(backend, chain, forces[0])
    for left_out in range(4):
        found = neighbours(chain, forces, np.delete(known, left_out), 2, 1e-9)
        assert not any(one.proven for one in found)
