"""Parts that add to the mass along an axis, such as a tank: the tables `[[...masses]]`."""

from __future__ import annotations

from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from antinode.arrays import Array
from antinode.inputs.columns import Column, finite, increasing
from antinode.inputs.units import Frozen

from .mass import MassDistribution
from .profile import ROUNDING


class MassTable(Frozen):
    """A part that adds mass along some of the length, such as a tank: `[[...masses]]`."""

    name: str = Field(default="part", max_length=200, description="what it is")
    interpolation: Literal["step", "linear"] = Field(
        default="step", description="how mass_per_length runs between its rows"
    )
    x: Annotated[Array, Column("m")] = Field(description="position [m], increasing")
    mass_per_length: Annotated[Array, Column("kg/m")] = Field(
        description="added mass per length [kg/m], at least 0"
    )
    burns: bool = Field(
        default=False, description="whether it vanishes with burn_fraction (a vehicle's fuel)"
    )

    @model_validator(mode="after")
    def _check_table(self) -> Self:
        increasing(self.x)
        m = self.mass_per_length
        if len(m) != len(self.x):
            raise ValueError(f"mass_per_length has {len(m)} rows, but x has {len(self.x)}")
        finite("mass_per_length", m)
        for i in np.flatnonzero(m < 0)[:1]:
            raise ValueError(f"mass_per_length, row {i + 1}: received {m[i]:g}; must be at least 0")
        return self

    def distribution(self, burn_fraction: Any = 0.0) -> MassDistribution:
        """Return the mass along the axis, at one burn fraction or at those of many cases."""
        m = self.mass_per_length
        if self.burns:
            m = (1 - np.asarray(burn_fraction))[..., None] * m
        return MassDistribution.of_rows(self.x, m, self.interpolation)


def check_on_body(masses: tuple[MassTable, ...], start: float, end: float, how: str) -> None:
    """Raise ValueError unless every part lies on the body and can be added to its table."""
    for part in masses:
        slack = ROUNDING * max(abs(start), abs(end))
        if part.x[0] < start - slack or part.x[-1] > end + slack:
            raise ValueError(
                f"the part '{part.name}' runs from {part.x[0]:g} to {part.x[-1]:g} m, but the body "
                f"from {start:g} to {end:g} m: correct its x"
            )
        if how == "log":
            raise ValueError("parts cannot be added to a table with interpolation = 'log'")
