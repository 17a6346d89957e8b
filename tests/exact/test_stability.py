"""Critical loads: figures of other codes in 25 to 40 digits, and Taylor series of our own in 60.

Uniform columns and rockets are published (docs/validation.md has the sources); tapered, uneven and
sheared ones, divergence of rotations and stability that is regained stand against `Digits`.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq
from stability_digits import Digits

import antinode as an
from antinode.beam.attachments import PointMass
from antinode.modes.backends import choose
from antinode.stability.states import Watcher

PI2 = np.pi**2


def beam(x, m, EI, N, ends=None, **columns):
    return an.Beam.from_stations(
        x, m, EI, axial_force=N, ends=ends, interpolation="linear", **columns
    )


def column(*, share=1.0, tip=0.0, force=1.0, **columns):
    ends = an.Ends("clamped", right_follower=share)
    made = beam([0, 1], [1, 1], [1, 1], [force, force], ends, **columns)
    return made.with_attachments(PointMass(1.0, tip)) if tip else made


def checked(result, width=1e-7):
    """Return a result whose brackets, of this relative width, hold what they say."""
    factors = [each.load_factor for each in result.critical]
    assert factors == sorted(factors)
    assert result.warnings == ()
    for each in result.critical:
        low, high = each.bracket
        assert low <= each.load_factor - each.error
        assert each.load_factor + each.error <= high
        assert each.proven
        assert each.certificate.unstable[0] != each.certificate.unstable[1]
        assert high - low <= max(width * high, 0.1 * (each.load_factor == 0))
    return result


@pytest.mark.parametrize(
    ("share", "tip", "critical", "omega"),
    [
        (1.0, 0.0, 20.0509536190, 11.0155576409),
        (1.0, 0.1, 17.5952822347, 9.43278169433),
        (1.0, 0.5, 16.0615619664, 7.23705582446),
        (1.0, 1.0, 16.2121289425, 6.27450407776),
        (0.5, 0.0, 16.0524615772, 7.05524793749),
        (0.75, 0.0, 17.1546413054, 9.61089516786),
    ],
)
def test_columns_under_forces_that_follow(share, tip, critical, omega):
    result = an.stability(column(share=share, tip=tip, force=2.0))
    if share > 0.5:
        checked(result)
    (only,) = result.critical
    assert only.kind == "flutter"
    assert only.modes == ("bending 1", "bending 2")
    assert 2 * only.load_factor == pytest.approx(critical, rel=1e-11)
    assert 2 * np.pi * only.frequency_hz == pytest.approx(omega, rel=1e-11)
    assert only.certificate.unstable == (0, 2)
    assert result.range == (0.0, only.bracket[1])


def test_a_free_rocket_under_its_thrust():
    result = checked(an.stability(beam([0, 1], [1, 1], [1, 1], [0, 1], an.Ends(right_follower=1))))
    (only,) = result.critical
    assert only.load_factor == pytest.approx(109.689191959, rel=1e-11)
    assert 2 * np.pi * only.frequency_hz == pytest.approx(23.0733298844, rel=1e-10)


def test_both_ends_follow_a_constant_force():
    """Its turn is free: zero is a double root, beside which brackets are wider than elsewhere.

    Then tan x = x and multiples of 2 pi.
    """
    ends = an.Ends(left_follower=1, right_follower=1)
    result = checked(an.stability(beam([0, 1], [1, 1], [1, 1], [1, 1], ends)), 1e-5)
    tangent = 4.493409457909064
    exact = [4 * PI2, 4 * tangent**2, 16 * PI2]
    assert [c.load_factor for c in result.critical[:3]] == pytest.approx(exact, rel=1e-11)
    assert [c.modes for c in result.critical] == [(f"bending {k}",) for k in (1, 2, 3, 4)]
    assert {c.kind for c in result.critical} == {"divergence"}
    assert result.range[1] == result.critical[3].bracket[1]


UNEVEN = {
    "tapered": beam([0, 1], [2, 1], [3, 1], [1, 1], an.Ends("clamped", right_follower=1)),
    "uneven": beam(
        [0, 0.3, 1], [1, 2, 1.5], [1, 0.7, 2], [0.6, 0.5, 1], an.Ends("clamped", right_follower=0.8)
    ),
    "sheared": column(shear_stiffness=[40, 40], rotary_inertia_per_length=[0.01, 0.01]),
    "rotation first": beam(
        [0, 0.4, 1],
        [1, 2, 1],
        [1, 1, 1],
        [0.26, 0.5, 1],
        an.Ends(left_follower=1, right_follower=1),
    ),
    "regained": beam([0, 0.5, 1], [1, 1, 3], [1, 1, 1], [0.2, 0.6, 1], an.Ends(right_follower=1)),
}
EXPECTED = {
    "tapered": ["lost flutter bending 1 bending 2"],
    "uneven": ["lost flutter bending 1 bending 2"],
    "sheared": ["lost flutter bending 1 bending 2"],
    "rotation first": ["lost divergence rigid rotation", "lost flutter bending 1 bending 2"],
    "regained": [
        "lost divergence rigid rotation",
        "lost divergence bending 1",
        "regained divergence bending 1",
        "lost flutter bending 1 bending 2",
    ],
}


@pytest.mark.parametrize("name", UNEVEN)
def test_uneven_beams_against_many_digits(name):
    problem = UNEVEN[name]
    digits, zeros = Digits(problem), int(problem.ends.left == "free")
    result = checked(an.stability(problem))
    told = [f"{c.change} {c.kind} {' '.join(c.modes)}" for c in result.critical]
    assert told == EXPECTED[name]
    for each in result.critical:
        if each.load_factor == 0.0:
            continue
        if each.kind == "divergence":
            exact = digits.divergence(each.load_factor, zeros)
        else:
            exact, omega2 = digits.flutter(each.load_factor, each.omega2)
            frequency = np.sqrt(omega2) / (2 * np.pi)
            assert abs(each.frequency_hz - frequency) <= each.frequency_error_hz < 1e-8 * frequency
        assert each.load_factor == pytest.approx(exact, rel=1e-11)
        assert abs(each.load_factor - exact) <= each.error < 1e-9 * exact


def test_a_free_beam_under_forces_of_fixed_direction():
    """Airy functions: N = P x/L; the rotation diverges at once."""
    result = checked(an.stability(beam([0, 1], [1, 1], [1, 1], [0, 1])))
    assert [c.modes[0] for c in result.critical] == [
        "rigid rotation",
        "bending 1",
        "bending 2",
        "bending 3",
    ]
    assert [c.load_factor for c in result.critical[:3]] == pytest.approx(
        [0.0, 25.6381813768, 95.9495458418], rel=1e-11
    )
    assert {c.certificate.kind for c in result.critical} == {"counts"}
    assert result.complete == "counts"


@pytest.mark.parametrize("form", ["haringx", "engesser"])
def test_a_pinned_column_with_shear(form):
    """Engesser: P/(1 + P/S); Haringx: S/2 (sqrt(1 + 4 P/S) - 1), P = (n pi)^2, below S."""
    S = 50.0
    ends = an.Ends("pinned", "pinned")
    problem = beam([0, 1], [1, 1], [1, 1], [1, 1], ends, shear_stiffness=[S, S], shear_form=form)
    result = an.stability(problem)
    P = PI2 * np.arange(1, 5) ** 2
    exact = P / (1 + P / S) if form == "engesser" else S / 2 * (np.sqrt(1 + 4 * P / S) - 1)
    assert [c.load_factor for c in result.critical] == pytest.approx(exact, rel=1e-10)
    assert [c.certificate.unstable for c in result.critical] == [(0, 1), (1, 2), (2, 3), (3, 4)]


def test_the_first_divergence_is_the_buckling_load():
    ends = an.Ends("clamped", "pinned")
    problem = beam([0, 0.4, 1], [1, 2, 1], [1, 0.5, 2], [1, 0.2, -0.3], ends)
    result, known = an.stability(problem), an.buckling(problem, 1e-9)
    assert result.first.load_factor == pytest.approx(known.load_factor, rel=1e-9)


def beck_share(force, omega2):
    """Return lambda - p dlambda/dp of Beck's column, by implicit derivatives in 30 digits."""
    import mpmath

    mpmath.mp.dps = 30

    def D(N, square):
        root = mpmath.sqrt(N * N / 4 + square)
        a, b = mpmath.sqrt(N / 2 + root), mpmath.sqrt(root - N / 2)
        both = mpmath.cos(a) * mpmath.cosh(b), mpmath.sin(a) * mpmath.sinh(b)
        return 2 * square + N * N + 2 * square * both[0] + N * mpmath.sqrt(square) * both[1]

    def share(N):
        square = mpmath.findroot(lambda z: D(N, z), omega2)
        by_load = mpmath.diff(D, (N, square), (1, 0)) / mpmath.diff(D, (N, square), (0, 1))
        return square + N * by_load

    return float(mpmath.findroot(share, force))


def test_the_least_material_loss_lowers_the_flutter_load_to_half():
    """Ziegler's paradox: 10.94 in the literature, whatever the loss if it is small."""
    found = [
        an.stability(column(loss_factor=[loss, loss])).damped.load_factor for loss in (1e-3, 2e-3)
    ]
    limit = beck_share(10.94, 29.0)
    assert limit == pytest.approx(10.94, abs=0.005)
    assert found[0] == pytest.approx(limit, rel=2e-6)
    slope = (found[1] - found[0]) / (2e-3**2 - 1e-3**2)
    assert found[0] - slope * 1e-3**2 == pytest.approx(limit, rel=3e-8)


def test_without_dampers_nothing_is_told_of_them():
    assert an.stability(column(share=0.0)).damped is None


@pytest.mark.parametrize("share", [0.499, 0.4999])
def test_a_stability_that_is_soon_regained_is_sharp_on_both_sides(share):
    """A column stands bent where cos(sqrt(P)) = -share/(1 - share): twice about pi."""
    lost, regained, _ = checked(an.stability(column(share=share))).critical
    root = np.arccos(-share / (1 - share))
    for found, exact in ((lost, root), (regained, 2 * np.pi - root)):
        assert abs(found.load_factor - exact**2) <= found.error + 1e-13
        assert found.error < 1e-9
    assert (lost.change, regained.change) == ("lost", "regained")


def test_a_follower_that_pulls_makes_nothing_diverge():
    """Under a pull that turns no bent shape stays; omega^2 of exp(-2 sqrt(P)) is soon rounding."""
    assert an.stability(column(force=-1.0)).critical == ()


def both_following(N, near):
    """Return omega^2 of a uniform free body whose ends both follow: no curvature or shear there."""

    def characteristic(omega2):
        r = np.roots([1, 0, N, 0, -omega2]).astype(complex)
        rows = np.array([r**2, r**3, r**2 * np.exp(r), r**3 * np.exp(r)])
        apart = np.prod([r[i] - r[j] for i in range(4) for j in range(i)])
        return float((np.linalg.det(rows) / apart).real)

    return brentq(characteristic, near * (1 + 1e-4), near * (1 - 1e-4), xtol=1e-9)


def test_rounding_beside_a_double_zero_hides_no_close_pair():
    """Two real roots 13 % apart lie between samples; noise beside zero must not stand for them."""
    ends, critical = an.Ends(left_follower=1, right_follower=1), 238.7180637764
    watcher = Watcher(beam([0, 1], [1, 1], [1, 1], [1, 1], ends), choose(), 1, 12)
    for factor, diverging in ((critical * (1 - 1e-6), 3), (critical * (1 + 1e-6), 4)):
        state = watcher.at(factor)
        assert state.proven
        assert state.status == (diverging, 0)
        exact = [both_following(factor, near) for near in (-10530.8, -9227.6, -2104.0)]
        np.testing.assert_allclose(state.real[:3], exact, rtol=1e-9)
