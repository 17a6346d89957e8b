"""Shapes on the output grid: the size they are normalised to, and thin segments."""

import numpy as np
import pytest

from antinode import Beam, Ends, solve_modes
from antinode.beam.attachments import Joint, PointMass


def uniform(left, right, **more):
    one = np.ones(2)
    return Beam.from_stations([0.0, 1.0], one, one, 1e4 * one, ends=Ends(left, right), **more)


@pytest.mark.parametrize("modes", [1, 8, 13])
def test_the_largest_displacement_of_a_sine_is_one(modes):
    """Pinned-pinned: every mode is a sine, whose modal mass is m L / 2 where its height is 1."""
    result = solve_modes(uniform("pinned", "pinned"), modes, backend="numpy")
    for mode in result.modes:
        assert mode.modal_mass == pytest.approx(0.5, rel=1e-11), mode.name
        assert np.max(np.abs(mode.shape)) <= 1 + 1e-12


def test_the_largest_displacement_is_one_between_nodes_and_beside_joints():
    """Bending with joints and masses, and a bar that a joint cuts: sampled 50 times as densely."""
    beam = uniform("clamped", "pinned").with_attachments(
        Joint(0.31, rotational=0.7, axial=3e-4), PointMass(0.62, 0.8, rotary_inertia=0.01)
    )
    result = solve_modes(beam, 9, backend="numpy")
    x = np.union1d(np.linspace(0, 1, 20_001), np.nextafter(0.31, 0))
    for family in result.families:
        largest = np.max(np.abs(result.at(x, family)[..., 0]), axis=0)
        np.testing.assert_allclose(largest, 1.0, rtol=2e-6)
        assert np.all(largest <= 1 + 1e-11)


def test_a_thin_sliding_end_slides():
    """EI falls to 1e-9: steps by the end are thinner than 1e-9 of the beam."""
    beam = Beam.from_stations(
        [0.0, 1.0], [1.0, 0.1], [1.0, 1e-9], interpolation="linear", ends=Ends("clamped", "sliding")
    )
    result = solve_modes(beam, 2, backend="numpy")
    for k, mode in enumerate(result.modes):
        np.testing.assert_allclose(mode.states[-1], result.at(1.0)[0, k], rtol=1e-9, atol=1e-12)
        assert abs(mode.states[-1, 1]) < 1e-9


def test_states_on_either_side_of_a_thin_interval():
    """A hinge, all but, and 3e-10 of the beam behind it a mass that turns: states of their own."""
    beam = uniform("clamped", "free").with_attachments(
        Joint(0.5, rotational=2.0), PointMass(0.5 + 3e-10, 1.0, rotary_inertia=0.5)
    )
    result = solve_modes(beam, 3, families="bending", backend="numpy")
    before, after = np.flatnonzero(result.x == 0.5)
    for k, mode in enumerate(result.modes):
        behind = result.at(0.5)[0, k]
        np.testing.assert_allclose(mode.states[after], behind, rtol=1e-9, atol=1e-9)
        left, right = mode.states[before], mode.states[after]
        assert right[1] - left[1] == pytest.approx(2.0 * right[2], rel=1e-6)  # theta+ - theta-
        turning = int(np.flatnonzero(result.x == 0.5 + 3e-10)[-1])
        there = result.at(result.x[turning])[0, k]
        np.testing.assert_allclose(mode.states[turning], there, rtol=1e-7, atol=1e-7)
