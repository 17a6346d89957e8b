"""Designs: which values the inputs have in case number i, chunk by chunk.

A grid runs through every combination, the last input fastest. Samples are numbers u between 0 and
1, turned into values by the inverse of each distribution. Any chunk can be made by itself, so that
memory does not grow with the number of cases.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from antinode.arrays import Array
from antinode.errors import InputError
from antinode.inputs.units import to_si
from antinode.text import nearest, short
from antinode.vehicle.case import Case
from antinode.vehicle.columns import column_keys, interpolation_matrix
from antinode.vehicle.condition import OperatingCondition
from antinode.vehicle.paths import Keys, Place, find_place, value_at
from antinode.vehicle.vehicle import Vehicle

from .file import MOST_CASES, Study, StudyInput

_COLUMNS = ("mass_per_length", "bending_stiffness", "axial_stiffness", "radius")
_MOST_PERMUTED = 10_000_000
_MOST_SOBOL = 21_000
_SAMPLED = ("random", "latin_hypercube", "sobol", "saltelli")


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
    """

    name: str
    given: StudyInput
    kind: str
    keys: Keys
    unit: str
    place: Place | None
    start: float | None
    weights: Array | None

    @property
    def key(self) -> str:
        """The path as the case has it."""
        return ".".join(map(str, self.keys))

    def number(self, value: float | str, what: str) -> float:
        """Return a value of the file in SI, or say what is wrong with it."""
        try:
            number = to_si(value, "" if self.unit == "1" else self.unit)
        except ValueError as error:
            raise InputError(f"inputs, {self.name}: {what} = {short(value)}; {error}") from error
        if not math.isfinite(number):
            raise InputError(f"inputs, {self.name}: {what} is {number}; give a finite number")
        return number

    @cached_property
    def listed(self) -> Array:
        """Values of a grid or a table, in SI."""
        g = self.given
        if g.values is not None:
            return np.array([self.number(v, "values") for v in g.values])
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


@dataclass(frozen=True)
class Points:
    """All cases of a study: which values its variables have.

    Attributes
    ----------
    study : Study
    variables : tuple of Variable
    cases : int
    shape : tuple of int
        Of a grid, one length a variable; else (cases,).
    """

    study: Study
    variables: tuple[Variable, ...]
    cases: int
    shape: tuple[int, ...]

    @property
    def chunks(self) -> int:
        """Number of chunks."""
        return -(-self.cases // self.study.run.chunk)

    def bounds(self, chunk: int) -> tuple[int, int]:
        """Return the first case of a chunk, and the first of the next one."""
        size = self.study.run.chunk
        return chunk * size, min(self.cases, (chunk + 1) * size)

    @property
    def tracked(self) -> bool:
        """Whether modes are followed by shape."""
        wish = self.study.tracking.track
        ordered = self.study.design.kind not in _SAMPLED
        return ordered and self.cases <= 20_000 if wish is None else wish

    def values(self, chunk: int) -> Array:
        """Return the values of a chunk in SI, shape (cases, variables)."""
        start, stop = self.bounds(chunk)
        kind = self.study.design.kind
        if kind in _SAMPLED:
            u = self._samples(chunk, start, stop)
            columns = [v.quantile(u[:, k]) for k, v in enumerate(self.variables)]
        elif kind == "zip":
            columns = [v.listed[start:stop] for v in self.variables]
        else:
            index = np.unravel_index(np.arange(start, stop), self.shape)
            columns = [v.listed[i] for v, i in zip(self.variables, index, strict=True)]
        return np.stack(columns, axis=1) if columns else np.zeros((stop - start, 0))

    def _samples(self, chunk: int, start: int, stop: int) -> Array:
        """Return numbers between 0 and 1, shape (cases, variables)."""
        design, d = self.study.design, len(self.variables)
        if design.kind == "sobol":
            return self._sobol(start, stop, d)
        if design.kind == "saltelli":
            return self._saltelli(start, stop)
        rng = np.random.default_rng([design.seed, 1, chunk])
        inside = rng.random((stop - start, d))
        if design.kind == "random":
            return inside
        strata = np.stack([p[start:stop] for p in self._permutations], axis=1)
        return np.asarray((strata + inside) / self.cases)

    def _saltelli(self, start: int, stop: int) -> Array:
        """Return rows of A, then B, then A with column 1, 2, ... of B."""
        d = len(self.variables)
        number = self.cases // (d + 2)
        parts = []
        for block in range(start // number, (stop - 1) // number + 1):
            first, last = max(start - block * number, 0), min(stop - block * number, number)
            both = self._sobol(first, last, 2 * d)
            u = both[:, d:] if block == 1 else both[:, :d].copy()
            if block > 1:
                u[:, block - 2] = both[:, d + block - 2]
            parts.append(u)
        return np.concatenate(parts)

    def _sobol(self, start: int, stop: int, dimensions: int) -> Array:
        from scipy.stats import qmc

        engine = qmc.Sobol(dimensions, scramble=True, rng=self.study.design.seed)
        if start:
            engine.fast_forward(start)
        import warnings

        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of a number of points that is no power of two
            return np.asarray(engine.random(stop - start))

    @cached_property
    def _permutations(self) -> list[npt.NDArray[np.int64]]:
        seeds = [[self.study.design.seed, 2, k] for k in range(len(self.variables))]
        return [np.random.default_rng(seed).permutation(self.cases) for seed in seeds]


def points_of(study: Study) -> Points:
    """Check the inputs and the design of a study.

    Raises
    ------
    InputError
        If an input leads nowhere, a range is empty, lists have unequal lengths, or there are too
        many cases.
    """
    if not study.inputs:
        raise InputError("inputs is empty; give at least one [[inputs]], or design.table")
    variables = tuple(v for given in study.inputs for v in _variables(study.case, given))
    _check_names(variables)
    kind = study.design.kind
    if kind in _SAMPLED:
        cases, shape = _sample_number(study, variables)
    elif study.design.number is not None:
        raise InputError(f"design.number is for samples; a {kind} has as many cases as its values")
    elif kind == "zip":
        cases, shape = _zip_number(variables)
    else:
        shape = tuple(_length(v) for v in variables)
        cases = math.prod(shape)
    if cases > MOST_CASES:
        raise InputError(
            f"the design has {cases:.3g} cases; at most {MOST_CASES:.0e} are allowed: "
            "take fewer values, or a sobol design with fewer samples"
        )
    for v in variables:
        if kind in _SAMPLED:
            v.quantile(np.array([0.5]))
        else:
            v.listed  # noqa: B018
    return Points(study, variables, cases, shape if kind == "grid" else (cases,))


def _length(variable: Variable) -> int:
    g = variable.given
    return len(g.values) if g.values is not None else (g.number or len(variable.listed))


def _sample_number(study: Study, variables: tuple[Variable, ...]) -> tuple[int, tuple[int, ...]]:
    kind, number = study.design.kind, study.design.number
    if number is None:
        raise InputError(f"design.number is missing; say how many samples a {kind} design has")
    for v in variables:
        if v.given.values is not None or v.given.number is not None:
            raise InputError(
                f"inputs, {v.name}: values and number are for grid and zip; "
                f"give {kind} a range or a distribution"
            )
        if v.kind == "time":
            raise InputError(f"inputs, {v.name}: a history needs kind = 'zip'")
    if kind in ("sobol", "saltelli") and 2 * len(variables) > _MOST_SOBOL:
        raise InputError(f"{len(variables)} inputs; a {kind} design has at most {_MOST_SOBOL // 2}")
    if kind == "latin_hypercube" and number > _MOST_PERMUTED:
        raise InputError(
            f"design.number is {number}; a latin_hypercube has at most {_MOST_PERMUTED}: "
            "take kind = 'sobol'"
        )
    total = number * (len(variables) + 2) if kind == "saltelli" else number
    return total, (total,)


def _zip_number(variables: tuple[Variable, ...]) -> tuple[int, tuple[int, ...]]:
    lengths = {v.name: _length(v) for v in variables}
    if len(set(lengths.values())) > 1:
        told = ", ".join(f"{name} {n}" for name, n in list(lengths.items())[:6])
        raise InputError(
            f"the inputs of a zip must have as many values each; received {told}: "
            "fill them up, or take kind = 'grid'"
        )
    number = next(iter(lengths.values()))
    return number, (number,)


def _check_names(variables: tuple[Variable, ...]) -> None:
    seen: dict[str, str] = {}
    for v in variables:
        if v.name in _RESERVED:
            raise InputError(f"inputs: the name '{v.name}' is taken by the result; give another")
        if v.name in seen:
            raise InputError(f"inputs: two of them are called {short(v.name)}; give one a name")
        seen[v.name] = v.key
    keys = [v.key for v in variables if v.weights is None]
    for key in keys:
        if keys.count(key) > 1:
            raise InputError(f"inputs: {key} stands there twice; remove one")


_RESERVED = ("case", "mode", "reason", "track", "chunk", "checksum", "frequency_hz", "point")


def _variables(case: Case, given: StudyInput) -> list[Variable]:
    """Return an input as variables: one, or one for each control point of a column."""
    if given.key == "time":
        return [Variable(given.name or "time", given, "time", ("time",), "s", None, None, None)]
    bare = given.key.removeprefix("vehicle.").removeprefix("stations.")
    if bare.partition(":")[0] in _COLUMNS:
        return _column_variables(case, given, bare)
    if given.control_points is not None:
        raise InputError(f"inputs: key = {short(given.key)}; control_points are for columns")
    _check_bare(given.key)
    place = _reworded(lambda: find_place(case, given.key))
    start = value_at(case, place.keys)
    if given.factor and start is None:
        raise InputError(
            f"inputs: key = {short(given.key)}: the case has no value for a factor to multiply"
        )
    name = given.name or str(place.keys[-1] if isinstance(place.keys[-1], str) else place.text)
    unit = "1" if given.factor else place.unit or "1"
    return [
        Variable(
            name, given, "number", place.keys, unit, place, 1.0 if given.factor else start, None
        )
    ]


def _check_bare(key: str) -> None:
    """Refuse a name by itself that neither the condition nor the case has."""
    known = [*OperatingCondition.model_fields, *_COLUMNS, "time"]
    tables = [*Case.model_fields, *Vehicle.model_fields]
    first = key.partition(".")[0].partition("[")[0].strip()
    if first not in known and first not in tables:
        raise InputError(f"inputs: key = {short(key)} leads nowhere; {nearest(first, known)}")


def _column_variables(case: Case, given: StudyInput, bare: str) -> list[Variable]:
    stations = case.vehicle.stations
    keys: Keys = (
        "vehicle",
        "stations",
        *_reworded(lambda: column_keys(stations, bare)),
    )
    x, step = stations.x, case.vehicle.interpolation == "step"
    rows = (x[1:] + x[:-1]) / 2 if step else x
    points = given.control_points
    name = given.name or bare
    if points is None:
        ones = np.ones(len(x))
        return [Variable(name, given, "column", keys, "1", None, 1.0, ones)]
    places = np.linspace(x[0], x[-1], points) if isinstance(points, int) else np.array(points)
    if places[0] < x[0] or places[-1] > x[-1]:
        say = f"they must lie on the body, from {x[0]:g} to {x[-1]:g} m"
        raise InputError(f"inputs, {name}: control_points: {say}")
    weights = interpolation_matrix(places, rows, given.interpolation)
    if step:
        weights = np.concatenate([weights, weights[-1:]])
    return [
        Variable(f"{name} at {p:g} m", given, "column", keys, "1", None, 1.0, weights[:, k])
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
