"""Stations of a beam as CSV: a header with units, one row a station.

A first line `# interpolation = "step"` says how the columns run; readers that pass over comments do
not mind it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from antinode.arrays import Array
from antinode.beam.beam import Beam
from antinode.beam.file import COLUMNS
from antinode.inputs.reading import COLUMN_UNITS, read_csv

from .tabulated import HULL, Hull, Stations, tabulate

KNOWN = (*COLUMNS, *HULL)
"""Columns that a table of stations may have."""
_INTERPOLATION = re.compile(r'^#\s*interpolation\s*=\s*"?(step|linear|log)"?\s*$', re.MULTILINE)


def station_csv(beam: Beam, hull: Hull) -> tuple[str, tuple[str, ...]]:
    """Return the stations of a beam as CSV, and notes on what it leaves out."""
    stations = tabulate(beam).with_hull(hull)
    return csv_text(stations), (*stations.notes, *left_out(beam))


def csv_text(stations: Stations) -> str:
    """Return stations as the text of a CSV file; all digits are kept."""
    header = ",".join(f"{name} [{COLUMN_UNITS[name]}]" for name in stations.columns)
    columns: list[Array] = list(stations.columns.values())
    rows = [",".join(repr(float(c[k])) for c in columns) for k in range(len(columns[0]))]
    return "\n".join([f'# interpolation = "{stations.interpolation}"', header, *rows]) + "\n"


def left_out(beam: Beam) -> tuple[str, ...]:
    """Say what a table of stations leaves out of a beam."""
    notes = []
    if beam.attachments:
        n = len(beam.attachments)
        text = f"{n} attachment is" if n == 1 else f"{n} attachments are"
        notes.append(f"{text} left out; write a .toml or .xlsx to keep them")
    if (beam.ends.left, beam.ends.right) != ("free", "free"):
        ends = f"{beam.ends.left} - {beam.ends.right}"
        notes.append(f"the ends, {ends}, are left out; write a .toml or .xlsx to keep them")
    return tuple(notes)


def read_station_csv(path: Path) -> dict[str, Any]:
    """Return the table `[beam]` of stations in CSV, columns of a hull among them.

    Raises
    ------
    InputError
        If it cannot be read.
    """
    table = beam_table(path, read_csv(path, KNOWN))
    if found := _INTERPOLATION.search(path.read_text(encoding="utf-8-sig")[:2000]):
        table["interpolation"] = found[1]
    return table


def beam_table(path: Path, columns: Mapping[str, list[float]]) -> dict[str, Any]:
    """Return the table `[beam]` of columns of stations; its name is the file's."""
    return {"name": path.stem[:200] or "beam", "stations": dict(columns)}


def without_hull(table: dict[str, Any]) -> tuple[dict[str, Any], Hull]:
    """Return a table `[beam]` with what a beam has a use for, and the columns of a hull."""
    stations = table["stations"]
    kept = {name: column for name, column in stations.items() if name not in HULL}
    if len(kept) == len(stations) or "x" not in stations:
        return {**table, "stations": kept}, {}
    names = [name for name in stations if name == "x" or name in HULL]
    return {**table, "stations": kept}, {name: np.array(stations[name]) for name in names}
