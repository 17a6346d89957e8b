"""The page's own elements: pictures drawn in the browser, and the board that feeds them."""

from __future__ import annotations

from pathlib import Path
from typing import Any
from urllib.parse import urlencode

from nicegui import ui
from nicegui.element import Element
from nicegui.elements.echart import EChart  # its bundle of ECharts is used by charts.js
from nicegui.elements.mixins.value_element import ValueElement
from nicegui.elements.scene import Scene  # its bundle of three.js is used by body.js

from .uploads import ADDRESS

_STATIC = Path(__file__).parent / "static"
BUNDLES = (EChart, Scene)


class Picture(Element, component="static/picture.js", esm={"antinode-app": "static"}):
    """A picture that the browser draws from small JSON.

    Parameters
    ----------
    kind : str
        A key of `kinds` in static/index.js.
    label : str
        What it shows, for screen readers.
    role : str
        Of the element: an image, or a region that can be read.
    """

    def __init__(self, kind: str, label: str, role: str = "img") -> None:
        super().__init__()
        self._props.update(kind=kind, name=kind, label=label, role=role)


class Board(Element, component="static/board.js"):
    """Hands data to the pictures, all that changed in one message, and files to the server.

    Parameters
    ----------
    page : str
        Key of the page, with which its files are sent.
    """

    def __init__(self, page: str) -> None:
        super().__init__()
        self._props.update(address=f"{ADDRESS}?{urlencode({'page': page})}")

    def apply(self, patch: dict[str, Any]) -> None:
        """Show new data: pictures by name, whether they are stale, the page's address."""
        self.run_method("apply", patch)

    def play(self, on: bool) -> None:
        """Let the mode shapes move."""
        self.run_method("play", on)

    def reset(self) -> None:
        """Look at the body from where the page first did."""
        self.run_method("reset")

    def choose(self) -> None:
        """Open the browser's dialog for files."""
        self.run_method("choose")


class Quiet(ValueElement[Any], component="static/quiet.js"):
    """A control that keeps its value in the browser.

    Neither what a user does there nor a value from here draws the whole page anew, as an update of
    any other element does: some 20 ms of the browser.
    """

    VALUE_PROP = "value"
    LOOPBACK = False

    def _handle_value_change(self, value: Any) -> None:
        """Take a new value; hand it to the browser unless it comes from there."""
        here = self._send_update_on_value_change
        self._send_update_on_value_change = False
        super()._handle_value_change(value)
        self._send_update_on_value_change = here
        if here:
            self.run_method("take", value)


class Slider(Quiet, component="static/quiet.js"):
    """A slider that moves at once, whatever the server is busy with.

    Parameters
    ----------
    value, low, high, step : float
    """

    def __init__(self, value: float, low: float, high: float, step: float) -> None:
        super().__init__(value=value, throttle=0.05)
        self._props.update({"control": "q-slider", "min": low, "max": high, "step": step})


class TextField(Quiet, ui.input, component="static/quiet.js"):
    """A field to type into.

    Parameters
    ----------
    value : str
    """

    def __init__(self, value: str) -> None:
        super().__init__(value=value)
        self._props["control"] = "q-input"
        self._props.pop("_autocomplete", None)


def style_sheet() -> str:
    """Return the style of the page."""
    return (_STATIC / "app.css").read_text(encoding="utf-8")
