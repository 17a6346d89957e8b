"""What response the page shows: fields in a menu beside the curve, and what is wrong with them."""

from __future__ import annotations

from typing import Any, get_args

from nicegui import ui

from antinode.app.asked import Asked, directions
from antinode.app.session import Session
from antinode.errors import InputError
from antinode.inputs.explain import validate
from antinode.response.quantities import Base, Force, QuantityName
from antinode.response.units import in_si

_FIELDS = {
    "force_x": ("force at", "m"),
    "amplitude": ("amplitude", ""),
    "output_x": ("output at", "m"),
    "loss_factor": ("loss factor", ""),
    "ratio": ("damping ratio", ""),
    "low": ("from", "Hz"),
    "high": ("to", "Hz"),
}


_DRIVES = {"force": "force", "base": "supports"}
_DAMPING = {
    "loss_factor": "loss factor",
    "modal": "ratio of modes",
    "rayleigh": "Rayleigh",
}


class ResponseFields:
    """A menu with the force, the output, damping and the band.

    Parameters
    ----------
    session : Session
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        asked = session.state.view.response
        self._fields: dict[str, ui.input] = {}
        button = ui.button(icon="tune", color=None).mark("response-fields")
        button.props('flat dense round size=sm aria-label="Force, output, damping and band"')
        with button:
            menu = ui.menu().props('role="dialog" aria-label="Response"')
        with menu, ui.element("div").classes("an-asked"):
            self._drive = self._choice("drive", _DRIVES)
            self._field("force_x", asked)
            self._direction = self._choice("direction", directions(session.state.beam))
            self._field("amplitude", asked)
            self._field("output_x", asked)
            named = [name for name in get_args(QuantityName) if not name.startswith("reaction")]
            self._quantity = self._choice("quantity", named)
            self._damping = self._choice("damping", _DAMPING)
            for name in ("loss_factor", "ratio", "low", "high"):
                self._field(name, asked)
            self._message = ui.label("").classes("an-message").props('role="alert"')
            self._message.visible = False
        self._show_what_counts()
        self.button = button

    def _show_what_counts(self) -> None:
        """Hide the fields that what is chosen does not read."""
        self._fields["force_x"].visible = self._drive.value == "force"
        self._fields["loss_factor"].visible = self._damping.value == "loss_factor"
        self._fields["ratio"].visible = self._damping.value != "loss_factor"

    def _field(self, name: str, asked: Asked) -> None:
        label, unit = _FIELDS[name]
        value = getattr(asked, name)
        text = "" if value is None else f"{value:.12g}"
        named = f"{label} [{unit}]" if unit else label
        field = ui.input(named, value=text).props(f'dense outlined aria-label="response: {label}"')
        field.props('maxlength=40 stack-label placeholder="by itself"').classes("an-small")
        field.on("keydown.enter", self._take)
        field.on("blur", self._take)
        self._fields[name] = field.mark(f"asked-{name}")

    def _choice(self, name: str, words: list[Any] | dict[str, str]) -> ui.select:
        options = words if isinstance(words, dict) else {w: str(w).replace("_", " ") for w in words}
        asked = getattr(self._session.state.view.response, name)
        value = asked if asked in options else next(iter(options))
        choice = ui.select(options, value=value, label=name, on_change=self._take)
        choice.props(f'dense outlined options-dense aria-label="response: {name}"')
        return choice.classes("an-choice").mark(f"asked-{name}")

    def _take(self) -> None:
        """Take what the fields say, or say what is wrong with it."""
        told = {name: str(field.value or "").strip() for name, field in self._fields.items()}
        table: dict[str, Any] = {name: text for name, text in told.items() if text}
        self._show_what_counts()
        direction, drive = self._direction.value, self._drive.value
        try:
            if "amplitude" in table:
                unit = Force(0.0, direction).unit if drive == "force" else Base(direction).unit
                table["amplitude"] = in_si(table["amplitude"], unit, "amplitude")
            table |= {"direction": direction, "quantity": self._quantity.value}
            table |= {"drive": drive, "damping": self._damping.value}
            asked = validate(Asked, table, "the response")
        except InputError as error:
            self._message.text, self._message.visible = str(error), True
            return
        self._message.visible = False
        if asked != self._session.state.view.response:
            self._session.look(response=asked.model_dump())
