"""One chunk of a study: from the values of its inputs to the numbers that are kept.

A chunk is computed by itself, from nothing but the study and its number, and always by the compiled
kernel: warm starts do not cross its bounds. So every executor gets the same numbers, to the last
bit, whatever its process did before.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from antinode.arrays import Array, Integers
from antinode.beam.file import BeamFile
from antinode.study.design.file import MARGIN_OUTPUTS, Study
from antinode.study.design.points import Points
from antinode.vehicle.refusals import OUT_OF_RANGE

from .beams import CaseBeams, beams_of
from .bending import IN_BATCHES, Eigenvalues, solve_bending
from .bodies import solve_bodies
from .reasons import failed
from .shear import model_errors
from .single import Motion
from .structures import BeamAnswers, solve_structures
from .values import Cases
from .warned import type_of_bits, warned
from .water import solve_in_water

Arrays = dict[str, npt.NDArray[Any]]


def mode_names(study: Study) -> list[str]:
    """Return the names of the modes, family by family."""
    return [f"{f} {k}" for f in study.solve.families for k in range(1, study.solve.modes + 1)]


def number_names(study: Study) -> list[str]:
    """Return the names of what the response of each case comes to, each with its error."""
    return [name for one in study.asked for name in (one.name, f"{one.name}_error")]


def compute_chunk(points: Points, chunk: int) -> Arrays:
    """Compute a chunk: arrays over its cases, by the names of the variables of the result."""
    return solve_values(points, points.values(chunk))


def solve_values(points: Points, values: Array) -> Arrays:
    """Compute the same of any cases, by the values of their inputs, (cases, inputs)."""
    study = points.study
    cases = Cases(study, points.variables, values)
    size = study.tracking.points if points.tracked else 0
    solve = _of_beams if isinstance(study.case, BeamFile) else _of_vehicles
    reason, bits, shapes, every = solve(cases, size)
    out: Arrays = {v.name: cases.values[:, k] for k, v in enumerate(points.variables)}
    out["reason"] = reason.astype(np.int16)
    out["warned"] = bits.astype(type_of_bits(study))
    if any(name in MARGIN_OUTPUTS for name in study.outputs):
        from .margins import margins

        every |= margins(cases, reason)
    if study.response is not None:
        from .responses import responses

        numbers, told = responses(cases, reason)
        every |= numbers
        out["warned"] |= told.astype(type_of_bits(study))
    out |= {name: every[name] for name in (*study.outputs, *number_names(study))}
    if points.tracked:
        out["shape"] = shapes
    return out


_Solved = tuple[Integers, Integers, Array, dict[str, Array]]
"""Reasons, bits of warnings, shapes, and all outputs by their names."""


def _of_vehicles(cases: Cases, size: int) -> _Solved:
    beams = beams_of(cases)
    if cases.study.vehicle_case.model.water_answers:
        return _in_water(cases, beams, size)
    found, shear = _every_family(cases, beams, size)
    doubts = np.concatenate([cases.doubts(beams.scalars["mass"], beams.strained), beams.doubts])
    bits = warned(found, shear, doubts)
    loaded = found.reason < OUT_OF_RANGE
    scalars = {name: np.where(loaded, values, np.nan) for name, values in beams.scalars.items()}
    every = scalars | _of_modes(found)
    every |= {"model_error": shear, "effect_of_shear": found.effect_of_shear}
    every["proven"] = np.where(failed(found.reason), np.nan, 1.0)
    return found.reason, bits, found.shapes, every


def _in_water(cases: Cases, beams: CaseBeams, size: int) -> _Solved:
    found = solve_in_water(cases, beams, size)
    return found.reason, found.warned, found.shapes, _all_outputs(found) | dict(beams.scalars)


def _all_outputs(found: BeamAnswers) -> dict[str, Array]:
    return found.of_modes | {"mass": found.mass, "proven": found.proven}


def _of_beams(cases: Cases, size: int) -> _Solved:
    found = solve_structures(cases, size)
    return found.reason, found.warned, found.shapes, _all_outputs(found)


def _every_family(cases: Cases, beams: CaseBeams, points: int) -> tuple[Eigenvalues, Array]:
    """Return the eigenvalues of all families side by side, and what shear would do to them.

    NaN in cases that failed.
    """
    families: list[Eigenvalues] = []
    for family in cases.study.solve.families:
        if family in IN_BATCHES:
            families.append(solve_bending(cases.study, beams, points))
        else:
            families.append(solve_bodies(cases, beams, points, family))
    reason = np.max([f.reason for f in families], axis=0)
    omega2, error, shapes, effect, growth = (
        np.concatenate([getattr(f, name) for f in families], axis=1)
        for name in ("omega2", "error", "shapes", "effect_of_shear", "growth_rate_per_s")
    )
    names = cases.study.solve.families
    shear = [model_errors(cases, beams, *each) for each in zip(names, families, strict=True)]
    bad = failed(reason)
    omega2[bad], error[bad], effect[bad], growth[bad] = np.nan, np.nan, np.nan, np.nan
    force = np.sum([f.net_force for f in families], axis=0)
    lowest = np.any([f.lowest_diverges for f in families], axis=0)
    found = Eigenvalues(omega2, error, reason, shapes, force, lowest, effect, growth)
    return found, np.where(bad[:, None], np.nan, np.concatenate(shear, axis=1))


def _of_modes(found: Eigenvalues) -> dict[str, Array]:
    """Return the outputs that have one number a mode."""
    motion = Motion.of_squares(found.omega2, found.error, found.growth_rate_per_s)
    return {"omega2": found.omega2, **motion._asdict()}
