"""The vehicle: stations along the axis, a disk cavitator, sets of fins.

One axis: x [m] runs aft from the nose, where the cavitator sits at x = 0. Between the rows of the
table the columns hold ("step": row k from x_k to x_k+1, the last row closes the table), or are
interpolated ("linear", "log"; the radius is linear in both).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Any, Self

import numpy as np
from numpy.typing import ArrayLike
from pydantic import (
    Field,
    ValidatorFunctionWrapHandler,
    WrapValidator,
    model_validator,
)

from antinode.arrays import Array, Interpolation
from antinode.beam.mass import MassDistribution, burnt
from antinode.beam.parts import MassTable, check_on_body
from antinode.beam.profile import Profile
from antinode.inputs.columns import (
    Column,
    both_or_neither,
    finite,
    increasing,
    positive,
    with_closed_stations,
)
from antinode.inputs.units import Angle, Frozen, Length, Number
from antinode.text import counted


def angle_within(limit: float) -> WrapValidator:
    """Return a validator for angles up to `limit` [rad] either way, which knows about degrees."""

    def check(value: object, convert: ValidatorFunctionWrapHandler) -> float:
        angle = float(convert(value))
        if abs(angle) <= limit * (1 + 1e-12):
            return angle
        allowed = f"must lie within -{limit:.4g} and {limit:.4g} rad ({math.degrees(limit):.4g} deg"
        hint = (
            ""
            if isinstance(value, str)
            else f"; a plain number is in radians: did you mean '{value} deg'?"
        )
        raise ValueError(f"received {value}; the angle {allowed} either way){hint}")

    return WrapValidator(check)


class Cavitator(Frozen):
    """The disk at the nose, normal to the axis when its angle is zero."""

    diameter: Annotated[Length, Field(gt=0, description="diameter D_n of the disk [m]")]


RollAngle = Annotated[Angle, angle_within(2 * math.pi)]


class FinSet(Frozen):
    """Equal fins at one station, each along the radius at its own roll angle.

    The roll angle is 0 up and 90 deg starboard. A positive deflection pushes each fin of the set
    up, whatever side it stands on.
    """

    roll_angles: tuple[RollAngle, ...] = Field(
        min_length=1, description="roll angle of each fin [rad], 0 up, 90 deg starboard"
    )
    tip_radius: Annotated[
        Length, Field(gt=0, description="distance of the fin's tip from the body axis [m]")
    ]
    thickness: Annotated[Length, Field(gt=0, description="thickness d_f of eq. 14 [m]")]
    lift_slope: Annotated[
        Number,
        Field(
            ge=0,
            description="lift per radian and wetted area; pi/2: thin plate with an open cavity",
        ),
    ] = math.pi / 2
    chord: Annotated[Length, Field(gt=0)] | None = Field(
        default=None, description="chord of the wetted area [m]; by default the fin's span"
    )
    position: Annotated[Length, Field(ge=0)] | None = Field(
        default=None, description="x of the set [m]; by default the condition's fin_position"
    )
    deflection: Annotated[Angle, angle_within(math.radians(45))] = Field(
        default=0.0, description="deflection of every fin of the set [rad], positive lifts"
    )


class Stations(Frozen):
    """The table along the axis, one row a station; rows count from 1 in messages."""

    x: Annotated[Array, Column("m")] = Field(description="distance aft from the nose [m]")
    mass_per_length: dict[str, Annotated[Array, Column("kg/m")]] = Field(
        min_length=1,
        description="mass per length [kg/m]; further columns mass_per_length:NAME are mass states",
    )
    bending_stiffness: Annotated[Array, Column("N m^2")] = Field(description="EI [N m^2]")
    axial_stiffness: Annotated[Array, Column("N")] = Field(description="EA [N]")
    radius: Annotated[Array, Column("m")] = Field(description="radius of the body [m]")
    radius_of_gyration: Annotated[Array, Column("m")] | None = Field(
        default=None, description="radius of gyration of the cross-section's mass [m]"
    )
    wall: Annotated[Array, Column("m")] | None = Field(
        default=None, description="wall thickness of the hull [m]"
    )
    torsional_stiffness: Annotated[Array, Column("N m^2")] | None = Field(
        default=None, description="GJ [N m^2]; without it there are no torsion modes"
    )
    polar_inertia_per_length: Annotated[Array, Column("kg m")] | None = Field(
        default=None,
        description="rho I_p about the axis [kg m], parts included; beside torsional_stiffness",
    )

    shear_stiffness: Annotated[Array, Column("N")] | None = Field(
        default=None, description="kGA [N], for [model] theory = timoshenko; by default EA/4.9"
    )
    rotary_inertia_per_length: Annotated[Array, Column("kg m")] | None = Field(
        default=None,
        description="rho I of the sections [kg m], for the same; by default m times the square of "
        "the radius of gyration",
    )

    @model_validator(mode="before")
    @classmethod
    def _gather_mass_states(cls, data: Any) -> Any:
        """Turn the columns mass_per_length and mass_per_length:NAME into one dictionary."""
        if not isinstance(data, dict) or isinstance(data.get(_MASS), dict):
            return data
        names = [key for key in data if str(key).partition(":")[0] == _MASS]
        states = {name.partition(":")[2] or "initial": data[name] for name in names}
        if len(states) < len(names):
            raise ValueError("mass_per_length: two columns name the same mass state: rename one")
        others = {key: value for key, value in data.items() if key not in names}
        return others | {_MASS: states} if states else others

    @model_validator(mode="after")
    def _check_table(self) -> Self:
        increasing(self.x)
        for name, column, unit in self.columns():
            if len(column) != len(self.x):
                rows = f"{name}: received {counted(len(column), 'row')}, but x has {len(self.x)}"
                raise ValueError(f"{rows}: give one value for each station")
            finite(name, column)
            if name == "radius" and column[0] == 0:
                positive(name, np.concatenate([[1.0], column[1:]]), unit)
            else:
                positive(name, column, unit)
        both_or_neither(self, "torsional_stiffness", "polar_inertia_per_length")
        return self

    def columns(self) -> Iterator[tuple[str, Array, str]]:
        """Yield name, values and unit of every column but x."""
        for i, (state, column) in enumerate(self.mass_per_length.items()):
            yield (f"{_MASS}:{state}" if i or state != "initial" else _MASS), column, "kg/m"
        yield "bending_stiffness", self.bending_stiffness, "N m^2"
        yield "axial_stiffness", self.axial_stiffness, "N"
        yield "radius", self.radius, "m"
        for name, unit in _OPTIONAL.items():
            column = getattr(self, name)
            if column is not None:
                yield name, column, unit

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Stations) or not np.array_equal(self.x, other.x):
            return False
        mine, theirs = list(self.columns()), list(other.columns())
        return [c[0] for c in mine] == [c[0] for c in theirs] and all(
            np.array_equal(a[1], b[1]) for a, b in zip(mine, theirs, strict=True)
        )

    __hash__ = None  # type: ignore[assignment]  # arrays have no hash


_MASS = "mass_per_length"
_OPTIONAL = {
    "radius_of_gyration": "m",
    "wall": "m",
    "torsional_stiffness": "N m^2",
    "polar_inertia_per_length": "kg m",
    "shear_stiffness": "N",
    "rotary_inertia_per_length": "kg m",
}
"""Columns that stations may leave out, with their units."""


@dataclass(frozen=True, eq=False)
class Section:
    """Properties at both ends of each interval between `x`, arrays (n, 2); equal for "step"."""

    x: Array
    mass_per_length: Array
    bending_stiffness: Array
    axial_stiffness: Array
    radius: Array
    radius_of_gyration: Array | None
    wall: Array | None
    torsional_stiffness: Array | None
    polar_inertia_per_length: Array | None
    shear_stiffness: Array | None
    rotary_inertia_per_length: Array | None


class Vehicle(Frozen):
    """Stations, cavitator and fins; everything that does not change with the condition."""

    name: str = Field(default="vehicle", description="shown in tables and figures")
    interpolation: Interpolation = Field(
        default="step", description="how the columns run between the stations"
    )
    stations: Stations
    cavitator: Cavitator
    fins: tuple[FinSet, ...] = Field(default=(), description="sets of fins")
    masses: tuple[MassTable, ...] = Field(
        default=(), description="parts whose mass adds to the stations' (tank, engine, payload)"
    )

    @model_validator(mode="before")
    @classmethod
    def _close_table(cls, data: Any) -> Any:
        return with_closed_stations(data)

    @model_validator(mode="after")
    def _check_nose(self) -> Self:
        x, radius = self.stations.x, self.stations.radius
        if x[0] != 0:
            raise ValueError(f"x, row 1: received {x[0]:.10g} m; the nose is at 0: shift the table")
        if radius[0] == 0 and self.interpolation == "step":
            wrong = "radius, row 1: received 0; must be greater than 0 m with 'step'"
            raise ValueError(f"{wrong}: correct it or use interpolation = 'linear'")
        check_on_body(self.masses, 0.0, self.length, self.interpolation)
        return self

    @property
    def length(self) -> float:
        """Length L of the body [m]."""
        return float(self.stations.x[-1])

    @cached_property
    def radius_profile(self) -> Profile:
        """Radius of the body [m] on the intervals of the stations."""
        return Profile.of_rows(self.stations.x, self.stations.radius, self._radial)

    def radius_at(self, x: ArrayLike) -> Array:
        """Return the radius of the body at `x` [m]; aft of the step where it jumps."""
        return self.radius_profile.at(x)

    def mass_per_length(self, burn_fraction: float = 0.0) -> Array:
        """Return the column of mass per length at a burn fraction [kg/m].

        Parameters
        ----------
        burn_fraction : float
            0 the first mass state, 1 the last [-]; linear between neighbouring states.
        """
        return burnt(list(self.stations.mass_per_length.values()), burn_fraction)

    def mass_distribution(
        self, burn_fraction: float | Array = 0.0, states: Sequence[Array] | None = None
    ) -> MassDistribution:
        """Return the mass along the axis at a burn fraction, all parts added up.

        Parameters
        ----------
        burn_fraction : float or array (cases,)
        states : sequence of array (rows,) or (cases, rows), optional
            Columns in place of the vehicle's own mass states [kg/m].
        """
        own = list(self.stations.mass_per_length.values()) if states is None else states
        column = burnt(own, burn_fraction)
        total = MassDistribution.of_rows(self.stations.x, column, self.interpolation)
        for part in self.masses:
            total = total + part.distribution(burn_fraction)
        return total

    def section(self, breakpoints: ArrayLike, burn_fraction: float = 0.0) -> Section:
        """Return the properties at both ends of the intervals between `breakpoints`.

        Parameters
        ----------
        breakpoints : array_like (n+1,)
            Increasing positions [m] that contain every station.
        burn_fraction : float
            0 the first mass state, 1 the last [-].

        Returns
        -------
        Section
            Mass per length [kg/m], EI [N m^2], EA [N], radii and wall [m], each (n, 2).
        """
        points, table = np.asarray(breakpoints, dtype=float), self.stations

        def ends(column: Array, how: Interpolation = self.interpolation) -> Array:
            return Profile.of_rows(table.x, column, how).between(points)

        def optional(column: Array | None, how: Interpolation) -> Array | None:
            return None if column is None else ends(column, how)

        return Section(
            x=points,
            mass_per_length=self.mass_distribution(burn_fraction).between(points),
            bending_stiffness=ends(table.bending_stiffness),
            axial_stiffness=ends(table.axial_stiffness),
            radius=self.radius_profile.between(points),
            radius_of_gyration=optional(table.radius_of_gyration, self._radial),
            wall=optional(table.wall, self._radial),
            torsional_stiffness=optional(table.torsional_stiffness, self.interpolation),
            polar_inertia_per_length=optional(table.polar_inertia_per_length, self._radial),
            shear_stiffness=optional(table.shear_stiffness, self.interpolation),
            rotary_inertia_per_length=optional(table.rotary_inertia_per_length, self._radial),
        )

    def radial(self, name: str) -> Profile | None:
        """Return a column of radii or walls, None where the stations leave it out."""
        column = getattr(self.stations, name)
        return None if column is None else Profile.of_rows(self.stations.x, column, self._radial)

    @property
    def _radial(self) -> Interpolation:
        """How radii and walls run: linear where the other columns are logarithmic."""
        return "step" if self.interpolation == "step" else "linear"
