"""Columns of numbers in tables of stations: read with their units, and checked row by row."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import core_schema

from antinode.arrays import Array
from antinode.text import counted

from .units import to_si


@dataclass(frozen=True)
class Column:
    """Marks an array of a pydantic model as a column of numbers in an SI unit."""

    unit: str

    def read(self, value: object) -> Array:
        """Return a read-only float array [unit] from an array or a list (strings with units too).

        Raises
        ------
        ValueError
            If the value is no list, or a row is no number with a unit of the right dimension.
        """
        if not isinstance(value, np.ndarray | list | tuple):
            raise ValueError("needs a list of numbers, one for each station")
        column = np.array([self._row(i, item) for i, item in enumerate(value, 1)], dtype=float)
        column.setflags(write=False)
        return column

    def _row(self, row: int, item: Any) -> float:
        try:
            return to_si(item.item() if isinstance(item, np.generic) else item, self.unit)
        except ValueError as error:
            raise ValueError(f"row {row}: received {str(item)[:40]!r}; {error}") from error

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> core_schema.CoreSchema:
        return core_schema.no_info_plain_validator_function(
            self.read,
            serialization=core_schema.plain_serializer_function_ser_schema(np.ndarray.tolist),
        )

    def __get_pydantic_json_schema__(
        self, schema: core_schema.CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        unit = self.unit or "1"
        items = {"type": ["number", "string"], "description": f"SI number [{unit}], or a text"}
        return {"type": "array", "minItems": 2, "items": items, "unit": unit}


def increasing(x: Array) -> None:
    """Raise ValueError unless x rises from row to row, in two rows at least."""
    if len(x) < 2:
        raise ValueError(
            f"x: received {counted(len(x), 'row')}; a table of stations needs at least two"
        )
    finite("x", x)
    for i in np.flatnonzero(np.diff(x) <= 0)[:1]:
        rows = f"x: rows {i + 1} and {i + 2}: received {x[i]:.10g}, then {x[i + 1]:.10g} m"
        if x[i] == x[i + 1]:
            raise ValueError(f"{rows}; x must increase: remove one of the duplicate rows")
        raise ValueError(f"{rows}; x must increase from the nose aft: sort the rows by x")


def finite(name: str, column: Array) -> None:
    """Raise ValueError at the first row that is no finite number."""
    for i in np.flatnonzero(~np.isfinite(column))[:1]:
        raise ValueError(f"{name}, row {i + 1}: received {column[i]}; fill in a finite number")


def positive(name: str, column: Array, unit: str) -> None:
    """Raise ValueError at the first row that is not above zero."""
    for i in np.flatnonzero(~(column > 0))[:1]:
        wrong = f"{name}, row {i + 1}: received {column[i]:.10g}"
        raise ValueError(f"{wrong}; must be greater than 0 {unit}: correct this row")


def both_or_neither(table: object, one: str, other: str) -> None:
    """Raise ValueError if a table has only one of two columns that need each other."""
    given = {name: getattr(table, name) is not None for name in (one, other)}
    if given[one] != given[other]:
        there, absent = (one, other) if given[one] else (other, one)
        raise ValueError(f"{there} is given, but {absent} is missing: give both, or neither")


def with_closed_stations(table: Any) -> Any:
    """Return a table whose stepped columns may have one value for each interval, with the last row.

    The last row of a stepped table is not used: where every column but x is one shorter than x, its
    last value is repeated.
    """
    stations = table.get("stations") if isinstance(table, dict) else None
    if not isinstance(stations, dict) or table.get("interpolation", "step") != "step":
        return table
    if not all(isinstance(column, list) for column in stations.values()) or "x" not in stations:
        return table
    intervals = len(stations["x"]) - 1
    if intervals < 1 or {len(c) for key, c in stations.items() if key != "x"} != {intervals}:
        return table
    closed = {key: c if key == "x" else [*c, c[-1]] for key, c in stations.items()}
    return {**table, "stations": closed}


def dropped_row(
    interpolation: str, x: Array, columns: Iterable[tuple[str, Array]], units: Mapping[str, str]
) -> str:
    """Say that a stepped table does not use its last row although it differs from the one before.

    Parameters
    ----------
    interpolation : str
    x : array
        Stations [m].
    columns : iterable
        Names and values of what stands at them.
    units : mapping
        Of the columns; without them the numbers are left out.

    Returns
    -------
    str
        Empty where nothing is lost.
    """
    differing = ((name, c[-2], c[-1]) for name, c in columns if c[-1] != c[-2])
    name, before, last = next(differing, ("", 0.0, 0.0))
    if interpolation != "step" or not name:
        return ""
    lost = f"{name} stays that of the row before up to the end"
    if units:
        lost = f"{name} stays {before:g} up to the end, not {last:g} {units[name]}"
    return (
        f"the last row of the table, at x = {x[-1]:g} m, is not used: with interpolation = 'step', "
        f"the default, a row holds up to the next one, so {lost}; set interpolation = 'linear' if "
        "values run straight between the rows, else repeat the row before"
    )
