"""Stations in CSV as the table `[beam]`: a header with units, one row a station.

A first line `# interpolation = "step"` says how the columns run; `# theory = "timoshenko"` and
`# shear_form = "haringx"` are read too, and of what the material of dimensions is, such as
`# youngs_modulus = "210 GPa"`. Readers that pass over comments do not mind them.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from antinode.inputs.reading import read_csv, read_csv_text

from .sections.material import Material

HULL = ("radius", "wall")
"""Columns that a vehicle's stations have besides: no beam needs them, a table keeps them."""
_KEYS = re.compile(r'^#\s*(interpolation|theory|shear_form)\s*=\s*"?(\w+)"?\s*$', re.MULTILINE)
_MATERIAL = re.compile(rf"^#\s*({'|'.join(Material.model_fields)})\s*=\s*(.+?)\s*$", re.MULTILINE)


def read_station_csv(path: Path, columns: tuple[str, ...]) -> dict[str, Any]:
    """Return the table `[beam]` of stations in CSV, columns of a hull among them.

    Raises
    ------
    InputError
        If it cannot be read.
    """
    table = beam_table(path, read_csv(path, (*columns, *HULL)))
    head = read_csv_text(path)[:2000]
    table |= dict(_KEYS.findall(head))
    if material := {key: value.strip("\"'") for key, value in _MATERIAL.findall(head)}:
        table["material"] = material
    return table


def beam_table(path: Path, columns: Mapping[str, list[float]]) -> dict[str, Any]:
    """Return the table `[beam]` of columns of stations; its name is the file's."""
    return {"name": path.stem[:200] or "beam", "stations": dict(columns)}


def hull_of(stations: Mapping[str, Any]) -> list[str]:
    """Return which columns are a hull's; the wall of a section is not."""
    drawn = {"outer_diameter", "width"} & set(stations)
    return [name for name in HULL if name in stations and not (name == "wall" and drawn)]


def without_hull(table: dict[str, Any]) -> dict[str, Any]:
    """Return a table `[beam]` with the stations' columns that a beam has a use for."""
    stations = table["stations"]
    hull = hull_of(stations)
    return {**table, "stations": {n: c for n, c in stations.items() if n not in hull}}
