"""Uniform beams under constant axial force: closed form, and 50-digit characteristic equations."""

import math

import numpy as np
import pytest
from test_uniform_beam import uniform_chain

from antinode import Beam, Ends, solve_modes
from antinode.riccati.roots import find_eigenvalues
from reference import pinned_axial_omega2, uniform_axial_root

EULER = math.pi**2


@pytest.mark.parametrize("load", [-5.0, -1.0, 0.0, 0.5, 0.9, 0.99, 1.5])
@pytest.mark.parametrize("segments", [1, 10, 100, 1000])
def test_pinned_pinned(load, segments):
    found = find_eigenvalues(uniform_chain(segments, "pinned", "pinned", load * EULER), 20)
    for value in found:
        exact = float(pinned_axial_omega2(value.index, load * EULER))
        low, high = value.bracket
        assert low < exact < high
        assert value.omega2 == pytest.approx(exact, rel=2e-12)


def test_a_column_past_buckling_diverges_and_keeps_its_number():
    beam = Beam.from_stations(
        [0.0, 1.0], 1.0, 1.0, None, 1.5 * EULER, ends=Ends("pinned", "pinned")
    )
    result = solve_modes(beam, 3)
    first, second = result.modes[:2]
    assert (first.name, first.kind, first.number) == ("bending 1", "divergent", 1)
    assert math.isnan(first.frequency_hz)
    assert first.growth_rate_per_s == pytest.approx(math.pi**2 * math.sqrt(0.5), rel=1e-12)
    assert (second.kind, second.number) == ("elastic", 2)
    assert any("past buckling" in warning for warning in result.warnings)


@pytest.mark.parametrize(("left", "right"), [("free", "free"), ("clamped", "free")])
@pytest.mark.parametrize("N", [-200.0, -20.0, 1.0, 2.0, 20.0])
@pytest.mark.parametrize("segments", [1, 50, 1000])
def test_constant_axial_force(left, right, N, segments):
    zeros = 1 if left == "free" else 0
    for value in find_eigenvalues(uniform_chain(segments, left, right, N), 12, zeros=zeros):
        if value.omega2 != 0.0:
            exact = uniform_axial_root(left, right, N, value.bracket)
            assert value.omega2 == pytest.approx(float(exact), rel=1e-12)


def test_free_body_in_compression_has_a_divergent_rotation_and_a_translation_at_zero():
    beam = Beam.from_stations(np.linspace(0, 2, 9), 3.0, 5.0, None, 0.4)
    rotation, translation, first = solve_modes(beam, 1).modes
    assert (rotation.name, rotation.kind, rotation.number) == ("rigid rotation", "divergent", 0)
    assert (translation.name, translation.kind) == ("rigid translation", "rigid")
    assert translation.omega2 == 0.0
    assert (first.name, first.number) == ("bending 1", 1)
    net = -0.4 * 2 / beam.moment_of_inertia  # first order in N
    assert rotation.omega2 == pytest.approx(net, rel=0.02)


def test_free_body_in_tension_has_a_rotation_that_vibrates():
    beam = Beam.from_stations([0.0, 2.0], 3.0, 5.0, None, -0.4)
    translation, rotation, first = solve_modes(beam, 1).modes
    assert (translation.name, rotation.name) == ("rigid translation", "rigid rotation")
    assert rotation.kind == "rigid"
    assert rotation.omega2 == pytest.approx(0.4 * 2 / beam.moment_of_inertia, rel=0.02)
    assert first.number == 1
