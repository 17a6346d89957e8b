"""A beam as a table of stations: one row a station, as a beam file, CSV and XLSX have it.

Between two rows columns run linearly, or exponentially; with "step" a row holds up to the next one.
A file allows one row at one x: where a column jumps although another one varies, two rows stand
`JUMP` of the length apart. Under an acceleration N(x) is a curve where the mass varies; there
further rows are put in.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from antinode.arrays import Array, Interpolation
from antinode.beam.beam import Beam
from antinode.beam.file import COLUMNS
from antinode.text import counted

JUMP = 1e-9
"""Distance of the two rows of a jump, in lengths of the beam."""
PIECES = 16
"""Into which an interval is divided where N is a curve."""
PROPERTIES = COLUMNS[1:]
"""Columns of a beam's stations beside x."""
HULL = ("radius", "wall")
"""Columns that a vehicle's stations have besides: no beam needs them, a table keeps them."""
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
    """

    interpolation: Interpolation
    columns: dict[str, Array]
    notes: tuple[str, ...] = ()

    def with_hull(self, hull: Hull) -> Stations:
        """Return the table with the columns of a hull."""
        if not hull:
            return self
        x = self.columns["x"]
        row = np.clip(np.searchsorted(hull["x"], x, side="right") - 1, 0, len(hull["x"]) - 1)
        step = self.interpolation == "step"
        more = {
            name: column[row] if step else np.interp(x, hull["x"], column)
            for name, column in hull.items()
            if name != "x"
        }
        return replace(self, columns=self.columns | more)


def tabulate(beam: Beam) -> Stations:
    """Return the properties of a beam as a table of stations, with N(x) as a column.

    Parameters
    ----------
    beam : Beam
        Its attachments and ends are no part of the table.
    """
    if _is_stepped(beam):
        columns = {n: np.append(t[:, 0], t[-1, 0]) for n, t in _properties(beam).items()}
        return Stations("step", {"x": beam.x, **columns})
    curved = beam.axial_acceleration != 0 and bool(np.any(np.ptp(beam.mass_per_length, axis=1)))
    beam = with_straight_force(beam)
    tables = _properties(beam)
    starts = _starts(tables, len(beam.x) - 1)
    x = np.stack([beam.x[:-1] + JUMP * beam.length * (np.arange(len(starts)) > 0), beam.x[1:]], 1)
    kept = np.stack([starts, np.ones(len(starts), dtype=bool)], axis=1)
    columns = {"x": x[kept], **{name: table[kept] for name, table in tables.items()}}
    interpolation: Interpolation = "log" if beam.interpolation == "log" else "linear"
    return Stations(interpolation, columns, _notes(int(np.sum(starts)) - 1, curved=curved))


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


def _is_stepped(beam: Beam) -> bool:
    tables = _properties(beam).values()
    return beam.axial_acceleration == 0 and not any(np.any(t[:, 0] != t[:, 1]) for t in tables)


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
        scale = 1e-12 * np.max(np.abs(table))
        starts[1:] |= np.abs(table[1:, 0] - table[:-1, 1]) > scale
    return starts


def _notes(jumps: int, *, curved: bool) -> tuple[str, ...]:
    notes = []
    if jumps:
        text = "each is written as two rows" if jumps > 1 else "it is written as two rows"
        notes.append(f"{counted(jumps, 'jump')} between stations: {text} {JUMP:g} lengths apart")
    if curved:
        notes.append(f"N(x) is a curve: it is written as {PIECES} straight pieces an interval")
    return tuple(notes)
