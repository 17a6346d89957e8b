"""The operating condition and the water."""

from __future__ import annotations

import math
from typing import Annotated, Self

from pydantic import Field, model_validator

from antinode.inputs.units import (
    Acceleration,
    Angle,
    Density,
    Force,
    Frozen,
    Length,
    Number,
    Pressure,
    Speed,
    Viscosity,
)

from .vehicle import angle_within


class Water(Frozen):
    """The water and the surroundings; by default fresh water at 20 C and standard gravity."""

    density: Annotated[Density, Field(gt=0)] = Field(
        default=998.2, description="rho [kg/m^3]; 998.2 at 20 C (IAPWS-95)"
    )
    dynamic_viscosity: Annotated[Viscosity, Field(gt=0)] = Field(
        default=1.002e-3, description="mu [Pa s]; 1.002 mPa s at 20 C (IAPWS 2008)"
    )
    vapour_pressure: Annotated[Pressure, Field(ge=0)] = Field(
        default=2339.0, description="saturation pressure p_v [Pa]; 2339 at 20 C (IAPWS-95)"
    )
    atmospheric_pressure: Annotated[Pressure, Field(ge=0)] = Field(
        default=101325.0, description="pressure on the water's surface [Pa]; standard atmosphere"
    )
    gravity: Annotated[Acceleration, Field(ge=0)] = Field(
        default=9.80665, description="g [m/s^2]; standard gravity (CGPM 1901)"
    )


class OperatingCondition(Frozen):
    """How the vehicle moves; the names are sweep axes and table columns too."""

    speed: Annotated[Speed, Field(gt=0, description="V [m/s]")]
    cavitation_number: Annotated[Number, Field(gt=0, lt=1)] | None = Field(
        default=None, description="sigma, between 0 and 1; give it or the depth"
    )
    depth: Annotated[Length, Field(ge=0)] | None = Field(
        default=None, description="depth below the surface [m]"
    )
    cavity_pressure: Annotated[Pressure, Field(ge=0)] | None = Field(
        default=None, description="pressure in the cavity [Pa]; by default the vapour pressure"
    )
    cavitator_angle: Annotated[Angle, angle_within(math.radians(60))] = Field(
        default=0.0, description="delta_n, cavitator against the body [rad], positive lifts"
    )
    body_angle: Annotated[Angle, angle_within(math.radians(30))] = Field(
        default=0.0, description="theta, body against the flow [rad], nose-up positive"
    )
    fin_position: Annotated[Length, Field(ge=0)] | None = Field(
        default=None, description="x of every fin set that has no position of its own [m]"
    )
    thrust: Annotated[Force, Field(ge=0)] = Field(
        default=0.0, description="thrust T at the tail, forward positive [N]"
    )
    burn_fraction: Annotated[Number, Field(ge=0, le=1)] = Field(
        default=0.0, description="0 first mass state, 1 last [-]"
    )
    extra_drag: Force | None = Field(
        default=None, description="drag that no formula gives, such as a measured one, aft [N]"
    )
    extra_drag_position: Annotated[Length, Field(ge=0)] | None = Field(
        default=None, description="x where it acts [m]; by default fin_position, or the tail"
    )

    @model_validator(mode="after")
    def _check_cavitation(self) -> Self:
        if self.cavitation_number is None and self.depth is None:
            raise ValueError("cavitation_number or depth is missing: give at least one of them")
        return self
