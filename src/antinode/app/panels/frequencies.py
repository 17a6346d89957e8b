"""Frequencies as a table with bars beside a pinned baseline; modes near an excitation flagged."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from antinode.app.compute import Answer
from antinode.app.quick import QUICK_FAMILY
from antinode.app.state import View
from antinode.beam.families import FamilyName
from antinode.modes.hertz import error_hz, hertz
from antinode.modes.result import Mode


class Row(NamedTuple):
    """A mode of the table: name, omega^2, its error, shift by the axial force, effect of shear."""

    name: str
    omega2: float
    error_omega2: float
    shift: float
    model_error: float | None = None


def frequencies_data(answer: Answer, view: View) -> dict[str, Any]:
    """Return rows, bars, band and excitation lines."""
    rows = frequency_rows(answer, view.family)
    baseline = dict(view.baseline)
    shown = [_shown(row, baseline.get(row.name), view) for row in rows]
    marks = [*(view.band or ()), *view.lines, *(r["baseline"] or 0.0 for r in shown)]
    top = max([r["hz"] or 0.0 for r in shown] + marks, default=1.0) or 1.0
    return {
        "family": view.family,
        "rows": shown,
        "top": 1.06 * top,
        "band": list(view.band) if view.band else None,
        "lines": list(view.lines),
        "margin": view.margin,
        "pinned": bool(baseline),
        "quick": answer.full is None,
    }


def frequency_rows(answer: Answer, family: FamilyName) -> list[Row]:
    """Return the modes 1, 2, ... of a family; of the quick answer only those of its family."""
    if answer.full is not None:
        modes = [mode for mode in answer.full.modes if mode.family == family and mode.number]
        return [_row(mode) for mode in modes[:12]]
    if family != QUICK_FAMILY:
        return []
    quick = answer.quick
    values = zip(quick.omega2.tolist(), quick.error.tolist(), strict=True)
    return [Row(f"{family} {n}", w2, e, math.nan) for n, (w2, e) in enumerate(values, 1)]


def _row(mode: Mode) -> Row:
    return Row(mode.name, mode.omega2, mode.error_omega2, mode.shift, mode.by_shear)


def _shown(row: Row, baseline: float | None, view: View) -> dict[str, Any]:
    frequency = hertz(row.omega2)
    divergent = math.isnan(frequency)
    error = error_hz(row.omega2, row.error_omega2)
    return {
        "name": row.name,
        "number": row.name.rpartition(" ")[2],
        "hz": None if divergent else frequency,
        "text": "divergent" if divergent else f"{frequency:.6g}",
        "error": "" if divergent else f"{error:.0e}",
        "shift": "" if math.isnan(row.shift) else change_text(row.shift, 1),
        "shear": "" if divergent or row.model_error is None else change_text(row.model_error, 1),
        "baseline": baseline,
        "change": "" if divergent or not baseline else change_text(frequency / baseline - 1, 2),
        "flag": "" if divergent else flag(frequency, view),
    }


def change_text(change: float, digits: int) -> str:
    """Write a relative change with its sign; what rounds to nothing has none."""
    text = f"{change:+.{digits}%}"
    return text if any(digit in text for digit in "123456789") else text[1:]


def flag(frequency: float, view: View) -> str:
    """Say that a frequency lies in the equipment band, or within the margin of band or line."""
    if view.band and view.band[0] <= frequency <= view.band[1]:
        return "in the equipment band"
    for mark in (*(view.band or ()), *view.lines):
        if abs(frequency - mark) <= view.margin * mark:
            return f"within {view.margin:.0%} of {mark:g} Hz"
    return ""


def baseline_of(answer: Answer) -> tuple[tuple[str, float], ...]:
    """Return the frequencies of an answer, to be pinned."""
    families = answer.full.families if answer.full else (QUICK_FAMILY,)
    rows = [row for family in families for row in frequency_rows(answer, family)]
    return tuple((row.name, float(f"{hertz(row.omega2):.7g}")) for row in rows if row.omega2 >= 0)
