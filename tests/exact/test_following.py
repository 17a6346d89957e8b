"""End forces that turn with a free end: published and exact numbers, before and past flutter.

Beck's column, sub-tangential shares, Pflueger's tip mass, free rockets under thrust. Figures with
their last digit rounded come from codes of 25 to 40 digits that share nothing with this one.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from mpmath import cos, cosh, findroot, mp, mpf, sin, sinh, sqrt

import antinode as an
from antinode.beam.attachments import PointMass, Spring
from antinode.errors import InputError
from antinode.modes.buckling import buckling

BECK = 20.0509536190


def column(force, *, tip=0.0, share=1.0, stations=2, left="clamped"):
    x = np.linspace(0.0, 1.0, stations)
    ends = an.Ends(left, "free", right_follower=share)
    one = np.ones(stations)
    beam = an.Beam.from_stations(x, one, one, axial_force=force * one, ends=ends)
    return beam.with_attachments(PointMass(1.0, tip)) if tip else beam


def rocket(force, *, left=0.0, share=1.0):
    """N = P x/L of a uniform body that its thrust accelerates, or a constant force."""
    start = force if left else 0.0
    return an.Beam.from_stations(
        [0, 1],
        [1, 1],
        [1, 1],
        axial_force=[start, force],
        interpolation="linear",
        ends=an.Ends(left_follower=left, right_follower=share),
    )


def omega(beam, modes=3, **settings):
    result = an.solve_modes(beam, modes, families=["bending"], **settings)
    assert result.certificate["kind"] == "winding"
    return result, np.sqrt([m.omega2 for m in result.modes if m.number][:modes])


def beck_square(force, share, guess):
    """Return omega^2 by Beck's determinant in 30 digits, of which a share follows."""
    mp.dps = 30

    def determinant(square):
        N = mpf(force)
        root = sqrt(N * N / 4 + square)
        a, b = sqrt(N / 2 + root), sqrt(root - N / 2)
        # Y = A (cos ax - cosh bx) + B (sin ax - a/b sinh bx)
        m11 = -(a**2) * cos(a) - b**2 * cosh(b)
        m12 = -(a**2) * sin(a) - a * b * sinh(b)
        rest = (1 - mpf(share)) * N  # Y''' + (1 - share) N Y' = 0
        m21 = a**3 * sin(a) - b**3 * sinh(b) + rest * (-a * sin(a) - b * sinh(b))
        m22 = -(a**3) * cos(a) - a * b**2 * cosh(b) + rest * (a * cos(a) - a * cosh(b))
        return ((m11 * m22 - m12 * m21) / a).real

    start = mpf(guess)
    return float(findroot(determinant, (start * (1 - 1e-6), start * (1 + 1e-6)), solver="anderson"))


@pytest.mark.parametrize("share", [1.0, 0.75, 0.5, 0.25])
@pytest.mark.parametrize("force", [5.0, 12.0, 16.0])
def test_columns_under_forces_that_follow_by_a_share(force, share):
    result = an.solve_modes(column(force, share=share), 3)
    found = [mode.omega2 for mode in result.modes]
    exact = [beck_square(force, share, value) for value in found]
    assert found == pytest.approx(exact, rel=1e-10)
    assert len(set(np.round(exact, 6))) == len(exact)


@pytest.mark.parametrize(
    ("share", "tip", "critical", "at"),
    [
        (1.0, 0.0, BECK, 11.0155576409),
        (0.5, 0.0, 16.0524615772, 7.05524793749),
        (0.75, 0.0, 17.1546413054, 9.61089516786),
        (1.0, 0.1, 17.5952822347, 9.43278169433),
        (1.0, 0.5, 16.0615619664, 7.23705582446),
        (1.0, 1.0, 16.2121289425, 6.27450407776),
    ],
)
def test_two_frequencies_meet_where_flutter_starts(share, tip, critical, at):
    before, found = omega(column(critical * (1 - 1e-8), share=share, tip=tip), 2)
    assert [m.kind for m in before.modes] == ["elastic", "elastic"]
    assert np.sqrt(np.mean(found**2)) == pytest.approx(at, rel=1e-6)
    after = an.solve_modes(column(critical * (1 + 1e-6), share=share, tip=tip), 2)
    assert [m.kind for m in after.modes] == ["elastic", "flutter"]
    assert [m.frequency_hz * 2 * np.pi for m in after.modes] == pytest.approx([at] * 2, rel=1e-5)
    assert after.modes[0].growth_rate_per_s == -after.modes[1].growth_rate_per_s < 0


EXACT = {
    5.0: [21.679929133, 60.729937297, 119.8753091],
    10.0: [20.974620887, 59.767083312, 118.83595692],
    20.0: [19.529367338, 57.775272676, 116.72202804],
}


@pytest.mark.parametrize("force", EXACT)
def test_a_free_rocket_under_thrust(force):
    result, found = omega(rocket(force), tolerance=1e-10)
    assert found == pytest.approx(EXACT[force], rel=1e-9)
    rigid = [m for m in result.modes if not m.number]
    assert [(m.name, m.omega2) for m in rigid] == [
        ("rigid translation", 0.0),
        ("rigid rotation", 0.0),
    ]


def test_a_free_rocket_flutters_at_its_critical_thrust():
    critical, at = 109.689191959, 23.0733298844
    before, _ = omega(rocket(critical * (1 - 1e-4)), 2)
    after, found = omega(rocket(critical * (1 + 1e-4)), 2)
    assert "flutter" not in [m.kind for m in before.modes]
    assert [m.kind for m in after.modes if m.number] == ["elastic", "flutter"]
    assert found[:2] == pytest.approx([at, at], rel=1e-3)


def test_both_ends_follow_a_constant_force():
    stable, _ = omega(rocket(39.0, left=1.0), 2)
    assert [m.omega2 for m in stable.modes[:2]] == [0.0, 0.0]
    assert [m.kind for m in stable.modes] == ["rigid", "rigid", "elastic", "elastic"]
    critical = 4 * np.pi**2
    just = an.solve_modes(rocket(critical * (1 + 1e-6), left=1.0), 1)
    assert just.modes[0].name == "bending 1"
    assert just.modes[0].kind == "divergent"
    assert abs(just.modes[0].omega2) < 1e-3
    nearer = an.solve_modes(rocket(critical * (1 + 1e-9), left=1.0), 1)
    assert [m.kind for m in nearer.modes if m.number] == ["elastic"]
    assert "omega^2 is zero within its error" in nearer.warnings[0]
    below = an.solve_modes(rocket(critical * (1 - 1e-9), left=1.0), 1)
    assert "divergent" not in [m.kind for m in below.modes]


@pytest.mark.parametrize("force", [1.0, 5.0, 15.0, -5.0])
def test_a_rotation_about_a_pin_that_no_force_changes(force):
    """With Q = N, M = 0 and psi = 1 the equations and ends hold at omega^2 = 0, whatever EI, m."""
    ends = an.Ends("pinned", "free", right_follower=1.0)
    beam = an.Beam.from_stations(
        [0, 0.6, 1], [1, 2, 1], [1, 1, 3], axial_force=3 * [force], ends=ends, interpolation="log"
    )
    for one in (beam, beam.reversed()):
        found = an.solve_modes(one, 2).to_dict()
        rotation = found["modes"][0]
        assert (rotation["name"], rotation["kind"]) == ("rigid rotation", "rigid")
        assert (rotation["frequency_hz"], rotation["error_hz"]) == (0.0, 0.0)
        assert found["warnings"] == []


def two_forces(right):
    """A beam whose force jumps from 5 to another; both follow their ends."""
    x, EI, force = [0, 0.4, 0.4, 1], [1, 2, 2, 1], [5, 5, right, right]
    ends = an.Ends(left_follower=1.0, right_follower=1.0)
    return an.Beam.from_stations(
        x, np.ones(4), EI, axial_force=force, ends=ends, interpolation="linear"
    )


@pytest.mark.parametrize("spring", [10.0, np.inf])
@pytest.mark.parametrize("right", [5.0, 7.0])
def test_a_rotation_about_a_place_that_is_held(spring, right):
    """The spring gives way until it takes the difference of the forces on its two sides."""
    beam = two_forces(right)
    held = beam.with_attachments(Spring(0.4, translational=spring))
    result = an.solve_modes(held, 2, families=["bending"])
    rotation = result.modes[0]
    assert (rotation.name, rotation.omega2, rotation.error_omega2) == ("rigid rotation", 0.0, 0.0)
    Y, psi, M, Q = result.at([0.1, 0.4, 0.9])[:, 0].T
    assert np.max(np.abs(M)) < 1e-12
    assert [Q[0], Q[2]] == pytest.approx([5.0 * psi[0], right * psi[0]])
    assert Y[1] == pytest.approx((5.0 - right) / spring * psi[0], abs=1e-12)
    assert result.modes[1].kind == "elastic"


def test_a_rotation_whose_forces_differ_about_a_pin_on_an_arm_is_turned():
    beam = two_forces(7.0)
    arm = Spring(0.4, translational=10.0, rotational=0.1, coupling=1.0)
    result = an.solve_modes(beam.with_attachments(arm), 2, families=["bending"])
    assert result.modes[0].name == "rigid rotation"
    assert result.modes[0].omega2 != 0.0


def test_a_value_that_is_zero_within_its_error_is_not_called_divergent():
    for off in (-1e-14, 0.0, 1e-14):
        ends = an.Ends("pinned", "pinned")
        beam = an.Beam.from_stations([0, 1], [1, 1], [1, 1], axial_force=2 * [np.pi**2], ends=ends)
        force = beam.axial_force * (1 + off)
        result = an.solve_modes(replace(beam, axial_force=force), 1, families=["bending"])
        mode = result.modes[0]
        assert mode.kind == "elastic"
        assert 0 <= mode.omega2 < mode.error_omega2
        assert result.to_dict()["modes"][0]["frequency_hz"] is not None
        assert ["bending 1: omega^2 is zero" in w for w in result.warnings] == [True]
        assert not an.natural_frequencies(replace(beam, axial_force=force), 1).omega2[0] < 0


def test_a_left_end_is_a_right_one_read_from_the_other_side():
    x, mass, EI = [0.0, 0.3, 1.0], [1.0, 2.0, 1.5], [1.0, 0.7, 2.0]
    force = [6.0, 5.0, 1.0]
    ends = an.Ends(left_follower=0.8)
    beam = an.Beam.from_stations(x, mass, EI, axial_force=force, interpolation="linear", ends=ends)
    turned = beam.reversed()
    assert turned.ends.right_follower == 0.8
    one, other = omega(beam), omega(turned)
    assert one[1] == pytest.approx(other[1], rel=1e-9)
    assert one[0].modes[0].omega2 != 0.0


def test_without_a_share_the_numbers_are_those_of_counts():
    beam = rocket(10.0, share=0.0)
    result = an.solve_modes(beam, 3)
    assert result.certificate == {"kind": "counts"}
    found = np.sqrt([m.omega2 for m in result.modes if m.number])
    assert found == pytest.approx([15.802594578, 57.055071728, 116.9649101], rel=1e-6)


@pytest.mark.parametrize("beam", [rocket(20.0), column(15.0, tip=0.3), rocket(30.0, left=0.6)])
def test_shapes_keep_to_their_ends_and_to_the_weak_form(beam):
    result = an.solve_modes(beam, 3, tolerance=1e-9)
    left, right = beam.following()
    for mode in result.modes:
        if mode.number:
            Y, psi, M, Q = mode.states.T
            size = np.max(np.abs(mode.states), axis=0)
            assert mode.residual < 1e-9
            assert abs(M[-1]) < 1e-9 * size[2]
            if not beam.attachments:
                assert abs(Q[-1] - right * psi[-1]) < 1e-9 * size[3]
            if beam.ends.left == "free":
                assert abs(Q[0] - left * psi[0]) < 1e-9 * size[3]
            assert np.max(np.abs(Y)) == pytest.approx(1.0, abs=1e-4)


def test_json_of_a_fluttering_column():
    found = an.solve_modes(column(21.0), 3).to_dict()
    assert ["bending 2" in w and "flutter" in w for w in found["warnings"]] == [True]
    growing = [m for m in found["modes"] if m["kind"] == "flutter"]
    assert len(growing) == 1
    s = growing[0]["eigenvalue_per_s"]
    assert s[0] > 0
    assert s[1] > 0
    assert growing[0]["growth_rate_per_s"] == s[0]
    assert growing[0]["damping_ratio"] == pytest.approx(-s[0] / np.hypot(*s))
    assert growing[0]["frequency_hz"] == pytest.approx(s[1] / (2 * np.pi))
    twin = found["modes"][0]
    assert twin["eigenvalue_per_s"] == [-s[0], s[1]]
    assert twin["kind"] == "elastic"
    assert found["certificate"]["kind"] == "winding"
    assert found["certificate"]["region"]["real_part_of_omega2_below"] > 0


@pytest.mark.parametrize(
    ("ends", "said"),
    [
        ({"left": "clamped", "left_follower": 0.5}, "the left end is clamped"),
        ({"right_follower": 1.2}, "right_follower is 1.2; allowed is 0"),
        ({"left_follower": -0.1}, "left_follower is -0.1; allowed is 0"),
        ({"right": "pinned", "right_follower": 1.0}, "turns with a free end only"),
    ],
)
def test_shares_that_cannot_be(ends, said):
    with pytest.raises(InputError, match=said):
        an.Ends(**ends)


def test_no_force_follows_an_end_that_a_support_holds():
    beam = replace(rocket(5.0), ends=an.Ends())
    held = beam.with_attachments(Spring(1.0, translational=np.inf))
    with pytest.raises(InputError, match="held by a support"):
        replace(held, ends=an.Ends(right_follower=1.0))


def test_the_buckling_load_of_fixed_directions_is_not_asked_of_a_following_force():
    with pytest.raises(InputError, match="turns with it"):
        buckling(column(1.0))
