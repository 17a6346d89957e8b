"""Masses add: parts along some of the length, in the API and in files."""

import numpy as np
import pytest

from antinode import load_beam, solve_modes
from antinode.beam.mass import MassDistribution

HULL = MassDistribution(np.array([0.0, 2.0, 6.0]), np.array([[3.0, 3.0], [5.0, 5.0]]), "step")
TANK = MassDistribution(np.array([1.0, 4.0]), np.array([[2.0, 8.0]]), "linear")


def test_the_sum_has_the_moments_of_its_parts():
    both = HULL + TANK
    for x in (0.5, 1.7, 3.0, 6.0):
        inside = np.clip(x, 1.0, 4.0)
        expected = HULL.moments(x) + TANK.moments(inside)
        np.testing.assert_allclose(both.moments(x), expected, rtol=1e-14)
    assert both.interpolation == "linear"
    assert (HULL + HULL).interpolation == "step"


def test_log_masses_do_not_add():
    log = MassDistribution(np.array([0.0, 1.0]), np.array([[1.0, 2.0]]), "log")
    with pytest.raises(ValueError, match="cannot be added"):
        _ = HULL + log


BEAM = """
[beam]
stations = { x = [0, 2, 6], mass_per_length = [3, 5, 5], bending_stiffness = [10, 20, 20] }
[[beam.masses]]
name = "tank"
interpolation = "linear"
x = [1, 4]
mass_per_length = [2, 8]
"""


def test_parts_in_a_beam_file(tmp_path):
    path = tmp_path / "beam.toml"
    path.write_text(BEAM)
    beam = load_beam(path).beam()
    assert beam.mass == pytest.approx((HULL + TANK).moments(6.0)[0])
    # the same beam in one table: m = 3, 3 + 2 + 2 (x - 1), 5 + 2 + 2 (x - 1), 5
    path.write_text(
        "[beam]\ninterpolation = 'linear'\nstations = { x = [0, 1, 1.0000001, 2, 2.0000001, 4, "
        "4.0000001, 6], mass_per_length = [3, 3, 5, 7, 9, 13, 5, 5], "
        "bending_stiffness = [10, 10, 10, 10, 20, 20, 20, 20] }"
    )
    single = load_beam(path).beam()
    a, b = (solve_modes(problem, 4).frequencies_hz() for problem in (beam, single))
    np.testing.assert_allclose(a, b, rtol=1e-6)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ("beam.masses.0.x=[1,7]", "runs from 1 to 7 m"),
        ("beam.masses.0.mass_per_length=[1,-2]", "must be at least 0"),
        ("beam.masses.0.mass_per_length=[1]", "1 rows"),
        ("beam.interpolation=log", "cannot be added"),
    ],
)
def test_wrong_parts(tmp_path, change, message):
    path = tmp_path / "beam.toml"
    path.write_text(BEAM)
    with pytest.raises(ValueError, match=message):
        load_beam(path, [change])
