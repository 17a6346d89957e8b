"""One cross-section of one material, and the columns of a beam that follow from it.

pipe = Section(steel, outer_diameter="168 mm", wall="7.1 mm")
beam = pipe.beam([0, 6], ends=Ends("clamped"))
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Self

import numpy as np
import numpy.typing as npt

from antinode.beam.beam import Beam
from antinode.errors import InputError
from antinode.inputs.given import in_si
from antinode.inputs.reading import COLUMN_UNITS

from .drawing import Drawing
from .drawn import drawn_beam
from .library import properties_of
from .material import Material
from .shapes import DIMENSIONS, shape_of


@dataclass(frozen=True)
class Section:
    """A cross-section: its dimensions and its material.

    Parameters
    ----------
    material : Material
    outer_diameter, wall : float or str, optional
        Of a tube [m], solid without `wall`.
    width, height : float or str, optional
        Of a box [m], with `wall`, or of a solid rectangle; it bends along its height.
    area, second_moment, shear_area, polar_moment, torsion_constant : float or str, optional
        Of any other section [m^2, m^4, m^2, m^4, m^4]; the last three where they are known.

    Raises
    ------
    InputError
        If the dimensions make no section.

    Examples
    --------
    >>> rod = Section(Material(youngs_modulus=210e9, density=7850), outer_diameter="20 mm")
    >>> round(rod.columns["mass_per_length"], 4)
    2.4662
    """

    material: Material
    outer_diameter: float | None = None
    wall: float | None = None
    width: float | None = None
    height: float | None = None
    area: float | None = None
    second_moment: float | None = None
    shear_area: float | None = None
    polar_moment: float | None = None
    torsion_constant: float | None = None

    if TYPE_CHECKING:  # what the fields are made of

        def __init__(
            self,
            material: Material,
            outer_diameter: float | str | None = None,
            wall: float | str | None = None,
            width: float | str | None = None,
            height: float | str | None = None,
            area: float | str | None = None,
            second_moment: float | str | None = None,
            shear_area: float | str | None = None,
            polar_moment: float | str | None = None,
            torsion_constant: float | str | None = None,
        ) -> None: ...

    def __post_init__(self) -> None:
        if not isinstance(self.material, Material):
            raise InputError(
                "a section needs its material first, such as "
                "Section(Material(youngs_modulus='210 GPa', density='7850 kg/m^3'), width=...)"
            )
        for name in DIMENSIONS:
            value = getattr(self, name)
            if value is not None:
                object.__setattr__(self, name, _number(name, value))
        _ = self.columns

    @classmethod
    def of_outline(cls, outline: Any, material: Material) -> Self:
        """Return the section of an outline from `sectionproperties`, drawn in metres."""
        return cls(material, **properties_of(outline))

    @property
    def dimensions(self) -> dict[str, float]:
        """The dimensions that are given, by name [m, m^2, m^4]."""
        given = {name: getattr(self, name) for name in DIMENSIONS}
        return {name: value for name, value in given.items() if value is not None}

    @cached_property
    def columns(self) -> dict[str, float]:
        """The columns of a `Beam` that follow, by name: ``Beam([0, 6], **section.columns)``."""
        try:
            shape = shape_of(self.dimensions).name
        except ValueError as error:
            raise InputError(str(error)) from error
        ends = {name: np.full((1, 2), value) for name, value in self.dimensions.items()}
        tables = Drawing(np.array([0.0, 1.0]), shape, ends, self.material).columns.tables
        return {name: float(table[0, 0]) for name, table in tables.items()}

    def beam(self, x: npt.ArrayLike, **settings: Any) -> Beam:
        """Return a beam of this section all along.

        Parameters
        ----------
        x : array_like, shape (n + 1,)
            Stations [m].
        **settings
            As `drawn_beam` takes them: ends, theory, shear_form, name, axial_force, ...
        """
        return drawn_beam(x, self.material, **settings, **dict[str, Any](self.dimensions))

    def __repr__(self) -> str:
        given = ", ".join(f"{n}={v:g} {COLUMN_UNITS[n]}" for n, v in self.dimensions.items())
        m = self.material
        return f"Section({given}; E = {m.youngs_modulus / 1e9:g} GPa, {m.density:g} kg/m^3)"


def _number(name: str, value: Any) -> float:
    number = in_si(name, value, COLUMN_UNITS[name])
    if np.ndim(number) or not isinstance(number, int | float | np.number):
        raise InputError(f"{name} of a section is {value}; give one number, or use drawn_beam")
    return float(number)
