"""Stability along inputs: against what is known in closed form, and along the load factor."""

import math

import numpy as np
import pytest

import antinode as an
from antinode.stability.along import follow

CLAMPED = an.Ends("clamped", right_follower=1.0)


def column(N=1.0, EI=1.0, ends=CLAMPED, **more):
    return an.Beam.from_stations([0, 1], [1, 1], [EI, EI], axial_force=[N, N], ends=ends, **more)


def only(found):
    (change,) = found.critical
    assert change.proven
    assert change.bracket[0] <= change.value <= change.bracket[1]
    return change


def test_flutter_along_a_force_that_does_not_begin_at_zero():
    change = only(follow(lambda N: column(N), 15.0, 25.0, points=5))
    assert change.kind == "flutter"
    assert change.change == "lost"
    assert change.modes == ("bending 1", "bending 2")
    assert change.value == pytest.approx(20.0509536190, rel=1e-9)
    assert change.frequency_hz == pytest.approx(11.0155576409 / (2 * math.pi), rel=1e-6)


def test_a_stiffness_that_ends_flutter():
    change = only(follow(lambda EI: column(1.0, EI), 0.04, 0.06, points=3))
    assert (change.kind, change.change) == ("flutter", "regained")
    assert change.value == pytest.approx(1 / 20.0509536190, rel=1e-9)


def test_a_share_that_turns_ends_divergence():
    """Of N = 16: (1 - eta) cos 4 + eta = 0."""

    def beam(eta):
        return column(16.0, ends=an.Ends("clamped", right_follower=eta))

    change = only(follow(beam, -0.0, 0.9, points=4))
    assert (change.kind, change.change) == ("divergence", "regained")
    assert change.value == pytest.approx(math.cos(4) / (math.cos(4) - 1), rel=1e-8)


def test_a_number_that_goes_through_zero():
    """From tension to compression."""
    change = only(follow(lambda N: column(N), -11.0, 29.0, points=6))
    assert change.value == pytest.approx(20.0509536190, rel=1e-8)


def test_a_spring_that_holds_a_column():
    """A spring at the tip under N = 10: it diverges below a stiffness."""

    def beam(k):
        spring = an.Spring(1.0, translational=k)
        return column(10.0, ends=an.Ends("clamped")).with_attachments(spring)

    root = math.sqrt(10)
    held = 10 / (math.tan(root) / root - 1)  # tip deflection of a clamped column by a side force
    change = only(follow(beam, 2.0, 20.0, points=6))
    assert (change.kind, change.change) == ("divergence", "regained")
    assert change.value == pytest.approx(-held, rel=1e-7)


def test_losses_count_unless_they_are_left_out():
    def beam(N):
        return column(N, loss_factor=[1e-3, 1e-3])

    lossy = only(follow(beam, 5.0, 25.0, points=5))
    assert lossy.value == pytest.approx(an.stability(beam(1.0)).damped.load_factor, rel=1e-7)
    without = only(follow(beam, 5.0, 25.0, points=5, dampers=False))
    assert without.value == pytest.approx(20.0509536190, rel=1e-9)


def test_it_says_where_a_beam_can_no_longer_be_made():
    def beam(N):
        if N > 12:
            raise an.InputError("no such beam")
        return column(N)

    found = follow(beam, 5.0, 25.0, points=5)
    assert not found.critical
    assert found.reach == 10.0
    assert "no such beam" in found.warnings[0]
    with pytest.raises(an.InputError, match="no such beam"):
        follow(beam, 20.0, 25.0)


def test_a_tapered_column_is_as_along_the_factor():
    def beam(N):
        return an.Beam.from_stations(
            [0, 1], [2, 1], [3, 1], axial_force=[N, N], ends=CLAMPED, interpolation="linear"
        )

    factor = an.stability(beam(1.0)).flutter
    change = only(follow(beam, 0.8 * factor.load_factor, 1.1 * factor.load_factor, points=3))
    assert change.value == pytest.approx(factor.load_factor, rel=1e-8)
    assert np.isclose(change.frequency_hz, factor.frequency_hz, rtol=1e-5)
