"""Workbooks (XLSX): a beam, its attachments, its modes and their shapes, one sheet each.

The sheet `stations` has the columns of a CSV file. `beam` has keys and values; `point_masses`,
`springs` and `joints` have one row each. Results stand in `modes` and in one sheet for each
component of the shapes. Only the first group is read again, by `beam/workbook.py`.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from antinode.beam.beam import Beam
from antinode.beam.families import FAMILIES
from antinode.beam.workbook import ATTACHED, KEYS
from antinode.extras import import_extra
from antinode.inputs.reading import COLUMN_UNITS
from antinode.modes.result import ModalResult
from antinode.show.tables import modal_table

from .beam_toml import beam_tables
from .tabulated import Hull


def write_workbook(
    path: Path, beam: Beam, result: ModalResult | None, hull: Hull
) -> tuple[str, ...]:
    """Write a beam, and its modes if they are given.

    Parameters
    ----------
    path : Path
    beam : Beam
    result : ModalResult or None
    hull : dict
        Columns of its hull, if there are any.

    Returns
    -------
    tuple of str
        What the workbook does not hold exactly.
    """
    book = import_extra("openpyxl", "exchange").Workbook()
    book.remove(book.active)
    if result is not None:
        _fill(book, "modes", csv.reader(io.StringIO(modal_table(result))))
    tables, notes = beam_tables(beam, hull)
    _fill_beam(book, tables)
    if result is not None:
        _fill_shapes(book, result)
    book.save(path)
    return notes


def _fill_beam(book: Any, tables: dict[str, Any]) -> None:
    """Add the sheets that are read again."""
    columns, loads = tables["stations"], tables.get("loads", {})
    header = [f"{name} [{COLUMN_UNITS[name]}]" for name in columns]
    _fill(book, "stations", [header, *zip(*columns.values(), strict=True)])
    head = ("name", "interpolation", "theory", "shear_form")
    pairs = [(key, tables[key]) for key in head if key in tables]
    pairs += [*tables.get("material", {}).items()]
    pairs += [*tables["ends"].items(), *((k, v) for k, v in loads.items() if k in KEYS)]
    _fill(book, "beam", [("key", "value"), *pairs])
    attached = {"point_forces": loads.get("point_forces")} | tables
    for sheet, units in ATTACHED.items():
        if rows := attached.get(sheet):
            header = [f"{name} [{unit}]" for name, unit in units.items()]
            _fill(book, sheet, [header, *([row.get(name, 0.0) for name in units] for row in rows)])


def _fill(book: Any, name: str, rows: Iterable[Sequence[Any]]) -> None:
    """Add a sheet; what reads as a number becomes one, and no text becomes a formula."""
    sheet = book.create_sheet(name)
    for i, row in enumerate(rows, 1):
        for j, value in enumerate(row, 1):
            cell = sheet.cell(i, j)
            number = _number(value)
            cell.value = str(value) if number is None else number
            cell.data_type = "s" if number is None else "n"
    sheet.freeze_panes = "A2"


def _number(value: object) -> float | None:
    if isinstance(value, bool):
        return None
    try:
        number = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        return None
    return number if np.isfinite(number) else None


def _fill_shapes(book: Any, result: ModalResult) -> None:
    for family, entry in FAMILIES.items():
        modes = [mode for mode in result.modes if mode.family == family]
        for index, (symbol, unit, _) in enumerate(entry.quantities):
            if modes:
                header = ["x [m]", *(f"{mode.name}: {symbol} [{unit}]" for mode in modes)]
                table = np.stack([result.x, *(m.states[:, index] for m in modes)], axis=1)
                _fill(book, symbol, [header, *table.tolist()])
