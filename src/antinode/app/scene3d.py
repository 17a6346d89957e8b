"""The body in three dimensions, bending in one of its modes."""

from __future__ import annotations

from typing import Any

import numpy as np

from antinode.modes.hertz import hertz
from antinode.modes.result import null

from .compute import Answer
from .panels.numbers import short_list

_RINGS = 61
_SLENDER = 0.015  # radius over length of a beam whose radius nobody knows


def body_data(answer: Answer, number: int) -> dict[str, Any]:
    """Return rings of the body and the shape of a bending mode at them, over the length.

    Parameters
    ----------
    answer : Answer
    number : int
        Of the bending mode; the last one where there are fewer.
    """
    quick, beam = answer.quick, answer.beam
    k = min(number, len(quick.omega2)) - 1
    x = np.linspace(beam.x[0], beam.x[-1], _RINGS)
    shape = np.interp(x, quick.x, quick.states[:, k, 0])
    omega2 = float(quick.omega2[k])
    return {
        "x": short_list((x - beam.x[0]) / beam.length),
        "radius": short_list(_radius(answer, x) / beam.length),
        "shape": short_list(shape / (np.max(np.abs(shape)) or 1.0)),
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
