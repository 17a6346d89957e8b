"""What must not change: splitting, the axis' direction and origin, units of length, mass, force."""

from dataclasses import replace

import numpy as np
import pytest

from antinode import Beam, Ends, solve_modes
from antinode.beam.attachments import Joint, PointMass, Spring

ALLOWED = 1e-10
ENDS = ("free", "clamped", "pinned", "sliding")


def some_beam(seed=4, ends=("free", "pinned"), decades=4.0):
    rng = np.random.default_rng(seed)
    x = np.concatenate([[0.0], np.cumsum(rng.uniform(0.2, 1.0, 9))])
    EI = 10.0 ** rng.uniform(0, decades, 10)
    m = 10.0 ** rng.uniform(0, 2, 10)
    N = rng.uniform(-1, 1, 10) * 4 * EI.min() / x[-1] ** 2
    return Beam.from_stations(x, m, EI, 1e4 * EI, N, ends=Ends(*ends))


def omega2(beam, modes=8):
    result = solve_modes(beam, modes)
    return np.array([m.omega2 for m in result.modes])


def assert_same(a, b):
    np.testing.assert_allclose(a, b, rtol=ALLOWED, atol=1e-14 * np.abs(b).max())


@pytest.mark.parametrize("left", ENDS)
@pytest.mark.parametrize("right", ENDS)
def test_reversing_the_axis(left, right):
    beam = some_beam(ends=(left, right))
    assert_same(omega2(beam.reversed()), omega2(beam))


@pytest.mark.parametrize("pieces", [2, 3, 17, 500])
def test_splitting_segments(pieces):
    beam = some_beam()
    x = np.interp(np.arange(9 * pieces + 1) / pieces, np.arange(10), beam.x)
    tables = {
        name: np.repeat(getattr(beam, name), pieces, axis=0)
        for name in ("mass_per_length", "bending_stiffness", "axial_stiffness", "axial_force")
    }
    assert_same(omega2(replace(beam, x=x, **tables)), omega2(beam))


@pytest.mark.parametrize("origin", [-7.0, 1e3])
def test_moving_the_origin(origin):
    beam = some_beam()
    assert_same(omega2(replace(beam, x=beam.x + origin)), omega2(beam))


@pytest.mark.parametrize("length", [1e-3, 1e3])
@pytest.mark.parametrize("mass", [1e-6, 1e6])
@pytest.mark.parametrize("time", [1e-3, 1e3])
def test_scaling_the_units(length, mass, time):
    """One unit of length, mass and time is so many of the new ones."""
    beam = some_beam()
    force = mass * length / time**2
    scaled = replace(
        beam,
        x=beam.x * length,
        mass_per_length=beam.mass_per_length * mass / length,
        bending_stiffness=beam.bending_stiffness * force * length**2,
        axial_stiffness=beam.axial_stiffness * force,
        axial_force=beam.axial_force * force,
    )
    assert_same(omega2(scaled) * time**2, omega2(beam))


def test_reversing_a_table_with_linear_interpolation():
    x = np.linspace(0, 3, 7)
    beam = Beam.from_stations(
        x, 2 + x, 5 + x**2, None, 1 - x, interpolation="linear", ends=Ends("clamped", "free")
    )
    assert_same(omega2(beam.reversed()), omega2(beam))


def beam_with_everything():
    items = (
        PointMass(1.3, 4.0, 0.5, 0.2),
        PointMass(2.0, 1.0, 0.1, -0.3),
        Spring(0.7, 50.0, 3.0, 20.0),
        Joint(2.6, 0.02, 1e-3),
        Spring(3.1, np.inf),
        Spring(0.0, 5.0),
    )
    return some_beam(decades=2.0, ends=("free", "free")).with_attachments(*items)


def test_reversing_a_beam_with_attachments():
    beam = beam_with_everything()
    assert_same(omega2(beam.reversed()), omega2(beam))


def test_splitting_a_beam_with_attachments():
    beam = beam_with_everything()
    more = beam.with_breakpoints(np.linspace(0.01, beam.x[-1] - 0.01, 57).tolist())
    assert len(more.x) > len(beam.x) + 40
    assert_same(omega2(more), omega2(beam))


def test_moving_a_beam_with_attachments():
    beam = beam_with_everything()
    items = tuple(replace(item, x=item.x + 5.0) for item in beam.attachments)
    assert_same(omega2(replace(beam, x=beam.x + 5.0, attachments=items)), omega2(beam))


@pytest.mark.parametrize("length", [1e-3, 1e3])
@pytest.mark.parametrize("mass", [1e-6, 1e6])
def test_scaling_the_units_of_attachments(length, mass):
    beam = beam_with_everything()
    force = mass * length  # one unit of time stays
    scaled = replace(
        beam,
        x=beam.x * length,
        mass_per_length=beam.mass_per_length * mass / length,
        bending_stiffness=beam.bending_stiffness * force * length**2,
        axial_stiffness=beam.axial_stiffness * force,
        axial_force=beam.axial_force * force,
        attachments=tuple(scaled_attachment(i, length, mass, force) for i in beam.attachments),
    )
    assert_same(omega2(scaled), omega2(beam))


def scaled_attachment(item, length, mass, force):
    if isinstance(item, PointMass):
        inertia = item.rotary_inertia * mass * length**2
        return PointMass(item.x * length, item.mass * mass, inertia, item.offset * length)
    if isinstance(item, Joint):
        return Joint(
            item.x * length, item.rotational / (force * length), item.axial * length / force
        )
    return Spring(
        item.x * length,
        item.translational * force / length,
        item.rotational * force * length,
        item.axial * force / length,
    )
