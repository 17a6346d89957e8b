"""A response as a curve with its peaks, as JSON for the browser."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

from antinode.app.asked import Wanted, wanted
from antinode.app.compute import Answer, is_kept, kept, quick_answer
from antinode.app.display import Shown, System, number_text, shown_unit
from antinode.app.quick import QUICK_FAMILY
from antinode.app.respond import Curve, full_curve, quick_curve
from antinode.app.state import State
from antinode.arrays import Array
from antinode.modes.hertz import hertz
from antinode.response.peaks import Peak
from antinode.response.quantities import Base, Force

from .numbers import short_list

_NEAR = 0.1
"""Relative distance of a peak from the mode that it is named by."""


def response_data(
    state: State, answer: Answer, full: bool, beside: State | None = None
) -> dict[str, Any]:
    """Return the curve of a state's response: at once, or in full if asked, or if it is there.

    That of a snapshot beside it is under the same force, at once.

    Raises
    ------
    AntinodeError
        If what is asked for cannot be: off the beam, of a family that the beam has not.
    """
    view = state.view
    first = quick_answer(State(state.file)).quick  # the band stays while a slider moves
    asked = wanted(view.response, answer.beam, first)
    known = "response", state.key, view.response
    full = full or is_kept((*known, True))
    solve = full_curve if full else quick_curve
    curve = kept((*known, full), lambda: solve(answer.beam, asked, answer.quick))
    own = answer.quick.omega2 if asked.output.family == QUICK_FAMILY else np.empty(0)
    data = _drawn(curve, asked, view.units, full, hertz(np.maximum(own, 0.0)))
    if beside is not None:
        other = replace(beside, view=view)
        data["kept"] = response_data(other, quick_answer(other), full=False)["points"]
    return data


def _drawn(curve: Curve, asked: Wanted, system: System, full: bool, modes: Array) -> dict[str, Any]:
    unit = shown_unit(asked.output.unit, system)
    size = np.abs(curve.values) / unit.factor
    phase = np.degrees(np.angle(curve.values))
    f = short_list(curve.frequency_hz, 6)
    points = [list(row) for row in zip(f, short_list(size), short_list(phase, 3), strict=True)]
    return {
        "title": title(asked, system),
        "unit": unit.name,
        "low": asked.low,
        "high": asked.high,
        "points": [row for row in points if row[1]],
        "peaks": [
            _peak(peak, error, unit, modes)
            for peak, error in zip(curve.peaks, curve.peak_error, strict=True)
        ],
        "quick": not full,
        "notes": list(curve.warnings),
    }


def _peak(peak: Peak, error: float, unit: Shown, modes: Array) -> dict[str, Any]:
    """Return a peak with the mode whose frequency is nearest, if one is within a tenth."""
    apart = np.abs(modes / peak.frequency_hz - 1)
    near = int(np.argmin(apart)) if len(modes) else -1
    return {
        "hz": float(f"{peak.frequency_hz:.6g}"),
        "size": float(f"{peak.size / unit.factor:.5g}"),
        "error": f"{error / unit.factor:.1e}" if math.isfinite(error) else "",
        "mode": f"{QUICK_FAMILY} {near + 1}" if near >= 0 and apart[near] < _NEAR else "",
    }


def title(asked: Wanted, system: System) -> str:
    """Say in words what acts and what is seen."""
    output, length = asked.output, shown_unit("m", system)
    seen = f"{number_text(length.of(output.x), 4)} {length.name}"
    return f"{_acts(asked, length)}: {output.quantity.replace('_', ' ')} at {seen}"


def _acts(asked: Wanted, length: Shown) -> str:
    """Say what drives, and how strongly."""
    drive: Force | Base = asked.drive
    system: System = "SI" if asked.amplitude >= 1e3 else "mm-t-s"
    if isinstance(drive, Base):
        unit = shown_unit(drive.unit, "SI").name
        return f"supports by {number_text(asked.amplitude, 4)} {unit}, {drive.direction}"
    strength = shown_unit(drive.unit, system)
    if drive.unit == "N m" and asked.amplitude < 1e3:
        strength = Shown("N m", 1.0)
    word = "moment" if drive.direction == "moment" else f"{drive.direction} force"
    amount = f"{number_text(strength.of(asked.amplitude), 4)} {strength.name}"
    return f"{amount} {word} at {number_text(length.of(drive.x), 4)} {length.name}"
