"""Any number of the file as a slider, from a list that can be searched."""

from __future__ import annotations

from typing import Any

from nicegui import events, ui

from antinode.app.inputs import Problem, numbers
from antinode.app.session import Session


class MoreSliders:
    """A field that finds numbers of the file by their words.

    Parameters
    ----------
    session : Session
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        words = 'dense borderless options-dense input-debounce=0 aria-label="Add a slider"'
        self._list = (
            ui.select(
                self._options(self._session.state.original), with_input=True, on_change=self._chosen
            )
            .props(f'{words} placeholder="add a slider: type a word"')
            .classes("an-pick an-more")
            .mark("more-sliders")
        )

    def _options(self, problem: Problem | None = None) -> dict[str, str]:
        found = numbers(problem or self._session.state.problem)
        return {item.path: item.label.replace(":", "") for item in found}

    def refresh(self) -> None:
        """List the numbers that there are now."""
        options = self._options()
        if list(options) != list(self._list.options):
            self._list.set_options(options)

    def _chosen(self, event: events.ValueChangeEventArguments[Any]) -> None:
        """Show a slider of the number that was chosen."""
        if not event.value:
            return
        more = dict.fromkeys((*self._session.state.view.sliders, str(event.value)))
        self._session.look(sliders=tuple(more)[-30:])
        self._list.value = None
