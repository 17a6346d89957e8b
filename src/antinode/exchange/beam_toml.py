"""A beam as a beam file: the tables of `[beam]`, and their text in TOML.

N(x) stands in the column `axial_force` unless it grows with the mass. Then its jumps become point
forces and the rest gravity, or the acceleration of a free beam: `N(x) = sum of the forces left of x
+ a (mass left of x)`, closed by a force at the right end so that no support has to react. Where
several supports share the load, what they do not make of the weight stands in the column.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from antinode.arrays import Array
from antinode.beam.attachments import (
    Attachment,
    Dashpot,
    Joint,
    Pedestal,
    PointFeedback,
    PointMass,
    Spring,
)
from antinode.beam.axial import AxialLoads, apply_loads
from antinode.beam.beam import Beam
from antinode.beam.families import LONGITUDINAL
from antinode.beam.file import BeamFile
from antinode.beam.rotation import at_rest
from antinode.beam.station_csv import without_hull
from antinode.inputs.explain import validate
from antinode.inputs.toml_writing import toml_text

from .drawn import drawn
from .tabulated import Hull, Stations, drawn_stations, tabulate

_SAME = 1e-7  # of the largest N: what a file may differ from its beam
KINDS: dict[type[Attachment], str] = {
    PointMass: "point_masses",
    Spring: "springs",
    Joint: "joints",
    Dashpot: "dashpots",
    Pedestal: "pedestals",
    PointFeedback: "point_feedbacks",
}
"""Tables of what is attached, by their class."""


def beam_file_text(beam: Beam) -> tuple[str, tuple[str, ...]]:
    """Return a beam as the text of a beam file.

    Returns
    -------
    str
        TOML.
    tuple of str
        What it does not hold exactly.

    Raises
    ------
    InputError
        If several supports share its weight, and it has no EA.
    """
    tables, notes = beam_tables(beam)
    return toml_text({"beam": tables}), notes


def beam_tables(beam: Beam, hull: Hull | None = None) -> tuple[dict[str, Any], tuple[str, ...]]:
    """Return the table `[beam]` of a beam file, and notes on what it does not hold exactly.

    With `hull` its stations have columns that a beam file does not know.
    """
    if beam.rotation is not None:
        tables, notes = beam_tables(at_rest(beam), hull)
        return tables | {"rotation": vars(beam.rotation)}, notes
    plain, loads = _split(beam)
    tables, notes = _tables(beam, plain, loads, hull)
    if loads and not _has_its_force(beam, tables):
        tables, notes = _tables(beam, *_beside_weight(beam), hull)
    return tables, notes


def _tables(
    beam: Beam, plain: Beam, loads: dict[str, Any], hull: Hull | None
) -> tuple[dict[str, Any], tuple[str, ...]]:
    """Return the tables of a beam whose axial force is that of a plain one under loads."""
    found = drawn(plain)
    stations = tabulate(plain) if found is None else drawn_stations(found)
    tables = head_tables(beam, stations) | attachment_tables(beam)
    if found is not None and found.parts:
        tables["masses"] = found.parts
    if loads:
        tables["loads"] = loads
    return tables | {"stations": _columns(stations.with_hull(hull or {}))}, stations.notes


def _beside_weight(beam: Beam) -> tuple[Beam, dict[str, Any]]:
    """Return the beam with all of N that its weight on its supports does not make; and gravity."""
    a = beam.axial_acceleration
    bare = replace(beam, axial_force=np.zeros_like(beam.axial_force), axial_acceleration=0.0)
    weight = AxialLoads(gravity=a, offset_weight=beam.offset_weight)
    rest = beam.axial_force - apply_loads(bare, weight).axial_force
    rest[np.abs(rest) <= 1e-12 * np.max(np.abs(beam.axial_force))] = 0.0
    loads: dict[str, Any] = {"gravity": a}
    loads |= {} if beam.offset_weight else {"offset_weight": False}
    return replace(beam, axial_force=rest, axial_acceleration=0.0), loads


def head_tables(beam: Beam, stations: Stations) -> dict[str, Any]:
    """Return name, interpolation, stations and ends."""
    ends = {key: value for key, value in vars(beam.ends).items() if value not in (None, 0.0)}
    tables = {
        "name": beam.name,
        "interpolation": stations.interpolation,
        **shear_keys(beam),
        "stations": _columns(stations),
        "ends": ends,
    }
    if stations.material is None:
        return tables
    return tables | {"material": stations.material.model_dump(exclude_none=True)}


def shear_keys(beam: Beam) -> dict[str, str]:
    """Return theory and form of shear, where they are not the default."""
    keys: dict[str, str] = {} if beam.theory is None else {"theory": beam.theory}
    return keys if beam.shear_form == "haringx" else {**keys, "shear_form": beam.shear_form}


def _columns(stations: Stations) -> dict[str, list[float]]:
    return {name: column.tolist() for name, column in stations.columns.items()}


def attachment_tables(beam: Beam) -> dict[str, list[dict[str, float]]]:
    """Return what is attached as lists of tables; zeros are left out."""
    tables: dict[str, list[dict[str, float]]] = {}
    for item in beam.attachments:
        row = {key: float(v) for key, v in vars(item).items() if v or key == "x"}
        tables.setdefault(KINDS[type(item)], []).append(row)
    return tables


def _split(beam: Beam) -> tuple[Beam, dict[str, Any]]:
    """Return the beam with what a column can hold of N, and loads for the rest."""
    table = beam.axial_force
    if beam.axial_acceleration == 0:
        return beam, {}
    jumps = np.append(table[0, 0], table[1:, 0] - table[:-1, -1])
    scale = 1e-12 * float(np.max(np.abs(table)))
    jumps[np.abs(jumps) <= scale] = 0.0
    rest = table - np.cumsum(jumps)[:, None]
    rest[np.abs(rest) <= scale] = 0.0
    return replace(beam, axial_force=rest, axial_acceleration=0.0), _loads(beam, jumps)


def _loads(beam: Beam, jumps: Array) -> dict[str, Any]:
    a = beam.axial_acceleration
    forces = {k: float(f) for k, f in enumerate(jumps) if f}
    last = len(beam.x) - 1
    forces[last] = -a * beam.mass - float(np.sum(jumps))
    held = _axially_held(beam)
    if len(held) > 1:  # they share the load by EA: what acts at them is their reaction
        forces = {k: f for k, f in forces.items() if k not in held}
    points = [{"x": float(beam.x[k]), "force": f} for k, f in sorted(forces.items()) if f]
    loads: dict[str, Any] = {"gravity": a} if held and a else {}
    if points:
        loads["point_forces"] = points
    return loads if beam.offset_weight else {**loads, "offset_weight": False}


def _axially_held(beam: Beam) -> set[int]:
    """Return the breakpoints that are held axially."""
    left, right = beam.ends.of(LONGITUDINAL)
    held = {0} if left == "fixed" else set()
    held |= {len(beam.x) - 1} if right == "fixed" else set()
    springs = [s for s in beam.attachments if isinstance(s, Spring) and s.axial]
    return held | {int(np.argmin(np.abs(beam.x - s.x))) for s in springs}


def _has_its_force(beam: Beam, tables: dict[str, Any]) -> bool:
    """Tell whether the tables, without columns of a hull, give the axial force of the beam."""
    again = validate(BeamFile, {"beam": without_hull(tables)}, "the beam").beam()
    k = np.arange(len(beam.x) - 1)
    wanted = beam.axial_force_at(k, np.full(len(k), 0.5))
    middle = (beam.x[:-1] + beam.x[1:]) / 2
    at = np.searchsorted(again.x, middle, side="right") - 1
    got = again.axial_force_at(at, (middle - again.x[at]) / np.diff(again.x)[at])
    return bool(np.max(np.abs(got - wanted)) <= _SAME * np.max(np.abs(wanted)))
