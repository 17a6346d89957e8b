"""What one number or column of a case does to its eigenvalues, to first order.

Columns of the stations and the thrust act directly (`derivatives.py`). Every other number acts
through forces, their places and the mass; how these change with it is a difference of the load
model alone, so that no eigenvalue is solved anew.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from antinode.arrays import Array, Interpolation
from antinode.beam.families import FAMILIES
from antinode.beam.profile import Profile
from antinode.inputs.places import Place

from .balance import mass_of
from .case import Case
from .columns import column_values
from .derivatives import (
    EigenvalueDerivatives,
    ForceChange,
    MassChange,
    ShearChange,
    WaterChange,
    force_changes,
)
from .forces import ForceOnBody, forces_of
from .hydrodynamics.added_mass import AddedMass
from .many_loads import loads_of_many
from .numbers import Keys, ManyCases, Numbers, is_vectorised, replaced, value_at
from .theory import Sheared, sheared


class Acting(NamedTuple):
    """What acts on a body: forces but the thrust, and water that moves with parts of it."""

    forces: tuple[ForceOnBody[float], ...]
    water: tuple[AddedMass[float], ...]


_STEP = 2e-6
_STATIONS = ("vehicle", "stations")
_MASSES = ("vehicle", "masses")
_MASS = "mass_per_length"
_OF_HULL = "radius", "radius_of_gyration", "wall"
_OF_SHEAR = (
    *(_MASS, "bending_stiffness", "axial_stiffness"),
    *("shear_stiffness", "rotary_inertia_per_length"),
)
"""Columns that kGA and rho I may follow from, besides those of the hull."""
_BURN = ("condition", "burn_fraction")
_THRUST = ("condition", "thrust")
_SHARES = ("model", "cavitator_follows"), ("model", "thrust_follows")


@dataclass(frozen=True)
class Effect:
    """What one number of a case changes, for each unit of it.

    Attributes
    ----------
    case : Case
    thrust : float
        [N].
    row : (str, int) or None
        A column of the stations and its row, which the number is.
    forces : tuple of ForceChange
    share : {0, 1} or None
        The share of the force at nose (0) or tail (1) that turns with it, which the number is.
    mass : MassChange or None
    shear : ShearChange or None
    water : tuple of WaterChange
    """

    case: Case
    thrust: float = 0.0
    row: tuple[str, int] | None = None
    forces: tuple[ForceChange, ...] = ()
    share: int | None = None
    mass: MassChange | None = None
    shear: ShearChange | None = None
    water: tuple[WaterChange, ...] = ()

    def slope(self, sensitivity: EigenvalueDerivatives) -> Array:
        """Return d(omega^2) of every mode for each unit of the number, shape (k,)."""
        total = self.thrust * sensitivity.by_thrust
        if self.row is not None:
            column, row = self.row
            total = total + by_rows(self.case, column, sensitivity)[row]
        for change in self.forces:
            total = total + sensitivity.by_force(change)
        if self.share is not None:
            total = total + sensitivity.by_share[self.share]
        if self.mass:
            total = total + sensitivity.by_mass(self.mass)
        if self.shear:
            total = total + sensitivity.by_shear(self.shear)
        for part in self.water:
            total = total + sensitivity.by_water(part)
        return np.asarray(total)


def effect_of_number(case: Case, place: Place, size: float | None = None) -> Effect:
    """Return what a number of a case changes, by a small step around its value.

    Parameters
    ----------
    case : Case
    place : Place
        Of a number that has a value.
    size : float, optional
        Natural step of a number that is zero; by default a quarter of what is allowed, or 1.
    """
    value = value_at(case, place.keys)
    assert value is not None
    size = _natural_size(place) if size is None else size
    (effect,) = effects_between(case, place, _around(value, size, place))
    return effect


def effects_between(case: Case, place: Place, values: Sequence[float]) -> list[Effect]:
    """Return what a number changes over each interval between increasing values of it."""
    keys = place.keys
    if keys == _THRUST:
        return [Effect(case, thrust=1.0)] * (len(values) - 1)
    if keys in _SHARES:
        return [Effect(case, share=_SHARES.index(keys))] * (len(values) - 1)
    if keys[:2] == _STATIONS and keys[2] not in _OF_HULL:
        row = _column(keys[2:-1]), int(keys[-1])
        return [Effect(case, row=row)] * (len(values) - 1)
    cases = [replaced(case, keys, value) for value in values]
    acting = _acting_at(case, keys, values) if is_vectorised(keys) else [_acting(c) for c in cases]
    steps = [high - low for low, high in pairwise(values)]
    masses: list[MassChange | None] = [None] * len(steps)
    shears: list[ShearChange | None] = [None] * len(steps)
    weighs = keys == _BURN or keys[:2] == _MASSES
    if weighs:
        masses = [
            _mass_change(*two, step) for two, step in zip(pairwise(cases), steps, strict=True)
        ]
    if weighs or keys[:2] == _STATIONS:
        shears = [
            _shear_change(*two, step) for two, step in zip(pairwise(cases), steps, strict=True)
        ]
    return [
        Effect(case, mass=mass, shear=shear, **_changes(*two, step))
        for two, step, mass, shear in zip(pairwise(acting), steps, masses, shears, strict=True)
    ]


def effect_of_radius(case: Case, weights: Array) -> Effect:
    """Return what a growth of the radius changes, given its logarithm's growth at every row."""
    radius = case.vehicle.stations.radius
    low, high = (
        replaced(case, (*_STATIONS, "radius"), radius * np.exp(sign * _STEP * weights))
        for sign in (-1, 1)
    )
    changes = _changes(_acting(low), _acting(high), 2 * _STEP)
    return Effect(case, shear=_shear_change(low, high, 2 * _STEP), **changes)


def effect_of_mass(case: Case) -> Effect:
    """Return what the mass of the whole body does, for a factor on all of it."""
    mass = case.loads.mass_distribution
    change = MassChange(mass.at, lambda x: mass.moments(x)[0])
    found, shear = _sheared(case.many({}, 1)), None
    if found is not None and case.vehicle.stations.rotary_inertia_per_length is None:
        shear = ShearChange(np.zeros_like, found.rotary.at)
    return Effect(case, mass=change, shear=shear)


def by_logarithm(case: Case, keys: Keys, sensitivity: EigenvalueDerivatives) -> Array:
    """Return derivatives by the logarithms of a column's rows, shape (stations, k).

    Parameters
    ----------
    case : Case
    keys : tuple
        From the stations to a column of mass or stiffness.
    sensitivity : EigenvalueDerivatives
    """
    column = column_values(case.vehicle.stations, keys)
    return by_rows(case, _column(keys), sensitivity) * column[:, None]


def by_rows(case: Case, key: str, sensitivity: EigenvalueDerivatives) -> Array:
    """Return derivatives by the rows of a column such as ``mass_per_length:burnt``."""
    own = _by_rows_of_law(case, key, sensitivity)
    bends = sensitivity.modes.chain.law.has_axial_force
    change = _shear_change_by_rows(case, key) if bends else None
    return own if change is None else own + sensitivity.by_shear(change)


def _by_rows_of_law(case: Case, key: str, sensitivity: EigenvalueDerivatives) -> Array:
    """Return the same through mass and stiffness of the family's law alone."""
    vehicle = case.vehicle
    stations, how = vehicle.stations, vehicle.interpolation
    name, _, state = key.partition(":")
    family = FAMILIES[sensitivity.modes.family]
    if name == _MASS == family.columns["mass"]:
        burnt = case.condition.burn_fraction
        share = _share(state, list(stations.mass_per_length), burnt)
        if share:
            column = vehicle.mass_per_length(burnt)
            return share * sensitivity.by_mass_rows(stations.x, column, how)
    elif name == family.columns["mass"]:
        straight: Interpolation = "step" if how == "step" else "linear"
        return sensitivity.by_mass_rows(stations.x, column_values(stations, (name,)), straight)
    elif name == family.stiffness:
        return sensitivity.by_stiffness_rows(stations.x, column_values(stations, (name,)), how)
    return np.zeros((len(stations.x), len(sensitivity.modes.omega2)))


def _column(keys: Keys) -> str:
    return ":".join(map(str, keys))


def _share(state: str, states: Sequence[str], burn_fraction: float) -> float:
    """Return the share of a mass state at a burn fraction."""
    place = burn_fraction * (len(states) - 1)
    return max(0.0, 1.0 - abs(place - states.index(state)))


def _acting(case: Case) -> Acting:
    """Return what acts on the body."""
    return _checked(case, {}, 1)[0]


def _acting_at(case: Case, keys: Keys, values: Sequence[float]) -> list[Acting]:
    """Return the same at several values of a number, all worked out at once."""
    return _checked(case, {keys: np.array(values)}, len(values))


def _checked(case: Case, numbers: Numbers, cases: int) -> list[Acting]:
    loads = loads_of_many(case.many(numbers, cases))
    for k in range(cases):
        loads.refusals.check(k)
    forces = loads.hydrodynamics.forces
    return [
        Acting(forces_of(forces, k), tuple(part.of(k) for part in loads.added_masses))
        for k in range(cases)
    ]


def _changes(low: Acting, high: Acting, step: float) -> dict[str, Any]:
    """Return how forces and water change, as fields of an `Effect`."""
    water = [_water_change(*two, step) for two in zip(low.water, high.water, strict=True)]
    return {"forces": force_changes(low.forces, high.forces, step), "water": tuple(water)}


def _water_change(low: AddedMass[float], high: AddedMass[float], step: float) -> WaterChange:
    """Return how a part changes; one that is not there on one side has the place of the other."""
    a, b = (low if low.mass else high), (high if high.mass else low)
    start, end = (a.start + b.start) / 2, (a.end + b.end) / 2
    growth = (b.start - a.start) / step, (b.end - a.end) / step
    mass, length = (high.mass - low.mass) / step, end - start
    density = (low.mass + high.mass) / 2 / length if length else 0.0
    if length:
        mass = (mass - density * (growth[1] - growth[0])) / length
    return WaterChange(start, end, density, (*growth, mass))


def _natural_size(place: Place) -> float:
    width = place.high - place.low
    return width / 4 if math.isfinite(width) else 1.0


def _around(value: float, size: float, place: Place) -> tuple[float, float]:
    """Return a small step around a value, on one side where the other is not allowed."""
    step = _STEP * (abs(value) or size)
    low, high = value - step, value + step
    if low < place.low or (place.strict and low <= place.low):
        low = value
    if high > place.high:
        high = value
    return low, high


def _shear_change(before: Case, after: Case, step: float) -> ShearChange | None:
    """Return how kGA and rho I change from one case to another, for each unit of a step."""
    low, high = _sheared(before.many({}, 1)), _sheared(after.many({}, 1))
    if low is None or high is None:
        return None
    return _change((low.stiffness, high.stiffness), (low.rotary, high.rotary), step)


def _shear_change_by_rows(case: Case, key: str) -> ShearChange | None:
    """Return how kGA and rho I change with each row of a column of the stations."""
    name, _, state = key.partition(":")
    keys = (*_STATIONS, name, *([state] if state else []))
    if case.model.theory == "euler_bernoulli" or name not in _OF_SHEAR:
        return None
    if name == _MASS and not state:
        keys = (*keys, next(iter(case.vehicle.stations.mass_per_length)))
    column = column_values(case.vehicle.stations, keys[2:])
    steps = _STEP * column
    rows = np.concatenate([column - np.diag(steps), column + np.diag(steps)])
    found = _sheared(case.many({keys: rows}, len(rows)))
    assert found is not None
    return _change(_halves(found.stiffness), _halves(found.rotary), 2 * steps[:, None])


def _sheared(cases: ManyCases) -> Sheared | None:
    return sheared(cases.vehicle, cases.model, mass_of(cases), cases.optional_column)


def _halves(profile: Profile) -> tuple[Profile, Profile]:
    """Return a profile of the first and of the second half of many cases."""
    ends = profile.ends
    if ends.ndim == 2:  # does not depend on what varies
        return profile, profile
    first, second = np.split(ends, 2)
    return replace(profile, ends=first), replace(profile, ends=second)


def _change(
    stiffness: tuple[Profile, Profile], rotary: tuple[Profile, Profile], step: Any
) -> ShearChange:
    def difference(low: Profile, high: Profile) -> Callable[[Array], Array]:
        return lambda x: np.asarray((high.at(x) - low.at(x)) / step)

    return ShearChange(difference(*stiffness), difference(*rotary))


def _mass_change(before: Case, after: Case, step: float) -> MassChange:
    low, high = (c.vehicle.mass_distribution(c.condition.burn_fraction) for c in (before, after))

    def difference(function: Callable[[int, Array], Array]) -> Callable[[Array], Array]:
        return lambda x: np.asarray((function(1, x) - function(0, x)) / step)

    both = (low, high)
    return MassChange(
        difference(lambda i, x: both[i].at(x)), difference(lambda i, x: both[i].moments(x)[0])
    )
