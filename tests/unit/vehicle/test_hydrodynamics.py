"""Equations 2-17, each against a number worked out by hand in the comment, and their limits."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from antinode.beam.profile import Profile
from antinode.vehicle.hydrodynamics import Range, fins, form_cavity, planing_state
from antinode.vehicle.hydrodynamics import cavitator as disk
from antinode.vehicle.hydrodynamics import cavity as hole
from antinode.vehicle.hydrodynamics import planing as tail
from antinode.vehicle.hydrodynamics.roots import find_roots
from antinode.vehicle.hydrodynamics.wetted import (
    WettedSurface,
    wet_angle,
    wetted_surface,
    wetted_width,
)
from antinode.vehicle.options import Model

close = pytest.approx
DEG = math.radians(1)


def cavity(sigma=0.02, speed=80.0, gravity=9.8, angle=0.0, theta=0.0, L=6.0, **options):
    return form_cavity(
        0.08,
        sigma,
        speed=speed,
        gravity=gravity,
        body_length=L,
        body_angle=theta,
        cavitator_angle=angle,
        model=Model(**options),
    )


class TestCavitator:
    def test_equation_3(self):
        assert disk.drag_coefficient(0.02) == close(0.8364, rel=1e-14)  # 0.82 * 1.02

    def test_equation_4(self):
        # 3.14159265 * 0.0064 / 4
        assert disk.disk_area(0.08) == close(5.02654825e-3, rel=1e-8)

    def test_equations_2_5_and_6(self):
        # q = 1000 * 100^2 / 2 = 5e6; F_x0 = 5e6 * 0.8364 * 5.02654825e-3 = 21021.0248
        # at 30 deg: cos^2 = 0.75 -> 15765.7686; cos sin = 0.4330127019 -> 9102.3707
        drag, lift = disk.cavitator_forces(1000.0, 100.0, 0.02, 0.08, 30 * DEG)
        assert drag == close(15765.7686, rel=1e-7)
        assert lift == close(9102.3707, rel=1e-7)

    def test_equation_2_without_an_angle(self):
        drag, lift = disk.cavitator_forces(1000.0, 100.0, 0.02, 0.08, 0.0)
        assert (drag, lift) == (close(21021.0248, rel=1e-8), 0)

    def test_arrays_broadcast(self):
        F_CX, _ = disk.cavitator_forces(1e3, np.array([1.0, 2.0])[:, None], np.ones(3), 0.1, 0.0)
        assert F_CX.shape == (2, 3)
        np.testing.assert_allclose(F_CX[1], 4 * F_CX[0])


class TestCavity:
    def test_equation_7(self):
        # 0.8364 / 0.02 = 41.82, root 6.4668385; times 0.08
        assert hole.maximum_diameter(0.08, 0.02) == close(0.51734708, rel=1e-7)

    def test_equation_8(self):
        # 0.8364 / 4e-4 * ln 50 = 2091 * 3.912023005 = 8180.0401, root 90.443574; times 0.08
        assert hole.cavity_length(0.08, 0.02) == close(7.2354859, rel=1e-7)

    def test_equation_9(self):
        # at a quarter: xbar = 0.5, 0.5*1.5 = 0.75; D_c^2 - D_n^2 = 0.0064*40.82 = 0.261248
        # 0.75*0.261248 + 0.0064 = 0.202336, root 0.44981774, half 0.22490887
        c = cavity()
        assert c.radius(c.L_c / 4) == close(0.22490887, rel=1e-7)

    def test_equation_9_ends(self):
        c = cavity()
        assert c.radius(0) == close(0.04)  # the disk
        assert c.radius(c.L_c / 2) == close(c.D_c / 2)
        assert c.radius(c.L_c * (1 - 1e-15)) == close(0.04, rel=1e-6)
        assert c.radius(c.L_c * 1.001) == 0
        assert c.radius_slope(c.L_c * 1.001) == 0

    def test_equation_10(self):
        # 1.02 * 1.5^3 / (4.5 * 25) = 3.4425 / 112.5
        assert hole.rise_by_paper(1.5, 0.02, 5.0) == close(0.0306, rel=1e-14)

    def test_equations_11_and_12(self):
        # 60 / sqrt(9 * 4) = 10
        assert hole.froude_number(60.0, 9.0, 4.0) == 10
        # mid-cavity, xbar = 1: Fr^2 = 6400 / (9.8 * 7.2354859) = 90.258103
        # h = 3.61774295 * 1.02 / (4.5 * 90.258103) = 3.69009781 / 406.16146
        c = cavity()
        assert c.gravity_rise(c.L_c / 2) == close(9.085298e-3, rel=1e-6)

    def test_rise_by_buoyancy(self):
        # xbar = 1: 1/6 - 1/3 + (2/3) ln 2 = 0.295431453; over 2 * 25
        assert hole.rise_by_buoyancy(1.0, 5.0) == close(5.90862907e-3, rel=1e-8)

    def test_buoyancy_is_the_integral_of_volume_over_area(self):
        # dh/dxbar = (Q/S) / (2 Fr^2) with S ~ xbar (2 - xbar), Q its integral
        expected = quad(lambda s: (s**2 - s**3 / 3) / (s * (2 - s)), 0, 1.6)[0] / (2 * 9)
        assert hole.rise_by_buoyancy(1.6, 3.0) == close(expected, rel=1e-10)

    def test_buoyancy_against_paper(self):
        # eq. 10 without its 1 + sigma is 1.504 (xbar 1) to 1.85 (xbar 1.7) times higher
        for x_bar, ratio in ((1.0, 1.504), (1.7, 1.851)):
            rise = hole.rise_by_paper(x_bar, 0.0, 5.0) / hole.rise_by_buoyancy(x_bar, 5.0)
            assert rise == close(ratio, rel=1e-3)

    @pytest.mark.parametrize(
        ("name", "length"),
        [("half_cavity", 3.61774295), ("cavity", 7.2354859), ("cavitator", 0.08), ("body", 6.0)],
    )
    def test_reference_length_and_factor_of_the_rise(self, name, length):
        # the dimensionless rise of test_equations_11_and_12 is 9.085298e-3 / 3.61774295
        c = cavity(gravity_rise_length=name, gravity_rise_factor=0.5)
        expected = 0.5 * length * 9.085298e-3 / 3.61774295
        assert c.gravity_rise(c.L_c / 2) == close(expected, rel=1e-6)

    def test_equation_13(self):
        # 0.8364 * 0.1 * 0.04 * (0.46 - 0.02 + 1.5) = 0.0033456 * 1.94
        assert hole.distortion(1.5, 0.02, 0.1, 0.04) == close(6.490464e-3, rel=1e-12)

    def test_axis_offset(self):
        # x = L_c/2: theta 0.02 * 3.61774295 + 9.085298e-3 - 0.8364*0.1*0.04*(0.44 + 1)
        # = 0.072354859 + 0.009085298 - 0.004817664 with alpha = 0.02 + 0.08
        c = cavity(theta=0.02, angle=0.08)
        assert c.axis_offset(c.L_c / 2) == close(0.076622493, rel=1e-6)
        assert cavity(theta=0.02, angle=0.08, distortion_factor=2).axis_offset(c.L_c / 2) == close(
            0.076622493 - 0.004817664, rel=1e-6
        )

    def test_offset_signs(self):
        assert cavity().axis_offset(5) > 0  # gravity lifts the cavity
        assert cavity(gravity=0, angle=10 * DEG).axis_offset(5) < 0  # lift pushes it down
        assert cavity(gravity=0, theta=5 * DEG, distortion="none").axis_offset(5) > 0

    @pytest.mark.parametrize("rise", ["paper", "buoyancy", "none"])
    @pytest.mark.parametrize("x", [0.5, 3.0, 5.5])
    def test_slopes_are_derivatives(self, rise, x):
        c, h = cavity(theta=0.02, angle=0.1, gravity_rise=rise), 1e-5
        slope = (c.axis_offset(x + h) - c.axis_offset(x - h)) / (2 * h)
        assert c.axis_slope(x) == close(slope, rel=1e-6)
        slope = (c.radius(x + h) - c.radius(x - h)) / (2 * h)
        assert c.radius_slope(x) == close(slope, rel=1e-6)

    @pytest.mark.parametrize("rise", ["paper", "buoyancy", "none"])
    def test_no_gravity(self, rise):
        assert np.all(cavity(gravity=0, gravity_rise=rise).gravity_rise(np.linspace(0, 9, 50)) == 0)

    @pytest.mark.parametrize("rise", ["paper", "buoyancy", "none"])
    def test_finite_and_continuous_up_to_and_behind_the_closure(self, rise):
        c = cavity(theta=0.02, angle=0.1, gravity_rise=rise)
        x = c.L_c * np.array([1 - 1e-12, 1, 1 + 1e-12, 1.5])
        for value in (c.axis_offset(x), c.axis_slope(x)):
            assert np.isfinite(value).all()
            np.testing.assert_allclose(value, value[0], rtol=1e-9)


class TestFins:
    def test_equation_15(self):
        assert fins.fin_drag_coefficient(0.02) == close(0.1924, rel=1e-14)  # 0.185 * 1.04

    def test_equation_14(self):
        # 0.1924 * 5e6 * 0.05 * 0.015 = 721.5
        assert fins.fin_drag(1000.0, 100.0, 0.02, 0.05, 0.015) == close(721.5, rel=1e-12)

    def test_lift(self):
        # q = 5e6; slope 1.5; area 0.01; incidence 0.1*sin 30 deg + 0.02 = 0.07; times sin 30 deg
        incidence = fins.fin_incidence(0.1, 0.02, 30 * DEG)
        assert incidence == close(0.07, rel=1e-12)
        lift = fins.fin_lift(1000.0, 100.0, 1.5, 0.01, incidence, 30 * DEG)
        assert lift == close(2625, rel=1e-12)  # 5e6 * 1.5 * 0.01 * 0.07 * 0.5

    def test_lift_is_the_same_to_port_and_below(self):
        phi = np.array([30, 150, 210, 330]) * DEG
        lift = fins.fin_lift(1e3, 1.0, 1.5, 0.1, fins.fin_incidence(0.1, 0.05, phi), phi)
        np.testing.assert_allclose(lift, lift[0], rtol=1e-12)
        assert lift[0] > 0

    def test_vertical_fins_do_not_lift(self):
        phi = np.array([0.0, math.pi])
        assert np.abs(fins.fin_lift(1e3, 9.0, 1.5, 1.0, 0.1, phi)).max() < 1e-9

    def test_centred_cavity(self):
        # the tip stands 0.35 - 0.30 out of the cavity at every roll angle, by either measure
        for immersion in (fins.radial_immersion, fins.tip_immersion):
            h = immersion(0.19, 0.35, np.linspace(0, 6, 7), 0.0, 0.30)
            np.testing.assert_allclose(h, 0.05, rtol=1e-12)

    def test_lifted_cavity(self):
        # axis 0.02 up: the upper fin is 0.35 - 0.32 out, the lower 0.35 - 0.28; to the side
        # the cavity ends at sqrt(0.09 - 0.0004) = 0.29933259, tip distance hypot(0.35, 0.02) - 0.3
        h = fins.radial_immersion(0.19, 0.35, np.array([0, 90, 180]) * DEG, 0.02, 0.30)
        np.testing.assert_allclose(h, [0.03, 0.05066741, 0.07], rtol=1e-6)
        h = fins.tip_immersion(0.19, 0.35, np.array([0, 90, 180]) * DEG, 0.02, 0.30)
        np.testing.assert_allclose(h, [0.03, 0.05057096, 0.07], rtol=1e-6)

    def test_radial_immersion_against_counting(self):
        random = np.random.default_rng(1)
        t = (np.arange(20_000) + 0.5) / 20_000
        for _ in range(200):
            R, span, e, R_c = random.uniform([0.05, 0.05, -0.5, 0], [0.3, 0.4, 0.5, 0.5])
            phi = random.uniform(0, 2 * math.pi)
            r = R + span * t
            outside = np.hypot(r * math.cos(phi) - e, r * math.sin(phi)) > R_c
            h = fins.radial_immersion(R, R + span, phi, e, R_c)
            assert h == close(span * outside.mean(), abs=2e-4 * span)

    def test_wholly_wet_behind_the_closure_and_wholly_dry(self):
        for immersion in (fins.radial_immersion, fins.tip_immersion):
            assert immersion(0.2, 0.3, 1.0, 0.25, 0.0) == close(0.1)
            assert immersion(0.2, 0.3, 1.0, 0.0, 0.3) == close(0.0, abs=1e-15)


class TestPlaningFormulas:
    def test_friction(self):
        # (1e7)^(-1/7) = 0.1
        assert tail.friction_coefficient(1e7) == close(0.0031, rel=1e-12)
        assert tail.friction_coefficient(0.0) == 0

    def test_equation_16_drag(self):
        # Re = 1000*100*0.1/1e-3 = 1e7; 5e6 * 0.0031 * 0.05 = 775
        assert tail.planing_drag(1000.0, 100.0, 0.1, 0.05, 1e-3) == close(775, rel=1e-12)
        assert tail.planing_drag(1000.0, 100.0, 0.0, 0.0, 1e-3) == 0

    def test_equation_16_lift(self):
        # pi*1000*0.04*1e4 = 1256637.06; bracket 1 - (0.1/0.2)^2 = 0.75; 1.1/1.2; angle 0.05
        # 1256637.06 * 0.75 * 0.916666667 * 0.05 = 43196.899
        force = tail.planing_force(1000.0, 100.0, 0.2, 0.1, 0.1, 0.05)
        assert force == close(43196.899, rel=1e-7)

    def test_equation_16_wet_all_round(self):
        # bracket 1: 1256637.06 * 1.1/1.2 * 0.05 = 57595.865
        for R_prime, behind in ((0.0, False), (-0.3, False), (0.1, True)):
            force = tail.planing_force(1000.0, 100.0, 0.2, 0.1, R_prime, 0.05, behind)
            assert force == close(57595.865, rel=1e-7)

    def test_clearance(self):
        assert tail.clearance_ratio(0.24, 0.2) == close(0.2)

    @pytest.mark.parametrize(
        ("offset", "R_c", "h"),
        [
            (0.05, 0.24, 0.05),  # (0.05 - 0.04) / 0.2
            (-0.05, 0.24, 0.05),
            (0.03, 0.24, 0.0),  # inside
            (0.05, 0.0, 1.25),  # (0.05 + 0.2) / 0.2
            (0.5, 0.0, 2.0),  # 3.5, capped
        ],
    )
    def test_equation_17(self, offset, R_c, h):
        assert tail.immersion_ratio(offset, R_c, 0.2) == close(h, rel=1e-12)

    def test_direction(self):
        assert tail.direction(np.array([-0.1, -0.001, 0, 0.001, 0.1]), 0.2, 0.01).tolist() == [
            -1,
            -0.5,
            0,
            0.5,
            1,
        ]
        assert tail.direction(-1e-9, 0.2, 0.0) == -1


class TestWetAngle:
    def test_equal_circles(self):
        # two circles of one radius, centres a radius apart: crossing at +-60 deg, 240 stand out
        assert wet_angle(0.2, 0.2, 0.2) == close(math.radians(240), rel=1e-12)

    def test_limits(self):
        assert wet_angle(0.2, 0.3, 0.05) == 0
        assert wet_angle(0.2, 0.3, 0.0) == 0
        assert wet_angle(0.2, 0.1, 0.0) == close(2 * math.pi)
        assert wet_angle(0.2, 0.0, 0.2) == close(2 * math.pi)
        assert wet_angle(0.2, 0.1, 5.0) == close(2 * math.pi)

    def test_against_counting(self):
        random = np.random.default_rng(2)
        psi = (np.arange(20_000) + 0.5) / 20_000 * 2 * math.pi
        for _ in range(200):
            R, R_c, e = random.uniform([0.1, 0.0, -0.4], [0.3, 0.5, 0.4])
            share = (np.hypot(R * np.cos(psi) - e, R * np.sin(psi)) > R_c).mean()
            assert wet_angle(R, R_c, e) == close(2 * math.pi * share, abs=2e-3)


STATIONS = np.array([0.0, 1.5, 4.0, 5.0, 6.0])


def stepped(x):
    return np.where(np.asarray(x) < 5.0, 0.17, 0.19)


def conical(x):
    return np.interp(x, [0, 1.5, 6], [0.04, 0.19, 0.17])


def body(radius):
    """A radius given as a function, as a profile on the stations."""
    inner = 1e-12 * np.array([1.0, -1.0])
    ends = radius(np.stack([STATIONS[:-1], STATIONS[1:]], axis=1) + inner)
    return Profile(STATIONS, ends, "linear")


def alone(c):
    """One cavity as the only one of many."""
    numbers = ("D_n", "sigma", "theta", "alpha", "D_c", "L_c", "Fr_L")
    return replace(c, **{name: np.array([float(getattr(c, name))]) for name in numbers})


def wetted(c, radius=stepped):
    length, area, centroid = wetted_surface(alone(c), body(radius))
    return WettedSurface(length[0], area[0], centroid[0])


def state(c, radius=stepped, speed=80.0):
    return planing_state(alone(c), body(radius), 998.2, np.array([speed]), 1.002e-3).of(0)


class TestWettedSurface:
    @pytest.mark.parametrize("radius", [stepped, conical])
    @pytest.mark.parametrize("speed", [20.0, 80.0])
    @pytest.mark.parametrize("angle", [0.0, 0.17, 0.5])
    @pytest.mark.parametrize("sigma", [0.012, 0.018, 0.02, 0.022, 0.025, 0.04])
    def test_against_many_thin_strips(self, radius, sigma, angle, speed):
        c = cavity(sigma, angle=angle, speed=speed)
        start = min(c.L_c / 2, 6.0)
        x = start + (6 - start) * (np.arange(200_000) + 0.5) / 200_000
        arc = radius(x) * wet_angle(radius(x), c.radius(x), c.axis_offset(x))
        dx = (6 - start) / 200_000
        wet = wetted(c, radius)
        assert wet.length == close(dx * np.count_nonzero(arc), abs=4 * dx)
        assert wet.area == close(dx * arc.sum(), abs=1e-6)
        if wet.area > 1e-3:
            assert wet.centroid == close((arc * x).sum() / arc.sum(), abs=1e-5)

    def test_nothing_wet(self):
        p = state(cavity(0.01, speed=500.0))
        assert (p.area, p.length, p.F_PX, p.F_PY, p.x_P, p.Re_w) == (0, 0, 0, 0, 6, 0)

    def test_middle_of_the_cavity_behind_the_tail(self):
        p = state(cavity(0.002))
        assert (p.area, p.F_PX, p.x_P) == (0, 0, 6)

    def test_a_surface_does_not_depend_on_those_beside_it(self):
        sigma = np.linspace(0.006, 0.06, 40)
        made = cavity(sigma, angle=np.linspace(-0.3, 0.4, 40), speed=np.full(40, 60.0))
        made = replace(made, theta=np.zeros(40), D_n=np.full(40, 0.08))
        together = wetted_surface(made, body(conical))
        for k in range(40):
            assert wetted(made.of(k), conical) == tuple(v[k] for v in together)

    def test_smooth_in_sigma(self):
        # an area that jumped or had kinks of its own would break the differences of a fine grid
        sigma = np.linspace(0.0201, 0.0209, 81)
        area = np.array([wetted(cavity(s)).area for s in sigma])
        assert np.abs(np.diff(area, 3)).max() < 1e-3 * np.abs(np.diff(area)).max()


class TestBoundOfProtrusion:
    """What lets pieces of a body be left out unseen must never be below what stands out."""

    @pytest.mark.parametrize("rise", ["paper", "buoyancy", "none"])
    def test_it_is_above_every_place_between(self, rise):
        rng = np.random.default_rng(7)
        for _ in range(300):
            hole = form_cavity(
                0.08,
                rng.uniform(0.01, 0.6),
                speed=rng.uniform(1, 40),
                gravity=9.81,
                body_length=6.0,
                body_angle=rng.uniform(-0.1, 0.1),
                cavitator_angle=rng.uniform(-0.5, 0.5),
                model=Model(gravity_rise=rise),
            )
            a, b = np.sort(rng.uniform(0, 1.1 * hole.L_c, 2))
            R = rng.uniform(0.01, 0.3, 2)
            x = np.linspace(a, b, 400)
            out = np.abs(hole.axis_offset(x)) + np.interp(x, [a, b], R) - hole.radius(x)
            bound = float(hole.course.protrusion_bound(a, b, *R))
            assert bound >= out.max() - 1e-14
            if rise != "buoyancy" and b < hole.L_c:
                assert bound <= out.max() + (b - a) * abs(hole.axis_slope(b) - hole.axis_slope(a))


class TestRoots:
    """Of functions as they occur here, and of awkward ones."""

    def test_many_at_once(self):
        a = np.random.default_rng(3).uniform(0.01, 0.9, 500)
        low, high = np.zeros(500), np.ones(500)
        for function, root in (
            (lambda x, k: x - a[k], a),
            (lambda x, k: a[k] - x**3, np.cbrt(a)),
            (lambda x, k: np.tanh(200 * (x - a[k])), a),
            (lambda x, k: np.sign(x - a[k]) * np.sqrt(np.abs(x - a[k])), a),
            (lambda x, k: np.where(x > a[k], 1.0, -1e-9), a),
        ):
            np.testing.assert_allclose(find_roots(function, low, high), root, rtol=4e-15)

    def test_ends_that_are_roots_and_none_at_all(self):
        assert find_roots(lambda x, _: 1 - x, np.zeros(1), np.ones(1)) == [1]
        assert len(find_roots(lambda x, _: x, np.zeros(0), np.zeros(0))) == 0

    def test_a_function_that_is_zero_over_some_rounding_errors_is_soon_done(self):
        asked = []

        def function(x, rows):
            asked.append(len(rows))
            return np.where(np.abs(x - 1.07) < 4e-15, 0.0, x**3 - 1.07**3)

        assert find_roots(function, np.array([1.0]), np.array([1.2])) == close(1.07, rel=1e-14)
        assert len(asked) < 15


class TestCourse:
    """The few numbers against the equations as they are written."""

    @pytest.mark.parametrize("rise", ["paper", "buoyancy", "none"])
    def test_radius_and_axis_are_those_of_the_equations(self, rise):
        c = cavity(sigma=0.03, angle=8 * DEG, theta=2 * DEG, gravity_rise=rise)
        x = np.linspace(0, c.L_c * (1 - 1e-9), 60)
        s = 2 * x / c.L_c
        R_c = np.sqrt(s * (2 - s) * (c.D_c**2 - c.D_n**2) + c.D_n**2) / 2
        np.testing.assert_allclose(c.radius(x), R_c, rtol=1e-14)
        axis = c.theta * x + c.gravity_rise(x) - c.distortion(x)
        np.testing.assert_allclose(c.axis_offset(x), axis, atol=1e-15, rtol=1e-14)

    @pytest.mark.parametrize("sigma", np.linspace(0.01, 0.05, 9))
    def test_the_closure_itself_is_not_behind_it(self, sigma):
        c = cavity(sigma=sigma)
        assert c.radius(c.L_c) == close(c.D_n / 2, rel=1e-12)
        assert c.radius(np.nextafter(c.L_c, np.inf)) == 0.0


class TestPlaningState:
    def test_planing_angle_options(self):
        options = ("wall", "axis", "attitude")
        made = [cavity(theta=-0.03, angle=0.2, planing_angle=name) for name in options]
        wall, axis, attitude = (tail.planing_angle(c, 6.0) for c in made)
        assert attitude == close(0.03)
        assert axis == close(abs(made[1].axis_slope(6.0)))
        assert wall == close(axis + abs(made[0].radius_slope(6.0)))

    def test_projected_area_has_chords_for_arcs(self):
        angle = np.array([0.0, 0.4, math.pi, 5.0])
        R = 0.2
        chords = [0, math.dist((R, 0), (R * math.cos(0.4), R * math.sin(0.4))), 2 * R, 2 * R]
        assert wetted_width(R, angle, "projected") == close(chords)
        assert wetted_width(R, angle, "arc") == close(R * angle)
        arc, flat = (state(cavity(0.022, planing_area=a)) for a in ("arc", "projected"))
        assert flat.length == arc.length
        assert arc.area / math.pi < flat.area < arc.area
        assert state(cavity(0.03, planing_area="projected"), lambda x: 0.5 + 0 * x).area == close(
            1.0 * (6 - cavity(0.03).L_c / 2)
        )

    def test_where_and_how_large_the_drag_is_taken(self):
        whole = state(cavity(0.022))
        half = state(cavity(0.022, planing_drag_factor=0.5, planing_position="tail"))
        assert close(2 * half.F_PX) == whole.F_PX
        assert half.F_PY == whole.F_PY
        assert whole.x_P < half.x_P == 6.0

    def test_sign_follows_the_offset(self):
        up, down = state(cavity(0.02, speed=40.0)), state(cavity(0.02, gravity=0, theta=-0.1))
        assert up.F_PY > 0 > down.F_PY

    def test_flag(self):
        assert not state(cavity(0.018)).all_round
        assert state(cavity(0.022)).all_round  # R_c < 0.19 at the tail
        assert state(cavity(0.03)).all_round  # closed ahead of the tail


def bisect(function, low, high):
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (
            (middle, high) if (function(middle) > 0) == (function(low) > 0) else (low, middle)
        )
    return low, high


class TestLimitsAreContinuous:
    """Just below and just above each change of regime the results agree."""

    @staticmethod
    def agree(below, above, tolerance=1e-5):
        for name in ("F_PX", "F_PY", "area", "length", "h", "R_prime", "alpha_p"):
            a, b = getattr(below, name), getattr(above, name)
            assert math.isfinite(a)
            assert math.isfinite(b)
            scale = {"F_PX": 1e4, "F_PY": 1e5}.get(name, 1.0)
            assert abs(a - b) <= tolerance * scale, name

    @pytest.mark.parametrize("rise", ["paper", "buoyancy", "none"])
    @pytest.mark.parametrize("angle", [0.0, 0.17])
    @pytest.mark.parametrize(
        "quantity",
        [
            lambda c: float(c.L_c) - 6.0,  # the cavity closes at the tail
            lambda c: float(c.radius(6.0)) - 0.19,  # as wide as the tail
            lambda c: float(c.L_c) / 2 - 6.0,  # its middle at the tail
            lambda c: abs(c.axis_offset(6.0)) + 0.19 - float(c.radius(6.0)),  # the tail touches
        ],
    )
    def test_in_sigma(self, quantity, angle, rise):
        def made(sigma):
            return cavity(sigma, angle=angle, gravity_rise=rise, speed=60.0)

        low, high = bisect(lambda s: quantity(made(s)), 0.003, 0.03)
        self.agree(state(made(low * (1 - 1e-12))), state(made(high * (1 + 1e-12))))

    @pytest.mark.parametrize("sigma", [0.01, 0.018, 0.02, 0.022, 0.025, 0.04])
    def test_no_angle(self, sigma):
        self.agree(state(cavity(sigma, angle=0.0)), state(cavity(sigma, angle=1e-9)))

    @pytest.mark.parametrize("sigma", [0.01, 0.018, 0.02, 0.022, 0.025, 0.04])
    def test_no_gravity(self, sigma):
        none, little = cavity(sigma, gravity=0), cavity(sigma, gravity=1e-9)
        self.agree(state(none), state(little))

    @pytest.mark.parametrize("sigma", [0.018, 0.02, 0.022, 0.025, 0.04])
    def test_offset_through_zero(self, sigma):
        for theta in (-1e-9, 0.0):
            a = cavity(sigma, theta=theta, gravity=0, distortion="none")
            b = cavity(sigma, theta=theta + 1e-9, gravity=0, distortion="none")
            self.agree(state(a), state(b))


class TestRanges:
    known = Range("a law", "sigma", 0.1, 0.5, "a book", "stay inside")

    def test_check(self):
        assert self.known.check(0.3) == ("a law", "sigma", 0.3, 0.1, 0.5, True)
        assert not self.known.check(0.6).inside

    def test_warning(self):
        words = "a law: sigma = 0.6 is outside its range, 0.1 to 0.5: stay inside."
        assert self.known.warning(0.6) == words

    def test_every_correlation_has_a_range_with_its_source(self):
        modules = (disk, hole, fins, tail)
        found = [r for module in modules for r in vars(module).values() if isinstance(r, Range)]
        assert len(found) == 10
        assert all(r.source and r.advice and r.low < r.high for r in found)
