"""Snapshots by name beside the present state: frequencies, and the inputs that differ."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from antinode.app.compute import Answer
from antinode.app.inputs import numbers
from antinode.app.physics import switches
from antinode.app.state import State
from antinode.beam.families import FamilyName

from .frequencies import change_text, frequency_rows
from .sheet import said, sheet


@dataclass(frozen=True)
class Snapshot:
    """What was kept of a state.

    Attributes
    ----------
    name : str
    hertz : mapping
        Frequencies by the names of modes.
    inputs : mapping
        Numbers and switches as they are shown, by their labels.
    state : State
    """

    name: str
    hertz: Mapping[str, float]
    inputs: Mapping[str, str]
    state: State


def snapshot(name: str, state: State, answer: Answer) -> Snapshot:
    """Keep the frequencies and inputs of a state that was solved."""
    assert answer.full is not None
    rows = [row for f in answer.full.families for row in frequency_rows(answer, f)]
    told = {item.label: f"{item.value:.6g} {item.unit}".strip() for item in numbers(state.problem)}
    told |= {
        s.label: s.options.get(s.position, "as in the file")
        for s in switches(state.problem, state.beam, state.original)
    }
    return Snapshot(name, {row.name: row.hertz for row in rows}, told, state)


def compare_data(kept: Sequence[Snapshot], now: Snapshot, family: FamilyName) -> dict[str, Any]:
    """Return the frequencies of all snapshots and of now, then what differs between them."""
    if not kept:
        return said("Keep the present state with the button above, change something, and compare.")
    every = [*kept, now]
    names = [name for name in now.hertz if name.startswith(f"{family} ")]
    rows: list[list[str]] = [
        [
            name.removeprefix(f"{family} "),
            *(_frequency(one.hertz.get(name), kept[0].hertz.get(name)) for one in every),
        ]
        for name in names
    ]
    for label in dict.fromkeys(label for one in every for label in one.inputs):
        values = [one.inputs.get(label, "–") for one in every]
        if len(set(values)) > 1:
            rows.append([label, *values])
    meaning = "Frequencies [Hz], in brackets the change against the first; below, what differs."
    return sheet(["mode", *(one.name for one in every)], rows, (), meaning)


def _frequency(value: float | None, first: float | None) -> str:
    if value is None or math.isnan(value):
        return "none"
    if first is None or math.isnan(first) or value == first:
        return f"{value:.6g}"
    return f"{value:.6g} ({change_text(value / first - 1, 2)})"
