"""Complex modes in closed form, or against determinants written out here in many digits.

Uniform beams with EI = m = L = 1: ``Y'''' = -s^2 Y``, so that ``k^4 = -s^2``; the determinants of
what the ends want are taken in mpmath from the four exponentials.
"""

from dataclasses import replace

import mpmath
import numpy as np
import pytest

import antinode as an
from antinode.riccati import readable
from antinode.riccati.damped.chain import Damped
from antinode.riccati.damped.roots import Finder

CLAMPED = an.Ends(left="clamped")


def uniform(ends=CLAMPED, N=0.0, pieces=2, **columns):
    x = np.linspace(0, 1, pieces + 1)
    one = np.ones(len(x))
    force = np.full(len(x), N)
    return an.Beam.from_stations(x, one, one, axial_force=force, ends=ends, **columns)


def solve(beam, modes=5, **settings):
    return an.solve_modes(beam, modes, families=["bending"], backend="numpy", **settings)


def values(result):
    return np.array([m.eigenvalue_per_s for m in result.modes if m.number])


def determinant(s, N=0.0, EI=1.0, right=None):
    """Of a clamped-free uniform beam; `right` gives K of the free end, 2x2, at s."""
    b, c = mpmath.mpf(N) / EI, -s * s / EI
    squares = [-b / 2 + sign * mpmath.sqrt(b * b / 4 + c) for sign in (1, -1)]
    roots = [sign * mpmath.sqrt(square) for square in squares for sign in (1, -1)]
    K = right(s) if right else [[0, 0], [0, 0]]
    rows = [[], [], [], []]
    for r in roots:
        e = mpmath.exp(r)
        Y, psi, M, Q = e, r * e, EI * r**2 * e, EI * r**3 * e + N * r * e
        rows[0].append(1)
        rows[1].append(r)
        rows[2].append(M + K[1][0] * Y + K[1][1] * psi)
        rows[3].append(Q - K[0][0] * Y - K[0][1] * psi)
    return mpmath.det(mpmath.matrix(rows))


def refined(start, **how):
    """The zero of the determinant next to a start, in 30 digits."""
    with mpmath.workdps(40):
        s, step = mpmath.mpc(start), mpmath.mpf(10) ** -6
        starts = (s, s * (1 + step), s * (1 + 1j * step))
        root = mpmath.findroot(
            lambda z: determinant(z, **how), starts, solver="muller", tol=1e-30, verify=False
        )
        return complex(root)


@pytest.mark.parametrize("c", [0.1, 1.0, 5.0, 40.0])
def test_a_dashpot_at_the_tip(c):
    beam = uniform().with_attachments(an.Dashpot(1.0, translational=c))
    result = solve(beam)
    assert result.certificate["kind"] == "winding"
    found = values(result)
    for mode, s in zip((m for m in result.modes if m.number), found, strict=True):
        exact = refined(s, right=lambda s: [[s * c, 0], [0, 0]])
        assert abs(s - exact) <= 1e-9 * abs(exact)
        assert abs(s - exact) <= mode.error_per_s <= 1e-9 * abs(s)
    assert np.all(found.real < 0)


def test_a_feedback_that_is_not_symmetric():
    K, C = np.array([[3.0, 5.0], [-2.0, 0.5]]), np.array([[0.2, 0.3], [-0.1, 0.4]])
    result = solve(uniform().with_attachments(an.PointFeedback.of(1.0, K, C)))
    assert result.certificate["kind"] == "winding"
    for s in values(result):
        exact = refined(
            s, right=lambda s: [[K[i, j] + s * C[i, j] for j in (0, 1)] for i in (0, 1)]
        )
        assert abs(s - exact) <= 1e-9 * abs(exact)


def test_a_feedback_is_a_spring_a_coupling_and_a_dashpot_where_it_is_symmetric():
    K, C = [[30.0, 2.0], [2.0, 4.0]], [[0.3, 0.0], [0.0, 0.1]]
    one = uniform().with_attachments(an.PointFeedback.of(0.5, K, C))
    other = uniform().with_attachments(
        an.Spring(0.5, translational=30, rotational=4, coupling=2),
        an.Dashpot(0.5, translational=0.3, rotational=0.1),
    )
    np.testing.assert_allclose(values(solve(one)), values(solve(other)), rtol=1e-11)


@pytest.mark.parametrize("c", [0.2, 0.7, 0.99, 1.01, 3.0])
def test_a_damped_bar(c):
    """EA = m = 1, held at the left: ``tanh s = -1/c``, so ``s = artanh(-1/c or -c) + i ...``."""
    one = np.ones(2)
    beam = an.Beam.from_stations([0, 1], one, one, one, ends=CLAMPED).with_attachments(
        an.Dashpot(1.0, axial=c)
    )
    result = an.solve_modes(beam, 4, families=["longitudinal"], backend="numpy")
    found = np.array([m.eigenvalue_per_s for m in result.modes])
    sigma = -np.arctanh(min(c, 1 / c))
    start = 0.5 if c < 1 else 0.0
    exact = sigma + 1j * np.pi * (np.arange(len(found)) + start)
    np.testing.assert_allclose(found, exact, rtol=1e-9)
    assert result.modes[0].kind == ("elastic" if c < 1 else "overdamped")
    assert result.certificate["kind"] == "winding"


def test_a_shaft_with_a_dashpot():
    one = np.ones(2)
    beam = an.Beam.from_stations(
        [0, 1], one, one, torsional_stiffness=one, polar_inertia_per_length=one, ends=CLAMPED
    ).with_attachments(an.Dashpot(1.0, torsional=0.3))
    result = an.solve_modes(beam, 3, families=["torsion"], backend="numpy")
    exact = -np.arctanh(0.3) + 1j * np.pi * (np.arange(3) + 0.5)
    np.testing.assert_allclose([m.eigenvalue_per_s for m in result.modes], exact, rtol=1e-9)


def test_rigid_motions_that_dashpots_oppose_or_not():
    free = uniform(an.Ends())
    one = solve(free.with_attachments(an.Dashpot(0.3, translational=1.0)))
    two = solve(free.with_attachments(an.Dashpot(0.3, translational=1.0, rotational=0.2)))
    turned = solve(free.with_attachments(an.Dashpot(0.3, rotational=0.2)))
    counts = [r.certificate["record"]["at_zero"] for r in (one, two, turned)]
    assert counts == [3, 2, 3]
    assert all(r.certificate["kind"] == "winding" for r in (one, two, turned))
    for result in (one, two, turned):
        assert [m.name for m in result.modes if m.kind == "rigid"] == [
            "rigid translation",
            "rigid rotation",
        ]
    slow = [m.eigenvalue_per_s for m in one.modes if m.kind == "overdamped"]
    assert len(slow) == 1


def test_growth_past_flutter():
    """Beck's column at N = 25, past 20.05: a pair grows, its twin decays."""
    beam = uniform(an.Ends(left="clamped", right_follower=1.0), N=25.0)
    plain, damped = solve(beam, 3), solve(beam, 3, damping="complex")
    np.testing.assert_allclose(
        sorted(values(plain), key=lambda s: (s.imag, s.real)),
        sorted(values(damped), key=lambda s: (s.imag, s.real)),
        rtol=1e-9,
    )
    assert [m.kind for m in damped.modes] == ["elastic", "flutter", "elastic"]
    s = damped.modes[1].eigenvalue_per_s
    exact = refined(s, N=25.0, right=lambda s: [[0, 25.0], [0, 0]])
    assert abs(s - exact) <= 1e-9 * abs(exact)
    assert damped.certificate["kind"] == "winding"


def lossy(eta, N=0.0, ends=CLAMPED, **columns):
    return uniform(ends, N, loss_factor=np.full(3, eta), **columns)


@pytest.mark.parametrize("eta", [0.001, 0.02, 0.2])
def test_a_loss_factor_is_a_complex_stiffness(eta):
    """Without N and springs ``s = i omega sqrt(1 + i eta)``."""
    result = solve(lossy(eta), 4, damping="complex")
    plain = solve(lossy(eta), 4)
    omega = np.sqrt([m.omega2 for m in plain.modes])
    np.testing.assert_allclose(values(result), 1j * omega * np.sqrt(1 + 1j * eta), rtol=1e-9)
    assert result.certificate["kind"] == "winding"
    assert 0 < result.certificate["record"]["loss"] < 1


def test_loss_beside_a_dashpot_under_axial_force():
    beam = lossy(0.05, 1.5).with_attachments(an.Dashpot(1.0, translational=0.7))
    result = solve(beam, 4)
    assert result.certificate["kind"] == "winding"
    for mode in result.modes:
        s = mode.eigenvalue_per_s
        exact = refined(s, N=1.5, EI=mpmath.mpc(1, 0.05), right=lambda s: [[0.7 * s, 0], [0, 0]])
        assert abs(s - exact) <= mode.error_per_s <= 1e-9 * abs(s)


def test_a_bar_that_loses_energy():
    one = np.ones(2)
    beam = an.Beam.from_stations([0, 1], one, one, one, ends=CLAMPED, loss_factor=0.1 * one)
    result = an.solve_modes(beam, 3, families=["longitudinal"], backend="numpy", damping="complex")
    exact = 1j * np.pi * (np.arange(3) + 0.5) * np.sqrt(1 + 0.1j)
    np.testing.assert_allclose(values(result), exact, rtol=1e-9)
    assert result.certificate["kind"] == "winding"


def test_too_much_loss_is_not_proven_and_says_so():
    result = solve(lossy(3.0), 3, damping="complex")
    assert result.certificate["kind"] == "none"
    assert any("not proven" in w for w in result.warnings)


def test_roots_of_the_circle_next_to_its_edge():
    """However the region lies, what is inside is what the elements find there."""
    beam = uniform().with_attachments(an.Dashpot(1.0, translational=30.0, rotational=2.0))
    for modes in range(1, 8):
        result = solve(beam, modes)
        record = result.certificate["record"]
        assert result.certificate["kind"] == "winding"
        assert record["found"] == record["eigenvalues"]


def finder_of(beam):
    """What finds the eigenvalues of the chain of a uniform beam that is held."""
    damped = Damped(beam.chain("bending"))
    return Finder(damped, lambda number: readable.find_eigenvalues(damped.base, number), 0, 0)


@pytest.mark.parametrize("c", [2.0, 30.0])
def test_an_eigenvalue_on_the_edge_is_not_proven_and_beside_it_is(c):
    """A circle through an eigenvalue, and circles a millionth inside and outside of it."""
    beam = uniform().with_attachments(an.Dashpot(1.0, translational=c))
    finder = finder_of(beam)
    finder.find(5)
    for s in values(solve(beam, 3)):
        exact = refined(s, right=lambda s: [[s * c, 0], [0, 0]])
        assert finder._circle(abs(exact))[0].margin <= 0
        inner, outer = (finder._circle(abs(exact) * (1 + off))[0] for off in (-1e-6, 1e-6))
        assert min(inner.margin, outer.margin) > 0
        assert outer.number - inner.number == (2 if s.imag else 1)


@pytest.mark.parametrize("off", [0.0, 1e-15, -1e-15, 1e-13, -1e-13, 1e-10, -1e-10])
def test_an_edge_that_meets_an_eigenvalue_is_moved(off, monkeypatch):
    """The first circle that is tried passes through an eigenvalue, or so near that nobody knows."""
    c = 30.0
    beam = uniform().with_attachments(an.Dashpot(1.0, translational=c))
    finder, circle = finder_of(beam), Finder._circle
    found = {round(abs(v.s), 6) for v in finder.find(5).eigenvalues}
    exact = refined(values(solve(beam, 3))[-1], right=lambda s: [[s * c, 0], [0, 0]])
    asked = []

    def first_through_it(self, radius):
        asked.append(radius)
        return circle(self, abs(exact) * (1 + off) if len(asked) == 1 else radius)

    monkeypatch.setattr(Finder, "_circle", first_through_it)
    roots = finder_of(beam).find(3)
    assert roots.proven
    assert all(abs(v.s) + v.error < roots.circle.radius for v in roots.eigenvalues)
    assert {round(abs(v.s), 6) for v in roots.eigenvalues} == {
        size for size in found if size < roots.circle.radius
    }


@pytest.mark.parametrize("stiffness", [1e-3, 3.0, 30.0, 600.0])
@pytest.mark.parametrize("c", [1e-6, 1e-3, 0.1])
def test_a_rotation_that_a_small_dashpot_slows_is_real(stiffness, c):
    """A free beam on a spring at one end, with a dashpot at the other: it creeps as a rigid one."""
    mass, rate = np.array([[1, 1 / 2], [1 / 2, 1 / 3]]), c * np.ones((2, 2))
    moved = np.linalg.solve(mass, np.hstack([np.diag([stiffness, 0.0]), rate]))
    s = np.linalg.eigvals(np.block([[np.zeros((2, 2)), np.eye(2)], [-moved]]))
    creeping = s[np.abs(s.imag) < 1e-9 * np.abs(s)].real
    creeping = creeping[np.abs(creeping) > 1e-12]
    beam = uniform(an.Ends()).with_attachments(
        an.Spring(0.0, translational=stiffness), an.Dashpot(1.0, translational=c)
    )
    for modes in (3, 6):
        result = solve(beam, modes)
        assert result.certificate["kind"] == "winding"
        first = next(m for m in result.modes if m.number)
        assert first.kind == "overdamped"
        found = first.eigenvalue_per_s.real
        off = np.min(np.abs(found - creeping))
        assert off <= first.error_per_s + 1e-2 * c * abs(found)
        assert first.error_per_s < 1e-3 * abs(found)


@pytest.mark.parametrize("off", [1e-3, 1e-6, 1e-9, 0.0])
def test_a_pair_next_to_its_coalescence(off):
    """Beck's column at P = 20.0509536190 (1 + off): two eigenvalues all but meet, or do."""
    P = 20.0509536190 * (1 - off)
    result = solve(uniform(an.Ends(left="clamped", right_follower=1.0), N=P), 2, damping="complex")
    assert result.certificate["kind"] == "winding"
    for mode in result.modes:
        s = mode.eigenvalue_per_s
        exact = refined(s, N=P, right=lambda s: [[0, P], [0, 0]])
        assert abs(s - exact) <= mode.error_per_s <= 1e-4 * abs(s)


def test_left_eigenvectors_give_the_change_of_an_eigenvalue():
    """A small dashpot and a small feedback: ``ds = -w^T (s dC + dK) v``."""
    beam = uniform(an.Ends(left="clamped", right_follower=1.0), N=5.0).with_attachments(
        an.Dashpot(1.0, translational=0.4)
    )
    before = solve(beam, 3)
    for step, K, C in (
        (1e-4, [[0, 1], [0, 0]], 0 * np.eye(2)),
        (1e-4, 0 * np.eye(2), [[1, 0], [2, 0]]),
    ):
        K, C = np.array(K, float), np.array(C, float)
        pairs = []
        for sign in (1, -1):
            moved = beam.with_attachments(
                an.PointFeedback.of(0.5, sign * step * K, sign * step * C)
            )
            pairs.append(values(solve(moved, 3)))
        numeric = (pairs[0] - pairs[1]) / (2 * step)
        i = int(np.argmin(np.abs(before.x - 0.5)))
        for mode, change in zip(before.modes, numeric, strict=True):
            s = mode.eigenvalue_per_s
            exact = -mode.left[i, :2] @ (K + s * C) @ mode.phasors[i, :2]
            assert abs(exact - change) <= 1e-6 * abs(exact)


def test_a_tapered_beam_states_an_error_that_holds():
    x = np.array([0.0, 1.0])
    beam = an.Beam.from_stations(x, [2, 1], [3, 1], interpolation="linear", ends=CLAMPED)
    beam = beam.with_attachments(an.Dashpot(1.0, translational=1.0))
    rough, fine = solve(beam, 4, tolerance=1e-4), solve(beam, 4, tolerance=1e-9)
    for a, b in zip(rough.modes, fine.modes, strict=True):
        off = abs(a.eigenvalue_per_s - b.eigenvalue_per_s)
        assert off <= a.error_per_s + b.error_per_s
        assert b.error_per_s < 2e-9 * abs(b.eigenvalue_per_s)
    assert rough.segments["bending"] < fine.segments["bending"]


def test_without_damping_everything_stays_as_it_was():
    beam = uniform().with_attachments(an.Spring(1.0, translational=3.0))
    dashed = beam.with_attachments(an.Dashpot(1.0, translational=0.3))
    plain, none = solve(beam), solve(dashed, damping="none")
    assert [m.omega2 for m in plain.modes] == [m.omega2 for m in none.modes]
    assert plain.to_dict()["certificate"] == {"kind": "counts"}
    complex_ = values(solve(replace(beam), damping="complex"))
    np.testing.assert_allclose(complex_.imag, np.sqrt([m.omega2 for m in plain.modes]), rtol=1e-10)
    assert np.max(np.abs(complex_.real)) < 1e-10


@pytest.mark.parametrize("eta", [0.02, 1.0, 2.0, 3.0, 5.0])
def test_large_loss_factors_in_closed_form(eta):
    """s = i sqrt(1 + i eta) beta^2: on the way from no loss eigenvalues must not be mixed up."""
    beam = an.Beam(
        x=[0, 1],
        mass_per_length=1,
        bending_stiffness=1,
        loss_factor=eta,
        ends=an.Ends("clamped", "free"),
    )
    found = [m.eigenvalue for m in an.solve_modes(beam, 3, damping="complex").modes]
    beta = [1.8751040687119611664, 4.6940911329741745764, 7.8547574382376125649]
    assert found == pytest.approx([1j * (1 + 1j * eta) ** 0.5 * b**2 for b in beta], rel=1e-12)


@pytest.mark.parametrize("place", [0.2, 0.3])
def test_a_node_at_a_weak_dashpot_is_proven(place):
    """At a node of bending 4 and 6 a dashpot all but does nothing: a pole of g beside each zero."""
    beam = an.Beam.from_stations([0, 1], 1.0, 1.0).with_attachments(
        an.Spring(place, translational=3.0), an.Dashpot(0.5, translational=0.001)
    )
    result = an.solve_modes(beam, 6, families=["bending"])
    assert result.certificate["kind"] == "winding"
    creeping = result.mode("bending", 1)
    assert creeping.kind == "overdamped"
    # the body turns about the spring, and drags the dashpot: c d^2 / (J/d0^2 ...) by hand
    assert creeping.eigenvalue_per_s.real == pytest.approx(creep(place), rel=1e-3)


def creep(place):
    """s of a slow turn: K (1, psi) = 0 about the spring, C (0.5 - place)^2 against J about it."""
    d = 0.5 - place
    return -0.001 * d**2 / (1 / 12 + d**2)
