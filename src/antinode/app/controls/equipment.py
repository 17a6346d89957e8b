"""The equipment's band, lines of excitation and a margin, as fields and as numbers."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from nicegui import ui

from antinode.app.session import Session
from antinode.errors import InputError


class EquipmentFields:
    """Fields for band, lines and margin, and what is wrong with them.

    Parameters
    ----------
    session : Session
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        view = session.state.view
        low, high = (f"{v:g}" for v in view.band) if view.band else ("", "")
        lines = ", ".join(f"{v:g}" for v in view.lines)
        with ui.element("div").classes("an-four"):
            self._band = [
                _small_field(label, value, self._take)
                for label, value in (("from", low), ("to", high))
            ]
            self._lines = _small_field("lines", lines, self._take)
            self._margin = _small_field("± %", f"{100 * view.margin:g}", self._take)
        self._message = ui.label("").classes("an-message").props('role="alert"')
        self._message.visible = False

    def _take(self) -> None:
        """Take band, lines and margin, or say what is wrong with them."""
        try:
            how = equipment(
                *(str(field.value or "") for field in (*self._band, self._lines, self._margin))
            )
        except InputError as error:
            self._message.text = str(error)
            self._message.visible = True
            return
        self._message.visible = False
        self._session.look(**how)


def _small_field(label: str, value: str, taken: Callable[[], None]) -> ui.input:
    field = ui.input(label, value=value).props(f'dense outlined aria-label="{label}" maxlength=80')
    field.on("keydown.enter", taken)
    field.on("blur", taken)
    return field.classes("an-small").mark(label.partition(" [")[0])


def equipment(low: str, high: str, lines: str, margin: str) -> dict[str, Any]:
    """Read band [Hz], excitation lines [Hz] and margin [%] as they were typed.

    Raises
    ------
    InputError
        If one of them is wrong.
    """
    ends = [_hertz("equipment band", text) for text in (low, high) if text.strip()]
    if len(ends) == 1:
        raise InputError("equipment band: one end is missing; give both, or none")
    if len(ends) == 2 and ends[0] >= ends[1]:
        raise InputError(f"equipment band: {low} to {high} Hz is empty; give the lower end first")
    found = [
        _hertz("excitation lines", text)
        for text in lines.replace(";", ",").split(",")
        if text.strip()
    ]
    share = _hertz("margin", margin.replace("%", "") or "0") / 100
    if share > 0.5:
        raise InputError(f"margin: received {margin} %; at most 50 % is allowed")
    return {"band": tuple(ends) or None, "lines": tuple(found), "margin": share}


def _hertz(what: str, text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0 <= value < 1e6:
        raise InputError(f"{what}: received '{text.strip()[:30]}'; give a number of at least 0")
    return value
