"""The body in three dimensions, bending in one of its modes."""

from __future__ import annotations

from typing import Any

import numpy as np

from antinode.beam.families import FAMILIES, FamilyName
from antinode.modes.hertz import hertz
from antinode.modes.result import null

from .compute import Answer
from .panels.numbers import short_list
from .quick import QUICK_FAMILY

_RINGS = 61
_SLENDER = 0.015  # radius over length of a beam whose radius nobody knows


_WAYS = {0: "along", 3: "about"}
"""How a body moves by the first freedom of a family; across its axis in all others."""


def body_data(answer: Answer, number: int, family: FamilyName = QUICK_FAMILY) -> dict[str, Any]:
    """Return rings of the body and the shape of a mode at them, over the length.

    Parameters
    ----------
    answer : Answer
    number : int
        Of the mode; the last one where there are fewer.
    family : str
        Bending, while the full result of another one is not there.
    """
    beam = answer.beam
    modes = [m for m in answer.full.family(family) if m.number] if answer.full else []
    other = family != QUICK_FAMILY and bool(modes)
    k = min(number, len(modes) if other else len(answer.quick.omega2)) - 1
    places, Y, omega2 = (
        (answer.full.x, modes[k].states[:, 0], modes[k].omega2)
        if other and answer.full
        else (answer.quick.x, answer.quick.states[:, k, 0], float(answer.quick.omega2[k]))
    )
    x = np.linspace(beam.x[0], beam.x[-1], _RINGS)
    shape = np.interp(x, places, Y)
    return {
        "x": short_list((x - beam.x[0]) / beam.length),
        "radius": short_list(_radius(answer, x) / beam.length),
        "shape": short_list(shape / (np.max(np.abs(shape)) or 1.0)),
        "way": _WAYS.get(FAMILIES[family].freedoms[0], "across") if other else "across",
        "number": k + 1,
        "hertz": null(hertz(omega2)),
        "fins": _fins(answer),
    }


def _radius(answer: Answer, x: np.ndarray) -> np.ndarray:
    if answer.case is not None:
        return np.asarray(answer.case.vehicle.radius_at(x))
    gyration = answer.beam.radius_of_gyration
    if gyration is None:
        return np.full(len(x), _SLENDER * answer.beam.length)
    return np.full(len(x), max(float(np.mean(gyration)), 0.002 * answer.beam.length))


def _fins(answer: Answer) -> list[dict[str, float]]:
    """Return every fin: place, chord and tip over the length, roll angle [rad]."""
    if answer.case is None:
        return []
    vehicle, L = answer.case.vehicle, answer.beam.length
    return [
        {
            "x": load.position / L,
            "chord": (fins.chord or fins.tip_radius - float(vehicle.radius_at(load.position))) / L,
            "tip": fins.tip_radius / L,
            "roll": float(angle),
        }
        for fins, load in zip(vehicle.fins, answer.case.loads.fins, strict=True)
        for angle in fins.roll_angles
    ]
