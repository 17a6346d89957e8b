"""Sums of powers in circles: of known eigenvalues, through supports and masses, past flutter."""

import numpy as np
import pytest

import antinode as an
from antinode.beam.attachments import Joint, PointMass, Spring
from antinode.beam.families import BENDING
from antinode.stability.circles import sums


def uneven(*attached):
    made = an.Beam.from_stations(
        [0, 0.3, 1], [1, 2, 1.5], [1, 0.7, 2], ends=an.Ends("clamped"), interpolation="step"
    )
    return made.with_attachments(*attached)


@pytest.mark.parametrize(
    "attached",
    [
        (),
        (PointMass(0.5, 0.4, 0.05, 0.01),),
        (Spring(0.6, translational=np.inf),),
        (Joint(0.5, rotational=0.3), Spring(0.8, translational=20.0, rotational=3.0)),
    ],
)
def test_real_eigenvalues_in_a_circle(attached):
    beam = uneven(*attached)
    chain = beam.chain(BENDING)
    known = [m.omega2 for m in an.solve_modes(beam, 4, families=[BENDING]).modes]
    centre = (known[0] + known[1]) / 2
    radius = np.sqrt((known[1] - known[0]) / 2 * (known[2] - centre))
    found = sums(chain, centre, radius, 64)
    off = np.array(known[:2]) - centre
    assert found.number == 2
    assert found.first == pytest.approx(np.sum(off), abs=1e-9 * radius)
    assert found.second == pytest.approx(np.sum(off**2), rel=1e-8)
    assert found.apart == pytest.approx((known[1] - known[0]) ** 2, rel=1e-9)


def test_a_pair_past_flutter_is_apart_by_a_negative_square():
    ends = an.Ends("clamped", right_follower=1)
    beam = an.Beam.from_stations([0, 1], [1, 1], [1, 1], axial_force=[20.5, 20.5], ends=ends)
    pair = next(m for m in an.solve_modes(beam, 2).modes if m.kind == "flutter")
    s = complex(pair.growth_rate_per_s, 2 * np.pi * pair.frequency_hz)
    omega2 = -(s**2)
    found = sums(beam.chain(BENDING), 121.0, 60.0)
    assert found.number == 2
    assert 121 + found.first / 2 == pytest.approx(omega2.real, rel=1e-10)
    assert found.apart == pytest.approx(-4 * omega2.imag**2, rel=1e-9)


def test_a_circle_counts_what_is_zero_by_the_supports():
    beam = an.Beam.from_stations([0, 1], [1, 1], [1, 1])
    found = sums(beam.chain(BENDING), 0.0, 200.0)
    assert found.number == 2
    assert abs(found.first) < 1e-9
