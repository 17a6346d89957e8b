"""A beam as a sketch: outline, ends, and what is attached, each with the path that moves it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from antinode.app.compute import Answer
from antinode.app.display import System, number_text, shown_unit
from antinode.app.physics import pushing
from antinode.beam.file import BeamFile
from antinode.beam.tables import SpringTable

from .numbers import short_list

_THIN = 0.25  # share of the largest height at the least stiffness
_HEIGHTS = ("outer_diameter", "height")


def sketch_data(answer: Answer, system: System) -> dict[str, Any]:
    """Return what the sketch of a beam shows; lengths in metres."""
    file, beam = answer.problem, answer.beam
    assert isinstance(file, BeamFile)
    unit = shown_unit("m", system)
    return {
        "x": short_list(np.repeat(beam.x, 2)[1:-1], 7),
        "half": short_list(_half(file, answer)),
        "drawn": _drawn(file) is not None,
        "ends": [file.table.ends.left, file.table.ends.right],
        "follow": [bool(force) for force in beam.following()],
        "force": [_force(force, system) for force in _outside(file, answer)],
        "push": [float(np.sign(force)) for force in pushing(beam)],
        "foundation": beam.foundation_stiffness is not None,
        "items": [*_items(file, system)],
        "ticks": {"unit": unit.name, "factor": unit.factor},
    }


def _outside(file: BeamFile, answer: Answer) -> tuple[float, float]:
    """Return the forces at free ends; what holds an end is no force of the file."""
    ends, forces = file.table.ends, pushing(answer.beam)
    return (
        forces[0] if ends.left == "free" else 0.0,
        forces[1] if ends.right == "free" else 0.0,
    )


def _force(force: float, system: System) -> str:
    unit = shown_unit("N", system)
    return f"{number_text(abs(unit.of(force)), 3)} {unit.name}" if force else ""


def _drawn(file: BeamFile) -> np.ndarray | None:
    stations = file.table.stations
    return next((c for c in (getattr(stations, n) for n in _HEIGHTS) if c is not None), None)


def _half(file: BeamFile, answer: Answer) -> np.ndarray:
    """Return half heights at both ends of every interval, the largest 1: drawn ones, or by EI."""
    beam = answer.beam
    drawn = _drawn(file)
    if drawn is not None:
        x = file.table.stations.x
        if file.table.interpolation == "step":
            k = np.clip(np.searchsorted(x, beam.x[:-1], side="right") - 1, 0, len(x) - 1)
            half = np.repeat(drawn[k], 2)
        else:
            half = np.interp(np.repeat(beam.x, 2)[1:-1], x, drawn)
        return np.asarray(half / np.max(half))
    size = np.log(beam.bending_stiffness[:, [0, -1]].ravel())
    low, high = float(size.min()), float(size.max())
    share = (size - low) / (high - low) if high - low > 1e-9 else np.full(len(size), 0.5)
    return np.asarray(_THIN + (1 - _THIN) * share)


def _items(file: BeamFile, system: System) -> list[dict[str, Any]]:
    """Return what is attached, with where it stands in the file."""
    table = file.table
    found = []
    for key, entries in (
        ("point_masses", table.point_masses),
        ("springs", table.springs),
        ("pedestals", table.pedestals),
        ("joints", table.joints),
        ("dashpots", table.dashpots),
        ("point_feedbacks", table.point_feedbacks),
    ):
        for k, entry in enumerate(entries):
            kind = _kind(key, entry)
            name = f"{kind} {k + 1}"
            x = float(vars(entry)["x"])
            found.append(_item(f"beam.{key}.{k}", kind, x, name, 0.0))
    forces = table.loads.point_forces if table.loads else ()
    for k, force in enumerate(forces):
        name = f"force {k + 1}: {_force(force.force, system)}"
        sign = float(np.sign(force.force))
        found.append(_item(f"beam.loads.point_forces.{k}", "force", force.x, name, sign))
    return found


def _kind(key: str, entry: object) -> str:
    if isinstance(entry, SpringTable) and math.inf in (entry.translational, entry.rotational):
        return "support"
    return {
        "point_masses": "mass",
        "springs": "spring",
        "pedestals": "pedestal",
        "joints": "joint",
        "dashpots": "dashpot",
        "point_feedbacks": "feedback",
    }[key]


def _item(path: str, kind: str, x: float, name: str, sign: float) -> dict[str, Any]:
    return {"path": f"{path}.x", "kind": kind, "x": float(f"{x:.7g}"), "name": name, "sign": sign}
