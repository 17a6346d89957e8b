"""Cross-sections by their dimensions, and what follows from these: A, I, I_p, J, kappa.

Bending moves the section along its height, Y. All but J and kappa are exact; J of a circle is too,
that of a rectangle is St Venant's series, and that of a box is for thin walls. kappa is Cowper's
(J. Appl. Mech. 33 (1966) 335-340, Table 1): the deflection of a section as the mean over its area,
without what the wall's own warping adds near a support. The formulas take numbers, arrays or, where
`fitted` does not name them, polynomials along the beam; no difference in them cancels.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from math import pi
from typing import Any, ClassVar, Protocol

import numpy as np

THIN_TUBE = 4 + 3 * 0.3
"""EA/kGA of a thin-walled tube of nu = 0.3 (Cowper): kappa = 2 (1 + nu)/(4 + 3 nu) = 0.53."""


class Shape(Protocol):
    """A kind of cross-section.

    Its functions take the dimensions in the order of `dimensions`, and give SI.
    """

    name: ClassVar[str]
    dimensions: ClassVar[tuple[str, ...]]
    fitted: ClassVar[frozenset[str]]
    """Properties that are no polynomials of the dimensions."""

    def area(self, *d: Any) -> Any:
        """Return A [m^2]."""

    def second_moment(self, *d: Any) -> Any:
        """Return I of bending [m^4]."""

    def polar_moment(self, *d: Any) -> Any:
        """Return I_p about the centroid [m^4]."""

    def torsion_constant(self, *d: Any) -> Any:
        """Return J [m^4]."""

    def shear_area(self, nu: float, *d: Any) -> Any:
        """Return kappa A [m^2], of kGA = G kappa A."""

    def refusal(self, *d: Any) -> tuple[Any, str]:
        """Return at which rows the dimensions make no section, and what is wrong there."""


class Circle:
    """A solid circle: outer diameter D."""

    name: ClassVar[str] = "circle"
    dimensions: ClassVar[tuple[str, ...]] = ("outer_diameter",)
    fitted: ClassVar[frozenset[str]] = frozenset()

    def area(self, D: Any) -> Any:
        """Return pi/4 D^2."""
        return pi / 4 * (D * D)

    def second_moment(self, D: Any) -> Any:
        """Return pi/64 D^4."""
        return pi / 64 * (D * D * D * D)

    def polar_moment(self, D: Any) -> Any:
        """Return 2 I."""
        return 2.0 * self.second_moment(D)

    def torsion_constant(self, D: Any) -> Any:
        """Return I_p: a circle does not warp."""
        return self.polar_moment(D)

    def shear_area(self, nu: float, D: Any) -> Any:
        """Return Cowper's circle, kappa = 6 (1+nu)/(7+6 nu)."""
        return 6 * (1 + nu) / (7 + 6 * nu) * self.area(D)

    def refusal(self, D: Any) -> tuple[Any, str]:
        """Refuse nothing."""
        return np.zeros(D.shape, dtype=bool), ""


class Tube:
    """A circular tube: outer diameter D, wall t; solid where t = D/2."""

    name: ClassVar[str] = "tube"
    dimensions: ClassVar[tuple[str, ...]] = "outer_diameter", "wall"
    fitted: ClassVar[frozenset[str]] = frozenset({"shear_area"})

    def area(self, D: Any, t: Any) -> Any:
        """Return pi/4 (D^2 - d^2) = pi t (D - t)."""
        return pi * (t * (D - t))

    def second_moment(self, D: Any, t: Any) -> Any:
        """Return pi/64 (D^4 - d^4) = pi/8 t (D - t) ((D - t)^2 + t^2)."""
        mean = D - t
        return pi / 8 * (t * mean * (mean * mean + t * t))

    def polar_moment(self, D: Any, t: Any) -> Any:
        """Return 2 I."""
        return 2.0 * self.second_moment(D, t)

    def torsion_constant(self, D: Any, t: Any) -> Any:
        """Return I_p: a circle does not warp."""
        return self.polar_moment(D, t)

    def shear_area(self, nu: float, D: Any, t: Any) -> Any:
        """Return Cowper's hollow circle, with n = (d/D)^2.

        kappa = 6 (1+nu) (1+n)^2 / ((7+6 nu) (1+n)^2 + (20+12 nu) n): 6 (1+nu)/(7+6 nu) of a solid
        circle, 2 (1+nu)/(4+3 nu) of a thin tube, so that kGA = EA/(4+3 nu) there.
        """
        n = ((D - 2 * t) / D) ** 2
        square = (1 + n) ** 2
        kappa = 6 * (1 + nu) * square / ((7 + 6 * nu) * square + (20 + 12 * nu) * n)
        return kappa * self.area(D, t)

    def refusal(self, D: Any, t: Any) -> tuple[Any, str]:
        """Refuse a wall that is thicker than the radius."""
        return t > D / 2 * (1 + 1e-12), "wall must be at most half of outer_diameter, the radius"


class Rectangle:
    """A solid rectangle: width w, height h along Y."""

    name: ClassVar[str] = "rectangle"
    dimensions: ClassVar[tuple[str, ...]] = "width", "height"
    fitted: ClassVar[frozenset[str]] = frozenset({"torsion_constant"})

    def area(self, w: Any, h: Any) -> Any:
        """Return w h."""
        return w * h

    def second_moment(self, w: Any, h: Any) -> Any:
        """Return w h^3/12."""
        return 1 / 12 * (w * h * h * h)

    def polar_moment(self, w: Any, h: Any) -> Any:
        """Return w h (w^2 + h^2)/12."""
        return 1 / 12 * (w * h * (w * w + h * h))

    def torsion_constant(self, w: Any, h: Any) -> Any:
        """Return St Venant's series, 0.140577014955 a^4 of a square.

        J = a b^3 (1/3 - 64/pi^5 b/a sum over odd n of tanh(n pi a/(2 b))/n^5), a >= b.
        """
        a, b = np.maximum(w, h), np.minimum(w, h)
        n = np.arange(1.0, 26.0, 2.0)
        e = np.exp(-pi * n * (a / b)[..., None])
        rest = 2 * e / (1 + e) / n**5  # 1 - tanh
        return a * b**3 / 3 - 64 / pi**5 * b**4 * (_ODD - np.sum(rest, axis=-1))

    def shear_area(self, nu: float, w: Any, h: Any) -> Any:
        """Return Cowper's rectangle, kappa = 10 (1+nu)/(12+11 nu)."""
        return 10 * (1 + nu) / (12 + 11 * nu) * (w * h)

    def refusal(self, w: Any, h: Any) -> tuple[Any, str]:
        """Refuse nothing."""
        return np.zeros(w.shape, dtype=bool), ""


_ODD = 31 / 32 * 1.0369277551433699
"""Sum of 1/n^5 over odd n: 31/32 zeta(5)."""


class Box:
    """A rectangular box: outer width w, height h along Y, one wall t all round."""

    name: ClassVar[str] = "box"
    dimensions: ClassVar[tuple[str, ...]] = "width", "height", "wall"
    fitted: ClassVar[frozenset[str]] = frozenset({"torsion_constant", "shear_area"})

    def area(self, w: Any, h: Any, t: Any) -> Any:
        """Return w h - (w - 2t) (h - 2t) = 2 t (w + h - 2t)."""
        return 2.0 * (t * ((w - t) + (h - t)))

    def second_moment(self, w: Any, h: Any, t: Any) -> Any:
        """Return (w h^3 - (w - 2t) (h - 2t)^3)/12, as two flanges and two webs."""
        arm, web = h - t, h - 2.0 * t
        return 1 / 6 * (t * (w * (3.0 * (arm * arm) + t * t) + web * web * web))

    def polar_moment(self, w: Any, h: Any, t: Any) -> Any:
        """Return the sum of I about both axes."""
        return self.second_moment(w, h, t) + self.second_moment(h, w, t)

    def torsion_constant(self, w: Any, h: Any, t: Any) -> Any:
        """Return Bredt's closed cell, 4 A_m^2 t/s: A_m and s of the middle line.

        For thin walls: of a square with sharp corners it is 0.5 % low at t = w/100, 2.5 % at w/20,
        5.5 % at w/10 (St Venant's problem by finite elements).
        """
        b, a = w - t, h - t
        return 2 * t * (a * b) ** 2 / (a + b)

    def shear_area(self, nu: float, w: Any, h: Any, t: Any) -> Any:
        """Return Cowper's thin-walled box, with n = m = b/h of the middle line."""
        n = (w - t) / (h - t)
        solid = 12 + 72 * n + 150 * n**2 + 90 * n**3
        by_nu = 11 + 66 * n + 135 * n**2 + 90 * n**3
        wide = 10 * n**2 * ((3 + nu) * n + 3 * n**2)
        kappa = 10 * (1 + nu) * (1 + 3 * n) ** 2 / (solid + nu * by_nu + wide)
        return kappa * self.area(w, h, t)

    def refusal(self, w: Any, h: Any, t: Any) -> tuple[Any, str]:
        """Refuse a wall that leaves no hollow."""
        return (
            2 * t >= np.minimum(w, h),
            "wall must be less than half of width and of height (leave it out for a solid section)",
        )


class Properties:
    """Any other section, by its properties: A, I and, where known, those of shear and torsion.

    What is not known is None.
    """

    name: ClassVar[str] = "properties"
    dimensions: ClassVar[tuple[str, ...]] = (
        "area",
        "second_moment",
        "shear_area",
        "polar_moment",
        "torsion_constant",
    )
    fitted: ClassVar[frozenset[str]] = frozenset()

    def area(self, A: Any, *_: Any) -> Any:
        """Return A."""
        return A

    def second_moment(self, A: Any, I: Any, *_: Any) -> Any:  # noqa: E741
        """Return I."""
        return I

    def shear_area(self, nu: float, *d: Any) -> Any:
        """Return the shear area."""
        return d[2]

    def polar_moment(self, *d: Any) -> Any:
        """Return I_p."""
        return d[3]

    def torsion_constant(self, *d: Any) -> Any:
        """Return J."""
        return d[4]

    def refusal(self, A: Any, *_: Any) -> tuple[Any, str]:
        """Refuse nothing."""
        return np.zeros(A.shape, dtype=bool), ""


SHAPES: Mapping[str, Shape] = {
    shape.name: shape for shape in (Circle(), Tube(), Rectangle(), Box(), Properties())
}
DIMENSIONS = tuple(dict.fromkeys(name for shape in SHAPES.values() for name in shape.dimensions))
"""Columns that stations may have in place of stiffness and mass."""


def shape_of(given: Collection[str]) -> Shape:
    """Return the shape that has these dimensions.

    Raises
    ------
    ValueError
        If no shape has them, or two would share them.
    """
    if "area" in given or "second_moment" in given:
        missing = [name for name in ("area", "second_moment") if name not in given]
        foreign = [name for name in given if name not in Properties.dimensions]
        if not missing and not foreign:
            return SHAPES["properties"]
    for shape in SHAPES.values():
        if set(shape.dimensions) == set(given):
            return shape
    told = ", ".join(given)
    raise ValueError(
        f"no section has the columns {told}: give outer_diameter (and wall) for a tube, width and "
        "height (and wall) for a box, or area and second_moment for any other section"
    )
