"""Designs: which values the inputs have in case number i, chunk by chunk.

A grid runs through every combination, the last input fastest. Samples are numbers u between 0 and
1, turned into values by the inverse of each distribution. Any chunk can be made by itself, so that
memory does not grow with the number of cases.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from antinode.arrays import Array
from antinode.beam.file import BeamFile
from antinode.errors import InputError
from antinode.text import nearest, short

from .file import (
    CASE_OUTPUTS,
    LOAD_OUTPUTS,
    MARGIN_OUTPUTS,
    MODE_OUTPUTS,
    MOST_CASES,
    OF_BEAMS,
    Study,
)
from .samples import SobolSamples, latin_column, random_samples
from .variables import Variable, variables_of

_MOST_PERMUTED = 10_000_000
_MOST_SOBOL = 21_000
_SAMPLED = ("random", "latin_hypercube", "sobol", "saltelli")
GROWING = ("random", "latin_hypercube", "sobol")
"""Designs to which samples can be added."""


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
        return -(-self.cases // self.study.run_table.chunk)

    def bounds(self, chunk: int) -> tuple[int, int]:
        """Return the first case of a chunk, and the first of the next one."""
        size = self.study.run_table.chunk
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
        elif (table := self.study.table) is not None:
            rows = table.read(start, stop)
            columns = [v.from_table(rows) for v in self.variables]
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
            return self._sequence.rows(start, stop)
        if design.kind == "saltelli":
            return self._saltelli(start, stop)
        if design.kind == "random":
            return random_samples(design.seed, chunk, stop - start, d)
        return np.stack([column[start:stop] for column in self._latin_columns], axis=1)

    def _saltelli(self, start: int, stop: int) -> Array:
        """Return rows of A, then B, then A with column 1, 2, ... of B."""
        d = len(self.variables)
        number = self.cases // (d + 2)
        parts = []
        for block in range(start // number, (stop - 1) // number + 1):
            first, last = max(start - block * number, 0), min(stop - block * number, number)
            both = self._sequence.rows(first, last)
            u = both[:, d:] if block == 1 else both[:, :d].copy()
            if block > 1:
                u[:, block - 2] = both[:, d + block - 2]
            parts.append(u)
        return np.concatenate(parts)

    @cached_property
    def _sequence(self) -> SobolSamples:
        d, kind = len(self.variables), self.study.design.kind
        return SobolSamples(self.study.design.seed, 2 * d if kind == "saltelli" else d)

    @cached_property
    def _latin_columns(self) -> list[Array]:
        seed = self.study.design.seed
        return [latin_column(seed, k, self.cases) for k in range(len(self.variables))]

    @property
    def grows(self) -> bool:
        """Whether a design of more cases begins with the cases of this one."""
        return self.study.design.kind in GROWING

    def extends(self, cases: int) -> bool:
        """Tell whether this design begins with the cases of one of fewer cases."""
        if not self.grows or not 0 < cases <= self.cases:
            return False
        times, rest = divmod(self.cases, cases)
        doubled = not rest and not times & (times - 1)
        return doubled or self.study.design.kind != "latin_hypercube"


def resized(points: Points, cases: int) -> Points:
    """Return a design of samples with another number of them."""
    design = points.study.design.model_copy(update={"number": cases})
    study = points.study.model_copy(update={"design": design})
    return Points(study, points.variables, cases, (cases,))


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
    variables = _variables(study)
    _check_names(variables, {one.name for one in study.asked})
    _check_families(study)
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
        _check_values(v, sampled=kind in _SAMPLED)
    _check_figure(study, variables)
    return Points(study, variables, cases, shape if kind == "grid" else (cases,))


def _variables(study: Study) -> tuple[Variable, ...]:
    """Return what varies; a column of a table knows where its values are."""
    found = tuple(v for given in study.inputs for v in variables_of(study.subject, given))
    if study.table is None:
        return found
    table = study.table
    return tuple(replace(v, column=(table, k)) for k, v in enumerate(found))


def check_table(study: Study) -> None:
    """Read through the table of a study.

    Raises
    ------
    InputError
        If a value is none, or times go back; it says where.
    """
    if study.table is None:
        return
    variables, before = _variables(study), np.array([-np.inf])
    for rows in study.table.parts():
        for v in variables:
            values = v.from_table(rows)
            if v.kind == "time":
                counted = f"{study.table.unit_of_rows}s"
                _check_times(v.name, np.append(before, values), rows.lines[0] - 1, counted)
                before = values[-1:]


def _length(variable: Variable) -> int:
    if variable.column is not None:
        return variable.column[0].rows
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


def _check_values(variable: Variable, *, sampled: bool) -> None:
    """Refuse values that are none, times that go back, and factors on nothing."""
    if sampled:
        variable.quantile(np.array([0.5]))
        return
    if variable.column is not None:
        return  # checked when the file was read
    values = variable.listed
    if variable.kind == "time":
        _check_times(variable.name, values, 1)


def _check_times(name: str, values: Array, first: int, counted: str = "values") -> None:
    """Refuse times that go back; `first` is the number of the first value."""
    back = np.diff(values) <= 0
    if back.any():
        at = int(np.argmax(back))
        raise InputError(
            f"inputs, {name}: {values[at + 1]:g} s comes after {values[at]:g} s ({counted} "
            f"{at + first} and {at + first + 1}); sort the rows by time, each once"
        )


def _check_figure(study: Study, variables: tuple[Variable, ...]) -> None:
    names = [v.name for v in variables]
    if study.figure.x is not None and study.figure.x not in names:
        wrong = short(study.figure.x)
        raise InputError(f"figure.x = {wrong} is no input; {nearest(study.figure.x, names)}")


def _check_families(study: Study) -> None:
    """Refuse a family of modes for which there are no columns, and outputs that a beam has not."""
    is_beam = isinstance(study.case, BeamFile)
    for family in study.solve.families:
        if absent := study.subject.lacks(family):
            whose = "the beam does" if is_beam else "the vehicle's stations do"
            raise InputError(
                f"solve.families: {family} modes need {absent}, which {whose} "
                "not have: add the column, or leave the family out"
            )
    loads = [name for name in study.outputs if name in LOAD_OUTPUTS and name not in OF_BEAMS]
    answered = not is_beam and study.vehicle_case.model.water_answers
    if answered and (margins := [name for name in study.outputs if name in MARGIN_OUTPUTS]):
        raise InputError(
            f"outputs: {margins[0]} is a factor on axial forces alone, and the water's stiffness "
            "goes with the speed as they do: take growth_rate_per_s and kind, or follow the speed "
            "with 'antinode stability --along condition.speed=...'"
        )
    if is_beam and loads:
        allowed = ", ".join((*MODE_OUTPUTS, *OF_BEAMS))
        raise InputError(f"outputs: {loads[0]} is of vehicles; of a beam there are {allowed}")


def _check_names(variables: tuple[Variable, ...], asked: set[str]) -> None:
    seen: dict[str, str] = {}
    for v in variables:
        if not _NAME.fullmatch(v.name):
            raise InputError(
                f"inputs: the name {short(v.name)} cannot stand in a store; take letters, digits, "
                "spaces and . _ - + : ( ), a letter first"
            )
        if v.name in RESERVED or v.name.removesuffix("_error") in asked:
            raise InputError(
                f"inputs: the name {short(v.name)} is taken by the result; give another name"
            )
        if v.name in seen:
            raise InputError(f"inputs: two of them are called {short(v.name)}; give one a name")
        seen[v.name] = v.key
    keys = [v.key for v in variables if v.weights is None]
    for key in keys:
        if keys.count(key) > 1:
            raise InputError(f"inputs: {key} stands there twice; remove one")


_NAME = re.compile(r"[^\W\d_][\w .+:()\[\]-]*(?<![ .])")
RESERVED = (
    *("case", "mode", "reason", "warned", "track", "chunk", "checksum", "point", "shape"),
    *("tracked_mode", "tracked_mac", "tracked_doubtful", "tracked_frequency_hz", "coordinates"),
    *MODE_OUTPUTS,
    *CASE_OUTPUTS,
)
"""Names that no input can have: those of the result."""
