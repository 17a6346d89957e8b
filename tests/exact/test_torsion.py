"""Torsion: closed forms, a benchmark, a drill string, and counts by the oscillation theorem."""

import itertools
import math

import numpy as np
import pytest
from mpmath import mp, mpf

from antinode import Beam, Ends, solve_modes
from antinode.beam.attachments import Joint, PointMass, Spring
from antinode.riccati.chain import count_below
from antinode.riccati.points import Point
from law_chains import shaft_chain

FOOT, POUND_FORCE = 0.3048, 4.4482216152605
TORSION = {"families": ["torsion"]}


def shaft(length, GJ, inertia, left="free", right="free", **more):
    x = np.atleast_1d(np.append(0.0, length))
    ends = Ends("free", "free", left_torsion=left, right_torsion=right)
    return Beam.from_stations(
        x, 1.0, 1.0, torsional_stiffness=GJ, polar_inertia_per_length=inertia, ends=ends, **more
    )


def omega(beam, modes, **more):
    found = [m for m in solve_modes(beam, modes, **TORSION, **more).modes if m.number]
    assert all(m.error_omega2 < 1e-9 * m.omega2 for m in found)
    return np.sqrt([m.omega2 for m in found])


@pytest.mark.parametrize(("left", "right"), list(itertools.product(["free", "fixed"], repeat=2)))
def test_uniform_shafts(left, right):
    L, GJ, inertia = 3.0, 2.5e4, 0.4
    n = np.arange(1, 13) - (0.5 if left != right else 0.0)
    exact = n * math.pi / L * math.sqrt(GJ / inertia)
    assert omega(shaft(L, GJ, inertia, left, right), 12) == pytest.approx(exact, rel=1e-12)


def test_the_deep_beam_of_nafems():
    """FV5 (NAFEMS R0015): 71.20 and 213.61 Hz published, square section, one end held."""
    a, L, E, rho = 2.0, 10.0, 200e9, 8000.0
    J, G = 0.140577014955 * a**4, E / 2.6
    beam = Beam.from_stations(
        [0, L],
        rho * a**2,
        E * a**4 / 12,
        torsional_stiffness=G * J,
        polar_inertia_per_length=rho * a**4 / 6,
        ends=Ends("pinned", "pinned", left_torsion="fixed"),
    )
    hz = omega(beam, 2) / (2 * math.pi)
    assert hz == pytest.approx([71.1960866, 213.58826], rel=5e-9)
    assert hz == pytest.approx([71.20, 213.61], rel=2e-4)


def test_a_drill_string_with_its_collars_at_the_bit():
    """Thomson's string of 5,000 ft: beta tan beta = rho I_p L / J_0, in feet and pounds."""
    L, GIp, rho_Ip = 5000 * FOOT, 1.728e9 * 9.4e-4, 15.22 * 9.4e-4  # lbf ft^2, slug ft
    slug_ft = POUND_FORCE  # [kg m]: lbf s^2
    beam = shaft(L, GIp * POUND_FORCE * FOOT**2, rho_Ip * slug_ft, "fixed", "free")
    beam = beam.with_attachments(PointMass(L, 1.0, polar_inertia=29.3 * POUND_FORCE * FOOT))
    assert omega(beam, 3) == pytest.approx([2.41974858, 7.93204434, 14.1411150], rel=5e-9)


def test_a_stepped_shaft_against_its_characteristic_equation():
    """Fixed - free, two parts: tan(b1 l1) tan(b2 l2) = K1 b1 / (K2 b2)."""
    (l1, l2), K, inertia = (1.2, 0.7), (3e5, 4e4), (0.9, 0.15)
    beam = shaft([l1, l1 + l2], [K[0], K[1], K[1]], [*inertia, inertia[1]], "fixed", "free")
    for w in omega(beam, 8):
        b1, b2 = (w * math.sqrt(i / k) for i, k in zip(inertia, K, strict=True))
        c1, c2, s1, s2 = (
            f(b * ell) for f in (math.cos, math.sin) for b, ell in ((b1, l1), (b2, l2))
        )
        assert K[0] * b1 * c1 * c2 == pytest.approx(K[1] * b2 * s1 * s2, abs=1e-9 * K[0] * b1)


def test_two_discs_on_a_light_shaft():
    """omega^2 = k (1/J1 + 1/J2) with 1/k = L/GJ + f, once the shaft itself weighs nothing."""
    L, GJ, J1, J2, f = 2.0, 8e3, 5.0, 11.0, 1e-4
    beam = shaft(L, GJ, 1e-6).with_attachments(
        PointMass(0.0, 1.0, polar_inertia=J1),
        PointMass(L, 1.0, polar_inertia=J2),
        Joint(1.3, torsional=f),
    )
    exact = math.sqrt((1 / J1 + 1 / J2) / (L / GJ + f))
    assert omega(beam, 1) == pytest.approx([exact], rel=1e-7)
    result = solve_modes(beam, 1, **TORSION)
    assert [m.name for m in result.modes] == ["rigid axial rotation", "torsion 1"]
    left, right = result.modes[1].states[[0, -1]]
    assert right[0] / left[0] == pytest.approx(-J1 / J2, rel=1e-6)  # they swing against each other
    inside = result.at(np.array([0.5]), "torsion")[0, 1]
    assert inside[1] / left[0] == pytest.approx(-(exact**2) * J1, rel=1e-6)  # T holds the disc back


def test_a_torsional_spring_and_a_support_between():
    """beta tan beta = k L / GJ at the spring; the support parts the shaft in two."""
    L, GJ, inertia, k = 1.0, 1.0, 1.0, 2.0
    beam = shaft(2 * L, GJ, inertia).with_attachments(
        Spring(L, torsional=math.inf), Spring(2 * L, torsional=k)
    )
    found = omega(beam, 4)
    plain = [math.pi / 2, 1.5 * math.pi]
    assert found[[0, 2]] == pytest.approx(plain, rel=1e-12)
    for b in found[[1, 3]]:  # held at one end, spring at the other: beta cot beta = -k
        assert b * math.cos(b) == pytest.approx(-k * math.sin(b), abs=1e-10)


@pytest.mark.parametrize("how", ["linear", "log"])
def test_tapered_shafts_meet_their_tolerance(how):
    x = np.array([0.0, 2.0, 3.5])
    beam = shaft(x[1:], [3e5, 1e4, 2e4], [0.9, 0.1, 0.3], "fixed", "free", interpolation=how)
    fine = solve_modes(beam, 6, tolerance=1e-11, **TORSION).frequencies_hz("torsion")
    for tolerance in (1e-4, 1e-7):
        result = solve_modes(beam, 6, tolerance=tolerance, **TORSION)
        error = np.array([m.error_hz for m in result.modes])
        assert np.all(np.abs(result.frequencies_hz("torsion") - fine) <= error + 1e-10 * fine)
        assert np.all(error <= tolerance * fine)


def test_an_inertia_is_linear_where_stiffness_is_logarithmic():
    beam = shaft(2.0, [1.0, 4.0], [1.0, 4.0], interpolation="log")
    half = (np.array([0]), np.array([0.5]))
    assert beam.column_at("torsional_stiffness", *half) == pytest.approx([2.0])
    assert beam.column_at("polar_inertia_per_length", *half) == pytest.approx([2.5])


# --- counts ----------------------------------------------------------------------------------


def draw(seed):
    """A random chain with discs, springs and joints, and omega^2 around its eigenvalues."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 60))
    length = 10.0 ** rng.uniform(-1.5, 0.5, n)
    inertia, GJ = 10.0 ** rng.uniform(-2, 2, (2, n))
    points = []
    for node in range(n + 1):
        if rng.random() < 0.3:
            disc, spring = rng.choice([0.0, 1.0], 2) * 10.0 ** rng.uniform(-2, 2, 2)
            inside = 0 < node < n
            give = float(rng.choice([0.0, 1.0]) * 10.0 ** rng.uniform(-2, 1)) if inside else 0.0
            points.append(Point(node, mass=disc, spring=spring, compliance=give))
    left, right = rng.choice(["free", "fixed"], 2)
    chain = shaft_chain(length, inertia, GJ, left, right, tuple(points))
    phase = 10.0 ** rng.uniform(-1, 2)
    return chain, (phase / np.sum(length * np.sqrt(inertia / GJ))) ** 2


def oscillation_count(chain, omega2):
    """Eigenvalues below omega^2 > 0 by the angle of (phi, T): it only grows, past every zero."""
    at = {point.node: point for point in chain.points}
    w2 = mpf(float(omega2))
    angle, half = (mp.pi / 2 if chain.left == "free" else mpf(0)), mp.pi / 2
    for k in range(len(chain.length) + 1):
        if (point := at.get(k)) is not None:
            angle = _past(point, angle, w2)
        if k < len(chain.length):
            h, inertia, GJ = (mpf(float(v[k])) for v in (chain.length, chain.mass, chain.stiffness))
            beta = mp.sqrt(w2 * inertia / GJ)
            scale = GJ * beta
            angle = _turned(angle, mp.sin(angle), mp.cos(angle) / scale) + beta * h
            angle = _turned(angle, mp.sin(angle), mp.cos(angle) * scale)
    if chain.right == "fixed":
        return max(0, int(mp.ceil(angle / mp.pi)) - 1)
    return max(0, int(mp.ceil((angle - half) / mp.pi)))


def _past(point, angle, w2):
    """Return the angle behind a disc with its spring, and behind a joint.

    A disc changes T alone and keeps the sign of phi, a joint changes phi and keeps that of T.
    """
    phi, T = mp.sin(angle), mp.cos(angle)
    T2 = T + (mpf(point.spring) - w2 * mpf(point.mass)) * phi
    turns = mp.floor(angle / mp.pi)
    behind = mp.atan2(phi, T2) if phi else angle - turns * mp.pi
    behind = behind % mp.pi if phi else behind
    angle = turns * mp.pi + behind
    phi, T = mp.sin(angle), mp.cos(angle)
    if point.compliance and T:
        turns = mp.floor(angle / mp.pi + mpf(1) / 2)
        angle = turns * mp.pi + mp.atan((phi + mpf(point.compliance) * T) / T)
    return angle


def _turned(angle, phi, T):
    """Return the angle of (phi, T) in the quadrant of another one."""
    turns = mp.floor(angle / (2 * mp.pi))
    return 2 * mp.pi * turns + mp.atan2(phi, T) % (2 * mp.pi)


def test_counts_of_300_random_shafts():
    with mp.workdps(40):
        for seed in range(300):
            chain, omega2 = draw(seed)
            found = int(count_below(chain, [omega2])[0])
            assert found == oscillation_count(chain, omega2), seed
