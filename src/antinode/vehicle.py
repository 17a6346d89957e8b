"""The vehicle: stations along the axis, a disk cavitator, sets of fins.

One axis: x [m] runs aft from the nose, where the cavitator sits at x = 0. Between the rows of the
table the columns hold ("step": row k from x_k to x_k+1, the last row closes the table), or are
interpolated ("linear", "log"; the radius is linear in both).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Any, Literal, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import (
    Field,
    GetCoreSchemaHandler,
    GetJsonSchemaHandler,
    ValidatorFunctionWrapHandler,
    WrapValidator,
    model_validator,
)
from pydantic_core import core_schema

from antinode.text import counted
from antinode.units import Angle, Frozen, Length, Number, to_si

Array = NDArray[np.float64]
Interpolation = Literal["step", "linear", "log"]


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


@dataclass(frozen=True)
class Column:
    """Marks an array of a pydantic model as a column of numbers in an SI unit."""

    unit: str

    def read(self, value: object) -> Array:
        """Return a read-only float array [unit] from an array or a list (strings with units too).

        Raises
        ------
        ValueError
            If the value is no list, or a row is no number with a unit of the right dimension.
        """
        if not isinstance(value, np.ndarray | list | tuple):
            raise ValueError("needs a list of numbers, one for each station")
        column = np.array([self._row(i, item) for i, item in enumerate(value, 1)], dtype=float)
        column.setflags(write=False)
        return column

    def _row(self, row: int, item: Any) -> float:
        try:
            return to_si(item.item() if isinstance(item, np.generic) else item, self.unit)
        except ValueError as error:
            raise ValueError(f"row {row}: received {str(item)[:40]!r}; {error}") from error

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> core_schema.CoreSchema:
        return core_schema.no_info_plain_validator_function(
            self.read,
            serialization=core_schema.plain_serializer_function_ser_schema(np.ndarray.tolist),
        )

    def __get_pydantic_json_schema__(
        self, schema: core_schema.CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        items = {"type": ["number", "string"], "description": f"SI number [{self.unit}], or a text"}
        return {"type": "array", "minItems": 2, "items": items, "unit": self.unit}


def _increasing(x: Array) -> None:
    if len(x) < 2:
        raise ValueError(
            f"x: received {counted(len(x), 'row')}; a table of stations needs at least two"
        )
    _finite("x", x)
    for i in np.flatnonzero(np.diff(x) <= 0)[:1]:
        rows = f"x: rows {i + 1} and {i + 2}: received {x[i]:.10g}, then {x[i + 1]:.10g} m"
        if x[i] == x[i + 1]:
            raise ValueError(f"{rows}; x must increase: remove one of the duplicate rows")
        raise ValueError(f"{rows}; x must increase from the nose aft: sort the rows by x")


def _finite(name: str, column: Array) -> None:
    for i in np.flatnonzero(~np.isfinite(column))[:1]:
        raise ValueError(f"{name}, row {i + 1}: received {column[i]}; fill in a finite number")


def _positive(name: str, column: Array, unit: str) -> None:
    for i in np.flatnonzero(~(column > 0))[:1]:
        wrong = f"{name}, row {i + 1}: received {column[i]:.10g}"
        raise ValueError(f"{wrong}; must be greater than 0 {unit}: correct this row")


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
        _increasing(self.x)
        for name, column, unit in self.columns():
            if len(column) != len(self.x):
                rows = f"{name}: received {counted(len(column), 'row')}, but x has {len(self.x)}"
                raise ValueError(f"{rows}: give one value for each station")
            _finite(name, column)
            if name == "radius" and column[0] == 0:
                _positive(name, np.concatenate([[1.0], column[1:]]), unit)
            else:
                _positive(name, column, unit)
        return self

    def columns(self) -> Iterator[tuple[str, Array, str]]:
        """Yield name, values and unit of every column but x."""
        for i, (state, column) in enumerate(self.mass_per_length.items()):
            yield (f"{_MASS}:{state}" if i or state != "initial" else _MASS), column, "kg/m"
        yield "bending_stiffness", self.bending_stiffness, "N m^2"
        yield "axial_stiffness", self.axial_stiffness, "N"
        yield "radius", self.radius, "m"
        if self.radius_of_gyration is not None:
            yield "radius_of_gyration", self.radius_of_gyration, "m"
        if self.wall is not None:
            yield "wall", self.wall, "m"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Stations) or not np.array_equal(self.x, other.x):
            return False
        mine, theirs = list(self.columns()), list(other.columns())
        return [c[0] for c in mine] == [c[0] for c in theirs] and all(
            np.array_equal(a[1], b[1]) for a, b in zip(mine, theirs, strict=True)
        )

    __hash__ = None  # type: ignore[assignment]  # arrays have no hash


_MASS = "mass_per_length"
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)
_NODES, _WEIGHTS = (_NODES + 1) / 2, _WEIGHTS / 2


@dataclass(frozen=True, eq=False)
class MassDistribution:
    """Mass per length along the axis, with exact integrals.

    Parameters
    ----------
    x : ndarray (n+1,)
        Bounds of the intervals [m].
    ends : ndarray (n, 2)
        Mass per length at both ends of each interval [kg/m].
    interpolation : {"step", "linear", "log"}
        How it runs between the ends.
    """

    x: Array
    ends: Array
    interpolation: Interpolation

    def __add__(self, other: MassDistribution) -> MassDistribution:
        """Return the sum of two distributions, each zero outside its own range.

        Raises
        ------
        ValueError
            If one is logarithmic: the sum would not be.
        """
        kinds = {self.interpolation, other.interpolation}
        if "log" in kinds:
            raise ValueError("masses interpolated by 'log' cannot be added: use step or linear")
        x = np.union1d(self.x, other.x)
        how: Interpolation = "step" if kinds == {"step"} else "linear"
        return MassDistribution(x, self.between(x) + other.between(x), how)

    def between(self, x: Array) -> Array:
        """Return the mass per length at both ends of the intervals between `x`, (n, 2) [kg/m]."""
        middle = (x[:-1] + x[1:]) / 2
        k = np.clip(np.searchsorted(self.x, middle) - 1, 0, len(self.ends) - 1)
        size = self.x[k + 1] - self.x[k]
        a, b = self.ends[k].T
        sides = []
        for points in (x[:-1], x[1:]):
            t = (points - self.x[k]) / size
            sides.append(a * (b / a) ** t if self.interpolation == "log" else a + (b - a) * t)
        inside = (middle > self.x[0]) & (middle < self.x[-1])
        return np.where(inside[:, None], np.stack(sides, axis=1), 0.0)

    def at(self, x: Array) -> Array:
        """Return the mass per length at `x` [kg/m]; aft of the step where it jumps."""
        k = np.clip(np.searchsorted(self.x, x, side="right") - 1, 0, len(self.ends) - 1)
        a, b = self.ends[k].T
        t = (x - self.x[k]) / (self.x[k + 1] - self.x[k])
        return np.asarray(a * (b / a) ** t if self.interpolation == "log" else a + (b - a) * t)

    def moments(self, x: ArrayLike) -> Array:
        """Return the integrals of m, m x and m x^2 from the nose to `x`.

        Parameters
        ----------
        x : array_like
            Where the integrals end [m].

        Returns
        -------
        ndarray (3, ...)
            Mass [kg], first moment [kg m] and second moment [kg m^2] about the nose.
        """
        x = np.asarray(x, dtype=float)
        k = np.clip(np.searchsorted(self.x, x, side="right") - 1, 0, len(self.ends) - 1)
        return self._table[:, k] + self._partial(k, x - self.x[k])

    @cached_property
    def _table(self) -> Array:
        """Moments at the bounds of the intervals, (3, n+1)."""
        each = self._partial(np.arange(len(self.ends)), np.diff(self.x))
        return np.concatenate([np.zeros((3, 1)), np.cumsum(each, axis=1)], axis=1)

    def _partial(self, k: NDArray[np.intp], s: Array) -> Array:
        """Moments about the nose of the first `s` metres of the intervals `k`."""
        J0, J1, J2 = self._log(k, s) if self.interpolation == "log" else self._polynomial(k, s)
        x = self.x[k]
        return np.stack([J0, x * J0 + J1, x * x * J0 + 2 * x * J1 + J2])

    def _polynomial(self, k: NDArray[np.intp], s: Array) -> list[Array]:
        a = self.ends[k, 0]
        b = (self.ends[k, 1] - a) / (self.x[k + 1] - self.x[k])
        return [a * s ** (p + 1) / (p + 1) + b * s ** (p + 2) / (p + 2) for p in range(3)]

    def _log(self, k: NDArray[np.intp], s: Array) -> list[Array]:
        a, ratio = self.ends[k, 0], self.ends[k, 1] / self.ends[k, 0]
        t = s[..., None] * _NODES
        m = a[..., None] * ratio[..., None] ** (t / (self.x[k + 1] - self.x[k])[..., None])
        return [s * np.sum(_WEIGHTS * m * t**p, axis=-1) for p in range(3)]


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
        _increasing(self.x)
        m = self.mass_per_length
        if len(m) != len(self.x):
            raise ValueError(f"mass_per_length has {len(m)} rows, but x has {len(self.x)}")
        _finite("mass_per_length", m)
        for i in np.flatnonzero(m < 0)[:1]:
            raise ValueError(f"mass_per_length, row {i + 1}: received {m[i]:g}; must be at least 0")
        return self

    def distribution(self, burn_fraction: float = 0.0) -> MassDistribution:
        """Return the mass along the axis."""
        m = self.mass_per_length * ((1 - burn_fraction) if self.burns else 1.0)
        after = m[:-1] if self.interpolation == "step" else m[1:]
        return MassDistribution(self.x, np.stack([m[:-1], after], axis=1), self.interpolation)


def check_on_body(masses: tuple[MassTable, ...], start: float, end: float, how: str) -> None:
    """Raise ValueError unless every part lies on the body and can be added to its table."""
    for part in masses:
        if part.x[0] < start or part.x[-1] > end:
            raise ValueError(
                f"the part '{part.name}' runs from {part.x[0]:g} to {part.x[-1]:g} m, but the body "
                f"from {start:g} to {end:g} m: correct its x"
            )
        if how == "log":
            raise ValueError("parts cannot be added to a table with interpolation = 'log'")


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


def with_closed_stations(table: Any) -> Any:
    """Return a table whose stepped columns may have one value for each interval, with the last row.

    The last row of a stepped table is not used: where every column but x is one shorter than x, its
    last value is repeated.
    """
    stations = table.get("stations") if isinstance(table, dict) else None
    if not isinstance(stations, dict) or table.get("interpolation", "step") != "step":
        return table
    if not all(isinstance(column, list) for column in stations.values()) or "x" not in stations:
        return table
    intervals = len(stations["x"]) - 1
    if intervals < 1 or {len(c) for key, c in stations.items() if key != "x"} != {intervals}:
        return table
    closed = {key: c if key == "x" else [*c, c[-1]] for key, c in stations.items()}
    return {**table, "stations": closed}


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

    def radius_at(self, x: ArrayLike) -> Array:
        """Return the radius of the body at `x` [m]; aft of the step where it jumps."""
        x = np.asarray(x, dtype=float)
        table = self.stations
        if self.interpolation == "step":
            k = np.searchsorted(table.x, x, side="right") - 1
            return table.radius[np.clip(k, 0, len(table.x) - 2)]
        return np.asarray(np.interp(x, table.x, table.radius))

    def mass_per_length(self, burn_fraction: float = 0.0) -> Array:
        """Return the column of mass per length at a burn fraction [kg/m].

        Parameters
        ----------
        burn_fraction : float
            0 the first mass state, 1 the last [-]; linear between neighbouring states.
        """
        states = list(self.stations.mass_per_length.values())
        place = burn_fraction * (len(states) - 1)
        k = min(int(place), max(len(states) - 2, 0))
        following = states[min(k + 1, len(states) - 1)]
        return states[k] + (place - k) * (following - states[k])

    def mass_distribution(self, burn_fraction: float = 0.0) -> MassDistribution:
        """Return the mass along the axis at a burn fraction, all parts added up."""
        x = self.stations.x
        ends = self._ends(self.mass_per_length(burn_fraction), x, self.interpolation)
        total = MassDistribution(x, ends, self.interpolation)
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
        points, table, how = np.asarray(breakpoints, dtype=float), self.stations, self.interpolation

        def ends(column: Array, how: Interpolation = how) -> Array:
            return self._ends(column, points, how)

        radial: Interpolation = "step" if how == "step" else "linear"
        gyration, wall = table.radius_of_gyration, table.wall
        return Section(
            x=points,
            mass_per_length=self.mass_distribution(burn_fraction).between(points),
            bending_stiffness=ends(table.bending_stiffness),
            axial_stiffness=ends(table.axial_stiffness),
            radius=ends(table.radius, radial),
            radius_of_gyration=None if gyration is None else ends(gyration, radial),
            wall=None if wall is None else ends(wall, radial),
        )

    def _ends(self, column: Array, points: Array, how: Interpolation) -> Array:
        """Values of a column at both ends of the intervals between `points`, (n, 2)."""
        value = _INTERPOLATE[how]
        if how == "step":
            middle = value((points[:-1] + points[1:]) / 2, self.stations.x, column)
            return np.stack([middle, middle], axis=1)
        at = value(points, self.stations.x, column)
        return np.stack([at[:-1], at[1:]], axis=1)


def _step(x: Array, xs: Array, column: Array) -> Array:
    return column[np.searchsorted(xs, x, side="right") - 1]


def _linear(x: Array, xs: Array, column: Array) -> Array:
    return np.asarray(np.interp(x, xs, column))


def _log(x: Array, xs: Array, column: Array) -> Array:
    return np.exp(np.interp(x, xs, np.log(column)))


_INTERPOLATE: dict[str, Callable[[Array, Array, Array], Array]] = {
    "step": _step,
    "linear": _linear,
    "log": _log,
}
