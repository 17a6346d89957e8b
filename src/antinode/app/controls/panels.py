"""The card whose content is chosen: function, response, effects, ends, stability, comparison."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from nicegui import events, ui

from antinode.app.elements import Picture
from antinode.app.parts import SMALL, enlarge_button
from antinode.app.session import Session

from .response import ResponseFields

TITLES = {
    "characteristic": "Characteristic function",
    "mode": "Forces and energies of a mode",
    "response": "Response",
    "effects": "What each effect does",
    "ends": "End forces side by side",
    "stability": "Stability",
    "compare": "Compare",
}


class PanelChoice:
    """The card and its choice.

    Parameters
    ----------
    session : Session
    note : callable
        Says a sentence about what is wrong.
    """

    def __init__(self, session: Session, note: Callable[[str], None]) -> None:
        self._session, self._note = session, note
        self._pictures: dict[str, Picture] = {}

    def build(self) -> None:
        """Build the card with all its pictures, of which one is shown."""
        titles = dict(TITLES)
        if not self._session.state.is_vehicle:
            del titles["ends"]
        chosen = self._session.state.view.panel
        chosen = chosen if chosen in titles else "characteristic"
        with ui.element("section").classes("an-card an-at-characteristic"):
            with ui.element("div").classes("an-cardhead"):
                words = 'dense borderless options-dense aria-label="What this panel shows"'
                self._choice = ui.select(titles, value=chosen, on_change=self._chosen).props(words)
                self._choice.classes("an-pick an-wide an-titled").mark("panel")
                self._build_compare()
                self._response = ResponseFields(self._session)
                self._copy = ui.button(icon="content_copy", color=None)
                self._copy.props('flat dense round size=sm aria-label="Copy this table"')
                script = "(e) => window.antinode.copyNear(e.currentTarget)"
                self._copy.on("click", js_handler=script)
                enlarge_button("chosen panel")
            for name, title in titles.items():
                role = "img" if name in ("characteristic", "mode") else "region"
                self._pictures[name] = Picture(name, title, role=role)
        self._show(chosen)

    def _build_compare(self) -> None:
        with ui.element("div").classes("an-modes") as self._compare:
            ui.button("Keep", color=None, on_click=self._keep).props(SMALL).mark("keep")
            with ui.button("Back to", color=None).props(SMALL).mark("back-to"):
                self._menu = ui.menu().props("auto-close")
            ui.button("Forget", color=None, on_click=self._session.drop).props(SMALL)

    def _keep(self) -> None:
        name = self._session.keep()
        if not name:
            self._note("The present state is not solved yet; try again in a moment.")
        self._list()

    def _list(self) -> None:
        self._menu.clear()
        with self._menu:
            for name in self._session.snapshots:
                item = ui.menu_item(name, lambda name=name: self._session.go_back(name))
                item.props('role="menuitem"')

    def _chosen(self, event: events.ValueChangeEventArguments[Any]) -> None:
        self._show(str(event.value))
        self._session.look(panel=event.value)

    def choose(self, name: str) -> None:
        """Choose what the card shows."""
        self._choice.value = name

    def _show(self, chosen: str) -> None:
        for name, picture in self._pictures.items():
            picture.set_visibility(name == chosen)
        self._compare.set_visibility(chosen == "compare")
        self._response.button.set_visibility(chosen == "response")
        self._copy.set_visibility(chosen != "characteristic")
        self._list()
