"""Masses, springs, supports and joints: each alone, all together, against Hermite elements."""

import math

import hermite
import numpy as np
import pytest
from scipy.linalg import eigh

from antinode import Beam, Ends, solve_modes
from antinode.beam.attachments import Joint, PointMass, Spring
from antinode.beam.axial import AxialLoads, apply_loads

ENDS = ("free", "clamped", "pinned", "sliding")
EACH = {
    "mass": PointMass(1.0, 2.0),
    "mass with inertia": PointMass(1.0, 2.0, 0.3),
    "offset mass": PointMass(1.0, 2.0, 0.1, 0.4),
    "mass offset to the left": PointMass(1.0, 2.0, 0.1, -0.4),
    "translational spring": Spring(1.0, 30.0),
    "rotational spring": Spring(1.0, rotational=30.0),
    "support": Spring(1.0, math.inf),
    "guide": Spring(1.0, rotational=math.inf),
    "clamp in the span": Spring(1.0, math.inf, math.inf),
    "joint": Joint(1.0, 0.2),
    "tip mass": PointMass(3.0, 2.0, 0.1, 0.4),
    "root spring": Spring(0.0, 20.0, 5.0),
    "support at the end": Spring(3.0, math.inf),
}


def beam(left, right, N=1.0):
    return Beam.from_stations(
        [0.0, 1.0, 1.7, 3.0], [1.0, 2.0, 1.5, 1], [4.0, 3.0, 6.0, 1], None, [N, -N / 2, N, 0],
        ends=Ends(left, right),
    )  # fmt: skip


def compare(problem, modes=6, rel=4e-6, elements=40):
    found = np.array([m.omega2 for m in solve_modes(problem, modes).family("bending")])
    other = hermite.eigenvalues(problem, len(found), elements)
    np.testing.assert_allclose(found, other, rtol=rel, atol=rel * abs(found[-1]) * 1e-2)


@pytest.mark.parametrize("name", EACH)
@pytest.mark.parametrize(("left", "right"), [(a, b) for a in ENDS for b in ENDS])
def test_each_alone(name, left, right):
    compare(beam(left, right).with_attachments(EACH[name]))


@pytest.mark.parametrize("seed", range(20))
def test_all_together(seed):
    rng = np.random.default_rng(seed)
    left, right = rng.choice(ENDS, 2)
    items = []
    for _ in range(rng.integers(2, 7)):
        x, kind = float(rng.choice([0.3, 1.0, 1.3, 2.2, 2.9])), rng.integers(5)
        a, b, c = rng.uniform(0.1, 3, 3)
        items.append(
            [
                PointMass(x, a, b * 0.1, c - 1.5),
                Spring(x, 10 * a, b),
                Spring(x, math.inf),
                Joint(x, 0.1 * a),
                Spring(x, a, math.inf if b > 2 else b),
            ][kind]
        )
    compare(beam(str(left), str(right), 3.0).with_attachments(*items))


def test_a_mass_is_the_limit_of_a_short_heavy_piece():
    plain = beam("clamped", "free", 0.0)
    h = 1e-5
    heavy = Beam.from_stations(
        [0.0, 1.0, 1.0 + h, 1.7, 3.0], [1.0, 2.0 / h, 2.0, 1.5, 1], [4.0, 3.0, 3.0, 6.0, 1], None,
        ends=Ends("clamped", "free"),
    )  # fmt: skip
    with_mass = plain.with_attachments(PointMass(1.0, 2.0))
    a, b = (solve_modes(problem, 4).frequencies_hz() for problem in (with_mass, heavy))
    np.testing.assert_allclose(a, b, rtol=3e-5)


def test_a_joint_is_the_limit_of_a_short_limp_piece():
    plain = beam("clamped", "free", 2.0)
    h, f = 1e-6, 0.3
    limp = Beam.from_stations(
        [0.0, 1.0 - h, 1.0, 1.7, 3.0], [1.0, 1.0, 2.0, 1.5, 1], [4.0, h / f, 3.0, 6.0, 1], None,
        [2.0, 2.0, -1.0, 2.0, 0], ends=Ends("clamped", "free"),
    )  # fmt: skip
    a, b = (
        solve_modes(problem, 4).frequencies_hz()
        for problem in (plain.with_attachments(Joint(1.0, f)), limp)
    )
    np.testing.assert_allclose(a, b, rtol=1e-5)


@pytest.mark.parametrize(
    ("items", "expected"),
    [
        ([], ["rigid translation", "rigid rotation"]),
        ([Spring(1.0, 5.0)], ["rigid rotation"]),
        ([Spring(1.0, rotational=5.0)], ["rigid translation"]),
        ([Spring(1.0, 5.0, 5.0)], []),
        ([Spring(1.0, 5.0), Spring(2.0, 5.0)], []),
        ([PointMass(1.0, 5.0), Joint(2.0, 1.0)], ["rigid translation", "rigid rotation"]),
        ([Spring(1.0, math.inf)], ["rigid rotation"]),
    ],
)
def test_a_spring_to_ground_removes_what_it_holds(items, expected):
    problem = beam("free", "free", 0.0).with_attachments(*items)
    modes = solve_modes(problem, 2).family("bending")
    rigid = [m for m in modes if m.number == 0]
    assert sorted(m.name for m in rigid) == sorted(expected)
    assert all(m.omega2 == 0.0 for m in rigid)
    assert [m.number for m in modes if m.number] == [1, 2]


def test_modal_mass_and_rayleigh_quotient_include_the_points():
    items = (PointMass(1.0, 2.0, 0.2, 0.3), Spring(2.2, 30.0, 4.0), Joint(1.5, 0.2))
    problem = beam("pinned", "free", 2.0).with_attachments(*items)
    result = solve_modes(problem, 8)
    assert max(m.residual for m in result.modes) < 1e-11


def test_internal_forces_jump_at_a_mass():
    problem = beam("clamped", "free", 0.0).with_attachments(PointMass(1.3, 2.0))
    result = solve_modes(problem, 2)
    k = int(np.flatnonzero(np.diff(result.x) == 0)[0])
    mode = result.modes[0]
    before, after = mode.states[k], mode.states[k + 1]
    np.testing.assert_allclose(before[:3], after[:3], rtol=1e-12)
    assert after[3] - before[3] == pytest.approx(mode.omega2 * 2.0 * before[0], rel=1e-10)


def test_longitudinal_mass_spring_and_joint():
    """A massive chain: omega^2 against a lumped limit and the closed form of a bar with a mass."""
    bar = Beam.from_stations([0.0, 1.0], 1.0, 1.0, 1.0, ends=Ends("clamped", "free"))
    with_mass = bar.with_attachments(PointMass(1.0, 1.0))  # beta tan beta = 1
    first = solve_modes(with_mass, 1).family("longitudinal")[0]
    assert math.sqrt(first.omega2) == pytest.approx(0.860333589019380, rel=1e-12)
    sprung = bar.with_attachments(Spring(1.0, axial=1.0))  # beta cot beta = -1
    first = solve_modes(sprung, 1).family("longitudinal")[0]
    assert math.sqrt(first.omega2) == pytest.approx(2.028757838110434, rel=1e-12)
    jointed = bar.with_attachments(Joint(1e-9, axial=1.0))  # root spring 1: beta tan beta = 1
    first = solve_modes(jointed, 1).family("longitudinal")[0]
    assert math.sqrt(first.omega2) == pytest.approx(0.860333589019380, rel=1e-8)
    held = bar.with_attachments(Spring(0.5, axial=math.inf))
    values = [m.omega2 for m in solve_modes(held, 3).family("longitudinal")]
    np.testing.assert_allclose(np.sqrt(values), [math.pi, 2 * math.pi, 3 * math.pi], rtol=1e-12)


@pytest.mark.parametrize("offset", [0.3, -0.3])
@pytest.mark.parametrize("gravity", [-2.0, 2.0])
def test_the_weight_of_an_offset_mass_acts_as_at_the_end_of_a_rigid_arm(offset, gravity):
    """A rigid massless arm with the mass at its end needs no term for the offset's weight.

    The arm is a very stiff, very light end piece; an offset toward the beam is one of a beam that
    is cut back, so that the arm stands where the beam was.
    """
    base = Beam.from_stations([0.0, 1.0], 1.0, 3.0, 1e6, ends=Ends("clamped", "free"))
    mass = PointMass(1.0, 0.8, 0.02, offset)
    loaded = apply_loads(base.with_attachments(mass), AxialLoads(gravity=gravity))
    found = solve_modes(loaded, 3, tolerance=1e-9).frequencies_hz()
    K, M = arm_matrices(offset, gravity)
    omega2 = eigh(K, M, eigvals_only=True, subset_by_index=[0, 2])
    np.testing.assert_allclose(found, np.sqrt(omega2) / (2 * math.pi), rtol=5e-5)


def arm_matrices(offset, gravity, n=60):
    """Hermite elements whose last node carries a rigid arm; the potential of its weight by hand.

    The mass sits at (x + d cos theta, Y + d sin theta); the force F = m g along +x has the
    potential -F (x + d cos theta), that is +F d theta^2/2 to second order.
    """
    m_p, J, F = 0.8, 0.02, 0.8 * gravity
    K, M = np.zeros((2 * n + 2, 2 * n + 2)), np.zeros((2 * n + 2, 2 * n + 2))
    for e in range(n):
        index = slice(2 * e, 2 * e + 4)
        ahead = (1 - (e + 0.5) / n) * gravity + F  # force along +x on all that lies beyond
        k, m = hermite.element(1 / n, 1.0, 3.0, -ahead)
        K[index, index] += k
        M[index, index] += m
    tip = slice(2 * n, 2 * n + 2)
    M[tip, tip] += [[m_p, m_p * offset], [m_p * offset, m_p * offset**2 + J]]
    K[-1, -1] += F * offset
    return K[2:, 2:], M[2:, 2:]


@pytest.mark.parametrize("backend", ["numpy", "numba"])
@pytest.mark.parametrize("turned", [False, True])
def test_rotary_inertia_of_a_heavy_mass_off_its_node(backend, turned):
    """J = 1e-3 beside m d^2 = 9e7: f2 = 1.58856627550 Hz in 40 digits, a turn about the centre."""
    beam = Beam.from_stations([0.0, 1.0], 1.0, 1.0, ends=Ends("clamped", "free"))
    beam = beam.with_attachments(PointMass(1.0, 1e9, rotary_inertia=1e-3, offset=0.3))
    beam = beam.reversed() if turned else beam
    result = solve_modes(beam, 4, backend=backend)
    second = result.modes[1]
    assert abs(second.frequency_hz - 1.58856627550) <= second.error_hz + 5e-12
    assert second.error_hz < 1e-9
    assert second.residual < 1e-9
