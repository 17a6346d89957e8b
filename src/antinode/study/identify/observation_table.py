"""Observations as a CSV table: conditions in columns, and frequencies as ``bending:1 [Hz]``."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from antinode.beam.families import FAMILIES
from antinode.errors import InputError
from antinode.inputs.reading import Row, read_cells
from antinode.text import short

_TEXTS = ("name", "mass_state")
_MOST = 500


def read_observations(path: Path) -> list[dict[str, Any]]:
    """Read a table of observations into rows as they would stand in TOML.

    The header names each column with its unit, ``cavitator_angle [deg]``, or without one for SI;
    a name with dots is the path of a number, ``point_masses.0.mass [kg]``.
    An empty cell leaves a condition to the case; an empty frequency was not measured.

    Raises
    ------
    InputError
        If it cannot be read.
    """
    header, *rows = read_cells(path) or [Row(1, [])]
    if not rows:
        raise InputError(f"{path}: the table is empty; give a header and one row at the least")
    columns = [_column(cell, path) for cell in header.cells]
    names = [name for name, _ in columns]
    for name in names:
        if names.count(name) > 1:
            raise InputError(f"{path}: header: the column {name} stands there twice; remove one")
    return [_row(row.cells, row.line, columns, path) for row in rows]


def _column(cell: str, path: Path) -> tuple[str, str]:
    """Return name and unit of a column."""
    name, bracket, unit = cell.partition("[")
    name, unit = name.strip(), unit.strip()
    where = f"{path}: header: column {short(name)}"
    if not name:
        raise InputError(f"{path}: header: a column has no name; name it, or remove it")
    if bracket and not unit.endswith("]"):
        raise InputError(f"{where}: the bracket around its unit is not closed; write e.g. [Hz]")
    family, colon, number = name.partition(":")
    if colon:
        _check_mode(family, number, where)
    return name, unit.removesuffix("]").strip()


def _check_mode(family: str, number: str, where: str) -> None:
    if family not in FAMILIES:
        known = ", ".join(f"{name}:1" for name in FAMILIES)
        raise InputError(f"{where}: there is no such family; write one of {known}")
    if not (number.isascii() and number.isdigit() and 1 <= int(number[:9]) <= _MOST):
        raise InputError(f"{where}: there is no such mode; numbers run from 1 to {_MOST}")


def _row(cells: list[str], line: int, columns: list[tuple[str, str]], path: Path) -> dict[str, Any]:
    if len(cells) != len(columns):
        say = f"{len(cells)} cells, but {len(columns)} in the header"
        raise InputError(f"{path}, line {line}: {say}; give one for each column")
    row: dict[str, Any] = {}
    for (name, unit), cell in zip(columns, cells, strict=True):
        family, colon, number = name.partition(":")
        value = f"{cell} {unit}" if cell and unit and _is_number(cell) else cell
        if colon:
            _put(row.setdefault(family, []), int(number), value)
        elif cell and "." in name:
            row.setdefault("inputs", {})[name] = _plain(value)
        elif cell:
            row[name] = value if name in _TEXTS else _plain(value)
    return row


def _put(values: list[Any], number: int, value: str) -> None:
    values.extend([""] * (number - len(values)))
    values[number - 1] = _plain(value)


def _plain(value: str) -> str | float:
    return float(value) if _is_number(value) else value


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
