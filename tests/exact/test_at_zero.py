"""Elastic modes beside the rigid one at omega^2 = 0: a translating beam just at buckling, springs
that all but coincide."""

import mpmath
import numpy as np
import pytest

import antinode as an
from antinode.beam.attachments import Spring

SLIDING = an.Ends("sliding", "sliding")


def true_omega2(k, N):
    """Of mode k of a sliding beam of EI = m = L = 1, in 40 digits, with N as the double is."""
    with mpmath.workdps(40):
        b = k * mpmath.pi
        return b**4 - mpmath.mpf(N) * b**2


@pytest.mark.parametrize("k", [2, 3, 5])
@pytest.mark.parametrize("off", [0.0, 2e-16, -1e-15, 1e-12])
def test_rounding_is_stated_where_a_mode_meets_the_translation(k, off):
    N = float((k * np.pi) ** 2 * (1 + off))
    beam = an.Beam.from_stations([0, 1], 1.0, 1.0, None, N, ends=SLIDING)
    mode = an.solve_modes(beam, k + 1, backend="numpy").mode("bending", k)
    one = an.natural_frequencies(beam, k + 1)
    row = an.BeamBatch(np.full(4, 0.25), np.ones(4), np.ones(4), np.full(4, N), SLIDING, k + 1)
    many = an.solve_many(row)
    found = [
        (mode.omega2, mode.error_omega2),
        (one.omega2[k - 1], one.error_omega2[k - 1]),
        (many.omega2[0, k - 1], many.error_omega2[0, k - 1]),
    ]
    for omega2, error in found:
        assert abs(omega2 - true_omega2(k, N)) <= error < 1e-6


@pytest.mark.parametrize("apart", [1.5e-9, 3e-11, 0.0])
@pytest.mark.parametrize("stiffness", [1e9, 1e15])
@pytest.mark.parametrize("at", [0.5, 0.2])
def test_springs_hold_a_rotation_however_near_they_stand(apart, stiffness, at):
    """Nothing is set aside as rigid that a spring moves off zero: omega^2 = k d^2/2 / J."""
    springs = [Spring(at, translational=stiffness), Spring(at + apart, translational=stiffness)]
    beam = an.Beam.from_stations([0, 1], 1.0, 1.0).with_attachments(*springs)
    d = springs[1].x - at
    J = (at**3 + (1 - at) ** 3) / 3
    low = an.solve_modes(beam, 2, backend="numpy").modes[0]
    if apart == 0.0:
        assert (low.name, low.omega2, low.error_omega2) == ("rigid rotation", 0.0, 0.0)
        return
    stiff = stiffness * d * d / 2
    assert low.name == "bending 1"
    # the beam's own flexibility lowers it, by no more than springs in series
    assert low.omega2 + low.error_omega2 >= stiff / J / (1 + stiff)
    assert low.omega2 - low.error_omega2 <= stiff / J
    one = an.natural_frequencies(beam, 2)
    assert abs(one.omega2[0] - low.omega2) <= one.error_omega2[0] + low.error_omega2


@pytest.mark.parametrize("at", [1e-10, 2e-9, 1e-8, 1e-6])
def test_a_spring_beside_a_pinned_end_holds_its_rotation(at):
    beam = an.Beam.from_stations([0, 2], 3.0, 1e4, ends=an.Ends("pinned"))
    beam = beam.with_attachments(Spring(at, translational=1e12))
    low = an.solve_modes(beam, 1, backend="numpy").modes[0]
    assert low.name == "bending 1"
    assert low.omega2 == pytest.approx(1e12 * at**2 / (3.0 * 2**3 / 3), rel=1e-3)


def test_what_holds_a_rotation():
    """Places that hold Y, and slopes, each by itself and together."""
    bare = an.Beam.from_stations([0, 1], 1.0, 1.0)
    cases = {
        (): ["rigid translation", "rigid rotation"],
        (Spring(0.3, translational=1e-30),): ["rigid rotation"],
        (Spring(0.3, rotational=1.0),): ["rigid translation"],
        (Spring(0.3, translational=1.0, rotational=1.0),): [],
        (Spring(0.3, translational=1.0), Spring(0.31, rotational=1.0)): [],
    }
    for items, names in cases.items():
        found = an.solve_modes(bare.with_attachments(*items), 1, backend="numpy").modes
        assert [mode.name for mode in found if not mode.number] == names
