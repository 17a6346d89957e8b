"""Batches whose end forces follow: what compiled code proves, against one beam alone."""

import numpy as np
import pytest

import antinode as an
from antinode.modes import batch as batches

ROCKET = np.linspace(0.4, 1.0, 30)  # share of the largest thrust that N is along the axis


def free(forces, modes=6):
    """A free beam, uneven in mass and stiffness, pushed at its tail and held back at its nose."""
    x = (np.arange(30) + 0.5) / 30
    m, EI = 1 + 0.5 * np.sin(5 * x), 1 + 0.4 * np.cos(3 * x)
    N = np.asarray(forces)[:, None] * ROCKET
    ends = an.Ends("free", "free", left_follower=1.0, right_follower=1.0)
    return an.BeamBatch(np.full(30, 1 / 30), m, EI, N, ends, modes=modes)


def column(forces):
    """Beck's column: clamped, under a force that follows its tip; it flutters at 20.05 EI/L^2."""
    one = np.ones(20)
    ends = an.Ends("clamped", "free", right_follower=1.0)
    return an.BeamBatch(one / 20, one, one, np.asarray(forces)[:, None] * one, ends, modes=2)


def agree(one, other):
    assert np.array_equal(one.reason, other.reason)
    solved = np.isfinite(one.omega2)
    assert np.array_equal(solved, np.isfinite(other.omega2))
    error = (one.error_omega2 + other.error_omega2)[solved]
    assert np.all(np.abs(one.omega2 - other.omega2)[solved] <= error)


def test_hardly_a_beam_is_solved_by_itself(monkeypatch):
    alone = []
    solve = batches._alone
    monkeypatch.setattr(batches, "_alone", lambda *a: alone.append(a[2]) or solve(*a))
    forces = np.linspace(0.5, 20.0, 120)
    result = an.solve_many(free(forces))
    assert not result.reason.any()
    assert len(alone) <= 3
    some = np.arange(0, 120, 24)
    careful = an.solve_many(free(forces[some]), backend="numpy")
    error = result.error_omega2[some] + careful.error_omega2
    assert np.all(np.abs(result.omega2[some] - careful.omega2) <= error)


def sheared(forces, modes=6):
    """The same body, so thick that six modes lie far nearer to each other than without shear."""
    plain = free(forces, modes)
    m, EI = plain.mass_per_length, plain.bending_stiffness
    more = {"shear_stiffness": 500 * EI, "rotary_inertia_per_length": 1e-3 * m}
    tables = plain.length, m, EI, plain.axial_force
    return an.BeamBatch(*tables, plain.ends, modes=modes, **more)


def test_thick_beams_are_proven_together_as_well(monkeypatch):
    alone = []
    solve = batches._alone
    monkeypatch.setattr(batches, "_alone", lambda *a: alone.append(a[2]) or solve(*a))
    forces = np.linspace(0.5, 12.0, 40)
    result = an.solve_many(sheared(forces))
    assert not result.reason.any()
    assert len(alone) <= 2
    some = np.arange(0, 40, 13)
    careful = an.solve_many(sheared(forces[some]), backend="numpy")
    error = result.error_omega2[some] + careful.error_omega2
    assert np.all(np.abs(result.omega2[some] - careful.omega2) <= error)


@pytest.mark.parametrize(
    ("make", "forces"), [(column, [1, 8, 15, 19.9, 20.2, 26]), (free, [5, 20, 45])]
)
def test_nothing_is_proven_that_does_not_hold(make, forces):
    agree(an.solve_many(make(forces)), an.solve_many(make(forces), backend="numpy"))


@pytest.mark.parametrize("seed", range(6))
def test_sums_are_bounded_by_samples_in_the_gap(seed):
    """The inequality itself, on drawn poles and weights."""
    rng = np.random.default_rng(seed)
    poles = np.sort(rng.uniform(0, 10, 12)) ** 4 - 5.0
    weight = rng.exponential(size=12) ** 3
    k = int(rng.integers(2, 10))
    low, high = poles[k] + (poles[k + 1] - poles[k]) * np.array([0.33, 0.62])
    R, t = (low + high) / 2, poles[k] + 12.0
    f = [np.sum(weight / (poles - x)) for x in (-t, low, high)]
    d = (f[2] - f[1]) / (high - low)
    bound = f[0] / 2 + np.sqrt(f[0] ** 2 / 4 + (R + t) * f[0] * d)
    assert np.sum(weight / np.abs(poles - R)) <= bound
