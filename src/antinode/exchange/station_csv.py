"""Stations of a beam as CSV: a header with units, one row a station.

A first line `# interpolation = "step"` says how the columns run; readers that pass over comments do
not mind it.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from antinode.beam import Array, Beam
from antinode.files import read_csv

from .tabulated import UNITS, Stations, tabulate

VEHICLE_COLUMNS = ("radius", "wall")
"""Columns that a vehicle's stations have besides; a beam has no use for them."""
_INTERPOLATION = re.compile(r'^#\s*interpolation\s*=\s*"?(step|linear|log)"?\s*$', re.MULTILINE)


def station_csv(beam: Beam) -> tuple[str, tuple[str, ...]]:
    """Return the stations of a beam as CSV, and notes on what it leaves out."""
    stations = tabulate(beam)
    return csv_text(stations), (*stations.notes, *left_out(beam))


def csv_text(stations: Stations) -> str:
    """Return stations as the text of a CSV file; all digits are kept."""
    header = ",".join(f"{name} [{UNITS[name]}]" for name in stations.columns)
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


def read_station_csv(path: Path) -> tuple[dict[str, Any], tuple[str, ...]]:
    """Read stations from CSV.

    Returns
    -------
    dict
        The table `[beam]`.
    tuple of str
        What was left out.

    Raises
    ------
    InputError
        If it cannot be read.
    """
    columns: dict[str, Any] = dict(read_csv(path, [*UNITS, *VEHICLE_COLUMNS]))
    return beam_table(path, columns, path.read_text(encoding="utf-8-sig")[:2000])


def beam_table(
    path: Path, columns: dict[str, Any], comments: str = ""
) -> tuple[dict[str, Any], tuple[str, ...]]:
    """Return the table `[beam]` of stations, without what a beam has no use for, and notes."""
    extra = [name for name in columns if name not in UNITS]
    kept = {name: column for name, column in columns.items() if name in UNITS}
    table = {"name": path.stem[:200] or "beam", "stations": kept}
    if found := _INTERPOLATION.search(comments):
        table["interpolation"] = found[1]
    notes = (f"left out, since a beam has none: {', '.join(extra)}",) if extra else ()
    return table, notes
