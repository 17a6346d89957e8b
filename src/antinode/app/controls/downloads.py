"""What can be saved of a page: its case, its results, the report on it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from nicegui import ui

from antinode.app.save import case_toml, report_file, result_file
from antinode.app.session import Session
from antinode.errors import AntinodeError


class Downloads:
    """The menu of files to save.

    Parameters
    ----------
    session : Session
    note : callable
        Says a sentence about what is wrong.
    """

    def __init__(self, session: Session, note: Callable[[str], None]) -> None:
        self._session, self._note = session, note

    def build_menu(self) -> None:
        """Build the entries of the menu."""
        ui.menu_item("The case, as TOML", self._save_case).props('role="menuitem"')
        ui.separator()
        for ending, what in ((".csv", "table"), (".json", "all numbers"), (".nc", "shapes")):
            ui.menu_item(f"Results, {ending} ({what})", self._saver(ending)).props(
                'role="menuitem"'
            )
        ui.separator()
        for ending in (".html", ".pdf"):
            ui.menu_item(f"The report, {ending}", self._reporter(ending)).props('role="menuitem"')

    def _save_case(self) -> None:
        try:
            text = case_toml(self._session.state)
        except AntinodeError as error:
            self._note(str(error))
            return
        ui.download.content(text, "case.toml" if self._session.state.is_vehicle else "beam.toml")

    def _saver(self, ending: str) -> Callable[[], Any]:
        async def save() -> None:
            try:
                content = result_file(await self._session.full(), ending)
            except AntinodeError as error:
                self._note(str(error))
                return
            ui.download.content(content, f"modes{ending}")

        return save

    def _reporter(self, ending: str) -> Callable[[], Any]:
        async def save() -> None:
            ui.notify("The report is being written …", position="bottom-right")
            state = self._session.state
            try:
                content = await self._session.run(lambda: report_file(state, ending))
            except AntinodeError as error:
                self._note(str(error))
                return
            ui.download.content(content, f"report{ending}")

        return save
