"""Residuals of an identification and their derivatives, row by row.

A residual is (f - f_observed) / standard deviation. Its derivatives follow from those of omega^2
(`derivatives.py`): by columns directly, by every other number through forces, their places, thrust
and mass. How these four change with a number is a central difference of the load model alone.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from antinode.case import Case
from antinode.errors import AntinodeError
from antinode.loads import PointForce, point_forces
from antinode.riccati.chain import Family

from .columns import column_values
from .derivatives import ForceChange, MassChange, Sensitivity, force_changes
from .observations import Pairing, RowData, pair
from .paths import Place, replaced, value_at
from .response import Response, hertz, hertz_slope, respond
from .unknowns import Scalar, Unknowns

Array = npt.NDArray[np.float64]
_STEP = 2e-6
_STATIONS = ("vehicle", "stations")
_MASSES = ("vehicle", "masses")
_MASS = "mass_per_length"
_BURN = ("condition", "burn_fraction")
_THRUST = ("condition", "thrust")
_BESIDE_THE_HULL = (
    ("vehicle", "fins"),
    ("condition", "fin_position"),
    ("condition", "extra_drag"),
    ("condition", "extra_drag_position"),
)
"""Where numbers stand that neither cavity nor planing depend on."""


@dataclass(frozen=True)
class Evaluation:
    """The model at one vector.

    Attributes
    ----------
    vector : array
    responses : tuple of Response
        By row.
    pairings : tuple of dict
        By row and family.
    """

    vector: Array
    responses: tuple[Response, ...]
    pairings: tuple[Mapping[Family, Pairing], ...]

    def fitted_hz(self, row: int, family: Family) -> Array:
        """Return the frequencies that stand against the observed ones [Hz]."""
        omega2 = self.responses[row].modes[family].omega2
        return hertz(omega2[self.pairings[row][family].index])


@dataclass(frozen=True)
class Misfit:
    """Residuals of the data as a function of the vector.

    Attributes
    ----------
    unknowns : Unknowns
    rows : tuple of RowData
    refinement : int
        Of the chains.
    """

    unknowns: Unknowns
    rows: tuple[RowData, ...]
    refinement: int

    @cached_property
    def number(self) -> int:
        """How many frequencies were observed."""
        return sum(len(data.hz) for row in self.rows for data in row.families.values())

    def cases(self, vector: Array) -> list[Case]:
        """Return the case of every row."""
        shared = self.unknowns.apply(self.unknowns.case, vector)
        return [
            self.unknowns.apply_row(row.condition(shared), vector, k)
            for k, row in enumerate(self.rows)
        ]

    def evaluate(self, vector: Array) -> Evaluation:
        """Compute all rows.

        Raises
        ------
        AntinodeError
            If a row cannot be computed.
        """
        wanted = [row.wanted for row in self.rows]
        responses = respond(self.cases(vector), wanted, self.refinement)
        pairings = tuple(
            {family: pair(data, response.modes[family]) for family, data in row.families.items()}
            for row, response in zip(self.rows, responses, strict=True)
        )
        return Evaluation(vector, responses, pairings)

    def residuals(self, at: Evaluation) -> Array:
        """Return the residuals of the data."""
        return np.concatenate(
            [
                (at.fitted_hz(k, family) - data.hz) / data.sd
                for k, row in enumerate(self.rows)
                for family, data in row.families.items()
            ]
        )

    def jacobian(self, at: Evaluation) -> Array:
        """Return the derivatives of the residuals by the vector."""
        slopes = self.unknowns.slopes(at.vector)
        logarithms = self.unknowns.logarithms(at.vector)
        blocks = []
        for k, row in enumerate(self.rows):
            derivative = RowDerivative(self.unknowns, k, at.responses[k], slopes, logarithms)
            for family, data in row.families.items():
                index = at.pairings[k][family].index
                omega2 = at.responses[k].modes[family].omega2[index]
                block = derivative.by_vector(family)[index]
                blocks.append(block * (hertz_slope(omega2) / data.sd)[:, None])
        return np.concatenate(blocks)


@dataclass(frozen=True)
class RowDerivative:
    """Derivatives of omega^2 of one row by the vector."""

    unknowns: Unknowns
    row: int
    response: Response
    slopes: Array
    logarithms: Mapping[str, Array]

    @property
    def case(self) -> Case:
        """The case of the row."""
        return self.response.case

    def by_vector(self, family: Family) -> Array:
        """Return the derivatives of omega^2 1 ... n of a family, shape (n, entries)."""
        sensitivity = self.response.sensitivity(family)
        total = np.zeros((len(self.response.modes[family].omega2), len(self.unknowns.items)))
        by_column = self._by_logarithms(sensitivity)
        for item in self.unknowns.columns:
            sizes = np.array([u.size for u in self.unknowns.items[item.entries]])
            if item.column.key in by_column:
                total[:, item.entries] = by_column[item.column.key].T @ item.column.weights * sizes
        for effect in self._effects:
            by_force = sum(
                (sensitivity.by_force(change) for change in effect.forces),
                np.zeros(len(sensitivity.modes.omega2)),
            )
            if effect.mass:
                by_force = by_force + sensitivity.by_mass(effect.mass)
            total[:, effect.entry] += by_force
        for scalar in self.unknowns.scalars:
            k = scalar.entry(self.row)
            if scalar.place.keys == _THRUST and family == "bending":
                total[:, k] += sensitivity.by_thrust * self.slopes[k]
            elif scalar.place.keys[:2] == _STATIONS and scalar.place.keys[2] != "radius":
                *keys, row = scalar.place.keys[2:]
                by_row = self._by_rows(sensitivity, ":".join(map(str, keys)))[int(row)]
                total[:, k] += by_row * self.slopes[k]
        return total

    def _by_logarithms(self, sensitivity: Sensitivity) -> dict[str, Array]:
        """Return derivatives by the logarithms of columns, those relative to them included."""
        found: dict[str, Array] = {}
        for item in reversed(self.unknowns.columns):
            key = item.column.key
            if key == "radius":
                continue
            own = self._by_rows(sensitivity, key) * np.exp(self.logarithms[key])[:, None]
            found[key] = found.get(key, 0.0) + own
            if item.column.parent is not None:
                found[item.column.parent] = found.get(item.column.parent, 0.0) + found[key]
        return found

    def _by_rows(self, sensitivity: Sensitivity, key: str) -> Array:
        """Return derivatives by the rows of a column, shape (stations, k)."""
        vehicle = self.case.vehicle
        stations, how = vehicle.stations, vehicle.interpolation
        name, _, state = key.partition(":")
        nothing = np.zeros((len(stations.x), len(sensitivity.modes.omega2)))
        if name == _MASS:
            share = _share(state, list(stations.mass_per_length), self.case.condition.burn_fraction)
            if share == 0:
                return nothing
            column = vehicle.mass_per_length(self.case.condition.burn_fraction)
            return share * sensitivity.by_mass_rows(stations.x, column, how)
        stiffness = "bending" if name == "bending_stiffness" else "longitudinal"
        if sensitivity.modes.family != stiffness or name not in _STIFFNESS:
            return nothing
        return sensitivity.by_stiffness_rows(stations.x, column_values(stations, (name,)), how)

    @cached_property
    def _effects(self) -> list[Effect]:
        """What the entries change that act through the load model."""
        found = []
        for scalar in self.unknowns.scalars:
            keys = scalar.place.keys
            if keys == _THRUST or (keys[:2] == _STATIONS and keys[2] != "radius"):
                continue
            found.append(self._effect_of_number(scalar))
        for item in self.unknowns.columns:
            if item.column.key == "radius":
                found += [
                    self._effect_of_radius(k, item.column.weights[:, i])
                    for i, k in enumerate(range(item.entries.start, item.entries.stop))
                ]
        return found

    def _effect_of_number(self, scalar: Scalar) -> Effect:
        place, k = scalar.place, scalar.entry(self.row)
        value = value_at(self.case, place.keys)
        assert value is not None
        low, high = _around(value, self.unknowns.items[k].size, place)
        base = _without_planing(self.case) if place.keys[:2] in _BESIDE_THE_HULL else self.case
        cases = [replaced(base, place.keys, v) for v in (low, high)]
        step = (high - low) / float(self.slopes[k])
        mass = _mass_change(cases, step) if _moves_mass(place) else None
        low_forces, high_forces = map(_forces, cases)
        return Effect(k, force_changes(low_forces, high_forces, step), mass)

    def _effect_of_radius(self, entry: int, weights: Array) -> Effect:
        radius = self.case.vehicle.stations.radius
        size = self.unknowns.items[entry].size
        keys = (*_STATIONS, "radius")
        cases = [
            replaced(self.case, keys, radius * np.exp(sign * _STEP * weights)) for sign in (-1, 1)
        ]
        return Effect(
            entry, force_changes(_forces(cases[0]), _forces(cases[1]), 2 * _STEP / size), None
        )


@dataclass(frozen=True)
class Effect:
    """What one entry of the vector changes through the load model, for each unit of it."""

    entry: int
    forces: tuple[ForceChange, ...]
    mass: MassChange | None


_STIFFNESS = ("bending_stiffness", "axial_stiffness")


def _share(state: str, states: Sequence[str], burn_fraction: float) -> float:
    """Return the share of a mass state at a burn fraction."""
    place = burn_fraction * (len(states) - 1)
    return max(0.0, 1.0 - abs(place - states.index(state)))


def _without_planing(case: Case) -> Case:
    """Return the case without the planing forces, the dearest part of the loads."""
    return replaced(case, ("model", "planing"), "none")


def _forces(case: Case) -> tuple[PointForce, ...]:
    return point_forces(case.vehicle, case.condition, case.water, case.model)


def _around(value: float, size: float, place: Place) -> tuple[float, float]:
    """Return a small step around a value, on one side where the other is not allowed."""
    step = _STEP * (abs(value) or size)
    low, high = value - step, value + step
    if low < place.low or (place.strict and low <= place.low):
        low = value
    if high > place.high:
        high = value
    return low, high


def _moves_mass(place: Place) -> bool:
    return place.keys == _BURN or place.keys[:2] == _MASSES


def _mass_change(cases: Sequence[Case], step: float) -> MassChange:
    low, high = (c.vehicle.mass_distribution(c.condition.burn_fraction) for c in cases)

    def difference(function: Callable[[int, Array], Array]) -> Callable[[Array], Array]:
        return lambda x: np.asarray((function(1, x) - function(0, x)) / step)

    both = (low, high)
    return MassChange(
        difference(lambda i, x: both[i].at(x)), difference(lambda i, x: both[i].moments(x)[0])
    )


def try_evaluate(misfit: Misfit, vector: Array) -> Evaluation | None:
    """Return the model at a vector, or None where it cannot be computed."""
    try:
        return misfit.evaluate(vector)
    except (AntinodeError, ArithmeticError):
        return None
