"""Deflection against clearance, EI u'' beside M, balance, drag: what `loads` says of them."""

import csv
import json

import numpy as np
import pytest

from antinode import load_case, solve_modes
from antinode.vehicle.case import Case
from antinode.vehicle.loads import compute_loads
from antinode.vehicle.options import Model
from antinode.vehicle.statics import deflection_warnings, static_shape
from cli_run import run
from vehicles import condition, vehicle


@pytest.fixture(params=["starter", "paper"])
def folder(request, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert run("init", "--example", request.param).code == 0
    return tmp_path


def case(
    stiffer=1.0, radius=(0.04, 0.1, 0.17, 0.19, 0.19, 0.19, 0.19), theory="timoshenko", **values
):
    body = vehicle(bending_stiffness=[4e5 * stiffer] * 7, radius=radius)
    model = Model(end_force="fixed_direction", theory=theory)
    return Case(vehicle=body, condition=condition(**values), model=model)


def told(problem):
    return " ".join(deflection_warnings(problem, static_shape(problem)))


def clearance(problem, points=200_001):
    """The largest distance to the cavity of a circle about its own axis, by trying everywhere."""
    hole = problem.loads.cavity
    x = np.linspace(0, min(problem.vehicle.length, hole.L_c), points)
    return np.max(hole.radius(x) - abs(hole.axis_offset(x)) - problem.vehicle.radius_at(x))


@pytest.mark.parametrize("stiffer", [0.6, 1, 3, 10, 100])
@pytest.mark.parametrize("speed", [60, 80, 110])
def test_a_deflection_beyond_the_clearance_is_said(stiffer, speed):
    problem = case(stiffer, speed=speed, thrust=2e4)
    most, room = np.max(np.abs(static_shape(problem).lateral)), clearance(problem)
    text = told(problem)
    assert ("beyond the clearance" in text) == (most > room)
    if text:
        assert f"up to {most:.3g} m" in text
        assert f"at most {room:.3g} m" in text
        assert "undeformed body" in text


def test_both_verdicts_occur():
    assert told(case(0.6, thrust=2e4))
    assert not told(case(100, thrust=2e4))


def test_without_a_cavity_along_it_the_body_itself_is_the_measure():
    problem = case(0.6, [0.19] * 7, thrust=0, cavitation_number=0.1)
    assert clearance(problem) < 0
    assert "beyond the body's radius of 0.19 m" in told(problem)


@pytest.mark.parametrize("thrust", [0, 5e4, 1.5e5, 2.5e5, 4e5, 9e5])
@pytest.mark.parametrize("speed", [60, 200])
def test_diverging_directions_are_the_modes_that_diverge(thrust, speed):
    problem = case(thrust=thrust, speed=speed)
    result = solve_modes(problem, 4, families=["bending"])
    shape = static_shape(problem)
    assert shape.diverging == sum(mode.kind == "divergent" for mode in result.modes)
    buckled = any(mode.kind == "divergent" and mode.number for mode in result.modes)
    assert ("past buckling" in told(problem)) == buckled


def test_the_moment_on_the_bent_axis_is_EI_times_its_curvature():
    """Beside that of the loads, which is smaller where N compresses; in shear, of the turn."""
    problem = case(thrust=4e4, theory="euler_bernoulli")
    inside = slice(5, -5)
    for each in (problem, case(thrust=4e4)):
        shape = static_shape(each)
        turn = np.gradient(shape.lateral, shape.x) if each is problem else shape.slope
        curvature = np.gradient(turn, shape.x)
        np.testing.assert_allclose(
            4e5 * curvature[inside], shape.moment[inside], atol=5e-3 * np.max(np.abs(shape.moment))
        )
    M = problem.loads.bending_moment(shape.x)
    assert np.max(np.abs(shape.moment)) > 1.1 * np.max(np.abs(M))


def test_both_moments_and_what_the_deflection_is_measured_from_are_shown(folder):
    out = run("loads", "case.toml").out
    text = " ".join(out.split())
    assert "M [kN m] EI u'' [kN m] u_Y [mm] u_X [mm]" in text
    assert "u_Y: static deflection, up, from the mean axis" in text
    assert "u_X: static displacement, aft, from the nose" in text
    assert "is beyond the clearance" in text
    data = json.loads(run("loads", "case.toml", "--json", "-o", "loads.csv").out)
    problem = load_case("case.toml")
    shape = static_shape(problem)
    internal = data["internal"]
    np.testing.assert_allclose(
        internal["M_bent_N_m"], np.interp(internal["x_m"], shape.x, shape.moment)
    )
    assert "mean axis" in data["meanings"]["u_Y"]
    assert any("beyond the clearance" in warning for warning in data["warnings"])
    with (folder / "loads.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [float(row["M_bent [N m]"]) for row in rows] == internal["M_bent_N_m"]
    assert [row["x [m]"] for row in rows][-1] == "6.0"


@pytest.mark.parametrize("command", ["loads", "modes"])
def test_the_headline_says_what_is_out_of_balance(folder, command):
    text = " ".join(run(command, "case.toml", "--set", "condition.extra_drag=7kN").out.split())
    loads = load_case("case.toml", ["condition.extra_drag=7kN"]).loads
    assert f"{loads.a_Y:.3g} m/s^2 up, {loads.beta:.3g} rad/s^2 nose-up" in text
    assert "not in balance" in text
    assert "extra 7 kN" in text
    assert "above thrust" not in text


@pytest.mark.parametrize("thrust", ["0 kN", "10 kN"])
def test_drag_above_thrust_is_said(folder, thrust):
    text = " ".join(run("modes", "case.toml", "--set", f"condition.thrust={thrust}").out.split())
    loads = load_case("case.toml", [f"condition.thrust={thrust}"]).loads
    assert f"drag {sum(f.F_X for f in loads.forces) / 1e3:.4g} kN is above thrust" in text
    assert "extra" not in text


def test_balance_is_judged_along_the_whole_body():
    """Without gravity, lift and planing nothing acts across; a turn alone is no balance either."""
    from antinode.vehicle.condition import Water
    from antinode.vehicle.options import Model

    still = condition(cavitator_angle=0, cavitation_number=0.015)
    rest = Water(gravity=0), Model(planing="none")
    loads = compute_loads(vehicle(), still, *rest)
    assert loads.is_balanced
    assert "balance:" not in loads.unbalanced
    turning = compute_loads(vehicle(), still.model_copy(update={"cavitator_angle": 0.1}), *rest)
    assert abs(turning.a_Y) < 1 < turning.largest_lateral_acceleration
    assert not turning.is_balanced
    assert "not in balance" in str(turning)
