"""Workbooks (XLSX) as the table `[beam]`: stations, ends, attachments and loads, one sheet each.

The sheet `stations` has the columns of a CSV file. `beam` has keys and values; `point_masses`,
`springs`, `joints`, `dashpots`, `point_feedbacks` and `point_forces` have one row each.
"""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

from antinode.errors import InputError
from antinode.extras import import_extra
from antinode.inputs.reading import MOST_ROWS, Row, read_bytes, station_columns
from antinode.inputs.units import unit_factor
from antinode.text import nearest, short

from .families import FAMILIES
from .sections.material import Material
from .station_csv import HULL, beam_table

MOST_BYTES = 20_000_000
_MOST_COLUMNS = 100
_MOST_CELLS = 1_000_000
ENDS = (
    *("left", "right", "left_axial", "right_axial", "left_torsion", "right_torsion"),
    *("left_follower", "right_follower"),
)
LOADS = ("gravity", "offset_weight")
MATERIAL = tuple(Material.model_fields)
KEYS = ("name", "interpolation", "theory", "shear_form", *ENDS, *LOADS, *MATERIAL)
"""Keys of the sheet `beam`."""
ATTACHED = {
    "point_masses": {
        "x": "m",
        "mass": "kg",
        "rotary_inertia": "kg m^2",
        "offset": "m",
        "polar_inertia": "kg m^2",
    },
    "springs": {
        "x": "m",
        "translational": "N/m",
        "rotational": "N m/rad",
        "axial": "N/m",
        "torsional": "N m/rad",
        "coupling": "N",
    },
    "joints": {"x": "m", "rotational": "rad/(N m)", "axial": "m/N", "torsional": "rad/(N m)"},
    "dashpots": {
        "x": "m",
        "translational": "N s/m",
        "rotational": "N m s/rad",
        "axial": "N s/m",
        "torsional": "N m s/rad",
    },
    "point_feedbacks": {
        "x": "m",
        "translational": "N/m",
        "force_of_turn": "N",
        "moment_of_displacement": "N",
        "rotational": "N m/rad",
        "translational_damping": "N s/m",
        "force_of_turn_rate": "N s",
        "moment_of_velocity": "N s",
        "rotational_damping": "N m s/rad",
    },
    "point_forces": {"x": "m", "force": "N"},
}
"""Sheets of attachments and forces: columns with their units."""


def read_workbook(path: Path, columns: tuple[str, ...]) -> dict[str, Any]:
    """Return the table `[beam]` of the sheet `stations`, or the first one, and of the others.

    Raises
    ------
    InputError
        If it cannot be read.
    """
    sheets = _sheets(path)
    rows = station_columns(sheets.get("stations", []), (*columns, *HULL), path)
    table = beam_table(path, rows)
    head = _head(sheets.get("beam", []), path)
    for sheet in ATTACHED:
        if sheet in sheets:
            head[sheet] = _attached(sheets[sheet], sheet, path)
    if "point_forces" in head:
        head.setdefault("loads", {})["point_forces"] = head.pop("point_forces")
    return {**table, **head}


def _sheets(path: Path) -> dict[str, list[Row]]:
    """Return the rows of the sheets that hold something of a beam as text, by what they are."""
    content = io.BytesIO(read_bytes(path, MOST_BYTES, "a workbook"))
    openpyxl = import_extra("openpyxl", "exchange")
    try:
        book = openpyxl.load_workbook(content, read_only=True, data_only=True)
        wanted = _wanted([n for n in book.sheetnames if _has_cells(book[n])], path)
        sheets = {n: _rows(book[own], f"{path}: sheet {short(own)}") for n, own in wanted.items()}
        book.close()
    except InputError:
        raise
    except Exception as error:  # openpyxl lets errors of zip, XML and its own descriptors through
        raise InputError(
            f"{path}: this is not a readable workbook ({type(error).__name__}); save it as .xlsx "
            "again, or write a .csv"
        ) from error
    return sheets


_SHEETS = ("stations", "beam", *ATTACHED)
_RESULTS = ("modes", *(symbol for f in FAMILIES.values() for symbol, _, _ in f.quantities))


def _has_cells(sheet: Any) -> bool:
    """Tell whether anything stands in a sheet, of a new workbook's three empty ones."""
    rows = sheet.iter_rows(max_col=_MOST_COLUMNS, max_row=MOST_ROWS, values_only=True)
    return any(value is not None for row in rows for value in row)


def _wanted(names: list[str], path: Path) -> dict[str, str]:
    """Return the sheets to read and their names; refuse one that was likely meant to be read.

    Capitals and spaces do not count. Sheets with results are not read, nor those whose names start
    with ``#``; the first one may have any name if none is called `stations`.
    """
    alike = {name: "_".join(name.lower().split()) for name in names}
    wanted = {} if "stations" in alike.values() or not names else {"stations": names[0]}
    for name in names:
        if name in (*_RESULTS, *wanted.values()) or name.startswith("#"):
            continue
        if alike[name] not in _SHEETS or alike[name] in wanted:
            other = wanted.get(alike[name])
            near = f"there is {short(other)} already" if other else nearest(alike[name], _SHEETS)
            raise InputError(
                f"{path}: unknown sheet {short(name)}; {near} (# before the name of a sheet leaves "
                "it out)"
            )
        wanted[alike[name]] = name
    return wanted


def _rows(sheet: Any, where: str) -> list[Row]:
    found: list[Row] = []
    cells = 0
    for line, values in enumerate(sheet.iter_rows(max_col=_MOST_COLUMNS, values_only=True), 1):
        texts = [_text(value) for value in values]
        cells += len(texts)
        while texts and not texts[-1]:
            texts.pop()
        if cells > _MOST_CELLS or len(found) > MOST_ROWS:
            raise InputError(f"{where} has more than {MOST_ROWS} rows; give a coarser table")
        if texts and not texts[0].startswith("#"):
            found.append(Row(line, texts))
    width = len(found[0].cells) if found else 0
    return [Row(r.line, r.cells + [""] * (width - len(r.cells))) for r in found]


def _text(value: object) -> str:
    if value is None:
        return ""
    return repr(value) if isinstance(value, float) else str(value).strip()


def _head(rows: list[Row], path: Path) -> dict[str, Any]:
    """Return name, interpolation, ends and loads from the sheet `beam`."""
    if rows and rows[0].cells[0].lower() != "key":
        raise InputError(
            f"{path}: sheet beam: the first row has {short(rows[0].cells[0])}; it must be the "
            "heading: key, value"
        )
    pairs = {row.cells[0]: row.cells[1] for row in rows[1:] if len(row.cells) > 1 and row.cells[1]}
    for key in pairs:
        if key not in KEYS:
            raise InputError(f"{path}: sheet beam: unknown key {short(key)}; {nearest(key, KEYS)}")
    head: dict[str, Any] = {k: v for k, v in pairs.items() if k not in (*ENDS, *LOADS, *MATERIAL)}
    if material := {key: value for key, value in pairs.items() if key in MATERIAL}:
        head["material"] = material
    if ends := {key: value for key, value in pairs.items() if key in ENDS}:
        head["ends"] = ends
    loads: dict[str, Any] = {key: value for key, value in pairs.items() if key in LOADS}
    if "offset_weight" in loads:
        loads["offset_weight"] = loads["offset_weight"].lower() in ("true", "1", "1.0")
    return {**head, "loads": loads} if loads else head


def _attached(rows: list[Row], sheet: str, path: Path) -> list[dict[str, Any]]:
    """Return the rows of a sheet of attachments as tables of a beam file, SI."""
    where = f"{path}: sheet {sheet}"
    if not rows:
        return []
    columns = [_column(cell, ATTACHED[sheet], where) for cell in rows[0].cells]
    tables = []
    for row in rows[1:]:
        table = {}
        for (name, factor), cell in zip(columns, row.cells, strict=False):
            if cell:
                table[name] = _value(cell, factor, f"{where}, row {row.line}, column {name}")
        tables.append(table)
    return tables


def _column(cell: str, units: dict[str, str], where: str) -> tuple[str, float]:
    name, bracket, unit = cell.partition("[")
    name = name.strip()
    if name not in units:
        raise InputError(f"{where}: unknown column {short(name)}; {nearest(name, list(units))}")
    try:
        return name, unit_factor(unit.rstrip("] "), units[name]) if bracket else 1.0
    except ValueError as error:
        raise InputError(f"{where}: column {name}: {error}; write e.g. [{units[name]}]") from error


def _value(cell: str, factor: float, where: str) -> float:
    try:
        return float(cell) * factor
    except ValueError:
        raise InputError(f"{where}: received {short(cell)}; give a number") from None
