"""A beam as a table of stations: one row a station, as a beam file, CSV and XLSX have it.

Between two rows columns run linearly, or exponentially; with "step" a row holds up to the next one.
Where a column jumps although another one varies two rows stand at one x. Under an acceleration N(x)
is a curve where the mass varies; there further rows are put in. A beam that was drawn is written as
its dimensions, and as a finer table where that does not tell all of it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from antinode.arrays import Array, Interpolation
from antinode.beam.beam import Beam
from antinode.beam.file import COLUMNS
from antinode.beam.sections.material import Material
from antinode.errors import AntinodeError, InputError

from .drawn import Drawn, drawn

PIECES = 16
"""Into which an interval is divided where N is a curve."""
FINE = 64
"""Into which it is divided where mass and stiffness are curves."""
PROPERTIES = COLUMNS[1:]
"""Columns of a beam's stations beside x."""
Hull = Mapping[str, Array]
"""Columns of the hull with the `x` [m] that they stand at; empty if there are none."""


@dataclass(frozen=True)
class Stations:
    """Stations of a beam.

    Attributes
    ----------
    interpolation : {"step", "linear", "log"}
    columns : dict
        x and the properties, SI, by name.
    notes : tuple of str
        What the table does not hold exactly.
    material : Material or None
        Where the columns are dimensions of the section.
    """

    interpolation: Interpolation
    columns: dict[str, Array]
    notes: tuple[str, ...] = ()
    material: Material | None = None

    def with_hull(self, hull: Hull) -> Stations:
        """Return the table with the columns of a hull."""
        if not hull:
            return self
        rows = self._rows_with_jumps(hull["x"])
        columns = {name: column[rows] for name, column in self.columns.items()}
        if self.interpolation == "step":
            last = len(hull["x"]) - 1
            k = np.searchsorted(hull["x"], columns["x"], side="right") - 1
            k, t = np.clip(k, 0, last), np.zeros(len(k))
        else:
            k, t = _inside(columns["x"], hull["x"])
        right = np.minimum(k + 1, len(hull["x"]) - 1)
        more = {n: c[k] + (c[right] - c[k]) * t for n, c in hull.items() if n != "x"}
        return replace(self, columns=columns | more)

    def _rows_with_jumps(self, x: Array) -> npt.NDArray[np.intp]:
        """Return the rows, twice those at which a hull with these x jumps."""
        own = self.columns["x"]
        jumps = x[1:][np.diff(x) == 0]
        once = [j for j in jumps.tolist() if np.count_nonzero(own == j) == 1]
        return np.sort(np.concatenate([np.arange(len(own)), np.searchsorted(own, once)]))


def _inside(x: Array, table: Array) -> tuple[npt.NDArray[np.intp], Array]:
    """Return interval and fraction of it in a table; the second of two rows stands on the right."""
    second = np.append(False, np.diff(x) == 0)
    sides = (np.searchsorted(table, x, side=side) for side in ("left", "right"))
    k = np.clip(np.where(second, *reversed(tuple(sides))) - 1, 0, len(table) - 2)
    return k, np.clip((x - table[k]) / np.diff(table)[k], 0.0, 1.0)


def tabulate(beam: Beam) -> Stations:
    """Return the properties of a beam as a table of stations, with N(x) as a column.

    Parameters
    ----------
    beam : Beam
        Its attachments and ends are no part of the table.
    """
    notes = []
    if beam.rotation is not None and beam.rotation.plane == "in_plane":
        raise InputError(
            "no table holds the softening of a beam that rotates in its own plane; write a .toml"
        )
    if beam.axial_acceleration != 0 and bool(np.any(np.ptp(beam.mass_per_length, axis=1))):
        notes.append(_say_curved(beam, with_straight_force(beam)))
    beam = with_straight_force(beam)
    found = drawn(beam)
    if found is not None and not found.parts:
        return replace(drawn_stations(found), notes=tuple(notes))
    if beam.is_curved:
        beam, note = straightened(beam)
        notes.append(note)
    stations = stations_of(beam.x, _properties(beam), beam.interpolation)
    return replace(stations, notes=tuple(notes))


def stations_of(x: Array, tables: dict[str, Array], how: Interpolation) -> Stations:
    """Return tables (n, 2) as rows: stepped if nothing varies in any interval."""
    if not any(np.any(t[:, 0] != t[:, 1]) for t in tables.values()):
        columns = {n: np.append(t[:, 0], t[-1, 0]) for n, t in tables.items()}
        return Stations("step", {"x": x, **columns})
    starts = _starts(tables, len(x) - 1)
    kept = np.stack([starts, np.ones(len(starts), dtype=bool)], axis=1)
    places = np.stack([x[:-1], x[1:]], axis=1)
    columns = {"x": places[kept], **{name: table[kept] for name, table in tables.items()}}
    return Stations("log" if how == "log" else "linear", columns)


def drawn_stations(found: Drawn) -> Stations:
    """Return the rows of a drawing."""
    return replace(stations_of(found.x, found.tables, "linear"), material=found.material)


def straightened(beam: Beam) -> tuple[Beam, str]:
    """Return a beam whose curves are straight pieces, and how much that changes it, in words."""
    curved = np.zeros(len(beam.x) - 1, dtype=bool)
    for name in PROPERTIES:
        table = getattr(beam, name)
        if table is not None:
            curved |= np.any(table != table[:, :1], axis=1)
    pieces = np.arange(1, FINE) / FINE
    inside = beam.x[:-1][curved, None] + np.diff(beam.x)[curved, None] * pieces
    finer = beam.with_breakpoints(inside.ravel().tolist())
    tables: dict[str, Any] = {
        n: None if (t := getattr(finer, n)) is None else t[:, [0, -1]] for n in PROPERTIES
    }
    straight = replace(finer, drawing=None, **tables)
    return straight, (
        f"mass and stiffness are curves: they are written as {FINE} straight pieces an interval, "
        f"{_effect(beam, straight)}"
    )


def _effect(beam: Beam, other: Beam) -> str:
    """Say how much the first bending frequencies of another beam differ."""
    from antinode.modes.frequencies import natural_frequencies

    try:
        f, g = (natural_frequencies(b, 3, tolerance=1e-8).frequencies_hz for b in (beam, other))
    except AntinodeError:
        return "the effect of which could not be computed"
    change = float(np.nanmax(np.abs(g / f - 1)))
    return f"which changes its first three bending frequencies by {100 * change:.2g} % at most"


def _say_curved(given: Beam, straight: Beam) -> str:
    """Say how far N(x) of the straight pieces is off the curve."""
    k, middle = np.arange(len(straight.x) - 1), (straight.x[:-1] + straight.x[1:]) / 2
    at = np.searchsorted(given.x, middle, side="right") - 1
    true = given.axial_force_at(at, (middle - given.x[at]) / np.diff(given.x)[at])
    off = float(np.max(np.abs(straight.axial_force_at(k, np.full(len(k), 0.5)) - true)))
    return (
        f"N(x) is a curve: it is written as {PIECES} straight pieces an interval, up to {off:.2g} "
        f"N off, {off / float(np.max(np.abs(true))):.1e} of the largest"
    )


def with_straight_force(beam: Beam) -> Beam:
    """Return the beam with all of N in its table: straight pieces, more where N is a curve."""
    if beam.axial_acceleration == 0:
        return beam
    varies = np.ptp(beam.mass_per_length, axis=1) > 0
    pieces = np.arange(1, PIECES) / PIECES
    inside = beam.x[:-1][varies, None] + np.diff(beam.x)[varies, None] * pieces
    beam = beam.with_breakpoints(inside.ravel().tolist())
    k = np.arange(len(beam.x) - 1)
    sides = [beam.axial_force_at(k, np.full(len(k), t)) for t in (0.0, 1.0)]
    return replace(beam, axial_force=np.stack(sides, axis=1), axial_acceleration=0.0)


def _properties(beam: Beam) -> dict[str, Array]:
    """Return the tables of a beam that say something, by name."""
    tables = {name: getattr(beam, name) for name in PROPERTIES}
    if beam.is_unloaded:
        del tables["axial_force"]
    return {name: table for name, table in tables.items() if table is not None}


def _starts(tables: dict[str, Array], intervals: int) -> npt.NDArray[np.bool_]:
    """Tell for each interval whether it needs a row of its own at its left end."""
    starts = np.zeros(intervals, dtype=bool)
    starts[0] = True
    for table in tables.values():
        left, right = table[1:, 0], table[:-1, 1]
        scale = 1e-12 * np.max(np.abs(table), where=np.isfinite(table), initial=0.0)
        with np.errstate(invalid="ignore"):
            starts[1:] |= (left != right) & (np.abs(left - right) > scale)
    return starts
