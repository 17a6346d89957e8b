"""The page: head, inputs on the left, pictures in a grid; what each control does.

Everything is built once; afterwards only data travel. Colours, type and layout are in
static/app.css, what is drawn in a picture in the scripts beside it.
"""

from __future__ import annotations

from collections.abc import Callable, Coroutine
from typing import Any

from nicegui import events, ui
from nicegui.client import Client
from nicegui.elements.mixins.value_element import ValueElement

from antinode.beam.families import FAMILIES, FamilyName
from antinode.errors import AntinodeError
from antinode.examples import EXAMPLES

from .compute import wanted_modes
from .controls.attach import Attachments
from .controls.downloads import Downloads
from .controls.equipment import EquipmentFields
from .controls.fields import Fields
from .controls.more import MoreSliders
from .controls.panels import PanelChoice
from .controls.stations import StationsDialog
from .controls.switches import Switches
from .display import SYSTEMS
from .elements import Board, Picture, style_sheet
from .inputs import Input, find_input, numbers, sliders
from .parts import SMALL, card, head_button, section
from .physics import switches
from .session import Session
from .source import read_dropped, read_example
from .state import State
from .uploads import register

_LETTERS = {"theta": "θ", "phi": "φ", "Q_x": "Q", "Q_y": "Q"}


SHORTCUTS = {
    "← →": "move the slider that has the focus",
    "Tab": "go to the next control",
    "Enter": "take what was typed",
    "Ctrl Z": "undo",
    "P": "pin the frequencies, or take the pin out",
    "V": "let the modes vibrate",
}
"""What keys do, as the page lists it."""
EXAMPLE_WORDS = {
    "starter": "a vehicle in its cavity",
    "paper": "the vehicle of the paper",
    "beam": "a stepped mast, pressed by cables",
    "drawing": "a tower of tubes, by diameter and wall",
    "tower": "a tapered tube with a nacelle",
    "rocket": "free, under thrust",
    "drill_string": "taut above, pushed below",
    "shaft": "two discs on elastic bearings",
    "response": "a free body of aluminium tube",
}
"""What each example is."""


def _components(family: FamilyName) -> dict[int, str]:
    """Return the quantities of a family by their place, as the page writes them."""
    symbols = [quantity.symbol for quantity in FAMILIES[family].quantities]
    return {k: _LETTERS.get(symbol, symbol) for k, symbol in enumerate(symbols)}


class Page:
    """One open page.

    Parameters
    ----------
    state : State
        What it shows first.
    complaint : str
        What was wrong with the link that opened it; empty if nothing.
    """

    def __init__(self, state: State, complaint: str = "") -> None:
        ui.add_css(style_sheet())
        self._client: Client = ui.context.client
        self._dark = ui.dark_mode(state.view.dark)
        self._system_dark = False
        self.session = Session(state, self)
        self._downloads = Downloads(self.session, self._note)
        self._playing = False
        with ui.element("div").classes("an-app"):
            self._board = Board(self._client.id)
            self._board.on("ready", self._ready)
            self._board.on("refused", lambda e: self._note(str(e.args)))
            self._board.on("moved", self._moved)
            self._board.on("chosen", self._choose)
            self._board.on("told", lambda e: self._tell(str(e.args)))
            self._board.on("released", self.session.release)
            self._board.on("asked", self._asked)
            self._head = ui.element("header").classes("an-head")
            Picture("strip", "Frequencies in short", role="region").classes("an-strip")
            self._side = ui.element("aside").classes("an-side").props('aria-label="Inputs"')
            self._main = ui.element("div").classes("an-main").props('aria-label="Results"')
            self._main.props('role="region"')
        register(self._client.id, self)
        self._stations = StationsDialog(self.session)
        self._build()
        ui.keyboard(on_key=self._key)
        if complaint:
            self._note(complaint)

    # --- what the session asks for ----------------------------------------------------------

    def apply(self, patch: dict[str, Any]) -> None:
        """Send new data to the pictures."""
        self._board.apply(patch)

    def refresh(self, problem_inputs: tuple[Input, ...], moving: str) -> None:
        """Show the present values in the fields."""
        with self._client:
            self._fields.refresh(problem_inputs, moving)
            if not moving:
                self._refresh_lists()
            self._undo.set_enabled(self.session.history.can_undo)
            pinned = bool(self.session.state.view.baseline)
            self._pin.text = "Unpin" if pinned else "Pin"
            self._stations.refresh()

    def _refresh_lists(self) -> None:
        """Offer what there is now; while a slider moves that may wait until it is let go."""
        state = self.session.state
        self._more.refresh()
        self._name_curve()
        self._switches.refresh(switches(state.problem, state.beam, state.original))
        if self._attachments is not None:
            self._attachments.refresh()

    def complain(self, path: str, sentence: str) -> None:
        """Mark what is wrong at its field."""
        with self._client:
            self._fields.complain(path, sentence)
            self._undo.set_enabled(self.session.history.can_undo)
            self._stations.refresh()

    def rebuild(self) -> None:
        """Build head, side and pictures anew for another file."""
        with self._client:
            self._build()

    # --- building ---------------------------------------------------------------------------

    def _build(self) -> None:
        """Build head, side and pictures for the present file."""
        for box in (self._head, self._side, self._main):
            box.clear()
        vehicle = self.session.state.is_vehicle
        with self._head:
            self._build_head()
        with self._side:
            self._build_side()
        with self._main:
            self._build_pictures(vehicle)

    def _build_head(self) -> None:
        state = self.session.state
        ui.html('<span class="an-logo" aria-hidden="true"></span>', sanitize=False)
        ui.label("antinode").classes("an-wordmark")
        name = _name(state)
        ui.label(name).classes("an-casename").props('role="heading" aria-level="1"')
        what = "vehicle in motion" if state.is_vehicle else "beam"
        ui.label(f"{state.file.origin} · {what}").classes("an-origin")
        ui.space()
        with head_button("Open", "folder_open"), ui.menu().props("auto-close"):
            item = ui.menu_item("A file … (or drop it on the page)", self._board.choose)
            item.props('role="menuitem"')
            ui.separator()
            for example in (e for e, run in EXAMPLES.items() if "sweep" not in run):
                words = f"Example: {example.replace('_', ' ')}, {EXAMPLE_WORDS[example]}"
                item = ui.menu_item(words, self._opener(example)).props('role="menuitem"')
                item.mark(f"example-{example}")
        head_button("Stations", "table_rows", self._stations.open)
        self._undo = head_button("Undo", "undo", self.session.undo)
        with head_button("Save", "download"), ui.menu().props("auto-close"):
            self._downloads.build_menu()
        head_button("Link", "link", self._copy_link)
        self._build_shortcuts()
        ui.separator().props("vertical").classes("an-rule")
        ui.select(list(SYSTEMS), value=state.view.units, on_change=self._units).props(
            'dense borderless options-dense aria-label="Units"'
        ).classes("an-units").mark("units")
        dark = ui.button(icon="dark_mode", color=None, on_click=self._toggle_dark)
        dark.props('flat dense round aria-label="Dark or light"').mark("dark")

    def _build_shortcuts(self) -> None:
        """List the keys that do something."""
        keys = ui.button(icon="keyboard", color=None)
        keys.props('flat dense round aria-label="Keys"').mark("keys")
        with keys:
            menu = ui.menu().props('role="dialog" aria-label="Keys"')
        with menu, ui.element("dl").classes("an-keys"):
            for key, what in SHORTCUTS.items():
                with ui.element("dt"):
                    ui.label(key)
                with ui.element("dd"):
                    ui.label(what)

    def _build_side(self) -> None:
        vehicle = self.session.state.is_vehicle
        with section("Condition" if vehicle else "Loads and attachments"):
            hint = "Move a slider, or type a number, with its own unit if you like."
            ui.label(hint).classes("an-hint")
            self._fields = Fields(self.session)
            self._more = MoreSliders(self.session)
            self._attachments = None if vehicle else Attachments(self.session, self._note)
        with section("Physics" if vehicle else "Ends and physics"):
            self._switches = Switches(self.session)
        with section("Equipment band and excitation [Hz]"):
            EquipmentFields(self.session)
        with ui.element("section").classes("an-section an-notes"):
            Picture("notes", "Results, warnings and ranges of validity", role="region")

    def _build_pictures(self, vehicle: bool) -> None:
        families = self.session.state.families
        if self.session.state.view.family not in families:  # that of another file
            self.session.look(family=families[0], component=0)
        view = self.session.state.view
        title = "Vehicle in its cavity, to scale, with the forces on it"
        with card("vehicle", title) if vehicle else card("beam", "Beam with what it carries"):
            if not vehicle:
                ui.label("drag a mark along the beam").classes("an-hint")
        with card("frequencies", "Frequencies"):
            names = {name: name.capitalize() for name in families}
            chosen: ValueElement[Any]
            if len(names) > 2:  # there is no room for as many buttons
                chosen = ui.select(names, value=view.family).classes("an-pick an-narrow")
                chosen.props('dense borderless options-dense aria-label="Family of modes"')
            else:
                chosen = ui.toggle(names, value=view.family).props(SMALL)
            chosen.on_value_change(lambda e: self._family(e.value))
            chosen.mark("family")
            copy = ui.button(icon="content_copy", color=None)
            copy.props('flat dense round size=sm aria-label="Copy the table"').mark("copy")
            copy.on("click", js_handler="() => window.antinode.copy('frequencies')")
            self._pin = ui.button("Pin", color=None, on_click=self.session.pin).props(
                'flat dense no-caps size=sm aria-label="Pin the frequencies as baseline"'
            )
        with card("modes", "Mode shapes"):
            self._mode_buttons()
            self._component = (
                ui.select(
                    _components(view.family),
                    value=view.component,
                    on_change=lambda e: self.session.look(component=e.value or 0),
                )
                .props('dense borderless options-dense aria-label="Quantity of the shapes"')
                .classes("an-pick")
            )
            self._play = ui.button(icon="play_arrow", color=None, on_click=self._toggle_play).props(
                'flat dense round size=sm aria-label="Let the modes vibrate"'
            )
        with card("forces", "Forces inside the body" if vehicle else "Axial force"):
            pass
        with card("curve", "Frequencies [Hz] against"):
            self._curve_select()
        self._panel = PanelChoice(self.session, self._note)
        self._panel.build()
        with card("body", "Body in mode"):
            count = wanted_modes(self.session.state.original)
            self._body = ui.select(
                list(range(1, count + 1)),
                value=min(view.body, count),
                on_change=lambda e: self.session.look(body=int(e.value or 1)),
            ).props('dense borderless options-dense aria-label="Mode of the 3-D view"')
            self._body.classes("an-pick an-narrow")
            ui.label("turn with the mouse").classes("an-hint")
            back = ui.button(icon="restart_alt", color=None, on_click=self._board.reset)
            back.props('flat dense round size=sm aria-label="Look from the first direction again"')

    def _modes_shown(self) -> int:
        return min(self.session.state.original.solve.modes, 6)

    def _mode_buttons(self) -> None:
        """Build one button a mode, pressed where its shape is drawn."""
        view = self.session.state.view
        self._buttons = {}
        with ui.element("div").classes("an-modes").props('role="group" aria-label="Modes drawn"'):
            for number in range(1, self._modes_shown() + 1):
                button = ui.button(str(number), color=None, on_click=self._toggler(number))
                button.props("flat dense size=sm").classes(f"an-modebutton an-c{number}")
                self._buttons[number] = button
                self._press(number, number in view.modes)

    def _press(self, number: int, pressed: bool) -> None:
        button = self._buttons[number]
        button.classes(add="an-pressed" if pressed else "", remove="" if pressed else "an-pressed")
        state = str(pressed).lower()
        button.props(f'aria-pressed="{state}" aria-label="mode {number}"')

    def _curve_select(self) -> None:
        words = 'dense borderless options-dense aria-label="Input of the curve"'
        self._curve = ui.select({}, on_change=self._run_over).props(words)
        self._curve.classes("an-pick an-wide").mark("curve")
        self._name_curve()

    def _name_curve(self) -> None:
        """Offer the numbers that there are now, and name the one that the curve runs over."""
        state = self.session.state
        every = {item.path: item.label for item in numbers(state.problem)}
        item = self.session.curve_input(state, sliders(state.problem, state.original))
        self._named = value = item.path if item and item.path in every else None
        if (self._curve.options, self._curve.value) != (every, value):
            self._curve.set_options(every, value=value)

    def _run_over(self, event: events.ValueChangeEventArguments[Any]) -> None:
        if event.value and event.value != self._named:
            self.session.look(curve=str(event.value))

    # --- what the controls do ---------------------------------------------------------------

    def _ready(self, event: events.GenericEventArguments) -> None:
        self._system_dark = bool(event.args)
        self.session.again()

    async def _asked(self, event: events.GenericEventArguments) -> None:
        """Tell the browser once all that it sent before is answered."""
        await self.session.rest()
        self._board.apply({"answered": event.args})

    def _moved(self, event: events.GenericEventArguments) -> None:
        """Take where a mark of the sketch was dragged to."""
        path, x = str(event.args.get("path")), event.args.get("x")
        item = find_input(self.session.state.problem, self.session.state.original, path)
        if item is not None and isinstance(x, int | float):
            new = float(f"{min(max(float(x), item.low), item.high):.4g}")
            self.session.change({path: new}, moving=path)

    def _family(self, family: FamilyName) -> None:
        self._component.set_options(_components(family), value=0)
        self.session.look(family=family, component=0)

    def _toggler(self, number: int) -> Callable[[], None]:
        def toggle() -> None:
            chosen = set(self.session.state.view.modes) ^ {number}
            self._press(number, number in chosen)
            self.session.look(modes=tuple(sorted(chosen)))

        return toggle

    def _choose(self, event: events.GenericEventArguments) -> None:
        """Show one mode everywhere: its shape, forces and energies, the body in it."""
        number = int(event.args)
        if number not in self._body.options:
            return
        self.session.look(modes=(number,), body=number, panel="mode")
        for other in self._buttons:
            self._press(other, other == number)
        self._body.value = number
        self._panel.choose("mode")

    def _toggle_play(self) -> None:
        self._playing = not self._playing
        self._play.props(f"icon={'pause' if self._playing else 'play_arrow'}")
        self._board.play(self._playing)

    def _units(self, event: events.ValueChangeEventArguments[Any]) -> None:
        self.session.look(units=event.value)

    def _toggle_dark(self) -> None:
        """Turn dark or light, from what the browser's system asks for where nothing was chosen."""
        now = self.session.state.view.dark
        dark = not (self._system_dark if now is None else now)
        self._dark.value = dark
        self.session.look(dark=dark)

    def _opener(self, example: str) -> Callable[[], Coroutine[Any, Any, None]]:
        return lambda: self._open(lambda: read_example(example))

    async def take_files(self, files: dict[str, bytes]) -> None:
        """Open what was chosen, or dropped on the page."""
        await self._open(lambda: read_dropped(files))

    async def _open(self, read: Callable[[], Any]) -> None:
        """Open another file; a wrong one changes nothing."""
        try:
            file = await self.session.run(read)
        except AntinodeError as error:
            self._note(str(error))
            return
        self.session.open(file)
        self.rebuild()

    def _copy_link(self) -> None:
        try:
            self.session.state.query()
        except AntinodeError as error:
            self._note(str(error))
            return
        ui.run_javascript("window.antinode.copyLink()")

    def _tell(self, sentence: str) -> None:
        with self._client:
            ui.notify(sentence, position="bottom-right", timeout=2500, classes="an-told")

    def _note(self, sentence: str) -> None:
        with self._client:
            ui.notify(
                sentence,
                type="negative",
                multi_line=True,
                close_button="Close",
                timeout=0,
                position="top",
                classes="an-toast",
            )

    def _key(self, event: events.KeyEventArguments) -> None:
        if not event.action.keydown or event.action.repeat:
            return
        command = event.modifiers.ctrl or event.modifiers.meta
        if command and event.key == "z":
            self.session.undo()
        elif not command and event.key == "p":
            self.session.pin()
        elif not command and event.key == "v":
            self._toggle_play()


def _name(state: State) -> str:
    try:
        return state.original.beam().name
    except AntinodeError:
        return state.file.origin
