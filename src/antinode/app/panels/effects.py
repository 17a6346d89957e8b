"""What each effect does to every bending mode, and the end forces side by side."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from antinode.app.compute import Answer
from antinode.app.quick import QUICK_FAMILY
from antinode.modes.result import ModalResult
from antinode.response.units import STANDARD_GRAVITY
from antinode.show.each_effect import each_effect
from antinode.show.water import contact_ends, side_by_side, water_notes
from antinode.vehicle.case import Case
from antinode.vehicle.end_forces import Choice, compare_end_forces

from .frequencies import change_text
from .sheet import barred, said, sheet

_COMPLEX = (
    "The bending modes are complex here: switch the water's stiffness off, or take dampers and "
    "feedback out, to compare them one by one."
)


def effects_data(answer: Answer) -> dict[str, Any]:
    """Return f/f_without - 1 of each effect that the beam has, a column for each."""
    result = answer.full
    assert result is not None
    if answer.is_damped:
        return said(_COMPLEX)
    effects = each_effect(result)
    if not effects:
        return said("There is no axial force, shear, foundation or added mass whose effect to see.")
    sizes = (float(np.nanmax(np.abs(e.change))) for e in effects if _any(e.change))
    largest = max(sizes, default=0.0)
    rows = [
        [
            str(mode.number),
            f"{mode.frequency_hz:.6g}" if mode.kind == "elastic" else mode.kind,
            *(_cell(float(effect.change[k]), largest) for effect in effects),
        ]
        for k, mode in enumerate(_numbered(result))
    ]
    meaning = "Frequency with the effect over that without it, all else as it is: solved both ways."
    return sheet(["mode", "Hz", *(effect.name for effect in effects)], rows, (), meaning)


def _any(change: np.ndarray) -> bool:
    return bool(np.any(np.isfinite(change)))


def _numbered(result: ModalResult) -> list[Any]:
    return [mode for mode in result.family(QUICK_FAMILY) if mode.number]


def _cell(change: float, largest: float) -> dict[str, Any]:
    text = "none" if math.isnan(change) else change_text(change, 2)
    return barred(change, largest, text)


def ends_data(answer: Answer) -> dict[str, Any]:
    """Return the bending frequencies of a vehicle for every choice of its end forces."""
    result, case = answer.full, answer.case
    assert result is not None
    if case is None:
        return said("Thrust and drag are those of a vehicle; a beam's own ends are switched above.")
    if case.tangents:
        return _on_the_water(case, result)
    choices = compare_end_forces(case, result)
    if not choices:
        return said(_COMPLEX if answer.is_damped else _NOT_STEADY)
    return _side_by_side(case, choices)


_NOT_STEADY = "A mode diverges or flutters here; the choices are compared where all modes vibrate."


def _on_the_water(case: Case, result: ModalResult) -> dict[str, Any]:
    """Return the bending frequencies by what of the water acts, and where contact ends."""
    columns, ends = side_by_side(case, result), contact_ends(case, result)
    shown = min(map(len, columns.values()))
    rows = []
    for k in range(shown):
        row = [str(k + 1), *(f"{found[k].frequency_hz:.6g}" for found in columns.values())]
        if ends:
            row.append(f"{ends[k].acceleration / STANDARD_GRAVITY:.3g}")
        rows.append(row)
    heads = [f"{name} [Hz]" for name in columns]
    if ends:
        heads.append("contact ends [g]")
    meaning = (
        "Bending modes that oscillate, those of each column by frequency. Contact ends where the "
        "tail, vibrating in that mode, leaves the cavity's wall."
    )
    return sheet(["", *heads], rows, water_notes(case, result), meaning)


def _side_by_side(case: Case, choices: tuple[Choice, ...]) -> dict[str, Any]:
    first = choices[0].frequencies_hz
    rows = []
    for k in range(len(first)):
        row = [str(k + 1), f"{first[k]:.6g}"]
        for choice in choices[1:]:
            value = choice.frequencies_hz[k]
            change = change_text(value / first[k] - 1, 2)
            row.append("not found" if math.isnan(value) else f"{value:.6g} ({change})")
        rows.append(row)
    heads = [f"{choice.name} [Hz]" for choice in choices]
    notes = [
        f"{choice.name}: that no mode is missing is not proven"
        for choice in choices
        if not choice.proven
    ]
    worst = max(float(np.nanmax(choice.error_hz)) for choice in choices if _any(choice.error_hz))
    notes.append(f"Every frequency is within {worst:.0e} Hz of this model's own.")
    meaning = "The first column is as the case has it; in brackets the change against it."
    return sheet(["mode", *heads], rows, notes, meaning)
