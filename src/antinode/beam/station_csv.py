"""Stations in CSV as the table `[beam]`: a header with units, one row a station.

A first line `# interpolation = "step"` says how the columns run; readers that pass over comments do
not mind it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from antinode.inputs.reading import read_csv, read_csv_text

HULL = ("radius", "wall")
"""Columns that a vehicle's stations have besides: no beam needs them, a table keeps them."""
_INTERPOLATION = re.compile(r'^#\s*interpolation\s*=\s*"?(step|linear|log)"?\s*$', re.MULTILINE)


def read_station_csv(path: Path, columns: tuple[str, ...]) -> dict[str, Any]:
    """Return the table `[beam]` of stations in CSV, columns of a hull among them.

    Raises
    ------
    InputError
        If it cannot be read.
    """
    table = beam_table(path, read_csv(path, (*columns, *HULL)))
    if found := _INTERPOLATION.search(read_csv_text(path)[:2000]):
        table["interpolation"] = found[1]
    return table


def beam_table(path: Path, columns: Mapping[str, list[float]]) -> dict[str, Any]:
    """Return the table `[beam]` of columns of stations; its name is the file's."""
    return {"name": path.stem[:200] or "beam", "stations": dict(columns)}


def without_hull(table: dict[str, Any]) -> dict[str, Any]:
    """Return a table `[beam]` with the stations' columns that a beam has a use for."""
    stations = table["stations"]
    return {**table, "stations": {n: c for n, c in stations.items() if n not in HULL}}
