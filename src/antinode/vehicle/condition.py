"""The operating condition and the water, and the cavitation number that follows from them.

Equation 1: ``sigma = (p_atm + rho g depth - p_c) / (rho V^2 / 2)``, where p_c is the vapour
pressure unless a cavity (ventilation) pressure is given. Sigma alone says nothing about depth.

Source: "Analysis of the Natural Vibration Characteristics of a Supercavitating Underwater Vehicle
Considering Hydrodynamic Conditions", eq. 1.
"""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple, Self

from pydantic import Field, model_validator

from antinode.errors import InputError
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


_AGREEMENT = 1e-3  # of sigma q, within which sigma, depth and cavity pressure may disagree


class Cavitation(NamedTuple):
    """The state of cavitation: sigma, and what it implies where enough is known.

    Attributes
    ----------
    sigma : float
        Cavitation number [-].
    cavity_pressure : float or None
        Pressure in the cavity [Pa]; None where sigma alone is given.
    depth : float or None
        Depth [m]; None where it neither is given nor follows.
    """

    sigma: float
    cavity_pressure: float | None
    depth: float | None


def cavitation_number(
    static_pressure: float, cavity_pressure: float, density: float, speed: float
) -> float:
    """Cavitation number by eq. 1.

    Parameters
    ----------
    static_pressure : float
        Pressure at the vehicle's depth [Pa].
    cavity_pressure : float
        Pressure in the cavity [Pa].
    density : float
        Density of the water [kg/m^3].
    speed : float
        Speed of the vehicle [m/s].

    Returns
    -------
    float
        sigma [-].
    """
    return (static_pressure - cavity_pressure) / (density * speed**2 / 2)


def resolve_cavitation(condition: OperatingCondition, water: Water) -> Cavitation:
    """Work out sigma, cavity pressure and depth from those that are given.

    Parameters
    ----------
    condition : OperatingCondition
        Gives sigma or depth, and perhaps the cavity pressure.
    water : Water
        Gives the pressures and the density.

    Returns
    -------
    Cavitation
        Given and implied values.

    Raises
    ------
    InputError
        If the given values contradict each other, or cannot be.
    """
    if condition.cavitation_number is None:
        return _from_depth(condition, water)
    if condition.depth is not None:
        return _from_sigma_and_depth(condition, condition.cavitation_number, condition.depth, water)
    if condition.cavity_pressure is not None:
        return _from_pressure(
            condition.cavitation_number, condition.cavity_pressure, condition, water
        )
    return Cavitation(condition.cavitation_number, None, None)


def _static_pressure(depth: float, water: Water) -> float:
    return water.atmospheric_pressure + water.density * water.gravity * depth


def _from_depth(condition: OperatingCondition, water: Water) -> Cavitation:
    depth, p_c = condition.depth or 0.0, condition.cavity_pressure
    p_c = water.vapour_pressure if p_c is None else p_c
    p = _static_pressure(depth, water)
    sigma = cavitation_number(p, p_c, water.density, condition.speed)
    if not 0 < sigma < 1:
        made = (
            f"condition.depth = {depth:g} m, {condition.speed:g} m/s and {p_c:g} Pa in the cavity"
        )
        say = "must lie between 0 and 1: change speed, depth or cavity_pressure"
        raise InputError(f"{made} make the cavitation number {sigma:.4g}; it {say}")
    return Cavitation(sigma, p_c, depth)


def _from_sigma_and_depth(
    condition: OperatingCondition, sigma: float, depth: float, water: Water
) -> Cavitation:
    """Imply a cavity pressure, which must not be negative, nor disagree with a given one."""
    q = water.density * condition.speed**2 / 2
    p_c = _static_pressure(depth, water) - sigma * q
    given = condition.cavity_pressure
    both = (
        f"condition.cavitation_number = {sigma:g} and depth = {depth:g} m imply a cavity pressure"
    )
    if p_c < 0:
        raise InputError(f"{both} of {p_c:.6g} Pa, which must be at least 0: leave out the depth")
    allowed = _AGREEMENT * sigma * q
    if given is not None and abs(given - p_c) > allowed:
        say = f"they may differ by {allowed:.3g} Pa (0.1 % of sigma q): leave out one of the three"
        raise InputError(f"{both} of {p_c:.6g} Pa, but cavity_pressure = {given:.6g} Pa; {say}")
    return Cavitation(sigma, p_c, depth)


def _from_pressure(
    sigma: float, p_c: float, condition: OperatingCondition, water: Water
) -> Cavitation:
    """Imply a static pressure, hence a depth, by sigma and the cavity pressure."""
    p = p_c + sigma * water.density * condition.speed**2 / 2
    p_atm = water.atmospheric_pressure
    if p < p_atm * (1 - 1e-9):
        both = f"condition.cavitation_number = {sigma:g} and cavity_pressure = {p_c:g} Pa"
        say = f"below the atmosphere's {p_atm:g} Pa: leave out one of them"
        raise InputError(f"{both} imply a static pressure of {p:.6g} Pa, {say}")
    weight = water.density * water.gravity
    return Cavitation(sigma, p_c, max(0.0, p - p_atm) / weight if weight > 0 else None)
