"""Derivatives of frequencies at the case itself, by every input of a study.

Of beams by differences; of vehicles from the mode shapes, and on the water's stiffness from left
and right eigenvectors, with loads and tangents by the chain rule.
"""

from __future__ import annotations

import math

import numpy as np

from antinode.arrays import Array
from antinode.beam.families import FamilyName
from antinode.beam.file import BeamFile
from antinode.errors import AntinodeError
from antinode.modes.hertz import hertz
from antinode.study.cases.chunks import mode_names
from antinode.study.cases.values import Cases
from antinode.study.complex_modes import STEP, Beside, ComplexModes
from antinode.study.design.file import Study
from antinode.study.design.points import Points
from antinode.study.design.variables import Variable
from antinode.study.eigenvalues import eigenvalues_of, sufficient_refinement
from antinode.vehicle.case import Case
from antinode.vehicle.derivatives import EigenvalueDerivatives
from antinode.vehicle.effects import by_logarithm, effect_of_number, effect_of_radius
from antinode.vehicle.numbers import value_at

from .beam_slopes import beam_slopes


def starts_of(points: Points) -> Array:
    """Return the inputs at the case itself."""
    return np.array([np.nan if v.start is None else v.start for v in points.variables])


def local_slopes(study: Study, points: Points) -> dict[str, tuple[float, Array]]:
    """Return frequency [Hz] and its derivatives by the inputs, at the case, of every mode."""
    if isinstance(study.case, BeamFile):
        return beam_slopes(points)
    return _vehicle_slopes(study, study.vehicle_case, points)


def _vehicle_slopes(study: Study, case: Case, points: Points) -> dict[str, tuple[float, Array]]:
    """Return the same of a vehicle.

    The derivatives come from the mode shapes, and from the loads by the chain rule.
    """
    wanted: dict[FamilyName, int] = dict.fromkeys(study.solve.families, study.solve.modes)
    found: dict[str, tuple[float, Array]] = {}
    try:
        refinement = sufficient_refinement(case, wanted, 1e-9)
        (solved,) = eigenvalues_of([case], [wanted], refinement)
    except AntinodeError:
        nothing = np.full(len(points.variables), np.nan)
        return dict.fromkeys(mode_names(study), (np.nan, nothing))
    for family, number in wanted.items():
        modes = solved.modes[family]
        if isinstance(modes, ComplexModes):
            by_input = modes.frequency_slopes(beside_inputs(points))
            hz = np.where(modes.s.imag > 0, modes.frequencies_hz, np.nan)
            for k in range(number):
                found[f"{family} {k + 1}"] = float(hz[k]), by_input[k]
            continue
        omega2 = modes.omega2
        exact = solved.sensitivity(family)
        by_input = np.stack([_by_input(case, exact, v) for v in points.variables], axis=1)
        for k in range(number):
            with np.errstate(all="ignore"):
                own = hertz(float(omega2[k]))
                found[f"{family} {k + 1}"] = own, by_input[k] / (8 * np.pi**2 * own)
    return found


def beside_inputs(points: Points) -> list[Beside | None]:
    """Return the beams of the case on both sides of each input; None by one without a value."""
    start = starts_of(points)
    centre = np.where(np.isfinite(start), start, 0.0)
    found: list[Beside | None] = []
    for k, variable in enumerate(points.variables):
        place = variable.place
        low, high = (-math.inf, math.inf) if place is None else (place.low, place.high)
        if variable.given.factor:
            low, high = -math.inf, math.inf
        width = high - low
        step = STEP * (abs(centre[k]) or (width / 4 if math.isfinite(width) else 1.0))
        ends = np.array([max(centre[k] - step, low), min(centre[k] + step, high)])
        values = np.tile(centre, (2, 1))
        values[:, k] = ends
        cases = Cases(points.study, points.variables, values)
        try:
            sides = [cases.problem(i).beam() for i in range(2)] if np.isfinite(start[k]) else []
        except AntinodeError:
            sides = []
        found.append(Beside(sides[0], sides[1], float(np.ptp(ends))) if sides else None)
    return found


def _by_input(case: Case, sensitivity: EigenvalueDerivatives, variable: Variable) -> Array:
    """Return d(omega^2) of every mode of a family by an input."""
    try:
        return _slope(case, sensitivity, variable)
    except AntinodeError:
        return np.full(len(sensitivity.modes.omega2), np.nan)


def _slope(case: Case, sensitivity: EigenvalueDerivatives, variable: Variable) -> Array:
    if variable.weights is not None:  # of a factor on a column, which is 1 here
        if variable.keys[-1] == "radius":
            return effect_of_radius(case, variable.weights).slope(sensitivity)
        by_row = by_logarithm(case, variable.keys[2:], sensitivity)
        return np.asarray(variable.weights @ by_row)
    value = None if variable.place is None else value_at(case, variable.keys)
    if variable.place is None or value is None:
        return np.full(len(sensitivity.modes.omega2), np.nan)
    slope = effect_of_number(case, variable.place).slope(sensitivity)
    return slope * value if variable.given.factor else slope
