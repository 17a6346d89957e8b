"""The material of a beam that is given by its sections: the table `[beam.material]`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from pydantic import Field

from antinode.inputs.units import Density, Frozen, Number, Pressure


class Material(Frozen):
    """A linear elastic, isotropic material.

    Also in Python: ``Material(youngs_modulus=210e9, density=7850)``, or with units as texts.
    """

    youngs_modulus: Annotated[Pressure, Field(gt=0)] = Field(description="E [Pa]")
    density: Annotated[Density, Field(gt=0)] = Field(description="rho [kg/m^3]")
    poisson_ratio: Annotated[Number, Field(gt=-1, le=0.5)] = Field(
        0.3, description="nu: G = E/(2 (1 + nu))"
    )
    shear_coefficient: Annotated[Number, Field(gt=0, le=1)] | None = Field(
        None, description="kappa in kGA; by default Cowper's of the section"
    )

    if TYPE_CHECKING:  # what the fields are made of

        def __init__(
            self,
            *,
            youngs_modulus: float | str,
            density: float | str,
            poisson_ratio: float | str = 0.3,
            shear_coefficient: float | str | None = None,
        ) -> None: ...

    @property
    def shear_modulus(self) -> float:
        """G [Pa]."""
        return self.youngs_modulus / (2 * (1 + self.poisson_ratio))
