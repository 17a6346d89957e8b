"""The vehicle to scale in its cavity, with the forces on it as arrows (lengths in metres)."""

from __future__ import annotations

from typing import Any

import numpy as np

from antinode.app.display import System, number_text, shown_unit
from antinode.vehicle.case import Case
from antinode.vehicle.vehicle import FinSet, Vehicle

from .numbers import pairs, short_list


def vehicle_data(case: Case, system: System) -> dict[str, Any]:
    """Return outline, cavity, fins and force arrows of a vehicle in its condition."""
    vehicle, loads = case.vehicle, case.loads
    length = shown_unit("m", system)
    return {
        "length": vehicle.length,
        "ticks": {"unit": length.name, "factor": length.factor},
        "disk": vehicle.cavitator.diameter / 2,
        "body": _outline(vehicle),
        "cavity": _cavity(case),
        "fins": [
            fin
            for fins, load in zip(vehicle.fins, loads.fins, strict=True)
            for fin in _fins(vehicle, fins, load.position)
        ],
        "centre": float(f"{loads.x_M:.5g}"),
        "arrows": _arrows(case, system),
    }


def _outline(vehicle: Vehicle) -> list[list[float | None]]:
    """Return the upper edge of the body, [x, radius], steps with both sides."""
    x = vehicle.stations.x
    if vehicle.interpolation != "step":
        return pairs(x, vehicle.radius_at(x))
    edges = np.repeat(x, 2)[1:-1]
    return pairs(edges, np.repeat(vehicle.stations.radius[:-1], 2))


def _cavity(case: Case) -> dict[str, list[float | None]]:
    cavity = case.loads.cavity
    x = np.linspace(0.0, min(cavity.L_c, 1.08 * case.vehicle.length), 81)
    middle, radius = cavity.axis_offset(x), cavity.radius(x)
    return {
        "x": short_list(x),
        "top": short_list(middle + radius),
        "bottom": short_list(middle - radius),
    }


def _fins(vehicle: Vehicle, fins: FinSet, x: float) -> list[list[float]]:
    """Return each fin as seen from the side: x from, x to, height from, height to."""
    root = float(vehicle.radius_at(x))
    half = (fins.chord or (fins.tip_radius - root)) / 2
    return [
        [x - half, x + half, *sorted((root * float(c), fins.tip_radius * float(c)))]
        for c in np.cos(fins.roll_angles)
    ]


def _named(name: str, along: bool) -> str:
    if name in ("thrust", "weight", "extra drag"):
        return name
    return f"{name.replace('fin set', 'fins')} {'drag' if along else 'lift'}"


def _arrows(case: Case, system: System) -> list[dict[str, Any]]:
    """Return every force as an arrow along and one across the axis; thrust and weight too."""
    loads, L = case.loads, case.vehicle.length
    unit = shown_unit("N", system)
    parts = [
        (f.name if f.name != "fin set 1" or len(loads.fins) > 1 else "fins", f.x, f.F_X, f.F_Y)
        for f in loads.forces
    ]
    parts += [("thrust", L, -loads.thrust, 0.0), ("weight", loads.x_M, 0.0, -loads.weight)]
    largest = max(abs(v) for _, _, *forces in parts for v in forces) or 1.0
    return [
        {
            "name": name,
            "x": float(f"{x:.5g}"),
            "along": along,
            "size": float(f"{force / largest:.4g}"),
            "text": f"{_named(name, along)} {number_text(abs(unit.of(force)), 3)} {unit.name}",
        }
        for name, x, *forces in parts
        for along, force in zip((True, False), forces, strict=True)
        if abs(force) > 2e-3 * largest
    ]
