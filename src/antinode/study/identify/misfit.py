"""Residuals of an identification and their derivatives, row by row.

A residual is (f - f_observed) / standard deviation. Its derivatives follow from those of omega^2 by
every number and column of a case that may change (`effects.py`); of complex modes from left and
right eigenvectors (`riccati/damped/slopes.py`). Those of a beam, whose springs, places and
dimensions may change too, are differences.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from antinode.arrays import Array
from antinode.beam.families import FamilyName
from antinode.errors import AntinodeError, ComputationError, InputError
from antinode.modes.hertz import signed_hertz_slope
from antinode.study.complex_modes import STEP, Beside, ComplexModes
from antinode.study.design.subject import Given
from antinode.study.differences import rule
from antinode.study.eigenvalues import CaseEigenvalues, eigenvalues_of
from antinode.vehicle.case import Case
from antinode.vehicle.derivatives import EigenvalueDerivatives
from antinode.vehicle.effects import Effect, by_logarithm, effect_of_number, effect_of_radius

from .observations import Pairing, RowData, pair
from .unknowns import Unknowns


@dataclass(frozen=True)
class Evaluation:
    """The model at one vector.

    Attributes
    ----------
    vector : array
    solved : tuple of CaseEigenvalues
        By row.
    pairings : tuple of dict
        By row and family.
    """

    vector: Array
    solved: tuple[CaseEigenvalues, ...]
    pairings: tuple[Mapping[FamilyName, Pairing], ...]

    def fitted_hz(self, row: int, family: FamilyName) -> Array:
        """Return the frequencies that stand against the observed ones [Hz]."""
        return self.solved[row].frequencies_hz(family)[self.pairings[row][family].index]


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

    def cases(self, vector: Array) -> Sequence[Given]:
        """Return the case of every row."""
        return [self._case(vector, k) for k in range(len(self.rows))]

    def _case(self, vector: Array, row: int) -> Given:
        """Return the case of one row."""
        shared = self.unknowns.apply(self.unknowns.case, vector)
        return self.unknowns.apply_row(self.rows[row].condition(shared), vector, row)

    def evaluate(self, vector: Array) -> Evaluation:
        """Compute all rows.

        Raises
        ------
        AntinodeError
            If a row cannot be computed.
        """
        wanted, cases = [row.wanted for row in self.rows], self.cases(vector)
        solved = eigenvalues_of(cases, wanted, self.refinement)
        pairings = tuple(
            {family: pair(data, one.modes[family]) for family, data in row.families.items()}
            for row, one in zip(self.rows, solved, strict=True)
        )
        found = Evaluation(vector, solved, pairings)
        self._check_oscillation(found)
        return found

    def _check_oscillation(self, at: Evaluation) -> None:
        """Refuse an observed frequency of a complex mode that has none."""
        for k, row in enumerate(self.rows):
            for family, data in row.families.items():
                if not isinstance(at.solved[k].modes[family], ComplexModes):
                    continue
                rests = np.flatnonzero(at.fitted_hz(k, family) == 0.0)
                if len(rests):
                    raise InputError(
                        f"observations, row {k + 1}: {family} {data.numbers[rests[0]]} does not "
                        "oscillate on the water's stiffness, so it has no frequency: number the "
                        "observed modes as 'antinode modes' lists them (null for those that were "
                        "not observed), or give their shapes"
                    )

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
        if not isinstance(self.unknowns.case, Case):
            return self._by_differences(at)
        slopes = self.unknowns.slopes(at.vector)
        blocks = []
        for k, row in enumerate(self.rows):
            derivative = RowDerivative(self.unknowns, k, at.solved[k], slopes)
            for family, data in row.families.items():
                index, modes = at.pairings[k][family].index, at.solved[k].modes[family]
                if isinstance(modes, ComplexModes):
                    block = modes.frequency_slopes(self._beside(at.vector, k))[index]
                    blocks.append(block / data.sd[:, None])
                    continue
                block = derivative.by_vector(family)[index]
                slope = signed_hertz_slope(modes.omega2[index]) / data.sd
                blocks.append(block * slope[:, None])
        return np.concatenate(blocks)

    def _beside(self, vector: Array, row: int) -> list[Beside]:
        """Return the beams of a row on both sides of each entry of the vector."""
        low, high = self.unknowns.bounds
        found = []
        for k, (entry, item) in enumerate(zip(vector, self.unknowns.items, strict=True)):
            step = STEP / item.size if item.log else STEP * max(abs(float(entry)), 1.0)
            ends = max(entry - step, low[k]), min(entry + step, high[k])
            sides = [self._case(_replaced(vector, k, end), row).beam() for end in ends]
            found.append(Beside(sides[0], sides[1], float(ends[1] - ends[0])))
        return found

    def _by_differences(self, at: Evaluation) -> Array:
        """Return the derivatives of the residuals as differences; paired modes keep their place."""
        columns, here = [], self.residuals(at)
        low, high = self.unknowns.bounds
        for k, (entry, item) in enumerate(zip(at.vector, self.unknowns.items, strict=True)):
            size = 1.0 if item.log else min(abs(float(entry)), 1.0) or 1.0
            places, weights = rule(size, float(entry - low[k]), float(high[k] - entry))
            moved = [self._moved(at, k, place) for place in places.tolist()]
            columns.append(weights @ np.stack([*moved, here]))
        return np.stack(columns, axis=1)

    def _moved(self, at: Evaluation, entry: int, distance: float) -> Array:
        vector = _replaced(at.vector, entry, float(at.vector[entry]) + distance)
        try:
            return self.residuals(replace(self.evaluate(vector), pairings=at.pairings))
        except AntinodeError as error:
            label = self.unknowns.items[entry].label
            raise ComputationError(
                f"the derivatives by {label} cannot be had: {error}; give it bounds further off"
            ) from error


@dataclass(frozen=True)
class RowDerivative:
    """Derivatives of omega^2 of one row by the vector."""

    unknowns: Unknowns
    row: int
    solved: CaseEigenvalues
    slopes: Array

    @property
    def case(self) -> Case:
        """The case of the row."""
        assert isinstance(self.solved.case, Case)
        return self.solved.case

    def by_vector(self, family: FamilyName) -> Array:
        """Return the derivatives of omega^2 1 ... n of a family, shape (n, entries)."""
        sensitivity = self.solved.sensitivity(family)
        total = np.zeros((len(self.solved.modes[family].omega2), len(self.unknowns.items)))
        by_column = self._by_logarithms(sensitivity)
        for item in self.unknowns.columns:
            sizes = np.array([u.size for u in self.unknowns.items[item.entries]])
            if item.column.key in by_column:
                total[:, item.entries] = by_column[item.column.key].T @ item.column.weights * sizes
        for entry, by_entry, effect in self._effects:
            total[:, entry] += by_entry * effect.slope(sensitivity)
        return total

    def _by_logarithms(self, sensitivity: EigenvalueDerivatives) -> dict[str, Array]:
        """Return derivatives by the logarithms of columns, those relative to them included."""
        found: dict[str, Array] = {}
        for item in reversed(self.unknowns.columns):
            key, parent = item.column.key, item.column.parent
            if key == "radius":
                continue
            own = by_logarithm(self.case, item.column.keys, sensitivity)
            found[key] = found.get(key, 0.0) + own
            if parent is not None:
                found[parent] = found.get(parent, 0.0) + found[key]
        return found

    @cached_property
    def _effects(self) -> list[tuple[int, float, Effect]]:
        """Entries of the vector, what each changes, and how fast that goes with the entry."""
        items = self.unknowns.items
        found = []
        for scalar in self.unknowns.scalars:
            k = scalar.entry(self.row)
            effect = effect_of_number(self.case, scalar.place, items[k].size)
            found.append((k, float(self.slopes[k]), effect))
        for item in self.unknowns.columns:
            if item.column.key == "radius":
                first = item.entries.start
                found += [
                    (k, items[k].size, effect_of_radius(self.case, weights))
                    for k, weights in enumerate(item.column.weights.T, first)
                ]
        return found


def _replaced(vector: Array, entry: int, value: float) -> Array:
    """Return a vector with another entry."""
    moved = vector.copy()
    moved[entry] = value
    return moved


def try_evaluate(misfit: Misfit, vector: Array) -> Evaluation | None:
    """Return the model at a vector, or None where it cannot be computed."""
    try:
        return misfit.evaluate(vector)
    except (AntinodeError, ArithmeticError):
        return None
