"""What varies in a study: numbers and columns of the case, their values and distributions."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from antinode.arrays import Array
from antinode.errors import InputError
from antinode.inputs.places import Keys, Place
from antinode.inputs.units import to_si
from antinode.text import short
from antinode.vehicle.columns import interpolation_matrix
from antinode.vehicle.numbers import value_at

from .file import StudyInput
from .subject import OfBeam, OfVehicle
from .table import DesignTable, TableRows


@dataclass(frozen=True)
class Variable:
    """One input, or one control point of a column.

    Attributes
    ----------
    name : str
        Of the coordinate.
    given : StudyInput
        What the file says of it.
    kind : {"number", "column", "time"}
    keys : tuple
        From the case to the number or the column.
    unit : str
        SI unit of the values: "1" for a factor.
    place : Place or None
        Of a number.
    start : float
        What the case has; 1 for a factor.
    weights : array, shape (rows,), or None
        Of a control point on the rows of its column.
    key : str
        The path as the file has it.
    """

    name: str
    given: StudyInput
    kind: str
    keys: Keys
    unit: str
    place: Place | None
    start: float | None
    weights: Array | None
    key: str = "time"
    column: tuple[DesignTable, int] | None = None
    """Of a table that holds the values, and which it is."""

    def number(self, value: float | str, what: str) -> float:
        """Return a value of the file in SI, or say what is wrong with it."""
        try:
            number = to_si(value, "" if self.unit == "1" else self.unit)
        except ValueError as error:
            raise InputError(f"inputs, {self.name}: {what} = {short(value)}; {error}") from error
        if not math.isfinite(number):
            raise InputError(f"inputs, {self.name}: {what} is {number}; give a finite number")
        return number

    def from_table(self, rows: TableRows) -> Array:
        """Return the values of some rows of the table, in SI.

        Raises
        ------
        InputError
            If one is no number; it says where.
        """
        assert self.column is not None
        table, k = self.column
        unit, cells = table.units[k], rows.columns[k]
        try:
            plain = np.array(cells, dtype=float)
            low, high = self.number(f"0 {unit}".strip(), "0"), self.number(f"1 {unit}".strip(), "1")
            values = low + (high - low) * plain
            if np.all(np.isfinite(values)):
                return values
        except (ValueError, TypeError, InputError):
            pass
        return np.array([self._cell(*each, table) for each in zip(rows.lines, cells, strict=True)])

    def _cell(self, line: int, cell: Any, table: DesignTable) -> float:
        assert self.column is not None
        try:
            return self.number(f"{cell} {table.units[self.column[1]]}".strip(), "value")
        except InputError as error:
            raise InputError(f"{table.path}, {table.unit_of_rows} {line}: {error}") from error

    @cached_property
    def listed(self) -> Array:
        """Values of a grid or a table, in SI."""
        g = self.given
        if self.column is not None:
            return np.concatenate([self.from_table(rows) for rows in self.column[0].parts()])
        if g.values is not None:
            return np.array([self.number(v, "values") for v in g.values])
        if g.distribution is not None and g.number is None:
            raise InputError(
                f"inputs, {self.name}: a distribution is for samples; write design = {{ kind = "
                "'sobol', number = 256 }, or give values"
            )
        if g.low is None or g.high is None or g.number is None:
            raise InputError(f"inputs, {self.name}: give values, or low, high and number")
        low, high = self._range()
        if g.spacing == "log":
            if low <= 0:
                raise InputError(
                    f"inputs, {self.name}: low is {low:g}; a log spacing needs it above 0"
                )
            return np.geomspace(low, high, g.number)
        return np.linspace(low, high, g.number)

    def _range(self) -> tuple[float, float]:
        """Return low and high; an empty range is refused."""
        g = self.given
        if g.low is None or g.high is None:
            raise InputError(f"inputs, {self.name}: give low and high")
        low, high = self.number(g.low, "low"), self.number(g.high, "high")
        if not low < high and not (low == high and g.number == 1):
            raise InputError(
                f"inputs, {self.name}: the range from {low:g} to {high:g} is empty; "
                "make high larger than low"
            )
        return low, high

    def quantile(self, u: Array) -> Array:
        """Return the values below which the shares `u` of the distribution lie."""
        how = self.given.distribution
        if how == "uniform":
            low, high = self._range()
            return low + (high - low) * u
        if how == "loguniform":
            low, high = self._range()
            if low <= 0:
                raise InputError(
                    f"inputs, {self.name}: low is {low:g}; loguniform needs it above 0"
                )
            return np.asarray(low * (high / low) ** u)
        if how == "triangular":
            return self._triangular(u)
        return self._normal(u, logarithm=how == "lognormal")

    def _middle(self) -> float:
        if self.given.mean is not None:
            return self.number(self.given.mean, "mean")
        if self.start is None:
            raise InputError(f"inputs, {self.name}: the case has no value; give a mean")
        return self.start

    def _triangular(self, u: Array) -> Array:
        low, high = self._range()
        peak = self._middle()
        if not low <= peak <= high:
            raise InputError(
                f"inputs, {self.name}: the peak {peak:g} is not within {low:g} and {high:g}"
            )
        c = (peak - low) / (high - low)
        left = low + np.sqrt(u * (high - low) * (peak - low))
        return np.where(u < c, left, high - np.sqrt((1 - u) * (high - low) * (high - peak)))

    def _normal(self, u: Array, *, logarithm: bool) -> Array:
        from scipy.special import ndtr, ndtri

        g, mean = self.given, self._middle()
        if g.sd is None:
            raise InputError(f"inputs, {self.name}: {g.distribution} needs sd")
        sd = to_si_pure(g.sd, self.name) if logarithm else self.number(g.sd, "sd")
        if sd <= 0 or (logarithm and mean <= 0):
            raise InputError(
                f"inputs, {self.name}: sd must be above 0, and so must the median of lognormal"
            )
        ends = [None if v is None else self.number(v, "bound") for v in (g.low, g.high)]
        if logarithm:
            mean, ends = math.log(mean), [e and math.log(e) for e in ends]
        low, high = (
            default if e is None else float(ndtr((e - mean) / sd))
            for e, default in zip(ends, (0.0, 1.0), strict=True)
        )
        if not low < high:
            raise InputError(f"inputs, {self.name}: nothing of it lies between low and high")
        inside = np.clip(low + (high - low) * u, 1e-300, 1 - 1e-16)
        value = mean + sd * ndtri(inside)
        return np.asarray(np.exp(value) if logarithm else value)


def to_si_pure(value: float | str, name: str) -> float:
    """Return a pure number, such as the deviation of a logarithm."""
    try:
        return to_si(value, "")
    except ValueError as error:
        raise InputError(f"inputs, {name}: sd = {short(value)}; {error}") from error


def variables_of(subject: OfVehicle | OfBeam, given: StudyInput) -> list[Variable]:
    """Return an input as variables: one, or one for each control point of a column."""
    if given.key == "time":
        return [Variable(given.name or "time", given, "time", ("time",), "s", None, None, None)]
    column = _reworded(lambda: subject.column(given.key))
    if column is not None:
        return _column_variables(subject, given, column)
    if given.control_points is not None:
        raise InputError(f"inputs: key = {short(given.key)}; control_points are for columns")
    place = _reworded(lambda: subject.place(given.key))
    start = value_at(subject.tree, place.keys)
    if given.factor and start is None:
        raise InputError(
            f"inputs: key = {short(given.key)}: the case has no value for a factor to multiply"
        )
    if given.factor and start == 0:
        raise InputError(
            f"inputs: key = {short(given.key)}: the case has 0 there, which no factor changes; "
            "leave out factor and give values of its own"
        )
    if why := subject.without_effect(place.keys):
        raise InputError(f"inputs: key = {short(given.key)} changes nothing: {why}")
    name = given.name or subject.short_name(place)
    unit = "1" if given.factor else place.unit or "1"
    start = 1.0 if given.factor else start
    key = subject.written(place.keys)
    return [Variable(name, given, "number", place.keys, unit, place, start, None, key)]


def _column_variables(subject: OfVehicle | OfBeam, given: StudyInput, keys: Keys) -> list[Variable]:
    x, step = subject.x, subject.interpolation == "step"
    rows = (x[1:] + x[:-1]) / 2 if step else x
    points, key = given.control_points, subject.written(keys)
    bare = ":".join(map(str, keys[len(subject.stations) :]))
    if why := subject.without_effect(keys):
        raise InputError(f"inputs: key = {short(given.key)} changes nothing: {why}")
    name = given.name or bare
    if points is None:
        ones = np.ones(len(x))
        return [Variable(name, given, "column", keys, "1", None, 1.0, ones, key)]
    places = np.linspace(x[0], x[-1], points) if isinstance(points, int) else np.array(points)
    if places[0] < x[0] or places[-1] > x[-1]:
        say = f"they must lie on the body, from {x[0]:g} to {x[-1]:g} m"
        raise InputError(f"inputs, {name}: control_points: {say}")
    weights = interpolation_matrix(places, rows, given.interpolation)
    if step:
        weights = np.concatenate([weights, weights[-1:]])
    return [
        Variable(f"{name} at {p:g} m", given, "column", keys, "1", None, 1.0, weights[:, k], key)
        for k, p in enumerate(places.tolist())
    ]


def _reworded(action: Any) -> Any:
    """Do something that speaks of parameters or distributions, and let it speak of inputs."""
    try:
        return action()
    except InputError as error:
        text = str(error)
        for word in ("parameters: key", "distributions: column"):
            text = text.replace(word, "inputs: key")
        raise InputError(text.replace("be a parameter", "be an input")) from error
