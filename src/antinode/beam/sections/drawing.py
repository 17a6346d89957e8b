"""A beam as it is drawn: dimensions of its sections along x, and a material.

Inside an interval the dimensions run along straight lines; mass and stiffness are what follows from
them at every place. Where A, I and J are polynomials of the dimensions they are exact, by their
control values (`beam.curves`). Shear areas and some torsion constants are none: there polynomials
of degree 8 stand for them, in intervals cut so often that both agree to 2e-13.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple, Self

import numpy as np

from antinode.arguments import ByValue
from antinode.arrays import Array
from antinode.beam import curves
from antinode.errors import InputError

from .material import Material
from .shapes import SHAPES, Shape

PROPERTIES = {
    "mass_per_length": "area",
    "bending_stiffness": "second_moment",
    "axial_stiffness": "area",
    "shear_stiffness": "shear_area",
    "rotary_inertia_per_length": "second_moment",
    "torsional_stiffness": "torsion_constant",
    "polar_inertia_per_length": "polar_moment",
}
"""The beam's table, and the property of the section that it follows from."""
_DEGREE = 8
_AGREES = 2e-13  # relative: of a fit, between its places
_MOST_HALVINGS = 40


class Columns(NamedTuple):
    """Breakpoints and tables of a `Beam`, by their names."""

    x: Array
    tables: dict[str, Array]


@dataclass(frozen=True, eq=False)
class Drawing(ByValue):
    """Sections along a beam.

    Parameters
    ----------
    x : array, shape (n + 1,)
        Breakpoints [m].
    shape : {"circle", "tube", "rectangle", "box", "properties"}
    dimensions : dict of array, shape (n, 2)
        Those of the shape [m], at both ends of every interval; of "properties" A [m^2], I [m^4]
        and, where they are known, shear area, polar moment and torsion constant.
    material : Material

    Raises
    ------
    InputError
        If dimensions make no section.
    """

    x: Array
    shape: str
    dimensions: Mapping[str, Array]
    material: Material

    def __post_init__(self) -> None:
        for name, table in self.dimensions.items():
            ok = np.isfinite(table) & (table > 0)
            for k, side in np.argwhere(~ok)[:1]:
                raise InputError(
                    f"{name} must be greater than 0 and finite: interval {k + 1} has "
                    f"{table[k, side]:g}"
                )
        wrong, why = self.kind.refusal(*self._ordered(self.dimensions))
        for k, _ in np.argwhere(wrong)[:1]:
            raise InputError(f"{why}: interval {k + 1}")

    @property
    def kind(self) -> Shape:
        """The shape with its formulas."""
        return SHAPES[self.shape]

    @cached_property
    def columns(self) -> Columns:
        """What of a `Beam` follows; with more breakpoints where a fit needs them."""
        x, ends = self.x, dict(self.dimensions)
        for _ in range(_MOST_HALVINGS):
            coarse = self._misses(ends)
            if not coarse.any():
                break
            x, ends = _halved(x, ends, coarse)
        found = {name: self._table(of, ends) for name, of in PROPERTIES.items()}
        tables = {n: np.asarray(t * self._factor(n)) for n, t in found.items() if t is not None}
        return Columns(x, tables)

    def reversed(self) -> Self:
        """Return it read from the other end."""
        turned = {name: table[::-1, ::-1] for name, table in self.dimensions.items()}
        return type(self)(self.x[-1] + self.x[0] - self.x[::-1], self.shape, turned, self.material)

    def _ordered(self, ends: Mapping[str, Array]) -> list[Array | None]:
        """Return dimensions in the order of the formulas, None for what is not known."""
        return [ends.get(name) for name in self.kind.dimensions]

    def _factor(self, table: str) -> float:
        """Return what makes a table of the beam of the section's property."""
        if table in ("shear_stiffness", "torsional_stiffness"):
            return self.material.shear_modulus
        elastic = table in ("bending_stiffness", "axial_stiffness")
        return self.material.youngs_modulus if elastic else self.material.density

    def _formula(self, which: str, *d: object) -> object:
        """Return a property of the section, None where it is not known."""
        if which != "shear_area":
            return getattr(self.kind, which)(*d)
        kappa = self.material.shear_coefficient
        if kappa is not None:
            return kappa * self.kind.area(*d)
        return self.kind.shear_area(self.material.poisson_ratio, *d)

    def _is_fitted(self, which: str) -> bool:
        constant = which == "shear_area" and self.material.shear_coefficient is not None
        return which in self.kind.fitted and not constant

    def _table(self, which: str, ends: Mapping[str, Array]) -> Array | None:
        """Return the control values of a property; equal ones where no dimension varies."""
        first = self._formula(which, *(t if t is None else t[:, 0] for t in self._ordered(ends)))
        if first is None:
            return None
        varies = np.any([t[:, 0] != t[:, 1] for t in ends.values()], axis=0)
        constant = np.asarray(first)[:, None]
        if not varies.any():
            return np.repeat(constant, 2, axis=1)
        if self._is_fitted(which):
            control = curves.fitted(self._at(which, ends, curves.places(_DEGREE)))
        else:
            d = (t if t is None else curves.Polynomial(t) for t in self._ordered(ends))
            control = self._formula(which, *d).control  # type: ignore[attr-defined]
        return np.asarray(np.where(varies[:, None], control, constant))

    def _at(self, which: str, ends: Mapping[str, Array], t: Array) -> Array:
        """Return a property at places of every interval, (n, places)."""
        d = (e if e is None else e[:, :1] * (1 - t) + e[:, 1:] * t for e in self._ordered(ends))
        return np.asarray(self._formula(which, *d))

    def _misses(self, ends: Mapping[str, Array]) -> Array:
        """Tell for every interval whether a fit is off between its places, or not positive."""
        places = curves.places(_DEGREE)
        between = (places[1:] + places[:-1]) / 2
        misses = np.zeros(len(next(iter(ends.values()))), dtype=bool)
        for which in filter(self._is_fitted, dict.fromkeys(PROPERTIES.values())):
            control = curves.fitted(self._at(which, ends, places))
            wanted = self._at(which, ends, between)
            off = np.abs(curves.value(control[:, None], between) / wanted - 1)
            misses |= (np.max(off, axis=1) > _AGREES) | np.any(control <= 0, axis=1)
        return misses


def _halved(x: Array, ends: Mapping[str, Array], which: Array) -> tuple[Array, dict[str, Array]]:
    """Return breakpoints and dimensions with some intervals cut in two."""
    pieces = np.where(which, 2, 1)
    k = np.repeat(np.arange(len(pieces)), pieces)
    second = np.append(False, k[1:] == k[:-1])
    first = np.append(second[1:], False)
    middle = (x[:-1] + x[1:]) / 2
    left = np.where(second, middle[k], x[:-1][k])

    def cut(table: Array) -> Array:
        half = (table[k, 0] + table[k, 1]) / 2
        return np.stack(
            [np.where(second, half, table[k, 0]), np.where(first, half, table[k, 1])], axis=1
        )

    return np.append(left, x[-1]), {name: cut(table) for name, table in ends.items()}
