"""Readings of the paper that were tried: python -m validation.paper_readings

The same identification as validation/paper_vehicle.py, with one reading changed at a time, from the
vehicle that was shipped and from the smooth start; the better fit counts. Rows that are held
out are not fitted. Prints a table for docs/paper.md.
"""

from __future__ import annotations

import sys
from typing import NamedTuple

import numpy as np

import antinode as an
from antinode.paper.comparison import example, size_of
from validation.paper_vehicle import THRUST, lines, problem, start, start_stations, with_stations

FIT = {"max_evaluations": 120, "tolerance": 1e-5, "tries": 1}
FACTOR = {"key": "model.planing_drag_factor", "prior": {"sd": 0.5}}


class Reading(NamedTuple):
    name: str
    model: dict | None = None
    thrust: float = THRUST
    parameters: tuple = ()
    vehicle: dict | None = None
    elements: int = 40


READINGS = (
    Reading("as shipped"),
    Reading("N exact, not constant in elements", {"axial_force": "exact"}),
    Reading("elements of 0.6 m", elements=10),
    Reading("elements of 0.5 m", elements=12),
    Reading("elements of 0.3 m", elements=20),
    Reading("rise over the whole cavity length", {"gravity_rise_length": "cavity"}),
    Reading("rise over the body length", {"gravity_rise_length": "body"}),
    Reading("rise over the cavitator's diameter", {"gravity_rise_length": "cavitator"}),
    Reading("rise by buoyancy", {"gravity_rise": "buoyancy"}),
    Reading("no rise", {"gravity_rise": "none"}),
    Reading("no distortion", {"distortion": "none"}),
    Reading("fins upright: 0, 90, 180, 270 deg", vehicle={"roll": 0.0}),
    Reading("fin immersion as the tip's distance", {"fin_immersion": "tip_distance"}),
    Reading("planing at the centroid", {"planing_position": "centroid"}),
    Reading("wetted arc, planing at the tail", {"planing_area": "arc"}),
    Reading(
        "wetted arc, planing at the centroid",
        {"planing_area": "arc", "planing_position": "centroid"},
    ),
    Reading(
        "the same with a fitted factor on the planing drag",
        {"planing_area": "arc", "planing_position": "centroid", "planing_drag_factor": 0.6},
        parameters=(FACTOR,),
    ),
    Reading("no planing", {"planing": "none"}),
    Reading("thrust 45 kN in Tables 1 to 4", thrust=45e3),
    Reading("thrust 55 kN in Tables 1 to 4", thrust=55e3),
    Reading("fin tips at 0.35 m", vehicle={"tip": 0.35}),
    Reading("fin tips at 0.45 m", vehicle={"tip": 0.45}),
    Reading("fin tips at 0.60 m", vehicle={"tip": 0.60}),
)


def changed(case, reading):
    """The case with one reading changed."""
    model = type(case.model)(**{**dict(case.model), **(reading.model or {})})
    fins, other = case.vehicle.fins[0], reading.vehicle or {}
    if "tip" in other:
        span = fins.tip_radius - 0.24  # outside the cavity at sigma = 0.02
        thickness = fins.thickness * span / (other["tip"] - 0.24)
        update = {"tip_radius": other["tip"], "thickness": thickness}
        fins = fins.model_copy(update=update)
    if "roll" in other:
        fins = fins.model_copy(update={"roll_angles": tuple(np.arange(4) * np.pi / 2)})
    vehicle = case.vehicle.model_copy(update={"fins": (fins,)})
    return case.model_copy(update={"model": model, "vehicle": vehicle})


def starts(reading):
    if reading.elements == 40:
        yield changed(an.load_case(example()), reading)
    yield changed(with_stations(start(), start_stations(reading.elements)), reading)


def judge(reading):
    best = None
    for case in starts(reading):
        result = an.identify(problem(case, reading.thrust, reading.parameters, FIT))
        if best is None or result.rms_relative < best.rms_relative:
            best = result
        print(f"  {reading.name}: rms {result.rms_relative:.2e}", file=sys.stderr, flush=True)
    found = list(lines(best.case, reading.thrust))
    return best, size_of(found), size_of([line for line in found if line.row.held_out])


def factor_of(result):
    found = [p for p in result.parameters if "planing_drag_factor" in p.name]
    return f" ({found[0].value:.2f})" if found else ""


if __name__ == "__main__":
    print("# Readings tried\n\n`python -m validation.paper_readings`\n")
    print("| reading changed | all rows: worst | rms | held out: worst |\n|---|---|---|---|")
    for reading in READINGS:
        result, whole, held = judge(reading)
        name = reading.name + factor_of(result)
        print(f"| {name} | {whole.worst:.1e} | {whole.rms:.1e} | {held.worst:.1e} |", flush=True)
