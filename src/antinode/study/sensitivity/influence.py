"""How strongly each input moves each bending frequency: percent of f for each percent of it.

For a vehicle the derivatives of omega^2 come from the mode shapes (`vehicle/effects.py`), on both
sides of the condition. Of a beam each input is moved by a thousandth both ways, and the beam solved
anew. With the frequency f = sqrt(omega^2)/(2 pi)

    (df/f) / (dp/p) = (p / (2 omega^2)) d(omega^2)/dp.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from antinode.arrays import Array
from antinode.beam.attachments import Joint, Pedestal, PointMass, Spring
from antinode.beam.beam import Beam
from antinode.beam.families import BENDING
from antinode.beam.file import BeamFile
from antinode.errors import AntinodeError
from antinode.modes.backends import for_one
from antinode.modes.result import ModalResult
from antinode.modes.solve import solve_one
from antinode.riccati.damped.chain import Damped
from antinode.riccati.damped.slopes import Eigenpairs
from antinode.study.complex_modes import Beside, ComplexModes
from antinode.vehicle.case import Case
from antinode.vehicle.derivatives import ChainModes, EigenvalueDerivatives
from antinode.vehicle.effects import by_logarithm, effect_of_mass, effects_between
from antinode.vehicle.numbers import replaced
from antinode.vehicle.paths import find_place

_STEP = 1e-4  # relative, of what the forces depend on
_BEAM_STEP = 1e-3
_DEGREE = math.radians(1.0)
_KINK = 0.05  # relative difference of the slopes on both sides that is told


class Influence(NamedTuple):
    """What one input does.

    Attributes
    ----------
    name : str
    change : str
        The change that it is for: "1 %", "1 deg".
    percent : array, shape (modes,)
        Change of every bending frequency [%]; NaN where the mode diverges.
    kink : bool
        Whether it differs on the two sides, as where a fin starts to be wetted.
    """

    name: str
    change: str
    percent: Array
    kink: bool = False


def case_influences(case: Case, result: ModalResult, most: int) -> list[Influence]:
    """Return what moves the bending modes 1 ... n of a vehicle, solved before."""
    if result.family(BENDING)[0].eigenvalue is not None:
        return _of_complex(case, result, most)
    omega2 = [mode.omega2 for mode in result.family(BENDING) if mode.number][:most]
    chain = result.solutions[BENDING].chain
    backend = for_one(len(chain.length), len(omega2))
    modes = ChainModes(chain, np.array(omega2), backend, result.beam.shear_form)
    beam = case.without_added_mass.beam() if case.added_masses else result.beam
    sensitivity = EigenvalueDerivatives(modes, beam, case.loads)
    return [*_of_condition(case, sensitivity), *_of_body(case, sensitivity)]


def _of_complex(case: Case, result: ModalResult, most: int) -> list[Influence]:
    """Return the same of complex modes: loads and tangents move with each input, and nothing rests.

    NaN of modes that do not oscillate.
    """
    s = np.array([m.eigenvalue_per_s for m in result.family(BENDING) if m.number][:most])
    chain = result.solutions[BENDING].chain
    modes = ComplexModes(Eigenpairs(Damped(chain), s), _REFINEMENT)

    def percent(low: Case, high: Case, step: float, scale: float) -> Array:
        slope = modes.frequency_slopes([Beside(low.beam(), high.beam(), step)])[:, 0]
        with np.errstate(all="ignore"):
            return np.asarray(slope * scale / modes.frequencies_hz)

    found = []
    for name, key, step, scale, change in _parameters(case):
        value = getattr(case.condition, key)
        keys = ("condition", key)
        try:
            cases = [replaced(case, keys, value + d) for d in (-step, 0.0, step)]
            low, high = (percent(*two, step, scale) for two in pairwise(cases))
        except AntinodeError:
            continue
        gap, size = (float(np.nanmax(np.abs(v), initial=0.0)) for v in (high - low, (low, high)))
        found.append(Influence(name, change, (low + high) / 2, gap > _KINK * size and gap > 0))
    scalings: dict[str, Callable[[float], Case]] = {
        "thrust": lambda f: replaced(case, ("condition", "thrust"), case.condition.thrust * f),
        "mass of the body": lambda f: _with_mass(case, f),
        "bending stiffness EI": lambda f: _with_column(case, "bending_stiffness", f),
    }
    for name, scaled in scalings.items():
        own = percent(scaled(1 - _STEP), scaled(1 + _STEP), 2 * _STEP, 1.0)
        found.append(Influence(name, "1 %", own))
    return found


_REFINEMENT = 4


def _with_column(case: Case, column: str, factor: float) -> Case:
    keys = ("vehicle", "stations", column)
    return replaced(case, keys, np.asarray(getattr(case.vehicle.stations, column)) * factor)


def _with_mass(case: Case, factor: float) -> Case:
    """Return a case all of whose mass is multiplied, parts included."""
    for state, column in case.vehicle.stations.mass_per_length.items():
        keys = ("vehicle", "stations", "mass_per_length", state)
        case = replaced(case, keys, np.asarray(column) * factor)
    masses = tuple(_scaled(part, factor, "mass_per_length") for part in case.vehicle.masses)
    vehicle = case.vehicle.model_copy(update={"masses": masses})
    return case.model_copy(update={"vehicle": vehicle})


def _relative(sensitivity: EigenvalueDerivatives, slope: Array) -> Array:
    """Return percent of f for a slope of omega^2 by one percent, times 100 percent."""
    omega2 = sensitivity.modes.omega2
    return np.asarray(np.where(omega2 > 0, slope / (2 * np.abs(omega2)), np.nan))


def _of_condition(case: Case, sensitivity: EigenvalueDerivatives) -> Iterator[Influence]:
    for name, key, step, scale, change in _parameters(case):
        place = find_place(case, f"condition.{key}")
        value = getattr(case.condition, key)
        try:
            sides = effects_between(case, place, (value - step, value, value + step))
        except AntinodeError:
            continue
        low, high = (side.slope(sensitivity) * scale for side in sides)
        gap, size = (float(np.max(np.abs(v))) for v in (high - low, (low, high)))
        percent = _relative(sensitivity, (low + high) / 2)
        yield Influence(name, change, percent, gap > _KINK * size and gap > 0)


def _parameters(case: Case) -> Iterator[tuple[str, str, float, float, str]]:
    """Yield name, key, step, what the change stands for in units of the key, and the change."""
    c = case.condition
    relative = [("speed V", "speed"), ("cavitation number σ", "cavitation_number")]
    relative += [("depth", "depth")] if c.cavitation_number is None else []
    relative += [("extra drag", "extra_drag")]
    for name, key in relative:
        value = getattr(c, key)
        if value:
            yield name, key, _STEP * value, value, "1 %"
    for name, key in (("cavitator angle", "cavitator_angle"), ("body angle", "body_angle")):
        yield name, key, _STEP * _DEGREE, 100 * _DEGREE, "1 deg"
    if c.fin_position and any(fins.position is None for fins in case.vehicle.fins):
        L = case.vehicle.length
        yield "fin position", "fin_position", _STEP * L, L, "1 % of length"


def _of_body(case: Case, sensitivity: EigenvalueDerivatives) -> Iterator[Influence]:
    loads = case.loads
    yield Influence("thrust", "1 %", _relative(sensitivity, sensitivity.by_thrust * loads.thrust))
    by_mass = effect_of_mass(case).slope(sensitivity)
    yield Influence("mass of the body", "1 %", _relative(sensitivity, by_mass))
    by_EI = by_logarithm(case, ("bending_stiffness",), sensitivity).sum(axis=0)
    yield Influence("bending stiffness EI", "1 %", _relative(sensitivity, by_EI))


# --- any beam --------------------------------------------------------------------------------

Scaled = Callable[[BeamFile, float], Beam]


def beam_influences(file: BeamFile, modes: int, tolerance: float) -> list[Influence]:
    """Return what moves the bending modes 1 ... n of a beam."""
    found = []
    for name, scaled in _scalings(file):
        ends = [_omega2(scaled(file, 1 + s * _BEAM_STEP), modes, tolerance) for s in (-1, 1)]
        mean = (ends[0] + ends[1]) / 2
        slope = (ends[1] - ends[0]) / (2 * _BEAM_STEP)
        percent = np.where(mean > 0, slope / (2 * np.abs(mean)), np.nan)
        found.append(Influence(name, "1 %", percent))
    return found


def _omega2(beam: Beam, modes: int, tolerance: float) -> Array:
    result = solve_one(beam, modes, tolerance=tolerance, families=[BENDING])
    return np.array([result.mode(BENDING, k).omega2 for k in range(1, modes + 1)])


def _scalings(file: BeamFile) -> Iterator[tuple[str, Scaled]]:
    beam = file.beam()
    yield "bending stiffness EI", _stiffer
    yield "mass per length", _heavier
    kinds = {type(item) for item in beam.attachments}
    if PointMass in kinds:
        yield "point masses", _heavier_points
    if any(isinstance(item, Spring) and _finite(item) for item in beam.attachments):
        yield "stiffness of springs", _stiffer_springs
    if Pedestal in kinds:
        yield "masses of pedestals", _heavier_pedestals
        yield "their springs", _stiffer_pedestals
    if Joint in kinds:
        yield "compliance of joints", _softer_joints
    if not beam.is_unloaded:
        yield "axial force N", _more_force


def _stiffer(file: BeamFile, s: float) -> Beam:
    beam = file.beam()
    return replace(beam, bending_stiffness=beam.bending_stiffness * s)


def _more_force(file: BeamFile, s: float) -> Beam:
    beam = file.beam()
    return replace(
        beam,
        axial_force=beam.axial_force * s,
        axial_acceleration=beam.axial_acceleration * s,
    )


def _heavier(file: BeamFile, s: float) -> Beam:
    """Return the beam with more mass per length; its weight, where there is any, goes along."""
    table = file.table
    if table.material is not None:
        return _with_table(
            file,
            material=_scaled(table.material, s, "density"),
            masses=tuple(_scaled(part, s, "mass_per_length") for part in table.masses),
        )
    stations = _scaled(table.stations, s, "mass_per_length")
    parts = tuple(_scaled(part, s, "mass_per_length") for part in table.masses)
    return _with_table(file, stations=stations, masses=parts)


def _heavier_points(file: BeamFile, s: float) -> Beam:
    masses = tuple(_scaled(m, s, "mass", "rotary_inertia") for m in file.table.point_masses)
    return _with_table(file, point_masses=masses)


def _stiffer_springs(file: BeamFile, s: float) -> Beam:
    names = ("translational", "rotational", "axial")
    return _with_table(file, springs=tuple(_scaled(k, s, *names) for k in file.table.springs))


def _heavier_pedestals(file: BeamFile, s: float) -> Beam:
    return _with_table(file, pedestals=tuple(_scaled(p, s, "mass") for p in file.table.pedestals))


def _stiffer_pedestals(file: BeamFile, s: float) -> Beam:
    names = "beam_stiffness", "ground_stiffness"
    return _with_table(file, pedestals=tuple(_scaled(p, s, *names) for p in file.table.pedestals))


def _softer_joints(file: BeamFile, s: float) -> Beam:
    names = ("rotational", "axial")
    return _with_table(file, joints=tuple(_scaled(j, s, *names) for j in file.table.joints))


def _scaled(inputs: Any, s: float, *names: str) -> Any:
    return inputs.model_copy(update={name: getattr(inputs, name) * s for name in names})


def _with_table(file: BeamFile, **changed: Any) -> Beam:
    table = file.table.model_copy(update=changed)
    return file.model_copy(update={"table": table}).beam()


def _finite(spring: Spring) -> bool:
    values = (spring.translational, spring.rotational)
    return any(value and math.isfinite(value) for value in values)
