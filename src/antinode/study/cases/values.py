"""Some cases of a study: the values of its variables, as arrays by the keys of the case."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from antinode.arrays import Array
from antinode.beam.file import BeamFile
from antinode.beam.plausible import doubts_of_many
from antinode.beam.profile import Profile
from antinode.study.design.file import Study
from antinode.study.design.subject import OfBeam, OfVehicle
from antinode.study.design.variables import Variable
from antinode.vehicle.case import Case
from antinode.vehicle.numbers import Keys, replaced, value_at

from .allowed import outside_range

Numbers = dict[Keys, Array]
_STATIONS = ("vehicle", "stations")


@dataclass(frozen=True)
class Cases:
    """Some cases of a study.

    Attributes
    ----------
    study : Study
    variables : sequence of Variable
    values : array, shape (cases, variables)
        In SI.
    """

    study: Study
    variables: Sequence[Variable]
    values: Array

    def __len__(self) -> int:
        return len(self.values)

    @property
    def numbers(self) -> Numbers:
        """What varies, by keys: arrays over cases, columns with a second dimension.

        Columns that no body can have are those of the case itself; `outside` tells where.
        """
        return self._numbers[0]

    @cached_property
    def _numbers(self) -> tuple[Numbers, npt.NDArray[np.bool_]]:
        """Return what varies, and in which cases a column is none that a body can have."""
        given = list(zip(self.variables, self.values.T, strict=True))
        found = {v.keys: self._number(v, x) for v, x in given if v.kind == "number"}
        stations = self.study.subject.stations
        rows = {k: v for k, v in found.items() if k[: len(stations)] == stations}
        whole = self._columns([(v, x) for v, x in given if v.kind == "column"])
        whole = self._with_rows(whole, rows)
        odd = np.zeros(len(self), dtype=bool)
        for keys, columns in whole.items():
            own = self._column(keys)
            wrong = ~np.all(self.study.subject.possible(columns, own), axis=1)
            whole[keys] = np.where(wrong[:, None], own, columns)
            odd |= wrong
        return {**{k: v for k, v in found.items() if k not in rows}, **whole}, odd

    def _number(self, variable: Variable, given: Array) -> Array:
        start = value_at(self.study.subject.tree, variable.keys) if variable.given.factor else None
        return given if start is None else np.asarray(given * start)

    def _column(self, keys: Keys) -> Array:
        return self.study.subject.values(keys)

    def _columns(self, given: Sequence[tuple[Variable, Array]]) -> Numbers:
        """Return the columns times the factors on their control points."""
        logarithms: Numbers = {}
        for variable, factors in given:
            assert variable.weights is not None
            with np.errstate(all="ignore"):
                share = np.log(factors)[:, None] * variable.weights
            logarithms[variable.keys] = logarithms.get(variable.keys, 0.0) + share
        with np.errstate(all="ignore"):
            return {keys: self._column(keys) * np.exp(share) for keys, share in logarithms.items()}

    def _with_rows(self, columns: Numbers, rows: Numbers) -> Numbers:
        """Gather single rows of columns into the columns."""
        found = dict(columns)
        for (*start, row), values in rows.items():
            keys = tuple(start)
            own = self._column(keys)
            whole = found.get(keys, np.broadcast_to(own, (len(self), len(own)))).copy()
            whole[:, int(row)] = values
            found[keys] = whole
        return found

    def case(self, i: int) -> Case:
        """Return one case of a vehicle with its own numbers, unchecked."""
        return case_of(self.study.vehicle_case, self.numbers, i)

    def problem(self, i: int) -> Case | BeamFile:
        """Return one case with its own numbers, unchecked, of a vehicle or of a beam."""
        subject = self.study.subject
        return subject.changed(self.numbers, i) if isinstance(subject, OfBeam) else self.case(i)

    def structure(self, i: int) -> bytes:
        """Return what stands for the body of a case, whatever its loads: equal for equal ones."""
        numbers = (values[i] for keys, values in self.numbers.items() if _is_of_body(keys))
        return b"".join(np.ascontiguousarray(v).tobytes() for v in numbers)

    def doubts(self, mass: Array, strained: npt.NDArray[np.bool_]) -> npt.NDArray[np.bool_]:
        """Tell which bodies, of some mass [kg], are not of this world; `beam.plausible` has why."""
        vehicle = self.study.vehicle_case.vehicle

        def profile(name: str) -> Profile:
            """Return a stiffness of all bodies."""
            rows = self.numbers.get((*_STATIONS, name), getattr(vehicle.stations, name))
            return Profile.of_rows(vehicle.stations.x, rows, vehicle.interpolation)

        with np.errstate(all="ignore"):
            EI, EA = profile("bending_stiffness"), profile("axial_stiffness")
            return doubts_of_many(mass, EI, EA, strained)

    def outside(self) -> npt.NDArray[np.bool_]:
        """Tell in which cases an input is outside the range that the case allows."""
        wrong = self._numbers[1].copy()
        for variable, given in zip(self.variables, self.values.T, strict=True):
            if variable.kind == "column":
                wrong |= ~(given > 0)
            elif variable.kind == "number":
                wrong |= self._outside(variable, self.numbers.get(variable.keys, given))
        return wrong

    def _outside(self, variable: Variable, values: Array) -> npt.NDArray[np.bool_]:
        """Tell which values of a number are outside its range; of a row the beam itself judges."""
        if isinstance(self.study.subject, OfVehicle):
            return outside_range(self.study.vehicle_case, variable.keys, values)
        place = variable.place
        if place is None or place.keys[0] == self.study.subject.stations[0]:
            return np.zeros(len(values), dtype=bool)
        above = values > place.low if place.strict else values >= place.low
        return np.asarray(~(np.isfinite(values) & above & (values <= place.high)))


def _is_of_body(keys: Keys) -> bool:
    """Tell whether mass and stiffness depend on a number."""
    if keys[0] == "vehicle":
        return keys[1] not in ("cavitator", "fins")
    return keys == ("condition", "burn_fraction")


def case_of(case: Case, numbers: Mapping[Keys, Array], i: int) -> Case:
    """Return a case with the numbers of case `i`, unchecked."""
    for keys, values in numbers.items():
        value = values[i]
        case = replaced(case, keys, float(value) if np.ndim(value) == 0 else np.asarray(value))
    return case
