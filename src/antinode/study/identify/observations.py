"""Observations as numbers: conditions, frequencies, standard deviations, and how modes pair.

A frequency belongs to the mode of its family and number. Where a shape was observed with it, it
belongs to the mode whose shape is most like it, by ``MAC = (u . v)^2 / (u^2 v^2)``.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from antinode.arrays import Array, Integers
from antinode.beam.families import FAMILIES, FamilyName
from antinode.beam.file import BeamFile
from antinode.beam.limits import check_limits
from antinode.errors import AntinodeError, InputError
from antinode.inputs.explain import validate
from antinode.inputs.places import Keys
from antinode.inputs.units import to_si
from antinode.study.complex_modes import ComplexModes
from antinode.study.design.subject import Changed, Given, subject_of, with_value
from antinode.text import nearest, short
from antinode.vehicle.case import Case
from antinode.vehicle.condition import OperatingCondition
from antinode.vehicle.derivatives import ChainModes

from .file import Fit, IdentificationProblem, RowBase, ShapeRow, parameters_of

RELATIVE_SD = 1e-3
"""Taken to weigh frequencies where no standard deviation is given; the noise is then estimated."""
_FURTHER = 2  # modes above the highest observed one among which a shape may be found


@dataclass(frozen=True)
class FamilyData:
    """What was observed of one family in one row.

    Attributes
    ----------
    numbers : array of int, shape (n,)
        Numbers of the modes, from 1.
    hz, sd : array, shape (n,)
        Frequencies and what their residuals are divided by [Hz].
    shapes : dict
        Observed shapes by position in `numbers`.
    """

    numbers: Integers
    hz: Array
    sd: Array
    shapes: Mapping[int, ShapeRow]

    @property
    def wanted(self) -> int:
        """How many modes must be computed."""
        return int(self.numbers.max()) + (_FURTHER if self.shapes else 0)


@dataclass(frozen=True)
class RowData:
    """One row.

    Attributes
    ----------
    label : str
    numbers : dict
        What it sets of the condition, and of all else, SI, by keys.
    families : dict
        `FamilyData` by family.
    """

    label: str
    numbers: Mapping[Keys, float]
    families: Mapping[FamilyName, FamilyData]

    @property
    def wanted(self) -> dict[FamilyName, int]:
        """How many modes of each family must be computed."""
        return {family: data.wanted for family, data in self.families.items()}

    def condition(self, base: Changed) -> Changed:
        """Return a case in the row's condition."""
        for keys, value in self.numbers.items():
            base = with_value(base, keys, value)
        return base


def gather(problem: IdentificationProblem) -> tuple[RowData, ...]:
    """Turn the rows of a problem into numbers.

    Raises
    ------
    InputError
        If a row holds no frequency, repeats another one, or is no condition.
    """
    rows = [_row(problem, row, k) for k, row in enumerate(problem.observations, 1)]
    _check_duplicates(problem.case, rows)
    return tuple(rows)


def noise_is_known(problem: IdentificationProblem) -> bool:
    """Tell whether every frequency has a standard deviation of its own."""
    fit = problem.fit
    whole = fit.sd is not None or fit.relative_sd is not None
    return whole or all(
        row.sd is not None or row.relative_sd is not None for row in problem.observations
    )


def _row(problem: IdentificationProblem, row: RowBase, number: int) -> RowData:
    label = row.name or f"row {number}"
    where = f"observations, row {number}"
    numbers = _condition(problem.case, row, where) | _inputs(problem.case, row, where)
    families: dict[FamilyName, FamilyData] = {}
    for family in FAMILIES:
        found = _family(row, family, problem.fit, where)
        if found is not None:
            families[family] = found
    if not families:
        say = "give at least one, e.g. bending = [3.2, 10.5]"
        raise InputError(f"{where} ({label}) has no frequency; {say}")
    return RowData(label, numbers, families)


def _condition(case: Given, row: RowBase, where: str) -> dict[Keys, float]:
    """Return what a row sets of the condition."""
    settings = row.settings()
    if isinstance(case, BeamFile):
        if settings or row.mass_state is not None:
            name = next(iter(settings), "mass_state")
            say = "name what was otherwise by its path: inputs = { 'point_masses.0.mass' = '2 kg' }"
            raise InputError(f"{where}: {name}: a beam has no operating condition; {say}")
        return {}
    settings |= _mass_state(case, row, where)
    validate(OperatingCondition, case.condition.model_dump() | settings, where)
    return {("condition", key): value for key, value in settings.items()}


def _inputs(case: Given, row: RowBase, where: str) -> dict[Keys, float]:
    """Return what a row sets by path."""
    found: dict[Keys, float] = {}
    for path, quantity in row.inputs.items():
        try:
            place = parameters_of(case).place(path)
            value = to_si(quantity, place.unit)
        except (InputError, ValueError) as error:
            told = str(error).partition(": ")[2] if isinstance(error, InputError) else error
            raise InputError(f"{where}: inputs, {short(path)}: {told}") from error
        low, high = place.low, place.high
        if not (low < value if place.strict else low <= value) or not value <= high:
            raise InputError(
                f"{where}: {path} is {value:g}; {low:g} to {high:g} is allowed: correct it"
            )
        found[place.keys] = value
    return found


def _mass_state(case: Case, row: RowBase, where: str) -> dict[str, float]:
    if row.mass_state is None:
        return {}
    states = list(case.vehicle.stations.mass_per_length)
    if row.mass_state not in states:
        say = nearest(row.mass_state, states)
        raise InputError(f"{where}: there is no mass_state '{row.mass_state[:40]}'; {say}")
    if "burn_fraction" in row.settings():
        raise InputError(f"{where}: mass_state and burn_fraction contradict: give one of them")
    return {"burn_fraction": states.index(row.mass_state) / max(len(states) - 1, 1)}


def _family(row: RowBase, family: FamilyName, fit: Fit, where: str) -> FamilyData | None:
    given: Sequence[float | None] = getattr(row, family)
    numbers = [k for k, hz in enumerate(given, 1) if hz is not None]
    shapes = {}
    for shape in row.shapes:
        if shape.family != family:
            continue
        if shape.number not in numbers:
            say = f"give its frequency as entry {shape.number} of {family}"
            raise InputError(f"{where}: shape of {family} {shape.number} has no frequency; {say}")
        if numbers.index(shape.number) in shapes:
            raise InputError(f"{where}: {family} {shape.number} has two shapes; remove one")
        shapes[numbers.index(shape.number)] = shape
    if not numbers:
        return None
    hz = np.array([given[k - 1] for k in numbers], dtype=float)
    return FamilyData(np.array(numbers), hz, _deviation(row, fit, hz) / row.weight, shapes)


def _deviation(row: RowBase, fit: Fit, hz: Array) -> Array:
    """Return the standard deviations of a row: its own, those of all, or one for the weights."""
    for source in (row, fit):
        parts = [np.full(len(hz), source.sd or 0.0), (source.relative_sd or 0.0) * hz]
        if source.sd is not None or source.relative_sd is not None:
            return np.asarray(np.hypot(*parts))
    return RELATIVE_SD * hz


def _check_duplicates(case: Given, rows: Sequence[RowData]) -> None:
    seen: dict[str, int] = {}
    own = {} if isinstance(case, BeamFile) else case.condition.model_dump()
    for number, row in enumerate(rows, 1):
        set_here = {".".join(map(str, keys)): value for keys, value in row.numbers.items()}
        condition = {f"condition.{key}": value for key, value in own.items()} | set_here
        for family, data in row.families.items():
            for mode in data.numbers.tolist():
                key = json.dumps([sorted(condition.items()), family, mode])
                if key in seen:
                    say = "remove one of them, or their mean in one row"
                    wrong = f"observations: row {number} repeats {family} {mode} of row {seen[key]}"
                    raise InputError(f"{wrong} in the same condition; {say}")
                seen[key] = number


@dataclass(frozen=True)
class Pairing:
    """Which computed modes the observed ones belong to.

    Attributes
    ----------
    index : array of int, shape (n,)
        Position among the computed modes, from 0.
    mac : array, shape (n,)
        Likeness of observed and computed shapes; NaN where no shape was observed.
    """

    index: Integers
    mac: Array


def pair(data: FamilyData, modes: ChainModes | ComplexModes) -> Pairing:
    """Pair the observed modes of a row with computed ones."""
    index, mac = data.numbers - 1, np.full(len(data.numbers), np.nan)
    if not data.shapes:
        return Pairing(index, mac)
    from scipy.optimize import linear_sum_assignment

    table = {k: _likeness(shape, modes) for k, shape in data.shapes.items()}
    taken = [int(i) for k, i in enumerate(index) if k not in table]
    free = np.setdiff1d(np.arange(len(modes.omega2)), taken)
    rows = sorted(table)
    likeness = np.array([table[k][free] for k in rows])
    chosen, column = linear_sum_assignment(-likeness)
    index = index.copy()
    for i, j in zip(chosen, column, strict=True):
        index[rows[i]], mac[rows[i]] = free[j], likeness[i, j]
    return Pairing(index, mac)


def _likeness(shape: ShapeRow, modes: ChainModes | ComplexModes) -> Array:
    """Return the MAC of an observed shape with every computed mode, 0 of what only decays."""
    u, v = np.array(shape.displacement), modes.displacement(np.array(shape.x))
    likeness = np.abs(u @ v) ** 2 / ((u @ u) * np.sum(np.abs(v) ** 2, axis=0))
    rests = isinstance(modes, ComplexModes) and modes.s.imag == 0.0
    return np.asarray(np.where(rests, 0.0, likeness))


def check_start(rows: Sequence[RowData], cases: Sequence[Given]) -> None:
    """Raise InputError, naming the row, if a row has no loads or no beam at the start."""
    for number, case in enumerate(cases, 1):
        try:
            check_limits(case.beam())
        except AntinodeError as error:
            raise type(error)(f"observations, row {number}: {error}") from error
    for number, (row, case) in enumerate(zip(rows, cases, strict=True), 1):
        start, end = subject_of(case).x[[0, -1]].tolist()
        for data in row.families.values():
            for shape in data.shapes.values():
                if not start <= min(shape.x) <= max(shape.x) <= end:
                    say = f"must lie on the body, within {start:g} and {end:g} m"
                    raise InputError(f"observations, row {number}: x of a shape {say}")
