"""Lists of modes proven in ball arithmetic, and lists that are wrong refuted.

The characteristic function in balls shares no code with the solver but the law's matrix and the
steps of points; here it is held to the solver's own D and to determinants in many digits.
"""

from dataclasses import replace

import damped_beams
import following_beams
import mpmath
import numpy as np
import pytest
from test_complex_modes import determinant, uniform

import antinode as an
from antinode.proof.disc import Disc
from antinode.proof.function import Characteristic, precision
from antinode.proof.lists import Listed, prove_list
from antinode.riccati.damped.chain import Damped

flint = pytest.importorskip("flint")

CLAMPED = an.Ends(left="clamped")
BECK = an.Ends(left="clamped", right_follower=1.0)
ROCKET = an.Ends(right_follower=1.0)


def solve(beam, modes=5, **settings):
    return an.solve_modes(beam, modes, families=["bending"], backend="numpy", **settings)


def rich():
    """Two steps with a mass off its node, a spring, a joint, and an elastic end."""
    beam = an.Beam.from_stations(
        [0, 0.4, 1.0, 1.7], [2.0, 1.0, 3.0, 3.0], [5.0, 2.0, 1.0, 1.0], axial_force=[1, 0.5, 2, 2]
    )
    return beam.with_attachments(
        an.PointMass(0.4, 0.7, 0.02, offset=0.05),
        an.Spring(1.0, translational=30.0, rotational=2.0),
        an.Joint(1.0, rotational=0.12),
    )


def ratio(beam, s):
    """D in balls over the solver's, at several s: one constant."""
    damped = Damped(beam.chain("bending", 1))
    with precision(flint, 300):
        D = Characteristic(damped, "s", float(np.max(np.abs(s))) ** 2)
        own = [D(flint.acb(z.real, z.imag)) for z in s]
        value, size = damped.characteristic(s)
        return np.array(
            [
                complex(ball / flint.arb(float(k)).exp() / flint.acb(complex(v)))
                for ball, v, k in zip(own, value, size, strict=True)
            ]
        )


@pytest.mark.parametrize("seed", range(6))
def test_the_function_is_the_solvers(seed):
    rng = np.random.default_rng(seed)
    beam = damped_beams.random_beam(rng) if seed else rich()
    s = rng.uniform(1, 60, 6) * np.exp(1j * rng.uniform(0, np.pi, 6))
    both = ratio(beam, s)
    assert np.abs(both / both[0] - 1) == pytest.approx(0, abs=1e-9)


def test_values_are_enclosed_and_bounded():
    beam = uniform(N=3.0).with_attachments(an.Dashpot(1.0, translational=2.0))
    with precision(flint, 200):
        D = Characteristic(Damped(beam.chain("bending", 1)), "s", 100.0)
        own = [D(flint.acb(z.real, z.imag)) for z in (3 + 40j, -2 + 7j)]
        bound = D.bound(flint.arb(41))
    quotient = complex(own[0] / own[1])
    right = {"right": lambda s: [[2 * s, 0], [0, 0]]}
    with mpmath.workdps(40):

        def exact(s):  # over the determinant of the exponentials themselves
            squares = [-1.5 + sign * mpmath.sqrt(2.25 - s * s) for sign in (1, -1)]
            roots = [sign * mpmath.sqrt(q) for q in squares for sign in (1, -1)]
            plain = mpmath.det(mpmath.matrix([[r**k for r in roots] for k in range(4)]))
            return determinant(s, N=3.0, **right) / plain

        other = complex(exact(mpmath.mpc(3, 40)) / exact(mpmath.mpc(-2, 7)))
    assert quotient == pytest.approx(other, rel=1e-13)
    assert all(bool(value.abs_upper() < bound) for value in own)


PROVEN = {
    "cantilever": (uniform(CLAMPED), {}),
    "Beck below flutter": (uniform(BECK, 18.0), {}),
    "Beck past flutter": (uniform(BECK, 25.0), {}),
    "the same in s": (uniform(BECK, 25.0), {"damping": "complex"}),
    "Beck at flutter": (uniform(BECK, 20.0509536), {"damping": "complex"}),
    "a dashpot at the tip": (
        uniform(CLAMPED).with_attachments(an.Dashpot(1.0, translational=1.0)),
        {},
    ),
    "overdamped": (uniform(CLAMPED).with_attachments(an.Dashpot(1.0, translational=5.0)), {}),
    "free-free under thrust": (uniform(ROCKET, 30.0), {}),
    "the same with s = 0 four times": (uniform(ROCKET, 30.0), {"damping": "complex"}),
    "steps, mass, spring, joint": (rich(), {}),
    "the same in s too": (
        rich().with_attachments(an.Dashpot(1.7, translational=0.3, rotational=0.1)),
        {},
    ),
    "loss": (
        replace(uniform(BECK, 18.0), loss_factor=np.full((2, 2), 0.02)),
        {"damping": "complex"},
    ),
    "loss, free and compressed": (
        replace(uniform(an.Ends(), 5.0), loss_factor=np.full((2, 2), 0.1)),
        {"damping": "complex"},
    ),
    "sliding to pinned, held inside": (
        uniform(an.Ends("sliding", "pinned"), 2.0, 3).with_attachments(
            an.Spring(1 / 3, translational=np.inf), an.PointMass(2 / 3, 0.3)
        ),
        {},
    ),
}


@pytest.mark.parametrize("name", PROVEN)
def test_a_list_is_proven(name):
    beam, settings = PROVEN[name]
    proof = solve(beam, **settings).prove()
    assert proof.proven, proof.sentence
    assert proof.arcs > 16
    assert proof.precision_bits > 100
    assert an.prove(solve(beam, **settings)).to_dict()["balls"] is True


def lossy(eta):
    return replace(uniform(CLAMPED), loss_factor=np.full((2, 2), eta))


def with_large_feedback():
    K = np.array([[0, 1e5], [-1e5, 0]])
    return uniform(CLAMPED).with_attachments(an.PointFeedback.of(1.0, K, abs(K) / 3))


@pytest.mark.parametrize("beam", [lossy(0.5), with_large_feedback()], ids=["loss", "feedback"])
def test_balls_prove_what_bounds_between_samples_do_not(beam):
    result = solve(beam, damping="complex")
    assert result.certificate["kind"] == "none"
    assert any("not proven here" in warning for warning in result.warnings)
    proof = result.prove()
    assert proof.proven, proof.sentence
    told = proof.applied(result)
    assert told.certificate["kind"] == "winding"
    assert told.certificate["balls"] is True
    assert not any("not proven here" in warning for warning in told.warnings)


@pytest.mark.parametrize("seed", range(4))
def test_random_lists_are_proven(seed):
    rng = np.random.default_rng(100 + seed)
    for beam in (
        damped_beams.random_beam(rng),
        following_beams.random_beam(rng, 20.0, uniform=True),
    ):
        result = solve(beam)
        assert result.certificate["kind"] == "winding"
        assert result.prove().proven


def test_bars_and_shafts_are_proven_too():
    one = np.ones(4)
    beam = an.Beam.from_stations(
        np.linspace(0, 1, 4),
        one,
        one,
        axial_stiffness=[3.0, 1, 2, 2],
        torsional_stiffness=one,
        polar_inertia_per_length=[1.0, 4, 1, 1],
    ).with_attachments(an.PointMass(1 / 3, 0.3))
    proof = an.solve_modes(beam, 4, backend="numpy").prove()
    assert proof.proven, proof.sentence
    assert set(proof.regions) == {"bending", "longitudinal", "torsion"}


# --- and it can fail ------------------------------------------------


def test_a_list_that_the_solver_itself_does_not_vouch_for_is_never_proven_wrongly():
    """With a loss factor of 2 its secants meet one eigenvalue twice, and miss another."""
    result = solve(lossy(2.0), damping="complex")
    assert result.certificate["kind"] == "none"
    squares = -(np.array([m.eigenvalue_per_s for m in result.modes]) ** 2)
    exact = np.array([k**4 * (1 + 2j) for k in (1.8751040687, 4.6940911330, 7.8547574382)])
    right = np.all(np.min(np.abs(squares[:, None] - exact), axis=0) < 1e-6 * np.abs(exact))
    assert result.prove().proven <= bool(right)


@pytest.mark.parametrize("name", ["cantilever", "Beck past flutter", "a dashpot at the tip"])
@pytest.mark.parametrize("how", ["removed", "moved", "twice"])
def test_a_wrong_list_is_refuted(name, how):
    beam, settings = PROVEN[name]
    result = solve(beam, **settings)
    modes, wrong = list(result.modes), result.modes[2]
    if how == "removed":
        del modes[2]
    elif how == "twice":
        modes.insert(2, wrong)
    elif wrong.eigenvalue is not None:
        modes[2] = replace(wrong, eigenvalue=wrong.eigenvalue + 10 * wrong.error_per_s)
    else:
        modes[2] = replace(wrong, omega2=wrong.omega2 + 10 * wrong.error_omega2)
    proof = replace(result, modes=tuple(modes)).prove()
    assert proof.verdict == "refuted", proof.sentence
    assert not proof.to_dict()["balls"]
    assert proof.to_dict()["balls_reason"]


def damped_list():
    """A list in s about zero, with its function."""
    beam, _ = PROVEN["a dashpot at the tip"]
    result = solve(beam)
    listed = [Listed(m.name, m.eigenvalue, m.error_per_s) for m in result.modes]
    listed += [Listed(v.name, v.z.conjugate(), v.radius) for v in listed]
    damped = Damped(beam.chain("bending", 1))
    radius = result.certificate["region"]["abs_s_below"]
    return lambda: Characteristic(damped, "s", radius**2), radius, listed


def test_a_list_of_circles_is_refuted_by_counts_alone():
    make, radius, listed = damped_list()
    assert prove_list(make, 0.0, radius, listed).verdict == "proven"
    assert prove_list(make, 0.0, radius, listed[1:]).verdict == "refuted"
    assert prove_list(make, 0.0, radius, listed, zeros=1).verdict == "refuted"
    z, error = listed[1].z, listed[1].radius
    for step in (10 * error, 10j * error, -10 * error):
        moved = [Listed("bending 2", z + step, error), *listed[:1], *listed[2:]]
        outcome = prove_list(make, 0.0, radius, moved)
        assert outcome.verdict == "refuted"
        assert "bending 2" in outcome.reason


def test_a_root_on_the_edge_is_undecided():
    make, _, listed = damped_list()
    edge = abs(listed[1].z)
    assert prove_list(make, 0.0, edge, listed).verdict == "undecided"


def test_circles_count_as_many_as_they_hold():
    make, radius, listed = damped_list()
    disc = Disc(make, flint, 0.0, radius, 160)
    assert disc.zeros().zeros == len(listed)
    assert disc.zeros(listed[0].z, 1e-3).zeros == 1
    assert disc.zeros(0.1j, 1e-3).zeros == 0


# --- what is refused ------------------------------------------------


def test_what_varies_is_refused_in_one_sentence():
    beam = an.Beam.from_stations([0, 0.5, 1], [1, 2, 1], [1, 1, 1], interpolation="linear")
    with pytest.raises(an.InputError, match=r"from x = 0 to 0\.5 m.*approximation"):
        solve(beam).prove()


def test_loss_beside_dashpots_is_refused():
    beam, _ = PROVEN["a dashpot at the tip"]
    lossy = replace(beam, loss_factor=np.full((2, 2), 0.02))
    with pytest.raises(an.InputError, match="loss factors act beside dashpots"):
        solve(lossy).prove()


def test_a_scan_states_no_errors():
    with pytest.raises(an.InputError, match="method = 'riccati'"):
        solve(uniform(CLAMPED), method="tmm").prove()
