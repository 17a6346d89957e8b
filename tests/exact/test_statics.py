"""Axial statics, buckling and static deflection against closed forms and other methods."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import jv

from antinode import Beam, Ends, InputError, solve_modes
from antinode.beam.attachments import Joint, PointMass, Spring
from antinode.beam.axial import AxialLoads, PointForce, apply_loads
from antinode.modes.buckling import buckling
from antinode.vehicle.statics import _slope

G = 9.80665


def column(left="clamped", right="free", EA=2e6):
    return Beam.from_stations([0.0, 4.0, 10.0], [2.0, 3.0, 0], 1e4, EA, ends=Ends(left, right))


def N_at(beam, x):
    k = np.clip(np.searchsorted(beam.x, x, side="right") - 1, 0, len(beam.x) - 2)
    return beam.axial_force_at(k, (x - beam.x[k]) / np.diff(beam.x)[k])


def test_a_tower_carries_its_weight_at_the_base():
    tower = column().with_attachments(PointMass(10.0, 5.0))
    loaded = apply_loads(tower, AxialLoads(gravity=-G))
    x = np.array([0.0, 4.0, 7.0, 10.0 - 1e-12])
    above = np.array([8.0 + 18 + 5, 18 + 5, 9 + 5, 5.0])
    np.testing.assert_allclose(N_at(loaded, x), above * G, rtol=1e-9)


def test_a_hanging_beam_is_in_tension():
    loaded = apply_loads(column("free", "clamped"), AxialLoads(gravity=-G))
    np.testing.assert_allclose(N_at(loaded, np.array([0.0, 7.0])), [0.0, -17 * G], atol=1e-9)


def test_point_forces_and_reactions():
    forces = (PointForce(10.0, -100.0), PointForce(5.0, 30.0))
    loaded = apply_loads(column(), AxialLoads(point_forces=forces))
    np.testing.assert_allclose(N_at(loaded, np.array([1.0, 6.0])), [70.0, 100.0], rtol=1e-12)


def test_a_rocket_accelerates_and_its_inertia_closes_the_balance():
    """Thrust toward -x at the tail: N grows from zero at the nose to the thrust."""
    rocket = column("free", "free").with_attachments(PointMass(10.0, 5.0))
    loaded = apply_loads(rocket, AxialLoads(point_forces=(PointForce(10.0, -3100.0),)))
    assert loaded.axial_acceleration == pytest.approx(100.0)
    x = np.array([0.0, 4.0, 10.0 - 1e-12])
    np.testing.assert_allclose(N_at(loaded, x), [0.0, 800.0, 2600.0], rtol=1e-9, atol=1e-9)


def test_a_beam_fixed_at_both_ends_shares_by_EA():
    """u(L) = 0: integral of N/EA vanishes; one force in a uniform bar splits by the lever rule."""
    bar = Beam.from_stations([0.0, 10.0], 1.0, 1e4, 2e6, ends=Ends("clamped", "clamped"))
    loaded = apply_loads(bar, AxialLoads(point_forces=(PointForce(4.0, 100.0),)))
    np.testing.assert_allclose(N_at(loaded, np.array([1.0, 9.0])), [-60.0, 40.0], rtol=1e-12)


def test_springs_and_joints_share_the_load():
    """Force at x = 4 between a fixed end and an axial spring, with an axial joint: hand statics.

    Compliances: 4/EA left of the force; 6/EA + joint + 1/k right of it.
    """
    EA, k, f = 2e6, 1e5, 3e-6
    bar = Beam.from_stations(
        [0.0, 10.0], 1.0, 1e4, EA, ends=Ends("clamped", "free")
    ).with_attachments(Spring(10.0, axial=k), Joint(7.0, axial=f))
    loaded = apply_loads(bar, AxialLoads(point_forces=(PointForce(4.0, 100.0),)))
    left, right = 4 / EA, 6 / EA + f + 1 / k
    expected = [-100 * right / (left + right), 100 * left / (left + right)]
    np.testing.assert_allclose(N_at(loaded, np.array([1.0, 9.0])), expected, rtol=1e-12)


def test_wrong_loads():
    with pytest.raises(InputError, match="off the beam"):
        apply_loads(column(), AxialLoads(point_forces=(PointForce(11.0, 1.0),)))
    with pytest.raises(InputError, match="nothing holds the beam"):
        apply_loads(column("free", "free"), AxialLoads(acceleration=1.0))
    with pytest.raises(InputError, match="axial_stiffness is missing"):
        apply_loads(column("clamped", "clamped", None), AxialLoads(gravity=1.0))


@pytest.mark.parametrize(
    ("left", "right", "factor"),
    [
        ("pinned", "pinned", 1.0),
        ("clamped", "free", 0.25),
        ("clamped", "clamped", 4.0),
        ("sliding", "pinned", 0.25),
        ("free", "free", 1.0),
        ("clamped", "sliding", 1.0),
    ],
)
def test_euler_columns(left, right, factor):
    beam = Beam.from_stations([0.0, 1.0], 1.0, 1.0, None, 2.0, ends=Ends(left, right))
    found = buckling(beam)
    assert found.load_factor == pytest.approx(factor * math.pi**2 / 2, rel=1e-10)
    assert found.bracket[0] <= found.load_factor <= found.bracket[1]


def test_a_column_under_its_own_weight():
    """Greenhill (1881): q L^3/(EI) = 9/4 j^2, j the first zero of the Bessel function J_-1/3."""
    from scipy.optimize import brentq

    j = brentq(lambda z: jv(-1 / 3, z), 1.5, 2.2, xtol=1e-15)
    one = Beam.from_stations([0.0, 1.0], 1.0, 1.0, None, ends=Ends("clamped", "free"))
    found = buckling(apply_loads(one, AxialLoads(gravity=-1.0)), 1e-9)
    assert found.load_factor == pytest.approx(9 / 4 * j**2, rel=1e-9)
    assert abs(found.load_factor - 9 / 4 * j**2) <= found.error


def test_buckling_agrees_with_the_frequency_that_vanishes():
    one = Beam.from_stations(
        [0.0, 1.0, 3.0], [1, 2, 2], [1, 3, 3], None, [1, 2, 2], ends=Ends("pinned", "clamped")
    )
    beam = one.with_attachments(Spring(2.0, 3.0))
    critical = buckling(beam).load_factor
    for factor, kind in ((0.9999, "elastic"), (1.0001, "divergent")):
        loaded = replace(beam, axial_force=factor * critical * beam.axial_force)
        assert solve_modes(loaded, 1).mode("bending", 1).kind == kind


def test_a_beam_in_tension_does_not_buckle():
    assert buckling(Beam.from_stations([0.0, 1.0], 1.0, 1.0, None, -2.0)) is None


@pytest.mark.parametrize("theory", ["timoshenko", "euler_bernoulli"])
def test_static_deflection_against_modal_superposition(tmp_path, theory):
    """Forty modes of the loaded beam carry the loads; rigid motion is removed from both."""
    from antinode.examples import write_example
    from antinode.vehicle.case import load_case
    from antinode.vehicle.statics import _rigid_part, static_shape

    write_example("starter", tmp_path)
    case = load_case(
        tmp_path / "case.toml", ["model.end_force=fixed_direction", f"model.theory={theory}"]
    )
    shape, loads = static_shape(case), case.loads
    result = solve_modes(case, 40, families=("bending",))
    p, w = np.polynomial.legendre.leggauss(3)
    h = np.diff(shape.x)[:, None]
    x, weight = (shape.x[:-1, None] + h * (p + 1) / 2).ravel(), (h * w / 2).ravel()
    bounds = loads.mass_distribution.between(shape.x)
    m = np.repeat(bounds.mean(axis=1), 3)
    load = -m * (loads.a_Y + loads.gravity + (loads.x_M - x) * loads.beta)
    Y, at = result.at(x)[..., 0], result.at(shape.x)[..., 0]
    u = np.zeros(len(shape.x))
    for i, mode in enumerate(result.modes):
        if mode.omega2 != 0.0:
            work = np.sum(load * Y[:, i] * weight)
            work += sum(f.F_Y * result.at([f.x])[0, i, 0] for f in loads.forces)
            u += work / (mode.omega2 * mode.modal_mass) * at[:, i]
    mean, turn = _rigid_part(case, shape.x, u)
    u -= mean + turn * (shape.x - loads.x_M)
    most = np.max(np.abs(shape.lateral))
    sheared = theory == "timoshenko"  # the sum converges more slowly, to a slope that jumps
    assert np.max(np.abs(u - shape.lateral)) < (4e-4 if sheared else 1e-4) * most
    other = "euler_bernoulli" if sheared else "timoshenko"
    chosen = ["model.end_force=fixed_direction", f"model.theory={other}"]
    away = static_shape(load_case(tmp_path / "case.toml", chosen)).lateral - shape.lateral
    assert np.max(np.abs(away)) > 4e-3 * most
    assert abs(shape.moment[-1]) < 1e-9 * np.max(np.abs(shape.moment))
    assert shape.axial[0] == 0.0
    assert np.all(np.diff(shape.axial) < 0)  # compression: everything moves toward the nose


def test_static_deflection_without_axial_force_is_the_integral_of_the_moment(tmp_path):
    """T = 0 and a cavity far too slow to matter is hard to arrange; scale N away instead."""
    from antinode.examples import write_example
    from antinode.vehicle.case import load_case

    write_example("starter", tmp_path)
    case = load_case(tmp_path / "case.toml")
    x = np.linspace(0, 6, 3001)
    Q = case.loads.shear_force(x, "right")[:-1], case.loads.shear_force(x, "left")[1:]
    h = np.diff(x)
    theta, moment = _slope(h, 0 * h, 1e-6 + 0 * h, *Q)
    expected = case.loads.bending_moment(x)
    assert np.max(np.abs(moment - expected)) < 1e-3 * np.max(np.abs(expected))
    assert theta[0] == 0.0


@pytest.mark.parametrize("compliance", [0.0, 1e-6, 1e-5, 1e-3])
def test_a_joint_in_the_middle_leaves_gravity_symmetric(compliance):
    bar = Beam.from_stations([0.0, 2.0], 10.0, 1e4, 1e6, ends=Ends("clamped", "clamped"))
    bar = bar.with_attachments(Joint(1.0, rotational=1e-9, axial=compliance))
    loaded = apply_loads(bar, AxialLoads(gravity=100.0))
    np.testing.assert_allclose(N_at(loaded, np.array([0, 1, 2 - 1e-12])), [-1e3, 0, 1e3], atol=1e-6)


def test_a_joint_off_the_middle_under_gravity():
    """Fixed ends, u(L) = 0: N = 10 g x - R, so R (L/EA + f) = 10 g (L^2/(2 EA) + f x_j)."""
    EA, L, f, x, weight = 1e6, 2.0, 1e-5, 0.5, 1e3
    bar = Beam.from_stations([0.0, L], 10.0, 1e4, EA, ends=Ends("clamped", "clamped"))
    loaded = apply_loads(bar.with_attachments(Joint(x, axial=f)), AxialLoads(gravity=weight / 10))
    reaction = weight * (L**2 / (2 * EA) + f * x) / (L / EA + f)
    assert N_at(loaded, np.array([0.0]))[0] == pytest.approx(-reaction, rel=1e-12)


@pytest.mark.parametrize(("force", "left", "right"), [(0.5, -500, 0), (1.5, 0, 2e4 / 22)])
def test_a_support_at_a_joint_stands_on_its_left(force, left, right):
    bar = Beam.from_stations([0.0, 2.0], 10.0, 1e4, 1e6, ends=Ends("clamped", "clamped"))
    bar = bar.with_attachments(Joint(1.0, axial=1e-5), Spring(1.0, axial=math.inf))
    loaded = apply_loads(bar, AxialLoads(point_forces=(PointForce(force, 1000.0),)))
    ends = N_at(loaded, np.array([0.0, 2 - 1e-12]))
    # right of it 0.5/EA + f share the load with 0.5/EA: 10.5 to 0.5 of 11
    np.testing.assert_allclose(ends, [left, right * 10.5 / 10], atol=1e-8)


@pytest.mark.parametrize("ratio", [0.01, 0.3, 1 + 1e-5, 30.0, 1e3, 1e6])
def test_a_steep_linear_EA_shares_by_its_logarithm(ratio):
    a, L, F = 1e6 * ratio, 4.0, 30.0
    bar = Beam.from_stations(
        [0, L], 1.0, 10.0, [a, 1e6], interpolation="linear", ends=Ends("clamped", "clamped")
    )
    loaded = apply_loads(bar, AxialLoads(point_forces=(PointForce(1.0, F),)))
    middle = a + (1e6 - a) / L
    left, right = np.log(middle / a), np.log(1e6 / middle)
    N = N_at(loaded, np.array([0.0, 3.0]))
    exact = [-F * right / (left + right), F * left / (left + right)]
    np.testing.assert_allclose(N, exact, rtol=1e-9 if abs(ratio - 1) < 1e-3 else 1e-12)


def test_a_mass_above_its_support_buckles_a_beam_in_tension():
    """A cantilever drawn by a weight P that stands 3 L back from its tip: 3 k L tanh(k L) = 1."""
    beam = Beam.from_stations([0.0, 1.0], 1e-3, 1.0, ends=Ends("clamped", "free"))
    beam = beam.with_attachments(PointMass(1.0, 1.0, offset=-3.0))
    loaded = apply_loads(beam, AxialLoads(gravity=1.0))
    k = brentq(lambda k: 3 * k * math.tanh(k) - 1, 0.1, 1)
    light = beam.with_attachments()
    assert solve_modes(loaded, 1).modes[0].kind == "divergent"
    assert solve_modes(light, 1).modes[0].kind == "elastic"
    # the beam's own 1e-3 of the weight draws too
    assert buckling(loaded).load_factor == pytest.approx(k**2, rel=1e-3)
    assert buckling(apply_loads(light, AxialLoads(gravity=-1.0))) is not None


def test_a_free_beam_in_net_tension_buckles_where_its_compressed_middle_does():
    N = np.repeat([[-2.0], [1.0], [-2.0]], 2, axis=1)
    beam = replace(Beam.from_stations([0, 1, 2, 3], 1.0, 1.0), axial_force=N)
    critical = buckling(beam).load_factor
    signs = [
        min(m.omega2 for m in solve_modes(replace(beam, axial_force=f * N), 2).modes)
        for f in (critical * 0.999, critical * 1.001)
    ]
    assert signs[0] >= 0 > signs[1]
    beyond = solve_modes(replace(beam, axial_force=2 * critical * N), 2)
    assert any("compressed in parts" in text for text in beyond.warnings)
    assert not any("net compression" in text for text in beyond.warnings)


@pytest.mark.parametrize("shear_form", ["haringx", "engesser"])
def test_static_deflection_with_shear_of_a_uniform_body_under_constant_force(shear_form):
    """N and Q constant over a short body: theta and u in closed form.

    ``M' = alpha Q - beta theta`` and ``theta' = M/EI`` with M = 0 at both ends give
    ``theta = alpha Q/beta``, and ``u' = (alpha^2/beta - s) Q = Q/N`` for either form.
    """
    shear = {"engesser": lambda kGA, N: 1 / (kGA - N), "haringx": lambda kGA, N: 1 / kGA}
    EI, kGA, N, Q, h, n = 2.0, 30.0, 7.0, 0.4, 0.01, 100
    s = shear[shear_form](kGA, N)
    alpha, beta = 1 + s * N, N + s * N**2
    whole = np.full(n, alpha * Q)
    theta, M = _slope(np.full(n, h), np.full(n, beta), np.full(n, 1 / EI), whole, whole)
    assert theta == pytest.approx(alpha * Q / beta, rel=1e-12)
    assert pytest.approx(0, abs=1e-12) == M
    assert alpha * theta - s * Q == pytest.approx(Q / N, rel=1e-12)
