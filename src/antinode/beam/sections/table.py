"""Columns of sections in a table of stations, and the drawing that they make with a material."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Annotated

import numpy as np
from pydantic import Field

from antinode.arrays import Array, Interpolation
from antinode.beam.profile import breakpoints, interval_ends, kept_intervals
from antinode.inputs.columns import Column
from antinode.inputs.units import Frozen
from antinode.text import listed

from .drawing import PROPERTIES, Drawing
from .material import Material
from .shapes import DIMENSIONS, shape_of


class SectionColumns(Frozen):
    """Dimensions of the section in place of mass and stiffness, beside `[beam.material]`."""

    outer_diameter: Annotated[Array, Column("m")] | None = Field(
        None, description="of a tube, or of a solid circle without wall [m]"
    )
    width: Annotated[Array, Column("m")] | None = Field(
        None, description="of a box, or of a solid rectangle without wall [m]"
    )
    height: Annotated[Array, Column("m")] | None = Field(
        None, description="along Y, in which the beam bends [m]"
    )
    wall: Annotated[Array, Column("m")] | None = Field(
        None, description="of tube or box [m]; without it the section is solid"
    )
    area: Annotated[Array, Column("m^2")] | None = Field(
        None, description="A of any other section [m^2]; with second_moment"
    )
    second_moment: Annotated[Array, Column("m^4")] | None = Field(
        None, description="I of bending along Y [m^4]"
    )
    shear_area: Annotated[Array, Column("m^2")] | None = Field(
        None, description="kappa A along Y [m^2]; without it and shear_coefficient rigid in shear"
    )
    polar_moment: Annotated[Array, Column("m^4")] | None = Field(
        None, description="I_p about the centroid [m^4]; beside torsion_constant"
    )
    torsion_constant: Annotated[Array, Column("m^4")] | None = Field(
        None, description="J [m^4]; without it there are no torsion modes"
    )

    def dimensions(self) -> dict[str, Array]:
        """Return the columns that are given."""
        columns = {name: getattr(self, name) for name in DIMENSIONS}
        return {name: column for name, column in columns.items() if column is not None}

    def check_sections(self) -> None:
        """Raise ValueError if the columns are those of no section, or a row is none.

        Beside them a column of what follows from them is one too many.
        """
        given = self.dimensions()
        if not given:
            return
        both = [
            n for n in (*PROPERTIES, "radius_of_gyration") if getattr(self, n, None) is not None
        ]
        if both:
            more = "; add further masses by [[beam.masses]]" if both == ["mass_per_length"] else ""
            raise ValueError(
                f"{listed(given)} and {both[0]} are both given, but mass and stiffness follow from "
                f"the section and [beam.material]: remove one of them{more}"
            )
        shape = shape_of(given)
        if ("polar_moment" in given) != ("torsion_constant" in given):
            raise ValueError("give both polar_moment and torsion_constant, or neither")
        wrong, why = shape.refusal(*(given.get(name) for name in shape.dimensions))
        for i in np.flatnonzero(wrong)[:1]:
            row = ", ".join(f"{name} {column[i]:.6g} m" for name, column in given.items())
            raise ValueError(f"row {i + 1} has {row}: {why}")


def check_material(dimensions: Collection[str], material: object, how: Interpolation) -> None:
    """Raise ValueError unless section and material are both there, or neither is."""
    if dimensions and material is None:
        raise ValueError(
            f"stations have {listed(dimensions)}, but [beam.material] is missing: give its "
            "youngs_modulus and density"
        )
    if material is not None and not dimensions:
        raise ValueError(
            "[beam.material] is given, but stations have no section: give outer_diameter (and "
            "wall), width and height (and wall), or area and second_moment; or remove the material"
        )
    if dimensions and how == "log":
        raise ValueError(LOG_OF_DIMENSIONS)


LOG_OF_DIMENSIONS = (
    "interpolation = 'log' is for columns of mass and stiffness, but dimensions of a section run "
    "along straight lines: use 'linear', or 'step'"
)


def drawing_of(
    x: Array, dimensions: Mapping[str, Array], material: Material, how: Interpolation
) -> Drawing:
    """Return the drawing of a table of stations.

    Parameters
    ----------
    x : array, shape (n + 1,)
        Stations [m]; two rows at one x are a jump.
    dimensions : dict of array, shape (n + 1,)
        Of one kind of section [m; m^2, m^4].
    material : Material
    how : {"step", "linear"}

    Raises
    ------
    ValueError
        If no section has these dimensions.
    InputError
        If they make no section.
    """
    kept = kept_intervals(x, how)
    ends = {name: interval_ends(column, kept, how) for name, column in dimensions.items()}
    return Drawing(breakpoints(x, kept), shape_of(dimensions).name, ends, material)
