"""N, Q and M along the body, both sides of every step."""

from __future__ import annotations

from typing import Any

import numpy as np

from antinode.app.compute import Answer
from antinode.app.display import System, shown_unit
from antinode.beam.beam import Beam

from .numbers import pairs


def forces_data(answer: Answer, system: System) -> dict[str, Any]:
    """Return the internal forces: N, Q and M of a vehicle, N of a beam."""
    return {
        "x": {
            "unit": shown_unit("m", system).name,
            "origin": "nose" if answer.case else "left end",
        },
        "curves": [
            {
                "name": name,
                "title": title,
                "unit": shown_unit(si, system).name,
                "lines": [{"name": "", "points": _points(x, y, si, system)}],
            }
            for name, title, si, x, y in _curves(answer)
        ],
    }


def _points(x: np.ndarray, y: np.ndarray, si: str, system: System) -> list[list[float | None]]:
    return pairs(x / shown_unit("m", system).factor, y / shown_unit(si, system).factor)


def _curves(answer: Answer) -> list[tuple[str, str, str, np.ndarray, np.ndarray]]:
    axial = "axial force, compression positive"
    if answer.case is None:
        return [("N", axial, "N", *_beam_axial_force(answer.beam))]
    loads, L = answer.case.loads, answer.case.vehicle.length
    x = np.unique(np.concatenate([np.linspace(0, L, 81), loads.breakpoints]))
    both = np.repeat(x, 2)

    def sides(left: np.ndarray, right: np.ndarray) -> np.ndarray:
        return np.stack([left, right], axis=1).ravel()

    N = sides(loads.axial_force(x, "left"), loads.axial_force(x, "right"))
    Q = sides(loads.shear_force(x, "left"), loads.shear_force(x, "right"))
    keep = np.ones(len(both), dtype=bool)
    keep[1::2] = (N[::2] != N[1::2]) | (Q[::2] != Q[1::2])
    return [
        ("N", axial, "N", both[keep], N[keep]),
        ("Q", "shear force", "N", both[keep], Q[keep]),
        ("M", "bending moment", "N m", x, loads.bending_moment(x)),
    ]


def _beam_axial_force(beam: Beam) -> tuple[np.ndarray, np.ndarray]:
    intervals = len(beam.x) - 1
    inside = max(2, 120 // intervals)
    k = np.repeat(np.arange(intervals), inside)
    t = np.tile(np.linspace(0, 1, inside), intervals)
    return beam.x[k] + np.diff(beam.x)[k] * t, beam.axial_force_at(k, t)
