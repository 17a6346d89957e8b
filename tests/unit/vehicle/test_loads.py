"""The rigid-body balance and N, Q, M: by hand, by independent quadrature, and at the ends."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from antinode.errors import InputError
from antinode.vehicle.condition import OperatingCondition, Water
from antinode.vehicle.loads import compute_loads
from antinode.vehicle.options import Model
from antinode.vehicle.vehicle import Vehicle
from vehicles import condition, vehicle

close = pytest.approx


class TestByHand:
    """A uniform bar of 600 kg and 6 m, pushed by 60 kN, with nothing but the cavitator ahead."""

    body = Vehicle(
        stations={
            "x": [0, 3, 6],
            "mass_per_length": [100, 100, 100],
            "bending_stiffness": [1e5] * 3,
            "axial_stiffness": [1e8] * 3,
            "radius": [0.03] * 3,
        },
        cavitator={"diameter": 0.08},
    )
    water = Water(density=1000, gravity=10)
    loads = compute_loads(
        body,
        OperatingCondition(speed=100, cavitation_number=0.02, cavitator_angle="30 deg", thrust=6e4),
        water,
        Model(distortion="none"),
    )

    def test_equation_18(self):
        # (60000 - 15765.7686)/600 = 73.7237190
        assert self.loads.a_X == close(73.723719, rel=1e-7)

    def test_equation_19(self):
        # 9102.3707/600 - 10 = 5.1706178
        assert self.loads.a_Y == close(5.1706178, rel=1e-7)

    def test_equation_20(self):
        # I = 600*36/12 = 1800; 9102.3707*3/1800 = 15.1706178, nose-up
        assert self.loads.inertia == close(1800, rel=1e-12)
        assert self.loads.beta == close(15.1706178, rel=1e-7)

    def test_equation_22_exact(self):
        # at x = 2: 15765.7686 + 200*73.723719 = 30510.5124
        assert self.loads.axial_force(2.0) == close(30510.5124, rel=1e-7)

    def test_equation_24(self):
        # x = 2: F_CY - 200*(a_Y + g + 3 beta) + beta*100*2^2/2, F_CY = 9102.3707
        # 15.1706178 + 45.5118534 = 60.6824712; 9102.3707 - 12136.4942 + 3034.1236 = 0
        # (a bar struck at its end has no shear at a third of its length)
        assert self.loads.shear_force(2.0) == close(0, abs=1e-3)
        # x = 1: 9102.3707 - 6068.2471 + 758.5309 = 3792.6545
        assert self.loads.shear_force(1.0) == close(3792.6545, rel=1e-7)

    def test_equation_26(self):
        # M(1) = 9102.3707 - 60.6824712*100/2 + 15.1706178*100/6 = 6321.0908
        assert self.loads.bending_moment(1.0) == close(6321.0908, rel=1e-7)

    def test_weight_alone_bends_nothing(self):
        straight = OperatingCondition(speed=100, cavitation_number=0.02, thrust=6e4)
        loads = compute_loads(self.body, straight, self.water, Model(planing="none"))
        assert loads.a_Y == close(-10)
        assert np.abs(loads.shear_force(np.linspace(0, 6, 7))).max() < 1e-9

    def test_str(self):
        text = str(self.loads)
        assert "cavitator 15766 aft, 9102.4 up" in text
        assert "600 kg" in text


class TestElementMidpoint:
    model = Model(axial_force="element_midpoint")

    def test_equation_22(self):
        """N of each element: the tail's thrust less what acts and accelerates behind its middle."""
        fins = [{}, {"position": 3.9}]
        loads = compute_loads(vehicle(fins), condition(), model=self.model)
        x, m = vehicle().stations.x, vehicle().mass_per_length()[:-1]
        masses = np.diff(x) * m
        middle = (x[:-1] + x[1:]) / 2
        behind = np.array([masses[i + 1 :].sum() + masses[i] / 2 for i in range(6)])
        N = loads.thrust - loads.a_X * behind
        for force in loads.forces[1:]:
            N -= force.F_X * (middle <= force.x)
        np.testing.assert_allclose(loads.axial_jump, N, rtol=1e-12)
        assert loads.axial_inertia == 0
        assert loads.breakpoints.tolist() == x.tolist()

    def test_values_and_checks(self):
        loads = compute_loads(vehicle(), condition(), model=self.model)
        P = loads.axial_jump
        assert loads.axial_force([0, 0.2, 0.4, 6]).tolist() == [P[0], P[0], P[0], P[-1]]
        assert loads.axial_force(0.4, "right") == P[1]
        assert loads.checks.worst < 1e-12

    def test_converges_to_the_exact_force(self):
        x = np.linspace(0, 6, 601)
        fine = {name: np.full(601, value) for name, value in FLAT.items()}
        body = vehicle(x=x, **fine)
        midpoint = compute_loads(body, condition(), model=self.model)
        exact = compute_loads(body, condition())
        at = np.array([0.123, 2.5, 4.9, 5.2])
        np.testing.assert_allclose(midpoint.axial_force(at), exact.axial_force(at), rtol=3e-3)


FLAT = {
    "mass_per_length": 333.0,
    "bending_stiffness": 4e5,
    "axial_stiffness": 4e8,
    "radius": 0.15,
}


class TestSidesAndBreakpoints:
    def test_steps_at_the_fins(self):
        loads = compute_loads(vehicle(), condition())
        assert loads.F_fX > 0
        left, right = loads.axial_force(5.0), loads.axial_force(5.0, "right")
        assert right - left == close(loads.F_fX, rel=1e-9)
        assert 5.0 in loads.breakpoints
        assert loads.axial_force(0.0) == close(loads.F_CX, rel=1e-14)

    def test_shear_jumps_by_the_cavitator_lift_at_the_nose(self):
        loads = compute_loads(vehicle(), condition())
        assert loads.shear_force(0.0) == 0
        assert loads.shear_force(0.0, "right") == close(loads.F_CY)

    @pytest.mark.parametrize("position", [0.0, 6.0])
    def test_fins_at_the_ends(self, position):
        loads = compute_loads(vehicle(), condition(fin_position=position))
        assert loads.checks.worst < 1e-12
        assert loads.axial_force(6.0) == close(loads.thrust)
        assert loads.axial_force(6.0, "right") == close(loads.thrust)
        assert loads.axial_force(0.0) == close(loads.F_CX)

    def test_a_fin_next_to_a_station_is_on_it(self):
        loads = compute_loads(vehicle(), condition(fin_position=4.5 + 1e-15))
        assert np.diff(loads.breakpoints).min() > 1e-3

    def test_axial_jump_and_mass_make_the_axial_force(self):
        loads = compute_loads(vehicle(), condition())
        x = (loads.breakpoints[:-1] + loads.breakpoints[1:]) / 2
        N = loads.axial_jump + loads.axial_inertia * loads.mass_distribution.moments(x)[0]
        np.testing.assert_allclose(N, loads.axial_force(x), rtol=1e-14)

    def test_off_the_body(self):
        loads = compute_loads(vehicle(), condition())
        for x in (-1e-3, 6.1, math.nan):
            with pytest.raises(InputError, match="on the body"):
                loads.axial_force(x)


class TestInputErrors:
    @pytest.mark.parametrize(
        ("fin", "changes", "words"),
        [
            ({}, {"fin_position": None}, ["set 1", "no position", "fin_position"]),
            ({}, {"fin_position": 6.1}, ["set 1", "6.1 m", "0 and 6 m"]),
            ({"position": 7}, {}, ["set 1", "7 m"]),
            ({"tip_radius": 0.19}, {}, ["tip_radius 0.19 m", "0.19 m at x = 5 m"]),
        ],
    )
    def test_fins_off_the_body(self, fin, changes, words):
        with pytest.raises(InputError) as caught:
            compute_loads(vehicle([fin]), condition(**changes))
        for word in words:
            assert word in str(caught.value)


class TestWarnings:
    def warnings(self, changes=None, **values):
        body = vehicle(**(changes or {}))
        return " ".join(compute_loads(body, condition(**values)).warnings)

    def test_cavity_closed_ahead_of_the_tail(self):
        assert "closes at x = 5.635 m" in self.warnings(cavitation_number=0.025)

    def test_fins_inside(self):
        assert "Fin set 1" in self.warnings({"fins": [{"tip_radius": 0.2}]})

    def test_sigma_outside(self):
        assert "sigma = 0.15 is outside its range" in self.warnings(cavitation_number=0.15)

    def test_wet_all_round(self):
        assert "R' = " in self.warnings(cavitation_number=0.023)

    def test_forebody(self):
        assert "forebody" in self.warnings({"radius": [0.19] * 7})
        assert "forebody" not in self.warnings()

    def test_quiet_in_a_good_condition(self):
        loads = compute_loads(vehicle(), condition(cavitation_number=0.015))
        assert loads.warnings == ()
        assert all(row.inside for row in loads.validity)

    def test_options_switch_forces_off(self):
        model = Model(planing="none", fin_lift="none")
        loads = compute_loads(vehicle(), condition(body_angle="2 deg"), model=model)
        assert (loads.F_PX, loads.F_PY, loads.F_fY) == (0, 0, 0)
        assert loads.F_fX > 0

    def test_implied_pressure(self):
        # 101325 + 998.2*9.80665*10 - 0.02*998.2*80^2/2 = 135330.2
        loads = compute_loads(vehicle(), condition(depth=10))
        assert loads.cavity_pressure == close(135330.2, rel=1e-6)


def test_fin_lift_and_drag_of_a_set():
    # sigma = 0.04: the cavity closes at 3.2 m and the fins are wholly wet, span 0.35 - 0.19 = 0.16
    # q = 998.2*6400/2 = 3194240; drag 2 * 0.185*1.08 * q * 0.16 * 0.015 = 3063.40393
    # lift 2 * q * pi/2 * 0.16*0.1 * (0.02*sin45)*sin45 = q*pi*0.016*0.01 = 1605.60015
    loads = compute_loads(
        vehicle([{"chord": 0.1}]), condition(cavitation_number=0.04, body_angle=0.02)
    )
    assert loads.cavity.L_c < 5
    assert loads.fins[0].immersion == close((0.16, 0.16))
    assert loads.F_fX == close(3063.40393, rel=1e-7)
    assert loads.F_fY == close(1605.60015, rel=1e-7)


@st.composite
def cases(draw):
    """A vehicle and a condition: any interpolation, one to three mass states, up to three sets."""
    number = st.floats
    n = draw(st.integers(2, 9))
    steps = draw(st.lists(number(0.05, 2), min_size=n, max_size=n))
    x = np.concatenate([[0], np.cumsum(steps)])

    def column(low, high):
        return draw(st.lists(number(low, high), min_size=n + 1, max_size=n + 1))

    states = {f"mass_per_length:{k}": column(1, 1000) for k in range(draw(st.integers(1, 3)))}
    place = st.one_of(number(0, 1).map(lambda t: t * x[-1]), st.sampled_from(list(x)))
    angle = number(-3, 3)
    fins = [
        {
            "roll_angles": draw(st.lists(angle, min_size=1, max_size=4)),
            "tip_radius": draw(number(0.31, 0.6)),
            "thickness": 0.01,
            "position": float(draw(place)),
            "deflection": draw(number(-0.3, 0.3)),
        }
        for _ in range(draw(st.integers(0, 3)))
    ]
    body = Vehicle(
        stations={
            "x": x,
            "bending_stiffness": [1.0] * (n + 1),
            "axial_stiffness": [1.0] * (n + 1),
            "radius": column(0.02, 0.3),
            **states,
        },
        cavitator={"diameter": draw(number(0.02, 0.2))},
        fins=fins,
        interpolation=draw(st.sampled_from(["step", "linear", "log"])),
    )
    at = OperatingCondition(
        speed=draw(number(10, 300)),
        cavitation_number=draw(number(0.003, 0.5)),
        cavitator_angle=draw(number(-0.9, 0.9)),
        body_angle=draw(number(-0.3, 0.3)),
        thrust=draw(number(0, 2e5)),
        burn_fraction=draw(number(0, 1)),
    )
    model = Model(
        gravity_rise=draw(st.sampled_from(["paper", "buoyancy", "none"])),
        fin_immersion=draw(st.sampled_from(["radial", "tip_distance"])),
        planing_angle=draw(st.sampled_from(["wall", "axis", "attitude"])),
        planing_area=draw(st.sampled_from(["arc", "projected"])),
        planing_position=draw(st.sampled_from(["centroid", "tail"])),
    )
    return body, at, model


@settings(derandomize=True, deadline=None, max_examples=200)
@given(cases())
def test_checks_close(case):
    body, at, model = case
    loads = compute_loads(body, at, model=model)
    assert loads.checks.worst < 1e-9
    F = max(loads.thrust, *(abs(part) for f in loads.forces for part in (f.F_X, f.F_Y)))
    L = body.length
    assert abs(loads.axial_force(0.0) - loads.F_CX) <= 1e-9 * F
    assert abs(loads.axial_force(L) - at.thrust) <= 1e-9 * F
    assert abs(loads.shear_force(L)) <= 1e-9 * max(F, loads.weight)
    assert abs(loads.bending_moment(L)) <= 1e-9 * max(F, loads.weight) * L
    assert all(map(math.isfinite, (loads.a_X, loads.a_Y, loads.beta, loads.x_M)))


def density(body, at):
    """Mass per length by an interpolation of its own."""
    x, how = body.stations.x, body.interpolation
    states = np.array(list(body.stations.mass_per_length.values()))
    grid = np.linspace(0, 1, len(states)) if len(states) > 1 else np.array([0.0])
    m = np.array([np.interp(at.burn_fraction, grid, column) for column in states.T])
    if how == "step":
        return lambda s: m[max(np.count_nonzero(x <= s) - 1, 0)]
    if how == "linear":
        return lambda s: np.interp(s, x, m)
    return lambda s: math.exp(np.interp(s, x, np.log(m)))


def integral(function, bounds):
    return sum(quad(function, a, b, epsrel=1e-11)[0] for a, b in pairwise(bounds))


@settings(derandomize=True, deadline=None, max_examples=15)
@given(cases(), st.floats(0.05, 0.95))
def test_against_quadrature(case, share):
    body, at, model = case
    loads, x = compute_loads(body, at, model=model), share * body.length
    m, cuts = density(body, at), loads.breakpoints
    whole, ahead = list(cuts), [*cuts[cuts < x], x]
    mass = integral(m, whole)
    x_M = integral(lambda s: m(s) * s, whole) / mass
    inertia = integral(lambda s: m(s) * (s - x_M) ** 2, whole)
    g = Water().gravity
    a_Y = sum(f.F_Y for f in loads.forces) / mass - g
    beta = -sum(f.F_Y * (f.x - x_M) for f in loads.forces) / inertia
    scale = max(abs(f.F_Y) for f in loads.forces) + mass * g
    counted = [f for f in loads.forces if f.x < x]

    def inertial(s):
        return m(s) * (a_Y + g + (x_M - s) * beta)

    Q = sum(f.F_Y for f in counted) - integral(inertial, ahead)
    M = sum(f.F_Y * (x - f.x) for f in counted) - integral(lambda s: (x - s) * inertial(s), ahead)
    N = sum(f.F_X for f in counted) + loads.a_X * integral(m, ahead)
    assert loads.mass == close(mass, rel=1e-9)
    assert loads.x_M == close(x_M, rel=1e-9)
    assert loads.inertia == close(inertia, rel=1e-8)
    assert loads.shear_force(x) == close(Q, abs=1e-8 * scale)
    assert loads.bending_moment(x) == close(M, abs=1e-8 * scale * body.length)
    assert loads.axial_force(x) == close(N, abs=1e-8 * (at.thrust + scale + abs(N)))
