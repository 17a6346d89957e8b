"""Units of responses: g beside m/s^2, spectra of a unit squared per Hz, tables of two columns."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from antinode.arrays import Array
from antinode.errors import InputError
from antinode.inputs.reading import Row, read_cells
from antinode.inputs.units import to_si, unit_factor
from antinode.inputs.written import number, split_number
from antinode.text import short

STANDARD_GRAVITY = 9.80665
"""One g [m/s^2]."""
_SQUARE = re.compile(r"\(?\s*(.+?)\s*\)?\s*(?:\^\s*2|\*\*\s*2|²|2)\s*/\s*Hz")


def factor_of(written: str, unit: str) -> float:
    """Return the factor from a written unit to an SI one; g is one of an acceleration.

    Parameters
    ----------
    written : str
        As it stands in a file: ``"g"``, ``"kN"``, ``"g^2/Hz"``.
    unit : str
        SI, or that of a spectrum: ``"N^2/Hz"``, ``"(m/s^2)^2/Hz"``.

    Raises
    ------
    ValueError
        If it is no unit of that kind.
    """
    written = written.strip()
    if unit.endswith("^2/Hz"):
        squared = unit.removesuffix("^2/Hz").removeprefix("(").removesuffix(")")
        found = _SQUARE.fullmatch(written)
        if found is None:
            raise ValueError(f"'{written}' is no unit of {unit}")
        return factor_of(found[1], squared) ** 2
    if unit == "m/s^2" and written in ("g", "gn", "g0"):
        return STANDARD_GRAVITY
    return 1.0 if written == unit else unit_factor(written, unit)


def spectral(unit: str) -> str:
    """Return the unit of a spectral density of a quantity."""
    return f"{unit}^2/Hz" if unit.isalnum() else f"({unit})^2/Hz"


def in_si(value: object, unit: str, where: str) -> float:
    """Return a number, or a text with its unit, in SI.

    Raises
    ------
    InputError
        If it is neither.
    """
    if value is None:
        raise InputError(f"{where} is missing; give it, e.g. '1 {unit}'")
    try:
        if isinstance(value, str) and (unit == "m/s^2" or unit.endswith("^2/Hz")):
            size, written = split_number(value)
            return size * (factor_of(written, unit) if written else 1.0)
        return to_si(value, unit)
    except ValueError as error:
        raise InputError(
            f"{where}: received {short(value)}; {error}; write e.g. '1 {unit}'"
        ) from None


class Columns(NamedTuple):
    """A table of two columns, SI."""

    x: Array
    y: Array


def read_columns(path: Path, names: tuple[str, str], units: tuple[str, str]) -> Columns:
    """Read a CSV table of two columns with a header such as ``frequency [Hz], psd [g^2/Hz]``.

    Parameters
    ----------
    path : Path
    names : tuple of str
        What the columns are, for messages.
    units : tuple of str
        SI units; a header without a unit means them.

    Raises
    ------
    InputError
        If it is no such table.
    """
    rows = read_cells(path)
    if len(rows) < 3:
        raise InputError(
            f"{path}: it needs a header such as '{names[0]} [{units[0]}], {names[1]} [{units[1]}]' "
            "and two rows or more"
        )
    factors = _factors(rows[0], names, units, path)
    values = np.array([_row(row, path) for row in rows[1:]]) * factors
    return Columns(values[:, 0], values[:, 1])


def _factors(
    head: Row, names: tuple[str, str], units: tuple[str, str], path: Path
) -> Sequence[float]:
    if len(head.cells) != 2:
        raise InputError(
            f"{path}: header: {len(head.cells)} columns; two are needed: {names[0]}, {names[1]}"
        )
    factors = []
    for cell, unit in zip(head.cells, units, strict=True):
        name, bracket, written = (
            cell.replace("(", "[", 1).partition("[") if "[" not in cell else (cell.partition("["))
        )
        try:
            number(name)
        except ValueError:
            pass
        else:
            raise InputError(
                f"{path}: the first row holds numbers; put a header above them: '{names[0]} "
                f"[{units[0]}], {names[1]} [{units[1]}]'"
            )
        try:
            text = written.strip().removesuffix("]") if "[" in cell else written.strip()[:-1]
            factors.append(factor_of(text, unit) if bracket else 1.0)
        except ValueError as error:
            raise InputError(
                f"{path}: header: column {name.strip()}: {error}; write e.g. [{unit}]"
            ) from None
    return factors


def _row(row: Row, path: Path) -> list[float]:
    try:
        values = [number(cell) for cell in row.cells]
    except ValueError as error:
        raise InputError(f"{path}, line {row.line}: {error}; give two numbers") from None
    if len(values) != 2 or not np.all(np.isfinite(values)):
        raise InputError(f"{path}, line {row.line}: give two finite numbers, one for each column")
    return values
