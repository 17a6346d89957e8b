"""The table of stations, to be edited: a dialog with one row a station."""

from __future__ import annotations

from typing import Any

import numpy as np
from nicegui import ui

from antinode.errors import AntinodeError
from antinode.inputs.reading import COLUMN_UNITS
from antinode.vehicle.case import Case

from .display import System, shown_unit
from .inputs import Problem
from .session import Session


def columns_of(problem: Problem) -> dict[str, np.ndarray]:
    """Return the stations of a problem, column by column [SI]."""
    if isinstance(problem, Case):
        stations = problem.vehicle.stations
        return {"x": stations.x, **{name: column for name, column, _ in stations.columns()}}
    table = problem.table.stations
    every = {name: getattr(table, name) for name in type(table).model_fields}
    return {name: column for name, column in every.items() if column is not None}


def shown_rows(problem: Problem, system: System) -> list[dict[str, float]]:
    """Return the stations row by row, in units of the screen."""
    columns = columns_of(problem)
    factors = {name: unit_of(name, system)[1] for name in columns}
    count = len(columns["x"])
    return [
        {
            "row": k + 1,
            **{n: float(f"{c[k] / factors[n]:.9g}") for n, c in columns.items()},
        }
        for k in range(count)
    ]


def unit_of(name: str, system: System) -> tuple[str, float]:
    """Return name and factor of a column's unit on the screen."""
    shown = shown_unit(COLUMN_UNITS.get(name.partition(":")[0], ""), system)
    return shown.name, shown.factor


def si_table(rows: list[dict[str, Any]], names: list[str], system: System) -> dict[str, list[Any]]:
    """Return edited rows as a table of SI columns; what is no number is left for the check."""
    return {name: [_si(row.get(name), unit_of(name, system)[1]) for row in rows] for name in names}


def _si(value: Any, factor: float) -> Any:
    try:
        return float(f"{float(value) * factor:.12g}")
    except (TypeError, ValueError):
        return str(value)[:60]


class StationsDialog:
    """A dialog that edits the stations of the present problem.

    Parameters
    ----------
    session : Session
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        self._names: list[str] = []
        self._rows: list[dict[str, Any]] = []
        with ui.dialog() as self._dialog, ui.card().classes("an-dialog"):
            ui.label("Stations").classes("an-dialogtitle")
            ui.label(
                "One row a station, x from the nose aft. Change a cell and press Enter; every "
                "change is computed at once and can be undone."
            ).classes("an-hint")
            self._grid = ui.aggrid(
                {"columnDefs": [], "rowData": []}, auto_size_columns=False
            ).classes("an-grid")
            self._grid.on("cellValueChanged", self._edited, ["data", "rowIndex"])
            self._message = ui.label("").classes("an-message").props('role="alert"')
            with ui.row().classes("an-buttons"):
                ui.button("Add row", on_click=self._add).props("flat no-caps")
                ui.button("Remove row", on_click=self._remove).props("flat no-caps")
                ui.space()
                ui.button("Close", on_click=self._dialog.close).props("unelevated no-caps")

    def open(self) -> None:
        """Show the table of the present problem."""
        try:
            problem = self._session.state.problem
        except AntinodeError:
            problem = self._session.state.original
        system = self._session.state.view.units
        self._names = list(columns_of(problem))
        self._rows = shown_rows(problem, system)
        self._grid.options["columnDefs"] = [
            {"field": "row", "headerName": "", "width": 54, "pinned": "left", "editable": False},
            *(self._column(name, system) for name in self._names),
        ]
        self._grid.options["rowData"] = self._rows
        self._grid.options["rowSelection"] = {"mode": "singleRow", "checkboxes": False}
        self._grid.options["stopEditingWhenCellsLoseFocus"] = True
        self._grid.update()
        self._say("")
        self._dialog.open()

    @staticmethod
    def _column(name: str, system: System) -> dict[str, Any]:
        unit = unit_of(name, system)[0]
        return {
            "field": name,
            "colId": name,
            "headerName": f"{name.replace('_', ' ').replace(':', ', ')} [{unit}]",
            "editable": True,
            "minWidth": 110,
            "flex": 1,
            "wrapHeaderText": True,
            "autoHeaderHeight": True,
            "sortable": False,
        }

    def _edited(self, event: Any) -> None:
        row, data = int(event.args["rowIndex"]), event.args["data"]
        if 0 <= row < len(self._rows) and isinstance(data, dict):
            self._rows[row] = {name: data.get(name) for name in ("row", *self._names)}
            self._take()

    async def _add(self) -> None:
        """Put a row behind the chosen one, halfway to the next; at the end, a step further."""
        k = await self._chosen()
        here = self._rows[k]
        after = self._rows[k + 1] if k + 1 < len(self._rows) else None
        step = self._rows[k]["x"] - self._rows[k - 1]["x"]
        x = (here["x"] + after["x"]) / 2 if after else here["x"] + step
        self._rows.insert(k + 1, {**here, "x": float(f"{x:.9g}")})
        self._number()

    async def _remove(self) -> None:
        if len(self._rows) > 2:
            del self._rows[await self._chosen()]
            self._number()

    async def _chosen(self) -> int:
        """Return the index of the selected row; of the last but one without a selection."""
        row = await self._grid.get_selected_row()
        number = int(row["row"]) - 1 if row else len(self._rows) - 2
        return min(max(number, 0), len(self._rows) - 1)

    def _number(self) -> None:
        for k, row in enumerate(self._rows, 1):
            row["row"] = k
        self._grid.options["rowData"] = self._rows
        self._grid.update()
        self._take()

    def _take(self) -> None:
        """Give the edited table to the session, and say what is wrong with it."""
        session = self._session
        table = si_table(self._rows, self._names, session.state.view.units)
        key = "vehicle" if session.state.is_vehicle else "beam"
        session.change({f"{key}.stations": table})
        try:
            _ = session.state.problem
            self._say("")
        except AntinodeError as error:
            self._say(str(error))

    def _say(self, sentence: str) -> None:
        self._message.text = sentence
        self._message.visible = bool(sentence)
