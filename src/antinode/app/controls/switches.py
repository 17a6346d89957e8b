"""The physics as switches: each with its present position, whatever moved it."""

from __future__ import annotations

from nicegui import ui
from nicegui.elements.mixins.value_element import ValueElement

from antinode.app.physics import Switch, changes_of
from antinode.app.session import Session

_MOST_BUTTONS = 3


class Switches:
    """All switches of a problem, built anew where other ones are needed.

    Parameters
    ----------
    session : Session
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        self._shown: dict[str, Switch] = {}
        self._parts: dict[str, ValueElement[str]] = {}
        self._box = ui.element("div").classes("an-switches")

    def refresh(self, wanted: tuple[Switch, ...]) -> None:
        """Show the present positions."""
        if tuple(s.key for s in wanted) != tuple(self._shown):
            self._build(wanted)
        self._shown = {s.key: s for s in wanted}
        for switch in wanted:
            if self._parts[switch.key].value != (switch.position or None):
                self._parts[switch.key].value = switch.position or None

    def _build(self, wanted: tuple[Switch, ...]) -> None:
        self._box.clear()
        self._shown = {s.key: s for s in wanted}
        with self._box:
            self._parts = {switch.key: self._part(switch) for switch in wanted}

    def _part(self, switch: Switch) -> ValueElement[str]:
        name = f'aria-label="{switch.label}"'
        with ui.element("div").classes("an-switch").tooltip(switch.meaning):
            ui.label(switch.label).classes("an-label")
            part: ValueElement[str]
            options = dict(switch.options)
            if len(options) > _MOST_BUTTONS:
                part = ui.select(options, value=switch.position or None)
                part.props(f"dense borderless options-dense {name}").classes("an-pick an-narrow")
            else:
                part = ui.toggle(options, value=switch.position or None)
                part.props(f"dense flat no-caps size=sm {name}")
        part.on_value_change(lambda e: self._set(switch.key, e.value))
        return part.mark(f"switch-{switch.key}")

    def _set(self, key: str, position: str | None) -> None:
        """Take a position that the user has chosen; one that was shown changes nothing."""
        if position is None or position == self._shown[key].position:
            return
        self._shown[key] = self._shown[key]._replace(position=position)
        self._session.change(changes_of(key, position, self._session.state.original))
