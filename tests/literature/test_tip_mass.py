"""Cantilevers with a mass at the tip, with and without rotary inertia; rods with an end mass.

All with m = EI = EA = L = 1: omega = (beta L)^2 in bending, beta L along the rod.
"""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from antinode.beam.attachments import PointMass, Spring
from literature.published import check_printed, omegas, unit_beam

LAURA = {0.2: "1.6164", 0.4: "1.4724", 0.6: "1.3757", 0.8: "1.3041", 1.0: "1.2479"}

CARSLAW = {
    0.1: "0.3111 3.1731 6.2991 9.4354",
    0.5: "0.6533 3.2923 6.3616 9.4775",
    1.0: "0.8603 3.4256 6.4373 9.5293",
    2.0: "1.0769 3.6436 6.5783 9.6296",
    5.0: "1.3138 4.0336 6.9096 9.8928",
    10.0: "1.4289 4.3058 7.2281 10.2003",
}


@pytest.mark.parametrize("ratio", LAURA)
def test_laura_1974_tip_mass(ratio):
    """P. A. A. Laura, J. L. Pombo, E. A. Susemihl, A note on the vibrations of a clamped-free beam
    with a mass at the free end, Journal of Sound and Vibration 37 (1974) 161-168: first beta L.
    """
    problem = unit_beam("clamped", "free").with_attachments(PointMass(1.0, ratio))
    check_printed(np.sqrt(omegas(problem, 1)), LAURA[ratio])


def erturk_inman(x, M, J):
    """J. Vibration and Acoustics 130 (2008) 041002; Piezoelectric Energy Harvesting (2011)."""
    c, s, C, S = math.cos(x), math.sin(x), math.cosh(x), math.sinh(x)
    value = 1 + c * C + x * M * (c * S - s * C)
    value += -(x**3) * J * (C * s + S * c) + x**4 * M * J * (1 - c * C)
    return value / C


@pytest.mark.parametrize("mass", [0.1, 1.0, 10.0])
@pytest.mark.parametrize("inertia", [0.001, 0.05, 0.5, 5.0])
def test_erturk_inman_2008_tip_mass_with_inertia(mass, inertia):
    """A. Erturk, D. J. Inman, A distributed parameter electromechanical model for cantilevered
    piezoelectric energy harvesters, Journal of Vibration and Acoustics 130 (2008) 041002, and
    their book Piezoelectric Energy Harvesting (Wiley 2011), Appendix C: frequency equation of a
    cantilever with tip mass M_t and mass moment of inertia I_t, both about the tip.
    """
    problem = unit_beam("clamped", "free").with_attachments(PointMass(1.0, mass, inertia))
    x = np.linspace(1e-3, 17.0, 4000)
    f = [erturk_inman(v, mass, inertia) for v in x]
    pairs = [(a, b) for a, b, p, q in zip(x, x[1:], f, f[1:], strict=False) if p * q < 0]
    roots = [brentq(erturk_inman, a, b, (mass, inertia), xtol=1e-14) for a, b in pairs]
    np.testing.assert_allclose(np.sqrt(omegas(problem, 5)), roots[:5], rtol=1e-11)


def test_hodges_pierce_2011_pinned_end_with_inertia():
    """D. H. Hodges, G. A. Pierce, Introduction to Structural Dynamics and Aeroelasticity, 2nd ed.
    (Cambridge 2011), Problem 3.14: clamped-pinned, rotary inertia m L^3 at the pinned end.
    """
    problem = unit_beam("clamped", "pinned").with_attachments(PointMass(1.0, 1e-12, 1.0))
    check_printed(omegas(problem, 1), "1.99048")


def test_hodges_pierce_2011_root_spring():
    """The same book, Tables 3.10 and 3.11: pinned at the root with a spring EI/L, free."""
    problem = unit_beam("pinned", "free").with_attachments(Spring(0.0, rotational=1.0))
    check_printed(omegas(problem, 2), "1.55730 16.2501")


@pytest.mark.parametrize("C", CARSLAW)
def test_carslaw_jaeger_1959_rod_with_end_mass(C):
    """H. S. Carslaw, J. C. Jaeger, Conduction of Heat in Solids, 2nd ed. (Oxford 1959), Appendix
    IV, Table I: roots of alpha tan alpha = C. A rod fixed at one end with a mass M at the other
    vibrates along its axis with alpha = beta L and C = m L/M.
    """
    problem = unit_beam("clamped", "free", EA=1.0).with_attachments(PointMass(1.0, 1 / C))
    check_printed(omegas(problem, 4, "longitudinal"), CARSLAW[C])
