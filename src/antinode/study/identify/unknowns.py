"""What may change, as one vector: numbers of the case, numbers of every row, columns.

Each unknown is a value or its logarithm, divided by a natural size, so that steps of all of them
compare. Priors and smoothness are residuals beside those of the data.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from antinode.arrays import Array
from antinode.beam.file import BeamFile
from antinode.errors import InputError
from antinode.inputs.places import Keys, Place, wrong_key
from antinode.inputs.reading import COLUMN_UNITS
from antinode.inputs.units import to_si
from antinode.study.design.subject import Changed, Given, OfBeam, OfVehicle, with_value
from antinode.text import short
from antinode.vehicle.numbers import value_at
from antinode.vehicle.paths import find_place

from .columns import Column, make_column, second_differences
from .file import Distribution, IdentificationProblem, Parameter, Quantity, parameters_of


class Unknown(NamedTuple):
    """One entry of the vector.

    Attributes
    ----------
    label : str
        For tables: ``thrust``, ``extra drag, row 3``, ``bending stiffness at 2.1 m``.
    unit : str
        Of the value; "" for a factor.
    log : bool
        Whether the logarithm of the value is what is fitted.
    start, lower, upper : float
        The value.
    size : float
        Natural step of the value, or of its logarithm.
    prior_mean, prior_sd : float
        Of the value; sd infinite without a prior.
    lognormal : bool
        Whether the prior is one for the logarithm, of which `prior_sd` is the deviation.
    """

    label: str
    unit: str
    log: bool
    start: float
    lower: float
    upper: float
    size: float
    prior_mean: float
    prior_sd: float
    lognormal: bool

    def coded(self, value: float) -> float:
        """Return the entry of the vector that stands for a value."""
        if self.log:
            return (math.log(value) if value > 0 else -math.inf) / self.size
        return value / self.size

    def value(self, entry: float) -> float:
        """Return the value that an entry of the vector stands for."""
        return math.exp(self.size * entry) if self.log else self.size * entry

    def prior_distance(self, value: float) -> float:
        """Return how far a value is from the prior, in standard deviations."""
        apart = math.log(value / self.prior_mean) if self.lognormal else value - self.prior_mean
        return apart / self.prior_sd

    def slope(self, entry: float) -> float:
        """Return the derivative of the value by the entry."""
        return self.size * (self.value(entry) if self.log else 1.0)


@dataclass(frozen=True)
class Scalar:
    """A number of the case, with its entries in the vector: one, or one for each row."""

    place: Place
    per_row: bool
    entries: tuple[int, ...]

    def entry(self, row: int) -> int:
        """Return the entry that holds for a row."""
        return self.entries[row if self.per_row else 0]


@dataclass(frozen=True)
class ColumnEntries:
    """A column with its entries in the vector."""

    column: Column
    entries: slice
    smoothing: Array
    """Residuals of its smoothness are this times its unknowns."""


@dataclass(frozen=True)
class Unknowns:
    """The vector of all that may change, and how it acts on the case.

    Attributes
    ----------
    case : Case or BeamFile
        Where it starts.
    items : tuple of Unknown
    scalars : tuple of Scalar
    columns : tuple of ColumnEntries
        Each after the one that it is relative to.
    """

    case: Given
    items: tuple[Unknown, ...]
    scalars: tuple[Scalar, ...]
    columns: tuple[ColumnEntries, ...]

    @cached_property
    def start(self) -> Array:
        """The vector to start at."""
        return np.array([item.coded(item.start) for item in self.items])

    @cached_property
    def bounds(self) -> tuple[Array, Array]:
        """Lower and upper bounds of the vector."""
        low = np.array([item.coded(item.lower) for item in self.items])
        return low, np.array([item.coded(item.upper) for item in self.items])

    def values(self, vector: Array) -> Array:
        """Return the values that the vector stands for."""
        return np.array([i.value(e) for i, e in zip(self.items, vector.tolist(), strict=True)])

    def slopes(self, vector: Array) -> Array:
        """Return the derivatives of the values by the entries."""
        return np.array([i.slope(e) for i, e in zip(self.items, vector.tolist(), strict=True)])

    def logarithms(self, vector: Array) -> dict[str, Array]:
        """Return the logarithm of every column that changes."""
        found: dict[str, Array] = {}
        for item in self.columns:
            q = np.array([u.size for u in self.items[item.entries]]) * vector[item.entries]
            parent = item.column.parent
            above = None if parent is None else found.get(parent)
            if parent is not None and above is None:
                above = np.log(self._given(parent))
            found[item.column.key] = item.column.logarithm(q, above)
        return found

    def _given(self, key: str) -> Array:
        return self.subject.values((*self.subject.stations, *key.split(":")))

    @cached_property
    def subject(self) -> OfVehicle | OfBeam:
        """The case as paths and columns ask for it."""
        return parameters_of(self.case)

    def apply(self, case: Changed, vector: Array) -> Changed:
        """Return a case with all that is common to the rows."""
        logarithms, stations = self.logarithms(vector), self.subject.stations
        keys = [(*stations, *item.column.keys) for item in self.columns]
        columns = [np.exp(logarithms[item.column.key]) for item in self.columns]
        for place, column in zip(keys, columns, strict=True):
            case = with_value(case, place, column)
        return self._with_scalars(case, vector, per_row=False, row=0)

    def apply_row(self, case: Changed, vector: Array, row: int) -> Changed:
        """Return a case with what belongs to one row."""
        return self._with_scalars(case, vector, per_row=True, row=row)

    def _with_scalars(self, case: Changed, vector: Array, *, per_row: bool, row: int) -> Changed:
        for scalar in self.scalars:
            if scalar.per_row == per_row:
                k = scalar.entry(row)
                value = self.items[k].value(float(vector[k]))
                case = with_value(case, scalar.place.keys, value)
        return case

    def prior_residuals(self, vector: Array) -> Array:
        """Return distances from the priors in standard deviations, then those of smoothness."""
        own = [item.prior_distance(value) for item, value in self.with_prior(vector)]
        smooth = [item.smoothing @ vector[item.entries] for item in self.columns]
        return np.concatenate([own, *smooth])

    def prior_jacobian(self, vector: Array) -> Array:
        """Return the derivatives of `prior_residuals` by the vector."""
        rows = []
        for k, item in enumerate(self.items):
            if math.isfinite(item.prior_sd):
                entry = float(vector[k])
                by_value = 1 / item.value(entry) if item.lognormal else 1.0
                rows.append((k, by_value * item.slope(entry) / item.prior_sd))
        matrix = np.zeros((len(rows), len(self.items)))
        for i, (k, slope) in enumerate(rows):
            matrix[i, k] = slope
        smooth = [np.zeros((len(item.smoothing), len(self.items))) for item in self.columns]
        for block, column in zip(smooth, self.columns, strict=True):
            block[:, column.entries] = column.smoothing
        return np.concatenate([matrix, *smooth])

    def with_prior(self, vector: Array) -> Iterator[tuple[Unknown, float]]:
        """Yield every unknown that has a prior, with its value."""
        for item, entry in zip(self.items, vector.tolist(), strict=True):
            if math.isfinite(item.prior_sd):
                yield item, item.value(entry)


def make_unknowns(
    problem: IdentificationProblem, cases: Sequence[Given], own: Sequence[Collection[Keys]]
) -> Unknowns:
    """Gather the unknowns of a problem.

    Parameters
    ----------
    problem : IdentificationProblem
    cases : sequence of Case or BeamFile
        The case in the condition of every row.
    own : sequence of collection of keys
        What each row sets.

    Raises
    ------
    InputError
        If a parameter leads nowhere, starts outside its bounds, or is given twice.
    """
    items: list[Unknown] = []
    scalars, columns = [], []
    for parameter in problem.parameters:
        scalar, found = _scalar(problem.case, parameter, cases, own, len(items))
        scalars.append(scalar)
        items += found
    ordered = _parents_first(problem)
    for column, given in ordered:
        found = list(_column_unknowns(column, given))
        entries = slice(len(items), len(items) + len(found))
        sizes = np.array([item.size for item in found])
        smoothing = given.smoothness * second_differences(column.points) * sizes
        keep = smoothing if given.smoothness else np.zeros((0, len(found)))
        columns.append(ColumnEntries(column, entries, keep))
        items += found
    _check_unique(scalars, columns, problem.subject.stations)
    if not items:
        raise InputError("nothing may change: give [[parameters]] or [[distributions]]")
    return Unknowns(problem.case, tuple(items), tuple(scalars), tuple(columns))


def _scalar(
    case: Given,
    given: Parameter,
    cases: Sequence[Given],
    own: Sequence[Collection[Keys]],
    first: int,
) -> tuple[Scalar, list[Unknown]]:
    place = place_of(case, given.key)
    rows = [k for k, keys in enumerate(own) if place.keys in keys]
    if rows and not given.per_row:
        say = "leave it out of the observations, or give the parameter per_row = true"
        name = place.keys[-1]
        raise InputError(
            f"parameters: key = '{given.key}', but row {rows[0] + 1} sets {name}; {say}"
        )
    label = given.name or place.text.rpartition("vehicle.")[2].removeprefix("condition.")
    if not given.per_row:
        return Scalar(place, False, (first,)), [_unknown(given, place, label, case)]
    found = [
        _unknown(given, place, f"{label}, row {k}", row_case) for k, row_case in enumerate(cases, 1)
    ]
    return Scalar(place, True, tuple(range(first, first + len(found)))), found


def place_of(case: Given, path: str) -> Place:
    """Find a number that may change, by its path.

    Raises
    ------
    InputError
        If there is none.
    """
    if not isinstance(case, BeamFile):
        return find_place(case, path)
    subject = OfBeam(case, table="parameters")
    place = subject.place(path)
    if why := subject.without_effect(place.keys):
        raise InputError(f"{wrong_key(path)} changes nothing: {why}")
    return place


def _unknown(given: Parameter, place: Place, label: str, case: Given) -> Unknown:
    where = f"parameters: key = '{given.key}'"

    def si(quantity: Quantity | None, name: str) -> float | None:
        if quantity is None:
            return None
        try:
            return to_si(quantity, place.unit)
        except ValueError as error:
            raise InputError(f"{where}: {name} is {short(quantity)}; {error}") from error

    start = si(given.start, "start")
    start = value_at(parameters_of(case).tree, place.keys) if start is None else start
    if start is None:
        raise InputError(f"{where} has no value in the case; give it there, or a start here")
    lower, upper = _bounds(si(given.lower, "lower"), si(given.upper, "upper"), place, where)
    prior = given.prior
    lognormal = prior is not None and prior.kind == "lognormal"
    log = given.scale == "log" or lognormal
    mean = si(prior.mean, "prior.mean") if prior else None
    mean = start if mean is None else mean
    sd = math.inf
    if prior:
        own_sd = _plain(prior.sd, where) if lognormal else si(prior.sd, "prior.sd")
        sd = own_sd if own_sd is not None else math.inf
        if not 0 < sd < math.inf:
            raise InputError(f"{where}: prior.sd is {short(prior.sd)}; it must be above 0")
    if log and not min(start, mean if prior else start, upper) > 0:
        raise InputError(f"{where}: start is {start:g}; a logarithmic scale needs values above 0")
    if not lower <= start <= upper:
        say = "the bounds exclude the start: widen them, or give another start"
        raise InputError(f"{where}: starts at {start:g}, outside {lower:g} to {upper:g}; {say}")
    size = _size(log, lognormal, start, lower, upper, mean, sd)
    return Unknown(label, place.unit, log, start, lower, upper, size, mean, sd, lognormal)


def _plain(quantity: Quantity, where: str) -> float:
    try:
        return to_si(quantity, "")
    except ValueError as error:
        say = "a lognormal prior needs the standard deviation of the logarithm, a plain number"
        raise InputError(f"{where}: prior.sd is {short(quantity)}; {say}") from error


def _bounds(
    lower: float | None, upper: float | None, place: Place, where: str
) -> tuple[float, float]:
    """Return the bounds: as given, within what the case itself allows."""
    low = place.low if lower is None else lower
    high = place.high if upper is None else upper
    if low < place.low or high > place.high:
        say = f"the case allows {place.low:g} to {place.high:g}"
        raise InputError(f"{where}: bounds are {low:g} to {high:g}; {say}: correct them")
    if not low < high:
        raise InputError(f"{where}: lower is {low:g} and upper {high:g}; lower must be below upper")
    return low, high


def _size(
    log: bool, lognormal: bool, start: float, lower: float, upper: float, mean: float, sd: float
) -> float:
    """Return a natural step of a value, or of its logarithm."""
    if log:
        relative = sd if lognormal else sd / abs(mean)
        if not math.isfinite(relative) and lower > 0 and math.isfinite(upper):
            relative = math.log(upper / lower) / 4
        return relative if math.isfinite(relative) else 1.0
    if math.isfinite(sd):
        return sd
    if math.isfinite(upper - lower):
        return (upper - lower) / 4
    return abs(start) or 1.0


def _parents_first(problem: IdentificationProblem) -> list[tuple[Column, Distribution]]:
    """Return the columns, each after the one that it is relative to."""
    made = [(make_column(problem.case, given), given) for given in problem.distributions]
    keys = {column.key for column, _ in made}
    ordered: list[tuple[Column, Distribution]] = []
    while made:
        placed = {column.key for column, _ in ordered}
        ready = [m for m in made if m[0].parent not in keys - placed]
        if not ready:
            names = " and ".join(column.key for column, _ in made)
            raise InputError(f"distributions: {names} are relative to each other; break the circle")
        ordered += ready
        made = [m for m in made if m not in ready]
    return ordered


def _column_unknowns(column: Column, given: Distribution) -> Iterator[Unknown]:
    """Yield an unknown for every control point or segment."""
    low, high = given.lower or 0.0, given.upper or math.inf
    if not low <= 1 <= high:
        say = (
            "the bounds are factors on the start and exclude it: lower is at most 1, upper at least"
        )
        raise InputError(f"distributions: {given.column}: {low:g} to {high:g}; {say} 1")
    unit = COLUMN_UNITS.get(str(column.keys[0]), "")
    unit = "" if given.fitted == "factor" or given.relative_to else unit
    sd = given.prior_sd or math.inf
    size = sd if math.isfinite(sd) else 1.0
    for x, q in zip(column.points, column.start, strict=True):
        start = math.exp(q)
        label = f"{column.label} at {x:.4g} m"
        bounds = low * start, high * start
        yield Unknown(label, unit, True, start, *bounds, size, start, sd, True)


def _check_unique(
    scalars: Sequence[Scalar], columns: Sequence[ColumnEntries], stations: Keys
) -> None:
    names = [s.place.text for s in scalars] + [c.column.key for c in columns]
    for name in names:
        if names.count(name) > 1:
            raise InputError(f"{name} may change by two entries; remove one of them")
    keys = {(*stations, *c.column.keys) for c in columns}
    for scalar in scalars:
        if scalar.place.keys[:-1] in keys:
            say = "it is part of a distribution already: remove one of them"
            raise InputError(f"parameters: key = '{scalar.place.text}'; {say}")
