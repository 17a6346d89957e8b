"""The column of inputs: a slider and a field with a unit for each, and what is wrong beside it."""

from __future__ import annotations

import math

from nicegui import events, ui

from antinode.app.display import number_text
from antinode.app.elements import Slider, TextField
from antinode.app.inputs import Input
from antinode.app.session import Session
from antinode.app.state import Value
from antinode.vehicle.case import Case
from antinode.vehicle.hydrodynamics.cavitation_number import resolve_cavitation


class Field:
    """One input: label, field, slider, message.

    Parameters
    ----------
    item : Input
    session : Session
    """

    def __init__(self, item: Input, session: Session) -> None:
        self.item, self._session = item, session
        self.unit = item.shown(session.state.view.units)
        self._anchor = self._of(item.value)
        self._step = nice_step(self._of(item.high) - self._of(item.low))
        self._ends = self._grid(item)
        named = f"{item.label} [{self.unit.name}]" if self.unit.name else item.label
        with ui.element("div").classes("an-field") as self._box:
            with ui.element("div").classes("an-fieldhead"):
                ui.label(item.label).classes("an-label").tooltip(item.path)
                if item.path in session.state.view.sliders:
                    self._build_remover()
                self._text = (
                    TextField(self._shown(item.value))
                    .props(f'dense borderless aria-label="{named}" suffix="{self.unit.name}"')
                    .props('input-class="an-number" maxlength=60')
                    .classes("an-input an-longunit" if len(self.unit.name) > 6 else "an-input")
                    .mark(f"field-{item.path}")
                )
            self._slider = (
                Slider(self._of(item.value), *self._ends, self._step)
                .props(f'dense aria-label="{named}"')
                .mark(f"slider-{item.path}")
                .classes("an-slider")
            )
            self._slider.props("thumb-size=14px track-size=3px")
            self._message = ui.label("").classes("an-message").props('role="alert"')
            self._message.visible = False
        self._there = self._of(item.value)  # where the slider stands in the browser
        self._taken = ""  # what was typed last, so that leaving the field does not take it again
        self._editing = False
        self._text.on("focus", self._focused, [])
        self._text.on("keydown.enter", self._typed, [])
        self._text.on("blur", self._left, [])
        self._slider.on_value_change(self._slid)
        self._slider.on("change", self._released, [None])

    def _build_remover(self) -> None:
        """Build the button that takes away a slider that was added."""
        button = ui.button(icon="close", color=None, on_click=self._taken_away)
        button.props(f'flat dense round size=xs aria-label="Take away {self.item.label}"')
        button.classes("an-remover")

    def _taken_away(self) -> None:
        rest = (path for path in self._session.state.view.sliders if path != self.item.path)
        self._session.look(sliders=tuple(rest))

    def _grid(self, item: Input) -> tuple[float, float]:
        """Return ends of the slider such that the value it was built with is on its grid."""
        low = self._of(item.low)
        steps = math.ceil((self._anchor - low) / self._step - 1e-9)
        return float(f"{self._anchor - steps * self._step:.9g}"), self._of(item.high)

    def _of(self, value: float) -> float:
        return float(f"{self.unit.of(value):.6g}")

    def _shown(self, value: float) -> str:
        return number_text(self.unit.of(value))

    def _slid(self) -> None:
        self._move(self._slider.value)

    def _move(self, value: float | None) -> None:
        """Take where the browser says that the slider stands."""
        if value is None:
            return
        self._there = value
        if value == self._of(self.item.value):
            return
        new = float(f"{value * self.unit.factor:.12g}")
        new = min(max(new, self.item.low), self.item.high)
        self.item = self.item._replace(value=new)
        self._text.value = self._shown(new)
        self._session.change({self.item.path: new}, moving=self.item.path)

    def _released(self, event: events.GenericEventArguments) -> None:
        """End the move where it was let go: throttled events may still be on their way."""
        if isinstance(event.args, int | float):
            self._move(event.args)
        self._session.release()

    def _focused(self) -> None:
        self._editing = True

    def _left(self) -> None:
        self._editing = False
        if str(self._text.value or "").strip() != self._taken:
            self._typed()

    def _typed(self) -> None:
        self._editing = False
        self._taken = text = str(self._text.value or "").strip()
        if text == self._shown(self.item.value) and not self._message.visible:
            return
        try:
            value: Value = float(f"{float(text) * self.unit.factor:.12g}")
        except ValueError:
            value = text
        self._session.change({self.item.path: value})

    def refresh(self, item: Input, moving: bool) -> None:
        """Show a value that came from elsewhere."""
        self.item = item
        if moving:
            return
        value = self._of(item.value)
        self._ends = self._grid(item)
        for key, end in zip(("min", "max"), self._ends, strict=True):
            if self._slider.props[key] != end:
                self._slider.props[key] = end
        if self._there != value:  # nothing is sent back of what the browser has said itself
            self._there = self._slider.value = value
        if not self._editing and self._text.value != self._shown(item.value):
            self._text.value = self._shown(item.value)

    def complain(self, sentence: str) -> None:
        """Mark the field as wrong, or as right again."""
        if self._message.text == sentence:
            return
        self._message.text = sentence
        self._message.visible = bool(sentence)
        self._box.classes(add="an-wrong" if sentence else "", remove="" if sentence else "an-wrong")
        self._text.props(f'aria-invalid="{str(bool(sentence)).lower()}"')


def nice_step(width: float) -> float:
    """Return 1, 2 or 5 times a power of ten, of which 100 to 250 make the width."""
    least = width / 250
    power = 10.0 ** math.floor(math.log10(least))
    return next(float(f"{n * power:.1e}") for n in (1, 2, 5, 10) if n * power >= least * (1 - 1e-9))


class Fields:
    """All inputs of a problem, rebuilt when other inputs are wanted.

    Parameters
    ----------
    session : Session
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        self._fields: dict[str, Field] = {}
        self._kind: tuple[object, ...] = ()
        self._box = ui.element("div").classes("an-fields")

    def refresh(self, items: tuple[Input, ...], moving: str) -> None:
        """Show the present values; build the fields anew where other ones are needed."""
        view = self._session.state.view
        kind = (*(item.path for item in items), *view.sliders, view.units)
        if kind != self._kind:
            self._build(items)
            self._kind = kind
        for item in items:
            self._fields[item.path].refresh(item, item.path == moving)

    def _build(self, items: tuple[Input, ...]) -> None:
        self._box.clear()
        self._fields.clear()
        with self._box:
            for item in items:
                if item.path in ("condition.cavitation_number", "condition.depth"):
                    self._switch(item.path)
                self._fields[item.path] = Field(item, self._session)
            self._other = ui.label("").classes("an-message an-other").props('role="alert"')
            self._other.visible = False

    def _switch(self, path: str) -> None:
        """Let the user choose between cavitation number and depth."""
        options = {"condition.cavitation_number": "number σ", "condition.depth": "depth"}
        with ui.element("div").classes("an-switch"):
            ui.label("Cavity by").classes("an-hint")
            ui.toggle(options, value=path, on_change=lambda e: self._swap(str(e.value))).props(
                'dense flat no-caps size=sm aria-label="give cavitation number or depth"'
            ).mark("cavitation")

    def _swap(self, path: str) -> None:
        """Give depth in place of the cavitation number, or the other way; nothing else changes."""
        answer = self._session.answer
        if answer is not None and answer.case is not None:
            self._session.change(swapped_cavitation(answer.case, path))

    def complain(self, path: str, sentence: str) -> None:
        """Say what is wrong at its field, or below all of them."""
        for name, field in self._fields.items():
            field.complain(sentence if name == path else "")
        if self._fields:
            elsewhere = sentence if path not in self._fields else ""
            self._other.text = elsewhere
            self._other.visible = bool(elsewhere)


def swapped_cavitation(case: Case, path: str) -> dict[str, Value]:
    """Return changes that give the same state by cavitation number, or by depth and pressure."""
    sigma = case.loads.sigma
    if path == "condition.cavitation_number":
        return {path: sigma, "condition.depth": None, "condition.cavity_pressure": None}
    state, water = resolve_cavitation(case.condition, case.water), case.water
    depth = state.depth if state.depth is not None else 10.0
    static = water.atmospheric_pressure + water.density * water.gravity * depth
    pressure = static - sigma * water.density * case.condition.speed**2 / 2
    if pressure < 0:  # deeper, so that the pressure in the cavity is the vapour pressure
        pressure = water.vapour_pressure
        depth += (sigma * water.density * case.condition.speed**2 / 2 + pressure - static) / (
            water.density * water.gravity
        )
    return {
        "condition.cavitation_number": None,
        "condition.depth": float(f"{depth:.6g}"),
        "condition.cavity_pressure": float(f"{pressure:.9g}"),
    }
