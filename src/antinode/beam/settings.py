"""What a file of a beam or a vehicle asks of the solver."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from antinode.inputs.explain import validate
from antinode.inputs.units import Frozen, Number


class Solve(Frozen):
    """What to compute, and how well."""

    modes: int = Field(6, ge=1, le=500, strict=True, description="elastic modes of each family")
    tolerance: Annotated[Number, Field(ge=1e-12, le=0.1)] = Field(
        1e-6, description="largest relative error of a frequency by what varies inside segments"
    )

    def overridden(self, **given: float | None) -> Solve:
        """Return the settings with those of the command line that are given.

        Raises
        ------
        InputError
            If one of them is out of range.
        """
        told = {key: value for key, value in given.items() if value is not None}
        return validate(Solve, self.model_dump() | told, "command line")
