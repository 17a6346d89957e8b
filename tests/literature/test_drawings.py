"""Published benchmarks, from their drawings: square bars, tapered cantilevers, a drill string."""

import numpy as np
import pytest

import antinode as an
from antinode.beam.attachments import PointMass
from antinode.beam.sections import Material, drawn_beam

STEEL = Material(youngs_modulus="200 GPa", density=8000)


def hertz(beam, modes, family="bending"):
    result = an.solve_modes(beam, modes, families=(family,), tolerance=1e-10)
    return [result.mode(family, k).frequency_hz for k in range(1, modes + 1)]


def square(length, ends, **more):
    return drawn_beam([0, length], STEEL, width=0.125, height=0.125, ends=an.Ends(*ends), **more)


@pytest.mark.parametrize(
    ("ends", "modes", "published", "exact"),
    [
        (("pinned", "pinned"), 2, [11.336, 45.345], [11.336246, 45.344984]),
        (("clamped", "pinned"), 2, [17.709, 57.390], [17.709380, 57.389734]),
    ],
)
def test_nafems_fv1_fv2_an_arm_of_the_crosses(ends, modes, published, exact):
    """NAFEMS R0015, FV1 and FV2 (pin-ended cross, double cross): arms of 5 m, square 0.125 m.

    The arms are straight beams by themselves; the targets are Euler-Bernoulli's. Exact: beta L of
    tables, 12 digits.
    """
    found = hertz(square(5.0, ends, theory="euler_bernoulli"), modes)
    assert found == pytest.approx(exact, abs=2e-6)
    assert found == pytest.approx(published, abs=6e-4)
    assert np.all(np.array(hertz(square(5.0, ends), modes)) < found)


def test_nafems_71_a_cantilever():
    """NAFEMS, "Test 71": 10 m, square 0.125 m."""
    found = hertz(square(10.0, ("clamped", "free"), theory="euler_bernoulli"), 6)
    exact = [1.0096254, 6.3272145, 17.716384, 34.717042, 57.389757, 85.730361]
    assert found == pytest.approx(exact, rel=6e-8)
    assert found == pytest.approx([1.010, 6.327, 17.720, 34.720, 57.390, 85.730], rel=4e-4)


DEEP = {"width": 2.0, "height": 2.0}
DEEP_ENDS = an.Ends("pinned", "pinned", "fixed", "free", "fixed", "free")


@pytest.mark.parametrize(
    ("kappa", "exact"),
    [
        (None, [42.6449092, 148.149335, 283.468389]),
        (5 / 6, [42.6087173, 147.786012, 282.363385]),
        (0.85, [42.6456198, 148.156483, 283.490168]),
    ],
)
def test_nafems_fv5_a_deep_beam(kappa, exact):
    """NAFEMS FV5: simply supported, 10 m, square 2 m; targets 42.650, 148.15, 283.47 Hz.

    Altair's pages call 42.649, 148.31, 284.55 closed form; these are elements. Exact: Timoshenko's
    frequency equation of pinned ends; kappa by Cowper, 10 (1+nu)/(12+11 nu), unless given.
    """
    material = STEEL.model_copy(update={"shear_coefficient": kappa})
    beam = drawn_beam([0, 10], material, ends=DEEP_ENDS, **DEEP)
    found = hertz(beam, 3)
    assert found == pytest.approx(exact, rel=3e-9)
    assert found == pytest.approx([42.650, 148.15, 283.47], rel=4e-3)


def test_nafems_fv5_torsion_and_axial():
    """NAFEMS FV5: torsion 71.20, 213.61, axial 125.00 Hz, one end held against both.

    With J = 0.140577 a^4; 77.542 of other pages is that of J = I_p.
    """
    beam = drawn_beam([0, 10], STEEL, ends=DEEP_ENDS, **DEEP)
    assert hertz(beam, 2, "torsion") == pytest.approx([71.1960866, 213.58826], rel=1e-8)
    assert hertz(beam, 1, "longitudinal") == pytest.approx([125.0], rel=1e-12)


def test_vpcs_sdlv100_a_tapered_cantilever():
    """VPCS, SDLV100 and CATIA: 1 m, square 40 to 10 mm, E 200 GPa, rho 7800 kg/m^3.

    The published ones are finite elements of Euler-Bernoulli's beam; the others that beam's in 30
    digits (`drawn_beams`).
    """
    material = Material(youngs_modulus="200 GPa", density=7800)
    sides, ends = [0.04, 0.01], an.Ends("clamped", "free")
    beam = drawn_beam(
        [0, 1], material, ends=ends, width=sides, height=sides, theory="euler_bernoulli"
    )
    found = hertz(beam, 5)
    assert found == pytest.approx([54.18, 171.94, 384.40, 697.24, 1112.28], rel=4e-4)
    in_steel = [54.188721046, 171.96981675, 384.53123830, 697.42851078, 1112.4710044]
    assert found == pytest.approx(in_steel, rel=1e-7)


def test_a_drill_string_with_a_bit():
    """W. T. Thomson, Theory of Vibration; Rice University, MECH 517: pipe of 5000 ft, collar J_0.

    G 1.728e9 lb/ft^2, rho 15.22 slug/ft^3, I_p 9.4e-4 ft^4, J_0 29.3 lb ft s^2: published "about"
    2.41 and 7.93 rad/s; beta tan beta = rho I_p L/J_0 = 2.44, 40 digits.
    """
    foot, pound = 0.3048, 4.4482216152605
    G, rho = 1.728e9 * pound / foot**2, 15.22 * 14.593902937206 / foot**3
    material = Material(youngs_modulus=G * 2.6, density=rho)
    Ip, area = 9.4e-4 * foot**4, 0.02 * foot**2
    beam = drawn_beam(
        [0, 5000 * foot],
        material,
        area=area,
        second_moment=Ip / 2,
        polar_moment=Ip,
        torsion_constant=Ip,
        ends=an.Ends("pinned", "free", left_torsion="fixed"),
    ).with_attachments(PointMass(5000 * foot, 1.0, polar_inertia=29.3 * pound * foot))
    omega = 2 * np.pi * np.array(hertz(beam, 3, "torsion"))
    assert omega == pytest.approx([2.41974858, 7.93204434, 14.1411150], rel=1e-8)
