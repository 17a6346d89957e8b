"""Mode shapes: orthogonality, Rayleigh quotient, node counts, equilibrium, conventions."""

import numpy as np
import pytest
from modes_tools import chain_matrices

from antinode import Beam, Ends, solve_modes

ENDS = ("free", "clamped", "pinned", "sliding")


def random_beam(seed, segments=12, decades=2.0, ends=("free", "free"), load=3.0):
    rng = np.random.default_rng(seed)
    x = np.concatenate([[0.0], np.cumsum(rng.uniform(0.3, 1.0, segments))])
    EI = 10.0 ** rng.uniform(0, decades, segments + 1)
    m = 10.0 ** rng.uniform(0, decades / 2, segments + 1)
    N = rng.uniform(-0.3, 1, segments + 1) * load * EI.min() / x[-1] ** 2
    return Beam.from_stations(x, m, EI, 1e3 * EI, N, ends=Ends(*ends))


def off_diagonal(matrix, diagonal):
    size = np.sqrt(np.abs(np.outer(diagonal, diagonal)))
    return np.max(np.abs(matrix - np.diag(np.diag(matrix))) / size)


@pytest.mark.parametrize("left", ENDS)
@pytest.mark.parametrize("right", ENDS)
@pytest.mark.parametrize("decades", [1.0, 6.0])
def test_orthogonality_and_rayleigh_quotient(left, right, decades):
    result = solve_modes(random_beam(7, decades=decades, ends=(left, right)), 8)
    omega2 = np.array([m.omega2 for m in result.family("bending")])
    mass, stiffness = chain_matrices(result)
    scale = np.diag(mass)
    highest = np.abs(omega2).max()
    assert off_diagonal(mass, scale) < 1e-8
    assert off_diagonal(stiffness, scale * highest) < 1e-8
    np.testing.assert_allclose(np.diag(stiffness) / scale, omega2, rtol=1e-9, atol=1e-12 * highest)


@pytest.mark.parametrize("left", ["free", "clamped", "pinned"])
def test_longitudinal_orthogonality(left):
    result = solve_modes(random_beam(3, ends=(left, "free")), 8)
    omega2 = np.array([m.omega2 for m in result.family("longitudinal")])
    mass, stiffness = chain_matrices(result, "longitudinal")
    assert off_diagonal(mass, np.diag(mass)) < 1e-8
    quotient = np.diag(stiffness) / np.diag(mass)
    np.testing.assert_allclose(quotient, omega2, rtol=1e-9, atol=1e-12 * omega2.max())


@pytest.mark.parametrize("seed", range(5))
def test_node_counts_of_free_beams(seed):
    """Elastic mode n of a free-free beam in little compression has n + 1 nodes."""
    result = solve_modes(random_beam(seed, load=0.5), 6)
    for mode in result.family("bending"):
        if mode.number:
            crossings = np.sum(mode.shape[:-1] * mode.shape[1:] < 0)
            assert crossings == mode.number + 1
    for mode in result.family("longitudinal"):
        assert np.sum(mode.shape[:-1] * mode.shape[1:] < 0) == mode.number


def test_conventions_of_scale_and_sign():
    beam = random_beam(1)
    for mode in solve_modes(beam, 6).modes:
        assert 0.998 < np.max(np.abs(mode.shape)) <= 1.0 + 1e-12  # the peak lies between places
        assert mode.shape[0] > 0  # a free end is the first extremum from the nose
    clamped = solve_modes(random_beam(1, ends=("clamped", "free")), 6)
    for mode in clamped.family("bending"):
        rising = np.flatnonzero(np.diff(np.abs(mode.shape)) < 0)
        first = rising[0] if len(rising) else -1
        assert mode.shape[first] > 0


def test_unit_modal_mass():
    result = solve_modes(random_beam(2), 4, normalisation="mass")
    mass, _ = chain_matrices(result)
    np.testing.assert_allclose(np.diag(mass), 1.0, rtol=1e-10)
    assert all(mode.modal_mass == pytest.approx(1.0) for mode in result.modes)


@pytest.mark.parametrize("left", ENDS)
@pytest.mark.parametrize("right", ENDS)
def test_internal_forces_satisfy_the_ends_and_the_field_equations(left, right):
    beam = random_beam(11, ends=(left, right))
    result = solve_modes(beam, 5)
    zero = {"free": (2, 3), "clamped": (0, 1), "pinned": (0, 2), "sliding": (1, 3)}
    z = result.at(beam.x[[0, -1]])
    size = np.max(np.abs(result.at(result.x)), axis=0)
    for side, end in enumerate((left, right)):
        for component in zero[end]:
            relative = np.abs(z[side, :, component]) / np.maximum(size[:, component], 1e-300)
            assert np.all((relative < 1e-9) | (size[:, component] == 0))
    x, h = 0.37 * beam.length, 1e-4 * beam.length
    (before, here, after), omega2 = result.at([x - h, x, x + h]), [m.omega2 for m in result.modes]
    slope = (after - before) / (2 * h)
    k = int(np.searchsorted(beam.x, x)) - 1
    m, EI, N = (t[k, 0] for t in (beam.mass_per_length, beam.bending_stiffness, beam.axial_force))
    Y, theta, M, Q = here.T
    w2 = np.array(omega2[: len(Y)])
    for derivative, exact in zip(slope.T, (theta, M / EI, Q - N * theta, m * w2 * Y), strict=True):
        np.testing.assert_allclose(derivative, exact, rtol=1e-5, atol=1e-5 * np.abs(exact).max())


def test_a_cluster_gives_independent_modes():
    """Two equal cantilevers joined by a limp beam vibrate in pairs closer than rounding parts."""
    x = np.array([0.0, 1.0, 4.0, 5.0])
    one = np.ones(4)
    beam = Beam.from_stations(
        x, [1, 1e-14, 1, 1], [1, 1e-12, 1, 1], None, ends=Ends("clamped", "clamped")
    )
    alone = Beam.from_stations(x[:2], one[:2], one[:2], ends=Ends("clamped", "free"))
    single = solve_modes(alone, 2)
    result = solve_modes(beam, 6)
    for mode in single.modes:
        pair = [m for m in result.modes if abs(m.omega2 / mode.omega2 - 1) < 1e-6]
        assert len(pair) >= 2
    mass, _ = chain_matrices(result)
    values = np.linalg.eigvalsh(mass / np.sqrt(np.outer(np.diag(mass), np.diag(mass))))
    assert values.min() > 1e-3


def test_a_mode_at_the_far_end_is_not_lost():
    """A stiff first part and a limp last one: the growing solution would swamp equation 81."""
    beam = Beam.from_stations(
        [0.0, 30.0, 31.0], [1, 1, 1], [1.0, 1e-4, 1], None, ends=Ends("clamped", "free")
    )
    result = solve_modes(beam, 12)
    assert max(mode.residual for mode in result.modes) < 1e-10
