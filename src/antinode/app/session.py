"""One open page: takes changes, computes beside the event loop, sends what changed.

A moving slider gets the quick answer and a coarse curve. Once it rests, the full one follows and
the curve grows finer. A newer change ends the work on an older one at the next step.
"""

from __future__ import annotations

import asyncio
import json
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import Any, Protocol
from urllib.parse import urlencode

from antinode.errors import AntinodeError, InputError

from .compute import Answer, full_answer, kept, quick_answer
from .curve import COARSE, FINE, Curve, curve_key, grow_curve
from .inputs import Input, find_input, sliders
from .panels.characteristic import characteristic_data
from .panels.compare import Snapshot, compare_data, snapshot
from .panels.curve import cursor_data, curve_data, no_curve
from .panels.effects import effects_data, ends_data
from .panels.forces import forces_data
from .panels.frequencies import baseline_of, frequencies_data
from .panels.mode import mode_data
from .panels.modes import modes_data
from .panels.notes import notes_data
from .panels.response import response_data
from .panels.sheet import said
from .panels.sketch import sketch_data
from .panels.stability import stability_data
from .panels.vehicle import vehicle_data
from .scene3d import body_data
from .state import File, History, State, Value, fields_of

_workers = ThreadPoolExecutor(max_workers=2, thread_name_prefix="antinode")
_slow = ThreadPoolExecutor(max_workers=1, thread_name_prefix="antinode-panel")
_SETTLED = 0.2
"""Time without a change after which the full result is computed [s]."""
_MOST_KEPT = 12  # snapshots
PANELS: dict[str, Callable[[Answer], dict[str, Any]]] = {
    "characteristic": characteristic_data,
    "effects": effects_data,
    "ends": ends_data,
    "stability": stability_data,
    "compare": lambda _: said(""),
    "response": lambda _: said(""),
}
"""Panels that take a full result, and are computed while they are looked at."""


class Face(Protocol):
    """What a session needs of its page."""

    def apply(self, patch: dict[str, Any]) -> None:
        """Send new data to the pictures."""

    def refresh(self, problem_inputs: tuple[Input, ...], moving: str) -> None:
        """Show the present values in the fields."""

    def complain(self, path: str, sentence: str) -> None:
        """Mark what is wrong at its field; an empty sentence takes the mark away."""

    def rebuild(self) -> None:
        """Build the page anew for another file."""


class Session:
    """The state of one open page and the work on it.

    Parameters
    ----------
    state : State
    face : Face
    """

    def __init__(self, state: State, face: Face) -> None:
        self.history = History(state)
        self.answer: Answer | None = None
        self.inputs: tuple[Input, ...] = ()
        self.error = ""
        self._face = face
        self._sent: dict[str, str] = {}
        self._version = 0
        self._sequence = 0
        self._moved = self._dragged = ""
        self._answered: State | None = None
        self._snapshots: list[Snapshot] = []
        self._task: asyncio.Task[None] | None = None
        self._jobs: set[asyncio.Future[Any]] = set()
        self._changed = asyncio.Event()
        self._curve: Curve | None = None

    @property
    def state(self) -> State:
        """The present state."""
        return self.history.state

    # --- changes ------------------------------------------------------------------------------

    def change(self, changes: Mapping[str, Value], moving: str = "") -> None:
        """Take new values; `moving` names the slider that is being dragged."""
        self._moved, self._dragged = next(iter(changes), ""), moving
        self.history.put(self.state.changed(changes), gesture=moving)
        self._start()

    def look(self, **how: Any) -> None:
        """Look at the same problem in another way."""
        self.history.look(self.state.viewed(**how))
        self._start()

    def open(self, file: File) -> None:
        """Open another file; its sliders start anew, the view stays but for the baseline."""
        view = self.state.view.model_copy(update={"baseline": (), "curve": ""})
        self.history.put(State(file, {}, view))
        self.forget()
        self._start()

    def undo(self) -> None:
        """Take the last change back."""
        before = self.state.file
        self.history.undo()
        self._dragged = ""
        self._start()
        if self.state.file is not before:
            self.forget()
            self._face.rebuild()

    def pin(self) -> None:
        """Pin the present frequencies as the baseline, or take the pin out."""
        pinned = bool(self.state.view.baseline)
        if self.answer:
            self.look(baseline=() if pinned else baseline_of(self.answer))

    def keep(self) -> str:
        """Keep the present state as a snapshot, and return its name; empty where it is not solved.

        It can be gone back to, and is compared with what comes after it.
        """
        if self.answer is None or self.answer.full is None or self.error:
            return ""
        name = chr(ord("A") + len(self._snapshots) % 26)
        self._snapshots = [*self._snapshots, snapshot(name, self.state, self.answer)][-_MOST_KEPT:]
        self._start()
        return name

    def drop(self) -> None:
        """Forget all snapshots."""
        self._snapshots = []
        self._start()

    @property
    def snapshots(self) -> tuple[str, ...]:
        """Names of the snapshots."""
        return tuple(one.name for one in self._snapshots)

    def go_back(self, name: str) -> None:
        """Take the values of a snapshot again: a step that can be undone."""
        chosen = next(one for one in self._snapshots if one.name == name).state
        before = self.state.file
        self.history.put(replace(chosen, view=self.state.view))
        self._dragged = ""
        self._start()
        if chosen.file is not before:
            self.forget()
            self._face.rebuild()

    def forget(self) -> None:
        """Forget what the browser has: everything is sent anew."""
        self._sent.clear()

    def again(self) -> None:
        """Send everything that there is."""
        self.forget()
        self._start()

    # --- work ---------------------------------------------------------------------------------

    def _start(self) -> None:
        self._version += 1
        self._changed.set()
        if self._task is None or self._task.done():
            self._task = asyncio.get_running_loop().create_task(self._work())

    async def _work(self) -> None:
        while True:
            version, state = self._version, self.state
            steps = self._quick, self._chosen, self._coarse_curve, self._settled, self._full
            for step in (*steps, self._panel, self._curves):
                if not await step(state) or version != self._version:
                    break
            if version == self._version:
                return

    async def _quick(self, state: State) -> bool:
        return await self._show(state, quick_answer)

    async def _chosen(self, state: State) -> bool:
        """Send the chosen panel at once where it moves too, after those that do not wait for it."""
        answer, version, panel = self.answer, self._version, state.view.panel
        if panel not in ("characteristic", "response") or answer is None:
            return True
        data = await self.run(lambda: self._chosen_data(panel, state, answer))
        if version != self._version:
            return False
        self._send({panel: data})
        return True

    async def _settled(self, state: State) -> bool:
        await asyncio.sleep(_SETTLED)
        return True

    def release(self) -> None:
        """Take note that a slider was let go: the next move is a step of its own."""
        moved, self._dragged = self._dragged, ""
        self.history.end_gesture()
        if moved and self._answered is self.state:  # else its answer brings the fields along
            self._face.refresh(self.inputs, "")

    async def _full(self, state: State) -> bool:
        done = await self._show(state, full_answer)
        self._send({}, address=self._address(state))
        return done

    async def _panel(self, state: State) -> bool:
        """Compute what the chosen panel shows, if that takes a full result.

        It may take seconds: a change that comes meanwhile does not wait for it.
        """
        if state.view.panel not in PANELS or self.answer is None or self.answer.full is None:
            return True
        answer, panel = self.answer, state.view.panel

        def compute() -> dict[str, Any]:
            try:
                return self._panel_data(panel, state, answer)
            except AntinodeError as error:
                return said(str(error))

        self._changed.clear()
        work: asyncio.Future[Any] = asyncio.get_running_loop().run_in_executor(_slow, compute)
        changed: asyncio.Future[Any] = asyncio.ensure_future(self._changed.wait())
        await asyncio.wait({work, changed}, return_when=asyncio.FIRST_COMPLETED)
        changed.cancel()
        if not work.done():
            work.cancel()
            return False
        data = await work
        if state is self.state:
            self._send({panel: data})
        return True

    def _panel_data(self, panel: str, state: State, answer: Answer) -> dict[str, Any]:
        if panel == "compare":
            now = snapshot("now", state, answer)
            return compare_data(self._snapshots, now, state.view.family)
        if panel == "response":
            return response_data(state, answer, full=True, beside=self._beside(state))
        return kept((panel, state.key), lambda: PANELS[panel](answer))

    async def _show(self, state: State, compute: Callable[[State], Answer]) -> bool:
        """Compute an answer and send it; on an error say so and keep the last one."""
        try:
            answer, data, inputs = await self.run(lambda: self._data(state, compute(state)))
        except AntinodeError as error:
            self._fail(self.words_of(error))
            return False
        except Exception as error:
            self._fail(f"{type(error).__name__}: {error}; this is a bug in antinode")
            return False
        self.answer, self.inputs, self.error = answer, inputs, ""
        self._answered = state
        self._face.complain("", "")
        self._send(data, stale=False)
        if state is self.state:
            self._face.refresh(inputs, self._dragged)
        return True

    def words_of(self, error: AntinodeError) -> str:
        """Return what is wrong without the file's name, which stands above."""
        return str(error).replace(f"{self.state.file.origin} (with --set): ", "")

    def _fail(self, sentence: str) -> None:
        self.error = sentence
        paths = (*(item.path for item in self.inputs), *self.state.changes)
        self._face.complain(fields_of(sentence, paths) or self._moved, sentence)
        self._send({}, stale=True)

    def _data(
        self, state: State, answer: Answer
    ) -> tuple[Answer, dict[str, Any], tuple[Input, ...]]:
        """Work out what every panel shows."""
        view = state.view
        inputs = sliders(state.problem, state.original, view.sliders)
        data = {
            "forces": forces_data(answer, view.units),
            "modes": modes_data(answer, view, self._answer_beside(state)),
            "frequencies": frequencies_data(answer, view),
            "notes": notes_data(answer, view.units),
            "body": body_data(answer, view.body, view.family),
        }
        if answer.case is not None:
            data["vehicle"] = vehicle_data(answer.case, view.units)
        else:
            data["beam"] = sketch_data(answer, view.units)
        if view.panel == "mode":
            data["mode"] = mode_data(answer, view)
        item = self.curve_input(state, inputs)
        if item is None:
            data["curve"] = {"said": "Attach something, or add a slider: this shows what it does."}
        elif answer.is_damped or self._known_curve(state, item) is not None:
            data["curve"] = self._curve_patch(state, item, answer)
        return answer, data, inputs

    def _beside(self, state: State) -> State | None:
        """Return the last snapshot, if it is of the same kind and another state."""
        last = self._snapshots[-1].state if self._snapshots else None
        if last is None or last.key == state.key or last.is_vehicle != state.is_vehicle:
            return None
        return last

    def _answer_beside(self, state: State) -> Answer | None:
        last = self._beside(state)
        return None if last is None else quick_answer(last)

    def _chosen_data(self, panel: str, state: State, answer: Answer) -> dict[str, Any]:
        if panel == "characteristic":
            return characteristic_data(answer)
        try:
            return response_data(state, answer, full=False, beside=self._beside(state))
        except AntinodeError as error:
            return said(str(error))

    def curve_input(self, state: State, inputs: tuple[Input, ...]) -> Input | None:
        """Return the input that the curve runs over."""
        chosen = state.view.curve or next((i.path for i in inputs if "thrust" in i.path), "")
        found = find_input(state.problem, state.original, chosen)
        return found or (inputs[0] if inputs else None)

    def _curve_patch(self, state: State, item: Input, answer: Answer) -> dict[str, Any]:
        omega2 = answer.quick.omega2
        patch: dict[str, Any] = {"cursor": cursor_data(item, omega2, state.view.units)}
        curve = self._known_curve(state, item)
        if curve is not None:
            patch["curve"] = curve_data(curve, item, state.view.units)
        elif self._curve is not None:
            patch["curve"] = no_curve(item, state.view.units)
        return patch

    def _known_curve(self, state: State, item: Input) -> Curve | None:
        """Return the curve if it is that of a state and an input, however coarse."""
        curve = self._curve
        return curve if curve is not None and curve.key == curve_key(state, item) else None

    async def _coarse_curve(self, state: State) -> bool:
        if self.answer is not None and self.answer.is_damped:
            return True
        return await self._grow(state, COARSE)

    async def _curves(self, state: State) -> bool:
        damped = self.answer is not None and self.answer.is_damped  # a point takes a second then
        return await self._grow(state, COARSE if damped else FINE)

    async def _grow(self, state: State, wanted: int) -> bool:
        """Compute the curve until it has so many points, and send each that is finer."""
        item, answer = self.curve_input(state, self.inputs), self.answer
        if item is None or answer is None:
            return True
        version, curve = self._version, self._known_curve(state, item)
        growing = grow_curve(state, item, curve)
        while curve is None or len(curve.values) < wanted:
            curve = await self.run(lambda: next(growing))
            if version != self._version:
                return False
            self._curve = curve
            self._send({"curve": self._curve_patch(state, item, answer)})
        return True

    async def run(self, work: Callable[[], Any]) -> Any:
        """Do some work beside the event loop."""
        job = asyncio.get_running_loop().run_in_executor(_workers, work)
        self._jobs.add(job)
        job.add_done_callback(self._jobs.discard)
        return await job

    async def rest(self) -> None:
        """Return once nothing is under way: all that was asked for before is answered."""
        while under_way := [work for work in (self._task, *self._jobs) if work and not work.done()]:
            await asyncio.wait(under_way)

    def _send(self, data: Mapping[str, Any], **more: Any) -> None:
        """Send those parts that differ from what the browser has."""
        changed = {}
        for name, part in data.items():
            text = json.dumps(part)
            if self._sent.get(name) != text:
                self._sent[name] = text
                changed[name] = part
        extra = {key: value for key, value in more.items() if self._sent.get(key) != str(value)}
        self._sent |= {key: str(value) for key, value in extra.items()}
        self._sequence += 1
        self._face.apply({"pictures": changed, **extra, "sequence": self._sequence})

    def _address(self, state: State) -> str:
        """Return the page's address: a link that brings this view back."""
        try:
            query = urlencode(state.query())
        except InputError:
            return "/"
        return f"/?{query}" if query else "/"

    async def full(self) -> Answer:
        """Return the full result of the present state.

        Raises
        ------
        AntinodeError
            If there is none.
        """
        state = self.state
        answer: Answer = await self.run(lambda: full_answer(state))
        return answer
