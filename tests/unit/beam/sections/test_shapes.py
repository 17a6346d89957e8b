"""Formulas of sections against integrals over their areas, and against printed numbers."""

import numpy as np
import pytest
from mpmath import mp, mpf, nsum, pi, quad, tanh

from antinode.beam.sections.shapes import SHAPES, shape_of

CIRCLE, TUBE, RECTANGLE, BOX = (SHAPES[n] for n in ("circle", "tube", "rectangle", "box"))


def test_a_tube_is_a_circle_less_a_circle():
    D, t = 0.4, 0.03
    d = D - 2 * t
    assert TUBE.area(D, t) == pytest.approx(np.pi / 4 * (D**2 - d**2), rel=1e-14)
    assert TUBE.second_moment(D, t) == pytest.approx(np.pi / 64 * (D**4 - d**4), rel=1e-14)
    assert TUBE.torsion_constant(D, t) == pytest.approx(np.pi / 32 * (D**4 - d**4), rel=1e-14)


def test_a_tube_whose_wall_is_its_radius_is_solid():
    for name in ("area", "second_moment", "polar_moment", "torsion_constant"):
        solid, tube = getattr(CIRCLE, name)(0.4), getattr(TUBE, name)(0.4, 0.2)
        assert tube == pytest.approx(solid, rel=1e-14)
    assert TUBE.shear_area(0.3, 0.4, 0.2) == pytest.approx(CIRCLE.shear_area(0.3, 0.4), rel=1e-14)


def test_a_box_is_a_rectangle_less_a_rectangle():
    w, h, t = 0.3, 0.5, 0.02
    for name in ("area", "second_moment", "polar_moment"):
        outer, inner = (getattr(RECTANGLE, name)(w - s, h - s) for s in (0, 2 * t))
        assert getattr(BOX, name)(w, h, t) == pytest.approx(outer - inner, rel=1e-13)


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
def test_shear_coefficients_in_limits_that_are_printed(nu):
    """Cowper (1966), Table 1: thin round tube, thin square tube, solid circle, rectangle."""
    thin = TUBE.shear_area(nu, 1.0, 1e-6) / TUBE.area(1.0, 1e-6)
    assert thin == pytest.approx(2 * (1 + nu) / (4 + 3 * nu), rel=1e-5)
    square = BOX.shear_area(nu, 1.0, 1.0, 1e-3) / BOX.area(1.0, 1.0, 1e-3)
    assert square == pytest.approx(20 * (1 + nu) / (48 + 39 * nu), rel=1e-12)
    solid = TUBE.shear_area(nu, 1.0, 0.5) / TUBE.area(1.0, 0.5)
    assert solid == pytest.approx(6 * (1 + nu) / (7 + 6 * nu), rel=1e-14)
    webs = BOX.shear_area(nu, 1e-6, 1.0, 1e-7) / BOX.area(1e-6, 1.0, 1e-7)
    assert webs == pytest.approx(10 * (1 + nu) / (12 + 11 * nu), rel=1e-4)


def test_without_lateral_contraction_kappa_is_that_of_jourawskis_stress():
    """nu = 0: kappa = I^2/(A int (S/b)^2/b dA) of thin walls and rectangles."""
    b, h, t = 0.3, 0.5, 1e-4
    area, second = 2 * t * (b + h), 2 * t * (b * h**2 / 4 + h**3 / 12)
    flange = quad(lambda s: (s * h / 2) ** 2, [0, b / 2])
    web = quad(lambda y: (b / 2 * h / 2 + (h**2 / 4 - y**2) / 2) ** 2, [0, h / 2])
    kappa = float(second**2 / (area * 4 * t * (flange + web)))
    assert BOX.shear_area(0.0, b + t, h + t, t) / BOX.area(b + t, h + t, t) == pytest.approx(
        kappa, rel=2e-3
    )


def test_st_venants_series():
    assert RECTANGLE.torsion_constant(1.0, 1.0) == pytest.approx(0.140577014955, abs=5e-13)
    with mp.workdps(30):
        for a, b in ((3, 1), (mpf("1.2"), 1), (20, 1)):
            sums = nsum(
                lambda k, a=a, b=b: tanh((2 * k + 1) * pi * a / (2 * b)) / (2 * k + 1) ** 5,
                [0, mp.inf],
            )
            J = float(a * mpf(b) ** 3 * (mpf(1) / 3 - 64 / pi**5 * b / a * sums))
            for sides in ((a, b), (b, a)):
                assert RECTANGLE.torsion_constant(*map(float, sides)) == pytest.approx(J, rel=1e-14)


def test_bredts_box():
    assert BOX.torsion_constant(1.01, 2.01, 0.01) == pytest.approx(4 * 2.0**2 * 0.01 / 6, rel=1e-12)


@pytest.mark.parametrize(
    ("given", "name"),
    [
        (["outer_diameter"], "circle"),
        (["wall", "outer_diameter"], "tube"),
        (["width", "height"], "rectangle"),
        (["width", "height", "wall"], "box"),
        (["area", "second_moment"], "properties"),
        (["area", "second_moment", "shear_area"], "properties"),
    ],
)
def test_columns_tell_the_shape(given, name):
    assert shape_of(given).name == name


@pytest.mark.parametrize(
    "given",
    [["wall"], ["width"], ["outer_diameter", "width", "height"], ["area", "wall"], ["area"]],
)
def test_columns_of_no_shape_are_refused(given):
    with pytest.raises(ValueError, match="give outer_diameter"):
        shape_of(given)
