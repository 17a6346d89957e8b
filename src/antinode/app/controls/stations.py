"""The dialog that edits the stations: cells take units, blocks are pasted, all can be undone."""

from __future__ import annotations

from typing import Any

from nicegui import ui

from antinode.app.session import Session
from antinode.app.station_table import CellError, StationTable, block_of, columns_of, unit_of
from antinode.errors import AntinodeError

_PASTE = """(e) => {
  const cell = document.activeElement?.closest?.(".ag-cell");
  const text = e.clipboardData?.getData("text/plain") ?? "";
  if (!cell || (e.target.tagName === "INPUT" && !/[\\t\\n]/.test(text.trimEnd()))) return;
  e.preventDefault();
  emit({row: Number(cell.closest(".ag-row").getAttribute("row-index")),
        column: cell.getAttribute("col-id"), text: text.slice(0, 2000000)});
}"""
_ESCAPE = '(e) => { if (e.key === "Escape" && e.target.tagName === "INPUT") e.stopPropagation(); }'
_WRONG = {"an-cellwrong": "data.wrong === colDef.field"}


class StationsDialog:
    """A dialog that edits the stations of the present problem.

    Parameters
    ----------
    session : Session
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        self._table = StationTable((), (), "SI")
        self._row = 0
        self._taken: dict[str, list[float]] = {}
        self._dialog = ui.dialog().props('aria-label="Stations"')
        with self._dialog, ui.card().classes("an-dialog"):
            self._build()

    def _build(self) -> None:
        ui.label("Stations").classes("an-dialogtitle").props('role="heading" aria-level="2"')
        self._hint = ui.label("").classes("an-hint")
        self._grid = ui.aggrid({"columnDefs": [], "rowData": []}, auto_size_columns=False)
        self._grid.classes("an-grid")
        self._grid.on("cellValueChanged", self._edited, ["rowIndex", "colId", "newValue"])
        self._grid.on("cellFocused", self._focused, ["rowIndex"])
        self._grid.on("keydown", js_handler=_ESCAPE)  # in a cell it ends the cell only
        self._grid.on("paste", self._pasted, js_handler=_PASTE)
        self._message = ui.label("").classes("an-message").props('role="alert"')
        with ui.row().classes("an-buttons"):
            ui.button("Add row", on_click=self._add).props("flat no-caps")
            ui.button("Remove row", on_click=self._remove).props("flat no-caps")
            self._undo = ui.button("Take back", on_click=self._session.undo).props("flat no-caps")
            ui.space()
            ui.button("Close", on_click=self._dialog.close).props("unelevated no-caps")

    @property
    def _path(self) -> str:
        return f"{'vehicle' if self._session.state.is_vehicle else 'beam'}.stations"

    def open(self) -> None:
        """Show the table of the present problem."""
        what = "the nose" if self._session.state.is_vehicle else "the left end"
        self._hint.text = (
            f"One row a station, x from {what}. A cell takes a number, with a unit of its own if "
            "you like (90 mm), or a block copied from a spreadsheet. Every change is computed at "
            "once and can be undone."
        )
        self._table, self._row = self._present(), 0
        self._grid.options["columnDefs"] = self._heads()
        self._grid.options["rowData"] = self._table.shown()
        self._grid.options["rowSelection"] = {
            "mode": "singleRow", "checkboxes": False, "enableClickSelection": True,
        }  # fmt: skip
        self._grid.options["stopEditingWhenCellsLoseFocus"] = True
        self._grid.update()
        self._say("")
        self._undo.set_enabled(self._session.history.can_undo)
        self._dialog.open()

    def refresh(self) -> None:
        """Show stations that came from elsewhere: an undo, another unit."""
        self._undo.set_enabled(self._session.history.can_undo)
        if not self._dialog.value:
            return
        elsewhere = self._stored() != self._taken
        present = self._present()
        if present.names != self._table.names or present.system != self._table.system:
            self.open()
        elif elsewhere:
            self._show(present)

    def _stored(self) -> Any:
        """Return the stations that the session was given; nothing where they are the file's."""
        return self._session.state.changes.get(self._path) or {}

    def _present(self) -> StationTable:
        """Return the stations of the present problem, or what was typed if that is wrong."""
        state = self._session.state
        self._taken = self._stored()
        if self._taken:
            return StationTable.of(self._taken, state.view.units)
        try:
            columns = columns_of(state.problem)
        except AntinodeError:
            columns = columns_of(state.original)
        return StationTable.of(columns, state.view.units)

    def _heads(self) -> list[dict[str, Any]]:
        number = {"field": "row", "headerName": "Row", "width": 64, "pinned": "left"}
        return [number, *map(self._head, self._table.names)]

    def _head(self, name: str) -> dict[str, Any]:
        unit = unit_of(name, self._table.system)[0]
        return {
            "field": name,
            "colId": name,
            "headerName": f"{name.replace('_', ' ').replace(':', ', ')} [{unit}]",
            "editable": True,
            "cellDataType": False,
            "cellClassRules": _WRONG,
            "minWidth": 110,
            "flex": 1,
            "wrapHeaderText": True,
            "autoHeaderHeight": True,
            "sortable": False,
        }

    # --- what the user does -------------------------------------------------------------------

    def _focused(self, event: Any) -> None:
        if isinstance(event.args.get("rowIndex"), int):
            self._row = event.args["rowIndex"]

    def _edited(self, event: Any) -> None:
        row, column, text = (event.args.get(key) for key in ("rowIndex", "colId", "newValue"))
        if column in self._table.names and isinstance(row, int) and row < len(self._table.rows):
            self._take(self._table.typed(row, column, "" if text is None else text))

    def _pasted(self, event: Any) -> None:
        row, column = event.args["row"], event.args["column"]
        if column in self._table.names and row < len(self._table.rows):
            self._take(self._table.pasted(row, column, block_of(event.args["text"])))

    def _add(self) -> None:
        """Put a row behind the one that was clicked last."""
        self._row = min(self._row, len(self._table.rows) - 1)
        self._take(self._table.added(self._row))
        self._row += 1

    def _remove(self) -> None:
        """Take out the row that was clicked last."""
        self._row = min(self._row, len(self._table.rows) - 1)
        self._take(self._table.removed(self._row))

    def _take(self, table: StationTable) -> None:
        """Give the edited table to the session, and say what is wrong with it."""
        try:
            columns = table.columns()
        except CellError as error:
            self._show(table, error)
            return
        session = self._session
        self._taken = columns
        session.change({self._path: columns})
        self._show(StationTable.of(columns, table.system))
        try:
            _ = session.state.problem
        except AntinodeError as error:
            self._say(session.words_of(error))

    def _show(self, table: StationTable, wrong: CellError | None = None) -> None:
        """Show a table; the grid keeps its place."""
        self._table = table
        self._grid.run_grid_method("setGridOption", "rowData", table.shown(wrong))
        self._say(str(wrong) if wrong else "")

    def _say(self, sentence: str) -> None:
        self._message.text = sentence
        self._message.visible = bool(sentence)
