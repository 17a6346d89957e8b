"""What a beam carries: added from a menu, taken out from another."""

from __future__ import annotations

from collections.abc import Callable

from nicegui import ui

from antinode.app.attached import KINDS, added, attached, removed
from antinode.app.session import Session
from antinode.errors import AntinodeError

_BUTTON = "flat dense no-caps size=sm"


class Attachments:
    """Two menus: what can be added, and what can be taken out.

    Parameters
    ----------
    session : Session
    note : callable
        Says a sentence about what is wrong.
    """

    def __init__(self, session: Session, note: Callable[[str], None]) -> None:
        self._session, self._note = session, note
        self._shown: dict[str, str] = {}
        with ui.element("div").classes("an-attach"):
            with ui.button("Attach", icon="add", color=None).props(_BUTTON).mark("attach"):
                menu = ui.menu().props("auto-close")
            with menu:
                for kind in KINDS:
                    item = ui.menu_item(kind.capitalize(), self._adder(kind))
                    item.props('role="menuitem"').mark(f"attach-{kind}")
            self._remove = ui.button("Take out", icon="remove", color=None).props(_BUTTON)
            with self._remove.mark("take-out"):
                self._menu = ui.menu().props("auto-close")

    def refresh(self) -> None:
        """List what is attached now."""
        present = attached(self._session.state)
        self._remove.set_enabled(bool(present))
        if present == self._shown:
            return
        self._shown = present
        self._menu.clear()
        with self._menu:
            for path, name in present.items():
                item = ui.menu_item(name.capitalize(), self._remover(path))
                item.props('role="menuitem"').mark(f"remove-{path}")

    def _adder(self, kind: str) -> Callable[[], None]:
        def add() -> None:
            try:
                changes, number = added(self._session.state, kind)
            except AntinodeError as error:
                self._note(str(error))
                return
            self._session.change(changes)
            place = f"{number.rpartition('.')[0]}.x"
            more = dict.fromkeys((*self._session.state.view.sliders, number, place))
            self._session.look(sliders=tuple(more)[-30:])

        return add

    def _remover(self, path: str) -> Callable[[], None]:
        return lambda: self._session.change(removed(self._session.state, path))
