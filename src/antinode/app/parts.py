"""What the page is built of: sections, cards with a picture, buttons."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from nicegui import ui

from .elements import Picture

SMALL = "dense flat no-caps size=sm"


def head_button(text: str, icon: str, click: Callable[[], Any] | None = None) -> ui.button:
    """Build a button of the page's head."""
    found = ui.button(text, icon=icon, color=None, on_click=click)
    return found.props("flat dense no-caps").classes("an-headbutton").mark(text.lower())


@contextmanager
def section(title: str) -> Iterator[None]:
    """Build a part of the side with its title."""
    with ui.element("section").classes("an-section"):
        ui.label(title).classes("an-title").props('role="heading" aria-level="2"')
        yield


def enlarge_button(title: str) -> None:
    """Build the button that lets a panel fill the page, and again gives it its place.

    Where it fills the page, buttons beside it save its picture and copy its numbers.
    """
    with ui.element("div").classes("an-modes an-saving"):
        for kind in ("svg", "png"):
            picture = ui.button(kind.upper(), color=None).classes(f"an-{kind}button")
            picture.props(f'{SMALL} aria-label="Save as {kind.upper()}: {title}"')
            script = f"(e) => window.antinode.saveNear(e.currentTarget, '{kind}')"
            picture.on("click", js_handler=script)
        copy = ui.button("Copy", color=None).props(f'{SMALL} aria-label="Copy numbers: {title}"')
        copy.on("click", js_handler="(e) => window.antinode.copyNear(e.currentTarget)")
    button = ui.button(icon="open_in_full", color=None)
    button.props(f'flat dense round size=sm aria-label="Enlarge: {title}"').classes("an-enlarge")
    button.on("click", js_handler="(e) => window.antinode.enlarge(e.currentTarget)")


@contextmanager
def card(kind: str, title: str) -> Iterator[None]:
    """Build a panel: its title with controls beside it, and its picture below."""
    role = {"frequencies": "region", "beam": "group"}.get(kind, "img")
    with ui.element("section").classes(f"an-card an-at-{kind}"):
        with ui.element("div").classes("an-cardhead"):
            ui.label(title).classes("an-title").props('role="heading" aria-level="2"')
            yield
            enlarge_button(title)
        Picture(kind, title, role=role)
