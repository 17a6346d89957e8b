"""The table of stations as a value: what its cells show, what was typed into them, pasted blocks.

Pure: no browser. A table holds texts and numbers in units of the screen; it becomes SI columns when
every cell can be read.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np

from antinode.inputs.reading import COLUMN_UNITS
from antinode.inputs.units import to_si
from antinode.inputs.written import number
from antinode.vehicle.case import Case

from .display import System, shown_unit
from .inputs import Problem

Cell = float | str
_MOST_ROWS = 100_000


def columns_of(problem: Problem) -> dict[str, np.ndarray]:
    """Return the stations of a problem, column by column [SI]."""
    if isinstance(problem, Case):
        stations = problem.vehicle.stations
        return {"x": stations.x, **{name: column for name, column, _ in stations.columns()}}
    table = problem.table.stations
    every = {name: getattr(table, name) for name in type(table).model_fields}
    found = {name: column for name, column in every.items() if column is not None}
    return {"x": found.pop("x"), **found}


def unit_of(name: str, system: System) -> tuple[str, float]:
    """Return name and factor of a column's unit on the screen."""
    shown = shown_unit(COLUMN_UNITS.get(name.partition(":")[0], ""), system)
    return shown.name, shown.factor


class CellError(ValueError):
    """A cell that cannot be read: its row and column, and why."""

    def __init__(self, row: int, column: str, why: str) -> None:
        super().__init__(f"row {row + 1}, {column.replace('_', ' ')}: {why}")
        self.row, self.column = row, column


@dataclass(frozen=True)
class StationTable:
    """Stations as they stand on the screen.

    Parameters
    ----------
    names : tuple of str
        Of the columns.
    rows : tuple of tuple
        Numbers in the units of the screen, or texts as they were typed.
    system : str
    """

    names: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]
    system: System

    @classmethod
    def of(cls, columns: Mapping[str, Sequence[Any] | np.ndarray], system: System) -> Self:
        """Make a table of SI columns; what is no number is shown as it is."""
        shown = [
            [_shown(value, unit_of(name, system)[1]) for value in values]
            for name, values in columns.items()
        ]
        return cls(tuple(columns), tuple(zip(*shown, strict=False)), system)

    def typed(self, row: int, column: str, text: object) -> Self:
        """Return the table after something was typed into a cell."""
        return self.pasted(row, column, [[str(text)]])

    def pasted(self, row: int, column: str, block: list[list[str]]) -> Self:
        """Return the table after a block was pasted, its first value into a cell.

        Rows are added below where the block is longer; columns beyond the last are left out.
        """
        first = self.names.index(column)
        rows = [list(cells) for cells in self.rows]
        for k, texts in enumerate(block[: _MOST_ROWS - row]):
            if row + k == len(rows):
                rows.append(list(rows[-1]))
            for j, text in enumerate(texts[: len(self.names) - first]):
                rows[row + k][first + j] = text.strip()[:80]
        return replace(self, rows=tuple(map(tuple, rows)))

    def added(self, row: int) -> Self:
        """Return the table with a row behind a given one, halfway to the next, or a step on."""
        k = self.names.index("x")
        here = list(self.rows[row])
        try:
            x = [float(cells[k]) for cells in self.rows]
        except ValueError:
            x = []
        if x:
            last = row + 1 == len(x)
            new = 2 * x[row] - x[row - 1] if last else (x[row] + x[row + 1]) / 2
            here[k] = float(f"{new:.9g}")
        rows = (*self.rows[: row + 1], tuple(here), *self.rows[row + 1 :])
        return replace(self, rows=rows)

    def removed(self, row: int) -> Self:
        """Return the table without a row; two stay at the least."""
        if len(self.rows) <= 2:
            return self
        return replace(self, rows=(*self.rows[:row], *self.rows[row + 1 :]))

    def columns(self) -> dict[str, list[float]]:
        """Return the SI columns.

        Raises
        ------
        CellError
            If a cell is no number, or its unit is not one of the column.
        """
        factors = [unit_of(name, self.system)[1] for name in self.names]
        return {
            name: [self._si(k, cells[j], name, factors[j]) for k, cells in enumerate(self.rows)]
            for j, name in enumerate(self.names)
        }

    def _si(self, row: int, cell: Cell, name: str, factor: float) -> float:
        unit = COLUMN_UNITS.get(name.partition(":")[0], "")
        try:
            try:
                value = number(str(cell)) * factor
            except ValueError as error:
                if "may be" in str(error):
                    raise
                value = to_si(str(cell), unit)
        except ValueError as error:
            raise CellError(row, name, f"received '{cell}'; {error}") from None
        return float(f"{value:.12g}")

    def shown(self, wrong: CellError | None = None) -> list[dict[str, Any]]:
        """Return the rows for the grid; `wrong` marks a cell."""
        rows: list[dict[str, Any]] = [
            {"row": k + 1, **dict(zip(self.names, cells, strict=True))}
            for k, cells in enumerate(self.rows)
        ]
        if wrong is not None:
            rows[wrong.row]["wrong"] = wrong.column
        return rows


def _shown(value: Any, factor: float) -> Cell:
    try:
        return float(f"{float(value) / factor:.9g}")
    except (TypeError, ValueError):
        return str(value)[:80]


def block_of(text: str) -> list[list[str]]:
    """Return the cells of a text that a spreadsheet has put on the clipboard."""
    lines = text.replace("\r\n", "\n").replace("\r", "\n").rstrip("\n").split("\n")
    return [line.split("\t") for line in lines]
